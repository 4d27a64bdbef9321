"""The steps from an equation with a right-hand side and values to its solution, as text, Markdown, LaTeX or HTML.

They are read from what `dsolve` found: the pair, its Wronskian, a particular solution, the equations for the constants.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import sympy
from sympy import Integer, Symbol

from kovacic.equation import parameters_of
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.answer import FirstOrderAnswer, SecondOrderAnswer
from kovacic.general_solution.conditions import Condition, symbols_of
from kovacic.general_solution.dsolve import answer_to
from kovacic.general_solution.particular import right_hand_side
from kovacic.general_solution.riccati import linear_equation
from kovacic.general_solution.textbook import sums
from kovacic.limits import DEFAULT_LIMITS, Limits, limited
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.pieces import Paste
from kovacic.reading.read import read_input
from kovacic.special.choice import shortest
from kovacic.views.explain import ExplanationWriter
from kovacic.writing.document import Block, Formula, Heading, format_of, say
from kovacic.writing.formula import Math, caret, free_name, of_sympy, shortened

Expr = Any  # SymPy publishes no types


@limited
def explain(
    eq: Any,
    func: Any = None,
    *,
    ics: Mapping[Any, Any] | str | None = None,
    var: str | None = None,
    parameters: Sequence[str] = (),
    assume: Mapping[Any, Any] | None = None,
    format: str = "text",
    limits: Limits = DEFAULT_LIMITS,
) -> str:
    """The steps to the solution of an equation of first or second order with its right-hand side and its values.

    These are the normal form, two solutions, their Wronskian, variation of parameters, and the equations for the constants;
    for first order the integrating factor, or the linear equation of second order that a Riccati equation becomes.
    `Solution.explain` shows how the two solutions are found.

    Parameters
    ----------
    eq, func, ics, var, parameters, assume, limits
        As for `dsolve`.
    format : str
        "text" (the default), "markdown", "latex" (the body of a document with amsmath) or "html", a page of its own.

    Returns
    -------
    str
        The document.

    Raises
    ------
    InputError, NotImplementedError
        As `dsolve`.
    ValueError
        For another format.

    Examples
    --------
    >>> print(explain("y'' + y = x, y(0) = 0, y'(0) = 0").splitlines()[-1].strip())
    y(x) = x - sin(x)
    """
    chosen = format_of(format)
    answer = answer_to(eq, func, ics=ics, var=var, parameters=parameters, assume=assume, limits=limits)
    blocks: list[Block] = []
    if isinstance(answer, FirstOrderAnswer):
        blocks += _steps_of_first_order(answer)
    elif isinstance(answer, SecondOrderAnswer):
        blocks += _steps(answer)
    blocks += (say(f"Note: {caret(notice)}.") for notice in answer.notices)
    blocks.append(Heading("The solution"))
    blocks += (Formula(of_sympy(found.lhs).equals(of_sympy(found.rhs))) for found in answer.equations)
    title = f"The solution of {shortened(eq) if isinstance(eq, str) else answer.equations[0].lhs}"
    return chosen.document(title, [Heading(title, 1), *blocks])


def is_problem(text: str) -> bool:
    """True for a text with values or a right-hand side, or with an equation that isn't linear of second order."""
    paste = Paste(text)
    if not paste.is_equation or paste.conditions or len(paste.equation_scans) > 1:
        return paste.is_equation
    try:
        found = read_input(text, exponentials=True, equation=True).equation
    except InputError as error:
        return isinstance(error, NotLinear)
    return found is not None and not found.is_homogeneous


def _definition(name: str, value: Expr) -> Formula:
    return Formula(_with_names("{}", name).equals(of_sympy(value)))


def _with_names(template: str, *names: object, latex: str = "") -> Math:
    """The template with names in its places; LaTeX may have a template of its own."""
    shown = [of_sympy(Symbol(str(name))).latex for name in names]
    return Math(template.format(*names), (latex or template).format(*shown))


def _equation_blocks(
    name: str, coefficients: Sequence[Expr], right: Expr, conditions: Sequence[Condition] = ()
) -> Iterator[Block]:
    """The equation with these coefficients of y, y', ..., y being `name`, and its values."""
    powers = [*enumerate(coefficients)]
    terms = [_coefficient_times(c, name + "'" * k) for k, c in reversed(powers) if c != 0]
    text, latex = (" + ".join(parts).replace("+ -", "- ") for parts in zip(*terms, strict=True))
    yield Formula(Math(text, latex).equals(of_sympy(right)))
    if conditions:
        said = ", ".join(condition.text for condition in conditions)
        yield say("with ", Math.of(said), ".")


def _coefficient_times(c: Expr, y: str) -> tuple[str, str]:
    """c y as text and as LaTeX, sums and quotients in parentheses."""
    sign = "-" if c.could_extract_minus_sign() else ""
    factor = of_sympy(-c if sign else c)
    text = f"({factor.text})" if {" ", "/"} & {*factor.text} else factor.text
    latex = rf"\left({factor.latex}\right)" if c.is_Add else factor.latex
    if factor.text == "1":
        return sign + y, sign + of_sympy(Symbol(y)).latex
    return f"{sign}{text}*{y}", f"{sign}{latex} {of_sympy(sympy.Symbol(y)).latex}"


