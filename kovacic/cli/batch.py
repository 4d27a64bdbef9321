"""`kovacic batch`: a file of equations in, an answer for every one of them out."""

from __future__ import annotations

from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.many import already_answered, answer_all, batch_options
from kovacic.cli.options import OutputFile, var_option

if TYPE_CHECKING:
    from kovacic.limits import Limits


@click.command()
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", type=OutputFile(), help="Append the answers to this file.")
@click.option("--resume", is_flag=True, help="Take an interrupted run up again: answer what the output file lacks.")
@click.option("--format", "form", type=click.Choice(["lines", "jsonl", "csv"]), help="By default by the file's name.")
@click.option("--ordered/--as-finished", default=True, show_default=True, help="The order of the answers.")
@click.option("--group", is_flag=True, help="Add the differential Galois group to each answer.")
@var_option
@batch_options
def command(
    file: str,
    output: Path | None,
    resume: bool,
    form: str | None,
    var: str | None,
    limits: Limits,
    **run: Any,
) -> int:
    """Decide every equation of FILE; "-" is standard input.

    FILE has an expression S a line, or JSON a line (a string, or an object with "S", perhaps "id" and "var"), or is a CSV
    table with a column S; any of them may be compressed with gzip.  The answers are JSON, schema 1, a line for every
    equation, with "line", its place in FILE.  A bad line gets an answer that says what is wrong with it.

    \b
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --memory 500
    kovacic batch equations.jsonl -o answers.jsonl --timeout 10 --resume
    generate | kovacic batch - --as-finished | jq .case

    Exit status: 0 all decided, 3 some undecided, 2 some bad input, 4 a self-check or a process failed, 5 the output can't
    be written.
    """
    from kovacic.batch.files import Answers, count_items, guess_format, opened, read_items

    done = already_answered(output, resume)
    form = form or guess_format(file)
    with ExitStack() as stack:
        items = read_items(stack.enter_context(opened(file)), form=form, var=var, limits=limits)
        write = stack.enter_context(Answers(output)).write
        count = None if file == "-" else partial(count_items, file, form=form)
        return answer_all(items, write, count=count, done=done, limits=limits, stream=file == "-", **run)
