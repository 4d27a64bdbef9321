"""An independent check of kovacic's answers: reads them as JSON lines and proves them anew, sharing no code with the program.

    python checker.py answers.jsonl          (or kovacic check answers.jsonl; "-" reads standard input)

For each line one of

    checked: y'' = S y from a, b, c; gauge; case; omega; group; solutions; not checked: input, notices, seconds, ...
    refuted: why
    not checked: why                         (parameters, too large, more than a minute)
    unreadable: why                          (no JSON, or a key twice in one object)

Exit status: 0 all checked, 1 one refuted, 2 one unreadable, or nothing to check, 3 one not checked.
It needs only Python 3.11 and python-flint.  It changes FLINT's global precision, so it must run in one thread of a process.

The meaning of "checked", for an S over K(x), K = Q or a number field, given by an irreducible polynomial:
- S from input: S was given, with + - * / ^ and parentheses, and is this one.
- y'' = S y from a, b, c, and gauge: S = (b/a)'/2 + (b/a)^2/4 - c/a and gauge = -b/(2a), where an equation was given.
- case, omega, of a "yes": the product of W - omega over the conjugates of omega = y'/y belongs to a form in the solutions, over
  K(c)(x), c a root of an irreducible polynomial; and no smaller degree is possible, by the exclusions.
  Where the solution is exp(int theta) P with a P too long to be listed, by the recurrence for its coefficients.
- case, of a "no": the group is neither reducible nor imprimitive nor finite and primitive, each excluded by a local condition
  at places of S, or by the absence of a rational form in the solutions (a rank modulo a prime can only be smaller than over
  K) and, if reducible, of a single rational omega (its expansion, modulo a prime, isn't that of a rational function with few
  poles).
- group: its family, n, order and name follow from the above and from its evidence.
- solutions: both satisfy the equation, by exact differentiation, and their Wronskian isn't zero.  A solution with an unknown
  function is named ("solutions[1] (zeta)"), and so is one that differentiation alone doesn't prove, as relations between roots
  depend on their branches ("solutions[1]"); a residual that is nonzero at several points is refuted.
Every key is looked at, or named after "not checked", or refused.  The reader has to compare those that aren't looked at:
`input` and `equation.text` with a, b and c, or with S.

Read it from the end: `CheckedAnswer.check` is the table of contents.

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
from contextlib import suppress
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
    arb,
    ctx,
    fmpq,
    fmpq_mat,
    fmpq_mpoly_ctx,
    fmpq_poly,
    fmpz,
    nmod_mat,
)
from flint import nmod_poly as nmod

# Degrees and terms of series: larger ones could fill the memory before the minute for a line is over.
LARGEST_COMPUTED = 10_000
LARGE_PRIMES = [q for q in range(2**60 + 33, 2**60 + 20_000, 2) if fmpz(q).is_prime()]


class Unreadable(Exception):
    """The line isn't a JSON object in which each key occurs once."""


def demand(holds: Any, claim: str) -> None:
    """Refute the answer unless the claim holds."""
    if not holds:
        raise AssertionError(claim)


def demand_equal(found: Any, expected: Any, what: str) -> None:
    """Refute the answer unless the two are equal and of the same type: true isn't 1."""
    demand(repr(found) == repr(expected), f"{what} is {expected!r}")


def demand_keys(data: Any, what: str, required: str, optional: str = "") -> None:
    """Refute the answer unless this is an object with the required keys, and no others than the optional ones."""
    demand(isinstance(data, dict), f"{what} is an object")
    missing = {*required.split()} - {*data}
    unknown = {*data} - {*required.split(), *optional.split()}
    demand(not missing, f"{what} has the key {min(missing, default='')!r}")
    demand(not unknown, f"{what} has a key {ascii(min(unknown, default=''))[:60]}")


def the_list(value: Any, what: str) -> list[Any]:
    """The value, which must be a list."""
    demand(isinstance(value, list), f"{what} is a list")
    return list(value)


def affordable(size: Any, what: str) -> int:
    """The size; gives up on one that is unknown, or would make a computation too long."""
    if size is None or size > LARGEST_COMPUTED:
        raise NotImplementedError(f"{what} is too large")
    return int(size)


# ------------------------------------------------------------------------------------------- formulas

#: Polynomials in x (the last generator), a generator t of the number field, and a constant c of omega.
PLANE = fmpq_mpoly_ctx.get(("c", "t", "x"), Ordering.lex)
C, T, X2 = PLANE.gens()
X = fmpq_poly([0, 1])
#: A ring for solutions.  Its last generator is x; each function in a formula gets a larger one than its argument has.
TOWER = fmpq_mpoly_ctx.get(tuple(f"t{i}" for i in range(48)), Ordering.lex)
#: Products of terms in one multiplication: the gcd that reduces the result takes some 4 s there, and a line has a minute.
MOST_PRODUCTS = 10**5
#: Exact points, one near each half axis, at which an unproven formula is evaluated.
POINTS = [
    acb(re, im) for re, im in ((1.375, 0.1875), (-0.8125, 0.3125), (0.1875, 1.125), (-0.25, -1.4375), (3.6875, -0.375))
]


#: The rules for a generator's value, from those before it, and for its derivative, from itself.
BallRule = Callable[[Callable[[Any], Any]], Any]
Slope = Callable[[Any], Any]


class Refined(Exception):
    """A function occurs with a root of a new order: the formulas have to be read again."""


class TowerFunction:
    """num/den in the generators of a tower, reduced by their algebraic relations."""

    def __init__(self, tower: Tower, num: Any, den: Any = 1) -> None:
        num = tower.normal(tower.one * num)
        den = tower.normal(tower.one * den)
        demand(den != 0, "there is no division by zero")
        if not den.is_constant():
            common = num.gcd(den)
            num = num // common
            den = den // common
        self.tower = tower
        leading = den.leading_coefficient()
        self.num = num if leading == 1 else num / leading
        self.den = den if leading == 1 else den / leading

    @property
    def key(self) -> str:
        return f"({self.num})/({self.den})"

    @property
    def rational(self) -> Any:
        """The value as a rational number, else None."""
        if self.num.is_constant() and self.den.is_constant():
            return self.num.leading_coefficient() if self.num else fmpq(0)
        return None

    def product(self, f: Any, g: Any) -> Any:
        if len(f) * len(g) > MOST_PRODUCTS and self.tower.has_functions:
            raise NotImplementedError("too long")
        return f * g

    def __mul__(self, other: TowerFunction) -> TowerFunction:
        return TowerFunction(self.tower, self.product(self.num, other.num), self.product(self.den, other.den))

    def __truediv__(self, other: TowerFunction) -> TowerFunction:
        return TowerFunction(self.tower, self.product(self.num, other.den), self.product(self.den, other.num))

    def __add__(self, other: TowerFunction) -> TowerFunction:
        if self.den == other.den:
            return TowerFunction(self.tower, self.num + other.num, self.den)
        num = self.product(self.num, other.den) + self.product(other.num, self.den)
        return TowerFunction(self.tower, num, self.product(self.den, other.den))

    def __sub__(self, other: TowerFunction) -> TowerFunction:
        return self + other * self.tower.number(-1)

    def to_the(self, n: int) -> TowerFunction:
        """The n-th power."""
        leading = str(self.num.leading_coefficient()).strip("1") if self.num else ""
        affordable(abs(n) * max(len(leading), *self.num.degrees(), *self.den.degrees(), 1), "a power")
        base = self if n >= 0 else self.tower.number(1) / self
        power = self.tower.number(1)
        for digit in f"{abs(n):b}":
            power = power * power
            if digit == "1":
                power = power * base
        return power

    def derivative(self) -> TowerFunction:
        above, below = self.tower.slope(self.num), self.tower.slope(self.den)
        den = TowerFunction(self.tower, self.den)
        return (above - TowerFunction(self.tower, self.num) / den * below) / den


