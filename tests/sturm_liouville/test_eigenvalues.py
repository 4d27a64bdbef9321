"""`kovacic.eigenvalues`: proven enclosures of eigenvalues, against published digits and closed forms."""

import cmath
import pickle
from fractions import Fraction

import flint
import pytest
import sympy
from work import check_work

import kovacic
from kovacic import eigenvalues
from kovacic.closed_form.order import is_below
from kovacic.general_solution.boundary_problems import read_eigenproblem
from kovacic.sturm_liouville import discs
from kovacic.sturm_liouville.discs import germ
from kovacic.sturm_liouville.ends import _times_square
from kovacic.sturm_liouville.problem import stretches_of

HALF_LINE = (0, "oo")


def schroedinger(V, conditions=None, **given):
    return eigenvalues(f"-y'' + ({V})*y = E*y", conditions, parameter="E", **given)


def check(levels, published, digits=15):
    """Each published decimal, rounded in its last place, is in its ball, and levels are numbered without a gap."""
    assert len(levels) == len(published)
    for level, text in zip(levels, published, strict=True):
        size = max(abs(float(text)), 1e-3)
        assert level.value.radius <= 10.0**-digits * size
        last_place = 10.0 ** -len(text.partition(".")[2])
        assert abs(float(level.value) - float(text)) <= last_place + 1e-15 * size, (text, str(level))


def test_quartic_oscillator_has_its_published_levels():
    # F. T. Hioe & E. W. Montroll, J. Math. Phys. 16 (1975) 1945
    found = schroedinger("x^4", count=2, digits=20)
    for level, text in zip(found, ["1.06036209048418289964704601669", "3.79967302980139416878309418851"], strict=True):
        error = abs(level.value - kovacic.Ball.of(text))
        assert error.lower <= 1e-29 + level.value.radius
        assert level.value.radius < 1e-19
    assert [level.zeros for level in found] == [0, 1]


@pytest.mark.parametrize(
    ("equation", "conditions", "given", "published"),
    [
        ("y'' + lambda*y = 0", "y(0)=0, y(pi)=0", {}, ["1.0", "4.0", "9.0"]),
        ("y'' + lambda*y = 0", "y'(0)=0, y'(pi)=0", {}, ["0.0", "1.0", "4.0"]),
        ("y'' + lambda*y = 0", "y(0)=0, y(1)+y'(1)=0", {}, ["4.11585837", "24.13934203", "63.65910655"]),
        pytest.param("((1-x^2)*y')' + lambda*y = 0", None, {"domain": (-1, 1)}, ["0.0"], marks=pytest.mark.long),
        pytest.param(
            "x*y'' + y' + lambda*x*y = 0",
            "y(0)=bounded, y(1)=0",
            {},
            ["5.783185962947", "30.471262343662", "74.887006790695"],
            marks=pytest.mark.long,
        ),
        ("y'' = lambda*y", "y(0)=0, y(1)=0", {}, ["-9.869604401089358", "-39.478417604357434"]),
        pytest.param(
            "-y'' + 2*y/x^2 = lambda*y",
            "y(0)=0, y(1)=0",
            {},
            ["20.190728556427", "59.679515944109"],
            marks=pytest.mark.long,
        ),  # zeros of j_1
        # 10^4 (1/4 - k^2), tanh(k log(101)) = 2 k: 0 is regular, however close the singular point beyond it is
        ("(100*x + 1)^2*y'' + lambda*y = 0", "y'(0)=0, y(1)=0", {}, ["107.0560891491"]),
    ],
)
def test_classical_problems_on_an_interval(equation, conditions, given, published):
    check(eigenvalues(equation, conditions, count=len(published), **given), published)


