"""Kummer's and Tricomi's functions; Hermite and Laguerre polynomials where the degree is a symbolic natural number.

Whittaker's equation has the solutions, z = 2 sqrt(q) f,

    M_mu = exp(-z/2) z^(1/2 + mu) 1F1(1/2 + mu - kappa; 1 + 2 mu; z),      M_-mu, where 2 mu isn't an integer,
    W = exp(-z/2) z^kappa 2F0(1/2 + mu - kappa, 1/2 - mu - kappa; -1/z),   W', with -kappa and -z.

W and W' are independent always, by their behaviour at infinity; M_mu and W where 1/2 + mu - kappa isn't an integer <= 0, since
a common solution would be elementary.  1F1(-N; 1 + a; z) is a multiple of L_N^(a)(z), and W for mu^2 = 1/16, w^2 = z, of
exp(-w^2/2) w^(1/2) H_N(w) with N = 2 kappa - 1/2, Weber's function.

Reference: DLMF 12.7, 13.2, 13.6, 13.14, 18.5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

import sympy

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Expr
from kovacic.closed_form.product import product
from kovacic.special.pullback import Confluent
from kovacic.special.writer import HALF, Factor, Number, Term, Writer, by_parity, hypergeometric, multiplicities


@dataclass(frozen=True)
class Whittaker:
    """The parameters, and sqrt(q)."""

    writer: Writer
    f: RatFunc
    q: Number
    kappa: Number
    mu: Number

    @property
    def turned(self) -> Whittaker:
        """The same with -z and -kappa."""
        return replace(self, q=-self.q, kappa=-self.kappa)

    @property
    def z(self) -> Expr:
        return self.writer.multiple(self.q * 2, self.f)

    def factor(self, power: Number) -> Factor:
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


def whittaker(writer: Writer, equation: Confluent, f: RatFunc) -> tuple[Expr, Expr]:
    """Two solutions: polynomials where the degree is known to be natural, by the assumptions; else M_mu, M_-mu, or W."""
    one = _parameters(writer, equation, f)
    for form in (one, one.turned):
        found = _hermite(form) or _laguerre(form)
        if found is not None:
            return found
    if not writer.is_integer(2 * one.mu):
        return writer.pair(one.kummer(one.mu), one.kummer(-one.mu))
    natural = next((mu for mu in (one.mu, -one.mu) if writer.is_natural(2 * mu)), None)
    reducible = any(writer.is_integer(one.kappa + mu - HALF) for mu in (one.mu, -one.mu))
    return writer.pair(one.turned.tricomi if natural is None or reducible else one.kummer(natural), one.tricomi)


def _parameters(writer: Writer, equation: Confluent, f: RatFunc) -> Whittaker:
    """The sign of sqrt(q) makes the exponential vanish where it can, or z positive."""
    q, mu = writer.square_root(equation.q), writer.square_root(equation.M + Fraction(1, 4))
    given, slope = product(writer.gauge).exponential.derivative(), f.derivative() * q.part
    if given == -slope if given in (slope, -slope) and given else writer.is_negative(f.num.lc):
        q = -q
    return Whittaker(writer, f, q, q * (equation.r / (2 * equation.q)), mu)


def _hermite(form: Whittaker) -> tuple[Expr, Expr] | None:
    writer, degree, quarter = form.writer, 2 * form.kappa - HALF, Fraction(1, 4)
    even_powers = all(k % 2 == 0 for _, k in multiplicities(form.f))
    if not writer.is_degree(degree) or form.mu.roots or form.mu.part != quarter or form.q.roots or not even_powers:
        return None
    N, before, root = writer.constant(degree), form.factor(form.mu), writer.root_of(form.f * form.q.part * 2)
    even = hypergeometric((-N / 2,), (sympy.S.Half,), form.z)
    odd = root * hypergeometric(((1 - N) / 2,), (sympy.Rational(3, 2),), form.z)
    return writer.pair((before, sympy.hermite(N, root)), (before, by_parity(N, odd, even)))


def _laguerre(form: Whittaker) -> tuple[Expr, Expr] | None:
    writer = form.writer
    for mu in (form.mu, -form.mu):
        degree, integer = form.kappa - mu - HALF, writer.is_integer(2 * mu)
        if writer.is_degree(degree) and (writer.is_natural(2 * mu) or not integer):
            N, a = writer.constant(degree), writer.constant(2 * mu)
            polynomial = sympy.assoc_laguerre(N, a, form.z) if a else sympy.laguerre(N, form.z)
            second = form.turned.tricomi if integer else form.kummer(-mu)
            return writer.pair((form.factor(mu + HALF), polynomial), second)
    return None
