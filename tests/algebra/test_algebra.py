"""The exact arithmetic: every operation against another way to compute the same thing."""

from __future__ import annotations

import pickle
import random
from fractions import Fraction
from itertools import islice
from math import gcd, prod

import pytest
import strategies
import sympy
from build import QQ, AlgebraicField, Budget, Field, FunctionField, Poly, RatFunc, decompose, generated, parametrize
from flint import Ordering, fmpz_mpoly_ctx, fmpz_poly, nmod_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import LimitExceeded, Limits
from kovacic.algebra import modular
from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.extension import norm
from kovacic.algebra.factors import combination, expansions, product
from kovacic.algebra.lifting import Lifter, prime, rational_reconstruction
from kovacic.algebra.partial_fractions import reduce_poles
from kovacic.algebra.rationals import RationalPoly, square_part
from kovacic.algebra.recurrence import polynomial_solution
from kovacic.algebra.sparse import factorisation
from kovacic.algebra.traces import characteristic_polynomial, is_provably_not_a_square
from kovacic.engine.local import trace_of_square_root

P = prime(0)
small = st.integers(-9, 9)
rationals = st.builds(Fraction, st.integers(-50, 50), st.integers(1, 12))
polynomials = st.lists(rationals, max_size=6).map(QQ.poly)
nonzero = polynomials.filter(bool)
SQRT5 = AlgebraicField(QQ, QQ.poly([-5, 0, 1]))
CUBIC = AlgebraicField(QQ, QQ.poly([-2, 0, 0, 1]))


def over(field: AlgebraicField) -> st.SearchStrategy[Poly]:
    parts = st.lists(polynomials, min_size=field.dimension, max_size=field.dimension)
    return parts.map(lambda p: sum((q * field.generator**i for i, q in enumerate(p)), field.poly([])))


@settings(max_examples=20)
@given(polynomials, nonzero)
def test_division_leaves_a_smaller_remainder(a: RationalPoly, b: RationalPoly) -> None:
    q, r = divmod(a, b)
    assert a == q * b + r
    assert r.degree < b.degree


@pytest.mark.parametrize("leading", [1, 3])
def test_long_division_leaves_a_smaller_remainder(leading: int) -> None:
    """Of every length, whatever the pieces in which it is done."""
    rng = random.Random(7)
    b = QQ.poly([*(rng.randint(-9, 9) for _ in range(20)), leading])
    for degree in range(101, 240, 3):
        a = QQ.poly([Fraction(rng.randint(-9, 9), 5) for _ in range(degree)] + [1])
        q, r = divmod(a, b)
        assert a == q * b + r
        assert r.degree < b.degree


@pytest.mark.parametrize("field", [QQ, SQRT5, FunctionField(("s", "t"))], ids=str)
def test_sympy_has_the_same_values(field: Field) -> None:
    c = field.poly([3])
    value = 3
    if field == SQRT5:
        c, value = SQRT5.generator, sympy.Symbol("c")
    elif isinstance(field, FunctionField):
        c, value = field.generator("s"), sympy.Symbol("s")
    x = sympy.Symbol("x")
    f = field.poly([Fraction(1, 3), c, 0, -2 * c, 5])
    found = f.to_sympy(x)
    assert sympy.expand(found - (sympy.Rational(1, 3) + value * x - 2 * value * x**3 + 5 * x**4)) == 0


@settings(max_examples=20)
@given(nonzero, st.integers(2, 3))
def test_roots_of_powers_and_of_other_polynomials(f: RationalPoly, n: int) -> None:
    radical = f.monic() // f.gcd(f.derivative())
    assert (radical**n).root(n) == radical
    assert (radical**n * QQ.poly([7, 1])).root(n) is None
    if radical.degree > 0:
        assert (radical**n + 1).root(n) is None


