"""Numerical problems: the user's equation as a system for its normal form, with its gauge, its right-hand side, the
values of its constants and parameters, and a decision where there is one.

Constants may be known by balls: algebraic ones such as sqrt(2), and irrational values of parameters.  Then the solutions are
carried by power series in balls (`kovacic.enclosure.analytic`); here are S and the gauge at the working precision in force,
their poles, and the lines that meet none.  A constant of an extension Q(c) is the root of the modulus that the text named
(sqrt(2) is positive).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq_poly, fmpz_poly

from kovacic.algebra.embedding import Zeros, root_near
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.factors import squarefree_factors
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly, to_fmpq
from kovacic.answer import Answer, computed_once
from kovacic.decision import Decision
from kovacic.enclosure.frame import System, check_segment
from kovacic.enclosure.log_derivative import sharp_roots
from kovacic.enclosure.points import (
    ExactPoint,
    Number,
    are_real,
    as_number,
    kept_at_precision,
    midpoint,
    to_acb,
    to_ball,
)
from kovacic.enclosure.request import Params
from kovacic.equation import Change, Equation, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.numbers.numerals import as_text


def cleared(a: RatFunc, b: RatFunc, c: RatFunc, *others: RatFunc) -> list[RatFunc]:
    """All of these times the common denominator of the first three."""
    common = a.den
    for part in (b, c):
        # The least common multiple: without what a denominator shares with the others.
        common *= part.den // common.gcd(part.den)
    return [part * RatFunc(common) for part in (a, b, c, *others)]


def _at(polynomial: Any, values: list[acb]) -> acb_poly:
    """A polynomial over Z in x and the parameters at these values of the latter."""
    total = acb_poly([])
    for exponents, coefficient in polynomial.to_dict().items():
        power, *others = map(int, exponents)  # that of x, and those of the parameters
        total += acb_poly([0] * power + [math.prod(map(pow, values, others), start=acb(coefficient))])
    return total


@kept_at_precision(maxsize=32)
def root_of(field: AlgebraicField) -> acb:
    """The generator, at the working precision in force."""
    # Over a base with parameters no root is meant: None.
    modulus = [field.base.rational_value(field.modulus[k]) for k in range(field.dimension + 1)]
    if field.approximation is None or None in modulus:
        raise InputError(f"which root of {field.modulus} the constant {field.name} is isn't known")
    rep = QQ.poly([c for c in modulus if c is not None]).rep
    return root_near(rep.numer(), acb(*(arb(to_fmpq(part)) for part in field.approximation)))


@dataclass(frozen=True)
class Coefficients:
    """a y'' + b y' + c y = f with any functions: SymPy expressions in `variable` and the names of `values`.

    a isn't 1 where b and c would be over a polynomial.  `changed` is the equation that was read or solved in another variable
    t, in which it is rational.
    """

    variable: Any
    b: Any
    c: Any
    f: Any
    values: tuple[tuple[str, Number], ...] = ()
    changed: Any = field(default=None, compare=False, repr=False)
    a: Any = 1

    @property
    def parts(self) -> tuple[Any, Any, Any]:
        """b, c and f."""
        return self.b, self.c, self.f

    @property
    def all_parts(self) -> tuple[Any, Any, Any, Any]:
        """a, an expression also where it is 1, b, c and f."""
        return self.a + self.variable * 0, self.b, self.c, self.f

    def given(self, values: Params) -> Coefficients:
        """With the values of the parameters; raises InputError unless each has one."""
        symbols = set().union(*(part.free_symbols for part in self.parts))
        names = {symbol.name for symbol in symbols} - {self.variable.name}
        found = values_of_parameters(tuple(sorted(names)), values or {})
        return replace(self, values=tuple(sorted(found.items())))

    def at(self, x: Any) -> dict[Any, Any]:
        """What the symbols stand for where the variable is x."""
        symbol = type(self.variable)
        return {symbol(name): to_ball(value) for name, value in self.values} | {self.variable: x}

    @property
    def is_exact(self) -> bool:
        """True unless a parameter's value is a ball."""
        return not any(value.fixed for _, value in self.values)


