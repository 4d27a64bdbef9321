"""The form in which solutions are written: as short at every door, whatever the equation was made from."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Iterator
from fractions import Fraction
from random import Random

import pytest
import sympy
from build import function, parametrize, run
from transform import gauge

import kovacic
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.numbers.numerals import as_latex, as_text
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.pullback import Pullback
from kovacic.special.whittaker import Whittaker
from kovacic.views.text import solution_lines
from kovacic.writing.formula import caret

X = RatFunc(QQ.poly([0, 1]))
x = sympy.Symbol("x")


def pulled_back(differences: tuple[Fraction | int, ...], f: RatFunc) -> RatFunc:
    """S of Gauss' equation with these exponent differences at f = 0, 1, infinity."""
    return Pullback(Gauss(*(QQ.poly([Fraction(d) ** 2]) for d in differences)), f).S


#: s^2 = f (f - 1) in x is a curve of genus 1 for each of these.
GENUS_ONE = ((X**2 + 3 * X + 5) / (X + 1), (X**2 + 3 * X + 1) / (X + 1), (X**2 + X + 3) / (X + 2), (X**2 - 3) / (X + 4))


def check_dihedral(n: int, f: RatFunc) -> None:
    """Elementary and short, with the group of the same answer."""
    answer = kovacic.solve(str(pulled_back((Fraction(3, 2), Fraction(1, 2), Fraction(1, n)), f)))
    form = answer.closed_form
    assert form is not None
    assert answer.group is not None
    assert answer.group.finite
    assert form.notes == ()
    assert not form.y1.has(sympy.Integral)
    assert len(str(form.y1)) + len(str(form.y2)) < 2500


@pytest.mark.parametrize("n", [90, 110, pytest.param(301, marks=pytest.mark.long)])
def test_functions_on_a_curve_stay_products(n: int) -> None:
    check_dihedral(n, GENUS_ONE[0])


@parametrize("f", GENUS_ONE, ids=str, ordinary=0, long=1)
def test_long_functions_on_a_curve_stay_products(f: RatFunc) -> None:
    for n in (7, *range(60, 200, 5), 200, 250, 301, 1000, 4001):
        check_dihedral(n, f)


def test_a_ball_with_zero_in_a_denominator_asks_for_more_digits() -> None:
    """Two square roots agree in a hundred digits at the point of the check: 1/(r - s), and cot, sec, ... of the same kind."""
    close = sympy.sqrt(x**2 + sympy.Rational(1, 10**80)) - sympy.sqrt(x**2)
    from kovacic.closed_form.check import is_numerical_solution

    for y in (1 / close, close ** sympy.Rational(-1, 2), sympy.cot(close), sympy.csch(close)):
        omega = (sympy.diff(y, x, 2) / y).subs(x, 3)
        assert omega.is_number
        assert not is_numerical_solution(y, x, X, X * 0)


@pytest.mark.parametrize(
    "given", [sympy.pi**2 * x**2 + 3 * sympy.pi, "pi^2*x^2 + 3*pi", "pi*x + 1", "y'' + pi*y' + x*y = 0"]
)
def test_pi_is_a_number_in_what_is_written(given: object) -> None:
    answer = kovacic.solve(given)
    written = (*answer.solutions, *answer.special)
    assert written
    assert all(y.free_symbols == {x} for y in written)


