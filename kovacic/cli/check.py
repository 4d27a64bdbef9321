"""`kovacic check`: answers in JSON, proven anew by a program that shares no code with this one."""

from __future__ import annotations

import click


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True)
def command(files: tuple[str, ...]) -> int:
    """Check answers that `kovacic solve --json` or `kovacic batch` wrote, one a line; "-" reads standard input.

    \b
    kovacic solve --json --full "x^2 + 3" "x" | kovacic check -

    Says "checked", "refuted: why", "not checked: why" or "unreadable: why" for each line.  The checker is one file that
    also runs alone, kovacic/checker.py, and begins with what it proves.

    Exit status: 0 all checked, 1 one refuted, 2 a file or a line unreadable, 3 one not checked; the first of 1, 2, 3
    that applies.
    """
    from kovacic.checker import main

    return main(list(files))
