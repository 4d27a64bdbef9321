"""The even and the odd solutions of a symmetric potential as one sequence, where one formula has both energies."""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.bound_states.answer import Levels


def merged(levels: list[Levels]) -> list[Levels]:
    """The levels, with each two that are the even and the odd ones of a sequence in one."""
    for even in levels:
        for odd in levels:
            together = _sequence(even, odd)
            if together is not None:
                others = [one for one in levels if one not in (even, odd)]
                return [together, *merged(others)]
    return levels


def _sequence(even: Levels, odd: Levels) -> Levels | None:
    """The levels number 0, 1, 2, ... from those number 0, 2, 4, ... and those number 1, 3, 5, ...

    None where these aren't their numbers, or where they have other energies or conditions.
    """
    n = even.number
    if even.zeros != 2 * n or odd.zeros != 2 * n + 1:
        return None
    energy = even.energy.subs(n, n / 2)
    if sympy.simplify(energy.subs(n, 2 * n + 1) - odd.energy) != 0:
        return None
    conditions = [_solved_for_number(c.subs(n, n / 2), n) for c in even.conditions]
    of_odd = [_solved_for_number(c.subs(n, (n - 1) / 2), n) for c in odd.conditions]
    if [*map(str, conditions)] != [*map(str, of_odd)]:
        return None
    norm = None
    if even.norm is not None and odd.norm is not None:
        norm = _by_parity(even.norm, odd.norm, n)
    wave = _by_parity(even.wave, odd.wave, n)
    return Levels(n, sympy.factor(energy), wave, tuple(conditions), n, norm)


def _by_parity(even: Any, odd: Any, n: Any) -> Any:
    """The one at n/2 for even n, the other one at (n - 1)/2 for odd n."""
    is_even = sympy.Eq(sympy.Mod(n, 2), 0)
    return sympy.Piecewise((even.subs(n, n / 2), is_even), (odd.subs(n, (n - 1) / 2), True))


def _solved_for_number(condition: Any, n: Any) -> Any:
    """n/2 < c as n < 2 c; a condition that isn't linear in n, with a number before it, as it is."""
    difference = condition.gts - condition.lts
    slope = sympy.expand(difference).coeff(n, 1)
    if not slope.is_number or slope == 0:
        return condition
    bound = sympy.expand(-difference.subs(n, 0) / slope)
    is_strict = isinstance(condition, sympy.StrictGreaterThan | sympy.StrictLessThan)
    if slope > 0:
        relation = sympy.StrictGreaterThan if is_strict else sympy.GreaterThan
    else:
        relation = sympy.StrictLessThan if is_strict else sympy.LessThan
    return relation(n, bound)
