"""Eigenvalues as proven numbers: are published digits in the balls, and how long does a level take?

    python benchmarks/eigenvalues.py [--peers] [NAME ...]

Each problem is a line: what it is, where its digits were published, and its first levels.  With --peers the levels of
potentials are computed in two other ways, too, on an interval that is given with the problem: by Chebyshev collocation in
NumPy (64 and 128 points), and by finite differences with SciPy's eigh_tridiagonal (20,000 points).
"""

from __future__ import annotations

import json
import math
import statistics
import time
from typing import Any, NamedTuple

import frame

import kovacic

PRYCE = "J. D. Pryce, Numerical Solution of Sturm-Liouville Problems, 1993, problem "
LINE = (-8.0, 8.0)
HALF_LINE = (0, "oo")
WOODS_SAXON = "50*(1 - 5/(3*(1 + exp((7-x)*5/3))))/(1 + exp((x-7)*5/3))"


class Benchmark(NamedTuple):
    """`published` has decimals by the number of the level.

    `q` is given where the equation is -y'' + q y = E y with y = 0 at both ends, and `window` replaces infinite ones.
    """

    name: str
    equation: str
    published: dict[int, str]
    source: str
    conditions: str | None = None
    domain: tuple[Any, Any] | None = None
    count: int = 2
    q: str = ""
    window: tuple[float, float] = LINE


def potential(name: str, q: str, published: dict[int, str], source: str, **given: Any) -> Benchmark:
    """A problem in Schroedinger's form."""
    return Benchmark(name, f"-y'' + ({q})*y = E*y", published, source, q=q, **given)


