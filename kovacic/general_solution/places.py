"""Where the conditions are given, the singular points about these, and solutions that are real there.

Singular points are the poles of b/a and c/a, and those of f/a: a solution isn't determined on one side by its values on
the other.  At a singular point and at infinity, a condition is one on a limit, from the side on which the others are.

Singular points without parameters are found: of rational coefficients, of coefficients in t = f(k x + c) and in t = x^k,
and of a right-hand side with polynomials, roots of x, or waves below the line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.closed_form import cuts
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.form import pair_at
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.behaviour import Approach, have_values
from kovacic.general_solution.integrands import NUMBERS
from kovacic.general_solution.particular import right_hand_side, starting_at, turned_at
from kovacic.general_solution.question import Question
from kovacic.general_solution.steps import is_analytic, jump_place, jump_points
from kovacic.general_solution.validity import needs_of
from kovacic.general_solution.zero import is_zero
from kovacic.limits import check_time
from kovacic.reading.change_of_variable import function_of_x, is_in_power, is_of_a_line, user_variable

Expr = Any  # SymPy publishes no types
_INFINITIES = (sympy.oo, -sympy.oo)
#: Beside a point, how far zeros are looked for at first, and how many of them are looked at.
_NEAR = 8
_MOST_POINTS = 200


def given_points(question: Question) -> list[Expr]:
    """The points of the conditions, each once, in the order in which they are given."""
    return [*dict.fromkeys(point for condition in question.conditions for point in condition.points)]


@dataclass(frozen=True)
class ImpulsesInside:
    """Places of unit impulses, taken to lie between the two points of the conditions: Green's function."""

    places: tuple[Expr, ...] = ()
    low: Expr = sympy.S.Zero
    high: Expr = sympy.S.Zero

    @classmethod
    def of(cls, question: Question) -> ImpulsesInside:
        """Those for which that is open, letters or beside a letter; none without two finite points, or beside steps."""
        points = given_points(question)
        h = sympy.sympify(question.equation.h or 0)
        jumps = h.atoms(sympy.Heaviside, sympy.DiracDelta)
        is_impulse = all(isinstance(jump, sympy.DiracDelta) and len(jump.args) == 1 for jump in jumps)
        if len(points) != 2 or any(point.is_infinite for point in points) or not is_impulse:
            return cls()
        low, high = points[::-1] if (points[1] - points[0]).is_negative else points
        places = []
        for place in map(question.own, jump_points(h, question.x)):
            distances = [(place - low).is_positive, (high - place).is_positive]
            if None in distances and False not in distances and (place.is_Symbol or high.is_Symbol):
                places.append(place)
        return cls(tuple(places), low, high)

    @property
    def values(self) -> dict[Expr, Expr]:
        """Those of the steps at the two points."""
        ends = [(self.low - a, sympy.S.Zero) for a in self.places] + [(self.high - a, sympy.S.One) for a in self.places]
        return {step: value for u, value in ends for step in (sympy.Heaviside(u), sympy.Heaviside(u, 0))}

    @property
    def notices(self) -> list[str]:
        def said(place: Expr) -> str:
            low = "" if (place - self.low).is_positive else f"{self.low} < "
            high = "" if (self.high - place).is_positive else f" < {self.high}"
            return f"this holds for {low}{place}{high}"

        return [*map(said, self.places)]

    @property
    def numbers(self) -> dict[Expr, Expr]:
        """Expressions for letters with which the places lie there, for all values of the letters that are left."""
        numbers = {a: self.low + (self.high - self.low) * sympy.Rational(3, 7) for a in self.places if a.is_Symbol}
        others = [a for a in self.places if not a.is_Symbol]
        return numbers | ({self.high: sympy.Add(1, *others)} if others else {})


def limit_points(question: Question) -> dict[Expr, Approach]:
    """The points of the conditions at which these are conditions on limits, with the side.

    Raises `InputError` where the others are on both sides.
    """
    infinite, others = sympy.sift(given_points(question), lambda point: point in _INFINITIES, binary=True)
    singular = {p: Approach(p, _side(p, _points(question))) for p in others if is_singular(question, p)}
    return {point: Approach(point) for point in infinite} | singular


