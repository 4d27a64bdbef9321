"""What the README and the pages of `docs/` show: their code blocks, and sessions in the shell with their outputs."""

from __future__ import annotations

import doctest
import re
import shlex
import warnings
from pathlib import Path

import pytest
from build import run

import kovacic

ROOT = Path(kovacic.__file__).parent.parent
README = ROOT / "README.md"
PAGES = sorted((ROOT / "docs").rglob("*.md"))
#: A session may show the exit status as well.
STATUS = '; echo "status $?"'


def blocks(language: str, page: Path = README) -> list[str]:
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def sessions(*pages: Path) -> list[tuple[str, str, str]]:
    """Page, command, and the output that is shown under it, of the console blocks."""
    found = []
    for page in pages:
        for block in blocks("console", page):
            for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
                command, _, output = part.partition("\n")
                found.append((page.name, command, output))
    return found


def check_command(command: str, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    program, *arguments = shlex.split(command.removesuffix(STATUS))
    assert program == "kovacic"
    with warnings.catch_warnings(record=True, action="always") as noticed:
        status = run(arguments)
    shown = capsys.readouterr()
    found = shown.out + "".join(f"kovacic: {warning.message}\n".replace("**", "^") for warning in noticed) + shown.err
    if command.endswith(STATUS):
        found += f"status {status}\n"
    assert found == output, f"{command}\nprints\n{found}"


def check_python(page: Path) -> None:
    text = "\n".join(block for block in blocks("python", page) if block.startswith(">>>"))
    test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(test)
    assert runner.failures == 0


def check_links(page: Path) -> None:
    """Relative links and names of files in the repository lead somewhere."""
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
        if not target.startswith(("http", "mailto")) and "_static/pictures/" not in target:
            assert (page.parent / target).exists(), target
    for name in re.findall(r"`((?:examples|benchmarks|kovacic|tests|docs)/[\w/.-]+)`", text):
        assert (ROOT / name).exists(), name
