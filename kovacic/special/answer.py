"""`special_functions`: two solutions in special functions as SymPy expressions, or which classes were searched in vain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.special.find import find
from kovacic.special.pullback import Pullback


@dataclass(frozen=True)
class SpecialFunctions:
    """y1 and y2, SymPy expressions, and the verified pull-back that they come from; all None where nothing was found.

    `searched` says which classes were gone through, `stopped` why a search ended early.  That nothing was found proves nothing.
    """

    y1: Any
    y2: Any
    pullback: Pullback | None
    searched: tuple[str, ...]
    stopped: str | None = None

    @property
    def solutions(self) -> tuple[Any, ...]:
        """(y1, y2), or () where nothing was found."""
        return () if self.pullback is None else (self.y1, self.y2)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.solutions)

    def __bool__(self) -> bool:
        return self.pullback is not None

    def __str__(self) -> str:
        if self.pullback is not None:
            return f"y1 = {self.y1}\ny2 = {self.y2}"
        if self.stopped:
            return f"no special function was found: {self.stopped}"
        return f"no special function was found; searched: {'; '.join(self.searched)}"


def special_functions(
    S: RatFunc, gauge: RatFunc, variable: str, budget: Budget, *, symbols: Mapping[str, Any] | None = None
) -> SpecialFunctions:
    """Solutions of the equation that was given, those of y'' = S y times the gauge factor exp(int gauge dx).

    `symbols` are SymPy's symbols for the parameters by name; the expressions are in these, and what is assumed about them is
    used: with n a natural number, Hermite's equation has `hermite(n, x)`.  The pull-back is verified exactly, in rational
    functions; what is shown is checked at a point, to 50 digits.  Liouvillian solutions aren't looked for, but
    where the group is reducible the two solutions may be dependent for some values of the parameters.

    >>> import kovacic
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - n^2)*y = 0")
    >>> print(special_functions(answer.S, answer.gauge, "x", Budget()))
    y1 = besselj(n, x)
    y2 = bessely(n, x)
    """
    search = find(S, budget)
    if search.pullback is None:
        return SpecialFunctions(None, None, None, search.searched, search.stopped)
    from kovacic.special.express import solutions  # imports SymPy

    try:
        with budget.watched():
            found = solutions(search, S, gauge, variable, symbols or {})
    except LimitExceeded as limit:
        return SpecialFunctions(None, None, None, search.searched, str(limit))
    if found is None:
        return SpecialFunctions(
            None, None, None, search.searched, "the assumptions don't tell which solutions are independent"
        )
    return SpecialFunctions(*found, search.pullback, search.searched)
