"""Coefficients from number fields: reading, deciding, verifying, printing."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest
import strategies
import sympy
from build import QQ, AlgebraicField, Budget, RatFunc, analyse, function, generated, parametrize, read_expression
from hypothesis import given, settings
from strategies import Example
from transform import hypergeometric

import kovacic
from kovacic import Limits

ENTRIES = [
    ("x^6 - 7*x^2 + 2*sqrt(2)", 1),
    ("x^2 + sqrt(2)", None),
    ("x^2 + 1 + (sqrt(2) - sqrt(2))", 1),
    ("sqrt(2)", 1),
    ("I", 1),
    ("-(1+I)/x^2", 1),
    ("I*x", None),
    ("sqrt(2)^2*x^2 + 3*sqrt(2)", 1),
    ("-x^2 + I", 1),
    ("-x^2 + 3*I", 1),
    ("-x^2 + 2*I", None),
    ("-3/16/x^2 + sqrt(3)/x", 2),
    ("x^2 + cbrt(2)", None),
    ("cbrt(2)^2*x^2 + 5*cbrt(2)", 1),
    ("(sqrt(2)+sqrt(3))^2*x^2 + sqrt(2) + sqrt(3)", 1),
    ("2/(x-sqrt(2))^2", 1),
    ("-3/(16*(x-sqrt(2))^2) - 3/(16*(x+I)^2) + 1/((x-sqrt(2))*(x+I))", 2),
    ("1/(x^3-sqrt(2))", None),
    ("x^2 + root(3,5)", None),
    ("sqrt(1+sqrt(2))/x^2", 1),
]


@parametrize(("S", "case"), ENTRIES, ordinary=4)
def test_decided_and_verified(S: str, case: int | None) -> None:
    answer = kovacic.solve(S, var="x")
    assert answer.case == case
    assert answer.verified
    again = kovacic.Solution.from_json(answer.to_json())
    assert again == answer
    assert again.verify()
    assert pickle.loads(pickle.dumps(answer)) == answer


def test_the_sextic_oscillator_of_the_literature() -> None:
    x = sympy.Symbol("x")
    answer = kovacic.solve(x**6 - 7 * x**2 + 2 * sympy.sqrt(2))
    assert str(answer.omega) == "(-2*x**5 - sqrt(2)*x**3 + 4*x)/(2*x**2 + sqrt(2))"
    omega = sympy.sympify(str(answer.omega))
    assert sympy.simplify(sympy.diff(omega, x) + omega**2 - (x**6 - 7 * x**2 + 2 * sympy.sqrt(2))) == 0


@parametrize(
    ("exponents", "case"),
    [((2, 3, 3), 3), ((2, 3, 4), 3), ((2, 3, 5), 3), ((2, 2, 5), 2), ((3, 5, 7), None)],
    ordinary=2,
)
@pytest.mark.parametrize("modulus", [[-2, 0, 1], [1, 0, 1], [-2, 0, 0, 1]])
def test_moved_by_an_algebraic_number(exponents: tuple[int, int, int], case: int | None, modulus: list[int]) -> None:
    """x -> x + alpha keeps the case; the poles aren't rational any more."""
    K = AlgebraicField(QQ, QQ.poly(modulus), "a")
    S = hypergeometric(*(Fraction(1, n) for n in exponents))
    moved = RatFunc(K.embed(S.num), K.embed(S.den))(RatFunc(K.poly([K.generator, 1])))
    answer = kovacic.solve(moved)
    assert answer.case == case
    assert answer.verified


def _has_the_right_case(example: Example) -> None:
    answer = kovacic.solve(example.S)
    assert answer.case == example.case, example
    assert answer.verified


@pytest.mark.long
@generated(8)
@given(strategies.over_number_fields())
def test_moved_by_a_moebius_map_over_a_number_field(example: Example) -> None:
    _has_the_right_case(example)


@pytest.mark.slow
@settings(max_examples=2000)
@given(strategies.over_number_fields())
def test_moved_by_moebius_maps_over_number_fields_in_the_long_run(example: Example) -> None:
    _has_the_right_case(example)


