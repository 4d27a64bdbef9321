"""Pools and backends with stand-ins for processes and clusters: what happens when one of them ends."""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import kovacic
from kovacic import InputError, KovacicError
from kovacic.batch import backends, pool, run_items, worker
from kovacic.batch.pool import ItemSource, Pool
from kovacic.batch.records import Item, Job, Record


def dead(status: int, words: str, item: Item | None, *, ready: bool = True) -> Any:
    process = SimpleNamespace(last_words=lambda: (status, words))
    return SimpleNamespace(process=process, item=item, ready=ready, since=0.0)


def after(child: Any, job: Job, times: int = 1) -> tuple[list[Record], Pool, ItemSource]:
    """The records that the end of a process brings."""
    running, source = Pool(1, job), ItemSource(iter(()))
    replaced: list[Any] = []
    running._replace = replaced.append  # type: ignore[method-assign]
    found = [record for _ in range(times) for record in running._died(child, source)]
    assert len(replaced) == times
    return found, running, source


@pytest.mark.parametrize(
    ("status", "words", "job", "label", "said"),
    [
        (1, "  a trace\n MemoryError ", Job(memory=700), "undecided", "the memory limit of 700 MiB is exceeded"),
        (-6, "flint: cannot allocate", Job(memory=700), "undecided", "the memory limit of 700 MiB is exceeded"),
        (-14, "", Job(timeout=2.5), "undecided", "the time limit of 2.5 s is exceeded"),
        (1, "MemoryError", Job(timeout=2.5), "failed", "ended with exit status 1: MemoryError"),
        (2, "a trace\n  ArithmeticError: 7\n", Job(memory=700), "failed", "exit status 2: ArithmeticError: 7"),
        (0, "", Job(), "failed", "the worker process ended with exit status 0"),
    ],
)
def test_the_end_of_a_process_is_told(status: int, words: str, job: Job, label: str, said: str) -> None:
    (record,), running, source = after(dead(status, words, Item(5, "x")), job)
    assert (record.number, record.label, not source.returned) == (5, label, True)
    assert said in (record.error or record.data["proof"]["undecided"])
    assert running._failed_starts == 0


def test_a_killed_process_costs_its_item_a_few_attempts() -> None:
    item = Item(5, "x")
    for times in (1, pool.MOST_LOSSES - 1):
        found, _, source = after(dead(-9, "", item), Job(timeout=3), times)
        assert (found, source.returned) == ([], [item] * times)
    (record,), _, source = after(dead(-9, "", item), Job(timeout=3), pool.MOST_LOSSES)
    assert record.error == "the worker process ended with signal SIGKILL"
    assert len(source.returned) == pool.MOST_LOSSES - 1


def test_a_process_without_an_item_costs_nothing_unless_none_can_start() -> None:
    assert after(dead(1, "", None), Job(), 9)[0] == []
    found, running, source = after(dead(1, "", None, ready=False), Job(), pool.MOST_LOSSES - 1)
    assert found == []
    with pytest.raises(KovacicError, match="can't be started: the worker process ended with exit status 3: no module"):
        list(running._died(dead(3, "trace\nno module", None, ready=False), source))


def as_they_come(numbers: list[int], monkeypatch: pytest.MonkeyPatch) -> Pool:
    """A pool whose records come in this order."""
    running = Pool(2, Job())

    def records(feed: Iterator[Item]) -> Iterator[Record]:
        taken = {item.number: item for item in feed if item is not None}
        for number in numbers:
            yield Record(number, "none", 0.0, taken[number].text)

    monkeypatch.setattr(running, "_records", records)
    return running


def test_records_come_in_the_order_of_the_items_or_as_they_finish(monkeypatch: pytest.MonkeyPatch) -> None:
    items = [Item(number, f"x^{number}") for number in (3, 5, 9, 2)]
    for ordered, numbers in ((True, [3, 5, 9, 2]), (False, [9, 3, 2, 5])):
        found = list(as_they_come([9, 3, 2, 5], monkeypatch).run(items, ordered=ordered))
        assert [record.number for record in found] == numbers
        assert [record.json for record in found] == [f"x^{number}" for number in numbers]


class Cluster:
    """An engine that works on a chunk when it is asked for the result, the last chunk first where any will do."""

    def __init__(self, answer: Callable[[Job, list[Item]], list[Record]], room: int) -> None:
        self.answer, self.room = answer, room
        self.sent: list[list[int]] = []
        self.most = 0
        self.open: deque[Any] = deque()

    @contextmanager
    def engine(self, scheduler: str | None) -> Iterator[Any]:
        self.scheduler = scheduler
        yield self.send, self.room

    def send(self, job: Job, chunk: list[Item]) -> Future[list[Record]]:
        cluster = self

        class Chunk(Future):  # type: ignore[type-arg]
            def result(self, timeout: float | None = None) -> list[Record]:
                cluster.open.remove(self)
                return cluster.answer(job, chunk)

        self.sent.append([item.number for item in chunk])
        self.open.append(future := Chunk())
        self.most = max(self.most, len(self.open))
        return future


