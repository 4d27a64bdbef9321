"""`kovacic.spectrum`: printed energies, eigenvalues bracketed by counting zeros, wave functions in the equation, norms."""

from __future__ import annotations

import json
from functools import partial
from math import exp, inf
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mpmath
import pytest
import sympy
from build import parametrize, read_expression, run, size
from clocks import controlled
from potentials import MORE, QUASI, TABLE, Solvable
from scipy.integrate import quad
from shooting import is_level, zeros

import kovacic
from kovacic.bound_states.closed_forms import _Window
from kovacic.bound_states.families import _choices
from kovacic.bound_states.levels import Levels

x, n = sympy.symbols("x n")
HALF = (0, "oo")
LINE = ("-oo", "oo")
QUICK, LONG = {"Coulomb"}, {"Scarf II", "isotonic oscillator", "exceptional Laguerre polynomials X_1"}


def spectrum_of(row: Solvable) -> Any:
    return kovacic.spectrum(row.V, domain=row.domain, assume=row.assume, boundary=row.boundary)


def values_of(row: Solvable) -> dict[sympy.Symbol, sympy.Expr]:
    return {sympy.Symbol(name): read_expression(value) for name, value in row.values.items()}


def ends_of(row: Solvable) -> tuple[float, float]:
    infinite = {"oo": inf, "-oo": -inf}
    a, b = (
        infinite[str(end)] if str(end) in infinite else float(read_expression(str(end)).subs(values_of(row)))
        for end in row.domain
    )
    return a, b


def integral_of_square(y: sympy.Expr, a: float, b: float) -> float:
    wave = sympy.lambdify(x, y, "numpy")
    return quad(lambda z: complex(wave(complex(z))).real ** 2, a, b, limit=400, epsabs=0, epsrel=1e-11)[0]


def check(row: Solvable) -> None:
    """The printed formula; the number of each level, to ten digits; the equation; the norm."""
    found = spectrum_of(row)
    assert found.complete
    printed = read_expression(row.energy)
    assert any(sympy.simplify(levels.energy - printed) == 0 for levels in found.levels), row.name
    at, (a, b) = values_of(row), ends_of(row)
    V = read_expression(row.V).subs(at)
    numeric = sympy.lambdify(x, V, "numpy")
    states = found.states(row.values, count=3)
    levels = next(one for one in found.levels if all(c.subs({**at, n: 0}) == sympy.true for c in one.conditions))
    middle = 0.1 if (a, b) == (-inf, inf) else a + 1 if b == inf else (a + b) / 2 + 0.05
    for number, state in enumerate(states):
        assert state.zeros == number
        assert is_level(lambda z: float(numeric(z)), a, b, float(state.energy), number, middle)
        left = sympy.diff(state.wave, x, 2) - (V - state.energy) * state.wave
        scale = abs(sympy.N(state.wave.subs(x, sympy.Rational(7, 10)), 30))
        assert abs(sympy.N(left.subs(x, sympy.Rational(7, 10)), 30)) < 1e-15 * scale
        if levels.norm is not None and number in row.numbers:
            integral = integral_of_square(
                state.wave,
                max(a, -8.0 if "exp(-" in row.V else -40.0),
                min(b, 40.0 if "h(" in row.V or "exp" in row.V else 200.0),
            )
            (index,) = sympy.solve(levels.zeros - state.zeros, n)
            assert abs(integral / complex(sympy.N(levels.norm.subs({**at, n: index}))) - 1) < 1e-9


#: Answers as they are printed, and their first three levels: each norm is the integral, and each wave solves the equation.
PRINTED = [
    json.loads(line)
    for line in (Path(__file__).parents[1] / "data" / "spectra.jsonl").read_text(encoding="utf-8").splitlines()
]


@pytest.mark.parametrize("row", PRINTED, ids=[row["V"] for row in PRINTED])
def test_the_whole_answer(row: dict[str, Any]) -> None:
    found = kovacic.spectrum(row["V"], domain=tuple(row["domain"]), **row["options"])
    assert str(found).splitlines() == row["text"]
    known = found.states(count=3) if row["states"] else ()
    assert [[str(one.energy), one.zeros, str(one.wave)] for one in known] == row["states"]


@pytest.mark.long
@pytest.mark.parametrize("row", [row for row in TABLE + MORE if row.name in QUICK], ids=lambda row: row.name)
def test_levels_of_the_literature(row: Solvable) -> None:
    check(row)


@parametrize("row", [row for row in TABLE + MORE if row.name in LONG], ids=lambda row: row.name, ordinary=0, long=1)
def test_more_levels_of_the_literature(row: Solvable) -> None:
    check(row)


@pytest.mark.slow
@pytest.mark.parametrize("row", [row for row in TABLE + MORE if row.name not in QUICK | LONG], ids=lambda row: row.name)
def test_all_levels_of_the_literature(row: Solvable) -> None:
    check(row)


@parametrize(
    ("V", "domain", "degree", "printed", "source"),
    QUASI,
    ordinary=0,
    long=(0, 2, 5, 6),
    ids=[row[0] for row in QUASI],
)
def test_levels_by_degree(V: str, domain: tuple[object, object], degree: int, printed: str, source: str) -> None:
    """The polynomial of the energies, and each level by its number of zeros."""
    found = kovacic.spectrum(V, domain=domain, max_degree=degree)
    assert not found.complete
    assert {one.degree for one in found.algebraic} == {degree}
    product = sympy.Mul(*(one.polynomial for one in found.algebraic))
    assert sympy.cancel(product / read_expression(printed)).is_number
    potential = read_expression(V)
    numeric = sympy.lambdify(x, potential, "numpy")
    left, middle = (-inf, 0.1) if domain[0] == "-oo" else (0.0, 1.0)
    states = found.states()
    for state in states:
        assert is_level(lambda z: float(numeric(z)), left, inf, float(state.energy), state.zeros, middle)
        residual = sympy.diff(state.wave, x, 2) - (potential - state.energy) * state.wave
        assert size(residual.subs(x, sympy.Rational(7, 10)), 30) < 1e-15
    assert len(states) == sympy.degree(product, sympy.Symbol("E"))


@parametrize(
    ("V", "domain", "number"),
    [
        ("9/4*sech(x)*tanh(x)", ("-oo", "oo"), 1),  # the exponents at +-I are complex and irrational
        ("-17/2*sech(x)^2", HALF, 1),  # x = 0 is an ordinary point, and the middle of a symmetric potential
        ("-17/2*sech(x)^2", ("-oo", "oo"), 3),
        ("-9/4*sech(x)^2 + tanh(x)/2", ("-oo", "oo"), 1),
    ],
    ordinary=0,
    long=(1,),
)
def test_as_many_levels_as_a_solution_has_zeros(V: str, domain: tuple[object, object], number: int) -> None:
    """Just below the continuous spectrum."""
    found = kovacic.spectrum(V, domain=domain, boundary="friedrichs")
    assert found.complete
    assert len(found.states()) == number
    numeric = sympy.lambdify(x, read_expression(V), "numpy")
    low = -inf if domain[0] == "-oo" else 0.0
    top = min(float(numeric(end)) for end in (-300.0, 300.0)) - 0.02
    assert zeros(lambda z: float(numeric(z)), low, inf, top, 0.1) == number


@pytest.mark.long
def test_values_that_are_refused() -> None:
    with pytest.raises(kovacic.InputError, match="isn't a real number"):
        kovacic.spectrum("a*x^2").states({"a": "I"})
    coulomb = kovacic.spectrum("l*(l+1)/x^2 - 1/x", domain=HALF, assume={"l": ">=1"})
    with pytest.raises(kovacic.InputError, match="contradicts"):
        coulomb.states({"l": 0})
    with pytest.raises(kovacic.InputError, match="values are needed"):
        coulomb.states()


@pytest.mark.long
def test_levels_by_degree_with_parameters() -> None:
    """Razavy's and Turbiner's determinants; an exponent that isn't square integrable at the end is no level."""
    M, z, E, a, m, l = sympy.symbols("M z E a m l")  # noqa: E741
    razavy = kovacic.spectrum("(z*cosh(2*x) - M)^2", assume={"z": "positive"}, max_degree=1)
    assert [one.constraint for one in razavy.algebraic] == [M - 1, M - 2]
    assert sympy.expand(razavy.algebraic[1].polynomial - ((E - z**2 - 3) ** 2 - 4 * z**2)) == 0
    sextic = kovacic.spectrum("x^6 + 2*a*x^4 + (a^2 - 4*k - 3)*x^2")
    assert sympy.expand(sextic.algebraic[2].polynomial - (E**2 - 6 * E * a + 5 * a**2 - 8)) == 0
    radial = kovacic.spectrum("x^6 + l*(l+1)/x^2 - m*x^2", domain=HALF, assume={"l": ">=1"})
    assert [sympy.solve(one.constraint, m) for one in radial.algebraic] == [[2 * l + 5], [2 * l + 9]]
    assert sympy.expand(radial.algebraic[1].polynomial - (E**2 - 16 * l - 24)) == 0
    pole = kovacic.spectrum("x^2 + a/x", domain=HALF)  # y(0) = 0 at a simple pole
    assert [(one.degree, one.constraint) for one in pole.algebraic] == [
        (0, a),
        (1, a - 2),
        (1, a + 2),
        (2, a),
        (2, a**2 - 20),
    ]
    waves = (read_expression(f"x*({P})*exp(-x^2/2)") for P in ("1", "x + 1", "x - 1", "x^2 - 3/2", "x^2 + a*x/2 + 1"))
    assert [sympy.expand(one.wave / y) for one, y in zip(pole.algebraic, waves, strict=True)] == [1] * 5


