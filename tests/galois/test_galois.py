"""The differential Galois group: published groups, constructions, matrices, and the local monodromies."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import gcd, lcm

import published
import pytest
import strategies
import sympy
import transform
from build import QQ, AlgebraicField, Budget, Equation, Field, Ground, RatFunc, analyse, generated, parametrize, verify
from forged import CurveFunction, claimed
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import checker
from kovacic.galois import Group, GroupKind

X = RatFunc(QQ.poly([0, 1]))


def published_name(group: str) -> str:
    """The name in `cases.jsonl` in this package's words."""
    names = {
        "A4^SL2 (order 24)": "SL(2,3)",
        "S4^SL2 (order 48)": "binary octahedral",
        "A5^SL2 (order 120)": "SL(2,5)",
        "Gm": "G_m",
        "Dinf": "N(T)",
        "Q8 (=binary D2)": "dicyclic of order 8",
        "{a^1=1}xGa": "G_a",
    }
    if group in names:
        return names[group]
    if match := re.fullmatch(r"binary D\d+ \(order (\d+)\)", group):
        return f"dicyclic of order {match[1]}"
    if match := re.fullmatch(r"\{a\^(\d+)=1\}xGa", group):
        return f"G_a extended by mu_{match[1]}"
    return group


PUBLISHED = [pytest.param(row.S, published_name(row.group), id=row.id) for row in published.load() if row.group]


@parametrize(("S", "name"), PUBLISHED, ordinary=43, long=55)
def test_published_groups(S: str, name: str) -> None:
    assert kovacic.solve(S).group.name == name


def test_the_published_groups_are_many() -> None:
    assert len(PUBLISHED) >= 100


@pytest.mark.parametrize(
    ("S", "name", "ground"),
    [
        ("0", "trivial", Ground.ALL_INVARIANT),
        ("1", "G_m", Ground.EXPONENTIAL),
        ("2/x^2", "trivial", Ground.ALL_INVARIANT),
        ("3/(4*x^2)", "mu_2", Ground.ALL_INVARIANT),
        ("-1/(4*x^2)", "G_a extended by mu_2", Ground.RESIDUES),
        ("-2/(9*x^2)", "mu_3", Ground.RESIDUES),
        ("1/x^2", "G_m", Ground.IRRATIONAL),
        ("x^2 + 3", "Borel", Ground.EXPONENTIAL),
        ("x", "SL2", Ground.NO_LIOUVILLIAN),
        ("-3/(16*x^2) + 1/x", "N(T)", Ground.IRREGULAR),
    ],
)
def test_small_equations(S: str, name: str, ground: Ground) -> None:
    group = kovacic.solve(S).group
    assert (group.name, group.ground) == (name, ground)


@pytest.mark.parametrize(
    ("omega", "name"),
    [
        (1 / X - 2 / (X - 1) - 1 / (X + Fraction(1, 2)), "trivial"),  # (x - 1)^4 (x + 1/2)^2/x^2 has no residue
        (1 / X - 2 / (X - 1) - 1 / (X + 1), "G_a"),  # (x - 1)^4 (x + 1)^2/x^2 has one, but (x - 1)(x + 1)/x^2 none
        (Fraction(1, 3) / X - 3 / (X - 1), "mu_3"),
    ],
    ids=str,
)
def test_the_second_solution_of_a_rational_one(omega: RatFunc, name: str) -> None:
    """y2 = y1 int dx/y1^2 lies in the field of y1 exactly if no residue is in the way; there is none of x^(-2/3) (x - 1)^6."""
    solution = kovacic.solve(transform.from_omega(omega))
    assert solution.group.name == name
    assert solution.verify()


@pytest.mark.long
@generated(8)
@given(strategies.distinct_irreducibles(1, 3, 3), st.data())
def test_a_unique_omega_with_rational_residues(factors: list, data: st.DataObject) -> None:
    """y1 = prod p^r has y1^n rational exactly for the multiples of the common denominator of the exponents r."""
    exponents = [data.draw(strategies.fractions(5, (1, 2, 3, 4, 5, 6))) for _ in factors]
    omega = sum((r * RatFunc(p.derivative(), p) for r, p in zip(exponents, factors, strict=True)), X * 0)
    n = lcm(*(r.denominator for r in exponents))
    group = kovacic.solve(transform.from_omega(omega)).group
    assert group.kind in (GroupKind.CYCLIC, GroupKind.ADDITIVE)
    assert group.n == n


@pytest.mark.long
@generated(8)
@given(strategies.distinct_irreducibles(1, 3, 3), strategies.nonzero(5), st.data())
def test_an_exponential_omega(factors: list, slope: int, data: st.DataObject) -> None:
    exponents = [data.draw(strategies.fractions(3)) for _ in factors]
    omega = sum((r * RatFunc(p.derivative(), p) for r, p in zip(exponents, factors, strict=True)), X * 0) + slope
    assert kovacic.solve(transform.from_omega(omega)).group.kind in (GroupKind.BOREL, GroupKind.MULTIPLICATIVE)


