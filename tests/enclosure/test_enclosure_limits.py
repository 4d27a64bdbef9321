"""Limits of the numerical calls: they hold, and what can't be had is said at once, with the reason."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

import flint
import pytest
from build import ball_to_flint, evaluate_states, parametrize, sample
from clocks import controlled

import kovacic
from kovacic import (
    AccuracyWarning,
    Ball,
    LimitExceeded,
    Limits,
    connection_matrix,
    evaluate,
    monodromy,
    tabulate,
)

START: dict[str, Any] = {"y0": 1, "dy0": 0}


def test_a_number_beyond_all_doubles_is_named() -> None:
    with pytest.raises(LimitExceeded, match=r"from 0 to 1.0*e\+399, which takes"):
        evaluate("1/(x+10^400)", 10**399, x0=0, method="taylor", **START)
    with pytest.raises(LimitExceeded, match=r"from 0 to 4.17752213321906e\+844, which takes"):
        evaluate("1/(x+10^900)", Fraction(7**1000, 3), x0=0, method="taylor", **START)


@parametrize(
    ("S", "x", "x0"),
    [("x", 10**6, 0), ("1+1/x^2", 10**9, 1), ("10^20", 1, 0), ("10^20", 1j, 0), ("1/x^6", "1e-8", 1)],
    ordinary=5,
)
def test_growth_beyond_all_steps_is_said_at_once(S: str, x: object, x0: object) -> None:
    """The number of steps is the reason, which is known before the first one, and not the time."""
    with pytest.raises(LimitExceeded, match=r"grow or oscillate by exp\(\d.*steps or more, above the limit"):
        evaluate(S, x, x0=x0, method="taylor", limits=Limits(seconds=600), **START)


def test_a_steep_equation_is_refused_before_its_first_disc() -> None:
    """Discs of 2^-113, with numbers as long: some hundreds of them would be made until the growth is looked at."""
    with controlled() as clock, pytest.raises(LimitExceeded, match=r"exp\(\d\.\d+e\+\d+\) on the way from 9/4 to 11/4"):
        evaluate("(x^2+3*x+7)^60 + x", "11/4", x0="9/4", limits=Limits(seconds=600), **START)
    assert clock.looks < 500


def test_a_closed_form_needs_no_steps_whatever_the_growth() -> None:
    value = kovacic.solve("10^20").at(1, x0=0, y0=1, dy0=10**10)
    size = math.log2(value.re[0]) + value.re[1]
    assert size == pytest.approx(10**10 / math.log(2), rel=1e-12)


@parametrize(
    ("equation", "x"), [("1+1/x^2", 10**7), ("y'' + exp(x^2)*y = 0", 6), ("y'' + exp(x)*y = x", 24)], ordinary=(0,)
)
def test_the_time_of_the_first_steps_tells_that_the_others_dont_fit(equation: str, x: int) -> None:
    with controlled(step=0.001) as clock, pytest.raises(LimitExceeded, match="limit of 20 s is exceeded: the way"):
        evaluate(equation, x, x0=1, method="taylor", limits=Limits(seconds=20), **START)
    assert clock.time < 10


@pytest.mark.long
def test_digits_lost_by_a_recessive_start_are_had_or_the_reason_is_said_at_once() -> None:
    value = evaluate("1", 5000, x0=0, y0=1, dy0=-1)  # others grow by exp(5000): twice 2171 digits are lost
    with flint.ctx.workprec(200):
        assert ball_to_flint(value).overlaps(flint.acb(-5000).exp())
    assert value.digits >= 15
    with pytest.warns(
        AccuracyWarning, match=r"other solutions grow to about 10\^43429448\d\d on the way"
    ):  # exp(10^10)
        assert kovacic.solve("10^20").at(1, x0=0, y0=1, dy0=-(10**10)).contains_zero()
    with pytest.warns(AccuracyWarning, match=r"other solutions grow to about 10\^173\d\d\d on the way"):
        (state,) = [evaluate("1", 4 * 10**5, x0=0, y0=1, dy0=-1)]
    assert state.contains_zero()


@pytest.mark.parametrize(
    ("x", "dy0", "limits", "said"),
    [
        (2000, -1, Limits(digits=15), r"\d bits: other solutions grow to about 10\^85[78] on the way"),
        (flint.arb(0, 1.5), 0.25, None, r"with \d+ bits$"),  # y(-1.5) > 0 > y(1.5) or the other way round
        (flint.arb(0, 1.5), 0.25, Limits(digits=200), r"with \d+ bits$"),
    ],
)
def test_only_growth_is_called_growth(x: Any, dy0: Any, limits: Limits | None, said: str) -> None:
    """A ball that is wide because a number of the user is one says nothing of other solutions."""
    digits = 15 if limits is None else limits.digits
    with pytest.warns(AccuracyWarning, match=said):
        evaluate("1", x, x0=0, y0=int(dy0 < 0), dy0=dy0, digits=digits, limits=limits)


@cache
def hermite() -> kovacic.Solution:
    return kovacic.solve("x^2-401")


CALLS: dict[str, Callable[[Limits], object]] = {
    "many digits": lambda limits: evaluate("x^9 + 1/(x-7)^3", 2, x0=1, digits=100_000, limits=limits, **START),
    "a high degree": lambda limits: evaluate("1/(x^500+x+3)", 2, x0=1, limits=limits, **START),
    "a higher degree": lambda limits: evaluate("1/(x^2000+x+3)", 2, x0=1, limits=limits, **START),
    "a steep way": lambda limits: connection_matrix("(x^2+3*x+7)^400+x", [2, 2 + 1j, 3], limits=limits),
    "a long way": lambda limits: evaluate("-1-1/x^2", 10**5, x0=1, limits=limits, **START),
    "many points": lambda limits: evaluate("x", range(-300, 0), x0=0, digits=300, limits=limits, **START),
    "at": lambda limits: kovacic.solve("x^2+3").at(2, x0=1, digits=90_000, method="taylor", limits=limits, **START),
    "right-hand side": lambda limits: evaluate("y'' = x^2*y + 1/x", 9, x0=1, digits=2000, limits=limits, **START),
    "a matrix": lambda limits: connection_matrix("x^9+1/(x-7)^3", [1, 2, 3, 4], digits=50_000, limits=limits),
    "monodromy": lambda limits: monodromy("1/(x^60+x+3)", digits=200, limits=limits),
    "plot": lambda limits: sample("1/(x^2-2) - 10^7/(x^2-3)", -9, 9, points=4000, digits=50, limits=limits),
    "a table": lambda limits: tabulate("-10^9*x", 0, 9, x0=0, limits=limits, **START),
    "lambdify": lambda limits: hermite().lambdify(interval=(-20, 20), limits=limits),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::kovacic.enclosure.evaluate.AccuracyWarning")
@pytest.mark.parametrize("looks", [3, 60])
@parametrize("name", CALLS, ordinary=len(CALLS))
def test_every_call_ends_once_its_time_is_over(name: str, looks: int) -> None:
    hermite()
    limit = "seconds"
    with controlled(looks_in_time=looks) as clock:
        try:
            CALLS[name](Limits(seconds=0.25))
        except LimitExceeded as error:
            limit = error.limit
    assert clock.late_looks <= 20
    assert limit in ("seconds", "unknown_degree")


@parametrize("coefficient", ["sin(x)^6/(2 + cos(x))^6", "exp(sin(x)/9)^40", "1/(3 + sin(x))", "tan(x/9)^3"], ordinary=1)
def test_operations_with_long_series_are_foreseen(coefficient: str) -> None:
    """FLINT can't be stopped inside of one, which takes seconds where there are ten thousand terms and bits."""
    with (
        controlled(looks_in_time=10**9),
        pytest.raises(LimitExceeded, match=r"a product of power series with .* terms takes"),
    ):
        evaluate(
            f"y'' + {coefficient}*y' + tan(x)*y = 0", "2.75", x0="2.25", digits=5000, limits=Limits(seconds=1), **START
        )


