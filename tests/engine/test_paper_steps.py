"""The steps of Kovacic's paper as explanations show them: exponents, families, degrees; they find what the engine finds."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
import strategies
import sympy
from build import QQ, Budget, analyse, generated, parametrize, size
from hypothesis import given

import kovacic
from kovacic.engine.families import Roots, natural
from kovacic.engine.paper import Search, in_sympy, search


def succeeds(found: Search) -> bool:
    """Has a family led to a solution?"""
    return any(family.P is not None for family in found.families or ())


def searched(answer: kovacic.Solution, m: int) -> Search:
    found = search(analyse(answer.S, Budget()), "x", m)
    assert found is not None
    return found


def values(family: Any) -> list[Any]:
    return [choice.value for choice in family.choices]


def test_kovacic_s_first_example_line_by_line() -> None:
    """Section 3.2: [sqrt r]_0 = 1/x^2, [sqrt r]_inf = x - 1, d = 2 and d = 0, P = x^2 - 1."""
    answer = kovacic.solve("(4*x^6 - 8*x^5 + 12*x^4 + 4*x^3 + 7*x^2 - 20*x + 4)/(4*x^4)")
    found, half = searched(answer, 1), Fraction(1, 2)
    assert [choices[0].singular for choices in found.choices] == [((1, 1), (0, -1)), ((-2, 1),)]
    assert [[choice.value for choice in choices] for choices in found.choices] == [
        [half, -3 * half],
        [-3 * half, 7 * half],
    ]
    assert (found.total, found.natural) == (4, 2)
    assert [family.d for family in found.families or ()] == [2, -3, 0, -5]
    assert [str(family.P) for family in found.families or ()] == ["x**2 - 1", "None", "None", "None"]
    assert (found.families or ())[2].conditions[0] == 4
    text = answer.explain(solutions=False)
    for line in (
        "infinity  x - 1     1/2     -3/2",
        "x = 0     x^(-2)    -3/2    7/2",
        "d = 2: P = x^2 - 1 is a solution.",
    ):
        assert line in text
    assert "see theta" not in text


def test_kovacic_s_second_example_line_by_line() -> None:
    """Section 4.2: E_0 = {1, 2, 3}, E_inf = {1}, the family (1, 1) with d = 0, P = 1."""
    answer = kovacic.solve("-3/(16*x^2) + 1/x")
    found = searched(answer, 2)
    assert [[choice.value for choice in choices] for choices in found.choices] == [[1], [1, 2, 3]]
    assert [(values(family), family.d, family.P) for family in found.families or ()] == [([1, 1], 0, 1)]
    assert answer.riccati is not None
    assert str(answer.riccati.coefficients[1]) == "-1/(2*x)"  # minus half of the logarithmic derivative of x


def test_kovacic_s_third_example_line_by_line() -> None:
    """Section 5.2, n = 4: (e_inf, e_1, e_0) = (7, 4, 3) succeeds, and (8, 5, 3): the group has two forms of degree 4."""
    found = searched(kovacic.solve("(-32*x^2 + 27*x - 27)/(144*x^2*(x-1)^2)"), 4)
    sets = [[choice.value for choice in choices] for choices in found.choices]
    assert sets == [[4, 5, 6, 7, 8], [4, 5, 6, 7, 8], [3, 6, 9]]
    outcomes = [(values(family), family.P) for family in found.families or ()]
    assert outcomes == [([7, 4, 3], 1), ([8, 5, 3], 1)]


@pytest.mark.long
@generated(8)
@given(strategies.examples("case", "odd"))
def test_the_paper_s_steps_find_what_the_engine_finds(example: strategies.Example) -> None:
    """A family succeeds for the degree of omega and for no smaller one; none does where there is no solution."""
    answer = kovacic.solve(example.S)
    problem = analyse(answer.S, Budget())
    for m in (1, 2, 4, 6, 12):
        irregular = any(place.order > 2 for place in problem.places)
        found = None if m > 2 and irregular else search(problem, "x", m)
        degree = None if answer.riccati is None else answer.riccati.degree
        if found is not None and succeeds(found):
            assert degree == m
        elif (
            found is not None
            and found.complete
            and all(f.theta is not None for f in found.families if natural(f.d) is not None)
        ):
            assert degree != m
        if degree == m:
            return


@pytest.mark.long
def test_conjugate_poles_are_taken_one_by_one() -> None:
    """2/(x^2+1)^2: alpha = (1 +- i)/2 at both poles, and opposite signs at i and -i succeed."""
    found = searched(kovacic.solve("2/(x^2+1)^2"), 1)
    assert found.complete
    assert found.total == 8
    successes = [family for family in found.families or () if family.P is not None]
    assert len(successes) == 2
    x = sympy.Symbol("x")
    for family in successes:
        P = in_sympy(family.P, x)
        omega = family.theta + sympy.diff(P, x) / P
        assert sympy.simplify(sympy.diff(omega, x) + omega**2 - 2 / (x**2 + 1) ** 2) == 0


def test_families_of_case_2_have_an_odd_exponent() -> None:
    """Those with even ones only belong to case 1, and aren't listed, however natural their d is."""
    odd = searched(kovacic.solve("-3/(16*x^2) - 3/(16*(x-1)^2) + 3/(16*x*(x-1))"), 2)
    assert odd.natural == 3
    even = searched(kovacic.solve("3/(4*x^2) + 3/(4*(x-1)^2) - 3/(4*x*(x-1))"), 2)
    assert even.natural == 0
    assert even.families == ()


