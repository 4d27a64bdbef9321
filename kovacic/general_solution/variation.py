"""Variation of parameters: y = -y1 int y2 f/(a W) dx + y2 int y1 f/(a W) dx,  W = y1 y2' - y1' y2.

Integrals that aren't known stay as they are: SymPy's rules know hardly any others, and take seconds to find that out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import sympy
from flint import acb, arb, fmpq
from sympy import cos, expand, powsimp, sin
from sympy.core.function import AppliedUndef
from sympy.simplify.fu import TR8

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.form import one_exponential
from kovacic.closed_form.jets import jet
from kovacic.closed_form.product import product
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.continuity import jumps
from kovacic.general_solution.integrands import NUMBERS, prepared, radicands
from kovacic.general_solution.special_integrals import without_crossings
from kovacic.general_solution.steps import JUMPING
from kovacic.general_solution.substitution import finite_value, size, slope
from kovacic.limits import check_time
from kovacic.reading.change_of_variable import function_of_x, in_x

Expr = Any  # SymPy publishes no types
#: Points x/101 + i y/89 in each quadrant and on the axis, where a solution is substituted: wrong branches of roots don't pass.
_POINTS = [(137, 71), (-151, 83), (-97, -119), (163, -79), (23, 0), (67, 0), (173, 0), (431, 0), (-41, 0), (-257, 0)]
#: Functions whose values at points aren't known in closed form.
_UNKNOWN = (sympy.RootSum, sympy.Integral)
#: Functions that appear with complex arguments, and how many of these are better than an integral.
_COMPLEX = (sympy.Ei, sympy.expint, sympy.erf, sympy.erfi, sympy.uppergamma, sympy.lowergamma)
_MOST_COMPLEX = 4
#: C1 with C2 and C1 C2' - C1' C2.
_PAIRS: dict[Any, tuple[Any, Any]] = {
    sympy.airyai: (sympy.airybi, lambda *args: 1 / sympy.pi),
    sympy.besselj: (sympy.bessely, lambda nu, z: 2 / (sympy.pi * z)),
    sympy.besseli: (sympy.besselk, lambda nu, z: -1 / z),
    sympy.jn: (sympy.yn, lambda n, z: z**-2),
    sympy.mathieuc: (sympy.mathieus, lambda a, q, z: sympy.mathieuc(a, q, 0) * sympy.mathieusprime(a, q, 0)),
    sympy.legendre: (
        lambda nu, z: sympy.legendre(nu, -z),
        lambda nu, z: 2 * sin(sympy.pi * nu) / (sympy.pi * (z**2 - 1)),
    ),
}


class DefiniteIntegral(sympy.Integral):  # type: ignore[misc]
    """SymPy's, for integrals between numbers that aren't done, which say that they aren't numbers.

    SymPy orders the terms of a sum by the values of the numbers among their factors, so that printing, comparing or asking for
    a sign would integrate numerically, for minutes [`Expr.as_terms`].  `evalf` still does.
    """

    is_number = False

    def _eval_evalf(self, prec: int) -> Expr:
        return sympy.Integral(*self.args)._evalf(prec)


@dataclass(frozen=True)
class Basis:
    """Two solutions of the homogeneous equation in x, which is that of `equation` unless this has another variable.

    `own` puts the user's symbols, with what is known of them, into an expression.
    """

    y1: Expr
    y2: Expr
    x: Expr
    equation: Equation
    own: Callable[[Expr], Expr] = sympy.sympify

    @cached_property
    def wronskian(self) -> Expr:
        """W = c exp(-int b/a dx), where c is found at a point, or by the theory of the functions; else by the definition."""
        known = special_wronskian(self.y1, self.y2, self.x)
        if known is not None:
            return known
        if self.equation.change is not None:
            return self._changed or self._by_definition
        if self.y1.has(*_UNKNOWN) or self.y2.has(*_UNKNOWN):
            return self._by_definition
        return self._by_abel or self._by_definition

    @property
    def _by_abel(self) -> Expr | None:
        """c exp(-int b/a dx), with the first c that is a number or made of gamma functions; None where it isn't found."""
        kernel = display(product(self.equation.gauge * 2), Atoms(self.x), around_zero=True).xreplace(NUMBERS)
        # Real about 0, where the constant is found: (1 - x)^e for (x - 1)^e.
        negative = {p: (-p.base) ** p.exp for p in kernel.atoms(sympy.Pow) if _is_negative_root(p, self.x)}
        kernel = kernel.xreplace(negative)
        c = next(filter(_is_usable, self._quotients(kernel)), None)
        if c is None:
            return None
        W = _simplified(c) * kernel
        return W if self._is_wronskian(W) else None

    @cached_property
    def rates(self) -> tuple[Expr, Expr]:
        """B and C of y'' + B y' + C y = 0 in x: t' b/a - t''/t' and t'^2 c/a, where the equation is one in t = t(x)."""
        b, c = rates(self.equation, sympy.Symbol(self.equation.variable))
        if self.equation.change is None:
            return b, c
        slope = function_of_x(self.equation).diff(self.x)
        b = in_x(self.equation, b)
        c = in_x(self.equation, c)
        return b * slope - slope.diff(self.x) / slope, c * slope**2

    @property
    def _changed(self) -> Expr | None:
        """From that in t = t(x), the variable of the equation, for solutions that are functions of t."""
        own = sympy.Symbol(self.equation.variable)
        t = sympy.Dummy()
        value = function_of_x(self.equation)
        old = value
        new = t
        if value.func is sympy.exp:  # a root of it is an exponential
            old = self.x
            new = sympy.log(t) / value.exp.diff(self.x)
        y1, y2 = (y.subs(old, new) for y in (self.y1, self.y2))
        if y1.has(self.x) or y2.has(self.x):
            return None
        basis = Basis(y1.xreplace({t: own}), y2.xreplace({t: own}), own, replace(self.equation, change=None))
        return in_x(self.equation, basis.wronskian) * value.diff(self.x)

    @property
    def _by_definition(self) -> Expr:
        """The Wronskian wherever the solutions are defined, on any branch; without integrals that cancel."""
        W = self.y1 * slope(self.y2, self.x) - slope(self.y1, self.x) * self.y2
        for integral in W.atoms(sympy.Integral):
            check_time()
            letter = sympy.Dummy()
            linear = W.xreplace({integral: letter})
            if expand(linear.diff(letter)) == 0:
                W = linear.xreplace({letter: sympy.Integer(0)})
        if radicands(W) and not W.has(*_UNKNOWN, sympy.Function):
            return sympy.cancel(sympy.together(W))
        return W

    def _is_wronskian(self, W: Expr) -> bool:
        """Is the constant the same wherever roots have other branches?"""
        if not any(_has_branches(y, self.x) for y in (self.y1, self.y2)):
            return True
        with working_digits(2 * DIGITS), suppress(NotImplementedError):
            return all(self._is_wronskian_at(W, point) for point in _points())
        return False

    def _is_wronskian_at(self, W: Expr, point: Any) -> bool:
        (u, du, _), (v, dv, _), (w, _, _) = (jet(e, self.x, point) for e in (self.y1, self.y2, W))
        return bool(abs(u * dv - du * v - w) < arb(10) ** -DIGITS * (abs(u * dv) + abs(du * v)))

    def _quotients(self, kernel: Expr) -> Iterator[Expr]:
        """W/kernel at points, and at 0 from y ~ x^e for series in x; nan where it has no value."""
        by_definition = self._by_definition
        for point in map(sympy.Integer, (0, 1, -1, 2)):
            check_time()
            W = finite_value(by_definition, self.x, point)
            if W is None:
                yield sympy.nan
            else:
                yield _with_single_waves(expand(W / kernel.subs(self.x, point)))
        functions = self.y1.atoms(sympy.hyper) | self.y2.atoms(sympy.hyper)
        series = {f: sympy.Integer(1) for f in functions if f.argument.subs(self.x, 0) == 0}
        u, v = (y.xreplace(series) for y in (self.y1, self.y2))
        if series and not u.has(sympy.hyper) and not v.has(sympy.hyper):
            W = u * v.diff(self.x) - u.diff(self.x) * v
            yield powsimp(expand(expand(W) / kernel)).subs(self.x, 0)  # x^c x^(1 - c) x^-1 is 1

    def at_once(self, right: Expr) -> Expr | None:
        """A solution of y'' + ... = right by integrals that are known, substituted before it is returned; None without."""
        right = prepared(right)
        parts = [self._antiderivative(y * right / self.wronskian) for y in (self.y2, self.y1)]
        if any(part is None or part.has(sympy.Integral) for part in parts):
            return None
        if not _are_readable(parts):
            return None
        return self._checked(parts, right, rates(self.equation, self.x))

    def _checked(self, parts: Sequence[Any], right: Expr, coefficients: tuple[Expr, Expr]) -> Expr | None:
        """y2 times the second integral minus y1 times the first, in the shortest form, if that is a solution."""
        whole = expand(self.y2 * parts[1] - self.y1 * parts[0])
        if any(power.exp.free_symbols - {self.x} for power in whole.atoms(sympy.Pow)):  # x x^a
            whole = powsimp(whole)
        forms = [whole]
        if whole.has(sin, cos):
            forms.append(_with_single_waves(whole))
        candidates = []
        for form in forms:
            candidates += [self._without_homogeneous(form), self._without_homogeneous(_gathered(form, self.x))]
        found = one_exponential(min(candidates, key=size))
        return found if self._is_right(found, right, coefficients) else None

    def _is_right(self, y: Expr, right: Expr, coefficients: tuple[Expr, Expr]) -> bool:
        """Is it a solution, and without jumps at ordinary points?"""
        if self.equation.change is None and not is_solution(y, coefficients, right, self.x):
            return False
        return not jumps(self.own(y), self.x, [self.own(e) for e in (*self.rates, right)])

    def _antiderivative(self, integrand: Expr) -> Expr | None:
        """With the exponential integrals that don't jump on the real axis."""
        found = antiderivative(integrand, self.x)
        return None if found is None else without_crossings(found, self.x, self.own)

    def _without_homogeneous(self, total: Expr) -> Expr:
        """A sum without the terms that are multiples of y1 or y2."""
        terms = sympy.Add.make_args(total)
        for y in (self.y1, self.y2):
            terms = [term for term in terms if not _is_constant(term / y, self.x)]
        return sympy.factor_terms(sympy.Add(*terms))

    def with_integrals(self, right: Expr, start: Expr | None) -> Expr:
        """A solution of y'' + ... = right; integrals that aren't known stay, and begin at `start` unless it is None."""
        x = self.x
        coefficients = rates(self.equation, x)  # while there is time
        is_changed = self.equation.change is not None
        integrands = self._integrands(right, self.wronskian)
        short = [powsimp(integrand) for integrand in integrands]
        known = self._readable_integrals(short)
        if None not in known and not is_changed:
            whole = self._checked(known, right, coefficients)
            if whole is not None:
                return whole.replace(lambda e: e.func is sympy.Integral, lambda e: _open(e.function, x, start))
        for integrals in (known, [None, None]):
            solution = self._from_integrals(_with_open_ones(integrals, short, x, start))
            if self._is_right(solution, right, coefficients):
                return solution
        # The Wronskian may be on another branch.
        return self._from_integrals(
            [_open(e, x, start) for e in self._integrands(right, _with_single_waves(self._by_definition))]
        )

    def _integrands(self, right: Expr, W: Expr) -> list[Expr]:
        """y2 f/(a W) and y1 f/(a W)."""
        return [y * right / W for y in (self.y2, self.y1)]

    def _readable_integrals(self, integrands: Sequence[Expr]) -> list[Any]:
        """The integrals that are known within the limits; none of them where they are harder to read than unknown ones."""
        known: list[Any] = [None for _ in integrands]
        with suppress(LimitExceeded):
            known = [self._antiderivative(integrand) for integrand in integrands]
        if _are_readable(known):
            return known
        return [None for _ in integrands]

    def _from_integrals(self, integrals: Sequence[Expr]) -> Expr:
        """y2 int y1 f/(a W) dx - y1 int y2 f/(a W) dx, from the second and the first."""
        return self.y2 * integrals[1] - self.y1 * integrals[0]


