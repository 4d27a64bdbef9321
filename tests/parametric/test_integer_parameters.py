"""Equations of mathematical physics with integers: the constants of what is returned don't die, for any small values.

A warning says where one formula holds and gives the other one; both are tried at the numbers that they are for, with mpmath.
"""

from __future__ import annotations

import warnings
from itertools import product
from typing import Any

import mpmath
import pytest
import sympy

import kovacic

X, Y = sympy.Symbol("x"), sympy.Function("y")
N, M, L, K = sympy.symbols("n m l k", integer=True, positive=True)
A, B, C = sympy.symbols("a b c", integer=True, positive=True)
_POINT = mpmath.mpf("0.613")


def _halves(equation: Any) -> tuple[Any, Any, Any]:
    """(integer that isn't negative, the solution there, the one elsewhere); (None, solution, None) without a warning."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = kovacic.dsolve(equation).rhs
    if not caught:
        return None, found, None
    (said,) = (str(warning.message) for warning in caught)
    holds, elsewhere = said.removeprefix("this holds for ").split("; elsewhere, y(x) = ")
    own = {symbol.name: symbol for symbol in equation.free_symbols}
    return sympy.sympify(holds[: -len(" >= 0")], own), found, sympy.sympify(elsewhere, own)


def _residual_and_wronskian(solution: Any, coefficients: tuple[Any, Any], numbers: dict[Any, int]) -> tuple[Any, Any]:
    """Of the equation y'' + p y' + q y = 0, relative to the terms, by mpmath's numbers and derivatives."""
    at = solution.subs(numbers)
    parts = [at.subs({"C1": first, "C2": second}) for first, second in ((1, 0), (0, 1))]
    p, q = (mpmath.mpmathify(sympy.N(e.subs(numbers).subs(X, _POINT), 30)) for e in coefficients)
    jets = []
    worst = mpmath.mpf(0)
    for part in parts:
        function = sympy.lambdify(X, part, "mpmath")
        y, dy, ddy = (mpmath.diff(function, _POINT, k) for k in range(3))
        worst = max(worst, abs(ddy + p * dy + q * y) / (abs(ddy) + abs(p * dy) + abs(q * y) + mpmath.mpf(10) ** -30))
        jets.append((y, dy))
    (u, du), (v, dv) = jets
    return worst, abs(u * dv - du * v) / ((abs(u) + abs(du)) * (abs(v) + abs(dv)) + mpmath.mpf(10) ** -30)


FAMILIES = {
    "associated Legendre": (sympy.cot(X), N * (N + 1) - M**2 / sympy.sin(X) ** 2),
    "Legendre": (sympy.cot(X), N * (N + 1)),
    "hydrogen": (2 / X, 2 / X - 1 / N**2 - L * (L + 1) / X**2),
    "Poeschl-Teller": (0 * X, N * (N + 1) * sympy.sech(X) ** 2 - M**2),
    "Poeschl-Teller, trigonometric": (0 * X, M**2 - N * (N + 1) * sympy.sec(X) ** 2),
    "Kummer": (C / X - 1, -A / X),
    "oscillator in the plane": (1 / X, 4 * N + 2 * M + 2 - X**2 - M**2 / X**2),
}


@pytest.mark.parametrize(
    ("name", "largest"),
    [
        ("hydrogen", (1, 1)),
        *(
            pytest.param(name, (5, 5), marks=pytest.mark.slow if k % 4 else pytest.mark.long)
            for k, name in enumerate(FAMILIES)
        ),
    ],
)
def test_no_constant_dies(name: str, largest: tuple[int, ...]) -> None:
    """For positive integers up to these, in the order of the letters."""
    p, q = FAMILIES[name]
    integer, natural, negative = _halves(Y(X).diff(X, 2) + p * Y(X).diff(X) + q * Y(X))
    symbols = sorted((p + q).free_symbols - {X}, key=str)
    with mpmath.workdps(40):
        for values in product(*(range(1, most + 1) for _, most in zip(symbols, largest, strict=False))):
            numbers = dict(zip(symbols, values, strict=True))
            is_negative = integer is not None and integer.subs(numbers) < 0
            residual, wronskian = _residual_and_wronskian(negative if is_negative else natural, (p, q), numbers)
            assert residual < 1e-10, numbers
            assert wronskian > 1e-20, numbers


@pytest.mark.long
def test_names_where_they_are_known() -> None:
    equation = Y(X).diff(X, 2) + sympy.cot(X) * Y(X).diff(X)
    integer, natural, _ = _halves(equation + (N * (N + 1) - M**2 / sympy.sin(X) ** 2) * Y(X))
    assert (integer, natural.coeff("C1")) == (N - M, sympy.assoc_legendre(N, M, sympy.cos(X)))
    J = sympy.Symbol("j", integer=True, nonnegative=True)
    integer, natural, _ = _halves(equation + ((M + J) * (M + J + 1) - M**2 / sympy.sin(X) ** 2) * Y(X))
    assert (integer, natural.coeff("C1")) == (None, sympy.assoc_legendre(M + J, M, sympy.cos(X)))
    _, natural, _ = _halves(equation + N * (N + 1) * Y(X))
    assert natural.coeff("C1") == sympy.legendre(N, sympy.cos(X))
    p, q = FAMILIES["hydrogen"]
    integer, natural, _ = _halves(Y(X).diff(X, 2) + p * Y(X).diff(X) + q * Y(X))
    assert integer == N - L - 1
    assert natural.coeff("C1") == X**L * sympy.exp(-X / N) * sympy.assoc_laguerre(N - L - 1, 2 * L + 1, 2 * X / N)
