"""The kernel: its series, exponents and groups computed in another way, and forged answers that must fail."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product
from operator import mul
from typing import Any

import pytest
import strategies
import textbook
import transform
from build import QQ, AlgebraicField, Budget, Ground, Poly, RatFunc, analyse, generated, parametrize, verify
from flint import nmod_poly
from forged import (
    GroupClaim,
    Inspector,
    NoInvariant,
    NoRationalOmega,
    Rule,
    SemiInvariant,
    claimed,
    forged_evidence,
    inspector,
    primes_with_a_root,
)
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import InputError, LimitExceeded, Limits, Structure, VerificationFailed
from kovacic.engine.local import irregular_difference_squared
from kovacic.verify.factors import inverse, is_a_field, is_irreducible, quotient
from kovacic.verify.identity import form_numerators, is_normal_form
from kovacic.verify.primes import homomorphisms, roots_modulo
from kovacic.verify.series import (
    rational_candidate,
    solution_at_singular_point,
    solutions_at_ordinary_point,
    square_root_of_series,
)
from kovacic.verify.torsion import order_holds
from kovacic.verify.zeros import largest_natural_sum, residue_over_leading_root, zero_counts

X = RatFunc(QQ.poly([0, 1]))
PRIMES = [101, 10007, (1 << 61) - 1]


# ------------------------------------------------------------------------------------------- series


SERIES = st.lists(st.integers(0, PRIMES[-1] - 1), min_size=1, max_size=9)


@given(SERIES, SERIES, SERIES, st.integers(1, 130))
def test_series_at_a_singular_point_solve_the_equation(
    second: list[int], first: list[int], zeroth: list[int], count: int
) -> None:
    """second u'' + first u' + zeroth u = 0 as far as the terms go, over several blocks of terms."""
    p = PRIMES[-1]
    a, b, c = nmod_poly([0, 1, *second], p), nmod_poly([2, *first], p), nmod_poly(zeroth, p)
    u = solution_at_singular_point(a, b, c, count)
    assert int(u[0]) == 1
    assert u.degree() < count
    slope = u.derivative()
    assert not (a * slope.derivative() + b * slope + c * u).truncate(count - 1)


@given(st.lists(st.integers(-5, 5), max_size=5), st.integers(1, 100))
def test_square_roots_of_series_have_their_squares(tail: list[int], count: int) -> None:
    p = PRIMES[-1]
    series = nmod_poly([9, *(c % p for c in tail)], p)
    for root in (3, p - 3):
        found = square_root_of_series(series, root, count)
        assert int(found[0]) == root
        assert not (found * found - series).truncate(count)


@given(SERIES, SERIES)
def test_a_rational_function_is_found_from_its_expansion(above: list[int], below: list[int]) -> None:
    p = PRIMES[-1]
    A, B = nmod_poly(above, p), nmod_poly([1, *below], p)
    count = len(above) + len(below) + 3
    found_A, found_B = rational_candidate(A.mul_low(B.inverse_series_trunc(count), count), count, len(above))
    assert found_A * B == A * found_B
    assert found_A.degree() <= A.degree()


@given(
    st.lists(st.integers(-5, 5), min_size=1, max_size=6), st.lists(st.integers(-5, 5), max_size=4), st.integers(2, 70)
)
def test_series_at_an_ordinary_point_solve_the_equation(above: list[int], below: list[int], count: int) -> None:
    """den y'' = num y as far as the terms go, for y1 = 1 + O(t^2) and y2 = t + O(t^2)."""
    p = PRIMES[-1]
    num, den = nmod_poly([c % p for c in above], p), nmod_poly([3, *(c % p for c in below)], p)
    for k, y in enumerate(solutions_at_ordinary_point(num, den, count)):
        assert [int(c) for c in y.truncate(2).coeffs()] == [0] * k + [1]
        assert not (den * y.derivative().derivative() - num * y).truncate(count - 2)


@pytest.mark.parametrize("p", ["x^2+1", "x^2+x-1", "x^3-2"])
@pytest.mark.parametrize("b", ["0", "1", "3*x", "8*x"])
@pytest.mark.parametrize("d", [0, 1, 2])
def test_the_degree_bound_with_conjugate_irregular_poles(p: str, b: str, d: int) -> None:
    """The record of the search has the number of zeros that the kernel finds; else the check of the answer fails."""
    answer = kovacic.solve(f"1/({p})^4 + ({b})/({p})^3 + {d}")
    assert answer.case is None
    assert answer.verified


# ------------------------------------------------------------------------------------------- exponents


def exponent_difference_squared(N: Any, q: Any, p: Any, nu: int) -> Any:
    """(2 r)^2 for the residue r of sqrt(N/(p^(2 nu) q)), by the kernel."""
    return 4 * N * q * residue_over_leading_root(N, q, p, nu) ** 2 % p


@settings(max_examples=12)
@given(st.data())
def test_exponents_at_irregular_places_are_those_of_the_square_root(data: st.DataObject) -> None:
    """The residue of sqrt(S) at a rational point, term by term: S = (sum a_i t^(i-nu))^2 + O(t^(-nu))."""
    nu, c = data.draw(st.integers(1, 7)), data.draw(strategies.integers(4))
    a = [data.draw(strategies.fractions(5)) for _ in range(nu)]
    assume(a[0])
    t = X - c
    root = sum((t ** (i - nu) * value for i, value in enumerate(a)), X * 0)
    S = root * root + t ** (-nu) * data.draw(strategies.integers(3))
    p = QQ.poly([-c, 1])
    q, order = S.den.remove(p)
    assert order == 2 * nu
    assert exponent_difference_squared(S.num, q, p, nu) == 4 * a[-1] * a[-1]


@settings(max_examples=15)
@given(strategies.irreducibles(3), st.integers(1, 4), strategies.polynomials(0, 6), strategies.polynomials(0, 2))
def test_exponents_at_conjugate_places_by_taylors_formula(p: Any, nu: int, M: Any, q: Any) -> None:
    """sqrt(S) = M/p^nu is rational, so that r is its residue; S = M^2 q/(p^(2 nu) q)."""
    assume(p.gcd(M * q).degree == 0)
    assert exponent_difference_squared(M * M * q, q, p, nu) == 4 * _residue(M, p, nu) ** 2 % p


