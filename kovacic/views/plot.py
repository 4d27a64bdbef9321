"""Pictures of solutions: real and imaginary part over an interval of the real axis, with the singular points marked.

What is drawn are midpoints of proven enclosures, as dense as the solution oscillates, and cubics between them that were
compared with further values; the error band is drawn where it's visible at all.  Where an oscillation is too fine for the
picture, its envelope is drawn instead (`kovacic.doubles.curve`), and the legend says so.  Beyond a singular point on the
axis the solution is the continuation through the upper half-plane.

matplotlib is needed (the extra `plot`) and imported here only, with a canvas of its own: no window is opened,
and neither the backend nor the state of pyplot is touched.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np

from kovacic import derived
from kovacic.answer import Answer
from kovacic.doubles.chart import PieceChart, chart_of
from kovacic.doubles.curve import Arc, Envelope, arcs, coefficients
from kovacic.enclosure.evaluate import Accuracy, InitialValues
from kovacic.enclosure.functions import as_written
from kovacic.enclosure.points import ExactPoint, as_point
from kovacic.enclosure.problem import Coefficients, change_of
from kovacic.enclosure.variable import with_variable
from kovacic.equation import Parsed
from kovacic.errors import InputError, NotRational, check_keywords
from kovacic.exact import has_long_numbers, whole
from kovacic.limits import Limits, limited, limits_of
from kovacic.numerals import as_text, plain_text
from kovacic.reading.read import read_input
from kovacic.views.sentences import equation_of
from kovacic.writing.formula import of_sympy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SHARE = Fraction(1, 256)
_IRREGULAR_SHARE = Fraction(1, 16)
"""The curve ends this share of its interval before a singular point."""

#: The ends of pictures.
_FARTHEST = 10**300
#: A formula of more characters isn't written into the legend.
_LONGEST_LABEL = 50
#: Entries of a legend in two columns have so many characters at most, and a title so many.
_LONGEST_IN_COLUMNS = 55
_LONGEST_TITLE = 100
#: Characters of a formula that SymPy evaluates where the curves start; powers of long numbers take it minutes.
_LONGEST_EVALUATED = 2000
#: Powers of ten beside an axis, at most.
_MOST_POWERS = 4
#: The share of the height from which on an error is drawn.
_SEEN = 2e-3
#: Where the largest value is more than so many times the usual one, the axis is logarithmic beyond the usual one.
_RANGE = 20


class SampleOptions(InitialValues, Accuracy, total=False):
    """The keywords of `evaluate` that choose the solution and its accuracy; the path is above the axis."""

    which: Literal["regular", "decaying"] | None


class PlotOptions(SampleOptions, total=False):
    """The keywords of `plot` but the title and the file."""

    x0: object
    points: int


@dataclass(frozen=True)
class SampledCurve:
    """A solution over an interval, in runs that are separated by singular points; each run is arcs and envelopes in order."""

    runs: tuple[tuple[Arc | Envelope, ...], ...]
    singular: tuple[complex, ...]
    x0: object

    @property
    def parts(self) -> list[Arc | Envelope]:
        return [part for run in self.runs for part in run]

    @property
    def arcs(self) -> list[Arc]:
        return [part for part in self.parts if isinstance(part, Arc)]

    @property
    def envelopes(self) -> list[Envelope]:
        return [part for part in self.parts if isinstance(part, Envelope)]


@limited
def sample(
    equation: object,
    start: object,
    stop: object,
    *,
    x0: object | None = None,
    points: int = 400,
    **options: Unpack[SampleOptions],
) -> SampledCurve:
    """The solution over [start, stop] in proven values.

    Parameters
    ----------
    equation
        S or an equation, as for `evaluate`, real for real x.
    start, stop
        The ends of the interval, real numbers.
    x0
        Where the initial values are given, real; by default `start`, or the middle of the longest regular interval where there
        are no values.
    points
        The least number of samples; more are taken where the solution oscillates or bends.
    options
        `y0` = 1, `dy0` = 0, `which`, `frobenius`, `params`, `digits` = 8, `method` and `limits` as for `evaluate`.

    Raises InputError if start isn't below stop, and what `evaluate` raises.
    """
    check_keywords("sample", options, SampleOptions.__annotations__)
    a, b = _ends(start, stop)
    points = whole(points, "points", least=2)
    asked: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    equation = with_variable(equation, asked.pop("var", None), asked.get("limits"))
    chart = chart_of(equation, {}, asked.pop("params", None))
    intervals = _regular_intervals(chart, a, b)
    if x0 is None:
        x0 = _start(intervals, a, has_values=bool({"y0", "dy0"} & {*asked}))
    asked = {**_default_values(asked), **asked}
    digits = asked.pop("digits", 8)
    limits = asked.pop("limits", None)
    chart = replace(chart, given={"x0": x0})

    def states(places: Sequence[ExactPoint]) -> Any:
        return chart.states(list(places), digits, limits, path="above", **asked)

    runs = [tuple(arcs(chart, interval, b - a, points, states)) for interval in intervals]
    near = tuple(complex(point) for point in chart.singular if _is_a_double(point))
    return SampledCurve(tuple(runs), near, x0)


def _default_values(asked: dict[str, Any]) -> dict[str, int | None]:
    """y(x0) = 1 and y'(x0) = 0 where no solution is asked for; none where it is chosen by its behaviour at x0."""
    is_chosen = asked.get("which") is not None or asked.get("frobenius") is not None
    if is_chosen:
        return {"y0": None, "dy0": None}
    return {"y0": 1, "dy0": 0}


