"""The complex zeros of an integer polynomial: balls, pairwise disjoint, one zero in each, with their multiplicities.

FLINT isolates them, by a call that can't be stopped.  It is short for coefficients of a few words, and its time can't be
foreseen for long ones, which may have zeros as near to each other as 1 and 1 + 10^-5000: those of degree 2 are written down,
and for those of a higher degree FLINT works in a process of its own.  So it does where zeros of short ones, if they lie in
clusters, would take longer than the time that is left.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from flint import acb, arb, ctx, fmpz, fmpz_poly

from kovacic.algebra.precision import working_precision
from kovacic.limits import check_duration, may_be_late

#: Seconds that FLINT takes at least, over the square of the degree; and at most, with a part for each bit of the coefficients,
#: unless zeros lie extremely close together: x(x-1)...(x-79) takes twenty times as long as a polynomial without clusters.
_SECONDS = 4e-6
_MOST_SECONDS = 1e-5
_MOST_SECONDS_PER_BIT = 3e-7
#: Bits of coefficients for which it takes no longer: `_SHORT_COEFFICIENTS`, and `_SHORT_PER_DEGREE` for each degree.
_SHORT_COEFFICIENTS = 400
_SHORT_PER_DEGREE = 4

Zeros = tuple[tuple[Any, int], ...]


def complex_zeros(polynomial: fmpz_poly) -> Zeros:
    """The zeros, at the working precision in force; raises `LimitExceeded` if there isn't enough time.

    >>> [(complex(root), multiplicity) for root, multiplicity in complex_zeros(fmpz_poly([1, 2, 1]))]
    [((-1+0j), 2)]
    """
    degree = polynomial.degree()
    if degree < 1:
        return ()
    check_duration(_SECONDS * degree**2, f"the isolation of the zeros of a polynomial of degree {degree}")
    bits = polynomial.height_bits()
    is_short = bits <= _SHORT_COEFFICIENTS + _SHORT_PER_DEGREE * degree
    # At once where the time suffices for zeros of any kind, clusters included.
    if degree == 1 or (is_short and not may_be_late(degree**2 * (_MOST_SECONDS + _MOST_SECONDS_PER_BIT * bits))):
        return _isolated_here(polynomial)
    if degree == 2:
        return _of_quadratic(polynomial)
    found = _isolated_apart(tuple([int(c) for c in polynomial.coeffs()]), ctx.prec)
    return tuple((acb(_ball_of_dyadic(real), _ball_of_dyadic(imaginary)), k) for real, imaginary, k in found)


def _isolated_here(polynomial: fmpz_poly) -> Zeros:
    return tuple((root, int(k)) for root, k in polynomial.complex_roots())


def _of_quadratic(polynomial: fmpz_poly) -> Zeros:
    """The zeros of a x^2 + b x + c, to the working precision: different ones are at least as far apart as 1/a^2."""
    c, b, a = polynomial.coeffs()
    square = b * b - 4 * a * c
    with working_precision(ctx.prec + 4 * int(polynomial.height_bits()) + 20):
        middle = arb(-b) / (2 * a)
        if square == 0:
            return ((acb(middle), 2),)
        distance = arb(abs(square)).sqrt() / (2 * abs(a))
        if square > 0:
            return (acb(middle - distance), 1), (acb(middle + distance), 1)
        return (acb(middle, distance), 1), (acb(middle, -distance), 1)


@lru_cache(maxsize=16)
def _isolated_apart(coefficients: tuple[int, ...], prec: int) -> list[tuple[Any, Any, int]]:
    """Midpoints and radii, found where the computation can be stopped."""
    from kovacic.process import computed_apart

    what = f"zeros of a polynomial of degree {len(coefficients) - 1}"
    return computed_apart(what, _dyadic_zeros, coefficients, prec)  # type: ignore[no-any-return]


def _dyadic_zeros(coefficients: tuple[int, ...], prec: int) -> list[tuple[Any, Any, int]]:
    """Real part, imaginary part and multiplicity of each zero, in a form that pickles."""
    with working_precision(prec):
        zeros = _isolated_here(fmpz_poly(list(coefficients)))
        return [(_dyadic(root.real), _dyadic(root.imag), k) for root, k in zeros]


def _dyadic(ball: arb) -> tuple[list[int], list[int]]:
    """Mantissa and exponent of the midpoint and of the radius."""
    return [int(part) for part in ball.mid().man_exp()], [int(part) for part in ball.rad().man_exp()]


def _ball_of_dyadic(dyadic: tuple[list[int], list[int]]) -> arb:
    middle, radius = dyadic
    return arb((fmpz(middle[0]), fmpz(middle[1])), (fmpz(radius[0]), fmpz(radius[1])))
