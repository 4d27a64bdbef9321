"""`kovacic.spectrum`: for which energies is there a square integrable solution?"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.bound_states.darboux import DarbouxStep, steps
from kovacic.bound_states.ends import End, check_inside, end_of, potential_in_t
from kovacic.bound_states.families import (
    Ends,
    LevelFamily,
    constant_families,
    hermite_families,
    jacobi_families,
    laguerre_families,
    no_families,
)
from kovacic.bound_states.first_levels import check_first_levels
from kovacic.bound_states.frame import Original, RealPotential, SingularFrame, Uncovered, frames, range_of
from kovacic.bound_states.letters import between, in_their_meanings, with_named_roots
from kovacic.bound_states.levels import Algebraic, BoundState, Levels, Spectrum
from kovacic.bound_states.liouvillian import with_closed_forms
from kovacic.bound_states.norms import norm_of
from kovacic.bound_states.numeric import unsolved, with_numbers
from kovacic.bound_states.periodic import NO_LEVELS, check_poles, on_real_circle
from kovacic.bound_states.physical import is_equation, read_schroedinger, without_left_side
from kovacic.bound_states.quasi import (
    QuasiSolution,
    constant_degrees,
    degree_beyond,
    found_at,
    found_of_degree,
)
from kovacic.bound_states.question import FRIEDRICHS, SpectralProblem, read_question
from kovacic.bound_states.ranges import tidied
from kovacic.equation import ENERGY
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.exact import whole
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, check_duration, limited
from kovacic.numerals import as_text
from kovacic.parametric.api import DEFAULT_DEGREE
from kovacic.parametric.assumptions import check_mapping
from kovacic.parametric.functions import over_parameters
from kovacic.reading.read import declared
from kovacic.reading.symbolic import read_expression
from kovacic.writing.formula import caret

_CLASSES: tuple[tuple[Callable[[SingularFrame, Ends, Any], Iterator[LevelFamily]], str], ...] = (
    (constant_families, "a constant potential"),
    (hermite_families, "Hermite's polynomials"),
    (laguerre_families, "Whittaker's equation"),
    (jacobi_families, "three regular singular points"),
    (no_families, "Bessel's equation"),
)
_PROOF = {"a constant potential": "solutions are waves and exponentials"}
_POLYNOMIAL = "each solution that is square integrable at both ends has a polynomial in it"
#: Seconds that SymPy takes to expand a potential at the ends of its domain, over its terms to the power 3/2.
_END_SECONDS = 4e-4


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
    digits: int = 15,
    parameters: Sequence[str] = (),
    limits: Limits = DEFAULT_LIMITS,
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
        "friedrichs": at an end where both solutions are square integrable the smaller one is meant, which is y = 0 at a
        regular end.  It is taken, with a note, where such a condition is needed and the operator is bounded below; where
        solutions oscillate at an end no condition is distinguished, and there is no spectrum without one.
    max_degree : int
        Of a quasi-exactly solvable potential, the levels with a polynomial of at most this degree are given; 2 by default.
    levels : int, optional
        So many of the lowest levels are computed as proven numbers, `numeric` of the answer: for a potential without
        parameters, which may then be any elementary function, abs(x), cosh(x) - x^2.
    digits : int
        Proven digits of these.
    parameters : sequence of str
        Names of parameters that have more than one letter, as "EI" or "mass"; other such names are refused.
    limits : Limits
        Bounds on the input and on the work.

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
    most = whole(max_degree, "max_degree")
    check_mapping(assume)
    names = declared(parameters, assume)
    V, var = without_left_side(V, var)
    if is_equation(V):
        read = read_schroedinger(V, var, energy, limits)
        scaled = read.scaled
        positive = {name: "positive" for name in read.positive if sympy.Symbol(name) in scaled.free_symbols}
        found = _spectrum(
            scaled,
            domain=domain,
            energy=energy,
            var=read.variable,
            assume={**positive, **(assume or {})},
            boundary=boundary,
            max_degree=most,
            limits=limits,
            kinetic=read.kinetic,
            names=names,
        )
        return with_numbers(read.physical(found), levels, digits, limits)
    try:
        found = _spectrum(
            V,
            domain=domain,
            energy=energy,
            var=var,
            assume=assume,
            boundary=boundary,
            max_degree=most,
            limits=limits,
            names=names,
        )
    except NotRational as reason:
        if levels is None:
            raise
        found = unsolved(V, domain, energy, var, reason)
    return with_numbers(found, levels, digits, limits)


def _spectrum(
    V: Any,
    *,
    domain: Sequence[Any],
    energy: str,
    var: Any,
    assume: Mapping[Any, Any] | None,
    boundary: str | None,
    max_degree: int,
    limits: Limits,
    kinetic: Any = sympy.S.One,
    names: Sequence[str] = (),
) -> Spectrum:
    """The spectrum of -y'' + V y = E y; sentences about V speak of kinetic * V."""
    V, roots = with_named_roots(V)
    if roots:
        assume = {**(assume or {}), **{name: between(value, name) for name, value in roots.items()}}
    question = read_question(
        V,
        domain,
        energy=energy,
        var=var,
        assume=assume,
        boundary=boundary,
        limits=limits,
        kinetic=kinetic,
        names=names,
    )
    meanings = {**dict(question.parsed.letters), **roots}
    budget = Budget(limits)
    with budget.watched():
        try:
            found = _answered(question, max_degree, budget)
        except (Uncovered, LimitExceeded) as reason:
            found = _Examined(question).spectrum(reason=f"undecided: {reason}")
        found = with_closed_forms(
            found,
            question.parsed,
            question.known,
            limits,
            lambda polynomial: _is_no_level(question, polynomial, budget),
        )
        if not meanings:
            with suppress(LimitExceeded):  # as far as time allows
                check_first_levels(found, question.known)
    return in_their_meanings(found, meanings) if meanings else found


@dataclass(frozen=True)
class _Examined:
    """The question, its ends, and where a boundary condition would be needed: relations, or true."""

    question: SpectralProblem
    ends: tuple[End, ...] = ()
    excluded: tuple[Any, ...] = ()

    @property
    def needs_boundary_condition(self) -> bool:
        """For all values of the parameters?"""
        return sympy.true in self.excluded

    def spectrum(self, **found: Any) -> Spectrum:
        """The answer, with what was `found`."""
        question = self.question
        plain = question.plain
        boundary = FRIEDRICHS if question.friedrichs else None
        return Spectrum(
            question.V,
            question.variable,
            tuple(map(plain, question.domain)),
            question.energy,
            question.parameters,
            question.known,
            boundary=boundary,
            ends=tuple(end.sentence for end in self.ends),
            excluded=tuple(map(plain, self.excluded)),
            notices=question.notices,
            **found,
        )


def _answered(question: SpectralProblem, max_degree: int, budget: Budget) -> Spectrum:
    """What is found.  Raises `Uncovered` where the ends can't be examined, or t isn't real."""
    real = _in_real_variable(question)
    is_endless = any(end.is_infinite for end in question.domain)
    if real.original.is_periodic and is_endless:
        check_poles(real, question.signs)
        return _on_periodic_line(question, real)
    check_inside(real, question.domain, question.signs)
    left = end_of(real, question.domain, question.signs, is_right=False)
    right = end_of(real, question.domain, question.signs, is_right=True)
    examined = _examined(question, [left, right])
    if examined.needs_boundary_condition:
        if not any(end.oscillates for end in examined.ends):
            return _answered(question.with_friedrichs_condition(), max_degree, budget)
        # Where solutions oscillate at an end, no boundary condition is distinguished, and none was given.
        return replace(examined, excluded=(sympy.true,)).spectrum(reason="none is distinguished")
    oscillating = next((end for end in examined.ends if end.oscillates and end.circle is False), None)
    if oscillating is not None:
        reason = f"no solution is square integrable at {oscillating.at}"
        return replace(examined, excluded=()).spectrum(complete=True, reason=reason)
    try:
        families, name = _families(question, budget)
    except Uncovered as uncovered:
        return _without_formula(examined, uncovered, max_degree, budget)
    found = (_levels(question, family) for family in families)
    levels = [one for one in found if sympy.false not in one.conditions and one.members != ()]
    reason = f"{name}: {_PROOF.get(name, _POLYNOMIAL)}"
    return examined.spectrum(levels=tuple(levels), complete=True, reason=reason)


def _without_formula(examined: _Examined, why: Uncovered, max_degree: int, budget: Budget) -> Spectrum:
    """Where the equation is no standard one: from another potential, or one level at a time."""
    question = examined.question
    transformed = _transformed(examined, max_degree, budget)
    if transformed is not None:
        return transformed
    wall = next((end.at for end in examined.ends if end.is_ordinary), None)
    if wall is not None:
        where = f"{question.variable} = {caret(str(question.plain(wall)))}"
        reason = (
            f"undecided: the levels are the energies for which a solution vanishes at {where}, an ordinary point; a formula "
            "is known where V is constant, and where the ends are poles, infinite, or the middle of a symmetric V"
        )
        return examined.spectrum(reason=reason)
    if _is_circular(question):
        raise why
    return _one_by_one(examined, str(why), max_degree, budget)


def _examined(question: SpectralProblem, ends: Sequence[End]) -> _Examined:
    """With the relations where both solutions are square integrable at an end and none of them is chosen."""
    signs = question.signs
    excluded: dict[Any, None] = {}
    for end in ends:
        is_chosen = question.friedrichs and not end.oscillates
        if is_chosen or end.circle is False or signs.holds(end.circle) is False:
            continue
        circle = sympy.sympify(end.circle, strict=True)
        relation = sympy.true if signs.holds(circle) else tidied([circle], signs)[0]
        excluded[relation] = None
    return _Examined(question, tuple(ends), tuple(excluded))


def _transformed(examined: _Examined, max_degree: int, budget: Budget) -> Spectrum | None:
    """By Darboux' transformation from a potential without apparent singularities; None where there is none."""
    question = examined.question
    if question.parsed.equation is not None or examined.excluded:
        return None
    V = question.signs.real(question.V).xreplace({sympy.Symbol(question.variable): question.x})
    for step in steps(V, question.x, question.domain, question.signs):
        simpler_V = sympy.cancel(sympy.together(V - 2 * sympy.diff(step.W, question.x)))
        try:
            simpler = _answered(question.with_potential(simpler_V), max_degree, budget)
        except (Uncovered, InputError):
            continue
        if not simpler.complete or simpler.excluded or _is_removed(step, simpler, question):
            continue
        shown = caret(as_text(question.plain(sympy.factor(question.kinetic * simpler_V))))
        return examined.spectrum(
            levels=_transformed_levels(step, simpler, question),
            algebraic=_lowest_level(step, question),
            complete=True,
            reason=f"Darboux' transformation of V = {shown}; {simpler.reason}",
        )
    return None


