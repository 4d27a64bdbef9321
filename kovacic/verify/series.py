"""Power series modulo a prime by recurrences with convolutions, in near-linear time.

References: M. J. Fischer and L. J. Stockmeyer, J. Comput. System Sci. 9 (1974), and J. van der Hoeven, J. Symb. Comp. 34
(2002), for convolutions of terms that become known one by one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import mul

from flint import nmod_poly

#: So many terms are convolved one by one.
_FEW = 32


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
