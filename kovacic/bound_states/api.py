"""`kovacic.spectrum`: for which energies is there a square integrable solution?"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.answer import Algebraic, BoundState, Levels, Spectrum
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
from kovacic.bound_states.frame import Original, SingularFrame, Uncovered, frames, range_of
from kovacic.bound_states.letters import assumed_of_letters, between, in_their_meanings, with_named_roots
from kovacic.bound_states.liouvillian import with_closed_forms
from kovacic.bound_states.periodic import NO_LEVELS, check_poles, on_real_circle
from kovacic.bound_states.quasi import QuasiSolution, degree_beyond, found_of_degree, levels_of, zeros_inside
from kovacic.bound_states.ranges import tidied
from kovacic.bound_states.signs import Signs
from kovacic.equation import DEFAULT_VARIABLE, ENERGY, EULER, PI, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.exact import exact_text, whole
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, check_duration, limited
from kovacic.numerals import as_text
from kovacic.parametric.api import DEFAULT_DEGREE
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.reading.read import read_input
from kovacic.reading.source import USUAL_VARIABLES, chosen_variable
from kovacic.reading.substitution import with_values
from kovacic.reading.symbolic import LIMITS as SYMBOLIC
from kovacic.reading.symbolic import names_of, read_expression
from kovacic.writing.formula import caret

FRIEDRICHS = "friedrichs"
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


@dataclass(frozen=True)
class SpectralProblem:
    """The problem: V - E as it was read, and the domain, in real symbols."""

    V: Any
    parsed: Parsed
    domain: tuple[Any, Any]
    variable: str
    energy: str
    known: Assumptions
    signs: Signs
    friedrichs: bool
    notices: tuple[str, ...] = ()

    @property
    def x(self) -> Any:
        return sympy.Symbol(self.variable, real=True)

    @property
    def E(self) -> Any:
        return self.signs.symbols[self.energy]

    @property
    def parameters(self) -> tuple[str, ...]:
        return tuple(name for name in self.signs.symbols if name != self.energy and name not in self.constants)

    @property
    def constants(self) -> dict[str, Any]:
        return _constants(self.V, self.signs.symbols)

    def with_potential(self, V: Any) -> SpectralProblem:
        """The same for another potential, in real symbols."""
        plain = self.plain(V)
        text = f"({as_text(plain)}) - {self.energy}"
        return replace(self, V=plain, parsed=read_input(text, var=self.variable, exponentials=True))

    def plain(self, expression: Any) -> Any:
        """In plain symbols of the same names, as users write them; n for the number of a level."""
        number = next(name for name in ("n", "k", "j", "m", "n_") if name not in (*self.signs.symbols, self.variable))
        symbols = [s for s in expression.free_symbols if not isinstance(s, sympy.Dummy)]
        names = {s: self.constants.get(s.name, sympy.Symbol(s.name)) for s in symbols}
        return expression.xreplace({**names, self.signs.n: sympy.Symbol(number)})


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
    limits: Limits = DEFAULT_LIMITS,
) -> Spectrum:
    """The energies E for which -y'' + V y = E y has a square integrable solution, with the solutions.

    Parameters
    ----------
    V : str or sympy.Expr
        The potential: rational in x, or in exp(k x), sin, cosh, ... of multiples of k x, with real parameters.
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
        regular end.  Without it, there is no spectrum where such a condition is needed.
    max_degree : int
        Of a quasi-exactly solvable potential, the levels with a polynomial of at most this degree are given; 2 by default.
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
    >>> kovacic.spectrum("x^2", domain=(0, "oo")).needs_boundary_condition
    True
    >>> print(kovacic.spectrum("x^2", domain=(0, "oo"), boundary="friedrichs").levels[0].energy)
    4*n + 3
    >>> quartic = kovacic.spectrum("x^4")
    >>> quartic.complete, quartic.closed_forms_complete, quartic.levels
    (False, True, ())

    References: H. Weyl, Math. Ann. 68 (1910) 220; F. Cooper, A. Khare & U. Sukhatme, Phys. Rep. 251 (1995) 267.
    """
    most = whole(max_degree, "max_degree")
    V, roots = with_named_roots(V)
    if roots:
        assume = {**(assume or {}), **{name: between(value, name) for name, value in roots.items()}}
    question = _question(V, domain, energy, var, assume, boundary, limits)
    meanings = {**dict(question.parsed.letters), **roots}
    budget = Budget(limits)
    with budget.watched():
        try:
            found = _answered(question, most, budget)
        except (Uncovered, LimitExceeded) as reason:
            found = _spectrum(question, [], reason=f"undecided: {reason}")
        found = with_closed_forms(found, question.parsed, question.known, limits)
    return in_their_meanings(found, meanings) if meanings else found


def _question(
    V: Any, domain: Sequence[Any], energy: str, var: Any, assume: Any, boundary: str | None, limits: Limits
) -> SpectralProblem:
    if boundary not in (None, FRIEDRICHS):
        raise InputError(f"{boundary!r} isn't a boundary condition", hint=f'boundary="{FRIEDRICHS}", or none')
    if not isinstance(energy, str) or not energy.isidentifier():
        raise InputError(f"{energy!r} can't be the name of the energy")
    expression, S = _potential(V, energy)
    name, notices = _variable(expression) if var is None else (str(var), ())
    if len(domain) != 2 or isinstance(domain, str):
        raise InputError("a domain is a pair of ends", hint='domain=(0, "oo")')
    parsed = read_input(S, var=name, limits=limits, exponentials=True)
    S, parsed, assume = with_values(S, parsed, assume, limits)
    assume = assumed_of_letters(assume, parsed.letters)
    names = parameters_of(parsed.S.field)
    ends = [_end(value) for value in domain]
    in_the_domain = {symbol.name for end in ends for symbol in end.free_symbols}
    if in_the_domain & {name, energy}:
        raise InputError(f"an end of the domain contains {name} or {energy}")
    names += tuple(sorted(in_the_domain - {*names}))
    known = read_assumptions(assume, V, names)
    for constant in _constants(expression, names):
        known = known.also(constant, ("irrational", "positive"))
    signs = Signs(known, names)
    if isinstance(S, str):
        expression = read_expression(S[: S.rindex(" - ")])
    first, last = map(signs.real, ends)
    if signs.is_nonnegative(first - last) or first == sympy.oo or last == -sympy.oo:
        raise InputError(f"the domain is empty: {first} isn't below {last}")
    return SpectralProblem(
        expression, parsed, (first, last), name, energy, known, signs, boundary == FRIEDRICHS, notices
    )


def _variable(expression: Any) -> tuple[str, tuple[str, ...]]:
    """x, or the only name if it usually is a variable; and a note where it isn't x.  Raises `InputError` for several names."""
    names = names_of(expression)
    if DEFAULT_VARIABLE in names or not names:
        return DEFAULT_VARIABLE, ()
    only = chosen_variable(names)
    if only in USUAL_VARIABLES:
        return only, (f"{only} is taken for the variable, of which V is a function",)
    return DEFAULT_VARIABLE, (f"{DEFAULT_VARIABLE} is the variable, {only} a parameter",)


