"""`Basis`: two independent solutions that know their Wronskian, its constant, and for which letters they are no basis.

By Abel, y1 y2' - y1' y2 = c w(x) with w = exp(-int b/a dx) and c constant, an expression in the letters.  `special` states c
for special functions; for elementary functions it is the quotient at one ordinary point; integrals cancel in the definition.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, islice
from types import MappingProxyType
from typing import Any

import sympy
from flint import arb
from sympy import Function, Pow, S, Tuple, cancel, factor, powsimp

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.cuts import all_turned, arguments_with_cuts, common_place, with_positive_factors
from kovacic.closed_form.form import ClosedForm
from kovacic.closed_form.jets import jet
from kovacic.closed_form.product import product
from kovacic.closed_form.way_back import in_x
from kovacic.equation import Equation
from kovacic.general_solution.integrands import NUMBERS, radicands
from kovacic.general_solution.substitution import finite_value, in_single_waves, size, slope
from kovacic.general_solution.validity import ZeroSet, independent_exceptions
from kovacic.general_solution.zero import generic_samples, quadrant_points
from kovacic.limits import check_time, manageable
from kovacic.reading.change_of_variable import function_of_x
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
#: Parts whose values at points have no closed form.
_WITHOUT_VALUES = (sympy.RootSum, sympy.Integral)
#: Antiderivatives: functions that occur in a member with any constant of integration.
_ANTIDERIVATIVES = (
    *(sympy.Integral, sympy.log, sympy.asin, sympy.acos, sympy.atan, sympy.asinh, sympy.acosh, sympy.atanh, sympy.Ei),
    *(sympy.erf, sympy.erfi, sympy.uppergamma, sympy.elliptic_e, sympy.elliptic_f, sympy.elliptic_pi, sympy.RootSum),
)
#: c for pairs turned to negative arguments: of u(-x) and v(-x) relative to u(x) and v(x), of I and K relative to J and Y.
_TURNS = [sign * c for c in (S.One, sympy.pi / 2, 2 / sympy.pi) for sign in (1, -1)]
#: Points at which the constant of a Wronskian is determined.
_WRONSKIAN_POINTS = [*map(sympy.Integer, (0, 1, -1, 2, 3, -2)), S.Half]


@dataclass(frozen=True)
class Basis:
    """Two solutions y1, y2 of the homogeneous equation in x, which is that of `equation` unless this has another variable."""

    y1: Expr
    y2: Expr
    x: Expr
    equation: Equation
    #: Puts the user's symbols, with what is known of them, into an expression.
    own: Callable[[Expr], Expr] = sympy.sympify
    #: Gives the Wronskian as the maker of the pair knows it, or None.
    stated: Callable[[], Expr | None] | None = None
    #: Where one of these is zero a member has no value.
    undefined: tuple[Expr, ...] = ()
    #: The answer of the engine.
    solution: Solution | None = None
    #: An integer that depends on parameters: these are the solutions where it isn't negative, `otherwise` those where it is.
    natural: Expr | None = None
    otherwise: Basis | None = None
    #: The pair of which these are combinations.
    before: Basis | None = None
    #: A point at which the members were written real; without one they are real beyond all singular points, as a rule.
    place: Expr | None = None
    #: The Liouvillian solutions that the members are, where the equation is one in x.
    form: ClosedForm | None = None

    @cached_property
    def wronskian(self) -> Expr:
        """W = y1 y2' - y1' y2."""
        W = self.stated and self.stated()
        if W is not None:
            constant, rest = W.as_independent(self.x, as_Add=False)
            if rest.is_rational_function(self.x):
                rest = min(rest, cancel(rest), key=size)
            return _simplified(constant) * powsimp(rest)
        w = in_x(self.equation, kernel(self.equation, self.place, self.own).xreplace(NUMBERS))
        w *= function_of_x(self.equation).diff(self.x)
        place = self.place
        if place is None:
            place = common_place(self.x, arguments_with_cuts(Tuple(self.y1, self.y2)), own=self.own)
        # as the members may be: (1 - x)^k for (x - 1)^k, x^k (1 - x)^k for (x - x^2)^k
        turned = with_positive_factors(all_turned(w, self.x, place, self.own), self.x, place)
        found = (multiple_of(v, self.y1, self.y2, self.x) for v in dict.fromkeys((w, turned)))
        W = next(filter(None, found), None)
        if W is None and self.before is not None and self.before.stated is not None:
            w = self.before.wronskian
            if self.place is not None:
                w = all_turned(w, self.x, self.place, self.own)
            # the pair is meant for integers, with `natural` not negative
            letters = Tuple(self.y1, self.y2).free_symbols - {self.x}
            integers = {s: self.own(s) for s in letters if self.own(s).is_integer}
            values = next(generic_samples({*integers.values()}, self.natural), {})
            values = {plain: s.xreplace(values) for plain, s in integers.items()}
            W = multiple_of(w, self.y1, self.y2, self.x, values)
        return definition(self.y1, self.y2, self.x) if W is None else W

    @property
    def constant(self) -> Expr:
        """The c of W = c w(x), up to a number."""
        return self.wronskian.as_independent(self.x, as_Add=False)[0]

    @property
    def scale(self) -> Expr:
        """The `constant` in the user's symbols if it is elementary, else 1."""
        scale = self.own(self.constant)
        return S.One if scale.is_zero or _has_functions(scale) or scale.has(sympy.Integral, self.x) else scale

    @cached_property
    def dependent(self) -> tuple[Expr, ...]:
        """Expressions in the letters: where one is zero, so is the constant of the Wronskian."""
        # Solutions for a `natural` integer were chosen to be independent.
        is_known = self.natural is None and not self.wronskian.has(*_WITHOUT_VALUES)
        return ZeroSet(self.own(self.constant)).factors if is_known else ()

    @cached_property
    def exceptions(self) -> tuple[Expr, ...]:
        """Where one of these is zero the members are dependent, or one of them is undefined."""
        undefined = map(self.own, self.undefined) if self.natural is None else ()
        return independent_exceptions([*self.dependent, *undefined])

    def of(self, y1: Expr, y2: Expr) -> Basis:
        """The basis of two combinations of the members."""
        is_same = (y1, y2) == (self.y1, self.y2)
        return self if is_same else replace(self, y1=y1, y2=y2, stated=None, before=self)

    @cached_property
    def rates(self) -> tuple[Expr, Expr]:
        """B and C of y'' + B y' + C y = 0 in x."""
        return monic_coefficients(self.equation, self.x)


