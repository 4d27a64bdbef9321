"""Every public call keeps its limits; those of the numerical calls are in `test_enclosure_limits.py`, with their reasons."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import prod

import pytest
import sympy
import transform
from build import (
    QQ,
    Atoms,
    Budget,
    Conditions,
    ExactPoint,
    FunctionField,
    RatFunc,
    System,
    analyse,
    parametrize,
    read_expression,
    run,
)
from clocks import controlled, stretches
from flint import acb_poly
from sympy.abc import n, x

import kovacic
from kovacic import InputError, LimitExceeded, Limits, Solution
from kovacic.algebra.embedding import complex_zeros
from kovacic.batch.records import Item, Job
from kovacic.batch.worker import solve_item
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.log_derivative import _principal_part
from kovacic.general_solution.integrands import prepared_integrand
from kovacic.general_solution.substitution import finite_value, slope
from kovacic.limits import check_time, limited, may_be_late, watched_seconds
from kovacic.verify.local import points
from kovacic.writing.document import FORMATS, Formula, say
from kovacic.writing.formula import Formulas

X = RatFunc(QQ.poly([0, 1]))
POLES = "+".join(f"1/(x-{i})^4" for i in range(1, 501))
HERMITE = "y'' - 2*x*y' + 2400*y = 0"
LONG_HERMITE = "y'' - 2*x*y' + 12000*y = 0"


def over_parameters() -> sympy.Expr:
    """Schwarz's icosahedral equation, pulled back by x -> (n x^3 + 1)/(x - n)."""
    f = (n * x**3 + 1) / (x - n)
    first, a, b, c = f.diff(x), *(1 - Fraction(1, k * k) for k in (2, 3, 5))
    S = (
        -sympy.Rational(a) / (4 * f**2)
        - sympy.Rational(b) / (4 * (f - 1) ** 2)
        + sympy.Rational(a + b - c) / (4 * f * (f - 1))
    )
    ratio = first.diff(x) / first
    return sympy.together(S * first**2 - ratio.diff(x) / 2 + ratio**2 / 4)


@cache
def solved(text: str) -> Solution:
    """The answer without the views that were computed before."""
    return kovacic.solve(text, var="x")


def answer(text: str, limits: Limits) -> Solution:
    return replace(solved(text), limits=limits)


def dicyclic() -> RatFunc:
    """An order of 4 * 299 on a curve of genus 1: invariants of degree 598 decide it."""
    return transform.from_squared_product(((X**3 + X + 1) ** 2 - 3) / (3 * X**2 + 1) ** 2, Fraction(4, 299**2))


def regions(limits: Limits) -> Conditions:
    """For which a, b, c is y'' = (x^4 + a x^2 + b x + c) y solvable?"""
    return replace(quartic(), limits=limits)


@cache
def quartic() -> Conditions:
    return kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x", max_degree=0)


CALLS: dict[str, Callable[[Limits], object]] = {
    "solve: a high power": lambda limits: kovacic.solve("x^20000 + x", limits=limits),
    "solve: many poles": lambda limits: kovacic.solve(POLES, limits=limits),
    "solve: factors of a denominator": lambda limits: kovacic.solve("1/(x^2520 - 1)", limits=limits),
    "solve: parameters": lambda limits: kovacic.solve(over_parameters(), var="x", limits=limits),
    "solve: text": lambda limits: kovacic.solve("(x+1)^9000/(x-2)^8000 + x", limits=limits),
    "solve: a power and more": lambda limits: kovacic.solve("(x^2 + 3*x + 7)^700 + x", limits=limits),
    "decide": lambda limits: kovacic.decide("x^4 + 40002*x + 1", limits=limits),
    "verify": lambda limits: answer("x^4 + 10002*x + 1", limits).verify(),
    "group": lambda limits: answer(dicyclic().to_str("x"), limits).group,
    "equation_group": lambda limits: answer(dicyclic().to_str("x"), limits).equation_group,
    "is_algebraic": lambda limits: answer(dicyclic().to_str("x"), limits).is_algebraic,
    "closed_form": lambda limits: answer(HERMITE, limits).closed_form,
    "closed_form: one long power": lambda limits: answer(LONG_HERMITE, limits).closed_form,
    "solutions": lambda limits: answer("x^2 - 1601", limits).solutions,
    "to_json": lambda limits: answer(HERMITE, limits).to_json(full=True),
    "from_json": lambda limits: Solution.from_json(solved("x^4 + 10002*x + 1").to_json(), limits=limits),
    "generic_conditions": lambda limits: answer("(n^2*x^4 + 1)/(x^3 + n*x + 1)^2", limits).generic_conditions,
    "special": lambda limits: answer("x^4 + 10002*x + 1", limits).special,
    "solve_riccati": lambda limits: kovacic.solve_riccati("x^4 + 10002*x + 1", 0, -1, limits=limits),
    "conditions": lambda limits: kovacic.conditions("(x+a)^2 + b/(x-c)^2 + 1", var="x", limits=limits),
    "check": lambda limits: regions(limits).check(10**6),
    "case_at": lambda limits: regions(limits).case_at({"a": 10**4, "b": 12345, "c": 10**9 + 7}),
    "solve_at": lambda limits: regions(limits).solve_at({"a": 0, "b": 10002, "c": 1}),
    "spectrum": lambda limits: kovacic.spectrum("x^2 + 1/(x^60 - 1)", limits=limits),
    "dsolve": lambda limits: kovacic.dsolve(HERMITE, limits=limits),
    "dsolve: integrals": lambda limits: kovacic.dsolve("y'' + 2*y' + 5*y = sin(x)/(x^2 + 1)", limits=limits),
}  # fmt: skip


