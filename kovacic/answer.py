"""The frozen data of an answer: the input, the decision, and properties that can be read off from these.

Everything that has to be computed from an answer (its group, closed forms, ...) is a function in a room of its own, whose
result is kept by `computed_once`: views and other users of an answer depend on this data, and on nothing above it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import wraps
from typing import Any, Protocol, TypeVar

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Exclusion, RiccatiPolynomial, SemiInvariant, Status, TerminatingSeries
from kovacic.equation import Change, Equation
from kovacic.limits import DEFAULT_LIMITS, Limits

_Computed = TypeVar("_Computed")


class KnownParameters(Protocol):
    """The assumptions about the parameters as an answer uses them; `kovacic.parametric` has the class."""

    def __bool__(self) -> bool:
        """True if anything was assumed."""
        ...

    def symbols(self) -> dict[str, Any]:
        """The parameters as SymPy symbols with the assumptions, by their names."""
        ...


@dataclass(frozen=True, repr=False)
class Answer:
    """The frozen data of an answer for one equation y'' = S y; `Solution`, which adds the methods, describes each field."""

    text: str
    variable: str
    S: RatFunc
    decision: Decision
    notices: tuple[str, ...] = ()
    verified: bool = False
    seconds: float | None = field(default=None, compare=False)
    equation: Equation | None = None
    assumed: bool = False
    limits: Limits = field(default=DEFAULT_LIMITS, compare=False)
    known: KnownParameters | None = field(default=None, compare=False)
    #: Parameters of S that stand for constants, as SymPy expressions: e for Euler's number.
    letters: tuple[tuple[str, Any], ...] = field(default=(), compare=False)

    @property
    def gauge(self) -> RatFunc:
        """-b/(2a) for an equation a y'' + b y' + c y = f: its solutions are those of y'' = S y times exp(int gauge dx)."""
        return RatFunc(self.S.field.zero) if self.equation is None else self.equation.gauge

    @property
    def change(self) -> Change | None:
        """`variable` as a function of the user's variable, in which `solutions` are; None if they are the same."""
        return None if self.equation is None else self.equation.change

    @property
    def status(self) -> Status:
        """LIOUVILLIAN, NONE_EXISTS, or UNDECIDED, with the `reason`."""
        return self.decision.status

    @property
    def case(self) -> int | None:
        """Kovacic's case: 1 (omega rational), 2 (omega of degree 2), 3 (of degree 4, 6 or 12); None without a solution."""
        return self.decision.case

    @property
    def reason(self) -> str | None:
        """Why the equation is undecided; None if it is decided."""
        return self.decision.undecided

    @property
    def semi_invariant(self) -> SemiInvariant | None:
        """The product of the solutions whose logarithmic derivatives are the conjugates of omega."""
        return self.decision.semi_invariant

    @property
    def series(self) -> TerminatingSeries | None:
        """The solution exp(int theta) P by the recurrence for P, in place of the polynomial of omega, where P is too long."""
        return self.decision.series

    @property
    def riccati(self) -> RiccatiPolynomial | None:
        """The monic polynomial of omega = y'/y, minimal over C(x); its `coefficients` run from W^0 to W^n."""
        return self.decision.riccati

    @property
    def omega(self) -> RatFunc | None:
        """omega = y'/y if it is rational (case 1), else None.  The solution is exp(int omega dx)."""
        riccati = self.decision.riccati
        return -riccati.coefficients[0] if riccati is not None and riccati.degree == 1 else None

    @property
    def constants(self) -> Poly | None:
        """The minimal polynomial of the constant c in omega's coefficients; None if they lie in the field of S."""
        riccati, series = self.decision.riccati, self.decision.series
        extension = riccati.P.field if riccati is not None else series.theta.field if series is not None else None
        return extension.modulus if isinstance(extension, AlgebraicField) and extension != self.S.field else None

    @property
    def proof(self) -> tuple[Exclusion, ...]:
        """The exclusions with their evidence: of every structure, for a "no"; of all smaller ones, for a "yes"."""
        return self.decision.exclusions

    def __bool__(self) -> bool:
        raise TypeError("ask for .status or .case: an answer is neither true nor false")

    def __getstate__(self) -> dict[str, Any]:
        """The data alone: results computed from it may not pickle, and are computed again on demand."""
        return {f.name: self.__dict__[f.name] for f in fields(self)}


def computed_once(compute: Callable[[Any], _Computed]) -> Callable[[Any], _Computed]:
    """A decorator for functions of an answer: the result is kept with the answer.

    >>> @computed_once
    ... def squared(answer):
    ...     return answer.S * answer.S
    >>> import kovacic
    >>> answer = kovacic.solve("x")
    >>> was_computed(squared, answer), print(squared(answer)), was_computed(squared, answer)
    x**2
    (False, None, True)
    >>> squared(answer) is squared(answer)
    True
    """
    name = _key_of(compute)

    @wraps(compute)
    def found(answer: Answer) -> _Computed:
        kept = answer.__dict__
        if name not in kept:
            kept[name] = compute(answer)
        return kept[name]  # type: ignore[no-any-return]

    return found


def was_computed(function: Callable[[Any], Any], answer: Answer) -> bool:
    """True if this function of `computed_once` has been called for the answer."""
    return _key_of(function) in answer.__dict__


def _key_of(function: Callable[..., Any]) -> str:
    return f"{function.__module__}.{function.__qualname__}"