def monic_coefficients(equation: Equation, x: Expr) -> tuple[Expr, Expr]:
    """B and C of y'' + B y' + C y = 0: t' b/a - t''/t' and t'^2 c/a for an equation in t = t(x)."""
    atoms = Atoms(sympy.Symbol(equation.variable))
    parts = (atoms.ratio(part / equation.a).xreplace(NUMBERS) for part in (equation.b, equation.c))
    b, c = (in_x(equation, part) for part in parts)
    slope = function_of_x(equation).diff(x)
    return b * slope - slope.diff(x) / slope, c * slope**2


def kernel(equation: Equation, place: Expr | None = None, own: Callable[[Expr], Expr] = sympy.sympify) -> Expr:
    """w = exp(-int b/a) up to a constant factor, in the variable of the equation; real at the place, if there is one."""
    atoms = Atoms(sympy.Symbol(equation.variable), at=place, own=own)
    return display(product(equation.gauge * 2), atoms, around_zero=True)


def definition(y1: Expr, y2: Expr, x: Expr) -> Expr:
    """y1 y2' - y1' y2, without the logarithms and integrals in which the members are linear: they cancel.

    >>> x = sympy.Symbol("x")
    >>> definition(x, x * sympy.log(x), x)
    x
    """
    W = y1 * slope(y2, x) - slope(y1, x) * y2
    for f in sorted((f for f in Tuple(y1, y2).atoms(*_ANTIDERIVATIVES) if f.has(x)), key=str):
        check_time()
        shorter = W.xreplace({f: S.Zero})
        W = shorter if _is_wronskian(shorter, y1, y2, x) else W
    if any(power.exp.free_symbols for power in W.atoms(Pow)):
        rate = cancel(slope(y2, x) / y2 - slope(y1, x) / y1)
        if rate.is_rational_function(x):
            return y1 * y2 * factor(rate)
    bases = radicands(W)
    # beside roots of numbers, with polynomials in several of these, SymPy takes minutes
    if bases and all(base.free_symbols for base in bases) and not W.has(*_WITHOUT_VALUES, Function):
        return factor(cancel(sympy.together(W)))
    return W


