"""The systems: how each one is asked for the solutions of y'' = S y, and what its answers look like."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from peer_systems.process import Answer, System


class PythonSystem(System):
    """A Python package, served by `server.py`."""

    package = ""
    method = ""

    def __init__(self) -> None:
        super().__init__()
        self.command = (sys.executable, str(Path(__file__).parent / "server.py"), self.method)

    @classmethod
    def is_installed(cls) -> bool:
        return find_spec(cls.package) is not None

    def version(self) -> str:
        return f"{self.package} {version(self.package)}" if self.package != "kovacic" else _own_version()

    def request(self, S: str) -> str:
        return json.dumps(S) + "\n"

    def understand(self, text: str) -> Answer:
        data = json.loads(text.splitlines()[-1])
        return Answer(data["kind"], data["form"], "python", tuple(data["expressions"]))


def _own_version() -> str:
    import kovacic

    return f"kovacic {kovacic.__version__}"


class Verdict(PythonSystem):
    """The case, omega or its polynomial, verified."""

    name, package, method = "kovacic", "kovacic", "kovacic"


class Full(PythonSystem):
    """The same, and two solutions in closed form."""

    name, package, method = "kovacic, closed forms", "kovacic", "kovacic-full"


class Dsolve(PythonSystem):
    name, package, method = "SymPy dsolve", "sympy", "dsolve"


class SolveRiccati(PythonSystem):
    """Rational omega only: its "none" says nothing about cases 2 and 3."""

    name, package, method = "SymPy solve_riccati", "sympy", "riccati"


class Maxima(System):
    name, executable = "Maxima kovacicODE", "maxima"
    command = ("maxima", "--very-quiet")
    opening = (
        'display2d:false$\nload("contrib_ode")$\nload("kovacicODE")$\nDEBUGFLAG:0$\n'
        "asked(s):=block([r],r:errcatch(kovacicODE('diff(y,x,2)=s*y,y,x)),"
        'printf(true,"~%<<<~a>>>~%<<<end>>>~%",string(r)))$\n'
    )
    stuck = re.compile(r"\?\s*$")

    def version(self) -> str:
        return subprocess.run(["maxima", "--version"], capture_output=True, text=True, check=True).stdout.strip()

    def request(self, S: str) -> str:
        return f"asked({S})$\n"

    def understand(self, text: str) -> Answer:
        match = re.search(r"<<<\[(.*)\]>>>", text, re.DOTALL)
        if match is None or not match.group(1):
            return Answer("error")
        answer = match.group(1)
        if answer == "false":
            return Answer("none")
        solution = re.fullmatch(r"\[y = (.*)\]", answer, re.DOTALL)
        return Answer("solved", "y", "maxima", (solution.group(1),)) if solution else Answer("error")


class FriCAS(System):
    name, executable = "FriCAS solve", "fricas"
    command = ("fricas", "-nosman")
    stuck = re.compile(r">> System error")
    opening = ")set messages autoload off\n)set messages type off\n)set output length 245\ny := operator 'y;\n"

    def version(self) -> str:
        shown = subprocess.run(
            ["fricas", "-nosman"], input=")quit\n", capture_output=True, text=True, check=False
        ).stdout
        match = re.search(r"Version: (.*)", shown)
        return match.group(1).strip() if match else "FriCAS"

    def request(self, S: str) -> str:
        return (
            f"r := solve(D(y x, x, 2) = ({S})*y x, y, x);\n"
            'concat(["<<<", concat([concat(unparse(e::InputForm), ";") for e in r.basis]), ">>>"])\n'
            'concat("<<<", "end>>>")\n'
        )

    def understand(self, text: str) -> Answer:
        if re.search(r">> (System e|E)rror", text):  # r is still the answer to an earlier equation
            return Answer("error")
        joined = re.sub(r"\s", "", text)
        match = re.search(r'"<<<(.*?)>>>"', joined)
        if match is None:
            return Answer("error")
        solutions = tuple(part for part in match.group(1).split(";") if part)
        return Answer("solved", "y", "fricas", solutions, len(solutions) == 1) if solutions else Answer("none")


class Giac(System):
    name, executable = "giac kovacicsols", "giac"
    command = ("giac",)
    # Each line of input costs giac a millisecond: so none asks for a marker.
    prompt = re.compile(rb"\d+>> ")

    def version(self) -> str:
        shown = subprocess.run(["giac", "--version"], capture_output=True, text=True, check=True).stdout
        return "giac " + shown.strip().splitlines()[-1]

    def request(self, S: str) -> str:
        return f"kovacicsols(y''=({S})*y,x,y)\n"

    def understand(self, text: str) -> Answer:
        lines = [line.strip() for line in re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "", text).splitlines()]
        results = [line for line in lines[1:] if line and not line.startswith("//")]  # the first line is the question
        if not results or "Error" in results[-1] or "error" in results[-1]:
            return Answer("error")
        answer = results[-1]
        if answer == "[]":
            return Answer("none")
        if "omega_" in answer:
            return Answer("solved", "riccati", "giac", (answer,))
        if not (answer.startswith("[") and answer.endswith("]")):
            return Answer("error")
        solutions = tuple(_split(answer[1:-1]))
        return Answer("solved", "y", "giac", solutions, len(solutions) == 1)


def _split(text: str) -> list[str]:
    """At the commas outside parentheses."""
    parts, depth, start = [], 0, 0
    for k, char in enumerate(text):
        depth += (char in "([") - (char in ")]")
        if char == "," and depth == 0:
            parts.append(text[start:k])
            start = k + 1
    return [*parts, text[start:]]


ALL: tuple[type[System], ...] = (Verdict, Full, Maxima, FriCAS, Giac, Dsolve, SolveRiccati)
