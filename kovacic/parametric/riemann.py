"""At most three regular singular points: Riemann's P-equation, and Kimura's theorem.

Let l, m, n be the exponent differences (1 at an ordinary point).  With three points S is determined by them, wherever the
points are, so the theorem needs no Moebius change:

- reducible (case 1) exactly when one of l + m + n, -l + m + n, l - m + n, l + m - n is an odd integer;
- otherwise imprimitive (case 2) exactly when two of them are half-integers;
- otherwise case 3 exactly when +-l, +-m, +-n are, in some order, in a row 2-15 of Schwarz's table modulo 1, with an even
  sum of the integer parts in the rows marked in `_SCHWARZ`;
- otherwise there is no Liouvillian solution.

The squares N^2 of the four sums are the roots of ((z - s1)^2 - 4 s2)^2 - 64 s3 z, s_i the elementary symmetric functions of
l^2, m^2, n^2, which are rational in the parameters also when the points are conjugate.

Reference: T. Kimura, Funkcial. Ekvac. 12 (1969) 269-281.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from itertools import product
from random import Random
from typing import Literal

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.algebra.traces import characteristic_polynomial
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Place, Problem
from kovacic.parametric.functions import over_parameters, shown, shown_root
from kovacic.parametric.integers import integer_roots, rational
from kovacic.parametric.statements import Point, Statement

_F = Fraction
#: Schwarz's rows: the structure, the exponent differences modulo 1, and whether l + m + q must be even.
_SCHWARZ: dict[int, tuple[Structure, tuple[Fraction, Fraction, Fraction], bool]] = {
    2: (Structure.TETRAHEDRAL, (_F(1, 2), _F(1, 3), _F(1, 3)), False),
    3: (Structure.TETRAHEDRAL, (_F(2, 3), _F(1, 3), _F(1, 3)), True),
    4: (Structure.OCTAHEDRAL, (_F(1, 2), _F(1, 3), _F(1, 4)), False),
    5: (Structure.OCTAHEDRAL, (_F(2, 3), _F(1, 4), _F(1, 4)), True),
    6: (Structure.ICOSAHEDRAL, (_F(1, 2), _F(1, 3), _F(1, 5)), False),
    7: (Structure.ICOSAHEDRAL, (_F(2, 5), _F(1, 3), _F(1, 3)), True),
    8: (Structure.ICOSAHEDRAL, (_F(2, 3), _F(1, 5), _F(1, 5)), True),
    9: (Structure.ICOSAHEDRAL, (_F(1, 2), _F(2, 5), _F(1, 5)), True),
    10: (Structure.ICOSAHEDRAL, (_F(3, 5), _F(1, 3), _F(1, 5)), True),
    11: (Structure.ICOSAHEDRAL, (_F(2, 5), _F(2, 5), _F(2, 5)), True),
    12: (Structure.ICOSAHEDRAL, (_F(2, 3), _F(1, 3), _F(1, 5)), True),
    13: (Structure.ICOSAHEDRAL, (_F(4, 5), _F(1, 5), _F(1, 5)), True),
    14: (Structure.ICOSAHEDRAL, (_F(1, 2), _F(2, 5), _F(1, 3)), True),
    15: (Structure.ICOSAHEDRAL, (_F(3, 5), _F(2, 5), _F(1, 3)), True),
}


def kimura(differences: tuple[Fraction | None, Fraction | None, Fraction | None]) -> Structure | None:
    """The structure for three exponent differences (None: not rational) that aren't reducible.

    >>> kimura((Fraction(1, 2), Fraction(1, 3), Fraction(1, 4)))
    <Structure.OCTAHEDRAL: 'octahedral'>
    """
    if sum(d is not None and d.denominator == 2 for d in differences) >= 2:
        return Structure.IMPRIMITIVE
    known = [d for d in differences if d is not None]
    if len(known) < 3 or any(d.denominator > 5 for d in known):
        return None
    first, second, third = sorted(int(60 * d) % 120 for d in known)
    return _table().get((first, second, third))


@lru_cache(maxsize=1)
def _table() -> dict[tuple[int, ...], Structure]:
    """Schwarz's rows, for the exponent differences modulo 2 in sixtieths, sorted."""
    table: dict[tuple[int, ...], Structure] = {}
    for structure, row, parity in _SCHWARZ.values():
        for whole in product((0, 1), repeat=3):
            if parity and sum(whole) % 2:
                continue
            values = [60 * (r + q) for r, q in zip(row, whole, strict=True)]
            for signs in product((1, -1), repeat=3):
                table[tuple(sorted(int(sign * v) % 120 for sign, v in zip(signs, values, strict=True)))] = structure
    return table