@pytest.mark.long
def test_every_l_of_coulomb_has_its_levels() -> None:
    """At l = 0 Friedrichs' condition is needed, which is taken, and said."""
    for kind in (">=0", "natural"):
        found = kovacic.spectrum("l*(l+1)/x^2 - Z/x", domain=HALF, assume={"l": kind, "Z": "positive"})
        assert str(found.levels[0].energy) == "-Z**2/(4*(l + n + 1)**2)"
        assert (found.excluded, found.levels[0].conditions) == ((), ())
        assert found.states({"l": 0, "Z": 2})[0].energy == -1
        assert "Friedrichs' boundary condition is taken" in found.text()


@pytest.mark.parametrize(
    ("V", "domain"),
    [
        ("-x^4", ("-oo", "oo")),
        ("-exp(2*x)", ("-oo", "oo")),
        ("-1/x^2 + x^2", HALF),
    ],
)
def test_without_a_boundary_condition_there_is_no_spectrum(V: str, domain: tuple[object, object]) -> None:
    found = kovacic.spectrum(V, domain=domain)
    assert found.needs_boundary_condition
    assert not found.levels
    assert not found.complete
    assert "boundary condition" in found.text()


@parametrize(
    ("V", "domain"), [("x^2", HALF), ("-1/x", HALF), ("x", HALF), ("0", (0, "L")), ("cos(x)", HALF)], ordinary=(2, 4)
)
def test_friedrichs_condition_is_taken_where_the_operator_is_bounded_below(
    V: str, domain: tuple[object, object]
) -> None:
    """The same answer as with the condition given, and a note that says so."""
    found = kovacic.spectrum(V, domain=domain)
    given = kovacic.spectrum(V, domain=domain, boundary="friedrichs")
    assert found.boundary == "friedrichs"
    assert (found.levels, found.algebraic, found.reason) == (given.levels, given.algebraic, given.reason)
    assert "Friedrichs' boundary condition is taken" in found.text()


#: Potentials with a level at the edge of the continuous spectrum, its function, and its norm.
THRESHOLDS = [
    ("2/x^2 - 4/x^3 + 1/x^4", HALF, "exp(-1/x)/x", sympy.Rational(1, 2)),
    ("(6*x^2 - 2)/(1 + x^2)^2", LINE, "1/(x^2 + 1)", sympy.pi / 2),
    ("(2*x^2 - 1)/(1 + x^2)^2", LINE, "1/sqrt(x^2 + 1)", sympy.pi),
    ("5 + (12*x^2 - 3)/(1 + x^2)^2", LINE, "(x^2 + 1)^(-3/2)", 3 * sympy.pi / 8),
]


@parametrize(("V", "domain", "wave", "norm"), THRESHOLDS, ordinary=1, long=1)
def test_a_level_at_the_edge_of_the_continuous_spectrum(V: str, domain: Any, wave: str, norm: Any) -> None:
    found = kovacic.spectrum(V, domain=domain)
    (state,) = found.states()
    assert state.energy == (5 if V.startswith("5") else 0)
    assert sympy.simplify(state.wave / read_expression(wave)).is_number
    scale = sympy.simplify(state.wave / read_expression(wave)) ** 2
    assert sympy.simplify(state.norm - scale * norm) == 0
    assert found.closed_forms_complete or V.startswith("5")


def test_a_level_has_no_norm_if_the_time_ends_with_its_integral() -> None:
    V, domain, _, norm = THRESHOLDS[0]
    looks = []
    for _ in range(2):  # the second search, with what is stored by then, is as long as the third one
        with controlled() as hands:
            known = kovacic.spectrum(V, domain=domain)
        looks.append(hands.looks)
    with controlled(looks_in_time=looks[-1] - 10) as hands:
        late = kovacic.spectrum(V, domain=domain)
    assert hands.late_looks > 0
    (state,) = known.states()
    assert state.norm == norm
    (found,) = late.states()
    assert (found.energy, found.wave, found.norm) == (state.energy, state.wave, None)
    assert late.reason == known.reason


def test_a_search_that_runs_out_of_time_is_undecided() -> None:
    with controlled(looks_in_time=60):
        late = kovacic.spectrum("1/(x^2 + 1)")
    assert late.reason.startswith("undecided: the time limit")


def test_a_negative_letter_has_an_imaginary_root() -> None:
    """exp(sqrt(a) x), by which no solution decays."""
    found = kovacic.spectrum("a/(1 + x^2) - 3/(1 + x^2)^2", assume={"a": "negative"})
    assert "undecided" in found.reason


@parametrize(("V", "domain"), [("x^8 - 4*x^3", LINE), ("x^4 + 2*x", LINE)], ordinary=1)
def test_a_closed_form_at_one_end_alone_is_no_level(V: str, domain: Any) -> None:
    found = kovacic.spectrum(V, domain=domain)
    assert found.closed_forms_complete
    assert not found.states()
    assert "is square integrable at one end" in found.reason


@parametrize(
    ("V", "domain", "assume"),
    [
        ("6/x^2 + 1/x^4", HALF, {}),
        ("l*(l+1)/x^2 + g/x^4", HALF, {"l": ">=1", "g": "positive"}),
        ("1/(1 + x^2)", LINE, {}),
        ("4/cosh(x)^2 + 1/cosh(x)^4", LINE, {}),
        ("1/x^3 + 1/x", (2, "oo"), {}),
        ("-1/(x^2 - 7*x + 13)^2", (4, "oo"), None),
        ("-1/(1 + x^2)", LINE, None),
        ("1/(1 + x^2) - 2/(2 + x^2)", LINE, None),
    ],
    ordinary=(2, 5),
)
def test_repulsive_potentials_have_no_eigenvalues(V: str, domain: Any, assume: Any) -> None:
    """The virial theorem; not where V increases somewhere (the last three)."""
    found = kovacic.spectrum(V, domain=domain, assume=assume)
    assert found.complete == (assume is not None)
    assert ("no eigenvalues\n  (proven; a repulsive" in found.text()) == (assume is not None)
    assert not found.levels


@pytest.mark.long
@pytest.mark.parametrize(
    "kind", [pytest.param("real", marks=pytest.mark.long), pytest.param("positive", marks=pytest.mark.long), 2]
)
def test_the_shift_of_a_potential_is_a_parameter(kind: Any) -> None:
    """Of which something can be assumed, and which can have a value."""
    found = kovacic.spectrum("4*(1 - exp(-(x - b)))^2", assume={"b": kind})
    assert found.parameters == (() if kind == 2 else ("b",))
    assert [state.energy for state in found.states({} if kind == 2 else {"b": 1})] == [
        sympy.Rational(7, 4),
        sympy.Rational(15, 4),
    ]


#: Potentials with conditions at an end, the first energies, and whether there are no others.
WITH_CONDITIONS = [
    ("x^2", HALF, "y'(0) = 0", (1, 5, 9), True),
    ("x^2", HALF, "y(0) = 0", (3, 7, 11), True),
    ("-20/cosh(x)^2", HALF, "y'(0) = 0", (-16, -4), True),
    ("0", (0, "pi"), "y'(0) = 0, y'(pi) = 0", (0, 1, 4), True),
    ("0", (0, "pi"), "y'(0) = 0", ("1/4", "9/4", "25/4"), True),
    ("3", HALF, "y'(0) + 2*y(0) = 0", (-1,), True),
    ("-2/x", HALF, "y(0) = 0", (-1, "-1/4", "-1/9"), True),
    ("2/x^2 + x^2", HALF, "y(0) = 0", (5, 9, 13), True),
    ("3", HALF, "y'(0) = 2*y(0)", (), True),
    ("1/(1 + x^2)", HALF, "y'(0) = 0", (), True),
    ("1/(1 + x^2)", HALF, "y'(0) + 5*y(0) = 0", (), False),
    ("x^2", HALF, "y(0) + y'(0) = 0", (), False),
]


@parametrize(("V", "domain", "boundary", "energies", "complete"), WITH_CONDITIONS, ordinary=(0, 3, 5), long=4)
def test_conditions_at_an_end(V: str, domain: Any, boundary: str, energies: Any, complete: bool) -> None:
    """Neumann's at the middle of a symmetric potential gives its even levels; Robin's may have one below the infimum of V."""
    found = kovacic.spectrum(V, domain=domain, boundary=boundary)
    assert found.complete == complete
    states = found.states(count=3)
    assert [state.energy for state in states] == [*map(sympy.Rational, energies)]
    assert [state.zeros for state in states] == [*range(len(energies))]
    assert f"boundary condition: {boundary}" in found.text()


@pytest.mark.long
def test_numeric_levels_obey_the_conditions() -> None:
    box = kovacic.spectrum("0", domain=(0, 1), boundary="y(0) = y'(0)", levels=1, digits=8)
    assert "the levels solve sqrt(E)*tan(sqrt(E)) = -E\n" in box.text()
    assert abs(float(box.numeric[0].value) - 4.11585837) < 1e-7
    linear = kovacic.spectrum("x", domain=HALF, boundary="y'(0) = 0", levels=1, digits=8)
    assert abs(float(linear.numeric[0].value) - 1.018792971647) < 1e-7  # the first zero of Ai'
    well = kovacic.spectrum("1/(1 + x^2)", domain=HALF, boundary="y'(0) + 5*y(0) = 0", levels=1, digits=8)
    assert float(well.numeric[0].value) < -24


@pytest.mark.parametrize(
    ("V", "options"),
    [
        ("-1/x", {"domain": HALF, "boundary": "y'(0) = 0"}),
        ("x^2 - 3/(16*x^2)", {"domain": HALF, "boundary": "y(0) = 0"}),
        ("x^2", {"boundary": "y'(0) = 0"}),
        ("x^2", {"domain": HALF, "boundary": "y'(0) = 1"}),
        ("x^2", {"domain": HALF, "boundary": "y(0) + k*y'(0) = 0"}),
        ("-psi''/m + x^2*psi = E*psi", {"assume": {"m": "negative"}}),
    ],
)
def test_conditions_that_are_refused(V: str, options: Any) -> None:
    with pytest.raises(kovacic.InputError):
        kovacic.spectrum(V, **options)


