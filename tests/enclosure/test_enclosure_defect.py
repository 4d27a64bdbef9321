"""The proof constants of Taylor expansions against exact defects: nothing of the error may stay uncounted."""

from __future__ import annotations

import math
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import pytest
from build import ExactPoint, System, make_frame, parametrize, system_of
from flint import acb, acb_poly, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import GaussianParts, shift
from kovacic.enclosure.frobenius import Majorant
from kovacic.enclosure.taylor import _cut, _proven_defect, approximations, error_radii, fixed_point_series

Gauss = tuple[int, int]


def gaussian(parts: GaussianParts) -> list[Gauss]:
    return [(int(a), int(b)) for a, b in zip(parts[0], parts[1] or [0] * len(parts[0]), strict=True)]


def exact_defect(p: GaussianParts, q: GaussianParts, re: list[int], im: list[int] | None) -> int:
    """sum |r_n| for r = q Y'' - p Y, rounded down: the sum of floor |r_n|."""
    a = [(int(u), int(v)) for u, v in zip(re, im or [0] * len(re), strict=True)]
    second = [((n + 2) * (n + 1) * u, (n + 2) * (n + 1) * v) for n, (u, v) in enumerate(a[2:])]
    r = [[0, 0] for _ in range(len(a) + max(len(p[0]), len(q[0])))]
    for sign, coefficients, values in ((1, gaussian(q), second), (-1, gaussian(p), a)):
        for j, (c, d) in enumerate(coefficients):
            for n, (u, v) in enumerate(values):
                r[n + j][0] += sign * (c * u - d * v)
                r[n + j][1] += sign * (c * v + d * u)
    return sum(math.isqrt(u * u + v * v) for u, v in r)


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize(
    ("p", "q_0"), [([1], 1), ([3, 1], 2), ([2, 0, 5], 3), ([10**6], 1), ([1, 1, 1, 1], 10**5)], ids=str
)
def test_the_remainders_of_all_divisions_are_counted(p: list[int], q_0: int, start: int) -> None:
    """With positive coefficients all terms are, and rounded down they end in zeros: there is no other error, and it grows
    like n^3/6."""
    parts: tuple[GaussianParts, GaussianParts] = (p, None), ([q_0], None)
    re, im = fixed_point_series(*parts, 1500, start, 1)
    assert len(re) > 100
    bound = _proven_defect(*parts, (re, im), 0, 1)
    exact = exact_defect(*parts, re, im)
    assert q_0 * len(re) ** 3 // 40 < exact <= bound


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize("bits", [0, 20, 60])
@parametrize(
    ("p", "q"),
    [
        (([1, -2, 3], None), ([40, 1, -1, 2], None)),
        (([-7], None), ([9, 0, 0, 0, -5], None)),
        (([], None), ([3, 1], None)),
        (([1, 2], [3, -4]), ([5, 1, 1], [0, 2, -2])),
        (([0, 0, 6], [1, 0, 0]), ([7], [0])),
    ],
    ids=str,
    ordinary=11,
)
def test_the_last_terms_are_counted(p: GaussianParts, q: GaussianParts, bits: int, start: int) -> None:
    """The recurrence stops at terms below 2^bits, which the defect then contains, times the coefficients and n^2."""
    quiet = bits + 6
    re, im = fixed_point_series(p, q, 200, start, 1 << quiet)
    exact = exact_defect(p, q, re, im)
    assert exact <= _proven_defect(p, q, (re, im), 0, 1 << quiet)
    if bits and len(q[0]) > 1 and p[0]:
        assert exact > 2 * len(re) ** 3 * q[0][0]  # the last terms are most of it


@pytest.mark.parametrize("start", [0, 1])
@pytest.mark.parametrize("which", ["p", "q"])
@pytest.mark.parametrize("is_complex", [False, True])
def test_bits_that_are_cut_off_are_counted(which: str, is_complex: bool, start: int) -> None:
    """The terms satisfy the recurrence of the trimmed coefficients; the defect is meant for the whole ones."""
    excess, ones = 100, (1 << 100) - 1
    low_p, low_q = (ones, 0) if which == "p" else (0, ones)
    p: GaussianParts = [(3 << excess) + low_p] * 2, [(1 << excess) + low_p] * 2 if is_complex else None
    q: GaussianParts = [5 << excess, (1 << excess) + low_q], [0, (2 << excess) + low_q] if is_complex else None
    trimmed = _cut(p, excess), _cut(q, excess)
    re, im = fixed_point_series(*trimmed, 150, start, 1 << 8)
    exact = exact_defect(p, q, re, im)
    assert exact <= _proven_defect(*trimmed, (re, im), excess, 1 << 8)
    assert exact > len(re) ** 3 * q[0][0] << 60  # what was cut off is most of it