def _side(point: Expr, points: Sequence[Expr]) -> int:
    """1 or -1: on which side of the point the others are; 1 where that isn't known."""
    sides = {sign for other in points if (sign := sympy.sign(other - point)) in (1, -1)}
    if len(sides) > 1:
        raise _apart_error(point, [other for other in points if other != point])
    return int(next(iter(sides), 1))


def _apart_error(point: Expr, points: Sequence[Expr]) -> InputError:
    said = f"a singular point of the equation lies between {', '.join(map(str, points))}"
    return InputError(f"{said}: {point}; on each side the solutions are others")


def start_of(question: Question, limits: dict[Expr, Approach]) -> Expr:
    """An ordinary point on the side that is meant: the first one with a condition, or one between singular points."""
    ordinary = [point for point in given_points(question) if point not in limits]
    if ordinary:
        between = _poles_between(question, ordinary) if question.equation.change is None else ()
        # beyond a removable point of f/a solutions are continued from there
        return next((point for point, is_removable in between if is_removable), ordinary[0])
    poles = [*rational_poles(question)]
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
    """Raises `InputError` where a singular point lies between points of conditions or jumps.

    Solutions that are written with functions that are analytic on the whole line may be continued.
    """
    points = [point for point in _points(question) if point.is_extended_real]
    whole = sympy.Tuple(*map(question.own, solutions))
    if len(points) < 2 or (all(is_analytic(y, question.x) for y in whole) and not whole.has(sympy.Heaviside)):
        return
    for pole, is_removable in _poles_between(question, points):
        if not is_removable:
            raise _apart_error(pole, points)


def _points(question: Question) -> list[Expr]:
    """Those of conditions, and those of jumps."""
    return [*given_points(question), *jump_points(sympy.sympify(question.equation.h or 0), question.x)]


def basis_from(question: Question, basis: Basis, start: Expr) -> Basis:
    """Solutions that are real at `start`, with integrals that begin there.

    Raises `InputError` where the points of the conditions lie on two sides of a singular point.
    """
    check_between(question, (basis.y1, basis.y2))
    basis = real_at(basis, start)
    return basis.of(*(starting_at(y, question.x, start) for y in (basis.y1, basis.y2)))


def real_at(basis: Basis, point: Expr) -> Basis:
    """Two solutions that are real at the point, if such are found; else the given ones."""
    if basis.equation.change is not None:
        return basis
    solution, form = basis.solution, basis.form
    assert solution is not None
    anew = None if form is None else lambda: tuple(y.xreplace(NUMBERS) for y in pair_at(form, point, basis.own))
    given = (basis.y1, basis.y2)
    pair = cuts.real_at(given, basis.x, solution.S, solution.gauge, point, anew=anew, own=basis.own)
    return basis if pair == given else replace(basis.of(*pair), place=point)


def real_particular(question: Question, basis: Basis, particular: Expr, place: Expr) -> Expr:
    """A particular solution that is real at a place, if one is found; else the given one: log(1 - x) for log(x - 1).

    Raises `InputError` as `basis_from` does.
    """
    check_between(question, (basis.y1, basis.y2, particular))
    x, equation = question.x, question.equation
    if equation.change is not None or not place.is_real or particular.has(sympy.Integral, sympy.Heaviside):
        return particular
    return turned_at(place, particular, basis.rates, right_hand_side(equation), x, question.own)


# --------------------------------------------------------------------------------------- singular points between them


def one_sided(question: Question) -> tuple[Question, list[str]]:
    """The question on the side of a singular point on which values lie, else on the right, and what is said of it.

    This is for steps at such a point in a root or a denominator, where one formula doesn't hold on both sides: |x|^n is
    x^n for x > 0.
    """
    h, x, said = question.equation.h, question.x, []
    parts = () if h is None else h.atoms(sympy.Pow, sympy.Function) - h.atoms(sympy.Heaviside, sympy.DiracDelta)
    steps = {step for step in sympy.Tuple(*parts).atoms(sympy.Heaviside) if step.has(x)}
    points = given_points(question)
    for step in sorted(steps, key=str):
        place = jump_place(step, x)
        if place is None or place.slope.is_positive is None or not is_singular(question, place.a):
            continue
        is_left = bool(points) and (points[0] - place.a).is_negative is True
        h = h.xreplace({step: sympy.Integer(place.slope.is_positive is not is_left)})  # H(s (x - a)) on this side
        said.append(f"this holds for {x} {'<' if is_left else '>'} {place.a}: the equation is singular there")
    if not said:
        return question, []
    return replace(question, equation=replace(question.equation, h=h), given=replace(question.given, h=h)), said


