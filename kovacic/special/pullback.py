"""Standard equations, and their pull-backs: the objects of the search, and the identity that verifies them.

If u'' = S0(z) u and z = f(x), then y = u(f)/sqrt(f') satisfies y'' = S y with

    S = f'^2 S0(f) - {f, x}/2,        {f, x} = f'''/f' - (3/2) (f''/f')^2.                                       (1)

A `StandardEquation` is a module of this folder: its coefficients and S0, how a pull-back of it is found in S, how its solutions
are written, and their values.  It is written so that its coefficients, and f, lie in the field of S.

Values of solutions are z^alpha (1 - z)^beta E(z), by FLINT's functions.  E is entire, or analytic where no number of `slits`
lies on the negative axis, and `StandardForm.values` contain E and E'; E(0) = 1 where the form has the power z^alpha of its
exponent at 0.

References: DLMF 9.2, 10.2, 10.25, 10.39, 13.2, 13.14, 15.4.11-18, 15.10.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from flint import acb, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.compatibility import cached_property
from kovacic.engine.places import Problem
from kovacic.limits import count_work
from kovacic.special.maps import TRIAL

if TYPE_CHECKING:
    from kovacic.special.maps import Surd
    from kovacic.special.prices import Cost
    from kovacic.special.writer import Writer, WrittenPair

ValueAndSlope = tuple["acb", "acb"]  # (E, E')
StandardSolution = Callable[["acb"], ValueAndSlope]  # at z
StandardSolutions = Callable[
    ["acb", Sequence[bool]], list[ValueAndSlope]
]  # for those of both that are needed, zeros for the other


@dataclass(frozen=True)
class StandardForm:
    """Two solutions at the working precision in force, as functions of z = n(x)/d(x), the powers (alpha, beta) and the slits.

    The numbers z or 1 - z mustn't reach the negative axis (or 0) where their place in `slits` has a factor c, nor c times them.
    Unless `independent` both are multiples of one polynomial times powers and exp.
    """

    n: fmpq_poly
    d: fmpq_poly
    powers: tuple[tuple[Any, Any], tuple[Any, Any]]
    values: StandardSolutions
    slits: tuple[Any, Any] = (None, None)
    independent: bool = True

    @cached_property
    def derivatives(self) -> tuple[fmpq_poly, fmpq_poly]:
        """n' and d'."""
        return self.n.derivative(), self.d.derivative()

    @property
    def exponents(self) -> list[tuple[Any, Any]]:
        """Those of W, n, d - n and d in either solution, f'^(-1/2) z^alpha (1 - z)^beta."""
        rows = [(fmpq(-1, 2), alpha, beta, 1 - alpha - beta) for alpha, beta in self.powers]
        return list(zip(*rows, strict=True))


def each(*solutions: StandardSolution) -> StandardSolutions:
    """Both solutions, with (0, 0) for one that isn't needed."""

    def values(z: acb, needed: Sequence[bool]) -> list[ValueAndSlope]:
        pairs = zip(solutions, needed, strict=True)
        return [solution(z) if is_needed else (acb(0), acb(0)) for solution, is_needed in pairs]

    return values


def root_or_ball(number: Any) -> Any:
    """The principal square root: a rational number if possible, else a ball."""
    try:
        return number.sqrt()
    except (DomainError, ValueError):
        return acb(number).sqrt()


def is_integer(number: Any) -> bool:
    """True if the number is provably an integer."""
    return isinstance(number, fmpq) and number.q == 1


def ends(a: Any) -> bool:
    """True if a hypergeometric series with this upper parameter is a polynomial."""
    return is_integer(a) and a <= 0


