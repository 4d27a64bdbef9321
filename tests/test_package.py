"""What a packager relies on: one version everywhere, nothing imported that isn't declared, typed snippets."""

from __future__ import annotations

import ast
import re
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
    """In `kovacic/__init__.py`, and as the heading of its changes; the recipe, the metadata and the pages take it from there."""
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


def test_what_is_imported_is_declared() -> None:
    """At the head of a module only what every installation has; within functions also what an extra brings."""
    always = names(PROJECT["dependencies"]) | set(sys.stdlib_module_names) | {"kovacic"}
    extras = set().union(*(names(PROJECT["optional-dependencies"][extra]) for extra in ("plot", "numeric", "dask")))
    late = {"doubles", "ball", "batch", "views"}  # rooms whose modules may need an extra as a whole
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
