"""`kovacic ball`: the equation of a rolling ball, its case and group, its solutions, its motion."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from kovacic.mechanics.ball import BallOnSphere


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
@click.option("--simulate", is_flag=True, help="The motion, by quadratures and by direct integration.")
@click.option(
    "--gravity", metavar="g", default="1", show_default=True, help="Strength of the pull to the sphere's centre."
)
@click.option("--start", nargs=4, type=float, default=(1.0, 0.5, 0.3, 2.0), show_default=True, metavar="u u' v' n")
@click.option("--time", "end", type=click.FloatRange(min=0, min_open=True), default=20.0, show_default=True)
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
    gravity: str,
    start: tuple[float, float, float, float],
    end: float,
    plot: str | None,
) -> None:
    """A ball with an axially symmetric mass distribution that rolls on a sphere.

    Numbers are exact: 3/2, 0.25, 7.  Any consistent units; moments are mass * length^2, angles radians.

    \b
    kovacic ball --ratio 3/2
    kovacic ball --mass 1 --radius 2 --offset 1/5 --A1 1 --A3 4/3 --sphere 3
    kovacic ball --mass 1 --radius 1 --offset 1/5 --A1 1/4 --A3 1/3 --sphere 3 --simulate --plot path.png
    """
    physical = (mass, radius, sphere)
    if ratio is not None:
        if any(value is not None for value in (*physical, a1, a3)) or simulate or plot:
            raise click.UsageError("--ratio stands alone: a mass, moments or a motion need --mass, --radius, --sphere")
        data = _by_ratio(ratio)
    else:
        if mass is None or radius is None or sphere is None:
            raise click.UsageError("either --ratio, or --mass, --radius and --sphere")
        from kovacic.mechanics.ball import Ball, exact

        standard = exact(mass, "m") * exact(radius, "R") ** 2 * exact("2/5", "2/5")
        ball = Ball(m=mass, R=radius, a=offset, A1=standard if a1 is None else a1, A3=standard if a3 is None else a3)
        rolling = ball.on_plane() if sphere == "plane" else ball.on_sphere(sphere)
        data = _by_parameters(rolling, latex)
        if simulate or plot:
            data["motion"] = _simulate(rolling, exact(gravity, "gravity"), start, end, plot)
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


def _by_ratio(text: str) -> dict[str, Any]:
    import sympy as sp

    from kovacic.errors import InputError
    from kovacic.mechanics.ball import exact
    from kovacic.mechanics.decision import normalised
    from kovacic.mechanics.meridian import X
    from kovacic.mechanics.theorems import rational_solutions

    rho = exact(text, "R/R1")
    if rho in (0, -1):
        raise InputError(
            "R/R1 is neither 0 nor -1 (a plane is --sphere plane; a ball that fills its sphere can't roll)"
        )
    x1, x2 = sp.symbols("x1 x2")
    twice = abs(2 * rho)
    if twice.is_integer:
        first, second = rational_solutions(int(twice)).expressions()
        omega_3 = f"c1*{_factor(first)} + c2*{_factor(second)}"
    else:
        omega_3 = (
            f"(c1*(sqrt(x - x1) + sqrt(x - x2))**({2 * rho}) + c2*(sqrt(x - x1) + sqrt(x - x2))**({-2 * rho}))"
            "/sqrt((x - x1)*(x - x2))"
        )
    answer = _answer(normalised(rho).expression())
    k = (1 + 8 * rho**2) / (8 * (x1 - x2))
    S = k / (X - x1) - k / (X - x2) - sp.Rational(3, 16) * ((X - x1) ** -2 + (X - x2) ** -2)
    return {
        "ratio": str(rho),
        "equation": "omega_3'' + 3*(2*x - x1 - x2)/(2*(x - x1)*(x - x2))*omega_3'"
        f" + ({1 - rho**2})/((x - x1)*(x - x2))*omega_3 = 0",
        "S": str(S),
        **answer,
        "omega_3": omega_3,
        "n": f"-(D*omega_3' + ({1 + rho})*D'/2*omega_3)/(({rho})*m*R**2*A1)",
        "note": "x = cos u, ' = d/dx, D = m*R^2*(A3 - A1)*(x - x1)*(x - x2) with two different roots x1, x2",
    }


def _factor(expression: Any) -> str:
    return f"({expression})" if expression.is_Add else str(expression)


def _by_parameters(sphere: BallOnSphere, latex: bool) -> dict[str, Any]:
    from kovacic.mechanics.closed import closed_form

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


def _simulate(
    sphere: BallOnSphere, g: Any, start: tuple[float, float, float, float], end: float, plot: str | None
) -> dict[str, Any]:
    import numpy as np

    from kovacic.mechanics.closed import central_gravity
    from kovacic.mechanics.direct import State
    from kovacic.mechanics.motion import solve_motion
    from kovacic.mechanics.plot import compare, draw

    u, du, dv, n = start
    potential = central_gravity(sphere, g)
    motion = solve_motion(sphere, potential, State(u, 0.0, 0.0, 1.0, 0.0, du, dv, n))
    comparison = compare(sphere, potential, motion, end)
    if plot:
        place = "on the plane" if sphere.R1.is_infinite else f"on the sphere, R/R1 = {sphere.ratio}"
        draw(comparison, plot, title=f"Ball {place}")
    energy = comparison.direct.energy
    return {
        "turning_points": list(motion.turning_points),
        "period": motion.period,
        "time": end,
        "difference": {name: float(error.max()) for name, error in comparison.errors.items()},
        "energy_drift_of_the_direct_integration": float(np.abs(energy - energy[0]).max()),
        "plot": plot,
    }


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
    motion = data.get("motion")
    if motion:
        low, high = motion["turning_points"]
        lines.append(f"{'turning points:':<20}u = {low:.12g} and {high:.12g}")
        lines.append(f"{'period:':<20}{motion['period']:.15g}")
        for name, value in motion["difference"].items():
            lines.append(
                f"{'difference ' + name + ':':<26}{value:.2e} (closed form against DOP853, t <= {motion['time']:g})"
            )
        if motion["plot"]:
            lines.append(f"{'picture:':<20}{motion['plot']}")
    return "\n".join(lines)
