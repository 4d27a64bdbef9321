"""The engine against answers known by construction, against a textbook search, and against corrupted certificates.

The number of equations of the long run is set by KOVACIC_FUZZ (default 20,000); a long run is random unless
HYPOTHESIS_PROFILE=ci is set:  KOVACIC_FUZZ=20000 HYPOTHESIS_PROFILE=fuzz pytest -m slow tests/engine/test_engine_properties.py
"""

from __future__ import annotations

import itertools
import os
import pickle
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import pytest
import strategies
import textbook
import transform
from build import QQ, AlgebraicField, Poly, RatFunc, function, generated, parametrize, verify
from flint import nmod_poly
from forged import (
    Decision,
    Exclusion,
    NecessaryCondition,
    NoInvariant,
    NoRationalOmega,
    RiccatiPolynomial,
    Rule,
    SemiInvariant,
)
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from strategies import Example

import kovacic
from kovacic import Solution, Status, Structure

FAMILIES = list(strategies.GENERATORS)
LONG_RUN = int(os.environ.get("KOVACIC_FUZZ", "20000"))
PRIMES = (2**61 - 1, 2**59 - 55)


def solve(S: RatFunc) -> Solution:
    return kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]


def omega_degree(answer: Solution) -> int | None:
    return answer.riccati.degree if answer.riccati else None


# ------------------------------------------------------- an independent check of the polynomial of omega


def _images(polynomial: Poly, p: int, root: int) -> Any:
    """The polynomial modulo p, the constant c replaced by a root of its minimal polynomial."""
    if polynomial.field != QQ:
        return sum(
            (_images(part, p, root) * pow(root, k, p) for k, part in enumerate(polynomial.parts)), nmod_poly([], p)
        )
    denominator = polynomial.content()[1]
    return nmod_poly((polynomial * denominator).rep.numer(), p) * pow(denominator, -1, p)  # type: ignore[attr-defined]


def _roots(field: Any, p: int) -> list[int]:
    if not isinstance(field, AlgebraicField):
        return [0]
    return [int(root) for root, _ in _images(field.modulus, p, 0).roots()]


def riccati_residual_vanishes(S: RatFunc, coefficients: tuple[RatFunc, ...]) -> bool:
    """Is `dM/dx + (S - W^2) dM/dW` divisible by M?  At points modulo primes, by division of polynomials in W.

    A false identity between rational functions of degree d survives with probability about d/p at each random point.
    """
    for p in PRIMES:
        for root in _roots(coefficients[0].field, p):
            pairs = [(_images(c.num, p, root), _images(c.den, p, root)) for c in coefficients]
            slopes = [(a.derivative() * b - a * b.derivative(), b * b) for a, b in pairs]
            num, den = _images(S.num, p, root), _images(S.den, p, root)
            for x in (271828182845, 314159265358):
                M, dM = ([int(a(x)) * pow(int(b(x)), -1, p) for a, b in items] for items in (pairs, slopes))
                factor = nmod_poly([int(num(x)) * pow(int(den(x)), -1, p), 0, -1], p)
                modulus = nmod_poly(M, p)
                if (nmod_poly(dM, p) + factor * modulus.derivative()) % modulus != 0:
                    return False
    return True


def check(example: Example) -> Solution:
    """Everything that every answer must satisfy."""
    answer = solve(example.S)
    assert answer.case == example.case, example
    assert answer.status is (Status.NONE_EXISTS if example.case is None else Status.LIOUVILLIAN)
    expected = strategies.OMEGA_DEGREE.get(example.group or "", example.case)
    assert omega_degree(answer) == expected, example
    assert answer.verified
    if answer.riccati is not None:
        coefficients = answer.riccati.coefficients
        assert coefficients[-1] == 1
        assert riccati_residual_vanishes(example.S, coefficients), example
    constants = answer.constants
    if constants is not None:
        assert constants.degree == (3 if example.group == strategies.QUATERNION else 2)
        assert example.case == 1 or example.group in (strategies.QUATERNION, strategies.TETRAHEDRAL), example
        assert len(QQ.factor(constants)) == 1
    return answer


# ----------------------------------------------------------------------------------------- right answers


