"""NumPy functions of solutions against proven values, and against formulas that are known otherwise."""

from __future__ import annotations

import warnings
from fractions import Fraction
from typing import Any

import flint
import mpmath
import numpy as np
import pytest
import scipy.special
import sympy
from build import QQ, RatFunc, parametrize

import kovacic
from kovacic import AccuracyWarning, InputError, LimitExceeded, evaluate, tabulate

TETRAHEDRAL = "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)"
ICOSAHEDRAL = "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)"
CONJUGATE_POLES = "9/(2*x^4 + 16*x^3 + 72*x^2 + 160*x + 200)"  # omega over Q(sqrt(-6))
ELLIPTIC = (  # Lame's equation, n = 1
    "(80*x**4 + 320*x**3 - 168*x**2 - 1136*x - 587)/(256*x**6 - 384*x**4 - 896*x**3 + 144*x**2 + 672*x + 784)"
)


def lambdify(equation: str | kovacic.Solution, **options: Any) -> Any:
    """The function of a solution, or of an equation as text."""
    return (kovacic.solve(equation) if isinstance(equation, str) else equation).lambdify(**options)


def kind_of(function: Any) -> str:
    return type(function).__name__


def ball(k: Fraction, D: tuple[Fraction | int, ...]) -> RatFunc:
    """S with y1 y2 = sqrt(D), w^2 = 4 k^2 lc(D): the ball on a sphere, whose solutions are D^(1/4) (D'/(2 sqrt(lc D)) +
    sqrt(D))^k."""
    f = RatFunc(QQ.poly(D))
    phi = f.derivative() / (2 * f)
    return (RatFunc(QQ.poly([4 * k * k * D[2]])) / f + 2 * phi.derivative() + phi * phi) / 4


# --- the promise -----------------------------------------------------------------------------------------------------

PROMISES: list[tuple[Any, Any, str]] = [
    ("x^2 + 3", (-3, 5), "ProductForm"),
    ("2", (0, 30), "ProductForm"),
    ("1 + 2/x^2", (0, 9), "ProductForm"),
    ("x^2 - 1", (0, 20), "ProductForm"),
    ("x^2 - 101", (-5, 5), "ProductForm"),
    ("(35*x^2 - 38)/(4*x^4 - 8*x^2 + 4)", (-1, 1), "ProductForm"),
    ("(x^2 - 4*x + 8)/(4*x^2)", (0, 4), "ProductForm"),
    ("-2", (0, 30), "ProductForm"),
    ("-10^30", (0, 1e-12), "ProductForm"),
    (CONJUGATE_POLES, (-1, 1), "ProductForm"),
    ("-2", (-1, 3 + 2j), "ProductForm"),
    ("x^2 + 3", (-1 - 1j, 2 + 1j), "ProductForm"),
    (CONJUGATE_POLES, (-1 - 1j, 1 + 1j), "ProductForm"),
    ("1/x - 3/(16*x^2)", (0, 900), "TabulatedFunction"),
    ("1/x - 3/(16*x^2)", (-9, 0), "TabulatedFunction"),
    (ball(Fraction(1, 3), (5, 2, Fraction(1, 2))), (-9, 9), "TabulatedFunction"),
    (ball(Fraction(577, 408), (-5, 2, Fraction(1, 2))), (2, 900), "TabulatedFunction"),
    (ball(Fraction(577, 408), (-5, 2, Fraction(1, 2))), (-900, -6), "TabulatedFunction"),
    (ball(Fraction(577, 408), (-5, 2, Fraction(1, 2))), (-5, 1), "TabulatedFunction"),
    ("-3/(16*x^2) - 3/(16*(x-1)^2) + 7/(16*x*(x-1))", (0, 1), "TabulatedFunction"),
    ("x^2 - 801", (-3, 3), "TabulatedFunction"),
    (ELLIPTIC, (2.5, 6), "TabulatedFunction"),
    (TETRAHEDRAL, (2, 9), "TabulatedFunction"),
    (TETRAHEDRAL, (0, 1), "TabulatedFunction"),
    (ICOSAHEDRAL, (0.01, 0.99), "TabulatedFunction"),
    ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", (0.1, 20), "ProductForm"),
    ("y'' - x*y' + 3*y = 0", (-3, 3), "ProductForm"),
    ("y'' - 2*x*y' + 80*y = 0", (0, 10**7), "ProductForm"),  # H_40, up to 10^292
    ("1650/(25*x^2 + 40*x + 104)^2", (-1, 1), "ProductForm"),  # a ball with R/R1 = 1/2, complex roots
    ("10/(x^2 + 1)^2", (-3, 3), "ProductForm"),  # sqrt(x^2 + 1) exp(+-3 atan x)
]


