"""Solutions for all parameters of a region at once, as SymPy expressions in the user's equation and variable.

They contain a Jacobi or Laguerre polynomial whose degree has to be a natural number, or a polynomial of given degree whose
coefficients are functions of the parameters.  Square roots of parameters are SymPy's: one value is meant, and the conditions
tell for which of the two signs y is a solution.

Rows are solutions in the integer of a condition: for L = n (5 n + 3)/2, the formulas for n = 0, 2, 4, ... differ from those for
n = 1, 3, 5, ...  A formula with a choice of signs needs a natural number d.  With the parameter f(n), the square roots are
functions of n, so that d is a n + b with numbers a and b for some choices of the signs, and each of these is the solution for a
progression.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, reduce
from itertools import product
from math import lcm
from typing import Any, NamedTuple

import sympy

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.recurrence import descended
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.product import product as product_of_powers
from kovacic.closed_form.structure import Diagonal, build
from kovacic.closed_form.way_back import solution_in_x, with_roots_of_factors
from kovacic.engine.decide import decide
from kovacic.engine.places import Problem
from kovacic.equation import Equation
from kovacic.limits import Budget
from kovacic.numbers.exact import has_long_numbers
from kovacic.numbers.numerals import as_text
from kovacic.parametric import prose
from kovacic.parametric.claims import (
    AllOf,
    AnyOf,
    Claim,
    IntegerFamily,
    IsNonzero,
    element,
    irreducible_factors,
    over_parameters,
    rational_number,
)
from kovacic.parametric.exponents import ChosenExponents, exponent_choices
from kovacic.parametric.formulas import shorter_sum, with_gathered_powers
from kovacic.parametric.prose import Words
from kovacic.parametric.restriction import Letters
from kovacic.reading.change_of_variable import is_in_power, user_variable
from kovacic.reading.read import read_input
from kovacic.writing.formula import caret, free_name, text_of_words


class jacobi(sympy.Function):  # type: ignore[misc]  # noqa: N801
    """Jacobi's polynomial P_n^(a, b)(z), for all a and b: a sum of n + 1 terms where n is a natural number.

    P_n^(a, b)(z) = sum over s of binomial(n + a, n - s) binomial(n + b, s) ((z - 1)/2)^s ((z + 1)/2)^(n - s)  [DLMF 18.5.8].
    SymPy's function of this name becomes 0, nan or an error where a or b is a negative integer or a + b = 0.  The polynomial
    vanishes identically where a and b are negative integers with -n <= a, b and a + b < -n, and nowhere else.

    >>> x = sympy.Symbol("x")
    >>> sympy.expand(jacobi(2, -1, 0, x))
    3*x**2/4 - x/2 - 1/4
    """

    @classmethod
    def eval(cls, n: Any, a: Any, b: Any, z: Any) -> Any:
        """The sum where n is natural; -1 is that of the derivative of a constant."""
        if not n.is_Integer or n < -1:
            return None
        terms = []
        for s in range(int(n) + 1):
            binomials = sympy.ff(n + a, n - s) * sympy.ff(n + b, s) / (sympy.factorial(n - s) * sympy.factorial(s))
            terms.append(binomials * ((z - 1) / 2) ** s * ((z + 1) / 2) ** (n - s))
        return sympy.Add(*terms)

    def fdiff(self, argindex: int = 4) -> Any:
        """The derivative with respect to z [DLMF 18.9.15]."""
        n, a, b, z = self.args
        if argindex != 4:
            raise sympy.core.function.ArgumentIndexError(self, argindex)
        return (n + a + b + 1) / 2 * jacobi(n - 1, a + 1, b + 1, z)

    def _latex(self, printer: Any, exp: str | None = None) -> str:
        n, a, b, z = map(printer.doprint, self.args)
        power = "" if exp is None else f"^{{{exp}}}"
        return rf"P_{{{n}}}^{{\left({a}, {b}\right)}}\left({z}\right){power}"


#: Derivatives of orthogonal polynomials by others of natural degree, also for n = 0, where SymPy's derivatives have no value
#: [DLMF 18.9.24, 18.9.25 and 18.9.1].
_DERIVATIVES_BY_NATURAL_DEGREE: dict[Any, Callable[..., Any]] = {
    sympy.assoc_laguerre: lambda n, a, z: (
        (n + 1) / z * sympy.assoc_laguerre(n + 1, a - 1, z) + (1 - a / z) * sympy.assoc_laguerre(n, a, z)
    ),
    sympy.hermite: lambda n, z: 2 * z * sympy.hermite(n, z) - sympy.hermite(n + 1, z),
}


def derivative(y: Any, x: Any) -> Any:
    """The derivative of a solution, with polynomials whose degrees are natural if that of the solution is."""
    letters = {polynomial: sympy.Dummy() for polynomial in y.atoms(*_DERIVATIVES_BY_NATURAL_DEGREE)}
    plain = y.xreplace(letters)
    terms = [plain.diff(x)]
    for polynomial, letter in letters.items():
        *_, z = polynomial.args
        by_z = _DERIVATIVES_BY_NATURAL_DEGREE[polynomial.func](*polynomial.args)
        terms.append(plain.diff(letter) * by_z * z.diff(x))
    return sympy.Add(*terms).xreplace({letter: polynomial for polynomial, letter in letters.items()})


@dataclass(frozen=True)
class PolynomialSolution:
    """y solves the equation where `degree` is a natural number and all of the `conditions` vanish.

    All are SymPy expressions in the variable and the parameters; `where` gives the conditions in words.  `jacobi` are the two
    parameters of a Jacobi polynomial in y, which vanishes identically for some negative integers; there, another solution of
    the region doesn't.
    """

    y: Any
    degree: Any
    conditions: tuple[Any, ...] = ()
    where: str = ""
    jacobi: tuple[Any, ...] = ()

    def at(self, values: Mapping[Any, Any]) -> Any:
        """y at values of the parameters, by symbol; None if it is no solution there, or vanishes identically."""
        degree = natural_value(self.degree.xreplace(values))
        if degree is None or any(condition.xreplace(values) != 0 for condition in self.conditions):
            return None
        y = self.y.xreplace({self.degree: degree}).xreplace(values)
        return None if y == 0 else y

    def with_values(self, values: Mapping[Any, Any]) -> PolynomialSolution:
        """The solution with parameters replaced by other expressions, by symbol."""
        conditions = tuple(condition.xreplace(values) for condition in self.conditions)
        parameters = tuple(parameter.xreplace(values) for parameter in self.jacobi)
        y, degree = self.y.xreplace(values), self.degree.xreplace(values)
        return replace(self, y=y, degree=degree, conditions=conditions, jacobi=parameters)

    def __str__(self) -> str:
        """`y = x*exp(x^2/2)*assoc_laguerre(n, 1/2, -x^2) where n is a natural number`."""
        degree = caret(as_text(self.degree))
        letter = free_name({symbol.name for symbol in self.y.free_symbols}, *"dDNM")
        exclusion = self.exclusion(letter)
        if exclusion and not self.degree.is_Symbol:
            degree = f"{letter} = {degree}"
        where = self.where or f"{degree} is a natural number{text_of_words(exclusion)}"
        return f"y = {caret(as_text(self.y))} where {where}"

    def exclusion(self, d: str) -> Words:
        """The values at which y vanishes identically for the degree d; () if it never does."""
        if not self.jacobi:
            return ()
        first, second = self.jacobi
        # These are natural there: a sum of negative integers is at most -2.
        needed = (-first - 1, -second - 1, sympy.expand(-first - second - 2))
        if any(number.is_number and natural_value(number) is None for number in needed):
            return ()
        name = str(self.degree) if self.degree.is_Symbol else d
        if first.is_number and second.is_number:
            least, most = max(-first, -second), -first - second - 1
            return prose.phrase(
                f", unless `{name} = {least}`" if least == most else f", unless `{least} <= {name} <= {most}`"
            )
        a, b = (caret(as_text(parameter)) for parameter in self.jacobi)
        if a == b:
            return prose.phrase(f", unless `{a}` is an integer with `-{name} <= {a} < -{name}/2`")
        return prose.phrase(f", unless `{a}` and `{b}` are integers from `-{name}` to -1 with a sum below `-{name}`")


def natural_value(number: Any) -> Any:
    """The constant if it is a natural number, also as a sum of roots, sqrt(3 + 2*sqrt(2)) - sqrt(2); None for any other."""
    if number.is_number and number.is_finite and not number.is_Rational:
        S = read_input(number, var="x_").S
        exact = rational_number(S.num[0] / S.den[0])
        number = number if exact is None else sympy.Rational(exact)
    return number if number.is_Integer and number >= 0 else None


#: Solutions for a degree d, or for None if no degree has to be chosen.
SolutionsByDegree = Callable[[int | None], tuple[PolynomialSolution, ...]]


@dataclass(frozen=True)
class Later:
    """An origin that is found on demand; None if there is none."""

    find: Callable[[], SolutionsByDegree | None]


#: The solution for signs, which are numbers +-1 or symbols.
BySigns = Callable[[Sequence[Any]], PolynomialSolution]


@dataclass(frozen=True)
class Signed:
    """Solutions for each choice of signs; `formula()` is None if there are none in radicals."""

    formula: Callable[[], BySigns | None]
    signs: int

    def __call__(self, number: int | None) -> tuple[PolynomialSolution, ...]:
        by_signs = self.formula()
        if by_signs is None:
            return ()
        found = map(by_signs, product((1, -1), repeat=self.signs))
        possible = (one for one in found if one.degree.free_symbols or natural_value(one.degree) is not None)
        return tuple(dict.fromkeys(possible))

    def general(self, signs: Sequence[Any]) -> PolynomialSolution | None:
        """All solutions as one formula, with symbols for the signs."""
        by_signs = self.formula()
        return None if by_signs is None else by_signs(signs[: self.signs])


@dataclass(frozen=True)
class Carried:
    """The solutions of another equation, transformed into those of this one on each piece of a region.

    `letters` are parameters with the expressions that they stand for.
    """

    origin: SolutionsByDegree
    changes: tuple[Callable[[PolynomialSolution], PolynomialSolution], ...]
    letters: Letters = ()

    def __call__(self, number: int | None) -> tuple[PolynomialSolution, ...]:
        return tuple(self.of(self.found(number)))

    def found(self, number: int | None) -> tuple[PolynomialSolution, ...]:
        """The solutions of the other equation."""
        return _found(self.origin, number)

    def of(self, solutions: Iterable[PolynomialSolution]) -> Iterator[PolynomialSolution]:
        """Solutions of this equation from those of the other one, on each piece, in the user's parameters."""
        meanings = {sympy.Symbol(name): meaning for name, meaning in self.letters}
        for solution, change in product(solutions, self.changes):
            yield change(solution).with_values(meanings)

    def general(self, signs: Sequence[Any]) -> PolynomialSolution | None:
        """All solutions as one formula, with symbols for the signs; None if there is no such formula."""
        found = general_formula(self.origin, signs)
        return None if found is None or len(self.changes) > 1 else next(self.of([found]))


