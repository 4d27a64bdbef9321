"""Generic parameters: the field Q(t), its lift, and the generic answers."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import Any

import pytest
import sympy
from build import QQ, AlgebraicField, FunctionField, Poly, RatFunc, parametrize, run
from hypothesis import given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import LimitExceeded, Limits, Status
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.lifting import Lifter
from kovacic.limits import Budget
from tests.parametric_cases import BALL

K = FunctionField(("s", "t"))
s, t = K.generator("s"), K.generator("t")
x = K.poly([0, 1])

small = st.integers(-3, 3)
monomials = st.tuples(st.integers(0, 3), st.integers(0, 2), st.integers(0, 2))


@st.composite
def polynomials(draw: st.DrawFn) -> Poly:
    """Over Q(s, t), with denominators."""
    total: Poly = K.poly([])
    for (i, j, k), c in draw(st.dictionaries(monomials, small, max_size=4)).items():
        total = total + c * x**i * s**j * t**k
    below = draw(small) + draw(small) * s + draw(small) * t
    return total / below if below else total


@settings(max_examples=25)
@given(polynomials(), polynomials(), st.integers(-5, 5), st.integers(-5, 5))
def test_arithmetic_commutes_with_evaluation(f: Poly, g: Poly, a: int, b: int) -> None:
    def at(h: Poly) -> Poly:
        assert isinstance(h, FunctionPoly)
        return h.value_at([Fraction(a, 7), Fraction(b, 11)], QQ)

    try:
        images = at(f), at(g)
    except ZeroDivisionError:
        return
    assert at(f + g) == images[0] + images[1]
    assert at(f * g) == images[0] * images[1]
    assert at(f.derivative()) == images[0].derivative()


@settings(max_examples=25)
@given(polynomials(), polynomials())
def test_division_and_common_divisors(f: Poly, g: Poly) -> None:
    if not g:
        return
    quotient, remainder = divmod(f, g)
    assert quotient * g + remainder == f
    assert remainder.degree < max(g.degree, 0) or not remainder
    assert (f * g).exact_quotient(g) == f
    common = (f * (x + s)).gcd(g * (x + s))
    assert not common % (x + s)
    assert not (f * (x + s)) % common
    assert common.is_monic
    assert pickle.loads(pickle.dumps(f)) == f
    assert hash(f + g) == hash(g + f)


OVER_PARAMETERS = AlgebraicField(K, K.poly([s * t + 1, s, 0, 1]), "c")


@pytest.mark.parametrize(
    ("field", "a", "b"),
    [
        (QQ, QQ.poly([Fraction(2, 3)]), QQ.poly([-5])),
        (AlgebraicField(QQ, QQ.poly([-5, 0, 1])), Fraction(2, 7), None),
        (K, s, -2 * t / (s + 3)),
        (K, -s * t - 1, s.inverse()),
        (OVER_PARAMETERS, s, None),
    ],
    ids=str,
)
def test_the_greatest_common_divisor_is_the_monic_one(field: Any, a: Any, b: Any) -> None:
    """Of multiples by constants as well, which have no part in it."""
    b = field.generator if b is None else b
    z = field.poly([0, 1])
    common = (z + a) * (z * z + b * z + a)
    assert (common * (z + 1) * a * b).gcd(common * (z - 1) * (a * a + b)) == common
    assert (common * b).gcd(field.poly([])) == common
    assert (common * a).gcd(common * (common + b) * b) == common
    assert (common * a).gcd(field.poly([b])) == 1


@settings(max_examples=10)
@given(st.lists(polynomials(), min_size=1, max_size=3))
def test_the_lift_recovers_polynomials_from_their_values(given_polynomials: list[Poly]) -> None:
    lifter = Lifter(K)
    for bundle in K.bundles():
        proposal = lifter.add(bundle, [[h(f) for f in given_polynomials] for h in bundle])
        if proposal == given_polynomials:
            return
        assert lifter.primes_used < 400
    raise AssertionError("the sequence of homomorphisms is infinite")


@pytest.mark.long
def test_large_coefficients_take_several_primes() -> None:
    f = K.poly([s * 10**40 + Fraction(1, 3**50), t / (s + 10**25)])
    lifter = Lifter(K)
    for bundle in K.bundles():
        if lifter.add(bundle, [[h(f)] for h in bundle]) == [f]:
            return
        assert lifter.primes_used < 400


def test_a_search_that_a_limit_breaks_off_begins_anew() -> None:
    """Its primes are remembered for the field; a generator that was broken off is at its end, and then a gcd was 1."""
    base = FunctionField(("E",))
    extended = AlgebraicField(base, base.poly([3, 1, 0, 0, 1]), "c")
    z, c = extended.poly([0, 1]), extended.generator
    with Budget(Limits(seconds=0)).watched(), pytest.raises(LimitExceeded):
        next(extended.bundles())
    assert ((z - c) * (z - 1)).gcd((z - c) * (z - 2)) == z - c


def test_a_linear_functional_that_is_the_identity_on_rational_numbers() -> None:
    def functional(f: Poly) -> Fraction:
        value = f.rational_coefficients()[0] if f else 0
        return Fraction(int(value.p), int(value.q)) if f else Fraction(0)

    f, g = 1 / (1 + s) if False else (1 + s).inverse(), (t + 5) * (s * t + s * s).inverse()
    assert functional(K.poly([Fraction(3, 7)])) == Fraction(3, 7)
    assert functional(f + g) == functional(f) + functional(g)
    assert functional(f) == 1


def test_factors_and_square_roots() -> None:
    f = (x**2 - s) * (x - t) ** 2 * (s + 1)
    assert K.factor(f) == [(x - t, 2), (x**2 - s, 1)]
    assert K.sqrt(4 * s * s * (t - 1) ** 2) in (2 * s * (t - 1), 2 * s * (1 - t))
    assert K.sqrt(s) is None
    assert K.sqrt(-(s**2)) is None


def test_a_tower_over_parameters() -> None:
    L = AlgebraicField(K, K.poly([-s, 0, 1]), "r")
    r = L.generator
    assert r * r == s
    assert (r + 1) * (r + 1).inverse() == 1
    f, g = (L.poly([0, 1]) - r) * (L.poly([0, 1]) + t), (L.poly([0, 1]) - r) * (L.poly([0, 1]) - 3)
    assert f.gcd(g) == L.poly([0, 1]) - r


GENERIC = [
    ("(4*n^2-1)/(4*x^2) - 1", None),
    ("n", 1),
    ("n^2", 1),
    ("x^2 + mu", None),
    ("a*x + b", None),
    ("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", 1),
    ("n*(n-1)/x^2 + 2*n*m + m^2*x^2 + m", 1),
    ("-3/(16*x^2) + q/x", 2),
    (BALL, 2),
    ("(2*n*x + x^2 + n^2 + 1)*t^2", None),
    ("x^2 + I*n", None),
    ("sqrt(2)*n/x^2", 1),
    ("-1/4/x^2 + n/x^3", None),
]


@parametrize(("S", "case"), GENERIC, ordinary=5)
def test_generic_answers_are_verified(S: str, case: int | None) -> None:
    answer = kovacic.solve(S, var="x")
    assert answer.case == case
    assert answer.verified
    assert any("parameter" in notice for notice in answer.notices)
    again = kovacic.Solution.from_json(answer.to_json())
    assert again == answer
    assert again.verify()


def test_the_ball_with_symbols() -> None:
    answer = kovacic.solve(BALL, var="x")
    assert answer.case == 2
    assert answer.riccati is not None
    k, x1, x2, X = sympy.symbols("k x1 x2 x")
    total = sympy.sympify(str(answer.riccati.coefficients[1]))
    expected = -sympy.Rational(1, 2) * (1 / (X - x1) + 1 / (X - x2))
    assert sympy.cancel(total - expected) == 0
    del k


def test_generic_answers_specialise_where_nothing_vanishes() -> None:
    """omega at random values of the parameters solves the Riccati equation of S at these values."""
    answer = kovacic.solve("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", var="x")
    assert answer.omega is not None
    X = sympy.Symbol("x")
    for values in ({"m": 2, "n": 3}, {"m": -1, "n": Fraction(1, 2)}, {"m": Fraction(5, 3), "n": 7}):
        chosen = {sympy.Symbol(name): sympy.Rational(str(value)) for name, value in values.items()}
        omega, S = (sympy.sympify(str(f)).subs(chosen) for f in (answer.omega, answer.S))
        assert sympy.cancel(sympy.diff(omega, X) + omega**2 - S) == 0


def test_the_conditions_of_a_generic_answer() -> None:
    conditions = kovacic.solve("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", var="x").generic_conditions
    assert {str(f) for f in conditions.nonzero} == {"m", "n", "n - 1"}
    assert [str(f) for f in conditions.irrational_squares] == ["4*n**2 - 4*n + 1"]
    ball = kovacic.solve(BALL, var="x").generic_conditions
    assert any(str(f) == "x1 - x2" for f in ball.nonzero)
    assert not kovacic.solve("x^2 + 3").generic_conditions


def test_sympy_input_with_parameters() -> None:
    X, n = sympy.symbols("x n")
    assert kovacic.solve((4 * n**2 - 1) / (4 * X**2) - 1).status is Status.NONE_EXISTS
    assert kovacic.solve(n**2 + 0 * X, var=X).case == 1


def test_many_equations_whose_omega_is_chosen() -> None:
    """omega first: S = omega' + omega^2 must give case 1, with a verified omega."""
    one = RatFunc(K.poly([1]))
    for omega in (one * s / x + t, one * (s - t) / (x - s) + one * t / x, one * s * x + one / (x * x - t)):
        answer = kovacic.solve(omega.derivative() + omega * omega)
        assert answer.case == 1
        assert answer.verified


