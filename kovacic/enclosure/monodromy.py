"""Local exponents and monodromy matrices around the singular points, as enclosures, and what must hold between them.

The guarantee: each ball contains the exact entry, for the loop that is described by `loop`.

Mathematics.  At a double pole zeta of S with b = lim (x - zeta)^2 S the exponents are 1/2 +- sqrt(1/4 + b); around it a
solution basis is multiplied by a matrix M with determinant 1 and trace -2 cos(pi Delta), Delta = sqrt(1 + 4 b) (whether or
not there is a logarithm), and a simple pole has Delta = 1, so trace 2.  These traces come from b alone and the matrices
from analytic continuation: they check each other.  When the differential Galois group is finite of exponent N, M^N = 1; the
monodromy group is a subgroup.

Reference: M. van der Put and M. F. Singer, "Galois Theory of Linear Differential Equations" (2003), ch. 5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from flint import acb, acb_mat, acb_poly, arb

from kovacic.enclosure.ball import Ball, ball_from_flint, ball_to_flint
from kovacic.enclosure.evaluate import connection_matrix
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.problem import System, as_problem
from kovacic.enclosure.working import working_precision
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits

BallMatrix = tuple[tuple[Ball, Ball], tuple[Ball, Ball]]


@dataclass(frozen=True)
class LocalMonodromy:
    """One singular point: its enclosure, the multiplicity of the pole of S, exponents, loop and matrix.

    `exponents` and `trace` (-2 cos(pi Delta), from the exponents) are None at an irregular singular point (multiplicity 3
    or more). The loop runs once counter-clockwise around this point alone, from and to the base point; `matrix` acts on (y,
    y') there.
    """

    point: Ball
    multiplicity: int
    exponents: tuple[Ball, Ball] | None
    trace: Ball | None
    loop: tuple[Point, ...]
    matrix: BallMatrix

    @property
    def consistent(self) -> bool:
        """False would disprove the computation: the trace of the matrix and the exponents, and the determinant 1."""
        with working_precision(1000):
            m = acb_mat([[ball_to_flint(entry) for entry in row] for row in self.matrix])
            return m.det().contains(1) and (self.trace is None or m.trace().overlaps(ball_to_flint(self.trace)))

    def is_identity_to_the_power(self, order: int) -> bool:
        """True if the matrix to this power may be the identity; False proves that it isn't."""
        with working_precision(1000):
            m, one = (
                acb_mat([[ball_to_flint(entry) for entry in row] for row in self.matrix]),
                acb_mat([[1, 0], [0, 1]]),
            )
            t = m.trace() if self.trace is None else ball_to_flint(self.trace)
            before, now = acb(0), acb(1)  # M^n = U_n M - U_(n-1), U_(n+1) = t U_n - U_(n-1) (Cayley and Hamilton)
            for _ in range(order - 1):
                before, now = now, t * now - before
            return bool((m * now - one * before).contains(one))


def monodromy(
    equation: object,
    *,
    params: Mapping[str, object] | None = None,
    digits: int = 15,
    limits: Limits | None = None,
) -> tuple[LocalMonodromy, ...]:
    """The local monodromy of y'' = S y at every finite singular point, for one base point above all of them.

    The loops go straight to the points and around them; they generate the fundamental group, and come in the order, seen
    from the base point, in which M_n ... M_1 is the monodromy of a counter-clockwise loop around all of them.
    Raises LimitExceeded if the limits don't suffice.

    >>> (point,) = monodromy(([-2], [0, 0, 9]))   # exponents 1/3, 2/3
    >>> [f"{e.mid.real:.6f}" for e in point.exponents], f"{point.trace.mid.real:.6f}", point.is_identity_to_the_power(3)
    (['0.666667', '0.333333'], '-1.000000', True)
    """
    limits = limits or DEFAULT_LIMITS
    system = as_problem(equation, params).system
    budget = Budget(limits)
    result = []
    for loop, z in _loops(_places(system)):
        budget.check()
        matrix = connection_matrix(system, loop, digits=digits, limits=budget.share(1).limits)
        result.append(_local(system, z, loop, matrix, digits))
    return tuple(result)


def _places(system: System) -> list[tuple[Point, Fraction]]:
    """Rational approximations of the singular points, each with half the distance to its neighbour (1 if alone)."""
    points, places = system.singular_points(64), []
    for i, p in enumerate(points):
        gap = min([Fraction(2), *(_root_below((p - q).norm_squared()) for j, q in enumerate(points) if j != i)])
        places.append((p.rounded(gap.numerator.bit_length() - gap.denominator.bit_length() - 8), gap / 2))
    return places


def _loops(places: list[tuple[Point, Fraction]]) -> list[tuple[tuple[Point, ...], Point]]:
    """Loops from one base point with the points that they enclose, in the order of their directions (left ones first).

    Each is a segment to a square around the point, the square counter-clockwise, and the segment back.  The squares keep
    off the other segments, so the segments are a star with the points at its ends.
    """
    if not places:
        return []
    centres = [z for z, _ in places]
    spread = max(abs(p.re - q.re) + abs(p.im - q.im) for p in centres for q in centres)
    top = max(z.im for z in centres) + max(Fraction(1), spread)
    middle = sum((z.re for z in centres), Fraction(0)) / len(centres)
    best: tuple[Fraction, Point, list[Fraction]] | None = None
    for shift in (1, -3, 10, -17, 29, -41):
        base = Point(
            (middle + spread * Fraction(shift, 97)).limit_denominator(64) + Fraction(1, 97), top.limit_denominator(64)
        )
        radii = [min([r, *(_distance_below(z, base, other) for other in centres if other != z)]) / 2 for z, r in places]
        narrowest = min(radius / r for radius, (_, r) in zip(radii, places, strict=True))
        if best is None or narrowest > best[0]:
            best = narrowest, base, radii
    assert best is not None
    narrowest, base, radii = best
    if narrowest == 0:
        raise LimitExceeded("no base point was found that sees the singular points apart", limit="unknown_degree")
    quarter, loops = Point(Fraction(0), Fraction(1)), []
    for z, radius in zip(centres, radii, strict=True):
        offset = base - z
        corner = offset.scaled(_root_below(radius * radius / offset.norm_squared()))
        corners = [corner]
        for _ in range(4):
            corners.append(corners[-1] * quarter)
        loops.append(((base, *(z + c for c in corners), base), z))
    return sorted(loops, key=lambda item: (item[1].re - base.re) / (base.im - item[1].im))


def _root_below(square: Fraction) -> Fraction:
    """A rational number with few digits between half the square root and the square root."""
    e = (square.numerator.bit_length() - square.denominator.bit_length()) // 2 - 1
    unit = Fraction(2) ** e
    return next(unit * k for k in (3, 2, 1) if (unit * k) ** 2 <= square)


def _distance_below(point: Point, a: Point, b: Point) -> Fraction:
    """A rational number not above the distance of the point from the segment, and above a third of it."""
    step, offset = b - a, point - a
    t = (offset.re * step.re + offset.im * step.im) / step.norm_squared()
    nearest = a + step.scaled(min(max(t, Fraction(0)), Fraction(1)))
    square = (point - nearest).norm_squared()
    return _root_below(square) if square else Fraction(0)


def _local(system: System, z: Point, loop: tuple[Point, ...], matrix: BallMatrix, digits: int) -> LocalMonodromy:
    prec = int(digits * 3.33) + 60
    with working_precision(prec):
        near = to_acb(z)
        root, multiplicity = min(system.roots("den", prec), key=lambda item: float((item[0] - near).abs_upper()))
        exponents = trace = None
        if multiplicity <= 2:
            b = acb(0)
            if multiplicity == 2:  # b = num/(den''/2) at the double zero
                den = acb_poly(list(system.den)).derivative().derivative()
                b = 2 * acb_poly(list(system.num))(root) / den(root)
            s = (arb(1) / 4 + b).sqrt()
            exponents = (_ball(arb(1) / 2 + s), _ball(arb(1) / 2 - s))
            trace = _ball(-2 * (2 * s).cos_pi())
        return LocalMonodromy(_ball(root), multiplicity, exponents, trace, loop, matrix)


def _ball(value: acb) -> Ball:
    ball = ball_from_flint(value)
    if ball is None:
        raise LimitExceeded("a local exponent has no finite enclosure at this precision", limit="digits")
    return ball
