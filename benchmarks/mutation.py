"""Do the tests notice small faults?  Plants them one at a time, runs the tests, and lists the faults that survive.

    python benchmarks/mutation.py verify --sample 100           # 100 random faults in kovacic/verify
    python benchmarks/mutation.py engine galois --sample 200 --seed 7 --jobs 2

A fault is a comparison, an arithmetic or a logical operator changed into its neighbour, a whole number raised by one, a
condition negated, a refusal left out, or a predicate that is always true or always false.  It is killed when a test fails
or the run takes too much processor time.  Each runs in a process of its own, in which the changed module replaces the true
one; no file is changed.  Writes benchmarks/results/mutation.md and mutation.json, with every survivor; those in EXPLAINED
are faults that change no answer, and say why.

Method: R. DeMillo, R. Lipton and F. Sayward, "Hints on test data selection", Computer 11 (1978).
"""

from __future__ import annotations

import argparse
import ast
import importlib.abc
import importlib.util
import json
import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks" / "results"

ENGINE_TESTS = ("tests/test_cases.py", "tests/test_engine_properties.py", "tests/test_verify.py", "tests/test_invariants.py",
                "tests/test_bad_primes.py", "tests/test_parameters.py", "tests/test_algebraic_constants.py",
                "tests/test_textbook_equations.py", "tests/test_operation_counts.py")  # fmt: skip