@pytest.mark.parametrize("field", [QQ, SQRT5, CUBIC, FunctionField(("s", "t"))], ids=str)
def test_roots_of_powers_over_every_kind_of_field(field: Field) -> None:
    x = field.poly([0, 1])
    c = field.generator("s") if isinstance(field, FunctionField) else getattr(field, "generator", field.poly([2]))
    for radical in ((x - c) * (x * x + c * x + 3), x + c):
        for n in (1, 2, 3):
            assert (radical**n).root(n) == radical
            assert (radical**n * (x - 1)).root(n + 1) is None
            assert (radical**n * (x - 1) ** (n + 1)).root(n + 1) is None


@pytest.mark.long
@generated(6)
@given(st.data(), st.sampled_from([QQ, SQRT5]), st.integers(0, 40))
def test_a_factor_is_removed_as_often_as_it_divides(data: st.DataObject, field: AlgebraicField, count: int) -> None:
    elements = polynomials if field == QQ else over(field)
    factor = data.draw(elements.filter(lambda f: f.degree > 0))
    rest = data.draw(elements.filter(lambda f: bool(f) and not (f.degree >= factor.degree and not f % factor)))
    assert (rest * factor**count).remove(factor) == (rest, count)


def test_a_multiplicity_that_grows_modulo_the_prime_is_found_out() -> None:
    p = next(QQ.homomorphisms()).p
    x = QQ.poly([0, 1])
    factor, rest = x - 1, x - 1 - p
    assert (factor**19 * rest**2).remove(factor) == (rest**2, 19)


@settings(max_examples=20)
@given(st.data(), st.sampled_from([QQ, SQRT5]))
def test_cleared_functions_have_coprime_integer_coordinates(data: st.DataObject, field: AlgebraicField) -> None:
    num, den = (data.draw(polynomials if field == QQ else over(field)) for _ in range(2))
    f = RatFunc(num, den if den else field.poly([Fraction(3, 7)]))
    above, below = f.cleared()
    coordinates = [*above.rational_coefficients(), *below.rational_coefficients()]
    assert RatFunc(above, below) == f
    assert {int(c.q) for c in coordinates} == {1}
    assert gcd(*(int(c.p) for c in coordinates)) == 1
    p, q = num.content()
    scaled = [int((c * q / p).p) for c in num.rational_coefficients()]
    assert gcd(*scaled) == (1 if num else 0)
    assert num.content() == Poly.content(num)


@pytest.mark.long
@pytest.mark.parametrize("field", [SQRT5, CUBIC], ids=str)
@given(data=st.data())
def test_extension_arithmetic_is_a_ring_with_division_and_gcd(field: AlgebraicField, data: st.DataObject) -> None:
    a, b, c = (data.draw(over(field)) for _ in range(3))
    assert a * (b + c) == a * b + a * c
    assert (a * b) * c == a * (b * c)
    if b:
        q, r = divmod(a, b)
        assert a == q * b + r
        assert r.degree < b.degree
    if a and b and c:
        common = (a * c).gcd(b * c)
        assert not common % c.monic()
        assert not (a * c) % common
        assert not (b * c) % common
        assert common.is_monic


@settings(max_examples=15)
@given(over(CUBIC).filter(bool) | over(SQRT5).filter(bool))
def test_norm_is_the_product_over_the_conjugates(a: Poly) -> None:
    value = norm(a)
    for bundle, _ in zip(a.field.bundles(), range(2), strict=False):
        images = [h(a) for h in bundle]
        assert bundle[0](value) == prod(images, start=nmod_poly([1], bundle[0].p))


def test_homomorphisms_and_coordinates_are_inverse_to_each_other() -> None:
    a = SQRT5.poly([Fraction(3, 7), 2]) + SQRT5.generator * SQRT5.poly([1, Fraction(-5, 11), 4])
    lifter = Lifter(SQRT5)
    for bundle in SQRT5.bundles():
        proposal = lifter.add(bundle, [[h(a)] for h in bundle])
        if proposal is not None:
            assert proposal == [a]
            return


