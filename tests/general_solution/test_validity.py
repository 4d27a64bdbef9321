"""What a solution needs to be real and valid."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
import sympy
from build import parametrize, run
from sympy.abc import a, b, c, k, m, v, w, x  # the names in texts

import kovacic
from kovacic.general_solution.validity import needs_of

#: Powers and functions, with an integer n, and what they need to be real and finite.
NEEDS = [
    ("(2*x-3)**(-2)", "Ne(2*x - 3, 0)"),
    ("(2*x-3)**3", ""),
    ("sqrt(2*x-3)", "2*x - 3 >= 0"),
    ("(2*x-3)**(-5/2)", "2*x - 3 > 0"),
    ("(2*x-3)**a", "2*x - 3 > 0"),
    ("(x+I)**(-1/3)", "Ne(x + I, 0)"),
    ("sqrt(x+I)", ""),
    ("log(2*x-3)", "2*x - 3 > 0"),
    ("log(x+I)", "Ne(x + I, 0)"),
    ("asin(2*x-3)", "1 - (2*x - 3)**2 >= 0"),
    ("acos(x/4)", "1 - x**2/16 >= 0"),
    ("acosh(2*x-3)", "2*x - 4 >= 0"),
    ("tan(2*x-3)", "Ne(cos(2*x - 3), 0)"),
    ("sec(2*x-3)", "Ne(cos(2*x - 3), 0)"),
    ("cot(2*x-3)", "Ne(sin(2*x - 3), 0)"),
    ("csc(2*x-3)", "Ne(sin(2*x - 3), 0)"),
    ("coth(2*x-3)", "Ne(2*x - 3, 0)"),
    ("csch(x+I)", "Ne(x + I, 0)"),
    ("Ei(2*x-3)", "Ne(2*x - 3, 0)"),
    ("Ci(2*x-3)", "2*x - 3 > 0"),
    ("expint(a,2*x-3)", "2*x - 3 > 0"),
    ("uppergamma(a,2*x-3)", "2*x - 3 > 0"),
    ("lowergamma(a,2*x-3)", "2*x - 3 > 0"),
    ("polylog(a,2*x-3)", "4 - 2*x > 0"),
    ("atanh(2*x-3)", "1 - (2*x - 3)**2 > 0"),
    ("bessely(n,2*x-3)", "2*x - 3 > 0"),
    ("besselk(a,2*x-3)", "2*x - 3 > 0"),
    ("besselj(n,2*x-3)", ""),
    ("besselj(a,2*x-3)", "2*x - 3 > 0"),
    ("besseli(a,2*x-3)", "2*x - 3 > 0"),
    ("jn(n,2*x-3)", ""),
    ("jn(a,2*x-3)", "2*x - 3 > 0"),
    ("yn(n,2*x-3)", "Ne(2*x - 3, 0)"),
    ("yn(a,2*x-3)", "2*x - 3 > 0"),
    ("elliptic_k(2*x-3)", "4 - 2*x > 0"),
    ("elliptic_e(2*x-3)", "4 - 2*x > 0"),
    ("elliptic_f(x,2/7)", "1 - 2*sin(x)**2/7 > 0"),
    ("elliptic_e(x,2/7)", "1 - 2*sin(x)**2/7 > 0"),
    ("elliptic_pi(3/7,x,2/7)", "1 - 2*sin(x)**2/7 > 0; 1 - 3*sin(x)**2/7 > 0"),
    ("legendre(n,2*x-3)", ""),
    ("legendre(a,2*x-3)", "2*x - 2 > 0"),
    ("gegenbauer(a,b,2*x-3)", "2*x - 2 > 0"),
    ("jacobi(a,b,3/7,2*x-3)", "2*x - 2 > 0"),
    ("chebyshevt(a,2*x-3)", "2*x - 2 > 0"),
    ("chebyshevu(a,2*x-3)", "2*x - 2 > 0"),
    ("assoc_legendre(n,2,x)", ""),
    ("assoc_legendre(n,3,x)", "1 - x**2 > 0"),
    ("assoc_legendre(a,2,x)", "1 - x**2 > 0"),
    ("hyper((a,b),(3,),2*x-3)", "4 - 2*x > 0"),
    ("hyper((-2,b),(3,),2*x-3)", ""),
    ("hyper((a,),(b,),2*x-3)", "Ne(1/gamma(b), 0)"),
    ("hyper((a,b),(),2*x-3)", "3 - 2*x > 0"),
    ("hyper((a,1/3),(b,),2*x-3)", "4 - 2*x > 0; Ne(1/gamma(b), 0)"),
    ("hyper((a,-2),(),2*x-3)", ""),
    ("sin(x)/log(x)+tan(x)", "Ne(cos(x), 0); Ne(log(x), 0); x > 0"),
    ("exp(-1/x)", "Ne(x, 0)"),
    ("Integral(1/log(a),(a,2,x))", "Ne(log(x), 0); x > 0"),
    ("Integral(log(x),x)", "x > 0"),
    ("log(x)*a/(3*x**2-6)", "Ne(3*x**2 - 6, 0); x > 0"),
]


@pytest.mark.parametrize(("text", "needs"), NEEDS)
def test_needs_of_powers_and_functions(text: str, needs: str) -> None:
    e = sympy.sympify(text, {"n": sympy.Symbol("n", integer=True)}, rational=True)
    assert "; ".join(sorted(map(str, needs_of(e)))) == needs


@parametrize(
    ("equation", "real", "exceptions"),
    [
        ("y'' + w^2*y = cos(v*x)", [], {w, v - w, v + w}),
        ("y'' - 2*a*y' + a^2*y = exp(b*x)", [], {a - b}),
        ("x^2*y'' + x*y' - y = log(x)", [x > 0], set()),
        ("x^2*y'' + x*y' + (x^2 - 1/9)*y = 0", [x > 0], set()),
        ("(1-x^2)*y'' - x*y' + y = 0", [1 - x**2 >= 0], set()),
        ("y'' + y = x", [], set()),
    ],
    ordinary=2,
)
def test_what_is_needed(equation: str, real: list[object], exceptions: set[object]) -> None:
    found = kovacic.validity(kovacic.dsolve(equation))
    assert (list(found.real), set(found.exceptions)) == (real, exceptions)
    assert bool(found) is bool(real or exceptions)


@parametrize(
    ("equation", "claim"),
    [
        ("y'' + y = log(x)", "real and valid"),
        ("y'' + y = sqrt(2)/x", "real and valid"),
        ("y'' + I*y = log(x)", "valid"),
        ("y'' + (-1)^(1/3)*y = 1/x", "valid"),
        ("y'' = I/x", "valid"),
        ("y' = exp(x)*sin(x)^2/x", "valid"),
        ("y'' + acos(2)*y = 1/x", "valid"),
    ],
    ordinary=(0, 5),
    long=1,
)
def test_what_is_made_of_other_numbers_is_not_called_real(equation: str, claim: str) -> None:
    assert kovacic.validity(kovacic.dsolve(equation)).claim == claim


def test_the_oscillator() -> None:
    """Beyond m = 0, only critical damping, c^2 = 4 k m, is an exception, where the formula has one constant too few."""
    solution = kovacic.dsolve("m*y'' + c*y' + k*y = 0")
    found = kovacic.validity(solution)
    assert set(found.exceptions) == {m, c**2 - 4 * k * m}
    assert "m != 0" in str(found)
    critical = solution.rhs.subs(k, c**2 / (4 * m))
    assert sympy.simplify(critical.diff(x) / critical).free_symbols == {c, m}


def test_what_is_assumed_is_used() -> None:
    t, p = sympy.symbols("t p", positive=True)
    y = sympy.Function("y")(t)
    assert not kovacic.validity(kovacic.dsolve(t * y.diff(t, 2) + y.diff(t) + p**2 * t * y))
    with pytest.raises(kovacic.InputError):
        kovacic.validity(t)


#: Functions with a part that must be positive, or not negative, and the argument in which they are to be complex.
PARTS = (
    sympy.log,
    sympy.sqrt,
    lambda u: 1 / sympy.sqrt(u),
    lambda u: sympy.besselk(1, u, evaluate=False),
    lambda u: u**a,
)


@parametrize("part", PARTS, ordinary=2)
@pytest.mark.parametrize("known", [{"positive": True}, {"negative": True}, {"real": True, "nonzero": True}])
def test_a_part_that_is_complex_by_what_is_assumed(part: Any, known: dict[str, bool]) -> None:
    """With t > 0 for -t - 1, t < 0 for t - 1, and a real t for -t^2 - 1: valid, but real nowhere."""
    t = sympy.Symbol("t", **known)
    unreal = {t.is_positive: -t - 1, t.is_negative: t - 1}.get(True, -(t**2) - 1)
    solution = sympy.Eq(sympy.Function("y")(t), part(unreal) + 1 / (w - v))
    found = kovacic.validity(solution)
    assert (found.claim, found.real, found.exceptions) == ("valid", (), (v - w,))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x^2*y''+x*y'+(I*x^2-n^2)*y=0", "x != 0"),  # Y_n(sqrt(i) x)
        ("y''+(k^2-2*a/x)*y=0, y(1)=0, y'(1)=1", "x > 0"),  # (-2 i k)^(1 - i a/k)
    ],
)
def test_an_argument_with_an_i(text: str, said: str) -> None:
    """Where a solution is complex, it isn't said to be real, nor to be so nowhere; zeros of arguments are named."""
    found = kovacic.answer_to(text, assume={"k": "positive", "a": "positive"} if "k" in text else {}).validity
    assert (found.claim, str(found)) == ("valid", said)