PREPARED = (
    "x^4 + 10002*x + 1",
    HERMITE,
    LONG_HERMITE,
    "x^2 - 1601",
    "(n^2*x^4 + 1)/(x^3 + n*x + 1)^2",
    dicyclic().to_str("x"),
)


#: Calls that are nothing without their time; what the others give then has a status or a place for what is missing.
WHOLE = ("verify", "closed_form", "solutions", "from_json")


@pytest.mark.parametrize("looks", [3, 60])
@parametrize("name", CALLS, ordinary=1, long=24)
def test_every_call_ends_once_its_time_is_over(name: str, looks: int) -> None:
    """What comes then is a value, `LimitExceeded`, or dsolve's NotImplementedError with the reason."""
    if not name.startswith(("solve", "dsolve", "decide")):
        for text in PREPARED:
            solved(text)
        quartic()
    limit = "none" if name in WHOLE else "seconds"
    with controlled(looks_in_time=looks) as clock:
        try:
            CALLS[name](Limits(seconds=0.25))
        except LimitExceeded as error:
            limit = error.limit
        except NotImplementedError as error:
            limit = str(error)
    assert clock.late_looks <= 20
    assert limit == "seconds" or (name.startswith("dsolve") and "time limit" in limit)


@parametrize("format", ["text", "markdown", "latex", "html"], ordinary=1)
def test_an_explanation_says_what_it_leaves_out(format: str) -> None:
    """Formulas of degree 2000 aren't printed; what takes longer than the limits allow is left out, and the rest is there."""
    with controlled():
        explained = answer("x^2 - 4001", Limits(seconds=1)).explain(format=format)
    assert len(explained) < 200_000  # the picture and the font included; the formulas have millions
    explained = explained.replace("&#x000A0;", " ").replace("&#x27;", "'")
    assert "too long to print: degree 2000)" in explained
    assert "too long to print: degree 2001 over degree 2000)" in explained
    assert "Solutions" in explained
    assert "2000" in str(solved("x^2 - 4001"))


def test_an_explanation_without_time_has_the_rest() -> None:
    with controlled(step=1):
        timeless = answer("x^2 - 1", Limits(seconds=0)).explain(solutions=False)
    assert "isn't written out: the time limit of 0 s is exceeded" in timeless
    assert "References" in timeless


def test_what_is_long_is_said_instead_of_printed() -> None:
    """Many terms, or long coefficients; a sparse polynomial of high degree is printed."""
    formulas = Formulas("x", QQ)
    assert formulas.math(X**20000 + 1).latex == "x^{20000} + 1"
    assert formulas.math((X + 1) ** 301).latex == r"\text{(too long to print: degree 301)}"
    assert formulas.math(QQ.poly([1, 10**40_000])).text == "(too long to print: degree 1)"
    assert formulas.math(1 / (X + 1) ** 400).text == "(too long to print: degree 0 over degree 400)"
    assert formulas.math((X + 1) ** 3).text == "x^3 + 3*x^2 + 3*x + 1"


