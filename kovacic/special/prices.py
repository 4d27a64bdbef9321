"""What values cost on each way, in milliseconds of processor time: by which the cheapest is chosen before it is computed.

The numbers were fitted to `benchmarks/routes.py --prices`, which measures them once more; only their ratios matter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Price:
    """A price by digits: the least one, which is twice as high at `doubled` digits, and grows like their `power`.

    >>> Price(0.1, 50)(50)
    0.2
    """

    least: float
    doubled: float
    power: float = 1.5

    def __call__(self, digits: float) -> float:
        return self.least * (1.0 + math.pow(digits / self.doubled, self.power))


@dataclass(frozen=True)
class Cost:
    """Of FLINT's functions: the price of a target, and the most digits for which this holds, and they aren't far slower."""

    target: Price
    most: int


BEGIN = 0.4
"""The start of Taylor's method."""
DISC = Price(0.7, 62, 1.27)
"""A disc, as `kovacic.enclosure.states` foresees them: near singular points two or three stand for one."""
BESIDE = 4.5
"""The factor for a disc beside the real axis: complex coefficients, and centres with long numbers."""
TARGET = Price(0.027, 113, 2.0)
"""A target in a disc that is there."""
FIRST = 0.3
"""The start of a closed form, beside its targets."""
UNIT = 0.015
"""A unit of the work that the search for a pull-back counts."""

AIRY = Cost(Price(0.05, 330), 20_000)
BESSEL = Cost(Price(0.12, 100), 10_000)
WHITTAKER = Cost(Price(0.17, 66), 2_000)
GAUSS = Cost(Price(0.17, 44), 1_000)
GAUSS_DIHEDRAL = Cost(Price(0.1, 85), 1_000_000_000)

EXPONENTIALS = Price(0.056, 1000)
"""Two exponentials, with polynomials of degree 0."""
COEFFICIENT = Price(0.002, 200)
"""What each degree of the polynomial adds."""
DEGREES = 10.0
"""A polynomial that decides an equation is sought up to this degree for each millisecond that Taylor's method takes."""
