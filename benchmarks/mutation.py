"""Do the tests notice small faults?  Plants them one at a time, runs the tests, and lists the faults that survive.

    python benchmarks/mutation.py verify --sample 100           # 100 random faults in kovacic/verify
    python benchmarks/mutation.py checker --again               # all; those that survived an earlier run as well
    python benchmarks/mutation.py package --sample 20 --contexts .coverage    # of the whole package
    python benchmarks/mutation.py package --sample 20 --contexts .coverage .coverage_long --long    # as .ci/run
    python benchmarks/mutation.py --prune                       # forget what isn't there any more

A fault is a comparison, an arithmetic or a logical operator changed into its neighbour, a whole number raised by one, a
condition negated, a refusal left out, or a predicate that is always true or always false.  It is killed when a test fails
or takes ten times as long as without the fault.  One process collects the tests of a part and runs them once, to see which
lines each one executes; for a fault it forks, exchanges the code of the function, and runs the tests that come to the
changed line, the quickest first, up to the first failure.  No file is changed.  Where the tests of a part take too long for
that, `--contexts` names a file of `pytest --cov=kovacic --cov-context=test`, which has the lines of each test.

Writes benchmarks/results/mutation.md and mutation.json: for each part the commit, and the faults that were killed and that
survived, by their names.  A later run at the same commit adds to them, at another one it starts anew.  Survivors that change
no answer are listed in mutation_explained.json, with the reason.  A test demands that every fault that is named is still there.

Method: R. DeMillo, R. Lipton and F. Sayward, "Hints on test data selection", Computer 11 (1978).
"""

from __future__ import annotations

import argparse
import ast
import gc
import hashlib
import importlib
import json
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import _lru_cache_wrapper, cache
from pathlib import Path
from random import Random
from types import CodeType, FunctionType, ModuleType
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks" / "results"
EXPLAINED: dict[str, str] = json.loads((ROOT / "benchmarks" / "mutation_explained.json").read_text(encoding="utf-8"))

ENGINE_TESTS = (
    "tests/engine/test_cases.py",
    "tests/engine/test_engine_properties.py",
    "tests/verify/test_verify.py",
    "tests/engine/test_invariants.py",
    "tests/algebra/test_bad_primes.py",
    "tests/parametric/test_parameters.py",
    "tests/algebra/test_algebraic_constants.py",
    "tests/closed_form/test_textbook_equations.py",
    "tests/engine/test_operation_counts.py",
    "tests/engine/test_search_and_kernel.py",
    "tests/galois/test_jacobian.py",
)
#: The files of a part of the package, and the tests that should notice a fault there.
PARTS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "verify": (("kovacic/verify/*.py",), (*ENGINE_TESTS, "tests/galois/test_galois.py")),
    "engine": (("kovacic/engine/*.py",), (*ENGINE_TESTS, "tests/engine/test_paper_steps.py")),
    "galois": (
        ("kovacic/galois/*.py",),
        ("tests/galois/test_galois.py", "tests/galois/test_jacobian.py", "tests/verify/test_verify.py"),
    ),
    "algebra": (("kovacic/algebra/*.py",), ("tests/algebra/test_algebra.py", *ENGINE_TESTS)),
    "checker": (("kovacic/checker.py",), ("tests/checker/test_checker.py", "tests/views/test_json.py")),
    "check": (
        ("kovacic/closed_form/check.py", "kovacic/closed_form/real_pair.py"),
        ("tests/closed_form/test_closed_form*.py",),
    ),
    "answers": (
        ("kovacic/general_solution/check.py",),
        ("tests/general_solution/test_forged_answers.py", "tests/general_solution/test_continuity.py"),
    ),
    "batch": (("kovacic/batch/*.py",), ("tests/batch/test_batch.py", "tests/batch/test_scan.py")),
    "cli": (
        ("kovacic/cli/*.py",),
        (
            "tests/cli/test_cli.py",
            "tests/cli/test_help.py",
            "tests/ball/test_ball_command.py",
            "tests/sturm_liouville/test_eigenvalues.py",
            "tests/batch/test_batch.py",
            "tests/batch/test_scan.py",
        ),
    ),
    "views": (
        ("kovacic/views/*.py", "kovacic/writing/*.py"),
        (
            "tests/cli/test_cli.py",
            "tests/views/test_explain.py",
            "tests/views/test_formulas.py",
            "tests/views/test_json.py",
            "tests/views/test_result_methods.py",
            "tests/views/test_theorem.py",
            "tests/enclosure/test_enclosure_plot.py",
        ),
    ),
    "bounds": (
        tuple(f"kovacic/enclosure/{name}.py" for name in ("t*", "fr*", "exponential", "s*")),
        ("tests/enclosure/test_*.py",),
    ),
    "package": (("kovacic/**/*.py",), ("tests", "kovacic")),
}
#: Tests that take longer (in seconds, with the lines recorded) aren't run.
SLOWEST = 4.0