def _is_removed(step: DarbouxStep, simpler: Spectrum, question: SpectralProblem) -> bool:
    """May E0 be a level of the simpler potential, which then is none of the other one?"""
    energy = question.plain(step.energy)
    for levels in simpler.levels:
        difference = question.signs.real(levels.energy - energy).xreplace({levels.number: question.signs.n})
        if question.signs.sign(difference) is None:
            return True
    return False


def _transformed_levels(step: DarbouxStep, simpler: Spectrum, question: SpectralProblem) -> tuple[Levels, ...]:
    """Those of the simpler potential with y' + W y for y, whose norm^2 is (E - E0) times that of y."""
    x = sympy.Symbol(question.variable)
    W = question.plain(sympy.factor(step.W))
    E0 = question.plain(step.energy)
    levels = []
    for one in simpler.levels:
        norm = None
        if one.norm is not None:
            norm = (one.energy - E0) * one.norm
        wave = W * one.wave + sympy.Derivative(one.wave, x)
        levels.append(replace(one, wave=wave, zeros=one.zeros + int(step.is_level), norm=norm))
    return tuple(levels)


def _lowest_level(step: DarbouxStep, question: SpectralProblem) -> tuple[Algebraic, ...]:
    """E0 with y0, if that is a level."""
    if not step.is_level:
        return ()
    energy = question.plain(step.energy)
    wave = question.plain(step.wave)
    states = () if question.parameters else (BoundState(0, energy, wave, 0),)
    E = sympy.Symbol(question.energy)
    return (Algebraic(0, sympy.Integer(0), E - energy, wave, (), states),)


