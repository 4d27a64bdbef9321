"""Many equations through `kovacic.solve_many`: rate, speed-up of two workers, cost over the bare loop, memory over the run.

    python benchmarks/batch.py                    5,000 equations
    python benchmarks/batch.py --count 100000     the whole measurement

The equations are mixed: the published ones and those of `families.py` with up to ten poles, their coefficients changed by the
substitution x -> x + k so that no two are the same.  Measured are wall-clock time, and the processor time of all processes,
which other work on the machine disturbs less: the cost of a batch over the bare loop, and the speed-up that two workers have
on a machine with nothing else to do (bare processor time over the larger of half the workers' and the parent's).
Written are benchmarks/results/batch.json, batch.md and batch.png (memory of parent and workers over the run).
"""

from __future__ import annotations

import itertools
import json
import os
import resource
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path

import frame

sys.path.insert(0, str(Path(__file__).parent))

import families

import kovacic
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.batch.pool import Pool
from kovacic.batch.records import Item, Job, Summary
from kovacic.reading.read import read_input

HERE = Path(__file__).parent
CASES = HERE.parent / "tests" / "data" / "cases.jsonl"
_LARGEST = 10
_SAMPLES_OF_MEMORY = 200


@dataclass
class Run:
    """One run: wall-clock and processor seconds, and the resident sets in MiB along the way."""

    jobs: int
    count: int
    wall: float = 0.0
    parent: float = 0.0
    workers: float = 0.0
    slowest: float = 0.0
    outcomes: dict[str, int] = field(default_factory=dict)
    memory: list[tuple[int, float, float]] = field(default_factory=list)


#: Equations for each process before the clock starts: modules are imported when they are first used.
_WARM_UP = 100