def test_a_long_gcd_is_foreseen_only_where_there_is_one() -> None:
    """Coprime polynomials of any size are told apart by one prime; a common factor of degree 2000 takes seconds."""
    f = QQ.poly([3 ** (k % 97 + 40) for k in range(1001)])
    g = QQ.poly([5 ** (k % 89 + 30) for k in range(1002)])
    with controlled(), Budget(Limits(seconds=0.05)).watched():
        assert f.gcd(g).degree == 0
        with pytest.raises(LimitExceeded, match="the gcd of polynomials of degree"):
            (f**6).gcd(f**5 * g)
        with pytest.raises(LimitExceeded, match="a power of degree"):
            f**300
        assert (f * g).exact_quotient(f) == g
        power = f**4
        assert (power * f).exact_quotient(power + 1) is None
        with pytest.raises(LimitExceeded, match="a division by a polynomial of degree 4000"):
            (power * f).exact_quotient(power)


@pytest.mark.parametrize("leading", [1, 3])
@pytest.mark.parametrize("degree", [1, 63, 129, 240, 241])
def test_a_long_division_in_pieces_gives_quotient_and_remainder(degree: int, leading: int) -> None:
    """q g + r built from q and r, with denominators; and by a power of x, which is a cut."""
    g = QQ.poly([*(Fraction(3 * k % 7 - 3, 5 if leading == 1 else 1) for k in range(degree)), Fraction(leading)])
    r = QQ.poly([Fraction(k % 5 - 2, 3) for k in range(degree)])
    for divisor in (g * 5, QQ.poly([0, 1]) ** degree * leading):
        q = QQ.poly([Fraction(k % 11 - 5, 2) for k in range(242 - degree)] + [1])
        assert divmod(q * divisor + r, divisor) == (q, r)
        assert (q * divisor + r) // divisor == q
        assert (q * divisor + r) % divisor == r
        assert (q * divisor).exact_quotient(divisor) == q
        assert (q * divisor + r).exact_quotient(divisor) is None
        assert (q * divisor * 7).exact_quotient(divisor + 1) is None


def test_long_products_and_divisions_look_at_the_clock() -> None:
    """The remainder of a power takes minutes by some divisors, and is a cut by a power of x."""
    X = QQ.poly([0, 1])
    f = (X * X + 3 * X + 7) ** 300 + X
    with controlled(looks_in_time=3) as clock, Budget(Limits(seconds=1)).watched():
        assert (f % X**300).degree == 299
        with pytest.raises(LimitExceeded, match="time limit"):
            f % (X * X + X + 1) ** 30
        assert clock.late_looks <= 1
        with pytest.raises(LimitExceeded, match="time limit"):
            f * f


def test_every_place_looks_at_the_clock() -> None:
    """A thousand poles of order 2 take some milliseconds each, in the engine and in the kernel: for their logarithms."""
    S = 2 / X**2 + 2 / (X - 1) ** 2
    with controlled() as clock:
        budget = Budget(Limits(seconds=1))
        engine = [place for place in analyse(S, budget).places if place.delta == 3]
        assert len(engine) == 2
        clock.move(2)
        for place in (*engine, *points(S, budget)[:2]):
            with pytest.raises(LimitExceeded, match="the time limit of 1 s is exceeded"):
                _ = place.logarithm


LONG = QQ.poly([Fraction(k % 7 - 3, k % 3 + 1) for k in range(200)] + [1])
LONG_FRACTION = RatFunc(QQ.poly([1, 2]), LONG)
ZEROS = complex_zeros(LONG.rep.numer())
OVER_A = FunctionField(("a",))
STEPS: dict[str, Callable[[], object]] = {
    "a polynomial as an expression": lambda: Atoms(x).poly(LONG),
    "a rational function as an expression": lambda: Atoms(x).ratio(RatFunc(LONG, LONG + 1)),
    "a derivative": lambda: slope(x**2 * sympy.exp(x) + (x + 1) ** -3, x),
    "a value of an expression": lambda: finite_value(sympy.exp(x) / x, x, sympy.Integer(2)),
    "a bound for the growth": lambda: foreseen_growth(frequency(System.of(X**20 + 3)), ExactPoint(2), ExactPoint(3)),
    "an exact quotient": lambda: LONG.exact_quotient(LONG),
    "a division over Q(a)": lambda: divmod(OVER_A.poly([1, 0, 1]), OVER_A.poly([OVER_A.generator("a"), 1])),
    "factors over Q": lambda: QQ.factor(LONG),
    "factors over Q(a)": lambda: OVER_A.factor(OVER_A.poly([OVER_A.generator("a"), 1])),
    "factors without a over Q(a)": lambda: OVER_A.factor(OVER_A.poly([1, 0, 1])),
    "zeros": lambda: complex_zeros(LONG.rep.numer()),
    "partial fractions in balls": lambda: _principal_part(
        acb_poly(LONG_FRACTION.num.rep), acb_poly(LONG.rep), ZEROS[0][0], 1
    ),
}


