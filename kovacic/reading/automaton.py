"""Runs the LALR(1) table of the grammar over a text and calls a builder's methods with values: no tree, no recursion.

The table is lark's (`compile_grammar`); this is the automaton of the textbooks, with syntax errors in plain words.
Every method of a builder has the signature `method(values, site)`, the values being those of the nonterminals of the
rule and the texts of its value-bearing terminals; `site()` is the place in the text.  It returns the value of the
nonterminal that the rule defines.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple, Protocol

from kovacic.errors import LimitExceeded, ParseError
from kovacic.reading.lexer import Tokens
from kovacic.reading.tables import GOTOS, REDUCTIONS, RULES, SHIFTS


class Site(NamedTuple):
    """Where a rule was recognised: its symbol k begins with token `begins[k]`, and it ends before token `end`."""

    tokens: Tokens
    begins: list[int]
    end: int

    def piece(self, symbol: int) -> str:
        """The text of one symbol of the rule."""
        last = symbol + 1 == len(self.begins)
        return self.tokens.piece(self.begins[symbol], self.end if last else self.begins[symbol + 1])

    def piece_of_all(self) -> str:
        """The text of the whole rule."""
        return self.tokens.piece(self.begins[0], self.end)

    def span(self, symbol: int | None = None) -> tuple[int, int]:
        """Position and length of one symbol's text, or of the whole rule's."""
        first = self.begins[symbol or 0]
        end = self.end if symbol is None or symbol + 1 == len(self.begins) else self.begins[symbol + 1]
        start = self.tokens.starts[first]
        return start, self.tokens.ends[end - 1] - start


class Builder(Protocol):
    """What `run` needs besides the methods that the grammar names."""

    def located(self, error: LimitExceeded | ZeroDivisionError, site: Site) -> Exception:
        """The error that tells the user where in the text the arithmetic failed."""


Action = Callable[[Any, list[Any], Callable[[], Site]], Any]


class _Reduction(NamedTuple):
    """What to do with the symbols on top of the stack."""

    symbol: str
    length: int
    action: Action
    values: slice


@cache
def _reductions(builder: type[Builder]) -> list[_Reduction | None]:
    """The reduction of every state for one class of builders; None is a syntax error."""
    rules = [
        _Reduction(symbol, length, getattr(builder, method) if method else _hand_on, values)
        for symbol, length, method, values in RULES
    ]
    return [None if rule < 0 else rules[rule] for rule in REDUCTIONS]


def _hand_on(builder: Builder, values: list[Any], where: Callable[[], Site]) -> Any:
    return values[0]


def run(tokens: Tokens, builder: Builder) -> Any:
    """The value of the whole text.  Raises `ParseError` where it leaves the grammar, and what the builder raises."""
    reductions = _reductions(type(builder))
    states: list[int] = [0]
    values: list[Any] = []
    begins: list[int] = []
    state = k = length = 0

    def site() -> Site:
        return Site(tokens, begins[-length:], k)

    for k, kind in enumerate(tokens.kinds):
        while (target := SHIFTS[state].get(kind)) is None:
            reduction = reductions[state]
            if reduction is None:
                raise _syntax_error(tokens, k)
            symbol, length, action, kept = reduction
            try:
                value = action(builder, values[kept], site)
            except (LimitExceeded, ZeroDivisionError) as error:
                raise builder.located(error, site()) from None
            if length > 1:
                del values[1 - length :], begins[1 - length :], states[1 - length :]
            values[-1] = value
            states[-1] = state = GOTOS[states[-2]][symbol]
        values.append(tokens.pieces[k])
        begins.append(k)
        states.append(target)
        state = target
    return values[0]


_OPERATORS = ("PLUS", "MINUS", "STAR", "SLASH", "CIRCUMFLEX")


def _syntax_error(tokens: Tokens, k: int) -> ParseError:
    """What is wrong with token k, at which the text leaves the grammar."""
    kinds, text = tokens.kinds, tokens.text
    kind, before = kinds[k], kinds[k - 1] if k else ""
    here = text[tokens.starts[k] : tokens.ends[k]]
    position, length, hint = tokens.starts[k], max(1, len(here)), None
    opened: list[int] = []
    for i in range(k):
        if kinds[i] == "LPAR":
            opened.append(i)
        elif kinds[i] == "RPAR" and opened:
            opened.pop()
    if kind == "$END":
        if before in _OPERATORS or before in ("EQUAL", "COMMA"):
            message = f"the expression ends after {tokens.piece(k - 1, k)!r}"
            position, length = tokens.starts[k - 1], tokens.ends[k - 1] - tokens.starts[k - 1]
            hint = "something is missing after it"
        elif opened:
            message, position, length = "this parenthesis is never closed", tokens.starts[opened[-1]], 1
            hint = f"add {')' * min(len(opened), 20)!r} where it ends" if len(opened) < 20 else "count the parentheses"
        else:
            message = "the expression isn't complete"
    elif kind == "RPAR" and before == "LPAR":
        message, hint = "there is nothing between these parentheses", "leave them out, or write what belongs there"
        position, length = tokens.starts[k - 1], tokens.ends[k] - tokens.starts[k - 1]
    elif kind == "RPAR" and not opened:
        message, hint = "this parenthesis closes nothing", "remove it, or open it before"
    elif before in _OPERATORS and kind in (*_OPERATORS, "RPAR", "EQUAL", "COMMA"):
        message = f"something is missing between {tokens.piece(k - 1, k)!r} and {here!r}"
        position, length = tokens.starts[k - 1], tokens.ends[k] - tokens.starts[k - 1]
    elif kind in _OPERATORS or kind == "SUPERSCRIPT":
        message, hint = (
            f"there is nothing before {here!r} for it to act on",
            "write the number or name that belongs there",
        )
    elif kind == "COMMA":
        message, hint = "a comma doesn't belong here", "decimals are written with a point, and one expression is one S"
    elif kind == "EQUAL":
        message, hint = f"{here!r} doesn't belong here", "an equation has one equals sign, outside all parentheses"
    else:
        message = f"{here!r} doesn't belong here"
    return ParseError(message, text=text, position=position, length=length, hint=hint)
