"""What was found as SymPy expressions: y = G u(f)/sqrt(f'), G the gauge factor, u two solutions of the standard equation.

Powers and exponentials are gathered in one product with the logarithmic derivative

    gauge + (that of the elementary factor of u)(f) f' - f''/(2 f').

Second solutions: Y_nu and K_nu; 1F1 and 2F1 with the other exponent at 0, where it doesn't differ by an integer; else Tricomi's
U(a, b, z) = z^-a 2F0(a, a-b+1; -1/z), and 2F1 at 1.  In each of these cases a common multiple of both would have a logarithmic
derivative in a field that shows the group to be reducible, so they are independent where no Liouvillian solution exists.

Reference: DLMF 9.2, 10.2, 10.25, 13.2, 13.14, 15.10.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy
from sympy import Mul, hyper

from kovacic.algebra.extension import adjoined_square_root
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr
from kovacic.closed_form.product import Power, Product, product
from kovacic.closed_form.product_display import display, factors
from kovacic.special.polar import root
from kovacic.special.pullback import Airy, Confluent, Gauss, Pullback

_HALF = Fraction(1, 2)

#: Powers and exponentials, and the special function that they are multiplied with.
Term = tuple[Product, Expr]


class Writer:
    """Writes the solutions for one pull-back; `symbols` are the user's own by name, with what is assumed about them."""

    def __init__(self, pullback: Pullback, gauge: RatFunc, x: Any, symbols: Mapping[str, Any]) -> None:
        self.pullback, self.gauge, self.symbols = pullback, gauge, symbols
        self.atoms = Atoms(x)

    def __call__(self) -> tuple[Expr, Expr]:
        y1, y2 = self._written()
        return self.own(y1), self.own(y2)

    def _written(self) -> tuple[Expr, Expr]:
        equation, f = self.pullback.equation, self.pullback.f
        if isinstance(equation, Airy):
            return self.airy(equation, f)
        if isinstance(equation, Gauss):
            return self.gauss(equation, f)
        if not equation.q:
            return self.bessel(4 * equation.M + 1, f * equation.r)
        if not equation.r:
            return self.bessel(equation.M + Fraction(1, 4), f * f * equation.q * Fraction(-1, 4))
        return self.whittaker(equation, f)

    # ------------------------------------------------------------------------------------------ parts

    def elementary(self, f: RatFunc, rate: RatFunc) -> Product:
        """The powers and exponentials before the special function; `rate` is (log of those in u)'."""
        slope = f.derivative()
        return product(self.gauge + rate - slope.derivative() / slope * _HALF)

    def pair(self, first: Term, second: Term) -> tuple[Expr, Expr]:
        """The two solutions, the one with fewer factors first."""
        if _size(second[0]) < _size(first[0]):
            first, second = second, first
        y1, y2 = (Mul(display(before, self.atoms), function) for before, function in (first, second))
        return y1, y2

    def constant(self, value: Poly) -> Expr:
        """In the user's symbols."""
        return self.own(self.atoms.constant(value))

    def own(self, expression: Expr) -> Expr:
        return expression.xreplace({sympy.Symbol(name): symbol for name, symbol in self.symbols.items()})

    def is_integer(self, value: Poly) -> bool:
        """Is it known to be an integer?"""
        return bool(self.constant(value).is_integer)

    def is_natural(self, value: Poly) -> bool:
        """Is it known to be an integer that isn't negative?"""
        shown = sympy.expand(self.constant(value))
        return bool(shown.is_integer and shown.is_nonnegative)

    def root(self, value: Poly, n: int) -> Expr:
        """A square (n = 2) or cubic (n = 3) root, in the field where it has one; a cubic one is real for real values."""
        inside = root(value, n)
        if inside is not None:
            return self.atoms.constant(inside)
        if n == 3 and self.atoms.constant(value).could_extract_minus_sign():
            return -self.root(-value, n)
        return sympy.root(self.atoms.constant(value), n)

    def argument(self, f: RatFunc) -> Expr:
        """A rational function: a polynomial in full, else a fraction of products."""
        return self.atoms.poly(f.num) if f.is_polynomial else self.atoms.factored(f)

    # -------------------------------------------------------------------------------- Airy and Bessel

    def airy(self, equation: Airy, f: RatFunc) -> tuple[Expr, Expr]:
        z = self.root(equation.q, 3) * self.argument(f)
        before = self.elementary(f, RatFunc(f.num * 0))
        return self.pair((before, sympy.airyai(z)), (before, sympy.airybi(z)))

    def bessel(self, nu_squared: Poly, t: RatFunc) -> tuple[Expr, Expr]:
        """u = sqrt(t) J_nu(2 sqrt t), or with I, K and -t where the constant factor of t is negative."""
        nu = self.atoms.constant(adjoined_square_root(nu_squared.field, nu_squared) if nu_squared else nu_squared)
        nu = -nu if nu.could_extract_minus_sign() else nu
        modified = bool(self.atoms.constant(t.num.lc).could_extract_minus_sign())
        z = self.root(t.num.lc * (-4 if modified else 4), 2) * self._root_of_monic(t)
        before = self.elementary(t, t.derivative() / t * _HALF)
        first, second = (sympy.besseli, sympy.besselk) if modified else (sympy.besselj, sympy.bessely)
        return self.pair((before, first(nu, z, evaluate=False)), (before, second(nu, z, evaluate=False)))

    def _root_of_monic(self, t: RatFunc) -> Expr:
        """sqrt(t/leading coefficient), by factors."""
        field = t.field
        powers = [
            Power(p, field.poly([Fraction(sign * k, 2)]))
            for polynomial, sign in ((t.num, 1), (t.den, -1))
            for p, k in (field.factor(polynomial) if polynomial.degree > 0 else [])
        ]
        scale, shown = factors(Product(tuple(powers), (), RatFunc(t.num * 0)), self.atoms, around_zero=False)
        return Mul(scale, *shown)

    # -------------------------------------------------------------------------------------- Whittaker

    def whittaker(self, equation: Confluent, f: RatFunc) -> tuple[Expr, Expr]:
        """u = exp(-z/2) z^(1/2 + mu) 1F1(1/2 + mu - kappa; 1 + 2 mu; z), z = 2 sqrt(q) f."""
        half, kappa, mu = self._whittaker_data(equation, f)
        slope, z = f.derivative(), self.argument(f * half * 2)

        def rate(sign: int, power: Poly) -> RatFunc:
            return (power * slope / f) - slope * half * sign

        def kummer(mu: Poly) -> Term:
            a, b = (self.atoms.constant(value) for value in (mu - kappa + _HALF, 2 * mu + 1))
            return self.elementary(f, rate(1, mu + _HALF)), _hyper((a,), (b,), z)

        def tricomi(sign: int) -> Term:
            a, b = (self.atoms.constant(m - kappa * sign + _HALF) for m in (mu, -mu))
            return self.elementary(f, rate(sign, kappa * sign)), _hyper((a, b), (), -sign / z)

        if not self.is_integer(2 * mu):
            return self.pair(kummer(mu), kummer(-mu))
        natural = next((m for m in (mu, -mu) if self.is_natural(2 * m)), None)
        return self.pair(tricomi(-1) if natural is None else kummer(natural), tricomi(1))

    def _whittaker_data(self, equation: Confluent, f: RatFunc) -> tuple[Poly, Poly, Poly]:
        """sqrt(q), kappa and mu; the sign of the root makes the exponential vanish where it can, or z positive."""
        half = adjoined_square_root(equation.q.field, equation.q)
        square = equation.M.over(half.field) + Fraction(1, 4)
        mu = adjoined_square_root(half.field, square) if square else square
        if self.atoms.constant(mu).could_extract_minus_sign():
            mu = -mu
        half = half.over(mu.field)
        exact = product(self.gauge).exponential.derivative()
        if exact == -f.derivative() * half or (
            exact != f.derivative() * half and self.atoms.constant(f.num.lc * half).could_extract_minus_sign()
        ):
            half = -half
        return half, equation.r / (2 * half), mu

    # ------------------------------------------------------------------------------------------ Gauss

    def gauss(self, equation: Gauss, f: RatFunc) -> tuple[Expr, Expr]:
        """u = z^((1-alpha)/2) (1-z)^((1-beta)/2) 2F1((1-alpha-beta-gamma)/2, (1-alpha-beta+gamma)/2; 1-alpha; z)."""
        f, (alpha, beta, gamma) = self._arranged(equation, f)
        first = self._hypergeometric(f, alpha, beta, gamma)
        if not self.is_integer(alpha):
            return self.pair(first, self._hypergeometric(f, -alpha, beta, gamma))
        return self.pair(first, self._hypergeometric(1 - f, beta, alpha, gamma))

    def _arranged(self, equation: Gauss, f: RatFunc) -> tuple[RatFunc, tuple[Poly, Poly, Poly]]:
        """One of the six functions that are f up to the order of 0, 1, infinity, and the exponent differences for it."""
        A, B, C = equation.A, equation.B, equation.C
        one = f.num * 0 + 1
        arrangements = [(f, (A, B, C)), (1 - f, (B, A, C)), (1 / f, (C, B, A)), ((f - one) / f, (B, C, A))]
        arrangements += [(1 / (1 - f), (C, A, B)), (f / (f - one), (A, C, B))]
        roots = {}
        field = f.field
        for value in (A, B, C):
            if value not in roots:
                square = value.over(field)
                roots[value] = adjoined_square_root(field, square) if square else square
                field = roots[value].field

        def cost(arrangement: tuple[RatFunc, tuple[Poly, Poly, Poly]]) -> tuple[Any, ...]:
            g, squares = arrangement
            natural = self.is_integer(roots[squares[0]])
            shape = sum(bool(c) for c in (*g.num, *g.den)), not self.atoms.constant(g.num.lc).could_extract_minus_sign()
            return not g.is_polynomial, natural and squares[0] != squares[1], natural, *shape, str(g)

        g, squares = min(arrangements, key=cost)
        alpha, beta, gamma = (roots[value].over(field) for value in squares)
        return g, (alpha, beta, gamma)

    def _hypergeometric(self, f: RatFunc, alpha: Poly, beta: Poly, gamma: Poly) -> Term:
        """The solution with this alpha up to sign where it is an integer, and the sign of beta that leaves fewer factors."""
        if self.is_integer(alpha) and not self.is_natural(-alpha):
            alpha = -alpha
        slope = f.derivative()

        def before(beta: Poly) -> Product:
            rate = slope / f * ((1 - alpha) * _HALF) + slope / (f - 1) * ((1 - beta) * _HALF)
            return self.elementary(f, rate)

        chosen, beta = min(((before(b), b) for b in (beta, -beta)), key=lambda pair: _size(pair[0]))
        a, b, c = (self.atoms.constant(v) for v in _parameters(alpha, beta, gamma))
        z = self.argument(f)
        return chosen, _hyper((a, b), (c,), z)


def _hyper(top: tuple[Expr, ...], bottom: tuple[Expr, ...], z: Expr) -> Expr:
    with sympy.evaluate(False):  # else SymPy asks whether the argument is polar, which takes milliseconds
        return hyper(top, bottom, z)


def _size(before: Product) -> int:
    return len(before.powers) + len(before.roots) + bool(before.exponential)


def _parameters(alpha: Poly, beta: Poly, gamma: Poly) -> tuple[Poly, Poly, Poly]:
    a, b = ((1 - alpha - beta + sign * gamma) * _HALF for sign in (-1, 1))
    return a, b, 1 - alpha