@pytest.mark.long
@generated(8)
@given(strategies.products((-2, -1, 1, 2)), strategies.nonzero(6))
def test_a_rational_product_of_solutions_with_irrational_wronskian(F: RatFunc, w: int) -> None:
    """y1 y2 = F: the group is diagonal, and finite only if the residues of w/F are rational."""
    group = kovacic.solve(transform.from_product(F, w)).group
    assert group.kind in (GroupKind.CYCLIC, GroupKind.MULTIPLICATIVE)
    assert group.kind is GroupKind.MULTIPLICATIVE or group.n is not None


@pytest.mark.parametrize("n", [2, 3, 4, 5, 6, 7, 12])
def test_pull_backs_of_dihedral_equations_on_a_line(n: int) -> None:
    """The group of the hypergeometric equation with differences 1/2, 1/2, 1/n is dicyclic of order 4n."""
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, n))
    assert kovacic.solve(S).group.n == n
    assert kovacic.solve(transform.moebius(S, 1, 2, 3, -5)).group.order == 4 * n


@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize(
    "f", [X**3 + X + 1, (X**2 + 1) / (X - 3), (X**4 - X + 3) / (X**2 + 2)], ids=["genus 1-2", "genus 1", "genus 2-3"]
)
def test_pull_backs_of_dihedral_equations_on_curves_of_positive_genus(n: int, f: RatFunc) -> None:
    """u^n is sqrt(f) + sqrt(f - 1), which isn't a power on these curves."""
    S = transform.pull_back(transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, n)), f)
    solution = kovacic.solve(S)
    assert solution.group.ground is Ground.FUNCTION
    assert solution.group.n == n
    assert solution.verify()
    assert not any(
        verify(S, solution.decision, claimed(solution.group.claim, n=k)) for k in range(1, 2 * n + 1) if k != n
    )


@parametrize(
    "f",
    [
        (X**2 + 3 * X + 5) / (X + 1),
        (3 * X**2 + X - 7) / (2 * X**2 - 5 * X + 1),
        (X**4 + 3 * X**3 + X - 7) / (2 * X**3 - 5 * X + 1),
    ],
    ordinary=1,
    ids=["genus 1", "genus 1, no rational pole", "genus 3"],
)
@pytest.mark.parametrize(("difference", "n"), [((1, 1000), 1000), ((5, 2), 2), ((3001, 1000), 1000)])
def test_large_orders_and_large_multiples_on_curves(f: RatFunc, difference: tuple[int, int], n: int) -> None:
    """u^n is a power of sqrt(f) + sqrt(f - 1) in lowest terms: the order is 4n."""
    S = transform.pull_back(transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(*difference)), f)
    solution = kovacic.solve(S)
    assert solution.group.order == 4 * n
    assert solution.verify()
    assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))


@pytest.mark.parametrize(("constant", "order"), [(6, 24), (-6, None)])
def test_the_same_divisor_with_another_holomorphic_part(constant: int, order: int | None) -> None:
    """On z^2 = (x+2)^2 - x^3, -(x + c)/(6x) dx/z has the same residues for c = 6 and -6 after the sign; one is a logarithm."""
    g = ((X + 2) ** 2 - X**3) * 4 * X**2 / (X + constant) ** 2
    solution = kovacic.solve(transform.from_squared_product(g, Fraction(1, 9)))
    group = solution.group
    assert group.order == order
    assert group.function is not None
    assert bool(group.function.rest) is (order is None)
    assert solution.verify()
    assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))
    without = replace(group.function, rest=group.function.rest * 0)
    family, n = ("dicyclic", 6) if order is None else ("infinite dihedral", None)
    for function in (group.function, without):
        claim = claimed(group.claim, family=family, n=n, function=function)
        assert not verify(solution.S, solution.decision, claim)


def pell(genus: int, field: Field, rest: int, multiple: Fraction) -> RatFunc:
    """S with y1/y2 = exp(int eta), eta = multiple * (da + rest dx)/y on y^2 = a^2 - 3: da/y is d log(a + y), a + y a unit."""
    c = field.generator if isinstance(field, AlgebraicField) else 2
    a = field.poly([1, c, *[0] * (genus - 1), 1])
    above = (a.derivative() + rest) * multiple
    return transform.from_squared_difference(RatFunc(above * above, a * a - 3))


NUMBER_FIELDS = [QQ, AlgebraicField(QQ, QQ.poly([-2, 0, 1]), "sqrt(2)"), AlgebraicField(QQ, QQ.poly([1, 0, 1]), "I")]


