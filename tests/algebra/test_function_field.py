"""The field Q(t) of the parameters: arithmetic, common divisors, the lift from values modulo primes, towers."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import Any

import pytest
from build import QQ, AlgebraicField, Budget, FunctionField, Poly
from hypothesis import given, settings
from hypothesis import strategies as st

from kovacic import LimitExceeded, Limits
from kovacic.algebra.lifting import Lifter

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


@settings(max_examples=25)
@given(polynomials(), polynomials())
def test_cleared_quotients_have_one_form(f: Poly, g: Poly) -> None:
    """Polynomials in s and t without a common factor, the leading coefficient of the denominator positive: -f/-g is f/g."""
    if not g:
        return
    above, below = K.cleared(f, g)
    assert above * g == below * f
    assert above.den.is_one()
    assert below.den.is_one()
    assert int(below.num.leading_coefficient()) > 0
    assert (above, below) == K.cleared(-f, -g) == K.cleared(f * (s + 1) / 3, g * (s + 1) / 3)


def test_a_constant_denominator_is_cleared_with_its_sign() -> None:
    above, below = K.cleared(x / (s + 1), K.poly([-1]))
    assert (str(above), str(below)) == ("-x", "s + 1")
