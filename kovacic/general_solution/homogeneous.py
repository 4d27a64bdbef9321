"""A basis of the solutions of the homogeneous equation: Liouvillian, or in special functions; or the reason for having none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

import sympy
from sympy import Symbol

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.rationals import to_fraction
from kovacic.closed_form.check import are_independent
from kovacic.closed_form.real_pair import is_turned, pair_in_x
from kovacic.closed_form.way_back import in_x, solution_in_x
from kovacic.decision import Status
from kovacic.equation import Equation, Parsed, parameters_of
from kovacic.errors import LimitExceeded
from kovacic.general_solution.basis import Basis, kernel, multiple_of
from kovacic.general_solution.integrands import NUMBERS
from kovacic.general_solution.places import limit_points, start_of
from kovacic.general_solution.question import Question
from kovacic.general_solution.textbook import of_chebyshev, with_waves
from kovacic.general_solution.validity import ZeroSet
from kovacic.limits import Budget
from kovacic.parametric.api import conditions_of
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions
from kovacic.reading.change_of_variable import function_of_x, is_in_power, real_values, user_variable
from kovacic.solution import Solution, solve
from kovacic.special.choice import chosen_form
from kovacic.special.mathieu import mathieu
from kovacic.special.search import BySign, by_sign, special_functions
from kovacic.special.writer import Wanted, WrittenPair
from kovacic.writing.formula import caret

Expr = Any  # SymPy publishes no types


class NothingKnown(NotImplementedError):
    """No solutions are known; `is_proven` is True if it is proven that none is Liouvillian."""

    def __init__(self, reason: str, *, is_proven: bool) -> None:
        super().__init__(reason)
        self.is_proven = is_proven


def find_basis(question: Question, budget: Budget, *, special: bool = False) -> Basis:
    """Liouvillian solutions if there are any, unless `special`; else special functions.  Raises `NotImplementedError`."""
    known, limits = question.assumptions, budget.share(1).limits
    solution = solve(question.equation, limits=limits)
    if solution.status is Status.NONE_EXISTS and known.concerns_exponents:
        solution = solve(question.equation, assume=known.to_dict(), limits=limits)
    if solution.case is not None and not special:
        is_changed = question.equation.change is not None
        places = real_values(question.equation)
        form = chosen_form(solution.S, solution.decision, solution.gauge, solution.variable, budget, places=places)
        # with what is assumed of letters
        below = [question.own(b) for f in sympy.Tuple(*form).atoms(sympy.hyper) for b in f.bq]
        has_poles = any(b.is_integer and not b.is_positive for b in below)
        if not has_poles and not any(question.own(condition) == 0 for condition in form.undefined):
            # in t the quotient has values at more points
            in_t = partial(multiple_of, kernel(question.equation), form.y1, form.y2, form.variable)
            pair = WrittenPair(form.y1, form.y2, None, form.undefined, form.place)
            return replace(_basis(question, solution, pair, in_t if is_changed else None), form=form)
    found = _in_special_functions(question, solution, budget)
    if not isinstance(found, BySign):
        return _basis(question, solution, found)
    basis = _basis(question, solution, found.natural)
    otherwise = None if found.negative is None else _basis(question, solution, found.negative)
    return replace(basis, natural=question.own(found.integer), otherwise=otherwise)


def _basis(
    question: Question, solution: Solution, pair: WrittenPair, in_t: Callable[[], Expr | None] | None = None
) -> Basis:
    """The solutions in the user's variable; `in_t` gives the Wronskian of those in t where the pair hasn't got it."""
    equation = question.equation
    if is_in_power(equation):  # whose exponent has plain symbols
        plain = {symbol: Symbol(name) for name, symbol in question.parameters.items()}
        pair = pair.mapped(lambda e: e.xreplace(plain))
    y1, y2 = (y.xreplace(NUMBERS) for y in pair_in_x(equation, *pair))
    rests_on = (equation, question.own, partial(_stated, equation, pair, in_t), pair.undefined, solution)
    basis = Basis(y1, y2, question.x, *rests_on, place=pair.place if equation.change is None else None)
    S = equation.S
    constant = S.num[0] if S.is_polynomial and S.num.degree == 0 else None
    if isinstance(constant, FunctionPoly) and not question.assumptions.is_positive(constant):
        y1, y2 = with_waves(y1, y2)
    if not question.conditions:  # which may be outside of the interval where f is a cosine
        y1, y2, place = of_chebyshev(y1, y2, question.x)
        if place is not None:
            basis = replace(basis, place=place)
    return basis.of(y1, y2)


def _stated(equation: Equation, pair: WrittenPair, in_t: Callable[[], Expr | None] | None) -> Expr | None:
    """The Wronskian in the user's variable of the members as `solution_in_x` writes them, up to constant factors; or None."""
    W = pair.wronskian if in_t is None else in_t()
    if W is None or equation.change is None or not sympy.Tuple(*pair).has(Symbol(equation.variable)):
        return W
    if any(is_turned(equation, y) for y in pair):  # by constants that are left out
        return None
    x = user_variable(equation)
    slope = function_of_x(equation).diff(x)
    y1, y2 = (solution_in_x(equation, y) for y in pair)
    constants = sympy.Mul(
        *(sympy.powsimp(member / in_x(equation, y)) for member, y in zip((y1, y2), pair, strict=True))
    )
    if constants.has(x):
        return None
    short = None if constants.is_number else multiple_of(in_x(equation, kernel(equation)) * slope, y1, y2, x)
    return in_x(equation, W) * slope * constants if short is None else short


