"""Parts that several views share: the equation, omega, the solutions, the reasons of an exclusion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from kovacic import derived
from kovacic.answer import Answer
from kovacic.decision import Evidence, NecessaryCondition, NoInvariant
from kovacic.equation import Parsed
from kovacic.writing.formula import Formulas, Math, latex_text, of_sympy
from kovacic.writing.omega import omega_math

#: Verdicts.
SOLVABLE = "Liouvillian solutions exist"
UNSOLVABLE = "no Liouvillian solution exists"
UNDECIDED = "undecided"


def formulas_of(answer: Answer | Parsed) -> Formulas:
    """The writer of functions of this answer, in its variable and with its constants."""
    return Formulas(answer.variable, answer.S.field)


def unknown_of(answer: Answer) -> str:
    """The name of the unknown function."""
    return "y" if answer.equation is None else answer.equation.unknown


def equation_of(answer: Answer) -> Math:
    """The equation as it was given."""
    equation = answer.equation
    if equation is None:
        return normal_form(answer)
    return Math(str(equation), latex_text(equation.text(caret=False)))


def normal_form(answer: Answer | Parsed, y: str = "y") -> Math:
    """y'' = S y."""
    return Math(f"{y}''", f"{y}''").equals(formulas_of(answer).times(answer.S, y, y))


def omega_of(answer: Answer) -> Math:
    """omega where it is rational, else the equation of which it is a root."""
    assert answer.riccati is not None
    return omega_math(answer.riccati, formulas_of(answer))


def reason(evidence: Evidence, formulas: Formulas) -> Iterator[str | Math]:
    """Why a structure is excluded, without the bounds of the linear systems."""
    if isinstance(evidence, NecessaryCondition):
        yield evidence.rule.value
        before = " (at "
        for place in evidence.places:
            yield before
            yield formulas.place(place)
            before = ", "
        if evidence.places:
            yield ")"
    elif isinstance(evidence, NoInvariant):
        m = evidence.invariant_degree
        if evidence.prime is None:
            yield f"the exponents leave no room for an invariant of degree {m}"
        else:
            yield f"no rational invariant of degree {m}, by a linear system of nullity 0 modulo {evidence.prime}"
    elif evidence.prime is None:
        yield "the exponents leave no room for a rational omega"
    else:
        yield "no rational omega, by its expansion at "
        yield formulas.place(evidence.place)
        yield f" modulo {evidence.prime}"


def solutions_of(answer: Answer) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    """Names and formulas of two solutions, and notes; in special functions if there is no Liouvillian one, empty if unknown."""
    form = derived.closed_form(answer)
    if form is None:
        return _named_solutions(answer, derived.special(answer)), ()
    return _named_solutions(answer, form), form.notes


def _named_solutions(answer: Answer, values: Iterable[Any]) -> list[tuple[Math, Math]]:
    y = unknown_of(answer)
    names = [Math(f"{y}{k}", f"{y}_{{{k}}}") for k in (1, 2)]
    return list(zip(names, map(of_sympy, values), strict=False))


def verdict_of(answer: Answer) -> tuple[str, str]:
    """The verdict, and the case or the reason."""
    if answer.assumed and answer.reason is not None:
        return SOLVABLE, answer.reason
    if answer.riccati is not None:
        return SOLVABLE, f"case {answer.case}, omega = y'/y is {of_degree(answer.riccati.degree)}"
    if answer.reason is not None:
        return UNDECIDED, answer.reason
    return UNSOLVABLE, "the Galois group is SL2(C)"


def of_degree(degree: int) -> str:
    return "rational" if degree == 1 else f"algebraic of degree {degree}"
