"""`kovacic ball`: the equation of a rolling ball, its case and group, its solutions, its motion."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli import ball_motion

if TYPE_CHECKING:
    from kovacic.ball.ball import BallOnSphere


_PICTURES = (".png", ".pdf", ".svg")


@click.command()
@click.option("--ratio", metavar="R/R1", help="The ratio of the radii alone: the equation in x1, x2, the roots of D.")
@click.option("--mass", metavar="M", help="The ball's mass.")
@click.option("--radius", metavar="R", help="The ball's radius.")
@click.option("--offset", metavar="a", default="0", show_default=True, help="Centre of mass to centre, along the axis.")
@click.option("--A1", "a1", metavar="A1", help="The moment of inertia A1 = A2 (default: homogeneous, 2/5 m R^2).")
@click.option("--A3", "a3", metavar="A3", help="The moment of inertia about the axis (default: 2/5 m R^2).")
@click.option("--sphere", metavar="R1", help='The sphere\'s radius (negative: rolling inside), or "plane".')
@click.option("--json", "as_json", is_flag=True, help="One JSON object.")
@click.option("--latex", is_flag=True, help="The equations in LaTeX.")
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
@click.option(
    "--plot", metavar="FILE", type=click.Path(dir_okay=False, writable=True), help="A picture (png, pdf, svg)."
)
def command(
    ratio: str | None,
    mass: str | None,
    radius: str | None,
    offset: str,
    a1: str | None,
    a3: str | None,
    sphere: str | None,
    as_json: bool,
    latex: bool,
    simulate: bool,
    gravity: str | None,
    potential: str | None,
    start: tuple[str, str, str, str],
    end: str,
    plot: str | None,
) -> None:
    """A ball with an axially symmetric mass distribution that rolls on a sphere.

    Numbers are exact: 3/2, 0.25, sqrt(2), and only the motion is computed in floating point.  Any consistent units; moments
    are mass * length^2, angles radians.  A potential is a function of cos(u), u being the angle between the ball's axis and
    the normal at the contact; a uniform field over a sphere isn't one.

    \b
    kovacic ball --ratio 3/2
    kovacic ball --mass 1 --radius 2 --offset 1/5 --A1 1 --A3 4/3 --sphere 3
    kovacic ball --mass 1 --radius 1 --offset 1/5 --A1 1/4 --A3 1/3 --sphere 3 --simulate --plot path.png
    """
    moving = simulate or plot is not None
    if ratio is not None:
        if any(value is not None for value in (mass, radius, sphere, a1, a3)) or moving:
            raise click.UsageError("--ratio stands alone: a mass, moments or a motion need --mass, --radius, --sphere")
        data = _by_ratio(ratio, latex)
    else:
        if mass is None or radius is None or sphere is None:
            raise click.UsageError("either --ratio, or --mass, --radius and --sphere")
        if gravity is not None and potential is not None:
            raise click.UsageError("either --gravity or --potential")
        if plot is not None and not plot.lower().endswith(_PICTURES):
            raise click.BadParameter(f"{plot} doesn't end in one of {', '.join(_PICTURES)}", param_hint="--plot")
        from kovacic.ball.ball import Ball, exact

        standard = exact(mass, "m") * exact(radius, "R") ** 2 * exact("2/5", "2/5")
        ball = Ball(m=mass, R=radius, a=offset, A1=standard if a1 is None else a1, A3=standard if a3 is None else a3)
        rolling = ball.on_plane() if sphere == "plane" else ball.on_sphere(sphere)
        data = _by_parameters(rolling, latex)
        if moving:
            data["motion"] = ball_motion.simulate(
                rolling, gravity=gravity, potential=potential, start=start, end=end, plot=plot
            )
    click.echo(json.dumps(data, ensure_ascii=False) if as_json else _text(data))


def _answer(S: Any) -> dict[str, Any]:
    """What the engine says about y'' = S y."""
    import kovacic

    solution = kovacic.solve(S)
    return {
        "status": solution.status.value,
        "case": solution.case,
        "group": solution.group.name if solution.group is not None else None,
        "verified": solution.verified,
    }


def _by_ratio(text: str, latex: bool) -> dict[str, Any]:
    from kovacic.ball.ball import exact
    from kovacic.ball.closed import closed_form_in_roots
    from kovacic.ball.theorems import printed_equations
    from kovacic.errors import InputError

    rho = exact(text, "R/R1")
    if rho == 0:
        raise InputError("R/R1 = 0 has no R1", hint="a plane is --sphere plane, with --mass and --radius")
    if rho <= -1:
        raise InputError(f"the ball doesn't fit inside the sphere: R < |R1| fails, as R/R1 = {rho}")
    twelve, thirteen = printed_equations(rho)
    (S,) = thirteen.coefficients
    solution = closed_form_in_roots(rho)
    data = {
        "ratio": str(rho),
        "equation": twelve.text(),
        "S": str(S),
        # The case and the group don't change when x1 and x2 are carried to 1 and -1.
        **_answer(S.subs({"x1": 1, "x2": -1})),
        "omega_3": str(solution.omega_3),
        "n": str(solution.n),
        "note": "x = cos u; x1, x2 are the roots of D(x) = A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2, two different ones",
    }
    if latex:
        data["latex"] = {str(equation.number): equation.latex() for equation in (twelve, thirteen)}
    return data


def _by_parameters(sphere: BallOnSphere, latex: bool) -> dict[str, Any]:
    from kovacic.ball.closed import closed_form

    solution = closed_form(sphere)
    data: dict[str, Any] = {
        "ratio": str(sphere.ratio),
        "ball": sphere.kind,
        "D": str(sphere.D),
        "equation": sphere.equation(12).text(),
        "S": str(sphere.S),
        **_answer(sphere.S),
        "omega_3": str(solution.omega_3),
        "n": str(solution.n),
        "note": "x = cos u; units are those of the input",
    }
    if latex:
        data["latex"] = {str(number): sphere.equation(number).latex() for number in (7, 11, 12, 13)}
    return data


def _text(data: dict[str, Any]) -> str:
    labels = {
        "ratio": "R/R1",
        "ball": "ball",
        "D": "D(x)",
        "equation": "equation (12)",
        "S": "(13) y'' = S y, S",
        "case": "case",
        "group": "group",
        "omega_3": "omega_3",
        "n": "n",
        "note": "",
    }
    lines = [f"{label + ':' if label else '':<20}{data[key]}" for key, label in labels.items() if key in data]
    for number, formula in data.get("latex", {}).items():
        lines.append(f"{f'({number}) LaTeX:':<20}{formula}")
    if "motion" in data:
        lines += ball_motion.lines(data["motion"])
    return "\n".join(lines)