@parametrize(
    ("genus", "field", "multiple"),
    list(product([1, 2, 3], NUMBER_FIELDS, [Fraction(1, 1000), Fraction(4001, 1000)])),
    ordinary=0,
    long=1,
    ids=str,
)
def test_a_unit_beside_a_differential_of_the_first_kind(genus: int, field: Field, multiple: Fraction) -> None:
    """The divisor of eta is a torsion one in both cases; only the holomorphic rest tells the infinite group."""
    for rest, order in ((0, 4000), (5, None)):
        solution = kovacic.solve(str(pell(genus, field, rest, multiple)), var="x")
        group = solution.group
        assert group.order == order
        assert bool(group.function.rest) is bool(rest)
        assert solution.verify()
        claim = group.claim
        for wrong in (rest + 1, rest - 1, -rest) if rest else (1, -1):
            function = replace(group.function, rest=group.function.rest * 0 + wrong)
            assert not verify(solution.S, solution.decision, replace(claim, function=function))
        other = (
            claimed(claim, family="dicyclic", n=1000) if rest else claimed(claim, family="infinite dihedral", n=None)
        )
        assert not verify(solution.S, solution.decision, other)
        if field == QQ:
            assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))


def test_a_unit_itself_beside_a_differential_of_the_first_kind() -> None:
    """log u is d log(a + y) and 5 dx/y: no multiple has to be taken."""
    solution = kovacic.solve(pell(1, QQ, 5, Fraction(1)))
    assert (solution.group.name, solution.group.function.multiple) == ("N(T)", 1)
    assert solution.verify()


@pytest.mark.parametrize("genus", [1, 2, 3])
def test_the_differential_of_a_unit_isnt_of_the_first_kind(genus: int) -> None:
    """It has poles at infinity, da/y for the unit a + y, so that it is no holomorphic rest: the group is finite."""
    solution = kovacic.solve(pell(genus, QQ, 0, Fraction(1, 5)))
    assert solution.group.order == 20
    a = QQ.poly([1, 2, *[0] * (genus - 1), 1])
    forged = CurveFunction(5, a * a - 3, (), a.derivative())
    claim = claimed(solution.group.claim, family="infinite dihedral", n=None, function=forged)
    assert not verify(solution.S, solution.decision, claim)
    data = json.loads(solution.to_json())
    written = {"multiple": 5, "h": str(forged.h), "pieces": [], "rest": str(forged.rest)}
    data["group"] = {"name": "N(T)", "order": None, "finite": False, "function": written}
    assert "the rest is holomorphic" in checker.verdict(json.dumps(data))


@pytest.mark.parametrize("multiple", [Fraction(401), Fraction(4001, 1000)], ids=str)
@parametrize(
    "h", [X**3 - X + 4, X**5 - X + 4, X**6 + X**5 + X + 4], ordinary=1, ids=["genus 1", "genus 2", "genus 2, even"]
)
def test_large_multiples_of_a_divisor_of_infinite_order(h: RatFunc, multiple: Fraction) -> None:
    """eta = multiple * 2 dx/(x y) has the poles (0, 2) and (0, -2), and infinity stays an ordinary point or a branch point."""
    solution = kovacic.solve(transform.from_squared_difference((2 * multiple / X) ** 2 / h))
    group = solution.group
    assert (group.name, group.ground) == ("N(T)", Ground.NOT_TORSION)
    verification = solution.verify()
    assert verification
    assert not verification.unchecked
    assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))
    (p, k), other = group.orders
    for orders in (((p, k + 1), other), ((p, 2 * k), other), ((p, k), (p, k)), ((p, other[1]), other)):
        assert not verify(solution.S, solution.decision, replace(group.claim, orders=orders))


@pytest.mark.long
@pytest.mark.parametrize("h", [X**6 + X**5 + X + 4, X**8 + X**5 + X + 4], ids=["genus 2", "genus 3"])
def test_whole_multiples_are_checked_to_four_thousand(h: RatFunc) -> None:
    """The invariant is x^8002 beside powers of the branch points."""
    solution = kovacic.solve(transform.from_squared_difference((8002 / X) ** 2 / h))
    assert solution.group.ground is Ground.NOT_TORSION
    assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))


