"""Pieces of a leg on which something is proven to hold, and matrices of pairs of solutions: for `closed_form` and `klein`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, TypeVar

from kovacic.enclosure.exponential import embed
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.transport import adjugate, multiply
from kovacic.limits import Budget

if TYPE_CHECKING:
    from flint import acb, acb_poly

    from kovacic.algebra.ratfunc import RatFunc
    from kovacic.enclosure.taylor import Matrix

Found = TypeVar("Found")

_DEPTH = 200


@dataclass(frozen=True)
class Piece:
    """The straight piece from a to b."""

    a: Point
    b: Point

    @property
    def middle(self) -> Point:
        """(a + b)/2."""
        return (self.a + self.b).scaled(Fraction(1, 2))

    def box(self) -> acb:
        """A ball that contains the piece."""
        return to_acb(self.a).union(to_acb(self.b))


def cut(piece: Piece, found_on: Callable[[Piece], Found | None], budget: Budget) -> list[tuple[Piece, Found]] | None:
    """The piece in halves, quarters, ... so that `found_on` gives an answer on each of them, with the answers.

    None if 2^-200 of the length is too long at the working precision in force.
    """
    result: list[tuple[Piece, Found]] = []
    open_pieces = [(piece, 0)]
    while open_pieces:
        budget.check()
        current, depth = open_pieces.pop()
        found = found_on(current)
        if found is not None:
            result.append((current, found))
            continue
        if depth == _DEPTH:
            return None
        middle = current.middle
        open_pieces += [(Piece(middle, current.b), depth + 1), (Piece(current.a, middle), depth + 1)]
    return result


def values(poly: acb_poly, x: acb) -> acb:
    """The values of a polynomial on a ball, by its expansion at the middle: narrow where Horner's rule isn't."""
    from flint import acb_poly

    centre = x.mid()
    value: acb = poly(acb_poly([centre, 1]))(x - centre)
    return value


@dataclass(frozen=True)
class Quotient:
    """A rational function in balls."""

    num: acb_poly
    den: acb_poly

    @classmethod
    def make(cls, function: RatFunc, c: acb | None) -> Quotient:
        """The function at the working precision in force, with the value c of its algebraic constant."""
        return cls(embed(function.num, c), embed(function.den, c))

    def __call__(self, x: acb) -> acb:
        """The values on a ball; not finite where a pole can't be excluded."""
        return values(self.num, x) / values(self.den, x)


def fundamental(first: tuple[acb, acb], second: tuple[acb, acb]) -> Matrix:
    """The matrix with the states (y, y') of two solutions as its columns."""
    return first[0], second[0], first[1], second[1]


def quotient(at_b: Matrix, at_a: Matrix) -> Matrix:
    """Y(b) Y(a)^-1."""
    determinant = at_a[0] * at_a[3] - at_a[1] * at_a[2]
    m = multiply(at_b, adjugate(at_a))
    return m[0] / determinant, m[1] / determinant, m[2] / determinant, m[3] / determinant


def unknown() -> Matrix:
    """The matrix of which nothing is known: the caller raises the precision."""
    from flint import acb

    nothing = acb("nan", "nan")
    return nothing, nothing, nothing, nothing