@parametrize(("S", "interval", "kind"), PROMISES, ordinary=2, long=(1, 11, 16))
def test_the_measured_error_keeps_the_promise(S: Any, interval: Any, kind: str) -> None:
    solution = kovacic.solve(S)
    function = lambdify(solution, interval=interval)  # warnings are errors here
    assert kind_of(function) == kind
    median, worst, count = function.measured
    assert count >= 20
    assert median <= 8
    assert worst <= 1000
    careful = lambdify(solution, interval=interval, careful=True)
    assert careful.careful
    assert careful.measured.median <= 1
    assert careful.measured.worst <= 4


@parametrize(("S", "interval", "kind"), [row for row in PROMISES if row[2] == "ProductForm"], ordinary=18)
def test_plain_and_careful_arithmetic_agree(S: Any, interval: Any, kind: str) -> None:
    """The constant factor included, and powers with their signs."""
    solution = kovacic.solve(S)
    careful, plain = (lambdify(solution, interval=interval, careful=c, check=False) for c in (True, False))
    low, high = plain.region.low, plain.region.high
    share = (np.arange(500) + 0.5) / 501.37
    x = low.real + (high.real - low.real) * share
    x = x if plain.region.is_real else x + 1j * (low.imag + (high.imag - low.imag) * ((7.3 * share) % 1))
    quotient = plain(x) / careful(x)
    assert np.max(np.abs(quotient - 1)) < 1e-11
    assert np.median(np.abs(quotient - 1)) < (2e-15 if S != "-10^30" else 2e-13)  # an angle up to 1,000


@parametrize(
    ("S", "interval", "careful"),
    [
        ("x^2 - 11", (-5, 5), False),
        ("x^2 - 1", (0, 30), True),  # exp(-x^2/2), the exponent is up to 450
        ("x^2 - 401", (-20, 20), False),  # 200 zeros: tabulated
        ("x^2 - 121", (-30, 30), True),  # 60 factors, exp(-450)
        ("(10^6/x - 10^6/(x+1))^2 - 10^6/x^2 + 10^6/(x+1)^2", (10**4, 10**7), True),  # (x/(x + 1))^(10^6)
        ("1/4 - 50/x", (0, 2000), True),  # right at 24 points: the exponential underflows beside others
    ],
    ordinary=2,
)
def test_the_measured_error_chooses_the_arithmetic(S: str, interval: Any, careful: bool) -> None:
    solution = kovacic.solve(S)
    function = lambdify(solution, interval=interval)
    assert function.careful is careful
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        plain = lambdify(solution, interval=interval, careful=False)
    assert plain.measured.keeps_the_promise is not careful


def test_initial_values_choose_the_solution() -> None:
    """Against SciPy, for equations with closed forms and without."""
    x = np.linspace(-3, 3, 301)
    hermite = lambdify("y'' - 2*x*y' + 8*y = 0", interval=(-3, 3), x0=0, y0=12, dy0=0)
    assert np.allclose(hermite(x), scipy.special.eval_hermite(4, x), rtol=0, atol=1e-12)
    bessel = lambdify(
        "x^2*y'' + 2*x*y' + (x^2 - 30)*y = 0",
        interval=(1, 60),
        x0=1,
        y0=scipy.special.spherical_jn(5, 1.0),
        dy0=scipy.special.spherical_jn(5, 1.0, derivative=True),
    )
    r = np.linspace(1, 60, 301)
    assert np.allclose(bessel(r), scipy.special.spherical_jn(5, r), rtol=0, atol=1e-12)
    airy = lambdify("x", interval=(-9, 3), x0=0, y0="0.3", dy0=1)
    assert not airy.careful
    assert airy.measured is not None
    assert airy.measured.keeps_the_promise


def test_values_close_to_a_zero_keep_their_relative_accuracy() -> None:
    solution = kovacic.solve("x^2 - 21")  # H_10(x) exp(-x^2/2)
    table = tabulate(solution, 0, 5, x0=0, y0=0, dy0=1)
    near = [float(z) for z in (4.04, 4.041, 4.0409)]
    proven = evaluate(solution, near, x0=0, y0=0, dy0=1)
    assert [float(b) for b in proven] == pytest.approx(list(table(np.array(near))), rel=4e-16)


