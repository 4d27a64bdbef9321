"""Where S changes, and S there: hypersurfaces in parameter space, generic conditions, and algebraic constants.

Polynomials in the parameters tell where S isn't defined, and where poles merge, vanish or change their order.  The engine
computes over Q(t).  Where these polynomials don't vanish, S has the same poles with the same orders, and a positive answer
specialises: omega's polynomial is defined there and solves the Riccati equation.  Exponent differences that depend on the
parameters count as irrational numbers; where one of them becomes rational, and the other listed conditions hold, the equation
may be solvable though it isn't generically, and `kovacic.conditions` says where exactly.

S over Q(t)(alpha), alpha an algebraic number, is S over Q(t, alpha) at one value of the parameter alpha.  A partition of the
larger space that is right at all of its points is right on the slice, and if it is complete there it is complete here.

Parameters that stand for constants, sqrt(a) or exp(a/2), are named after them.  The engine computes with a letter for each;
in everything printed, in values and in solutions they are the user's own.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, combinations, count
from math import gcd
from typing import Any, NamedTuple

import sympy

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly, norm
from kovacic.algebra.factors import product
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.partial_fractions import partial_fractions
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.algebra.traces import characteristic_polynomial
from kovacic.answer import Answer
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import PI, Parsed, parameters_of
from kovacic.errors import InputError
from kovacic.limits import Budget
from kovacic.numbers.numerals import as_text
from kovacic.parametric import claims
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import (
    NO_CONSTANT,
    ParameterPoint,
    degrees,
    denominator,
    element,
    in_field,
    irreducible_factors,
    over_parameters,
    rational_number,
    union,
    with_free_generator,
)
from kovacic.parametric.formulas import expanded_form
from kovacic.parametric.statements import Setting
from kovacic.writing.formula import caret, with_single_powers


def undefined(problem: Problem) -> list[FunctionPoly]:
    """The irreducible polynomials at whose zeros the leading coefficient of S's denominator vanishes."""
    return irreducible_factors(_down(problem.S.cleared()[1].lc))


def confluence(problem: Problem) -> list[FunctionPoly]:
    factors = [place.factor for place in problem.finite_places]
    conjugate = [_common_zeros(factor, factor.derivative()) for factor in factors]
    others = [_common_zeros(first, second) for first, second in combinations(factors, 2)]
    return union([undefined(problem), *conjugate, *others])


def structure_changes(problem: Problem) -> list[FunctionPoly]:
    """Where poles merge, go to infinity, or change their order."""
    above, _ = problem.S.cleared()
    zeros = [_common_zeros(place.factor, above) for place in problem.finite_places]
    return union([confluence(problem), irreducible_factors(_down(above.lc)), *zeros])


@dataclass(frozen=True)
class GenericConditions:
    """Conditions on the parameters under which an answer holds; false without any condition.

    Attributes
    ----------
    nonzero : tuple
        Polynomials in the parameters that must not vanish.
    irrational_squares : tuple
        Squares of exponent differences that were assumed to be irrational.

    Examples
    --------
    >>> import kovacic
    >>> conditions = kovacic.solve("n*x").generic_conditions
    >>> bool(conditions), str(conditions)
    (True, 'n != 0')
    """

    nonzero: tuple[FunctionPoly, ...]
    irrational_squares: tuple[FunctionPoly, ...]

    def __bool__(self) -> bool:
        return bool(self.nonzero or self.irrational_squares)

    def __str__(self) -> str:
        parts = [f"{expanded_form(f)} != 0" for f in self.nonzero]
        parts += [f"sqrt({expanded_form(f)}) isn't rational" for f in self.irrational_squares]
        return ", ".join(parts) or "none"


