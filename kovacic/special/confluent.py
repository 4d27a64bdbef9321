"""Airy's, Bessel's, Whittaker's (Kummer's, Weber's) equations pulled back by a rational function of any degree.

The irregular places of S are the poles of f, where S = f'^2 S0(f) + O(order 2).  From there f is found up to its constant term:

- q != 0: sqrt(S/q) dx = df - (r/(2 q)) dlog f + ..., so f is the integral of the polar parts of sqrt(S/q), up to a sign at each
  place; the residues, r/(2 q) times the order of the pole, tell the signs where r != 0.  All orders of poles of S are even;
- q = 0, r = 1: S = -f'^2/f + ..., so where all orders are odd all polar parts of f are determined;
- Airy, q F'^2 F = S + ...: F is a cubic root, and all polar parts are determined.

Then h = (S + {f, x}/2)/f'^2 is S0(f + c), whose only poles are the zeros of f + c: these give c.  Where a place is ramified and
another one is not (q = 0), the zeros of f are taken from the regular places: exponent difference = multiplicity * nu.
What is found is tested by the exact identity; the theory shows that nothing of the first three kinds is overlooked but where a
scale q or a root of unity lies in the residue field of a conjugate set of poles alone.

At a finite place with the irreducible p, S = V/p^k for a p-adic unit V.  Infinity is the place z = 0 of S(1/z)/z^4, and what
is found there is a polynomial in x = 1/z.  All computing is in K[x]/p^j, so that conjugate poles stay together.

References: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; Q. Yuan, M. van Hoeij, ISSAC 2010, 37-43.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, Place, Problem, rational_square_root
from kovacic.errors import LimitExceeded
from kovacic.special.pullback import Airy, Confluent, Pullback, schwarzian

#: Irregular places up to which all signs are tried where no residue tells them.
_MOST_SIGNS = 10
#: Conjugate poles up to which roots are taken where the field has parameters: factoring there takes long.
_WITH_PARAMETERS = 2


def candidates(problem: Problem) -> Iterator[Pullback]:
    """Pull-backs that are possible, the likely ones first; each of them has to be verified.

    Raises `LimitExceeded` in the end where poles are conjugate over a larger field than the limit on constants allows.
    """
    irregular = irregular_places(problem)
    orders = [place.order for place in irregular]
    largest = max(place.degree for place in irregular)
    most = problem.budget.limits.constants if problem.field.ground == QQ else _WITH_PARAMETERS
    if largest <= most and all((order - 2) % 3 == 0 for order in orders):
        yield from _airy(problem.S, irregular)
    if largest <= most and all(order % 2 == 0 for order in orders):
        yield from _whittaker(problem.S, irregular)
    if all(order % 2 for order in orders):
        t, one = sum((square(place) for place in irregular), RatFunc(problem.S.num * 0)), problem.field.poly([1])
        yield from _with_constant(problem.S, t, one * 0, one)
    else:
        yield from _bessel_by_zeros(problem, irregular)
    if largest > most:
        raise LimitExceeded(f"f has {largest} conjugate poles; roots are taken up to degree {most}", limit="constants")


def irregular_places(problem: Problem) -> list[Place]:
    return [place for place in problem.places if place.kind in (Kind.UNRAMIFIED, Kind.RAMIFIED)]


@dataclass(frozen=True)
class PolarPart:
    """That of int sqrt(S/q) dx, up to the sign, its order, and the residue of sqrt(S/q) dx, a constant in K[x]/p."""

    part: RatFunc
    order: int
    residue: Poly


def unit(place: Place, precision: int) -> Poly:
    """V modulo p^precision, for S = V/p^k."""
    power = place.factor**precision
    return place.num * (place.den // place.factor**place.order).inverse_modulo(power) % power


def root_modulo(v: Poly, p: Poly, n: int, precision: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of v modulo p^precision, None if there is none; by Newton's method."""
    if p.degree == 1:
        w = root(v % p, n)
    else:
        extension = AlgebraicField(v.field, p, "_a")
        element = root(ExtensionPoly(extension, tuple((v % p)[k] for k in range(p.degree))), n)
        w = None if element is None else v.field.poly([part[0] for part in element.parts])
    known = 1
    while w is not None and known < precision:
        known = min(2 * known, precision)
        power = p**known
        w = (w * (n - 1) + v * (w ** (n - 1)).inverse_modulo(power)) * Fraction(1, n) % power
    return w