def _one_by_one(examined: _Examined, why: str, max_degree: int, budget: Budget) -> Spectrum:
    """The levels with a polynomial of degree 0, 1, ..., `max_degree`; `why` there is no formula for all."""
    question = examined.question
    demands = Ends(question.signs, question.friedrichs)
    found: list[Algebraic] = []
    higher = None
    try:
        degrees = {*range(max_degree + 1)}
        if not question.parameters:
            degrees |= constant_degrees(question, budget)
        for d in sorted(degrees):
            solutions = found_of_degree(question, d, examined.ends, demands, budget)
            levels = (_algebraic(question, solution) for solution in solutions)
            found += [one for one in levels if sympy.false not in one.conditions]
        found += _at_thresholds(examined, demands, budget)
    except Uncovered as uncovered:
        why = f"{why}; {uncovered}"
    else:
        higher = degree_beyond(question.parsed.S, max_degree, budget)
    hints = {}
    if higher is not None:
        may = "there may be levels with a polynomial of degree"
        hints = {"hint": f"{may} {higher}: max_degree={higher}", "shell": f"{may} {higher}: --max-degree {higher}"}
    if not found:
        reason = f"undecided: {why}; degrees up to {max_degree} were tried"
        return examined.spectrum(reason=reason, **hints)
    others = "whether others are Liouvillian isn't known"
    if not question.parameters:
        others = "a level with k zeros is number k (Sturm)"
    reason = f"the levels with a polynomial of degree d <= {max_degree}; {others}"
    return examined.spectrum(algebraic=tuple(found), reason=reason, **hints)


