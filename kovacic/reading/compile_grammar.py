"""Compiles `grammar.lark` into the LALR(1) table `tables.py`, which `automaton.py` runs.

lark builds the table; a run of the program does without lark, whose import and construction take longer than all
the rest of an answer.  After a change of the grammar: `python -m kovacic.reading.compile_grammar` (tested).
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
"""The LALR(1) table of `grammar.lark`, written by `python -m kovacic.reading.compile_grammar`: don't edit.

`RULES[r]` is (nonterminal, number of symbols, method of the builder or "", where its values are on the stack).
`SHIFTS[state][terminal]` and `GOTOS[state][nonterminal]` are the next state; on a terminal that a state doesn't shift,
it reduces by rule `REDUCTIONS[state]` (-1: a syntax error).  Whoever shifts `$END` has read the whole text.
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
    automaton = _Automaton(_parse_table(grammar))
    states = [automaton.start]
    rules: list[Any] = []
    shifts: list[dict[str, int]] = []
    gotos: list[dict[str, int]] = []
    reductions: list[int] = []
    for state in states:  # which grow meanwhile
        shifts.append({})
        gotos.append({})
        for symbol in automaton.symbols(state):
            target = automaton.after(state, symbol)
            if target not in states:
                states.append(target)
            (gotos if symbol.islower() else shifts)[-1][symbol] = states.index(target)
        rule = automaton.reductions.get(state[-1])
        if rule is not None and rule not in rules:
            rules.append(rule)
        reductions.append(-1 if rule is None else rules.index(rule))
    signatures = [(str(rule.origin.name), len(rule.expansion), rule.alias or "", _values(rule)) for rule in rules]
    return "\n".join(
        [
            HEADER,
            *_table("RULES", "tuple[tuple[str, int, str, slice], ...]", signatures),
            *_table("SHIFTS", "tuple[dict[str, int], ...]", shifts),
            *_table("GOTOS", "tuple[dict[str, int], ...]", gotos),
            f"REDUCTIONS: tuple[int, ...] = (\n{_wrapped(', '.join(map(str, reductions)))},\n)",
            "",
        ]
    )


def _parse_table(grammar: str) -> Any:
    """lark's table, whose states are sets of items."""
    conflicts, level = _Conflicts(), lark.logger.level
    lark.logger.addHandler(conflicts)
    lark.logger.setLevel(logging.DEBUG)
    try:
        table = lark.Lark(grammar, parser="lalr", lexer=_NoTokens, debug=True).parser.parser._parse_table
    finally:
        lark.logger.removeHandler(conflicts)
        lark.logger.setLevel(level)
    if conflicts.messages:
        raise ValueError("; ".join(conflicts.messages))
    return table


class _Automaton:
    """lark's automaton without the steps by rules that only hand their one symbol on (x is an atom, a power, a factor...).

    Such steps lead through a chain of states; the chain, without the members that no symbol leads on from, is a state
    here.  It goes on like its first member that can, and reduces like the last one.
    """

    def __init__(self, table: Any) -> None:
        start, end = table.start_states["start"], table.end_states["start"]
        self.start = (start,)
        self.moves: dict[Any, dict[str, Any]] = {end: {"$END": end}}
        self.reductions: dict[Any, Any] = {}
        for state, actions in table.states.items():
            moves = self.moves.setdefault(state, {})
            for symbol, (kind, target) in actions.items():
                if kind is Shift:
                    moves[symbol] = target
                elif self.reductions.setdefault(state, target) != target:
                    raise ValueError(f"two reductions in one state: {sorted(map(str, state))}")

    def symbols(self, chain: tuple[Any, ...]) -> list[str]:
        """The terminals and nonterminals that lead on from a state."""
        return sorted({symbol for state in chain for symbol in self.moves[state]})

    def after(self, chain: tuple[Any, ...], symbol: str) -> tuple[Any, ...]:
        """The next state."""
        targets = [self.moves[state][symbol] for state in chain if symbol in self.moves[state]]
        if symbol.islower() and len(set(targets)) > 1:
            raise ValueError(f"{symbol} leads on from two states of a chain")
        target = targets[0]
        rule = self.reductions.get(target)
        if rule is None or rule.alias is not None or len(rule.expansion) != 1:
            return (target,)
        rest = self.after(chain, rule.origin.name)
        return (target, *rest) if self.moves[target] else rest


def _values(rule: Any) -> slice:
    """The part of the stack that holds the values of a rule, its symbols being on top."""
    length = len(rule.expansion)
    kept = [i - length for i, symbol in enumerate(rule.expansion) if not getattr(symbol, "filter_out", False)]
    step = kept[1] - kept[0] if len(kept) > 1 else 1
    if kept != list(range(kept[0], kept[-1] + 1, step)):
        raise ValueError(f"the values of {rule} don't lie in equal distances")
    return slice(kept[0], kept[-1] + 1 or None, step)


def _table(name: str, annotation: str, rows: Sequence[object]) -> list[str]:
    lines = [_wrapped(repr(row).replace("'", '"') + ",") for row in rows]
    return [f"{name}: {annotation} = (", *lines, ")", ""]


def _wrapped(text: str) -> str:
    return textwrap.fill(text, 119, initial_indent="    ", subsequent_indent="     ")


if __name__ == "__main__":
    TABLES.write_text(compile_tables(GRAMMAR.read_text(encoding="utf-8")), encoding="utf-8")