def test_a_wave_function_may_be_asked_to_vanish_at_a_wall_that_rises_without_bound() -> None:
    """There one solution decays, and the condition chooses it, as it does without being given."""
    given, own = (kovacic.spectrum("x^2 + 1/x^4", domain=HALF, boundary=wish) for wish in ("y(0) = 0", None))
    assert given.complete == own.complete
    assert given.levels == own.levels


def test_functions_in_pieces_have_numeric_levels() -> None:
    """What is one function on the domain is that function; else the message says how levels are computed."""
    assert kovacic.spectrum("abs(x)^2", domain=HALF).levels == kovacic.spectrum("x^2", domain=HALF).levels
    for V in ("exp(abs(x))", "x^2 + abs(x)", "abs(x - a) + abs(x - b)"):
        with pytest.raises(kovacic.InputError, match="in pieces") as refused:
            kovacic.spectrum(V)
        assert "levels=5" in str(refused.value.hint)
        assert "--levels 5" in str(refused.value.shell)
    V = "Piecewise((-5, abs(x) < 1), (0, True))"
    wells = [kovacic.spectrum(V, levels=3, digits=6).numeric for V in ("-5*Heaviside(1 - x^2)", V)]
    assert [level.zeros for level in wells[0]] == [level.zeros for level in wells[1]] == [0, 1]
    for level, k in zip(
        wells[0], (1.0710, 2.0174), strict=True
    ):  # k tan(k) = kappa, -k cot(k) = kappa, k^2 + kappa^2 = 5
        assert abs(float(level.value) - (k**2 - 5)) < 2e-3


#: What SymPy doesn't translate for mpmath.
AIRY = {f"airy{kind}prime": partial(getattr(mpmath, f"airy{kind}"), derivative=1) for kind in ("ai", "bi")}
#: Potentials that are constant or linear on each piece: V, domain, boundary condition.
IN_PIECES = [
    ("Piecewise((-5, abs(x) < 1), (0, True))", LINE, None),
    ("abs(x)", LINE, None),
    ("x", HALF, None),
    ("x", HALF, "y'(0) + y(0) = 0"),
    ("3*x - 1", (1, "oo"), "y'(1) = 0"),
    ("Piecewise((2, x < -1), (-5, x < 1), (0, True))", LINE, None),
    ("Piecewise((0, abs(x) < 1), (-9, abs(x) < 2), (0, True))", LINE, None),
    ("Piecewise((x, x < 3), (3, True))", HALF, None),
    ("2*abs(x - 1) + abs(x + 2)", LINE, None),
    ("abs(x - sqrt(2))", LINE, None),
    ("10*Heaviside(x)", (-1, 2), None),
    ("-7*Heaviside(2 - abs(x - 1)) - x/2", (-2, 4), "y'(-2) = 0, y'(4) = 0"),
    ("abs(x)", (-1, 1), "y'(-1) = 0, y(1) = 0"),
    ("-3*DiracDelta(x - 1) - 3*DiracDelta(x + 1)", LINE, None),
    ("-2*DiracDelta(x) - DiracDelta(2*x - 2)", LINE, None),
    ("abs(x) - DiracDelta(x)", LINE, None),
    ("5*DiracDelta(x)", (-1, 1), None),
    ("-5*Heaviside(1 - abs(x)) + 3*DiracDelta(x)", LINE, None),
]


@parametrize(("V", "domain", "boundary"), IN_PIECES, ordinary=3, long=(1, 5, 9, 15))
def test_levels_in_pieces_solve_the_equations_of_matching(V: str, domain: Any, boundary: Any) -> None:
    """Each of the numeric levels is next to a sign change of one of the equations, those of even and odd zeros in turn."""
    found = kovacic.spectrum(V, domain=domain, boundary=boundary, levels=4, digits=10)
    assert len(found.matching) in (1, 2)
    assert found.numeric
    E = sympy.Symbol("E")
    for level in found.numeric:
        equation = found.matching[level.zeros % len(found.matching)]
        difference = sympy.lambdify(E, equation.lhs - equation.rhs, [AIRY, "mpmath"])
        left, right = (complex(difference(float(level.value) + step)) for step in (-1e-6, 1e-6))
        assert abs(left - right) > 1e-12
        assert (left / right).real < 0
        assert abs((left / right).imag) < 1e-6


def test_a_linear_potential_between_walls_is_matched_and_a_parabola_is_not() -> None:
    """u(0) = u(3) = 0 for a multiple of Ai(-E) Bi(x - E) - Bi(-E) Ai(x - E)."""
    E = sympy.Symbol("E")
    line, parabola = (kovacic.spectrum(V, domain=(0, 3)) for V in ("x", "x^2/3 + x"))
    [equation] = line.matching
    first, last = sympy.airyai(-E), sympy.airyai(3 - E)
    assert equation == sympy.Eq(first * sympy.airybi(3 - E) - last * sympy.airybi(-E), 0)
    assert parabola.matching == ()


def test_a_square_well_in_letters() -> None:
    positive = {"V0": "positive", "a": "positive"}
    found = kovacic.spectrum("Piecewise((-V0, abs(x) < a), (0, True))", assume=positive)
    assert "the even levels solve sqrt(E + V0)*tan(a*sqrt(E + V0)) = sqrt(-E)\n" in found.text()
    assert "the odd levels solve sqrt(E + V0)*cot(a*sqrt(E + V0)) = -sqrt(-E)\n" in found.text()
    assert found.to_dict()["matching"][0] == "sqrt(E + V0)*tan(a*sqrt(E + V0)) = sqrt(-E)"
    assert found.is_decided
    assert found.reason.startswith("implicit: the levels are roots of this equation")
    with pytest.raises(kovacic.NotRational, match="in pieces"):
        kovacic.spectrum("Piecewise((-V0, abs(x) < a), (0, True))")  # a may be negative


def test_a_delta_well_has_one_level() -> None:
    """-psi'' - c delta(x) psi = E psi: psi = exp(-c |x|/2), E = -c^2/4, norm^2 = 2/c, in any units; none where c < 0."""
    found = kovacic.spectrum("-hbar^2/(2*m)*psi'' - g*DiracDelta(x)*psi = E*psi", assume={"g": "positive"})
    assert found.complete
    assert [str(one.energy) for one in found.levels] == ["-g**2*m/(2*hbar**2)"]
    well = kovacic.spectrum("1 - 2*DiracDelta(x - 5)", levels=2)
    (state,) = well.states()
    assert (state.energy, state.zeros) == (0, 0)
    assert well.numeric.complete
    assert [level.value.contains(0) for level in well.numeric] == [True]
    assert well.levels[0].norm == sympy.integrate(sympy.exp(-2 * sympy.Abs(x)), (x, -sympy.oo, sympy.oo))
    assert kovacic.spectrum("2*DiracDelta(x)", levels=1).text().count("no eigenvalues") >= 1
    unknown = kovacic.spectrum("-c*DiracDelta(x)")
    assert [str(condition) for condition in unknown.levels[0].where] == ["c > 0"]
    assert len(unknown.states({"c": 3})) - len(unknown.states({"c": -3})) == 1


@parametrize(
    "written", ["-3 δ(x)", "-3*delta(x)", r"-3\delta(x)", "-3*dirac(x)", "-psi'' - 3 δ(x) psi = E psi"], ordinary=(1, 3)
)
def test_delta_functions_as_physicists_write_them(written: str) -> None:
    """Where it has an argument; as a letter it is a parameter."""
    assert kovacic.spectrum(written).levels == kovacic.spectrum("-3*DiracDelta(x)").levels
    assert kovacic.spectrum("δ*x^2").parameters == ("δ",)


def test_without_its_leading_term_a_potential_is_another_one() -> None:
    """a exp(-2 x) - 3 exp(-x) falls without bound to the left where a = 0: that isn't a value without levels."""
    found = kovacic.spectrum("a*exp(-2*x) - 3*exp(-x)")
    assert [*map(str, found.excluded)] == ["a < 0", "Eq(a, 0)"]
    assert "where a = 0: V is another potential" in found.text()
    with pytest.raises(kovacic.InputError, match="another potential"):
        found.states({"a": 0})
    assert kovacic.spectrum("a*exp(-2*x) - 3*exp(-x)", assume={"a": "positive"}).excluded == ()


def test_a_family_without_members_is_no_level() -> None:
    """n < sqrt(4 A + 1)/2 - 1/2 for no n where A < 0."""
    assert kovacic.spectrum("-A/cosh(x)^2", assume={"A": "negative"}).levels == ()
    assert kovacic.spectrum("-A/cosh(x)^2", assume={"A": "positive"}).levels


def test_a_level_where_the_search_begins() -> None:
    """E = -1 is the first number that is tried for a well that ends at 0."""
    assert kovacic.spectrum("-2/cosh(x)^2", levels=1, digits=8).numeric[0].value.contains(-1)


@parametrize(
    "V", ["6*tanh(x)^2 - tanh(x)^4", "-10/cosh(x)^2 + 4/cosh(x)^4", "-15/cosh(x)^2 + 8/cosh(x)^4"], ordinary=1, long=1
)
def test_no_level_of_manning_has_a_closed_form(V: str) -> None:
    """A confluent Heun equation, Liouvillian at most at E = V(oo) - (d + 1)^2 or its parts: those above min V are decided."""
    found = kovacic.spectrum(V)
    assert found.closed_forms_complete
    assert not found.algebraic
    assert "no eigenfunction has a closed form" in found.text()


