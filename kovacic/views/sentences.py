"""What several views say of an answer, each once: its equation, omega, its solutions, the reasons of an exclusion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from kovacic.decision import Evidence, NecessaryCondition, NoInvariant
from kovacic.writing.formula import Formulas, Math, latex_text, of_sympy

if TYPE_CHECKING:
    from kovacic.solution import Solution

#: Characters; beside a longer formula another pair is offered.
SCREEN = 600
#: What is said before it.
SHORTER = "shorter, in special functions:"


def formulas_of(solution: Solution) -> Formulas:
    """How the functions of this answer are written."""
    return Formulas(solution.variable, solution.S.field)


def unknown_of(solution: Solution) -> str:
    """The name of the function that is looked for."""
    return "y" if solution.equation is None else solution.equation.unknown


def equation_of(solution: Solution) -> Math:
    """The equation as it was given."""
    equation = solution.equation
    return normal_form(solution) if equation is None else Math(str(equation), latex_text(equation.text(caret=False)))


def normal_form(solution: Solution, y: str = "y") -> Math:
    """y'' = S y."""
    return Math(f"{y}''", f"{y}''").equals(formulas_of(solution).times(solution.S, y, y))


def omega_of(solution: Solution) -> Math:
    """omega where it is rational, else the equation of which it is a root, a term a line."""
    riccati, formulas = solution.riccati, formulas_of(solution)
    assert riccati is not None
    if solution.omega is not None:
        return formulas.math(solution.omega)
    w, m = formulas.unknown, riccati.degree
    texts, latex = [f"{w}^{m}"], [f"{w}^{{{m}}}"]
    for k in range(m - 1, -1, -1):
        if coefficient := riccati.coefficients[k]:
            negative = formulas.math(coefficient).text.removeprefix("(").startswith("-")
            positive, sign = -coefficient if negative else coefficient, "-" if negative else "+"
            power = (w, w) if k == 1 else (f"{w}^{k}", f"{w}^{{{k}}}")
            value = formulas.times(positive, *power) if k else formulas.factor(positive)
            texts.append(f"{sign} {value.text}")
            latex.append(f"{sign} {value.latex}")
    lines = r" \\ \displaystyle ".join(latex)
    return Math("\n".join(texts) + " = 0", rf"\begin{{array}}{{l}} \displaystyle {lines} = 0 \end{{array}}")


def constants_of(solution: Solution) -> Math | None:
    """The polynomial of which omega's constant is a root."""
    if solution.constants is None:
        return None
    modulus = solution.constants.to_str(formulas_of(solution).symbol)
    return Math(modulus.replace("**", "^"), latex_text(modulus))


def omega_lines(solution: Solution) -> list[str]:
    """omega, or its polynomial, as text; without a Liouvillian solution no line."""
    if solution.riccati is None:
        return []
    omega, constants, formulas = omega_of(solution), constants_of(solution), formulas_of(solution)
    if solution.omega is not None:
        lines = [f"omega = {omega.text}"]
    else:
        lines = [f"omega is a root {formulas.unknown} of", *(f"    {line}" for line in omega.text.splitlines())]
    return lines if constants is None else [*lines, f"where {formulas.symbol} is any root of {constants.text}"]


def reason(evidence: Evidence, formulas: Formulas) -> Iterator[str | Math]:
    """Why a structure is excluded, without the bounds of the linear systems."""
    if isinstance(evidence, NecessaryCondition):
        yield evidence.rule.value
        for k, place in enumerate(evidence.places):
            yield ", " if k else " (at "
            yield formulas.place(place)
        yield ")" if evidence.places else ""
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


def solutions_of(solution: Solution) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    """Names and formulas of two solutions, in special functions where nothing is Liouvillian, if any are known; and notes."""
    form = solution.closed_form
    return _named(solution, solution.special if form is None else form), () if form is None else form.notes


def shorter_pair(solution: Solution, length: int) -> list[tuple[Math, Math]]:
    """Another pair, in special functions, to be shown beside closed forms of so many characters: of at most half of them.

    None is offered beside a formula of less than a screen.
    """
    if solution.case is None or length <= SCREEN:
        return []
    pair = _named(solution, solution.special)
    return pair if max((len(y.text) for _, y in pair), default=length) < length / 2 else []


def _named(solution: Solution, values: Iterable[Any]) -> list[tuple[Math, Math]]:
    y = unknown_of(solution)
    names = [Math(f"{y}{k}", f"{y}_{{{k}}}") for k in (1, 2)]
    return list(zip(names, map(of_sympy, values), strict=False))
