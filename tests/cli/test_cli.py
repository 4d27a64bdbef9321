"""The command as a user runs it: output, exit status, streams, signals."""

from __future__ import annotations

import json
import logging
import os
import pty
import re
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from build import COMMANDS, parametrize, run, run_and_exit
from processes import started

import kovacic
from kovacic import VerificationFailed, checker

COMMAND = [sys.executable, "-m", "kovacic"]
#: What a slow machine shows of the progress, until it is wiped away.
_BAR = re.compile(r"\r\x1b\[\?25l.*?\x1b\[2K", re.DOTALL)


def as_process(
    *arguments: str, stdin: str | None = None, env: dict[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*COMMAND, *arguments],
        input=stdin,
        stdin=subprocess.DEVNULL if stdin is None else None,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **(env or {})},
        timeout=60,
    )


@pytest.mark.long
def test_a_solution_in_words() -> None:
    done = as_process("solve", "x^2+3")
    assert done.returncode == 0
    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        "y'' = (x^2 + 3) y",
        "  Liouvillian solutions exist: case 1, omega = y'/y is rational",
        "  y1 = x*exp(x^2/2)",
        "  y2 = sqrt(pi)*x*exp(x^2/2)*erf(x) + exp(-x^2/2)",
        "  omega = (x^2 + 1)/x",
        "  verified: omega' + omega^2 = S holds exactly",
    ]
    done = as_process("solve", "x^2+3", "--no-solutions")
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "y'' = (x^2 + 3) y",
        "  Liouvillian solutions exist: case 1, omega = y'/y is rational",
        "  omega = (x^2 + 1)/x",
        "  y = exp(integral of omega dx)",
        "  verified: omega' + omega^2 = S holds exactly",
    ]


def test_the_solution_of_a_right_hand_side_and_of_initial_values(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "y'' + y = x"]) == 0
    assert "  y(x) = C1*cos(x) + C2*sin(x) + x" in capsys.readouterr().out.splitlines()
    assert run(["solve", "y'' = x*y + x"]) == 0
    assert "  y(x) = C1*airyai(x) + C2*airybi(x) - 1" in capsys.readouterr().out.splitlines()
    assert run(["solve", "x^5 + 1/x^3"]) == 0
    assert "no special function was found; searched: Airy's equation" in capsys.readouterr().out
    assert run(["solve", "y'' - (1 + exp(x))*y' = 0"]) == 0  # in t = exp(x) a product, exp(t)
    assert " = exp(exp(x))\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("former", "now"),
    [
        (["solve", "y'' + y = x", "--ics", "y(0)=1, y'(0)=0"], ["dsolve", "y'' + y = x, y(0)=1, y'(0)=0"]),
        (["solve", "-4", "--ics", "y(0)=0", "--ics", "y'(0)=1"], ["dsolve", "y'' = -4*y, y(0)=0, y'(0)=1"]),
        (["solve", "--explain", "2", "x"], ["explain", "2", "x"]),
    ],
)
def test_former_names_of_options_forward(former: list[str], now: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(former) == 0
    shown = capsys.readouterr()
    assert run(now) == 0
    assert capsys.readouterr() == shown


def test_the_verdict_does_not_wait_for_the_solutions(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where the closed forms are beyond the limits, the verdict has been printed, and stays."""

    def late(*_: object, **options: object) -> None:
        raise kovacic.LimitExceeded("the time limit is exceeded", limit="seconds")

    monkeypatch.setattr("kovacic.special.choice.chosen_form", late)
    run(["solve", "x^2 + 3"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "y'' = (x^2 + 3) y"
    assert lines[1].startswith("  Liouvillian solutions exist: case 1")


def test_dsolve_prints_the_general_solution(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "y'' - 3*y' + 2*y = 0"]) == 0
    assert capsys.readouterr().out == "y(x) = C1*exp(2*x) + C2*exp(x)\n"
    assert run(["dsolve", "y'' - 2*x*y' + 2*y = 0", "--ics", "y(0)=0, y'(0)=5"]) == 0
    assert capsys.readouterr().out == "y(x) = 5*x\n"
    assert run(["dsolve", "y'' + y = 0", "--latex", "--ics", "y(0)=1, y'(0)=0"]) == 0
    assert capsys.readouterr().out == "y{\\left(x \\right)} = \\cos{\\left(x \\right)}\n"


@pytest.mark.parametrize(
    ("equation", "start", "route"),
    [
        ("x^3 + 1", ["--x0", "0", "--y0", "1", "--dy0", "0"], "Taylor's method"),
        ("x", ["--x0", "-60", "--y0", "1", "--dy0", "0"], "FLINT's functions: Airy's equation in x"),
        ("x^2*y'' + x*y' + (x^2 + x^5)*y = 0", ["--x0", "0", "--regular"], "Taylor's method"),
    ],
)
def test_evaluate_says_its_route(
    equation: str, start: list[str], route: str, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["evaluate", equation, *start, "--at", "3"]
    assert run([*command, "-vv"]) == 0
    values, more = capsys.readouterr()
    assert more.startswith(f"kovacic: route: {route}\n")
    assert ("disc 1: centre " in more) == (route == "Taylor's method")
    assert run(command) == 0
    assert capsys.readouterr() == (values, "")
    assert run([*command, "-v"]) == 0
    again, said = capsys.readouterr()
    assert again == values
    assert said.startswith(f"kovacic: route: {route}")
    assert "kovacic: run 1, 73 bits: " in said


def test_a_wrong_command_leaves_no_watch_behind(capsys: pytest.CaptureFixture[str]) -> None:
    """The routes of the next command in the same process aren't said, on a stream that is closed by then."""
    assert run(["evaluate", "-v", "--x0", "-1", "--y0", "0", "--dy0", "0", "--at", "1"]) == 2
    capsys.readouterr()
    assert run(["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"]) == 0
    assert capsys.readouterr().err == ""
    assert not logging.getLogger("kovacic").isEnabledFor(logging.INFO)


def test_values_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "0,1", "--json"]) == 0
    first, second = map(json.loads, capsys.readouterr().out.splitlines())
    assert (first["schema"], first["input"], first["x"]) == (1, "x", "0")
    assert (float(first["y"]["re"]), float(first["dy"]["re"])) == (1, 0)
    assert second["x"] == "1"
    assert second["y"]["re"].startswith("1.17229997005793")
    assert second["dy"]["re"].startswith("0.534034834285834")
    assert float(second["y"]["radius"]) < 1e-15


