"""`kovacic batch` and `kovacic scan`: thousands of equations, from a file or over grids of parameters; progress, a summary."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from contextlib import ExitStack, nullcontext
from functools import partial
from itertools import repeat
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import click

from kovacic.cli import options
from kovacic.errors import needs

if TYPE_CHECKING:
    from kovacic.batch.files import Done
    from kovacic.batch.records import Item, Record, Summary
    from kovacic.limits import Limits

_BATCH_OPTIONS = options.together(
    click.option("-j", "--jobs", type=click.IntRange(min=1), help="Worker processes; by default one for each core."),
    click.option(
        "--timeout", type=click.FloatRange(min=0, min_open=True), metavar="SECONDS", help="For each equation."
    ),
    click.option("--memory", type=click.IntRange(min=1), metavar="MIB", help="For each equation."),
    options.DECLARED,
    options.LIMIT,
    click.option("--backend", type=click.Choice(["dask", "ray"]), help="Run on a cluster."),
    click.option("--scheduler", metavar="ADDRESS", help="The engine's address, for example tcp://host:8786."),
    click.option(
        "--progress/--no-progress",
        default=None,
        help="On a terminal; by default if the answers go to a file or a pipe.",
    ),
    click.option("-q", "--quiet", is_flag=True, help="No summary."),
)


@click.command(cls=options.Command)
@click.argument("file", metavar="FILE", type=click.File("rb"))
@click.option("-o", "--output", type=options.OutputFile(), help="Append the answers to this file.")
@click.option("--resume", is_flag=True, help="Take an interrupted run up again: answer what the output file lacks.")
@click.option("--format", "form", type=click.Choice(["lines", "jsonl", "csv"]), help="By default by the file's name.")
@click.option("--ordered/--as-finished", default=True, show_default=True, help="The order of the answers.")
@click.option("--group", is_flag=True, help="Add the differential Galois group to each answer.")
@options.VAR
@_BATCH_OPTIONS
def batch(
    file: BinaryIO, output: Path | None, resume: bool, form: str | None, var: str | None, limits: Limits, **run: Any
) -> int:
    """Decide every equation of FILE; "-" is standard input.

    FILE has an expression S a line, or JSON a line (a string, or an object with "S", perhaps "id", "var" and "names"), or is
    a CSV table with a column S; any of them may be compressed with gzip.  The answers are JSON, schema 1, a line for every
    equation, with "line", its place in FILE.  A bad line gets an answer that says what is wrong with it.

    \b
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --memory 500
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --resume
    generate | kovacic batch - --as-finished | jq .case

    Exit status: 0 all decided, 3 some undecided, 2 some bad input, 4 a self-check or a process failed, 5 the output can't
    be written.
    """
    from kovacic.batch.files import answers, count_items, guess_format, read_items

    done = _already_answered(output, resume)
    standard = file is sys.stdin.buffer
    stream = standard or not Path(file.name).is_file()  # a pipe has a name as well, and may be silent for long
    if form is None and not standard:
        form = guess_format(file.name)
    items = read_items(file, form=form, var=var, limits=limits)
    count = None if stream else partial(count_items, file.name, form=form)
    with answers(output) as write:
        return _answer_all(items, write, output, count=count, done=done, limits=limits, stream=stream, **run)


@options.equation_command()
@click.argument("expression", metavar="S")
@click.argument("ranges", metavar="NAME=START:STOP:STEP...", nargs=-1, required=True)
@click.option("-o", "--output", type=options.OutputFile(), help="Write to this file.")
@click.option("--resume", is_flag=True, help="Take an interrupted scan up again (JSONL).")
@options.formats({".jsonl": "jsonl", ".csv": "csv"}, default="jsonl", format="By default by the name of the output.")
@click.option("--map", "picture", type=options.PICTURE, help="Draw two parameters as a map (png, pdf, svg).")
@click.option("--group/--no-group", default=True, show_default=True, help="The differential Galois group.")
@click.option("--var", metavar="NAME", help="The name of the variable; by default x, or what isn't a parameter.")
@_BATCH_OPTIONS
def scan(
    expression: str,
    ranges: tuple[str, ...],
    output: Path | None,
    resume: bool,
    form: str,
    picture: Path | None,
    var: str | None,
    **run: Any,
) -> int:
    """Decide y'' = S(x) y for every combination of parameter values.

    A range is NAME=START:STOP:STEP with STOP included and STEP 1 by default, or NAME=VALUE,VALUE,...; numbers are exact,
    and a VALUE can be algebraic, sqrt(2).

    \b
    kovacic scan "(4*n^2-1)/(4*x^2)-1" n=0:10:1/4 --format csv
    kovacic scan "1/4 - k/x + (4*m^2-1)/(4*x^2)" k=-3:3:1/4 m=0:3:1/4 --map w.png

    Exit status: 0 all decided, 3 some undecided, 2 some points where S isn't defined, 4 a self-check or a process failed,
    5 the output can't be written.
    """
    from kovacic.batch.files import answers
    from kovacic.batch.scan import columns, draw_map, parse_grid, row, scan_items

    grids = [parse_grid(text) for text in ranges]
    if picture is not None and len(grids) != 2:
        raise click.UsageError("a map needs two parameters")
    if resume and form == "csv":
        raise click.UsageError("--resume needs --output FILE.jsonl, the file of the interrupted scan")
    done = _already_answered(output, resume)
    labels = dict(done.labels)
    items = scan_items(expression, grids, var=var)
    with answers(output) if form == "jsonl" else answers(output, row, head=columns(grids)) as write:

        def noted(record: Record) -> None:
            write(record)
            if picture is not None:
                labels[record.number] = record.label

        status = _answer_all(items, noted, output, count=lambda: prod(map(len, grids)), done=done, **run)
    if picture is not None:
        with options.waiting("drawing"):
            draw_map(expression.strip(), (grids[0], grids[1]), labels, picture)
    return status


def _already_answered(output: Path | None, resume: bool) -> Done:
    """The answers in the output file of an interrupted run.  A file that isn't empty is never overwritten by accident."""
    from kovacic.batch.files import Done, take_up

    if resume:
        if output is None:
            raise click.UsageError("--resume needs --output FILE, the JSONL file of the interrupted run")
        return take_up(output)
    if output is not None and output.is_file() and output.stat().st_size:
        raise click.UsageError(f"{output} isn't empty: --resume continues it")
    return Done()