@pytest.mark.parametrize("prec", [60, 400])
@pytest.mark.parametrize("centre", [ExactPoint(Fraction(1, 2)), ExactPoint(Fraction(1, 4), Fraction(3, 8))])
@pytest.mark.parametrize(
    "system",
    [system_of((0, 1), (1,)), system_of((3, 0, -1), (2, 1, 1)), system_of((10**30 + 1, 7), (10**40 + 3, 0, 5))],
    ids=["Airy", "poles", "long coefficients"],
)
def test_expansions_know_their_defect(system: System, centre: ExactPoint, prec: int) -> None:
    frame = make_frame(system, centre, -2)
    assert frame is not None
    _, columns = approximations(frame, prec)
    p, q = shift(system, centre, ExactPoint(frame.scale))
    assert (frame.p, frame.q) == (p, q)
    for (re, im), defect in columns:
        assert exact_defect(p, q, re, im) <= defect


@pytest.mark.parametrize("k", [Fraction(1, 8), 1, 3])
@pytest.mark.parametrize("e", [-4, -1, 0, 1])
def test_the_error_of_values_and_slopes(k: Fraction, e: int) -> None:
    """e'' = k^2 e + rho, e(0) = e'(0) = 0: e = rho (cosh(k x) - 1)/k^2 and e' = rho sinh(k x)/k are reached."""
    square = Fraction(k) ** 2
    system, centre = system_of((square.numerator,), (square.denominator,)), ExactPoint(Fraction(0))
    frame = make_frame(system, centre, e)
    assert frame is not None
    q_0 = shift(system, centre, ExactPoint(frame.scale))[1][0][0]
    with working_precision(80):
        value, slope = error_radii(arb(q_0), frame)  # the defect's coefficients have the sum q_0: rho = 1
    k_u = float(k) * 2.0**e  # in the scaled coordinate u, x = 2^e u
    least_value, least_slope = (math.cosh(k_u) - 1) / k_u**2, math.sinh(k_u) / k_u
    assert least_value * (1 - 1e-9) <= float(value) <= 1.3 * least_value
    assert least_slope * (1 - 1e-9) <= float(slope) <= 1.3 * least_slope


@pytest.mark.parametrize("n", [14, 20, 100])
@pytest.mark.parametrize("delta", [0, Fraction(1, 3), 3, -3, Fraction(-5, 2), -2 + 1j, 3j], ids=str)
def test_the_constant_of_frobenius_recurrences(delta: complex | Fraction, n: int) -> None:
    """I(lambda + m + eps) = (m + eps)(m + delta + eps), eps (u, v) = (v, 0): kappa m^2 is below 1/|inverse| for m >= n."""
    exact = delta if isinstance(delta, complex) else complex(float(delta))
    bound = Majorant(arb(1), arb(0), arb(0), arb(1))
    counted = arb(abs(exact)) if exact.real < 0 else arb(0)
    factor, kappa = bound.growth(n, counted, arb(5), arb(1) / 2)
    assert factor.contains(2)
    ratios = []
    for m in (n, n + 1, n + 7, 10 * n):
        first, second = (
            1 / (m * (m + exact)),
            (2 * m + exact) / (m * (m + exact)),
        )  # the inverse: first (1 - second eps)
        ratios.append(abs(first) * (1 + abs(second)) * m * m * float(kappa))
    assert max(ratios) <= 1 + 1e-12
    assert ratios[0] > 0.55 if exact.real < 0 else ratios[0] > 0.3


@pytest.mark.parametrize("zeros", [[(2, 1)], [(2, 2)], [(-2, 3), (3, 1)], [(2 + 1j, 2), (2 - 1j, 2)]], ids=str)
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_the_bounds_on_a_circle_around_a_singular_point(zeros: list[tuple[complex, int]], share: float) -> None:
    """1/A, B/A - (B/A)(0) and C/A - (C/A)(0) at points of the circle, for A with simple and multiple zeros outside."""
    with working_precision(80):
        neighbours = [(acb(zeta), k) for zeta, k in zeros]
        A = acb_poly([3])
        for zeta, k in neighbours:
            A = A * acb_poly([1, -1 / zeta]) ** k
        size = len(A.coeffs())
        B, C = ([acb((-1) ** j * (j + c)) for j in range(size)] for c in (1, 4))
        op: Any = SimpleNamespace(A=A.coeffs(), B=B, C=C)
        rho = min(abs(zeta).lower() for zeta, _ in neighbours) * share
        bound = Majorant.make(op, neighbours, rho)
        for n in range(24):
            t = rho * acb(0, arb.pi() * n / 12).exp()
            value = A(t)
            assert not abs(1 / value) > bound.inverse
            for row, limit in ((B, bound.beta), (C, bound.gamma)):
                assert not abs(acb_poly(row)(t) / value - row[0] / A[0]) > limit
        if len(zeros) == 1:  # reached at the point of the circle that is nearest to the zero
            assert abs(1 / A(rho)) * (1 + 1e-9) > bound.inverse