@lru_cache(maxsize=64)
def _found(origin: SolutionsByDegree, number: int | None) -> tuple[PolynomialSolution, ...]:
    """The solutions of an origin, computed once for the check and for each view."""
    return origin(number)


@lru_cache(maxsize=256)
def given(equation: Equation, zeros: tuple[FunctionPoly, ...], solution: PolynomialSolution) -> PolynomialSolution:
    """A solution of the normal form as one of the equation, on the piece of a region where functions vanish.

    For t = x^m the roots in its degree and its conditions are those in the translated y.
    """
    y = translated_solution(solution.y, equation)
    degree = solution.degree
    conditions = solution.conditions
    if is_in_power(equation):
        x = user_variable(equation)
        degree = with_roots_of_factors(degree, x)
        conditions = tuple(with_roots_of_factors(condition, x) for condition in conditions)
    x = sympy.Symbol(equation.variable)
    conditions = (*conditions, *(zero.to_sympy(x) for zero in zeros))
    where = ", ".join(filter(None, [solution.where, *(prose.equation_of_zeros(zero).text for zero in zeros)]))
    return replace(solution, y=y, degree=degree, conditions=conditions, where=where)


def translated_solution(y: Any, equation: Equation) -> Any:
    """A solution of the normal form times the gauge factor, and in the user's variable."""
    variable = sympy.Symbol(equation.variable)
    if equation.gauge:
        y = y * display(product_of_powers(equation.gauge), Atoms(variable))
    y = solution_in_x(equation, with_gathered_powers(y, variable))
    return y.as_independent(user_variable(equation), as_Add=False)[1]  # without its constant factor