@pytest.mark.parametrize("m", [3, 4, 5, 6, 12])
@pytest.mark.parametrize("A", [X**2 + X + 1, X**3 - 3 * X + 5, X**5 + X - 1], ids=str)
def test_units_of_pell_equations(A: RatFunc, m: int) -> None:
    """u = (A + z)^(2/m) with z^2 = A^2 - 3, a curve of positive genus on which A + z isn't a power."""
    S = transform.from_squared_product((A * A - 3) / A.derivative() ** 2, Fraction(4, m * m))
    assert kovacic.solve(S).group.n == (m if m % 2 else m // 2)


@pytest.mark.parametrize("w_squared", [1, 4, 9])
def test_a_divisor_of_infinite_order(w_squared: int) -> None:
    group = kovacic.solve(transform.from_squared_product((X**4 + X + 1) / (X + 2) ** 2, w_squared)).group
    assert (group.name, group.ground) == ("N(T)", Ground.NOT_TORSION)


def test_a_divisor_of_infinite_order_of_the_same_order_modulo_two_primes() -> None:
    """Order 9 modulo 5 and 7, 25 modulo 17: the evidence has two primes that differ."""
    group = kovacic.solve(transform.from_squared_product((X**4 - 4 * X + 1) / (X + 1) ** 2, 1)).group
    assert group.ground is Ground.NOT_TORSION
    assert group.orders == ((5, 9), (17, 25))


def test_a_differential_of_the_first_kind() -> None:
    group = kovacic.solve(transform.from_squared_product(X**3 + X + 1, 5)).group
    assert (group.name, group.ground) == ("N(T)", Ground.FIRST_KIND)


def test_an_order_that_is_a_large_prime() -> None:
    S = transform.from_squared_product(((X**3 + X + 1) ** 2 - 3) / (3 * X**2 + 1) ** 2, Fraction(4, 1009**2))
    solution = kovacic.solve(S)
    assert solution.group.order == 4 * 1009
    assert solution.verify()


@pytest.mark.long
@generated(8)
@given(strategies.examples("case 1", "case 2"))
def test_local_monodromies_lie_in_the_group(example: strategies.Example) -> None:
    """In PGL2, a local monodromy has the denominator of Delta as its order, or is infinite."""
    solution = kovacic.solve(example.S)
    group = solution.group
    for place in analyse(example.S, Budget()).places:
        if place.kind.name == "ORDINARY":
            continue
        if place.logarithm:
            assert group.kind in (GroupKind.ADDITIVE, GroupKind.BOREL)
        elif place.delta is None:
            assert not group.finite
        elif group.kind is GroupKind.CYCLIC:
            assert (group.n if group.n % 2 else group.n // 2) % place.delta.denominator == 0
        elif group.kind is GroupKind.DICYCLIC:
            assert place.delta.denominator == 2 or group.n % place.delta.denominator == 0


@pytest.mark.long
@generated(8)
@given(strategies.examples("case 3"))
def test_primitive_groups(example: strategies.Example) -> None:
    group = kovacic.solve(example.S).group
    assume(example.group is not None)
    orders = {strategies.TETRAHEDRAL: 24, strategies.OCTAHEDRAL: 48, strategies.ICOSAHEDRAL: 120}
    assert group.order == orders[example.group]


@pytest.mark.parametrize(
    "group",
    [Group(GroupKind.CYCLIC, Ground.RESIDUES, n) for n in (1, 2, 3, 4, 7)]
    + [Group(GroupKind.DICYCLIC, Ground.FUNCTION, n) for n in (2, 3, 4, 5)]
    + [Group(kind, Ground.PRIMITIVE) for kind in (GroupKind.TETRAHEDRAL, GroupKind.OCTAHEDRAL, GroupKind.ICOSAHEDRAL)],
    ids=lambda group: group.name,
)
def test_the_matrices_generate_a_group_of_the_right_order(group: Group) -> None:
    def key(m: list[complex]) -> tuple[complex, ...]:
        return tuple(complex(round(z.real, 6) + 0.0, round(z.imag, 6) + 0.0) for z in m)

    def times(a: list[complex], b: list[complex]) -> list[complex]:
        product = [a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2]]
        return [*product, a[2] * b[1] + a[3] * b[3]]

    generators = [[complex(sympy.N(entry, 20)) for entry in matrix] for matrix in group.generators()]
    one = [1 + 0j, 0j, 0j, 1 + 0j]
    elements, new = {key(one)}, [one]
    while new:
        products = {key(p): p for element in new for g in generators if key(p := times(element, g)) not in elements}
        new = list(products.values())
        elements.update(products)
        assert len(elements) <= 200
    assert len(elements) == group.order
    assert all(abs(a * d - b * c - 1) < 1e-5 for a, b, c, d in elements)


def test_the_diagonal_group_has_a_free_parameter() -> None:
    (matrix,) = kovacic.solve("1").group.generators()
    assert matrix.det() == 1
    assert len(matrix.free_symbols) == 1
    assert kovacic.solve("x^2 + 3").group.generators() is None


@pytest.mark.parametrize(
    ("S", "order", "finite", "dimension"),
    [
        ("-3/(16*x^2)", 4, True, 0),
        ("1", None, False, 1),
        ("x^2 + 3", None, False, 2),
        ("-3/(16*x^2) + 1/x", None, False, 1),
        ("x", None, False, 3),
    ],
)
def test_properties(S: str, order: int | None, finite: bool, dimension: int) -> None:
    solution = kovacic.solve(S)
    group = solution.group
    assert (group.order, group.finite, group.dimension) == (order, finite, dimension)
    assert solution.is_algebraic is finite


# ------------------------------------------------------------------------------------- the group with the gauge


@settings(max_examples=12)
@given(st.lists(strategies.fractions(4, (1, 2, 3, 4, 6)), min_size=4, max_size=4))
def test_two_products_of_powers_have_the_group_of_their_exponents(exponents: list[Fraction]) -> None:
    """z1 = x^p (x-1)^q and z2 = x^r (x-1)^s: the characters are the classes of a(p, q) + b(r, s) modulo Z^2."""
    p, q, r, s = exponents
    omegas = [p / X + q / (X - 1), r / X + s / (X - 1)]
    if omegas[0] == omegas[1]:
        return
    # z'' + b z' + c z = 0 with both: b = -(w1' + w1^2 - w2' - w2^2)/(w1 - w2), c = -(w1' + w1^2 + b w1).
    images = [w.derivative() + w * w for w in omegas]
    b = -(images[0] - images[1]) / (omegas[0] - omegas[1])
    c = -(images[0] + b * omegas[0])
    answer = kovacic.solve(Equation(X * 0 + 1, b, c, X * 0))
    n = lcm(*(e.denominator for e in exponents))
    classes = {((i * p + j * r) % 1, (i * q + j * s) % 1) for i in range(n) for j in range(n)}
    assert answer.equation_group.order == len(classes)
    assert answer.is_algebraic


@pytest.mark.parametrize(
    ("text", "name", "finite"),
    [
        ("x^2*y'' + x*y' + (x^2-1/4)*y = 0", "G_m", False),
        ("y'' + 2*y' + y = 0", "G_m", False),
        ("y'' + y' = 0", "G_m", False),
        ("y'' - 3*y' + 2*y = 0", "G_m", False),
        ("y'' - (1 + sqrt(2))*y' + sqrt(2)*y = 0", "G_m x G_m", False),
        ("(1-x^2)*y'' - 2*x*y' + 6*y = 0", "G_a", False),
        ("(1-x^2)*y'' - x*y' + y/4 = 0", "mu_2 x mu_2", True),
        ("x^2*y'' - x*y'/3 + y/3 = 0", "mu_3", True),
        ("x*y'' + y' + x*y = 0", "SL2", False),
        ("y'' + y'/(3*x) + x*y = 0", "SL2 with the scalars mu_6", False),
        ("y'' + 2*y' - x*y = 0", "GL2", False),
        ("y'' = 0", "trivial", True),
        ("4*x*y'' + 2*y' + y = 0", "O(2)", False),
        ("x*y'' - y'/2 + y = 0", "O(2)", False),
        ("y'' = (1/x - 3/(16*x^2))*y", "N(T)", False),
    ],
)
def test_groups_of_equations(text: str, name: str, finite: bool) -> None:
    answer = kovacic.solve(text)
    assert str(answer.equation_group) == answer.equation_group.name == name
    assert answer.is_algebraic is finite


@pytest.mark.parametrize(
    ("gauge", "name"),
    [
        (Fraction(1, 2) / X, "N(T)"),
        (Fraction(1, 4) / X, "O(2)"),
        (Fraction(1, 4) / (X - 1), "N(T) with the scalars mu_4"),
        (Fraction(1, 8) / X, "N(T) with the scalars mu_4, twisted"),
        (Fraction(1, 3) / X, "N(T) with the scalars mu_6"),
        (Fraction(1, 6) / X, "N(T) with the scalars mu_6"),
        (X, "N(T) with the scalars G_m"),
    ],
)
def test_infinite_dihedral_groups_with_scalars(gauge: RatFunc, name: str) -> None:
    """y1 y2 = sqrt(x) for the normal form; the gauge factor x^(1/4) makes y1 and y2 cos and sin of sqrt(x), times sqrt(x)."""
    S = kovacic.solve("y'' = (-1/x - 3/(16*x^2))*y").S
    assert str(kovacic.solve(with_gauge(S, gauge)).equation_group) == name


def with_gauge(S: RatFunc, rho: RatFunc) -> Equation:
    return Equation(X * 0 + 1, -2 * rho, rho * rho - rho.derivative() - S, X * 0)


@pytest.mark.parametrize("n", [1, 2, 3, 4, 6, 10])
@pytest.mark.parametrize("third", [3, 4, 5])
def test_primitive_groups_with_scalars(third: int, n: int) -> None:
    """The gauge (x - 2)^(1/n) has nothing to do with the group: its scalars are those of mu_n and -1."""
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, third))
    answer = kovacic.solve(with_gauge(S, Fraction(1, n) / (X - 2)))
    group = answer.equation_group
    assert group.order == group.normal_form.order // 2 * lcm(2, n)


