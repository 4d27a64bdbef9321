"""Products of powers and exponentials as SymPy expressions, with factors of the same exponent under one root."""

from __future__ import annotations

import sympy
from sympy import Add, Integer, Mul, exp

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr, rational
from kovacic.closed_form.product import Factor, Product, grouped, merged


def display(y: Product, atoms: Atoms, *, around_zero: bool = False) -> Expr:
    """A product, up to a constant factor."""
    return Mul(*factors(y, atoms, around_zero=around_zero)[1])


def factors(
    y: Product, atoms: Atoms, extra: RatFunc | None = None, *, like: Product | None = None, around_zero: bool = True
) -> tuple[Expr, list[Expr]]:
    """(c, factors): y * extra is c times the product of the factors, merged and grouped (`kovacic.closed_form.product`).

    With `around_zero` the roots of x^2 - a, a > 0, are written so that they are real around 0.
    """
    found = merged(y, extra, like=like)
    scale: Expr = Integer(1)
    for factor in found:
        content = atoms.primitive(factor.base)[0]
        if content != 1:
            scale = scale * rational(content) ** atoms.constant(factor.exponent)
    sign, powers = _powers(found, atoms, around_zero)
    for residue in y.roots:
        for a in atoms.real_roots(residue.factor):
            powers.append((atoms.x - a) ** sympy.expand_mul(atoms.poly(residue.value, a)))
    return scale * sign, [*powers, _exponential(y, atoms)]


def _powers(found: list[Factor], atoms: Atoms, around_zero: bool) -> tuple[Expr, list[Expr]]:
    """(c, powers) with the product, up to contents, c * powers."""
    scale: Expr = Integer(1)
    powers: list[Expr] = []
    for group, exponent in grouped(found):
        index = atoms.constant(exponent)
        bases = []
        for base in group:
            shown = atoms.primitive(base)[1]
            negative_at_zero = base.degree == 2 and not base[1] and atoms.constant(base[0]).is_negative
            if around_zero and negative_at_zero and not index.is_Integer:
                shown, scale = -shown, scale * Integer(-1) ** index
            bases.append(shown)
        powers.append(Mul(*bases) ** index)
    return scale, powers


def _exponential(y: Product, atoms: Atoms) -> Expr:
    """The factor exp(rational function) of a product, with the sums over roots that aren't written as powers."""
    inner = [atoms.log_sum(residue) for residue in y.roots if not atoms.real_roots(residue.factor)]
    if y.exponential.num.degree > 0 or not y.exponential.is_polynomial:
        rational_part = atoms.sum(y.exponential)
        if not inner:
            return exp(rational_part, evaluate=False)
        inner.append(rational_part)
    return exp(Add(*inner))
