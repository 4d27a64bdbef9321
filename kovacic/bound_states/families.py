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

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from typing import Any

import sympy

from kovacic.bound_states.energies import Root, conjugate, solved, tidied
from kovacic.bound_states.frame import SingularFrame, Spot
from kovacic.bound_states.levels import Levels
from kovacic.bound_states.question import SpectralProblem, Uncovered, above
from kovacic.bound_states.signs import Signs
from kovacic.bound_states.waves import Wave, jacobi_wave, laguerre_wave
from kovacic.numbers.numerals import as_text
from kovacic.sturm_liouville.families import family
from kovacic.sturm_liouville.problem import Robin
from kovacic.writing.formula import caret


def jacobi_families(frame: SingularFrame, question: SpectralProblem) -> Iterator[Levels]:
    """Equation (1)."""
    if len(frame.spots) != 3 or any(spot.square is None for spot in frame.spots):
        raise Uncovered("the equation hasn't three singular points, all of them regular")
    _check_ends(frame)
    roots = [Root.of(spot.square, question.E) for spot in frame.spots]
    for signed in _choices(roots):
        equation = sympy.expand(-1 - sympy.Add(*signed) - 2 * question.signs.n)
        for found in solved(equation, roots, question.E):
            deltas = [delta.xreplace(found.values) for delta in signed]
            conditions = _are_real(roots)
            for spot, delta in zip(frame.spots, deltas, strict=True):
                conditions += _demands(question, spot, delta)
            if possible(conditions, question.signs):
                wave = jacobi_wave(frame, roots, deltas, question.signs)
                zeros = _zeros(frame, deltas, question.signs)
                yield _levels(question, found.energy, wave, conditions, zeros, roots)


def laguerre_families(frame: SingularFrame, question: SpectralProblem) -> Iterator[Levels]:
    """Equation (2), from S_z = q + r/z + b/z^2."""
    z, signs = frame.z, question.signs
    square = sympy.cancel(frame.S * z**2)
    if not _is_polynomial_of_degree(2, square, z):
        raise Uncovered("the equation isn't Whittaker's")
    _check_ends(frame)
    q, r, b = sympy.Poly(square, z).all_coeffs()
    at_origin = [spot for spot in frame.spots if spot.point == 0]
    origin = at_origin[0] if at_origin else Spot(sympy.Integer(0), 1 + 4 * b, 0)
    at_infinity = [spot for spot in frame.spots if spot.point == sympy.oo]
    root_of_q = Root.of(sympy.factor(q), question.E)
    root_at_0 = Root.of(sympy.factor(1 + 4 * b), question.E)
    roots = [root_of_q, root_at_0]
    for kappa, delta in product(root_of_q.signed, root_at_0.signed):
        equation = -r / (2 * kappa) - (1 + delta) / 2 - signs.n
        for found in solved(equation, roots, question.E):
            rate = kappa.xreplace(found.values)
            difference = delta.xreplace(found.values)
            decay = [above(_direction(frame, side) * rate, 0, strict=True) for s in at_infinity for side in s.sides]
            conditions = [*_are_real([root_of_q], positive=True), *_are_real([root_at_0]), *decay]
            conditions += _demands(question, origin, difference)
            if possible(conditions, signs):
                wave = laguerre_wave(frame, origin, rate, difference, signs)
                zeros = _zeros(frame, [difference], signs, [origin])
                yield _levels(question, found.energy, wave, conditions, zeros, roots)


def _demands(question: SpectralProblem, spot: Spot, delta: Any) -> list[Any]:
    """What is demanded of a signed exponent difference at the ends of the domain that are there."""
    return [question.demand(side, spot.mu, delta) for side in spot.sides]