@parametrize("family", FAMILIES, ordinary=1, long=1)
def test_case_and_degree_are_right(family: str) -> None:
    @settings(max_examples=8)
    @given(strategies.examples(family))
    def run(example: Example) -> None:
        check(example)

    run()


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_no_wrong_answer_in_the_long_run(family: str) -> None:
    @settings(max_examples=-(-LONG_RUN // len(FAMILIES)))
    @given(strategies.examples(family))
    def run(example: Example) -> None:
        check(example)

    run()


@parametrize("form", ["x^2*({}) + a", "({})*a^2*x^2 + b*x", "({})*x^2 + a + 1/(x^2+1)", "({})*x^4 + a*x"], ordinary=1)
@pytest.mark.parametrize("number", [2, 3, 5, 7, 11, 13])
def test_exponents_with_a_root_of_a_number_beside_parameters(form: str, number: int) -> None:
    """At infinity the exponents have the root of a number, which isn't rational over Q(a): that is proven for every number.

    Whether a number is a square modulo a prime doesn't depend on the values of the parameters there.
    """
    for sign in (1, -1):
        answer = kovacic.solve(form.format(sign * number))
        assert answer.verified
        assert answer.case is None


@parametrize("p", ["x^2 + 1", "x^2 - x + 3", "x^3 - 2", "x^4 + 1", "x^4 - 2", "x^4 + x + 1"], ordinary=2)
@pytest.mark.parametrize("m", [2, 5, -1, -6])
def test_conjugate_places_with_one_irrational_exponent(p: str, m: int) -> None:
    """b = (m - 1)/4 at each root of p: exponents (1 +- sqrt(m))/2 that aren't rational over its field, of whatever norm.

    At infinity there is room for zeros; that no solution has as many as are left is an irrational exponent all the same.
    """
    factor = function(p)
    slope = factor.derivative()
    poles = (slope * slope - factor * slope.derivative()) / (factor * factor) * Fraction(m - 1, 4)
    for E in (1, 5, 13):
        answer = solve(function(f"x^2 + {E}") + poles)
        assert answer.verified
        assert answer.case is None


@pytest.mark.long
@generated(15)
@given(strategies.rational_pole_equations())
def test_textbook_search_agrees_on_random_equations(S: RatFunc) -> None:
    try:
        expected = textbook.decide(S.num.coefficients(), S.den.coefficients(), limit=3_000)  # type: ignore[attr-defined]
    except textbook.OutOfDomainError:
        assume(False)
    answer = solve(S)
    assert (answer.case, omega_degree(answer)) == expected


@pytest.mark.long
@generated(10)
@given(strategies.examples("case 1", "case 2", "case 3: Schwarz tetrahedral", "none", "odd"))
def test_textbook_search_agrees_on_constructed_equations(example: Example) -> None:
    S = example.S
    assume(S.den.degree <= 8 and S.num.height_bits() < 100)
    try:
        expected = textbook.decide(S.num.coefficients(), S.den.coefficients(), limit=300)  # type: ignore[attr-defined]
    except textbook.OutOfDomainError:
        assume(False)
    answer = solve(S)
    assert (answer.case, omega_degree(answer)) == expected
    assert answer.case == example.case


# ------------------------------------------------------------------------------------------- sharp answers


@pytest.mark.long
@generated(15)
@given(strategies.omegas(2, 4))
def test_unique_omega_is_found_itself(omega: RatFunc) -> None:
    """Where the answer needs no choice (omega unique, or the same by chance), it's the one we started from."""
    answer = solve(transform.from_omega(omega))
    assert answer.case == 1
    other = answer.omega
    assert other is not None
    if other != omega:  # then there are two rational omegas, and their difference solves v' = -v (v + 2 omega)
        difference = other - omega
        assert difference.derivative() == -(difference * (other + omega))


@pytest.mark.long
@generated(10)
@given(strategies.products((-2, -1, 1, 2, 3), 3, 3), strategies.nonzero(30))
def test_constants_of_the_diagonal_case(F: RatFunc, W: int) -> None:
    """`(F' +- sqrt W)/(2F)`: in Q(x) exactly when W is a square, else over Q(sqrt W).

    Without a unique pair of lines (y1/y2 an algebraic function of degree 1) all solutions are square roots of rational
    functions, and omega can be chosen over Q.
    """
    answer = solve(transform.from_product(F, W))
    root = QQ.sqrt(QQ.poly([W]))
    if root is not None:
        assert answer.constants is None
    elif answer.constants is not None:
        a, b, c = (answer.constants[i] for i in (2, 1, 0))
        assert QQ.sqrt((b * b - 4 * a * c) * W) is not None, "not the field Q(sqrt W)"
    else:  # omega over Q together with the conjugate pair over Q(sqrt W): at least three of them
        assert answer.omega is not None
        assert answer.omega.derivative() + answer.omega**2 == answer.S


@settings(max_examples=10)
@given(strategies.case_1_scalar())
def test_scalar_group_needs_no_constants(example: Example) -> None:
    assert check(example).constants is None


# ---------------------------------------------------------------------------------------------- agreement


@pytest.mark.long
@generated(10)
@given(strategies.examples())
def test_decide_agrees_and_answers_survive_pickle_and_json(example: Example) -> None:
    answer = solve(example.S)
    verdict = kovacic.decide((example.S.num.coefficients(), example.S.den.coefficients()))  # type: ignore[attr-defined]
    assert (verdict.status, verdict.case) == (answer.status, answer.case)
    assert pickle.loads(pickle.dumps(answer)) == answer
    back = Solution.from_json(answer.to_json())
    assert back == answer
    assert back.verify()


def no_invariants(decision: Decision) -> Iterator[tuple[int, int, NoInvariant]]:
    for i, exclusion in enumerate(decision.exclusions):
        for j, evidence in enumerate(exclusion.evidence):
            if isinstance(evidence, NoInvariant) and evidence.prime is not None:
                yield i, j, evidence


def changed(decision: Decision, i: int, j: int, evidence: Any) -> Decision:
    exclusion = decision.exclusions[i]
    items = (*exclusion.evidence[:j], evidence, *exclusion.evidence[j + 1 :])
    return replace(
        decision,
        exclusions=(*decision.exclusions[:i], replace(exclusion, evidence=items), *decision.exclusions[i + 1 :]),
    )


@pytest.mark.long
@generated(10)
@given(strategies.examples("case 2", "case 3", "none", "case 1: omega"), st.integers(1, 5), st.integers(2, 50))
def test_nullity_is_the_same_at_another_prime_and_point(example: Example, index: int, offset: int) -> None:
    """The rank statement of a "no" by plain arithmetic: another prime, another point, more terms."""
    answer = solve(example.S)
    for _, _, evidence in no_invariants(answer.decision):
        degree = evidence.invariant_degree
        assume(evidence.degree <= 60)
        assert plain_nullity(example.S, degree, evidence.degree, 2**61 - 1, offset) == 0
        assert plain_nullity(example.S, degree, evidence.degree, 10**9 + 7, offset + index) == 0


@pytest.mark.long
@generated(8)
@given(strategies.examples("case 2", "case 3", "none"), st.integers(1, 20), st.integers(60, 90))
def test_a_proof_at_another_prime_and_point_verifies(example: Example, index: int, point: int) -> None:
    """The verifier computes the nullity itself, at the prime and the point that the record names."""
    answer = solve(example.S)
    prime = next(itertools.islice(QQ.homomorphisms(), index, None)).p
    for i, j, evidence in no_invariants(answer.decision):
        elsewhere = changed(answer.decision, i, j, replace(evidence, prime=prime, point=point))
        assert bool(verify(answer.S, elsewhere)) is bool(example.S.den(point))


def plain_nullity(S: RatFunc, m: int, N: int, p: int, point: int) -> int:
    """Forms of degree m whose quotient by Q0 is a polynomial of degree <= N, to N + m + 5 terms: lists of integers.

    Q0 = prod q^v over the irreducible factors q of den, v the least valuation, by trying the exponents one by one.
    """
    order = N + m + 5
    num, den = (_images(f, p, 0) for f in (S.num, S.den))
    while not int(den(point)):
        point += 1
    shift = nmod_poly([point, 1], p)
    top, bottom = num(shift), den(shift)
    s = top.mul_low(bottom.inverse_series_trunc(order), order) if top else nmod_poly([], p)
    s_list = [int(s[k]) for k in range(order)]
    solutions = []
    for start in ([1, 0], [0, 1]):
        y = list(start)
        for k in range(2, order):
            total = sum(s_list[i] * y[k - 2 - i] for i in range(k - 1))
            y.append(total * pow(k * (k - 1), -1, p) % p)
        solutions.append(nmod_poly(y, p))
    scale = nmod_poly([1], p)
    for factor, multiplicity in QQ.factor(S.den) if S.den.degree > 0 else []:
        v = plain_valuation(S, factor, multiplicity, m)
        image = _images(factor, p, 0)(shift)
        base = image.inverse_series_trunc(order) if v > 0 else image
        for _ in range(abs(v)):
            scale = scale.mul_low(base, order)
    columns = []
    for i in range(m + 1):
        column = scale
        for y, times in ((solutions[0], i), (solutions[1], m - i)):
            for _ in range(times):
                column = column.mul_low(y, order)
        columns.append([int(column[k]) for k in range(N + 1, order)])
    return m + 1 - rank_modulo(columns, p)


def plain_valuation(S: RatFunc, factor: Poly, multiplicity: int, m: int) -> int:
    """The least integer among the valuations at a root of the factor; at a logarithm the weaker bound without it."""
    if multiplicity > 2:
        return m * multiplicity // 4
    if multiplicity == 1:
        return 0
    rest = S.den // (factor * factor)
    b = (S.num * (factor.derivative() ** 2 * rest).inverse_modulo(factor)) % factor
    square = 1 + 4 * b
    root = QQ.sqrt(square) if square.degree <= 0 else None
    if root is None:
        return m // 2
    delta = QQ.rational_value(root)
    assert delta is not None
    values = [Fraction(m, 2) + Fraction(2 * k - m, 2) * delta for k in range(m + 1)]
    return min((int(value) for value in values if value.denominator == 1), default=m // 2)


def rank_modulo(rows: list[list[int]], p: int) -> int:
    rank = 0
    rows = [list(row) for row in rows]
    for column in range(len(rows[0])):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][column] % p), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][column], -1, p)
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] * inverse % p
            if factor:
                rows[i] = [(a - factor * b) % p for a, b in zip(rows[i], rows[rank], strict=True)]
        rank += 1
    return rank


