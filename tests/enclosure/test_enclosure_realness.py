"""Functions that aren't real everywhere: every function of the reader, in every place where one can stand.

A member is a function with an argument or a base that may be negative or complex, in a coefficient, in the right-hand side, as
an initial value, or as the value of a parameter.  A call for one point, a call for several, a table and an independent
integrator agree; a table of what isn't real is refused.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp

import kovacic
from kovacic.reading.names import FUNCTION_NAMES

STEPS = {"Heaviside", "DiracDelta", "Abs", "sign"}
FUNCTIONS = sorted({name for name, meaning in FUNCTION_NAMES.items() if meaning not in STEPS})
ARGUMENTS = ["x/3 + 1/5", "x/3 - 5/2", "x + 3/2", "I*x/2 + 1/3", "-x/4 - 1/7", "sqrt(2)*x - 3"]
BASES = ["2", "-2", "-1/3", "1 - sqrt(2)", "cos(2)", "I", "1 + I", "-1"]
INNER = [f"{name}({argument})" for name, argument in product(FUNCTIONS, ARGUMENTS)]
INNER += [f"({base})^({argument})" for base, argument in product(BASES, ARGUMENTS[:2])]
INNER += [
    "(x - 3)^(1/3)",
    "(-x - 1)^(2/3)",
    "(x + 1)^sqrt(2)",
    "(x - 4)^I",
    "(-2)^(x/2)*(-2)^(-x/2)",
    "exp(I*x) + exp(-I*x)",
]
SLOTS = ["b", "c", "f", "rational c, f", "values", "parameter"]
STOPS = ["1/2", "9/10"]
DIGITS = 18


class Member:
    """y'' + b y' + c y = f from 0, y(0) and y'(0), and the values of parameters."""

    def __init__(self, inner: str, slot: str) -> None:
        self.given: dict[str, Any] = {"x0": 0, "y0": "1/2", "dy0": "-1/3"}
        b, c, f = "0", "cos(x)", "0"
        if slot == "b":
            b = inner
        elif slot == "c":
            c = inner
        elif slot == "f":
            f = inner
        elif slot == "rational c, f":
            c, f = "x + 2", inner
        else:
            constant = re.sub(r"\bx\b", "(1/3)", inner)
            c, f = "x", "x"
            if slot == "values":
                self.given |= {"y0": constant, "dy0": f"-({constant})"}
            else:
                f = "a*x + 1"
                self.given["params"] = {"a": constant}
        self.text = f"y'' + ({b})*y' + ({c})*y = {f}"
        names = {name: getattr(sympy, meaning) for name, meaning in FUNCTION_NAMES.items()}
        symbols = {"x": sympy.Symbol("x"), "a": sympy.Symbol("a"), "I": sympy.I, **names}
        values = self.given.get("params", {})

        def read(text: str) -> Any:
            found = sympy.sympify(text.replace("^", "**"), locals=symbols)
            return found.subs({name: read(value) for name, value in values.items() if found.has(sympy.Symbol(name))})

        self.parts = [sympy.lambdify("x", read(part), "mpmath") for part in (b, c, f)]
        self.start = [complex(sympy.N(read(self.given[name]))) for name in ("y0", "dy0")]

    def integrated(self) -> list[complex]:
        """y at the stops."""
        b, c, f = self.parts

        def slope(x: float, state: Any) -> Any:
            y, dy = state
            at = mpmath.mpf(float(x))
            return [dy, complex(f(at)) - complex(b(at)) * dy - complex(c(at)) * y]

        stops = [float(sympy.Rational(stop)) for stop in STOPS]
        start = np.array(self.start, dtype=complex)
        found = solve_ivp(slope, (0, stops[-1]), start, "DOP853", t_eval=stops, rtol=1e-9, atol=1e-11)
        return list(found.y[0])


@cache
def members() -> list[tuple[str, str]]:
    return list(product(INNER, SLOTS))


def check(inner: str, slot: str) -> str:
    """Raise AssertionError unless all ways agree; "answered", or why there is no value."""
    member = Member(inner, slot)
    try:
        many = kovacic.evaluate(member.text, STOPS, digits=DIGITS, **member.given)
    except kovacic.InputError as error:
        return str(error)
    each = [kovacic.evaluate(member.text, [stop], digits=DIGITS, **member.given)[0] for stop in STOPS]
    single = kovacic.evaluate(member.text, STOPS[0], digits=DIGITS, **member.given)
    numbers = [complex(ball) for ball in many]
    size = max(1.0, *map(abs, numbers))
    assert single.overlaps(many[0]), (inner, slot)
    for ball, other, number, integrated in zip(many, each, numbers, member.integrated(), strict=True):
        assert ball.overlaps(other), (inner, slot)
        assert abs(number - integrated) < 1e-7 * size, (inner, slot, number, integrated)
    try:
        table = kovacic.tabulate(member.text, 0, STOPS[-1], **member.given)
    except kovacic.InputError as error:
        refusal = str(error)
        table = None
    if table is None:
        assert "real coefficients" in refusal, (inner, slot)
        return "answered"
    for stop, number in zip(STOPS, numbers, strict=True):
        assert abs(complex(table(float(sympy.Rational(stop)))) - number) < 1e-9 * size, (inner, slot)
    return "answered"


def test_of_powers_with_a_negative_base_nothing_is_lost() -> None:
    for base, slot in (("(-2)^x", "rational c, f"), ("(1 - sqrt(2))^x", "f"), ("(-2)^(x/3)", "c")):
        assert check(base, slot) == "answered"
    value = kovacic.evaluate("y'' + y = a^x", 1, x0=0, y0=1, dy0=0, params={"a": -2})
    assert complex(value) == pytest.approx(0.7047305997909498 + 0.4004782415318498j)


def test_a_table_of_complex_values_beside_a_real_right_hand_side() -> None:
    assert check("exp(I*x)", "values") == "answered"


@pytest.mark.parametrize(
    "equation", ["sin(x)/sqrt(x)", "log(x + 1/4)*sin(x)/x", "log(a)*x", "sqrt(a)*x", "a^x", "acos(a)"]
)
def test_what_is_analytic_is_not_refused(equation: str) -> None:
    """A quotient away from its zeros, and a constant on a cut."""
    found = kovacic.evaluate(f"y'' + a*({equation})*y = 0", "1/2", x0="3/10", y0=1, dy0=0, params={"a": -2})
    assert found.digits > 14


@pytest.mark.long
def test_every_function_in_every_place() -> None:
    chosen = members()[::41]  # in all slots: 41 and 6 have no common factor
    answers = [check(*member) for member in chosen]
    assert answers.count("answered") > 0.8 * len(chosen)
