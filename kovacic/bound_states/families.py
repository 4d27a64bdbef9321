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
So every square integrable y is of this kind, and what is found is all there is.

References: R. Dutt, A. Khare & U. P. Sukhatme, Amer. J. Phys. 56 (1988) 163; F. Cooper, A. Khare & U. Sukhatme, Phys. Rep. 251
(1995) 267; DLMF 13.14, 15.10, 18.8.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product
from typing import Any, NamedTuple

import sympy

from kovacic.bound_states.energies import Root, conjugate, solved
from kovacic.bound_states.frame import SingularFrame, Spot, Uncovered, end_with_role
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs
from kovacic.numbers.numerals import as_text
from kovacic.sturm_liouville.families import family
from kovacic.sturm_liouville.problem import Robin
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class LevelFamily:
    """Levels E_n with solutions y_n, square integrable where the `conditions` hold; up to a factor.

    `zeros` is the number of zeros of y_n inside the domain: n, 2 n or 2 n + 1.  `radicals` are symbols for square roots.
    """

    energy: Any
    wave: Any
    conditions: tuple[Any, ...]
    zeros: Any
    norm: Any = None
    radicals: tuple[tuple[Any, Any], ...] = ()


@dataclass(frozen=True)
class Ends:
    """What is demanded of the exponents at the ends; `friedrichs` admits the smaller one of two square integrable solutions.

    `wishes` are the conditions that were given at the left and the right end.
    """

    signs: Signs
    friedrichs: bool
    wishes: tuple[Robin | None, Robin | None] = (None, None)

    @classmethod
    def of(cls, question: SpectralProblem) -> Ends:
        return cls(question.signs, question.friedrichs, question.boundary.wishes)

    def conditions(self, domain: tuple[Any, Any], spot: Spot, delta: Any) -> list[Any]:
        """When the solution with the exponent (1 + delta)/2 is the only square integrable one, or the one that is meant."""
        return [self._condition(domain, role, spot, delta) for role in spot.end_roles]

    def _condition(self, domain: tuple[Any, Any], role: str, spot: Spot, delta: Any) -> Any:
        end = end_with_role(domain, role)
        wish = self.wishes[role == "right"]
        if wish is not None and not wish.is_zero:
            # y' = 0 for the smaller exponent, where z - c ~ (x - a)^2 and y is a function of it.
            if wish.alpha != 0 or spot.p != 2:
                raise Uncovered("the boundary condition isn't one on exponents")
            return _above(-delta, 0, strict=False)
        if end.is_infinite and spot.mu < 2:
            raise Uncovered(f"the end {end} is a finite point of the coordinate")
        if end.is_infinite:
            return _above(delta, spot.mu - 2, strict=True)
        if spot.mu >= 2:
            raise Uncovered(f"the end {end} is at infinity in the coordinate")
        least = 0 if self.friedrichs or wish is not None else 2 / spot.p
        return _above(delta, least, strict=False)


def _above(delta: Any, least: Any, *, strict: bool) -> Any:
    """delta > least, or >=."""
    if delta.is_number and delta.is_real is False:
        return sympy.false
    relation = sympy.Gt if strict else sympy.Ge
    return relation(delta, least)


def _radicals(roots: list[Root]) -> tuple[tuple[Any, Any], ...]:
    """The symbols for square roots, and what they mean."""
    return tuple(radical for root in roots for radical in root.radicals)


def _are_real(roots: list[Root], *, positive: bool = False) -> list[Any]:
    """That what stands under the square roots isn't negative; or that it is positive."""
    relation = sympy.Gt if positive else sympy.Ge
    squares = [root.square for root in roots if root.radicals]
    return [relation(square, 0) for square in squares if not square.has(sympy.I)]


def jacobi_families(frame: SingularFrame, ends: Ends, E: Any) -> Iterator[LevelFamily]:
    """Equation (1)."""
    if len(frame.spots) != 3 or not frame.is_fuchsian:
        raise Uncovered("the equation hasn't three singular points, all of them regular")
    _check_ends(frame)
    roots = [Root.of(spot.square, E) for spot in frame.spots]
    for deltas in _choices(frame.spots, roots):
        equation = sympy.expand(-1 - sympy.Add(*deltas) - 2 * ends.signs.n)
        for found in solved(equation, roots, E):
            values = [delta.xreplace(found.values) for delta in deltas]
            conditions = [*_are_real(roots), *_at_the_spots(frame, ends, values)]
            if possible(conditions, ends.signs):
                yield _jacobi_family(frame, roots, values, energy=found.energy, conditions=conditions, signs=ends.signs)


