"""Tables: their ends, numbers beside arrays, derivatives, NaN."""

from __future__ import annotations

import math
import random
from typing import Any

import numpy as np
import pytest
from build import parametrize
from clocks import controlled

import kovacic

SINE = {"x0": 0, "y0": 0, "dy0": 1}


@pytest.mark.parametrize("ends", [("0.3", "1.1"), ("1/3", "10/3"), (0.3, 1.1), ("2/7", 5)])
def test_an_end_is_its_nearest_double(ends: tuple[Any, Any]) -> None:
    table = kovacic.tabulate("-1", *ends, **SINE)
    low, high = (float(eval(end)) if isinstance(end, str) else float(end) for end in ends)
    assert table.interval == (low, high)
    assert table(low) == pytest.approx(math.sin(low), rel=1e-15)
    assert table(np.array([low, high])) == pytest.approx(np.sin([low, high]), rel=1e-15)
    with pytest.raises(kovacic.InputError, match="outside of the interval"):
        table(math.nextafter(low, -math.inf))


def test_a_singular_end_stays_outside() -> None:
    """x^(1/3) (3 + ...) beside 1/3: no double below it has a value."""
    f = kovacic.solve("-1/(4*(x - 1/3)^2)").lambdify(interval=("1/3", 2))
    low = f.region.low.real
    assert low > 1 / 3 or low == 1 / 3
    assert math.isfinite(f(math.nextafter(low, 1)))


@pytest.mark.parametrize("careful", [True, False])
@parametrize(
    ("equation", "interval"),
    [("-1", (0, 100)), ("x", (-20, 300)), ("y'' + (2 + cos(x))*y = 0", (-3, 9)), ("I*x + 1", None)],
    ordinary=1,
)
def test_a_number_has_the_value_that_it_has_in_an_array(equation: str, interval: Any, careful: bool) -> None:
    if interval is None:  # a complex solution of a real equation
        table = kovacic.tabulate("-x", 0, 9, x0=0, y0="1 + I", dy0="-I/3", careful=careful)
        interval = (0, 9)
    else:
        table = kovacic.tabulate(equation, *interval, **SINE, careful=careful)
    rng = random.Random(0)
    points = [rng.uniform(*interval) for _ in range(200)]
    together = table(np.array(points))
    alone = [table(point) for point in points]
    with np.errstate(all="ignore"):
        size = np.spacing(np.abs(together))
        same = (np.abs(alone - together) <= 4 * size) | (np.array(alone) == together)
        assert (same | (size > 2.0**960)).all() if not careful else same.all()


@pytest.mark.long
def test_derivatives_are_those_of_evaluate() -> None:
    start = {"x0": 0, "y0": 1, "dy0": "-1/2"}
    equation = "y'' + tan(x/9)*y' + x*y = cos(x)"
    slope = kovacic.tabulate(equation, -3, 8, **start).derivative
    points = [-2.9, -1.0, 0.0, 0.7, 3.3, 7.9]
    balls = kovacic.evaluate(equation, points, derivative=True, **start)
    assert slope(np.array(points)) == pytest.approx([float(dy) for _, dy in balls], rel=1e-14)
    assert slope.derivative(0.7) == pytest.approx(
        math.cos(0.7) - math.tan(0.7 / 9) * float(balls[3][1]) - 0.7 * float(balls[3][0]), rel=1e-12
    )
    growing = kovacic.tabulate("x", 0, 300, x0=0, y0=1, dy0=1).derivative
    assert growing(60.0) == pytest.approx(
        float(kovacic.evaluate("x", 60, x0=0, y0=1, dy0=1, derivative=True)[1]), rel=1e-14
    )


BALL = "-3/(16*(x - 1)^2) - 3/(16*(x + 2)^2) + 17/(72*(x - 1)*(x + 2))"  # R/R1 = 1/3


