"""Where the conditions are given, and solutions that are real there.

Singular points are the poles of b/a and c/a, and those of f/a: a solution isn't determined on one side by its values on
the other.  At a singular point and at infinity, a condition is one on a limit, from the side on which the others are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.general_solution.behaviour import Approach, behaviour
from kovacic.general_solution.expansion import UnknownBehaviour
from kovacic.general_solution.question import Question
from kovacic.general_solution.real_basis import negative_arguments, real_basis, real_particular
from kovacic.general_solution.steps import place_of
from kovacic.general_solution.substitution import finite_value
from kovacic.general_solution.variation import Basis, starting_at
from kovacic.general_solution.zero import is_zero
from kovacic.reading.change_of_variable import function_of_x, is_of_a_line, is_power, user_variable
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
_INFINITIES = (sympy.oo, -sympy.oo)
#: The functions that are analytic everywhere.
_ENTIRE = (
    sympy.exp,
    sympy.sin,
    sympy.cos,
    sympy.sinh,
    sympy.cosh,
    sympy.erf,
    sympy.erfi,
    sympy.Si,
    sympy.airyai,
    sympy.airybi,
)


def _logarithms(value: Expr) -> list[Expr]:
    if value == 0:
        return []
    return [sympy.log(value)]


@dataclass(frozen=True)
class _Inverse:
    """The x with f(x) = value, up to a period if there is one."""

    values: Callable[[Expr], list[Expr]]
    period: Expr | None = None

    def real_step(self, slope: Expr) -> Expr | None:
        """How far apart the x with one value of f(slope x + c) are; None where that isn't real."""
        if self.period is None:
            return None
        step = self.period / slope
        if not step.is_real:
            return None
        return abs(step)


#: Those of the functions f that are variables of equations.
_INVERSES: dict[Any, _Inverse] = {
    sympy.exp: _Inverse(_logarithms, 2 * sympy.pi * sympy.I),
    sympy.cosh: _Inverse(lambda value: [sympy.acosh(value), -sympy.acosh(value)]),
    sympy.sinh: _Inverse(lambda value: [sympy.asinh(value)]),
    sympy.cos: _Inverse(lambda value: [sympy.acos(value), -sympy.acos(value)], 2 * sympy.pi),
    sympy.sin: _Inverse(lambda value: [sympy.asin(value), sympy.pi - sympy.asin(value)], 2 * sympy.pi),
    sympy.tan: _Inverse(lambda value: [sympy.atan(value)], sympy.pi),
}
#: The most singular points of an interval that are looked at.
_MOST_POINTS = 200


def given_points(question: Question) -> list[Expr]:
    """The points of the conditions, each once, in the order in which they are given."""
    return [*dict.fromkeys(point for condition in question.conditions for point in condition.points)]


def jump_points(question: Question) -> list[Expr]:
    """The places of steps and impulses on the right-hand side."""
    h = question.equation.h
    if h is None:
        return []
    places = [place_of(jump, question.x) for jump in sorted(h.atoms(sympy.Heaviside, sympy.DiracDelta), key=str)]
    return [*dict.fromkeys(place.a for place in places if place is not None)]


def is_singular(question: Question, point: Expr) -> bool:
    """Is a finite point a pole of b/a, c/a or f/a, or one where the rest of the right-hand side has no value?"""
    if any(_is_root(question, den, point) for den in _denominators(question.equation)):
        return True
    h = question.equation.h
    if h is None:
        return False
    smooth = h.xreplace(dict.fromkeys(h.atoms(sympy.Heaviside, sympy.DiracDelta), sympy.Integer(0)))
    return finite_value(smooth, question.x, point) is None


def _denominators(equation: Equation) -> list[Poly]:
    """Those of b/a, c/a and f/a that aren't constant."""
    quotients = [part / equation.a for part in (equation.b, equation.c, equation.f)]
    return [quotient.den for quotient in quotients if quotient.den.degree > 0]


def _is_root(question: Question, polynomial: Poly, point: Expr) -> bool:
    """Is a polynomial in the variable of the equation zero, or without a value, at a point in the user's variable?"""
    equation = question.equation
    atoms = Atoms(sympy.Symbol(equation.variable))
    at = question.own(function_of_x(equation)).subs(user_variable(equation), point)
    if at.is_Rational and polynomial.field == QQ:
        return not polynomial(Fraction(int(at.p), int(at.q)))
    value = question.own(atoms.poly(polynomial)).subs(atoms.x, at)
    return value.is_finite is False or is_zero(value)


def limit_points(question: Question) -> dict[Expr, Approach]:
    """The points of the conditions at which these are conditions on limits, with the side.

    Raises `InputError` where the others are on both sides.
    """
    points = given_points(question)
    found = {}
    for point in points:
        if point in _INFINITIES:
            found[point] = Approach(point)
        elif is_singular(question, point):
            found[point] = Approach(point, _side(point, [*points, *jump_points(question)]))
    return found


