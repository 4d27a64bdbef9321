"""Colours for a terminal, and none elsewhere."""

from __future__ import annotations

import os
import sys
from typing import TextIO

_CODES = {"title": "1", "good": "32", "bad": "31", "unsure": "33", "faint": "2"}


def wants_colour(stream: TextIO) -> bool:
    """Is this a terminal that can show colours, and hasn't the user asked for none (https://no-color.org)?"""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def styled(text: str, role: str) -> str:
    """`text` with the colour of its role, where standard output wants colours."""
    return f"\x1b[{_CODES[role]}m{text}\x1b[0m" if wants_colour(sys.stdout) else text