SWAPPED: dict[type[ast.AST], type[ast.AST]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Add, ast.FloorDiv: ast.Mult, ast.Pow: ast.Mult, ast.Mod: ast.Add,
}  # fmt: skip


@dataclass(frozen=True)
class Fault:
    """The `number`-th possible fault of a file, in the statement of the `lines`; `name` says what is changed, and is unique."""

    file: str
    number: int
    lines: range
    name: str
    in_function: bool


class Planter(ast.NodeVisitor):
    """Walks through a module and counts the faults that can be planted; plants the one with the number `wanted`."""

    def __init__(self, file: str, wanted: int = -1) -> None:
        source = (ROOT / file).read_text(encoding="utf-8")
        self.file, self.wanted, self.source, self.tree = file, wanted, source.splitlines(), ast.parse(source)
        self.faults, self.names, self.place, self.lines = list[Fault](), Counter[str](), list[str](), range(0)
        self.visit(self.tree)

    def offer(self, node: ast.AST, what: str) -> bool:
        """Record a possible fault; is it the wanted one?"""
        line = node.lineno  # type: ignore[attr-defined]
        name = f"{self.file}: {'.'.join(self.place) or 'module'}: {what} in `{self.source[line - 1].strip()}`"
        self.names[name] += 1
        unique = f"{name} ({self.names[name]})" if self.names[name] > 1 else name
        self.faults.append(Fault(self.file, len(self.faults), self.lines, unique, bool(self.place)))
        return len(self.faults) - 1 == self.wanted

    def visit(self, node: ast.AST) -> None:
        outer = self.lines
        if isinstance(node, ast.stmt):
            body = getattr(node, "body", None)
            self.lines = range(node.lineno, body[0].lineno if body else (node.end_lineno or node.lineno) + 1)
        super().visit(node)
        self.lines = outer

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self.place.append(node.name)
        self.lines = range(node.lineno, (node.end_lineno or node.lineno) + 1)
        if node.returns is not None and ast.unparse(node.returns) == "bool":
            for value in (True, False):
                if self.offer(node, f"always {value}"):
                    node.body = [ast.copy_location(ast.Return(ast.Constant(value)), node)]
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
                node.operand = ast.copy_location(ast.UnaryOp(ast.Not(), node.operand), node)
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        if _is_number(node) and self.offer(node, f"{node.value} + 1"):
            node.value = node.value + 1  # type: ignore[operator]

    def visit_If(self, node: ast.If) -> None:
        refusal = node.body[-1]
        if isinstance(refusal, ast.Raise) and self.offer(node, f"no refusal: {ast.unparse(node.test)}"):
            node.body = [ast.copy_location(ast.Pass(), refusal)]
        self.generic_visit(node)

    def visit_Raise(self, node: ast.Raise) -> None:
        """What an error says isn't looked at."""

    def code(self) -> CodeType:
        """The module with the fault."""
        return compile(ast.fix_missing_locations(self.tree), str(ROOT / self.file), "exec")


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, int) and not isinstance(node.value, bool)


