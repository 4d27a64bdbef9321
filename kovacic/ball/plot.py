"""Pictures of a motion: the contact point's path on the fixed surface, u(t), omega_3(t), the reaction, and the errors.

Drawn with Matplotlib's Agg canvas; nothing is ever shown on a screen.
"""

from __future__ import annotations

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

    reaction, errors = motion.reaction(times), motion.defects(times)
    errors = {"energy": motion.energy(times) - motion.energy(0.0), r"$\omega_3$": errors["omega_3"], "n": errors["n"]}
    errors = {name: np.maximum(np.abs(error), 1e-17) for name, error in errors.items()}
    panels: list[tuple[dict[str, Any], str, str, tuple[float, ...]]] = [
        ({"": motion.u(times)}, "u (rad)", "colatitude of the contact point on the ball", motion.turning_points),
        ({"": motion.omega_3(times)}, r"$\omega_3$ (rad per unit time)", "spin about the axis of symmetry", ()),
        ({"": reaction}, "force", "normal reaction; below zero the ball would leave the surface", (0,)),
        (errors, "difference", "closed form against integration; energy against its start", ()),
    ]
    if reaction is None:
        del panels[2]
    figure = Figure(figsize=(12.5, 2.6 + 1.6 * len(panels)), dpi=110)
    figure.set_layout_engine("constrained", wspace=0.08)
    grid = figure.add_gridspec(len(panels), 2, width_ratios=(1.15, 1))
    _draw_path(figure.add_subplot(grid[:, 0]), motion.contact(times), motion.ball.kappa)
    for k, (curves, label, heading, levels) in enumerate(panels):
        axes = figure.add_subplot(grid[k, 1])
        for name, values in curves.items():
            axes.plot(times, values, lw=1.2, label=name)
        for level in levels:
            axes.axhline(level, color=_GREY, lw=0.8, ls="--")
        axes.set_title(heading, fontsize=10)
        axes.set_ylabel(label)
        axes.grid(True, color="#dddddd", lw=0.6)
        axes.margins(x=0.01)
    axes.set(xlabel="time t", yscale="log", ylim=(1e-17, max(1e-9, *(30 * error.max() for error in errors.values()))))
    axes.legend(loc="upper right", ncols=3, fontsize=9)
    figure.suptitle(title)
    target = Path(path).resolve()  # through a symbolic link, which stays one
    beside = target.with_name(f"{target.stem}.{os.getpid()}{target.suffix}")
    try:
        figure.savefig(beside)
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)


def _draw_path(axes: Any, points: Array, kappa: float) -> None:
    """On the plane; or the sphere seen from the middle of the path, from far away, with circles every 30 degrees."""
    view = np.eye(3)
    if kappa:
        radius, (X, Y, Z) = abs(1 / kappa), points.mean(axis=0)
        azimuth = np.arctan2(Y, X) if np.hypot(X, Y) > 1e-9 * radius else -np.pi / 3
        elevation = np.clip(np.arctan2(Z, np.hypot(X, Y)), -0.2, 0.7)
        down, right, towards = Rotation.from_euler("ZY", [azimuth, np.pi / 2 - elevation]).as_matrix().T
        view = np.array([right, -down, towards])  # the last one towards the eye
        angle = np.linspace(0, 2 * np.pi, 361)
        c, s = radius * np.cos(angle), radius * np.sin(angle)
        axes.plot(c, s, color=_GREY, lw=0.9)
        for k in np.arange(6) * np.pi / 6:
            _curve(axes, view @ [s * np.cos(k), s * np.sin(k), c], _GREY, lw=0.5)
            _curve(axes, view @ [np.sin(k) * c, np.sin(k) * s, np.full(361, radius * np.cos(k))], _GREY, lw=0.5)
        axes.set_axis_off()
    else:
        axes.set(xlabel="X", ylabel="Y")
        axes.grid(True, color="#dddddd", lw=0.6)
    path = view @ points.T
    _curve(axes, path, _BLUE, lw=1.5)
    for k, colour, label in ((0, _GREEN, "start"), (-1, _ORANGE, "end")):
        axes.scatter(*path[:2, k], color=colour, s=40, label=label, zorder=3)
    where = "sphere (faint: far side)" if kappa else "plane"
    axes.set_title(f"path of the contact point on the {where}", fontsize=10)
    axes.set_aspect("equal", adjustable="box" if kappa else "datalim")
    axes.legend(loc="upper left" if kappa else "best")


def _curve(axes: Any, line: Array, colour: str, *, lw: float) -> None:
    """What lies behind (its third coordinate is below 0) is faint."""
    for seen, alpha in ((line[2] < 0, 0.3), (line[2] >= 0, 1)):
        axes.plot(*np.where(seen, line[:2], np.nan), color=colour, lw=lw, alpha=alpha)