@settings(max_examples=20)
@given(strategies.irreducibles(3), st.integers(2, 4), strategies.polynomials(0, 8), strategies.polynomials(0, 2))
def test_the_search_and_the_kernel_find_the_same_exponents_at_irregular_places(p: Any, nu: int, N: Any, q: Any) -> None:
    assume(p.gcd(N * q).degree == 0)
    problem = analyse(RatFunc(N, p ** (2 * nu) * q), Budget())
    place = next(place for place in problem.finite_places if place.factor == p)
    assert irregular_difference_squared(place) == exponent_difference_squared(N, q, p, nu)


@settings(max_examples=10)
@given(strategies.irreducibles(3), st.integers(5, 9), strategies.polynomials(0, 26))
def test_exponents_of_the_search_with_long_numerators(p: Any, nu: int, M: Any) -> None:
    """sqrt(S) = M/p^nu: its residue at the class of x, and the difference of the exponents is twice that."""
    assume(p.gcd(M).degree == 0)
    place = analyse(RatFunc(M * M, p ** (2 * nu)), Budget()).places[0]
    assert irregular_difference_squared(place) == 4 * _residue(M, p, nu) ** 2 % p


def _residue(M: Any, p: Any, nu: int) -> Any:
    """The residue of M/p^nu at the class of x: the coefficient of t^(nu-1) in M(x+t) (t/p(x+t))^nu, by Taylor's formula."""
    terms, current = [], p
    for k in range(1, nu + 1):
        current = current.derivative() / k
        terms.append(current % p)
    inverse = [terms[0].inverse_modulo(p)]
    for k in range(1, nu):
        inverse.append(-sum((terms[j] * inverse[k - j] for j in range(1, k + 1)), M * 0) * inverse[0] % p)
    series, current = [], M
    for k in range(nu):
        series.append(current % p)
        current = current.derivative() / (k + 1)
    for _ in range(nu):
        series = [sum((series[i] * inverse[k - i] for i in range(k + 1)), M * 0) % p for k in range(nu)]
    return series[nu - 1]


# ------------------------------------------------------------------------------------------- groups

NAMED = {
    "0": ("cyclic", 1),
    "2": ("multiplicative", None),
    "2/x^2": ("cyclic", 1),
    "3/(4*x^2)": ("cyclic", 2),
    "-2/(9*x^2)": ("cyclic", 3),
    "x^2 + 3": ("borel", None),
    "(-4*x^2 + 3)/(4*x^2) + 1": ("cyclic", 2),
    "-1/(4*x^2)": ("additive", 2),
    "1/x - 3/(16*x^2)": ("infinite dihedral", None),
    "-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))": ("tetrahedral", None),
    "(160*x^2 - 88*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)": ("dicyclic", 3),  # 1/2, 3/2, 7/3: y1 y2 has an ordinary zero
    "x": ("SL2", None),
    "(-x^2+1)/(4*x^2)": None,
    "(-108*x^2 - 756*x - 27)/(256*x^6 - 384*x^4 - 896*x^3 + 144*x^2 + 672*x + 784)": ("dicyclic", 2),
}
FAMILIES = ["cyclic", "multiplicative", "additive", "borel", "dicyclic", "infinite dihedral", "tetrahedral", "SL2"]


@pytest.mark.parametrize("text", [text for text, claim in NAMED.items() if claim is not None])
def test_the_group_is_the_named_one_and_no_other(text: str) -> None:
    answer = kovacic.solve(text)
    assert answer.group is not None
    family, n = NAMED[text] or ("", None)
    assert (answer.group.kind.value, answer.group.n) == (family, n)
    for other in FAMILIES:
        for k in (None, 1, 2, 3, 6):
            verification = verify(answer.S, answer.decision, claimed(GroupClaim(other, k, answer.group.form)))
            assert bool(verification) is ((other, k) == (family, n)), (other, k)


SCHWARZ = [transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, n)).to_str("x") for n in (4, 5)]


@pytest.mark.parametrize("text", [*NAMED, *SCHWARZ])
def test_the_size_of_the_group_is_checked_with_its_name(text: str) -> None:
    """A quarter of the order, none, or another dimension, which a fault in `galois.group` may say of the right family."""
    answer = kovacic.solve(text)
    claim = answer.group.claim
    assert verify(answer.S, answer.decision, claim)
    sizes = [
        (None, None),
        (claim.n, claim.dimension),
        (None, 1),
        (None, 2),
        (None, 3),
        (24, 0),
        (48, 0),
        (120, 0),
        (7, 0),
    ]
    for order, dimension in sizes:
        wrong = replace(claim, order=order, dimension=dimension)
        assert wrong == claim or not verify(answer.S, answer.decision, wrong), wrong


@pytest.mark.long
@generated(30)
@given(strategies.examples(), st.sampled_from(FAMILIES), st.sampled_from([None, 1, 2, 3, 4, 5, 6]))
def test_every_group_is_confirmed_and_a_random_other_one_refuted(
    example: strategies.Example, family: str, n: int | None
) -> None:
    answer = kovacic.solve((example.S.num.coefficients(), example.S.den.coefficients()))  # type: ignore[attr-defined]
    group = answer.group
    assert group is not None
    right = verify(answer.S, answer.decision, group.claim)
    assert right
    if (family, n) != (group.kind.value, group.n):
        wrong = verify(answer.S, answer.decision, claimed(group.claim, family=family, n=n))
        assert not wrong or (wrong.unchecked and right.unchecked)


@pytest.mark.parametrize(
    ("text", "group"),
    [
        ("999999*10^6/x^2", "trivial"),
        ("(10^12 - 1)/(4*x^2)", "mu_2"),
        ("(10^14 - 9)/(36*x^2)", "mu_6"),
        ("10^6*(10^6 - 1)/x^2 + 2*10^6/x + 1", None),
    ],
)
def test_groups_of_solutions_with_huge_exponents(text: str, group: str | None) -> None:
    """x^n and x^(1-n) for n = 10^6, n = (1 + 10^6)/2, n = 1/2 + 10^7/6; and x^n e^x, where one omega alone is at hand."""
    answer = kovacic.solve(text)
    assert answer.case == 1
    assert (None if answer.group is None else str(answer.group)) == group


