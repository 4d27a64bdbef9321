"""Riccati equations as a user writes them, w' = p + q w + r w^2, and their general solution with one constant.

By w = -u'/(r u) they are linear, u'' - (q + r'/r) u' + p r u = 0, and w(a) = v says that u'(a) = -r(a) v u(a).  Where r(a) = 0
that equation is singular at a, though Riccati's isn't.  1/w satisfies z' = -r - q z - p z^2, which gives w = p u/u' with

    u'' + (q - p'/p) u' + p r u = 0,        w(a) = v where u(a) : u'(a) = v : p(a),                                   (1)

regular at a where p(a) isn't 0.  Where both vanish, u and -u'/r still have values at a for all solutions u, and
C1 u1 + C2 u2 is meant for which the second is v times the first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from typing import Any, NamedTuple

import sympy
from flint import acb, arb, ctx, fmpq
from sympy.core.function import AppliedUndef

from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError, VerificationFailed
from kovacic.general_solution.check import is_finite
from kovacic.general_solution.conditions import Condition, exact
from kovacic.general_solution.substitution import size
from kovacic.general_solution.values import value_at
from kovacic.general_solution.zero import Zero, ball, is_zero, samples, when_zero
from kovacic.limits import Limits
from kovacic.reading.quotients import expression_of
from kovacic.reading.source import source_of
from kovacic.reading.symbolic import function_of

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)
#: Points at which a solution is put into the equation, and how small a residual is, by the size of its terms.
_POINTS = (acb(fmpq(23, 71), fmpq(41, 89)), acb(fmpq(-83, 97), fmpq(11, 59)))
#: The longest solution with exponentials that is tried in another form, in subexpressions.
_LONGEST = 100
_SMALL = arb(10) ** (-DIGITS // 2)
_NO_VALUE = "a part of it can't be evaluated"


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

    @property
    def reciprocal(self) -> RiccatiEquation:
        """That of 1/w, where p isn't zero."""
        return RiccatiEquation(self.function, -self.r, -self.q, -self.p)


# ------------------------------------------------------------------------------------------------------------ reading


def read_riccati(eq: Any, func: Any, var: str | None, limits: Limits) -> RiccatiEquation | None:
    """The equation, None where it isn't one of Riccati's.  Raises `InputError` for what can't be read."""
    if isinstance(eq, str):
        eq = expression_of(source_of(eq, var, limits, equation=True), limits)
    if not isinstance(eq, sympy.Basic):
        return None
    if isinstance(eq, sympy.Equality):
        eq = eq.lhs - eq.rhs
    whole = exact(eq)
    function = func if isinstance(func, AppliedUndef) else function_of(whole)
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        return None
    return _in_powers(whole, function)


def _in_powers(whole: Expr, function: Expr) -> RiccatiEquation | None:
    """From an expression that is zero: the numerator is a polynomial in w and w', linear in w'."""
    slope = sympy.Dummy()
    value = sympy.Dummy()
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


@dataclass(frozen=True)
class _LinearSolution:
    """u(x), of which these are the constants that are free, and what is to be said beside."""

    u: Expr
    constants: tuple[Expr, ...]
    notices: list[str]


def solved(
    equation: RiccatiEquation, conditions: Sequence[Condition], linear_solution: Callable[..., tuple[Expr, list[str]]]
) -> tuple[Expr, list[str]]:
    """w(x) = ..., checked, and what is to be said beside; `linear_solution` is `dsolve` for the linear equation.

    Raises `NotImplementedError` for a value at a point where neither linear equation is known to be regular.
    """
    value = _value_of(conditions)
    is_inverted = _is_inverted(equation, value)
    solved_for = equation
    if is_inverted:
        solved_for = equation.reciprocal
    found = _solved_linear(equation, solved_for, value, linear_solution)
    rate = _rate_of(found.u, found.constants, equation.x)
    w = sympy.Add(*(_with_sign_before(-term / solved_for.r) for term in sympy.Add.make_args(rate)))
    if is_inverted:
        w = 1 / w
    w = _in_short(w.xreplace(dict.fromkeys(found.constants, _name_of_constant(equation))), equation.x)
    unchecked = _check(equation, w, conditions)
    return sympy.Eq(equation.function, w, evaluate=False), found.notices + unchecked


