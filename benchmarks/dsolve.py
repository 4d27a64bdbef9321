"""kovacic.dsolve, sympy.dsolve and Maxima (ode2, contrib_ode) side by side on 150 textbook problems.

    python benchmarks/dsolve.py                   # writes results/dsolve.json and results/dsolve.md
    python benchmarks/dsolve.py --sympy-tests     # SymPy's own test equations: results/dsolve_sympy.*

Each system is one process that answers one problem after the other, within `LIMIT` seconds.  Python packages get the same
SymPy equation, symbols with the assumptions that the book makes.  An answer is checked by SymPy's differentiation and
mpmath's numbers alone: substituted at points with values for constants and parameters, to 20 digits relative to the largest
term; the values given; and the Wronskian of the two parts of a general solution.
"""

from __future__ import annotations

import base64
import json
import pickle
import platform
import re
import signal
import statistics
import subprocess
import sys
import time
import warnings
from pathlib import Path
from typing import Any

import frame
import sympy
from dsolve_problems import Problem, problems, sympy_equations
from peer_systems.process import Answer, System
from sympy.parsing.sympy_parser import parse_expr

LIMIT, CHECK_LIMIT = 10.0, 20
X = sympy.Symbol("x")
Y = sympy.Function("y")
_NAMES = {"x": X, "Heaviside": sympy.Heaviside, "DiracDelta": sympy.DiracDelta, "pi": sympy.pi}
_POINTS = [sympy.Rational(p) for p in ("37/100", "61/40", "-7/9", "41/13", "17/4")]


def symbols(problem: Problem) -> dict[str, Any]:
    """The parameters with the book's assumptions: positive, natural numbers where it says so."""
    natural = problem.assume.split(" ")[0]
    names = set(re.findall(r"\b[A-Za-z_]\w*\b(?!\()", problem.equation)) - {"x", "y", "I", "pi"}
    positive = None if problem.assume == "plain" else True
    return {name: sympy.Symbol(name, positive=positive, integer=True if name == natural else None) for name in names}


def expression(text: str, names: dict[str, Any]) -> Any:
    return parse_expr(text.replace("^", "**"), {**_NAMES, **names})


def sympy_problem(problem: Problem) -> tuple[Any, dict[Any, Any]]:
    """The equation, and the values given."""
    derivatives = {"D2": Y(X).diff(X, 2), "D1": Y(X).diff(X), "D0": Y(X), **symbols(problem)}
    text = re.sub(r"\by\b", "D0", problem.equation.replace("y''", "D2").replace("y'", "D1"))
    left, right = (expression(side, derivatives) for side in text.split("="))
    given = {}
    for prime, point, value in re.findall(r"y('?)\(([^)]*)\)=([^,]*)", problem.given):
        at = expression(point, {})
        given[Y(X).diff(X).subs(X, at) if prime else Y(at)] = expression(value, {})
    return sympy.Eq(left, right), given


class Python(System):
    """`python benchmarks/dsolve.py --serve PACKAGE`."""

    def __init__(self, package: str) -> None:
        super().__init__()
        self.name = f"{package}.dsolve"
        self.command = (sys.executable, str(Path(__file__)), "--serve", package)
        self.seconds = 0.0

    def request(self, S: str) -> str:
        return S + "\n" if S.startswith("{") else json.dumps(vars(Problem("", "", "y''-y=0"))) + "\n"

    def understand(self, text: str) -> Answer:
        self.seconds, kind, *rest = json.loads(text.splitlines()[-1])
        return Answer(kind, "y", "python", tuple(rest))


