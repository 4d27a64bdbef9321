"""Taylor discs along the straight ways of y'' = S y.

The guarantee: the matrices of a walk are balls that contain the exact analytic continuation along the straight line.

Each disc is free of singular points, so the matrix from where it is entered to where it is left is E(leave) E(enter)^-1 with
the expansion E at its centre; the inverse is the adjugate, since det = 1 exactly.

The matrices E come from one expansion, summed term by term (`kovacic.enclosure.taylor`), or at thousands of digits from
binary splitting (`kovacic.enclosure.splitting`).

The scale of a disc is half the distance from the centre to the nearest singular point (the terms then fall like 2^-n), or less
where the solutions grow by more than a fixed share of the working precision.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from functools import partial

from kovacic.enclosure.frame import Frame, System, fitting, largest_exponent
from kovacic.enclosure.matrices import NOTHING, Affine, State, adjugate, matrix_product, multiply
from kovacic.enclosure.points import ExactPoint, binary_exponent
from kovacic.enclosure.splitting import legs
from kovacic.enclosure.taylor import expand
from kovacic.enclosure.way import Followed, Step, cover, disc_step
from kovacic.limits import count_work

_LOG = logging.getLogger(__name__)


def growth_of_disc(prec: int, *, alone: bool) -> float:
    """The bits by which the solutions may grow from the centre of a disc to its ends.

    They are fewer where the disc is kept: polynomials are shorter at its targets, and a value that is smaller than the others
    in the disc by more than the spare bits of the precision would need a second run.
    """
    return max(100.0, 0.2 * prec) if alone else max(30.0, 0.05 * prec)


def frames(
    system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True
) -> Iterator[tuple[ExactPoint, Frame, ExactPoint]]:
    """The discs that cover the straight way from a to b, with their ends: O(log(far/near)) of them for each singular point at
    a distance between near and far.  `alone` if only the state at the end is needed."""
    if a == b:
        return
    growth = growth_of_disc(prec, alone=alone)
    steepest = largest_exponent(system, a)
    e = binary_exponent((b - a).norm_squared()) if steepest is None else steepest
    # Scales are powers of two: 5/8 of the distance to a singular point allows one half.
    yield from cover(a, b, e, lambda centre, e, _: fitting(system, centre, e, 0.625, growth))


def walk(
    system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True, split: bool = False
) -> Iterator[tuple[ExactPoint, Frame, Step]]:
    """The discs of `frames` with the steps in them, `split` for matrices from binary splitting, which serve no targets."""
    _LOG.debug("from %s to %s, %d bits%s", a, b, prec, ", by binary splitting" if split else "")
    for number, (enter, frame, leave) in enumerate(frames(system, a, b, prec, alone=alone), 1):
        _LOG.debug("disc %d: centre %s, radius 2^%d", number, frame.centre, frame.e)
        count_work(prec)
        if split:
            step = Step(leave, partial(_split, system, frame, enter, leave, prec), _serves_none)
        else:
            step = disc_step(enter, leave, expand(frame, prec))
        yield enter, frame, step


def _split(system: System, frame: Frame, enter: ExactPoint, leave: ExactPoint, prec: int) -> Affine:
    start, stop = map(matrix_product, legs(system, frame, enter, leave, prec))
    return multiply(stop, adjugate(start)), NOTHING


def _serves_none(state: State) -> Followed:
    raise NotImplementedError("by splitting no targets are served but the end")
