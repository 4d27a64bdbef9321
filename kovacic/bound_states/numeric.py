"""The lowest levels of a potential as proven numbers, where there is a formula and where there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy

from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.question import read_boundary, read_end
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import Budget, Limits
from kovacic.numbers.exact import whole
from kovacic.reading.symbolic import read_expression
from kovacic.sturm_liouville.ends import is_regular
from kovacic.sturm_liouville.levels import Eigenvalues
from kovacic.sturm_liouville.problem import Robin, SturmProblem, Wish, pieces_of
from kovacic.sturm_liouville.solve import Eigenproblem


def with_numbers(found: Spectrum, levels: int | None, digits: int, limits: Limits) -> Spectrum:
    """The answer with at most `levels` numeric levels, and the reason among their notes where there are fewer.

    Raises `InputError` where the potential has parameters.
    """
    if levels is None:
        return found
    count, wanted = whole(levels, "levels", least=1), whole(digits, "digits", least=1)
    if found.parameters:
        names = ", ".join(found.parameters)
        hint = f"assume={dict.fromkeys(found.parameters, 2)}, for instance"
        shell = " ".join(f"--assume {name}=2" for name in found.parameters) + ", for instance"
        raise InputError(f"numeric levels need values of {names}", hint=hint, shell=shell)
    if found.needs_boundary_condition:
        return replace(found, numeric=Eigenvalues((), False, found.energy, ("a boundary condition is needed",)))
    problem = None
    try:
        with Budget(limits).watched():
            problem = _problem(found)
            for _ in problem.levels(count, wanted):
                pass
            return replace(found, numeric=problem.answer())
    except (InputError, LimitExceeded) as reason:
        if problem is None:
            return replace(found, numeric=Eigenvalues((), False, found.energy, (str(reason),)))
        return replace(found, numeric=problem.answer(reason=str(reason)))


def unsolved(
    V: Any, domain: Sequence[Any], energy: str, var: Any, boundary: str | None, reason: NotRational
) -> Spectrum:
    """The problem alone, for a potential that no formulas are known for."""
    potential = read_expression(V, what="the potential") if isinstance(V, str) else sympy.sympify(V)
    variable = str(var or "x")
    parameters = tuple(sorted(s.name for s in potential.free_symbols if s.name != variable))
    ends = tuple(map(read_end, domain))
    said = f"undecided: {reason.args[0]}"
    given = read_boundary(boundary, ends, variable)
    found = Spectrum(potential, variable, (ends[0], ends[1]), energy, parameters, reason=said)
    return replace(found, boundary=given.text or boundary, conditions=given.wishes)


def _problem(found: Spectrum) -> Eigenproblem:
    """With the conditions that were given, and y = 0 at other regular ends, which the Friedrichs condition is there."""
    x = sympy.Symbol(found.variable)
    if found.potential.has(sympy.I):
        raise InputError("the potential isn't real")
    pieces = pieces_of(found.potential / found.kinetic, 1 / found.kinetic, x, found.domain)
    problem = SturmProblem(x, pieces)
    wishes: list[Wish] = [None, None]
    for side, end in enumerate(found.domain):
        if is_regular(pieces[-side], problem, end):
            wishes[side] = found.conditions[side] or Robin(sympy.S.One, sympy.S.Zero)
    return Eigenproblem(SturmProblem(x, pieces, (wishes[0], wishes[1])), found.energy)