def _with_open_ones(known: Sequence[Any], integrands: Sequence[Expr], x: Expr, start: Expr | None) -> list[Expr]:
    """The integrals, unevaluated where they aren't known."""
    integrals = []
    for found, integrand in zip(known, integrands, strict=True):
        if found is None:
            integrals.append(_open(integrand, x, start))
        else:
            integrals.append(found)
    return integrals


def _is_usable(c: Expr) -> bool:
    """Is it finite, not zero, and without functions but gamma functions?"""
    if c == 0 or c.is_finite is False or c.has(sympy.nan, sympy.zoo):
        return False
    return {f.func for f in c.atoms(sympy.Function)} <= {sympy.gamma}


def _simplified(c: Expr) -> Expr:
    """A constant of gamma functions and roots in a short form."""
    if c.has(sympy.gamma):
        c = sympy.gammasimp(c)
    if c.free_symbols and c.is_rational_function():
        return sympy.cancel(c)
    return sympy.radsimp(c)


def _with_single_waves(e: Expr) -> Expr:
    """Products of waves as sums of waves."""
    if not e.has(sin, cos):
        return e
    return expand(TR8(e))


def _is_negative_root(p: Expr, x: Expr) -> bool:
    """Is it a power of something that is negative at 0, with an exponent that isn't an integer?"""
    return bool(not p.exp.is_integer and p.base.subs(x, 0).is_negative)


