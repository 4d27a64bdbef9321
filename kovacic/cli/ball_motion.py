"""`kovacic ball --simulate`: the motion's figures, and its picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.ball.ball import BallOnSphere

#: Points in time at which a motion is looked at: so many, and so many more for each oscillation, up to a limit.
_SAMPLES, _PER_OSCILLATION, _MOST = 1200, 60, 60_000
#: Of `Motion.approach`: below it, errors above 1e-9 are likely.
_SENSITIVE = 1e-3


def simulate(
    sphere: BallOnSphere, *, start: Sequence[str], end: str, plot: Path | None, **force: str | None
) -> dict[str, Any]:
    """What `--json` shows of the motion from `start` = (u, u', v', n) up to the time `end`; writes the picture.

    `force` has `gravity` and `potential`.
    Raises `InputError` for what isn't a start, a time or a potential, `LimitExceeded` for more than 10^5 oscillations and for
    asymptotic motions, `click.ClickException` where a library is missing and where the picture can't be written.
    """
    from kovacic.errors import InputError

    try:
        import numpy as np

        from kovacic.ball.motion import State, as_float, solve_motion
        from kovacic.ball.plot import draw
    except ModuleNotFoundError as error:
        raise click.ClickException(f"a motion needs NumPy and SciPy: pip install kovacic[numeric] ({error})") from error

    time = as_float(end, "the time")
    if time <= 0:
        raise InputError(f"the time must be positive, not {time:g}")
    motion = solve_motion(sphere, State(*start), **force)
    motion.u(time)  # refuses too long a time before the many
    oscillations = time / motion.period if motion.period else 0
    times = np.linspace(0.0, time, min(_MOST, _SAMPLES + int(_PER_OSCILLATION * oscillations)))
    reaction = motion.reaction(times)
    pulls = None if reaction is None else np.flatnonzero(reaction < 0)
    if plot:
        where = f"{'inside' if motion.ball.kappa < 0 else 'on'} the sphere, R/R1 = {sphere.ratio}"
        try:
            draw(motion, times, plot, title=f"Ball {where if motion.ball.kappa else 'on the plane'}")
        except ModuleNotFoundError as error:
            raise click.ClickException(f"a picture needs Matplotlib: pip install kovacic[plot] ({error})") from error
        except OSError as error:
            raise click.ClickException(f"{plot} can't be written: {error.strerror}") from error
    return {
        "potential": str(motion.force.V),
        "turning_points": list(motion.turning_points),
        "period": motion.period,
        "time": time,
        "contact": (motion.contact(time) + 0.0).tolist(),
        "least_reaction": None if reaction is None else float(reaction.min()),
        "pulled_from": float(times[pulls[0]]) if pulls is not None and pulls.size else None,
        "difference": {name: float(np.abs(error).max()) for name, error in motion.defects(times).items()},
        "approach": motion.approach,
        "energy_drift": float(np.ptp(motion.energy(times))),
        "plot": None if plot is None else str(plot),
    }


def lines(motion: dict[str, Any]) -> list[str]:
    """The same as text."""
    low, high = motion["turning_points"]
    until = f"t <= {motion['time']:g}"
    rows = [("potential", f"V = {motion['potential']}")]
    if motion["period"] is None:
        rows.append(("steady motion", f"u = {low:.12g} stays constant"))
    else:
        rows += [("turning points", f"u = {low:.12g} and {high:.12g}"), ("period", f"{motion['period']:.15g}")]
    rows.append(("contact point", f"({', '.join(f'{value:.12g}' for value in motion['contact'])}) at the end"))
    if motion["least_reaction"] is not None:
        rows.append(("normal reaction", f"at least {motion['least_reaction']:.6g} ({until})"))
    if (pulls := motion["pulled_from"]) is not None:
        rows.append(("", f"from t = {pulls:.6g} on it has to pull at times: a ball that isn't held"))
        rows.append(("", "leaves the surface there; here it is held"))
    for name, value in motion["difference"].items():
        rows.append((f"difference {name}", f"{value:.2e} (closed form against the integrated motion, {until})"))
    rows.append(("energy drift", f"{motion['energy_drift']:.2e}"))
    if motion["approach"] < _SENSITIVE:
        rows.append(("", f"digits are lost: it comes as near as {motion['approach']:.1g} to an unstable steady motion"))
    if motion["plot"]:
        rows.append(("picture", motion["plot"]))
    return [f"{f'{label}:' if label else '':<20}{text}" for label, text in rows]
