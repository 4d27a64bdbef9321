"""Shared by the commands: equations, limits and assumptions as arguments, answers, colours."""

from __future__ import annotations

import os
import re
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import fields, replace
from functools import partial, reduce, wraps
from itertools import chain, islice, repeat
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.core import ParameterSource

from kovacic.cli.main import Exit, reported
from kovacic.errors import InputError, KovacicError, NotLinear

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.limits import Limits
    from kovacic.solution import Solution


CommandFunction = TypeVar("CommandFunction", bound=Callable[..., Any])


class OutputFile(click.Path):
    """A file that can be written: its folder exists, and its suffix is one of the given ones (any, by default)."""

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

_TABLE_ROW = re.compile(r"\S {2,}\S")
_CODES = {"title": "1", "good": "32", "bad": "31", "unsure": "33", "faint": "2"}


#: Of `kovacic.as_code`.
CODE_FORMS = ("mathematica", "maple", "julia")
#: The formats of documents, by the suffixes of files.
DOCUMENTS = {".txt": "text", ".md": "markdown", ".tex": "latex", ".html": "html"}


def formats(
    suffixes: Mapping[str, str] = DOCUMENTS, *, default: str = "text", **helps: str
) -> Callable[[CommandFunction], CommandFunction]:
    """The options --json, --latex, --as and --format of a command that have a help text here; they exclude each other.

    The command gets one keyword `form`, for `in_form`: "json"; "formula" for --latex; the language of --as; the value of
    --format or of the suffix of --output, one of the `suffixes`; or the default.
    """
    settings: dict[str, tuple[str, dict[str, Any]]] = {
        "json": ("--json", {"flag_value": "json"}),
        "latex": ("--latex", {"flag_value": "formula"}),
        "code": ("--as", {"type": click.Choice(CODE_FORMS)}),
        "format": ("--format", {"type": click.Choice([*suffixes.values()])}),
    }

    def decorate(command: CommandFunction) -> CommandFunction:
        @wraps(command)
        def with_form(*arguments: Any, **given: Any) -> Any:
            asked = {settings[name][0]: given.pop(f"form_{name}", None) for name in helps}
            chosen = {name: value for name, value in asked.items() if value}
            if len(chosen) > 1:
                raise click.UsageError(f"{' and '.join(chosen)} exclude each other")
            if not chosen and given.get("output") is not None:
                chosen["--output"] = suffixes.get(given["output"].suffix.lower(), default)
            return command(*arguments, form=next(iter(chosen.values()), default), **given)

        for name, text in reversed(helps.items()):
            option, attributes = settings[name]
            with_form = click.option(option, f"form_{name}", help=text, **attributes)(with_form)
        return with_form  # type: ignore[return-value]

    return decorate


def in_form(form: str, *, others: Callable[..., Any], **writers: Callable[..., Any]) -> Callable[..., Any]:
    """The writer of this form, or that of all others."""
    return writers.get(form, others)


def _named_settings(option: str, given: Sequence[str], form: str) -> dict[str, str]:
    """The settings `NAME=VALUE` of a repeated option.  Raises `click.UsageError`, also for a name that is set twice."""
    found: dict[str, str] = {}
    for setting in given:
        name, _, value = (part.strip() for part in setting.partition("="))
        if not (name and value):
            raise click.UsageError(f"{option} {setting}: write {form}")
        if name in found:
            raise click.UsageError(f"{option} {setting}: {name} is {found[name]} already")
        found[name] = value
    return found


def _changed_limits(context: click.Context, _: click.Parameter, given: Sequence[str]) -> Limits:
    """The default limits with the given changes."""
    from kovacic.limits import DEFAULT_LIMITS

    names = [field.name for field in fields(DEFAULT_LIMITS)]
    form = f"NAME=VALUE, NAME one of {', '.join(names)}, VALUE a positive number"
    changes: dict[str, Any] = {}
    for spelling, value in _named_settings("--limit", given, form).items():
        name = spelling.replace("-", "_")
        is_known = name in names and name not in changes
        with suppress(ValueError):
            changes[name] = float(value) if name == "seconds" else int(value)
        if not (is_known and changes.get(name, 0) > 0):
            raise click.UsageError(f"--limit {spelling}={value}: write {form}, each once")
    return replace(DEFAULT_LIMITS, **changes)