def test_gauges_that_are_semi_invariants() -> None:
    """A factor that G multiplies by a character of order 3 (SL(2,3)) or 2 (the binary octahedral group) adds nothing."""
    for third, e in ((3, 3), (4, 2)):
        S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, third))
        theta = kovacic.solve(S).semi_invariant.theta
        if theta.num.field != QQ:
            continue
        group = kovacic.solve(with_gauge(S, theta)).equation_group
        assert (group.scalars, group.order) == (e, group.normal_form.order)


@pytest.mark.parametrize("n", [2, 3, 4, 5])
@pytest.mark.parametrize("m", [2, 3, 4, 5, 8])
def test_dicyclic_groups_with_scalars(n: int, m: int) -> None:
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, n))
    group = kovacic.solve(with_gauge(S, Fraction(1, m) / (X - 2))).equation_group
    assert group.order == 2 * n * lcm(2, m)


def test_the_order_of_a_twist_by_signs_in_two_ways() -> None:
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, 6))
    for rho in (Fraction(1, 2) / X, Fraction(1, 2) / (X - 1), Fraction(1, 2) / (X + 3)):
        group = kovacic.solve(with_gauge(S, rho)).equation_group
        assert group.order == group.normal_form.order == 24


def test_a_group_of_an_undecided_equation() -> None:
    answer = kovacic.solve("x^4 + x^2 + 42*x + 1/4", limits=kovacic.Limits(unknown_degree=5))
    assert (answer.group, answer.equation_group, answer.is_algebraic) == (None, None, None)