def generic_conditions(answer: Answer) -> GenericConditions:
    """The conditions of an answer over Q(t); none without parameters, or if assumptions prove the answer.

    >>> import kovacic
    >>> print(generic_conditions(kovacic.solve("(m^2*x^4 + (2*n + 1)*m*x^2 + n^2 - n)/x^2")))
    m != 0, n != 0, n - 1 != 0, sqrt(4*n^2 - 4*n + 1) isn't rational
    """
    if answer.S.field.ground == QQ or answer.assumed:
        return GenericConditions((), ())
    problem = analyse(answer.S, Budget())
    changes = [structure_changes(problem)]
    riccati = answer.riccati
    series = answer.series
    # The polynomials in omega's equation have to be defined; P is up to a factor, whatever its recurrence divides by.
    defining = [] if riccati is None else [riccati.P, riccati.D, *riccati.numerators]
    if series is not None:
        defining = [series.theta.num, series.theta.den, series.centre]
    changes += [irreducible_factors(_down(d)) for part in defining for d in claims.denominators(part)]
    constants = answer.constants
    if constants is not None:
        changes.append(_common_zeros(constants, constants.derivative()))
    squares = [place.delta_squared for place in problem.places if place.kind is Kind.REGULAR]
    irrational = [_down(square) for square in squares if square and rational_number(square) is None]
    return GenericConditions(tuple(union(changes)), tuple(union([irrational])))


def _common_zeros(first: Poly, second: Poly) -> list[FunctionPoly]:
    """The irreducible factors of the resultant, or of its norm over an extension of Q(t)."""
    if first.degree < 1 or second.degree < 1:
        return []
    if isinstance(first, FunctionPoly) and isinstance(second, FunctionPoly):
        return irreducible_factors(element(first.field, first.num.resultant(second.num, 0)))
    return irreducible_factors(_down(characteristic_polynomial(second, first.monic())[0]))


def _down(constant: Poly) -> FunctionPoly:
    """An element of Q(t), or the norm of one of an extension."""
    while isinstance(constant, ExtensionPoly):
        constant = norm(constant)
    return over_parameters(constant)


@dataclass(frozen=True)
class Hypersurface(ParameterPoint):
    """The zeros of an irreducible polynomial in the parameters: their values over a field of fewer ones, or an extension.

    At each zero that isn't covered one of the `missed` functions vanishes.  A `curve` has new parameters, named with their
    values as functions of the original ones.
    """

    missed: tuple[FunctionPoly, ...] = ()
    curve: tuple[tuple[str, FunctionPoly], ...] = ()

    def back(self, function: Poly, field: FunctionField) -> FunctionPoly:
        """A function of fewer parameters, or of those of the curve, in the original parameters, those of the field."""
        return in_field(function, field, self.curve)


def hypersurface(function: FunctionPoly, fixed: Sequence[str] = ()) -> Hypersurface:
    """Values of the parameters at which an irreducible polynomial in at least one that isn't `fixed` vanishes.

    A parameter that isn't fixed and occurs linearly is eliminated, preferably one with a constant coefficient; otherwise one
    becomes algebraic over the others, unless the zeros are a rational curve.  Eliminating t from A t + B misses the zeros of A;
    these are zeros of the polynomial only if there are two other parameters, since A and B are coprime.
    """
    names = function.field.names
    powers = degrees(function)
    leading = {i: claims.powers_of(function, i)[k] for i, k in enumerate(powers) if k and names[i] not in fixed}
    linear = [i for i in leading if powers[i] == 1]
    if linear:  # constants come first, then the shortest
        i = min(linear, key=lambda i: (not leading[i].num.is_constant(), len(leading[i].num)))
    else:
        curve = _with_weights(function)
        if curve is not None and {*fixed}.isdisjoint(names[i] for i, k in enumerate(powers) if k):
            return curve
        i = min(leading, key=lambda i: powers[i])
    others = (*names[:i], *names[i + 1 :])
    field = FunctionField(others)
    smaller = field if others else QQ
    values: list[Poly] = [*map(field.generator, others)]
    values.insert(i, smaller.poly([0]))  # until it is known
    coefficients = claims.coefficients_in(function, i, values, smaller)
    if powers[i] == 1:
        values[i] = -coefficients[0] / coefficients[1]
        missed = irreducible_factors(leading[i]) if len(leading) > 2 else []
        return Hypersurface(names, tuple(values), smaller, tuple(missed))
    extension = AlgebraicField(smaller, smaller.poly(coefficients).monic(), names[i])
    values[i] = extension.generator
    return Hypersurface(names, tuple(value.over(extension) for value in values), extension)


