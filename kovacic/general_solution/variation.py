"""Variation of parameters: y = -y1 int y2 f/(a W) dx + y2 int y1 f/(a W) dx,  W = y1 y2' - y1' y2.

SymPy's simplification and integration can't be interrupted, so that they work in a process that can.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy
from sympy import cos, cot, csc, expand, powsimp, sec, sin, tan

from kovacic.algebra.apart import last_of

#: The largest expression (in operations) that is handed to SymPy's general simplification.
_SIMPLIFIED = 150
#: Seconds for the integrals of one equation, at most.
SECONDS = 20.0
#: C1 with C2 and C1 C2' - C1' C2.
_PAIRS: dict[Any, tuple[Any, Any]] = {
    sympy.airyai: (sympy.airybi, lambda z: 1 / sympy.pi),
    sympy.besselj: (sympy.bessely, lambda z: 2 / (sympy.pi * z)),
    sympy.besseli: (sympy.besselk, lambda z: -1 / z),
    sympy.jn: (sympy.yn, lambda z: z**-2),
}


def with_integrals(y1: Any, y2: Any, right: Any, x: Any, start: Any, seconds: float) -> Any:
    """A solution of y'' + ... = right; integrals that aren't done (in time) stay, and begin at `start` unless it is None."""
    stages = last_of(_stages, y1, y2, right, x, start, seconds=min(seconds, SECONDS))
    if stages is not None:
        return stages
    wronskian = special_wronskian(y1, y2, x) or y1 * y2.diff(x) - y1.diff(x) * y2
    first, second = (_open(y * right / wronskian, x, start) for y in (y2, y1))
    return y2 * second - y1 * first


def _stages(y1: Any, y2: Any, right: Any, x: Any, start: Any) -> Iterator[Any]:
    """The solution as far as it is known, better every time."""
    wronskian = _wronskian(y1, y2, x)
    integrands = [simplified(y * right / wronskian) for y in (y2, y1)]
    first, second = (_open(integrand, x, start) for integrand in integrands)
    yield y2 * second - y1 * first
    first = _integral(integrands[0], x, start)
    yield y2 * second - y1 * first
    second = _integral(integrands[1], x, start)
    result = y2 * second - y1 * first
    yield result
    if not result.has(sympy.Integral):
        yield simplified(expand(result))


def _wronskian(y1: Any, y2: Any, x: Any) -> Any:
    """y1 y2' - y1' y2, simplified: over the field of the functions that occur, and by trigonometry where that's needed."""
    if (known := special_wronskian(y1, y2, x)) is not None:
        return known
    value = expand(y1 * y2.diff(x) - y1.diff(x) * y2)
    if value.has(sin, cos):
        value = sympy.trigsimp(value)
    if value.has(sympy.log, sympy.erf, sympy.Integral):
        value = sympy.cancel(sympy.together(value))
    return simplified(value)


def special_wronskian(y1: Any, y2: Any, x: Any) -> Any | None:
    """y1 y2' - y1' y2 for pairs P C1(z), P C2(z) of Airy or Bessel functions: P^2 z' (C1 C2' - C1' C2)(z); None for others.

    Reference: DLMF 9.2.7, 10.5.2, 10.28.2, 10.50.1.

    >>> x = sympy.Symbol("x")
    >>> print(special_wronskian(x * sympy.besselj(0, x**2), x * sympy.bessely(0, x**2), x))
    4*x/pi
    """
    found = [f for f in sympy.sympify(y1, strict=True).atoms(*_PAIRS) if f.has(x)]
    if len(found) != 1:
        return None
    (function,) = found
    partner, value = _PAIRS[function.func]
    P, z = y1 / function, function.args[-1]
    if P.has(*_PAIRS) or y2 / partner(*function.args) != P:
        return None
    W = P**2 * z.diff(x) * value(z)
    return sympy.cancel(W) if W.is_rational_function(x) else W


def simplified(expression: Any) -> Any:
    """Simplified, if it isn't long."""
    return sympy.simplify(expression) if expression.count_ops() < _SIMPLIFIED else expression


def _open(integrand: Any, x: Any, start: Any) -> Any:
    """The unevaluated integral, from `start` on with a variable that doesn't occur."""
    if start is None:
        return sympy.Integral(integrand, x)
    names = {symbol.name for symbol in integrand.free_symbols | start.free_symbols}
    s = next(sympy.Symbol(name) for name in ("s", "t", "u", *(f"s{k}" for k in range(99))) if name not in names)
    return sympy.Integral(integrand.subs(x, s), (s, start, x))


def _integral(integrand: Any, x: Any, start: Any) -> Any:
    """The antiderivative by SymPy's rules for hand calculation, else an `Integral`."""
    parts = []
    for term in sympy.Add.make_args(_prepared(integrand)):
        done = _by_exponential(term, x)
        if done is not None:
            parts.append(done)
            continue
        for form in (_one_exponential(term), term, _with_secants(term)):
            done = sympy.Integral(form, x).doit(manual=True)
            if not done.has(sympy.Integral):
                break
        else:
            return _open(integrand, x, start)
        parts.append(done)
    return sympy.Add(*parts)


def _by_exponential(term: Any, x: Any) -> Any:
    """The antiderivative of a function of u = exp(k x) alone, in u; None for another function, or one that isn't done."""
    rates = {e: e.args[0].diff(x) for e in term.atoms(sympy.exp) if e.args[0].subs(x, 0) == 0}
    if not rates or not all(rate.is_Rational for rate in rates.values()):
        return None
    k, u = sympy.gcd_list([*rates.values()]), sympy.Dummy(positive=True)
    inner = term.xreplace({e: u ** (rate / k) for e, rate in rates.items()})
    if inner.has(x):
        return None
    done = sympy.Integral(sympy.expand(inner / (k * u)), u).doit(manual=True)
    return None if done.has(sympy.Integral) else done.subs(u, sympy.exp(k * x))


def _prepared(integrand: Any) -> Any:
    """Expanded, in sines and cosines, and without sin^2 over a cosine: as tables have it."""
    if integrand.has(tan, cot, sec, csc):
        integrand = integrand.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        integrand = integrand.replace(sec, lambda a: 1 / cos(a)).replace(csc, lambda a: 1 / sin(a))
    if sympy.denom(integrand).has(cos):
        integrand = integrand.replace(
            lambda e: e.is_Pow and e.exp == 2 and e.base.func is sin, lambda e: 1 - cos(e.base.args[0]) ** 2
        )
    return expand(integrand)


def _with_secants(term: Any) -> Any:
    inverse = {cos: sec, sin: csc}
    return term.replace(
        lambda e: e.is_Pow and e.exp.is_Integer and e.exp < 0 and e.base.func in inverse,
        lambda e: inverse[e.base.func](*e.base.args) ** -e.exp,
    )


def _one_exponential(term: Any) -> Any:
    """exp(x^2) exp(x) as exp(x^2 + x)."""
    return expand(powsimp(term), power_exp=False)