@dataclass(frozen=True)
class Schwarz(Statement):
    """The exponent differences, whose squares are the roots of `cubic`, belong to this structure in Schwarz's table."""

    cubic: FunctionPoly
    structure: Structure

    def _holds(self, point: Point) -> bool:
        value = point.at(self.cubic)
        differences: list[Fraction | None] = []
        for factor, multiplicity in value.field.factor(value):
            square = rational(-factor[0]) if factor.degree == 1 else None
            difference = None if square is None else _square_root(square)
            differences += [difference] * (multiplicity * factor.degree)
        first, second, third = differences
        return kimura((first, second, third)) is self.structure

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return replace(self, cubic=change(self.cubic))

    def sample(self, random: Random) -> list[FunctionPoly]:
        """Equations that give the exponent differences values from a row of the table; [] where they aren't rational in t."""
        field = self.cubic.field
        roots = [field.sqrt(-factor[0]) for factor, k in field.factor(self.cubic) if factor.degree == 1 and k == 1]
        rows = [[_F(k, 60) for k in key] for key, structure in _table().items() if structure is self.structure]
        values = random.choice(rows) if rows else [_F(1, 2), _F(3, 2), _F(random.randint(1, 9), random.randint(2, 9))]
        random.shuffle(values)
        known = [over_parameters(root) for root in roots if root is not None]
        return [root - value for root, value in zip(known, values, strict=True)] if len(known) == 3 else []

    def text(self) -> str:
        rows = [str(k) for k, row in _SCHWARZ.items() if row[0] is self.structure]
        which = "1 (two half-integers)" if not rows else f"{rows[0]}-{rows[-1]}"
        return (
            f"the exponent differences {_shown_differences(self.cubic)} are in Schwarz's row{'s' * bool(rows)} {which}"
        )

    def latex(self) -> str:
        return rf"\text{{{self.text().replace('^', chr(92) + '^{}')}}}"


def _shown_differences(cubic: FunctionPoly) -> str:
    field = cubic.field
    names = []
    for factor, k in field.factor(cubic):
        if factor.degree > 1:
            return f"(the square roots of the roots of {shown(cubic, 'Z')})"
        names += [shown_root(-factor[0])] * k
    return ", ".join(names)


def applies(problem: Problem) -> bool:
    """At most three singular points on the sphere, all of them regular."""
    singular = [place for place in problem.places if place.kind is not Kind.ORDINARY]
    return sum(place.degree for place in singular) <= 3 and all(place.kind is Kind.REGULAR for place in singular)


def squares_of_differences(problem: Problem) -> FunctionPoly:
    """The monic cubic over Q(t) whose roots are the squares of the exponent differences."""
    field = problem.field
    cubic = field.poly([1])
    for place in problem.places:
        if place.kind is not Kind.ORDINARY:
            cubic = cubic * characteristic_polynomial(_difference_squared(place), place.factor)
    one = field.poly([-1, 1])
    while cubic.degree < 3:
        cubic = cubic * one
    return over_parameters(cubic)


