"""Equations of every kind and size, the same on every run: what `benchmarks/engine.py` measures.

Each family is a function of the number n of finite poles of S, and its answer is known by construction (the reasons are
those of `tests/shared/strategies.py`); the random numbers are seeded by family and size.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "shared"))

import transform

from kovacic.algebra.factors import product
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ

SIZES = (5, 10, 20, 40, 80, 100, 200, 400)
DIGITS = (1, 10, 100, 1000)
MANY_DIGITS = (1000, 10000, 25000)
ORDERS = (2, 4, 6, 8, 10, 12)
DEGREES_OF_P = (1000, 2000, 5000, 10000, 20000)
DEGREES_OF_S = (1000, 2000, 4000, 8000, 16000)
MANY_POLES = (100, 200, 400, 800, 1600)
X = RatFunc(QQ.poly([0, 1]))


@dataclass(frozen=True)
class Sample:
    """One equation; `case` is what must come out."""

    family: str
    parameter: int
    S: RatFunc
    case: int | None

    @property
    def poles(self) -> int:
        """The number of finite poles of S, conjugates counted one by one."""
        return _finite_poles(self.S)


def _finite_poles(S: RatFunc) -> int:
    return S.den.degree - S.den.gcd(S.den.derivative()).degree


def _random_poly(rng: Random, degree: int, bound: int = 9) -> Poly:
    """Monic, squarefree, with a non-zero constant term."""
    while True:
        p = QQ.poly(
            [rng.choice([-1, 1]) * rng.randint(1, bound), *(rng.randint(-bound, bound) for _ in range(degree - 1)), 1]
        )
        if p.gcd(p.derivative()).degree == 0:
            return p


def unique_rational(n: int, rng: Random) -> RatFunc:
    """omega with n rational simple poles, rational residues and a polynomial part."""
    omega = X
    for c in rng.sample(range(-2 * n, 2 * n), n):
        omega = omega + Fraction(rng.choice([1, 2, 3, 4, 5, 7]), rng.choice([1, 2, 3, 5])) / (X - c)
    return transform.from_omega(omega)


def unique_irreducible(n: int, rng: Random) -> RatFunc:
    """omega with poles at the roots of n/5 quintics, and a polynomial part."""
    omega = X
    for k in range(n // 5):
        p = _random_poly(rng, 5)
        omega = omega + Fraction(k % 4 + 1, 3) * RatFunc(p.derivative(), p)
    return transform.from_omega(omega)


def diagonal(n: int, rng: Random) -> RatFunc:
    """y1 y2 = F of degree n, Wronskian sqrt(2): omega lies over Q(sqrt 2)."""
    return transform.from_product(RatFunc(_random_poly(rng, n)), 2)


def imprimitive(n: int, rng: Random) -> RatFunc:
    """y1 y2 = sqrt(g), g squarefree of degree n >= 5."""
    return transform.from_squared_product(RatFunc(_random_poly(rng, n)), 3)


def _covering(n: int, rng: Random) -> RatFunc:
    """A polynomial f such that the pull-back of differences (1/2, 1/3, 1/k) by f has n finite poles, as a rule.

    Zeros of f and f - 1 and critical points: 3 d - 1 of them for degree d, and 3 d - 5 with a triple zero.
    """
    if n % 3 == 1:
        degree = (n + 5) // 3
        return RatFunc(_random_poly(rng, degree - 3, 3) * QQ.poly([0, 0, 0, 1]))
    return RatFunc(_random_poly(rng, (n + 1) // 3, 3))


def _pull_back(first: Fraction, third: Fraction) -> Callable[[int, Random], RatFunc]:
    def build(n: int, rng: Random) -> RatFunc:
        S = transform.hypergeometric(first, Fraction(1, 3), third)
        while True:
            candidate = transform.pull_back(S, _covering(n, rng))
            if _finite_poles(candidate) in (n, n - 1):
                return candidate

    return build


def none_accessory(n: int, rng: Random) -> RatFunc:
    """Exponent difference 1/2 at all n poles and at infinity, random accessory parameters: local data exclude nothing.

    That no solution exists is no theorem here: the answer is proven by the engine, and a generic one by expectation.
    """
    p = _random_poly(rng, n)
    slope = RatFunc(p.derivative(), p)
    # The sum of -(3/16)/(x-c)^2 over the roots is (3/16) (p'/p)'; at infinity x^2 S -> -3/16.
    accessory = _random_poly(rng, n - 3) + QQ.poly([*[0] * (n - 2), Fraction(3 * (n - 1), 16)])
    return Fraction(3, 16) * slope.derivative() + RatFunc(accessory, p)


def _equal_orders(k: int) -> Callable[[int, Random], RatFunc]:
    """The sum of 1/(x-i)^k for i = 1, ..., n; no solution, as for the accessory parameters."""

    def build(n: int, rng: Random) -> RatFunc:
        powers = [QQ.poly([-i, 1]) ** k for i in range(1, n + 1)]
        den = product(powers)
        return RatFunc(sum((den // power for power in powers), QQ.poly([])), den)

    return build


FAMILIES: dict[str, tuple[Callable[[int, Random], RatFunc], int | None]] = {
    "case 1, unique, rational poles": (unique_rational, 1),
    "case 1, unique, quintics": (unique_irreducible, 1),
    "case 1, diagonal": (diagonal, 1),
    "case 2": (imprimitive, 2),
    "case 3, tetrahedral": (_pull_back(Fraction(1, 2), Fraction(1, 3)), 3),
    "case 3, octahedral": (_pull_back(Fraction(1, 2), Fraction(1, 4)), 3),
    "case 3, icosahedral": (_pull_back(Fraction(1, 2), Fraction(1, 5)), 3),
    # (1/3, 1/3, 1/5) has the denominators of the icosahedral group, but the wrong parity: SL2 [Kimura 1969].
    "none, pull-back": (_pull_back(Fraction(1, 3), Fraction(1, 5)), None),
    "none, accessory parameters": (none_accessory, None),
    **{f"none, poles of order {k}": (_equal_orders(k), None) for k in (1, 2, 4, 6)},
}


def by_size(family: str, n: int) -> Sample:
    """The equation of a family with n poles."""
    build, case = FAMILIES[family]
    return Sample(family, n, build(n, Random(f"{family}/{n}")), case)


def many_poles(n: int) -> Sample:
    """omega with the poles 1, ..., n and residues with the denominators 1, 2, 3 and 5, and no other part."""
    rng = Random(f"poles 1 to n/{n}")
    parts = []
    for i in range(1, n + 1):
        residue = Fraction(rng.choice([1, 2, 3, 4, 5, 7]), rng.choice([1, 2, 3, 5]))
        parts.append((QQ.poly([residue]), QQ.poly([-i, 1])))
    while len(parts) > 1:
        pairs = [(a * d + c * b, b * d) for (a, b), (c, d) in zip(parts[::2], parts[1::2], strict=False)]
        parts = [*pairs, *parts[2 * len(pairs) :]]
    return Sample("case 1, poles 1 to n", n, transform.from_omega(RatFunc(*parts[0])), 1)


def _big(rng: Random, digits: int) -> int:
    return rng.choice([-1, 1]) * rng.randint(10 ** (digits - 1), 10**digits - 1)


def by_digits(kind: str, digits: int) -> Sample:
    """Five poles or so, the parameters of the construction with this many digits."""
    rng = Random(f"{kind}/{digits}")
    name = f"{kind}, digits"
    if kind == "case 1":
        p = QQ.poly([_big(rng, digits), _big(rng, digits), 0, 0, 0, 1])
        omega = Fraction(2, 3) * RatFunc(p.derivative(), p) + RatFunc(QQ.poly([_big(rng, digits), _big(rng, digits)]))
        return Sample(name, digits, transform.from_omega(omega), 1)
    if kind == "case 2":
        g = QQ.poly([_big(rng, digits), _big(rng, digits), 0, 0, 0, 1])
        return Sample(name, digits, transform.from_squared_product(RatFunc(g), _big(rng, digits)), 2)
    if kind == "case 3":
        f = QQ.poly([_big(rng, digits), _big(rng, digits), 1])
        S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 5))
        return Sample(name, digits, transform.pull_back(S, RatFunc(f)), 3)
    p = QQ.poly([_big(rng, digits), _big(rng, digits), 0, 0, 0, 1])
    S = Fraction(3, 16) * RatFunc(p.derivative(), p).derivative() + RatFunc(QQ.poly([_big(rng, digits), 0, 1]), p)
    return Sample(name, digits, S, None)


def by_order(kind: str, order: int) -> Sample:
    """Poles of S of this even order: at five rational points, or at the roots of a quintic."""
    rng = Random(f"{kind}/{order}")
    name, half = f"pole order, {kind}", order // 2
    omega = X
    factors = [QQ.poly([-c, 1]) for c in (-2, -1, 0, 1, 2)] if kind == "rational" else [_random_poly(rng, 5)]
    for p in factors:
        omega = omega + Fraction(rng.choice([1, 2, 4]), 3) * RatFunc(p.derivative(), p)
        for k in range(2, half + 1):
            omega = omega + RatFunc(QQ.poly([rng.randint(1, 9)]), p**k)
    return Sample(name, order, transform.from_omega(omega), 1)


def by_degree(name: str, degree: int) -> Sample:
    """S without poles: Hermite's equation, whose P has this degree, or S of this degree with a solution or without one."""
    if name == "degree of P, Hermite":
        return Sample(name, degree, X**2 - (2 * degree + 1), 1)
    if name == "degree of S, case 1":
        return Sample(name, degree, transform.from_omega(RatFunc(_random_poly(Random(name), degree // 2))), 1)
    return Sample(name, degree, X**degree + X + 1, None)


DIGIT_KINDS = ("case 1", "case 2", "case 3", "none")
ORDER_KINDS = ("rational", "quintic")


def series() -> Iterator[tuple[str, list[tuple[str, int]]]]:
    """All measurements: (what the parameter is, [(name, parameter), ...]); `sample` builds one."""
    for family in FAMILIES:
        yield "poles", [(family, n) for n in SIZES]
    yield "many poles", [("case 1, poles 1 to n", n) for n in MANY_POLES]
    for kind in DIGIT_KINDS:
        yield "digits", [(f"{kind}, digits", d) for d in DIGITS]
    for kind in ("case 1", "case 2"):
        yield "many digits", [(f"{kind}, digits", d) for d in MANY_DIGITS]
    for kind in ORDER_KINDS:
        yield "order", [(f"pole order, {kind}", k) for k in ORDERS]
    yield "degree of P", [("degree of P, Hermite", d) for d in DEGREES_OF_P]
    for case in ("case 1", "none"):
        yield "degree of S", [(f"degree of S, {case}", d) for d in DEGREES_OF_S]


def sample(name: str, parameter: int) -> Sample:
    """The equation of a series."""
    if name in FAMILIES:
        return by_size(name, parameter)
    if name == "case 1, poles 1 to n":
        return many_poles(parameter)
    if name.endswith(", digits"):
        return by_digits(name.removesuffix(", digits"), parameter)
    if name.startswith("degree"):
        return by_degree(name, parameter)
    return by_order(name.removeprefix("pole order, "), parameter)