def root(value: Poly, n: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of a constant of the field within it, None if there is none."""
    field = value.field
    if n == 2:
        return field.sqrt(value)
    factors = field.factor(field.poly([-value, *[0] * (n - 1), 1]))
    return next((-factor[0] for factor, _ in factors if factor.degree == 1), None)


def integral_of_square_root(place: Place, q: Poly) -> PolarPart | None:
    """int sqrt(S/q) dx at an unramified place, up to its sign.

    None if S/q has no square root over the residue field, or its residues at the roots of p aren't equal.
    """
    p, m = place.factor, place.order // 2
    s = root_modulo(unit(place, m) / q, p, 2, m)
    if s is None:
        return None
    parts = decompose(RatFunc(s, p**m))
    residue = parts.residues[0].value if parts.residues else s.field.poly([])
    return None if residue.degree > 0 else PolarPart(_in_x(parts.exact, place), m - 1, residue)


def leading_square(place: Place) -> Poly:
    """T modulo p for the t = T/p^d with t'^2/t = -S + ..., d = k - 2: d^2 p'^2 T = -V."""
    p, d = place.factor, place.order - 2
    return -unit(place, 1) * (d * d * p.derivative() ** 2).inverse_modulo(p) % p


def square(place: Place) -> RatFunc:
    """The polar part of t with t'^2/t = -S + ... at a ramified place: (T'p - d T p')^2 = -T V modulo p^d for t = T/p^d."""
    p, d = place.factor, place.order - 2
    return _in_x(RatFunc(expanded_square(place, d), p**d), place)


def expanded_square(place: Place, precision: int) -> Poly:
    """T modulo p^precision, term by term; for even d = k - 2 only d/2 terms are determined."""
    p, d = place.factor, place.order - 2
    V, slope, T = unit(place, precision), p.derivative(), leading_square(place)
    scale = (d * slope * slope * T).inverse_modulo(p)
    for i in range(1, precision):
        # T + p^i e changes the difference of both sides by d (d - 2 i) p'^2 T e p^i.
        step = T.derivative() * p - d * slope * T
        rest = (step * step + T * V) // p**i
        T = T - rest * scale % p * Fraction(1, d - 2 * i) * p**i
    return T


def integral_of_cubic_root(place: Place, q: Poly) -> RatFunc | None:
    """F at a place where q F'^2 F = S + ...: F^3 = -9 t/q has a pole of order d = k - 2; None without a cubic root."""
    p, d = place.factor, (place.order - 2) // 3
    W = root_modulo(expanded_square(place, d) * -9 / q, p, 3, d)
    return None if W is None else _in_x(RatFunc(W, p**d), place)


def _in_x(function: RatFunc, place: Place) -> RatFunc:
    """A function of the coordinate of the place as one of x."""
    if not place.at_infinity:
        return function
    field = function.field
    return function(RatFunc(field.poly([1]), field.poly([0, 1])))


# ------------------------------------------------------------------------------------------ f from its polar parts


def _airy(S: RatFunc, places: list[Place]) -> Iterator[Pullback]:
    for q in _scales(places, lambda place: leading_square(place) * -9, 3):
        parts = [part for place in places if (part := integral_of_cubic_root(place, q)) is not None]
        if len(parts) < len(places):
            continue
        f = sum(parts, RatFunc(q * 0))
        c = _over_slope(S, f) / q - f
        if c.is_polynomial and c.num.degree <= 0:
            yield Pullback(Airy(q), f + c)


def _whittaker(S: RatFunc, places: list[Place]) -> Iterator[Pullback]:
    for q in _scales(places, lambda place: unit(place, 1), 2):
        parts = [part for place in places if (part := integral_of_square_root(place, q)) is not None]
        if len(parts) < len(places):
            continue
        for signs in _signs(parts):
            f = sum((part.part * sign for part, sign in zip(parts, signs, strict=True)), RatFunc(q * 0))
            r = parts[0].residue * q * Fraction(2, parts[0].order)
            yield from _with_constant(S, f, q, r)


def _signs(parts: list[PolarPart]) -> Iterator[Sequence[int]]:
    """The signs of the parts: their residues are proportional to the orders; all signs where the residues vanish."""
    rates = [part.residue * Fraction(1, part.order) for part in parts]
    if not any(rates):
        if len(parts) <= _MOST_SIGNS:
            yield from product((1,), *[(1, -1)] * (len(parts) - 1))
    elif all(rate in (rates[0], -rates[0]) for rate in rates):
        yield [1 if rate == rates[0] else -1 for rate in rates]


def _scales(places: list[Place], value: Callable[[Place], Poly], n: int) -> list[Poly]:
    """What q can be, up to n-th powers: the leading coefficient at a place of degree 1; else 1, -1 and what norms tell."""
    place = min(places, key=lambda place: place.degree)
    v, field = value(place), place.num.field
    if place.degree == 1:
        return [field.poly([1]) if root(v[0], n) is not None else v[0]]
    one = field.poly([1])
    scales = [one] if n == 3 else [one, -one]
    if place.degree == 2 and n == 2:
        # v = q w^2 has the norm (q N(w))^2, and (v + sqrt N(v))^2 = v (tr v + 2 sqrt N(v)).
        p = place.factor
        trace = 2 * v[0] - v[1] * p[1]
        norm = field.sqrt(v[0] * v[0] - v[0] * v[1] * p[1] + v[1] * v[1] * p[0])
        scales += [trace + 2 * sign * norm for sign in (1, -1)] if norm is not None else []
    return list(dict.fromkeys(scale for scale in scales if scale))


def _over_slope(S: RatFunc, f: RatFunc) -> RatFunc:
    """S0(f) = (S + {f, x}/2)/f'^2."""
    slope = f.derivative()
    return (S + schwarzian(f) / 2) / (slope * slope)


def _with_constant(S: RatFunc, f: RatFunc, q: Poly, r: Poly) -> Iterator[Pullback]:
    """The constant c from the poles of S0(f + c) - q, which are zeros of f + c; then M."""
    if not f.derivative():
        return
    rest = _over_slope(S, f) - q
    c = _value_at_poles(f, rest.den)
    if c is None or not rest:
        return
    f = f - c
    M = (rest * f + r) * f
    if M.is_polynomial and M.num.degree <= 0:
        yield Pullback(Confluent(q, r, M.num), f)


def _value_at_poles(f: RatFunc, den: Poly) -> Poly | None:
    """The one value of f at all roots of den, at infinity if there are none; None if there isn't one."""
    if den.degree == 0:
        return None if f.degree > 0 else f.num.lc if f.degree == 0 else f.num * 0
    radical = den // den.gcd(den.derivative())
    if radical.gcd(f.den).degree > 0:
        return None
    value = f.num * f.den.inverse_modulo(radical) % radical
    return value if value.degree <= 0 else None


# ------------------------------------------------------------------------------------------ zeros


def _bessel_by_zeros(problem: Problem, irregular: list[Place]) -> Iterator[Pullback]:
    """q = 0, r = 1: f is a constant times the product of its zeros, by their multiplicities, over that of its poles."""
    field = problem.field
    one = field.poly([1])
    poles, n = one, sum((place.order - 2) * place.degree for place in irregular)
    for place in irregular:
        if not place.at_infinity:
            poles = poles * place.factor ** (place.order - 2)
    regular = [place for place in problem.places if place.kind is Kind.REGULAR and place.delta_squared is not None]
    for zeros in _zeros(regular, n):
        numerator = one
        for place, multiplicity in zeros:
            if not place.at_infinity:
                numerator = numerator * place.factor**multiplicity
        f = RatFunc(numerator, poles)
        place = irregular[0]
        p, d = place.factor, place.order - 2
        local = f(RatFunc(one, field.poly([0, 1]))) if place.at_infinity else f
        if local.den.remove(p)[1] != d:
            continue
        scale = leading_square(place) * (local.den // p**d) * local.num.inverse_modulo(p) % p
        if scale.degree == 0:
            f = f * scale
            place, multiplicity = zeros[0]
            assert place.delta_squared is not None
            nu_squared = place.delta_squared * Fraction(1, multiplicity**2)
            yield Pullback(Confluent(one * 0, one, (nu_squared - 1) * Fraction(1, 4)), f)


def _zeros(regular: list[Place], n: int) -> Iterator[list[tuple[Place, int]]]:
    """Sets of places with multiplicities proportional to the exponent differences, n zeros in all."""
    logarithmic = [place for place in regular if not place.delta_squared]
    if logarithmic:  # nu = 0: all zeros are here, and the exponents don't tell the multiplicities
        for multiplicities in product(*(range(1, n // place.degree + 1) for place in logarithmic)):
            zeros = list(zip(logarithmic, multiplicities, strict=True))
            if sum(k * place.degree for place, k in zeros) == n:
                yield zeros
        return
    tried = set()
    for first in regular:
        for m in range(1, n // first.degree + 1):
            assert first.delta_squared is not None
            nu_squared = first.delta_squared * Fraction(1, m * m)
            if nu_squared in tried:
                continue
            tried.add(nu_squared)
            found = [(place, k) for place in regular if (k := multiplicity(place, nu_squared))]
            for zeros in (found, [(place, k) for place, k in found if not place.is_apparent]):
                if zeros and sum(k * place.degree for place, k in zeros) == n:
                    yield zeros


def multiplicity(place: Place, square: Poly) -> int | None:
    """k with Delta = k sqrt(square) at a regular place, None if there is no such positive integer."""
    assert place.delta_squared is not None
    ratio = rational_square_root(place.delta_squared / square) if square else None
    return int(ratio) if ratio is not None and ratio.denominator == 1 else None
