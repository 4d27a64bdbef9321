"""int y^-2 dx for a product y: the second solution y int y^-2 of a reducible equation.

With h = y^-2 = r k, r rational and k the part that isn't, the integral is W k plus what no W k can express: logarithms for
k = 1, the integrals (2) of `kovacic.closed_form.curve` for k = 1/sqrt(g), and for k = t^alpha exp(E), E rational, these:

    int^q u^(m + alpha) exp(b u^n) du,      E = e + b q^n,                                                               (1)

whose derivative is t^alpha exp(E - e) q' q^m (q = t for alpha other than 0): Ei(q) for m = -1 and b = n = 1, error functions
for n = 2 and m = 0, and, where E = e + b t^n, gamma functions for 0 <= s = (m + alpha + 1)/n < 1.

Hermite's reduction leaves simple poles of r outside those of E.  At such a pole a, e = E(a); the zeros of E - e are poles then,
with residues in proportion to their multiplicities, or there is no such integral.  The other e without a choice are the value
at infinity, where E - e has no zero, and the values at zeros of E' for which (E - e)/b is a square.  What is left is
W' + W (E' + alpha/t) with a W whose denominator and degree are bounded by those of r and E, and constant multiples of (1):
linear equations over K.

Reference: Risch's algorithm for exponentials [Bronstein, Symbolic Integration I, ch. 5]; with erf as in G. W. Cherry,
J. Symb. Comp. 1 (1985) 283-302, and Ei (there li) as in SIAM J. Comput. 15 (1986) 1-21; here for constants e in K only.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from math import floor

from kovacic.algebra.factors import combination
from kovacic.algebra.partial_fractions import Decomposition, Residue, decompose, prime_part, reduce_poles
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.closed_form.curve import CurveIntegral, completed, integrate_on_curve
from kovacic.closed_form.product import Product
from kovacic.limits import MOST_CHARACTERS


@dataclass(frozen=True)
class OpenPrimitive:
    """An integral left unevaluated, with the `reason`."""

    reason: str


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
        """The derivative of the term, over t^alpha exp(E)."""
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
        return _kernel_rate(self.E, self.alpha)(self.t) * self.t.derivative()

    @property
    def integrand(self) -> RatFunc:
        """r, recomputed from the result by (1)."""
        total = self.W.derivative() + self.W * _kernel_rate(self.E, self.alpha)
        total = sum((term.derivative for term in self.terms), total)
        return sum((residue.logarithmic for residue in self.poles), total)(self.t) * self.t.derivative()


def _kernel_rate(E: RatFunc, alpha: Fraction) -> RatFunc:
    """dk/dt over k, for k = t^alpha exp(E)."""
    if not alpha:
        return E.derivative()
    return E.derivative() + alpha / RatFunc(E.field.x)


def monomial(E: RatFunc) -> tuple[Poly, int, Poly] | None:
    """(beta, n, c) with E = beta x^n + c, or None if E isn't of this form."""
    x = RatFunc(E.field.x)
    rate = E.derivative() * x  # n beta x^n
    n = rate.degree
    if rate != x**n * rate.num.lc:
        return None
    beta = rate.num.lc / n
    return beta, n, (E - x**n * beta).num[0]


def integrate_exponential(
    r: RatFunc, E: RatFunc, alpha: Fraction = Fraction(0), t: RatFunc | None = None
) -> ExponentialPrimitive | OpenPrimitive:
    """int r x^alpha exp(E) dx, with t in place of x in the result; alpha isn't an integer other than 0.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> done = integrate_exponential((x**2 + 1) / (x * (x**2 - 1)), x - 1 / x)  # Ei(x - 1/x)
    >>> print(done.W, [(str(term.coefficient), str(term.q), term.power) for term in done.terms])
    0 [('1', '(x**2 - 1)/x', -1)]
    """
    x = RatFunc(r.field.x)
    apart = E.den * x.num if alpha else E.den
    W, reduced, residues = reduce_poles(r, _kernel_rate(E, alpha), apart)
    at_poles = _at_poles(reduced, residues, E, alpha)
    if at_poles is None or prime_part(at_poles[0].den, apart).degree > 0:
        return OpenPrimitive("a pole with a residue remains next to the exponential")
    rest, terms, poles = at_poles
    levels = [term.e for term in terms]
    candidates = [term for term in _gamma_candidates(E, alpha) if term.power != -1 or term.e not in levels]
    solved = _with_rational_part(rest, E, alpha, [term.derivative for term in candidates])
    if solved is None:
        return OpenPrimitive(
            "it isn't a rational function times the exponential, with Ei and erf of rational functions"
        )
    more, constants = solved
    others = [replace(term, coefficient=c) for term, c in zip(candidates, constants, strict=True) if c]
    return ExponentialPrimitive(t or x, E, W + more, alpha, (*terms, *others), tuple(poles))


