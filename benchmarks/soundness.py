"""Is the exact value in the ball?  Generated natural calls of `evaluate`, against integrators that share nothing with it.

Regenerate:  python benchmarks/soundness.py 5000 --seed 1     (an hour; nice 19)
prints, and writes results/soundness.{json,md}.  With --rows FILE each call's row is added to that file, and a run that was
ended goes on after its last one.

Each call is made twice, at some 5 to 30 digits and at 25 more, on another journey.  DOP853 along the same path, at a
tolerance of 1e-12, has to agree to 1e-7 of the size of the solution (where it doesn't, mpmath's `odefun` with 30 digits
decides); and the sharper ball has to meet the wider one: the ratio is its distance from the midpoint over the radius.
One call in a hundred is compared with `odefun` in any case.  Starts at regular singular points are compared with Frobenius'
series, summed by mpmath with 60 digits.  Half of the calls have coefficients and right-hand sides made of the functions that
the package knows.  One in twenty is a matrix: of `connection_matrix`, and of `monodromy` with what
`compare_with_monodromy` says, against DOP853 along the polygon; one in a hundred is the ball's motion, against Newton's and
Euler's equations.
"""

from __future__ import annotations

import json
import random
import signal
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import flint
import frame
import mpmath
import numpy as np
import sympy
from scipy.integrate import solve_ivp

import kovacic
from kovacic.ball import RollingBall
from kovacic.ball.motion import MotionStart, solve_motion

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "shared"))
import newton_euler

x = sympy.Symbol("x")
_SIZE = 1e-7
_EVERY = 100
_PATIENCE = kovacic.Limits(seconds=60)
_LONGEST = 5.0
"""Seconds of processor time after which `odefun` is given up: it has no limit of its own."""
_NEAR, _CIRCLE = 0.01, 0.125
"""Nearer to a removable singularity a coefficient is the mean of its values on a circle of that radius."""


@dataclass(frozen=True)
class Call:
    """y'' + b y' + c y = f from x0 to `place`, y(x0) and y'(x0)."""

    kind: str
    b: str
    c: str
    f: str
    x0: str
    place: str
    y0: str
    dy0: str
    params: dict[str, str]

    @property
    def equation(self) -> str:
        return f"y'' + ({self.b})*y' + ({self.c})*y = {self.f}"

    def start(self, *, wide: bool) -> dict[str, Any]:
        given: dict[str, Any] = {"x0": self.x0, "y0": widened(self.y0) if wide else self.y0, "dy0": self.dy0}
        return given | ({"params": self.params} if self.params else {})


@dataclass(frozen=True)
class FromSingular:
    """t^2 y'' + t p(t) y' + q(t) y = 0 from t = x - x0 = 0 to `place`: c1 y1 + c2 y2 of the basis without logarithms.

    p and q are polynomials, so that the series converge everywhere; low and high are the exponents.
    """

    p: tuple[Fraction, ...]
    q: tuple[Fraction, ...]
    exponents: tuple[Fraction, Fraction]
    x0: str
    place: str
    weights: tuple[str, str]
    kind = "Frobenius starts"

    @property
    def equation(self) -> str:
        t = f"(x - ({self.x0}))"
        p, q = (" + ".join(f"({value})*{t}^{k}" for k, value in enumerate(part)) for part in (self.p, self.q))
        return f"{t}^2*y'' + {t}*({p})*y' + ({q})*y = 0"

    def start(self, *, wide: bool) -> dict[str, Any]:
        c1, c2 = self.weights
        if c1 == "0":
            return {"x0": self.x0, "which": "regular"}
        return {"x0": self.x0, "frobenius": (widened(c1) if wide else c1, c2)}

    def by_series(self) -> tuple[Any, Any]:
        """y and y' at the end, from the recurrence of the coefficients."""
        with mpmath.workdps(60):
            t = mpmath.mpmathify(sympy.N(sympy.sympify(self.place) - sympy.sympify(self.x0), 70))
            y, dy = mpmath.mpc(0), mpmath.mpc(0)
            for exponent, weight in zip(self.exponents, self.weights, strict=True):
                if weight != "0":
                    part = self._series(exponent, t)
                    y += as_mpf(Fraction(weight.strip("()"))) * part[0]
                    dy += as_mpf(Fraction(weight.strip("()"))) * part[1]
            return y, dy

    def _series(self, exponent: Fraction, t: Any) -> tuple[Any, Any]:
        r, known, y, dy = as_mpf(exponent), [mpmath.mpf(1)], mpmath.mpf(0), mpmath.mpf(0)
        p, q = map(as_mpf, self.p), map(as_mpf, self.q)
        pairs = list(zip(p, q, strict=True))
        for n in range(2000):
            if n:
                former = (known[n - k] * (pk * (r + n - k) + qk) for k, (pk, qk) in enumerate(pairs) if 1 <= k <= n)
                known.append(-sum(former) / ((r + n) * (r + n - 1) + pairs[0][0] * (r + n) + pairs[0][1]))
            y += known[n] * t**n
            dy += (r + n) * known[n] * t**n
            if n > 20 and max(map(abs, known[-3:])) * abs(t) ** n * (n + 1) < mpmath.mpf(10) ** -60:
                break
        return y * t**r, dy * t ** (r - 1)


