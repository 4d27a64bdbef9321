"""Solutions as vectorised NumPy functions in double precision, in a numerically stable arrangement, with a measured error.

Which arrangement, by what the certificate says:

- case 1, omega = theta + P'/P: the product exp(int theta) P over the zeros of P, in x (`kovacic.doubles.product_form`);
  real where omega is real, for real or for complex arguments;
- case 2 on a rational curve s^2 = g, deg g <= 2: the same product in the parameter of the curve, since the integral in
  the exponent is elementary there (`kovacic.doubles.arrangement`); for an interval of the real axis;
- everything else on the real axis (case 2 on other curves, case 3, P of degree above 200): a table of proven Taylor
  expansions (`kovacic.doubles.tabulate`).

The error is measured, not proven: `kovacic.doubles.accuracy` compares with route (b) at 50 digits, and an AccuracyWarning
is given where it exceeds 8 units in the last place in the median, or 1,000 at worst.
"""

from __future__ import annotations

from kovacic.doubles.accuracy import warn_unless_accurate
from kovacic.doubles.arrangement import product_form
from kovacic.doubles.product_form import ProductForm
from kovacic.doubles.region import Region, region_of
from kovacic.doubles.tabulate import TabulatedFunction, tabulate
from kovacic.enclosure.ball import ball_from_flint
from kovacic.enclosure.certificate import finite_base, omega
from kovacic.enclosure.points import Point
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.errors import InputError
from kovacic.solution import Solution

_PREC = 240
_SLOPE_BITS = 4000
"""Precision of the initial slope of a table: a recessive solution is contaminated by its error times the growth."""


def lambdify(
    solution: object, *, interval: tuple[object, object], which: int = 0, check: bool = True
) -> ProductForm | TabulatedFunction:
    """The solution with the logarithmic derivative number `which`, as a NumPy function on an interval without singular points.

    `interval` is a pair of real numbers; or two opposite corners of a rectangle of the complex plane, for complex
    arguments (case 1 only).  The ends of a product form may be singular points.  In case 1 `which` numbers the conjugates of
    omega, or the two rational ones; in cases 2 and 3 the roots of the polynomial of omega near the middle of the interval,
    by real and then imaginary part.  The constant factor is that of `kovacic.doubles.product_form`; y = 1 near the middle
    for tables.  Real solutions give doubles, others complex doubles.

    With `check` the error is measured at 24 points, and an AccuracyWarning is given above 8 units in the last place
    (median) or 1,000 (worst), or where route (b) needs more than 20 s.

    Raises InputError without a Liouvillian solution (`tabulate` treats every S), for an interval that is empty or has a
    singular point inside, for complex arguments in cases 2 and 3, and for a table up to a singular point.

    >>> import kovacic
    >>> f = lambdify(kovacic.solve("x^2 + 3"), interval=(0, 2))   # x exp(x^2/2)
    >>> print(f"{f(1.0):.15f}")
    1.648721270700128
    """
    from flint import ctx

    problem = as_problem(solution)
    if not isinstance(problem.source, Solution) or problem.source.semi_invariant is None:
        raise InputError(
            "lambdify needs a Liouvillian solution, found by kovacic.solve",
            hint="kovacic.doubles.tabulate.tabulate treats every S, by initial values",
        )
    region, candidates = region_of(problem, interval)
    base = finite_base(problem, which, candidates)
    with ctx.workprec(_PREC):
        found: ProductForm | TabulatedFunction | None = product_form(problem, which, region, base)
    if found is None:
        found = _table(problem, which, region, base)
    if check:
        warn_unless_accurate(found, problem, which)
    return found


def _table(problem: NumericProblem, which: int, region: Region, base: Point) -> TabulatedFunction:
    if not region.is_real:
        raise InputError("complex arguments need a solution of case 1", hint="evaluate treats every complex point")
    slope = ball_from_flint(omega(problem, which, base, _SLOPE_BITS))
    return tabulate(problem, region.low.real, region.high.real, x0=base, y0=1, dy0=slope)
