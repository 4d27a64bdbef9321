"""A small document model: headings, paragraphs, formulas and tables, and its renderings.

A sentence is a plain string, `Math`, or a sequence of these.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import unescape
from pkgutil import get_data
from string import Template

from kovacic.errors import LimitExceeded, visible
from kovacic.limits import check_time
from kovacic.writing import escaped
from kovacic.writing.breaking import LINE, breakable, pieces, width
from kovacic.writing.formula import Math

#: Lines of a list or table that are shown by default.
SCREEN_LINES = 24
#: Characters in a line of a LaTeX table, and the largest width that a column counts with, so that the others get some.
_PAGE = 66
_COLUMN = 120

Sentence = str | Math | Sequence[str | Math]


@dataclass(frozen=True)
class Heading:
    text: str
    level: int = 2


def anchor(heading: str) -> str:
    """The name of a heading in the address of a page."""
    return re.sub(r"\W+", "-", heading).strip("-").lower()


@dataclass(frozen=True)
class Paragraph:
    sentence: Sentence


def say(*sentence: str | Math) -> Paragraph:
    return Paragraph(sentence)


@dataclass(frozen=True)
class Formula:
    math: Math


@dataclass(frozen=True)
class Table:
    """Rows of cells; without a head, the first cell of each row is its title."""

    head: Sequence[Sentence]
    rows: Sequence[Sequence[Sentence]]


Block = Heading | Paragraph | Formula | Table


@dataclass(frozen=True)
class Format:
    """The functions that write the parts of a document; `table` takes rows of cells as text, the head first.

    `environment` writes a theorem or a proof, where the format has such.
    """

    heading: Callable[[str, int], str]
    math: Callable[[Math], str]
    formula: Callable[[Math], str]
    table: Callable[[list[list[str]]], str]
    plain: Callable[[str], str]
    paragraph: Callable[[str], str] = str
    page: Callable[[str, str], str] = lambda title, body: body
    environment: Callable[[str, str], str] | None = None
    has_pictures: bool = False

    def document(self, title: str, blocks: Sequence[Block]) -> str:
        """The document on its own; `title` is that of a page of HTML."""
        return self.page(title, self.render(blocks))

    def render(self, blocks: Sequence[Block]) -> str:
        """The document as part of another one."""
        return "\n\n".join(map(self._block, blocks)) + "\n"

    def _block(self, block: Block) -> str:
        if isinstance(block, Heading):
            return self.heading(self.plain(block.text), block.level)
        if isinstance(block, Paragraph):
            return self.paragraph(self.sentence(block.sentence))
        if isinstance(block, Formula):
            return self.formula(block.math)
        return self.table([[self.sentence(cell) for cell in row] for row in (block.head, *block.rows)])

    def sentence(self, sentence: Sentence) -> str:
        """The parts of a sentence, one after the other."""
        parts = (sentence,) if isinstance(sentence, str | Math) else sentence
        return "".join(self.math(part) if isinstance(part, Math) else self.plain(part) for part in parts)


def _text_heading(text: str, level: int) -> str:
    line = "=" if level == 1 else "-"
    return f"{text}\n{line * len(text)}"


def _latex_heading(text: str, level: int) -> str:
    command = r"\section" if level == 1 else r"\subsection"
    return rf"\raggedright{command}*{{{text}}}"


def _text_table(rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join([lines[0], "  ".join("-" * width for width in widths), *lines[1:]])


def _markdown_table(rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + " --- |" * len(rows[0]), *lines[1:]])


def _latex_table(rows: list[list[str]]) -> str:
    """A table with columns of natural width, or with broken lines if together they would be wider than the page."""
    widths = [min(max(map(width, column)), _COLUMN) for column in zip(*rows, strict=True)]
    # The widths of the columns in which lines are broken; 0 for the others.
    broken = [0.0] * len(widths)
    for k, w in enumerate(widths):
        if sum(widths) > _PAGE and w > _PAGE / 6:
            broken[k] = w
    share = max(0.3, 0.9 - (sum(widths) - sum(broken)) / _PAGE) / max(1, sum(broken))  # of the line
    shares = [share * w for w in broken]
    columns = "".join(rf"p{{{share:.2f}\linewidth}}" if share else "l" for share in shares)
    lines = []
    for row in rows:
        cells = [
            rf"\raggedright {breakable(cell, share * _PAGE)}" if share else cell
            for cell, share in zip(row, shares, strict=True)
        ]
        lines.append(" & ".join(cells) + r" \tabularnewline")
    body = "\n".join([lines[0], r"\hline", *lines[1:]])
    box = f"\\sbox0{{\\def\\arraystretch{{1.3}}\\begin{{tabular}}{{{columns}}}\n{body}\n\\end{{tabular}}}}"
    fitted = r"\ifdim\wd0>\linewidth\resizebox{\linewidth}{!}{\usebox0}\else\usebox0\fi"  # graphicx
    return rf"\medskip{box}\par\noindent{fitted}\par\medskip"


def _latex_formula(math: Math) -> str:
    """A paragraph for each line."""
    # Each in a group: in a list, such as a theorem, \par doesn't end what \hangindent began.
    shown = [rf"{{\hangindent2em$\displaystyle {breakable(row)}$\par}}\smallskip" for row in math.latex_lines]
    return "\n".join([r"\smallskip", *shown])


#: Sideways alone: without overflow-y browsers would scroll up and down as well.
_SCROLLED = "overflow-x:auto; overflow-y:hidden"


def _html_table(rows: list[list[str]]) -> str:
    left = ' style="text-align:left"'
    head = "".join(f"<th{left}>{cell}</th>" for cell in rows[0])
    first = "td" if head else "th"
    lines = [f"<{first}{left}>{title}</{first}>" + "".join(f"<td{left}>{cell}</td>" for cell in rest)
             for title, *rest in rows[1:]]  # fmt: skip
    table = "".join(f"<tr>{line}</tr>" for line in (head, *lines) if line)
    return f'<div class="wide" style="{_SCROLLED}"><table>{table}</table></div>'


#: A pair of stretched parentheses around no fraction, root, table, bound of a sum or stretched sign.
_LOW = re.compile(
    r'<mo stretchy="true"( fence="true" form="prefix">&#x00028;</mo>(?:(?!<mf|<msq|<mt|<mu|<mo stretchy="true").)*)'
    r'<mo stretchy="true"( fence="true" form="postfix">)'
)
_THIN = "<mspace width='.17em'/>"


def mathml(latex: str, display: str = "inline") -> str:
    """The presentation MathML of a formula in LaTeX, which browsers show without scripts or external fonts."""
    from latex2mathml.converter import convert

    check_time()
    written = convert(latex, display=display)
    # Browsers set no space around the name of a function: t sin x would be tsinx.
    written = re.sub(
        r"(</m(?:i|n|row|sup|sub|sqrt|root|frac)>)((?:<msup>)?<mi>[a-z]{2,}</mi>)", rf"\1{_THIN}\2", written
    )
    written = re.sub(r"(<mi>[a-z]{2,}</mi>)(<m(?:[in]|sqrt|root|frac)>)", rf"\1{_THIN}\2", written)
    # After a sign of relation, a comma or a parenthesis a minus belongs to what follows.
    written = re.sub(
        r"(<mo[^>]*>(?:&#x0003D;|&#x0002C;|&#x00028;)</mo>)<mo>&#x02212;", r"\1<mo form='prefix'>&#x02212;", written
    )
    # Stretched, parentheses around a line of ordinary height stand apart from it; the inner ones first.
    count = 1
    while count:
        written, count = _LOW.subn(r'<mo stretchy="false"\1<mo stretchy="false"\2', written)
    # A prime is raised and small by itself, and infinity is no operator.
    written = re.sub(
        r"<msup>(<mi>[^<]*</mi>)<mi>(&#x0?203\d;)</mi></msup>", r"\1<mo lspace='0' rspace='0'>\2</mo>", written
    )
    return written.replace("<mo>&#x0221E;</mo>", "<mi>&#x0221E;</mi>")


def _code(math: Math) -> str:
    """A formula as text: it can't be typeset, or there is no time for it."""
    return f"<code>{escaped.html(math.text)}</code>"


