"""Kovacic's families of exponents for a rational omega, and the numbers that occur in them.

At a pole c a solution with a rational omega has the singular part [sqrt S]_c and one of the exponents alpha_c^+-, and so it is
at infinity; a family chooses one at every point.  Then d = alpha_inf - sum alpha_c is the degree of P, and theta, the sum of
the parts, follows.  Numbers lie in the field K of S, or in one that square roots are adjoined to.  Poles of degree 1 or 2 over
K are taken one by one; where more are conjugate, only families in which these have equal exponents are formed.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), section 3.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.extension import AlgebraicField, root_modulo
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import LARGE_DEGREE
from kovacic.engine.places import Kind, Place
from kovacic.limits import check_time

ExactNumber = int | Fraction | Poly


@dataclass(frozen=True)
class SingularPoint:
    """A pole c (`at`), infinity (`at` is None), or `count` conjugate poles that are taken together (None, too)."""

    place: Place
    at: Poly | None = None
    count: int = 1

    def factor(self, field: Field) -> Poly:
        """x - c, or the polynomial of conjugate poles that are taken together, over an extension of the field."""
        return self.place.factor.over(field) if self.at is None else field.x - self.at


@dataclass(frozen=True)
class Choice:
    """alpha_c or e_c, and +-[sqrt r]_c as pairs (power of x - c, or of x at infinity; coefficient)."""

    value: ExactNumber
    singular: tuple[tuple[int, Poly], ...] = ()


class Roots:
    """The field of all numbers that occur, to which square roots are adjoined on demand, each under a `name` or its own."""

    def __init__(self, field: Field, name: str = "") -> None:
        self.field = field
        self._name = name

    def root(self, square: Poly) -> Poly | None:
        """A square root, adjoined if need be; None if the field would become too large."""
        found = self.field.sqrt(square.over(self.field))
        if found is None and self.field.absolute_degree < LARGE_DEGREE:
            outer, inner = square.square_part() if isinstance(square, FunctionPoly) else (1, square)
            radicand = -inner.over(self.field)
            self.field = AlgebraicField(self.field, self.field.poly([radicand, 0, 1]), self._name or f"sqrt({inner})")
            found = self.field.generator * outer
        return found


def natural(d: ExactNumber) -> int | None:
    """The number as an integer if it is 0, 1, 2, ..., else None."""
    value = d.field.rational_value(d) if isinstance(d, Poly) else Fraction(d)
    return None if value is None or value < 0 or value.denominator > 1 else value.numerator


def points_of_place(place: Place, roots: Roots) -> list[SingularPoint]:
    """The roots of the factor one by one (degree 1, or degree 2 at a regular place), else all together."""
    p = place.factor
    if place.degree == 1:
        return [SingularPoint(place, -p[0])]
    if place.degree == 2 and place.order <= 2:
        half = roots.root(p[1] * p[1] / 4 - p[0])
        if half is not None:
            return [SingularPoint(place, sign * half - p[1] / 2) for sign in (-1, 1)]
    return [SingularPoint(place, None, place.degree)]


def first_case_choices(place: Place, roots: Roots) -> tuple[Choice, ...] | None:
    """Step 1 for m = 1: (c1) to (c3), (inf1) to (inf3); None if the exponents aren't square roots of constants."""
    if place.kind is Kind.ORDINARY or (place.at_infinity and place.order == 1):
        return (Choice(0), Choice(1))
    if place.order > 2:
        return _irregular(place, roots) if place.degree == 1 and place.order % 2 == 0 else None
    if place.order == 1:
        return (Choice(1),)
    # alpha = 1/2 + Delta/2 and 1/2 - Delta/2, once where they are equal.
    delta = None if place.delta_squared is None else roots.root(place.delta_squared)
    if delta is None:
        return None
    signs = (1, -1) if delta else (1,)
    return tuple(Choice((1 + sign * delta) / 2) for sign in signs)


def _irregular(place: Place, roots: Roots) -> tuple[Choice, ...] | None:
    """(c3) and (inf3) of section 3.1: r = s t^(-2 nu) w^2, w = 1 + ..., so [sqrt r] begins with a = sqrt s, and
    b/a = 2 a w_k for the first term w_k that isn't in [sqrt r].
    """
    count = place.order // 2  # of the terms up to w_k
    sign = -1 if place.at_infinity else 1
    nu = count - 2 if place.at_infinity else count
    p = place.factor
    V = place.unit(count)
    leading = V % p
    a = roots.root(leading)
    if a is None:
        return None
    series = root_modulo(V / leading, p, 2, count)
    assert series is not None  # that of 1
    w = series(place.num.field.poly([-p[0], 1]))
    singular = [(sign * (k - nu), a * w[k]) for k in range(count - 1) if w[k]]
    last = 2 * a * w[count - 1]
    choices = []
    for s in (1, -1):
        terms = tuple((power, s * coefficient) for power, coefficient in singular)
        choices.append(Choice((s * last + sign * nu) / 2, terms))
    return tuple(choices)


#: d = scale * (value at infinity - sum of the values at the poles), and theta has the residues scale * value.
SCALE = {1: Fraction(1), 2: Fraction(1, 2), 4: Fraction(1, 3), 6: Fraction(1, 2), 12: Fraction(1)}


def weight(point: SingularPoint, m: int) -> Fraction | int:
    """The factor of an exponent at this point in d: SCALE[m] at infinity, minus that at a pole."""
    return SCALE[m] if point.place.at_infinity else -SCALE[m]


def families(
    choices: Sequence[Sequence[Choice]], points: Sequence[SingularPoint], m: int, field: Field
) -> list[tuple[tuple[Choice, ...], ExactNumber]]:
    """Step 2: all families, each with its d; conjugate poles that are taken together have equal exponents."""
    zero: ExactNumber = field.zero if m == 1 else 0
    found: list[tuple[tuple[Choice, ...], ExactNumber]] = [((), zero)]
    for point, chosen in zip(points, choices, strict=True):
        check_time()
        factor = weight(point, m) * point.count
        parts = [(choice, zero + factor * choice.value) for choice in chosen]
        found = [((*family, choice), d + part) for family, d in found for choice, part in parts]
    return found


def theta_numerator(
    D: Poly, points: Sequence[SingularPoint], choices: Sequence[Choice], scale: Fraction | int = 1
) -> Poly:
    """D theta for one choice at each point, infinity first: residues `scale` times the exponents, and the singular parts."""
    x = D.field.x
    R = D.field.zero
    at_infinity, *at_poles = choices
    for choice, point in zip(at_poles, points[1:], strict=True):
        f = point.factor(D.field)
        R += D // f * f.derivative() * (scale * choice.value)
        for power, c in choice.singular:
            R += D // f**-power * c
    for power, c in at_infinity.singular:
        R += D * x**power * c
    return R
