"""int r t^alpha exp(E) dt for rational functions r and E: a rational function times the rest, and functions of these kinds:

    int^q u^(m + alpha) exp(b u^n) du,      E = e + b q^n,                                                               (1)

whose derivative is t^alpha exp(E - e) q' q^m (q = t for alpha other than 0): Ei(q) for m = -1 and b = n = 1, error functions
for n = 2 and m = 0, and, where E = e + b t^n, gamma functions for 0 <= s = (m + alpha + 1)/n < 1.

Hermite's reduction leaves simple poles of r outside those of E.  At such a pole a, e = E(a); the zeros of E - e are poles then,
with residues in proportion to their multiplicities, or there is no such integral.  The other e without a choice are the value
at infinity, where E - e has no zero, and the values at zeros of E' for which (E - e)/b is a square.  What is left is
W' + W (E' + alpha/t) with a W whose denominator and degree are bounded by those of r and E, and constant multiples of (1):
linear equations over K.

Reference: Risch's algorithm for exponentials [Bronstein, Symbolic Integration I, ch. 5]; with Ei and erf as in G. W. Cherry,
J. Symb. Comp. 1 (1985), here for constants e in K only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from kovacic.algebra.factors import combination
from kovacic.algebra.partial_fractions import Residue, prime_part, reduce_poles
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class GammaTerm:
    """`coefficient` * exp(e) times the integral (1)."""

    coefficient: Poly
    q: RatFunc
    b: Poly
    e: Poly
    n: int
    power: int

    @property
    def derivative(self) -> RatFunc:
        """That of the term, over t^alpha exp(E)."""
        return self.q.derivative() * self.q**self.power * self.coefficient


@dataclass(frozen=True)
class ExponentialPrimitive:
    """int r k dx, k = t^alpha exp(E): W k + `terms`, and what conjugate simple `poles` a with residues rho give.

    t is x - c or (x - c)/(x - d), and everything else a function of t.  The poles give, for E = beta t + constant and
    alpha = 0, rho exp(E(a)) Ei(E - E(a)); and for E = 0, n the denominator of alpha, rho * sum of
    z^(n alpha) log(t^(1/n) - z) over the n-th roots z of a.
    """

    t: RatFunc
    E: RatFunc
    W: RatFunc
    alpha: Fraction = Fraction(0)
    terms: tuple[GammaTerm, ...] = ()
    poles: tuple[Residue, ...] = ()

    @property
    def kernel_derivative(self) -> RatFunc:
        """k'/k."""
        return _rate(self.E, self.alpha)(self.t) * self.t.derivative()

    @property
    def integrand(self) -> RatFunc:
        """r, recomputed from the result by (1)."""
        total = self.W.derivative() + self.W * _rate(self.E, self.alpha)
        total = sum((term.derivative for term in self.terms), total)
        return sum((residue.logarithmic for residue in self.poles), total)(self.t) * self.t.derivative()


def _rate(E: RatFunc, alpha: Fraction) -> RatFunc:
    """dk/dt over k, for k = t^alpha exp(E)."""
    return E.derivative() + alpha / RatFunc(E.field.poly([0, 1])) if alpha else E.derivative()


def monomial(E: RatFunc) -> tuple[Poly, int, Poly] | None:
    """(beta, n, c) with E = beta x^n + c, None if it isn't so."""
    c = E.num[0] if E.is_polynomial else E.num // E.den
    rest = E - c
    n = rest.num.degree - rest.den.degree
    x = RatFunc(E.field.poly([0, 1]))
    return (rest.num.lc, n, c) if c.degree <= 0 and rest == x**n * rest.num.lc else None


