"""Polynomial conditions for unknowns of bounded degree.

A form F = Q0 P of degree m in the solutions, with a known Q0 and deg P <= N, exists for those parameter values at which the
linear map P -> A_(m+1) of `kovacic.engine.riccati` has a kernel; a solution exp(int theta) P, deg P = d, where
P -> P'' + 2 theta P' + (theta' + theta^2 - S) P has one. Where the generic rank is r, it drops exactly at the common zeros
of the r-minors. Random combinations of the minors (by the theorem of Cauchy and Binet, determinants of U M V) vanish there
too, so that their common factors contain every such value; which of these values really are special is for the engine to
say."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from math import lcm
from random import Random
from typing import Any

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_mat, nmod_mat

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.modular import BadPrimeError
from kovacic.algebra.poly import Poly
from kovacic.algebra.sparse import factorisation
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, singular_part
from kovacic.parametric.pivots import without_constant_pivots

#: Determinants whose common factors are taken.
_DETERMINANTS = 3


def has_constant_rational_exponents(problem: Problem) -> bool:
    """Are all exponent differences rational numbers, without unramified irregular places?"""
    return all(
        place.kind in (Kind.ORDINARY, Kind.RAMIFIED) or (place.kind is Kind.REGULAR and place.delta is not None)
        for place in problem.places
    )


def degrees_that_decide(problem: Problem) -> list[int]:
    """Degrees m such that every Liouvillian equation with these exponents has a rational form of one of them.

    2 and q for the reducible ones, q the common denominator of the exponents: if y1 = prod (x - c)^(e_c) P is the only
    solution with a rational omega, y1^q is rational; 4 for the imprimitive ones; 12 for the primitive ones.
    """
    regular = [place for place in problem.places if place.kind is Kind.REGULAR and place.delta is not None]
    exponents = [(1 + sign * place.delta) / 2 for place in regular for sign in (1, -1) if place.delta is not None]
    degrees = {4}
    if not any(place.kind is Kind.RAMIFIED for place in problem.places):
        degrees |= {2, lcm(*(e.denominator for e in exponents)), 12}
    return sorted(degrees)


def least_valuation(place: Place, m: int) -> int | None:
    """The least valuation of a rational form of degree m, whether or not there is a logarithm."""
    if place.kind is Kind.ORDINARY:
        return 0
    if place.kind is not Kind.REGULAR:
        exact = Fraction(m * place.order, 4)
        return int(exact) if exact.denominator == 1 else None
    if place.delta is None:
        return m // 2 if m % 2 == 0 else None
    candidates = (Fraction(m, 2) + Fraction(2 * k - m, 2) * place.delta for k in range(m + 1))
    return min((int(v) for v in candidates if v.denominator == 1), default=None)


@dataclass(frozen=True)
class RankConditions:
    """Irreducible polynomials that vanish where a rank drops; `complete` False where it may drop elsewhere too.

    With several parameters the minors may have common zeros where their common divisor doesn't vanish, unless there is one
    minor only.  `certain` are those polynomials at whose zeros the rank is known to drop.
    """

    polynomials: list[Poly]
    certain: list[Poly] = field(default_factory=list)
    complete: bool = True


_NEVER = RankConditions([])


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically."""
    valuations = [least_valuation(place, m) for place in problem.places]
    known = [v for v in valuations if v is not None]
    if len(known) < len(valuations):
        return _NEVER
    N = m - known[-1] - sum(v * place.degree for v, place in zip(known, problem.finite_places, strict=False))
    if N < 0:
        return _NEVER
    R0 = singular_part(problem, known[:-1])
    x = problem.field.poly([0, 1])
    images = []
    for j in range(N + 1):
        images.append(Form(m, R0, x**j).numerators(problem)[-1])
        problem.budget.check()
    return rank_conditions(images, problem)


def rank_conditions(images: list[Poly], problem: Problem) -> RankConditions:
    """Where do the polynomials span less than generically?"""
    field = problem.field
    assert isinstance(field, FunctionField)
    columns = []
    for image in images:
        problem.budget.check()
        columns.append(_integral(image))
    rows, eliminated = without_constant_pivots(columns, problem.budget)
    rank = _generic_rank(images, field) - eliminated
    if rank == 0:
        return _NEVER
    single = len(rows) == len(rows[0]) == rank
    zero = common = field.context.constant(0)
    random = Random(20240229)
    for _ in range(1 if single else _DETERMINANTS):
        problem.budget.check()
        determinant = _determinant(_mixed(rows, rank, random, zero), problem)
        if determinant.is_constant() and not determinant.is_zero():
            return _NEVER
        common = common.gcd(determinant)
    factors = irreducible_factors(FunctionPoly(field, common, field.context.constant(1)))
    undefined = union([irreducible_factors(denominator) for image in images for denominator in denominators(image)])
    certain = [factor for factor in factors if factor not in undefined] if single else []
    return RankConditions(factors, certain, complete=single or len(field.names) == 1)


def rank_drops(images: list[Poly], function: Poly) -> bool | None:
    """Do the polynomials span less at the zeros of an irreducible polynomial in the only parameter?  Exact.

    The parameter becomes the companion matrix of the polynomial.  None with more than one parameter.
    """
    field = function.field
    assert isinstance(field, FunctionField)
    if len(field.names) > 1:
        return None
    companion = _companion(function)
    size = companion.nrows()
    height = max((image.degree for image in images), default=-1) + 1
    blocks = fmpq_mat(height * size, len(images) * size)
    for j, image in enumerate(images):
        for i, entry in _integral(image).items():
            block = _at_matrix(entry, companion)
            for a in range(size):
                for b in range(size):
                    blocks[i * size + a, j * size + b] = block[a, b]
    return bool(blocks.rank() < size * _generic_rank(images, field))


