"""The real singular points of an equation: poles of b/a and c/a, and those of the right-hand side.

Those without parameters are found: of rational coefficients, of coefficients in t = f(k x + c) and in t = x^k, and of a
right-hand side with polynomials, roots of x, or waves below the line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
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
    """True for a finite pole of b/a, c/a or f/a, and where the rest of the right-hand side has no value."""
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
    """True if a polynomial in the equation's variable is zero, or has no value, at a point in the user's variable."""
    equation = question.equation
    atoms = Atoms(sympy.Symbol(equation.variable))
    at = question.own(function_of_x(equation)).subs(user_variable(equation), point)
    if at.is_Rational and polynomial.field == QQ:
        return not polynomial(Fraction(int(at.p), int(at.q)))
    value = question.own(atoms.poly(polynomial)).subs(atoms.x, at)
    return value.is_finite is False or is_zero(value)


def poles_between(question: Question, first: Expr, last: Expr) -> Iterator[Expr]:
    """The singular points between two numbers that `rational_poles` doesn't have."""
    x = question.x
    equation = question.equation
    parts = [] if equation.h is None else [equation.h]
    if equation.change is not None:
        if is_power(equation) and first < 0 < last:
            yield sympy.Integer(0)
        elif not is_power(equation) and not is_of_a_line(equation):
            raise NotImplementedError("undecided: whether a singular point lies between the points that are given")
        parts += [question.own(rate) for rate in _rates_in_x(equation, x)]
    for below in {base: None for part in parts for base in _below_the_line(part, x)}:
        for point in _zeros(below, x, first, last):
            is_between = point.is_number and first < point < last
            is_candidate = is_between and (equation.change is not None or is_singular(question, point))
            if is_candidate and not _is_analytic(parts, x, point):
                yield point


def rational_poles(question: Question) -> Iterator[Expr]:
    """The real singular points without parameters of an equation with rational coefficients."""
    equation = question.equation
    if equation.change is not None:
        return
    for den in _denominators(equation):
        for factor, _ in den.field.factor(den):
            yield from _real_roots(question.own(Atoms(question.x).poly(factor)), question.x)


def _real_roots(polynomial: Expr, x: Expr) -> list[Expr]:
    """Those of a polynomial whose coefficients are real numbers with square roots and the like; none of others."""
    if polynomial.free_symbols != {x}:
        return []
    try:
        roots = sympy.real_roots(sympy.Poly(polynomial, x, extension=True))
    except (NotImplementedError, sympy.PolynomialError):  # with an i, or with roots of polynomials without a formula
        return []
    return [*dict.fromkeys(roots)]


def _below_the_line(e: Expr, x: Expr) -> list[Expr]:
    """Functions whose zeros are singular points: bases of powers, cosines of tangents, arguments of logarithms."""
    powers = [power for power in e.atoms(sympy.Pow) if power.exp.is_Rational and power.exp < 0]
    found = [power.base for power in powers] + [f.args[0] for f in e.atoms(sympy.log)]
    found += [sympy.cos(f.args[0]) for f in e.atoms(sympy.tan, sympy.sec)]
    found += [sympy.sin(f.args[0]) for f in e.atoms(sympy.cot, sympy.csc)]
    return sorted({base for base in found if base.free_symbols == {x}}, key=str)


def _zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """Those of a polynomial in x, in f(k x + c), or in a root or power of x; none of other expressions."""
    t = sympy.Dummy()
    if e.is_polynomial(x):
        yield from _real_roots(e, x)
        return
    values = {f for f in e.atoms(*_INVERSES) if f.has(x)}
    if len(values) == 1:
        (value,) = values
        in_t = e.subs(value, t)
        slope = value.args[0].diff(x)
        if in_t.is_polynomial(t) and not in_t.has(x) and not slope.has(x):
            for root in sympy.roots(in_t, t):
                yield from _preimages(value, root, x, first, last)
        return
    powers = [power for power in e.atoms(sympy.Pow) if power.base == x and power.exp.is_number]
    if powers:  # of one power x^k = t, or of x^(1/q) = t
        k = sympy.gcd_list([1, *(power.exp for power in powers)]) if e.subs(powers[0], t).has(x) else powers[0].exp
        t = sympy.Dummy(positive=True)
        in_t = sympy.powsimp(e.subs(x, t ** (1 / k)))
        if in_t.is_polynomial(t):
            yield from (root ** (1 / k) for root in sympy.roots(in_t, t) if root.is_positive)


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


def _rates_in_x(equation: Equation, x: Expr) -> list[Expr]:
    """The coefficients of y'' + B y' + C y = F in x: B = t' b/a - t''/t', C = t'^2 c/a, F = t'^2 f/a."""
    t = sympy.Symbol(equation.variable)
    value = function_of_x(equation)
    # In factors, in which exp(x) stands alone: exp(x) - 2, and not exp(3 x) - 2 exp(2 x).
    b, c, f = (
        sympy.factor(Atoms(t).ratio(part / equation.a)).subs(t, value) for part in (equation.b, equation.c, equation.f)
    )
    slope = value.diff(x)
    return [b * slope - slope.diff(x) / slope, c * slope**2, f * slope**2]


def _is_analytic(rates: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """True if the coefficients have limits at the point."""
    return all(finite_limit(rate, x, Approach(point)) is not None for rate in rates)
