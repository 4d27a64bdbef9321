"""Parts of the room `kovacic.bound_states`, alone: roots, the shortest forms, the numbers of a family, bounds of V."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy

import kovacic
from kovacic.bound_states.closed_forms import _number_below
from kovacic.bound_states.energies import Root, _are_contradictory, exact_root, shortest_form, tidied
from kovacic.bound_states.levels import Levels
from kovacic.bound_states.picture import DrawnLevel, draw_levels
from kovacic.bound_states.signs import Signs
from kovacic.parametric.assumptions import Assumptions

x = sympy.Symbol("x")


@pytest.mark.parametrize(
    ("square", "root"),
    [
        ("3 + 4*I", "2 + I"),
        ("5 - 12*I", "3 - 2*I"),
        ("18", "3*sqrt(2)"),
        ("-45", "3*sqrt(5)*I"),
        ("(4*a^2 + 12*a*b + 9*b^2)/(25*c^2)", "(2*a + 3*b)/(5*c)"),
        ("a^2 + 6*I*a*b - 9*b^2", "a + 3*I*b"),
        ("7*a^4/(b + 3)^2", "sqrt(7)*a^2/(b + 3)"),
        ("a^3", None),
        ("a^2 + 1", None),
    ],
)
def test_roots_without_radicals(square: str, root: str | None) -> None:
    found = exact_root(sympy.sympify(square))
    if root is None:
        assert found is None
    else:
        assert sympy.expand(found - sympy.sympify(root)) * sympy.expand(found + sympy.sympify(root)) == 0


def test_a_root_that_is_not_real_is_known_by_its_parts() -> None:
    a, b = sympy.symbols("a b", positive=True)
    square = a**2 - 3 + 5 * sympy.I * b
    found = Root.of(square, sympy.Symbol("E"))
    (p, real), (q, imaginary) = found.radicals
    assert sympy.expand(found.value - p - sympy.I * q) == 0
    values = {a: sympy.Rational(7, 3), b: sympy.Rational(2, 5)}
    z = complex(sympy.N((real + sympy.I * imaginary).subs(values)))
    assert abs(z**2 - complex(square.subs(values))) < 1e-14
    assert z.real > 0


def test_the_shortest_of_some_forms() -> None:
    a, b, k = sympy.symbols("a b k")
    number = sympy.Dummy("n", integer=True)
    assert str(shortest_form((-a - b) ** 2)) == "(a + b)**2"
    assert str(shortest_form(a**2 + 2 * a * b + b**2, (a + b) ** 2 * 1)) == "(a + b)**2"
    assert str(shortest_form(k**3 - (-a - b) ** 2)) == "k**3 - (a + b)**2"
    assert str(shortest_form((3 * a + 3 * b) * k - 3 * k * b)) == "3*a*k"
    fractions = shortest_form((number**2 + 5 * number + 7) / (number + 2))
    assert sympy.cancel(fractions - number - 3 - 1 / (number + 2)) == 0


def test_the_numbers_of_a_family() -> None:
    number = sympy.Dummy("n", integer=True, nonnegative=True)

    def numbers(*conditions: Any) -> tuple[str, tuple[Any, ...]]:
        levels = Levels(number, 3 * number + 2, x, conditions, number, None)
        return levels.numbers, levels.demands

    assert numbers(number < 7) == ("0, 1, ..., 6", ())
    assert numbers(2 * number > 3)[0] == "0, 1, 2, ..."
    assert numbers()[0] == "0, 1, 2, ..."
    assert Levels(number, number, x, (number < 0,), number, None).is_empty


def test_numbers_below_a_function() -> None:
    """-1/t falls without a bound; 3 + 2/(t^2 + 1) and (t - 4)^2 + 1/3 don't, and t^3 has its least value at the left end."""
    t = sympy.Symbol("t")
    assert _number_below(-1 / t, t, (sympy.S.Zero, sympy.oo)) == -sympy.oo
    assert _number_below(3 + 2 / (t**2 + 1), t, ()) == -sympy.oo
    assert _number_below(sympy.sqrt(2) * t, t, sympy.sympify((1, 2))) == -sympy.oo
    for V, bounds, least in (
        (3 + 2 / (t**2 + 1), (1, sympy.oo), 3),
        ((t - 4) ** 2 + sympy.Rational(1, 3), (-sympy.oo, sympy.oo), sympy.Rational(1, 3)),
        (t**3 - 50, (-3, 5), -77),
    ):
        below = _number_below(V, t, sympy.sympify(bounds))
        assert least - 200 < below <= least
        assert below == sympy.floor(below)


