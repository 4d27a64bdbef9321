"""Products of powers and exponentials as SymPy expressions, with factors of the same exponent under one root."""

from __future__ import annotations

from dataclasses import dataclass

import sympy
from sympy import Add, Integer, Mul, exp

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr, rational
from kovacic.closed_form.product import Product


@dataclass(frozen=True)
class _Factor:
    """base^exponent; factors with the same fractional `key` share a root."""

    base: Poly
    exponent: Poly
    key: Poly


def display(y: Product, atoms: Atoms, *, around_zero: bool = False) -> Expr:
    """A product, up to a constant factor."""
    return Mul(*factors(y, atoms, around_zero=around_zero)[1])


def factors(
    y: Product, atoms: Atoms, extra: RatFunc | None = None, *, like: Product | None = None, around_zero: bool = True
) -> tuple[Expr, list[Expr]]:
    """(c, factors): y * extra is c times the product of the factors; common factors of y and extra are merged.

    Bases with the same fractional exponent come under one root.  (p q)^e and p^e q^e differ by a constant that isn't the
    same everywhere; in a sum, all terms must use the same roots: those of the product `like`, from which the exponents
    differ by integers.  With `around_zero` the roots of x^2 - a, a > 0, are written so that they are real around 0.
    """
    alone = like is None and extra is None
    keys = {} if alone else {power.base: power.exponent for power in (like or y).powers}
    found = []
    rest = extra
    for power in y.powers:
        exponent = power.exponent
        if rest:
            num, up = rest.num.remove(power.base)
            den, down = rest.den.remove(power.base)
            rest = RatFunc(num, den, reduced=True)
            exponent = exponent + (up - down)
        if exponent:
            found.append(_Factor(power.base, exponent, keys.get(power.base, exponent)))
    if rest is not None:
        one = y.field.poly([1])
        found += [_Factor(rest.num, one, one), _Factor(rest.den, -one, -one)]
    scale: Expr = Integer(1)
    for factor in found:
        content = atoms.primitive(factor.base)[0]
        if content != 1:
            scale = scale * rational(content) ** atoms.constant(factor.exponent)
    sign, powers = _grouped(found, atoms, around_zero)
    for residue in y.roots:
        for a in atoms.real_roots(residue.factor):
            powers.append((atoms.x - a) ** sympy.expand_mul(atoms.poly(residue.value, a)))
    return scale * sign, [*powers, _exponential(y, atoms)]


def _grouped(found: list[_Factor], atoms: Atoms, around_zero: bool) -> tuple[Expr, list[Expr]]:
    """(c, powers) with the product, up to contents, c * powers; (x - a)(x + a) is multiplied out."""
    fractional: dict[Poly, list[_Factor]] = {}
    integral: dict[Poly, list[Poly]] = {}
    for factor in found:
        if _is_integer(factor.exponent):
            integral.setdefault(factor.exponent, []).append(factor.base)
        else:
            fractional.setdefault(factor.key, []).append(factor)
    scale: Expr = Integer(1)
    powers: list[Expr] = []
    for group in fractional.values():
        exponent = group[0].exponent
        for factor in group[1:]:
            if factor.exponent != exponent:
                integral.setdefault(factor.exponent - exponent, []).append(factor.base)
        index = atoms.constant(exponent)
        bases = []
        for base in _joined([factor.base for factor in group]):
            shown = atoms.primitive(base)[1]
            if around_zero and base.degree == 2 and not base[1] and atoms.constant(base[0]).is_negative:
                shown, scale = -shown, scale * Integer(-1) ** index
            bases.append(shown)
        powers.append(Mul(*bases) ** index)
    for exponent, polynomials in integral.items():
        powers += [atoms.primitive(base)[1] ** atoms.constant(exponent) for base in _joined(polynomials)]
    return scale, powers


def _is_integer(exponent: Poly) -> bool:
    value = exponent.field.rational_value(exponent)
    return value is not None and value.denominator == 1


def _joined(bases: list[Poly]) -> list[Poly]:
    """With every pair x - a, x + a multiplied out."""
    pending, result = list(bases), []
    while pending:
        base = pending.pop(0)
        partner = next((other for other in pending if _are_opposite(base, other)), None)
        if partner is not None:
            pending.remove(partner)
            base = base * partner
        result.append(base)
    return result


def _are_opposite(p: Poly, q: Poly) -> bool:
    """Are these multiples of x - a and x + a, for a other than 0?"""
    return p.degree == q.degree == 1 and bool(p[0]) and p[0] * q[1] == -q[0] * p[1]


def _exponential(y: Product, atoms: Atoms) -> Expr:
    """The factor exp(rational function) of a product, with the sums over roots that aren't written as powers."""
    inner = [atoms.log_sum(residue) for residue in y.roots if not atoms.real_roots(residue.factor)]
    if y.exponential.num.degree > 0 or not y.exponential.is_polynomial:
        rational_part = atoms.sum(y.exponential)
        if not inner:
            return exp(rational_part, evaluate=False)
        inner.append(rational_part)
    return exp(Add(*inner))