def general_formula(origin: SolutionsByDegree | None, signs: Sequence[Any]) -> PolynomialSolution | None:
    """The formula with symbols for the signs, or None."""
    together = getattr(origin, "general", None)
    return None if together is None else together(signs)


def weight_by_signs(problem: Problem, variable: str) -> Signed | None:
    """exp(int theta), whose product with a P of the `degree` is a solution; the signs choose the exponents.

    None if the exponents need too large an extension, or other roots than square roots.
    """
    choices = exponent_choices(problem)
    if choices is None or not has_radicals(choices.field):
        return None
    x = sympy.Symbol(variable)

    def by_signs(signs: Sequence[Any]) -> PolynomialSolution:
        y = degree = sympy.Integer(1)
        left = iter(signs)
        for first, *others in choices.parts:
            # The first exponent belongs to the sign 1, the other one, if there is one, to -1.
            sign = next(left) if others else 1
            e, other = (part.exponent.to_sympy(x) for part in (first, *others, first)[:2])
            exponent = sympy.factor((e + other) / 2) + sign * sympy.factor((e - other) / 2)
            y *= _local_factor(first.factor, exponent, sign * first.main.to_sympy(x), x)
            degree -= exponent
        return PolynomialSolution(y, sympy.expand(degree))

    return Signed(lambda: by_signs, sum(len(parts) > 1 for parts in choices.parts))