def _start(intervals: list[tuple[Fraction, Fraction]], a: Fraction, *, has_values: bool) -> Fraction:
    """Where initial values hold that are given without a place, or those that are chosen here."""
    if has_values:
        return _ordinary_start(intervals, a)
    return _middle_of_the_longest(intervals)


def _ends(start: object, stop: object) -> tuple[Fraction, Fraction]:
    a = as_point(start, "from")
    b = as_point(stop, "to")
    if not (a.is_real() and b.is_real()) or a.re >= b.re:
        raise InputError(f"the interval from {a} to {b} is empty", hint="give real numbers, the smaller one first")
    if max(abs(a.re), abs(b.re)) > _FARTHEST:
        raise InputError(f"the interval from {a} to {b} is beyond the range of doubles, in which pictures are drawn")
    return a.re, b.re


def _regular_intervals(chart: PieceChart, a: Fraction, b: Fraction) -> list[tuple[Fraction, Fraction]]:
    """The parts of [a, b] between singular points, shorter by a share beside each of these.

    Beside an irregular singular point, solutions are as large as exp(1/distance).
    """
    cuts = sorted({z.re for z in chart.singular if z.is_real() and a <= z.re <= b})
    wild = {float(point.re) for point in chart.irregular}

    def share(end: Fraction) -> Fraction:
        if end not in cuts:
            return Fraction(0)
        return _IRREGULAR_SHARE if float(end) in wild else _SHARE

    found = []
    for left, right in pairwise([a, *cuts, b]):
        if left < right:
            length = right - left
            found.append((left + length * share(left), right - length * share(right)))
    return found


def _ordinary_start(intervals: list[tuple[Fraction, Fraction]], a: Fraction) -> Fraction:
    """The left end.  Raises `InputError` where that is a singular point."""
    if intervals[0][0] != a:
        raise InputError(
            f"the values need a place: {plain_text(a)}, the left end, is a singular point", hint="x0=...", shell="--x0"
        )
    return a


def _middle_of_the_longest(intervals: list[tuple[Fraction, Fraction]]) -> Fraction:
    low, high = max(intervals, key=lambda interval: interval[1] - interval[0])
    return (low + high) / 2


