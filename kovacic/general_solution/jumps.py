"""Functions that jump, or whose slopes do, as sums of steps H(x - a); and what they are between the jumps.

- |u| = u sign(u), sign(u) = 2 H(u) - 1, max(u, v) = v + (u - v) H(u - v).
- A function of a step is F(H) = F(0) + (F(1) - F(0)) H.
- Macaulay's bracket <u>^n is u^n H(u), and an impulse for n < 0.
- A function given by cases is the sum of its cases times their indicators.
- For a linear u, or a polynomial over Q, H(u) is a sum of H(x - a) over its zeros.

`_KINDS`, at the end, has what is done with each of these functions.  What holds at single points doesn't matter.  x is real.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside, exp
from sympy.logic.boolalg import And, Or

from kovacic.errors import InputError
from kovacic.general_solution.steps import JUMPING, place_of, taken_apart, with_single_steps

Expr = Any  # SymPy publishes no types
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
)


@dataclass(frozen=True)
class _Kind:
    """What is done with functions of these classes."""

    classes: tuple[Any, ...]
    #: The function of x in terms of steps; None where the zeros of its parts aren't known.
    in_steps: Callable[[Expr, Expr], Expr | None]
    #: Expressions whose zeros separate the cases.
    borders: Callable[[Expr], list[Expr]]
    #: What the function of x is near a rational point that is no break.
    near: Callable[[Expr, Expr, Expr], Expr]


def _kind(e: Expr) -> _Kind:
    """That of a function that jumps."""
    return next(kind for kind in _KINDS if isinstance(e, kind.classes))


# ------------------------------------------------------------------------------------------------------ in terms of steps


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
    outside = found.replace(lambda e: _is_function_of_steps(e, x), lambda e: _with_steps_outside(e, x))
    return with_single_steps(sympy.expand(outside))


def _is_function_of_steps(e: Expr, x: Expr) -> bool:
    """Is it a function of something with a step inside, analytic on the whole line on either side of the step?

    sqrt(|x|) isn't: sqrt(-x), which it is on one side, isn't real on the other.
    """
    if not _is_function(e) or not any(step.has(x) for step in e.atoms(Heaviside)):
        return False
    return all(_keeps_analytic(part) for part in sympy.preorder_traversal(e) if part.has(x))


def _is_function(e: Expr) -> bool:
    """exp, sin and the like, or a power with a positive number for its base."""
    if e.is_Pow:
        return bool(e.base.is_positive and e.base.is_number)
    return isinstance(e, _ANALYTIC)


def _keeps_analytic(e: Expr) -> bool:
    """Is it analytic on the whole line where its arguments are?  A step is a constant on either side."""
    if e.is_Pow and e.exp.is_Integer:
        return bool(e.exp.is_positive)
    return e.is_Symbol or e.is_Add or e.is_Mul or isinstance(e, Heaviside) or _is_function(e)


def _with_steps_outside(e: Expr, x: Expr) -> Expr:
    """F(H) = F(0) + (F(1) - F(0)) H, for one step after the other."""
    for step in sorted(e.atoms(Heaviside), key=str):
        if step.has(x):
            before = e.xreplace({step: sympy.Integer(0)})
            after = e.xreplace({step: sympy.Integer(1)})
            e = before + (after - before) * step
    return e


def _innermost_rewritten(e: Expr, x: Expr) -> dict[Expr, Expr]:
    """The innermost functions that jump, with what they are in terms of steps, where that is another expression."""
    changed = {}
    for jump in _innermost_jumps(e, x):
        other = _kind(jump).in_steps(jump, x)
        if other is not None and other != jump:
            changed[jump] = other
    return changed


def _innermost_jumps(e: Expr, x: Expr) -> list[Expr]:
    """The functions that jump and aren't simple, without those that have others within them."""
    jumping = [part for part in e.atoms(*JUMPING) if part.has(x) and not _is_simple(part, x)]
    inner = []
    for part in jumping:
        others = [other for other in jumping if other != part]
        if not part.has(*others):
            inner.append(part)
    return inner


