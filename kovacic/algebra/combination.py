"""A polynomial as a linear combination of others, over any field of constants."""

from __future__ import annotations

from collections.abc import Sequence

from kovacic.algebra.poly import Poly
from kovacic.limits import check_time


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
