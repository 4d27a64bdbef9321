"""Eigenvalues as formulas: boundary problems that are y'' + mu y = 0 on an interval after Liouville's transformation.

With Y'' = (Q - E W) Y, t = int sqrt(W) dx from the left end and Y = W^(-1/4) v it is v'' = (q - E) v, q = Q/W - W^(-3/4)
(W^(-1/4))''.  Where q is a constant, v is a combination of cos(k t) and sin(k t), k = sqrt(E - q): so for constant
coefficients, Euler's equation and others.  With h = y/v a condition alpha y + beta y' = 0 is (alpha + beta h'/h) v
+ beta t' v_t = 0.

A problem in pieces has an equation for its eigenvalues, by matching solutions.  On each stretch Y'' = q Y, q = a x + b with b
depending on E: waves and exponentials for a = 0, else Airy's functions of z = c (x + b/a), c^3 = a, since c^2 z = q; at
c delta(x - p), Y' grows by c Y(p).  (Y, Y') is carried from the left end through the stretches, and E is an eigenvalue where it
is a multiple of the solution that decays at the right end, or fulfils the condition there.  If q is even about the middle, Y is
even or odd, so that Y' or Y vanishes there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import compress
from typing import Any

import sympy

from kovacic.sturm_liouville.problem import Robin, SturmProblem

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
    """The eigenvalues of y'' + B y' + (c0 + parameter c1) y = 0, or None if this isn't such a problem.

    `conditions` are those at the two ends, or 1 or -1 for periodic and antiperiodic ones; letters are taken to be positive.
    """
    transformed = _transformed(x, B, c0, c1, ends)
    if transformed is None:
        return None
    t, h, q, T = transformed
    rate = t.diff(x)
    if isinstance(conditions, int):
        if h.has(x) or rate.has(x):  # else y is periodic where v is
            return None
        first = int(conditions == -1)
        root = (2 * n - first) * sympy.pi / T
        functions = (h * sympy.cos(root * rate * x), h * sympy.sin(root * rate * x))
        return EigenvalueFamily(sympy.simplify(root**2 + q), functions, n, first, shift=q)
    wishes = []  # A and B in A v + B v_t = 0, at the left and the right end
    for at, wish in zip(ends, conditions, strict=True):
        steepness, slope = (sympy.simplify(e.subs(x, at)) for e in (h.diff(x) / h, rate))
        wishes.append(tuple(map(sympy.simplify, (wish.alpha + wish.beta * steepness, wish.beta * slope))))
    (A1, B1), (A2, B2) = wishes
    k = sympy.Dummy("k", positive=True)
    v = sympy.sin(k * t) if B1 == 0 else k * sympy.cos(k * t) - A1 / B1 * sympy.sin(k * t)
    y = sympy.simplify(h) * v.as_independent(x, as_Add=False)[1]
    if 0 in wishes[0] and 0 in wishes[1]:  # else the equation for k is transcendental
        root = (n * sympy.pi if (B1 == 0) == (B2 == 0) else (2 * n - 1) * sympy.pi / 2) / T
        first = int(B1 == 0 or B2 == 0)  # k = 0 belongs to y' = 0 at both ends
        return EigenvalueFamily(sympy.simplify(root**2 + q), (y.subs(k, root),), n, first, shift=q)
    root = sympy.sqrt(parameter - q)
    # A2 v(T) + B2 v_t(T) = 0
    sines, cosines = sympy.simplify(A1 * A2 + B1 * B2 * root**2), sympy.simplify(root * (A2 * B1 - A1 * B2))
    equation = sympy.Eq(sines * sympy.sin(root * T), cosines * sympy.cos(root * T), evaluate=False)
    if 0 in wishes[0]:  # the factors of the sine and the cosine are never both zero then
        equation = sympy.Eq(sympy.tan(root * T), sympy.simplify(cosines / sines), evaluate=False)
    zero = sympy.factor(A2 * (B1 - A1 * T) - B2 * A1)  # for v = B1 - A1 t, where k = 0
    return EigenvalueFamily(parameter, (y.subs(k, root),), n, 1, equation, q, zero)


def _transformed(x: Expr, B: Expr, c0: Expr, c1: Expr, ends: tuple[Expr, Expr]) -> tuple[Expr, Expr, Expr, Expr] | None:
    """t, h and q in y = h(x) v(t(x)), v'' = -(E - q) v, with t = 0 at the left end, and t = T at the right one.

    None unless q is a constant and T is finite.
    """
    positive = {s: sympy.Symbol(s.name, positive=True) for s in (B + c0 + c1 + sum(ends)).free_symbols}
    back = {symbol: s for s, symbol in positive.items()}
    X = positive.get(x, x)
    B, c0, c1, first = (sympy.sympify(e).xreplace(positive) for e in (B, c0, c1, ends[0]))
    root = sympy.sqrt(sympy.factor(c1))
    if not root.is_positive and not root.is_number:
        return None
    f = 1 / sympy.sqrt(root)
    q = sympy.simplify((B**2 / 4 + B.diff(X) / 2 - c0) / c1 - f.diff(X, 2) / (f * c1))
    if q.has(X):
        return None
    primitive, exponent = (sympy.integrate(sympy.simplify(e), X) for e in (root, -B / 2))
    if primitive.has(sympy.Integral) or exponent.has(sympy.Integral):
        return None
    h = sympy.powsimp(sympy.simplify(f * sympy.exp(exponent))).as_independent(X, as_Add=False)[1]
    t = sympy.simplify(primitive - primitive.subs(X, first))
    t, h, q = (e.xreplace(back) for e in (t, h, q))
    T = sympy.simplify(t.subs(x, ends[1]))
    # It isn't finite where there is a singular point at an end, or not real where there is one between.
    return None if T.has(sympy.I, sympy.nan, sympy.zoo, sympy.oo, -sympy.oo) else (t, h, q, T)


@dataclass(frozen=True)
class _LinearPiece:
    """Y'' = (a x + b) Y between two points; Y' grows by delta Y at the first.  At a barrier a = 0, and b > 0 for each level."""

    low: Expr
    high: Expr
    a: Expr
    b: Expr
    delta: Expr = sympy.S.Zero
    is_barrier: bool = False

    @property
    def scale(self) -> Expr:
        """c = dz/dx, the cube root of a, or 1 for a = 0."""
        return sympy.real_root(self.a, 3) if self.a != 0 else sympy.S.One

    def solutions(self, x: Expr) -> tuple[tuple[Expr, Expr], tuple[Expr, Expr]]:
        """Two solutions, each with its slope over c, at x: (1, 0) and (0, 1) at the low end, or Ai and Bi of z."""
        if self.a == 0:
            sign, cosine, sine = (1, sympy.cosh, sympy.sinh) if self.is_barrier else (-1, sympy.cos, sympy.sin)
            k = sympy.sqrt(sign * self.b)
            C, S = cosine(k * (x - self.low)), sine(k * (x - self.low))
            return (C, sign * k * S), (S / k, C)
        z = sympy.expand(self.scale * (x + self.b / self.a))
        return (sympy.airyai(z), sympy.airyaiprime(z)), (sympy.airybi(z), sympy.airybiprime(z))

    def decaying(self, x: Expr, side: int) -> tuple[Expr, Expr]:
        """(Y, Y') at x of the solution that decays at -oo (side 0) or oo (side 1)."""
        if self.a == 0:
            return sympy.S.One, (1 - 2 * side) * sympy.sqrt(self.b)
        Ai, slope = self.solutions(x)[0]
        return Ai, self.scale * slope

    def carried(self, Y: Expr, slope: Expr) -> tuple[Expr, Expr]:
        """(Y, Y') at the high end, from those at the low one."""
        (f, df), (g, dg) = self.solutions(self.low)
        slope = (slope + self.delta * Y) / self.scale
        first, second = Y * dg - slope * g, slope * f - Y * df  # times the Wronskian, 1 or 1/pi
        (f, df), (g, dg) = self.solutions(self.high)
        return first * f + second * g, self.scale * (first * df + second * dg)


