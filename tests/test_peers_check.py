"""The check of other systems' answers accepts right ones in every syntax, and rejects wrong ones."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"


@pytest.fixture(scope="module")
def check() -> ModuleType:
    sys.path.insert(0, str(BENCHMARKS))
    try:
        return importlib.import_module("peer_systems.check")
    finally:
        sys.path.remove(str(BENCHMARKS))


@pytest.mark.parametrize(
    ("S", "form", "syntax", "expressions", "verdict"),
    [
        ("x^2+3", "y", "python", ["x*exp(x**2/2)"], "right"),
        ("x^2+3", "y", "python", ["x*exp(x**2/3)"], "wrong"),
        ("x^2+3", "y", "python", ["x*exp(x**2/2)", "0"], "wrong"),
        ("x^2+3", "omega", "python", ["x + 1/x"], "right"),
        ("x^2+3", "omega", "python", ["x + 2/x"], "wrong"),
        ("x^2+3", "riccati", "python", ["-x - 1/x", "1", ""], "right"),
        ("x^2+3", "riccati", "python", ["-x - 2/x", "1", ""], "wrong"),
        ("2", "riccati", "python", ["-c/2", "1", "c**2 - 8"], "right"),
        ("2", "riccati", "python", ["-c/2", "1", "c**2 - 9"], "wrong"),
        ("1/x - 3/(16*x^2)", "riccati", "python", ["(1 - 16*x)/(16*x**2)", "-1/(2*x)", "1", ""], "right"),
        ("1/x - 3/(16*x^2)", "riccati", "giac", ["omega_^2-omega_/(3*x)+(1-16*x)/(16*x^2)"], "wrong"),
        ("1/x - 3/(16*x^2)", "y", "fricas", ["exp(2*x^(1/2))*(x^(1/2))^(1/2)"], "right"),
        ("1/x - 3/(16*x^2)", "y", "giac", ["x^(1/4)*exp(2*sqrt(x))", "x^(1/4)*exp(-2*sqrt(x))"], "right"),
        ("x^2+3", "y", "maxima", ["%k2*x*%e^(x^2/2)*'integrate(%e^(-x^2)/x^2,x)+%k1*x*%e^(x^2/2)"], "right"),
        ("x^2+3", "y", "maxima", ["%k2*x*%e^(x^2/2)*'integrate(%e^(-x^2)/x^3,x)+%k1*x*%e^(x^2/2)"], "wrong"),
        # On the left half-plane sqrt(x^2) is -x.
        ("x^2+1", "y", "python", ["exp(x*sqrt(x**2)/2)"], "right on a branch"),
    ],
)
def test_answers(check: ModuleType, S: str, form: str, syntax: str, expressions: list[str], verdict: str) -> None:
    assert check.check(S, form, syntax, expressions) == verdict


def test_numbers_in_coefficients_are_exact(check: ModuleType) -> None:
    import mpmath

    with mpmath.workdps(50):
        value = check._function("1/3*x**2 - 2/7 + (x - 12345678901234567890)/c**3")(mpmath.mpf(3), mpmath.mpf(2))
        exact = 3 - mpmath.mpf(2) / 7 + (3 - mpmath.mpf("12345678901234567890")) / 8
        assert abs(value - exact) < mpmath.mpf(10) ** -25


def test_unknown_functions_are_not_guessed(check: ModuleType) -> None:
    with pytest.raises(check.Unreadable):
        check.check("x", "y", "giac", ["mystery(x)"])