def is_singular(question: Question, point: Expr) -> bool:
    """True for a finite pole of b/a or c/a, and where f/a has neither a value nor a limit."""
    equation = question.equation
    atoms = Atoms(sympy.Symbol(equation.variable))
    at = question.own(function_of_x(equation)).subs(user_variable(equation), point)
    values = (question.own(atoms.poly(den)).subs(atoms.x, at) for den in _denominators(equation, equation.h is None))
    whole = right_hand_side(equation)
    smooth = whole.xreplace(dict.fromkeys(whole.atoms(sympy.Heaviside, sympy.DiracDelta), sympy.Integer(0)))
    is_pole = any(value.is_finite is False or is_zero(value) for value in values)
    return is_pole or not have_values([smooth], question.x, point)


def _denominators(equation: Equation, with_right: bool) -> list[Poly]:
    """Those of b/a, c/a and, if it is asked for, of the rational part of f/a that aren't constant."""
    parts = (equation.b, equation.c, equation.f)[: 2 + with_right]
    return [quotient.den for part in parts if (quotient := part / equation.a).den.degree > 0]


def _poles_between(question: Question, points: Sequence[Expr]) -> Iterator[tuple[Expr, bool]]:
    """Singular points with some of the points on either side, and True for removable ones of f/a."""
    for pole in rational_poles(question):
        if {1, -1} <= {sympy.sign(point - pole) for point in points}:
            yield pole, False
    points = [point for point in points if point not in _INFINITIES]
    if len(points) < 2 or not all(point.is_number for point in points):
        return
    first, last = sympy.Min(*points), sympy.Max(*points)
    x = question.x
    equation = question.equation
    parts = [] if equation.h is None else [right_hand_side(equation)]
    if equation.change is not None:
        if not is_in_power(equation) and not is_of_a_line(equation):
            raise NotImplementedError("undecided: whether a singular point lies between the points that are given")
        if is_in_power(equation) and first < 0 < last:
            yield sympy.Integer(0), False
        a, b, c, f = map(question.own, question.coefficients)
        parts = [b / a, c / a, f / a]
    needs = {need for need in needs_of(sympy.Tuple(*parts)) if not isinstance(need, sympy.GreaterThan)}
    for zero in sorted({need.lhs for need in needs if need.free_symbols == {x}}, key=str):
        for point in _zeros(zero, x, first, last):
            if point.is_number and first < point < last:
                yield point, have_values(parts, x, point)


def rational_poles(question: Question) -> Iterator[Expr]:
    """The real singular points without parameters of an equation with rational coefficients."""
    equation = question.equation
    if equation.change is not None:
        return
    factors = (factor for den in _denominators(equation, True) for factor, _ in den.field.factor(den))
    for polynomial in (question.own(Atoms(question.x).poly(factor)) for factor in factors):
        # an i, or roots of polynomials without a formula
        with suppress(NotImplementedError, sympy.PolynomialError):
            is_numeric = polynomial.free_symbols == {question.x}
            roots = sympy.real_roots(sympy.Poly(polynomial, question.x, extension=True)) if is_numeric else ()
            yield from (root for root in dict.fromkeys(roots) if equation.h is None or is_singular(question, root))


def _zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """Those between two numbers that SymPy finds, the first ones where there are many; of complex values the real part's.

    None of an expression with several functions, other than exponentials.
    """
    functions = {f for f in e.atoms(sympy.Function) if f.has(x)}
    if len(functions) > 1 and {f.func for f in functions} != {sympy.exp}:
        return  # of sin(3 x) and cos(5 x) it thinks for minutes
    t = sympy.Dummy(real=True)
    e = e.xreplace({x: t})
    if e.has(sympy.I):
        e = e.as_real_imag()[0]
    found, width = 0, _NEAR
    while first < last and found < _MOST_POINTS:
        check_time()
        end = sympy.Min(first + width, last)
        with suppress(NotImplementedError, ValueError, TypeError):
            zeros = sympy.solveset(e, t, sympy.Interval(first, end))
            if isinstance(zeros, sympy.FiniteSet):
                yield from zeros
                found += len(zeros)
        first, width = end, 2 * width
