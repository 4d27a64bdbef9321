"""A batch on a real Dask scheduler with two worker processes on the loopback interface, one of them killed on the way."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest
from batch_lines import answers_of, lines_of, random_runs
from processes import started

import kovacic
from kovacic import InputError

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(find_spec("distributed") is None, reason="needs dask.distributed"),
    # Dask's sockets are closed by its event loop, which ends with the process.
    pytest.mark.filterwarnings("default"),
]

#: More lines than a worker gets at a time.
CHUNK = 100
QUICK = ("x^2 + 3", "x", "1/x - 3/(16*x^2)", "2", "(2 - x^2)/x^2", "x +")
QUICK_CASES = [1, None, 2, 1, 1, None]


class Cluster:
    """A scheduler and its workers, each a process of its own."""

    def __init__(self, directory: Path) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{port}"
        self._directory = directory
        self.scheduler = self._start("scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        self.workers = [
            self._start("worker", self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", f"w{k}")
            for k in range(2)
        ]

    def _start(self, what: str, *arguments: str) -> subprocess.Popen[bytes]:
        with (self._directory / f"{what}.log").open("ab") as log:
            return subprocess.Popen(
                [sys.executable, "-m", "distributed.cli.dask_" + what, *arguments],
                cwd=self._directory,
                stdout=log,
                stderr=log,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
            )

    def wait_for_workers(self) -> None:
        from distributed import Client

        with Client(self.address, timeout=60, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=60)

    def stop(self) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    running = Cluster(tmp_path_factory.mktemp("dask"))
    try:
        running.wait_for_workers()
        yield running
    finally:
        running.stop()


def test_dask_answers_in_order_and_limits_hold_there(cluster: Cluster) -> None:
    texts = [*QUICK, "(x + 1)^15000/(x^3000 - x - 1)"]
    memory = 500 if Path("/proc/self/statm").exists() else None
    records = list(
        kovacic.solve_many(texts, timeout=2, memory=memory, group=True, backend="dask", scheduler=cluster.address)
    )
    assert [record.number for record in records] == list(range(1, 8))
    assert [record.case for record in records[:6]] == QUICK_CASES
    assert records[5].label == "bad input"
    assert records[6].label == "undecided"
    assert records[0].data["group"]["name"] == "Borel"


def test_every_line_of_a_mix_is_answered_once(cluster: Cluster) -> None:
    runs = random_runs(11, 2_000)
    texts = [json.loads(line) if line.startswith("{") else {} for line in lines_of(runs)]
    records = kovacic.solve_many(texts, jobs=4, timeout=2, backend="dask", scheduler=cluster.address)
    assert [(record.number, record.label) for record in records] == answers_of(runs)


def test_a_killed_worker_loses_nothing_and_repeats_nothing(cluster: Cluster) -> None:
    count = 6 * CHUNK
    texts = [QUICK[k % 6] for k in range(count)]
    finished = []
    killed = False
    for record in kovacic.solve_many(texts, timeout=60, backend="dask", scheduler=cluster.address, ordered=False):
        finished.append(record)
        if not killed and len(finished) >= CHUNK:
            cluster.workers[0].send_signal(signal.SIGKILL)
            killed = True
    assert cluster.workers[0].wait(timeout=10) == -signal.SIGKILL
    assert cluster.workers[1].poll() is None
    finished.sort(key=lambda record: record.number)
    assert [record.number for record in finished] == list(range(1, count + 1))
    assert [record.case for record in finished] == QUICK_CASES * (count // 6)


def test_a_scheduler_that_is_not_there_is_an_error() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    import dask
    import distributed  # noqa: F401 - whose settings come with it, and would go with those of the block

    with (
        dask.config.set({"distributed.comm.timeouts.connect": "1s"}),
        pytest.raises(InputError, match="can't be reached"),
    ):
        list(kovacic.solve_many(["x"], backend="dask", scheduler=address))


def test_a_scheduler_that_ends_is_named(cluster: Cluster, tmp_path: Path) -> None:
    """From the shell: the answers so far, one sentence, and nothing of the engine's own traces."""
    lines = tmp_path / "in.txt"
    lines.write_text("\n".join(f"x^2 + {k}" for k in range(10 * CHUNK)))
    run = ["batch", str(lines), "--backend", "dask", "--scheduler", cluster.address, "-q"]
    pipes = dict.fromkeys(("stdout", "stderr"), subprocess.PIPE)
    with started([sys.executable, "-m", "kovacic", *run], **pipes) as process:
        assert '"line": 1,' in process.stdout.readline()
        cluster.scheduler.kill()
        _, errors = process.communicate(timeout=240)
    assert process.returncode == 4
    assert errors.startswith(f"kovacic: the dask scheduler at {cluster.address} has ended")
    assert len(errors.splitlines()) == 1
