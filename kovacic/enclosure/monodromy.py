"""Local exponents and monodromy matrices around the singular points, as enclosures, and the relations between them.

The guarantee: each ball contains the exact entry for the loop `loop`.

Mathematics.  At a double pole zeta of S with b = lim (x - zeta)^2 S the exponents are 1/2 +- sqrt(1/4 + b); around it a
solution basis is multiplied by a matrix M with determinant 1 and trace -2 cos(pi Delta), Delta = sqrt(1 + 4 b) (whether or
not there is a logarithm), and a simple pole has Delta = 1, so trace 2.  These traces come from b alone and the matrices
from analytic continuation: they check each other.  When the differential Galois group is finite of exponent N, M^N = 1; the
monodromy group is a subgroup.

Reference: M. van der Put and M. F. Singer, "Galois Theory of Linear Differential Equations" (2003), ch. 5.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from flint import acb, acb_mat, arb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.ball import Ball, ball_from_flint, ball_to_flint, finite_ball
from kovacic.enclosure.evaluate import with_variable
from kovacic.enclosure.frobenius import basis, junction
from kovacic.enclosure.matrices import Matrix, inverse_matrix, multiply
from kovacic.enclosure.points import ExactPoint, as_point, binary_exponent, midpoint, root_below, to_acb
from kovacic.enclosure.precision import start_bits
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.rational import way_for
from kovacic.enclosure.request import Accuracy, Params, digits_and_limits
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import singular_place
from kovacic.enclosure.way import Traveller
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Budget, Limits, check_time, limited

BallMatrix = tuple[tuple[Ball, Ball], tuple[Ball, Ball]]
_End = ExactPoint | Singular
_Polygon = tuple[_End, list[ExactPoint], _End]  # the first end, vertices, the last end
_Places = list[tuple[ExactPoint, Any]]  # points, each with the largest radius of a square around it


@dataclass(frozen=True)
class LocalMonodromy:
    """One singular point, and the matrix of the way around it.

    Attributes
    ----------
    point : Ball
        The singular point.
    multiplicity : int
        The multiplicity of the pole of S.
    exponents : pair of Ball, or None
        The local exponents; None at an irregular singular point (multiplicity 3 or more).
    trace : Ball or None
        -2 cos(pi Delta), from the exponents.
    loop : tuple of ExactPoint
        Once counter-clockwise around this point alone, from and to the base point.
    matrix : pair of pairs of Ball
        The action of the loop on (y, y') at the base point.

    Examples
    --------
    >>> import kovacic
    >>> (point,) = kovacic.monodromy("-2/(9*x^2)")
    >>> point.multiplicity, point.consistent, point.is_identity_to_the_power(3)
    (2, True, True)
    """

    point: Ball
    multiplicity: int
    exponents: tuple[Ball, Ball] | None
    trace: Ball | None
    loop: tuple[ExactPoint, ...]
    matrix: BallMatrix

    def __repr__(self) -> str:
        return f"<LocalMonodromy around {self.point}>"

    def _repr_latex_(self) -> str:
        rows = [" & ".join(entry._repr_latex_().strip("$") for entry in row) for row in self.matrix]
        around = self.point._repr_latex_().strip("$")
        matrix = r" \\ ".join(rows)
        return rf"$\text{{around }} {around}\colon\ \begin{{pmatrix}} {matrix} \end{{pmatrix}}$"

    def acb_mat(self) -> acb_mat:
        """The matrix as python-flint's, at the working precision in force.

        Examples
        --------
        >>> import kovacic
        >>> (point,) = kovacic.monodromy("-2/(9*x^2)")                  # exponents 1/3, 2/3
        >>> point.acb_mat().det().contains(1)
        True
        """
        return acb_mat([[ball_to_flint(entry) for entry in row] for row in self.matrix])

    @property
    def consistent(self) -> bool:
        """True if the matrix may have the determinant 1 and the trace given by the exponents; False would disprove it."""
        with working_precision(1000):
            m = self.acb_mat()
            return m.det().contains(1) and (self.trace is None or m.trace().overlaps(ball_to_flint(self.trace)))

    def is_identity_to_the_power(self, order: int) -> bool:
        """True if the matrix to this power may be the identity; False proves that it isn't.

        Parameters
        ----------
        order : int
            The power.

        Examples
        --------
        >>> import kovacic
        >>> (point,) = kovacic.monodromy("-2/(9*x^2)")                  # exponents 1/3, 2/3
        >>> point.is_identity_to_the_power(3), point.is_identity_to_the_power(2)
        (True, False)
        """
        with working_precision(1000):
            return bool((self.acb_mat() ** order).contains(acb_mat([[1, 0], [0, 1]])))


@limited
def connection_matrix(
    equation: object,
    path: Sequence[object],
    *,
    params: Params = None,
    var: str | None = None,
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> tuple[tuple[Ball, Ball], tuple[Ball, Ball]]:
    """Balls around the rows of the matrix that turns coordinates of a solution at the first point of `path` into those at the
    last one, where the solution is continued along this polygon.

    Parameters
    ----------
    equation
        S or an equation without a right-hand side, as for `kovacic.evaluate`.
    path : sequence of numbers
        The vertices, at least two.  At an ordinary end the coordinates are (y, y'), at a regular singular one (or "oo") those
        in its Frobenius basis, as for `kovacic.evaluate`.  A path to or from infinity goes along the line through 0 and its
        neighbour.
    params : mapping
        Values of the parameters by name; if these are balls, the radii depend on theirs.
    var : str
        The name of the variable, where the equation is text or a SymPy expression.
    accuracy, digits, limits
        The fields of `Accuracy`, except the method: the radii are at most 10^-digits relative to the largest entry.

    Raises
    ------
    InputError
        For fewer than two vertices, and for a path through a singular point.
    LimitExceeded
        If the limits don't suffice.

    Examples
    --------
    >>> ((a, b), (c, d)) = connection_matrix(([1], [1]), [0, 1])   # cosh, sinh
    >>> float(a), float(b)
    (1.5430806348152437, 1.1752011936438014)
    >>> legendre = "(1-x^2)*y'' - 2*x*y' + 2*y = 0"                # P1 = x is regular at both ends
    >>> (_, log_part), (_, regular_part) = connection_matrix(legendre, [-1, 1])
    >>> log_part.contains(0), regular_part.contains(-1)
    (True, True)

    Reference: the path and the bases are as in ore_algebra's numerical_transition_matrix.
    """
    digits, limits = digits_and_limits("connection_matrix", accuracy=accuracy, digits=digits, limits=limits)
    problem = as_problem(with_variable(equation, var, limits, params), params, constants=True)
    way = _polygon(problem, path)
    budget = Budget(limits)
    prec = start_bits(digits)
    while True:
        with working_precision(prec + 40), budget.watched():
            entries = _connection(problem, way, prec)
            # Relative to the largest entry.
            goal = max((entry.abs_upper() for entry in entries), key=float) * arb(10) ** -digits
            sharp = all(entry.real.rad() + entry.imag.rad() <= goal for entry in entries)
            balls = [ball for ball in map(ball_from_flint, entries) if ball is not None]
        # Entries that aren't finite need a much higher precision.
        if len(balls) < 4:
            prec += prec // 2
        elif sharp or not problem.is_exact:
            return (balls[0], balls[1]), (balls[2], balls[3])
        prec += max(16, prec // 4)
        budget.check()


def _polygon(problem: NumericProblem, path: Sequence[object]) -> _Polygon:
    """The polygon through these vertices; a vertex is inserted if there are only two singular points."""
    if len(path) < 2:
        raise InputError("a path needs at least two vertices")
    first, last = (_end_of_path(problem, value) for value in (path[0], path[-1]))
    middle = [as_point(v, "a vertex") for v in path[1:-1]]
    if len(path) == 2 and isinstance(first, Singular) and isinstance(last, Singular):
        if first.inverted or last.inverted:
            raise InputError("a path between a singular point and infinity needs a vertex", hint="e.g. [0, 1j, 'oo']")
        # Each neighbourhood is left towards an ordinary point.
        middle = [(first.near + last.near).scaled(fmpq(1, 2)).rounded(-64)]
    return first, middle, last


def _end_of_path(problem: NumericProblem, value: object) -> _End:
    """An end of a path, a `Singular` only if it is a singular point."""
    if not problem.is_rational:
        return as_point(value, "an end of the path of an equation whose constants aren't rational")
    place = singular_place(problem, value, "a vertex")
    return place.near if place.is_ordinary else place


def _connection(problem: NumericProblem, way: _Polygon, prec: int) -> Matrix:
    """The matrix to about `prec` bits."""
    first, middle, end = way
    # Both coordinates are 1, so that both columns are computed.
    traveller = Traveller(replace(way_for(problem), prec=prec), first, (acb(1), acb(1)))
    for vertex in middle:
        traveller = traveller.moved(vertex)
    if not isinstance(end, Singular):
        return traveller.moved(end).maps.whole()[0]
    here = traveller.point
    last, bound = junction(end, here, prec)
    there = basis(end, last, here, bound, prec)
    return multiply(inverse_matrix(there), traveller.moved(last).maps.whole()[0])


@limited
def monodromy(
    equation: object,
    *,
    params: Params = None,
    var: str | None = None,
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> tuple[LocalMonodromy, ...]:
    """The local monodromy of y'' = S y at every finite singular point, for one base point above all of them.

    The loops go straight to the points and around them; they generate the fundamental group, and come in the order, seen
    from the base point, in which M_n ... M_1 is the monodromy of a counter-clockwise loop around all of them.

    Parameters
    ----------
    equation
        S or an equation, as for `kovacic.evaluate`; a right-hand side doesn't matter.
    params : mapping
        Values of the parameters by name.
    var : str
        The name of the variable, where the equation is text or a SymPy expression.
    accuracy, digits, limits
        The accuracy of the matrices: the fields of `Accuracy`, except the method.

    Raises
    ------
    LimitExceeded
        If the limits don't suffice.

    Examples
    --------
    >>> (point,) = monodromy(([-2], [0, 0, 9]))   # exponents 1/3, 2/3
    >>> [f"{e.mid.real:.6f}" for e in point.exponents], f"{point.trace.mid.real:.6f}", point.is_identity_to_the_power(3)
    (['0.666667', '0.333333'], '-1.000000', True)
    """
    digits, limits = digits_and_limits("monodromy", accuracy=accuracy, digits=digits, limits=limits)
    given = as_problem(with_variable(equation, var, limits, params), params, constants=True)
    problem = replace(given, gauge=given.gauge * 0, right=None)  # the normal form
    budget = Budget(limits)
    result = []
    for loop, z in _loops(_singular_places(problem)):
        budget.check()
        matrix = connection_matrix(problem, loop, digits=digits, limits=budget.share(1).limits)
        result.append(_local(problem, z, loop, matrix, digits))
    return tuple(result)


def _singular_places(problem: NumericProblem) -> _Places:
    """Rational approximations of the singular points, each with half the distance to its neighbour, at most 1."""
    points = [midpoint(root) for root, _ in problem.poles(64)]
    places = []
    for i, p in enumerate(points):
        check_time()
        # Not above the distance to the nearest other point: discs with half of it as radius are apart.
        gap = min([fmpq(2), *(root_below((p - q).norm_squared(), 1) for j, q in enumerate(points) if j != i)])
        places.append((p.rounded(binary_exponent(gap) - 8), gap / 2))
    return places


def _loops(places: _Places) -> list[tuple[tuple[ExactPoint, ...], ExactPoint]]:
    """Loops from one base point with the points that they enclose, ordered by their directions from left to right.

    The squares around the points keep off the segments to the others, so the segments are a star with the points at its ends.
    """
    if not places:
        return []
    stars = [(base, *_star(base, places)) for base in _base_points(places)]
    base, radii, share = max(stars, key=lambda star: star[2])
    if share == 0:
        raise LimitExceeded("no base point was found that sees the singular points apart", limit="unknown_degree")
    loops = []
    for (z, _), radius in zip(places, radii, strict=True):
        # A segment to a square around the point, the square counter-clockwise, and the segment back.  The first corner lies
        # towards the base point, the others follow by quarter turns.
        corners = [(base - z).scaled(root_below(radius * radius / (base - z).norm_squared(), 1))]
        for _ in range(4):
            corners.append(corners[-1] * ExactPoint(0, 1))
        loops.append(((base, *(z + corner for corner in corners), base), z))
    # By the tangent of the angle at the base point, which lies above all of them.
    return sorted(loops, key=lambda item: (item[1].x - base.x) / (base.y - item[1].y))


def _base_points(places: _Places) -> Iterator[ExactPoint]:
    """Some points above all of the singular ones."""
    centres = [z for z, _ in places]
    spread = max(abs(p.x - q.x) + abs(p.y - q.y) for p in centres for q in centres)
    top = max(z.y for z in centres) + max(fmpq(1), spread)
    middle = sum((z.x for z in centres), fmpq(0)) / len(centres)
    # Beside the middle, by shares that put equally spaced points and mirrored ones in different directions.
    for shift in (1, -3, 10, -17, 29, -41):
        yield ExactPoint(middle + (spread * shift + 1) / 97, top).rounded(binary_exponent(spread) - 10)


def _star(base: ExactPoint, places: _Places) -> tuple[list[Any], Any]:
    """The radii of squares around the singular points that keep off the segments from the base to the others, and the least
    ratio of a radius to the largest allowed one."""
    centres = [z for z, _ in places]
    radii = []
    for z, largest in places:
        check_time()
        radii.append(min([largest, *(_distance_below(z, base, other) for other in centres if other != z)]) / 2)
    return radii, min(radius / largest for radius, (_, largest) in zip(radii, places, strict=True))


def _distance_below(point: ExactPoint, a: ExactPoint, b: ExactPoint) -> Any:
    """A rational number not above the distance of the point from the segment, and at least half of it."""
    step, offset = b - a, point - a
    # The parameter of the foot of the perpendicular; beyond an end of the segment that end is nearest.
    t = (offset.x * step.x + offset.y * step.y) / step.norm_squared()
    nearest = step.scaled(min(max(t, fmpq(0)), fmpq(1)))
    return root_below((offset - nearest).norm_squared(), 1)


def _local(
    problem: NumericProblem, z: ExactPoint, loop: tuple[ExactPoint, ...], matrix: BallMatrix, digits: int
) -> LocalMonodromy:
    prec = int(digits * 3.33) + 60  # some bits more than the matrix has
    with working_precision(prec):
        near = to_acb(z)
        root, multiplicity = min(problem.poles(prec), key=lambda item: float((item[0] - near).abs_upper()))
        exponents = trace = None
        if multiplicity <= 2:
            # b = num/(den''/2) at a double zero of den, and 0 at a simple one.
            num, den = problem.polynomials()
            b = 2 * num(root) / den.derivative().derivative()(root) if multiplicity == 2 else acb(0)
            # rho (rho - 1) = b: rho = 1/2 +- s, and Delta = 2 s.
            s = (arb(1) / 4 + b).sqrt()
            exponents = (finite_ball(arb(1) / 2 + s), finite_ball(arb(1) / 2 - s))
            trace = finite_ball(-2 * (2 * s).cos_pi())
        return LocalMonodromy(finite_ball(root), multiplicity, exponents, trace, loop, matrix)
