"""The levels of the three standard equations: a solution with a polynomial of degree n, for all n at once.

1. At most three singular points, all regular: with w, a Moebius map of z with the singular points 1, -1, oo,

    y = (1 - w)^e1 (1 + w)^e2 P_n^(d1, d2)(w),        n = (-1 - d1 - d2 - d3)/2,                                    (1)

d_i the exponent differences with signs and e_i = (1 + d_i)/2 - mu_i/4.

2. S_z = q + r/z + b/z^2, kappa^2 = q, d^2 = 1 + 4 b:

    y = z^e exp(-kappa z) L_n^(d)(2 kappa z),        n = -r/(2 kappa) - (1 + d)/2.                                  (2)

3. S = alpha x^2 + beta x + gamma on the whole line: y = exp(-kappa (x - c)^2/2) H_n(sqrt(kappa) (x - c)), kappa^2 = alpha.

Which solutions are found.  At an end that is a regular point, the smaller solution is an eigenvector of the local monodromy;
at an irregular one it is the decaying one.  1. If the ends are two of the three points, the monodromy about both generates the
group, and y is an eigenvector of all of it: y'/y is rational.  If both ends are the same point (z runs through a line between
the two others), y belongs to the same eigenvalue of A B and of B A, A and B the monodromy about the other two; then A y belongs
to it for A B as well, so that it is a multiple of y unless A B is a scalar, which isn't the case for almost all parameters,
and eigenvalues are continuous.  2. z^(-e) exp(kappa z) y is entire, and Whittaker's asymptotic expansion, which holds for
|arg z| < 3 pi/2, bounds it by a power of z everywhere: a polynomial.  3. Likewise, with |arg x| < 3 pi/4 about both ends.
So every square integrable y is of this kind, and the list is complete.

References: R. Dutt, A. Khare & U. P. Sukhatme, Amer. J. Phys. 56 (1988) 163; F. Cooper, A. Khare & U. Sukhatme, Phys. Rep. 251
(1995) 267; DLMF 13.14, 15.10, 18.8.

In the wave functions every factor |t - c| is written by its half angle, exp(theta) + 1 = 2 exp(theta/2) cosh(theta/2) and so
on; constant factors are dropped, and the norm, a product of Gamma functions, belongs to the function as printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import chain, product
from typing import Any

import sympy

from kovacic.bound_states.ends import leading
from kovacic.bound_states.energies import Root, conjugate, energies_with, shortest_form, tidied
from kovacic.bound_states.frame import SingularFrame, Spot, frames, linear_factors
from kovacic.bound_states.levels import Levels
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Uncovered, exceeds
from kovacic.limits import Budget
from kovacic.parametric.solutions import jacobi


@dataclass
class WaveProduct:
    """constant * prod base^power, e among the bases."""

    constant: Any = sympy.S.One
    powers: dict[Any, Any] = field(default_factory=dict)

    def times(self, other: WaveProduct, power: Any) -> WaveProduct:
        """The product with a power of another one."""
        powers = dict(self.powers)
        for base, k in other.powers.items():
            powers[base] = powers.get(base, 0) + k * power
        return WaveProduct(self.constant * other.constant**power, powers)

    def shown(self) -> Any:
        """Without the constant."""
        short = {base: shortest_form(power) for base, power in self.powers.items()}
        exponent = short.pop(sympy.E, sympy.S.Zero)
        return sympy.Mul(*(base ** sympy.factor_terms(power) for base, power in short.items())) * sympy.exp(exponent)


#: The function of theta/2 by which t - c is written.
_OF_HALF_ANGLE = {
    ("exp", 1): sympy.sinh,
    ("exp", -1): sympy.cosh,
    ("cosh", 1): sympy.sinh,
    ("cosh", -1): sympy.cosh,
    ("cos", 1): sympy.sin,
    ("cos", -1): sympy.cos,
}


def factor_at(frame: SingularFrame, c: Any) -> WaveProduct:
    """|t - c| on the domain."""
    original = frame.original
    half = original.theta / 2
    if (original.kind, c) == ("exp", 0):  # as e^theta, which is one power with those of the half angles
        return WaveProduct(powers={sympy.E: original.theta})
    # c isn't inside the domain: t is larger than c there, unless c is beyond the upper end
    _, high = original.range
    sign = -1 if sympy.simplify(c - high).is_nonnegative else 1
    function = _OF_HALF_ANGLE.get((original.kind, c))
    if function is None:
        return WaveProduct(powers={sign * (original.t - c): 1})
    if original.kind == "exp":
        return WaveProduct(sympy.Integer(2), {sympy.E: half, function(sign * half): 1})
    return WaveProduct(sympy.Integer(2), {function(half): 2})


def as_product(frame: SingularFrame, expression: Any) -> WaveProduct:
    """|expression|, a rational function of t, up to its sign."""
    constant, exponents = linear_factors(expression, frame.question.t)
    found = WaveProduct(sympy.Abs(constant))
    for root, exponent in exponents.items():
        found = found.times(factor_at(frame, root), exponent)
    return found


def moebius(z: Any, first: Any, second: Any, third: Any) -> Any:
    """The map to 1, -1, oo."""

    def share(c: Any) -> Any:
        """(z - c)/(second - c), without the factors that are infinite."""
        return 1 if c == sympy.oo else (z - c) / (1 if second == sympy.oo else second - c)

    return 1 - 2 * share(first) / share(third)


def _order_of_points(frame: SingularFrame, roots: list[Root]) -> list[int]:
    """Which points are 1, -1 and oo: of the first two the right end, and then the other one, come first.

    The last one doesn't depend on E as the two others do; else it is the first that is no end.
    """
    depend = [root.unknown for root in roots]
    sides = [spot.sides for spot in frame.spots]
    last = min(range(3), key=lambda k: (depend.count(depend[k]) != 1, sides[k] != ()))
    return sorted(range(3), key=lambda k: (k == last, 1 not in sides[k], sides[k] == ()))


#: A solution y in the user's variable, up to a factor, and the integral of its square.
Wave = tuple[Any, Any]


def jacobi_wave(frame: SingularFrame, roots: list[Root], deltas: list[Any]) -> Wave:
    """The solution by Jacobi's polynomials."""
    z, n = frame.z, frame.question.signs.n
    order = _order_of_points(frame, roots)
    w_of_z = moebius(z, *(frame.spots[k].point for k in order))
    if any(sympy.cancel(w_of_z + sympy.I * form) == 0 for form in (z, 1 / z)):  # w = -i z, or -i/z
        order[0], order[1] = order[1], order[0]
        w_of_z = -w_of_z
    points = [(frame.spots[k], deltas[k]) for k in order]
    (first, d1), (second, d2), _ = points
    w = sympy.factor(w_of_z.xreplace({z: frame.coordinate}))
    # (dw/dx)^2 = scale (1 - w)^mu1 (1 + w)^mu2
    slope = sympy.diff(w_of_z, z) ** 2 * frame.slope
    _, scale = leading(slope / ((1 - w_of_z) ** first.mu * (1 + w_of_z) ** second.mu), z)
    a, b = shortest_form(d1), shortest_form(d2)
    if w.has(sympy.I):
        powers, r, dropped = _real_powers(frame, sympy.factor(w / sympy.I), first.exponent(d1))
        y = powers * ((-sympy.I) ** n * jacobi(n, a, b, sympy.I * r))
        middle = 2 * sympy.pi * sympy.gamma(-n - a - b) / (sympy.gamma(-n - a) * sympy.gamma(-n - b))
        norm = -_jacobi_integral((first, a), (second, b), n, middle) / dropped
    else:
        whole = WaveProduct().times(as_product(frame, 1 - w), first.exponent(d1))
        whole = whole.times(as_product(frame, 1 + w), second.exponent(d2))
        y = whole.shown() * jacobi(n, a, b, _argument(frame, w))
        norm = _norm_between(points, n) / whole.constant**2
    return y, _tidy(frame, norm / sympy.sqrt(sympy.Abs(scale)))