# -------------------------------------------------------------------------------------------- corruption

CORRUPTIBLE = [
    "2/x^2",
    "x^2 + 3",
    "2",
    "-2/(9*x^2)",
    "(16*x - 3)/(16*x^2)",
    "(3*x^4 + 6*x^2 + 12*x + 1)/(4*x^6 + 8*x^4 + 8*x^3 + 4*x^2 + 8*x + 4)",
    "(-108*x^2 - 756*x - 27)/(256*x^6 - 384*x^4 - 896*x^3 + 144*x^2 + 672*x + 784)",  # the quaternion group
    "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)",
    "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)",
    "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)",
]
NEGATIVE = [
    "x",
    "x^2",
    "(3 - 4*x^2)/(4*x^2)",
    "x^4 + 6*x",
    "1/x + 1/(x - 1)",
    "(-135*x^2 - 256*x + 256)/(576*x^4 - 1152*x^3 + 576*x^2)",
    "(-216*x^2 - 335*x + 351)/(900*x^4 - 1800*x^3 + 900*x^2)",
    "(-x^2 + x - 1)/(4*x^4 - 8*x^3 + 4*x^2)",
]


@cache
def solved(text: str) -> Solution:
    return kovacic.solve(text)


@pytest.mark.parametrize("text", CORRUPTIBLE)
def test_every_corrupted_coefficient_fails(text: str) -> None:
    answer = solved(text)
    riccati, form = answer.riccati, answer.semi_invariant
    assert riccati is not None
    assert form is not None
    assert verify(answer.S, answer.decision)
    one = riccati.P.field.poly([1])
    for k, numerator in enumerate(riccati.numerators):
        for wrong in (numerator + one, numerator * 2 + one, -numerator if numerator else one, riccati.P.field.poly([])):
            if wrong == numerator:
                continue
            numerators = (*riccati.numerators[:k], wrong, *riccati.numerators[k + 1 :])
            bad = replace(answer.decision, riccati=replace(riccati, numerators=numerators))
            assert not verify(answer.S, bad), (k, str(wrong))
    x = RatFunc(QQ.poly([0, 1]))
    bad_parts: list[dict[str, Any]] = [
        {"riccati": None},
        {"semi_invariant": None},
        {"riccati": replace(riccati, P=riccati.P * QQ.poly([5, 1]))},
        {"riccati": replace(riccati, D=riccati.D * QQ.poly([5, 1]))},
        {"riccati": replace(riccati, numerators=riccati.numerators[:-1])},
        {"riccati": replace(riccati, numerators=(*riccati.numerators, one))},
        {"riccati": replace(riccati, numerators=riccati.numerators[:1]), "semi_invariant": replace(form, degree=0)},
        {"semi_invariant": replace(form, theta=form.theta + x)},
        {"semi_invariant": replace(form, P=form.P * QQ.poly([5, 1]))},
        {"semi_invariant": replace(form, degree=form.degree + 1)},
    ]
    for part in bad_parts:
        assert not verify(answer.S, replace(answer.decision, **part)), part
    assert not verify(answer.S + x, answer.decision)
    assert not verify(answer.S + 1, answer.decision)