@parametrize(
    ("V", "assume", "complete"),
    [
        ("-A/cosh(x)^2 + 4/cosh(x)^4", {}, False),
        ("-A/cosh(x)^2 + B/cosh(x)^4", {}, False),
        ("x^4 + a*x", {}, True),
        ("-A/cosh(x)^2 - B^2/cosh(x)^4", {"B": "positive"}, False),
    ],
    ordinary=(0,),
)
def test_letters_for_which_no_polynomial_of_any_degree_gives_a_level(V: str, assume: Any, complete: bool) -> None:
    """Manning's solutions exp(-(d + 1) x) P(exp(2 x)) grow at one end at least; exp(x^3/3) P(x) decays at one."""
    found = kovacic.spectrum(V, assume=assume)
    assert found.closed_forms_complete == complete
    assert "doesn't at the other, whatever its degree" in found.reason
    assert ("unless B = 0" in found.reason) == ("+ B/" in V)
    assert not found.hint
    assert not found.algebraic


def test_the_numbers_whose_energies_may_be_levels() -> None:
    """-(d + 1)^2 is above -30 for d <= 4; 2 d + 1 is in an upper half-line for all d."""
    E, d = sympy.symbols("E d")
    window = _Window(sympy.Integer(-30), sympy.Integer(0))
    last = window.last_number((d + 1) ** 2 + E, E, d)
    assert last is not None
    assert last >= 5
    assert window.last_number(E**2 - d, E, d) is None
    assert _Window(sympy.Integer(-30)).last_number(2 * d + 1 - E, E, d) is None


def test_states_of_a_family_that_is_solvable_for_some_values() -> None:
    found = kovacic.spectrum("g^2*x^6 - g*(4*k+3)*x^2", assume={"g": "positive"})
    root = 2 * sympy.sqrt(2)
    assert [(s.number, s.energy) for s in found.states({"g": 1, "k": 1})] == [(0, -root), (2, root)]
    assert [(s.number, s.energy) for s in found.states({"g": 2, "k": 1})] == [(0, -4), (2, 4)]
    assert found.states({"g": 1, "k": "1/3"}) == ()
    pole = kovacic.spectrum("a/x + b*x^2", domain=HALF, assume={"b": "positive"})
    assert [(s.number, s.energy) for s in pole.states({"a": 0, "b": 1})] == [(0, 3)]  # where E > 0
    assert pole.reason.startswith("levels, perhaps not all, with")  # a = 2, b = 1: E = 5


@parametrize(
    ("V", "domain"),
    [
        ("1/x + 2/x^2", HALF),
        ("x - x^2", HALF),  # whatever holds at 0
        ("3*sech(x)^2", ("-oo", "oo")),
        ("exp(2*x)", ("-oo", "oo")),
        ("x", ("-oo", "oo")),
        ("sin(x)", ("-oo", "oo")),
        ("a*cos(k*x + 1)", ("-oo", "oo")),
        ("cos(x)/(cos(x) + cos(2*x) + 3)", ("-oo", "oo")),
    ],
    ordinary=(1, 2, 5),
)
def test_no_eigenvalues(V: str, domain: tuple[object, object]) -> None:
    found = kovacic.spectrum(V, domain=domain)
    assert found.complete
    assert not found.levels


@parametrize(
    ("V", "domain"),
    [
        ("1/(a^2 + 1 + cos(x))", LINE),
        ("x^2 + 1/(x^2 + 5)", LINE),
        ("2/sin(x)^2", (0, "L")),
        ("exp(4*x) - sqrt(2)*exp(x)", LINE),
        ("4/cosh(x)^4 - sqrt(2)/cosh(x)^2", LINE),
        ("1/cos(x) + 6/cos(x)^2", ("-pi/2", "pi/2")),  # in exp(i x)
        ("1/x^4 - h/x^3", HALF),  # sqrt(-E) stands in the conditions
    ],
    ordinary=(0, 2, 3, 6),
    long=(1, 4),
)
def test_what_is_not_covered_is_undecided(V: str, domain: tuple[object, object]) -> None:
    """Where the poles are isn't known, and whether E = 2 d + 1 has a closed form is known for each d alone."""
    found = kovacic.spectrum(V, domain=domain, max_degree=0)
    assert not found.is_decided
    assert not found.levels
    assert found.reason.startswith("undecided: ")


@parametrize(
    ("V", "domain"),
    [
        ("x^4 + a*x^2", ("-oo", "oo")),
        ("x^4 + x^3", ("-oo", "oo")),
        ("x^6 + 7*x^2", ("-oo", "oo")),
        ("cosh(x)", ("-oo", "oo")),
        ("x", HALF),
    ],
    ordinary=1,
)
def test_no_wave_function_is_liouvillian(V: str, domain: tuple[object, object]) -> None:
    """The conditions on E say so; for x^6 + 7 x^2 there are two that aren't real."""
    found = kovacic.spectrum(V, domain=domain, boundary="friedrichs")
    assert found.is_decided
    assert found.closed_forms_complete
    assert not found.complete
    assert not found.levels
    assert not found.algebraic
    assert "no eigenfunction has a closed form" in found.text()


@parametrize("d", [1, 0, *range(2, 7)], ordinary=1, long=1)
def test_all_levels_of_a_sextic_potential_that_are_liouvillian(d: int) -> None:
    """x^6 + 2 a x^4 + (a^2 - 2 d - 3) x^2 has d // 2 + 1 of them, with polynomials of degree d, which the exponents tell."""
    V = f"x^6 + 2*x^4 - {2 * d + 2}*x^2"
    found = kovacic.spectrum(V, max_degree=d)
    assert found.closed_forms_complete
    assert [state.number for state in found.states()] == list(range(d % 2, d + 1, 2))
    assert kovacic.spectrum(V, max_degree=0).states() == found.states()


@parametrize(
    ("V", "domain"),
    [
        ("exp(-2*x) - 9*exp(-x)", HALF),
        ("x^2", (1, "oo")),
        ("-6*sech(x)^2", (1, "oo")),
        ("-1/x", (1, "oo")),
        ("2/x^2", (0, "L")),
        ("1/x", (0, 3)),
    ],
    ordinary=(3,),
    long=2,
)
def test_an_end_at_an_ordinary_point_is_undecided(V: str, domain: tuple[object, object]) -> None:
    """The condition there is transcendental in E."""
    found = kovacic.spectrum(V, domain=domain, boundary="friedrichs")
    assert not found.complete
    assert not found.levels
    assert not found.algebraic
    assert "an ordinary point; a formula is known where" in found.reason


@pytest.mark.parametrize(
    ("V", "options"),
    [
        ("1/x^2 + x^2", {}),
        ("x^2 - E", {}),
        ("I*x^2", {}),
        ("5", {"energy": "x"}),
        ("-2*DiracDelta(x)", {"domain": (0, "oo")}),
        ("-2*DiracDelta(x)*Heaviside(x)", {"levels": 2}),
        ("x^2", {"domain": (1, 0)}),
        ("x^2", {"domain": (0, "E")}),
        ("x^2", {"boundary": "neumann"}),
        ("x^2", {"domain": "0"}),
        ("x^2", {"domain": (0, "oo"), "boundary": "y(0) = 0, y'(0) = 0"}),
        ("a*x^2", {"assume": {"b": "positive"}}),
    ],
)
def test_wrong_questions(V: str, options: dict[str, object]) -> None:
    with pytest.raises(kovacic.InputError):
        kovacic.spectrum(V, **options)  # type: ignore[arg-type]


@pytest.mark.long
def test_names_of_parameters_and_variables_are_free() -> None:
    """Letters that the program uses itself: z, s, t, w, n, rho."""
    plain = kovacic.spectrum("l*(l+1)/x^2 - Z/x", domain=HALF, assume={"l": ">=1", "Z": "positive"}).levels[0]
    for L, Z, r in (("n", "z", "t"), ("u", "E", "z")):
        found = kovacic.spectrum(
            f"{L}*({L}+1)/{r}^2 - {Z}/{r}", domain=HALF, var=r, energy="K", assume={L: ">=1", Z: "positive"}
        ).levels[0]
        names = {sympy.Symbol(a): sympy.Symbol(b) for a, b in (("l", L), ("Z", Z), ("x", r), ("n", str(found.number)))}
        assert sympy.simplify(found.energy - plain.energy.subs(names, simultaneous=True)) == 0
        assert sympy.simplify(found.wave - plain.wave.subs(names, simultaneous=True)) == 0


@pytest.mark.long
def test_a_sympy_expression_and_values() -> None:
    b = sympy.Symbol("b", positive=True)
    found = kovacic.spectrum(sympy.exp(-2 * x) - 2 * b * sympy.exp(-x))
    assert found.potential.free_symbols == {x, sympy.Symbol("b")}
    assert [state.energy for state in found.states({"b": 3})] == [sympy.Rational(k, 4) for k in (-25, -9, -1)]
    at = kovacic.spectrum("exp(-2*x) - 2*b*exp(-x)", assume={"b": 3})
    assert at.states() == found.states({"b": 3})


def test_a_value_of_an_end_is_put_into_it() -> None:
    box = kovacic.spectrum("0", domain=(0, "L"), assume={"L": 2}, boundary="y'(2) = 0")
    assert box.domain == (0, 2)
    assert box.states(count=1)[0].energy == (sympy.pi / 4) ** 2


def test_a_potential_without_formulas_names_its_variable() -> None:
    found = kovacic.spectrum("-4*exp(-r^2)", levels=1, digits=6)
    assert found.variable == "r"
    assert "r is taken for the variable" in found.text()
    assert abs(float(found.numeric[0].value) + 2.3754390) < 1e-5


def test_what_symbols_assume_is_known() -> None:
    """Of SymPy's symbols, as of the assumptions."""
    k = sympy.Symbol("k", positive=True)
    (levels,) = kovacic.spectrum(k * x**2).levels
    assert levels.conditions == ()
    assert kovacic.spectrum("k*x^2").levels[0].conditions != ()
    assert kovacic.spectrum(sympy.Abs(x) * k, domain=HALF).matching