def solution_of_degree(
    exponents: ChosenExponents, d: int, variable: str, given: FunctionPoly
) -> PolynomialSolution | None:
    """exp(int theta) P for one choice of exponents, where `given` vanishes and P exists.

    None if the degree doesn't determine P, if P exists for no values, and if a root isn't a radical.
    """
    if not has_radicals(exponents.field):
        return None
    found = descended(*exponents.operator, d)
    if found is None or found.free is not None:
        return None
    alternatives = [*map(_vanishing_factors, filter(None, found.rest))]
    if [] in alternatives:  # it exists nowhere
        return None
    x = sympy.Symbol(variable)
    y = found.P.to_sympy(x)
    for part in exponents.parts:
        exponent = sympy.factor(part.exponent.to_sympy(x))
        y *= _local_factor(part.factor, exponent, part.main.to_sympy(x), x)
    conditions = [given.to_sympy(x)] if given else []
    where = dict.fromkeys([prose.equation_of_zeros(given).text] if given else [])
    for factors in alternatives:
        conditions.append(sympy.Mul(*(factor.to_sympy(x) for factor in factors)))
        where[" or ".join(f"{caret(as_text(factor.to_sympy(x)))} = 0" for factor in factors)] = None
    return PolynomialSolution(y, sympy.Integer(d), tuple(conditions), ", ".join(where))