def test_characteristic_values_of_mathieu_equation():
    # DLMF 28.7 and Abramowitz & Stegun, table 20.1, q = 5
    equation = "y'' + (lambda - 2*q*cos(2*x))*y = 0"
    periodic = eigenvalues(equation, "y(0)=y(pi), y'(0)=y'(pi)", params={"q": 5}, count=3)
    check(periodic, ["-5.80004602", "2.09946045", "7.44910974"])
    assert [level.zeros for level in periodic] == [0, 2, 2]
    antiperiodic = eigenvalues(equation, "y(0)=-y(pi), y'(0)=-y'(pi)", params={"q": 5}, count=2)
    check(antiperiodic, ["-5.79008060", "1.85818754"])


def test_coinciding_periodic_levels_are_a_pair():
    found = eigenvalues("y'' + lambda*y = 0", "y(0)=y(1), y'(0)=y'(1)", count=3, digits=8)
    assert [level.alone for level in found] == [True, False, False]
    assert [level.zeros for level in found] == [0, 2, 2]
    assert found[1].value == found[2].value


@pytest.mark.parametrize(
    ("V", "given", "published"),
    [
        pytest.param("x^2", {}, ["1.0", "3.0"], marks=pytest.mark.long),
        ("abs(x)", {}, ["1.018792971647471", "2.338107410459767"]),
        pytest.param(
            "-1/x", {"conditions": "y(0)=0", "domain": HALF_LINE}, ["-0.25", "-0.0625"], marks=pytest.mark.long
        ),
    ],
)
def test_potentials_with_known_levels(V, given, published):
    check(schroedinger(V, count=len(published), **given), published)


@pytest.mark.long
def test_all_levels_below_the_essential_spectrum_are_known_to_be_all():
    found = schroedinger("-5/cosh(x)^2", count=9)  # -(s - n)^2, s (s + 1) = 5
    check(found, ["-3.208712152522080", "-0.626136457566240"])
    assert found.complete
    assert schroedinger("5/cosh(x)^2", count=1).complete


def test_a_note_says_which_solution_is_meant_at_a_singular_end():
    problem = read_eigenproblem("x*y'' + y' + lambda*x*y = 0", "y(1)=0", domain=(0, 1))
    assert "at x = 0 all solutions are square integrable: the smallest one is meant" in str(problem.answer())
    other = read_eigenproblem(
        "-y'' + 3/4/x^2*y = lambda*y", "y(1)=0", domain=(0, 1)
    )  # x^(-1/2) isn't square integrable
    assert "all solutions" not in str(other.answer())


@pytest.mark.long
def test_a_bound_state_at_the_threshold_leaves_completeness_open():
    found = schroedinger("-6/cosh(x)^2", count=5, digits=6)
    assert [round(float(level.value), 5) for level in found] == [-4, -1]
    assert not found.complete
    assert "isn't proven" in str(found)


@pytest.mark.parametrize(
    ("V", "given", "said"),
    [
        ("-cosh(x)", {}, "limit circle"),
        ("-x^3", {}, "limit circle"),
        ("-x", {}, "no lowest level"),
        ("-x^2", {}, "no lowest level"),
        ("I*x^3", {}, "real"),
        ("sin(x)", {}, "no limit"),
        ("-1/x^2", {"domain": HALF_LINE}, "not known to be real"),
        ("1/(x-1)^2", {"domain": HALF_LINE, "conditions": "y(0)=0"}, "aren't known to be analytic"),
        ("a*x^2", {}, "values are needed for a"),
        ("x^2", {"domain": HALF_LINE}, "a condition is needed"),
        ("x^2", {"conditions": "y(0)=1", "domain": HALF_LINE}, "homogeneous"),
    ],
)
def test_what_has_no_levels_is_refused_with_the_reason(V, given, said):
    with pytest.raises(kovacic.InputError, match=said):
        schroedinger(V, **given)