def equations(count: int) -> Iterator[str]:
    """The mixed equations, in an order in which long and short ones alternate."""
    published = [read_input(json.loads(line)["S"]).S for line in CASES.read_text().splitlines()]
    generated = [families.by_size(family, n).S for family in families.FAMILIES for n in range(5, _LARGEST + 1)]
    S = [f for pair in itertools.zip_longest(published, generated) for f in pair if f is not None]
    for number in range(count):
        yield _shifted(S[number % len(S)], number // len(S)).to_str("x")


def _shifted(S: RatFunc, k: int) -> RatFunc:
    """S(x + k), by Horner's rule on both polynomials."""
    if k == 0:
        return S
    shift = QQ.poly([k, 1])

    def composed(coefficients: tuple[object, ...]) -> object:
        value = QQ.poly([])
        for c in reversed(coefficients):
            value = value * shift + QQ.poly([c])
        return value

    return RatFunc(composed(S.num.coefficients()), composed(S.den.coefficients()))


def bare_loop(texts: list[str]) -> tuple[float, float]:
    """Wall-clock and processor seconds of a loop that does the same without any process."""
    for text in equations(_WARM_UP):
        kovacic.solve(text).to_json()
    start, processor = time.perf_counter(), time.process_time()
    for text in texts:
        kovacic.solve(text).to_json()
    return time.perf_counter() - start, time.process_time() - processor


def run(texts: Iterator[str] | list[str], jobs: int, count: int, *, samples: int = 0) -> Run:
    """The same through a pool, measured after the processes have started."""
    measured = Run(jobs, count)
    every = max(1, count // samples) if samples else count + 1
    summary = Summary()
    pool = Pool(jobs, Job(timeout=60.0, memory=1000))
    with pool:
        list(pool.run([Item(-k, text) for k, text in enumerate(equations(jobs * _WARM_UP), start=1)]))
        before = sum(_processor_seconds(pid) for pid in pool.pids())
        start, processor = time.perf_counter(), time.process_time()
        items = (Item(number, text) for number, text in enumerate(texts, start=1))
        for done, record in enumerate(pool.run(items), start=1):
            summary.add(record)
            if done % every == 0:
                workers = [_resident_mib(pid) for pid in pool.pids()]
                measured.memory.append((done, _resident_mib(os.getpid()), max(workers)))
        measured.wall, measured.parent = time.perf_counter() - start, time.process_time() - processor
        measured.workers = sum(_processor_seconds(pid) for pid in pool.pids()) - before
        assert pool.replaced == 0, "a worker was replaced: its processor time is lost"
    measured.outcomes = dict(summary.rows())
    measured.slowest = summary.slowest.seconds if summary.slowest else 0.0
    return measured


def _processor_seconds(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _resident_mib(pid: int) -> float:
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * resource.getpagesize() / 2**20


def report(sample: int, loop: tuple[float, float], one: Run, two: Run, whole: Run, load: float) -> str:
    """The results as Markdown."""
    overhead = (one.workers + one.parent) / loop[1] - 1
    only_worker = one.workers / loop[1] - 1
    idle = loop[1] / max((two.workers + two.parent) / 2, two.parent)
    first, last = whole.memory[len(whole.memory) // 4], whole.memory[-1]
    lines = [
        "# Thousands of equations",
        "",
        "Written by `python benchmarks/batch.py`; see there for what is measured.",
        "",
        f"{frame.line()}  Load at the start {load:.1f}.",
        "",
        f"| {sample} mixed equations | wall s | processor s, workers | processor s, parent | equations/s |",
        "|---|---:|---:|---:|---:|",
        f"| bare loop | {loop[0]:.1f} | {loop[1]:.1f} | | {sample / loop[0]:.0f} |",
    ]
    lines += [
        f"| {r.jobs} worker(s) | {r.wall:.1f} | {r.workers:.1f} | {r.parent:.1f} | {r.count / r.wall:.0f} |"
        for r in (one, two)
    ]
    lines += [
        "",
        f"Cost of a batch over the bare loop, in processor time of all processes: {100 * overhead:.1f} % "
        f"(the worker alone {100 * only_worker:.1f} %, the rest is the parent, which runs beside it).",
        f"Speed-up of two workers over one: {one.wall / two.wall:.2f} by the clock; "
        f"over the bare loop {loop[0] / two.wall:.2f} by the clock, {idle:.2f} from processor times.",
        "",
        f"{whole.count} equations on {whole.jobs} workers: {whole.wall:.0f} s by the clock, {whole.workers:.0f} s of the "
        f"workers' processor time, slowest equation {whole.slowest:.2f} s; at this rate 100,000 take "
        f"{whole.wall * 1e5 / whole.count / 60:.1f} min by the clock, "
        f"{(whole.workers + whole.parent) / 2 * 1e5 / whole.count / 60:.1f} min of two processors.",
        "",
        f"Outcomes: {', '.join(f'{label} {n}' for label, n in whole.outcomes.items())}.",
        "",
        f"Resident memory (MiB), parent and larger worker: {first[1]:.0f} and {first[2]:.0f} after {first[0]} equations, "
        f"{last[1]:.0f} and {last[2]:.0f} after {last[0]}.",
        "",
        "![memory over the run](batch.png)",
        "",
    ]
    return "\n".join(lines)


def draw(whole: Run, path: Path) -> None:
    """Memory over the run."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 3.5), layout="constrained")
    axes = figure.add_subplot()
    done = [m[0] for m in whole.memory]
    axes.plot(done, [m[1] for m in whole.memory], label="parent", color="#0072b2")
    axes.plot(done, [m[2] for m in whole.memory], label="larger of the workers", color="#d55e00")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("equations answered")
    axes.set_ylabel("resident memory, MiB")
    axes.grid(alpha=0.25)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=120)


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument(
        "--count", type=int, default=5000, help="equations of the long run, on two workers; 0 keeps the last one"
    )
    parser.add_argument("--sample", type=int, default=1500, help="equations of the comparison with the bare loop")
    options = parser.parse_args()
    load = os.getloadavg()[0]
    texts = list(equations(options.sample))
    # The least of three, taken in turn, because other work on the machine only ever adds time.
    rounds = [(bare_loop(texts), run(texts, 1, options.sample), run(texts, 2, options.sample)) for _ in range(3)]
    loop = (min(r[0][0] for r in rounds), min(r[0][1] for r in rounds))
    one = min((r[1] for r in rounds), key=lambda r: r.wall)
    two = min((r[2] for r in rounds), key=lambda r: r.wall)
    if options.count:
        whole = run(equations(options.count), 2, options.count, samples=_SAMPLES_OF_MEMORY)
    else:
        whole = Run(**json.loads((HERE / "results" / "batch.json").read_text())["runs"][-1])
    text = report(options.sample, loop, one, two, whole, load)
    frame.save("batch", {"load": load, "bare_loop": loop, "runs": [asdict(r) for r in (one, two, whole)]}, text)
    draw(whole, frame.RESULTS / "batch.png")
    print(text)


if __name__ == "__main__":
    main()