@cache
def faults(file: str) -> list[Fault]:
    """All faults that can be planted in a file."""
    return Planter(file).faults


def module_of(file: str) -> ModuleType:
    return importlib.import_module(".".join(Path(file).with_suffix("").parts).removesuffix(".__init__"))


@cache
def functions() -> dict[str, list[FunctionType]]:
    """The functions that were defined in each file, wherever they are referred to."""
    found = defaultdict[str, list[FunctionType]](list)
    for f in gc.get_objects():
        if isinstance(f, FunctionType):
            found[f.__code__.co_filename].append(f)
    return found


def plant(fault: Fault, functions: list[FunctionType]) -> None:
    """Exchange the code of the functions of a module, and its constants."""
    module = module_of(fault.file)
    codes, found = dict[tuple[str, int], CodeType](), [Planter(fault.file, fault.number).code()]
    changed = {"__name__": module.__name__}
    exec(found[0], changed)
    for code in found:
        codes[code.co_qualname, code.co_firstlineno] = code
        found += [constant for constant in code.co_consts if isinstance(constant, CodeType)]
    for function in functions:
        old = function.__code__
        new = codes.get((old.co_qualname, old.co_firstlineno))
        if new is not None and new.co_freevars == old.co_freevars:
            function.__code__ = new
    for name, value in [] if fault.in_function else [*vars(module).items()]:
        for other in [m for m in sys.modules.values() if name.isupper() and vars(m).get(name) is value]:
            setattr(other, name, changed[name])


def files_of(part: str) -> list[str]:
    return [str(path.relative_to(ROOT)) for pattern in PARTS[part][0] for path in sorted(ROOT.glob(pattern))]


