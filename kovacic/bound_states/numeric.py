"""The lowest levels of a potential as proven numbers, with a formula or without one, and the check of printed families."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product
from typing import Any

import sympy
from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.bound_states.levels import BoundState, Levels, Spectrum
from kovacic.bound_states.question import number_beside
from kovacic.bound_states.signs import Signs
from kovacic.closed_form.order import ball, point_between
from kovacic.closed_form.steps import JUMPING
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.general_solution.zero import residual_at
from kovacic.limits import MOST_TRIALS, Budget, Limits
from kovacic.numbers.exact import whole
from kovacic.sturm_liouville.ends import is_regular
from kovacic.sturm_liouville.families import decay, family, matching_equations
from kovacic.sturm_liouville.levels import Eigenvalues
from kovacic.sturm_liouville.problem import Robin, SturmProblem, Wish, stretches_of
from kovacic.sturm_liouville.solve import Eigenproblem

_IMPLICIT = "implicit: the levels are roots of this equation; a root at which a wave number vanishes may be none"
_CONSTANT = "a constant potential: solutions are waves and exponentials"
_DELTA = "a delta function: exp(-k |x - p|) is the only solution that decays on both sides"


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
    numeric = Eigenvalues((), False, found.energy)
    try:
        with Budget(limits).watched():
            problem = Eigenproblem(_sturm_problem(found), found.energy)
            for _ in problem.levels(count, wanted):
                numeric = problem.answer()
            numeric = problem.answer()
    except (InputError, LimitExceeded) as reason:
        numeric = replace(numeric, complete=False, notes=(str(reason),))
    return replace(found, numeric=numeric)


def with_matching(found: Spectrum) -> Spectrum:
    """The answer for a V that is constant or linear on each of its pieces, where nothing else is known about its levels.

    A formula for a constant V, with or without a delta function; else an equation from matching the solutions on both sides.
    """
    x, E = sympy.symbols([found.variable, found.energy])
    V = found.potential / found.kinetic
    is_known = any((found.complete, found.formulas, found.needs_boundary_condition))
    if is_known or not (V.has(*JUMPING) or (V.is_polynomial(x) and sympy.degree(V, x) <= 1)):
        return found
    real = Signs(found.assumptions, found.parameters).symbols
    plain = {symbol: sympy.Symbol(name) for name, symbol in real.items()}
    with suppress(InputError, NotImplementedError):
        problem = _sturm_problem(found)
        n = number_beside(*found.parameters, found.variable)
        one = _box_levels(problem, E, n) or _decaying(problem, E, n)
        if one is not None:
            levels = () if sympy.false in one.conditions else (one.mapped(lambda part: part.xreplace(plain)),)
            reason = _DELTA if V.has(sympy.DiracDelta) else _CONSTANT
            return replace(found, levels=levels, complete=True, reason=reason)
        equations = tuple(equation.xreplace(plain) for equation in matching_equations(problem, E))
        reason = _IMPLICIT if equations and not found.closed_forms_complete else found.reason
        return replace(found, matching=equations, reason=reason)
    return found


def _box_levels(problem: SturmProblem, E: Any, n: Any) -> Levels | None:
    """Of a constant V between two ends; None for others, and where the wave numbers have no formula."""
    piece, (first, last) = problem.pieces[0], problem.ends
    left, right = problem.conditions
    is_constant = len(problem.pieces) == 1 and not piece.Q.has(problem.x)
    if not (is_constant and isinstance(left, Robin) and isinstance(right, Robin)):
        return None
    number = sympy.Dummy("n", integer=True, positive=True)
    waves = family(problem.x, sympy.S.Zero, -piece.Q, sympy.S.One, E, (first, last), (left, right), n=number)
    if waves is None or waves.equation is not None:
        return None
    mu, wave = (part.xreplace({number: n + waves.first}) for part in (waves.value, waves.functions[0]))  # E W
    norm = (last - first) / 2 if left.is_zero or right.is_zero else None
    energy = piece.Q / piece.W + sympy.factor((mu - piece.Q) / piece.W)
    return Levels(n, energy, wave, (sympy.Gt(last, first),), n, norm)


def _decaying(problem: SturmProblem, E: Any, n: Any) -> Levels | None:
    """The one level of a constant V next to a wall or a delta function, or none; None for other problems."""
    found = decay(problem)
    if found is None:
        return None
    rate, distance = found
    energy = sympy.expand((problem.pieces[-1].Q - rate**2) / problem.pieces[-1].W)
    sides = sum(end.is_infinite for end in problem.ends)
    conditions = (sympy.Lt(n, 1), sympy.Gt(2 * rate, 0))
    return Levels(n, energy, sympy.exp(-rate * distance), conditions, n, sides / (2 * rate))


def _sturm_problem(found: Spectrum) -> SturmProblem:
    """With the conditions that were given, and y = 0 at other regular ends, which the Friedrichs condition is there.

    Its letters are symbols that carry the assumptions.
    """
    x = sympy.Symbol(found.variable)
    real = Signs(found.assumptions, found.parameters).real
    V, weight, *ends = map(real, (found.potential / found.kinetic, 1 / found.kinetic, *found.domain))
    pieces = tuple(replace(piece, W=weight) for piece in stretches_of(V, sympy.S.One, x, (ends[0], ends[1])))
    problem = SturmProblem(x, pieces)
    wishes: list[Wish] = [None, None]
    for side, end in enumerate(ends):
        # With letters there are formulas for a V without singular points alone.
        if end.is_finite and (found.parameters or is_regular(pieces[-side], problem, end)):
            wishes[side] = found.conditions[side] or Robin(sympy.S.One, sympy.S.Zero)
    return SturmProblem(x, pieces, (wishes[0], wishes[1]))


#: Values that are tried for the parameters.
_TRIED_VALUES = (Fraction(3), Fraction(1), Fraction(7, 2), Fraction(1, 2), Fraction(12), Fraction(-2), Fraction(0))


def check_first_levels(found: Spectrum) -> None:
    """Raises `VerificationFailed` if y'' = (V - E_0) y provably doesn't hold for the first level of a family."""
    x = sympy.Symbol(found.variable)
    for levels in found.levels:
        alone = replace(found, levels=(levels,), algebraic=())
        for chosen in islice(product(_TRIED_VALUES, repeat=len(found.parameters)), MOST_TRIALS):
            values = dict(zip(found.parameters, chosen, strict=True))
            states: Sequence[BoundState] = ()
            with suppress(InputError):  # a value isn't admitted, or it isn't known whether the level exists
                states = alone.states(values, count=1)
            if not states:
                continue
            (state,) = states
            at = {sympy.Symbol(name): sympy.Rational(value) for name, value in values.items()}
            difference = ((found.potential - state.energy) / found.kinetic).xreplace(at)
            coefficients = (sympy.S.One, sympy.S.Zero, -difference, sympy.S.Zero)
            error = acb(0)
            has_no_balls = suppress(InputError, NotImplementedError, ZeroDivisionError, ValueError, TypeError)
            with has_no_balls, working_precision(192):
                inside = ball(point_between(*(end.xreplace(at) for end in found.domain)))
                error, _ = residual_at(acb(inside), x, state.wave, coefficients)
            if not error.contains(0):
                V = found.potential.xreplace(at)
                raise VerificationFailed(
                    f"a spectrum failed its own check at n = 0, V = {V}: E = {state.energy}; please report it"
                )
            break
