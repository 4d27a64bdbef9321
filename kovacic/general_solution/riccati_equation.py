"""Riccati equations as a user writes them, w' = p + q w + r w^2, and their general solution with one constant.

By w = -u'/(r u) they are linear, u'' - (q + r'/r) u' + p r u = 0, and w(a) = v says that u'(a) = -r(a) v u(a).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from typing import Any

import sympy
from flint import acb, arb, ctx, fmpq
from sympy.core.function import AppliedUndef

from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError, VerificationFailed
from kovacic.general_solution.conditions import Condition, exact
from kovacic.general_solution.zero import ball, samples
from kovacic.limits import Limits
from kovacic.reading.quotients import expression_of
from kovacic.reading.source import source_of
from kovacic.reading.symbolic import function_of

Expr = Any  # SymPy publishes no types
_ZERO, _ONE = sympy.Integer(0), sympy.Integer(1)
#: Points at which a solution is put into the equation, and how small a residual is, by the size of its terms.
_POINTS = (acb(fmpq(23, 71), fmpq(41, 89)), acb(fmpq(-83, 97), fmpq(11, 59)))
_SMALL = arb(10) ** (-DIGITS // 2)


@dataclass(frozen=True)
class RiccatiEquation:
    """w' = p + q w + r w^2 with r not zero; `function` is w(x)."""

    function: Expr
    p: Expr
    q: Expr
    r: Expr

    @property
    def x(self) -> Expr:
        return self.function.args[0]

    @property
    def linear(self) -> tuple[Expr, Expr]:
        """The linear equation, and its unknown function."""
        u = sympy.Function(f"{self.function.func}_")(self.x)
        slope = sympy.cancel(self.q + self.r.diff(self.x) / self.r)
        return sympy.Eq(u.diff(self.x, 2) - slope * u.diff(self.x) + sympy.cancel(self.p * self.r) * u, 0), u


# ------------------------------------------------------------------------------------------------------------ reading


def read_riccati(eq: Any, func: Any, var: str | None, limits: Limits) -> RiccatiEquation | None:
    """The equation, None where it isn't one of Riccati's.  Raises `InputError` for what can't be read."""
    if isinstance(eq, str):
        eq = expression_of(source_of(eq, var, limits, equation=True), limits)
    if not isinstance(eq, sympy.Basic):
        return None
    whole = exact(eq.lhs - eq.rhs if isinstance(eq, sympy.Equality) else eq)
    function = func if isinstance(func, AppliedUndef) else function_of(whole)
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        return None
    return _in_powers(whole, function)


def _in_powers(whole: Expr, function: Expr) -> RiccatiEquation | None:
    """From an expression that is zero: the numerator is a polynomial in w and w', linear in w'."""
    slope, value = sympy.Dummy(), sympy.Dummy()
    plain = whole.subs(function.diff(function.args[0]), slope).subs(function, value)
    if plain.atoms(sympy.Derivative) or plain.atoms(AppliedUndef):
        return None
    numerator = sympy.numer(sympy.together(plain))
    if not numerator.is_polynomial(slope, value):
        return None
    terms = dict(sympy.Poly(numerator, value, slope).terms())
    leading = terms.pop((0, 1), _ZERO)
    p, q, r = (-terms.pop((power, 0), _ZERO) for power in range(3))
    if terms or leading == 0 or r == 0:
        return None
    return RiccatiEquation(function, *(sympy.cancel(part / leading) for part in (p, q, r)))


# ------------------------------------------------------------------------------------------------------------ solving