@limited
def plot(
    equation: object,
    start: object,
    stop: object,
    *,
    title: str | None = None,
    output: str | Path | None = None,
    **options: Unpack[PlotOptions],
) -> Figure:
    """A figure with the real part over [start, stop], and the imaginary part unless it can't be told from zero.

    Parameters
    ----------
    equation
        S or an equation, as for `kovacic.evaluate`, real for real x.  For an answer of `solve`, without initial values, its
        solutions y1 and y2 are drawn.
    start, stop : number
        The ends of the interval, real, exact: 0.5 and "1/3".  Singular points may lie between them; they are marked.
    title : str
        Above the picture; the equation by default.
    output : str or Path
        A file to which the picture is saved; its type follows the suffix (png, svg, pdf).  None by default: nothing is saved.
    x0 : number
        Where the initial values are given, real; by default `start`, or the middle of the longest interval without singular
        points where there are no values.  The legend says where.
    y0, dy0 : number
        y(x0) and y'(x0); 1 and 0 by default.
    frobenius, which
        Or else the solution at a singular point x0, as for `kovacic.evaluate`.
    points : int
        The least number of samples, 400 by default; more are taken where the solution oscillates or bends.
    digits : int
        To how many digits they are found: 8 by default.
    params : mapping
        Values of the parameters by name: {"a": 2}.
    var : str
        The name of the variable, where the equation is text or a SymPy expression; by default as for `kovacic.solve`.
    method : str
        "taylor" or "closed form"; by default the one that is faster for this equation.
    limits : Limits
        What the work may cost.

    Returns
    -------
    matplotlib.figure.Figure
        Not shown anywhere, unless it is the result of a notebook's cell.

    Raises
    ------
    InputError
        If start isn't below stop, and what `kovacic.evaluate` raises.
    TypeError
        For a keyword that isn't known.

    Examples
    --------
    The solutions of an answer, the solution with given values, and a picture in a file:

    >>> import io, kovacic
    >>> figure = plot(kovacic.solve("x^2 + 3"), -1, 1, points=20)
    >>> [line.get_label()[:2] for line in figure.axes[0].get_lines()][:2]
    ['y1', 'y2']
    >>> figure = plot("a*x", -5, 1, x0=0, y0=1, dy0=0, params={"a": 1}, title="Airy", points=20)
    >>> figure.axes[0].get_title()
    'Airy'
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     figure = plot("-1", 0, 6, output=Path(folder, "wave.svg"), points=20)
    ...     Path(folder, "wave.svg").exists()
    True
    """
    check_keywords("plot", options, PlotOptions.__annotations__)
    if title is None:
        title = _title(equation)
    if isinstance(equation, str) or options.get("var") is not None:
        equation = _read(equation, options.pop("var", None), options.get("limits"))
    from matplotlib.figure import Figure as NewFigure

    curves = _curves(equation, start, stop, options)
    low, high = map(float, _ends(start, stop))
    singular = [z.real for z in curves[0][1].singular if z.imag == 0 and low <= z.real <= high]
    figure = NewFigure(figsize=(8, 4.8), layout="constrained")
    axes = figure.add_subplot()
    colour = 0
    for label, curve in curves:
        colour = _draw(axes, curve, label, colour)
    _mark(singular, axes)
    axes.set(xlim=(low, high), xlabel=_variable(equation), title=title)
    _scale(axes, [curve for _, curve in curves])
    axes.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    _legend(figure)
    if output is not None:
        figure.savefig(output, dpi=150)
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]  # Jupyter shows it without pyplot
    return figure


def _mark(singular: list[float], axes: Axes) -> None:
    """Lines at singular points, named once in the legend."""
    label: str | None = "singular point"
    for x in singular:
        axes.axvline(x, color="0.4", linestyle="--", linewidth=1, label=label)
        label = None


def _title(equation: object) -> str:
    """The equation; nothing for coefficients without a text of their own."""
    if isinstance(equation, Answer):
        return equation_of(equation).text
    if not isinstance(equation, str) or len(equation) > _LONGEST_TITLE:
        return ""
    if "=" in equation:
        return equation
    S = equation.strip()
    return f"y'' = {S} y" if S.isalnum() else f"y'' = ({S}) y"


def _legend(figure: Figure) -> None:
    """Below the picture, in two columns where these have room."""
    (axes,) = figure.axes
    _, names = axes.get_legend_handles_labels()
    ncols = 2 if max(map(len, names)) <= _LONGEST_IN_COLUMNS else 1
    figure.legend(loc="outside lower center", ncols=ncols, frameon=False)


def _read(equation: object, var: str | None, limits: Limits | None) -> object:
    """The equation with the name of its variable, which the axis has."""
    if not isinstance(equation, str) or var is not None:
        return with_variable(equation, var, limits)
    try:
        return read_input(equation, limits=limits_of(limits), exponentials=True)
    except NotRational:
        return as_written(equation, None, limits_of(limits))


def _variable(equation: object) -> str:
    """The name of the variable, for the axis."""
    change = change_of(equation)
    if change is not None:
        return change.variable
    if isinstance(equation, Answer | Parsed | Coefficients):
        return str(equation.variable)
    return "x"