@pytest.mark.long
@generated(6)
@given(strategies.over_number_fields("case 1: diagonal"))
def test_two_omegas_over_a_number_field(example: Example) -> None:
    """Their constant is a square root over the field."""
    _has_the_right_case(example)


def test_a_square_root_beside_an_irrational_coefficient() -> None:
    answer = kovacic.solve("1/(x^2 + sqrt(2)*x + 3)^2")
    assert str(answer.omega) == "(2*x + c + sqrt(2))/(2*x**2 + 2*sqrt(2)*x + 6)"
    assert str(answer.constants) == "x**2 + 6"


@pytest.mark.parametrize("b", ["2^(1/12)", "sqrt(2)+sqrt(3)+sqrt(5)+sqrt(7)"])
def test_a_square_root_over_a_field_of_a_large_degree(b: str) -> None:
    """omega has sqrt(1 + b), which splits over all homomorphisms of a field of degree n at one prime in 2^n."""
    answer = kovacic.solve(f"({b})/(x^2-1)^2")
    assert answer.verified
    assert str(answer.group) == "G_m"


@pytest.mark.long
@generated(4)
@given(strategies.over_number_fields("case 1", "case 2", "odd"))
def test_closed_forms_over_a_number_field(example: Example) -> None:
    """Each is checked, exactly and to 50 digits, before it is returned."""
    assert len(kovacic.solve(example.S).solutions) == (2 if example.case else 0)


SUMS_OVER_ROOTS = {
    "one sum": "(5*x^2 - 10*a*x + 30)/(x^6 - 6*a*x^5 + 32*x^4 - 48*a*x^3 + 85*x^2 - 42*a*x + 18)",
    "in a cosine": "(-30*a - 45)/(64*x^4 + (16*a - 224)*x^3 + (-12*a + 342)*x^2 + (-10*a - 248)*x + 18*a + 83)",
    "real roots on a curve": "(551124*x^6 + (-2204496*a - 236196)*x^5 + (787320*a + 6471333)*x^4 + (-4193208*a - 1819584)*x^3"
    " + (839808*a + 2254068)*x^2 + (-195696*a - 232560)*x - 10848*a - 29964)/(419904*x^8 + (-2239488*a - 139968)*x^7"
    " + (653184*a + 9622800)*x^6 + (-10622016*a - 2379456)*x^5 + (2125440*a + 12773376)*x^4 + (-4147200*a - 1921536)*x^3"
    " + (414720*a + 1412928)*x^2 + (-114432*a - 77568)*x + 2560*a + 6912)",
    "two sums": "(210827008*x^4 + (1182137152*a - 673893472)*x^3 + (-3065058976*a + 5259111984)*x^2"
    " + (6091734880*a - 8533829024)*x - 3647406336*a + 6229521116)/(3764768*x^6 + (33345088*a - 17210368)*x^5"
    " + (-137913440*a + 254409960)*x^4 + (586118400*a - 815050320)*x^3 + (-1136651040*a + 1727911990)*x^2"
    " + (1366836632*a - 1647693278)*x - 514913230*a + 874489557)",
}


@parametrize("S", SUMS_OVER_ROOTS.values(), ordinary=1, long=2, ids=SUMS_OVER_ROOTS)
def test_sums_over_the_roots_of_irrational_polynomials(S: str) -> None:
    x = sympy.Symbol("x")
    for y in kovacic.solve(S.replace("a", "sqrt(2)"), var="x").solutions:
        assert pickle.loads(pickle.dumps(y)) == y
        assert y.subs(x, 2 * x).subs(x, x / 2) == y
        assert sympy.latex(y.diff(x)) + str(y.diff(x))


def test_constants_of_the_answer_over_the_field() -> None:
    answer = kovacic.solve("sqrt(2)", var="x")
    assert answer.constants is not None
    assert str(answer.constants) == "x**2 - sqrt(2)" or "sqrt(2)" in str(answer.constants)
    assert answer.constants.field == answer.S.field