def _is_simple(e: Expr, x: Expr) -> bool:
    """Is it H(x - a) or delta^(n)(x - a)?"""
    if isinstance(e, DiracDelta):
        return True
    return isinstance(e, Heaviside) and e.args[0].diff(x) == 1


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
    apart = taken_apart(total, x)  # with single steps in the place of products of steps at numbers
    assert apart is not None
    return sympy.Add(apart.plain, *(step.g * Heaviside(x - step.a) for step in apart.steps))


# ------------------------------------------------------------------------------------------------- between the jumps


def break_points(expression: Expr, x: Expr) -> list[Expr]:
    """The points where functions of an expression jump, as far as they are known."""
    found: dict[Expr, None] = {}
    for e in expression.atoms(*JUMPING):
        for u in _kind(e).borders(e):
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


def on_piece(expression: Expr, x: Expr, point: Expr) -> Expr:
    """What an expression is near a rational point that is no break: without functions that jump there."""
    return expression.replace(
        lambda e: isinstance(e, JUMPING) and e.has(x),
        lambda e: _kind(e).near(e, x, point),
    )


# ------------------------------------------------------------------------------------------------------------- steps


def _argument(e: Expr) -> list[Expr]:
    return [e.args[0]]


# ---------------------------------------------------------------------------------------------------- signs and moduli


def _sign(e: Expr, x: Expr) -> Expr | None:
    """sign(u) = 2 H(u) - 1."""
    on = above(e.args[0], x)
    if on is None:
        return None
    return 2 * on - 1


def _sign_near(e: Expr, x: Expr, point: Expr) -> Expr:
    return sympy.sign(e.args[0].subs(x, point))


def _modulus(e: Expr, x: Expr) -> Expr | None:
    """|u| = u sign(u)."""
    sign = _sign(e, x)
    if sign is None:
        return None
    return e.args[0] * sign


# ------------------------------------------------------------------------------------------------- Macaulay's brackets


def _bracket(e: Expr, x: Expr) -> Expr | None:
    """<u - a>^n = (u - a)^n H(u - a) for n = 0, 1, 2, ..., and delta^(-1-n)(u - a) for n = -1, -2, ..."""
    (u,) = _distance(e)
    n = e.args[2]
    if not n.is_Integer:
        return None
    if n < 0:
        return DiracDelta(u, -1 - n)
    on = above(u, x)
    if on is None:
        return None
    return u**n * on


def _bracket_near(e: Expr, x: Expr, point: Expr) -> Expr:
    (u,) = _distance(e)
    n = e.args[2]
    if n.is_negative:
        return sympy.Integer(0)
    return u**n * (1 + sympy.sign(u.subs(x, point))) / 2


def _distance(e: Expr) -> list[Expr]:
    return [e.args[0] - e.args[1]]


# ------------------------------------------------------------------------------------------------------------- impulses


# -------------------------------------------------------------------------------------------------- largest and smallest


def _extremum(e: Expr, x: Expr) -> Expr | None:
    """The largest or the smallest, of two after the other."""
    best, *others = e.args
    for other in others:
        advantage = best - other if isinstance(e, sympy.Max) else other - best
        on = above(advantage, x)
        if on is None:
            return None
        best = other + (best - other) * on
    return best


def _differences(e: Expr) -> list[Expr]:
    found = []
    for k, first in enumerate(e.args):
        found += [first - other for other in e.args[:k]]
    return found


def _extremum_near(e: Expr, x: Expr, point: Expr) -> Expr:
    best = e.subs(x, point)
    return next(argument for argument in e.args if argument.subs(x, point) == best)


# ---------------------------------------------------------------------------------------------------------------- cases