@parametrize(
    ("equation", "interval"),
    [
        ("x^2 - 7", (-3, 3)),  # three zeros, 0 among them
        ("y'' - 2*x*y' + 16*y = 0", (-3, 3)),
        ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", (0.1, 20)),  # a complex form
        ("10/(x^2 + 1)^2", (-3, 3)),
        ("1/x - 3/(16*x^2)", (0, 9)),  # the line s^2 = x
        ("-3/(16*x^2) - 3/(16*(x-1)^2) + 7/(16*x*(x-1))", (0, 1)),  # the ellipse
        (BALL, (2, 9)),  # the hyperbola
        (BALL, (-9, -3)),
        ("x^2 - 801", (-3, 3)),  # the polynomial is a table
        ("x^2 + 3", (-1 - 1j, 2 + 1j)),
    ],
    ordinary=3,
    always=[("-3/(16*x^2) - 3/(16*(x-1)^2) + 7/(16*x*(x-1))", (0, 1))],
)
@pytest.mark.parametrize("careful", [True, False])
def test_derivatives_of_product_forms_are_those_of_evaluate(equation: str, interval: Any, careful: bool) -> None:
    form = kovacic.solve(equation).lambdify(interval=interval, check=False, careful=careful)
    low, high = form.region.low, form.region.high
    points = low + (high - low) * np.array([0.07, 0.24, 0.41, 0.5, 0.63, 0.92])
    points = points if np.iscomplexobj(form.region.points(points.real)) else points.real
    y, dy = form(points), form.derivative(points)
    first = int(np.argmin(np.abs(y) + np.abs(dy)))  # from there the other solution doesn't grow faster
    number = complex if np.iscomplexobj(y) else float
    place = [number(x) if np.iscomplexobj(points) else float(x) for x in points]
    start = {"x0": place[first], "y0": number(y[first]), "dy0": number(dy[first])}
    balls = kovacic.evaluate(equation, place, derivative=True, method="taylor", **start)
    sizes = np.array([abs(complex(a)) + abs(complex(b)) for a, b in balls])
    assert (np.abs(dy - np.array([complex(b) for _, b in balls])) < 1e-12 * sizes).all()


@pytest.mark.long
def test_derivatives_at_zeros_and_of_long_tables() -> None:
    """x (4 x^4 - 20 x^2 + 15), and cos on 1,000 periods."""
    hermite = kovacic.solve("y'' - 2*x*y' + 10*y = 0").lambdify(interval=(-2, 2))
    assert hermite.derivative(0.0) / hermite(1.0) == pytest.approx(15 / (4 - 20 + 15), rel=1e-14)
    cosine = kovacic.solve("-1").lambdify(interval=(0, 6_200), **SINE).derivative
    points = np.linspace(0, 6_200, 1001)
    assert np.abs(cosine(points) - np.cos(points)).max() < 1e-14
    assert cosine.interval == (0, 6_200)


@pytest.mark.parametrize("make", ["table", "product"])
def test_nan_stays_nan(make: str) -> None:
    f: Any = kovacic.tabulate("-1", 0, 3, **SINE)
    if make == "product":
        f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 3))
    assert math.isnan(f(math.nan))
    found = f(np.array([[1.0, math.nan], [2.0, 3.0]]))
    assert np.isnan(found).tolist() == [[False, True], [False, False]]
    assert np.isnan(f(np.array([math.nan, math.nan]))).all()
    with pytest.raises(kovacic.InputError):
        f(np.array([math.nan, 4.0]))


def test_what_is_masked_stays_masked_and_is_not_looked_at() -> None:
    """NumPy's masked arrays, with a point beyond the interval under the mask."""
    points = np.ma.array([[1.0, 99.0], [2.0, 0.5]], mask=[[False, True], [False, False]])
    closed: Any = kovacic.solve("x^2 + 3").lambdify(interval=(0, 3))
    sine: Any = kovacic.solve("-1").lambdify(interval=(0, 3), **SINE)
    table = kovacic.tabulate("x", 0, 3, **SINE)
    for function in (
        closed,
        closed.derivative,
        sine,
        sine.derivative,
        table,
        table.derivative,
        *(lambda x, k=k: closed.log(x)[k] for k in (0, 1)),
    ):
        found = function(points)
        assert found.mask.tolist() == points.mask.tolist()
        assert found[~points.mask].tolist() == function(np.array([1.0, 2.0, 0.5])).tolist()
    balls = kovacic.evaluate("x", points, **SINE)
    assert balls.mask.tolist() == points.mask.tolist()
    assert balls[1, 0] == kovacic.evaluate("x", [1, 2, "1/2"], **SINE)[1]


@parametrize(
    ("equation", "interval"), [("x", (-1000, 0)), ("-x^2", (0, 300)), ("-1", (0, 30_000))], ordinary=0, long=(0,)
)
def test_tables_may_have_tens_of_thousands_of_pieces(equation: str, interval: tuple[int, int]) -> None:
    table = kovacic.tabulate(equation, *interval, careful=False, **SINE)
    places = [interval[0] + (interval[1] - interval[0]) * share for share in (0.0, 0.13, 0.48, 0.97, 1.0)]
    exact = kovacic.evaluate(equation, places, **SINE)
    size = max(abs(float(value)) for value in exact)
    assert [table(float(place)) for place in places] == pytest.approx([float(v) for v in exact], abs=1e-9 * size)