def _solved_linear(
    equation: RiccatiEquation,
    solved_for: RiccatiEquation,
    value: RiccatiValue | None,
    linear_solution: Callable[..., tuple[Expr, list[str]]],
) -> _LinearSolution:
    """For a value at an ordinary point the solution with values of u and u'; else all of them, or those through the value."""
    linear, u = solved_for.linear
    if value is not None and _is_unit(solved_for.r, equation.x, value.point):
        start = _start(equation, u, value, is_inverted=solved_for is not equation)
        found, notices = linear_solution(linear, u, ics=start)
        return _LinearSolution(found.rhs, (), notices)
    found, notices = linear_solution(linear, u, ics={})
    solution, constants = _with_own_constants(found.rhs, linear)
    if value is not None:
        solution = _through(solution, constants, equation, value)
    return _LinearSolution(solution, constants, notices)


def _with_own_constants(solution: Expr, linear: Expr) -> tuple[Expr, tuple[Expr, ...]]:
    """With letters of their own for C1 and C2, which may be symbols of r, or of the value, too."""
    symbols = sorted(solution.free_symbols - linear.free_symbols, key=str)
    letters = {symbol: sympy.Dummy() for symbol in symbols}
    return solution.xreplace(letters), tuple(letters.values())


def _is_inverted(equation: RiccatiEquation, value: RiccatiValue | None) -> bool:
    """Is it the linear equation for 1/w, (1), that is solved?  Where only that is regular, or has the simpler coefficients."""
    x = equation.x
    if value is None:
        is_constant = equation.p != 0 and not equation.p.has(x)
        return is_constant and equation.r.has(x)
    return not _is_unit(equation.r, x, value.point) and _is_unit(equation.p, x, value.point)


def _is_unit(coefficient: Expr, x: Expr, point: Expr) -> bool:
    """Has it a value at the point, and not zero?"""
    found = coefficient.subs(x, point)
    return is_finite(found) and when_zero(found) is not Zero.ALWAYS


def _start(equation: RiccatiEquation, u: Expr, value: RiccatiValue, *, is_inverted: bool) -> dict[Expr, Expr]:
    """The values of u and u' for w(a) = v."""
    here = {equation.x: value.point}
    u_there = _ONE
    slope_there = -(equation.r * value.v).subs(here)
    if is_inverted:
        u_there = value.v
        slope_there = equation.p.subs(here)
    return {u.subs(here): u_there, u.diff().subs(here): slope_there}


def _through(u: Expr, constants: Sequence[Expr], equation: RiccatiEquation, value: RiccatiValue) -> Expr:
    """The solutions among C1 u1 + C2 u2 for which -u'/(r u) is v at a: one, or all.

    Raises `NotImplementedError` where u1, u2, -u1'/r or -u2'/r has no value there that is found.
    """
    basis = [u.diff(constant) for constant in constants]
    misses = [_miss(y, equation, value) for y in basis]
    if all(is_zero(miss) for miss in misses):
        return u
    first, second = misses
    return second * basis[0] - first * basis[1]


def _miss(y: Expr, equation: RiccatiEquation, value: RiccatiValue) -> Expr:
    """-y'/r - v y at a."""
    x = equation.x
    return value_at(-y.diff(x) / equation.r, x, value.point) - value.v * value_at(y, x, value.point)


class RiccatiValue(NamedTuple):
    """w(point) = v."""

    point: Expr
    v: Expr


def _value_of(conditions: Sequence[Condition]) -> RiccatiValue | None:
    """The value that is given.  Raises `InputError` for other conditions, and for more than one."""
    if not conditions:
        return None
    condition = conditions[0]
    is_one = len(conditions) == 1 and condition.is_value
    if not is_one or condition.terms[0].order:
        raise InputError("a Riccati equation has one value, at one point", hint='write "w(0)=1"')
    assert condition.value is not None
    if condition.points[0] in (sympy.oo, -sympy.oo):
        raise InputError(f"{condition.text}: a value determines a solution at a finite point")
    return RiccatiValue(condition.points[0], condition.value)


def _name_of_constant(equation: RiccatiEquation) -> Expr:
    """C1, or the next of these names that isn't in the equation."""
    own = equation.p.free_symbols | equation.q.free_symbols | equation.r.free_symbols
    return next(sympy.numbered_symbols("C", start=1, exclude=[sympy.Symbol(symbol.name) for symbol in own]))


def _in_short(w: Expr, x: Expr) -> Expr:
    """Over one denominator, where it is rational; with exponentials, where that is shorter."""
    if w.is_rational_function(x):
        return sympy.cancel(w)
    functions = {f.func for f in w.atoms(sympy.Function)}
    if functions <= {sympy.exp} and size(w) <= _LONGEST:
        return min((w, sympy.cancel(w)), key=size)
    return w