def _answer_all(
    items: Iterable[Item],
    write: Callable[[Record], None],
    output: Path | None,
    *,
    count: Callable[[], int] | None,
    done: Done,
    progress: bool | None,
    quiet: bool,
    **run: Any,
) -> int:
    """Write a record for every item that isn't done, and in the end, even if interrupted, the summary; return the exit status.

    Progress is shown, by default unless the answers appear on the terminal; `count` gives the number of items, if known.
    """
    from kovacic.batch import Job, run_items
    from kovacic.batch.records import Summary

    job = Job(**run)
    if job.backend == "dask":
        # Its log has tracebacks where a sentence is printed here; it takes the levels from its settings when it is imported.
        with needs("dask", "the backend dask"):
            import dask.config
        names = ("distributed", "distributed.client", "distributed.core", "distributed.batched")
        dask.config.set(logging=dict.fromkeys(names, "critical"))
    summary = Summary(before=done.labels.values())

    def counts(_: object) -> str:
        return "  ".join(f"{label} {count}" for label, count in summary.rows())

    start = time.monotonic()
    with ExitStack() as stack:
        if not quiet:
            stack.callback(lambda: _print_summary(summary, time.monotonic() - start))
        if progress is None:
            progress = output is not None or not sys.stdout.isatty()
        bar: Any = nullcontext()
        if progress and sys.stderr.isatty():
            total = None if count is None else count() - len(done)
            steps = repeat(None) if total is None else None
            bar = click.progressbar(steps, total, show_pos=True, item_show_func=counts, width=20, file=sys.stderr)
        bar = stack.enter_context(bar)
        for record in run_items((item for item in items if item not in done), job):
            write(record)
            summary.add(record)
            if bar is not None:
                bar.update(1)  # 0.04 ms, where an equation takes some
    return summary.exit_status


def _print_summary(summary: Summary, seconds: float) -> None:
    """Counts by case and the times, on standard error."""
    from kovacic.writing.document import Paragraph, Table, format_of

    counts = Table(("outcome", "equations"), [[k, str(n)] for k, n in [*summary.rows(), ("all", summary.total)]])
    lines = [f"{seconds:.1f} s in all, {summary.total / max(seconds, 1e-9):.1f} equations a second"]
    if summary.slowest is not None:
        quantiles = f"median {summary.quantile(0.5):.2g} s, 90 % within {summary.quantile(0.9):.2g} s"
        slowest = f"slowest {summary.slowest.seconds:.2g} s (line {summary.slowest.number})"
        lines.insert(0, f"time of an equation: {quantiles}, {slowest}")
    if summary.before:
        lines.insert(0, f"{summary.before.total()} more had been answered before")
    print(format_of().render([counts, Paragraph("\n".join(lines))]), end="", file=sys.stderr)