class Maxima(System):
    """ode2, else contrib_ode, the first of its answers; then ic2 or bc2."""

    name = "Maxima ode2, contrib_ode"
    command = ("maxima", "--very-quiet")
    opening = (
        'display2d:false$\nload("contrib_ode")$\n'
        "general(e):=block([r],r:ode2(e,y,x),if r=false then r:contrib_ode(e,y,x),"
        "if r=[] then false elseif listp(r) then first(r) else r)$\n"
        'show(r):=printf(true,"~%<<<~a>>>~%<<<end>>>~%",string(r))$\nload("unit_step")$\n'
    )
    stuck = re.compile(r"\?\s*$")

    def request(self, S: str) -> str:
        problem = Problem(**json.loads(S)) if S.startswith("{") else Problem("", "", "y''-y=0")
        names = symbols(problem)
        say = "".join(f"assume({name}>0)$" for name in names)
        say += "".join(f"declare({name},integer)$" for name, symbol in names.items() if symbol.is_integer)
        equation = _for_maxima(problem.equation.replace("y''", "'diff(y,x,2)").replace("y'", "'diff(y,x)"))
        solved = f"general({equation})"
        given = re.findall(r"y('?)\(([^)]*)\)=([^,]*)", problem.given)
        orders = [prime for prime, _, _ in given]
        if orders == ["", "'"] and given[0][1] == given[1][1]:
            (_, a, u), (_, _, v) = [tuple(map(_for_maxima, item)) for item in given]
            solved = f"ic2({solved},x={a},y={u},'diff(y,x)={v})"
        elif orders == ["", ""]:
            (_, a, u), (_, b, v) = [tuple(map(_for_maxima, item)) for item in given]
            solved = f"bc2({solved},x={a},y={u},x={b},y={v})"
        elif orders:
            solved = "false"  # no command for such values
        return f"kill(%k1,%k2)$ {say} show(errcatch({solved}))$ forget(facts())$\n"

    def understand(self, text: str) -> Answer:
        match = re.search(r"<<<\[(.*)\]>>>", text, re.DOTALL)
        if match is None or match.group(1) in ("", "false"):
            return Answer("error")
        answer = re.sub(r"\s", "", match.group(1))
        if answer == "[]":
            return Answer("none")
        return (
            Answer("solved", "y", "maxima", (answer.removeprefix("y="),))
            if answer.startswith("y=")
            else Answer("error")
        )


def _for_maxima(text: str) -> str:
    text = re.sub(r"\bpi\b", "%pi", text)
    return text.replace("Heaviside", "unit_step").replace("DiracDelta", "delta")


def read_maxima(text: str, names: dict[str, Any]) -> Any:
    """An answer of Maxima's in SymPy's functions."""
    own = {"%e": "E_", "%i": "I_", "%pi": "pi", "%k": "C", "%c": "C", "%r": "K", "'integrate": "Integral_"}
    for old, new in own.items():
        text = text.replace(old, new)
    functions: dict[str, Any] = {
        "E_": sympy.E, "I_": sympy.I, "C1": sympy.Symbol("C1"), "C2": sympy.Symbol("C2"),
        "gamma_incomplete": sympy.uppergamma, "expintegral_ei": sympy.Ei, "expintegral_e": sympy.expint,
        "bessel_j": sympy.besselj, "bessel_y": sympy.bessely, "bessel_i": sympy.besseli, "bessel_k": sympy.besselk,
        "kummer_m": lambda a, b, z: sympy.hyper((a,), (b,), z), "unit_step": sympy.Heaviside,
        "kummer_u": lambda a, b, z: sympy.gamma(1 - b) / sympy.gamma(a - b + 1) * sympy.hyper((a,), (b,), z)
        + sympy.gamma(b - 1) / sympy.gamma(a) * z ** (1 - b) * sympy.hyper((a - b + 1,), (2 - b,), z),
        "gauss_a": lambda a, b, c, z: sympy.hyper((a, b), (c,), z),
        "gauss_b": _second_gauss,
        "hgfred": sympy.hyper, "airy_ai": sympy.airyai, "airy_bi": sympy.airybi, "Integral_": sympy.Integral,
        "expintegral_li": sympy.li, "expintegral_si": sympy.Si, "expintegral_ci": sympy.Ci,
        "signum": lambda u: u / sympy.sqrt(u**2),
        "legendre_p": sympy.legendre, "abs": lambda u: sympy.sqrt(u**2), "hermite": sympy.hermite,
    }  # fmt: skip
    unknown = {name: sympy.Symbol(name) for name in re.findall(r"\bK\d+", text)}
    return expression(text, {**functions, **unknown, **names})


def _second_gauss(a: Any, b: Any, c: Any, z: Any) -> Any:
    """The solution that belongs to the exponent 1 - c at 0, where it isn't a logarithmic one."""
    if c.is_Integer:
        raise NotImplementedError("a logarithmic solution of Gauss's equation")
    return z ** (1 - c) * sympy.hyper((a - c + 1, b - c + 1), (2 - c,), z)


# ------------------------------------------------------------------------------------------------------------ checking


class LateError(Exception):
    """A check took too long."""


def checked(problem: Problem, solution: Any) -> str:
    """ "right", "right with integrals", "wrong" or "unchecked"."""

    def late(*_: Any) -> None:
        raise LateError

    signal.signal(signal.SIGALRM, late)
    signal.alarm(CHECK_LIMIT)
    try:
        return _checked(problem, solution)
    except Exception as error:
        return f"unchecked ({type(error).__name__})"
    finally:
        signal.alarm(0)


