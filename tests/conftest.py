"""Hypothesis profiles: `ci` (the default: the same examples every time), `dev` (random), `fuzz` (random, many), and
`mutation` (as `ci`, but a failure isn't made smaller).

Choose one with the environment variable HYPOTHESIS_PROFILE; KOVACIC_FUZZ sets the number of equations of the long run.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from pathlib import Path

import pytest

PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "ci")

#: The modules of `pytest -m quick`, with the examples in the docstrings of every room: arithmetic, the readers, the engine on
#: published equations, groups, closed forms, values with bounds, parameters, JSON, the commands' examples.
QUICK = {
    "test_algebra",
    "test_bad_primes",
    "test_cases",
    "test_enclosure_constants",
    "test_enclosure_defect",
    "test_enclosure_plot",
    "test_equation",
    "test_function_field",
    "test_galois",
    "test_help",
    "test_invariants",
    "test_jacobian",
    "test_json",
    "test_parameters",
    "test_parser",
    "test_public_names",
    "test_readme",
    "test_search_and_kernel",
    "test_textbook_equations",
    "test_verify",
    "test_written_solutions",
}

#: Where long_tests.txt and slow_tests.txt are; benchmarks/ordinary_suite.py writes them.
BY_LENGTH = Path(os.environ.get("KOVACIC_TESTS_BY_LENGTH", Path(__file__).parent / "data"))

# These are about shells, terminals and signals as POSIX has them.
collect_ignore = (
    ["batch/test_batch.py", "batch/test_batch_dask.py", "batch/test_batch_mixes.py", "cli/test_cli.py"]
    if sys.platform == "win32"
    else []
)


def pytest_configure(config: pytest.Config) -> None:
    """Register the profiles, but not in a process that gives the tests to others: they would wait for the import, 1 s."""
    if config.getoption("numprocesses", None):
        return
    from hypothesis import HealthCheck, Phase, settings

    quiet = [
        HealthCheck.too_slow,
        HealthCheck.filter_too_much,
        HealthCheck.data_too_large,
        HealthCheck.large_base_example,
    ]
    settings.register_profile(
        "ci", max_examples=25, deadline=None, derandomize=True, database=None, suppress_health_check=quiet
    )
    settings.register_profile("mutation", settings.get_profile("ci"), phases=[Phase.explicit, Phase.generate])
    settings.register_profile("dev", deadline=None, suppress_health_check=quiet)
    settings.register_profile("fuzz", deadline=None, database=None, suppress_health_check=quiet, print_blob=True)
    settings.load_profile(PROFILE)


def pytest_sessionstart() -> None:
    """Nothing that is collected is garbage: looking for it would take a third of the time of the collection."""
    gc.disable()


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    files = {name: BY_LENGTH / f"{name}_tests.txt" for name in ("long", "slow")}
    lengths = {
        test: name for name, file in files.items() if file.exists() for test in file.read_text("utf-8").splitlines()
    }
    for item in items:
        if item.nodeid in lengths:
            item.add_marker(lengths[item.nodeid])
        named = item.path.stem in QUICK or isinstance(item, pytest.DoctestItem)
        if item.get_closest_marker("slow") or PROFILE == "fuzz":
            item.add_marker(pytest.mark.timeout(6 * 3600))
        if named and not any(map(item.get_closest_marker, ("slow", "long"))):
            item.add_marker(pytest.mark.quick)


# In the background (`pytest &` in a script) an interrupt is ignored, and the processes that tests start and interrupt
# would inherit that; where this process handles it, they have the system's default.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# What is printed for a terminal has this width, whatever the terminal is from which the tests are started; so have the
# processes that tests start.
os.environ["COLUMNS"] = "80"
