"""The name of the variable, where the user says it: `var`."""

from __future__ import annotations

from collections.abc import Mapping

from kovacic.answer import Answer
from kovacic.errors import InputError, NotRational, warn_user
from kovacic.limits import Limits, limits_of
from kovacic.reading.names import words_among
from kovacic.reading.source import source_of


def with_variable(
    equation: object, var: object, limits: Limits | None = None, params: Mapping[str, object] | None = None
) -> object:
    """The equation, read with this name of its variable; as it was given where none is named.  Warns of what is guessed."""
    declared = words_among(params or ())
    if isinstance(equation, str):
        for guess in source_of(equation, None if var is None else str(var), limits_of(limits), names=declared).guesses:
            warn_user(guess)
    if var is None and not (declared and isinstance(equation, str)):
        return equation
    if isinstance(equation, Answer):
        if str(var) != equation.variable:
            raise InputError(f"the variable of this answer is {equation.variable}, not {var}")
        return equation
    from kovacic.reading.read import read_input

    limits = limits_of(limits)
    try:
        return read_input(equation, var=var, limits=limits, exponentials=True, names=declared)
    except NotRational:
        from kovacic.enclosure.functions import as_written  # imports SymPy

        return as_written(equation, var, limits, declared)