def integrate_exponential(r: RatFunc, E: RatFunc, alpha: Fraction = Fraction(0)) -> ExponentialPrimitive | str:
    """int r x^alpha exp(E) dx, or why it is left; alpha isn't an integer other than 0.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> done = integrate_exponential((x**2 + 1) / (x * (x**2 - 1)), x - 1 / x)  # Ei(x - 1/x)
    >>> print(done.W, [(str(term.coefficient), str(term.q), term.power) for term in done.terms])
    0 [('1', '(x**2 - 1)/x', -1)]
    """
    x = RatFunc(r.field.poly([0, 1]))
    one = r.field.poly([1])
    rate = _rate(E, alpha)
    apart = E.den * x.num if alpha else E.den
    W, rest, residues = reduce_poles(r, rate, apart)
    terms = []
    poles = []
    for found in residues:
        p = found.factor
        rho = found.value
        if rest.den % p:  # dealt with at another zero of E - e
            continue
        e = E.num * E.den.inverse_modulo(p) % p
        multiplicity = 0 if alpha or e.degree > 0 else (E - e).num.remove(p)[1]
        if multiplicity and rho.degree <= 0:
            terms.append(GammaTerm(rho * Fraction(1, multiplicity), E - e, one, e, 1, -1))
            rest = rest - terms[-1].derivative
        elif E.is_polynomial and E.num.degree < (1 if alpha else 2):
            poles.append(found)
            rest = rest - found.logarithmic
        else:
            return "a pole with a residue remains beside the exponential"
    if prime_part(rest.den, apart).degree > 0:
        return "a pole with a residue remains beside the exponential"
    levels = [term.e for term in terms]
    candidates = [term for term in _candidates(E, alpha) if term.power != -1 or term.e not in levels]
    solved = _with_rational_part(rest, E, alpha, [term.derivative for term in candidates])
    if solved is None:
        return "it isn't a rational function times the exponential, with Ei and erf of rational functions"
    more, constants = solved
    terms += [replace(term, coefficient=c) for term, c in zip(candidates, constants, strict=True) if c]
    return ExponentialPrimitive(x, E, W + more, alpha, tuple(terms), tuple(poles))


def _candidates(E: RatFunc, alpha: Fraction) -> Iterator[GammaTerm]:
    """The terms (1) that no pole tells of, with the coefficient 1."""
    x = RatFunc(E.field.poly([0, 1]))
    one = E.field.poly([1])
    if not alpha:
        for e in _limit(E):
            if (E - e).num.degree == 0:
                yield GammaTerm(one, E - e, one, e, 1, -1)
        for q, b, e in _squares(E):
            yield GammaTerm(one, q, b, e, 2, 0)
    if E and (shape := monomial(E)) is not None:
        beta, n, e = shape
        for m in range(-abs(n) - 2 - int(alpha), abs(n) + 2 - int(alpha)):
            s = (m + alpha + 1) / n
            if 0 <= s < 1 and (alpha or s not in (0, Fraction(1, 2))):
                yield GammaTerm(one, x, beta, e, n, m)


def _limit(E: RatFunc) -> list[Poly]:
    """The value at infinity, if E is finite there."""
    if E.num.degree > E.den.degree:
        return []
    return [E.num.lc / E.den.lc if E.num.degree == E.den.degree else E.num * 0]


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


def _with_rational_part(
    r: RatFunc, E: RatFunc, alpha: Fraction, candidates: list[RatFunc]
) -> tuple[RatFunc, list[Poly]] | None:
    """(W, constants), r = W' + W (E' + alpha/x) + the sum of constants times candidates; None where there are none."""
    field = r.field
    rate = _rate(E, alpha)
    functions = [f for f in (r, *candidates) if f]
    den = field.poly([1])
    x = field.poly([0, 1])
    poles = field.factor(E.den) if E.den.degree > 0 else []
    for p, m in [*poles, (x, 0)] if alpha and E.den[0] else poles:
        order = max((f.den.remove(p)[1] for f in functions), default=0)
        den = den * p ** max(order - m - 1, 0)
    growth = max((f.num.degree - f.den.degree for f in functions), default=0)
    at_infinity = E.num.degree - E.den.degree
    degree = growth - at_infinity + 1 if at_infinity > 0 else max(growth + 1, 0)
    basis = [RatFunc(x**j, den) for j in range(degree + den.degree + 1)]
    images = [w.derivative() + w * rate for w in basis] + candidates
    common = field.poly([1])
    for f in (r, *images):
        common = common * (f.den // common.gcd(f.den))
    polynomials = [f.num * (common // f.den) for f in (r, *images)]
    found = combination(polynomials[0], polynomials[1:])
    if found is None:
        return None
    W = sum((w * c for w, c in zip(basis, found, strict=False)), RatFunc(field.poly([])))
    return W, found[len(basis) :]
