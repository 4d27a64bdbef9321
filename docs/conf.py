"""The documentation: `pip install -e ".[docs]"`, then `sphinx-build -W -n -b html docs build/html`.

Formulas become MathML, pictures are drawn by `pictures.py`, tables of results are filled in by `tables.py`, all at build: the
pages load nothing from anywhere.  The
examples are run by `tests/package/test_documentation.py`.
"""

from __future__ import annotations

import importlib
import re
import runpy
import sys
from pathlib import Path
from typing import Any

from docutils import nodes

import kovacic
from kovacic.writing.document import mathml

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
tables = importlib.import_module("tables")

project = "kovacic"
author = "The kovacic developers"
version = release = kovacic.__version__
copyright = author

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
napoleon_google_docstring = False
napoleon_use_param = False  # types are words, not links
napoleon_use_rtype = False
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
nb_execution_mode = "force"  # the notebook has no outputs of its own
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_mime_priority_overrides = [("html", "image/png", 1), ("html", "text/html", 2)]
exclude_patterns = ["build", "_build"]
suppress_warnings = ["myst.strikethrough"]

default_role = "code"
smartquotes = False  # snippets are to be pasted
autodoc_typehints = "signature"
python_use_unqualified_type_names = True
nitpick_ignore_regex = [("py:.*", ".*")]  # types in signatures are words, too
autodoc_preserve_defaults = True
autodoc_member_order = "bysource"
autoclass_content = "class"

html_theme = "furo"
html_title = f"kovacic {version}"
html_static_path = ["_static", "../kovacic/writing/math.woff2"]
html_css_files = ["formulas.css"]
html_show_sourcelink = False
html_copy_source = False
html_math_renderer = "mathml"


def _inline(writer: Any, node: nodes.math) -> None:
    writer.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def _display(writer: Any, node: nodes.math_block) -> None:
    writer.body.append(f'<div class="formula">{mathml(node.astext(), "block")}</div>')
    raise nodes.SkipNode


def _as_rst(app: Any, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Docstrings are written for reading: bars are no substitutions, and a list needs no empty line before it."""
    result: list[str] = []
    session = inside = False
    for line in lines:
        session = line.lstrip().startswith(">>>") or (session and bool(line.strip()))
        item = line.startswith("- ")
        if result and result[-1] and line and item != inside and not (inside and line.startswith(" ")):
            result.append("")
        inside = item or (inside and line.startswith(" "))
        result.append(line if session else line.replace("|", "\\|"))
    lines[:] = result


def _one_by_one(app: Any, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Attributes that are described together, `num, den : Poly`, get an entry each, as parameters do."""
    if what == "property":
        lines.insert(0, "")  # else what stands before a colon is taken for the type
    if "Attributes" not in lines:
        return
    start = lines.index("Attributes") + 2
    for k in reversed(range(start, len(lines))):
        together = re.fullmatch(r"(\w+(?:, \w+)+) : (.*)", lines[k])
        if together is not None:
            end = next((j for j in range(k + 1, len(lines)) if not lines[j].startswith(" ")), len(lines))
            said = lines[k + 1 : end]
            lines[k:end] = [line for each in together[1].split(", ") for line in (f"{each} : {together[2]}", *said)]


def _take_notebook(app: Any) -> None:
    """The tour as a page, whose outputs are computed when it is built."""
    target = HERE / "notebook.ipynb"
    target.write_bytes((HERE.parent / "examples" / "kovacic.ipynb").read_bytes())


def _draw(app: Any) -> None:
    runpy.run_path(str(HERE / "pictures.py"))["draw_all"](HERE / "_static" / "pictures")


def _fill(app: Any, name: str, source: list[str]) -> None:
    source[0] = tables.filled(source[0])


def setup(app: Any) -> None:
    """Sphinx calls this."""
    app.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_display, None))
    app.connect("config-inited", lambda app, _: _take_notebook(app))
    app.connect("builder-inited", _draw)
    app.connect("source-read", _fill)
    app.connect("autodoc-process-docstring", _one_by_one, priority=100)  # before napoleon
    app.connect("autodoc-process-docstring", _as_rst)