# ------------------------------------------------------------------------------- characters, and curves, in two ways


def equation_with(first: RatFunc, second: RatFunc) -> Equation:
    """The equation z'' + b z' + c z = 0 that two different rational functions z'/z belong to."""
    images = [w.derivative() + w * w for w in (first, second)]
    b = -(images[0] - images[1]) / (first - second)
    return Equation(X * 0 + 1, b, -(images[0] + b * first), X * 0)


@settings(max_examples=12)
@given(st.tuples(*[strategies.fractions(6, (1, 2, 3))] * 2), st.tuples(*[strategies.fractions(5, (1, 2, 3, 4, 6))] * 2))
def test_two_exponentials_have_the_group_of_their_relation(
    rates: tuple[Fraction, Fraction], powers: tuple[Fraction, Fraction]
) -> None:
    """z1 = x^p exp(a x), z2 = x^q exp(b x): with a v = -b u for coprime integers u, v the relations are the multiples k of
    (u, v) with k (u p + v q) an integer, so that the group is G_m x mu_n, n the denominator of u p + v q."""
    (a, b), (p, q) = rates, powers
    assume((a or b) and (a, p) != (b, q))
    group = kovacic.solve(equation_with(a + p / X, b + q / X)).equation_group
    u, v = b, -a
    d = lcm(u.denominator, v.denominator)
    scale = Fraction(d, gcd(int(u * d), int(v * d)))
    n = (scale * (u * p + v * q)).denominator
    assert group.name == ("G_m" if n == 1 else f"G_m x mu_{n}")


@pytest.mark.parametrize(
    ("third", "part", "order"),
    [(4, Fraction(1, 2), 48), (4, Fraction(1, 4), 96), (4, Fraction(3, 2), 48), (3, Fraction(1, 3), 72),
     (3, Fraction(-1, 1), 24), (3, Fraction(2, 3), 72), (5, Fraction(1, 1), 120)],
)  # fmt: skip
def test_gauges_that_are_roots_of_semi_invariants(third: int, part: Fraction, order: int) -> None:
    """gamma = f^(1/m), where G multiplies f by its character epsilon: the pairs (g, c) with c^m = epsilon(g) are m |G| many,
    and their products c g half as many if (-1, -1) is among them."""
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, third))
    solution = kovacic.solve(S)
    theta = solution.semi_invariant.theta
    assert kovacic.solve(with_gauge(S, part * theta)).equation_group.order == order


def test_semi_invariants_and_other_gauges_are_told_apart() -> None:
    """The same orders of gamma, without a relation to G."""
    for third, N, order in ((4, 4, 96), (3, 9, 216), (3, 3, 72)):
        S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, third))
        assert kovacic.solve(with_gauge(S, Fraction(1, N) / (X - 2))).equation_group.order == order


@pytest.mark.parametrize(
    "text", ["y'' + a*y' + (a^2/4 - x)*y = 0", "y'' + 2*y' + (1 - n/x^2)*y = 0", "y'' + n/x*y' + y = 0"]
)
def test_a_gauge_beside_parameters_has_no_group(text: str) -> None:
    answer = kovacic.solve(text, var="x")
    assert answer.group is not None
    assert answer.equation_group is None


def test_a_normal_form_with_parameters_has_its_group() -> None:
    answer = kovacic.solve("y'' = (x + a)*y", var="x")
    assert answer.equation_group.name == answer.group.name == "SL2"


@pytest.mark.slow
def test_a_curve_of_genus_one_beside_a_parameter_ends() -> None:
    """Lame's equation with n = 1: no prime field takes the parameter, so orders modulo primes decide nothing."""
    group = kovacic.solve("(4*x^3 - 28*x + 24)*y'' + (6*x^2 - 14)*y' = (2*x + B)*y", var="x").group
    assert group.kind in (GroupKind.IMPRIMITIVE, GroupKind.INFINITE_DIHEDRAL)
    assert group.order is None