@pytest.mark.long
@given(st.lists(st.fractions(max_denominator=10**12), min_size=1, max_size=5))
def test_lifting_recovers_rationals_of_any_size(values: list[Fraction]) -> None:
    vector = QQ.poly([*values, 1])
    lifter = Lifter(QQ)
    for bundle in islice(QQ.bundles(), 40):
        if lifter.add(bundle, [[h(vector)] for h in bundle]) == [vector]:
            return
    raise AssertionError("not recovered from 40 primes")


@settings(max_examples=20)
@given(st.integers(-(10**12), 10**12), st.integers(1, 10**12), st.sampled_from([(1, 1), (10**12, 1), (1, 10**12)]))
def test_rational_reconstruction_inverts_reduction(n: int, d: int, scales: tuple[int, int]) -> None:
    """However the digits are shared out between the numerator and the denominator."""
    value = Fraction(n * scales[0], d * scales[1])
    modulus = P * prime(1)
    residue = value.numerator * pow(value.denominator, -1, modulus) % modulus
    bound = abs(value.numerator) * value.denominator
    assert rational_reconstruction(residue, modulus, bound) == (value.numerator, value.denominator)


def test_long_numerators_over_short_denominators_need_half_of_the_primes() -> None:
    """Three primes have 180 bits: 3^90/7 has 145, and lengths of numerator and denominator that add up to so many will do."""
    vector = QQ.poly([Fraction(3**90, 7), 1])
    lifter = Lifter(QQ)
    for bundle in islice(QQ.bundles(), 3):
        proposal = lifter.add(bundle, [[h(vector)] for h in bundle])
    assert proposal == [vector]


@pytest.mark.parametrize("degree", [0, 1, 7])
def test_polynomial_solutions_of_a_long_operator(degree: int) -> None:
    """P'' + q P' + r P = 0 with r = -(P'' + q P')/P for a P with simple zeros at those of q: the operator has degree 40."""
    x = QQ.poly([0, 1])
    P = prod((x - k for k in range(degree)), start=QQ.poly([1]))
    second = P * (x**33 + 3 * x + 5)
    first = P * (x**32 - 2)
    zeroth = -(second * P.derivative().derivative() + first * P.derivative()) // P
    assert polynomial_solution(second, first, zeroth, degree) == P
    assert polynomial_solution(second, first, zeroth + x, degree) is None


@settings(max_examples=20)
@given(nonzero, nonzero)
def test_factoring_multiplies_back(a: RationalPoly, b: RationalPoly) -> None:
    product = a * b * b
    assert prod((f**k for f, k in QQ.factor(product)), start=QQ.poly([1])) == product.monic()


@pytest.mark.parametrize("field", [SQRT5, CUBIC], ids=str)
def test_factoring_over_an_extension(field: AlgebraicField) -> None:
    x, c = field.poly([0, 1]), field.generator
    for polynomial in (x**4 - 25, x**3 - 2, (x - c) ** 2 * (x + c + 1), x**2 + 1):
        factors = field.factor(polynomial)
        assert prod((f**k for f, k in factors), start=field.poly([1])) == polynomial.monic()
    assert [f.degree for f, _ in SQRT5.factor(SQRT5.poly([-25, 0, 0, 0, 1]))] == [1, 1, 2]


@settings(max_examples=20)
@given(nonzero, nonzero, nonzero, nonzero, st.fractions(-20, 20, max_denominator=7))
def test_rational_functions_agree_with_their_values(a: Poly, b: Poly, c: Poly, d: Poly, point: Fraction) -> None:
    f, g = RatFunc(a, b), RatFunc(c, d)

    def value(h: RatFunc) -> Fraction:
        return Fraction(h.num(point).constant()) / h.den(point).constant()  # type: ignore[attr-defined]

    for h in (f + g, f - g, f * g, f / g, f.derivative(), f**-2):
        assert h.den.lc == 1
        assert h.num.gcd(h.den).degree <= 0
    assert f.derivative() == RatFunc(a.derivative() * b - a * b.derivative(), b * b)
    if all(p(point) for p in (b, c, d)):
        assert value(f + g) == value(f) + value(g)
        assert value(f / g) == value(f) / value(g)
        assert value(f(RatFunc(QQ.poly([point])))) == value(f)


