"""The lowest levels of a potential as proven numbers, with a formula or without one, and the check of printed families."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product
from typing import Any

import sympy
from flint import acb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ
from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.question import FRIEDRICHS, read_boundary, read_end
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError, LimitExceeded, NotRational, VerificationFailed
from kovacic.limits import Budget, Limits
from kovacic.numbers.exact import exact_text, whole
from kovacic.parametric.assumptions import Assumptions, read_assumptions
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
    potential = read_expression(V, what="the potential") if isinstance(V, str) else sympy.sympify(V, strict=True)
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


#: Values that are tried for the parameters, and choices of them.
_VALUES = (Fraction(3), Fraction(1), Fraction(7, 2), Fraction(1, 2), Fraction(12), Fraction(-2), Fraction(0))
_CHOICES = 400
#: Bits with which a wave function is compared.
_PRECISION = 192


def check_first_levels(found: Spectrum, known: Assumptions) -> None:
    """Raises `VerificationFailed` if y'' = (V - E_0) y provably doesn't hold for the first level of a family."""
    x = sympy.Symbol(found.variable)
    for levels in found.levels:
        for values in _admissible(found, known):
            at = {sympy.Symbol(name): sympy.Rational(value) for name, value in values.items()}
            try:
                states = replace(found, levels=(levels,), algebraic=()).states(values, count=1)
            except InputError:  # not known whether the level exists
                continue
            if not states:
                continue
            (state,) = states
            if _is_false(state.wave, found.potential.xreplace(at) / found.kinetic - state.energy, x, found.domain, at):
                said = "".join(f", {name} = {value}" for name, value in values.items())
                raise VerificationFailed(
                    f"a spectrum failed its own check at n = 0{said}: E = {state.energy}; please report it"
                )
            break


def _admissible(found: Spectrum, known: Assumptions) -> Iterator[dict[str, Fraction]]:
    """Values of the parameters that the assumptions admit."""
    for values in islice(product(_VALUES, repeat=len(found.parameters)), _CHOICES):
        chosen = dict(zip(found.parameters, values, strict=True))
        if known.admits((name, QQ.poly([value])) for name, value in chosen.items()):
            yield chosen


def _is_false(y: Any, difference: Any, x: Any, domain: tuple[Any, Any], at: dict[Any, Any]) -> bool:
    """True if y'' = (V - E) y provably fails at a point of the domain."""
    low, high = (sympy.sympify(end, strict=True).xreplace(at) for end in domain)
    if low.is_infinite:
        place = sympy.Rational(13, 17) if high.is_infinite else high - sympy.Rational(13, 17)
    else:
        place = low + (sympy.Rational(13, 17) if high.is_infinite else (high - low) * sympy.Rational(13, 34))
    if not place.is_number or y.has(sympy.nan, sympy.zoo) or y.free_symbols - {x}:
        return False
    point = Fraction(str(sympy.N(place, 12)))
    try:
        with working_precision(_PRECISION):
            ball = acb(fmpq(point.numerator, point.denominator))
            value, _, second = jet(y, x, ball)
            return not (second - jet(difference, x, ball)[0] * value).contains(0)
    except (NotImplementedError, ZeroDivisionError, ValueError, TypeError):  # functions without balls
        return False
