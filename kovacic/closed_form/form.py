"""`solutions`: two independent solutions as SymPy expressions, checked before they are returned."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from sympy import Add, Mul, Symbol, exp

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr, display, hypergeometric, rational
from kovacic.closed_form.check import is_exact_solution, is_numerical_solution
from kovacic.closed_form.curve_display import exponentials
from kovacic.closed_form.integrals import triangular
from kovacic.closed_form.klein import Hypergeometric, KleinForm
from kovacic.closed_form.real_pair import conjugate_roots, is_real_pair, real_pair
from kovacic.closed_form.structure import ClosedStructure, Conjugate, Diagonal, OnCurve, Triangular, build
from kovacic.decision import Decision
from kovacic.errors import VerificationFailed
from kovacic.limits import check_time
from kovacic.numerals import as_latex

EXACT = "exact"
NUMERICAL = "numerical, 50 digits"


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
        The same as data, without SymPy; it may change between versions.
    gauge : RatFunc
        The logarithmic derivative of the factor that is in y1 and y2: 0 where S itself was given.
    checked : str
        "exact" if the equation was verified in rational functions from the factors, or "numerical, 50 digits"; what is shown
        has been checked at a point in either case.
    notes : tuple of str
        What was left as an integral, and why.

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
    structure: ClosedStructure
    gauge: RatFunc
    checked: str
    notes: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[Any]:
        return iter((self.y1, self.y2))

    def _repr_latex_(self) -> str:
        return rf"$y_1 = {as_latex(self.y1)},\quad y_2 = {as_latex(self.y2)}$"


def solutions(S: RatFunc, decision: Decision, gauge: RatFunc, variable: str = "x") -> ClosedForm:
    """Two independent solutions of the equation that was given: those of y'' = S y times its gauge factor.

    `gauge` is the logarithmic derivative of that factor, -b/(2a) for the equation a z'' + b z' + c z = 0, and 0 for the normal
    form.  It is merged into the products of powers and exponentials.  Where S is real and has real solutions of a known
    form, these are returned.

    Raises `ValueError` if the equation has no Liouvillian solution or is undecided, and `VerificationFailed` if a solution
    doesn't pass its check, which is a defect of this package; `LimitExceeded` within `Budget.watched`.

    >>> import kovacic
    >>> answer = kovacic.solve("2/x^2 - 1")
    >>> form = solutions(answer.S, answer.decision, answer.gauge)
    >>> form.y1, form.checked
    ((x*cos(x) - sin(x))/x, 'exact')
    """
    if decision.case is None:
        raise ValueError(decision.undecided or "there is no Liouvillian solution")
    structure = build(S, decision, gauge)
    check_time()
    x = Symbol(variable)
    atoms = Atoms(x)
    y1, y2, notes = expressions(structure, atoms)
    y1 = one_exponential(y1)
    y2 = one_exponential(y2)
    check_time()
    exact = not isinstance(structure, KleinForm)
    passed = not exact or is_exact_solution(structure, S, gauge)
    if not passed or not all(is_numerical_solution(y, x, S, gauge) for y in (y1, y2)):
        raise VerificationFailed(f"a closed form for S = {S} failed its check; please report the equation")
    checked = EXACT if exact else NUMERICAL
    return ClosedForm(y1, y2, x, structure, gauge, checked, (*notes, *atoms.notes))


def expressions(form: ClosedStructure, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """y1, y2 and notes."""
    if isinstance(form, Diagonal):
        return display(form.first, atoms, around_zero=True), display(form.second, atoms, around_zero=True), ()
    if isinstance(form, Conjugate):
        written = real_pair if is_real_pair(form, atoms) else conjugate_roots
        return *written(form, atoms), ()
    if isinstance(form, Triangular):
        return triangular(form, atoms)
    if isinstance(form, OnCurve):
        return exponentials(form, atoms)
    return *_hypergeometric(form.at_vertices, form.J, atoms), ()


def one_exponential(y: Expr) -> Expr:
    """With one exponential in every product."""

    def merged(product: Expr) -> Expr:
        inner = [factor.args[0] for factor in product.args if isinstance(factor, exp)]
        if len(inner) < 2:
            return product
        return Mul(*(factor for factor in product.args if not isinstance(factor, exp)), exp(Add(*inner)))

    if len(y.atoms(exp)) < 2:
        return y
    return y.replace(lambda e: e.is_Mul, merged)


def _hypergeometric(pair: tuple[Hypergeometric, Hypergeometric], J: RatFunc, atoms: Atoms) -> tuple[Expr, Expr]:
    z = atoms.factored(J)
    first, second = (
        Mul(display(y.factor, atoms), hypergeometric((rational(y.a), rational(y.b)), (rational(y.c),), z)) for y in pair
    )
    return first, second


def at_edges(form: KleinForm, S: RatFunc, gauge: RatFunc, variable: str) -> tuple[Expr, Expr] | None:
    """Two other solutions in case 3, functions of 1/J, for the poles of J; None where they don't pass the check."""
    atoms = Atoms(Symbol(variable))
    pair = _hypergeometric(form.at_edges, 1 / form.J, atoms)
    return pair if all(is_numerical_solution(y, atoms.x, S, gauge) for y in pair) else None
