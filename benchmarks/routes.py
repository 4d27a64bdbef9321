"""Is the route that is chosen the right one?  The default of `evaluate` against every method, on texts of every kind.

Regenerate:  python benchmarks/routes.py 1000 --patience 3     (some ten minutes; --seed for others, --rows FILE goes on where a
run ended)
prints, and writes results/routes.{json,md}.

Processor times of a first call, from the text to the balls, with every cache of the package emptied before it, and of this and
a second one together, at another point of the same solution.  What the default takes is to be at most twice the best method's
time and 1 ms.
A call that misses this is measured again, up to five times, and the least times count: other processes disturb a single one.
A method is given up after 20 s, or what --patience says; where the default is given up, or refuses, and another method is not,
it is missed, too.  What the imports of a first call in a process take is measured apart, in new processes.
"""

from __future__ import annotations

import functools
import gc
import json
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import families  # noqa: F401 - puts tests/ on the path
import frame
import transform

import kovacic
from kovacic.algebra.rationals import QQ

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from tests.shared import special_cases

METHODS = (None, "taylor", "closed form")
FACTOR, SPARE = 2.0, 1e-3
_AGAIN = 5
X = kovacic.algebra.ratfunc.RatFunc(QQ.poly([0, 1]))


@dataclass(frozen=True)
class Question:
    """Values of a solution, at points of a first call and of a second one."""

    kind: str
    equation: str
    first: list[Any]
    second: list[Any]
    options: dict[str, Any] = field(default_factory=dict)


def number(random: Random, most: int = 9) -> Fraction:
    """Not zero."""
    return Fraction(random.choice((-1, 1)) * random.randint(1, most), random.randint(1, 5))


def polynomial(random: Random, degree: int) -> str:
    return " + ".join(f"({number(random)})*x^{k}" for k in range(degree + 1))


def damped(random: Random) -> str:
    return f"y'' + {10 ** random.randint(0, 9)}*y' + ({number(random)})*y = 0"


def quadratics(random: Random) -> str:
    """Irreducible factors in the denominator, to some power."""
    factors = "*".join(
        f"(x^2 + ({random.randint(0, 2)})*x + {random.randint(2, 19)})" for _ in range(random.randint(1, 4))
    )
    return f"({polynomial(random, random.randint(0, 3))})/({factors})^{random.randint(1, 2)}"


def rational(random: Random) -> str:
    factors = random.sample(
        ["(x + 1)", "(x + 5/2)", "(x + 7)^2", "(x^2 + 3)", "(x^3 + 2)", "(x - 40)"], random.randint(1, 3)
    )
    return f"({polynomial(random, random.randint(0, 4))})/({'*'.join(factors)})"


def entire(random: Random) -> str:
    return polynomial(random, random.randint(0, 6))


def reducible(random: Random) -> str:
    """S of an omega with poles outside of (-1/2, 30)."""
    omega = X * 0 + number(random) * X ** random.randint(0, 1)
    for _ in range(random.randint(0, 3)):
        omega = omega + number(random) / (X + random.randint(1, 9))
    return str(transform.from_omega(omega))


def orthogonal(random: Random) -> str:
    """Bessel's functions of half an integer, Hermite's and Laguerre's polynomials, of degrees up to 40."""
    n = random.randint(0, 40)
    return random.choice(
        [f"-1 + {n * (n + 1)}/(x + 1)^2", f"x^2 - {2 * n + 1}", f"1/4 - {n + 1}/(x + 1)", f"{n * (n + 1)}/(x + 1)^2"]
    )


def pulled_back(random: Random) -> str:
    kind = random.choice(special_cases.KINDS)
    f = special_cases.rational(random.randint(1, 3), random)
    return str(special_cases.pull_back(special_cases.standard(kind, random), f))


