"""How an expression behaves as t > 0 tends to 0: a finite sum of monomials with constant coefficients, and bounds of the rest.

A monomial is exp(Q) t^e log(t)^k with Q = sum of a_j t^(-p_j), p_j > 0 rational: that is what solutions of linear equations
consist of at singular points, regular (Q = 0) and irregular.  An error is a monomial m of which the rest is O(m), or less.
Exponents may have symbols; what their assumptions don't tell isn't decided.

Nothing is approximated, nothing guessed: `Expansion` is exact up to the errors that it says, and the work is bounded by the
number of terms, `depth`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.general_solution.zero import Zero, when_zero

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
#: The most monomials of an expansion.
_MOST_TERMS = 400


class UnknownBehaviour(Exception):
    """It isn't known how the expression behaves; `deeper`: more terms may tell."""

    def __init__(self, message: str, *, deeper: bool = False) -> None:
        super().__init__(message)
        self.deeper = deeper


def sign_of(value: Expr) -> int:
    """The sign of the real part.  Raises `UnknownBehaviour` where the assumptions don't tell."""
    value = sympy.expand(_one_form(value))
    if value.is_real is False or value.has(sympy.I):
        value = sympy.re(value)
    if value.is_zero:
        return 0
    if value.is_positive:
        return 1
    if value.is_negative:
        return -1
    raise UnknownBehaviour(f"the sign of {value} isn't known")


@dataclass(frozen=True)
class ExpansionTerm:
    """exp(sum of a t^(-p) over `growth`) t^e log(t)^k; `growth` has pairs (p, a), the largest p first."""

    growth: tuple[tuple[Expr, Expr], ...] = ()
    e: Expr = _ZERO
    k: int = 0

    def __post_init__(self) -> None:
        """Exponents that are the same have one form."""
        object.__setattr__(self, "e", _one_form(self.e))
        object.__setattr__(self, "growth", tuple((_one_form(p), a) for p, a in self.growth))

    def __str__(self) -> str:
        """In t > 0."""
        t = sympy.Symbol("t", positive=True)
        return str(sympy.exp(sympy.Add(*(a / t**p for p, a in self.growth))) * t**self.e * sympy.log(t) ** self.k)

    def __mul__(self, other: ExpansionTerm) -> ExpansionTerm:
        return ExpansionTerm(_added(self.growth, other.growth), sympy.expand(self.e + other.e), self.k + other.k)

    def power(self, r: Expr) -> ExpansionTerm:
        """For a real exponent r."""
        k = sympy.expand(self.k * r)
        is_positive = all(a.is_real for _, a in self.growth)
        if not k.is_Integer or not (r.is_Integer or is_positive):
            raise UnknownBehaviour("a root of a logarithm or of a wave")
        growth = tuple((p, sympy.expand(a * r)) for p, a in self.growth)
        return ExpansionTerm(growth, sympy.expand(self.e * r), int(k))

    @property
    def inverse(self) -> ExpansionTerm:
        return ExpansionTerm(tuple((p, -a) for p, a in self.growth), -self.e, -self.k)

    @property
    def growth_sign(self) -> int:
        """1 if the exponential grows, -1 if it decays, 0 if its modulus is 1: the sign of the largest power that has one."""
        for _, a in self.growth:
            sign = sign_of(a)
            if sign:
                return sign
        return 0

    @property
    def size(self) -> int:
        """1 if it is unbounded, -1 if it tends to 0; 0 for constants and for oscillations with a constant amplitude."""
        sign = self.growth_sign or -sign_of(self.e)
        if sign:
            return sign
        return (self.k > 0) - (self.k < 0)

    @property
    def is_constant(self) -> bool:
        return not self.growth and self.e == 0 and self.k == 0

    def is_below(self, other: ExpansionTerm) -> bool:
        """Is it O(other), as far as that is known?"""
        try:
            return (self * other.inverse).size <= 0
        except UnknownBehaviour:
            return False

    def is_smaller(self, other: ExpansionTerm) -> bool:
        """Is it o(other), as far as that is known?"""
        try:
            return (self * other.inverse).size < 0
        except UnknownBehaviour:
            return False


