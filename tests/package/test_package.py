"""What a packager relies on: one version everywhere, nothing imported that isn't declared, typed snippets."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import typed_user

import kovacic

ROOT = Path(kovacic.__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
#: The names under which distributions are imported, where these differ.
IMPORTED_AS = {"python-flint": "flint"}
# Not declared: Ray is installed by whoever has a cluster, IPython is there where a notebook is.
OPTIONAL = {"ray", "IPython"}


def names(requirements: list[str]) -> set[str]:
    found = {re.split(r"[<>=\[ ]", requirement)[0] for requirement in requirements}
    return {IMPORTED_AS.get(name, name) for name in found}


def test_the_version_stands_in_one_place() -> None:
    """In `kovacic/__init__.py`, and as the heading of its changes; recipe, metadata and pages take it from there."""
    headings = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert headings[0] == kovacic.__version__
    for name in ("pyproject.toml", "CITATION.cff", ".ci/conda/recipe.yaml", "README.md", "docs/conf.py"):
        assert kovacic.__version__ not in (ROOT / name).read_text(encoding="utf-8"), name


def test_the_page_on_an_index_has_no_links_into_the_repository() -> None:
    """With the substitution of pyproject.toml, which the build does."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["hatch"]["metadata"][
        "hooks"
    ]
    (rule,) = settings["fancy-pypi-readme"]["substitutions"]
    page = re.sub(rule["pattern"], rule["replacement"], (ROOT / "README.md").read_text(encoding="utf-8"))
    assert all(target.startswith("http") for target in re.findall(r"\]\(([^)]+)\)", page))
    assert "![" not in page
    assert "the map of the source" in page


@pytest.mark.long
def test_what_is_imported_is_declared() -> None:
    """At the head of a module only what every installation has; within functions also what an extra brings."""
    always = names(PROJECT["dependencies"]) | {"mpmath"} | set(sys.stdlib_module_names) | {"kovacic"}  # SymPy's own
    extras = set().union(*(names(PROJECT["optional-dependencies"][extra]) for extra in ("plot", "numeric", "dask")))
    late = {"doubles", "ball", "batch", "views", "bound_states"}  # rooms whose modules may need an extra as a whole
    for path in sorted((ROOT / "kovacic").rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                roots = {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                roots = {(node.module or "").partition(".")[0]}
            else:
                continue
            allowed = always | extras | OPTIONAL | {"__future__"}
            assert roots <= allowed, f"{path}: {roots - allowed}"
            if node in tree.body and path.parent.name not in late:
                assert roots <= always | {"__future__"}, f"{path}: {roots - always} at the head"


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "said"), [("x^2 + 3", "case 1"), ("x", "none"), ("x +", "the expression ends after '+'")]
)
def test_the_typed_snippet_runs(text: str, said: str) -> None:
    assert said in typed_user.verdict(text)


def test_the_conda_recipe_has_the_same_requirements() -> None:
    recipe = (ROOT / ".ci" / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    run = re.search(r"^  run:\n((?:    - .*\n)+)", recipe, re.MULTILINE)
    assert run is not None
    assert {line.replace(" ", "") for line in re.findall(r"- (.*)", run[1])} == {
        f"python{PROJECT['requires-python']}",
        *PROJECT["dependencies"],
    }


#: What Windows doesn't have, as far as one might use it.
POSIX_MODULES = ("fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty")
POSIX_NAMES = {
    "os": {
        "fork",
        "forkpty",
        "getuid",
        "geteuid",
        "killpg",
        "setsid",
        "getpgid",
        "sched_getaffinity",
        "wait3",
        "wait4",
    },
    "signal": {
        "SIGALRM",
        "SIGKILL",
        "SIGHUP",
        "SIGPIPE",
        "SIGUSR1",
        "ITIMER_REAL",
        "alarm",
        "pthread_sigmask",
        "setitimer",
    },
}


@pytest.mark.long
def test_what_windows_lacks_is_used_where_it_is_there() -> None:
    """No module imports it, and a name of `os` or `signal` stands behind a `hasattr`, or where one of the same block is."""
    for path in sorted((ROOT / "kovacic").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                assert not {alias.name for alias in node.names} & set(POSIX_MODULES), path
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                home = node.value.id
                if node.attr in POSIX_NAMES.get(home, ()):
                    assert re.search(rf"hasattr\({home}, ", text), f"{path}: {home}.{node.attr}"


@pytest.mark.long
def test_commands_run_where_nothing_of_posix_is(tmp_path: Path) -> None:
    """No signals, limits or forks; a file with a space in its name, and lines that end as on Windows."""
    (tmp_path / "in put.txt").write_bytes(b"x^2 + 3\r\nx\r\n1/2x\r\n")
    program = f"""
import os, signal, sys
for module in {POSIX_MODULES!r}:
    if module != "posix": sys.modules[module] = None
for home, names in {POSIX_NAMES!r}.items():
    for name in names - {{"SIGKILL"}}:  # with which subprocess ends its children, here
        if hasattr(sys.modules[home], name): delattr(sys.modules[home], name)
import multiprocessing
multiprocessing.set_start_method("spawn")  # the only way there
from kovacic.cli import main
statuses = [main.run(command) for command in (
    ["solve", "--json", "x^2 + 3"],
    ["evaluate", "x", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"],
    ["dsolve", "y'' + y = 0, y(0)=1, y'(0)=0"],
    ["explain", "x^2 + 3", "-o", "an answer.html"],
    ["conditions", "(4*n^2 - 1)/(4*x^2) - 1"],
    ["batch", "in put.txt", "-o", "out put.jsonl", "-j", "1", "-q"],
    ["batch", "in put.txt", "-o", "out put.jsonl", "--resume", "-j", "1", "-q"],
    ["check", "out put.jsonl"],
)]
print(statuses, file=sys.stderr)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1] == "[0, 0, 0, 0, 0, 2, 2, 3]"
    assert (tmp_path / "an answer.html").stat().st_size > 10_000
    assert len((tmp_path / "out put.jsonl").read_bytes().splitlines()) == 3
