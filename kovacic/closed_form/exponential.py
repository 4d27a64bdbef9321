"""int r exp(E) dx for rational functions r and E: a rational function times exp(E), Ei and error functions of rational ones.

The derivatives of exp(e) Ei(E - e) and of exp(e) int^q exp(b u^2) du, where E = e + b q^2, are exp(E) times

    E'/(E - e)      and      q'.                                                                                      (1)

Hermite's reduction leaves simple poles of r outside those of E.  At such a pole a, e = E(a); the zeros of E - e are poles then,
with residues in proportion to their multiplicities, or there is no such integral.  The other e without a choice are the value
at infinity, where E - e has no zero, and the values at zeros of E' for which (E - e)/b is a square.  What is left is
W' + W E' with a W whose denominator and degree are bounded by those of r and E, and constant multiples of (1): linear
equations over K.

Reference: Risch's algorithm for exponentials [Bronstein, Symbolic Integration I, ch. 5]; with Ei and erf as in G. W. Cherry,
J. Symb. Comp. 1 (1985), here for constants e in K only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.factors import combination
from kovacic.algebra.partial_fractions import Residue, prime_part, reduce_poles
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class GammaTerm:
    """`coefficient` * int t^(power + alpha) exp(beta t^n) dx, equation (1) of `kovacic.closed_form.primitive`."""

    coefficient: Poly
    power: int


@dataclass(frozen=True)
class ErrorTerm:
    """coefficient * exp(e) int^q exp(b u^2) du, with E = e + b q^2."""

    coefficient: Poly
    q: RatFunc
    b: Poly
    e: Poly


@dataclass(frozen=True)
class ExponentialPrimitive:
    """int r k dx, k = t^alpha exp(E): W k + sum of c exp(e) Ei(E - e) for (c, e) in `logarithmic` + sum of `errors`.

    t is x - c or (x - c)/(x - d), and everything else a function of t.  There are `terms` if E is a `monomial`.  Conjugate
    simple `poles` a with residues rho give, for E = beta t + constant and alpha = 0, rho exp(E(a)) Ei(E - E(a)); and for E = 0,
    n the denominator of alpha, rho * sum of z^(n alpha) log(t^(1/n) - z) over the n-th roots z of a.
    """

    t: RatFunc
    E: RatFunc
    W: RatFunc
    logarithmic: tuple[tuple[Poly, Poly], ...] = ()
    errors: tuple[ErrorTerm, ...] = ()
    alpha: Fraction = Fraction(0)
    terms: tuple[GammaTerm, ...] = ()
    poles: tuple[Residue, ...] = ()

    @property
    def _rate(self) -> RatFunc:
        """dk/dt over k."""
        slope = self.E.derivative()
        return slope + self.alpha / RatFunc(self.t.field.poly([0, 1])) if self.alpha else slope

    @property
    def kernel_derivative(self) -> RatFunc:
        """k'/k."""
        return self._rate(self.t) * self.t.derivative()

    @property
    def integrand(self) -> RatFunc:
        """r, recomputed from the result by (1)."""
        slope, t = self.E.derivative(), RatFunc(self.t.field.poly([0, 1]))
        total = self.W.derivative() + self.W * self._rate
        total = sum((slope / (self.E - e) * c for c, e in self.logarithmic), total)
        total = sum((term.q.derivative() * term.coefficient for term in self.errors), total)
        total = sum((t**term.power * term.coefficient for term in self.terms), total)
        return sum((residue.logarithmic for residue in self.poles), total)(self.t) * self.t.derivative()


def monomial(E: RatFunc) -> tuple[Poly, int, Poly] | None:
    """(beta, n, c) with E = beta x^n + c, None if it isn't so."""
    c = E.num[0] if E.is_polynomial else E.num // E.den
    rest = E - c
    n = rest.num.degree - rest.den.degree
    x = RatFunc(E.field.poly([0, 1]))
    return (rest.num.lc, n, c) if c.degree <= 0 and rest == x**n * rest.num.lc else None


