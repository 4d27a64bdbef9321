"""Every kind of number in every numeric argument of every public function: a value, or an `InputError`."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from functools import cache
from typing import Any

import flint
import mpmath
import numpy as np
import pytest
import sympy
from build import parametrize
from hypothesis import given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import Ball, InputError, Limits, Solution
from kovacic.ball import RollingBall as Body
from kovacic.numbers.exact import exact, exact_text, is_complex, radical
from kovacic.numbers.numerals import as_latex, as_text, plain_text

NUMPY = {scalar for scalar in np.sctypeDict.values() if issubclass(scalar, np.number | np.bool_)} - {np.timedelta64}
KINDS: dict[str, Any] = {
    **{scalar.__name__: scalar(3) for scalar in sorted(NUMPY, key=str)},
    "datetime64": np.datetime64(3, "s"),
    "timedelta64": np.timedelta64(3, "s"),
    "str_": np.str_("3"),
    "bytes_": np.bytes_(b"3"),
    "void": np.void(b"3"),
    "array without dimensions": np.array(3),
    "int": 3,
    "half, float": 3.5,
    "half, NumPy": np.float32(3.5),
    "half, longdouble": np.longdouble("3.5"),
    "negative": -3,
    "nan": float("nan"),
    "nan, NumPy": np.float64("nan"),
    "infinity": float("inf"),
    "complex": 3 + 1j,
    "fraction": Fraction(3),
    "Decimal": Decimal(3),
    "Decimal, half": Decimal("3.5"),
    "mpf": mpmath.mpf(3),
    "mpc": mpmath.mpc(3, 1),
    "mpi": mpmath.iv.mpf([3, 4]),
    "Integer": sympy.Integer(3),
    "Rational": sympy.Rational(7, 2),
    "Float": sympy.Float(3.5),
    "sqrt(2)": sympy.sqrt(2),
    "I": sympy.I,
    "oo": sympy.oo,
    "sympy.nan": sympy.nan,
    "sympy.true": sympy.true,
    "symbol": sympy.Symbol("x"),
    "fmpz": flint.fmpz(3),
    "fmpq": flint.fmpq(7, 2),
    "arb": flint.arb(3),
    "arb with a radius": flint.arb(3, 0.5),
    "acb": flint.acb(3, 1),
    "nmod": flint.nmod(3, 7),
    "Ball": Ball.exact(3),
    "Ball with a radius": Ball((3, 0), rad=(1, -1)),
    "text": "3",
    "text, no number": "three",
    "bytes": b"3",
    "bytearray": bytearray(b"3"),
    "True": True,
    "None": None,
    "list": [3],
    "dict": {3: 3},
    "object": object(),
}

QUICK: dict[str, Any] = {"digits": 5, "limits": Limits(seconds=5)}
START: dict[str, Any] = {"x0": 1, "y0": 1, "dy0": 0, **QUICK}


def is_number(value: Any) -> bool:
    """Is it taken for one rational or complex number?"""
    try:
        return Ball.of(value).is_exact()
    except InputError:
        return False


FEW: dict[str, Any] = {"x0": 1, "y0": 1, "dy0": 0, "limits": Limits(seconds=5)}


@cache
def oscillator() -> Solution:
    return kovacic.solve("x^2 + 3")


@cache
def bessel() -> Any:
    return kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")


@cache
def table() -> Any:
    return kovacic.tabulate("x", 0, 4, x0=0, y0=1, dy0=0, careful=False)


PLACES: dict[str, Callable[[Any], object]] = {
    "solve": kovacic.solve,
    "solve: numerator": lambda v: kovacic.solve(([v, 1], [1])),
    "solve: a": lambda v: kovacic.solve(a=v, c="x"),
    "solve: c": lambda v: kovacic.solve(a=1, c=v),
    "solve: f": lambda v: kovacic.solve(a=1, c=1, f=v),
    "solve: a parameter": lambda v: kovacic.solve("n^2*x^2 + n", assume={"n": v}),
    "decide": kovacic.decide,
    "conditions: a parameter": lambda v: kovacic.conditions("(4*n^2 - k)/(4*x^2) - 1", assume={"k": v}),
    "conditions: max_degree": lambda v: kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1", max_degree=v),
    "case_at": lambda v: bessel().case_at({"n": v}),
    "solve_at": lambda v: bessel().solve_at({"n": v}),
    "region_at": lambda v: bessel().region_at({"n": v}),
    "determinant": lambda v: kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x", max_degree=0).determinant(v),
    "check: seed": lambda v: bessel().check(1, seed=v),
    "check: samples": lambda v: bessel().check(v),
    "conditions: plot, steps": lambda v: bessel().plot(ranges=[(0, 1)], steps=v),
    "conditions: plot, range": lambda v: bessel().plot(ranges=[(0, v)], steps=2),
    "dsolve: a value": lambda v: kovacic.dsolve("y'' + y = 0", ics={"y(0)": v, "y'(0)": 1}),
    "solve_riccati": lambda v: kovacic.solve_riccati(v, 0, -1),
    "solve_riccati: r": lambda v: kovacic.solve_riccati(1, 0, v),
    "solve_many: jobs": lambda v: kovacic.solve_many([], jobs=v),
    "solve_many: timeout": lambda v: kovacic.solve_many([], timeout=v),
    "solve_many: memory": lambda v: kovacic.solve_many([], memory=v),
    "evaluate": lambda v: kovacic.evaluate("x", v, **START),
    "evaluate: a list": lambda v: kovacic.evaluate("x", [2, v], **START),
    "evaluate: x0": lambda v: kovacic.evaluate("x", 1, **{**START, "x0": v}),
    "evaluate: y0": lambda v: kovacic.evaluate("x", 2, **{**START, "y0": v}),
    "evaluate: dy0": lambda v: kovacic.evaluate("x", 2, **{**START, "dy0": v}),
    "evaluate: frobenius": lambda v: kovacic.evaluate("-2/(9*x^2)", 2, x0=0, frobenius=(1, v), **QUICK),
    "evaluate: a parameter": lambda v: kovacic.evaluate("n*x", 2, params={"n": v}, **START),
    "evaluate: digits": lambda v: kovacic.evaluate("x", 2, **{**START, "digits": v}),
    "evaluate: path": lambda v: kovacic.evaluate("x", 2, path=[v], **START),
    "evaluate: exp(x)": lambda v: kovacic.evaluate("y'' = exp(x)*y", v, **START),
    "evaluate: exp(x), digits": lambda v: kovacic.evaluate("y'' = exp(x)*y", 2, **{**START, "digits": v}),
    "at": lambda v: oscillator().at(v, **START),
    "at: dy0": lambda v: oscillator().at(2, **{**START, "dy0": v}),
    "connection_matrix": lambda v: kovacic.connection_matrix("x", [0, v], **QUICK),
    "connection_matrix: between": lambda v: kovacic.connection_matrix("x", [0, v, 1], **QUICK),
    "monodromy: digits": lambda v: kovacic.monodromy("-2/(9*x^2)", digits=v),
    "monodromy: a parameter": lambda v: kovacic.monodromy("n/x^2", params={"n": v}, digits=5),
    "compare_with_monodromy": lambda v: kovacic.solve("-3/(16*x^2)").compare_with_monodromy(digits=v),
    "tabulate": lambda v: kovacic.tabulate("x", 0, v, careful=False, **FEW),
    "tabulate: y0": lambda v: kovacic.tabulate("x", 0, 1, careful=False, **{**FEW, "y0": v}),
    "a table's point": lambda v: table()(v),
    "lambdify": lambda v: oscillator().lambdify(interval=(0, v), check=False),
    "lambdify: which": lambda v: oscillator().lambdify(interval=(0, 1), which=v, check=False),
    "lambdify: dy0": lambda v: oscillator().lambdify(interval=(0, 1), check=False, **{**FEW, "dy0": v}),
    "plot": lambda v: oscillator().plot(0, v, points=2),
    "plot: x0": lambda v: oscillator().plot(0, 1, points=2, x0=v),
    "plot: points": lambda v: oscillator().plot(0, 1, points=v),
    "Ball.of": Ball.of,
    "Ball.exact": Ball.exact,
    "Ball.exact: exponent": lambda v: Ball.exact(1, v),
    "Ball: contains": Ball.exact(3).contains,
    "Ball: equals": Ball.exact(3).equals,
    "Ball: overlaps": Ball.exact(3).overlaps,
    "Ball: a sum": lambda v: (Ball.exact(1) + v) if is_number(v) else None,
    "the ball's mass": lambda v: Body(m=v, R=1, a=0, A1=1, A3=1),
    "the sphere's radius": lambda v: Body(m=1, R=1, a=0, A1=1, A3=1).on_sphere(v),
    **{
        f"Limits: {name}": lambda v, name=name: Limits(**{name: v})
        for name in ("seconds", "degree", "digits", "exponent", "unknown_degree", "text_length", "constants", "bits")
    },
}


@pytest.mark.filterwarnings("ignore::kovacic.AccuracyWarning")
@parametrize("place", PLACES, ordinary=1, long=(1, 17))
def test_every_kind_of_number_is_a_value_or_refused(place: str) -> None:
    other = {}
    for kind, value in KINDS.items():
        try:
            PLACES[place](value)
        except (InputError, kovacic.LimitExceeded, NotImplementedError):
            pass
        except Exception as error:
            other[kind] = f"{type(error).__name__}: {error}"[:150]
    assert not other


@pytest.mark.parametrize("value", [Fraction(3), Fraction(7, 2)])
def test_the_same_number_of_every_kind_gives_the_same_value(value: Fraction) -> None:
    """What is read isn't rounded."""
    same = {kind: number for kind, number in KINDS.items() if is_number(number) and Ball.of(number).equals(value)}
    assert len(same) >= (25 if value == 3 else 5)
    expected = kovacic.evaluate("x", value, **START)
    for kind, number in same.items():
        assert kovacic.evaluate("x", number, **START) == expected, kind
        assert kovacic.evaluate("x", [number], **START) == (expected,), kind


