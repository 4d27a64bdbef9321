"""The README shows what really happens, and what it links to is there."""

from __future__ import annotations

import shlex

import pytest
from build import run
from documents import README, blocks, check_command, check_links, check_python, sessions

SESSIONS = sessions(README)


def test_there_are_two_commands_to_paste_of_one_line_each() -> None:
    commands = blocks("sh")
    assert len(commands) == 2
    assert all(command.count("\n") == 1 for command in commands)
    install, test = commands
    assert "kovacic solve" in install
    assert "pytest" in test


@pytest.mark.parametrize(("page", "command", "output"), SESSIONS, ids=[command for _, command, _ in SESSIONS])
def test_shell_sessions(page: str, command: str, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    check_command(command, output, capsys)


def test_python_sessions() -> None:
    check_python(README)


def test_the_equation_of_the_first_command_is_solved(capsys: pytest.CaptureFixture[str]) -> None:
    command = blocks("sh")[0]
    arguments = shlex.split(command[command.index("kovacic solve") :])[1:]
    assert run(arguments) == 0
    assert "case 1" in capsys.readouterr().out


def test_files_that_it_mentions_exist() -> None:
    check_links(README)
