"""Bounds, estimates and coefficients of the room, against numbers by hand and formulas that are evaluated in another way."""

from __future__ import annotations

from math import ceil, cosh, log2, sinh, sqrt

import pytest
import sympy
from build import ExactPoint, System
from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.agreement import _PRIMITIVE
from kovacic.enclosure.ball import _above
from kovacic.enclosure.frame import REACH, _defect_bound, largest_exponent, upper_exponent
from kovacic.enclosure.frame import log2 as log2_of
from kovacic.enclosure.frobenius import Majorant
from kovacic.enclosure.functions import as_written, in_the_given_variable
from kovacic.enclosure.jets import CoefficientEvaluator, _growth_rate, without_removable
from kovacic.enclosure.rational import _change, _half_power, _phase_bits
from kovacic.enclosure.singular import Operator
from kovacic.enclosure.splitting import SplitRecurrence, is_split
from kovacic.limits import Limits
from kovacic.reading.read import read_input

x = sympy.Symbol("x")
R = float(REACH.p) / float(REACH.q)


def near(found: object, expected: float) -> bool:
    return abs(float(found) - expected) < 1e-10 * max(1, abs(expected))


def test_the_bound_of_the_defect_for_constants() -> None:
    """z'' = 5/2 z + 1: with t = (5/2)^(1/2) R, (cosh t - 1)/sigma and sinh t/sigma^(1/2); the solutions by z(0) = z'(0) = 1."""
    bound = _defect_bound(([3], [4]), 2, [])
    assert bound is not None
    root = sqrt(2.5)
    t = root * R
    assert near(bound.gain, (cosh(t) - 1) / 2.5)
    assert near(bound.slope_gain, sinh(t) / root)
    assert near(bound.log2_growth, log2(max(cosh(t) + sinh(t) / root, root * sinh(t) + cosh(t))))
    assert near(bound.log2_least, 0)


def test_the_bound_of_the_defect_beside_poles() -> None:
    """|q/q_0| >= (1 - r/4)^2 (1 - r/7)^3, by which the bound of p is divided on each of the rings."""

    def least(r: float) -> float:
        return (1 - r / 4) ** 2 * (1 - r / 7) ** 3

    bound = _defect_bound(([3, 5, 2], None), 2, [(arb(4), 2), (arb(7), 3)])
    assert bound is not None
    assert near(bound.log2_least, log2(least(R)))

    def sigma(r: float) -> float:
        return (3 + 5 * r + 2 * r * r) / 2 / least(r)

    rings = min(8, 1 + int(sqrt(sigma(R))))
    assert rings == 4
    error, growth, delta = (0.0, 0.0), (1.0, 1.0), R / rings
    for j in range(rings):
        s = sigma(delta * (j + 1))
        c, h = cosh(sqrt(s) * delta), sinh(sqrt(s) * delta) / sqrt(s)
        error = c * error[0] + h * error[1] + (c - 1) / s, s * h * error[0] + c * error[1] + h
        growth = c * growth[0] + h * growth[1], s * h * growth[0] + c * growth[1]
    assert near(bound.gain, error[0] / least(R))
    assert near(bound.slope_gain, error[1] / least(R))
    assert near(bound.log2_growth, log2(max(growth)))
    assert _defect_bound(([3], None), 2, [(arb(1), 1)]) is None


def test_the_largest_scale_of_a_disc_is_that_of_the_growth() -> None:
    """2400^2 >= 4^e |S|, S = 28/3 at 5 and (4 + 3 i)/3 at 2 i - 1, |S|^2 = 25/9."""
    assert largest_exponent(System((3, 0, 1), (3,)), ExactPoint(5)) == ceil(log2(2400**2 * 3 / 28) / 2)
    assert largest_exponent(System((7, 2), (3,)), ExactPoint(-1, 2)) == ceil(log2(2400**2 * 3 / sqrt(41)) / 2)
    assert largest_exponent(System((-5, 1), (3,)), ExactPoint(5)) is None
    assert largest_exponent(System((3,), (-5, 1)), ExactPoint(5)) is None


def test_sizes_of_numbers() -> None:
    assert [upper_exponent(arb(v)) for v in (5, 8, 7.75, 0.125, 3 / 1024)] == [3, 4, 3, -2, -8]
    assert [log2_of(arb(v)) for v in (8, 0.25)] == [3, -2]
    assert near(log2_of(arb(12)), log2(12))
    with working_precision(100):
        exact = [(arb(1) / 3).mid(), (arb(2) / 3).mid(), (arb(1) / 10).mid(), arb(0.375)]
        assert [*map(_above, exact)] == [0.33333333333333337, 0.66666666666666674, 0.1, 0.375]