def _with_weights(function: FunctionPoly) -> Hypersurface | None:
    """The curve v^q = theta u^p, p and q coprime, theta a number, by T, undefined at u = v = 0; None for other functions.

    With a q - b p = 1 it is u = theta^b T^q and v = theta^a T^p, where T = u^a/v^b.
    """
    names = function.field.names
    used = [(name, n) for name, n in zip(names, degrees(function), strict=True) if n]
    if len(used) != 2:
        return None
    (u, m), (v, n) = used
    degree = gcd(m, n)
    p, q = m // degree, n // degree
    # The coefficients of u^i v^j, with the same q i + p j in all terms.
    first, second = (1 + names.index(name) for name, _ in used)
    terms = {(int(k[first]), int(k[second])): int(c) for k, c in function.num.to_dict().items()}
    if any(q * i + p * j != q * m for i, j in terms):
        return None
    free = (letter for letter in map("T{}".format, count()) if letter not in names)
    letter, number = next(free), next(free)
    field = FunctionField((letter, *(name for name in names if name not in (u, v))))  # a constant stays the last one
    T = field.generator(letter)
    modulus = field.poly([terms.get((p * (degree - k), q * k), 0) for k in range(degree + 1)]).monic()
    theta: Poly = AlgebraicField(field, modulus, number).generator if degree > 1 else -modulus[0]
    a = pow(q, -1, p)
    b = (a * q - 1) // p  # -1 for p = 1
    values: dict[str, Poly] = {name: field.generator(name) for name in field.names}
    values |= {u: theta ** (b + 1) * T**q / theta, v: theta**a * T**p}
    x, y = map(function.field.generator, (u, v))
    curve = ((letter, x**a * y if b < 0 else x**a / y**b), (number, y**q / x**p))
    on_curve = tuple(values[name].over(theta.field) for name in names)
    return Hypersurface(names, on_curve, theta.field, (x,), curve)


class WithFreeConstant(NamedTuple):
    """S with its algebraic constant as one more parameter, as it is shown, and the value of this parameter.

    The partial fractions of `S` are lifted one by one, so that poles and exponents are the same with a free constant.
    """

    S: RatFunc
    shown: RatFunc
    constant: ParameterPoint


def with_free_constant(S: RatFunc) -> WithFreeConstant:
    """For S over Q(t), where the point is empty, or over Q(t)(alpha) with a number alpha."""
    field = S.field
    if not isinstance(field, AlgebraicField):
        return WithFreeConstant(S, S, NO_CONSTANT)
    names = parameters_of(field.base)
    name = field.name
    while name in names:
        name += "_"
    larger = FunctionField((*names, name))
    free = partial(with_free_generator, larger=larger)
    modulus = QQ.poly([rational_number(c) or 0 for c in field.modulus])
    numbers = AlgebraicField(QQ, modulus, field.name, field.approximation)
    point = ParameterPoint((name,), (numbers.generator,), numbers)
    return WithFreeConstant(_in_parts(S, free), RatFunc(free(S.num), free(S.den)), point)


def _in_parts(S: RatFunc, free: Callable[[Poly], FunctionPoly]) -> RatFunc:
    """S with a free constant: in each partial fraction, unless that changes infinity or the values at which S is defined."""
    whole, fractions = partial_fractions(S)
    parts = [whole, *(fraction.above for fraction in fractions)]
    own = {*irreducible_factors(_down(S.cleared()[1].lc))}
    if all(own.issuperset(irreducible_factors(below)) for part in parts for below in claims.denominators(part)):
        terms = (RatFunc(free(one.above), free(one.factor) ** one.power) for one in fractions)
        total = sum(terms, RatFunc(free(whole)))
        if total.degree == S.degree:
            return total
    factors = [free(factor) ** k for factor, k in S.field.factor(S.den)]
    return RatFunc(free(S.num), product([free(S.den.lc), *factors]))


def in_lowest_powers(function: FunctionPoly, constant: ParameterPoint) -> FunctionPoly:
    """The function with the lowest powers of the constant, if that is the last parameter of its field."""
    field = function.field
    if field.names[-1:] != constant.names:
        return function
    here = everywhere(field, constant)
    below = denominator(function)
    if not any(degrees(below)[:-1]):  # the inverse of a number has no denominator
        return with_free_generator(here.at(function), field)
    return over_parameters(with_free_generator(here.at(claims.numerator(function)), field) / below)


