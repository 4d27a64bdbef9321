"""How many of the solutions are square integrable at an end of the domain [Weyl; see Titchmarsh 1962].

V ~ s u^(-j) in a local coordinate u of t, (du/dx)^2 ~ u^mu.  At a finite regular end V ~ (nu^2 - 1/4)/(x - a)^2, and both
solutions are square integrable where nu^2 < 1: the limit circle.  Where V -> -oo both oscillate, and both are square
integrable if int |V|^(-1/2) dx is finite, which is mu < j + 2.  Everywhere else one solution at most is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.coordinates import Original, RealPotential
from kovacic.bound_states.energies import exact_root, tidied
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs, Uncovered
from kovacic.numbers.numerals import as_text
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class End:
    """One end: where both solutions are square integrable (`circle`, a relation, True or False), and a sentence about it.

    `oscillates` says that V falls without bound there, so that no boundary condition is distinguished; `oscillation` is where
    the solutions oscillate at a regular end, which has the same effect.  `threshold` is where
    the continuous spectrum begins at an infinite end, None if it doesn't.  The end is t = `point`, with
    (du/dx)^2 ~ u^mu for a local coordinate u of this `direction` inside the domain.  It `is_ordinary` where the exponents are
    those at an ordinary point, and `is_regular` where V has a value.
    """

    at: Any
    circle: Any
    sentence: str
    oscillates: bool = False
    oscillation: Any = False
    threshold: Any = None
    is_right: bool = True
    point: Any = sympy.oo
    mu: int = 4
    direction: int = 1
    is_ordinary: bool = False
    is_regular: bool = False


def potential_in_t(question: SpectralProblem, original: Original) -> RealPotential:
    """V as a function of t, which may be complex here."""
    signs = question.signs
    parsed = question.parsed
    equation = parsed.equation
    t = sympy.Symbol(parsed.variable)
    if equation is None or equation.change is None:
        S = signs.real(parsed.S.num.to_sympy(t) / parsed.S.den.to_sympy(t))
        return RealPotential(sympy.cancel(S + question.E), original, t, question.kinetic)
    quotient = equation.c / equation.a
    c = signs.real(quotient.num.to_sympy(t) / quotient.den.to_sympy(t))
    V = sympy.cancel(question.E - original.slope_squared(t) * c)
    return RealPotential(V, original, t, question.kinetic)


@dataclass(frozen=True)
class _Place:
    """An end of the domain as a point t = `point` with the local coordinate u: t = point + u, or 1/u.

    `slope` is (du/dx)^2 ~ u^mu, and V ~ strength u^(-pole).  `direction` is the sign of u inside the domain, and
    `distance` the printed distance of x from the end.
    """

    at: Any
    x: Any
    distance: Any
    point: Any
    u: Any
    slope: Any
    mu: int
    pole: int
    strength: Any
    direction: int

    @property
    def where(self) -> str:
        """The end in a sentence."""
        shown = str(self.at) if self.at.is_infinite else caret(as_text(self.at))
        return f"{self.x} -> {shown}"

    @property
    def inside(self) -> Any:
        """The strength for |u|: that of V inside the domain."""
        return self.strength * self.direction ** abs(self.pole)


def end_of(real: RealPotential, domain: tuple[Any, Any], signs: Signs, *, is_right: bool) -> End:
    """An end of the domain."""
    place = _place(real, domain, signs, is_right=is_right)
    if place.at.is_infinite:
        end = _infinite(place, signs, real.kinetic)
    elif place.pole > 2 - place.mu:
        end = _unbounded(place, signs)
    else:
        end = _finite(place, signs)
    return replace(
        end,
        is_right=is_right,
        point=place.point,
        mu=place.mu,
        direction=place.direction,
        is_regular=place.at.is_finite and place.pole <= 0,
    )


def _place(real: RealPotential, domain: tuple[Any, Any], signs: Signs, *, is_right: bool) -> _Place:
    """The end in its local coordinate."""
    original = real.original
    at = domain[int(is_right)]
    point = original.at(at, signs)
    u = sympy.Dummy("u")
    t, dt_du_squared = (1 / u, u**-4) if point == sympy.oo else (point + u, sympy.Integer(1))
    slope = sympy.cancel(original.slope_squared(t) / dt_du_squared)
    order, strength = leading(sympy.cancel(real.V.xreplace({real.t: t})), u)
    return _Place(
        at,
        original.x,
        distance=at - original.x if is_right else original.x - at,
        point=point,
        u=u,
        slope=slope,
        mu=leading(slope, u)[0],
        pole=-order,
        strength=strength,
        direction=original.side_of(at, point, signs, is_right=is_right),
    )


def leading(function: Any, u: Any) -> tuple[int, Any]:
    """The order at u = 0 and the coefficient; (0, 0) for 0."""
    num, den = sympy.fraction(sympy.together(function))
    if sympy.Poly(num, u).is_zero:
        return 0, sympy.Integer(0)
    (above,), top = sympy.Poly(num, u).terms()[-1]
    (below,), bottom = sympy.Poly(den, u).terms()[-1]
    return above - below, sympy.factor(top / bottom)


def _infinite(place: _Place, signs: Signs, kinetic: Any) -> End:
    """An infinite end, by what V tends to."""
    if place.pole < 0 or place.inside == 0:
        said = f"{place.where}: V -> 0, continuous spectrum from 0"
        return End(place.at, False, said, threshold=sympy.Integer(0))
    if place.pole == 0:
        shown = caret(as_text(sympy.factor(kinetic * place.inside)))
        said = f"{place.where}: V -> {shown}, continuous spectrum from there"
        return End(place.at, False, said, threshold=place.inside)
    return _unbounded(place, signs)


def _unbounded(place: _Place, signs: Signs) -> End:
    """Where V -> oo or V -> -oo; in the second case int |V|^(-1/2) dx may be finite, at a finite end or where V falls fast."""
    at = place.at
    where = place.where
    sign = signs.sign(place.inside)
    is_fast = at.is_finite or place.mu < place.pole + 2
    if sign == 1:
        return End(at, False, f"{where}: V -> oo, one solution decays")
    if not is_fast:
        said = "at most one solution" if sign is None else "V -> -oo, no solution"
        return End(at, False, f"{where}: {said} is square integrable", oscillates=sign == -1)
    if sign == -1:
        said = "V -> -oo so fast that both solutions are square integrable (limit circle)"
        return End(at, True, f"{where}: {said}", oscillates=True)
    said = f"one solution decays where {caret(as_text(place.inside))} > 0"
    return End(at, sympy.Lt(place.inside, 0), f"{where}: {said}", oscillates=True)


def _finite(place: _Place, signs: Signs) -> End:
    """A finite regular end: V ~ (nu^2 - 1/4)/(x - a)^2."""
    at = place.at
    where = place.where
    if place.mu >= 2:
        raise Uncovered(f"the coordinate isn't regular at {where}")
    # u ~ (x - a)^p with p = 2/(2 - mu), so that with (du/dx)^2 ~ C u^mu it is (x - a)^p (C/p^2)^(p/2).
    square = sympy.Rational(1, 4)
    if place.pole == 2 - place.mu:
        _, C = leading(place.slope, place.u)
        square = sympy.factor(sympy.factor(4 * place.strength / (C * (2 - place.mu) ** 2)) + square)
    circle = _less_than_1(square, signs)
    known = signs.holds(circle)
    powers = _end_powers(place.distance, square)
    if known is False:
        return End(at, False, f"{where}: y ~ {powers}, the smaller one is square integrable")
    if signs.is_nonnegative(square) is False:
        shown = caret(as_text(-sympy.Symbol("c") / place.distance**2))
        said = f"V ~ {shown} with c > 1/4, the solutions oscillate (limit circle)"
        return End(at, True, f"{where}: {said}", oscillates=True)
    said = f"y ~ {powers}, both are square integrable (limit circle)"
    is_ordinary = square == sympy.Rational(1, 4)
    oscillation = False if signs.is_nonnegative(square) else sympy.Lt(square, 0)
    if known:
        return End(at, True, f"{where}: {said}", oscillation=oscillation, is_ordinary=is_ordinary)
    condition = tidied([circle], signs)[0]
    relation = f"{caret(as_text(condition.lhs))} {condition.rel_op} {caret(as_text(condition.rhs))}"
    return End(at, circle, f"{where}: {said} where {relation}", oscillation=oscillation)


def _less_than_1(square: Any, signs: Signs) -> Any:
    """square < 1, for nu where that is no radical and has a sign."""
    root = exact_root(square)
    is_of_square = square.is_number or root is None or signs.holds(sympy.Lt(square, 1)) is not None
    if is_of_square:
        return sympy.Lt(square, 1)
    sign = signs.sign(root)
    size = sympy.Abs(root) if sign is None else sign * root
    return tidied([sympy.Lt(size, 1)], signs)[0]


def _end_powers(distance: Any, square: Any) -> str:
    """How the two solutions behave at a distance from an end where the exponents are 1/2 +- nu."""
    shown = caret(as_text(distance))
    if square == sympy.Rational(1, 4):
        return f"{shown} or 1"
    root = exact_root(square)
    nu = sympy.sqrt(square) if root is None else root
    larger, smaller = (sympy.factor(sympy.expand(sympy.Rational(1, 2) + s * nu)) for s in (1, -1))
    first = caret(as_text(distance**larger))
    second = caret(as_text(distance**smaller))
    if square == 0:
        return f"{first} or {second}*log({shown})"
    return f"{first} or {second}"