def test_the_height_of_a_picture() -> None:
    """From the ground level less the distance of levels up to a barrier, where that is near: 5 + 3/10 of the distance, 3/2."""

    def drawn(barrier: float) -> Any:
        levels = [DrawnLevel(E, lambda x: np.exp(-(x**2)), f"{E}") for E in (1.0, 2.5)]

        def V(x: Any) -> Any:
            return np.where(np.abs(x) < 1, 0.25, barrier)

        figure = draw_levels(V, levels, (-3.0, 3.0), variable="x", title="t", impulses=[])
        (axes,) = figure.axes
        assert axes.get_xlim() == pytest.approx((-2.43425, 2.43425))
        return axes.get_ylim()

    assert drawn(5.0) == pytest.approx((-0.5, 5.45))
    assert drawn(6.9) == pytest.approx((-0.5, 7.35))
    assert drawn(7.1) == pytest.approx((-0.5, 4))


def test_conditions_that_exclude_or_imply_each_other() -> None:
    """a > 5 and a < 2 exclude each other, and so does n + 1 < 0 alone; a > 5 implies a > 2, and 3 a - n > 1 is solved for n."""
    signs = Signs(Assumptions(), ["a", "b"])
    a, b, number = signs.symbols["a"], signs.symbols["b"], signs.n
    assert _are_contradictory([a > 5, a < 2], signs)
    assert _are_contradictory([number + 1 < 0], signs)
    assert not _are_contradictory([a > 2, a < 5], signs)
    assert not _are_contradictory([a > 5, b < 2], signs)
    assert tidied([a > 5, a < 2], signs) == (sympy.false,)
    assert tidied([a > 2, a > 5, number >= 0, 3 * a - number > 1], signs) == (a > 5, number < 3 * a - 1)


@pytest.mark.parametrize(
    ("V", "domain", "place", "hint"),
    [
        ("1/(x - 2)^2", (0, 3), "2", "(2, 3)"),
        ("1/(cosh(x) - 2)", (0, 3), "log(sqrt(3) + 2)", '("log(sqrt(3) + 2)", 3)'),
        ("1/sin(2*x + 1)^2", (0, 2), "-1/2 + pi/2", '("-1/2 + pi/2", 2)'),
        ("tan(x)^2", (1, 5), "3*pi/2", '("3*pi/2", 5)'),
    ],
)
def test_a_pole_inside_of_the_domain(V: str, domain: Any, place: str, hint: str) -> None:
    with pytest.raises(kovacic.InputError) as refused:
        kovacic.spectrum(V, domain=domain)
    assert str(refused.value).splitlines() == [
        f"V isn't regular at x = {place}, inside the domain",
        f"  hint: choose a domain without a pole inside: domain={hint}",
    ]


def test_conditions_are_solved_for_the_number_of_a_level() -> None:
    """n^2 + 3 n < 12 is (n + 3/2)^2 < 57/4, and s + t, s - t > 0 is s > |t|."""
    signs = Signs(Assumptions(), ["a", "b"])
    a, b, number = signs.symbols["a"], signs.symbols["b"], signs.n
    half = sympy.Rational(1, 2)
    for conditions, solved in (
        ([12 - number**2 - 3 * number > 0], (number + 3 * half) ** 2 < 57 * half**2),
        ([31 - 2 * number**2 - 5 * number >= 0], (number + 5 * half**2) ** 2 <= 273 * half**4),
        ([a - number**2 - 3 * number - 2 > 0], a > (number + 1) * (number + 2)),
        ([5 * a - 3 * number > 2], number < (5 * a - 2) / 3),
        ([7 * a + 2 * number * b > 3], a > (3 - 2 * number * b) / 7),
        ([a - number + b / (a - number) > 0, a - number - b / (a - number) > 0], number < a - sympy.sqrt(sympy.Abs(b))),
    ):
        (found,) = tidied(conditions, signs)
        assert found.func == solved.func
        assert sympy.expand(found.lhs - solved.lhs) == sympy.expand(found.rhs - solved.rhs) == 0
