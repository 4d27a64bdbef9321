"""FLINT's precision is global: one module sets it, under one lock, and threads leave it as it was."""

from __future__ import annotations

import ast
import threading
from pathlib import Path
from typing import Any

import flint
import pytest

import kovacic
from kovacic.algebra.precision import series_length, working_precision

PACKAGE = Path(kovacic.__file__).parent
#: The module that sets it, and the one that shares nothing with the package and says that it is for one thread.
SETTERS = {PACKAGE / "algebra" / "precision.py", PACKAGE / "checker.py"}


def setters(source: str) -> set[str]:
    """What in it changes FLINT's context: a method that does, an assignment to an attribute of it."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Attribute(value=ast.Name(id="ctx") | ast.Attribute(value=ast.Name(id="flint"), attr="ctx")):
                is_method = node.attr in ("workprec", "workdps", "extraprec", "extradps")
                if is_method or isinstance(node.ctx, ast.Store):
                    found.add(ast.unparse(node))
    return found


def test_one_module_sets_the_precision() -> None:
    assert setters("with ctx.workprec(3): pass\nflint.ctx.cap = 2") == {"ctx.workprec", "flint.ctx.cap"}
    for path in PACKAGE.rglob("*.py"):
        source = path.read_text(encoding="utf-8")
        assert path in SETTERS or "ctx" not in source or not setters(source), path


def test_it_is_what_it_was_after_an_error() -> None:
    before = flint.ctx.prec, flint.ctx.cap
    for change in (working_precision(100), series_length(3)):
        with pytest.raises(ValueError, match="inside"), change:
            raise ValueError("inside")
    assert (flint.ctx.prec, flint.ctx.cap) == before


def test_threads_leave_the_precision_as_it_was() -> None:
    """Answers of different rooms side by side; within a block no other precision is seen."""
    before = flint.ctx.prec
    seen: set[int] = set()
    failures: list[BaseException] = []

    def values() -> None:
        for k in range(1, 9):
            kovacic.evaluate("y'' + (2 + cos(x))*y = 0", f"{k}/8", x0=0, y0=1, dy0=0, digits=15 + 10 * k)

    def statements() -> None:
        kovacic.conditions("n*(n+1)/x^2-1", assume={"n": "<sqrt(2)"})

    def closed_forms() -> None:
        assert kovacic.solve("(sqrt(2) + 2)/x^2").closed_form is not None

    def watch() -> None:
        for _ in range(300):
            with working_precision(100):
                seen.add(flint.ctx.prec)

    def guarded(work: Any) -> None:
        try:
            work()
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=guarded, args=(work,)) for work in (values, statements, closed_forms, watch)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    assert seen == {100}
    assert flint.ctx.prec == before
