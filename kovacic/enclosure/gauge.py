"""From y'' = S y to the user's a z'' + b z' + c z = 0: z = g y, g'/g = gamma = -b/(2a).

The guarantee: if the matrix for (y, y') along a leg is right, so is the one for (z, z').  On the leg from u to v,
with the growth
E = exp int_u^v gamma (`kovacic.enclosure.exponential`) and G(x) = (1, 0; gamma(x), 1),

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u).

A pole of gamma is a singular point of the equation even where S is regular: legs through one are refused.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from kovacic.enclosure.exponential import LogDerivative
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.problem import clear_denominators
from kovacic.enclosure.singular import check_segment
from kovacic.enclosure.transport import multiply, product

if TYPE_CHECKING:
    from flint import acb

    from kovacic.enclosure.taylor import Matrix

Legs = Callable[[Point, Point], "list[Matrix]"]


def with_gauge(gamma: Any, legs: Legs) -> Legs:
    """The legs for (z, z') from those for (y, y'); `gamma` None leaves them as they are."""
    if gamma is None:
        return legs
    singular = clear_denominators(gamma)

    def gauged(a: Point, b: Point) -> list[Matrix]:
        if a == b:
            return []
        check_segment(singular, a, b)
        theta = LogDerivative.make(gamma, None)
        u, v = to_acb(a), to_acb(b)
        growth = theta.growth(u, v)
        inner = multiply(_shear(theta.value(v)), multiply(product(legs(a, b)), _shear(-theta.value(u))))
        return [(growth * inner[0], growth * inner[1], growth * inner[2], growth * inner[3])]

    return gauged


def _shear(value: acb) -> Matrix:
    from flint import acb

    return acb(1), acb(0), value, acb(1)
