"""Coefficients that are rational in exp(k x): in sin, cos, tan, sinh, cosh, tanh, ... of multiples of k x.

With t = exp(k x), d/dx = k t d/dt turns a y'' + b y' + c y = f into an equation with rational coefficients,

    k^2 t^2 a Y'' + (k^2 t a + k t b) Y' + c Y = f,        y(x) = Y(exp(k x)),                                          (1)

with the same differential Galois group, since C(exp(k x)) with d/dx is C(t) with k t d/dt.  Where everything depends on t^g
alone, t^g is the variable.  Trigonometric functions have k = i kappa.  Other variables are cosh(k x), sinh(k x), cos(kappa x)
and sin(kappa x), where the equation is invariant under t -> 1/t or t -> -1/t; and t = tan(kappa x/2), where the coefficients
would not be real: exp(i kappa x) = (1 + i t)/(1 - i t).

Reference: P. Acosta-Humanez & D. Blazquez-Sanz, Non-integrability of some Hamiltonians with rational potentials, Discrete and
Continuous Dynamical Systems B 10 (2008) 265-293 (Hamiltonian algebrization).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import gcd
from typing import Any

import sympy

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import NotLinear, NotRational
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Term
from kovacic.reading.equation import (
    EquationReader,
    is_equation,
    names_in_equation,
    parse_sympy_equation,
    sympy_equation,
)
from kovacic.reading.expression import RationalReader, chosen_variable, tokens_of
from kovacic.reading.from_sympy import is_sympy_equation, walked
from kovacic.reading.given import ENERGY, EULER, NUMBER_NAMES, UNKNOWN, Change, Equation, Parsed, lowered, over
from kovacic.reading.linear import REST
from kovacic.reading.parser import evaluate
from kovacic.reading.symbolic import read_expression

_HINT = "coefficients are rational in x, or in exp(k*x) and sines, cosines, ... of rational multiples of k*x"


def in_exponentials(given: Any, *, variable: str | None, limits: Limits) -> Parsed | None:
    """The equation (1) for an input with such coefficients; None for any other input.

    Raises `NotRational` where x occurs beside exp(k x), or rates whose quotient isn't rational.
    """
    equation = _symbolic(given, variable, limits)
    if equation is None:
        return None
    parts, x, reader = equation
    rewritten = [sympy.expand_power_exp(parts.get(k, sympy.Integer(0)).rewrite(sympy.exp)) for k in (2, 1, 0, REST)]
    exponentials = {e for part in rewritten for e in part.atoms(sympy.exp) if e.has(x)}
    if not exponentials:
        return None
    T = sympy.Dummy("T")
    k, powers = _powers(exponentials, x, T)
    a, b, c, rest = (part.xreplace(powers) for part in rewritten)
    if any(part.has(x) for part in (a, b, c, rest)):
        raise NotRational(f"{x} beside exp({k * x})", hint=_HINT)
    unknown = reader.unknown or UNKNOWN
    names = {s.name for part in (a, b, c, rest, k) for s in part.free_symbols} | {x.name, unknown}
    t = sympy.Symbol(next(name for name in ("t", "s", "z", "w", "t_", "s_") if name not in names))
    Y = sympy.Function(f"{unknown}_")(t)
    whole = k**2 * T**2 * a * Y.diff(t, 2) + (k**2 * T * a + k * T * b) * Y.diff(t) + c * Y + rest
    read, notices, _ = parse_sympy_equation(whole.xreplace({T: t}), limits=limits)
    monic, expression = _best(read, k, x)
    change = Change(x.name, expression)
    a, b, c, f = _cleared(*monic)
    result = Equation(a, b, c, f, None, t.name, unknown, change)
    return Parsed(result.S, t.name, (f"in {t} = {expression}: {result}", *reader.notices(), *notices), result)


def in_terms_of(change: Change, expression: Any, variable: str) -> Any:
    """A SymPy expression in t as one in x; exp(2*x) + 1 becomes 2*exp(x)*cosh(x), powers of exponentials exponentials."""
    t, own = read_expression(change.expression), sympy.Symbol(variable)
    x = sympy.Symbol(change.variable)
    integrals = {
        integral: sympy.Integral(in_terms_of(change, integral.function, variable) * t.diff(x), x)
        for integral in expression.atoms(sympy.Integral)
        if integral.limits == (sympy.Tuple(own),)
    }
    result = expression.xreplace(integrals).xreplace({own: t})
    if t.func is not sympy.exp:
        return result
    result = result.replace(
        lambda e: e.func is sympy.log and e.args[0].func is sympy.exp, lambda e: e.args[0].exp
    ).replace(_is_exponential_and_one, _hyperbolic)
    powers = result.replace(lambda e: e.is_Pow and e.base.is_Mul, lambda e: sympy.expand_power_base(e, force=True))
    powers = powers.replace(lambda e: e.is_Pow and e.base.func is sympy.exp, lambda e: sympy.exp(e.base.exp * e.exp))
    return sympy.powsimp(powers, combine="exp")


def solution_in_terms_of(change: Change, solution: Any, variable: str) -> Any:
    """The same for a solution, up to a number as a factor."""
    result = in_terms_of(change, solution, variable)
    number, rest = (
        result.as_independent(*result.free_symbols, as_Add=False) if result.free_symbols else (result, result)
    )
    return rest if number.is_number else result


def _is_exponential_and_one(e: Any) -> bool:
    return bool(e.is_Add and len(e.args) == 2 and e.args[0] in (1, -1) and e.args[1].func is sympy.exp)


def _hyperbolic(e: Any) -> Any:
    half = e.args[1].exp / 2
    return 2 * sympy.exp(half) * (sympy.cosh(half) if e.args[0] == 1 else sympy.sinh(half))


def _powers(exponentials: set[Any], x: Any, T: Any) -> tuple[Any, dict[Any, Any]]:
    """k, and each exponential as a power of T = exp(k x), times a number."""
    rates: dict[Any, tuple[Any, Any]] = {}
    for e in exponentials:
        argument = sympy.expand(e.exp)
        rate, shift = argument.coeff(x, 1), argument.coeff(x, 0)
        constant = sympy.exp(shift)
        if sympy.expand(argument - rate * x - shift) != 0 or rate.has(x):
            raise NotRational(f"{e} isn't the exponential function of a multiple of {x}", hint=_HINT)
        if constant.has(sympy.exp):
            raise NotRational(
                f"{e} has a constant in its exponent", hint=f"shift {x}, or write a letter for the factor"
            )
        rates[e] = rate, constant
    first = next(iter(rates.values()))[0]
    ratios = {e: sympy.cancel(rate / first) for e, (rate, _) in rates.items()}
    if not all(ratio.is_Rational for ratio in ratios.values()):
        raise NotRational(f"exponentials of {x} whose rates have no rational quotient", hint=_HINT)
    unit = sympy.Rational(gcd(*(int(r.p * _lcm(ratios) // r.q) for r in ratios.values())), _lcm(ratios))
    k = sympy.expand(first * unit)
    if k.could_extract_minus_sign():
        k, unit = -k, -unit
    return k, {e: constant * T ** (ratios[e] / unit) for e, (_, constant) in rates.items()}


def _lcm(ratios: dict[Any, Any]) -> int:
    return int(sympy.ilcm(*(r.q for r in ratios.values()), 1))


Monic = tuple[RatFunc, RatFunc, RatFunc]


def _best(equation: Equation, k: Any, x: Any) -> tuple[Monic, str]:
    """Y'' + p Y' + q Y = f in the variable that has real coefficients if one has, and then the fewest singular points."""
    kappa = sympy.expand(-sympy.I * k)
    trigonometric = not kappa.has(sympy.I)
    field, i = equation.a.field, None
    if trigonometric:
        i = field.sqrt(field.poly([-1]))
        if i is None and not isinstance(field, AlgebraicField):
            field = AlgebraicField(field, field.poly([1, 0, 1]), "I")
            i = field.generator
    parts = [part / equation.a for part in (equation.b, equation.c, equation.f)]
    T = RatFunc(field.poly([0, 1]))
    # With theta = T d/dT: theta^2 Y + P theta Y + Q Y = F.
    P, Q, F = (over(part, field) for part in parts)
    P, Q, F = P * T - 1, Q * T * T, F * T * T
    g = gcd(*(i for part in (P, Q, F) for poly in (part.num, part.den) for i, c in enumerate(poly) if c)) or 1
    found: list[tuple[Monic, str]] = []
    for h in (g, g // 2) if g % 2 == 0 else (g,):
        powers = _deflated(P, h) / h, _deflated(Q, h) / h**2, _deflated(F, h) / h**2
        if h == g:
            found.append(
                (_over_base((powers[0] + 1) / T, powers[1] / T**2, powers[2] / T**2), str(sympy.exp(g * k * x)))
            )
        for sign, name in ((1, "cos"), (-1, "sin")):
            quotient = _quotient(*powers, sign)
            if quotient is None or (trigonometric and i is None and sign == -1):
                continue
            if trigonometric and i is not None and sign == -1:  # (T - 1/T)/2 = i sin
                p, q, f = quotient
                quotient = p(T * i) * i, -q(T * i), -f(T * i)
            function = getattr(sympy, name if trigonometric else f"{name}h")
            found.append((_over_base(*quotient), str(function(h * (kappa if trigonometric else k) * x))))
    if i is not None and trigonometric:
        p, q, f = (over(part, field) for part in found[0][0])
        M, slope, curvature = (1 + T * i) / (1 - T * i), 2 * i / (1 - T * i) ** 2, 2 * i / (1 - T * i)
        found.append(
            (_over_base(p(M) * slope - curvature, q(M) * slope**2, f(M) * slope**2), str(sympy.tan(g * kappa * x / 2)))
        )
    return min(
        found,
        key=lambda pair: (isinstance(pair[0][0].field, AlgebraicField), _singular_points(*pair[0])),
    )


def _quotient(P: RatFunc, Q: RatFunc, F: RatFunc, sign: int) -> Monic | None:
    """The equation in w = (T + sign/T)/2, where it is invariant under T -> sign/T.

    theta w = v = (T - sign/T)/2, theta^2 w = w, v^2 = w^2 - sign.
    """
    T = RatFunc(P.field.poly([0, 1]))
    parts = [_invariant(part, sign) for part in (P * (T * T - sign) / (2 * T), Q, F)]
    if None in parts:
        return None
    first, second, third = (part for part in parts if part is not None)
    square = T * T - sign
    return (T + first) / square, second / square, third / square


def _invariant(function: RatFunc, sign: int) -> RatFunc | None:
    """r with function = r((T + sign/T)/2), by T^2 = 2 w T - sign; None where there is none."""
    field = function.field
    w, zero = RatFunc(field.poly([0, 1])), RatFunc(field.poly([]))
    pairs = []
    for poly in (function.num, function.den):
        low, high = zero, zero
        for power in range(poly.degree, -1, -1):
            low, high = poly[power] - high * sign, low + 2 * w * high
        pairs.append((low, high))
    (n0, n1), (d0, d1) = pairs
    if n1 * d0 != n0 * d1:
        return None
    return n0 / d0 if d0 else n1 / d1


def _singular_points(p: RatFunc, q: RatFunc, _: RatFunc) -> int:
    """How many singular points the normal form has."""
    S = p.derivative() / 2 + p * p / 4 - q
    den = S.den
    finite = den.degree - den.gcd(den.derivative()).degree
    return int(finite + (bool(S) and den.degree - S.num.degree < 4))


def _over_base(*parts: RatFunc) -> Monic:
    """The functions over the field below, if all of them are defined there."""
    below = [lowered(part) for part in parts]
    known = {part.field for part in below if part}
    p, q, f = (over(part, *known) for part in below) if len(known) == 1 else parts
    return p, q, f


def _deflated(function: RatFunc, g: int) -> RatFunc:
    """f with function = f(T^g)."""
    num, den = ([poly[i] for i in range(0, poly.degree + 1, g)] for poly in (function.num, function.den))
    return RatFunc(function.field.poly(num), function.field.poly(den), reduced=True)


def _cleared(p: RatFunc, q: RatFunc, f: RatFunc) -> tuple[RatFunc, RatFunc, RatFunc, RatFunc]:
    """a y'' + b y' + c y = f with polynomials a, b, c."""
    a = p.den * (q.den // p.den.gcd(q.den))
    return RatFunc(a), p * a, q * a, f * a


def _symbolic(given: Any, variable: str | None, limits: Limits) -> tuple[dict[int, Any], Any, _Reader] | None:
    """The coefficients of the derivatives and `REST`, as SymPy expressions, x, and the reader."""
    walk: Callable[[RationalReader], Any]
    y = ""
    if isinstance(given, str):
        tokens = tokens_of(given, limits, what="equation", hint="for example y'' = (x^2 + 3) y")
        walk = partial(evaluate, tokens)
        if is_equation(given):
            x, y = names_in_equation(tokens, variable)
        else:
            x = variable or chosen_variable([n for n in tokens.names() if n not in {*NUMBER_NAMES, ENERGY, EULER}])
    elif is_sympy_equation(given):
        expression, function = sympy_equation(given, variable, None)
        walk, x, y = partial(walked, expression), function.args[0].name, str(function.func)
    elif isinstance(given, sympy.Expr):
        walk, x = partial(walked, given), variable or chosen_variable(sorted(s.name for s in given.free_symbols))
    else:
        return None
    reader = _Reader(x, y, limits, _Symbols())  # type: ignore[arg-type]
    value = walk(reader)
    parts = {2: Term(1, 0), 0: reader.arithmetic.negate(value)} if not y else getattr(value, "parts", {})
    found = {k: reader.arithmetic.expression(c) for k, c in parts.items()}
    if max(found, default=0) != 2:
        raise NotLinear("a linear equation of second order is expected")
    return found, sympy.Symbol(x), reader


class _Reader(EquationReader):
    """Reads equations whose coefficients may be any SymPy expressions."""

    def coefficient(self, expression: Any) -> Any:
        return expression


class _Symbols:
    """What `Constants` is to other readers: parameters and algebraic numbers as SymPy expressions."""

    parameters = ()

    def parameter(self, name: str) -> Any:
        return sympy.Symbol(name)

    def imaginary_unit(self) -> Any:
        return sympy.I

    def algebraic(self, node: Any) -> Any:
        return node

    def radical(self, radicand: Poly, n: int, _: str) -> Any:
        return sympy.root(radicand.to_sympy(sympy.Integer(0)), n)