def test_printing_uses_integer_coefficients() -> None:
    x = RatFunc(QQ.poly([0, 1]))
    c = SQRT5.generator
    assert str((x**2 - Fraction(1, 4)) / (3 * x**2)) == "(4*x**2 - 1)/(12*x**2)"
    assert str(-x / 2) == "-x/2"
    assert str(1 / x**2) == "1/x**2"
    assert str(c * SQRT5.poly([1, 1]) / 2) == "(c*x + c)/2"
    assert str(c * SQRT5.poly([0, 2]) + SQRT5.poly([0, -1, 3])) == "3*x**2 + (2*c - 1)*x"
    assert str(x * 0) == "0"


@settings(max_examples=15)
@given(over(SQRT5), nonzero)
def test_polynomials_and_rational_functions_pickle_and_hash(a: Poly, b: Poly) -> None:
    f = RatFunc(a, b)
    copy = pickle.loads(pickle.dumps(f))
    assert copy == f
    assert hash(copy) == hash(f)


def test_mutation_is_refused() -> None:
    with pytest.raises(AttributeError):
        QQ.poly([1]).rep = None  # type: ignore[misc]
    with pytest.raises(AttributeError):
        RatFunc(QQ.poly([1])).num = QQ.poly([2])  # type: ignore[misc]


@pytest.mark.parametrize("degree", [0, 2, 7, 90])
@pytest.mark.parametrize("order", [1, 2, 63, 64, 65, 66, 129, 300])
def test_series_at_a_singular_point_satisfy_the_equation(degree: int, order: int) -> None:
    """One by one or by halves: the equation holds to as many terms as are known."""
    rng = random.Random(f"{degree}/{order}")
    second, first, zeroth = (nmod_poly([rng.randrange(P) for _ in range(degree + 1)], P) for _ in range(3))
    second = second.left_shift(1)
    u = modular.series_solution(second, first, zeroth, order)
    assert u[0] == 1
    assert u.degree() < order
    residual = second * u.derivative().derivative() + first * u.derivative() + zeroth * u
    assert not residual.truncate(order - 1)


