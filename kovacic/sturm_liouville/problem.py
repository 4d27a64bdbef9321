"""The problem in normal form, Y'' = (Q - E W) Y with W >= 0, on intervals in each of which Q and W are analytic.

a y'' + b y' + (c0 + E c1) y = 0 becomes this for Y = y exp(int b/(2a)): with B = b/a, Q = B^2/4 + B'/2 - c0/a and W =
c1/a. Zeros stay where they are, and alpha y + beta y' = 0 becomes (alpha - beta B/2) Y + beta Y' = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import wraps
from typing import Any, TypeVar

import sympy
from flint import acb, arb

from kovacic.closed_form.jets import BallEvaluator
from kovacic.closed_form.order import ball, from_left_to_right, is_below, point_between
from kovacic.closed_form.steps import JUMPING, in_steps, jump_place, jumps_in, on_piece, split_at_jumps
from kovacic.errors import InputError

Expr = Any
_T = TypeVar("_T")


@dataclass(frozen=True)
class Span:
    """The numbers E that are to be looked at: E <= high and |E| <= size, exact."""

    high: Any
    size: Any


@dataclass(frozen=True)
class Stretch:
    """Q and W on an interval; in Q, `delta` times a delta function at its low end, so that Y' grows by delta Y there."""

    low: Expr
    high: Expr
    Q: Expr
    W: Expr
    delta: Expr = sympy.S.Zero


@dataclass(frozen=True)
class Robin:
    """alpha y + beta y' = 0, not both zero."""

    alpha: Expr
    beta: Expr

    @property
    def is_zero(self) -> bool:
        """True for y = 0."""
        return bool(self.beta == 0)


@dataclass(frozen=True)
class Bounded:
    """y is bounded."""

    is_zero = False


Wish = Robin | Bounded | None


@dataclass(frozen=True)
class SturmProblem:
    """An equation with conditions on y at both ends; None stands for the solution that is smaller than all others there.

    `wrap` is 0 for separated conditions, 1 for periodic and -1 for antiperiodic ones; `sign` is -1 where the user's
    parameter is -E.
    """

    x: Expr
    pieces: tuple[Stretch, ...]
    conditions: tuple[Wish, Wish] = (None, None)
    wrap: int = 0
    B: Expr = sympy.S.Zero
    sign: int = 1

    @property
    def ends(self) -> tuple[Expr, Expr]:
        return self.pieces[0].low, self.pieces[-1].high

    def around(self, x: Any) -> tuple[Any, Any]:
        """Q and W near a number, without a bound of the error."""
        pieces = (p for p in self.pieces if p.high.is_infinite or x < ball(p.high))
        piece = next(pieces, self.pieces[-1])
        at = BallEvaluator({self.x: acb(x)})
        return at(piece.Q).real.mid(), at(piece.W).real.mid()

    def slope(self, at: Expr) -> Expr:
        """B/2 at a point: y'/y = Y'/Y - B/2."""
        return (self.B / 2).subs(self.x, at)


def kept(method: Callable[..., _T]) -> Callable[..., _T]:
    """A decorator: results of a method are kept with its object, by the arguments; FLINT's balls aren't hashable themselves."""

    @wraps(method)
    def found(self: Any, *arguments: Any) -> _T:
        exact = [(a.mid().man_exp(), a.rad().man_exp()) if isinstance(a, arb) else a for a in arguments]
        key = (method.__name__, *exact)
        known: dict[Any, _T] = self.__dict__.setdefault("_kept", {})
        if key not in known:
            known[key] = method(self, *arguments)
        return known[key]

    return found


def stretches_of(Q: Expr, W: Expr, x: Expr, domain: tuple[Expr, Expr]) -> tuple[Stretch, ...]:
    """Q and W between the points at which one of their absolute values, steps or cases changes.

    Raises `InputError` if these points can't be found, for a delta function at an end or in a product, and if W isn't shown to
    be positive between them.
    """
    places = [domain[0], *_breaks(sympy.Tuple(Q, W), x, domain), domain[1]]
    impulses = _impulses(Q, x)
    deltas = [sympy.Add(*(s for a, s in impulses.items() if sympy.simplify(a - place) == 0)) for place in places]
    if deltas[0] != 0 or deltas[-1] != 0 or _impulses(W, x):
        raise InputError("a delta function at an end of the domain, or as a weight, isn't defined here")
    found = []
    for low, high, delta in zip(places, places[1:], deltas, strict=False):
        inside = point_between(low, high)
        piece = Stretch(low, high, _near(Q, x, inside), _near(W, x, inside), delta)
        _check_weight(piece, x, inside)
        found.append(piece)
    return tuple(found)