def _rate_of(u: Expr, constants: Sequence[Expr], x: Expr) -> Expr:
    """u'/u, where of the constants of u only their quotient matters."""
    if u.has(*constants):
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
    if rate.is_rational_function(x):
        return sympy.cancel(rate)
    return sympy.powsimp(sympy.factor_terms(rate))


def _with_sign_before(e: Expr) -> Expr:
    """-(-a - b)/c as (a + b)/c: the sign of a sum with more negative terms than others stands before the product."""
    factors = []
    sign = 1
    for factor in sympy.Mul.make_args(e):
        if _is_mostly_negative(factor):
            factors.append(-factor)
            sign = -sign
        else:
            factors.append(factor)
    return sympy.Mul(sign, *factors)


def _is_mostly_negative(factor: Expr) -> bool:
    """Is it a sum with more negative terms than others?"""
    if not factor.is_Add:
        return False
    negative = [term for term in factor.args if term.could_extract_minus_sign()]
    return 2 * len(negative) > len(factor.args)


def _check(equation: RiccatiEquation, w: Expr, conditions: Sequence[Condition]) -> list[str]:
    """What couldn't be checked, in a sentence each.  Raises `VerificationFailed` where w is seen not to be a solution."""
    value = _value_of(conditions)
    known = [w, equation.p, equation.q, equation.r, *(value or ())]
    symbols = set().union(*(e.free_symbols for e in known)) - {equation.x}
    sample = next(islice(samples(symbols), 1, None))
    is_missed: bool | None = False
    with ctx.workdps(2 * DIGITS):
        is_wrong = _is_wrong(equation, w, sample)
        if value is not None:
            is_missed = _is_missed(equation, w, sample, value)
    if is_wrong or is_missed:
        raise VerificationFailed(f"{w} isn't a solution of a Riccati equation; please report {equation}")
    unchecked = []
    if is_wrong is None:
        unchecked.append(f"the answer wasn't put into the equation, numerically: {_NO_VALUE}")
    if is_missed is None:
        unchecked.append(f"the answer wasn't put into {conditions[0].text}, numerically: {_NO_VALUE}")
    return unchecked


def _is_missed(equation: RiccatiEquation, w: Expr, sample: dict[Expr, Expr], wanted: RiccatiValue) -> bool | None:
    """Is w(a) seen not to be the wanted value?  None where it can't be evaluated.

    Raises `InputError` where a is a singular point of the equation, so that no solution needs to have the value.
    """
    try:
        reached = value_at(w, equation.x, wanted.point)
    except NotImplementedError:
        return None
    left = ball(reached.xreplace(sample))
    right = ball(wanted.v.xreplace(sample))
    if left is None or right is None or not left.is_finite():
        return None
    is_missed = bool(abs(left - right) > _SMALL)
    if is_missed and not _is_regular(equation, wanted.point):
        raise InputError(f"there is no solution with this value at {wanted.point}, a singular point of the equation")
    return is_missed


def _is_regular(equation: RiccatiEquation, point: Expr) -> bool:
    """Are the coefficients finite at the point?"""
    values = [e.subs(equation.x, point) for e in (equation.p, equation.q, equation.r)]
    return all(map(is_finite, values))


def _is_wrong(equation: RiccatiEquation, w: Expr, sample: dict[Expr, Expr]) -> bool | None:
    """Is the residual seen not to be zero at a point?  None where it can't be evaluated at any."""
    found = [_is_wrong_at(equation, w, sample, point) for point in _POINTS]
    if True in found:
        return True
    if False in found:
        return False
    return None


def _is_wrong_at(equation: RiccatiEquation, w: Expr, sample: dict[Expr, Expr], point: Any) -> bool | None:
    """Is the residual seen not to be zero?  None where the functions can't be evaluated."""
    with suppress(NotImplementedError, ZeroDivisionError, AttributeError, ValueError):
        value, slope, _ = jet(w.xreplace(sample), equation.x, point)
        p, q, r = (jet(e.xreplace(sample), equation.x, point)[0] for e in (equation.p, equation.q, equation.r))
        terms = [slope, -p, -q * value, -r * value**2]
        return bool(abs(sum(terms)) > _SMALL * sum(map(abs, terms), arb(0)))
    return None