def _argument(frame: SingularFrame, w: Any) -> Any:
    """w in the user's variable."""
    original = frame.original
    t = frame.question.t
    in_x = sympy.expand(sympy.apart(w, t)).xreplace({t: original.t})
    if original.kind != "exp":
        return in_x
    quotient = (t - 1) / (t + 1)
    for form, function in (quotient, sympy.tanh), (1 / quotient, sympy.coth):
        sign = sympy.cancel(w / form)
        if sign in (1, -1):
            return sign * function(original.theta / 2)
    return in_x.replace(lambda e: e.is_Pow and e.base.func is sympy.exp, lambda e: sympy.exp(e.base.exp * e.exp))


def _real_powers(frame: SingularFrame, r: Any, e1: Any) -> tuple[Any, Any, Any]:
    """For w = i r with a real r: (1 - i r)^(p + i q) (1 + i r)^(p - i q) = (1 + r^2)^p exp(2 q atan(r)), p + i q = e1.

    1 + r^2 = cosh^2 for r = +-sinh, and = 1/sin^2 for r = +-cot, where atan(r) is an angle, too.
    So this is written, without a constant; with r in the user's variable, and the square of the constant.
    """
    p = sympy.expand((e1 + conjugate(e1)) / 2)
    q = sympy.expand((e1 - conjugate(e1)) / (2 * sympy.I))
    original, t = frame.original, frame.question.t
    theta = original.theta
    sign = sympy.cancel(r * t)
    if original.kind == "tan" and sign in (1, -1):
        powers = sympy.sin(theta) ** shortest_form(-2 * p) * sympy.exp(-2 * q * sign * theta)
        return powers, sign * sympy.cot(theta), sympy.exp(2 * sympy.pi * q * sign)
    in_x = r.xreplace({t: original.t})
    root = 1 + in_x**2, p
    if original.kind == "sinh" and sympy.expand(r**2 - t**2) == 0:
        root = sympy.cosh(theta), shortest_form(2 * p)
    return sympy.Pow(*root) * sympy.exp(2 * q * sympy.atan(in_x)), in_x, sympy.S.One