def _at_the_spots(frame: SingularFrame, ends: Ends, deltas: list[Any]) -> list[Any]:
    """What is demanded of the exponent differences at the points of the frame."""
    conditions: list[Any] = []
    for spot, delta in zip(frame.spots, deltas, strict=True):
        conditions += ends.conditions(frame.domain, spot, delta)
    return conditions


def _jacobi_family(
    frame: SingularFrame, roots: list[Root], deltas: list[Any], *, energy: Any, conditions: list[Any], signs: Signs
) -> LevelFamily:
    """The family with these exponent differences."""
    from kovacic.bound_states.waves import jacobi_wave

    wave = jacobi_wave(frame, roots, deltas, signs)
    zeros = _zeros(frame, deltas, signs)
    return LevelFamily(energy, wave.y, tuple(conditions), zeros, wave.norm, _radicals(roots))


def _choices(spots: tuple[Spot, ...], roots: list[Root]) -> Iterator[list[Any]]:
    """The roots with their signs: those of unknowns are part of them, but for unknowns with the same square.

    A pair of complex conjugate roots has one sign, since n is real.
    """
    are_complex = [k for k, root in enumerate(roots) if not root.unknown and root.value.has(sympy.I)]
    if len(are_complex) == 1:
        return  # n isn't real
    if len(are_complex) == 3:
        raise Uncovered("no exponent is real")
    options = [_signed(k, spots, roots) for k in range(len(roots))]
    if not are_complex:
        yield from map(list, product(*options))
        return
    first, second = are_complex
    options[second] = [None]  # the conjugate of the first one
    for chosen in product(*options):
        choice = [*chosen]
        choice[second] = conjugate(choice[first])
        yield choice


def _signed(k: int, spots: tuple[Spot, ...], roots: list[Root]) -> list[Any]:
    """The root of number k with each of its signs: an unknown with that of an earlier one of the same square.

    At two ends both of them are positive.
    """
    root = roots[k]
    if not root.unknown:
        return _with_signs(root)
    earlier = _earlier_with_the_square(k, roots)
    if earlier is None:
        return [root.value]
    known = roots[earlier].value
    are_ends = spots[k].roles and spots[earlier].roles
    return [known] if are_ends else [known, -known]


def _earlier_with_the_square(k: int, roots: list[Root]) -> int | None:
    """The first unknown root before that of number k with its square; None where there is none."""
    for j in range(k):
        if roots[j].unknown and roots[j].square == roots[k].square:
            return j
    return None


def _with_signs(root: Root) -> list[Any]:
    """The root with both of its signs; an unknown has its own one."""
    if root.unknown or root.value == 0:
        return [root.value]
    return [root.value, -root.value]


def possible(conditions: list[Any], signs: Signs) -> bool:
    """Is none of the conditions false for all values, nor the sum of two of them?"""
    if any(signs.holds(condition) is False for condition in conditions):
        return False
    relations = [condition for condition in dict.fromkeys(conditions) if condition not in (True, False)]
    gaps = [relation.gts - relation.lts for relation in relations]
    sums = (sympy.expand(first + second) for first, second in combinations(gaps, 2))
    return all(signs.is_nonnegative(total) is not False for total in sums)


def _check_ends(frame: SingularFrame) -> None:
    """Both ends are singular points in z, or one and the middle of the domain, where V is regular: even and odd solutions."""
    roles = {role for spot in frame.spots for role in spot.roles}
    needed = {"left", "right"} if frame.fold is None else {"fold", "right"}
    if roles != needed:
        raise Uncovered("an end of the domain is an ordinary point of the equation")
    for spot in frame.spots:
        if spot.is_fold and sympy.simplify(spot.square * spot.p**2 - 1) != 0:
            raise Uncovered(f"V isn't regular at {frame.x} = {frame.fold}, inside the domain")