def test_the_conditions_are_part_of_text_and_json() -> None:
    import json

    from kovacic.views.text import render

    answer = kovacic.solve("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", var="x")
    assert "m != 0, n != 0, n - 1 != 0" in "\n".join(render(answer))
    assert json.loads(answer.to_json())["generic_conditions"]["nonzero"] == ["m", "n", "n - 1"]
    assert json.loads(kovacic.solve("x^2 + 3").to_json())["generic_conditions"] is None


@pytest.mark.parametrize(
    ("words", "inside", "outside"),
    [
        (">sqrt(2)", ["3/2", "sqrt(3)", 7], ["7/5", 1, "-sqrt(3)", "I"]),
        ("0<E<20", ["1/2", 19, "sqrt(2)"], [0, 20, -1, "sqrt(401)"]),
        ("1/3 <= E < sqrt(10)", ["1/3", 3], ["1/4", "16/5"]),
        (">-sqrt(2), <sqrt(2), !=1", [0, "-7/5", "141/100"], [1, 2, "-3/2"]),
        ("integer, >sqrt(2)", [2, 3], [1, "5/2"]),
    ],
)
def test_bounds_that_are_no_rational_numbers_and_two_ends(words: str, inside: list[Any], outside: list[Any]) -> None:
    answer = kovacic.conditions("x^2 - E", var="x", assume={"E": words})
    for value in inside:
        assert answer.case_at({"E": value}) == kovacic.decide("x^2 - E", var="x", assume={"E": str(value)}).case
    for value in outside:
        with pytest.raises(kovacic.InputError, match="contradicts the assumption"):
            answer.case_at({"E": value})
    assert kovacic.parameters.Conditions.from_json(answer.to_json()) == answer


