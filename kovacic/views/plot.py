"""Pictures of solutions: real and imaginary part over an interval of the real axis, with the singular points marked.

The curves are midpoints of proven enclosures, as dense as the solution oscillates, and cubics between them that were
compared with further values; the error band is drawn if it is visible.  An oscillation that is too fine for the picture is
drawn as its envelope (`kovacic.doubles.curve`), and the legend says so.  Beyond a singular point on the axis the solution is
the continuation through the upper half-plane.

A formula enters the legend only after comparison with its curve.  The axis is linear; if it is cut off, its label says at
which size.

matplotlib (the extra `plot`) gets a canvas of its own: no window is opened, and neither the backend nor the state of pyplot
is touched.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from io import BytesIO
from itertools import combinations, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from kovacic import derived
from kovacic.answer import Answer
from kovacic.doubles.chart import PieceChart, chart_of
from kovacic.doubles.curve import Arc, Envelope, arcs, curve_coefficients
from kovacic.enclosure.evaluate import with_variable
from kovacic.enclosure.functions import as_written
from kovacic.enclosure.points import ExactPoint, as_point
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.request import Keywords, Request, Start, fields_of
from kovacic.equation import Parsed
from kovacic.errors import InputError, NotRational
from kovacic.limits import MOST_CHARACTERS, limited, limits_of
from kovacic.numbers.exact import has_long_numbers, whole
from kovacic.numbers.numerals import as_text, plain_text
from kovacic.reading.names import words_among
from kovacic.reading.read import read_input
from kovacic.reading.symbolic import read_expression
from kovacic.views.sentences import equation_of
from kovacic.writing.formula import latex_text, of_sympy
from kovacic.writing.maps import FARTHEST

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The curve ends this share of its interval before a singular point: near an irregular one, solutions are as large as
#: exp(1/distance).
_SINGULAR_GAP = Fraction(1, 256)
_IRREGULAR_GAP = Fraction(1, 16)

#: Characters of a formula in the legend, and of an entry of a legend in two columns; the width of a picture has twice as many.
_LABEL_WIDTH = 50
#: The share of the height from which on an error is drawn.
_VISIBLE_SHARE = 2e-3
#: Up to this share of the width from a singular point, large values don't count for the height of the picture.
_NEAR_SINGULAR = 0.05
_NEAR_IRREGULAR = 0.2
#: Solutions whose sizes are in this range, and its inverse, are drawn in doubles.
_LEAST_SIZE = 1e-300
#: The largest integral of sqrt|S| over an interval that the user hasn't chosen.
_MODEST = 100
#: If one of two solutions is this many times as large as the other, it is drawn times a power of ten: a solution is one up to
#: a factor.
_MUCH_LARGER = 30
#: The axis is cut off if the largest value is more than this many times the typical size: cosh isn't cut off.
_RANGE = 4


@dataclass(frozen=True)
class SampledCurve:
    """A solution over an interval: arcs and envelopes in order, some of them separated by singular points."""

    parts: tuple[Arc | Envelope, ...]
    singular: tuple[complex, ...]
    irregular: tuple[complex, ...]  # those near which solutions are as large as exp(1/distance)
    initial: Start  # with the default values

    def times(self, factor: float) -> SampledCurve:
        """The curve of a multiple of the solution."""
        return replace(self, parts=tuple(part.times(factor) for part in self.parts))

    @property
    def arcs(self) -> list[Arc]:
        return [part for part in self.parts if isinstance(part, Arc)]

    @property
    def envelopes(self) -> list[Envelope]:
        return [part for part in self.parts if isinstance(part, Envelope)]

    @property
    def largest(self) -> float:
        """The largest modulus of a value."""
        return max((float(np.abs(arc.y).max()) for arc in self.arcs), default=0.0)


def sampled_curve(equation: object, start: object, stop: object, points: int, request: Request) -> SampledCurve:
    """The requested solution over [start, stop] in proven values.

    Raises `InputError` if start isn't below stop, and the exceptions of `evaluate`.
    """
    initial, accuracy, _, params, var = request
    a, b = _interval_of(start, stop)
    points = whole(points, "points", least=2)
    equation = with_variable(equation, var, accuracy.limits, params)
    chart = chart_of(equation, {}, params)
    intervals = _regular_intervals(chart, a, b)
    if initial.x0 is None and initial.y0 is None and initial.dy0 is None:
        initial = replace(initial, x0=_middle_of_the_longest(intervals))
    elif initial.x0 is None:
        if intervals[0][0] != a:
            problem = f"the values need a place: {plain_text(a)}, the left end, is a singular point"
            raise InputError(problem, hint="x0=...", shell="--x0")
        initial = replace(initial, x0=a)
    if initial.which is None and initial.frobenius is None:
        y0, dy0 = (usual if given is None else given for given, usual in ((initial.y0, 1), (initial.dy0, 0)))
        initial = replace(initial, y0=y0, dy0=dy0)
    digits = 8 if accuracy.digits is None else accuracy.digits
    chart = replace(chart, given=fields_of(initial))

    def states(places: Sequence[ExactPoint]) -> Any:
        return chart.states(list(places), digits, accuracy.limits, path="above", method=accuracy.method)

    parts = [part for interval in intervals for part in arcs(chart, interval, b - a, points, states)]
    singular, irregular = (
        tuple(complex(z) for z in points if max(abs(z.x), abs(z.y)) < FARTHEST)
        for points in (chart.singular, chart.irregular)
    )
    return SampledCurve(tuple(parts), singular, irregular, initial)


def _interval_of(start: object, stop: object) -> tuple[Fraction, Fraction]:
    a = as_point(start, "from")
    b = as_point(stop, "to")
    if not (a.is_real() and b.is_real()) or a.re >= b.re:
        raise InputError(f"the interval from {a} to {b} is empty", hint="give real numbers, the smaller one first")
    if max(abs(a.re), abs(b.re)) > FARTHEST:
        raise InputError(f"the interval from {a} to {b} is beyond the range of doubles, in which pictures are drawn")
    return a.re, b.re


def _regular_intervals(chart: PieceChart, a: Fraction, b: Fraction) -> list[tuple[Fraction, Fraction]]:
    """The parts of [a, b] between singular points, shortened near each of these."""
    cuts = sorted({z.re for z in chart.singular if z.is_real() and a <= z.re <= b})
    wild = {float(point.re) for point in chart.irregular}
    share = {a: Fraction(0), b: Fraction(0)}
    share |= {end: _IRREGULAR_GAP if float(end) in wild else _SINGULAR_GAP for end in cuts}
    return [
        (left + (right - left) * share[left], right - (right - left) * share[right])
        for left, right in pairwise([a, *cuts, b])
        if left < right
    ]


def _middle_of_the_longest(intervals: list[tuple[Fraction, Fraction]]) -> Fraction:
    """The middle, or a simpler number near it, which the legend can show."""
    low, high = max(intervals, key=lambda interval: interval[1] - interval[0])
    middle = (low + high) / 2
    plain = middle.limit_denominator(9)
    return plain if abs(plain - middle) < (high - low) / 8 else middle


@limited
def plot(
    equation: object,
    start: object,
    stop: object,
    *,
    title: str | None = None,
    output: str | Path | None = None,
    points: int = 400,
    **keywords: Unpack[Keywords],
) -> Figure:
    """A figure with the real part over [start, stop], and the imaginary part unless it can't be told from zero.

    It isn't shown, except by a notebook.

    Parameters
    ----------
    equation
        An answer of `solve`, S or an equation, as for `kovacic.evaluate`, real for real x.
    start, stop : number
        The ends of the interval, real, exact: 0.5 and "1/3"; singular points between them are marked.
    title : str
        Above the picture; the equation by default.
    output : str or Path
        A file to which the picture is saved; its suffix is png, svg or pdf.
    points : int
        The least number of samples, 400 by default; more are taken where the solution oscillates or bends.
    initial : Start
        The solution; the values are 1 and 0 by default, and x0 is `start`.  Without any of them y1 and y2 of an answer are
        drawn if they are known, else the solution with these values at the middle of the longest interval without singular
        points.  The legend says which.
    accuracy, params, var
        As for `kovacic.evaluate`.

    Raises
    ------
    InputError
        Unless start < stop, and as `kovacic.evaluate`.

    Examples
    --------
    >>> import kovacic
    >>> figure = kovacic.solve("x^2 + 3").plot(-1, 1, points=20)
    >>> [line.get_label()[:4] for line in figure.axes[0].get_lines()][:2]
    ['$y_1', '$y_2']
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
    request = Request.of("plot", keywords, unused=("path",))
    given = equation
    if isinstance(equation, str) or request.var is not None:
        equation = _read_with_variable(equation, request)
        request = request._replace(var=None)
    if title is None:
        title = _title(equation, given, request.params)
    from matplotlib.figure import Figure as NewFigure

    curves = _curves(equation, start, stop, points, request)
    low, high = map(float, _interval_of(start, stop))
    lines = [line for label, curve in curves for line in _drawn_parts(label, curve)]
    figure = NewFigure(figsize=(8, 4.8), layout="constrained")
    axes = figure.add_subplot()
    for number, line in enumerate(lines):
        line.draw(axes, f"C{number}")
    label: str | None = "singular point"
    for z in curves[0][1].singular:
        if z.imag == 0 and low <= z.real <= high:
            axes.axvline(z.real, color="0.4", linestyle="--", linewidth=1, label=label)
            label = None  # once in the legend
    axes.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    variable, unknown = map(_typeset, _axis_names(equation))
    axes.set(xlim=(low, high), xlabel=variable, ylabel=unknown)
    axes.set_title(title, pad=18)  # room for the denominators of formulas
    _cut_axis(axes, lines, high - low)
    _, names = axes.get_legend_handles_labels()
    ncols = 2 if max(map(len, names)) <= _LABEL_WIDTH else 1
    size = "large" if any(r"\frac" in name for name in names) else "medium"
    figure.legend(loc="outside lower center", ncols=ncols, frameon=False, fontsize=size)
    if output is not None:
        figure.savefig(output, dpi=150)

    def png() -> bytes:
        figure.savefig(file := BytesIO(), format="png")
        return file.getvalue()

    figure._repr_png_ = png  # type: ignore[attr-defined]  # Jupyter shows it without pyplot
    return figure


