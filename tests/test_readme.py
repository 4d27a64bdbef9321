"""The README shows what really happens."""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path

import pytest

import kovacic
from kovacic.cli import main

README = Path(kovacic.__file__).parent.parent / "README.md"
TEXT = README.read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)


def sessions() -> list[tuple[str, str]]:
    """Commands of the console blocks with the output that is shown under them."""
    found = []
    for block in blocks("console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, output = part.partition("\n")
            found.append((command, output))
    return found


def test_there_are_two_commands_to_paste_of_one_line_each() -> None:
    commands = blocks("sh")
    assert len(commands) == 2
    assert all(command.count("\n") == 1 for command in commands)
    install, test = commands
    assert "kovacic solve" in install
    assert "pytest" in test


@pytest.mark.parametrize(("command", "output"), sessions(), ids=[command for command, _ in sessions()])
def test_shell_sessions(command: str, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    program, *arguments = shlex.split(command)
    assert program == "kovacic"
    main.run(arguments)
    shown = capsys.readouterr()
    assert shown.out + shown.err == output


def test_python_sessions() -> None:
    (block,) = blocks("python")
    test = doctest.DocTestParser().get_doctest(block, {}, "README", str(README), 0)
    assert test.examples
    runner = doctest.DocTestRunner()
    runner.run(test)
    assert runner.failures == 0


def test_the_equation_of_the_first_command_is_solved(capsys: pytest.CaptureFixture[str]) -> None:
    command = blocks("sh")[0]
    arguments = shlex.split(command[command.index("kovacic solve") :])[1:]
    assert main.run(arguments) == 0
    assert "case 3" in capsys.readouterr().out


def test_files_that_it_mentions_exist() -> None:
    for name in ("kovacic/views/schema.json", "kovacic/verify", "examples", "CITATION.cff", "LICENSE"):
        assert (README.parent / name).exists()
