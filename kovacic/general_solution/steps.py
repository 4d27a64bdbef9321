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
    for _ in range(sum(1 for _ in sympy.preorder_traversal(right))):
        changed = {}
        for e in _innermost_jumps(found, x):
            other = _rewritten(e, x)
            if other is not None and other != e:
                changed[e] = other
        if not changed:
            break
        found = found.xreplace(changed)
    if not found.has(*JUMPING):
        return found
    return sympy.expand(found).replace(_is_power_of_step, lambda power: power.base)


def _innermost_jumps(e: Expr, x: Expr) -> list[Expr]:
    """The functions that jump and aren't simple, without those that have others within them."""
    jumping = [part for part in e.atoms(*JUMPING) if part.has(x) and not _is_simple(part, x)]
    inner = []
    for part in jumping:
        others = [other for other in jumping if other != part]
        if not any(part.has(other) for other in others):
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
    plain: list[Expr] = []
    steps: dict[Expr, Expr] = {}
    impulses: list[Impulse] = []
    for term in terms:
        found = _term_apart(term, x)
        if found is None:
            return None
        plain.append(found.plain)
        impulses += found.impulses
        for step in found.steps:
            steps[step.a] = steps.get(step.a, sympy.Integer(0)) + step.g
    nonzero = tuple(HeavisideTerm(a, g) for a, g in steps.items() if g != 0)
    return Apart(sympy.Add(*plain), nonzero, tuple(impulses))


def _term_apart(term: Expr, x: Expr) -> Apart | None:
    """The same for a product: without jumps; g H H ... H, which begins with the last step; or g delta^(n) H ... H."""
    nothing = sympy.Integer(0)
    term = term.replace(_is_power_of_step, lambda power: power.base)
    jumps = [f for f in sympy.Mul.make_args(term) if f.has(*JUMPING) and f.has(x)]
    if not jumps:
        return Apart(term, (), ())
    deltas = [f for f in jumps if isinstance(f, DiracDelta)]
    last = _last_place(jumps, x)
    if last is None or len(deltas) > 1:
        return None
    g = term / sympy.Mul(*jumps)
    if not deltas:
        return Apart(nothing, (HeavisideTerm(last, g),), ())
    (delta,) = deltas
    place = place_of(delta, x)
    assert place is not None
    is_on = _are_on([f for f in jumps if f is not delta], x, place.a)
    if is_on is None:
        return None
    return Apart(nothing, (), tuple(_impulses(g, delta, place, x)) if is_on else ())


def _last_place(jumps: Sequence[Expr], x: Expr) -> Expr | None:
    """The last of the places of steps and impulses; None where it isn't known, or there are other jumps."""
    points = []
    for jump in jumps:
        place = place_of(jump, x) if isinstance(jump, Heaviside | DiracDelta) else None
        if place is None:
            return None
        points.append(place.a)
    return _last(points)


def _impulses(g: Expr, delta: Expr, place: HeavisidePlace, x: Expr) -> list[Impulse]:
    """g delta^(n) = sum of (-1)^k C(n, k) g^(k)(a) delta^(n - k), and delta^(n)(s u) = delta^(n)(u)/(|s| s^n)."""
    a = place.a
    n = int(delta.args[1]) if len(delta.args) > 1 else 0
    scale = abs(place.slope) * place.slope**n
    found = []
    for k in range(n + 1):
        strength = (-1) ** k * comb(n, k) * g.diff(x, k).subs(x, a) / scale
        if strength != 0:
            found.append(Impulse(a, n - k, strength))
    return found


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
    if on is None:
        return None
    if isinstance(e, Heaviside):
        return on
    sign = 2 * on - 1
    return sign if isinstance(e, sympy.sign) else e.args[0] * sign


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
        return sympy.Integer(1 if condition else 0)
    if isinstance(condition, And | Or):
        return _joint_indicator(condition, x)
    if isinstance(condition, sympy.Eq | sympy.Ne) and condition.has(x):
        return sympy.Integer(1 if isinstance(condition, sympy.Ne) else 0)
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
    steps = sorted((f for f in u.atoms(Heaviside) if f.has(x)), key=str)
    if steps:
        return _above_in_pieces(u, steps, x)
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
    total = sympy.Integer(1 if is_positive else 0)
    for root in dict.fromkeys(roots):
        if roots.count(root) % 2:
            step = Heaviside(x - root)
            total += -step if is_positive else step
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
        values = {step: sympy.Integer(1 if a in passed else 0) for step, a in places.items()}
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
    found = []
    for e in expression.atoms(*JUMPING):
        for u in _borders(e):
            on = above(u, x) if u.has(x) else None
            if on is not None:
                found += [x - step.args[0] for step in on.atoms(Heaviside)]
    return [*dict.fromkeys(map(sympy.expand, found))]


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

    def branch(e: Expr) -> Expr:
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

    return expression.replace(lambda e: isinstance(e, JUMPING) and e.has(x), branch)