@settings(max_examples=20)
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_double_is_its_binary_value_and_text_its_decimal_one(double: float) -> None:
    for number in (
        double,
        np.float64(double),
        np.longdouble(double),
        mpmath.mpf(double),
        complex(double),
        Decimal(double),
    ):
        ball = Ball.of(number)
        assert ball.is_exact()
        assert ball.midpoint == (Fraction(double), 0)
    assert kovacic.evaluate("0", f"{Decimal(double):f}", x0=0, y0=0, dy0=1).contains(Fraction(double))


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (mpmath.mpc(3, "0.5"), (3, Fraction(1, 2))),
        (mpmath.mpf("-0.75"), (Fraction(-3, 4), 0)),
        (sympy.Float("1.5") + 2 * sympy.I / 3, (Fraction(3, 2), Fraction(2, 3))),
        (flint.acb(2, -0.25), (2, Fraction(-1, 4))),
        (np.complex64(2 - 3j), (2, -3)),
        (np.array(Fraction(2, 3), dtype=object), (Fraction(2, 3), 0)),
        (Ball.exact(3, 2), (12, 0)),
        ("-12.5e-1", (Fraction(-5, 4), 0)),
        (" +6/4 ", (Fraction(3, 2), 0)),
        (Decimal("1e-100000"), (Fraction(1, 10**100000), 0)),
        (mpmath.ldexp(mpmath.mpf(1), -400000), (Fraction(1, 2**400000), 0)),
    ],
)
def test_numbers_of_libraries_are_read_exactly(value: Any, expected: tuple[Fraction, Fraction]) -> None:
    assert tuple(Fraction(int(part.p), int(part.q)) for part in exact(value, "x")) == expected


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (mpmath.matrix([[1]]), "x isn't a number that is known exactly"),
        (Limits(), "x isn't a number that is known exactly"),
        (np.array([2, 3]), "x isn't a number that is known exactly"),
        (flint.nmod(3, 7), "x isn't a number that is known exactly"),
        (sympy.sqrt(2), "x isn't a number that is known exactly"),
        (Ball((3, 0), rad=(1, -1)), "x is a ball of positive radius"),
        (flint.acb(2, flint.arb(3, 0.5)), "x is a ball of positive radius"),
        (flint.acb(flint.arb(3, 0.5), 2), "x is a ball of positive radius"),
        (mpmath.mpc(0, "inf"), "x isn't a finite number"),
        (Decimal("nan"), "x = NaN isn't a finite number"),
        (Decimal("2e100001"), "x = 2E[+]100001 has an exponent beyond 100000"),
        ("2e-100001", "x = 2e-100001 has an exponent beyond 100000"),
        (mpmath.ldexp(mpmath.mpf(1), 400001), "x has a binary exponent beyond 400000"),
        ("3/0", "x = 3/0 divides by zero"),
        (True, "x is a truth value"),
    ],
)
def test_what_is_no_exact_number_is_refused(value: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        exact(value, "x")


def test_numbers_of_libraries_within_formulas() -> None:
    """A number of SymPy is written as it is, and a complex one of mpmath is recognised."""
    assert exact_text(sympy.sqrt(2) / 3, "n") == "sqrt(2)/3"
    assert exact_text(mpmath.mpf("0.75"), "n") == "3/4"
    assert exact_text(np.float32(0.1), "n") == "0.1"
    assert [*map(is_complex, (mpmath.mpc(1, 2), mpmath.mpf(2), np.complex128(2), np.float64(2), 2j, 2.0))] == [
        *(True, False) * 3
    ]


def test_long_numbers_are_written() -> None:
    """Python refuses integers of more than 4300 digits, and SymPy roots of an order of that length."""
    x, c = sympy.symbols("x c")
    assert plain_text([10**5000]) == "list"
    assert plain_text(["x", 3]) == "['x', 3]"
    assert as_latex(sympy.Pow(x, sympy.Rational(2, 3**3000))).startswith(r"x^{\frac{2}{23")
    assert len(as_latex(sympy.Pow(x, sympy.Rational(1, 10**5000)))) == 5001 + len(r"x^{\frac{1}{}}")
    assert as_latex(sympy.Pow(x, sympy.Rational(1, 2**128))).startswith(r"x^{\frac{1}{")
    assert as_latex(sympy.Pow(x, sympy.Rational(1, 2**127))).startswith(r"\sqrt[")
    assert as_latex(sympy.root(x, 3)) == r"\sqrt[3]{x}"
    assert as_latex(sympy.Rational(-2, 7) * x) == r"- \frac{2 x}{7}"
    assert as_text(x**2 - c + x / 3 + 2) == "-c + x**2 + x/3 + 2"
    assert as_text(c * x**3 - x + 2 * c, x) == "c*x**3 - x + 2*c"
    assert as_text(x - c, x) == "x - c"
    assert as_text(sympy.sin(x) - c + x, x) == as_text(sympy.sin(x) - c + x)
    assert radical(sympy.Integer(3) ** 1001) == 3**500 * sympy.sqrt(3)
    with pytest.raises(kovacic.LimitExceeded, match="a root of a number of 1744 bits, above the limit of 1600"):
        radical(sympy.Integer(3) ** 1100)