def _html_math(math: Math) -> str:
    try:
        return _html_line(math.latex) if math.latex else _code(math)
    except LimitExceeded:
        return _code(math)


def _html_line(latex: str) -> str:
    """A formula in a line; one that is wider than a page becomes many small ones, between which browsers break the line."""
    if width(latex) <= 1.5 * LINE:
        return mathml(latex)
    # A sign at the beginning is one of the sum, not of its first term: empty braces before it say so.
    parts = [f"{{}} {piece}" if piece[0] in "+-" else piece for piece in pieces(latex)]
    return "<wbr/>".join(map(mathml, parts))


def _html_formula(math: Math) -> str:
    wide = f'<div class="wide" style="{_SCROLLED}; padding:.4em 0">'
    rows = math.latex_lines
    try:
        if all(width(row) <= 1.5 * LINE for row in rows):
            written = mathml(math.latex, "block") if math.latex else _code(math)
            return f"{wide}{written}</div>"
        return "".join(f'<div style="padding:.4em 0">{_html_line(row)}</div>' for row in rows)
    except LimitExceeded:
        return f"{wide}{_code(math)}</div>"


#: The formats of documents, by their names: the one place where one is chosen.
FORMATS = {
    "text": Format(
        heading=_text_heading,
        math=lambda math: math.text,
        formula=lambda math: "    " + math.text.replace("\n", "\n    "),
        table=_text_table,
        plain=visible,
    ),
    "markdown": Format(
        heading=lambda text, level: f"{'#' * level} {text}",
        math=lambda math: f"${math.latex}$",
        formula=lambda math: f"$$\n{math.latex}\n$$",
        table=_markdown_table,
        plain=escaped.markdown,
    ),
    "latex": Format(  # the body of a document with amsmath, amssymb and graphicx
        heading=_latex_heading,
        math=lambda math: f"${breakable(math.latex)}$",
        formula=_latex_formula,
        table=_latex_table,
        plain=escaped.latex,
        # Ragged lines end with their group: they aren't left behind in the author's document.
        environment=lambda name, body: f"\\begin{{{name}}}\\raggedright\n{body}\\end{{{name}}}\n",
    ),
    "html": Format(
        heading=lambda text, level: f'<h{level} id="{anchor(unescape(text))}">{text}</h{level}>',
        math=_html_math,
        formula=_html_formula,
        table=_html_table,
        plain=escaped.html,
        paragraph=lambda text: f"<p>{text}</p>",
        page=lambda title, body: _page(title, body),
        has_pictures=True,
    ),
}


