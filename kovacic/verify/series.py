"""Power series modulo a prime, by the plainest methods, for recomputing the negative claims.

A series to `count` terms is an `nmod_poly` of degree below `count`.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import mul
from typing import Any

from flint import nmod_mat, nmod_poly

from kovacic.limits import check_time
from kovacic.verify.primes import BadPrimeError

#: Terms that are computed one by one, between two looks at the clock.
_BLOCK_OF_TERMS = 32


def solutions_at_ordinary_point(num: Any, den: Any, count: int) -> tuple[Any, Any]:
    """y1 = 1 + O(t^2) and y2 = t + O(t^2) with den y'' = num y, to `count` terms, where den(0) isn't 0.

    Variation of constants: the Wronskian of y1, y2 is 1, so that y + y2 int(y1 r) - y1 int(y2 r) solves y'' = S y + O(t^(2k-3))
    where y'' = S y - r + O(t^(2k-3)) and the k first terms of y, y1, y2 are right.
    """
    p = num.modulus()
    S = num.mul_low(den.inverse_series_trunc(count), count)
    y1 = nmod_poly([1], p)
    y2 = nmod_poly([0, 1], p)
    known = 2
    while known < count:
        known = min(2 * known - 1, count)
        y1, y2 = _corrected(y1, y1, y2, S, known), _corrected(y2, y1, y2, S, known)
    return y1, y2


def _corrected(y: Any, y1: Any, y2: Any, S: Any, count: int) -> Any:
    """y + y2 int(y1 r) - y1 int(y2 r) for r = S y - y'', to `count` terms."""
    r = S.truncate(count).mul_low(y, count) - y.derivative().derivative()
    along_y2 = y1.mul_low(r, count - 1).integral()
    along_y1 = y2.mul_low(r, count - 1).integral()
    return y + y2.mul_low(along_y2, count) - y1.mul_low(along_y1, count)


def solution_at_singular_point(second: Any, first: Any, zeroth: Any, count: int) -> Any:
    """u = 1 + O(t) with second u'' + first u' + zeroth u = 0 to `count` terms, where second(0) = 0.

    The coefficient of t^(j-1) says what u_j is, term after term, as long as the indicial factor j ((j - 1) second_1 + first_0)
    isn't 0.  The share of the terms of earlier blocks is found by multiplication.
    Raises `BadPrimeError` if an indicial factor is 0 modulo the prime.
    """
    p = second.modulus()
    # The coefficients from t^2, t^1 and t^0 on, as many as a block needs: u_k gets those of t^(j - k) in equation number j.
    of_second, of_first, of_zeroth = (
        [int(c) for c in f.coeffs()[low : low + _BLOCK_OF_TERMS]] for f, low in ((second, 2), (first, 1), (zeroth, 0))
    )
    second_1 = int(second[1])
    first_0 = int(first[0])
    u = nmod_poly([1], p)
    for start in range(1, count, _BLOCK_OF_TERMS):
        check_time()
        end = min(start + _BLOCK_OF_TERMS, count)
        slope = u.derivative()
        rest = second.mul_low(slope.derivative(), end) + first.mul_low(slope, end) + zeroth.mul_low(u, end)
        # u_k, k u_k and k (k - 1) u_k for the k of this block
        terms: list[int] = []
        once: list[int] = []
        twice: list[int] = []
        for j in range(start, end):
            indicial = j * ((j - 1) * second_1 + first_0) % p
            if not indicial:
                raise BadPrimeError(f"{p} divides an indicial factor")
            total = int(rest[j - 1]) + sum(map(mul, of_second, reversed(twice)))
            total += sum(map(mul, of_first, reversed(once))) + sum(map(mul, of_zeroth, reversed(terms)))
            value = -total * pow(indicial, -1, p) % p
            terms.append(value)
            once.append(j * value % p)
            twice.append(j * (j - 1) * value % p)
        u = u + nmod_poly(terms, p).left_shift(start)
    return u


def square_root_of_series(series: Any, root: int, count: int) -> Any:
    """The square root with the constant term `root`, not 0, of a series, to `count` terms: coefficient by coefficient."""
    p = series.modulus()
    half = pow(2 * root, -1, p)
    r = [root]
    for k in range(1, count):
        if k % _BLOCK_OF_TERMS == 0:
            check_time()
        rest = int(series[k]) - sum(r[i] * r[k - i] for i in range(1, k))
        r.append(rest * half % p)
    return nmod_poly(r, p)


def product_of_powers(factors: Sequence[tuple[Any, int]], count: int, p: int) -> Any:
    """The product of the f^k, k of either sign, to `count` terms; f(0) isn't 0 where k is negative."""
    product = nmod_poly([1], p)
    for f, k in factors:
        power = f.truncate(count).pow_trunc(abs(k), count)
        if k < 0:
            power = power.inverse_series_trunc(count)
        product = product.mul_low(power, count)
    return product


def rational_candidate(series: Any, count: int, top: int) -> tuple[Any, Any]:
    """(A, B) with A = B series + O(t^count) and deg A <= top, B of the least degree: the only A/B there can be.

    Euclid's algorithm for t^count and the series, stopped at the first remainder of degree at most `top`: every other such pair
    with deg A + deg B < count is a multiple of this one [von zur Gathen & Gerhard, Modern Computer Algebra, section 5.7].
    """
    p = series.modulus()
    before = nmod_poly([1], p).left_shift(count)
    A = series.truncate(count)
    B_before = nmod_poly([], p)
    B = nmod_poly([1], p)
    while A.degree() > top:
        check_time()
        quotient, remainder = divmod(before, A)
        before = A
        A = remainder
        B_before, B = B, B_before - quotient * B
    return A, B


def nullity(columns: Sequence[Any], start: int, end: int) -> int:
    """The dimension of the combinations of the series without any term from t^start on, below t^end."""
    p = columns[0].modulus()
    rows = [[int(column[k]) for k in range(start, end)] for column in columns]
    return len(columns) - int(nmod_mat(rows, p).rank())
