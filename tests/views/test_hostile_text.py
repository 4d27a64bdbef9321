r"""Text from outside does nothing where it is shown: a terminal, LaTeX, Markdown, HTML, JSON."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from html.parser import HTMLParser
from typing import Any

import pytest
from build import Conditions, generated, parametrize
from hypothesis import given
from hypothesis import strategies as st

import kovacic
from kovacic import InputError
from kovacic.errors import visible
from kovacic.writing import escaped

#: Each is obeyed by something.
HOSTILE = [
    "\x1b[31mred",
    "\x1b]0;title\a",
    "\a",
    "\b\b\b",
    "\r0 = 0",
    "\x9b31m",
    "\u202e x = y \u202c",
    "\u2066hidden\u2069",
    "\u200bzero width",
    "\u2028line",
    r"\input{/etc/passwd}",
    r"\write18{ls}",
    r"$\input{a}$ % ~ ^ & # _ {",
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "[here](javascript:alert(1))",
    "![](http://example.org/a.png)",
    "`code` **bold** | cell |",
    "</td></table><b>",
    "\n# Title\n- item",
]

#: All of them in two answers, since an answer in all its forms takes a second.
TOGETHER = ["".join(HOSTILE[:10]), "".join(HOSTILE[10:])]

_texts = st.lists(st.sampled_from(HOSTILE) | st.text(max_size=8), min_size=1, max_size=4).map("".join)


def obeyed_by_a_terminal(text: str) -> set[str]:
    return {char for char in text if not char.isprintable() and char != "\n"}


def obeyed_by_latex(text: str) -> list[str]:
    return re.findall(r"\\(?:input|write18)", text)


class Tags(HTMLParser):
    """The names of the tags of a page, and the addresses in them."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.found: set[str] = set()
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.add(tag)
        self.found.update(name for name, _ in attrs if name.startswith("on"))


# What Markdown would take for a link, a tag, code, emphasis, mathematics or a cell: one that isn't escaped.
_OBEYED_BY_MARKDOWN = re.compile(r"(?<!\\)(?:\\\\)*[<\[\]`*_$|#]|\n")


@pytest.mark.long
@generated(40)
@given(_texts)
def test_escaped_text_does_nothing(text: str) -> None:
    assert not obeyed_by_a_terminal(visible(text))
    assert not obeyed_by_latex(escaped.latex(text))
    assert _OBEYED_BY_MARKDOWN.search(escaped.markdown(text)) is None
    assert Tags(escaped.html(text)).found == set()
    line = escaped.json_line({"note": text})
    assert line.isprintable()
    assert json.loads(line) == {"note": text}


@pytest.mark.parametrize("text", HOSTILE)
def test_errors_show_what_was_given(text: str) -> None:
    for given_text in (f"x^2 + {text} @", f"y'' = x*y {text}", f"x + {text * 20}", f"{text}(x)"):
        for call in (kovacic.solve, kovacic.conditions, kovacic.dsolve):
            with pytest.raises(kovacic.KovacicError) as caught:
                call(given_text)
            assert not obeyed_by_a_terminal(str(caught.value))


def test_the_marker_is_below_the_character_that_is_shown() -> None:
    with pytest.raises(InputError) as caught:
        kovacic.solve("x + \u202e1")
    _, _, excerpt, marker, *_ = str(caught.value).splitlines()
    assert excerpt[marker.index("^") :].startswith(r"\u202e1")


def changed(equation: str, **changes: Any) -> dict[str, Any]:
    return {**json.loads(kovacic.solve(equation).to_json()), **changes}


@pytest.mark.long
@pytest.mark.parametrize(
    ("equation", "text"), list(zip(["x^2 + 3", "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"], TOGETHER, strict=True))
)
def test_an_answer_that_was_changed_by_hand(equation: str, text: str) -> None:
    """Its notices are shown as they are; names and formulas are read, and refused where they aren't what was claimed."""
    answer = kovacic.Solution.from_json(changed(equation, notices=[text]))
    assert answer.verify()
    assert not obeyed_by_a_terminal(str(answer) + answer.explain() + repr(answer) + answer.to_json())
    assert not obeyed_by_latex(answer.explain(format="latex") + answer._repr_latex_())
    markdown = answer.explain(format="markdown")
    (note,) = [line for line in markdown.splitlines() if line.startswith("Note: ")]
    assert _OBEYED_BY_MARKDOWN.search(note) is None
    assert not Tags(answer.explain(format="html") + answer._repr_html_()).found & {"script", "img", "b", "onerror"}
    for key in ("input", "variable", "S", "status"):
        with pytest.raises(InputError) as caught:
            kovacic.Solution.from_json(changed(equation, **{key: text}))
        assert not obeyed_by_a_terminal(str(caught.value))


@pytest.mark.long
@pytest.mark.parametrize("text", TOGETHER)
def test_an_undecided_answer_with_another_reason(text: str) -> None:
    data = json.loads(kovacic.solve("x^4 + x^2 + 2002*x + 1/4", limits=kovacic.Limits(unknown_degree=100)).to_json())
    assert data["status"] == "undecided"
    data["proof"]["undecided"] = text
    answer = kovacic.Solution.from_json(data)
    assert not obeyed_by_a_terminal(str(answer) + answer.explain())
    assert not obeyed_by_latex(answer.explain(format="latex") + answer._repr_latex_())
    assert not Tags(answer.explain(format="html") + answer._repr_html_()).found & {"script", "img", "b", "onerror"}


@pytest.mark.parametrize("text", TOGETHER)
def test_conditions_that_were_changed_by_hand(text: str) -> None:
    data = json.loads(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").to_json())
    data |= {"notices": [text], "theory": text, "complete": text, "theorem": {"said": text, "sources": [text]}}
    data["regions"][0] |= {"omega": text}
    data["generic"]["verdict"]["family"] = text
    found = Conditions.from_json(json.dumps(data))
    assert not obeyed_by_a_terminal(str(found) + found.explain() + found.to_json())
    assert not obeyed_by_latex(found.latex() + found._repr_latex_())
    for key in ("variable", "S"):
        with pytest.raises(InputError) as caught:
            Conditions.from_json(json.dumps({**data, key: text}))
        assert not obeyed_by_a_terminal(str(caught.value))


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, '{"schema": 1, "input": ' + "[" * 100_000])
def test_brackets_without_end_are_refused(text: str) -> None:
    for reader in (kovacic.Solution.from_json, Conditions.from_json):
        with pytest.raises(InputError):
            reader(text)


@parametrize(
    "arguments",
    [
        ["solve"],
        ["solve", "--limit"],
        ["solve", "x", "--assume"],
        ["batch"],
        ["check"],
        ["scan", "x+n"],
        ["solve", "x", "-o"],
    ],
    ids=str,
    ordinary=0,
    long=4,
)
def test_the_command_shows_its_arguments(arguments: list[str]) -> None:
    hostile = "x\x1b[31m\a\u202e\x9b @"
    command = [sys.executable, "-m", "kovacic", *arguments, hostile]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=60)
    assert done.returncode == 2
    assert not obeyed_by_a_terminal(done.stdout + done.stderr)