def test_principal_values_are_told_apart() -> None:
    assert kovacic.solve("(sqrt(2) + sqrt(8) - 3*sqrt(2))*x + 1", var="x").S == 1
    assert kovacic.solve("(sqrt(6) - sqrt(2)*sqrt(3))*x + 1", var="x").S == 1
    assert kovacic.solve("((-8)^(1/3) - 1 - sqrt(-3))*x + 1", var="x").S == 1
    assert kovacic.solve("(sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2))*x + 1", var="x").S == 1
    assert kovacic.solve("(sqrt(2) + sqrt(3)*I - I*sqrt(3))*x^0 + x", var="x").case is None


def test_sympy_numbers() -> None:
    x, y = sympy.symbols("x y")
    assert kovacic.solve(sympy.cos(sympy.pi / 5) - (1 + sympy.sqrt(5)) / 4 + x**2 + 1).S.field == QQ
    assert kovacic.solve(x**2 + sympy.GoldenRatio).case is None
    root = sympy.CRootOf(y**3 - y - 1, 0)
    assert kovacic.solve(root**3 - root + x**2).case == 1
    assert kovacic.solve(sympy.AlgebraicNumber(sympy.sqrt(5), [1, 1]) * x**2).case is None
    assert kovacic.solve(sympy.pi * x).case is None


def test_conjugate_poles_stay_together() -> None:
    answer = kovacic.solve("1/(x^3-sqrt(2)) + 2/(x^2+1)", var="x")
    places = analyse(answer.S, Budget()).finite_places
    assert sorted(place.degree for place in places) == [2, 3]


def test_limits_on_the_field() -> None:
    with pytest.raises(kovacic.LimitExceeded, match="field of degree"):
        kovacic.solve("sqrt(2)*x + sqrt(3)", limits=Limits(constants=3))
    with pytest.raises(kovacic.LimitExceeded, match="field of degree 100"):  # factored, it would take minutes
        kovacic.solve("root(5, 12)*root(3, 100)*x")


@pytest.mark.parametrize("radicals", [(2,), (2, 3), (-1, 2, 3), (5, -7)])
def test_primitive_elements(radicals: tuple[int, ...]) -> None:
    S = function(" + ".join(f"sqrt({radicand})*x^{k}" for k, radicand in enumerate(radicals)), var="x")
    assert S.field.absolute_degree == 2 ** len(radicals)
    roots = [S.num[k] / S.den.lc for k in range(len(radicals))]
    assert [root * root for root in roots] == [*radicals]
    for j, one in enumerate(radicals):
        for k, other in enumerate(radicals[:j]):
            assert function(f"(sqrt({one})*sqrt({other}) - sqrt({one * other}))*x + 1", var="x") == 1
            assert roots[j] != roots[k]


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(2 - sqrt(3))",
        "sqrt(5 - 2*sqrt(5))",
        "sqrt(1 - sqrt(2))",
        "sqrt(3 - 2*sqrt(2))",
        "(2 - sqrt(3))**(1/3)",
        "sqrt(I - 2)",
        "sqrt(2) + sqrt(3 - sqrt(5))",
    ],
)
def test_a_nested_radical_has_its_principal_value(text: str) -> None:
    """By SymPy's number: not that of a conjugate, of which a nearer one may have a larger real part."""
    found = complex(kovacic.evaluate(f"y'' = ({text})*y", 1, x0=0, y0=1, dy0=0))
    assert abs(found - complex(sympy.cosh(sympy.sqrt(sympy.sympify(text))).evalf(20))) < 1e-12


@parametrize("modulus", [[-1, -1, 0, 0, 0, 1], [-1, -1, 0, 0, 0, 0, 0, 1], [1, -1, *[0] * 8, 1]], ordinary=1)
def test_fields_in_which_hardly_any_prime_splits(modulus: list[int]) -> None:
    """Groups S5, S7, S10: one prime in 120, 5040 or 3628800 splits, so elements are found by lattice reduction."""
    K = AlgebraicField(QQ, QQ.poly(modulus), "a")
    a = K.generator
    omega = RatFunc(K.poly([1, a]), K.poly([0, 1])) + RatFunc(K.poly([1]), K.poly([a * a - 1, 1]))
    answer = kovacic.solve(omega.derivative() + omega * omega)
    assert (answer.case, answer.omega, answer.verified) == (1, omega, True)
    assert kovacic.solve(RatFunc(K.poly([a]))).constants is not None
    S = hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 3))
    moved = kovacic.solve(RatFunc(K.embed(S.num), K.embed(S.den))(RatFunc(K.poly([a, 1]))))
    assert (moved.case, moved.verified) == (3, True)
    f, g = (K.poly([a, 1]) * K.poly([1, a]), K.poly([a, 1]) * K.poly([a * a, 0, 3]))
    assert f.gcd(g) == K.poly([a, 1])