@pytest.mark.parametrize("name", STEPS)
def test_every_step_that_may_be_long_looks_at_the_clock(name: str) -> None:
    with controlled() as clock, Budget(Limits(seconds=1)).watched():
        clock.move(2)
        with pytest.raises(LimitExceeded, match="time limit"):
            STEPS[name]()


def test_a_step_may_be_a_little_late() -> None:
    """By a tenth of the limit and a twentieth of a second, and as long as it likes where nobody waits."""
    assert not may_be_late(1e9)
    with controlled() as clock, Budget(Limits(seconds=10)).watched():
        clock.move(8)
        assert not may_be_late(3.04)
        assert may_be_late(3.06)


@pytest.mark.long
@pytest.mark.parametrize("spacing", [1, Fraction(1, 3)])
def test_zeros_in_clusters_are_isolated_where_it_can_be_stopped(spacing: Fraction) -> None:
    """The polynomial with the zeros 1, ..., 160 takes ten seconds, x^160 + x + 1 a fraction of one."""
    product = QQ.poly([1])
    for k in range(1, 161):
        product = product * QQ.poly([-k * spacing, 1])
    with controlled(), Budget(Limits(seconds=0.3)).watched():
        with pytest.raises(LimitExceeded, match="zeros of a polynomial of degree 160"):
            complex_zeros(product.rep.numer())
        assert len(complex_zeros(QQ.poly([1, 1, *[0] * 78, 1]).rep.numer())) == 80


def test_factors_over_parameters_are_those_over_q_where_there_are_none() -> None:
    """In the order in which they were always found."""
    f = QQ.poly([-1, *[0] * 11, 1]) * QQ.poly([2, 0, 3]) ** 2
    found = OVER_A.factor(OVER_A.embed(f))
    assert {(str(p), k) for p, k in found} == {(str(p), k) for p, k in QQ.factor(f)}
    a = OVER_A.generator("a")
    with_a = OVER_A.factor(OVER_A.embed(f) * OVER_A.poly([a, 1]))
    assert [pair for pair in with_a if pair[0] != OVER_A.poly([a, 1])] == found


@pytest.mark.long
def test_long_factors_over_parameters_are_found_apart_as_here() -> None:
    a = OVER_A.generator("a")
    f = OVER_A.poly([-1, *[0] * 503, 1]) * OVER_A.poly([a, 1, a]) ** 2
    found = OVER_A.factor(f)
    with Budget().watched():
        assert OVER_A.factor(f) == found
    assert len(found) == 25  # the divisors of 504, and one
    with (
        controlled(),
        Budget(Limits(seconds=0.3)).watched(),
        pytest.raises(LimitExceeded, match="no factors of a polynomial in the variable and the parameters"),
    ):
        OVER_A.factor(OVER_A.poly([-1, *[0] * 5039, 1]) * OVER_A.poly([a, 1]))


def test_a_page_without_time_has_its_formulas_as_text() -> None:
    """From the first look that is too late on; nothing of the page is lost."""
    formulas = [Formulas("x", QQ).math(f) for f in ((X + 1) / (X**2 + 3), X**150 + (X + 1) ** 40 / (X - 2), 1 / X)]
    blocks = [block for math in formulas for block in (Formula(math), say("so that ", math, " holds"))]
    written = []
    for looks in range(10):
        with controlled(looks_in_time=looks), Budget(Limits(seconds=1)).watched():
            page = FORMATS["html"].render(blocks)
        typeset = 6 - page.count("<code>")
        assert all(page.count(f"<code>{math.text}</code>") <= 2 for math in formulas)
        assert page.count("so that ") == page.count(" holds") == 3
        assert bool(typeset) == ("<math" in page)
        written.append(typeset)
    assert written == sorted(written)
    assert written[0] == 0
    assert len({*written}) > 2


def test_the_parts_of_a_call_share_its_clock() -> None:
    """A budget that is made within another one ends with it; one that ends before keeps its own time."""
    with controlled() as clock:
        outer = Budget(Limits(seconds=5))
        clock.move(1)
        with outer.watched():
            assert Budget().seconds_left == 4
            assert Budget(Limits(seconds=2)).seconds_left == 2
            assert watched_seconds(100) == 4
        assert Budget().seconds_left == 600
        assert watched_seconds(100) == 100


