"""From the structure of the solutions to two SymPy expressions."""

from __future__ import annotations

from kovacic.closed_form.atoms import Atoms, rational
from kovacic.closed_form.curve_display import exponentials
from kovacic.closed_form.integrals import triangular
from kovacic.closed_form.klein import Hypergeometric
from kovacic.closed_form.plain import Expr, hypergeometric, times
from kovacic.closed_form.real_pair import conjugate_roots, is_real_pair, real_pair
from kovacic.closed_form.structure import ClosedStructure, Conjugate, Diagonal, OnCurve, Triangular


def expressions(form: ClosedStructure, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """y1, y2 and notes."""
    if isinstance(form, Diagonal):
        return atoms.product(form.first, around_zero=True), atoms.product(form.second, around_zero=True), ()
    if isinstance(form, Conjugate):
        first, second = real_pair(form, atoms) if is_real_pair(form, atoms) else conjugate_roots(form, atoms)
        return first, second, ()
    if isinstance(form, Triangular):
        return triangular(form, atoms)
    if isinstance(form, OnCurve):
        return exponentials(form, atoms)
    J = atoms.factored(form.J)
    first, second = (_hypergeometric(y, J, atoms) for y in (form.first, form.second))
    return first, second, ()


def _hypergeometric(y: Hypergeometric, J: Expr, atoms: Atoms) -> Expr:
    a, b, c = (rational(value) for value in (y.a, y.b, y.c))
    return times(atoms.product(y.factor), hypergeometric(a, b, c, J))