def _one_form(exponent: Expr) -> Expr:
    """With one denominator, where symbols are in denominators."""
    denominators = [power.base for power in exponent.atoms(sympy.Pow) if power.exp.is_negative]
    if any(base.free_symbols for base in denominators):
        return sympy.cancel(exponent)
    return exponent


def _added(first: Iterable[tuple[Expr, Expr]], second: Iterable[tuple[Expr, Expr]]) -> tuple[tuple[Expr, Expr], ...]:
    total: dict[Expr, Expr] = {}
    for p, a in (*first, *second):
        power = _one_form(p)
        total[power] = sympy.expand(total.get(power, _ZERO) + a)
    return tuple((p, total[p]) for p in sorted(total, reverse=True) if total[p] != 0)


CONSTANT = ExpansionTerm()
LOG = ExpansionTerm(k=1)


class Expansion:
    """The sum of coefficient * monomial over `terms`, up to O(sum of the errors)."""

    def __init__(self, terms: dict[ExpansionTerm, Expr], errors: Iterable[ExpansionTerm] = ()) -> None:
        self.errors = _largest(errors)
        self.terms: dict[ExpansionTerm, Expr] = {}
        for m, c in terms.items():
            if c != 0 and not any(m.is_below(error) for error in self.errors):
                self.terms[m] = c
        if len(self.terms) > _MOST_TERMS:
            raise UnknownBehaviour("the expansion has too many terms")

    @classmethod
    def constant(cls, value: Expr) -> Expansion:
        return cls({CONSTANT: value})

    def __add__(self, other: Expansion) -> Expansion:
        terms = dict(self.terms)
        for m, c in other.terms.items():
            if m in terms:
                terms[m] = sympy.expand(terms[m] + c)
            else:
                terms[m] = c
        return Expansion(terms, (*self.errors, *other.errors))

    def __mul__(self, other: Expansion) -> Expansion:
        terms: dict[ExpansionTerm, Expr] = {}
        for m, c in self.terms.items():
            for n, d in other.terms.items():
                terms[m * n] = sympy.expand(terms.get(m * n, _ZERO) + c * d)
        errors = [m * n for m in self.terms for n in other.errors]
        errors += [m * n for m in self.errors for n in (*other.terms, *other.errors)]
        return Expansion(terms, errors)

    def times(self, factor: Expr, monomial: ExpansionTerm = CONSTANT) -> Expansion:
        terms = {m * monomial: sympy.expand(c * factor) for m, c in self.terms.items()}
        return Expansion(terms, [m * monomial for m in self.errors])

    @property
    def parts(self) -> ExpansionParts:
        """What doesn't tend to 0, the constant apart; the constant; what tends to 0."""
        if any(error.size >= 0 for error in self.errors):
            raise UnknownBehaviour("too few terms", deeper=True)
        large: dict[ExpansionTerm, Expr] = {}
        small: dict[ExpansionTerm, Expr] = {}
        for m, c in self.terms.items():
            if m.is_constant:
                continue
            if m.size >= 0:
                large[m] = c
            else:
                small[m] = c
        return ExpansionParts(large, self.terms.get(CONSTANT, _ZERO), Expansion(small, self.errors))

    def leading(self) -> LeadingTerm:
        """The term that is larger than all others.  Raises `UnknownBehaviour` where there is none that is known."""
        terms = {m: c for m, c in self.terms.items() if when_zero(c) is not Zero.ALWAYS}
        everything = [*terms, *self.errors]
        for m, c in terms.items():
            if all(other is m or other.is_smaller(m) for other in everything):
                others = {n: d for n, d in terms.items() if n is not m}
                rest = Expansion(others, self.errors).times(1 / c, m.inverse)
                return LeadingTerm(m, c, rest)
        raise UnknownBehaviour("no term is larger than all others", deeper=bool(self.errors))

    def power(self, r: Expr, depth: int) -> Expansion:
        """The principal power with a constant exponent."""
        if r.is_Integer and 0 <= r <= depth:
            return self._natural_power(int(r))
        first = self.leading()
        coefficients = [sympy.binomial(r, k) for k in range(depth)]
        return _series(first.rest, coefficients).times(first.coefficient**r, first.monomial.power(r))

    def _natural_power(self, n: int) -> Expansion:
        total = Expansion.constant(sympy.Integer(1))
        for _ in range(n):
            total = total * self
        return total

    def log(self, depth: int) -> Expansion:
        """log(c m (1 + d)) = log(c) + log(m) + log(1 + d)."""
        first = self.leading()
        m = first.monomial
        if m.k:
            raise UnknownBehaviour("the logarithm of a logarithm")
        coefficients = [_ZERO, *(sympy.Rational((-1) ** (k + 1), k) for k in range(1, depth))]
        exponent = Expansion({ExpansionTerm(e=-p): a for p, a in m.growth})
        logarithms = Expansion({LOG: m.e, CONSTANT: sympy.log(first.coefficient)})
        return _series(first.rest, coefficients) + exponent + logarithms

    def exp(self, depth: int) -> Expansion:
        """The exponential: a monomial for each large term, and a series for what tends to 0."""
        parts = self.parts
        factor = CONSTANT
        for m, c in parts.large.items():
            factor = factor * _exponential(m, c)
        coefficients = [1 / sympy.factorial(k) for k in range(depth)]
        return _series(parts.small, coefficients).times(sympy.exp(parts.constant), factor)

    def taylor(self, function: Callable[[Expr], Expr], depth: int) -> Expansion | None:
        """f of it, where it tends to a point at which f is analytic: None where a derivative isn't finite there."""
        parts = self.parts
        if parts.large:
            return None
        is_constant = not parts.small.terms and not parts.small.errors
        if is_constant:
            depth = 1
        coefficients = _taylor_coefficients(function, parts.constant, depth)
        if coefficients is None:
            return None
        return _series(parts.small, coefficients)