def solutions_there(S: RatFunc, variable: str, _: int | None = None) -> tuple[PolynomialSolution, ...]:
    """The solutions with a rational omega that the engine finds; `degree` is that of the P in the first one.

    () if the constants in it are no square roots, or have long numbers, or the exponents at conjugate points differ.
    """
    decision = decide(S, Budget())
    riccati = decision.riccati
    if riccati is None:
        return ()
    omega = -riccati.coefficients[0]
    atoms = Atoms(sympy.Symbol(variable))
    if isinstance(S.field, AlgebraicField):  # the field of a hypersurface, whose generator is a parameter
        atoms.call(S.field, sympy.Symbol(S.field.name))
    y = product_of_powers(omega)
    if y.roots:
        return ()
    found = [y]
    if omega.field == S.field:
        structure = build(S, decision, 0 * S)
        if isinstance(structure, Diagonal):
            found += [one for one in (structure.first, structure.second) if one.logarithmic_derivative != omega]
    else:  # an extension by a square root is written, unless its number is long
        assert isinstance(omega.field, AlgebraicField)
        is_quadratic = omega.field.base == S.field and omega.field.dimension == 2
        if not is_quadratic or has_long_numbers(atoms.generator(omega.field)):
            return ()
    degree = sympy.Integer(max(riccati.P.degree, 0))
    where = "the region's statement holds"
    return tuple(PolynomialSolution(display(one, atoms), degree, (), where) for one in found)


def _local_factor(u: Poly | None, exponent: Any, main: Any, x: Any) -> Any:
    """exp(int theta) for the part of theta at one point."""
    integral = sympy.integrate(sympy.expand(main), x)
    if u is None:
        return sympy.exp(integral)
    base = u.to_sympy(x)
    return base**exponent * sympy.exp(integral.subs(x, 1 / base))


def has_radicals(field: Field) -> bool:
    """True if all extensions are square roots, or the parameter that is algebraic on a hypersurface."""
    while isinstance(field, AlgebraicField):
        if field.name == "point":
            return False
        field = field.base
    return True


