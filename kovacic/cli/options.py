"""What several commands have in common: equations, limits and assumptions as arguments, answers, colours."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.main import BAD_INPUT, CHECK_FAILED, DECIDED, UNDECIDED, reported

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.limits import Limits
    from kovacic.solution import Solution


class OutputFile(click.Path):
    """A file that can be made: its folder is there, and its suffix one of those that are possible (any, by default)."""

    def __init__(self, suffixes: Sequence[str] = ()) -> None:
        super().__init__(dir_okay=False)
        self._suffixes = suffixes

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> Path:
        from pathlib import Path  # not for `kovacic solve`, which starts in less time without it

        path = Path(os.fsdecode(super().convert(value, parameter, context)))
        if not path.absolute().parent.is_dir():
            self.fail(f"there is no directory {path.parent}", parameter, context)
        if self._suffixes and path.suffix.lower() not in self._suffixes:
            self.fail(f"{path.suffix or 'no suffix'} isn't one of {', '.join(self._suffixes)}", parameter, context)
        return path


PICTURE = OutputFile((".png", ".svg", ".pdf"))

_COLUMNS = re.compile(r"\S {2,}\S")
_CODE = re.compile(r"\x1b\[\d*m")
_CODES = {"title": "1", "good": "32", "bad": "31", "unsure": "33", "faint": "2"}


def parse_limits(settings: Sequence[str]) -> Limits:
    """The default limits with the given changes, each `NAME=VALUE`.  Raises `click.UsageError`."""
    from kovacic.limits import DEFAULT_LIMITS

    limits = DEFAULT_LIMITS
    names = [field.name for field in fields(limits)]
    for setting in settings:
        name, separator, value = setting.partition("=")
        name = name.strip().replace("-", "_")
        if not separator or name not in names:
            raise click.UsageError(f"--limit {setting}: write NAME=VALUE, NAME one of {', '.join(names)}")
        try:
            number: Any = float(value) if name == "seconds" else int(value)
        except ValueError:
            raise click.UsageError(f"--limit {setting}: {value!r} isn't a number") from None
        if not number > 0:
            raise click.UsageError(f"--limit {setting}: a limit is positive")
        limits = replace(limits, **{name: number})
    return limits


def parse_assumptions(settings: Sequence[str]) -> dict[str, str] | None:
    """What is known about the parameters, each `NAME=WHAT` or an inequality; None without any.  Raises `click.UsageError`."""
    found: dict[str, str] = {}
    for setting in settings:
        match = re.fullmatch(r"\s*(\w+)\s*(=|>=|<=|!=|>|<)([^=<>].*)", setting)
        if match is None:
            raise click.UsageError(f"--assume {setting}: write NAME=WHAT, such as n=integer, n=3 or n>=0")
        name, relation, what = match[1], match[2], match[3].strip()
        found[name] = f"{found.get(name, '')} {relation if relation != '=' else ''}{what}".strip()
    return found or None


def _no_option(_: click.Context, __: click.Parameter, given: Any) -> Any:
    """Unknown options come through as expressions, because -x^2 is one; --jsn isn't."""
    for argument in (given,) if isinstance(given, str) else given:
        if argument.startswith("--") and argument[2:3].isalpha():
            raise click.UsageError(f"no such option: {argument} (write (--x) if it is an expression)")
    return given


#: What commands share; equations that begin with - aren't options.
equation_command = partial(click.command, context_settings={"ignore_unknown_options": True})
equation_argument = partial(click.argument, callback=_no_option)
VAR = click.option("--var", metavar="NAME", help="The name of the variable; by default the only symbol of S, or x.")
ASSUME = click.option(
    "--assume",
    metavar="NAME=WHAT",
    multiple=True,
    callback=lambda _, __, settings: parse_assumptions(settings),
    help="What is known about a parameter: n=integer, n>=0, n=3.",
)
LIMIT = click.option(
    "--limit",
    "limits",
    metavar="NAME=VALUE",
    multiple=True,
    callback=lambda _, __, settings: parse_limits(settings),
    help="Change a limit: seconds, degree, bits, digits, exponent, text_length, unknown_degree.",
)


def _watch(context: click.Context, _: click.Parameter, given: int) -> None:
    """With -v the routes that are taken are said on the error stream, with -vv every disc."""
    if given == 0:
        return
    import logging

    said = logging.StreamHandler()
    said.setFormatter(logging.Formatter("kovacic: %(message)s"))
    logger = logging.getLogger("kovacic")
    logger.addHandler(said)
    logger.setLevel(logging.INFO if given == 1 else logging.DEBUG)
    context.call_on_close(lambda: logger.removeHandler(said))


VERBOSE = click.option(
    "-v",
    "--verbose",
    count=True,
    expose_value=False,
    callback=_watch,
    help="Say which route is taken, with how many bits; -vv: every disc of Taylor's method.",
)


def answer_each(
    equations: Sequence[str],
    show: Callable[[Solution], Iterable[str]],
    *,
    var: str | None,
    limits: Limits,
    assume: dict[str, str] | None,
    gap: str,
) -> int:
    """Solve every equation and print the lines that `show` makes of it, each when it is there.

    The status is that of the most serious outcome.
    """
    from kovacic.decision import Status
    from kovacic.errors import KovacicError
    from kovacic.solution import solve

    outcomes = [DECIDED]
    between = ""
    for text in _expressions(equations):
        try:
            answer = solve(text, var=var, assume=assume, limits=limits)
            outcomes.append(UNDECIDED if answer.status is Status.UNDECIDED else DECIDED)
            for line in show(answer):
                print(between + line, flush=True)
                between = ""
            between = gap
        except KovacicError as error:
            outcomes.append(reported(error))
    return max(outcomes, key=(DECIDED, UNDECIDED, BAD_INPUT, CHECK_FAILED).index)


def _expressions(arguments: Sequence[str]) -> Iterator[str]:
    """The arguments, `-` standing for the lines of standard input; empty lines and those beginning with # are skipped."""
    for argument in arguments:
        if argument == "-":
            yield from (text for line in sys.stdin if (text := line.strip()) and not text.startswith("#"))
        else:
            yield argument


def fitted(text: str) -> str:
    """The text for a terminal: lines that are longer are broken at spaces, but for rows of tables; elsewhere as it is."""
    if not sys.stdout.isatty():
        return text
    from shutil import get_terminal_size

    width, lines = get_terminal_size().columns, []
    for line in text.splitlines():
        indent = " " * (len(line) - len(line.lstrip()) + 2)
        while len(_CODE.sub("", line)) > width and not _COLUMNS.search(line):
            end = len(line)
            while end > 0 and len(_CODE.sub("", line[:end])) > width:
                end = line.rfind(" ", len(indent), end)
            if end <= 0:  # a formula without spaces
                break
            lines.append(line[:end])
            line = indent + line[end:].lstrip()
        lines.append(line)
    return "\n".join(lines)


def styled(text: str, role: str) -> str:
    """`text` with the colour of its role, on a terminal that shows colours, unless NO_COLOR is set (https://no-color.org)."""
    wanted = sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
    return f"\x1b[{_CODES[role]}m{text}\x1b[0m" if wanted else text