def test_parameters_have_values_in_the_equation_and_in_the_conditions():
    given = {"params": {"L": 2, "k": 1}, "count": 1, "digits": 8}
    found = eigenvalues("y'' + (lambda - k)*y = 0", "y(0)=0, y(L)=0", **given)
    assert abs(float(found[0].value) - 1 - (3.14159265358979 / 2) ** 2) < 1e-7
    with pytest.raises(kovacic.InputError, match="the end L isn't one"):
        eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(L)=0")
    with pytest.raises(kovacic.InputError, match="a text or a mapping"):
        eigenvalues("y'' + lambda*y = 0", 5)


def test_a_parameter_that_is_not_linear_is_refused():
    with pytest.raises(kovacic.InputError, match="linear in y and in k"):
        eigenvalues("y'' + k^2*y = 0", "y(0)=0, y(1)=0", parameter="k")
    with pytest.raises(kovacic.NotLinear, match="contains no derivative of y"):  # a potential alone
        kovacic.eigenvalues("x^4")
    with pytest.raises(kovacic.NotLinear, match="is of order 1"):
        kovacic.eigenvalues("y' + lambda*y = 0")


def test_answers_are_sequences_that_can_be_pickled():
    found = eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(1)=0", count=2)
    assert pickle.loads(pickle.dumps(found)) == found
    assert found[:1] == (found[0],)
    assert found.to_dict()["levels"][1]["zeros"] == 1


@pytest.mark.slow
def test_close_pairs_of_a_double_well_are_told_apart():
    """Their distance is 1.03e-16: balls of 15 digits would contain both levels, and so would the numbers as printed."""
    found = schroedinger("x^4 - 20*x^2", count=2)
    assert all(level.alone for level in found)
    assert not found[0].value.overlaps(found[1].value)
    assert 0 < float(found[1].value - found[0].value) < 2e-16
    printed = [level.value.__str__().split(" ± ") for level in found]
    gap = Fraction(printed[1][0]) - Fraction(printed[0][0])
    assert gap > sum(Fraction(radius) for _, radius in printed)


def test_spectrum_has_numeric_levels_beside_formulas_or_without():
    quartic = kovacic.spectrum("x^4", levels=2, digits=10)
    assert [level.zeros for level in quartic.numeric] == [0, 1]
    assert quartic.to_dict()["numeric"]["levels"][0]["value"]["re"].startswith("1.0603620904")
    assert "E = 1.060362" in str(quartic)
    half_line = kovacic.spectrum("x^2", domain=HALF_LINE, levels=1, digits=10)  # with Friedrichs' condition, 4 n + 3
    assert half_line.numeric[0].value.contains(3)
    kink = kovacic.spectrum("abs(x)", levels=1, digits=8)
    assert abs(float(kink.numeric[0].value) - 1.018792971647) < 1e-8
    falling = kovacic.spectrum("-x^4", levels=1)
    assert falling.numeric.notes[0].endswith("square integrable (limit circle): a boundary condition is needed")
    assert str(falling).count("a boundary condition is needed") == 1
    with pytest.raises(kovacic.InputError, match="values of g"):
        kovacic.spectrum("g*x^4", levels=1)


@pytest.mark.long
def test_levels_beside_simple_poles_of_a_sine():
    """-1/sin(x) is even about pi/2, where sin(x) turns, and the level sin(x) (1 - sin(x))^(1/2) changes its sign."""
    found = kovacic.spectrum("-1/sin(x)", domain=(0, "pi"), levels=2, digits=3)
    (state,) = found.states()
    assert found.numeric[state.number].value.contains(state.energy)
    assert found.numeric[state.number].zeros == state.zeros == 1
    x = sympy.Symbol("x")
    assert sympy.simplify(state.wave.diff(x, 2) + (1 / sympy.sin(x) + state.energy) * state.wave) == 0
    left, right = (complex(state.wave.subs(x, a)) for a in (1.25, 3.25 - 1.25))
    assert left.imag == right.imag == 0
    assert left.real * right.real < 0


