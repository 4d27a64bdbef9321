"""How long does a call work after its time is over?  Heavy equations through every public call that has limits.

The limit is `seconds`, and the clock that it is read from is the processor's (`kovacic.limits.CLOCK`), so that the load of
the machine plays no part.  The excess of a call is the processor time that it took beyond 1.2 * seconds + 0.1: what should be
0 everywhere.  Each family of equations is made in several sizes, from such as take a moment to such as take hours; the
answers of which the views are asked are solved before, with more time, where that is enough.  What a process loads once
(SymPy, NumPy, matplotlib) was loaded before.  A call that works for 10 s longer is ended, and said.

Regenerate:  python benchmarks/limits.py                     writes results/limits.{json,md}; an hour on two cores
             python benchmarks/limits.py --level 1           the same with the middle sizes alone, 20 minutes
             python benchmarks/limits.py --family poles --call solve --seconds 0.5      prints those alone
"""

from __future__ import annotations

import itertools
import json
import math
import random
import resource
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any
from unittest.mock import patch

import families
import frame
import sympy
import transform

import kovacic
from kovacic.errors import KovacicError
from kovacic.limits import CLOCK, Limits

SECONDS = (0.1, 0.3, 1.0)
#: What is prepared may take so long; a call that takes longer than this is ended.
PREPARATION, LONGEST = 20.0, 10.0
#: Seconds on the wall without a word, after which a process is killed.
_SILENCE = 200.0
X = families.X


# --- The equations: a function of the size.  A text, a pair of coefficient lists, or a SymPy expression.


def power(n: int) -> str:
    return f"(x^2+3*x+7)^{n}+x"


def power_of_a_quotient(n: int) -> str:
    return f"(x+1)^{n}/(x^2-2)^{n // 2} + x"


def nested_powers(n: int) -> str:
    return f"((x+1)^{n}+(x+2)^{n}+1/3)^{n}"


def pole_of_high_order(n: int) -> str:
    return f"1/x^{n} + 3/(x-1)^{n // 2} + x"


def pole_of_high_order_on_curves(n: int) -> str:
    return f"(x+5)/(x^2-x+3)^{n}"


def hermite(n: int) -> str:
    return f"y'' - 2*x*y' + {2 * n}*y = 0"


def legendre(n: int) -> str:
    return f"(1-x^2)*y'' - 2*x*y' + {n * (n + 1)}*y = 0"


def gegenbauer_shifted(n: int) -> str:
    return f"(1-(x-1/3)^2)*y'' - 3*(x-1/3)*y' + {n * (n + 2)}*y = 0"


def bessel_of_half_order(n: int) -> str:
    return f"x^2*y'' + x*y' + (x^2 - ({2 * n + 1}/2)^2)*y = 0"


def exponents_apart(n: int) -> str:
    return f"x^4 + {2 * n}*x + 1"


def poles(n: int) -> str:
    return "+".join(f"{3 + i % 5}/(4*(x-{i})^2)" for i in range(1, n + 1))


def poles_of_order_four(n: int) -> str:
    return "+".join(f"1/(x-{i})^4" for i in range(1, n + 1))


def quintic_poles(n: int) -> str:
    return families.unique_irreducible(n, random.Random(n)).to_str("x")


def accessory(n: int) -> str:
    return families.none_accessory(n, random.Random(n)).to_str("x")


def diagonal(n: int) -> str:
    return families.diagonal(n, random.Random(n)).to_str("x")


def roots_of_unity(n: int) -> str:
    return f"1/(x^{n} - 1)"


def irreducible_denominator(n: int) -> str:
    return f"(x+2)/(x^{n} + x + 3)^2"


def icosahedral(n: int) -> str:
    build = families.FAMILIES["case 3, icosahedral"][0]
    return build(n, random.Random(n)).to_str("x")


def dicyclic(n: int) -> str:
    curve = (X**3 + X + 1) ** 2 - 3
    return transform.from_squared_product(curve / (3 * X**2 + 1) ** 2, Fraction(4, n * n)).to_str("x")


