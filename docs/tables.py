"""Tables made when the pages are built, from the results of a benchmark or by the program itself.

A page takes one by `<!-- table: NAME -->` on a line of its own.
"""

from __future__ import annotations

import json
import re
import runpy
import shlex
from collections.abc import Callable
from itertools import groupby
from pathlib import Path
from typing import Any

import kovacic

RESULTS = Path(__file__).parent.parent / "benchmarks" / "results"
POTENTIALS = Path(__file__).parent.parent / "tests" / "shared" / "potentials.py"
SYSTEMS = ("kovacic.dsolve", "sympy.dsolve")


def problems(results: str) -> list[dict[str, Any]]:
    """What `benchmarks/dsolve.py` wrote: a problem each, with the answers of all systems."""
    found: list[dict[str, Any]] = json.loads((RESULTS / f"{results}.json").read_text(encoding="utf-8"))["problems"]
    return found


def sympy_tests() -> str:
    """Every test equation of SymPy's ODE module with the two answers, under the test that has it."""
    lines: list[str] = []
    for test, group in groupby(problems("dsolve_sympy"), lambda problem: re.sub(":(?! )", ": ", problem["source"])):
        lines += [f"### `{test}`", "", "```{table}", ":class: equations", ":widths: 30 35 35", ""]
        lines += ["| | kovacic.dsolve | sympy.dsolve |", "| --- | --- | --- |"]
        for problem in group:
            answers = [_answer(problem["answers"][system]) for system in SYSTEMS]
            lines.append("| " + " | ".join([_code(problem["equation"]), *answers]) + " |")
        lines += ["```", ""]
    return "\n".join(lines)


def _answer(entry: dict[str, Any]) -> str:
    text = entry.get("answer", "")
    constants = set(re.findall(r"\bC\d\b", text))
    verdict = {"right": "", "right with integrals": "an integral is left: "}.get(entry["verdict"], entry["verdict"])
    if verdict == "wrong" and len(constants) > 2:
        verdict = f"not a general solution, {len(constants)} constants: "
    return verdict + (_code(text) if text else "")


def _code(text: str) -> str:
    return "`" + text.replace("|", "\\|") + "`"


def potentials() -> str:
    """A section for each solvable potential that the tests know: its source, the command, and the printed spectrum."""
    lines: list[str] = []
    known = runpy.run_path(str(POTENTIALS))
    for row in known["TABLE"] + known["MORE"]:
        spectrum = kovacic.spectrum(row.V, domain=row.domain, assume=row.assume)
        name = row.name[0].upper() + row.name[1:]
        lines += [f"## {name}", "", f"{row.source}.", "", "```console", f"$ {_command(row)}", str(spectrum), "```", ""]
    return "\n".join(lines)


def _command(row: Any) -> str:
    left, right = row.domain
    command = f"kovacic spectrum {shlex.quote(row.V)}"
    if left != "-oo":
        command += f" --from {shlex.quote(str(left))}"
    if right != "oo":
        command += f" --to {shlex.quote(str(right))}"
    for name, known in row.assume.items():
        command += " --assume " + shlex.quote(f"{name}{known}" if known.startswith(">") else f"{name}={known}")
    return command


TABLES: dict[str, Callable[[], str]] = {"sympy_tests": sympy_tests, "potentials": potentials}


def filled(page: str) -> str:
    """The page with its tables."""
    return re.sub(r"^<!-- table: (\w+) -->$", lambda match: TABLES[match[1]](), page, flags=re.MULTILINE)