def _at_poles(
    r: RatFunc, residues: Iterable[Residue], E: RatFunc, alpha: Fraction
) -> tuple[RatFunc, list[GammaTerm], list[Residue]] | None:
    """The rest of r, terms with Ei for the residues, and conjugate poles; None if a residue fits neither."""
    rest = r
    terms: list[GammaTerm] = []
    poles: list[Residue] = []
    for found in residues:
        if rest.den % found.factor:  # the pole went with another zero of E - e
            continue
        term = None if alpha else _exponential_integral(found, E)
        if term is not None:
            terms.append(term)
            rest = rest - term.derivative
        elif E.is_polynomial and E.num.degree <= (0 if alpha else 1):
            # Conjugate poles have terms of their own for E = beta x + constant, or for a constant E and a power of x.
            poles.append(found)
            rest = rest - found.logarithmic
        else:
            return None
    return rest, terms, poles


def _exponential_integral(found: Residue, E: RatFunc) -> GammaTerm | None:
    """exp(e) Ei(E - e) with the residue, e the value of E at the pole; None if e or the residue isn't in K."""
    p = found.factor
    e = E.num * E.den.inverse_modulo(p) % p
    multiplicity = (E - e).num.remove(p)[1] if e.degree <= 0 else 0
    if not multiplicity or not found.is_constant:
        return None
    one = E.field.one
    return GammaTerm(found.value * Fraction(1, multiplicity), E - e, one, e, 1, -1)


def _gamma_candidates(E: RatFunc, alpha: Fraction) -> Iterator[GammaTerm]:
    """The terms (1) that don't come from poles, with the coefficient 1."""
    one = E.field.one
    if not alpha:
        for e in _limit(E):
            yield GammaTerm(one, E - e, one, e, 1, -1)
        for q, b, e in _squares(E):
            yield GammaTerm(one, q, b, e, 2, 0)
    shape = monomial(E) if E else None
    if shape is not None:
        yield from _gamma_terms(*shape, alpha)


def _gamma_terms(beta: Poly, n: int, e: Poly, alpha: Fraction) -> Iterator[GammaTerm]:
    """Terms with 0 < s < 1 for E = beta x^n + e; for alpha = 0, s = 0 is Ei, found before, and s = 1/2 an error function."""
    x = RatFunc(beta.field.x)
    one = beta.field.one
    for m in range(-abs(n) - 2 - int(alpha), abs(n) + 2 - int(alpha)):
        s = (m + alpha + 1) / n
        if 0 < s < 1:
            yield GammaTerm(one, x, beta, e, n, m)


def _limit(E: RatFunc) -> list[Poly]:
    """The value at infinity, if E is finite there."""
    return [] if E.num.degree > E.den.degree else [E.num[E.den.degree] / E.den.lc]


def _squares(E: RatFunc) -> Iterator[tuple[RatFunc, Poly, Poly]]:
    """(q, b, e) with E = e + b q^2."""
    factors = E.field.factor(E.derivative().num)
    values = [E.num * E.den.inverse_modulo(p) % p for p, _ in factors] + _limit(E)
    for e in dict.fromkeys(values):
        level = E - e
        if e.degree > 0 or not level:
            continue
        top = level.num.monic().root(2)
        bottom = level.den.monic().root(2)
        if top is not None and bottom is not None:
            yield RatFunc(top, bottom), level.num.lc / level.den.lc, e