# --- formulas that are known otherwise -------------------------------------------------------------------------------


def test_a_complex_omega_gives_a_complex_exponential() -> None:
    x = np.linspace(0, 30, 7)
    both = [lambdify(kovacic.solve("-2"), interval=(0, 30), which=which)(x) for which in (0, 1)]
    assert np.allclose(
        sorted(both, key=lambda y: y[1].imag), [np.exp(-1j * 2**0.5 * x), np.exp(1j * 2**0.5 * x)], rtol=1e-14
    )


def test_the_ball_has_its_known_solution_on_the_curve() -> None:
    k, x = 1 / 3, np.linspace(-9, 9, 13)
    D, slope = 5 + 2 * x + x * x / 2, 2 + x
    known = [D**0.25 * (slope / (2 * 0.5**0.5) + np.sqrt(D)) ** e for e in (-k, k)]
    for which in (0, 1):
        y = lambdify(kovacic.solve(ball(Fraction(1, 3), (5, 2, Fraction(1, 2)))), interval=(-9, 9), which=which)(x)
        assert np.ptp(np.log(y / known[which])) < 1e-12


@pytest.mark.long
def test_conjugate_solutions_of_an_oscillating_case_2_multiply_to_the_amplitude() -> None:
    x = np.linspace(0.1, 25, 9)  # y1 y2 = sqrt(x) for S = -1/x - 3/(16 x^2): x^(1/4) exp(+-2 i sqrt(x))
    first, second = (lambdify(kovacic.solve("-1/x - 3/(16*x^2)"), interval=(0, 26), which=w)(x) for w in (0, 1))
    assert np.ptp(np.log(np.abs(first * second) / np.sqrt(x))) < 1e-14
    assert np.allclose(
        np.unwrap(np.angle(second / second[0])), 2 * (np.sqrt(x) - np.sqrt(0.1)) % (2 * np.pi)
    ) or np.allclose(second / second[0], (x / 0.1) ** 0.25 * np.exp(2j * (np.sqrt(x) - np.sqrt(0.1))))


def test_huge_values_have_logarithms() -> None:
    function = lambdify(kovacic.solve("x^2 - 1"), interval=(0, 1000), check=False)
    sign, size = function.log(np.array([900.0]))
    assert sign[0] == 1
    assert size[0] == pytest.approx(-(900.0**2) / 2, rel=1e-15)
    assert function(np.array([900.0]))[0] == 0.0
    power = lambdify(kovacic.solve("999999*10^6/x^2"), interval=(0, 10), which=0, check=False)
    with mpmath.workdps(30):
        ratio = power(np.array([1.0005]))[0] / power(np.array([1.0]))[0]
        exponents = (10**6, 1 - 10**6)
        assert min(abs(ratio / mpmath.mpf(1.0005) ** e - 1) for e in exponents) < 4e-16


def test_functions_take_scalars_lists_and_arrays_of_every_shape() -> None:
    for S in ("x^2 + 3", "-2", TETRAHEDRAL):
        f = lambdify(kovacic.solve(S), interval=(2, 3), check=False)
        assert np.shape(f(2.5)) == ()
        assert f(np.full((2, 3), 2.5)).shape == (2, 3)
        assert f([2.5, 3]).tolist()[0] == f(2.5)
        assert f(np.array([])).shape == (0,)


# --- tables ----------------------------------------------------------------------------------------------------------


def test_a_table_of_a_solution_without_closed_form() -> None:
    table = tabulate("x", -6, 2, x0=0, y0=1, dy0=-1)
    points = np.linspace(-6, 2, 37)
    balls = evaluate("x", [float(p) for p in points], x0=0, y0=1, dy0=-1)
    assert np.all(np.abs(table(points) / [float(b) for b in balls] - 1) < 3e-16)
    with pytest.raises(InputError, match="outside"):
        table(np.array([2.5]))


def test_a_table_of_a_complex_solution_and_of_an_equation_with_a_first_derivative() -> None:
    turning = tabulate("-1", 0, 10, x0=0, y0=1, dy0=1j)
    x = np.linspace(0, 10, 11)
    assert np.allclose(turning(x), np.exp(1j * x), rtol=1e-15, atol=0)
    equation = "y'' - x*y' + x*y = 0"
    table = tabulate(equation, -1, 3, x0=0, y0=1, dy0=1)
    balls = evaluate(equation, [-1.0, 0.3, 2.7], x0=0, y0=1, dy0=1)
    assert table([-1.0, 0.3, 2.7]).tolist() == pytest.approx([float(b) for b in balls], rel=1e-15)