def test_an_order_on_a_curve_of_positive_genus_needs_its_function() -> None:
    """The order 12 over x^3 + x + 1: without the function u^3, or with another one, it isn't confirmed."""
    third = transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, 3))
    answer = kovacic.solve((S := transform.pull_back(third, X**3 + X + 1)).to_str("x"))
    group, f = answer.group, answer.semi_invariant
    assert group is not None
    assert f is not None
    assert group.order == 12
    function = group.function
    assert function is not None
    assert verify(S, answer.decision, group.claim)
    first, *others = function.pieces
    raised = replace(first, exponent=first.exponent + 1)
    other = replace(first, a=first.a + 1)
    forged = [
        None,
        replace(function, pieces=()),
        replace(function, pieces=(raised, *others)),
        replace(function, pieces=(other, *others)),
        replace(function, h=function.h * 2),
        replace(function, h=function.h + 1),
        replace(function, rest=function.rest + 1),
        replace(function, multiple=2 * function.multiple),
    ]
    for wrong in forged:
        assert not verify(S, answer.decision, replace(group.claim, function=wrong))
    for n in (1, 2, 4, 6):
        assert not verify(S, answer.decision, claimed(group.claim, n=n))
    assert not verify(S, answer.decision, claimed(group.claim, family="infinite dihedral"))
    for k in (2, 3, 4):  # a power of the function, which a smaller order explains
        pieces = tuple(replace(piece, exponent=k * piece.exponent) for piece in function.pieces)
        power = replace(function, multiple=3 * k, pieces=pieces)
        assert not verify(S, answer.decision, claimed(group.claim, n=3 * k, function=power))


@pytest.mark.parametrize(
    ("pole", "written_as_power", "powers"), [(-1, True, (2, 3, 4, 5, 7)), (1, True, (3,)), (1, False, (2, 5))]
)
def test_powers_of_the_function_show_no_larger_order(
    pole: int, written_as_power: bool, powers: tuple[int, ...]
) -> None:
    """u^3 is a function a + b y of the norm c (x - pole)^2; its powers would explain the orders 4 * 3k as well.

    They are written as powers, or multiplied out, so that the norm is a higher power.
    """
    third = transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, 3))
    answer = kovacic.solve(transform.pull_back(third, (X**2 + 3 * X + 5) / (X - pole)))
    function = answer.group.function
    assert answer.verify()
    (piece,) = function.pieces
    a, b = piece.a, piece.b
    for k in range(2, max(powers) + 1):
        a, b = a * piece.a + function.h * b * piece.b, a * piece.b + b * piece.a
        if k in powers:
            shown = replace(piece, exponent=k) if written_as_power else replace(piece, a=a, b=b)
            power = replace(function, multiple=3 * k, pieces=(shown,))
            assert not verify(answer.S, answer.decision, claimed(answer.group.claim, n=3 * k, function=power))


# ------------------------------------------------------------------------------------------- forged answers


@pytest.mark.parametrize(
    ("text", "invariant"),
    [
        ("2", None),
        ("3/(4*x^2)", None),
        (
            "-3/(16*x^2)",
            {"degree": 2, "theta": "1/(2*x)", "P": "1"},
        ),  # the square of x^(1/4), a form that isn't rational
        ("x^2 + 3", {"degree": 2, "theta": "0", "P": "1"}),
        ("x^2 + 3", {"degree": 2, "theta": "-2/x", "P": "x^4 + 1"}),
        ("1/x - 3/(16*x^2)", None),
        ("-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))", None),
    ],
)
def test_a_forged_invariant_fails(text: str, invariant: Any) -> None:
    data = json.loads(kovacic.solve(text).to_json())
    assert data["proof"]["invariant"] != invariant
    data["proof"]["invariant"] = invariant
    forged = kovacic.Solution.from_json(data, unverified=True)
    if invariant is None and forged.case == 1:  # nothing but the group could depend on it, and that finds one by itself
        assert str(forged.group) == str(kovacic.solve(text).group)
    else:
        assert not forged.verified
        assert not forged.verify()
        with pytest.raises(VerificationFailed):
            _ = forged.group


def test_a_solution_by_a_series_comes_without_another_one() -> None:
    answer, other = kovacic.solve("x^2 + 2000000001"), kovacic.solve("x^2 + 3")
    decision = answer.decision
    assert decision.series is not None
    assert verify(answer.S, decision)
    assert not verify(answer.S, replace(decision, riccati=other.decision.riccati))
    assert not verify(answer.S, replace(decision, semi_invariant=other.decision.semi_invariant))


@pytest.mark.parametrize("text", ["1000001000000/x^2 + 1", "(x^2 - 2)*y'' + 2*x*y' - 1000001000000*y = 0"])
def test_no_group_is_confirmed_by_a_series_that_may_not_be_the_only_one(text: str) -> None:
    """exp(x) P and exp(-x) Q solve the first equation, so the group is G_m; the second one's poles aren't rational."""
    answer = kovacic.solve(text)
    assert answer.decision.series is not None
    for family, n in (("borel", None), ("additive", 2)):
        assert verify(answer.S, answer.decision, claimed(GroupClaim(family, n))).unchecked


def test_an_irregular_place_has_no_exponent_difference() -> None:
    """Of such a place the rules say that it is irregular, and nothing of exponents."""
    data = json.loads(kovacic.solve("x").to_json())
    item = data["proof"]["excluded"][2]["evidence"][0]
    assert item["rule"] == "irregular"
    item |= {"rule": "exponents", "statement": Rule.EXPONENTS.value}
    with pytest.raises(VerificationFailed):
        kovacic.Solution.from_json(data)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 6])
