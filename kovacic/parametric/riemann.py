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

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, reduce
from itertools import product, repeat
from math import gcd, lcm
from operator import mul
from random import Random
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.algebra.traces import characteristic_polynomial
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Problem, rational_square_root
from kovacic.parametric import prose
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import (
    ODD,
    Classes,
    ParameterPoint,
    common_multiple,
    irreducible_factors,
    on_zeros,
    over_parameters,
    roots,
    scaled_form,
    without_parameters,
)
from kovacic.parametric.exponents import singular_places
from kovacic.parametric.formulas import expanded_form, in_sum, root_written
from kovacic.parametric.integers import at_integers, integer_roots, squares_of_roots
from kovacic.parametric.prose import Words
from kovacic.parametric.regions import RegionVerdict, borel, reducible
from kovacic.parametric.statements import ALWAYS, NEVER, Statement, all_of, either
from kovacic.writing.formula import Math, latex_text

_F = Fraction


class _SchwarzRow(NamedTuple):
    """The structure, the exponent differences modulo 1, and whether the sum of their integer parts must be even."""

    structure: Structure
    differences: tuple[Fraction, Fraction, Fraction]
    is_even: bool


#: Schwarz's rows: number, structure, differences, parity of the sum of the integer parts.
_ROWS = """
    2 tetrahedral 1/2 1/3 1/3 any
    3 tetrahedral 2/3 1/3 1/3 even
    4 octahedral 1/2 1/3 1/4 any
    5 octahedral 2/3 1/4 1/4 even
    6 icosahedral 1/2 1/3 1/5 any
    7 icosahedral 2/5 1/3 1/3 even
    8 icosahedral 2/3 1/5 1/5 even
    9 icosahedral 1/2 2/5 1/5 even
    10 icosahedral 3/5 1/3 1/5 even
    11 icosahedral 2/5 2/5 2/5 even
    12 icosahedral 2/3 1/3 1/5 even
    13 icosahedral 4/5 1/5 1/5 even
    14 icosahedral 1/2 2/5 1/3 even
    15 icosahedral 3/5 2/5 1/3 even
"""
#: By their numbers.
_SCHWARZ = {
    int(number): _SchwarzRow(Structure(structure), (_F(first), _F(second), _F(third)), parity == "even")
    for number, structure, first, second, third, parity in map(str.split, _ROWS.strip().splitlines())
}


def kimura_structure(differences: Sequence[Fraction | None]) -> Structure | None:
    """The structure for three exponent differences; one that isn't rational, in an irreducible equation, is None or missing.

    >>> kimura_structure((Fraction(1, 2), Fraction(1, 3), Fraction(1, 4)))
    <Structure.OCTAHEDRAL: 'octahedral'>
    """
    known = [difference for difference in differences if difference is not None]
    sums = (sum(map(mul, signs, known)) for signs in product((1, -1), repeat=len(known)))
    if len(known) == 3 and any(total % 2 == 1 for total in sums):
        return Structure.REDUCIBLE
    if sum(difference.denominator == 2 for difference in known) >= 2:
        return Structure.IMPRIMITIVE
    return _STRUCTURES_BY_KEY.get(_difference_key(known))


def _sixtieths(difference: Fraction) -> Fraction:
    """The difference up to its sign modulo 2, from 0 to 60: an integer for a denominator of the table."""
    residue = 60 * difference % 120
    return min(residue, 120 - residue)


def _difference_key(differences: Sequence[Fraction]) -> tuple[Fraction, ...]:
    return tuple(sorted(map(_sixtieths, differences)))


#: Schwarz's rows, for the exponent differences up to signs modulo 2 in sixtieths, sorted.
_STRUCTURES_BY_KEY = {
    _difference_key([r + q for r, q in zip(row.differences, integers, strict=True)]): row.structure
    for row in _SCHWARZ.values()
    for integers in product((0, 1), repeat=3)
    if not row.is_even or sum(integers) % 2 == 0
}


