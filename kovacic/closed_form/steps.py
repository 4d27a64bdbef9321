"""Right-hand sides with jumps and impulses: sums of g(x) H(x - a) and g(x) delta^(n)(x - a) at constant points a.

Functions that jump, or whose slopes do, are sums of steps:

- |u| = u sign(u), sign(u) = 2 H(u) - 1, max(u, v) = v + (u - v) H(u - v).
- A function of a step is F(H) = F(0) + (F(1) - F(0)) H, and H(u)^n = H(u).
- Macaulay's bracket <u>^n is u^n H(u), and an impulse for n < 0.
- A function given by cases is the sum of its cases times their indicators.
- For a linear u, or a polynomial with known zeros, H(u) is a sum of H(x - a) over these, and delta(u) one of delta(x - a).

`_IDENTITIES` has most of these.  What holds at single points doesn't matter.  x is real.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce
from math import comb
from typing import Any, NamedTuple

import sympy
from sympy import Add, DiracDelta, Heaviside, Integer, Mul, Piecewise, exp, expand
from sympy.logic.boolalg import And, Or

from kovacic.closed_form.check import letter_samples
from kovacic.closed_form.order import between, from_left_to_right
from kovacic.errors import InputError

Expr = Any  # SymPy publishes no types


def _singularity(u: Expr, a: Expr, n: Expr) -> Expr:
    """A power beside a step, or an impulse; with a letter n it may be either."""
    if not n.is_Integer:
        return sympy.SingularityFunction(u, a, n)
    return DiracDelta(u - a, -1 - n) if n < 0 else (u - a) ** n * Heaviside(u - a)


#: Functions that jump, or whose slopes do, of their arguments.
_IDENTITIES: dict[Any, Callable[..., Expr]] = {
    sympy.Abs: lambda u: u * (2 * Heaviside(u) - 1),
    sympy.sign: lambda u: 2 * Heaviside(u) - 1,
    sympy.Max: lambda *parts: reduce(lambda u, v: v + (u - v) * Heaviside(u - v), parts),
    sympy.Min: lambda *parts: reduce(lambda u, v: v + (u - v) * Heaviside(v - u), parts),
    sympy.SingularityFunction: _singularity,
    Heaviside: lambda u, *_: Heaviside(u),
    DiracDelta: DiracDelta,
}
JUMPING = (*_IDENTITIES, Piecewise)
#: Functions without singular points on the real line.
_ANALYTIC = (
    *(exp, sympy.sin, sympy.cos, sympy.sinh, sympy.cosh, sympy.tanh, sympy.sech, sympy.atan, sympy.asinh),
    *(sympy.erf, sympy.erfi, sympy.Si, sympy.airyai, sympy.airybi),
)


@dataclass(frozen=True)
class Apart:
    """plain + sum of steps[a] H(x - a) + sum of impulses[a][n] delta^(n)(x - a); `plain` has no jumps."""

    plain: Expr
    steps: Mapping[Expr, Expr]
    impulses: Mapping[Expr, Mapping[int, Expr]]

    def without_impulses(self, x: Expr) -> Expr:
        """The sum of the other parts."""
        return Add(self.plain, *(g * Heaviside(x - a) for a, g in self.steps.items()))


class HeavisidePlace(NamedTuple):
    """Where s (x - a) is zero: a, and the slope s."""

    a: Expr
    slope: Expr


def jump_place(jump: Expr, x: Expr) -> HeavisidePlace | None:
    """The place of a step or an impulse of s (x - a) with constants s and a, s real; None for others."""
    inner = jump.args[0]
    slope = inner.diff(x)
    if slope.has(x) or not slope.is_nonzero:
        return None
    return HeavisidePlace(expand(x - inner / slope), slope)


def jump_points(e: Expr, x: Expr) -> list[Expr]:
    """The distinct places of the steps and impulses in an expression."""
    places = (jump_place(jump, x) for jump in sorted(e.atoms(Heaviside, DiracDelta), key=str))
    return [*dict.fromkeys(place.a for place in filter(None, places))]


def with_single_steps(e: Expr) -> Expr:
    """H(u)^n = H(u)."""
    return e.replace(
        lambda power: power.is_Pow and isinstance(power.base, Heaviside) and power.exp.is_positive,
        lambda power: power.base,
    )


def split_at_jumps(right: Expr, x: Expr) -> Apart | None:
    """The parts of a right-hand side; None if a jump isn't at a constant, or a product of jumps isn't one of these.

    H(x - a) H(x - b) = H(x - max(a, b)); at the place of an impulse every step is 0 or 1, and

    g delta^(n) = sum of (-1)^k C(n, k) g^(k)(a) delta^(n - k),    delta^(n)(s u) = delta^(n)(u)/(|s| s^n).
    """
    steps: defaultdict[Expr, Expr] = defaultdict(int)
    impulses: defaultdict[Expr, defaultdict[int, Expr]] = defaultdict(lambda: defaultdict(int))
    for term in map(with_single_steps, Add.make_args(expand(right))):
        jumps = [factor for factor in Mul.make_args(term) if factor.has(*JUMPING) and factor.has(x)]
        deltas, others = sympy.sift(jumps, lambda jump: isinstance(jump, DiracDelta), binary=True)
        places = [jump_place(delta, x) for delta in deltas]
        if len(places) > 1 or None in places or not all(_is_simple(step, x) for step in others):
            return None
        begin = sympy.Max(*(expand(x - step.args[0]) for step in others))  # -oo without steps
        g = term / Mul(*jumps)
        if not deltas:
            steps[begin] += g
            continue
        a, slope = places[0]  # type: ignore[misc]
        side = a - begin if others else sympy.S.One
        if not (side.is_positive or side.is_negative):
            return None
        n = int((*deltas[0].args, 0)[1])  # DiracDelta(u) is DiracDelta(u, 0)
        for k in range(n + 1):
            strength = (-1) ** k * comb(n, k) * g.diff(x, k).subs(x, a) / (abs(slope) * slope**n)
            if strength != 0 and side.is_positive:
                impulses[a][n - k] += strength
    plain = steps.pop(-sympy.oo, sympy.S.Zero)
    return Apart(plain, {a: g for a, g in steps.items() if g != 0}, impulses)


def in_parts(right: Expr, x: Expr) -> Apart:
    """The parts of a right-hand side; all is plain if its jumps aren't known, as for |sin(x)|, and there is no impulse."""
    found = split_at_jumps(in_steps(right, x), x) if right.has(*JUMPING) else None
    if found is None and right.has(DiracDelta):
        raise NotImplementedError("undecided: an impulse times a jump at the same point, or at one that isn't known")
    return Apart(right, {}, {}) if found is None else found