def _with_rational_part(
    r: RatFunc, E: RatFunc, alpha: Fraction, candidates: list[RatFunc]
) -> tuple[RatFunc, list[Poly]] | None:
    """(W, constants), r = W' + W (E' + alpha/x) + the sum of constants times candidates, or None."""
    x = r.field.x
    rate = _kernel_rate(E, alpha)
    functions = [f for f in (r, *candidates) if f]
    den = _denominator(functions, E, alpha)
    # A bound of deg num - deg den for W, from what W' + W E' gives.
    growth = max((f.degree for f in functions), default=0)
    at_infinity = E.degree
    most = growth - at_infinity + 1 if at_infinity > 0 else max(growth + 1, 0)
    basis = [RatFunc(x**j, den) for j in range(most + den.degree + 1)]
    images = [w.derivative() + w * rate for w in basis] + candidates
    wanted, *numerators = over_one_denominator([r, *images])
    found = combination(wanted, numerators)
    if found is None:
        return None
    W = sum((w * c for w, c in zip(basis, found, strict=False)), RatFunc(r.field.zero))
    return W, found[len(basis) :]


def _denominator(functions: list[RatFunc], E: RatFunc, alpha: Fraction) -> Poly:
    """The denominator of W: a pole of order m of E raises the order of a pole of W by m + 1, and a factor x^alpha by 1."""
    den = E.field.one
    of_root = [(E.field.x, 0)] if alpha and E.den[0] else []
    for p, m in (*E.field.factor(E.den), *of_root):
        order = max((f.den.remove(p)[1] for f in functions), default=0)
        den = den * p ** max(order - m - 1, 0)
    return den


#: A pair of solutions is short if it takes at most `MOST_CHARACTERS`, or this multiple of the shortest form.
FACTOR = 4
#: Why an integral is left.
LONG = "written out it would take some {} characters"


@dataclass(frozen=True)
class RationalPrimitive:
    """k = 1: a rational function and logarithms."""

    parts: Decomposition

    @property
    def kernel_derivative(self) -> RatFunc:
        return self.parts.exact * 0

    @property
    def integrand(self) -> RatFunc:
        return self.parts.derivative


#: int r k dx, with r as `integrand` and k'/k as `kernel_derivative`.
Primitive = RationalPrimitive | CurveIntegral | ExponentialPrimitive | OpenPrimitive


def integrate_inverse_square(y: Product) -> Primitive:
    """int y^-2 dx; left unevaluated if the result would be too long compared with the integral."""
    h = y.to_power(-2)
    # About how many terms the integral has, with coefficients of as many digits: this number squared is about its length.
    # (x - 1)^-40 (x - 2)^-2 exp(-2 x) has 42 and 2,000 characters, its power 400 has 1.5 million.
    poles = [(power.base.degree, -(power.rational_exponent or 0)) for power in h.powers]
    is_a_power = len(poles) == 1 and poles[0][0] == 1 and not h.exponential
    terms = 1 if is_a_power else sum(degree * int(order) for degree, order in poles if order > 0)
    most = max(MOST_CHARACTERS, FACTOR * (2 * y.length + h.length))
    if terms**2 > 4 * most:
        return OpenPrimitive(LONG.format(terms**2))
    return integrate(h)


