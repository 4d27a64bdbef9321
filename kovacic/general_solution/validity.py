"""Domain of validity: where a solution is real, and which parameter values are excluded."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.general_solution.basis import vanishing, without_implied
from kovacic.general_solution.needs import needs_of
from kovacic.general_solution.zero import is_nowhere_zero

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class Validity:
    """`real`: relations that make every part of the formula real and finite; `exceptions`: what must not be zero.

    `real` is `false` alone where what is assumed of symbols makes a part complex, as sqrt(k) for a negative k.  An exception
    depends on parameters alone: for values where it is zero a part has a zero denominator, or the two solutions of a general
    solution become dependent, so that other formulas hold.  Where a number in the formula isn't known to be real
    (`of_real_numbers`), the relations make it valid, and whether it is real isn't said.
    """

    real: tuple[Expr, ...]
    exceptions: tuple[Expr, ...]
    of_real_numbers: bool = True

    @property
    def claim(self) -> str:
        """What the formula is where the relations hold: "real and valid"; "valid" where a number in it isn't real."""
        if self.of_real_numbers or sympy.false in self.real:
            return "real and valid"
        return "valid"

    def __bool__(self) -> bool:
        """Is anything needed?"""
        return bool(self.real or self.exceptions)

    def __str__(self) -> str:
        """`x > 0, c**2 - 4*k*m != 0`."""
        if sympy.false in self.real:
            return "no value"
        nonzero = [f"{e} != 0" for e in self.exceptions]
        return ", ".join([*(f"{r.lhs} != 0" if isinstance(r, sympy.Ne) else str(r) for r in self.real), *nonzero])


def needed_for(value: Expr, x: Expr, exceptions: Iterable[Expr] = ()) -> Validity:
    """What a formula needs, part by part; `exceptions` are those of the pair of solutions in it."""
    relations = dict.fromkeys(needs_of(value))
    of_letters = [r for r in relations if isinstance(r, sympy.Ne) and not r.has(x)]
    on_x = [r for r in relations if r not in of_letters and not _holds_for_real_symbols(r)]
    nonzero = [factor for relation in of_letters for factor in vanishing(relation.lhs)]
    nonzero += [e for e in exceptions if not is_nowhere_zero(e)]
    # The bounds of an integral may be infinite.
    numbers = (node for node in sympy.preorder_traversal(value) if node.is_number)
    is_of_real_numbers = all(number.is_extended_real for number in numbers)
    return Validity(_without_weaker(on_x), without_implied(nonzero), is_of_real_numbers)


def _holds_for_real_symbols(relation: Expr) -> bool:
    """As exp(x) + 1 != 0 and x^2 + 1 > 0 do; nothing has to be said then."""
    real = {symbol: sympy.Dummy(real=True) for symbol in relation.free_symbols if symbol.is_real is None}
    try:
        return bool(relation.xreplace(real) == sympy.true)
    except TypeError:  # what is complex has no sign
        return False


def _without_weaker(relations: list[Expr]) -> tuple[Expr, ...]:
    """Without e >= 0 and e != 0 beside e > 0; `false` alone where it is one of them."""
    if sympy.false in relations:
        return (sympy.false,)
    positive = {relation.lhs for relation in relations if _is_strict(relation)}
    nonzero = positive | {-u for u in positive}
    return tuple(relation for relation in relations if _is_strict(relation) or relation.lhs not in nonzero)


def _is_strict(relation: Expr) -> bool:
    """Is it e > 0?"""
    return isinstance(relation, sympy.StrictGreaterThan)
