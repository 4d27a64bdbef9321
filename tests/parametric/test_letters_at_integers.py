"""General solutions with letters: at the integers that users mean, the pair is independent, or the exception is named."""

from __future__ import annotations

import itertools
import warnings
from typing import Any

import mpmath
import pytest
import sympy
from build import parametrize, size
from flint import acb, fmpq

import kovacic
from kovacic.algebra.precision import working_digits
from kovacic.closed_form.jets import jet

x = sympy.Symbol("x")

#: Families with letters, and the letters that take the values.
FAMILIES: list[tuple[str, str]] = [
    ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", "n"),
    ("(1-x^2)*y'' - 2*x*y' + (n*(n+1) - m^2/(1-x^2))*y = 0", "nm"),
    ("(1-x^2)*y'' - (2*a+1)*x*y' + n*(n+2*a)*y = 0", "na"),
    ("(1-x^2)*y'' - x*y' + n^2*y = 0", "n"),
    ("(1-x^2)*y'' - 3*x*y' + n*(n+2)*y = 0", "n"),
    ("(4-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", "n"),
    ("(1-(x-1)^2)*y'' - 2*(x-1)*y' + n*(n+1)*y = 0", "n"),
    ("x*(1-x)*y'' + (1-2*x)*y' + n*(n+1)*y = 0", "n"),
    ("x*y'' + (1-x)*y' + n*y = 0", "n"),
    ("x*y'' + (a+1-x)*y' + n*y = 0", "na"),
    ("x*y'' + (c-x)*y' - a*y = 0", "ca"),
    ("x*(1-x)*y'' + (c-(a+b+1)*x)*y' - a*b*y = 0", "cab"),
    ("y'' - 2*x*y' + 2*n*y = 0", "n"),
    ("y'' + (n + 1/2 - x^2/4)*y = 0", "n"),
    ("x^2*y'' + x*y' + (x^2-n^2)*y = 0", "n"),
    ("x^2*y'' + x*y' - (x^2+n^2)*y = 0", "n"),
    ("x^2*y'' + 2*x*y' + (x^2-n*(n+1))*y = 0", "n"),
    ("x^2*y'' + x*y' - n^2*y = 0", "n"),
    ("y'' + n^2*y = 0", "n"),
    ("y'' - n*y' = 0", "n"),
]
#: More families, whose solutions are given by values at an ordinary point.
WITH_VALUES = [
    *FAMILIES,
    ("y'' + n*y = 0", "n"),
    ("y'' - n*y = 0", "n"),
    ("y'' + 2*n*y' + y = 0", "n"),
    ("y'' + n*y' + m*y = 0", "nm"),
    ("y'' - (n+m)*y' + n*m*y = 0", "nm"),
    ("x^2*y'' + n*x*y' + y = 0", "n"),
    ("x^2*y'' + (1-n-m)*x*y' + n*m*y = 0", "nm"),
    ("x^2*y'' + x*y' + n*y = 0", "n"),
    ("y'' - n*x*y = 0", "n"),
    ("y'' + n*x^2*y = 0", "n"),
    ("y'' + (n-x)*y = 0", "n"),
    ("y'' - x*y' - n*y = 0", "n"),
    ("x*y'' + n*y' + x*y = 0", "n"),
    ("x*y'' + n*y' - x*y = 0", "n"),
    ("x*y'' + n*y' + y = 0", "n"),
    ("y'' + (n/x - 1/4)*y = 0", "n"),
    ("y'' - 2*n/x*y' + y = 0", "n"),
    ("y'' + n*exp(2*x)*y = 0", "n"),
    ("y'' + (exp(2*x) - n^2)*y = 0", "n"),
    ("y'' + x^n*y = 0", "n"),
]
VALUES = [sympy.Rational(k, 2) for k in range(-6, 13)]
#: Between the singular points of all families.
POINT = mpmath.mpf(3) / 7


def value(e: Any) -> Any:
    with mpmath.workdps(30):
        return mpmath.mpmathify(sympy.N(e, 30))


@parametrize("family", FAMILIES, ids=str, ordinary=(6,), long=2)
def test_pairs_are_independent_or_the_exception_is_named(family: tuple[str, str]) -> None:
    equation, letters = family
    found = kovacic.dsolve(equation, var="x")
    validity = kovacic.validity(found)
    y1, y2 = (found.rhs.diff(sympy.Symbol(name)) for name in ("C1", "C2"))
    W = y1 * y2.diff(x) - y1.diff(x) * y2
    others = {sympy.Symbol(letter): sympy.Rational(2 * k + 5, 7) for k, letter in enumerate(letters)}
    for letter in letters:
        for number in VALUES:
            values = {**others, sympy.Symbol(letter): number}
            if any(is_zero(e.subs(values)) for e in validity.exceptions):
                continue
            wronskian = W.subs(values).subs(x, sympy.Rational(3, 7))
            assert abs(value(wronskian)) > 1e-12, (letter, number)