# -------------------------------------------------------------------------------------------------- in terms of steps


def in_steps(right: Expr, x: Expr) -> Expr:
    """The right-hand side in terms of Heaviside(x - a) and DiracDelta(x - a, n), as far as possible.

    >>> x = sympy.Symbol("x")
    >>> in_steps(abs(x - 1), x)
    2*x*Heaviside(x - 1) - x - 2*Heaviside(x - 1) + 1
    """

    def rewritten(jump: Expr) -> Expr:
        if isinstance(jump, Piecewise):
            _check_cases(jump, x)
        found = _at_points(_in_heavisides(jump, x), x)
        return found if all(_is_simple(e, x) for e in found.atoms(*JUMPING) if e.has(x)) else jump

    # from the innermost ones outwards
    found = right.replace(lambda e: isinstance(e, JUMPING) and e.has(x) and not _is_simple(e, x), rewritten)
    if not found.has(*JUMPING):
        return found
    # sqrt(|x|) isn't analytic: sqrt(-x), which it is on one side, isn't real on the other
    outside = found.replace(lambda e: _is_function(e) and is_analytic(e, x), lambda e: _with_steps_outside(e, x))
    return with_single_steps(expand(outside))


def is_analytic(e: Expr, x: Expr) -> bool:
    """True if it is seen to be analytic on the whole line but for its steps."""
    plain = (sympy.Symbol, Add, Mul, Heaviside)
    others = [part for part in sympy.preorder_traversal(e) if part.has(x) and not isinstance(part, plain)]
    return all(_is_function(p) or (p.is_Pow and p.exp.is_Integer and p.exp > 0) for p in others)


def _is_function(e: Expr) -> bool:
    """True for exp, sin and the like, and powers of positive numbers."""
    if e.is_Pow:
        return bool(e.base.is_positive and e.base.is_number)
    return isinstance(e, _ANALYTIC)


def _with_steps_outside(e: Expr, x: Expr) -> Expr:
    """F(H) = F(0) + (F(1) - F(0)) H, for one step after the other."""
    for step in sorted((step for step in e.atoms(Heaviside) if step.has(x)), key=str):
        before, after = (e.xreplace({step: Integer(k)}) for k in (0, 1))
        e = before + (after - before) * step
    return e


def _at_points(e: Expr, x: Expr) -> Expr:
    """With H(x - a) and delta(x - a) for H(u) and delta(u), where the zeros of u are known."""
    e = e.replace(lambda e: isinstance(e, Heaviside) and e.has(x), lambda e: heaviside_of(e.args[0], x))
    return e.replace(lambda e: isinstance(e, DiracDelta) and e.has(x), lambda e: _delta_of(e, x))


def _delta_of(impulse: Expr, x: Expr) -> Expr:
    """delta(u), the sum of delta(x - a)/|u'(a)| over the zeros a of u; others are returned unchanged."""
    u, *order = impulse.args
    zeros = _zeros(u, x)
    if order or zeros is None or any(k > 1 for _, k in zeros):
        return impulse
    return Add(*(DiracDelta(x - a) / sympy.Abs(u.diff(x).subs(x, a)) for a, _ in zeros))


def _in_heavisides(e: Expr, x: Expr) -> Expr:
    """A function that jumps in terms of H(u) and impulses; cases are 0 where none holds."""
    if not isinstance(e, Piecewise):
        return _IDENTITIES[e.func](*e.args)
    total = sympy.S.Zero
    for value, condition in reversed(e.args):
        on = _indicator(condition, x)
        total = on * value + (1 - on) * total
    return total