def everywhere(field: FunctionField, constant: ParameterPoint) -> Hypersurface:
    """All values of the parameters of a field, the last of which is the constant, if there is one."""
    numbers = constant.field
    if not isinstance(numbers, AlgebraicField):
        return Hypersurface(field.names, tuple(map(field.generator, field.names)), field)
    *others, name = field.names
    base = FunctionField(tuple(others))
    modulus = base.poly([rational_number(c) or 0 for c in numbers.modulus])
    extension = AlgebraicField(base, modulus, name, numbers.approximation)
    values = [extension.embed(base.generator(other)) for other in others]
    return Hypersurface(field.names, (*values, extension.generator), extension)


#: Names of parameters that aren't the user's, with the expressions that they stand for.
Letters = tuple[tuple[str, Any], ...]


def spelled(parsed: Parsed) -> tuple[Parsed, Letters]:
    """The input with each letter renamed after the expression that it stands for.

    Nothing changes without letters, or with an algebraic constant.
    """
    field = parsed.S.field
    if not isinstance(field, FunctionField) or not parsed.letters:
        return parsed, parsed.letters
    meanings = dict(parsed.letters)
    spellings: dict[str, str] = {}
    for name, meaning in parsed.letters:  # powers in parentheses, (a^(1/3)), so that they can be raised to others
        text = caret(as_text(meaning))
        is_power = meaning.is_Pow and meaning.exp != sympy.S.Half and meaning.base != sympy.E
        spellings[name] = f"({text})" if is_power else text
    letters = tuple((spellings[name], meanings[name]) for name in field.names if name in meanings)
    larger = FunctionField(tuple(spellings.get(name, name) for name in field.names))

    def renamed(function: RatFunc) -> RatFunc:
        parts = map(over_parameters, (function.num, function.den))
        return RatFunc(*(FunctionPoly(larger, part.num, part.den) for part in parts), reduced=True)

    equation = parsed.equation
    if equation is not None:
        a, b, c, f = map(renamed, (equation.a, equation.b, equation.c, equation.f))
        equation = replace(equation, a=a, b=b, c=c, f=f)
    own = re.compile(rf"\b({'|'.join(map(re.escape, spellings))})\b")
    said = (notice for notice in parsed.notices if not notice.startswith(tuple(f"{name} is " for name in meanings)))
    notices = tuple(with_single_powers(own.sub(lambda name: spellings[name[0]], notice)) for notice in said)
    return replace(parsed, S=renamed(parsed.S), equation=equation, notices=notices, letters=()), letters


def own_parameters(names: Sequence[str], letters: Letters) -> tuple[str, ...]:
    """The user's parameters: letters are replaced by the parameters in their meanings."""
    meanings = dict(letters)
    symbols = (meanings[name].free_symbols if name in meanings else [sympy.Symbol(name)] for name in names)
    return tuple(dict.fromkeys(chain.from_iterable(sorted(one.name for one in several) for several in symbols)))


def transcendental(names: Sequence[str], letters: Letters) -> list[str]:
    """The names of pi, and of letters for numbers such as e, which no condition is solved for."""
    numbers = {name for name, meaning in letters if meaning.is_number and meaning.is_algebraic is False}
    return [name for name in names if name == PI or name in numbers]


def setting_of(
    variable: str, names: tuple[str, ...], constant: ParameterPoint, letters: Letters, assumptions: Assumptions
) -> Setting:
    """The setting for statements about these parameters, in which nothing is solved for the constant, pi and e."""
    fixed = (*constant.names, *transcendental(names, letters))
    taken = variable, *names, *own_parameters(names, letters)
    return Setting(taken, fixed, assumptions=replace(assumptions, constant=constant))


def nonzero(letters: Letters) -> list[str]:
    """The letters for exponentials and for powers of numbers, which have no zeros."""
    bases = [(name, meaning, meaning.as_base_exp()[0]) for name, meaning in letters]
    return [name for name, c, base in bases if isinstance(c, sympy.exp) or (base.is_number and base.is_nonzero)]


def values_of_letters(values: Mapping[str, Any], letters: Letters) -> dict[str, Any]:
    """The values of the letters at values of the user's parameters, as SymPy expressions.

    Raises `InputError` for what isn't an algebraic number.
    """
    numbers = {sympy.Symbol(name): value for name, value in values.items()}
    found = {}
    for name, meaning in letters:
        value = meaning.subs(numbers)
        if not value.is_algebraic:
            raise InputError(f"{name} is {value} there, which may not be an algebraic number")
        found[name] = value
    return found