def _typeset(latex: str, otherwise: str | None = None) -> str:
    """A formula in matplotlib's subset of LaTeX; text, by default the LaTeX itself, for one outside of that subset."""
    from matplotlib.mathtext import MathTextParser

    with suppress(ValueError):
        if latex:
            MathTextParser("path").parse(f"${latex}$")
            return f"${latex}$"
    return (latex if otherwise is None else otherwise).replace("$", r"\$")


def _title(equation: object, given: object, params: Mapping[str, object] | None) -> str:
    """The equation, and the values of parameters; nothing for coefficients without a text of their own."""
    text = given.text if isinstance(given, Answer) else given
    latex = ""
    # After a change of variable the equation isn't the given one: then the user's text stands above the picture.
    if isinstance(equation, Answer | Parsed) and (equation.equation is None or equation.equation.change is None):
        formula = equation_of(equation)
        text, latex = formula.text, formula.latex
    elif isinstance(text, str) and "\\" not in text:
        latex = latex_text(text)
    if not isinstance(text, str) or len(text) > 2 * _LABEL_WIDTH:
        return ""
    values = [f"{name} = {plain_text(value)}" for name, value in (params or {}).items()]
    latex = latex.replace(r"\frac", r"\dfrac")
    return ",   ".join([_typeset(latex, text), *(_typeset(latex_text(value), value) for value in values)])