def _check_cases(e: Expr, x: Expr) -> None:
    """Raise `InputError` for cases with a gap between them; with parameters that is tried at one value of each."""
    sample = e.subs(next(letter_samples(e.free_symbols - {x})))
    points = between(break_points(sample, x))
    if e.has(sympy.nan) or any(on_piece(sample, x, point).has(Piecewise) for point in points):
        raise InputError(f"{e} has no value where no case holds", hint="add a last case, such as (0, True)")


def _indicator(condition: Expr, x: Expr) -> Expr:
    """1 where a condition holds and 0 where it doesn't, except at single values of x."""
    if isinstance(condition, And):
        return Mul(*(_indicator(part, x) for part in condition.args))
    if isinstance(condition, Or):
        return 1 - Mul(*(1 - _indicator(part, x) for part in condition.args))
    if not isinstance(condition, sympy.Rel) or not condition.has(x):
        return Piecewise((1, condition), (0, True))
    if isinstance(condition, sympy.Eq | sympy.Ne):
        return Integer(isinstance(condition, sympy.Ne))
    return Heaviside(condition.gts - condition.lts)


def _is_simple(e: Expr, x: Expr) -> bool:
    """True for H(x - a) and delta^(n)(x - a)."""
    return isinstance(e, DiracDelta | Heaviside) and e.args[0].diff(x) == 1


def heaviside_of(u: Expr, x: Expr) -> Expr:
    """H(u), 1 where u > 0 and 0 where u < 0, as a sum of H(x - a) if the zeros of u are known.

    >>> x = sympy.Symbol("x")
    >>> heaviside_of(4 - x**2, x)
    -Heaviside(x - 2) + Heaviside(x + 2)
    """
    u = expand(u)
    slope = u.diff(x)
    if any(step.has(x) for step in u.atoms(Heaviside)):
        apart = split_at_jumps(_at_points(_with_steps_outside(Heaviside(u), x), x), x)
        return Heaviside(u) if apart is None else apart.without_impulses(x)
    if not slope.has(x) and (slope.is_positive or slope.is_negative):
        step = Heaviside(x - expand(x - u / slope))
        return step if slope.is_positive else 1 - step
    zeros = _zeros(u, x)
    if zeros is None:
        return Heaviside(u)
    # u has the sign of its first derivative that isn't 0 behind a zero, and the other one before it if that is an odd one
    changes = [sympy.sign(u.diff(x, k).subs(x, a)) * Heaviside(x - a) for a, k in zeros if k % 2]
    begin = sympy.sign(sympy.LC(u, x) * (-1) ** sympy.degree(u, x))
    return (1 + begin) / 2 + Add(*changes)


def _zeros(u: Expr, x: Expr) -> list[tuple[Expr, int]] | None:
    """The real zeros of a polynomial with their multiplicities; None for others, and if it isn't known which ones are real."""
    if not u.is_polynomial(x):
        return None
    polynomial = sympy.Poly(u, x)
    if polynomial.domain in (sympy.ZZ, sympy.QQ):
        return list(polynomial.real_roots(multiple=False))
    zeros = sympy.roots(polynomial)
    is_known = sum(zeros.values()) == polynomial.degree() and all(a.is_real is not None for a in zeros)
    return [(a, k) for a, k in zeros.items() if a.is_real] if is_known else None


# ------------------------------------------------------------------------------------------------- between the jumps


def jumps_in(expression: Expr, x: Expr) -> set[Expr]:
    """H(x - a) and delta(x - a) at the points a where an expression may jump; other H(u) where these aren't known."""
    found: set[Expr] = set()

    def noted(jump: Expr) -> Expr:
        plain = _at_points(_in_heavisides(jump, x), x)
        found.update(step for step in plain.atoms(*JUMPING) if step.has(x))
        return plain

    expression.replace(lambda e: isinstance(e, JUMPING) and e.has(x), noted)
    return found


def break_points(expression: Expr, x: Expr) -> list[Expr]:
    """The known points where functions in an expression jump, from left to right."""
    places = jump_points(sympy.Tuple(*jumps_in(expression, x)), x)
    return from_left_to_right(a for a in places if a.is_number and a.is_real)


def on_piece(expression: Expr, x: Expr, point: Expr) -> Expr:
    """The expression near a point that is no break, without functions that jump, where their signs are known."""

    def near(jump: Expr) -> Expr:
        if isinstance(jump, DiracDelta):
            return Integer(0)
        if isinstance(jump, Heaviside):
            return (1 + sympy.sign(jump.args[0].subs(x, point))) / 2
        if isinstance(jump, Piecewise):
            which = Piecewise(*((k, condition.subs(x, point)) for k, (_, condition) in enumerate(jump.args)))
            return jump.args[which].expr if which.is_Integer else jump
        plain = _in_heavisides(jump, x)
        return jump if plain == jump else on_piece(plain, x, point)

    return expression.replace(lambda e: isinstance(e, JUMPING) and e.has(x), near)