def _has_branches(y: Expr, x: Expr) -> bool:
    """Are there powers of functions of x whose exponents aren't integers?"""
    return any(p.base.has(x) and not p.exp.is_Integer for p in y.atoms(sympy.Pow))


def special_wronskian(y1: Expr, y2: Expr, x: Expr) -> Expr | None:
    """W = P^2 z' (C1 C2' - C1' C2)(z) for pairs P C1(z), P C2(z) of functions that are known here; None for others.

    Reference: DLMF 9.2.7, 10.5.2, 10.28.2, 10.50.1, 14.2.3; 28.2(i): Mathieu's equation has no y', and
    there is an even and an odd solution.

    >>> x = sympy.Symbol("x")
    >>> print(special_wronskian(x * sympy.besselj(0, x**2), x * sympy.bessely(0, x**2), x))
    4*x/pi
    """
    found = [f for f in sympy.sympify(y1, strict=True).atoms(*_PAIRS) if f.has(x)]
    if len(found) != 1:
        return None
    (function,) = found
    partner, value = _PAIRS[function.func]
    P = y1 / function
    z = function.args[-1]
    if P.has(*_PAIRS) or y2 / partner(*function.args) != P:
        return None
    W = P**2 * z.diff(x) * value(*function.args)
    if W == 0:
        return None
    if W.is_rational_function(x):
        return sympy.cancel(W)
    return W


