"""The group of subcommands, each imported only when it is called: the start of `kovacic solve` must not pay for plots."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec

import click

# Name: what it does.  The module kovacic.cli.<name> has the click command as `command`.
COMMANDS = {
    "solve": "Decide equations y'' = S(x) y: omega and its polynomial, or a proof that there is none.",
    "explain": "The derivation, step by step, as a reader of Kovacic's paper follows it.",
    "conditions": "For which values of the parameters do Liouvillian solutions exist?",
    "batch": "Decide many equations from a file, in parallel, with a result for every line.",
    "scan": "Tabulate the case over a grid of parameter values.",
    "ball": "The ball on the sphere: its equation, its motion.",
    "plot": "Draw solutions.",
}


class LazyGroup(click.Group):
    """A group that knows its commands by name and imports one at a time."""

    def list_commands(self, context: click.Context) -> list[str]:
        return [name for name in COMMANDS if find_spec(f"kovacic.cli.{name}") is not None]

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        if name not in self.list_commands(context):
            return None
        command = import_module(f"kovacic.cli.{name}").command
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """The list of commands, without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, COMMANDS[name]) for name in self.list_commands(context)])


def _print_version(context: click.Context, parameter: click.Parameter, value: bool) -> None:
    if value and not context.resilient_parsing:
        from kovacic import __version__

        click.echo(f"kovacic {__version__}")
        context.exit()


@click.group(cls=LazyGroup)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version, help="Show the version."
)
def cli() -> None:
    """Liouvillian solutions of y'' = S(x) y, or a proof that there are none (Kovacic's algorithm).

    \b
    kovacic solve "x^2 + 3"
    kovacic solve --json "x" "-3/(16*x^2) + 1/x"

    Exit status: 0 decided (either way), 2 bad input or usage, 3 undecided (a limit was reached), 4 a self-check
    failed, 130 interrupted.
    """