def _curves(equation: object, start: object, stop: object, options: PlotOptions) -> list[tuple[str, SampledCurve]]:
    """What is drawn, and how the legend names it."""
    given = {name for name in ("y0", "dy0", "which", "frobenius") if options.get(name) is not None}
    if isinstance(equation, Answer) and not given:
        found = _solutions(equation, start, stop, options)
        if found:
            return found
    curve = sample(equation, start, stop, **options)
    name = _name(options, curve.x0)
    if len(name) > _LONGEST_LABEL:
        name = "y"
    return [(name, curve)]


def _name(options: PlotOptions, x0: object) -> str:
    """Which solution is drawn."""
    at = plain_text(x0)
    value = "1" if options.get("y0") is None else plain_text(options["y0"])
    slope = "0" if options.get("dy0") is None else plain_text(options["dy0"])
    if options.get("which") == "decaying":
        return f"y, decaying, y({at}) = {value}"
    if options.get("which") is not None:
        return f"y, regular at {at}"
    weights = options.get("frobenius")
    if weights is not None:
        c1, c2 = map(plain_text, weights)
        return f"y = ({c1}) y1 + ({c2}) y2, Frobenius' basis at {at}"
    return f"y, where y({at}) = {value}, y'({at}) = {slope}"


def _solutions(answer: Answer, start: object, stop: object, options: PlotOptions) -> list[tuple[str, SampledCurve]]:
    """y1 and y2 of the answer, as the solutions with their values and slopes at x0; none where these aren't known.

    A solution that decays from x0 on needs initial values with the digits that the other one gains on the way.
    """
    import sympy

    x = sympy.Symbol(answer.variable)
    form = derived.closed_form(answer)
    pair = derived.special(answer) if form is None else form
    expressions = tuple(pair)
    if not all(_can_be_evaluated(y, x) for y in expressions):
        return []
    a, b = _ends(start, stop)
    chart = chart_of(answer, {}, options.get("params"))
    intervals = _regular_intervals(chart, a, b)
    x0 = options.get("x0")
    at = _middle_of_the_longest(intervals) if x0 is None else as_point(x0, "x0").re
    digits = 30 + _digits_gained(chart, intervals)
    place = sympy.Rational(at.numerator, at.denominator)
    found = []
    for k, y in enumerate(expressions, start=1):
        value = sympy.N(y.subs(x, place), digits)
        slope = sympy.N(y.diff(x).subs(x, place), digits)
        if not _is_finite(value) or not _is_finite(slope):
            return []
        asked: PlotOptions = {**options, "x0": at, "y0": str(value), "dy0": str(slope)}
        curve = sample(answer, start, stop, **asked)
        name = f"y{k}"
        text = of_sympy(y).text
        if len(text) <= _LONGEST_LABEL:
            name += f" = {text}"
        found.append((name, curve))
    return found


def _can_be_evaluated(y: Any, x: Any) -> bool:
    """Is a formula short, without an integral that is left, and without parameters?"""
    import sympy

    if has_long_numbers(y) or len(as_text(y)) > _LONGEST_EVALUATED:
        return False
    return not y.has(sympy.Integral) and y.free_symbols <= {x}


def _is_finite(value: Any) -> bool:
    return bool(value.is_number and value.is_finite)


def _is_a_double(point: ExactPoint) -> bool:
    return bool(max(abs(point.x), abs(point.y)) < 10**300)


def _digits_gained(chart: PieceChart, intervals: list[tuple[Fraction, Fraction]]) -> int:
    """Decimal digits by which a growing solution may gain on a decaying one: twice the integral of sqrt(S), S > 0."""
    total = 0.0
    for low, high in intervals:
        here = coefficients(chart, [ExactPoint(low + (high - low) * Fraction(k, 200)) for k in range(201)])
        growth = np.sqrt(np.maximum(here.S, 0.0))
        total += float(np.trapezoid(growth, here.x))
    return int(min(5000.0, 2 * total / np.log(10)))


def _draw(axes: Axes, curve: SampledCurve, label: str, colour: int) -> int:
    """The parts of one solution; returns the number of the next colour."""
    names = {"real": label}
    if _is_complex(curve):
        names = {"real": f"Re {label}", "imag": f"Im {label}"}
    for part, name in names.items():
        _draw_part(axes, curve, part, name=name, style=f"C{colour}")
        colour += 1
    return colour