def on_cluster(
    monkeypatch: pytest.MonkeyPatch, answer: Callable[[Job, list[Item]], list[Record]], **options: Any
) -> tuple[Cluster, Iterator[Record]]:
    cluster = Cluster(answer, room=2)
    monkeypatch.setitem(backends._ENGINES, "dask", cluster.engine)
    monkeypatch.setattr(backends, "CHUNK", 3)
    last = lambda pending, return_when: SimpleNamespace(done=[*pending])  # noqa: E731
    monkeypatch.setattr(backends, "wait", last)
    items = (Item(number, "x") for number in range(1, 18))
    return cluster, run_items(items, Job(backend="dask", scheduler="tcp://host:8786", **options))


def plain(_: Job, chunk: list[Item]) -> list[Record]:
    return [Record(item.number, "none", 0.0, "") for item in chunk]


@pytest.mark.parametrize(("jobs", "most"), [(None, 4), (3, 3)])
@pytest.mark.parametrize("ordered", [True, False])
def test_a_backend_gets_chunks(jobs: int | None, most: int, ordered: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    cluster, records = on_cluster(monkeypatch, plain, jobs=jobs, ordered=ordered)
    numbers = [record.number for record in records]
    assert sorted(numbers) == [*range(1, 18)]
    assert (numbers == sorted(numbers)) == ordered
    assert [len(chunk) for chunk in cluster.sent] == [3] * 5 + [2]
    assert (cluster.most, cluster.scheduler) == (most, "tcp://host:8786")


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (KovacicError("its own"), "^its own$"),
        (CancelledError(), "the dask scheduler at tcp://host:8786 has ended, or can't be reached any more"),
        (ValueError("a bad wire"), "dask gave up on a chunk of equations: a bad wire"),
    ],
)
def test_a_backend_that_fails_is_named(error: Exception, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(job: Job, chunk: list[Item]) -> list[Record]:
        if chunk[0].number == 7:
            raise error
        return plain(job, chunk)

    cluster, records = on_cluster(monkeypatch, failing)
    assert [record.number for record in islice(records, 6)] == [1, 2, 3, 4, 5, 6]
    with pytest.raises(KovacicError, match=said):
        next(records)
    assert cluster.open
    assert all(future.cancelled() for future in cluster.open)


def test_an_unknown_backend_is_refused() -> None:
    with pytest.raises(InputError, match="unknown backend 'spark'") as refused:
        list(kovacic.solve_many(["x"], backend="spark"))
    assert refused.value.hint == "one of dask, ray"


def test_a_thread_keeps_its_process_for_chunks_of_one_job(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Fake] = []

    class Fake:
        def __init__(self, jobs: int, job: Job) -> None:
            assert jobs == 1
            self.job, self.closed = job, 0
            made.append(self)

        def run(self, items: list[Item]) -> Iterator[Record]:
            if items[0].text == "worse":
                raise OSError("no process")
            yield from plain(self.job, items)

        def close(self) -> None:
            self.closed += 1

    monkeypatch.setattr(backends, "Pool", Fake)
    monkeypatch.setattr(backends, "_OF_THREAD", SimpleNamespace())
    for job in (Job(), Job(), Job(timeout=3), Job(timeout=3)):
        assert [record.number for record in backends.run_chunk(job, [Item(4, "x"), Item(6, "x")])] == [4, 6]
    assert [(fake.job.timeout, fake.closed) for fake in made] == [(None, 1), (3, 0)]
    with pytest.raises(OSError, match="no process"):
        backends.run_chunk(Job(timeout=3), [Item(4, "worse")])
    assert [fake.closed for fake in made] == [1, 1]


@pytest.mark.parametrize(("job", "said"), [(Job(), []), (Job(timeout=2, memory=300), [("memory", 300), 7.0])])
def test_a_worker_answers_until_the_end_and_sets_its_limits(
    job: Job, said: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[Any] = []
    monkeypatch.setattr(worker, "_limit_memory", lambda mebibytes: done.append(("memory", mebibytes)))
    monkeypatch.setattr(worker, "set_alarm", done.append)
    monkeypatch.setattr(worker.gc, "freeze", lambda: None)
    given, sent = deque([job, Item(3, "x"), Item(8, "x +")]), list[Record]()

    def receive() -> Any:
        if not given:
            raise EOFError
        return given.popleft()

    with pytest.raises(EOFError):
        worker.serve(SimpleNamespace(receive=receive, send=sent.append))  # type: ignore[arg-type]
    assert [(record.number, record.label) for record in sent] == [(0, "case 1"), (3, "none"), (8, "bad input")]
    assert done == [*said, 0.0] * 2


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="other systems have no memory limits")
def test_the_memory_limit_moves_with_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    for hard, expected in ((-1, None), (10**20, None), (10**6, 10**6)):
        done: list[Any] = []
        fake = SimpleNamespace(
            RLIMIT_AS=9,
            RLIM_INFINITY=-1,
            getpagesize=lambda: 2**20,
            getrlimit=lambda which, hard=hard: (which, hard),
            setrlimit=lambda *of, done=done: done.append(of),
        )
        monkeypatch.setitem(sys.modules, "resource", fake)  # type: ignore[arg-type]
        worker._limit_memory(300)
        ((which, (soft, bound)),) = done
        assert (which, bound) == (9, hard)
        assert abs(soft - (expected or (pages + 300) * 2**20)) < (1 if expected else 50 * 2**20)