def _is_constant(quotient: Expr, x: Expr) -> bool:
    """Is it seen to be constant: not if its slope at a point isn't zero."""
    with suppress(NotImplementedError):
        if quotient.has(x) and not jet(quotient, x, next(_points()))[1].contains(0):
            return False
    return not powsimp(quotient).has(x)


def _gathered(form: Expr, x: Expr) -> Expr:
    """The sum, with the rational functions that stand before the same function as one fraction."""
    groups: dict[Expr, list[Expr]] = {}
    for term in sympy.Add.make_args(form):
        rest = sympy.Mul(*(factor for factor in sympy.Mul.make_args(term) if not factor.is_rational_function(x)))
        groups.setdefault(rest, []).append(term / rest)
    found = []
    for rest, parts in groups.items():
        fraction = sympy.Add(*parts)
        if not fraction.is_polynomial(x) or (fraction.free_symbols and not fraction.has(x)):
            fraction = sympy.factor(fraction)
        found.append(rest * fraction)
    return sympy.Add(*found)


def _are_readable(integrals: Sequence[Expr | None]) -> bool:
    """Are there few special functions of complex arguments?  Else the integrals are easier to read."""
    known = [integral for integral in integrals if integral is not None]
    functions = set().union(*(integral.atoms(*_COMPLEX) for integral in known))
    return sum(bool(f.has(sympy.I)) for f in functions) <= _MOST_COMPLEX