def _assumptions(context: click.Context, _: click.Parameter, given: Sequence[str]) -> dict[str, str] | None:
    """The assumptions about parameters, joined to one text for each name; None without any."""
    from kovacic.reading.substitution import relations, values_among

    found: dict[str, str] = {}
    # A comma before a name and a sign separates: a>3, a<5.
    for setting in chain.from_iterable(re.split(r",\s*(?=\w+\s*[<>=!])", text) for text in given):
        told = relations(setting)
        if told is None:
            match = re.fullmatch(r"\s*(\w+)\s*(=|>=|<=|!=|>|<)([^=<>].*)", setting)
            if match is None:
                raise click.UsageError(f"--assume {setting}: write NAME=WHAT, such as n=integer, n=3, n>=0 or 0<n<20")
            told = match[1], f"{match[2].removeprefix('=')}{match[3].strip()}"
        name, what = told
        joined = f"{found.get(name, '')} {what}".strip()
        if name in found and values_among({name: joined})[0]:  # a value beside something else
            raise click.UsageError(f"--assume {setting}: {name} is {found[name]} already")
        found[name] = joined
    return found or None


class Command(click.Command):
    """A command that refuses a value given twice: click would silently take the last one."""

    def parse_args(self, context: click.Context, args: list[str]) -> list[str]:
        _, _, order = self.make_parser(context).parse_args(list(args))
        for parameter, count in Counter(order).items():
            if not isinstance(parameter, click.Option) or parameter.multiple or parameter.is_flag or parameter.count:
                continue
            if count > 1:
                raise click.UsageError(f"{max(parameter.opts, key=len)} is given {count} times", context)
        return super().parse_args(context, args)


def is_given(name: str) -> bool:
    """True if the parameter of the current command was given on the command line."""
    return click.get_current_context().get_parameter_source(name) is ParameterSource.COMMANDLINE


def refuse(names: Iterable[str], beside: str) -> None:
    """Raise `click.UsageError` if one of these parameters was given: it would have no effect, and `beside` says why."""
    for parameter in click.get_current_context().command.params:
        if parameter.name in names and is_given(parameter.name or ""):
            raise click.UsageError(f"{max(parameter.opts, key=len)} has no effect {beside}")


class EquationCommand(Command):
    """A command with expressions among its arguments: anything but the exact name of an option, even -x^2 and -j*x.

    -j4 and -vv are options as well.  Two minus signs and a word are always an option, perhaps a misspelt one.
    """

    def parse_args(self, context: click.Context, args: list[str]) -> list[str]:
        arguments, doubtful = self._told_apart(args)
        try:
            return super().parse_args(context, arguments)
        except click.UsageError as error:
            if not doubtful:
                raise
            how = f"(an expression that looks like an option goes last, after --: -- '{doubtful[0]}')"
            raise click.UsageError(f"{error.format_message()} {how}", context) from error

    def _told_apart(self, arguments: Sequence[str]) -> tuple[list[str], list[str]]:
        """The arguments with a space before each expression that begins with -; and those that may be misspelt options."""
        options: dict[str, click.Option | None] = {"-h": None, "--help": None}
        for parameter in self.params:
            if isinstance(parameter, click.Option):
                options |= dict.fromkeys([*parameter.opts, *parameter.secondary_opts], parameter)
        found: list[str] = []
        doubtful: list[str] = []
        rest = iter(arguments)
        for argument in rest:
            if argument == "--":
                return [*found, argument, *rest], doubtful
            option = options.get(argument)
            if option is not None and not (option.is_flag or option.count):
                found += [argument, *islice(rest, option.nargs)]
                continue
            found.append(f" {argument}" if _is_expression(argument, options) else argument)
            is_unknown_word = argument.startswith("--") and argument.partition("=")[0] not in options
            if is_unknown_word or argument[:2] in options:
                doubtful.append(argument)
        return found, doubtful