def test_a_bound_between_two_squares_excludes_them() -> None:
    """E + 3 can't vanish above -sqrt(8), and can above -sqrt(10)."""
    S = "x^2/(E + 3) - E"
    assert "S isn't defined" not in str(kovacic.conditions(S, var="x", assume={"E": ">-sqrt(8)"}))
    assert "S isn't defined" in str(kovacic.conditions(S, var="x", assume={"E": ">-sqrt(10)"}))
    assert "S isn't defined" not in str(kovacic.conditions(S, var="x", assume={"E": "!=-3"}))


def test_a_parameter_that_is_a_function_of_others() -> None:
    answer = kovacic.conditions("a*x^2 - E", var="x", assume={"a": "b^2", "b": "positive"})
    assert answer.parameters == ("b", "E")
    assert [str(region.statement) for region in answer.regions] == ["E/b is an odd integer"]
    for value in ("x^2", "a + 1", "!=sqrt(2)", ">I"):
        with pytest.raises(kovacic.InputError):
            kovacic.conditions("a*x^2 - E", var="x", assume={"a": value})


@pytest.mark.parametrize(
    ("S", "assume", "case"),
    [("x^2 - (2*n+1)", "nonnegative integer", 1), ("n*(n+1)/x^2 - 1", "integer", 1), ("x^2 - n", "odd", 1)],
)
def test_an_answer_for_all_values_with_assumptions_says_its_case(S: str, assume: str, case: int) -> None:
    """omega depends on n, so there is no certificate; but it isn't undecided, and the shell says so by its exit status."""
    answer = kovacic.solve(S, var="x", assume={"n": assume})
    assert answer.assumed
    assert f"case {case} for all values with n {assume}" in str(answer)
    assert "undecided" not in str(answer).lower()
    assert kovacic.decide(S, var="x", assume={"n": assume}).case == case
    assert run(["solve", "--no-solutions", "--assume", f"n={assume}", S]) == 0