def format_of(name: str = "text") -> Format:
    """The format with this name.  Raises `ValueError` for an unknown one."""
    if name not in FORMATS:
        raise ValueError(f"unknown format {name!r}; available: {', '.join(FORMATS)}")
    return FORMATS[name]


def notebook_table(rows: Sequence[Sequence[Sentence]]) -> str:
    """Rows of a title and its contents, in HTML."""
    return FORMATS["html"].render([Table((), rows)]).rstrip()


def _page(title: str, body: str) -> str:
    """A self-contained page of HTML in ASCII; its styles apply to itself alone, also within a notebook."""
    font = b64encode(get_data("kovacic.writing", "math.woff2") or b"").decode("ascii")
    written = _HTML.substitute(title=escaped.html(title), font=font, body=body)
    return written.encode("ascii", "xmlcharrefreplace").decode()


_HTML = Template("""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
@font-face { font-family: "kovacic math"; src: url(data:font/woff2;base64,$font) format("woff2") }
.kovacic { max-width: 52rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 Georgia, serif; color: #222; background: #fff }
.kovacic table { border-collapse: collapse; margin: 1rem 0 }
.kovacic td, .kovacic th { padding: .25rem .8rem; border-bottom: 1px solid #ddd }
.kovacic h2 { margin-top: 2rem; border-bottom: 1px solid #ccc } .kovacic svg { max-width: 100%; height: auto }
.kovacic math { font-family: "kovacic math", math; font-size: 1.08em }
.kovacic p { overflow-x: auto; overflow-y: hidden; padding: .25em 0; margin: .75em 0 }
.kovacic .wide, .kovacic p { background:
  linear-gradient(to right, #fff 40%, #fff0) left/2rem 100% no-repeat local,
  linear-gradient(to left, #fff 40%, #fff0) right/2rem 100% no-repeat local,
  linear-gradient(to right, #0004, #0000) left/.7rem 100% no-repeat scroll,
  linear-gradient(to left, #0004, #0000) right/.7rem 100% no-repeat scroll }
.kovacic mtd { text-align: left; math-style: normal }
.kovacic figure { margin: 1rem 0 } .kovacic figcaption { color: #666; font-size: .9em }
.kovacic nav ul { columns: 16rem; padding-left: 1.2rem } .kovacic a { color: #04529c }
</style></head><body><main class="kovacic">
$body</main></body></html>
""")