@pytest.mark.parametrize(("square", "right"), [(2, True), (4, False)])
def test_constants_need_an_irreducible_polynomial(square: int, right: bool) -> None:
    """`omega = c` with `c**2 = S` satisfies the identity for every constant S; c must be a number all the same."""
    field = AlgebraicField(QQ, QQ.poly([-square, 0, 1]))
    c, one = field.generator, field.poly([1])
    decision = Decision(
        Structure.REDUCIBLE,
        (),
        invariant=SemiInvariant(2, RatFunc(QQ.poly([])), QQ.poly([1])),
        semi_invariant=SemiInvariant(1, RatFunc(c), one),
        riccati=RiccatiPolynomial(one, one, (one, c)),
    )
    assert bool(verify(RatFunc(QQ.poly([square])), decision)) is right


@pytest.mark.parametrize("text", CORRUPTIBLE)
def test_a_positive_answer_for_another_structure_fails(text: str) -> None:
    answer = solved(text)
    for structure in Structure:
        if structure is not answer.decision.structure:
            assert not verify(answer.S, replace(answer.decision, structure=structure)), structure
    nothing = Decision(None, answer.decision.exclusions)
    assert not verify(answer.S, nothing)


@pytest.mark.parametrize("text", [*(text for text in CORRUPTIBLE if kovacic.decide(text).case != 1), *NEGATIVE])
def test_missing_or_foreign_evidence_fails(text: str) -> None:
    answer = solved(text)
    decision = answer.decision
    assert decision.exclusions
    for i, exclusion in enumerate(decision.exclusions):
        rest = (*decision.exclusions[:i], *decision.exclusions[i + 1 :])
        assert not verify(answer.S, replace(decision, exclusions=rest))
        assert not verify(answer.S, replace(decision, exclusions=(*rest, Exclusion(exclusion.structure, ()))))
        for j, evidence in enumerate(exclusion.evidence):
            if isinstance(evidence, NecessaryCondition):
                continue
            assert not verify(answer.S, changed(decision, i, j, NecessaryCondition(Rule.RAMIFIED, ("x - 77",))))
            wrong: list[Any] = []
            if isinstance(evidence, NoInvariant):
                wrong.append(replace(evidence, invariant_degree=evidence.invariant_degree + 1))
                if evidence.prime is not None:
                    wrong += [replace(evidence, degree=evidence.degree + step) for step in (1, -1)]
            if isinstance(evidence, NoRationalOmega) and evidence.prime is not None:
                wrong += [replace(evidence, degree=evidence.degree + 1), replace(evidence, place="x - 77")]
            for other in wrong:
                assert not verify(answer.S, changed(decision, i, j, other)), other


