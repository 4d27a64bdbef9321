"""README and documentation show what really happens, and what they link to is there."""

from __future__ import annotations

import doctest
import json
import re
import shlex
from pathlib import Path

import pytest

import kovacic
from kovacic.cli import main

ROOT = Path(kovacic.__file__).parent.parent
README = ROOT / "README.md"
PAGES = [README, *sorted((ROOT / "docs").rglob("*.md"))]


def blocks(language: str, page: Path = README) -> list[str]:
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def sessions(page: Path) -> list[tuple[str, str]]:
    """Commands of the console blocks with the output that is shown under them."""
    found = []
    for block in blocks("console", page):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, output = part.partition("\n")
            found.append((command, output))
    return found


SESSIONS = [(page.relative_to(ROOT), *session) for page in PAGES for session in sessions(page)]


def test_there_are_two_commands_to_paste_of_one_line_each() -> None:
    commands = blocks("sh")
    assert len(commands) == 2
    assert all(command.count("\n") == 1 for command in commands)
    install, test = commands
    assert "kovacic solve" in install
    assert "pytest" in test


@pytest.mark.parametrize(("page", "command", "output"), SESSIONS, ids=[f"{p}: {command}" for p, command, _ in SESSIONS])
def test_shell_sessions(page: Path, command: str, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    program, *arguments = shlex.split(command)
    assert program == "kovacic"
    main.run(arguments)
    shown = capsys.readouterr()
    assert shown.out + shown.err == output


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_python_sessions(page: Path) -> None:
    text = "\n".join(block for block in blocks("python", page) if block.startswith(">>>"))
    test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(test)
    assert runner.failures == 0


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_each_page_starts_with_something_that_runs(page: Path) -> None:
    """A guide's first block is a command or a session (but for pages of pictures and lists)."""
    first = re.search(r"^```(\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    if page.name not in ("gallery.md", "first-uses.md", "json.md", "batches.md"):
        assert first is not None
        assert first[1] in ("sh", "console", "python")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_to_files_lead_somewhere(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
        if not target.startswith(("http", "mailto")) and "_static/pictures/" not in target:
            assert (page.parent / target).exists(), target
    for name in re.findall(r"`((?:examples|benchmarks|kovacic|tests|docs)/[\w/.-]+)`", text):
        assert (ROOT / name).exists(), name


def test_the_comparison_has_the_figures_of_its_file() -> None:
    """Each row of the table, counted anew from the benchmark's results."""
    rows = json.loads((ROOT / "benchmarks" / "results" / "peers.json").read_text(encoding="utf-8"))["rows"]
    solvable = {(r["corpus"], r["name"]) for r in rows if r["system"] == "kovacic" and r["outcome"] == "solved"}
    names = ["kovacic", "Maxima kovacicODE", "FriCAS solve", "giac kovacicsols", "SymPy dsolve", "SymPy solve_riccati"]
    expected = []
    for name in names:
        mine = [r for r in rows if r["system"] == name and (r["corpus"], r["name"]) in solvable]
        solved = [r["check"] for r in mine if r["outcome"] == "solved"]
        wrong_none = sum(r["outcome"] == "none" and r["check"] == "wrong" for r in mine)
        right, wrong = solved.count("right"), solved.count("wrong")
        unclear = len(solved) - right - wrong
        expected.append([right, unclear, wrong, wrong_none, len(mine) - len(solved) - wrong_none])
    table = re.findall(r"^\|.*?((?: \d+ \|){5})$", (ROOT / "docs" / "comparison.md").read_text("utf-8"), re.MULTILINE)
    assert [list(map(int, re.findall(r"\d+", row))) for row in table] == expected


def test_the_equation_of_the_first_command_is_solved(capsys: pytest.CaptureFixture[str]) -> None:
    command = blocks("sh")[0]
    arguments = shlex.split(command[command.index("kovacic solve") :])[1:]
    assert main.run(arguments) == 0
    assert "case 3" in capsys.readouterr().out