def test_three_conjugate_semi_invariants() -> None:
    """Exponent differences 1/2 at the roots of x^3 - 2: each pair of lines of the quaternion group belongs to one root."""
    answer = kovacic.solve("-27*x/(8*(x^3-2)^2)")
    assert answer.constants.degree == 3
    assert answer.group.name == "dicyclic of order 8"
    assert answer.verify()


def test_orders_without_small_primes() -> None:
    """On a curve of genus 12 no prime is small enough to count in the Jacobian: functions are looked for from order 1 on."""
    for n in (2, 3):
        S = transform.pull_back(transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, n)), X**13 + X + 1)
        group = kovacic.solve(S).group
        assert (group.kind, group.n, group.ground) == (GroupKind.DICYCLIC, n, Ground.FUNCTION)


@parametrize("shift", range(7), ordinary=2)
@pytest.mark.parametrize("n", [5, 7])
def test_the_order_doesnt_depend_on_the_coordinate(n: int, shift: int) -> None:
    """Singular points at the residues that the computation modulo 5, 7, 11 begins with, and an order that 5 or 7 divides."""
    for f in ((X**2 + 1) / (X - 3), X * (X - 1) * (X + 2), (X**3 + 1) / (X**2 - X)):
        S = transform.pull_back(transform.hypergeometric(Fraction(1, 2), Fraction(1, 2), Fraction(1, n)), f)
        assert kovacic.solve(transform.moebius(S, 1, shift, 0, 1)).group.n == n


@pytest.mark.parametrize(
    ("third", "gauge", "name", "scalars"),
    [
        (4, Fraction(1, 2) / (X - 2), "binary octahedral, twisted by signs", 2),
        (4, Fraction(1, 4) / (X - 2), "binary octahedral with scalars, order 96", 4),
        (3, Fraction(1, 3) / (X - 2), "SL(2,3) with scalars, order 72", 3),
        (5, Fraction(2, 1) / (X - 2), "SL(2,5)", 1),
        (5, X, "SL(2,5) with the scalars G_m", None),
    ],
)
def test_names_of_primitive_groups_with_scalars(third: int, gauge: RatFunc, name: str, scalars: int | None) -> None:
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, third))
    group = kovacic.solve(with_gauge(S, gauge)).equation_group
    assert (group.name, group.scalars) == (name, scalars)


@pytest.mark.parametrize(
    ("n", "name"), [(1, "SL2"), (2, "SL2"), (3, "SL2 with the scalars mu_6"), (4, "SL2 with the scalars mu_4")]
)
def test_names_of_sl2_with_scalars(n: int, name: str) -> None:
    """z = x^(1/n) y with Airy's y: SL2 contains -1."""
    group = kovacic.solve(with_gauge(X, Fraction(1, n) / X)).equation_group
    assert (group.name, group.scalars, group.finite, group.order) == (name, n, False, None)


@parametrize("N", [4, 6, 8, 12], ordinary=1, long=1)
@pytest.mark.parametrize("third", [Fraction(1, 2), Fraction(1, 3), Fraction(1, 4), Fraction(3, 2), Fraction(7, 3)])
def test_orders_with_scalars_on_curves_of_positive_genus(third: Fraction, N: int) -> None:
    """A map with general branch points leaves the group in GL2 as it is, which is known on the line: by the residues there.

    Solutions are y(f)/sqrt(f') for the normal forms; without the factor sqrt(f') in the gauge there are signs that have nothing
    to do with the group, as those of sqrt(x - 7).
    """
    S = transform.hypergeometric(Fraction(1, 2), Fraction(third.numerator > 1) + Fraction(1, 2), third)
    f = [(X**2 + 1) / (X - 3), (X**2 + 3 * X + 5) / (X + 1), X**3 + X + 1][N % 3]
    slope = f.derivative()
    pulled_back = transform.pull_back(S, f)
    for radicand in (X - 2, X, X * (X - 1), X * (X - 1) ** 2, X**2 + X + 1):
        rho = radicand.derivative() / radicand / N
        for signs, on_curve in (
            (X * 0, rho(f) * slope + slope.derivative() / slope / 2),
            (Fraction(1, 2) / (X - 7), rho(f) * slope),
        ):
            expected = kovacic.solve(with_gauge(S, rho + signs)).equation_group
            found = kovacic.solve(with_gauge(pulled_back, on_curve)).equation_group
            assert expected.order is not None
            assert (found.name, found.order, found.finite) == (expected.name, expected.order, True), (radicand, signs)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("(1-x^2)*y'' - x*y' + y/9 = 0", "S3"),  # cos(arccos(x)/3), a root of 4 y^3 - 3 y = x
        ("(1-x^2)*y'' - x*y' + y/16 = 0", "dihedral of order 8"),
        ("(1-x^2)*y'' - x*y' + 4*y/25 = 0", "dihedral of order 10"),
        ("(1-x^2)*y'' - x*y' + y/36 = 0", "dihedral of order 12"),
    ],
)
def test_groups_of_chebyshevs_equation_are_dihedral(text: str, name: str) -> None:
    """The solutions T_(p/q)(x) and U are the roots of a polynomial of degree q, permuted like the corners of a q-gon."""
    group = kovacic.solve(text).equation_group
    assert (group.name, group.finite) == (name, True)