def test_code_of_other_systems() -> None:
    """The arguments as each system defines its functions: a modulus k or its square m, n before phi or behind, lists."""
    m, n, t = sympy.symbols("m n t")
    expected = {
        sympy.elliptic_f(t, m): ("EllipticF[t, m]", "EllipticF(sin(t), sqrt(m))", "Elliptic.F(t, m)"),
        sympy.elliptic_k(m): ("EllipticK[m]", "EllipticK(sqrt(m))", "ellipk(m)"),
        sympy.elliptic_e(m): ("EllipticE[m]", "EllipticE(sqrt(m))", "ellipe(m)"),
        sympy.elliptic_e(t, m): ("EllipticE[t, m]", "EllipticE(sin(t), sqrt(m))", "Elliptic.E(t, m)"),
        sympy.elliptic_pi(n, t, m): ("EllipticPi[n, t, m]", "EllipticPi(sin(t), n, sqrt(m))", "Elliptic.Pi(n, t, m)"),
        sympy.lowergamma(n, t): ("Gamma[n, 0, t]", "(GAMMA(n) - GAMMA(n, t))", "(gamma(n) - gamma(n, t))"),
        sympy.hyper((n,), (), t): ("HypergeometricPFQ[{n}, {}, t]", "hypergeom([n], [], t)", "pFq((n,), (), t)"),
        sympy.hyper((n, sympy.Rational(2, 3)), (m,), t): (
            "HypergeometricPFQ[{2/3, n}, {m}, t]",
            "hypergeom([2/3, n], [m], t)",
            "pFq((2 // 3, n), (m,), t)",
        ),
        sympy.RootSum(m**3 - 2 * m + 5, sympy.Lambda(m, m**2 * sympy.log(t - m)), auto=False): (
            "RootSum[Function[a, a^3 - 2*a + 5], Function[a, a^2*Log[-a + t]]]",
            "sum(a^2*ln(-a + t), a = RootOf(a^3 - 2*a + 5, a))",
            "Julia has no RootSum, or one with another meaning",
        ),
        (-2) ** t * m**2: ("(-2)^t*m^2", "(-2)^t*m^2", "complex(-2) ^ (t) .* m .^ 2"),
        sympy.airyaiprime(t): ("AiryAiPrime[t]", "AiryAi(1, t)", "airyaiprime(t)"),
        sympy.besselk(2 * sympy.I, t): ("BesselK[2*I, t]", "BesselK(2*I, t)", "Julia's besselk has no complex orders"),
        sympy.Ei(sympy.pi * t): ("ExpIntegralEi[Pi*t]", "Ei(Pi*t)", "expinti(pi * t)"),
        sympy.E * t + sympy.I * sympy.pi: ("E*t + I*Pi", "exp(1)*t + I*Pi", "exp(1) * t + (pi) * im"),
        sympy.Integral(sympy.exp(t**2), (t, 0, n)): (
            "Integrate[Exp[t^2], {t, 0, n}]",
            "Int(exp(t^2), t = 0 .. n)",
            "Julia has no Integral, or one with another meaning",
        ),
        sympy.Integral(t * n, (t, 0, 1), (n, 0, 1)): tuple(
            f"{name} has no Integral, or one with another meaning" for name in ("Mathematica", "Maple", "Julia")
        ),
        sympy.assoc_legendre(n, m, t): (
            "LegendreP[n, m, t]",
            *(f"{name} has no assoc_legendre, or one with another meaning" for name in ("Maple", "Julia")),
        ),
        sympy.Symbol("D") * t: (
            "D can't be the name of a letter in Mathematica\n  hint: rename it with subs",
            "D can't be the name of a letter in Maple\n  hint: rename it with subs",
            "D .* t",
        ),
    }
    for expression, codes in expected.items():
        for language, code in zip(("mathematica", "maple", "julia"), codes, strict=True):
            try:
                found = kovacic.as_code(expression, language)
            except kovacic.InputError as refused:
                found = str(refused)
            assert found == code
    with pytest.raises(kovacic.InputError, match="unknown language 'fortran'") as refused:
        kovacic.as_code(t, "fortran")
    assert refused.value.hint == "available: mathematica, maple, julia"


def test_solutions_as_code(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "--as", "maple", "x^2 + 3", "x"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "# y'' = (x^2 + 3) y: case 1, omega = (x^2 + 1)/x",
        "y1 := x*exp((1/2)*x^2);",
        "y2 := sqrt(Pi)*x*exp((1/2)*x^2)*erf(x) + exp(-1/2*x^2);",
        "# y'' = x y: no Liouvillian solution",
        "y1 := AiryAi(x);",
        "y2 := AiryBi(x);",
    ]
    assert run(["solve", "--as", "mathematica", "y'' + E*E0*k_1*y = 0"]) == 0  # letters that mean something else there
    renamed = ["(* E00 stands for E *)", "(* k1 stands for k_1 *)", "y1 = Cos[x*(E0*E00*k1)^(1/2)];"]
    assert capsys.readouterr().out.splitlines()[1:4] == renamed
    assert run(["solve", "--as", "julia", "y'' = y + x"]) == 0
    assert capsys.readouterr().out.splitlines()[1] == "# two solutions of the homogeneous equation"