#: The files of a part of the package, and the tests that should notice a fault there, the likeliest first.
PARTS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "verify": (("kovacic/verify/*.py",), ("tests/test_verify.py", *ENGINE_TESTS)),
    "engine": (("kovacic/engine/*.py",), ENGINE_TESTS),
    "galois": (("kovacic/galois/*.py",), ("tests/test_galois.py", "tests/test_verify.py")),
    "check": (
        ("kovacic/closed_form/check.py", "kovacic/closed_form/real_pair.py"),
        ("tests/test_closed_form_check.py", "tests/test_closed_form*.py"),
    ),
    "bounds": (
        tuple(f"kovacic/enclosure/{name}.py" for name in ("t*", "fr*", "exponential", "s*", "recessive")),
        tuple(f"tests/test_enclosure_{name}.py" for name in ("defect", "constants", "singular", "values", "*")),
    ),
}
#: Survivors that change no answer: "file: function: fault", and why.
EXPLAINED: dict[str, str] = {
    "kovacic/verify/evidence.py: Inspector._no_omega_at: Mult in (order + 1) // 2": "a larger bound of a degree",
    "kovacic/verify/evidence.py: Inspector._no_omega_at: 1 + 1": "a larger bound of a degree",
    "kovacic/verify/group.py: _imprimitive: 2 + 1": "an irregular point has no exponent difference, which is asked for as well",
    "kovacic/verify/evidence.py: Inspector._no_omega_at: 2 + 1": "max(k, 3) // 2 is max(k, 2) // 2",
    "kovacic/verify/group.py: _inverse_has_an_integral: 1 + 1": "a constant factor",
    "kovacic/closed_form/check.py: module: 50 + 1": "a precision",
    "kovacic/closed_form/check.py: residual: Sub in abs(y) + abs(first)": "the scale of the terms, of the same size",
    "kovacic/closed_form/check.py: is_numerical_solution: 15 + 1": "a working precision",
    "kovacic/closed_form/check.py: is_numerical_solution: Add in 8 * DIGITS": "a working precision",
    "kovacic/closed_form/check.py: is_numerical_solution: Sub in DIGITS + 15": "a working precision, that of the next attempt",
    "kovacic/closed_form/check.py: is_numerical_solution: 96 + 1": "a working precision",
    "kovacic/closed_form/check.py: is_numerical_solution: 89 + 1": "another point",
    "kovacic/closed_form/check.py: is_numerical_solution: 10 + 1": "a tolerance",
    "kovacic/closed_form/check.py: is_numerical_solution: 71 + 1": "another point",
    "kovacic/closed_form/check.py: is_numerical_solution: LtE in value < bound": "balls",
    "kovacic/closed_form/real_pair.py: _half_turns: 0 + 1": "delta isn't zero",
    "kovacic/closed_form/real_pair.py: _half_turns: 2 + 1": "the whole part of |q| - 1/3 is that of |q| - 1/2 for q in 1/2 + Z",
    "kovacic/closed_form/real_pair.py: _half_turns: GtE in q > 0": "the sign of 0 turns",
    "kovacic/galois/imprimitive.py: module: 400 + 1": "how much work is done",
    "kovacic/galois/gauged.py: module: 1 + 1": "SL(2,5) has no character, and gamma^(N/2) isn't rational",
    "kovacic/galois/imprimitive.py: curve_of: Add in f.theta * problem.D": "theta has a pole at each singular point: N/D + D"
    " is (N + D^2)/D, with the same residues",
    "kovacic/galois/imprimitive.py: _of_positive_genus: Sub in _LARGEST_DEGREE // (20 * l) + 1": "how much work is done",
    "kovacic/galois/imprimitive.py: _of_positive_genus: Add in 2 * n": "how much work is done",
    "kovacic/galois/imprimitive.py: _of_positive_genus: 1 + 1": "how much work is done",
    "kovacic/galois/imprimitive.py: _small_homomorphisms: Lt in h.p ** genus <= 10 ** 7": "10^7 is no power of a prime",
    "kovacic/galois/imprimitive.py: _of_positive_genus: GtE in 2 * n > _LARGEST_DEGREE": "how much work is done",
    "kovacic/galois/imprimitive.py: _small_homomorphisms: Mult in 10 ** 7": "fewer primes: the invariants decide instead",
    "kovacic/galois/imprimitive.py: _small_homomorphisms: 5 + 1": "other primes",
    "kovacic/galois/jacobian.py: Jacobian.multiple: LtE in k < 0": "0 times a class and 0 times its inverse are the same",
    "kovacic/galois/imprimitive.py: _order_modulo: 1 + 1": "a constant factor",
    "kovacic/engine/degree_bound.py: DegreeBound.exponents: Gt in largest_integer_total(self.total - h, others) >= 0": "those "
    "with no room for zeros were tried before, at the first degree",
    "kovacic/engine/degree_bound.py: _trace: Add in "
    "(1 + 4 * place.near[0] * _leading_coefficient(place).inverse_modulo(p)) % p": "the same class",
    "kovacic/enclosure/frame.py: _bound: Add in growth * sigma * rise": "the growth chooses working precisions only",
    "kovacic/enclosure/frobenius.py: _expand: Add in len(terms) % _STRIDE": "how often the clock is looked at",
    "kovacic/enclosure/splitting.py: legs: 2 + 1": "which of two ways is taken",
    "kovacic/enclosure/splitting.py: _sum_series: 4000 + 1": "how much work is done",
    "kovacic/enclosure/splitting.py: is_split: Sub in len(system.num) + 1": "which of two ways is taken",
    "kovacic/enclosure/splitting.py: is_split: Mult in order ** 3": "which of two ways is taken",
    "kovacic/verify/__init__.py: _positive: Or in isinstance(field, AlgebraicField) and field != S.field": "the field of S is "
    "checked once more",
    "kovacic/verify/evidence.py: Inspector._condition_fails: LtE in 0 < point.order <= 2": "ordinary points have difference 1",
    "kovacic/verify/evidence.py: Inspector._at_prime: LtE in h.p < p": "over Q each prime has one homomorphism, tried before",
    "kovacic/verify/evidence.py: _first_terms: 1 + 1": "a double root modulo the prime is met as a pivot zero later",
    "kovacic/verify/group.py: _dicyclic: Sub in k + 1": "k - 1 and k + 1 have the same parity",
    "kovacic/verify/local.py: least_valuation: 1 + 1": "0/2 is 0/1",
    "kovacic/verify/residue.py: exponent_difference_squared: Add in "
    "(root + root * (1 - unit * root * root % ahead) / 2) % ahead": "the same class, reduced later",
}

SWAPPED: dict[type[ast.AST], type[ast.AST]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.FloorDiv: ast.Mult, ast.Pow: ast.Mult, ast.Mod: ast.Add,
}  # fmt: skip