class StandardEquation(ABC):
    """u'' = S0(z) u."""

    #: Which pull-backs are sought, for a user who reads that none was found.
    searched: ClassVar[str]
    #: True if pull-backs have irregular singular points.
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
        """Possible pull-backs, the likely ones first; each has to be verified.

        With `extended`, f may have coefficients in a larger field than S.  With `shifted`, S needn't be theirs, but has what a
        gauge transformation keeps: the polar parts of its square root, and the exponent differences up to integers.
        """

    @abstractmethod
    def written(self, writer: Writer, f: RatFunc) -> WrittenPair | None:
        """Two independent solutions pulled back by f, with their Wronskian.

        None if the assumptions leave open which are independent.
        """

    def integers(self, writer: Writer, f: RatFunc) -> Iterator[Surd]:
        """Possible integers whose signs may decide between forms of the solutions, the preferred ones first."""
        yield from ()

    # ----------------------------------------------------------------------------------------- values, over the rationals

    @property
    def constants(self) -> list[fmpq]:
        """The coefficients of the equation."""
        return [constant.rep[0] for constant in vars(self).values()]

    @property
    @abstractmethod
    def parameters(self) -> list[fmpq]:
        """The squares of the numbers on which the functions depend."""

    @property
    @abstractmethod
    def cost(self) -> Cost:
        """The cost of FLINT's functions relative to Taylor's method."""

    def coordinate(self, n: Any, d: Any) -> int:
        """The best coordinate where f has the value n/d, as a number for `form`."""
        return 0

    @abstractmethod
    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        """Two solutions by FLINT's functions, pulled back by n/d, in this coordinate."""


@dataclass(frozen=True)
class Pullback:
    """A standard equation and the function f that it is pulled back by."""

    equation: StandardEquation
    f: RatFunc
    #: As a `GaugeTransform` has it.
    transform: ClassVar[None] = None

    @property
    def pullback(self) -> Pullback:
        """This one."""
        return self

    @property
    def S(self) -> RatFunc:
        """The coefficient of the pulled-back normal form, by (1)."""
        slope = self.f.derivative()
        return slope * slope * self.equation.S(self.f) - schwarzian(self.f) / 2

    def gives(self, S: RatFunc) -> bool:
        """True if the identity (1) holds exactly."""
        count_work(TRIAL)
        return self.f.derivative() != 0 and self.S == S


@dataclass(frozen=True)
class GaugeTransform:
    """y = sqrt(m) (a v + b v'), v a solution of the pulled-back standard equation."""

    pullback: Pullback
    m: Poly
    a: RatFunc
    b: RatFunc

    @property
    def transform(self) -> GaugeTransform:
        """This one."""
        return self

    def gives(self, S: RatFunc) -> bool:
        """True if the identities (1) of `kovacic.special.search` hold exactly and the transformation is invertible."""
        T = self.pullback.S
        D = S - T
        (a, da, d2a), (b, db, d2b) = map(self._derivatives, (self.a, self.b))
        first = 2 * da == b * D - d2b
        second = d2a == a * D - 2 * db * T - b * T.derivative()
        return first and second and bool(self.factor)

    @property
    def factor(self) -> RatFunc:
        """The constant m (a^2 + a b' - a' b - b^2 T), by which the Wronskian of two solutions v is multiplied."""
        (a, da, _), (b, db, _) = map(self._derivatives, (self.a, self.b))
        return (a * a + a * db - da * b - b * b * self.pullback.S) * self.m

    def _derivatives(self, c: RatFunc) -> tuple[RatFunc, RatFunc, RatFunc]:
        """c, and over sqrt(m) the first two derivatives of sqrt(m) c."""
        rate = logarithmic_derivative(self.m) / 2
        dc = c.derivative() + rate * c
        return c, dc, dc.derivative() + rate * dc


def standard_part(S: RatFunc, f: RatFunc) -> RatFunc:
    """S0(f) = (S + {f, x}/2)/f'^2."""
    slope = f.derivative()
    return (S + schwarzian(f) / 2) / (slope * slope)


def schwarzian(f: RatFunc) -> RatFunc:
    """{f, x} for a function that isn't constant."""
    slope = f.derivative()
    ratio = slope.derivative() / slope
    return ratio.derivative() - ratio * ratio * Fraction(1, 2)
