"""The two routes against each other, and monodromy against local exponents and against the Galois group."""

from __future__ import annotations

import math
import random
import warnings
from fractions import Fraction
from itertools import product
from typing import Any

import flint
import pytest
import second_opinion
import sympy
from build import QQ, RatFunc, ball_to_flint, parametrize
from published import load
from transform import from_omega, from_squared_difference

import kovacic
from kovacic import AccuracyWarning, InputError, LimitExceeded, Limits, connection_matrix, evaluate, monodromy

PRIMITIVE = {
    "tetrahedral": "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)",
    "octahedral": "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)",
    "icosahedral": "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)",
}


def agree(S: Any, *, x: Any, x0: Any, path: Any = None, digits: int = 25) -> None:
    solution = kovacic.solve(S)
    start: dict[str, Any] = {
        "x0": x0,
        "y0": 1,
        "dy0": Fraction(-3, 7),
        "digits": digits,
        "path": path,
        "derivative": True,
    }
    try:
        second = evaluate(solution, x, method="closed form", **start)
    except InputError:
        second = None
    if second_opinion.serves(solution):
        agree_with_the_second_opinion(solution, [x0, *(path or ()), x], digits)
    if second is None:
        return
    first = evaluate(solution, x, method="taylor", **start)
    assert first[0].overlaps(second[0])
    assert first[1].overlaps(second[1])
    assert second[0].route.method == "closed form"


def agree_with_the_second_opinion(solution: kovacic.Solution, vertices: list[Any], digits: int) -> None:
    """The Taylor route, and Klein's form or quadratures along the same polygon."""
    taylor = [ball_to_flint(entry) for row in connection_matrix(solution, vertices, digits=digits) for entry in row]
    prec = 4 * digits + 40
    while True:
        closed = second_opinion.transition(solution, vertices, prec)
        if all(entry.rel_accuracy_bits() > 3 * digits for entry in closed) or prec > (
            5000 if solution.case == 1 else 2000
        ):
            break
        prec *= 2
    assert all(entry.is_finite() for entry in closed)
    assert all(a.overlaps(b) for a, b in zip(taylor, closed, strict=True))
    size = max(float(abs(entry).mid()) for entry in taylor)
    assert all(entry.real.rad() + entry.imag.rad() < 10.0**-digits * 100 * size for entry in closed)


@parametrize(
    "S", ["x^2 + 3", "2", "-2", "2/x^2", "1 + 2/x^2", "1/(4*x^2)", "-1/(4*x^2)", "x^6 - 3*x^2", "x^2 - 21"], ordinary=3
)
@pytest.mark.parametrize("path", [None, [Fraction(3, 2) + 1]])
def test_case_1(S: str, path: Any) -> None:
    agree(S, x=Fraction(19, 7), x0=Fraction(3, 7), path=path)


@pytest.mark.parametrize("x", [0, "1e-20", -2, "0.5"])
def test_values_at_and_beyond_a_zero_of_the_closed_form(x: Any) -> None:
    agree("x^2 + 3", x=x, x0=2)  # y1 = x exp(x^2/2) vanishes at 0, an ordinary point


def test_initial_values_at_a_zero_of_the_closed_form() -> None:
    agree("x^2 + 3", x=1, x0=0)
    agree("x^2 - 7", x="1/3", x0=0)


@parametrize(
    "S",
    ["(16*x - 3)/(16*x^2)", "(7*x^2 - 10)/(4*x^4 - 8*x^2 + 4)", "(-84*x^2 + 84*x - 75)/(400*x^4 - 800*x^3 + 400*x^2)"],
    ordinary=1,
)
def test_case_2(S: str) -> None:
    agree(S, x=Fraction(19, 7), x0=Fraction(3, 7), path=[1 + 1j])
    agree(S, x=Fraction(3, 7), x0=Fraction(1, 7))


@parametrize("name", sorted(PRIMITIVE), ordinary=1)
def test_case_3(name: str) -> None:
    agree(PRIMITIVE[name], x=Fraction(19, 7), x0=Fraction(3, 7), path=[1 + 1j])
    agree(PRIMITIVE[name], x=Fraction(1, 2), x0=2, path=[1 - 1j], digits=60)