@dataclass(frozen=True)
class Fault:
    """The `number`-th possible fault of a file, in the function `where`, at `line`; `what` says what is changed."""

    file: str
    number: int
    line: int
    where: str
    what: str

    @property
    def name(self) -> str:
        return f"{self.file}: {self.where}: {self.what}"


class Planter(ast.NodeVisitor):
    """Walks through a module and counts the faults that can be planted; plants the one with the number `wanted`."""

    def __init__(self, file: str, wanted: int = -1) -> None:
        self.file, self.wanted, self.faults, self.place = file, wanted, list[Fault](), list[str]()

    def offer(self, node: ast.AST, what: str) -> bool:
        """Record a possible fault; is it the wanted one?"""
        line = getattr(node, "lineno", 0)
        self.faults.append(Fault(self.file, len(self.faults), line, ".".join(self.place) or "module", what))
        return len(self.faults) - 1 == self.wanted

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self.place.append(node.name)
        if node.returns is not None and ast.unparse(node.returns) == "bool":
            for value in (True, False):
                if self.offer(node, f"always {value}"):
                    node.body = [ast.Return(ast.Constant(value))]
        if node.body and isinstance(node.body[0], ast.Expr) and isinstance(node.body[0].value, ast.Constant):
            node.body = node.body[1:] or [ast.Pass()]
        for statement in node.body:
            self.visit(statement)
        self.place.pop()

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self.place.append(node.name)
        for statement in node.body:
            if isinstance(statement, ast.FunctionDef):
                self.visit(statement)
        self.place.pop()

    def visit_Compare(self, node: ast.Compare) -> None:
        text = ast.unparse(node)
        for k, operator in enumerate(node.ops):
            if type(operator) in SWAPPED and self.offer(node, f"{SWAPPED[type(operator)].__name__} in {text}"):
                node.ops[k] = SWAPPED[type(operator)]()  # type: ignore[call-overload]
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        swapped = SWAPPED.get(type(node.op))
        is_text = any(
            isinstance(side, ast.Constant | ast.JoinedStr) and not _is_number(side) for side in (node.left, node.right)
        )
        if swapped is not None and not is_text and self.offer(node, f"{swapped.__name__} in {ast.unparse(node)}"):
            node.op = swapped()  # type: ignore[assignment]
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        if self.offer(node, f"{SWAPPED[type(node.op)].__name__} in {ast.unparse(node)}"):
            node.op = SWAPPED[type(node.op)]()  # type: ignore[assignment]
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.USub | ast.Not) and self.offer(node, f"without the sign in {ast.unparse(node)}"):
            node.op = ast.UAdd() if isinstance(node.op, ast.USub) else node.op
            if isinstance(node.op, ast.Not):
                node.operand = ast.UnaryOp(ast.Not(), node.operand)
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        if _is_number(node) and self.offer(node, f"{node.value} + 1"):
            node.value = node.value + 1  # type: ignore[operator]

    def visit_If(self, node: ast.If) -> None:
        refusal = node.body[-1]
        if isinstance(refusal, ast.Raise) and self.offer(node, f"no refusal: {ast.unparse(node.test)}"):
            node.body = [ast.Pass()]
        self.generic_visit(node)

    def visit_Raise(self, node: ast.Raise) -> None:
        """What an error says isn't looked at."""


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, int) and not isinstance(node.value, bool)


def faults(file: str) -> list[Fault]:
    """All faults that can be planted in a file."""
    planter = Planter(file)
    planter.visit(ast.parse((ROOT / file).read_text(encoding="utf-8")))
    return planter.faults


class Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module from a changed tree."""

    def __init__(self, module: str, path: Path, tree: ast.Module) -> None:
        self.module, self.path, self.tree = module, path, tree

    def find_spec(self, fullname: str, path: Any, target: Any = None) -> Any:
        if fullname != self.module:
            return None
        packages = [str(self.path.parent)] if self.path.name == "__init__.py" else None
        return importlib.util.spec_from_file_location(
            fullname, self.path, loader=self, submodule_search_locations=packages
        )

    def create_module(self, spec: Any) -> None:
        return None

    def exec_module(self, module: Any) -> None:
        exec(compile(self.tree, str(self.path), "exec"), module.__dict__)


def run_tests(fault_file: str, number: int, seconds: float, tests: list[str]) -> int:
    """In a process of its own: plant the fault and run the tests up to the first failure; pytest's exit status."""
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 1))
    path = ROOT / fault_file
    tree = ast.parse(path.read_text(encoding="utf-8"))
    Planter(fault_file, number).visit(tree)
    parts = Path(fault_file).with_suffix("").parts
    module = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
    sys.meta_path.insert(0, Finder(module, path, ast.fix_missing_locations(tree)))
    import pytest

    return int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", "--no-header", *tests]))


