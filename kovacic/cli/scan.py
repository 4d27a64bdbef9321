"""`kovacic scan`: the case and the group over grids of exact parameter values."""

from __future__ import annotations

import csv
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack, nullcontext
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

import click

from kovacic.cli.options import parse_limits, refuse_options

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from kovacic.batch.grid import Grid
    from kovacic.batch.items import Item, Record
    from kovacic.batch.summary import Summary
    from kovacic.cli.progress import ProgressMeter

Write = Callable[["Record"], None]


@click.command(context_settings={"ignore_unknown_options": True})
@click.argument("expression", metavar="S")
@click.argument("ranges", metavar="NAME=START:STOP:STEP...", nargs=-1, required=True)
@click.option("-o", "--output", type=click.Path(dir_okay=False, path_type=Path), help="Write to this file.")
@click.option("--resume", is_flag=True, help="Take an interrupted scan up again (JSONL).")
@click.option("--format", "form", type=click.Choice(["jsonl", "csv"]), help="By default by the name of the output.")
@click.option("--map", "picture", type=click.Path(dir_okay=False), help="Draw two parameters as a map (png, pdf, svg).")
@click.option("-j", "--jobs", type=click.IntRange(min=1), help="Worker processes; by default one for each core.")
@click.option("--timeout", type=click.FloatRange(min=0, min_open=True), metavar="SECONDS", help="For each point.")
@click.option("--memory", type=click.IntRange(min=1), metavar="MIB", help="For each point.")
@click.option("--group/--no-group", default=True, show_default=True, help="The differential Galois group.")
@click.option("--var", metavar="NAME", help="The name of the variable; by default x, or what isn't a parameter.")
@click.option("--limit", "limits", metavar="NAME=VALUE", multiple=True, help="Change a limit, as for kovacic solve.")
@click.option("--backend", type=click.Choice(["loky", "dask", "ray"]), help="Run on an engine of joblib's.")
@click.option("--scheduler", metavar="ADDRESS", help="The engine's address, for example tcp://host:8786.")
@click.option("--progress/--no-progress", default=None, help="By default if standard error is a terminal.")
@click.option("-q", "--quiet", is_flag=True, help="No summary.")
def command(
    expression: str,
    ranges: tuple[str, ...],
    output: Path | None,
    resume: bool,
    form: str | None,
    picture: str | None,
    jobs: int | None,
    timeout: float | None,
    memory: int | None,
    group: bool,
    var: str | None,
    limits: tuple[str, ...],
    backend: str | None,
    scheduler: str | None,
    progress: bool | None,
    quiet: bool,
) -> int:
    """Decide y'' = S(x) y for every combination of parameter values.

    A range is NAME=START:STOP:STEP with STOP included and STEP 1 by default, or NAME=VALUE,VALUE,...; numbers are exact.

    \b
    kovacic scan "(4*n^2-1)/(4*x^2)-1" n=0:10:1/4 --format csv
    kovacic scan "1/4 - k/x + (4*m^2-1)/(4*x^2)" k=-3:3:1/4 m=0:3:1/4 -o whittaker.jsonl --map whittaker.png

    Exit status: 0 all decided, 3 some undecided, 2 some points where S isn't defined, 4 a self-check or a process failed.
    """
    from kovacic.batch import make_job, run_items
    from kovacic.batch.grid import parse_grid
    from kovacic.batch.items import label_of
    from kovacic.batch.map import draw_map
    from kovacic.batch.output import Done, stored, take_up
    from kovacic.batch.scan import scan_items
    from kovacic.batch.summary import Summary

    refuse_options([expression, *ranges])
    grids = [parse_grid(text) for text in ranges]
    if picture is not None and len(grids) != 2:
        raise click.UsageError("a map needs two parameters")
    form = form or ("csv" if output is not None and output.suffix == ".csv" else "jsonl")
    if resume and (output is None or form == "csv"):
        raise click.UsageError("--resume needs --output FILE.jsonl, the file of the interrupted scan")
    if not resume and output is not None and output.exists() and output.stat().st_size:
        raise click.UsageError(f"{output} isn't empty: --resume continues it")
    job = make_job(timeout=timeout, memory=memory, group=group, limits=parse_limits(limits))
    items: Iterable[Item] = scan_items(expression, grids, var=var)
    done = take_up(output) if resume and output is not None else Done({})
    labels = {data["line"]: label_of(data) for data in stored(output)} if resume and output is not None else {}
    if len(done):
        items = (item for item in items if item not in done)
    summary = Summary()
    with ExitStack() as stack:
        write = _writer(stack, output, form, grids)
        started = time.monotonic()
        if not quiet:
            stack.callback(_report, summary, len(done), started)
        total = prod(len(grid.values) for grid in grids) - len(done)
        meter = stack.enter_context(_meter(total, progress))
        for record in run_items(items, job, jobs=jobs, backend=backend, scheduler=scheduler):
            write(record)
            summary.add(record)
            if picture is not None:
                labels[record.number] = record.label
            if meter is not None:
                meter.advance(summary)
    if picture is not None:
        draw_map(expression, (grids[0], grids[1]), labels, picture)
    return summary.exit_status


def _writer(stack: ExitStack, output: Path | None, form: str, grids: Sequence[Grid]) -> Write:
    """The function that writes a record, at once."""
    from kovacic.batch.output import Answers
    from kovacic.batch.scan import columns, row

    if form == "jsonl" and output is not None:
        return stack.enter_context(Answers(output)).write
    stream = sys.stdout
    if output is not None:
        stream = stack.enter_context(output.open("w", encoding="utf-8", newline=""))
    if form == "jsonl":

        def write(record: Record) -> None:
            stream.write(record.json + "\n")
            stream.flush()

        return write
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(columns(grids))

    def write_row(record: Record) -> None:
        table.writerow(row(record))
        stream.flush()

    return write_row


def _meter(total: int, wanted: bool | None) -> AbstractContextManager[ProgressMeter | None]:
    if wanted is None:
        wanted = sys.stderr.isatty() and not sys.stdout.isatty()
    if not wanted:
        return nullcontext()
    from kovacic.cli.progress import ProgressMeter

    return ProgressMeter(total)


def _report(summary: Summary, already_done: int, started: float) -> None:
    from kovacic.cli.progress import print_summary

    print_summary(summary, already_done=already_done, seconds=time.monotonic() - started)
