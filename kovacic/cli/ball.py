"""`kovacic ball`: the equation of a rolling ball, what the theorems say about it, its solutions, its motion."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.options import PICTURE

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.ball.ball import BallOnSphere, Rolling

#: Points in time at which a motion is looked at: so many, and so many more for each oscillation, up to a limit.
_SAMPLES, _PER_OSCILLATION, _MOST = 1200, 60, 60_000
#: Of `Motion.approach`: below it, errors above 1e-9 are likely.
_SENSITIVE = 1e-3


@click.command()
@click.option(
    "--ratio", metavar="R/R1", help="The ratio of the radii alone, a number or a name: all in x1, x2, the roots of D."
)
@click.option("--mass", metavar="M", help="The ball's mass.")
@click.option("--radius", metavar="R", help="The ball's radius.")
@click.option("--offset", metavar="a", default="0", show_default=True, help="Centre of mass to centre, along the axis.")
@click.option("--A1", "a1", metavar="A1", help="The moment of inertia A1 = A2 (default: homogeneous, 2/5 m R^2).")
@click.option("--A3", "a3", metavar="A3", help="The moment of inertia about the axis (default: 2/5 m R^2).")
@click.option("--sphere", metavar="R1", help='The sphere\'s radius (negative: rolling inside), or "plane".')
@click.option("--json", "as_json", is_flag=True, help="One JSON object.")
@click.option("--latex", is_flag=True, help="The equations in LaTeX, for $...$.")
@click.option("--explain", is_flag=True, help="The derivation of the equations from the definitions, checked.")
@click.option("--simulate", is_flag=True, help="The motion: turning points, period, path, reaction.")
@click.option("--gravity", metavar="g", help="Strength of the force that presses the ball to the surface (default: 1).")
@click.option(
    "--potential", metavar="V", help='Another potential in place of gravity, such as "3/2*cos(u) + sin(u)^2".'
)
@click.option(
    "--start",
    nargs=4,
    default=("1", "0.5", "0.3", "2"),
    show_default=True,
    metavar="u u' v' n",
    help="Numbers at time 0: 1, 0.5, sqrt(2)/2, pi/4.",
)
@click.option("--time", "end", metavar="T", default="20", show_default=True, help="The motion from 0 to this time.")
@click.option("--plot", metavar="FILE", type=PICTURE, help="A picture (png, pdf, svg).")
def ball(as_json: bool, latex: bool, explain: bool, **given: Any) -> None:
    """A ball with an axially symmetric mass distribution that rolls on a sphere.

    Numbers are exact: 3/2, 0.25, sqrt(2), and only the motion is computed in floating point.  Any consistent units; moments
    are mass * length^2, angles radians.  A potential is a function of cos(u), u being the angle between the ball's axis and
    the normal at the contact; a uniform field over a sphere isn't one.

    \b
    kovacic ball --ratio 3/2
    kovacic ball --mass 1 --radius 2 --offset 1/5 --A1 1 --A3 4/3 --sphere 3
    kovacic ball --mass 1 --radius 1 --sphere 3 --explain
    kovacic ball --mass 1 --radius 1 --sphere 3 --simulate --plot path.png
    """
    data = _by_ratio(**given) if given["ratio"] is not None else _by_parameters(**given)
    if not latex:
        del data["latex"]
    if explain:
        from kovacic.ball.equations import derivation, holds

        data = {"derivation": derivation(format="latex" if latex else "text"), "derived": all(holds().values()), **data}
    click.echo(json.dumps(data, ensure_ascii=False) if as_json else _text(data))


def _by_ratio(ratio: str, **given: Any) -> dict[str, Any]:
    from kovacic.ball.ball import InRoots
    from kovacic.ball.theorems import read_ratio

    if any(given[name] is not None for name in ("mass", "radius", "sphere", "a1", "a3", "plot")) or given["simulate"]:
        raise click.UsageError("--ratio stands alone: a mass, moments or a motion need --mass, --radius, --sphere")
    place = InRoots(read_ratio(ratio))
    data = _answer(place)
    if place.ratio.free_symbols:
        from kovacic.parametric.api import conditions

        data["conditions"] = [line.strip() for line in str(conditions(place.S, var="x")).splitlines()[1:]]
    D = "A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2"
    return {**data, "note": f"x = cos u; x1, x2 are the roots of D(x) = {D}, two different ones"}


def _by_parameters(**given: Any) -> dict[str, Any]:
    from kovacic.ball import Ball
    from kovacic.ball.ball import exact

    mass, radius, place, plot = (given[name] for name in ("mass", "radius", "sphere", "plot"))
    if None in (mass, radius, place):
        raise click.UsageError("either --ratio, or --mass, --radius and --sphere")
    if None not in (given["gravity"], given["potential"]):
        raise click.UsageError("either --gravity or --potential")
    if exact(given["offset"], "a") != 0 and None in (given["a1"], given["a3"]):
        raise click.UsageError("a ball with --offset isn't homogeneous: give its moments too, --A1 and --A3")
    standard = exact(mass, "m") * exact(radius, "R") ** 2 * exact("2/5", "2/5")
    A1, A3 = (standard if given[name] is None else given[name] for name in ("a1", "a3"))
    ball = Ball(m=mass, R=radius, a=given["offset"], A1=A1, A3=A3)
    sphere = ball.on_plane() if place == "plane" else ball.on_sphere(place)
    data = {
        "ball": sphere.kind,
        "D": str(sphere.D),
        "roots": ", ".join(map(str, sphere.roots)),
        **_answer(sphere),
        "note": "x = cos u; units are those of the input",
    }
    if given["simulate"] or plot is not None:
        options = {name: given[name] for name in ("gravity", "potential", "start", "end", "plot")}
        data["motion"] = _simulate(sphere, **options)
    return data


def _answer(place: Rolling) -> dict[str, Any]:
    """What the theorems and the engine say, and the closed form, which is checked."""
    import kovacic
    from kovacic.ball import closed_form
    from kovacic.ball.equations import equations_of
    from kovacic.ball.theorems import theorem
    from kovacic.views.breaking import breakable

    # In the roots, the case and the group don't change when x1 and x2 are carried to 1 and -1.
    solution, form = kovacic.solve(place.S.subs({"x1": 1, "x2": -1}), var="x"), closed_form(place)
    equations = equations_of(place)
    return {
        "ratio": str(place.ratio),
        "N": str(2 * place.ratio),
        "theorem": theorem(place)[0],
        "equation": equations["12"].text,
        "S": str(place.S),
        "status": solution.status.value,
        "case": solution.case,
        "omega": [str(omega) for omega in form.omega],
        **({} if form.E is None else {"E": str(form.E)}),
        "y": str(form.y),
        "omega_3": str(form.omega_3),
        "n": str(form.n),
        "group": None if solution.group is None else solution.group.name,
        "verified": solution.verified and form.solves(place),
        "latex": {name: breakable(math.latex) for name, math in equations.items()},
    }


#: What a line of text begins with.
_LABELS = (
    ("ratio", "R/R1"), ("N", "N = 2R/R1"), ("ball", "ball"), ("D", "D(x)"), ("roots", "x1, x2"), ("theorem", "theorem"),
    ("conditions", "by the engine"), ("equation", "equation (12)"), ("S", "(13) y'' = S y, S"), ("case", "case"),
    ("omega", "omega(x) = y'/y"), ("E", "E(x)"), ("y", "y"), ("omega_3", "omega_3"), ("n", "n"), ("group", "group"),
    ("verified", "verified"), ("note", ""),
)  # fmt: skip


def _text(data: dict[str, Any]) -> str:
    lines = [data["derivation"], f"Derived from the definitions: {data['derived']}", ""] if "derivation" in data else []
    for key, label in _LABELS:
        value = data.get(key, "")
        for k, line in enumerate(value if isinstance(value, list) else [str(value)]):
            if key == "N" and "Theorem 2:" in data["theorem"]:
                line += ", not an integer"
            if key in ("case", "group") and "conditions" in data:
                line += " for generic values"
            for name in ("E", "D") if key in ("omega", "y", "omega_3", "n") else ():
                whole = f"({data.get(name)})"
                line = line.replace(f"{whole}**", f"{name}**").replace(whole, f"({name})")
            if line:
                lines.append(f"{f'{label}:' if label and not k else '':<20}{line}")
    lines += [f"{f'({name}) LaTeX:':<20}{formula}" for name, formula in data.get("latex", {}).items()]
    return "\n".join([*lines, *(_motion_lines(data["motion"]) if "motion" in data else ())])


def _simulate(
    sphere: BallOnSphere, *, start: Sequence[str], end: str, plot: Path | None, **force: str | None
) -> dict[str, Any]:
    """What `--json` shows of the motion from `start` = (u, u', v', n) up to the time `end`; writes the picture.

    `force` has `gravity` and `potential`.
    Raises `InputError` for what isn't a start, a time or a potential, `LimitExceeded` for more than 10^5 oscillations and for
    asymptotic motions, `MissingExtra` where a library is missing.
    """
    from kovacic.errors import InputError, needs

    with needs("numeric", "a motion"):
        import numpy as np

        from kovacic.ball.motion import State, as_float, solve_motion
        from kovacic.ball.plot import draw

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
        with needs("plot", "a picture"):
            draw(motion, times, plot, title=f"Ball {where if motion.ball.kappa else 'on the plane'}")
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


def _motion_lines(motion: dict[str, Any]) -> list[str]:
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
