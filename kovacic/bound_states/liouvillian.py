"""Which levels have a closed form, where no formula is known for all levels.

A wave function with a closed form is a Liouvillian solution of y'' = (V - E) y at a value of E.  So the conditions on E and the
parameters under which there is one, where they are proven to be complete, say what can't be missing in a list of levels:

- no value admits one: no level has a closed form;
- there are no parameters, and E is a zero of one of finitely many polynomials: where each one with a real zero was found to
  give levels, these are all levels with a closed form;
- each value is of case 1: then omega is rational, and each level with a closed form has a polynomial of some degree d.

The conditions are asked for where all poles of V, in the variable of the equation, are in the field of the parameters: at
others they may take minutes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import sympy

from kovacic.bound_states.levels import Spectrum
from kovacic.equation import Parsed
from kovacic.errors import LimitExceeded
from kovacic.limits import Limits
from kovacic.parametric.api import conditions_of
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.statements import Either, Statement, Vanishes


def with_closed_forms(found: Spectrum, parsed: Parsed, known: Assumptions, limits: Limits) -> Spectrum:
    """The same spectrum, with what is proven of the levels that have a closed form, where the others aren't known."""
    if found.complete or found.needs_boundary_condition or not _has_rational_poles(parsed):
        return found
    conditions = _conditions(parsed, known, limits)
    if conditions is None:
        return found
    possible = _possible(found, conditions)
    if possible is not None and possible <= _listed(found):
        return replace(found, closed_forms_complete=True, reason=_reason(found, conditions), hint="", shell="")
    is_rational = all(region.case == 1 for region in conditions.regions)
    if found.algebraic and is_rational:
        shown = found.reason.partition(";")[0]
        reason = f"{shown}; each level with a closed form has a polynomial of some degree d: {conditions.theory}"
        return replace(found, reason=reason)
    return found


def _has_rational_poles(parsed: Parsed) -> bool:
    """Not where there isn't the time to find them, either."""
    try:
        factors = parsed.S.field.factor(parsed.S.den)
    except LimitExceeded:
        return False
    return all(factor.degree == 1 for factor, _ in factors)


def _conditions(parsed: Parsed, known: Assumptions, limits: Limits) -> ParametricAnswer | None:
    """For which E and parameters is there a Liouvillian solution?  None where that isn't proven, or holds in general."""
    try:
        conditions = conditions_of(parsed, known, 0, limits)
    except LimitExceeded:
        return None
    is_proven = conditions.complete is True and conditions.generic.known
    if not is_proven or conditions.generic.case is not None:
        return None
    return conditions


def _listed(found: Spectrum) -> set[Any]:
    """The irreducible polynomials whose zeros are the levels that were found."""
    return _polynomials((one.polynomial for one in found.algebraic), found.energy)


def _possible(found: Spectrum, conditions: ParametricAnswer) -> set[Any] | None:
    """The irreducible polynomials of which the energies with a closed form are real zeros; None where they aren't known."""
    if not conditions.regions:
        return set()
    if found.parameters:
        return None
    functions = _zeros_of_all(region.statement for region in conditions.regions)
    if functions is None:
        return None
    E = sympy.Symbol(found.energy)
    if any(function.free_symbols != {E} for function in functions):
        return None
    polynomials = _polynomials(functions, found.energy)
    return {polynomial for polynomial in polynomials if _has_real_zero(polynomial, E)}


def _has_real_zero(polynomial: Any, E: Any) -> bool:
    return bool(sympy.Poly(polynomial, E).count_roots())


def _zeros_of(statement: Statement) -> list[Any] | None:
    """The functions of which one vanishes, if the statement says just that."""
    if isinstance(statement, Vanishes):
        return [statement.function.to_sympy(sympy.Dummy("x"))]
    if isinstance(statement, Either):
        return _zeros_of_all(statement.parts)
    return None


def _zeros_of_all(statements: Iterable[Statement]) -> list[Any] | None:
    """The functions of which one vanishes where one of the statements holds."""
    functions: list[Any] = []
    for statement in statements:
        zeros = _zeros_of(statement)
        if zeros is None:
            return None
        functions += zeros
    return functions


def _polynomials(functions: Iterable[Any], energy: str) -> set[Any]:
    """The irreducible factors over Q that depend on the energy, each monic."""
    E = sympy.Symbol(energy)
    factors: set[Any] = set()
    for function in functions:
        for factor, _ in sympy.factor_list(function)[1]:
            if factor.free_symbols == {E}:
                factors.add(sympy.Poly(factor, E).monic().as_expr())
    return factors


def _reason(found: Spectrum, conditions: ParametricAnswer) -> str:
    """Why no level with a closed form is missing."""
    if found.algebraic:
        return f"a level with k zeros is number k (Sturm); {conditions.theory}"
    energies = "any real E" if conditions.regions else "any E"
    return f"the equation has no Liouvillian solution for {energies}: {conditions.theory}"