# --- warnings and refusals -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("S", "options", "words"),
    [
        ("x", {"interval": (1, 2)}, "needs a Liouvillian"),
        ("2/x^2", {"interval": (-1, 1)}, "singular point 0"),
        ("2/(x^2 - 2)^2", {"interval": (1, 2)}, "singular point 1.414"),
        ("2/(x^2 + 1)^2", {"interval": (-1 - 2j, 1 + 2j)}, "singular point 0"),
        ("2/x^2", {"interval": (2, 1)}, "empty"),
        ("2/x^2", {"interval": (1, 1)}, "empty"),
        ("2/x^2", {"interval": 7}, "pair"),
        ("2/x^2", {"interval": (1, float("inf"))}, "finite"),
        ("2/x^2", {"interval": (1, 10**400)}, "range of doubles"),
        ("2/x^2", {"interval": (1, 2), "which": 2}, "which = 2"),
        ("x^2 + 3", {"interval": (1, 2), "which": 1}, "only which = 0"),
        (TETRAHEDRAL, {"interval": (2, 3 + 1j)}, "case 1"),
        ("1/x^3 - 3/(16*x^2)", {"interval": (0, 2)}, "end of the interval is an irregular singular point"),
    ],
)
def test_what_lambdify_cannot_do_it_refuses(S: str, options: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        lambdify(kovacic.solve(S), **options)


@pytest.mark.parametrize(
    ("points", "words"),
    [([3.5], "outside"), ([1.0], "outside"), ([2 + 1j], "complex"), (["a"], "numerical")],
)
def test_arguments_are_checked(points: Any, words: str) -> None:
    function = lambdify(kovacic.solve("2/(x-1)^2"), interval=(1, 3))
    with pytest.raises(InputError, match=words):
        function(np.array(points))


@pytest.mark.long
def test_tables_start_as_evaluate_does() -> None:
    """Algebraic constants, values of parameters, regular singular points, infinity, right-hand sides: known functions."""
    x = np.linspace(1, 9, 41)
    j0 = tabulate("x^2*y'' + x*y' + x^2*y = 0", 0, 9, x0=0, which="regular")
    beside = np.geomspace(1e-12, 9, 200)
    for points in (x, beside):
        assert np.max(np.abs(j0(points) - scipy.special.j0(points))) < 1e-15
    y1 = tabulate("x^2*y'' + x*y' + x^2*y = 0", 1, 9, x0=0, frobenius=(1, 0))  # log(x) J0 + ...
    known = np.pi / 2 * scipy.special.y0(x) + (np.log(2) - np.euler_gamma) * scipy.special.j0(x)
    assert np.max(np.abs(y1(x) - known)) < 4e-15
    ai = tabulate("x", -8, 4, x0=0, y0=1, which="decaying", careful=False)
    assert np.allclose(ai(x - 5), scipy.special.airy(x - 5)[0] / scipy.special.airy(0)[0], rtol=1e-12, atol=1e-14)
    for options in ({"equation": "2*sqrt(2)*x"}, {"equation": "n*x", "params": {"n": "2*sqrt(2)"}}):
        scaled = tabulate(**options, start=-3, stop=3, x0=0, y0=1, dy0=0)  # 2 sqrt(2) = sqrt(2)^3
        plain = tabulate("x", -5, 5, x0=0, y0=1, dy0=0)
        assert np.allclose(scaled(x / 4), plain(2**0.5 * x / 4), rtol=1e-14)
    gauged = tabulate("y'' - 2*sqrt(2)*y' + 2*y = 0", 0, 3, x0=0, y0=1, dy0="sqrt(2)")
    assert np.allclose(gauged(x / 3), np.exp(2**0.5 * x / 3), rtol=1e-14)
    forced = tabulate("y'' + y = x", 0, 9, x0=0, y0=1, dy0=2)
    assert np.allclose(forced(x), np.cos(x) + np.sin(x) + x, rtol=1e-14)
    with pytest.raises(LimitExceeded, match="too inaccurate"):
        tabulate("-1", 0, 1, x0=0, y0=flint.arb(1, 1e-12), dy0=0)


@pytest.mark.long
def test_a_piece_is_halved_where_its_polynomial_does_not_suffice() -> None:
    """The right-hand side has poles at +-i/10, which the first choice of pieces doesn't see: y' = arctan(10 x)/10."""
    x = np.linspace(-1, 1, 33)
    known = x * np.arctan(10 * x) / 10 - np.log(1 + 100 * x * x) / 200
    table = tabulate("y'' = 1/(100*x^2 + 1)", -1, 1, x0=0, y0=0, dy0=0)
    assert np.max(np.abs(table(x) - known)) < 1e-15


def test_functions_with_values_of_parameters() -> None:
    """Hermite's functions: the decision is made at the values."""
    x, family = np.linspace(-4, 4, 81), kovacic.solve("x^2 - 2*n - 1")
    f = lambdify(family, interval=(-4, 4), params={"n": 4})
    assert kind_of(f) == "ProductForm"
    known = scipy.special.eval_hermite(4, x) * np.exp(-x * x / 2)
    assert np.ptp(f(x) / known) < 1e-13 * abs(f(0.0) / known[40])
    g = lambdify(family, interval=(-4, 4), params={"n": "sqrt(2)"}, x0=0, y0=1, dy0=0)
    assert g.measured is not None
    assert g.measured.keeps_the_promise
    assert g(1.5) == pytest.approx(float(evaluate(family, 1.5, x0=0, y0=1, dy0=0, params={"n": "sqrt(2)"})), rel=1e-14)


@parametrize(
    ("equation", "interval"),
    [
        ("(1-x^2)*y'' - 2*x*y' + 150*151*y = 0", (-1, 1)),  # Legendre
        ("(1-x^2)*y'' - 2*x*y' + 250*251*y = 0", (-1, 1)),
        ("x*y'' + (1-x)*y' + 120*y = 0", (0, 400)),  # Laguerre
        ("x^2*y'' + 2*x*y' + (x^2 - 80*81)*y = 0", (0, 600)),  # spherical Hankel: the zeros are complex
    ],
    ordinary=0,
    long=2,
)
def test_polynomials_with_many_zeros_are_tabulated(equation: str, interval: Any) -> None:
    """Up to singular points, too, and with the values of the known functions."""
    solution = kovacic.solve(equation)
    points = np.linspace(*interval, 102)[1:-1]
    for careful in (False, True):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)
            f = lambdify(solution, interval=interval, careful=careful)
        assert kind_of(f) == "TabulatedFunction"
        assert f.measured.worst < (4 if careful else 1e3)
        assert f.measured.median < (1 if careful else 8)
    n = {"1": 150, "2": 250}.get(equation.split("+ ")[-1][0])
    if equation.startswith("(1") and n:
        known = scipy.special.eval_legendre(n, points)
        k = int(np.argmax(np.abs(known)))
        assert np.allclose(f(points) / f(points[k]) * known[k], known, rtol=0, atol=1e-12)


