"""Power series modulo a prime, in near-linear time: recurrences with convolutions, and the fraction with a given expansion.

References: M. J. Fischer and L. J. Stockmeyer, J. Comput. System Sci. 9 (1974), and J. van der Hoeven, J. Symb. Comp. 34
(2002), for convolutions of terms that become known one by one; J. von zur Gathen and J. Gerhard, Modern Computer Algebra,
sections 5.7 and 11.1, for the fraction and the half-gcd.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import mul
from typing import Any

from flint import nmod_poly

#: So many terms are convolved one by one, ...
_FEW = 32
#: ... and so many quotients of Euclid's algorithm found.
_FEW_QUOTIENTS = 256

Matrix = tuple[Any, Any, Any, Any]
"""(a, b; c, d), of polynomials."""


def convolving_recurrence(
    start: Sequence[int],
    count: int,
    p: int,
    term: Callable[[Sequence[int], int, int], int],
    kernel: Sequence[int] | None = None,
) -> list[int]:
    """a_0, ..., a_(count-1) modulo p: the first ones as given, then a_j = term(a, j, sum_(0<i<j) a_i b_(j-i)).

    b is the kernel (of at least `count` terms), or a itself; `term` may look at the a_i with i < j.

    >>> convolving_recurrence([0, 1], 8, 10007, lambda a, j, total: total)  # Catalan's numbers
    [0, 1, 1, 2, 5, 14, 42, 132]
    """
    a = [*start[:count], *[0] * (count - len(start))]
    b = a if kernel is None else kernel
    total = [0] * count

    def extend(low: int, high: int) -> None:
        """Find a_low, ..., a_(high-1), where `total` has what the terms below a_low contribute to them.

        In the convolution of a with itself, a block that doesn't begin at 0 counts twice: as the first factor and as the
        second.
        """
        twice = 2 if kernel is None and low else 1
        if high - low <= _FEW:
            for j in range(max(low, len(start)), min(high, count)):
                first = max(low, 1)
                a[j] = term(a, j, total[j] + twice * sum(map(mul, a[first:j], b[j - first : 0 : -1]))) % p
            return
        middle = (low + high) // 2
        extend(low, middle)
        if middle >= count:
            return
        block = nmod_poly(a[low:middle] if low else [0, *a[1:middle]], p)
        other = block if kernel is None and not low else nmod_poly([0, *b[1 : high - low]], p)
        product = block * other
        for j in range(middle, min(high, count)):
            total[j] += twice * int(product[j - low])
        extend(middle, high)

    size = _FEW
    while size < count:
        size *= 2
    extend(0, size)
    return a


def fraction_of_series(series: Any, order: int, top: int) -> tuple[Any, Any]:
    """(A, B) with A = B series + O(t^order) and deg A <= top, of which every such pair with deg B < order - top is a multiple.

    Euclid's algorithm on t^order and the series gives it, and before it a pair (A', B') with deg A' > top, deg B' < deg B
    and A' B - A B' = c t^order.  Every pair is a combination alpha (A', B') + beta (A, B).  If alpha isn't zero and the first
    component has at most degree top, the leading terms of alpha A' and beta A cancel; so the second one has the degree of
    beta B, which is at least deg A' - deg A + deg B = order - deg A.

    These conditions are checked: the half-gcd need not be trusted.
    """
    p = series.modulus()
    power, one = nmod_poly([1], p).left_shift(order), nmod_poly([1], p)
    if series.degree() <= top:
        return series, one
    a, before, b, multiple = _quotients(power, series, order - top - 1)
    A0, A = power * a + series * before, power * b + series * multiple
    rest = A0 * multiple - A * before
    if not (A0.degree() > top >= A.degree() and before.degree() < multiple.degree() and rest == power * rest[order]):
        raise AssertionError("the half-gcd went wrong; please report the equation")
    return A, multiple


def _quotients(r0: Any, r1: Any, k: int) -> Matrix:
    """The product of Euclid's steps (0, 1; 1, -q) on (r0, r1) for as long as deg r1 >= deg r0 - k, with r0 as given.

    These quotients depend on the highest 2k + 1 coefficients of r0, and those beside them of r1, alone.
    """
    p, n = r0.modulus(), r0.degree()
    one, zero = nmod_poly([1], p), nmod_poly([], p)
    steps: Matrix = (one, zero, zero, one)
    if k > _FEW_QUOTIENTS:
        half = k // 2
        cut = max(n - 2 * half, 0)
        steps = _quotients(r0.right_shift(cut), r1.right_shift(cut), half)
        r0, r1 = steps[0] * r0 + steps[1] * r1, steps[2] * r0 + steps[3] * r1
    while r1 and r1.degree() >= n - k:
        rest = k - (n - r0.degree())
        if rest > _FEW_QUOTIENTS and r0.degree() < n:  # the second half
            cut = max(r0.degree() - 2 * rest, 0)
            return _product(_quotients(r0.right_shift(cut), r1.right_shift(cut), rest), steps)
        q, remainder = divmod(r0, r1)
        r0, r1 = r1, remainder
        steps = (steps[2], steps[3], steps[0] - q * steps[2], steps[1] - q * steps[3])
    return steps


def _product(m: Matrix, n: Matrix) -> Matrix:
    a, b, c, d = m
    e, f, g, h = n
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h