def starting_at(y: Expr, x: Expr, start: Expr) -> Expr:
    """With integrals from a point on in the place of antiderivatives."""
    return y.replace(
        lambda e: isinstance(e, sympy.Integral) and e.limits == (sympy.Tuple(x),), lambda e: _open(e.function, x, start)
    )


def _open(integrand: Expr, x: Expr, start: Expr | None) -> Expr:
    """The unevaluated integral, from `start` on with a variable that doesn't occur."""
    if start is None:
        return sympy.Integral(integrand, x)
    taken = {symbol.name for symbol in integrand.atoms(sympy.Symbol) | start.free_symbols}
    names = ("s", "t", "u", *(f"s{k}" for k in range(99)))
    s = next(sympy.Symbol(name) for name in names if name not in taken)
    return DefiniteIntegral(integrand.subs(x, s), (s, start, x))


def _points() -> Iterator[Any]:
    return (acb(arb(fmpq(real, 101)), arb(fmpq(imaginary, 89))) for real, imaginary in _POINTS)


def rates(equation: Equation, x: Expr) -> tuple[Expr, Expr]:
    """b/a and c/a."""
    b, c = (Atoms(x).ratio(part / equation.a).xreplace(NUMBERS) for part in (equation.b, equation.c))
    return b, c


def is_solution(y: Expr, coefficients: tuple[Expr, Expr], right: Expr, x: Expr) -> bool:
    """Does y satisfy y'' + (b/a) y' + (c/a) y = right at points in each quadrant and on the axis, to 50 digits?"""
    given = y.atoms(AppliedUndef, *JUMPING) | right.atoms(AppliedUndef, *JUMPING)
    # An exponential function for each that is given by its name, or jumps: the formula holds for any function.
    functions = enumerate(sorted(given, key=str))
    sample = {f: sympy.exp(sympy.Rational(k + 1, 3) * x) for k, f in functions if f.has(x)}
    if sample:
        y = y.xreplace(sample)
        right = right.xreplace(sample)
    with working_digits(DIGITS + 15), suppress(NotImplementedError):
        return all(_is_solution_at(point, y, coefficients, right, x) for point in _points())
    return False


def _is_solution_at(point: Any, y: Expr, coefficients: tuple[Expr, Expr], right: Expr, x: Expr) -> bool:
    """Is the residual small, by the size of its terms?  Raises `NotImplementedError` where it can't be computed."""
    b, c = coefficients
    value, first, second = jet(y, x, point)
    force, p, q = (jet(e, x, point)[0] for e in (right, b, c))
    terms = [second, p * first, q * value, -force]
    return bool(abs(sum(terms)) < arb(10) ** -DIGITS * sum(map(abs, terms), arb(1)))