@dataclass(frozen=True, eq=False)
class NumericProblem:
    """y'' = S y with z = g y, the user's solution: `gauge` is g'/g = -b/(2a), zero where the normal form itself was given.

    `decision` is that on S where the problem was read from a solution, `right` the user's equation where its right-hand side
    isn't zero.  All may be over a field of constants that are known by balls: algebraic ones, or parameters with `values`.
    """

    S: RatFunc
    gauge: RatFunc
    decision: Decision | None = None
    right: Equation | None = None
    values: Mapping[str, Number] = field(default_factory=dict)

    @cached_property
    def is_rational(self) -> bool:
        """True if all rational functions of the equation are over Q."""
        return all(function.field == QQ for function in self._functions)

    @cached_property
    def system(self) -> System:
        """The normal form with integer coefficients, of a rational problem."""
        return System.of(self.S)

    @cached_property
    def is_real(self) -> bool:
        """True if the coefficients of S and of the gauge are real; the right-hand side may be complex."""
        with working_precision(40):
            polynomials = [part for function in (self.S, self.gauge) for part in (function.num, function.den)]
            return all(are_real(self._embed(part).coeffs()) for part in polynomials)

    @property
    def is_exact(self) -> bool:
        """True unless a parameter's value is a ball."""
        return not any(value.fixed for value in self.values.values())

    def check(self) -> None:
        """Raise InputError unless numerator and denominator of S are known, with a leading coefficient of the latter."""
        with working_precision(700):  # of which far fewer are lost to cancellation
            # A parameter may be so wide that the degree of the denominator isn't known.
            num, den = (part.coeffs() for part in self.polynomials())
            if not all(c.is_finite() for c in (*num, *den)) or den[-1].contains(0):
                raise InputError(
                    "the equation isn't defined at these values of the parameters, as far as they are known"
                )

    @cached_property
    def places(self) -> System:
        """Its denominator vanishes at the singular points of a rational problem, and nowhere in other ones."""
        den = fmpz_poly([1])
        for part in (fmpz_poly(list(System.of(f).den)) for f in self._functions if self.is_rational):
            den *= part // part.gcd(den)
        return System((), tuple(int(c) for c in den.coeffs()))

    @cached_property
    def cleared(self) -> list[RatFunc]:
        """Polynomials a, b and c of the user's equation."""
        # y'' = S y and y = z/g: y' = (z' - gamma z)/g, y'' = (z'' - 2 gamma z' + (gamma^2 - gamma') z)/g.
        zero, gamma = self.S * 0, self.gauge  # all of them in one field
        return cleared(zero + 1, zero - 2 * gamma, gamma * gamma - gamma.derivative() - self.S)

    @cached_property
    def equation(self) -> tuple[fmpq_poly, fmpq_poly, fmpq_poly]:
        """The cleared coefficients of a rational problem, as FLINT's polynomials."""
        a, b, c = (part.num.rep for part in self.cleared if isinstance(part.num, RationalPoly))
        return a, b, c

    @cached_property
    def _functions(self) -> list[RatFunc]:
        """S, the gauge, and a rational right-hand side over the coefficient of y'': their poles are the singular points."""
        if self.right is None or self.right.h is not None:
            return [self.S, self.gauge]
        return [self.S, self.gauge, self.right.f / self.right.a]

    def poles(self, prec: int) -> Zeros:
        """Enclosures of the poles of S at about `prec` bits, with their multiplicities."""
        return self._poles_of(self.S, prec)

    def _poles_of(self, function: RatFunc, prec: int) -> Zeros:
        """Those of a function, with exact multiplicities; raises LimitExceeded if they can't be told apart."""
        if self.is_rational:
            return System.of(function).roots("den", prec)
        with working_precision(2 * prec):
            # Squarefree factors have simple zeros, which can be isolated in balls; k is exact.
            factors = [(factor, k) for factor, k in squarefree_factors(function.den) if factor.degree]
            found = tuple((root, k) for factor, k in factors for root in sharp_roots(self._embed(factor)))
        if sum(k for _, k in found) < function.den.degree:
            raise LimitExceeded("the singular points can't be told apart at this precision", limit="digits")
        return found

    def enclosures(self, prec: int) -> list[acb]:
        """Enclosures of the singular points of the user's equation: the poles of S, of the gauge and of a rational right-hand
        side, some perhaps several times."""
        return [root for function in self._functions for root, _ in self._poles_of(function, prec)]

    def polynomials(self) -> tuple[acb_poly, acb_poly]:
        """Numerator and denominator of S, at the working precision in force."""
        return self._embed(self.S.num), self._embed(self.S.den)

    def _embed(self, poly: Poly) -> acb_poly:
        """The polynomial at the working precision in force."""
        if isinstance(poly, RationalPoly):
            return acb_poly(poly.rep)
        if isinstance(poly, ExtensionPoly):
            c = root_of(poly.field)
            return sum((self._embed(part) * c**k for k, part in enumerate(poly.parts)), acb_poly([]))
        assert isinstance(poly, FunctionPoly)
        balls = [to_ball(self.values[name]) for name in poly.field.names]
        return _at(poly.num, balls) * (1 / _at(poly.den, balls)[0])

    def check_segment(self, a: ExactPoint, b: ExactPoint) -> None:
        """Raise InputError if the closed segment contains a singular point of the user's equation, or may contain one, as
        constants in balls don't tell."""
        if self.is_rational:
            check_segment(self.places, a, b)
            return
        for point in self.enclosures(ctx.prec):
            ratio = (to_acb(b) - point) / (to_acb(a) - point)  # negative or 0 on the segment only
            if not (ratio.real > 0 or not ratio.imag.contains(0)):
                place = midpoint(point).rounded(-64)
                raise InputError(
                    f"the path runs through the singular point near {place}, or so near that its constants don't tell",
                    hint="go around it: path='above', or path=[...] with a vertex off the axis",
                    shell="go around it: --path above, or --path below",
                )

    def singular_points(self, prec: int) -> list[ExactPoint]:
        """The midpoints of their enclosures, each once; on the real axis exactly where the singular point is."""
        roots = self.enclosures(prec)
        return [midpoint(root) for k, root in enumerate(roots) if not any(map(root.overlaps, roots[:k]))]