def test_a_right_hand_side_without_solutions_of_the_homogeneous_equation_says_what_was_searched(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["solve", "y'' = (x^3 + 1)*y + exp(x)"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("  no special function was found; searched: Airy's equation") for line in lines)
    assert not any("wasn't written out" in line for line in lines)


def test_evaluate_prints_values_with_bounds(capsys: pytest.CaptureFixture[str]) -> None:
    """cosh, whose equation is y'' = y, at points in the given order."""
    assert run(["evaluate", "1", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1,1/2", "--at", "-0.25"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.partition(" = ")[0] for line in lines] == [
        "y(1)",
        "y'(1)",
        "y(1/2)",
        "y'(1/2)",
        "y(-0.25)",
        "y'(-0.25)",
    ]
    for line, value in zip(lines, ("1.543080634815243", "1.175201193643801", "1.127625965206380"), strict=False):
        assert line.partition(" = ")[2].startswith(value)
    assert "± " in lines[0]
    bessel = ["evaluate", "x^2*y'' + x*y' + x^2*y = 0", "--x0", "0", "--at", "1+I, 10", "--digits", "25"]
    assert run([*bessel, "--regular"]) == 0
    regular = capsys.readouterr().out
    assert regular.splitlines()[2].startswith("y(10) = -0.2459357644513483351977608")  # J0, DLMF 10.2
    assert run([*bessel, "--frobenius", "0,1"]) == 0
    assert capsys.readouterr().out == regular


def test_a_no_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "t"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:5] == [
        "y'' = t y",
        "  no Liouvillian solution exists: the Galois group is SL2(C)",
        "  in special functions, verified:",
        "    y1 = airyai(t)",
        "    y2 = airybi(t)",
    ]
    assert any("not case 1:" in line and "infinity" in line for line in lines)
    assert lines[-1] == "  verified: every exclusion was recomputed by independent code"


def test_a_polynomial_of_omega_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "1/t - 3/(16*t^2)"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:8] == [
        "y'' = ((16*t - 3)/(16*t^2)) y",
        "  Liouvillian solutions exist: case 2, omega = y'/y is algebraic of degree 2",
        "  y1 = t^(1/4)*exp(2*sqrt(t))",
        "  y2 = t^(1/4)*exp(-2*sqrt(t))",
        "  omega is a root w of",
        "      w^2",
        "      - (1/(2*t)) w",
        "      - ((16*t - 1)/(16*t^2)) = 0",
    ]
    assert lines[8].startswith("  not case 1: an irregular singular point is ramified")