@parametrize(
    "S",
    ["-(10100*(1-x^2) + 1)/(1-x^2)^2", "-(250500*(1-x^2) + 1)/(1-x^2)^2", "x^2 - 101", "x^2 - 1001"],
    ordinary=1,
    long=2,
    ids=["Legendre, 100", "Legendre, 500", "Hermite, 50", "Hermite, 500"],
)
def test_polynomials_of_high_degree_on_an_interval_with_their_zeros(S: str) -> None:
    agree(S, x="9/10", x0="-1/3", digits=15)


@parametrize("seed", range(6), ordinary=1)
def test_case_3_along_random_paths(seed: int) -> None:
    rng = random.Random(seed)
    name = rng.choice(sorted(PRIMITIVE))
    path = [Fraction(rng.randint(-20, 20), 7) + Fraction(1, 9), complex(rng.uniform(-1, 2), rng.uniform(0.2, 2))]
    path.insert(1, complex(rng.uniform(-1, 2), -rng.uniform(0.2, 2)))  # once around a singular point, or around both
    agree(PRIMITIVE[name], x=path[0], x0=path[0], path=path[1:], digits=20)


def test_case_3_at_vertices_faces_and_edges() -> None:
    # J = 4 (1 - x)/x^2-like pull-backs take the values 0, 1 and infinity at ordinary points
    S = published_S("pull-A5-deg2")
    agree(S, x="5/3", x0="1/3", path=[1 + 1j])


def published_S(name: str) -> str:
    return next(entry.S for entry in load() if entry.id == name)


def random_solvable(rng: random.Random) -> RatFunc:
    """S of case 1 or 2 by construction."""
    x = RatFunc(QQ.poly([0, 1]))
    if rng.random() < 0.5:
        omega = RatFunc(QQ.poly([rng.randint(-2, 2)]))
        for _ in range(rng.randint(1, 3)):
            omega = omega + RatFunc(QQ.poly([Fraction(rng.randint(-3, 5), rng.choice([1, 2, 3]))])) / (
                x - rng.randint(-3, 3)
            )
        return from_omega(omega)
    num, den = QQ.poly([rng.choice([1, 2, -3]), rng.randint(-2, 2)]), QQ.poly([rng.randint(-3, 3), 1])
    return from_squared_difference(RatFunc(num, den))


def routes_agree_on(seed: int) -> None:
    rng = random.Random(seed)
    S = random_solvable(rng)
    x0, x = (Fraction(rng.randint(-40, 40), 13) + Fraction(1, 17) for _ in range(2))
    path = [complex(rng.randint(-3, 3), rng.choice([-1.5, 0.75, 2.25]))]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        agree(S, x=x, x0=x0, path=path, digits=12)


@parametrize("seed", range(12), ordinary=3, long=5)
def test_the_routes_agree_on_random_problems(seed: int) -> None:
    routes_agree_on(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(40))
def test_the_routes_agree_on_thousands_of_random_problems(block: int) -> None:
    for seed in range(1000 + 50 * block, 1050 + 50 * block):
        routes_agree_on(seed)


def test_an_equation_without_closed_form_says_so() -> None:
    for S in ("x^3 + x + 1", "x^2 + 3 + 1/(x-1)^2"):  # no Liouvillian solution, no special function
        with pytest.raises(InputError, match="without a quadrature, and pull-backs of Airy's"):
            evaluate(kovacic.solve(S), 3, x0=2, y0=1, dy0=0, method="closed form")
        assert evaluate(kovacic.solve(S), 3, x0=2, y0=1, dy0=0).digits > 15


def test_the_closed_form_stops_at_the_time_limit() -> None:
    solution = kovacic.solve("1 + 2/x^2")
    with pytest.raises(LimitExceeded, match="time limit"):
        evaluate(solution, 3, x0=2, y0=1, dy0=0, digits=500, method="closed form", limits=Limits(seconds=1e-9))


# --- monodromy -------------------------------------------------------------------------------------------------------


@parametrize(
    ("name", "orders"), [("tetrahedral", {4, 6}), ("octahedral", {4, 6, 8}), ("icosahedral", {4, 6, 10})], ordinary=1
)
def test_finite_groups_have_monodromy_of_finite_order(name: str, orders: set[int]) -> None:
    for local in monodromy(PRIMITIVE[name]):
        assert local.consistent
        order = next(k for k in range(1, 61) if local.is_identity_to_the_power(k))
        assert any(k % order == 0 for k in orders), order
        assert not local.is_identity_to_the_power(order + 1) or order == 1