def _potential(V: Any, energy: str) -> tuple[Any, Any]:
    """V as an expression, and V - E as it is read: text where V is.  Raises `InputError` for what isn't a real potential."""
    if isinstance(V, str):
        expression = read_expression(V, what="the potential")
        S: Any = f"({V}) - {energy}"
    else:
        expression = V if hasattr(V, "free_symbols") else read_expression(exact_text(V, "the potential"))
        S = expression - sympy.Symbol(energy)
    if energy in {s.name for s in expression.free_symbols}:
        raise InputError(
            f"the potential contains {energy}, the energy",
            hint="energy= gives it another name",
            shell="--energy gives it another name",
        )
    longest = max((max(abs(int(c.p)), int(c.q)) for c in expression.atoms(sympy.Rational)), default=0)
    if longest.bit_length() > SYMBOLIC.bits:
        raise LimitExceeded(f"the potential has numbers of more than {SYMBOLIC.bits} bits", limit="bits")
    if expression.has(sympy.I):
        raise InputError("the potential isn't real")
    return expression, S


def _constants(expression: Any, names: Iterable[str]) -> dict[str, Any]:
    """pi and e, which are parameters for the program, and aren't for users."""
    symbols = {symbol.name for symbol in expression.free_symbols}
    return {name: value for name, value in ((PI, sympy.pi), (EULER, sympy.E)) if name in names and name not in symbols}


def _end(value: Any) -> Any:
    text = exact_text(value, "an end of the domain")
    infinite = {"oo": sympy.oo, "+oo": sympy.oo, "inf": sympy.oo, "-oo": -sympy.oo, "-inf": -sympy.oo}
    return infinite[text] if text in infinite else read_expression(text, what="an end of the domain")


