"""The records of planted faults name code that is there; a record of what was changed since is forgotten, or made anew."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.long
def test_the_records_name_living_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(BENCHMARKS), *sys.path])
    import mutation

    file = mutation.RESULTS / "wrong_answers.json"
    passed = {one["fault"] for row in json.loads(file.read_text(encoding="utf-8")).values() for one in row["passed"]}
    stale = sorted((mutation.named() | passed) - mutation.living())
    assert not stale, "\n".join([*stale[:10], "python benchmarks/mutation.py --prune"])
    written = (mutation.RESULTS / "mutation.md").read_text(encoding="utf-8")
    survivors = {name for found in mutation.stored().values() for name in found["survived"]}
    assert {line for line in written.splitlines() if line.startswith("- kovacic/")} == {
        f"- {name}: {mutation.EXPLAINED.get(name, '**not explained**')}" for name in survivors
    }
