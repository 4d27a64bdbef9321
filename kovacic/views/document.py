"""A small document model: headings, paragraphs, formulas and tables, and its three renderings.

A sentence is a sequence of plain strings and `Math`, which has both a readable and a LaTeX form.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Math:
    """A formula, for reading and for LaTeX."""

    text: str
    latex: str


Sentence = tuple[str | Math, ...]


@dataclass(frozen=True)
class Heading:
    text: str
    level: int = 2


@dataclass(frozen=True)
class Paragraph:
    sentence: Sentence


@dataclass(frozen=True)
class Formula:
    math: Math


@dataclass(frozen=True)
class Table:
    head: tuple[str, ...]
    rows: tuple[tuple[Sentence, ...], ...]


Block = Heading | Paragraph | Formula | Table


def to_text(blocks: Sequence[Block]) -> str:
    """Plain text."""
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(f"{block.text}\n{('=' if block.level == 1 else '-') * len(block.text)}")
        elif isinstance(block, Paragraph):
            parts.append(_sentence(block.sentence, lambda math: math.text))
        elif isinstance(block, Formula):
            parts.append("    " + block.math.text.replace("\n", "\n    "))
        else:
            parts.append(_text_table(block))
    return "\n\n".join(parts) + "\n"


def to_markdown(blocks: Sequence[Block]) -> str:
    """Markdown with formulas between dollar signs."""
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(f"{'#' * block.level} {block.text}")
        elif isinstance(block, Paragraph):
            parts.append(_sentence(block.sentence, lambda math: f"${math.latex}$"))
        elif isinstance(block, Formula):
            parts.append(f"$$\n{block.math.latex}\n$$")
        else:
            rows = [[_sentence(cell, lambda math: f"${math.latex}$") for cell in row] for row in block.rows]
            lines = ["| " + " | ".join(row) + " |" for row in (list(block.head), *rows)]
            lines.insert(1, "|" + " --- |" * len(block.head))
            parts.append("\n".join(lines))
    return "\n\n".join(parts) + "\n"


def to_latex(blocks: Sequence[Block]) -> str:
    """LaTeX for the body of a document, with amsmath."""
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(rf"\{'section' if block.level == 1 else 'subsection'}*{{{_escaped(block.text)}}}")
        elif isinstance(block, Paragraph):
            parts.append(_sentence(block.sentence, lambda math: f"${math.latex}$", _escaped))
        elif isinstance(block, Formula):
            parts.append(f"\\[\n{block.math.latex}\n\\]")
        else:
            rows = [[_sentence(cell, lambda math: f"${math.latex}$", _escaped) for cell in row] for row in block.rows]
            head = [_escaped(cell) for cell in block.head]
            lines = [" & ".join(row) + r" \\" for row in (head, *rows)]
            lines.insert(1, r"\hline")
            body = "\n".join(lines)
            parts.append(f"\\begin{{tabular}}{{{'l' * len(head)}}}\n{body}\n\\end{{tabular}}")
    return "\n\n".join(parts) + "\n"


def _sentence(sentence: Sentence, math: Callable[[Math], str], plain: Callable[[str], str] = str) -> str:
    return "".join(math(part) if isinstance(part, Math) else plain(part) for part in sentence)


def _escaped(text: str) -> str:
    for char in "&%#_{}":
        text = text.replace(char, "\\" + char)
    return text.replace("^", r"\textasciicircum ")


def _text_table(table: Table) -> str:
    rows = [list(table.head), *([_sentence(cell, lambda math: math.text) for cell in row] for row in table.rows)]
    widths = [max(len(row[k]) for row in rows) for k in range(len(table.head))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(lines)