def integrate_composite(r: RatFunc, E: RatFunc) -> ExponentialPrimitive | str:
    """int r exp(E) dx, or why it is left.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> done = integrate_composite((x**2 + 1) / (x * (x**2 - 1)), x - 1 / x)
    >>> print(done.W, [(str(c), str(e)) for c, e in done.logarithmic])  # Ei(x - 1/x)
    0 [('1', '0')]
    """
    slope = E.derivative()
    W, rest, residues = reduce_poles(r, slope, E.den)
    logarithmic: list[tuple[Poly, Poly]] = []
    for found in residues:
        p, rho = found.factor, found.value
        if rest.den % p:  # dealt with at another zero of E - e
            continue
        e = E.num * E.den.inverse_modulo(p) % p
        multiplicity = 0 if e.degree > 0 else (E - e).num.remove(p)[1]
        if rho.degree > 0 or not multiplicity:
            return "a pole with a residue remains beside the exponential"
        c = rho * Fraction(1, multiplicity)
        rest = rest - slope / (E - e) * c
        logarithmic.append((c, e))
    if prime_part(rest.den, E.den).degree > 0:
        return "a pole with a residue remains beside the exponential"
    levels = [e for e in _limit(E) if (E - e).num.degree == 0 and all(e != known for _, known in logarithmic)]
    squares = list(_squares(E))
    candidates = [slope / (E - e) for e in levels] + [q.derivative() for q, _, _ in squares]
    solved = _with_rational_part(rest, E, candidates)
    if solved is None:
        return "it isn't a rational function times the exponential, with Ei and erf of rational functions"
    more, constants = solved
    logarithmic += [(c, e) for c, e in zip(constants, levels, strict=False) if c]
    errors = [ErrorTerm(c, *square) for c, square in zip(constants[len(levels) :], squares, strict=True) if c]
    return ExponentialPrimitive(RatFunc(r.field.poly([0, 1])), E, W + more, tuple(logarithmic), tuple(errors))


def _limit(E: RatFunc) -> list[Poly]:
    """The value at infinity, if E is finite there."""
    finite = E.num.degree <= E.den.degree
    return [E.num.lc / E.den.lc if E.num.degree == E.den.degree else E.num * 0] if finite else []


def _squares(E: RatFunc) -> Iterator[tuple[RatFunc, Poly, Poly]]:
    """(q, b, e) with E = e + b q^2."""
    slope = E.derivative().num
    factors = E.field.factor(slope) if slope.degree > 0 else []
    values = [E.num * E.den.inverse_modulo(p) % p for p, _ in factors] + _limit(E)
    for e in dict.fromkeys(values):
        level = E - e
        if e.degree > 0 or not level:
            continue
        top, bottom = (part.monic().root(2) for part in (level.num, level.den))
        if top is not None and bottom is not None:
            yield RatFunc(top, bottom), level.num.lc / level.den.lc, e


def _with_rational_part(r: RatFunc, E: RatFunc, candidates: list[RatFunc]) -> tuple[RatFunc, list[Poly]] | None:
    """(W, constants) with r = W' + W E' + the sum of constants times candidates; None where there are none."""
    field, slope = r.field, E.derivative()
    functions = [f for f in (r, *candidates) if f]
    den = field.poly([1])
    for p, m in field.factor(E.den) if E.den.degree > 0 else []:
        order = max((f.den.remove(p)[1] for f in functions), default=0)
        den = den * p ** max(order - m - 1, 0)
    growth = max((f.num.degree - f.den.degree for f in functions), default=0)
    at_infinity = E.num.degree - E.den.degree
    degree = growth - at_infinity + 1 if at_infinity > 0 else max(growth + 1, 0)
    basis = [RatFunc(field.poly([*[0] * j, 1]), den) for j in range(degree + den.degree + 1)]
    images = [w.derivative() + w * slope for w in basis] + candidates
    common = field.poly([1])
    for f in (r, *images):
        common = common * (f.den // common.gcd(f.den))
    polynomials = [f.num * (common // f.den) for f in (r, *images)]
    found = combination(polynomials[0], polynomials[1:])
    if found is None:
        return None
    W = sum((w * c for w, c in zip(basis, found, strict=False)), RatFunc(field.poly([])))
    return W, found[len(basis) :]
