"""What conditions on parameters are made of: Schwarz's table, ranks, curves, regions that others cover, signs, and formulas."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import reduce
from itertools import product
from operator import mul
from random import Random
from typing import Any

import pytest
import sympy
from build import QQ, FunctionField, RatFunc, parametrize
from flint import fmpz_mat
from hypothesis import given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import Structure
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.engine.places import analyse
from kovacic.limits import Budget
from kovacic.parametric import prose
from kovacic.parametric.api import contradictions
from kovacic.parametric.assumptions import Known, check_values, linear_of, read_assumptions, words_of
from kovacic.parametric.claims import (
    EVEN,
    INTEGERS,
    ODD,
    AllOf,
    AnyOf,
    Claim,
    Classes,
    DegreeBySum,
    DegreeExists,
    EquationFor,
    ExponentRoot,
    Free,
    InClasses,
    IntegerFamily,
    IsNonzero,
    IsZero,
    Numbers,
    ParameterPoint,
    SumOfRoots,
    over_parameters,
)
from kovacic.parametric.exponents import _primitive, without_constant_pivots, zeros_of_forms
from kovacic.parametric.formulas import in_partial_fractions, root_written, shortest_form, with_gathered_powers
from kovacic.parametric.integers import Congruence, at_integers, natural_root, squares_of_roots
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import (
    NOT_ABELIAN,
    ParameterRegion,
    RegionVerdict,
    Theory,
    borel,
    without_empty,
    without_redundant,
)
from kovacic.parametric.restriction import hypersurface
from kovacic.parametric.riemann import Schwarz, kimura_statements, kimura_structure, verdict_by_exponents
from kovacic.parametric.search import search_special_values
from kovacic.parametric.solutions import PolynomialSolution, Progression, derivative, jacobi, natural_value
from kovacic.parametric.statements import ALWAYS, Setting, Statement, Vanishes, all_of
from kovacic.reading.read import read_input
from kovacic.writing.formula import text_of_words

F = Fraction


def test_schwarz_table_has_the_parities() -> None:
    assert kimura_structure((F(2, 3), F(1, 3), F(1, 3))) is Structure.TETRAHEDRAL
    assert kimura_structure((F(2, 3), F(5, 3), F(1, 3))) is Structure.TETRAHEDRAL
    assert kimura_structure((F(2, 3) + 1, F(1, 3), F(1, 3))) is Structure.REDUCIBLE
    assert kimura_structure((F(2, 5), F(2, 5), F(2, 5))) is Structure.ICOSAHEDRAL
    assert kimura_structure((F(2, 5), F(2, 5), F(7, 5))) is None
    assert kimura_structure((F(1, 2), F(5, 2), None)) is Structure.IMPRIMITIVE
    assert kimura_structure((F(5, 2), F(1, 3), F(1, 4))) is Structure.OCTAHEDRAL
    assert kimura_structure((None, F(1, 3), F(1, 3))) is None


@given(matrices=st.integers(0, 10**9))
@settings(max_examples=12)
def test_constant_pivots_lower_the_rank_by_one_each(matrices: int) -> None:
    random = Random(matrices)
    field = FunctionField(("a", "b"))
    a, b = (field.generator(name).num for name in "ab")
    one = field.context.constant(1)
    choices = [0 * one, 0 * one, one, -2 * one, 3 * one, a, b - 1, a * b + 2, a**2 - b]
    columns = [{i: random.choice(choices) for i in range(5)} for _ in range(3)]
    columns.append({i: columns[0][i] - 2 * columns[1][i] for i in range(5)})  # a full rank is kept by wrong steps, too
    rows, eliminated = without_constant_pivots(columns)
    assert not any(entry.is_constant() and entry for row in rows for entry in row)
    for values in ((0, 0), (1, 1), (2, 1), (-1, 2), (1, 2), (5, 7)):

        def rank(matrix: list[list[Any]]) -> int:
            if not matrix:
                return 0
            entries = [int(entry(0, *values)) for row in matrix for entry in row]  # noqa: B023
            return int(fmpz_mat(len(matrix), len(matrix[0]), entries).rank())

        assert rank([[column[i] for column in columns] for i in range(5)]) == rank(rows) + eliminated


@pytest.mark.parametrize(
    ("curve", "values"),
    [("p^2 - q^3", (8, 4)), ("4*p^3 + 27*q^2", (-3, 2)), ("p^5 + 32*q^2", (-2, 1)), ("3*p^4 - 5*q^3", (0, 0))],
)
def test_rational_curves(curve: str, values: tuple[int, int]) -> None:
    field = FunctionField(("p", "q"))
    p, q = field.generator("p"), field.generator("q")
    functions = {"p^2 - q^3": p**2 - q**3, "4*p^3 + 27*q^2": 4 * p**3 + 27 * q**2, "p^5 + 32*q^2": p**5 + 32 * q**2}
    function = functions.get(curve, 3 * p**4 - 5 * q**3)
    assert not function.value_at(values, QQ)
    found = hypersurface(function)
    assert not found.at(function)
    # T in p and q, at T's own values of p and q, is T.
    T, parameter = found.curve[0]
    assert isinstance(found.field, FunctionField)
    assert found.at(parameter) == found.field.generator(T)
    assert not hypersurface(p**2 - q).curve
    assert not hypersurface(p**2 * q - q**3 * p).curve


def test_what_earlier_regions_cover() -> None:
    field = FunctionField(("p", "q", "r"))
    p, q, r = map(field.generator, field.names)
    N = field.poly([0, 1])

    def root(equation: Any) -> Statement:
        return Congruence.make(equation, INTEGERS)

    def kept(*statements: Statement) -> list[int]:
        regions = [ParameterRegion(statement, RegionVerdict(None)) for statement in statements]
        return [regions.index(region) for region in without_empty(regions)]

    squares = root(N**2 - q)
    assert kept(squares, root(N**2 - 4 * q), squares) == [0, 1]
    # On the curve p^2 = q^3, q is the square of p/q, which needn't be an integer.
    assert kept(squares, all_of((Vanishes(p**2 - q**3), Vanishes(r)))) == [0, 1]
    assert kept(Vanishes(p * q - r), all_of((Vanishes(p - 2), Vanishes(r - 2 * q)))) == [0]
    assert kept(Vanishes(p * q - r), all_of((Vanishes(p - 2), Vanishes(r - 3 * q)))) == [0, 1]


@pytest.mark.long
def test_what_is_said_to_be_positive_is() -> None:
    field = FunctionField(("a", "b"))
    a, b = (over_parameters(field.generator(name)) for name in "ab")
    forms = [a * b - 1, a * a - b, a + b, a - 2, (a - 1) * (b + 1), a * a - 2 * a + 2, 3 - b, a * (3 - b), a - a + 1]
    numbers = [Fraction(k, 2) for k in range(-8, 9)]
    proven = 0
    for first, second in product([">0", ">=1", "<-1", "<=2 >0", ">=2"], [">=0", ">1", "<3", ">-1 <=1"]):
        known = read_assumptions({"a": first, "b": second}, None, ("a", "b"))
        points = [
            p for p in product(numbers, numbers) if known.admits(zip("ab", (QQ.poly([v]) for v in p), strict=True))
        ]
        assert points
        for form in forms:
            values = [QQ.rational_value(form.value_at(point, QQ)) for point in points]
            for or_zero in (False, True):
                if known.is_positive(over_parameters(form), or_zero=or_zero):
                    proven += 1
                    assert all(v is not None and (v > 0 or (or_zero and not v)) for v in values)
            assert known.vanishes(over_parameters(form)) is not False or all(values)
    assert proven > 60


def random_quotients() -> list[RatFunc]:
    """Of products of sums in three parameters and the integer n."""
    random, field = Random(11), FunctionField(("a", "b", "c"))
    a, b, c = map(field.generator, field.names)
    n = field.poly([0, 1])
    factors = [n, n + 1, 2 * n + 3, a, b, a + b, n - b - a, 2 * c - 1, a * c, b * b - 4 * a * c, n * n + b]

    def product() -> Any:
        chosen = [random.choice(factors) ** random.choice((1, 1, 2)) for _ in range(random.randint(0, 3))]
        return reduce(mul, chosen, field.poly([random.choice((1, -1, 2, -6))]))

    return [RatFunc(product() + random.choice((0, 1)) * product(), product()) for _ in range(120)]


@pytest.mark.long
def test_functions_are_read_back_as_they_are_written() -> None:
    n = sympy.Symbol("n")
    for function in random_quotients():
        text = shortest_form(function, "n")
        meant = function.num.to_sympy(n) / function.den.to_sympy(n)
        assert sympy.cancel(sympy.sympify(text.replace("^", "**")) - meant) == 0, text


@pytest.mark.long
def test_roots_are_read_back_as_they_are_written() -> None:
    for function in random_quotients():
        square = function.num[0]
        if square:
            text = root_written(square)
            root = sympy.sympify(text.replace("^", "**"))
            assert sympy.cancel(sympy.expand(root**2) - square.to_sympy(sympy.Symbol("x"))) == 0, text


# ------------------------------------------------------------------------------- families that a symmetry permutes

FAMILY_FIELD = FunctionField(("n",))
n, d = FAMILY_FIELD.generator("n"), FAMILY_FIELD.poly([0, 1])


def values(text: str, n: Fraction, largest: int = 40) -> bool:
    """What a line such as "n or -n - 1 = 2*d, d/2 + 1 or +-(d - 3)" says, with d up to a bound."""
    left, right = text.split(" = ")
    functions = right.replace(" or ", ", ").split(", ")
    signed = [s + f.replace("+-", "") for f in functions for s in (("", "-") if f.startswith("+-") else ("",))]
    return any(
        eval(form, {"n": n}) == eval(f, {"d": Fraction(d)})  # arithmetic that this package wrote
        for form in left.split(" or ")
        for f in signed
        for d in range(largest)
    )


@parametrize(
    ("functions", "total", "expected"),
    [
        ([2 * d, 2 * d + 1, 2 * d + 3], -1, "n or -n - 1 = "),
        ([(d + 1) / 4, (d + 9) / 4, d + Fraction(1, 2)], -1, "n or -n - 1 = "),
        ([d / 2, 3 * d - 2], 5, "n or 5 - n = "),
        ([d, 2 * d + 1], 0, "n = +-"),
        ([3 * d + 1], -1, "n = 3*d + 1 or -3*d - 2"),
    ],
    ordinary=0,
    long=(0, 1),
)
def test_symmetric_families_are_written_once(functions: list, total: int, expected: str) -> None:  # type: ignore[type-arg]
    families = [*functions, *(total - f for f in functions)]
    equations = [over_parameters((d * 0 + n - f).monic()) for f in families]
    text = degrees_as_text(equations)
    assert text.startswith(expected)
    assert text.count("d") == (2 if len(functions) == 1 else len(functions))
    constants = [[Fraction(int(v.numerator), int(v.denominator)) for v in f.rational_coefficients()] for f in families]
    for k in range(-60, 61):
        value = Fraction(k, 4)
        holds = any(c[0] + c[1] * number == value for c in constants for number in range(40))
        assert values(text, value) == holds, (text, value)


def degrees_as_text(equations: list[FunctionPoly]) -> str:
    """Which d are roots of the equations."""
    claim = DegreeExists("d", natural_root(equations, "d", Setting()), 1, lambda *_: True)
    return text_of_words(prose.sentence(claim)).removesuffix(", d in N, and Delta_d = 0")


def test_a_family_without_its_mirror_image_is_not_merged() -> None:
    equations = [over_parameters((n - f).monic()) for f in (2 * d, -2 * d - 1, 2 * d + 2, 3 * d + 5)]
    assert degrees_as_text(equations).startswith("n = ")


def test_nothing_is_proven_where_the_exponents_at_three_conjugate_points_differ() -> None:
    """A ramified point at infinity excludes case 1; case 2 remains."""
    field = FunctionField(("a",))
    x = RatFunc(field.poly([0, 1]))
    S = (field.generator("a") * x + 1) / (x**3 - 2) ** 2 + x
    assert search_special_values(analyse(S, Budget())).unproven == [
        "case 2 where the exponents at conjugate points differ"
    ]


def test_roots_are_sums_of_square_roots_only_for_even_polynomials() -> None:
    field = FunctionField(("a", "b"))
    a, b = map(field.generator, field.names)
    N = field.poly([0, 1])
    assert squares_of_roots(N**4 - 2 * (a + b) * N**2 + (a - b) ** 2) == [a, b]
    assert squares_of_roots(N**4 - 2 * (a + b) * N**2 + a * N + (a - b) ** 2) is None


@pytest.mark.parametrize(
    ("residues", "modulus", "expected"),
    [
        ([1, 3], 4, ODD),
        ([2, 4], 4, EVEN),
        ([F(1, 2), F(3, 2)], 2, Classes.of([F(1, 2)], 1)),
        ([0, 1, 2], 6, Classes((0, 1, 2), F(6))),
    ],
)
def test_classes_have_the_least_modulus(residues: list[F], modulus: int, expected: Classes) -> None:
    assert Classes.of(residues, modulus) == expected


def test_two_functions_of_an_integer_are_one_formula() -> None:
    """`c +- f` for c free of the integer, and no number but 0."""
    field = FunctionField(("a", "b"))
    d = RatFunc(field.poly([0, 1]))
    b = field.generator("b")

    def said(*functions: RatFunc) -> str:
        families = tuple(IntegerFamily("d", "a", function, INTEGERS) for function in functions)
        degree = DegreeExists("d", AnyOf(families), 1, lambda *_: True)
        return text_of_words(prose.sentence(degree)).partition(",")[0]

    assert said(d + 1, -d - 1) == "a = +-(d + 1)"
    assert said(b + d, b - d) == "a = b +- d"
    assert said(2 * d, 1 - 2 * d) == "a = 2*d or -2*d + 1"
    assert said(d, b * d) == "a = d or b*d"
    assert said(2 * d, 2 * d + 1, -2 * d - 1, -2 * d - 2) == "a or -a - 1 = 2*d or 2*d + 1"


def test_words_of_parts() -> None:
    """What single parts say where the whole is seldom seen: exclusions, theorems, verdicts, kinds of numbers."""
    field = FunctionField(("a",))
    values = [field.poly([1]), field.poly([5]), field.poly([4]), field.generator("a")]
    rest, left = Progression(1, 2).without(values)
    assert rest == Progression(3, 2)
    assert left == [values[1], values[3]]
    twice = Theory("x").also(", y", "K").also(", y", "K")
    assert (twice, twice.sources) == ("x, y", ("K",))
    unknown = RegionVerdict(None, known=False)
    assert str(unknown) == "not determined"
    region = ParameterRegion(ALWAYS, unknown)
    assert region.why_no_solution == "nothing is solved where the answer is: not determined"
    assert not region.plain
    assert replace(region, verdict=RegionVerdict(None)).plain
    assert not replace(region, verdict=RegionVerdict(None), shown_degree=2).plain
    assert Known(("half-integer",)).sympy_properties() == ["rational", "noninteger"]
    assert words_of(sympy.Symbol("n", integer=False)) == ["noninteger"]
    assert Known((">0", "<1000")).may_be_among(INTEGERS)
    assert not Known((">1/4", "<3/4")).may_be_among(INTEGERS)
    with pytest.raises(kovacic.InputError, match="values are needed for n"):
        check_values({"m": 1}, ("n",))


def test_exponents_at_conjugate_points() -> None:
    """At two of them a square root is adjoined, which is one more letter in the conditions."""
    field = FunctionField(("a",))
    x = RatFunc(field.poly([0, 1]))
    two = analyse((field.generator("a") * x + 1) / (x**2 + 1) ** 2, Budget())
    numbers = zeros_of_forms(two, 4)
    assert numbers is not None
    assert [square.to_str("x") for square in numbers.squares] == ["a*I", "-a*I"]


def test_degrees_of_invariants_that_are_possible() -> None:
    """A simple pole, or a double exponent, means a logarithm, which excludes case 2."""
    field = FunctionField(("a",))
    x = RatFunc(field.poly([0, 1]))
    a = field.generator("a")

    def degrees(S: RatFunc) -> list[int]:
        conditions = search_special_values(analyse(S, Budget())).conditions
        return [one.m for one in conditions if isinstance(one, Natural)]

    assert 4 in degrees(a / x**2 + a / (x - 1) ** 2 + x**2)
    assert 4 not in degrees(a / x**2 + a / (x - 1) + x**2)
    assert 4 not in degrees(a / x**2 - 1 / (4 * (x - 1) ** 2) + x**2)


def test_invariants_at_a_point() -> None:
    field = FunctionField(("a",))
    x = RatFunc(field.poly([0, 1]))
    point = ParameterPoint(("a",), (QQ.poly([F(5, 16)]),))
    bessel = Natural(field.generator("a") / x**2 + x, 4, None)
    assert bessel.holds(point)
    assert not bessel.holds(replace(point, values=(QQ.poly([1]),)))


def test_forms_that_are_linear() -> None:
    field = FunctionField(("a", "b"))
    a, b = map(field.generator, field.names)
    linear = linear_of(3 * a - b / 2 + 1)
    assert linear is not None
    assert (linear.constant, linear.factors) == (1, {"a": 3, "b": F(-1, 2)})
    assert linear_of(a * b) is linear_of(a**2) is linear_of(b / a) is None


def test_numbers_among_roots() -> None:
    """Of polynomials over a number field; of sums with multiples of a square root, at a point."""
    root = AlgebraicField(QQ, QQ.poly([-2, 0, 1]), "s")
    N = root.poly([0, 1])
    assert INTEGERS.has_root_of((N - 1) * (N - root.generator)) is True
    assert INTEGERS.has_root_of((N - F(1, 2)) * (N - root.generator)) is False
    assert natural_value(sympy.sqrt(3 + 2 * sympy.sqrt(2)) - sympy.sqrt(2)) == 1
    field = FunctionField(("a",))
    point = ParameterPoint(("a",), (QQ.poly([4]),))
    sums = Numbers(F(1), (ExponentRoot(field.generator("a"), 1),), field, field)
    assert [*DegreeBySum("d", sums, ("j",), has_zero=True).numbers_at(point)] == [1, 3]
    assert [*DegreeBySum("d", sums, ("j",)).numbers_at(point)] == [3]
    assert [*DegreeBySum("d", replace(sums, only_signs=True)).numbers_at(point)] == [3]


def test_a_region_that_a_later_one_covers_with_the_same_verdict() -> None:
    field = FunctionField(("p", "q"))
    p, q = map(field.generator, field.names)
    first = ParameterRegion(all_of((Vanishes(p), Vanishes(q))), RegionVerdict(Structure.REDUCIBLE))
    second = ParameterRegion(Vanishes(p), RegionVerdict(Structure.REDUCIBLE))
    assert without_redundant([first, second], None) == (second,)
    assert without_redundant([first, replace(second, verdict=RegionVerdict(None))], None)[0] == first


def test_groups_in_words() -> None:
    field = FunctionField(("a",))
    x = RatFunc(field.poly([0, 1]))
    S = -F(3, 16) / x**2 + field.generator("a") / (x - 1) ** 2 + F(1, 5) / (x * (x - 1))
    verdict = verdict_by_exponents(analyse(S, Budget()), Structure.IMPRIMITIVE)
    assert verdict.group == (
        "dicyclic where the third exponent difference is rational, else the infinite dihedral group"
    )
    assert borel().group == "the Borel group"
    half = field.poly([F(1, 4)])
    cubic = over_parameters((field.poly([0, 1]) - half) ** 2 * (field.poly([0, 1]) - field.generator("a")))
    schwarz = Schwarz(cubic, (Structure.IMPRIMITIVE,))
    assert not schwarz.holds(ParameterPoint.generic(field))  # there are reducible equations among them
    assert schwarz.holds(ParameterPoint(("a",), (QQ.poly([2]),)))


KIMURA = "(a^2-1)/(4*x^2) + (b^2-1)/(4*(x-1)^2) + (1-a^2-b^2+c^2)/(4*x*(x-1))"  # the exponent differences a, b, c


@pytest.mark.parametrize(
    ("S", "where", "otherwise"),
    [
        ("a/x^2", "sqrt(4*a + 1) is", "G_m"),  # two points: no difference is 1 at a third one
        ("(a^2-1)/(4*x^2*(x-1)^2)", "a is", "G_m"),
        ("-2/(9*x^2) + b/(x-1)^2 + 2/(9*x*(x-1))", "sqrt(4*b + 1) is", "G_m, or the Borel group"),
        ("-2/(9*x^2) + b/(x-1)^2 - 2/(9*x*(x-1))", "sqrt(36*b - 7)/3, sqrt(4*b + 1) are", "G_m, or the Borel group"),
        (KIMURA, "a, b, c are", "G_m, or the Borel group"),
        ("(a*x+1)/(x^3-2)^2", "the exponent differences are", "G_m, or the Borel group"),
    ],
)
def test_groups_of_reducible_equations(S: str, where: str, otherwise: str) -> None:
    verdict = verdict_by_exponents(analyse(read_input(S, var="x").S, Budget()), Structure.REDUCIBLE)
    cyclic = "finite cyclic, or G_a extended by a finite cyclic group"
    assert verdict.group == f"{cyclic}, where {where} rational; else {otherwise}"
    if "Borel" in otherwise:
        assert str(verdict.abelian).endswith(" rational; elsewhere exactly where the group is `G_m`")
    else:
        assert verdict.abelian == "abelian"


@pytest.mark.parametrize(
    ("S", "group"),
    [
        ("a/(x^3-b*x-1)", "finite cyclic, or G_a extended by a finite cyclic group"),
        ("a*b^2 - a", "G_m, or trivial where b = 1 or b = -1 or a = 0"),
        ("x^4 + a*x", "the Borel group"),
        ("1/x^2 + a/x", "the Borel group, or G_m where two solutions have rational logarithmic derivatives"),
    ],
)
def test_other_groups_of_reducible_equations(S: str, group: str) -> None:
    assert verdict_by_exponents(analyse(read_input(S, var="x").S, Budget()), Structure.REDUCIBLE).group == group


@pytest.mark.parametrize(
    ("first", "second", "rest", "group"),
    [
        ("3/16", "3/16", "b", "dicyclic where sqrt(8*b - 1)/sqrt(2) is rational, else the infinite dihedral group"),
        ("3/16", "3/16", "3/16", "dicyclic"),  # the third difference is 1/2
        ("3/16", "3/16", "-7/72", "the infinite dihedral group"),  # its square is -8/9
        (
            "-a",
            "3/16",
            "b",
            "dicyclic where the third exponent difference is rational, else the infinite dihedral group",
        ),
        ("5/36", "3/16", "b", "dicyclic"),
        ("1/16", "3/16", "b", "the infinite dihedral group"),  # beside sqrt(3)/2
    ],
)
def test_groups_of_imprimitive_equations(first: str, second: str, rest: str, group: str) -> None:
    S = f"0*a - ({first})/x^2 - ({second})/(x-1)^2 + ({rest})/(x*(x-1))"
    assert verdict_by_exponents(analyse(read_input(S, var="x").S, Budget()), Structure.IMPRIMITIVE).group == group


@pytest.mark.parametrize(
    ("S", "region", "group"),
    [
        ("x^2 + 1/x^2 + a", "a +- sqrt(5) is an integer = 2 mod 4", "the Borel group"),  # sqrt(5)/2 is no integer
        ("x^2 - 1/(4*x^2) + a", "a = 2 mod 4", "the Borel group"),
        ("x^2 + 3/(4*x^2) + a", "a = 0 mod 4", "the Borel group, or G_m where a^2 < 4"),
        ("x^2 + a/x^2", "a = (n^2 - 1)/4 for an integer n = 2 mod 4", "G_m"),
        ("x + a/x^2", "a = (n^2 - 4)/16 for an integer n = 3 mod 6", "the infinite dihedral group"),
    ],
)
def test_groups_with_an_irregular_point(S: str, region: str, group: str) -> None:
    (found,) = kovacic.conditions(S, var="x").regions
    assert str(found).startswith(region + ": case")
    assert found.group == group


def test_two_constant_differences_may_fill_a_row() -> None:
    """1/3, 2/3 and 1/3 are in a row of the tetrahedral group; beside 1/3 and 2/3 no third one makes it octahedral."""
    S = read_input("-2/(9*x^2) - 5/(36*(x-1)^2) + b/(x*(x-1))", var="x").S
    found = [structure for structure, _ in kimura_statements(analyse(S, Budget()))]
    assert found == [Structure.REDUCIBLE, Structure.IMPRIMITIVE, Structure.TETRAHEDRAL, Structure.ICOSAHEDRAL]
    assert kimura_structure((F(1, 3), F(2, 3), F(1, 3))) is Structure.TETRAHEDRAL


@pytest.mark.parametrize(
    ("S", "condition"),
    [
        # x^2 S = 3/4 + a t + s t^2 + ... with t = x - 2; the difference is 2, and a^2 = s.
        ("3/(4*(x-2)^2) + a/(x-2) - 3/(16*(x-3)^2) + b/(x-3)", "16*a**2 + 16*b + 3"),
        # 2 + a t + s t^2 + r t^3 + ...: the difference is 3, and a^3/4 - a s + r = 0 with s = -3/16 - b, r = -3/8 - b.
        ("2/(x-2)^2 + a/(x-2) - 3/(16*(x-3)^2) + b/(x-3)", "4*a**3 + 16*a*b + 3*a - 16*b - 6"),
    ],
)
def test_where_there_is_no_logarithm(S: str, condition: str) -> None:
    findings = search_special_values(analyse(read_input(S, var="x").S, Budget()))
    assert (*map(str, findings.candidates),) == (condition,)
    assert not findings.conditions


def test_integers_at_which_a_fraction_has_a_small_denominator() -> None:
    field = FunctionField(("t",))
    t = field.generator("t")
    found = at_integers((5 * t + 2) / (3 * t - 4), 2, read_assumptions({"t": "integer"}, t, ("t",)))
    values = {n: F(5 * n + 2, 3 * n - 4) for n in range(-200, 200)}
    assert found == [(Vanishes(t - n), value) for n, value in values.items() if value.denominator <= 2]
    assert (values[-16], values[10]) == (F(3, 2), 2)


def test_classes_of_a_symmetric_equation_are_symmetric() -> None:
    """N -> -1 - N maps the integers 2 mod 3 to those 0 mod 3."""
    field = FunctionField(("t",))
    t, N = field.generator("t"), field.poly([F(-1, 2), 1])
    for k in (2, 3, 4):
        made = Congruence.make(over_parameters(N**k - t * N ** (k - 2)), Classes.of([0], 3))
        assert isinstance(made, Congruence)
        assert made.numbers == Classes.of([0, 2], 3), k
    made = Congruence.make(over_parameters(N**3 - t), Classes.of([0], 3))
    assert isinstance(made, Congruence)
    assert made.numbers == Classes.of([2], 3)


def test_powers_are_gathered() -> None:
    """(x - i)^e (x + i)^f takes up powers of x^2 + 1; other factors with roots stay apart."""
    x, a, b = sympy.symbols("x a b")
    i = sympy.I
    for factors, gathered in (
        ([(x - i) ** a, (x + i) ** a, (x**2 + 1) ** 2], (x**2 + 1) ** (a + 2)),
        ([(x - i) ** a, (x + i) ** b, (x**2 + 1) ** 2], (x - i) ** (a + 2) * (x + i) ** (b + 2)),
        ([(x - i) ** a, (x - 2 * i) ** a, x**b], (x - i) ** a * (x - 2 * i) ** a * x**b),
        ([(x**2 + 3) ** a, x**2 + 3, sympy.exp(a * x), sympy.exp(x)], (x**2 + 3) ** (a + 1) * sympy.exp(a * x + x)),
        ([(x**2 + 3) ** a, x**2 + 5, b + 2], (x**2 + 3) ** a * (x**2 + 5)),
    ):
        assert with_gathered_powers(sympy.Mul(*factors), x) == gathered


def test_one_formula_for_all_signs() -> None:
    """Bessel's equation: exp(+-i x) and x^(1/2 +- n), the signs in one formula."""
    theorem = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1", var="x").theorem()
    assert "y = x^(n*zeta + 1/2)*exp(I*epsilon*x)*assoc_laguerre(N, 2*n*zeta, -2*I*epsilon*x)" in theorem
    assert "where N = -(2*n*zeta + 1)/2 is a natural number, with a choice of epsilon and zeta from +-1." in theorem