def _answered(question: SpectralProblem, max_degree: int, budget: Budget) -> Spectrum:
    V, original, t = _in_real_variable(question)
    is_endless = any(end.is_infinite for end in question.domain)
    if original.is_periodic and is_endless:
        check_poles(V, original, t, question.signs)
        return _on_periodic_line(question, V, original, t)
    check_inside(V, original, question.domain, t, question.signs)
    ends = [end_of(V, original, question.domain, t, question.signs, is_right=is_right) for is_right in (False, True)]
    excluded = _excluded(question, ends)
    if sympy.true in excluded:
        return _without_condition(question, ends)
    for end in ends:
        if end.oscillates and end.circle is False:
            reason = f"no solution is square integrable at {end.at}"
            return _spectrum(question, ends, complete=True, reason=reason)
    try:
        families, name = _families(question, budget)
    except Uncovered as uncovered:
        transformed = _transformed(question, ends, excluded, max_degree, budget)
        if transformed is not None:
            return transformed
        wall = next((end.at for end in ends if end.is_ordinary), None)
        if wall is None and _is_circular(question):
            raise
        if wall is not None:
            reason = f"undecided: {_at_a_wall(question, wall)}"
            return _spectrum(question, ends, excluded=tuple(excluded), reason=reason)
        return _one_by_one(question, ends, excluded, max_degree, str(uncovered), budget)
    found = (_levels(question, family) for family in families)
    possible = [levels for levels in found if sympy.false not in levels.conditions]
    levels = _merged(possible)
    reason = f"{name}: {_PROOF.get(name, _POLYNOMIAL)}"
    return _spectrum(question, ends, excluded=tuple(excluded), levels=tuple(levels), complete=True, reason=reason)


def _without_condition(question: SpectralProblem, ends: Sequence[End]) -> Spectrum:
    """Where a boundary condition is needed, and none was given."""
    if any(end.oscillates for end in ends):
        return _spectrum(question, ends, excluded=(sympy.true,), reason="none is distinguished")
    return _spectrum(
        question,
        ends,
        excluded=(sympy.true,),
        reason="Friedrichs' condition is the smaller solution",
        hint=f'boundary="{FRIEDRICHS}" chooses it',
        shell=f"--boundary {FRIEDRICHS} chooses it",
    )


def _excluded(question: SpectralProblem, ends: list[End]) -> list[Any]:
    """Where both solutions are square integrable at an end and none of them is chosen; true where that is always so."""
    signs = question.signs
    found: dict[Any, None] = {}
    for end in ends:
        is_chosen = question.friedrichs and not end.oscillates
        if is_chosen or end.circle is False or signs.holds(end.circle) is False:
            continue
        circle = sympy.sympify(end.circle, strict=True)
        if signs.holds(circle):
            found[sympy.true] = None
        else:
            found[tidied([circle], signs)[0]] = None
    return [*found]


def _at_a_wall(question: SpectralProblem, at: Any) -> str:
    where = f"{question.variable} = {caret(str(question.plain(at)))}"
    return (
        f"the levels are the energies for which a solution vanishes at {where}, an ordinary point; a formula is known "
        "where V is constant, and where the ends are poles, infinite, or the middle of a symmetric V"
    )


def _transformed(
    question: SpectralProblem, ends: list[End], excluded: list[Any], max_degree: int, budget: Budget
) -> Spectrum | None:
    """By Darboux' transformation from a potential without apparent singularities; None where there is none."""
    if question.parsed.equation is not None or excluded:
        return None
    real = question.signs.real(question.V).xreplace({sympy.Symbol(question.variable): question.x})
    for step in steps(real, question.x, question.domain, question.signs):
        V = sympy.cancel(sympy.together(real - 2 * sympy.diff(step.W, question.x)))
        try:
            simpler = _answered(question.with_potential(V), max_degree, budget)
        except (Uncovered, InputError):
            continue
        if not simpler.complete or simpler.excluded or _is_removed(step, simpler, question):
            continue
        plain = question.plain
        x = sympy.Symbol(question.variable)
        W = plain(sympy.factor(step.W))
        energy = plain(step.energy)
        levels = [
            replace(
                one,
                wave=W * one.wave + sympy.Derivative(one.wave, x),
                zeros=one.zeros + int(step.is_level),
                norm=None if one.norm is None else (one.energy - energy) * one.norm,
            )
            for one in simpler.levels
        ]
        algebraic: list[Algebraic] = []
        if step.is_level:
            wave = plain(step.wave)
            states = () if question.parameters else (BoundState(0, energy, wave, 0),)
            E = sympy.Symbol(question.energy)
            algebraic = [Algebraic(0, sympy.Integer(0), E - energy, wave, (), states)]
        shown = caret(as_text(plain(sympy.factor(V))))
        reason = f"Darboux' transformation of V = {shown}; {simpler.reason}"
        return _spectrum(question, ends, levels=tuple(levels), algebraic=tuple(algebraic), complete=True, reason=reason)
    return None