def _zeros(frame: SingularFrame, deltas: list[Any], signs: Signs) -> Any:
    """The number of zeros inside the domain, with the differences at the points of the frame."""
    for spot, delta in zip(frame.spots, deltas, strict=True):
        if spot.is_fold:
            return _zeros_for(spot, delta, signs)
    return signs.n


def _zeros_for(spot: Spot, delta: Any, signs: Signs) -> Any:
    """n; twice as many, and maybe one in the middle, where this point is the middle of the domain."""
    if not spot.is_fold:
        return signs.n
    is_odd = bool(delta.is_positive)
    return 2 * signs.n + int(is_odd)


def laguerre_families(frame: SingularFrame, ends: Ends, E: Any) -> Iterator[LevelFamily]:
    """Equation (2)."""
    S = _whittaker(frame)
    _check_ends(frame)
    square_at_0 = 1 + 4 * S.b
    origin = _spot_at(0, frame) or Spot(sympy.Integer(0), square_at_0, 0)
    root_of_q = Root.of(sympy.factor(S.q), E)
    root_at_0 = Root.of(sympy.factor(square_at_0), E)
    roots = [root_of_q, root_at_0]
    for kappa, delta in product(_with_signs(root_of_q), _with_signs(root_at_0)):
        equation = -S.r / (2 * kappa) - (1 + delta) / 2 - ends.signs.n
        for found in solved(equation, roots, E):
            rate = kappa.xreplace(found.values)
            difference = delta.xreplace(found.values)
            conditions = [
                *_are_real([root_of_q], positive=True),
                *_are_real([root_at_0]),
                *_decay(frame, rate),
                *ends.conditions(frame.domain, origin, difference),
            ]
            if possible(conditions, ends.signs):
                from kovacic.bound_states.waves import laguerre_wave

                wave = laguerre_wave(frame, origin, rate, difference, ends.signs)
                zeros = _zeros_for(origin, difference, ends.signs)
                yield LevelFamily(found.energy, wave.y, tuple(conditions), zeros, wave.norm, _radicals(roots))


class _Whittaker(NamedTuple):
    """S_z = q + r/z + b/z^2."""

    q: Any
    r: Any
    b: Any


def _whittaker(frame: SingularFrame) -> _Whittaker:
    """Raises `Uncovered` where S_z isn't of that form."""
    z = frame.z
    square = sympy.cancel(frame.S * z**2)
    if not _is_polynomial_of_degree(2, square, z):
        raise Uncovered("the equation isn't Whittaker's")
    parts = sympy.Poly(square, z)
    return _Whittaker(q=parts.coeff_monomial(z**2), r=parts.coeff_monomial(z), b=parts.coeff_monomial(1))


def _is_polynomial_of_degree(k: int, quotient: Any, z: Any) -> bool:
    """Is a quotient in lowest terms a polynomial in z, and of this degree?"""
    if sympy.denom(quotient).has(z):
        return False
    return bool(sympy.degree(sympy.numer(quotient), z) == k)


def _spot_at(point: Any, frame: SingularFrame) -> Spot | None:
    """The singular point there; None where there is none."""
    return next((spot for spot in frame.spots if spot.point == point), None)


def _decay(frame: SingularFrame, kappa: Any) -> list[Any]:
    """When exp(-kappa z) decays at the end where z is infinite."""
    at_infinity = _spot_at(sympy.oo, frame)
    if at_infinity is None:
        return []
    return [_above(_direction(frame, role) * kappa, 0, strict=True) for role in at_infinity.end_roles]


def _direction(frame: SingularFrame, role: str) -> int:
    """The sign of z near an end at which it is infinite."""
    if frame.m % 2 == 0 or frame.original.kind in ("exp", "cosh"):
        return 1
    if frame.original.kind != "x":
        raise Uncovered(f"the sign of z = {frame.z_of_x} isn't known")
    outwards = 1 if role == "right" else -1
    if end_with_role(frame.domain, role).is_infinite:
        return outwards
    return -outwards  # z = 1/(x - end)


def no_families(frame: SingularFrame, ends: Ends, E: Any) -> Iterator[LevelFamily]:
    """S_z = r/z + b/z^2 between 0 and oo: no solution is square integrable at both ends.

    Where z^(-e) y is entire and y decays like exp(-2 sqrt(r z)), which holds for |arg z| < 3 pi [Martinet & Ramis], it is
    bounded everywhere and tends to 0: y = 0.
    """
    z = frame.z
    square = sympy.cancel(frame.S * z**2)
    points = {spot.point for spot in frame.ends}
    is_bessel = _is_polynomial_of_degree(1, square, z) and points == {0, sympy.oo}
    if not is_bessel or sympy.diff(square, z).has(E):
        raise Uncovered("the equation isn't Bessel's")
    yield from ()