def multiple_of(
    w: Expr, y1: Expr, y2: Expr, x: Expr, integers: Mapping[Expr, Expr] = MappingProxyType({})
) -> Expr | None:
    """c w for the constant c with y1 y2' - y1' y2 = c w on each branch of the roots; None if it isn't found.

    c is the quotient at a point where it is elementary, or one of `_TURNS`.  It is checked with `integers` for letters.

    >>> x, k = sympy.symbols("x k")
    >>> multiple_of(1 / x, x**k, x**-k, x)
    -2*k/x
    """
    for quotient in chain(_TURNS, _quotients(w, y1, y2, x)):
        check_time()
        c = in_single_waves(quotient or 0)
        is_constant = c != 0 and not _has_functions(c) and not c.has(sympy.nan, sympy.zoo)
        if is_constant and _is_wronskian(c * w, y1, y2, x, integers):
            return _simplified(c) * w
    return None


def _quotients(w: Expr, y1: Expr, y2: Expr, x: Expr) -> Iterator[Expr | None]:
    """W/w at the points where both have values; then at 0, singular points and oo, where powers of W and w cancel."""
    W = definition(y1, y2, x)
    u = sympy.Dummy(positive=True)
    near = {S.Zero: u, sympy.oo: 1 / u}
    for point in _WRONSKIAN_POINTS:
        above, below = (finite_value(e, x, point) for e in (W, w))
        if below:
            yield above and above / below
        else:
            near[point] = point + u
    for value in near.values() if manageable(W) else ():
        # term by term: SymPy would expand the denominator of the quotient, too
        below = sympy.expand(w.subs(x, value), mul=False)
        terms = sympy.Add.make_args(sympy.expand(W.subs(x, value)))
        yield finite_value(powsimp(sympy.Add(*(term / below for term in terms))), u, S.Zero)
    if manageable(W):  # in x itself, where the exponents of powers of u have letters
        joined = powsimp(sympy.expand(W / w))
        yield from (finite_value(joined, x, point) for point in _WRONSKIAN_POINTS)


def _has_functions(c: Expr) -> bool:
    """True for functions other than exp, which has no zero."""
    return bool(c.atoms(Function) - c.atoms(sympy.exp))


def _is_wronskian(W: Expr, y1: Expr, y2: Expr, x: Expr, letters: Mapping[Expr, Expr] = MappingProxyType({})) -> bool:
    """True if W is the Wronskian at a point, and in each quadrant and on the axis if there are roots with their branches."""
    W, y1, y2 = (e.xreplace(letters) for e in (W, y1, y2))
    powers = Tuple(W, y1, y2).atoms(Pow)
    has_branches = any(p.base.has(x) and not p.exp.is_Integer for p in powers)
    with working_digits(2 * DIGITS), suppress(NotImplementedError):
        for point in quadrant_points() if has_branches else islice(quadrant_points(), 1):
            (u, du, _), (v, dv, _), (w, _, _) = (jet(e, x, point) for e in (y1, y2, W))
            if not abs(u * dv - du * v - w) < arb(10) ** -DIGITS * (abs(u * dv) + abs(du * v)):
                return False
        return True
    return False


def _simplified(c: Expr) -> Expr:
    """A constant in a short form, with its gamma functions and waves."""
    c = c.replace(lambda e: e.is_Pow and e.base.is_number, lambda e: e.base ** cancel(e.exp))
    if any(not p.exp.is_number for p in c.atoms(Pow)):  # b^(c/a) b^(1 - c/a) is b
        c = powsimp(c)
    if c.has(Function):
        return sympy.factor_terms(c)
    if c.free_symbols and c.is_rational_function():
        return factor(cancel(c))
    return sympy.radsimp(c, symbolic=False)