def _jacobi_integral(first: tuple[Spot, Any], second: tuple[Spot, Any], n: Any, middle: Any) -> Any:
    """int (1 - v)^(a + i) (1 + v)^(b + j) P_n^(a, b)(v)^2 dv over (-1, 1), (i, j) = (1 - mu1, 1 - mu2).

    mu is 1, 1, 2 or 2, 2, 0 at the three points.  With `middle` = Gamma(n + a + 1) Gamma(n + b + 1)/Gamma(n + a + b + 1)
    [Gradshteyn & Ryzhik 7.391; DLMF 18.3].  On the line v = i r all of these have the same factor,
    2 sin(pi a) sin(pi b)/sin(pi (a + b)), which is in another `middle`.
    """
    (left_end, a), (right_end, b) = first, second
    common = 2 ** (a + b) * middle / sympy.factorial(n)
    plain = 2 * common / (2 * n + a + b + 1)
    left = common / a
    right = common / b
    half_sum, half_difference = shortest_form((a + b) / 2), shortest_form((a - b) / 2)
    known = {
        (0, 0): plain,
        (-1, 0): left,
        (0, -1): right,
        (-1, -1): common * half_sum / (half_sum**2 - half_difference**2),  # common (1/a + 1/b)/2
        (1, -1): 2 * right - plain,
        (-1, 1): 2 * left - plain,
    }
    return known[1 - left_end.mu, 1 - right_end.mu]


