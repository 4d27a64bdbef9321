"""The methods of an answer that import their part of the package when they are called."""

from __future__ import annotations

import pickle

import pytest

import kovacic


def test_values_of_a_solution_by_its_own_method() -> None:
    answer = kovacic.solve("x^2 + 3")
    value = answer.at(2, x0=1, y0=1, dy0=0, digits=30)
    assert value == kovacic.evaluate("x^2 + 3", 2, x0=1, y0=1, dy0=0, digits=30) or value.overlaps(
        kovacic.evaluate("x^2 + 3", 2, x0=1, y0=1, dy0=0, digits=30)
    )
    assert len(answer.at([2, 3], x0=1, y0=1, dy0=0)) == 2


def test_a_vectorised_function_and_a_figure() -> None:
    answer = kovacic.solve("x^2 + 3")
    f = answer.lambdify(interval=(1, 3))
    ratio = f([2.0])[0] / f([1.5])[0]
    assert ratio == pytest.approx(2 / 1.5 * 2.718281828459045 ** ((4 - 2.25) / 2), rel=1e-12)
    figure = answer.plot(1, 2, x0=1, points=20)
    assert figure.axes[0].get_xlabel() == "x"


def test_an_answer_pickles_after_its_parts_were_used() -> None:
    answer = kovacic.solve("1/x - 3/(16*x^2)")
    assert len(answer.solutions) == 2
    assert str(answer.group)
    copy = pickle.loads(pickle.dumps(answer))
    assert copy == answer
    assert copy.verify()
    assert copy.solutions == answer.solutions
