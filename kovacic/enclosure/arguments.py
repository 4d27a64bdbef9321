"""The arguments of an evaluation: methods, numbers and sequences of them, as keys of what is kept."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from typing import Any

from kovacic.enclosure.points import as_point
from kovacic.enclosure.precision import METHODS
from kovacic.errors import InputError


def check_method(method: object) -> None:
    """Raise InputError for an unknown one."""
    if method is not None and method not in METHODS:
        raise InputError(f"unknown method {method!r}", hint=f"one of {', '.join(map(repr, METHODS))}, or None")


def comparable(value: object) -> object:
    """A number of NumPy's as a point: SymPy can't compare all of them with its own, when journeys are looked up."""
    return as_point(value, "a number of the start") if type(value).__module__ == "numpy" else value


def comparables(values: object, name: str) -> Any:
    """A sequence of numbers as a tuple of such; a word, or None, as it is."""
    if values is None or isinstance(values, str):
        return values
    if isinstance(values, bytes | Mapping | Set) or not isinstance(values, Iterable):
        raise InputError(f"{name} is a sequence of numbers, not {type(values).__name__!r}")
    return tuple(map(comparable, values))


def looked_up(cached: Any, *given: Any) -> Any:
    """A function that keeps its values; of lists and FLINT's balls, which can't be looked up, computed anew."""
    try:
        hash(given)
    except (TypeError, ValueError):
        return cached.__wrapped__(*given)
    return cached(*given)