def _read_with_variable(equation: object, request: Request) -> object:
    """The equation with the name of its variable, which the axis has."""
    params = request.params or {}
    limits = limits_of(request.accuracy.limits)
    if not isinstance(equation, str) or request.var is not None:
        return with_variable(equation, request.var, limits, params)
    try:
        return read_input(equation, limits=limits, exponentials=True, names=words_among(params))
    except NotRational:
        return as_written(equation, None, limits, words_among(params))


def _axis_names(equation: object) -> tuple[str, str]:
    """The variable and the unknown, for the axes."""
    given = equation.equation if isinstance(equation, Answer | Parsed) else None
    if given is None:
        return str(equation.variable) if isinstance(equation, Answer | Parsed | Coefficients) else "x", "y"
    return given.variable if given.change is None else given.change.variable, given.unknown


def _curves(
    equation: object, start: object, stop: object, points: int, request: Request
) -> list[tuple[_Label, SampledCurve]]:
    """The curves of a picture, each with its name in the legend."""
    if isinstance(equation, Answer) and not {"y0", "dy0", "which", "frobenius"} & {*fields_of(request.start)}:
        # y1 and y2 solve the homogeneous equation alone.
        is_homogeneous = equation.equation is None or equation.equation.is_homogeneous
        found = _solution_curves(equation, start, stop, points, request) if is_homogeneous else []
        if found:
            return found
    curve = sampled_curve(equation, start, stop, points, request)
    return [(_Label(_name_by_values(_axis_names(equation)[1], curve.initial)), curve)]


