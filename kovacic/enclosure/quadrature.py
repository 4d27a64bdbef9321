"""Rigorous integrals along straight segments that can be stopped."""

from __future__ import annotations

from collections.abc import Callable

from flint import acb, ctx

from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, check_duration

_NODES = 3e-11
"""Seconds that the nodes of a quadrature take, over bits^2.7 (measured): they are computed in one piece."""


def integral(function: Callable[[acb, bool], acb], a: acb, b: acb, budget: Budget) -> acb:
    """int_a^b, by flint's rigorous adaptive quadrature; a non-finite ball where it gave up.

    Raises LimitExceeded when the budget is used up.  An exception can't cross flint's C code (python-flint 0.9.0 turns it
    into a SystemError), so the integrand answers 0 once it was stopped or interrupted, which ends the quadrature at once, and
    the exception comes after.
    """
    stopped: BaseException | None = None

    def guarded(z: acb, analytic: bool) -> acb:
        nonlocal stopped
        if stopped is None:
            try:
                budget.check()
                return function(z, analytic)
            except (LimitExceeded, KeyboardInterrupt) as reason:
                stopped = reason
        return acb(0)

    check_duration(_NODES * ctx.prec**2.7, f"a quadrature with {ctx.prec} bits")
    try:
        result: acb = acb.integral(guarded, a, b)
    except SystemError as error:  # the interrupt came between two calls of the integrand
        raise error.__cause__ or error from None
    if stopped is not None:
        raise stopped
    return result
