"""The data of a batch: items, records, the conditions of a job, and a summary in numbers.

Items, records and jobs are plain data that travel between processes and machines.
"""

from __future__ import annotations

import json
import os
from array import array
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from kovacic.errors import InputError, KovacicError, LimitExceeded, VerificationFailed
from kovacic.limits import DEFAULT_LIMITS, Limits, limits_of, seconds_of
from kovacic.numbers.exact import whole
from kovacic.process import LONGEST_SECONDS
from kovacic.solution import Solution
from kovacic.views.json import group_dict
from kovacic.writing.document import notebook_table
from kovacic.writing.escaped import json_line

# The verdict of a record in one word; the degree of omega is added in case 3.
OPEN = "undecided"
ERROR = "bad input"
FAILED = "failed"
# By the structure of the group: label, case, degree of omega.
_STRUCTURE_LABELS: dict[str | None, tuple[str, int | None, int]] = {
    "reducible": ("case 1", 1, 1),
    "imprimitive": ("case 2", 2, 2),
    "tetrahedral": ("case 3 (4)", 3, 4),
    "octahedral": ("case 3 (6)", 3, 6),
    "icosahedral": ("case 3 (12)", 3, 12),
    None: ("none", None, 0),
}
LABELS = (*(label for label, _, _ in _STRUCTURE_LABELS.values()), OPEN, ERROR, FAILED)
_EXIT_STATUS = {FAILED: 4, ERROR: 2, OPEN: 3}


class ProcessLost(KovacicError):
    """The process of an equation ended for a reason that isn't a limit."""


# Types of errors that aren't the input's.
_FAILURES = (ProcessLost.__name__, VerificationFailed.__name__)


@dataclass(frozen=True, slots=True)
class Item:
    """One equation of a batch: `number` counts the lines of the input from 1, `text` is S.

    `names` are declared parameters, whatever they look like.
    `extra` is copied to the record (an identifier, the values of parameters).  `error` says why the line isn't an equation;
    then `text` is the whole line.
    """

    number: int
    text: str
    var: str | None = None
    extra: Mapping[str, Any] = field(default_factory=dict)
    error: InputError | LimitExceeded | None = None
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Record:
    """The answer to one equation of a batch.

    Attributes
    ----------
    number : int
        Its place in the input, from 1.
    label : str
        The verdict in a word: "case 1", "case 2", "case 3 (4)" with the degree of omega, "none", "undecided", "bad input", or
        "failed" where an answer didn't pass its check or its processes were lost.
    seconds : float
        The time it took.
    json : str
        Its line in schema 1, with the keys `line` (the number) and those of the input, such as "id", before it.  Without an
        answer, `status` is "error" and `error` has `type` and `message`, and for a bad input `position` and `hint`.

    The examples of `kovacic.solve_many` show some.
    """

    number: int
    label: str
    seconds: float
    json: str

    def __repr__(self) -> str:
        return f"<Record {self.number}: {self.label}>"

    def _repr_html_(self) -> str:
        first = notebook_table([(f"equation {self.number}", self.error or self.label)])
        return first if self.error is not None else first + self.solution._repr_html_()

    @property
    def data(self) -> dict[str, Any]:
        """The JSON as an object."""
        return json.loads(self.json)  # type: ignore[no-any-return]

    @property
    def case(self) -> int | None:
        """Kovacic's case, 1 to 3, or None."""
        return next((case for label, case, _ in _STRUCTURE_LABELS.values() if label == self.label), None)

    @property
    def error(self) -> str | None:
        """The error message; None if there is an answer."""
        return self.data["error"]["message"] if self.label in (ERROR, FAILED) else None

    @property
    def solution(self) -> Solution:
        """The answer as an object.  Raises `KovacicError` with the record's error if there is none."""
        if self.error is not None:
            raise KovacicError(f"line {self.number}: {self.error}")
        return Solution.from_json(self.data)


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """The conditions for every equation of a batch, and where it runs.

    `timeout`, in seconds, and `memory`, in MiB above the size of an idle worker, are hard: the process is killed.  `limits`
    are those of `kovacic.solve`, with `timeout` as their time, so that most equations end by themselves.  With `group`, the
    record has the differential Galois group: name, order (null if infinite) and finiteness.  `parameters` are declared for
    all equations.  `jobs`, `ordered`, `backend` and `scheduler` are those of `solve_many`; `stream` says that items may be
    slow to arrive.  Raises `InputError` for impossible conditions.
    """

    timeout: float | None = None
    memory: int | None = None
    group: bool = False
    limits: Limits = DEFAULT_LIMITS
    jobs: int | None = None
    ordered: bool = True
    stream: bool = False
    backend: str | None = None
    scheduler: str | None = None
    parameters: Sequence[str] = ()

    def __post_init__(self) -> None:
        self._set(timeout=seconds_of(self.timeout, "timeout"))
        if self.memory is not None:
            self._set(memory=whole(self.memory, "memory, in MiB,", least=1))
        if self.jobs is not None:
            self._set(jobs=whole(self.jobs, "jobs", least=1))
        self._set(limits=limits_of(self.limits))
        if self.timeout is not None and not 0 < self.timeout < LONGEST_SECONDS:
            raise InputError(f"a timeout of {self.timeout} s is out of range", hint="give seconds, above 0")
        if self.memory is not None and not os.path.exists("/proc/self/statm"):
            raise InputError("memory limits need a Linux system", hint="leave the memory limit out")
        if self.scheduler is not None and self.backend is None:
            raise InputError("a scheduler needs a backend", hint="backend='dask'", shell="--backend dask")

    def _set(self, **values: Any) -> None:
        """Set fields of the frozen object while it is being made."""
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def engine_limits(self) -> Limits:
        """The limits inside the worker."""
        times = [t for t in (self.timeout, self.limits.seconds) if t is not None]
        return replace(self.limits, seconds=min(times, default=None))