def as_mpf(value: Fraction) -> Any:
    return mpmath.mpf(value.numerator) / value.denominator


def widened(number: str) -> Any:
    """A ball with it as its midpoint."""
    value = Fraction(number.strip("()"))
    return flint.arb(value.numerator, 1e-12) / value.denominator


def number(rng: random.Random, least: int = -9, most: int = 9) -> str:
    value = Fraction(rng.randint(least, most), rng.randint(1, 5))
    return f"({value})"


def polynomial(rng: random.Random, degree: int) -> str:
    return " + ".join(f"{number(rng)}*x^{k}" for k in range(rng.randint(0, degree) + 1))


def denominator(rng: random.Random) -> str:
    """Without a zero between 1/2 and 4."""
    factors = [f"(x + {rng.randint(1, 6)})", f"(x^2 + {number(rng, 1, 9)})", "x", "x^2", f"(x - {rng.randint(5, 9)})"]
    return "*".join(rng.sample(factors, rng.randint(1, 2)))


def rational(rng: random.Random) -> tuple[str, str, str]:
    b = rng.choice(["0", f"{number(rng)}/{denominator(rng)}", number(rng)])
    return b, f"({polynomial(rng, 3)})/({denominator(rng)})", "0"


def irregular(rng: random.Random) -> tuple[str, str, str]:
    return "0", f"{number(rng)}*x^{rng.randint(1, 4)} + {number(rng)}/x^{rng.randint(3, 5)} + {number(rng)}", "0"


def algebraic(rng: random.Random) -> tuple[str, str, str]:
    root = rng.choice(["sqrt(2)", "sqrt(3)", "2^(1/3)", "sqrt(5)"])
    return rng.choice(["0", root]), f"{root}*x + {polynomial(rng, 2)}/(x + {root})", "0"


def forced(rng: random.Random) -> tuple[str, str, str]:
    b, c, _ = rational(rng)
    return b, c, rng.choice(["exp(-x)", "sin(2*x)", "1/(x + 3)", "log(x)", "x*exp(x/2)", "sqrt(x)", "cos(x)/(x + 1)"])


def waves(rng: random.Random) -> tuple[str, str, str]:
    first = ["0", "cot(x/3)", "sin(x)", "tanh(x)", "1/(2 + cos(x))", "tan(x/9)", "exp(-x)"]
    zeroth = [
        "2 + sin(2*x)",
        "cos(x) + sin(2*x)",
        "exp(x/2) + 1",
        "1/cos(x/9)^2",
        "sinh(x/2)",
        "2*q*cos(2*x)",
        "csc(x/3)^2",
    ]
    c = " + ".join(f"{number(rng)}*({part})" for part in rng.sample(zeroth, rng.randint(1, 2)))
    return rng.choice(first), c.replace("q", number(rng, 1, 3)), rng.choice(["0", "0", "cos(x)", "exp(x)"])


def functions(rng: random.Random) -> tuple[str, str, str]:
    parts = [
        "log(x)",
        "sqrt(x)",
        "exp(-x^2)",
        "x^(1/3)",
        "atan(x)",
        "erf(x)",
        "x*sin(x)",
        "log(x + 2)/x",
        "exp(sin(x))",
    ]
    first = ["0", "log(x)", "x*exp(-x)", "1/sqrt(x)", "atan(x)"]
    c = " + ".join(f"{number(rng)}*({part})" for part in rng.sample(parts, rng.randint(1, 3)))
    return rng.choice(first), c, rng.choice(["0", "0", "log(x)", "exp(-x^2)", "sin(x^2)"])