def _levels(
    question: SpectralProblem,
    energy: Any,
    wave: Wave,
    conditions: Sequence[Any],
    zeros: Any,
    roots: Sequence[Root] = (),
) -> Levels:
    """In the user's symbols, with the square roots for which symbols stand."""
    radicals = dict(radical for root in roots for radical in root.radicals)

    def written(expression: Any) -> Any:
        return question.plain(sympy.sympify(expression).xreplace(radicals))

    tidy = [written(condition) for condition in tidied(conditions, question.signs, radicals)]
    return Levels(
        question.plain(question.signs.n),
        written(energy),
        written(wave.y),
        tuple(condition for condition in tidy if condition != sympy.true),
        written(zeros),
        None if wave.norm is None else written(wave.norm),
    )


def _are_real(roots: list[Root], *, positive: bool = False) -> list[Any]:
    """That what stands under the square roots isn't negative; or that it is positive."""
    relation = sympy.Gt if positive else sympy.Ge
    squares = [root.square for root in roots if root.radicals]
    return [relation(square, 0) for square in squares if not square.has(sympy.I)]


def _choices(roots: list[Root]) -> Iterator[list[Any]]:
    """The roots with their signs; those of unknowns are part of them.

    A pair of complex conjugate roots has one sign, since n is real.
    """
    are_complex = [k for k, root in enumerate(roots) if not root.unknown and root.value.has(sympy.I)]
    if len(are_complex) == 1:
        return  # n isn't real
    if len(are_complex) == 3:
        raise Uncovered("no exponent is real")
    for choice in map(list, product(*(root.signed for root in roots))):
        if are_complex:
            first, second = are_complex
            if choice[second] != roots[second].value:  # each pair once
                continue
            choice[second] = conjugate(choice[first])
        yield choice


def possible(conditions: list[Any], signs: Signs) -> bool:
    """False if one of the conditions is false for all values, or the sum of two of them."""
    if any(signs.holds(condition) is False for condition in conditions):
        return False
    relations = [condition for condition in dict.fromkeys(conditions) if condition not in (True, False)]
    gaps = [relation.gts - relation.lts for relation in relations]
    sums = (sympy.expand(first + second) for first, second in combinations(gaps, 2))
    return all(signs.is_nonnegative(total) is not False for total in sums)


def _check_ends(frame: SingularFrame) -> None:
    """Both ends are singular points in z, or one and the middle of the domain, where V is regular: even and odd solutions."""
    sides = sorted(side for spot in frame.spots for side in spot.sides)
    folds = [spot for spot in frame.spots if spot.is_fold]
    if sides != ([0, 1] if frame.fold is None else [1]) or len(folds) != (frame.fold is not None):
        raise Uncovered("an end of the domain is an ordinary point of the equation")
    for spot in folds:
        if sympy.simplify(4 * spot.square - (2 - spot.mu) ** 2) != 0:  # y ~ (x - a)^(1/2 +- delta/(2 - mu))
            raise Uncovered(f"V isn't regular at {frame.original.x} = {frame.fold}, inside the domain")


def _zeros(frame: SingularFrame, deltas: list[Any], signs: Signs, spots: Sequence[Spot] = ()) -> Any:
    """The number of zeros inside the domain: n; twice as many about the middle, and one there for an odd solution."""
    for spot, delta in zip(spots or frame.spots, deltas, strict=True):
        if spot.is_fold:
            return 2 * signs.n + int(bool(delta.is_positive))
    return signs.n


def _is_polynomial_of_degree(k: int, quotient: Any, z: Any) -> bool:
    """True for a quotient in lowest terms that is a polynomial in z of this degree."""
    if sympy.denom(quotient).has(z):
        return False
    return bool(sympy.degree(sympy.numer(quotient), z) == k)


def _direction(frame: SingularFrame, side: int) -> int:
    """The sign of z near an end at which it is infinite."""
    if frame.is_even or frame.original.kind in ("exp", "cosh"):
        return 1
    if frame.original.kind != "x":
        raise Uncovered(f"the sign of z = {frame.coordinate} isn't known")
    outwards = 1 if side == 1 else -1
    return outwards if frame.domain[side].is_infinite else -outwards  # z = 1/(x - end)