def _name_by_values(y: str, initial: Start) -> str:
    """The name of a solution in the legend, by its values or by its behaviour at x0."""
    at = plain_text(initial.x0)
    place = _typeset(latex_text(f"x = {at}"), f"x = {at}")
    if initial.which == "regular":
        return f"{_typeset(y)} regular at {place}"
    if initial.frobenius is not None:
        c1, c2 = map(plain_text, initial.frobenius)
        return f"{_typeset(y)} = ({c1}) {_typeset(f'{y}_1')} + ({c2}) {_typeset(f'{y}_2')} of the Frobenius basis at {place}"
    values = [f"{y}({at}) = {'1' if initial.y0 is None else plain_text(initial.y0)}"]
    if initial.which is None:
        values.append(f"{y}'({at}) = {plain_text(initial.dy0)}")
    shown = ", ".join(values)
    if len(shown) > _LABEL_WIDTH:
        return _typeset(y)
    typeset = _typeset(r",\ ".join(map(latex_text, values)), shown)
    return f"{_typeset(y)} decaying, {typeset}" if initial.which == "decaying" else f"{_typeset(y)}, where {typeset}"


@dataclass(frozen=True)
class _Label:
    """The name of a solution in the legend, its formula in LaTeX if it is known and short, and the factor of the curve."""

    name: str
    formula: str = ""
    factor: str = ""

    def of_part(self, part: str) -> str:
        """The entry of the real or the imaginary part, or, for "", of a real solution."""
        equation = _typeset(f"{self.name.strip('$')} = {self.formula}", "") if self.formula else ""
        before = [part] * bool(part) + [_typeset(self.factor)] * bool(self.factor)
        if before:
            return " ".join([*before, self.name]) + f", {equation or self.name}" * bool(self.formula)
        return equation or self.name


def _solution_curves(
    answer: Answer, start: object, stop: object, points: int, request: Request
) -> list[tuple[_Label, SampledCurve]]:
    """y1 and y2 of the answer, as the solutions with their values and slopes at x0; empty if these aren't known.

    The equation is real: where a value is complex, real or imaginary parts are drawn, on either side of a singular point those
    that are independent there.  A solution that decays from x0 on needs initial values with the digits that the other one gains
    on the way.
    """
    import sympy

    unknown = _axis_names(answer)[1]
    x = sympy.Symbol(_axis_names(answer)[0])
    pair = _evaluable_pair(answer, x, request.params or {})
    if not pair:
        return []
    a, b = _interval_of(start, stop)
    chart = chart_of(answer, {}, request.params)
    intervals = _regular_intervals(chart, a, b)
    # The larger one grows like exp(int sqrt(S)), S > 0, the other decays as fast: the quotient gains twice the integral.
    growth, _ = _integral_of_root(chart, intervals)
    digits = 30 + int(min(5000.0, 2 * growth / np.log(10)))
    found: list[list[tuple[str, SampledCurve]]] = [[], []]
    for low, high in intervals:
        at = _middle_of_the_longest([(low, high)])
        place = sympy.Rational(at.numerator, at.denominator)
        functions = _real_functions(unknown, [sympy.N(f.subs(x, place), digits) for y in pair for f in (y, y.diff(x))])
        # Other solutions are drawn if these are beyond the range of doubles.
        if not functions or not all(_LEAST_SIZE < sum(map(abs, values)) < 1 / _LEAST_SIZE for _, values in functions):
            return []
        for curves, (name, values) in zip(found, functions, strict=True):
            initial = Start(at, str(values[0]), str(values[1]))
            curves.append((name, sampled_curve(answer, low, high, points, request._replace(start=initial))))
    labelled = []
    for curves, y in zip(found, pair, strict=True):
        names = list(dict.fromkeys(name for name, _ in curves))
        curve = replace(curves[0][1], parts=tuple(part for _, curve in curves for part in curve.parts))
        text = of_sympy(y)
        is_shown = len(text.text) <= _LABEL_WIDTH and not names[0].startswith(("Re", "Im")) and _agrees(y, x, curve)
        if len(names) > 1:
            names = [f"{name} ({_typeset(latex_text(f'x = {there.initial.x0}'))})" for name, there in curves]
        labelled.append((_Label(", ".join(names), text.latex if is_shown else ""), curve))
    sizes = [_DrawnPart(curve, "real", "").sizes(float(b - a))[0] for _, curve in labelled]
    if max(sizes) > _MUCH_LARGER * min(sizes) > 0:
        k = math.floor(math.log10(max(sizes) / min(sizes)))
        larger = sizes.index(max(sizes))
        label, curve = labelled[larger]
        labelled[larger] = replace(label, factor=f"10^{{-{k}}}"), curve.times(10.0**-k)
    return labelled


