"""Limits of a call: sizes, checked before an operation, and a wall clock, checked between steps."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, fields, replace
from functools import wraps
from math import inf, isinf
from typing import Any, ParamSpec, TypeVar

from kovacic.errors import InputError, LimitExceeded
from kovacic.numbers.exact import exact_real, whole
from kovacic.numbers.numerals import in_a_message, plain_text


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Bounds on the input and on the work; every one is adjustable.

    Exceeding a bound on the input raises `LimitExceeded`; exceeding one on the work gives the status UNDECIDED.

    Parameters
    ----------
    text_length : int
        Input: characters of an expression; 1,000,000 by default.
    digits : int
        Input: decimal digits of one number; 100,000.
    exponent : int
        Input: the absolute value of an exponent; 100,000.
    degree : int
        Input: the predicted degree of a numerator or denominator; 20,000.
    bits : int
        Input: the predicted size of a coefficient in bits; 4,000,000.
    terms : int
        Input: the predicted number of terms of a polynomial in the variable and the parameters; 20,000.
    constants : int
        Input: the degree of the field of algebraic constants over Q; 24.
    parameters : int
        Input: the number of symbols other than the variable; 8.
    unknown_degree : int
        Work: the degree bound of a polynomial to be found; 20,000.
    seconds : float or None
        Work: wall-clock time for one equation, checked between steps of algebra and so not a hard bound.  None, the default,
        stands for ten minutes, so that nothing runs without end; math.inf for no limit.

    Raises
    ------
    InputError
        For a bound that isn't a natural number, or a time that is negative.

    Examples
    --------
    >>> import kovacic
    >>> kovacic.solve("x^9 + 1", limits=Limits(degree=5))
    Traceback (most recent call last):
    ...
    kovacic.errors.LimitExceeded: x^9 at position 0 would have a degree of up to 9, above the limit of 5
    >>> print(kovacic.solve("x^4 + x^2 + 202*x + 1/4", limits=Limits(unknown_degree=5)).reason)
    the polynomial part of a solution may have degree 100, above the limit of 5
    """

    text_length: int = 1_000_000
    digits: int = 100_000
    exponent: int = 100_000
    degree: int = 20_000
    bits: int = 4_000_000
    terms: int = 20_000
    constants: int = 24
    parameters: int = 8
    unknown_degree: int = 20_000
    seconds: float | None = None

    def __post_init__(self) -> None:
        for field in fields(self):
            given = getattr(self, field.name)
            if field.name == "seconds":
                given = seconds_of(given, "the limit seconds")
            elif type(given) is not int or given < 0:
                given = whole(given, f"the limit {field.name}")
            object.__setattr__(self, field.name, given)


def seconds_of(given: Any, name: str) -> float | None:
    """A time as a float, infinity included, or None.  Raises `InputError` for anything else."""
    if given is None:
        return None
    exact = given if isinstance(given, float) and isinf(given) else exact_real(given, name)
    if exact < 0:
        raise InputError(f"{name} = {plain_text(given)[:60]}: a time isn't negative")
    return float(exact) if exact < 10**300 else inf


DEFAULT_LIMITS = Limits()


def demand(limits: Limits, name: str, value: int, what: str) -> None:
    """Raise `LimitExceeded` if a value is above the limit of this name; `what` describes it, with {} for the value."""
    most = getattr(limits, name)
    if value > most:
        raise LimitExceeded(f"{what.format(in_a_message(value))}, above the limit of {most}", limit=name)


def limits_of(given: Any) -> Limits:
    """The limits of a call, the default ones for None.  Raises `InputError` for anything else."""
    if given is None:
        return DEFAULT_LIMITS
    if not isinstance(given, Limits):
        hint = "limits=kovacic.Limits(seconds=1), for instance"
        raise InputError(f"limits are a kovacic.Limits, not {type(given).__name__!r}", hint=hint)
    return given


#: Seconds for one equation where the limits don't say.
DEFAULT_SECONDS = 600.0

#: Subexpressions up to which SymPy is asked to rewrite an expression: it factors a random sum of 400 in 0.1 s, mostly.
MOST_SUBEXPRESSIONS = 400

#: Candidates (combinations of exponents, primes, special values) up to which a search tries each one.
MOST_TRIALS = 400

#: Characters of a formula up to which it is printed in full where a shorter description could replace it: half a screen.
MOST_CHARACTERS = 1000


class Clock:
    """The clock that every limit reads, in seconds: `now` is the wall clock, unless a test replaces it."""

    def __init__(self) -> None:
        self.now: Callable[[], float] = time.monotonic


#: The only clock of the package on which a result can depend.
CLOCK = Clock()