def solved(
    equation: RiccatiEquation, conditions: Sequence[Condition], linear_solution: Callable[..., tuple[Expr, list[str]]]
) -> tuple[Expr, list[str]]:
    """w(x) = ..., checked, and what is to be said beside; `linear_solution` is `dsolve` for the linear equation."""
    linear, u = equation.linear
    value = _value_of(conditions)
    ics: dict[Expr, Expr] = {}
    if value is not None:
        point, v = value
        ics = {
            u.subs(equation.x, point): _ONE,
            u.diff().subs(equation.x, point): -(equation.r * v).subs(equation.x, point),
        }
    found, notices = linear_solution(linear, u, ics=ics)
    rate = _rate_of(found.rhs, linear, equation.x)
    w = sympy.Add(*(-term / equation.r for term in sympy.Add.make_args(rate)))
    w = sympy.cancel(w) if w.is_rational_function(equation.x) else w
    _check(equation, w, value)
    return sympy.Eq(equation.function, w, evaluate=False), notices


def _value_of(conditions: Sequence[Condition]) -> tuple[Expr, Expr] | None:
    """(a, v) for w(a) = v."""
    if not conditions:
        return None
    condition = conditions[0]
    if len(conditions) > 1 or not condition.is_value or condition.terms[0].order:
        raise InputError("a Riccati equation has one value, at one point", hint='write "w(0)=1"')
    assert condition.value is not None
    return condition.points[0], condition.value


def _rate_of(u: Expr, linear: Expr, x: Expr) -> Expr:
    """u'/u, where of the constants of u only their quotient matters."""
    constants = sorted(u.free_symbols - linear.free_symbols, key=str)
    if len(constants) == 2:
        c1, c2 = constants
        u = _wave(u.diff(c1), u.diff(c2), c1) or u.subs(c2, 1)
    return sympy.Add(*(_rate(factor, x) for factor in sympy.Mul.make_args(u)))


def _wave(u1: Expr, u2: Expr, constant: Expr) -> Expr | None:
    """G cos(z + C) for G cos(z) and G sin(z)."""
    for wave in u1.atoms(sympy.cos):
        if u1 / wave == u2 / sympy.sin(*wave.args):
            return u1 / wave * sympy.cos(wave.args[0] + constant)
    return None


def _rate(factor: Expr, x: Expr) -> Expr:
    """The logarithmic derivative, in a short form."""
    if isinstance(factor, sympy.cos):
        return -factor.args[0].diff(x) * sympy.tan(factor.args[0])
    rate = factor.diff(x) / factor
    return sympy.cancel(rate) if rate.is_rational_function(x) else sympy.powsimp(sympy.factor_terms(rate))


def _check(equation: RiccatiEquation, w: Expr, value: tuple[Expr, Expr] | None) -> None:
    """Raises `VerificationFailed` where w is seen not to satisfy the equation or its value."""
    at_point = [] if value is None else [w.subs(equation.x, value[0]), value[1]]
    known = [w, equation.p, equation.q, equation.r]
    symbols = {s for e in (*known, *at_point) for s in e.free_symbols} - {equation.x}
    sample = next(islice(samples(symbols), 1, None))
    w_there, p, q, r = (e.xreplace(sample) for e in known)
    with ctx.workdps(2 * DIGITS):
        is_wrong = any(_is_wrong(w_there, (p, q, r), equation.x, point) for point in _POINTS)
        if at_point:
            left, right = (ball(e.xreplace(sample)) for e in at_point)
            is_wrong = is_wrong or (left is not None and right is not None and bool(abs(left - right) > _SMALL))
    if is_wrong:
        raise VerificationFailed(f"{w} isn't a solution of a Riccati equation; please report {equation}")


def _is_wrong(w: Expr, coefficients: tuple[Expr, Expr, Expr], x: Expr, point: Any) -> bool:
    """Is the residual seen not to be zero?  False where the functions can't be evaluated."""
    with suppress(NotImplementedError, ZeroDivisionError, AttributeError, ValueError):
        value, slope, _ = jet(w, x, point)
        p, q, r = (jet(e, x, point)[0] for e in coefficients)
        terms = [slope, -p, -q * value, -r * value**2]
        return bool(abs(sum(terms)) > _SMALL * sum(map(abs, terms), arb(0)))
    return False