def test_poles_of_a_gamma_function_of_a_root() -> None:
    """1/gamma(s), 1/gamma(s + 1) and 1/gamma(2 s + 1) for s = sqrt(b/a): real for s >= 0, they vanish for b = 0 alone."""
    found = kovacic.answer_to("x^2*(x-a)*y''+x*(2*x-a)*y'+b*y=0").validity
    assert str(found) == "x > 0, a > 0, b > 0, a - x > 0"
    assert "(n + 2)/(n + 1) is none of" in str(kovacic.answer_to("y''+a*x^n*y'=0").validity)


def test_poles_are_named_beside_complex_parts() -> None:
    y = sympy.Function("y")(x)
    found = kovacic.validity(sympy.Eq(y, sympy.log(-(x**2) - 1) + sympy.hyper((k,), (c,), x) / x))
    assert (found.claim, str(found)) == ("valid", "x != 0, c is none of 0, -1, -2, ...")


def test_a_complex_rate() -> None:
    """exp(x/k^(3/2)) has no real value for a negative k; 1/k^3 is negative, and the solutions are waves."""
    k = sympy.Symbol("k", negative=True)
    y = sympy.Function("y")(x)
    assert kovacic.validity(sympy.Eq(y, sympy.exp(x / k ** sympy.Rational(3, 2)))).claim == "valid"
    found = kovacic.dsolve(y.diff(x, 2) - y / k**3)
    assert found.rhs.has(sympy.cos)
    assert not kovacic.validity(found)


