"""`Basis`: two independent solutions that know their Wronskian, its constant, and for which letters they are no basis.

By Abel, y1 y2' - y1' y2 = c w(x) with w = exp(-int b/a dx): a pair carries its constant c in the letters.  Special functions
come with theirs from `special`; in elementary functions c is the quotient at one ordinary point, and with integrals that
cancel the definition says it.
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
from sympy import expand

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.cuts import all_turned
from kovacic.closed_form.form import ClosedForm
from kovacic.closed_form.jets import jet
from kovacic.closed_form.product import product
from kovacic.closed_form.way_back import in_x
from kovacic.equation import Equation
from kovacic.general_solution.integrands import NUMBERS, radicands
from kovacic.general_solution.substitution import finite_value, in_single_waves, size, slope
from kovacic.general_solution.zero import fitting_samples, points
from kovacic.general_solution.zero_set import ZeroSet, without_implied
from kovacic.limits import check_time
from kovacic.reading.change_of_variable import function_of_x
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
_NONE: Mapping[Any, Any] = MappingProxyType({})
#: Functions whose values at points aren't known in closed form.
_UNKNOWN = (sympy.RootSum, sympy.Integral)
#: Functions that occur as antiderivatives, beside others in a sum.
_ANTIDERIVATIVES = (
    *(sympy.Integral, sympy.log, sympy.asin, sympy.acos, sympy.atan, sympy.asinh, sympy.acosh, sympy.atanh, sympy.Ei),
    *(sympy.erf, sympy.erfi, sympy.uppergamma, sympy.elliptic_e, sympy.elliptic_f, sympy.elliptic_pi, sympy.RootSum),
)
#: Quotients of the Wronskians of u(x) and v(x) and those of u(-x) and v(-x), of J and Y and those of I and K.
_TURNS = [sign * c for c in (sympy.Integer(1), sympy.pi / 2, 2 / sympy.pi) for sign in (1, -1)]
#: Points at which the constant of a Wronskian is determined.
_POINTS = [*map(sympy.Integer, (0, 1, -1, 2, 3, -2)), sympy.S.Half]
#: The longest Wronskian whose powers are joined, in subexpressions.
_LONGEST_JOINED = 300


@dataclass(frozen=True)
class Basis:
    """Two solutions of the homogeneous equation in x, which is that of `equation` unless this has another variable.

    Attributes
    ----------
    y1, y2, x : sympy.Expr
        The members, and their variable.
    equation : Equation
        It gives w(x), the part of the Wronskian that depends on x.
    own
        Puts the user's symbols, with what is known of them, into an expression.
    stated
        Gives the Wronskian as the maker of the pair knows it, or None.
    undefined : tuple of sympy.Expr
        Where one of these is zero a member has no value.
    solution : Solution or None
        What the engine decided.
    natural : sympy.Expr or None
        An integer that depends on parameters: these are the solutions where it isn't negative.
    otherwise : Basis or None
        Those where it is negative, if they are known.
    before : Basis or None
        The pair of which these are combinations.
    place : sympy.Expr or None
        A point at which the members were written real; without one they are real beyond all singular points, as a rule.
    form : ClosedForm or None
        The Liouvillian solutions that the members are, where the equation is one in x.
    """

    y1: Expr
    y2: Expr
    x: Expr
    equation: Equation
    own: Callable[[Expr], Expr] = sympy.sympify
    stated: Callable[[], Expr | None] | None = None
    undefined: tuple[Expr, ...] = ()
    solution: Solution | None = None
    natural: Expr | None = None
    otherwise: Basis | None = None
    before: Basis | None = None
    place: Expr | None = None
    form: ClosedForm | None = None

    @cached_property
    def wronskian(self) -> Expr:
        """W = y1 y2' - y1' y2."""
        W = None if self.stated is None else self.stated()
        if W is not None:
            constant, rest = W.as_independent(self.x, as_Add=False)
            if rest.is_rational_function(self.x):
                rest = min(rest, sympy.cancel(rest), key=size)
            return _simplified(constant) * sympy.powsimp(rest)
        w = kernel(self.equation, self.place, self.own).xreplace(NUMBERS)
        if self.equation.change is not None:
            w = in_x(self.equation, w) * function_of_x(self.equation).diff(self.x)
        W = multiple_of(w, self.y1, self.y2, self.x)
        if W is None and self.before is not None and self.before.stated is not None:
            w = self.before.wronskian
            if self.place is not None:
                w = all_turned(w, self.x, self.place, self.own)
            W = multiple_of(w, self.y1, self.y2, self.x, self._integers)
        return definition(self.y1, self.y2, self.x) if W is None else W

    @property
    def _integers(self) -> dict[Expr, Expr]:
        """Values of the letters that stand for integers, for which the pair is meant."""
        letters = {s: self.own(s) for s in sympy.Tuple(self.y1, self.y2).free_symbols - {self.x}}
        integers = {s: own for s, own in letters.items() if own.is_integer}
        values = next(fitting_samples({*integers.values()}, self.natural), {})
        return {plain: values.get(s, s) for plain, s in integers.items()}

    @property
    def constant(self) -> Expr:
        """The c of W = c w(x), up to a number."""
        return self.wronskian.as_independent(self.x, as_Add=False)[0]

    @cached_property
    def dependent(self) -> tuple[Expr, ...]:
        """Expressions in the letters: where one is zero, so is the constant of the Wronskian."""
        is_known = self.natural is None and not self.wronskian.has(*_UNKNOWN)  # that was chosen for independent members
        return ZeroSet(self.own(self.constant)).factors if is_known else ()

    @cached_property
    def exceptions(self) -> tuple[Expr, ...]:
        """Where one of these is zero the members are dependent, or one of them is undefined."""
        undefined = map(self.own, self.undefined) if self.natural is None else ()
        return without_implied([*self.dependent, *undefined])

    def of(self, y1: Expr, y2: Expr) -> Basis:
        """Combinations of the members; the same ones are the same pair."""
        if (y1, y2) == (self.y1, self.y2):
            return self
        return replace(self, y1=y1, y2=y2, stated=None, before=self)

    @cached_property
    def rates(self) -> tuple[Expr, Expr]:
        """B and C of y'' + B y' + C y = 0 in x: t' b/a - t''/t' and t'^2 c/a, where the equation is one in t = t(x)."""
        equation = self.equation
        atoms = Atoms(sympy.Symbol(equation.variable))
        b, c = (atoms.ratio(part / equation.a).xreplace(NUMBERS) for part in (equation.b, equation.c))
        if equation.change is None:
            return b, c
        slope = function_of_x(equation).diff(self.x)
        b, c = in_x(equation, b), in_x(equation, c)
        return b * slope - slope.diff(self.x) / slope, c * slope**2


def kernel(equation: Equation, place: Expr | None = None, own: Callable[[Expr], Expr] = sympy.sympify) -> Expr:
    """w = exp(-int b/a), without numbers as factors, in the variable of the equation; with a place it is real there."""
    atoms = Atoms(sympy.Symbol(equation.variable), at=place, own=own)
    return display(product(equation.gauge * 2), atoms, around_zero=True)


def definition(y1: Expr, y2: Expr, x: Expr) -> Expr:
    """y1 y2' - y1' y2, without the logarithms and integrals that the members are linear in: any constant serves for these.

    >>> x = sympy.Symbol("x")
    >>> definition(x, x * sympy.log(x), x)
    x
    """
    W = y1 * slope(y2, x) - slope(y1, x) * y2
    for f in sorted((f for f in sympy.Tuple(y1, y2).atoms(*_ANTIDERIVATIVES) if f.has(x)), key=str):
        check_time()
        shorter = W.xreplace({f: sympy.S.Zero})
        if _is_wronskian(shorter, y1, y2, x, _NONE):
            W = shorter
    if any(power.exp.free_symbols for power in W.atoms(sympy.Pow)):
        rate = sympy.cancel(slope(y2, x) / y2 - slope(y1, x) / y1)
        if rate.is_rational_function(x):
            return y1 * y2 * sympy.factor(rate)
    bases = radicands(W)
    # beside roots of numbers, with polynomials in several of these, SymPy takes minutes
    if bases and all(base.free_symbols for base in bases) and not W.has(*_UNKNOWN, sympy.Function):
        return sympy.factor(sympy.cancel(sympy.together(W)))
    return W


def multiple_of(w: Expr, y1: Expr, y2: Expr, x: Expr, integers: Mapping[Expr, Expr] = _NONE) -> Expr | None:
    """c w for the constant c with y1 y2' - y1' y2 = c w on each branch of the roots; None if it isn't found.

    c is the quotient at a point where it is elementary, or one that other branches of Bessel's functions have.  It is checked
    with `integers` for letters that stand for these.

    >>> x, k = sympy.symbols("x k")
    >>> multiple_of(1 / x, x**k, x**-k, x)
    -2*k/x
    """
    for quotient in chain(_quotients(w, y1, y2, x), _TURNS):
        check_time()
        c = in_single_waves(quotient or 0)
        is_constant = c != 0 and c.is_finite is not False and not c.has(sympy.Function, sympy.nan, sympy.zoo)
        if is_constant and _is_wronskian(c * w, y1, y2, x, integers):
            return _simplified(c) * w
    return None


def _quotients(w: Expr, y1: Expr, y2: Expr, x: Expr) -> Iterator[Expr | None]:
    """W/w at the points where it has a value; last, at singular ones, where powers of W and w cancel."""
    W = definition(y1, y2, x)
    for point in _POINTS:
        above, below = (finite_value(e, x, point) for e in (W, w))
        if below:
            yield above and above / below
    if size(W) <= _LONGEST_JOINED:
        joined = sympy.powsimp(expand(W / w))
        yield from (finite_value(joined, x, point) for point in _POINTS)


def _is_wronskian(W: Expr, y1: Expr, y2: Expr, x: Expr, letters: Mapping[Expr, Expr]) -> bool:
    """True if W is the Wronskian at a point; in each quadrant and on the axis if there are roots, with their branches."""
    W, y1, y2 = (e.xreplace(letters) for e in (W, y1, y2))
    powers = sympy.Tuple(W, y1, y2).atoms(sympy.Pow)
    has_branches = any(p.base.has(x) and not p.exp.is_Integer for p in powers)
    with working_digits(2 * DIGITS), suppress(NotImplementedError):
        for point in points() if has_branches else islice(points(), 1):
            (u, du, _), (v, dv, _), (w, _, _) = (jet(e, x, point) for e in (y1, y2, W))
            if not abs(u * dv - du * v - w) < arb(10) ** -DIGITS * (abs(u * dv) + abs(du * v)):
                return False
        return True
    return False


def _simplified(c: Expr) -> Expr:
    """A constant in a short form: gamma functions and waves stay."""
    c = c.replace(lambda e: e.is_Pow and e.base.is_number, lambda e: e.base ** sympy.cancel(e.exp))
    if any(not p.exp.is_number for p in c.atoms(sympy.Pow)):  # b^(c/a) b^(1 - c/a) is b
        c = sympy.powsimp(c)
    if c.has(sympy.Function):
        return sympy.factor_terms(c)
    if c.free_symbols and c.is_rational_function():
        return sympy.factor(sympy.cancel(c))
    return sympy.radsimp(c, symbolic=False)