@dataclass(frozen=True)
class ExpansionParts:
    """large + constant + small, where `small` tends to 0, and no term of `large` does."""

    large: dict[ExpansionTerm, Expr]
    constant: Expr
    small: Expansion


@dataclass(frozen=True)
class LeadingTerm:
    """c m (1 + d) for a coefficient c, a monomial m and a rest d that tends to 0."""

    monomial: ExpansionTerm
    coefficient: Expr
    rest: Expansion


def _exponential(m: ExpansionTerm, c: Expr) -> ExpansionTerm:
    """exp(c m) for a logarithm or a power m that isn't bounded."""
    if m == LOG:
        return ExpansionTerm(e=c)
    if m.growth or m.k or not m.e.is_Rational:
        raise UnknownBehaviour("an exponential that isn't that of a sum of powers")
    return ExpansionTerm(growth=((-m.e, c),))


def _taylor_coefficients(function: Callable[[Expr], Expr], point: Expr, count: int) -> list[Expr] | None:
    """f^(k)(a)/k!; None where one isn't finite."""
    z = sympy.Dummy()
    derivative = function(z)
    coefficients = []
    for k in range(count):
        if k:
            derivative = derivative.diff(z)
        value = derivative.subs(z, point)
        if value.has(sympy.nan, sympy.zoo, sympy.oo, z):
            return None
        coefficients.append(value / sympy.factorial(k))
    return coefficients


def _largest(errors: Iterable[ExpansionTerm]) -> tuple[ExpansionTerm, ...]:
    """Without those that are below others."""
    kept: list[ExpansionTerm] = []
    for error in errors:
        if not any(error.is_below(other) for other in kept):
            kept = [other for other in kept if not other.is_below(error)]
            kept.append(error)
    return tuple(kept)


def _series(small: Expansion, coefficients: list[Expr]) -> Expansion:
    """sum of coefficient * small^k, for something that tends to 0, up to O(small^n) for n coefficients."""
    n = len(coefficients)
    errors = [m.power(sympy.Integer(n)) for m in (*small.terms, *small.errors)]
    total = Expansion({CONSTANT: coefficients[-1]}, errors)
    for coefficient in reversed(coefficients[:-1]):
        total = total * small + Expansion({CONSTANT: coefficient}, errors)
    return total
