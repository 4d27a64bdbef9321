"""What the ends of the domain are: how many of the solutions are square integrable there [Weyl; see Titchmarsh 1962].

V ~ s u^(-j) in a local coordinate u of t, (du/dx)^2 ~ u^mu.  At a finite regular end V ~ (nu^2 - 1/4)/(x - a)^2, and both
solutions are square integrable where nu^2 < 1: the limit circle.  Where V -> -oo both oscillate, and both are square
integrable if int |V|^(-1/2) dx is finite, which is mu < j + 2.  Everywhere else one solution at most is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.energies import exact_root
from kovacic.bound_states.frame import SLOPES, Original, Uncovered, is_between
from kovacic.bound_states.ranges import tidied
from kovacic.bound_states.signs import Signs
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.numerals import as_text
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class End:
    """One end: where both solutions are square integrable (`circle`, a relation, True or False), and what is said about it.

    `oscillates` says that V falls without bound there, so that no boundary condition is distinguished.  `threshold` is where
    the continuous spectrum begins at an infinite end; None where it doesn't.  The end is t = `point`, with
    (du/dx)^2 ~ u^mu for a local coordinate u of this `direction` inside the domain.
    """

    at: Any
    circle: Any
    sentence: str
    oscillates: bool = False
    threshold: Any = None
    domain: tuple[Any, Any] = (-sympy.oo, sympy.oo)
    is_right: bool = True
    point: Any = sympy.oo
    mu: int = 4
    direction: int = 1
    is_ordinary: bool = False


def potential_in_t(S: Any, equation: Equation | None, original: Original, E: Any, t: Any, signs: Signs) -> Any:
    """V as a function of t."""
    if equation is None or equation.change is None:
        return sympy.cancel(S + E)
    quotient = equation.c / equation.a
    c = signs.real(quotient.num.to_sympy(t) / quotient.den.to_sympy(t))
    return sympy.cancel(E - SLOPES[original.kind](t) * original.rate**2 * c)


def check_inside(V: Any, original: Original, domain: tuple[Any, Any], t: Any, signs: Signs) -> None:
    """Raises `InputError` where V has a pole inside the domain, and `Uncovered` where that isn't known."""
    denominator = sympy.Poly(sympy.denom(V), t)
    points = real_zeros(denominator, signs)
    if original.kind == "tan" and sympy.degree(sympy.numer(V), t) > denominator.degree():
        points.append(sympy.oo)
    angles = [original.theta_at(end, signs) for end in domain] if points else []
    inside = []
    for point in points:
        found = [a for a in _angles(original.kind, point, angles) if is_between(a, angles[0], angles[1], signs)]
        inside += [(angle - original.offset) / original.rate for angle in found]
    if not inside:
        return
    message = f"V isn't regular at {original.x} = {caret(as_text(inside[0]))}, inside the domain"
    hint = "choose a domain without a pole inside"
    last = _last(inside, signs)
    if last is None:
        raise InputError(message, hint=hint)
    python, shell = domain_as_given(last, domain[1])
    raise InputError(message, hint=f"{hint}: {python}", shell=f"{hint}: {shell}")


def _last(points: list[Any], signs: Signs) -> Any:
    """The largest of them, None where that isn't known."""
    for point in points:
        if all(signs.is_nonnegative(point - other) for other in points):
            return point
    return None


def domain_as_given(first: Any, last: Any) -> tuple[str, str]:
    """How a domain is given in Python and at the command line."""
    ends = [end if end.is_infinite else sympy.simplify(end) for end in (first, last)]
    texts = [caret(as_text(end)) for end in ends]
    quoted = [text if end.is_Integer else f'"{text}"' for end, text in zip(ends, texts, strict=True)]
    options = [f"--from {quoted[0]}"]
    if last != sympy.oo:
        options.append(f"--to {quoted[1]}")
    return f"domain=({', '.join(quoted)})", " ".join(options)


def real_zeros(polynomial: Any, signs: Signs) -> list[Any]:
    """Each once.  Raises `Uncovered` where it isn't known which zeros are real."""
    if all(c.is_Rational for c in polynomial.coeffs()):
        return [*dict.fromkeys(polynomial.real_roots())]
    at_a_real_point = polynomial.as_expr().xreplace({polynomial.gen: sympy.Dummy("t", real=True)})
    if signs.sign(at_a_real_point) is not None:
        return []
    roots = sympy.roots(polynomial)
    if sum(roots.values()) < polynomial.degree() or any(root.is_real is None for root in roots):
        raise Uncovered("whether V has a pole inside the domain isn't known")
    return [root for root in roots if root.is_real]