def no_families(frame: SingularFrame, question: SpectralProblem) -> Iterator[Levels]:
    """S_z = r/z + b/z^2 between 0 and oo: no solution is square integrable at both ends.

    Where z^(-e) y is entire and y decays like exp(-2 sqrt(r z)), which holds for |arg z| < 3 pi [Martinet & Ramis], it is
    bounded everywhere and tends to 0: y = 0.
    """
    z = frame.z
    square = sympy.cancel(frame.S * z**2)
    points = {spot.point for spot in frame.spots if spot.sides}
    is_bessel = _is_polynomial_of_degree(1, square, z) and points == {0, sympy.oo}
    if not is_bessel or sympy.diff(square, z).has(question.E):
        raise Uncovered("the equation isn't Bessel's")
    yield from ()


class Transcendental(Exception):
    """The equation for the energies, which has no solution in closed form, as a text."""


def constant_families(frame: SingularFrame, question: SpectralProblem) -> Iterator[Levels]:
    """A constant V: waves between two walls; beside an infinite end one solution decays, for E < V.

    It has no zero, and fulfils alpha y + beta y' = 0 for one E at most.  Raises `Transcendental` where the numbers of the waves
    have no formula.
    """
    if frame.S.has(frame.z) or not frame.is_in_x:
        raise Uncovered("V isn't constant")
    first, last = frame.domain
    x, n = question.x, question.signs.n
    V = sympy.expand(frame.S + question.E)
    dirichlet = Robin(sympy.S.One, sympy.S.Zero)
    left, right = (wish or dirichlet for wish in question.boundary.wishes)
    if first.is_infinite or last.is_infinite:
        wish, inwards = (left, 1) if last.is_infinite else (right, -1)
        is_line = first.is_infinite and last.is_infinite
        rate = sympy.S.Zero if is_line or wish.is_zero else inwards * wish.alpha / wish.beta
        if rate.is_positive:  # y = exp(-rate distance)
            distance = inwards * (x - (first if inwards == 1 else last))
            wave = sympy.exp(-rate * distance)
            yield _levels(question, V - rate**2, Wave(wave, 1 / (2 * rate)), [sympy.Lt(n, 1)], n)
        return
    number = sympy.Dummy("number", integer=True, positive=True)
    found = family(x, sympy.S.Zero, -V, sympy.S.One, question.E, (first, last), (left, right), n=number)
    if found is None:
        raise Uncovered("no formula is known for these conditions")
    if found.equation is not None:
        raise Transcendental(f"{caret(as_text(found.equation.lhs))} = {caret(as_text(found.equation.rhs))}")
    shifted = {number: n + found.first}
    (wave,) = found.functions
    norm = (last - first) / 2 if left.is_zero or right.is_zero else None
    energy = found.value.xreplace(shifted)
    yield _levels(question, energy, Wave(wave.xreplace(shifted), norm), [sympy.Gt(last - first, 0)], n)


def hermite_families(frame: SingularFrame, question: SpectralProblem) -> Iterator[Levels]:
    """The oscillator on the whole line: S = alpha x^2 + beta x + gamma."""
    is_quadratic = frame.S.is_polynomial(frame.z) and sympy.degree(frame.S, frame.z) == 2
    if not (is_quadratic and frame.is_in_x and frame.domain == (-sympy.oo, sympy.oo)):
        raise Uncovered("the equation isn't that of the oscillator on the whole line")
    alpha, beta, gamma = sympy.Poly(frame.S, frame.z).all_coeffs()
    root = Root.of(sympy.factor(alpha), question.E)
    n = question.signs.n
    shifted = question.x + sympy.factor(beta / (2 * alpha))
    for kappa in (root.value, -root.value):
        for found in solved(gamma - beta**2 / (4 * alpha) + kappa * (2 * n + 1), [root], question.E):
            conditions = [*_are_real([root], positive=True), above(kappa, 0, strict=True)]
            if possible(conditions, question.signs):
                wave = sympy.exp(-kappa * shifted**2 / 2) * sympy.hermite(n, sympy.sqrt(kappa) * shifted)
                norm = 2**n * sympy.factorial(n) * sympy.sqrt(sympy.pi / kappa)
                yield _levels(question, found.energy, Wave(wave, norm), conditions, n, [root])
