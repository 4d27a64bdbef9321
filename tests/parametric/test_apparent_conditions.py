"""Conditions where Darboux' transformation removes apparent singularities, and where all differences are half-integers."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize
from clocks import controlled

import kovacic

x, E = sympy.symbols("x E")


def exceptional(*functions: Any) -> Any:
    """x^2 - 2 (log W)'' with the Wronskian W of solutions for x^2, so that it has the oscillator's E, shifted by nothing."""
    wronskian = sympy.wronskian(functions, x) if len(functions) > 1 else functions[0]
    return sympy.cancel(sympy.together(x**2 - 2 * sympy.diff(sympy.log(wronskian), x, 2)))


def hermite(n: int) -> Any:
    return sympy.hermite(n, x)


def pseudo(n: int) -> Any:
    return sympy.expand(sympy.hermite(n, sympy.I * x) / sympy.I**n)


@parametrize(
    "functions",
    [(hermite(1), hermite(2)), (hermite(2), hermite(3)), (pseudo(4),), (hermite(1), hermite(2), hermite(3))],
    ordinary=1,
    long=1,
)
def test_exceptional_hermite_potentials_are_solvable_for_odd_energies(functions: tuple[Any, ...]) -> None:
    V = exceptional(*functions)
    answer = kovacic.conditions(V - E, var="x")
    assert answer.complete is True
    assert str(answer.regions[-1].statement) == "E is an odd integer"
    assert all(region.case == 1 for region in answer.regions)
    for energy in range(-9, 10):
        assert (answer.case_at({"E": energy}) == 1) is (energy % 2 == 1)
        assert kovacic.decide(V - energy, var="x").case == answer.case_at({"E": energy})
    assert answer.case_at({"E": sympy.Rational(1, 3)}) is None


@pytest.mark.long
def test_solutions_are_carried_back() -> None:
    V = exceptional(hermite(1), hermite(2))
    region = kovacic.conditions(V - E, var="x").regions[-1]
    found = 0
    for energy in (5, 7, -9):
        for solution in region.solution():
            degree = solution.degree.subs(E, energy)
            if not (degree.is_Integer and degree >= 0):
                continue
            y = sympy.expand_func(solution.y.subs(E, energy)).doit()
            value = (y.diff(x, 2) - (V - energy) * y).subs(x, sympy.Rational(13, 7)).evalf(30, maxn=60)
            assert abs(value) < sympy.Float("1e-20")
            assert abs(y.subs(x, sympy.Rational(13, 7)).evalf(30)) > sympy.Float("1e-20")
            found += 1
    assert found >= 3


@pytest.mark.long
def test_an_exceptional_laguerre_potential_with_a_parameter() -> None:
    """X1 [Quesne 2008]: E = 2 l + 3 + 4 n, as without the rational term, and its mirror images."""
    S = "x^2 + l*(l+1)/x^2 + 8/(2*x^2+2*l+1) - 16*(2*l+1)/(2*x^2+2*l+1)^2 - E"
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert answer.check(40)
    for l in (sympy.Rational(1, 3), 2):  # noqa: E741
        for n in range(4):
            assert answer.case_at({"l": l, "E": 2 * l + 3 + 4 * n}) == 1
    assert answer.case_at({"l": 2, "E": 2}) is None
    assert "Darboux" in answer.theory
    assert "[Dar82]" in answer.theorem()


@pytest.mark.long
@pytest.mark.parametrize("curve", ["4*x^3 - 28*x + 24", "4*x^3 - 4*x"])
def test_lame_with_integer_n_is_solvable_for_every_B(curve: str) -> None:
    """Darboux, Treibich & Verdier: one or two, for every accessory parameter; the engine agrees."""
    F = sympy.sympify(curve.replace("^", "**"))
    n, B = sympy.symbols("n B")
    b, c = F.diff(x) / (2 * F), -(n * (n + 1) * x + B) / F
    S = sympy.cancel(sympy.together(b.diff(x) / 2 + b**2 / 4 - c))
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert "n in Z: case 2" in str(answer)
    for number in (-3, 0, 2, 5):
        for accessory in (0, sympy.Rational(1, 7), 3):
            expected = kovacic.decide(S.subs({n: number, B: accessory}), var="x").case
            assert answer.case_at({"n": number, "B": accessory}) == expected
            assert expected in (1, 2)