PROBLEMS = (
    potential("quartic", "x^4", {0: "1.06036209048418", 1: "3.79967302980139"}, "Hioe & Montroll 1975", count=6),
    potential("cosh", "cosh(x)", {}, "no formula", count=4, window=(-6, 6)),
    potential("kink", "abs(x)", {0: "1.01879297164747", 1: "2.33810741045977"}, "DLMF 9.9", window=(-16, 16)),
    potential("double well", "x^4 - 20*x^2", {}, "the lowest pair is split by 1e-16", count=4),
    potential("box", "-2/x", {}, "hydrogen in a box", conditions="y(0)=0, y(10)=0", count=3, window=(0, 10)),
    potential(
        "Paine",
        "1/(x + 1/10)^2",
        {0: "1.5198658211", 1: "4.9433098221", 2: "10.284662645", 3: "17.559957746"},
        PRYCE + "1",
        conditions="y(0)=0, y(pi)=0",
        count=4,
        window=(0, math.pi),
    ),
    Benchmark(
        "Klotter",
        "-y'' + 3*y/(4*x^2) = E*64*pi^2*y/(9*x^6)",
        {0: "1", 1: "4", 2: "9"},
        PRYCE + "3",
        "y(8/7)=0, y(8)=0",
        count=3,
    ),
    potential(
        "Coffey-Evans",
        "-40*cos(2*x) + 400*sin(2*x)^2",
        {0: "0.0000000000000", 3: "151.46322365766"},
        PRYCE + "7",
        conditions="y(-pi/2)=0, y(pi/2)=0",
        count=5,
        window=(-math.pi / 2, math.pi / 2),
    ),
    Benchmark("Bessel 1/3", "(x*y')' - y/(9*x) + E*x*y = 0", {0: "8.4250069295"}, PRYCE + "12", "y(0)=0, y(1)=0"),
    Benchmark("Bessel 2", "(x*y')' - 4*y/x + E*x*y = 0", {0: "26.374616427"}, PRYCE + "12", "y(0)=0, y(1)=0"),
    potential("sech", "-12/cosh(x)^2", {0: "-9", 1: "-4", 2: "-1"}, PRYCE + "14", count=3, window=(-20, 20)),
    Benchmark(
        "Legendre 1/4",
        "((1-x^2)*y')' - y/(4*(1-x^2)) + E*y = 0",
        {0: "0.75", 1: "3.75"},
        PRYCE + "15",
        None,
        (-1, 1),
    ),
    potential("cubic", "x^3", {0: "3.4505626899"}, PRYCE + "17", conditions="y(0)=0", domain=HALF_LINE, window=(0, 8)),
    potential(
        "quintic", "x^5", {0: "4.0891593149"}, PRYCE + "17", conditions="y(0)=0", domain=HALF_LINE, window=(0, 5)
    ),
    Benchmark("Bessel 0", "x*y'' + y' + E*x*y = 0", {0: "5.78318596295"}, PRYCE + "18", "y(0)=bounded, y(1)=0"),
    Benchmark("Legendre", "((1-x^2)*y')' + E*y = 0", {0: "0.0", 1: "2"}, PRYCE + "20", None, (-1, 1)),
    Benchmark(
        "Latzko",
        "((1-x^7)*y')' + E*x^7*y = 0",
        {0: "8.7274703526", 2: "435.06333218"},
        PRYCE + "24",
        "y(0)=0",
        (0, 1),
        3,
    ),
    Benchmark("x^4 y'", "(x^4*y')' + 2*x^2*y + E*x^4*y = 0", {0: "9.869604401089358"}, PRYCE + "25", "y(1)=0", (0, 1)),
    Benchmark("seven", "(x^3*y')' - x^3*y + E*x^2*y = 0", {0: "7.0000000000"}, PRYCE + "26", "y(1)=0", (0, 1)),
    potential("Airy", "x", {0: "2.3381074104"}, PRYCE + "27", conditions="y(0)=0", domain=HALF_LINE, window=(0, 25)),
    potential("oscillator", "x^2", {0: "1", 1: "3", 2: "5", 3: "7"}, PRYCE + "28", count=4),
    potential(
        "hydrogen",
        "2/x^2 - 1/x",
        {0: "-0.0625", 1: "-0.0277777777777778"},
        PRYCE + "29",
        domain=HALF_LINE,
        window=(0, 200),
    ),
    potential(
        "Coulomb",
        "-1/x",
        {0: "-0.25", 1: "-0.0625"},
        PRYCE + "30",
        conditions="y(0)=0",
        domain=HALF_LINE,
        window=(0, 100),
    ),
    potential("Laguerre", "x^2 + 3/(4*x^2)", {0: "4", 1: "8"}, PRYCE + "32", domain=HALF_LINE, window=(0, 8)),
    Benchmark(
        "Raman",
        "-y'' + (-7*x^2 + x^3/2 + x^4)*y = E*y/2",
        {0: "-24.5175977072", 5: "8.10470769427"},
        PRYCE + "33",
        count=6,
    ),
    potential(
        "Morse",
        "9*exp(-2*x) - 18*exp(-x)",
        {0: "-6.25", 1: "-2.25", 2: "-0.25"},
        PRYCE + "35",
        count=3,
        window=(-2, 30),
    ),
    potential("anharmonic", "x^2 + x^4", {0: "1.3923516415"}, PRYCE + "37"),
    potential(
        "Woods-Saxon",
        f"-{WOODS_SAXON}",
        {0: "-49.457788728"},
        PRYCE + "41",
        conditions="y(0)=0",
        domain=HALF_LINE,
        window=(0, 25),
    ),
    potential(
        "screened",
        "(-1 + 5*exp(-2*x))/x",
        {0: "-0.156358880971", 2: "-0.023484895664"},
        PRYCE + "42",
        conditions="y(0)=0",
        domain=HALF_LINE,
        count=3,
        window=(0, 150),
    ),
)


def compute(problem: Benchmark, digits: int = 15) -> tuple[list[kovacic.Ball], list[int], list[float]]:
    """The balls, the numbers of zeros, and the seconds until each was known."""
    from kovacic.general_solution.boundary_problems import read_eigenproblem

    read = read_eigenproblem(problem.equation, problem.conditions, parameter="E", domain=problem.domain)
    values, zeros, seconds = [], [], []
    start = time.process_time()
    for level in read.levels(problem.count, digits):
        now = time.process_time()
        values.append(level.value)
        zeros.append(level.zeros)
        seconds.append(now - start)
        start = now
    return values, zeros, seconds


def agrees(ball: kovacic.Ball, published: str) -> bool:
    """Is the decimal, with an error of one in its last place, met by the ball?"""
    last = 10.0 ** -len(published.partition(".")[2]) if "." in published else 0.0
    return abs(float(ball) - float(published)) <= last + ball.radius


