"""Readings of coefficients that aren't rational in x: by another variable, letters for constants, a common denominator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy
from sympy.core.function import AppliedUndef

from kovacic.equation import Parsed
from kovacic.errors import InputError, NotRational
from kovacic.reading.exponentials import in_exponentials, in_powers
from kovacic.reading.letters import letters_for_constants, without_shifts
from kovacic.reading.naming import Source
from kovacic.reading.source import parts_of, read_source, read_with_numbers, source_of_parts
from kovacic.reading.symbolic import expression_of, functions_in

Expr = Any  # SymPy publishes no types
_Reader = Callable[[Source], Parsed | None]


def in_other_functions(source: Source, error: NotRational) -> Parsed:
    """The first reading that succeeds.  Raises `NotRational`: why it isn't in exp(k x), where that is known, or the `error`."""
    found, reason = _first_reading((_over_leading, in_exponentials, in_powers, _in_letters), source)
    if found is not None:
        return found
    if reason is None:
        raise error
    if reason.position is None:  # what isn't rational is the same
        reason.text, reason.position, reason.length = error.text, error.position, error.length
    raise reason from None


def _first_reading(readers: Sequence[_Reader], source: Source) -> tuple[Parsed | None, NotRational | None]:
    """The result of the first reader that succeeds; if none does, the first error is raised."""
    reason = None
    for reader in readers:
        try:
            if (found := reader(source)) is not None:
                return found, None
        except NotRational as error:
            reason = reason or error
    return None, reason


def _over_leading(source: Source) -> Parsed | None:
    """The equation over the coefficient of y'', where that is no rational function and cancels; None elsewhere."""
    (a, *others), notices = parts_of(source)
    if a.is_rational_function(sympy.Symbol(source.variable)):
        return None
    monic = (sympy.Integer(1), *(sympy.cancel(part / a) for part in others))
    with suppress(NotRational):
        found = read_source(source_of_parts(monic, source))
        return replace(found, notices=(*notices, *found.notices))
    return None


def _in_letters(source: Source) -> Parsed | None:
    """With letters for constants that aren't rational in symbols, then also for shifts of x in exponents and waves."""
    parts, notices = parts_of(source)
    x = sympy.Symbol(source.variable)
    for given in (parts, [*(without_shifts(part, x) for part in parts[:3]), parts[3]]):
        lettered = letters_for_constants(given, x)
        if lettered is None:
            continue
        written = source_of_parts(lettered.parts, source)
        found, _ = _first_reading((read_with_numbers, in_exponentials, in_powers), written)
        if found is not None:
            meanings = tuple((letter.name, meaning) for letter, meaning in lettered.meanings.items())
            said = [f"{name} is {meaning}" for name, meaning in meanings if name != str(meaning)]
            return replace(found, notices=(*notices, *said, *found.notices), letters=(*found.letters, *meanings))
    return None


def multiplied_out(given: Any, source: Source) -> Expr | None:
    """An equation without the unknown function in denominators, y = 0 left out; None if that doesn't make it linear.

    >>> x, y = sympy.Symbol("x"), sympy.Function("y")(sympy.Symbol("x"))
    >>> multiplied_out(y.diff(x, 2) / y - x, Source(print, "x", "y"))
    -x*y(x) + Derivative(y(x), (x, 2))
    """
    if source.tokens is not None:
        y = sympy.Function(source.unknown)(sympy.Symbol(source.variable))
        try:
            expression = expression_of(source)
        except InputError:
            return None
    else:
        expression = given.lhs - given.rhs if isinstance(given, sympy.Equality) else given
        y = next(f for f in functions_in(expression) if f.func.__name__ == source.unknown and f.args[0].is_Symbol)
    unknown = sympy.symbols("y2 y1 y0", cls=sympy.Dummy)
    derivatives = [y.diff(y.args[0], 2), y.diff(), y]
    plain = expression.xreplace(dict(zip(derivatives, unknown, strict=True)))
    if plain.has(sympy.Derivative) or any(f.func == y.func for f in plain.atoms(AppliedUndef)):
        return None
    above, below = sympy.fraction(sympy.together(plain))
    if not below.has(*unknown) or not above.is_polynomial(*unknown) or sympy.Poly(above, *unknown).total_degree() != 1:
        return None
    return sympy.expand(above).xreplace(dict(zip(unknown, derivatives, strict=True)))
