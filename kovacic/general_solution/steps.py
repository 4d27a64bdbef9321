"""Right-hand sides with jumps and impulses: sums of g(x) H(x - a) and g(x) delta^(n)(x - a) at constant points a.

Functions that jump, or whose slopes do, are sums of steps:

- |u| = u sign(u), sign(u) = 2 H(u) - 1, max(u, v) = v + (u - v) H(u - v).
- A function of a step is F(H) = F(0) + (F(1) - F(0)) H, and H(u)^n = H(u).
- Macaulay's bracket <u>^n is u^n H(u), and an impulse for n < 0.
- A function given by cases is the sum of its cases times their indicators.
- For a linear u, or a polynomial over Q, H(u) is a sum of H(x - a) over its zeros.

`_in_heavisides` has these identities.  What holds at single points doesn't matter.  x is real.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import comb
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside, exp
from sympy.logic.boolalg import And, Or
from sympy.solvers.inequalities import solve_poly_inequality

from kovacic.errors import InputError
from kovacic.general_solution.zero import samples

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
#: The largest degree of a polynomial whose sign is asked for.
_LARGEST_DEGREE = 8
#: Functions without singular points on the real line.
_ANALYTIC = (
    exp,
    sympy.sin,
    sympy.cos,
    sympy.sinh,
    sympy.cosh,
    sympy.tanh,
    sympy.sech,
    sympy.atan,
    sympy.asinh,
    sympy.erf,
    sympy.erfi,
    sympy.Si,
    sympy.airyai,
    sympy.airybi,
)


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


def jump_points(e: Expr, x: Expr) -> list[Expr]:
    """The places of the steps and impulses in an expression, each once."""
    places = (place_of(jump, x) for jump in sorted(e.atoms(Heaviside, DiracDelta), key=str))
    return [*dict.fromkeys(place.a for place in places if place is not None)]


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
        begin = _begin(jumps, x)
        g = term / sympy.Mul(*jumps)
        if not jumps:
            plain += term
        elif begin is None or len(deltas) > 1:
            return None
        elif not deltas:
            steps[begin] += g
        else:
            found = _impulses_beside_steps(g, deltas[0], [jump for jump in jumps if jump not in deltas], x)
            if found is None:
                return None
            impulses += found
    return Apart(plain, tuple(HeavisideTerm(a, g) for a, g in steps.items() if g != 0), tuple(impulses))


def _begin(jumps: Sequence[Expr], x: Expr) -> Expr | None:
    """The last of the places of the jumps: H(x - a) H(x - b) = H(x - b) for a <= b.

    None if one of them, or their order, isn't known.
    """
    places = []
    for jump in jumps:
        place = place_of(jump, x) if isinstance(jump, Heaviside | DiracDelta) else None
        # H(s (x - a)) is H(x - a) for s > 0 alone.
        if place is None or not (isinstance(jump, DiracDelta) or place.slope.is_positive):
            return None
        places.append(place.a)
    return next((a for a in places if all((a - other).is_nonnegative for other in places)), None)


def in_parts(right: Expr, x: Expr) -> Apart:
    """The parts of a right-hand side; all of it is plain where its jumps aren't known, as of |sin(x)|.

    Raises `NotImplementedError` where an impulse is among these.
    """
    found = taken_apart(in_steps(right, x), x) if right.has(*JUMPING) else None
    if found is None and right.has(DiracDelta):
        raise NotImplementedError("undecided: an impulse times a jump at the same point, or at one that isn't known")
    return Apart(right, (), ()) if found is None else found


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


# -------------------------------------------------------------------------------------------------- in terms of steps


def in_steps(right: Expr, x: Expr) -> Expr:
    """The right-hand side in terms of Heaviside(x - a) and DiracDelta(x - a, n) alone, as far as possible.

    >>> x = sympy.Symbol("x")
    >>> in_steps(abs(x - 1), x)
    2*x*Heaviside(x - 1) - x - 2*Heaviside(x - 1) + 1
    """
    found = right.replace(  # from the innermost ones outwards
        lambda e: isinstance(e, JUMPING) and e.has(x) and not _is_simple(e, x), lambda e: _rewritten(e, x)
    )
    if not found.has(*JUMPING):
        return found
    # sqrt(|x|) isn't analytic: sqrt(-x), which it is on one side, isn't real on the other
    outside = found.replace(lambda e: _is_function(e) and is_analytic(e, x), lambda e: _with_steps_outside(e, x))
    return with_single_steps(sympy.expand(outside))


def is_analytic(e: Expr, x: Expr) -> bool:
    """True if it is seen to be analytic on the whole line, on either side of its steps."""

    def keeps_analytic(part: Expr) -> bool:
        if part.is_Pow and part.exp.is_Integer:
            return bool(part.exp.is_positive)
        return part.is_Symbol or part.is_Add or part.is_Mul or isinstance(part, Heaviside) or _is_function(part)

    return all(keeps_analytic(part) for part in sympy.preorder_traversal(e) if part.has(x))


def _is_function(e: Expr) -> bool:
    """exp, sin and the like, or a power with a positive number for its base."""
    if e.is_Pow:
        return bool(e.base.is_positive and e.base.is_number)
    return isinstance(e, _ANALYTIC)


def _with_steps_outside(e: Expr, x: Expr) -> Expr:
    """F(H) = F(0) + (F(1) - F(0)) H, for one step after the other."""
    for step in sorted(e.atoms(Heaviside), key=str):
        if step.has(x):
            before = e.xreplace({step: sympy.Integer(0)})
            after = e.xreplace({step: sympy.Integer(1)})
            e = before + (after - before) * step
    return e


def _rewritten(jump: Expr, x: Expr) -> Expr:
    """A function that jumps in terms of H(x - a) and impulses alone; the same where that isn't known.

    Raises `InputError` where no case of one that is given by cases holds.
    """
    indicators = [_indicator(condition, x) for _, condition in jump.args] if isinstance(jump, sympy.Piecewise) else []
    if indicators and None not in indicators:  # with parameters that is tried at one value of each
        missing = _alone(indicators)[-1].subs(next(samples(jump.free_symbols - {x})))
        has_gap = any(on_piece(missing, x, point) != 0 for point in between(break_points(missing, x)))
        if has_gap or any(value is sympy.nan for value, _ in jump.args):
            raise InputError(f"{jump} has no value where no case holds", hint="add a last case, such as (0, True)")
    found = _at_points(jump, x)
    return found if all(_is_simple(e, x) for e in found.atoms(*JUMPING) if e.has(x)) else jump


def _at_points(jump: Expr, x: Expr) -> Expr:
    """In terms of H(x - a), and of other steps H(u) where the zeros of u aren't known."""

    def at_zeros(step: Expr) -> Expr:
        on = above(step.args[0], x)
        return step if on is None else on

    return _in_heavisides(jump, x).replace(lambda e: isinstance(e, Heaviside) and e.has(x), at_zeros)


