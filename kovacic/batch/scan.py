"""The points of a scan as a batch, and its records as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from kovacic.batch import make_job, run_items
from kovacic.batch.grid import Grid, Template, points
from kovacic.batch.items import Item, Record
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits


def scan_items(expression: Any, grids: Sequence[Grid], *, var: str | None = None) -> Iterator[Item]:
    """An item for each point of the grids, the last parameter changing fastest; `extra` has the values.

    `expression` is a text or a SymPy expression.  Raises `InputError` at once where a parameter doesn't occur.
    """
    names = [grid.name for grid in grids]
    if not names:
        raise InputError("a scan needs a parameter", hint="n=0:10:1/4")
    if len(set(names)) < len(names) or var in names:
        raise InputError(f"the names {', '.join(names)} aren't different parameters")
    template = Template(str(expression), names)
    return (
        Item(number, template.filled(values), var, {"parameters": {name: str(value) for name, value in values.items()}})
        for number, values in enumerate(points(grids), start=1)
    )


def scan(
    expression: Any,
    grids: Sequence[Grid],
    *,
    var: str | None = None,
    jobs: int | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    group: bool = True,
    ordered: bool = True,
    backend: str | None = None,
    scheduler: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Iterator[Record]:
    """One record for each point of the grids: as `kovacic.solve_many`, with `parameters` and the group in the JSON.

    At points where the expression isn't defined (a division by zero) the record has an `error`.
    """
    job = make_job(timeout=timeout, memory=memory, group=group, limits=limits)
    items = scan_items(expression, grids, var=var)
    return run_items(items, job, jobs=jobs, ordered=ordered, backend=backend, scheduler=scheduler)


def columns(grids: Sequence[Grid]) -> tuple[str, ...]:
    """The head of the table."""
    return (*(grid.name for grid in grids), "status", "case", "degree", "group", "order", "seconds", "remark")


def row(record: Record) -> tuple[str, ...]:
    """A record as a row of the table; what doesn't exist is empty.

    `degree` is that of omega, `order` that of the group where it is finite, `remark` the reason of an undecided point or
    the error.
    """
    data = record.data
    riccati, group = data.get("riccati") or {}, data.get("group") or {}
    remark = data["error"]["message"] if "error" in data else data["proof"]["undecided"]
    cells = (
        data["status"],
        data.get("case"),
        riccati.get("degree"),
        group.get("name"),
        group.get("order"),
        data.get("seconds"),
        remark,
    )
    return (*data["parameters"].values(), *("" if cell is None else str(cell) for cell in cells))