@parametrize(
    "S", ["1/(x^2+1)^2 + x", "x/(x^3-x-1)^2 + 1/(x+2)", "1/x^3 + 1/(x-1)", "(3/4)/x^2 + 1", "-1/(4*x^2)"], ordinary=1
)
def test_traces_come_out_of_the_exponents(S: str) -> None:
    found = monodromy(S)
    assert found
    for local in found:
        assert local.consistent
        assert (local.trace is None) == (local.multiplicity > 2)


@parametrize(
    ("S", "params"),
    [
        ("sqrt(2)/(x^2*(x-1))", None),
        ("-3/(16*(x-sqrt(2))^2) - 3/(16*(x-1)^2) + sqrt(2)/((x-sqrt(2))*(x-1))", None),
        ("n/x^2 + 1/(x-m)^2", {"n": "sqrt(3)", "m": "pi"}),
    ],
    ordinary=1,
)
def test_monodromy_where_constants_are_irrational(S: str, params: Any) -> None:
    found = monodromy(S, params=params)
    assert len(found) == 2
    assert all(local.consistent and local.trace is not None and local.trace.radius < 1e-15 for local in found)


def test_the_group_of_an_equation_with_an_algebraic_constant_agrees() -> None:
    (local,) = monodromy("-3/(16*(x-sqrt(2))^2)")  # the double pole is one of multiplicity 2, not two beside each other
    assert local.multiplicity == 2
    assert [k for k in range(1, 9) if local.is_identity_to_the_power(k)] == [4, 8]
    assert kovacic.solve("-3/(16*(x-sqrt(2))^2)").compare_with_monodromy().verdict is True


def test_real_singular_points_are_known_to_be_real() -> None:
    """sqrt(2) and -sqrt(2), which were isolated among complex numbers."""
    points = [local.point for local in monodromy("1/(x^2 - 2)", digits=3)]
    assert [point.real for point in points] == [True, True]
    assert all((point * point).contains(2) for point in points)


def test_a_logarithm_has_infinite_order_and_a_polynomial_has_no_monodromy() -> None:
    (local,) = monodromy("-1/(4*x^2)")
    assert not any(local.is_identity_to_the_power(k) for k in range(1, 30))
    assert monodromy("x^2 + 1") == ()


@parametrize(
    "S",
    [
        "1/(x^2*(x^2-2*x+5))",  # 1 + 2i lies on the left of 0, seen from the base point, if heights are forgotten
        *PRIMITIVE.values(),
        "(x^2+3)/(x^3-x-1)^2",
        "1/(4*x^2*(x-1)^2) + 1/(x*(x-1))",
        "1/(x^2+1)^2",
    ],
    ordinary=1,
    long=4,
)
def test_the_product_of_all_loops_is_the_loop_around_infinity(S: str) -> None:
    with flint.ctx.workprec(300):
        total = flint.acb_mat([[1, 0], [0, 1]])
        for local in monodromy(S, digits=20):
            total = flint.acb_mat([[ball_to_flint(entry) for entry in row] for row in local.matrix]) * total
        leading = sympy.limit(sympy.sympify(S.replace("^", "**")) * sympy.Symbol("x") ** 2, "x", sympy.oo)
        difference = flint.acb(1 + 4 * flint.acb(int(leading.p)) / int(leading.q)).sqrt()
        trace = total[0, 0] + total[1, 1]
        assert trace.overlaps(-2 * difference.cos_pi())
        assert trace.real.rad() < 1e-15


@pytest.mark.parametrize(
    ("equation", "start", "method"),
    [
        pytest.param("x^3 + 1", {"x0": 0, "y0": 1, "dy0": 0}, "taylor", marks=pytest.mark.long),
        ("x", {"x0": 0, "y0": 1, "dy0": "1/7"}, "closed form"),  # a start of its own: ways are kept
        (kovacic.solve("x^2 + 3"), {"x0": 1, "y0": 1, "dy0": 0}, "closed form"),
        ("sin(x)", {"x0": 0, "y0": 1, "dy0": 0}, "taylor"),
    ],
)
def test_a_ball_knows_its_route(equation: Any, start: dict[str, Any], method: str) -> None:
    y, dy = kovacic.evaluate(equation, 60, derivative=True, **start)
    assert y.route == dy.route
    assert y.route is not None
    assert (y.route.method, y.route.digits, y.route.runs) == (method, 15, 1)
    assert kovacic.Ball(y.re, y.im, y.rad, y.real) == y
    assert (y + 1).route is None


