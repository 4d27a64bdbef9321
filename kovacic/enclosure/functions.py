"""Equations y'' + b y' + c y = f whose coefficients are functions of x that aren't rational, and values in another variable.

Where an equation is rational in t = exp(k x), sin(k x), ... it is Y'' + p Y' + q Y = r in t, reduced exactly, and with
t'^2 = k^2 sigma(t), sigma a polynomial, so that t'' = k^2 sigma'(t)/2,

    y'' + t' (p - sigma'/(2 sigma)) y' + k^2 sigma q y = k^2 sigma r,        y(x) = Y(t(x)).                              (1)

The brackets are rational functions of t in lowest terms, so that factors which cancel give no singular points.  For t = tan(u)
they are written in sin(u) and cos(u), since a pole of t may be regular for the equation.  Other equations are taken as written.

An equation that is rational in t = exp(k x + c) is evaluated in t.  The guarantee is that of `kovacic.enclosure.journey`, for
y(x) = Y(t(x)).  Where k and x are real, t is real, positive and monotone: a segment of the x-axis is mapped onto a segment of
the t-axis, so that the straight way in t continues the same solution.  Points are carried through as balls, and
y' = t' Y'.  A wave exp(i k x) doesn't map segments onto segments; there discs in x serve as well.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import sympy
from flint import acb

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms
from kovacic.enclosure.points import Constant, Number, are_real, in_balls, to_ball
from kovacic.enclosure.precision import PointValue
from kovacic.enclosure.problem import Coefficients, NumericProblem, as_problem, change_of
from kovacic.enclosure.request import Params
from kovacic.enclosure.start import ReadStart
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded, NotRational
from kovacic.limits import Limits
from kovacic.reading.change_of_variable import SQUARES, function_of_x, is_of_a_line, user_variable, without_change
from kovacic.reading.read import read_input
from kovacic.reading.source import parts_of, source_of


def coefficients_of_any(equation: Any, params: Params, limits: Limits) -> Coefficients:
    """The coefficients of an equation that isn't rational: a text, a SymPy expression, or one that was read or solved.

    Raises InputError unless it is a linear equation of second order with values for its parameters.
    """
    if isinstance(equation, Coefficients):
        return equation if equation.values else equation.given(params)
    if change_of(equation) is not None:
        return _of_parsed(equation).given(params)
    read = _coefficients_of_text if isinstance(equation, str) else _of_input
    return read(equation, limits).given(params)


_WITH_POLES = (sympy.tan, sympy.cot, sympy.sec, sympy.csc, sympy.tanh, sympy.coth, sympy.sech, sympy.csch)


@lru_cache(maxsize=64)
def _coefficients_of_text(text: str, limits: Limits) -> Coefficients:
    return _of_input(text, limits)


def _of_input(equation: Any, limits: Limits) -> Coefficients:
    """The coefficients as written if nothing can cancel; else by way of t, where common factors are removed."""
    parsed = None
    try:
        parsed = read_input(equation, limits=limits, exponentials=True)
    except NotRational:
        pass
    except LimitExceeded as reason:
        if reason.limit != "constants":  # balls need no field of constants
            raise
    written = as_written(equation, None, limits)
    if change_of(parsed) is None:
        return written
    if all(_nothing_cancels(part, written.variable) for part in written.parts):
        return replace(written, changed=parsed)
    return _of_parsed(parsed)


def _nothing_cancels(part: Any, x: Any) -> bool:
    """True if at most one term is singular anywhere, a constant times a power of one function, as in cos(x) + 2*tan(x/5)^2."""

    def is_singular(term: Any) -> bool:
        inverses = (power for power in term.atoms(sympy.Pow) if power.exp.is_negative)
        return term.has(*_WITH_POLES) or any(power.base.has(x) for power in inverses)

    singular = [term for term in sympy.Add.make_args(part) if is_singular(term)]
    if len(singular) != 1:
        return not singular
    _, varying = singular[0].as_independent(x, as_Add=False)
    return varying == 1 or isinstance(varying.as_base_exp()[0], sympy.Function)


def _of_parsed(parsed: Any) -> Coefficients:
    """The coefficients of an equation in t, without letters for constants."""
    found = in_the_given_variable(parsed.equation)
    # A letter may stand in the meaning of a later one: the last one is replaced first.
    for letter, meaning in reversed(getattr(parsed, "letters", ())):
        b, c, f = (part.xreplace({sympy.Symbol(letter): meaning}) for part in found.parts)
        found = Coefficients(found.variable, b, c, f)
    return replace(found, changed=parsed)


def as_written(equation: Any, var: Any, limits: Limits, names: Collection[str] = ()) -> Coefficients:
    """The coefficients as written, over that of y''."""
    name = None if var is None else str(var)
    source = source_of(equation, name, limits, names=names)
    # a y'' + b y' + c y + rest = 0.
    (a, b, c, rest), _ = parts_of(source)
    return Coefficients(sympy.Symbol(source.variable), b / a, c / a, -rest / a)


@lru_cache(maxsize=64)
def in_the_given_variable(equation: Equation) -> Coefficients:
    """Equation (1)."""
    t = function_of_x(equation)
    x = user_variable(equation)
    h = equation.h or 0  # over the coefficient of y'', in x
    if not is_of_a_line(equation):  # t' b/a - t''/t', t'^2 c/a and t'^2 f/a
        atoms = Atoms(sympy.Dummy("t"))
        p, q, r = (
            atoms.ratio(part / equation.a).xreplace({atoms.x: t}) for part in (equation.b, equation.c, equation.f)
        )
        slope = t.diff(x)
        return Coefficients(x, slope * p - slope.diff(x) / slope, slope**2 * q, slope**2 * r + h)
    # u = k x + c, rate = k.  In u equation (1) is y.. + t. (p - sigma'/(2 sigma)) y. + sigma q y = sigma r; in x
    # the middle coefficient is multiplied by k, the others by k^2.
    rate, slope = t.args[0].diff(x), t.diff(x)
    field = equation.a.field
    sigma = RatFunc(_sigma(t, field))
    b = equation.b / equation.a - sigma.derivative() / (2 * sigma)
    c = sigma * equation.c / equation.a
    f = sigma * equation.f / equation.a
    # t. = 1 + t^2 is taken into the bracket, so that one quotient of sines and cosines is left.
    if t.func is sympy.tan:  # a polynomial in t
        slope = rate
        b *= RatFunc(field.poly([1, 0, 1]))
    if t.func is sympy.exp and t.has(sympy.I):
        T = RatFunc(field.x)
        p, q, r = _wave_quotient(t, b * T, rate), _wave_quotient(t, c, rate**2), _wave_quotient(t, f, rate**2)
    else:
        p, q, r = slope * _in_t(t, b), rate**2 * _in_t(t, c), rate**2 * _in_t(t, f)
    return Coefficients(x, p, q, r + h)


def _sigma(t: Any, field: Field) -> Poly:
    """(dt/du)^2 for t(u), as a polynomial in t."""
    # SQUARES has it as a function of t: 1 - t^2 where t is sin(u) or cos(u), (1 + t^2)^2 where it is tan(u).
    T = sympy.Dummy()
    coefficients = sympy.Poly(SQUARES[t.func](T), T).all_coeffs()
    return field.poly([int(c) for c in reversed(coefficients)])


def _in_t(t: Any, function: RatFunc) -> Any:
    """A rational function of t, as an expression; 1 - cos(u)^2 in its denominator becomes sin(u)^2, sharper in balls."""
    atoms = Atoms(sympy.Dummy("t"))
    if t.func is sympy.tan:
        return _in_sines(t.args[0], function, atoms)
    u = sympy.Dummy("u")
    # sigma = (dt/du)^2, so 1/sigma^n is dt/du to the power -2 n.
    root = t.func(u).diff(u).xreplace({u: t.args[0]})
    denominator, powers = _without_factor(function.den, _sigma(t, function.field))
    rest = atoms.ratio(RatFunc(function.num, denominator, reduced=True)).xreplace({atoms.x: t})
    return rest * root ** (-2 * powers)


def _wave_quotient(t: Any, function: RatFunc, factor: Any) -> Any:
    """A constant times a rational function N/D of t = exp(i u), by cosines and sines of multiples of u.

    With h half the sum of the lowest and the highest exponent in D both t^-h N and t^-h D are sums of c_k exp(i (k - h) u).
    Where the quotient is real for real u, D is its own reversed conjugate up to a number of size 1, so that there is a constant
    w for which w t^-h D is real, and then w t^-h N is.
    """
    atoms = Atoms(sympy.Dummy("t"))
    u = sympy.expand(-sympy.I * t.args[0])
    below = list(atoms.coefficients(function.den))
    lowest = next(k for k, c in enumerate(below) if c != 0)
    half = sympy.Rational(lowest + len(below) - 1, 2)
    first, last = (
        sympy.conjugate(c).xreplace({sympy.conjugate(s): s for s in c.free_symbols}) for c in (below[lowest], below[-1])
    )
    # The sum may be 0; i times the difference makes D its own reversed conjugate as well.
    w = first + last or sympy.I * (first - last)
    above = [w * factor * c for c in atoms.coefficients(function.num)]
    return _by_waves(above, half, u) / _by_waves([w * c for c in below], half, u)


def _by_waves(coefficients: Sequence[Any], shift: Any, u: Any) -> Any:
    """sum c_k exp(i (k - shift) u), by cosines and sines."""
    angles = ((c, sympy.expand((k - shift) * u)) for k, c in enumerate(coefficients))
    return sympy.expand(sympy.Add(*(c * (sympy.cos(angle) + sympy.I * sympy.sin(angle)) for c, angle in angles)))


def _without_factor(poly: Poly, factor: Poly) -> tuple[Poly, int]:
    """The polynomial without this factor, and how often it is there."""
    count = 0
    while poly.degree >= factor.degree and not poly % factor:
        poly //= factor
        count += 1
    return poly, count


def _in_sines(u: Any, function: RatFunc, atoms: Atoms) -> Any:
    """A rational function of tan(u) by sin(u) and cos(u)."""

    # tan = sin/cos: a polynomial of degree n is a form of degree n in sin and cos, over cos^n.
    def homogeneous(poly: Poly) -> Any:
        """sum c_k sin(u)^k cos(u)^(n - k) by waves: powers of both may cancel, as in sin^2 + cos^2, which balls don't see."""
        n = poly.degree
        e = sympy.Dummy("exp(iu)")
        sine, cosine = (e**2 - 1) / (2 * sympy.I), (e**2 + 1) / 2  # times e
        terms = (c * sine**k * cosine ** (n - k) for k, c in enumerate(atoms.coefficients(poly)) if c != 0)
        return _by_waves(sympy.Poly(sympy.Add(*terms), e).all_coeffs()[::-1], n, u)

    n = -function.degree
    return homogeneous(function.num) / homogeneous(function.den) * sympy.cos(u) ** n


