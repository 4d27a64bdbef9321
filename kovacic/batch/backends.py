"""A batch on other machines: chunks of items through Dask or Ray.

On the machine that gets a chunk, it runs through a worker process that can be killed, as on a single machine: limits hold
everywhere, an equation that exhausts the memory doesn't take a Dask worker with it, and flint, whose precision is global,
isn't run in threads.  Each thread of the engine keeps its worker process for the next chunk; the process ends with the
thread's process, or after a failure.  The engine gives the chunks of a lost worker to another one.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from contextlib import contextmanager
from itertools import islice

from kovacic.batch.pool import MOST_LOSSES, Pool
from kovacic.batch.records import Item, Job, Record
from kovacic.errors import InputError, KovacicError, needs

# Items that travel together.  At 5 ms each they keep a worker busy for half a second, and a lost worker loses little.
CHUNK = 100

#: Sends a chunk, and the number of chunks that the engine has room for.
_Engine = tuple[Callable[[Job, list[Item]], Future[list[Record]]], int]


# The pool of this thread, a worker process for one job: state of the module, because the engine calls a function and gives it
# no place to keep anything.
_OF_THREAD = threading.local()


def run_chunk(job: Job, items: list[Item]) -> list[Record]:
    """The records of a chunk, in its order, from the worker process of this thread."""
    pool: Pool | None = getattr(_OF_THREAD, "pool", None)
    if pool is None or pool.job != job:
        if pool is not None:
            pool.close()
        pool = _OF_THREAD.pool = Pool(1, job)
    try:
        return list(pool.run(items))
    except BaseException:
        pool.close()  # which starts another process when it is needed
        raise


def run_on_backend(items: Iterable[Item], job: Job) -> Iterator[Record]:
    """One record for each item, from the job's backend, "dask" or "ray".

    `job.jobs` is the number of chunks that are worked on at a time: by default, all that the engine has room for.  Its
    `scheduler` is the address of a running Dask scheduler ("tcp://host:8786") or Ray cluster; without it, Ray starts on this
    machine, and Dask uses the client that the program has made.  Raises `InputError` if the engine isn't installed or
    can't be reached, and `KovacicError` where it gives up.
    """
    engine = _ENGINES.get(job.backend or "")
    if engine is None:
        raise InputError(f"unknown backend {job.backend!r}", hint=f"one of {', '.join(_ENGINES)}")
    iterator = iter(items)
    pending = deque[Future[list[Record]]]()
    with engine(job.scheduler) as (send, room):
        most = job.jobs or 2 * room
        try:
            while True:
                while len(pending) < most and (chunk := list(islice(iterator, CHUNK))):
                    pending.append(send(job, chunk))
                if not pending:
                    return
                done = pending[0] if job.ordered else wait(pending, return_when=FIRST_COMPLETED).done.pop()
                pending.remove(done)
                try:
                    records = done.result()
                except KovacicError:
                    raise
                except CancelledError as error:  # not by this function, which cancels only at its end
                    where = "" if job.scheduler is None else f" at {job.scheduler}"
                    said = f"the {job.backend} scheduler{where} has ended, or can't be reached any more"
                    raise KovacicError(f"{said}; the answers so far were given out") from error
                except Exception as error:
                    raise KovacicError(f"{job.backend} gave up on a chunk of equations: {error}") from error
                yield from records
        finally:
            for future in pending:
                future.cancel()


@contextmanager
def _dask(scheduler: str | None) -> Iterator[_Engine]:
    """A client of the scheduler, or the one that the program has made."""
    with needs("dask", "the backend dask"):
        from distributed import Client, get_client
    try:
        client = get_client() if scheduler is None else Client(scheduler, set_as_default=False)
    except (OSError, ValueError) as error:
        if scheduler is None:
            hint = "scheduler='tcp://host:8786', or make a distributed.Client before"
            raise InputError("there is no Dask client", hint=hint, shell="--scheduler tcp://host:8786") from None
        hint = "start it: dask scheduler --port 8786"
        raise InputError(f"the scheduler at {scheduler} can't be reached: {error}", hint=hint) from None
    executor = client.get_executor(pure=False)
    try:
        yield lambda job, chunk: executor.submit(run_chunk, job, chunk), max(1, sum(client.nthreads().values()))
    finally:
        if scheduler is not None:
            client.close()


@contextmanager
def _ray(address: str | None) -> Iterator[_Engine]:
    try:
        import ray
    except ImportError:
        raise InputError("Ray isn't installed", hint="pip install ray") from None
    if address is not None or not ray.is_initialized():
        ray.init(address=address, ignore_reinit_error=True)
    work = ray.remote(run_chunk).options(max_retries=MOST_LOSSES)  # Dask's own number is 3
    yield lambda job, chunk: work.remote(job, chunk).future(), max(1, int(ray.cluster_resources().get("CPU", 1)))


_ENGINES = {"dask": _dask, "ray": _ray}