def test_places_that_are_expanded_together_are_as_each_alone(order: int) -> None:
    """S = N/(p^k q) modulo p^nu, beside places of other orders."""
    linear = [QQ.poly([-c, 1]) for c in range(5)]
    quadratic = [QQ.poly([c, 1, 1]) for c in range(2, 5)]
    den = QQ.poly([7, 0, 1]) * QQ.poly([8, 0, 1]) ** 5
    for p in (*linear, *quadratic):
        den = den * p**order
    S = RatFunc(QQ.poly([3, 1, 4, 1, 5, 9, 2, 6, 5, 11]), den)
    for point in inspector(S).points[:-1]:
        p, k = point.factor, point.order
        modulus = p ** max(k // 2, 1)
        assert point.near == (S.num % modulus, S.den // p**k % modulus)


def test_roots_modulo_a_prime_are_simple_ones() -> None:
    """A double root may be one of a ramified prime, where a square needn't be one in the residue field of p."""
    h = next(homomorphisms(QQ))
    assert roots_modulo(QQ.poly([-h.p, 0, 1]), h) == []
    assert roots_modulo(QQ.poly([0, -4, 0, 1]), h) == [0, 2, h.p - 2]
    assert roots_modulo(QQ.poly([-2, 1]) * QQ.poly([3, 1]) ** 2, h) == [2]


@pytest.mark.parametrize("text", ["3/(4*x^2)", "1/x - 3/(16*x^2)", "-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))"])
def test_an_invariant_that_is_almost_a_power_of_the_semi_invariant_fails(text: str) -> None:
    """Another P, theta or degree than those of the invariant: y1^2, (y1 y2)^2, or the tetrahedral form of degree 6."""
    answer = kovacic.solve(text)
    decision, F = answer.decision, answer.decision.invariant
    assert F is not None
    assert verify(answer.S, decision)
    factor = QQ.poly([7, 1, 1])
    for wrong in (
        replace(F, P=F.P * factor),
        replace(F, P=F.P + factor * X.num),
        replace(F, theta=F.theta + RatFunc(factor.derivative(), factor)),
        replace(F, theta=F.theta + 3 / (X - 5)),
        replace(F, degree=2 * F.degree),
    ):
        assert not verify(answer.S, replace(decision, invariant=wrong)), wrong


def test_the_zeros_of_the_form_are_ordinary_points() -> None:
    """A factor moved from theta to P leaves the logarithmic derivative as it is, and would change the group's order."""
    answer = kovacic.solve("(-35*x^2 + 35*x - 27)/(144*x^2*(x-1)^2) - 1/(16*x^2)")
    decision = kovacic.solve("1/x - 3/(16*x^2)").decision
    f, riccati = decision.semi_invariant, decision.riccati
    assert answer.verified
    assert f is not None
    assert riccati is not None
    x = QQ.poly([0, 1])
    moved = replace(
        decision,
        semi_invariant=replace(f, theta=f.theta - RatFunc(QQ.poly([1]), x), P=f.P * x),
        riccati=replace(riccati, P=riccati.P * x, numerators=tuple(A * x for A in riccati.numerators)),
    )
    S = kovacic.solve("1/x - 3/(16*x^2)").S
    assert verify(S, decision)
    assert not verify(S, moved)


def paths(data: Any, prefix: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every place of a JSON object."""
    yield prefix
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield from paths(value, (*prefix, key))


WRONG = [None, True, 3, -1, 0.5, "7", "x", "", [], {}, ["x"], 10**30, "1/0", "y'' + (", "infinity"]


@parametrize(
    "text", ["2", "x", "x^2 + 3", "1/x - 3/(16*x^2)", "sqrt(2)/x^2", "x^4 + 6*x"], ordinary=0, long=(1, 2, 3, 5)
)
def test_a_field_of_another_type_or_value_fails_or_is_refused_or_says_the_same(text: str) -> None:
    """Another point, or a multiple of a form, may be right as well."""

    def said(answer: kovacic.Solution) -> tuple[Any, ...]:
        coefficients = None if answer.riccati is None else answer.riccati.coefficients
        structures = [exclusion.structure for exclusion in answer.proof]
        return answer.S, answer.case, answer.reason, coefficients, answer.group, structures

    original = kovacic.solve(text)
    line = original.to_json()
    for path in paths(json.loads(line)):
        for wrong in WRONG if path else ():
            data = json.loads(line)
            place = data
            for key in path[:-1]:
                place = place[key]
            if place[path[-1]] == wrong:
                continue
            place[path[-1]] = wrong
            try:
                forged = kovacic.Solution.from_json(data, unverified=True)
                passed = bool(forged.verify())
            except (InputError, LimitExceeded):
                continue
            assert not passed or said(forged) == said(original), (path, wrong)
            assert passed == forged.verified


def test_a_constant_with_a_reducible_polynomial_fails() -> None:
    """omega = c with c^2 - 1 = 0 for S = 1: every identity holds, but Q(c) is no field, and omega = 1 lies over Q."""
    decision = kovacic.solve("2").decision
    assert decision.semi_invariant is not None
    assert decision.riccati is not None

    def with_constant(square: int) -> Any:
        field = AlgebraicField(QQ, QQ.poly([-square, 0, 1]))
        c, one = field.generator, field.poly([1])
        form = SemiInvariant(1, RatFunc(c), one)
        riccati = replace(decision.riccati, P=one, D=QQ.poly([1]), numerators=(one, c))
        return replace(decision, semi_invariant=form, riccati=riccati)

    assert verify(RatFunc(QQ.poly([2])), with_constant(2))
    assert not verify(RatFunc(QQ.poly([1])), with_constant(1))
    assert not verify(RatFunc(QQ.poly([4])), with_constant(4))


def test_a_claim_beside_the_proof_fails() -> None:
    """A solution beside a "no" or beside "undecided", and an exclusion that isn't needed."""
    no, yes = kovacic.solve("x").decision, kovacic.solve("x^2 + 3").decision
    x, S = kovacic.solve("x").S, kovacic.solve("x^2 + 3").S
    assert verify(x, no)
    for part in ("invariant", "semi_invariant", "riccati"):
        form = getattr(kovacic.solve("2").decision, part)
        assert form is not None
        assert not verify(x, replace(no, **{part: form}))
    assert not verify(S, replace(yes, undecided="a limit was reached"))
    assert not verify(S, replace(yes, exclusions=no.exclusions))
    assert not verify(x, replace(no, exclusions=(*no.exclusions, no.exclusions[0])))
    assert not verify(x, replace(no, exclusions=no.exclusions[::-1]))


SOLVABLE = {
    "x^2 + 3": Structure.REDUCIBLE,
    "x^2 + 1": Structure.REDUCIBLE,
    "x^2 - 1 + 2/x^2": Structure.REDUCIBLE,
    "(x+1)^2 + 3": Structure.REDUCIBLE,  # at infinity, the second term of sqrt(S) isn't zero
    "1/x^4": Structure.REDUCIBLE,
    "1/x^2": Structure.REDUCIBLE,  # an irrational exponent difference
    "2": Structure.REDUCIBLE,
    "3/(4*x^2)": Structure.REDUCIBLE,
    "-1/(4*x^2)": Structure.REDUCIBLE,
    "(16*x - 3)/(16*x^2)": Structure.IMPRIMITIVE,
    "1/x - 3/(16*x^2)": Structure.IMPRIMITIVE,
    "-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))": Structure.TETRAHEDRAL,
    "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)": Structure.OCTAHEDRAL,  # 1/2, 1/3, 1/4
    "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)": Structure.ICOSAHEDRAL,  # 1/2, 1/3, 1/5
}

# The same groups with an apparent singularity, where the exponent difference is 2.
SOLVABLE |= {
    str(transform.pull_back(transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), third), X**2 + 5)): structure
    for third, structure in zip((Fraction(1, 3), Fraction(1, 4), Fraction(1, 5)), [*Structure][2:], strict=True)
}


@pytest.mark.parametrize("text", SOLVABLE)
def test_no_evidence_with_the_kernels_own_bounds_excludes_the_structure_of_the_group(text: str) -> None:
    """Without evidence of uniqueness, RAMIFIED at an unramified place, two branch points, an omega that exists, ..."""
    S = kovacic.solve(text).S
    kernel = inspector(S)
    for evidence in forged_evidence(S, SOLVABLE[text]):
        assert not kernel.excludes(SOLVABLE[text], evidence), evidence


def test_a_prime_at_which_two_places_meet_shows_nothing() -> None:
    """omega = 1/(3x) + 1/(5(x - 101)) + 1 is there, and modulo 101 the places x and x - 101 are one."""
    S = transform.from_omega(Fraction(1, 3) / X + Fraction(1, 5) / (X - 101) + 1)
    kernel = inspector(S)
    largest = kernel.zero_counts.largest
    for name in ("x", "x - 101", "infinity"):
        evidence = (NoInvariant(2), NoRationalOmega(largest, 101, name))
        assert not kernel.excludes(Structure.REDUCIBLE, evidence)
        assert not kernel.holds(evidence[1], Structure.REDUCIBLE)


def test_only_an_odd_prime_at_which_the_exponents_differ_shows_that_there_is_no_omega() -> None:
    """(7 x^2 + 1)^2 + 14 x + 1 has the leading coefficient 49, 0 modulo 7, where the two formal solutions are one."""
    kernel = inspector((7 * X**2 + 1) ** 2 + 14 * X + 1)
    largest = kernel.zero_counts.largest
    usable = [prime for prime in (-7, 0, 1, 2, 7, 9, 101, 2**61 - 1) if shows_no_omega(kernel, largest, prime)]
    assert usable == [101, 2**61 - 1]


def shows_no_omega(kernel: Inspector, largest: int, prime: int) -> bool:
    return kernel.holds(NoRationalOmega(largest, prime, "infinity"), Structure.REDUCIBLE)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x^2 + 3", {"infinity": True}),
        ("x", {"infinity": False}),  # ramified
        ("1/x^4", {"x": True, "infinity": False}),  # infinity is an ordinary point
        ("2/x^2 + 1", {"x": False, "infinity": True}),  # Delta = 3 without a logarithm
        ("1/x + 1", {"x": True, "infinity": True}),  # a logarithm
        ("2/x^2 + 1/x + x^2", {"x": True, "infinity": True}),  # 3 is no multiple of 4, but one of 1
        ("(16*x - 3)/(16*x^2)", {"x": True, "infinity": False}),
        ("1/x^2", {"x": True, "infinity": True}),  # an irrational Delta
        ("1/x^5 + 1", {"x": False, "infinity": True}),
    ],
)
def test_which_places_tell_the_solutions_apart(text: str, expected: dict[str, bool]) -> None:
    kernel = inspector(kovacic.solve(text).S)
    assert {p.name: p.tells_solutions_apart for p in kernel.points} == expected


