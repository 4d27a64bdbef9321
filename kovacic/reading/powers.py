"""Coefficients with powers x^e whose exponents aren't integers: x^n with a symbol n, sqrt(x); and with exp(c x^m), sin(c x^m).

With theta = x d/dx, y'' + b y' + c y = 0 is theta^2 y + (x b - 1) theta y + x^2 c y = 0.  Where x b and x^2 c are rational in
T = x^k, this is, by theta = k T d/dT, an equation with rational coefficients,

    k^2 T^2 Y'' + (k^2 + k (x b - 1)) T Y' + x^2 c Y = 0,        y(x) = Y(x^k).                                        (1)

The functions x b - 1 and x^2 c are P and Q in the code.  Where exponentials of u = x^m occur, (1) in u is one with
coefficients in exp(c u), read by `exponentials`.  x is positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy
from sympy.core.function import AppliedUndef

from kovacic.equation import UNKNOWN, Change, Parsed
from kovacic.errors import NotRational
from kovacic.numbers.numerals import as_text
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.exponentials import common_power, in_exponentials, read_in
from kovacic.reading.naming import Source
from kovacic.reading.source import parts_of, source_of_parts

Expr = Any  # SymPy publishes no types


def in_powers(source: Source) -> Parsed | None:
    """The equation (1) for an input with such coefficients; None if they aren't functions of one power.

    The right-hand side is kept as the equation's h.
    """
    x = sympy.Symbol(source.variable)
    (a, b, c, rest), notices = parts_of(source)
    # Without functions, what isn't rational is a constant.
    if a == 0 or (a + b + c).has(AppliedUndef) or (b / a + c / a).is_rational_function(x):
        return None
    P, Q = sympy.expand(x * b / a) - 1, sympy.expand(x**2 * c / a)
    waves = [wave for wave in sympy.Tuple(b / a, c / a).atoms(*_WAVE_FUNCTIONS) if wave.has(x)]
    found = None
    with suppress(NotRational):
        found = _of_waves(P, Q, waves, source) if waves else _in_one_power(P, Q, source)
    if found is None:
        return None
    equation = replace(found.equation, h=sympy.expand(-rest / a) if rest != 0 else found.equation.h)
    said = f"in {equation.variable} = {found.equation.change.expression.replace('**', '^')}: {equation}"
    return Parsed(equation.S, equation.variable, (said, *notices, *found.notices), equation, found.letters)


_WAVE_FUNCTIONS = (sympy.exp, sympy.sin, sympy.cos, sympy.tan, sympy.sinh, sympy.cosh, sympy.tanh)


def _in_one_power(P: Expr, Q: Expr, source: Source) -> Any:
    """theta^2 y + P theta y + Q y = 0 in T = x^k: with x = exp(s) powers of x are exponentials of s, and T is exp(k s)."""
    x, s, T = sympy.Symbol(source.variable), sympy.Dummy("s"), sympy.Dummy("T")

    both = sympy.Tuple(P, Q)
    powers = {p: sympy.exp(sympy.expand(p.exp * s)) for p in both.atoms(sympy.Pow) if p.base == x}
    both = both.xreplace(powers).xreplace({x: sympy.exp(s)})
    both = sympy.Tuple(*(sympy.powsimp(part, combine="exp") for part in both))
    exponentials = {e for e in both.atoms(sympy.exp) if e.has(s)}
    if not exponentials or both.has(sympy.log):
        return None
    k, offset, powers = common_power(exponentials, s, T)
    P, Q = both = both.xreplace(powers)
    if offset != 0 or both.has(s):
        return None
    left = (k**2 * T**2, (k**2 + k * P) * T, Q, sympy.S.Zero)
    return _with_change(read_in(T, left, source), source, x**k)


def _of_waves(P: Expr, Q: Expr, waves: Sequence[Expr], source: Source) -> Any:
    """In u = x^m, where the arguments of all waves contain x in x^m alone, and then in exp(c u)."""
    x = sympy.Symbol(source.variable)
    arguments = sympy.Tuple(*(wave.args[-1] for wave in waves))
    powers = {p for p in arguments.atoms(sympy.Pow) if p.base == x}
    if len(powers) != 1 or arguments.subs(dict.fromkeys(powers, 0)).has(x):
        return None
    m = powers.pop().exp
    u = sympy.Symbol("v") if x.name == "u" else sympy.Symbol("u")
    T = sympy.Dummy("T", positive=True)
    P, Q = (sympy.powdenest(part.subs(x, T ** (1 / m)), force=True) for part in (P, Q))
    first = sympy.cancel((m**2 + m * P) / (m**2 * T))
    zeroth = sympy.cancel(Q / (m**2 * T**2))
    monic = [sympy.S.One, first.xreplace({T: u}), zeroth.xreplace({T: u}), sympy.S.Zero]
    renamed = source._replace(variable=u.name, unknown=source.unknown or UNKNOWN)
    found: Any = in_exponentials(source_of_parts(monic, renamed))
    if found is None or found.equation.change is None:
        return None
    return _with_change(replace(found, notices=found.notices[1:]), source, function_of_x(found.equation).subs(u, x**m))


def _with_change(read: Any, source: Source, value: Expr) -> Any:
    """With a variable that is this function of the user's."""
    change = Change(source.variable, as_text(value))
    return replace(read, equation=replace(read.equation, unknown=source.unknown or UNKNOWN, change=change))
