"""The exceptions of the package: what went wrong, for whom, and what to do about it.

A mathematical "no" is a value, never an exception.  An exhausted budget is a value as well: the engine turns
`LimitExceeded` into the status UNDECIDED, with the limit's own sentence as the reason.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial


def visible(text: str) -> str:
    r"""The text for a terminal: unprintable characters, except line ends, become a backslash and a code.

    >>> visible("x\x1b[31m + \u202e1")
    'x\\x1b[31m + \\u202e1'
    """
    if text.isprintable():
        return text
    return "".join(
        char if char.isprintable() or char == "\n" else char.encode("unicode_escape").decode("ascii") for char in text
    )


# Characters of an offending part that a message shows.
_LONGEST_PART = 200


class KovacicError(Exception):
    """Base class of every exception that this package raises on purpose."""


class InputError(KovacicError, ValueError):
    """The input isn't an equation that the package can treat.

    Attributes: `text`, the whole input if it is text; `position`, the 0-based offset of the offending part, None unless the
    input is text, and `length`, its length; `hint`, the remedy in Python, and `shell`, the remedy on the command line.
    """

    def __init__(
        self,
        message: str,
        *,
        text: str | None = None,
        position: int | None = None,
        length: int = 1,
        hint: str | None = None,
        shell: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.text = text
        self.position = position
        self.length = length
        self.hint = hint
        self.shell = hint if shell is None else shell

    @property
    def excerpt(self) -> str | None:
        """The offending part of the text."""
        return None if self.text is None or self.position is None else self.text[self.position :][: self.length]

    def __str__(self) -> str:
        return self._told(self.hint)

    def for_shell(self) -> str:
        """The message of `str` with the hint for the command line."""
        return self._told(self.shell)

    def _told(self, hint: str | None) -> str:
        parts = [self.message]
        if self.text is not None and self.position is not None:
            # The text around the offending part, in one line, and below it a line that marks the part.
            start = self.position
            end = start + max(self.length, 1)
            before, part, after = (
                visible(piece.replace("\n", " "))
                for piece in (self.text[max(0, start - 30) : start], self.text[start:end], self.text[end : end + 30])
            )
            if len(part) > _LONGEST_PART:
                part = f"{part[: _LONGEST_PART // 2]}...{part[-_LONGEST_PART // 4 :]}"
            marker = " " * len(before) + "^" * max(1, min(len(part), 40))
            parts.append(f"  at position {start}:\n    {before}{part}{after}\n    {marker}")
        if hint:
            parts.append(f"  hint: {hint}")
        return visible("\n".join(parts))


class ParseError(InputError):
    """The text isn't an expression of the grammar."""


class NotRational(InputError):
    """The expression is readable, but isn't a rational function of one variable with constant coefficients."""


class NotLinear(InputError):
    """The equation is readable, but isn't linear of second order."""


class UnsatisfiableConditions(InputError):
    """No solution of the equation has all of the given values, or satisfies all of the conditions."""


class LimitExceeded(KovacicError):
    """A limit of `kovacic.limits.Limits` was reached; `limit` is the name of its field."""

    def __init__(self, message: str, *, limit: str) -> None:
        super().__init__(message)
        self.limit = limit

    def __reduce__(self) -> tuple[object, ...]:
        return partial(LimitExceeded, limit=self.limit), self.args


class VerificationFailed(KovacicError):
    """A result of the engine did not pass its own exact check: a defect of this package, please report it."""


class MissingExtra(KovacicError, ImportError):
    """An optional dependency isn't installed; the message has the command that installs it."""


#: The package in the index, where the module that is imported has another name.
_DISTRIBUTION_OF = {"flint": "python-flint"}


@contextmanager
def needs(extra: str, what: str) -> Iterator[None]:
    """A block whose imports belong to this extra of `pyproject.toml`; `what` names the feature that needs them."""
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("kovacic"):
            raise
        module = error.name.partition(".")[0]
        missing = _DISTRIBUTION_OF.get(module, module)
        declared = _packages_of(extra)
        if not any(package.startswith(missing) for package in declared):
            declared = [missing]  # without the extra's metadata, or a package that is needed in any case
        packages = " ".join(f"'{package}'" for package in declared)
        raise MissingExtra(f"{what} needs {missing}: pip install {packages}") from error


def _packages_of(extra: str) -> list[str]:
    """The packages that an extra of `pyproject.toml` stands for, as the installed package's own metadata has them."""
    # Imported where something is missing: reading metadata costs more than most commands.
    from importlib.metadata import PackageNotFoundError, requires

    try:
        declared = requires("kovacic") or []
    except PackageNotFoundError:
        return []
    ending = f"; extra == '{extra}'"
    return [line.removesuffix(ending) for line in declared if line.endswith(ending)]


def warn_user(text: str, category: type[Warning] = UserWarning) -> None:
    """A warning at the line that called the package: a public function may call another one, or be called through a wrapper."""
    package = __name__.partition(".")[0]
    frame = sys._getframe()
    level = 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == package:
        frame = frame.f_back
        level += 1
    warnings.warn(text, category, stacklevel=level)


def former_names(module: str, names: Mapping[str, type]) -> Callable[[str], type]:
    """A module's `__getattr__` for names of version 0.2, with a warning."""

    def found(name: str) -> type:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        warn_user(f"{module}.{name} is called {names[name].__name__} now", DeprecationWarning)
        return names[name]

    return found
