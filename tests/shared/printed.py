"""Evaluates what `conditions` prints, as it is printed, at exact points on and off the strata."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice, product
from random import Random
from typing import Any

import sympy
from build import QQ, AlgebraicField, Conditions
from parametric_formulas import text_differs

from kovacic.decision import Status
from kovacic.engine.decide import decide
from kovacic.limits import Budget
from kovacic.parametric.api import Sampler
from kovacic.parametric.claims import ParameterPoint
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.regions import Case, RegionVerdict, solvable_cases

_SMALL = (0, 1, -1, 2, Fraction(1, 2), -2, 3)


def points(answer: ParametricAnswer, number: int, seed: int = 3) -> Iterator[ParameterPoint]:
    """Admissible points: half of a small lattice, on which parameters vanish or are equal, half in the regions."""
    random = Random(seed)
    names = answer.parameters
    coordinates = _SMALL if len(names) > 1 else [Fraction(k, 4) for k in range(-12, 13)]
    lattice = [*islice(product(coordinates, repeat=len(names)), 2401)]
    random.shuffle(lattice)
    sampler = Sampler(answer.constant, names, answer.assumptions, random)
    in_regions = sampler.points([region.statement for region in answer.regions])
    field = answer.constant.field
    for values in lattice[: number // 2]:
        numbers = tuple(QQ.poly([value]).over(field) for value in values)
        point = ParameterPoint((*answer.constant.names, *names), (*answer.constant.values, *numbers), field)
        if answer.assumptions.admits(zip(names, numbers, strict=True)):
            yield point
    found = (point for point in islice(in_regions, 6 * number) if point is not None)
    yield from islice(found, number - number // 2)


def is_defined(answer: ParametricAnswer, point: ParameterPoint) -> bool:
    """True if S is defined at the point."""
    try:
        point.restricted(answer.S)
    except ZeroDivisionError:
        return False
    return True


def printed_verdict(answer: ParametricAnswer, point: ParameterPoint) -> RegionVerdict | None:
    """What the list says at a point, read from the top; None where S isn't defined, or is said not to be."""
    if not is_defined(answer, point):
        return None
    for region in answer.regions:
        if region.statement.claim.holds(point):
            return region.verdict if region.defined else None
    return answer.generic


def verdict_of_theorem(answer: ParametricAnswer, cases: list[Case], point: ParameterPoint) -> RegionVerdict:
    """What the theorem says at a point: the first case whose sentence is true there, and none of its exceptions."""
    for case in cases:
        if case.statement.claim.holds(point) and not any(other.claim.holds(point) for other in case.without):
            return case.regions[0].verdict
    return answer.generic


def wrongly_printed(answer: Conditions, number: int, seed: int = 3, texts: int | None = None) -> tuple[int, list[str]]:
    """How many points were tried, and what is printed falsely: by the tree, by its text, or against the engine.

    `texts` bounds the points at which the text is read, which takes longer than the rest.
    """
    tried, wrong = 0, list[str]()
    cases = solvable_cases(answer.regions)
    for point in points(answer, number, seed):
        verdict = printed_verdict(answer, point)
        if verdict is None:
            wrong += [f"S is defined at {point}"] * is_defined(answer, point)
            continue
        tried += 1
        for region in answer.regions:
            holds = region.statement.holds(point)
            if region.statement.claim.holds(point) is not holds:
                wrong.append(f"{region.statement} at {point}: {holds} is meant")
            if texts is None or tried <= texts:
                wrong += texts_that_differ(region.statement, point)
            if holds:
                break
        if not verdict.known or answer.complete is not True:
            continue
        said = verdict_of_theorem(answer, cases, point)
        if said.case != verdict.case:
            wrong.append(f"the theorem says case {said.case}, the list case {verdict.case} at {point}")
        decision = decide(point.restricted(answer.S), Budget(answer.limits), certify=False)
        if decision.status is not Status.UNDECIDED and decision.case != verdict.case:
            wrong.append(f"case {verdict.case} is printed, {decision.case} is true at {point}")
    return tried, wrong


def texts_that_differ(statement: Any, point: ParameterPoint) -> list[str]:
    """The parts whose text says another thing at a rational point than they mean."""
    if isinstance(point.field, AlgebraicField):
        return []
    x = sympy.Symbol("x")
    values = {name: value.to_sympy(x) for name, value in zip(point.names, point.values, strict=True)}
    return [f"{part.text()} at {point}" for part in statement.conjuncts if text_differs(part, point, values)]