def _angles(kind: str, point: Any, ends: list[Any]) -> list[Any]:
    """The real angles at which t has a value."""
    single = {"x": lambda v: v, "sinh": sympy.asinh}
    if kind in single:
        return [single[kind](point)]
    if kind == "exp":
        return [sympy.log(point)] if point.is_positive is not False else []
    if kind == "cosh":
        return [sign * sympy.acosh(point) for sign in (1, -1)] if sympy.acosh(point).is_real is not False else []
    inverse = {"cos": sympy.acos, "sin": sympy.asin, "tan": sympy.atan}[kind]
    first = inverse(point) if point != sympy.oo else sympy.pi / 2
    if first.is_real is False:
        return []
    others = {"cos": -first, "sin": sympy.pi - first, "tan": first + sympy.pi}[kind]
    lowest = sympy.floor(min(ends) / (2 * sympy.pi)) - 1
    number = int(sympy.ceiling((max(ends) - min(ends)) / (2 * sympy.pi))) + 3
    return [angle + 2 * sympy.pi * (lowest + k) for angle in dict.fromkeys((first, others)) for k in range(number)]


def end_of(V: Any, original: Original, domain: tuple[Any, Any], t: Any, signs: Signs, *, is_right: bool) -> End:
    """An end of the domain; the potential is a function of t."""
    other, at = domain if is_right else domain[::-1]
    distance = at - original.x if is_right else original.x - at
    point, mu, direction, end = _end_of(V, original, at, other, distance, t, signs)
    return replace(end, domain=domain, is_right=is_right, point=point, mu=mu, direction=direction)


def _end_of(
    V: Any, original: Original, at: Any, other: Any, distance: Any, t: Any, signs: Signs
) -> tuple[Any, int, int, End]:
    point = original.at(at, signs)
    u = sympy.Dummy("u")
    value = 1 / u if point == sympy.oo else point + u
    slope = sympy.cancel(SLOPES[original.kind](value) * original.rate**2 * (u**4 if point == sympy.oo else 1))
    mu = _order(slope, u)
    local = sympy.cancel(V.xreplace({t: value}))
    order, strength = _leading(local, u)
    direction = _side(original, at, other, point, signs)
    inside = strength * direction ** abs(order)
    if at.is_infinite:
        end = _infinite(at, original.x, mu, -order, inside, signs)
    elif -order > 2 - mu:
        end = _irregular(at, original, inside, signs)
    else:
        end = _finite(at, original, distance, mu, -order, strength, slope, u, signs)
    return point, mu, direction, end


def _order(function: Any, u: Any) -> int:
    return _leading(function, u)[0]


def _leading(function: Any, u: Any) -> tuple[int, Any]:
    """The order at u = 0 and the coefficient; (0, 0) for 0."""
    num, den = (sympy.Poly(part, u) for part in sympy.fraction(sympy.together(function)))
    if num.is_zero:
        return 0, sympy.Integer(0)
    above = num.terms()[-1]
    below = den.terms()[-1]
    return above[0][0] - below[0][0], sympy.factor(above[1] / below[1])


def _side(original: Original, at: Any, other: Any, point: Any, signs: Signs) -> int:
    """The sign of the local coordinate of t on the domain, near this end."""
    kind = original.kind
    is_left = at == -sympy.oo or other == sympy.oo or (at != sympy.oo and signs.sign(other - at) == 1)
    if kind in ("exp", "cosh") and point in (0, sympy.oo):
        return 1
    if kind in ("x", "exp", "sinh"):
        sign = signs.sign(original.rate)
        if sign is None:
            raise Uncovered(f"the sign of {original.rate} isn't known: assume that it is positive")
        return sign * (1 if is_left != at.is_infinite else -1)
    if kind == "cosh":
        return 1
    angle = original.theta_at(at, signs)
    if not angle.is_number:
        raise Uncovered(f"the end {at} isn't a multiple of pi/({original.rate})")
    value = getattr(sympy, kind)(angle + (1 if is_left else -1) * sympy.Rational(1, 1000))
    distance = 1 / value if point == sympy.oo else value - point
    return 1 if distance > 0 else -1