def test_the_command_prints_levels_and_reports_failure(capsys):
    from kovacic.cli.main import run

    assert run(["eigenvalues", "y'' + lambda*y = 0", "--conditions", "y(0)=0, y(pi)=0", "--count", "2"]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert len(printed) == 2
    assert printed[0].startswith(("lambda = 1.0000000", "lambda = 0.9999999"))
    assert run(["eigenvalues", "-y'' - cosh(x)*y = E*y", "--parameter", "E"]) == 2
    arguments = ["eigenvalues", "y'' + lambda*y = 0", "--conditions", "y(0)=0, y(1)=0", "--count", "1", "--json"]
    assert run(arguments) == 0
    line = capsys.readouterr().out
    assert line.startswith('{"schema": 1, "input": "y\'\' + lambda*y = 0"')
    assert '"zeros": 0' in line


def test_an_interrupted_command_prints_what_it_has_found(capsys, monkeypatch):
    from kovacic.cli.main import Exit, run
    from kovacic.sturm_liouville.solve import Eigenproblem

    whole = Eigenproblem.levels

    def interrupted(self, count, digits):
        for number, level in enumerate(whole(self, count, digits)):
            if number == 1:
                raise KeyboardInterrupt
            yield level

    monkeypatch.setattr(Eigenproblem, "levels", interrupted)
    assert run(["eigenvalues", "y'' + lambda*y = 0", "--conditions", "y(0)=0, y(1)=0"]) == Exit.INTERRUPTED
    assert capsys.readouterr().out.startswith("lambda = 9.8696")


def test_pictures_show_numeric_levels_with_their_balls():
    figure = kovacic.spectrum("x^4", levels=2, digits=8).plot()
    assert [line.get_label()[:9] for line in figure.axes[0].lines[1::2]] == ["E_0 = 1.0", "E_1 = 3.7"]


def test_wave_functions_have_their_zeros_and_shape():
    numpy = pytest.importorskip("numpy")
    found = eigenvalues("x^2*y'' + x*y' + lambda*y = 0", "y(1)=0, y(4)=0", count=2, digits=8)
    x = numpy.linspace(1, 4, 50)
    expected = numpy.sin(2 * numpy.pi * numpy.log(x) / numpy.log(4))
    y = found.wave(1)(x)
    assert numpy.allclose(abs(y), abs(expected), atol=5e-4)


def test_a_weight_may_vanish_at_the_ends_or_touch_zero():
    found = eigenvalues("y'' + lambda*sin(x)*y = 0", "y(0)=0, y(pi)=0", count=2, digits=8)
    assert [level.zeros for level in found] == [0, 1]
    even = eigenvalues("y'' + lambda*x^2*y = 0", "y(-1)=0, y(1)=0", count=1, digits=10)
    half = eigenvalues("y'' + lambda*x^2*y = 0", "y'(0)=0, y(1)=0", count=1, digits=10)
    assert even[0].value.overlaps(half[0].value)
    with pytest.raises(kovacic.InputError, match="positive"):
        eigenvalues("y'' + lambda*cos(x)*y = 0", "y(0)=0, y(pi)=0")


@pytest.mark.long
def test_generated_potentials_agree_with_collocation():
    """No level is missed: eight polynomials on an interval with y = 0 or y' = 0 at its ends, beside Legendre collocation."""
    numpy = pytest.importorskip("numpy")
    points = numpy.random.default_rng(47)
    for _ in range(8):
        coefficients = [int(c) for c in points.integers(-9, 10, 5)]
        q = " + ".join(f"({c})*x^{k}" for k, c in enumerate(coefficients))
        orders = [int(order) for order in points.integers(0, 2, 2)]
        conditions = ", ".join(f"y{chr(39) * order}({end})=0" for order, end in zip(orders, (-1, 2), strict=True))
        found = schroedinger(q, conditions, count=4, digits=10)
        assert [level.zeros for level in found] == [0, 1, 2, 3]
        expected = _galerkin(numpy, coefficients, orders)
        assert numpy.allclose([float(level.value) for level in found], expected[:4], rtol=1e-8, atol=1e-8)


def _galerkin(numpy, coefficients, orders, size=40):
    """Eigenvalues on (-1, 2) with y = 0 (order 0) or y' = 0 (order 1) at the ends: polynomials as trial functions."""
    P = numpy.polynomial.legendre
    x, weights = P.leggauss(3 * size)
    values, slopes = [], []
    for k in range(size):
        p = P.Legendre.basis(k)
        for end, order in zip((-1, 1), orders, strict=True):
            p = p * P.Legendre.fromroots([end]) if order == 0 else p  # y' = 0 is the natural condition
        values.append(p(x))
        slopes.append(p.deriv()(x))
    values, slopes = numpy.array(values), numpy.array(slopes)
    potential = numpy.polyval(coefficients[::-1], (3 * x + 1) / 2)
    stiffness = slopes * weights @ slopes.T * (2 / 3) + (values * weights * potential) @ values.T * 1.5
    mass = (values * weights) @ values.T * 1.5
    root = numpy.linalg.cholesky(mass)
    half = numpy.linalg.solve(root, stiffness)
    return numpy.linalg.eigvalsh(numpy.linalg.solve(root, half.T))


def test_missing_values_are_asked_for_in_the_words_of_each_door() -> None:
    with pytest.raises(kovacic.InputError) as asked:
        kovacic.eigenvalues("y'' + (lambda - k*x^2)*y = 0", "y(0)=0, y(1)=0")
    assert (asked.value.hint, asked.value.shell) == ("params={'k': 3}, for instance", "--param k=3, for instance")
    with pytest.raises(kovacic.InputError) as asked:
        kovacic.spectrum("2/x^2 - Z/x", domain=(0, "oo"), assume={"Z": "positive"}, levels=2)
    assert (asked.value.hint, asked.value.shell) == ("assume={'Z': 2}, for instance", "--assume Z=2, for instance")


@pytest.mark.parametrize(
    ("strength", "conditions", "side"),
    [
        (3, "y(0) = y(1), y'(0) = y'(1)", 1),
        (3, "y(0) = -y(1), y'(0) = -y'(1)", -1),
        (-5, "y(0) = y(1), y'(0) = y'(1)", 1),
    ],
)
def test_a_comb_of_delta_functions(strength: int, conditions: str, side: int) -> None:
    """Kronig and Penney: cos(k) + c sin(k)/(2 k) = 1 and -1 at the edges of the bands, E = k^2."""
    found = kovacic.eigenvalues(
        f"y'' + (E - ({strength})*DiracDelta(x - 1/2))*y = 0", conditions, count=3, digits=8, parameter="E"
    )
    assert len(found) == 3
    for level in found:
        k = cmath.sqrt(float(level.value))
        assert abs(cmath.cos(k) + strength * cmath.sin(k) / (2 * k) - side) < 1e-6


@pytest.mark.parametrize(
    ("V", "pieces"),
    [
        ("abs(abs(abs(x) - 2) - 1)", "-3 -x - 3, -2 x + 3, -1 -x - 1, 0 x + 1, 1 1 - x, 2 x - 1, 3 3 - x, oo x - 3"),
        ("Max(1, -x, x)", "-1 -x, 1 1, oo x"),
        ("Piecewise((0, abs(x) < L), (1, True))", "-L 1, 0 0, L 0, oo 1"),
        ("SingularityFunction(x, 1, 1)", "1 0, oo x - 1"),
    ],
)
def test_pieces_of_a_potential(V: str, pieces: str) -> None:
    x, L = sympy.Symbol("x"), sympy.Symbol("L", positive=True)
    found = stretches_of(sympy.sympify(V, {"x": x, "L": L}), sympy.S.One, x, (-sympy.oo, sympy.oo))
    assert ", ".join(f"{piece.high} {piece.Q}" for piece in found) == pieces


def test_delta_functions_of_polynomials_and_at_sums_of_roots() -> None:
    x, a = sympy.Symbol("x"), sympy.Symbol("a", positive=True)
    for u, strength in (
        (x - sympy.sqrt(2) * (1 + sympy.sqrt(3)), 1),
        (x**3 - 1, sympy.Rational(1, 3)),
        (a * x - 2, 1 / a),
    ):
        _, right = stretches_of(sympy.DiracDelta(u), sympy.S.One, x, (-sympy.oo, sympy.oo))
        assert right.delta == strength
    with pytest.raises(kovacic.InputError, match="changes its sign"):
        stretches_of(sympy.DiracDelta(abs(x) - 1), sympy.S.One, x, (-sympy.oo, sympy.oo))


def test_a_delta_function_as_a_weight_is_refused() -> None:
    with pytest.raises(kovacic.InputError, match="as a weight"):
        kovacic.eigenvalues("y'' + E*DiracDelta(x - 1/2)*y = 0", "y(0) = 0, y(1) = 0", parameter="E")


def test_a_level_far_from_the_ends_of_its_bracket():
    """Where the mismatch is 10^12 times larger at one end, chords alone would stay next to the other one."""
    found = schroedinger("1/(1 + x^2)", "y'(0) + 5*y(0) = 0", domain=(0, "oo"), count=1, digits=8)
    check(found, ["-24.01812117"], digits=7)


def test_a_germ_has_its_limit_at_zero():
    t, s = sympy.symbols("t s")
    assert germ(sympy.sin(t), t, 1).subs(t, 0) == 1
    assert germ(1 - sympy.cos(t), t, 2).subs(t, 0) == sympy.Rational(1, 2)
    assert germ(sympy.sin(t), t, 1).subs(t, s) == germ(sympy.sin(s), s, 1)
    assert germ(sympy.sin(s * t), t, 1).subs(s, 0) == germ(0, t, 1)
    assert germ(sympy.sin(s * t), t, 1).subs(s, 2) == germ(sympy.sin(2 * t), t, 1)


def test_rational_functions_need_no_germs():
    t = sympy.Dummy("t", positive=True)
    assert sympy.expand(_times_square(3 / t**2 + 5 / t + 2, t)) == 2 * t**2 + 5 * t + 3
    assert not _times_square((3 + t) / (t * (t + 2)), t).has(germ)
    assert _times_square(7 / sympy.sin(t) ** 2 + t, t).subs(t, 0) == 7


def test_which_of_two_points_is_below_the_other():
    """Equal numbers in different forms, too: sqrt(2) + sqrt(3) and sqrt(5 + 2 sqrt(6)), and by Machin's formula."""
    s, t = sympy.sqrt(2) + sympy.sqrt(3), sympy.sqrt(5 + 2 * sympy.sqrt(6))
    a, p = sympy.Symbol("a", real=True), sympy.Symbol("p", positive=True)
    fifth, other = sympy.atan(sympy.Rational(1, 5)), sympy.atan(sympy.Rational(1, 239))
    for one, same in ((s, t), (4 * fifth - other, sympy.pi / 4)):
        assert not is_below(one, same)
        assert not is_below(same, one)
    for low, high in ((sympy.pi, sympy.Rational(22, 7)), (-sympy.oo, t), (s, sympy.oo), (a, a + p)):
        assert is_below(low, high)
        assert not is_below(high, low)
    with pytest.raises(kovacic.InputError, match="it isn't known whether"):
        is_below(a, p)


@pytest.mark.parametrize(
    ("e", "centre", "radius", "boxes"),
    [
        ("x^4 - 3*x", 0.25, 0.75, 1),
        ("1/cosh(x)", 0.25, 1.25, 17),
        ("sqrt(x)", 2, 1.5, 1),
        ("1/x", 0.25, 1.25, 3),
        ("1/cosh(x)", 0, 1.5625, 15),
    ],
)
def test_the_bound_in_a_disc_takes_sixteen_boxes_only_where_one_is_too_large(e, centre, radius, boxes, monkeypatch):
    seen = []

    class Seen(discs._GermEvaluator):
        def __init__(self, values, **given):
            seen.append(values)
            super().__init__(values, **given)

    monkeypatch.setattr(discs, "_GermEvaluator", Seen)
    e, x = sympy.sympify(e), sympy.Symbol("x")
    bound = discs.size_bound(e, x, flint.arb(centre), flint.arb(radius))
    assert len(seen) == boxes
    assert bound.is_finite() == (boxes in (1, 17))  # else the last box has a pole, such as pi/2 i
    if bound.is_finite():
        largest = max(abs(complex(e.subs(x, centre + radius * cmath.exp(k / 2 * 1j)))) for k in range(13))
        assert largest < bound < 5 * largest


# Their constants are in no other test.
LEVELS = [
    (
        "-y'' + x^4*y = E*y",
        None,
        {"parameter": "E", "count": 2, "digits": 15},
        6963,
        ["1.06036209048418 ± 2.7e-16", "3.79967302980139 ± 9.9e-16"],
    ),
    (
        "y'' + lambda*(1 + x^2/7)*y = 0",
        "y(0)=0, 2*y(3)+5*y'(3)=0",
        {"count": 2, "digits": 12},
        2994,
        ["0.298985743406106 ± 8.0e-14", "1.88793183107595 ± 5.2e-13"],
    ),
    (
        "((4 - x^2)*y')' + (lambda + 3)*y = 0",
        None,
        {"domain": (-2, 2), "count": 1, "digits": 4},
        66135,
        ["-3.00000011920929 ± 7.6e-5"],
    ),
    (
        "x*y'' + y' + lambda*x*y = 0",
        "y(0)=bounded, y(7/5)=0",
        {"count": 2, "digits": 12},
        7475,
        ["2.95060508313611 ± 7.6e-13", "15.5465624202358 ± 4.2e-12"],
    ),
    (
        "-y'' + (6/x^2 - 11/x)*y = E*y",
        None,
        {"parameter": "E", "domain": (0, "oo"), "count": 1, "digits": 3},
        60231,
        ["-3.36110973358154 ± 0.00085"],
    ),
    (
        "y'' + (lambda - 7*cos(2*x))*y = 0",
        "y(0)=y(pi), y'(0)=y'(pi)",
        {"count": 2, "digits": 12},
        3884,
        ["-3.54602006194458 ± 9.1e-13", "3.02766431259452 ± 7.9e-13"],
    ),
    (
        "-y'' - 9*exp(-x^2/5)*y = E*y",
        None,
        {"parameter": "E", "count": 1, "digits": 4},
        17509,
        ["-7.73374581336975 ± 0.00020"],
    ),
    (
        "-y'' + abs(x - 1/3)*y = E*y",
        "y(-1)=0, y'(2)=0",
        {"parameter": "E", "count": 2, "digits": 12},
        2189,
        ["1.05459903617473 ± 2.9e-13", "3.2540701791813 ± 8.2e-13"],
    ),
    (
        "-y'' + (x^2 - 3*sin(x))*y = E*y",
        "y(0)=0",
        {"parameter": "E", "domain": (0, "oo"), "count": 2, "digits": 12},
        10084,
        ["0.541365194251552 ± 1.4e-13", "4.85106765603432 ± 1.3e-12"],
    ),
    (
        "-y'' + 3/4/sin(x)^2*y = E*y",
        None,
        {"parameter": "E", "domain": (0, "pi"), "count": 1, "digits": 5},
        23067,
        ["2.24999999254942 ± 5.7e-6"],
    ),
]


@pytest.mark.parametrize(("equation", "conditions", "given", "looks", "balls"), LEVELS, ids=[row[0] for row in LEVELS])
def test_the_work_of_levels(equation, conditions, given, looks, balls):
    check_work(lambda: [level.value for level in eigenvalues(equation, conditions, **given)], looks, balls)