def dihedral(random: Random) -> str:
    """Omega is algebraic: over a square root, or the group is finite."""
    if random.random() < 0.5:
        return str(transform.from_squared_difference((X + random.randint(1, 9)) * number(random)))
    differences = Fraction(1, 2), Fraction(1, 3), Fraction(1, random.randint(3, 5))
    return str(
        transform.pull_back(transform.hypergeometric(*differences), (X + random.randint(50, 99)) / random.randint(2, 9))
    )


def sines(random: Random) -> str:
    first = random.choice(["0", "sin(x)", "cot(x/99 + 1)", "exp(-x)"])
    return f"y'' + ({first})*y' + ({number(random)} + cos(x) + ({number(random)})*sin(2*x))*y = 0"


def forced(random: Random) -> str:
    right = random.choice(["1/(x + 3)", "exp(-x)", "x"])
    return f"y'' + ({number(random)})*y' + ({rational(random)})*y = {right}"


KINDS: dict[str, Callable[[Random], str]] = {
    "constants, damped": damped,
    "quadratic factors": quadratics,
    "any rational S": rational,
    "polynomials": entire,
    "case 1, any omega": reducible,
    "case 1, polynomials": orthogonal,
    "cases 2 and 3": dihedral,
    "pull-backs": pulled_back,
    "sines": sines,
    "right-hand sides": forced,
}
#: Asked for less often: only Taylor's method serves them.
_ONE_ROUTE = ("sines", "right-hand sides")


def question(seed: int) -> Question:
    """The same on every run."""
    random = Random(seed)
    kind = random.choices(list(KINDS), [1 if name in _ONE_ROUTE else 4 for name in KINDS])[0]
    equation = KINDS[kind](random)
    digits = random.choice((5, 15, 15, 15, 50, 200, 1000))
    count = random.choice((1, 1, 1, 1, 10, 200))
    far = random.choice((Fraction(1, 2), 2, 8, 30))
    start = random.choice((0, 0, Fraction(1, 3), 1))
    options: dict[str, Any] = {"x0": start, "y0": 1, "dy0": number(random), "digits": digits}
    points: list[Any] = [start + Fraction(far) * k / count for k in range(1, count + 1)]
    if random.random() < (0.5 if kind == "pull-backs" else 0.1):  # beside the real axis, where most singular points are
        options["x0"] = f"{start} + 1/3*I"
        points = [f"{point} + 1/3*I" for point in points]
    if kind == "pull-backs" and random.random() < 0.3:
        options = {"x0": 0, "which": "regular", "digits": digits}
    last: Any = start + Fraction(far) * Fraction(13, 17)
    if isinstance(points[-1], str):
        last = f"{last} + 1/3*I"
    return Question(kind, equation, points, [last], options)


def emptied() -> list[Any]:
    """Everything that keeps values, once all modules are there."""
    caches = [found for found in gc.get_objects() if isinstance(found, functools._lru_cache_wrapper)]
    return [cache for cache in caches if (cache.__module__ or "").startswith("kovacic")]


