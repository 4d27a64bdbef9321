"""`kovacic.conditions`: for which values of the parameters is the equation solvable, with the solution at each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from kovacic.limits import DEFAULT_LIMITS, Limits, limits_of
from kovacic.parametric import answer
from kovacic.parametric.api import DEFAULT_DEGREE, find_conditions
from kovacic.solution import Solution


class Conditions(answer.Conditions):
    __doc__ = answer.Conditions.__doc__

    @classmethod
    def of(cls, found: answer.Conditions) -> Conditions:
        """The same conditions, with `solve_at`."""
        return cls(**{field.name: getattr(found, field.name) for field in fields(found)})

    def solve_at(self, values: Mapping[Any, Any]) -> Solution:
        """The verified answer at a point: the omega that the region makes possible."""
        return Solution.of(self.answer_at(values))


def conditions(
    S: Any,
    *,
    var: Any = None,
    assume: Mapping[Any, Any] | None = None,
    max_degree: int = DEFAULT_DEGREE,
    limits: Limits = DEFAULT_LIMITS,
) -> Conditions:
    """The exact values of the parameters for which y'' = S(x) y has Liouvillian solutions.

    Every symbol besides the variable is a parameter.  `assume={"n": "positive integer"}` leaves out what then can't happen;
    its words are integer, even, odd, half-integer, rational, irrational, noninteger, nonzero, positive, negative, nonnegative,
    nonpositive, and inequalities such as ">=1/2", for a real number; a number, {"n": 3}, is put in for the parameter.
    Assumptions of SymPy symbols are used in the same way.  Where a condition has a natural number d in it, its determinants
    are shown up to d = `max_degree`; `determinant` computes others.  A budget that is used up (`limits.seconds`, 30 s where
    there is none) gives a partial list, and `complete` says that as well.

    Raises `InputError` for what isn't a rational function with parameters, and `LimitExceeded` for an input above the limits.

    >>> import kovacic
    >>> print(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1"))
    y'' = ((-4*x^2 + 4*n^2 - 1)/(4*x^2)) y, parameters n
      n - 1/2 in Z: case 1
      otherwise: no Liouvillian solution
      (proven to be complete; Whittaker's equation in x: Martinet & Ramis)

    References: T. Kimura, Funkcial. Ekvac. 12 (1969); J. Martinet & J.-P. Ramis (1989); A. Duval & M. Loday-Richaud,
    AAECC 3 (1992).
    """
    limits = limits_of(limits)
    return Conditions.of(find_conditions(S, var=var, assume=assume, max_degree=max_degree, limits=limits))
