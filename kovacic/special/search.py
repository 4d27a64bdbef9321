"""`special_functions`: two solutions in special functions as SymPy expressions, or which classes were searched in vain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import analyse
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.special import confluent, gauss
from kovacic.special.pullback import Pullback

_CONFLUENT = (
    "Airy's equation in f(x), f rational",
    "Whittaker's equation (with Kummer's, Weber's and Bessel's) in f(x), f rational",
    "Bessel's equation in the square root of f(x), f rational",
)
_GAUSS = ("Gauss' hypergeometric equation in f(x), f rational, all points singular over two of 0, 1 and infinity",)


@dataclass(frozen=True)
class SpecialFunctions:
    """y1 and y2, SymPy expressions, and the verified pull-back that they come from; all None where nothing was found.

    `searched` says which classes were gone through, `stopped` why a search ended early.  That nothing was found proves nothing:
    functions f outside of the classes, and combinations of u(f) and its derivative, aren't looked for.
    """

    pullback: Pullback | None
    searched: tuple[str, ...]
    stopped: str | None = None
    y1: Any = None
    y2: Any = None

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


def find(S: RatFunc, budget: Budget, *, extended: bool = True) -> SpecialFunctions:
    """The first pull-back of Airy's, Whittaker's, Bessel's or Gauss' equation that gives S, checked exactly; not yet written.

    Without `extended`, functions f over a larger field than that of S aren't sought.  An exhausted budget is a value: `stopped`
    is its sentence.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> found = find(x**4 + 2 * x, Budget()).pullback
    >>> print(found.equation.q, found.equation.r, found.equation.M, found.f)
    1 2/3 -2/9 -x**3/3
    """
    searched: tuple[str, ...] = ()
    try:
        with budget.watched():
            problem = analyse(S, budget)
            regular = not confluent.irregular_places(problem)
            searched = _GAUSS if regular else _CONFLUENT
            found = gauss.candidates(problem, extended=extended) if regular else confluent.candidates(problem)
            for pullback in found:
                budget.check()
                if pullback.gives(S):
                    return SpecialFunctions(pullback, searched)
    except LimitExceeded as limit:
        return SpecialFunctions(None, searched, str(limit))
    return SpecialFunctions(None, searched)


def special_functions(
    S: RatFunc,
    gauge: RatFunc,
    variable: str,
    budget: Budget,
    *,
    symbols: Mapping[str, Any] | None = None,
    joined: bool = False,
) -> SpecialFunctions:
    """Solutions of the equation that was given, those of y'' = S y times the gauge factor exp(int gauge dx).

    `symbols` are SymPy's symbols for the parameters by name; the expressions are in these, and what is assumed about them is
    used: with n a natural number, Hermite's equation has `hermite(n, x)`.  With `joined`, solutions are analytic at ordinary
    points where the argument of Bessel's functions is zero: series 0F1 instead of these.  The pull-back is verified exactly, in
    rational functions; what is shown is checked at a point, to 50 digits.  Liouvillian solutions aren't looked for, but where
    the group is reducible the two solutions may be dependent for some values of the parameters.

    >>> import kovacic
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - n^2)*y = 0")
    >>> print(special_functions(answer.S, answer.gauge, "x", Budget()))
    y1 = besselj(n, x)
    y2 = bessely(n, x)
    """
    search = find(S, budget)
    if search.pullback is None:
        return search
    from kovacic.special.express import solutions  # imports SymPy

    try:
        with budget.watched():
            found = solutions(search.pullback, S, gauge, variable, symbols or {}, joined=joined)
    except LimitExceeded as limit:
        return SpecialFunctions(None, search.searched, str(limit))
    if found is None:
        said = "the assumptions don't tell which solutions are independent"
        return SpecialFunctions(None, search.searched, said)
    return SpecialFunctions(search.pullback, search.searched, None, *found)
