"""Gauss' function 2F1, as K, E or P_nu where it is one; Gegenbauer and Jacobi polynomials of symbolic natural degree.

With the exponent differences alpha, beta, gamma at 0, 1 and infinity, in any order of these points and with any signs,

    u = z^((1-alpha)/2) (1-z)^((1-beta)/2) 2F1((1-alpha-beta-gamma)/2, (1-alpha-beta+gamma)/2; 1-alpha; z).

The second solution has -alpha; where alpha is an integer, it is the one of this kind at 1.  These are independent if no
combination (1 +- alpha +- beta +- gamma)/2 is an integer: a common solution would be elementary.  P_N^(a,b)(1 - 2 z) is a
multiple of 2F1(-N, N + a + b + 1; 1 + a; z); beside it there is one with another exponent at 0 or at infinity, and, for a = b,
the one of the other parity.

Reference: DLMF 14.3, 15.10, 18.5, 18.7, 19.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import sympy

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Expr, hypergeometric
from kovacic.special.pullback import Gauss
from kovacic.special.writer import HALF, Number, Term, Writer, WrittenFactor, by_parity


@dataclass(frozen=True)
class Riemann:
    """f with the exponent differences at its zeros, at its ones and at its poles."""

    writer: Writer
    f: RatFunc
    alpha: Number
    beta: Number
    gamma: Number

    @property
    def signs(self) -> Iterator[Riemann]:
        """The same with all signs of the differences."""
        for s, t, u in product((1, -1), repeat=3):
            yield Riemann(self.writer, self.f, s * self.alpha, t * self.beta, u * self.gamma)

    @property
    def factor(self) -> WrittenFactor:
        """The powers, and what belongs to the pull-back."""
        powers = [((1 - self.alpha) * HALF, self.f), ((1 - self.beta) * HALF, self.f - 1)]
        return self.writer.factor(self.f, powers)

    @property
    def term(self) -> Term:
        """u, with the sign of beta that leaves fewer factors."""
        forms = [Riemann(self.writer, self.f, self.alpha, sign * self.beta, self.gamma) for sign in (1, -1)]
        form = min(forms, key=lambda form: form.factor.size)
        a, b = ((1 - form.alpha - form.beta + sign * form.gamma) * HALF for sign in (-1, 1))
        a, b, c = (self.writer.constant(value) for value in (a, b, 1 - form.alpha))
        return form.factor, _named(a, b, c, self.writer.argument(form.f))

    @property
    def swapped(self) -> Riemann:
        """The same with 0 and 1 exchanged."""
        return Riemann(self.writer, 1 - self.f, self.beta, self.alpha, self.gamma)

    @property
    def regular(self) -> Riemann:
        """The sign of alpha for which 1 - alpha isn't an integer <= 0, as far as that is known."""
        turn = self.writer.is_integer(self.alpha) and not self.writer.is_natural(-self.alpha)
        return Riemann(self.writer, self.f, -self.alpha, self.beta, self.gamma) if turn else self

    @property
    def degree(self) -> Number:
        """N with a = -N."""
        return (self.alpha + self.beta + self.gamma - 1) * HALF

    @property
    def cost(self) -> tuple[bool | int | str, ...]:
        """What is preferred: polynomials, differences that aren't integers at 0 (unless those at 1 are the same), short f."""
        f, natural = self.f, self.writer.is_integer(self.alpha)
        terms = sum(bool(c) for c in (*f.num, *f.den))
        uneven = natural and self.alpha != self.beta
        return not f.is_polynomial, uneven, natural, terms, not self.writer.is_negative(f.num.lc), str(f)


