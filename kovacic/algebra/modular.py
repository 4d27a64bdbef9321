"""Power series and linear algebra over F_p.  All polynomials are flint's `nmod_poly` modulo one prime p.

A series to order L is a polynomial of degree below L; the prime must exceed every order L.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count
from operator import mul
from typing import Any

from flint import fmpz, fmpz_mod_poly_ctx, nmod_mat, nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.limits import check_duration, check_time

#: Equations beyond the number of unknowns in a linear system modulo p, so that a chance solution is improbable.
EXTRA_EQUATIONS = 4


def translate(polynomial: Any, point: int) -> Any:
    """`polynomial(t + point)`."""
    return polynomial if point == 0 else polynomial.compose(nmod_poly([point, 1], polynomial.modulus()))


def reverse(polynomial: Any, degree: int) -> Any:
    """`t**degree * polynomial(1/t)`; degree must be at least that of the polynomial."""
    return polynomial.reverse().left_shift(degree - polynomial.degree()) if polynomial else polynomial


def integers_by_size() -> Iterator[int]:
    """0, 1, -1, 2, -2, ..."""
    return (n // 2 if n % 2 == 0 else -(n // 2) for n in count(1))


def ordinary_point(den: Any) -> int:
    """The first of the integers 0, 1, -1, 2, ... at which den doesn't vanish."""
    return next(point for point in integers_by_size() if den(point))


def fundamental_system(num: Any, den: Any, order: int) -> tuple[Any, Any]:
    """y1 = 1 + O(t^2) and y2 = t + O(t^2) with `y'' = (num/den) y`, to `order` terms; den(0) must not vanish.

    Newton's iteration: with residuals r_i = S y_i - y_i'' the corrections are those of the variation of constants,
    y2 int(y1 r_i) - y1 int(y2 r_i), for the Wronskian y1 y2' - y1' y2 is 1.  From k right terms the Wronskian is
    1 + O(t^(k-1)), so that a step gives 2k - 1 terms.
    """
    p = num.modulus()
    order = max(order, 2)
    coefficient = num.truncate(order).mul_low(den.truncate(order).inverse_series_trunc(order), order)
    y1 = nmod_poly([1], p)
    y2 = nmod_poly([0, 1], p)
    known = 2
    while known < order:
        known = min(2 * known - 1, order)
        corrections = []
        series = coefficient.truncate(known)
        for y in (y1, y2):
            residual = series.mul_low(y, known) - y.derivative().derivative()
            along1 = y1.mul_low(residual, known - 1).integral()
            along2 = y2.mul_low(residual, known - 1).integral()
            corrections.append(y2.mul_low(along1, known) - y1.mul_low(along2, known))
        y1 = y1 + corrections[0]
        y2 = y2 + corrections[1]
    return y1, y2


def power_series(factors: Sequence[tuple[Any, int]], order: int) -> Any:
    """`prod f**k` as a series to `order` terms, of at least one power; k of either sign, f(0) not 0 where k < 0."""
    above = below = factors[0][0] ** 0
    for factor, exponent in factors:
        if exponent > 0:
            above = above.mul_low(factor.truncate(order).pow_trunc(exponent, order), order)
        elif exponent < 0:
            below = below.mul_low(factor.truncate(order).pow_trunc(-exponent, order), order)
    return above if below == 1 else above.mul_low(below.inverse_series_trunc(order), order)


def null_space(rows: Sequence[Sequence[Any]], columns: int, p: int) -> list[list[int]]:
    """A basis of {c : sum_j rows[i][j] c_j = 0 for all i}."""
    matrix = nmod_mat(len(rows), columns, [entry for row in rows for entry in row], p)
    basis, nullity = matrix.nullspace()
    return [[int(basis[i, j]) for i in range(columns)] for j in range(nullity)]


def echelon_by_degree(polynomials: Sequence[Any]) -> list[Any]:
    """The reduced echelon basis of the span: monic, of increasing degrees, no leading power occurring in another member.

    This basis depends on the span alone, so that its images modulo different primes belong together.
    """
    if not polynomials:
        return []
    p = polynomials[0].modulus()
    width = max(f.length() for f in polynomials)
    entries = [f[width - 1 - k] for f in polynomials for k in range(width)]
    reduced, rank = nmod_mat(len(polynomials), width, entries, p).rref()
    basis = [nmod_poly([reduced[i, width - 1 - k] for k in range(width)], p) for i in range(rank)]
    return basis[::-1]