@parametrize(
    ("S", "words"),
    [
        ("2", "omega = sqrt(2) or -sqrt(2)"),
        ("1/x - 3/(16*x^2)", "omega is a root w of"),
        ("(-5*x**2 - 27)/(36*x**4 - 72*x**2 + 36)", "algebraic of degree 4"),
        ("0.25*x^2 - 7/2", "note: 0.25 was taken exactly, as 1/4"),
        ("0", "y'' = 0"),
        ("-x^2", "y'' = -x^2 y"),
        ("3x", "y'' = 3 x y"),
        ("1/(4*c^2)", "where c1 is sqrt(2) or -sqrt(2)"),
        ("x^2 - 1001", "y1 = exp(-x^2/2)*hyper((-250,), (1/2,), x^2)"),
    ],
    ordinary=3,
)
def test_texts_of_other_answers(S: str, words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", S]) == 0
    assert words in capsys.readouterr().out


def test_json_is_one_object_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "--json", "x^2+3", "x", "-3/(16*x^2)+1/x"]) == 0
    answers = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(answer["input"], answer["case"]) for answer in answers] == [
        ("x^2+3", 1),
        ("x", None),
        ("-3/(16*x^2)+1/x", 2),
    ]


@pytest.mark.long
def test_standard_input_one_a_line() -> None:
    done = as_process("solve", "--json", "-", stdin="x\n\n# a comment\n  x^2+3  \n")
    assert [json.loads(line)["input"] for line in done.stdout.splitlines()] == ["x", "x^2+3"]
    assert as_process("solve", "-", stdin="").returncode == 0


def test_bad_input_does_not_stop_the_others(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "--json", "x", "log(x)", "x^2+3"]) == 2
    output, errors = capsys.readouterr()
    assert [json.loads(line)["status"] for line in output.splitlines()] == ["none", "error", "liouvillian"]
    assert "log(x) isn't a rational function of x" in errors
    assert "at position 0" in errors
    assert "Traceback" not in errors


