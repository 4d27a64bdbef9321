"""Integrals that are special functions: incomplete gamma and Fresnel functions, dilogarithms, complex exponentials.

References: DLMF 7.2(iii), 8.2, 25.12.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy import cos, exp, log, sin

from kovacic.closed_form.atoms import hypergeometric, is_seen_negative
from kovacic.general_solution.integrands import integral_of_product, sum_of

Expr = Any  # SymPy publishes no types
#: More complex exponentials than these are harder to read than the integral.
_MOST_EXPONENTIALS = 4


def incomplete_gamma(term: Expr, x: Expr) -> Expr | None:
    """int K x^s exp(c x^m) dx = K x^(s+1)/(m e) 1F1(e; e + 1; c x^m), e = (s + 1)/m; s and m may be symbols.

    For a positive z = -c x^m it is -(K/m) x^(s+1) z^-e Gamma(e, z), where x^(s+1) z^-e is a constant.
    Without an exponential it is K x^(s+1)/(s+1).

    >>> x, s = sympy.symbols("x s")
    >>> print(incomplete_gamma(x**s * exp(-x), x), incomplete_gamma((x + 2) ** s * exp(-x), x))
    -uppergamma(s + 1, x) -exp(2)*uppergamma(s + 1, x + 2)
    """
    K, rest = term.as_independent(x, as_Add=False)
    powers = rest.as_powers_dict()
    exponent = powers.pop(sympy.E, sympy.Integer(0))
    if len(powers) > 1:
        return None
    line, s = next(iter(powers.items()), (x, sympy.Integer(0)))
    slope = line.diff(x)
    if slope.has(x) or slope == 0 or s.has(x):
        return None
    if exponent == 0:
        return None if s == -1 else K * line ** (s + 1) / (s + 1) / slope
    # exp(d + c t^m) for t = a x + b
    t = sympy.Dummy()
    d, single = sympy.expand(exponent.subs(x, (t - line.subs(x, 0)) / slope)).as_independent(t, as_Add=True)
    c, power = single.as_independent(t, as_Add=False)
    base, m = power.as_base_exp()
    if base != t or m.has(t) or m == 0:
        return None
    e = (s + 1) / m
    if e == sympy.S.Half:  # u = t^(s+1): t^s dt is du/(s + 1)
        function, root = (sympy.erf, sympy.sqrt(-c)) if is_seen_negative(c) else (sympy.erfi, sympy.sqrt(c))
        found = sympy.sqrt(sympy.pi) * function(root * t ** (s + 1)) / (2 * root * (s + 1))
    elif is_seen_negative(c) or e.is_Integer:  # for an integer e it is elementary, or has Ei
        z = -c * t**m
        found = -sympy.powsimp(t ** (s + 1) * z**-e) * sympy.uppergamma(e, z) / m
    else:
        found = t ** (s + 1) / (s + 1) * hypergeometric((e,), (e + 1,), c * t**m)
    return (K / slope * exp(d) * found).xreplace({t: line})


def power_beside_wave(term: Expr, x: Expr) -> Expr | None:
    """int K x^s cos(c x^m + d) dx, or of the sine: with 1F2, odd or even in the angle; s and m may be symbols.

    With e = (s + 1)/m and z = -(c x^m/2)^2,

        int x^s cos(c x^m) dx = x^(s+1)/(s+1) 1F2(e/2; 1/2, e/2 + 1; z),
        int x^s sin(c x^m) dx = c x^(s+m+1)/(s+m+1) 1F2((e + 1)/2; 3/2, (e + 3)/2; z).

    >>> x, s = sympy.symbols("x s")
    >>> print(power_beside_wave(x**s * cos(x), x))
    x**(s + 1)*hyper((s/2 + 1/2,), (1/2, s/2 + 3/2), -x**2/4)/(s + 1)
    """
    K, rest = term.as_independent(x, as_Add=False)
    s, wave = rest.as_independent(sin, cos, as_Add=False)
    if wave.func not in (sin, cos):
        return None
    base, s = s.as_base_exp() if s != 1 else (x, sympy.S.Zero)
    d, angle = sympy.expand(wave.args[0]).as_independent(x, as_Add=True)
    c, power = angle.as_independent(x, as_Add=False)
    variable, m = power.as_base_exp()
    if base != x or variable != x or m.has(x) or s.has(x):
        return None
    if wave.func is cos:  # sin(u + d) = sin(u) cos(d) + cos(u) sin(d)
        d += sympy.pi / 2
    e = (s + 1) / m
    if any(value.is_Integer and not value.is_positive for value in (e / 2, (e + 1) / 2)):  # a logarithm
        return None
    z = -((c * x**m) ** 2) / 4
    half = sympy.S.Half
    of_cos = x ** (s + 1) / (s + 1) * hypergeometric((e / 2,), (half, e / 2 + 1), z)
    of_sin = c * x ** (s + m + 1) / (s + m + 1) * hypergeometric(((e + 1) / 2,), (3 * half, (e + 3) / 2), z)
    return K * (cos(d) * of_sin + sin(d) * of_cos)


def fresnel(R: Expr, wave: Expr, x: Expr) -> Expr | None:
    """int R(x) sin(q(x)) dx, or of the cosine, for a quadratic q = a t^2 + d, t = x + b/(2a), and a sum R of powers of t."""
    a, b, c = sympy.Poly(wave.args[0], x).all_coeffs()
    t = sympy.Dummy()
    phase = c - b**2 / (4 * a)
    if wave.func is cos:  # the sine, an angle of pi/2 later
        phase += sympy.pi / 2
    in_t = sympy.apart(R.subs(x, t - b / (2 * a)), t)
    total = sympy.S.Zero
    for term in sympy.Add.make_args(in_t):
        k, power = term.as_independent(t, as_Add=False)
        base, n = power.as_base_exp()
        if base not in (t, 1):
            return None
        total += k * _power_beside_sine(int(n) if base == t else 0, a, phase, t)
    return sympy.expand(total).subs(t, x + b / (2 * a))


def _power_beside_sine(n: int, a: Expr, d: Expr, t: Expr) -> Expr:
    """int t^n sin(a t^2 + d) dt, by parts to n = 0, 1 or -1: Fresnel functions, an elementary one, Si and Ci."""
    if n == 0:
        z = t * sympy.sqrt(2 * a / sympy.pi)
        return sympy.sqrt(sympy.pi / (2 * a)) * (cos(d) * sympy.fresnels(z) + sin(d) * sympy.fresnelc(z))
    if n == -1:
        return (cos(d) * sympy.Si(a * t**2) + sin(d) * sympy.Ci(a * t**2)) / 2
    if n < 0:
        return (t ** (n + 1) * sin(a * t**2 + d) - 2 * a * _power_beside_sine(n + 2, a, d + sympy.pi / 2, t)) / (n + 1)
    by_parts = -(t ** (n - 1)) * cos(a * t**2 + d) / (2 * a)
    if n == 1:
        return by_parts
    return by_parts + (n - 1) / (2 * a) * _power_beside_sine(n - 2, a, d + sympy.pi / 2, t)


def dilogarithm(u: Expr, g: Expr, x: Expr) -> Expr | None:
    """int k log(u)/(x - p) dx for u = a x + b and s = u(p) != 0: k (log(u) log(1 - u/s) + Li_2(u/s)).

    For s > 0 it is k (log(s) log(x - p) - Li_2(1 - u/s)), which is real where log(u) is.

    >>> x = sympy.Symbol("x")
    >>> print(dilogarithm(x, 1 / (x + 1), x))
    log(x)*log(x + 1) + polylog(2, -x)
    """
    k, rest = g.as_independent(x, as_Add=False)
    base, exponent = rest.as_base_exp()
    linear = all(e.is_polynomial(x) and sympy.degree(e, x) == 1 for e in (u, base))
    if exponent != -1 or not linear:
        return None
    slope = base.diff(x)
    s = u.subs(x, x - base / slope).expand()
    if s == 0 or s.has(x):
        return None
    w = sympy.expand(u / s)
    if s.is_positive:
        return k / slope * (log(s) * log(base) - sympy.polylog(2, 1 - w))
    return k / slope * (log(u) * log(1 - w) + sympy.polylog(2, w))


def in_complex_exponentials(term: Expr, x: Expr) -> Expr | None:
    """Waves as sums of exponentials: Ei, error functions and incomplete gamma functions of complex arguments."""
    if not term.has(sin, cos):
        return None
    parts = sympy.Add.make_args(sympy.expand(term.rewrite((sin, cos), exp), power_exp=False))
    if len(parts) > _MOST_EXPONENTIALS:
        return None
    return sum_of([integral_of_product(part, x) or incomplete_gamma(part, x) for part in parts])