def matching_equations(problem: SturmProblem, E: Expr) -> tuple[Expr, ...]:
    """The equation for E, or those for even and for odd eigenfunctions; () if a stretch isn't linear, or q falls to -oo.

    >>> from kovacic.sturm_liouville.problem import Stretch
    >>> x, E = sympy.symbols("x E")
    >>> stretches = Stretch(-sympy.oo, sympy.S.Zero, -x, sympy.S.One), Stretch(sympy.S.Zero, sympy.oo, x, sympy.S.One)
    >>> matching_equations(SturmProblem(x, stretches), E)
    (Eq(airyaiprime(-E), 0), Eq(airyai(-E), 0))
    """
    is_open = [end.is_infinite for end in problem.ends]
    lines = _linear_pieces(problem, E, is_open)
    if not lines or (all(is_open) and len(lines) == 1):
        return ()
    ends = []
    for side, condition in enumerate(problem.conditions):
        if isinstance(condition, Robin):
            ends.append((condition.beta, -condition.alpha))
        else:
            ends.append(lines[-side].decaying((lines[0].high, lines[-1].low)[side], side))
    state, (Y2, slope2) = ends
    inner = lines[is_open[0] : len(lines) - is_open[1]]
    middle = _middle(lines, problem)
    if middle is not None:
        inner = [replace(line, high=sympy.Min(line.high, middle)) for line in inner if line.low < middle]
    for line in inner:
        state = line.carried(*state)
    Y, slope = state
    if middle is not None:  # an even Y' changes its sign there, by the delta function
        half = sum((line.delta for line in lines if line.low == middle), sympy.S.Zero) / 2
        found = _zero_equation(slope + half * Y, E), _zero_equation(Y, E)
        return tuple(equation for equation in found if equation != sympy.false)
    slope += lines[-1].delta * Y if is_open[1] else 0
    return (_zero_equation(Y * slope2 - slope * Y2, E),)


