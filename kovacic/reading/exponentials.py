"""Coefficients that are rational in exp(k x), in sin, cos, tan, sinh, cosh, tanh, ... of multiples of k x, or in powers of x.

With t = exp(k x), d/dx = k t d/dt turns a y'' + b y' + c y = f into an equation with rational coefficients,

    k^2 t^2 a Y'' + (k^2 t a + k t b) Y' + c Y = f,        y(x) = Y(exp(k x)),                                          (1)

with the same differential Galois group, since C(exp(k x)) with d/dx is C(t) with k t d/dt.  Where everything depends on t^g
alone, t^g is the variable.  Trigonometric functions have k = i kappa.  Other variables are cosh(k x), sinh(k x), cos(kappa x)
and sin(kappa x), where the equation is invariant under t -> 1/t or t -> -1/t; and t = tan(kappa x/2), where the coefficients
would not be real: exp(i kappa x) = (1 + i t)/(1 - i t).  The way back is `change_of_variable`.

Powers x^e have exponents that aren't integers: x^n with a symbol n, sqrt(x).  With theta = x d/dx, y'' + b y' + c y = 0 is
theta^2 y + (x b - 1) theta y + x^2 c y = 0.  Where x b and x^2 c are rational in T = x^k, this is, by theta = k T d/dT,

    k^2 T^2 Y'' + (k^2 + k (x b - 1)) T Y' + x^2 c Y = 0,        y(x) = Y(x^k).                                        (2)

The functions x b - 1 and x^2 c are P and Q in the code.  Where exponentials of u = x^m occur, (2) in u is one with
coefficients in exp(c u).  There x is positive.

Reference: P. Acosta-Humanez & D. Blazquez-Sanz, Non-integrability of some Hamiltonians with rational potentials, Discrete and
Continuous Dynamical Systems B 10 (2008) 265-293 (Hamiltonian algebrization).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial, reduce
from math import gcd, inf
from typing import Any, NamedTuple

import sympy
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import UNKNOWN, Change, Equation, Parsed, lowered, over
from kovacic.errors import NotRational
from kovacic.numbers.numerals import as_text
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.naming import Source
from kovacic.reading.source import parts_of, read_source, source_of_parts

_HINT = "coefficients are rational in x, or in exp(k*x) and sines, cosines, ... of rational multiples of k*x"


def in_exponentials(source: Source) -> Parsed | None:
    """The equation (1), or None unless the coefficients are of this kind.

    Terms of the right-hand side that aren't rational in exp(k x) become the equation's h, or all of it if numbers occur that
    aren't algebraic.  Raises `NotRational` where both x and exp(k x) occur, and for rates whose quotient isn't rational.
    """
    x = sympy.Symbol(source.variable)
    parts, notices = parts_of(source)
    rewritten = [_exponential_form(part, x) for part in parts]
    if all(part.is_rational_function(x) for part in rewritten[:3]):
        with suppress(NotRational):  # everything else cancels, or has the factor 0
            return read_source(source_of_parts(rewritten, source))
    exponentials = [{e for e in part.atoms(sympy.exp) if e.has(x)} for part in rewritten]
    of_coefficients = set().union(*exponentials[:3])
    if not of_coefficients:
        return None
    T = sympy.Dummy("T")
    try:
        common = common_power(of_coefficients | exponentials[3], x, T)
    except NotRational:  # the right-hand side has others
        common = common_power(of_coefficients, x, T)
    k = common.k
    a, b, c = (part.xreplace(common.powers) for part in rewritten[:3])
    if sympy.Tuple(a, b, c).has(x):
        said = f"{x} and exp({k * x}) both occur: that isn't rational in one exponential function"
        raise NotRational(said, hint=_HINT)
    right, h = _right_side(parts[3], x, common.powers)
    left = (k**2 * T**2 * a, k**2 * T * a + k * T * b, c)
    try:
        read = read_in(T, (*left, -right), source, taken=k.free_symbols)
    except NotRational as error:  # its message is in t
        said = f"a coefficient that isn't a rational function of {as_text(sympy.exp(k * x)).replace('**', '^')}"
        raise NotRational(said, hint=error.hint) from None
    if read.equation.h is not None:  # numbers such as pi and log(2) are among the factors: as a whole it stays in x
        h = -parts[3]
        read = read_in(T, (*left, sympy.S.Zero), source, taken=k.free_symbols)
    equation, t = read.equation, read.variable
    (p, q, f), function = _best(equation, k, x + common.offset)
    denominator = RatFunc(p.den * (q.den // p.den.gcd(q.den)))
    coefficients = (denominator, p * denominator, q * denominator, f * denominator)
    change = Change(x.name, as_text(function))
    result = replace(equation, **dict(zip("abcf", coefficients, strict=True)), h=h and h / parts[0], change=change)
    said = f"in {t} = {change.expression}: {result}"
    found: Parsed = replace(read, S=result.S, notices=(said, *notices, *read.notices), equation=result)
    return found


def read_in(T: Any, parts: Sequence[Any], source: Source, *, taken: Collection[Any] = ()) -> Any:
    """The equation with these coefficients in T, read in t, or in another letter that neither they have nor is `taken`."""
    symbols = {*taken, *sympy.Tuple(*parts).free_symbols}
    names = {source.variable, source.unknown, UNKNOWN, *(symbol.name for symbol in symbols)}
    t = sympy.Symbol(next(name for name in ("t", "s", "z", "w", "t_", "s_") if name not in names))
    renamed = source._replace(variable=t.name, unknown=source.unknown or UNKNOWN)
    return read_source(source_of_parts([part.xreplace({T: t}) for part in parts], renamed))


def _right_side(rest: Any, x: Any, powers: dict[Any, Any]) -> tuple[Any, Any]:
    """The terms of the right-hand side -rest that are rational in T, and the others in x, or None if there are no others."""
    in_T, in_x = [], []
    for term in sympy.Add.make_args(sympy.expand(-rest)):
        rewritten = _exponential_form(term, x).xreplace(powers)
        free = rewritten.free_symbols | rewritten.atoms(AppliedUndef)
        if rewritten.is_rational_function(*free) and not rewritten.has(x):
            in_T.append(rewritten)
        else:
            in_x.append(term)
    return sympy.Add(*in_T), sympy.Add(*in_x) if in_x else None


def _exponential_form(expression: Any, x: Any) -> Any:
    """The expression with exp(k x) in the place of sin(x), tanh(x), 2^x, ..."""

    def is_such(e: Any) -> bool:
        return isinstance(e, TrigonometricFunction | HyperbolicFunction) or bool(e.is_Pow and e.exp.has(x))

    return expression.replace(is_such, lambda e: e.rewrite(sympy.exp, deep=False))


class CommonPower(NamedTuple):
    """Exponentials as `powers` of T = exp(k (x + offset)), times numbers."""

    k: Any
    offset: Any
    powers: dict[Any, Any]


def common_power(exponentials: set[Any], x: Any, T: Any) -> CommonPower:
    """The power of which all are powers; its offset leaves as few constants exp(n) as can be."""
    lines: dict[Any, tuple[Any, Any]] = {}  # of exp(rate x + shift)
    for e in sorted(exponentials, key=str):
        argument = sympy.expand(e.exp)
        rate, shift = argument.coeff(x, 1), argument.coeff(x, 0)
        if sympy.expand(argument - rate * x - shift) != 0 or rate.has(x):
            raise NotRational(f"{e} isn't the exponential function of a multiple of {x}", hint=_HINT)
        lines[e] = rate, shift
    first = next(iter(lines.values()))[0]
    ratios = {e: sympy.cancel(rate / first) for e, (rate, _) in lines.items()}
    if not all(ratio.is_Rational for ratio in ratios.values()):
        raise NotRational(f"exponentials of {x} whose rates have no rational quotient", hint=_HINT)
    unit = abs(reduce(sympy.gcd, ratios.values()))  # the greatest rational number of which all ratios are multiples
    k = sympy.expand(first * unit)
    if k.could_extract_minus_sign():
        k, unit = -k, -unit

    def constants(offset: Any) -> dict[Any, Any]:
        """c with exp(rate x + shift) = c exp(rate (x + offset))."""
        return {e: sympy.exp(sympy.expand(shift - rate * offset)) for e, (rate, shift) in lines.items()}

    offsets = [sympy.Integer(0), *(sympy.expand(shift / rate) for rate, shift in lines.values())]
    offset = min(offsets, key=lambda each: sum(c.has(sympy.exp, sympy.E) for c in constants(each).values()))
    powers: dict[Any, Any] = {}
    for e, constant in constants(offset).items():
        if not all(power.exp.is_Integer for power in constant.atoms(sympy.exp)):
            raise NotRational(f"{e} has a constant in its exponent", hint=f"write a letter for the factor {constant}")
        powers[e] = constant * T ** (ratios[e] / unit)
    return CommonPower(k, offset, powers)


Monic = tuple[RatFunc, RatFunc, RatFunc]
_InVariable = tuple[Monic, Any]
"""The equation in a variable, and this as a function of x."""


@dataclass(frozen=True)
class _ThetaEquation:
    """theta^2 Y + P theta Y + Q Y = F with theta = T d/dT."""

    P: RatFunc
    Q: RatFunc
    F: RatFunc

    @property
    def step(self) -> int:
        """The largest g for which everything depends on T^g."""
        polynomials = [poly for part in (self.P, self.Q, self.F) for poly in (part.num, part.den)]
        return gcd(*(i for poly in polynomials for i, c in enumerate(poly) if c)) or 1

    def in_power(self, g: int) -> _ThetaEquation:
        """The equation in T^g."""

        def deflated(poly: Poly) -> Poly:
            return self.P.field.poly([poly[i] for i in range(0, poly.degree + 1, g)])

        P, Q, F = (RatFunc(deflated(f.num), deflated(f.den), reduced=True) for f in (self.P, self.Q, self.F))
        return _ThetaEquation(P / g, Q / g**2, F / g**2)

    @property
    def monic(self) -> Monic:
        """With derivatives by T."""
        T = RatFunc(self.P.field.x)
        return (self.P + 1) / T, self.Q / T**2, self.F / T**2


def _best(equation: Equation, k: Any, x: Any) -> _InVariable:
    """Y'' + p Y' + q Y = f in the variable that has real coefficients if one has, and then the fewest singular points."""
    kappa = sympy.expand(-sympy.I * k)
    is_trigonometric = not kappa.has(sympy.I)
    rate = kappa if is_trigonometric else k
    field = equation.a.field
    i = None
    if is_trigonometric:
        i = field.sqrt(field.poly([-1]))
        if i is None and not isinstance(field, AlgebraicField):  # an algebraic field isn't extended
            field = AlgebraicField(field, field.poly([1, 0, 1]), "I")
            i = field.generator
    T = RatFunc(field.x)
    p, q, f = (over(part / equation.a, field) for part in (equation.b, equation.c, equation.f))
    form = _ThetaEquation(p * T - 1, q * T * T, f * T * T)
    g = form.step
    exponential = form.in_power(g).monic
    found = [(exponential, sympy.exp(sympy.expand(g * k * x)))]
    waves = [(sympy.cosh, 1, T), (sympy.sinh, -1, T)]
    if is_trigonometric:  # (T - 1/T)/2 = i sin
        waves = [(sympy.cos, 1, T), *([] if i is None else [(sympy.sin, -1, T * i)])]
    for h in (g, g // 2) if g % 2 == 0 else (g,):
        for function, sign, variable in waves:
            quotient = _invariant_form(form.in_power(h), sign)
            if quotient is not None:
                found.append((_in_moebius_variable(quotient, variable), function(sympy.expand(h * rate * x))))
    if i is not None:
        tangent = _in_moebius_variable(exponential, (1 + T * i) / (1 - T * i))
        found.append((tangent, sympy.tan(sympy.expand(g * rate * x / 2))))
    angles = [sympy.expand(h * rate * x) for h in (1, g // 2)]
    return min(((_over_base(monic), function) for monic, function in found), key=partial(_preference, angles))


def _preference(angles: list[Any], found: _InVariable) -> tuple[bool, int, bool]:
    """Rational coefficients, few singular points; three of these are Gauss' equation, which is real in cos(x) and sin(x).

    The angle is the given one, or has half of the frequency of everything: 1/sin(x)^2 + 1/cos(x)^2 is in cos(2 x).
    """
    (p, q, _), function = found
    # Singular points, infinity included: those of p and q, so that special numbers, with which some of them become ordinary
    # in the normal form, don't lead to another variable than letters for them.
    poles = p.den * (q.den // p.den.gcd(q.den))
    finite = poles.degree - poles.gcd(poles.derivative()).degree
    T = RatFunc(p.field.x)
    is_ordinary = _order_at_infinity(p * T - 2) > 0 and _order_at_infinity(q) > 3
    places = finite + (not is_ordinary)
    is_real = function.func in (sympy.cos, sympy.sin) and function.args[0] in angles
    return isinstance(p.field, AlgebraicField), places, places == 3 and not is_real


def _order_at_infinity(function: RatFunc) -> float:
    return function.den.degree - function.num.degree if function else inf


def _in_moebius_variable(equation: Monic, M: RatFunc) -> Monic:
    """The equation in w where its variable is M(w)."""
    slope = M.derivative()
    p, q, f = (part(M) for part in equation)
    return p * slope - slope.derivative() / slope, q * slope**2, f * slope**2


def _invariant_form(form: _ThetaEquation, sign: int) -> Monic | None:
    """The equation in w = (T + sign/T)/2, where it is invariant under T -> sign/T; theta w is (T - sign/T)/2."""
    T = RatFunc(form.P.field.x)
    found = []
    for part in (form.P * (T * T - sign) / (2 * T), form.Q, form.F):
        n0, n1 = _modulo_quadratic(part.num, sign)
        d0, d1 = _modulo_quadratic(part.den, sign)
        if n1 * d0 != n0 * d1:
            return None
        found.append(n0 / d0 if d0 else n1 / d1)
    first, second, third = found
    square = T * T - sign
    return (T + first) / square, second / square, third / square


def _modulo_quadratic(poly: Poly, sign: int) -> tuple[RatFunc, RatFunc]:
    """(low, high) with poly = low + high T modulo T^2 - 2 w T + sign, by Horner's rule: functions of w."""
    w = RatFunc(poly.field.x)
    low = high = RatFunc(poly.field.zero)
    for power in range(poly.degree, -1, -1):
        # (low + high T) T + coefficient
        low, high = poly[power] - high * sign, low + 2 * w * high
    return low, high


def _over_base(monic: Monic) -> Monic:
    """The functions over the field below, if all of them are defined there."""
    fields = {lowered(part).field for part in monic if part}
    if len(fields) != 1:
        return monic
    p, q, f = (over(lowered(part), *fields) for part in monic)
    return p, q, f


def in_powers(source: Source) -> Parsed | None:
    """The equation (2) for an input with such coefficients; None if they aren't functions of one power.

    The right-hand side is kept as the equation's h.
    """
    x = sympy.Symbol(source.variable)
    (a, b, c, rest), notices = parts_of(source)
    # Without functions, what isn't rational is a constant.
    if a == 0 or (a + b + c).has(AppliedUndef) or (b / a + c / a).is_rational_function(x):
        return None
    P, Q = sympy.expand(x * b / a) - 1, sympy.expand(x**2 * c / a)
    waves = [wave for wave in sympy.Tuple(b / a, c / a).atoms(*_WAVE_FUNCTIONS) if wave.has(x)]
    found = None
    with suppress(NotRational):
        found = _of_waves(P, Q, waves, source) if waves else _in_one_power(P, Q, source)
    if found is None:
        return None
    equation = replace(found.equation, h=sympy.expand(-rest / a) if rest != 0 else found.equation.h)
    said = f"in {equation.variable} = {found.equation.change.expression.replace('**', '^')}: {equation}"
    return Parsed(equation.S, equation.variable, (said, *notices, *found.notices), equation, found.letters)


_WAVE_FUNCTIONS = (sympy.exp, sympy.sin, sympy.cos, sympy.tan, sympy.sinh, sympy.cosh, sympy.tanh)


def _in_one_power(P: Any, Q: Any, source: Source) -> Any:
    """theta^2 y + P theta y + Q y = 0 in T = x^k: with x = exp(s) powers of x are exponentials of s, and T is exp(k s)."""
    x, s, T = sympy.Symbol(source.variable), sympy.Dummy("s"), sympy.Dummy("T")

    both = sympy.Tuple(P, Q)
    powers = {p: sympy.exp(sympy.expand(p.exp * s)) for p in both.atoms(sympy.Pow) if p.base == x}
    both = both.xreplace(powers).xreplace({x: sympy.exp(s)})
    both = sympy.Tuple(*(sympy.powsimp(part, combine="exp") for part in both))
    exponentials = {e for e in both.atoms(sympy.exp) if e.has(s)}
    if not exponentials or both.has(sympy.log):
        return None
    k, offset, powers = common_power(exponentials, s, T)
    P, Q = both = both.xreplace(powers)
    if offset != 0 or both.has(s):
        return None
    left = (k**2 * T**2, (k**2 + k * P) * T, Q, sympy.S.Zero)
    return _with_change(read_in(T, left, source), source, x**k)


def _of_waves(P: Any, Q: Any, waves: Sequence[Any], source: Source) -> Any:
    """In u = x^m, where the arguments of all waves contain x in x^m alone, and then in exp(c u); x names u, too."""
    x = sympy.Symbol(source.variable)
    arguments = sympy.Tuple(*(wave.args[-1] for wave in waves))
    powers = {p for p in arguments.atoms(sympy.Pow) if p.base == x}
    if len(powers) != 1 or arguments.subs(dict.fromkeys(powers, 0)).has(x):
        return None
    m = powers.pop().exp
    T = sympy.Dummy("T", positive=True)
    P, Q = (sympy.powdenest(part.subs(x, T ** (1 / m)), force=True) for part in (P, Q))
    first = sympy.cancel((m**2 + m * P) / (m**2 * T))
    zeroth = sympy.cancel(Q / (m**2 * T**2))
    monic = [sympy.S.One, first.xreplace({T: x}), zeroth.xreplace({T: x}), sympy.S.Zero]
    renamed = source._replace(unknown=source.unknown or UNKNOWN)
    found: Any = in_exponentials(source_of_parts(monic, renamed))
    if found is None or found.equation.change is None:
        return None
    return _with_change(replace(found, notices=found.notices[1:]), source, function_of_x(found.equation).subs(x, x**m))


def _with_change(read: Any, source: Source, value: Any) -> Any:
    """With a variable that is this function of the user's."""
    change = Change(source.variable, as_text(value))
    return replace(read, equation=replace(read.equation, unknown=source.unknown or UNKNOWN, change=change))
