"""`--help` of every command: it has examples, these run on every system, and what they print can be written in any encoding."""

from __future__ import annotations

import io
import re
import shlex
import sys
from pathlib import Path

import pytest
from build import COMMANDS, parametrize, run, run_and_exit

GIVEN = {"generate": "x^2 + 3\nx\n"}  # what programs of the user's print
FILES = {"equations.jsonl": '"x^2 + 3"\n{"S": "x", "id": 7}\n'}


def shown(capsys: pytest.CaptureFixture[str], *command: str) -> str:
    capsys.readouterr()
    assert run([*command, "--help"]) == 0
    return capsys.readouterr().out


def examples(text: str) -> list[str]:
    found: list[str] = re.findall(r"^  ((?:\w+ \| )?kovacic [a-z].*)$", text, re.MULTILINE)
    return found if Path("/proc/self/statm").exists() else [text.replace("--memory 500 ", "") for text in found]


def output_of(example: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> str:
    """The last output of a pipeline in which commands of ours are called one after the other."""
    output = ""
    for stage in re.split(r" \| ", example):
        program, *arguments = shlex.split(stage)
        if program == "kovacic":
            target = None
            if ">" in arguments:
                *arguments, _, target = arguments
            monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(output.encode()), encoding="utf-8"))
            assert run(arguments) in (0, 3)
            output = capsys.readouterr().out
            if target is not None:
                Path(target).write_text(output, encoding="ascii")  # in which every encoding agrees
        elif program in GIVEN:
            output = GIVEN[program]
    return output


#: The derivation of the ball's equations and its motion, which take seconds.
LONG = [pytest.param("ball", 1, 4, marks=pytest.mark.slow)]


@parametrize(
    ("command", "first", "last"),
    [*((name, 0, 1 if name == "ball" else None) for name in COMMANDS), *LONG],
    ordinary=0,
    long=(0, 7, 11),
)
def test_the_examples_run(
    command: str,
    first: int,
    last: int | None,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    found = examples(shown(capsys, command))[first:last]
    assert found
    assert all(f"kovacic {command}" in example for example in found)
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        Path(name).write_text(text, encoding="utf-8")
    for example in found:
        output = output_of(example, capsys, monkeypatch)
        written = [word for word in shlex.split(example) if re.search(r"\.(html|json|jsonl|png)$", word)]
        assert output or written, example
        for name in written:
            assert Path(name).stat().st_size > 0, example


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_fits_on_a_screen_of_80_columns(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert max(map(len, shown(capsys, *filter(None, [command])).splitlines())) <= 80


def test_the_examples_of_the_program_run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    found = examples(shown(capsys))
    assert len(found) == 2
    assert all(output_of(example, capsys, monkeypatch) for example in found)


@pytest.mark.long
@pytest.mark.parametrize("encoding", ["cp1252", "ascii"])
def test_files_and_pipes_are_utf_8_whatever_the_system_s_encoding_is(
    encoding: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Windows' encoding has no Greek letters."""
    for command, given, wanted in (
        (["solve", "-"], "α*x^2".encode(), "y'' = α x^2 y"),
        (["solve", "--json", "ä*x^2"], b"", '"input": "ä*x^2"'),
        (["solve", "-"], b"x^\xff", ""),
        (["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"], b"", "±"),
        (["explain", "--format", "html", "x^2 + 3"], b"", "<math"),
    ):
        streams = [io.TextIOWrapper(io.BytesIO(data), encoding=encoding) for data in (given, b"", b"")]
        for name, stream in zip(("stdin", "stdout", "stderr"), streams, strict=True):
            monkeypatch.setattr(sys, name, stream)
        with pytest.raises(SystemExit) as ending:
            run_and_exit(command)
        output = streams[1].buffer.getvalue().decode("utf-8")
        assert ending.value.code == (0 if wanted else 2)
        assert wanted in output
        assert output.isascii() or "html" not in command
