"""Right-hand sides with jumps and impulses at constant points: as sums of g(x) H(x - a) and g(x) delta^(n)(x - a).

|u| = u sign(u), sign(u) = 2 H(u) - 1, max(u, v) = v + (u - v) H(u - v); a function given by cases is the sum of its cases times
their indicators; H(u)^n = H(u).  For a linear u, or a polynomial over Q, H(u) is a sum of H(x - a) over its zeros.  What holds
at single points doesn't matter.  x is real.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside
from sympy.logic.boolalg import And, Or

Expr = Any  # SymPy publishes no types
#: The functions that jump, or whose slopes do.
JUMPING = (sympy.Piecewise, sympy.Max, sympy.Min, sympy.Abs, sympy.sign, Heaviside, DiracDelta)
#: The largest degree of a polynomial whose sign is asked for, and number of terms that are treated.
_LARGEST_DEGREE = 8
_MOST_TERMS = 200


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


def in_steps(right: Expr, x: Expr) -> Expr:
    """The same with Heaviside(x - a) and DiracDelta(x - a, n) alone, where that is possible; what isn't possible stays.

    >>> x = sympy.Symbol("x")
    >>> in_steps(abs(x - 1), x)
    2*x*Heaviside(x - 1) - x - 2*Heaviside(x - 1) + 1
    """
    found = right
    for _ in sympy.preorder_traversal(right):  # from the innermost ones outwards: not more often than there are parts
        changed = _innermost_rewritten(found, x)
        if not changed:
            break
        found = found.xreplace(changed)
    if not found.has(*JUMPING):
        return found
    return _with_single_steps(sympy.expand(found))


def _innermost_rewritten(e: Expr, x: Expr) -> dict[Expr, Expr]:
    """The innermost functions that jump, with what they are in terms of steps, where that is another expression."""
    changed = {}
    for jump in _innermost_jumps(e, x):
        other = _rewritten(jump, x)
        if other is not None and other != jump:
            changed[jump] = other
    return changed


def _with_single_steps(e: Expr) -> Expr:
    """H(u)^n = H(u)."""
    return e.replace(_is_power_of_step, lambda power: power.base)


def _innermost_jumps(e: Expr, x: Expr) -> list[Expr]:
    """The functions that jump and aren't simple, without those that have others within them."""
    jumping = [part for part in e.atoms(*JUMPING) if part.has(x) and not _is_simple(part, x)]
    inner = []
    for part in jumping:
        others = [other for other in jumping if other != part]
        if not part.has(*others):
            inner.append(part)
    return inner


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
    term = _with_single_steps(term)
    jumps = [factor for factor in sympy.Mul.make_args(term) if factor.has(*JUMPING) and factor.has(x)]
    if not jumps:
        return Apart(term, (), ())
    last = _last_place(jumps, x)
    if last is None:
        return None
    g = term / sympy.Mul(*jumps)
    deltas = [jump for jump in jumps if isinstance(jump, DiracDelta)]
    if not deltas:
        return Apart(sympy.Integer(0), (HeavisideTerm(last, g),), ())
    if len(deltas) > 1:
        return None
    steps = [jump for jump in jumps if jump not in deltas]
    return _impulses_beside_steps(g, deltas[0], steps, x)


def _impulses_beside_steps(g: Expr, delta: Expr, steps: Sequence[Expr], x: Expr) -> Apart | None:
    """g delta^(n) where all steps are 1, 0 where one is 0; None where that isn't known."""
    nothing = sympy.Integer(0)
    place = place_of(delta, x)
    assert place is not None
    is_on = _are_on(steps, x, place.a)
    if is_on is None:
        return None
    if not is_on:
        return Apart(nothing, (), ())
    return Apart(nothing, (), tuple(_impulses(g, delta, place, x)))


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


def _impulses(g: Expr, delta: Expr, place: HeavisidePlace, x: Expr) -> list[Impulse]:
    """g delta^(n) = sum of (-1)^k C(n, k) g^(k)(a) delta^(n - k), and delta^(n)(s u) = delta^(n)(u)/(|s| s^n)."""
    a = place.a
    n = _order(delta)
    scale = abs(place.slope) * place.slope**n
    found = []
    for k in range(n + 1):
        strength = (-1) ** k * comb(n, k) * g.diff(x, k).subs(x, a) / scale
        if strength != 0:
            found.append(Impulse(a, n - k, strength))
    return found


