"""The same equations through kovacic, Maxima, FriCAS, giac and SymPy, each as one long-lived process.

    python benchmarks/peers.py                      everything that is installed, 20 s for an equation (hours)
    python benchmarks/peers.py --limit 10 --sizes 1,2,3,5,10,20,40,100 --every 3 --patience 1        about 25 minutes

Every positive answer of every system is substituted into the equation with 30 digits (`peer_systems/check.py`); a "none" is
wrong where a solution is known: by the corpus, or because another system's solution was checked right.  Written are
benchmarks/results/peers.json and peers.md, and a figure for each system with the time against the number of poles.
Debian's packages: maxima, maxima-share, fricas, xcas (giac); take its python3 as well, an optimised build like theirs, which a
Python compiled without profile-guided optimisation isn't (it is a tenth slower).  A system that isn't installed is skipped,
and the table says so.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

import families
import textbook_equations
from peer_systems.process import Answer, Reply, System
from peer_systems.systems import ALL, Dsolve, SolveRiccati

import kovacic

HERE = Path(__file__).parent
RESULTS = HERE / "results"
CASES = HERE.parent / "tests" / "data" / "cases.jsonl"
SIZES = (1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 40, 60, 80, 100)
_CHECK_SECONDS = 30.0
_TITLES = (
    "solved", "none", "undecided", "error", "time-out", "right", "on a branch", "wrong", "unchecked", "wrong none",
    "median", "90%", "max", "MiB",
)  # fmt: skip


@dataclass(frozen=True)
class Equation:
    """One equation; `case` is None if no Liouvillian solution exists, and "unknown" where nothing is known."""

    corpus: str
    name: str
    S: str
    case: int | str | None
    family: str = ""
    poles: int = 0


@dataclass
class Row:
    """What a system said about an equation."""

    system: str
    corpus: str
    name: str
    family: str
    poles: int
    outcome: str
    form: str
    partial: bool
    check: str
    seconds: float


class Checker(System):
    """The independent check, as a process that can be killed."""

    name = "check"
    command = (sys.executable, str(HERE / "peer_systems" / "check.py"))

    def request(self, S: str) -> str:
        return json.dumps(["x^2+3", "y", "python", ["x*exp(x**2/2)"]] if S == "x^2+3" else json.loads(S)) + "\n"

    def check(self, S: str, answer: Answer) -> str:
        reply = self.solve(json.dumps([S, answer.form, answer.syntax, list(answer.expressions)]), _CHECK_SECONDS)
        return json.loads(reply.text.splitlines()[-1]) if reply.outcome == "text" else f"unchecked: {reply.outcome}"


def corpora(sizes: tuple[int, ...], every: int) -> Iterator[Equation]:
    """The published, the textbook and the generated equations; of the first two each `every`-th."""
    published = [json.loads(line) for line in CASES.read_text().splitlines()]
    for row in published[::every]:
        yield Equation("published", row["id"], row["S"].replace("**", "^"), row["case"])
    for entry in textbook_equations.equations()[::every]:
        yield Equation("textbook", entry.name, entry.S, entry.case)
    for family in _SMALLEST:
        for n in sizes:
            one = _generated(family, n)
            if one is not None:
                S = one.S.to_str("x").replace("**", "^")
                yield Equation("generated", f"{family}, {n} poles", S, one.case, family, one.poles)


def _generated(family: str, n: int) -> families.Sample | None:
    """The equation of a family, or None for a size that the construction doesn't have."""
    if n < _SMALLEST[family]:
        return None
    return families.by_size(family, n)


# The families, and the least number of poles of each construction.
_SMALLEST = {
    "case 1, unique, rational poles": 1,
    "case 1, unique, quintics": 5,
    "case 1, diagonal": 2,
    "case 2": 2,
    "case 3, tetrahedral": 5,
    "case 3, octahedral": 5,
    "case 3, icosahedral": 5,
    "none, pull-back": 5,
    "none, accessory parameters": 4,
}


# Cases 1 (exponentials, with the error function, an incomplete gamma function, an integral, irrational powers), 2, 3 and
# none; none of them is in a corpus.
_WARM_UP = (
    "x^2 + 19",
    "25*x^4 + 10*x",
    "9*x^4 + 6*x^2 + 6*x + 1",
    "11/x^2",
    "3/x - 3/(16*x^2)",
    "(-128*x^2 + 54*x - 27)/(576*x^4 - 576*x^3 + 144*x^2)",
    "x^3 + 5*x",
)


