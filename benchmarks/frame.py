"""What the scripts of this folder share: their arguments, the line on the machine and the commit, their results, the README.

python benchmarks/frame.py      writes benchmarks/README.md: what each script answers, and from when its results are
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import platform
import subprocess
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import kovacic

HERE = Path(__file__).parent
RESULTS = HERE / "results"
#: Modules that scripts import, and no scripts themselves.
PARTS = {"frame", "families", "stability_families", "textbook_equations", "dsolve_problems"}

_INTRODUCTION = """# Benchmarks

Each script answers one question, and its head says how it measures. Results are in `results/`, as Markdown and JSON, with the
commit and the machine they were made with (`frame.py`). One that is older than the code it measures is made anew before it is
quoted. This page: `python benchmarks/frame.py`.

| script | question | result | made |
| --- | --- | --- | --- |
"""


def parser(doc: str | None) -> argparse.ArgumentParser:
    """The arguments of a script, with its head as help."""
    return argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)


def _git(*arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=HERE, capture_output=True, text=True, check=False)
    return done.stdout.strip()


def made() -> dict[str, str]:
    """When, from which code, and with what a result is made."""
    changed = ", with changes" if _git("status", "--porcelain", "--", "../kovacic") else ""
    return {
        "date": f"{datetime.now(tz=UTC):%Y-%m-%d}",
        "commit": _git("rev-parse", "--short", "HEAD") + changed,
        "kovacic": kovacic.__version__,
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} CPUs, load {os.getloadavg()[0]:.1f}",
    }


def line(**versions: str) -> str:
    """The same in words, with the versions of other packages."""
    now = made()
    others = "".join(f", {name} {version}" for name, version in versions.items())
    code = f"kovacic {now['kovacic']} ({now['commit']})"
    return f"Made on {now['date']}: {code}, Python {now['python']}{others}; {now['machine']}."


def table(head: list[str], rows: list[list[str]], align: str = "---") -> list[str]:
    """The lines of a table in Markdown; all columns but the first are aligned by `align`."""
    rule = "|".join(["---", *[align] * (len(head) - 1)])
    return [f"| {' | '.join(head)} |", f"|{rule}|", *(f"| {' | '.join(row)} |" for row in rows)]


def save(name: str, data: Any, text: str | None = None) -> None:
    """The results of a script: `data` as JSON, with `made` where it is an object, and the text as Markdown."""
    RESULTS.mkdir(exist_ok=True)
    if isinstance(data, dict):
        data = {"made": made(), **data}
    (RESULTS / f"{name}.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    if text is not None:
        (RESULTS / f"{name}.md").write_text(text.rstrip("\n") + "\n", encoding="utf-8")


def _when(result: Path) -> str:
    """Date and commit, from the result itself or else from the commit that brought it."""
    data = json.loads(result.read_text(encoding="utf-8"))
    known = data.get("made") if isinstance(data, dict) else None
    if known:
        return f"{known['date']}, {known['commit']}"
    return _git("log", "-1", "--format=%ad, %h", "--date=short", "--", str(result))


def readme() -> str:
    """The table of all scripts."""
    rows = []
    for script in sorted(HERE.glob("*.py")):
        if script.stem in PARTS:
            continue
        question = (ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "").split("\n\n")[0]
        result = RESULTS / f"{script.stem}.json"
        shown = result.with_suffix(".md") if result.with_suffix(".md").exists() else result
        link = f"[{shown.name}](results/{shown.name})" if result.exists() else "printed"
        when = _when(result) if result.exists() else ""
        rows.append(f"| `{script.name}` | {' '.join(question.split())} | {link} | {when} |\n")
    return _INTRODUCTION + "".join(rows)


if __name__ == "__main__":
    (HERE / "README.md").write_text(readme(), encoding="utf-8")