def timed(action: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.process_time()
    result = action()
    return time.process_time() - begin, result


def times(asked: Question, method: str | None, caches: list[Any], patience: float) -> tuple[float, float] | None:
    """Of the first call, and of it and the second one; None where the method doesn't serve."""
    for cache in caches:
        cache.cache_clear()
    options = {**asked.options, "method": method, "limits": kovacic.Limits(seconds=patience)}
    try:
        begin = time.process_time()
        solution = kovacic.prepared(asked.equation, **options)
        solution(asked.first)
        first = time.process_time() - begin
        return first, first + timed(lambda: solution(asked.second))[0]
    except kovacic.KovacicError:
        return None


def is_missed(row: dict[str, Any], which: int) -> bool:
    """Does the default take too long, in the first call (0) or in both (1)?"""
    best = min(row[str(method)][which] for method in METHODS if row.get(str(method)))
    return bool(row["None"][which] > FACTOR * best + SPARE)


def ratio(row: dict[str, Any], which: int) -> float:
    """The time of the default over what it may be: above 1 it is missed."""
    best = min(row[str(method)][which] for method in METHODS if row.get(str(method)))
    return float(row["None"][which] / (FACTOR * best + SPARE))


def measured(seed: int, caches: list[Any], patience: float) -> dict[str, Any]:
    asked = question(seed)
    shown = f"{asked.equation}, {len(asked.first)} points to {asked.first[-1]}, {asked.options}"
    row: dict[str, Any] = {"seed": seed, "kind": asked.kind, "question": shown}
    for _ in range(_AGAIN):
        for method in METHODS:
            found, known = times(asked, method, caches, patience), row.get(str(method))
            if found is not None:
                row[str(method)] = found if known is None else tuple(map(min, found, known))
        if row.get("None") is None or not (is_missed(row, 0) or is_missed(row, 1)):
            break
    return row


STANDARD = {
    "Airy": ("x", 0, 4),
    "Bessel, order 1/3": ("-1 - 5/(36*x^2)", 1, 9),
    "Bessel, irrational order": ("-1 - 2/x^2", 1, 9),
    "Bessel, order 2": ("-1 + 15/(4*x^2)", 1, 9),
    "Whittaker": ("1/4 - 1/(3*x) - 5/(36*x^2)", 1, 9),
    "Whittaker, an integer": ("1/4 - 1/(3*x)", 1, 9),
    "Gauss": (str(transform.hypergeometric(Fraction(1, 5), Fraction(1, 7), Fraction(1, 11))), "1/5", "1/2"),
    "two exponentials": ("4", 0, 4),
    "a unique omega, degree 20": ("x^2 - 41", 0, 3),
}


def prices() -> None:
    """What a target costs in a disc that is there, and by a closed form: the numbers of `kovacic.special.prices`."""
    rows = []
    for name, (equation, x0, x) in STANDARD.items():
        for digits in (5, 15, 50, 200, 1000):
            row = [name, str(digits)]
            for method in ("taylor", "closed form"):
                options = {"x0": x0, "y0": 1, "dy0": Fraction(3, 7), "digits": digits, "method": method}
                begin, end = Fraction(x0), Fraction(x)
                points = [begin + (end - begin) * Fraction(k, 41) for k in range(1, 41)]
                solution = kovacic.prepared(equation, **options)
                first, _ = timed(functools.partial(solution, [end]))
                solution(points)
                again, _ = timed(functools.partial(solution, points))
                row += [f"{1e3 * first:.2f}", f"{1e3 * again / len(points):.3f}"]
            rows.append(row)
    print(
        "\n".join(
            frame.table(["equation", "digits", "taylor, first", "a target", "closed form, first", "a target"], rows)
        )
    )


def imports() -> dict[str, float]:
    """What the modules take that a first call imports, in seconds, for calls of three kinds."""
    calls = {
        "import kovacic": "pass",
        "rational": "kovacic.evaluate('x', 1, x0=0, y0=1, dy0=0)",
        "sines": "kovacic.evaluate('y\\'\\' + cos(x)*y = 0', 1, x0=0, y0=1, dy0=0)",
    }
    found = {}
    for name, call in calls.items():
        code = f"import time; import kovacic; {call}; print(time.process_time())"
        seconds = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(3)]
        found[name] = min(seconds)
    return found