def test_a_line_of_the_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "y'' + w^2*y = cos(v*x)"]) == 0
    assert "real and valid for v + w != 0, v - w != 0, w != 0" in capsys.readouterr().out


#: Functions that are real and finite on one side of a point, or between two, with SymPy's values.
CUT = (
    *(sympy.log, sympy.Ei, sympy.Ci, sympy.asin, sympy.acos, sympy.acosh, sympy.atanh),
    *(sympy.tan, sympy.sec, sympy.cot, sympy.csc, sympy.coth, sympy.csch, sympy.elliptic_k, sympy.elliptic_e),
    *(lambda u, power=power: u**power for power in sympy.sympify("1/2, -1/2, 1/3, -2/3, 5/3, -1, -3, pi")),
    *(lambda u, f=f: f(sympy.Rational(1, 3), u) for f in (sympy.uppergamma, sympy.lowergamma, sympy.legendre)),
    *(lambda u, f=f: f(0, u) for f in (sympy.bessely, sympy.besselk, sympy.uppergamma)),
    *(lambda u, f=f: f(sympy.Rational(1, 3), u) for f in (sympy.besselj, sympy.besseli)),
    *(lambda u, f=f: f(2, u) for f in (sympy.besselj, sympy.yn, sympy.polylog, sympy.legendre)),
    *(lambda u, m=m: sympy.elliptic_f(sympy.asin(u), m) for m in (-1, 3)),
    *(lambda u, m=m: sympy.elliptic_e(sympy.asin(u), m) for m in (-1, 3)),
    *(lambda u, n=n: sympy.elliptic_pi(n, sympy.asin(u), sympy.S.Half) for n in (-2, 3)),
    *(lambda u, m=m: sympy.assoc_legendre(sympy.Rational(1, 3), m, u) for m in (1, 2)),
    lambda u: sympy.hyper((1, 2), (sympy.S.Half,), u),
    lambda u: sympy.hyper((-3, 2), (sympy.S.Half,), u),
    lambda u: sympy.hyper((1,), (sympy.S.Half,), u),
    lambda u: sympy.hyper((1, sympy.S.Half), (), u),
    lambda u: sympy.RootSum(a**5 - a + 1, sympy.Lambda(a, a * sympy.log(u - a)), auto=False),
)
NUMBERS = [sympy.Rational(n, 2) for n in (-5, -3, -1, 0, 1, 2, 3, 5)]


