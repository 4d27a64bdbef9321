"""Standard equations, and pull-backs of them: what is searched for, and the identity by which it is verified.

If u'' = S0(z) u and z = f(x), then y = u(f)/sqrt(f') satisfies y'' = S y with

    S = f'^2 S0(f) - {f, x}/2,        {f, x} = f'''/f' - (3/2) (f''/f')^2.                                       (1)

A `StandardEquation` is a module of this folder: its coefficients and S0, how a pull-back of it is found in S, how its solutions
are written, and their values.  It is written so that its coefficients, and f, lie in the field of S.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Problem
from kovacic.limits import count_work

if TYPE_CHECKING:
    from flint import fmpq, fmpq_poly

    from kovacic.special.numbers import Number
    from kovacic.special.prices import Cost
    from kovacic.special.values import StandardForm
    from kovacic.special.writer import Writer, WrittenPair

#: What a trial of a function f costs, in units of work, about.
TRIAL = 30


class StandardEquation(ABC):
    """u'' = S0(z) u."""

    #: Which pull-backs are sought, for a user who reads that none was found.
    searched: ClassVar[str]
    #: Have pull-backs irregular singular points?
    irregular: ClassVar[bool]

    # ----------------------------------------------------------------------------------------- the equation

    @property
    @abstractmethod
    def name(self) -> str:
        """Whose equation it is."""

    @property
    @abstractmethod
    def S(self) -> RatFunc:
        """S0."""

    # ----------------------------------------------------------------------------------------- found, and written

    @classmethod
    @abstractmethod
    def candidates(cls, problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
        """Pull-backs that are possible, the likely ones first; each of them has to be verified.

        With `extended`, f may have coefficients in a larger field than S.  With `shifted`, S needn't be theirs, but has what a
        gauge transformation keeps: the polar parts of its square root, and the exponent differences up to integers.
        """

    @abstractmethod
    def written(self, writer: Writer, f: RatFunc, singular: Poly | None) -> WrittenPair | None:
        """Two independent solutions pulled back by f, with their Wronskian.

        None where the assumptions leave open which are independent.

        With `singular`, solutions are analytic wherever this denominator of S isn't zero, even where f is.
        """

    def integers(self, writer: Writer, f: RatFunc) -> Iterator[Number]:
        """Numbers that may be integers, on whose signs it may depend what is written, the preferred ones first."""
        yield from ()

    # ----------------------------------------------------------------------------------------- values, over the rationals

    @property
    @abstractmethod
    def parameters(self) -> list[fmpq]:
        """The squares of the numbers on which the functions depend."""

    @property
    @abstractmethod
    def cost(self) -> Cost:
        """What FLINT's functions cost beside Taylor's method."""

    def coordinate(self, n: Any, d: Any) -> int:
        """Which coordinate serves best where f has the value n/d, as a number for `form`."""
        return 0

    @abstractmethod
    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        """Two solutions by FLINT's functions, pulled back by n/d, in this coordinate."""


@dataclass(frozen=True)
class Pullback:
    """A standard equation and the function f that it is pulled back by."""

    equation: StandardEquation
    f: RatFunc

    @property
    def S(self) -> RatFunc:
        """The coefficient of the pulled-back normal form, by (1)."""
        slope = self.f.derivative()
        return slope * slope * self.equation.S(self.f) - schwarzian(self.f) / 2

    def gives(self, S: RatFunc) -> bool:
        """Does the identity (1) hold exactly?"""
        count_work(TRIAL)
        return self.f.derivative() != 0 and self.S == S


def standard_part(S: RatFunc, f: RatFunc) -> RatFunc:
    """S0(f) = (S + {f, x}/2)/f'^2."""
    slope = f.derivative()
    return (S + schwarzian(f) / 2) / (slope * slope)


def schwarzian(f: RatFunc) -> RatFunc:
    """{f, x} for a function that isn't constant."""
    slope = f.derivative()
    ratio = slope.derivative() / slope
    return ratio.derivative() - ratio * ratio * Fraction(1, 2)


def variable(field: Field) -> Poly:
    """z."""
    return field.poly([0, 1])
