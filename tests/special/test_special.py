"""Special functions: generated pull-backs are found, and written solutions satisfy the equation to 30 digits."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from functools import partial
from itertools import permutations
from pathlib import Path
from random import Random
from typing import Any

import flint
import mpmath
import pytest
import sympy
from build import QQ, Budget, RatFunc, parametrize, read_input, run, size
from special_cases import KINDS, Case, pull_backs, standard
from transform import hypergeometric, pull_back

import kovacic
import kovacic.errors
from kovacic import Limits
from kovacic.numbers.numerals import as_latex
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.pullback import Pullback
from kovacic.special.search import EQUATIONS, find, special_functions
from kovacic.special.whittaker import Whittaker
from kovacic.special.writer import _SLOPES, Wanted, Writer

x = sympy.Symbol("x")
X = RatFunc(QQ.poly([0, 1]))
#: Off the real axis, far from the small rational singular points.
POINT = mpmath.mpc("0.31959", "0.14606")


def function(expression: Any, values: dict[str, Any]) -> Any:
    """A function of x for mpmath, which shares nothing with SymPy's rules for derivatives."""
    named = {symbol: values[symbol.name] for symbol in expression.free_symbols if symbol.name in values}
    expression = (
        expression.rewrite(sympy.besselj).rewrite(sympy.bessely) if expression.has(sympy.jn, sympy.yn) else expression
    )
    primes = {f"airy{k}prime": partial(getattr(mpmath, f"airy{k}"), derivative=1) for k in ("ai", "bi")}
    return sympy.lambdify(x, expression.xreplace(named), [primes, "mpmath"])


def solves(answer: Any, S: Any, gauge: Any = 0, **values: Any) -> bool:
    """y'' - 2 g y' + (g^2 - g' - S) y = 0 to 30 digits for both solutions, and are these independent?"""
    S, gauge = sympy.sympify(S), sympy.sympify(gauge)
    with mpmath.workdps(40):
        point = mpmath.mpmathify(POINT)
        first, zeroth = (function(e, values)(point) for e in (-2 * gauge, gauge**2 - gauge.diff(x) - S))
        jets = [mpmath.taylor(function(y, values), point, 2) for y in answer.solutions]
        for y, slope, half in jets:
            terms = (2 * half, first * slope, zeroth * y)
            if abs(sum(terms)) > mpmath.mpf(10) ** -30 * sum(map(abs, (y, slope, *terms))):
                return False
        (u, du, _), (v, dv, _) = jets
        return bool(abs(u * dv - du * v) > mpmath.mpf(10) ** -12 * (abs(u * dv) + abs(du * v)))


def special(S: RatFunc) -> Any:
    return special_functions(Wanted(S, S * 0, "x"), Budget())


@parametrize("kind", KINDS, ordinary=2)
def test_generated_pull_backs_are_found(kind: str) -> None:
    for case in pull_backs(4, kinds=(kind,), seed=7):
        found = find(case.S, Budget()).pullback
        assert found is not None, (case.f, case.S)
        # The identity, by the independent code of the tests.
        assert pull_back(found.equation.S, found.f) == case.S


@parametrize(
    "case",
    list(pull_backs(1, degrees=range(1, 4, 2), seed=11)),
    ordinary=1,
    long=1,
    ids=lambda case: f"{case.kind} {case.degree}",
)
def test_solutions_of_generated_pull_backs_are_right_to_30_digits(case: Case) -> None:
    assert solves(special(case.S), case.S)


#: Equations as they stand in the books, with what the solutions are there (DLMF and the sections on each function).
BOOKS = [
    ("y'' = x*y", "airyai(x)", "airybi(x)"),
    ("y'' = (2*x + 3)*y", "airyai(2**(1/3)*(x + 3/2))", "airybi(2**(1/3)*(x + 3/2))"),
    ("y'' + k*x*y = 0", "airyai(-k**(1/3)*x)", "airybi(-k**(1/3)*x)"),
    ("x^2*y'' + x*y' + (x^2 - n^2)*y = 0", "besselj(n, x)", "bessely(n, x)"),
    ("x^2*y'' + x*y' - (x^2 + n^2)*y = 0", "besseli(n, x)", "besselk(n, x)"),
    ("x^2*y'' + x*y' + (k^2*x^2 - 4)*y = 0", "besselj(2, k*x)", "bessely(2, k*x)"),
    ("x*y'' + y' + x*y = 0", "besselj(0, x)", "bessely(0, x)"),
    ("x*y'' + y = 0", "sqrt(x)*besselj(1, 2*sqrt(x))", "sqrt(x)*bessely(1, 2*sqrt(x))"),
    ("y'' + x^2*y = 0", "sqrt(x)*besselj(1/4, x**2/2)", "sqrt(x)*bessely(1/4, x**2/2)"),
    ("x^3*y'' + y = 0", "sqrt(x)*besselj(1, 2/sqrt(x))", "sqrt(x)*bessely(1, 2/sqrt(x))"),
    ("x*y'' + (b - x)*y' - a*y = 0", "hyper((a,), (b,), x)", "x**(1 - b)*hyper((a - b + 1,), (2 - b,), x)"),
    ("y'' - 2*x*y' + 2*n*y = 0", "hyper((-n/2,), (1/2,), x**2)", "x*hyper((1/2 - n/2,), (3/2,), x**2)"),
    ("x*(1-x)*y'' + (1-2*x)*y' - y/4 = 0", "elliptic_k(x)", "elliptic_k(1 - x)"),
    (
        "x*(1-x)*y'' + (c-(a+b+1)*x)*y' - a*b*y = 0",
        "hyper((a, b), (c,), x)",
        "x**(1 - c)*hyper((a - c + 1, b - c + 1), (2 - c,), x)",
    ),
    (
        "(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0",
        "hyper((-n/2, n/2 + 1/2), (1/2,), x**2)",
        "x*hyper((1/2 - n/2, n/2 + 1), (3/2,), x**2)",
    ),
]


@parametrize(("equation", "first", "second"), BOOKS, ordinary=1, long=2, ids=[row[0] for row in BOOKS])
def test_equations_of_the_books(equation: str, first: str, second: str) -> None:
    answer = kovacic.solve(equation)
    assert answer.status is kovacic.Status.NONE_EXISTS
    assert [str(y) for y in answer.special] == [first, second]
    values = {name: mpmath.mpf(k) / 7 for name, k in (("a", 2), ("b", 5), ("c", 3), ("k", 4), ("n", 9))}
    assert solves(answer.special, answer.S, answer.gauge, **values)


