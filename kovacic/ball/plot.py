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
        _draw_sphere(figure.add_subplot(grid[:, 0], projection="3d"), motion.contact(times), abs(1 / motion.ball.kappa))
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
    middle = points.mean(axis=0)
    azimuth = float(np.degrees(np.arctan2(middle[1], middle[0]))) if np.hypot(*middle[:2]) > 1e-9 * radius else -60.0
    elevation = float(np.clip(np.degrees(np.arctan2(middle[2], np.hypot(*middle[:2]))), -12, 40))
    eye = _direction(elevation, azimuth)
    axes.view_init(elevation, azimuth)
    axes.computed_zorder = False
    axes.set_proj_type("ortho")
    angle = np.linspace(0, 2 * np.pi, 181)
    axes.plot(*(radius * _limb(eye, angle)).T, color=_GREY, lw=0.9, zorder=1)
    for circle in _graticule(angle):
        front = circle @ eye >= 0
        for visible, alpha in ((False, 0.18), (True, 0.7)):
            part = np.where(front[:, None] == visible, radius * circle, np.nan)
            axes.plot(*part.T, color=_GREY, lw=0.5, alpha=alpha, zorder=1)
    front = points @ eye >= 0
    for visible, style in ((False, {"alpha": 0.35, "lw": 1.0}), (True, {"lw": 1.8})):
        axes.plot(*np.where(front[:, None] == visible, points, np.nan).T, color=_BLUE, zorder=3, **style)
    axes.scatter(*points[0], color=_GREEN, s=40, label="start", depthshade=False, zorder=4)
    axes.scatter(*points[-1], color=_ORANGE, s=40, label="end", depthshade=False, zorder=4)
    axes.set(xlabel="X", ylabel="Y", zlabel="Z")
    axes.set_title("path of the contact point on the sphere (faint: far side)", fontsize=10, pad=30)
    axes.set_box_aspect((1, 1, 1), zoom=1.05)
    axes.locator_params(nbins=5)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color((1, 1, 1, 0))
    axes.grid(False)
    axes.legend(loc="upper left")


def _limb(eye: Array, angle: Array) -> Array:
    """The outline of the unit sphere seen from the direction `eye`."""
    right = np.cross((0.0, 0.0, 1.0), eye)
    right /= np.linalg.norm(right)
    result: Array = np.outer(np.cos(angle), right) + np.outer(np.sin(angle), np.cross(eye, right))
    return result


def _graticule(angle: Array) -> list[Array]:
    """Meridians every 30 degrees and parallels every 30 degrees of the unit sphere, as closed curves."""
    zero = np.zeros_like(angle)
    curves = [
        np.stack([np.sin(angle) * np.cos(k), np.sin(angle) * np.sin(k), np.cos(angle)], axis=1)
        for k in np.arange(6) * np.pi / 6
    ]
    return curves + [
        np.stack([np.sin(k) * np.cos(angle), np.sin(k) * np.sin(angle), np.cos(k) + zero], axis=1)
        for k in np.arange(1, 6) * np.pi / 6
    ]


def _direction(elevation: float, azimuth: float) -> Array:
    e, a = np.radians(elevation), np.radians(azimuth)
    return np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])


def _draw_plane(axes: Any, points: Array) -> None:
    X, Y, _ = points.T
    axes.plot(X, Y, color=_BLUE, lw=1.3)
    axes.scatter(X[:1], Y[:1], color=_GREEN, s=36, label="start", zorder=3)
    axes.scatter(X[-1:], Y[-1:], color=_ORANGE, s=36, label="end", zorder=3)
    axes.set(xlabel="X", ylabel="Y", title="path of the contact point on the plane")
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(True, color="#dddddd", lw=0.6)
    axes.legend(loc="best")