def outcome(fault: Fault, tests: list[str], seconds: float) -> dict[str, Any]:
    """Whether the tests notice the fault, and in what time."""
    command = [sys.executable, __file__, "--plant", fault.file, str(fault.number), str(seconds), *tests]
    started = time.monotonic()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1",
                   "HYPOTHESIS_PROFILE": "mutation"}  # fmt: skip
    try:  # a test that waits uses no processor time
        status = subprocess.run(
            command,
            cwd=ROOT,
            env=environment,
            capture_output=True,
            timeout=20 * seconds,
            check=False,
            stdin=subprocess.DEVNULL,
        ).returncode
        killed = "" if status == 0 else "it takes too long" if status == -signal.SIGXCPU else "a test fails"
    except subprocess.TimeoutExpired:
        killed = "it takes too long"
    print("." if killed else f"\nsurvives: {fault.name} (line {fault.line})\n", end="", flush=True)
    return {"name": fault.name, "line": fault.line, "killed": killed, "seconds": round(time.monotonic() - started, 1)}


def examine(part: str, options: argparse.Namespace) -> dict[str, Any]:
    """The score of one part of the package."""
    files, patterns = PARTS[part]
    found = [f for pattern in files for path in sorted(ROOT.glob(pattern)) for f in faults(str(path.relative_to(ROOT)))]
    chosen = found
    if options.sample is not None and options.sample < len(found):
        chosen = sorted(Random(options.seed).sample(found, options.sample), key=lambda f: (f.file, f.number))
    tests = [str(path.relative_to(ROOT)) for pattern in dict.fromkeys(patterns) for path in sorted(ROOT.glob(pattern))]
    print(f"{part}: {len(chosen)} of {len(found)} possible faults")
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda fault: outcome(fault, tests, options.timeout), chosen))
    survivors = [result for result in results if not result["killed"]]
    return {"part": part, "possible": len(found), "planted": len(chosen), "seed": options.seed, "survivors": survivors}


def table(rows: list[dict[str, Any]]) -> Iterator[str]:
    yield "# Planted faults\n\nWritten by `python benchmarks/mutation.py`; see there for what is planted.\n"
    yield "| part | possible | planted | killed | explained | score |\n|---|---|---|---|---|---|"
    for row in rows:
        explained = [s for s in row["survivors"] if s["name"] in EXPLAINED]
        killed = row["planted"] - len(row["survivors"])
        score = killed / max(row["planted"] - len(explained), 1)
        yield f"| {row['part']} | {row['possible']} | {row['planted']} | {killed} | {len(explained)} | {score:.1%} |"
    yield "\nThe score leaves out the explained ones, which change no answer.  Survivors:\n"
    for row in rows:
        for survivor in row["survivors"]:
            yield f"- {survivor['name']} (line {survivor['line']}): {EXPLAINED.get(survivor['name'], 'not explained')}"


def main() -> int:
    if sys.argv[1:2] == ["--plant"]:
        return run_tests(sys.argv[2], int(sys.argv[3]), float(sys.argv[4]), sys.argv[5:])
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="+", choices=sorted(PARTS))
    parser.add_argument("--sample", type=int, help="so many random faults; by default all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=200.0, help="seconds of processor time for one fault")
    options = parser.parse_args()
    path = RESULTS / "mutation.json"
    stored = json.loads(path.read_text(encoding="utf-8")) if path.exists() else []
    rows = {row["part"]: row for row in stored}
    for part in options.parts:
        rows[part] = examine(part, options)
        path.write_text(json.dumps(list(rows.values()), indent=1) + "\n", encoding="utf-8")
        (RESULTS / "mutation.md").write_text("\n".join(table(list(rows.values()))) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