class Budget:
    """The running clock of one call: `check()` between the steps, raises `LimitExceeded` once the time is over.

    One that is made while another one is `watched` ends with that at the latest: the parts of a call share its time.
    """

    __slots__ = ("_deadline", "limits", "seconds")

    def __init__(self, limits: Limits = DEFAULT_LIMITS) -> None:
        self.limits = limits
        #: The time limit, which is that of an outer budget if this one ends with it.
        self.seconds = DEFAULT_SECONDS if limits.seconds is None else limits.seconds
        self._deadline = CLOCK.now() + self.seconds
        outer = _WATCHED.get()
        if outer is not None and outer._deadline < self._deadline:
            self.seconds = outer.seconds
            self._deadline = outer._deadline

    def check(self) -> None:
        if CLOCK.now() > self._deadline:
            raise self.exceeded()

    def exceeded(self, reason: str = "") -> LimitExceeded:
        """The error of every time limit; the reason is what would take longer than the rest of the time."""
        return LimitExceeded(
            f"the time limit of {self.seconds:g} s is exceeded{reason and f': {reason}'}", limit="seconds"
        )

    @property
    def seconds_left(self) -> float:
        """Seconds until `check` raises."""
        return max(0.0, self._deadline - CLOCK.now())

    def share(self, part: float) -> Budget:
        """A budget for a fraction of the remaining time."""
        return Budget(replace(self.limits, seconds=part * self.seconds_left))

    @contextmanager
    def watched(self) -> Iterator[None]:
        """Inside `with`, `check_time` raises once the time is over: for long computations in fields that know of no budget."""
        token = _WATCHED.set(self)
        try:
            yield
        finally:
            _WATCHED.reset(token)

    def check_degree(self, degree: int, what: str) -> None:
        if degree > self.limits.unknown_degree:
            raise LimitExceeded(
                f"{what} may have degree {in_a_message(degree)}, above the limit of {self.limits.unknown_degree}",
                limit="unknown_degree",
            )


_WATCHED: ContextVar[Budget | None] = ContextVar("watched", default=None)


@dataclass
class _Work:
    """The bound on the work, and the amount that may still be counted."""

    most: int
    left: int


_COUNTED_WORK: ContextVar[_Work | None] = ContextVar("counted", default=None)


@contextmanager
def bounded_work(most: int) -> Iterator[None]:
    """Inside `with`, `count_work` raises once more than this was counted, the same on an idle and on a loaded machine.

    >>> with bounded_work(3):
    ...     count_work(2)
    ...     count_work(2)
    Traceback (most recent call last):
    kovacic.errors.LimitExceeded: more than 3 units of work are needed
    """
    token = _COUNTED_WORK.set(_Work(most, left=most))
    try:
        yield
    finally:
        _COUNTED_WORK.reset(token)


def count_work(amount: int) -> None:
    """Count some units of work; raises `LimitExceeded` beyond the bound of `bounded_work`, if there is one."""
    work = _COUNTED_WORK.get()
    if work is None:
        return
    work.left -= amount
    if work.left < 0:
        raise LimitExceeded(f"more than {work.most} units of work are needed", limit="work")


def manageable(*expressions: Any, most: int = MOST_SUBEXPRESSIONS) -> bool:
    """True if SymPy expressions have at most `most` subexpressions together; no more of them are visited.

    >>> import sympy
    >>> manageable(sympy.Symbol("x") + 1), manageable(sympy.Symbol("x") + 1, most=2)
    (True, False)
    """
    left, waiting = most, list(expressions)
    while waiting and left >= 0:
        waiting.extend(waiting.pop().args)
        left -= 1
    return left >= 0


_P = ParamSpec("_P")
_R = TypeVar("_R")


def limited(call: Callable[_P, _R]) -> Callable[_P, _R]:
    """A decorator: the call keeps the limits of its keyword `limits`, of its `accuracy`, or of its first argument, an answer.

    Every public function is one of these.  `limits=None` is as good as no such keyword.
    """

    @wraps(call)
    def within(*arguments: _P.args, **keywords: _P.kwargs) -> _R:
        given: object = keywords.get("limits")
        if given is None:
            keywords.pop("limits", None)
            given = getattr(keywords.get("accuracy"), "limits", None)  # of a `kovacic.Accuracy`
        if given is None and arguments:
            own = getattr(arguments[0], "limits", None)
            given = own if isinstance(own, Limits) else None
        token = _WATCHED.set(Budget(limits_of(given)))
        try:
            return call(*arguments, **keywords)
        finally:
            _WATCHED.reset(token)

    return within


def check_time() -> None:
    """Raise `LimitExceeded` if the watched budget has expired."""
    budget = _WATCHED.get()
    if budget is not None and CLOCK.now() > budget._deadline:  # called so often that another call would be felt
        raise budget.exceeded()


def watched_seconds(most: float) -> float:
    """The seconds left of the watched budget, at most `most`."""
    budget = _WATCHED.get()
    return most if budget is None else min(most, budget.seconds_left)


def may_be_late(seconds: float) -> bool:
    """True if an uninterruptible step of at most `seconds` could overrun the watched budget.

    Some lateness is allowed: a tenth of the limit and a twentieth of a second.  Where a step is carried out may depend on
    this, never its result.
    """
    budget = _WATCHED.get()
    return budget is not None and seconds > budget.seconds_left + 0.1 * budget.seconds + 0.05


def check_duration(seconds: float, what: str) -> None:
    """Raise `LimitExceeded` if the watched budget has less time left: before a step that can't be interrupted."""
    budget = _WATCHED.get()
    if budget is None:
        return
    budget.check()
    if seconds > budget.seconds_left:
        raise budget.exceeded(f"{what} takes about {seconds:.2g} s")