def _side(point: Expr, points: Sequence[Expr]) -> int:
    """1 or -1: on which side of the point the others are; 1 where that isn't known."""
    sides = set()
    for other in points:
        distance = other - point
        if distance.is_positive:
            sides.add(1)
        elif distance.is_negative:
            sides.add(-1)
    if len(sides) > 1:
        raise _apart(point, [other for other in points if other != point])
    if not sides:
        return 1
    return sides.pop()


def _apart(point: Expr, points: Sequence[Expr]) -> InputError:
    said = f"a singular point of the equation lies between {', '.join(map(str, points))}"
    return InputError(f"{said}: {point}; on each side the solutions are others")


def start_of(question: Question, limits: dict[Expr, Approach]) -> Expr:
    """An ordinary point on the side that is meant: the first one with a condition, or one between singular points."""
    ordinary = [point for point in given_points(question) if point not in limits]
    if ordinary:
        return ordinary[0]
    poles = [*_rational_poles(question)]
    finite = [approach for approach in limits.values() if not approach.is_infinite]
    if not finite:
        return _beyond(next(iter(limits.values())), poles)
    place = finite[-1]
    others = [approach.point for approach in finite if approach.point != place.point]
    ahead = [pole for pole in poles if ((pole - place.point) * place.direction).is_positive]
    return _beside(place, [*ahead, *others])


def _beside(place: Approach, ends: Sequence[Expr]) -> Expr:
    """Half way from a finite place to the nearest of the ends; one step away from it without any."""
    if not ends:
        return place.point + place.direction
    nearest = min(ends, key=lambda end: abs(end - place.point).evalf())
    return (place.point + nearest) / 2


def _beyond(place: Approach, poles: Sequence[Expr]) -> Expr:
    """An integer beyond all poles."""
    if place.point == sympy.oo:
        return sympy.ceiling(sympy.Max(0, *poles)) + 1
    return sympy.floor(sympy.Min(0, *poles)) - 1


def check_between(question: Question, solutions: Sequence[Expr]) -> None:
    """Raises `InputError` where a singular point lies between points of conditions or jumps.

    Solutions that are written with functions that are analytic everywhere may be continued.
    """
    points = [point for point in _points(question) if point not in _INFINITIES]
    if len(points) < 2 or not all(_is_real_number(point) for point in points):
        return
    if all(_is_entire(question.own(y), question.x) for y in solutions):
        return
    first = sympy.Min(*points)
    last = sympy.Max(*points)
    for pole in _poles_between(question, first, last):
        raise _apart(pole, points)


def _poles_between(question: Question, first: Expr, last: Expr) -> Iterator[Expr]:
    """The singular points without parameters between two points."""
    for pole in [*_rational_poles(question), *_changed_poles(question, first, last)]:
        if pole.is_number and first < pole < last:
            yield pole


def _is_real_number(point: Expr) -> bool:
    return bool(point.is_real and point.is_number)


def _points(question: Question) -> list[Expr]:
    """Those of conditions, and those of jumps."""
    return [*given_points(question), *jump_points(question)]


def _is_entire(y: Expr, x: Expr) -> bool:
    """Is it made of functions that are analytic everywhere, by sums, products and natural powers?"""
    return all(_keeps_entire(e, x) for e in sympy.preorder_traversal(y) if e.has(x))


def _keeps_entire(e: Expr, x: Expr) -> bool:
    """Is it x, a sum, a product, a natural power or such a function: analytic everywhere if its arguments are?"""
    if e.is_Pow and not isinstance(e, sympy.exp):
        return bool(e.exp.is_Integer and e.exp > 0)
    is_sum_or_product = e.is_Add or e.is_Mul
    return e == x or is_sum_or_product or isinstance(e, _ENTIRE)


def _rational_poles(question: Question) -> Iterator[Expr]:
    """The real singular points of an equation with rational coefficients over Q."""
    equation = question.equation
    if equation.change is not None:
        return
    for den in _denominators(equation):
        if den.field == QQ:
            yield from sympy.real_roots(Atoms(question.x).poly(den), multiple=True)


def _changed_poles(question: Question, first: Expr, last: Expr) -> Iterator[Expr]:
    """Singular points between two points, of an equation in t = f(k x + c)."""
    equation = question.equation
    if equation.change is None:
        return
    if is_power(equation):
        yield from _poles_of_a_power(question)
        return
    if not is_of_a_line(equation):
        raise NotImplementedError("undecided: whether a singular point lies between the points that are given")
    value = function_of_x(equation)
    rates = _rates_in_x(question, value)
    for root in _poles_in_t(equation):
        candidates = _preimages(value, root, question.x, first, last)
        yield from (x0 for x0 in candidates if not _is_analytic(rates, question.x, x0))


