"""A number that is given is the number in every answer, and a symbol with a number's name stays the user's symbol.

Generated: every constant and every door, as text and as SymPy expression.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import pytest
import sympy
from build import Conditions, parametrize

import kovacic

x, a = sympy.symbols("x a")
y = sympy.Function("y")
#: Numbers with their names in texts; None where texts have none.
NUMBERS = {
    "e": sympy.E,
    "pi": sympy.pi,
    "π": sympy.pi,
    "EulerGamma": sympy.EulerGamma,
    "Catalan": sympy.Catalan,
    "GoldenRatio": sympy.GoldenRatio,
    "exp(-1)": sympy.exp(-1),
    "log(2)": sympy.log(2),
    "e*pi": sympy.E * sympy.pi,
    "(e + sqrt(2))": sympy.E + sympy.sqrt(2),
}
SYMBOLS = ("e", "E", "I", "EulerGamma", "Catalan", "GoldenRatio")


def equation(k: Any) -> Any:
    """y'' = k^2 y."""
    return sympy.Eq(y(x).diff(x, 2), k**2 * y(x))


def solutions_of(given: Any) -> list[Any]:
    return list(kovacic.solve(given).solutions)


def from_json(given: Any) -> list[Any]:
    return list(kovacic.Solution.from_json(kovacic.solve(given).to_json(full=True)).solutions)


def dsolve(given: Any) -> list[Any]:
    C1, C2 = sympy.symbols("C1 C2")
    answer = kovacic.dsolve(given).rhs
    return [answer.subs({C1: 1, C2: 0}), answer.subs({C1: 0, C2: 1})]


DOORS: dict[str, Callable[[Any], list[Any]]] = {"solve": solutions_of, "JSON": from_json, "dsolve": dsolve}


@parametrize(
    ("door", "name"), product(DOORS, NUMBERS), ordinary=11, long=(1, 3, 4, 6, 9, 12, 15, 18, 22, 25, 28)
)  # each door, each number
@pytest.mark.filterwarnings("ignore:e is Euler's number")
def test_a_number_is_a_number_in_solutions(door: str, name: str) -> None:
    k = NUMBERS[name]
    for given in (equation(k), f"y'' = ({name})^2*y"):
        found = DOORS[door](given)
        assert all(each.free_symbols == {x} for each in found), found
        values = sorted(float(each.diff(x).subs(x, 0) / each.subs(x, 0)) for each in found)
        assert values == pytest.approx([-float(k), float(k)])


@pytest.mark.parametrize("name", NUMBERS)
def test_a_number_has_its_value(name: str) -> None:
    k = NUMBERS[name]
    for given in (equation(k), f"y'' = ({name})^2*y", kovacic.solve(equation(k))):
        assert float(kovacic.evaluate(given, 1, x0=0, y0=1, dy0=0)) == pytest.approx(float(sympy.cosh(k)))
    with_a = kovacic.solve(f"y'' = a^2*({name})^2*y")
    assert float(with_a.at(1, x0=0, y0=1, dy0=0, params={"a": 1})) == pytest.approx(float(sympy.cosh(k)))


@parametrize("name", NUMBERS, ordinary=(0, 2, 7, 8, 9), long=1)
def test_a_number_is_no_parameter_of_conditions_and_spectra(name: str) -> None:
    k = NUMBERS[name]
    for given in (f"{name}*x^2 + a", k * x**2 + a):
        found = kovacic.conditions(given, var="x", max_degree=0)
        assert found.parameters == ("a",)
        assert Conditions.from_json(found.to_json()).parameters == ("a",)
    if name in ("e*pi", "(e + sqrt(2))"):  # a product of unrelated numbers, and of a number and a root
        return
    for given in (f"{name}*x^2", k * x**2):
        ground = kovacic.spectrum(given).levels[0].energy
        n = next(iter(ground.free_symbols))
        assert float(ground.subs(n, 0)) == pytest.approx(float(sympy.sqrt(k)))


@parametrize("name", SYMBOLS, ordinary=(0, 1, 2, 3))
def test_a_symbol_stays_a_symbol(name: str) -> None:
    s = sympy.Symbol(name)
    given = equation(s)
    for door in DOORS.values():
        assert all(each.free_symbols == {x, s} for each in door(given)), name
    with pytest.raises(kovacic.InputError, match="values are needed"):
        kovacic.evaluate(given, 1, x0=0, y0=1, dy0=0)
    for asked in (given, kovacic.solve(given)):
        value = kovacic.evaluate(asked, 1, x0=0, y0=1, dy0=0, params={name: 2})
        assert float(value) == pytest.approx(float(sympy.cosh(2)))
    assert kovacic.conditions(s * x**2 + 1, var="x", max_degree=0).parameters == (name,)
    if name != "E":  # the energy there
        assert kovacic.spectrum(s**2 * x**2, assume={name: "positive"}).parameters == (name,)


def test_a_symbol_beside_its_number() -> None:
    e = sympy.Symbol("e")
    found = kovacic.solve(sympy.Eq(y(x).diff(x, 2), e**2 * sympy.E**2 * y(x)))
    assert [sympy.simplify(each.diff(x) / each) ** 2 for each in found.solutions] == [e**2 * sympy.E**2] * 2
    value = kovacic.evaluate(found, 1, x0=0, y0=1, dy0=0, params={"e": 1})
    assert float(value) == pytest.approx(float(sympy.cosh(sympy.E)))


@pytest.mark.parametrize("ask", [kovacic.solve, kovacic.conditions, kovacic.spectrum])
def test_a_symbol_with_the_name_pi_is_refused(ask: Callable[[Any], Any]) -> None:
    with pytest.raises(kovacic.InputError, match="rename the symbol"):
        ask(sympy.Symbol("pi") * x**2)
    assert kovacic.dsolve(equation(sympy.Symbol("pi"))).rhs.has(sympy.Symbol("pi"))


def test_declared_letters_are_parameters() -> None:
    found = kovacic.solve("y'' = e^2*y", parameters=["e"])
    assert found.solutions[0].free_symbols == {x, sympy.Symbol("e")}
    assert kovacic.conditions("e*x^2 + a", parameters=["e"]).parameters == ("e", "a")


def test_values_of_other_letters_leave_numbers_alone() -> None:
    found = kovacic.solve("e^2*x^2 + a*e", assume={"a": 1})
    assert found.solutions[0] == sympy.exp(sympy.E * x**2 / 2)
    assert kovacic.conditions("e*x^2 + a + b", assume={"b": 2}).parameters == ("a",)
