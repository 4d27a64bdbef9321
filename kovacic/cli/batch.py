"""`kovacic batch`: a file of equations in, an answer for every one of them out."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import click

from kovacic.cli.options import parse_limits

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from kovacic.batch.items import Item, Record
    from kovacic.batch.output import Done
    from kovacic.batch.summary import Summary


class Sink(Protocol):
    """Where records go."""

    def write(self, record: Record) -> None: ...


class Meter(Protocol):
    """What is told about each record, for display."""

    def advance(self, summary: Summary) -> None: ...


@click.command()
@click.argument("file", metavar="FILE")
@click.option(
    "-o", "--output", type=click.Path(dir_okay=False, path_type=Path), help="Append the answers to this file."
)
@click.option("--resume", is_flag=True, help="Take an interrupted run up again: answer what the output file lacks.")
@click.option("--format", "form", type=click.Choice(["lines", "jsonl", "csv"]), help="By default by the file's name.")
@click.option("-j", "--jobs", type=click.IntRange(min=1), help="Worker processes; by default one for each core.")
@click.option("--timeout", type=click.FloatRange(min=0, min_open=True), metavar="SECONDS", help="For each equation.")
@click.option("--memory", type=click.IntRange(min=1), metavar="MIB", help="For each equation.")
@click.option("--ordered/--as-finished", default=True, show_default=True, help="The order of the answers.")
@click.option("--group", is_flag=True, help="Add the differential Galois group to each answer.")
@click.option("--var", metavar="NAME", help="The name of the variable; by default the only symbol of each S, or x.")
@click.option("--limit", "limits", metavar="NAME=VALUE", multiple=True, help="Change a limit, as for kovacic solve.")
@click.option("--backend", type=click.Choice(["loky", "dask", "ray"]), help="Run on an engine of joblib's.")
@click.option("--scheduler", metavar="ADDRESS", help="The engine's address, for example tcp://host:8786.")
@click.option("--progress/--no-progress", default=None, help="By default if standard error is a terminal.")
@click.option("-q", "--quiet", is_flag=True, help="No summary.")
def command(
    file: str,
    output: Path | None,
    resume: bool,
    form: str | None,
    jobs: int | None,
    timeout: float | None,
    memory: int | None,
    ordered: bool,
    group: bool,
    var: str | None,
    limits: tuple[str, ...],
    backend: str | None,
    scheduler: str | None,
    progress: bool | None,
    quiet: bool,
) -> int:
    """Decide every equation of FILE; "-" is standard input.

    FILE has an expression S a line, or JSON a line (a string, or an object with "S", perhaps "id" and "var"), or is a CSV
    table with a column S; any of them may be compressed with gzip.  The answers are JSON, schema 1, a line for every
    equation, with "line", its place in FILE.  A bad line gets an answer that says what is wrong with it.

    \b
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --memory 500
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --memory 500 --resume
    generate | kovacic batch - --as-finished | jq .case

    Exit status: 0 all decided, 3 some undecided, 2 some bad input, 4 a self-check or a process failed.
    """
    from kovacic.batch import make_job, run_items
    from kovacic.batch.output import Answers
    from kovacic.batch.reading import guess_format, opened, read_items
    from kovacic.batch.summary import Summary

    chosen = parse_limits(limits)
    job = make_job(timeout=timeout, memory=memory, group=group, limits=chosen)
    done = _prepare(output, resume)
    form = form or guess_format(file)
    summary = Summary()
    with ExitStack() as stack:
        stream = stack.enter_context(opened(file))
        items: Iterable[Item] = read_items(stream, form=form, var=var, limits=chosen)
        if done is not None:
            items = _remaining(items, done)
        sink: Sink = StandardOutput() if output is None else stack.enter_context(Answers(output))
        if not quiet:
            stack.callback(_report, summary, done, time.monotonic())
        meter = stack.enter_context(_meter(file, form, progress, done))
        records = run_items(
            items, job, jobs=jobs, ordered=ordered, stream=file == "-", backend=backend, scheduler=scheduler
        )
        for record in records:
            sink.write(record)
            summary.add(record)
            if meter is not None:
                meter.advance(summary)
    return summary.exit_status


class StandardOutput:
    """Records to standard output, each of them at once."""

    def write(self, record: Record) -> None:
        sys.stdout.write(record.json + "\n")
        sys.stdout.flush()


def _prepare(output: Path | None, resume: bool) -> Done | None:
    """What is done already; None for a new run.  An output file that isn't empty is never written to by accident."""
    from kovacic.batch.output import take_up

    if resume:
        if output is None:
            raise click.UsageError("--resume needs --output FILE, the file of the interrupted run")
        return take_up(output)
    if output is not None and output.exists() and output.stat().st_size:
        raise click.UsageError(f"{output} isn't empty: --resume continues it")
    return None


def _remaining(items: Iterable[Item], done: Done) -> Iterator[Item]:
    return (item for item in items if item not in done)


def _meter(file: str, form: str | None, wanted: bool | None, done: Done | None) -> AbstractContextManager[Meter | None]:
    """The progress bar, or nothing: by default if standard error is a terminal and standard output isn't the same one."""
    if wanted is None:
        wanted = sys.stderr.isatty() and not sys.stdout.isatty()
    if not wanted:
        return nullcontext()
    from kovacic.batch.reading import count_items
    from kovacic.cli.progress import ProgressMeter

    total = None if file == "-" else count_items(file, form=form) - (len(done) if done is not None else 0)
    return ProgressMeter(total)


def _report(summary: Summary, done: Done | None, started: float) -> None:
    from kovacic.cli.progress import print_summary

    print_summary(summary, already_done=0 if done is None else len(done), seconds=time.monotonic() - started)
