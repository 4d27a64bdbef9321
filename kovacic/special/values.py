"""Values of solutions of the standard equations by FLINT's functions: z^alpha (1 - z)^beta E(z).

E is entire, or analytic where no number of `slits` lies on the negative axis, and `StandardForm.values` contain E and E';
E(0) = 1 where the form has the power z^alpha of its exponent at 0.

References: DLMF 9.2, 10.2, 10.25, 10.39, 13.2, 13.14, 15.4.11-18, 15.10.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import acb, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.rationals import RationalPoly

ValueAndSlope = tuple["acb", "acb"]  # (E, E')
StandardSolution = Callable[["acb"], ValueAndSlope]  # at z
StandardSolutions = Callable[
    ["acb", Sequence[bool]], list[ValueAndSlope]
]  # for those of both that are needed, zeros for the other
HALF = fmpq(1, 2)


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
        rows = [(-HALF, alpha, beta, 1 - alpha - beta) for alpha, beta in self.powers]
        return list(zip(*rows, strict=True))


def each(*solutions: StandardSolution) -> StandardSolutions:
    """The values of either."""

    def values(z: acb, needed: Sequence[bool]) -> list[ValueAndSlope]:
        """(0, 0) for those that aren't needed."""
        found = []
        for solution, is_needed in zip(solutions, needed, strict=True):
            value = solution(z) if is_needed else (acb(0), acb(0))
            found.append(value)
        return found

    return values


def rational(constant: Any) -> Any:
    """A constant of Q as FLINT's rational."""
    assert isinstance(constant, RationalPoly)
    return constant.rep[0]


def square_root(number: Any) -> Any:
    """The principal square root: a rational number where it is one, else a ball."""
    try:
        return number.sqrt()
    except (DomainError, ValueError):
        return acb(number).sqrt()


def is_integer(number: Any) -> bool:
    """Is it known to be an integer?"""
    return isinstance(number, fmpq) and number.q == 1


def ends(a: Any) -> bool:
    """Is a hypergeometric series with this upper parameter a polynomial?"""
    return is_integer(a) and a <= 0