def test_a_limited_call_takes_its_limits_from_the_keyword_or_the_object() -> None:
    class Thing:
        limits = Limits(seconds=7)

        @limited
        def left(self, *, limits: Limits | None = None) -> float:
            return watched_seconds(1e9)

    @limited
    def alone(*, limits: Limits | None = None) -> float:
        return watched_seconds(1e9)

    with controlled() as clock:
        assert Thing().left() == 7
        assert Thing().left(limits=Limits(seconds=3)) == 3
        assert alone() == 600
        with pytest.raises(LimitExceeded, match="the time limit of 2 s is exceeded"):
            limited(lambda *, limits: (clock.move(3), check_time()))(limits=Limits(seconds=2))


@pytest.mark.long
def test_factors_are_found_apart_as_here() -> None:
    """Above some degree a denominator is factored in a process that can be stopped: the same factors."""
    f = QQ.poly([-1, *[0] * 503, 1])
    found = QQ.factor(f)
    with Budget().watched():
        assert QQ.factor(f) == found
    product = QQ.poly([1])
    for p, k in found:
        product = product * p**k
    assert product == f
    assert len(found) == 24  # the divisors of 504
    with Budget(Limits(seconds=0)).watched(), pytest.raises(LimitExceeded):
        QQ.factor(QQ.poly([-3, *[0] * 1259, 1, 7]))


@pytest.mark.long
def test_what_a_process_has_not_factored_is_not_factored_without_end() -> None:
    """The process is stopped by the time on the wall, while the clock of the call stands still."""
    with (
        controlled(),
        Budget(Limits(seconds=0.5)).watched(),
        pytest.raises(LimitExceeded, match="no factors of a polynomial of degree 5040"),
    ):
        QQ.factor(QQ.poly([-1, *[0] * 5039, 1]))


def test_an_answer_is_undecided_or_verified_wherever_the_time_ends(capsys: pytest.CaptureFixture[str]) -> None:
    """A time that ends while the answer is verified leaves no sentence that says that it was."""
    said = set()
    for looks in range(30):
        with controlled(looks_in_time=looks):
            run(["solve", "x", "--limit", "seconds=10"])
        out = capsys.readouterr().out
        said.add(out)
        assert not ("undecided: while the answer was verified" in out and "\n  verified: " in out)
    assert any("undecided: while the answer was verified" in out for out in said)
    assert any("verified: every exclusion was recomputed" in out for out in said)


@pytest.mark.parametrize(
    "text", ["1/({})", "x/({} + exp(x))", "1/((x + 1/2)*({}))", "({})^(-2)", "1 + ({})/({} + x^40)"]
)
@pytest.mark.parametrize("coefficient", ["{k}", "a^{k}", "sqrt({k})"])
def test_expressions_are_read_in_short_steps(text: str, coefficient: str) -> None:
    """Whether a sum of 40 terms is zero, SymPy asks itself in 100,000 calls, and has no answer."""
    terms = " + ".join(f"{coefficient.format(k=k)}*x^{k}" for k in range(1, 41))
    read_expression("1/(x + sqrt(2))")  # with what is loaded once
    with stretches() as work, Budget().watched():
        assert read_expression(text.replace("{}", terms)) != 0
    assert work.longest < 40_000  # 19,000 to 22,500, by the order of hashes


@pytest.mark.parametrize(
    "text", ["1/(x - x)", "1/(sqrt(8) - 2*sqrt(2))", "x/(x*((1 + sqrt(2))*(1 - sqrt(2)) + 1))", "1/(x*0)"]
)
def test_a_division_by_zero_is_seen_as_an_expression_is_read(text: str) -> None:
    with pytest.raises(InputError, match="division by zero"):
        read_expression(text)


def test_a_short_polynomial_of_many_factors_is_factored_where_it_can_be_stopped() -> None:
    """At degree 240 a second for 120 quadratic factors, and a hundredth for one factor: in time, and here."""
    quadratics = [QQ.poly([k * k + 1, k, 1]) for k in range(1, 121)]
    product = prod(quadratics, start=QQ.poly([1]))
    irreducible = QQ.poly([3, 1, *[0] * 238, 1])
    with controlled(), Budget(Limits(seconds=0.01)).watched():
        assert [k for _, k in QQ.factor(irreducible)] == [1]
        with pytest.raises(LimitExceeded, match="no factors of a polynomial of degree 240"):
            QQ.factor(product)