def _holds(found: kovacic.Validity, point: object) -> bool:
    return all(relation.subs(x, point) == sympy.true for relation in found.real)


@parametrize("part", CUT, ordinary=6)
@pytest.mark.parametrize("argument", [x, (x + 1) / 2])
def test_a_part_is_real_where_it_is_said(part: Any, argument: Any) -> None:
    """At numbers where all holds that is needed; and there are such numbers."""
    value = part(argument)
    found = kovacic.validity(sympy.Eq(sympy.Function("y")(x), value))
    points = [point for point in NUMBERS if _holds(found, point)]
    assert points
    for point in points:
        there = value.subs(x, point).evalf(15)
        assert there.is_finite, (value, point)
        assert abs(sympy.im(there)) < 1e-10, (value, point, there)


@parametrize(
    "equation",
    [
        *("y'' + y = 1/x", "y'' - y = 1/x", "y'' = x^(-1/3)", "y'' = exp(-x)*x^(1/3)"),
        *("x*(1-x)*y'' + (1/3-2*x)*y' - y = 0", "(1-x^2)*y'' - 2*x*y' + 10/9*y = 0", "y'' = 1/(x^5+x+1)"),
    ],
    ordinary=2,
)
def test_a_solution_is_real_where_it_is_said(equation: str) -> None:
    solution = kovacic.dsolve(equation)
    found = kovacic.validity(solution)
    value = solution.rhs.subs(dict.fromkeys(solution.rhs.free_symbols - {x}, 1))
    points = [point for point in NUMBERS if _holds(found, point)]
    assert 0 < len(points) < len(NUMBERS)
    for point in points:
        assert abs(sympy.im(value.subs(x, point).evalf(15))) < 1e-10, point


@parametrize(
    ("equation", "ics", "needed"),
    [
        ("y'' = acosh(x)", None, "x - 1 >= 0"),
        ("y'' = x^x", "y(1)=0, y'(1)=0", "x > 0"),
        ("y'' = exp(x)/sqrt(x^3+1)", None, "x**3 + 1 > 0"),
    ],
    ordinary=1,
)
def test_integrals_that_stay_need_what_is_integrated(equation: str, ics: str | None, needed: str) -> None:
    assert str(kovacic.validity(kovacic.dsolve(equation, ics=ics))) == needed


