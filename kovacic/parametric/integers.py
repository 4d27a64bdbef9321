"""Statements about integers: a polynomial in N over Q(t) has a root N in given classes.

For a polynomial of degree 1 that is: a form in the parameters is congruent to one of some rational numbers.

Such a condition is solved for a parameter: f(n; t) = 0 with an integer n becomes t = value(n), with other statements elsewhere.
For f = slope t + rest, the slope and the rest without a common factor, there are three strata [section 23 of the theory]:

- slope != 0, and t = -rest/slope;
- slope = rest = 0, where t is free;
- slope = 0 and rest != 0: never.

`solve_for` is the only maker, and returns the second with the first.  A factor of the slope vanishes at one n, which is a pole
of the value, or on a hypersurface of the other parameters, whatever n is.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, reduce
from itertools import chain, count, product
from math import ceil, floor, lcm
from operator import mul
from random import Random
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import ENERGY
from kovacic.limits import MOST_TRIALS
from kovacic.parametric import prose
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import (
    INTEGERS,
    NATURALS,
    AllOf,
    AnyOf,
    Claim,
    Classes,
    EquationFor,
    Free,
    InClasses,
    IntegerFamily,
    IsNonzero,
    IsZero,
    ParameterPoint,
    SumOfRoots,
    common_multiple,
    degrees,
    denominator,
    irreducible_factors,
    laurent_constant_term,
    numerator,
    on_zeros,
    over_parameters,
    polynomial_factors,
    powers_of,
    rational_number,
    rational_roots,
    roots,
    scaled_form,
    with_free_generator,
)
from kovacic.parametric.formulas import shortest_form
from kovacic.parametric.restriction import everywhere, with_free_constant
from kovacic.parametric.statements import ALWAYS, NEVER, Setting, Statement, Vanishes, all_of, either, reduced_statement


class Stratum(NamedTuple):
    """Where `zero`, a function of the parameters, vanishes, the condition is `rest`(n) = 0, and one parameter is free."""

    zero: FunctionPoly
    rest: FunctionPoly


class IntegerCondition(NamedTuple):
    """A claim, and the strata on which it has to be stated of another equation."""

    claim: Claim
    strata: tuple[Stratum, ...] = ()


#: f(n; t) = 0 for a parameter t: it is a function of n, or free at one of the family's poles or on one of the strata.
SolvedForParameter = tuple[IntegerFamily, tuple[Stratum, ...]]


def solve_for(name: str, equation: FunctionPoly, letter: str, setting: Setting) -> SolvedForParameter | None:
    """All solutions of an irreducible equation in n over Q(t) by values of one parameter, as far as the setting needs them.

    None if the parameter isn't linear in it, or if its coefficient has a factor of higher degree in n.
    """
    i = equation.field.names.index(name)
    if degrees(equation)[i] != 1:
        return None
    parts = powers_of(equation, i)
    slope = parts[1]
    rest = parts.get(0, 0 * slope)
    undefined = irreducible_factors(denominator(equation))
    known = setting.assumptions
    poles, strata = list[Free](), list[Stratum]()
    for factor in irreducible_factors(slope):
        if factor.degree > 1:
            return None
        if factor.degree == 1:
            root = -factor[0] / factor[1]
            zeros = irreducible_factors(rest(root))
            if zeros and known.vanishes(reduce(mul, zeros)) is not False:
                poles.append(Free(root, reduce(mul, zeros)))
        elif factor not in undefined and not setting.covers(factor):
            strata.append(Stratum(factor, on_zeros(rest, factor)))
    poles.sort(key=lambda pole: str(pole.root))
    value = -RatFunc(rest, slope)
    if known.constant.names:  # without the constant in denominators: sqrt(2), not 2/sqrt(2)
        value = with_free_constant(everywhere(equation.field, known.constant).restricted(value)).shown
    return IntegerFamily(letter, name, value, INTEGERS, tuple(poles)), tuple(strata)


def all_solved(equation: FunctionPoly, letter: str, setting: Setting) -> list[SolvedForParameter]:
    """The equation solved for each parameter for which that is possible, except for the fixed ones."""
    names = (name for name in equation.field.names if name not in setting.fixed)
    return [*filter(None, (solve_for(name, equation, letter, setting) for name in names))]


# ------------------------------------------------------------------------------- an equation for an integer


def integer_condition(equation: FunctionPoly, numbers: Classes, letter: str, setting: Setting) -> IntegerCondition:
    """The condition that one of the numbers is a root of a polynomial in N over Q(t): a spectrum, square roots, or both."""
    spectrum = _spectrum(equation, numbers, letter, setting)
    sums = _roots_as_sum(equation, numbers, setting.assumptions.constant)
    if sums is None or (isinstance(spectrum.claim, IntegerFamily) and (len(sums.squares) < 2 or not spectrum.strata)):
        return spectrum
    return IntegerCondition(sums)


def _spectrum(equation: FunctionPoly, numbers: Classes, letter: str, setting: Setting) -> IntegerCondition:
    """A parameter as a function of n, in the shortest form; the equation itself if no parameter is linear."""
    known = all_solved(equation, letter, setting)
    energies = [solved for solved in known if solved[0].parameter == ENERGY]
    found: list[tuple[int, bool, IntegerCondition]] = []
    for k, (solved, strata) in enumerate(energies or known):
        for family in _integer_choices(equation, solved, numbers):
            text = shortest_form(family.value, family.letter)
            condition = prose.text_of_words(prose.phrase(prose.numbers_of(family)))
            # Weights chosen by eye: a formula counts more than words, and both less than a later parameter or a stratum.
            cost = 10 * k + 20 * len(strata) + 3 * len(text) + 2 * len(condition)
            # Of n and -n the one with f(1) = 1, if there is one: n + k*n*(n - 1)/2, as Yoshida and Morales & Ramis write it.
            above, below = (part(Fraction(1)) for part in (family.value.num, family.value.den))
            is_numbered_otherwise = not below or above != below
            found.append((cost, is_numbered_otherwise, IntegerCondition(family, strata)))
    equation_for = IntegerCondition(EquationFor(letter, equation, numbers))
    return min(found, key=lambda one: one[:2])[2] if found else equation_for


def _integer_choices(equation: FunctionPoly, family: IntegerFamily, numbers: Classes) -> Iterator[IntegerFamily]:
    """f(N) with N = n; and with N = s n + r, n an integer."""
    N = equation.field.poly([0, 1])
    is_mirrored = equation(-N) == (-1) ** equation.degree * equation
    first = numbers.residues[0]
    are_mirrored = is_mirrored and {*numbers.residues} == {first, -first % numbers.modulus}  # r and -r say the same
    is_line = (len(numbers.residues) == 1 or are_mirrored) and numbers.least is None
    if equation.degree > 1 or not is_line:
        yield family.along(N, numbers)
    modulus = numbers.modulus
    if is_line and (modulus < 3 or not is_mirrored):
        # r is the residue or a neighbour; for the modulus 1 both signs of s are tried.
        pairs = product((1, -1), (0, -1, 1)) if modulus == 1 else [(1, 0), (1, -1)]
        for sign, shift in pairs:
            yield family.along(N * (sign * modulus) + first + modulus * shift, INTEGERS)


def _roots_as_sum(equation: FunctionPoly, numbers: Classes, constant: ParameterPoint) -> SumOfRoots | None:
    """The roots as a mean +- the square roots of one, two or three squares, for an equation of degree 2, 4 or 8."""
    if equation.degree not in (2, 4, 8):
        return None
    field = equation.field
    with_constant = everywhere(field, constant).at(equation)  # over Q(t)(alpha), in which more elements are squares
    mean = -with_constant[equation.degree - 1] / (with_constant.lc * equation.degree)
    squares = squares_of_roots(with_constant(mean.field.poly([0, 1]) + mean) / with_constant.lc)
    if squares is None:
        return None
    if constant.names:
        mean = with_free_generator(mean, field)
        squares = [with_free_generator(square, field) for square in squares]
    whole = floor(laurent_constant_term(mean) / numbers.modulus) * numbers.modulus
    return SumOfRoots(over_parameters(mean) - whole, tuple(squares), numbers)


def squares_of_roots(shifted: Poly) -> list[Poly] | None:
    """The squares of numbers whose sums with all signs are the roots of a monic even polynomial of degree 2, 4 or 8."""
    k = shifted.degree
    if any(shifted[i] for i in range(1, k, 2)):
        return None
    if k == 2:
        return [-shifted[0]]
    if k == 4:  # sums of sqrt(a) and sqrt(b): z^2 - 2 (a + b) z + (a - b)^2 with z = N^2
        total, difference = -shifted[2] / 2, shifted.field.sqrt(shifted[0])
        return None if difference is None else [(total + difference) / 2, (total - difference) / 2]
    # ((z - s1)^2 - 4 s2)^2 - 64 s3 z, s_i the elementary symmetric functions of three squares.
    s1 = -shifted[6] / 4
    s2 = (6 * s1 * s1 - shifted[4]) / 8
    s3 = (16 * s1 * s2 - 4 * s1**3 - shifted[2]) / 64
    squares = roots(shifted.field.poly([-s3, s2, -s1, 1]))
    return squares if len(squares) == 3 and shifted[0] == (s1 * s1 - 4 * s2) ** 2 else None


# ------------------------------------------------------------------------------- equations for a natural number


def natural_root(equations: Sequence[FunctionPoly], letter: str, setting: Setting) -> AnyOf:
    """The claim that a natural number d solves one of the equations, each solved for a parameter if possible; strata last."""
    parts = list[Claim]()
    where: dict[FunctionPoly, list[FunctionPoly]] = {}
    for equation in equations:
        solved = _spectrum(equation, NATURALS, letter, setting)
        parts.append(solved.claim)
        for zero, rest in solved.strata:
            possible_there = (one for one in irreducible_factors(rest) if one.degree > 0 and may_be_natural(one))
            where.setdefault(zero, []).extend(possible_there)
    parts += [AllOf((natural_root(rests, letter, setting), IsZero(zero))) for zero, rests in where.items() if rests]
    return AnyOf(tuple(parts))


def may_be_natural(factor: Poly) -> bool:
    """True if an irreducible polynomial over Q(t) may have a natural root for some values of the parameters."""
    numbers = without_parameters(factor)
    return numbers is None or any(map(NATURALS.contains, rational_roots(numbers)))


#: Names for integers, of which the first that isn't a parameter is used.
INTEGER_LETTERS = "nNmMkKjJ"


@dataclass(frozen=True)
class Congruence(Statement):
    """`equation`, a polynomial in N over Q(t), has a rational root N congruent to one of `residues` modulo `modulus`.

    The numbers are integers but for degree 1.
    """

    equation: FunctionPoly
    residues: tuple[Fraction, ...]
    modulus: Fraction
    setting: Setting = field(default=Setting(), compare=False)

    @classmethod
    def make(cls, equation: FunctionPoly, residues: Iterable[Fraction | int], modulus: Fraction | int) -> Congruence:
        """The congruence normalised by N -> a N + b, with the least modulus.

        A form gets no constant term (in a Laurent series at 0) and coprime coefficients; for higher degrees the constant term
        of the mean of the roots comes into (-1, 0], and the classes are symmetric about it if the equation is.  Equations that
        differ by N -> +-N + b with an integer b become the same.
        """
        classes = {*map(Fraction, residues)}
        m = Fraction(modulus)
        k = equation.degree
        if k == 1:
            form, scale, offset = scaled_form(-equation[0] / equation[1])  # the root N = form/scale + offset
            scaled = {(residue - offset) * scale for residue in classes}
            return cls._with_least_modulus(form.field.poly([0, 1]) - form, scaled, abs(m * scale))
        Z = equation.field.poly([0, 1])
        mean = laurent_constant_term(-equation[k - 1] / (k * equation.lc))
        forms: list[tuple[Fraction, str, FunctionPoly, set[Fraction]]] = []
        for sign in (1, -1):  # Z = sign N - shift brings the mean into (-1, 0], as far from 0 as possible
            shift = ceil(sign * mean)
            moved = over_parameters(equation((Z + shift) * sign) * sign**k)
            forms.append((shift - sign * mean, str(moved), moved, {sign * residue - shift for residue in classes}))
        distance, _, moved, moved_classes = max(forms, key=lambda form: form[:2])
        twice = -2 * distance
        is_symmetric = twice.denominator == 1 and moved(twice - Z) == (-1) ** k * moved
        if is_symmetric:
            moved_classes |= {twice - residue for residue in moved_classes}
        return cls._with_least_modulus(moved, moved_classes, m)

    @classmethod
    def _with_least_modulus(cls, equation: FunctionPoly, classes: Iterable[Fraction], modulus: Fraction) -> Congruence:
        """With k classes modulo m as one modulo m/k if possible, m/k an integer if the numbers are integers."""
        known = {residue % modulus for residue in classes}
        for k in range(len(known), 1, -1):
            if equation.degree != 1 and modulus % k != 0:
                continue
            fewer = {residue % (modulus / k) for residue in known}
            if len(fewer) * k == len(known):
                return cls(equation, tuple(sorted(fewer)), modulus / k)
        return cls(equation, tuple(sorted(known)), modulus)

    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        return (self.equation,)

    @property
    def form(self) -> FunctionPoly | None:
        """The form that is congruent to one of the numbers; None for an equation of higher degree."""
        return -self.equation[0] if self.equation.degree == 1 else None

    @property
    def numbers(self) -> Classes:
        """The numbers of which N has to be one."""
        return Classes(self.residues, self.modulus)

    def _holds(self, point: ParameterPoint) -> bool:
        return self.holds_for(point.at(self.equation)) is True

    def holds_for(self, equation: Poly) -> bool | None:
        """True if the equation has one of the numbers as a root, False if not; None if it contains parameters."""
        numbers = without_parameters(equation)
        return None if numbers is None else any(map(self.numbers.contains, rational_roots(numbers)))

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return integer_roots(change(self.equation), self.residues, self.modulus)

    def sample(self, random: Random) -> list[FunctionPoly]:
        N = random.choice(self.residues) + random.randint(-4, 4) * self.modulus
        return [over_parameters(self.equation(N))]

    def merged(self, other: Statement) -> Congruence | None:
        if not isinstance(other, Congruence) or other.equation != self.equation:
            return None
        common = common_multiple(self.modulus, other.modulus)
        made = Congruence.make(self.equation, self.numbers.modulo(common) + other.numbers.modulo(common), common)
        return replace(made, setting=self.setting)

    def _truth(self, assumptions: Assumptions) -> bool | None:
        if self.form is not None:
            return assumptions.meets_classes(self.form, self.numbers)
        value = assumptions.value_of(self.equation)
        if value is not None:
            return self.holds_for(value)
        # f(0) is irrational, and f(n) - f(0) rational.
        start = self.equation[0]
        is_irrational = assumptions.is_irrational(start) and without_parameters(self.equation - start) is not None
        return False if is_irrational else None

    def under(self, assumptions: Assumptions) -> Statement:
        """The statement as values of an integer parameter t, if it occurs in a (a t + b)/(c t + d), c != 0."""
        known = reduced_statement(self, self._truth(assumptions))
        if self.form is None or known is not self:
            return known
        largest = lcm(self.modulus.denominator, *(residue.denominator for residue in self.residues))
        values = at_integers(self.form, largest, assumptions)
        return self if values is None else either(*(here for here, value in values if self.numbers.contains(value)))

    def avoiding(self, setting: Setting) -> Statement:
        return replace(self, setting=setting)

    @property
    def letter(self) -> str:
        return free_letter(self.setting.names)

    @cached_property
    def claim(self) -> Claim:
        if self.form is None:
            return self._solved(self.equation, self.numbers)
        if len(self.residues) == 1:
            return self._one_class(self.form)
        return InClasses(self.form, self.numbers)

    def _solved(self, equation: FunctionPoly, numbers: Classes) -> Claim:
        """The claim for an equation for an integer, with that for strata on which the solved parameter is free."""
        found = integer_condition(equation, numbers, self.letter, self.setting)
        there = (
            all_of((Vanishes(zero), integer_roots(rest, numbers.residues, numbers.modulus)))
            for zero, rest in found.strata
        )
        claims = [found.claim, *(one.avoiding(self.setting).claim for one in there if one != NEVER)]
        claim = claims[0] if len(claims) == 1 else AnyOf(tuple(claims))
        if not isinstance(found.claim, IntegerFamily):
            return claim
        # Solving for a parameter cleared the denominators, whose zeros are excluded unless earlier regions contain them.
        below = irreducible_factors(denominator(equation))
        above = numerator(equation)
        zeros = [(factor, zero) for factor in below for zero in irreducible_factors(on_zeros(above, factor))]
        uncovered = dict.fromkeys(factor for factor, zero in zeros if not self.setting.covers(factor, zero))
        return AllOf((claim, *map(IsNonzero, uncovered))) if uncovered else claim

    def _one_class(self, form: FunctionPoly) -> Claim:
        """The claim that a form is congruent to one number."""
        (residue,) = self.residues
        modulus = self.modulus
        below = modulus.denominator
        multiple = form * below
        remainder = residue * below
        if modulus.numerator == 1:
            return InClasses(multiple - remainder, INTEGERS)
        if modulus.numerator == 2 and remainder.denominator == 1:
            return InClasses(multiple, Classes.of([remainder], 2))
        scale = lcm(residue.denominator, below)
        equation = form * scale - form.field.poly([0, 1])
        has_several_parameters = sum(map(bool, degrees(equation))) > 1
        if has_several_parameters and all_solved(equation, self.letter, self.setting):
            return self._solved(equation, Classes.of([residue * scale], modulus * scale))
        return InClasses(form, self.numbers)


def at_integers(form: FunctionPoly, largest: int, assumptions: Assumptions) -> list[tuple[Vanishes, Fraction]] | None:
    """The integers t at which (a t + b)/(c t + d) has a denominator up to the largest, with these values.

    Here t is an integer parameter, and c isn't 0.  The denominator at t is that of c t + d divided by a divisor of a d - b c.
    None for any other form, and if there may be too many values.
    """
    used = [k for k, degree in enumerate(map(int, (form.num * form.den).degrees())) if degree]
    if len(used) != 1:
        return None
    (k,) = used  # variable number k is parameter number k - 1
    t = form.field.generator(form.field.names[k - 1])
    if not assumptions.meets_classes(t, INTEGERS):
        return None
    above, below = ({int(e[k]): int(c) for e, c in part.to_dict().items()} for part in (form.num, form.den))
    if max(below) != 1 or max(above) > 1:
        return None
    a, b, c, d = (part.get(power, 0) for part in (above, below) for power in (1, 0))
    most = largest * abs(a * d - b * c)
    end = (most + abs(d)) // abs(c)
    if end > MOST_TRIALS:
        return None
    values = {n: Fraction(a * n + b, c * n + d) for n in range(-end, end + 1) if c * n + d}
    places = ((Vanishes(t - n), value) for n, value in values.items() if value.denominator <= largest)
    return [(here, value) for here, value in places if here.under(assumptions) != NEVER]


def free_letter(names: Collection[str], preferred: str = INTEGER_LETTERS) -> str:
    """A name for an integer that differs from these names."""
    return next(letter for letter in chain(preferred, map("n{}".format, count())) if letter not in names)


def integer_roots(equation: FunctionPoly, residues: Iterable[Fraction | int], modulus: Fraction | int) -> Statement:
    """The statement that a polynomial in N over Q(t) has a rational root in these classes (integer unless the degree is 1)."""
    classes = {r % modulus for r in residues}
    statements = list[Statement]()
    for factor in polynomial_factors(equation):
        numbers = without_parameters(factor)
        if numbers is None:
            statements.append(Congruence.make(factor, classes, modulus))
        elif any(root % modulus in classes for root in rational_roots(numbers)):
            return ALWAYS
    return either(*statements)


def without_parameters(polynomial: Poly) -> Poly | None:
    """The polynomial over Q, or over its number field; None if a coefficient has parameters."""
    if polynomial.field.ground == QQ:
        return polynomial
    known = [value for value in map(rational_number, polynomial) if value is not None]
    return QQ.poly(known) if len(known) == polynomial.degree + 1 else None