def _evaluable_pair(answer: Answer, x: Any, params: Mapping[str, object]) -> list[Any]:
    """The formulas of y1 and y2 for these values of parameters; empty unless SymPy evaluates them in a moment."""
    import sympy

    form = derived.closed_form(answer)
    try:
        letters = {name: read_expression(plain_text(value)) for name, value in params.items()}
    except InputError:  # an enclosure, which no formula has
        return []
    pair = [y.subs(letters) for y in (derived.special(answer) if form is None else form)]
    # Powers of long numbers take SymPy minutes.
    is_long = any(has_long_numbers(y) or len(as_text(y)) > 2 * MOST_CHARACTERS for y in pair)
    both = sympy.Tuple(*pair)
    return [] if is_long or both.has(sympy.Integral) or not both.free_symbols <= {x} else pair


def _real_functions(unknown: str, values: Sequence[Any]) -> list[tuple[str, Sequence[Any]]]:
    """Two independent functions with their values and slopes: y1 and y2, whose data are given, or parts of them.

    Empty if the data, which have 30 digits, aren't numbers, or are dependent, as for some values of parameters.
    """
    import sympy

    if not all(value.is_number and value.is_finite for value in values):
        return []
    parts: list[tuple[str, Sequence[Any]]] = []
    for k, data in ((1, values[:2]), (2, values[2:])):
        is_real = all(value.is_real for value in data)
        own = [("", data)] if is_real else [("Re ", [*map(sympy.re, data)]), ("Im ", [*map(sympy.im, data)])]
        # Anything smaller is the rounding error of a part that is zero.
        least = 1e-25 * sum(map(abs, data))
        name = _typeset(f"{unknown}_{k}")
        parts += [(part + name, numbers) for part, numbers in own if sum(map(abs, numbers)) > least]
    for first, second in combinations(parts, 2):
        (y1, dy1), (y2, dy2) = first[1], second[1]
        if abs(y1 * dy2 - y2 * dy1) > 1e-25 * (abs(y1) + abs(dy1)) * (abs(y2) + abs(dy2)):
            return [first, second]
    return []


def _agrees(y: Any, x: Any, curve: SampledCurve) -> bool:
    """True if the formula has the values of its curve: beyond a singular point it may be on another branch."""
    import sympy

    largest = curve.largest
    for arc in curve.arcs:
        for k in np.linspace(0, len(arc.x) - 1, 3).astype(int):
            value = sympy.N(y.subs(x, sympy.Rational(float(arc.x[k]))), 15)
            allowed = 1e-6 * largest + float(arc.radius[k])
            if not value.is_number or not abs(complex(value) - arc.y[k]) <= allowed:
                return False
    return True


def modest_window(answer: Answer, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction] | None:
    """[low, high], or a shorter interval about its middle, over which the integral of sqrt|S| isn't large.

    So solutions oscillate at most some dozens of times, and grow by at most as many digits.  None if 23 halvings find none.
    """
    chart = chart_of(answer, {}, None)
    middle = (low + high) / 2
    for k in range(24):
        half = (high - low) / 2 ** (k + 1)
        a, b = middle - half, middle + half
        if sum(_integral_of_root(chart, _regular_intervals(chart, a, b))) <= _MODEST:
            return a, b
    return None


