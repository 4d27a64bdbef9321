"""Mathieu's functions, for equations whose coefficients are waves: y'' = S y in t = exp(k x) or tan(k x).

With s = dt/dx, a function of t, v = u/sqrt(s) satisfies v'' = f v, f = s^2 S - s s''/2 + s'^2/4 (primes are d/dt).  For a wave
f = mean + size cos(kappa x - shift), which is f'' = -kappa^2 (f - mean) with its values where kappa x = 0, v is a solution of

    w'' + (a - 2 q cos(2 z)) w = 0,     z = (kappa x - shift)/2,    a = -4 mean/kappa^2,    q = 2 size/kappa^2,

which has an even and an odd one.  An imaginary kappa makes the modified equation, in cosh.

Reference: DLMF 28.2, 28.20.
"""

from __future__ import annotations

import sympy
from sympy import I, atan, cancel, mathieuc, mathieus, mathieusprime, pi, tan

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.product import product
from kovacic.equation import Equation
from kovacic.reading.change_of_variable import function_of_x, user_variable
from kovacic.special.writer import WrittenPair


def mathieu(S: RatFunc, gauge: RatFunc, equation: Equation) -> WrittenPair | None:
    """An even and an odd solution, functions of x; None if f isn't such a wave.

    >>> import kovacic
    >>> print(kovacic.dsolve("y'' + (a - 2*q*cos(2*x))*y = 0"))
    Eq(y(x), C1*mathieuc(a, q, x) + C2*mathieus(a, q, x))
    """
    t = sympy.Symbol(equation.variable)
    x = user_variable(equation)
    T = function_of_x(equation)
    angle = T.args[0]
    is_tangent = T.func is tan
    infinite = S.field.poly([1, 0, 1] if is_tangent else [0, 1])  # 0 where x is: exp(k x) = 0, or tan(k x)^2 = -1
    if S.den.remove(infinite)[0].degree > 0:
        return None
    s = T.diff(x).xreplace({T: t})
    f = cancel(s**2 * Atoms(t).ratio(S) - s * s.diff(t, 2) / 2 + s.diff(t) ** 2 / 4)
    n = sympy.degree(sympy.denom(f), t)
    if s.has(x) or not n:
        return None
    unit = n if is_tangent else I * n  # kappa x is unit * angle
    if (unit * angle).could_extract_minus_sign():
        unit = -unit
    kappa = unit * angle.diff(x)
    slope = cancel(s * f.diff(t))
    mean = cancel(f + s * slope.diff(t) / kappa**2)
    start = 0 if is_tangent else 1  # t at x = 0
    cosine, sine = (sympy.expand(part.subs(t, start)) for part in (f - mean, slope / kappa))
    if mean.has(t) or sympy.expand(cosine**2 + sine**2) == 0:
        return None
    # cosine cos(u) + sine sin(u) = size cos(u - shift)
    size, shift = sine, pi / 2
    if cosine:
        ratio = sine / cosine
        size, shift = cosine * sympy.sqrt(1 + ratio**2), atan(ratio)
    a, q = (sympy.expand(2 * part / kappa**2) for part in (-2 * mean, size))
    # exp(int gauge dt)/sqrt(s), but for its constant: v = u/sqrt(s), and s is t or 1 + t^2 times one.
    X = RatFunc(gauge.field.x)
    half_of_slope = X / (X * X + 1) if is_tangent else 1 / (2 * X)
    factor = display(product(gauge + half_of_slope), Atoms(t)).subs(t, T)
    factor = factor.replace(lambda e: e.func is atan and e.args[0] == T, lambda e: angle)
    z = sympy.expand((unit * angle - shift) / 2)
    if z.could_extract_minus_sign():  # one function is even, the other odd
        z = -z
    W = factor**2 * z.diff(x) * mathieuc(a, q, 0) * mathieusprime(a, q, 0)  # Mathieu's equation has no w'
    return WrittenPair(factor * mathieuc(a, q, z), factor * mathieus(a, q, z), W)