def _linear_pieces(problem: SturmProblem, E: Expr, is_open: list[bool]) -> list[_LinearPiece]:
    """The stretches; none if one isn't linear, or q falls to -oo at one of the ends that are open."""
    x = problem.x
    heights = [piece.Q / piece.W for piece in problem.pieces]
    # A level is below the limits of Q/W, where there are some.
    limits = [limit for limit in compress((heights[0], heights[-1]), is_open) if not limit.has(x)]
    lines = []
    for piece, height in zip(problem.pieces, heights, strict=True):
        q = sympy.expand(piece.Q - E * piece.W)
        if not q.is_polynomial(x) or sympy.degree(q, x) > 1:
            return []
        is_barrier = not q.has(x) and any((height - limit).is_nonnegative for limit in limits)
        lines.append(_LinearPiece(piece.low, piece.high, q.coeff(x, 1), q.coeff(x, 0), piece.delta, is_barrier))
    outwards = compress((-lines[0].a, lines[-1].a), is_open)
    return lines if all(slope.is_nonnegative for slope in outwards) else []


def decay(problem: SturmProblem) -> tuple[Expr, Expr] | None:
    """The rate k and the distance d of exp(-k d), the only function that may decay, if Q and W are constant.

    Next to a delta function Y' changes by -k - k, its strength; next to a wall Y'/Y = +-k.  None for other problems.
    """
    x, first, last = problem.x, problem.pieces[0], problem.pieces[-1]
    is_constant = not (first.Q + first.W).has(x) and (first.Q, first.W) == (last.Q, last.W)
    walls = [side for side, end in enumerate(problem.ends) if end.is_finite]
    if not is_constant or len(problem.pieces) + len(walls) > 2 or len(walls) == 2:
        return None
    if not walls:
        return -last.delta / 2, sympy.Abs(x - last.low)
    inwards = 1 - 2 * walls[0]
    wish = problem.conditions[walls[0]]
    if not isinstance(wish, Robin):
        return None
    rate = sympy.S.Zero if wish.is_zero else inwards * wish.alpha / wish.beta
    return rate, inwards * (x - problem.ends[walls[0]])


def _middle(lines: list[_LinearPiece], problem: SturmProblem) -> Expr | None:
    """The point about which the problem is even, or None."""
    x = problem.x
    low, high = problem.ends
    if low.is_infinite != high.is_infinite or len({getattr(wish, "is_zero", None) for wish in problem.conditions}) > 1:
        return None
    middle = (lines[0].high + lines[-1].low) / 2 if low.is_infinite else (low + high) / 2
    deltas = {(line.low - middle, line.delta) for line in lines if line.delta != 0}
    if deltas != {(-distance, delta) for distance, delta in deltas}:
        return None
    for line, other in zip(lines, reversed(lines), strict=True):
        mirrored = line.a * (2 * middle - x) + line.b
        if line.low + other.high not in (2 * middle, sympy.nan) or sympy.expand(mirrored - other.a * x - other.b) != 0:
            return None
    return middle


#: Waves and exponentials, with their quotients.
_WAVES_WITH_QUOTIENTS = ((sympy.cos, sympy.sin, sympy.tan, sympy.cot), (sympy.cosh, sympy.sinh, sympy.tanh, sympy.coth))


def _zero_equation(function: Expr, E: Expr) -> Expr:
    """function = 0 without constant factors; for two terms with waves the shorter of k tan(k L) = ... and k cot(k L) = ..."""
    expression = function.as_independent(E, as_Add=False)[1]
    for first, second, quotient, inverse in _WAVES_WITH_QUOTIENTS:
        angles = {wave.args[0] for wave in expression.atoms(first, second)}
        if len(angles) != 1:
            continue
        (angle,) = angles
        cosine, sine = sympy.Dummy(), sympy.Dummy()
        waves = sympy.expand(expression.xreplace({first(angle): cosine, second(angle): sine}))
        c, s = waves.coeff(cosine), waves.coeff(sine)
        is_plain = c != 0 and s != 0 and (c / s).is_algebraic_expr(E)
        if is_plain and sympy.expand(waves - c * cosine - s * sine) == 0:
            k = angle.as_independent(E, as_Add=False)[1]
            forms = [(quotient, sympy.simplify(-c * k / s)), (inverse, sympy.simplify(-s * k / c))]
            form, right = min(forms, key=lambda form: sympy.count_ops(form[1]))
            return sympy.Eq(k * form(angle), right)
    constant, rest = expression.as_independent(E, as_Add=True)
    factor, rest = rest.as_independent(E, as_Add=False)
    return sympy.Eq(rest, sympy.simplify(-constant / factor))
