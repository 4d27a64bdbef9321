"""Starts at regular singular points: Frobenius bases against FLINT's special functions, and connection matrices."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
import sympy
from build import ball_to_flint, parametrize
from flint import acb, arb, ctx, fmpq

import kovacic
from kovacic import Ball, InputError, connection_matrix, evaluate

Value = Callable[[acb], acb]


def number(value: Any) -> acb:
    """A number of Python at FLINT's precision."""
    if isinstance(value, Fraction):
        return acb(arb(fmpq(value.numerator, value.denominator)))
    return acb(value)


def agree(equation: str, start: Any, x: Any, expected: Value, *, x0: Any = 0, digits: int = 30, **options: Any) -> None:
    """The ball has the digits asked for and contains the value; the slope agrees with the difference quotient's limit."""
    with ctx.workprec(int(digits * 3.33) + 120):
        coordinates = [ball(value) for value in start]
        right = expected(number(x))
        for method in ("taylor", None):  # without FLINT's functions, and as the rule has it
            value = evaluate(equation, x, x0=x0, frobenius=coordinates, digits=digits, method=method, **options)
            assert ball_to_flint(value).overlaps(right)
            assert right.rel_accuracy_bits() > digits * 3.32 + 20
            assert value.digits >= digits


def ball(value: Any) -> Any:
    return value if isinstance(value, int | Fraction) else acb(value)


def bessel(nu: Any, sign: int = 1) -> str:
    return f"x^2*y'' + x*y' + ({sign}*x^2 - ({nu})^2)*y = 0"


BESSEL_ORDERS = [
    Fraction(1, 3),
    Fraction(0),
    Fraction(2),
    Fraction(5, 2),
    Fraction(7),
    Fraction(22, 7),
    Fraction(1, 100),
]


@pytest.mark.parametrize("nu", BESSEL_ORDERS)
@parametrize("x", [3, Fraction(1, 10), 25, -2, 1 + 2j], ordinary=1, long=2)
def test_bessel_functions_from_their_singular_point(nu: Fraction, x: Any) -> None:
    with ctx.workprec(300):
        v = number(nu)
        coordinates = (0, 1 / (acb(2) ** v * (v + 1).gamma()))
    agree(bessel(nu), coordinates, x, lambda z: z.bessel_j(v))
    agree(bessel(nu, -1), coordinates, x, lambda z: z.bessel_i(v))


@pytest.mark.parametrize("n", [0, 1, 5])
@pytest.mark.parametrize("x", [4, 1 - 1j])
def test_logarithms_of_bessel_functions_of_the_second_kind(n: int, x: Any) -> None:
    """Y_n = -(n-1)!/pi (x/2)^-n + ... + 2/pi log(x/2) J_n - (psi(1) + psi(n + 1))/(pi n!) (x/2)^n + ..., K_n alike."""
    with ctx.workprec(300):
        pi, half = acb.pi(), acb(1) / 2**n / acb(n + 1).gamma()
        free = (acb(1).digamma() + acb(n + 1).digamma()) / 2 + acb(2).log()
        dominant = 2 / pi if n == 0 else -acb(n).gamma() / pi * 2**n
        second = -2 / pi * (acb(2).log() + (acb(1).digamma() + acb(n + 1).digamma()) / 2) * half
        k_dominant = acb(-1) if n == 0 else acb(n).gamma() * acb(2) ** (n - 1)
        k_second = (-1) ** n * free * half
    agree(bessel(n), (dominant, second), x, lambda z: z.bessel_y(n))
    agree(bessel(n, -1), (k_dominant, k_second), x, lambda z: z.bessel_k(n))


def test_irrational_exponents() -> None:
    with ctx.workprec(300):
        root = acb(2).sqrt()
        agree("x^2*y'' + x*y' + (x^2 - 2)*y = 0", (0, 1), 5, lambda z: z.bessel_j(root) * 2**root * (root + 1).gamma())
        # exponents +-i: x^i (1 + ...) is the second one
        i = acb(0, 1)
        agree("x^2*y'' + x*y' + (x^2 + 1)*y = 0", (0, 1), 5, lambda z: z.bessel_j(i) * 2**i * (i + 1).gamma())