def _infinite(at: Any, x: Any, mu: int, j: int, strength: Any, signs: Signs) -> End:
    where = f"{x} -> {at}"
    if j < 0 or strength == 0:
        return End(at, False, f"{where}: V -> 0, continuous spectrum from 0", threshold=sympy.Integer(0))
    if j == 0:
        shown = caret(as_text(strength))
        return End(at, False, f"{where}: V -> {shown}, continuous spectrum from there", threshold=strength)
    sign = signs.sign(strength)
    if sign == 1:
        return End(at, False, f"{where}: V -> oo, one solution decays")
    falls = sympy.Lt(strength, 0)
    if mu >= j + 2:
        said = (
            "V -> -oo, no solution is square integrable" if sign == -1 else "at most one solution is square integrable"
        )
        return End(at, False, f"{where}: {said}", oscillates=sign == -1)
    if sign == -1:
        return End(
            at, True, f"{where}: V -> -oo so fast that both solutions are square integrable (limit circle)", True
        )
    return End(at, falls, f"{where}: one solution decays where {caret(as_text(strength))} > 0", True)


def _irregular(at: Any, original: Original, strength: Any, signs: Signs) -> End:
    where = f"{original.x} -> {caret(as_text(at))}"
    sign = signs.sign(strength)
    if sign == 1:
        return End(at, False, f"{where}: V -> oo, one solution decays")
    if sign == -1:
        said = "V -> -oo so fast that both solutions are square integrable (limit circle)"
        return End(at, True, f"{where}: {said}", True)
    return End(at, sympy.Lt(strength, 0), f"{where}: one solution decays where {caret(as_text(strength))} > 0", True)


def _finite(
    at: Any, original: Original, distance: Any, mu: int, j: int, strength: Any, slope: Any, u: Any, signs: Signs
) -> End:
    where = f"{original.x} -> {caret(as_text(at))}"
    if mu >= 2:
        raise Uncovered(f"the coordinate isn't regular at {where}")
    # u ~ (x - a)^p with p = 2/(2 - mu), and (du/dx)^2 ~ C u^mu, so that u is (x - a)^p (C/p^2)^(p/2)
    p = sympy.Rational(2, 2 - mu)
    coefficient = sympy.Integer(0)
    if j == 2 - mu:
        C = _leading(slope, u)[1]
        coefficient = sympy.factor(strength * p**2 / C)
    square = sympy.factor(coefficient + sympy.Rational(1, 4))
    circle = _less_than_1(square, signs)
    known = signs.holds(circle)
    if known is False:
        return End(at, False, f"{where}: y ~ {_powers(distance, square)}, the smaller one is square integrable")
    negative = signs.is_nonnegative(square) is False
    if negative:
        shown = caret(as_text(-sympy.Symbol("c") / distance**2))
        return End(at, True, f"{where}: V ~ {shown} with c > 1/4, the solutions oscillate (limit circle)", True)
    said = f"y ~ {_powers(distance, square)}, both are square integrable (limit circle)"
    where_circle = "" if known else f" where {_relation(tidied([circle], signs)[0])}"
    is_ordinary = square == sympy.Rational(1, 4)
    return End(at, True if known else circle, f"{where}: {said}{where_circle}", is_ordinary=is_ordinary)


def _less_than_1(square: Any, signs: Signs) -> Any:
    """square < 1, for nu where that is no radical and has a sign."""
    root = exact_root(square)
    if square.is_number or root is None:
        return sympy.Lt(square, 1)
    if signs.holds(sympy.Lt(square, 1)) is not None:
        return sympy.Lt(square, 1)
    sign = signs.sign(root)
    size = sympy.Abs(root) if sign is None else sign * root
    return tidied([sympy.Lt(size, 1)], signs)[0]


def _relation(relation: Any) -> str:
    return f"{caret(as_text(relation.lhs))} {relation.rel_op} {caret(as_text(relation.rhs))}"


def _powers(distance: Any, square: Any) -> str:
    """How the two solutions behave at a distance from an end where the exponents are 1/2 +- nu."""
    root = exact_root(square)
    nu = sympy.sqrt(square) if root is None else root
    if square == sympy.Rational(1, 4):
        return f"{caret(as_text(distance))} or 1"
    exponents = (sympy.factor(sympy.expand(sympy.Rational(1, 2) + s * nu)) for s in (1, -1))
    first, second = (caret(as_text(distance**exponent)) for exponent in exponents)
    return f"{first} or {second}" if square != 0 else f"{first} or {second}*log({caret(as_text(distance))})"