THIRD, FIFTH, SEVENTH = (Fraction(1, n) for n in (3, 5, 7))
TARGETS: dict[str, RatFunc] = {
    "Airy": X,
    "Airy in 2^(1/3) x": 2 * X,
    "Airy in x^2 + 1/x": Pullback(Airy(QQ.poly([1])), X**2 + 1 / X).S,
    "Airy in 2/x": Pullback(Airy(QQ.poly([1])), 2 / X).S,
    "Bessel of order 1/3": -1 + (4 * THIRD**2 - 1) / (4 * X**2),
    "Bessel of order 2": -1 + Fraction(15, 4) / X**2,
    "Bessel modified, in x - 1/x": Pullback(Whittaker(*map(QQ.poly, ([1], [], [-THIRD / 4]))), X - 1 / X).S,
    "Bessel in sqrt(x)": Pullback(Bessel(*map(QQ.poly, ([], [1], [(FIFTH**2 - 1) / 4]))), X).S,
    "Weber": X**2 / 4 + THIRD,
    "Whittaker": Fraction(1, 4) - THIRD / X + (Fraction(1, 4) - 1) / (4 * X**2),
    "Gauss": pulled_back((THIRD, FIFTH, SEVENTH), X),
    "Gauss with logarithms": pulled_back((0, FIFTH, SEVENTH), X),
    "Gauss in x^2/(x + 1)": pulled_back((THIRD, FIFTH, SEVENTH), X**2 / (X + 1)),
    "tetrahedral": pulled_back((Fraction(1, 2), THIRD, THIRD), X),
    "octahedral": pulled_back((Fraction(1, 2), THIRD, Fraction(1, 4)), X),
    "icosahedral": pulled_back((Fraction(1, 2), THIRD, FIFTH), X),
    "icosahedral with shifted differences": pulled_back((Fraction(1, 2), THIRD, Fraction(6, 5)), 1 / X),
}
ONE = X * 0 + 1
#: a and b; the first four are short, so the answer is too.
PAIRS = (
    (ONE, X),
    (X, ONE),
    (X * 0, ONE),
    (ONE, X * 0 + 2),
    (1 / X, X + 1),
    (1 / (X + 2), X**2 + 1),
    (X + 1, X * 0 - 3),
    (X**2 + 1, X - 2),
    (ONE, 1 / X),
    (X - 3, X**2),
    (2 / (X - 2), ONE),
    (X / (X + 5), X),
    (3 * ONE, X**2 + X + 1),
)


def check_transform(name: str, a: RatFunc, b: RatFunc) -> None:
    """The solutions of the transform are found, and short."""
    S = gauge(TARGETS[name], a, b)
    answer = kovacic.solve(str(S))
    pair = answer.solutions or answer.special.solutions
    assert pair, (name, a, b)
    assert sum(len(str(y)) for y in pair) < max(1000, 4 * len(str(S))), (name, a, b)
    assert not any(y.has(sympy.Integral) for y in pair)


@pytest.mark.parametrize(
    "name",
    [
        "Airy in 2^(1/3) x",
        pytest.param("Airy in x^2 + 1/x", marks=pytest.mark.long),
        "Bessel of order 2",
        "Weber",
        pytest.param("Gauss in x^2/(x + 1)", marks=pytest.mark.long),
        pytest.param("icosahedral", marks=pytest.mark.long),
    ],
)
def test_gauge_transforms_are_found(name: str) -> None:
    check_transform(name, *PAIRS[0])


@pytest.mark.long
@pytest.mark.parametrize("name", TARGETS)
def test_gauge_transforms_of_all_kinds_are_found(name: str) -> None:
    check_transform(name, *PAIRS[4])


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_all_gauge_transforms_are_found(name: str) -> None:
    """221 of them."""
    for a, b in PAIRS:
        check_transform(name, a, b)


