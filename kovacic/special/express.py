"""`solutions`: what was found as SymPy expressions.  Airy's, Bessel's, Kummer's and Tricomi's functions.

Y_nu and K_nu are independent of J_nu and I_nu for every nu.  Whittaker's equation has the solutions, z = 2 sqrt(q) f,

    M_mu = exp(-z/2) z^(1/2 + mu) 1F1(1/2 + mu - kappa; 1 + 2 mu; z),      M_-mu, where 2 mu isn't an integer,
    W = exp(-z/2) z^kappa 2F0(1/2 + mu - kappa, 1/2 - mu - kappa; -1/z),   W', with -kappa and -z.

W and W' are independent always, by their behaviour at infinity; M_mu and W where 1/2 + mu - kappa isn't an integer <= 0, since
a common solution would be elementary.  For a symbolic natural number N there are polynomials: 1F1(-N; 1 + a; z) is a multiple
of L_N^(a)(z), and W for mu^2 = 1/16, w^2 = z, of exp(-w^2/2) w^(1/2) H_N(w) with N = 2 kappa - 1/2, Weber's function; and
spherical Bessel functions for nu = N + 1/2.

Reference: DLMF 9.2, 10.2, 10.25, 10.47, 12.7, 13.2, 13.6, 13.14, 18.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Expr, hypergeometric
from kovacic.closed_form.check import is_numerical_solution
from kovacic.closed_form.product import product
from kovacic.errors import VerificationFailed
from kovacic.special.hypergeometric import gauss
from kovacic.special.pullback import Airy, Confluent, Gauss, Pullback
from kovacic.special.writer import HALF, Number, Term, Writer, WrittenFactor, by_parity, multiplicities


def solutions(
    pullback: Pullback, S: RatFunc, gauge: RatFunc, variable: str, symbols: Mapping[str, Any], *, joined: bool = False
) -> tuple[Expr, Expr] | None:
    """y1 and y2, checked at a point; None where the assumptions on the symbols leave open which solutions are independent.

    Raises `VerificationFailed` if the check fails, which is a defect of this package; `LimitExceeded` within `Budget.watched`.
    """
    writer = Writer(gauge, sympy.Symbol(variable), symbols)
    found = _written(writer, pullback, S.den if joined else None)
    for y in found or ():
        if not is_numerical_solution(y, writer.atoms.x, S, gauge):
            raise VerificationFailed(
                f"a special function for S = {S} failed its check; please report the equation: {y}"
            )
    own = {plain: symbol for plain, symbol in writer.symbols.items() if plain != symbol}
    return (found[0].xreplace(own), found[1].xreplace(own)) if found and own else found


def _written(writer: Writer, pullback: Pullback, singular: Poly | None) -> tuple[Expr, Expr] | None:
    equation, f = pullback.equation, pullback.f
    if isinstance(equation, Airy):  # u = Ai(q^(1/3) z)
        z, before = writer.root(equation.q, 3) * writer.argument(f), writer.factor(f, ())
        return writer.pair((before, sympy.airyai(z)), (before, sympy.airybi(z)))
    if isinstance(equation, Gauss):
        return gauss(writer, equation, f)
    if not equation.q:
        return _bessel(writer, 4 * equation.M + 1, f * equation.r, singular)
    if not equation.r:
        return _bessel(writer, equation.M + Fraction(1, 4), f * f * equation.q * Fraction(-1, 4), singular)
    return _whittaker(writer, equation, f)


def _bessel(writer: Writer, nu_squared: Poly, t: RatFunc, singular: Poly | None) -> tuple[Expr, Expr]:
    """u = sqrt(t) J_nu(2 sqrt t), or with I, K and -t where the constant factor of t is negative.

    Where t vanishes at a point that isn't `singular`, nu isn't an integer, and t^((1 +- nu)/2) 0F1(; 1 +- nu; -t) are analytic.
    """
    nu = writer.square_root(nu_squared)
    if singular is not None and any(k > 0 and p.gcd(singular).degree == 0 for p, k in multiplicities(t)):
        z = writer.argument(-t)
        pair = [
            (writer.factor(t, [((m + 1) * HALF, t)]), hypergeometric((), (writer.constant(m + 1),), z))
            for m in (nu, -nu)
        ]
        return writer.pair(pair[0], pair[1])
    modified = writer.is_negative(t.num.lc)
    z, power = writer.root_of(t * (-4 if modified else 4)), HALF
    degree = next((m - HALF for m in (nu, -nu) if writer.is_degree(m - HALF)), None)
    if degree is not None and not modified:  # J_nu = sqrt(2 z/pi) j_n
        n, power = writer.constant(degree), Fraction(3, 4)
        first, second = sympy.jn(n, z), sympy.yn(n, z)
    else:
        kinds = (sympy.besseli, sympy.besselk) if modified else (sympy.besselj, sympy.bessely)
        first, second = (kind(writer.constant(nu), z, evaluate=False) for kind in kinds)
    before = writer.factor(t, [(Number(nu_squared * 0 + power), t)])
    return writer.pair((before, first), (before, second))


@dataclass(frozen=True)
class _Form:
    """Whittaker's equation: the parameters, and sqrt(q)."""

    writer: Writer
    f: RatFunc
    q: Number
    kappa: Number
    mu: Number

    @property
    def turned(self) -> _Form:
        """The same with -z and -kappa."""
        return replace(self, q=-self.q, kappa=-self.kappa)

    @property
    def z(self) -> Expr:
        return self.writer.multiple(self.q * 2, self.f)

    def factor(self, power: Number) -> WrittenFactor:
        """exp(-z/2) z^power, and what belongs to the pull-back."""
        return self.writer.factor(self.f, [(power, self.f)], (-self.q, self.f))

    def kummer(self, mu: Number) -> Term:
        """M_mu."""
        a, b = self.writer.constant(mu - self.kappa + HALF), self.writer.constant(2 * mu + 1)
        return self.factor(mu + HALF), hypergeometric((a,), (b,), self.z)

    @property
    def tricomi(self) -> Term:
        """W."""
        a, b = (self.writer.constant(mu - self.kappa + HALF) for mu in (self.mu, -self.mu))
        return self.factor(self.kappa), hypergeometric((a, b), (), -1 / self.z)