def _checked(problem: Problem, solution: Any) -> str:
    equation, given = sympy_problem(problem)
    equation = _exact(equation)
    own = symbols(problem)
    solution = _exact(solution).xreplace({sympy.Symbol(name): symbol for name, symbol in own.items()})
    values = {
        s: sympy.Rational(23 + 4 * k, 17) for k, s in enumerate(sorted(own.values(), key=str)) if not s.is_integer
    }
    values |= {s: sympy.Integer(3) for s in own.values() if s.is_integer}
    found_symbols = solution.free_symbols - {*own.values()}
    constants = sorted((s for s in found_symbols if re.fullmatch(r"[CK]\d+", s.name)), key=str)
    if not given and len(constants) != 2:
        return "wrong"
    solution = sympy.sympify(solution).subs(values)
    whole = solution.subs(dict(zip(constants, (sympy.Rational(7, 5), sympy.Rational(-3, 4)), strict=False)))
    left = (equation.lhs - equation.rhs).subs(values)
    if given and any(len(i.limits[0]) == 1 for i in whole.atoms(sympy.Integral)):
        return "unchecked (values of indefinite integrals)"
    found = [_holds(left, whole, point) for point in _POINTS]
    if not any(found):
        return "unchecked" if all(holds is None for holds in found) else "wrong"
    if False in found and not (found.count(True) >= 2 and _POINTS[2] < 0 and found[2] is False):
        return "wrong"  # on one side of a singularity only: another branch
    for key, value in given.items():
        order = 1 if key.is_Derivative or isinstance(key, sympy.Subs) else 0
        at = key.point[0] if isinstance(key, sympy.Subs) else key.args[0]
        if abs(_number(whole.diff(X, order) if order else whole, at) - value.evalf(30)) > 1e-15:
            return "wrong"
    if not given:
        parts = [solution.diff(c) for c in constants]
        wronskian = parts[0] * parts[1].diff(X) - parts[0].diff(X) * parts[1]
        if abs(_number(wronskian, _POINTS[0])) < 1e-15:
            return "wrong"
    return "right with integrals" if solution.has(sympy.Integral) else "right"


def _exact(e: Any) -> Any:
    """With the fraction that each floating-point number is."""
    return e.xreplace({number: sympy.Rational(number) for number in e.atoms(sympy.Float)})


def _holds(left: Any, solution: Any, point: Any) -> bool | None:
    """Is the equation satisfied at a point?  None where it can't be evaluated."""
    derivatives = [(Y(X).diff(X, k), solution.diff(X, k)) for k in (2, 1)] + [(Y(X), solution)]
    try:
        terms = [_number(term.subs(derivatives), point) for term in sympy.Add.make_args(sympy.expand(left))]
    except (ValueError, TypeError, ZeroDivisionError):
        return None
    return bool(abs(sum(terms)) < 1e-20 * (max(map(abs, terms)) + 1))


def _number(e: Any, point: Any) -> Any:
    """The value at a point; indefinite integrals have any."""
    integrals = (i for i in e.atoms(sympy.Integral) if len(i.limits[0]) == 1)
    e = e.xreplace({i: sympy.Rational(sum(map(ord, str(i))) % 997, 991) for i in integrals})
    value = sympy.N(e.subs(X, point), 40, maxn=300)
    if not value.is_number or value.has(sympy.nan, sympy.zoo, sympy.Integral) or not value.is_finite:
        raise ValueError(str(value)[:80])
    return value


# ------------------------------------------------------------------------------------------------------------- running


def serve(package: str) -> None:
    """A line of JSON in, an answer out."""
    warnings.simplefilter("ignore")
    module = __import__(package)
    for line in sys.stdin:
        equation, given = sympy_problem(Problem(**json.loads(line)))
        start = time.perf_counter()
        try:
            found = module.dsolve(equation, Y(X), ics=given or None)
            found = found[0] if isinstance(found, list) else found
            if found.has(sympy.Order) or found.lhs != Y(X):
                answer = ["undecided"]
            else:
                answer = ["solved", base64.b64encode(pickle.dumps(found.rhs)).decode()]
        except Exception as error:
            none = re.search(r"no solution with these|solve for initial conditions|solve for constants", str(error))
            answer = ["none" if none else "error", f"{type(error).__name__}: {error}"[:300]]
        print(json.dumps([time.perf_counter() - start, *answer]))
        print("<<<end>>>", flush=True)


