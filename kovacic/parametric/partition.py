"""The partition of parameter space: which theory applies, the regions in their order, and the degenerate values.

What holds for generic values has limits everywhere.  An omega of degree m over the algebraic closure of Q(t)(x) is a root of a
binary form F(y, y') of degree m, with polynomials in x as coefficients, whose derivative along the solutions is a multiple of
it, F' = lambda F with a rational function lambda.  Let S be defined at t0, take a valuation ring of the constants that
dominates t0, and scale F so that its coefficients are integral and not all in the maximal ideal.  Then lambda is integral
(if pi lambda were the first integral multiple, pi F' = pi lambda F would vanish in the residue field, but neither pi lambda
nor F does), so that the residue of F is a form of degree m for t0, not zero, with the same property: a product of m
solutions with an algebraic logarithmic derivative.  So an equation that is generically in case 1 is in case 1 wherever S is
defined, one in case 2 is in case 1 or 2, and one that has Liouvillian solutions has them everywhere.
"""

from __future__ import annotations

from dataclasses import replace

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Decision, Status, Structure
from kovacic.engine.decide import decide
from kovacic.engine.places import Problem, analyse
from kovacic.errors import LimitExceeded
from kovacic.galois import group_of
from kovacic.parametric import confluent, riemann
from kovacic.parametric.bounded import (
    degrees_that_decide,
    denominators,
    form_conditions,
    has_constant_rational_exponents,
    irreducible_factors,
    union,
)
from kovacic.parametric.degenerate import confluence, structure_changes, undefined
from kovacic.parametric.regions import Partition, Region, Settings, Verdict
from kovacic.parametric.restriction import Restriction, UndefinedError, leading_factors, missed, on_hypersurface
from kovacic.parametric.search import search
from kovacic.parametric.statements import Both, Statement, Vanishes, either
from kovacic.solution import Solution
from kovacic.views.text import omega_lines

#: The degree of an algebraic number up to which its equation is solved, although it is known to be reducible.
_WRITTEN_OUT = 2
#: Characters of an omega that is written out.
_LONGEST_OMEGA = 300


def partition(S: RatFunc, settings: Settings) -> Partition:
    """The partition for S over Q(t), or the single verdict for S over Q or Q(alpha)."""
    constants = S.field
    decision = decide(S, settings.budget, certify=False)
    generic = verdict_of(decision)
    if constants.ground == QQ:
        return Partition(S, (), (), generic, generic.known or str(decision.undecided), "the engine")
    if not isinstance(constants, FunctionField):
        # Functions on a hypersurface; see the head of this module for case 1.
        reducible = generic.known and generic.structure is Structure.REDUCIBLE
        return Partition(S, (), (), generic, reducible or "for generic values only", "the engine")
    try:
        return _by_theory(S, generic, settings)
    except LimitExceeded as limit:
        complete = f"only as far as the limits allowed: {limit}"
        return Partition(S, constants.names, (), generic, complete, "nothing but the generic answer")


def _by_theory(S: RatFunc, generic: Verdict, settings: Settings) -> Partition:
    problem = analyse(S, settings.budget)
    if generic.known and generic.structure is Structure.REDUCIBLE:
        # So it is in case 1 at all values where S is defined: see the head of this module.
        regions = [region for region in _degenerate(problem, undefined(problem), settings) if not region.defined]
        return _closed(problem, regions, generic, "a rational omega for generic values, and so for all", generic)
    if riemann.applies(problem):
        return _riemann(problem, generic, settings)
    form = confluent.recognise(problem, settings.variable)
    if form is not None:
        return _confluent(problem, form, generic, settings)
    if settings.max_degree is None:
        names: tuple[str, ...] = problem.field.names  # type: ignore[attr-defined]
        return Partition(S, names, (), generic, "for generic values only", "no theorem covers all values")
    return _by_candidates(problem, generic, settings, settings.max_degree)