@parametrize(
    ("polynomial", "values"),
    product(["x^4+1", "x^5+x+1"], [None, "y(0)=0, y'(0)=0"]),
    ordinary=1,
    always=[("x^5+x+1", "y(0)=0, y'(0)=0")],
)
def test_a_sum_over_roots_names_no_other_symbol(polynomial: str, values: str | None) -> None:
    """Of the needs of its terms those at the real roots are said: they stood there in the name that is summed over."""
    found = kovacic.validity(kovacic.dsolve(f"y'' = 1/({polynomial})", ics=values))
    assert all(relation.free_symbols == {x} for relation in found.real)


def test_conjugate_parts_need_only_be_finite() -> None:
    assert str(kovacic.validity(kovacic.dsolve("y'' + y = exp(x)/x"))) == "x != 0"


@pytest.mark.parametrize("equation", ["(x^2+1)*y'' + x*y' - n^2*y = 0", "(9*x^2+4)*y'' + 9*x*y' - n^2*y = 0"])
def test_a_root_above_what_stands_beside_it(equation: str) -> None:
    """x + sqrt(x^2 + 1) > 0 everywhere; in cosines of n acos(sqrt(x^2 + 1)) the solutions are real for x = 0 alone."""
    found = kovacic.dsolve(equation)
    assert str(kovacic.validity(found)) == "n != 0"
    x = sympy.Symbol("x")
    for n in (1, sympy.Rational(7, 3)):
        values = [sympy.im(found.rhs.subs({"n": n, "C1": 2, "C2": -3, x: at}).evalf(20)) for at in (-5, 0, 3)]
        assert values == [0, 0, 0]


def test_an_answer_is_shown_as_its_formula() -> None:
    assert repr(kovacic.answer_to("y'' + y = 1")) == "<SecondOrderAnswer: y(x) = C1*cos(x) + C2*sin(x) + 1>"
    assert str(kovacic.answer_to("y' = a*y")) == "y(x) = C1*exp(a*x)"


@parametrize(
    "right",
    [
        *(
            "1/(1+2*cos(x))",
            "1/(1-2*sin(x))",
            "1/(sin(x)*cos(2*x))",
            "1/(1-tan(x))",
            "tan(2*x)",
            "tan(x)",
            "1/(2-5*sin(x))",
        ),
        *("1/(1-2*cos(x))", "1/(3*cos(x)-1)", "sec(x)*csc(x)", "1/(cos(x)-2*sin(x))", "1/(1+2*sin(x))", "cot(x)^2"),
    ],
    ordinary=(0,),
    long=1,
)
def test_answers_in_logarithms_of_waves_are_real_for_small_angles(right: str) -> None:
    """They were log(tan(x/2) - sqrt(3)) beside log(2*cos(x) + 1), both of which are real nowhere."""
    x = sympy.Symbol("x")
    found = kovacic.dsolve(f"y'' + y = {right}")
    needed = kovacic.validity(found)
    particular = found.rhs.subs({"C1": 0, "C2": 0})
    for at in (0.05, 0.15):
        assert all(relation.subs(x, at) == sympy.true for relation in needed.real), needed
        assert abs(sympy.im(particular.subs(x, at).evalf(20))) < 1e-15


@pytest.mark.parametrize(
    ("value", "needed"),
    [
        ("log(1 + 1/x) + log(x + 1)", "x > 0"),
        ("(sqrt(x) + sqrt(x - 1))^(1/3)", "x >= 1"),
        ("(sqrt(x) + sqrt(x - 1))^(-1/3)", "x >= 1"),
        ("log(2 - x) + log(x - 1)/x", "x > 1, x < 2"),
        ("log(x) + log(-x - 1)", "x != 0, x + 1 != 0"),
        ("log(x^2 - 4) + sqrt(x - 2)", "x > 2"),
        ("log(x)/(x - 1)", "x - 1 != 0, x > 0"),
        ("log(x^(1/3)*k)", "x > 0, k > 0"),
        ("log((x + 1)^(3/2))", "x + 1 > 0"),
        ("Integral(log(s), (s, 1, x))", "x > 0"),
        ("log((sin(x) + 1)/(1 - sin(x)))", "cos(x) != 0"),
    ],
)
def test_relations_in_x_are_one_interval(value: str, needed: str) -> None:
    x = sympy.Symbol("x")
    formula = sympy.Eq(sympy.Function("y")(x), sympy.sympify(value.replace("^", "**"), rational=True))
    assert str(kovacic.validity(formula)) == needed