@parametrize(
    ("arguments", "status"),
    [
        ([], 2),
        (["solve"], 2),
        (["solve", "x+"], 2),
        (["solve", "1/2x"], 2),
        (["solve", ""], 2),
        (["solve", "--nonsense", "x"], 2),
        (["nonsense"], 2),
        (["solve", "x", "--limit", "nonsense=3"], 2),
        (["solve", "x", "--limit", "degree=-3"], 2),
        (["solve", "x", "--limit", "degree=many"], 2),
        (["solve", "x", "--var", "2"], 2),
        (["solve", "x^100001"], 3),
        (["solve", "x^2-100001", "--limit", "unknown_degree=100"], 0),
        (["solve", "x^4+x^2+2002*x+1/4", "--limit", "unknown_degree=100"], 3),
        (["solve", "x^2-100001", "--limit", "seconds=0.000001"], 3),
        (["solve", "-x^2"], 0),
        (["solve", "--var", "y", "y^2"], 2),  # y is the unknown function
        (["solve", "x^2-7", "--limit", "degree=5", "--limit", "bits=50"], 0),
        (["solve", "--", "-x"], 0),
        (["solve", "x^2", "--ics", "y(1)=1"], 0),
        (["solve", "x^2", "--ics", "y(0)"], 2),
        (["solve", "x^2", "--ics", "y(0)=1, y(0)=2"], 2),
        (["dsolve", "y'' = x*y"], 0),
        (["dsolve", "y'' = (x^5 + 1/x^3)*y"], 0),
        (["dsolve", "y'' = x^2*y", "--ics", "y(0)=1"], 0),
        (["dsolve", "x^2"], 2),
        (["dsolve", "y'' + y = 0", "--ics", "y(0)=__import__('os')"], 2),
        (["dsolve", "x^2*y'' = 2*y", "--ics", "y(0)=1"], 2),
        (["dsolve", "y'' = (x^2-100001)*y", "--limit", "seconds=0.000001"], 3),
        (["evaluate", "x", "--x0", "0", "--y0", "1", "--at", "1"], 2),
        (["evaluate", "1/x", *["--x0", "1", "--y0", "1", "--dy0", "0", "--at", "-1"]], 2),
        (["evaluate", "1/x", *["--x0", "1", "--y0", "1", "--dy0", "0", "--at", "-1", "--path", "above"]], 0),
        (["evaluate", "x", *["--x0", "1", "--y0", "1", "--dy0", "0", "--at", "2", "--limit", "seconds=0.000001"]], 3),
        (["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "nan", "--at", "1"], 2),
        (["evaluate", "1/x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"], 2),
        (["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1,,2"], 2),
        (["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1", "--digits", "0"], 2),
        (["evaluate", "-x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "-1"], 0),
        (["--version"], 0),
        (["--help"], 0),
        (["solve", "--help"], 0),
    ],
    ids=str,
    ordinary=14,
)
def test_exit_status(arguments: list[str], status: int) -> None:
    assert run(arguments) == status


START = ["--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"]


@parametrize(
    ("command", "first"),
    [
        (["solve", "-j*x"], "y'' = -j x y"),
        (["solve", "-o"], "y'' = -o y"),
        (["solve", "-hx"], "y'' = -h x y"),
        (["solve", "-js*n*x", "--var", "j"], "y'' = -s n x j y"),
        (["solve", "-v^2", "--no-solutions"], "y'' = -v^2 y"),
        (["solve", "--no-solutions", "-vv"], "y'' = -v^2 y"),
        (["solve", "--", "--x"], "y'' = x y"),
        (["explain", "-o*x"], "Kovacic's algorithm for y'' = -o x y"),
        (["conditions", "-h*x"], "y'' = -h x y, parameters h"),
        (["evaluate", "-v", "--x0", "-1", "--y0", "0", "--dy0", "0", "--at", "1"], None),
        (["evaluate", *START, "--var", "v", "--", "-v"], "y(1) = 0.83881231016976"),
        (["evaluate", "-v*x", "--param", "v=1", *START], "y(1) = 0.83881231016976"),
        (["evaluate", "-omega^2*x", "--param", "omega=1", *START], "y(1) = 0.83881231016976"),
        (["scan", "-j*x", "-j", "1", "-q", "--format", "csv", "j=1,2"], "j,status,case"),
        (["scan", "-q*x", "-j1", "-q", "--format=csv", "q=1,2"], "q,status,case"),
        (["solve", "--jsn", "x"], None),
        (["solve", "--x"], None),
    ],
    ordinary=2,
    ids=str,
)
def test_what_is_not_exactly_an_option_is_an_expression(
    command: list[str], first: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    """And where an option was read, or something else went wrong, it is said how an expression is written there."""
    status = run(command)
    output, errors = capsys.readouterr()
    if first is None:
        assert status == 2
        assert "--" in errors
        assert "expression" in errors
    else:
        assert status == 0
        assert output.startswith(first)


@parametrize(
    "command",
    [
        ["evaluate", "x", "--x0", "0", "--y0", "1", "--at", "1"],
        ["evaluate", "x", "--x0", "0", "--at", "1"],
        ["evaluate", "a*x + b", *START],
        ["evaluate", "a*b", *START],
        ["evaluate", "x", *START, "--digits", "100001"],
        ["evaluate", "x", "--x0", "0", "--frobenius", "1", "--at", "1"],
        ["evaluate", "1/x^2", "--x0", "-1", "--y0", "1", "--dy0", "0", "--at", "1"],
        ["evaluate", "sqrt(2)/x^2", "--x0", "-1", "--y0", "1", "--dy0", "0", "--at", "1"],
        ["evaluate", "y''=y*tan(x)", *START, "--path", "above"],
        ["plot", "a*x", "--from", "0", "--to", "1", "-o", "a.png"],
        ["plot", "y''=y*tan(x)", "--from", "1", "--to", "2", "-o", "a.png"],
        ["conditions", "x^2"],
        ["ball", "--ratio", "0"],
        ["solve", "m*y + k"],
    ],
    ordinary=4,
    ids=str,
)
def test_hints_of_commands_speak_of_their_options(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """No call of Python's; and every option that is named is one of this command."""
    assert run(command) == 2
    said = capsys.readouterr().err
    assert "hint:" in said
    hint = said.partition("hint:")[2]
    assert not re.search(r"\w=['\[({]|kovacic\.\w|limits\.", hint)
    assert run([command[0], "--help"]) == 0
    listed = capsys.readouterr().out
    assert all(option in listed for option in re.findall(r"--[a-z]\w*", hint))


def test_hints_of_python_speak_python() -> None:
    with pytest.raises(kovacic.InputError, match="frobenius=") as told:
        kovacic.evaluate("x", 1, x0=0, y0=1)
    assert "--" not in str(told.value)
    with pytest.raises(kovacic.InputError, match=r"var='a'") as told:
        kovacic.evaluate("a*b", 1, x0=0, y0=1, dy0=0)
    airy = kovacic.evaluate("x", 1, x0=0, y0=1, dy0=0)
    assert kovacic.evaluate("a*b", 1, x0=0, y0=1, dy0=0, var="b", params={"a": 1}).overlaps(airy)
    with pytest.raises(kovacic.InputError, match=r"params=\{'a': 3\}"):
        kovacic.evaluate("a*x", 1, x0=0, y0=1, dy0=0)


@pytest.mark.long
def test_a_terminal_shows_that_work_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the first moment here; it is wiped away before the answer, and what ends at once shows nothing."""
    program = (
        "import time\nfrom kovacic.cli.options import waiting\n"
        "with waiting('working', patience=0): time.sleep(0.1)\n"
        "with waiting('never seen', patience=600): pass\n"
        "print('done')\n"
    )
    shown = on_terminal({**os.environ, "TERM": "xterm"}, program=["-c", program], bars=True)
    assert "working" in shown
    assert shown.endswith("\x1b[1A\x1b[2Kdone\r\n")
    assert "never seen" not in shown
    assert on_terminal({**os.environ, "TERM": "dumb"}, program=["-c", program], bars=True) == "done\r\n"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert (done.stdout, done.stderr) == ("done\n", "")


@pytest.mark.long
def test_a_batch_into_a_file_shows_its_progress_on_a_terminal(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("x\nx^2 + 3\n")
    output = tmp_path / "out.jsonl"
    shown = on_terminal(
        {**os.environ, "TERM": "xterm"}, "batch", str(tmp_path / "in.txt"), "-o", str(output), "-j", "1", bars=True
    )
    assert "2/2  case 1 1  none 1" in shown
    assert len(output.read_text(encoding="utf-8").splitlines()) == 2


def test_a_failed_self_check_is_status_4(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def failing(*arguments: object, **options: object) -> None:
        raise VerificationFailed("the answer failed its own check; please report it")

    monkeypatch.setattr("kovacic.solution.solve", failing)
    assert run(["solve", "x", "log(x)"]) == 4
    assert "please report" in capsys.readouterr().err


@pytest.mark.long
def test_ctrl_c_is_status_130() -> None:
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with started([*COMMAND, "solve", "-"], **pipes) as process:
        process.stdin.write("x\n")
        process.stdin.flush()
        assert process.stdout.readline() == "y'' = x y\n"
        while not process.stdout.readline().startswith("  verified"):
            pass  # it has answered and waits for more: what is interrupted in an import, Python may lose
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "Traceback" not in errors


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("kovacic.general_solution.dsolve", ["dsolve", "y'' = y"]),
        ("kovacic.general_solution.dsolve", ["solve", "y'' = y + x"]),
        ("kovacic.special.choice.chosen_form", ["solve", "1"]),
        (
            "kovacic.enclosure.evaluate.evaluate",
            ["evaluate", "x", "--x0=0", "--y0=1", "--dy0=0", "--at=1"],
        ),
    ],
)
def test_ctrl_c_while_solutions_are_computed(
    name: str, arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object, **options: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(name, interrupted)
    assert run(arguments) == 130
    shown = capsys.readouterr()
    assert shown.err == "kovacic: interrupted\n"
    assert ("Liouvillian solutions exist" in shown.out) == (arguments[0] == "solve")  # what was known has been told


@parametrize(
    "command",
    ["solve --no-solutions x x", "evaluate x --x0 0 --y0 1 --dy0 0 --at 1,2,3,4", "dsolve y\\'\\'=y"],
    ordinary=0,
    long=2,
)
def test_a_reader_that_goes_away_at_once(command: str) -> None:
    program = f"{sys.executable} -m kovacic {command} | true; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["/bin/bash", "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout == "141\n"
    assert done.stderr == ""


@pytest.mark.long
def test_a_closed_pipe_is_quiet() -> None:
    done = subprocess.run(
        f"yes x | {sys.executable} -m kovacic solve --json - 2>&1 >/dev/stdout | head -1; echo ${{PIPESTATUS[1]}}",
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    first, status = done.stdout.splitlines()
    assert json.loads(first)["case"] is None
    assert status == "141"
    assert done.stderr == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full device")
@parametrize(
    "arguments",
    [
        ["solve", "--no-solutions", "x"],
        ["--help"],
        ["conditions", "n/x^2"],
        ["explain", "2"],
        ["dsolve", "y'' = y"],
        ["evaluate", "x", "--x0=0", "--y0=1", "--dy0=0", "--at=1"],
        ["batch", "-"],
        ["scan", "x+n", "n=1:3"],
    ],
    ids=str,
    ordinary=0,
    long=2,
)
def test_a_full_disk_is_told(arguments: list[str]) -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*COMMAND, *arguments], input="x\n", stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60
        )
        assert done.returncode == 5
        assert "kovacic: the output can't be written: No space left" in done.stderr
        assert "Traceback" not in done.stderr
        if arguments[0] in ("solve", "batch"):  # no room for the message either
            streams = {"stdout": full, "stderr": full}
            assert subprocess.run([*COMMAND, *arguments], input=b"x\n", timeout=60, **streams).returncode == 5
    if arguments[0] in ("batch", "scan"):
        done = as_process(*arguments, "-o", "/dev/full", stdin="x\n")
        assert done.returncode == 5
        assert "Traceback" not in done.stderr


@parametrize(
    ("line", "status"),
    [
        ("solve - <&-", 2),
        ("check - <&-", 2),
        ("check - </dev/null", 2),
        ("batch - <&-", 2),
        ("batch - </dev/null", 0),
        ("solve x >&-", 5),
        ("evaluate x --x0=0 --y0=1 --dy0=0 --at=1 >&-", 5),
        ("batch - >&- <<<x", 5),
        ("scan x+a a=1:3 >&-", 5),
        ("--help >&-", 5),
        ("solve x <&- >&- 2>&-", 5),
        ("solve x+ 2>&-", 2),
        ("nonsense 2>&-", 2),
        ("batch - -o answers.jsonl 2>&- <<<x+", 2),
    ],
    ordinary=0,
    long=3,
)
def test_streams_that_the_shell_has_closed(tmp_path: Path, line: str, status: int) -> None:
    """Closed input can't be read, closed output can't be written, and what closed standard error would get goes nowhere."""
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m kovacic {line}"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == status
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    for answers in tmp_path.iterdir():
        assert [json.loads(line)["status"] for line in answers.read_text().splitlines()] == ["error"]


def test_the_checker_alone_has_nothing_to_check_in_closed_input() -> None:
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} {checker.__file__} <&-"], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "checker: nothing to check\n")


_VALUE = "evaluate k*x --x0=0 --y0=1 --dy0=0 --at=1"
_BALL = "ball --mass 1 --radius 1 --sphere 3"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("solve x --full", "--full has no effect without --json"),
        ("solve x --full --latex", "--full has no effect without --json"),
        ("solve x --json --latex", "--json and --latex exclude each other"),
        ("solve x --json --no-solutions", "--no-solutions has no effect with --json"),
        ("solve x --latex --no-solutions", "--no-solutions has no effect with --latex"),
        ("solve x --latex --explain", "--explain has no effect with --latex"),
        ("solve a*x --ics y(0)=1 --assume a=positive", "--assume has no effect with --ics"),
        ("solve x --var x --var x", "--var is given 2 times"),
        ("solve x^2+a --assume a=1 --assume a=2", "--assume a=2: a is 1 already"),
        ("solve x^2+a --assume a=1,a>0", "--assume a>0: a is 1 already"),
        ("solve x^2+a --assume a>0 --assume a=1", "--assume a=1: a is >0 already"),
        ("solve y''=t*y --var y", "y is the unknown function, and can't be the variable"),
        ("dsolve y''=y --json --latex", "--json and --latex exclude each other"),
        ("explain x --cite --format html", "--format has no effect with --cite"),
        ("explain x --cite -o answer.html", "--output has no effect with --cite"),
        ("conditions n/x^2 --json --format html", "--json and --format exclude each other"),
        ("conditions n/x^2 --latex --all", "--all has no effect with --json, --latex or --format"),
        ("conditions n/x^2 --format text --explain", "--explain has no effect with --json, --latex or --format"),
        ("conditions n/x^2 --all --explain", "--all has no effect with --explain"),
        ("spectrum x^2 --json --latex", "--json and --latex exclude each other"),
        (f"{_VALUE} --param k=1 --param k=2", "--param k=2: k is 1 already"),
        (f"{_VALUE} --x0=1 --param k=1", "--x0 is given 2 times"),
        (f"{_VALUE} --limit degree=1 --limit degree=2", "--limit degree=2: degree is 1 already"),
        (f"{_BALL} --time 5", "--time has no effect without --simulate or --plot"),
        (f"{_BALL} --gravity 5", "--gravity has no effect without --simulate or --plot"),
        (f"{_BALL} --potential cos(u)", "--potential has no effect without --simulate or --plot"),
        (f"{_BALL} --mass 2", "--mass is given 2 times"),
        ("ball --ratio 3/2 --offset 1", "--offset has no effect with --ratio"),
        ("batch - --jobs 1 --jobs 2", "--jobs is given 2 times"),
    ],
)
def test_an_option_without_effect_is_refused(line: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(line.split()) == 2
    shown = capsys.readouterr()
    assert message in shown.err
    assert shown.out == ""


@pytest.mark.parametrize(
    "joined",
    [
        pytest.param("a>3, a<5", marks=pytest.mark.long),
        pytest.param("a>3,<5", marks=pytest.mark.long),
        "3<a<5",
        pytest.param("a>3,a<5,a!=4", marks=pytest.mark.long),
    ],
)
def test_assumptions_may_stand_in_one_option(joined: str, capsys: pytest.CaptureFixture[str]) -> None:
    """a = 3 + 2 k has a solution where a is odd, so that all of these leave none, and a > 2 alone some."""
    assert run(["solve", "x^2 + a", "--assume", joined]) == 0
    assert "the answer holds (Whittaker" in capsys.readouterr().out
    assert run(["solve", "x^2 + a", "--assume", "a>2, a<6"]) == 0
    assert "the answer holds except where a is an odd integer" in capsys.readouterr().out
    assert run(["solve", "x^2 + a + b", "--assume", "a=root(2, 3), b=1"]) == 0
    assert "cbrt(2) + 1" in capsys.readouterr().out


@pytest.mark.parametrize("command", [["batch", "-"], ["scan", "x+n", "n=1:3"]])
def test_an_output_in_a_missing_folder_is_refused_before_any_work(
    tmp_path: Path, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*command, "-o", str(tmp_path / "missing" / "answers.jsonl")]) == 2
    shown = capsys.readouterr()
    assert "there is no directory" in shown.err
    assert shown.out == ""


@parametrize(
    "command",
    [["scan", "a*x+b", "a=1:2", "b=1:2", "--map"], ["plot", "x", "--from", "0", "--to", "1", "-o"]],
    ordinary=1,
    ids=str,
)
def test_a_picture_that_cannot_be_made_is_refused_before_any_work(
    tmp_path: Path, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    for name, message in (("missing/map.png", "there is no directory"), ("map.jpeg2", ".jpeg2 isn't one of .png")):
        assert run([*command, str(tmp_path / name)]) == 2
        shown = capsys.readouterr()
        assert shown.out == ""
        assert message in shown.err


@pytest.mark.parametrize("redirected", ["", "2>&1"])
@parametrize("command", ["batch -", "scan x^2+n n=1:300", "scan x^2+n n=1:300 --format csv"], ordinary=0, long=1)
def test_a_batch_whose_reader_goes_away_ends(command: str, redirected: str) -> None:
    program = f"seq 1 300 | {sys.executable} -m kovacic {command} {redirected} | head -1; echo ${{PIPESTATUS[1]}}"
    done = subprocess.run(
        program, shell=True, executable="/bin/bash", capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.splitlines()[1] == "141"
    assert "Traceback" not in done.stderr


def on_terminal(
    env: dict[str, str], *arguments: str, program: Sequence[str] = ("-m", "kovacic"), bars: bool = False
) -> str:
    """What the command, or another program, writes when standard output is a terminal; on request, with its progress."""
    leader, follower = pty.openpty()
    options = {"stdout": follower, "stderr": follower, "stdin": subprocess.DEVNULL, "env": env}
    with started([sys.executable, *program, *arguments], **options) as process:
        os.close(follower)
        output = b""
        while True:
            try:
                piece = os.read(leader, 4096)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            output += piece
        os.close(leader)
        process.wait(timeout=30)
    return output.decode() if bars else _BAR.sub("", output.decode())


@pytest.mark.long
def test_colours_on_a_terminal_only_and_not_with_no_color() -> None:
    env = {key: value for key, value in os.environ.items() if key not in ("NO_COLOR", "TERM")}
    command = ("solve", "--no-solutions", "x^2+3")  # which doesn't import SymPy
    assert "\x1b[" in on_terminal({**env, "TERM": "xterm"}, *command)
    assert "\x1b[" not in on_terminal({**env, "TERM": "xterm", "NO_COLOR": "1"}, *command)
    assert "\x1b[" not in on_terminal({**env, "TERM": "dumb"}, *command)
    assert "\x1b[" not in as_process(*command).stdout


def in_turn(env: dict[str, str], *commands: list[str]) -> list[list[str]]:
    """The lines of several commands on one terminal, by one process."""
    program = "import json, sys\nfrom kovacic.cli import main\n"
    program += "for command in json.loads(sys.argv[1]):\n    main.run(command)\n    print('end of output', flush=True)"
    shown = on_terminal(env, json.dumps(commands), program=["-c", program]).replace("\r\n", "\n")
    return [part.splitlines() for part in shown.split("end of output\n")[:-1]]


@pytest.mark.long
def test_lines_keep_to_the_width_of_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    long = "x^3 + 12345678901234567890123456789012345678901234567890*x"
    assert run(["solve", "x"]) == 0
    whole = capsys.readouterr().out
    env = {**os.environ, "COLUMNS": "40", "TERM": "xterm", "NO_COLOR": "1"}
    lines, of_long, of_json = in_turn(env, ["solve", "x"], ["solve", long, "--var", "x"], ["solve", "--json", "x"])
    assert max(map(len, whole.splitlines())) > 80
    assert max(map(len, lines)) <= 40
    assert " ".join(" ".join(lines).split()) == " ".join(whole.split())
    coloured = on_terminal({key: value for key, value in env.items() if key != "NO_COLOR"}, "solve", "x")
    assert re.sub(r"\x1b\[\d*m", "", coloured).replace("\r\n", "\n").splitlines() == lines
    for shown in in_turn(
        {**env, "COLUMNS": "60"},
        ["conditions", "n/x^2 + m/(x-1)^2 + 1"],
        ["dsolve", "y'' + y = x^3*cos(5*x)*exp(x)"],
    ):
        tables = [line for line in shown if re.search(r"\S {2,}\S", line)]
        assert max((len(line) for line in shown if line not in tables), default=0) <= 60
    assert long.replace(" ", "") in "".join(of_long).replace(" ", "")
    assert len(of_json) == 1


def test_the_help_names_the_commands_without_importing_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--help"]) == 0
    assert "solve" in capsys.readouterr().out


def test_a_mistyped_command_gets_a_suggestion(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["slove", "x"]) == 2
    assert "did you mean solve?" in capsys.readouterr().err
    assert run(["x^2+3"]) == 2
    said = capsys.readouterr().err
    assert "the commands are solve, " in said
    assert 'kovacic solve "x^2+3"' in said


@pytest.mark.parametrize("command", [[], *([name] for name in COMMANDS)], ids=str)
def test_h_is_help_everywhere(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*command, "-h"]) == 0
    short = capsys.readouterr().out
    assert run([*command, "--help"]) == 0
    assert short == capsys.readouterr().out
    assert short.startswith("Usage: kovacic " + "".join(command))


@parametrize(
    ("words", "offered"),
    [("s", {"solve", "scan", "schema", "spectrum"}), ("solve --la", {"--latex"}), ("ds", {"dsolve"})],
    ordinary=1,
)
def test_the_shell_completes(
    words: str, offered: set[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By click's own mechanism."""
    monkeypatch.setenv("COMP_WORDS", f"kovacic {words}")
    monkeypatch.setenv("COMP_CWORD", str(len(words.split())))

    def shown(instruction: str) -> str:
        monkeypatch.setenv("_KOVACIC_COMPLETE", instruction)
        with pytest.raises(SystemExit) as ended:
            run_and_exit([])
        assert ended.value.code == 0
        return capsys.readouterr().out

    assert {line.partition(",")[2] for line in shown("bash_complete").splitlines()} == offered
    assert "complete -o nosort -F _kovacic_completion kovacic" in shown("bash_source")


def test_the_version_is_the_packages(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--version"]) == 0
    assert capsys.readouterr().out == f"kovacic {kovacic.__version__}\n"


def test_the_console_script_is_declared() -> None:
    project = (Path(kovacic.__file__).parent.parent / "pyproject.toml").read_text(encoding="utf-8")
    assert 'kovacic = "kovacic.cli.main:main"' in project