def is_zero(e: Any) -> bool:
    return bool(sympy.simplify(e) == 0)


@parametrize("family", WITH_VALUES, ids=str, ordinary=(20,), long=1)
def test_values_at_ordinary_points_or_the_exception_is_named(family: tuple[str, str]) -> None:
    """At integers -3..6 and half-integers the answer has the values that were given, or the letter's value was excluded."""
    equation, letters = family
    with warnings.catch_warnings(record=True, action="always") as noticed:
        found = kovacic.dsolve(equation, var="x", ics="y(1/2)=1, y'(1/2)=-2/3")
    assert not noticed
    validity = kovacic.validity(found)
    others = {sympy.Symbol(letter): sympy.Rational(2 * k + 5, 7) for k, letter in enumerate(letters)}
    for letter, number in itertools.product(letters, VALUES):
        values = {**others, sympy.Symbol(letter): number}
        if any(is_zero(e.subs(values)) for e in validity.exceptions):
            continue
        # Relations on x and on letters: the formula is about the values for which they hold.
        if any(relation.subs({**values, x: sympy.S.Half}) != sympy.true for relation in validity.real):
            continue
        with working_digits(30):
            at = jet(found.rhs.subs(values), x, acb(fmpq(1, 2)))
        assert abs(at[0] - 1) < 1e-12, (values, at)
        assert abs(at[1] + fmpq(2, 3)) < 1e-12, (values, at)


@pytest.mark.filterwarnings("ignore:this holds unless")
@pytest.mark.parametrize(
    "word",
    [
        pytest.param("natural", marks=pytest.mark.long),
        pytest.param("positive integer", marks=pytest.mark.long),
        "integer",
    ],
)
def test_assumptions_in_text_are_those_of_symbols(word: str) -> None:
    """`assume=` gives what SymPy's own symbols give, in the user's symbols."""
    facts = {"natural": {"integer": True, "nonnegative": True}, "positive integer": {"integer": True, "positive": True}}
    n, plain = sympy.Symbol("n", **facts.get(word, {"integer": True})), sympy.Symbol("n")
    y = sympy.Function("y")
    for equation in (
        y(x).diff(x, 2) + n**2 * y(x),
        (1 - x**2) * y(x).diff(x, 2) - 2 * x * y(x).diff(x) + n * (n + 1) * y(x),
    ):
        wanted = kovacic.dsolve(equation, ics={y(0): 0}).rhs.xreplace({n: plain})
        text = str(
            equation.xreplace({n: plain}).subs({y(x).diff(x, 2): sympy.Symbol("A"), y(x).diff(x): sympy.Symbol("B")})
        )
        written = text.replace("A", "y''").replace("B", "y'").replace("y(x)", "y").replace("**", "^") + " = 0"
        assert kovacic.dsolve(written, ics="y(0)=0", assume={"n": word}).rhs == wanted


def test_assumptions_reach_values_and_limits() -> None:
    k = sympy.Symbol("k")
    assert kovacic.dsolve("y'' - k^2*y = 0", ics="y(0)=1, y(oo)=0", assume={"k": "positive"}).rhs == sympy.exp(-k * x)
    green = kovacic.dsolve("y'' - k^2*y = -DiracDelta(x - s)", ics="y(-oo)=0, y(oo)=0", assume={"k": "positive"}).rhs
    for place, source in ((1, 3), (3, 1)):
        here = green.subs({k: 2, sympy.Symbol("s"): source, x: place})
        assert size(here - sympy.exp(-2 * abs(place - source)) / 4, 15) < 1e-12
    assert kovacic.dsolve("y'' + n^2*y = 0", ics="y(0)=0, y(pi)=0", assume={"n": "natural"}).rhs.has(sympy.sin)
    with pytest.raises(kovacic.InputError, match="isn't a parameter"):
        kovacic.dsolve("y'' + n*y = 0", assume={"m": "natural"})
    with pytest.raises(kovacic.InputError, match="contradict"):
        kovacic.dsolve("y'' + n*y = 0", assume={"n": "positive negative"})


@parametrize("a", ["a", "1/3"], ordinary=0, long=1)
def test_values_at_a_point_divide_by_the_wronskian_of_abel(a: str) -> None:
    """Kummer's pair about 0 has W = (1 - c) x^-c e^x: nothing else is in a denominator that may vanish."""
    found = kovacic.dsolve(f"x*y''+(c-x)*y'-{a}*y=0", ics="y(1)=1, y'(1)=2")
    exceptions = kovacic.validity(found).exceptions
    assert not any(exception.has(sympy.hyper) for exception in exceptions)
    assert len(str(found.rhs)) < 320


def test_the_letter_i_is_a_parameter_and_said_to_be() -> None:
    with pytest.warns(UserWarning, match="i is a parameter; the imaginary unit is I"):
        found = kovacic.dsolve("y'' = i*y").rhs
    assert found.has(sympy.Symbol("i"))
    assert kovacic.dsolve("y'' = i*y", parameters=["i"]).rhs == found
