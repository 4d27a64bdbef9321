"""Variation of parameters where y1, y2 and the right-hand side g are products of powers and exponentials.

With omega_i = y_i'/y_i and D = omega_2 - omega_1 the Wronskian is y1 y2 D, so that

    y = y2 int g/(y2 D) dx - y1 int g/(y1 D) dx,                                                                      (1)

and both integrands are such products again, which `kovacic.closed_form.primitive` integrates (Ei, erf, gamma functions).
"""

from __future__ import annotations

from typing import Any

import sympy
from flint import acb, arb, ctx, fmpq

from kovacic.algebra.poly import Field
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, factors
from kovacic.closed_form.check import DIGITS, value_at
from kovacic.closed_form.integrals import times_integral
from kovacic.closed_form.jets import jet
from kovacic.closed_form.primitive import OpenPrimitive
from kovacic.closed_form.product import Product, product
from kovacic.closed_form.structure import ClosedStructure, Diagonal, Triangular
from kovacic.errors import InputError
from kovacic.reading.from_sympy import parse_sympy
from kovacic.reading.given import PI, Equation

Expr = Any  # SymPy publishes no types
#: One point in each quadrant, where a solution is substituted: roots on the wrong branch don't pass.
_POINTS = [(137, 71), (-151, 83), (-97, -119), (163, -79)]
_TRANSCENDENTAL = (
    sympy.log,
    sympy.atan,
    sympy.Ei,
    sympy.erf,
    sympy.erfi,
    sympy.lowergamma,
    sympy.uppergamma,
    sympy.RootSum,
)


def variation_of_products(form: ClosedStructure, equation: Equation, right: Expr, x: Expr) -> Expr | None:
    """A solution of y'' + (b/a) y' + (c/a) y = right, substituted before it is returned; None where (1) isn't done."""
    pair = _products(form)
    rate = None if pair is None else rational_over(pair[0].field, sympy.cancel(right.diff(x) / right), x)
    if pair is None or rate is None:
        return None
    atoms = Atoms(x)
    omegas = [y.logarithmic_derivative for y in pair]
    D = omegas[1] - omegas[0]
    parts = [
        times_integral(y, product(rate - omega - D.derivative() / D), atoms)
        for y, omega in zip(pair, omegas, strict=True)
    ]
    scale, shown = factors(product(rate), atoms)
    ratio = right / (scale * sympy.Mul(*shown))
    constant = next((c for c in (sympy.powsimp(ratio.subs(x, k)) for k in (2, 3, 5)) if c.is_finite and c != 0), None)
    if parts[0] is None or parts[1] is None or constant is None:
        return None
    constant = constant / atoms.constant(D.num.lc / D.den.lc)
    terms = [constant * sympy.powsimp(term) for term in sympy.Add.make_args(parts[1] - parts[0])]
    plain = sympy.Add(*(term for term in terms if not term.has(*_TRANSCENDENTAL)))
    others = [term for term in terms if term.has(*_TRANSCENDENTAL)]
    found = sympy.Add(*others, _merged(plain, right, x, [_shown(y, atoms) for y in pair]))
    return found if is_solution(found, equation, right, x) else None


def _shown(y: Product, atoms: Atoms) -> Expr:
    return sympy.Mul(*factors(y, atoms)[1])


def _merged(plain: Expr, right: Expr, x: Expr, homogeneous: list[Expr]) -> Expr:
    """The part without transcendental functions other than those on the right, a rational multiple of it, as one product.

    0 if it is a multiple of a solution of the homogeneous equation.
    """
    factor = sympy.cancel(sympy.powsimp(sympy.expand(plain / right)))
    if not factor.is_rational_function(x):
        return plain
    merged = sympy.factor(factor * right)
    return 0 if any(not sympy.cancel(sympy.powsimp(merged / y)).has(x) for y in homogeneous) else merged


def _products(form: ClosedStructure) -> tuple[Product, Product] | None:
    """Both solutions as products, where they are."""
    if isinstance(form, Diagonal):
        return form.first, form.second
    if not isinstance(form, Triangular):
        return None
    W = None if isinstance(form.primitive, OpenPrimitive) else form.primitive.rational_part
    if isinstance(form.primitive, OpenPrimitive) or not W:
        return None
    rate = W.derivative() / W + form.primitive.kernel_derivative
    return form.first, product(form.first.logarithmic_derivative + rate)


def rational_over(field: Field, expression: Expr, x: Expr) -> RatFunc | None:
    """A rational function with coefficients in the field; None for anything else."""
    if not expression.is_rational_function(x):
        return None
    try:
        found = parse_sympy(expression.xreplace({sympy.pi: sympy.Symbol(PI)}), variable=x.name).S
    except InputError:
        return None
    if found.field != field and not field.extends(found.field):
        return None
    return RatFunc(found.num.over(field), found.den.over(field), reduced=True)


def is_solution(y: Expr, equation: Equation, right: Expr, x: Expr) -> bool:
    """Does y satisfy y'' + (b/a) y' + (c/a) y = right at a point in each quadrant, to 50 digits?"""
    b, c = equation.b / equation.a, equation.c / equation.a
    with ctx.workdps(DIGITS + 15):
        for real, imaginary in _POINTS:
            point = acb(arb(fmpq(real, 101)), arb(fmpq(imaginary, 89)))
            try:
                (value, first, second), force = jet(y, x, point), jet(right, x, point)[0]
            except NotImplementedError:
                return False
            terms = [second, value_at(b, point) * first, value_at(c, point) * value, -force]
            if not abs(sum(terms)) < arb(10) ** -DIGITS * sum(map(abs, terms), arb(1)):
                return False
    return True
