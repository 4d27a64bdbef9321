"""`solutions`: two independent solutions as SymPy expressions, checked before they are returned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.structure import ClosedStructure, build
from kovacic.errors import VerificationFailed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from kovacic.solution import Solution

EXACT = "exact"
NUMERICAL = "numerical, 50 digits"


@dataclass(frozen=True)
class ClosedForm:
    """y1 and y2, SymPy expressions in `variable`; `structure` is the same as data, without SymPy.

    `checked` is "exact" if the equation was verified in rational functions from the factors, or "numerical, 50 digits";
    what is shown has been checked at a point in either case.  `notes` say what was left as an integral and why.
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

    @property
    def power_polynomial(self) -> tuple[int, Any] | None:
        """(k, P) for case 3: P, an expression in x and Z, vanishes at Z = c y1^k and Z = c' y2^k for some constants.

        All its roots are k-th powers of solutions.  None in the other cases, with a gauge factor, and where P is too long to
        be written out.
        """
        from sympy import Add, Symbol

        from kovacic.closed_form.atoms import Atoms
        from kovacic.closed_form.klein import KleinForm

        if not isinstance(self.structure, KleinForm) or self.structure.polynomial is None:
            return None
        polynomial, atoms, Z = self.structure.polynomial, Atoms(self.variable), Symbol("Z")
        n = len(polynomial.coefficients)
        terms = (atoms.factored(c) * Z ** (n - 1 - k) for k, c in enumerate(polynomial.coefficients) if c)
        return polynomial.power, Add(Z**n, *terms)


def solutions(solution: Solution, *, gauge: RatFunc | None = None) -> ClosedForm:
    """Two independent solutions of the equation that was given: those of y'' = S y times its gauge factor.

    `gauge` is the logarithmic derivative of that factor, by default -b/(2a) for the equation a z'' + b z' + c z = 0 (a rational
    function equal to 0 gives the normal form's).  It is merged into the products of powers and exponentials.  Where S is
    real and has real solutions of a known form, these are returned.

    Raises `ValueError` if the equation has no Liouvillian solution or is undecided, and `VerificationFailed` if a solution
    doesn't pass its check, which is a defect of this package.

    >>> import kovacic
    >>> form = solutions(kovacic.solve("2/x^2 - 1"))
    >>> form.y1, form.checked
    ((x*cos(x) - sin(x))/x, 'exact')
    """
    from sympy import Symbol

    from kovacic.closed_form.atoms import Atoms
    from kovacic.closed_form.check import is_exact_solution, is_numerical_solution
    from kovacic.closed_form.display import expressions
    from kovacic.closed_form.klein import KleinForm

    if solution.case is None:
        raise ValueError(solution.reason or "there is no Liouvillian solution")
    if gauge is None:
        gauge = solution.gauge
    structure = build(solution.S, solution.decision, gauge)
    variable = Symbol(solution.variable)
    atoms = Atoms(variable)
    y1, y2, notes = expressions(structure, atoms)
    exact = not isinstance(structure, KleinForm)
    passed = not exact or is_exact_solution(structure, solution.S, gauge)
    if not passed or not all(is_numerical_solution(y, variable, solution.S, gauge) for y in (y1, y2)):
        raise VerificationFailed(f"a closed form for S = {solution.S} failed its check; please report the equation")
    return ClosedForm(y1, y2, variable, structure, gauge, EXACT if exact else NUMERICAL, (*notes, *atoms.notes))