@pytest.mark.parametrize(
    "omega",
    [1 + 1 / X**3, X + 1 / X**2, 2 + 1 / X**4 + 1 / (X - 1), 1 / X**3 + 1 / (X - 2) ** 2, X**2 + 3 / X**5,
     1 + 1 / X, 1 + 2 / X, X + 3 / X, 1 + 1 / (3 * X), 1 + 2 / (3 * X), X - 1 / (4 * X) + 3 / (5 * (X - 1)), X + 5 / (4 * X)],
    ids=str,
)  # fmt: skip
def test_a_rational_omega_is_found_from_every_place(omega: RatFunc) -> None:
    """Irregular at 0 and elsewhere: the degree of its numerator follows from the orders of both ends of the chart.

    And from regular places where it has the larger or the smaller one of two exponents that differ by a fraction.
    """
    kernel = inspector(omega.derivative() + omega**2)
    counts, prime = zero_counts(kernel.points), next(QQ.homomorphisms()).p
    assert counts is not None
    for point in kernel.points:
        if point.tells_solutions_apart:
            evidence = (NoInvariant(2, prime, 3, 0), NoRationalOmega(counts.largest, prime, point.name))
            assert not kernel.holds(evidence[1], Structure.REDUCIBLE), point.name
            assert not kernel.excludes(Structure.REDUCIBLE, evidence)


@pytest.mark.parametrize(
    "omega",
    [
        (X + 1) / (X**2 - 2),
        (X + 1) / (X**2 - 3) + 1,
        (2 * X + 3) / (X**2 + 1) + 1 / (X - 1),
        (X**2 - 5) / (X**3 - 2) + X,
    ],
    ids=str,
)
def test_a_rational_omega_is_found_from_conjugate_places(omega: RatFunc) -> None:
    """Its residues there are irrational, and conjugate: no prime with a root makes a proof against it."""
    kernel = inspector(omega.derivative() + omega**2)
    counts = kernel.zero_counts
    assert counts is not None
    for point in kernel.points:
        for prime in islice(primes_with_a_root(point.factor), 3 if point.factor.degree > 1 else 0):
            assert not kernel.holds(NoRationalOmega(counts.largest, prime, point.name), Structure.REDUCIBLE)


@settings(max_examples=25)
@given(
    st.fractions(-5, 5, max_denominator=12),
    st.lists(st.fractions(-3, 3, max_denominator=12), max_size=5),
)
def test_the_largest_natural_sum_is_that_of_all_signs(total: Fraction, choices: list[Fraction]) -> None:
    sums = [total + sum(map(mul, choices, signs)) for signs in product((1, -1), repeat=len(choices))]
    natural = [int(value) for value in sums if value.denominator == 1 and value >= 0]
    assert largest_natural_sum(total, choices) == max(natural, default=-1)


def test_a_sum_with_too_many_fractional_parts_is_bounded() -> None:
    primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43]
    choices = [Fraction(p + 1, p) for p in primes]
    assert largest_natural_sum(Fraction(1, 3), choices) == int(Fraction(1, 3) + sum(choices))
    assert largest_natural_sum(Fraction(-20), choices) == -1


@pytest.mark.parametrize("text", ["1/x^3", "1/x^3 + 1/(3*x^2)", "1/(x-1)^3 + 1/x^3", "x", "1/x^5"])
def test_ramified_points_of_every_order(text: str) -> None:
    """The irregular points have order 3 or 5, nothing else excludes the finite groups."""
    answer = kovacic.solve(text)
    assert answer.case is None
    assert answer.verified