#: The largest denominator in Schwarz's table.
LARGEST_DENOMINATOR = max(difference.denominator for row in _SCHWARZ.values() for difference in row.differences)
#: The group if all exponents are rational, and a solution has a rational omega.
_CYCLIC = "finite cyclic, or `G_a` extended by a finite cyclic group"


@dataclass(frozen=True)
class Schwarz(Statement):
    """The exponent differences, whose squares are the roots of `cubic`, belong to these structures in Schwarz's table."""

    cubic: FunctionPoly
    structures: tuple[Structure, ...]

    def _holds(self, point: ParameterPoint) -> bool:
        if point.field.ground != QQ:
            return False
        return kimura_structure([*map(rational_square_root, roots(point.at(self.cubic)))]) in self.structures

    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        return (self.cubic,)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return replace(self, cubic=change(self.cubic))

    def sample(self, random: Random) -> list[FunctionPoly]:
        """Equations that give the exponent differences values from a row of the table; [] if they aren't rational in t."""
        rows = [key for key, structure in _STRUCTURES_BY_KEY.items() if structure in self.structures]
        two_half_integers = (30, 90, _F(60 * random.randint(1, 9), random.randint(2, 9)))  # without a row in the table
        values = [_F(k) / 60 for k in (random.choice(rows) if rows else two_half_integers)]
        random.shuffle(values)
        known = [*filter(None, map(_rational_root, dict.fromkeys(roots(self.cubic))))]
        if len(known) != 3:
            return []
        return [root - value for root, value in zip(known, values, strict=True)]

    def under(self, assumptions: Assumptions) -> Statement:
        """The statement at each integer t for which an exponent difference with t has a denominator of the table."""
        for difference in filter(None, map(_rational_root, roots(self.cubic))):
            known = at_integers(difference, LARGEST_DENOMINATOR, assumptions)
            if known is not None:
                there = ((here, on_zeros(self.cubic, here.function).monic()) for here, _ in known)
                return either(*(all_of((here, _in_rows(cubic, self.structures))) for here, cubic in there))
        return self

    def line(self) -> str:
        """The claim that these differences are in these rows."""
        known = differences(self.cubic)
        if self.structures == (Structure.IMPRIMITIVE,) and known.names is not None:
            return known.two_half_integers
        rows = [number for number, row in _SCHWARZ.items() if row.structure in self.structures]
        which = f"rows {rows[0]}-{rows[-1]}" if rows else "row 1 (two half-integers)"
        names = known.names or (f"(the square roots of the roots of {expanded_form(self.cubic, 'Z')})",)
        return f"the exponent differences {_in_backquotes(names)} are in Schwarz's {which}"

    def resolved(self) -> tuple[Sequence[str], list[tuple[Structure, list[Words]]]]:
        """The names of two differences next to a constant one, and their classes modulo 1 or 2 up to signs by structure.

        Otherwise no names, and the rows of Schwarz's table: the differences modulo 1, and the parity of the sum of integers.
        """
        known = differences(self.cubic)
        third = known.constants[0] if len(known.constants) == 1 else None
        if known.names is not None and third is not None:
            return known.free, self._rows_beside(third)
        rows: list[tuple[Structure, list[Words]]] = []
        for row in _SCHWARZ.values():
            if row.structure in self.structures:
                residues = ", ".join(map(str, row.differences))
                rows.append((row.structure, [prose.phrase(f"`{residues}`"), ("even" if row.is_even else "any",)]))
        return (), rows

    def _rows_beside(self, third: Fraction) -> list[tuple[Structure, list[Words]]]:
        """The classes of the other two differences, in sixtieths up to signs: modulo 1 if these suffice, else modulo 2."""
        pairs = product(range(61), repeat=2)
        table = ((_STRUCTURES_BY_KEY.get(_difference_key([_F(u, 60), _F(v, 60), third])), u, v) for u, v in pairs)
        found = [(structure, u, v) for structure, u, v in table if structure in self.structures]
        # If u and 1 - u have the same structures, and so v and 1 - v, these depend on the differences modulo 1 only.
        is_symmetric = {*found} == {(s, 60 - u, v) for s, u, v in found} == {(s, u, 60 - v) for s, u, v in found}
        lattice = "Z" if is_symmetric else "2*Z"
        found.sort(key=lambda pair: (self.structures.index(pair[0]), pair[1], pair[2]))
        return [
            (structure, [_class(u, lattice), _class(v, lattice)])
            for structure, u, v in found
            if not is_symmetric or max(u, v) <= 30
        ]

    def merged(self, other: Statement) -> Schwarz | None:
        if isinstance(other, Schwarz) and other.cubic == self.cubic:
            return Schwarz(self.cubic, (*self.structures, *other.structures))
        return None


