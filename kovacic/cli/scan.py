"""`kovacic scan`: the case and the group over grids of exact parameter values."""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.many import already_answered, answer_all, batch_options
from kovacic.cli.options import PICTURE, OutputFile, equation_argument, equation_command

if TYPE_CHECKING:
    from kovacic.batch.records import Record
    from kovacic.batch.scan import Grid


@equation_command()
@equation_argument("expression", metavar="S")
@equation_argument("ranges", metavar="NAME=START:STOP:STEP...", nargs=-1, required=True)
@click.option("-o", "--output", type=OutputFile(), help="Write to this file.")
@click.option("--resume", is_flag=True, help="Take an interrupted scan up again (JSONL).")
@click.option("--format", "form", type=click.Choice(["jsonl", "csv"]), help="By default by the name of the output.")
@click.option("--map", "picture", type=PICTURE, help="Draw two parameters as a map (png, pdf, svg).")
@click.option("--group/--no-group", default=True, show_default=True, help="The differential Galois group.")
@click.option("--var", metavar="NAME", help="The name of the variable; by default x, or what isn't a parameter.")
@batch_options
def command(
    expression: str,
    ranges: tuple[str, ...],
    output: Path | None,
    resume: bool,
    form: str | None,
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
    from kovacic.batch.map import draw_map
    from kovacic.batch.scan import parse_grid, scan_items

    grids = [parse_grid(text) for text in ranges]
    if picture is not None and len(grids) != 2:
        raise click.UsageError("a map needs two parameters")
    form = form or ("csv" if output is not None and output.suffix == ".csv" else "jsonl")
    if resume and form == "csv":
        raise click.UsageError("--resume needs --output FILE.jsonl, the file of the interrupted scan")
    done = already_answered(output, resume)
    labels = dict(done.labels)
    items = scan_items(expression, grids, var=var)
    with ExitStack() as stack:
        write = _writer(stack, output, form, grids)

        def noted(record: Record) -> None:
            write(record)
            if picture is not None:
                labels[record.number] = record.label

        status = answer_all(items, noted, count=lambda: prod(map(len, grids)), done=done, **run)
    if picture is not None:
        draw_map(expression, (grids[0], grids[1]), labels, picture)
    return status


def _writer(stack: ExitStack, output: Path | None, form: str, grids: Sequence[Grid]) -> Callable[[Record], None]:
    """The function that writes a record, at once."""
    from kovacic.batch.files import Answers
    from kovacic.batch.scan import columns, row

    if form == "jsonl":
        return stack.enter_context(Answers(output)).write
    stream = sys.stdout
    if output is not None:
        stream = stack.enter_context(output.open("w", encoding="utf-8", newline=""))
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(columns(grids))

    def write_row(record: Record) -> None:
        table.writerow(row(record))
        stream.flush()

    return write_row
