"""Terms that aren't rational and vanish: they cancel, or have the factor zero.  What is left is read."""

from __future__ import annotations

import csv

import pytest
import sympy
from build import parametrize, run

import kovacic

FUNCTIONS = ["exp(x)", "sech(x)^2", "sin(2*x)", "tanh(x)^3", "exp(-x)/(1 + exp(x))", "2^x", "log(x)"]
RATIONAL = ["-1", "x", "x^2 + 3", "a/x^2 + 1"]


@parametrize("f", FUNCTIONS, ordinary=1)
@pytest.mark.parametrize("rational", RATIONAL)
def test_what_is_left_is_solved(f: str, rational: str) -> None:
    plain = kovacic.solve(rational)
    for S in (f"(0)*{f} + {rational}", f"{f} - {f} + {rational}", f"{rational} + ({f})*x - x*{f}"):
        assert kovacic.solve(S).decision == plain.decision
    plain = kovacic.solve(f"y'' = 2*y' + ({rational})*y")
    for equation in (
        f"y'' = 2*y' + ({rational})*y + {f}*y - {f}*y",
        f"y'' = 2*y' + ({rational})*y + {f}*y' - {f}*y'",
        f"y'' + {f}*y'' - {f}*y'' = 2*y' + ({rational})*y + 0*{f}*y",
    ):
        found = kovacic.solve(equation)
        assert found.decision == plain.decision
        assert found.equation == plain.equation


@pytest.mark.long
def test_a_scan_keeps_the_free_particle(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["scan", "-(l*(l+1))*sech(x)^2 - 1", "l=-1,0,1", "--jobs", "1", "--format", "csv"]) == 0
    rows = csv.DictReader(capsys.readouterr().out.splitlines())
    assert [row["case"] for row in rows] == ["1", "1", "1"]


@pytest.mark.parametrize("equation", ["y'' = (x^(2*g) + 1/(a*x))*y", "y'' = (x^g + (a + b*x)/(x^2 + c))*y"])
def test_a_symbol_in_an_exponent_beside_parameters_is_refused(equation: str) -> None:
    for call in (kovacic.solve, kovacic.conditions, kovacic.dsolve):
        with pytest.raises(kovacic.InputError):
            call(equation)


@pytest.mark.parametrize(
    ("equation", "case"),
    [
        ("y'' = (x^(2*g) + a/x^2)*y", "a = (g*n + n - 1)*(g*n + n + 1)/4 for an odd integer n"),
        ("y'' + y'/x + (x^(2*g-2) - n^2/x^2)*y = 0", "n/g - 1/2 in Z"),
    ],
)
def test_a_power_with_a_symbol_is_the_variable(equation: str, case: str) -> None:
    """Bessel's equation in x^(g + 1), Lommel's in x^g: half odd integer orders."""
    assert case in str(kovacic.conditions(equation))
    assert kovacic.solve(equation).status == "none"
    assert kovacic.dsolve(equation).rhs.has(sympy.besseli, sympy.besselj)