def test_pi_is_a_number() -> None:
    found = kovacic.spectrum("pi*x^2")
    assert found.parameters == ()
    assert found.levels[0].conditions == ()
    assert sympy.expand(found.levels[0].energy - (2 * n + 1) * sympy.sqrt(sympy.pi)) == 0


@pytest.mark.long
def test_a_root_that_may_vanish_is_positive() -> None:
    found = kovacic.spectrum("A*x^2 + B/x^2", domain=HALF, boundary="friedrichs")
    assert [*map(str, found.levels[0].conditions)] == ["A > 0", "B >= -1/4"]


@pytest.mark.long
def test_friedrichs_condition_is_taken_as_far_as_solutions_do_not_oscillate() -> None:
    """Both are square integrable for B < 3/4, and for B < -1/4 none of them is the smaller one."""
    for boundary in (None, "friedrichs"):
        found = kovacic.spectrum("x^2 + B/x^2", domain=HALF, boundary=boundary)
        assert found.boundary == "friedrichs"
        assert [*map(str, found.levels[0].conditions)] == ["B >= -1/4"]
        assert [*map(str, found.excluded)] == ["B < -1/4"]
        with pytest.raises(kovacic.InputError, match="square integrable"):
            found.states({"B": -1})


@pytest.mark.long
def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = [
        "spectrum",
        "l*(l+1)/x^2 - Z/x",
        "--from",
        "0",
        "--to",
        "oo",
        "--assume",
        "l>=1",
        "--assume",
        "Z=positive",
    ]
    assert run(arguments) == 0
    assert "E_n = -Z^2/(4*(l + n + 1)^2), n = 0, 1, 2, ..." in capsys.readouterr().out
    assert run([*arguments, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["complete"] is True
    assert run([*arguments, "--latex"]) == 0
    assert r"\begin{aligned}" in capsys.readouterr().out
    assert run(["spectrum", "x^2 + 1/(x^2 + 5)"]) == 3


@pytest.mark.long
def test_a_box_has_the_levels_of_its_waves() -> None:
    """V = c between walls at a and b: y(b) = 0, n zeros inside, and the norm; none beside an infinite end."""
    found = kovacic.spectrum("c", domain=("a", "b"), boundary="friedrichs")
    a, b, c = sympy.symbols("a b c")
    (levels,) = found.levels
    assert found.complete
    assert sympy.simplify(levels.energy - c - (sympy.pi * (n + 1) / (b - a)) ** 2) == 0
    at = {a: 1, b: sympy.Rational(7, 2), c: -3}
    for state in found.states(at, count=2):
        assert state.wave.subs(x, 1) == 0
        assert state.wave.subs(x, sympy.Rational(7, 2)) == 0
        assert sympy.simplify(-sympy.diff(state.wave, x, 2) - (state.energy + 3) * state.wave) == 0
        assert sympy.integrate(state.wave**2, (x, 1, sympy.Rational(7, 2))) == levels.norm.subs(at)
        assert state.zeros == state.number
    half = kovacic.spectrum("c", domain=HALF, boundary="friedrichs")
    assert half.complete
    assert half.levels == ()


@parametrize("V", ["(x^8 + a*x^3 + b)/(x^6 + c^2 + 1)", "x^30 + x^2/(x^20 + 1)", "x^2/(x^4 + x^2 + 1) + a"], ordinary=1)
def test_a_denominator_without_real_zeros_is_no_pole(V: str) -> None:
    """Whether its roots are real isn't seen by their radicals."""
    assert "isn't regular" not in kovacic.spectrum(V, max_degree=0).reason


def test_poles_of_which_it_isnt_known_whether_they_are_real() -> None:
    assert "couldn't be determined whether V has a pole" in kovacic.spectrum("1/(x^2 - c)").reason
    with pytest.raises(kovacic.InputError, match=r"isn't regular at x = -?sqrt"):
        kovacic.spectrum("1/(x^2 - c)", assume={"c": "positive"})


@parametrize(
    ("V", "pole", "shell"),
    [
        ("tan(x)^2", "pi/2", '--from "-pi/2" --to "pi/2"'),
        ("1/cos(x)^2", "pi/2", '--from "-pi/2" --to "pi/2"'),
        ("2*cot(x)^2", "pi", '--from 0 --to "pi"'),
        ("1/(1 + 2*cos(x))", "2*pi/3", '--from "-2*pi/3" --to "2*pi/3"'),
        ("1/(1 + sin(x) + cos(x))", "pi", '--from "-pi/2" --to "pi"'),
        ("tan(a*x)^2", "pi/(2*a)", '--from "-pi/(2*a)" --to "pi/(2*a)"'),
    ],
    ordinary=1,
    long=(1, 2),
)
def test_a_periodic_potential_on_the_line_has_no_poles(V: str, pole: str, shell: str) -> None:
    with pytest.raises(kovacic.InputError) as refused:
        kovacic.spectrum(V)
    assert f"one at x = {pole} and" in str(refused.value)
    assert refused.value.for_shell().endswith(shell)
    with pytest.raises(kovacic.InputError, match="has poles on the line"):
        kovacic.spectrum(V, domain=(1, "oo"))


@pytest.mark.long
def test_levels_of_a_periodic_potential_on_a_half_line_are_open() -> None:
    found = kovacic.spectrum("cos(x)", domain=HALF)
    assert found.boundary == "friedrichs"
    assert not found.complete
    assert found.closed_forms_complete  # Mathieu's equation has no Liouvillian solution
    assert "V is periodic" in found.ends[1]


@pytest.mark.long
def test_the_only_name_is_the_variable_where_it_usually_is_one() -> None:
    in_r = kovacic.spectrum("-2/r", domain=HALF, boundary="friedrichs")
    in_x = kovacic.spectrum("-2/x", domain=HALF, boundary="friedrichs")
    assert in_r.variable == "r"
    assert in_r.levels[0].energy == in_x.levels[0].energy
    assert in_r.text().splitlines()[1] == "  note: r is taken for the variable, of which V is a function"
    constant = kovacic.spectrum("c")
    assert (constant.variable, constant.parameters) == ("x", ("c",))
    radial = kovacic.spectrum("l*(l+1)/r^2 - 2*Z/r", domain=HALF, assume={"l": ">=1", "Z": "positive"})
    assert (radial.variable, {*radial.parameters}) == ("r", {"l", "Z"})
    assert "r is taken for the variable" in radial.text()
    with pytest.raises(kovacic.InputError, match=r"which of .* is the variable\?"):
        kovacic.spectrum("a*b/c^2")


def test_hints_speak_the_language_of_the_door(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(kovacic.InputError) as refused:
        kovacic.spectrum("-2/x + l*(l+1)/x^2")
    assert refused.value.hint == 'choose a domain without a pole inside: domain=(0, "oo")'
    assert refused.value.shell == "choose a domain without a pole inside: --from 0"
    higher = kovacic.spectrum("x^6 - (4*k + 3)*x^2", max_degree=0)
    assert higher.hint.endswith("a polynomial of degree 1: max_degree=1")
    assert higher.hint in higher.text()
    assert run(["spectrum", "x^6 - (4*k + 3)*x^2", "--max-degree", "0"]) in (0, 3)
    assert "--max-degree" in capsys.readouterr().out


@pytest.mark.long
def test_a_higher_degree_is_proposed_where_a_polynomial_may_have_one() -> None:
    """Where the conditions name finitely many energies, their levels are found without being told a degree."""
    found = kovacic.spectrum("x^6 - 11*x^2")
    assert [(state.number, state.energy) for state in found.states()] == [(0, -8), (2, 0), (4, 8)]
    assert found.closed_forms_complete
    assert not found.hint
    cubic = kovacic.spectrum("x^6 + 4*x^4 - 7*x^2").text()
    assert "E ~ -0.136280786891: 0 zeros" in cubic
    assert "RootOf" not in cubic


@parametrize(
    ("V", "domain"),
    [("5/(1 - cos(x))", (0, "2*pi")), ("5/(1 - sin(x))", ("pi/2", "5*pi/2")), ("5/(1 - cos(x))", ("-2*pi", 0))],
    ordinary=1,
    long=1,
)
def test_a_shifted_potential_has_the_same_levels(V: str, domain: Any) -> None:
    """The middle of the domain is where t turns, once: at pi, which is -pi + 2 pi as well."""
    found = kovacic.spectrum(V, domain=domain)
    assert found.complete
    states = found.states(count=2)
    assert len(states) >= 2
    for state in states:
        there = (2 * state.number + 1 + sympy.sqrt(41)) ** 2 / 16  # of 5/(1 + cos(x)) between -pi and pi
        assert sympy.expand(state.energy - there) == 0


@pytest.mark.long
def test_equal_strengths_are_in_the_same_variable_as_one_function() -> None:
    """1/sin(x)^2 + 1/cos(x)^2 = 4/sin(2 x)^2, with the same levels (1 + sqrt(5) + 2 n)^2."""
    both = kovacic.spectrum("1/sin(x)^2 + 1/cos(x)^2", domain=(0, "pi/2"))
    one = kovacic.spectrum("4/sin(2*x)^2", domain=(0, "pi/2"))
    assert both.complete
    assert one.complete
    assert both.levels[0].energy == one.levels[0].energy == (2 * sympy.Symbol("n") + 1 + sympy.sqrt(5)) ** 2


@pytest.mark.long
def test_a_formula_that_holds_for_no_n_is_left_out() -> None:
    """A step, Woods and Saxon's potential on the line, has no bound states."""
    step = kovacic.spectrum("-20/(1 + exp(x))")
    assert step.complete
    assert step.levels == ()


def test_states_are_numbered_by_their_zeros() -> None:
    """The exceptional oscillator of degree 2: its ground state -3 w, and (2 n + 3) w with n + 1 zeros."""
    found = kovacic.spectrum("w^2*x^2 + 8*w*(2*w*x^2-1)/(2*w*x^2+1)^2", assume={"w": "positive"})
    assert "Derivative" not in found.text()
    states = found.states({"w": 2}, count=3)
    assert [(state.number, state.energy) for state in states] == [(0, -6), (1, 6), (2, 10), (3, 14)]
    V = found.potential.subs("w", 2)
    for state in states:
        residual = sympy.diff(state.wave, x, 2) - (V - state.energy) * state.wave
        assert size(residual.subs(x, sympy.Rational(7, 10)), 30) < 1e-15


@parametrize("order", ["1/4", "0", "-1/4", "1/2", "1", "2"], ordinary=1, long=2)
def test_exceptional_levels_where_both_solutions_are_square_integrable(order: str) -> None:
    """X_1 of Laguerre: 4 n + 2 l + 3 with the smaller solution at 0, whether y0 or 1/y0 is the smaller one there."""
    s, half = sympy.Rational(order), sympy.Rational(1, 2)
    x = sympy.Symbol("x")
    found = kovacic.spectrum(
        x**2 + s * (s + 1) / x**2 + 4 * (x**2 - s - half) / (x**2 + s + half) ** 2, domain=(0, "oo")
    )
    assert found.complete
    states = found.states({}, count=3)
    assert [state.energy for state in states] == [4 * n + 2 * s + 3 for n in range(3)]
    assert all(sympy.limit(state.wave / x**s, x, 0, "+") == 0 for state in states)


@parametrize(
    ("V", "domain", "energies"),
    [
        ("sqrt(2)*x^2 - sqrt(3)*x", ("-oo", "oo"), "2^(1/4)*(2*n + 1) - 3*sqrt(2)/8"),
        ("x^2 + sqrt(1 + sqrt(2))*x", ("-oo", "oo"), "2*n + 1 - (1 + sqrt(2))/4"),
        ("sqrt(7)/x^2 - sqrt(5)/x", (0, "oo"), "-5/(2*n + 1 + sqrt(1 + 4*sqrt(7)))^2"),
        ("sqrt(a)*x^2", ("-oo", "oo"), "sqrt(sqrt(a))*(2*n + 1)"),
    ],
    ordinary=1,
    long=2,
)
def test_answers_are_in_the_roots_of_the_user(V: str, domain: tuple[object, object], energies: str) -> None:
    """Not in a generator of the field of all roots, nor in a letter for one of them."""
    assume = {"a": "positive"} if "a" in V.replace("sqrt", "") else None
    answer = kovacic.spectrum(V, domain=domain, assume=assume, var="x")
    assert answer.complete
    (levels,) = answer.levels
    assert levels.conditions == ()
    assert sympy.simplify(levels.energy - read_expression(energies)) == 0
    assert {symbol.name for symbol in levels.wave.free_symbols} <= {"x", "n", "a"}
    assert "root_" not in str(answer)
    assert "alpha" not in str(answer)


@pytest.mark.slow
def test_energies_are_written_without_the_imaginary_unit() -> None:
    """Rosen and Morse's trigonometric potential, whose exponents are conjugate: with A (A - 1) = 5 and B = -3/2."""
    (levels,) = kovacic.spectrum("5*cot(x)^2 - 3*cot(x)", domain=(0, "pi")).levels
    assert not levels.energy.has(sympy.I)
    A = (1 + sympy.sqrt(21)) / 2
    n = levels.number
    printed = (A + n) ** 2 - sympy.Rational(9, 4) / (A + n) ** 2 - 5
    assert sympy.simplify(levels.energy - printed) == 0


def test_the_conditions_of_one_family_may_have_no_value_where_those_of_another_hold() -> None:
    """-Z/(l - n) > 0 for l = n = 0, where l >= -1/2 holds."""
    coulomb = kovacic.spectrum("l*(l+1)/x^2 - Z/x", domain=HALF)
    assert [s.energy for s in coulomb.states({"l": 0, "Z": 1}, count=2)] == [
        -sympy.Rational(1, 4),
        -sympy.Rational(1, 16),
    ]
    assert coulomb.states({"l": 0, "Z": 0}) == ()


@pytest.mark.long
def test_the_sign_of_a_quotient_is_that_of_its_denominator() -> None:
    """The Coulomb potential without a condition on l: l + n + 1 > 0, not 1/(l + n + 1) > 0, and that follows from l >= -1/2."""
    answer = kovacic.spectrum("l*(l+1)/x^2 - Z/x", domain=(0, "oo"), assume={"Z": "positive"})
    l = sympy.Symbol("l")  # noqa: E741
    half = sympy.Rational(1, 2)
    assert [levels.conditions for levels in answer.levels] == [(l >= -half,), (l <= -half,)]


@parametrize(
    ("V", "domain", "known"),
    [
        ("sqrt(x)", HALF, True),
        ("sqrt(x)", (1, 4), True),
        ("x^(-3/2)", HALF, True),
        ("1/sqrt(x)", HALF, False),
        ("x^(1/3)", ("-1", "oo"), None),
        ("sqrt(x)", ("-oo", "oo"), None),
        ("x^(3/2)", ("-oo", 2), None),
        ("1/sqrt(x)", ("a", "oo"), None),
    ],
    ordinary=4,
)
def test_potentials_in_roots_of_x(V: str, domain: tuple[str | int, str | int], known: bool | None) -> None:
    """No levels are known, but whether a closed form can be; a root has one meaning on one side of its branch point only."""
    if known is None:
        with pytest.raises(kovacic.InputError, match="branch point at x = 0"):
            kovacic.spectrum(V, domain=domain)
    else:
        assert kovacic.spectrum(V, domain=domain).closed_forms_complete is known


@pytest.mark.long
def test_powers_of_numbers_are_exponentials() -> None:
    """b^x = exp(x log(b)): Morse's potential, whose levels are E_n = -(10 - (n + 1/2) |log(b)|)^2."""
    for base, rate in (("2", sympy.log(2)), ("(1/3)", -sympy.log(3))):
        found = kovacic.spectrum(f"{base}^(2*x) - 20*{base}^x")
        assert found.complete
        (levels,) = found.levels
        expected = -((10 - (n + sympy.Rational(1, 2)) * abs(rate)) ** 2)
        assert sympy.simplify(levels.energy - expected) == 0


@parametrize("nu", ["0", "1/4", "1/3", "1/2", "3/4", "1", "2"], ordinary=2, long=2)
@parametrize(("base", "domain"), [("x", HALF), ("(x - 3)", (3, "oo")), ("(2 - x)", ("-oo", 2))], ordinary=1, long=1)
def test_two_solutions_at_an_end(nu: str, base: str, domain: tuple[object, object]) -> None:
    """They are sqrt(x) and sqrt(x)*log(x) where the exponents agree, real inside the domain, and solve the equation there."""
    found = kovacic.spectrum(f"(({nu})^2 - 1/4)/{base}^2 + {base}^2", domain=domain, boundary="friedrichs")
    (sentence,) = (end for end in found.ends if "y ~ " in end)
    first, second = (
        read_expression(text)
        for text in sentence.partition("y ~ ")[2].rpartition(", ")[0].partition(",")[0].split(" or ")
    )
    strength = read_expression(f"(({nu})^2 - 1/4)/{base}^2")
    inside = sympy.Rational(5, 2) if domain == HALF else 4 if domain[0] == 3 else -1
    for y in (first, second):
        assert sympy.simplify(sympy.diff(y, x, 2) - strength * y) == 0
        assert y.subs(x, inside).is_real
    assert sympy.simplify(first / second).has(x)


@parametrize(
    ("kind", "degrees"),
    [
        ("noninteger", (1,)),
        ("nonnegative integer", (0, 2)),
        ("half-integer", (1,)),
        ("even", (0,)),
        ("odd", (2,)),
        ("irrational", ()),
        (">=1/2", (1, 2)),
        ("integer", (0, 2)),
    ],
    ordinary=1,
    long=(1, 3),
)
def test_levels_by_degree_are_those_that_the_assumptions_admit(kind: str, degrees: tuple[int, ...]) -> None:
    """V has levels with a polynomial of degree d for m = d/2."""
    found = kovacic.spectrum("x^6 + 2*a*x^4 + (a^2 - 4*m - 3)*x^2", assume={"m": kind})
    assert tuple(one.degree for one in found.algebraic) == degrees


@parametrize("row", [row for row in TABLE + MORE if row.name not in LONG], ordinary=1, long=1, ids=lambda row: row.name)
def test_a_norm_has_each_number_once(row: Solvable) -> None:
    """Not 2^A*2^n/2^(3*n), and no quotient of Gamma functions that differ by an integer: gamma(n + 1)/factorial(n)."""
    for levels in spectrum_of(row).levels:
        if levels.norm is None:
            continue
        factors = [part.as_base_exp() for part in sympy.Mul.make_args(levels.norm)]
        numbers = [base for base, exponent in factors if base.is_number and exponent.free_symbols]
        assert len(numbers) == len({*numbers})
        gammas = [base.args[0] for base, _ in factors if base.func == sympy.gamma]
        gammas += [base.args[0] + 1 for base, _ in factors if base.func == sympy.factorial]
        assert not any((a - b).is_Integer for k, a in enumerate(gammas) for b in gammas[:k])


@pytest.mark.parametrize("boundary", ["friedrichs", None])
def test_where_no_condition_is_distinguished_none_is_proposed(boundary: str | None) -> None:
    found = kovacic.spectrum("-1/x^2", domain=HALF, boundary=boundary)
    with pytest.raises(kovacic.InputError) as refused:
        found.states()
    assert "friedrichs" not in str(refused.value)


@parametrize("V", ["sqrt(a)*x^2", "x^2/sqrt(a)", "sqrt(a)*x^2 + a*x", "a^(1/4)*x^2"], ordinary=2)
@pytest.mark.parametrize("word", ["negative", "<=-1"])
def test_a_parameter_under_a_root_is_not_negative(V: str, word: str) -> None:
    with pytest.raises(kovacic.InputError, match=r"the potential isn't real"):
        kovacic.spectrum(V, assume={"a": word})


@parametrize("word", ["positive", "> 0", "nonnegative", "integer", "real", ">=1"], ordinary=3)
def test_what_is_assumed_of_a_parameter_under_a_root(word: str) -> None:
    found = kovacic.spectrum("sqrt(a)*x^2", assume={"a": word})
    assert bool(found.levels[0].conditions) == (word in ("nonnegative", "integer", "real"))
    with pytest.raises(kovacic.InputError, match="contradicts the assumption"):
        found.states({"a": -1})


@parametrize(("factor", "value"), [("exp(b)", "3"), ("log(b)", "3"), ("b^(1/3)", "8")], ordinary=1)
def test_a_parameter_may_occur_in_a_function_alone(factor: str, value: str) -> None:
    found = kovacic.spectrum(f"{factor}*x^2", assume={"b": ">=2"})
    assert found.levels[0].conditions == ()
    (state,) = found.states({"b": value}, count=1)
    assert sympy.simplify(state.energy**2 - sympy.sympify(factor.replace("b", value))) == 0


#: Equations as physicists write them, what is assumed, the energies as a function of n, and values of the letters.
PHYSICAL = [
    ("-hbar^2/(2*m)*psi'' + m*w^2*x^2/2*psi = E*psi", LINE, {"w": "positive"}, "hbar*w*(n + 1/2)"),
    (
        r"-\frac{\hbar^2}{2m}\psi''(x) + \frac12 m\omega^2 x^2\psi(x) = E\psi(x)",
        LINE,
        {"omega": "positive"},
        "hbar*omega*(n + 1/2)",
    ),
    ("-hbar^2/(2*m)*psi'' = E*psi", (0, "L"), {"L": "positive"}, "hbar^2*pi^2*(n + 1)^2/(2*m*L^2)"),
    (
        "-hbar^2/(2*m)*psi'' + D*(1 - exp(-a*x))^2*psi = E*psi",
        LINE,
        {"D": "positive", "a": "positive"},
        "hbar*a*sqrt(2*D/m)*(n + 1/2) - (hbar*a*(n + 1/2))^2/(2*m)",
    ),
    ("-1/2*u'' + l*(l+1)/(2*x^2)*u - Z/x*u = E*u", HALF, {"l": ">=1", "Z": "positive"}, "-Z^2/(2*(n + l + 1)^2)"),
]


@parametrize(("equation", "domain", "assume", "energy"), PHYSICAL, ordinary=(2,))
def test_equations_as_physicists_write_them(equation: str, domain: Any, assume: Any, energy: str) -> None:
    found = kovacic.spectrum(equation, domain=domain, assume=assume)
    assert found.complete
    (levels,) = found.levels
    wanted = read_expression(energy)
    values = {symbol: sympy.Rational(k + 3, 2) for k, symbol in enumerate(sorted(wanted.free_symbols, key=str))}
    assert size((levels.energy - wanted).subs(values)) < 1e-15


@parametrize("factor", ["exp(-a*x)*exp(a*b)", "exp(-a*(x - b))"], ordinary=1)
def test_a_shift_beside_a_kinetic_factor(factor: str) -> None:
    """exp(a*b) is positive, where it is a factor too: no condition is needed."""
    morse = f"-hbar^2/(2*m)*psi'' + D*(1 - {factor})^2*psi = E*psi"
    (levels,) = kovacic.spectrum(morse, assume={"D": "positive", "a": "positive"}).levels
    assert levels.where == ()
    at = {"hbar": 1, "m": 1, "D": 8, "a": 1, "b": 5, "n": 1}
    assert levels.energy.subs(at) == 4 * sympy.Rational(3, 2) - sympy.Rational(9, 8)


def test_the_kinetic_factor_of_closed_forms() -> None:
    found = kovacic.spectrum("-1/2*psi'' + (x^6 - 7*x^2)/2*psi = E*psi")
    assert [state.energy for state in found.states()] == [-sympy.sqrt(2), sympy.sqrt(2)]
    assert found.text().startswith("-1/2 y'' + V y = E y, V = x^6/2 - 7*x^2/2")
    assert kovacic.spectrum("V(r) = r^2").variable == "r"
    fall = kovacic.spectrum("-hbar^2/(2*m)*psi'' + m*g*x*psi = E*psi", domain=HALF, assume={"g": "positive"})
    assert "(x - E/(m*g))^3" in fall.reason  # the energy is the user's


@pytest.mark.parametrize(
    ("equation", "said"),
    [
        ("psi'' + x*psi' = E*psi", "without a first derivative"),
        ("-psi'' + x*psi = 0", "the equation has no energy E"),
        ("-psi'' + x*psi = E^2*psi", "the equation has no energy E"),
        ("-x*psi'' + psi = E*psi", "the factor of psi'' over that of E, x, isn't a positive constant"),
        ("3*psi'' + psi = 2*E*psi", "the factor of psi'' over that of E, -3/2, isn't a positive constant"),
        ("psi'' + psi = E*psi + 1", "without a first derivative"),
    ],
)
def test_other_equations_are_refused(equation: str, said: str) -> None:
    with pytest.raises(kovacic.InputError, match=said):
        kovacic.spectrum(equation)


@parametrize(("V", "numbers"), [("-6/cosh(x)^2", (0, 1)), ("x^2", None), ("-1/8/cosh(x)^2", (0,))], ordinary=2)
def test_the_numbers_of_finitely_many_levels_are_listed(V: str, numbers: Any) -> None:
    found = kovacic.spectrum(V)
    assert found.levels[0].members == numbers
    if numbers:
        assert f"n = {', '.join(map(str, numbers))}\n" in found.text()
        assert rf"n = {', '.join(map(str, numbers))} \\" in found.latex()


@parametrize(
    ("V", "options", "values"),
    [
        ("x^2", {}, None),
        ("10*(exp(-2*x) - 2*exp(-x))", {}, None),
        ("l*(l+1)/x^2 - Z/x", {"domain": HALF, "assume": {"l": ">=1", "Z": "positive"}}, {"l": 1, "Z": 2}),
        ("0", {"domain": (0, 1)}, None),
        ("x^6 - 15*x^2", {}, None),
        ("2/x^2 - 4/x^3 + 1/x^4", {"domain": HALF}, None),
        ("3/sin(x)^2", {"domain": (0, "pi")}, None),
    ],
    ordinary=0,
    long=2,
)
def test_pictures_show_each_level_at_its_height(V: str, options: Any, values: Any) -> None:
    """What the legend names is drawn: the potential, and for each energy a multiple of its wave function above it."""
    found = kovacic.spectrum(V, **options)
    axes = found.plot(values, count=3).axes[0]
    states = found.states(values, count=3)[:3]
    curves = {line.get_label(): line.get_xydata() for line in axes.lines if not line.get_label().startswith("_")}
    x = sympy.Symbol("x")
    at = {sympy.Symbol(name): value for name, value in (values or {}).items()}
    assert len(curves) == len(states) + 1
    for state in states:
        (drawn,) = (data for label, data in curves.items() if label.startswith(f"E_{state.number} ="))
        points = drawn[100::200]
        wanted = [float(sympy.re(state.wave.subs(x, a))) for a, _ in points]
        heights = [b - float(state.energy) for _, b in points]
        largest = max(range(len(points)), key=lambda k: abs(wanted[k]))
        scale = heights[largest] / wanted[largest]
        assert all(abs(h - scale * w) < 1e-9 * abs(heights[largest]) for h, w in zip(heights, wanted, strict=True))
    for a, b in curves["V(x)"][100::200]:
        assert abs(b - float(found.potential.subs(at).subs(x, a))) < 1e-9 * (1 + abs(b))


def test_an_impulse_is_an_arrow_and_the_legend_hides_nothing() -> None:
    """Upwards for a positive strength, at the place of the impulse; -3 delta(2 x - 1) is -(3/2) delta(x - 1/2)."""
    for V, place, sign in (("-3*DiracDelta(2*x - 1)", 0.5, -1), ("x^2 + DiracDelta(x)", 0, 1)):
        figure = kovacic.spectrum(V, levels=1).plot()
        (arrow,) = figure.axes[0].texts
        assert arrow.xyann[0] == arrow.xy[0] == place
        assert (arrow.xy[1] > arrow.xyann[1]) is (sign > 0)
        assert figure.axes[0].get_legend() is None
        assert len(figure.legends) == 1
    with pytest.raises(kovacic.InputError, match="hint: levels=5 encloses the lowest ones"):
        kovacic.spectrum("abs(x)").plot()


@pytest.mark.parametrize("c", [1, 100])
def test_a_long_tail_does_not_hide_the_well(c: int) -> None:
    """y = exp(-1/x)/x falls as 1/x; V has its minimum between 1/4 and 1/2, its maximum at 2; c^2 V(c x) the same over c."""
    axes = kovacic.spectrum(f"2/x^2 - 4/({c}*x^3) + 1/({c}^2*x^4)", domain=HALF).plot().axes[0]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    assert 0 <= left < 0.1 / c
    assert 4 / c < right < 20 / c
    assert bottom < -11 * c**2
    assert 0.1 * c**2 < top < 10 * c**2


def test_numeric_waves_go_on_beyond_the_cut() -> None:
    """Outside of a well in pieces the potential is constant, and solutions are cut next to it: there y = exp(-kappa |x|)."""
    well = kovacic.spectrum("-5*Heaviside(1 - x^2)", levels=1, digits=8).numeric
    y = well.wave(0)
    kappa = (-float(well[0].value)) ** 0.5
    for side in (-1, 1):
        assert abs(y(2 * side) / y(side) - exp(-kappa)) < 1e-3


def test_the_command_draws_the_levels(tmp_path: Any) -> None:
    assert run(["spectrum", "x^2", "--plot", str(tmp_path / "levels.png")]) == 0
    assert (tmp_path / "levels.png").read_bytes()[1:4] == b"PNG"
    with pytest.raises(kovacic.InputError, match="no level is known"):
        kovacic.spectrum("x^4").plot()


@parametrize(
    ("V", "said"),
    [
        ("ax^2", "note: ax was read as a*x"),
        ("V(x) = ax^2", "note: ax was read as a*x"),
        ("-1/2 psi'' + ax^2 psi = E psi", "note: ax was read as a*x"),
        ("2/r^2 - 1/r", "note: r is taken for the variable, of which V is a function"),
        ("-hbar^2/(2m) psi'' + x^2 psi = E psi", "note: hbar and m taken as positive"),
    ],
    ordinary=(1,),
    long=2,
)
def test_the_command_says_what_was_guessed(V: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    run(["spectrum", V, "--from", "0", "--boundary", "friedrichs"])
    notes = [line.strip() for line in capsys.readouterr().out.splitlines() if "note:" in line]
    assert notes == [said]


def test_levels_that_are_false_never_leave(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kovacic.bound_states.families.Levels", lambda n, energy, *rest: Levels(n, energy + 1, *rest))
    with pytest.raises(kovacic.VerificationFailed, match="failed its own check at n = 0"):
        kovacic.spectrum("x^2")


@pytest.mark.parametrize("text", ["l(l+1)/r^2 - 2*Z/r", "\\frac{l(l+1)}{r^2} - \\frac{2Z}{r}"])
def test_the_radial_variable_beside_a_product_without_a_sign(text: str) -> None:
    found = kovacic.spectrum(text, domain=(0, "oo"), assume={"l": ">=1", "Z": "positive"})
    assert str(found.variable) == "r"
    assert str(found.levels[0].energy) == "-Z**2/(l + n + 1)**2"


@pytest.mark.parametrize(
    "potential", [[1, 2], None, b"x^2", {"x": 1}, object()], ids=["list", "None", "bytes", "dict", "object"]
)
def test_what_is_no_potential_is_refused(potential: object) -> None:
    with pytest.raises(kovacic.InputError, match="the potential isn't a number that is known exactly"):
        kovacic.spectrum(potential)


@parametrize(
    ("V", "numbers"),
    [
        ("-6*sech(x)^2 + 4*tanh(x)", (0,)),
        ("-12*sech(x)^2 + 2*tanh(x)", (0, 1)),
        ("-20*sech(x)^2 - 6*tanh(x)", (0, 1, 2)),
    ],
    ordinary=1,
    long=1,
)
def test_a_norm_has_a_value_for_each_level(V: str, numbers: tuple[int, ...]) -> None:
    """Where exponents are integers, too: no quotient of a sine that vanishes and an infinite Gamma function."""
    (levels,) = kovacic.spectrum(V).levels
    assert levels.members == numbers
    assert len(levels.wave.atoms(sympy.exp)) == 1
    for number in numbers:
        wave = levels.wave.subs(n, number).doit()
        integral = integral_of_square(wave, -40.0, 40.0)
        assert abs(integral / float(levels.norm.subs(n, number)) - 1) < 1e-9


@parametrize(
    ("V", "domain", "period"),
    [
        ("2/x^2 + 3/x", ("-oo", 0), (-90, 0)),
        ("5/sin(x)^2 - 3*cot(x)", ("pi", "2*pi"), (3.1415926, 6.2831853)),
        ("5/sin(x)^2 - 3*cot(x)", ("-pi", 0), (-3.1415926, 0)),
        ("2/sin(x)^2", ("-pi", 0), (-3.1415926, 0)),
        ("5/sin(x)^2 + 3/cos(x)^2", ("3*pi/2", "2*pi"), (4.712389, 6.2831853)),
        ("5/sin(x)^2 + 3/cos(x)^2", ("-pi/2", 0), (-1.5707963, 0)),
        ("5/sinh(x)^2 - 40/cosh(x)^2", ("-oo", 0), (-30, 0)),
        ("6*tan(x)^2 + 2*tan(x)", ("pi/2", "3*pi/2"), (1.570797, 4.712388)),
    ],
    ordinary=(0, 3),
    long=(6,),
)
def test_functions_are_real_in_every_period(V: str, domain: Any, period: tuple[float, float]) -> None:
    """Powers of sin(x/2), which is negative in some of them, and of a distance on the left of 0; with the norm."""
    (levels,) = kovacic.spectrum(V, domain=domain).levels
    wave = levels.wave.subs(n, 0).doit()
    assert abs(sympy.im(sympy.N(wave.subs(x, sum(period) * 0.47)))) < 1e-12
    assert abs(integral_of_square(wave, *period) / complex(sympy.N(levels.norm.subs(n, 0))) - 1) < 1e-6


def test_values_of_letters_in_the_kinetic_factor() -> None:
    """They are put into it and into V; other letters of it are parameters of the answer."""
    equation = "-hbar^2/(2*m)*psi'' + m*w^2*x^2/2*psi = E*psi"
    oscillator = kovacic.spectrum(equation, assume={"w": "positive", "m": 3})
    assert {symbol.name for symbol in oscillator.levels[0].energy.free_symbols} == {"hbar", "w", "n"}
    assert oscillator.potential == read_expression("3*w^2*x^2/2")
    assert [s.energy for s in oscillator.states({"hbar": 2, "w": 5}, count=2)] == [5, 15]
    box = kovacic.spectrum("-hbar^2/(2*m)*psi'' = E*psi", domain=(0, "L"), assume={"L": "positive"})
    assert box.states({"hbar": 2, "m": 8, "L": 1}, count=1)[0].energy == sympy.pi**2 / 4


@pytest.mark.parametrize(
    ("V", "said", "is_said"),
    [
        ("-e^2/r", "e is Euler's number", True),
        ("-exp(2)/r", "e is Euler's number", False),
        ("-1/2 u'' - e^2/r*u = E*u", "e is Euler's number", True),
        ("-hbar^2/(m*r)", "give the whole equation for -hbar^2/(2*m)*psi''", True),
        ("-hbar^2/(2*m) u'' - Z/r*u = E*u", "give the whole equation", False),
    ],
)
def test_what_a_physicist_may_have_meant_is_said(V: str, said: str, is_said: bool) -> None:
    found = kovacic.spectrum(V, domain=HALF)
    assert any(said in notice for notice in found.notices) == is_said


@pytest.mark.long
def test_a_root_of_a_number_beside_a_letter() -> None:
    """Razavy's potential with the levels that it has where the letter is a number."""
    found = kovacic.spectrum("(sqrt(2)*cosh(2*x) - M)^2")
    for M, energies in (1, {"3"}), (2, {"5 - 2*sqrt(2)", "5 + 2*sqrt(2)"}):
        assert {state.energy for state in found.states({"M": M})} == {*map(read_expression, energies)}


@pytest.mark.parametrize(
    ("V", "domain", "falls"),
    [
        pytest.param("-1/sin(x)^3", (0, "pi"), True, marks=pytest.mark.long),
        pytest.param("1/(1 - exp(x))^3", ("-oo", 0), False, marks=pytest.mark.long),
        ("1/(1 - exp(x))^3", (0, "oo"), True),
    ],
)
def test_an_odd_pole_has_another_sign_on_each_side(V: str, domain: tuple[object, object], falls: bool) -> None:
    found = kovacic.spectrum(V, domain=domain, max_degree=0)
    assert any("V -> -oo" in end for end in found.ends) == falls


@pytest.mark.parametrize(
    ("V", "levels"),
    [
        ("sqrt(n)*x^2", "E_k = 2*k*n^(1/4) + n^(1/4), k = 0, 1, 2, ..."),
        ("exp(-2*x) - 2*sqrt(n)*exp(-x)", "E_k = -(2*k - 2*sqrt(n) + 1)^2/4, k = 0, 1, 2, ... with k < sqrt(n) - 1/2"),
    ],
)
def test_no_level_is_counted_by_a_parameter_inside_a_function(V: str, levels: str) -> None:
    """With n for both, Morse's potential had no eigenvalues, "proven"."""
    assert levels in kovacic.spectrum(V, assume={"n": "positive"}).text()
    with pytest.raises(kovacic.InputError, match="q isn't a parameter") as refused:
        kovacic.spectrum(V, assume={"q": "positive"})
    assert refused.value.hint == "the parameters are n"


def test_a_complex_exponent_difference_needs_its_conjugate() -> None:
    """n is real: the exponents of two conjugate points have one sign, and a single one has none."""
    a, b = 2 + 3 * sympy.I, 2 - 3 * sympy.I
    one: Any = SimpleNamespace(value=a, signed=[a, -a])
    other: Any = SimpleNamespace(value=b, signed=[b, -b])
    real: Any = SimpleNamespace(value=sympy.Integer(5), signed=[5, -5])
    assert [*_choices([one, real])] == []
    assert [*_choices([real, one, other])] == [[5, a, b], [5, -a, -b], [-5, a, b], [-5, -a, -b]]


def test_no_states_are_none_only_where_that_is_proven() -> None:
    """An undecided spectrum had no states, as if there were no levels; for a = 1 there are."""
    undecided = kovacic.spectrum("exp(-2*a*x) - 6*exp(-a*x)")
    with pytest.raises(kovacic.InputError, match="no level is known"):
        undecided.states({"a": 1})
    assert kovacic.spectrum("6/cosh(x)^2").states() == ()


def test_a_potential_that_falls_for_every_letter_has_no_spectrum_of_its_own() -> None:
    lines = str(kovacic.spectrum("-a^2*x^4")).splitlines()
    assert lines[1].endswith("square integrable (limit circle) where a^2 > 0")
    assert lines[3:] == [
        "  a boundary condition is needed, there is no spectrum without one",
        "  (none is distinguished)",
    ]