def test_powers_of_square_roots_among_parameters() -> None:
    field = FunctionField(("b", "sqrt(a)"))
    root, b = field.generator("sqrt(a)"), field.generator("b")
    texts = [shortest_form(b * root**k) for k in (1, 2, 3, 4, 6, 8)]
    assert texts == ["b*sqrt(a)", "b*a", "b*a*sqrt(a)", "b*a^2", "b*a^3", "b*a^4"]


def test_derivatives_of_orthogonal_polynomials() -> None:
    """For a letter in place of the degree as for each degree, 0 among them."""
    x, n, a = sympy.symbols("x n a")
    for y in (sympy.hermite(n, 3 * x), sympy.assoc_laguerre(n, a, 2 * x) * x):
        found = derivative(y, x)
        for k in (0, 1, 3):
            given, expected = (f.subs(n, k).subs({x: F(2, 7), a: F(1, 3)}) for f in (found, y.subs(n, k).diff(x)))
            assert given == expected


def test_rows_become_primitive() -> None:
    field = FunctionField(("a", "b"))
    a, b = (field.generator(name).num for name in "ab")
    assert _primitive({1: 6 - 4 * a, 3: 10 * b}) == {1: 2 * a - 3, 3: -5 * b}
    assert _primitive({1: 6 * a - 9, 3: -15 * b}) == {1: 2 * a - 3, 3: -5 * b}