def _draw_part(axes: Axes, curve: SampledCurve, part: str, *, name: str, style: str) -> None:
    """The real or the imaginary part, with bands where errors can be seen."""
    biggest = max((float(np.abs(arc.y).max()) for arc in curve.arcs), default=0.0)
    in_legend = name
    for arc in curve.arcs:
        x, y = arc.drawn()
        axes.plot(x, getattr(y, part), linewidth=1.5, color=style, label=in_legend)
        in_legend = "_"  # once in the legend
        if arc.radius.max() > _SEEN * biggest:
            middle = getattr(arc.y, part)
            low = middle - arc.radius
            high = middle + arc.radius
            axes.fill_between(arc.x, low, high, color=style, alpha=0.25, linewidth=0, label="error band")
    for envelope in curve.envelopes:
        size = envelope.real if part == "real" else envelope.imaginary
        said = f"{name}: envelope of {envelope.periods:,.0f} oscillations"
        axes.fill_between(envelope.x, -size, size, color=style, alpha=0.35, linewidth=0.8, label=said)


def _is_complex(curve: SampledCurve) -> bool:
    """Can an imaginary part be told from zero?"""
    if any(np.any(np.abs(arc.y.imag) > arc.radius) for arc in curve.arcs):
        return True
    return any(np.any(envelope.imaginary > 1e-6 * envelope.real.max()) for envelope in curve.envelopes)


def _scale(axes: Axes, curves: list[SampledCurve]) -> None:
    """A linear axis, or, where a solution grows so much that the rest wouldn't be seen, logarithmic beyond the usual."""
    sizes = [np.abs(arc.y) for curve in curves for arc in curve.arcs]
    sizes += [np.hypot(part.real, part.imaginary) for curve in curves for part in curve.envelopes]
    usual = min(map(_usual, sizes))
    largest = max(float(part.max()) for part in sizes)
    axes.set_ylabel("y")
    if 0 < _RANGE * usual < largest:
        scale = _Compressed(usual, 2 / np.log(largest / usual))
        axes.set_yscale("function", functions=(scale.forward, scale.backward))
        ticks = _ticks(usual, largest)
        axes.set_yticks(list(ticks), list(ticks.values()))
        axes.set_ylabel(f"y (logarithmic beyond {usual:.2g})")


def _usual(sizes: Any) -> float:
    """Twice the median; of a solution that grows, twice the size that it has before it does."""
    median = float(np.median(sizes))
    if sizes.max() <= _RANGE * 2 * median:
        return 2 * median
    stretches = [part.max() for part in np.array_split(sizes, min(20, len(sizes)))]
    return 2 * float(min(stretches))


@dataclass(frozen=True)
class _Compressed:
    """y/L for |y| <= L, and sign(y) (1 + c log(1 + (|y|/L - 1)/c)) beyond, with the same slope: smooth curves stay smooth."""

    L: float
    c: float

    def forward(self, y: Any) -> Any:
        """Where y is drawn."""
        size = np.abs(y) / self.L
        return np.sign(y) * np.where(size <= 1, size, 1 + self.c * np.log1p(np.maximum(size - 1, 0) / self.c))

    def backward(self, place: Any) -> Any:
        """y."""
        size = np.abs(place)
        far = 1 + self.c * np.expm1(np.clip((size - 1) / self.c, 0, 700))
        return np.sign(place) * np.where(size <= 1, size, far) * self.L


def _ticks(usual: float, largest: float) -> dict[float, str]:
    """0, a round number in the linear part, and powers of ten beyond it, on both sides."""
    power = 10.0 ** math.floor(math.log10(usual))
    near = power * max(k for k in (1, 2, 5) if k * power <= usual)
    found = {near: f"{near:g}"}
    first = math.ceil(math.log10(4 * usual))
    last = math.floor(math.log10(largest))
    every = (last - first) // _MOST_POWERS + 1
    found |= {10.0**k: f"$10^{{{k}}}$" for k in range(first, last + 1, every)}
    negative = {-value: f"\N{MINUS SIGN}{text}" for value, text in found.items()}
    return negative | {0.0: "0"} | found


def _png(figure: Figure) -> bytes:
    figure.savefig(file := BytesIO(), format="png")
    return file.getvalue()