def test_a_denominator_that_is_zero_proves_nothing() -> None:
    """With D = 0 every identity would hold; no form has the degree 0."""
    answer = kovacic.solve("x^2 + 3")
    decision, S = answer.decision, kovacic.solve("x^2 + 4").S
    f, riccati, zero = decision.semi_invariant, decision.riccati, QQ.poly([])
    assert f is not None
    assert riccati is not None
    assert form_numerators(answer.S, f, riccati.D) == [*riccati.numerators]
    assert form_numerators(S, f, zero) is None
    assert form_numerators(answer.S, replace(f, P=zero), riccati.D) is None
    assert form_numerators(answer.S, replace(f, degree=0), riccati.D) is None
    assert not verify(S, replace(decision, riccati=replace(riccati, D=zero, numerators=(f.P, zero))))


@pytest.mark.parametrize(
    "S",
    [Fraction(1, 4) - 3 / X - 4 / (X - 1), Fraction(1, 4) - 6 / X + 2 / X**2 - 3 / (X - 1),
     Fraction(1, 4) - 7 / X - 9 / (X - 1) + 6 / X**2, 1 + 4 / X + 2 / X**2 + 2 / (X - 1),
     Fraction(1, 4) - Fraction(19, 3) / X - Fraction(2, 9) / X**2 - 3 / (X - 1), X**2 - 13 + 2 / (X - 1) ** 2 + 1 / X],
    ids=str,
)  # fmt: skip
def test_that_no_omega_is_rational_is_proven_at_every_place(S: RatFunc) -> None:
    """With room for zeros, as Kovacic's own search finds; logarithms at differences 1, 3, 5; poles."""
    assert textbook.decide(S.num.coefficients(), S.den.coefficients(), limit=3000)[0] is None  # type: ignore[attr-defined]
    assert kovacic.solve(str(S)).verified
    kernel = inspector(S)
    counts, prime = zero_counts(kernel.points), next(QQ.homomorphisms()).p
    assert counts is not None
    assert counts.largest >= 0
    places = [point.name for point in kernel.points if point.tells_solutions_apart]
    assert len(places) > 1
    assert all(kernel.holds(NoRationalOmega(counts.largest, prime, name), Structure.REDUCIBLE) for name in places)


# ------------------------------------------------------------------------------------------- limits


def test_the_check_keeps_to_the_time_limit() -> None:
    answer = kovacic.solve("x^4 + 402*x + 1")
    with pytest.raises(LimitExceeded):
        verify(answer.S, answer.decision, budget=Budget(Limits(seconds=0.0)))


def test_an_answer_whose_check_is_not_finished_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    def exhausted(*_: Any, **__: Any) -> None:
        raise LimitExceeded("the time limit of 1 s is exceeded", limit="seconds")

    monkeypatch.setattr("kovacic.api.verify", exhausted)
    answer = kovacic.solve("x^2 + 3")
    assert answer.status is kovacic.Status.UNDECIDED
    assert answer.reason == "while the answer was verified: the time limit of 1 s is exceeded"
    assert (answer.omega, answer.group, answer.proof, answer.verified) == (None, None, (), False)


# ------------------------------------------------------------------------------------------- dimensions of forms


@pytest.mark.parametrize(
    ("text", "m", "dimension"),
    [("0", 2, 3), ("2", 2, 1), ("2", 4, 1), ("x^2 + 3", 2, 0), ("x^2 - 1/x^2", 2, 0), ("3/(4*x^2)", 2, 3), ("-2/(9*x^2)", 2, 1),
     ("-2/(9*x^2)", 6, 3), ("-3/(16*x^2) + 1/x", 4, 1), ("-3/16/x^2-3/16/(x-1)^2+3/16/x/(x-1)", 4, 2)],
)  # fmt: skip
def test_dimensions_of_forms_are_exact(text: str, m: int, dimension: int) -> None:
    """Monomials of y1, y2 that are rational: all (G trivial), y1 y2 and its powers (G_m), none (Borel), those of mu_3, Q8."""
    kernel = inspector(kovacic.solve(text, var="x").S)
    assert kernel.dimension_is_at_most(dimension, m)
    assert dimension == 0 or not kernel.dimension_is_at_most(dimension - 1, m)


@pytest.mark.parametrize(
    ("text", "family", "n"), [("1", "borel", None), ("2/x^2", "additive", 1), ("-2/(9*x^2)", "additive", 3)]
)
def test_a_group_isnt_unipotent_because_no_form_is_shown(text: str, family: str, n: int | None) -> None:
    answer = kovacic.solve(text, var="x")
    silent = replace(answer.decision, invariant=None)
    assert not verify(answer.S, silent, claimed(GroupClaim(family, n)))
    assert verify(answer.S, silent)


@pytest.mark.parametrize(
    ("omega", "family", "n", "other"),
    [
        (2 / X - 1 / (X - 1), "cyclic", 1, "additive"),  # y1^-2 = (x - 1)^2/x^4
        (2 / X - 3 * X**2 / (2 * (1 + X**3)), "additive", 2, "cyclic"),  # (1 + x^3)/x^4
        (-1 / X + 2 / (X - 1), "cyclic", 1, "additive"),
        (2 / X - 3 / (X - 1), "additive", 1, "cyclic"),  # (x - 1)^6/x^4
        (3 / X + 1 / (2 * (X + 1)), "additive", 2, "cyclic"),
        (-3 / (2 * X), "cyclic", 2, "additive"),
        # (1 - 4 x^3 + x^5)/(x^4 (x - 1)^2), which has no residue at 0
        (2 / X + 1 / (X - 1) - (5 * X**4 - 12 * X**2) / (2 * (X**5 - 4 * X**3 + 1)), "additive", 2, "cyclic"),
    ],
)
def test_a_residue_of_the_inverse_square_makes_a_logarithm(omega: RatFunc, family: str, n: int, other: str) -> None:
    """y2 = y1 int y1^-2 lies in C(x, y1) exactly if y1^-2 has no residue; F = y1^2 is the form that is shown."""
    S = omega.derivative() + omega * omega
    answer = kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]
    decision = replace(answer.decision, invariant=SemiInvariant(2, 2 * omega, QQ.poly([1])))
    assert verify(S, decision, claimed(GroupClaim(family, n)))
    assert not verify(S, decision, claimed(GroupClaim(other, n)))