@parametrize("count", [1, 2, 3, 49, 50, 67], ordinary=3)
@pytest.mark.parametrize("long", [False, True])
def test_expansions_are_those_of_the_quotient(count: int, long: bool) -> None:
    """Known sums of partial fractions, and a numerator whose expansions have long coefficients."""
    rng = random.Random(f"{count} {long}")
    factors = [(QQ.poly([-c, 1]), rng.randint(1, 6)) for c in range(count - count // 3)]
    factors += [(QQ.poly([c, 0, 1]), rng.randint(1, 6)) for c in range(2, count // 3 + 2)]
    den = product([p**k for p, k in factors])
    leading = [QQ.poly([rng.randint(1, 9) for _ in range(max(k // 2, 1) * p.degree)]) for p, k in factors]
    parts = [(N + p ** max(k // 2, 1)) * (den // p**k) for N, (p, k) in zip(leading, factors, strict=True)]
    num = QQ.poly([rng.randint(1, 9) for _ in range(5)]) if long else sum(parts, QQ.poly([]))
    for (N, q), known, (p, k) in zip(expansions(num, den, factors), leading, factors, strict=True):
        modulus = p ** max(k // 2, 1)
        assert q.gcd(p) == 1
        assert (N * (den // p**k) - num * q) % modulus == 0
        assert N.degree < modulus.degree
        if not long:
            assert (N - known * q) % modulus == 0


@settings(max_examples=20)
@given(st.lists(small, min_size=1, max_size=5), st.lists(small, min_size=1, max_size=5), st.integers(2, 40))
def test_fundamental_system_satisfies_the_equation(num: list[int], den: list[int], order: int) -> None:
    n, d = nmod_poly(num, P), nmod_poly([den[0] or 1, *den[1:]], P)
    y1, y2 = modular.fundamental_system(n, d, order)
    for y in (y1, y2):
        assert not (d * y.derivative().derivative() - n * y).truncate(order - 2)
    assert (y1 * y2.derivative() - y1.derivative() * y2).truncate(order - 1) == 1


@settings(max_examples=20)
@given(st.lists(small, min_size=1, max_size=4), st.lists(small, min_size=1, max_size=4))
def test_rational_functions_come_back_from_their_series(a: list[int], b: list[int]) -> None:
    A, B = nmod_poly(a, P), nmod_poly([1, *b], P)
    order = A.length() + B.length() + 3
    series = A.mul_low(B.inverse_series_trunc(order), order)
    found = modular.rational_function_from_series(series, order, max(A.degree(), 0))
    assert found is not None
    assert found[0] * B == found[1] * A


def test_square_root_series() -> None:
    rng = random.Random(1)
    series = nmod_poly([9, *(rng.randrange(P) for _ in range(30))], P)
    root = modular.square_root_series(series, 31, 3)
    assert (root * root - series).truncate(31) == nmod_poly([], P)


@settings(max_examples=20)
@given(st.lists(small, min_size=2, max_size=5), st.lists(small, min_size=1, max_size=4))
def test_characteristic_polynomial_agrees_with_sympy(modulus: list[int], element: list[int]) -> None:
    p, g = QQ.poly([*modulus, 1]), QQ.poly(element)
    x, y = sympy.symbols("x y")
    resultant = sympy.resultant(
        sum(int(c) * x**i for i, c in enumerate([*modulus, 1])),
        y - sum(int(c) * x**i for i, c in enumerate(element)),
        x,
    )
    expected = sympy.Poly(resultant, y).monic()
    ours = characteristic_polynomial(g % p, p)
    assert [int(c) for c in expected.all_coeffs()[::-1]] == [int(c) for c in ours.coefficients()]


@settings(max_examples=20)
@given(st.lists(small, min_size=1, max_size=4))
def test_trace_of_a_square_root(element: list[int]) -> None:
    p = QQ.poly([-3, 1, 0, 0, 1])
    assert len(QQ.factor(p)) == 1
    a = QQ.poly(element)
    square = a * a % p
    trace = trace_of_square_root(square, p)
    expected = -characteristic_polynomial(a % p, p)[p.degree - 1]
    assert trace is not None
    assert trace in (expected, -expected)
    assert not is_provably_not_a_square(square, p)


def test_a_non_square_is_recognised() -> None:
    p = QQ.poly([-3, 1, 0, 0, 1])
    assert is_provably_not_a_square(QQ.poly([0, 1]), p)
    assert trace_of_square_root(QQ.poly([0, 1]), p) is None


@pytest.mark.parametrize("degree", [0, 1, 2, 7, 30])
def test_hermite_and_legendre_polynomials(degree: int) -> None:
    x = sympy.Symbol("x")
    cases = [
        (QQ.poly([1]), QQ.poly([0, -2]), QQ.poly([2 * degree]), sympy.hermite(degree, x)),
        (QQ.poly([1, 0, -1]), QQ.poly([0, -2]), QQ.poly([degree * (degree + 1)]), sympy.legendre(degree, x)),
    ]
    for second, first, zeroth, expected in cases:
        found = polynomial_solution(second, first, zeroth, degree)
        reference = [Fraction(int(c.p), int(c.q)) for c in sympy.Poly(expected, x).monic().all_coeffs()[::-1]]
        assert found is not None
        assert list(found.coefficients()) == reference
        assert polynomial_solution(second, first, zeroth, degree + 1) is None


def test_a_resonance_is_resolved() -> None:
    # x^2 y'' - 3 x y' + 3 y + (y' - y) has exponents 1 and 3 at infinity; demand the solution of degree 3.
    x = QQ.poly([0, 1])
    target = QQ.poly([5, -1, 7, 1])
    other = QQ.poly([2, 1])
    # The operator with the two polynomial solutions: det(y, target, other; ...).
    w2 = target * other.derivative() - other * target.derivative()
    w1 = -(target * other.derivative().derivative() - other * target.derivative().derivative())
    w0 = target.derivative() * other.derivative().derivative() - other.derivative() * target.derivative().derivative()
    found = polynomial_solution(w2, w1, w0, 3)
    assert found is not None
    assert not w2 * found.derivative().derivative() + w1 * found.derivative() + w0 * found
    assert polynomial_solution(w2, w1, w0, 1) == other.monic()
    assert polynomial_solution(w2, w1, w0, 2) is None
    assert x.degree == 1


def test_a_resonance_with_a_solution_that_is_no_polynomial() -> None:
    """x^3 + x and x + 1/x: where the coefficient of x is set to 0, something is left that a multiple of x + 1/x takes away."""
    x = RatFunc(QQ.poly([0, 1]))
    y1 = x**3 + x
    y2 = x + 1 / x
    first, second = y1.derivative(), y2.derivative()
    w2 = y1 * second - y2 * first
    w1 = y2 * first.derivative() - y1 * second.derivative()
    w0 = first * second.derivative() - second * first.derivative()
    operator = [(w * x**4).num for w in (w2, w1, w0)]
    assert polynomial_solution(*operator, 3) == y1.num
    assert polynomial_solution(*operator, 1) is None


@pytest.mark.parametrize(
    ("field", "degree"), [(QQ, 17), (QQ, 25), (QQ, 40), (SQRT5, 3), (SQRT5, 8), (CUBIC, 3), (CUBIC, 7)], ids=str
)
def test_inverses_modulo_a_polynomial_of_high_degree_are_those_of_euclid(field: AlgebraicField, degree: int) -> None:
    constant = 1 if field == QQ else field.generator - Fraction(1, 3)
    modulus = field.poly([constant, *range(2, degree + 1), Fraction(7, 3)])
    element = modulus.derivative() * Fraction(1, 5) + constant
    inverse = element.inverse_modulo(modulus)
    assert inverse == Poly.inverse_modulo(element, modulus)
    assert (inverse * element - 1) % modulus == 0
    with pytest.raises(ZeroDivisionError):
        (modulus * element).inverse_modulo(modulus)


@settings(max_examples=15)
@given(over(SQRT5))
def test_homomorphisms_of_a_tower_agree_on_the_fields_below(f: Poly) -> None:
    c = SQRT5.generator
    tower = AlgebraicField(SQRT5, SQRT5.poly([c + 3, 0, 1]), "d")
    higher = AlgebraicField(tower, tower.poly([tower.generator + 1, 0, 0, 1]), "e")
    homomorphism = next(higher.homomorphisms())
    assert homomorphism(f) == homomorphism(tower.embed(f)) == homomorphism(higher.embed(f))
    assert homomorphism(tower.generator) ** 2 == homomorphism(-c - 3)
    assert homomorphism(higher.generator) ** 3 == homomorphism(-tower.generator - 1)


@settings(max_examples=20)
@given(st.lists(st.tuples(st.integers(-(10**25), 10**25), st.integers(-3, 3), small), min_size=1, max_size=4), small)
def test_sparse_polynomials_factor_whatever_their_coefficients_are(
    rows: list[tuple[int, int, int]], content: int
) -> None:
    context = fmpz_mpoly_ctx.get(("x", "t"), Ordering.lex)
    x, t = context.gens()
    whole = context.constant(content or 1) * prod((x * c + t * b + a for a, b, c in rows), start=context.constant(1))
    if whole == 0:
        return
    constant, factors = factorisation(whole)
    assert prod((f**k for f, k in factors), start=context.constant(constant)) == whole
    assert all(f.total_degree() == 1 for f, _ in factors)


@pytest.mark.long
@generated(6)
@given(st.lists(polynomials.filter(lambda f: f.degree > 0), min_size=1, max_size=4), st.integers(1, 7), st.booleans())
def test_factors_of_powers_are_those_of_their_roots(parts: list[RationalPoly], n: int, equal: bool) -> None:
    """Powers of long squarefree polynomials, of others, and products with different multiplicities."""
    base = prod(parts, start=QQ.poly([7, 0, 3] + [0] * 48 + [5]))
    power = base**n if equal else base**n * parts[0]
    assert by_text(QQ.factor(power)) == by_text(QQ.factor(-6 * power)) == by_text(factors_of_flint(power))


def factors_of_flint(f: RationalPoly) -> list[tuple[Poly, int]]:
    return [(QQ.poly([int(c) for c in factor.coeffs()]).monic(), k) for factor, k in f.rep.numer().factor()[1]]


def by_text(factors: list[tuple[Poly, int]]) -> list[tuple[str, int]]:
    return sorted((str(factor), k) for factor, k in factors)


def test_a_product_with_the_degree_of_a_power_is_none() -> None:
    """a b^3 has the degree of (a b)^2."""
    a, b = (QQ.poly([c, 1] + [0] * 29 + [1]) for c in (3, 5))
    assert by_text(QQ.factor(a * b**3)) == by_text(factors_of_flint(a * b**3))


@settings(max_examples=20)
@given(st.fractions(-5000, 5000, max_denominator=500).filter(bool))
def test_the_square_part_leaves_no_square(value: Fraction) -> None:
    outer, rest = square_part(value)
    assert outer * outer * rest == value
    assert all(exponent == 1 for exponent in sympy.factorint(abs(rest)).values())


@pytest.mark.parametrize("bits", [50, 20_000])
def test_zeros_however_near_they_are_to_one_another(bits: int) -> None:
    """(16 N^2 + 3) - 32 N x + 16 x^2 has the zeros N +- i sqrt(3)/4, and 2 N - 3 x that of a rational number."""
    N = 2**bits + 1
    quadratic = fmpz_poly([16 * N * N + 3, -32 * N, 16])
    zeros = complex_zeros(quadratic)
    assert sorted(round(float(zero.imag.mid()) ** 2 * 16) for zero, _ in zeros) == [3, 3]
    assert all(quadratic(zero).contains(0) and zero.real.contains(N) for zero, _ in zeros)
    ((only, multiplicity),) = complex_zeros(fmpz_poly([4 * N * N, -12 * N, 9]))
    assert multiplicity == 2
    assert (3 * only).contains(2 * N)


def test_zeros_that_take_long_to_isolate_are_isolated_in_a_process() -> None:
    """Of coefficients with 5,000 bits and degree 3, that lie far apart."""
    cubic = fmpz_poly([-(2**5001), 2**5000, -2, 1])
    (first, _), *others = complex_zeros(cubic)
    assert first.contains(2)
    assert len(others) == 2
    with Budget(Limits(seconds=0)).watched(), pytest.raises(LimitExceeded):
        complex_zeros(cubic + 1)


@pytest.mark.long
@generated(6)
@given(
    st.integers(1, 900),
    st.integers(0, 900),
    st.sampled_from([101, 10007, (1 << 61) - 1]),
    st.randoms(use_true_random=False),
    st.booleans(),
)
def test_the_fraction_is_that_of_euclids_algorithm(
    order: int, top: int, p: int, rng: random.Random, rational: bool
) -> None:
    assume(top < order)
    series = nmod_poly([rng.randrange(p) for _ in range(order)], p)
    if rational:
        P = nmod_poly([1, *(rng.randrange(p) for _ in range(rng.randrange(order)))], p)
        series = series.truncate(rng.randrange(order) + 1).mul_low(P.inverse_series_trunc(order), order)
    r0, r1, t0, t1 = nmod_poly([1], p).left_shift(order), series, nmod_poly([], p), nmod_poly([1], p)
    while r1.degree() > top:
        quotient, rest = divmod(r0, r1)
        r0, r1, t0, t1 = r1, rest, t1, t0 - quotient * t1
    found = modular.rational_function_from_series(series, order, top)
    if not t1[0]:  # then t divides both components, and the quotient agrees to fewer terms
        assert found is None
        return
    assert found is not None
    A, B = found
    assert A.degree() == r1.degree()
    assert A * t1 == B * r1
    assert A == (B * series).truncate(order)


@pytest.mark.long
@given(strategies.rational_functions(5))
def test_partial_fractions_add_up(r: RatFunc) -> None:
    parts = decompose(r)
    assert parts.derivative == r
    assert all(residue.value.degree < residue.factor.degree for residue in parts.residues)


def test_combinations_over_a_field_with_a_parameter() -> None:
    S = kovacic.solve("y'' = (a*x + 1)/x^2*y", var="x").S
    field = S.field
    a = S.num[1]
    p, q = field.poly([1, a]), field.poly([a, 0, 1])
    target = p * a - q * (a + 1)
    assert combination(target, [p, q]) == [a, -(a + 1)]
    assert combination(target + field.poly([0, 0, 0, 1]), [p, q]) is None


@pytest.mark.long
@given(
    strategies.rational_functions(3),
    strategies.polynomials(1, 4).filter(lambda p: bool(p[0]) and p.gcd(p.derivative()).degree == 0).map(Poly.monic),
    st.integers(2, 30),
    st.fractions(-2, 2, max_denominator=3),
    st.integers(-3, 3),
)
def test_reduction_at_a_pole(r: RatFunc, p: Poly, order: int, alpha: Fraction, n: int) -> None:
    """r = L(W) + rest, the rest having p once in its denominator."""
    x = RatFunc(QQ.poly([0, 1]))
    numerator, denominator = r.num, r.den.remove(p)[0]
    assume(numerator and denominator.gcd(p).degree == 0 and numerator.gcd(p).degree == 0)
    slope = alpha / x + 2 * n * x ** (n - 1) if n else alpha / x
    r = RatFunc(numerator, denominator * p**order)
    W, rest, _ = reduce_poles(r, slope, apart=QQ.poly([0, 1]))
    assert W.derivative() + W * slope + rest == r
    assert rest.den.remove(p)[1] <= 1


@pytest.mark.parametrize(
    ("modulus", "over"),
    [([7, 3, 1], None), ([1, 0, -10, 0, 1], None), ([576, 0, -960, 0, 352, 0, -40, 0, 1], None), ([-3, 1, 0, 0, 0, 1], None),
     ([-2, 0, 0, 1], [-5, 0, 1]), ([1, 0, 1], [-2, 0, 0, 1])],
)  # fmt: skip
def test_square_roots_in_number_fields(modulus: list[int], over: list[int] | None) -> None:
    """Of squares of generators, of squares in smaller fields whose roots are outside of these, and of what is no square."""
    field = AlgebraicField(QQ, QQ.poly(modulus))
    if over is not None:
        field = AlgebraicField(field, field.poly([*over]), "d")
    c = field.generator
    middle = c * field.dimension + field.modulus[field.dimension - 1]  # in a quadratic field its square is rational
    for root in (c, c * c + 3, c**3 - 2 * c + 7, c**2 * c - 11 * c, (c + 4).inverse(), field.poly([5]), middle):
        found = field.sqrt(root * root)
        assert found in (root, -root)
        assert field.sqrt(root * root * 7) is None
        assert field.sqrt(root * root * (c * c + 1000)) is None


def test_ordinary_points_are_tried_outwards_from_0() -> None:
    """0, 1, -1, 2, -2, ...: the first one at which a polynomial modulo p isn't 0."""
    p = 10007
    den = nmod_poly([1], p)
    for point in (0, 1, -1, 2, -2, 3):
        assert modular.ordinary_point(den) == point
        den = den * nmod_poly([-point % p, 1], p)
