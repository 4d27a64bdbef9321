"""Sums of g(x) H(x - a) and g(x) delta^(n)(x - a) at constant points a: right-hand sides with jumps and impulses.

H(u)^n = H(u).  What holds at single points doesn't matter.  x is real.
"""

from __future__ import annotations

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


@dataclass(frozen=True)
class HeavisidePlace:
    """Where s (x - a) is zero: a, and the slope s."""

    a: Expr
    slope: Expr


def place_of(jump: Expr, x: Expr) -> HeavisidePlace | None:
    """That of a step or an impulse of s (x - a) with constants s and a, s real; None for another."""
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
    """The parts of a right-hand side; None where a jump isn't at a constant, or products of jumps aren't known."""
    terms = sympy.Add.make_args(sympy.expand(right))
    if len(terms) > _MOST_TERMS:
        return None
    parts: list[Apart] = []
    for term in terms:
        found = _term_apart(term, x)
        if found is None:
            return None
        parts.append(found)
    return _together(parts)


def _together(parts: Sequence[Apart]) -> Apart:
    """Their sum, with one step for each place."""
    plain = sympy.Add(*(part.plain for part in parts))
    steps: dict[Expr, Expr] = {}
    impulses: list[Impulse] = []
    for part in parts:
        impulses += part.impulses
        for step in part.steps:
            steps[step.a] = steps.get(step.a, sympy.Integer(0)) + step.g
    nonzero = tuple(HeavisideTerm(a, g) for a, g in steps.items() if g != 0)
    return Apart(plain, nonzero, tuple(impulses))


def _term_apart(term: Expr, x: Expr) -> Apart | None:
    """The same for a product: without jumps; g H H ... H, which begins with the last step; or g delta^(n) H ... H."""
    term = with_single_steps(term)
    jumps = [factor for factor in sympy.Mul.make_args(term) if factor.has(*JUMPING) and factor.has(x)]
    if not jumps:
        return Apart(term, (), ())
    last = _last_place(jumps, x)
    if last is None:
        return None
    g = term / sympy.Mul(*jumps)
    deltas = [jump for jump in jumps if isinstance(jump, DiracDelta)]
    if not deltas:
        return Apart(_NOTHING, (HeavisideTerm(last, g),), ())
    if len(deltas) > 1:
        return None
    steps = [jump for jump in jumps if jump not in deltas]
    return _impulses_beside_steps(g, deltas[0], steps, x)


def _impulses_beside_steps(g: Expr, delta: Expr, steps: Sequence[Expr], x: Expr) -> Apart | None:
    """g delta^(n) where all steps are 1, 0 where one is 0; None where that isn't known."""
    place = place_of(delta, x)
    assert place is not None
    is_on = _are_on(steps, x, place.a)
    if is_on is None:
        return None
    if not is_on:
        return Apart(_NOTHING, (), ())
    return Apart(_NOTHING, (), tuple(_impulses(g, delta, place, x)))


def _last_place(jumps: Sequence[Expr], x: Expr) -> Expr | None:
    """The last of the places of steps and impulses; None where it isn't known, or there are other jumps."""
    points = []
    for jump in jumps:
        if not isinstance(jump, Heaviside | DiracDelta):
            return None
        place = place_of(jump, x)
        if place is None:
            return None
        points.append(place.a)
    return _last(points)


def _last(places: Sequence[Expr]) -> Expr | None:
    """The largest of some real numbers, None where that isn't known: where the last of the steps is."""
    for place in places:
        if all((place - other).is_nonnegative for other in places):
            return place
    return None


def _are_on(steps: Sequence[Expr], x: Expr, a: Expr) -> bool | None:
    """Are all H(x - b) 1 at a; None where that isn't known, or a is such a b."""
    distances = [step.args[0].subs(x, a) for step in steps]
    if any(distance.is_negative for distance in distances):
        return False
    if all(distance.is_positive for distance in distances):
        return True
    return None


def _impulses(g: Expr, delta: Expr, place: HeavisidePlace, x: Expr) -> list[Impulse]:
    """g delta^(n) = sum of (-1)^k C(n, k) g^(k)(a) delta^(n - k), and delta^(n)(s u) = delta^(n)(u)/(|s| s^n)."""
    a = place.a
    n = int(delta.args[1]) if len(delta.args) > 1 else 0  # DiracDelta(u) is DiracDelta(u, 0)
    scale = abs(place.slope) * place.slope**n
    found = []
    for k in range(n + 1):
        strength = (-1) ** k * comb(n, k) * g.diff(x, k).subs(x, a) / scale
        if strength != 0:
            found.append(Impulse(a, n - k, strength))
    return found