def removable(rng: random.Random) -> tuple[str, str, str]:
    """Coefficients that are entire, or analytic in |x| < 2, though not as they are written: x = 0 is on the way."""
    parts = [
        "sin(x)/x",
        "(exp(x) - 1)/x",
        "(1 - cos(x))/x^2",
        "tan(x/2)/x",
        "log(1 + x/4)/x",
        "x/(exp(x) - 1)",
        "x^2/sin(x/2)^2",
        "(sin(x) - x)/x^3",
        "x*cot(x/2)",
    ]
    first = ["0", "0", "sin(x)/x", "x/tan(x/2)", "1/x - cot(x)"]
    c = " + ".join(f"{number(rng)}*({part})" for part in rng.sample(parts, rng.randint(1, 2)))
    return rng.choice(first), c, rng.choice(["0", "0", "sin(x)/x", "(cos(x) - 1)/x"])


READERS = "exp sin cos tan cot sec csc sinh cosh tanh coth sech csch erf asin acos atan asinh acosh atanh log sqrt"
ARGUMENTS = ["x/9", "x/5 + 1/3", "x + 2", "x/(x + 3)", "1/(x + 2)", "x^2/9", "2*x", "sqrt(x)", "log(x + 1)", "sin(x)"]


def function(rng: random.Random) -> str:
    """One of the reader's functions at an argument for which it is real and moderate on the way."""
    while True:
        text = f"{rng.choice(READERS.split())}({rng.choice(ARGUMENTS)})"
        value = sympy.lambdify(x, sympy.sympify(text.replace("^", "**")), "mpmath")
        values = [mpmath.mpmathify(value(mpmath.mpf(k) / 4)) for k in range(1, 17)]
        if all(mpmath.im(v) == 0 and abs(v) < 40 for v in values):
            return text


def of_the_reader(rng: random.Random) -> tuple[str, str, str]:
    b = rng.choice(["0", "0", f"{number(rng)}*{function(rng)}"])
    c = " + ".join(f"{number(rng)}*{function(rng)}" for _ in range(rng.randint(1, 2)))
    return b, c, rng.choice(["0", "0", function(rng), f"x*{function(rng)}"])


KINDS = {"rational": rational, "irregular": irregular, "algebraic constants": algebraic, "right-hand sides": forced}
KINDS |= {"sines and exponentials": waves, "any functions": functions}
KINDS |= {"removable singularities": removable}


def from_singular(rng: random.Random) -> FromSingular:
    low = Fraction(rng.randint(-8, 8), rng.choice([1, 2, 3, 4, 5]))
    high = low + Fraction(rng.randint(1, 12), rng.choice([2, 3, 4, 5]))
    regular = (high - low).denominator == 1 or rng.random() < 0.3
    p0 = 1 - low - high
    p, q = [p0], [low * high]
    for _ in range(rng.randint(1, 3)):
        p.append(Fraction(rng.randint(-4, 4), rng.randint(1, 3)))
        q.append(Fraction(rng.randint(-9, 9), rng.randint(1, 3)))
    x0 = str(Fraction(rng.randint(-9, 9), rng.randint(1, 4)))
    place = f"{x0} + {rng.randint(2, 30)}/10"
    if rng.random() < 0.25:
        place = f"{place} + {rng.choice(['-', ''])}{rng.randint(1, 9)}/10*I"
    weights = ("0", "1") if regular else (number(rng, 1), number(rng))
    return FromSingular(tuple(p), tuple(q), (low, high), x0, place, weights)


