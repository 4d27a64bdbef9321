"""The lowest levels of a potential as proven numbers, where there is a formula and where there is none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy

from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.question import FRIEDRICHS, read_boundary, read_end
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import Budget, Limits
from kovacic.numbers.exact import exact_text, whole
from kovacic.parametric.assumptions import read_assumptions
from kovacic.reading.substitution import values_among
from kovacic.reading.symbolic import read_expression
from kovacic.sturm_liouville.ends import is_regular
from kovacic.sturm_liouville.families import matching_equations
from kovacic.sturm_liouville.levels import Eigenvalues
from kovacic.sturm_liouville.problem import STEPS, Robin, SturmProblem, Wish, pieces_of
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


def with_matching(found: Spectrum) -> Spectrum:
    """The answer with equations for the levels where V is linear or constant on each of its pieces, and no level is known."""
    x, E = sympy.symbols([found.variable, found.energy])
    V = found.potential / found.kinetic
    is_known = found.complete or found.levels or found.algebraic or found.needs_boundary_condition
    is_linear = V.is_polynomial(x) and sympy.degree(V, x) == 1
    if is_known or not (is_linear or V.has(*STEPS)):
        return found
    assumed = {sympy.Symbol(name): symbol for name, symbol in found.assumptions.symbols().items()}
    plain = {symbol: name for name, symbol in assumed.items()}
    V, weight, *domain = (part.xreplace(assumed) for part in (V, 1 / found.kinetic, *found.domain))
    wishes: list[Wish] = [None, None]
    for side, end in enumerate(domain):
        if end.is_finite:  # a regular end
            wishes[side] = found.conditions[side] or Robin(sympy.S.One, sympy.S.Zero)
    with suppress(InputError, NotImplementedError):
        pieces = tuple(replace(p, W=weight) for p in pieces_of(V, sympy.S.One, x, (domain[0], domain[1])))
        equations = matching_equations(SturmProblem(x, pieces, (wishes[0], wishes[1])), E)
        return replace(found, matching=tuple(equation.xreplace(plain) for equation in equations))
    return found


def unsolved(
    V: Any,
    reason: NotRational,
    *,
    domain: Sequence[Any],
    energy: str,
    var: Any,
    assume: Mapping[Any, Any] | None,
    boundary: str | None,
) -> Spectrum:
    """The problem alone, for a potential that no formulas are known for."""
    potential = read_expression(V, what="the potential") if isinstance(V, str) else sympy.sympify(V)
    variable = str(var or "x")
    values, rest = values_among(assume or {})
    potential = potential.xreplace(
        {sympy.Symbol(n): read_expression(exact_text(v, "a value")) for n, v in values.items()}
    )
    ends = tuple(map(read_end, domain))
    parameters = tuple(sorted({s.name for part in (potential, *ends) for s in part.free_symbols} - {variable}))
    known = read_assumptions(rest or None, V, parameters)
    given = read_boundary(boundary, ends, variable)
    is_open = any(end.is_finite and wish is None for end, wish in zip(ends, given.wishes, strict=True))
    condition = given.text or (FRIEDRICHS if is_open else boundary)
    found = Spectrum(potential, variable, (ends[0], ends[1]), energy, parameters, known, condition)
    return replace(found, conditions=given.wishes, reason=f"undecided: {reason.args[0]}")


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
