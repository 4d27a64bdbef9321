"""Traces of square roots in K[x]/p: an exact bound without taking the root."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import islice
from math import lcm

from flint import fmpz

from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.algebra.modular import simple_roots
from kovacic.algebra.poly import Poly

#: Primes at which a norm, or a value, is tested for being a square: one that isn't passes with probability 2^-24.
_TESTS = 24


#: Fractional parts that `largest_integer_total` keeps apart before it stops looking at them.
_RESIDUES = 4096


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
        if len(best) > _RESIDUES:
            return (start + sum(sizes)) // unit
    return best.get(0, -unit) // unit


def is_provably_not_a_square(element: Poly, modulus: Poly) -> bool:
    """Can it be seen quickly that an element of K[x]/p isn't a square there?

    For a linear p and a rational number K decides; else a norm that is a non-residue modulo some prime proves it.
    """
    field = modulus.field
    if element.degree <= 0 and field.rational_value(element) is not None:
        if field.sqrt(element) is not None:
            return False
        if modulus.degree == 1:
            return True
    for h in islice(field.homomorphisms(), _TESTS):
        try:
            residue = int(h.keeping_degree(modulus).resultant(h(element)))
        except BadPrimeError:
            continue
        if fmpz(residue).jacobi(h.p) == -1:
            return True
    return False


def _is_no_square_at_a_root(element: Poly, modulus: Poly) -> bool:
    """Is the value of an element of K[x]/p at a simple root of p modulo a prime no square, so that the element isn't one?

    Where the norm is a square, as that of every rational number is for an even degree of p, this still tells.
    """
    return any(fmpz(value).jacobi(p) == -1 for value, p in islice(_values_at_roots(element, modulus), _TESTS))


def _values_at_roots(element: Poly, modulus: Poly) -> Iterator[tuple[int, int]]:
    """The values of an element of K[x]/p at the simple roots of p modulo primes, with the primes; there is no end of them."""
    for h in modulus.field.homomorphisms():
        try:
            image = h(element)
            factor = h.keeping_degree(modulus)
        except BadPrimeError:
            continue
        for root in simple_roots(factor):
            yield int(image(root)), h.p


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
        traces.append(sum((power[i] * sums[i] for i in range(power.degree + 1)), field.poly([])))
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
    coefficients = [traces[0].field.poly([1])]
    for k in range(1, len(traces) + 1):
        total = sum((coefficients[k - i] * traces[i - 1] for i in range(1, k)), traces[k - 1])
        coefficients.append(total * Fraction(-1, k))
    return coefficients


def trace_of_square_root(square: Poly, modulus: Poly) -> Poly | None:
    """The trace, up to sign, over K of a square root of an element of K[x]/p, if it lies in K[x]/p.

    None if it can be seen that there is no square root in K[x]/p.  Let mu, of degree n/e, be the minimal polynomial of
    the square.  If mu(Y^2) is irreducible, a square root in K[x]/p has an even minimal polynomial and so the trace 0 (and
    for an odd e there is none); otherwise mu(Y^2) = +-f(Y) f(-Y), and the trace is e times that of f.
    """
    field = modulus.field
    if square.degree <= 0:
        root = field.sqrt(square)
        return root * modulus.degree if root is not None else _trace_of_even(square, modulus, modulus.degree)
    (mu, e), *others = field.factor(characteristic_polynomial(square, modulus))
    if others:
        raise AssertionError("a characteristic polynomial over a field is a power of an irreducible one")
    even = field.poly([c for coefficient in mu for c in (coefficient, field.poly([]))][:-1])
    f = field.factor(even)[0][0]
    return _trace_of_even(square, modulus, e) if f.degree == even.degree else f[f.degree - 1] * e


def _trace_of_even(square: Poly, modulus: Poly, e: int) -> Poly | None:
    """The trace of a root with an even minimal polynomial is 0; None if none is in K[x]/p, of degree e over K(square)."""
    if e % 2 or _is_no_square_at_a_root(square, modulus):
        return None
    return modulus.field.poly([])