def long_constant(n: int) -> str:
    return f"x^2 + 1{'0' * (n - 1)}7"


def long_constants(n: int) -> tuple[list[int], list[int]]:
    rng = random.Random(n)
    return [rng.randrange(10**n) for _ in range(9)], [rng.randrange(10**n) for _ in range(5)]


def many_coefficients(n: int) -> tuple[list[int], list[int]]:
    rng = random.Random(n)
    return [rng.randrange(10**9) for _ in range(n)], [rng.randrange(10**9) for _ in range(n // 2)]


def number_field(n: int) -> str:
    return f"(sqrt(2)*x^{n} + sqrt(3)*x + 1)/(x - sqrt(5))^2"


def deep_number_field(n: int) -> str:
    return f"(x^{n}+1)*(sqrt(2)+sqrt(3)*x)^2*(1+sqrt(7)/x)"


def exponentials(n: int) -> str:
    return f"y'' = (exp({2 * n}*x) + 3*exp(x) + 1/(1+exp(x))^{n})*y"


def trigonometric(n: int) -> str:
    return f"y'' + sin(x)^{n}*y'/(2+cos(x))^{n} + tan(x)*y = 0"


def hyperbolic(n: int) -> str:
    return f"y'' = ({n * (n + 1)} - {n * (n - 1)}/cosh(x)^2 + tanh(x)^{n})*y"


def parameters(n: int) -> str:
    return f"(n^2*x^{n} + a*x + 1)/(x^3 + n*x + a)^2"


def polynomial_parameters(n: int) -> str:
    return "+".join(f"a{i}*x^{i}" for i in range(min(n, 6))) + f"+x^{2 * n}"


def parameters_at_poles(n: int) -> str:
    return "(x+a)^2 + b/(x-c)^2 + " + "+".join(f"a^{i}/(x-{i})" for i in range(1, n))


def sympy_expression(n: int) -> Any:
    x = sympy.Symbol("x")
    return sum((x + i) ** n / (x - i) ** 2 for i in range(1, n))


def long_sum(n: int) -> str:
    return "+".join(f"{i}/(x^2+{i}*x+{i * i + 1})" for i in range(1, n))


def long_solution(n: int) -> str:
    """y = exp(x^3) P with a random P of degree n."""
    rng = random.Random(n)
    omega = 3 * X**2
    for _ in range(4):
        P = families._random_poly(rng, n // 4)
        omega = omega + families.RatFunc(P.derivative(), P)
    return transform.from_omega(omega).to_str("x")


FAMILIES: dict[str, tuple[Callable[[int], Any], tuple[int, ...]]] = {
    "power": (power, (300, 2000, 5000)),
    "power of a quotient": (power_of_a_quotient, (500, 4000, 9000)),
    "nested powers": (nested_powers, (10, 40, 100)),
    "pole of high order": (pole_of_high_order, (100, 2000, 10000)),
    "pole of high order on curves": (pole_of_high_order_on_curves, (60, 600, 5000)),
    "hermite": (hermite, (500, 4000, 12000)),
    "legendre": (legendre, (300, 3000, 9000)),
    "gegenbauer, shifted": (gegenbauer_shifted, (300, 3000, 9000)),
    "bessel of half order": (bessel_of_half_order, (300, 3000, 9000)),
    "exponents apart": (exponents_apart, (501, 5001, 20001)),
    "poles": (poles, (40, 200, 1000)),
    "poles of order 4": (poles_of_order_four, (20, 100, 500)),
    "quintic poles": (quintic_poles, (20, 60, 200)),
    "accessory parameters": (accessory, (20, 80, 300)),
    "diagonal": (diagonal, (20, 60, 150)),
    "roots of unity": (roots_of_unity, (60, 720, 5040)),
    "irreducible denominator": (irreducible_denominator, (30, 300, 2000)),
    "icosahedral": (icosahedral, (10, 40, 100)),
    "dicyclic": (dicyclic, (29, 299, 2003)),
    "long constant": (long_constant, (1000, 20000, 90000)),
    "long constants": (long_constants, (100, 3000, 40000)),
    "many coefficients": (many_coefficients, (30, 300, 3000)),
    "number field": (number_field, (6, 30, 150)),
    "deep number field": (deep_number_field, (4, 20, 100)),
    "exponentials": (exponentials, (3, 12, 60)),
    "trigonometric": (trigonometric, (2, 6, 20)),
    "hyperbolic": (hyperbolic, (3, 12, 60)),
    "parameters": (parameters, (3, 8, 40)),
    "polynomial parameters": (polynomial_parameters, (2, 6, 30)),
    "parameters at poles": (parameters_at_poles, (2, 5, 12)),
    "sympy": (sympy_expression, (5, 15, 40)),
    "long sum": (long_sum, (20, 80, 300)),
    "long solution": (long_solution, (40, 160, 600)),
}


# --- The calls.  Of the equation itself:

START: dict[str, Any] = {"y0": 1, "dy0": "1/2"}


def _dsolve(equation: Any, limits: Limits, **options: Any) -> object:
    if not (isinstance(equation, str) and "y" in equation):
        equation = f"y'' = ({_text(equation)})*y"
    return kovacic.dsolve(equation, var="x", limits=limits, **options)


def _forced(equation: Any, limits: Limits) -> object:
    if isinstance(equation, str) and "=" in equation:
        return kovacic.dsolve(equation.replace("= 0", "= sin(x)/(x^2+1)"), var="x", limits=limits)
    return kovacic.dsolve(f"y'' = ({_text(equation)})*y + sin(x)/(x^2+1)", var="x", limits=limits)


def _text(equation: Any) -> str:
    if isinstance(equation, tuple):
        top, bottom = (families.QQ.poly(part).to_str("x") for part in equation)
        return f"({top})/({bottom})"
    return str(equation)


def _riccati(equation: Any, limits: Limits) -> object:
    return kovacic.solve_riccati(_text(equation), 0, -1, var="x", limits=limits)


def _sampled(equation: Any, limits: Limits) -> object:
    from kovacic.enclosure.request import Request
    from kovacic.limits import Budget
    from kovacic.views.plot import sampled_curve

    with Budget(limits).watched():
        request = Request.of("sample", {"digits": 40, "limits": limits})
        return sampled_curve(equation, "-0.7", "0.6", 400, request)


def _batched(equation: Any, limits: Limits) -> object:
    """What a batch does for one of its equations, in the parent and in a worker, here in one process."""
    from kovacic.batch.files import item_from
    from kovacic.batch.records import Job
    from kovacic.batch.worker import solve_item

    job = Job(limits=limits, group=True)
    item = item_from(1, equation, var="x", limits=limits)
    if item.error is not None:
        raise item.error
    return solve_item(item, job, job.engine_limits)


def _levels(equation: Any, limits: Limits) -> object:
    return kovacic.spectrum(f"x^2 + ({_text(equation)})", var="x", limits=limits)


OF_AN_EQUATION: dict[str, Callable[[Any, Limits], object]] = {
    "solve": lambda S, limits: kovacic.solve(S, var="x", limits=limits),
    "decide": lambda S, limits: kovacic.decide(S, var="x", limits=limits),
    "conditions": lambda S, limits: kovacic.conditions(S, var="x", limits=limits),
    "dsolve": _dsolve,
    "dsolve with values": partial(_dsolve, ics={"y(1/3)": 1, "y'(1/3)": 0}),
    "dsolve with a right-hand side": _forced,
    "solve_riccati": _riccati,
    "evaluate": lambda S, limits: kovacic.evaluate(S, "2.75", x0="2.25", limits=limits, **START),
    "evaluate, 5,000 digits": lambda S, limits: kovacic.evaluate(
        S, "2.75", x0="2.25", digits=5000, limits=limits, **START
    ),
    "evaluate, many points": lambda S, limits: kovacic.evaluate(
        S, [Fraction(k, 300) for k in range(301)], x0="1/2", path="chain", limits=limits, **START
    ),
    "tabulate": lambda S, limits: kovacic.tabulate(S, "2.1", "2.9", x0="2.25", limits=limits, **START),
    "connection_matrix": lambda S, limits: kovacic.connection_matrix(S, ["2.1", 2.5 + 1j, "2.9"], limits=limits),
    "monodromy": lambda S, limits: kovacic.monodromy(S, limits=limits),
    "sample": _sampled,
    "solve_many": _batched,
    "spectrum": _levels,
}

# Of an answer:

#: The answers that were prepared, as JSON.
_WRITTEN: dict[Any, str] = {}


def _explained(answer: Any, format: str) -> object:
    return answer.explain(format=format)


def _plotted(answer: Any) -> object:
    from matplotlib import pyplot

    try:
        return answer.plot("2.1", "2.9")
    finally:
        pyplot.close("all")


OF_AN_ANSWER: dict[str, Callable[[Any], object]] = {
    "verify": lambda answer: answer.verify(),
    "group": lambda answer: answer.group,
    "equation_group": lambda answer: answer.equation_group,
    "is_algebraic": lambda answer: answer.is_algebraic,
    "closed_form": lambda answer: answer.closed_form,
    "solutions": lambda answer: answer.solutions,
    "special": lambda answer: answer.special,
    "generic_conditions": lambda answer: answer.generic_conditions,
    "to_json": lambda answer: answer.to_json(full=True),
    "from_json": lambda answer: kovacic.Solution.from_json(_WRITTEN[answer.S], limits=answer.limits),
    "explain": partial(_explained, format="text"),
    "explain: HTML": partial(_explained, format="html"),
    "explain: LaTeX": partial(_explained, format="latex"),
    "at": lambda answer: answer.at("2.75", x0="2.25", digits=200, **START),
    "at: closed form": lambda answer: answer.at("2.75", x0="2.25", method="closed form", **START),
    "lambdify": lambda answer: answer.lambdify(interval=("2.1", "2.9")),
    "plot": _plotted,
    "compare_with_monodromy": lambda answer: answer.compare_with_monodromy(),
}

# Of conditions:


def _values(found: Any, size: int) -> dict[str, int]:
    return {name: size + i for i, name in enumerate(found.parameters)}


def _mapped(found: Any) -> object:
    from matplotlib import pyplot

    fixed = dict.fromkeys(found.parameters[2:], 1)
    try:
        return found.plot(
            parameters=found.parameters[:2], ranges=[(-2, 2)] * min(2, len(found.parameters)), fixed=fixed
        )
    finally:
        pyplot.close("all")


OF_CONDITIONS: dict[str, Callable[[Any], object]] = {
    "check": lambda found: found.check(10**6),
    "case_at": lambda found: found.case_at(_values(found, 10007)),
    "solve_at": lambda found: found.solve_at(_values(found, 10007)),
    "determinant": lambda found: found.determinant(30),
    "conditions: to_json": lambda found: found.to_json(),
    "conditions: explain": lambda found: found.explain(),
    "conditions.plot": _mapped,
}


# --- Measuring.


@dataclass(frozen=True)
class Row:
    """One call: its equation, its limit, the processor time that it took, and how it ended."""

    family: str
    size: int
    seconds: float
    call: str
    used: float
    ended: str

    @property
    def excess(self) -> float:
        return self.used - 1.2 * self.seconds - 0.1

    @property
    def is_noteworthy(self) -> bool:
        return self.excess > 0 or self.ended.startswith("!!")

    def __str__(self) -> str:
        return f"{self.excess:6.2f}  {self.family} {self.size}  {self.call}  {self.seconds} s: {self.ended}"


def measured(call: Callable[[], object], seconds: float) -> tuple[float, str]:
    """The processor time of a call whose limit is a processor time, too, and how it ended."""
    start = time.process_time()
    try:
        with patch.object(CLOCK, "now", time.process_time):
            found = call()
        ended = str(getattr(found, "status", "") or type(found).__name__)
    except KovacicError as error:
        ended = f"{type(error).__name__}: {error}"
    except NotImplementedError as error:
        ended = f"NotImplementedError: {error}"
    except Exception as error:  # whatever else happens is a find of this script
        ended = f"!! {type(error).__name__}: {error}"
    return time.process_time() - start, ended.split("\n")[0][:200]


def work(family: str, size: int, seconds: float, names: list[str]) -> None:
    """Prints a line of JSON before and after each call of one equation: what a process of its own does."""
    warnings.simplefilter("ignore")
    prepare()
    limits = Limits(seconds=seconds)
    equation = FAMILIES[family][0](size)
    answer: Any = None
    found: Any = None
    _end_after(time.process_time() + 2 * PREPARATION)
    for name in names:
        call: Callable[[], object]
        if name in OF_AN_EQUATION:
            call = partial(OF_AN_EQUATION[name], equation, limits)
        elif name in OF_AN_ANSWER:
            if answer is None:
                _end_after(time.process_time() + 2 * PREPARATION)
                answer = solved(equation)
            if answer is False:
                continue
            call = partial(OF_AN_ANSWER[name], replace(answer, limits=limits))
        else:
            if found is None:
                _end_after(time.process_time() + 2 * PREPARATION)
                found = conditions_of(equation)
            if found is False:
                continue
            call = partial(OF_CONDITIONS[name], replace(found, limits=limits))
        print(json.dumps({"call": name}), flush=True)
        _end_after(time.process_time() + seconds + LONGEST)
        used, ended = measured(call, seconds)
        print(json.dumps({"call": name, "used": used, "ended": ended}), flush=True)


def _end_after(processor_time: float) -> None:
    """Let the system end this process once it has used so much."""
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(processor_time), hard))


def prepare() -> None:
    """Everything that is loaded once, is loaded."""
    small = solved("x^2 + 3")
    for name, call in OF_AN_EQUATION.items():
        measured(partial(call, "a*x^2 + 3" if name == "conditions" else "x^2 + 3", Limits()), 9)
    for of_answer in OF_AN_ANSWER.values():
        measured(partial(of_answer, replace(small)), 9)
    found = kovacic.conditions("a*x^2 + b")
    for of_conditions in OF_CONDITIONS.values():
        measured(partial(of_conditions, replace(found, limits=Limits(seconds=0.2))), 9)


def solved(equation: Any) -> Any:
    """The answer, False if it takes too long."""
    try:
        answer = kovacic.solve(equation, var="x", limits=Limits(seconds=PREPARATION))
        if answer.status is kovacic.Status.UNDECIDED:
            return False
        _WRITTEN[answer.S] = answer.to_json()
    except KovacicError:
        return False
    return answer


def conditions_of(equation: Any) -> Any:
    try:
        return kovacic.conditions(equation, var="x", limits=Limits(seconds=PREPARATION))
    except KovacicError:
        return False


def rows_of(family: str, size: int, seconds: float, names: list[str]) -> Iterator[Row]:
    """What the processes for one equation say; one that doesn't go on is ended, and another one has the rest of the calls."""
    while names:
        process = subprocess.Popen(
            [sys.executable, __file__, "--work", family, str(size), str(seconds), *names],
            stdout=subprocess.PIPE,
            text=True,
        )
        begun = None
        for said in _lines(process):
            begun = None if "used" in said else said["call"]
            if begun is None:
                names = names[names.index(said["call"]) + 1 :]
                yield Row(family, size, seconds, **said)
        status = process.wait()
        if begun is None:  # all is done, or what was to be prepared wasn't
            if status:
                print(f"        {family} {size}: nothing prepared for {', '.join(names)} (status {status})", flush=True)
            return
        names = names[names.index(begun) + 1 :]
        yield Row(family, size, seconds, begun, seconds + LONGEST, f"!! ended by the measurement: status {status}")


def _lines(process: Any) -> Iterator[dict[str, Any]]:
    """What it prints; where nothing comes for a long time, it is killed."""
    while True:
        timer = threading.Timer(_SILENCE, process.kill)
        timer.start()
        line = process.stdout.readline()
        timer.cancel()
        if not line:
            return
        yield json.loads(line)


def calls_of(family: str, wanted: list[str] | None) -> list[str]:
    """Conditions are for equations with parameters."""
    names = [*OF_AN_EQUATION, *OF_AN_ANSWER, *OF_CONDITIONS]
    if "parameters" not in family.split():
        names = [name for name in names if name not in OF_CONDITIONS and name != "conditions"]
    return [name for name in names if not wanted or name in wanted]


def tasks_of(options: Any) -> Iterator[tuple[str, int, float, list[str]]]:
    """Each equation with one of the limits, in turn, or with those that were asked for."""
    turns = itertools.cycle(SECONDS)
    for family in options.family or FAMILIES:
        sizes = options.size or [FAMILIES[family][1][level] for level in options.level or range(3)]
        for size in sizes:
            for seconds in options.seconds or [next(turns)]:
                yield family, size, seconds, calls_of(family, options.call)


def measure(task: tuple[str, int, float, list[str]]) -> list[Row]:
    rows = []
    for row in rows_of(*task):
        rows.append(row)
        if row.is_noteworthy:
            print(row, flush=True)
    return rows


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument("--family", action="append", help="only those (may be repeated)")
    parser.add_argument("--call", action="append", help="only those (may be repeated)")
    parser.add_argument("--seconds", type=float, action="append", help="the limits (may be repeated)")
    parser.add_argument("--size", type=int, action="append", help="these sizes instead of those of each family")
    parser.add_argument("--level", type=int, action="append", help="the first (0), second or third size of each family")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--work", nargs="+", help="(what its processes are started with)")
    options = parser.parse_args()
    if options.work:
        family, size, seconds, *names = options.work
        work(family, int(size), float(seconds), names)
        return
    tasks = list(tasks_of(options))
    with ThreadPoolExecutor(options.jobs) as pool:
        rows = [row for found in pool.map(measure, tasks) for row in found]
    late = [row for row in rows if row.is_noteworthy]
    print(f"{len(rows)} calls, {len(late)} with an excess")
    if not (options.family or options.call):
        data = {"calls": len(rows), "equations": len(tasks), "late": [asdict(row) for row in late]}
        frame.save("limits", data, report(rows, len(tasks)))


def report(rows: list[Row], equations: int) -> str:
    """The Markdown of the results: for each call, how many were tried, how many ran out of time, and the worst excess."""
    families_tried = len({row.family for row in rows})
    limits = ", ".join(f"{seconds:g}" for seconds in sorted({row.seconds for row in rows}))
    lines = [
        "# Limits of time",
        "",
        frame.line(),
        "",
        f"{len(rows)} calls, of {equations} equations out of {families_tried} families, with limits of {limits} s of processor",
        "time.  The excess is the processor time beyond 1.2 * limit + 0.1 s.",
        "",
    ]
    table = []
    for name in [*OF_AN_EQUATION, *OF_AN_ANSWER, *OF_CONDITIONS]:
        mine = [row for row in rows if row.call == name]
        if not mine:
            continue
        out_of_time = sum(row.used > row.seconds for row in mine)
        late = sum(row.excess > 0 for row in mine)
        worst = max(mine, key=lambda row: row.excess)
        shown = f"{worst.excess:.2f} ({worst.family} {worst.size})" if late else "none"
        table.append([name, str(len(mine)), str(out_of_time), str(late), shown])
    lines += frame.table(["call", "tried", "used up the time", "in excess", "worst excess, s"], table)
    return "\n".join(lines)


if __name__ == "__main__":
    main()
