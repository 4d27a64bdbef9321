"""Regions that say nothing new, because every one of their points lies in an earlier region.

Two tests, both sufficient and exact: polynomials that vanish wherever those of a region do, and values of one parameter,
f(N) for integers N in given classes, that an earlier family g(M) takes as well, with an M that is linear in N.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import count

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.limits import check_time
from kovacic.parametric.answer import Condition
from kovacic.parametric.functions import irreducible_factors, over_parameters, powers_of
from kovacic.parametric.integers import Congruence
from kovacic.parametric.restriction import parametrised
from kovacic.parametric.spectra import families
from kovacic.parametric.statements import Statement, Vanishes, both

Chart = tuple[Field, Mapping[str, Poly]]


def without_empty(regions: Sequence[Condition]) -> list[Condition]:
    """The regions without those that earlier ones cover."""
    kept: list[Condition] = []
    curves: dict[tuple[FunctionPoly, ...], list[FunctionPoly]] = {}
    roots: list[Congruence] = []
    charts: dict[tuple[FunctionPoly, ...], Chart | None] = {}
    for region in regions:
        check_time()
        parts = both(region.statement).parts
        functions = tuple(part.function for part in parts if isinstance(part, Vanishes))
        try:
            if len(functions) > 1 and _is_covered(functions, curves, charts):
                continue
        except ZeroDivisionError:
            pass  # at the values that solve for one parameter another function isn't defined
        alternatives = _alternatives(region.statement)
        own = [part for part in alternatives if isinstance(part, Congruence) and part.form is None]
        if own and len(own) == len(alternatives) and all(any(_implies(a, b) for b in roots) for a in own):
            continue
        roots += own
        if len(functions) == len(parts):
            curves.setdefault(functions[:-1], []).append(functions[-1])
        kept.append(region)
    return kept


def _alternatives(statement: Statement) -> Sequence[Statement]:
    return getattr(statement, "parts", (statement,))


def _is_covered(
    functions: tuple[FunctionPoly, ...],
    curves: dict[tuple[FunctionPoly, ...], list[FunctionPoly]],
    charts: dict[tuple[FunctionPoly, ...], Chart | None],
) -> bool:
    """Does an earlier function vanish where these do?  The earlier ones are given by the functions that vanish beside them."""
    chart = _chart(functions, charts)
    earlier = (g for k in range(len(functions)) for g in curves.get(functions[:k], ()))
    return chart is not None and any(not _at(g, chart[1], chart[0]) for g in earlier)


def _chart(functions: tuple[FunctionPoly, ...], charts: dict[tuple[FunctionPoly, ...], Chart | None]) -> Chart | None:
    """A field, and values of the parameters in it at which the functions vanish; None where that isn't one piece."""
    if functions in charts:
        return charts[functions]
    charts[functions] = None
    if len(functions) > 1:
        before = _chart(functions[:-1], charts)
    else:
        field = functions[0].field
        before = field, {name: field.generator(name) for name in field.names}
    if before is not None and isinstance(before[0], FunctionField):
        factors = irreducible_factors(_at(functions[-1], before[1], before[0]))
        if len(factors) == 1:
            smaller, chosen = parametrised(factors[0])
            at = dict(zip(factors[0].field.names, chosen, strict=True))
            values = {name: _at(over_parameters(value), at, smaller) for name, value in before[1].items()}
            charts[functions] = smaller, values
    return charts[functions]


def _at(function: FunctionPoly, values: Mapping[str, Poly], field: Field) -> Poly:
    return function.value_at([values[name] for name in function.field.names], field)


def _implies(family: Congruence, other: Congruence) -> bool:
    """Does `other` hold wherever `family` does, which says that a parameter is f(N)?"""
    names, spectra = family.equation.field.names, families(family.equation)
    if not spectra or other.equation.field.names != names:
        return False
    k = next(name for name in map("k{}".format, count()) if name not in names)
    field = FunctionField((*names, k))
    known = {name: field.generator(name) for name in names}
    for residue in family.residues:
        check_time()
        N = field.generator(k) * family.modulus + residue
        above, below = (_at(over_parameters(part), known, field)(N) for part in (spectra[0][1].num, spectra[0][1].den))
        equation = _at(other.equation, {**known, spectra[0][0]: above / below}, field)
        if not any(f.degree == 1 and _is_in_classes(over_parameters(-f[0]), other) for f, _ in field.factor(equation)):
            return False
    return True


def _is_in_classes(M: FunctionPoly, other: Congruence) -> bool:
    """Is M, as a function of the last parameter, a linear one that takes integers in the classes to such integers?"""
    parts = powers_of(M, len(M.field.names) - 1)
    values = [M.field.rational_value(parts.get(k, 0 * M)) for k in (0, 1)]
    if not M.den.is_one() or set(parts) - {0, 1} or None in values:
        return False
    start, step = (int(v) for v in values if v is not None)
    return all((start + k * step) % other.modulus in other.residues for k in range(int(other.modulus)))
