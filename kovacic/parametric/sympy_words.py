"""What SymPy knows of a symbol, as words about a parameter; and these as SymPy's assumptions."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from kovacic.parametric.facts import INEQUALITIES, WORDS, read_facts

#: What SymPy calls numbers that aren't 0, and others, on a side of it.
_SIGNS = {1: ("positive", "nonnegative"), -1: ("negative", "nonpositive")}
#: The words that are names of SymPy's, too, without those for a sign, which bounds say.
_NAMED = {*WORDS} - {*INEQUALITIES, "half-integer"}


def words_of(symbol: Any) -> list[str]:
    """What SymPy knows of a symbol, without what follows from the rest."""
    words = _arithmetic_of(symbol)
    signs = [word for word in INEQUALITIES if getattr(symbol, f"is_{word}")]
    words += signs[:1]
    if symbol.is_zero is False and read_facts(tuple(words)).admit(Fraction(0)):
        words.append("nonzero")
    return words


def _arithmetic_of(symbol: Any) -> list[str]:
    """Of which kind the number is: the first of these that it is; or rational or not, and no integer."""
    for kind in ("odd", "even", "integer", "irrational"):
        if getattr(symbol, f"is_{kind}"):
            return [kind]
    words = []
    if symbol.is_rational:
        words.append("rational")
    if symbol.is_integer is False:
        words.append("noninteger")
    return words


def sympy_properties(said: tuple[str, ...]) -> list[str]:
    """What SymPy has names for; of bounds, what they say of the sign."""
    words = [word for word in said if word in _NAMED]
    if "half-integer" in said:
        words += ["rational", "noninteger"]
    for bound in read_facts(said).bounds:
        is_beyond_zero = bound.sign * bound.end >= 0
        if is_beyond_zero:
            strict, weak = _SIGNS[bound.sign]
            words.append(strict if bound.strict or bound.end != 0 else weak)
    return words
