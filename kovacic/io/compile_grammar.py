"""Compiles `grammar.lark` into the LALR(1) table `tables.py`, which `automaton.py` runs.

lark builds the table; a run of the program does without lark, whose import and construction take longer than all
the rest of an answer.  After a change of the grammar: `python -m kovacic.io.compile_grammar` (tested).
"""

from __future__ import annotations

import logging
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import lark
from lark.lexer import Lexer
from lark.parsers.lalr_analysis import Shift

HERE = Path(__file__).parent
GRAMMAR = HERE / "grammar.lark"
TABLES = HERE / "tables.py"

HEADER = '''\
"""The LALR(1) table of `grammar.lark`, written by `python -m kovacic.io.compile_grammar`: don't edit.

`RULES[r]` is (nonterminal, number of symbols, method of the builder or "", positions of the symbols with a value).
`SHIFTS[state][terminal]` and `GOTOS[state][nonterminal]` are the next state; on a terminal that a state doesn't shift,
it reduces by rule `REDUCTIONS[state]` (-1: a syntax error).
"""

# fmt: off
'''


class _NoTokens(Lexer):
    """A stand-in for the lexer, on which the table doesn't depend."""

    def __init__(self, configuration: object) -> None: ...

    def lex(self, *arguments: Any) -> Iterator[lark.Token]:
        return iter(())


class _Conflicts(logging.Handler):
    """Collects what lark reports about shift/reduce conflicts, which it would resolve in silence."""

    def __init__(self) -> None:
        super().__init__()
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        if "conflict" in record.getMessage().lower():
            self.messages.append(record.getMessage())


def compile_tables(grammar: str) -> str:
    """The text of `tables.py` for a grammar.  Raises `ValueError` if the grammar isn't LALR(1) without conflicts."""
    conflicts, level = _Conflicts(), lark.logger.level
    lark.logger.addHandler(conflicts)
    lark.logger.setLevel(logging.DEBUG)
    try:
        table: Any = lark.Lark(grammar, parser="lalr", lexer=_NoTokens, debug=True).parser.parser._parse_table
    finally:
        lark.logger.removeHandler(conflicts)
        lark.logger.setLevel(level)
    if conflicts.messages:
        raise ValueError("; ".join(conflicts.messages))

    def order(item_set: Any) -> list[str]:
        return sorted(str(item) for item in item_set)

    start, end = table.start_states["start"], table.end_states["start"]
    states = [start, *sorted((s for s in table.states if s != start), key=order)]
    number = {state: index for index, state in enumerate(states)}
    rules: list[Any] = []
    shifts: list[dict[str, int]] = []
    gotos: list[dict[str, int]] = []
    reductions: list[int] = []
    for state in states:
        shift: dict[str, int] = {}
        goto: dict[str, int] = {}
        reduced: set[int] = set()
        for symbol, (kind, target) in sorted(table.states[state].items()):
            if kind is Shift:
                (goto if symbol.islower() else shift)[symbol] = number[target]
            else:
                if target not in rules:
                    rules.append(target)
                reduced.add(rules.index(target))
        if len(reduced) > 1:
            raise ValueError(f"two reductions in one state: {order(state)}")
        shifts.append(shift)
        gotos.append(goto)
        reductions.append(reduced.pop() if reduced else -1)
    # A state that can only hand its one symbol on is skipped.
    for goto in gotos:
        for symbol, target in goto.items():
            while not shifts[target] and not gotos[target] and target != number[end]:
                rule = rules[reductions[target]]
                if rule.alias or len(rule.expansion) != 1:
                    break
                target = goto[rule.origin.name]
            goto[symbol] = target
    signatures = [
        (
            str(rule.origin.name),
            len(rule.expansion),
            rule.alias or "",
            tuple(i for i, symbol in enumerate(rule.expansion) if not getattr(symbol, "filter_out", False)),
        )
        for rule in rules
    ]
    return "\n".join(
        [
            HEADER,
            f"ACCEPTING = {number[end]}",
            "",
            *_table("RULES", "tuple[tuple[str, int, str, tuple[int, ...]], ...]", signatures),
            *_table("SHIFTS", "tuple[dict[str, int], ...]", shifts),
            *_table("GOTOS", "tuple[dict[str, int], ...]", gotos),
            f"REDUCTIONS: tuple[int, ...] = (\n{_wrapped(', '.join(map(str, reductions)))},\n)",
            "",
        ]
    )


def _table(name: str, annotation: str, rows: Sequence[object]) -> list[str]:
    lines = [_wrapped(repr(row).replace("'", '"') + ",") for row in rows]
    return [f"{name}: {annotation} = (", *lines, ")", ""]


def _wrapped(text: str) -> str:
    return textwrap.fill(text, 119, initial_indent="    ", subsequent_indent="     ")


if __name__ == "__main__":
    TABLES.write_text(compile_tables(GRAMMAR.read_text(encoding="utf-8")), encoding="utf-8")
