"""Integrands with waves (sines and cosines): changes of variable that make them rational; Si and Ci, Fresnel functions.

s = sin(theta) and c = cos(theta) for a linear theta = w x + phi.  A rational function R(s, c) is one of

    c if R is odd in s,    s if R is odd in c,    tan(theta) if R(-s, -c) = R(s, c),    tan(theta/2) otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import product
from typing import Any

import sympy
from sympy import Add, Dummy, I, S, atan, cancel, cos, expand, log, pi, sin, sqrt, tan, together
from sympy.simplify.fu import TR2, TR2i

from kovacic.general_solution.integrands import ChangeOfIntegrand, UnknownIntegral, integral_of_fraction, require
from kovacic.general_solution.substitution import by_functions, in_single_waves
from kovacic.general_solution.undetermined import undetermined

Expr = Any  # SymPy publishes no types


class WaveChange(ChangeOfIntegrand):
    """The change to a sine, a cosine or a tangent u of a linear angle."""

    def back(self, found: Expr) -> Expr:
        """An integral in the angle; logarithms are real for small angles if they can be."""
        early = sympy.Rational(99 if self.u.func is cos else 1, 100)
        found = found.replace(log, lambda q: log(-q if q.subs(self.t, early).is_negative else q))
        if self.u.func is tan:
            return TR2i(_at_tangent(found, self.u.args[0], self.t))
        return TR2i(found.xreplace({self.t: self.u}))


def _at_tangent(found: Expr, angle: Expr, u: Expr) -> Expr:
    """A function of u = tan(angle) in sines and cosines, without jumps at the poles of the tangent.

    A polynomial of the degree d under a logarithm is Q(sin, cos)/cos^d, and u^2 + 1 = 1/cos^2: with log(cos^2)/2 for log(cos),
    of the same slope, the logarithms of the cosine cancel unless the integrand has poles there.
    """
    s, c = sin(angle), cos(angle)
    in_cosine = Dummy()  # log(cos(angle)^2)
    known = {arc: _continuous_angle(arc.args[0], angle, u) for arc in found.atoms(atan)}
    for logarithm in found.atoms(log):
        parts = sympy.fraction(together(logarithm.args[0]))
        if not all(part.is_polynomial(u) for part in parts):
            continue
        degrees = [sympy.degree(part, u) for part in parts]
        in_waves = (in_single_waves(part.subs(u, s / c) * c**k) for part, k in zip(parts, degrees, strict=True))
        n, m = (part.as_content_primitive()[1] for part in in_waves)
        known[logarithm] = log(n / m) - sympy.Rational(degrees[0] - degrees[1], 2) * in_cosine
    whole = expand(found.xreplace(known), deep=False).xreplace({in_cosine: 2 * log(c)})
    return whole.xreplace({u**2 + 1: c**-2}).xreplace({u: s / c})


def _continuous_angle(line: Expr, angle: Expr, u: Expr) -> Expr:
    """atan(a tan(theta) + b), for the line a u + b, plus pi at every pole of the tangent, up to a constant; else atan(line).

    (cos theta, a sin theta + b cos theta) = M v for v = (cos theta, sin theta).  M is a rotation, by the direction of
    (1 + a, b) for a > 0, times a positive definite P; so the angle of M v is theta, plus a constant, plus that from v to
    P v, which is below pi/2: D = v . P v > 0, N is the cross product of v and P v.
    """
    line = expand(line)
    a, b = line.coeff(u, 1), line.coeff(u, 0)
    if a.is_negative:
        return -_continuous_angle(-line, angle, u)
    if line != expand(a * u + b) or not a.is_positive or not b.is_real:
        return atan(line)
    s, c = sin(angle), cos(angle)
    image = a * s + b * c
    along = (c * c + s * image, c * image - s * c)
    D = (1 + a) * along[0] + b * along[1]
    N = (1 + a) * along[1] - b * along[0]
    return angle + atan(cancel(in_single_waves(N) / in_single_waves(D)))


@dataclass(frozen=True)
class _InOneAngle:
    """R(s, c) for s = sin(theta) and c = cos(theta)."""

    R: Expr
    s: Expr
    c: Expr
    theta: Expr

    @classmethod
    def of(cls, e: Expr) -> _InOneAngle | None:
        """An expression whose waves have multiples of one angle for arguments, the largest such theta; None for others."""
        waves = sorted(e.atoms(sin, cos), key=str)
        theta = common_factor([wave.args[0] for wave in waves])
        if theta is None:
            return None
        s, c = Dummy(), Dummy()
        in_one_angle = {}
        for wave in waves:
            n = int(cancel(wave.args[0] / theta))
            sine = sympy.sign(n) * s * sympy.chebyshevu(abs(n) - 1, c)
            in_one_angle[wave] = sympy.chebyshevt(abs(n), c) if wave.func is cos else sine
        return cls(e.xreplace(in_one_angle), s, c, theta)


def wave_changes(term: Expr, x: Expr) -> Iterator[WaveChange]:
    """The changes at the head of the module that make a term of waves rational except for a root of a wave."""
    found = _InOneAngle.of(in_waves(term))
    if found is None or found.R.has(x) or found.theta.diff(x).has(x) or not found.theta.has(x):
        return
    R, s, c, theta = found.R, found.s, found.c, found.theta
    u = Dummy()
    root = sqrt(1 - u**2)
    square = 1 + u**2

    def change(f: Expr, sine: Expr, cosine: Expr, wave: Expr) -> WaveChange:
        """For int f du with the sine and the cosine in u."""
        in_u = (f.subs({s: sine, c: cosine}) / theta.diff(x)).replace(log, lambda argument: log(cancel(argument)))
        # with a root as a factor, as the rules for roots of polynomials know it
        return WaveChange(together(cancel(in_u)), u, wave)

    is_odd_in_s, is_odd_in_c = (cancel(R + R.xreplace({wave: -wave})) == 0 for wave in (s, c))
    if is_odd_in_s:
        yield change(-R / s, root, u, cos(theta))
    if is_odd_in_c:
        yield change(R / c, u, root, sin(theta))
    if is_odd_in_s or is_odd_in_c:
        return
    if cancel(R - R.xreplace({s: -s, c: -c})) == 0:
        yield change(R / square, u / sqrt(square), 1 / sqrt(square), tan(theta))
    else:
        yield change(2 * R / square, 2 * u / square, (1 - u**2) / square, tan(theta / 2))


def in_waves(e: Expr) -> Expr:
    """The expression with cos(u) + i sin(u) for exp(i u)."""
    angles = {f: expand(f.args[0] / I) for f in e.atoms(sympy.exp)}
    return e.xreplace({f: cos(u) + I * sin(u) for f, u in angles.items() if not u.has(I)})


def common_factor(multiples: Sequence[Expr]) -> Expr | None:
    """The largest u of which all are integer multiples, or None."""
    ratios = [cancel(multiple / multiples[0]) for multiple in multiples]
    if not ratios or not all(ratio.is_Rational for ratio in ratios):
        return None
    return multiples[0] * reduce(sympy.gcd, ratios)  # gcd_list stops at 1, though 1/2 may follow


def wave_zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """The zeros between two numbers of a polynomial in the waves of one angle over Q, by u = tan(theta/2), and theta = pi."""
    found = _InOneAngle.of(e)
    if found is None or not found.R.is_polynomial(found.s, found.c) or found.theta.diff(x).free_symbols:
        return
    R, s, c, theta = found.R, found.s, found.c, found.theta
    u = Dummy(real=True)
    in_u = sympy.numer(together(R.subs({s: 2 * u / (1 + u**2), c: (1 - u**2) / (1 + u**2)})))
    angles = [2 * atan(root) for root in dict.fromkeys(sympy.real_roots(sympy.Poly(in_u, u, extension=True)))]
    rate, phase = theta.diff(x), theta.subs(x, 0)
    for angle in [*angles, pi] if R.subs({s: 0, c: -1}) == 0 else angles:
        place, period = (angle - phase) / rate, abs(2 * pi / rate)
        n = sympy.ceiling((first - place) / period)
        while (zero := place + n * period) <= last:
            yield zero
            n += 1


def rational_in_waves(e: Expr) -> list[Expr]:
    """A + B s with A and B rational in c, and A + B c in s; none where it isn't rational in the waves of one angle.

    >>> x = sympy.Symbol("x")
    >>> rational_in_waves(sin(2 * x) / sin(x))[0]
    2*cos(x)
    """
    found = _InOneAngle.of(e)
    if found is None or not found.R.is_rational_function(found.s, found.c):
        return []
    s, c = found.s, found.c
    parts = ((u, *_of_square(found.R, u, v)) for u, v in ((s, c), (c, s)))
    return [(A + B * u).xreplace({s: sin(found.theta), c: cos(found.theta)}) for u, A, B in parts]


def fractions_of_waves(e: Expr, x: Expr) -> list[Expr]:
    """Forms with partial fractions in the cosine, and in the sine, for parts rational in both; none for polynomials.

    Of sin(x)^2/cos(x) - 1/(2 cos(x)) the second form is 1/(2 cos(x)) - cos(x), which has a multiple of cos(x) to be left out.
    """
    e = expand(TR2(e))
    kept = {Dummy(): f for f in e.atoms(sympy.Function, sympy.Integral) if f.has(x) and not isinstance(f, sin | cos)}
    masked = e.xreplace({f: letter for letter, f in kept.items()})
    found = _InOneAngle.of(masked)
    if found is None or found.R.is_polynomial(found.s, found.c):
        return []
    rational = by_functions(found.R, lambda f: f.is_rational_function(found.s, found.c) and not f.has(x, *kept))
    is_halved = any(wave.args[0] == 2 * found.theta for wave in masked.atoms(sin, cos))
    forms = (
        Add(*(other * _in_fractions(replace(found, R=R), k, doubled=doubled) for other, R in rational.items()))
        for k, doubled in product((0, 1), (False, True)[: 1 + is_halved])
    )
    return [sympy.expand_mul(form).xreplace(kept) for form in forms]


def _in_fractions(given: _InOneAngle, k: int, *, doubled: bool) -> Expr:
    """A + B s with partial fractions A and B in c for k = 0, A + B c in s for k = 1, of the double angle if it can be."""
    R, s, c, theta = given.R, given.s, given.c, given.theta
    A, B = _of_square(R, s, c)
    if doubled and all(cancel(f - f.subs(c, -c)) == 0 for f in (A, B * c)):  # c^2 = (1 + C)/2 and s c = S/2
        A, B = (cancel(part.subs(c, sqrt((1 + c) / 2))) for part in (A, B / (2 * c)))
        theta *= 2
    if k == 1:
        A, B = _of_square(A + B * s, c, s)
        s, c = c, s
    A, B = (Add.make_args(sympy.apart(part, c)) for part in (A, B))
    terms = (*A, *(term * s for term in B))
    back = dict(zip((s, c), (sin(theta), cos(theta))[:: 1 - 2 * k], strict=True))
    polynomials, fractions = sympy.sift(terms, lambda term: term.is_polynomial(s, c), binary=True)
    return in_single_waves(Add(*polynomials).xreplace(back)) + Add(*fractions).xreplace(back)


def _of_square(R: Expr, u: Expr, v: Expr) -> tuple[Expr, Expr]:
    """A and B, rational in v, with R = A + B u where u^2 = 1 - v^2: the even part, and the odd one divided by u."""
    other = R.subs(u, -u)
    even = (cancel(part) for part in ((R + other) / 2, (R - other) / (2 * u)))
    A, B = (cancel(part.subs(u, sqrt(1 - v**2))) for part in even)
    return A, B


def beside_waves(term: Expr, x: Expr) -> Expr:
    """int R cos(u) dx for linear u and rational R by Si and Ci, for quadratic u by Fresnel functions, too.

    Products of waves are sums of such terms.

    >>> x = sympy.Symbol("x")
    >>> beside_waves(sin(x) / x, x)
    Si(x)
    >>> print(beside_waves(x**2 * cos(x**2), x))
    x*sin(x**2)/2 - sqrt(2)*sqrt(pi)*fresnels(sqrt(2)*x/sqrt(pi))/4
    """
    require(term.has(sin, cos))
    return Add(*(_beside_at_most_one_wave(single, x) for single in Add.make_args(in_single_waves(term))))


def _beside_at_most_one_wave(term: Expr, x: Expr) -> Expr:
    """Integral of R times at most one wave, by partial fractions k (x - c)^n; a quadratic angle has its vertex at c."""
    waves = [wave for wave in term.atoms(sin, cos) if wave.has(x)]
    wave = sympy.Mul(*waves)
    R = term / wave
    require(len(waves) <= 1 and R.is_rational_function(x))
    if not waves:
        return integral_of_fraction(R, x)
    u = wave.args[0]
    m = sympy.degree(u, x) if u.is_polynomial(x) else 0
    require(m in (1, 2))
    middle = x - u.diff(x) / u.diff(x, 2) if m == 2 else S.Zero
    total = S.Zero
    for fraction in Add.make_args(sympy.apart(R.subs(x, x + middle), x)):
        k, power = fraction.as_independent(x, as_Add=False)
        line, n = (x, S.Zero) if power == 1 else power.as_base_exp()
        slope = line.diff(x)
        require(not slope.has(x))
        c = expand(middle + x - line / slope)
        a, *others, d = map(expand, sympy.Poly(u.subs(x, x + c), x).all_coeffs())
        require(not any(others))
        phase = d + pi / 2 if wave.func is cos else d
        total += _power_beside_sine(k * slope**n, int(n), m, a, phase, x).subs(x, x - c)
    return total


def _power_beside_sine(k: Expr, n: int, m: int, a: Expr, d: Expr, t: Expr) -> Expr:
    """int k t^n sin(a t^m + d) dt for m = 1 or 2, by parts to n = m - 1, -1 or 0: elementary, Si and Ci, Fresnel functions."""
    u = a * t**m
    if n == m - 1:
        return -k / (m * a) * cos(u + d)
    if n == -1:
        return k / m * cos(d) * sympy.Si(u) + k / m * sin(d) * sympy.Ci(u)
    if n == 0:
        z = t * sqrt(2 * a / pi)
        k *= sqrt(pi / (2 * a))
        return k * cos(d) * sympy.fresnels(z) + k * sin(d) * sympy.fresnelc(z)
    later = d + pi / 2  # sin(u + later) = cos(u + d)
    if n < 0:
        k /= n + 1
        return k * t ** (n + 1) * sin(u + d) + _power_beside_sine(-k * m * a, n + m, m, a, later, t)
    k /= m * a
    return -k * t ** (n + 1 - m) * cos(u + d) + _power_beside_sine(k * (n + 1 - m), n - m, m, a, later, t)


def by_coefficients(term: Expr, x: Expr) -> Expr:
    """Y' for Y'' = g, by undetermined coefficients: polynomials times exponentials and waves.

    >>> x = sympy.Symbol("x")
    >>> by_coefficients(x * cos(x), x)
    x*sin(x) + cos(x)
    """
    found = undetermined(S.Zero, S.Zero, term, x)
    if found is None:
        raise UnknownIntegral
    return expand(found.diff(x))
