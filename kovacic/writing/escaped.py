r"""Escapes untrusted text, one function per output format; `kovacic.errors.visible` is that for a terminal.

Equations, names and messages may come from anybody: a file, an answer in JSON that was changed by hand.  A terminal would
obey escape sequences in them, marks that reverse the direction of writing would mislead a reader, LaTeX would obey \input, and
browsers <script> and links.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

from kovacic.errors import visible

_LATEX = {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "$": r"\$",
    ">=": r"$\ge$",
    "<=": r"$\le$",
    "<": "$<$",
    ">": "$>$",
    "|": "$|$",
    **{char: f"\\{char}" for char in "&%#_{}"},
}
_LATEX_PATTERN = re.compile("|".join(map(re.escape, _LATEX)))
_MARKDOWN_PATTERN = re.compile(r"[\\`*_\[\]<>$|#]")


def in_one_line(text: str) -> str:
    """The text for a terminal, with line ends escaped as well."""
    return visible(text).replace("\n", r"\n")


def latex(text: str) -> str:
    r"""For LaTeX, outside of formulas.

    >>> print(latex(r"50 % of \input{x}, y^2 <= 1"))
    50 \% of \textbackslash{}input\{x\}, y\textasciicircum{}2 $\le$ 1
    """
    return _LATEX_PATTERN.sub(lambda match: _LATEX[match[0]], visible(text))


def markdown(text: str) -> str:
    r"""For Markdown, outside of formulas.

    >>> print(markdown("[a_1](javascript:b) <i>"))
    \[a\_1\](javascript:b) \<i\>
    """
    return _MARKDOWN_PATTERN.sub(lambda match: "\\" + match[0], in_one_line(text))


def html(text: str) -> str:
    """For HTML, between tags and in the values of attributes.

    >>> html('<a href="b">')
    '&lt;a href=&quot;b&quot;&gt;'
    """
    from html import escape  # with a table of all entities, which no other format needs

    return escape(visible(text))


def json_line(data: Any, default: Callable[[Any], str] | None = None) -> str:
    r"""An object as one line of JSON in UTF-8, with unprintable characters escaped.

    `default` turns what JSON doesn't have into a text.

    >>> json_line({"note": "\u03bb \u202e"})
    '{"note": "\u03bb \\u202e"}'
    """
    line = json.dumps(data, ensure_ascii=False, default=default)
    if line.isprintable():
        return line
    return "".join(char if char.isprintable() else json.dumps(char)[1:-1] for char in line)


def strict_json(text: str) -> Any:
    """The value of a JSON text.  Raises `ValueError` for what Python reads beyond JSON: repeated keys, NaN and Infinity.

    >>> strict_json('{"S": "x", "S": "2"}')
    Traceback (most recent call last):
    ValueError: a key occurs twice in one object: 'S'
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in pairs:
            if key in found:
                raise ValueError(f"a key occurs twice in one object: {key!r}")
            found[key] = value
        return found

    def no_number(name: str) -> Any:
        raise ValueError(f"{name} isn't a number in JSON")

    return json.loads(text, object_pairs_hook=once, parse_constant=no_number)
