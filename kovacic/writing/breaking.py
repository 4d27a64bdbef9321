r"""Long formulas in LaTeX, written so that TeX can break their lines.

TeX breaks a formula in a paragraph after + and =, but not inside \frac{}{}, \sqrt{}, \left( \right), a power or braces.
If one of these is too wide, it is written on the line: (x + 1)/(x - 1), (x + 1)^{1/2}, \exp(...), plain parentheses.
Everything narrower is unchanged.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import accumulate

# A node is a token, or the list of those between braces.
Node = str | list["Node"]

#: Characters in a line of the class article.
LINE = 60
_LATEX_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+|.", re.DOTALL)
_BETWEEN_FACTORS = re.compile(r"(?:(?<=[})])(?<!_\{1\})|(?<=[^\w\\]\w)) *(?=\\sqrt|\\left|\\bigl|{}_)|(?<=[})]) (?=\()")
_FRACTION_COMMANDS = (r"\frac", r"\tfrac")
_FACTOR_COMMANDS = (*_FRACTION_COMMANDS, r"\sqrt", r"\left", r"\operatorname", r"\cos", r"\sin", r"\exp", r"\log")
_WITH_ARGUMENT = (r"\operatorname", r"\text", r"\mathrm", r"\mathbb", r"\begin", r"\end", "_", "^")
_WIDTHS = {"+": 2.4, "-": 2.4, "=": 2.4, r"\cos": 3, r"\sin": 3, r"\exp": 3}
_NO_WIDTH = ("", "{", "}", "$", " ", r"\left", r"\right", r"\displaystyle", r"\,", r"\;")


def width(latex: str) -> float:
    """The approximate width of a formula in print, in characters."""
    return _width(_parsed(latex))


def breakable(latex: str, line: float = LINE) -> str:
    r"""A formula in which nothing unbreakable is wider than half a line; unchanged if it fits into a line.

    >>> print(breakable(r"\frac{x^{2} + 1}{\sqrt{x}}", line=4))
    \bigl(x^{2} + 1\bigr)/\allowbreak \sqrt {x}
    """
    nodes = _parsed(latex)
    if _width(nodes) <= line:
        return latex
    return _BETWEEN_FACTORS.sub(r"\\allowbreak ", _LineBreaker(line / 2).written(nodes))


def pieces(latex: str) -> list[str]:
    """The parts of a breakable formula between possible line breaks; a sign begins a part."""
    found = [""]
    depth = 0
    before = ""
    for token in _LATEX_TOKEN.findall(breakable(latex)):
        may_break = depth == 0 and found[-1] and before not in ("", "=", "(")
        if may_break and token in ("+", "-", r"\allowbreak"):
            found.append("")
        if token != r"\allowbreak":
            found[-1] += token
        found[-1] = found[-1].lstrip()
        depth += {"{": 1, "}": -1, r"\left": 1, r"\right": -1}.get(token, 0)
        if token != " ":
            before = token
    return [piece for piece in found if piece]


def _parsed(latex: str) -> list[Node]:
    stack: list[list[Node]] = [[]]
    # A command's argument follows it at once, also in a formula that was broken before: \frac {a}{b}.
    for token in _LATEX_TOKEN.findall(re.sub(r"(\\[A-Za-z]+) +(?![A-Za-z])", r"\1", latex)):
        if token == "{":
            stack.append([])
        elif token == "}" and len(stack) > 1:
            group = stack.pop()
            stack[-1].append(group)
        else:
            stack[-1].append(token)
    return stack[0]


def _nodes_of_argument(nodes: list[Node], k: int) -> list[Node]:
    node = nodes[k]
    return node if isinstance(node, list) else [node]


def _width(nodes: list[Node]) -> float:
    total = 0.0
    rest = iter(nodes)
    for node in rest:
        if isinstance(node, list):
            total += _width(node)
        elif node in _FRACTION_COMMANDS:
            total += max(_width([next(rest, "")]), _width([next(rest, "")]))
        elif node in ("^", "_"):
            total += 0.7 * _width([next(rest, "")])
        elif node.isdigit():
            total += len(node)
        elif node not in _NO_WIDTH:
            total += _WIDTHS.get(node, 1.1)
    return total


@dataclass(frozen=True)
class _LineBreaker:
    """Writes constructs that are wider than `most` on the line."""

    most: float

    def written(self, nodes: list[Node]) -> str:
        written = ""
        while nodes:
            end = _length_of_construct(nodes)
            construct, nodes = nodes[:end], nodes[end:]
            # e^{...} with an exponent that has to be broken becomes exp(...).
            exponent = _nodes_of_argument(construct, 1) if construct[0] == "^" and len(construct) > 1 else []
            if written.endswith("e") and _width(exponent) > self.most:
                written = rf"{written[:-1]}\exp\bigl({self.written(exponent)}\bigr)"
            else:
                piece = self._construct(construct)
                is_broken = construct[0] in _FRACTION_COMMANDS and piece != _verbatim(construct)
                written += rf"\bigl({piece}\bigr)" if is_broken and _begins_with_factor(nodes) else piece
        return written

    def _construct(self, nodes: list[Node]) -> str:
        """A construct on the line: a command with its arguments, a group, or a token."""
        first = nodes[0]
        if isinstance(first, list):
            return self.written(first) if _width(first) > self.most else _verbatim(nodes)
        if first == r"\sqrt":
            return self._root(nodes)
        if first == r"\left" and nodes[1] == "(" and _width(nodes[2:-2]) > self.most:
            return rf"\bigl({self._inside(nodes[2:-2])}\bigr)"
        if first in _FRACTION_COMMANDS and _width(nodes) > self.most:
            return f"{self._factor(_nodes_of_argument(nodes, 1))}/\\allowbreak {self._factor(_nodes_of_argument(nodes, 2))}"
        if first.isdigit() and len(first) > self.most / 2:
            return r"\allowbreak ".join(re.findall(r"\d{1,10}", first))
        return r",\allowbreak " if first == "," else _verbatim(nodes)

    def _root(self, nodes: list[Node]) -> str:
        r"""\sqrt, perhaps with an index in brackets, and its radicand."""
        inside = _nodes_of_argument(nodes, len(nodes) - 1)
        if _width(inside) <= self.most:
            return _verbatim(nodes)
        index = _verbatim(nodes[2:-2]) or "2"
        return rf"\bigl({self.written(inside)}\bigr)^{{1/{index}}}"

    def _inside(self, nodes: list[Node]) -> str:
        """Between parentheses; parameters and argument of a hypergeometric function in one line, with semicolons."""
        if r"\middle" not in nodes:
            return self.written(nodes)
        matrix = nodes[2 : nodes.index(r"\end")]
        argument = nodes[nodes.index(r"\middle") + 2 :]
        rows = _verbatim(matrix).replace(r"\\", ";").replace(r"\frac", r"\tfrac")
        return f"{rows}; {self.written(argument)}"

    def _factor(self, nodes: list[Node]) -> str:
        """In parentheses, if it is a sum or a product."""
        parts = [node for node in nodes if node != " "]
        rest = parts[_length_of_construct(parts) :]
        is_one = parts[0] not in _FRACTION_COMMANDS and (not rest or (rest[0] == "^" and len(rest) == 2))
        written = self.written(nodes)
        return written if is_one else rf"\bigl({written}\bigr)"


def _length_of_construct(nodes: list[Node]) -> int:
    """The number of nodes of the first construct: a command with its arguments, a group, or a token."""
    first = nodes[0]
    if first == r"\sqrt":
        return nodes.index("]") + 2 if nodes[1:2] == ["["] else 2
    if first == r"\left":
        depths = accumulate({r"\left": 1, r"\right": -1}.get(str(node), 0) for node in nodes)
        return [*depths].index(0) + 2
    if first in _FRACTION_COMMANDS:
        return 3
    return 2 if first in _WITH_ARGUMENT else 1


def _begins_with_factor(nodes: list[Node]) -> bool:
    """Would what follows a/b be read as a factor of b?"""
    after = next((node for node in nodes if node != " "), "")
    return isinstance(after, list) or after.isalnum() or after == "(" or after in _FACTOR_COMMANDS


def _verbatim(nodes: list[Node]) -> str:
    """The nodes unchanged, with a space behind each command."""
    written = ""
    for node in nodes:
        if isinstance(node, list):
            written += f"{{{_verbatim(node)}}}"
        elif node[0] == "\\" and node[1:].isalpha():
            written += f"{node} "
        else:
            written += node
    return written