def test_the_derivatives_of_bessel_functions() -> None:
    """J_2'(x) and Y_2'(x), in functions of order 0 and 1; by `dsolve` too."""
    equation = "(x^4 - 4*x^2)*y'' + (x^3 - 12*x)*y' + (x^4 - 9*x^2 + 12)*y = 0"
    special = kovacic.solve(equation).special
    assert special.transform is not None
    for y, order_two in zip(special, (sympy.besselj(2, x), sympy.bessely(2, x)), strict=True):
        ratio = (y / order_two.diff(x)).subs(x, sympy.Rational(7, 3)).evalf(30)
        assert abs(ratio - (y / order_two.diff(x)).subs(x, sympy.Rational(9, 7)).evalf(30)) < 1e-25
    assert kovacic.dsolve(equation).rhs.has(sympy.besselj(1, x))


# ------------------------------------------------------------------------------------------ lengths


@pytest.mark.parametrize("k", [15, 35, -41])
def test_short_pairs_in_error_functions_stay(k: int) -> None:
    """y'' = (x^2 + k) y: polynomials times exp(+-x^2/2), and erf or erfi, in fewer than 1,000 characters."""
    pair = kovacic.solve(f"x^2 + {k}").solutions
    assert pair[1].has(sympy.erf, sympy.erfi)
    assert not any(y.has(sympy.hyper) for y in pair)


def test_legendre_functions_stay_logarithms() -> None:
    """Of degree 20, in fewer than 1,000 characters."""
    assert kovacic.solve("(1-x^2)*y'' - 2*x*y' + 420*y = 0").solutions[1].has(sympy.log)


def test_a_short_pair_is_independent_where_both_solutions_grow() -> None:
    """y z' and y' z agree in more than 30 digits at the point where the Wronskian is shown not to be zero."""
    pair = kovacic.solve("(11445*x^2 - 34326*x + 22877)/(4*(x-1)*(x-2))^2").solutions
    assert sum(len(str(y)) for y in pair) < 200


@pytest.mark.parametrize("k", [2 * 10**9 + 1, -2 * 10**9 - 1, 10**6 + 1, -(10**6) - 3])
def test_polynomials_of_huge_degree_have_names(k: int) -> None:
    """y'' = (x^2 + k) y has exp(+-x^2/2) times Hermite's polynomial of degree (|k| - 1)/2, which is right near 0."""
    pair = kovacic.solve(f"x^2 + {k}").special.solutions
    assert sum(len(str(y)) for y in pair) < 150
    for y, start in zip(pair, ([1, 0], [0, 1]), strict=True):
        series = [Fraction(c) for c in start]
        for n in range(30):
            series.append((k * series[n] + (series[n - 2] if n > 1 else 0)) / ((n + 1) * (n + 2)))
        expected = sum(sympy.Rational(c) * sympy.Rational(1, 10**5) ** n for n, c in enumerate(series))
        assert abs(y.subs(x, sympy.Rational(1, 10**5)).evalf(30) / expected.evalf(30) - 1) < 1e-20


# ------------------------------------------------------------------------------------------ all doors


def made_up(count: int) -> Iterator[tuple[str, RatFunc]]:
    """Equations with known kinds of solutions, of each case and of genus 0, 1 and 2, pulled back and gauge transformed."""
    random = Random(43)

    def constant() -> RatFunc:
        return X * 0 + Fraction(random.randint(-4, 4), random.choice((1, 1, 2, 3)))

    def function(degree: int) -> RatFunc:
        while True:
            f = sum((constant() * X**k for k in range(degree)), X**degree)
            g = X + constant() if random.random() < 0.4 else X * 0 + 1
            if (f / g).derivative() and (f / g).degree <= degree:
                return f / g

    def reducible() -> RatFunc:
        a, b = random.sample(range(-3, 4), 2)
        omega = Fraction(random.randint(-6, 30), random.choice((1, 1, 2))) / (X - a) + Fraction(
            random.randint(1, 3)
        ) / (X - b)
        omega = omega + random.choice((0, 1, 1)) * function(1) * (X * 0 + 1)
        return omega.derivative() + omega * omega

    def conjugate() -> RatFunc:
        n = random.randint(0, 12)
        return Pullback(Whittaker(*map(QQ.poly, ([random.choice((1, -1))], [], [n * (n + 1)]))), function(1)).S

    def finite(third: Fraction | int, shift: int, degree: int) -> RatFunc:
        return pulled_back((Fraction(1, 2) + shift, THIRD, third), function(degree))

    def dihedral(degree: int) -> RatFunc:
        n = random.randint(3, 400)
        return pulled_back(
            (Fraction(2 * random.randint(0, 1) + 1, 2), Fraction(1, 2), Fraction(1, n)), function(degree)
        )

    kinds: dict[str, Callable[[], RatFunc]] = {
        "reducible": reducible,
        "conjugate": conjugate,
        "dihedral": lambda: dihedral(random.choice((1, 2, 2))),
        "tetrahedral": lambda: finite(THIRD, 0, 1),
        "octahedral": lambda: finite(Fraction(1, 4), 0, random.choice((1, 2))),
        "icosahedral": lambda: finite(Fraction(random.choice((1, 4, 6)), 5), 0, random.choice((1, 1, 2))),
    }
    for k in range(count):
        name = list(kinds)[k % len(kinds)]
        S = kinds[name]()
        if k % 5 == 4:
            S = gauge(S, *random.choice(PAIRS[:4]))
        yield name, S