def _in_heavisides(e: Expr, x: Expr) -> Expr:
    """A function that jumps in terms of H(u) and impulses; the same where that isn't known."""
    u = e.args[0]
    if isinstance(e, sympy.Abs):
        return u * (2 * Heaviside(u) - 1)
    if isinstance(e, sympy.sign):
        return 2 * Heaviside(u) - 1
    if isinstance(e, sympy.Max | sympy.Min):
        for other in e.args[1:]:
            advantage = u - other if isinstance(e, sympy.Max) else other - u
            u = other + (u - other) * Heaviside(advantage)
        return u
    if isinstance(e, sympy.SingularityFunction) and e.args[2].is_Integer:
        _, a, n = e.args
        return DiracDelta(u - a, -1 - n) if n < 0 else (u - a) ** n * Heaviside(u - a)
    if isinstance(e, sympy.Piecewise):
        indicators = [_indicator(condition, x) for _, condition in e.args]
        if None not in indicators:
            return sympy.Add(*(value * on for (value, _), on in zip(e.args, _alone(indicators), strict=False)))
    return Heaviside(u) if isinstance(e, Heaviside) else e


def _alone(indicators: Sequence[Expr]) -> list[Expr]:
    """Where a condition holds and none of those before; at the end, where none holds."""
    rest = sympy.Integer(1)
    found = []
    for on in indicators:
        found.append(on * rest)
        rest *= 1 - on
    return [*found, rest]