def collocation(problem: Benchmark, points: int) -> list[float]:
    """The lowest eigenvalues of the Chebyshev collocation matrix with y = 0 at both ends of the window."""
    import numpy as np
    import sympy

    window = problem.window
    k = np.arange(points + 1)
    t = np.cos(np.pi * k / points)
    weights = np.where((k == 0) | (k == points), 2.0, 1.0) * (-1.0) ** k
    difference = t[:, None] - t[None, :] + np.eye(points + 1)
    D = np.outer(weights, 1 / weights) / difference
    D -= np.diag(D.sum(axis=1))
    half = (window[1] - window[0]) / 2
    x = window[0] + half * (t + 1)
    from kovacic.reading.symbolic import read_expression

    q = sympy.lambdify(sympy.Symbol("x"), read_expression(problem.q), "numpy")(x[1:-1])
    matrix = -(D @ D)[1:-1, 1:-1] / half**2 + np.diag(q * np.ones(points - 1))
    return sorted(float(value.real) for value in np.linalg.eigvals(matrix))[: problem.count]


def differences(problem: Benchmark, points: int = 20_000) -> list[float]:
    """The lowest eigenvalues of the matrix of second differences with y = 0 at both ends of the window."""
    import numpy as np
    import sympy
    from scipy.linalg import eigh_tridiagonal

    from kovacic.reading.symbolic import read_expression

    x, h = np.linspace(*problem.window, points + 2, retstep=True)
    q = sympy.lambdify(sympy.Symbol("x"), read_expression(problem.q), "numpy")(x[1:-1])
    diagonal = 2 / h**2 + q * np.ones(points)
    beside = np.full(points - 1, -1 / h**2)
    found = eigh_tridiagonal(diagonal, beside, eigvals_only=True, select="i", select_range=(0, problem.count - 1))
    return [float(value) for value in found]


def report(records: list[dict[str, Any]], seconds: list[float]) -> str:
    """The page of results."""
    agree = sum(record["agrees"] is True for record in records)
    named = sum(record["agrees"] is not None for record in records)
    lines = [
        f"# {len(seconds)} eigenvalues with 15 proven digits: `python benchmarks/eigenvalues.py`",
        "",
        frame.line(),
        "",
        f"Median {statistics.median(seconds):.2f} s of processor time a level, {max(seconds):.1f} s at most; the published "
        f"digits are met by the balls in {agree} of {named} problems that have some. The first level includes "
        "the search for the range. Collocation: the largest error of the same levels with 64 and 128 Chebyshev points; SciPy: "
        "that of finite differences with 20,000 points, and the seconds for all levels together.",
        "",
    ]
    rows = []
    for record in records:
        first, last = record["levels"][0], record["levels"][-1]
        collocation = ", ".join(record["collocation"]) or "-"
        times = ", ".join(f"{s:.2f}" for s in record["seconds"])
        agrees = {True: "yes", False: "NO", None: "-"}[record["agrees"]]
        scipy = record["scipy"] or "-"
        rows.append([record["problem"], first, last, str(record["zeros"][-1]), agrees, times, collocation, scipy])
    head = [
        "problem",
        "first level",
        "last level",
        "its zeros",
        "published agree",
        "seconds a level",
        "collocation",
        "SciPy",
    ]
    return "\n".join([*lines, *frame.table(head, rows)]) + "\n"


def record_of(problem: Benchmark, *, peers: bool) -> dict[str, Any]:
    """What is measured for a problem."""
    values, zeros, seconds = compute(problem)
    published = [agrees(values[k], text) for k, text in problem.published.items()]
    errors = []
    for points in (64, 128) if peers and problem.q else ():
        pairs = zip(collocation(problem, points), values, strict=True)
        errors.append(f"{max(abs(a - float(b)) for a, b in pairs):.0e}")
    scipy = ""
    if peers and problem.q:
        start = time.process_time()
        found = differences(problem)
        seconds_of_scipy = time.process_time() - start
        error = max(abs(a - float(b)) for a, b in zip(found, values, strict=True))
        scipy = f"{error:.0e}, {seconds_of_scipy:.2f} s"
    return {
        "problem": problem.name,
        "levels": [str(ball) for ball in values],
        "zeros": zeros,
        "agrees": all(published) if published else None,
        "source": problem.source,
        "seconds": [round(s, 3) for s in seconds],
        "collocation": errors,
        "scipy": scipy,
    }


def main() -> None:
    """Print a line a problem, and write the results if all were measured."""
    parser = frame.parser(__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--peers", action="store_true")
    given = parser.parse_args()
    records = []
    for problem in PROBLEMS:
        if not given.names or problem.name in given.names:
            records.append(record_of(problem, peers=given.peers))
            print(json.dumps(records[-1]), flush=True)
    if not given.names:
        seconds = [s for record in records for s in record["seconds"]]
        frame.save("eigenvalues", {"problems": records}, report(records, seconds))


if __name__ == "__main__":
    main()