def test_majorants_of_a_frobenius_series() -> None:
    """beta = (7 - 15/2) t + (11 - 5) t^2 over A, gamma = (4 - 3/2) t + (9 - 1) t^2; A has zeros at 3, and twice at -2."""
    op = Operator([arb(2), arb(3), arb(2)], [arb(5), arb(7), arb(11)], [arb(1), arb(4), arb(9)])
    bound = Majorant.make(op, [(acb(3), 1), (acb(-2), 2)], arb(1) / 2)
    inverse = 1 / 2 / (1 - 1 / 6) / (1 - 1 / 4) ** 2
    assert near(bound.inverse, inverse)
    assert near(bound.beta, (0.5 * 0.5 + 6 * 0.25) * inverse)
    assert near(bound.gamma, (2.5 * 0.5 + 8 * 0.25) * inverse)
    factor, kappa = bound.growth(12, arb(3), arb(5), arb(1) / 8)
    assert near(kappa, (1 - 3 / 12) / (1 + (2 + 3 / 12) / 9))
    C = float(bound.gamma) / 12 + float(bound.beta) * (1 + 6 / 12)
    assert near(factor, (1 - 1 / 4) ** (-1 - C / float(kappa)))


@pytest.mark.parametrize(
    ("num", "den", "least"),
    [(2, 1, 1500), (5, 1, 2160), (7, 1, 5120), (2, 2, 1500), (4, 4, 4375), (1, 7, 7560), (1, 8, 12005)],
)
def test_where_splitting_begins(num: int, den: int, least: int) -> None:
    """At 10 or 35 times the cube of the order, at least at 1,500 bits; at three times as many where numbers aren't real."""
    system = System((1,) * num, (1,) * den)
    real, other = ExactPoint(2), ExactPoint(2, 3)
    assert [is_split(system, prec, real, real) for prec in (least, least + 1)] == [False, True]
    assert [is_split(system, prec, real, other) for prec in (3 * least, 3 * least + 1)] == [False, True]
    order = SplitRecurrence(([1] * num, None), ([1] * den, None), False).order
    assert order == max(2, num + 1, den - 1)


def test_the_phase_far_out() -> None:
    """c^(1/2) x^(d/2 + 1)/(d/2 + 1)."""
    for c, d, at in ((4, 2, 8), (9, 1, 5), (3, -1, 7), (5, 4, 3)):
        assert near(_phase_bits(c, d, at), log2(sqrt(c) * at ** (d / 2 + 1) / (d / 2 + 1)))
        assert near(_half_power(arb(at), d), at ** (d / 2))


def test_the_change_of_the_constants_far_out() -> None:
    """exp(I) - 1 for E = 3 t^4 + 5 t^6, T = 1 + 2 t, D = 1 + 4 t^2, S ~ -9 x^3."""
    at = 20.0
    powers = 3 / (4 - 2.5) * at**-4 + 5 / (6 - 2.5) * at**-6
    integral = powers * at**2.5 / (3 * (1 - 4 / at**2) * (1 - 2 / at) ** 3)
    sizes = [[arb(v) for v in part] for part in ([0, 0, 0, 0, 3, 0, 5], [1, 2], [1, 0, 4])]
    found = _change(sizes, 9, 3, arb(at))
    assert found is not None
    assert abs(float(found) - (2.718281828459045**integral - 1)) < 1e-12
    assert _change(sizes, 9, 3, arb(2)) is None


def test_the_growth_rate_solves_its_equation() -> None:
    """lambda^2 = beta lambda + gamma."""
    assert near(_growth_rate([arb(5), arb(7)], arb(1) / 2), (2.5 + sqrt(2.5**2 + 4 * 7 / 4)) / 2)


@pytest.mark.parametrize("kind", ["TETRAHEDRAL", "OCTAHEDRAL", "ICOSAHEDRAL"])
def test_characters_of_the_primitive_groups(kind: str) -> None:
    """The representation is irreducible: the squares of the traces add up to the order, and the traces to 0."""
    (table,) = [table for group, table in _PRIMITIVE.items() if group.name == kind]
    assert sum(table.values()) == {"TETRAHEDRAL": 24, "OCTAHEDRAL": 48, "ICOSAHEDRAL": 120}[kind]
    traces = [(2 * sympy.cos(2 * sympy.pi * sympy.Rational(angle)), count) for angle, count in table.items()]
    assert abs(sum(float(count * trace) for trace, count in traces)) < 1e-12
    assert near(sum(float(count * trace**2) for trace, count in traces), sum(table.values()))


