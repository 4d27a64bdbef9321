"""Where the conditions are given, the singular points near these, and solutions that are real there.

Singular points are the poles of b/a and c/a, and those of f/a: a solution isn't determined on one side by its values on
the other.  At a singular point and at infinity, a condition is one on a limit, from the side on which the others are.

Singular points are found if they have no parameters: of rational coefficients, of coefficients in t = f(k x + c) and in
t = x^k, and of a right-hand side with polynomials, roots of x, or waves in denominators.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside, S, Tuple

from kovacic.closed_form import cuts
from kovacic.closed_form.form import pair_at
from kovacic.closed_form.steps import is_analytic, jump_place, jump_points
from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis, monic_coefficients
from kovacic.general_solution.behaviour import Approach, have_values
from kovacic.general_solution.integrands import NUMBERS
from kovacic.general_solution.particular import right_hand_side, turned_at
from kovacic.general_solution.question import Question
from kovacic.general_solution.validity import needs_of
from kovacic.general_solution.waves import wave_zeros
from kovacic.limits import MOST_TRIALS, check_time
from kovacic.reading.change_of_variable import is_in_power, is_of_a_line

Expr = Any  # SymPy publishes no types


def impulses_inside(question: Question) -> tuple[dict[Expr, Expr], list[str], dict[Expr, Expr]]:
    """Impulses taken to lie between the two points of the conditions, as in Green's function, at letters of unknown order.

    The values of the steps H(low - a) = 0 and H(high - a) = 1, the order in words, and expressions for letters that put the
    impulses there, for all values of the remaining letters.  Empty without two finite points, or with steps.
    """
    h = question.equation.h or sympy.S.Zero
    is_impulse = not h.has(Heaviside) and all(len(impulse.args) == 1 for impulse in h.atoms(DiracDelta))
    values: dict[Expr, Expr] = {}
    notices: list[str] = []
    numbers: dict[Expr, Expr] = {}
    if len(question.points) != 2 or any(point.is_infinite for point in question.points) or not is_impulse:
        return values, notices, numbers
    low, high = question.points
    if (high - low).is_negative:
        low, high = high, low
    for a in map(question.own, jump_points(h, question.x)):
        is_above, is_below = (a - low).is_positive, (high - a).is_positive
        is_open = None in (is_above, is_below) and False not in (is_above, is_below)
        if not is_open or not (a.is_Symbol or high.is_Symbol):
            continue
        for end, value in ((low, 0), (high, 1)):
            values |= dict.fromkeys((Heaviside(end - a), Heaviside(end - a, 0)), sympy.Integer(value))
        notices.append(f"this holds for {'' if is_above else f'{low} < '}{a}{'' if is_below else f' < {high}'}")
        if a.is_Symbol:
            numbers[a] = low + (high - low) * sympy.Rational(3, 7)
        else:
            numbers[high] = numbers.get(high, 1) + a
    return values, notices, numbers


def limit_points(question: Question) -> dict[Expr, Approach]:
    """The points of conditions on limits, with the side.  Raises `InputError` if the other points are on both sides."""
    points = _all_points(question)
    found = {}
    for point in question.points:
        if point.is_infinite:
            found[point] = Approach(point)
        elif is_singular(question, point):
            sides = {sympy.sign(other - point) for other in points} & {1, -1}  # empty if nothing is known
            if len(sides) > 1:
                raise _apart_error(point, [other for other in points if other != point])
            found[point] = Approach(point, int(next(iter(sides), 1)))
    return found


def _apart_error(point: Expr, points: Sequence[Expr]) -> InputError:
    said = f"a singular point of the equation lies between {', '.join(map(str, points))}"
    return InputError(f"{said}: {point}; on each side the solutions are others")


def start_of(question: Question, limits: dict[Expr, Approach]) -> Expr:
    """An ordinary point on the side that is meant: the first one with a condition, or one between singular points."""
    ordinary = [point for point in question.points if point not in limits]
    if ordinary:
        between = _possible_poles_between(question, ordinary) if question.equation.change is None else ()
        # beyond a removable point of f/a solutions are continued from there
        return next((point for point in between if not is_singular(question, point)), ordinary[0])
    poles = [*_possible_poles(question)]
    finite = [approach for approach in limits.values() if not approach.is_infinite]
    if not finite:  # an integer beyond all poles
        sign = sympy.sign(next(iter(limits)))
        return sign * (sympy.ceiling(sympy.Max(0, *(sign * pole for pole in poles))) + 1)
    place = finite[-1]
    ends = [approach.point for approach in finite if approach.point != place.point]
    ends += [pole for pole in poles if ((pole - place.point) * place.direction).is_positive]
    if not ends:
        return place.point + place.direction
    nearest = min(ends, key=lambda end: abs(end - place.point).evalf())  # half way to it there are no others
    return (place.point + nearest) / 2


def check_between(question: Question, solutions: Sequence[Expr]) -> None:
    """Raise `InputError` if a singular point lies between points of conditions or jumps, unless the solutions are analytic."""
    points = [point for point in _all_points(question) if point.is_extended_real]
    whole = Tuple(*map(question.own, solutions))
    if len(points) < 2 or (all(is_analytic(y, question.x) for y in whole) and not whole.has(Heaviside)):
        return
    for point in _possible_poles_between(question, points):
        if is_singular(question, point):
            raise _apart_error(point, points)


def _all_points(question: Question) -> list[Expr]:
    """The points of conditions and of jumps."""
    return [*question.points, *jump_points(question.equation.h or sympy.S.Zero, question.x)]


def basis_real_at(basis: Basis, point: Expr) -> Basis:
    """Two solutions that are real at the point if such are found; else the given ones."""
    if basis.equation.change is not None:
        return basis
    solution, form = basis.solution, basis.form
    assert solution is not None
    anew = None if form is None else lambda: tuple(y.xreplace(NUMBERS) for y in pair_at(form, point, basis.own))
    given = (basis.y1, basis.y2)
    pair = cuts.real_at(given, basis.x, solution.S, solution.gauge, point, anew=anew, own=basis.own)
    return basis if pair == given else replace(basis.of(*pair), place=point)


def real_particular(question: Question, basis: Basis, particular: Expr, place: Expr) -> Expr:
    """A particular solution that is real at a place, as log(1 - x) for log(x - 1), if one is found; else the given one."""
    check_between(question, (basis.y1, basis.y2, particular))
    x, equation = question.x, question.equation
    if equation.change is not None or not place.is_real or particular.has(sympy.Integral, Heaviside):
        return particular
    return turned_at(place, particular, basis.rates, right_hand_side(equation), x, question.own)


def one_sided(question: Question) -> tuple[Question, list[str]]:
    """The question on the side of a singular point on which values lie, else on the right, and notices of that.

    A step in a root or a denominator, at such a point, needs it: |x|^n is x^n for x > 0 only.
    """
    h, x, notices = question.equation.h, question.x, []
    parts = () if h is None else h.atoms(sympy.Pow, sympy.Function) - h.atoms(Heaviside, DiracDelta)
    steps = {step for step in Tuple(*parts).atoms(Heaviside) if step.has(x)}
    for step in sorted(steps, key=str):
        place = jump_place(step, x)
        if place is None or place.slope.is_positive is None or not is_singular(question, place.a):
            continue
        is_left = bool(question.points) and (question.points[0] - place.a).is_negative is True
        h = h.xreplace({step: sympy.Integer(place.slope.is_positive is not is_left)})  # H(s (x - a)) on this side
        notices.append(f"this holds for {x} {'<' if is_left else '>'} {place.a}: the equation is singular there")
    if not notices:
        return question, []
    return replace(question, equation=replace(question.equation, h=h), given=replace(question.given, h=h)), notices


def is_singular(question: Question, point: Expr) -> bool:
    """True if b/a, c/a or f/a, without its jumps, has neither a value nor a limit at a finite point; and for x^k at 0."""
    equation, x = question.equation, question.x
    right = right_hand_side(equation)
    smooth = right.xreplace(dict.fromkeys(right.atoms(Heaviside, DiracDelta), S.Zero))
    parts = [*map(question.own, (*monic_coefficients(equation, x), smooth))]
    return (point == 0 and is_in_power(equation)) or not have_values(parts, x, point)


def _possible_poles_between(question: Question, points: Sequence[Expr]) -> Iterator[Expr]:
    """Points that may be singular, with some of the points on either side."""
    suspects = _possible_poles(question, points)
    return (suspect for suspect in suspects if {1, -1} <= {sympy.sign(point - suspect) for point in points})


def _possible_poles(question: Question, points: Sequence[Expr] = ()) -> Iterator[Expr]:
    """Zeros of denominators without parameters: those of polynomials, and others that lie between points."""
    equation, x = question.equation, question.x
    numbers = [point for point in points if point.is_number and point.is_finite]
    if is_in_power(equation):
        yield S.Zero
    elif len(numbers) > 1 and not is_of_a_line(equation):
        raise NotImplementedError("undecided: whether a singular point lies between the points that are given")
    parts = Tuple(*monic_coefficients(equation, x), right_hand_side(equation))
    needs = (need.u for need in needs_of(question.own(parts)) if "0" not in need.signs)
    zeros = {factor.as_base_exp()[0] for u in needs for factor in sympy.Mul.make_args(sympy.factor(u))}
    for zero in sorted(zeros, key=str):
        if zero.free_symbols == {x}:
            yield from _denominator_zeros(zero, x, sympy.Min(*numbers), sympy.Max(*numbers))


def _denominator_zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """The real zeros of a polynomial, or of the real part; of others those between two numbers, the first ones of many.

    If there are several functions, only for exponentials, and for waves of one angle.
    """
    t = sympy.Dummy(real=True)
    functions = {f for f in e.atoms(sympy.Function) if f.has(x)}
    e = e.xreplace({x: t})
    e = e.as_real_imag()[0] if e.has(sympy.I) else e
    if e.is_polynomial(t):
        with suppress(NotImplementedError, sympy.PolynomialError):  # roots without a formula, coefficients such as pi
            yield from dict.fromkeys(sympy.real_roots(sympy.Poly(e, t, extension=True)))
            return
    if len(functions) > 1 and {f.func for f in functions} != {
        sympy.exp
    }:  # SymPy takes minutes for sin(3 x) and cos(5 x)
        with suppress(NotImplementedError, sympy.PolynomialError):
            yield from wave_zeros(e, t, first, last)
        return
    found, width = 0, 8  # twice as wide each time, since a wave has zeros without end
    while first < last and found < MOST_TRIALS:
        check_time()
        end = sympy.Min(first + width, last)
        with suppress(NotImplementedError, ValueError, TypeError):
            zeros = sympy.solveset(e, t, sympy.Interval(first, end))
            if isinstance(zeros, sympy.FiniteSet):
                yield from (zero for zero in zeros if zero.is_number)
                found += len(zeros)
        first, width = end, 2 * width
