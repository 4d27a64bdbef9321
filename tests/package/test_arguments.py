"""No argument is ignored: what a public function doesn't use it refuses, by its own name."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import pytest
import sympy
from build import parametrize, sample

import kovacic
from kovacic import InputError, Limits

START: dict[str, Any] = {"x0": 0, "y0": 1, "dy0": 0}
POTENTIAL = kovacic.solve("x^2 + 3")
CONDITIONS = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")

#: A public function, positional arguments, keywords that it takes.
CALLS: dict[str, tuple[Callable[..., object], tuple[Any, ...], dict[str, Any]]] = {
    "solve": (kovacic.solve, ("x",), {"var": "x", "assume": None, "limits": None}),
    "decide": (kovacic.decide, ("x",), {"var": "x", "assume": None, "limits": None}),
    "conditions": (kovacic.conditions, ("n*x^2 + 1",), {"var": "x", "max_degree": 0, "limits": None}),
    "dsolve": (kovacic.dsolve, ("y'' = y",), {"ics": {"y(0)": 1}, "var": "x", "limits": None}),
    "solve_riccati": (kovacic.solve_riccati, (1, 0, 1), {"var": "x", "limits": None}),
    "solve_many": (kovacic.solve_many, ([],), {"var": "x", "jobs": 1, "timeout": 5, "group": True, "limits": None}),
    "evaluate": (kovacic.evaluate, ("x", 1), {**START, "digits": 5, "method": "taylor", "derivative": True, "limits": None}),
    "connection_matrix": (kovacic.connection_matrix, ("x", [0, 1]), {"params": None, "digits": 5, "limits": None}),
    "monodromy": (kovacic.monodromy, ("-2/(9*x^2)",), {"params": None, "digits": 5, "limits": None}),
    "tabulate": (kovacic.tabulate, ("x", 0, 1), {**START, "careful": False, "params": None, "limits": None}),
    "at": (POTENTIAL.at, (1,), {**START, "digits": 5, "derivative": True, "path": None, "limits": None}),
    "lambdify": (POTENTIAL.lambdify, (), {"interval": (0, 1), "which": 0, "check": False, "limits": None}),
    "prepared": (POTENTIAL.prepared, (), {**START, "digits": 5, "path": None, "limits": None}),
    "plot": (POTENTIAL.plot, (0, 1), {"points": 2, "digits": 5, "x0": 0, "title": "y", "limits": None}),
    "compare_with_monodromy": (POTENTIAL.compare_with_monodromy, (), {"digits": 5, "limits": None}),
    "to_json": (POTENTIAL.to_json, (), {"full": False}),
    "explain": (POTENTIAL.explain, (), {"format": "text", "solutions": False}),
    "citation": (POTENTIAL.citation, (), {"style": "text"}),
    "check": (CONDITIONS.check, (1,), {"seed": 2}),
    "Conditions.plot": (CONDITIONS.plot, (), {"ranges": [(0, 1)], "steps": 2, "fixed": None}),
}  # fmt: skip


def neighbours(word: str) -> set[str]:
    """With a letter left out, doubled, or changed with the next one."""
    found = set()
    for k in range(len(word)):
        found |= {word[:k] + word[k + 1 :], word[:k] + word[k] + word[k:]}
        found.add(word[:k] + word[k + 1 : k + 2] + word[k] + word[k + 2 :])
    return found - {word, ""}


@pytest.mark.filterwarnings("ignore::kovacic.AccuracyWarning")
@parametrize("name", CALLS, ordinary=5)
def test_a_misspelt_keyword_is_refused_by_the_function_that_was_called(name: str) -> None:
    function, positional, keywords = CALLS[name]
    function(*positional, **keywords)
    for keyword, value in keywords.items():
        for other in neighbours(keyword) - {*keywords, "a", "b", "c", "f", "x"}:
            called = name.replace("Conditions.", "(Conditions|ParametricAnswer).")  # where the data have the method
            with pytest.raises(TypeError, match=rf"\b{called}\(\) got an unexpected keyword argument '{other}'"):
                function(*positional, **keywords, **{other: value})


DOORS: dict[str, Callable[..., object]] = {
    "evaluate": lambda **given: kovacic.evaluate("-2/(9*x^2)", 2, **given),
    "prepared": lambda **given: kovacic.prepared("-2/(9*x^2)", **given)(2),
    "at": lambda **given: kovacic.solve("-2/(9*x^2)").at(2, **given),
    "Solution.prepared": lambda **given: kovacic.solve("-2/(9*x^2)").prepared(**given)(2),
    "tabulate": lambda **given: kovacic.tabulate("-2/(9*x^2)", 1, 3, **given)(2.0),
    "lambdify": lambda **given: kovacic.solve("-2/(9*x^2)").lambdify(interval=(1, 3), **given)(2.0),
    "plot": lambda **given: kovacic.solve("-2/(9*x^2)").plot(1, 3, points=4, **given).axes[0].get_lines()[0].get_ydata()[-1],
}  # fmt: skip


STARTS: list[dict[str, Any]] = [
    {"x0": 1, "y0": 2, "dy0": "1/3"},
    {"x0": 0, "which": "regular"},
    {"x0": 0, "frobenius": (1, 2)},
]


@parametrize(("door", "start"), product(DOORS, STARTS), ordinary=9)  # each door, each start
def test_an_object_says_what_its_fields_say_as_keywords(door: str, start: dict[str, Any]) -> None:
    call = DOORS[door]
    expected = str(call(**start))
    assert str(call(initial=kovacic.Start(**start))) == expected
    assert (
        str(call(initial=kovacic.Start(**{**start, "x0": 5}), x0=start["x0"])) == expected
    )  # a keyword replaces a field
    with pytest.raises(InputError, match=r"a kovacic\.Start is expected, not 'dict'"):
        call(initial=start)
    with pytest.raises(InputError, match=r"a kovacic\.Accuracy is expected, not 'int'"):
        call(accuracy=20, **start)
    wrong: Any = 5
    with pytest.raises(InputError, match=r"limits are a kovacic\.Limits"):
        call(accuracy=kovacic.Accuracy(limits=wrong), **start)
    if door in ("tabulate", "lambdify"):
        with pytest.raises(TypeError, match="unexpected keyword argument 'digits'"):
            call(accuracy=kovacic.Accuracy(digits=30), **start)
    else:
        accurate = {"digits": 30, "method": "taylor"}
        assert str(call(accuracy=kovacic.Accuracy(**accurate), **start)) == str(call(**accurate, **start))


@pytest.mark.parametrize(
    "start", [{"y0": 1, "dy0": 0}, {"which": "regular"}, {"which": "decaying"}, {"frobenius": (1, 0)}]
)
def test_a_start_needs_its_point(start: dict[str, Any]) -> None:
    for door in ("evaluate", "prepared", "at", "tabulate"):
        with pytest.raises(InputError, match="the point at which the solution starts is missing"):
            DOORS[door](**start)


@pytest.mark.parametrize("given", [{"seconds": 1}, 1, "seconds=1", {}, Limits])
@pytest.mark.parametrize("name", [name for name, (_, _, keywords) in CALLS.items() if "limits" in keywords])
def test_limits_are_limits(name: str, given: object) -> None:
    function, positional, keywords = CALLS[name]
    with pytest.raises(InputError, match=r"limits are a kovacic\.Limits"):
        function(*positional, **{**keywords, "limits": given})


@pytest.mark.parametrize("given", ["a", -1, float("nan"), True, b"1", 1j, [1]])
@pytest.mark.parametrize("name", list(Limits.__slots__))
def test_a_limit_is_a_number_that_isnt_negative(name: str, given: Any) -> None:
    with pytest.raises(InputError, match=f"the limit {name}"):
        Limits(**{name: given})


x = sympy.Symbol("x")
FORMS: dict[str, Any] = {
    "text": "x",
    "an equation": "y'' = x*y",
    "an Eq": sympy.Eq(sympy.Function("y")(x).diff(x, 2), x * sympy.Function("y")(x)),
    "an expression": x,
    "lists": ([0, 1], [1]),
    "a number": 2,
    "an Equation": kovacic.solve("y'' = x*y").equation,
}


@parametrize("value", ["x^2", 1, 0, x, "sin(x)"], ordinary=2)
@pytest.mark.parametrize("name", ["b", "c", "f"])
@pytest.mark.parametrize("form", FORMS)
def test_coefficients_beside_an_equation_are_refused(form: str, name: str, value: Any) -> None:
    with pytest.raises(InputError, match=f"one equation is expected, not both S and {name}"):
        kovacic.solve(FORMS[form], **{name: value})
    with pytest.raises(InputError, match="with at least a="):
        kovacic.solve(**{name: value})


UNUSED: dict[str, Callable[[], object]] = {
    "a text isn't many equations": lambda: kovacic.solve_many("x^2"),
    "nor are bytes": lambda: kovacic.solve_many(b"x^2"),
    "nor is one mapping": lambda: kovacic.solve_many({"S": "x^2"}),
    "the variable of an equation": lambda: kovacic.solve(kovacic.solve("y'' = x*y").equation, var="t"),
    "parameters that don't occur": lambda: kovacic.evaluate("x", 1, params={"n": 3}, **START),
    "assumptions on what doesn't occur": lambda: kovacic.solve("x", assume={"n": "integer"}),
    "no mapping": lambda: kovacic.solve("n*x", assume="n>0"),
    "nor is a text in dsolve": lambda: kovacic.dsolve("y' = n*y", assume="n>0"),
    "a value of what doesn't occur": lambda: kovacic.solve("x", assume={"n": 3}),
    "two starts": lambda: kovacic.evaluate("-2/(9*x^2)", 1, which="regular", **START),
    "a slope that decays": lambda: kovacic.evaluate("x", 1, x0=0, y0=1, dy0=1, which="decaying"),
    "values without a point": lambda: POTENTIAL.lambdify(interval=(0, 1), y0=1, dy0=0),
    "a number beside values": lambda: POTENTIAL.lambdify(interval=(0, 1), which=1, **START),
    "a picture of two starts": lambda: kovacic.solve("-2/(9*x^2)").plot(1, 2, x0=0, which="regular", y0=1, points=2),
    "ranges for other parameters": lambda: CONDITIONS.plot(ranges=[(0, 1), (0, 1)], steps=2),
    "a fixed parameter that varies": lambda: CONDITIONS.plot(fixed={"n": 1}, steps=2),
    "keys of a mapping": lambda: kovacic.evaluate("x", {1: 2}, **START),
    "a scheduler without a backend": lambda: kovacic.solve_many([], scheduler="tcp://127.0.0.1:1"),
    "no equation": lambda: kovacic.solve(),
    "None": lambda: kovacic.decide(None),
}  # fmt: skip


@pytest.mark.parametrize("case", UNUSED)
def test_what_isnt_used_is_refused(case: str) -> None:
    with pytest.raises(InputError):
        UNUSED[case]()


def test_the_decaying_solution_is_drawn_with_the_value_that_was_given() -> None:
    once, thrice = (sample("x", 0, 1, x0=0, which="decaying", y0=y0, points=2).arcs[0].y[0] for y0 in (1, 3))
    assert abs(thrice - 3 * once) < 1e-7


@pytest.mark.parametrize("given", [5, True, "a>0", ["a"], [("a", "positive")], sympy.nan])
@pytest.mark.parametrize("potential", ["a*x^2", "sqrt(a)*x^2", "log(2)*x^2", "sqrt(2)*sin(x)^2"])
def test_assumptions_on_a_potential_are_a_mapping(potential: str, given: Any) -> None:
    """Beside roots and logarithms as well, of which more is assumed."""
    with pytest.raises(InputError, match="assumptions are a mapping"):
        kovacic.spectrum(potential, assume=given)
