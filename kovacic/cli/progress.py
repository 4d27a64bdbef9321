"""The progress bar and the summary of a batch, on standard error."""

from __future__ import annotations

from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.table import Table
from rich.text import Text

from kovacic.batch.summary import Summary


class RateColumn(ProgressColumn):
    """Equations a second, over the last half minute."""

    def render(self, task: Task) -> Text:
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:.0f}/s" if speed >= 10 else f"{speed:.2g}/s")


class ProgressMeter:
    """A bar with the number done, the rate, the remaining time and the counts by case; a context manager."""

    def __init__(self, total: int | None) -> None:
        self._progress = Progress(
            BarColumn(bar_width=24),
            MofNCompleteColumn(),
            RateColumn(),
            TimeRemainingColumn(elapsed_when_finished=True),
            TextColumn("{task.fields[counts]}", style="dim"),
            console=Console(stderr=True),
        )
        self._task = self._progress.add_task("", total=total, counts="")

    def __enter__(self) -> ProgressMeter:
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._progress.stop()

    def advance(self, summary: Summary) -> None:
        """One more record, which is in the summary already."""
        counts = "  ".join(f"{label} {count}" for label, count in summary.rows())
        self._progress.update(self._task, completed=summary.total, counts=counts)


def print_summary(summary: Summary, *, already_done: int, seconds: float) -> None:
    """Counts by case and the times, as a table on standard error."""
    console = Console(stderr=True)
    table = Table(show_edge=False, pad_edge=False)
    table.add_column("outcome")
    table.add_column("equations", justify="right")
    for label, count in summary.rows():
        table.add_row(label, str(count))
    table.add_section()
    table.add_row("all", str(summary.total))
    console.print(table)
    if already_done:
        console.print(f"{already_done} more had been answered before")
    if summary.total and summary.slowest is not None:
        quantiles = f"median {summary.quantile(0.5):.2g} s, 90 % within {summary.quantile(0.9):.2g} s"
        slowest = f"slowest {summary.slowest.seconds:.2g} s (line {summary.slowest.number})"
        console.print(f"time of an equation: {quantiles}, {slowest}")
    console.print(f"{seconds:.1f} s in all, {summary.total / max(seconds, 1e-9):.0f} equations a second")


__all__ = ["ProgressMeter", "RateColumn", "print_summary"]