def test_jacobi_polynomials_that_vanish() -> None:
    """P_d^(a, b) with negative integers a, b vanishes for d from max(-a, -b) to -a - b - 1."""
    n, b, z = sympy.symbols("n b z")

    def excluded(*parameters: Any) -> str:
        found = PolynomialSolution(jacobi(n, *parameters, z), n, jacobi=tuple(map(sympy.sympify, parameters)))
        return text_of_words(found.exclusion("d"))

    assert excluded(-1, -1) == ", unless n = 1"
    assert excluded(-2, -3) == ", unless 3 <= n <= 4"
    assert [d for d in range(2, 6) if jacobi(sympy.Integer(d), -2, -3, z).expand() == 0] == [3, 4]
    assert excluded(-2, 3) == ""
    assert excluded(b, b) == ", unless b is an integer with -n <= b < -n/2"
    assert excluded(b, 2 * b) == ", unless b and 2*b are integers from -n to -1 with a sum below -n"
    assert jacobi(n, 2, b, z).diff(z) == (n + b + 3) / 2 * jacobi(n - 1, 3, b + 1, z)
    assert jacobi(n, 2, b, z).diff(b) == sympy.Derivative(jacobi(n, 2, b, z), b)
    assert (jacobi(3, 2, b, z).diff(z) - (b + 6) / 2 * jacobi(2, 3, b + 1, z)).expand() == 0