def _norm_between(points: Sequence[tuple[Spot, Any]], n: Any) -> Any:
    """int y^2 dx between two of the points w = 1, -1, oo, with the size of (dw/dx)^2 apart.

    For oo: w = (3 - v)/(1 + v) runs from 1 to it for v from 1 to -1, and P_n^(a, b)(w) = (2/(1 + v))^n P_n^(a, c)(v).
    """
    *ends, third = points
    ends.sort(key=lambda point: not point[0].sides)  # w -> -w
    (end, a), (other, b) = ends
    powers = sympy.S.Zero
    if third[0].sides:
        powers = 2 * end.exponent(a) + 4 * other.exponent(b) + 2 * n - (end.mu + 2 * other.mu - 4) / 2
        ends[1], b = third, third[1]
    middle = sympy.gamma(n + a + 1) * sympy.gamma(n + b + 1) / sympy.gamma(n + a + b + 1)
    return 2**powers * _jacobi_integral(ends[0], ends[1], n, middle)


def laguerre_wave(frame: SingularFrame, origin: Spot, values: list[Any]) -> Wave:
    """The solution by Laguerre's polynomials, for kappa and delta."""
    kappa, delta = values
    signs, z = frame.question.signs, frame.z
    n = signs.n
    whole = WaveProduct().times(as_product(frame, frame.coordinate), origin.exponent(delta))
    base, m = frame.coordinate.as_base_exp()
    in_x = _argument(frame, base) ** m
    rate = shortest_form(2 * kappa)
    y = whole.shown() * sympy.exp(-rate * in_x / 2) * sympy.assoc_laguerre(n, shortest_form(delta), rate * in_x)
    # (dz/dx)^2 = scale z^mu with mu = 0, 1, 2, as E z^(-mu) occurs in S_z
    scale = frame.slope / z**origin.mu
    weight = sympy.gamma(n + delta + 1) / sympy.factorial(n)
    known = {0: 1, 1: 2 * n + delta + 1, -1: 1 / delta}
    if signs.sign(kappa) == -1:  # where z is negative
        rate = -rate
    integral = rate ** (origin.mu - 2 - delta) * weight * known[1 - origin.mu]
    return y, _tidy(frame, integral / sympy.sqrt(sympy.Abs(scale)) / whole.constant**2)


def _tidy(frame: SingularFrame, norm: Any) -> Any:
    """The norm or its form with simplified quotients of Gamma functions, the shorter; doubled on half of a domain.

    A sine from the reflection formula may be 0 where a Gamma function is infinite: such a form has no value at
    integers.
    """
    simplified = sympy.gammasimp(norm).replace(
        lambda e: e.func == sympy.gamma and e.args[0].is_integer, lambda e: sympy.factorial(e.args[0] - 1)
    )
    forms = [norm] if simplified.has(sympy.sin) else [norm, simplified]
    shortened = []
    for form in forms:
        form = form.replace(
            lambda e: e.func in (sympy.gamma, sympy.exp), lambda e: e.func(shortest_form(sympy.together(e.args[0])))
        )
        form = form.replace(lambda e: e.is_Add and e.has(sympy.Dummy), shortest_form)
        for _ in range(2):  # short exponents of one base are added up
            form = sympy.powsimp(form).replace(
                lambda e: e.is_Pow and not e.exp.is_number, lambda e: e.base ** shortest_form(sympy.together(e.exp))
            )
        shortened.append(form)
    return min(shortened, key=lambda e: len(str(e))) * (1 if frame.fold is None else 2)