def _at_thresholds(examined: _Examined, demands: Ends, budget: Budget) -> Iterator[Algebraic]:
    """The levels at the edges of the continuous spectrum, where solutions are powers of x at an infinite end."""
    question = examined.question
    if question.parameters:
        return
    for threshold in dict.fromkeys(end.threshold for end in examined.ends):
        if threshold is not None and threshold.is_Rational:
            factor = _in_energy(question, sympy.Symbol(question.energy) - threshold)
            for level in found_at(question, factor, examined.ends, demands, budget).levels:
                yield _algebraic(question, level)


def _is_no_level(question: SpectralProblem, polynomial: Any, budget: Budget) -> bool:
    """True if the zeros of an irreducible polynomial in E are proven to be no levels, of a potential without parameters."""
    with suppress(Uncovered, LimitExceeded):
        real = _in_real_variable(question)
        ends = [end_of(real, question.domain, question.signs, is_right=is_right) for is_right in (False, True)]
        factor = _in_energy(question, polynomial)
        found = found_at(question, factor, ends, Ends(question.signs, question.friedrichs), budget)
        return found.is_excluded and not found.levels
    return False


def _in_energy(question: SpectralProblem, polynomial: Any) -> FunctionPoly:
    """A polynomial in E with rational coefficients, in the field of the equation."""
    field = question.parsed.S.field
    assert isinstance(field, FunctionField)
    E = field.generator(question.energy)
    total = 0 * E
    for c in sympy.Poly(polynomial, sympy.Symbol(question.energy)).all_coeffs():
        total = total * E + Fraction(int(c.p), int(c.q))
    return over_parameters(total)


