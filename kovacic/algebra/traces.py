"""Traces, characteristic polynomials and norms in K[x]/p, and sums of numbers with either sign."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import islice
from math import lcm

from flint import fmpz

from kovacic.algebra.homomorphism import SAMPLE_PRIMES, BadPrimeError
from kovacic.algebra.poly import Poly
from kovacic.limits import MOST_TRIALS


def largest_integer_total(base: Fraction, choices: Iterable[Fraction]) -> int:
    """The largest integer `base + sum +-c` over all signs; -1 if no choice of signs gives an integer.

    Only the largest total with each fractional part is kept.  With too many fractional parts the rounded-down largest
    total of all, which is an upper bound, is returned.
    """
    fractions = [abs(c) for c in choices if c]
    unit = lcm(base.denominator, *(c.denominator for c in fractions))
    start, *sizes = (c.numerator * (unit // c.denominator) for c in (base, *fractions))
    best = {start % unit: start}
    for size in sizes:
        totals: dict[int, int] = {}
        for total in best.values():
            for value in (total + size, total - size):
                residue = value % unit
                totals[residue] = max(totals.get(residue, value), value)
        best = totals
        if len(best) > MOST_TRIALS:
            return (start + sum(sizes)) // unit
    return best.get(0, -unit) // unit


def is_provably_not_a_square(element: Poly, modulus: Poly) -> bool:
    """True if a quick test proves that an element of K[x]/p isn't a square there.

    For a linear p and a rational number K decides; else a norm that is a non-residue modulo some prime proves it.
    """
    field = modulus.field
    if element.degree <= 0 and field.rational_value(element) is not None:
        if field.sqrt(element) is not None:
            return False
        if modulus.degree == 1:
            return True
    for h in islice(field.homomorphisms(), SAMPLE_PRIMES):
        try:
            residue = int(h.keeping_degree(modulus).resultant(h(element)))
        except BadPrimeError:
            continue
        if fmpz(residue).jacobi(h.p) == -1:
            return True
    return False


def characteristic_polynomial(element: Poly, modulus: Poly) -> Poly:
    """The characteristic polynomial of multiplication by an element of K[x]/modulus.

    From the traces of its powers by Newton's identities.
    """
    field = modulus.field
    n = modulus.degree
    sums = power_sums(modulus)
    traces = list[Poly]()
    power = element % modulus
    for _ in range(n):
        traces.append(sum((power[i] * sums[i] for i in range(power.degree + 1)), field.zero))
        power = power * element % modulus
    return field.poly(coefficients_from_traces(traces)[::-1])


def power_sums(modulus: Poly) -> list[Poly]:
    """The sums of the i-th powers of the roots, i = 0, ..., n - 1 (modulus monic, of degree n)."""
    n = modulus.degree
    sums: list[Poly] = [modulus.field.poly([n])]
    for k in range(1, n):
        sums.append(-sum((modulus[n - i] * sums[k - i] for i in range(1, k)), modulus[n - k] * k))
    return sums


def coefficients_from_traces(traces: Sequence[Poly]) -> list[Poly]:
    """1, and the coefficients of X^(n-1), ..., X^0 of a characteristic polynomial, by Newton's identities.

    The traces are those of the first n powers.
    """
    coefficients = [traces[0].field.one]
    for k in range(1, len(traces) + 1):
        total = sum((coefficients[k - i] * traces[i - 1] for i in range(1, k)), traces[k - 1])
        coefficients.append(total * Fraction(-1, k))
    return coefficients