def verdict_of(decision: Decision) -> Verdict:
    """What the engine's decision says."""
    return Verdict(decision.structure, decision.status is not Status.UNDECIDED)


def _riemann(problem: Problem, generic: Verdict, settings: Settings) -> Partition:
    theory = "at most three regular singular points: Kimura's theorem"
    regions = _degenerate(problem, confluence(problem), settings)
    reducible = riemann.reducible(problem)
    case_1 = Verdict(Structure.REDUCIBLE, family=riemann.group(problem, Structure.REDUCIBLE))
    if reducible is True:
        return _closed(problem, regions, case_1, theory, generic)
    assert isinstance(reducible, list)
    regions.append(Region(either(reducible), case_1, omega=riemann.omega(problem, settings.variable)))
    others = riemann.irreducible_structures(problem)
    if isinstance(others, Structure):
        return _closed(problem, regions, Verdict(others, family=riemann.group(problem, others)), theory, generic)
    for structure in Structure:
        statements = [statement for other, statement in others if other is structure]
        if statements:
            verdict = Verdict(structure, family=riemann.group(problem, structure))
            regions.append(Region(either(statements), verdict, omega=_SEMI_INVARIANTS[structure]))
    return _closed(problem, regions, Verdict(None), theory, generic)


_RATIONAL_OMEGA = "omega = theta + P'/P, theta from the exponents and the polynomial part of sqrt(S), P a polynomial"
_SEMI_INVARIANTS = {
    Structure.IMPRIMITIVE: "y1 y2 = sqrt of a rational function; omega of degree 2",
    Structure.TETRAHEDRAL: "a rational invariant of degree 6; omega of degree 4",
    Structure.OCTAHEDRAL: "a rational invariant of degree 8; omega of degree 6",
    Structure.ICOSAHEDRAL: "a rational invariant of degree 12; omega of degree 12",
    Structure.REDUCIBLE: _RATIONAL_OMEGA,
}


def _confluent(problem: Problem, form: confluent.Confluent, generic: Verdict, settings: Settings) -> Partition:
    kind = "Whittaker's equation" if form.q else "Bessel's equation"
    base = form.coordinate if form.coordinate.isidentifier() else f"({form.coordinate})"
    power = form.coordinate if form.n == 1 else f"{base}^{form.n}"
    theory = f"{kind} in {power}: Martinet & Ramis"
    functions = [*undefined(problem), *irreducible_factors(form.degenerate)]
    regions = _degenerate(problem, functions, settings)
    case, statements = confluent.solvable(form)
    verdict = Verdict(Structure.REDUCIBLE if case == 1 else Structure.IMPRIMITIVE, family=confluent.group(form))
    if statements is True:
        return _closed(problem, regions, verdict, theory, generic)
    assert isinstance(statements, list)
    if statements:
        regions.append(Region(either(statements), verdict, omega=confluent.omega(form)))
    return _closed(problem, regions, Verdict(None), theory, generic)


def _closed(problem: Problem, regions: list[Region], expected: Verdict, theory: str, generic: Verdict) -> Partition:
    """A partition by a theorem, which the engine's generic answer must confirm."""
    if generic.known and generic.case != expected.case:
        raise AssertionError(f"{theory}: case {expected.case} contradicts the generic answer, case {generic.case}")
    names = problem.field.names  # type: ignore[attr-defined]
    return Partition(problem.S, names, tuple(regions), expected, _together(regions), theory)


def _together(regions: list[Region]) -> bool | str:
    """True where everything is complete, else the first sentence that says what isn't."""
    return next((r.complete for r in regions if r.complete is not True), True)