@pytest.mark.parametrize(("p", "q"), ["pq", pytest.param("b", "a", marks=pytest.mark.long)])
def test_neighbours_in_the_alphabet_are_letters_as_others(p: str, q: str) -> None:
    """The check took p = 1 + k/n and q = 1 + (k + 1)/n, where (p - 1)/(p - q), the third parameter, is an integer."""
    answer = kovacic.solve(f"(x-{p})*(x-{q})*y'' + (x-1)*y' + c*y = 0")
    assert str(answer.special.y1).startswith("hyper(")


CORPUS = [
    json.loads(line)
    for line in (Path(__file__).parents[1] / "data" / "special.jsonl").read_text(encoding="utf-8").splitlines()
]


PAIRS = [
    json.loads(line)
    for line in (Path(__file__).parents[1] / "data" / "pairs.jsonl").read_text(encoding="utf-8").splitlines()
]


def pair_of(row: dict[str, Any]) -> Any:
    """What is found for a row: of an equation or of S, with assumptions about letters, and with places to be real at."""
    parsed = read_input(row["equation"], var="x")
    gauge = parsed.S * 0 if parsed.equation is None else parsed.equation.gauge
    letters = {
        name: sympy.Symbol(name, **dict.fromkeys(words.split(), True)) for name, words in row.get("letters", {}).items()
    }
    places = [Fraction(place) for place in row.get("places", ())]
    return special_functions(Wanted(parsed.S, gauge, "x", letters, "joined" in row, places), Budget())


@pytest.mark.parametrize("row", PAIRS, ids=lambda row: row["equation"][:60])
def test_pairs_are_written_as_in_the_table(row: dict[str, Any]) -> None:
    """f; y1 and y2, their Wronskian, the numbers that mustn't vanish, and where both are real; m, a, b of a gauge transform.

    The next test shows that what stands in the table is right.
    """
    found = pair_of(row)
    y1, y2, W, undefined, place = row["pair"]
    assert str(found.pullback.f) == row["f"]
    assert [str(y) for y in found] == [y1, y2]
    assert (str(found.pair.wronskian), ", ".join(map(str, found.pair.undefined))) == (W, undefined)
    assert str(found.pair.place) == place
    given = found.transform and [str(part) for part in (found.transform.m, found.transform.a, found.transform.b)]
    assert given == row.get("transform")


@pytest.mark.long
@pytest.mark.parametrize("part", range(6))
def test_pairs_of_the_table_have_the_wronskian_that_stands_there(part: int) -> None:
    """By mpmath's numbers, at a point off the axis; that both are solutions is checked by all that is returned."""
    values = {name: mpmath.mpf(k) / 7 for name, k in zip("abcklpq", (2, 6, 3, 10, 4, -9, 16), strict=True)}
    for row in PAIRS[part::6]:
        pair = pair_of(row).pair
        if pair.wronskian is not None:
            with mpmath.workdps(25):
                first, second = (mpmath.taylor(function(y, {**values, "n": 4, "m": 2}), POINT, 1) for y in pair)
                stated = function(pair.wronskian, {**values, "n": 4, "m": 2})(POINT)
                assert abs(first[0] * second[1] - first[1] * second[0] - stated) < 1e-14 * abs(stated), row


@pytest.mark.long
@pytest.mark.parametrize("part", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, 10))])
def test_what_other_systems_solve(part: int) -> None:
    """The equations of SymPy's tests (Airy, Bessel, 2F1) and of Maxima's (odelin, Kamke) without Liouvillian solutions.

    Solutions are checked in ball arithmetic before they are returned.
    """
    for row in CORPUS[part::10]:
        parsed = read_input(row["equation"], var="x")
        assert parsed.equation is not None
        found = special_functions(Wanted(parsed.S, parsed.equation.gauge, "x"), Budget())
        assert bool(found) is ("other" not in row), row