def test_partial_fractions_without_zero_digits() -> None:
    x = RatFunc(FunctionField(("a",)).poly([0, 1]))
    assert in_partial_fractions(1 / x**2 + x, "x") == "x + 1/x^2"


def test_a_false_group_is_contradicted() -> None:
    """Bessel's equation with n = 1/2 has the solutions exp(ix) and exp(-ix), and the group G_m."""
    answer = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1", var="x")
    point = answer.point({"n": "1/2"})
    assert not [*contradictions(answer, point)]
    (region,) = answer.regions
    false = replace(region, verdict=replace(region.verdict, abelian=NOT_ABELIAN))
    (sentence,) = contradictions(replace(answer, regions=(false,)), point)
    assert sentence.startswith("the identity component is printed as not abelian, and the group is G_m")


def test_degrees_on_a_curve_are_given_by_their_equation() -> None:
    """With free parameters S has other exponents than on the curve: no sum of roots is the degree."""
    field = FunctionField(("a",))
    a, d = field.generator("a"), field.poly([0, 1])
    natural = Natural(RatFunc(d), 4, (over_parameters(d**2 - a**3 - a**2),))
    assert natural.text() == "d^2 - a^3 - a^2 = 0, d in N, and Delta_d = 0 for an invariant of degree 4"