@pytest.mark.parametrize(("S", "x"), [("16*x^2 + 4", 30), ("-x^2 - 1", 20)])
def test_small_values_in_a_disc_need_no_second_run(S: str, x: int) -> None:
    """Where solutions grow by more than the spare bits in a disc, values at its beginning would lack digits."""
    values = evaluate(S, [Fraction(x * k, 40) for k in range(1, 41)], x0=0, y0=1, dy0=9, digits=200, method="taylor")
    assert all(value.digits >= 200 and value.route.runs == 1 for value in values)


@pytest.mark.parametrize(("S", "x0", "x"), [("20/(x + 1)^2", 0, "1/2"), ("30/(x + 2)^2", 0, "1/2")])
def test_equations_with_sure_solutions_are_decided_first(S: str, x0: int, x: str) -> None:
    """Euler's equation has powers for certain: the price of Taylor's method is below that from which others are decided."""
    y = evaluate(S, x, x0=x0, y0=1, dy0="-5/3", digits=200)
    assert y.route is not None
    assert y.route.method == "closed form"
    assert y.overlaps(evaluate(S, x, x0=x0, y0=1, dy0="-5/3", digits=200, method="taylor"))


def test_a_target_where_two_discs_meet_needs_no_way_of_its_own(caplog: pytest.LogCaptureFixture) -> None:
    # y'' = -10^4 y: the discs are [0, 1], [1, 2], ..., and these targets are among their ends
    targets = [Fraction(k, 4) for k in range(1, 41)]
    with caplog.at_level("DEBUG", logger="kovacic.enclosure.rational"):
        values = evaluate("-10^4", targets, x0=0, y0=0, dy0=100, method="taylor")
    ways = [record for record in caplog.records if record.getMessage().startswith("from ")]
    assert len(ways) == values[0].route.runs
    assert all(abs(float(v) - math.sin(100 * float(x))) < 1e-12 for x, v in zip(targets, values, strict=True))


@pytest.mark.long
def test_a_first_ball_that_contains_zero_doubles_the_precision_only() -> None:
    S = "x/2+x^2-x^3-x^4+5/3*x^5-5/3*x^6"
    value = evaluate(S, "5+8*I", x0=-1, y0="-11/4", dy0="4/3", digits=5, path=["1/3+2*I"])
    assert 5 <= value.digits < 40


@pytest.mark.parametrize(
    ("equation", "stop", "exact"),
    [
        ("2", 10, lambda x: math.cosh(math.sqrt(2) * x)),
        ("y'' + 10^6*y' + y = 0", 10, lambda x: math.exp(-x * 1e-6) * (1 + 1e-12)),
        ("-10000", 90, lambda x: math.cos(100 * x)),
        ("x^2*y'' + 2*x*y' + 400*x^2*y = 0", 30, None),
    ],
)
def test_text_has_the_closed_form_that_its_solution_has(equation: str, stop: int, exact: Any) -> None:
    start: dict[str, Any] = {"x0": 1 if exact is None else 0, "y0": 1, "dy0": 0}
    text = evaluate(equation, stop, method="closed form", **start)
    default = evaluate(equation, stop, **start)
    solved = kovacic.solve(equation).at(stop, **start)
    assert text.route.method == solved.route.method == "closed form"
    if equation != "2":  # of two discs and a decision neither is dearer
        assert default.route.method == "closed form"
    assert text.overlaps(solved)
    assert text.overlaps(default)
    if exact is not None:
        assert abs(float(text) - exact(stop)) < 1e-9 * abs(exact(stop))


def test_many_targets_far_apart_in_phase_take_the_closed_form_and_near_ones_the_discs() -> None:
    s = kovacic.solve("-10000")
    far = [Fraction(k, 10) for k in range(200)]
    near = [Fraction(k, 10**6) for k in range(200)]
    for targets, method in ((far, "closed form"), (near, "taylor")):
        values = s.at(targets, x0=0, y0=0, dy0=100)
        assert {value.route.method for value in values[1:]} == {method}
        assert all(abs(float(v) - math.sin(100 * float(x))) < 1e-12 for x, v in zip(targets, values, strict=True))