def _impulses(Q: Expr, x: Expr) -> dict[Expr, Expr]:
    """The strengths of the delta functions, by their places."""
    terms = sympy.Add.make_args(sympy.expand(Q))
    right = sympy.Add(*(term for term in terms if term.has(sympy.DiracDelta, sympy.SingularityFunction)))
    apart = split_at_jumps(in_steps(right, x), x)
    if apart is None or any(n for strengths in apart.impulses.values() for n in strengths):
        raise InputError(f"delta functions are expected alone, or times functions without steps there: {right}")
    return {a: strengths[0] for a, strengths in apart.impulses.items()}


def _breaks(e: Expr, x: Expr, domain: tuple[Expr, Expr]) -> list[Expr]:
    """The points strictly inside the domain, in order."""
    points = set()
    for step in sorted(jumps_in(e, x), key=str):
        place = jump_place(step, x)
        if place is None or place.a.is_real is False:
            raise InputError(f"it isn't known where {step.args[0]} changes its sign")
        points.add(place.a)
    inside = [point for point in points if is_below(domain[0], point) and is_below(point, domain[1])]
    return from_left_to_right(inside)


def _near(e: Expr, x: Expr, inside: Expr) -> Expr:
    """Without absolute values, signs, steps and cases, as they are around a point."""
    found = on_piece(e, x, inside)
    if any(step.has(x) or not e.has(step) for step in found.atoms(*JUMPING)):
        raise InputError(f"it isn't known what {e} is at {x} = {inside}")
    return found


def _check_weight(piece: Stretch, x: Expr, inside: Expr) -> None:
    """Raise `InputError` unless W >= 0 is shown; the zeros of W are isolated, since it is analytic and not 0."""
    W = piece.W
    real = sympy.Dummy(real=True)
    if not W.has(x) and ball(W) > 0:
        return
    if W.xreplace({x: real}).is_nonnegative or _is_without_roots(piece, x, inside):
        return
    low, high = piece.low, piece.high
    if low.is_finite and high.is_finite:
        vanishes = [sympy.simplify(W.subs(x, end)) == 0 for end in (low, high)]
        if _is_positive(W, x, (ball(low), ball(high)), vanishes, 14):
            return
    raise InputError(
        f"the coefficient of the parameter isn't known to be positive: {W}",
        hint="write the equation so that y'' and the parameter times y have positive coefficients on one side",
    )


def _is_without_roots(piece: Stretch, x: Expr, inside: Expr) -> bool:
    """True if W is rational, positive at a point inside, and has neither zeros nor poles inside."""
    if not piece.W.is_rational_function(x):
        return False
    num, den = sympy.fraction(sympy.cancel(sympy.together(piece.W)))
    polynomial = sympy.Poly(num * den, x)
    if polynomial.domain not in (sympy.ZZ, sympy.QQ) or not ball(piece.W.subs(x, inside)) > 0:
        return False
    return not any(is_below(piece.low, root) and is_below(root, piece.high) for root in polynomial.real_roots())


def _is_positive(W: Expr, x: Expr, ends: tuple[arb, arb], vanishes: Sequence[bool], halvings: int) -> bool:
    """True if W > 0 in balls, after that many halvings; next to an end where W vanishes, by the sign of its derivative."""
    low, high = ends
    whole = BallEvaluator({x: acb(low.union(high))}, analytic=True)
    if whole(W).real > 0:
        return True
    slope = whole(W.diff(x)).real
    if (vanishes[0] and slope > 0) or (vanishes[1] and slope < 0):
        return True
    if halvings == 0:
        return False
    middle = ((low + high) / 2).mid()
    left = _is_positive(W, x, (low, middle), (vanishes[0], False), halvings - 1)
    return left and _is_positive(W, x, (middle, high), (False, vanishes[1]), halvings - 1)


def normal_form(
    x: Expr, coefficients: Sequence[Expr], domain: tuple[Expr, Expr]
) -> tuple[tuple[Stretch, ...], Expr, int]:
    """The pieces, B, and the sign of E, from a, b, c0 and c1.  Raises `InputError`."""
    a, b, c0, c1 = coefficients
    if any(e.has(sympy.I) for e in coefficients):
        raise InputError("the coefficients aren't real")
    B = sympy.cancel(b / a) if (b / a).is_rational_function(x) else sympy.simplify(b / a)
    if B.has(*JUMPING):
        raise InputError("the coefficient of y' is a function in pieces, for which eigenvalues aren't computed")
    Q = plain(B**2 / 4 + B.diff(x) / 2 - c0 / a, x)
    W = plain(c1 / a, x)
    inside = point_between(*domain)
    sign = 1 if ball(_near(W, x, inside).subs(x, inside)) > 0 else -1
    return stretches_of(Q, sign * W, x, domain), B, sign


def plain(e: Expr, x: Expr) -> Expr:
    """In lowest terms where it is rational, and in factors: near a pole an expanded denominator has too wide a ball."""
    return sympy.factor(sympy.cancel(sympy.together(e))) if e.is_rational_function(x) else e
