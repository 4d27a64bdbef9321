"""Several polynomials at once: products, squarefree factors, remainders modulo many, linear combinations."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import mul

from kovacic.algebra.poly import Poly
from kovacic.limits import check_time


def product(factors: Sequence[Poly]) -> Poly:
    """The product of at least one polynomial, by halves, which is faster for many."""
    half = len(factors) // 2
    return product(factors[:half]) * product(factors[half:]) if half > 2 else reduce(mul, factors)


def squarefree_factors(polynomial: Poly) -> list[tuple[Poly, int]]:
    """(p, k): the squarefree product p of the factors of multiplicity k, for k in rising order [Yun 1976]."""
    found, k, rest = [], 0, polynomial.gcd(polynomial.derivative())
    radical = polynomial // rest
    while radical.degree > 0:
        k, following = k + 1, radical.gcd(rest)
        if radical.degree > following.degree:
            found.append((radical // following, k))
        radical, rest = following, rest // following
    return found


def remainders(polynomial: Poly, moduli: Sequence[Poly]) -> list[Poly]:
    """The polynomial modulo each of the moduli, by way of their products [Modern Computer Algebra, sec. 10.1]."""
    check_time()
    rest = polynomial % product(moduli)
    half = len(moduli) // 2
    return [rest] if not half else remainders(rest, moduli[:half]) + remainders(rest, moduli[half:])


def sum_of_cofactors(factors: Sequence[Poly]) -> Poly:
    """The sum of `product(factors) // factor`, which is congruent to that quotient modulo each factor."""
    half = len(factors) // 2
    if not half:
        return factors[0].field.poly([1])
    check_time()
    left, right = factors[:half], factors[half:]
    return sum_of_cofactors(left) * product(right) + product(left) * sum_of_cofactors(right)


def combination(target: Poly, polynomials: Sequence[Poly]) -> list[Poly] | None:
    """Constants c with target = sum of c_k polynomials_k, 0 for those that aren't needed; None where there are none.

    >>> from kovacic.algebra.rationals import QQ
    >>> p, q = QQ.poly([1, 0, 1]), QQ.poly([0, 2, 1])
    >>> [str(c) for c in combination(QQ.poly([1, -4, -1]), [p, q, p + q])]
    ['1', '-2', '0']
    """
    zero = target.field.poly([])
    echelon: dict[int, tuple[Poly, list[Poly]]] = {}  # by the degree: a combination, and its coefficients

    def reduced(p: Poly, coefficients: list[Poly]) -> tuple[Poly, list[Poly]]:
        while p and p.degree in echelon:
            check_time()
            other, its = echelon[p.degree]
            ratio = p.lc / other.lc
            p = p - ratio * other
            coefficients = [c - ratio * d if d else c for c, d in zip(coefficients, its, strict=True)]
        return p, coefficients

    for k, polynomial in enumerate(polynomials):
        own = [zero] * len(polynomials)
        own[k] = target.field.poly([1])
        rest, coefficients = reduced(polynomial, own)
        if rest:
            echelon[rest.degree] = rest, coefficients
    rest, coefficients = reduced(target, [zero] * len(polynomials))
    return None if rest else [-c for c in coefficients]
