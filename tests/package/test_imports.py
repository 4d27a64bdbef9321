"""What imports what: the layers, and the heavy packages that must not be paid for at the start."""

from __future__ import annotations

import ast
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from build import parametrize

import kovacic

ROOT = Path(kovacic.__file__).parent
HEAVY = {"sympy", "mpmath", "matplotlib", "numpy", "scipy", "rich", "joblib", "dask", "hypothesis", "pytest"}


def loaded_after(code: str) -> set[str]:
    """The top-level packages that a fresh interpreter has imported after running `code`."""
    report = "import sys; print('\\n' + ' '.join(sorted({name.partition('.')[0] for name in sys.modules})))"
    done = subprocess.run([sys.executable, "-c", f"{code}\n{report}"], capture_output=True, text=True, check=True)
    return set(done.stdout.splitlines()[-1].split())


def test_importing_the_package_imports_nothing_heavy() -> None:
    alone = "import sys, kovacic; assert not any(name.startswith('kovacic.') for name in sys.modules)"
    assert loaded_after(alone) & (HEAVY | {"click", "dataclasses", "flint", "fractions", "json", "typing"}) == set()


def test_every_public_name_is_there_when_it_is_used() -> None:
    for name in kovacic.__all__:
        assert getattr(kovacic, name).__module__.startswith(kovacic._MODULES[name])
        assert name in dir(kovacic)
    with pytest.raises(AttributeError, match="no attribute 'sovle'"):
        _ = kovacic.sovle


def test_a_function_keeps_its_name_beside_its_module() -> None:
    """`kovacic.solve` stays the function whatever was imported before: no module has the name of a function."""
    assert not [name for name in kovacic.__all__ if (ROOT / f"{name}.py").exists() or (ROOT / name).exists()]


@pytest.mark.long
def test_solving_text_imports_nothing_heavy() -> None:
    code = "import kovacic; a = kovacic.solve('x^2+3'); b = kovacic.solve(([0, 1], [1])); str(a), a.verify(), b.proof"
    assert loaded_after(code) & (HEAVY | {"click"}) == set()


@parametrize(
    "arguments",
    [
        ["solve", "--no-solutions", "2/x^2 - 1"],
        ["solve", "--no-solutions", "x^2*y'' + x*y' + (x^2 - 9/4)*y = 0"],
        ["solve", "--json", "2/x^2 - 1"],
        ["solve", "--json", "x"],
        ["--help"],
        ["solve", "--help"],
    ],
    ordinary=1,
    long=3,
    ids=str,
)
def test_the_command_imports_nothing_heavy(arguments: list[str]) -> None:
    assert loaded_after(f"from kovacic.cli.main import run; run({arguments!r})") & HEAVY == set()


@pytest.mark.long
def test_the_command_starts_with_few_modules() -> None:
    """It takes 0.13 s with these, of which FLINT's import is a half: another third needs a reason."""
    called = "run(['solve', '--no-solutions', '2/x^2 - 1'])"
    count = f"import sys; from kovacic.cli.main import run; {called}; print(len(sys.modules))"
    done = subprocess.run([sys.executable, "-c", count], capture_output=True, text=True, check=True)
    assert int(done.stdout.splitlines()[-1]) < 320


def test_the_layers_hold() -> None:
    """The contracts of pyproject.toml, checked by import-linter."""
    command = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    done = subprocess.run(
        [sys.executable, "-c", command, "--no-cache"], cwd=ROOT.parent, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_trusted_kernel_imports_algebra_and_decision_only() -> None:
    """And `compatibility`, which has parts of Python's own library."""
    allowed = {"algebra", "compatibility", "decision", "errors", "limits", "verify"}
    for path in sorted((ROOT / "verify").glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            for name in names:
                if name.partition(".")[0] == "kovacic":
                    assert name.split(".")[1] in allowed, f"{path.name} imports {name}"


def imports() -> dict[str, set[str]]:
    """For each module of the package those that its import statements name, in functions and for type checking included.

    Only `kovacic.solution` may look up within functions and for types: the views of an answer are computed when asked for.
    """
    paths = {".".join(path.relative_to(ROOT.parent).with_suffix("").parts): path for path in ROOT.rglob("*.py")}
    modules = {name.removesuffix(".__init__"): path for name, path in paths.items()}
    found: dict[str, set[str]] = {}
    for name, path in modules.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        nodes = tree.body if name == "kovacic.solution" else list(ast.walk(tree))
        targets: list[str] = []
        for node in nodes:
            if isinstance(node, ast.Import):
                targets += [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                assert not node.level, f"{name}: a relative import"
                inner = [f"{node.module}.{alias.name}" for alias in node.names]
                targets += [full if full in modules else str(node.module) for full in inner]
        found[name] = {target for target in targets if target in modules} - {name}
    return found


def circles(edges: dict[str, set[str]]) -> set[frozenset[str]]:
    """The strongly connected components with more than one member."""

    def reached(start: str) -> set[str]:
        seen, todo = set[str](), [start]
        while todo:
            new = edges[todo.pop()] - seen
            seen |= new
            todo += new
        return seen

    reach = {name: reached(name) for name in edges}
    return {frozenset(other for other in reach[name] if name in reach[other]) for name in edges if name in reach[name]}


def test_circles_are_found() -> None:
    edges = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": {"e"}, "e": {"f"}, "f": {"d"}, "g": {"a", "e"}}
    assert circles(edges) == {frozenset("bc"), frozenset("def")}


@pytest.mark.long
def test_no_circle_of_imports() -> None:
    assert not circles(imports())


# Where text from users arrives, or what was made from it.
TEXT_FACING = (
    "api.py",
    "batch",
    "bound_states",
    "cli",
    "closed_form",
    "doubles",
    "enclosure",
    "parametric",
    "reading",
    "solution",
    "views",
)


@pytest.mark.long
def test_nothing_executes_text() -> None:
    """No eval, exec, parse_expr, and where text from users arrives no sympify but the strict one: it would run."""
    for path in sorted(ROOT.rglob("*.py")):
        forbidden = {"eval", "exec", "parse_expr"}
        if path.relative_to(ROOT).parts[0] in TEXT_FACING:
            forbidden.add("sympify")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                if any(keyword.arg == "strict" and ast.unparse(keyword.value) == "True" for keyword in node.keywords):
                    continue  # sympify(..., strict=True) refuses text
                called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
                assert called not in forbidden, f"{path}: {called}"


def test_what_the_kernel_shares_with_the_search() -> None:
    """Arithmetic in rings and fields; the contract forbids every other module."""
    rooms = {path.stem for path in (ROOT / "algebra").glob("*.py")} - {"__init__"}
    shared = {"extension", "function_field", "poly", "ratfunc", "rationals"}
    contracts = tomllib.loads((ROOT.parent / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    forbidden = next(c["forbidden_modules"] for c in contracts["contracts"] if "shares arithmetic" in c["name"])
    assert {f"kovacic.algebra.{name}" for name in rooms - shared} == set(forbidden)
