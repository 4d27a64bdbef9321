"""Batches on Ray: a real instance on this machine, in a process of its own, which loses a worker on the way; skipped where
Ray isn't installed."""

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
import os
import signal
import subprocess
import threading
import time
import ray
from kovacic import solve_many

CHUNK = 100

def kill_a_worker():
    actors = []
    while not actors:
        time.sleep(0.1)
        shown = subprocess.run(["ps", "-eo", "pid,args"], capture_output=True, text=True).stdout
        processes = [line.split(maxsplit=1) for line in shown.splitlines()]
        actors = [int(pid) for pid, command in processes if command.startswith("ray::run_chunk")]
    time.sleep(0.5)
    os.kill(actors[0], signal.SIGKILL)
    print("killed")


if __name__ == "__main__":
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    equations = [f"x^2 + {k}" for k in range(2 * CHUNK)] + ["x +", "-3/(16*x^2) + 1/x"]
    for ordered in (True, False):
        records = solve_many(equations, backend="ray", jobs=2, ordered=ordered, timeout=60)
        print(json.dumps([(record.number, record.label) for record in records]))
    threading.Thread(target=kill_a_worker, daemon=True).start()
    records = solve_many(["x^2 + 3"] * (40 * CHUNK), backend="ray", jobs=2, timeout=60)
    print(json.dumps([(record.number, record.label) for record in records]))
"""


def test_every_equation_has_one_answer_even_if_a_worker_is_lost() -> None:
    environment = {**os.environ, "RAY_AUTH_MODE": "disabled", "RAY_USAGE_STATS_ENABLED": "0"}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, timeout=240, env=environment
    )
    lines = [line for line in done.stdout.splitlines() if line.startswith(("[[", "killed"))]
    assert "killed" in lines[:-1]
    ordered, finished, survived = ([tuple(pair) for pair in json.loads(line)] for line in lines if line != "killed")
    odd = {k for k in range(200) if k % 2}  # y'' = (x^2 + k) y is solvable for odd k
    expected = [(k + 1, "case 1" if k in odd else "none") for k in range(200)] + [(201, "bad input"), (202, "case 2")]
    assert ordered == expected
    assert sorted(finished) == expected
    assert survived == [(k, "case 1") for k in range(1, len(survived) + 1)]
    assert len(survived) == 4000
