"""Symmetric equations: S(c + zeta x) zeta^2 = S(c + x) with zeta^n = 1, whose quotient has at most three singular points.

With z = (x - c)^n the equation becomes v'' = S_z v, x^2 S = n^2 z^2 S_z + (n^2 - 1)/4, and the exponent differences at 0 and
infinity are divided by n.  C(x) is a cyclic extension of C(z), branched at 0 and infinity: the group G over C(x) is normal in
the one over C(z), H, with a cyclic quotient of an order that divides n.  So an equation is solvable over both or neither, and

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
from kovacic.parametric.formulas import shown
from kovacic.parametric.functions import over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.statements import Statement, both, either

Statements = Literal[True] | list[Statement]


@dataclass(frozen=True)
class Quotient:
    """The equation in z = (x - c)^n; `base` is x - c in words, and `coordinate` z."""

    problem: Problem
    n: int
    base: str

    @property
    def coordinate(self) -> str:
        return f"{self.base}^{self.n}"


def recognise(problem: Problem, variable: str) -> Quotient | None:
    """The quotient by all rotations about the mean of the finite poles, if it has at most three singular points."""
    S, field = problem.S, problem.field
    den = S.den
    if den.degree < 1:
        return None
    center = -den[den.degree - 1] / (den.lc * den.degree)
    x = RatFunc(field.poly([0, 1]))
    symmetric = (S(x + center) if center else S) * x * x
    n = gcd(*(i for part in (symmetric.num, symmetric.den) for i, c in enumerate(part) if c))
    if n < 2:
        return None
    num, den = (field.poly([part[i] for i in range(0, part.degree + 1, n)]) for part in (symmetric.num, symmetric.den))
    quotient = analyse((RatFunc(num, den) - field.poly([n * n - 1]) / 4) / (n * x) ** 2, problem.budget)
    if not riemann.applies(quotient):
        return None
    base = variable if not center else f"({variable} - ({shown(RatFunc(center))}))"
    return Quotient(quotient, n, base)


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