def _by_candidates(problem: Problem, generic: Verdict, settings: Settings, max_degree: int) -> Partition:
    names: tuple[str, ...] = problem.field.names  # type: ignore[attr-defined]
    regions: list[Region] = []
    complete: bool | str = True
    theory = "polynomial conditions"
    reducible: list[Poly] = []
    try:
        regions = _degenerate(problem, union([undefined(problem), structure_changes(problem)]), settings)
        known = [r.statement.function for r in regions if isinstance(r.statement, Vanishes)]
        if has_constant_rational_exponents(problem):
            found = [form_conditions(problem, m) for m in degrees_that_decide(problem)]
            candidates = union([*(c.polynomials for c in found), _discriminants(problem, generic, settings)])
            if not all(c.complete for c in found):
                complete = "except for values that are special in two or more parameters at once"
            theory = "exponents that don't depend on the parameters: invariants of bounded degree"
            if generic.structure not in (None, Structure.REDUCIBLE, Structure.IMPRIMITIVE):
                complete = "not proven where the generic group is finite and primitive"
        else:
            findings = search(problem, max_degree)
            candidates, reducible = findings.candidates, findings.reducible
            theory = "candidates from the exponents"
            if generic.structure is not None and generic.structure is not Structure.REDUCIBLE:
                findings.unproven.append("smaller groups than the generic one")
            if findings.unproven:
                complete = f"up to degree {max_degree} (not proven: {'; '.join(findings.unproven)})"
        for function in candidates:
            if function not in known:
                settings.budget.check()
                if function in reducible and _height(function) > _WRITTEN_OUT:
                    verdict = Verdict(Structure.REDUCIBLE)
                    regions.append(Region(Vanishes(function), verdict, omega=_RATIONAL_OMEGA))  # type: ignore[arg-type]
                    continue
                regions += _regions_where_zero(problem, function, generic, settings)
    except LimitExceeded as limit:
        complete = f"only as far as the limits allowed: {limit}"
    if complete is True:
        complete = _together(regions)
    return Partition(problem.S, names, tuple(regions), generic, complete, theory)


def _height(function: Poly) -> int:
    """The largest degree in one parameter."""
    assert isinstance(function, FunctionPoly)
    return max(int(k) for k in function.num.degrees())


def _discriminants(problem: Problem, generic: Verdict, settings: Settings) -> list[Poly]:
    """Where the two solutions in a generic semi-invariant y1 y2 can coincide: where a constant, w^2, vanishes."""
    if generic.structure is not Structure.IMPRIMITIVE:
        return []
    decision = decide(problem.S, settings.budget)
    riccati = decision.riccati
    if riccati is None or riccati.P.field != problem.field:
        return []
    # The discriminant of W^2 - A1/(P D) W + A2/(P D^2) is w^2 / (y1 y2)^2 with a constant w^2.
    P, _, first, second = riccati.P, riccati.D, riccati.numerators[1], riccati.numerators[2]
    elements = [(first * first - 4 * P * second).lc, *denominators(P), *denominators(first), *denominators(second)]
    return union([irreducible_factors(element) for element in elements])


def _degenerate(problem: Problem, functions: list[Poly], settings: Settings) -> list[Region]:
    """Regions for the values at which the generic theory doesn't apply."""
    regions = []
    for function in functions:
        regions += _pieces(problem.S, function, settings)
    return regions


def _pieces(S: RatFunc, function: Poly, settings: Settings) -> list[Region]:
    """The regions that make up the zeros of a polynomial, in their order."""
    settings.budget.check()
    last = _inside(S, function, settings)
    return [*_missed(S, function, settings), last] if last.defined else [last]