def _is_expression(argument: str, options: Mapping[str, click.Option | None]) -> bool:
    """True if the argument begins with a minus sign, and isn't one of the `options`, known by all of their names."""
    if argument[:1] != "-" or argument == "-" or argument in options:
        return False
    option = options.get(argument[:2])
    is_number = option is not None and isinstance(option.type, click.IntRange) and argument[2:].isdigit()
    is_repeated = option is not None and option.count and set(argument[1:]) == {argument[1]}
    return not (is_number or is_repeated or re.match("--[^\\W\\d_]", argument))


equation_command = partial(click.command, cls=EquationCommand)
VAR = click.option(
    "--var",
    metavar="NAME",
    help="The name of the variable; by default the only symbol of S, or x; in an equation what y is applied to, x, "
    "or the one of t, z, s, r, ... that occurs.",
)
PARAM = click.option(
    "--param",
    "params",
    metavar="NAME=NUMBER",
    multiple=True,
    callback=lambda _, __, given: _named_settings("--param", given, "NAME=NUMBER, such as n=1/2") or None,
    help="The value of a parameter: n=1/2, a=sqrt(2).",
)
ASSUME = click.option(
    "--assume",
    metavar="NAME=WHAT",
    multiple=True,
    callback=_assumptions,
    help="What is known about a parameter: n=integer, n>=0, 0<n<20, n!=1, n=3, n=m^2.",
)
DECLARED = click.option(
    "--names",
    "parameters",
    metavar="NAME",
    multiple=True,
    help="A parameter whose name has more than one letter: --names EI, --names mass.",
)
LIMIT = click.option(
    "--limit",
    "limits",
    metavar="NAME=VALUE",
    multiple=True,
    callback=_changed_limits,
    help="Change a limit: seconds, degree, bits, terms, digits, exponent, text_length, unknown_degree.",
)


def together(*options: Any) -> Callable[[CommandFunction], CommandFunction]:
    """Several options as one decorator, in the order of the help."""

    def decorate(command: CommandFunction) -> CommandFunction:
        return reduce(lambda decorated, option: option(decorated), reversed(options), command)

    return decorate


#: The options of a command that reads equations.
PROBLEM = together(VAR, DECLARED, ASSUME, LIMIT)


def _watch(context: click.Context, _: click.Parameter, given: int) -> None:
    """Log the routes that are taken (-v), or every disc (-vv), to the error stream."""
    if given == 0:
        return
    import logging

    said = logging.StreamHandler()
    said.setFormatter(logging.Formatter("kovacic: %(message)s"))
    logger = logging.getLogger("kovacic")
    level = logger.level

    def unwatch() -> None:
        logger.removeHandler(said)
        logger.setLevel(level)

    logger.addHandler(said)
    logger.setLevel(logging.INFO if given == 1 else logging.DEBUG)
    context.find_root().call_on_close(unwatch)  # a subcommand whose other arguments are wrong has no end of its own


VERBOSE = click.option(
    "-v",
    "--verbose",
    count=True,
    expose_value=False,
    callback=_watch,
    help="Say which route is taken, with how many bits; -vv: every disc of Taylor's method.",
)


#: Seconds between two states of a line that shows progress.
_REFRESH = 0.2


