"""Sums of g(x) H(x - a) and g(x) delta^(n)(x - a) at constant points a: right-hand sides with jumps and impulses.

H(u)^n = H(u).  What holds at single points doesn't matter.  x is real.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside

Expr = Any  # SymPy publishes no types
#: The functions that jump, or whose slopes do.
JUMPING = (
    sympy.Piecewise,
    sympy.Max,
    sympy.Min,
    sympy.Abs,
    sympy.sign,
    sympy.SingularityFunction,
    Heaviside,
    DiracDelta,
)
#: The most terms that are treated.
_MOST_TERMS = 200
_NOTHING = sympy.Integer(0)


@dataclass(frozen=True)
class HeavisideTerm:
    """g(x) H(x - a)."""

    a: Expr
    g: Expr


@dataclass(frozen=True)
class Impulse:
    """strength * delta^(order)(x - a), with a constant strength."""

    a: Expr
    order: int
    strength: Expr


@dataclass(frozen=True)
class Apart:
    """A right-hand side as the sum of `plain`, which has no jumps, of steps and of impulses."""

    plain: Expr
    steps: tuple[HeavisideTerm, ...]
    impulses: tuple[Impulse, ...]

    @property
    def strengths(self) -> dict[Expr, dict[int, Expr]]:
        """Those of the impulses at each point, by their orders."""
        found: dict[Expr, dict[int, Expr]] = {impulse.a: {} for impulse in self.impulses}
        for impulse in self.impulses:
            here = found[impulse.a]
            here[impulse.order] = here.get(impulse.order, _NOTHING) + impulse.strength
        return found


@dataclass(frozen=True)
class HeavisidePlace:
    """Where s (x - a) is zero: a, and the slope s."""

    a: Expr
    slope: Expr


def place_of(jump: Expr, x: Expr) -> HeavisidePlace | None:
    """The place of a step or an impulse of s (x - a) with constants s and a, s real; None for others."""
    inner = jump.args[0]
    slope = inner.diff(x)
    if slope.has(x) or not slope.is_real or slope.is_zero is not False:
        return None
    return HeavisidePlace(sympy.expand(x - inner / slope), slope)


def with_single_steps(e: Expr) -> Expr:
    """H(u)^n = H(u)."""
    return e.replace(
        lambda power: power.is_Pow and isinstance(power.base, Heaviside) and power.exp.is_positive,
        lambda power: power.base,
    )


def taken_apart(right: Expr, x: Expr) -> Apart | None:
    """The parts of a right-hand side; None if a jump isn't at a constant, or products of jumps aren't known."""
    terms = sympy.Add.make_args(sympy.expand(right))
    if len(terms) > _MOST_TERMS:
        return None
    plain = _NOTHING
    steps: defaultdict[Expr, Expr] = defaultdict(lambda: _NOTHING)
    impulses: list[Impulse] = []
    for term in map(with_single_steps, terms):
        jumps = [factor for factor in sympy.Mul.make_args(term) if factor.has(*JUMPING) and factor.has(x)]
        deltas = [jump for jump in jumps if isinstance(jump, DiracDelta)]
        places = [place_of(jump, x) if isinstance(jump, Heaviside | DiracDelta) else None for jump in jumps]
        beside = zip(jumps, places, strict=True)
        # H(s (x - a)) is H(x - a) for s > 0 alone
        known = [place.a for jump, place in beside if place and (jump in deltas or place.slope.is_positive)]
        # H H ... H begins with the last of the steps
        last = next((a for a in known if all((a - other).is_nonnegative for other in known)), None)
        g = term / sympy.Mul(*jumps)
        if not jumps:
            plain += term
        elif last is None or len(known) < len(jumps) or len(deltas) > 1:
            return None
        elif not deltas:
            steps[last] += g
        else:
            found = _impulses_beside_steps(g, deltas[0], [jump for jump in jumps if jump not in deltas], x)
            if found is None:
                return None
            impulses += found
    return Apart(plain, tuple(HeavisideTerm(a, g) for a, g in steps.items() if g != 0), tuple(impulses))


def _impulses_beside_steps(g: Expr, delta: Expr, steps: Sequence[Expr], x: Expr) -> list[Impulse] | None:
    """g delta^(n) where all steps are 1, nothing where one is 0; None if that isn't known.

    g delta^(n) = sum of (-1)^k C(n, k) g^(k)(a) delta^(n - k), and delta^(n)(s u) = delta^(n)(u)/(|s| s^n).
    """
    place = place_of(delta, x)
    assert place is not None
    a = place.a
    distances = [step.args[0].subs(x, a) for step in steps]
    if any(distance.is_negative for distance in distances):
        return []
    if not all(distance.is_positive for distance in distances):
        return None
    n = int(delta.args[1]) if len(delta.args) > 1 else 0  # DiracDelta(u) is DiracDelta(u, 0)
    scale = abs(place.slope) * place.slope**n
    strengths = ((-1) ** k * comb(n, k) * g.diff(x, k).subs(x, a) / scale for k in range(n + 1))
    return [Impulse(a, n - k, strength) for k, strength in enumerate(strengths) if strength != 0]