def _missed(S: RatFunc, function: Poly, settings: Settings) -> list[Region]:
    """Regions for the zeros of a polynomial at which the parameter to be eliminated can have any value.

    There a second polynomial g vanishes, so that they are the zeros of the first one on g = 0, and those that are missed there.
    """
    assert isinstance(function, FunctionPoly)
    regions: list[Region] = []
    for other in missed(function):
        first, second = Vanishes(function), Vanishes(other)
        try:
            restriction = on_hypersurface(S, other)
        except UndefinedError:
            regions.append(Region(Both((first, second)), Verdict(None, known=False), defined=False))
            continue
        regions += [_also(deeper, first) for deeper in _missed(S, other, settings)]
        rest = function.value_at(list(restriction.values), restriction.field)
        if not isinstance(rest, FunctionPoly):
            regions.append(_also(_inside(S, other, settings), first))
            continue
        for factor in irreducible_factors(rest):
            regions += [_also(piece, first, second) for piece in _pieces(restriction.S, factor, settings)]
    return regions


def _also(region: Region, *conditions: Statement) -> Region:
    """The part of a region where more conditions hold."""
    own = region.statement.parts if isinstance(region.statement, Both) else (region.statement,)
    return replace(region, statement=Both((*conditions, *own)))


def _inside(S: RatFunc, function: Poly, settings: Settings) -> Region:
    """The region where a polynomial vanishes, with its own partition, except for the points that `missed` is about."""
    assert isinstance(function, FunctionPoly)
    statement = Vanishes(function)
    unknown = Verdict(None, known=False)
    try:
        restriction = on_hypersurface(S, function)
    except UndefinedError:
        return Region(statement, unknown, defined=False)
    inner = partition(restriction.S, settings)
    field = restriction.field
    if isinstance(field, AlgebraicField) and field.ground != QQ:
        return _on_algebraic(statement, restriction, inner, settings)
    elsewhere = {Vanishes(factor).text() for factor in leading_factors(function)}
    inner = replace(inner, regions=tuple(r for r in inner.regions if r.statement.text() not in elsewhere))
    omega, verdict = None, inner.generic
    if verdict.structure is not None:
        decision = decide(restriction.S, settings.budget)
        omega = omega_text(restriction.S, decision, settings.variable)
        if not inner.names and not decision.undecided:
            verdict = replace(verdict, family=str(group_of(restriction.S, decision)))
    whole = inner if inner.names else None
    return Region(statement, verdict, inner.complete, omega=omega, inner=whole, restriction=restriction)


def _on_algebraic(statement: Vanishes, restriction: Restriction, inner: Partition, settings: Settings) -> Region:
    """The region of a hypersurface that no parameter can be eliminated from: decided where all of it is in case 1."""
    if inner.complete is not True:
        unknown = replace(inner.generic, known=False)
        return Region(statement, unknown, f"except for special values with {statement.text()}", restriction=restriction)
    omega = _RATIONAL_OMEGA
    if _height(statement.function) <= _WRITTEN_OUT:
        decision = decide(restriction.S, settings.budget)
        omega = omega_text(restriction.S, decision, settings.variable) or omega
    return Region(statement, inner.generic, omega=omega, restriction=restriction)


def omega_text(S: RatFunc, decision: Decision, variable: str) -> str | None:
    """What a certified decision says about omega; None without a solution."""
    if decision.riccati is None or decision.structure is None:
        return None
    lines = omega_lines(Solution(S.to_str(variable), variable, S, decision))
    text = " ".join(line.strip() for line in lines if not line.startswith("y ="))
    return text if len(text) <= _LONGEST_OMEGA else _SEMI_INVARIANTS[decision.structure]


def _regions_where_zero(problem: Problem, function: Poly, generic: Verdict, settings: Settings) -> list[Region]:
    """The regions for a candidate; none if nothing changes there."""
    regions = _pieces(problem.S, function, settings)
    if all(_is_generic(region, generic) for region in regions):
        return []
    return [
        region
        if region.omega is not None or region.verdict.structure is None
        else replace(region, omega=_SEMI_INVARIANTS[region.verdict.structure])
        for region in regions
    ]


def _is_generic(region: Region, generic: Verdict) -> bool:
    same = region.verdict.known and region.verdict.case == generic.case and region.complete is True
    return same and (region.inner is None or not region.inner.regions)


__all__ = ["partition", "verdict_of"]
