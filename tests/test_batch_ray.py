"""Batches on Ray: a real instance on this machine, in a process of its own; skipped where Ray isn't installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib.util import find_spec

import pytest

pytestmark = pytest.mark.skipif(find_spec("ray") is None, reason="Ray isn't installed")

# More than two chunks, with a bad line among them.
SCRIPT = """
import json
import ray
from kovacic import solve_many
from kovacic.batch.backends import CHUNK

if __name__ == "__main__":
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    equations = [f"x^2 + {k}" for k in range(2 * CHUNK)] + ["x +", "-3/(16*x^2) + 1/x"]
    for ordered in (True, False):
        records = solve_many(equations, backend="ray", jobs=2, ordered=ordered, timeout=60)
        print(json.dumps([(record.number, record.label) for record in records]))
"""


def test_every_equation_has_one_answer() -> None:
    environment = {**os.environ, "RAY_AUTH_MODE": "disabled", "RAY_USAGE_STATS_ENABLED": "0"}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, timeout=240, env=environment
    )
    ordered, finished = ([tuple(pair) for pair in json.loads(line)] for line in done.stdout.splitlines()[-2:])
    odd = {k for k in range(200) if k % 2}  # y'' = (x^2 + k) y is solvable for odd k
    expected = [(k + 1, "case 1" if k in odd else "none") for k in range(200)] + [(201, "bad input"), (202, "case 2")]
    assert ordered == expected
    assert sorted(finished) == expected
