"""What several commands have in common: limits, and equations from arguments or standard input."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from kovacic.limits import Limits


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
    """What is known about the parameters, each `NAME=WHAT`; None without any.  Raises `click.UsageError`."""
    found: dict[str, str] = {}
    for setting in settings:
        name, separator, what = setting.partition("=")
        if not separator:
            raise click.UsageError(f"--assume {setting}: write NAME=WHAT, such as n=integer")
        found[name.strip()] = f"{found.get(name.strip(), '')} {what.strip()}".strip()
    return found or None


def expressions(arguments: Sequence[str]) -> Iterator[str]:
    """The arguments, `-` standing for the lines of standard input; empty lines and those beginning with # are skipped."""
    for argument in arguments:
        if argument == "-":
            for line in sys.stdin:
                text = line.strip()
                if text and not text.startswith("#"):
                    yield text
        else:
            yield argument


def refuse_options(arguments: Sequence[str]) -> None:
    """Unknown options come through as expressions, because -x^2 is one; --jsn isn't."""
    for argument in arguments:
        if argument.startswith("--") and argument[2:3].isalpha():
            raise click.UsageError(f"no such option: {argument} (write (--x) if it is an expression)")