@pytest.mark.parametrize(
    ("equation", "interval", "start", "exact"),
    [
        pytest.param("-1", (0, 3142), SINE, math.sin, marks=pytest.mark.long),
        pytest.param(
            "y'' + 2*y' + 101*y = 0",
            (-1, 30),
            SINE,
            lambda x: math.exp(-x) * math.sin(10 * x) / 10,
            marks=pytest.mark.long,
        ),
        ("4", (0, 9), {"x0": "1/3", "y0": 1, "dy0": 0}, lambda x: math.cosh(2 * x - 2 / 3)),
        pytest.param(
            "-1 + 2/x^2",
            (1, 1000),
            {"x0": 1, "y0": "sin(1) - cos(1)", "dy0": "cos(1)"},
            lambda x: math.sin(x) / x - math.cos(x),
            marks=pytest.mark.long,
        ),
    ],
)
def test_functions_with_given_values_are_those_of_the_closed_form(
    equation: str, interval: Any, start: dict[str, Any], exact: Any
) -> None:
    """Up to a thousand zeros."""
    f: Any = kovacic.solve(equation).lambdify(interval=interval, **start)
    assert f.measured is not None
    assert f.measured.worst < 1000
    assert f.interval == interval
    points = [interval[0] + (interval[1] - interval[0]) * share for share in (0.0, 0.17, 0.5, 0.83, 1.0)]
    for point in points:
        assert f(point) == pytest.approx(exact(point), rel=2e-12, abs=1e-15)


# Equations that no other test has, since what was found about polynomials is kept.
TABLES: list[tuple[str, Any, Any, dict[str, Any], int, tuple[int, ...], list[str]]] = [
    (
        "-x - 2/7",
        -1,
        "13/2",
        {"x0": "1/3", "y0": 2, "dy0": "-1/5"},
        118,
        (1, 2, 34, 5),
        ["1.6666261657196", "-1.4582102667657", "1.072359927912", "0.48336015030071"],
    ),
    (
        "x - 2/7",
        -3,
        4,
        {"x0": "1/3", "y0": 2, "dy0": "-1/5", "careful": False},
        116,
        (1, 2, 22, 5),
        ["1.1604453121623", "1.9695132078625", "4.5633457881033", "68.784362685836"],
    ),
    (
        "y'' + sin(2*x)*y' + (3 + x/5)*y = cos(x)",
        -1,
        2,
        {"x0": "1/3", "y0": 2, "dy0": "-1/5"},
        3200,
        (1, 2, 34, 7),
        ["1.3010382897464", "1.8997046050923", "0.48006035527743", "-1.0332775277763"],
    ),
    (
        "-3/(16*x^2) + 5/(7*x - 21)",
        "1/100",
        2,
        {"x0": "1/3", "y0": 2, "dy0": "-1/5"},
        305,
        (1, 2, 34, 16),
        ["1.9189587440889", "1.4147014931689", "0.7081846116457", "-0.094446588702518"],
    ),
    (
        "(x - 3/31)^2*y'' + (x - 3/31)*y' + (x^2 - 4/9)*y = 0",
        "3/31",
        5,
        {"x0": "3/31", "frobenius": (0, 3)},
        513,
        (1, 2, 34, 100),
        ["2.4194352847753", "1.2179788304591", "-0.77989842580973", "-1.2902838361268"],
    ),
    (
        "(x^2 + 37/31)*y'' + 3*x*y' + 5/7*y = 0",
        -3,
        4,
        {"x0": "1/3", "y0": "2 + I", "dy0": "-I/5"},
        277,
        (2, 2, 34, 13),
        [
            "1.1558365007062+0.79522866166222j",
            "1.9859962588284+0.96202802984661j",
            "1.4300084985214+0.58491295429063j",
            "1.1116075916223+0.43270605085267j",
        ],
    ),
    (
        "x^2 + 5/11",
        -2,
        7,
        {"x0": "1/3", "y0": 2, "dy0": "-1/5"},
        163,
        (1, 2, 34, 12),
        ["2.0204858856787", "19.966413079372", "57621.827821009", "28479349323.302"],
    ),
]


@pytest.mark.parametrize(
    ("equation", "low", "high", "options", "looks", "shape", "values"), TABLES, ids=[row[0] for row in TABLES]
)
def test_the_work_of_tables(
    equation: str, low: Any, high: Any, options: dict[str, Any], looks: int, shape: tuple[int, ...], values: list[str]
) -> None:
    """Looks at the clock, halves, terms and pieces, and values on the way and at the end."""
    with controlled() as hands:
        table = kovacic.tabulate(equation, low, high, **options)
    assert (hands.looks, table.coefficients.shape) == (looks, shape)
    assert [f"{value:.14g}" for value in table(np.linspace(*table.interval, 5)[1:])] == values