def run(system: System, checker: Checker, equations: list[Equation], limit: float, patience: int) -> list[Row]:
    """The rows of one system; after `patience` time-outs in a row within a family, its larger sizes are time-outs as well.

    The system first solves an equation of each case, so that what it loads at its first use isn't counted.  Then it gets
    its equations one after the other without a pause, so that no system is slowed down by memory that another process
    used meanwhile; the answers are checked afterwards.
    """
    for S in _WARM_UP:
        system.solve(S, limit)
    replies: list[Reply | None] = []
    given_up: Counter[str] = Counter()
    for equation in equations:
        if equation.family and given_up[equation.family] >= patience:
            replies.append(None)
            continue
        reply = system.solve(equation.S, limit)
        given_up[equation.family] = given_up[equation.family] + 1 if reply.outcome == "time-out" else 0
        replies.append(reply)
    system.close()
    rows: list[Row] = []
    for equation, given in zip(equations, replies, strict=True):
        if given is None:
            rows.append(_row(system, equation, Answer("time-out"), "not tried", limit))
        elif given.outcome != "text":
            outcome = "time-out" if given.outcome == "time-out" else "error"
            rows.append(_row(system, equation, Answer(outcome), "", given.seconds))
        else:
            answer = system.understand(given.text)
            check = checker.check(equation.S, answer) if answer.kind == "solved" else ""
            rows.append(_row(system, equation, answer, check, given.seconds))
    return rows


def _row(system: System, equation: Equation, answer: Answer, check: str, seconds: float) -> Row:
    form = answer.form if answer.kind in ("solved", "none") else ""
    about = (equation.corpus, equation.name, equation.family, equation.poles)
    return Row(system.name, *about, answer.kind, form, answer.partial, check, seconds)


def judge_negatives(rows: list[Row], equations: list[Equation]) -> None:
    """Mark each "none" that is wrong: a solution is known by the corpus, or another system's was checked right."""
    solvable = {e.name for e in equations if isinstance(e.case, int)}
    # SymPy's dsolve also answers with Bessel and Airy functions, which aren't Liouvillian.
    solvable |= {
        row.name
        for row in rows
        if row.outcome == "solved" and row.check.startswith("right") and row.system != Dsolve.name
    }
    # SymPy looks for omega over the field of S: constants outside it aren't held against it.
    rational = {e.name for e in equations if e.case == 1 and kovacic.solve(e.S).constants is None}
    for row in rows:
        if row.outcome == "none":
            known = rational if row.system == SolveRiccati.name else solvable
            row.check = "wrong" if row.name in known else "right" if row.name not in solvable else "not its case"


def table(rows: list[Row], memory: dict[str, float]) -> list[str]:
    """A Markdown table: a line for each system."""
    lines = ["| | " + " | ".join(_TITLES) + " |", "|---|" + "---:|" * len(_TITLES)]
    for name in dict.fromkeys(row.system for row in rows):
        own = [row for row in rows if row.system == name]
        outcomes = Counter(row.outcome for row in own)
        checks = Counter(row.check.partition(":")[0] for row in own if row.outcome == "solved")
        times = sorted(row.seconds for row in own)
        cells = [
            *(str(outcomes[k]) for k in ("solved", "none", "undecided", "error", "time-out")),
            *(str(checks[k]) for k in ("right", "right on a branch", "wrong", "unchecked")),
            str(sum(row.outcome == "none" and row.check == "wrong" for row in own)),
            _seconds(statistics.median(times)),
            _seconds(times[int(0.9 * (len(times) - 1))]),
            _seconds(times[-1]),
            f"{memory[name]:.0f}" if name in memory else "",
        ]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines


def _seconds(value: float) -> str:
    return f"{value:.4f}" if value < 0.01 else f"{value:.3f}" if value < 1 else f"{value:.1f}"


