"""Pull-backs of the standard equations, made to order: f and the parameters are drawn first, then S follows.

The standard equations are written down here once more, from the DLMF (9.2, 12.2, 10.13, 13.14, 15.10), and the transformation
is that of `tests.transform`, so that nothing is shared with the search.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from build import QQ, RatFunc
from transform import hypergeometric, pull_back

Z = RatFunc(QQ.poly([0, 1]))
KINDS = ("Airy", "Weber", "Bessel", "modified Bessel", "Bessel of a square root", "Whittaker", "Gauss")


@dataclass(frozen=True)
class Case:
    """S is the pull-back by f, of this degree, of the standard equation of this kind."""

    kind: str
    degree: int
    f: RatFunc
    S: RatFunc


def standard(kind: str, random: Random) -> RatFunc:
    """The coefficient of a standard equation without a Liouvillian solution."""
    nu = Fraction(random.randint(0, 12), random.choice((1, 3, 5, 7)))
    if kind == "Airy":
        return Z
    if kind == "Weber":
        return Z * Z / 4 + Fraction(random.randint(-12, 12), random.choice((3, 5, 7)))
    if kind == "Bessel":
        return (nu * nu - Fraction(1, 4)) / (Z * Z) - 1
    if kind == "modified Bessel":
        return (nu * nu - Fraction(1, 4)) / (Z * Z) + 1
    if kind == "Bessel of a square root":
        return (nu * nu - 1) / (4 * Z * Z) - 1 / Z
    if kind == "Whittaker":
        kappa = Fraction(random.choice((-1, 1)) * random.randint(1, 12), random.choice((2, 3, 5)))
        mu = Fraction(random.randint(0, 12), random.choice((7, 8, 9, 11)))
        return (4 * mu * mu - 1) / (4 * Z * Z) - kappa / Z + Fraction(1, 4)
    first, second, third = (
        random.randint(0, 2) + Fraction(random.randint(1, d - 1), d) for d in random.sample((5, 6, 7, 8, 11), 3)
    )
    return hypergeometric(first, second, third)


def rational(degree: int, random: Random) -> RatFunc:
    """A rational function of this degree with small coefficients; every third one is a polynomial."""
    while True:
        above = [random.randint(-4, 4) for _ in range(degree + 1)]
        below = [1] if random.random() < 1 / 3 else [random.randint(-4, 4) for _ in range(degree + 1)]
        if any(below):
            f = RatFunc(QQ.poly(above), QQ.poly(below))
            if max(f.num.degree, f.den.degree) == degree:
                return f


def pull_backs(
    count: int, *, kinds: tuple[str, ...] = KINDS, degrees: range = range(1, 5), seed: int = 1
) -> Iterator[Case]:
    """So many of each kind and degree."""
    random = Random(seed)
    for kind in kinds:
        for degree in degrees:
            for _ in range(count):
                f = rational(degree, random)
                yield Case(kind, degree, f, pull_back(standard(kind, random), f))