def as_problem(
    equation: object, params: Params = None, *, forced: bool = False, constants: bool = False
) -> NumericProblem:
    """The numerical problem of an equation as `kovacic.evaluate` accepts it, with these values of its parameters.

    Only with `forced` may it have a right-hand side, and only with `constants` coefficients that aren't rational.
    """
    if isinstance(equation, NumericProblem):
        return equation
    if isinstance(equation, Coefficients):
        raise NotRational(f"numerical evaluation needs coefficients that are rational in {equation.variable} here")
    # Answers and text are read once.
    if params is None and isinstance(equation, Answer):
        found = problem_of(equation)
    elif params is None and isinstance(equation, str):
        known = _problem_of_text(equation)
        if isinstance(known, NotRational):
            raise known.with_traceback(None)
        found = known
    else:
        found = read_problem(equation, params)
    if found.right is not None and not forced:
        raise InputError("an equation without a right-hand side is needed here")
    if not (found.is_rational or constants):
        raise InputError("numerical evaluation needs S with rational coefficients here, and values such as '1/3'")
    return found


def change_of(equation: object) -> Change | None:
    """The change of variable of an answer, or of an equation that was read; None for everything else."""
    if isinstance(equation, Answer | Parsed) and equation.equation is not None:
        return equation.equation.change
    return None


@computed_once
def problem_of(answer: Answer) -> NumericProblem:
    """The numerical problem of an answer, read once."""
    return read_problem(answer)


@lru_cache(maxsize=64)
def _problem_of_text(equation: str) -> NumericProblem | NotRational:
    """The problem, or why there is none."""
    try:
        return read_problem(equation)
    except NotRational as reason:
        return reason


def read_problem(equation: object, params: Params = None) -> NumericProblem:
    """As `as_problem`, whatever its coefficients and its right-hand side are."""
    from kovacic.reading.read import read_input

    found = equation if isinstance(equation, Answer | Parsed) else read_input(equation)
    S = found.S
    given = found.equation or Equation(S * 0 + 1, S * 0, -S, S * 0)
    if given.change is not None:
        raise NotRational(f"numerical evaluation needs coefficients that are rational in {given.change.variable} here")
    names = set(parameters_of((given.a + given.b + given.c).field))
    if given.h is not None:
        names |= {symbol.name for symbol in given.h.free_symbols} - {given.variable}
    letters = getattr(found, "letters", ())
    # Letters that the reader put for constants such as pi have their own values.
    constants = {name: meaning for name, meaning in letters if meaning.is_number and name in names}
    numbers = values_of_parameters(tuple(sorted(names)), params or {}, constants)
    # Rational values can be put into the equation; the others stay parameters with balls.
    values = {name: n.re for name, n in numbers.items() if isinstance(n, ExactPoint) and n.is_real()}
    is_algebraic = any(isinstance(field, AlgebraicField) for field in (S.field, given.gauge.field, given.f.field))
    decision = found.decision if isinstance(found, Answer) else None
    if values and len(values) == len(numbers) and not is_algebraic:  # the decision is that for generic values
        given, decision = _specialised(given, values), None
        S = given.S
    right = None if given.is_homogeneous else given
    problem = NumericProblem(S, given.gauge, decision, right, numbers)
    problem.check()
    return problem


def _specialised(given: Equation, values: Mapping[str, Fraction]) -> Equation:
    """The equation at these values of its parameters."""

    def at(function: RatFunc) -> RatFunc:
        num, den = function.num, function.den
        if not isinstance(num, FunctionPoly) or not isinstance(den, FunctionPoly):
            return function
        point = [values[name] for name in num.field.names]
        return RatFunc(num.value_at(point, QQ), den.value_at(point, QQ))

    h = given.h
    if h is not None:
        h = h.subs({name: as_text(value) for name, value in values.items()})
    try:
        a, b, c, f = map(at, (given.a, given.b, given.c, given.f))
        return replace(given, a=a, b=b, c=c, f=f, h=h)
    except (ZeroDivisionError, ValueError):
        raise InputError("the equation isn't defined at these values of the parameters") from None


def values_of_parameters(
    names: tuple[str, ...], params: Mapping[str, object], constants: Params = None
) -> dict[str, Number]:
    """The values of the parameters, those of `constants` included; raises InputError unless there is one for each other."""
    known = {name: as_number(value, name) for name, value in (constants or {}).items()}
    given = {str(name): as_number(value, f"the parameter {name}") for name, value in params.items()}
    names = tuple(name for name in names if name not in known)
    if set(given) == set(names):
        return known | given
    hint = f"params={dict.fromkeys(names, 3)}, for instance" if names else "leave params out"
    shell = " ".join(f"--param {name}=3" for name in names) + ", for instance" if names else "leave --param out"
    needed = f"values are needed for {', '.join(names) or 'no parameter'}"
    raise InputError(f"{needed}; given are {', '.join(given) or 'none'}", hint=hint, shell=shell)