class Runner:
    """A plugin of pytest: instead of running the tests that were collected, runs them for each fault that is asked for."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options, self.files, self.items = options, files_of(options.part), list[pytest.Item]()

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self.items = session.items
        for file in self.files:
            module_of(file)
        gc.unfreeze()  # what the tests have put aside, for `functions`
        functions()
        wanted = [fault for file in self.files for fault in faults(file)]
        Random(self.options.seed).shuffle(wanted)
        wanted = wanted[: self.options.sample]
        files = {fault.file for fault in wanted}
        self.seconds, self.reached = self.covered(files) if self.options.contexts else self.reach()
        part = self.options.part
        gc.freeze()  # a child that looks for garbage among a million objects copies the memory of its parent
        for fault in wanted:
            done = recorded(part)
            if fault.name in done["killed"] or (fault.name in done["survived"] and not self.options.again):
                continue
            killed = self.is_killed(fault)
            done = recorded(part)
            for key, belongs in (("killed", killed), ("survived", not killed)):
                done[key] = sorted({*done[key], fault.name} if belongs else {*done[key]} - {fault.name})
            write(part, done)
            print(
                "." if killed else f"\nsurvives: {fault.name} (line {fault.lines.start})", file=sys.stderr, flush=True
            )
        return True

    def reach(self) -> tuple[dict[str, float], dict[str, list[str]]]:
        """The seconds that each test takes, and the tests that come to each line ("file:line")."""
        tree = hashlib.sha256(
            b"".join(p.read_bytes() for d in ("kovacic", "tests") for p in sorted((ROOT / d).rglob("*.py")))
        )
        tree.update(repr(PARTS[self.options.part][1]).encode())
        store = Path(tempfile.gettempdir()) / f"mutation-{tree.hexdigest()[:16]}.json"
        if not store.exists() and self.fork(self.trace, store, limit=3600.0):
            raise SystemExit("a test fails without a fault")
        seconds, reached = json.loads(store.read_text(encoding="utf-8"))
        return seconds, reached

    def covered(self, files: set[str]) -> tuple[dict[str, float], dict[str, list[str]]]:
        """As `reach`, from a file of coverage.py with a context for each test; their lines order the tests, of 2 to 3 s."""
        from coverage import CoverageData

        data = CoverageData(no_disk=True)
        for name in self.options.contexts:
            one = CoverageData(name)
            one.read()
            data.update(one)
        lines, reached = Counter[str](), dict[str, list[str]]()
        for path in data.measured_files():
            if (file := "kovacic/" + path.rpartition("/kovacic/")[2]) in files:
                for line, contexts in data.contexts_by_lineno(path).items():
                    reached[f"{file}:{line}"] = tests = [context.rpartition("|")[0] for context in contexts]
                    lines.update(tests)
        return {test: 2 + count / lines.total() for test, count in lines.items()}, reached

    def trace(self, store: Path) -> bool:
        parts = [part for part in PARTS if PARTS[part][1] == PARTS[self.options.part][1]]
        files = {str(ROOT / file): file for part in parts for file in files_of(part)}
        caches = [function for function in gc.get_objects() if isinstance(function, _lru_cache_wrapper)]
        seconds, reached, lines = dict[str, float](), defaultdict[str, list[str]](list), set[str]()

        def in_file(frame: Any, event: str, argument: Any) -> Any:
            lines.add(f"{files[frame.f_code.co_filename]}:{frame.f_lineno}")
            return in_file

        for item, following in zip(self.items, [*self.items[1:], None], strict=True):
            for function in caches:
                function.cache_clear()
            lines.clear()
            start = time.process_time()
            sys.settrace(lambda frame, event, argument: in_file if frame.f_code.co_filename in files else None)
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            sys.settrace(None)
            seconds[item.nodeid] = round(time.process_time() - start, 3)
            for line in lines:
                reached[line].append(item.nodeid)
        if not (failed := bool(self.items[0].session.testsfailed)):
            store.write_text(json.dumps([seconds, reached]), encoding="utf-8")
        return failed

    def is_killed(self, fault: Fault) -> bool:
        """By the tests that come to the line; what is read at import concerns all that come to the file."""
        lines = [f"{fault.file}:{line}" for line in fault.lines]
        if not fault.in_function:
            lines = [line for line in self.reached if line.startswith(f"{fault.file}:")]
        tests = {test for line in lines for test in self.reached.get(line, []) if self.seconds[test] < SLOWEST}
        return bool(tests) and self.fork(self.fails, fault, functions()[str(ROOT / fault.file)], tests, limit=600.0)

    def fork(self, work: Any, *arguments: Any, limit: float) -> bool:
        """Is the work's answer true, or does it end in another way, or not at all?"""

        def child() -> None:
            os.setsid()
            null = os.open(os.devnull, os.O_RDWR)
            for stream in (0, 1, 2):
                os.dup2(null, stream)
            os._exit(work(*arguments))

        process = multiprocessing.get_context("fork").Process(target=child)
        process.start()
        process.join(limit)
        if process.exitcode is None:
            process.kill()
        with suppress(ProcessLookupError):  # and what it has started
            os.killpg(process.pid or 0, signal.SIGKILL)
        process.join()
        return process.exitcode != 0

    def fails(self, fault: Fault, functions: list[FunctionType], tests: set[str]) -> bool:
        """With the fault, does a test fail?"""
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
        plant(fault, functions)
        items = sorted(
            (item for item in self.items if item.nodeid in tests), key=lambda item: self.seconds[item.nodeid]
        )
        for item, following in zip(items, [*items[1:], None], strict=True):
            signal.setitimer(signal.ITIMER_PROF, 5 + 10 * self.seconds[item.nodeid])  # it ends this process
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            if item.session.testsfailed:
                return True
        return False