def test_balls_of_any_exponents_are_compared_exactly() -> None:
    far = Ball((1, 10**10), rad=(1, 5 - 10**10))
    assert not far.contains_zero()
    assert far.contains(far)
    assert not Ball((3, 0), rad=(3, -(10**9))).overlaps(Ball((5, 0), rad=(1, -(10**9))))
    assert Ball((3, 0), rad=(1, 0)).overlaps(Ball((5, 0), rad=(1, 0)))  # they touch


@pytest.mark.parametrize("side", ["above", "below"])
@pytest.mark.parametrize("x", ["-1/100", "1/100", "-1/1000", "1/1000", "2"])
def test_a_detour_around_an_irregular_singular_point_is_as_wide_as_it_can_be(side: Any, x: str) -> None:
    """y'' = y/x^4, y(-1) = 1, y'(-1) = 0: y = -x exp(-1/x - 1), and others are as large as exp(1/r) at the distance r."""
    (state,) = evaluate_states("1/x^4", [x], x0=-1, y0=1, dy0=0, path=side, limits=Limits(seconds=20))
    assert state.missing == 0
    with flint.ctx.workprec(4000 + state.route.bits):
        t = flint.arb(flint.fmpq(*Fraction(x).as_integer_ratio()))
        assert ball_to_flint(state.y).overlaps(flint.acb(-t * (-1 / t - 1).exp()))


def test_growth_is_foreseen_for_numerators_of_any_degree() -> None:
    with pytest.raises(LimitExceeded, match=r"grow or oscillate by exp\(.*e\+44\) on the way from 2 to 3"):
        evaluate("x^200/(x^3-1)^2", 3, x0=2, y0=1, dy0=0)