def report(rows: list[dict[str, Any]], seed: int, patience: float) -> None:
    done = [row for row in rows if row.get("None")]
    lost = [row for row in rows if not row.get("None") and any(row.get(str(method)) for method in METHODS)]
    lines = ["# Is the route that is chosen the right one?", "", frame.line(), ""]
    lines += [
        f"Regenerate: `python benchmarks/routes.py {len(rows)} --seed {seed} --patience {patience:g}`.  Processor times in",
        f"milliseconds, all caches empty before each first call.  {len(done)} questions; {len(rows) - len(done) - len(lost)}",
        f"were refused by every method, or not ended in {patience:g} s.",
        f"Given up by the default, and not by another method: {len(lost)}.",
        "",
        *(f"- {row['kind']}: {row['question'][:150]}" for row in lost),
        *([""] if lost else []),
    ]
    data: dict[str, Any] = {"seed": seed, "questions": len(done), "lost": lost, "imports": imports()}
    for which, name in enumerate(("first call", "first and second call")):
        missed = [row for row in done if is_missed(row, which)]
        worst = sorted(done, key=lambda row: ratio(row, which), reverse=True)
        sums = {method: sum(row[str(method)][which] for row in done if row.get(str(method))) for method in METHODS}
        lines += [
            f"## The {name}",
            "",
            f"More than {FACTOR:g} times the best method and 1 ms: {len(missed)} of {len(done)}.",
            f"The worst takes {ratio(worst[0], which):.2f} times what it may:",
            "",
        ]
        table = [
            [
                row["kind"],
                f"{ratio(row, which):.2f}",
                *(shown(row, method, which) for method in METHODS),
                row["question"][:150],
            ]
            for row in worst[:12]
        ]
        lines += [
            *frame.table(["kind", "of what it may take", "default", "taylor", "closed form", "question"], table),
            "",
        ]
        data[name] = {"missed": len(missed), "worst": worst[:40], "sums": {str(m): s for m, s in sums.items()}}
    kinds = list(dict.fromkeys(row["kind"] for row in done))
    lines += ["## By kind: the median of the first call, and the sum", ""]
    lines += frame.table(
        ["kind", "questions", "default", "best", "sum", "sum of the best"], [by_kind(done, kind) for kind in kinds]
    )
    seconds = data["imports"]
    lines += ["", "## Imports", "", "Seconds of processor time of a new process, Python's own start included: "]
    lines += [", ".join(f"{name} {value:.2f}" for name, value in seconds.items()) + "."]
    frame.save("routes", data, "\n".join(lines))
    print("\n".join(lines))


def shown(row: dict[str, Any], method: str | None, which: int) -> str:
    found = row.get(str(method))
    return "" if not found else f"{1e3 * found[which]:.3g}"


def by_kind(rows: list[dict[str, Any]], kind: str) -> list[str]:
    own = [row for row in rows if row["kind"] == kind]
    default = sorted(row["None"][0] for row in own)
    best = sorted(min(row[str(m)][0] for m in METHODS if row.get(str(m))) for row in own)
    middle = len(own) // 2
    numbers = (default[middle], best[middle], sum(default), sum(best))
    return [kind, str(len(own)), *(f"{1e3 * value:.3g}" for value in numbers)]


def main() -> None:
    arguments = frame.parser(__doc__)
    arguments.add_argument("count", type=int, nargs="?", default=1000)
    arguments.add_argument("--prices", action="store_true", help="print what a target costs on each way, and end")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--patience", type=float, default=20.0, help="seconds after which a method is given up")
    arguments.add_argument("--rows", type=Path, help="a file that keeps the rows, from which a run goes on")
    given = arguments.parse_args()
    warnings.simplefilter("ignore")
    if given.prices:
        prices()
        return
    for seed in range(-40, 0):  # so that every module is there
        for method in METHODS:
            times(question(seed), method, [], given.patience)
    caches, rows = emptied(), []
    if given.rows and given.rows.exists():
        rows = [json.loads(line) for line in given.rows.read_text(encoding="utf-8").splitlines()]
    first = given.seed * 1_000_000
    for seed in range(first + len(rows), first + given.count):
        rows.append(measured(seed, caches, given.patience))
        if given.rows:
            with given.rows.open("a", encoding="utf-8") as kept:
                kept.write(json.dumps(rows[-1]) + "\n")
    report(rows, given.seed, given.patience)


if __name__ == "__main__":
    main()
