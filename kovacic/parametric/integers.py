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

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, reduce
from itertools import product
from math import ceil, floor, lcm
from operator import mul
from random import Random
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import ENERGY
from kovacic.limits import MOST_TRIALS
from kovacic.parametric import prose
from kovacic.parametric.assumptions import Assumptions, linear_of
from kovacic.parametric.claims import (
    EVEN,
    INTEGERS,
    NATURALS,
    ODD,
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
    degrees,
    denominator,
    irreducible_factors,
    laurent_constant_term,
    numerator,
    on_zeros,
    over_parameters,
    polynomial_factors,
    powers_of,
    roots,
    scaled_form,
    with_free_generator,
    without_parameters,
)
from kovacic.parametric.formulas import shortest_form
from kovacic.parametric.restriction import everywhere, with_free_constant
from kovacic.parametric.statements import ALWAYS, NEVER, Setting, Statement, Vanishes, all_of, either, reduced_statement
from kovacic.writing.formula import free_name, text_of_words


class Stratum(NamedTuple):
    """Where `zero`, a function of the parameters, vanishes, the condition is `rest`(n) = 0, and one parameter is free."""

    zero: FunctionPoly
    rest: FunctionPoly


#: A claim, and the strata on which it has to be stated of another equation.
IntegerCondition = tuple[Claim, Sequence[Stratum]]
#: f(n; t) = 0 for a parameter t: it is a function of n, or free at one of the family's poles or on one of the strata.
SolvedForParameter = tuple[IntegerFamily, Sequence[Stratum]]


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
    return IntegerFamily(letter, name, value, INTEGERS, tuple(poles)), strata


def all_solved(equation: FunctionPoly, letter: str, setting: Setting) -> list[SolvedForParameter]:
    """The equation solved for each parameter for which that is possible, except for the fixed ones."""
    names = (name for name in equation.field.names if name not in setting.fixed)
    return [*filter(None, (solve_for(name, equation, letter, setting) for name in names))]


# ------------------------------------------------------------------------------- an equation for an integer


def integer_condition(equation: FunctionPoly, numbers: Classes, letter: str, setting: Setting) -> IntegerCondition:
    """The condition that one of the numbers is a root of a polynomial in N over Q(t): a spectrum, square roots, or both."""
    spectrum, strata = _spectrum(equation, numbers, letter, setting)
    sums = _roots_as_sum(equation, numbers, setting.assumptions.constant)
    if sums is None or (isinstance(spectrum, IntegerFamily) and (len(sums.squares) < 2 or not strata)):
        return spectrum, strata
    return sums, ()


def _spectrum(equation: FunctionPoly, numbers: Classes, letter: str, setting: Setting) -> IntegerCondition:
    """A parameter as a function of n, in the shortest form; the equation itself if no parameter is linear."""
    known = all_solved(equation, letter, setting)
    energies = [solved for solved in known if solved[0].parameter == ENERGY]
    found: list[tuple[int, bool, IntegerCondition]] = []
    for k, (solved, strata) in enumerate(energies or known):
        for family in _integer_choices(equation, solved, numbers):
            text = shortest_form(family.value, family.letter)
            condition = text_of_words(prose.phrase(prose.numbers_of(family)))
            # Weights chosen by eye: a formula counts more than words, and both less than a later parameter or a stratum.
            cost = 10 * k + 20 * len(strata) + 3 * len(text) + 2 * len(condition)
            # Of n and -n the one with f(1) = 1, if there is one: n + k*n*(n - 1)/2, as Yoshida and Morales & Ramis write it.
            above, below = (part(Fraction(1)) for part in (family.value.num, family.value.den))
            is_numbered_otherwise = not below or above != below
            found.append((cost, is_numbered_otherwise, (family, strata)))
    return min(found, key=lambda one: one[:2])[2] if found else (EquationFor(letter, equation, numbers), ())


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
    mean = with_constant.mean_of_zeros
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
        claim, strata = _spectrum(equation, NATURALS, letter, setting)
        parts.append(claim)
        for zero, rest in strata:
            possible_there = (one for one in irreducible_factors(rest) if one.degree > 0 and may_be_natural(one))
            where.setdefault(zero, []).extend(possible_there)
    parts += [AllOf((natural_root(rests, letter, setting), IsZero(zero))) for zero, rests in where.items() if rests]
    return AnyOf(tuple(parts))