def _vanishing_factors(value: Poly) -> list[Poly]:
    """Functions of which one has to vanish so that a constant other than 0 does; [] for a number.

    Over an extension these are the common factors of the coordinates, and the rest.
    """
    if value.field.ground == QQ:
        return []
    leaves = [over_parameters(leaf) for leaf in value.leaves() if leaf]
    field = leaves[0].field
    content = element(field, reduce(lambda a, b: a.gcd(b), (leaf.num for leaf in leaves)))
    denominator = reduce(lambda m, leaf: m * (leaf.den // m.gcd(leaf.den)), leaves, field.context.constant(1))
    factors: list[Poly] = [*irreducible_factors(content)]
    is_product_of_roots = len(leaves) == 1
    return factors if is_product_of_roots else [*factors, value * element(field, denominator) / content]


def root_in_sympy(square: Poly) -> Any:
    """The square root of a constant, up to its sign."""
    inside = square.field.sqrt(square)
    x = sympy.Symbol("x")
    if inside is not None:
        return sympy.expand(inside.to_sympy(x))
    return sympy.sqrt(sympy.factor(square.to_sympy(x)))


@dataclass(frozen=True)
class Progression:
    """start, start + step, start + 2 step, ...; the step may be negative."""

    start: int
    step: int

    def contains(self, number: Fraction | int) -> bool:
        distance = number - self.start
        return distance % self.step == 0 and distance * self.step >= 0

    def without(self, values: Iterable[FunctionPoly]) -> tuple[Progression, list[FunctionPoly]]:
        """The progression without the values at its beginning, and the other values that may belong to it."""
        start = self.start
        left = []
        for value in values:
            number = rational_number(value)
            if number == start:
                start += self.step
            elif number is None or self.contains(number):
                left.append(value)
        return Progression(start, self.step), left

    def said(self, letter: str) -> str:
        """The progression in words: even `n >= 0`, `n <= -1`, or `n = 1, 4, 7, ...`."""
        if abs(self.step) > 2:
            listed = (str(self.start + k * self.step) for k in range(3))
            return f"`{letter} = {', '.join(listed)}, ...`"
        kind = ("even ", "odd ")[self.start % 2] if abs(self.step) == 2 else ""
        return f"{kind}`{letter} {'>=' if self.step > 0 else '<='} {self.start}`"


class SolutionRow(NamedTuple):
    """The solution for the integers of a progression."""

    numbers: Progression
    solution: PolynomialSolution


def families_of(claim: Claim) -> list[IntegerFamily]:
    """The alternatives if each gives a parameter as a function of an integer, whatever else doesn't vanish; else none."""
    together = claim.parts if isinstance(claim, AllOf) else (claim,)
    said = [part for part in together if not isinstance(part, IsNonzero)]
    if len(said) != 1:
        return []
    parts = said[0].parts if isinstance(said[0], AnyOf) else said
    families = [part for part in parts if isinstance(part, IntegerFamily)]
    return families if len(families) == len(parts) else []


def rows_of(solutions: Iterable[PolynomialSolution], family: IntegerFamily, letters: Letters = ()) -> list[SolutionRow]:
    """A row for each progression; none unless these make up all integers of the family.

    The letters, which the solutions don't contain, are replaced in the family by their meanings.
    """
    n = sympy.Symbol(family.letter)
    value = family.value.to_sympy(n)
    meanings = {sympy.Symbol(name): meaning for name, meaning in letters}
    values = {sympy.Symbol(family.parameter): value.xreplace(meanings)}
    rows: list[SolutionRow] = []
    for solution in solutions:
        there = solution.with_values(values)
        written = _without_roots(there.degree)
        degree = sympy.expand(written)
        progressions = [*_progressions(degree, n, family)]
        if not progressions:
            continue
        y = _without_roots(there.y).xreplace({written: degree})
        there = PolynomialSolution(y, degree, jacobi=tuple(map(_without_roots, there.jacobi)))
        if there.exclusion(family.letter):
            return []
        rows += [SolutionRow(progression, there) for progression in progressions]
    # Beyond all starts the rows repeat with the least common multiple of the steps and the modulus.
    period = lcm(family.numbers.modulus.numerator, *(row.numbers.step for row in rows))
    end = period + max((abs(row.numbers.start) for row in rows), default=0)
    numbers = [number for number in range(-end, end + 1) if family.numbers.contains(Fraction(number))]
    if not all(any(row.numbers.contains(number) for row in rows) for number in numbers):
        return []
    return sorted(rows, key=lambda row: (row.numbers.step < 0, abs(row.numbers.start)))


def _progressions(degree: Any, n: Any, family: IntegerFamily) -> Iterator[Progression]:
    """The integers n of the family for which the degree a n + b is natural; none for any other degree."""
    linear = degree.as_poly(n)
    if linear is None or linear.degree() != 1 or not linear.domain.is_QQ | linear.domain.is_ZZ:
        return
    a, b = map(to_fraction, linear.all_coeffs())
    # n = (d - b)/a for d = 0, 1, ... is in the same class again after `period` steps.
    period = (family.numbers.modulus * abs(a)).numerator
    for d in range(period):
        first = (d - b) / a
        if first.denominator == 1 and family.numbers.contains(first):
            yield Progression(int(first), int(period / a))


def _without_roots(expression: Any) -> Any:
    """The expression with square roots of squares replaced by polynomials, whose signs are free anyway."""
    found = with_roots_of_factors(expression, sympy.Dummy())
    return found.replace(lambda e: e.is_Pow and e.exp.has(sympy.Symbol), lambda e: e.base ** shorter_sum(e.exp))
