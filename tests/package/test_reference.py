"""The built pages have every public attribute that a user can reach, the levels of each potential, the notebook's outputs.

Build them first: `sphinx-build -b html docs build/html`, then `KOVACIC_PAGES=build/html pytest -m long` this file.
"""

from __future__ import annotations

import html
import inspect
import os
import re
import warnings
import zlib
from collections.abc import Iterator
from enum import Enum
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import potentials
import pytest

import kovacic
import kovacic.ball

#: What the page of the types says isn't public: data behind answers, of which no attribute is promised.
INTERNAL = {
    "Assumptions",
    "Carried",
    "Congruence",
    "Decision",
    "ExactPoint",
    "Exponential",
    "FunctionPoly",
    "NumericProblem",
    "Math",
    "Signed",
    "Theory",
    "ParameterPoint",
    "Product",
    "Pullback",
    "RationalFunction",
    "RationalField",
    "RationalPoly",
    "Region",
    "RootFactor",
    "Triangular",
    "Diagonal",
    "GroupClaim",
    "FunctionField",
    "AlgebraicField",
    "ExtensionPoly",
    "NecessaryCondition",
    "NoInvariant",
    "NoRationalOmega",
    "CurveFunction",
    "Conjugate",
}


def answers() -> Iterator[tuple[str, Any]]:
    """What the public functions return, by how it was got."""
    bessel = "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    solvable = kovacic.solve("x^2 + 3")
    yield "solve", solvable
    yield "solve, an equation", kovacic.solve(bessel)
    yield "solve, an equation in exp(x)", kovacic.solve("y'' = exp(2*x)*y")
    yield "solve, none", kovacic.solve("x")
    yield "solve, case 2", kovacic.solve("1/x - 3/(16*x^2)")
    yield "solve, parameters", kovacic.solve("n*x")
    yield "conditions", kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
    yield "check", kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").check(5)
    yield "evaluate", kovacic.evaluate("x", 1, x0=0, y0=1, dy0=0)
    yield "dsolve", kovacic.dsolve("y'' + y = 0")
    yield "decide", kovacic.decide("x")
    yield "verify", solvable.verify()
    yield "compare_with_monodromy", solvable.compare_with_monodromy()
    yield "solve_riccati", kovacic.solve_riccati("w' = 1 + w^2")
    yield "monodromy", kovacic.monodromy("-2/(9*x^2)")
    yield "solve_many", list(kovacic.solve_many(["x"], jobs=1))
    yield "RollingBall", kovacic.ball.RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/3")
    yield "on_sphere", kovacic.ball.RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/3").on_sphere(2)
    if find_spec("scipy") is not None:
        yield "lambdify", solvable.lambdify(interval=(0, 1))
        yield "tabulate", kovacic.tabulate("x", 0, 1, x0=0, y0=1, dy0=0)


def public_names(thing: object) -> list[str]:
    inherited = {*dir(tuple), *dir(str)} if isinstance(thing, tuple | str) else set()
    if isinstance(thing, Enum):
        inherited |= {"name", "value"}
    return [name for name in dir(thing) if name.isidentifier() and name[0] != "_" and name not in inherited]


@cache
def reached() -> dict[type, tuple[str, object]]:
    """The package's types that are reached from answers by public attributes, each with a way to it and an example."""
    found: dict[type, tuple[str, object]] = {}
    waiting = list(answers())
    while waiting:
        way, thing = waiting.pop()
        if isinstance(thing, tuple | list) and not hasattr(thing, "_fields"):
            waiting += [(f"{way}[{k}]", part) for k, part in enumerate(thing)]
        kind = type(thing)
        if not kind.__module__.startswith("kovacic") or kind in found:
            continue
        found[kind] = way, thing
        if kind.__name__ in INTERNAL:
            continue
        for name in public_names(thing):
            try:
                value = getattr(thing, name)
            except (TypeError, OverflowError):  # a complex ball has no order
                continue
            if not inspect.isroutine(value):
                waiting.append((f"{way}.{name}", value))
    return found


def documented(pages: Path) -> set[str]:
    """The names that the built pages have, by the inventory that other projects link with."""
    data = (pages / "objects.inv").read_bytes().split(b"\n", 4)[4]
    lines = zlib.decompress(data).decode("utf-8").splitlines()
    return {line.split(" ")[0] for line in lines if re.search(r" py:\w+ ", line)}


@pytest.fixture
def pages() -> Path:
    if "KOVACIC_PAGES" not in os.environ:
        pytest.skip("KOVACIC_PAGES isn't set to the folder of the built pages")
    return Path(os.environ["KOVACIC_PAGES"])


