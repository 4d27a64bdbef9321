"""Transforms solutions and integrals from t = t(x) back to the user's x.

Everything is computed in t (`reading.exponentials` has why); here results are written in x, where functions that are inverse to
each other cancel, and roots of t + 1 and t - 1 join.  Every function serves where the equation has no change, too: there t = x.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy
from sympy.simplify.fu import TR2, TR8

from kovacic.equation import Equation
from kovacic.reading.change_of_variable import function_of_x, is_in_power, user_variable


def in_x(equation: Equation, expression: Any) -> Any:
    """A SymPy expression in t as one in x; exp(2*x) + 1 becomes 2*exp(x)*cosh(x), powers of exponentials exponentials."""
    if equation.change is None:
        return expression
    own = sympy.Symbol(equation.variable)
    x = user_variable(equation)
    t = function_of_x(equation)
    slope = t.diff(x).subs(t**2, sympy.cos(t.args[0]) ** -2 - 1) if t.func is sympy.tan else t.diff(x)
    integrals = {}  # int f(t(x)) t'(x) dx for int f(t) dt
    for integral in expression.atoms(sympy.Integral):
        if integral.limits == (sympy.Tuple(own),):
            inner = sympy.powsimp(in_x(equation, integral.function) * slope, combine="exp")
            c, integrand = inner.as_independent(x, as_Add=False)
            integrals[integral] = c * sympy.Integral(integrand, x)
    with_integrals = expression.xreplace(integrals)
    if is_in_power(equation):
        return _in_powers_of_x(with_integrals, own, t.exp, x)
    result = _continued(with_integrals.xreplace({own: t}), t)
    if t.func in _SINES:  # roots as powers that join where t is 1 or -1: t + 1 = 2 t(w/2)^2, t - 1 = 2 sign s(w/2)^2
        half = t.args[0] / 2
        s, sign = _SINES[t.func]
        halves = {t + 1: (2, t.func(half)), t - 1: (2 * sign, s(half)), 1 - t: (-2 * sign, s(half))}
        roots = [e for e in result.atoms(sympy.Pow) if e.base in halves and not e.exp.is_Integer]
        pairs = ((e, *halves[e.base]) for e in roots)
        return result.xreplace({e: sympy.Integer(c) ** e.exp * f ** (2 * e.exp) for e, c, f in pairs})
    return _with_joined_powers(result, x) if t.func is sympy.exp else result


#: For t(w): the inverse function of t, a polynomial q(t), and the function s(w) with q(t) = s^2 for w between 0 and pi/2.
#: Both sides are analytic, so that what holds there for solutions holds wherever they are continued.
_ROOTS_OF_SQUARES: dict[Any, Callable[[Any, Any], tuple[Any, Any, Any]]] = {
    sympy.sin: lambda t, w: (sympy.asin, 1 - t**2, sympy.cos(w)),
    sympy.cos: lambda t, w: (sympy.acos, 1 - t**2, sympy.sin(w)),
    sympy.tan: lambda t, w: (sympy.atan, 1 + t**2, 1 / sympy.cos(w)),
    sympy.sinh: lambda t, w: (sympy.asinh, 1 + t**2, sympy.cosh(w)),
    sympy.cosh: lambda t, w: (sympy.acosh, t**2 - 1, sympy.sinh(w)),
}


def _continued(expression: Any, t: Any) -> Any:
    """With x for asin(sin(x)) and cos(x) for sqrt(1 - sin(x)^2), the analytic continuations, which SymPy's branches aren't."""
    if t.func not in _ROOTS_OF_SQUARES:
        return expression
    w = t.args[0]
    inverse, square, s = _ROOTS_OF_SQUARES[t.func](t, w)
    is_sine = t.func in (sympy.sin, sympy.cos)
    known = {inverse(t, evaluate=False): w}
    if is_sine:  # asin(cos(w)) = acos(sin(w)) = pi/2 - w
        other = sympy.acos if inverse is sympy.asin else sympy.asin
        known[other(t, evaluate=False)] = sympy.pi / 2 - w
    expression = expression.xreplace(known)
    for base, root in ((square, s), (-square, sympy.I * s)):
        powers = {e for e in expression.atoms(sympy.Pow) if e.base == base and (2 * e.exp).is_Integer}
        expression = expression.xreplace({e: root ** (2 * e.exp) for e in powers})
    if t.func is sympy.tan:  # sin(w) for cos(w) tan(w), and sin(2 w)/2 for sin(w) cos(w)
        expression = expression.replace(
            lambda e: e.is_Mul and e.has(t), lambda e: min(TR8(TR2(e)), TR2(e), e, key=sympy.count_ops)
        )
    # cos(w) +- i sin(w) = exp(+-i w), and sin(w) +- i cos(w) = +-i exp(-+i w).  The constant is left out: a solution stays one
    # where the logarithm of t +- i s, which isn't algebraic in t, is continued with another constant.
    for i in (sympy.I, -sympy.I) if is_sine else ():
        angle = i * w if t.func is sympy.cos else -i * w
        base = t + i * s
        powers = {e for e in expression.atoms(sympy.Pow) if e.base == base and not e.exp.is_Integer}
        expression = expression.xreplace({e: sympy.exp(e.exp * angle) for e in powers} | {sympy.log(base): angle})
    return expression


def solution_in_x(equation: Equation, y: Any) -> Any:
    """A solution in t as one in x, without a constant factor that is never zero."""
    if equation.change is None:
        return y
    result = in_x(equation, y)
    constant, rest = result.as_independent(user_variable(equation), as_Add=False)
    kept = sympy.Mul(*(f for f in sympy.Mul.make_args(constant) if not (f.is_number or f.as_base_exp()[0].is_number)))
    return kept * rest


def _in_powers_of_x(expression: Any, own: Any, k: Any, x: Any) -> Any:
    """Substitutes x^k for a variable by way of exp(k s), s = log(x)."""
    s = sympy.Dummy("s")
    joined = _with_joined_powers(expression.xreplace({own: sympy.exp(k * s)}), s)
    in_powers = joined.replace(lambda e: e.func is sympy.exp, lambda e: _as_power(e.exp, s, x))
    found = in_powers.xreplace({s: sympy.log(x)})
    shorter = {p: x ** sympy.expand(sympy.cancel(p.exp)) for p in found.atoms(sympy.Pow) if p.base == x}
    return with_roots_of_factors(found.xreplace(shorter), x)


def _as_power(exponent: Any, s: Any, x: Any) -> Any:
    """exp(c s + r) = x^c exp(r) with s = log(x)."""
    terms = sympy.Add.make_args(sympy.expand(exponent))
    linear = sympy.Add(*(term for term in terms if not sympy.cancel(term / s).has(s)))
    return x ** sympy.cancel(linear / s) * sympy.exp(sympy.Add(*terms) - linear)


def with_roots_of_factors(expression: Any, x: Any) -> Any:
    """sqrt(a)/m for sqrt(a/m^2), where x isn't in it.

    Either sign of a root gives solutions, if it is the same everywhere: so in what belongs to a solution, too.
    """
    forced: dict[Any, Any] = {}
    for power in expression.atoms(sympy.Pow):
        is_root = power.exp.is_Rational and not power.exp.is_Integer
        if is_root and not power.has(x):
            factored = sympy.factor(power.base)
            sums = sympy.Mul(*(f for f in sympy.Mul.make_args(factored) if f.is_Add))
            if sums != 1 and factored.as_coeff_Mul()[0] < 0:  # sqrt(1 - 4*b)/n, and no i
                factored = sympy.Mul(-factored / sums, sympy.expand(-sums))
            forced[power] = sympy.powdenest(sympy.expand_power_base(factored**power.exp, force=True), force=True)
    return expression.xreplace(forced)


def _with_joined_powers(expression: Any, x: Any) -> Any:
    """One exponential function in each product, hyperbolic functions for exp(k x) + 1, no logarithm of an exponential."""

    rules: list[tuple[Callable[[Any], bool], Callable[[Any], Any]]] = [
        (lambda e: e.func is sympy.log and e.args[0].func is sympy.exp, lambda e: e.args[0].exp),
        (
            lambda e: (
                e.func is sympy.atan and e.args[0].func is sympy.exp and not (e.args[0].exp / sympy.I).has(sympy.I)
            ),
            _atan_of_wave,
        ),
        # exponentials of waves
        (
            lambda e: e.func is sympy.exp and any(inner.has(sympy.I) for inner in e.args[0].atoms(sympy.exp)),
            lambda e: sympy.exp(sympy.expand(e.args[0].rewrite(sympy.cos))),
        ),
        (
            lambda e: e.is_Add and len(e.args) == 2 and e.args[0] in (1, -1) and e.args[1].func is sympy.exp,
            _by_half_angle,
        ),
        (
            lambda e: e.is_Pow and e.base.is_Mul and e.base.has(x),
            lambda e: sympy.expand_power_base(e, force=True, deep=False),
        ),
        (lambda e: e.is_Pow and e.base.func is sympy.exp, lambda e: sympy.exp(e.base.exp * e.exp)),
    ]
    for applies, image in rules:
        expression = expression.replace(applies, image)
    return sympy.powsimp(expression, combine="exp")


#: The function s with t - 1 = 2 sign s(w/2)^2 for t = cos(w) or cosh(w), and the sign.
_SINES = {sympy.cos: (sympy.sin, -1), sympy.cosh: (sympy.sinh, 1)}


def _atan_of_wave(e: Any) -> Any:
    """atan(exp(i w)) = (i/4) log((1 + sin w)/(1 - sin w)) + pi/4, without the constant: a solution stays one."""
    sine = sympy.sin(e.args[0].exp / sympy.I)
    return sympy.I / 4 * sympy.log((1 + sine) / (1 - sine))


def _by_half_angle(e: Any) -> Any:
    """exp(w) + 1 = 2 exp(w/2) cosh(w/2), and exp(w) - 1 with sinh."""
    number, exponential = e.args
    half = exponential.exp / 2
    return 2 * sympy.exp(half) * (sympy.cosh(half) if number == 1 else sympy.sinh(half))