def _poles_in_t(equation: Equation) -> list[Expr]:
    """Those without parameters of b/a, c/a and f/a in the variable of the equation."""
    t = sympy.Symbol(equation.variable)
    found: set[Expr] = set()
    for polynomial in _denominators(equation):
        den = Atoms(t).poly(polynomial)
        if den.free_symbols == {t}:
            found.update(sympy.roots(den, t))
    return sorted(found, key=str)


def _poles_of_a_power(question: Question) -> Iterator[Expr]:
    """Singular points for t = x^k: 0, and the positive ones."""
    equation = question.equation
    t = sympy.Symbol(equation.variable)
    yield sympy.Integer(0)
    for part in (equation.b, equation.c):
        den = question.own(Atoms(t).poly((part / equation.a).den))
        others = [root for root in sympy.roots(den, t) if root != 0]
        for root in others:
            if root.is_positive is not False:
                yield root ** (1 / function_of_x(equation).exp)


def _preimages(value: Expr, root: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """The x between two points with f(k x + c) = root; for a function with a period that isn't real, of each kind one."""
    inverse = _INVERSES[value.func]
    inner = value.args[0]
    slope = inner.diff(x)
    step = inverse.real_step(slope)
    for base in inverse.values(root):
        x0 = sympy.expand((base - inner.subs(x, 0)) / slope)
        if not _is_nearly_real(x0):
            continue
        if step is None:
            yield x0
        else:
            yield from _repeated(x0, step, first, last)


def _is_nearly_real(point: Expr) -> bool:
    """Is it a number, real up to what may be rounded?"""
    return bool(point.is_number and abs(sympy.im(point).evalf(30)) <= 1e-20)


def _repeated(x0: Expr, step: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """The x0 + m step between two points, the first ones of them where there are many."""
    low = int(sympy.ceiling((first - x0) / step))
    high = int(sympy.floor((last - x0) / step))
    for m in range(low, min(high, low + _MOST_POINTS) + 1):
        yield x0 + m * step


def _rates_in_x(question: Question, value: Expr) -> list[Expr]:
    """The coefficients of y'' + B y' + C y = F in x: B = t' b/a - t''/t', C = t'^2 c/a, F = t'^2 f/a."""
    equation = question.equation
    t = sympy.Symbol(equation.variable)
    b, c, f = (Atoms(t).ratio(part / equation.a).subs(t, value) for part in (equation.b, equation.c, equation.f))
    slope = value.diff(question.x)
    return [b * slope - slope.diff(question.x) / slope, c * slope**2, f * slope**2]


def _is_analytic(rates: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """Have the coefficients limits at the point?"""
    try:
        return all(not behaviour(rate, x, Approach(point)).parts.large for rate in rates)
    except (UnknownBehaviour, NotImplementedError):
        return False


def real_basis_at(question: Question, basis: Basis, solution: Solution, start: Expr) -> Basis:
    """Solutions that are real at `start`, with integrals that begin there.

    Raises `InputError` where the points of the conditions lie on two sides of a singular point.
    """
    check_between(question, (basis.y1, basis.y2))
    x = question.x
    if question.equation.change is not None:
        return replace(basis, y1=starting_at(basis.y1, x, start), y2=starting_at(basis.y2, x, start))
    _check_one_side((basis.y1, basis.y2), question)
    y1, y2 = real_basis(solution, basis.y1, basis.y2, x, start)
    return replace(basis, y1=starting_at(y1, x, start), y2=starting_at(y2, x, start))


def real_particular_at(question: Question, basis: Basis, particular: Expr, start: Expr) -> Expr:
    """The particular solution, real at `start`.  Raises `InputError` as `real_basis_at` does."""
    check_between(question, (basis.y1, basis.y2, particular))
    if question.equation.change is not None:
        return particular
    _check_one_side((particular,), question)
    return real_particular(particular, question.equation, question.x, start)


def _check_one_side(solutions: Sequence[Expr], question: Question) -> None:
    """Raises `InputError` where roots or logarithms have arguments of both signs at the points."""
    points = [point for point in _points(question) if point.is_real]
    ordinary = [point for point in points if not is_singular(question, point)]
    sides = {_negative(solutions, question, point) for point in ordinary}
    if len(sides) > 1:
        said = ", ".join(map(str, points))
        raise InputError(f"a singular point of the equation lies between {said}: on each side the solutions are others")


def _negative(solutions: Sequence[Expr], question: Question, point: Expr) -> frozenset[Expr]:
    """The roots and logarithms in solutions whose arguments are negative at a point."""
    return frozenset().union(*(negative_arguments(y, question.x, point) for y in solutions))
