"""This package as a method of `sympy.dsolve`, and `kovacic.dsolve` with SymPy's arguments."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import sympy
from build import parametrize
from sympy.solvers import ode
from sympy.solvers.ode.single import solver_map

import kovacic

x, C1, C2 = sympy.symbols("x C1 C2")
n = sympy.Symbol("n", integer=True, positive=True)
y = sympy.Function("y")


def equation_of(y1: Any, y2: Any, y0: Any = 0) -> Any:
    """The equation of which C1 y1 + C2 y2 + y0 is the general solution."""
    unknown = y(x) - y0
    rows = [[u.diff(x, k) for k in range(3)] for u in (y1, y2)]
    minors = [rows[0][i] * rows[1][j] - rows[0][j] * rows[1][i] for i, j in ((1, 2), (0, 2), (0, 1))]
    a, b, c = (sympy.cancel(minor / minors[2]) for minor in (minors[2], -minors[1], minors[0]))
    return sympy.Eq(a * unknown.diff(x, 2) + b * unknown.diff(x) + c * unknown, 0)


def residual(equation: Any, found: Any) -> Any:
    """Of the equation at a point, with values for the constants."""
    values = {x: sympy.Rational(3, 7), C1: 2, C2: 5}
    left = equation.lhs.subs(y(x), found.rhs).doit()
    return left.subs(values).evalf(20, maxn=40)


def state() -> Any:
    return list(solver_map.items()), ode.allhints, ode.ode.allhints


@pytest.fixture
def registered() -> Iterator[None]:
    kovacic.register()
    yield
    kovacic.unregister()


#: Solutions that SymPy's methods don't find.
BASES = [(x * sympy.exp(x**2 / 2), sympy.exp(x**3)), ((x + 1) / (x**2 + 2), x**3 * sympy.exp(1 / x))]


@pytest.mark.usefixtures("registered")
@parametrize("basis", BASES, ordinary=1)
def test_sympy_finds_what_was_built(basis: tuple[Any, Any]) -> None:
    equation = equation_of(*basis)
    for found in (sympy.dsolve(equation), sympy.dsolve(equation, y(x), "kovacic")):
        assert found.lhs == y(x)
        assert {C1, C2} <= found.rhs.free_symbols
        assert abs(residual(equation, found)) < 1e-12


@pytest.mark.usefixtures("registered")
def test_values_are_put_in() -> None:
    wanted = x**2 + sympy.exp(x**2)
    equation = equation_of(sympy.exp(x**2), x * sympy.exp(x**2), x**2)
    ics = {y(0): 1, y(x).diff(x).subs(x, 1): 2 + 2 * sympy.E}
    assert sympy.expand(sympy.dsolve(equation, ics=ics).rhs - wanted) == 0


@pytest.mark.usefixtures("registered")
def test_assumptions_of_symbols_count() -> None:
    found = sympy.dsolve(y(x).diff(x, 2) + n**2 * y(x), ics={y(0): 0, y(sympy.pi): 0})
    (constant,) = found.rhs.free_symbols - {x, n}
    assert found.rhs == constant * sympy.sin(n * x)


@pytest.mark.long
@pytest.mark.usefixtures("registered")
def test_all_hints() -> None:
    equation = sympy.Eq(y(x).diff(x, 2), 6 * y(x) / x**2)
    found = sympy.dsolve(equation, hint="all")
    assert sympy.classify_ode(equation)[0] == found["default"] == "kovacic"
    assert found["kovacic"] == sympy.dsolve(equation)


@pytest.mark.long
@pytest.mark.usefixtures("registered")
def test_other_equations_are_left_to_sympy() -> None:
    """Not linear, of another order, and without a solution that is known here."""
    cubic = y(x).diff(x, 2) + (x**3 + x + 1) * y(x)
    for equation in (y(x).diff(x) - y(x), y(x).diff(x, 2) * y(x) - y(x).diff(x) ** 2, y(x).diff(x, 3), cubic):
        with pytest.raises(ValueError, match="does not match hint kovacic"):
            sympy.dsolve(equation, hint="kovacic")
    assert sympy.dsolve(y(x).diff(x) - y(x)).rhs == C1 * sympy.exp(x)


@pytest.mark.long
@pytest.mark.usefixtures("registered")
def test_integrals_stay_as_they_are() -> None:
    right = 1 / (sympy.log(x) + x)
    found = sympy.dsolve(y(x).diff(x, 2) + y(x) - right).rhs
    assert found.has(sympy.Integral)
    particular = found.subs({C1: 0, C2: 0})
    residual = (particular.diff(x, 2) + particular).doit(integrals=False) - right
    assert sympy.simplify(residual) == 0


def test_unregister_restores() -> None:
    before = state()
    kovacic.unregister()
    assert state() == before
    kovacic.register()
    kovacic.register()
    assert ode.allhints.count("kovacic") == 1
    assert next(iter(solver_map)) == ode.allhints[0] == "kovacic"
    kovacic.unregister()
    assert state() == before


def test_the_arguments_of_sympy() -> None:
    equation = sympy.Eq(y(x).diff(x, 2), y(x))
    wanted = kovacic.dsolve(equation)
    ics = {y(0): 1, y(x).diff(x).subs(x, 0): 1}
    assert kovacic.dsolve(equation, y(x), "best", False, None, None, None, 1, 8) == wanted
    assert kovacic.dsolve(equation, func=y(x), hint="kovacic", ics=ics).rhs == sympy.exp(x)
    assert kovacic.dsolve([equation], [y(x)]) == kovacic.dsolve((equation,)) == [wanted]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"hint": "2nd_power_series_ordinary"}, "unknown hint '2nd_power_series_ordinary'"),
        ({"hint": "all"}, "unknown hint 'all'"),
        ({"xi": x, "eta": 1}, "Lie's method"),
        ({"func": [y(x), sympy.Function("z")(x)]}, "one function is expected, and there are 2"),
    ],
)
def test_what_cannot_be_honoured_is_refused(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(kovacic.InputError, match=said):
        kovacic.dsolve(sympy.Eq(y(x).diff(x, 2), y(x)), **arguments)


def test_two_equations_for_one_unknown_are_refused() -> None:
    with pytest.raises(kovacic.InputError, match="two unknown functions are expected"):
        kovacic.dsolve([sympy.Eq(y(x).diff(x), 1), sympy.Eq(y(x), 1)])
