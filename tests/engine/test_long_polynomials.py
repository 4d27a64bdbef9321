"""Case 1 where P is too long to be listed and known by a recurrence of two terms: decided at any degree."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from build import QQ

import kovacic
from kovacic.checker import verdict
from kovacic.decision import NoTerminatingSeries
from kovacic.verify import verify

N = 10**9
x = sympy.Symbol("x")
LOW = kovacic.Limits(unknown_degree=3)


@pytest.mark.parametrize(
    ("equation", "theta", "powers"),
    [
        ("x^2 + 2000000001", "x", (2, N, 0)),  # Hermite
        ("x^2 + 2000000003", "x", (2, N + 1, 1)),
        ("4*(x - 3)^2 + 4000000002", "2*x - 6", (2, N, 0)),
        ("a^2*x^2 + 2000000001*a", "a*x", (2, N, 0)),
        ("-x^2 - 2000000001*I", "-I*x", (2, N, 0)),
        ("x^6 + 2000000003*x^2", "x**3", (4, N, 0)),
        ("y'' = (1/4 - 1000000000/x - 1/(4*x^2))*y", None, None),  # d = 10^9 - 1/2 isn't natural
        ("1/4 - 1000000000/x", "(-x + 2)/(2*x)", (1, N - 1, 0)),  # the simple pole leaves the exponent 1 alone
        ("x*y'' + (1 - x)*y' + 1000000000*y = 0", "(-x + 1)/(2*x)", (1, N, 0)),  # Laguerre
        ("(1 - x^2)*y'' - 2*x*y' + 1000000001000000000*y = 0", "x/(x**2 - 1)", (1, N, 0)),  # Legendre
        ("(1 + x^2)*y'' + 2*x*y' - 1000000001000000000*y = 0", "x/(x**2 + 1)", (2, N, 0)),
        ("10000100000/x^2 - 1", "(c*x - 100000)/x", (1, 10**5, 0)),  # Bessel, of order 10^5 + 1/2
        ("39999999999/(4*x^2) - 1", None, None),  # and 10^5
        ("x^2 + 2000000000", None, None),
        ("x^6 + 2000000007*x^2", None, None),  # d = 10^9 + 2 isn't 0 or 1 modulo 4
        ("x^2 + 6000000014/3 - 5/(36*x^2)", None, None),  # d = 10^9 + 1 is odd
    ],
)
def test_decided_at_any_degree(equation: str, theta: str | None, powers: tuple[int, int, int] | None) -> None:
    answer = kovacic.solve(equation)
    series = answer.series
    assert answer.status == ("none" if theta is None else "liouvillian")
    assert answer.verified
    assert not answer.verify().unchecked
    if series is not None:
        assert (str(series.theta), (series.step, series.degree, series.lowest)) == (theta, powers)
        assert max(len(str(y)) for y in answer.solutions) < 250
        assert kovacic.Solution.from_json(answer.to_json(full=True)) == answer
    assert (series is None) == (theta is None)


@pytest.mark.parametrize(
    "S",
    [
        *(f"4*(x - 1)^2 + {2 * k}" for k in (17, 18, 27)),
        *(f"x^6 + {3 + 2 * n}*x^2" for n in range(8, 12)),
        *(f"x^2 + {Fraction(2, 3) + n}  - 5/(36*x^2)" for n in (16, 18, 20, 22)),
        *(f"1/4 - {k + Fraction(1, 3)}/x - 5/(36*x^2)" for k in (9, Fraction(13, 2))),
        *(f"1/4 - {k + Fraction(1, 2)}/x + 20/x^2" for k in (9, Fraction(13, 2))),
        *(f"{n * (n + 1)}/x^2 - 4" for n in (9, 10, Fraction(19, 3))),
        *(f"(-1 - {n * (n + 1)}*(1 - x^2))/(1 - x^2)^2" for n in (9, Fraction(19, 2))),
        "(1 - 9^2)/(4*(1 - x^2)) - 20/(1 - x^2)^2",
        "30/x^2 + 3/(4*(x - 1)^2) - 27/(x*(x - 1))",  # a P of degree 4, and an obstruction to one of degree 8
        "(x^2 - 76*x + 99)/(4*(x - 1)^2)",  # a logarithm within the limits, of which nothing is known beyond
    ],
)  # fmt: skip
def test_the_same_as_with_the_polynomial_written_out(S: str) -> None:
    full = kovacic.solve(S)
    low = kovacic.solve(S, limits=LOW)
    assert (low.status, low.case, low.verified) == (full.status, full.case, True)
    assert low.group is None or low.group.name == full.group.name
    if low.series is None or low.series.theta.field != QQ or full.omega.field != QQ:
        return
    # Both omegas are rational; one that is unique is the same.
    y = low.solutions[0]
    for point in (sympy.Rational(1, 7), sympy.Rational(2, 5)):
        value = complex((y.diff(x) / y).subs(x, point).evalf(30))
        S_there = complex(sympy.sympify(S.replace("^", "**")).subs(x, point))
        slope = complex((y.diff(x) / y).diff(x).subs(x, point).evalf(30))
        assert abs(slope + value**2 - S_there) < 1e-12 * (1 + abs(S_there))
        if full.group.kind.value in ("additive", "borel"):
            assert abs(value - complex(full.omega._sympy_().subs(x, point))) < 1e-12 * (1 + abs(value))


@pytest.mark.parametrize(
    "equation",
    [
        "x^2 + 2000000001",
        "10000100000/x^2 - 1",
        "(1 - x^2)*y'' - 2*x*y' + 1000000001000000000*y = 0",
        # exponent differences 10^9 + 1, 2 and 4: a P with a degree higher by 4 would be obstructed at this degree
        "1000000002000000000/(4*x^2) + 3/(4*(x - 1)^2) - 1000000001999999988/(4*x*(x - 1))",
    ],
)
def test_a_forged_series(equation: str) -> None:
    """Every change of a certificate is noticed by the kernel and by the checker."""
    answer = kovacic.solve(equation)
    line = json.loads(answer.to_json())
    assert verdict(json.dumps(line)).startswith("checked")
    series = line["proof"]["series"]
    step = series["step"]
    forgeries = [
        ("step", step + 1),
        *(("degree", series["degree"] + k) for k in (step, -step, 1, 4)),
        *(("lowest", series["lowest"] + k) for k in (step, 1)),
        ("theta", f"-({series['theta']})"),
        ("theta", f"{series['theta']} + 1"),
        ("centre", "1/7"),
    ]
    for key, value in forgeries:
        forged = line | {"proof": line["proof"] | {"series": series | {key: value}}}
        assert verdict(json.dumps(forged)).startswith("refuted"), (key, value)
        with pytest.raises((kovacic.VerificationFailed, kovacic.InputError)):
            kovacic.Solution.from_json(json.dumps(forged))


@pytest.mark.parametrize(
    "S", ["x^6 + 2000000003*x^2", "x^6 + 19*x^2", "x^2 + 3", "2/x^2", "6/x^2 + 1", "(x^2 - 3)/x^2"]
)
def test_no_series_is_claimed_to_be_missing(S: str) -> None:
    """Where there is a solution, no number of families that are ruled out is believed."""
    answer = kovacic.solve(S)
    no = kovacic.solve("x^6 + 2000000007*x^2").decision
    (exclusion, *others) = no.exclusions
    for count in range(6):
        claimed = replace(exclusion, evidence=(NoTerminatingSeries(count),))
        assert not verify(answer.S, replace(no, exclusions=(claimed, *others)))


@pytest.mark.parametrize(
    ("equation", "group", "given"),
    [
        ("x^2 + 2000000001", "Borel", "Borel"),
        ("x*y'' + (1 - x)*y' + 1000000000*y = 0", "Borel", "G_a extended by G_m"),
        ("(1 - x^2)*y'' - 2*x*y' + 1000000001000000000*y = 0", "G_a extended by mu_2", "G_a"),
    ],
)
def test_the_group_of_a_single_series(equation: str, group: str, given: str) -> None:
    answer = kovacic.solve(equation)
    assert (answer.group.name, answer.equation_group.name) == (group, given)
    assert bool(answer.verify())


def test_what_the_other_doors_say() -> None:
    answer = kovacic.solve("x^2 + 2000000001")
    assert answer.omega is None
    moved = kovacic.solve("(x - 1/b)^2 + 2000000001")
    assert (moved.case, str(moved.generic_conditions)) == (1, "b != 0")
    assert "steps of 2" in answer.explain()
    assert "{}_{1}F_{1}" in answer._repr_latex_()
    with pytest.warns(UserWarning, match="a value isn't finite"):  # which a check with fewer digits needs
        found = kovacic.dsolve("y'' = (x^2 + 2000000001)*y")
    assert found.rhs.has(sympy.hyper)
    with pytest.raises(kovacic.LimitExceeded, match="a rational solution may have degree 1000000000"):
        kovacic.solve_riccati("w' = x^2 + 2000000001 - w^2")


@pytest.mark.parametrize(
    "omega",
    [
        "30/x + 5^90/(x^3 - 2)",  # a logarithm at 0 isn't looked for: all solutions may look alike there
        "9/x + x/(x^2 - 1) + x/(x^2 - 4) + 2*x/(3*(x^2 - 9)) + 2*x/(3*(x^2 - 16))",  # 2^10 combinations of exponents
        "x + 1/(3*x) + 1/(x^3 - 2)",
        "30/(x^2 - 2) + 2*I/x",
        "29*a/x + 2*x/(x^2 - 5)",
        "2*x + 30/x + 2*x/(x^2 + 3)",
        "-9/x^2 + 40/x + 2*x/(x^2 + 3)",
        "30/x^2 - 2/x - 1/(x - 3)",
        "40*x/(x^2 - 2) + 3/(x^2 + 1)",
        "3*x^2 + 40*x/(x^2 - 2)",
        "2*x - 3/x",  # x^4 and x^-3 at 0, in steps of 2, and different ends at infinity
        "30/(x - 1) - 3/x",  # poles alone, at 0 with solutions that look alike
        "x + 4*x^3/(x^4 + 3*x^2 + 3/4)",  # the zeros of a Hermite polynomial
    ],
)
def test_a_simple_solution_beside_exponents_that_are_far_apart(omega: str) -> None:
    w = sympy.sympify(omega.replace("^", "**"))
    point = {x: 0.7, "a": 1.3}
    answer = kovacic.solve(w.diff(x) + w**2, limits=kovacic.Limits(unknown_degree=5))
    assert answer.verified
    assert abs(complex(((answer.omega._sympy_() - w) / w).subs(point))) < 1e-12


def test_no_simple_solution_with_irrational_exponents() -> None:
    answer = kovacic.solve("7/x^2 + 870/(x - 1)^2", limits=kovacic.Limits(unknown_degree=5))
    assert answer.reason == "an invariant of degree 2 may have degree 58, above the limit of 5"
