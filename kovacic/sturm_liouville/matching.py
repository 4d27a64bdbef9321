"""Equations for the eigenvalues of a problem in pieces: solutions on both sides, matched.

On each stretch Y'' = q Y, where q = a x + b depends on E.  For a = 0 the solutions are waves and exponentials, else Airy's
functions of z = c (x + b/a) with c^3 = a, since then c^2 z = q.  At an infinite end the decaying solution is meant, at a finite
one that with the condition there.  (Y, Y') is carried from the left end through the stretches, and E is an eigenvalue where it
is a multiple of the solution that is meant at the right end.  If q is even about the middle, Y is even or odd, so that Y' or Y
vanishes there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.sturm_liouville.problem import Robin, SturmProblem

Expr = Any


@dataclass(frozen=True)
class _LinearPiece:
    """Y'' = (a x + b) Y between two points."""

    low: Expr
    high: Expr
    a: Expr
    b: Expr

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
        if self.a == 0:
            k = sympy.sqrt(-self.b)
            cosine, sine = (f(k * (self.high - self.low)) for f in (sympy.cos, sympy.sin))
            return Y * cosine + slope * sine / k, slope * cosine - k * Y * sine
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
    for piece in problem.pieces:
        q = sympy.expand(piece.Q - E * piece.W)
        if not q.is_polynomial(x) or sympy.degree(q, x) > 1:
            return ()
        lines.append(_LinearPiece(piece.low, piece.high, q.coeff(x, 1), q.coeff(x, 0)))
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
    if middle is not None:
        return _equation(slope, E), _equation(Y, E)
    return (_equation(Y * ends[1][1] - slope * ends[1][0], E),)


def _middle(lines: list[_LinearPiece], problem: SturmProblem) -> Expr | None:
    """The point about which the problem is even, or None."""
    x = problem.x
    low, high = problem.ends
    if low.is_infinite != high.is_infinite or len({getattr(wish, "is_zero", None) for wish in problem.conditions}) > 1:
        return None
    middle = (lines[0].high + lines[-1].low) / 2 if low.is_infinite else (low + high) / 2
    for line, other in zip(lines, reversed(lines), strict=True):
        mirrored = line.a * (2 * middle - x) + line.b
        if line.low + other.high not in (2 * middle, sympy.nan) or sympy.expand(mirrored - other.a * x - other.b) != 0:
            return None
    return middle


def _equation(function: Expr, E: Expr) -> Expr:
    """function = 0 without constant factors; for two terms with waves k tan(k L) = ... or k cot(k L) = ..., what is shorter."""
    expression = function.as_independent(E, as_Add=False)[1]
    angles = {wave.args[0] for wave in expression.atoms(sympy.cos, sympy.sin)}
    if len(angles) == 1:
        (angle,) = angles
        cosine, sine = sympy.Dummy(), sympy.Dummy()
        waves = sympy.expand(expression.xreplace({sympy.cos(angle): cosine, sympy.sin(angle): sine}))
        c, s = waves.coeff(cosine), waves.coeff(sine)
        is_plain = c != 0 and s != 0 and (c / s).is_algebraic_expr(E)
        if is_plain and sympy.expand(waves - c * cosine - s * sine) == 0:
            k = angle.as_independent(E, as_Add=False)[1]
            forms = [(sympy.tan, sympy.simplify(-c * k / s)), (sympy.cot, sympy.simplify(-s * k / c))]
            form, right = min(forms, key=lambda form: sympy.count_ops(form[1]))
            return sympy.Eq(k * form(angle), right)
    return sympy.Eq(expression, 0)
