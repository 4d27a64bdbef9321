"""Equations with algebraic constants and irrational values of parameters, against FLINT's functions and exact solutions."""

from __future__ import annotations

from typing import Any

import flint
import pytest
from build import ball_to_flint, parametrize
from flint import acb, arb

import kovacic
from kovacic import AccuracyWarning, InputError, connection_matrix, evaluate

START: dict[str, Any] = {"y0": 1, "dy0": 0}


def airy(k3: arb, x: object) -> arb:
    """The solution of y'' = k^3 x y with y(0) = 1, y'(0) = 0."""
    k = k3.root(3)
    ai, aip, bi, bip = (arb(0).airy_ai(), arb(0).airy_ai(derivative=1), arb(0).airy_bi(), arb(0).airy_bi(derivative=1))
    z = k * arb(str(x))
    return (bip * z.airy_ai() - aip * z.airy_bi()) / (ai * bip - aip * bi)


CONSTANTS = {
    "sqrt(2)": lambda: arb(2).sqrt(),
    "2^(1/3)": lambda: arb(2).root(3),
    "(1 + sqrt(5))/2": lambda: (1 + arb(5).sqrt()) / 2,
    "sqrt(2) + sqrt(3)": lambda: arb(2).sqrt() + arb(3).sqrt(),
}


@parametrize("text", CONSTANTS, ordinary=1)
@pytest.mark.parametrize("digits", [5, 40, 300])
def test_airy_with_a_constant_in_the_equation_or_as_a_parameter(text: str, digits: int) -> None:
    with flint.ctx.workprec(2000):
        for x in ("0.7", "-5.25", "6"):
            exact = airy(CONSTANTS[text](), x)
            written = evaluate(f"({text})*x", x, x0=0, digits=digits, **START)
            given = evaluate("n*x", x, x0=0, digits=digits, params={"n": text}, **START)
            for ball in (written, given):
                assert ball.real
                assert ball.digits >= digits
                assert ball_to_flint(ball).contains(acb(exact))


def test_a_transcendental_value_and_many_points() -> None:
    points = [k / 10 for k in range(-40, 41)]
    balls = evaluate("n*x", points, x0=0, params={"n": "pi"}, **START)
    own = evaluate("y'' = pi*x*y", points, x0=0, **START)
    plain = evaluate("pi*x", points, x0=0, **START)
    with flint.ctx.workprec(200):
        for x, *others in zip(points, balls, own, plain, strict=True):
            exact = airy(arb.pi(), flint.fmpq(*x.as_integer_ratio()))
            assert all(ball_to_flint(ball).real.overlaps(exact) for ball in others)


@parametrize("n", ["3", "sqrt(3)", "-pi", "1/2"], ordinary=(2,), long=1)
def test_singular_points_and_exponents_that_arent_rational(n: str) -> None:
    # y = ((sqrt(2) - x)/sqrt(2))^n solves y'' = n (n - 1)/(x - sqrt(2))^2 y
    S = "n*(n - 1)/(x^2 - 2*sqrt(2)*x + 2)"
    slope = f"-({n})/sqrt(2)"
    for x in ("-3", "1.25", "1.41421"):
        ball = evaluate(S, x, x0=0, y0=1, dy0=slope, params={"n": n}, digits=30)
        with flint.ctx.workprec(600):
            power = {"sqrt(3)": arb(3).sqrt(), "-pi": -arb.pi()}.get(n) or arb(
                flint.fmpq(*map(int, (n + "/1").split("/")[:2]))
            )
            exact = (1 - arb(x) / arb(2).sqrt()) ** power
            assert ball_to_flint(ball).contains(acb(exact))
        assert ball.digits >= 30


@pytest.mark.parametrize("digits", [10, 60])
def test_equations_with_a_gauge(digits: int) -> None:
    ball, slope = evaluate("y'' - y'/(x - sqrt(2)) = 0", 1, x0=0, y0=1, dy0=1, digits=digits, derivative=True)
    with flint.ctx.workprec(400):  # y' = 1 - x/sqrt(2)
        root = arb(2).sqrt()
        assert ball_to_flint(ball).contains(acb(2 - 1 / (2 * root)))
        assert ball_to_flint(slope).contains(acb(1 - 1 / root))
    decay = evaluate(
        "y''(x) + 2*c*y'(x) + c^2*y(x) = 0", 3, x0="sqrt(2)", y0=1, dy0="-pi", params={"c": "pi"}, digits=digits
    )
    with flint.ctx.workprec(400):
        assert ball_to_flint(decay).contains(acb((-arb.pi() * (3 - arb(2).sqrt())).exp()))
    assert decay.digits >= digits


@parametrize("radius", ["1e-3", "1e-8", "1e-14"], ordinary=1)
@pytest.mark.filterwarnings("ignore::kovacic.enclosure.evaluate.AccuracyWarning")
def test_a_parameter_in_a_ball_gives_the_values_for_all_its_numbers(radius: str) -> None:
    for centre, x in ((2, 1), (0, 3), (-1, 4)):
        ball = evaluate("n*x^2 + x", x, x0=0, params={"n": arb(centre, radius)}, **START)
        for n in (arb(centre), arb(centre) - arb(radius) * 0.999, arb(centre) + arb(radius) * 0.999):
            (mantissa, exponent) = map(int, n.mid().man_exp())
            one = evaluate("n*x^2 + x", x, x0=0, params={"n": mantissa * 2.0**exponent}, digits=40, **START)
            assert ball_to_flint(ball).contains(ball_to_flint(one))


