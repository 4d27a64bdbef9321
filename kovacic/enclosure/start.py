"""Where a solution is given: by y and y', by coordinates in a Frobenius basis, or as the one that decays.

The decaying, or recessive, solution becomes smaller than all others as x goes to infinity along the positive real axis.
Where S > 0 on [X, infinity), positive solutions are convex, and one of them is falling.  It is alone, up to a factor: the
derivatives of two of them would tend to 0, and with these their constant Wronskian.  So its state at X is a positive multiple
of (s, -(1 - s)) with 0 < s < 1.  With the transition matrix M, det M = 1, from X to x0, m = M (1, 0) and n = M (0, -1)

    y'/y at x0 = n'/n + s/(n (n + s (m - n))),                                                                          (1)

where both m and n are of the size of the other solutions' growth g: the ball has some 2 log2(g) bits, and X is chosen for
the bits that are wanted.  Nothing is known of the solution at X but its signs, and nothing else is needed.

Reference: P. Hartman, "Ordinary Differential Equations" (1964), XI.6 (principal solutions).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from flint import acb, arb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import System, foreseen_growth, frequency
from kovacic.enclosure.matrices import MapProduct, State
from kovacic.enclosure.points import ExactPoint, Number, as_number, middle, to_ball
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.request import Start
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.way import Way
from kovacic.errors import InputError, LimitExceeded
from kovacic.numbers.numerals import plain_text

_START_HINT = "y0=... and dy0=..., or frobenius=(c1, c2), or which='regular'"
_SHELL_STARTS = "--y0 and --dy0, or --frobenius C1,C2, or --regular"


@dataclass(frozen=True)
class ReadStart:
    """A `Start` whose numbers were read: `data` are y and y' at `place`, or its coordinates in the Frobenius basis there;
    only the first one counts where `decaying`."""

    place: Number | Singular
    data: tuple[Number, Number]
    decaying: bool = False

    def state(self, way: Way) -> State:
        """The numbers at the working precision in force, y' of the decaying solution among them."""
        y, dy = map(to_ball, self.data)
        if isinstance(self.place, Singular):
            return y, dy
        if self.decaying:
            dy = y * way.decay_rate(middle(self.place))
        return way.spread(self.place, (y, dy))


def read_start(problem: NumericProblem | None, given: Start) -> ReadStart:
    """The solution that is given, its numbers read; without a `problem` for coefficients that are functions of x."""
    which = given.which
    if which not in (None, "regular", "decaying"):
        raise InputError(f"which = {which!r} isn't known", hint="which='regular' or which='decaying'")
    has_values = given.y0 is not None or given.dy0 is not None
    has_coordinates = given.frobenius is not None
    if which is not None or has_coordinates:
        if problem is None:
            reason = "whose coefficients are functions of x"
        elif problem.right is not None:
            reason = "with a right-hand side"
        else:
            reason = "" if problem.is_rational else "whose constants aren't rational"
        if reason:
            raise InputError(f"an equation {reason} needs y0 and dy0 at a regular point")
    is_decaying = which == "decaying"
    if is_decaying and (given.dy0 is not None or has_coordinates):
        raise InputError("the decaying solution is given by y0 alone")
    # One of the three kinds, and only one.
    if not is_decaying and [has_values, has_coordinates, which == "regular"].count(True) != 1:
        raise InputError("one start is expected", hint=_START_HINT, shell=_SHELL_STARTS)
    if given.x0 is None:
        raise InputError("the point at which the solution starts is missing", hint="x0=0, for instance", shell="--x0 0")
    # The decaying solution is 1 at x0 by default; its slope, 0 here, is computed later.
    y0, dy0 = (1 if given.y0 is None else given.y0, 0) if is_decaying else (given.y0, given.dy0)
    if is_decaying or has_values:
        if y0 is None or dy0 is None:
            raise InputError("both y0 and dy0 are needed", hint=_START_HINT, shell=_SHELL_STARTS)
        data = as_number(y0, "y0"), as_number(dy0, "dy0")
        return ReadStart(as_number(given.x0, "x0"), data, decaying=is_decaying)
    assert problem is not None
    singular = singular_place(problem, given.x0, "x0")
    return ReadStart(singular, _frobenius_coordinates(singular, given.frobenius))


def _frobenius_coordinates(place: Singular, frobenius: Sequence[object] | None) -> tuple[Number, Number]:
    """The given ones; without, those of the regular solution.  Raises `InputError` where there is none."""
    if frobenius is None:
        frobenius = (0, 1)
        with working_precision(256):
            # Smaller than all others: with the larger exponent, or without the logarithm where they are equal.
            lower, upper = (acb(v).real for v in place.exponents())
        if place.difference is None and not lower < upper:
            said = f"no solution is smaller than all others at {place}"
            raise InputError(said, hint="give frobenius=(c1, c2)", shell="give --frobenius C1,C2")
    if isinstance(frobenius, str) or len(frobenius) != 2:
        raise InputError(
            "frobenius needs two coordinates",
            hint="frobenius=(c1, c2), the dominant solution first",
            shell="--frobenius C1,C2, the dominant solution first",
        )
    first, second = (as_number(value, "a coordinate") for value in frobenius)
    return first, second


def singular_place(problem: NumericProblem, x0: object, name: str) -> Singular:
    """The regular singular point, ordinary point or infinity ("oo") that the argument stands for."""
    # Infinity is a word: no number of any kind stands for it.
    if plain_text(x0) in ("oo", "inf", "+inf"):
        return Singular.at(problem, None)
    number = as_number(x0, name)
    with working_precision(256):
        return Singular.at(problem, number if isinstance(number, ExactPoint) else number.value())


def recessive_rate(way: Way, system: System, x0: ExactPoint, prec: int) -> acb:
    """A ball that contains y'/y at x0 of the recessive solution of the system, whose `way` this is, by equation (1).

    Raises InputError where no solution of y'' = S y decays in this way: S must be positive for large x, and grow or fall
    more slowly than 1/x^2.
    """
    # S ~ c x^d for large x: c > 0, and d >= -1.
    is_positive = bool(system.num) and system.num[-1] * system.den[-1] > 0
    if not is_positive or len(system.num) - len(system.den) < -1:
        raise InputError(
            "no solution decays for large x: S must be positive there, and x^2 S unbounded",
            hint="for a regular singular point at infinity: x0='oo', which='regular'",
            shell="for a regular singular point at infinity: --x0 oo --regular",
        )
    zeros = [*system.roots("num", 64), *system.roots("den", 64)]
    rightmost = max((float(root.real.upper()) for root, _ in zeros), default=0.0)
    if math.isinf(rightmost):
        raise LimitExceeded("S has zeros or poles beyond 1e308", limit="unknown_degree")
    beyond = ExactPoint(max(math.ceil(rightmost) + 1, math.ceil(x0.re)))
    step = 2
    # The ball has about exp(-2 growth): a growth of prec log(2)/2 leaves prec bits.
    while foreseen_growth(frequency(system), beyond, beyond + ExactPoint(step)) < prec * math.log(2) / 2:
        step = 2 * step
    far = beyond + ExactPoint(step)
    matrix = way.carried(far, x0, MapProduct()).whole()[0]
    # m = M (1, 0) and n = M (0, -1) have the values M_11 and -M_12, and n' is -M_22.
    m = matrix[0]
    n = -matrix[1]
    dn = -matrix[3]
    s = acb(arb(0.5, 0.5))  # all that is known of it: 0 < s < 1
    return dn / n + s / (n * (n + s * (m - n)))
