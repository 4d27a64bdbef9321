"""Right-hand sides with step functions and impulses: what happens at a point a, and nothing before it.

With W = y1 y2' - y1' y2 and the kernel K(x, a) = (y1(a) y2(x) - y2(a) y1(x))/W(a), the solution of y'' + b y' + c y = 0 with
K = 0 and K' = 1 at x = a, a solution for

    g(x) delta(x - a)  is  H(x - a) g(a) K(x, a),                                                                    (1)
    g(x) H(x - a)      is  H(x - a) (p(x) - p(a) K1(x) - p'(a) K(x, a)),                                             (2)

where p is any solution for g, and K1 that of the homogeneous equation with K1 = 1, K1' = 0 at x = a.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside

from kovacic.general_solution.initial_values import tidy, value_at
from kovacic.general_solution.variation import Basis

Expr = Any  # SymPy publishes no types


def response(right: Expr, basis: Basis, solved: Callable[[Expr], Expr]) -> Expr | None:
    """A solution for a right-hand side with steps and impulses at constant points, None for one of another form.

    `solved` gives a solution for a right-hand side without them.
    """
    right, x = sympy.expand(right), basis.x
    plain, total = [], sympy.Integer(0)
    for term in sympy.Add.make_args(_separated(right, x)):
        jumps = [f for f in sympy.Mul.make_args(term) if f.func in (DiracDelta, Heaviside) and f.has(x)]
        if not jumps:
            plain.append(term)
            continue
        g = term / jumps[0]
        place = place_of(jumps[0], x)
        if len(jumps) != 1 or place is None or g.has(DiracDelta, Heaviside):
            return None
        a, slope = place
        u, v, du, dv = (value_at(y, x, a, order) for order in (0, 1) for y in (basis.y1, basis.y2))
        wronskian = tidy(basis.wronskian.subs(x, a))
        if wronskian.has(sympy.nan, sympy.zoo, sympy.oo) or wronskian == 0:
            return None

        def with_values(value: Expr, rate: Expr) -> Expr:
            """The homogeneous solution with these values at a."""
            first, second = (value * dv - rate * v) / wronskian, (rate * u - value * du) / wronskian  # noqa: B023
            return tidy(first) * basis.y1 + tidy(second) * basis.y2

        if jumps[0].func is DiracDelta:
            total += Heaviside(x - a) * sympy.powsimp(with_values(0, g.subs(x, a) / abs(slope)))
        else:
            p = solved(g)
            total += Heaviside(x - a) * sympy.powsimp(p - with_values(value_at(p, x, a), value_at(p, x, a, 1)))
    rest = sympy.Add(*plain)
    return total + (solved(rest) if rest != 0 else 0)


def place_of(jump: Expr, x: Expr) -> tuple[Expr, Expr] | None:
    """(a, s) for a step or an impulse of s (x - a) with numbers s and a; s > 0 for a step."""
    inner = jump.args[0]
    slope = inner.diff(x)
    if slope.has(x) or not slope.is_real or (jump.func is DiracDelta and len(jump.args) > 1 and jump.args[1] != 0):
        return None
    return sympy.expand(x - inner / slope), slope


def _separated(right: Expr, x: Expr) -> Expr:
    """With H(a - x) as 1 - H(x - a), and products of steps at different numbers as single ones."""

    def upward(step: Expr) -> Expr:
        slope = step.args[0].diff(x)
        if slope.has(x) or slope == 0 or not slope.is_real:
            return step
        at = Heaviside(x - sympy.expand(x - step.args[0] / slope))
        return at if slope.is_positive else 1 - at

    right = sympy.expand(right.xreplace({step: upward(step) for step in right.atoms(Heaviside)}))

    def last(product: Expr) -> Expr:
        steps = [f.base if f.is_Pow else f for f in product.args if (f.base if f.is_Pow else f).func is Heaviside]
        if not steps or (len(steps) == 1 and steps[0] in product.args) or any(s.free_symbols != {x} for s in steps):
            return product
        late = max(steps, key=lambda step: (x - step.args[0]).evalf())
        return sympy.Mul(*(f for f in product.args if (f.base if f.is_Pow else f).func is not Heaviside), late)

    return sympy.Add(*(last(term) if term.is_Mul else term for term in sympy.Add.make_args(right)))