def run(system: System, problem: Problem) -> dict[str, Any]:
    reply = system.solve(json.dumps(vars(problem)), LIMIT)
    entry: dict[str, Any] = {"seconds": round(reply.seconds, 4), "verdict": reply.outcome}
    if reply.outcome != "text":
        return entry | {"verdict": "no answer in time" if reply.outcome == "time-out" else "asks or dies"}
    answer = system.understand(reply.text)
    entry["verdict"] = "not solved"
    if isinstance(system, Python):  # without reading the text
        entry["seconds"] = round(system.seconds, 4)
    if problem.expected == "none":
        entry["verdict"] = "right" if answer.kind == "none" else "wrong" if answer.kind == "solved" else "not solved"
        entry["length"] = 0
    elif answer.kind == "solved":
        try:
            value = (
                pickle.loads(base64.b64decode(answer.expressions[0]))
                if answer.syntax == "python"
                else read_maxima(answer.expressions[0], symbols(problem))
            )
        except Exception as error:
            return entry | {"verdict": f"unchecked ({type(error).__name__})", "answer": answer.expressions[0][:500]}
        entry |= {"verdict": checked(problem, value), "answer": str(value)[:2000], "length": len(str(value))}
    elif answer.expressions:
        entry["answer"] = answer.expressions[0]
    return entry


def main() -> None:
    wanted = set(sys.argv[1:]) - {"--sympy-tests"}
    chosen, name = problems(), "dsolve"
    if "--sympy-tests" in sys.argv:
        chosen, name = sympy_equations(), "dsolve_sympy"
    systems: list[System] = [Python("kovacic"), Python("sympy")]
    if Maxima.command and subprocess.run(["which", "maxima"], capture_output=True, check=False).returncode == 0:
        systems.append(Maxima())
    systems = [system for system in systems if not wanted or system.name.split(".")[0].split()[0] in wanted]
    rows = []
    start = time.perf_counter()
    for problem in chosen:
        row: dict[str, Any] = vars(problem) | {"answers": {system.name: run(system, problem) for system in systems}}
        rows.append(row)
        shown = ", ".join(f"{a['verdict']} {a['seconds']:.2f}" for a in row["answers"].values())
        print(f"{problem.equation} {problem.given}: {shown}", flush=True)
    for system in systems:
        system.close()
    seconds = round(time.perf_counter() - start)
    versions = {"python": platform.python_version(), "sympy": sympy.__version__}
    if not wanted:
        data = {"versions": versions, "seconds": seconds, "limit": LIMIT, "problems": rows}
        frame.save(name, data, table(rows, [system.name for system in systems], seconds))
    print(table(rows, [system.name for system in systems], seconds))


def table(rows: list[dict[str, Any]], names: list[str], seconds: int) -> str:
    """The summary in Markdown; medians over the problems that every system solves."""
    good = ("right", "right with integrals")
    common = [row for row in rows if all(row["answers"][name]["verdict"] in good for name in names)]
    lines = [
        f"# {len(rows)} problems: `python benchmarks/dsolve.py`, {seconds} s, {LIMIT:.0f} s a problem at most",
        "",
        frame.line(sympy=sympy.__version__),
        "",
        "| | " + " | ".join(names) + " |",
        "| --- |" + " --- |" * len(names),
    ]

    def line(title: str, value: Any) -> None:
        lines.append(f"| {title} | " + " | ".join(str(value(name)) for name in names) + " |")

    def verdicts(name: str, group: str = "") -> list[str]:
        return [row["answers"][name]["verdict"] for row in rows if row["group"].startswith(group)]

    line("right", lambda name: verdicts(name).count("right"))
    line("right, with an integral left", lambda name: verdicts(name).count("right with integrals"))
    line("wrong", lambda name: verdicts(name).count("wrong"))
    line("couldn't be checked", lambda name: sum(v.startswith("unchecked") for v in verdicts(name)))
    line("no answer in time", lambda name: verdicts(name).count("no answer in time"))
    for group in dict.fromkeys(row["group"] for row in rows):
        total = sum(row["group"] == group for row in rows)
        line(f"right: {group} ({total})", lambda name, group=group: verdicts(name, group).count("right"))
    solved = f"of the {len(common)} that all solve"

    def median(name: str, key: str) -> float:
        return statistics.median(row["answers"][name].get(key, 0) for row in common)

    if common:
        line(f"median of characters, {solved}", lambda name: f"{median(name, 'length'):.0f}")
        line(f"median of milliseconds, {solved}", lambda name: f"{1000 * median(name, 'seconds'):.1f}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if sys.argv[1:2] == ["--serve"]:
        serve(sys.argv[2])
    else:
        main()