def integrate(h: Product) -> Primitive:
    """int h dx.

    >>> from kovacic.algebra.rationals import QQ
    >>> from kovacic.closed_form.product import product
    >>> x = RatFunc(QQ.x)
    >>> y = product(-x / 2, QQ.poly([0, -3, 0, 1]))  # (x^3 - 3 x) exp(-x^2/4)
    >>> done = integrate(y.to_power(-2))
    >>> print(done.W, [(str(term.coefficient), term.n, term.power) for term in done.terms])
    (-x**2 + 2)/(6*x**3 - 18*x) [('1/6', 2, 0)]
    """
    if h.roots:
        return OpenPrimitive(f"the exponents at the roots of {h.roots[0].factor} are different algebraic numbers")
    rational = RatFunc(h.field.one)
    fractional: list[_Root] = []
    for power in h.powers:
        exponent = power.rational_exponent
        if exponent is None:
            return OpenPrimitive(f"the exponent at {power.base} is irrational")
        if abs(exponent) > MOST_CHARACTERS:  # the integral would be a sum of about as many terms
            return OpenPrimitive(f"the factor {power.base} has the power {exponent} in the integrand")
        if exponent.denominator == 1:
            rational = rational * RatFunc(power.base) ** int(exponent)
        else:
            fractional.append((power.base, exponent))
    E = h.exponential
    if E.is_polynomial and E.num.degree <= 0:
        return _without_exponential(rational, fractional)
    return _exponential_primitive(rational, fractional, E)


_Root = tuple[Poly, Fraction]
"""p^alpha for a polynomial p and a fraction alpha."""


def _without_exponential(rational: RatFunc, fractional: list[_Root]) -> Primitive:
    """int r k dx for a product k of roots."""
    if not fractional:
        return RationalPrimitive(decompose(rational))
    is_line = [p.degree for p, _ in fractional] == [1]
    if not is_line and all(alpha.denominator == 2 for _, alpha in fractional):
        g = rational.field.one  # on s^2 = g, g the product of the radicands
        for p, alpha in fractional:
            g = g * p
            rational = rational * RatFunc(p) ** int(alpha + Fraction(1, 2))
        return completed(integrate_on_curve(rational, g))
    if all(p.degree == 1 for p, _ in fractional) and len(fractional) <= 2:
        first, second = (*fractional, (rational.field.one, -fractional[0][1]))[:2]
        if (first[1] + second[1]).denominator == 1:
            return _with_a_quotient(rational, first, second)
    return OpenPrimitive("it is an incomplete beta integral, with fractional powers of several factors")


def _with_a_quotient(rational: RatFunc, first: _Root, second: _Root) -> Primitive:
    """int r p^alpha q^beta dx for p = x + c, q = x + d or 1, and an integer alpha + beta, by t = p/q."""
    (p, alpha), (q, beta) = first, second
    x = RatFunc(p.field.poly([-p[0], q[0]]), p.field.poly([1, -q[1]]))  # t (q_1 x + q_0) = x + p_0
    r = rational(x) * RatFunc(q)(x) ** int(alpha + beta) * x.derivative()
    shift = floor(alpha) + 1  # to an exponent between -1 and 0
    t = RatFunc(p.field.x)
    return integrate_exponential(r * t**shift, r * 0, alpha - shift, RatFunc(p, q))


def _exponential_primitive(r: RatFunc, fractional: list[_Root], E: RatFunc) -> Primitive:
    """int r k exp(E) dx for at most one root k of a linear polynomial: in x less a centre."""
    if len(fractional) > 1 or any(p.degree > 1 for p, _ in fractional):
        return OpenPrimitive("the integrand has an exponential and fractional powers of several factors")
    alpha = fractional[0][1] if fractional else Fraction(0)
    centre = _centre(fractional, E)
    moved, back = (RatFunc(r.field.poly([c, 1])) for c in (centre[0], -centre[0]))
    return integrate_exponential(r(moved), E(moved), alpha, back)


def _centre(fractional: list[_Root], E: RatFunc) -> Poly:
    """The zero of the root, else the mean of the poles, or of the zeros of a polynomial."""
    if fractional:
        return fractional[0][0].mean_of_zeros
    return (E.num if E.is_polynomial else E.den).mean_of_zeros


def normalised_constant(exact: RatFunc) -> RatFunc:
    """The antiderivative that vanishes at the zero of the integrand of the highest multiplicity, if that isn't 1."""
    multiple = [(k, p) for p, k in exact.field.factor(exact.derivative().num) if p.degree == 1 and k > 1]
    if not multiple:
        return exact
    _, p = max(multiple, key=lambda pair: pair[0])
    return exact - exact.num * exact.den.inverse_modulo(p) % p