def call(rng: random.Random) -> Call | FromSingular:
    kind = rng.choice([*KINDS, FromSingular.kind])
    if kind == FromSingular.kind:
        return from_singular(rng)
    of_kind = KINDS[kind]
    if rng.random() < 0.6:
        kind, of_kind = "functions of the reader", of_the_reader
    b, c, f = of_kind(rng)
    params = {}
    if rng.random() < 0.15:
        c, params = f"{c} + a*x", {"a": rng.choice(["sqrt(2)", "1/3", "pi"])}
    x0, place = (f"{rng.randint(5, 38)}/10" for _ in range(2))
    if kind == "removable singularities":
        x0, place = rng.choice(["0", f"-{rng.randint(1, 15)}/10"]), f"{rng.randint(1, 15)}/10"
    if rng.random() < 0.25:
        place = f"{place} + {rng.choice(['-', ''])}{rng.randint(1, 9)}/10*I"
    elif rng.random() < 0.3 and kind != "removable singularities":
        x0 = f"{x0} + {rng.choice(['-', ''])}{rng.randint(1, 9)}/10*I"
    return Call(kind, b, c, f, x0, place, number(rng), number(rng), params)


def exact(value: str) -> complex:
    return complex(sympy.sympify(value))


def coefficients(asked: Call, module: str) -> list[Any]:
    values = {sympy.Symbol(name): sympy.sympify(value) for name, value in asked.params.items()}
    texts = (part.replace("^", "**") for part in (asked.b, asked.c, asked.f))
    functions = [sympy.lambdify(x, sympy.sympify(text).subs(values), module) for text in texts]
    if asked.kind == "removable singularities":
        return [continued(function, 16 if module == "scipy" else 48) for function in functions]
    return functions


def continued(function: Callable[[Any], Any], points: int) -> Callable[[Any], Any]:
    """The same, and near 0 the mean over so many points of a circle: r^points times a Taylor coefficient is left out."""
    circle = [mpmath.mpf(_CIRCLE) * mpmath.expjpi(mpmath.mpf(2 * k + 1) / points) for k in range(points)]

    def value(z: Any) -> Any:
        if abs(z) > _NEAR:
            return function(z)
        if isinstance(z, complex):
            return sum(function(z + complex(step)) for step in circle) / points
        return sum(function(z + step) for step in circle) / points

    return value


def by_dop853(asked: Call) -> tuple[complex, complex, float] | None:
    """y and y' at the end, and the largest |y| on the way; None where the integrator gives up."""
    b, c, f = coefficients(asked, "scipy")
    begin, step = exact(asked.x0), exact(asked.place) - exact(asked.x0)

    def slope(t: float, s: Any) -> Any:
        z = begin + step * t
        return [step * s[1], step * (f(z) - b(z) * s[1] - c(z) * s[0])]

    start = np.array([exact(asked.y0), exact(asked.dy0)], dtype=complex)
    found = solve_ivp(slope, (0, 1), start, method="DOP853", rtol=1e-12, atol=1e-13)
    if not found.success:
        return None
    return found.y[0, -1], found.y[1, -1], float(np.abs(found.y).max())


def given_up(*_: Any) -> None:
    raise TimeoutError


def by_mpmath(asked: Call) -> tuple[Any, Any] | None:
    b, c, f = coefficients(asked, "mpmath")
    with mpmath.workdps(30):
        begin, end = (mpmath.mpmathify(sympy.N(sympy.sympify(v), 40)) for v in (asked.x0, asked.place))
        step = end - begin
        start = [mpmath.mpmathify(sympy.N(sympy.sympify(v), 40)) for v in (asked.y0, asked.dy0)]

        def slope(t: Any, s: Any) -> Any:
            z = begin + step * t
            return [step * s[1], step * (f(z) - b(z) * s[1] - c(z) * s[0])]

        signal.setitimer(signal.ITIMER_VIRTUAL, _LONGEST)
        try:
            return tuple(mpmath.odefun(slope, 0, start)(1))
        except TimeoutError:
            return None
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def distance(ball: Any, other: Any) -> float:
    """From the midpoint of a ball to another ball, over its radius."""
    with mpmath.workdps(80):
        error = abs(ball.to_mpmath() - other.to_mpmath()) - mpmath.mpf(other.radius)
        return 0.0 if error <= 0 else float(error / mpmath.mpf(ball.radius or 1e-300))