def test_a_wide_parameter_is_said() -> None:
    with pytest.warns(AccuracyWarning, match="of 15 digits"):
        evaluate("n*x", 1, x0=0, params={"n": arb(2, "1e-6")}, **START)


def test_connection_matrices() -> None:
    with flint.ctx.workprec(300):
        root = arb(2).root(4)
        exact = (root.cosh(), root.sinh() / root, root * root.sinh(), root.cosh())
        wide = connection_matrix("n*x/x", [0, 1], params={"n": arb(2, 0.01).sqrt()})
        for matrix in (connection_matrix("sqrt(2)", [0, 1j, 1], digits=50), wide):
            for ball, value in zip((*matrix[0], *matrix[1]), exact, strict=True):
                assert ball_to_flint(ball).contains(acb(value))
    with pytest.raises(InputError, match="an end of the path"):
        connection_matrix("sqrt(2)/x", [1, "oo"])
    with pytest.raises(InputError, match="singular point"):
        connection_matrix("sqrt(2)/x", [0, 1])


def test_solutions_and_roots_that_the_text_names() -> None:
    solution = kovacic.solve("2")
    constant = evaluate("sqrt(2)*sqrt(2)", 1, x0=0, **START)
    assert constant.overlaps(solution.at(1, x0=0, **START))
    negative = evaluate("-sqrt(2)*x", 1, x0=0, **START)
    with flint.ctx.workprec(100):
        mirrored = evaluate("sqrt(2)*x", -1, x0=0, **START)
    assert negative.overlaps(mirrored)
    assert kovacic.solve("sqrt(2)*x").at(1, x0=0, **START).digits >= 15


@pytest.mark.parametrize(
    ("equation", "options", "message"),
    [
        ("x/(x - sqrt(2))", {}, "singular point near 1.4142135623"),
        ("x/(x - sqrt(2))^2", {}, "singular point"),
        ("1/(x^2 - 2*n*x + n^2)", {"x": 4, "params": {"n": "pi"}}, "singular point"),
        ("1/(x^2 - 2*n*x + n^2)", {"x": 4, "params": {"n": "1/2 + sqrt(2)"}}, "singular point"),
        ("y'' + y'/(x - sqrt(2)) = 0", {}, "singular point"),
        ("y'' + y'/(x - sqrt(2)) + y/(x - sqrt(2))^2 = 0", {"x": "sqrt(2)"}, "singular point"),
        ("1/(x - sqrt(2))^2 + x", {"x": "sqrt(2)"}, "singular point"),
        ("1/(x - sqrt(2))^2 + x", {"x0": "sqrt(2)"}, "singular point"),
        ("n*x + 1/(m - 1)", {"params": {"n": "sqrt(2)", "m": 1}}, "isn't defined"),
        ("1/(n*x + 1)", {"params": {"n": arb(0, 1)}}, "isn't defined"),
        ("sqrt(2)*x", {"method": "closed form"}, "is for solutions of case 1 without a quadrature, and pull-backs"),
        ("sqrt(2)/x", {"frobenius": (1, 0), "y0": None, "dy0": None}, "regular point"),
    ],
)
def test_what_cant_be_had_is_said(equation: str, options: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        evaluate(equation, **({"x": 2, "x0": 0} | START | options))


@pytest.mark.parametrize("S", ["1/(x^2-2)^2", "1/(x^2-2)", "1/(x-sqrt(2))^2+x"])
def test_a_singular_point_that_is_no_fraction_is_refused(S: str) -> None:
    with pytest.raises(InputError, match=r"sqrt\(2\) is a singular point"):
        evaluate(S, "sqrt(2)", x0=0, y0=1, dy0=0)


def test_pi_and_e_are_constants_of_a_coefficient_alone_too() -> None:
    for text in ("pi*x", "e*x"):
        options: dict[str, Any] = {"x0": 1, "y0": 1, "dy0": 0}
        alone, whole = (kovacic.evaluate(form, 2, **options) for form in (text, f"y'' = {text}*y"))
        assert alone == whole == kovacic.solve(text).at(2, **options)
        size = "pi" if text == "pi*x" else "exp(1)"
        assert alone.overlaps(kovacic.evaluate("n*x", 2, params={"n": size}, **options))
    assert kovacic.solve("pi*x").status is kovacic.solve("y'' = pi*x*y").status


@pytest.mark.parametrize("exponent", ["I/2", "-I/2", "1/2", "-1/2", "3/10 + 2*I/5"])
def test_powers_with_exponents_of_size_one_half(exponent: str) -> None:
    """A number 2^c is exp(c log 2), a square root for c = 1/2 alone."""
    power, exponential = (evaluate("1", x, x0=0, **START) for x in (f"2^({exponent})", f"exp(({exponent})*log(2))"))
    with flint.ctx.workprec(200):
        assert ball_to_flint(power).overlaps(ball_to_flint(exponential))
