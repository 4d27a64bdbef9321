"""What a solution needs to be real and valid."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize, run
from sympy.abc import a, b, c, k, m, v, w, x  # the names in texts

import kovacic


@parametrize(
    ("equation", "real", "exceptions"),
    [
        ("y'' + w^2*y = cos(v*x)", [], {w, v - w, v + w}),
        ("y'' - 2*a*y' + a^2*y = exp(b*x)", [], {a - b}),
        ("x^2*y'' + x*y' - y = log(x)", [x > 0], set()),
        ("x^2*y'' + x*y' + (x^2 - 1/9)*y = 0", [x > 0], set()),
        ("(1-x^2)*y'' - x*y' + y = 0", [1 - x**2 >= 0], set()),
        ("y'' + y = x", [], set()),
    ],
    ordinary=2,
)
def test_what_is_needed(equation: str, real: list[object], exceptions: set[object]) -> None:
    found = kovacic.validity(kovacic.dsolve(equation))
    assert (list(found.real), set(found.exceptions)) == (real, exceptions)
    assert bool(found) is bool(real or exceptions)


def test_the_oscillator() -> None:
    """Beyond m = 0, only critical damping, c^2 = 4 k m, is an exception, where the formula has one constant too few."""
    solution = kovacic.dsolve("m*y'' + c*y' + k*y = 0")
    found = kovacic.validity(solution)
    assert set(found.exceptions) == {m, c**2 - 4 * k * m}
    assert "m != 0" in str(found)
    critical = solution.rhs.subs(k, c**2 / (4 * m))
    assert sympy.simplify(critical.diff(x) / critical).free_symbols == {c, m}


def test_what_is_assumed_is_used() -> None:
    t, p = sympy.symbols("t p", positive=True)
    y = sympy.Function("y")(t)
    assert not kovacic.validity(kovacic.dsolve(t * y.diff(t, 2) + y.diff(t) + p**2 * t * y))
    with pytest.raises(kovacic.InputError):
        kovacic.validity(t)


#: Functions with a part that must be positive, or not negative, and the argument in which they are to be complex.
PARTS = (
    sympy.log,
    sympy.sqrt,
    lambda u: 1 / sympy.sqrt(u),
    lambda u: sympy.besselk(1, u, evaluate=False),
    lambda u: u**a,
)


@parametrize("part", PARTS, ordinary=2)
@pytest.mark.parametrize("known", [{"positive": True}, {"negative": True}, {"real": True, "nonzero": True}])
def test_a_part_that_is_complex_by_what_is_assumed(part: Any, known: dict[str, bool]) -> None:
    """With t > 0 for -t - 1, t < 0 for t - 1, and a real t for i t: no relation is left to say."""
    t = sympy.Symbol("t", **known)
    unreal = {t.is_positive: -t - 1, t.is_negative: t - 1}.get(True, sympy.I * t)
    solution = sympy.Eq(sympy.Function("y")(t), part(unreal) + 1 / (w - v))
    found = kovacic.validity(solution)
    assert found.real == (sympy.false,)
    assert found
    assert str(found) == "no value"


def test_a_complex_rate() -> None:
    k = sympy.Symbol("k", negative=True)
    y = sympy.Function("y")(x)
    assert str(kovacic.validity(kovacic.dsolve(y.diff(x, 2) - y / k**3))) == "no value"


def test_a_line_of_the_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "y'' + w^2*y = cos(v*x)"]) == 0
    assert "real and valid for v + w != 0, v - w != 0, w != 0" in capsys.readouterr().out
