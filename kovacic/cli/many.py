"""What `kovacic batch` and `kovacic scan` have in common: their options, the run itself, the progress bar, the summary."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from kovacic.cli.options import limit_option

if TYPE_CHECKING:
    from kovacic.batch.files import Done
    from kovacic.batch.records import Item, Record, Summary
    from kovacic.limits import Limits

Command = TypeVar("Command", bound=Callable[..., Any])

#: Seconds between two states of the line that shows progress.
_REFRESH = 0.2
_OPTIONS = [
    click.option("-j", "--jobs", type=click.IntRange(min=1), help="Worker processes; by default one for each core."),
    click.option(
        "--timeout", type=click.FloatRange(min=0, min_open=True), metavar="SECONDS", help="For each equation."
    ),
    click.option("--memory", type=click.IntRange(min=1), metavar="MIB", help="For each equation."),
    limit_option,
    click.option("--backend", type=click.Choice(["dask", "ray"]), help="Run on a cluster."),
    click.option("--scheduler", metavar="ADDRESS", help="The engine's address, for example tcp://host:8786."),
    click.option("--progress/--no-progress", default=None, help="By default if standard error is a terminal."),
    click.option("-q", "--quiet", is_flag=True, help="No summary."),
]


def batch_options(command: Command) -> Command:
    """The options of a command that answers many equations; `limits` and so on arrive as keywords."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def already_answered(output: Path | None, resume: bool) -> Done:
    """What the output file of an interrupted run has.  A file that isn't empty is never written to by accident."""
    from kovacic.batch.files import Done, take_up

    if resume:
        if output is None:
            raise click.UsageError("--resume needs --output FILE, the JSONL file of the interrupted run")
        return take_up(output)
    if output is not None and output.is_file() and output.stat().st_size:
        raise click.UsageError(f"{output} isn't empty: --resume continues it")
    return Done()


def answer_all(
    items: Iterable[Item],
    write: Callable[[Record], None],
    *,
    count: Callable[[], int] | None,
    done: Done,
    timeout: float | None,
    memory: int | None,
    group: bool,
    limits: Limits,
    progress: bool | None,
    quiet: bool,
    **engine: Any,
) -> int:
    """Write a record for every item that isn't done, with a line of progress where it is wanted, and at the end, be it an
    interruption, the summary; the exit status.  `count` tells how many items there are, where that is possible.
    """
    from kovacic.batch import Job, run_items
    from kovacic.batch.records import Summary

    job = Job(timeout=timeout, memory=memory, group=group, limits=limits)
    summary, start = Summary(), time.monotonic()
    with ExitStack() as stack:
        if not quiet:
            stack.callback(lambda: _print_summary(summary, len(done), time.monotonic() - start))
        if progress is None:
            progress = sys.stderr.isatty() and not sys.stdout.isatty()
        size, shown = count() - len(done) if progress and count else None, -_REFRESH
        if progress:
            stack.callback(sys.stderr.write, "\n")
            stack.callback(lambda: _show_progress(summary, size, time.monotonic() - start))
        for record in run_items((item for item in items if item not in done), job, **engine):
            write(record)
            summary.add(record)
            now = time.monotonic() - start
            if progress and now > shown + _REFRESH:
                _show_progress(summary, size, now)
                shown = now
    return summary.exit_status


def _show_progress(summary: Summary, total: int | None, seconds: float) -> None:
    """The number done, the rate, the remaining time and the counts by case, in one line of standard error."""
    from shutil import get_terminal_size

    rate = summary.total / max(seconds, 1e-9)
    left = "" if total is None else f"  {max(total - summary.total, 0) / max(rate, 1e-9):.0f} s left"
    counts = "  ".join(f"{label} {count}" for label, count in summary.rows())
    line = f"{summary.total}/{'?' if total is None else total}  {rate:.3g}/s{left}  {counts}"
    width = get_terminal_size().columns - 1
    sys.stderr.write("\r" + line[:width].ljust(width))
    sys.stderr.flush()


def _print_summary(summary: Summary, answered: int, seconds: float) -> None:
    """Counts by case and the times, on standard error."""
    from kovacic.views.document import FORMATS, Paragraph, Table

    counts = Table(("outcome", "equations"), [[[k], [str(n)]] for k, n in [*summary.rows(), ("all", summary.total)]])
    lines = [f"{seconds:.1f} s in all, {summary.total / max(seconds, 1e-9):.0f} equations a second"]
    if summary.slowest is not None:
        quantiles = f"median {summary.quantile(0.5):.2g} s, 90 % within {summary.quantile(0.9):.2g} s"
        slowest = f"slowest {summary.slowest.seconds:.2g} s (line {summary.slowest.number})"
        lines.insert(0, f"time of an equation: {quantiles}, {slowest}")
    if answered:
        lines.insert(0, f"{answered} more had been answered before")
    print(FORMATS["text"].render([counts, Paragraph(["\n".join(lines)])]), end="", file=sys.stderr)
