"""Parts that several views share: the equation, omega, the solutions, the reasons of an exclusion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from kovacic import derived
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import RationalPoly
from kovacic.answer import Answer
from kovacic.decision import (
    Evidence,
    NecessaryCondition,
    NoInvariant,
    NoTerminatingSeries,
    RiccatiPolynomial,
    TerminatingSeries,
)
from kovacic.equation import Parsed
from kovacic.errors import LimitExceeded
from kovacic.numbers.numerals import as_text, in_a_message
from kovacic.writing.formula import LARGEST_DEGREE, Formulas, Math, caret, latex_text, of_sympy

#: Verdicts.
SOLVABLE = "Liouvillian solutions exist"
UNSOLVABLE = "no Liouvillian solution exists"
UNDECIDED = "undecided"


def formulas_of(answer: Answer | Parsed) -> Formulas:
    """The writer of functions of this answer, in its variable and with its constants."""
    return Formulas(answer.variable, answer.S.field)


def equation_of(answer: Answer) -> Math:
    """The equation as given."""
    equation = answer.equation
    if equation is None:
        return normal_form(answer)
    return Math(str(equation), latex_text(equation.text(caret=False)))


def normal_form(answer: Answer | Parsed, y: str = "y") -> Math:
    """y'' = S y."""
    return Math(f"{y}''", f"{y}''").equals(formulas_of(answer).times(answer.S, y, y))


def omega_math(riccati: RiccatiPolynomial, formulas: Formulas) -> Math:
    """omega if it is rational, else the equation of which it is a root, one term a line."""
    if riccati.degree == 1:
        return formulas.math(-riccati.coefficients[0])
    w = formulas.unknown
    m = riccati.degree
    texts = [f"{w}^{m}"]
    latex = [f"{w}^{{{m}}}"]
    for k in range(m - 1, -1, -1):
        coefficient = riccati.coefficients[k]
        if not coefficient:
            continue
        sign = "-" if formulas.math(coefficient).text.removeprefix("(").startswith("-") else "+"
        positive = coefficient if sign == "+" else -coefficient
        if k == 0:
            value = formulas.factor(positive)
        elif k == 1:
            value = formulas.times(positive, w, w)
        else:
            value = formulas.times(positive, f"{w}^{k}", f"{w}^{{{k}}}")
        texts.append(f"{sign} {value.text}")
        latex.append(f"{sign} {value.latex}")
    lines = r" \\ \displaystyle ".join(latex)
    return Math("\n".join(texts) + " = 0", rf"\begin{{array}}{{l}} \displaystyle {lines} = 0 \end{{array}}")


def powers_in(series: TerminatingSeries, formulas: Formulas) -> Iterator[str | Math]:
    """The powers that P has, where it is known by its recurrence."""
    t = formulas.math(series.theta.field.poly([0, 1]) - series.centre)
    highest, lowest, step = map(in_a_message, (series.degree, series.lowest, series.step))
    yield f"degree {highest}, with powers of "
    yield t
    yield f" down to {lowest} in steps of {step}"


def plain(parts: Iterable[str | Math]) -> str:
    """A sentence as text."""
    return "".join(part.text if isinstance(part, Math) else part for part in parts)


def omega_lines(answer: Answer) -> list[str]:
    """omega, or its polynomial, and its constants, as text."""
    riccati = answer.riccati
    series = answer.series
    formulas = formulas_of(answer)
    omega = Math("", "") if riccati is None else omega_math(riccati, formulas)
    constants = answer.constants
    roots = None if constants is None else _simple_roots(constants)
    if roots is not None and omega.text == formulas.symbol:
        return [f"omega = {roots}"]
    if series is not None:
        theta, powers = formulas.math(series.theta).text, plain(powers_in(series, formulas))
        lines = [f"omega = theta + P'/P with theta = {theta} and P of {powers}"]
    elif riccati is None or riccati.degree == 1:
        lines = [f"omega = {omega.text}"]
    else:
        lines = [f"omega is a root {formulas.unknown} of", *(f"    {line}" for line in omega.text.splitlines())]
    if constants is not None:
        what = roots or f"any root of {caret(constants.to_str(formulas.symbol))}"
        lines.append(f"where {formulas.symbol} is {what}")
    return lines


def _simple_roots(modulus: Poly) -> str | None:
    """The roots of c^2 - r for a rational number r, as "i or -i" and "sqrt(2) or -sqrt(2)"; None for other polynomials."""
    if not isinstance(modulus, RationalPoly):
        return None
    constant, *middle = modulus.coefficients()[:-1]
    if middle != [0]:
        return None
    unit = "i" if constant > 0 else ""
    root = "" if abs(constant) == 1 else f"sqrt({as_text(abs(constant))})"
    written = "*".join(part for part in (unit, root) if part)
    return f"{written} or -{written}"


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
    elif isinstance(evidence, NoTerminatingSeries):
        yield "the recurrence for P, of two terms, doesn't end for any theta that the exponents allow"
    elif evidence.prime is None:
        yield "the exponents leave no room for a rational omega"
    else:
        yield "no rational omega, by its expansion at "
        yield formulas.place(evidence.place)
        yield f" modulo {evidence.prime}"


def solutions_of(answer: Answer) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    """Names and formulas of two solutions, and notes; in special functions if there is no Liouvillian one, empty if unknown.

    Raises `LimitExceeded` for formulas that are too long to be printed, and where no time is left.
    """
    semi = answer.semi_invariant
    if semi is not None and semi.P.degree > LARGEST_DEGREE:
        raise LimitExceeded(f"P has the degree {semi.P.degree}; --json --full has it", limit="degree")
    form = derived.closed_form(answer)
    if form is None:
        return _named_solutions(answer, derived.special(answer)), ()
    return _named_solutions(answer, form), form.notes


def _named_solutions(answer: Answer, values: Iterable[Any]) -> list[tuple[Math, Math]]:
    y = "y" if answer.equation is None else answer.equation.unknown
    names = [Math(f"{y}{k}", f"{y}_{{{k}}}") for k in (1, 2)]
    return list(zip(names, map(of_sympy, values), strict=False))


def verdict_of(answer: Answer) -> tuple[str, str]:
    """The verdict, and the case or the reason."""
    if answer.assumed and answer.reason is not None:
        return SOLVABLE, answer.reason
    if answer.riccati is not None:
        return SOLVABLE, f"case {answer.case}, omega = y'/y is {of_degree(answer.riccati.degree)}"
    if answer.series is not None:
        return SOLVABLE, f"case {answer.case}, omega = y'/y is rational"
    if answer.reason is not None:
        return UNDECIDED, answer.reason
    return UNSOLVABLE, "the Galois group is SL2(C)"


def of_degree(degree: int) -> str:
    return "rational" if degree == 1 else f"algebraic of degree {degree}"
