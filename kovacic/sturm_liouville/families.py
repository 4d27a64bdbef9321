"""Eigenvalues as formulas: boundary problems that are y'' + mu y = 0 on an interval after Liouville's transformation.

With Y'' = (Q - E W) Y, t = int sqrt(W) dx from the left end and Y = W^(-1/4) v it is v'' = (q - E) v, q = Q/W - W^(-3/4)
(W^(-1/4))''.  Where q is a constant, v is a combination of cos(k t) and sin(k t), k = sqrt(E - q): so for constant
coefficients, Euler's equation and others.  With h = y/v a condition alpha y + beta y' = 0 is (alpha + beta h'/h) v
+ beta t' v_t = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.sturm_liouville.problem import Robin

Expr = Any


@dataclass(frozen=True)
class EigenvalueFamily:
    """All eigenvalues of a boundary problem with their functions.

    With a formula, `value` is that of number n, an integer `n` of at least `first`; else `equation` is what sqrt(E - `shift`)
    fulfils, and `value` is the parameter itself; at `shift` there is an eigenvalue only if `zero` is zero.  `functions` are
    independent eigenfunctions, as functions of x.
    """

    value: Expr
    functions: tuple[Expr, ...]
    n: Expr
    first: int
    equation: Expr | None = None
    shift: Expr = sympy.S.Zero
    zero: Expr = sympy.S.One


@dataclass(frozen=True)
class _Waves:
    """y = h(x) v(t(x)), where v'' = -(E - q) v."""

    x: Expr
    t: Expr
    h: Expr
    q: Expr
    ends: tuple[Expr, Expr]

    @property
    def length(self) -> Expr:
        return sympy.simplify(self.t.subs(self.x, self.ends[1]))

    def wish(self, condition: Robin, side: int) -> tuple[Expr, Expr]:
        """A and B in A v + B v_t = 0."""
        at = self.ends[side]
        steepness = sympy.simplify((self.h.diff(self.x) / self.h).subs(self.x, at))
        rate = sympy.simplify(self.t.diff(self.x).subs(self.x, at))
        A = sympy.simplify(condition.alpha + condition.beta * steepness)
        return A, sympy.simplify(condition.beta * rate)

    def function(self, v: Expr, t: Expr) -> Expr:
        return sympy.simplify(self.h) * v.subs(t, self.t)


def family(
    x: Expr,
    B: Expr,
    c0: Expr,
    c1: Expr,
    parameter: Expr,
    ends: tuple[Expr, Expr],
    conditions: tuple[Robin, Robin] | int,
    *,
    n: Expr,
) -> EigenvalueFamily | None:
    """The eigenvalues of y'' + B y' + (c0 + parameter c1) y = 0, or None where this isn't such a problem.

    `conditions` are those at the two ends, or 1 or -1 for periodic and antiperiodic ones; letters are taken to be positive.
    """
    waves = _waves(x, B, c0, c1, ends)
    if waves is None:
        return None
    t = sympy.Dummy("t", positive=True)
    T = waves.length
    if T.has(sympy.I, sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):  # there is a singular point at an end or between
        return None
    if isinstance(conditions, int):
        return _wrapped(waves, t, n, conditions)
    left, right = (waves.wish(condition, side) for side, condition in enumerate(conditions))
    k = sympy.Dummy("k", positive=True)
    if left[1] == 0:
        v = sympy.sin(k * t)
    elif left[0] == 0:
        v = sympy.cos(k * t)
    else:
        v = k * sympy.cos(k * t) - left[0] / left[1] * sympy.sin(k * t)
    numbers = _wave_numbers(left, right, n)
    if numbers is not None:
        first, angle = numbers
        root = angle / T
        return EigenvalueFamily(
            sympy.simplify(root**2 + waves.q), (waves.function(v.subs(k, root), t),), n, first, shift=waves.q
        )
    root = sympy.sqrt(parameter - waves.q)
    equation = _wave_equation(left, right, root, T)
    zero = sympy.factor(right[0] * (left[1] - left[0] * T) - right[1] * left[0])  # for v = B1 - A1 t, where k = 0
    return EigenvalueFamily(parameter, (waves.function(v.subs(k, root), t),), n, 1, equation, waves.q, zero)


def _waves(x: Expr, B: Expr, c0: Expr, c1: Expr, ends: tuple[Expr, Expr]) -> _Waves | None:
    positive = {s: sympy.Symbol(s.name, positive=True) for s in (B + c0 + c1 + sum(ends)).free_symbols}
    back = {symbol: s for s, symbol in positive.items()}
    X = positive.get(x, x)
    B, c0, c1, *bounds = (sympy.sympify(e).xreplace(positive) for e in (B, c0, c1, *ends))
    root = sympy.sqrt(sympy.factor(c1))
    if not root.is_positive and not root.is_number:
        return None
    Q = B**2 / 4 + B.diff(X) / 2 - c0
    f = 1 / sympy.sqrt(root)
    q = sympy.simplify(Q / c1 - f.diff(X, 2) / (f * c1))
    if q.has(X):
        return None
    primitive, exponent = (sympy.integrate(sympy.simplify(e), X) for e in (root, -B / 2))
    if primitive.has(sympy.Integral) or exponent.has(sympy.Integral):
        return None
    h = sympy.powsimp(sympy.simplify(f * sympy.exp(exponent)))
    t = sympy.simplify(primitive - primitive.subs(X, bounds[0]))
    t, h, q = (e.xreplace(back) for e in (t, h, q))
    return _Waves(x, t, h, q, ends)


def _wave_numbers(left: tuple[Expr, Expr], right: tuple[Expr, Expr], n: Expr) -> tuple[int, Expr] | None:
    """The first n, and k T; None if the equation for k is transcendental."""
    kinds = [None if A != 0 and B != 0 else bool(B == 0) for A, B in (left, right)]
    if None in kinds:
        return None
    if kinds[0] != kinds[1]:
        return 1, (2 * n - 1) * sympy.pi / 2
    return (1 if kinds[0] else 0), n * sympy.pi


def _wave_equation(left: tuple[Expr, Expr], right: tuple[Expr, Expr], root: Expr, T: Expr) -> Expr:
    """A2 v(T) + B2 v_t(T) = 0: (A1 A2 + B1 B2 k^2) sin(k T) = k (A2 B1 - A1 B2) cos(k T).

    With A1 = 0 or B1 = 0 one may divide by the factor of the sine and the cosine, which are never both zero then.
    """
    (A1, B1), (A2, B2) = left, right
    sines = sympy.simplify(A1 * A2 + B1 * B2 * root**2)
    cosines = sympy.simplify(root * (A2 * B1 - A1 * B2))
    if A1 == 0 or B1 == 0:
        return sympy.Eq(sympy.tan(root * T), sympy.simplify(cosines / sines), evaluate=False)
    return sympy.Eq(sines * sympy.sin(root * T), cosines * sympy.cos(root * T), evaluate=False)


def _wrapped(waves: _Waves, t: Expr, n: Expr, wrap: int) -> EigenvalueFamily | None:
    """Periodic conditions, for which y has to be v."""
    rate = waves.t.diff(waves.x)
    if waves.h.has(waves.x) or rate.has(waves.x):
        return None
    root = (2 * n if wrap == 1 else 2 * n - 1) * sympy.pi / waves.length
    functions = tuple((waves.h * v).subs(t, rate * waves.x) for v in (sympy.cos(root * t), sympy.sin(root * t)))
    return EigenvalueFamily(sympy.simplify(root**2 + waves.q), functions, n, 0 if wrap == 1 else 1, shift=waves.q)