def test_there_is_no_closed_form_where_none_exists() -> None:
    with pytest.raises(InputError, match="is for solutions of case 1 without a quadrature, and pull-backs"):
        evaluate("x^3 + x + 1", 2, x0=1, y0=1, dy0=0, method="closed form")


@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize("method", [None, "taylor", "closed form"])
def test_coefficients_of_thousands_of_digits_crash_nothing(sign: str, method: Any) -> None:
    large = "1" + "0" * 4998 + "7"
    limits = Limits(seconds=1)
    for S, x in ((sign + large, 1), (f"{sign}x/{large}", 1), ("x", f"{sign}1/{large}")):
        try:
            value = evaluate(S, x, x0="1/2", y0=1, dy0=1, method=method, limits=limits)
        except LimitExceeded:
            continue
        assert value.digits >= 15


BESSEL = "x^2*y'' + x*y' + (x^2 - 1/9)*y = 0"


@pytest.mark.parametrize(
    ("equation", "x0", "x"),
    [
        (BESSEL, 0, 3),
        (BESSEL, 0, 300),
        ("x*(1-x)*y'' + (5/4 - 11/6*x)*y' - y/6 = 0", 0, "9/10"),
        ("x*y'' + (3/2 - x)*y' - y/3 = 0", 0, 20),
        ("(1-x^2)*y'' - 2*x*y' + y/3 = 0", 1, "-1/2"),
    ],
)
def test_discs_from_a_singular_point_on_are_foreseen(equation: str, x0: int, x: Any) -> None:
    """They aren't free: functions that FLINT has are found, and agree with Taylor's method."""
    start: dict[str, Any] = {"x0": x0, "which": "regular", "digits": 20}
    value = evaluate(equation, x, **start)
    assert value.route is not None
    assert value.route.method == "closed form"
    assert value.overlaps(evaluate(equation, x, method="taylor", **start))


@pytest.mark.parametrize("b", [10**4, 10**8])
def test_beside_a_pole_growth_that_no_step_lessens_is_foreseen(b: int) -> None:
    """S = b/x^2: over half a step from 0 a solution grows as much as over a whole one, and halving never ends."""
    value = evaluate(f"{b}*(x + 1)/x^2", "1/1000", x0=0, which="regular", digits=15)
    assert value.digits >= 15


NEARLY_DEPENDENT = [
    ("x^2 + 7", 20, "141/7"),
    ("x^2 + 1/3", 20, 21),
    ("x^4 - 5/2*x", 10, "71/7"),
    ("1/4 - 2/x + 7/(3*x^2)", 800, 801),
]


@parametrize(
    ("start", "problem", "digits"),
    product([{"y0": 1, "dy0": -1}, {"y0": 1, "which": "decaying"}], NEARLY_DEPENDENT, [15, 50]),
    ordinary=(0, 2),
    long=2,
)
def test_functions_that_are_nearly_dependent_at_the_start(
    start: dict[str, Any], problem: tuple[str, int, Any], digits: int
) -> None:
    """Both of FLINT's functions grow to there: that their digits are lost is foreseen, for the choice and for the precision."""
    equation, x0, x = problem
    given: dict[str, Any] = {"x0": x0, "digits": digits, **start}
    default = evaluate(equation, x, **given)
    functions = evaluate(equation, x, method="closed form", **given)
    assert default.route is not None
    assert functions.route is not None
    assert default.route.method == "taylor"
    assert functions.route.runs <= 2
    assert default.overlaps(functions)
    assert functions.digits >= digits


def test_a_known_solution_of_high_degree_serves_where_none_would_be_sought() -> None:
    """Off the real axis its targets are dearer: for thirty of them Taylor's method is cheaper, for one it isn't."""
    equation = "1 + 1640/x^2"  # a polynomial of degree 40
    start: dict[str, Any] = {"x0": 1, "y0": 1, "dy0": 0}
    solution = kovacic.solve(equation)
    known, sought = solution.at(2, **start), evaluate(equation, 2, **start)
    assert (known.route.method, sought.route.method) == ("closed form", "taylor")
    assert known.overlaps(sought)
    for count, method in ((1, "closed form"), (30, "taylor")):
        points = [complex(1 + k / 128, k / 256) for k in range(1, count + 1)]
        assert solution.at(points, **start)[-1].route.method == method