def _order(delta: Expr) -> int:
    """n of DiracDelta(u, n), which is DiracDelta(u) for 0."""
    if len(delta.args) == 1:
        return 0
    return int(delta.args[1])


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


# ---------------------------------------------------------------------------------------------------------- rewriting


def _is_simple(e: Expr, x: Expr) -> bool:
    """Is it H(x - a) or delta^(n)(x - a)?"""
    if isinstance(e, DiracDelta):
        return True
    return isinstance(e, Heaviside) and e.args[0].diff(x) == 1


def _is_power_of_step(e: Expr) -> bool:
    return bool(e.is_Pow and isinstance(e.base, Heaviside) and e.exp.is_positive)


def _rewritten(e: Expr, x: Expr) -> Expr | None:
    """One function that jumps in terms of steps; None where its zeros aren't known."""
    if isinstance(e, sympy.Piecewise):
        return _cases(e, x)
    if isinstance(e, sympy.Max | sympy.Min):
        return _extremum(e, x)
    on = above(e.args[0], x)
    if on is None or isinstance(e, Heaviside):
        return on
    sign = 2 * on - 1
    if isinstance(e, sympy.sign):
        return sign
    return e.args[0] * sign


def _extremum(e: Expr, x: Expr) -> Expr | None:
    """The largest or the smallest, of two after the other."""
    first, *others = e.args
    for other in others:
        difference = first - other if isinstance(e, sympy.Max) else other - first
        on = above(difference, x)
        if on is None:
            return None
        first = other + (first - other) * on
    return first


def _cases(e: Expr, x: Expr) -> Expr | None:
    """The sum of the cases times the indicators of their conditions, without those before."""
    total = sympy.Integer(0)
    rest = sympy.Integer(1)
    for value, condition in e.args:
        on = _indicator(condition, x)
        if on is None:
            return None
        total += value * on * rest
        rest *= 1 - on
    return total


def _indicator(condition: Expr, x: Expr) -> Expr | None:
    """1 where a condition holds, and 0 where it doesn't, but for single points."""
    if condition in (True, False):
        return sympy.Integer(bool(condition))
    if isinstance(condition, And | Or):
        return _joint_indicator(condition, x)
    if isinstance(condition, sympy.Eq | sympy.Ne) and condition.has(x):
        return sympy.Integer(isinstance(condition, sympy.Ne))
    if isinstance(condition, sympy.StrictGreaterThan | sympy.GreaterThan):
        return above(condition.lhs - condition.rhs, x)
    if isinstance(condition, sympy.StrictLessThan | sympy.LessThan):
        return above(condition.rhs - condition.lhs, x)
    return None


def _joint_indicator(condition: Expr, x: Expr) -> Expr | None:
    """Where all of the parts hold, or any."""
    parts: list[Any] = [_indicator(part, x) for part in condition.args]
    if None in parts:
        return None
    if isinstance(condition, And):
        return sympy.Mul(*parts)
    return 1 - sympy.Mul(*(1 - part for part in parts))


def above(u: Expr, x: Expr) -> Expr | None:
    """1 where u > 0 and 0 where u < 0; None where the zeros of u aren't known.

    >>> x = sympy.Symbol("x")
    >>> above(4 - x**2, x)
    -Heaviside(x - 2) + Heaviside(x + 2)
    """
    u = sympy.expand(u)
    steps = [step for step in u.atoms(Heaviside) if step.has(x)]
    if steps:
        return _above_in_pieces(u, sorted(steps, key=str), x)
    slope = u.diff(x)
    is_line = not slope.has(x)
    if is_line and slope.is_positive:
        return Heaviside(x - sympy.expand(x - u / slope))
    if is_line and slope.is_negative:
        return 1 - Heaviside(x - sympy.expand(x - u / slope))
    if not u.is_polynomial(x) or u.free_symbols != {x}:
        return None
    return _above_polynomial(sympy.Poly(u, x), x)