def record_of(item: Item, solution: Solution, job: Job) -> Record:
    """The record of an answer."""
    added = {"line": item.number, **item.extra}
    if job.group:
        added["group"] = group_dict(solution)
    head = json_line(added)
    label = OPEN
    if not solution.reason:
        structure = solution.decision.structure
        label, *_ = _STRUCTURE_LABELS[structure and structure.value]
    return Record(item.number, label, solution.seconds or 0.0, f"{head[:-1]}, {solution.to_json()[1:]}")


def label_of(data: Mapping[str, Any]) -> str:
    """The label of a record that has been read from a file.

    Raises `ValueError`, `KeyError` or `TypeError` for an incomplete record, and for one that contradicts itself.
    """
    if data["schema"] != 1:
        raise ValueError("another schema")
    if data["status"] == "error":
        return FAILED if data["error"]["type"] in _FAILURES else ERROR
    if data["status"] == OPEN and data["proof"]["undecided"]:
        return OPEN
    label, case, degree = _STRUCTURE_LABELS[data["proof"]["structure"]]
    status = "none" if case is None else "liouvillian"
    by_series = int(data["proof"].get("series") is not None)
    found = data["riccati"]["degree"] if data["riccati"] else by_series
    if (data["status"], data["case"], found) != (status, case, degree) or not data["verified"]:
        raise ValueError("the answer contradicts itself")
    return label


def refused(item: Item, error: KovacicError, seconds: float = 0.0, *, shell: bool = False) -> Record:
    """The record of an input that isn't an equation or is too large, or of a failure; with the hint for the `shell`."""
    if isinstance(error, LimitExceeded):
        return stopped(item, str(error), seconds)
    details: dict[str, Any] = {"type": type(error).__name__, "message": str(error)}
    if not isinstance(error, InputError):
        return _without_answer(item, FAILED, {"status": "error", "error": details}, seconds)
    hint = error.shell if shell else error.hint
    details |= {"message": error.message, "position": error.position, "hint": hint}
    return _without_answer(item, ERROR, {"status": "error", "error": details}, seconds)


def stopped(item: Item, reason: str, seconds: float) -> Record:
    """The record of an equation whose process was stopped at a limit; `S` is the text as given, since nothing was sent back."""
    data: dict[str, Any] = {
        "variable": item.var or "x",
        "S": item.text.strip(),
        "status": OPEN,
        **dict.fromkeys(("case", "riccati", "constants")),
        "verified": False,
        "proof": {"structure": None, "semi_invariant": None, "invariant": None, "excluded": [], "undecided": reason},
        "notices": [],
        "seconds": round(seconds, 6),
    }
    return _without_answer(item, OPEN, data, seconds)


def _without_answer(item: Item, label: str, data: Mapping[str, Any], seconds: float) -> Record:
    head = {"line": item.number, **item.extra, "schema": 1, "input": item.text}
    return Record(item.number, label, seconds, json_line({**head, **data}))


class Summary:
    """Counts by case, and the quantiles of the time of an equation; `before` are the labels of an interrupted run."""

    def __init__(self, before: Iterable[str] = ()) -> None:
        self.before = Counter(before)
        self.counts: Counter[str] = Counter()
        self.slowest: Record | None = None
        self._times = array("d")

    def add(self, record: Record) -> None:
        self.counts[record.label] += 1
        self._times.append(record.seconds)
        if self.slowest is None or record.seconds > self.slowest.seconds:
            self.slowest = record

    @property
    def total(self) -> int:
        return len(self._times)

    def quantile(self, q: float) -> float:
        """The time, in seconds, within which a fraction q < 1 of the equations was answered; 0 for an empty batch.

        >>> summary = Summary()
        >>> for k in range(1, 101):
        ...     summary.add(Record(k, "none", k / 100, ""))
        >>> summary.quantile(0.5)
        0.51
        """
        return sorted(self._times)[int(q * self.total)] if self._times else 0.0

    def rows(self) -> Iterator[tuple[str, int]]:
        """The labels that occur, in their order, with their counts."""
        return ((label, self.counts[label]) for label in LABELS if self.counts[label])

    @property
    def exit_status(self) -> int:
        """As for `kovacic solve`; the answers of an interrupted run count, since they are in the same file."""
        occurring = self.counts + self.before
        return next((status for label, status in _EXIT_STATUS.items() if occurring[label]), 0)