def test_a_root_of_a_quintic_without_radicals() -> None:
    x, y = sympy.symbols("x y")
    root = sympy.CRootOf(y**5 - y - 1, 0)
    answer = kovacic.solve(root**2 * x**2 + 3 * root)
    assert answer.case == 1
    assert answer.verified
    assert any("alpha**5 - alpha - 1" in notice for notice in answer.notices)


@pytest.mark.long
def test_solutions_use_the_root_that_was_meant() -> None:
    """alpha = sqrt(1 + sqrt(2)) isn't its conjugate -alpha: checked numerically in the closed form."""
    x = sympy.Symbol("x", positive=True)
    for S, value in (
        ("sqrt(1+sqrt(2))/x^2", sympy.sqrt(1 + sympy.sqrt(2)) / x**2),
        (sympy.CRootOf(sympy.Symbol("y") ** 5 - sympy.Symbol("y") - 1, 0) / sympy.Symbol("x") ** 2, None),
    ):
        answer = kovacic.solve(S, var="x")
        expected = value if value is not None else S.subs(sympy.Symbol("x"), x)
        solution = answer.solutions[0].subs(sympy.Symbol("x"), x)
        residual = sympy.diff(solution, x, 2) / solution - expected
        assert abs(complex(residual.subs(x, sympy.Rational(7, 5)).evalf(20))) < 1e-12


# Razavy's (z cosh(2 x) - M)^2: E = z^2 + 3 +- 2 z for M = 2, z^2 + 5 and z^2 + 7 +- 2 sqrt(1 + 4 z^2) for M = 3.
@parametrize(
    "S, degree, energies",
    [
        ("(sqrt(2)*cosh(2*x)-3)^2 - E", 2, ["7", "3", "15"]),
        ("(sqrt(3)*cosh(2*x)-2)^2 - E", 1, ["6 + 2*sqrt(3)", "6 - 2*sqrt(3)"]),
        ("(sqrt(3)*cosh(2*x)-3)^2 - E", 2, ["8", "10 + 2*sqrt(13)", "10 - 2*sqrt(13)"]),
        ("(I*cosh(2*x)-3)^2 - E", 2, ["4", "6 + 2*sqrt(3)*I", "6 - 2*sqrt(3)*I"]),
        ("(I*sinh(2*x)-2)^2 - E", 1, ["2", "6"]),
        ("(sqrt(2)*(exp(2*x)+exp(-2*x))/2-3)^2 - E", 2, ["7", "3", "15"]),
        ("x^6+2*sqrt(2)*x^4-5*x^2-E", 2, ["3*sqrt(2) + 4", "3*sqrt(2) - 4"]),
    ],
    ordinary=(2,),
    long=1,
)
def test_degrees_that_only_an_algebraic_constant_makes_natural(S: str, degree: int, energies: list[str]) -> None:
    found = kovacic.conditions(S)
    (region,) = found.regions
    lines = region.determinants
    assert len(lines) == 3
    assert lines[0] == "d is never 0"
    name, value = lines[degree].split(" = ")
    assert name == f"Delta_{degree}"
    assert not {"(2)^2", "(3)^2"} & {value[k : k + 5] for k in range(len(value))}  # in lowest powers of the constant
    expected = sympy.Mul(*(sympy.Symbol("E") - read_expression(energy) for energy in energies))
    assert sympy.expand(read_expression(value) - expected) == 0
    for solution in region.solution(degree):
        assert all(condition.free_symbols == {sympy.Symbol("E")} for condition in solution.conditions)
    assert found.check(8)
    assert str(kovacic.solution.conditions.Conditions.from_json(found.to_json())) == str(found)