class Tower:
    """Functions of x, each a root of a polynomial in those before it, or given by its derivative, a rational function of all.

    An expression that is 0 by these rules is the zero function on all branches.  There may be further relations between the
    functions, so that others may be zero as well.  Proofs use the derivatives alone, refutations the values, as balls.
    """

    def __init__(self, variable: str, ring: Any = TOWER, orders: dict[str, int] | None = None) -> None:
        self.ring = ring
        self.has_functions = ring is TOWER
        self.one = ring.constant(1)
        self.free = list(ring.gens())
        self.slopes: list[TowerFunction] = []
        self.values: list[BallRule] = []
        self.relations: list[Any] = []
        self.made: dict[str, Any] = {}
        self.families: dict[str, list[TowerFunction]] = {}
        self.arcsines: dict[str, TowerFunction] = {}
        # the least common multiple of the orders of the roots of each function
        self.orders = {} if orders is None else orders
        self.x = self.new("x", lambda _: self.number(1), lambda at: None)
        self.names = {variable: self.x}

    def number(self, value: Any) -> TowerFunction:
        return TowerFunction(self, self.ring.constant(value))

    def normal(self, f: Any) -> Any:
        """f, reduced by the relations; their leading terms are powers of different generators."""
        for relation in self.relations:
            f = divmod(f, relation)[1]
        return f

    def new(self, key: str, slope: Slope, ball: BallRule, relation: Slope | None = None) -> Any:
        """The generator t under this key; its derivative is slope(t), and a monic relation(t) is zero."""
        if key in self.made:
            return self.made[key]
        if not self.free:
            raise NotImplementedError("too long")
        t = self.free.pop()
        if relation is not None:
            self.relations.insert(0, relation(t))  # the largest generator is reduced first
        self.made[key] = function = TowerFunction(self, t)
        i = len(self.values)
        self.slopes.append(self.number(0))
        self.values.append(ball)
        self.slopes[i] = slope(function)  # in which there may be new generators
        return function

    def constant(self, key: str, relation: Slope | None = None, value: Any = None) -> Any:
        """A constant with this value, which may satisfy a relation."""
        return self.new(key, lambda _: self.number(0), lambda at: acb("nan") if value is None else value, relation)

    def adjoin(self, name: str, constant: TowerFunction) -> None:
        """A name for a constant."""
        demand(name not in self.names, "the names are different")
        self.names[name] = constant

    def slope(self, f: Any) -> TowerFunction:
        """The derivative of a polynomial in the generators."""
        total = self.number(0)
        last = self.ring.nvars() - 1
        for i, slope in enumerate(self.slopes):
            part = f.derivative(last - i)
            if part != 0 and slope.num != 0:
                total = total + TowerFunction(self, part) * slope
        return total

    def balls(self, f: TowerFunction) -> list[Any]:
        """The values at `POINTS`, as far as they are finite."""
        return [value for value in (self.at(point, f) for point in POINTS) if value.is_finite()]

    def is_refuted(self, f: TowerFunction) -> bool:
        """True if the function is nonzero at two points, and nowhere seems to be zero: a formula may hold on one side only."""
        balls = self.balls(f)
        seem_zero = [ball for ball in balls if ball.contains(0) and abs(ball).upper() < 1e-9]
        return not seem_zero and sum(not ball.contains(0) for ball in balls) > 1

    def at(self, x: Any, function: TowerFunction) -> Any:
        """A ball around the value at x."""
        values: list[Any] = []

        def value(f: TowerFunction) -> Any:
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

        for ball in self.values:
            values.append(ball(value) if values else x)
        return value(function)

    # --------------------------------------------------------------------------------- parts of formulas

    def read(self, text: str, **bound: TowerFunction) -> Any:
        """The formula in these letters."""
        return Reader(text, self, bound).value()

    def order(self, key: str, q: int) -> int:
        """The order Q such that all roots of this function in the formulas are powers of its Q-th root."""
        known = self.orders.get(key, 1)
        if known % q:
            self.orders[key] = affordable(lcm(known, q), "a root")
            raise Refined
        return known

    def power(self, base: TowerFunction, exponent: TowerFunction) -> TowerFunction:
        e = exponent.rational
        if e is not None and e.q == 1:
            return base.to_the(int(e.p))
        demand(self.has_functions, "an exponent is an integer")
        if e is None:
            return self.exp(exponent * self.called("log", [base]))
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

    def root(self, base: TowerFunction, q: int) -> TowerFunction:
        """base^(1/q) for base = n/d: t/d for the root t of n d^(Q-1), an integral one, or a power of that."""
        Q = self.order(base.key, q)
        radicand = self.normal(base.num * base.den ** (Q - 1))
        slope = self.slope(radicand) / TowerFunction(self, radicand) / self.number(Q)
        den = TowerFunction(self, base.den)
        key = f"{Q}-th root of {base.key}"
        root = self.new(
            key, lambda t: t * slope, lambda at: at(base) ** (acb(1) / Q) * at(den), lambda t: t**Q - radicand
        )
        power: TowerFunction = (root / den).to_the(Q // q)
        return power

    def exp(self, u: TowerFunction) -> TowerFunction:
        """The product over the terms c m of u, m a quotient of products of generators."""
        found = self.number(1)
        for powers, c in u.num.to_dict().items():
            term = TowerFunction(self, TOWER.from_dict({powers: fmpq(1)}), u.den)
            Q = self.order(f"exp {term.key}", int(c.q))
            part = term / self.number(Q)
            root = self.new(
                f"exp {part.key}", partial(mul, part.derivative()), partial(lambda u, at: at(u).exp(), part)
            )
            found = found * root.to_the(int(c * Q))
        return found

    def called(self, name: str, arguments: list[Any]) -> Any:
        """The function of this name."""
        if name == "sin" and arguments[0].key in self.arcsines:
            return self.arcsines[arguments[0].key]
        if name in CALLS:
            return CALLS[name](self, *arguments)
        if name in ABBREVIATIONS:
            return self.read(ABBREVIATIONS[name], u=arguments[0])
        for family in FAMILIES:
            if name in family.split():
                member = self.family(family, arguments)[family.split().index(name)]
                if name == "asin":
                    self.arcsines[member.key] = arguments[0]
                return member
        raise NotImplementedError(name)

    def family(self, name: str, arguments: list[Any]) -> list[TowerFunction]:
        """F, and perhaps G, given by their derivatives."""
        letters, *members = FAMILIES[name]
        bound = dict(zip(letters.split(), arguments, strict=False))
        is_rational = all(value.rational is not None for letter, value in bound.items() if letter != "u")
        if len(arguments) != len(letters.split()) or not is_rational:
            raise NotImplementedError(name)
        key = family_key(name, arguments)
        if key not in self.families:
            balls = {
                F: partial(lambda ball, at: ball(*map(at, arguments)), ball)
                for F, (_, ball) in zip("FG", members, strict=False)
            }
            found = {F: self.new(f"{F} of {key}", lambda _: self.number(0), ball) for F, ball in balls.items()}
            self.families[key] = list(found.values())
            if name == "cos sin":
                self.relations.insert(0, self.read("F**2 + G**2 - 1", **found).num)
            for function, (slope, _) in zip(found.values(), members, strict=True):
                by_x = self.read(slope, **bound, **found) * bound["u"].derivative()
                self.slopes[self.ring.nvars() - 1 - function.num.degrees().index(1)] = by_x
        return self.families[key]


def family_key(name: str, arguments: list[TowerFunction]) -> str:
    return " ".join([name, *(value.key for value in arguments)])


def any_antiderivative(tower: Tower, f: TowerFunction, variable: TowerFunction) -> Any:
    """An antiderivative: any one, so its value at a point may be any number."""
    if not isinstance(variable, TowerFunction):
        raise NotImplementedError("a definite integral")
    demand(variable.key == tower.x.key, "an integral is one by the variable")
    value = acb(len(tower.values), 1) / 3
    return tower.new(f"integral {f.key}", lambda _: f, lambda at: value)


def over_q(f: TowerFunction, letter: TowerFunction) -> Any:
    """The function as a polynomial over Q in a generator."""
    i = letter.num.degrees().index(1)
    others = f.num.degrees()[:i] + f.num.degrees()[i + 1 :]
    if any(others) or not f.den.is_constant():
        raise NotImplementedError("a polynomial with other letters")
    return in_one_variable(f.num, i)


def in_one_variable(f: Any, i: int) -> Any:
    """The polynomial in the i-th variable, without the others."""
    terms = {powers[i]: coefficient for powers, coefficient in f.to_dict().items()}
    return fmpq_poly([terms.get(n, fmpq(0)) for n in range(max(terms, default=0) + 1)])


def monic_irreducible(p: Any) -> Any:
    """p over its leading coefficient; it must be irreducible."""
    factors = p.factor()[1]
    demand(len(factors) == 1 and factors[0][1] == 1, "the polynomial of a root is irreducible")
    return p / p.leading_coefficient()


def indexed_root(tower: Tower, polynomial: TowerFunction, index: TowerFunction) -> Any:
    """A root of an irreducible polynomial over Q; the real ones come first, in order, and have a value."""
    p = monic_irreducible(over_q(polynomial, tower.x))
    real = sorted((root.real for root, _ in p.complex_roots() if root.imag == 0), key=float)
    value = acb(dict(enumerate(real)).get(int(index.rational), "nan"))
    return tower.constant(f"root {p} {index.key}", partial(at_generator, p), value)


def at_generator(p: Any, t: Any) -> Any:
    """p(t) in the ring of t."""
    return sum((t**k * p[k] for k in range(p.degree() + 1)), start=0 * t)


def root_sum(tower: Tower, polynomial: TowerFunction, term: tuple[TowerFunction, TowerFunction]) -> Any:
    """The sum of c(a) log(x - a) over the roots a of p; its derivative has the residues c(a), and is (c p' modulo p)/p."""
    a, body = term
    slope = body.derivative()  # -c(a)/(a - x)
    p = over_q(polynomial, a)
    if slope.den != a.num - tower.x.num or p.gcd(p.derivative()).degree() > 0:
        raise NotImplementedError("RootSum")
    c = -over_q(TowerFunction(tower, slope.num), a)
    x = tower.x.num
    derivative = TowerFunction(tower, at_generator(c * p.derivative() % p, x), at_generator(p, x))

    def ball(at: Any) -> Any:
        terms = (acb_poly(c.coeffs())(root) * (at(tower.x) - root).log() for root, _ in p.complex_roots())
        return sum(terms, start=acb(0))

    return tower.new(f"sum {p} {c}", lambda _: derivative, ball)


def hypergeometric_value(tower: Tower, *arguments: Any) -> Any:
    """pFq of two lists of parameters; by a known one if they differ by 1, as for derivatives."""
    lists = [part for part in arguments if isinstance(part, tuple)]
    name = "F".join(str(len(part)) for part in lists) or "pFq"
    *parameters, z = *chain(*lists), *arguments[len(lists) :]
    one = tower.number(1)
    if name == "1F1" and (parameters[1] - parameters[0] - one).num == 0:
        return tower.called("1F1+", [parameters[0], z])
    if name in NEIGHBOURS:
        lower, upper = ([value - one for value in parameters], [value + one for value in parameters])
        *above, below = lower
        if family_key(name, [*lower, z]) in tower.families and all(value.num != 0 for value in lower):
            return tower.family(name, [*lower, z])[1] * below / prod(above, start=one)
        if family_key(name, [*upper, z]) in tower.families and parameters[-1].num != 0:
            F, G = tower.family(name, [*upper, z])
            bound = dict(zip(FAMILIES[name][0].split(), [*parameters, z], strict=True))
            return tower.read(NEIGHBOURS[name], F=F, G=G, **bound)
    return tower.called(name, [*parameters, z])


#: Functions of u, written in others.
ABBREVIATIONS = {
    "sqrt": "u**(1/2)",
    "cbrt": "u**(1/3)",
    "tan": "sin(u)/cos(u)",
    "cosh": "(exp(u) + exp(-u))/2",
    "sinh": "(exp(u) - exp(-u))/2",
}
Member = tuple[str, Callable[..., Any]]


def bessel_family(kind: str, above: str, below: str) -> tuple[str, Member, Member]:
    """F = C_n and G = C_(n+1): F' = n F/u +- G and G' = +-F - (n + 1) G/u [DLMF 10.6.2, 10.29.2]."""
    C = f"bessel_{kind}"
    first = f"n/u*F {above} G", lambda n, u: getattr(u, C)(n)
    return "n u", first, (f"{below}F - (n + 1)/u*G", lambda n, u: getattr(u, C)(n + 1))


#: Functions of u and of rational parameters: the arguments, and for F, or F and G, the derivative by u and the value.
FAMILIES: dict[str, tuple[Any, ...]] = {
    "log": ("u", ("1/u", acb.log)),
    "atan": ("u", ("1/(1 + u**2)", acb.atan)),
    "atanh": ("u", ("1/(1 - u**2)", acb.atanh)),
    "asin": ("u", ("1/sqrt(1 - u**2)", acb.asin)),
    "acos": ("u", ("-1/sqrt(1 - u**2)", acb.acos)),
    "asinh": ("u", ("1/sqrt(1 + u**2)", acb.asinh)),
    "Ei": ("u", ("exp(u)/u", acb.ei)),
    "erf": ("u", ("2*exp(-u**2)/sqrt(pi)", acb.erf)),
    "erfi": ("u", ("2*exp(u**2)/sqrt(pi)", acb.erfi)),
    "erfc": ("u", ("-2*exp(-u**2)/sqrt(pi)", acb.erfc)),
    "cos sin": ("u", ("-G", acb.cos), ("F", acb.sin)),
    "elliptic_f": ("u m", ("1/sqrt(1 - m*sin(u)**2)", acb.elliptic_f)),
    "elliptic_e": ("u m", ("sqrt(1 - m*sin(u)**2)", acb.elliptic_e_inc)),
    "lowergamma": ("s u", ("u**(s - 1)*exp(-u)", lambda s, u: u.gamma_lower(s))),
    "airyai airyaiprime": ("u", ("G", lambda u: u.airy()[0]), ("u*F", lambda u: u.airy()[1])),
    "airybi airybiprime": ("u", ("G", lambda u: u.airy()[2]), ("u*F", lambda u: u.airy()[3])),
    "besselj": bessel_family("j", "-", ""),
    "bessely": bessel_family("y", "-", ""),
    "besseli": bessel_family("i", "+", ""),
    "besselk": bessel_family("k", "-", "-"),
    # 1F1(s; s + 1; u) = s u^(-s) int u^(s - 1) exp(u) du
    "1F1+": ("s u", ("s*(exp(u) - F)/u", lambda s, u: u.hypgeom_1f1(s, s + 1))),
    # Kummer's and Gauss' equations, with F' = (a b/c) F with all parameters larger by 1
    "1F1": (
        "a c u",
        ("G", lambda a, c, u: u.hypgeom_1f1(a, c)),
        ("(a*F - (c - u)*G)/u", lambda a, c, u: a / c * u.hypgeom_1f1(a + 1, c + 1)),
    ),
    "2F1": (
        "a b c u",
        ("G", lambda a, b, c, u: u.hypgeom_2f1(a, b, c)),
        (
            "(a*b*F - (c - (a + b + 1)*u)*G)/(u*(1 - u))",
            lambda a, b, c, u: a * b / c * u.hypgeom_2f1(a + 1, b + 1, c + 1),
        ),
    ),
}
#: A function in terms of F, the one with all parameters larger by 1, and G = F', by its equation: (a b/c) F is its derivative.
NEIGHBOURS = {"1F1": "(u*G + (c - u)*F)/c", "2F1": "(u*(1 - u)*G + (c - (a + b + 1)*u)*F)/c"}
CONSTANTS: dict[str, Callable[[Tower], Any]] = {
    # no relation between pi and other numbers is used
    "pi": lambda tower: tower.constant("pi", value=acb.pi()),
    "E": lambda tower: tower.exp(tower.number(1)),
    "I": lambda tower: tower.read("sqrt(-1)"),
}
#: The other functions that are read, as SymPy writes them.
CALLS: dict[str, Callable[..., Any]] = {
    "exp": Tower.exp,
    "root": lambda tower, u, n: tower.power(u, tower.number(1) / n),
    "Integral": any_antiderivative,
    "CRootOf": indexed_root,
    "Lambda": lambda tower, a, body: (a, body),
    "RootSum": root_sum,
    "hyper": hypergeometric_value,
}

#: The precedence of an operator, and its function.
OPERATIONS: dict[str, tuple[int, Callable[[Any, Any], Any]]] = {
    "+": (1, add),
    "-": (1, sub),
    "*": (2, mul),
    "/": (2, truediv),
    "**": (3, pow),
}


class Reader:
    """Expressions with + - * / **, parentheses and the functions that the tower knows, as the program prints them."""

    def __init__(self, text: str, tower: Tower, bound: dict[str, Any]) -> None:
        self.text = text
        self.tower = tower
        self.names = tower.names | bound
        wholes = [rf"(?<!\w){re.escape(name)}(?!\w)" for name in self.names if not name.isidentifier()]  # as sqrt(2)
        self.tokens = [*re.findall("|".join([*wholes, r"[0-9]+|\w+|\*\*|\S"]), text), ""][::-1]

    def value(self) -> Any:
        """The value of the whole text."""
        value = self.expression(0)
        demand(self.tokens == [""], f"{self.text[:60]!r} can be read")
        return value

    def expression(self, least: int) -> Any:
        """The expression as far as its operators have at least this precedence."""
        value = self.operand()
        while self.tokens[-1] in OPERATIONS and OPERATIONS[self.tokens[-1]][0] >= least:
            operator = self.tokens.pop()
            strength, apply = OPERATIONS[operator]
            if operator == "**":
                value = self.tower.power(value, self.operand())
                demand(self.tokens[-1] != "**", "a power isn't an exponent")
            else:
                value = apply(value, self.expression(strength + 1))
        return value

    def operand(self) -> Any:
        token = self.tokens.pop()
        if token == "-":
            return self.tower.number(0) - self.expression(3)
        if token == "(":
            values, is_tuple = self.listed()
            return tuple(values) if is_tuple or not values else values[0]
        return self.tower.number(fmpq(fmpz(token))) if token.isdecimal() else self.named(token)

    def listed(self) -> tuple[list[Any], bool]:
        """The expressions up to ")", and True for a tuple, that is, with a comma."""
        values = []
        has_commas = False
        while self.tokens[-1] != ")":
            values.append(self.expression(0))
            if self.tokens[-1] != ")":
                demand(self.tokens.pop() == ",", "each ( has its )")
                has_commas = True
        self.tokens.pop()
        return values, has_commas

    def named(self, name: str) -> Any:
        if name in self.names:
            return self.names[name]
        demand(self.tower.has_functions, f"{ascii(name)[:60]} is known")
        if self.tokens[-1] == "(":
            self.tokens.pop()
            return self.tower.called(name, self.listed()[0])
        if name.startswith("_"):  # a letter that is bound in a sum
            return self.tower.constant(f"letter {name}")
        if name not in CONSTANTS:
            raise NotImplementedError(name)
        return CONSTANTS[name](self.tower)


# ------------------------------------------------------------------------------------------- number fields

# K = Q[t]/modulus; the modulus of Q itself is t.  A polynomial over K is one in t and x.


def degree(f: Any) -> int:
    """The degree in x; -1 for zero."""
    return int(f.degrees()[2]) if f != 0 else -1


def by_powers(f: Any, i: int) -> dict[int, Any]:
    """The coefficients of the powers of the i-th generator."""
    parts = dict[int, dict[Any, Any]]()
    for powers, value in f.to_dict().items():
        rest = tuple(0 if k == i else power for k, power in enumerate(powers))
        parts.setdefault(int(powers[i]), {})[rest] = value
    return {power: PLANE.from_dict(terms) for power, terms in parts.items()}


def over_k(f: Any) -> dict[int, Any]:
    """The polynomials over Q in x that belong to the powers of t."""
    demand(f == 0 or f.degrees()[0] == 0, "the constants lie in the field")
    return {power: in_one_variable(part, 2) for power, part in by_powers(f, 1).items()}


def is_monic(f: Any) -> bool:
    """True if the leading coefficient is 1."""
    return bool(by_powers(f, 2)[degree(f)] == 1)


def modulo(f: Any, q: int) -> Any:
    """A polynomial over Q modulo q."""
    demand(int(f.denom()) % q, f"{q} is a good prime")
    return nmod([int(c) % q for c in f.numer().coeffs()], q) * pow(int(f.denom()), -1, q)


def reduced(f: Any, q: int) -> Any:
    """A polynomial over Q modulo q, which must keep its degree."""
    image = modulo(f, q)
    demand(image.degree() == f.degree(), f"{q} is a good prime")
    return image


def image(f: Any, q: int, t: int, point: int) -> Any:
    """f(z + point) in z modulo q, for a polynomial over K whose generator has the image t; the degree must be kept."""
    total = sum((modulo(part, q) * pow(t, power, q) for power, part in over_k(f).items()), start=nmod([0], q))
    demand(total.degree() == degree(f), f"{q} is a good prime")
    return total.compose(nmod([point % q, 1], q)) if point else total


def simple_roots_modulo(p: Any, q: int) -> list[int]:
    """The simple roots of a polynomial over Q modulo q, in order."""
    return sorted(int(root) for root, k in reduced(p, q).roots() if k == 1)


class AlgebraicPoint:
    """A root r of a polynomial over K: t and r in Q[g]/P, with g = r + shift t, and all of its conjugates over K."""

    def __init__(self, modulus: Any, P: Any, t: Any, r: Any) -> None:
        self.modulus = modulus
        self.P = P
        self.t = t
        self.r = r
        self.size = int(P.degree() // modulus.degree())

    def at(self, f: Any) -> Any:
        """f(t, r) in Q[g]/P."""
        total = fmpq_poly(0)
        for power, part in over_k(f).items():
            total += self.composed(part, self.r) * self.composed(X**power, self.t) % self.P
        return total

    def composed(self, part: Any, r: Any) -> Any:
        """The value of a polynomial over Q at an element of Q[g]/P."""
        if r == X % self.P:
            return part % self.P
        total = fmpq_poly(0)
        for c in reversed(part.coeffs()):
            total = (total * r + c) % self.P
        return total

    def taylor(self, f: Any, count: int) -> list[Any]:
        """The first coefficients of f(t, r + z) as a series in z."""
        found = []
        for k in range(count):
            found.append(self.at(f))
            f = f.derivative(2) * fmpq(1, k + 1)
        return found

    def inverse(self, value: Any) -> Any:
        return value.xgcd(self.P)[1]

    def quotient(self, num: list[Any], den: list[Any]) -> list[Any]:
        """The quotient of two series of the same length."""
        inverse = self.inverse(den[0])
        found: list[Any] = []
        for n, value in enumerate(num):
            found.append((value - sum(map(mul, found, den[n:0:-1]), start=fmpq_poly(0))) * inverse % self.P)
        return found

    def roots(self, moduli: Iterable[int] = LARGE_PRIMES) -> Iterator[tuple[int, int]]:
        """The primes modulo which P has a simple root, and the least one."""
        return ((q, roots[0]) for q in moduli if (roots := simple_roots_modulo(self.P, q)))

    def image(self, f: Any, q: int, g: int) -> Any:
        """f(t, r + z) in z modulo q, for a root g of P."""
        return image(f, q, int(modulo(self.t, q)(g)), int(modulo(self.r, q)(g)))

    @cached_property
    def minimal(self) -> Any:
        """The minimal polynomial of r over K: r^size in the basis t^i r^j of Q[g]/P."""
        if self.modulus.degree() == 1:
            return at_generator(self.P, X2)
        n = self.P.degree()
        exponents = [(i, j) for j in range(self.size) for i in range(self.modulus.degree())]
        basis = [self.at(T**i * X2**j) for i, j in exponents]
        coordinates = fmpq_mat(n, n, [value[k] for k in range(n) for value in basis])
        top = self.at(X2**self.size)
        solved = coordinates.solve(fmpq_mat(n, 1, [top[k] for k in range(n)])).entries()
        return X2**self.size - PLANE.from_dict({(0, *e): c for e, c in zip(exponents, solved, strict=True)})


def points_of(f: Any, modulus: Any) -> list[tuple[AlgebraicPoint, int]]:
    """The roots of a polynomial over K, and their multiplicities.

    With R the norm of f(x - s t), a polynomial in x and s, R(r + s t, s) = 0, so that t = -R_s/R_x at x = r + s t [Rouillier,
    AAECC 9 (1999)].  The result shows whether the shift s is a good one.
    """
    if degree(f) <= 0:
        return []
    relation = at_generator(modulus, T)
    for shift in range(40):
        norm = relation.resultant(f.compose(C, T, X2 - (C + shift) * T), "t")
        parts = by_powers(norm, 0)
        R, slope = (in_one_variable(parts.get(k, 0 * C), 2) for k in (0, 1))
        found = []
        for factor, k in R.factor()[1]:
            P = factor / factor.leading_coefficient()
            rest = P ** (k - 1)
            t = -(slope // rest) * (R.derivative() // rest).xgcd(P)[1] % P
            found.append((AlgebraicPoint(modulus, P, t, (X - shift * t) % P), k))
        are_roots = all(value == 0 for point, k in found for value in [point.at(relation), *point.taylor(f, k)])
        if are_roots and sum(point.size * k for point, k in found) == degree(f):
            return found
    raise NotImplementedError("a factorization over the number field")


# ------------------------------------------------------------------------------------------- local data


def frobenius(E: Any, M: Any, e: int, count: int, q: int) -> tuple[Any, bool]:
    """The series a such that t^e a solves t^2 E y'' = M y modulo q; False if that would need a logarithm."""
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


class LocalPlace(AlgebraicPoint):
    """A point with the multiplicity k in den, where S = num/den; infinity as z = 0 for S(1/z)/z^4."""

    def __init__(self, point: AlgebraicPoint, k: int, num: Any, den: Any, infinite: bool = False) -> None:
        super().__init__(point.modulus, point.P, point.t, point.r)
        self.k = k
        self.num = num
        self.den = den
        self.infinite = infinite
        self.name = "infinity" if infinite else str(self.P)
        self.nu = max(k // 2, 1)  # the order of a pole of omega, for k even or 1
        self.is_irregular = k > 2
        self.is_ramified = k > 2 and k % 2 == 1

    @cached_property
    def leading(self) -> Any:
        """For k = 2 Delta^2 = 1 + 4b, S = b/(x - r)^2 + ...; for k > 2 the first coefficient up to a square."""
        if self.k < 2:
            return fmpq_poly(1)
        num = self.at(self.num)
        den = self.taylor(self.den, self.k + 1)[self.k]
        return num * den % self.P if self.is_irregular else (1 + 4 * num * self.inverse(den)) % self.P

    @cached_property
    def difference(self) -> Any:
        """Delta >= 0, the difference of the exponents, if it is a rational number (1 at an ordinary point)."""
        if self.is_irregular or self.leading.degree() > 0:
            return None
        square = self.leading[0]
        root = fmpq(isqrt(int(max(square.p * square.q, 0))), square.q)
        return root if root * root == square else None

    @property
    def can_branch(self) -> bool:
        """True if the square root of a rational form can branch here.  The local group must exchange two lines."""
        if self.is_irregular:
            return self.is_ramified
        return self.difference is not None and self.difference.q == 2

    @property
    def tells_solutions_apart(self) -> bool:
        """True if at most two solutions, up to constants, have an omega in the Laurent series here."""
        return self.k > 0 and (self.difference is None or self.difference.q > 1 or self.logarithm)

    def local(self, g: int, q: int) -> tuple[Any, Any]:
        """E and M with S = M/(z^max(k, 2) E), x = r + z, modulo q, where g is a root of P."""
        num = self.image(self.num, q, g)
        den = self.image(self.den, q, g)
        demand(not any(int(den[i]) for i in range(self.k)) and int(den[self.k]), f"{q} keeps the order of a pole")
        return den.right_shift(self.k), num.left_shift(max(2 - self.k, 0))

    @cached_property
    def logarithm(self) -> bool:
        """True if there is provably a logarithm.

        At a simple pole, for Delta = 0, and for Delta = n > 0 if modulo a prime the series with the smaller exponent can't be
        continued at its n-th term.
        """
        if self.k == 1 or self.difference == 0:
            return True
        if self.k != 2 or self.difference is None or self.difference.q > 1:
            return False
        if degree(self.den) == 2:
            values = self.taylor(self.num, degree(self.num) + 1)
            steps = [k for k, value in enumerate(values) if k and value != 0]
            if len(steps) < 2:  # z^2 y'' = (a + b z^d) y: term n needs term 0 exactly if d divides n
                return bool(steps) and int(self.difference) % steps[0] == 0
        n = affordable(self.difference, "an exponent difference")
        q, g = next(self.roots())
        return not frobenius(*self.local(g, q), (1 - n) * pow(2, -1, q) % q, n + 1, q)[1]

    def is_not_a_square(self) -> bool:
        """True if `leading` is no square in K(r), proven by a prime modulo which it isn't one."""
        return any(fmpz(int(reduced(self.leading, q)(g))).jacobi(q) == -1 for q, g in islice(self.roots(), 40))

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

    def half_differences(self, t: Any) -> list[Any]:
        """Balls around half the difference of the exponents, up to its sign, at the conjugates for a root t of the modulus."""
        if self.difference is not None:
            return [acb(self.difference) / 2] * self.size
        above = [g for g, _ in self.P.complex_roots() if acb_poly([acb(c) for c in self.t.coeffs()])(g).overlaps(t)]
        return [self.half_difference_at(g) for g in above]

    def half_difference_at(self, g: Any) -> Any:
        """From s = z^(2 nu) S: the root of 1/4 + s_0, or at an irregular place the coefficient of z^(nu - 1) in that of s."""
        nu = self.nu
        num = [acb(0)] * (2 * nu - self.k) + self.series_at(self.num, g, nu)
        den = self.series_at(self.den, g, self.k + nu)[self.k :]
        s: list[Any] = []
        root: list[Any] = []
        for n in range(nu):
            s.append((num[n] - sum(map(mul, s, den[n:0:-1]), start=acb(0))) / den[0])
            rest = s[n] - sum(map(mul, root[1:n], root[n - 1 : 0 : -1]), start=acb(0))
            root.append(rest / (2 * root[0]) if n else rest.sqrt())
        return root[-1] if self.is_irregular else (s[0] + acb(1) / 4).sqrt()

    def series_at(self, f: Any, g: Any, count: int) -> list[Any]:
        """f(t, r + z) for a root g of P in C."""
        t, r = (acb_poly([arb(c) for c in value.coeffs()])(g) for value in (self.t, self.r))
        total = acb_poly([0])
        for power, part in over_k(f).items():
            total += acb_poly([arb(c) for c in part.coeffs()])(acb_poly([r, 1])) * t**power
        return [total[k] for k in range(count)]

    def expansions(self, g: int, q: int, count: int) -> Iterator[Any]:
        """The series w = z^nu omega modulo q of the solutions that have one, where the place tells the solutions apart."""
        E, M = self.local(g, q)
        s = M.mul_low(E.inverse_series_trunc(count), count)  # z^(2 nu) S
        for first in self.first_coefficients(int(s[0]), q):
            yield self.continued(first, s, count, q)

    def first_coefficients(self, s0: int, q: int) -> list[int]:
        """The possible first coefficients of w: square roots of s_0 at an irregular place, exponents at a regular one.

        With a logarithm omega belongs to the solution without, which has the larger exponent.
        """
        if self.difference is not None:
            delta = int(self.difference.p) * pow(int(self.difference.q), -1, q)
        else:
            square = fmpz(s0 if self.is_irregular else 1 + 4 * s0) % q
            if square.jacobi(q) == -1:
                return []
            delta = int(square.sqrtmod(q))
        if self.is_irregular:
            return [delta, -delta]
        half = pow(2, -1, q)
        return [(1 + sign * delta) * half % q for sign in ((1,) if self.logarithm else (1, -1))]

    def continued(self, first: int, s: Any, count: int, q: int) -> Any:
        """w with this first coefficient, term by term from z^(2 nu) (omega' + omega^2) = s.

        The coefficient of z^j in z^(2 nu) omega' is (j - 2 nu + 1) w_(j - nu + 1), and contains w_j itself where nu = 1.
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


def all_places(num: Any, den: Any, modulus: Any) -> list[LocalPlace]:
    """All poles of num/den, and infinity, which is the last one even if it is an ordinary point."""
    found = [LocalPlace(point, k, num, den) for point, k in points_of(den, modulus)]
    if any(place.at(num) == 0 for place in found):
        raise NotImplementedError("a fraction that isn't in lowest terms")
    k = degree(num) - degree(den) + 4 if num != 0 else 0
    at_infinity = AlgebraicPoint(modulus, modulus, X % modulus, fmpq_poly(0))
    top = backwards(num) * X2 ** max(-k, 0)
    bottom = backwards(den) * X2 ** max(k, 0)
    return [*found, LocalPlace(at_infinity, max(k, 0), top, bottom, infinite=True)]


def backwards(f: Any) -> Any:
    """z^n f(1/z), n the degree of f."""
    n = degree(f)
    return PLANE.from_dict({(i, j, n - k): value for (i, j, k), value in f.to_dict().items()})


# ------------------------------------------------------------------------------------------- structures


class GroupStructure(NamedTuple):
    """Kovacic's case, the degree of omega, the degree of a rational form, and, if finite and primitive, the orders in PGL2."""

    case: int
    omega: int
    form: int
    orders: tuple[int, ...] = ()


STRUCTURES = {
    "reducible": GroupStructure(1, 1, 2),
    "imprimitive": GroupStructure(2, 2, 4),
    "tetrahedral": GroupStructure(3, 4, 6, (1, 2, 3)),
    "octahedral": GroupStructure(3, 6, 8, (1, 2, 3, 4)),
    "icosahedral": GroupStructure(3, 12, 12, (1, 2, 3, 5)),
}


#: The necessary conditions: their statement, and its meaning at each place that is named.
RULES: dict[str, tuple[str, Callable[[LocalPlace, GroupStructure], bool]]] = {
    # The two solutions there are conjugate over the Laurent series, and so are their omegas.
    "ramified": (
        "an irregular singular point is ramified, so no solution has a rational logarithmic derivative",
        lambda place, structure: structure.case == 1 and place.is_ramified,
    ),
    # A single rational omega has residues in K(r); its residue, or leading coefficient, contains the square root.
    "not_a_square": (
        "the exponents at a place aren't rational over the field of its poles",
        lambda place, structure: (
            structure.case == 1 and place.k > 1 and not place.is_ramified and place.is_not_a_square()
        ),
    ),
    # The monodromy around a logarithm is unipotent: no finite and no irreducible imprimitive group contains such a matrix.
    "logarithm": (
        "a solution has a logarithm, so the group contains a unipotent element and is infinite and not imprimitive",
        lambda place, structure: structure.case > 1 and place.logarithm,
    ),
    # All solutions of an equation with a finite group are algebraic, and its places regular.
    "irregular": (
        "an irregular singular point makes the group infinite",
        lambda place, structure: structure.case == 3 and place.is_irregular,
    ),
    # The denominator of Delta is the order of the local monodromy in PGL2, which A4, S4 or A5 must contain.
    "exponents": (
        "the exponent differences aren't those of a group of this kind",
        lambda place, structure: (
            structure.case == 3
            and 0 < place.k <= 2
            and (place.difference is None or int(place.difference.q) not in structure.orders)
        ),
    ),
    "too_few_branch_points": (
        "fewer than two places can be branch points of the square root of an invariant",
        lambda place, structure: structure.case == 2 and place.can_branch,
    ),
}


class Exclusions:
    """Structures that the group of y'' = S y doesn't have."""

    def __init__(self, S: TowerFunction, modulus: Any) -> None:
        affordable(max(degree(S.num), degree(S.den)), "the degree of S")
        self.num = S.num
        self.den = S.den
        self.tower = S.tower
        self.modulus = modulus
        self.places = all_places(S.num, S.den, modulus)

    def hold(self, structure: str, evidence: list[Any]) -> None:
        """The group doesn't have this structure, by the evidence.

        One necessary condition, or the absence of the rational form; but a reducible group has one only where omega
        isn't unique, and then there must be no unique omega either.
        """
        absent = []
        for item in the_list(evidence, "the evidence"):
            kind = item["kind"]
            if kind == "necessary_condition":
                self.condition(structure, item)
                absent.append("omega" if item["rule"] == "not_a_square" else "the structure")
            elif kind == "no_invariant":
                self.no_form(STRUCTURES[structure].form, item)
                absent.append("form")
            elif kind == "no_terminating_series":
                raise NotImplementedError("that no series ends isn't proven here")
            else:
                demand(kind == "no_rational_omega" and structure == "reducible", "the kind of the evidence is known")
                self.no_omega(item)
                absent.append("omega")
        without_a_form = ["form", "omega"] if structure == "reducible" else ["form"]
        demand(sorted(absent) in (["the structure"], without_a_form), f"the group isn't {structure}")

    def condition(self, structure: str, item: dict[str, Any]) -> None:
        """The rule holds at each place that is named; or these are all that can branch, fewer than two points."""
        demand_keys(item, "a necessary condition", "kind rule places statement")
        statement, holds = RULES[item["rule"]]
        demand_equal(item["statement"], statement, "the statement")
        named = [self.place(name) for name in the_list(item["places"], "what is named")]
        demand(len({place.name for place in named}) == len(named), "the places are different")
        demand(all(holds(place, STRUCTURES[structure]) for place in named), f"these places are {item['rule']}")
        if item["rule"] == "too_few_branch_points":
            branching = [place for place in self.places if place.can_branch]
            demand(structure == "imprimitive", "the rule is one for imprimitive groups")
            demand(len(named) == len(branching), "these are the places that can branch")
            demand(sum(place.size for place in branching) < 2, "they are fewer than two")
        else:
            demand(named, f"a place is {item['rule']}")

    def place(self, name: str) -> LocalPlace:
        """The place with this factor, or "infinity"."""
        demand(isinstance(name, str), "a place has a name")
        if name == "infinity":
            return self.places[-1]
        factor = self.tower.read(name).num
        zeros = [place for place in self.places[:-1] if place.size == degree(factor) and place.at(factor) == 0]
        demand(zeros, "a place has the name of its factor")
        return zeros[0]

    def no_form(self, m: int, item: dict[str, Any]) -> None:
        """There is no rational form of degree m: no room for one, or a system of equations modulo a prime has full rank."""
        demand_keys(item, "evidence", "kind invariant_degree prime point degree")
        demand_equal(item["invariant_degree"], m, "the degree of the form")
        room = max(self.room(m), -1)
        demand_equal(item["degree"], room, "the largest degree of P")
        if room < 0:
            demand_equal((item["prime"], item["point"]), (None, 0), "where there is no room, prime and point")
            return
        demand(type(item["prime"]) is type(item["point"]) is int, "prime and point are integers")
        demand(self.dimension(m, item["prime"], item["point"]) == 0, f"there is no rational form of degree {m}")

    def room(self, m: int) -> Any:
        """The largest degree of P in a rational form prod p^v P of degree m, v the least valuations; negative without one."""
        return m - sum(place.least_valuation(m) * place.size for place in self.places)

    def dimension(self, m: int, prime: int | None = None, point: int | None = None) -> int:
        """An upper bound for the dimension of the rational forms of degree m, from expansions modulo a prime.

        At an ordinary point a form is a sum of y1^(m-i) y2^i; divided by prod p^v it is a polynomial of degree at most `room`,
        so its later terms are zero: any number of equations, whose rank modulo a prime isn't larger than over K.
        """
        room = self.room(m)
        if room < 0:
            return 0
        n = affordable(room + m + 6, f"the number of zeros of a form of degree {m}")
        roots = ((q, simple_roots_modulo(self.modulus, q)) for q in ([prime] if prime else LARGE_PRIMES))
        q, images = next((q, images) for q, images in roots if images)
        demand(q > 2 * n and fmpz(q).is_prime(), "the modulus is a large prime")
        dimensions = []
        for t in images:
            c = point
            if c is None:
                den = image(self.den, q, t, 0)
                c = next(c for c in range(LARGEST_COMPUTED + 1) if int(den(c)))
            forms = self.forms_modulo(m, n, q, t, c)
            rows = [[int(form[j]) for j in range(room + 1, n)] for form in forms]
            dimensions.append(m + 1 - int(nmod_mat(rows, q).rank()))
        return min(dimensions)

    def forms_modulo(self, m: int, n: int, q: int, t: int, c: int) -> list[Any]:
        """n terms at the point c of the y1^(m-i) y2^i, divided by prod p^v."""
        den = image(self.den, q, t, c)
        demand(int(den[0]), "the point is ordinary")
        num = image(self.num, q, t, c).left_shift(2)
        y1 = frobenius(den, num, 0, n, q)[0]
        y2 = frobenius(den, num, 1, n, q)[0].left_shift(1)
        scale = nmod([1], q)
        for place in self.places[:-1]:
            v = place.least_valuation(m)
            factor = image(place.minimal, q, t, c)
            power = factor.truncate(n).pow_trunc(abs(v), n)
            scale = scale.mul_low(power.inverse_series_trunc(n) if v > 0 else power, n)
        return [scale.mul_low(y1.pow_trunc(m - i, n), n).mul_low(y2.pow_trunc(i, n), n) for i in range(m + 1)]

    def no_omega(self, item: dict[str, Any]) -> None:
        """No omega in K(x) is the only one: no solution's is A/(den B) modulo a prime, deg B <= the number of zeros."""
        demand_keys(item, "evidence", "kind degree prime place")
        prime = item["prime"]
        name = item["place"]
        demand(type(item["degree"]) is int and item["degree"] >= -1, "the degree is one, or -1")
        if item["degree"] < 0:
            demand_equal((prime, name), (None, ""), "prime and place, without a degree,")
        else:
            demand(type(prime) is int and name, "a prime and a place belong to a degree")
        zeros, is_bound = self.zeros
        if not is_bound:  # otherwise the program may have another bound
            demand_equal(item["degree"], zeros, "the largest number of zeros")
        if zeros >= 0:
            self.no_expansion(prime, name)

    def no_expansion(self, prime: int | None, name: str) -> None:
        """At a place that tells the solutions apart, none has an omega with so few zeros, modulo the prime."""
        apart = [place for place in self.places if place.tells_solutions_apart]
        place = self.place(name) if name else apart[0]
        demand(place in apart, "the place tells the solutions apart")
        q, g = next(place.roots([prime] if prime else LARGE_PRIMES), (0, 0))
        demand(q > 10**6 and fmpz(q).is_prime(), "the place has a root modulo a large prime")
        zeros, _ = self.zeros
        den = place.image(place.den, q, g)
        top = zeros + den.degree() + max(p.k for p in self.places)
        count = affordable(top + zeros + 12, "the number of zeros of a solution")
        for w in place.expansions(g, q, count):
            multiple = den.right_shift(place.nu).mul_low(w, count)  # A/B, if w is that of a rational function
            # Euclid's algorithm for t^count and the series: the least degree of a B != 0 with B series = A + O(t^count),
            # deg A <= top, is count - deg r0 for the remainder r0 before A
            r0, r1 = nmod([1], q).left_shift(count), multiple
            while r1.degree() > top:
                r0, r1 = r1, r0 % r1
            demand(count - r0.degree() > zeros, "no expansion of omega is that of a rational function")

    @cached_property
    def zeros(self) -> tuple[int, bool]:
        """The most zeros at ordinary points of a solution with an omega in K(x), -1 for none; True if that is only a bound.

        By Fuchs' relation: the exponents nu/2 + h or nu/2 - h at the singular points and the zeros add up to 1.  A rational h
        is the same at all conjugates of a point.
        """
        if any(place.is_ramified for place in self.places):
            return -1, False
        is_bound = False
        exact = {fmpq(1)}  # equal sums are one
        totals = [acb(0)]
        t = self.modulus.complex_roots()[0][0]
        for place in self.places:
            if not place.k:
                continue
            mean = fmpq(place.size * place.nu, 2)
            if place.difference is not None:
                half = place.size * place.difference / 2
                ends = {mean + half} if place.logarithm else {mean + half, mean - half}
                exact = {total - end for total in exact for end in ends}
            else:
                halves = place.half_differences(t)
                half = sum(halves, start=acb(0))
                steps = [half, -half]
                is_bound |= self.modulus.degree() > 1 or len(halves) > 1
                if len(halves) > 1:
                    largest = sum((abs(h) for h in halves), start=arb(0)).upper()
                    steps = [acb(arb(0, largest), arb(0, largest))]
                totals = [total - acb(mean) - step for total in totals for step in steps]
            affordable(len(exact) * len(totals), "the number of sums of exponents")
        found = [-1]
        for total in (acb(first) + other for first in exact for other in totals):
            n = total.real.upper().floor().unique_fmpz()
            if total.imag.contains(0) and n >= total.real.lower():
                found.append(n)
        return affordable(max(found), "the number of zeros of a solution"), is_bound


# ------------------------------------------------------------------------------------------- forms


@dataclass(frozen=True)
class FormOfSolutions:
    """F = y_1 ... y_m in the solutions with F'/F = slope and prod (W - y_i'/y_i) = sum (-1)^k N_k/G^k W^(m-k)."""

    slope: TowerFunction
    G: Any
    N: list[Any]

    @property
    def discriminant(self) -> TowerFunction:
        """(y1'/y1 - y2'/y2)^2, of degree 2; zero for F = y1^2."""
        return TowerFunction(self.slope.tower, self.N[1] ** 2 - 4 * self.N[2], self.G**2)


def form(data: dict[str, Any], m: int, S: TowerFunction) -> FormOfSolutions:
    """The form of degree m with F'/F = theta + P'/P.

    By N_0 = 1, (k + 1) N_(k+1) = G N_k' + (N_1 - k G') N_k - (m - k + 1) G^2 S N_(k-1) there is one exactly if N_(m+1) = 0
    [Kovacic 1986, section 5.2].
    """
    tower = S.tower
    demand_equal(data["degree"], m, "the degree of a form")
    P = tower.read(data["P"])
    demand(P.den.is_constant() and P.num != 0 and is_monic(P.num), "P is a monic polynomial")
    slope = tower.read(data["theta"]) + P.derivative() / P
    G = slope.den * (S.den // slope.den.gcd(S.den))
    T = S.num * (G * G // S.den)
    first = slope.num * (G // slope.den)
    if any(f.degrees()[i] for f in (G, T, first) if f != 0 for i in (0, 1)):
        N = omega_numerators(m, lambda f: f.derivative(2), tower.normal, G, T, first)
    else:  # polynomials in x alone are far faster
        alone = (in_one_variable(f, 2) for f in (G, T, first))
        N = [at_generator(f, X2) for f in omega_numerators(m, lambda f: f.derivative(), lambda f: f, *alone)]
    demand(N.pop() == 0, f"there is this form of degree {m}")
    return FormOfSolutions(slope, G, N)


def omega_numerators(
    m: int, derivative: Callable[[Any], Any], normal: Callable[[Any], Any], G: Any, T: Any, first: Any
) -> list[Any]:
    """N_0, ..., N_(m+1), for T = G^2 S and the given N_1."""
    N = [G**0, first]
    for k in range(1, m + 1):
        total = G * derivative(N[k]) + (first - k * derivative(G)) * N[k] - (m - k + 1) * T * N[k - 1]
        N.append(normal(total * fmpq(1, k + 1)))
    return N


def logarithmic_poles(slope: TowerFunction, modulus: Any) -> list[tuple[AlgebraicPoint, int, list[Any]]]:
    """The poles of F'/F, for a rational F; v != 0, its order there; and z F'/F as a series of max(v, 1) terms.

    Only a rational F passes: its poles are simple, and the residues integers.
    """
    demand(degree(slope.num) < degree(slope.den), "a form is a rational function")
    found = []
    for point, k in points_of(slope.den, modulus):
        lowest = point.taylor(slope.num, k)
        demand(all(value == 0 for value in lowest[:-1]), "a form is a rational function")
        v = point.quotient(lowest[-1:], point.taylor(slope.den, k + 1)[-1:])[0]
        demand(v.degree() <= 0 and v[0].q == 1, "a form is a rational function")
        count = max(int(v[0].p), 1)
        affordable(count, "the degree of a form")
        num, den = (point.taylor(f, k + count)[shift:] for f, shift in ((slope.num, k - 1), (slope.den, k)))
        found.append((point, int(v[0].p), point.quotient(num[:count], den)))
    return found


def inverse_has_an_integral(poles: list[tuple[AlgebraicPoint, int, list[Any]]]) -> bool:
    """True if 1/F is the derivative of a rational function.  It has no residues.

    1/F = g/z^v, and z F'/F = v + h_1 z + ..., so that z g' = -(h_1 z + ...) g, and the residue is g_(v-1).
    """
    for point, v, h in poles:
        g = [fmpq_poly(1)]
        for n in range(1, v):
            g.append(-sum(map(mul, g, h[n:0:-1]), start=fmpq_poly(0)) * fmpq(1, n) % point.P)
        if v > 0 and g[v - 1] != 0:
            return False
    return True


# ------------------------------------------------------------------------------------------- groups

#: The order of the finite groups, for n = 1.
SIZES = {"cyclic": 1, "dicyclic": 4, "tetrahedral": 24, "octahedral": 48, "icosahedral": 120}
GROUP_NAMES = {
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
GroupFamily = tuple[str, int | None]


def as_json(number: int | None) -> int | str | None:
    """An integer of more than 4,300 digits is a text in JSON."""
    return number if number is None or number < 10**4300 else str(fmpz(number))


def reducible_group(places: list[LocalPlace], F: FormOfSolutions | None) -> GroupFamily:
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
    if F.discriminant.num != 0:
        return ("multiplicative", None) if n is None else ("cyclic", n)
    poles = logarithmic_poles(F.slope, places[-1].modulus)
    return ("cyclic", n) if inverse_has_an_integral(poles) else ("additive", n)


@dataclass(frozen=True)
class Imprimitive:
    """An imprimitive group: f = y1 y2 is a form with two factors that are exchanged, and u = y1/y2.

    H = (u'/u)^2, and eta = du/u = sqrt(H) dx is a differential on the curve z^2 = H.  If the equation is Fuchsian, eta has
    simple poles only, with the residues Delta and -Delta (1 and -1 at an ordinary point, where y1 or y2 is zero).  The group
    is dicyclic of order 4n, n least with u^n a function on the curve, or N(T) if there is no such n.
    """

    exclusions: Exclusions
    slope: TowerFunction
    H: TowerFunction
    group: dict[str, Any]

    def decide(self) -> tuple[GroupFamily, set[str]]:
        """The family, and the evidence that was used."""
        infinite = "infinite dihedral", None
        # an irregular place, or an exponent difference that isn't rational: an element of infinite order
        if any(place.difference is None for place in self.exclusions.places):
            return infinite, set()
        # f isn't defined over K: its conjugates are further pairs of lines; three pairs belong to the quaternion group
        if max(f.degrees()[0] for f in (self.slope.num, self.slope.den)) > 0:
            return ("dicyclic", 2), set()
        # two branch points: every divisor of degree 0 is that of a function, and n the common denominator of the residues
        if sum(place.size for place, order in self.points if order % 2) == 2:
            return ("dicyclic", lcm(*(int(place.difference.q) for place in self.poles))), set()
        # a differential without poles, on a curve of positive genus: its integral is no logarithm of a function
        if not self.poles:
            return infinite, set()
        if self.group.get("orders"):
            self.no_torsion(self.group["orders"])
            return infinite, {"orders"}
        if self.group.get("function"):
            return self.function(self.group["function"]), {"function"}
        raise NotImplementedError("the order of a group on a curve of positive genus")

    def no_torsion(self, orders: Any) -> None:
        """The divisor D of l eta, l the common denominator, has no finite order.

        Reduction modulo a prime of good reduction is injective on classes of finite order: orders that differ prove that there
        is none.
        """
        for entry in the_list(orders, "the evidence"):
            demand_keys(entry, "an order", "prime order")
        shown = {self.order_modulo(entry["prime"], entry["order"]) for entry in orders}
        demand(len(shown) > 1, "the order isn't finite")

    def function(self, data: Any) -> GroupFamily:
        """n log u is half the logarithm of f = prod (a + b y)^e over its conjugate, plus the integral of w dx/y, y^2 = h.

        The differential of this is an identity of rational functions, up to the sign of u.  With w = 0, and a norm of f that is
        a constant times a square, u^n is a function; n is the least one if it is no power of another function.  With w dx/y
        holomorphic and not 0 no power of u is a function: what is left would be the logarithm of one, without poles.
        """
        demand_keys(data, "the function", "multiple h pieces rest")
        tower = self.H.tower
        f = FunctionOnCurve(self.exclusions.modulus, data, tower)
        n = whole_exponent(data["multiple"])
        demand(n > 0, "a multiple of log u is taken")
        rest = polynomial_over_k(tower.read(data["rest"]), f.modulus)
        total = f.logarithmic_derivative() + TowerFunction(tower, rest)
        demand(
            (total * total - self.H * TowerFunction(tower, f.h * n**2)).num == 0,
            "the differential of f is that of a power of u",
        )
        if rest != 0:
            demand(degree(rest) < (degree(f.h) - 1) // 2, "the rest is holomorphic")
            return "infinite dihedral", None
        for prime, _ in fmpz(n).factor():
            demand(f.is_no_power(int(prime)), f"the function isn't a power with the exponent {prime}")
        return "dicyclic", n

    @cached_property
    def points(self) -> list[tuple[LocalPlace, int]]:
        """The zeros and the poles of the differential H dx^2, and their orders, that at infinity too."""
        num, den = self.H.num, self.H.den
        S = self.exclusions
        orders = [(point, order_at(point, num) - k) for point, k in points_of(den, S.modulus)]
        orders += [(point, k) for point, k in points_of(num, S.modulus) if point.at(den) != 0]
        found = [(LocalPlace(point, order_at(point, S.den), S.num, S.den), order) for point, order in orders]
        return [*((place, order) for place, order in found if order), (S.places[-1], degree(den) - degree(num) - 4)]

    @property
    def poles(self) -> list[LocalPlace]:
        """Those of eta; an ordinary point has the difference 1."""
        return [place for place, order in self.points if order <= -2]

    def order_modulo(self, q: Any, n: Any) -> int:
        """n, if it is the order modulo q of the class of D = sum l d (P - P').

        Here eta has the residues d at the points P, l is their common denominator, and P' the conjugate of P.
        """
        demand(type(q) is type(n) is int and n > 0, "prime and order are integers")
        demand(2 < q < 2**63 and fmpz(q).is_prime(), "an order is one modulo an odd prime")
        smaller = [n // int(p) for p, _ in fmpz(n).factor()]
        for t in simple_roots_modulo(self.exclusions.modulus, q):
            with suppress(AssertionError):  # several primes of K lie over q, and some of them may be bad ones
                group, D = self.class_of_poles(q, t)
                is_zero = {k: group.multiple(k, D).u.degree() == 0 for k in [n, *smaller]}
                if is_zero.pop(n) and not any(is_zero.values()):
                    return int(n)
        raise AssertionError(f"{n} is the order modulo {q}")

    def not_a_square(self, leading: int, factors: list[tuple[LocalPlace, int, Any]], q: int) -> tuple[int, int]:
        """An r modulo q with H(r) = leading prod f(r)^order that is no square, and this value."""
        for r in range(q):
            values = [(int(f(r)), order) for _, order, f in factors]
            if all(value for value, _ in values):
                H = leading * prod(pow(value, order, q) for value, order in values) % q
                if fmpz(H).jacobi(q) == -1:
                    return r, H
        raise AssertionError(f"{q} is a good prime")

    def class_of_poles(self, q: int, t: int) -> tuple[ClassGroup, DivisorPoints]:
        """The curve modulo q, and D: P - P' is 2 P, up to what stands for 0.

        With x = r + 1/z, where H(r) isn't a square, no place is at infinity, and H dx^2 = N/M dz^2 is H(r) times the product of
        the factors of the places to their orders.  With N M = h T^2 and y = M sqrt(N/M)/T, the residue of eta over a root of f
        is d = y (T/f) / (f' M/f^2).
        """
        num, den = (in_one_variable(by_powers(f, 2)[degree(f)], 1) for f in (self.H.num, self.H.den))
        modulus = self.exclusions.modulus
        leading = int(modulo(num * den.xgcd(modulus)[1] % modulus, q)(t))
        *finite, (_, at_infinity) = self.points
        factors = [(place, order, image(place.minimal, q, t, 0)) for place, order in finite]
        r, value = self.not_a_square(leading, factors, q)
        moved = [(place, order, f.compose(nmod([r, 1], q)).reverse()) for place, order, f in factors]
        moved.append((self.exclusions.places[-1], at_infinity, nmod([0, 1], q)))
        one = nmod([1], q)
        h = one * value
        T = M = distinct = one
        poles = []
        for place, order, g in moved:
            f = g * pow(int(g.leading_coefficient()), -1, q)
            distinct *= f if order else one
            h *= f ** (order % 2)
            T *= f ** (abs(order) // 2)
            M *= f ** max(-order, 0)
            if order <= -2:
                poles.append((f, place.difference))
        demand(distinct.gcd(distinct.derivative()).degree() == 0, f"{q} is a good prime: no points meet")
        group = ClassGroup(h)
        D = DivisorPoints(one, 0 * one)
        l = lcm(*(int(difference.q) for _, difference in poles))  # noqa: E741
        for f, difference in poles:
            d = int(difference.p) * pow(int(difference.q), -1, q)
            y = d * f.derivative() * (M // f**2) * (T // f % f).xgcd(f)[1] % f
            demand((y * y - h) % f == 0, "the residues are exponent differences")
            D = group.together(D, group.multiple(2 * int(l * difference), DivisorPoints(f, y)))
        return group, D


def order_at(point: AlgebraicPoint, f: Any) -> int:
    """The multiplicity of a root; f isn't zero."""
    order = 0
    while point.at(f) == 0:
        f = f.derivative(2)
        order += 1
    return order


def whole_exponent(value: Any) -> int:
    """An integer, or the text of a long one."""
    if isinstance(value, str) and value.isdecimal():
        return int(fmpz(value))
    demand(type(value) is int, "an exponent is an integer")
    return int(value)


def polynomial_over_k(value: TowerFunction, modulus: Any) -> Any:
    """The polynomial over K that is this value."""
    demand(degree(value.den) == 0 and value.num.degrees()[0] <= 0, "a polynomial has no denominator")
    inverse = in_one_variable(value.den, 1).xgcd(modulus)[1]
    return value.tower.normal(value.num * at_generator(inverse, T))


class CurvePiece(NamedTuple):
    """(a + b y)^exponent on a curve y^2 = h."""

    exponent: int
    a: Any
    b: Any

    @classmethod
    def read(cls, data: dict[str, Any], tower: Tower, modulus: Any) -> CurvePiece:
        demand_keys(data, "a piece", "exponent a b")
        return cls(
            whole_exponent(data["exponent"]), *(polynomial_over_k(tower.read(data[name]), modulus) for name in "ab")
        )

    def value(self, x: int, y: int, q: int) -> int:
        """At a point modulo q, over the norm to the power of the integral part of exponent/2; 0 where a norm is 0."""
        even = int(self.a(x))
        odd = int(self.b(x)) * y
        norm = (even - odd) * (even + odd) % q
        return pow(even + odd, self.exponent, q) * pow(norm, -(self.exponent // 2), q) % q if norm else 0


class FunctionOnCurve:
    """f, the product of the pieces, on the curve y^2 = h."""

    def __init__(self, modulus: Any, data: dict[str, Any], tower: Tower) -> None:
        self.modulus = modulus
        self.tower = tower
        self.h = polynomial_over_k(tower.read(data["h"]), modulus)
        self.pieces = [CurvePiece.read(entry, tower, modulus) for entry in the_list(data["pieces"], "the pieces")]
        is_squarefree = all(k == 1 for _, k in points_of(self.h, modulus))
        demand(degree(self.h) >= 3 and is_squarefree, "h has no square factor")

    def logarithmic_derivative(self) -> TowerFunction:
        """R, where R dx/y is half of d log of f over its conjugate."""
        h = self.h
        total = self.tower.number(0)
        for e, a, b in self.pieces:
            odd = (b.derivative(2) * h + b * h.derivative(2) * fmpq(1, 2)) * a - a.derivative(2) * b * h
            total += TowerFunction(self.tower, odd * e, a * a - h * b * b)
        return total

    @cached_property
    def roots_of_norms(self) -> list[tuple[AlgebraicPoint, int]]:
        """The roots of G, where the norm of the product of the pieces with odd exponents is a constant times G^2."""
        norms = (a * a - self.h * b * b for e, a, b in self.pieces if e % 2)
        roots = points_of(self.tower.normal(prod(norms, start=X2**0)), self.modulus)
        demand(all(k % 2 == 0 for _, k in roots), "the norm of f is a square")
        return [(point, k // 2) for point, k in roots]

    def is_no_power(self, exponent: int) -> bool:
        """True if f/G, divided by the norms, is no l-th power up to a constant.

        Else its values at all points over F_q, q = 1 modulo l, lie in one class modulo l-th powers.
        """
        affordable(exponent // 10**9, "a prime factor of the order")
        first = exponent * (2**41 // exponent) + 1
        moduli = (q for q in range(first, 2**62, exponent) if fmpz(q).is_prime())
        good = ((q, t) for q in moduli for t in simple_roots_modulo(self.modulus, q)[:1])
        for q, t in islice(good, 30):
            classes = {pow(value, (q - 1) // exponent, q) for value in self.values(q, t)}
            if len(classes) > 1:
                return True
        return False

    def values(self, q: int, t: int) -> Iterator[int]:
        """The values of f/G, divided by the norms, at points modulo q, neither zeros nor poles of a part of it."""
        h = image(self.h, q, t, 0)
        demand(h.gcd(h.derivative()).degree() == 0, f"{q} is a good prime")
        factors = (image(point.minimal, q, t, 0) ** k for point, k in self.roots_of_norms)
        G = prod(factors, start=nmod([1], q))
        pieces = [CurvePiece(e, image(a, q, t, 0), image(b, q, t, 0)) for e, a, b in self.pieces]
        for x in range(60):
            square = fmpz(int(h(x)))
            root = int(G(x))
            if square.jacobi(q) == 1 and root:
                y = int(square.sqrtmod(q))
                value = pow(root, -1, q)
                for piece in pieces:
                    value = value * piece.value(x, y, q) % q
                if value:
                    yield value


class DivisorPoints(NamedTuple):
    """The points over the roots of u with y = v, no two of them conjugate, given by the ideal (u, y - v)."""

    u: Any
    v: Any


@dataclass(frozen=True)
class ClassGroup:
    """The classes of divisors on y^2 = h modulo a prime, where h has an even degree and its first coefficient is no square.

    The two points at infinity are conjugate, so points E of even degree stand for the class of E minus deg E/2 times both;
    each class has points of degree at most deg h/2, and 0 only the empty set [Cantor, Math. Comp. 48 (1987)].
    """

    h: Any

    def multiple(self, n: int, E: DivisorPoints) -> DivisorPoints:
        """n E, by halving n."""
        if n == 0:
            return DivisorPoints(self.h**0, self.h * 0)
        half = self.multiple(n // 2, E)
        double = self.together(half, half)
        return self.together(double, E) if n % 2 else double

    def together(self, E: DivisorPoints, F: DivisorPoints) -> DivisorPoints:
        """The sum: the ideal of the products of (u, y - v) for both, without the conjugate points over the roots of d.

        y - v has further zeros, and their conjugates the same class: fewer points, as long as v has the degree to spare.
        """
        common, a, b = E.u.xgcd(F.u)
        d, c, e = common.xgcd(E.v + F.v)
        u = (E.u // d) * (F.u // d)
        v = c * a * (E.u // d) * F.v + c * b * (F.u // d) * E.v + e * (E.v * F.v + self.h) // d
        v = v % u
        while u.degree() > self.h.degree() // 2:
            u = (self.h - v * v) // u
            v = -v % u
        return DivisorPoints(u, v)


# ------------------------------------------------------------------------------------------- answers

REQUIRED = "schema input variable S status case riccati constants verified proof notices seconds"
#: The other keys of an answer; any further ones are the user's, as the lines and names of a batch.
OPTIONAL = "field letters equation gauge generic_conditions group solutions"
NOT_LOOKED_AT = ("input", "notices", "seconds")
NOT_LOOKED_AT_IN_THE_EQUATION = ("change", "f", "h", "text", "unknown")


def demand_names(new: Any, *others: str) -> None:
    """Refute the answer unless the first is a name, and none of the others."""
    demand(isinstance(new, str) and new.isidentifier(), "variables and constants have names")
    demand(new not in others, "the names are different")


@dataclass(frozen=True)
class NumberField:
    """Q(symbol), a root of the modulus near a complex number.

    All roots are conjugate: what is proven of one holds for all, but the symbol, if it is a formula, has to be one of them.
    """

    symbol: str
    modulus: Any
    is_name: bool
    root: Any

    @classmethod
    def read(cls, data: dict[str, Any]) -> NumberField:
        demand_keys(data, "the field", "parameters symbol minimal_polynomial", "near")
        if the_list(data["parameters"], "the parameters"):
            raise NotImplementedError("an S with parameters")
        polynomial = Tower("t", PLANE).read(data["minimal_polynomial"])
        modulus = over_q(polynomial, polynomial.tower.x)
        is_monic_polynomial = modulus == monic_irreducible(modulus) and modulus.degree() > 1
        demand(is_monic_polynomial, "the polynomial of the field is monic, and its root irrational")
        tower, (value,) = read_formulas([data["symbol"]], "x")
        is_name = isinstance(value, str)
        if is_name:
            demand_names(data["symbol"])
        else:
            powers = (value.to_the(k) * tower.number(c) for k, c in enumerate(modulus.coeffs()))
            demand(sum(powers, start=tower.number(0)).num == 0, "the symbol is a root of its polynomial")
        root = acb("nan")
        if "near" in data:  # older versions didn't say which root is meant
            real, imaginary = the_list(data["near"], "a complex number")
            near = acb(float(real), float(imaginary))
            root = min((root for root, _ in modulus.complex_roots()), key=lambda root: float(abs(root - near).mid()))
            meant = root if is_name else tower.at(POINTS[0], value)
            demand(abs(near - meant) < 1e-9 * (1 + abs(near)), "the root is near this number")
        return cls(data["symbol"], modulus, is_name, root)


def rational_functions(variable: str, field: NumberField | None) -> Tower:
    """Those over K: a tower with the generator t, which is zero over Q."""
    tower = Tower(variable, PLANE)
    t = tower.constant("t", partial(at_generator, X if field is None else field.modulus))
    if field is not None:
        tower.adjoin(field.symbol, t)
    return tower


def read_formulas(texts: list[str], variable: str, field: NumberField | None = None) -> tuple[Tower, list[Any]]:
    """The functions, in a tower with the roots that they need; a text in place of one that has a function not known here."""
    orders = dict[str, int]()
    while True:
        tower = Tower(variable, TOWER, orders)
        if field is not None and field.is_name:
            tower.adjoin(field.symbol, tower.constant(field.symbol, partial(at_generator, field.modulus), field.root))
        found: list[Any] = []
        try:
            for text in texts:
                try:
                    found.append(tower.read(text))
                except NotImplementedError as name:
                    found.append(str(name))
            return tower, found
        except Refined:
            pass


class CheckedAnswer:
    """One line: the JSON object, the names in its expressions, and S."""

    def __init__(self, data: dict[str, Any]) -> None:
        demand_keys({key: value for key, value in data.items() if key in REQUIRED.split()}, "the answer", REQUIRED)
        self.data = data
        self.proof = data["proof"]
        demand_keys(self.proof, "the proof", "structure semi_invariant invariant excluded undecided", "series")
        demand_names(data["variable"])
        self.structure: str | None = self.proof["structure"]
        self.field = None if data.get("field") is None else NumberField.read(data["field"])
        self.tower = rational_functions(data["variable"], self.field)
        self.S = self.tower.read(data["S"])
        self.exclusions = Exclusions(self.S, X if self.field is None else self.field.modulus)

    def check(self) -> str:
        """Prove every claim; the result names what was looked at, and what wasn't."""
        self.heading()
        checked = self.equation()
        self.case()
        checked.append("case")
        f = None
        F = None
        if "series" in self.proof:
            self.series(self.proof["series"])
            checked.append("omega")
        elif self.structure is not None:
            f = self.omega(STRUCTURES[self.structure].omega)
            F = self.rational_form(STRUCTURES[self.structure].form)
            checked.append("omega")
        if self.data.get("group") is not None and "series" not in self.proof:
            self.group(f, F)
            checked.append("group")
        proven, unproven = self.solutions()
        checked += proven
        return f"{'; '.join(checked)}; not checked: {', '.join([*self.not_looked_at(checked), *unproven])}"

    def solutions(self) -> tuple[list[str], list[str]]:
        """Two independent solutions: the claims that were proven, and those that were neither proven nor refuted."""
        texts = self.data.get("solutions")
        if texts is None:
            return [], []
        demand(self.structure is not None, "there are solutions beside a proof that there are none")
        demand(len(the_list(texts, "the solutions")) == 2, "there are two solutions")
        coefficients = self.coefficients()
        if coefficients is None:
            return [], ["solutions"]
        tower, read_ones = read_formulas([*texts, *coefficients], self.data["variable"], self.field)
        *pair, a, b, c = read_ones
        unproven = []
        for k, y in enumerate(pair):
            try:
                if isinstance(y, str):
                    raise NotImplementedError(y)
                slope = y.derivative()
                rest = a * slope.derivative() + b * slope + c * y
                if rest.num != 0:
                    demand(not tower.is_refuted(rest), f"solutions[{k}] solves the equation")
                    unproven.append(f"solutions[{k}]")
            except NotImplementedError as reason:
                unproven.append(f"solutions[{k}] ({reason})")
        if unproven:
            return [], unproven
        first, second = pair
        wronskian = first * second.derivative() - first.derivative() * second
        demand(wronskian.num != 0, "the solutions are independent")
        if all(ball.contains(0) for ball in tower.balls(wronskian)):
            return [], ["independence of the solutions"]
        return ["solutions"], []

    def coefficients(self) -> list[str] | None:
        """The coefficients a, b, c of the equation of the solutions; None after a change of variable."""
        equation: Any = self.data.get("equation")
        if equation is None:
            return ["1", "0", f"-({self.data['S']})"]
        if equation["field"] not in (None, self.data.get("field")) or equation.get("change") is not None:
            return None
        return [equation["a"], equation["b"], equation["c"]]

    def heading(self) -> None:
        """Keys that repeat each other agree."""
        data = self.data
        structure = self.structure
        demand_equal(data["verified"], True, "what the answer says of its own check")
        demand_equal(data["case"], None if structure is None else STRUCTURES[structure].case, "the case")
        demand_equal(data["status"], "none" if structure is None else "liouvillian", "the status")
        demand(data.get("generic_conditions") is None, "an S without parameters has no conditions on them")
        demand(data.get("letters", {}) == {}, "an S without parameters has no letters for numbers")
        if structure is None:
            beside = [data["riccati"], data["constants"], self.proof["invariant"], self.proof["semi_invariant"]]
            demand(
                beside == [None] * 4 and "series" not in self.proof,
                "there is no solution beside a proof that there is none",
            )

    def equation(self) -> list[str]:
        """y = v exp(int gauge dx) turns a y'' + b y' + c y = 0 into v'' = S v, gauge = -b/(2a) [Kovacic 1986, section 1.1]."""
        equation: Any = self.data.get("equation")
        gauge: Any = self.data.get("gauge")
        if equation is None:
            demand(gauge is None, "a gauge belongs to an equation")
            return self.input()
        demand_keys(equation, "the equation", "text unknown a b c f h field", "change")
        demand(isinstance(gauge, str), "the equation has a gauge")
        field = equation["field"]
        if field is not None and (field["parameters"] or (self.field is not None and field != self.data["field"])):
            return []
        tower = rational_functions(self.data["variable"], None if field is None else NumberField.read(field))
        S, g, a, b, c = (tower.read(text) for text in (self.data["S"], gauge, *(equation[name] for name in "abc")))
        demand(a.num != 0, "the equation has second order")
        half = b / (a + a)
        demand((half.derivative() + half * half - c / a - S).num == 0, "S is that of the equation")
        demand((g + half).num == 0, "the gauge is -b/(2a)")
        return ["y'' = S y from a, b, c", "gauge"]

    def input(self) -> list[str]:
        """S is that of the input, if S itself was given, in a notation that can be read here."""
        text = self.data["input"]
        demand(isinstance(text, str), "the input is a text")
        text = text.replace("^", "**")
        unreadable = AssertionError, LookupError, ValueError, NotImplementedError
        difference = None
        with suppress(*unreadable):
            difference = self.S - self.tower.read(text)
        if difference is not None:
            demand(difference.num == 0, "S is that of the input")
            return ["S from input"]
        if self.field is not None:  # roots that aren't written by its generator: values may refute, and prove nothing
            with suppress(*unreadable):
                tower, (S, given) = read_formulas([self.data["S"], text], self.data["variable"], self.field)
                difference = None if isinstance(given, str) else S - given
            demand(difference is None or not tower.is_refuted(difference), "S is that of the input")
        return []

    def not_looked_at(self, checked: list[str]) -> Iterator[str]:
        """The keys without a part in the check."""
        looked_at = "input" if "S from input" in checked else ""
        yield from (key for key in NOT_LOOKED_AT if key in self.data and key != looked_at)
        equation = self.data.get("equation") or {}
        if "gauge" in checked:
            yield from (f"equation.{key}" for key in NOT_LOOKED_AT_IN_THE_EQUATION if key in equation)
        elif equation:
            yield from ("equation", "gauge")
        if "group" in self.data and "group" not in checked:
            yield "group"
        evidence = chain(*(entry["evidence"] for entry in self.proof["excluded"]))
        if any(item["kind"] == "no_rational_omega" for item in evidence) and self.exclusions.zeros[1]:
            yield "degree of no_rational_omega"
        others = set(self.data) - set(REQUIRED.split()) - set(OPTIONAL.split())
        yield from (key if key.isidentifier() else ascii(key)[:60] for key in sorted(others))

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

    def omega(self, n: int) -> FormOfSolutions:
        """The polynomial of omega is that of a form f of degree n, over K(c); f.

        Of degree 6 and 12 it needn't be written out: N_0, ..., N_n follow from f.
        """
        riccati = self.data["riccati"]
        semi_invariant = self.proof["semi_invariant"]
        demand_keys(riccati, "the polynomial of omega", "variable degree coefficients")
        demand_keys(semi_invariant, "the form", "degree theta P D")
        self.adjoin_constant()
        demand_names(riccati["variable"], *self.tower.names)
        f = form(semi_invariant, n, self.S)
        self.normal_form(semi_invariant)
        demand_equal(riccati["degree"], n, "the degree of omega")
        a = [f.slope]
        if n < 6 or riccati["coefficients"] is not None:
            a = [self.tower.read(text) for text in reversed(the_list(riccati["coefficients"], "the polynomial"))]
            demand_equal(len(a) - 1, n, "the number of coefficients")
            power = self.tower.one
            for k in range(n + 1):
                difference = self.tower.normal(a[k].num * power - (-1) ** k * f.N[k] * a[k].den)
                demand(difference == 0, "the roots of the polynomial solve omega' + omega^2 = S")
                power = self.tower.normal(power * f.G)
        has_c = any(g.degrees()[0] > 0 for value in a for g in (value.num, value.den))
        demand(self.data["constants"] is None or has_c, "c occurs in omega")
        return f

    def series(self, data: Any) -> None:
        """exp(int theta) P solves y'' = S y for a P with the powers degree, degree - step, ..., lowest of t = x - centre.

        P'' + 2 theta P' + (theta' + theta^2 - S) P, times a denominator, takes t^k to U(k) t^(k+j) + V(k) t^(k+j-step) with
        quadratic U and V.  It is 0 for P = sum p_k t^k with U(k) p_k = -V(k + step) p_(k+step), which begins at a root of U,
        ends at one of V, and needs no division by 0.
        """
        demand_keys(data, "the series", "theta centre step degree lowest")
        beside = [self.data["riccati"], self.proof["invariant"], self.proof["semi_invariant"]]
        demand(self.structure == "reducible" and beside == [None] * 3, "a series stands in place of omega")
        self.adjoin_constant()
        tower = self.tower
        theta, centre = (tower.read(data[name]) for name in ("theta", "centre"))
        demand(centre.den == 1 and degree(centre.num) < 1, "the centre is a constant")
        demand(self.data["constants"] is None or theta.num.degrees()[0] > 0, "c occurs in theta")
        step, highest, lowest = (whole_exponent(data[name]) for name in ("step", "degree", "lowest"))
        demand(step > 0 and 0 <= lowest <= highest and (highest - lowest) % step == 0, "these are powers in steps")
        zeroth = theta.derivative() + theta * theta - self.S
        second = theta.den * (zeroth.den // zeroth.den.gcd(theta.den))
        parts = (zeroth.num * (second // zeroth.den), 2 * theta.num * (second // theta.den), second)
        moved = [by_powers(tower.normal(f.compose(C, T, X2 + centre.num)), 2) for f in parts]
        powers = sorted({power - i for i, f in enumerate(moved) for power, value in f.items() if value != 0})
        demand(len(powers) == 2 and powers[1] - powers[0] == step, "the recurrence has two terms")
        V, U = ([f.get(power + i, 0 * C) for i, f in enumerate(moved)] for power in powers)
        for (c, b, a), k in ((U, highest), (V, lowest)):
            demand(tower.normal(a * (k * (k - 1)) + b * k + c) == 0, "P begins and ends at roots of the recurrence")
        c, b, a = U
        # The roots of U add up to 1 - b/a.
        other = None if a == 0 else TowerFunction(tower, a - b, a).rational
        divisors = range(lowest, highest, step)
        demand(
            other is None or other.q != 1 or int(other.p) - highest not in divisors,
            "the recurrence divides by 0 nowhere",
        )

    def adjoin_constant(self) -> None:
        """The constant c of omega, with its polynomial, which is irreducible, so that K(c) is a field."""
        constants = self.data["constants"]
        if constants is None:
            return
        symbol = constants["symbol"]
        demand_keys(constants, "the constant", "symbol minimal_polynomial")
        demand_names(symbol, *self.tower.names)
        names = {name: value for name, value in self.tower.names.items() if name != self.data["variable"]}
        polynomial = Reader(constants["minimal_polynomial"], self.tower, names | {symbol: self.tower.x}).value()
        demand(polynomial.den.is_constant(), "c has a polynomial over the field")
        f = polynomial.num
        demand(is_monic(f) and degree(f) > 1, "the polynomial of c is monic, and c irrational")
        points = points_of(f, self.exclusions.modulus)
        demand(len(points) == 1 and points[0][1] == 1, "the polynomial of c is irreducible")
        self.tower.adjoin(symbol, self.tower.constant("c", lambda c: f.compose(C, T, c)))

    def normal_form(self, semi_invariant: dict[str, Any]) -> None:
        """P has its zeros at ordinary points, and D is the product of the factors p^((k + 1)//2) of the places."""
        P = self.tower.read(semi_invariant["P"]).num
        D = self.tower.read(semi_invariant["D"])
        places = [(place, (place.k + 1) // 2) for place in self.exclusions.places[:-1]]
        for place, order in places:
            demand(any(place.at(part) != 0 for part in by_powers(P, 0).values()), "P has its zeros at ordinary points")
            demand(all(value == 0 for value in place.taylor(D.num, order)), "D is the denominator of omega")
        is_product = degree(D.num) == sum(place.size * order for place, order in places)
        demand(D.den == 1 and is_monic(D.num) and is_product, "D is the denominator of omega")

    def rational_form(self, m: int) -> FormOfSolutions | None:
        """The rational form of degree m that shows the structure; a reducible group with one omega only has none."""
        data = self.proof["invariant"]
        if data is None:
            demand(self.structure == "reducible" and self.exclusions.dimension(2) == 0, "omega is unique")
            return None
        demand_keys(data, "the rational form", "degree theta P")
        F = form(data, m, self.S)
        logarithmic_poles(F.slope, self.exclusions.modulus)
        return F

    def group(self, f: FormOfSolutions | None, F: FormOfSolutions | None) -> None:
        """The group is the one that is named: SL2, a finite primitive one, or found by the forms, with its evidence."""
        group = self.data["group"]
        used = set[str]()
        demand_keys(group, "the group", "name order finite", "family n function orders")
        named: GroupFamily = self.structure or "SL2", None
        if self.structure == "reducible":
            named = reducible_group(self.exclusions.places, F)
        elif self.structure == "imprimitive" and f is not None:
            named, used = Imprimitive(self.exclusions, f.slope, f.discriminant, group).decide()
        family, n = named[0], as_json(named[1])
        order = SIZES[family] * (named[1] or 1) if family in SIZES else None
        size = as_json(order)
        name = GROUP_NAMES.get(f"{family}{n}", GROUP_NAMES[family]).format(n=n, order=size)
        expected = {"name": name, "order": size, "finite": order is not None, "family": family, "n": n}
        for key in set(expected) & set(group):
            demand_equal(group[key], expected[key], f"the {key} of the group")
        demand(set(group) & {"function", "orders"} == used, "the group needs this evidence")


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
    """The verdict on one line."""
    try:
        data = json.loads(line, object_pairs_hook=once, parse_constant=no_number)
        if not isinstance(data, dict) or repr(data.get("schema")) != "1":
            return "not checked: no answer in schema 1"
        if data.get("status") in ("error", "solved") and "case" not in data:
            return "not checked: the line says why there is no answer, or is one of dsolve's"
        if data["proof"]["undecided"] is not None:
            return f"not checked: the answer is undecided: {data['proof']['undecided']!r}"
        with ctx.workprec(333):
            return f"checked: {CheckedAnswer(data).check()}"
    except (json.JSONDecodeError, Unreadable) as error:
        return f"unreadable: {error}"
    except AssertionError as claim:
        return f"refuted: it isn't shown that {claim}"
    except (RuntimeError, StopIteration) as reason:
        return f"not checked: {str(reason) or type(reason).__name__}"
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        return f"refuted: malformed ({type(error).__name__})"


def verdicts(lines: Iterator[str], seconds: float = 60) -> Iterator[str]:
    """The verdicts, found by a process that is replaced if a line takes longer."""
    with multiprocessing.Pool(1) as pool:
        for line in lines:
            try:
                yield pool.apply_async(verdict, [line]).get(seconds)
            except multiprocessing.TimeoutError:
                pool.terminate()
                yield from chain([f"not checked: it takes more than {seconds:g} s"], verdicts(lines, seconds))


def check_files(files: list[str]) -> int:
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
    sys.exit(check_files(sys.argv[1:]))