@contextmanager
def waiting(what: str, *, patience: float = 1.0) -> Iterator[None]:
    """Inside `with`, after `patience` seconds, a terminal shows a moving bar and the time; both vanish at the end."""
    if not sys.stderr.isatty() or os.environ.get("TERM") == "dumb":
        yield
        return
    over = threading.Event()

    def show() -> None:
        start = time.monotonic()
        if over.wait(patience):
            return

        def elapsed(_: object) -> str:
            return f"{time.monotonic() - start:.0f} s"

        with click.progressbar(repeat(None), label=what, item_show_func=elapsed, width=10, file=sys.stderr) as bar:
            for _ in bar:
                if over.wait(_REFRESH):
                    break
        click.echo("\x1b[1A\x1b[2K", nl=False, err=True)  # the line of the bar

    shown = threading.Thread(target=show, daemon=True)
    shown.start()
    try:
        yield
    finally:
        over.set()
        shown.join()


def answer_each(
    equations: Sequence[str],
    show: Callable[[Solution], Iterable[str]],
    *,
    var: str | None,
    limits: Limits,
    assume: dict[str, str] | None,
    parameters: Sequence[str],
    gap: str,
    refuse: Callable[[str, KovacicError], None] | None = None,
) -> int:
    """Solve every equation and print the lines of `show`, each as soon as it is found; return the worst exit status.

    `refuse` is called with each text without an answer and the error, which is printed in any case.
    """
    from kovacic.decision import Status
    from kovacic.solution import solve

    outcomes: list[int] = [Exit.DECIDED]
    between = ""
    for text in _expressions(equations):
        try:
            with waiting("deciding"):
                answer = solve(text, var=var, assume=assume, parameters=parameters, limits=limits)
            is_open = answer.status is Status.UNDECIDED and not answer.assumed
            outcomes.append(Exit.UNDECIDED if is_open else Exit.DECIDED)
            lines = iter(show(answer))
            while True:
                with waiting("writing"):
                    line = next(lines, None)
                if line is None:
                    break
                print(between + line, flush=True)
                between = ""
            between = gap
        except KovacicError as error:
            if refuse is not None:
                refuse(text, error)
            outcomes.append(reported(error))
    return max(outcomes, key=(Exit.DECIDED, Exit.UNDECIDED, Exit.BAD_INPUT, Exit.CHECK_FAILED).index)


def say_reading(equation: str, var: str | None, names: Sequence[str] = ()) -> None:
    """Print how an equation was read to the error stream, if anything was guessed or a parameter isn't among the names."""
    from kovacic.equation import parameters_of
    from kovacic.limits import DEFAULT_LIMITS
    from kovacic.reading.pieces import Paste
    from kovacic.reading.read import read_input

    with suppress(KovacicError):  # the command says what is wrong
        paste = Paste(equation)
        try:
            parsed: Any = read_input(paste, var=var, names=names)
            parameters = {*parameters_of(parsed.S.field)}
        except NotLinear:
            from kovacic.general_solution.first_order import read_first_order

            parsed = read_first_order(paste, None, var, DEFAULT_LIMITS, names)
            parameters = {*parsed.letters} - {parsed.x.name} if parsed else set()
        if parsed and parsed.reading and (parsed.guesses or not parameters <= {*names}):
            click.echo(f"kovacic: read as {parsed.reading}", err=True)


def _expressions(arguments: Sequence[str]) -> Iterator[str]:
    """The arguments, `-` standing for the lines of standard input; empty lines and those beginning with # are skipped."""
    for argument in arguments:
        if argument != "-":
            yield argument
            continue
        try:
            yield from (text for line in sys.stdin if (text := line.strip()) and not text.startswith("#"))
        except OSError as error:
            raise InputError(f"standard input can't be read: {error.strerror}") from None


def fitted(text: str) -> str:
    """The text with long lines broken at spaces, except rows of tables, for a terminal; unchanged for a file or a pipe."""
    if not sys.stdout.isatty():
        return text
    from shutil import get_terminal_size

    width = get_terminal_size().columns
    lines = []
    for line in text.splitlines():
        indent = " " * (len(line) - len(line.lstrip()) + 2)
        while len(click.unstyle(line)) > width and not _TABLE_ROW.search(line):
            end = len(line)
            while end > 0 and len(click.unstyle(line[:end])) > width:
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