def _algebraic(question: SpectralProblem, found: QuasiSolution) -> Algebraic:
    """With the energies, and which levels they are, where there are no parameters."""
    conditions = tuple(map(question.plain, tidied(found.conditions, question.signs)))
    original = Original.of(question.parsed.equation, question.x, question.signs)
    limits = None
    with suppress(Uncovered):
        if not original.turning_points(question.domain, question.signs):
            limits = range_of(original, question.domain, question.signs)
    levels = Algebraic(
        found.degree,
        found.constraint,
        found.polynomial,
        found.wave,
        conditions,
        P=sympy.Poly(found.P, sympy.Symbol(question.parsed.variable)),
        range=limits,
    )
    if question.parameters:
        return levels
    x = sympy.Symbol(question.variable)
    states = levels.states_at({}, question.energy)
    return replace(levels, states=tuple(replace(s, norm=norm_of(s.wave, x, question.domain)) for s in states))


def _in_real_variable(question: SpectralProblem) -> RealPotential:
    """V as a function of a real t.  Raises `LimitExceeded` where examining it would take too long."""
    parsed = question.parsed
    _check_branch_point(question)
    original = Original.of(parsed.equation, question.x, question.signs)
    terms = parsed.S.num.degree + parsed.S.den.degree
    check_duration(_END_SECONDS * terms**1.5, f"examining a potential of {terms} terms at its ends")
    return on_real_circle(potential_in_t(question, original))


def _check_branch_point(question: SpectralProblem) -> None:
    """Raises `InputError` where V has a root of x, and the domain isn't known to be right of 0."""
    equation = question.parsed.equation
    if equation is None or equation.change is None:
        return
    t = read_expression(equation.change.expression)
    is_root = t.is_Pow and t.base == sympy.Symbol(question.variable)
    start = question.domain[0]
    if is_root and (start.is_infinite or not question.signs.is_nonnegative(start)):
        hint = "choose a domain on the right of it"
        raise InputError(
            f"the potential has a branch point at {question.variable} = 0, which may be inside the domain",
            hint=f'{hint}: domain=(0, "oo")',
            shell=f"{hint}: --from 0",
        )


def _on_periodic_line(question: SpectralProblem, real: RealPotential) -> Spectrum:
    """The spectrum of a periodic potential without poles on the whole line, or on half of it."""
    ends = []
    for at in question.domain:
        if at.is_infinite:
            ends.append(End(at, False, f"{question.variable} -> {at}: V is periodic, at most one solution decays"))
        else:
            is_right = at == question.domain[1]
            ends.append(end_of(real, question.domain, question.signs, is_right=is_right))
    if all(at.is_infinite for at in question.domain):
        return _Examined(question, tuple(ends)).spectrum(complete=True, reason=NO_LEVELS)
    examined = _examined(question, ends)
    if examined.needs_boundary_condition:
        examined = _examined(question.with_friedrichs_condition(), ends)
    reason = (
        "undecided: V is periodic, and no formula is known for its levels on a half line, which lie between the bands"
    )
    return examined.spectrum(reason=reason)


def _is_circular(question: SpectralProblem) -> bool:
    return Original.of(question.parsed.equation, question.x, question.signs).is_circular


def _families(question: SpectralProblem, budget: Budget) -> tuple[list[LevelFamily], str]:
    """Those of the first coordinate and standard equation that fit, and its name."""
    if _is_circular(question):
        raise Uncovered(
            "no formula is known for potentials in exp(i x) that aren't rational in one sine, cosine or tangent"
        )
    demands = Ends(question.signs, question.friedrichs)
    reasons = []
    for frame in frames(question, budget):
        for families, name in _CLASSES:
            try:
                return [*families(frame, demands, question.E)], name
            except Uncovered as reason:
                reasons.append(str(reason))
    raise Uncovered("; ".join(dict.fromkeys(reasons)))


def _levels(question: SpectralProblem, family: LevelFamily) -> Levels:
    """In the user's symbols, with the square roots for which symbols stand."""
    radicals = dict(family.radicals)

    def written(expression: Any) -> Any:
        return question.plain(sympy.sympify(expression).xreplace(radicals))

    conditions = [written(condition) for condition in tidied(family.conditions, question.signs, radicals)]
    norm = None if family.norm is None else written(family.norm)
    return Levels(
        question.plain(question.signs.n),
        written(family.energy),
        written(family.wave),
        tuple(c for c in conditions if c != sympy.true),
        written(family.zeros),
        norm,
    )