def carried(S: str, corners: list[complex]) -> Any:
    """The matrix from (y, y') at the first corner to that at the last one, by DOP853."""
    value = sympy.lambdify(x, sympy.sympify(S.replace("^", "**")), "numpy")
    matrix = np.eye(2, dtype=complex)
    for begin, end in pairwise(corners):
        step = end - begin

        def slope(t: float, s: Any, begin: complex = begin, step: complex = step) -> Any:
            return step * np.array([s[2], s[3], value(begin + step * t) * s[0], value(begin + step * t) * s[1]])

        found = solve_ivp(slope, (0, 1), matrix.reshape(-1), method="DOP853", rtol=1e-12, atol=1e-13)
        matrix = found.y[:, -1].reshape(2, 2)
    return matrix


def check_matrix(rng: random.Random, row: dict[str, Any]) -> dict[str, Any]:
    """A connection matrix, or the local monodromy of an equation and whether its group agrees with it."""
    S = f"({polynomial(rng, 2)})/({denominator(rng)})"
    pairs = []
    try:
        if rng.random() < 0.5:
            ends = [Fraction(rng.randint(5, 38), 10) for _ in range(2)]
            middle = complex(rng.randint(1, 8) / 2, rng.choice((-1, 1)) * rng.randint(1, 8) / 2)
            path = [ends[0], middle, ends[1]]
            row |= {"kind": "connection matrices", "call": f"{S}, {path}"}
            pairs.append((kovacic.connection_matrix(S, path, limits=_PATIENCE), [complex(corner) for corner in path]))
        else:
            row |= {"kind": "monodromy", "call": S}
            pairs += [
                (point.matrix, [complex(corner) for corner in point.loop])
                for point in kovacic.monodromy(S, limits=_PATIENCE)
            ]
            row["disproved"] = kovacic.solve(S).compare_with_monodromy(limits=_PATIENCE).verdict is False
    except kovacic.KovacicError as reason:
        return {**row, "refused": f"{type(reason).__name__}: {reason}"}
    off = []
    for balls, corners in pairs:
        own, size = carried(S, corners), max(abs(complex(ball)) for line in balls for ball in line)
        off += [abs(complex(balls[i][j]) - own[i, j]) / size for i in (0, 1) for j in (0, 1)]
    row["ratio"] = 0.0
    return row | {"wrong": max(off, default=0.0) > 10 * _SIZE or row.get("disproved", False)}


def check_motion(rng: random.Random, row: dict[str, Any]) -> dict[str, Any]:
    """A rolling ball on a sphere, outside or inside, in the potential cos(u) or cos(u)^2."""
    R1, potential = rng.choice((3, 5, -4)), rng.choice(("cos(u)", "cos(u)^2"))
    start = MotionStart(u=rng.uniform(0.3, 2.8), du=rng.uniform(-1, 1), dv=rng.uniform(-1, 1), n=rng.uniform(-3, 3))
    times = np.sort([rng.uniform(0, 20) for _ in range(5)])
    row |= {"kind": "the ball's motion", "call": f"R1 = {R1}, {potential}, {start}", "ratio": 0.0}
    body = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(R1)
    slope = (lambda u: 1.0) if potential == "cos(u)" else (lambda u: 2 * u)
    force = newton_euler.central(slope, 1.0, 0.2, float(R1))
    own = newton_euler.integrate(
        newton_euler.Body(1.0, 1.0, 0.2, 0.25, 1 / 3, float(R1), force),
        (start.u, start.du, start.dv, start.n, 0, 0, 1, 0),
        np.concatenate([[0.0], times]),
    )
    motion = solve_motion(body, start, potential=potential)
    off = [np.abs(getattr(motion, name)(times) - own[name][1:]).max() for name in ("u", "n", "contact_on_ball")]
    return row | {"wrong": bool(max(off) > 10 * _SIZE)}