@parametrize("name", ["w^2", "-w^2", "w^3", "4*w^2*v^2"], ordinary=0, long=1)
def test_a_parameter_in_powers_is_as_good_as_its_power(name: str) -> None:
    """Regge & Wheeler's equation is decided completely in W = w^2, and so it is in w."""
    S = f"({name} + (x-1)*(l*(l+1)*x-3)/x^4)*x^2/(x-1)^2 - (4*x-3)/(4*x^2*(x-1)^2)"
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert answer.check(30)
    assert not any(str(region.statement).startswith(("w^2 = 0", "w^3 = 0")) for region in answer.regions)
    if name == "-w^2":
        assert str(answer.regions[0].statement) == "w = 0, and l in Z"
        assert answer.case_at({"w": "I/2", "l": "(-1 + sqrt(13))/2"}) == 1  # l^2 + l = 3
        assert answer.case_at({"w": "I/2", "l": 1}) is None
        for l in (2, 3):  # noqa: E741
            special = sympy.I * (l - 1) * l * (l + 1) * (l + 2) / 6
            assert answer.case_at({"w": special, "l": l}) == 1
            region = answer.region_at({"w": special, "l": l})
            assert region is not None
            (solution, *_) = region.solution()
            y = solution.y.subs({"w": special, "l": l})
            right = sympy.sympify(S.replace("^", "**")).subs({"w": special, "l": l})
            value = (y.diff(x, 2) - right * y).subs(x, sympy.Rational(17, 7)).evalf(30, maxn=60)
            assert abs(value) < sympy.Float("1e-18") * abs(y.subs(x, sympy.Rational(17, 7)).evalf(30))


@parametrize("seconds", [0.2, 0.7, 1.2], ordinary=1)
def test_a_limit_within_the_search_is_a_value(seconds: float) -> None:
    """Of powers and of transformations, too: what was found until then is the answer."""
    S = "(-w^2 + (x-1)*(l*(l+1)*x-3)/x^4)*x^2/(x-1)^2 - (4*x-3)/(4*x^2*(x-1)^2)"
    kovacic.conditions("x^2 + n", var="x")  # imports
    with controlled(step=0.0005):
        answer = kovacic.conditions(S, var="x", limits=kovacic.Limits(seconds=seconds))
    assert "only as far as the limits allowed" in str(answer.complete)
    assert "The list is complete only as far as the limits allowed" in answer.theorem()


@parametrize(
    ("first", "rest"),
    [
        (1, "2/(x-1)^2 + b/(x-1)"),
        (2, "2/(x-1)^2 + b/(x-1)"),
        (1, "6/(x-1)^2 + b/(x-1)"),
        (3, "2/(x-1)^2 + b/(x-1)"),
        (1, "-3/(16*(x-1)^2) + b/(x-1)"),
        (2, "2/(x-1)^2 + b/(x-1) + c"),
        (1, "2/(x-1)^2 + b/(x-1) - 3/(16*(x+1)^2)"),
        (1, "b*x + c"),
        (2, "b*x^3"),
    ],
    ordinary=(4,),
    long=(0, 5, 7),
)
def test_a_logarithm_leaves_case_1(first: int, rest: str) -> None:
    """Beside integer differences of exponents no invariant is asked for in words: where a logarithm vanishes is an equation."""
    answer = kovacic.conditions(f"{first}*({first}+1)/x^2 + a/x + {rest}", var="x")
    assert answer.complete is True
    assert "exists" not in answer.text(all=True)
    assert "invariant" not in answer.text(all=True).partition("otherwise")[0]
    assert answer.check(30)
