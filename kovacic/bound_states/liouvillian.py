"""Which levels have a closed form, where no formula is known for all levels.

A wave function with a closed form is a Liouvillian solution of y'' = (V - E) y at a value of E.  So the conditions on E and the
parameters under which there is one, where they are proven to be complete, say what can't be missing in a list of levels:

- no value admits one: no level has a closed form;
- there are no parameters, and E is a zero of one of finitely many polynomials: where each one with a real zero was found to
  give levels, or to give none, these are all levels with a closed form.  It gives none where a solution exp(int theta) P is the
  only square integrable one at an end (limit point), and isn't square integrable at the other;
- each value is of case 1: then omega is rational, and each level with a closed form has a polynomial of some degree d.

The conditions are asked for where all poles of V, in the variable of the equation, are in the field of the parameters, but for
one pair of conjugate ones: with more they may take minutes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import sympy

from kovacic.bound_states.levels import Spectrum
from kovacic.equation import Parsed
from kovacic.errors import LimitExceeded
from kovacic.limits import Limits
from kovacic.numerals import as_text
from kovacic.parametric.api import conditions_of
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.statements import Either, Statement, Vanishes
from kovacic.writing.formula import caret


def with_closed_forms(
    found: Spectrum,
    parsed: Parsed,
    known: Assumptions,
    limits: Limits,
    is_excluded: Callable[[Any], bool],
) -> Spectrum:
    """The same spectrum, with what is proven of the levels that have a closed form, where the others aren't known.

    `is_excluded` tells of a zero of an irreducible polynomial in E whether it is proven to be no level.
    """
    if found.complete or found.needs_boundary_condition or not _has_simple_poles(parsed):
        return found
    conditions = _conditions(parsed, known, limits)
    if conditions is None:
        return found
    possible = _possible(found, conditions)
    if possible is not None:
        others = possible - _polynomials((one.polynomial for one in found.algebraic), found.energy)
        if all(map(is_excluded, others)):
            reason = _reason(found, conditions, others)
            return replace(found, closed_forms_complete=True, reason=reason, hint="", shell="")
    is_rational = all(region.case == 1 for region in conditions.regions)
    if found.algebraic and is_rational:
        shown = found.reason.partition(";")[0]
        reason = f"{shown}; each level with a closed form has a polynomial of some degree d: {conditions.theory}"
        return replace(found, reason=reason)
    return found


def _has_simple_poles(parsed: Parsed) -> bool:
    """True if the poles are in the field of the parameters, but for one pair, and there is the time to find them."""
    try:
        factors = parsed.S.field.factor(parsed.S.den)
    except LimitExceeded:
        return False
    degrees = sorted(factor.degree for factor, _ in factors)
    return not degrees or (degrees[-1] <= 2 and degrees.count(2) <= 1)


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
    return {polynomial for polynomial in polynomials if sympy.Poly(polynomial, E).count_roots()}


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


def _reason(found: Spectrum, conditions: ParametricAnswer, excluded: set[Any]) -> str:
    """Why no level with a closed form is missing."""
    E = sympy.Symbol(found.energy)
    others = ""
    if excluded:
        zeros = " or ".join(f"{caret(as_text(polynomial))} = 0" for polynomial in sorted(excluded, key=str))
        others = f"at {zeros} the solution that is square integrable at one end isn't at the other; "
    if found.algebraic:
        return f"a level with k zeros is number k (Sturm); {others}{conditions.theory}"
    if excluded:
        return f"{others}the equation has no Liouvillian solution for any other real {E}: {conditions.theory}"
    energies = f"any real {E}" if conditions.regions else f"any {E}"
    return f"the equation has no Liouvillian solution for {energies}: {conditions.theory}"