def _difference_squared(place: Place) -> Poly:
    """1 + 4b in K[x]/p."""
    if place.delta_squared is not None:
        return place.delta_squared
    p = place.factor
    cofactor = p.derivative() ** 2 * (place.den // p**2) % p
    return (1 + 4 * place.num * cofactor.inverse_modulo(p)) % p


def omega(problem: Problem, variable: str) -> str:
    """What a solution of case 1 looks like: its exponents, and the degree of its polynomial part."""
    general = f"omega = sum of (1 +- Delta_c)/(2 ({variable} - c)) + P'/P"
    differences = _shown_differences(squares_of_differences(problem)).split(", ")
    if len(differences) != 3:
        return f"{general}, P a polynomial"
    signs = "".join(f" +- ({d})" if " " in d else f" +- {d}" for d in differences)
    return f"{general} with signs for which deg P = (-1{signs})/2 is a natural number"


def group(problem: Problem, structure: Structure) -> str | None:
    """The family of the groups with this structure; None where the structure is all there is to say.

    All residues of a logarithmic derivative of a solution come from the exponents and from zeros, so that its constant
    multiples are rational logarithmic derivatives exactly where the exponents are rational.  On the curve w^2 = F of an
    imprimitive equation, which is rational because it has two branch points, the same holds for the third difference.
    """
    cubic = squares_of_differences(problem)
    constants, variable = _split(cubic)
    if structure is Structure.REDUCIBLE:
        if None not in constants and len(constants) >= 2:
            return "mu_n, or G_a extended by mu_n"  # a third difference is rational because their sum is
        where = f"where {_shown_differences(cubic)} are rational"
        return f"mu_n, or G_a extended by mu_n, {where}; else G_m, or the Borel group"
    if structure is not Structure.IMPRIMITIVE:
        return None
    rest = list(constants)
    for half in [d for d in constants if d is not None and d.denominator == 2][:2]:
        rest.remove(half)
    if len(constants) >= 2 and rest:
        return "the infinite dihedral group" if rest[0] is None else "dicyclic"
    if len(constants) == 2 and variable is not None:
        return f"dicyclic where {shown_root(variable)} is rational, else the infinite dihedral group"
    return "dicyclic where the third exponent difference is rational, else the infinite dihedral group"


def structures(problem: Problem) -> Iterator[tuple[Structure, Literal[True] | list[Statement]]]:
    """Each structure with the statements that say when the group has it and none of those before; True: always."""
    if sum(place.degree for place in problem.places if place.kind is not Kind.ORDINARY) <= 2:
        yield Structure.REDUCIBLE, True
        return
    cubic = squares_of_differences(problem)
    s1, s2, s3 = -cubic[2], cubic[1], -cubic[0]
    z = cubic.field.poly([0, 0, 1])
    reducible = integer_roots(((z - s1) ** 2 - 4 * s2) ** 2 - 64 * s3 * z, [1], 2)
    if reducible:
        yield Structure.REDUCIBLE, reducible
    constants, variable = _split(cubic)
    always = _only_structure(constants)
    if always is not None:
        yield always, True
    if always is not None or len(constants) == 3:
        return
    for structure in (Structure.IMPRIMITIVE, Structure.TETRAHEDRAL, Structure.OCTAHEDRAL, Structure.ICOSAHEDRAL):
        statements: list[Statement] = []
        if variable is None and (structure is Structure.IMPRIMITIVE or _in_some_row(constants, structure)):
            statements.append(Schwarz(cubic, structure))
        for denominator in (2, 3, 4, 5):
            if variable is None or len(constants) < 2:
                continue
            values = [_F(a, denominator) for a in range(2 * denominator)]
            residues = [
                int(denominator * v)
                for v in values
                if v.denominator == denominator and kimura((constants[0], constants[1], v)) is structure
            ]
            equation = over_parameters(problem.field.poly([-(denominator**2) * variable, 0, 1]))
            found = integer_roots(equation, residues, 2 * denominator) if residues else []
            if found is True:
                raise AssertionError("an exponent difference that depends on a parameter isn't constant")
            statements += found
        if statements:
            yield structure, statements


def _only_structure(constants: Sequence[Fraction | None]) -> Structure | None:
    """The structure that constant exponent differences determine, if the equation isn't reducible."""
    first, second, third = (*constants, None, None, None)[:3]
    return kimura((first, second, third))


def _in_some_row(constants: Sequence[Fraction | None], structure: Structure) -> bool:
    """Do the constant exponent differences (one at most) occur in a row with this structure?"""
    residues = {int(60 * d) % 120 if d is not None and d.denominator <= 5 else None for d in constants}
    return any(residues <= set(row) for row, known in _table().items() if known is structure)


def _split(cubic: FunctionPoly) -> tuple[list[Fraction | None], Poly | None]:
    """The constant exponent differences (None: irrational), and the square of the other one if there is exactly one."""
    field = cubic.field
    constants: list[Fraction | None] = []
    variable: list[Poly] = []
    for factor, multiplicity in field.factor(cubic):
        coefficients = [field.rational_value(c) for c in factor]
        if any(c is None for c in coefficients):
            variable += [-factor[0]] * multiplicity if factor.degree == 1 else [factor] * (2 * multiplicity)
        elif factor.degree == 1 and coefficients[0] is not None:
            square = -coefficients[0]
            constants += [_square_root(square)] * multiplicity
        else:
            constants += [None] * (factor.degree * multiplicity)
    return constants, variable[0] if len(variable) == 1 else None


def _square_root(value: Fraction) -> Fraction | None:
    """The square root of a rational number that isn't negative, if it is rational."""
    root = QQ.sqrt(QQ.poly([value]))
    number = None if root is None else rational(root)
    return None if number is None else abs(number)
