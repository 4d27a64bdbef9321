"""Symmetric equations: S(m(x)) m'(x)^2 = S(x) for a Moebius map m of order n, whose quotient has at most three singular points.

m is x -> c + zeta (x - c), zeta^n = 1, or that in the coordinate 1/(x - p).  With z = (x - c)^n the equation becomes
v'' = S_z v, x^2 S = n^2 z^2 S_z + (n^2 - 1)/4, and the exponent differences at 0 and infinity are divided by n.  C(x) is a
cyclic extension of C(z), branched at 0 and infinity: the group G over C(x) is normal in the one over C(z), H, with a cyclic
quotient of an order that divides n.  So an equation is solvable over both or neither, and

- H reducible: G is reducible;
- H imprimitive: the quadratic extension over which H becomes diagonal is branched where two of the differences are
  half-integers.  It is C(sqrt z), and G reducible, exactly where those at 0 and infinity are (n even); else G is imprimitive;
- H tetrahedral: its only cyclic quotient has order 3, with branch points where the differences have the denominator 3.
  Where these are 0 and infinity, so that the third difference is a half-integer, and 3 divides n, G is the quaternion
  group; else G = H;
- H octahedral: G is octahedral or tetrahedral (n even); H icosahedral, which is perfect: G = H.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import gcd
from typing import Literal

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Place, Problem, analyse
from kovacic.parametric import riemann
from kovacic.parametric.formulas import shifted
from kovacic.parametric.functions import over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.statements import Statement, both, either

Statements = Literal[True] | list[Statement]


@dataclass(frozen=True)
class Quotient:
    """The equation in z = s^n, s = x - c or 1/(x - p) - c; `base` is s in words, and `weight` 1 or x - p."""

    problem: Problem
    n: int
    base: str
    weight: str = "1"

    @property
    def coordinate(self) -> str:
        return f"{self.base}^{self.n}"


def recognise(problem: Problem, variable: str) -> Quotient | None:
    """The quotient by a cyclic group of Moebius maps that permute the poles, if it has at most three singular points.

    One of the two fixed points is a singular one, or infinity: where that is infinity, the other one is the mean of the poles.
    """
    S, field = problem.S, problem.field
    x = RatFunc(field.poly([0, 1]))
    if any(place.kind not in (Kind.ORDINARY, Kind.REGULAR) for place in problem.places):
        return None
    for pole in (None, *(-place.factor[0] for place in problem.finite_places if place.degree == 1)):
        moved = S if pole is None else S(1 / x + pole) / x**4
        den = moved.den
        if den.degree < 1:
            continue
        center = -den[den.degree - 1] / (den.lc * den.degree)
        symmetric = (moved(x + center) if center else moved) * x * x
        n = gcd(*(i for part in (symmetric.num, symmetric.den) for i, c in enumerate(part) if c))
        if n < 2:
            continue
        num, den = (field.poly([f[i] for i in range(0, f.degree + 1, n)]) for f in (symmetric.num, symmetric.den))
        quotient = analyse((RatFunc(num, den) - field.poly([n * n - 1]) / 4) / (n * x) ** 2, problem.budget)
        if riemann.applies(quotient):
            weight = "1" if pole is None else shifted(variable, pole)
            base = shifted(variable if pole is None else f"1/({weight})" if pole else f"1/{variable}", center)
            return Quotient(quotient, n, base if base == variable else f"({base})", weight)
    return None


def structures(quotient: Quotient) -> Iterator[tuple[Structure, Statements, str | None]]:
    """As `riemann.structures`, for the equation in x, with the family of the groups where the structure doesn't say it."""
    n = quotient.n
    for structure, statements in riemann.structures(quotient.problem):
        family = riemann.group(quotient.problem, structure)
        if structure is Structure.IMPRIMITIVE and n % 2 == 0:
            diagonal = _with_denominators(quotient.problem, (2, 2))
            if diagonal:
                yield Structure.REDUCIBLE, diagonal, None
            if diagonal is True:
                return
        if structure is Structure.TETRAHEDRAL and n % 3 == 0:
            threefold = _with_denominators(quotient.problem, (3, 3, 2))
            if threefold:
                yield Structure.IMPRIMITIVE, threefold, "the quaternion group"
            if threefold is True:
                return
        if structure is Structure.OCTAHEDRAL and n % 2 == 0:
            family = "binary tetrahedral, or octahedral"
        yield structure, statements, family


def _with_denominators(problem: Problem, denominators: tuple[int, ...]) -> Statements:
    """When the exponent differences at 0, at infinity and at the third point have these denominators; [] for never."""
    found: list[Statement] = []
    for square, denominator in zip(_squares(problem), denominators, strict=False):
        equation = over_parameters(problem.field.poly([-square * denominator**2, 0, 1]))
        residues = [r for r in range(denominator) if gcd(r, denominator) == 1]
        statements = integer_roots(equation, residues, denominator)
        if statements is not True:
            if not statements:
                return []
            statement = either(statements)
            found += [] if statement in found else [statement]
    return [both(*found)] if found else True


def _squares(problem: Problem) -> list[Poly]:
    """The squares of the exponent differences at 0, at infinity and at the third point."""

    def number(place: Place) -> int:
        return 1 if place.at_infinity else 2 if place.factor[0] else 0

    squares = [problem.field.poly([1])] * 3
    for place in problem.places:
        if place.kind is not Kind.ORDINARY and place.delta_squared is not None:
            squares[number(place)] = place.delta_squared
    return squares
