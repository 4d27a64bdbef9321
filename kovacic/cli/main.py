"""The entry point of the command, its subcommands, and what its exit status means.

0: everything was decided, either way; 2: bad input or usage; 3: undecided, a limit was reached; 4: an answer failed its
own check; 5: the output can't be written; 130: interrupted; 141: the reader of the output went away.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from contextlib import suppress
from enum import IntEnum
from importlib import import_module
from io import StringIO, TextIOWrapper

import click

import kovacic
from kovacic.errors import visible


class Exit(IntEnum):
    """The exit status of a command."""

    DECIDED = 0
    BAD_INPUT = 2
    UNDECIDED = 3
    CHECK_FAILED = 4
    NOT_WRITTEN = 5
    INTERRUPTED = 130
    PIPE_CLOSED = 141

    __repr__ = int.__repr__


#: By name: the module of kovacic.cli that has the click command of this name, and its line of help.
COMMANDS = {
    "solve": ("equations", "Decide equations y'' = S(x) y: two solutions, or a proof that there is none."),
    "dsolve": ("equations", "The general solution of an equation, or that with given initial values."),
    "evaluate": ("values", "Values of a solution with proven error bounds, to any number of digits."),
    "explain": ("equations", "The derivation, step by step, as a reader of Kovacic's paper follows it."),
    "conditions": ("values", "For which values of the parameters do Liouvillian solutions exist?"),
    "spectrum": ("values", "Which energies? The bound states of a potential, with wave functions and norms."),
    "eigenvalues": ("values", "Eigenvalues of boundary problems, as proven numbers."),
    "batch": ("many", "Decide many equations from a file, in parallel, with a result for every line."),
    "scan": ("many", "Tabulate the case over a grid of parameter values."),
    "check": ("equations", "Prove answers in JSON anew, by a program that shares no code with this one."),
    "ball": ("ball", "The ball on the sphere: its equation, its motion."),
    "plot": ("values", "Draw solutions."),
    "schema": ("equations", "The JSON Schema of what the commands print as JSON."),
}


class LazyGroup(click.Group):
    """A group that imports a command only when it is called: `kovacic solve` must not pay for plots."""

    def list_commands(self, context: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        module = import_module(f"kovacic.cli.{COMMANDS[name][0]}") if name in COMMANDS else None
        return getattr(module, name, None)

    def resolve_command(
        self, context: click.Context, arguments: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Resolve the command as click does, with a suggestion for a mistyped name."""
        if arguments[0] not in COMMANDS:
            from difflib import get_close_matches

            near = get_close_matches(arguments[0], COMMANDS, n=1, cutoff=0.5)
            known = f'the commands are {", ".join(COMMANDS)}; an equation follows one: kovacic solve "{arguments[0]}"'
            hint = f"did you mean {near[0]}?" if near else known
            context.fail(f"no such command: {arguments[0]} ({hint})")
        return super().resolve_command(context, arguments)

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """The list of commands, without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, what) for name, (_, what) in COMMANDS.items()])


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(kovacic.__version__, message="kovacic %(version)s")
def cli() -> None:
    """Liouvillian solutions of y'' = S(x) y, or a proof that there are none (Kovacic's algorithm).

    \b
    kovacic solve "x^2 + 3"
    kovacic solve --json "x" "-3/(16*x^2) + 1/x"

    Exit status: 0 decided (either way), 2 bad input or usage, 3 undecided (a limit was reached), 4 a self-check
    failed, 5 the output can't be written, 130 interrupted, 141 its reader went away.
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave the process with its exit status."""
    instruction = os.environ.get("_KOVACIC_COMPLETE")
    if instruction is not None:
        from click.shell_completion import shell_complete

        sys.exit(shell_complete(cli, {}, "kovacic", "_KOVACIC_COMPLETE", instruction))
    _open_closed_streams()
    # Formulas have ^ in whatever the command prints.
    warnings.formatwarning = lambda message, *_, **__: f"kovacic: {message}\n".replace("**", "^")
    for stream in (sys.stdin, sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # files and pipes are UTF-8 on every system
            encoding = None if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="backslashreplace")
    sys.exit(run(arguments))


def _open_closed_streams() -> None:
    """Replace the standard streams that the caller has closed (`<&-`, `>&-`, `2>&-`), which are None in Python.

    As in C, closed input fails when it is read and closed output when it is written to: these descriptors are open in the
    other direction only.  Closed standard error swallows everything; else `print` would put messages among the data.
    """
    for descriptor, name, mode, access in (
        (0, "stdin", "r", os.O_WRONLY),
        (1, "stdout", "w", os.O_RDONLY),
        (2, "stderr", "w", os.O_WRONLY),
    ):
        if getattr(sys, name) is None:
            null = os.open(os.devnull, access)
            if null != descriptor:
                os.dup2(null, descriptor)
                os.close(null)
            setattr(sys, name, open(descriptor, mode, encoding="utf-8"))  # noqa: SIM115 - open until the end


def run(arguments: Sequence[str] | None = None) -> int:
    """The exit status of a command line (by default that of the process)."""
    if arguments is None:
        arguments = sys.argv[1:]
    try:
        # Not cli.main(), which turns an interrupt and a closed pipe into exit statuses of its own.
        with cli.make_context("kovacic", list(arguments)) as context:
            status = cli.invoke(context)
        sys.stdout.flush()
        return status if isinstance(status, int) else Exit.DECIDED
    except click.exceptions.Exit as ending:
        return ending.exit_code
    except click.ClickException as error:
        said = StringIO()
        error.show(said)
        print(visible(said.getvalue()), end="", file=sys.stderr)
        return Exit.BAD_INPUT
    except kovacic.KovacicError as error:
        return reported(error)
    except (KeyboardInterrupt, click.Abort):
        print("kovacic: interrupted", file=sys.stderr)
        return Exit.INTERRUPTED
    except BrokenPipeError:
        return _given_up(Exit.PIPE_CLOSED)
    except OSError as error:
        with suppress(OSError):  # standard error may be full as well
            where = f" to {visible(str(error.filename))}" if error.filename else ""
            print(f"kovacic: the output can't be written{where}: {error.strerror}", file=sys.stderr)
        return _given_up(Exit.NOT_WRITTEN)


def _given_up(status: int) -> int:
    """The status after an output has failed; undrained streams would make Python complain again when it exits."""
    null = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            os.dup2(null, stream.fileno())
    return status


def reported(error: Exception) -> int:
    """Print an error to standard error; return its exit status."""
    said = error.for_shell() if isinstance(error, kovacic.InputError) else str(error)
    print(f"kovacic: {visible(said)}", file=sys.stderr)
    if isinstance(error, kovacic.InputError | ImportError):
        return Exit.BAD_INPUT
    return Exit.UNDECIDED if isinstance(error, kovacic.LimitExceeded) else Exit.CHECK_FAILED
