"""Pictures of a motion: the contact point's path on the fixed surface, u(t), omega_3(t), the reaction, and the errors."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from kovacic.ball.motion import Array, Motion

_BLUE, _ORANGE, _GREY, _GREEN = "#1f5f99", "#d9731a", "#8a8a8a", "#2f7d4f"


def draw(motion: Motion, times: Array, file: Path | str, *, title: str = "") -> None:
    """Write the picture of the motion at `times` to a file, whose suffix is its format (png, pdf, svg).

    After an error or an interruption there is no new file, and an older one is unchanged.
    """
    from matplotlib.figure import Figure

    reaction = motion.reaction(times)
    defects = motion.defects(times)
    errors = {"energy": motion.energy(times) - motion.energy(0.0), r"$\omega_3$": defects["omega_3"], "n": defects["n"]}
    errors = {name: np.maximum(np.abs(error), 1e-17) for name, error in errors.items()}  # the axis is logarithmic
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
    path = figure.add_subplot(grid[:, 0], projection="3d" if motion.ball.kappa else None)
    _draw_path(path, motion.contact(times), motion.ball.kappa)
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
    target = Path(file).resolve()  # through a symbolic link, which stays one
    unfinished = target.with_name(f"{target.stem}.{os.getpid()}{target.suffix}")
    try:
        figure.savefig(unfinished)
        unfinished.replace(target)
    finally:
        unfinished.unlink(missing_ok=True)


def _draw_path(axes: Any, points: Array, kappa: float) -> None:
    """On the plane; or on the sphere, seen from far away above the middle of the path, with circles every 30 degrees."""
    if kappa:
        shown = points.T
        X, Y, Z = points.mean(axis=0)
        azimuth = np.arctan2(Y, X)
        elevation = np.clip(np.arctan2(Z, np.hypot(X, Y)), -0.2, 0.7)
        axes.view_init(elev=np.degrees(elevation), azim=np.degrees(azimuth))
        axes.set_proj_type("ortho")
        v, u = np.mgrid[0 : 2 * np.pi : 73j, 0 : np.pi : 37j]
        grid = np.array([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)]) / abs(kappa)
        axes.plot_wireframe(*grid, rstride=6, cstride=6, color=_GREY, lw=0.5, alpha=0.4)
        axes.set_box_aspect((1, 1, 1), zoom=1.7)
        axes.set_axis_off()
        front = points @ Rotation.from_euler("ZY", [azimuth, -elevation]).as_matrix()[:, 0] >= 0
        surface, corner = "sphere (faint: far side)", "upper left"
    else:
        shown = points.T[:2]
        front = np.full(len(points), True)
        surface, corner = "plane", "best"
        axes.set(xlabel="X", ylabel="Y")
        axes.grid(True, color="#dddddd", lw=0.6)
        axes.set_aspect("equal", adjustable="datalim")
    for seen, alpha in ((~front, 0.3), (front, 1)):
        axes.plot(*np.where(seen, shown, np.nan), color=_BLUE, lw=1.5, alpha=alpha)
    for k, colour, label in ((0, _GREEN, "start"), (-1, _ORANGE, "end")):
        axes.scatter(*shown[:, k], color=colour, s=40, label=label, zorder=3)
    axes.set_title(f"path of the contact point on the {surface}", fontsize=10)
    axes.legend(loc=corner)