@parametrize("right", ["x", "sin(x)", "1/x", "cos(2*x)^2", "x*exp(x)"], ordinary=(2,), long=2)
def test_a_particular_solution_is_real_where_the_pair_is(right: str) -> None:
    """log(1 - x) and Ci(1 - x), not log(x - 1) and Ci(x - 1), stand beside log((1 + x)/(1 - x))."""
    found = kovacic.validity(kovacic.dsolve(f"(1-x^2)*y'' - 2*x*y' + 2*y = {right}"))
    assert all(condition.subs(x, sympy.Rational(1, 2)) == True for condition in found.real)  # noqa: E712


@pytest.mark.parametrize(
    ("equation", "needed"),
    [
        ("a*y'' + b*y' + c*y = 0", "4*a*c - b**2 > 0, a != 0"),
        ("L*y'' + R*y' + y/C = 0", "-C**2*R**2 + 4*C*L > 0, L != 0"),
        ("y'' + k*y = 1", "k > 0"),
    ],
)
def test_at_least_zero_beside_not_zero_is_more_than_zero(equation: str, needed: str) -> None:
    found = kovacic.validity(kovacic.dsolve(equation, var="x"))
    assert str(found) == needed
    assert len(found.exceptions) > needed.count("!=")  # where they are zero another formula holds


def test_poles_of_the_solution_that_values_exclude_are_no_exceptions() -> None:
    """1F1(1/3; k + 2; x) is defined for each k > 0, and x^(-k-1) 1F1(-k - 2/3; -k; x) isn't."""
    found = kovacic.answer_to("x*y'' + (2+k-x)*y' - y/3 = 0", ics="y(0)=1", assume={"k": "positive"})
    assert not found.validity


@pytest.mark.long
def test_equal_roots_are_written_alike() -> None:
    """An oscillating circuit at rest: sqrt(C*(4*L - C*R^2)) beside sqrt(-C*(C*R^2 - 4*L)) before."""
    current = kovacic.dsolve("L*q'' + R*q' + q/C = E0, q(0)=0, q'(0)=0", var="t").rhs
    assert len({power.base for power in current.atoms(sympy.Pow) if power.exp in (sympy.S.Half, -sympy.S.Half)}) == 1


@pytest.mark.parametrize(
    ("equation", "needed"),
    [
        ("y'' = k*y*exp(x)", "k > 0"),
        ("x*y'' + y' = k*y", "x > 0, k > 0"),
        ("k*y'' = h*y*exp(x)", "k > 0, h > 0"),
        ("y'' = 1/(a + x^2), y(0)=0, y'(0)=0", "a > 0, a + x**2 > 0"),
        ("(a^2-x^2)*y'' - x*y' = 0", "a**2 - x**2 >= 0, a != 0"),
    ],
)
def test_positive_products_of_roots_are_positive_letters(equation: str, needed: str) -> None:
    """K0 needs sqrt(k)*sqrt(x) > 0."""
    assert str(kovacic.validity(kovacic.dsolve(equation, var="x"))) == needed


def test_a_bounded_solution_needs_no_second_one() -> None:
    """1F1(-a; 1; x) and U are dependent for natural a, where a polynomial is the bounded solution all the same."""
    assert not kovacic.answer_to("x*y''+(1-x)*y'+a*y=0, y(0)=bounded").validity


def test_what_has_no_sign_and_what_has_no_zero_need_nothing() -> None:
    """Conjugate logarithms of complex numbers; x^2 + 3 x + 5; x - r and r - x for one root r."""
    found = kovacic.validity(kovacic.dsolve("(x^2+3*x+5)*y'' + (x+1/3)*y' + 7*y = log(x^5+x^2-7*x+2)"))
    assert (str(found), found.claim) == ("x**5 + x**2 - 7*x + 2 > 0", "valid")
    assert str(kovacic.validity(kovacic.dsolve("y'' - y = 1/(x^5-3*x+1)"))).count("!= 0") == 3