def _named(a: Expr, b: Expr, c: Expr, z: Expr) -> Expr:
    """2F1, or a multiple: the complete elliptic integrals K, E and Legendre's function P_nu, where SymPy keeps it as it is."""
    half = sympy.S.Half
    if c == 1 and {a, b} in ({half}, {half, -half}):
        return (sympy.elliptic_k if a == b else sympy.elliptic_e)(z)
    if c == 1 and sympy.expand(a + b) == 1:
        P = sympy.legendre(-b if (-a).could_extract_minus_sign() else -a, sympy.expand(1 - 2 * z))
        if isinstance(P, sympy.legendre):
            return P
    return hypergeometric((a, b), (c,), z)


def gauss(writer: Writer, equation: Gauss, f: RatFunc) -> tuple[Expr, Expr] | None:
    """Two solutions; None where the assumptions make the equation reducible, and it isn't known which pair is independent."""
    a, b, c = (writer.square_root(value) for value in (equation.A, equation.B, equation.C))
    orders = [(f, (a, b, c)), (1 - f, (b, a, c)), (1 / f, (c, b, a)), (1 - 1 / f, (b, c, a)), (1 / (1 - f), (c, a, b))]
    arranged = [Riemann(writer, g, *order) for g, order in [*orders, (f / (f - 1), (a, c, b))]]
    forms = sorted(arranged, key=lambda form: form.cost)
    for one in (one for form in forms for one in form.signs):
        apart = (writer.is_natural(-value) or not writer.is_integer(value) for value in (one.alpha, one.beta))
        if writer.is_degree(one.degree) and all(apart):
            return _jacobi(one)
    first = forms[0]
    reducible = any(writer.is_integer(one.degree) for one in first.signs)
    free = first if not reducible else next((form for form in forms if not writer.is_integer(form.alpha)), None)
    if free is not None and not writer.is_integer(free.alpha):
        turned = Riemann(writer, free.f, -free.alpha, free.beta, free.gamma)
        return writer.pair(free.term, turned.term)
    if not reducible:
        return writer.pair(first.regular.term, first.swapped.regular.term)
    even = next((one for form in forms for one in form.signs if one.alpha == one.beta), None)
    return None if even is None else writer.pair(*_even_and_odd(even))


def _jacobi(form: Riemann) -> tuple[Expr, Expr]:
    """P_N^(a,b)(1 - 2 f) with a = -alpha, b = -beta, and a second solution."""
    writer, f = form.writer, form.f
    N, a, b = (writer.constant(value) for value in (form.degree, -form.alpha, -form.beta))
    t = writer.argument(1 - 2 * f)
    if form.alpha == form.beta:
        polynomial = _without_constant(sympy.gegenbauer(N, a + sympy.S.Half, t) if a else sympy.legendre(N, t), writer)
        even, odd = _even_and_odd(form)
        return writer.pair((form.factor, polynomial), (form.factor, by_parity(N, odd[1], even[1])))
    first = form.factor, _without_constant(sympy.jacobi(N, a, b, t), writer)
    if not writer.is_integer(form.alpha):
        return writer.pair(first, Riemann(writer, f, -form.alpha, form.beta, form.gamma).term)
    # At infinity the polynomial has the exponent -N, and this one N + 1 + a + b.
    return writer.pair(first, Riemann(writer, 1 / f, -form.gamma, form.beta, form.alpha).term)


def _without_constant(polynomial: Expr, writer: Writer) -> Expr:
    """Without the (-1)**N of P_N(-z)."""
    return polynomial.as_independent(writer.atoms.x, as_Add=False)[1]


def _even_and_odd(form: Riemann) -> tuple[Term, Term]:
    """The even and the odd solution in 1 - 2 f, for alpha = beta."""
    writer, t = form.writer, form.writer.argument(1 - 2 * form.f)
    N, index = writer.constant(form.degree), writer.constant(HALF - form.alpha)
    even = hypergeometric((-N / 2, N / 2 + index), (sympy.S.Half,), t**2)
    odd = hypergeometric(((1 - N) / 2, (1 + N) / 2 + index), (sympy.Rational(3, 2),), t**2)
    return (form.factor, even), (form.factor, t * odd)