def speed(rows: list[Row]) -> list[str]:
    """Medians of ours and of each system's, over the equations that the system answered right.

    Our closed forms, two solutions always, are compared with closed forms only: a polynomial of omega is what our verdict
    has too.  Where a system gives one solution only, ours still are two, and the line says so.
    """
    lines = ["| answered right by | equations | its median | ours | ratio | slower on |", "|---|" + "---:|" * 5]
    for name in dict.fromkeys(row.system for row in rows):
        right = [row for row in rows if row.system == name and row.check.startswith("right")]
        if name.startswith("kovacic"):
            continue
        closed = [row for row in right if row.form == "y" and row.outcome == "solved"]
        for title, theirs, ours in (
            (f"{name}: the verdict", right, "kovacic"),
            (f"{name}: two solutions in closed form", [r for r in closed if not r.partial], "kovacic, closed forms"),
            (f"{name}: one solution in closed form", [r for r in closed if r.partial], "kovacic, closed forms"),
        ):
            mine = {(row.corpus, row.name): row.seconds for row in rows if row.system == ours}
            if theirs and mine:
                lines.append("| " + " | ".join([title, *_compared(theirs, mine)]) + " |")
    return lines


def _compared(theirs: list[Row], ours: dict[tuple[str, str], float]) -> list[str]:
    """Their number, both medians, the ratio, and on how many of them we are slower."""
    median = statistics.median(row.seconds for row in theirs)
    mine = [ours[row.corpus, row.name] for row in theirs]
    slower = sum(own > row.seconds for own, row in zip(mine, theirs, strict=True))
    return [
        str(len(theirs)),
        f"{1e3 * median:.2f}",
        f"{1e3 * statistics.median(mine):.2f}",
        f"{median / statistics.median(mine):.1f}",
        str(slower),
    ]


