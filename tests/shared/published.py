"""The published equations of `data/cases.jsonl`: one JSON object a line, with the answer and its source."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

FILE = Path(__file__).parents[1] / "data" / "cases.jsonl"


@dataclass(frozen=True)
class Published:
    """`case` is Kovacic's, None where there is no Liouvillian solution; `group` is that of the normal form."""

    id: str
    S: str
    case: int | None
    group: str
    source: str
    solution: str | None = None
    coefficients: tuple[str, str, str] | None = None

    @property
    def omega_degree(self) -> int | None:
        """The least degree of omega over C(x): 1, 2, or 4, 6, 12 for the tetrahedral, octahedral, icosahedral group."""
        if self.case in (1, 2, None):
            return self.case
        return {"A4": 4, "S4": 6, "A5": 12}[self.group[:2]]


def load() -> list[Published]:
    """All entries, in the order of the file."""
    entries = []
    for line in FILE.read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        given = (row["a"], row["b"], row["c"]) if "a" in row else None
        kept = {key: row[key] for key in ("id", "S", "case", "group", "source", "solution") if key in row}
        entries.append(Published(**kept, coefficients=given))
    return entries
