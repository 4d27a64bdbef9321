"""The number of square integrable solutions at an end of the domain [Weyl; see Titchmarsh 1962].

V ~ s u^(-j) in a local coordinate u of t, (du/dx)^2 ~ u^mu.  At a finite regular end V ~ (nu^2 - 1/4)/(x - a)^2, and both
solutions are square integrable where nu^2 < 1: the limit circle.  Where V -> -oo both oscillate, and both are square
integrable if int |V|^(-1/2) dx is finite, which is mu < j + 2.  Everywhere else one solution at most is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.coordinates import Original, RealPotential, check_poles, near, on_real_circle
from kovacic.bound_states.energies import exact_root, tidied
from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.question import SpectralProblem
from kovacic.errors import InputError
from kovacic.limits import check_duration
from kovacic.parametric.restriction import own_parameters

_FRIEDRICHS_NOTE = (
    "a boundary condition is needed: Friedrichs' boundary condition is taken, the smaller solution at the end"
)
#: What is said where V isn't bounded, by the sign of V, and whether both solutions are square integrable if V -> -oo.
_UNBOUNDED: dict[tuple[int | None, bool], str] = {
    **dict.fromkeys(((1, True), (1, False)), "V -> oo, one solution decays"),
    (-1, True): "V -> -oo so fast that both solutions are square integrable (limit circle)",
    (-1, False): "V -> -oo, no solution is square integrable",
    (None, False): "at most one solution is square integrable",
}


@dataclass(frozen=True)
class EndBehaviour:
    """One end: where both solutions are square integrable (`circle`, a relation, true or false), and a sentence about it.

    `oscillates` says that V falls without bound there, so that no boundary condition is distinguished; `oscillation` is where
    the solutions oscillate at a regular end, which has the same effect, and `other` where V isn't of the assumed order.
    `threshold` is where the continuous spectrum begins at an infinite end, None if it doesn't.  The end is t = `point`, with
    (du/dx)^2 ~ u^mu for a local coordinate u of this `direction` inside the domain.  It `is_regular` where V has a value, so
    that all solutions are analytic there; at a simple pole, which has the same exponents 0 and 1, all but the smaller one have
    a logarithm.  y = 0 means the smaller solution where only that one `vanishes`.
    """

    at: Any
    sentence: str
    circle: Any = sympy.false
    oscillates: bool = False
    oscillation: Any = sympy.false
    other: Any = sympy.false
    threshold: Any = None
    side: int = 1
    point: Any = sympy.oo
    mu: int = 4
    direction: int = 1
    is_regular: bool = False
    vanishes: bool = False

    @property
    def is_limit_point(self) -> bool:
        """True if one solution at most is square integrable, for all parameters."""
        return bool(self.circle == sympy.false)


@dataclass(frozen=True, kw_only=True)
class Examined(SpectralProblem):
    """The problem with V as a function of a real t, the ends, and where a boundary condition would be needed.

    `real` is None, and there are no ends, where they can't be examined.
    """

    real: RealPotential | None = None
    ends: tuple[EndBehaviour, ...] = ()
    excluded: tuple[Any, ...] = ()

    @property
    def is_limit_point(self) -> bool:
        """True if one solution at most is square integrable at each end, for all parameters."""
        return all(end.is_limit_point for end in self.ends)

    def spectrum(self, **found: Any) -> Spectrum:
        """The answer, with what was `found`."""
        excluded = (relation for relation in map(self.plain, self.excluded) if relation != sympy.false)
        known = {
            "parameters": own_parameters(self.parameters, tuple(self.meanings.items())),
            "assumptions": self.known.without(self.meanings),
            "ends": tuple(end.sentence for end in self.ends),
            "excluded": tuple(excluded),
        }
        return super().spectrum(**{**known, **found})


def examined(question: SpectralProblem) -> Examined:
    """With Friedrichs' condition where one is needed and none was given, if the operator is bounded below.

    Raises `Uncovered` where the ends can't be examined, or t isn't real, `InputError` for a pole inside the domain, and
    `LimitExceeded` where it would take too long.
    """
    original = question.original
    terms = question.parsed.S.num.degree + question.parsed.S.den.degree
    # SymPy takes 0.4 ms times the power 3/2 of the terms (measured).
    check_duration(4e-4 * terms**1.5, f"examining a potential of {terms} terms at its ends")
    real = on_real_circle(potential_in_t(question, original))
    check_poles(real)
    ends: list[EndBehaviour] = []
    for side, wish in enumerate(question.boundary.wishes):
        end = behaviour_at(question, real, side)
        ends.append(end)
        if wish is not None and not (end.vanishes if wish.is_zero else end.is_regular):
            raise InputError(
                f"V isn't regular at {question.variable} = {end.at}: only Friedrichs' condition is known there"
            )
    excluded = _excluded(question, ends)
    if excluded and not question.friedrichs and not any(end.oscillates for end in ends):
        question = replace(question, friedrichs=True, notices=(*question.notices, _FRIEDRICHS_NOTE))
        excluded = _excluded(question, ends)
    return Examined(**{**vars(question), "real": real, "ends": tuple(ends), "excluded": excluded})


def _excluded(question: SpectralProblem, ends: Sequence[EndBehaviour]) -> tuple[Any, ...]:
    """The relations where both solutions are square integrable at an end and none of them is chosen."""
    signs = question.signs
    relations: dict[Any, None] = {}
    for end, wish in zip(ends, question.boundary.wishes, strict=True):
        circle = end.oscillation if question.friedrichs and not end.oscillates else end.circle
        if wish is None and signs.holds(circle) is not False:
            relations.update(dict.fromkeys(tidied([circle], signs) or (sympy.true,)))
    return tuple(relations)


def potential_in_t(question: SpectralProblem, original: Original) -> RealPotential:
    """V/kinetic as a function of t, which may be complex here."""
    parsed, t = question.parsed, question.t
    S = parsed.S if parsed.equation is None else -parsed.equation.c / parsed.equation.a  # (V - E)/(dt/dx)^2
    V = original.slope_squared(t) * question.signs.real(S.to_sympy(t)).subs(question.E, 0)
    return RealPotential(sympy.cancel(V), original, t)


def behaviour_at(question: SpectralProblem, real: RealPotential, side: int) -> EndBehaviour:
    """An end of the domain, with the local coordinate u: t = point + u, or 1/u."""
    original = real.original
    at = question.domain[side]
    if original.is_periodic and at.is_infinite:
        return EndBehaviour(at, f"{question.variable} -> {at}: V is periodic, at most one solution decays")
    point = original.at(side)
    u = sympy.Dummy("u")
    t = near(point, u)
    mu, C = leading(original.slope_squared(t) / sympy.diff(t, u) ** 2, u)
    order, strength = leading(real.V.xreplace({real.t: t}), u)
    direction = original.side_of(side)
    where = f"{question.variable} -> {question.shown(at)}: "
    is_regular = at.is_finite and order >= 0
    end = EndBehaviour(at, where, side=side, point=point, mu=mu, direction=direction, is_regular=is_regular)
    inside = strength * direction ** abs(order)
    if at.is_infinite and order >= 0:
        threshold = sympy.factor(question.kinetic * inside) if order == 0 else sympy.Integer(0)
        limit = question.shown(threshold)
        begin = "there" if limit != "0" else "0"
        return replace(end, sentence=f"{where}V -> {limit}, continuous spectrum from {begin}", threshold=threshold)
    if at.is_infinite or order < mu - 2:
        return _unbounded(end, -order, inside, question)
    # u ~ (x - a)^p with p = 2/(2 - mu), so that with (du/dx)^2 ~ C u^mu it is (x - a)^p (C/p^2)^(p/2).
    nu_squared = sympy.Rational(1, 4)
    if order == mu - 2:
        nu_squared = sympy.factor(sympy.factor(4 * strength / (C * (2 - mu) ** 2)) + nu_squared)
    return _finite(end, nu_squared, question)


def leading(function: Any, u: Any) -> tuple[int, Any]:
    """The order at u = 0 and the coefficient; (0, 0) for 0."""
    num, den = sympy.fraction(sympy.cancel(function))
    (zeros,), top = sympy.Poly(num, u).terms()[-1]
    (poles,), bottom = sympy.Poly(den, u).terms()[-1]
    return zeros - poles, sympy.factor(top / bottom)


def _unbounded(end: EndBehaviour, pole: int, strength: Any, question: SpectralProblem) -> EndBehaviour:
    """Where V ~ strength |u|^(-pole); for V -> -oo int |V|^(-1/2) dx may be finite, at a finite end or where V falls fast."""
    sign = question.signs.sign(strength)
    is_fast = end.at.is_finite or end.mu < pole + 2
    end = replace(end, oscillates=sign == -1, vanishes=sign == 1)
    if sign is None and is_fast:
        grows, falls = (question.signs.is_nonnegative(side * strength) is True for side in (1, -1))  # a^2, -a^2
        size = question.shown(sympy.factor(question.kinetic * (-strength if falls else strength)))
        said = f"{_UNBOUNDED[-1, True] if falls else 'one solution decays'} where {size} > 0"
        circle = sympy.false if grows else sympy.true if falls else sympy.Lt(strength, 0)
        end = replace(end, other=sympy.Eq(strength, 0), vanishes=grows, oscillates=not grows, circle=circle)
    else:
        said = _UNBOUNDED[sign, is_fast]
        end = replace(end, circle=sympy.true if sign == -1 and is_fast else sympy.false)
    return replace(end, sentence=end.sentence + said)


def _finite(end: EndBehaviour, square: Any, question: SpectralProblem) -> EndBehaviour:
    """A finite regular end: V ~ (nu^2 - 1/4)/(x - a)^2, and the square of nu."""
    signs = question.signs
    end = replace(end, vanishes=signs.is_nonnegative(square - sympy.Rational(1, 4)) is True)
    circle = sympy.Lt(square, 1)
    root = exact_root(square)
    if root is not None and signs.holds(circle) is None:  # nu, which is no radical and has a sign
        circle = tidied([sympy.Lt(signs.size(root), 1)], signs)[0]
    distance = end.at - question.x if end.side else question.x - end.at
    nu = sympy.sqrt(square) if root is None else root
    y1, y2 = (question.shown(distance ** sympy.factor(sympy.expand(sympy.S.Half + s * nu))) for s in (1, -1))
    powers = f"y ~ {y1} or {y2}" + f"*log({question.shown(distance)})" * (square == 0)
    if signs.holds(circle) is False:
        return replace(end, sentence=f"{end.sentence}{powers}, the smaller one is square integrable")
    if signs.is_nonnegative(square) is False:
        shown = question.shown(-sympy.Symbol("c") / distance**2)
        said = f"V ~ {shown} with c > 1/4, the solutions oscillate (limit circle)"
        return replace(end, circle=sympy.true, sentence=end.sentence + said, oscillates=True)
    said = f"{powers}, both are square integrable (limit circle)"
    for condition in tidied([circle], signs):
        said += f" where {question.shown(condition)}"
    return replace(end, circle=circle, sentence=end.sentence + said, oscillation=sympy.Lt(square, 0))