def _whittaker(writer: Writer, equation: Confluent, f: RatFunc) -> tuple[Expr, Expr]:
    """Two solutions: polynomials where the degree is known to be natural, by the assumptions; else M_mu, M_-mu, or W.

    The sign of sqrt(q) makes the exponential vanish where it can, or z positive.
    """
    q, mu = writer.square_root(equation.q), writer.square_root(equation.M + Fraction(1, 4))
    given, slope = product(writer.gauge).exponential.derivative(), f.derivative() * q.part
    if given == -slope if given in (slope, -slope) and given else writer.is_negative(f.num.lc):
        q = -q
    one = _Form(writer, f, q, q * (equation.r / (2 * equation.q)), mu)
    for form in (one, one.turned):
        found = _hermite(form) or _laguerre(form)
        if found is not None:
            return found
    if not writer.is_integer(2 * mu):
        return writer.pair(one.kummer(mu), one.kummer(-mu))
    natural = next((m for m in (mu, -mu) if writer.is_natural(2 * m)), None)
    reducible = any(writer.is_integer(one.kappa + m - HALF) for m in (mu, -mu))
    return writer.pair(one.turned.tricomi if natural is None or reducible else one.kummer(natural), one.tricomi)


def _hermite(form: _Form) -> tuple[Expr, Expr] | None:
    writer, degree, quarter = form.writer, 2 * form.kappa - HALF, Fraction(1, 4)
    even_powers = all(k % 2 == 0 for _, k in multiplicities(form.f))
    if not writer.is_degree(degree) or form.mu.roots or form.mu.part != quarter or form.q.roots or not even_powers:
        return None
    N, before, root = writer.constant(degree), form.factor(form.mu), writer.root_of(form.f * form.q.part * 2)
    even = hypergeometric((-N / 2,), (sympy.S.Half,), form.z)
    odd = root * hypergeometric(((1 - N) / 2,), (sympy.Rational(3, 2),), form.z)
    return writer.pair((before, sympy.hermite(N, root)), (before, by_parity(N, odd, even)))


def _laguerre(form: _Form) -> tuple[Expr, Expr] | None:
    writer = form.writer
    for mu in (form.mu, -form.mu):
        degree, integer = form.kappa - mu - HALF, writer.is_integer(2 * mu)
        if writer.is_degree(degree) and (writer.is_natural(2 * mu) or not integer):
            N, a = writer.constant(degree), writer.constant(2 * mu)
            polynomial = sympy.assoc_laguerre(N, a, form.z) if a else sympy.laguerre(N, form.z)
            second = form.turned.tricomi if integer else form.kummer(-mu)
            return writer.pair((form.factor(mu + HALF), polynomial), second)
    return None