@pytest.mark.parametrize("text", ["y'' - 2*x*y' + 400*y = 0", "x^2 - 401", "(1 - x^2)*y'' - 2*x*y' + 10100*y = 0"])
@pytest.mark.parametrize("group", [True, False])
def test_a_batch_writes_its_record_within_the_time_of_the_equation(text: str, group: bool) -> None:
    """The time ends after the answer was found; where there is none, the record says so whenever it ends."""
    job = Job(limits=Limits(seconds=1), group=group)
    item = Item(1, text, "x")
    with controlled() as clock:
        answer = kovacic.solve(text, var="x", limits=job.engine_limits)
    found_after = clock.looks
    with controlled() as clock:
        assert solve_item(item, job, job.engine_limits).data["riccati"] is not None
    written_after = clock.looks
    assert not answer.reason
    assert written_after > found_after + 3
    for looks in (found_after // 2, found_after + 3):
        with controlled(step=1 / looks) as clock:
            record = solve_item(item, job, job.engine_limits)
        assert "the time limit of 1 s is exceeded" in record.data["proof"]["undecided"]
    assert clock.looks <= looks + 20


@pytest.mark.parametrize(
    ("power", "outside"),
    [*((power, "1") for power in ("2", "4/3", "-5/2", "1/2")), ("7/3", "sin(x)"), ("2", "exp(x^2)")],
)
def test_an_expansion_is_foreseen_wherever_sums_are_multiplied(power: str, outside: str) -> None:
    """3^12 terms, under roots, in powers of roots and in functions; few terms aren't refused."""

    def integrand(count: int) -> sympy.Expr:
        bases = [x**5 + sympy.sin(k * x) + 1 for k in range(1, count + 1)]
        return sympy.Mul(*bases) ** sympy.Rational(power) * sympy.sympify(outside.replace("^", "**"))

    with controlled(), Budget(Limits(seconds=1)).watched():
        assert prepared_integrand(integrand(2)) != 0
        with pytest.raises(LimitExceeded, match="expanding an integrand"):
            prepared_integrand(integrand(12))


@pytest.mark.parametrize(
    "kind",
    [pytest.param("root", marks=pytest.mark.long), pytest.param("function", marks=pytest.mark.long), "exponential"],
)
def test_an_expansion_is_foreseen_where_a_long_factor_stands_in_many_terms(kind: str) -> None:
    """400 terms, each of them with a factor of a hundred parts; a shorter factor isn't refused."""

    def integrand(count: int) -> sympy.Expr:
        inside = sympy.Add(*[k * x**k for k in range(1, count + 1)])
        factor = {
            "root": sympy.sqrt(inside),
            "function": sympy.hyper((1,), (2,), inside),
            "exponential": sympy.exp(inside),
        }
        waves = [sympy.Add(*[f(k * x) for k in range(1, 21)]) for f in (sympy.sin, sympy.cos)]
        return sympy.Mul(*waves) * factor[kind]

    with controlled(), Budget(Limits(seconds=1)).watched():
        assert prepared_integrand(integrand(1)) != 0
        with pytest.raises(LimitExceeded, match="expanding an integrand"):
            prepared_integrand(integrand(40))


@pytest.mark.parametrize("outside", [pytest.param("1", marks=pytest.mark.long), "sin(x)", "exp(x^2)"])
def test_a_product_of_polynomials_is_no_long_expansion(outside: str) -> None:
    """Powers of the variable are gathered: 31 terms, and not 2^30."""
    product = sympy.Mul(*[x + k for k in range(1, 31)]) * sympy.sympify(outside.replace("^", "**"))
    with controlled(), Budget(Limits(seconds=1)).watched():
        assert len(sympy.Add.make_args(prepared_integrand(product))) == 31


def test_a_limit_of_zero_is_a_limit() -> None:
    """Not the default: with `Limits(degree=0)` no product, quotient or power may contain the variable."""
    constants = Limits(degree=0)
    assert kovacic.solve("2/3", limits=constants).case == 1
    for S in ("2*x", "x^2", "(x + 1)/(x + 2)", "a*x", "y'' = x*y"):
        with pytest.raises(LimitExceeded, match="above the limit of 0"):
            kovacic.solve(S, limits=constants)
    for name, S in {"text_length": "2", "digits": "2", "exponent": "x^2", "bits": "3*x", "parameters": "a*x"}.items():
        with pytest.raises(LimitExceeded, match="0") as caught:
            kovacic.solve(S, limits=Limits(**{name: 0}))
        assert caught.value.limit == name
