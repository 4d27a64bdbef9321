"""Many equations, in worker processes that can be killed or on other machines: one answer for every input.

Texts, or files of them, go in; a `Record` with a line of JSON for every one of them comes out.  `records` first: what travels.

    files    files into items; the answers   pool     items into records, with limits that hold
    scan     grids of parameters, a map      worker   the processes of the pool
    backends chunks through Dask or Ray
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from kovacic.batch.records import Item, Job, Record
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits


def solve_many(
    equations: Iterable[Any],
    *,
    var: str | None = None,
    parameters: Sequence[str] = (),
    jobs: int | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    group: bool = False,
    ordered: bool = True,
    backend: str | None = None,
    scheduler: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Iterator[Record]:
    """One `Record` for each equation, lazily, in their order or (`ordered=False`) as they finish.

    Parameters
    ----------
    equations : iterable
        Each is anything that `kovacic.solve` takes, or a mapping with the key "S" and optionally "id", "var" and "names".  It
        may be an endless generator.
    var : str
        The name of the variable where an equation doesn't say.
    parameters : sequence of str
        Names of more than one letter that are parameters, in all equations: ["EI"]; "names" declares them for one.
    jobs : int
        The number of worker processes; one for each core by default.
    timeout : float
        Seconds for each equation; a process that exceeds them is killed and replaced, and its equation is undecided.
    memory : int
        MiB for each equation, above the size of an idle worker; enforced like `timeout`.
    group : bool
        True adds the Galois group to each record.  False by default.
    ordered : bool
        The records come in the order of the equations (the default), or with False as they finish.
    backend : str
        "dask" or "ray" for a cluster; None, the default, for this machine.
    scheduler : str
        The address of Dask's scheduler.
    limits : Limits
        Bounds on the input and on the work, for each equation; by default those of `Limits()`.

    Returns
    -------
    iterator of Record
        A bad equation gives a record with an `error`, and nothing is raised for it.  `number` counts from 1; `label` and `case`
        are the verdict in short, `solution` is the answer as an object and `json` is its line in schema 1.  Closing the
        iterator ends the processes.

    Raises
    ------
    InputError
        For options that don't fit together, and for a single text.

    Examples
    --------
    >>> import kovacic
    >>> good, none, bad = kovacic.solve_many(["x^2 + 3", "x", "x^2 +"], jobs=1)
    >>> good.number, good.label, good.case, good.error, good.data["status"], str(good.solution.omega)
    (1, 'case 1', 1, None, 'liouvillian', '(x**2 + 1)/x')
    >>> none.label, none.case
    ('none', None)
    >>> bad.label, bad.case, bad.error
    ('bad input', None, "the expression ends after '+'")
    """
    from kovacic.batch.files import item_from

    if isinstance(equations, str | bytes | Mapping):
        raise InputError("several equations are expected: a list, or any other iterable", hint='["x^2", "x"]')
    job = Job(
        timeout=timeout, memory=memory, group=group, limits=limits, jobs=jobs, ordered=ordered, backend=backend,
        scheduler=scheduler, parameters=parameters,
    )  # fmt: skip
    items = (item_from(number, value, var=var, limits=limits) for number, value in enumerate(equations, start=1))
    return run_items(items, job)


def run_items(items: Iterable[Item], job: Job) -> Iterator[Record]:
    """The records of items with different numbers, in this machine's processes or on a backend."""
    if job.backend is not None:
        from kovacic.batch.backends import run_on_backend

        yield from run_on_backend(items, job)
        return
    from kovacic.batch.pool import Pool

    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    with Pool(job.jobs or cores, job) as pool:
        yield from pool.run(items, ordered=job.ordered, stream=job.stream)


__all__ = ["Item", "Job", "Record", "run_items", "solve_many"]
