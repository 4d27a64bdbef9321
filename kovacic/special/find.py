"""`find`: which standard equation S is a pull-back of, verified by the exact identity before it is returned."""

from __future__ import annotations

from dataclasses import dataclass

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
class Search:
    """A verified pull-back, or None; `searched` says which classes were gone through, and `stopped` why a search ended early.

    That nothing was found proves nothing: functions f outside of the classes, and combinations of u(f) and its derivative,
    aren't looked for.
    """

    pullback: Pullback | None
    searched: tuple[str, ...]
    stopped: str | None = None


def find(S: RatFunc, budget: Budget) -> Search:
    """The first pull-back of Airy's, Whittaker's, Bessel's or Gauss' equation that gives S, checked exactly.

    An exhausted budget is a value: `stopped` is its sentence.

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
            for pullback in gauss.candidates(problem) if regular else confluent.candidates(problem):
                budget.check()
                if pullback.gives(S):
                    return Search(pullback, searched)
    except LimitExceeded as limit:
        return Search(None, searched, str(limit))
    return Search(None, searched)