@pytest.mark.long
def test_every_public_attribute_is_on_the_built_pages(pages: Path) -> None:
    names = documented(pages)
    missing = []
    for kind, (way, thing) in reached().items():
        if kind.__name__ in INTERNAL:
            continue
        homes = [f"{base.__module__}.{base.__qualname__}" for base in kind.__mro__]
        homes += [f"kovacic.{base.__qualname__}" for base in kind.__mro__]
        homes += [f"{base.__module__.rpartition('.')[0]}.{base.__qualname__}" for base in kind.__mro__]
        if not any(home in names for home in homes):
            missing.append(f"{kind.__qualname__} ({way})")
            continue
        wanted = set(public_names(thing)) - described(
            kind
        )  # what a class is made from is described in its list of parameters
        missing += [f"{kind.__qualname__}.{n} ({way})" for n in wanted if not any(f"{h}.{n}" in names for h in homes)]
    assert missing == []


@pytest.mark.long
def test_every_public_function_and_class_is_on_the_built_pages(pages: Path) -> None:
    names = documented(pages)
    assert [name for name in kovacic.__all__ if f"kovacic.{name}" not in names] == []
    assert [
        name for name in kovacic.ball.__all__ if name not in ("U", "X") and f"kovacic.ball.{name}" not in names
    ] == []


@pytest.mark.long
def test_each_solvable_potential_has_a_section_with_its_levels_on_the_built_pages(pages: Path) -> None:
    sections = (pages / "howto" / "potentials.html").read_text("utf-8").split("<h2>")[1:]
    for row, section in zip(potentials.TABLE + potentials.MORE, sections, strict=True):
        shown = html.unescape(re.sub("<[^>]+>", "", section))
        assert row.source in shown
        assert "  E_n = " in shown
        assert "proven to be all eigenvalues" in shown


@pytest.mark.long
def test_the_notebook_shows_answers_and_pictures_on_the_built_pages(pages: Path) -> None:
    """It ran from top to bottom, or there were no pages."""
    shown = (pages / "notebook.html").read_text("utf-8").partition("<article")[2].partition("</article>")[0]
    tables = re.split('class="output text_html"', shown)[1:]
    assert len(tables) == 3
    assert "no Liouvillian solution exists" in tables[1]
    assert "<svg" in tables[2]
    pictures = re.findall(r'<img [^>]*src="([^"]+)"', shown)
    assert [(pages / picture).read_bytes()[:4] for picture in pictures] == [b"\x89PNG"] * 2


def functions() -> Iterator[Any]:
    """The public functions, and the public methods of the public classes."""
    for name in kovacic.__all__:
        thing = getattr(kovacic, name)
        if inspect.isfunction(thing):
            yield thing
    for kind in reached():
        if kind.__name__ not in INTERNAL:
            yield from (value for name, value in vars(kind).items() if inspect.isfunction(value) and name[0] != "_")


def described(function: Any) -> set[str]:
    """The names in the list of parameters of a docstring."""
    text = inspect.getdoc(function) or ""
    section = re.search(r"^Parameters\n-+\n((?:.+\n|\n(?=\w.* :|    ))*)", text + "\n", re.MULTILINE)
    lines = [] if section is None else re.findall(r"^(\w.*)$", section[1], re.MULTILINE)
    return {name for line in lines for name in line.partition(" :")[0].split(", ")}


@pytest.mark.long
def test_every_parameter_is_described() -> None:
    """One by one in the docstring's list of parameters."""
    missing = []
    for function in functions():
        parameters = inspect.signature(function).parameters.values()
        named = {p.name for p in parameters if p.kind is not p.VAR_KEYWORD} - {"self"}
        missing += [f"{function.__qualname__}: {name}" for name in sorted(named - described(function))]
    assert missing == []


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
def test_types_of_answers_show_themselves() -> None:
    """Each has a representation of its own in a line or a few, without addresses."""
    for kind, (way, thing) in reached().items():
        if kind.__name__ not in INTERNAL:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                shown = repr(thing)
            assert " at 0x" not in shown, way
            assert kind.__name__ in shown or shown.startswith("y"), way
            assert len(shown) < 2000, way


SHOWN_IN_NOTEBOOKS = {
    "Ball",
    "BallOnSphere",
    "Conditions",
    "Group",
    "LocalMonodromy",
    "ParameterRegion",
    "ProductForm",
    "RatFunc",
    "Record",
    "RiccatiSolutions",
    "Solution",
    "SpecialFunctions",
    "TabulatedFunction",
    "Verification",
}


@pytest.mark.long
def test_types_of_answers_have_views_for_notebooks() -> None:
    """LaTeX between dollar signs with balanced braces, or HTML in which every element ends."""
    views = {kind.__name__: thing for kind, (_, thing) in reached().items()}
    for name in SHOWN_IN_NOTEBOOKS & set(views):
        thing = views[name]
        if hasattr(thing, "_repr_latex_"):
            shown = thing._repr_latex_()
            assert shown[0] == shown[-1] == "$", name
            assert shown.count("{") == shown.count("}"), name
            assert shown.count(r"\begin") == shown.count(r"\end"), name
        else:
            page = ElementTree.fromstring(f"<div>{thing._repr_html_()}</div>")
            assert "".join(page.itertext()).strip(), name
    assert len(SHOWN_IN_NOTEBOOKS & set(views)) >= len(SHOWN_IN_NOTEBOOKS) - 2  # the functions need NumPy
