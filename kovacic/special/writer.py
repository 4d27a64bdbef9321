"""Parts of the solutions as SymPy expressions: y = G u(f)/sqrt(f'), G the gauge factor, u a solution of the standard equation.

The powers and exponentials of u, of G and of 1/sqrt(f') are gathered in one product, with the logarithmic derivative
gauge + (that of the elementary factor of u)(f) f' - f''/(2 f').
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy
from sympy import Mul

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr
from kovacic.closed_form.product import Power, Product, product
from kovacic.closed_form.product_display import display, factors
from kovacic.special.polar import root

HALF = Fraction(1, 2)

#: Powers and exponentials, and the special function that they are multiplied with.
Term = tuple[Product, Expr]


class Writer:
    """Writes in one variable; `symbols` are the user's own by name, with what is assumed about them."""

    def __init__(self, gauge: RatFunc, x: Any, symbols: Mapping[str, Any]) -> None:
        self.gauge, self.atoms = gauge, Atoms(x)
        self.symbols = {sympy.Symbol(name): symbol for name, symbol in symbols.items()}

    def elementary(self, f: RatFunc, rate: RatFunc) -> Product:
        """The powers and exponentials before the special function; `rate` is the logarithmic derivative of those in u(f)."""
        slope = f.derivative()
        return product(self.gauge + rate - slope.derivative() / slope * HALF)

    def pair(self, first: Term, second: Term) -> tuple[Expr, Expr]:
        """The two solutions in the user's symbols, the one with fewer factors first."""
        if size(second[0]) < size(first[0]):
            first, second = second, first
        y1, y2 = (
            Mul(display(before, self.atoms), function).xreplace(self.symbols) for before, function in (first, second)
        )
        return y1, y2

    # ------------------------------------------------------------------------------------- constants

    def constant(self, value: Poly) -> Expr:
        return self.atoms.constant(value)

    def is_integer(self, value: Poly) -> bool:
        """Is it known to be an integer?"""
        return bool(self.constant(value).xreplace(self.symbols).is_integer)

    def is_natural(self, value: Poly) -> bool:
        """Is it known to be an integer that isn't negative?"""
        shown = sympy.expand(self.constant(value).xreplace(self.symbols))
        return bool(shown.is_integer and shown.is_nonnegative)

    def is_symbolic(self, value: Poly) -> bool:
        """Does it depend on a parameter?"""
        return bool(self.constant(value).free_symbols)

    def is_negative(self, value: Poly) -> bool:
        """Would it be written with a minus sign?"""
        return bool(self.constant(value).could_extract_minus_sign())

    def root(self, value: Poly, n: int) -> Expr:
        """A square (n = 2) or cubic (n = 3) root, in the field where it has one; a cubic one is real for real values."""
        inside = root(value, n)
        if inside is not None:
            return self.constant(inside)
        if n == 3 and self.is_negative(value):
            return -self.root(-value, n)
        return sympy.root(self.constant(value), n)

    # ------------------------------------------------------------------------------------- functions

    def argument(self, f: RatFunc) -> Expr:
        """A rational function: a polynomial in full, else a fraction of products."""
        return self.atoms.poly(f.num) if f.is_polynomial else self.atoms.factored(f)

    def square_root(self, f: RatFunc) -> Expr:
        """A square root of a rational function, by factors."""
        powers = [Power(p, p.field.poly([Fraction(k, 2)])) for p, k in multiplicities(f)]
        scale, shown = factors(Product(tuple(powers), (), f * 0), self.atoms, around_zero=False)
        return self.root(f.num.lc, 2) * Mul(scale, *shown)


def multiplicities(f: RatFunc) -> list[tuple[Poly, int]]:
    """The monic irreducible factors with their multiplicities, negative in the denominator."""
    parts = ((f.num, 1), (f.den, -1))
    return [(p, sign * k) for part, sign in parts if part.degree > 0 for p, k in f.field.factor(part)]


def hypergeometric(top: tuple[Expr, ...], bottom: tuple[Expr, ...], z: Expr) -> Expr:
    """SymPy's `hyper`."""
    with sympy.evaluate(False):  # else SymPy asks whether the argument is polar, which takes milliseconds
        return sympy.hyper(top, bottom, z)


def by_parity(N: Expr, odd: Expr, even: Expr) -> Expr:
    """For a polynomial of degree N that is even or odd as N is: the solution of the other parity."""
    return sympy.cos(sympy.pi * N / 2) * odd + sympy.sin(sympy.pi * N / 2) * even


def size(before: Product) -> int:
    """The number of factors."""
    return len(before.powers) + len(before.roots) + bool(before.exponential)
