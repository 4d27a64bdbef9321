"""Costs of the evaluation methods, in milliseconds of processor time, by which the cheapest one is chosen in advance.

The numbers were fitted to `benchmarks/routes.py --prices`, which repeats the measurement; only their ratios matter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Price:
    """A price by digits: the least one, which is twice as high at `doubled` digits, and grows like their `power`.

    The part that grows may have a factor.

    >>> Price(0.1, 50)(50)
    0.2
    """

    least: float
    doubled: float
    power: float = 1.5

    def __call__(self, digits: float, factor: float = 1.0) -> float:
        return self.least * (1.0 + factor * math.pow(digits / self.doubled, self.power))


@dataclass(frozen=True)
class Cost:
    """Cost of FLINT's functions: the price of a target, and the digits up to which it holds; then it soars."""

    target: Price
    most: int


BEGIN = 0.4
"""The start of Taylor's method."""
DISC = Price(0.7, 62, 1.27)
"""A disc, as `kovacic.enclosure.states` foresees them: near singular points two or three stand for one."""


def terms(size: int) -> float:
    """The factor for a disc at many digits by the sum of the degrees of S, the length of its recurrence."""
    return 0.5 + size / 8


def beside(size: int) -> float:
    """The factor for a disc off the real axis: complex coefficients, and centres whose powers have long numbers."""
    return 4.0 + size / 4


TARGET = Price(0.027, 113, 2.0)
"""A target in a disc that is there."""
TARGET_BESIDE = 4.0
"""The factor for one off the real axis."""
FIRST = 0.3
"""The start of a closed form, without its targets."""
CLOSED_BESIDE = 2.5
"""The factor for a target of a closed form off the real axis."""
UNIT = 0.015
"""A unit of the work that the search for a pull-back counts."""


def has_sure_solutions(S: RatFunc) -> bool:
    """True if two exponentials or powers are certain: constant coefficients, and Euler's equation, S = c/(x - a)^2."""
    den = S.den
    is_euler = den.degree == 2 and den[1] * den[1] == 4 * den[0] * den[2]
    return S.num.degree <= 0 and (den.degree == 0 or is_euler)


def decided_from(S: RatFunc) -> float:
    """The price of Taylor's method from which it pays to decide the equation first.

    Ten times that of a decision, which finds nothing as often as not; four times if it is sure to succeed.
    """
    return 4.0 if has_sure_solutions(S) else 12.0


def sought_from(size: int) -> float:
    """The cost of the search for a pull-back, by the degrees of S together; where S is linear it is one of Airy's equation."""
    return 1.5 if size <= 1 else 4.5


AIRY = Cost(Price(0.05, 330), 20_000)
BESSEL = Cost(Price(0.12, 100), 10_000)
WHITTAKER = Cost(Price(0.17, 100), 2_000)
TRICOMI = Cost(Price(0.5, 90), 2_000)
"""Whittaker's functions with an integer 2 mu: U is a limit, then."""
GAUSS = Cost(Price(0.27, 60), 1_000)
GAUSS_DIHEDRAL = Cost(Price(0.1, 85), 1_000_000_000)

EXPONENTIALS = Price(0.056, 1000)
"""Two exponentials, with polynomials of degree 0."""
COEFFICIENT = Price(0.002, 120)
"""The cost of each degree of the polynomial."""
DEGREES = 10.0
"""A polynomial that decides an equation is sought up to this degree for each millisecond that Taylor's method takes."""