def may_be_natural(factor: Poly) -> bool:
    """True if an irreducible polynomial over Q(t) may have a natural root for some values of the parameters."""
    return NATURALS.has_root_of(factor) is not False


#: Names for integers, of which the first that isn't a parameter is used.
INTEGER_LETTERS = "nNmMkKjJ"


@dataclass(frozen=True)
class Congruence(Statement):
    """`equation`, a polynomial in N over Q(t), has a rational root N that is one of the `numbers`.

    These are integers but for degree 1.
    """

    equation: FunctionPoly
    numbers: Classes
    setting: Setting = field(default=Setting(), compare=False)

    @classmethod
    def make(cls, equation: FunctionPoly, numbers: Classes) -> Statement:
        """The congruence normalised by N -> a N + b; ALWAYS or NEVER for an equation without parameters.

        A form gets no constant term (in a Laurent series at 0) and coprime coefficients; for higher degrees the constant term
        of the mean of the roots comes into (-1, 0], and the classes are symmetric about it if the equation is.  Equations that
        differ by N -> +-N + b with an integer b become the same.
        """
        truth = numbers.has_root_of(equation)
        if truth is not None:
            return ALWAYS if truth else NEVER
        k = equation.degree
        N = equation.field.poly([0, 1])
        if k == 1:
            form, scale, offset = scaled_form(-equation[0] / equation[1])  # the root N = form/scale + offset
            return cls(N - form, numbers.moved(scale, -offset * scale))
        mean = laurent_constant_term(-equation[k - 1] / (k * equation.lc))
        forms: list[tuple[Fraction, str, FunctionPoly, Classes]] = []
        for sign in (1, -1):  # sign N - shift brings the mean into (-1, 0], as far from 0 as possible
            shift = ceil(sign * mean)
            moved = over_parameters(equation((N + shift) * sign) * sign**k)
            forms.append((shift - sign * mean, str(moved), moved, numbers.moved(sign, -shift)))
        distance, _, moved, classes = max(forms, key=lambda form: form[:2])
        twice = -2 * distance
        if twice.denominator == 1 and moved(twice - N) == (-1) ** k * moved:
            classes = classes.joined(classes.moved(-1, twice))
        return cls(moved, classes)

    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        return (self.equation,)

    @property
    def form(self) -> FunctionPoly | None:
        """The form that is congruent to one of the numbers; None for an equation of higher degree."""
        return -self.equation[0] if self.equation.degree == 1 else None

    def _holds(self, point: ParameterPoint) -> bool:
        return self.numbers.has_root_of(point.at(self.equation)) is True

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return integer_roots(change(self.equation), self.numbers)

    def sample(self, random: Random) -> list[FunctionPoly]:
        N = random.choice(self.numbers.residues) + random.randint(-4, 4) * self.numbers.modulus
        return [over_parameters(self.equation(N))]

    def merged(self, other: Statement) -> Statement | None:
        if not isinstance(other, Congruence) or other.equation != self.equation:
            return None
        return Congruence.make(self.equation, self.numbers.joined(other.numbers)).avoiding(self.setting)

    def _truth(self, assumptions: Assumptions) -> bool | None:
        if self.form is not None:
            return assumptions.meets_classes(self.form, self.numbers)
        value = assumptions.value_of(self.equation)
        if value is not None:
            return self.numbers.has_root_of(value)
        # f(0) is irrational, and f(n) - f(0) rational.
        start = self.equation[0]
        is_irrational = assumptions.is_irrational(start) and without_parameters(self.equation - start) is not None
        return False if is_irrational else None

    def under(self, assumptions: Assumptions) -> Statement:
        """The statement as values of an integer parameter t, if it occurs in a (a t + b)/(c t + d), c != 0."""
        known = reduced_statement(self, self._truth(assumptions))
        if self.form is None or known is not self:
            return known
        largest = lcm(*(number.denominator for number in (self.numbers.modulus, *self.numbers.residues)))
        values = at_integers(self.form, largest, assumptions)
        return self if values is None else either(*(here for here, value in values if self.numbers.contains(value)))

    def avoiding(self, setting: Setting) -> Statement:
        return replace(self, setting=setting)

    @property
    def letter(self) -> str:
        return free_name(self.setting.names, *INTEGER_LETTERS)

    @cached_property
    def claim(self) -> Claim:
        if self.form is None:
            return self._solved(self.equation, self.numbers)
        if len(self.numbers.residues) == 1:
            return self._one_class(self.form)
        return InClasses(self.form, self.numbers)

    def _solved(self, equation: FunctionPoly, numbers: Classes) -> Claim:
        """The claim for an equation for an integer, with that for strata on which the solved parameter is free."""
        claim, strata = integer_condition(equation, numbers, self.letter, self.setting)
        is_solved = isinstance(claim, IntegerFamily)
        there = (all_of((Vanishes(zero), integer_roots(rest, numbers))) for zero, rest in strata)
        elsewhere = [one.avoiding(self.setting).claim for one in there if one != NEVER]
        claim = AnyOf((claim, *elsewhere)) if elsewhere else claim
        if not is_solved:
            return claim
        # Solving for a parameter cleared the denominators, whose zeros are excluded unless earlier regions contain them.
        below = irreducible_factors(denominator(equation))
        above = numerator(equation)
        zeros = [(factor, zero) for factor in below for zero in irreducible_factors(on_zeros(above, factor))]
        uncovered = dict.fromkeys(factor for factor, zero in zeros if not self.setting.covers(factor, zero))
        return AllOf((claim, *map(IsNonzero, uncovered))) if uncovered else claim

    def _one_class(self, form: FunctionPoly) -> Claim:
        """The claim that a form is congruent to one number."""
        (residue,) = self.numbers.residues
        below = self.numbers.modulus.denominator
        whole = self.numbers.moved(below, 0)
        if whole.modulus == 1:
            return InClasses((form - residue) * below, INTEGERS)
        if whole in (EVEN, ODD):
            return InClasses(form * below, whole)
        scale = lcm(residue.denominator, below)
        equation = form * scale - form.field.poly([0, 1])
        has_several_parameters = sum(map(bool, degrees(equation))) > 1
        if has_several_parameters and all_solved(equation, self.letter, self.setting):
            return self._solved(equation, self.numbers.moved(scale, 0))
        return InClasses(form, self.numbers)


