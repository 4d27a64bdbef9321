"""A second opinion on answers of kovacic: reads them as JSON lines and proves them anew, sharing no code with the program.

    python checker.py answers.jsonl          (or kovacic check answers.jsonl; "-" reads standard input)

For each line one of

    checked: y'' = S y from a, b, c; gauge; case; omega; group; solutions; not checked: input, notices, seconds, ...
    refuted: why
    not checked: why                         (parameters, algebraic numbers in S, too large, more than a minute)
    unreadable: why                          (no JSON, or a key twice in one object)

Exit status: 0 all checked, 1 one refuted, 2 one unreadable, or nothing to check, 3 one not checked.
It needs Python 3.11 and python-flint alone.  It changes FLINT's global precision, so it is for one thread of a process.

What "checked" means, for an S over Q(x):
- S from input: S was given, with + - * / ^ and parentheses, and is this one.
- y'' = S y from a, b, c, and gauge: S = (b/a)'/2 + (b/a)^2/4 - c/a and gauge = -b/(2a), where an equation was given.
- case, omega, of a "yes": the product of W - omega over the conjugates of omega = y'/y belongs to a form in the solutions, over
  Q(c)(x), c a root of an irreducible polynomial; and no smaller degree is possible, by the exclusions.
- case, of a "no": the group is neither reducible nor imprimitive nor finite and primitive, each excluded by a local condition
  at places of S, or by the absence of a rational form in the solutions (a rank modulo a prime can only be smaller than over
  Q) and, if reducible, of a single rational omega (its expansion, modulo a prime, isn't that of a rational function with few
  poles).
- group: its family, n, order and name follow from the above, and from the evidence that is given for it.
- solutions: both satisfy the equation, by exact differentiation, and their Wronskian isn't zero.  A function that isn't known
  here is named ("solutions[1] (zeta)"), and so is what differentiation alone doesn't prove, as relations between roots that
  depend on their branches ("solutions[1]"); what is nonzero at several points is refuted.
Every key is either looked at, or named after "not checked", or refused.  What the keys that aren't looked at say is for the
reader to compare: `input` and `equation.text` with a, b and c, or with S.

To be read from the end: `Answer.check` is the table of contents.

J. Kovacic, J. Symb. Comp. 2 (1986); F. Ulmer & J.-A. Weil, ibid. 22 (1996); M. van Hoeij, ibid. 24 (1997).
"""

from __future__ import annotations

import fileinput
import io
import json
import multiprocessing
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import chain, islice
from math import inf, isqrt, lcm, prod
from operator import add, mul, sub, truediv
from typing import Any, NamedTuple

from flint import (
    Ordering,
    acb,
    acb_poly,
    acb_series,
    arb,
    ctx,
    fmpq,
    fmpq_mat,
    fmpq_mpoly_ctx,
    fmpq_poly,
    fmpq_series,
    fmpz,
    nmod_mat,
)
from flint import nmod_poly as nmod

LONGEST = 10_000  # the largest degrees, and the most terms of a series, that are computed with
PRIMES = [q for q in range(2**60 + 33, 2**60 + 20_000, 2) if fmpz(q).is_prime()]


class Unreadable(Exception):
    """The line isn't a JSON object in which each key occurs once."""


def demand(holds: Any, claim: str) -> None:
    """Refute the answer unless this holds."""
    if not holds:
        raise AssertionError(claim)


def demand_equal(found: Any, expected: Any, what: str) -> None:
    """Refute the answer unless this is found, and of the same type: true isn't 1."""
    demand(repr(found) == repr(expected), f"{what} is {expected!r}")


def demand_keys(data: Any, what: str, required: str, optional: str = "") -> None:
    """Refute the answer unless this is an object with the required keys, and no others than the optional ones."""
    demand(isinstance(data, dict), f"{what} is an object")
    missing = set(required.split()) - set(data)
    unknown = set(data) - set(required.split()) - set(optional.split())
    demand(not missing, f"{what} has the key {min(missing, default='')!r}")
    demand(not unknown, f"{what} has a key {ascii(min(unknown, default=''))[:60]}")


def the_list(value: Any, what: str) -> list[Any]:
    """The value, which must be a list."""
    demand(isinstance(value, list), f"{what} is a list")
    return list(value)


def is_whole(value: Any) -> bool:
    """Is this an integer, and no truth value?"""
    return type(value) is int


def affordable(size: Any, what: str) -> int:
    """The size; gives up where it would make a computation too long, or isn't known."""
    if size is None or size > LONGEST:
        raise NotImplementedError(f"{what} is too large")
    return int(size)


# ------------------------------------------------------------------------------------------- expressions

PLANE = fmpq_mpoly_ctx.get(("c", "x"), Ordering.lex)
X = fmpq_poly([0, 1])
C, X2 = PLANE.gens()


ONE = PLANE.constant(1)


class Value:
    """num/den in Q(c, x), in lowest terms; `ONE` is the denominator of a polynomial."""

    def __init__(self, num: Any, den: Any = ONE) -> None:
        if den is not ONE:
            demand(den != 0, "there is no division by zero")
            common = den if den.is_constant() else num.gcd(den)
            num = num // common
            den = den // common
        self.num = num
        self.den = ONE if den == 1 else den

    def __add__(self, other: Value) -> Value:
        if self.den is other.den is ONE:
            return Value(self.num + other.num)
        return Value(self.num * other.den + other.num * self.den, self.den * other.den)

    def __sub__(self, other: Value) -> Value:
        if self.den is other.den is ONE:
            return Value(self.num - other.num)
        return Value(self.num * other.den - other.num * self.den, self.den * other.den)

    def __mul__(self, other: Value) -> Value:
        if self.den is other.den is ONE:
            return Value(self.num * other.num)
        return Value(self.num * other.num, self.den * other.den)

    def __truediv__(self, other: Value) -> Value:
        return Value(self.num * other.den, self.den * other.num)

    def __pow__(self, n: int) -> Value:
        leading = str(self.num.leading_coefficient()) + str(self.den.leading_coefficient())
        digits = 0 if leading == "11" else len(leading)
        affordable(n * max(digits, *self.num.degrees(), *self.den.degrees()), "a power")
        return Value(self.num**n, self.den**n)

    def derivative(self) -> Value:
        """The derivative by x."""
        return Value(self.num.derivative(1) * self.den - self.num * self.den.derivative(1), self.den**2)

    def equals(self, other: Value) -> bool:
        return bool(self.num * other.den == other.num * self.den)

    @property
    def has_c(self) -> bool:
        return bool(self.num.degrees()[0] > 0 or self.den.degrees()[0] > 0)

    def over_q(self) -> tuple[Any, Any]:
        """Numerator and monic denominator, of a value without c."""
        demand(not self.has_c, "the constants are rational")
        num = in_one_variable(self.num, 1)
        den = in_one_variable(self.den, 1)
        return num / den.leading_coefficient(), den / den.leading_coefficient()


def in_one_variable(f: Any, i: int) -> Any:
    """The polynomial in the i-th variable, without the other."""
    terms = {powers[i]: coefficient for powers, coefficient in f.to_dict().items()}
    return fmpq_poly([terms.get(n, fmpq(0)) for n in range(max(terms, default=0) + 1)])


def is_monic(f: Any) -> bool:
    """Is 1 the coefficient of the highest power of x?"""
    degree = f.degrees()[1]
    return {powers: value for powers, value in f.to_dict().items() if powers[1] == degree} == {(0, degree): 1}


#: How strongly an operator binds, and what it does.
OPERATIONS: dict[str, tuple[int, Callable[[Any, Any], Value]]] = {
    "+": (1, add),
    "-": (1, sub),
    "*": (2, mul),
    "/": (2, truediv),
    "**": (3, pow),
}


class Reader:
    """Expressions with + - * / ** and parentheses, as the program prints them."""

    def __init__(self, text: str, names: dict[str, Any]) -> None:
        self.text = text
        self.names = names
        self.tokens = [*re.findall(r"[0-9]+|\w+|\*\*|\S", text), ""][::-1]

    def value(self) -> Any:
        """The value of the whole text."""
        value = self.expression(0)
        demand(self.tokens == [""], f"{self.text[:60]!r} can be read")
        return value

    def expression(self, least: int) -> Any:
        """As far as operators bind at least so strongly."""
        value = self.operand()
        while self.tokens[-1] in OPERATIONS and OPERATIONS[self.tokens[-1]][0] >= least:
            operator = self.tokens.pop()
            strength, apply = OPERATIONS[operator]
            if operator == "**":
                value = self.power(value)
                demand(self.tokens[-1] != "**", "a power isn't an exponent")
            else:
                value = apply(value, self.expression(strength + 1))
        return value

    def operand(self) -> Any:
        token = self.tokens.pop()
        if token == "-":
            return self.number(0) - self.expression(3)
        if token == "(":
            return self.enclosed()
        return self.number(fmpq(fmpz(token))) if token.isdecimal() else self.named(token)

    def enclosed(self) -> Any:
        value = self.expression(0)
        demand(self.tokens.pop() == ")", "each ( has its )")
        return value

    def number(self, value: Any) -> Any:
        return Value(PLANE.constant(value))

    def named(self, name: str) -> Any:
        return self.names[name]

    def power(self, base: Any) -> Any:
        return base ** int(self.tokens.pop())


def read(text: str, names: dict[str, Value]) -> Value:
    """The rational function that this is."""
    value: Value = Reader(text, names).value()
    return value


# ------------------------------------------------------------------------------------------- local data


def reduced(f: Any, q: int, point: int = 0) -> Any:
    """f(t + point) modulo q, which must keep the degree."""
    demand(int(f.denom()) % q and (f == 0 or int(f.numer()[f.degree()]) % q), f"{q} is a good prime")
    image = nmod([int(c) % q for c in f.numer().coeffs()], q) * pow(int(f.denom()), -1, q)
    return image.compose(nmod([point % q, 1], q)) if point else image


def frobenius(E: Any, M: Any, e: int, count: int, q: int) -> tuple[Any, bool]:
    """The series a with t^e a a solution of t^2 E y'' = M y modulo q; False where it would need a logarithm."""
    top = [int(c) for c in E.coeffs()]
    bottom = [int(c) for c in M.coeffs()] or [0]
    a = [1]
    for n in range(1, count):
        total = sum(bottom[j] * a[n - j] for j in range(1, min(n + 1, len(bottom))))
        total -= sum(top[j] * (n - j + e) * (n - j + e - 1) * a[n - j] for j in range(1, min(n + 1, len(top))))
        pivot = (top[0] * (n + e) * (n + e - 1) - bottom[0]) % q
        if not pivot and total % q:
            return nmod(a, q), False
        a.append(total * pow(pivot, -1, q) % q if pivot else 0)
    return nmod(a, q), True


def square_root(square: Any) -> Any:
    """The root of the square of a rational number; None for other numbers."""
    root = fmpq(isqrt(int(max(square.p * square.q, 0))), square.q)
    return root if root * root == square else None


@contextmanager
def series_of_length(n: int) -> Iterator[None]:
    """FLINT's series end after so many terms, in the block."""
    before = ctx.cap
    ctx.cap = n
    try:
        yield
    finally:
        ctx.cap = before


