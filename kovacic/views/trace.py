"""The derivation of an answer as data, in the terms of Kovacic's paper.

At a pole c of order o, and at infinity where S has order o (degree of the denominator minus that of the numerator):

- case 1: alpha = 1 (o = 1), (1 +- Delta)/2 (o = 2), (nu +- b/a)/2 (o = 2 nu >= 4);
- case 2: E_c = {4} (o = 1), {2 + k Delta, k = 0, +-2} (o = 2), {o} (o > 2);  E_inf = {0, 2, 4} (o > 2), like a pole
  (o = 2), {o} (o < 2);
- case 3: E = {12} (o = 1), {6 + 12k/n Delta, k = 0, ..., +-n/2}, where integers count only; n = 4, 6, 12;

Delta = sqrt(1 + 4b).  [Kovacic 1986, sections 3.1, 4.1 and 5.1.]  The choice e_c that succeeded is read off theta, which is
sum alpha_c/(x-c), 1/2 sum e_c/(x-c), n/12 sum e_c/(x-c) in the three cases (plus the irregular parts in case 1).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import SemiInvariant
from kovacic.engine.degree_bound import irregular_difference_squared
from kovacic.engine.places import Kind, Place, analyse, rational_square_root
from kovacic.limits import Budget

if TYPE_CHECKING:
    from kovacic.solution import Solution


@dataclass(frozen=True)
class PlaceData:
    """One place: the order of S in Kovacic's sense (meaningless at infinity for S = 0), and his sets.

    `exponents` are the rational exponents of case 1, None where they aren't rational or the place is ramified; `case_2` and
    `case_3` his sets E_c (n = 12 for the latter), None where a ramified or irregular place has none.
    """

    place: Place
    order: int
    exponents: tuple[Fraction, ...] | None
    case_2: tuple[int, ...]
    case_3: tuple[int, ...] | None


@dataclass(frozen=True)
class Choice:
    """e_c (alpha_c in case 1) at one place; None where it isn't a rational number."""

    place: Place
    value: Fraction | None


@dataclass(frozen=True)
class Trace:
    """What `explain` tells beside the solution: the places, and the choices that succeeded (none without a solution)."""

    solution: Solution
    places: tuple[PlaceData, ...]
    choices: tuple[Choice, ...]


def trace_of(solution: Solution) -> Trace:
    """The derivation, recomputed from the answer's certificate."""
    problem = analyse(solution.S, Budget())
    places = tuple(_place_data(place, solution.S) for place in problem.places)
    f = solution.semi_invariant
    if f is None:
        return Trace(solution, places, ())
    scale = {1: Fraction(1), 2: Fraction(2)}.get(f.degree, Fraction(12, f.degree))
    residues = [(place, _residue(f.theta, place)) for place in problem.finite_places]
    choices = [Choice(place, None if value is None else scale * value) for place, value in residues]
    known = [value * place.degree for place, value in residues if value is not None]
    infinite = scale * (f.P.degree + sum(known)) if len(known) == len(residues) else None
    return Trace(solution, places, (*choices, Choice(problem.infinity, infinite)))


def _place_data(place: Place, S: RatFunc) -> PlaceData:
    infinite = place.at_infinity
    order = -S.degree if infinite else place.order
    delta = place.delta
    exponents: tuple[Fraction, ...] | None = None
    case_2: tuple[int, ...]
    case_3: tuple[int, ...] | None
    if place.kind is Kind.ORDINARY or (infinite and place.order == 1):
        exponents, case_2 = (Fraction(0), Fraction(1)), (0, 2, 4)
        case_3 = tuple(range(13))
    elif place.order == 1:
        exponents, case_2, case_3 = (Fraction(1),), (4,), (12,)
    elif place.kind is Kind.REGULAR:
        if delta is None:
            case_2, case_3 = (2,), (6,)
        else:
            exponents = tuple(sorted({(1 - delta) / 2, (1 + delta) / 2}))
            case_2 = _integers(2 + k * delta for k in (-2, 0, 2))
            case_3 = _integers(6 + k * delta for k in range(-6, 7))
    else:
        case_2, case_3 = (order,), None
        if place.kind is Kind.UNRAMIFIED:
            exponents = _irregular_exponents(place)
    return PlaceData(place, order, exponents, case_2, case_3)


def _irregular_exponents(place: Place) -> tuple[Fraction, ...] | None:
    """(nu +- b/a)/2, or (-nu +- b/a)/2 at infinity, where b/a is rational."""
    square = irregular_difference_squared(place)
    ratio = rational_square_root(square) if square.degree <= 0 else None
    if ratio is None:
        return None
    nu = 2 - place.weight if place.at_infinity else place.weight
    return tuple(sorted({(nu - ratio) / 2, (nu + ratio) / 2}))


def _integers(values: object) -> tuple[int, ...]:
    return tuple(sorted({int(v) for v in values if v.denominator == 1}))  # type: ignore[attr-defined]


def _residue(theta: RatFunc, place: Place) -> Fraction | None:
    """The residue of theta at the roots of a factor, where theta has simple poles with one rational residue there."""
    field = theta.num.field
    factor = place.factor.over(field)
    cofactor, k = theta.den.remove(factor)
    if k != 1:
        return Fraction(0) if k == 0 and factor.gcd(theta.den).degree == 0 else None
    value = theta.num * (cofactor * factor.derivative()).inverse_modulo(factor) % factor
    return field.rational_value(value) if value.degree <= 0 else None


def rational_form(trace: Trace, form: SemiInvariant) -> RatFunc | None:
    """The form as a rational function, where its valuations are integers: P times powers of the factors of the poles."""
    result = RatFunc(form.P)
    for data in trace.places:
        if not data.place.at_infinity:
            value = _residue(form.theta, data.place)
            if value is None or value.denominator != 1:
                return None
            result = result * RatFunc(data.place.factor) ** value.numerator
    return result
