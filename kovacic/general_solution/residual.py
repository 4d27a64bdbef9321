"""The one way in which a formula is put into an equation: at points, in balls."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, fmpq

from kovacic.closed_form.jets import jet

Expr = Any  # SymPy publishes no types
#: Points x/101 + i y/89 in each quadrant and on the axis, where a formula is substituted: wrong branches of roots don't pass.
_POINTS = [(137, 71), (-151, 83), (-97, -119), (163, -79), (23, 0), (67, 0), (173, 0), (431, 0), (-41, 0), (-257, 0)]


@dataclass(frozen=True)
class Residual:
    """a y'' + b y' + c y - f, for expressions a, b, c and f in x."""

    x: Expr
    coefficients: tuple[Expr, Expr, Expr, Expr]

    def at(self, y: Expr, point: Any) -> tuple[Any, Any]:
        """Its absolute value at a point, and the sum of those of its terms.

        Raises `NotImplementedError` where a part can't be evaluated, or isn't finite.
        """
        a, b, c, f = (jet(e, self.x, point)[0] for e in self.coefficients)
        value, first, second = jet(y, self.x, point)
        terms = [a * second, b * first, c * value, -f]
        if not all(term.is_finite() for term in terms):
            raise NotImplementedError("a value isn't finite")
        return abs(sum(terms)), sum(map(abs, terms), arb(0))


def points() -> Iterator[Any]:
    """Those in each quadrant and on the axis."""
    return (acb(arb(fmpq(real, 101)), arb(fmpq(imaginary, 89))) for real, imaginary in _POINTS)