def check_doors(S: RatFunc) -> None:
    """The same expressions in Python, JSON, LaTeX, HTML's formulas, the command, the explanation and dsolve; short ones."""
    answer = kovacic.solve(str(S))
    form = answer.closed_form
    if form is None:  # a letter of the family made it irreducible
        return
    pair = answer.solutions
    texts = [as_text(y) for y in pair]
    assert texts == [as_text(y) for y in form]
    assert json.loads(answer.to_json(full=True))["solutions"] == texts
    latex = answer._repr_latex_()
    assert all(as_latex(y) in latex for y in pair)
    printed = [line.partition(" = ")[2] for line in solution_lines(answer) if line.startswith("y")]
    assert printed == [caret(text) for text in texts]
    explained = answer.explain()
    assert all(caret(text) in explained or len(text) > 3000 for text in texts)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a formula on a curve may jump, which is said
        general = kovacic.dsolve(f"y'' = ({S})*y").rhs
    for constants, y in zip(((1, 0), (0, 1)), pair, strict=True):
        found = general.subs(dict(zip(sympy.symbols("C1 C2"), constants, strict=True)))
        assert found == y or sympy.expand(found - y) == 0
    length = sum(map(len, texts))
    others = [sum(len(as_text(y)) for y in answer.special)] if answer.special else []
    is_elementary = not any(y.has(sympy.Integral, sympy.hyper) for y in pair)
    assert length <= max([1000, *([4 * n for n in others] if is_elementary else [2 * n for n in others])]) or not others


def test_every_door_shows_the_same_form() -> None:
    for _, S in made_up(3):
        check_doors(S)


@pytest.mark.long
def test_every_door_shows_the_same_form_of_some() -> None:
    for _, S in made_up(8):
        check_doors(S)


@pytest.mark.slow
def test_every_door_shows_the_same_form_of_many() -> None:
    for _, S in made_up(500):
        check_doors(S)


@pytest.mark.parametrize(("a", "b"), [("3/2", 1), ("5/2", 3), ("1/2", 2), ("3/2", 4)])
def test_logarithms_are_real_where_the_roots_before_them_are(a: str, b: int) -> None:
    """(x - 1)^a (x + 1)^b is real for x > 1, and so is the logarithm beside it; both doors show that."""
    omega = sympy.Rational(a) / (x - 1) + sympy.Integer(b) / (x + 1)
    S = sympy.factor(omega.diff(x) + omega**2)
    pair = kovacic.solve(S).solutions
    assert pair[1].has(sympy.log)
    assert all(y.subs(x, 3).is_real for y in pair)
    assert kovacic.dsolve(f"y'' = ({S})*y").rhs.atoms(sympy.log) == pair[1].atoms(sympy.log)


@pytest.mark.parametrize(
    "equation",
    [
        pytest.param("y'' = (x^2 + 2001)*y", marks=pytest.mark.long),
        "(1-x^2)*y'' - 2*x*y' + 500*501*y = 0",
        "x*y'' + (1-x)*y' + 500*y = 0",
        "x^2*y'' + x*y' - (x^2 + (400+1/2)^2)*y = 0",
    ],
)
def test_polynomials_of_large_degree_are_named(equation: str) -> None:
    """Nothing of the size of the polynomial is made where a special function is preferred to it."""
    pair = kovacic.solve(equation).solutions
    assert sum(map(len, map(as_text, pair))) < 200
    assert not any(y.has(sympy.Integral) for y in pair)