def _integral_of_root(chart: PieceChart, intervals: list[tuple[Fraction, Fraction]]) -> tuple[float, float]:
    """The integrals of sqrt(S) where S > 0, and of sqrt(-S) elsewhere, estimated from samples."""
    growth = turning = 0.0
    for low, high in intervals:
        here = curve_coefficients(chart, [ExactPoint(low + (high - low) * Fraction(k, 200)) for k in range(201)])
        growth += float(np.trapezoid(np.sqrt(np.maximum(here.S, 0.0)), here.x))
        turning += float(np.trapezoid(np.sqrt(np.maximum(-here.S, 0.0)), here.x))
    return growth, turning


@dataclass(frozen=True)
class _DrawnPart:
    """One line of a picture: the real or the imaginary part of a curve, with its entry in the legend."""

    curve: SampledCurve
    part: str
    label: str

    def values(self, numbers: Any) -> Any:
        return getattr(numbers, self.part)

    def draw(self, axes: Axes, colour: str) -> None:
        """The arcs, with bands where errors can be seen, and the envelopes."""
        label, largest = self.label, self.curve.largest
        for arc in self.curve.arcs:
            x, y = arc.drawn()
            axes.plot(x, self.values(y), linewidth=1.5, color=colour, label=label)
            label = "_"  # once in the legend
            if arc.radius.max() > _VISIBLE_SHARE * largest:
                low, high = self.values(arc.y) - arc.radius, self.values(arc.y) + arc.radius
                axes.fill_between(arc.x, low, high, color=colour, alpha=0.25, linewidth=0, label="error band")
        for envelope in self.curve.envelopes:
            size = self.values(envelope.size)
            label = f"{self.label}: envelope of {envelope.periods:,.0f} oscillations"
            axes.fill_between(envelope.x, -size, size, color=colour, alpha=0.35, linewidth=0.8, label=label)

    def sizes(self, width: float) -> tuple[float, float]:
        """The typical size, and the largest value.

        The typical size is the largest extremum of a solution that oscillates, or else its largest value, away from singular
        points, near which values may be arbitrarily large.
        """
        pieces = []
        for arc in self.curve.arcs:
            rising = self.values(arc.dy) > 0
            pieces.append((arc.x, np.abs(self.values(arc.y)), rising != np.roll(rising, -1)))
            pieces[-1][2][-1] = False  # np.roll compares the last sample with the first one
        pieces += [(part.x, self.values(part.size), np.full(len(part.x), True)) for part in self.curve.envelopes]
        x, size, turns = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
        away = np.full(len(x), True)
        for z in self.curve.singular:
            share = _NEAR_IRREGULAR if z in self.curve.irregular else _NEAR_SINGULAR
            away &= np.abs(x - z) > share * width
        # Three extrema are a wave; cosh has one.
        is_wave = np.count_nonzero(away & turns) > 2
        sizes = size[away & turns] if is_wave else size[away]
        return float(sizes.max(initial=0.0)), float(size.max())


def _drawn_parts(label: _Label, curve: SampledCurve) -> list[_DrawnPart]:
    """The real part, and the imaginary one if it can be told from zero."""
    is_complex = any(np.any(np.abs(arc.y.imag) > arc.radius) for arc in curve.arcs) or any(
        np.any(envelope.size.imag > 1e-6 * envelope.size.real.max()) for envelope in curve.envelopes
    )
    parts = [("real", "Re"), ("imag", "Im")] if is_complex else [("real", "")]
    return [_DrawnPart(curve, part, label.of_part(name)) for part, name in parts]


def _cut_axis(axes: Axes, lines: list[_DrawnPart], width: float) -> None:
    """Cut the axis off if a solution grows so much that the others, or its own oscillation, would be invisible."""
    sizes, largest = np.transpose([line.sizes(width) for line in lines])
    height = max(sizes.max(), largest[largest <= _RANGE * sizes.max()].max(initial=0.0))
    if largest.max() > _RANGE * height > 0:
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, -1.1 * height), min(high, 1.1 * height))
        axes.set_ylabel(f"{axes.get_ylabel()} (cut off at {height:.2g})")