CONDITIONS = {
    Rule.RAMIFIED: "x",
    Rule.LOGARITHM: "(-x^2 + x - 1)/(4*x^4 - 8*x^3 + 4*x^2)",
    Rule.TOO_FEW_BRANCH_POINTS: "x^2",
    Rule.IRREGULAR: "x^2",
    Rule.EXPONENTS: "(-135*x^2 - 256*x + 256)/(576*x^4 - 1152*x^3 + 576*x^2)",
    Rule.NOT_A_SQUARE: "2*x^4 + 1",
}


@pytest.mark.parametrize("rule", Rule)
def test_a_condition_holds_at_its_places_and_against_its_structures_only(rule: Rule) -> None:
    answer = solved(CONDITIONS[rule])
    exclusions = answer.decision.exclusions
    i, j, condition = next(
        (i, j, evidence)
        for i, exclusion in enumerate(exclusions)
        for j, evidence in enumerate(exclusion.evidence)
        if isinstance(evidence, NecessaryCondition) and evidence.rule is rule
    )
    if rule is not Rule.TOO_FEW_BRANCH_POINTS:  # which says something about all places
        for places in ((), ("x - 77",), (*condition.places, "x - 77")):
            assert not verify(answer.S, changed(answer.decision, i, j, replace(condition, places=places))), places
    foreign = Structure.IMPRIMITIVE if exclusions[i].structure is Structure.REDUCIBLE else Structure.REDUCIBLE
    moved = tuple(replace(e, evidence=(condition,)) if e.structure is foreign else e for e in exclusions)
    assert moved != exclusions
    assert not verify(answer.S, replace(answer.decision, exclusions=moved))