class Place:
    """The roots of an irreducible p, of multiplicity k in den, where S = num/den; infinity as z = 0 for S(1/z)/z^4."""

    def __init__(self, p: Any, k: int, num: Any, den: Any, infinite: bool = False) -> None:
        self.p = p
        self.k = k
        self.num = num
        self.den = den
        self.infinite = infinite
        self.name = "infinity" if infinite else str(p)
        self.size = int(p.degree())
        self.nu = max(k // 2, 1)  # the order of a pole of omega, for k even or 1
        self.is_irregular = k > 2
        self.is_ramified = k > 2 and k % 2 == 1

    @cached_property
    def leading(self) -> Any:
        """In Q[x]/p: for k = 2 Delta^2 = 1 + 4b, S = b/(x - root)^2 + ...; for k > 2 the first coefficient up to a square."""
        rest = self.den // self.p**self.k
        if self.is_irregular:
            return self.num * rest % self.p
        if self.k < 2:
            return fmpq_poly(1)
        return (1 + 4 * self.num * (rest * self.p.derivative() ** 2 % self.p).xgcd(self.p)[1]) % self.p

    @cached_property
    def difference(self) -> Any:
        """Delta >= 0, the difference of the exponents, if it is a rational number (1 at an ordinary point)."""
        if self.is_irregular or self.leading.degree() > 0:
            return None
        return square_root(self.leading[0])

    @property
    def can_branch(self) -> bool:
        """Can the square root of a rational form branch here?  The local group must exchange two lines."""
        if self.is_irregular:
            return self.is_ramified
        return self.difference is not None and self.difference.q == 2

    @property
    def tells_solutions_apart(self) -> bool:
        """Have at most two solutions (up to constants) an omega in the Laurent series here?"""
        return self.k > 0 and (self.difference is None or self.difference.q > 1 or self.logarithm)

    def roots(self, moduli: Iterable[int] = PRIMES) -> Iterator[tuple[int, int]]:
        """The primes modulo which p has a simple root, and the least one."""
        least = ((q, min((int(r) for r, k in reduced(self.p, q).roots() if k == 1), default=-1)) for q in moduli)
        return ((q, root) for q, root in least if root >= 0)

    def local(self, root: int, q: int) -> tuple[Any, Any]:
        """E and M with S = M/(t^max(k, 2) E) at a root of p modulo q."""
        num = reduced(self.num, q, root)
        den = reduced(self.den, q, root)
        demand(not any(int(den[i]) for i in range(self.k)) and int(den[self.k]), f"{q} keeps the order of a pole")
        return den.right_shift(self.k), num.left_shift(max(2 - self.k, 0))

    @cached_property
    def logarithm(self) -> bool:
        """Is there a logarithm, provably?  Always at a simple pole, and for Delta = 0; for Delta = n > 0 if the series with the
        smaller exponent can't be continued at its n-th term, modulo a prime."""
        if self.k == 1 or self.difference == 0:
            return True
        if self.k != 2 or self.difference is None or self.difference.q > 1:
            return False
        steps = [k for k, value in enumerate(self.num(X - self.p[0]).coeffs()) if k and value != 0]
        if (
            self.den.degree() == 2 and len(steps) < 2
        ):  # t^2 y'' = (a + b t^d) y: term n needs term 0 exactly if d divides n
            return bool(steps) and int(self.difference) % steps[0] == 0
        n = affordable(self.difference, "an exponent difference")
        q, root = next(self.roots())
        return not frobenius(*self.local(root, q), (1 - n) * pow(2, -1, q) % q, n + 1, q)[1]

    def is_not_a_square(self) -> bool:
        """Is `leading` no square in Q[x]/p?  Proven by a prime modulo which it isn't one at a root of p."""
        return any(fmpz(int(reduced(self.leading, q)(r))).jacobi(q) == -1 for q, r in islice(self.roots(), 40))

    def least_valuation(self, m: int) -> Any:
        """The least integer that can be the valuation of a rational form of degree m; infinite if there is none.

        A form is a sum of products of m solutions with the exponents (1 + Delta)/2 and (1 - Delta)/2, the first one alone with
        a logarithm; at an irregular place the exponential factors must cancel, and leave m k/4.
        """
        if self.is_irregular:
            possible = [fmpq(m * self.k, 4)]
        else:
            surplus = [m] if self.logarithm else range(-m, m + 1, 2)
            possible = [(m + i * (self.difference or fmpq(0))) / 2 for i in surplus]
        return min((int(value.p) for value in possible if value.q == 1), default=inf)

    @property
    def has_no_rational_omega(self) -> bool:
        """Are the exponents at a single place irrational, or the two of a ramified one conjugate?"""
        if self.size > 1 or not self.k:
            return self.is_ramified
        return self.half_difference is None

    @cached_property
    def half_difference(self) -> Any:
        """Half the difference of the exponents, summed over the roots, where it is a rational number that is easily known.

        At a single irregular place it is the residue of sqrt(S): the coefficient of t^(nu - 1) in sqrt(t^(2 nu) S).
        """
        if self.difference is not None:
            return self.size * self.difference / 2
        if self.size > 1 or not self.is_irregular or self.is_ramified:
            return None
        root = -self.p[0]
        num = fmpq_series(self.num(X + root).coeffs(), prec=self.nu)
        den = fmpq_series((self.den // self.p**self.k)(X + root).coeffs(), prec=self.nu)
        with series_of_length(self.nu):
            ratio = num / den
            coefficient = (ratio / ratio[0]).sqrt()[self.nu - 1]
        return square_root(ratio[0] * coefficient**2)

    def exponents(self) -> Any:
        """A ball around the sum over the roots of p of the real parts of the least exponents (k not odd > 2)."""
        total = arb(0)
        with series_of_length(self.nu + 1):
            for root, _ in self.p.complex_roots():
                half = self.half_difference_at(root)
                total += arb(self.nu) / 2 + (half if self.logarithm else -half)
        return total

    def half_difference_at(self, root: Any) -> Any:
        """A ball around the real part of half the difference of the exponents at one root."""
        nu = self.nu
        num, rest, unit = (
            acb_series(acb_poly([arb(c) for c in f.coeffs()])(acb_poly([root, 1])).coeffs(), nu + 1)
            for f in (self.num * self.p ** (2 * nu - self.k), self.den // self.p**self.k, self.p)
        )
        slope = acb_series([unit[i + 1] for i in range(nu)], nu)
        ratio = num / (rest * slope**self.k)  # t^(2 nu) S
        if self.is_irregular:
            return abs((ratio[0].sqrt() * (ratio / ratio[0]).sqrt()[nu - 1]).real)
        return abs(((1 + 4 * ratio[0]).sqrt() / 2).real)

    def expansions(self, root: int, q: int, count: int) -> Iterator[Any]:
        """The series w = t^nu omega modulo q of the solutions that have one, where the place tells the solutions apart."""
        E, M = self.local(root, q)
        s = M.mul_low(E.inverse_series_trunc(count), count)  # t^(2 nu) S
        for first in self.first_coefficients(int(s[0]), q):
            yield self.continued(first, s, count, q)

    def first_coefficients(self, s0: int, q: int) -> list[int]:
        """What w can begin with: one of the square roots of s_0 at an irregular place, one of the exponents at a regular one.

        With a logarithm omega belongs to the solution without, which has the larger exponent.
        """
        delta = self.delta_modulo(s0, q)
        if delta is None:
            return []
        if self.is_irregular:
            return [delta, -delta]
        half = pow(2, -1, q)
        larger = (1 + delta) * half % q
        smaller = (1 - delta) * half % q
        return [larger] if self.logarithm else [larger, smaller]

    def delta_modulo(self, s0: int, q: int) -> int | None:
        """Delta modulo q, or a square root of s_0 at an irregular place; None if there is none."""
        if self.difference is not None:
            return int(self.difference.p) * pow(int(self.difference.q), -1, q) % q
        square = fmpz(s0 if self.is_irregular else 1 + 4 * s0) % q
        return None if square.jacobi(q) == -1 else int(square.sqrtmod(q))

    def continued(self, first: int, s: Any, count: int, q: int) -> Any:
        """w with this first coefficient: t^(2 nu) (omega' + omega^2) = s, a term after the other.

        The coefficient of t^j in t^(2 nu) omega' is (j - 2 nu + 1) w_(j - nu + 1), and contains w_j itself where nu = 1.
        """
        nu = self.nu
        terms = [int(c) for c in s.coeffs()] + [0] * count
        w = [first % q]
        for j in range(1, count):
            rest = terms[j] - sum(map(mul, w[1:j], w[j - 1 : 0 : -1]))
            pivot = 2 * w[0]
            if nu == 1:
                pivot += j - 1
            elif j >= nu - 1:
                rest -= (j - 2 * nu + 1) * w[j - nu + 1]
            demand(pivot % q, "the prime avoids the exponents")
            w.append(rest * pow(pivot, -1, q) % q)
        return nmod(w, q)


def places_of(num: Any, den: Any) -> list[Place]:
    """All poles of num/den, and infinity, which is the last one even if it is an ordinary point."""
    found = [Place(p / p[p.degree()], k, num, den) for p, k in den.factor()[1]]
    k = num.degree() - den.degree() + 4 if num != 0 else 0
    top = fmpq_poly(num.coeffs()[::-1]) * X ** max(-k, 0)
    bottom = fmpq_poly(den.coeffs()[::-1]) * X ** max(k, 0)
    return [*found, Place(X, max(k, 0), top, bottom, infinite=True)]


# ------------------------------------------------------------------------------------------- structures


class Structure(NamedTuple):
    """Kovacic's case, the degree of omega, the degree of a rational form, and, if finite and primitive, the orders in PGL2."""

    case: int
    omega: int
    form: int
    orders: tuple[int, ...] = ()


STRUCTURES = {
    "reducible": Structure(1, 1, 2),
    "imprimitive": Structure(2, 2, 4),
    "tetrahedral": Structure(3, 4, 6, (1, 2, 3)),
    "octahedral": Structure(3, 6, 8, (1, 2, 3, 4)),
    "icosahedral": Structure(3, 12, 12, (1, 2, 3, 5)),
}


def ramified(place: Place, structure: str) -> bool:
    """The two solutions at an irregular place of odd order are conjugate over the Laurent series, and so are their omegas."""
    return structure == "reducible" and place.is_ramified


def not_a_square(place: Place, structure: str) -> bool:
    """A single rational omega has rational residues in x; its residue, or leading coefficient, contains the square root."""
    return structure == "reducible" and place.k > 1 and not place.is_ramified and place.is_not_a_square()


def logarithm(place: Place, structure: str) -> bool:
    """The monodromy around a logarithm is unipotent: no finite and no irreducible imprimitive group contains such a matrix."""
    return structure != "reducible" and place.logarithm


def irregular(place: Place, structure: str) -> bool:
    """All solutions of an equation with a finite group are algebraic, and its places regular."""
    return STRUCTURES[structure].case == 3 and place.is_irregular


def exponents(place: Place, structure: str) -> bool:
    """The denominator of Delta is the order of the local monodromy in PGL2, which A4, S4 or A5 must contain."""
    regular = STRUCTURES[structure].case == 3 and 0 < place.k <= 2
    return regular and (place.difference is None or int(place.difference.q) not in STRUCTURES[structure].orders)


#: What is said of places in the necessary conditions, and what it means at each of them.
RULES: dict[str, tuple[str, Callable[[Place, str], bool]]] = {
    "ramified": (
        "an irregular singular point is ramified, so no solution has a rational logarithmic derivative",
        ramified,
    ),
    "not_a_square": ("the exponents at a place aren't rational over the field of its poles", not_a_square),
    "logarithm": (
        "a solution has a logarithm, so the group contains a unipotent element and is infinite and not imprimitive",
        logarithm,
    ),
    "irregular": ("an irregular singular point makes the group infinite", irregular),
    "exponents": ("the exponent differences aren't those of a group of this kind", exponents),
    "too_few_branch_points": (
        "fewer than two places can be branch points of the square root of an invariant",
        lambda place, structure: structure == "imprimitive" and place.can_branch,
    ),
}


class Exclusions:
    """What the group of y'' = S y isn't."""

    def __init__(self, num: Any, den: Any, names: dict[str, Value]) -> None:
        affordable(max(num.degree(), den.degree()), "the degree of S")
        self.num = num
        self.den = den
        self.names = dict(names)
        self.places = places_of(num, den)

    def hold(self, structure: str, evidence: list[Any]) -> None:
        """The group doesn't have this structure, by the evidence.

        One necessary condition, or the absence of the rational form; but a reducible group has one only where omega
        isn't unique, and then there must be no unique omega either.
        """
        conditions = 0
        forms = 0
        omegas = 0
        for item in the_list(evidence, "the evidence"):
            kind = item["kind"]
            if kind == "necessary_condition":
                self.condition(structure, item)
                omegas += item["rule"] == "not_a_square"
                conditions += item["rule"] != "not_a_square"
            elif kind == "no_invariant":
                self.no_form(STRUCTURES[structure].form, item)
                forms += 1
            else:
                demand(kind == "no_rational_omega" and structure == "reducible", "the kind of the evidence is known")
                self.no_omega(item)
                omegas += 1
        without_a_form = (0, 1, 1) if structure == "reducible" else (0, 1, 0)
        demand((conditions, forms, omegas) in ((1, 0, 0), without_a_form), f"the group isn't {structure}")

    def condition(self, structure: str, item: dict[str, Any]) -> None:
        """The rule holds at each of the places that are named; or these are all that can branch, fewer than two points."""
        demand_keys(item, "a necessary condition", "kind rule places statement")
        statement, holds = RULES[item["rule"]]
        demand_equal(item["statement"], statement, "the statement")
        named = [self.place(name) for name in the_list(item["places"], "what is named")]
        demand(len({place.name for place in named}) == len(named), "the places are different")
        demand(all(holds(place, structure) for place in named), f"these places are {item['rule']}")
        if item["rule"] == "too_few_branch_points":
            branching = [place for place in self.places if place.can_branch]
            demand(structure == "imprimitive", "the rule is one for imprimitive groups")
            demand(len(named) == len(branching), "these are the places that can branch")
            demand(sum(place.size for place in branching) < 2, "they are fewer than two")
        else:
            demand(named, f"a place is {item['rule']}")

    def place(self, name: str) -> Place:
        """The place with this factor, or "infinity"."""
        demand(isinstance(name, str), "a place has a name")
        key = name if name == "infinity" else str(read(name, self.names).over_q()[0])
        return {place.name: place for place in self.places}[key]

    def no_form(self, m: int, item: dict[str, Any]) -> None:
        """There is no rational form of degree m: no room for one, or a system of equations modulo a prime has full rank."""
        demand_keys(item, "evidence", "kind invariant_degree prime point degree")
        demand_equal(item["invariant_degree"], m, "the degree of the form")
        room = max(self.room(m), -1)
        demand_equal(item["degree"], room, "the largest degree of P")
        if room < 0:
            demand_equal((item["prime"], item["point"]), (None, 0), "where there is no room, prime and point")
            return
        demand(is_whole(item["prime"]) and is_whole(item["point"]), "prime and point are integers")
        demand(self.dimension(m, item["prime"], item["point"]) == 0, f"there is no rational form of degree {m}")

    def room(self, m: int) -> Any:
        """The largest degree of P in a rational form prod p^v P of degree m, v the least valuations; negative without one."""
        return m - sum(place.least_valuation(m) * place.size for place in self.places)

    def dimension(self, m: int, prime: int | None = None, point: int | None = None) -> int:
        """An upper bound for the dimension of the rational forms of degree m, from expansions modulo a prime.

        At an ordinary point a form is a sum of y1^(m-i) y2^i; divided by prod p^v it is a polynomial of degree `room`, so that
        its terms beyond that are zero: as many equations as one likes, whose rank modulo a prime isn't larger than over Q.
        """
        room = self.room(m)
        if room < 0:
            return 0
        n = affordable(room + m + 6, f"the number of zeros of a form of degree {m}")
        q = prime or PRIMES[0]
        demand(q > 2 * n and fmpz(q).is_prime(), "the modulus is a large prime")
        if point is None:
            den = reduced(self.den, q)
            point = next(c for c in range(LONGEST + 1) if int(den(c)))
        forms = self.forms_modulo(m, n, q, point)
        return m + 1 - int(nmod_mat([[int(form[j]) for j in range(room + 1, n)] for form in forms], q).rank())

    def forms_modulo(self, m: int, n: int, q: int, c: int) -> list[Any]:
        """n terms at the point c of the y1^(m-i) y2^i, divided by prod p^v."""
        den = reduced(self.den, q, c)
        demand(int(den[0]), "the point is ordinary")
        num = reduced(self.num, q, c).left_shift(2)
        y1 = frobenius(den, num, 0, n, q)[0]
        y2 = frobenius(den, num, 1, n, q)[0].left_shift(1)
        scale = nmod([1], q)
        for place in self.places[:-1]:
            v = place.least_valuation(m)
            power = reduced(place.p, q, c).truncate(n).pow_trunc(abs(v), n)
            scale = scale.mul_low(power.inverse_series_trunc(n) if v > 0 else power, n)
        return [scale.mul_low(y1.pow_trunc(m - i, n), n).mul_low(y2.pow_trunc(i, n), n) for i in range(m + 1)]

    def no_omega(self, item: dict[str, Any]) -> None:
        """No omega in Q(x) is the only one: no solution's is A/(den B) modulo a prime, deg B <= the number of zeros."""
        demand_keys(item, "evidence", "kind degree prime place")
        degree = item["degree"]
        prime = item["prime"]
        name = item["place"]
        demand(is_whole(degree) and degree >= -1, "the degree is one, or -1")
        if degree < 0:
            demand_equal((prime, name), (None, ""), "prime and place, without a degree,")
        else:
            demand(is_whole(prime) and name, "a prime and a place belong to a degree")
        if self.most_zeros is not None:
            demand_equal(degree, self.most_zeros, "the largest number of zeros")
        if self.zeros() >= 0:
            self.no_expansion(prime, name)

    def no_expansion(self, prime: int | None, name: str) -> None:
        """At a place that tells the solutions apart, none has an omega with so few zeros, modulo the prime."""
        apart = [place for place in self.places if place.tells_solutions_apart]
        place = self.place(name) if name else apart[0]
        demand(place in apart, "the place tells the solutions apart")
        q, root = next(place.roots([prime] if prime else PRIMES), (0, 0))
        demand(q > 10**6 and fmpz(q).is_prime(), "the place has a root modulo a large prime")
        degree = self.zeros()
        den = reduced(place.den, q, root)
        top = degree + den.degree() + max(p.k for p in self.places)
        count = affordable(top + degree + 12, "the number of zeros of a solution")
        for w in place.expansions(root, q, count):
            multiple = den.right_shift(place.nu).mul_low(w, count)  # A/B, if w is that of a rational function
            found = least_denominator(multiple, count, top) <= degree
            demand(not found, "no expansion of omega is that of a rational function")

    def zeros(self) -> int:
        """The most zeros at ordinary points that a solution with an omega in Q(x) can have, or more; -1 if there is none.

        By Fuchs' relation: the exponents at the singular points and the zeros add up to 1.
        """
        if self.most_zeros is not None:
            return affordable(self.most_zeros, "the number of zeros of a solution")
        total = 1 - sum((place.exponents() for place in self.places if place.k), arb(0))
        if total < 0:
            return -1
        return affordable(total.upper().floor().unique_fmpz(), "the number of zeros of a solution")

    @cached_property
    def most_zeros(self) -> int | None:
        """The largest number of zeros that the exponents leave, -1 for none; None where they aren't easily known."""
        if any(place.has_no_rational_omega for place in self.places):
            return -1
        places = [place for place in self.places if place.k]
        halves = [place.half_difference for place in places]
        if None in halves:
            return None
        total = 1 - sum((fmpq(place.size * place.nu, 2) for place in places), fmpq(0))
        total -= sum((half for place, half in zip(places, halves, strict=True) if place.logarithm), fmpq(0))
        return largest_natural_sum(total, [place.half_difference for place in places if not place.logarithm])


def largest_natural_sum(total: Any, choices: list[Any]) -> int | None:
    """The largest natural number among `total` plus or minus each choice; -1 for none, None for too many fractional parts."""
    unit = lcm(int(total.q), *(int(choice.q) for choice in choices))  # all in units of 1/unit
    start = int(total * unit)
    largest = {start % unit: start}  # for each fractional part that a sum can have
    for choice in choices:
        step = int(choice * unit)
        sums = [value - step for value in largest.values()] + [value + step for value in largest.values()]
        largest = {value % unit: value for value in sorted(sums)}
        if len(largest) > LONGEST:
            return None
    return max(largest.get(0, -1) // unit, -1)


def least_denominator(series: Any, count: int, top: int) -> int:
    """The least degree of a B != 0 with B series = A + O(t^count), deg A <= top.

    By Euclid's algorithm for t^count and the series: deg B = count - deg r0 for the remainder r0 before A.
    """
    r0 = nmod([1], series.modulus()).left_shift(count)
    r1 = series
    while r1.degree() > top:
        r0, r1 = r1, r0 % r1
    return int(count - r0.degree())


# ------------------------------------------------------------------------------------------- forms


@dataclass(frozen=True)
class Form:
    """F = y_1 ... y_m in the solutions with F'/F = slope and prod (W - y_i'/y_i) = sum (-1)^k N_k/G^k W^(m-k)."""

    slope: Value
    G: Any
    N: list[Any]

    @property
    def has_one_factor(self) -> bool:
        """F = y1^2, of degree 2: the discriminant is zero."""
        return bool(self.N[1] * self.N[1] == 4 * self.N[2])

    def modulo(self, modulus: Any) -> Form:
        """The same with its polynomials reduced modulo that of c."""
        slope = Value(divmod(self.slope.num, modulus)[1], divmod(self.slope.den, modulus)[1])
        return Form(slope, divmod(self.G, modulus)[1], [divmod(value, modulus)[1] for value in self.N])

    @property
    def discriminant(self) -> Value:
        """(y1'/y1 - y2'/y2)^2, of degree 2."""
        return Value(self.N[1] ** 2 - 4 * self.N[2], self.G**2)


def form(data: dict[str, Any], m: int, S: Value, names: dict[str, Value], modulus: Any = C) -> Form:
    """The form of degree m with F'/F = theta + P'/P, over Q(c), c a root of the modulus; or over Q.

    By N_0 = 1, (k + 1) N_(k+1) = G N_k' + (N_1 - k G') N_k - (m - k + 1) G^2 S N_(k-1) there is one exactly if N_(m+1) = 0
    [Kovacic 1986, section 5.2].
    """
    demand_equal(data["degree"], m, "the degree of a form")
    P = read(data["P"], names)
    demand(P.den.is_constant() and P.num != 0 and is_monic(P.num), "P is a monic polynomial")
    slope = read(data["theta"], names) + P.derivative() / P
    G = slope.den * (S.den // slope.den.gcd(S.den))
    T = S.num * (G * G // S.den)
    first = slope.num * (G // slope.den)
    if slope.has_c:
        N = numerators(m, lambda f: f.derivative(1), G, T, first)
    else:  # polynomials in x alone are far faster
        alone = (in_one_variable(f, 1) for f in (G, T, first))
        N = [from_one_variable(f) for f in numerators(m, lambda f: f.derivative(), *alone)]
    demand(divmod(N.pop(), modulus)[1] == 0, f"there is this form of degree {m}")
    return Form(slope, G, N)


def numerators(m: int, derivative: Callable[[Any], Any], G: Any, T: Any, first: Any) -> list[Any]:
    """N_0, ..., N_(m+1), for T = G^2 S and the given N_1."""
    N = [G**0, first]
    for k in range(1, m + 1):
        total = G * derivative(N[k]) + (first - k * derivative(G)) * N[k] - (m - k + 1) * T * N[k - 1]
        N.append(total * fmpq(1, k + 1))
    return N


def residues(slope: Value) -> list[tuple[Any, int]]:
    """The factors of the denominator of F'/F, and the residues there; only a rational F passes: simple poles, and integers."""
    num, den = slope.over_q()
    simple = num.degree() < den.degree() and den.gcd(den.derivative()).degree() == 0
    demand(simple, "a form is a rational function")
    found = [(p / p[p.degree()], num * den.derivative().xgcd(p)[1] % p) for p, _ in den.factor()[1]]
    demand(all(value.degree() <= 0 and value[0].q == 1 for _, value in found), "a form is a rational function")
    return [(p, int(value[0].p)) for p, value in found]


def inverse_has_an_integral(factors: list[tuple[Any, int]]) -> Any:
    """Is 1/prod p^v = num/den = (A/E)', E = gcd(den, den')?  A linear system for A, which is unique up to multiples of E."""
    affordable(sum(abs(v) * p.degree() for p, v in factors), "the degree of a form")
    num = prod((p ** max(-v, 0) for p, v in factors), start=X**0)
    den = prod((p ** max(v, 0) for p, v in factors), start=X**0)
    E = den.gcd(den.derivative())
    size = affordable(max(num.degree() - den.degree() + E.degree() + 2, E.degree() + 1), "the degree of a form")
    columns = [(X**i).derivative() * den - X**i * (E.derivative() * den // E) for i in range(size)] + [num * E]
    height = max(column.degree() for column in columns) + 1
    rows = [[column[k] for column in columns] for k in range(height)]
    return fmpq_mat(height, size + 1, list(chain(*rows))).rank() == size - 1


# ------------------------------------------------------------------------------------------- groups

#: The order of the finite groups, for n = 1.
SIZES = {"cyclic": 1, "dicyclic": 4, "tetrahedral": 24, "octahedral": 48, "icosahedral": 120}
NAMES = {
    "cyclic": "mu_{n}",
    "cyclic1": "trivial",
    "additive": "G_a extended by mu_{n}",
    "additive1": "G_a",
    "borel": "Borel",
    "multiplicative": "G_m",
    "dicyclic": "dicyclic of order {order}",
    "infinite dihedral": "N(T)",
    "SL2": "SL2",
    "tetrahedral": "SL(2,3)",
    "octahedral": "binary octahedral",
    "icosahedral": "SL(2,5)",
}

#: A family of subgroups of SL2(C), and its n.
Family = tuple[str, int | None]


def as_json(number: int | None) -> int | str | None:
    """An integer of more than 4,300 digits is a text in JSON."""
    return number if number is None or number < 10**4300 else str(fmpz(number))


def check_group(group: dict[str, Any], family: str, n: int | None, used: set[str]) -> None:
    """Everything that is said of the group follows from its family; the evidence that is given is what was used."""
    demand_keys(group, "the group", "name order finite", "family n function orders")
    order = SIZES[family] * (n or 1) if family in SIZES else None
    size = as_json(order)
    degree = as_json(n)
    name = NAMES.get(f"{family}{degree}", NAMES[family]).format(n=degree, order=size)
    expected = {"name": name, "order": size, "finite": order is not None, "family": family, "n": degree}
    for key in set(expected) & set(group):
        demand_equal(group[key], expected[key], f"the {key} of the group")
    demand(set(group) & {"function", "orders"} == used, "the group needs this evidence")


def reducible_group(places: list[Place], F: Form | None) -> Family:
    """The upper triangular matrices with c on the diagonal, c^n = 1 or any c, or fewer: F is the rational form of degree 2.

    y1^n is rational exactly if n omega has integral residues and no other poles; these residues are exponents, (1 + Delta)/2 or
    (1 - Delta)/2, and whole numbers.  Without F there is one omega only, and the group contains all of G_a.  If F = y1 y2 has
    different factors, the group is diagonal.  If F = y1^2, then y2 = y1 int dx/F [Kovacic 1986, section 1; Hendriks & van der
    Put, J. Symb. Comp. 19 (1995)].
    """
    differences = [place.difference for place in places]
    n = None if None in differences else lcm(*(((1 + d) / 2).q for d in differences))
    if F is None:
        return ("borel", None) if n is None else ("additive", n)
    if not F.has_one_factor:
        return ("multiplicative", None) if n is None else ("cyclic", n)
    return ("cyclic", n) if inverse_has_an_integral(residues(F.slope)) else ("additive", n)


@dataclass(frozen=True)
class Imprimitive:
    """An imprimitive group: f = y1 y2 is a form with two factors that are exchanged, and u = y1/y2.

    H = (u'/u)^2, and eta = du/u = sqrt(H) dx is a differential on the curve z^2 = H.  If the equation is Fuchsian, eta has
    simple poles only, with the residues Delta and -Delta (1 and -1 at an ordinary point, where y1 or y2 is zero).  The group
    is dicyclic of order 4n, n least with u^n a function on the curve, or N(T) if there is no such n.
    A rule is a method that tells the family, or None where it doesn't apply; RULES has their order.
    """

    exclusions: Exclusions
    slope: Value
    H: Value
    group: dict[str, Any]
    names: dict[str, Value]

    def infinite_monodromy(self) -> Family | None:
        """An irregular place, or an exponent difference that isn't rational: an element of infinite order."""
        return (
            ("infinite dihedral", None) if any(place.difference is None for place in self.exclusions.places) else None
        )

    def three_pairs_of_lines(self) -> Family | None:
        """f isn't defined over Q: its conjugates are further pairs of lines; three pairs belong to the quaternion group."""
        return ("dicyclic", 2) if self.slope.has_c else None

    def genus_zero(self) -> Family | None:
        """Two branch points: every divisor of degree 0 is that of a function, and n the common denominator of the residues."""
        return ("dicyclic", self.denominator) if self.eta.branch_points == 2 else None

    def first_kind(self) -> Family | None:
        """A differential without poles, on a curve of positive genus: its integral is no logarithm of a function."""
        return None if self.eta.poles else ("infinite dihedral", None)

    def no_torsion(self) -> Family | None:
        """The divisor D of l eta, l the common denominator, has no finite order.

        Reduction modulo a prime of good reduction is injective on classes of finite order: orders that differ prove that there
        is none.
        """
        if not self.group.get("orders"):
            return None
        for entry in the_list(self.group["orders"], "the evidence"):
            demand_keys(entry, "an order", "prime order")
        shown = {order_modulo(entry["prime"], entry["order"], self.eta) for entry in self.group["orders"]}
        demand(len(shown) > 1, "the order isn't finite")
        return "infinite dihedral", None

    def function(self) -> Family | None:
        """n log u is half the logarithm of f = prod (a + b y)^e over its conjugate, plus the integral of w dx/y, y^2 = h.

        The differential of this is an identity of rational functions, up to the sign of u.  With w = 0, and a norm of f that is
        a constant times a square, u^n is a function; n is the least one if it is no power of another function.  With w dx/y
        holomorphic and not 0 no power of u is a function: what is left would be the logarithm of one, without poles.
        """
        data = self.group.get("function")
        if not data:
            return None
        demand_keys(data, "the function", "multiple h pieces rest")
        f = CurveFunction.read(data, self.names)
        n = whole(data["multiple"])
        demand(n > 0, "a multiple of log u is taken")
        rest = polynomial(read(data["rest"], self.names))
        total = f.logarithmic_derivative() + Value(from_one_variable(rest))
        square = self.H * Value(from_one_variable(f.h)) * Value(PLANE.constant(n)) ** 2
        demand((total * total).equals(square), "the differential of f is that of a power of u")
        if rest != 0:
            demand(rest.degree() < (f.h.degree() - 1) // 2, "the rest is holomorphic")
            return "infinite dihedral", None
        G = f.root_of_norms()
        for prime, _ in fmpz(n).factor():
            demand(f.is_no_power(int(prime), G), f"the function isn't a power with the exponent {prime}")
        return "dicyclic", n

    #: In this order; the second place is the evidence that a rule uses.
    RULES = (
        (infinite_monodromy, ""),
        (three_pairs_of_lines, ""),
        (genus_zero, ""),
        (first_kind, ""),
        (no_torsion, "orders"),
        (function, "function"),
    )

    def decide(self) -> tuple[Family, set[str]]:
        """The family, and the evidence that was used."""
        for rule, evidence in self.RULES:
            family = rule(self)
            if family is not None:
                return family, {evidence} - {""}
        raise NotImplementedError("the order of a group on a curve of positive genus")

    @cached_property
    def eta(self) -> Differential:
        num, den = self.H.over_q()
        *finite, infinity = self.exclusions.places
        poles = [Pole(place.p, place.difference) for place in finite if den % place.p**2 == 0]
        singular = prod((place.p for place in finite), start=X**0)
        poles += [Pole(p, fmpq(1)) for p, _ in den.factor()[1] if den % p**2 == 0 and singular % p != 0]
        if den.degree() - num.degree() == 2:
            poles.append(Pole(None, infinity.difference))
        return Differential(num, den, poles)

    @property
    def denominator(self) -> int:
        """The common denominator of the residues of eta."""
        return lcm(*(int(pole.residue.q) for pole in self.eta.poles))


def whole(value: Any) -> int:
    """An integer, or the text of a long one."""
    if isinstance(value, str) and value.isdecimal():
        return int(fmpz(value))
    demand(is_whole(value), "an exponent is an integer")
    return int(value)


def polynomial(value: Value) -> Any:
    """The polynomial over Q that is this value."""
    num, den = value.over_q()
    demand(den.degree() == 0, "a polynomial has no denominator")
    return num


def from_one_variable(f: Any) -> Any:
    """The polynomial in x as one in c and x."""
    return PLANE.from_dict({(0, k): f[k] for k in range(f.degree() + 1)})


class Piece(NamedTuple):
    """(a + b y)^exponent on a curve y^2 = h."""

    exponent: int
    a: Any
    b: Any

    @classmethod
    def read(cls, data: dict[str, Any], names: dict[str, Value]) -> Piece:
        demand_keys(data, "a piece", "exponent a b")
        return cls(whole(data["exponent"]), polynomial(read(data["a"], names)), polynomial(read(data["b"], names)))

    def norm(self, h: Any) -> Any:
        return self.a * self.a - h * self.b * self.b

    def value(self, x: int, y: int, q: int) -> int:
        """At a point modulo q, over the norm to the power of the integral part of exponent/2; 0 where a norm is 0."""
        even = int(self.a(x))
        odd = int(self.b(x)) * y
        norm = (even - odd) * (even + odd) % q
        return pow(even + odd, self.exponent, q) * pow(norm, -(self.exponent // 2), q) % q if norm else 0


@dataclass(frozen=True)
class CurveFunction:
    """f, the product of the pieces, on the curve y^2 = h."""

    h: Any
    pieces: list[Piece]

    @classmethod
    def read(cls, data: dict[str, Any], names: dict[str, Value]) -> CurveFunction:
        h = polynomial(read(data["h"], names))
        demand(h.degree() >= 3 and h.gcd(h.derivative()).degree() == 0, "h has no square factor")
        return cls(h, [Piece.read(entry, names) for entry in the_list(data["pieces"], "the pieces")])

    def logarithmic_derivative(self) -> Value:
        """R, where R dx/y is half of d log of f over its conjugate."""
        h = self.h
        total = Value(PLANE.constant(0))
        for e, a, b in self.pieces:
            odd = (b.derivative() * h + b * h.derivative() / 2) * a - a.derivative() * b * h
            total += Value(from_one_variable(odd * e), from_one_variable(a * a - h * b * b))
        return total

    def root_of_norms(self) -> Any:
        """G, where the norm of the product of the pieces with odd exponents is a constant times G^2."""
        product = prod((piece.norm(self.h) for piece in self.pieces if piece.exponent % 2), start=X**0)
        factors = product.factor()[1]
        demand(all(k % 2 == 0 for _, k in factors), "the norm of f is a square")
        return prod((p ** (k // 2) for p, k in factors), start=X**0)

    def is_no_power(self, exponent: int, G: Any) -> bool:
        """Isn't f/G, divided by the norms, an l-th power, up to a constant?

        Else its values at all points over F_q, q = 1 modulo l, lie in one class modulo l-th powers.
        """
        affordable(exponent // 10**9, "a prime factor of the order")
        first = exponent * (2**41 // exponent) + 1
        moduli = (q for q in range(first, 2**62, exponent) if fmpz(q).is_prime())
        for q in islice(moduli, 30):
            f = self.modulo(q)
            demand(f.h.gcd(f.h.derivative()).degree() == 0, f"{q} is a good prime")
            classes = {pow(value, (q - 1) // exponent, q) for value in f.values(reduced(G, q), q)}
            if len(classes) > 1:
                return True
        return False

    def modulo(self, q: int) -> CurveFunction:
        return CurveFunction(reduced(self.h, q), [Piece(e, reduced(a, q), reduced(b, q)) for e, a, b in self.pieces])

    def values(self, G: Any, q: int) -> Iterator[int]:
        """The values of f/G, divided by the norms, at points modulo q, neither zeros nor poles of a part of it."""
        for x in range(60):
            square = fmpz(int(self.h(x)))
            root = int(G(x))
            if square.jacobi(q) == 1 and root:
                y = int(square.sqrtmod(q))
                value = pow(root, -1, q)
                for piece in self.pieces:
                    value = value * piece.value(x, y, q) % q
                if value:
                    yield value


class Pole(NamedTuple):
    """The points over the roots of a factor, or over infinity (None), and the residue of a differential at one of each two."""

    factor: Any
    residue: Any


@dataclass(frozen=True)
class Differential:
    """eta = sqrt(num/den) dx, with simple poles only."""

    num: Any
    den: Any
    poles: list[Pole]

    @property
    def branch_points(self) -> int:
        """Of the curve y^2 = num/den, infinity included."""
        factors = self.num.factor()[1] + self.den.factor()[1]
        odd = sum(int(p.degree()) for p, k in factors if k % 2)
        return odd + int(self.den.degree() - self.num.degree()) % 2

    def moved(self, q: int) -> Differential:
        """In the coordinate t, x = r + 1/t, where num/den isn't a square modulo q at r: no place is at infinity."""
        product = reduced(self.num * self.den, q)
        r = next(r for r in range(q) if fmpz(int(product(r))).jacobi(q) == -1)

        def flipped(f: Any) -> Any:
            return fmpq_poly(f(X + r).coeffs()[::-1])

        poles = [Pole(X if pole.factor is None else flipped(pole.factor), pole.residue) for pole in self.poles]
        shift = self.den.degree() - self.num.degree() - 4  # dx = -dt/t^2
        num = flipped(self.num) * X ** max(shift, 0)
        den = flipped(self.den) * X ** max(-shift, 0)
        return Differential(num, den, poles)


class Points(NamedTuple):
    """The points over the roots of u, with y = v there, no two of them conjugate: what they are is told by (u, y - v)."""

    u: Any
    v: Any


@dataclass(frozen=True)
class ClassGroup:
    """The classes of divisors on y^2 = h modulo a prime, where h has an even degree and its first coefficient is no square.

    The two points at infinity are conjugate, so that Points E of an even degree stand for the class of E less deg E/2 times
    both; each class has Points of the degree deg h/2 at most, and 0 those without a point only [Cantor, Math. Comp. 48 (1987)].
    """

    h: Any

    def multiple(self, n: int, E: Points) -> Points:
        """n E, by halving n."""
        if n == 0:
            return Points(self.h**0, self.h * 0)
        half = self.multiple(n // 2, E)
        double = self.together(half, half)
        return self.together(double, E) if n % 2 else double

    def together(self, E: Points, F: Points) -> Points:
        """The sum: the ideal of the products of (u, y - v) for both, without the conjugate points over the roots of d."""
        common, a, b = E.u.xgcd(F.u)
        d, c, e = common.xgcd(E.v + F.v)
        u = (E.u // d) * (F.u // d)
        v = c * a * (E.u // d) * F.v + c * b * (F.u // d) * E.v + e * (E.v * F.v + self.h) // d
        return self.reduced(u, v % u)

    def reduced(self, u: Any, v: Any) -> Points:
        """y - v has further zeros, and their conjugates the same class: fewer points, as long as v has the degree to spare."""
        while u.degree() > self.h.degree() // 2:
            u = (self.h - v * v) // u
            v = -v % u
        return Points(u, v)


def order_modulo(q: Any, n: Any, given: Differential) -> int:
    """n, if it is the order modulo q of the class of D = sum l d (P - P'), for eta with the residue d at the points P, l the
    common denominator, P' the conjugate of P."""
    demand(is_whole(q) and is_whole(n) and n > 0, "prime and order are integers")
    demand(2 < q < 2**63 and fmpz(q).is_prime(), "an order is one modulo an odd prime")
    eta = given.moved(q)
    points = prod(p for p, _ in eta.num.factor()[1] + eta.den.factor()[1])
    distinct = reduced(points, q)
    demand(distinct.gcd(distinct.derivative()).degree() == 0, f"{q} is a good prime: no points meet")
    group, D = class_of_poles(q, eta)
    divisors = [n // int(p) for p, _ in fmpz(n).factor()]
    is_zero = {k: group.multiple(k, D).u.degree() == 0 for k in [n, *divisors]}
    demand(is_zero.pop(n) and not any(is_zero.values()), f"{n} is the order modulo {q}")
    return int(n)


def class_of_poles(q: int, eta: Differential) -> tuple[ClassGroup, Points]:
    """The curve modulo q, and D: P - P' is 2 P, up to what stands for 0.

    With num den = h t^2 and y = den sqrt(num/den)/t, the residue of eta over a root of f is d = y (t/f) / (f' den/f^2).
    """
    squares = [(p, k // 2) for p, k in eta.num.factor()[1] + eta.den.factor()[1]]
    t = prod((p**k for p, k in squares), start=X**0)
    group = ClassGroup(reduced(eta.num * eta.den // t**2, q))
    l = lcm(*(int(pole.residue.q) for pole in eta.poles))  # noqa: E741
    D = Points(group.h**0, group.h * 0)
    for pole in eta.poles:
        f = reduced(pole.factor, q)
        above = reduced(eta.den // pole.factor**2, q)
        below = reduced(t // pole.factor, q)
        d = int(pole.residue.p) * pow(int(pole.residue.q), -1, q)
        y = d * f.derivative() * above * (below % f).xgcd(f)[1] % f
        demand((y * y - group.h) % f == 0, "the residues are exponent differences")
        D = group.together(D, group.multiple(2 * int(l * pole.residue), Points(f, y)))
    return group, D


# ------------------------------------------------------------------------------------------- solutions

#: A ring for formulas.  Its last generator is x; a function in a formula gets one that is larger than those of its argument.
TOWER = fmpq_mpoly_ctx.get(tuple(f"t{i}" for i in range(48)), Ordering.lex)
#: The most products of terms in one multiplication.
MOST_PRODUCTS = 10**5
#: Points at which a formula that isn't proven is tried, one beside each half axis; exact ones, with few binary digits.
POINTS = [
    acb(re, im) for re, im in ((1.375, 0.1875), (-0.8125, 0.3125), (0.1875, 1.125), (-0.25, -1.4375), (3.6875, -0.375))
]


class Refined(Exception):
    """A function occurs with a root of a higher order than was known: the formulas are read again."""


class Function:
    """num/den in the generators of a tower, reduced by their algebraic relations."""

    def __init__(self, tower: Tower, num: Any, den: Any = 1) -> None:
        num = tower.normal(TOWER.constant(1) * num)
        den = tower.normal(TOWER.constant(1) * den)
        demand(den != 0, "there is no division by zero")
        if not den.is_constant():
            common = num.gcd(den)
            num = num // common
            den = den // common
        self.tower = tower
        self.num = num / den.leading_coefficient()
        self.den = den / den.leading_coefficient()

    @property
    def key(self) -> str:
        return f"({self.num})/({self.den})"

    @property
    def rational(self) -> Any:
        """The rational number that this is, else None."""
        if self.num.is_constant() and self.den.is_constant():
            return fmpq(self.num.leading_coefficient()) / fmpq(self.den.leading_coefficient()) if self.num else fmpq(0)
        return None

    def product(self, f: Any, g: Any) -> Any:
        if len(f) * len(g) > MOST_PRODUCTS:
            raise NotImplementedError("too long")
        return f * g

    def __mul__(self, other: Function) -> Function:
        return Function(self.tower, self.product(self.num, other.num), self.product(self.den, other.den))

    def __truediv__(self, other: Function) -> Function:
        return Function(self.tower, self.product(self.num, other.den), self.product(self.den, other.num))

    def __add__(self, other: Function) -> Function:
        if self.den == other.den:
            return Function(self.tower, self.num + other.num, self.den)
        num = self.product(self.num, other.den) + self.product(other.num, self.den)
        return Function(self.tower, num, self.product(self.den, other.den))

    def __sub__(self, other: Function) -> Function:
        return self + other * self.tower.number(-1)

    def to_the(self, n: int) -> Function:
        """The n-th power."""
        base = self if n >= 0 else self.tower.number(1) / self
        power = self.tower.number(1)
        for digit in f"{affordable(abs(n), 'a power'):b}":
            power = power * power
            if digit == "1":
                power = power * base
        return power

    def derivative(self) -> Function:
        above, below = self.tower.slope(self.num), self.tower.slope(self.den)
        den = Function(self.tower, self.den)
        return (above - Function(self.tower, self.num) / den * below) / den


@dataclass(frozen=True)
class Generator:
    """A function of x: its derivative, by which alone it is known to a proof, and its value at x, for a refutation."""

    slope: Function
    ball: Callable[[Callable[[Function], Any]], Any]


class Tower:
    """Functions of x, each a polynomial over Q in those before it, or known by its derivative, a rational function of all.

    What is 0 by these rules is the zero function, whichever branches are meant.  Between functions there may be relations
    that aren't known here, so that something else may be zero as well.
    """

    def __init__(self, variable: str, orders: dict[str, int]) -> None:
        self.free = list(TOWER.gens())
        self.generators: list[Generator] = []
        self.relations: list[Any] = []
        self.made: dict[str, Any] = {}
        self.orders = orders  # the roots of a function that occur, as their least common multiple
        self.x = self.new(lambda _: self.number(1), lambda at: None)
        self.names = {variable: self.x}

    def number(self, value: Any) -> Function:
        return Function(self, TOWER.constant(value))

    def normal(self, f: Any) -> Any:
        """f, reduced by the relations; their leading terms are powers of different generators."""
        for relation in self.relations:
            f = divmod(f, relation)[1]
        return f

    def new(
        self,
        slope: Callable[[Function], Function],
        ball: Callable[[Callable[[Function], Any]], Any],
        relation: Callable[[Any], Any] | None = None,
    ) -> Function:
        """A new generator t; its derivative is slope(t), and a monic relation(t) is zero."""
        if not self.free:
            raise NotImplementedError("too long")
        t = self.free.pop()
        if relation is not None:
            self.relations.insert(0, relation(t))  # the largest generator is reduced first
        function = Function(self, t)
        self.generators.append(Generator(self.number(0), ball))
        self.generators[-1] = Generator(slope(function), ball)
        return function

    def once(self, key: str, make: Callable[[], Any]) -> Any:
        """What was made under this key."""
        if key not in self.made:
            self.made[key] = make()
        return self.made[key]

    def slope(self, f: Any) -> Function:
        """The derivative of a polynomial in the generators."""
        total = self.number(0)
        last = TOWER.nvars() - 1
        for i, generator in enumerate(self.generators):
            part = f.derivative(last - i)
            if part != 0:
                total = total + Function(self, part) * generator.slope
        return total

    def balls(self, f: Function) -> list[Any]:
        """Around the values at some points, where the function has one."""
        return [value for value in (self.at(point, f) for point in POINTS) if value.is_finite()]

    def is_refuted(self, f: Function) -> bool:
        """The function is nonzero at two points, and at none does it seem to be zero: a formula may hold on one side only."""
        balls = self.balls(f)
        seem_zero = [ball for ball in balls if ball.contains(0) and abs(ball).upper() < 1e-9]
        return not seem_zero and sum(not ball.contains(0) for ball in balls) > 1

    def at(self, x: Any, function: Function) -> Any:
        """A ball around the value at x."""
        values: list[Any] = []

        def value(f: Function) -> Any:
            return inside(f.num) / inside(f.den)

        def inside(f: Any) -> Any:
            total = acb(0)
            for powers, coefficient in f.to_dict().items():
                term = acb(coefficient)
                for known, power in zip(values, reversed(powers), strict=False):
                    if power:
                        term *= known ** int(power)
                total += term
            return total

        for generator in self.generators:
            values.append(generator.ball(value) if values else x)
        return value(function)

    # --------------------------------------------------------------------------------- what formulas are made of

    def order(self, key: str, q: int) -> int:
        """The order of the root of a function from which all of its roots in the formulas are powers."""
        known = self.orders.get(key, 1)
        if known % q:
            self.orders[key] = affordable(lcm(known, q), "a root")
            raise Refined
        return known

    def power(self, base: Function, exponent: Function) -> Function:
        e = exponent.rational
        if e is None:
            return self.exp(exponent * self.called("log", [base]))
        if e.q == 1:
            return base.to_the(int(e.p))
        # a positive factor has roots of its own: (c f)^e = c^e f^e on all branches
        constant = fmpq(base.num.leading_coefficient())
        found = self.number(1)
        if base.rational is None:
            constant = abs(constant)
            found = self.root(base / self.number(constant), int(e.q)).to_the(int(e.p))
        factors = [(int(p), k) for p, k in fmpz(constant.p).factor()] + [(int(p), -k) for p, k in constant.q.factor()]
        for prime, k in [*factors, (-1, int(constant < 0))]:
            if k:
                found = found * self.root(self.number(prime), int(e.q)).to_the(int(e.p) * int(k))
        return found

    def root(self, base: Function, q: int) -> Function:
        """base^(1/q) for base = n/d: t/d for the root t of n d^(Q-1), an integral one, or a power of that."""
        Q = self.order(base.key, q)
        radicand = self.normal(base.num * base.den ** (Q - 1))
        slope = self.slope(radicand) / Function(self, radicand) / self.number(Q)
        den = Function(self, base.den)

        def make() -> Function:
            return self.new(
                lambda t: t * slope,
                lambda at: at(base) ** (acb(1) / Q) * at(den),
                lambda t: t**Q - radicand,
            )

        root: Function = self.once(f"{Q}-th root of {base.key}", make)
        return (root / den).to_the(Q // q)

    def exp(self, u: Function) -> Function:
        """The product over the terms c m of u, m a quotient of products of generators."""
        found = self.number(1)
        for powers, c in u.num.to_dict().items():
            term = Function(self, TOWER.from_dict({powers: fmpq(1)}), u.den)
            Q = self.order(f"exp {term.key}", int(c.q))
            part = term / self.number(Q)
            slope = part.derivative()
            make = partial(self.new, partial(mul, slope), partial(exp_at, part))
            found = found * self.once(f"exp {part.key}", make).to_the(int(c * Q))
        return found

    def pair(self, key: str, z: Function, second: tuple[Function, Function], balls: tuple[Any, Any]) -> Function:
        """F(z), where F'' = p F' + q F for second = (p, q); F'(z) is a generator before it."""
        found: Function = self.once(key, lambda: self.new_pair(z, second, balls))
        return found

    def new_pair(self, z: Function, second: tuple[Function, Function], balls: tuple[Any, Any]) -> Function:
        slope = z.derivative()
        p, q = second
        F = self.new(lambda t: t, lambda at: balls[0](at(z)))
        G = self.new(lambda t: (p * t + q * F) * slope, lambda at: balls[1](at(z)))
        self.generators[-2] = Generator(G * slope, self.generators[-2].ball)
        self.made[f"derivative of {F.key}"] = G
        return F

    def called(self, name: str, arguments: list[Any]) -> Any:
        """The function of this name."""
        make = CALLS.get(name)
        if make is None:
            raise NotImplementedError(name)
        return make(self, *arguments)


def exp_at(u: Function, at: Callable[[Function], Any]) -> Any:
    return at(u).exp()


def by_derivative(name: str, derivative: Callable[[Tower, Function], Function], ball: Any) -> Callable[..., Function]:
    """A function with this derivative by its argument."""

    def make(tower: Tower, u: Function) -> Function:
        def new() -> Function:
            slope = derivative(tower, u) * u.derivative()
            return tower.new(lambda _: slope, lambda at: ball(at(u)))

        return tower.once(f"{name} {u.key}", new)  # type: ignore[no-any-return]

    return make


def circular(sine: bool) -> Callable[..., Function]:
    def make(tower: Tower, u: Function) -> Function:
        def new() -> tuple[Function, Function]:
            slope = u.derivative()
            c = tower.new(lambda _: tower.number(0), lambda at: at(u).cos())
            s = tower.new(lambda _: c * slope, lambda at: at(u).sin(), lambda t: t**2 + c.num**2 - 1)
            tower.generators[-2] = Generator(tower.number(-1) * s * slope, tower.generators[-2].ball)
            return c, s

        return tower.once(f"cos {u.key}", new)[sine]  # type: ignore[no-any-return]

    return make


def integral(tower: Tower, f: Function, variable: Function) -> Function:
    """An antiderivative: any one, so that its value at a point may be any number."""
    demand(variable.key == tower.x.key, "an integral is one by the variable")
    value = acb(len(tower.generators), 1) / 3
    return tower.once(f"integral {f.key}", lambda: tower.new(lambda _: f, lambda at: value))  # type: ignore[no-any-return]


def over_q(f: Function, letter: Function) -> Any:
    """The polynomial over Q in a generator that this is."""
    i = letter.num.degrees().index(1)
    others = f.num.degrees()[:i] + f.num.degrees()[i + 1 :]
    if any(others) or not f.den.is_constant():
        raise NotImplementedError("a polynomial with other letters")
    return in_one_variable(f.num, i)


def root_of(tower: Tower, polynomial: Function, index: Function) -> Function:
    """A root of a polynomial over Q that is irreducible; it has a value where it is real, and these come first, in order."""
    p = over_q(polynomial, tower.x)
    factors = p.factor()[1]
    demand(len(factors) == 1 and factors[0][1] == 1, "the polynomial of a root is irreducible")
    monic = p / p.leading_coefficient()
    real = sorted((root.real for root, _ in monic.complex_roots() if root.imag == 0), key=float)
    value = acb(dict(enumerate(real)).get(int(index.rational), "nan"))

    def make() -> Function:
        return tower.new(lambda _: tower.number(0), lambda at: value, lambda t: sum_of_powers(monic, t))

    return tower.once(f"root {monic} {index.key}", make)  # type: ignore[no-any-return]


def sum_of_powers(p: Any, t: Any) -> Any:
    return sum((t**k * p[k] for k in range(p.degree() + 1)), start=TOWER.constant(0))


def letter(tower: Tower, name: str) -> Function:
    """A letter that is bound in a sum."""
    return tower.once(f"letter {name}", lambda: tower.new(lambda _: tower.number(0), lambda at: acb("nan")))  # type: ignore[no-any-return]


def root_sum(tower: Tower, polynomial: Function, term: tuple[Function, Function]) -> Function:
    """The sum of c(a) log(x - a) over the roots a of p; its derivative has the residues c(a), and is (c p' modulo p)/p."""
    a, body = term
    slope = body.derivative()  # -c(a)/(a - x)
    p = over_q(polynomial, a)
    if slope.den != a.num - tower.x.num or p.gcd(p.derivative()).degree() > 0:
        raise NotImplementedError("RootSum")
    c = -over_q(Function(tower, slope.num), a)
    x = tower.x.num
    derivative = Function(tower, sum_of_powers(c * p.derivative() % p, x), sum_of_powers(p, x))

    def ball(at: Any) -> Any:
        return sum(
            (acb_poly(c.coeffs())(root) * (at(tower.x) - root).log() for root, _ in p.complex_roots()), start=acb(0)
        )

    return tower.once(f"sum {p} {c}", lambda: tower.new(lambda _: derivative, ball))  # type: ignore[no-any-return]


def inverse_sine(tower: Tower, w: Function) -> Function:
    """asin, whose sine is known to an elliptic integral."""
    slope = w.derivative() / half_power(tower, tower.number(1) - w * w)
    phi: Function = tower.once(f"asin {w.key}", lambda: tower.new(lambda _: slope, lambda at: at(w).asin()))
    tower.made[f"sine of {phi.key}"] = w
    return phi


def elliptic(power: int) -> Callable[..., Function]:
    """F or E: the integral of (1 - m sin^2)^(-1/2), or that of (1 - m sin^2)^(1/2), from 0 to phi = asin(w)."""
    name = "elliptic_f" if power < 0 else "elliptic_e_inc"

    def make(tower: Tower, phi: Function, *rest: Function) -> Function:
        w = tower.made.get(f"sine of {phi.key}")
        if w is None or len(rest) != 1 or rest[0].rational is None:
            raise NotImplementedError("elliptic integrals")
        root = half_power(tower, tower.number(1) - rest[0] * w * w)
        slope = phi.derivative() * root.to_the(power)

        def ball(at: Any) -> Any:
            return getattr(acb, name)(at(phi), at(rest[0]))

        return tower.once(f"{name} {phi.key} {rest[0].key}", lambda: tower.new(lambda _: slope, ball))  # type: ignore[no-any-return]

    return make


def incomplete_gamma(tower: Tower, s: Function, u: Function) -> Function:
    """int_0^u t^(s-1) e^-t dt."""
    demand(s.rational is not None, "the parameter is rational")

    def new() -> Function:
        slope = tower.power(u, s - tower.number(1)) / tower.exp(u) * u.derivative()
        return tower.new(lambda _: slope, lambda at: at(u).gamma_lower(at(s)))

    return tower.once(f"gamma {s.key} {u.key}", new)  # type: ignore[no-any-return]


def hypergeometric(tower: Tower, above: Any, below: Any, z: Function) -> Function:
    """2F1 by Gauss' equation z (1 - z) F'' = a b F - (c - (a + b + 1) z) F', 1F1 by Kummer's z F'' = a F - (c - z) F'."""
    one = tower.number(1)
    if not isinstance(above, tuple) or not isinstance(below, tuple) or (len(above), len(below)) not in ((2, 1), (1, 1)):
        raise NotImplementedError("hyper")
    numbers = [p.rational for p in (*above, *below)]
    if None in numbers:
        raise NotImplementedError("hyper")
    *first, c = numbers
    product = prod(first)
    linear = tower.number(c) - z * (tower.number(sum(first) + 1) if len(first) == 2 else one)
    leading = z * (one - z) if len(first) == 2 else z

    def ball(shift: int) -> Callable[[Any], Any]:
        shifted = [acb(number + shift) for number in numbers]
        values = acb.hypgeom_2f1 if len(first) == 2 else acb.hypgeom_1f1
        return lambda at: values(at, *shifted) * (acb(product / c) if shift else 1)

    second = (tower.number(-1) * linear / leading, tower.number(product) / leading)
    return tower.pair(f"hyper {numbers} {z.key}", z, second, (ball(0), ball(1)))


def bessel(name: str, sign: int) -> Callable[..., Function]:
    """F'' = -F'/z + (n^2/z^2 - sign) F: J and Y for 1, I and K for -1."""

    def make(tower: Tower, n: Function, z: Function) -> Function:
        order = n.rational
        if order is None:
            raise NotImplementedError("a Bessel function of another order")

        def ball(at: Any, shift: int = 0) -> Any:
            return getattr(at, f"bessel_{name}")(acb(order + shift))

        def slope(at: Any) -> Any:  # F_n' = n F_n/z - F_(n+1), with + for I
            return acb(order) * ball(at) / at + (ball(at, 1) if name == "i" else -ball(at, 1))

        p = tower.number(-1) / z
        return tower.pair(f"bessel_{name} {n.key} {z.key}", z, (p, n * n / (z * z) - tower.number(sign)), (ball, slope))

    return make


def airy(index: int) -> Callable[..., Function]:
    """Ai, Ai', Bi, Bi', in this order: F'' = z F."""

    def make(tower: Tower, z: Function) -> Function:
        first = index - index % 2
        balls = (lambda at: at.airy()[first], lambda at: at.airy()[first + 1])
        F = tower.pair(f"airy {first} {z.key}", z, (tower.number(0), z), balls)
        return tower.made[f"derivative of {F.key}"] if index % 2 else F

    return make


def half_power(tower: Tower, f: Function) -> Function:
    return tower.power(f, tower.number(fmpq(1, 2)))


def constant(name: str, ball: Callable[[], Any]) -> Callable[[Tower], Function]:
    """A number between which and other numbers no relation is known."""
    return lambda tower: tower.once(name, lambda: tower.new(lambda _: tower.number(0), lambda at: ball()))


def error_slope(tower: Tower, u: Function, sign: int) -> Function:
    return tower.number(2) * tower.exp(u * u * tower.number(sign)) / half_power(tower, CONSTANTS["pi"](tower))


CONSTANTS: dict[str, Callable[[Tower], Function]] = {
    "pi": constant("pi", acb.pi),
    "E": lambda tower: tower.exp(tower.number(1)),
    "I": lambda tower: half_power(tower, tower.number(-1)),
}
#: The functions that are read, as SymPy writes them.
CALLS: dict[str, Callable[..., Any]] = {
    "exp": Tower.exp,
    "sqrt": half_power,
    "cos": circular(False),
    "sin": circular(True),
    "tan": lambda tower, u: tower.called("sin", [u]) / tower.called("cos", [u]),
    "cosh": lambda tower, u: (tower.exp(u) + tower.number(1) / tower.exp(u)) / tower.number(2),
    "sinh": lambda tower, u: (tower.exp(u) - tower.number(1) / tower.exp(u)) / tower.number(2),
    "log": by_derivative("log", lambda tower, u: tower.number(1) / u, acb.log),
    "atan": by_derivative("atan", lambda tower, u: tower.number(1) / (tower.number(1) + u * u), acb.atan),
    "atanh": by_derivative("atanh", lambda tower, u: tower.number(1) / (tower.number(1) - u * u), acb.atanh),
    "asin": inverse_sine,
    "elliptic_f": elliptic(-1),
    "elliptic_e": elliptic(1),
    "acos": by_derivative("acos", lambda tower, u: tower.number(-1) / half_power(tower, tower.number(1) - u * u), acb.acos),
    "asinh": by_derivative("asinh", lambda tower, u: tower.number(1) / half_power(tower, tower.number(1) + u * u), acb.asinh),
    "Ei": by_derivative("Ei", lambda tower, u: tower.exp(u) / u, acb.ei),
    "erf": by_derivative("erf", lambda tower, u: error_slope(tower, u, -1), acb.erf),
    "erfi": by_derivative("erfi", lambda tower, u: error_slope(tower, u, 1), acb.erfi),
    "erfc": by_derivative("erfc", lambda tower, u: tower.number(-1) * error_slope(tower, u, -1), acb.erfc),
    "lowergamma": incomplete_gamma,
    "Integral": integral,
    "CRootOf": root_of,
    "Lambda": lambda tower, a, body: (a, body),
    "RootSum": root_sum,
    "hyper": hypergeometric,
    "besselj": bessel("j", 1),
    "bessely": bessel("y", 1),
    "besseli": bessel("i", -1),
    "besselk": bessel("k", -1),
    "airyai": airy(0),
    "airyaiprime": airy(1),
    "airybi": airy(2),
    "airybiprime": airy(3),
}  # fmt: skip


class FormulaReader(Reader):
    """Formulas, with the functions of `CALLS`."""

    def __init__(self, text: str, tower: Tower) -> None:
        super().__init__(text, {})
        self.tower = tower

    def number(self, value: Any) -> Any:
        return self.tower.number(value)

    def named(self, name: str) -> Any:
        if name in self.tower.names:
            return self.tower.names[name]
        if self.tokens[-1] == "(":
            if name not in CALLS:
                raise NotImplementedError(name)
            self.tokens.pop()
            return self.tower.called(name, self.listed()[0])
        if name.startswith("_"):
            return letter(self.tower, name)
        if name not in CONSTANTS:
            raise NotImplementedError(name)
        return CONSTANTS[name](self.tower)

    def enclosed(self) -> Any:
        values, is_tuple = self.listed()
        return tuple(values) if is_tuple else values[0]

    def listed(self) -> tuple[list[Any], bool]:
        """What stands between commas up to ")"; is it a tuple, with a comma at least?"""
        values = []
        has_commas = False
        while self.tokens[-1] != ")":
            values.append(self.expression(0))
            if self.tokens[-1] != ")":
                demand(self.tokens.pop() == ",", "each ( has its )")
                has_commas = True
        self.tokens.pop()
        return values, has_commas

    def power(self, base: Any) -> Any:
        return self.tower.power(base, self.operand())


def read_formulas(texts: list[str], tower: Tower) -> tuple[Tower, list[Any]]:
    """The functions, in a tower with the roots that they need; a text in place of one that has a function not known here."""
    while True:
        found: list[Any] = []
        try:
            for text in texts:
                try:
                    found.append(FormulaReader(text, tower).value())
                except NotImplementedError as name:
                    found.append(str(name))
            return tower, found
        except Refined:
            (variable,) = tower.names
            tower = Tower(variable, tower.orders)


# ------------------------------------------------------------------------------------------- answers

REQUIRED = "schema input variable S status case riccati constants verified proof notices seconds"
#: The other keys that an answer has; whatever else is there belongs to the user, as the lines and names of a batch.
OPTIONAL = "field equation gauge generic_conditions group solutions"
NOT_LOOKED_AT = ("input", "notices", "seconds")
NOT_LOOKED_AT_IN_THE_EQUATION = ("change", "f", "h", "text", "unknown")


def demand_names(*names: Any) -> None:
    """Refute the answer unless these are names, all different."""
    demand(all(isinstance(name, str) and name.isidentifier() for name in names), "variables and constants have names")
    demand(len(set(names)) == len(names), "the names are different")


class Answer:
    """One line: the JSON object, the names in its expressions, and S."""

    def __init__(self, data: dict[str, Any]) -> None:
        demand_keys({key: value for key, value in data.items() if key in REQUIRED.split()}, "the answer", REQUIRED)
        self.data = data
        self.proof = data["proof"]
        demand_keys(self.proof, "the proof", "structure semi_invariant invariant excluded undecided")
        demand_names(data["variable"])
        self.structure: str | None = self.proof["structure"]
        self.names = {data["variable"]: Value(X2)}
        self.S = read(data["S"], self.names)
        self.exclusions = Exclusions(*self.S.over_q(), self.names)

    def check(self) -> str:
        """Prove everything that is claimed; what was looked at, and what wasn't."""
        self.heading()
        checked = self.equation()
        self.case()
        checked.append("case")
        f = None
        F = None
        if self.structure is not None:
            f = self.omega(STRUCTURES[self.structure].omega)
            F = self.rational_form(STRUCTURES[self.structure].form)
            checked.append("omega")
        if self.data.get("group") is not None:
            self.group(f, F)
            checked.append("group")
        proven, unproven = self.solutions()
        checked += proven
        return f"{'; '.join(checked)}; not checked: {', '.join([*self.not_looked_at(checked), *unproven])}"

    def solutions(self) -> tuple[list[str], list[str]]:
        """Two independent solutions: what was proven, and what was neither proven nor refuted."""
        texts = self.data.get("solutions")
        if texts is None:
            return [], []
        demand(self.structure is not None, "there are solutions beside a proof that there are none")
        demand(len(the_list(texts, "the solutions")) == 2, "there are two solutions")
        coefficients = self.coefficients()
        if coefficients is None:
            return [], ["solutions"]
        tower, read_ones = read_formulas([*texts, *coefficients], Tower(self.data["variable"], {}))
        *pair, a, b, c = read_ones
        unproven = []
        for k, y in enumerate(pair):
            if isinstance(y, str):
                unproven.append(f"solutions[{k}] ({y})")
                continue
            slope = y.derivative()
            rest = a * slope.derivative() + b * slope + c * y
            if rest.num != 0:
                demand(not tower.is_refuted(rest), f"solutions[{k}] solves the equation")
                unproven.append(f"solutions[{k}]")
        if unproven:
            return [], unproven
        first, second = pair
        wronskian = first * second.derivative() - first.derivative() * second
        demand(wronskian.num != 0, "the solutions are independent")
        if all(ball.contains(0) for ball in tower.balls(wronskian)):
            return [], ["independence of the solutions"]
        return ["solutions"], []

    def coefficients(self) -> list[str] | None:
        """Those of the equation that the solutions solve, a, b and c; None where the variable was changed."""
        equation: Any = self.data.get("equation")
        if equation is None:
            return ["1", "0", f"-({self.data['S']})"]
        if equation["field"] is not None or equation.get("change") is not None:
            return None
        return [equation["a"], equation["b"], equation["c"]]

    def heading(self) -> None:
        """What is said in more than one place is the same."""
        data = self.data
        structure = self.structure
        demand_equal(data["verified"], True, "what the answer says of its own check")
        demand_equal(data["case"], None if structure is None else STRUCTURES[structure].case, "the case")
        demand_equal(data["status"], "none" if structure is None else "liouvillian", "the status")
        demand(data.get("generic_conditions") is None, "an S without parameters has no conditions on them")
        if structure is None:
            beside = [data["riccati"], data["constants"], self.proof["invariant"], self.proof["semi_invariant"]]
            demand(beside == [None] * 4, "there is no solution beside a proof that there is none")

    def equation(self) -> list[str]:
        """y = v exp(int gauge dx) turns a y'' + b y' + c y = 0 into v'' = S v, gauge = -b/(2a) [Kovacic 1986, section 1.1]."""
        equation: Any = self.data.get("equation")
        gauge: Any = self.data.get("gauge")
        if equation is None:
            demand(gauge is None, "a gauge belongs to an equation")
            return self.input()
        demand_keys(equation, "the equation", "text unknown a b c f h field", "change")
        demand(isinstance(gauge, str), "the equation has a gauge")
        if equation["field"] is not None:
            return []
        a, b, c = (read(equation[name], self.names) for name in ("a", "b", "c"))
        demand(a.num != 0, "the equation has second order")
        half = b / (a + a)
        demand(self.S.equals(half.derivative() + half * half - c / a), "S is that of the equation")
        demand(read(gauge, self.names).equals(Value(PLANE.constant(0)) - half), "the gauge is -b/(2a)")
        return ["y'' = S y from a, b, c", "gauge"]

    def input(self) -> list[str]:
        """Where S itself was given, in the notation that can be read here, it is this S; any other notation isn't looked at."""
        text = self.data["input"]
        demand(isinstance(text, str), "the input is a text")
        try:
            given = read(str(text).replace("^", "**"), self.names)
        except (AssertionError, LookupError, ValueError, NotImplementedError):
            return []
        demand(self.S.equals(given), "S is that of the input")
        return ["S from input"]

    def not_looked_at(self, checked: list[str]) -> Iterator[str]:
        """The keys that have no part in what was checked."""
        looked_at = "input" if "S from input" in checked else ""
        yield from (key for key in NOT_LOOKED_AT if key in self.data and key != looked_at)
        yield from self.not_looked_at_in_the_equation("gauge" in checked)
        if "group" in self.data and "group" not in checked:
            yield "group"
        if self.exclusions.most_zeros is None and self.names_zeros():
            yield "degree of no_rational_omega"
        others = set(self.data) - set(REQUIRED.split()) - set(OPTIONAL.split())
        yield from (key if key.isidentifier() else ascii(key)[:60] for key in sorted(others))

    def not_looked_at_in_the_equation(self, has_gauge: bool) -> Iterator[str]:
        equation = self.data.get("equation")
        if equation is None:
            return
        if has_gauge:
            yield from (f"equation.{key}" for key in NOT_LOOKED_AT_IN_THE_EQUATION if key in equation)
        else:
            yield from ("equation", "gauge")

    def names_zeros(self) -> bool:
        """Does the evidence say how many zeros a solution can have?"""
        evidence = chain(*(entry["evidence"] for entry in self.proof["excluded"]))
        return any(item["kind"] == "no_rational_omega" for item in evidence)

    def case(self) -> None:
        """Everything before the structure is excluded, each once and in order; without a structure, all five are."""
        names = list(STRUCTURES)
        required = names if self.structure is None else names[: names.index(self.structure)]
        excluded = the_list(self.proof["excluded"], "what is excluded")
        demand_equal([entry["structure"] for entry in excluded], required, "what is excluded")
        for entry in excluded:
            demand_keys(entry, "an exclusion", "structure case evidence")
            demand_equal(entry["case"], STRUCTURES[entry["structure"]].case, "the case of an exclusion")
            self.exclusions.hold(entry["structure"], entry["evidence"])

    def omega(self, n: int) -> Form:
        """The polynomial of omega is that of a form f of degree n, over Q(c); f, with its polynomials reduced.

        Of degree 6 and 12 it needn't be written out: N_0, ..., N_n follow from f.
        """
        riccati = self.data["riccati"]
        semi_invariant = self.proof["semi_invariant"]
        demand_keys(riccati, "the polynomial of omega", "variable degree coefficients")
        demand_keys(semi_invariant, "the form", "degree theta P D")
        modulus = self.modulus()
        demand_names(riccati["variable"], *self.names)
        f = form(semi_invariant, n, self.S, self.names, modulus)
        self.normal_form(semi_invariant)
        demand_equal(riccati["degree"], n, "the degree of omega")
        a = [f.slope]
        if n < 6 or riccati["coefficients"] is not None:
            a = [read(text, self.names) for text in reversed(the_list(riccati["coefficients"], "the polynomial"))]
            demand_equal(len(a) - 1, n, "the number of coefficients")
            for k in range(n + 1):
                difference = a[k].num * f.G**k - (-1) ** k * f.N[k] * a[k].den
                demand(divmod(difference, modulus)[1] == 0, "the roots of the polynomial solve omega' + omega^2 = S")
        demand(modulus == C or any(value.has_c for value in a), "c occurs in omega")
        return f.modulo(modulus)

    def modulus(self) -> Any:
        """The polynomial of c, which is irreducible, so that Q(c) is a field; c itself stands for none."""
        constants = self.data["constants"]
        if constants is None:
            return C
        demand_keys(constants, "the constant", "symbol minimal_polynomial")
        demand_names(constants["symbol"], *self.names)
        self.names[constants["symbol"]] = Value(C)
        polynomial = read(constants["minimal_polynomial"], self.names)
        demand(polynomial.den.is_constant() and polynomial.num.degrees()[1] <= 0, "c has a polynomial over Q")
        modulus = in_one_variable(polynomial.num, 0) / fmpq(polynomial.den.leading_coefficient())
        factors = modulus.factor()[1]
        demand(len(factors) == 1 and factors[0][1] == 1, "the polynomial of c is irreducible")
        demand(
            modulus.degree() > 1 and modulus.leading_coefficient() == 1,
            "the polynomial of c is monic, and c irrational",
        )
        return polynomial.num

    def normal_form(self, semi_invariant: dict[str, Any]) -> None:
        """P has its zeros at ordinary points, and D is the product of the factors p^((k + 1)//2) of the places."""
        P = read(semi_invariant["P"], self.names)
        D = read(semi_invariant["D"], self.names)
        demand(P.num.gcd(self.S.den).is_constant(), "P has its zeros at ordinary points")
        expected = prod((place.p ** ((place.k + 1) // 2) for place in self.exclusions.places[:-1]), start=X**0)
        found, below = D.over_q()
        demand(below == 1 and found == expected, "D is the denominator of omega")

    def rational_form(self, m: int) -> Form | None:
        """The rational form of degree m that shows the structure; a reducible group with one omega only has none."""
        data = self.proof["invariant"]
        if data is None:
            demand(self.structure == "reducible" and self.exclusions.dimension(2) == 0, "omega is unique")
            return None
        demand_keys(data, "the rational form", "degree theta P")
        F = form(data, m, self.S, self.names)
        residues(F.slope)
        return F

    def group(self, f: Form | None, F: Form | None) -> None:
        """The group is the one that is named: SL2, a finite primitive one, or found by the forms."""
        group = self.data["group"]
        used = set[str]()
        demand_keys(group, "the group", "name order finite", "family n function orders")
        family: Family = self.structure or "SL2", None
        if self.structure == "reducible":
            family = reducible_group(self.exclusions.places, F)
        elif self.structure == "imprimitive" and f is not None:
            family, used = Imprimitive(self.exclusions, f.slope, f.discriminant, group, self.names).decide()
        check_group(group, *family, used)


def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object, whose keys must be different."""
    found = dict(pairs)
    if len(found) < len(pairs):
        raise Unreadable("a key occurs twice in one object")
    return found


def no_number(name: str) -> None:
    """NaN and Infinity are no JSON."""
    raise Unreadable(f"{name} is no number")


def verdict(line: str) -> str:
    """What is to be said of one line."""
    try:
        data = json.loads(line, object_pairs_hook=once, parse_constant=no_number)
        if not isinstance(data, dict) or repr(data.get("schema")) != "1" or data.get("field") is not None:
            return "not checked: no answer in schema 1 for an S with rational coefficients"
        if data.get("status") in ("error", "solved") and "case" not in data:
            return "not checked: the line says why there is no answer, or is one of dsolve's"
        if data["proof"]["undecided"] is not None:
            return f"not checked: the answer is undecided: {data['proof']['undecided']!r}"
        with ctx.workprec(333):
            return f"checked: {Answer(data).check()}"
    except (json.JSONDecodeError, Unreadable) as error:
        return f"unreadable: {error}"
    except AssertionError as claim:
        return f"refuted: it isn't shown that {claim}"
    except (RuntimeError, StopIteration) as reason:
        return f"not checked: {str(reason) or type(reason).__name__}"
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        return f"refuted: malformed ({type(error).__name__})"


def verdicts(lines: Iterator[str], seconds: float = 60) -> Iterator[str]:
    """The verdicts, found by a process that is ended, and replaced, where a line takes longer."""
    with multiprocessing.Pool(1) as pool:
        for line in lines:
            try:
                yield pool.apply_async(verdict, [line]).get(seconds)
            except multiprocessing.TimeoutError:
                pool.terminate()
                yield from chain([f"not checked: it takes more than {seconds:g} s"], verdicts(lines, seconds))


def main(files: list[str]) -> int:
    """Check all lines of the files; the exit status."""
    statuses: set[int] = set()
    sys.stdin = sys.stdin or io.StringIO()  # one that is closed is empty
    try:
        with fileinput.input(files, encoding="utf-8") as lines:
            for said in verdicts(filter(str.strip, lines)):
                statuses.add(("checked", "refuted", "unreadable", "not checked").index(said.partition(":")[0]))
                print(f"{lines.filename()}:{lines.filelineno()}: {said}")
    except (OSError, UnicodeError) as error:
        print(f"checker: {error}", file=sys.stderr)
        return 2
    if not statuses:
        print("checker: nothing to check", file=sys.stderr)
        return 2
    return min(statuses - {0}, default=0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
