"""Pictures of a motion: the contact point's path on the fixed surface, u(t), omega_3(t), the reaction, and the errors.

Drawn with Matplotlib's Agg canvas; nothing is ever shown on a screen.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

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
    _draw_path(figure.add_subplot(grid[:, 0]), motion.contact(times), motion.ball.kappa)
    panels = [figure.add_subplot(grid[k, 1]) for k in range(rows)]
    spin, force = "spin about the axis of symmetry, ", "normal reaction; below zero the ball would leave the surface"
    curves: list[tuple[Any, str, str, str]] = [
        (motion.u(times), _BLUE, "u (rad)", "colatitude of the contact point on the ball, and its turning points"),
        (motion.omega_3(times), _ORANGE, r"$\omega_3$ (rad per unit time)", rf"{spin}$\omega_3$"),
        (reaction, _GREEN, "force", force),
    ]
    for axes, (values, colour, label, heading) in zip(panels[:-1], curves, strict=False):
        axes.plot(times, values, color=colour)
        axes.set(ylabel=label, title=heading)
    for axes, level in [*((panels[0], u) for u in motion.turning_points), *((axes, 0) for axes in panels[2:-1])]:
        axes.axhline(level, color=_GREY, lw=0.8, ls="--")
    errors = {"energy": motion.energy(times) - motion.energy(0.0), **motion.defects(times)}
    for (name, error), colour in zip(errors.items(), (_GREEN, _ORANGE, _BLUE), strict=True):
        label = r"$\omega_3$" if name == "omega_3" else name
        panels[-1].semilogy(times, np.maximum(np.abs(error), 1e-17), color=colour, lw=1, label=label)
    worst = max(float(np.abs(error).max()) for error in errors.values())
    heading = "closed form against integration; energy against its start"
    panels[-1].set(xlabel="time t", ylabel="difference", title=heading, ylim=(1e-17, max(1e-9, 30 * worst)))
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
    finally:
        beside.unlink(missing_ok=True)


def _draw_path(axes: Any, points: Array, kappa: float) -> None:
    """On the plane; or the sphere seen from the middle of the path, from far away, with circles every 30 degrees."""
    view = np.eye(3)[:2]
    if kappa:
        radius, (X, Y, Z) = abs(1 / kappa), points.mean(axis=0)
        azimuth = np.arctan2(Y, X) if np.hypot(X, Y) > 1e-9 * radius else -np.pi / 3
        elevation = np.clip(np.arctan2(Z, np.hypot(X, Y)), -0.2, 0.7)
        down, right, towards = Rotation.from_euler("ZY", [azimuth, np.pi / 2 - elevation]).as_matrix().T
        view = np.array([right, -down, towards])  # the last one towards the eye
        angle = np.linspace(0, 2 * np.pi, 361)
        c, s, zero = radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle
        axes.plot(c, s, color=_GREY, lw=0.9)
        for k in np.arange(6) * np.pi / 6:
            parallel = (np.sin(k) * c, np.sin(k) * s, radius * np.cos(k) + zero)
            for circle in ((s * np.cos(k), s * np.sin(k), c), parallel):
                _curve(axes, view @ np.array(circle), _GREY, {"lw": 0.5, "alpha": 0.7}, {"lw": 0.5, "alpha": 0.2})
        axes.set_axis_off()
    else:
        axes.set(xlabel="X", ylabel="Y")
        axes.grid(True, color="#dddddd", lw=0.6)
    _curve(axes, view @ points.T, _BLUE, {"lw": 1.8 if kappa else 1.3}, {"lw": 1.0, "alpha": 0.35})
    for point, colour, label in ((points[0], _GREEN, "start"), (points[-1], _ORANGE, "end")):
        axes.scatter(*(view @ point)[:2], color=colour, s=40, label=label, zorder=3)
    where = "sphere (faint: far side)" if kappa else "plane"
    axes.set_title(f"path of the contact point on the {where}", fontsize=10)
    axes.set_aspect("equal", adjustable="box" if kappa else "datalim")
    axes.legend(loc="upper left" if kappa else "best")


def _curve(axes: Any, line: Array, colour: str, front: dict[str, float], back: dict[str, float]) -> None:
    """What lies behind (a third coordinate below 0) in another style."""
    behind = line[2] < 0 if len(line) == 3 else np.zeros(line.shape[1], dtype=bool)
    for seen, style in ((behind, back), (~behind, front)):
        axes.plot(*np.where(seen, line[:2], np.nan), color=colour, **style)
