"""Carrying a state (y, y') along a path with many targets, by transition matrices of its straight legs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kovacic.enclosure.ball import Ball, ball_to_flint
from kovacic.enclosure.points import Point, as_point, to_acb
from kovacic.enclosure.transport import apply, identity, multiply
from kovacic.errors import InputError

if TYPE_CHECKING:
    from flint import acb

    from kovacic.enclosure.taylor import Matrix

Start = tuple[Point | Ball, Point | Ball]
"""y(x0) and y'(x0)."""


@dataclass(frozen=True)
class Itinerary:
    """Where to go: the polygon `trunk` from x0, then from its end a straight line to each target, or (`chain`) from
    target to target."""

    trunk: tuple[Point, ...]
    targets: tuple[Point, ...]
    chain: bool


def make_itinerary(points: Sequence[object], x0: object, path: Sequence[object] | str | None) -> Itinerary:
    """The exact polygon and targets that the arguments x, x0 and path of `evaluate` stand for."""
    targets = tuple(as_point(p, "x") for p in points)
    origin = as_point(x0, "x0")
    if path is None:
        return Itinerary((origin,), targets, False)
    if isinstance(path, str):
        if path != "chain":
            raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", or None')
        return Itinerary((origin,), targets, True)
    return Itinerary((origin, *(as_point(p, "a vertex of the path") for p in path)), targets, False)


def initial_value(value: object, name: str) -> Point | Ball:
    """The exact number, or the ball, that the argument `name` of `evaluate` stands for."""
    if isinstance(value, Ball) and not value.is_exact():
        return value
    return as_point(value, name)


def initial_ball(value: Point | Ball) -> acb:
    """The flint ball of an initial value at the working precision in force."""
    return ball_to_flint(value) if isinstance(value, Ball) else to_acb(value)


class Prefix:
    """Products M_k ... M_1 while k grows: a binary counter of partial products, so that every prefix is O(log k)
    factors."""

    def __init__(self) -> None:
        self._parts: list[tuple[int, Matrix]] = []  # sizes are falling powers of two, the earliest factors first

    def push(self, matrix: Matrix) -> None:
        """Put one more factor on the left."""
        size = 1
        while self._parts and self._parts[-1][0] == size:
            _, earlier = self._parts.pop()
            matrix, size = multiply(matrix, earlier), 2 * size
        self._parts.append((size, matrix))

    def copy(self) -> Prefix:
        """An independent copy."""
        other = Prefix()
        other._parts = list(self._parts)
        return other

    def apply(self, state: tuple[acb, acb]) -> tuple[acb, acb]:
        """M_k ... M_1 v."""
        for _, matrix in self._parts:
            state = apply(matrix, state)
        return state

    def product(self) -> Matrix:
        """M_k ... M_1."""
        total: Matrix | None = None
        for _, matrix in self._parts:
            total = matrix if total is None else multiply(matrix, total)
        return total if total is not None else identity()


def carry(legs: Callable[[Point, Point], list[Matrix]], plan: Itinerary, start: Start) -> list[tuple[acb, acb]]:
    """The states at the targets, from the transition matrices that `legs` gives for straight pieces."""
    state = (initial_ball(start[0]), initial_ball(start[1]))
    trunk = Prefix()
    for a, b in zip(plan.trunk, plan.trunk[1:], strict=False):
        for matrix in legs(a, b):
            trunk.push(matrix)
    result: dict[int, tuple[acb, acb]] = {}
    for order in _branches(plan):
        stack, here = trunk.copy(), plan.trunk[-1]
        for index in order:
            target = plan.targets[index]
            for matrix in legs(here, target):
                stack.push(matrix)
            here = target
            result[index] = stack.apply(state)
    return [result[index] for index in range(len(plan.targets))]


def _branches(plan: Itinerary) -> list[list[int]]:
    """The targets in the order of visit: chains that start at the end of the trunk.

    Straight lines to points on one ray from there share their way: on the real axis two chains (right and left).
    """
    indices = list(range(len(plan.targets)))
    if plan.chain:
        return [indices]
    origin = plan.trunk[-1]
    if not origin.is_real():
        return [[i] for i in indices]
    real = [i for i in indices if plan.targets[i].is_real()]
    right = sorted((i for i in real if plan.targets[i].re >= origin.re), key=lambda i: plan.targets[i].re)
    left = sorted((i for i in real if plan.targets[i].re < origin.re), key=lambda i: -plan.targets[i].re)
    chains = [right, left, *([i] for i in indices if not plan.targets[i].is_real())]
    return [chain for chain in chains if chain]
