"""Does a wrong answer pass as verified?  Plants faults in the search and in the arithmetic, and solves known equations.

    python benchmarks/wrong_answers.py engine --sample 100     # 100 random faults in kovacic/engine
    python benchmarks/wrong_answers.py own                     # all in the modules that the kernel doesn't import

The faults are those of `mutation.py`.  With each of them the published, the textbooks' and generated equations are solved, with
their groups, in a process of its own.  The answers may be the same as without the fault; refused by the kernel, by an error or
by the time; or wrong and passed: another case, or another group, of an answer that says `verified`.  Of these there must
be none, but for the arithmetic that the kernel shares with the search, where a fault may deceive both.

Writes benchmarks/results/wrong_answers.json and .md.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [
    str(ROOT),
    str(ROOT / "tests" / "shared"),
    str(ROOT / "tests" / "closed_form"),
    str(ROOT / "benchmarks"),
]

import families  # noqa: E402
import mutation  # noqa: E402
import published  # noqa: E402
import test_textbook_equations  # noqa: E402
import transform  # noqa: E402

import kovacic  # noqa: E402
from kovacic.algebra.ratfunc import RatFunc  # noqa: E402
from kovacic.algebra.rationals import QQ  # noqa: E402

RESULTS = ROOT / "benchmarks" / "results"
#: Seconds of processor time for all equations with one fault; without a fault they take about one.
SECONDS = 12
SHARED = ("extension", "function_field", "poly", "ratfunc", "rationals")
OWN = (
    "evaluation",
    "factors",
    "homomorphism",
    "interpolation",
    "lifting",
    "modular",
    "recurrence",
    "sparse",
    "splitting",
    "traces",
)
PARTS = {
    "own": [f"kovacic/algebra/{name}.py" for name in OWN],
    "engine": [str(path.relative_to(ROOT)) for path in sorted((ROOT / "kovacic/engine").glob("[a-z]*.py"))],
    "galois": [str(path.relative_to(ROOT)) for path in sorted((ROOT / "kovacic/galois").glob("[a-z]*.py"))],
    "shared": [f"kovacic/algebra/{name}.py" for name in SHARED],
}
WHAT = {
    "own": "algebra/, not imported by the kernel",
    "engine": "engine/",
    "galois": "galois/",
    "shared": "algebra/, shared with the kernel",
}
#: Equations with algebraic numbers, conjugate poles, parameters, long series, and without a solution at the last moment.
OTHERS = (
    "sqrt(2)/x^2", "2/x^2 + sqrt(3)/x", "x^2 + 101", "x^2 + 100", "x^4 + 41*x + 1", "1/4 - 10/x + 2/x^2", "t/x^2 + 1/x",
    "x^2 + t", "1/(x^3-2)^2 + x", "1/(x^2-2)^4 + x/(x^2-2)^3 + 1", "-1 + (4*30^2-1)/(4*x^2)", "2/(x^2-2)^2 + 1/(x^2-2)",
)  # fmt: skip


def equations() -> list[Any]:
    """What `solve` takes: text, or pairs of coefficients."""
    S = [families.by_size(family, n).S for family in families.FAMILIES for n in (5, 6, 8)]
    x = RatFunc(QQ.poly([0, 1]))
    for k in (3, 4, 5):
        schwarz = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, k))
        S += [transform.pull_back(schwarz, x**2 + a) for a in (1, 2)]
    for text in ("1 + 1/x^3", "2/x^2 + 1/(x-1)", "1/(x^2-2)", "(x+1)/(x^2-3) + (5*x-2)/(x^2+1)^2"):
        S.append(transform.from_omega(kovacic.solve(text).S))
    pairs = [(one.num.coefficients(), one.den.coefficients()) for one in S]  # type: ignore[attr-defined]
    texts = [entry.S for entry in published.load()] + [text for text, _ in test_textbook_equations.EQUATIONS]
    return [*texts, *OTHERS, *pairs]


def answer(equation: Any) -> str:
    """The case and the group of a verified answer; or why there is none."""
    try:
        solved = kovacic.solve(equation, var="x") if isinstance(equation, str) else kovacic.solve(equation)
        if not solved.verified:
            return "refused"
        case = f"case {solved.case}"
    except Exception as error:  # what a fault may raise is anything
        return f"refused: {type(error).__name__}"
    try:
        return f"{case}, {solved.group}"
    except Exception:
        return case


@dataclass(frozen=True)
class Outcome:
    """With one fault: how many answers are the same, are refused or lack the group, and which are wrong and passed."""

    same: int
    refused: int
    wrong: tuple[str, ...]

    @property
    def kind(self) -> str:
        if self.wrong:
            return "passed"
        return "refused" if self.refused else "unchanged"


def outcome(right: list[str], found: list[str], names: list[str]) -> Outcome:
    """What wasn't answered in time counts as refused; a group that is only called imprimitive isn't wrong."""
    kinds = Counter[str]()
    wrong = []
    for name, expected, got in zip(names, right, found, strict=False):
        if got == expected:
            kinds["same"] += 1
        elif got.startswith("refused") or got == expected.partition(",")[0] or got.endswith("order not determined"):
            kinds["refused"] += 1
        else:
            wrong.append(f"{name}: {got} instead of {expected}")
    return Outcome(kinds["same"], kinds["refused"] + len(right) - len(found), tuple(wrong))


def with_fault(fault: mutation.Fault, given: list[Any]) -> list[str]:
    """The answers, found by a process with the fault, as many as it finds in time."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as store:
        child = os.fork()
        if child == 0:
            null = os.open(os.devnull, os.O_RDWR)
            os.dup2(null, 1)
            os.dup2(null, 2)
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))  # it ends this process
            try:
                mutation.plant(fault, mutation.functions_of(fault.file))
                for equation in given:
                    store.write(answer(equation) + "\n")
                    store.flush()
            finally:
                os.kill(os.getpid(), signal.SIGKILL)
        os.waitpid(child, 0)
        store.seek(0)
        return [line.rstrip("\n") for line in store if line.endswith("\n")]


