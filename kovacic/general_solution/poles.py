"""The real singular points of an equation: poles of b/a and c/a, and those of the right-hand side.

Those without parameters are found: of rational coefficients, of coefficients in t = f(k x + c) and in t = x^k, and of a
right-hand side with polynomials, roots of x, or waves below the line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.equation import Equation
from kovacic.general_solution.behaviour import Approach, finite_limit
from kovacic.general_solution.question import Question
from kovacic.general_solution.substitution import finite_value
from kovacic.general_solution.zero import is_zero
from kovacic.reading.change_of_variable import function_of_x, is_of_a_line, is_power, user_variable

Expr = Any  # SymPy publishes no types


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
    sympy.exp: _Inverse(lambda value: [] if value == 0 else [sympy.log(value)], 2 * sympy.pi * sympy.I),
    sympy.cosh: _Inverse(lambda value: [sympy.acosh(value), -sympy.acosh(value)]),
    sympy.sinh: _Inverse(lambda value: [sympy.asinh(value)]),
    sympy.cos: _Inverse(lambda value: [sympy.acos(value), -sympy.acos(value)], 2 * sympy.pi),
    sympy.sin: _Inverse(lambda value: [sympy.asin(value), sympy.pi - sympy.asin(value)], 2 * sympy.pi),
    sympy.tan: _Inverse(lambda value: [sympy.atan(value)], sympy.pi),
}
#: The most singular points of an interval that are looked at.
_MOST_POINTS = 200


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


def poles_between(question: Question, first: Expr, last: Expr) -> Iterator[Expr]:
    """The singular points without parameters between two points."""
    of_coefficients = [*rational_poles(question), *_changed_poles(question, first, last)]
    for pole in [*of_coefficients, *_poles_on_the_right(question, first, last)]:
        if pole.is_number and first < pole < last:
            yield pole


def rational_poles(question: Question) -> Iterator[Expr]:
    """The real singular points of an equation with rational coefficients without parameters."""
    equation = question.equation
    if equation.change is not None:
        return
    for den in _denominators(equation):
        yield from _real_roots(question.own(Atoms(question.x).poly(den)), question.x)


def _real_roots(polynomial: Expr, x: Expr) -> list[Expr]:
    """Those of a polynomial whose coefficients are real numbers with square roots and the like; none of others."""
    if polynomial.free_symbols != {x}:
        return []
    try:
        roots = sympy.real_roots(sympy.Poly(polynomial, x, extension=True))
    except (NotImplementedError, sympy.PolynomialError):  # with an i, or with roots of polynomials without a formula
        return []
    return [*dict.fromkeys(roots)]


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


def _poles_on_the_right(question: Question, first: Expr, last: Expr) -> Iterator[Expr]:
    """The points between two where the right-hand side has no value, of those where a denominator or a wave below is zero."""
    h = question.equation.h
    if h is None:
        return
    x = question.x
    for below in _below_the_line(h, x):
        for point in _zeros(below, x, first, last):
            is_candidate = first < point < last and is_singular(question, point)
            if is_candidate and not _is_analytic([h], x, point):
                yield point


def _below_the_line(h: Expr, x: Expr) -> list[Expr]:
    """What poles of an expression are zeros of: bases of powers, cosines below tangents and sines below cotangents."""
    powers = [power for power in h.atoms(sympy.Pow) if power.exp.is_Integer and power.exp < 0]
    found = [power.base for power in powers]
    found += [sympy.cos(f.args[0]) for f in h.atoms(sympy.tan, sympy.sec)]
    found += [sympy.sin(f.args[0]) for f in h.atoms(sympy.cot, sympy.csc)]
    return sorted({base for base in found if base.free_symbols == {x}}, key=str)


def _zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """Those of a polynomial, of one in a root of x, or of a wave of a line; none of other expressions."""
    if e.func in (sympy.sin, sympy.cos) and _is_line(e.args[0], x):
        yield from _preimages(e, sympy.Integer(0), x, first, last)
        return
    if e.is_polynomial(x):
        yield from _real_roots(e, x)
        return
    s = sympy.Dummy(positive=True)
    q = lcm(*(int(power.exp.q) for power in e.atoms(sympy.Pow) if power.base == x and power.exp.is_Rational))
    in_root = e.subs(x, s**q)
    if in_root.is_polynomial(s):
        yield from (root**q for root in _real_roots(in_root, s) if root.is_positive)


def _is_line(e: Expr, x: Expr) -> bool:
    slope = e.diff(x)
    return not slope.has(x) and slope != 0


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
    for polynomial in _denominators(equation):
        roots = sympy.roots(question.own(Atoms(t).poly(polynomial)), t)
        for root in roots.keys() - {0}:
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
        is_nearly_real = x0.is_number and abs(sympy.im(x0).evalf(30)) <= 1e-20  # up to what may be rounded
        if not is_nearly_real:
            continue
        if step is None:
            yield x0
        else:
            yield from _repeated(x0, step, first, last)


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
    return all(finite_limit(rate, x, Approach(point)) is not None for rate in rates)