def _in_special_functions(question: Question, solution: Solution, budget: Budget) -> WrittenPair | BySign:
    """Special functions, analytic at ordinary points; by the sign of an integer if that is needed, or gives shorter ones."""
    is_positive = all(e.is_positive for e in (question.function.args[0], *question.points))
    has_values = bool(question.conditions) and not limit_points(question)  # all at ordinary points
    request = Wanted(
        solution.S,
        solution.gauge,
        solution.variable,
        question.parameters,
        joined=not is_positive,
        places=_real_places(question),
        centre=_centre(question),
    )
    found = special_functions(request, budget)
    pair = found.pair
    if has_values and any(symbol.is_integer for symbol in question.parameters.values()):
        of_any_letters = special_functions(replace(request, symbols={}), budget)
        pair = _without_exceptions(of_any_letters.pair, Symbol(solution.variable)) or pair
    # neither a particular solution nor a value is needed
    is_bare = question.equation.is_homogeneous and not has_values
    if pair is None or is_bare:
        halves = by_sign(request, budget)
        if halves is not None:
            return halves
    equation = question.equation
    if pair is None and equation.change is not None:
        pair = mathieu(solution.S, solution.gauge, equation)
    if pair is None:
        reason = f"{no_solution(solution, question.assumptions)}; {found}"
        raise NothingKnown(reason, is_proven=solution.status is Status.NONE_EXISTS)
    if is_positive and is_bare:
        pair = _without_second_kind(pair)
    if solution.case is not None and not are_independent(pair.y1, pair.y2, Symbol(solution.variable)):
        raise NotImplementedError(f"{no_solution(solution, question.assumptions)}; {found}")
    return pair


def _real_places(question: Question) -> tuple[Fraction, ...]:
    """Values of the variable at which solutions are to be real: the point of the conditions, if it is rational."""
    equation = question.equation
    if question.conditions and equation.change is None:
        start = start_of(question, limit_points(question))
        if start.is_Rational:
            return (to_fraction(start),)
    return real_values(equation)


def _centre(question: Question) -> Fraction | None:
    """The value of the equation's variable at the singular point, if it is rational, at which the only limit is given."""
    equation = question.equation
    points = [*limit_points(question)]
    if len(points) != 1 or points[0].is_infinite:
        return None
    value = points[0]
    if equation.change is not None:
        value = function_of_x(equation).subs(user_variable(equation), value)
    return to_fraction(value) if value.is_Rational else None


def _without_exceptions(pair: WrittenPair | None, x: Expr) -> WrittenPair | None:
    """The pair if it is defined and independent for all values of the letters, like one about an ordinary point; else None."""
    if pair is None or pair.undefined or pair.wronskian is None:
        return None
    constant = pair.wronskian.as_independent(x, as_Add=False)[0]
    return None if ZeroSet(constant) else pair


def _without_second_kind(pair: WrittenPair) -> WrittenPair:
    """J_-nu for Y_nu = (J_nu cos(pi nu) - J_-nu)/sin(pi nu), where nu is no integer."""
    second = [f for f in pair.y2.atoms(sympy.bessely) if f.args[0].is_noninteger]
    if not second or pair.wronskian is None:
        return pair
    nu = second[0].args[0]
    y2 = pair.y2.xreplace({f: sympy.besselj(-nu, f.args[1]) for f in second})
    return replace(pair, y2=y2, wronskian=-sympy.sin(sympy.pi * nu) * pair.wronskian)


def no_solution(solution: Solution, known: Assumptions = NOTHING_ASSUMED) -> str:
    """The reason for having no closed form; with parameters, the values for which there is one."""
    if solution.status is Status.UNDECIDED:
        return f"undecided: {solution.reason}"
    names = ", ".join(parameters_of(solution.S.field))
    said = f"{names and f'for generic {names} '}there is no Liouvillian solution, and that is proven: the differential Galois"
    said += f" group of the normal form y'' = ({caret(solution.S.to_str(solution.variable))}) y is SL2(C)"
    if not names:
        return said
    try:
        found = conditions_of(Parsed(solution.S, solution.variable), known, None, solution.limits)
    except LimitExceeded:
        return said
    is_complete = found.complete is True
    regions = [region for region in found.regions if region.case is not None and region.defined]
    if regions:
        listed = "; ".join(f"{region.statement} (case {region.case})" for region in regions)
        return f"{said}\nthere is one where {listed}{'' if is_complete else '; ...'}: substitute such values"
    return f"{said}; nor is there for any others ({found.theory})" if is_complete else said