def measure(part: str, sample: int | None, seed: int) -> Iterator[dict[str, Any]]:
    """Plant the faults of a part, or so many random ones; what was found is yielded after each."""
    given = equations()
    names = [equation if isinstance(equation, str) else str(equation)[:60] for equation in given]
    right = [answer(equation) for equation in given]
    for file in PARTS[part]:
        mutation.module_of(file)
    wanted = [fault for file in PARTS[part] for fault in mutation.faults(file)]
    row: dict[str, Any] = {"commit": mutation.commit(), "equations": len(given), "possible": len(wanted)}
    row |= {"planted": 0, "unchanged": 0, "refused": 0, "answers refused": 0, "passed": []}
    Random(seed).shuffle(wanted)
    for fault in wanted[:sample]:
        found = outcome(right, with_fault(fault, given), names)
        row["planted"] += 1
        row["answers refused"] += found.refused
        if found.wrong:
            row["passed"].append({"fault": fault.name, "answers": len(found.wrong), "first": found.wrong[0]})
            print(f"passed: {fault.name}: {found.wrong[:2]}", file=sys.stderr, flush=True)
        else:
            row[found.kind] += 1
        yield row


def table(found: dict[str, Any]) -> str:
    lines = [
        "# Wrong answers that pass",
        "",
        "Written by `python benchmarks/wrong_answers.py`; see there for what is done.",
        "",
    ]
    lines += ["| part | commit | possible | planted | no answer changed | some refused | some wrong and passed |"]
    lines += ["|---|---|---:|---:|---:|---:|---:|"]
    for part, row in found.items():
        numbers = " | ".join(str(row[key]) for key in ("possible", "planted", "unchanged", "refused"))
        lines.append(f"| {WHAT[part]} | {row['commit']} | {numbers} | {len(row['passed'])} |")
    lines += ["", "Wrong and passed:", ""]
    for row in found.values():
        lines += [f"- {one['fault']}: {one['answers']} answers, {one['first']}" for one in row["passed"]]
    return "\n".join(lines) + "\n"


def keep(part: str, row: dict[str, Any]) -> None:
    path = RESULTS / "wrong_answers.json"
    stored = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    stored[part] = row
    found = {name: stored[name] for name in PARTS if name in stored}
    path.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    (RESULTS / "wrong_answers.md").write_text(table(found), encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", choices=PARTS)
    parser.add_argument("--sample", type=int, help="so many random faults; by default all")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    os.chdir(ROOT)
    for row in measure(options.part, options.sample, options.seed):
        keep(options.part, row)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
