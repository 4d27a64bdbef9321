"""The same batch on another engine, through joblib: loky on this machine, Dask or Ray on many.

The engine distributes chunks of items.  On the machine that gets one, the chunk runs through a worker process that can be
killed, as on a single machine: limits hold everywhere, an equation that exhausts the memory doesn't take a Dask worker with
it, and flint, whose precision is global, isn't run in threads.  Each thread of the engine keeps its worker process for the
next chunk; the process ends with the thread's process, or after a failure.
"""

from __future__ import annotations

import os
import pickle
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, contextmanager
from functools import partial
from itertools import chain, islice
from tempfile import TemporaryDirectory, mkstemp
from typing import Any

from kovacic.batch.pool import Pool
from kovacic.batch.records import Item, Job, Record
from kovacic.errors import InputError, KovacicError, needs

BACKENDS = ("loky", "dask", "ray")

# Items that travel together.  At 5 ms each they keep a worker busy for half a second, and a lost worker loses little.
CHUNK = 100

# Chunks that Ray gets at a time.
_RAY_ROUND = 64

# Worker processes that may be lost one after the other, without an answer in between.
_LOSSES = 4


class _Kept(threading.local):
    """The worker process of this thread, and the job for which it was started."""

    pool: Pool | None = None
    job: Job | None = None


_KEPT = _Kept()  # state of the module, because the engine calls a function and gives it no place to keep anything


def run_chunk(job: Job, items: list[Item]) -> list[Record]:
    """The records of a chunk, in its order, from the worker process of this thread."""
    if _KEPT.pool is None or job != _KEPT.job:
        if _KEPT.pool is not None:
            _KEPT.pool.close()
        _KEPT.pool, _KEPT.job = Pool(1, job), job
    try:
        return list(_KEPT.pool.run(items, ordered=True))
    except BaseException:
        _KEPT.pool.close()
        _KEPT.pool = None
        raise


def run_chunk_into_file(folder: str, job: Job, items: list[Item]) -> str:
    """The path of a new file in the folder with the records of `run_chunk`."""
    descriptor, path = mkstemp(dir=folder)
    with os.fdopen(descriptor, "wb") as file:
        pickle.dump(run_chunk(job, items), file)
    return path


def _records_of_file(path: str) -> list[Record]:
    with open(path, "rb") as file:
        records: list[Record] = pickle.load(file)
    os.unlink(path)
    return records


@contextmanager
def _transport(backend: str) -> Iterator[tuple[Callable[..., Any], Callable[[Any], list[Record]]]]:
    """What a worker calls with a job and a chunk, and what makes records of its result.

    loky waits without end for the rest of a result if a worker is killed while it writes one into their common pipe.  A
    path is short enough to be written at once, so that the records go through a file.
    """
    if backend != "loky":
        yield run_chunk, list
        return
    with TemporaryDirectory(prefix="kovacic-") as folder:
        yield partial(run_chunk_into_file, folder), _records_of_file


def run_on_backend(
    items: Iterable[Item],
    job: Job,
    *,
    backend: str,
    jobs: int | None = None,
    scheduler: str | None = None,
    ordered: bool = True,
) -> Iterator[Record]:
    """One record for each item, from the joblib backend.

    `jobs` is the number of chunks that are worked on at a time: by default, all that the engine has room for.  `scheduler`
    is the address of a running Dask scheduler ("tcp://host:8786") or Ray cluster; without it, loky and Ray start on this
    machine, and Dask uses the client that the program has made.  What a lost worker had is done by another one, and a
    record is passed on once.  Raises `InputError` where the engine isn't installed or can't be reached, and `KovacicError`
    where its workers are lost one after the other.
    """
    with _configured(backend, jobs, scheduler), _transport(backend) as transport:
        chunks = _chunks(items)
        if backend != "ray":
            yield from _run(chunks, job, backend, transport, "generator" if ordered else "generator_unordered")
            return
        while some := list(islice(chunks, _RAY_ROUND)):  # its joblib backend returns lists only
            yield from _run(iter(some), job, backend, transport, "list")


