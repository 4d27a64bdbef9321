"""A condition solved for a parameter: f(n; t) = 0 with an integer n becomes t = value(n), and what is said elsewhere.

With f = slope t + rest, the slope and the rest without a common factor, there are three strata [section 23 of the theory]:

- slope != 0, and t = -rest/slope;
- slope = rest = 0, where t is free;
- slope = 0 and rest != 0: never.

`solve_for` is the only maker, and returns the second with the first.  A factor of the slope vanishes at one n, which is a pole
of the value, or on a hypersurface of the other parameters, whatever n is.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import floor
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import ENERGY
from kovacic.parametric import prose
from kovacic.parametric.claims import (
    Alternatives,
    Claim,
    EquationFor,
    Free,
    IntegerFamily,
    SumOfRoots,
    ThatIs,
    WhereZero,
)
from kovacic.parametric.formulas import shortest_length
from kovacic.parametric.functions import (
    INTEGERS,
    NATURALS,
    Classes,
    constant_term,
    degrees,
    element,
    irreducible_factors,
    numerator,
    over_parameters,
    powers_of,
)
from kovacic.parametric.statements import Setting

#: How much more the length of f(n) counts than that of what is said about n, and what it costs to solve for a later parameter.
_WEIGHT = 3
_LATER = 10
#: What it costs, for each stratum of which something has to be said.
_STRATUM = 20


class Stratum(NamedTuple):
    """Where `zero`, a function of the parameters, vanishes, the condition is `rest`(n) = 0, and one parameter is free."""

    zero: FunctionPoly
    rest: FunctionPoly


@dataclass(frozen=True)
class SolvedCondition:
    """f(n; t) = 0 for `parameter` t: it is `value`, or free at one of the `poles` or on one of the `strata`."""

    parameter: str
    value: RatFunc
    poles: tuple[Free, ...]
    strata: tuple[Stratum, ...]

    def family(self, letter: str, numbers: Classes) -> IntegerFamily:
        """The first stratum and the poles, for n among these numbers."""
        return IntegerFamily(self.parameter, self.value, letter, numbers, possible(self.poles, numbers))


def solve_for(name: str, equation: FunctionPoly) -> SolvedCondition | None:
    """All solutions of a polynomial equation in n over Q(t) by values of one parameter.

    None where the parameter isn't linear in it, and where its coefficient vanishes at the n of an equation of higher degree.
    """
    i = equation.field.names.index(name)
    if degrees(equation)[i] != 1:
        return None
    parts = powers_of(equation, i)
    slope = parts[1]
    rest = parts.get(0, 0 * slope)
    if not slope.num.gcd(rest.num).is_constant():
        return None
    undefined = irreducible_factors(element(equation.field, equation.den))
    poles: list[Free] = []
    strata: list[Stratum] = []
    for factor in irreducible_factors(slope):
        if factor.degree > 1:
            return None
        if factor.degree == 1:
            root = over_parameters(-factor[0] / factor[1])
            poles += [Free(root, zero) for zero in [_product_of_zeros(rest(root))] if zero is not None]
        elif factor not in undefined:
            strata.append(Stratum(factor, on_zeros(rest, factor)))
    poles.sort(key=lambda pole: str(pole.root))
    return SolvedCondition(name, -RatFunc(rest, slope), tuple(poles), tuple(strata))


def _product_of_zeros(value: Poly) -> FunctionPoly | None:
    """The product of the irreducible factors of a function of the parameters; None for a number other than 0."""
    factors = irreducible_factors(value)
    if not factors:
        return None if value else over_parameters(value)
    total = factors[0]
    for factor in factors[1:]:
        total = over_parameters(total * factor)
    return total


def on_zeros(function: FunctionPoly, zero: FunctionPoly) -> FunctionPoly:
    """The function where another one vanishes, without the parameter that follows there if one does, over the same field."""
    field = function.field
    for i, power in enumerate(degrees(zero)):
        parts = powers_of(zero, i)
        if power != 1 or not parts[1].num.is_constant():
            continue
        values = [field.generator(name) for name in field.names]
        values[i] = -parts.get(0, 0 * parts[1]) / parts[1]
        return over_parameters(numerator(function).value_at(values, field))
    return function


def possible(poles: Sequence[Free], numbers: Classes) -> tuple[Free, ...]:
    """The poles at which n can be one of the numbers."""
    found = []
    for pole in poles:
        number = pole.root.field.rational_value(pole.root)
        if number is None or numbers.contains(number):
            found.append(pole)
    return tuple(found)


def all_solved(equation: FunctionPoly, fixed: Collection[str] = ()) -> list[SolvedCondition]:
    """The equation solved for each parameter for which that is possible, but for the `fixed` ones."""
    names = [name for name in equation.field.names if name not in fixed]
    return [solved for solved in (solve_for(name, equation) for name in names) if solved is not None]


# ------------------------------------------------------------------------------- an equation for an integer


class IntegerCondition(NamedTuple):
    """A claim, and the strata on which the same has to be said of another equation."""

    claim: Claim
    strata: tuple[Stratum, ...] = ()
    #: True if a parameter was solved for, and the denominators of the equation are gone.
    is_solved: bool = False


def integer_condition(
    equation: FunctionPoly,
    numbers: Classes,
    letter: str,
    setting: Setting,
) -> IntegerCondition:
    """That a polynomial in N over Q(t) has one of the numbers for a root, as a spectrum or by square roots, or both."""
    spectrum = _spectrum(equation, numbers, letter, setting)
    roots = _roots(equation, numbers)
    if roots is None:
        return spectrum or IntegerCondition(EquationFor(equation, letter, numbers))
    if spectrum is None:
        return IntegerCondition(roots)
    if len(roots.squares) > 1:
        return IntegerCondition(roots if spectrum.strata else ThatIs(roots, spectrum.claim))
    return spectrum


def _spectrum(equation: FunctionPoly, numbers: Classes, letter: str, setting: Setting) -> IntegerCondition | None:
    """A parameter as a function of n, by the cheapest way to choose n; None where no parameter is linear."""
    known = all_solved(equation, setting.fixed)
    energies = [solved for solved in known if solved.parameter == ENERGY]
    best: IntegerCondition | None = None
    least = 0
    for k, solved in enumerate(energies or known):
        strata = tuple(one for one in solved.strata if not setting.covers(one.zero))
        for family in _choices(equation, solved, numbers, letter):
            length = _WEIGHT * shortest_length(family.value, family.letter) + prose.length_of(prose.numbers_of(family))
            cost = _LATER * k + _STRATUM * len(strata) + length
            if best is None or cost < least:
                best = IntegerCondition(family, strata, is_solved=True)
                least = cost
    return best


def _choices(equation: FunctionPoly, solved: SolvedCondition, numbers: Classes, letter: str) -> Iterator[IntegerFamily]:
    """f(N) with N = n; and with N = s n + r, n an integer."""
    N = equation.field.poly([0, 1])
    is_mirrored = equation(-N) == (-1) ** equation.degree * equation
    first = numbers.residues[0]
    are_mirrored = is_mirrored and {*numbers.residues} == {first, -first % numbers.modulus}  # r and -r say the same
    is_single = len(numbers.residues) == 1 or are_mirrored
    if equation.degree > 1 or not is_single:
        yield solved.family(letter, numbers)
    if is_single and (numbers.modulus < 3 or not is_mirrored):
        for line in _lines(numbers, N):
            poles = tuple(Free(over_parameters((pole.root - line[0]) / line[1]), pole.zero) for pole in solved.poles)
            value = solved.value(RatFunc(line))
            yield IntegerFamily(solved.parameter, value, letter, INTEGERS, possible(poles, INTEGERS))


def _lines(numbers: Classes, N: Poly) -> Iterator[Poly]:
    """s n + r for an integer n, with the residue and its neighbours for r, and with both signs for the modulus 1."""
    modulus = numbers.modulus
    pairs = [(1, 0), (1, -1)]
    if modulus == 1:
        pairs = list(product((1, -1), (0, -1, 1)))
    for sign, shift in pairs:
        yield N * (sign * modulus) + numbers.residues[0] + modulus * shift


def _roots(equation: FunctionPoly, numbers: Classes) -> SumOfRoots | None:
    """The roots as a mean +- the square roots of one, two or three squares, for an equation of degree 2, 4 or 8."""
    if equation.degree not in (2, 4, 8):
        return None
    mean = over_parameters(-equation[equation.degree - 1] / (equation.lc * equation.degree))
    shifted = equation(equation.field.poly([0, 1]) + mean) / equation.lc
    squares = _squares(shifted)
    if squares is None:
        return None
    constant = floor(constant_term(mean) / numbers.modulus) * numbers.modulus
    return SumOfRoots(over_parameters(mean - constant), tuple(squares), numbers)


def _squares(shifted: Poly) -> list[Poly] | None:
    """Those of which the roots of a monic even polynomial are sums, with all signs, of square roots."""
    k = shifted.degree
    if any(shifted[i] for i in range(1, k, 2)):
        return None
    if k == 2:
        return [-shifted[0]]
    if k == 8:
        return _three_squares(shifted)
    difference = shifted.field.sqrt(shifted[0])
    if difference is None:
        return None
    total = -shifted[2] / 2
    return [(total + difference) / 2, (total - difference) / 2]


def _three_squares(shifted: Poly) -> list[Poly] | None:
    """By ((z - s1)^2 - 4 s2)^2 - 64 s3 z with z = N^2, s_i the symmetric functions of the three squares."""
    s1 = -shifted[6] / 4
    s2 = (6 * s1 * s1 - shifted[4]) / 8
    s3 = (16 * s1 * s2 - 4 * s1**3 - shifted[2]) / 64
    if shifted[0] != (s1 * s1 - 4 * s2) ** 2:
        return None
    squares: list[Poly] = []
    for factor, multiplicity in shifted.field.factor(shifted.field.poly([-s3, s2, -s1, 1])):
        if factor.degree == 1:
            squares += [-factor[0]] * multiplicity
    return squares if len(squares) == 3 else None


# ------------------------------------------------------------------------------- equations for a natural number


def alternatives(equations: Sequence[FunctionPoly], letter: str, setting: Setting) -> Alternatives:
    """That a natural number d solves one of the equations, each solved for a parameter if it can be."""
    families: list[IntegerFamily] = []
    unsolved: list[EquationFor] = []
    where: dict[FunctionPoly, list[FunctionPoly]] = {}
    for equation in equations:
        known = all_solved(equation, setting.fixed)
        if not known:
            unsolved.append(EquationFor(equation, letter, NATURALS))
            continue
        solved = min(known, key=lambda one: sum(not setting.covers(stratum.zero) for stratum in one.strata))
        families.append(solved.family(letter, NATURALS))
        for stratum in solved.strata:
            if not setting.covers(stratum.zero):
                where.setdefault(stratum.zero, []).extend(_that_can_be_natural(stratum.rest))
    strata = [WhereZero(alternatives(rests, letter, setting), zero) for zero, rests in where.items() if rests]
    return Alternatives(letter, tuple(families), tuple(unsolved), tuple(strata))


def _that_can_be_natural(equation: FunctionPoly) -> list[FunctionPoly]:
    """The irreducible factors that have a natural root for some values of the parameters."""
    found = []
    for factor in irreducible_factors(equation):
        is_number = factor.degree == 1 and not any(degrees(factor))
        root = factor.field.rational_value(-factor[0] / factor[1]) if is_number else None
        is_possible = any(degrees(factor)) if root is None else NATURALS.contains(root)
        if factor.degree > 0 and is_possible:
            found.append(factor)
    return found