def _is_removed(step: DarbouxStep, simpler: Spectrum, question: SpectralProblem) -> bool:
    """May E0 be a level of the simpler potential, which then is none of the other one?"""
    energy = question.plain(step.energy)
    for levels in simpler.levels:
        difference = question.signs.real(levels.energy - energy).xreplace({levels.number: question.signs.n})
        if question.signs.sign(difference) is None:
            return True
    return False


def _one_by_one(
    question: SpectralProblem, ends: list[End], excluded: list[Any], max_degree: int, why: str, budget: Budget
) -> Spectrum:
    """The levels with a polynomial of degree 0, 1, ..., `max_degree`."""
    parsed = question.parsed
    found = list[Algebraic]()
    demands = Ends(question.signs, question.friedrichs)
    try:
        for d in range(max_degree + 1):
            solutions = found_of_degree(
                parsed.S, parsed.equation, parsed.variable, d, ends, demands, question.energy, budget
            )
            found += [
                one for one in (_algebraic(question, one) for one in solutions) if sympy.false not in one.conditions
            ]
    except Uncovered as uncovered:
        why = f"{why}; {uncovered}"
        higher = None
    else:
        higher = degree_beyond(parsed.S, max_degree, budget)
    hints = {}
    if higher is not None:
        may = "there may be levels with a polynomial of degree"
        hints = {"hint": f"{may} {higher}: max_degree={higher}", "shell": f"{may} {higher}: --max-degree {higher}"}
    if not found:
        reason = f"undecided: {why}; degrees up to {max_degree} were tried"
        return _spectrum(question, ends, excluded=tuple(excluded), reason=reason, **hints)
    reason = f"the levels with a polynomial of degree d <= {max_degree}; whether others are Liouvillian isn't known"
    if not question.parameters:
        reason = f"the levels with a polynomial of degree d <= {max_degree}; a level with k zeros is number k (Sturm)"
    return _spectrum(question, ends, excluded=tuple(excluded), algebraic=tuple(found), reason=reason, **hints)


def _algebraic(question: SpectralProblem, found: QuasiSolution) -> Algebraic:
    """With the energies, and which levels they are, where there are no parameters."""
    E = sympy.Symbol(question.energy)
    t = sympy.Symbol(question.parsed.variable)
    states: list[BoundState] = []
    original = Original.of(question.parsed.equation, question.x, question.signs)
    if not question.parameters and not original.turning_points(question.domain, question.signs):
        low, high = range_of(original, question.domain, question.signs)
        for energy, ball in levels_of(found.polynomial, E):
            number = zeros_inside(found.P, t, E, ball, low, high)
            if number is not None:
                states.append(BoundState(number, energy, found.wave.subs(E, energy), number))
    conditions = tuple(map(question.plain, tidied(found.conditions, question.signs)))
    return Algebraic(found.degree, found.constraint, found.polynomial, found.wave, conditions, tuple(states))


def _in_real_variable(question: SpectralProblem) -> tuple[Any, Original, Any]:
    """V as a function of a real t, what t is, and t."""
    parsed = question.parsed
    signs = question.signs
    _check_branch_point(question)
    original = Original.of(parsed.equation, question.x, signs)
    t = sympy.Symbol(parsed.variable)
    terms = parsed.S.num.degree + parsed.S.den.degree
    check_duration(_END_SECONDS * terms**1.5, f"examining a potential of {terms} terms at its ends")
    S = signs.real(parsed.S.num.to_sympy(t) / parsed.S.den.to_sympy(t))
    V = potential_in_t(S, parsed.equation, original, question.E, t, signs)
    V, original = on_real_circle(V, original, t)
    return V, original, t


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