def _steps(answer: SecondOrderAnswer) -> Iterator[Block]:
    """The steps for an equation of second order."""
    question = answer.question
    solution = answer.basis.solution
    assert solution is not None

    def own(e: Expr) -> Expr:
        return question.own(e).xreplace({answer.basis.x: question.x})

    F = own(right_hand_side(question.equation))
    y = question.equation.unknown
    yield Heading("The equation")
    if question.equation.change is None:
        B, C = map(own, answer.basis.rates)
        yield from _equation_blocks(y, (C, B, Integer(1)), F, question.conditions)
        if solution.gauge:
            yield Heading("Normal form")
            yield from ExplanationWriter(solution).normal_form(y)[1]
    else:
        yield say("Its coefficients are rational in ", of_sympy(function_of_x(question.equation)), ".")
    yield Heading("Two solutions without the right-hand side" if F != 0 else "Two solutions")
    parameters = ", ".join(parameters_of(solution.S.field))
    generic = f" for generic {parameters}" if parameters else ""
    source = f"There is no Liouvillian solution{generic}, so these are special functions"
    if solution.case is not None:
        source = f"By case {solution.case} of Kovacic's algorithm"
    yield say(f"{source}:")
    letters = sympy.Tuple(*map(question.own, question.coefficients)).free_symbols
    taken = letters | symbols_of(question.conditions)
    u, v = ("y1", "y2") if {"y1", "y2"}.isdisjoint(map(str, taken)) else ("u1", "u2")
    f, w, particular = (free_name(taken, *names) for names in (("F", "R", "G"), ("W", "D"), ("y0", "y_p", "u_p")))
    pair = {u: own(answer.basis.y1), v: own(answer.basis.y2)}
    yield from (_definition(name, value) for name, value in pair.items())
    W = own(answer.basis.wronskian)
    yield say("Their Wronskian ", _with_names("{0} {1}' - {0}' {1}", u, v), " is")
    yield _definition(w, W)
    if F != 0:
        yield Heading("Variation of parameters")
        yield say("A solution with the right-hand side ", _with_names("{}", f), " is")
        text = "{0} = -{1} int {2} {3}/{4} d{5} + {2} int {1} {3}/{4} d{5}"
        latex = r"{0} = -{1} \int \frac{{{2} {3}}}{{{4}}} d{5} + {2} \int \frac{{{1} {3}}}{{{4}}} d{5}"
        yield Formula(_with_names(text, particular, u, v, f, w, question.x, latex=latex))
        yield say("with")
        for name in (v, u):
            integrand = shortest([*sums(pair[name] * F / W, question.x)])
            quotient = _with_names("{} {}/{}", name, f, w, latex=r"\frac{{{} {}}}{{{}}}")
            yield Formula(quotient.equals(of_sympy(integrand)))
        yield say("Up to multiples of ", _with_names("{}", u), " and ", _with_names("{}", v), " it is")
        yield _definition(particular, own(answer.particular))
    if answer.determined is not None:
        yield Heading("The constants")
        c1, c2 = answer.names
        whole = "{} = {} {} + {} {}" if F == 0 else "{} = {} {} + {} {} + {}"
        yield say(_with_names(whole, y, c1, u, c2, v, particular), " has the given values where")
        rows = [row for row in answer.determined.rows if (row.u, row.v) != (0, 0)]
        conditions = [Formula(of_sympy(row.u * c1 + row.v * c2).equals(of_sympy(row.r))) for row in rows]
        values = zip(answer.names, answer.determined.generic.values, strict=True)
        yield from dict.fromkeys([*conditions, *(_definition(str(c), value) for c, value in values if value != c)])


def _steps_of_first_order(answer: FirstOrderAnswer) -> Iterator[Block]:
    """The steps for a linear equation, by its integrating factor, and a Riccati equation, by a linear one of second order."""
    equation = answer.equation
    w, x = equation.function, equation.x
    name = str(w.func)
    taken = {name, *equation.letters, *symbols_of(equation.conditions)}
    p, h, c = (free_name(taken, *names) for names in (("p", "f", "g", "R"), ("h", "H"), ("c", "v", "z")))
    square = equation.r * Symbol(name) ** equation.power
    yield Heading("The equation")
    yield from _equation_blocks(name, (-equation.q, Integer(1)), equation.p + square, equation.conditions)
    if equation.r == 0:
        yield Heading("The integrating factor")
        yield say("The equation without its right-hand side ", _with_names("{}", p), " has the solution")
        yield _definition(h, equation.homogeneous())
        if equation.p == 0:
            return
        constant = equation.constant(sympy.Tuple(*map(Symbol, map(str, taken))).free_symbols)
        yield say(
            f"With {name} = {h} {c} it says that {c}' = {p}/{h}, so {name} = {h} ({constant} + int {p}/{h}), where"
        )
        quotient = shortest([*sums(equation.p / equation.homogeneous(), x)])
        yield Formula(_with_names("{}/{}", p, h).equals(of_sympy(quotient)))
        return
    yield Heading("The linear equation")
    z = free_name(taken, "u", "z", "v")
    if equation.power != 2:
        linear_one = equation.of_power
        m = free_name(taken, "m", "k", "s")
        yield say(f"{z} = {name}^{m} makes it linear, where")
        yield _definition(m, 1 - equation.power)
        yield from _equation_blocks(z, (-linear_one.q, Integer(1)), linear_one.p)
        return
    linear, u = linear_equation(equation)
    r = free_name(taken, "r", "q", "R")
    yield say(f"{name} = -{z}'/({r} {z}), {r} the coefficient of {name}^2, makes it linear:")
    yield from _equation_blocks(z, [linear.lhs.coeff(u.diff(x, k) if k else u) for k in range(3)], Integer(0))
    yield say(f"Of the two constants of {z} only their quotient matters.")