@dataclass(frozen=True)
class ExponentForm:
    """A standard equation in a frame: its `roots`, and what follows from them with signs, as functions of a list of them.

    `degree` is that of the polynomial in a solution, and `wave` the solution where the degree is n.  The last roots are the
    exponent differences at the `spots`; one before them is the rate of decay kappa, and `outwards` the signs of z where it is
    infinite.
    """

    frame: SingularFrame
    roots: list[Root]
    degree: Callable[[list[Any]], Any]
    wave: Callable[[list[Any]], Wave]
    spots: Sequence[Spot] = ()
    outwards: Sequence[int] = ()

    def levels(self) -> Iterator[Levels]:
        """The families of levels, for each choice of signs.

        Both ends are singular points in z, or one and the middle of the domain, for even and odd solutions.  V is regular at
        the middle, as at all points inside: `check_poles`.
        """
        if sorted(chain.from_iterable(spot.sides for spot in self.frame.spots)) != [0, 1]:
            raise Uncovered("an end of the domain is an ordinary point of the equation")
        question = self.frame.question
        signs, plain = question.signs, question.plain
        radicals = dict(chain.from_iterable(root.radicals for root in self.roots))
        are_real = [root.reality for root in self.roots]
        for signed in _choices(self.roots):
            for energy, of_n in energies_with(sympy.expand(self.degree(signed) - signs.n), self.roots, question.E):
                values = [root.xreplace(of_n) for root in signed]
                known = tidied([*are_real, *self._demands(values)], signs, radicals)
                if sympy.false not in known:
                    y, norm = self.wave(values)
                    found = Levels(signs.n, energy, y, known, self._zeros(values, signs.n), norm)
                    yield found.mapped(lambda part: plain(part.xreplace(radicals)))

    def _at_spots(self, values: list[Any]) -> Iterator[tuple[Spot, Any]]:
        """The spots with the signed exponent differences there."""
        return zip(self.spots, values[len(values) - len(self.spots) :], strict=True)

    def _demands(self, values: list[Any]) -> Iterator[Any]:
        """The conditions for the solution to be square integrable at the ends; that the roots are real is another one."""
        for direction in self.outwards:
            yield exceeds(direction * values[0], 0, strict=True)
        for spot, delta in self._at_spots(values):
            for side in self.frame.ends_at(spot):
                yield self.frame.question.demand(side, spot.mu, delta)

    def _zeros(self, values: list[Any], n: Any) -> Any:
        """Their number inside the domain: n; twice as many about the middle, and one there for an odd solution."""
        for spot, delta in self._at_spots(values):
            if len(self.frame.ends_at(spot)) < len(spot.sides):
                return 2 * n + int(bool(delta.is_positive))
        return n


def three_regular_points(frame: SingularFrame) -> ExponentForm:
    """Equation (1)."""
    spots = frame.spots
    if len(spots) != 3 or any(spot.square is None for spot in spots):
        raise Uncovered("the equation hasn't three singular points, all of them regular")
    roots = [Root.of(spot.square, frame.question.E) for spot in spots]
    return ExponentForm(
        frame,
        roots,
        degree=lambda deltas: (-1 - sympy.Add(*deltas)) / 2,
        wave=lambda deltas: jacobi_wave(frame, roots, deltas),
        spots=spots,
    )


def whittaker(frame: SingularFrame) -> ExponentForm:
    """Equation (2), from S_z = q + r/z + b/z^2."""
    E = frame.question.E
    q, r, b = _coefficients(frame.S * frame.z**2, frame, 2)
    if not frame.S.has(frame.z):
        raise Uncovered("S is constant")
    spots = {spot.point: spot for spot in frame.spots}
    origin = spots.get(0, Spot(sympy.Integer(0), 1 + 4 * b, 0))
    return ExponentForm(
        frame,
        [Root.of(sympy.factor(q), E, positive=True), Root.of(sympy.factor(1 + 4 * b), E)],
        degree=lambda values: -r / (2 * values[0]) - (1 + values[1]) / 2,
        wave=lambda values: laguerre_wave(frame, origin, values),
        spots=(origin,),
        outwards=[frame.direction(side) for side in frame.ends_at(spots[sympy.oo])],
    )