def _cases(e: Expr, x: Expr) -> Expr | None:
    """The sum of the cases times the indicators of their conditions, without those before.

    Raises `InputError` where the function has no value, because no case holds.
    """
    if not _has_a_case_everywhere(e, x):
        raise InputError(f"{e} has no value where no case holds", hint="add a last case, such as (0, True)")
    total = sympy.Integer(0)
    rest = sympy.Integer(1)
    for value, condition in e.args:
        on = _indicator(condition, x)
        if on is None:
            return None
        total += value * on * rest
        rest *= 1 - on
    return total


def _has_a_case_everywhere(e: Expr, x: Expr) -> bool:
    """Does some condition hold at each x, but for single points?  With parameters that is tried at one value of each."""
    if any(value is sympy.nan for value, _ in e.args):
        return False
    values = {parameter: _some_value(parameter) for parameter in e.free_symbols - {x}}
    somewhere = sympy.Or(*(condition for _, condition in e.args)).subs(values)
    if somewhere in (True, False):
        return bool(somewhere)
    borders = set().union(*(sympy.solve(border.subs(values), x) for border in _borders_of_cases(e)))
    ordered = sorted(border for border in borders if border.is_real)
    if not ordered:
        return True
    between = [(left + right) / 2 for left, right in pairwise(ordered)]  # where conditions are constant
    points = [ordered[0] - 1, *between, ordered[-1] + 1]
    return all(somewhere.subs(x, point) != sympy.false for point in points)


def _some_value(parameter: Expr) -> Expr:
    """A number that the parameter may be."""
    size = sympy.Integer(2) if parameter.is_integer else sympy.Rational(7, 5)
    return -size if parameter.is_negative else size


def _borders_of_cases(e: Expr) -> list[Expr]:
    relations = set().union(*(condition.atoms(sympy.core.relational.Relational) for _, condition in e.args))
    return [relation.lhs - relation.rhs for relation in relations]


def _case_near(e: Expr, x: Expr, point: Expr) -> Expr:
    """The cases of which one holds everywhere."""
    return next(value for value, condition in e.args if condition.subs(x, point) == sympy.true)


def _indicator(condition: Expr, x: Expr) -> Expr | None:
    """1 where a condition holds, and 0 where it doesn't, but for single points; None where that isn't known."""
    if condition in (True, False):
        return sympy.Integer(bool(condition))
    if isinstance(condition, And):
        return _product(_indicator(part, x) for part in condition.args)
    if isinstance(condition, Or):
        return _complement(_product(_complement(_indicator(part, x)) for part in condition.args))
    if isinstance(condition, sympy.Eq | sympy.Ne) and condition.has(x):
        return sympy.Integer(isinstance(condition, sympy.Ne))
    if isinstance(condition, sympy.StrictGreaterThan | sympy.GreaterThan):
        return above(condition.lhs - condition.rhs, x)
    if isinstance(condition, sympy.StrictLessThan | sympy.LessThan):
        return above(condition.rhs - condition.lhs, x)
    return None


def _complement(on: Expr | None) -> Expr | None:
    """That of the opposite."""
    if on is None:
        return None
    return 1 - on


def _product(indicators: Iterable[Expr | None]) -> Expr | None:
    """Where all of the conditions hold; None where one isn't known."""
    known = [*indicators]
    if None in known:
        return None
    return sympy.Mul(*known)


_KINDS = (
    _Kind((sympy.Piecewise,), _cases, _borders_of_cases, _case_near),
    _Kind((sympy.Max, sympy.Min), _extremum, _differences, _extremum_near),
    _Kind((sympy.Abs,), _modulus, _argument, lambda e, x, point: _sign_near(e, x, point) * e.args[0]),
    _Kind((sympy.sign,), _sign, _argument, _sign_near),
    _Kind((sympy.SingularityFunction,), _bracket, _distance, _bracket_near),
    _Kind(
        (Heaviside,),
        lambda e, x: above(e.args[0], x),
        _argument,
        lambda e, x, point: (1 + _sign_near(e, x, point)) / 2,
    ),
    _Kind((DiracDelta,), lambda e, x: e, _argument, lambda e, x, point: sympy.Integer(0)),
)