@pytest.mark.parametrize(
    "S",
    [
        "(493*x**2 - 1044*x + 756)/(144*x**2*(x - 2)**2)",
        "(-2*x**2 - 4*x + 4)/(9*x**4 - 18*x**3 + 9*x**2)",
        "(13*x**2 - 8*x - 32)/(144*x**4 - 288*x**3 + 144*x**2)",
    ],
)
def test_an_elementary_solution_is_real_where_that_beside_it_is(S: str) -> None:
    """Powers of x and of x - a, and a series in x/a: both members are real between 0 and a, at both doors."""
    pair = kovacic.solve(S).solutions
    assert all(sympy.im(y.subs(x, sympy.Rational(1, 3)).evalf()) == 0 for y in pair)
    general = kovacic.dsolve(f"y'' = ({S})*y").rhs
    assert sympy.expand(general.subs({"C1": 1, "C2": 0}) - pair[0]) == 0


def test_solutions_that_are_real_between_two_points_stay_so() -> None:
    """Between 3 and 4, where none of the usual points for a look lies."""
    S = "(-32*x**2 + 219*x - 396)/(144*(x - 3)**2*(x - 4)**2)"
    pair = kovacic.solve(S).solutions
    general = kovacic.dsolve(f"y'' = ({S})*y").rhs
    assert all(y.subs(x, sympy.Rational(7, 2)).evalf().is_real for y in pair)
    assert sympy.expand(general.subs({"C1": 1, "C2": 0}) - pair[0]) == 0


@pytest.mark.long
def test_gauss_functions_are_written_where_they_are_real() -> None:
    """2F1(f) is real for f < 1: (1 - f)^e stands before it, not (f - 1)^e, for functions f of a higher degree, too."""
    for z in ("x^2+4*x/3", "x^2+2*x/3", "x^2+4*x"):
        f = function(z)
        S = pulled_back((Fraction(1, 2), Fraction(1, 3), Fraction(1, 7)), f)
        y1, y2 = kovacic.solve(str(S)).special.solutions
        general = sympy.Eq(sympy.Function("y")(sympy.Symbol("x")), sympy.Symbol("C1") * y1 + sympy.Symbol("C2") * y2)
        assert sympy.false not in kovacic.validity(general).real


@pytest.mark.parametrize(
    ("differences", "z", "place"),
    [
        ((0, 0, Fraction(3, 2)), "-2*x^2-3", "1/3"),
        ((2, 1 - THIRD, 1 + THIRD), "x-x^2-3", "2"),
        ((0, 0, THIRD), "2*x^2+x-1", "-6/5"),
    ],
)
def test_gauss_functions_with_logarithms_are_real_somewhere(
    differences: tuple[Fraction | int, ...], z: str, place: str
) -> None:
    """2F1(f) and 2F1(1 - f) where f is between 0 and 1, of f, 1/f, f/(f - 1), ... the one that is so for a real x."""
    S = pulled_back(differences, function(z))
    pair = kovacic.solve(str(S)).special.solutions
    assert all(y.subs(x, sympy.Rational(place)).evalf().is_real for y in pair)
    general = kovacic.dsolve(f"y'' = ({S})*y").rhs
    parts = [general.subs(dict(zip(sympy.symbols("C1 C2"), c, strict=True))) for c in ((1, 0), (0, 1))]
    assert all(sympy.expand(part - y) == 0 for part, y in zip(parts, pair, strict=True))


def test_where_no_form_keeps_its_digits_the_chosen_one_is_said_to_lose_them() -> None:
    """Both forms of a Hermite equation with shifted poles do; the search for another one ended in an error."""
    num = "-38114*x^6 - 457300*x^5 - 2282758*x^4 - 6068306*x^3 - 9060385*x^2 - 7204012*x - 2383107"
    den = "1156*x^10 + 23120*x^9 + 208012*x^8 + 1108672*x^7 + 3876545*x^6 + 9291532*x^5 + 15460540*x^4"
    form = kovacic.solve(f"({num})/({den} + 17634464*x^3 + 13195504*x^2 + 5849280*x + 1166400)").closed_form
    assert form is not None
    assert any("digits" in note for note in form.notes)