# ------------------------------------------------------------------------------------------- orders modulo primes


TORSION = [
    (transform.through(X**3 + 1, 2, 3), 3),  # P = (2, 3) has order 6, and 2 P - 2 infinity is P less its conjugate
    (transform.through(X**3 + 1, 0, 1), 3),
    (transform.through(X**3 + 4 * X, 2, 4), 2),  # order 4
    (transform.through(X**5 + 1, 0, 1), 5),  # y - 1 has the divisor 5 P - 5 infinity
    (transform.through(X**7 + 9, 0, 3), 7),
    (transform.through(X**6 + 1, 0, 1), 3),  # (y - 1)/x^3 has the divisor 3 P less its conjugate
    (
        transform.through(X**3 + 1, 2, 3)(X**3 + 1) * 9 * X**4,
        3,
    ),  # the first one for x^3 + 1 in place of x: a zero of order 4
    ((X**2 + 3) ** 2 / (X**6 + 1), 3),  # residues over infinity, where y + x^3 has its zeros and poles
    (X**2 / (X**4 + 3), 2),  # y + x^2
    ((9 / (X**9 + 9 * X**2))(2 + 1 / X) / X**4, 7),  # infinity is neither a zero nor a pole
]


@pytest.mark.parametrize(("H", "order"), TORSION, ids=str)
def test_orders_of_torsion_are_the_same_modulo_every_good_prime(H: RatFunc, order: int) -> None:
    def primes_with(k: int, residue: Fraction = Fraction(1)) -> list[int]:
        return [p for p in range(62) if order_holds(H * residue**2, {residue}, p, k)]

    good = primes_with(order)
    assert good[-9:] == [23, 29, 31, 37, 41, 43, 47, 53, 59, 61][-9:]
    assert primes_with(order, Fraction(1, 2)) == good  # l = 2: the same divisor
    assert not any(order_holds(H, {Fraction(1)}, p, k) for p in range(40) for k in range(2 * order + 1) if k != order)


def test_infinite_order_is_seen_from_two_primes() -> None:
    """P = (3, 5) on y^2 = x^3 - 2 isn't torsion; the orders of its multiples, modulo p, by chords and tangents."""
    orders = {}
    for p in (7, 11, 13, 19):
        x, y, n = 3, 5, 1
        while x is not None:
            n += 1
            if (x, y) == (3, 5):
                slope = 3 * x * x * pow(2 * y, -1, p)
            elif x == 3:
                break
            else:
                slope = (y - 5) * pow(x - 3, -1, p)
            new = (slope * slope - x - 3) % p
            x, y = new, (slope * (3 - new) - 5) % p
        orders[p] = n if n % 2 else n // 2
        for residue in (Fraction(1), Fraction(1, 3)):
            H = transform.through(X**3 - 2, 3, 5, residue)
            assert [k for k in range(3 * p) if order_holds(H, {residue}, p, k)] == [orders[p]]
    assert len(set(orders.values())) > 2


INFINITE = [
    ((X**4 + X + 1) / (X + 2) ** 2, Ground.NOT_TORSION),
    ((X**6 + X + 1) / (X**2 + 2) ** 2, Ground.NOT_TORSION),  # genus 2
    (1 / transform.through(X**5 - X + 4, 0, 2, Fraction(2, 3)), Ground.NOT_TORSION),
]


@pytest.mark.parametrize(("g", "ground"), INFINITE, ids=str)
def test_an_infinite_group_on_a_curve_of_positive_genus_needs_its_orders(g: RatFunc, ground: Ground) -> None:
    S = transform.from_squared_product(g, 1)
    answer = kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]
    group = answer.group
    assert group is not None
    assert (str(group), group.ground) == ("N(T)", ground)
    claim, ((p, k), *others) = group.claim, group.orders
    verification = verify(S, answer.decision, claim)
    assert verification
    assert not verification.unchecked
    forged: list[Any] = [(), ((p, k + 1), *others), ((p, 2 * k), *others), ((4, k), *others), ((2, k), *others)]
    forged += [((q, k), *others) for q in (1, 0, -5, 9, 15, p * p, 2**61 + 1)] + [
        ((p, 0),),
        ((p, -k),),
        ((p, 1), (p, 2)),
    ]
    if others:
        forged += [((p, others[0][1]), (others[0][0], k)), ((p, k), (p, others[0][1]))]
    for orders in forged:
        if orders != ((p, k),):
            assert not verify(S, answer.decision, replace(claim, orders=orders)), orders
    for n in (1, 2, k, 2 * k):
        assert not verify(S, answer.decision, claimed(claim, family="dicyclic", n=n))
        assert not verify(S, answer.decision, claimed(claim, n=n))


@pytest.mark.parametrize(("residue", "n"), [(1, 5), (Fraction(1, 2), 10), (Fraction(1, 3), 15), (Fraction(5, 2), 2)])
def test_a_finite_order_on_a_curve_of_genus_two(residue: Fraction, n: int) -> None:
    """On y^2 = x^5 + 1 the differential 5 dx/(x y) is d log((y - 1)/(y + 1)), a function whose divisor is 5 D."""
    S = transform.from_squared_product(1 / transform.through(X**5 + 1, 0, 1, Fraction(residue)), 1)
    answer = kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]
    assert answer.group is not None
    assert (answer.group.kind.value, answer.group.n) == ("dicyclic", n)
    assert answer.verify()
    k = n // Fraction(residue).denominator
    assert not verify(S, answer.decision, claimed(GroupClaim("infinite dihedral", None, None, ((7, k),))))


def test_residues_that_agree_modulo_a_prime() -> None:
    """The residues 1 and 4 at (0, 1) and (1, 2) on y^2 = x^3 + 2 x + 1 have the same square modulo 5, which isn't taken."""
    H = (9 * X - 1) ** 2 / ((X**3 + 2 * X + 1) * (X * (X - 1)) ** 2)
    S = transform.from_squared_product(1 / H, 1)
    answer = kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]
    assert answer.group is not None
    assert str(answer.group) == "N(T)"
    assert answer.group.orders[0][0] > 5
    assert answer.verify()
    residues = {Fraction(1), Fraction(4)}
    assert not any(order_holds(H, residues, 5, k) for k in range(1, 20))
    assert any(order_holds(H, residues, 7, k) for k in range(1, 20))


