"""Coefficients with powers x^e whose exponents aren't integers: x^n with a symbol n, sqrt(x); and with exp(c x^m), sin(c x^m).

With theta = x d/dx, y'' + b y' + c y = 0 is theta^2 y + (x b - 1) theta y + x^2 c y = 0.  Where x b and x^2 c are rational in
T = x^k, this is, by theta = k T d/dT, an equation with rational coefficients,

    k^2 T^2 Y'' + (k^2 + k (x b - 1)) T Y' + x^2 c Y = 0,        y(x) = Y(x^k).                                        (1)

The functions x b - 1 and x^2 c are P and Q in the code.  Where exponentials of u = x^m occur, (1) in u is one with
coefficients in exp(c u), read by `exponentials`.  x is positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import sympy

from kovacic.equation import UNKNOWN, Change, Equation, Parsed
from kovacic.errors import NotRational
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.exponentials import common_power, in_exponentials, new_variable
from kovacic.reading.parts import parts_of, source_of_parts
from kovacic.reading.source import Source, read_source

Expr = Any  # SymPy publishes no types


def in_powers(source: Source, limits: Limits) -> Parsed | None:
    """The equation (1) for an input with such coefficients; None where they aren't functions of one power.

    The right-hand side is kept as the equation's h.
    """
    x = sympy.Symbol(source.variable)
    parts, notices = parts_of(source, limits)
    a, b, c, rest = parts
    if a == 0:
        return None
    coefficients = (b / a, c / a)
    if all(coefficient.is_rational_function(x) for coefficient in coefficients):
        return None  # what isn't rational is a constant
    form = _ThetaForm(sympy.expand(x * b / a) - 1, sympy.expand(x**2 * c / a))
    try:
        waves = _waves_in(coefficients, x)
        found = _of_waves(form, waves, source, limits) if waves else _of_power(form, source, limits)
    except NotRational:
        return None
    if found is None:
        return None
    equation = found.equation
    if rest != 0:
        equation = replace(equation, h=sympy.expand(-rest / a))
    said = f"in {equation.variable} = {found.change.expression}: {equation}"
    return Parsed(equation.S, equation.variable, (said, *notices, *found.notices), equation, found.letters)


class _ThetaForm(NamedTuple):
    """theta^2 y + P theta y + Q y = 0."""

    P: Expr
    Q: Expr


class _InPower(NamedTuple):
    """An equation in a power of x, or in a function of one, and what the user should know about how it was read."""

    equation: Equation
    change: Change
    notices: tuple[str, ...]
    letters: tuple[tuple[str, Expr], ...]


_WAVES = (sympy.exp, sympy.sin, sympy.cos, sympy.tan, sympy.sinh, sympy.cosh, sympy.tanh)


def _waves_in(coefficients: Sequence[Expr], x: Expr) -> list[Expr]:
    """The exponentials and waves with x in their arguments."""
    found: set[Expr] = set()
    for coefficient in coefficients:
        found |= coefficient.atoms(*_WAVES)
    return [wave for wave in found if wave.has(x)]


def _of_power(form: _ThetaForm, source: Source, limits: Limits) -> _InPower | None:
    """In T = x^k: with x = exp(s) for the moment, powers of x are exponentials of s, and T is exp(k s)."""
    x = sympy.Symbol(source.variable)
    s = sympy.Dummy("s")
    T = sympy.Dummy("T")
    P = _in_logarithm(form.P, x, s)
    Q = _in_logarithm(form.Q, x, s)
    exponentials = {e for e in P.atoms(sympy.exp) | Q.atoms(sympy.exp) if e.has(s)}
    if not exponentials or P.has(sympy.log) or Q.has(sympy.log):
        return None
    common = common_power(exponentials, s, T)
    k = common.k
    P = P.xreplace(common.powers)
    Q = Q.xreplace(common.powers)
    if common.offset != 0 or P.has(s) or Q.has(s):
        return None
    return _read_in(T, (k**2 * T**2, (k**2 + k * P) * T, Q), x**k, source, limits)


def _of_waves(form: _ThetaForm, waves: Sequence[Expr], source: Source, limits: Limits) -> _InPower | None:
    """In u = x^m, and then in exp(c u)."""
    x = sympy.Symbol(source.variable)
    m = _power_in(waves, x)
    if m is None:
        return None
    u = sympy.Symbol("v") if x.name == "u" else sympy.Symbol("u")
    inner = source_of_parts(_monic_in(form, x, m, u), _renamed(source, u.name))
    found = in_exponentials(inner, limits)
    if found is None or found.equation is None or found.equation.change is None:
        return None
    change = Change(x.name, as_text(function_of_x(found.equation).subs(u, x**m)))
    equation = replace(found.equation, unknown=source.unknown or UNKNOWN, change=change)
    return _InPower(equation, change, found.notices[1:], found.letters)


def _monic_in(form: _ThetaForm, x: Expr, m: Expr, u: Expr) -> list[Expr]:
    """The coefficients of (1) in u = x^m, divided by that of the second derivative."""
    T = sympy.Dummy("T", positive=True)
    P, Q = (sympy.powdenest(part.subs(x, T ** (1 / m)), force=True) for part in form)
    first = sympy.cancel((m**2 + m * P) / (m**2 * T))
    zeroth = sympy.cancel(Q / (m**2 * T**2))
    return [sympy.S.One, first.xreplace({T: u}), zeroth.xreplace({T: u}), sympy.S.Zero]


def _power_in(waves: Sequence[Expr], x: Expr) -> Expr | None:
    """m, where the arguments of all waves contain x in x^m alone; None elsewhere."""
    exponents: set[Expr] = set()
    for wave in waves:
        powers = [p for p in wave.args[-1].atoms(sympy.Pow) if p.base == x]
        exponents.update(p.exp for p in powers)
        beside = wave.args[-1].subs(dict.fromkeys(powers, 0))
        if beside.has(x):
            return None
    if len(exponents) != 1:
        return None
    (m,) = exponents
    if m.has(x):
        return None
    return m


def _renamed(source: Source, variable: str) -> Source:
    """The same, for an equation in another variable."""
    return source._replace(variable=variable, unknown=source.unknown or UNKNOWN)


def _in_logarithm(part: Expr, x: Expr, s: Expr) -> Expr:
    """With x = exp(s); powers become exponentials."""
    powers = {p: sympy.exp(sympy.expand(p.exp * s)) for p in part.atoms(sympy.Pow) if p.base == x}
    inside = part.xreplace(powers)
    return sympy.powsimp(inside.xreplace({x: sympy.exp(s)}), combine="exp")


def _read_in(T: Expr, left: Sequence[Expr], value: Expr, source: Source, limits: Limits) -> _InPower | None:
    """The equation in T = value, with rational coefficients."""
    t = new_variable(left, {source.variable, source.unknown})
    parts = [part.xreplace({T: t}) for part in (*left, sympy.Integer(0))]
    read = read_source(source_of_parts(parts, _renamed(source, t.name)), limits)
    if read.equation is None:
        return None
    change = Change(source.variable, as_text(value))
    return _InPower(replace(read.equation, change=change), change, read.notices, read.letters)