prose.WRITERS[Schwarz] = Schwarz.line


def _class(sixtieths: int, lattice: str) -> Words:
    """`+-1/3 + 2*Z`."""
    number = f"+-{_F(sixtieths, 60)}"
    latex = lattice.replace("2*", "2 ").replace("Z", r"\mathbb{Z}")
    return (Math(f"{number} + {lattice}", f"{latex_text(number)} + {latex}"),)


def _in_backquotes(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


@dataclass(frozen=True)
class Differences:
    """The exponent differences whose squares are the roots of a cubic: their names, and those without parameters."""

    #: Sums of square roots; None if one isn't such a sum.
    names: tuple[str, ...] | None
    #: The names of those that aren't rational numbers.
    free: tuple[str, ...]
    #: Those without parameters: rational numbers, and None for irrational ones.
    constants: tuple[Fraction | None, ...]

    @property
    def two_half_integers(self) -> str:
        """The claim that two of them are half-integers, of which none is constant."""
        if len(self.free) == 2:
            return f"`{self.free[0]}` and `{self.free[1]}` are half-integers"
        return f"two of {_in_backquotes(self.free)} are half-integers"

    @property
    def rational(self) -> str:
        """The claim that they are rational, about those that aren't numbers, if a solution has a rational omega.

        Then a sum of +- all of them is an integer, so that a single one with a root is rational if the others are.
        """
        if self.names is None:
            return "the exponent differences are rational"
        roots = [name for name in self.free if "sqrt" in name]
        free = [*dict.fromkeys(name for name in self.free if [name] != roots)] or roots
        return f"{_in_backquotes(free)} {'is' if len(free) == 1 else 'are'} rational"

    @property
    def imprimitive_group(self) -> str:
        """The dicyclic or the infinite dihedral group, by the third difference next to two half-integers."""
        halves = [constant for constant in self.constants if constant is not None and constant.denominator == 2]
        beside = [*(constant for constant in self.constants if constant not in halves), *halves[2:]]
        if len(self.constants) >= 2 and beside:
            return "the infinite dihedral group" if beside[0] is None else "dicyclic"
        third = f"`{self.free[0]}`" if len(self.constants) == 2 else "the third exponent difference"
        return f"dicyclic where {third} is rational, else the infinite dihedral group"


@lru_cache(maxsize=64)
def differences(cubic: FunctionPoly) -> Differences:
    """The differences by the factors of the cubic."""
    names: list[str | None] = []
    free: list[str | None] = []
    constants: list[Fraction | None] = []
    for factor, k in cubic.field.factor(cubic):
        roots = [*(_square_roots_of_roots(factor) or repeat(None, factor.degree))] * k
        constant = None
        names += roots
        if without_parameters(factor) is not None:
            constant = rational_square_root(-factor[0]) if factor.degree == 1 else None
            constants += [constant] * len(roots)
        if constant is None:
            free += roots
    known, unknown = (tuple(filter(None, several)) for several in (names, free))
    return Differences(None if None in names else known, unknown, tuple(constants))


def _square_roots_of_roots(factor: Poly) -> list[str] | None:
    """sqrt(a) for Z - a, sqrt((-b + 2 r)/4) +- sqrt((-b - 2 r)/4) for Z^2 + b Z + r^2; None for any other factor."""
    squares = squares_of_roots(factor(factor.field.poly([0, 0, 1]))) if factor.degree < 3 else None
    if squares is None:
        return None
    first, *others = map(root_written, squares)
    return [f"{first} {sign} {in_sum(second)}" for second in others for sign in "+-"] or [first]


def has_regular_points_only(problem: Problem) -> bool:
    return all(place.kind in (Kind.ORDINARY, Kind.REGULAR) for place in problem.places)


def singular_points(problem: Problem) -> int:
    """The number of singular points on the sphere."""
    return sum(place.degree for place in singular_places(problem))


def squares_of_differences(problem: Problem) -> FunctionPoly:
    """The monic polynomial over Q(t) whose roots are the squares of the exponent differences, at least three."""
    ordinary = max(3 - singular_points(problem), 0)  # points at which the difference is 1
    squares = (characteristic_polynomial(one.difference_squared, one.factor) for one in singular_places(problem))
    return over_parameters(reduce(mul, squares, problem.field.poly([-1, 1]) ** ordinary))


def verdict_by_exponents(problem: Problem, structure: Structure) -> RegionVerdict:
    """The family of the groups with this structure, and where the identity component of a reducible one is abelian.

    The verdict holds for values of the parameters at which the singular points are the generic ones.  All residues of a
    logarithmic derivative of a solution come from the exponents and from zeros, so that its constant multiples are rational
    logarithmic derivatives exactly if the exponents are rational, and never with an irregular point.  With two singular points
    the solutions are powers.  On the curve w^2 = F of an imprimitive equation, which is rational because it has two branch
    points, the same holds for the third difference.

    With a polynomial S that isn't a constant, y1 = P1 exp(q) and y2 = P2 exp(-q) can't both be solutions, since their Wronskian
    has the degree of q' P1 P2: the group is Borel's [Acosta-Humanez & Blazquez-Sanz 2008].
    """
    if structure is Structure.REDUCIBLE and not has_regular_points_only(problem):
        if not problem.S.is_polynomial:
            return borel("two solutions have rational logarithmic derivatives")
        if problem.S.num.degree > 0:
            return borel()
        zeros = " or ".join(f"`{prose.equation_of_zeros(zero).text}`" for zero in irreducible_factors(problem.S.num))
        return reducible(f"`G_m`, or trivial where {zeros}" if zeros else "`G_m`")
    cubic = squares_of_differences(problem)
    known = differences(cubic)
    if structure is Structure.IMPRIMITIVE:
        return RegionVerdict(structure, family=known.imprimitive_group)
    if structure is not Structure.REDUCIBLE:
        return RegionVerdict(structure)
    if len(known.constants) >= cubic.degree - 1 and None not in known.constants:
        return reducible(_CYCLIC)  # the last one is rational, too, since its sum with the others is an integer
    if singular_points(problem) <= 2:
        return reducible(f"{_CYCLIC}, where {known.rational}; else `G_m`")
    return reducible(
        f"{_CYCLIC}, where {known.rational}; else `G_m`, or the Borel group",
        f"abelian where {known.rational}; elsewhere exactly where the group is `G_m`",
    )


def kimura_statements(problem: Problem) -> Iterator[tuple[Structure, Statement]]:
    """Each structure with the statement under which the group has it, and no earlier one."""
    cubic = squares_of_differences(problem)
    s1, s2, s3 = -cubic[2], cubic[1], -cubic[0]
    z = cubic.field.poly([0, 0, 1])
    sums = ((z - s1) ** 2 - 4 * s2) ** 2 - 64 * s3 * z  # its roots N are the four sums, up to signs
    yield Structure.REDUCIBLE, integer_roots(sums, ODD)
    constants = differences(cubic).constants
    always = kimura_structure(constants)
    if always is not None:
        yield always, ALWAYS
        return
    # Structures with a row that contains all constant differences, none of them irrational.
    residues = {None if constant is None else _sixtieths(constant) for constant in constants}
    possible = {structure for row, structure in _STRUCTURES_BY_KEY.items() if residues <= {*row}}
    for structure in Structure if len(constants) < 3 else ():
        if structure in possible or structure is Structure.IMPRIMITIVE:
            yield structure, _in_table(cubic, structure)


def _in_rows(cubic: FunctionPoly, structures: Sequence[Structure]) -> Statement:
    """The statement that the exponent differences are in the rows of one of the structures, also if all are numbers."""
    if without_parameters(cubic) is None:
        return either(*(_in_table(cubic, structure) for structure in structures))
    return ALWAYS if kimura_structure([*map(rational_square_root, roots(cubic))]) in structures else NEVER


def _in_table(cubic: FunctionPoly, structure: Structure) -> Statement:
    """The statement that the exponent differences are in the rows of the structure, by one function if possible."""
    by_one_function = _by_one_function(cubic, structure)
    if by_one_function is not None:
        return by_one_function
    if structure is Structure.IMPRIMITIVE:
        beside = sum(d is not None and d.denominator == 2 for d in differences(cubic).constants)
        # A difference with parameters, and a constant half-integer or an equal difference: the square is N^2/4, N odd.
        powers = cubic.field.factor(cubic)
        free = [factor for factor, k in powers if k + beside > 1 and without_parameters(factor) is None]
        if free:
            squares = (factor(cubic.field.poly([0, 0, _F(1, 4)])) for factor in free)
            return either(*(integer_roots(square, ODD) for square in squares))
    return Schwarz(cubic, (structure,))


def has_denominator(square: Poly, denominator: int) -> Statement:
    """The statement that an exponent difference with this square is rational with this denominator."""
    equation = square.field.poly([-square * denominator**2, 0, 1])
    coprime = (r for r in range(denominator) if gcd(r, denominator) == 1)
    return integer_roots(equation, Classes.of(coprime, denominator))


def _rational_root(square: Poly) -> FunctionPoly | None:
    """The square root, if it is a rational function of the parameters."""
    root = square.field.sqrt(square)
    return None if root is None else over_parameters(root)


def _by_one_function(cubic: FunctionPoly, structure: Structure) -> Statement | None:
    """Where the irreducible equation has this structure, if the differences are lines a w + b in one w; else None.

    w or w^2 is a rational function of the parameters.
    """
    constants = differences(cubic).constants
    free = [over_parameters(square) for square in roots(cubic) if without_parameters(square) is None]
    if len(free) + len(constants) < cubic.degree:
        return None
    rational = [*map(_rational_root, free)]
    if None in rational:
        # Multiples of w = sqrt(free[0]), so that w and -w are equivalent.
        power, k = free[0], 2
        slopes = [rational_square_root(square / power) for square in free]
        lines = [(slope, _F(0)) for slope in slopes if slope]
    else:
        forms = [*map(scaled_form, filter(None, rational))]
        power, k = forms[0][0], 1
        lines = [(1 / scale, shift) for form, scale, shift in forms if form == power]
    if len(lines) < len(free):
        return None
    # The w modulo the period with this structure: of those at which a line has a denominator of the table.
    period = reduce(common_multiple, (2 / abs(slope) for slope, _ in lines))
    tried = {
        (_F(above, below) - shift) / slope % period
        for slope, shift in lines
        for below in range(1, LARGEST_DENOMINATOR + 1)
        for above in range(int(below * period * abs(slope)))
    }
    admitted = [w for w in sorted(tried) if kimura_structure([*constants, *(a * w + b for a, b in lines)]) is structure]
    statements = list[Statement]()
    for denominator in sorted({w.denominator for w in admitted}):
        D = lcm(denominator, period.denominator)
        equation = cubic.field.poly([-(D**k) * power, *[0] * (k - 1), 1])  # its roots are D w
        numbers = Classes.of((D * w for w in admitted if w.denominator == denominator), D * period)
        statements.append(integer_roots(equation, numbers))
    return either(*statements)