def figures(rows: list[Row], limit: float) -> None:
    """For each family, the time of every system against the number of poles."""
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

    names = list(dict.fromkeys(row.system for row in rows))
    groups = [family for family in families.FAMILIES if any(row.family == family for row in rows)]
    columns = 3
    figure = Figure(figsize=(13, 3.6 * -(-len(groups) // columns)), layout="constrained")
    panels = figure.subplots(-(-len(groups) // columns), columns, squeeze=False, sharex=True, sharey=True)
    colours = ("#0072b2", "#56b4e9", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#999999")
    for k, family in enumerate(groups):
        panel = panels[k // columns][k % columns]
        for name, colour in zip(names, colours, strict=False):
            own = sorted((r for r in rows if r.system == name and r.family == family), key=lambda r: r.poles)
            panel.plot([r.poles for r in own], [r.seconds for r in own], color=colour, lw=1.2)
            for marker, wanted in (("o", "right"), ("v", "time-out"), ("x", "wrong"), (".", "other")):
                chosen = [r for r in own if _mark(r) == wanted]
                panel.plot([r.poles for r in chosen], [r.seconds for r in chosen], marker, color=colour, ms=6)
        panel.axhline(limit, color="#444444", lw=0.7, ls=":")
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_title(family, fontsize=10)
        panel.grid(True, which="major", alpha=0.25)
        panel.xaxis.set_major_locator(FixedLocator([1, 2, 5, 10, 20, 50, 100]))
        panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        panel.xaxis.set_minor_formatter(NullFormatter())
        panel.tick_params(labelbottom=True)
    for k in range(len(groups), panels.size):
        panels[k // columns][k % columns].set_visible(False)
    for panel in panels[-1]:
        panel.set_xlabel("finite poles of S")
    for panel in panels[:, 0]:
        panel.set_ylabel("seconds")
    handles = [Line2D([], [], color=c, label=n) for n, c in zip(names, colours, strict=False)]
    handles += [
        Line2D([], [], color="black", ls="", marker=m, label=t)
        for m, t in (("o", "right"), ("v", "time-out"), ("x", "wrong"), (".", "error, undecided, unchecked"))
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=9, frameon=False)
    figure.savefig(RESULTS / "peers.png", dpi=110)


def _mark(row: Row) -> str:
    if row.outcome == "time-out":
        return "time-out"
    return "wrong" if row.check == "wrong" else "right" if row.check.startswith("right") else "other"


def report(rows: list[Row], memory: dict[str, float], about: dict[str, Any]) -> str:
    """The results as Markdown."""
    lines = ["# Side by side", "", "Written by `python benchmarks/peers.py`; see there for what is measured.", ""]
    lines += [f"{about['machine']}; {about['limit']:g} s for an equation. " + "; ".join(about["versions"]) + "."]
    if about["absent"]:
        lines += ["", f"Not installed here, and skipped: {', '.join(about['absent'])}."]
    for corpus in dict.fromkeys(row.corpus for row in rows):
        own = [row for row in rows if row.corpus == corpus]
        count = len({row.name for row in own})
        lines += ["", f"## {corpus.capitalize()} equations ({count}); times in seconds", "", *table(own, memory)]
    lines += ["", "## Speed where the other system is right; medians in milliseconds", "", *speed(rows)]
    lines += ["", "## Time against the number of poles", "", "![time against the number of poles](peers.png)", ""]
    wrong = [row for row in rows if row.check == "wrong"]
    lines += [f"## Wrong answers ({len(wrong)})", ""]
    lines += [f"- {row.system}: {row.name} ({row.corpus}), {row.outcome}" for row in wrong]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limit", type=float, default=20.0, help="seconds for an equation")
    parser.add_argument(
        "--sizes", default=",".join(map(str, SIZES)), help="numbers of poles of the generated equations"
    )
    parser.add_argument("--every", type=int, default=1, help="take each k-th of the published and textbook equations")
    parser.add_argument("--patience", type=int, default=2, help="time-outs in a row after which a family is given up")
    parser.add_argument("--redraw", action="store_true", help="write the report and the figure from peers.json again")
    parser.add_argument("--merge", action="store_true", help="keep the results of the other systems in peers.json")
    parser.add_argument(
        "--only", default="", help="systems of these names, or whose names contain these, comma-separated"
    )
    options = parser.parse_args()
    if options.redraw:
        data = json.loads((RESULTS / "peers.json").read_text())
        write([Row(**row) for row in data["rows"]], data["memory_mib"], data["about"])
        return
    equations = list(corpora(tuple(map(int, options.sizes.split(","))), options.every))
    chosen = _chosen([part for part in options.only.split(",") if part])
    checker = Checker()
    rows: list[Row] = []
    memory: dict[str, float] = {}
    versions: dict[str, str] = {}
    for kind in (s for s in chosen if s.is_installed()):
        start = time.perf_counter()
        system = kind()
        versions[kind.name] = system.version()
        rows += run(system, checker, equations, options.limit, options.patience)
        memory[kind.name] = system.peak_mib
        print(f"{kind.name}: {time.perf_counter() - start:.0f} s", file=sys.stderr, flush=True)
    checker.close()
    kept: dict[str, Any] = {"rows": [], "memory_mib": {}, "about": {"versions": []}}
    if options.merge:
        kept = json.loads((RESULTS / "peers.json").read_text())
    order = [kind.name for kind in ALL]
    rows += [Row(**row) for row in kept["rows"] if row["system"] not in versions]
    rows.sort(key=lambda row: order.index(row.system))
    memory = {**kept["memory_mib"], **memory}
    judge_negatives(rows, equations)
    about = {
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} CPUs, python {platform.python_version()}, "
        f"load {os.getloadavg()[0]:.1f}",
        "limit": options.limit,
        "versions": list(dict.fromkeys([*versions.values(), *kept["about"]["versions"]])),
        "absent": [s.name for s in chosen if not s.is_installed()],
    }
    write(rows, memory, about)


def _chosen(wanted: list[str]) -> list[type[System]]:
    """The systems that are wanted: the one of that name, else those whose names contain it."""
    names = {system.name for system in ALL}
    return [
        s for s in ALL if not wanted or any(part == s.name or (part not in names and part in s.name) for part in wanted)
    ]


def write(rows: list[Row], memory: dict[str, float], about: dict[str, Any]) -> None:
    """The data, the report and the figure."""
    RESULTS.mkdir(exist_ok=True)
    text = report(rows, memory, about)
    (RESULTS / "peers.md").write_text(text)
    data = {"about": about, "memory_mib": memory, "rows": [asdict(row) for row in rows]}
    (RESULTS / "peers.json").write_text(json.dumps(data, indent=0) + "\n")
    figures(rows, about["limit"])
    print(text)


if __name__ == "__main__":
    main()
