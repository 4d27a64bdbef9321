"""The picture of every textbook: a potential, its levels at their heights, and the wave functions on them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ArrayFunction = Callable[[Any], Any]

#: A wave function is drawn as far as it exceeds this part of its greatest modulus, or the second one if its tail is long.
_TAILS = (0.03, 0.3)


@dataclass(frozen=True)
class DrawnLevel:
    """A level at its height: a real function of x for arrays, of any scale, and what the legend says."""

    energy: float
    wave: ArrayFunction
    label: str


def draw_levels(
    potential: ArrayFunction,
    levels: Sequence[DrawnLevel],
    domain: tuple[float, float],
    *,
    variable: str,
    title: str,
    impulses: Sequence[tuple[float, float]],
) -> Figure:
    """The potential and the levels, lowest first, where the wave functions are visible.

    Parameters
    ----------
    potential : callable
        V for arrays; values that aren't finite leave a gap.
    levels : sequence of DrawnLevel
        At least one.
    domain : pair of floats
        Its ends, -inf and inf among them.
    variable, title : str
        For the axis, and above the picture.
    impulses : sequence of pairs of floats
        The place and the strength of each delta function in V: an arrow, upwards where the strength is positive.

    Returns
    -------
    matplotlib.figure.Figure
    """
    from matplotlib.figure import Figure

    first, last = _window(levels, domain)
    x = np.linspace(first, last, 1201)[1:-1]
    energies = [level.energy for level in levels]
    ground, highest = min(energies), max(energies)
    V = _real_values(potential, x)
    k = int(np.nanargmin(V))
    depth = ground - float(V[k])
    # The minimum is that of a well, whose depth is the scale of a single level, and no sample beside a pole of V.
    is_well = depth > 0 and 0 < k < len(V) - 1 and np.nanmax(V[k - 1 : k + 2]) - V[k] < depth / 10
    spread = (highest - ground) / max(len(levels) - 1, 1) or (depth / 2 if is_well else max(abs(ground), 1.0))
    figure = Figure(figsize=(8, 5.5), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(x, V, color="black", lw=1.4, label=f"V({variable})")
    for level in levels:
        y = _real_values(level.wave, x)
        y = y / np.nanmax(np.abs(y)) * 0.45 * spread
        (line,) = axes.plot(x, level.energy + y, lw=1.3, label=level.label)
        axes.fill_between(x, level.energy, level.energy + y, color=line.get_color(), alpha=0.15, lw=0)
        axes.axhline(level.energy, color=line.get_color(), lw=0.7, ls="--")
    # V may not be bounded below, and its minimum may be above all levels.
    bottom = min(ground - spread, max(ground - depth - 0.1 * spread, ground - 6 * spread))
    top = max(highest + spread, ground - depth + 0.1 * spread)
    for place in (V, V[[0, -1]]):  # a barrier, or the begin of the continuous spectrum
        if np.nanmax(place) <= highest + 3 * spread:
            top = max(top, float(np.nanmax(place)) + 0.3 * spread)
    for place, strength in impulses:
        end = top if strength > 0 else bottom
        foot = float(np.interp(place, x, np.nan_to_num(V)))
        axes.annotate("", (place, end), (place, foot), arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0})
    axes.set(xlabel=variable, ylabel="energy", xlim=(first, last), ylim=(bottom, top))
    axes.set_title(title, wrap=True)
    figure.legend(loc="outside lower center", fontsize=9, ncols=2)
    return figure


def _real_values(function: ArrayFunction, x: Any) -> Any:
    """The real values, NaN where they aren't finite."""
    with np.errstate(all="ignore"):
        values = np.real(np.broadcast_to(np.asarray(function(x), dtype=complex), x.shape)).astype(float)
    return np.where(np.isfinite(values), values, np.nan)


def _window(levels: Sequence[DrawnLevel], domain: tuple[float, float]) -> tuple[float, float]:
    """The part of the domain outside of which no wave function is visible."""
    first, last = domain
    centre = next(end for end in (first, last, 0.0) if np.isfinite(end))
    distance, is_inside = 0.5, False
    while not is_inside and distance < 4096:
        distance *= 2
        low, high = max(first, centre - distance), min(last, centre + distance)
        x = np.linspace(low, high, 4801)[1:-1]
        sizes = [np.nan_to_num(np.abs(_real_values(level.wave, x))) for level in levels]
        # Where one of the functions exceeds a part of its maximum.
        parts = (x[np.any([size > tail * size.max() for size in sizes], axis=0)] for tail in _TAILS)
        wide, narrow = ((part[0], part[-1]) for part in parts)
        step = (high - low) / 50
        is_inside = (wide[0] > low + step or low == first) and (wide[1] < high - step or high == last)
    is_long = wide[1] - wide[0] > 6 * (narrow[1] - narrow[0])  # that of 1/x is
    left, right = narrow if is_long else wide
    margin = 0.15 * (right - left)
    return max(left - margin, first), min(right + margin, last)