def test_what_claims_say() -> None:
    """Every kind of claim and of their combinations, with different numbers in each role."""
    field = FunctionField(("a", "b"))
    a, b = map(field.generator, field.names)
    n = field.poly([0, 1])
    d = RatFunc(n)
    third, four = Classes.of([1, 2], 3), Classes.of([1, 3, 4], 5)

    def f(value: Any, numbers: Classes = INTEGERS, poles: tuple[Free, ...] = (), name: str = "a") -> IntegerFamily:
        return IntegerFamily("n", name, value, numbers, poles)

    def e(equation: Any, numbers: Classes = ODD) -> EquationFor:
        return EquationFor("n", over_parameters(equation), numbers)

    def g(value: Any, name: str = "a", poles: tuple[Free, ...] = ()) -> IntegerFamily:
        return IntegerFamily("d", name, value, INTEGERS, poles)

    def deg(*parts: Claim, m: int = 1) -> DegreeExists:
        return DegreeExists("d", AnyOf(parts) if len(parts) > 1 else parts[0], m, lambda *_: True)

    def N(constant: str, *roots: ExponentRoot) -> Numbers:
        return Numbers(F(constant), roots, field, field)

    said = [
        (InClasses(a + b + F(1, 2), INTEGERS), "a + b - 1/2 in Z"),
        (InClasses(a - b - F(1, 3), INTEGERS), "a - b - 1/3 in Z"),
        (InClasses(a + 2 * b + F(7, 2), ODD), "(4*b + 7)/2 + a is an odd integer"),
        (InClasses(2 * a + b, Classes.of([F(1, 6), F(5, 6), F(1, 2)], 1)), "2*a + b = 1/6 mod 1/3"),
        (InClasses(2 * a + b, Classes.of([F(1, 5), F(2, 5)], 1)), "2*a + b = 1/5, 2/5 mod 1"),
        (InClasses(2 * a + b, Classes.of([0, F(1, 2)], F(3))), "2*a + b = 0, 1/2 mod 3"),
        (AnyOf((InClasses(a + b, ODD), InClasses(a - b, ODD))), "a + b or a - b is an odd integer"),
        (
            AnyOf((InClasses(a + b, ODD), InClasses(a - b, ODD), InClasses(a, ODD))),
            "one of a + b, a - b or a is an odd integer",
        ),
        (AnyOf((InClasses(a + b, INTEGERS), InClasses(a - b, INTEGERS))), "a + b in Z or a - b in Z"),
        (
            AnyOf((InClasses(a + b, INTEGERS), InClasses(a - b + F(1, 2), INTEGERS), InClasses(a, INTEGERS))),
            "one of a + b, a - b - 1/2 or a is an integer",
        ),
        (AnyOf((InClasses(a + b, ODD), InClasses(a - b, EVEN))), "a + b is an odd integer or a - b is an even integer"),
        (
            AnyOf((InClasses(a + b, Classes.of([1], 3)), InClasses(a - b, EVEN))),
            "a + b = 1 mod 3 or a - b is an even integer",
        ),
        (AnyOf((InClasses(a + b, third), InClasses(a - b, EVEN))), "a + b = +-1 mod 3, or a - b is an even integer"),
        (AnyOf((InClasses(a + b, third), InClasses(a - b, third))), "a + b = +-1 mod 3, or a - b = +-1 mod 3"),
        (AnyOf((IsZero(a - 3), IsZero(a + b))), "a = 3 or -b"),
        (AnyOf((IsZero(a - 3), IsZero(a - 5), IsZero(a + 7))), "a = 3, 5 or -7"),
        (AnyOf((IsZero(a - 3), IsNonzero(a - 5))), "a = 3, or a != 5"),
        (AnyOf((IsZero(a - 3), IsZero(b - 5))), "a = 3 or b = 5"),
        (AllOf((AnyOf((IsZero(a - 3), IsZero(a - 5))), IsNonzero(b))), "a = 3 or 5, and b != 0"),
        (AllOf((AnyOf((IsZero(a - 3), IsZero(b - 5))), InClasses(a, INTEGERS))), "(a = 3 or b = 5), and a in Z"),
        (InClasses(2 * a + b, Classes.of([0, F(1, 6), F(5, 6), F(1, 2)], 1)), "2*a + b = 0, +-1/6, 1/2 mod 1"),
        (InClasses(a - b, INTEGERS), "a - b in Z"),
        (InClasses(a * 0 + 3 * b - F(7, 3), INTEGERS), "3*b - 1/3 in Z"),
        (f(2 * d + b), "a = 2*n + b for an integer n"),
        (f(2 * d + b, ODD), "a = 2*n + b for an odd integer n"),
        (f(3 * d - b / 2, third), "a = 3*n - b/2 for an integer n not divisible by 3"),
        (f(3 * d - b / 2, four), "a = 3*n - b/2 for an integer n = 1, 3, 4 mod 5"),
        (f(d * d / b, EVEN), "a = n^2/b for an even integer n"),
        (f(1 / (d - b), ODD, (Free(b, b - 2),)), "a = 1/(n - b) (b - 2 = 0 where n = b) for an odd integer n"),
        (
            f(1 / (d - b), ODD, (Free(b, (b - 2) * (b + 3) * (b + 5)), Free(b + 1, b - 7))),
            "a = 1/(n - b) ((b - 2)*(b + 3)*(b + 5) = 0 where n = b, b - 7 = 0 where n = b + 1) for an odd integer n",
        ),
        (AnyOf((f(2 * d + b), f(3 * d))), "a = 2*n + b or a = 3*n for an integer n"),
        (AnyOf((f(2 * d + b), f(3 * d, name="b"))), "a = 2*n + b or b = 3*n for an integer n"),
        (AnyOf((f(2 * d + b), f(3 * d, ODD))), "a = 2*n + b for an integer n, or a = 3*n for an odd integer n"),
        (
            AnyOf((f(2 * d + b, ODD, (Free(b, b - 2),)), e(n * n - 3))),
            "a = 2*n + b (b - 2 = 0 where n = b) or n^2 - 3 = 0 for an odd integer n",
        ),
        (e(2 * n - 5), "n = 5/2 for an odd integer n"),
        (e(n - b), "n - b = 0 for an odd integer n"),
        (e(n * n - 5), "n^2 - 5 = 0 for an odd integer n"),
        (e(n * n * b - a + F(3, 2), EVEN), "2*b*n^2 - 2*a + 3 = 0 for an even integer n"),
        (AnyOf((e(n * n - 5), InClasses(a, INTEGERS))), "n^2 - 5 = 0 for an odd integer n, or a in Z"),
        (
            SumOfRoots(over_parameters(a + 1), (over_parameters(a), over_parameters(b + 2)), ODD),
            "a + 1 +- sqrt(a) +- sqrt(b + 2) is an odd integer",
        ),
        (
            SumOfRoots(over_parameters(a * 0), (over_parameters(4 * a), over_parameters(b + 2)), INTEGERS),
            "2*sqrt(a) +- sqrt(b + 2) is an integer",
        ),
        (
            AnyOf((SumOfRoots(over_parameters(a + 1), (over_parameters(a),), ODD), InClasses(b, ODD))),
            "a + 1 +- sqrt(a) or b is an odd integer",
        ),
        (
            AnyOf((SumOfRoots(over_parameters(a + 1), (over_parameters(a),), third), InClasses(b, ODD))),
            "a + 1 +- sqrt(a) is an integer not divisible by 3 or b is an odd integer",
        ),
        (
            AnyOf((SumOfRoots(over_parameters(a + 1), (over_parameters(a),), third), IsZero(b - 3))),
            "a + 1 +- sqrt(a) is an integer not divisible by 3 or b = 3",
        ),
        (deg(g(2 * d + b), m=4), "a = 2*d + b for an integer d, d in N, and Delta_d = 0 for an invariant of degree 4"),
        (deg(g(b + d), g(b - d)), "a = b +- d, d in N, and Delta_d = 0"),
        (
            deg(g(2 * d), g(3 - d), g(3 * d * d), m=6),
            "a = 2*d, -d + 3 or 3*d^2, d in N, and Delta_d = 0 for an invariant of degree 6",
        ),
        (
            deg(g(2 * d, "b"), g(3 - d, "a"), EquationFor("d", over_parameters(n * n - b), INTEGERS)),
            "d^2 - b = 0 or b = 2*d or a = -d + 3, d in N, and Delta_d = 0",
        ),
        (
            deg(EquationFor("d", over_parameters(2 * n - 7), INTEGERS), g(d * a, "b")),
            "d = 7/2 or b = a*d, d in N, and Delta_d = 0",
        ),
        (
            deg(g(2 * d), g(5 - 2 * d), g(3 * d + 1), g(4 - 3 * d)),
            "a or 5 - a = 2*d or 3*d + 1, d in N, and Delta_d = 0",
        ),
        (deg(g(2 * d), g(5 - 2 * d)), "a = 2*d or -2*d + 5, d in N, and Delta_d = 0"),
        (
            deg(g(2 * d), g(5 - 2 * d), g(3 * d + 1), g(7 - 3 * d)),
            "a = 2*d, -2*d + 5, 3*d + 1 or -3*d + 7, d in N, and Delta_d = 0",
        ),
        (deg(g(d), g(-d), g(2 * d + 1), g(-2 * d - 1)), "a = +-d or +-(2*d + 1), d in N, and Delta_d = 0"),
        (deg(g(d + b), g(1 - d - b), g(d - b), g(1 - d + b)), "a or 1 - a = d + b or d - b, d in N, and Delta_d = 0"),
        (
            deg(g(2 * d), AllOf((g(3 * d + b, "a"), IsZero(b - 7)))),
            "a = 2*d, or a = 3*d + b for an integer d where b = 7, d in N, and Delta_d = 0",
        ),
        (
            deg(g(1 / (d - b), "a", (Free(b, b - 2),)), g(3 * d)),
            "a = 1/(d - b) or 3*d (b - 2 = 0 where d = b), d in N, and Delta_d = 0",
        ),
        (deg(g((b - 3 * d) / 2), g((b + 3 * d) / 2)), "a = b/2 +- 3*d/2, d in N, and Delta_d = 0"),
        (deg(g(2 * b + d), g(2 * b - d), g(d * b)), "a = 2*b +- d or b*d, d in N, and Delta_d = 0"),
        (
            DegreeBySum("d", N("3/2", ExponentRoot(a, 2), ExponentRoot(b + 1, 3)), ("k", "l"), True),
            "d = 3/2 + k*sqrt(a) + l*sqrt(b + 1) for integers k from -2 to 2, l from -3 to 3",
        ),
        (
            DegreeBySum("d", N("3/2", ExponentRoot(a, 2), ExponentRoot(b + 1, 3)), ("k", "l")),
            "d = 3/2 + k*sqrt(a) + l*sqrt(b + 1) for integers k from -2 to 2, l from -3 to 3, not all 0",
        ),
        (
            DegreeBySum("d", N("-5", ExponentRoot(a / 4, 2)), ("k",)),
            "d = -5 + k*sqrt(a)/2 for integers k from -2 to 2, not 0",
        ),
        (DegreeBySum("d", N("3/2", ExponentRoot(a, 1), ExponentRoot(b + 1, 1))), "d - 3/2 = +-sqrt(a) +- sqrt(b + 1)"),
        (DegreeBySum("d", N("-3", ExponentRoot(a, 1))), "d + 3 = +-sqrt(a)"),
        (
            deg(g(2 * d), g(5 - 2 * d), g(d * 0 + F(5, 2)), g(3 * d), g(5 - 3 * d)),
            "a = 2*d, -2*d + 5, 5/2, 3*d or -3*d + 5, d in N, and Delta_d = 0",
        ),
        (
            deg(g(d), g(1 / d - d), g(2 * d), g(1 / d - 2 * d)),
            "a = d, -d + 1/d, 2*d or -2*d + 1/d, d in N, and Delta_d = 0",
        ),
    ]
    assert [text_of_words(prose.sentence(claim)) for claim, _ in said] == [text for _, text in said]
    claim = AnyOf((InClasses(a, third), IsNonzero(b - 5)))
    assert prose.latex_of_claim(claim) == r"a \equiv \pm 1 \pmod{3}\text{, or } b \ne 5"
