"""Eigenvalues as formulas: boundary problems that are y'' + mu y = 0 on an interval after Liouville's transformation.

With Y'' = (Q - E W) Y, t = int sqrt(W) dx from the left end and Y = W^(-1/4) v it is v'' = (q - E) v, q = Q/W - W^(-3/4)
(W^(-1/4))''.  Where q is a constant, v is a combination of cos(k t) and sin(k t), k = sqrt(E - q): so for constant
coefficients, Euler's equation and others.  With h = y/v a condition alpha y + beta y' = 0 is (alpha + beta h'/h) v
+ beta t' v_t = 0.

A problem in pieces has an equation for its eigenvalues: solutions on both sides, matched;
at c delta(x - p), Y' grows by c Y(p).  On each stretch Y'' = q Y, where q =
a x + b depends on E.  For a = 0 the solutions are waves and exponentials, else Airy's functions of z = c (x + b/a) with c^3 =
a, since then c^2 z = q.  At an infinite end the decaying solution is meant, at a finite one that with the condition there.  (Y,
Y') is carried from the left end through the stretches, and E is an eigenvalue where it is a multiple of the solution that is
meant at the right end.  If q is even about the middle, Y is even or odd, so that Y' or Y vanishes there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
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
    """The eigenvalues of y'' + B y' + (c0 + parameter c1) y = 0, or None if this isn't such a problem.

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
    if 0 in left and 0 in right:  # else the equation for k is transcendental
        vanishes = left[1] == 0
        first, angle = (int(vanishes), n * sympy.pi) if vanishes == (right[1] == 0) else (1, (2 * n - 1) * sympy.pi / 2)
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
    h = sympy.powsimp(sympy.simplify(f * sympy.exp(exponent))).as_independent(X, as_Add=False)[1]
    t = sympy.simplify(primitive - primitive.subs(X, bounds[0]))
    t, h, q = (e.xreplace(back) for e in (t, h, q))
    return _Waves(x, t, h, q, ends)


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


@dataclass(frozen=True)
class _LinearPiece:
    """Y'' = (a x + b) Y between two points; Y' grows by delta Y at the first.  At a barrier a = 0, and b > 0 for each level."""

    low: Expr
    high: Expr
    a: Expr
    b: Expr
    delta: Expr = sympy.S.Zero
    is_barrier: bool = False

    def airy(self, x: Expr, first: Any, second: Any) -> tuple[Expr, Expr, Expr]:
        """Two of Airy's functions at x, and dz/dx."""
        c = sympy.real_root(self.a, 3)
        z = sympy.expand(c * (x + self.b / self.a))
        return first(z), second(z), c

    def decaying(self, x: Expr, side: int) -> tuple[Expr, Expr]:
        """(Y, Y') at x of the solution that decays at -oo (side 0) or oo (side 1)."""
        if self.a == 0:
            rate = sympy.sqrt(self.b)
            return sympy.S.One, rate if side == 0 else -rate
        Y, slope, c = self.airy(x, sympy.airyai, sympy.airyaiprime)
        return Y, c * slope

    def carried(self, start: tuple[Expr, Expr]) -> tuple[Expr, Expr]:
        """(Y, Y') at the high end, from those at the low one."""
        Y, slope = start
        slope += self.delta * Y
        if self.a == 0:
            sign, functions = (1, (sympy.cosh, sympy.sinh)) if self.is_barrier else (-1, (sympy.cos, sympy.sin))
            k = sympy.sqrt(sign * self.b)
            cosine, sine = (f(k * (self.high - self.low)) for f in functions)
            return Y * cosine + slope * sine / k, slope * cosine + sign * k * Y * sine
        Ai, dAi, c = self.airy(self.low, sympy.airyai, sympy.airyaiprime)
        Bi, dBi, _ = self.airy(self.low, sympy.airybi, sympy.airybiprime)
        first, second = Y * dBi - slope * Bi / c, slope * Ai / c - Y * dAi  # times 1/pi, the Wronskian of Ai and Bi
        Ai, dAi, c = self.airy(self.high, sympy.airyai, sympy.airyaiprime)
        Bi, dBi, _ = self.airy(self.high, sympy.airybi, sympy.airybiprime)
        return first * Ai + second * Bi, c * (first * dAi + second * dBi)


def matching_equations(problem: SturmProblem, E: Expr) -> tuple[Expr, ...]:
    """The equation for E, or those for even and for odd eigenfunctions; () if a stretch isn't linear, or q falls to -oo.

    >>> from kovacic.sturm_liouville.problem import Stretch
    >>> x, E = sympy.symbols("x E")
    >>> stretches = Stretch(-sympy.oo, sympy.S.Zero, -x, sympy.S.One), Stretch(sympy.S.Zero, sympy.oo, x, sympy.S.One)
    >>> matching_equations(SturmProblem(x, stretches), E)
    (Eq(airyaiprime(-E), 0), Eq(airyai(-E), 0))
    """
    x = problem.x
    lines = []
    # A level is below the limits of Q/W, where there are some.
    outer = [
        piece.Q / piece.W
        for piece, end in zip((problem.pieces[0], problem.pieces[-1]), problem.ends, strict=True)
        if end.is_infinite
    ]
    for piece in problem.pieces:
        q = sympy.expand(piece.Q - E * piece.W)
        if not q.is_polynomial(x) or sympy.degree(q, x) > 1:
            return ()
        is_barrier = not q.has(x) and any(
            (piece.Q / piece.W - limit).is_nonnegative for limit in outer if not limit.has(x)
        )
        lines.append(_LinearPiece(piece.low, piece.high, q.coeff(x, 1), q.coeff(x, 0), piece.delta, is_barrier))
    outwards = (-lines[0].a, lines[-1].a)
    falls = [end.is_infinite and not slope.is_nonnegative for end, slope in zip(problem.ends, outwards, strict=True)]
    first, last = (end.is_infinite for end in problem.ends)
    if any(falls) or (first and last and len(lines) == 1):
        return ()
    inner = lines[int(first) : len(lines) - int(last)]
    ends = []
    for side, condition in enumerate(problem.conditions):
        if isinstance(condition, Robin):
            ends.append((condition.beta, -condition.alpha))
        else:
            ends.append(lines[-side].decaying((lines[0].high, lines[-1].low)[side], side))
    Y, slope = ends[0]
    middle = _middle(lines, problem)
    if middle is not None:
        inner = [replace(line, high=sympy.Min(line.high, middle)) for line in inner if line.low < middle]
    for line in inner:
        Y, slope = line.carried((Y, slope))
    if middle is not None:  # an even Y' changes its sign there, by the delta function
        half = sum((line.delta for line in lines if line.low == middle), sympy.S.Zero) / 2
        found = _zero_equation(slope + half * Y, E), _zero_equation(Y, E)
        return tuple(equation for equation in found if equation != sympy.false)
    slope += lines[-1].delta * Y if last else 0
    return (_zero_equation(Y * ends[1][1] - slope * ends[1][0], E),)


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
_WAVES = ((sympy.cos, sympy.sin, sympy.tan, sympy.cot), (sympy.cosh, sympy.sinh, sympy.tanh, sympy.coth))


def _zero_equation(function: Expr, E: Expr) -> Expr:
    """function = 0 without constant factors; for two terms with waves k tan(k L) = ... or k cot(k L) = ..., what is shorter."""
    expression = function.as_independent(E, as_Add=False)[1]
    for first, second, quotient, inverse in _WAVES:
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