@parametrize(
    ("equation", "interval"),
    [
        ("x^2 - 301", (-20, 20)),
        ("x^2*y'' + 2*x*y' + (x^2 - 80*81)*y = 0", (2, 600)),
        ("-(10^6 - 1/4)/(1-x^2) - 3/(4*(1-x^2)^2)", ("-99/100", "99/100")),
    ],
    ordinary=0,
    long=1,
)
def test_solutions_with_many_zeros_are_tabulated(equation: str, interval: Any) -> None:
    solution = kovacic.solve(equation)
    for careful in (False, True):
        f = lambdify(solution, interval=interval, careful=careful)
        assert kind_of(f) == "TabulatedFunction"
        assert f.measured is not None
        assert f.measured.worst < (1 if careful else 1000)


@pytest.mark.long
def test_zeros_beyond_the_range_of_doubles_are_no_error() -> None:
    """The values on both sides of a change of sign may be infinite."""
    f = lambdify(kovacic.solve("x*y'' + (1-x)*y' + 200*y = 0"), interval=(0, 800))
    assert f.measured is not None
    assert f.measured.keeps_the_promise


@pytest.mark.long
@pytest.mark.parametrize(
    ("equation", "interval", "start"),
    [
        ("x", (-100, 10), {"x0": 0, "which": "decaying", "y0": 1}),
        ("-1", (0, 300), {"x0": 0, "y0": 1, "dy0": "I"}),
        ("1", (-60, 60), {"x0": 0, "y0": 1, "dy0": 0}),
        ("y'' + sin(x)*y' + 4*cos(x)*y = 0", (0, 40), {"x0": 0, "y0": 1, "dy0": 0}),
    ],
)
def test_plain_tables_have_the_values_of_enclosures_at_their_centres(equation: str, interval: Any, start: Any) -> None:
    """Within two units in the last place of the largest value there and at the neighbours."""
    table = tabulate(equation, *interval, careful=False, **start)
    known = np.array([complex(y) for y in evaluate(equation, [*map(float, table.centres)], **start)])
    sizes = np.abs(np.concatenate([known[:1], known, known[-1:]]))
    largest = np.max([sizes[:-2], sizes[1:-1], sizes[2:]], axis=0)
    assert np.all(np.abs(table(table.centres) - known) <= 2.0**-51 * largest)