def check(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    share = rng.random()
    if share < 0.06:
        return (check_motion if share < 0.01 else check_matrix)(rng, {"seed": seed})
    asked, digits, wide = call(rng), rng.choice([5, 8, 15, 30]), rng.random() < 0.1
    at: Any = asked.place
    if "I" not in asked.place and rng.random() < 0.1:
        at = widened(str(sympy.sympify(asked.place)))
    row: dict[str, Any] = {"seed": seed, "kind": asked.kind, "call": f"{asked.equation}, {asked.x0} to {asked.place}"}
    try:
        given = asked.start(wide=wide), asked.start(wide=False)
        balls, sharp = (
            kovacic.evaluate(asked.equation, to, derivative=True, digits=more, limits=_PATIENCE, **start)
            for to, more, start in zip((at, asked.place), (digits, digits + 25), given, strict=True)
        )
    except kovacic.KovacicError as reason:
        return {**row, "refused": f"{type(reason).__name__}: {reason}"}
    ratios = [distance(ball, other) for ball, other in zip(balls, sharp, strict=True)]
    row["ratio"] = max(ratios)
    if isinstance(asked, FromSingular):
        row["series"] = difference(sharp, asked.by_series(), 0)
        return row | {"wrong": row["series"] > 1e-25 or row["ratio"] > 1}
    own = by_dop853(asked)
    far = own is None or any(
        abs(complex(ball) - value) > _SIZE * own[2] + ball.radius for ball, value in zip(balls, own[:2], strict=True)
    )
    if far or seed % _EVERY == 0:
        precise = by_mpmath(asked)
        if precise is not None:
            row["odefun"] = difference(sharp, precise, own[2] if own else 0)
            far = row["odefun"] > 1e-15
    row["wrong"] = bool(far or row["ratio"] > 1)
    return row


def difference(balls: Any, others: Any, size: float) -> float:
    """The greatest, over the greatest of the values and `size`."""
    whole = max(abs(value) for value in others) + size
    with mpmath.workdps(60):
        return max(float(abs(s.to_mpmath() - v) / whole) for s, v in zip(balls, others, strict=True))


def main() -> None:
    arguments = frame.parser(__doc__)
    arguments.add_argument("count", type=int)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--rows", type=Path, help="a file that keeps the rows, from which a run goes on")
    given = arguments.parse_args()
    warnings.simplefilter("ignore")
    rows: list[dict[str, Any]] = []
    if given.rows and given.rows.exists():
        rows = [json.loads(line) for line in given.rows.read_text(encoding="utf-8").splitlines()]
    signal.signal(signal.SIGVTALRM, given_up)
    first = given.seed * 1_000_000
    begin = time.process_time()
    for seed in range(first + len(rows), first + given.count):
        rows.append(check(seed))
        if given.rows:
            with given.rows.open("a", encoding="utf-8") as kept:
                kept.write(json.dumps(rows[-1]) + "\n")
        if rows[-1].get("wrong"):
            print("WRONG", rows[-1], flush=True)
        if len(rows) % 100 == 0:
            print(len(rows), f"{time.process_time() - begin:.0f} s", flush=True)
    report(rows, given.seed)


def report(rows: list[dict[str, Any]], seed: int) -> None:
    parts = sorted(Counter(row["seed"] // 1_000_000 for row in rows).items())
    runs = [f"`python benchmarks/soundness.py {count} --seed {part}`" for part, count in parts]
    done = [row for row in rows if "refused" not in row]
    kinds = Counter(row["kind"] for row in done)
    lines = [
        "# Is the exact value in the ball?",
        "",
        frame.line(scipy=__import__("scipy").__version__, mpmath=mpmath.__version__),
        f"Regenerate: {'; '.join(runs)}.",
        "",
        f"{len(done)} calls, {2 * len(done)} balls; {len(rows) - len(done)} calls were refused. Wrong: "
        f"{sum(row['wrong'] for row in done)}.",
        f"Worst distance of the sharper value from the midpoint, over the radius: {max(row['ratio'] for row in done):.3g}.",
        f"Compared with `odefun` by 30 digits: {sum('odefun' in row for row in done)}, worst difference over the size "
        f"{max((row['odefun'] for row in done if 'odefun' in row), default=0.0):.2g}.",
        f"Compared with Frobenius' series by 60 digits: {sum('series' in row for row in done)}, worst difference over the size "
        f"{max((row['series'] for row in done if 'series' in row), default=0.0):.2g}.",
        "",
        *frame.table(["kind", "calls"], [[kind, str(count)] for kind, count in sorted(kinds.items())]),
    ]
    refused = Counter(row["refused"].split(",")[0][:90] for row in rows if "refused" in row)
    data = {"seed": seed, "calls": len(done), "refused": dict(refused.most_common(40))}
    data["wrong"] = [row for row in done if row["wrong"]]
    frame.save("soundness", data, "\n".join(lines))


if __name__ == "__main__":
    main()