def rational_function_from_series(series: Any, order: int, top: int) -> tuple[Any, Any] | None:
    """(A, B) with A = B series + O(t^order), deg A <= top, B(0) = 1, deg B < order - top, both least; None without one.

    A/B is unique: for two such pairs A B' - A' B has a degree below `order` and no term there.  The coefficients of t^k with
    top < k < order say that the series satisfies a linear recurrence, the shortest of which is Berlekamp and Massey's.
    Reference: J. von zur Gathen and J. Gerhard, Modern Computer Algebra, sections 5.7 and 12.3.
    """
    p = series.modulus()
    size = order - top - 1
    check_duration(_RECURRENCE_SECONDS * size, f"a recurrence of {size} terms")
    terms = series.truncate(order).left_shift(max(size - top - 1, 0)).coeffs()[max(top + 1 - size, 0) :]
    recurrence = fmpz_mod_poly_ctx(p).minpoly([int(c) for c in terms] + [0] * (2 * size - len(terms)))
    check_time()
    B = nmod_poly([int(c) for c in recurrence.coeffs()][::-1], p)
    A = series.mul_low(B, order)
    return (A, B) if B.degree() <= size and A.degree() <= top else None


#: FLINT's time for the shortest recurrence, per term; it is one call, which can't be interrupted.
_RECURRENCE_SECONDS = 4e-5
#: Terms of a solution that are computed one by one before their share of all later ones is added.
_TERMS_IN_A_BLOCK = 64


def series_solution(second: Any, first: Any, zeroth: Any, order: int) -> Any:
    """u = 1 + O(t) with `second u'' + first u' + zeroth u = 0` to `order` terms, at a singular point t = 0.

    second(0) = 0, and the coefficient of t^(j-1) determines u_j through the indicial factor
    `j (second_1 (j - 1) + first_0)`.  The terms are computed in halves: the first half's share of the coefficients that
    determine the second half comes from products of polynomials [van der Hoeven, J. Symb. Comp. 34 (2002)].
    Raises `BadPrimeError` if the indicial factor vanishes modulo p for some j below `order`.
    """
    p = second.modulus()
    second_1 = int(second[1])
    first_0 = int(first[0])
    operators = [second.right_shift(2), first.right_shift(1), zeroth]
    a, b, c = ([int(v) for v in f.coeffs()[:_TERMS_IN_A_BLOCK]] for f in operators)
    terms = twice_weighted, weighted, u = [0, 0], [0, 0], [0, 1]  # k (k - 1) u_k, k u_k and u_k, from place 1 on
    shares = [0] * order
    reach = max(map(len, (a, b, c)))

    def extend_one_by_one(start: int, end: int) -> None:
        for j in range(start or 1, end):
            indicial = j * (second_1 * (j - 1) + first_0) % p
            if not indicial:
                raise BadPrimeError(f"{p} divides an indicial factor")
            # Scalar products of the coefficients with the last terms, backwards.
            back = start if j < start + reach else j - reach
            total = sum(map(mul, c, u[:back:-1]), shares[j])
            total = sum(map(mul, b, weighted[:back:-1]), total)
            total = sum(map(mul, a, twice_weighted[:back:-1]), total)
            value = -total * pow(indicial, -1, p) % p
            u.append(value)
            weighted.append(j * value % p)
            twice_weighted.append(j * (j - 1) * value % p)

    def extend(start: int, end: int) -> None:
        check_time()
        if end - start <= _TERMS_IN_A_BLOCK:
            extend_one_by_one(start, end)
            return
        middle = (start + end + 1) // 2
        width = end - start - 1
        extend(start, middle)
        blocks = [nmod_poly(row[start + 1 : middle + 1], p) for row in terms]
        share = sum((f.mul_low(g, width) for f, g in zip(operators, blocks, strict=True)), nmod_poly([], p))
        for j, value in enumerate(share.coeffs()[middle - 1 - start :], middle):
            shares[j] += int(value)
        extend(middle, end)

    extend(0, order)
    return nmod_poly(u[1:], p)


def square_root_modulo(value: int, p: int) -> int | None:
    """A square root modulo p, or None for a non-residue."""
    return None if fmpz(value).jacobi(p) == -1 else int(fmpz(value % p).sqrtmod(p))


def square_root_series(series: Any, order: int, root: int) -> Any:
    """The square root with constant term `root` (not 0) of a series, to `order` terms."""
    p = series.modulus()
    half = pow(2, -1, p)
    result = nmod_poly([root], p)
    known = 1
    while known < order:
        known = min(2 * known, order)
        result = (result + series.truncate(known).mul_low(result.inverse_series_trunc(known), known)) * half
        result = result.truncate(known)
    return result


def simple_roots(polynomial: Any) -> Iterator[int]:
    """The simple roots in F_p, in increasing order."""
    return iter(sorted(int(root) for root, multiplicity in polynomial.roots() if multiplicity == 1))