def _above_polynomial(u: Any, x: Expr) -> Expr | None:
    """For a polynomial over Q: a step at each zero of odd order."""
    is_rational = u.domain.is_QQ or u.domain.is_ZZ
    if not is_rational or u.degree() > _LARGEST_DEGREE:
        return None
    roots = sympy.real_roots(u, multiple=True)
    is_positive = u.LC() * (-1) ** u.degree() > 0  # far to the left
    total = sympy.Integer(bool(is_positive))
    crossings = [root for root in dict.fromkeys(roots) if roots.count(root) % 2]
    for root in crossings:
        if is_positive:
            total -= Heaviside(x - root)
        else:
            total += Heaviside(x - root)
        is_positive = not is_positive
    return total


def _above_in_pieces(u: Expr, steps: Sequence[Expr], x: Expr) -> Expr | None:
    """For u with steps at numbers: on each piece in turn."""
    places: dict[Expr, Expr] = {}
    for step in steps:
        place = place_of(step, x)
        if place is None or not place.a.is_number:
            return None
        places[step] = place.a
    breaks = sorted(set(places.values()), key=lambda point: float(point.evalf()))
    begins = [sympy.Integer(1), *(Heaviside(x - point) for point in breaks)]
    ends = [*begins[1:], sympy.Integer(0)]
    total = sympy.Integer(0)
    for k in range(len(breaks) + 1):
        passed = breaks[:k]
        values = {step: sympy.Integer(a in passed) for step, a in places.items()}
        on = above(u.xreplace(values), x)
        if on is None:
            return None
        total += (begins[k] - ends[k]) * on
    return _reduced(total, x)


def _reduced(total: Expr, x: Expr) -> Expr:
    """With single steps in the place of products of steps at numbers."""
    apart = taken_apart(total, x)
    assert apart is not None
    return sympy.Add(apart.plain, *(step.g * Heaviside(x - step.a) for step in apart.steps))


# ------------------------------------------------------------------------------------------------------------ one piece


def break_points(expression: Expr, x: Expr) -> list[Expr]:
    """The points where functions of an expression jump, as far as they are known."""
    found: dict[Expr, None] = {}
    for e in expression.atoms(*JUMPING):
        for u in _borders(e):
            found |= dict.fromkeys(_zeros(u, x))
    return [*found]


def _zeros(u: Expr, x: Expr) -> list[Expr]:
    """Where u changes its sign, as far as that is known."""
    if not u.has(x):
        return []
    on = above(u, x)
    if on is None:
        return []
    return [sympy.expand(x - step.args[0]) for step in on.atoms(Heaviside)]


def _borders(e: Expr) -> list[Expr]:
    """Expressions whose zeros separate the cases."""
    if isinstance(e, sympy.Max | sympy.Min):
        differences = []
        for k, first in enumerate(e.args):
            differences += [first - other for other in e.args[:k]]
        return differences
    if not isinstance(e, sympy.Piecewise):
        return [e.args[0]]
    relations = set().union(*(condition.atoms(sympy.core.relational.Relational) for _, condition in e.args))
    return [relation.lhs - relation.rhs for relation in relations]


def on_piece(expression: Expr, x: Expr, point: Expr) -> Expr:
    """What an expression is near a rational point that is no break: without functions that jump there."""
    return expression.replace(
        lambda e: isinstance(e, JUMPING) and e.has(x),
        lambda e: _branch(e, x, point),
    )


def _branch(e: Expr, x: Expr, point: Expr) -> Expr:
    """What one function that jumps is near the point."""
    if isinstance(e, sympy.Piecewise):
        return next(value for value, condition in e.args if condition.subs(x, point) == True)  # noqa: E712
    if isinstance(e, sympy.Max | sympy.Min):
        best = e.subs(x, point)
        return next(argument for argument in e.args if argument.subs(x, point) == best)
    if isinstance(e, DiracDelta):
        return sympy.Integer(0)
    sign = sympy.sign(e.args[0].subs(x, point))
    values = {Heaviside: (1 + sign) / 2, sympy.sign: sign, sympy.Abs: sign * e.args[0]}
    return values[e.func]