@parametrize(
    ("equation", "interval", "start"),
    [
        ("x", (1, 200), {"x0": 1, "y0": 1, "dy0": 0}),
        ("y'' - 2*x*y' + 400*y = 0", (-40, 40), {}),
        ("x^2*y'' + 2*x*y' + (x^2 - 10100)*y = 0", (2, 600), {}),  # complex
        ("x*y'' + (9/2-x)*y' + 200*y = 0", (0, 800), {}),
        ("(1-x^2)*y'' - 2*x*y' + 160400*y = 0", (-1, 1), {}),
    ],
    ordinary=0,
    long=(0, 3),
)
def test_the_worst_error_is_that_of_a_dense_measurement(equation: str, interval: Any, start: Any) -> None:
    """Within a factor of 2.5, at 20,000 points against double-doubles; none beside a zero, within a hundredth of the gap."""
    solution = equation if start else kovacic.solve(equation)
    plain, careful = (lambdify(solution, interval=interval, careful=c, **start) for c in (False, True))
    assert plain.measured is not None
    x = np.linspace(*interval, 20_003)[1:-1]
    with np.errstate(all="ignore"):
        exact, quotients = careful(x), plain(x) / careful(x)
    within = (np.abs(exact) > 1e-280) & (np.abs(exact) < 1e300)
    if not np.iscomplexobj(exact):
        k = np.flatnonzero(np.sign(exact[1:]) * np.sign(exact[:-1]) < 0)
        zeros = x[k] + (x[k + 1] - x[k]) / (1 + np.abs(exact[k + 1] / exact[k]))
        gaps = np.diff([interval[0], *zeros, interval[1]])
        for zero, gap in zip(zeros, np.minimum(gaps[:-1], gaps[1:]), strict=True):
            within &= np.abs(x - zero) > 0.0101 * gap
    errors = (
        np.abs(quotients / (1 if start else np.median(quotients[within])) - 1)
        * np.abs(exact)
        / np.spacing(np.abs(exact))
    )
    assert np.max(errors[within]) < 2.5 * plain.measured.worst


@pytest.mark.parametrize(
    ("text", "interval"),
    [
        ("2/x^2 - 1", (1, 2)),
        ("x^2 + 3", (0, 1)),
        ("-3/16/x^2 - 3/16/(x-1)^2 + 3/16/x/(x-1)", ("1/5", "4/5")),
        ("(-864*x^2+739*x-675)/(3600*x^4-7200*x^3+3600*x^2)", ("1/5", "4/5")),
        ("x^2*y'' + x*y' + (x^2 - 9/4)*y = 0", (1, 4)),
        ("y'' = (a - 1)*y", (0, 3)),
    ],
)
@pytest.mark.parametrize("which", ["y1", "y2"])
def test_the_printed_solutions_become_functions(text: str, interval: tuple[object, object], which: str) -> None:
    """At points of the interval they have the values of the expression, of which SymPy has 30 digits."""
    solution = kovacic.solve(text)
    params = {"a": 3} if "(a" in text else None
    function = solution.lambdify(interval=interval, which=which, params=params)
    y = solution.solutions[("y1", "y2").index(which)].subs({sympy.Symbol("a"): 3})
    assert function.measured.median < 1
    for k in range(1, 6):
        point = function.interval[0] + k * (function.interval[1] - function.interval[0]) / 6
        expected = complex(y.subs(sympy.Symbol("x"), sympy.Rational(point)).evalf(30))
        assert abs(complex(function(point)) - expected) < 1e-13 * abs(expected) + 1e-15


def test_a_printed_solution_has_no_initial_values() -> None:
    with pytest.raises(kovacic.InputError, match="without initial values"):
        kovacic.solve("2/x^2 - 1").lambdify(interval=(1, 2), which="y1", x0=1, y0=1, dy0=0)
    with pytest.raises(kovacic.InputError, match="Liouvillian"):
        kovacic.solve("x").lambdify(interval=(1, 2), which="y1")