def _indicator(condition: Expr, x: Expr) -> Expr | None:
    """1 where a condition holds, and 0 where it doesn't, but for single points; None if that isn't known."""
    if condition in (True, False):
        return sympy.Integer(bool(condition))
    if not condition.has(x):
        return None
    if isinstance(condition, And | Or):
        parts = [_indicator(part, x) for part in condition.args]
        if None in parts:
            return None
        return sympy.Mul(*parts) if isinstance(condition, And) else 1 - _alone(parts)[-1]
    if isinstance(condition, sympy.Eq | sympy.Ne):
        return sympy.Integer(isinstance(condition, sympy.Ne))
    if isinstance(condition, sympy.core.relational.Relational):
        return Heaviside(condition.gts - condition.lts)
    return None


def _is_simple(e: Expr, x: Expr) -> bool:
    """True for H(x - a) and delta^(n)(x - a)."""
    if isinstance(e, DiracDelta):
        return True
    return isinstance(e, Heaviside) and e.args[0].diff(x) == 1


def above(u: Expr, x: Expr) -> Expr | None:
    """1 where u > 0 and 0 where u < 0; None if the zeros of u aren't known.

    >>> x = sympy.Symbol("x")
    >>> above(4 - x**2, x)
    -Heaviside(x - 2) + Heaviside(x + 2)
    """
    u = sympy.expand(u)
    if any(step.has(x) for step in u.atoms(Heaviside)):
        pieces = _with_steps_outside(Heaviside(u), x)
        known = {on: above(on.args[0], x) for on in pieces.atoms(Heaviside) if not _is_simple(on, x) and on.has(x)}
        apart = None if None in known.values() else taken_apart(pieces.xreplace(known), x)
        if apart is None:
            return None
        return sympy.Add(apart.plain, *(step.g * Heaviside(x - step.a) for step in apart.steps))
    slope = u.diff(x)
    if not slope.has(x) and (slope.is_positive or slope.is_negative):
        step = Heaviside(x - sympy.expand(x - u / slope))
        return step if slope.is_positive else 1 - step
    if not u.is_polynomial(x) or u.free_symbols != {x}:
        return None
    polynomial = sympy.Poly(u, x)
    if not (polynomial.domain.is_QQ or polynomial.domain.is_ZZ) or polynomial.degree() > _LARGEST_DEGREE:
        return None
    beyond = {-sympy.oo: sympy.Integer(1), sympy.oo: sympy.Integer(0)}
    ends = ((end.start, end.end) for end in solve_poly_inequality(polynomial, ">"))
    steps = [beyond.get(a, Heaviside(x - a)) - beyond.get(b, Heaviside(x - b)) for a, b in ends]
    return sympy.Add(*steps)


# ------------------------------------------------------------------------------------------------- between the jumps


def break_points(expression: Expr, x: Expr) -> list[Expr]:
    """The points where functions of an expression jump, as far as they are known, from left to right."""
    parts = sympy.Tuple(*(_at_points(e, x) for e in expression.atoms(*JUMPING) if e.has(x)))
    numbers = [point for point in jump_points(parts, x) if point.is_number and point.is_real]
    return sorted(numbers, key=lambda point: float(point.evalf()))


def between(breaks: Sequence[Expr]) -> list[Expr]:
    """A rational point between each two breaks, and one beyond them on either side."""
    if not breaks:
        return [sympy.Rational(41, 89)]
    values = [sympy.Rational(str(point.evalf(12))) for point in breaks]
    inner = [(3 * left + 2 * right) / 5 for left, right in pairwise(values)]
    return [values[0] - sympy.Rational(41, 89), *inner, values[-1] + sympy.Rational(23, 71)]


def on_piece(expression: Expr, x: Expr, point: Expr) -> Expr:
    """The expression near a rational point that is no break, without functions that jump there."""

    def near(jump: Expr) -> Expr:
        if isinstance(jump, DiracDelta):
            return sympy.Integer(0)
        if isinstance(jump, Heaviside):
            return (1 + sympy.sign(jump.args[0].subs(x, point))) / 2
        plain = _in_heavisides(jump, x)
        return jump if plain == jump else on_piece(plain, x, point)

    return expression.replace(lambda e: isinstance(e, JUMPING) and e.has(x), near)
