"""Integrands with waves: changes of variable that make them rational, and sine and cosine integrals.

s = sin(theta) and c = cos(theta) for a linear theta = w x + phi.  A rational function R(s, c) is one of

    c if R is odd in s,    s if R is odd in c,    tan(theta) if R(-s, -c) = R(s, c),    tan(theta/2) otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import Any

import sympy
from sympy import atan, cos, log, sin, tan
from sympy.simplify.fu import TR8, TR2i

from kovacic.general_solution.integrands import integral_of_product, sum_of
from kovacic.general_solution.undetermined import undetermined

Expr = Any  # SymPy publishes no types


# ------------------------------------------------------------------------------------------------- changes of variable


@dataclass(frozen=True)
class WaveChange:
    """To a function u of theta, for which x is written in `integrand`, R times dx/du."""

    integrand: Expr
    u: Expr

    def back(self, found: Expr, x: Expr) -> Expr:
        """An integral that was found in u, in theta."""
        if self.u.func is tan:
            return TR2i(_at_tangent(found, self.u.args[0], x))
        return TR2i(found.xreplace({x: self.u}))


def _at_tangent(found: Expr, angle: Expr, x: Expr) -> Expr:
    """For x = tan(angle), in sines and cosines: atan(x) is the angle, and x^2 + 1 = 1/cos(angle)^2."""
    u = sympy.Dummy()
    known = {atan(u): angle, log(u**2 + 1): -2 * log(cos(angle)), u**2 + 1: cos(angle) ** -2}
    return found.xreplace({x: u}).xreplace(known).xreplace({u: sin(angle) / cos(angle)})


def wave_changes(term: Expr, x: Expr) -> list[WaveChange]:
    """The changes that make a term with waves rational, or a root of a wave stays; none where it has more than waves."""
    waves = sorted(term.atoms(sin, cos), key=str)
    theta = _common_angle(waves)
    if theta is None:
        return []
    s = sympy.Dummy()
    c = sympy.Dummy()
    R = term.xreplace({wave: _multiple_angle(wave, theta, s, c) for wave in waves})
    slope = theta.diff(x)
    is_linear = not slope.has(x) and slope != 0
    if R.has(x) or not is_linear:
        return []
    return _changes(R, s, c, theta, x)


def _common_angle(waves: list[Expr]) -> Expr | None:
    """theta, of which the arguments of all waves are integer multiples; None where there is none."""
    if not waves:
        return None
    first = waves[0].args[0]
    ratios = [sympy.cancel(wave.args[0] / first) for wave in waves]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    return first * reduce(sympy.gcd, ratios)


def _multiple_angle(wave: Expr, theta: Expr, s: Expr, c: Expr) -> Expr:
    """sin(n theta) or cos(n theta) in s = sin(theta) and c = cos(theta)."""
    n = int(sympy.cancel(wave.args[0] / theta))
    if wave.func is cos:
        return sympy.chebyshevt(abs(n), c)
    return sympy.sign(n) * s * sympy.chebyshevu(abs(n) - 1, c)


def _changes(R: Expr, s: Expr, c: Expr, theta: Expr, x: Expr) -> list[WaveChange]:
    """Those of the module's head that fit R; u is x."""
    slope = theta.diff(x)
    root = sympy.sqrt(1 - x**2)
    square = 1 + x**2

    def change(f: Expr, in_u: dict[Expr, Expr], u: Expr) -> WaveChange:
        """For int f du with f in s and c, which are known in u."""
        return WaveChange(f.subs(in_u) / slope, u)

    found = []
    is_odd_in_s = sympy.cancel(R + R.xreplace({s: -s})) == 0
    if is_odd_in_s:
        found.append(change(-R / s, {s: root, c: x}, cos(theta)))
    is_odd_in_c = sympy.cancel(R + R.xreplace({c: -c})) == 0
    if is_odd_in_c:
        found.append(change(R / c, {c: root, s: x}, sin(theta)))
    if found:
        return found
    is_even = sympy.cancel(R - R.xreplace({s: -s, c: -c})) == 0
    if is_even:
        return [change(R / square, {s: x / sympy.sqrt(square), c: 1 / sympy.sqrt(square)}, tan(theta))]
    return [change(2 * R / square, {s: 2 * x / square, c: (1 - x**2) / square}, tan(theta / 2))]


