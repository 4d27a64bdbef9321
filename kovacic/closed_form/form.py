"""`written`: two independent solutions as SymPy expressions, checked."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from sympy import Add, Mul, Symbol, exp

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr, display
from kovacic.closed_form.check import is_exact_solution, is_numerical_solution
from kovacic.closed_form.integrals import exponentials, triangular
from kovacic.closed_form.real_pair import conjugate_roots, is_real_pair, real_pair
from kovacic.closed_form.structure import ClosedStructure, Conjugate, Covariants, Diagonal, OnCurve, Triangular
from kovacic.compatibility import cached_property
from kovacic.errors import VerificationFailed
from kovacic.limits import check_time
from kovacic.numbers.numerals import as_latex

EXACT = "exact"


@dataclass(frozen=True)
class ClosedForm:
    """Two independent solutions, y1 and y2; iterating gives both, and a notebook shows them as formulas.

    Attributes
    ----------
    y1, y2 : sympy.Expr
        Expressions in `variable`.
    variable : sympy.Symbol
        That of the equation.
    structure
        What the closed form is made from as data, without SymPy, computed on first access; it may change between versions.
    gauge : RatFunc
        The logarithmic derivative of the factor that is in y1 and y2: 0 where S itself was given.
    checked : str
        "exact": the equation was verified in rational functions, and the displayed expressions at a point.
    notes : tuple of str
        Integrals that were left, with the reason, and caveats about the formulas.
    undefined : tuple of sympy.Expr
        Where one of these is zero, for values of letters, a special function has no value, or both solutions are the same.
    place : sympy.Expr or None
        A point at which the roots and logarithms were turned to be real, or None if no turn was needed.

    Examples
    --------
    >>> import kovacic
    >>> form = kovacic.solve("x^2 + 3").closed_form
    >>> y1, y2 = form
    >>> y1, form.checked
    (x*exp(x**2/2), 'exact')
    """

    y1: Any
    y2: Any
    variable: Any
    gauge: RatFunc
    checked: str
    notes: tuple[str, ...] = ()
    undefined: tuple[Any, ...] = ()
    place: Any = None
    build: Callable[[], ClosedStructure] = field(kw_only=True, repr=False, compare=False)

    @cached_property
    def structure(self) -> ClosedStructure:
        return self.build()

    def __iter__(self) -> Iterator[Any]:
        return iter((self.y1, self.y2))

    def _repr_latex_(self) -> str:
        return rf"$y_1 = {as_latex(self.y1)},\quad y_2 = {as_latex(self.y2)}$"


def written(structure: ClosedStructure, S: RatFunc, gauge: RatFunc, variable: str) -> ClosedForm:
    """The solutions of the structure as SymPy expressions, checked: the structure exactly, the expressions at a point.

    Raises `VerificationFailed` if a solution doesn't pass, which is a defect of this package.
    """
    atoms = Atoms(Symbol(variable))
    y1, y2, notes = expressions(structure, atoms)
    notes = (*notes, *atoms.notes)
    pair = one_exponential(y1), one_exponential(y2)
    form = ClosedForm(*pair, atoms.x, gauge, EXACT, notes, build=partial(replace, structure))
    check_time()
    passed = is_exact_solution(structure, S, gauge)
    if not passed or not all(is_numerical_solution(y, form.variable, S, gauge) for y in form):
        raise VerificationFailed(f"a closed form for S = {S} failed its check; please report the equation")
    return form


def pair_at(form: ClosedForm, point: Any, own: Callable[[Expr], Expr]) -> tuple[Expr, Expr]:
    """Solutions whose roots are real at a point, written from the structure and not checked; the same ones in case 3."""
    if isinstance(form.structure, Covariants):
        return form.y1, form.y2
    y1, y2, _ = expressions(form.structure, Atoms(form.variable, at=point, own=own))
    return one_exponential(y1), one_exponential(y2)


def expressions(form: ClosedStructure, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """y1, y2 and notes."""
    if isinstance(form, Diagonal):
        return display(form.first, atoms, around_zero=True), display(form.second, atoms, around_zero=True), ()
    if isinstance(form, Conjugate):
        written = real_pair if is_real_pair(form, atoms) else conjugate_roots
        return *written(form, atoms), ()
    if isinstance(form, Triangular):
        return triangular(form, atoms)
    assert isinstance(form, OnCurve)  # the solutions of case 3 are pull-backs of Gauss' equation
    return exponentials(form, atoms)


def one_exponential(y: Expr) -> Expr:
    """With one exponential in every product."""

    def merged(product: Expr) -> Expr:
        inner = [factor.args[0] for factor in product.args if isinstance(factor, exp)]
        if len(inner) < 2:
            return product
        return Mul(*(factor for factor in product.args if not isinstance(factor, exp)), exp(Add(*inner)))

    return y.replace(lambda e: e.is_Mul, merged) if len(y.atoms(exp)) > 1 else y