def _companion(function: Poly) -> Any:
    """A rational matrix whose minimal polynomial is the given one, up to a factor."""
    assert isinstance(function, FunctionPoly)
    coefficients = {int(e[1]): int(c) for e, c in function.num.to_dict().items()}
    n = max(coefficients)
    matrix = fmpq_mat(n, n)
    for i in range(n - 1):
        matrix[i + 1, i] = 1
    for i in range(n):
        matrix[i, n - 1] = fmpq(-coefficients.get(i, 0), coefficients[n])
    return matrix


def _at_matrix(polynomial: Any, matrix: Any) -> Any:
    n = matrix.nrows()
    total = fmpq_mat(n, n)
    identity = fmpq_mat(n, n)
    for i in range(n):
        identity[i, i] = 1
    coefficients = {int(e[1]): int(c) for e, c in polynomial.to_dict().items()}
    for power in range(max(coefficients, default=-1), -1, -1):
        total = total * matrix + identity * fmpq(coefficients.get(power, 0))
    return total


def irreducible_factors(function: Poly) -> list[Poly]:
    """The irreducible factors over Q of the numerator of an element of Q(t)."""
    assert isinstance(function, FunctionPoly)
    one = function.field.context.constant(1)
    return [FunctionPoly(function.field, factor, one) for factor, _ in factorisation(function.num)[1]]


def _integral(image: Poly) -> dict[int, Any]:
    """The coefficients, multiplied by their common denominator."""
    assert isinstance(image, FunctionPoly)
    numerator = FunctionPoly(image.field, image.num, image.field.context.constant(1))
    return {k: c.num for k, c in enumerate(numerator.coefficients()) if c}


def _generic_rank(images: list[Poly], field: FunctionField) -> int:
    height = max((image.degree for image in images), default=-1) + 1
    if not height:
        return 0
    best = 0
    for h, _ in zip(field.homomorphisms(), range(3), strict=False):
        try:
            values = [h(image) for image in images]
        except BadPrimeError:
            continue
        entries = [int(value[i]) for value in values for i in range(height)]
        best = max(best, int(nmod_mat(len(values), height, entries, h.p).rank()))
    return best


def _mixed(rows: list[list[Any]], rank: int, random: Random, zero: Any) -> list[list[Any]]:
    """U M V with random small integer matrices, of size rank."""

    def combinations(vectors: list[list[Any]]) -> list[list[Any]]:
        if len(vectors) == rank:
            return vectors
        mixed = []
        for _ in range(rank):
            weights = [random.randint(-3, 3) for _ in vectors]
            columns = zip(*vectors, strict=True)
            mixed.append([sum((w * c for w, c in zip(weights, column, strict=True)), zero) for column in columns])
        return mixed

    half = combinations(rows)
    return combinations([list(column) for column in zip(*half, strict=True)])


def _determinant(matrix: list[list[Any]], problem: Problem) -> Any:
    """Up to its sign: with one parameter by interpolation, with several by Bareiss' elimination without fractions."""
    field = problem.field
    assert isinstance(field, FunctionField)
    if len(field.names) == 1:
        return _interpolated_determinant(matrix, problem, field)
    rows = [list(row) for row in matrix]
    n, previous = len(rows), field.context.constant(1)
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if not rows[i][k].is_zero()), None)
        if pivot is None:
            return field.context.constant(0)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                problem.budget.check()
                rows[i][j] = (rows[k][k] * rows[i][j] - rows[i][k] * rows[k][j]) // previous
        previous = rows[k][k]
    return rows[-1][-1]


def _interpolated_determinant(matrix: list[list[Any]], problem: Problem, field: FunctionField) -> Any:
    """The determinant as a polynomial in the only parameter, from its values at integers."""
    terms = [[{int(e[1]): int(c) for e, c in entry.to_dict().items()} for entry in row] for row in matrix]
    degree = max((e for row in terms for entry in row for e in entry), default=0)
    powers = [fmpz_mat([[entry.get(k, 0) for entry in row] for row in terms]) for k in range(degree, -1, -1)]
    bound = sum(max((e for entry in row for e in entry), default=0) for row in terms)
    nodes = [(k + 1) // 2 * (-1) ** k for k in range(bound + 1)]
    values = []
    for node in nodes:
        problem.budget.check()
        value = powers[0]
        for coefficient in powers[1:]:
            value = value * node + coefficient
        values.append(fmpq(value.det()))
    # Newton's divided differences, and Horner's scheme.
    for k in range(1, bound + 1):
        for i in range(bound, k - 1, -1):
            values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - k])
    total = fmpq_poly([])
    for node, value in zip(reversed(nodes), reversed(values), strict=True):
        total = total * fmpq_poly([-node, 1]) + value
    return field.context.from_dict({(0, k): c.p for k, c in enumerate(total.coeffs()) if c})


def denominators(polynomial: Poly) -> list[Poly]:
    """The denominators of the coordinates of a polynomial over an extension of Q(t), as elements of Q(t)."""
    leaves = [leaf for leaf in polynomial.leaves() if isinstance(leaf, FunctionPoly) and not leaf.den.is_one()]
    return [FunctionPoly(leaf.field, leaf.den, leaf.field.context.constant(1)) for leaf in leaves]


def union(lists: list[list[Poly]]) -> list[Poly]:
    """The different polynomials of several lists, in order."""
    return reduce(lambda known, new: [*known, *(f for f in new if f not in known)], lists, [])
