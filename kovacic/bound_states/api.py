"""`kovacic.spectrum`: for which energies is there a square integrable solution?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import sympy

from kovacic.bound_states.asked import asked, exact_problem, unsolved
from kovacic.bound_states.closed_forms import closed_forms
from kovacic.bound_states.darboux import transformed
from kovacic.bound_states.ends import Examined, examined
from kovacic.bound_states.families import standard_levels
from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.numeric import check_first_levels, with_matching, with_numbers
from kovacic.bound_states.question import Asked
from kovacic.bound_states.signs import Uncovered
from kovacic.bound_states.without_levels import NO_LEVELS, REASON, is_repulsive
from kovacic.enclosure.request import Accuracy, digits_and_limits
from kovacic.equation import ENERGY
from kovacic.errors import LimitExceeded, NotRational
from kovacic.limits import Budget, Limits, limited
from kovacic.numbers.exact import whole
from kovacic.parametric.assumptions import check_mapping
from kovacic.parametric.natural import DEFAULT_DEGREE
from kovacic.reading.read import declared

_POLYNOMIAL = "each solution that is square integrable at both ends has a polynomial in it"


@limited
def spectrum(
    V: Any,
    *,
    domain: Sequence[Any] = ("-oo", "oo"),
    energy: str = ENERGY,
    var: Any = None,
    assume: Mapping[Any, Any] | None = None,
    boundary: str | None = None,
    max_degree: int = DEFAULT_DEGREE,
    levels: int | None = None,
    parameters: Sequence[str] = (),
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> Spectrum:
    """The energies E for which -y'' + V y = E y has a square integrable solution, with the solutions.

    Parameters
    ----------
    V : str or sympy.Expr
        The potential: rational in x, or in exp(k x), sin, cosh, ... of multiples of k x, with real parameters.  Or the whole
        equation as text, "-hbar^2/(2*m)*psi'' + m*w^2*x^2/2*psi = E*psi", whose factor of psi'' is taken as negative.
    domain : pair
        The ends a < b: numbers, expressions in the parameters, "-oo", "oo"; by default the whole line.
    energy : str
        The name of the energy, "E" by default; V is free of it.
    var : str or sympy.Symbol
        The variable, x by default; every other symbol is a real parameter.  Where V has one name that usually is a variable
        (t, z, s, r, u, theta, ...) and no x, that is taken, with a note.
    assume : mapping
        What is known of the parameters, as for `kovacic.conditions`: {"l": ">=0", "Z": "positive"}, or values.  Without it
        the conditions under which a solution is square integrable are part of the answer.
    boundary : str
        Conditions at finite ends where V is regular: "y'(0) = 0", "y(0) = 0, y(1) + 2*y'(1) = 0"; y = 0 also where V isn't,
        if only the smaller solution vanishes there, as for -Z/x.  Or "friedrichs": at an end where both solutions are square
        integrable the smaller one is meant, which is y = 0 at a regular end.  It is taken, with a note, where a condition is
        needed and none was given, and the operator is bounded below; where solutions oscillate at an end no condition is
        distinguished, and there is no spectrum without one.
    max_degree : int
        Of a quasi-exactly solvable potential, the levels with a polynomial of at most this degree are given; 2 by default.
    levels : int, optional
        The number of lowest levels to be computed as proven numbers, `numeric` of the answer: for a potential without
        parameters, which may then be any elementary function, abs(x), cosh(x) - x^2.
    parameters : sequence of str
        Names of parameters that have more than one letter, as "EI" or "mass"; other such names are refused.
    accuracy, digits, limits
        The fields of `Accuracy`, but a method: the digits apply to the lowest levels.

    Returns
    -------
    Spectrum
        Its `levels` have E_n and y_n for all n at once; `complete` says whether it is proven that these are all,
        `closed_forms_complete` whether no other level has a closed form, and `reason` why, or why it is undecided.

    Raises
    ------
    InputError
        For what isn't a potential, a domain or a boundary condition.
    LimitExceeded
        For an input above the limits.

    Examples
    --------
    >>> import kovacic
    >>> coulomb = kovacic.spectrum("l*(l+1)/x^2 - Z/x", domain=(0, "oo"), assume={"l": ">=1", "Z": "positive"})
    >>> coulomb.levels[0].energy
    -Z**2/(4*(l + n + 1)**2)
    >>> coulomb.complete
    True
    >>> half_line = kovacic.spectrum("x^2", domain=(0, "oo"))
    >>> half_line.boundary, half_line.levels[0].energy
    ('friedrichs', 4*n + 3)
    >>> kovacic.spectrum("-x^4").needs_boundary_condition
    True
    >>> quartic = kovacic.spectrum("x^4")
    >>> quartic.complete, quartic.closed_forms_complete, quartic.levels
    (False, True, ())
    >>> print(kovacic.spectrum("x^4", levels=1, digits=10).numeric)
    E = 1.06036209048 ± 3.1e-11  (0 zeros)

    References: H. Weyl, Math. Ann. 68 (1910) 220; F. Cooper, A. Khare & U. Sukhatme, Phys. Rep. 251 (1995) 267.
    """
    check_mapping(assume)
    digits, limits = digits_and_limits("spectrum", accuracy=accuracy, digits=digits, limits=limits)
    degree = whole(max_degree, "max_degree")
    names = declared(parameters, assume)
    question = asked(
        V, domain=domain, energy=energy, var=var, assume=assume, boundary=boundary, names=names, limits=limits
    )
    try:
        found = with_matching(_schroedinger_spectrum(question, degree, limits))
    except NotRational as unread:
        found = with_matching(unsolved(question, unread))
        if levels is None:
            values = f"with values of {', '.join(found.parameters)} " if found.parameters else ""
            hint = f"{values}the lowest levels are computed as proven numbers"
            python, shell = f"{hint}: levels=5", f"{hint}: --levels 5"
            if not (found.matching or found.complete):
                raise NotRational(str(unread), hint=python, shell=shell) from None
            if not (found.parameters or found.complete):
                found = replace(found, hint=python, shell=shell)
    with Budget(limits).watched(), suppress(LimitExceeded):  # as far as time allows
        check_first_levels(found)
    return with_numbers(found, levels, digits, limits)


def _schroedinger_spectrum(given: Asked, max_degree: int, limits: Limits) -> Spectrum:
    """The levels as far as exact methods give them.  Raises `NotRational`."""
    known = Examined(**vars(exact_problem(given, limits)))
    budget = Budget(limits)
    with budget.watched():
        try:
            known = examined(known)
            found = _all_levels(known, budget)
        except (Uncovered, LimitExceeded) as reason:
            found = known.spectrum(reason=f"undecided: {reason}")
        if found.complete or found.needs_boundary_condition:
            return found
        forms = closed_forms(known, max_degree, limits)
    why = forms.reason if forms.complete else found.reason or forms.reason
    found = replace(found, algebraic=tuple(forms.levels.values()), closed_forms_complete=forms.complete, reason=why)
    if forms.complete or forms.higher is None:
        return found
    higher = f"there may be levels with a polynomial of degree {forms.higher}"
    return replace(found, hint=f"{higher}: max_degree={forms.higher}", shell=f"{higher}: --max-degree {forms.higher}")


def _all_levels(question: Examined, budget: Budget) -> Spectrum:
    """All levels in one formula, or the reason why there is none."""
    for end in question.ends:
        if end.oscillates and end.is_limit_point:
            reason = f"no solution is square integrable at {end.at}"
            return question.spectrum(excluded=(), complete=True, reason=reason)
    if sympy.true in question.excluded:
        # Where solutions oscillate at an end, no boundary condition is distinguished, and none was given.
        return question.spectrum(excluded=(sympy.true,), reason="none is distinguished")
    infinite = [at.is_infinite for at in question.domain]
    if question.original.is_periodic and any(infinite):
        if all(infinite):
            return question.spectrum(complete=True, reason=NO_LEVELS)
        reason = "V is periodic, and no formula is known for its levels on a half line, which lie between the bands"
        return question.spectrum(reason=f"undecided: {reason}")
    try:
        levels, name = standard_levels(question, budget)
    except Uncovered:
        is_settled = not question.excluded and not question.boundary.is_mixed
        if is_settled and is_repulsive(question):
            return question.spectrum(complete=True, reason=REASON)
        return transformed(question, budget, _all_levels) or question.spectrum(reason=_why_no_formula(question))
    excluded = (*question.excluded, *dict.fromkeys(end.other for end in question.ends))
    return replace(question, excluded=excluded).spectrum(levels=levels, complete=True, reason=f"{name}: {_POLYNOMIAL}")


def _why_no_formula(question: Examined) -> str:
    """Explains the missing formula if an end is an ordinary point; "" where single levels may be found."""
    wall = next((end.at for end in question.ends if end.is_regular), None)
    if wall is None:
        return ""
    where = f"{question.variable} = {question.shown(wall)}"
    meets = "fulfils the condition" if any(question.boundary.wishes) else "vanishes"
    return (
        f"undecided: the levels are the energies for which a solution {meets} at {where}, an ordinary point; a formula "
        "is known where V is constant, and where the ends are poles, infinite, or the middle of a symmetric V"
    )