HYPERGEOMETRIC = [
    ("1/3", "1/2", "3/4"),
    ("1/3", "1/2", "5/4"),
    ("-2", "3", "1"),
    ("1/2", "1/2", "1"),
    ("2/3", "5/7", "3"),
]


def gauss(a: str, b: str, c: str) -> str:
    return f"x*(1-x)*y'' + ({c} - ({a}+{b}+1)*x)*y' - ({a})*({b})*y = 0"


@parametrize(("a", "b", "c"), HYPERGEOMETRIC, ordinary=3)
@parametrize("x", [Fraction(1, 2), Fraction(9, 10), -7, 2 + 1j, -1 - 3j], ordinary=2)
def test_gauss_from_zero_and_from_infinity(a: str, b: str, c: str, x: Any) -> None:
    p, q, r = (Fraction(v) for v in (a, b, c))
    coordinates = (0, 1) if r >= 1 else (1, 0)
    with ctx.workprec(300):
        u, v, w = map(number, (p, q, r))
        agree(gauss(a, b, c), coordinates, x, lambda z: z.hypgeom_2f1(u, v, w))
        if x != Fraction(1, 2) and x != Fraction(9, 10) and (p - q).denominator > 1:  # t^a (1 + ...), t = 1/x
            first = (1, 0) if p < q else (0, 1)
            value = lambda z: (1 / z) ** u * (1 / z).hypgeom_2f1(u, u - w + 1, u - v + 1)  # noqa: E731
            agree(gauss(a, b, c), first, x, value, x0="oo")


@pytest.mark.parametrize(("k", "mu"), [("1/3", "2/7"), ("0", "1/2"), ("5/2", "0"), ("-1", "1"), ("2", "3/2")])
@pytest.mark.parametrize("x", [Fraction(1, 3), 1 + 1j])
def test_whittaker_functions_from_zero(k: str, mu: str, x: Any) -> None:
    with ctx.workprec(300):
        kappa, m = number(Fraction(k)), number(Fraction(mu))

        def whittaker(z: acb) -> acb:
            return (-z / 2).exp() * z ** (m + acb(1) / 2) * z.hypgeom_1f1(m - kappa + acb(1) / 2, 1 + 2 * m)

        agree(f"1/4 - ({k})/x + (({mu})^2 - 1/4)/x^2", (0, 1), x, whittaker)


def test_an_irrational_singular_point() -> None:
    """P_nu(x/sqrt(2)) is regular at sqrt(2), with the value 1."""
    with ctx.workprec(300):
        nu, root = acb(1) / 3, acb(2).sqrt()
        equation = "(2 - x^2)*y'' - 2*x*y' + 4/9*y = 0"
        for x0 in ("sqrt(2)", sympy.sqrt(2), acb(2).sqrt()):
            value = evaluate(equation, Fraction(1, 3), x0=x0, which="regular", digits=40)
            assert ball_to_flint(value).overlaps((acb(1) / 3 / root).legendre_p(nu))
            assert value.digits >= 40
            assert value.real
    with pytest.raises(InputError, match="0 singular points"):
        evaluate(equation, 0, x0="sqrt(3)", which="regular")


@pytest.mark.parametrize("digits", [5, 60, 1000])
def test_few_and_many_digits(digits: int) -> None:
    agree(
        bessel("1/3"),
        (0, 1),
        30,
        lambda z: z.bessel_j(acb(1) / 3) * 2 ** (acb(1) / 3) * (acb(4) / 3).gamma(),
        digits=digits,
    )


def test_the_connection_of_zero_and_one_is_that_of_kummer() -> None:
    """2F1(a, b; c; x) = A 2F1(a, b; a+b-c+1; 1-x) + B (1-x)^(c-a-b) 2F1(...), A = G(c) G(c-a-b)/(G(c-a) G(c-b))."""
    for a, b, c in (("1/3", "1/2", "3/4"), ("1/5", "1/7", "2/3"), ("1/3", "1/5", "3/2")):
        matrix = connection_matrix(gauss(a, b, c), [0, 1], digits=30)
        with ctx.workprec(250):
            p, q, r = (number(Fraction(v)) for v in (a, b, c))
            A = r.gamma() * (r - p - q).gamma() / ((r - p).gamma() * (r - q).gamma())
            B = r.gamma() * (p + q - r).gamma() / (p.gamma() * q.gamma())
            B *= (r - p - q).exp_pi_i()  # t = x - 1 is negative, and its principal logarithm has the imaginary part pi
            B = B.conjugate()
            column = 0 if Fraction(c) < 1 else 1
            rows = (0, 1) if (r - p - q).real > 0 else (1, 0)
            assert ball_to_flint(matrix[rows[0]][column]).overlaps(A)
            assert ball_to_flint(matrix[rows[1]][column]).overlaps(B)
            assert all(entry.digits > 25 for row in matrix for entry in row)