# ------------------------------------------------------------------------------------------- sine and cosine integrals


def beside_waves(term: Expr, x: Expr) -> Expr | None:
    """int R cos(w x + b) dx for rational R, after partial fractions, by sine and cosine integrals.

    >>> x = sympy.Symbol("x")
    >>> beside_waves(sin(x) / x, x)
    Si(x)
    """
    singles = sympy.Add.make_args(sympy.expand(TR8(term)))
    return sum_of(_beside_at_most_one_wave(single, x) for single in singles)


def _beside_at_most_one_wave(term: Expr, x: Expr) -> Expr | None:
    """The integral of R, or of R times a wave, by partial fractions."""
    waves = term.atoms(sin, cos)
    if len(waves) > 1:
        return None
    wave = next(iter(waves), sympy.Integer(1))
    R = term / wave
    if not R.is_rational_function(x) or R.has(sin, cos):
        return None
    fractions = sympy.Add.make_args(sympy.apart(R, x))
    if not waves:
        return sum_of(integral_of_product(fraction, x) for fraction in fractions)
    return sum_of(_beside_one_wave(fraction, wave, x) for fraction in fractions)


def _beside_one_wave(fraction: Expr, wave: Expr, x: Expr) -> Expr | None:
    """The integral of a polynomial, or of a single pole, times a wave."""
    slope = wave.args[0].diff(x)
    if slope.has(x):
        return None
    found = by_coefficients(fraction * wave, x)
    if found is not None:
        return found
    return _at_a_pole(fraction, wave, slope, x)


def by_coefficients(term: Expr, x: Expr) -> Expr | None:
    """Y' for Y'' = g, by undetermined coefficients: polynomials times exponentials and waves.

    >>> x = sympy.Symbol("x")
    >>> by_coefficients(x * cos(x), x)
    x*sin(x) + cos(x)
    """
    found = undetermined(sympy.Integer(0), sympy.Integer(0), term, x)
    if found is None:
        return None
    return sympy.expand(found.diff(x))


def _at_a_pole(fraction: Expr, wave: Expr, slope: Expr, x: Expr) -> Expr | None:
    """int f g/(x - c)^k dx for a constant f and a wave g: by parts down to k = 1, which is Si and Ci."""
    base, exponent = fraction.as_independent(x, as_Add=False)[1].as_base_exp()
    is_pole_of_line = exponent.is_Integer and exponent < 0 and not base.diff(x).has(x)
    if not is_pole_of_line:
        return None
    c = sympy.expand(x - base / base.diff(x))
    k = -int(exponent)
    factor = sympy.cancel(fraction * (x - c) ** k)
    total = sympy.Integer(0)
    while k > 1:
        total -= factor * wave / ((k - 1) * (x - c) ** (k - 1))
        factor = factor / (k - 1)
        wave = wave.diff(x)
        k -= 1
    number, single = wave.as_independent(x, as_Add=False)
    return total + factor * number * _over_a_line(single, c, slope, x)


def _over_a_line(wave: Expr, c: Expr, slope: Expr, x: Expr) -> Expr:
    """int sin(u + p)/(x - c) dx = cos(p) Si(u) + sin(p) Ci(u) with u = slope (x - c), and p + pi/2 for the cosine."""
    u = slope * (x - c)
    phase = sympy.expand(wave.args[0].subs(x, c))
    if wave.func is sin:
        return cos(phase) * sympy.Si(u) + sin(phase) * sympy.Ci(u)
    return -sin(phase) * sympy.Si(u) + cos(phase) * sympy.Ci(u)