@pytest.mark.parametrize(
    ("text", "name", "dimension"),
    [
        ("0", "trivial", 0),
        ("3/(4*x^2)", "mu_2", 0),
        ("-2/(9*x^2)", "mu_3", 0),
        ("1", "G_m", 1),
        ("2/x^2 + 2/(x-1)^2 + 8/(x*(x-1))", "G_a", 1),
        ("-1/(4*x^2)", "G_a extended by mu_2", 1),
        ("x^2 + 3", "Borel", 2),
        ("1/x - 3/(16*x^2)", "N(T)", 1),
        ("-27*x/(8*(x^3-2)^2)", "dicyclic of order 8", 0),
        ("x", "SL2", 3),
    ],
)
def test_dimensions_of_groups(text: str, name: str, dimension: int) -> None:
    group = kovacic.solve(text, var="x").group
    assert (group.name, group.dimension, group.finite) == (name, dimension, dimension == 0)


def _multiples(vector: tuple[Fraction, ...]) -> set[tuple[Fraction, ...]]:
    """The cyclic group that a vector generates modulo 1."""
    found = {tuple(0 * v for v in vector)}
    multiple = tuple(v % 1 for v in vector)
    while multiple not in found:
        found.add(multiple)
        multiple = tuple((u + v) % 1 for u, v in zip(multiple, vector, strict=True))
    return found


@parametrize("r", [Fraction(1, 8), Fraction(1, 3), Fraction(1, 6), Fraction(1, 10)], ordinary=1)
@parametrize(("n", "m", "k"), [(3, 3, 1), (3, 5, 1), (4, 2, 1), (2, 5, 1), (3, 3, 2), (5, 5, 4)], ordinary=1)
def test_a_gauge_with_its_poles_where_the_exponents_of_a_dicyclic_group_are(
    n: int, m: int, k: int, r: Fraction
) -> None:
    """x = z^2 and y+/y- = ((z-1)/(z+1))^(1/n) ((z-2)/(z+2))^(k/m), gamma = ((x-1)/(x-4))^r: all exponents in z are known."""
    root = Fraction(1, n) / (X - 1) + Fraction(2 * k, m) / (X - 4)
    S = transform.from_squared_product(X / (root * root), 1)
    half = Fraction(1, 2)
    for gauge, s, at_zero in (
        (r / (X - 1) - r / (X - 4), r, 0),
        (r / X, 0, 2 * r),
    ):  # the other one: gamma = x^r = z^(2r)
        group = kovacic.solve(with_gauge(S, gauge)).equation_group
        assert group.normal_form.n == lcm(n, m)
        rows = [(half + at_zero, half + at_zero)]
        for d, t in ((Fraction(1, n), s), (Fraction(k, m), -s)):
            rows += [((1 + d) / 2 + t, (1 - d) / 2 + t), ((1 - d) / 2 + t, (1 + d) / 2 + t)]
        one, other = (_multiples(exponents) for exponents in zip(*rows, strict=True))
        assert group.order == 2 * (len(one) * len(other) // len(one & other))


@pytest.mark.parametrize("multiple", [13, pytest.param(37, marks=pytest.mark.long)])
def test_of_three_pairs_of_lines_the_one_with_the_fewest_zeros_is_taken(multiple: int) -> None:
    """u + 1/u and u - 1/u are products of solutions of a quaternion equation, too, with more and more zeros; y1 y2 has none."""
    f = (X**4 - X + 3) / (X**2 + 2)
    half = Fraction(1, 2)
    solution = kovacic.solve(transform.pull_back(transform.hypergeometric(half, half, Fraction(multiple, 2)), f))
    assert solution.decision.semi_invariant.P.degree == 0
    assert solution.group.name == "dicyclic of order 8"
    assert solution.verify()
    assert "; case; omega; group;" in checker.verdict(solution.to_json(full=True))


def test_a_divisor_that_is_principal_itself() -> None:
    """u^2 = (y - 1)/(y + 1) on y^2 = x^3 + t: over Q(t) no prime shows an order, and the first one, 1, is right."""
    x, t = sympy.symbols("x t")
    f_squared = 4 * (x**3 + t) * (x**3 + t - 1) ** 2 / (9 * x**4)  # f = y1 y2 = 1/(log u)', with Wronskian 1
    phi = f_squared.diff(x) / (2 * f_squared)
    S = sympy.factor(phi.diff(x) / 2 + phi**2 / 4 + 1 / (4 * f_squared))
    assert kovacic.solve(S, var="x").group.name == "dicyclic of order 8"
