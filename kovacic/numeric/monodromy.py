"""Local exponents and monodromy matrices around the singular points, as enclosures, and what must hold between them.

The guarantee: each ball contains the exact entry, for the loop that is described by `loop`.

Mathematics.  At a double pole zeta of S with b = lim (x - zeta)^2 S the exponents are 1/2 +- sqrt(1/4 + b); around it
a solution
basis is multiplied by a matrix M with determinant 1 and trace -2 cos(pi Delta), Delta = sqrt(1 + 4 b) (whether or not
there is a
logarithm), and a simple pole has Delta = 1, so trace 2.  These traces come from b alone and the matrices from
analytic continuation: they
check each other.  When the differential Galois group is finite of exponent N, M^N = 1; the monodromy group is a
subgroup.

Reference: M. van der Put and M. F. Singer, "Galois Theory of Linear Differential Equations" (2003), ch. 5.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.numeric.ball import Ball, ball_from_flint, ball_to_flint
from kovacic.numeric.evaluate import transition_matrix
from kovacic.numeric.points import Point
from kovacic.numeric.problem import as_problem
from kovacic.numeric.singular import System

if TYPE_CHECKING:
    from flint import acb

BallMatrix = tuple[tuple[Ball, Ball], tuple[Ball, Ball]]


@dataclass(frozen=True)
class LocalMonodromy:
    """One singular point: its enclosure, the multiplicity of the pole of S, exponents, loop and matrix.

    `exponents` and `trace` (-2 cos(pi Delta), from the exponents) are None at an irregular singular point
    (multiplicity 3 or more).
    The loop runs once counter-clockwise around this point alone, from and to the base point; `matrix` acts on (y, y')
    there.
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
        (a, b), (c, d) = self.matrix
        determinant = _sum_of_products(a, d, b, c, -1)
        if not determinant.overlaps(Ball.exact(1)):
            return False
        return self.trace is None or _sum_of_products(a, Ball.exact(1), d, Ball.exact(1), 1).overlaps(self.trace)

    def is_identity_to_the_power(self, order: int) -> bool:
        """True if the matrix to this power may be the identity; False proves that it isn't."""
        from flint import acb, ctx

        with ctx.workprec(1000):
            a, b, c, d = (ball_to_flint(entry) for row in self.matrix for entry in row)
            t = a + d if self.trace is None else ball_to_flint(self.trace)
            before, now = acb(0), acb(1)  # M^n = U_n M - U_(n-1), U_(n+1) = t U_n - U_(n-1) (Cayley and Hamilton)
            for _ in range(order - 1):
                before, now = now, t * now - before
            entries = (now * a - before - 1, now * b, now * c, now * d - before - 1)
            return all(entry.contains(0) for entry in entries)


def monodromy(equation: object, *, digits: int = 15, limits: Limits | None = None) -> tuple[LocalMonodromy, ...]:
    """The local monodromy of y'' = S y at every finite singular point, for one base point above all of them.

    The loops are ordered by the real parts of the singular points (then by the imaginary parts), which isn't a
    standard system of
    generators: every matrix is right by itself, while their product need not be the monodromy at infinity.
    Raises LimitExceeded if the limits don't suffice.

    >>> (point,) = monodromy(([-2], [0, 0, 9]))   # exponents 1/3, 2/3
    >>> [f"{e.mid.real:.6f}" for e in point.exponents], f"{point.trace.mid.real:.6f}", point.is_identity_to_the_power(3)
    (['0.666667', '0.333333'], '-1.000000', True)
    """
    limits = limits or DEFAULT_LIMITS
    system = as_problem(equation).system
    budget = Budget(limits)
    places = _places(system)
    if not places:
        return ()
    base = Point(
        Fraction(sum(z.re for z, _ in places), len(places)),
        max(z.im for z, _ in places) + max(Fraction(1), _spread([z for z, _ in places])),
    )
    base = Point(base.re.limit_denominator(64) + Fraction(1, 97), base.im.limit_denominator(64))
    result = []
    for index, (z, radius) in enumerate(places):
        budget.check()
        loop = _loop(base, z, radius, [p for j, (p, _) in enumerate(places) if j != index])
        matrix = transition_matrix(system, loop, digits=digits, limits=limits)
        result.append(_local(system, index, loop, matrix, digits))
    return tuple(result)


def _spread(points: list[Point]) -> Fraction:
    return max((abs(p.re - q.re) + abs(p.im - q.im) for p in points for q in points), default=Fraction(0))


def _places(system: System) -> list[tuple[Point, Fraction]]:
    """Rational approximations of the singular points, each with half the distance to its neighbour (1 if alone)."""
    points = []
    for root, _ in _sorted_roots(system, 64):
        parts = [part.mid().man_exp() for part in (root.real, root.imag)]
        points.append(Point(*(Fraction(int(m)) * Fraction(2) ** int(e) for m, e in parts)))
    places = []
    for i, p in enumerate(points):
        gaps = [_root_below((p - q).norm_squared()) for j, q in enumerate(points) if j != i]
        places.append((p, min([Fraction(2), *gaps]) / 2))
    return places


def _root_below(square: Fraction) -> Fraction:
    """A rational number with few digits between half the square root and the square root."""
    e = (square.numerator.bit_length() - square.denominator.bit_length()) // 2 - 1
    unit = Fraction(2) ** e
    return next(unit * k for k in (3, 2, 1) if (unit * k) ** 2 <= square)


def _sorted_roots(system: System, prec: int) -> list[tuple[acb, int]]:
    return sorted(system.roots("den", prec), key=lambda item: (float(item[0].real.mid()), float(item[0].imag.mid())))


def _loop(base: Point, z: Point, radius: Fraction, others: list[Point]) -> tuple[Point, ...]:
    """A polygon from the base point to a square around z, counter-clockwise, and back the same way.

    The way to the square is a straight line, bent aside where it would come close to another singular point.
    """
    r = radius / 2
    unit = Fraction(2) ** (r.numerator.bit_length() - r.denominator.bit_length() - 6)
    centre = Point(round(z.re / unit) * unit, round(z.im / unit) * unit)
    corners = [centre + Point(r * x, r * y) for x, y in ((0, 1), (-1, 0), (0, -1), (1, 0), (0, 1))]
    for bend in (0, 1, -1, 2, -2, 3, -3, 5, -5, 8, -8, 13, -13):
        middle = (base + corners[0]).scaled(Fraction(1, 2)) + Point(Fraction(bend) * abs(base.im - z.im) / 16)
        way = [base, middle]
        if all(_far(o, base, middle, radius / 8) and _far(o, middle, corners[0], radius / 8) for o in others):
            return (*way, *corners, *reversed(way))
    raise LimitExceeded("no simple loop around one of the singular points was found", limit="unknown_degree")


def _far(point: Point, a: Point, b: Point, distance: Fraction) -> bool:
    """True if the point keeps this distance from the segment."""
    step, offset = b - a, point - a
    size = step.norm_squared()
    t = (offset.re * step.re + offset.im * step.im) / size if size else Fraction(0)
    t = min(max(t, Fraction(0)), Fraction(1))
    return (offset - step.scaled(t)).norm_squared() > distance * distance


def _local(system: System, index: int, loop: tuple[Point, ...], matrix: BallMatrix, digits: int) -> LocalMonodromy:
    from flint import acb, acb_poly, arb, ctx

    prec = int(digits * 3.33) + 60
    with ctx.workprec(prec):
        root, multiplicity = _sorted_roots(system, prec)[index]
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


def _sum_of_products(a: Ball, b: Ball, c: Ball, d: Ball, sign: int) -> Ball:
    from flint import ctx

    with ctx.workprec(1000):
        return _ball(ball_to_flint(a) * ball_to_flint(b) + sign * ball_to_flint(c) * ball_to_flint(d))
