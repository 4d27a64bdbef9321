"""Several equations in one text, as SymPy has them: x' = y, y' = -x.

>>> reading = read_equations("x' = y, y' = -x, x(0) = 1")
>>> reading.equations
(Eq(Derivative(x(t), t), y(t)), Eq(Derivative(y(t), t), -x(t)))
>>> reading.functions, reading.conditions
((x(t), y(t)), (PlacedValue(place='x(0)', value='1'),))
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.lexer import Tokens
from kovacic.reading.naming import Vocabulary, argument_of, differentiated
from kovacic.reading.parser import evaluate
from kovacic.reading.pieces import Paste, taken_apart
from kovacic.reading.symbolic import SymbolicReader

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class SystemReading:
    """Equations in unknown functions of one variable; `conditions` are pairs of a place, x(0), and its value."""

    equations: tuple[Expr, ...]
    functions: tuple[Expr, ...]
    conditions: tuple[tuple[str, str], ...]
    guesses: tuple[str, ...]


def read_equations(
    text: str | Paste, *, var: str | None = None, names: Collection[str] = (), limits: Limits = DEFAULT_LIMITS
) -> SystemReading:
    """The equations of a text, of any order; `names` are declared parameters.  Raises `InputError`."""
    paste = text if isinstance(text, Paste) else taken_apart(text)
    limits = replace(limits, exponent=min(limits.exponent, 1000), bits=min(limits.bits, 10_000))
    unknowns = tuple(dict.fromkeys(name for tokens in paste.equations for name in differentiated(tokens)))
    if not unknowns:
        raise InputError("these equations contain no derivative", hint="for example x' = y, y' = -x")
    chosen = var or paste.variable or _variable(paste.equations, unknowns)
    guesses = dict.fromkeys(paste.notes)
    equations = []
    for tokens in paste.equations:
        named = Vocabulary(chosen, unknowns[0], frozenset({*names, *unknowns})).equation(tokens)
        guesses |= dict.fromkeys(named.guesses)
        reader = SymbolicReader.of_equations(chosen, unknowns, limits, "the equation")
        reader.has_functions = True  # those that aren't differentiated
        equations.append(evaluate(named.tokens, reader))
    x = sympy.Symbol(chosen)
    functions = tuple(sympy.Function(name)(x) for name in unknowns)
    return SystemReading(tuple(equations), functions, paste.conditions, tuple(guesses))


def _variable(equations: Collection[Tokens], unknowns: Collection[str]) -> str:
    """What an unknown function is applied to or differentiated by; else t, and x where that occurs and isn't unknown."""
    for tokens in equations:
        for name in filter(None, (argument_of(tokens, unknown) for unknown in unknowns)):
            return name
    occurring = {name for tokens in equations for name in tokens.names}
    if "x" in occurring and "x" not in unknowns and "t" not in occurring:
        return "x"
    return "t"
