"""The form in which solutions are written: as short at every door, whatever the equation was made from."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

import kovacic
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.special.gauss import Gauss
from kovacic.special.pullback import Pullback

X = RatFunc(QQ.poly([0, 1]))
x = sympy.Symbol("x")


def pulled_back(differences: tuple[Fraction | int, ...], f: RatFunc) -> RatFunc:
    """S of Gauss' equation with these exponent differences at f = 0, 1, infinity."""
    return Pullback(Gauss(*(QQ.poly([Fraction(d) ** 2]) for d in differences)), f).S


#: s^2 = f (f - 1) in x is a curve of genus 1 for each of these.
GENUS_ONE = ((X**2 + 3 * X + 5) / (X + 1), (X**2 + 3 * X + 1) / (X + 1), (X**2 + X + 3) / (X + 2), (X**2 - 3) / (X + 4))


def check_dihedral(n: int, f: RatFunc) -> None:
    """Elementary and short, with the group of the same answer."""
    answer = kovacic.solve(str(pulled_back((Fraction(3, 2), Fraction(1, 2), Fraction(1, n)), f)))
    form = answer.closed_form
    assert form is not None
    assert answer.group is not None
    assert answer.group.finite
    assert form.notes == ()
    assert not form.y1.has(sympy.Integral)
    assert len(str(form.y1)) + len(str(form.y2)) < 2500


@pytest.mark.parametrize("n", [90, 110, 301])
def test_functions_on_a_curve_stay_products(n: int) -> None:
    check_dihedral(n, GENUS_ONE[0])


@pytest.mark.long
@pytest.mark.parametrize("f", GENUS_ONE, ids=str)
def test_long_functions_on_a_curve_stay_products(f: RatFunc) -> None:
    for n in (7, *range(60, 200, 5), 200, 250, 301, 1000, 4001):
        check_dihedral(n, f)


def test_a_ball_with_zero_in_a_denominator_asks_for_more_digits() -> None:
    """Two square roots agree in a hundred digits at the point of the check: 1/(r - s), and cot, sec, ... of the same kind."""
    close = sympy.sqrt(x**2 + sympy.Rational(1, 10**80)) - sympy.sqrt(x**2)
    from kovacic.closed_form.check import is_numerical_solution

    for y in (1 / close, close ** sympy.Rational(-1, 2), sympy.cot(close), sympy.csch(close)):
        omega = (sympy.diff(y, x, 2) / y).subs(x, 3)
        assert omega.is_number
        assert not is_numerical_solution(y, x, X, X * 0)


@pytest.mark.parametrize(
    "given", [sympy.pi**2 * x**2 + 3 * sympy.pi, "pi^2*x^2 + 3*pi", "pi*x + 1", "y'' + pi*y' + x*y = 0"]
)
def test_pi_is_a_number_in_what_is_written(given: object) -> None:
    answer = kovacic.solve(given)
    written = (*answer.solutions, *answer.special)
    assert written
    assert all(y.free_symbols == {x} for y in written)