def test_many_poles_are_counted() -> None:
    """13 poles with two exponents each, and infinity: too many families to be listed; their number is said."""
    S = " + ".join(f"2/(x-{k})^2" for k in range(1, 14))
    found = searched(kovacic.solve(S), 1)
    assert (found.total, found.families) == (2**14, None)
    assert "16384 families of exponents, d is" in kovacic.solve(S).explain(solutions=False)


def test_families_with_the_same_exponent_at_infinity_are_two() -> None:
    """exp(x) and exp(-x): alpha = 0 with [sqrt r] = 1 and with -1."""
    found = searched(kovacic.solve("1"), 1)
    assert (found.total, found.natural) == (2, 2)
    assert all(family.P == 1 for family in found.families or ())


def test_exponents_at_irregular_places() -> None:
    """S = x^2 + 3: a = 1, b = 3, nu = 1, so (+-3 - 1)/2."""
    (choices,) = searched(kovacic.solve("x^2 + 3"), 1).choices
    assert [choice.value for choice in choices] == [1, -2]


def test_families_with_parameters() -> None:
    """omega = a/x + b/(x-1): one family for generic a and b, with P = 1, and no other sum is a number."""
    answer = kovacic.solve("(a^2-a)/x^2 + (b^2-b)/(x-1)^2 + 2*a*b/(x*(x-1))", var="x")
    found, (a, b, x) = searched(answer, 1), sympy.symbols("a b x")
    assert (found.total, found.natural) == (8, 1)
    (success,) = [family for family in found.families or () if family.P is not None]
    assert (success.d, success.P) == (0, 1)
    assert sympy.simplify(success.theta - a / x - b / (x - 1)) == 0
    assert "d is a natural number in 1 of them for generic parameters" in answer.explain(solutions=False)


@parametrize(
    ("text", "tried"),
    [
        ("n/x^2", True),  # alpha has sqrt(4n + 1)
        ("(4*n^2 - 1)/(4*x^2) - 1", True),
        ("-3/(16*x^2) + n/x", True),
        ("n^2*x^2 + 3*n", True),
        ("n^2*x^2 + m", True),
        ("sqrt(2)/x^2", True),
        ("2*x^2 + 3*sqrt(2)", True),
        ("sqrt(2)/(x^2 + 1)^2", True),
        ("sqrt(1 + sqrt(2))*x^2 + 1", True),  # a root of a polynomial of degree 4, which is called alpha
        ("sqrt(2)*n/x^2 + 1", True),
        ("-3/(16*x^2) + (sqrt(2) + n)/x", True),
        ("1/(x^2 - n)^2", True),  # sqrt(n) and sqrt(n^2 + n)
        ("1/(x^2 - n)^2 + (x + sqrt(2))/(x^2 + n^2 + 1)", False),
    ],
    ordinary=2,
    long=(1, 4, 9, 12),
)
def test_the_steps_agree_with_the_engine_over_larger_fields(text: str, tried: bool) -> None:
    """The first degree with a solution is that of omega, and omega = theta + P'/P solves the Riccati equation."""
    answer = kovacic.solve(text, var="x")
    x, degree = sympy.Symbol("x"), None if answer.riccati is None else answer.riccati.degree
    ramified = any(place.order in (3, 5) for place in analyse(answer.S, Budget()).places)
    for m in range(2 if ramified else 1, (degree or 2) + 1):
        found = searched(answer, m)
        hopeful = [family for family in found.families or () if natural(family.d) is not None]
        assert found.complete
        assert succeeds(found) == (tried and degree == m)
        assert all((family.theta is not None) == tried for family in hopeful if family.P is not None or m == 1)
        for family in hopeful:
            if m == 1 and family.P is not None:
                P = in_sympy(family.P, x)
                omega = family.theta + sympy.diff(P, x) / P
                S = sympy.sympify(text.replace("^", "**"), locals={"n": sympy.Symbol("n")})
                residue = sympy.diff(omega, x) + omega**2 - S
                values = {"n": sympy.Rational(7, 5), "m": sympy.Rational(3, 7), "x": sympy.Rational(5, 3)}
                assert size(residue.subs(values), 30) < 1e-25
    assert "CRootOf" not in answer.explain(solutions=False)


def test_nested_square_roots_that_cancel_are_an_integer() -> None:
    """sqrt(9 + 9 sqrt(2)) is 3 sqrt(1 + sqrt(2)), and needs no larger field."""
    roots = Roots(QQ)
    two = roots.root(QQ.poly([2]))
    nested = roots.root(1 + two)
    field = roots.field
    multiple = roots.root(9 + 9 * two)
    assert roots.field is field
    assert field.absolute_degree == 4
    assert (natural(multiple / nested + 3) is None) != (natural(2 - multiple / nested) is None)
    assert natural((multiple - 3 * nested) * (multiple + 3 * nested) + 2) is not None
    assert natural(multiple - nested) is None


def test_a_single_family_is_one() -> None:
    """e = 3 at the pole of order 3, and -1 at infinity, where S grows like x: d = -2."""
    explained = kovacic.solve("x + 1/x^3").explain()
    assert "Step 2: d = (e_inf - sum e_c)/2; 1 family of exponents, d is a natural number in none of them" in explained


def test_families_over_a_field_of_degree_eight() -> None:
    # y = (x - c) exp(-(x - c)^2/2), the first excited state at c
    found = searched(kovacic.solve("(x - 2^(1/8))^2 - 3"), 1)
    assert [str(family.d) for family in found.families or () if family.P is not None] == ["1"]