@pytest.mark.parametrize(
    "equation",
    [
        "y'' + 3*exp(2*x + 1)*y' + (5/(exp(2*x + 1) + 3) + 2)*y = exp(2*x + 1)^3 - x",
        "y'' + tan(2*x + 1)*y' + (2 - tan(2*x + 1))/(2 + tan(2*x + 1)^2)^2*y = tan(2*x + 1)^3",
        "y'' + sin(x/3)/(1 - sin(x/3)^2)^2*y' + 1/(1 - sin(x/3)^2)*y = sin(x/3)^3/(3 - sin(x/3)^2)",
        "(2 + cos(x/3))*y'' + cos(x/3)^2/(1 - cos(x/3)^2)*y' + 4/(1 - cos(x/3)^2)^2*y = cos(x/3)",
        "y'' + sinh(3*x)*y' + 7/(1 + sinh(3*x)^2)*y = 2/(2 - sinh(3*x))",
        "y'' + 5*cosh(3*x - 1)*y' + cosh(3*x - 1)/(cosh(3*x - 1)^2 - 1)*y = cosh(3*x - 1)^2",
        "y'' + (sin(2*x) + 3)/(2 + cos(2*x) - 4*sin(2*x)/7)*y' + (5 + sin(2*x)^2)/(2 - cos(2*x))*y = sin(2*x)*cos(2*x)",
    ],
)
def test_coefficients_in_the_given_variable_are_those_that_were_written(equation: str) -> None:
    parsed = read_input(equation, limits=Limits(), exponentials=True)
    found = in_the_given_variable(parsed.equation)
    written = as_written(equation, None, Limits())
    for one, other in zip(found.parts, written.parts, strict=True):
        for at in (sympy.Rational(7, 10), sympy.Rational(-2, 5)):
            value, expected = (complex(sympy.N(part.subs(x, at), 30)) for part in (one, other))
            assert abs(value - expected) < 1e-13 * max(1, abs(expected))


@pytest.mark.parametrize(
    "function",
    [
        "sin(x - 2)/(x - 2)",
        "sin(x - 2)^3/(x - 2)",
        "(1 - cos(3*x - 6))/(x - 2)^2",
        "(exp(x - 2) - x + 1)/(x - 2)^2 + 5",
        "(x - 2)^3/(sin(x - 2)^2*(x + 1))",
        "sin(2*x - 4)*(exp(x + 1) - 1)/((x - 2)*(x + 1))",
        "tan(x - 2)/(x - 2)",
        "(x - 2)*coth(x - 2)",
    ],
)
def test_functions_without_their_removable_singularities(function: str) -> None:
    """At a far point, beside the zero, and in a ball around it, where the quotient is sharp."""
    e = sympy.sympify(function)
    plain = without_removable(e, x)
    for at in ("5", "2.03125", "-0.96875", "1.75", "-3.5"):
        value = CoefficientEvaluator({x: acb(float(at))}, variable=x)(plain)
        expected = complex(sympy.N(e.subs(x, sympy.Rational(at)), 30))
        assert value.rel_accuracy_bits() > 25, at
        assert abs(complex(value) - expected) < 1e-13 * max(1, abs(expected)), at
    ball = CoefficientEvaluator({x: acb(arb(2, 0.0078125))}, variable=x)(plain)
    limit = float(sympy.limit(e, x, 2))
    assert ball.real.contains(arb(limit)) or abs(float(ball.real.mid()) - limit) < 1e-12
    assert ball.real.rad() < 0.05 * max(1, abs(limit))


def test_polynomials_and_waves_are_sharp_on_balls() -> None:
    """Beside a zero of the slope by its size: (x - 1)^2 - 1, sin(x + pi/2) and cos(3 x)."""
    ball = {x: acb(arb(1, 1e-4))}
    square = CoefficientEvaluator(ball, variable=x)(x**2 - 2 * x)
    assert near(square.real.mid(), -1)
    assert square.real.rad() < 2e-8
    about_zero = {x: acb(arb(0, 1e-4))}
    for function in (sympy.cos(3 * x), sympy.sin(x + sympy.Rational(11, 7)), 2 + sympy.cos(5 * x)):
        value = CoefficientEvaluator(about_zero, variable=x)(function)
        assert value.real.contains(arb(float(function.subs(x, 0))))
        assert value.real.rad() < 3e-7
