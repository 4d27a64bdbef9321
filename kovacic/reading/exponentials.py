"""Coefficients that are rational in exp(k x): in sin, cos, tan, sinh, cosh, tanh, ... of multiples of k x.

With t = exp(k x), d/dx = k t d/dt turns a y'' + b y' + c y = f into an equation with rational coefficients,

    k^2 t^2 a Y'' + (k^2 t a + k t b) Y' + c Y = f,        y(x) = Y(exp(k x)),                                          (1)

with the same differential Galois group, since C(exp(k x)) with d/dx is C(t) with k t d/dt.  Where everything depends on t^g
alone, t^g is the variable.  Trigonometric functions have k = i kappa.  Other variables are cosh(k x), sinh(k x), cos(kappa x)
and sin(kappa x), where the equation is invariant under t -> 1/t or t -> -1/t; and t = tan(kappa x/2), where the coefficients
would not be real: exp(i kappa x) = (1 + i t)/(1 - i t).  The way back is `change_of_variable`.

Reference: P. Acosta-Humanez & D. Blazquez-Sanz, Non-integrability of some Hamiltonians with rational potentials, Discrete and
Continuous Dynamical Systems B 10 (2008) 265-293 (Hamiltonian algebrization).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from math import gcd
from typing import Any, NamedTuple

import sympy
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import UNKNOWN, Change, Equation, Parsed, lowered, over
from kovacic.errors import NotRational
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text
from kovacic.reading.parts import parts_of, source_of_parts
from kovacic.reading.source import Source, read_source, source_of

_HINT = "coefficients are rational in x, or in exp(k*x) and sines, cosines, ... of rational multiples of k*x"


def in_exponentials(source: Source, limits: Limits) -> Parsed | None:
    """The equation (1) for an input with such coefficients; None for any other input.

    What isn't rational in exp(k x) on the right-hand side is kept as the equation's h, and with numbers that aren't algebraic
    all of it.  Raises `NotRational` where x occurs beside exp(k x), and for rates whose quotient isn't rational.
    """
    x = sympy.Symbol(source.variable)
    parts, notices = parts_of(source, limits)
    rewritten = [_in_exponentials(part, x) for part in parts]
    if all(part.is_rational_function(x) for part in rewritten[:3]):
        with suppress(NotRational):  # everything else cancels, or has the factor 0
            return read_source(source_of_parts(rewritten, source), limits)
    T = sympy.Dummy("T")
    common = _common_power_of_parts(rewritten, x, T)
    if common is None:
        return None
    in_T = [part.xreplace(common.powers) for part in rewritten[:3]]
    if any(part.has(x) for part in in_T):
        said = f"{x} beside exp({common.k * x}): that isn't rational in one exponential function"
        raise NotRational(said, hint=_HINT)
    right = _right_side(parts[3], x, common.powers)
    unknown = source.unknown or UNKNOWN
    t = new_variable((*in_T, right.in_T, common.k), {x.name, unknown})
    left = _left_side(in_T, common.k, T, sympy.Function(f"{unknown}_")(t))
    read = _read_in(t, (left - right.in_T).xreplace({T: t}), limits)
    h = right.in_x
    if read.equation.h is not None:  # numbers such as pi and log(2) are among the factors: as a whole it stays in x
        h = -parts[3]
        read = _read_in(t, left.xreplace({T: t}), limits)
    best = _best(read.equation, common.k, x + common.offset)
    expression = as_text(best.function)
    result = replace(
        _without_denominators(best.monic),
        h=h and h / parts[0],
        variable=t.name,
        unknown=unknown,
        change=Change(x.name, expression),
    )
    said = f"in {t} = {expression}: {result}"
    return Parsed(result.S, t.name, (said, *notices, *read.notices), result, read.letters)


def _left_side(in_T: Sequence[Any], k: Any, T: Any, Y: Any) -> Any:
    """That of (1), for a function Y of one variable, from a, b and c in T."""
    a, b, c = in_T
    (t,) = Y.args
    return k**2 * T**2 * a * Y.diff(t, 2) + (k**2 * T * a + k * T * b) * Y.diff(t) + c * Y


class _ReadEquation(NamedTuple):
    """An equation, and what the user should know about how it was read."""

    equation: Equation
    notices: tuple[str, ...]
    letters: tuple[tuple[str, Any], ...]


def _read_in(t: Any, expression: Any, limits: Limits) -> _ReadEquation:
    """The equation that says that an expression with an unknown function of t is zero."""
    read = read_source(source_of(expression, t.name, limits, equation=True), limits)
    assert read.equation is not None
    return _ReadEquation(read.equation, read.notices, read.letters)


def _without_denominators(monic: Monic) -> Equation:
    """Y'' + p Y' + q Y = f times the common denominator of p and q."""
    p, q, f = monic
    a = RatFunc(p.den * (q.den // p.den.gcd(q.den)))
    return Equation(a, p * a, q * a, f * a)


def _common_power_of_parts(parts: list[Any], x: Any, T: Any) -> CommonPower | None:
    """That of a, b, c and the right-hand side, or of a, b and c alone; None where these three have no exponentials."""
    exponentials = [{e for e in part.atoms(sympy.exp) if e.has(x)} for part in parts]
    of_coefficients = set().union(*exponentials[:3])
    if not of_coefficients:
        return None
    try:
        return common_power(set().union(*exponentials), x, T)
    except NotRational:
        return common_power(of_coefficients, x, T)


def new_variable(parts: Sequence[Any], taken: set[str]) -> Any:
    """A symbol for the new variable: t, or another letter that neither the parts have nor is `taken`."""
    names = taken.union(*({symbol.name for symbol in part.free_symbols} for part in parts))
    return sympy.Symbol(next(name for name in ("t", "s", "z", "w", "t_", "s_") if name not in names))


class _RightSide(NamedTuple):
    """The sum of the terms of a right-hand side that are rational in T, and of the others in x, None if there are none."""

    in_T: Any
    in_x: Any


def _right_side(rest: Any, x: Any, powers: dict[Any, Any]) -> _RightSide:
    """The right-hand side -rest; `powers` are the exponentials in T."""
    in_T = [sympy.Integer(0)]
    in_x = []
    for term in sympy.Add.make_args(sympy.expand(-rest)):
        rewritten = _in_exponentials(term, x).xreplace(powers)
        free = rewritten.free_symbols | rewritten.atoms(AppliedUndef)
        if rewritten.is_rational_function(*free) and not rewritten.has(x):
            in_T.append(rewritten)
        else:
            in_x.append(term)
    if not in_x:
        return _RightSide(sympy.Add(*in_T), None)
    return _RightSide(sympy.Add(*in_T), sympy.Add(*in_x))


def _in_exponentials(expression: Any, x: Any) -> Any:
    """The expression with exp(k x) in the place of sin(x), tanh(x), 2^x, ..."""

    def is_such(e: Any) -> bool:
        return isinstance(e, TrigonometricFunction | HyperbolicFunction) or bool(e.is_Pow and e.exp.has(x))

    return expression.replace(is_such, lambda e: e.rewrite(sympy.exp, deep=False))


class CommonPower(NamedTuple):
    """Exponentials as `powers` of T = exp(k (x + offset)), times numbers."""

    k: Any
    offset: Any
    powers: dict[Any, Any]


class _ExponentLine(NamedTuple):
    """The exponent of exp(rate x + shift)."""

    rate: Any
    shift: Any

    def left_by(self, offset: Any) -> Any:
        """The constant c with exp(rate x + shift) = c exp(rate (x + offset))."""
        return sympy.exp(sympy.expand(self.shift - self.rate * offset))


def common_power(exponentials: set[Any], x: Any, T: Any) -> CommonPower:
    """The power of which all are powers; its offset leaves as few constants exp(n) as can be."""
    lines = {e: _line_of(e, x) for e in sorted(exponentials, key=str)}
    first = next(iter(lines.values())).rate
    ratios = {e: sympy.cancel(line.rate / first) for e, line in lines.items()}
    if not all(ratio.is_Rational for ratio in ratios.values()):
        raise NotRational(f"exponentials of {x} whose rates have no rational quotient", hint=_HINT)
    unit = _common_unit([*ratios.values()])
    k = sympy.expand(first * unit)
    if k.could_extract_minus_sign():
        k = -k
        unit = -unit
    offset = _best_offset([*lines.values()])
    powers: dict[Any, Any] = {}
    for e, line in lines.items():
        constant = line.left_by(offset)
        if not all(power.exp.is_Integer for power in constant.atoms(sympy.exp)):
            raise NotRational(f"{e} has a constant in its exponent", hint=f"write a letter for the factor {constant}")
        powers[e] = constant * T ** (ratios[e] / unit)
    return CommonPower(k, offset, powers)


def _line_of(e: Any, x: Any) -> _ExponentLine:
    """The exponent of an exponential as a polynomial of degree 1 in x."""
    argument = sympy.expand(e.exp)
    line = _ExponentLine(rate=argument.coeff(x, 1), shift=argument.coeff(x, 0))
    if sympy.expand(argument - line.rate * x - line.shift) != 0 or line.rate.has(x):
        raise NotRational(f"{e} isn't the exponential function of a multiple of {x}", hint=_HINT)
    return line


def _common_unit(ratios: list[Any]) -> Any:
    """The greatest rational number of which all are multiples."""
    common = int(sympy.ilcm(*(ratio.q for ratio in ratios), 1))
    return sympy.Rational(gcd(*(int(ratio.p * common // ratio.q) for ratio in ratios)), common)


def _best_offset(lines: list[_ExponentLine]) -> Any:
    """0, or what the exponents vanish with, whichever leaves the fewest constants; the first one among equals."""

    def constants_left(offset: Any) -> int:
        return sum(line.left_by(offset).has(sympy.exp, sympy.E) for line in lines)

    offsets = [sympy.Integer(0), *(sympy.expand(line.shift / line.rate) for line in lines)]
    return min(offsets, key=constants_left)


Monic = tuple[RatFunc, RatFunc, RatFunc]


class _InVariable(NamedTuple):
    """The equation in a variable, and this as a function of x."""

    monic: Monic
    function: Any


@dataclass(frozen=True)
class _ThetaEquation:
    """theta^2 Y + P theta Y + Q Y = F with theta = T d/dT."""

    P: RatFunc
    Q: RatFunc
    F: RatFunc

    @property
    def step(self) -> int:
        """The largest g for which everything depends on T^g."""
        exponents: set[int] = set()
        for part in (self.P, self.Q, self.F):
            exponents |= _exponents(part.num) | _exponents(part.den)
        return gcd(*exponents) or 1

    def in_power(self, g: int) -> _ThetaEquation:
        """The equation in T^g."""
        P, Q, F = (_deflated(part, g) for part in (self.P, self.Q, self.F))
        return _ThetaEquation(P / g, Q / g**2, F / g**2)

    @property
    def monic(self) -> Monic:
        """With derivatives by T."""
        T = RatFunc(self.P.field.poly([0, 1]))
        return (self.P + 1) / T, self.Q / T**2, self.F / T**2


def _exponents(poly: Poly) -> set[int]:
    """The exponents of the terms that occur."""
    return {i for i, c in enumerate(poly) if c}


def _best(equation: Equation, k: Any, x: Any) -> _InVariable:
    """Y'' + p Y' + q Y = f in the variable that has real coefficients if one has, and then the fewest singular points."""
    kappa = sympy.expand(-sympy.I * k)
    is_trigonometric = not kappa.has(sympy.I)
    rate = k
    field = equation.a.field
    i = None
    if is_trigonometric:
        rate = kappa
        field, i = _with_i(field)
    T = RatFunc(field.poly([0, 1]))
    p, q, f = (over(part / equation.a, field) for part in (equation.b, equation.c, equation.f))
    form = _ThetaEquation(p * T - 1, q * T * T, f * T * T)
    g = form.step
    exponential = form.in_power(g).monic
    found = [_InVariable(exponential, sympy.exp(sympy.expand(g * k * x)))]
    steps = (g, g // 2) if g % 2 == 0 else (g,)
    for h in steps:
        angle = sympy.expand(h * rate * x)
        if is_trigonometric:
            found += _in_trigonometric(form.in_power(h), i, angle)
        else:
            found += _in_hyperbolic(form.in_power(h), angle)
    if i is not None:
        tangent = _substituted(exponential, (1 + T * i) / (1 - T * i))
        found.append(_InVariable(tangent, sympy.tan(sympy.expand(g * rate * x / 2))))
    over_base = [_InVariable(_over_base(*each.monic), each.function) for each in found]
    angles = [sympy.expand(h * rate * x) for h in (1, g // 2)]
    return min(over_base, key=partial(_preference, angles))


def _with_i(field: Field) -> tuple[Field, Poly | None]:
    """The field with the imaginary unit, and that; None for it in an algebraic field without one, which isn't extended."""
    i = field.sqrt(field.poly([-1]))
    if i is not None or isinstance(field, AlgebraicField):
        return field, i
    extended = AlgebraicField(field, field.poly([1, 0, 1]), "I")
    return extended, extended.generator


def _in_trigonometric(form: _ThetaEquation, i: Poly | None, angle: Any) -> Iterator[_InVariable]:
    """In the cosine and in the sine, (T - 1/T)/2 = i sin, where the equation is one in these."""
    cosine = _quotient(form, 1)
    if cosine is not None:
        yield _InVariable(cosine, sympy.cos(angle))
    sine = _quotient(form, -1)
    if sine is not None and i is not None:
        i_sine = RatFunc(form.P.field.poly([0, 1])) * i
        yield _InVariable(_substituted(sine, i_sine), sympy.sin(angle))


def _in_hyperbolic(form: _ThetaEquation, angle: Any) -> Iterator[_InVariable]:
    """In the hyperbolic cosine and sine, where the equation is one in these."""
    for sign, function in ((1, sympy.cosh), (-1, sympy.sinh)):
        quotient = _quotient(form, sign)
        if quotient is not None:
            yield _InVariable(quotient, function(angle))


def _preference(angles: list[Any], found: _InVariable) -> tuple[bool, int, bool]:
    """Rational coefficients, few singular points; three of these are Gauss' equation, which is real in cos(x) and sin(x).

    The angle is the given one, or has half of the frequency of everything: 1/sin(x)^2 + 1/cos(x)^2 is in cos(2 x).
    """
    monic = found.monic
    function = found.function
    places = _singular_points(*monic)
    is_real = function.func in (sympy.cos, sympy.sin) and function.args[0] in angles
    return isinstance(monic[0].field, AlgebraicField), places, places == 3 and not is_real


def _substituted(equation: Monic, M: RatFunc) -> Monic:
    """The equation in w where its variable is M(w)."""
    slope = M.derivative()
    p, q, f = (part(M) for part in equation)
    return p * slope - slope.derivative() / slope, q * slope**2, f * slope**2


def _quotient(form: _ThetaEquation, sign: int) -> Monic | None:
    """The equation in w = (T + sign/T)/2, where it is invariant under T -> sign/T; theta w is (T - sign/T)/2."""
    T = RatFunc(form.P.field.poly([0, 1]))
    parts = [_invariant(part, sign) for part in (form.P * (T * T - sign) / (2 * T), form.Q, form.F)]
    if None in parts:
        return None
    first, second, third = (part for part in parts if part is not None)
    square = T * T - sign
    return (T + first) / square, second / square, third / square


def _invariant(function: RatFunc, sign: int) -> RatFunc | None:
    """r with function = r((T + sign/T)/2), by T^2 = 2 w T - sign; None where there is none."""
    n0, n1 = _reduced(function.num, function.field, sign)
    d0, d1 = _reduced(function.den, function.field, sign)
    if n1 * d0 != n0 * d1:
        return None
    return n0 / d0 if d0 else n1 / d1


def _reduced(poly: Poly, field: Field, sign: int) -> tuple[RatFunc, RatFunc]:
    """(low, high) with poly = low + high T modulo T^2 - 2 w T + sign, by Horner's rule: functions of w."""
    w = RatFunc(field.poly([0, 1]))
    low = RatFunc(field.poly([]))
    high = low
    for power in range(poly.degree, -1, -1):
        # (low + high T) T + coefficient
        before = low
        low = poly[power] - high * sign
        high = before + 2 * w * high
    return low, high


def _singular_points(p: RatFunc, q: RatFunc, _: RatFunc) -> int:
    """How many singular points the normal form has, infinity included."""
    S = p.derivative() / 2 + p * p / 4 - q
    den = S.den
    finite = den.degree - den.gcd(den.derivative()).degree
    return int(finite + (bool(S) and den.degree - S.num.degree < 4))


def _over_base(*parts: RatFunc) -> Monic:
    """The functions over the field below, if all of them are defined there."""
    fields = {lowered(part).field for part in parts if part}
    if len(fields) != 1:
        p, q, f = parts
    else:
        p, q, f = (over(lowered(part), *fields) for part in parts)
    return p, q, f


def _deflated(function: RatFunc, g: int) -> RatFunc:
    """f with function = f(T^g)."""

    def every(poly: Poly) -> Poly:
        return function.field.poly([poly[i] for i in range(0, poly.degree + 1, g)])

    return RatFunc(every(function.num), every(function.den), reduced=True)