class Transcendental(Exception):
    """The equation for the energies, which has no solution in closed form, as a text."""


def constant_families(frame: SingularFrame, ends: Ends, E: Any) -> Iterator[LevelFamily]:
    """A constant V: waves between two walls; beside an infinite end one solution decays, for E < V.

    It has no zero, and fulfils alpha y + beta y' = 0 for one E at most.  Raises `Transcendental` where the numbers of the waves
    have no formula.
    """
    if frame.S.has(frame.z) or frame.m != 1 or not frame.is_in_x:
        raise Uncovered("V isn't constant")
    first, last = frame.domain
    n = ends.signs.n
    V = sympy.expand(frame.S + E)
    dirichlet = Robin(sympy.S.One, sympy.S.Zero)
    left, right = (wish or dirichlet for wish in ends.wishes)
    if first.is_infinite or last.is_infinite:
        wish, inwards = (left, 1) if last.is_infinite else (right, -1)
        is_line = first.is_infinite and last.is_infinite
        rate = sympy.S.Zero if is_line or wish.is_zero else inwards * wish.alpha / wish.beta
        if rate.is_positive:  # y = exp(-rate distance)
            distance = inwards * (frame.x - (first if inwards == 1 else last))
            wave = sympy.exp(-rate * distance)
            yield LevelFamily(V - rate**2, wave, (sympy.Lt(n, 1),), zeros=n, norm=1 / (2 * rate))
        return
    number = sympy.Dummy("number", integer=True, positive=True)
    found = family(frame.x, sympy.S.Zero, -V, sympy.S.One, E, (first, last), (left, right), n=number)
    if found is None:
        raise Uncovered("no formula is known for these conditions")
    if found.equation is not None:
        raise Transcendental(f"{caret(as_text(found.equation.lhs))} = {caret(as_text(found.equation.rhs))}")
    shifted = {number: n + found.first}
    (wave,) = found.functions
    norm = (last - first) / 2 if left.is_zero or right.is_zero else None
    energy = found.value.xreplace(shifted)
    yield LevelFamily(energy, wave.xreplace(shifted), (sympy.Gt(last - first, 0),), zeros=n, norm=norm)


def hermite_families(frame: SingularFrame, ends: Ends, E: Any) -> Iterator[LevelFamily]:
    """The oscillator on the whole line."""
    alpha, beta, gamma = _quadratic_on_the_line(frame)
    root = Root.of(sympy.factor(alpha), E)
    n = ends.signs.n
    least = gamma - beta**2 / (4 * alpha)
    shifted = frame.x + sympy.factor(beta / (2 * alpha))
    for kappa in (root.value, -root.value):
        for found in solved(least + kappa * (2 * n + 1), [root], E):
            conditions = [*_are_real([root], positive=True), _above(kappa, 0, strict=True)]
            if possible(conditions, ends.signs):
                wave = sympy.exp(-kappa * shifted**2 / 2) * sympy.hermite(n, sympy.sqrt(kappa) * shifted)
                norm = 2**n * sympy.factorial(n) * sympy.sqrt(sympy.pi / kappa)
                yield LevelFamily(found.energy, wave, tuple(conditions), n, norm, root.radicals)


def _quadratic_on_the_line(frame: SingularFrame) -> tuple[Any, Any, Any]:
    """alpha, beta and gamma of S = alpha x^2 + beta x + gamma.  Raises `Uncovered` for another S or domain."""
    z = frame.z
    is_quadratic = frame.S.is_polynomial(z) and sympy.degree(frame.S, z) == 2
    is_on_line = frame.is_in_x and frame.domain == (-sympy.oo, sympy.oo)
    if not is_quadratic or not is_on_line:
        raise Uncovered("the equation isn't that of the oscillator on the whole line")
    S = sympy.Poly(frame.S, z)
    return S.coeff_monomial(z**2), S.coeff_monomial(z), S.coeff_monomial(1)