@pytest.mark.parametrize("text", [*CORRUPTIBLE, "0", "(3*x^2 - 7)/(x^2 + 1)^2 * 0 + 2/x^2"])
def test_no_evidence_excludes_what_is_the_case(text: str) -> None:
    """Whatever we claim against the true structure, none of it passes."""
    answer = solved(text)
    true = answer.decision.structure
    assert true is not None
    places = tuple(str(p) for p, _ in QQ.factor(answer.S.den)) if answer.S.den.degree > 0 else ()
    claims: list[tuple[Any, ...]] = [
        (NecessaryCondition(rule, names),)
        for rule in Rule
        for names in (places, ("infinity",), (), *((n,) for n in places))
    ]
    prime = next(QQ.homomorphisms()).p  # type: ignore[attr-defined]
    invariants = [NoInvariant(m, p, 3, d) for m in (2, 4, 6, 8, 12) for p in (None, prime) for d in (-1, 5)]
    omegas = [
        NoRationalOmega(d, p, place) for d in (-1, 3) for p in (None, prime) for place in ("infinity", *places, "")
    ]
    claims += [(item,) for item in (*invariants, *omegas)]
    claims += [(first, second) for first in invariants[:4] for second in omegas]
    for evidence in claims:
        before = tuple(e for e in answer.decision.exclusions if e.structure is not true)
        rest = tuple(Exclusion(s, evidence) for s in Structure if s not in {e.structure for e in before})
        assert not verify(answer.S, Decision(None, (*before, *rest))), evidence


@pytest.mark.parametrize("text", NEGATIVE)
def test_no_certificate_passes_where_there_is_no_solution(text: str) -> None:
    """A certificate of another equation, moved here, fails."""
    answer = solved(text)
    for other in CORRUPTIBLE:
        decision = solved(other).decision
        assert not verify(answer.S, decision)
        assert not verify(answer.S, replace(decision, exclusions=answer.decision.exclusions))


@pytest.mark.parametrize("text", NEGATIVE)
@pytest.mark.parametrize("prime", [2, 3, 7, 2**59, (1 << 60) - 1, (1 << 89) - 1])
def test_a_proof_with_a_small_or_composite_or_long_modulus_is_refused_at_once(text: str, prime: int) -> None:
    answer = solved(text)
    for i, j, evidence in no_invariants(answer.decision):
        if evidence.prime != prime:
            assert not verify(answer.S, changed(answer.decision, i, j, replace(evidence, prime=prime)))


@pytest.mark.parametrize("text", NEGATIVE)
@pytest.mark.parametrize("prime", [10**9 + 7, PRIMES[0]])
def test_a_rank_modulo_any_large_prime_is_a_proof(text: str, prime: int) -> None:
    answer = solved(text)
    for i, j, evidence in no_invariants(answer.decision):
        if evidence.prime is not None:
            assert verify(answer.S, changed(answer.decision, i, j, replace(evidence, prime=prime)))