def test_connections_are_a_groupoid() -> None:
    """The way there and back is the identity; around all singular points of Gauss's equation as well."""
    for path in ([0, 1, 0], [0, "1/2+1j/3", "oo", "1/2+1j/3", 0]):
        path = [sympy.sympify("1/2+I/3") if isinstance(v, str) and "j" in v else v for v in path]
        middle = path[len(path) // 2]
        there = connection_matrix(gauss("1/3", "1/2", "3/4"), path[: len(path) // 2 + 1], digits=20)
        back = connection_matrix(gauss("1/3", "1/2", "3/4"), path[len(path) // 2 :], digits=20)
        assert middle in (1, "oo")
        with ctx.workprec(200):
            (a, b), (c, d) = ([ball_to_flint(v) for v in row] for row in there)
            (e, f), (g, h) = ([ball_to_flint(v) for v in row] for row in back)
            assert (e * a + f * c).contains(1)
            assert (e * b + f * d).contains(0)
            assert (g * a + h * c).contains(0)
            assert (g * b + h * d).contains(1)


def test_an_ordinary_point_has_the_basis_of_initial_values() -> None:
    both = [
        evaluate("x", 3, x0=1, frobenius=(2, -5), digits=20),
        evaluate("x", 3, x0=1, y0=2, dy0=-5, digits=20),
    ]
    assert both[0].overlaps(both[1])


@pytest.mark.parametrize(("side", "turn"), [("above", 1), ("below", -1)])
def test_a_singular_point_is_passed_on_the_side_asked_for(side: Any, turn: int) -> None:
    """(x - 1)^(1/3) is multiplied by exp(i pi/3) on the way around 1, from right to left through the upper half-plane."""
    value = evaluate("-2/(9*(x-1)^2)", [-1, 3, 0], x0=2, y0=1, dy0=Fraction(1, 3), path=side, digits=25)
    with ctx.workprec(200):
        root = acb(1) / 3
        for x, v in zip((-1, 3, 0), value, strict=True):
            factor = (root * turn).exp_pi_i() if x < 1 else acb(1)
            assert ball_to_flint(v).overlaps(factor * acb(abs(x - 1)) ** root)
            assert v.digits >= 25


def test_wrong_starts_are_refused() -> None:
    for arguments, words in [
        ({"x0": 0, "which": "regular"}, "irregular"),
        ({"x0": 1}, "one start"),
        ({"x0": 1, "y0": 1}, "both y0 and dy0"),
        ({"x0": 1, "y0": 1, "dy0": 0, "frobenius": (1, 0)}, "one start"),
        ({"x0": 1, "frobenius": (1, 0, 0)}, "two coordinates"),
        ({"x0": 1, "which": "smallest"}, "isn't known"),
    ]:
        with pytest.raises(InputError, match=words):
            evaluate("1/x^3", 2, **arguments)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="smaller than all others"):  # exponents 1/2 +- i
        evaluate("-5/(4*x^2) + 1", 1, x0=0, which="regular")
    with pytest.raises(InputError, match="infinite at the singular point 0"):
        evaluate(bessel("1/3"), 0, x0=0, which="regular")


def test_many_points_from_a_singular_point_agree_with_single_ones() -> None:
    points = [Fraction(k, 7) for k in (1, 2, 3, 30, -2, 70, 71)]
    together = evaluate(bessel("1/3"), points, x0=0, frobenius=(1, 2), digits=20)
    for x, value in zip(points, together, strict=True):
        alone = evaluate(bessel("1/3"), x, x0=0, frobenius=(1, 2), digits=30)
        assert value.digits >= 20
        assert value.overlaps(alone)


def test_a_solution_of_the_package_starts_at_its_singular_point() -> None:
    answer = kovacic.solve(bessel("1/2"))
    with ctx.workprec(200):
        assert ball_to_flint(answer.at(3, x0=0, which="regular", digits=25)).overlaps(acb(3).sin() / acb(3).sqrt())
    assert isinstance(answer.at(3, x0=0, which="regular"), Ball)


@parametrize("x", [2, -3, Fraction(1, 3), 30, 1 + 1j], ordinary=1, long=2)
@pytest.mark.parametrize("digits", [10, 40])
def test_decaying_solutions(x: Any, digits: int) -> None:
    """Ai, K_nu, the complementary error function, and Whittaker's W: each over its value at 1."""

    def whittaker(z: acb) -> acb:
        k, m = acb(1) / 3, acb(1) / 7
        return (-z / 2).exp() * z ** (m + acb(1) / 2) * z.hypgeom_u(m - k + acb(1) / 2, 1 + 2 * m)

    functions: list[tuple[str, Value]] = [
        ("x", lambda z: z.airy_ai()),
        ("y'' - 2*x*y' - 2*y = 0", lambda z: (z * z).exp() * z.erfc()),
        ("x^2*y'' + x*y' - (x^2 + 1/9)*y = 0", lambda z: z.bessel_k(acb(1) / 3)),
        ("1/4 - 1/(3*x) + (1/49 - 1/4)/x^2", whittaker),
    ]
    for equation, function in functions if x != -3 else functions[:2]:
        value = evaluate(equation, x, x0=1, y0=1, which="decaying", digits=digits)
        with ctx.workprec(int(digits * 3.33) + 300):
            assert ball_to_flint(value).overlaps(function(number(x)) / function(acb(1)))
        assert value.digits >= digits


def test_there_is_no_decaying_solution_where_solutions_oscillate() -> None:
    for equation in ("-1", "-x", "2/x^2", "0"):
        with pytest.raises(InputError, match="no solution decays"):
            evaluate(equation, 2, x0=1, y0=1, which="decaying")
    with pytest.raises(InputError, match="y0 alone"):
        evaluate("x", 2, x0=1, y0=1, dy0=0, which="decaying")
    with pytest.raises(InputError, match="singular point 1"):
        evaluate("1 + 1/(x-1)^2", 0, x0=0, y0=1, which="decaying")


def test_parameters_take_values() -> None:
    whittaker = "1/4 - k/x + (mu^2 - 1/4)/x^2"
    with_values = evaluate(whittaker, 3, x0=0, which="regular", params={"k": "1/3", "mu": Fraction(2, 7)}, digits=30)
    assert with_values == evaluate("1/4 - (1/3)/x + (4/49 - 1/4)/x^2", 3, x0=0, which="regular", digits=30)
    legendre = "(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0"
    for n in (3, Fraction(5, 2)):
        value = evaluate(legendre, Fraction(1, 3), x0=1, which="regular", params={"n": n}, digits=30)
        with ctx.workprec(200):
            assert ball_to_flint(value).overlaps((acb(1) / 3).legendre_p(number(n)))
        assert kovacic.solve(legendre).at(Fraction(1, 3), x0=1, which="regular", params={"n": n}, digits=30) == value
    assert len(kovacic.monodromy("n*(n+1)/(x^2*(1-x)^2)", params={"n": 2})) == 2
    for params, words in [
        ({}, "values are needed"),
        ({"n": 1, "m": 2}, "values are needed"),
        ({"n": 1j}, "regular point"),
        (None, "are needed"),
    ]:
        with pytest.raises(InputError, match=words):
            evaluate(legendre, 0, x0=1, which="regular", params=params)
    with pytest.raises(InputError, match="isn't defined"):
        evaluate("1/((n-1)*x^2 + (n-1))", 1, x0=0, y0=1, dy0=0, params={"n": 1})
    with pytest.raises(InputError, match="no parameter"):
        evaluate("x", 1, x0=0, y0=1, dy0=0, params={"n": 1})


def test_the_start_itself_may_be_asked_for() -> None:
    """J_n and its slope at 0, where n = 0, 1, 2, 3; (x + log x x^2 ...) has a slope, log x hasn't a value."""
    for n, (y, dy) in enumerate([(1, 0), (0, 1), (0, 0), (0, 0)]):
        value, slope = evaluate(bessel(n), [0, 1, -1, 0], x0=0, which="regular", derivative=True)[0]
        assert value.contains(y)
        assert slope.contains(dy)
        assert value.is_exact()
    kummer = "x*y'' + (2-x)*y' - 1/3*y = 0"
    value, slope = evaluate(kummer, 0, x0=0, which="regular", derivative=True)
    assert value.contains(1)
    assert slope.contains(Fraction(1, 6))
    for start in ((1, 0), (1, 1)):
        with pytest.raises(InputError, match="infinite"):
            evaluate(bessel(0), 0, x0=0, frobenius=start)
    with pytest.raises(InputError, match="infinite"):  # exponents 0 and 1 with a logarithm: y is finite, y' isn't
        evaluate("x*y'' + y = 0", 0, x0=0, frobenius=(1, 0))


@pytest.mark.parametrize("centre", ["0", "1 + 2*I", "sqrt(2)"])
def test_logarithms_at_centres_of_every_kind(centre: str) -> None:
    """b = 2: exponents -1 and 2.  Few digits and many agree."""
    minimal, b = {"0": ("x", 2), "1 + 2*I": ("x^2 - 2*x + 5", -32), "sqrt(2)": ("x^2 - 2", 16)}[centre]
    equation = f"({b} + ({minimal})^3)/({minimal})^2"
    coarse, fine = (evaluate(equation, "3/2", x0=centre, frobenius=(1, 0), digits=digits) for digits in (10, 90))
    assert coarse.overlaps(fine)
    assert fine.digits >= 90


@pytest.mark.parametrize("nu", [1000, 10**6, Fraction(2_000_001, 2)])
def test_large_orders_take_few_terms(nu: int | Fraction) -> None:
    """J_nu(x) Gamma(nu + 1) (2/x)^nu = sum (-x^2/4)^k / (k! (nu + 1)_k), summed exactly as far as it matters."""
    value = evaluate(bessel(nu), 10, x0=0, which="regular", digits=30)
    with ctx.workprec(4000):
        total = term = acb(1)
        for k in range(1, 40):
            term *= acb(-25) / (k * (number(Fraction(nu)) + k))
            total += term
        expected = total * acb(10) ** number(Fraction(nu)) + acb(arb(0, 1e-40)) * acb(10) ** number(Fraction(nu))
        assert ball_to_flint(value).overlaps(expected)
    assert value.digits >= 30


def test_arrays_of_no_dimension_are_numbers() -> None:
    numpy = pytest.importorskip("numpy")
    for x in (numpy.float64(2), numpy.array(2.0)):
        assert isinstance(evaluate(bessel(0), x, x0=0, which="regular"), Ball)
    assert evaluate(bessel(0), numpy.array([]), x0=0, which="regular").shape == (0,)


@pytest.mark.parametrize(
    ("side", "vertex"), [pytest.param("above", "1 + I", marks=pytest.mark.long), ("below", "1 - I")]
)
def test_from_infinity_around_a_singular_point(side: Any, vertex: str) -> None:
    gauss = "x*(1-x)*y'' + (5/4 - 11/6*x)*y' - 1/6*y = 0"
    start: dict[str, Any] = {"x0": "oo", "which": "regular"}
    around = evaluate(gauss, ["1/2", 3], path=side, **start)
    by_hand = evaluate(gauss, "1/2", path=[4, vertex], **start)
    assert around[0].overlaps(by_hand)
    assert around[0].digits >= 15
    assert around[1].overlaps(evaluate(gauss, 3, **start))
    other = evaluate(gauss, "1/2", path=[4, "1 - I" if side == "above" else "1 + I"], **start)
    assert not around[0].overlaps(other)


@pytest.mark.parametrize("equation", ["2/x^2", "-1 - 5/(36*x^2)", "x^2*y'' + x*y' + (x^2 - 1/9)*y = 0"])
@pytest.mark.parametrize("method", [None, "taylor"])
def test_a_path_that_stays_at_its_singular_start_is_refused(equation: str, method: Any) -> None:
    for x in (0, 1):
        with pytest.raises(InputError, match="doesn't leave the singular point 0"):
            evaluate(equation, x, x0=0, which="regular", path=[0], method=method)