def _run(
    chunks: Iterator[list[Item]],
    job: Job,
    backend: str,
    transport: tuple[Callable[..., Any], Callable[[Any], list[Record]]],
    return_as: str,
) -> Iterator[Record]:
    """The records of all chunks; what a lost worker process had is done again, and a record is passed on once.

    Dask does it by itself; loky and Ray give up all that is on its way.
    """
    from joblib import Parallel, delayed

    work, received = transport
    on_their_way: dict[int, list[Item]] = {}

    def sent(chunks: Iterable[list[Item]]) -> Iterator[list[Item]]:
        for chunk in chunks:
            on_their_way[chunk[0].number] = chunk
            yield chunk

    losses = 0
    while True:
        again = list(on_their_way.values())
        on_their_way.clear()
        parallel = Parallel(batch_size=1, pre_dispatch="2*n_jobs", return_as=return_as)
        try:
            for result in parallel(delayed(work)(job, chunk) for chunk in sent(chain(again, chunks))):
                records = received(result)
                del on_their_way[records[0].number]
                losses = 0
                yield from records
            if not on_their_way:
                return
            reason = "no answer, and no error"
        except _losses(backend) as error:
            reason = str(error)
        losses += 1
        if losses == _LOSSES:
            raise KovacicError(f"{backend} has lost {_LOSSES} worker processes in a row: {reason}")


def _losses(backend: str) -> tuple[type[Exception], ...]:
    """What the engine raises when one of its processes, or a machine, is gone."""
    if backend != "ray":
        return (BrokenProcessPool,)
    from ray.exceptions import NodeDiedError, RayActorError, WorkerCrashedError

    return (NodeDiedError, RayActorError, WorkerCrashedError)


def _chunks(items: Iterable[Item]) -> Iterator[list[Item]]:
    iterator = iter(items)
    while chunk := list(islice(iterator, CHUNK)):
        yield chunk


@contextmanager
def _configured(backend: str, jobs: int | None, scheduler: str | None) -> Iterator[None]:
    """joblib's configuration for this backend; connections that are made here are closed here."""
    with needs("dask", f"the backend {backend}"):
        from joblib import parallel_config

    with ExitStack() as stack:
        options = {"n_jobs": -1 if jobs is None else jobs}
        if backend == "dask":
            options["client"] = stack.enter_context(_dask_client(scheduler))
        elif backend == "ray":
            _connect_ray(scheduler)
        elif backend != "loky":
            raise InputError(f"{backend!r} isn't a backend", hint=f"one of {', '.join(BACKENDS)}")
        elif scheduler is not None:
            raise InputError("loky has no scheduler", hint="--backend dask --scheduler tcp://host:8786")
        stack.enter_context(parallel_config(backend, **options))
        yield


@contextmanager
def _dask_client(scheduler: str | None) -> Iterator[Any]:
    """A client of the scheduler, or the one that the program has made."""
    try:
        from distributed import Client, get_client
    except ImportError:
        raise InputError("Dask isn't installed", hint="pip install 'kovacic[dask]'") from None
    if scheduler is None:
        try:
            existing = get_client()
        except ValueError:
            raise InputError("there is no Dask client", hint="--scheduler tcp://host:8786, or make a client") from None
        yield existing
        return
    try:
        client = Client(scheduler, set_as_default=False)
    except (OSError, ValueError) as error:
        hint = "dask scheduler --port 8786, and --scheduler tcp://host:8786"
        raise InputError(f"the scheduler at {scheduler} can't be reached: {error}", hint=hint) from None
    with client:
        yield client


def _connect_ray(address: str | None) -> None:
    try:
        import ray
        from ray.util.joblib import register_ray
    except ImportError:
        raise InputError("Ray isn't installed", hint="pip install ray") from None
    if address is not None:
        ray.init(address=address, ignore_reinit_error=True)
    register_ray()