def test_true_orders_dont_make_a_finite_group_infinite() -> None:
    """The units of Pell's equation: the form of degree 2 n is there, whatever orders are shown."""
    A = X**3 - 3 * X + 5
    S = transform.from_squared_product((A * A - 3) / A.derivative() ** 2, Fraction(4, 25))
    answer = kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]
    group, decision = answer.group, answer.decision
    assert group is not None
    assert group.order == 20
    f, riccati = decision.semi_invariant, decision.riccati
    assert f is not None
    assert riccati is not None
    a, b, c = riccati.numerators
    H = RatFunc(b * b - 4 * a * c, (a * riccati.D) ** 2)
    for k in range(1, 7):  # (A + z)^(2/5), and A + z has the divisor 3 D/6 for the points at infinity
        orders = tuple((p, k) for p in range(3, 40) if order_holds(H, {Fraction(6, 5)}, p, k))
        assert bool(orders) is (k == 1)
        assert not orders or not verify(S, decision, claimed(GroupClaim("infinite dihedral", None, None, orders[:2])))


def test_orders_over_a_number_field() -> None:
    """y1 y2 = (x^4 + x + sqrt(2))^(1/2)/(x + 2), w = 1: two orders modulo primes that split."""
    numerator = (
        "6*x^6 + 10*x^5 + x^4*(15*sqrt(2)/4 + 19/2) + x^3*(12 + 12*sqrt(2)) + x^2*(133/16 + 18*sqrt(2))"
        " + x*(11/4 + 37*sqrt(2)/4) + 3/4 + 7*sqrt(2)/2"
    )
    answer = kovacic.solve(f"({numerator})/((x + 2)^2*(x^4 + x + sqrt(2))^2)")
    group = answer.group
    assert group is not None
    assert (str(group), group.ground) == ("N(T)", Ground.NOT_TORSION)
    assert all(p % 8 in (1, 7) for p, _ in group.orders)
    assert answer.verify()
    p, k = group.orders[0]
    assert not verify(answer.S, answer.decision, replace(group.claim, orders=((5, k), group.orders[1])))
    assert not verify(answer.S, answer.decision, replace(group.claim, orders=((p, k + 1), group.orders[1])))


# ------------------------------------------------------------------------------- irreducibility over number fields

ROOT2 = AlgebraicField(QQ, QQ.poly([-2, 0, 1]), "sqrt(2)")
TOWER = AlgebraicField(ROOT2, ROOT2.poly([-3, 0, 1]), "sqrt(3)")
CUBE = AlgebraicField(QQ, QQ.poly([-2, 0, 0, 1]), "root(2, 3)")


@pytest.mark.parametrize(
    ("field", "coefficients", "irreducible"),
    [
        (ROOT2, [-2, 0, 1], False),
        (ROOT2, [-3, 0, 1], True),
        (ROOT2, [1, 0, 0, 0, 1], False),  # (x^2 + 1)^2 - 2 x^2
        (ROOT2, [3, 0, 0, 0, 1], True),
        (ROOT2, [1, 0, 2, 0, 1], False),
        (TOWER, [-6, 0, 1], False),
        (TOWER, [-5, 0, 1], True),  # the roots of its norm are there twice without a shift
        (TOWER, [1, 0, -10, 0, 1], False),
        (CUBE, [-2, 0, 0, 1], False),
        (CUBE, [4, 2, 0, 1], True),
        (CUBE, [-5, 0, 1], True),
    ],
    ids=str,
)
def test_irreducible_polynomials_over_number_fields(field: Any, coefficients: list[int], irreducible: bool) -> None:
    p = field.poly(coefficients)
    assert is_irreducible(p) is irreducible
    shifted = p(field.poly([field.generator, 1]))
    assert is_irreducible(shifted) is irreducible
    assert not is_irreducible(p * field.poly([field.generator, 1]))
    extension = AlgebraicField(field, p.monic(), "c")
    assert is_a_field(extension) is irreducible


@pytest.mark.parametrize("field", [QQ, ROOT2, TOWER, CUBE], ids=str)
def test_constants_are_no_irreducible_polynomials(field: Any) -> None:
    assert not is_irreducible(field.poly([5]))
    assert is_irreducible(field.poly([5, 2]))


@pytest.mark.parametrize("S", ["sqrt(-6)*x/(x^2 + 6)^2", "sqrt(2)/(x^4 + 1)^2", "3/(x^2-2)^2 + sqrt(2)/(x^2 - 3)^2"])
def test_factors_that_arent_irreducible_are_refused(S: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Over a field in which the denominator has factors, were the search to find none: nothing is passed."""
    right = kovacic.solve(S, var="x")
    assert right.verified

    def unfactored(field: AlgebraicField, polynomial: Poly) -> list[tuple[Poly, int]]:
        whole = polynomial.monic()
        radical = whole // whole.gcd(whole.derivative())
        return [(radical, whole.remove(radical)[1])]

    monkeypatch.setattr(AlgebraicField, "factor", unfactored)
    with pytest.raises(kovacic.KovacicError):
        kovacic.solve(S, var="x").group.name.strip()


@pytest.mark.parametrize(
    "text",
    [
        "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0",
        "x*y'' + y/(x - 1) = 0",
        "y'' + sqrt(2)/x*y' - y = 0",
        "t*y'' + y'/(x + t) + y = 0",
    ],
)
def test_the_normal_form_of_another_equation_is_refused(text: str) -> None:
    solution = kovacic.solve(text, var="x")
    given, S, rho = solution.equation, solution.S, solution.gauge
    assert is_normal_form(S, rho, given.a, given.b, given.c)
    one = S * 0 + 1
    assert not is_normal_form(S + one, rho, given.a, given.b, given.c)
    assert not is_normal_form(S, rho + one, given.a, given.b, given.c)
    assert not is_normal_form(S, rho, given.a + one, given.b, given.c)
    assert not is_normal_form(S, rho, given.a, given.b + one, given.c)
    assert not is_normal_form(S, rho, given.a, given.b, given.c + one)


def test_division_is_multiplied_again(monkeypatch: pytest.MonkeyPatch) -> None:
    a, p = QQ.poly([3]), QQ.poly([1, 1, 1])
    x = QQ.poly([0, 1])
    assert quotient(a, QQ.poly([2])) * 2 == a
    assert (inverse(x, p) * x - 1) % p == 0
    wrong = type(a)
    monkeypatch.setattr(wrong, "__truediv__", lambda self, other: self)
    monkeypatch.setattr(wrong, "inverse_modulo", lambda self, modulus: self)
    with pytest.raises(VerificationFailed):
        quotient(a, QQ.poly([2]))
    with pytest.raises(VerificationFailed):
        inverse(x, p)
