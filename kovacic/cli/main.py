"""The entry point of the command, and what its exit status means.

0: everything was decided, either way; 2: bad input or usage; 3: undecided, a limit was reached; 4: an answer failed its
own check; 130: interrupted; 141: the reader of the output went away.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

DECIDED, BAD_INPUT, UNDECIDED, CHECK_FAILED, INTERRUPTED, PIPE_CLOSED = 0, 2, 3, 4, 130, 141


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave the process with its exit status."""
    sys.exit(run(arguments))


def run(arguments: Sequence[str] | None = None) -> int:
    """The exit status of a command line (by default that of the process)."""
    try:
        return _run(arguments)
    except KeyboardInterrupt:
        print("kovacic: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # Python would complain once more when it flushes standard output at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return PIPE_CLOSED


def _run(arguments: Sequence[str] | None) -> int:
    import click

    from kovacic.cli.group import cli
    from kovacic.errors import InputError, LimitExceeded, VerificationFailed

    try:
        # Not cli.main(), which turns an interrupt and a closed pipe into exit statuses of its own.
        with cli.make_context("kovacic", list(sys.argv[1:] if arguments is None else arguments)) as context:
            status = cli.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as ending:
        return ending.exit_code
    except click.Abort:
        raise KeyboardInterrupt from None
    except click.ClickException as error:
        error.show()
        return BAD_INPUT
    except InputError as error:
        print(f"kovacic: {error}", file=sys.stderr)
        return BAD_INPUT
    except LimitExceeded as error:
        print(f"kovacic: {error}", file=sys.stderr)
        return UNDECIDED
    except VerificationFailed as error:
        print(f"kovacic: {error}", file=sys.stderr)
        return CHECK_FAILED
    return status if isinstance(status, int) else DECIDED
