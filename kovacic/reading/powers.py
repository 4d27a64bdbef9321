"""Coefficients with powers x^e whose exponents aren't integers: x^n with a symbol n, sqrt(x); and with exp(c x^m), sin(c x^m).

With theta = x d/dx, y'' + b y' + c y = 0 is theta^2 y + (x b - 1) theta y + x^2 c y = 0.  Where x b and x^2 c are rational in
T = x^k, this is, by theta = k T d/dT, an equation with rational coefficients,

    k^2 T^2 Y'' + (k^2 + k (x b - 1)) T Y' + x^2 c Y = 0,        y(x) = Y(x^k).                                        (1)

Where exponentials of u = x^m occur, (1) in u is one with coefficients in exp(c u), read by
`exponentials`.  x is positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy

from kovacic.equation import UNKNOWN, Change, Parsed
from kovacic.errors import NotRational
from kovacic.limits import Limits
from kovacic.numerals import as_text
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.exponentials import common_power, in_exponentials
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
    if (b / a).is_rational_function(x) and (c / a).is_rational_function(x):
        return None  # what isn't rational is a constant
    waves = [e for e in (b / a).atoms(*_WAVES) | (c / a).atoms(*_WAVES) if e.has(x)]
    found = None
    with suppress(NotRational):
        found = _of_waves(parts, waves, source, limits) if waves else _of_power(parts, source, limits)
    if found is None or found.equation is None or found.equation.change is None:
        return None
    h = None if rest == 0 else sympy.expand(-rest / a)
    equation = replace(found.equation, h=h)
    said = f"in {equation.variable} = {found.equation.change.expression}: {equation}"
    return replace(found, equation=equation, notices=(said, *notices, *found.notices[1:]))


_WAVES = (sympy.exp, sympy.sin, sympy.cos, sympy.tan, sympy.sinh, sympy.cosh, sympy.tanh)


def _of_power(parts: Sequence[Expr], source: Source, limits: Limits) -> Parsed | None:
    """In T = x^k."""
    x = sympy.Symbol(source.variable)
    s = sympy.Dummy("s")
    T = sympy.Dummy("T")
    P, Q = (_in_logarithm(part, x, s) for part in _theta_form(parts, x))
    exponentials = {e for part in (P, Q) for e in part.atoms(sympy.exp) if e.has(s)}
    if not exponentials or (P.has(sympy.log) or Q.has(sympy.log)):
        return None
    k, offset, powers = common_power(exponentials, s, T)
    P = P.xreplace(powers)
    Q = Q.xreplace(powers)
    if offset != 0 or P.has(s) or Q.has(s):
        return None
    return _read_in(T, (k**2 * T**2, (k**2 + k * P) * T, Q), x**k, source, limits)


def _of_waves(parts: Sequence[Expr], waves: Sequence[Expr], source: Source, limits: Limits) -> Parsed | None:
    """In u = x^m, and then in exp(c u)."""
    x = sympy.Symbol(source.variable)
    u = sympy.Dummy("u", positive=True)
    exponents = {p.exp for wave in waves for p in wave.args[-1].atoms(sympy.Pow) if p.base == x}
    if len(exponents) != 1 or any(wave.args[-1].subs(dict.fromkeys(_powers_of(wave, x), 0)).has(x) for wave in waves):
        return None
    (m,) = exponents
    if m.has(x):
        return None
    P, Q = (sympy.powdenest(part.subs(x, u ** (1 / m)), force=True) for part in _theta_form(parts, x))
    plain = sympy.Symbol("u" if x.name != "u" else "v")
    monic = [sympy.S.One, sympy.cancel((m**2 + m * P) / (m**2 * u)), sympy.cancel(Q / (m**2 * u**2)), sympy.S.Zero]
    inner = source_of_parts([part.xreplace({u: plain}) for part in monic], _renamed(source, plain.name))
    found = in_exponentials(inner, limits)
    if found is None or found.equation is None or found.equation.change is None:
        return None
    change = Change(x.name, as_text(function_of_x(found.equation).subs(plain, x**m)))
    return replace(found, equation=replace(found.equation, unknown=source.unknown or UNKNOWN, change=change))


def _powers_of(wave: Expr, x: Expr) -> list[Expr]:
    return [p for p in wave.args[-1].atoms(sympy.Pow) if p.base == x]


def _renamed(source: Source, variable: str) -> Source:
    """The same, for an equation in another variable."""
    return source._replace(variable=variable, unknown=source.unknown or UNKNOWN)


def _theta_form(parts: Sequence[Expr], x: Expr) -> tuple[Expr, Expr]:
    """x b - 1 and x^2 c of the monic equation, as sums."""
    a, b, c, _ = parts
    return sympy.expand(x * b / a) - 1, sympy.expand(x**2 * c / a)


def _in_logarithm(part: Expr, x: Expr, s: Expr) -> Expr:
    """With x = exp(s); powers become exponentials."""
    inside = part.xreplace({p: sympy.exp(sympy.expand(p.exp * s)) for p in part.atoms(sympy.Pow) if p.base == x})
    return sympy.powsimp(inside.xreplace({x: sympy.exp(s)}), combine="exp")


def _read_in(T: Expr, left: Sequence[Expr], value: Expr, source: Source, limits: Limits) -> Parsed | None:
    """The equation in T = value, with rational coefficients."""
    names = {s.name for part in left for s in part.free_symbols} | {source.variable, source.unknown}
    t = sympy.Symbol(next(name for name in ("t", "s", "z", "w", "t_", "s_") if name not in names))
    parts = [part.xreplace({T: t}) for part in (*left, sympy.Integer(0))]
    read = read_source(source_of_parts(parts, _renamed(source, t.name)), limits)
    if read.equation is None:
        return None
    change = Change(source.variable, as_text(value))
    return replace(read, equation=replace(read.equation, change=change), notices=("", *read.notices))
