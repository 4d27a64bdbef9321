"""The work of the published equations, in operations, is what was recorded: a slower engine is noticed on any machine.

A change that is meant is accepted by `python benchmarks/operation_counts.py --accept`.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

import kovacic


@pytest.fixture(scope="module")
def operation_counts() -> ModuleType:
    path = Path(__file__).parents[2] / "benchmarks" / "operation_counts.py"
    spec = importlib.util.spec_from_file_location("operation_counts", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.long
def test_the_work_is_what_was_recorded(operation_counts: ModuleType) -> None:
    changes = operation_counts.differences(operation_counts.recorded(), operation_counts.measure())
    hint = "if the change is meant: python benchmarks/operation_counts.py --accept"
    assert not changes, "\n".join([*changes[:20], *changes[-4:], hint])


def test_work_is_counted(operation_counts: ModuleType) -> None:
    operation_counts.load_engine()
    with operation_counts.counting() as counts:
        kovacic.solve("-(3/16)/x^2 - (2/9)/(x-1)^2 + (3/16)/(x*(x-1))")
    assert counts.series_terms > 0
    assert counts.primes > 0
    assert counts.systems
    assert counts.verifications > 0
    with operation_counts.counting() as nothing:
        pass
    assert nothing == operation_counts.Counts()


def test_differences_are_reported(operation_counts: ModuleType) -> None:
    counts = {"series_terms": 1, "exact_terms": 0, "primes": 1, "systems": ["3x2"], "verifications": 2}
    assert operation_counts.differences({"a": counts}, {"a": counts}) == []
    changes = operation_counts.differences({"a": counts}, {"a": {**counts, "systems": ["3x2", "4x2"]}})
    assert changes[0] == "a: systems ['3x2'] -> ['3x2', '4x2']"
    assert operation_counts.differences({"a": counts}, {"a": counts, "b": counts})