def oscillator(frame: SingularFrame) -> ExponentForm:
    """Equation (3): S = alpha x^2 + beta x + gamma on the whole line."""
    alpha, beta, gamma = _coefficients(frame.S, frame, 2)
    if (frame.original.kind, frame.coordinate, *frame.original.domain) != ("x", frame.question.t, -sympy.oo, sympy.oo):
        raise Uncovered("the equation isn't one in x on the whole line")
    question = frame.question
    n = question.signs.n
    shifted = question.x + sympy.factor(beta / (2 * alpha))

    def wave(values: list[Any]) -> Wave:
        (kappa,) = values
        y = sympy.exp(-kappa * shifted**2 / 2) * sympy.hermite(n, sympy.sqrt(kappa) * shifted)
        return y, 2**n * sympy.factorial(n) * sympy.sqrt(sympy.pi / kappa)

    return ExponentForm(
        frame,
        [Root.of(sympy.factor(alpha), question.E, positive=True)],
        degree=lambda values: (beta**2 / (4 * alpha) - gamma) / (2 * values[0]) - sympy.Rational(1, 2),
        wave=wave,
        outwards=(1,),
    )


def _choices(roots: list[Root]) -> Iterator[list[Any]]:
    """The roots with their signs; those of unknowns are part of them.

    A pair of complex conjugate roots has one sign, since n is real.
    """
    are_complex = [k for k, root in enumerate(roots) if root.value.has(sympy.I)]
    signs = [root.signed for root in roots]
    if len(are_complex) == 1:
        return  # n isn't real
    for second in are_complex[1:]:  # nan is the conjugate of the first one there
        signs[second] = [sympy.nan]
    for choice in product(*signs):
        yield [conjugate(choice[are_complex[0]]) if value is sympy.nan else value for value in choice]


def _coefficients(function: Any, frame: SingularFrame, degree: int) -> list[Any]:
    """The coefficients of a polynomial of this degree in z.  Raises `Uncovered` for any other function."""
    quotient = sympy.cancel(function)
    if sympy.denom(quotient).has(frame.z) or sympy.degree(sympy.numer(quotient), frame.z) != degree:
        raise Uncovered("the equation isn't the standard one")
    return list(sympy.Poly(quotient, frame.z).all_coeffs())


def bessel_form(frame: SingularFrame) -> ExponentForm:
    """S_z = r/z + b/z^2 between 0 and oo: no solution is square integrable at both ends, and there is no degree.

    Where z^(-e) y is entire and y decays like exp(-2 sqrt(r z)), which holds for |arg z| < 3 pi [Martinet & Ramis], it is
    bounded everywhere and tends to 0: y = 0.
    """
    r, _ = _coefficients(frame.S * frame.z**2, frame, 1)
    points = {spot.point for spot in frame.spots if spot.sides}
    if points != {0, sympy.oo} or frame.fold is not None or r.has(frame.question.E):
        raise Uncovered("the domain isn't from 0 to oo")
    return ExponentForm(frame, [], degree=lambda _: -sympy.S.One, wave=lambda _: (0, 1))


_STANDARD_FORMS: dict[str, Callable[[SingularFrame], ExponentForm]] = {
    "Hermite's polynomials": oscillator,
    "Whittaker's equation": whittaker,
    "three regular singular points": three_regular_points,
    "Bessel's equation": bessel_form,
}


def standard_levels(question: SpectralProblem, budget: Budget) -> tuple[tuple[Levels, ...], str]:
    """The levels by the first coordinate and standard equation that fit, and its name.  Raises `Uncovered` if none fits."""
    for frame in frames(question, budget) if not question.original.is_circular else ():
        for name, standard_form in _STANDARD_FORMS.items():
            with suppress(Uncovered):
                found = standard_form(frame).levels()
                return tuple(levels for levels in found if not levels.is_empty), name
    raise Uncovered("no formula is known")