def stored() -> dict[str, Any]:
    """For each part the commit and the names of the faults that were killed and that survived."""
    path = RESULTS / "mutation.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def commit() -> str:
    """The commit whose code is read; with a + where the package or the tests were changed after it."""

    def said(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()

    return said("rev-parse", "--short", "HEAD") + ("+" if said("status", "--porcelain", "kovacic", "tests") else "")


def recorded(part: str) -> dict[str, Any]:
    """What was found at this commit."""
    found = stored().get(part)
    return found if found and found["commit"] == commit() else {"commit": commit(), "killed": [], "survived": []}


def write(part: str, found: dict[str, Any]) -> None:
    rows = {**stored(), part: found}
    ordered = {name: rows[name] for name in PARTS if name in rows}
    (RESULTS / "mutation.json").write_text(json.dumps(ordered, indent=0) + "\n", encoding="utf-8")


def living() -> set[str]:
    """The names of all faults that can be planted."""
    return {fault.name for part in PARTS for file in files_of(part) for fault in faults(file)}


def named() -> set[str]:
    """The names of all faults in the records."""
    in_record = {name for found in stored().values() for key in ("killed", "survived") for name in found[key]}
    return {*EXPLAINED, *in_record}


def prune() -> None:
    """Forget the faults in lines that were changed since."""
    there = living()
    explained = {name: reason for name, reason in EXPLAINED.items() if name in there}
    text = json.dumps(explained, indent=1, ensure_ascii=False) + "\n"
    (ROOT / "benchmarks" / "mutation_explained.json").write_text(text, encoding="utf-8")
    for part, found in stored().items():
        write(
            part, {key: value if key == "commit" else [n for n in value if n in there] for key, value in found.items()}
        )


def table() -> Iterator[str]:
    yield "# Planted faults\n\nWritten by `python benchmarks/mutation.py`; see there for what is planted.\n"
    yield "| part | commit | possible | planted | killed | explained | score |\n|---|---|---|---|---|---|---|"
    survivors = list[str]()
    for part, found in stored().items():
        possible = sum(len(faults(file)) for file in files_of(part))
        killed, names = len(found["killed"]), found["survived"]
        explained = sum(name in EXPLAINED for name in names)
        survivors += [f"- {name}: {EXPLAINED.get(name, '**not explained**')}" for name in names]
        planted = killed + len(names)
        score = killed / max(planted - explained, 1)
        yield f"| {part} | {found['commit']} | {possible} | {planted} | {killed} | {explained} | {score:.1%} |"
    yield "\nThe score leaves out the explained ones, which change no answer or are noticed by a later test.  Survivors:\n"
    yield from survivors


def write_table() -> int:
    (RESULTS / "mutation.md").write_text("\n".join(table()) + "\n", encoding="utf-8")
    return 0


def main() -> int:
    sys.path.insert(0, str(ROOT))
    sys.dont_write_bytecode = True
    os.environ["HYPOTHESIS_PROFILE"] = "mutation"
    os.chdir(ROOT)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", choices=PARTS, nargs="?")
    parser.add_argument("--prune", action="store_true", help="forget the faults in lines that were changed since")
    parser.add_argument("--sample", type=int, help="so many random faults; by default all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--contexts", nargs="+", help="files of coverage.py that have the lines of each test")
    parser.add_argument("--long", action="store_true", help="the long tests of .ci/run as well")
    parser.add_argument("--again", action="store_true", help="those that survived an earlier run, too")
    options = parser.parse_args()
    if options.prune:
        prune()
        return write_table()
    if options.part is None:
        parser.error("a part, or --prune, is expected")
    tests = [str(path.relative_to(ROOT)) for pattern in PARTS[options.part][1] for path in sorted(ROOT.glob(pattern))]
    arguments = ["-x", "-q", "-s", "-p", "no:cacheprovider", "--no-header", "--tb=no", *tests]
    arguments += ["-m", "not slow"] if options.long else []
    status = int(pytest.main(arguments, plugins=[Runner(options)]))
    write_table()
    return status


if __name__ == "__main__":
    raise SystemExit(main())