def test_bounds_that_are_assumed_are_not_said() -> None:
    """-2 < x < 2 is x < 2 for a positive x."""
    x = sympy.Symbol("x", positive=True)
    formula = sympy.log(4 - x**2) + sympy.log(5 - x**2) + sympy.log(6 - x**2)
    assert str(kovacic.validity(sympy.Eq(sympy.Function("y")(x), formula))) == "x < 2"


@parametrize(
    ("equation", "needed"),
    [
        ("y''+a*y=x, y(0)=0, y'(0)=0", "a != 0"),
        ("y''+a*y=abs(x), y(0)=0, y'(0)=0", "a != 0"),
        ("y''-(a+b)*y=0, y(0)=0, y'(0)=1", "a + b != 0"),
        ("y''+(b+a*(a+1)/cosh(x)^2)*y=0", ""),
        ("(x^2-1)*y''+a*y=0", "1 - x**2 > 0"),
    ],
    ordinary=3,
)
def test_what_is_even_in_a_root_needs_no_sign_below_it(equation: str, needed: str) -> None:
    """sin(sqrt(a) x)/a^(3/2) is real for a negative a as well: SymPy's sqrt(a^3)/a^3 in place of a^(-3/2) isn't even."""
    assert str(kovacic.validity(kovacic.dsolve(equation))) == needed


def test_poles_of_several_functions_are_said_once() -> None:
    answer = kovacic.answer_to("y'' = x^n*exp(x)", ics="y(1)=0, y'(1)=0")
    assert str(answer.validity) == "x > 0, n + 1 is none of 0, -1, -2, ..."


@pytest.mark.parametrize(
    ("text", "needed"),
    [
        ("y'' - k^2*y = 0, y(0) = 0, y(1) = 1", "k != 0"),  # sinh(k)
        ("y'' - k^2*y = 0, y'(0) = 0, y(L) = 1", ""),  # cosh(k*L)
        ("y'' - (a+b)*y' + a*b*y = 0, y(0) = 0, y(1) = 1", "a - b != 0"),  # exp(a) - exp(b)
        ("y'' - k*y = 0, y(0) = 0, y(1) = 1", "sinh(sqrt(k)) != 0"),  # for k = -pi^2 as well
    ],
)
def test_what_real_letters_can_violate_is_said(text: str, needed: str) -> None:
    assert str(kovacic.answer_to(text).validity) == needed


@pytest.mark.parametrize("where", ["sin(x)", "cos(x)", "exp(-x)", "tanh(x)"])
@pytest.mark.parametrize("k", ["1/3", "sqrt(2)"])
def test_an_answer_in_another_function_is_real_somewhere(where: str, k: str) -> None:
    """((1 - t)/(1 + t))^k and its inverse for t = t(x): (D^2 - (t''/t' - 2 t t'/(t^2 - 1)) D - (2 k t'/(t^2 - 1))^2) y = 0."""
    x = sympy.Symbol("x", real=True)
    t = sympy.sympify(where, {"x": x})
    slope = t.diff(x)
    p, q = slope.diff(x) / slope - 2 * t * slope / (t**2 - 1), (2 * sympy.sympify(k) * slope / (t**2 - 1)) ** 2
    found = kovacic.answer_to(f"y'' - ({sympy.simplify(p)})*y' - ({sympy.simplify(q)})*y = 0")
    demands = [r.subs(r.free_symbols.pop(), sympy.Rational(9, 10)) for r in found.validity.real]
    assert sympy.And(*demands) == sympy.true


def test_a_root_that_is_not_zero_is_positive() -> None:
    u = 1 - sympy.exp(-2 * x)
    assert str(kovacic.validity(sympy.Eq(sympy.Function("y")(x), sympy.sqrt(u) + 1 / u))) == "1 - exp(-2*x) > 0"