def at_integers(form: FunctionPoly, largest: int, assumptions: Assumptions) -> list[tuple[Vanishes, Fraction]] | None:
    """The integers t at which (a t + b)/(c t + d) has a denominator up to the largest, with these values.

    Here t is an integer parameter, and c isn't 0.  The denominator at t is that of c t + d divided by a divisor of a d - b c.
    None for any other form, and if there may be too many values.
    """
    above, below = linear_of(numerator(form)), linear_of(denominator(form))
    if above is None or below is None or below.parameter is None or not above.factors.keys() <= below.factors.keys():
        return None
    t = form.field.generator(below.parameter)
    a, b, c, d = (
        number for part in (above, below) for number in (part.factors.get(below.parameter, Fraction(0)), part.constant)
    )
    end = int((largest * abs(a * d - b * c) + abs(d)) / abs(c))
    if end > MOST_TRIALS or not assumptions.meets_classes(t, INTEGERS):
        return None
    values = ((Vanishes(t - n), (a * n + b) / (c * n + d)) for n in range(-end, end + 1) if c * n + d)
    return [(n, value) for n, value in values if value.denominator <= largest and n.under(assumptions) != NEVER]


def integer_roots(equation: Poly, numbers: Classes) -> Statement:
    """The statement that a polynomial in N over Q(t) has one of the numbers as a root, integers unless its degree is 1."""
    return either(*(Congruence.make(factor, numbers) for factor in polynomial_factors(equation)))
