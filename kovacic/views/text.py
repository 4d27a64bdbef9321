"""Answers as plain text: one line, or a readable paragraph."""

from __future__ import annotations

from collections.abc import Callable

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Evidence, Exclusion, NecessaryCondition, NoInvariant, Status
from kovacic.reading.names import Names, parameters_of
from kovacic.solution import Solution

#: Gives a piece of text a role ("good", "bad", "unsure", "title", "faint"): colours on a terminal, nothing elsewhere.
Style = Callable[[str, str], str]

_NAMES_OF_DEGREE = {
    1: "rational",
    2: "algebraic of degree 2",
    4: "algebraic of degree 4",
    6: "algebraic of degree 6",
    12: "algebraic of degree 12",
}


def plain(text: str, role: str) -> str:
    """The style without colours."""
    return text


def one_line(solution: Solution) -> str:
    """The equation and the verdict."""
    equation = _equation(solution)
    if solution.status is Status.UNDECIDED:
        return f"{equation}: undecided, {solution.reason}"
    if solution.status is Status.NONE_EXISTS:
        return f"{equation}: no Liouvillian solution"
    riccati = solution.riccati
    if solution.omega is not None:
        return f"{equation}: case {solution.case}, omega = {_caret(_names(solution).ratfunc(solution.omega))}"
    degree = "" if riccati is None else f", omega {_NAMES_OF_DEGREE[riccati.degree]}"
    return f"{equation}: case {solution.case}{degree}"


def render(solution: Solution, *, style: Style = plain) -> str:
    """The equation, the verdict in words, omega or its polynomial, and how it was verified."""
    lines = [style(_equation(solution), "title")]
    if solution.equation is not None and not solution.equation.is_normal_form:
        lines.append(f"  normal form: {_normal_form(solution)}, of which the following speaks")
    lines += [style(f"  note: {notice}", "faint") for notice in solution.notices]
    if solution.status is Status.UNDECIDED:
        lines.append(f"  {style('undecided', 'unsure')}: {solution.reason}")
    elif solution.status is Status.NONE_EXISTS:
        lines.append(f"  {style('no Liouvillian solution exists', 'bad')}: the Galois group is SL2(C)")
    else:
        assert solution.riccati is not None
        case = f"case {solution.case}, omega = y'/y is {_NAMES_OF_DEGREE[solution.riccati.degree]}"
        lines.append(f"  {style('Liouvillian solutions exist', 'good')}: {case}")
        lines += [f"  {line}" for line in omega_lines(solution)]
    lines += [f"  {line}" for line in _exclusions(solution)]
    if parameters_of(solution.S.field) and solution.status is not Status.UNDECIDED:
        lines.append(f"  for generic parameters: {solution.generic_conditions}")
        lines.append("  (kovacic conditions tells for which values more is solvable)")
    if solution.verified:
        lines.append(f"  {style('verified', 'good')}: {_how_verified(solution)}")
    elif solution.status is not Status.UNDECIDED:
        lines.append(f"  {style('not verified', 'bad')}")
    return "\n".join(lines)


def _names(solution: Solution) -> Names:
    return Names(solution.variable, parameters_of(solution.S.field))


def omega_lines(solution: Solution) -> list[str]:
    """omega, or its polynomial; without a Liouvillian solution no line."""
    riccati = solution.riccati
    if riccati is None:
        return []
    variable, names = solution.variable, _names(solution)
    unknown = names.unknown
    coefficients = [names.renamed(coefficient) for coefficient in riccati.coefficients]
    lines = []
    if riccati.degree == 1:
        lines += [f"omega = {_function(-coefficients[0], variable)}", f"y = exp(integral of omega d{variable})"]
    else:
        lines.append(f"omega is a root {unknown} of")
        for k in range(riccati.degree, -1, -1):
            if k == riccati.degree:
                lines.append(f"    {_power(unknown, k)}")
            elif coefficients[k]:
                sign, text = _signed(coefficients[k], variable)
                lines.append(f"    {sign} {text}{' ' + _power(unknown, k) if k else ''}")
        lines[-1] += " = 0"
    if solution.constants is not None:
        lines.append(f"where {names.symbol} is any root of {_caret(solution.constants.to_str(names.symbol))}")
    return lines


def _exclusions(solution: Solution) -> list[str]:
    """One line for each structure that was excluded, equal reasons of the finite groups together."""
    lines: list[str] = []
    grouped: dict[tuple[int, str], list[str]] = {}
    for exclusion in solution.proof:
        key = exclusion.structure.case, _reasons(exclusion, solution.variable)
        grouped.setdefault(key, []).append(exclusion.structure.value)
    for (case, reasons), structures in grouped.items():
        which = f" ({', '.join(structures)})" if case == 3 else ""
        lines.append(f"not case {case}{which}: {reasons}")
    return lines


def _reasons(exclusion: Exclusion, variable: str) -> str:
    return "; ".join(_reason(evidence, variable) for evidence in exclusion.evidence)


def _reason(evidence: Evidence, variable: str) -> str:
    if isinstance(evidence, NecessaryCondition):
        places = [_place(place, variable) for place in evidence.places]
        return evidence.rule.value + (f" (at {', '.join(places)})" if places else "")
    if isinstance(evidence, NoInvariant):
        m = evidence.invariant_degree
        if evidence.prime is None:
            return f"the exponents leave no room for an invariant of degree {m}"
        return f"no rational invariant of degree {m}, by a linear system of nullity 0 modulo {evidence.prime}"
    if evidence.prime is None:
        return "the exponents leave no room for a rational omega"
    return f"no rational omega, by its expansion at {_place(evidence.place, variable)} modulo {evidence.prime}"


def _how_verified(solution: Solution) -> str:
    if solution.status is Status.UNDECIDED:
        return "what was excluded before the limit was recomputed by independent code"
    if solution.status is Status.NONE_EXISTS:
        return "every exclusion was recomputed by independent code"
    identity = "omega' + omega^2 = S holds exactly"
    return identity + (", and what was excluded was recomputed by independent code" if solution.proof else "")


def _place(place: str, variable: str) -> str:
    if place == "infinity":
        return place
    return f"{_caret(Names(variable).place(place))} = 0"


def _equation(solution: Solution) -> str:
    return _normal_form(solution) if solution.equation is None else str(solution.equation)


def _normal_form(solution: Solution) -> str:
    return f"y'' = {_factor(solution.S, solution.variable)} y" if solution.S else "y'' = 0"


def _function(function: RatFunc, variable: str) -> str:
    return _caret(function.to_str(variable))


def _factor(function: RatFunc, variable: str) -> str:
    """The function as a factor of a product: in parentheses where it needs them."""
    text = _function(function, variable)
    return f"({text})" if any(sign in text for sign in " /*-") else text


def _signed(function: RatFunc, variable: str) -> tuple[str, str]:
    negative = function.to_str(variable).removeprefix("(").startswith("-")
    return ("-", _factor(-function, variable)) if negative else ("+", _factor(function, variable))


def _power(name: str, exponent: int) -> str:
    return name if exponent == 1 else f"{name}^{exponent}"


def _caret(text: str) -> str:
    return text.replace("**", "^")