def _on_periodic_line(question: SpectralProblem, V: Any, original: Original, t: Any) -> Spectrum:
    """The spectrum of a periodic potential without poles on the whole line, or on half of it."""
    ends: list[End] = []
    for at in question.domain:
        if at.is_infinite:
            ends.append(End(at, False, f"{question.variable} -> {at}: V is periodic, at most one solution decays"))
        else:
            ends.append(end_of(V, original, question.domain, t, question.signs, is_right=at == question.domain[1]))
    if all(at.is_infinite for at in question.domain):
        return _spectrum(question, ends, complete=True, reason=NO_LEVELS)
    excluded = _excluded(question, ends)
    if sympy.true in excluded:
        return _without_condition(question, ends)
    reason = (
        "undecided: V is periodic, and no formula is known for its levels on a half line, which lie between the bands"
    )
    return _spectrum(question, ends, excluded=tuple(excluded), reason=reason)


def _is_circular(question: SpectralProblem) -> bool:
    return Original.of(question.parsed.equation, question.x, question.signs).is_circular


def _families(question: SpectralProblem, budget: Budget) -> tuple[list[LevelFamily], str]:
    """Those of the first coordinate and standard equation that fit."""
    parsed = question.parsed
    reasons = []
    if _is_circular(question):
        raise Uncovered(
            "no formula is known for potentials in exp(i x) that aren't rational in one sine, cosine or tangent"
        )
    demands = Ends(question.signs, question.friedrichs)
    for frame in frames(
        parsed.S, parsed.variable, parsed.equation, question.domain, question.x, question.E, question.signs, budget
    ):
        for families, name in _CLASSES:
            try:
                return [*families(frame, demands, question.E)], name
            except Uncovered as reason:
                reasons.append(str(reason))
    raise Uncovered("; ".join(dict.fromkeys(reasons)))


def _levels(question: SpectralProblem, family: LevelFamily) -> Levels:
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


def _merged(levels: list[Levels]) -> list[Levels]:
    """The even and the odd solutions of a symmetric potential as one sequence, where one formula has both energies."""
    for even in levels:
        n = even.number
        for odd in levels:
            if even.zeros != 2 * n or odd.zeros != 2 * n + 1:
                continue
            energy = even.energy.subs(n, n / 2)
            if sympy.simplify(energy.subs(n, 2 * n + 1) - odd.energy) != 0:
                continue
            half = n / 2
            lower = (n - 1) / 2
            is_even = sympy.Eq(sympy.Mod(n, 2), 0)
            wave = sympy.Piecewise((even.wave.subs(n, half), is_even), (odd.wave.subs(n, lower), True))
            norm = None
            if even.norm is not None and odd.norm is not None:
                norm = sympy.Piecewise((even.norm.subs(n, half), is_even), (odd.norm.subs(n, lower), True))
            conditions = [c.subs(n, half) for c in even.conditions]
            others = [c.subs(n, lower) for c in odd.conditions]
            if [*map(str, map(_doubled, conditions))] != [*map(str, map(_doubled, others))]:
                continue
            together = Levels(n, sympy.factor(energy), wave, tuple(map(_doubled, conditions)), n, norm)
            return [together, *_merged([one for one in levels if one not in (even, odd)])]
    return levels


def _doubled(condition: Any) -> Any:
    """n/2 < c as n < 2 c."""
    n = sympy.Symbol("n")
    solved = condition.gts - condition.lts
    strict = isinstance(condition, sympy.StrictGreaterThan | sympy.StrictLessThan)
    slope = sympy.expand(solved).coeff(n, 1)
    if not slope.is_number or slope == 0:
        return condition
    bound = sympy.expand(-solved.subs(n, 0) / slope)
    if slope > 0:
        return sympy.StrictGreaterThan(n, bound) if strict else sympy.GreaterThan(n, bound)
    return sympy.StrictLessThan(n, bound) if strict else sympy.LessThan(n, bound)


def _spectrum(question: SpectralProblem, ends: Sequence[End], **found: Any) -> Spectrum:
    plain = question.plain
    excluded = tuple(map(plain, found.pop("excluded", ())))
    return Spectrum(
        question.V,
        question.variable,
        tuple(map(plain, question.domain)),
        question.energy,
        question.parameters,
        question.known,
        FRIEDRICHS if question.friedrichs else None,
        tuple(end.sentence for end in ends),
        excluded,
        notices=question.notices,
        **found,
    )