@dataclass(frozen=True)
class Substitution:
    """t as a function of x, and the equation in t."""

    t: Any
    x: Any
    problem: NumericProblem

    @classmethod
    def of(cls, coefficients: Coefficients) -> Substitution | None:
        """The substitution of an equation that is rational in an exponential of x, or None."""
        changed: Any = coefficients.changed
        # Letters for constants would be parameters of the equation in t.
        if changed is None or getattr(changed, "letters", None):
            return None
        t = function_of_x(changed.equation)
        if t.func is not sympy.exp or t.free_symbols != {coefficients.variable}:
            return None
        values: dict[str, object] = dict(coefficients.values)
        with suppress(NotRational):
            problem = as_problem(without_change(changed), values or None, forced=True, constants=True)
            return cls(t, coefficients.variable, problem)
        return None

    def image(self, x: Number) -> Number:
        """t at a number, to every precision that this has."""
        return Constant(f"t({x})", lambda: in_balls(self.t, {self.x: to_ball(x)}), x.fixed)

    def slope(self, x: Number) -> acb:
        """dt/dx at a number, at the working precision in force."""
        return in_balls(self.t.diff(self.x), {self.x: to_ball(x)})

    def start(self, x0: Number, data: tuple[Number, Number]) -> ReadStart:
        """The start in t for these values of y and y'."""
        y, dy = data
        slope = Constant("y'/t'", lambda: to_ball(dy) / self.slope(x0), dy.fixed or x0.fixed)
        return ReadStart(self.image(x0), (y, slope))

    def is_real(self, numbers: Sequence[Number]) -> bool:
        """True if these numbers, and t and its derivative there, are real."""
        with working_precision(64):
            return are_real([f(x) for x in numbers for f in (to_ball, lambda x: to_ball(self.image(x)), self.slope)])

    def seen(self, target: Number, value: PointValue) -> PointValue:
        """The value at t(target) as one at the target: y' = t' Y'."""
        # The state has 40 bits more than its route, and the slope needs as many.
        with working_precision(value.route.bits + 128):
            y, dy = value.state
            return replace(value, x=target, state=(y, dy * self.slope(target)))
