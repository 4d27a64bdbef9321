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
from kovacic.numbers.numerals import as_text, in_a_message
from kovacic.writing.formula import Formulas, Math, caret, latex_text, of_sympy, separated, text_of_words

#: Verdicts.
SOLVABLE = "Liouvillian solutions exist"
UNSOLVABLE = "no Liouvillian solution exists"
NOT_DECIDED = "undecided"
#: What y1 and y2 are if the equation has a right-hand side.
OF_HOMOGENEOUS = "two solutions of the homogeneous equation"


def formulas_of(answer: Answer | Parsed) -> Formulas:
    """The writer of functions of this answer, in its variable and with its constants."""
    return Formulas(answer.variable, answer.S.field)


def equation_of(answer: Answer | Parsed) -> Math:
    """The equation as given."""
    equation = answer.equation
    if equation is None:
        return normal_form_of(answer)
    return Math(str(equation), latex_text(equation.text(caret=False)))


def is_inhomogeneous(answer: Answer) -> bool:
    return answer.equation is not None and not answer.equation.is_homogeneous


def normal_form_of(answer: Answer | Parsed, y: str = "y") -> Math:
    """y'' = S y."""
    return Math.of(f"{y}''").equals(formulas_of(answer).times(answer.S, y))


def omega_math(riccati: RiccatiPolynomial, formulas: Formulas) -> Math:
    """omega if it is rational, else the equation of which it is a root, one term a line."""
    if riccati.degree == 1:
        return formulas.math(-riccati.coefficients[0])
    w = formulas.unknown
    m = riccati.degree
    lines = [Math.of(f"{w}^{m}")]
    for k, coefficient in reversed([*enumerate(riccati.coefficients[:m])]):
        if not coefficient:
            continue
        sign = "-" if formulas.math(coefficient).text.removeprefix("(").startswith("-") else "+"
        positive = coefficient if sign == "+" else -coefficient
        power = w if k == 1 else f"{w}^{k}"
        value = formulas.times(positive, power) if k else formulas.factor(positive)
        lines.append(Math(f"{sign} {value.text}", f"{sign} {value.latex}"))
    return Math.lines([*lines[:-1], lines[-1].equals(Math("0", "0"))])


def powers_in(series: TerminatingSeries, formulas: Formulas) -> Iterator[str | Math]:
    """The powers in P, for a P given by its recurrence."""
    t = formulas.math(series.theta.field.x - series.centre)
    highest, lowest, step = map(in_a_message, (series.degree, series.lowest, series.step))
    yield from (f"degree {highest}, with powers of ", t, f" down to {lowest} in steps of {step}")


def omega_lines(answer: Answer) -> list[str]:
    """omega, or its polynomial, and its constants, as text."""
    riccati, series, constants = answer.riccati, answer.series, answer.constants
    formulas = formulas_of(answer)
    omega = Math("", "") if riccati is None else omega_math(riccati, formulas)
    roots = None if constants is None else _simple_roots(constants)
    if roots is not None and omega.text == formulas.symbol:
        return [f"omega = {roots}"]
    if series is not None:
        theta, powers = formulas.math(series.theta).text, text_of_words(powers_in(series, formulas))
        lines = [f"omega = theta + P'/P with theta = {theta} and P of {powers}"]
    elif riccati is None or riccati.degree == 1:
        lines = [f"omega = {omega.text}"]
    else:
        lines = [f"omega is a root {formulas.unknown} of", *(f"    {line}" for line in omega.text.splitlines())]
    if constants is not None:
        root = roots or f"any root of {caret(constants.to_str(formulas.symbol))}"
        lines.append(f"where {formulas.symbol} is {root}")
    return lines


def _simple_roots(modulus: Poly) -> str | None:
    """The roots of c^2 - r for a rational number r, as "i or -i" and "sqrt(2) or -sqrt(2)"; None for other polynomials."""
    if not isinstance(modulus, RationalPoly):
        return None
    constant, *middle = modulus.coefficients()[:-1]
    if middle != [0]:
        return None
    unit = ["i"] if constant > 0 else []
    root = [] if abs(constant) == 1 else [f"sqrt({as_text(abs(constant))})"]
    written = "*".join(unit + root)
    return f"{written} or -{written}"


def reason(evidence: Evidence, formulas: Formulas) -> Iterator[str | Math]:
    """The reason why a structure is excluded, without the bounds of the linear systems."""
    if isinstance(evidence, NecessaryCondition):
        yield evidence.rule.value
        if evidence.places:
            yield from (" (at ", *separated(", ", map(formulas.place, evidence.places)), ")")
    elif isinstance(evidence, NoInvariant):
        m = evidence.invariant_degree
        if evidence.prime is None:
            yield f"the exponents leave no room for an invariant of degree {m}"
        else:
            yield f"no rational invariant of degree {m}, by a linear system of nullity 0 modulo {evidence.prime}"
    elif isinstance(evidence, NoTerminatingSeries):
        yield "the recurrence for P, of two terms, terminates for no theta that the exponents allow"
    elif evidence.prime is None:
        yield "the exponents leave no room for a rational omega"
    else:
        place = formulas.place(evidence.place)
        yield from ("no rational omega, by its expansion at ", place, f" modulo {evidence.prime}")


def solutions_of(answer: Answer) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    """Names and formulas of two solutions, and notes; in special functions if there is no Liouvillian one, empty if unknown.

    Raises `LimitExceeded` if the time is over.
    """
    form = derived.closed_form(answer)
    pair: Iterable[Any] = derived.special(answer) if form is None else form
    y = "y" if answer.equation is None else answer.equation.unknown
    names = [Math(f"{y}{k}", f"{latex_text(y)}_{{{k}}}") for k in (1, 2)]
    return list(zip(names, map(of_sympy, pair), strict=False)), () if form is None else form.notes


def verdict_in_words(answer: Answer) -> tuple[str, str]:
    """The verdict, and the case or the reason."""
    if answer.assumed and answer.reason is not None:
        return SOLVABLE, answer.reason
    if answer.riccati is not None:
        return SOLVABLE, f"case {answer.case}, omega = y'/y is {of_degree(answer.riccati.degree)}"
    if answer.series is not None:
        return SOLVABLE, f"case {answer.case}, omega = y'/y is rational"
    if answer.reason is not None:
        return NOT_DECIDED, answer.reason
    return UNSOLVABLE, "the Galois group is SL2(C)"


def of_degree(degree: int) -> str:
    return "rational" if degree == 1 else f"algebraic of degree {degree}"
