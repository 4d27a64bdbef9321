"""Factoring over a simple algebraic extension, by norms [Trager, SYMSAC 1976].

If the norm of f(x - s c) from K(c)[x] to K[x] is squarefree, its irreducible factors over K correspond to those of f: each
is the greatest common divisor of f(x - s c) with one of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from kovacic.algebra.poly import Poly

if TYPE_CHECKING:
    from kovacic.algebra.extension import AlgebraicField, ExtensionPoly


def norm(polynomial: ExtensionPoly) -> Poly:
    """The norm to the base field: the determinant of multiplication by the polynomial on K(c)[x] over K[x].

    Computed without divisions by the recurrence of Faddeev and LeVerrier, so that it works over every base field.
    """
    field = polynomial.field
    n, base = field.dimension, field.base
    rows: list[tuple[Poly, ...]] = []
    power = field.poly([1])
    for _ in range(n):
        rows.append((polynomial * power).parts)
        power = power * field.generator
    matrix = [list(row) for row in rows]
    zero = base.poly([])
    current = [[base.poly([1]) if i == j else zero for j in range(n)] for i in range(n)]
    coefficient: Poly = base.poly([1])
    for k in range(1, n + 1):
        product = [
            [sum((a * b for a, b in zip(row, column, strict=True)), zero) for column in zip(*current, strict=True)]
            for row in matrix
        ]
        trace = sum((product[i][i] for i in range(n)), zero)
        coefficient = trace * base.poly([-k]).inverse()
        current = [[product[i][j] + (coefficient if i == j else zero) for j in range(n)] for i in range(n)]
    return coefficient if n % 2 == 0 else -coefficient


def factor_over_extension(field: AlgebraicField, polynomial: Poly) -> list[tuple[Poly, int]]:
    """The monic irreducible factors over K(c) with multiplicities, ordered by degree and then by coefficients."""
    remaining = polynomial.monic()
    factors: list[tuple[Poly, int]] = []
    squarefree = remaining // remaining.gcd(remaining.derivative())
    for factor in _factor_squarefree(field, squarefree):
        remaining, multiplicity = remaining.remove(factor)
        factors.append((factor, multiplicity))
    return sorted(factors, key=lambda pair: (pair[0].degree, str(pair[0])))


def _factor_squarefree(field: AlgebraicField, polynomial: Poly) -> list[Poly]:
    if polynomial.degree <= 0:
        return []
    if polynomial.degree == 1:
        return [polynomial]
    x = field.poly([0, 1])
    shift = 0
    while True:
        shifted = polynomial(x - field.generator * shift)
        image = norm(shifted)  # type: ignore[arg-type]
        if image.gcd(image.derivative()).degree == 0:
            break
        shift = -shift if shift > 0 else 1 - shift
    back = x + field.generator * shift
    return [shifted.gcd(field.embed(factor))(back).monic() for factor, _ in field.base.factor(image)]