@parametrize("kind", KINDS, ordinary=(0, 2, 3, 4, 5, 6))
def test_what_is_shown_is_checked(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A wrong power before the function, or a wrong parameter in it, is noticed."""
    case = next(pull_backs(1, kinds=(kind,), degrees=range(2, 3), seed=3))
    right = Writer.factor
    monkeypatch.setattr(Writer, "factor", lambda writer, f, *rest: right(writer, f * X, *rest))
    with pytest.raises(kovacic.errors.VerificationFailed):
        special(case.S)
    monkeypatch.setattr(Writer, "factor", right)
    assert special(case.S)
    if kind != "Airy":
        wrong = Writer.square_root
        monkeypatch.setattr(Writer, "square_root", lambda writer, square: wrong(writer, square) * 2)
        with pytest.raises(kovacic.errors.VerificationFailed):
            special(case.S)


def test_constants_of_quadratic_fields() -> None:
    for equation in (
        "y'' = (x^2/3 - 1)*y",
        "y'' = (sqrt(2)*x + 1)*y",
        "x^2*y'' + x*y' + (x^2 - 2)*y = 0",
    ):
        answer = kovacic.solve(equation)
        assert solves(answer.special, answer.S, answer.gauge), equation


@pytest.mark.long
def test_equations_outside_of_the_classes() -> None:
    for S in ("x^3 + x^2", "x^4 + x^2 + x", "1/x + 1/(x - 1) + 3", "x + 1/x", "1/x^3 + x^3"):
        answer = kovacic.solve(S)
        assert answer.status is kovacic.Status.NONE_EXISTS
        assert not answer.special
        assert answer.special.solutions == ()
        assert "searched" in str(answer.special)
        assert "Whittaker" in str(answer.special)
    assert not kovacic.solve(
        "y'' + (A*x^2 + B*x + C)/((x-a)*(x-b)*(x-c))*y' + (D*x + E)/((x-a)*(x-b)*(x-c))*y = 0"
    ).special
    heun = kovacic.solve("5/(7*x^2) + 3/(11*(x-1)^2) + 2/(x-3)^2 + 1/(x*(x-1)*(x-3))")
    assert not heun.special
    assert "Gauss" in str(heun.special)


@pytest.mark.long
def test_parameters_and_the_imaginary_unit() -> None:
    """SymPy's own constructor of hyper does not terminate here without evaluation."""
    answer = kovacic.solve("x*y'' + y' + (x + a)*y = 0")
    assert solves(answer.special, answer.S, answer.gauge, a=mpmath.mpf(2) / 7)
    assert answer.special.y1.args[1] == sympy.hyper(((1 + sympy.I * sympy.Symbol("a")) / 2,), (1,), 2 * sympy.I * x)


def test_a_search_for_a_pull_back_costs_no_more_than_the_way() -> None:
    S = kovacic.solve("(x+1)/((x^2+2)*(x^2+3)*(x^2+x+5))^2").S
    assert find(S, Budget(), extended=False, work=100).pullback is None


def test_an_exhausted_budget_is_a_value() -> None:
    search = find(next(pull_backs(1, kinds=("Gauss",))).S, Budget(Limits(seconds=0)))
    assert search.pullback is None
    assert "time limit" in str(search.stopped)


@pytest.mark.long
def test_many_equal_singular_points_are_a_limit() -> None:
    points = [RatFunc(QQ.poly([-k, 1])) for k in range(10)]
    S = sum(((k + 1) / p - (k + 1) / (p - 1) - Fraction(21, 100) / (p * p) for k, p in enumerate(points[:-1])), X * 0)
    search = find(S, Budget())
    assert search.pullback is None
    assert "units of work" in str(search.stopped)


@pytest.mark.long
@pytest.mark.parametrize(
    ("poles", "at_one", "at_infinity"),
    [((2, 2, 1, 1, 1, 1), Fraction(1, 3), Fraction(2, 7)), ((3, 2, 1, 1, 1, 0), Fraction(2, 7), Fraction(1, 3))],
    ids=["apart from apparent points", "among apparent points"],
)
def test_fibres_are_made_without_apparent_points_and_with_them(
    poles: tuple[int, ...], at_one: Fraction, at_infinity: Fraction
) -> None:
    """With the difference 1/2 at 0, the fourfold zeros 0 and 2 of f are apparent singularities."""
    f = (X * (X - 2)) ** 4
    for pole, multiplicity in zip((1, -1, 3, -3, 4, -4), poles, strict=True):
        f = f / (X - pole) ** multiplicity
    S = pull_back(hypergeometric(Fraction(1, 2), at_one, at_infinity), f)
    found = find(S, Budget()).pullback
    assert found is not None
    assert pull_back(found.equation.S, found.f) == S


def test_many_conjugate_poles_are_a_limit() -> None:
    S = pull_back(standard("Whittaker", Random(1)), 1 / (X**30 + X + 3))
    search = find(S, Budget())
    assert search.pullback is None
    assert "30 conjugate poles" in str(search.stopped)


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_returned_that_does_not_satisfy_the_identity(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every candidate is spoiled: by a parameter, or in f."""
    case = next(pull_backs(1, kinds=(kind,), degrees=range(3, 4), seed=5))
    found = find(case.S, Budget()).pullback
    assert found is not None
    one = QQ.poly([1])
    for spoiled in (
        Pullback(found.equation, found.f + X),
        Pullback(found.equation, found.f * found.f),
        Pullback(found.equation, RatFunc(one)),
        Pullback(Airy(one * 7), found.f),
        Pullback(Whittaker(one, one, one * 5), found.f),
        Pullback(Gauss(one * 2, one * 3, one * 5), found.f),
    ):
        for equation in EQUATIONS:
            monkeypatch.setattr(equation, "candidates", lambda problem, spoiled=spoiled, **_: iter([spoiled]))
        assert find(case.S, Budget()).pullback is None


def test_dsolve_uses_them() -> None:
    y, t = sympy.Function("y"), sympy.Symbol("t")
    n = sympy.Symbol("n", real=True)
    solution = kovacic.dsolve(t**2 * y(t).diff(t, 2) + t * y(t).diff(t) + (t**2 - n**2) * y(t), y(t))
    C1, C2 = sympy.symbols("C1 C2")
    assert solution.rhs == C1 * sympy.besselj(n, t) + C2 * sympy.bessely(n, t)
    start = kovacic.dsolve("y'' = x*y", ics={"y(0)": 1, "y'(0)": 0}).rhs
    assert abs(start.subs(x, 0).evalf(30) - 1) < 1e-28
    assert size(start.diff(x).subs(x, 0), 30) < 1e-28
    with pytest.raises(NotImplementedError, match=r"SL2.*searched"):
        kovacic.dsolve("y'' = (x^3 + x^2)*y")


n, m = (sympy.Symbol(name, integer=True, nonnegative=True) for name in "nm")
#: Equations with their polynomials of symbolic degree (DLMF 18.8, 10.47, 33.2).
POLYNOMIALS = [
    ("y'' - 2*x*y' + 2*n*y = 0", "hermite(n, x)"),
    ("y'' + (2*n + 1 - x^2)*y = 0", "exp(-x**2/2)*hermite(n, x)"),
    ("y'' + 2*x*y' - 2*n*y = 0", "hermite(n, I*x)"),
    ("x*y'' + (1 - x)*y' + n*y = 0", "laguerre(n, x)"),
    ("x*y'' + (a + 1 - x)*y' + n*y = 0", "assoc_laguerre(n, a, x)"),
    ("x*y'' + (m + 1 - x)*y' + n*y = 0", "assoc_laguerre(n, m, x)"),
    ("y'' + (-1/4 + (n + m + 1)/x - m*(m + 1)/x^2)*y = 0", "x**(m + 1)*exp(-x/2)*assoc_laguerre(n, 2*m + 1, x)"),
    ("(1-x^2)*y'' - 2*x*y' + n*(n + 1)*y = 0", "legendre(n, x)"),
    ("(1-x^2)*y'' - (2*a + 1)*x*y' + n*(n + 2*a)*y = 0", "gegenbauer(n, a, x)"),
    ("(1-x^2)*y'' + (b - a - (a + b + 2)*x)*y' + n*(n + a + b + 1)*y = 0", "jacobi(n, a, b, x)"),
    ("(1-x^2)*y'' + (b - m - (m + b + 2)*x)*y' + n*(n + m + b + 1)*y = 0", "jacobi(n, m, b, x)"),
    ("x^2*y'' + 2*x*y' + (x^2 - n*(n + 1))*y = 0", "jn(n, x)"),
    ("x^2*y'' + x*y' + (x^2 - (n + 1/2)^2)*y = 0", "sqrt(x)*jn(n, x)"),
]


@parametrize(("equation", "first"), POLYNOMIALS, ids=[row[0] for row in POLYNOMIALS], ordinary=0, long=(0, 5, 8, 11))
def test_polynomials_of_symbolic_degree(equation: str, first: str) -> None:
    answer = kovacic.solve(equation)
    symbols = {"n": n, "m": m}
    found = special_functions(Wanted(answer.S, answer.gauge, "x", symbols), Budget())
    assert str(found.y1) == first
    assert {n, m} >= found.y2.free_symbols - {x} - set(sympy.symbols("a b"))
    for degree in (0, 3):
        assert solves(found, answer.S, answer.gauge, n=degree, m=1, a=mpmath.mpf(2) / 7, b=mpmath.mpf(3) / 11), degree


@parametrize(
    "equation",
    [
        "(1-x^2)*y'' - 2*x*y' + n*(n + 1)*y = 0",
        "x*y'' + (1 - x)*y' + n*y = 0",
        "y'' - 2*x*y' + 2*n*y = 0",
        "x*y'' + (m + 1 - x)*y' + n*y = 0",
        "(1-x^2)*y'' - 2*x*y' + (n*(n + 1) - m^2/(1 - x^2))*y = 0",
    ],
    ordinary=0,
    long=1,
)
def test_solutions_stay_independent_for_integers_of_either_sign(equation: str) -> None:
    answer = kovacic.solve(equation)
    symbols = {name: sympy.Symbol(name, integer=True) for name in "nm"}
    found = special_functions(Wanted(answer.S, answer.gauge, "x", symbols), Budget())
    for degree in (-3, 2):
        assert solves(found, answer.S, answer.gauge, n=degree, m=-2), degree


def test_dsolve_gives_polynomials_where_the_degree_is_a_natural_number() -> None:
    y, t = sympy.Function("y"), sympy.Symbol("t")
    hermite = kovacic.dsolve(y(t).diff(t, 2) - 2 * t * y(t).diff(t) + 2 * n * y(t), y(t)).rhs
    assert hermite.coeff(sympy.Symbol("C1")) == sympy.hermite(n, t)


@pytest.mark.parametrize(
    "pullback",
    [
        Pullback(Bessel(*map(QQ.poly, ([], [1], [Fraction(-2, 9)]))), X**2 - X),  # a pole whose order is even
        Pullback(Whittaker(*map(QQ.poly, ([1], [], [Fraction(-2, 9)]))), X + 1 / X),  # both signs of the polar parts
        Pullback(Whittaker(*map(QQ.poly, ([1], [], [Fraction(-2, 9)]))), X - 1 / X),
        Pullback(Whittaker(*map(QQ.poly, ([2], [1], [Fraction(-2, 9)]))), X / (X**2 + 1)),  # 2 is no square
    ],
    ids=str,
)
def test_pull_backs_of_special_kinds(pullback: Pullback) -> None:
    S = pullback.S
    found = find(S, Budget()).pullback
    assert found is not None
    assert pull_back(found.equation.S, found.f) == S


def test_powers_of_high_degree() -> None:
    standard = hypergeometric(Fraction(1, 7), Fraction(2, 5), Fraction(1, 11))
    for f in (X**20, 1 / (X**9 + 3), (X**9 + 2) / (X**9 - 1)):
        assert find(pull_back(standard, f), Budget()).pullback is not None


ENCLOSED = [
    ("y'' = x*y", 0, 2),
    ("x^2*y'' + x*y' + (x^2 - 1/9)*y = 0", 1, 3),
    ("y'' = (x^2 + 1/3)*y", 0, 1),
    ("x*y'' + y' - (x + 2/7)*y = 0", 1, 2),
]


@parametrize(("equation", "x0", "x1"), ENCLOSED, ordinary=2)
def test_values_agree_with_proven_enclosures(equation: str, x0: int, x1: int) -> None:
    """Two routes: the functions by mpmath, and the Taylor series of the equation with proven error bounds."""
    answer = kovacic.solve(equation)
    for y in answer.special:
        with mpmath.workdps(40):
            u = sympy.lambdify(x, y, "mpmath")
            (start, slope), end = mpmath.taylor(u, x0, 1), u(x1)
            y0, dy0 = (Fraction(str(v.real)) for v in (start, slope))
            ball = answer.at(x1, x0=x0, y0=y0, dy0=dy0, digits=25)
            assert abs(ball.to_mpmath() - end.real) < mpmath.mpf(10) ** -20 * (1 + abs(end))


@parametrize(
    "left",
    [
        "y'' - (2*x + 3)*y",
        "x^2*y'' + x*y' + (x^2 - 1/9)*y",
        "x^3*y'' + y",
        "y'' - x^2*y",
        "y'' + 3*y' - (x/7)*y",
    ],
    ordinary=1,
    long=1,
)
def test_wronskians(left: str) -> None:
    """Variation of parameters divides by the Wronskian, a formula without the functions; the answer solves the equation."""
    found = kovacic.dsolve(f"{left} = 1/(x + 2)").rhs
    integrals = sorted(found.atoms(sympy.Integral), key=str)
    assert len(integrals) == 2
    names = {integral: sympy.Function(f"I{k}")(x) for k, integral in enumerate(integrals)}
    values: dict[Any, Any] = {"C1": 2, "C2": 5}
    for integral, name in names.items():
        below = sympy.denom(sympy.together(integral.function))
        assert not below.has(sympy.besselj, sympy.besseli, sympy.bessely, sympy.besselk, sympy.airyai, sympy.airybi)
        values |= {name.diff(x, k + 1): integral.function.diff(x, k) for k in (0, 1)} | {name: len(str(name)) + 3}
    named = found.xreplace(names)
    y, dy, d2y = (named.diff(x, k).subs(values).subs(x, sympy.Rational(7, 5)).evalf(30) for k in range(3))
    text = left.replace("y''", f"({d2y})").replace("y'", f"({dy})").replace("y", f"({y})").replace("x", "(7/5)")
    assert abs(sympy.sympify(text.replace("^", "**"), rational=True) - sympy.Rational(5, 17)) < 1e-20, (y, dy, d2y)


def test_initial_values_have_no_wronskian_of_values_below() -> None:
    solution = kovacic.dsolve("x*y'' + y' + x*y = 0", ics={"y(1)": 1, "y'(1)": 0}).rhs
    J, Y = sympy.besselj, sympy.bessely
    assert sympy.expand(solution - sympy.pi / 2 * (J(1, 1) * Y(0, x) - Y(1, 1) * J(0, x))) == 0
    turned = kovacic.dsolve("x*y'' + y' + x*y = 0", ics={"y'(1)": 0, "y(1)": 1}).rhs
    assert turned == solution
    airy = kovacic.dsolve("y'' - x*y = 1").rhs
    without_constants = {integral.function.as_independent(x)[1] for integral in airy.atoms(sympy.Integral)}
    assert without_constants == {sympy.airyai(x), sympy.airybi(x)}


def test_views_show_them() -> None:
    answer = kovacic.solve("y'' = x*y")
    assert "Ai" in answer._repr_latex_()
    assert "<mi>A</mi><mi>i</mi>" in answer._repr_html_()
    assert "Ai" in answer.explain(format="latex")


@pytest.mark.long
def test_every_view_has_the_short_form_instead_of_a_long_one(capsys: pytest.CaptureFixture[str]) -> None:
    """Hermite's polynomial of degree 60: `solve`, `explain`, LaTeX, JSON, and `dsolve` with values and right-hand sides too."""
    long = kovacic.solve("x^2 - 121")
    first = "y1 = exp(-x^2/2)*hyper((-30,), (1/2,), x^2)"
    assert run(["solve", "x^2 - 121"]) == 0
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert first in lines
    assert first in long.explain()
    assert as_latex(long.solutions[0]) in long._repr_latex_()
    assert [str(y) for y in long.solutions] == json.loads(long.to_json(full=True))["solutions"]
    even, odd = "exp(-x^2/2)*hyper((-30,), (1/2,), x^2)", "x*exp(-x^2/2)*hyper((-59/2,), (3/2,), x^2)"
    for arguments, solution in {
        ("y'' = (x^2 - 121)*y",): "(C1*hyper((-30,), (1/2,), x^2) + C2*x*hyper((-59/2,), (3/2,), x^2))*exp(-x^2/2)",
        ("y'' = (x^2 - 121)*y", "--ics", "y(0)=0, y'(0)=1"): odd,
        ("y'' = (x^2 - 121)*y", "--ics", "y(0)=2, y'(0)=0"): f"2*{even}",
    }.items():
        assert run(["dsolve", *arguments]) == 0
        printed = re.sub(r"\n +", "\n", capsys.readouterr().out)
        assert printed.startswith(f"y(x) = {solution}\n")


@parametrize("name", ["hermite", "legendre", "laguerre"], ordinary=1)
def test_assumptions_are_used(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Given as words or by the symbol: the same answer, in plain symbols; no polynomials for integers that may be negative."""
    equation = {
        "hermite": "y'' - 2*x*y' + 2*n*y = 0",
        "legendre": "(1 - x^2)*y'' - 2*x*y' + n*(n + 1)*y = 0",
        "laguerre": "x*y'' + (1 - x)*y' + n*y = 0",
    }[name]
    answer = kovacic.solve(equation, assume={"n": "nonnegative integer"})
    assert answer.special.y1 == getattr(sympy, name)(sympy.Symbol("n"), x)
    assert run(["solve", "--assume", "n=nonnegative integer", equation]) == 0
    assert f"  y1 = {name}(n, x)\n" in capsys.readouterr().out
    assert not kovacic.solve(equation, assume={"n": "integer"}).special.y1.has(getattr(sympy, name))


def test_assumptions_of_a_symbol_are_used() -> None:
    y, natural = sympy.Function("y")(x), sympy.Symbol("n", integer=True, nonnegative=True)
    by_symbol = kovacic.solve(y.diff(x, 2) - 2 * x * y.diff(x) + 2 * natural * y)
    assert by_symbol.special.y1 == sympy.hermite(sympy.Symbol("n"), x)


def test_assumptions_that_exclude_each_other() -> None:
    with pytest.raises(kovacic.errors.InputError, match="contradict"):
        kovacic.solve("y'' - 2*x*y' + 2*n*y = 0", assume={"n": "positive negative"})


@parametrize(
    ("text", "names"),
    [
        ("x*(1-x)*y'' + (1-2*x)*y' - y/4 = 0", ("elliptic_k(x)", "elliptic_k(1 - x)")),
        ("x*(1-x)*y'' + (1-x)*y' + y/4 = 0", ("elliptic_e(x)", None)),
        ("(1-x^2)*y'' - 2*x*y' + 3/4*y = 0", ("legendre(1/2, x)", "legendre(1/2, -x)")),
        ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", ("hyper((-n/2, n/2 + 1/2), (1/2,), x**2)", None)),
    ],
    ordinary=1,
)
def test_names_of_gauss_functions(text: str, names: tuple[str, str | None]) -> None:
    """DLMF 19.4.8 (K), 19.4.9 (E), 14.2.1; substituted by mpmath's numbers."""
    found = kovacic.solve(text, var="x").special
    assert all(name is None or str(y) == name for y, name in zip(found, names, strict=True))
    equation = read_input(text, var="x").equation
    assert equation is not None
    x, n = sympy.symbols("x n")
    a, b, c = (sympy.sympify(part.to_str("x")) for part in (equation.a, equation.b, equation.c))
    for y in found:
        left = (a * y.diff(x, 2) + b * y.diff(x) + c * y).subs({n: sympy.Rational(2, 7), x: sympy.Rational(3, 11)})
        assert size(left, 30) < 1e-20


# ------------------------------------------------------------------------------------------------ Mathieu's functions


@parametrize(
    ("coefficient", "damping", "expected"),
    [
        ("a - 2*q*cos(2*x)", "0", ("a", "q", "x")),
        ("a - 2*q*cosh(2*x)", "0", None),
        ("3 + sin(x)**2", "0", ("7/2", "1/4", "x")),
        ("l + g*sin(w*x)", "0", ("4*l/w**2", "-2*g/w**2", "w*x/2 - pi/4")),
        ("1 + cos(x + 1)", "0", ("4", "-2", "x/2 + 1/2")),
        ("1 + sin(x) + 2*cos(x)", "0", None),
        ("1 - sin(x) - 2*cos(x)", "0", None),
        ("1 + 2*sinh(x) + 3*cosh(x)", "0", None),
        ("1 + sinh(x)", "0", None),
        ("1 + cos(x)", "2", ("0", "-2", "x/2")),
        ("2 + cos(3*x)", "2*sin(3*x)", None),
    ],
    ordinary=1,
    long=(1, 3),
)
def test_mathieus_functions(coefficient: str, damping: str, expected: tuple[str, str, str] | None) -> None:
    """The equation itself, by SymPy's derivatives; and the parameters where they are known."""
    x, y = sympy.Symbol("x"), sympy.Function("y")
    b, c = sympy.sympify(damping), sympy.sympify(coefficient)
    if damping.startswith("2*sin"):  # y = u exp(-int b/2)
        c = c + b.diff(x) / 2 + b**2 / 4
    found = kovacic.dsolve(y(x).diff(x, 2) + b * y(x).diff(x) + c * y(x)).rhs
    functions = sorted(found.atoms(sympy.mathieuc, sympy.mathieus), key=str)
    assert [f.func for f in functions] == [sympy.mathieuc, sympy.mathieus]
    rest = sympy.expand(found.diff(x, 2) + b * found.diff(x) + c * found)
    names = {f: sympy.Dummy() for f in rest.atoms(*_MATHIEU)}
    rest = rest.xreplace(names)
    for point in (sympy.Rational(3, 7), sympy.Rational(-17, 10)):
        at = rest.subs({**dict(zip(sympy.symbols("a q l g w C1 C2"), (2, 3, 5, 7, 11, 13, 17), strict=True)), x: point})
        assert all(size(at.coeff(name), 30) < 1e-20 for name in names.values())
    if expected is not None:
        assert all(f.args == tuple(map(sympy.sympify, expected)) for f in functions)


_MATHIEU = (sympy.mathieuc, sympy.mathieucprime, sympy.mathieus, sympy.mathieusprime)


@parametrize("coefficient", ["1 + cos(x) + cos(2*x)", "1 + cos(x)^2 + sin(x)", "1/(2 + cos(x))"], ordinary=1)
def test_other_waves_are_not_mathieus(coefficient: str) -> None:
    with pytest.raises(NotImplementedError, match="no special function was found"):
        kovacic.dsolve(f"y'' + ({coefficient})*y = 0")


@pytest.mark.long
def test_a_long_answer_in_mathieus_functions_has_no_shorter_form(capsys: pytest.CaptureFixture[str]) -> None:
    """Formulas of more than a screen are looked for in other functions; these are such functions already."""
    assert run(["dsolve", "y'' = (2 + cos(x))*y + sin(3*x) + cos(5*x)"]) == 0
    printed = capsys.readouterr().out
    assert len(printed) > 600  # a screen
    assert "mathieu" in printed
    assert "horter, in special functions" not in printed


@parametrize(
    "coefficient", ["3 - 2*cosh(x)", "3 - 2*sin(x)", "3 - 2*cos(x + 1)"], ordinary=1, always=["3 - 2*cos(x + 1)"]
)
def test_values_of_mathieus_functions(coefficient: str) -> None:
    """Initial values, by the parity of the functions and their constant Wronskian alone; other numbers are arbitrary."""
    x = sympy.Symbol("x")
    found = kovacic.dsolve(f"y'' + ({coefficient})*y = 0", ics="y(0)=1, y'(0)=2").rhs
    a, q, z = next(f.args for f in found.atoms(sympy.mathieuc) if f.has(x))
    even, slope, odd, odd_slope = (f(a, q, sympy.Abs(z.subs(x, 0))) for f in _MATHIEU)
    at_zero = {sympy.mathieuc(a, q, 0): 3, sympy.mathieusprime(a, q, 0): 5}
    values = {even: 7, slope: 11, odd: 13, odd_slope: sympy.Rational(15 + 11 * 13, 7), **at_zero}
    if z.subs(x, 0) == 0:
        values = {even: 3, slope: 0, odd: 0, odd_slope: 5}
    assert [e.subs(x, 0).xreplace(values) for e in (found, found.diff(x))] == [1, 2]
    assert len(str(found)) < 300


@parametrize(
    "text",
    ["tan(x)", "2*tan(x)", "tan(x)/3", "tan(x)^2 + tan(x)", "cot(x)", "1/(x^2+1)^2 + x/(x^2+1)^2"],
    ids=str,
    ordinary=1,
    long=(1, 5),
)
def test_roots_in_complex_exponents_keep_their_branches(text: str) -> None:
    """Powers of x are made real between the singular points; sqrt(-i) in an exponent is no such power."""
    answer = kovacic.solve(f"y'' + ({text})*y = 0")
    assert answer.solutions or answer.special


def test_lowest_terms_where_the_heuristic_gcd_gives_up() -> None:
    """SymPy's `cancel` raises HeuristicGCDFailed on the coefficients of this gauge transform of Bessel's equation."""
    pair = kovacic.solve(
        "(x^6 + 154*x^4 + 56*x^3 + 7672*x^2 + 3136*x + 131712)/(x^6 + 112*x^4 + 3136*x^2)"
    ).special.pair
    assert pair is not None
    assert pair.y1.has(sympy.besseli)


@pytest.mark.parametrize(
    ("equation", "points"),
    [
        ("(x^3-x)*y'' + (3*x^2-1)*y' + x*y = 0", (0.3, 0.8)),
        ("(1-x^4)*y'' - 4*x^3*y' - 2*x^2*y = 0", (-0.7, 0.2, 3)),
        ("x^2*(x+1)*y'' - x*(x-5)*y' - 7*y = 0", (0.3, 2, 9)),
        ("x*(3+x)*y'' + (1/2+2*x)*y' + y/7 = 0", (0.3, 2, 9)),
    ],
)
def test_solutions_are_real_on_the_half_line_or_between_singular_points(
    equation: str, points: tuple[float, ...]
) -> None:
    for y in kovacic.solve(equation).special:
        assert all(abs(mpmath.im(function(y, {})(mpmath.mpf(point)))) < 1e-12 for point in points), y


def test_powers_with_irrational_exponents_are_real_between_the_singular_points() -> None:
    pair = kovacic.solve("4*x*(x-1)^2*y'' + 2*(3*x-1)*(x-1)*y' + (a*x+b)*y = 0", var="x").special
    assert all("(1 - x)**" in str(y) and "(x - 1)**" not in str(y) for y in pair)


@pytest.mark.parametrize("degree", [1, 6, 25])
@pytest.mark.parametrize("a", [0, 1, 4])
def test_laguerres_polynomials_are_polynomials_at_zero_too(degree: int, a: int) -> None:
    """x y'' + (a + 1 - x) y' + N y = 0, and a second solution with the Wronskian that is stated."""
    pair = kovacic.solve(f"x*y'' + ({a + 1} - x)*y' + {degree}*y = 0").special.pair
    assert pair is not None
    assert pair.y1 == sympy.hyper((-degree,), (a + 1,), x)
    with mpmath.workdps(40):
        first, second = (mpmath.taylor(function(y, {}), POINT, 1) for y in pair)
        stated = function(pair.wronskian, {})(POINT)
        assert abs(first[0] * second[1] - first[1] * second[0] - stated) < 1e-20 * abs(stated)


def of(*constants: Fraction | int) -> list[Any]:
    return [QQ.poly([c]) if c else QQ.poly([]) for c in constants]


HALVES = Fraction(1, 4), Fraction(1, 9)
#: Standard equations, in all coordinates, and whether both solutions have the leading term 1 at 0, one or neither.
VALUES: list[tuple[Any, int, int]] = [
    *((Airy(*of(q)), 1, 0) for q in (3, Fraction(-2, 5))),
    *((Bessel(*of(0, r, M)), 2, 2) for r, M in ((3, Fraction(-2, 9)), (-5, Fraction(1, 7)))),
    *((Bessel(*of(0, r, M)), 2, 1) for r, M in ((3, 2), (-5, Fraction(3, 4)))),
    *((Whittaker(*of(q, 0, M)), 2, 2) for q, M in ((3, Fraction(-2, 9)), (-2, Fraction(1, 7)))),
    *((Whittaker(*of(q, 0, M)), 2, 1) for q, M in ((3, Fraction(3, 4)), (-2, Fraction(15, 4)))),
    *((Whittaker(*of(q, r, M)), 2, 2) for q, r, M in ((3, 2, Fraction(-2, 9)), (Fraction(1, 4), -5, Fraction(1, 7)))),
    *((Whittaker(*of(q, r, M)), 2, 1) for q, r, M in ((3, 2, Fraction(3, 4)), (Fraction(1, 4), Fraction(1, 3), 2))),
    (Gauss(*of(Fraction(1, 9), Fraction(4, 25), Fraction(9, 49))), 6, 2),
    (Gauss(*of(Fraction(1, 3), Fraction(4, 25), Fraction(2, 49))), 6, 2),
    (Gauss(*of(4, Fraction(4, 25), Fraction(9, 49))), 6, -1),
    (Gauss(*of(4, 9, Fraction(9, 49))), 6, -1),
    *((Gauss(*of(*squares)), 6, -1) for squares in permutations((*HALVES, Fraction(1, 4)))),
    (Gauss(*of(0, Fraction(1, 4), Fraction(1, 4))), 6, -1),
]


@pytest.mark.parametrize(("equation", "coordinates", "leading"), VALUES, ids=str)
def test_values_of_both_solutions_satisfy_the_equation(equation: Any, coordinates: int, leading: int) -> None:
    """f'^(-1/2) z^alpha (1 - z)^beta E for z = n/d, with E' by differences; and E = 1 at z = 0."""
    f = (3 * X + 1) / (X + 7)
    S = Pullback(equation, f).S
    with flint.ctx.workprec(180):
        x0, h = flint.acb("0.31", "0.47"), flint.acb(2) ** -45
        num, den = (flint.acb_poly(p.rep)(x0) for p in (S.num, S.den))
        for coordinate in range(coordinates):
            form = equation.form(f.num.rep, f.den.rep, coordinate)
            n, d = (flint.acb_poly(p) for p in (form.n, form.d))
            rows = []
            for x1 in (x0 - h, x0, x0 + h):
                z, slope = n(x1) / d(x1), (n.derivative() * d - d.derivative() * n)(x1) / d(x1) ** 2
                values = form.values(z, (True, True))
                powers = [z ** flint.acb(e) * (1 - z) ** flint.acb(e1) / slope.sqrt() for e, e1 in form.powers]
                rows.append([(power * E, E, dE * slope) for power, (E, dE) in zip(powers, values, strict=True)])
            pairs = []
            for (y0, E0, _), (y1, _, dE), (y2, E2, _) in zip(*rows, strict=True):
                assert abs((y2 - 2 * y1 + y0) / (h * h) * den - num * y1) < 1e-22 * abs(num * y1)
                assert abs((E2 - E0) / (2 * h) - dE) < 1e-22 * (1 + abs(dE))
                pairs.append((y1, (y2 - y0) / (2 * h)))
            (u, du), (v, dv) = pairs
            assert abs(u * dv - v * du) > 1e-8 * (abs(u * dv) + abs(v * du))
            assert form.independent
            if leading >= 0:
                ones = [abs(E - 1) < 1e-20 for E, _ in form.values(flint.acb(2) ** -200, (True, True))]
                assert ones == [leading > 0, leading > 1]


@pytest.mark.parametrize(
    "equation",
    [
        Whittaker(*of(Fraction(1, 4), Fraction(7, 2), Fraction(3, 4))),
        Gauss(*of(4, 9, 64)),
        Gauss(*of(4, 9, 144)),
    ],
    ids=str,
)
def test_both_solutions_may_be_the_same_polynomial(equation: Any) -> None:
    """1/2 + mu - kappa = -2; (1 + 2 + 3 - 8)/2 = -1, and (1 + 2 + 3 - 12)/2 = -3."""
    z = X.num.rep
    assert not equation.form(z, z * 0 + 1, 0).independent


def test_the_solution_with_the_smaller_exponent_alone_may_be_a_polynomial() -> None:
    """1/2 + mu - kappa = 1 and 1/2 - mu - kappa = -1."""
    z = X.num.rep
    equation = Whittaker(*of(Fraction(1, 4), Fraction(1, 2), Fraction(3, 4)))
    assert equation.form(z, z * 0 + 1, 0).independent


def transformed(S: str, *transform: str) -> tuple[str, tuple[Any, Any, Any]]:
    """The equation of a v + b v' for v'' = S v, and its coefficients: three vectors in v and v' are dependent."""
    T, a, b = (sympy.sympify(text.replace("^", "**")) for text in (S, *transform))
    rows = [(a, b)]
    for _ in range(2):
        u, v = rows[-1]
        rows.append((sympy.diff(u, x) + v * T, sympy.diff(v, x) + u))
    c2, c1, c0 = (sympy.cancel(rows[i][0] * rows[j][1] - rows[j][0] * rows[i][1]) for i, j in ((0, 1), (2, 0), (1, 2)))
    return f"({c2})*y'' + ({c1})*y' + ({c0})*y = 0".replace("**", "^"), (c2, c1, c0)


@pytest.mark.parametrize("S", ["exp(x)", "pi*x"])
def test_a_wronskian_in_other_letters_is_not_stated_as_that_of_the_pair(S: str) -> None:
    """In t = exp(x) it is -1/(2 t); the other is a power of a letter called pi."""
    pair = kovacic.solve(f"y'' = {S}*y").special.pair
    assert pair is not None
    assert pair.wronskian is None


@pytest.mark.parametrize(
    ("S", "transform", "exceptions"),
    [
        pytest.param("1/4 - 1/(3*x) + (n^2 - 1/4)/x^2", ("1", "x"), "0 1/2 -1/2 1", marks=pytest.mark.long),
        pytest.param("(n^2 - 1/4)/x^2 - 1", ("1", "x"), "", marks=pytest.mark.long),
        ("-2/9/x^2 - 3/(16*(x-1)^2) + (23/36 + n^2)/(4*x*(x-1))", ("1", "x*(x-1)"), ""),
    ],
)
def test_gauge_transforms_know_where_their_solutions_are_dependent(
    S: str, transform: tuple[str, str], exceptions: str
) -> None:
    """The Wronskian that is stated is that of the members; where it vanishes, or they have no value, `validity` says so."""
    n = sympy.Symbol("n")
    pair = kovacic.solve(transformed(S, *transform)[0], var="x").special.pair
    assert pair is not None
    general = {"n": mpmath.mpf(3) / 7}
    with mpmath.workdps(40):
        first, second = (mpmath.taylor(function(y, general), POINT, 1) for y in pair)
        stated = function(pair.wronskian, general)(POINT)
        assert abs(first[0] * second[1] - first[1] * second[0] - stated) < 1e-20 * abs(stated)
    for value in map(sympy.Rational, exceptions.split()):
        conditions = [*pair.undefined, pair.wronskian]
        assert any(sympy.simplify(condition.subs(n, value)) == 0 for condition in conditions), value
    said = str(kovacic.validity(kovacic.dsolve(transformed(S, *transform)[0], var="x")))
    assert ("!= 0" in said) == bool(exceptions)


@pytest.mark.long
@pytest.mark.parametrize(
    ("S", "transform", "longest"),
    [
        ("(n^2 - 1/4)/x^2 - 1", ("1", "x"), 60),
        ("(-8/9*x^2 + 8/9*x - 1)/(4*x^2*(x-1)^2)", ("1", "x*(x-1)"), 80),  # Legendre's
        ("-(x^2 - x + 1)/(4*x^2*(x-1)^2)", ("1", "x*(x-1)"), 70),  # K
    ],
)
def test_derivatives_of_named_functions_are_written_by_such(S: str, transform: tuple[str, str], longest: int) -> None:
    """y = a v + b v' in two functions, and without a factor that stands above and below."""
    equation, (c2, c1, c0) = transformed(S, *transform)
    answer = kovacic.solve(equation, var="x")
    assert answer.special
    for y in answer.special:
        assert len(str(y)) <= longest, y
        assert not y.has(sympy.Derivative)
        value = c2 * sympy.diff(y, x, 2) + c1 * sympy.diff(y, x) + c0 * y
        assert abs(function(value, {"n": mpmath.mpf(3) / 7})(POINT)) < 1e-8


def test_an_exponent_that_is_half_an_integer_and_a_letter() -> None:
    """x^(l + 1) and x^-l for the oscillator with l(l + 1)/x^2, functions of x^2: dependent where l + 1/2 is an integer."""
    pair = kovacic.solve("y'' = (x^2 + l*(l+1)/x^2 - E)*y", var="x").special.pair
    assert pair is not None
    assert pair.undefined == (sympy.sin(sympy.pi * (sympy.Symbol("l") + sympy.S.Half)),)


@parametrize("degree", [1, 5, 0], ordinary=0, long=(0, 2))
def test_an_exponent_that_may_be_an_integer_is_an_exception_or_known_to_be_one(degree: int) -> None:
    """x y'' + (l + 1 - x) y' + N y = 0: x^-l 1F1(-N - l; 1 - l; x) has no value for l = 1, 2, ..., and is the other at 0.

    The other one, 1F1(-N; 1 + l; x), has none for l = -1, -2, ..., unless it is the constant 1.
    """
    equation = f"x*y'' + (l + 1 - x)*y' + {degree}*y = 0"
    excluded = "sin(pi*l) != 0" if degree else "l is none of 0, 1, 2, ..."
    assert excluded in str(kovacic.validity(kovacic.dsolve(equation, var="x")))
    natural = sympy.Symbol("l", integer=True, nonnegative=True)
    y = sympy.Function("y")(x)
    left = x * y.diff(x, 2) + (natural + 1 - x) * y.diff(x) + degree * y
    general = kovacic.dsolve(sympy.Eq(left, 0)).rhs
    for value in (0, 1, 3):
        first, second = (
            function(general.subs(dict(zip(sympy.symbols("C1 C2"), pair, strict=True))).subs(natural, value), {})
            for pair in ((1, 0), (0, 1))
        )
        with mpmath.workdps(40):
            (u, du, _), (v, dv, _) = (mpmath.taylor(member, POINT, 2) for member in (first, second))
            assert abs(u * dv - du * v) > 1e-12 * (abs(u * dv) + abs(du * v))


@pytest.mark.parametrize("function", _SLOPES)
def test_slopes_of_functions(function: Any) -> None:
    """dF/dz = s F + t F1, against a difference quotient of F itself."""
    z = sympy.Symbol("z")
    letters = {sympy.hyper: [(sympy.Rational(2, 3), sympy.S(5) / 7), (sympy.Rational(3, 4),)]}
    single = [sympy.airyai, sympy.airybi, sympy.elliptic_k, sympy.elliptic_e]
    beside = letters.get(function, [] if function in single else [sympy.Rational(7, 3)])
    s, t, other = _SLOPES[function](*beside, z)
    F = function(*beside, z)
    at = {z: sympy.Rational(2, 7)}
    h = sympy.Rational(1, 10**12)
    quotient = (F.subs(z, at[z] + h).evalf(40) - F.subs(z, at[z] - h).evalf(40)) / (2 * h)
    assert abs(quotient - (s * F + t * other).subs(at).evalf(40)) < 1e-15
