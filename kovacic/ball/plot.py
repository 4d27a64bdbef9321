"""Pictures of a motion: the contact point's path on the fixed surface, u(t), omega_3(t), the reaction, and the errors.

Drawn with Matplotlib's Agg canvas; nothing is ever shown on a screen.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import Any

import numpy as np

from kovacic.ball.dynamics import Array
from kovacic.ball.motion import Motion

_BLUE, _ORANGE, _GREY, _GREEN = "#1f5f99", "#d9731a", "#8a8a8a", "#2f7d4f"


def draw(motion: Motion, times: Array, path: Path | str, *, title: str = "") -> None:
    """Write the picture of the motion at `times`; the format follows from the suffix (png, pdf, svg).

    The file is there whole or, after an error or an interruption, not at all (an older one stays as it was).
    """
    from matplotlib.figure import Figure

    reaction = motion.reaction(times)
    figure = Figure(figsize=(12.5, 7.4 if reaction is None else 9.0), dpi=110)
    figure.set_layout_engine("constrained", wspace=0.08)
    rows = 3 if reaction is None else 4
    grid = figure.add_gridspec(rows, 2, width_ratios=(1.15, 1))
    if motion.ball.kappa == 0:
        _draw_plane(figure.add_subplot(grid[:, 0]), motion.contact(times))
    else:
        _draw_sphere(figure.add_subplot(grid[:, 0]), motion.contact(times), abs(1 / motion.ball.kappa))
    panels = [figure.add_subplot(grid[k, 1]) for k in range(rows)]
    panels[0].plot(times, motion.u(times), color=_BLUE)
    for level in motion.turning_points:
        panels[0].axhline(level, color=_GREY, lw=0.8, ls="--")
    panels[0].set(ylabel="u (rad)", title="colatitude of the contact point on the ball, and its turning points")
    panels[1].plot(times, motion.omega_3(times), color=_ORANGE)
    panels[1].set(ylabel=r"$\omega_3$ (rad per unit time)", title=r"spin about the axis of symmetry, $\omega_3$")
    if reaction is not None:
        panels[2].plot(times, reaction, color=_GREEN)
        panels[2].axhline(0, color=_GREY, lw=0.8, ls="--")
        panels[2].set(ylabel="force", title="normal reaction; below zero the ball would leave the surface")
    errors = {"energy": motion.energy(times) - motion.energy(0.0), **motion.defects(times)}
    for (name, error), colour in zip(errors.items(), (_GREEN, _ORANGE, _BLUE), strict=True):
        label = r"$\omega_3$" if name == "omega_3" else name
        panels[-1].semilogy(times, np.maximum(np.abs(error), 1e-17), color=colour, lw=1, label=label)
    panels[-1].set(
        xlabel="time t", ylabel="difference", title="closed form against integration; energy against its start"
    )
    panels[-1].set_ylim(1e-17, max(1e-9, 30 * max(float(np.abs(error).max()) for error in errors.values())))
    panels[-1].legend(loc="upper right", ncols=3, fontsize=9)
    for axes in panels:
        axes.grid(True, color="#dddddd", lw=0.6)
        axes.margins(x=0.01)
        axes.title.set_fontsize(10)
    if title:
        figure.suptitle(title)
    picture = io.BytesIO()
    figure.savefig(picture, format=Path(path).suffix.lower().removeprefix(".") or None)
    _write_whole(Path(path), picture.getvalue())


def _write_whole(path: Path, content: bytes) -> None:
    """Write beside the file first, and put that in its place; a device or a pipe is written to."""
    if path.exists() and not path.is_file():
        path.write_bytes(content)
        return
    target = path.resolve()  # through a symbolic link, which stays one
    beside = target.with_name(f"{target.name}.{os.getpid()}.tmp")
    try:
        beside.write_bytes(content)
        if target.exists():
            beside.chmod(target.stat().st_mode)
        beside.replace(target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def _draw_sphere(axes: Any, points: Array, radius: float) -> None:
    """The sphere seen from the middle of the path, from far away, with meridians and parallels every 30 degrees."""
    X, Y, Z = points.mean(axis=0)
    azimuth = np.arctan2(Y, X) if np.hypot(X, Y) > 1e-9 * radius else -np.pi / 3
    elevation = np.clip(np.arctan2(Z, np.hypot(X, Y)), -0.2, 0.7)
    ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    view = np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])  # right, up, towards the eye

    def curve(line: Array, colour: str, front: dict[str, float], back: dict[str, float]) -> None:
        right, up, depth = view @ line
        for seen, style in ((depth < 0, back), (depth >= 0, front)):
            axes.plot(np.where(seen, right, np.nan), np.where(seen, up, np.nan), color=colour, **style)

    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(radius * np.cos(angle), radius * np.sin(angle), color=_GREY, lw=0.9)
    c, s, one = np.cos(angle), np.sin(angle), np.ones_like(angle)
    for k in np.arange(6) * np.pi / 6:
        circles = [
            np.array([s * np.cos(k), s * np.sin(k), c]),
            np.array([np.sin(k) * c, np.sin(k) * s, np.cos(k) * one]),
        ]
        for circle in circles:
            curve(radius * circle, _GREY, {"lw": 0.5, "alpha": 0.7}, {"lw": 0.5, "alpha": 0.2})
    curve(points.T, _BLUE, {"lw": 1.8}, {"lw": 1.0, "alpha": 0.35})
    for point, colour, label in ((points[0], _GREEN, "start"), (points[-1], _ORANGE, "end")):
        axes.scatter(*(view @ point)[:2], color=colour, s=40, label=label, zorder=3)
    axes.set_title("path of the contact point on the sphere (faint: far side)", fontsize=10)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.legend(loc="upper left")


def _draw_plane(axes: Any, points: Array) -> None:
    X, Y, _ = points.T
    axes.plot(X, Y, color=_BLUE, lw=1.3)
    axes.scatter(X[:1], Y[:1], color=_GREEN, s=36, label="start", zorder=3)
    axes.scatter(X[-1:], Y[-1:], color=_ORANGE, s=36, label="end", zorder=3)
    axes.set(xlabel="X", ylabel="Y", title="path of the contact point on the plane")
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(True, color="#dddddd", lw=0.6)
    axes.legend(loc="best")
