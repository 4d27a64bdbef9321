"""`kovacic ball`: the equation of a rolling ball, what the theorems say about it, its solutions, its motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from click.core import ParameterSource

from kovacic.cli.options import PICTURE, Command, formats, refuse
from kovacic.shown import json_line

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.ball import BallOnSphere
    from kovacic.ball.body import Rolling

#: Points in time at which a motion is looked at: so many, and so many more for each oscillation, up to a limit.
_SAMPLES = 1200
_PER_OSCILLATION = 60
_MOST = 60_000
#: Of `Motion.approach`: below it, errors above 1e-9 are likely.
_SENSITIVE = 1e-3
#: What is said of a motion, with the value in it.
_TURNING = "turning points", "u = {0[0]:.12g} and {0[1]:.12g}"
_STEADY = "steady motion", "u = {0[0]:.12g} stays constant"
_CONTACT = "({0[0]:.12g}, {0[1]:.12g}, {0[2]:.12g}) at the end"
_PULLED = "from t = {:.6g} on it has to pull at times: a free ball leaves the surface there, this one is held"
_DIFFERENCE = "omega_3 {0[omega_3]:.2e}, n {0[n]:.2e}: closed form against the integrated motion"
_DETERMINED = "the digits of this motion last until t = {:.6g}"
_LOST = "digits are lost: it comes as near as {:.1g} to an unstable steady motion"
#: D for a ball whose constants aren't given.
_D = "A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2"
#: Options that say which force acts.
_FORCE = ("gravity", "potential")


class AnswerRow(NamedTuple):
    """A key of the JSON and its value; where it is shown, its label, and as a template what is said: the value itself."""

    key: str
    value: Any
    label: str | None = None
    template: str = "{}"

    def lines(self) -> Iterator[str]:
        """What is shown; nothing without a label, or for an unknown value."""
        if self.label is None or self.value is None:
            return
        title = f"{self.label}:" if self.label else ""
        for line in self.template.format(self.value).splitlines():
            yield f"{title:<20}{line}"
            title = ""


@click.command(cls=Command)
@click.option("--ratio", metavar="R/R1", help="R/R1 alone, a number or a name: all in x1, x2, the roots of D.")
@click.option("--mass", metavar="M", help="The ball's mass.")
@click.option("--radius", metavar="R", help="The ball's radius.")
@click.option("--offset", metavar="a", default="0", show_default=True, help="Centre of mass to centre, along the axis.")
@click.option("--A1", "a1", metavar="A1", help="The moment of inertia A1 = A2 (default: homogeneous, 2/5 m R^2).")
@click.option("--A3", "a3", metavar="A3", help="The moment of inertia about the axis (default: 2/5 m R^2).")
@click.option("--sphere", metavar="R1", help='The sphere\'s radius (negative: rolling inside), or "plane".')
@formats(json="One JSON object.")
@click.option("--latex", is_flag=True, help="The equations in LaTeX, for $...$.")
@click.option(
    "--explain",
    is_flag=True,
    help="The equations (1) to (13) of the paper, derived; alone: for every ball.",
)
@click.option("--simulate", is_flag=True, help="The motion: turning points, period, path, reaction.")
@click.option("--gravity", metavar="g", help="Strength of the force that presses the ball to the surface (default: 1).")
@click.option("--potential", metavar="V", help='A potential in place of gravity, such as "3/2*cos(u) + sin(u)^2".')
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
def ball(form: str, latex: bool, explain: bool, **given: Any) -> None:
    """A ball with an axially symmetric mass distribution that rolls on a sphere.

    Numbers are exact: 3/2, 0.25, sqrt(2), and only the motion is computed in floating point.  Any consistent units; moments
    are mass * length^2, angles radians.  A potential is a function of cos(u), u being the angle between the ball's axis and
    the normal at the contact; a uniform field over a sphere isn't one.

    \b
    kovacic ball --explain
    kovacic ball --ratio 3/2
    kovacic ball --mass 1 --radius 2 --offset 1/5 --A1 1 --A3 4/3 --sphere 3
    kovacic ball --mass 1 --radius 1 --sphere 3 --explain
    kovacic ball --mass 1 --radius 1 --sphere 3 --simulate --plot path.png
    """
    if explain and not _names_a_ball():
        _explain_all(as_json=form == "json", latex=latex)
        return
    if not given["simulate"] and given["plot"] is None:
        refuse({"start", "end", *_FORCE}, "without --simulate or --plot")
    place = _place(given)
    rows = _answer(place, latex=latex)
    motion: list[AnswerRow] = []
    if given["simulate"] or given["plot"] is not None:
        force = {name: given[name] for name in _FORCE}
        motion = _simulate(place, start=given["start"], end=given["end"], plot=given["plot"], **force)
    derivation = _derivation(latex=latex) if explain else {}
    if form == "json":
        data = {**derivation, **_in_json(rows)}
        if motion:
            data["motion"] = _in_json(motion)
        click.echo(json_line(data, default=str))
        return
    if derivation:
        _print_derivation(derivation)
        click.echo()
    for row in (*rows, *motion):
        for line in row.lines():
            click.echo(line)


def _in_json(rows: list[AnswerRow]) -> dict[str, Any]:
    return {row.key: row.value for row in rows}


def _names_a_ball() -> bool:
    """Does an option say which ball, or ask for its motion?  The others only say how the answer is shown."""
    context = click.get_current_context()
    given = {name for name in context.params if context.get_parameter_source(name) is ParameterSource.COMMANDLINE}
    return not given <= {"explain", "latex", "as_json"}


def _derivation(*, latex: bool) -> dict[str, Any]:
    """The paper's equations for all balls, as text or LaTeX, and whether each of them was derived."""
    from kovacic.ball.derivation import holds
    from kovacic.ball.paper import explained

    form = "latex" if latex else "text"
    text = explained(format=form)
    return {"derivation": text, "derived": all(holds().values())}


def _print_derivation(derivation: dict[str, Any]) -> None:
    click.echo(f"{derivation['derivation']}\nDerived from the definitions: {derivation['derived']}")


def _explain_all(*, as_json: bool, latex: bool) -> None:
    """`kovacic ball --explain` alone: what holds for every ball."""
    derivation = _derivation(latex=latex)
    if as_json:
        click.echo(json_line(derivation))
    else:
        _print_derivation(derivation)


def _place(given: Mapping[str, Any]) -> Rolling:
    """The ball that is meant; raises `click.UsageError` for options that don't belong together."""
    from kovacic.ball import RollingBall
    from kovacic.ball.body import InRoots
    from kovacic.ball.theorems import read_ratio

    if given["ratio"] is not None:
        _demand_ratio_alone(given)
        return InRoots(read_ratio(given["ratio"]))
    if any(given[name] is None for name in ("mass", "radius", "sphere")):
        raise click.UsageError("either --ratio, or --mass, --radius and --sphere")
    if all(given[name] is not None for name in _FORCE):
        raise click.UsageError("either --gravity or --potential")
    ball = RollingBall(m=given["mass"], R=given["radius"], a=given["offset"], **_moments(given))
    return ball.on_plane() if given["sphere"] == "plane" else ball.on_sphere(given["sphere"])


def _demand_ratio_alone(given: Mapping[str, Any]) -> None:
    """R/R1 says nothing of moments or of a motion."""
    refuse({"offset"}, "with --ratio")
    is_alone = all(given[name] is None for name in ("mass", "radius", "sphere", "a1", "a3", "plot"))
    if given["simulate"] or not is_alone:
        raise click.UsageError("--ratio stands alone: a mass, moments or a motion need --mass, --radius, --sphere")


def _moments(given: Mapping[str, Any]) -> dict[str, Any]:
    """The moments of inertia A1 and A3; by default those of a homogeneous ball, if the ball can be one."""
    from kovacic.ball.body import exact

    found = {"A1": given["a1"], "A3": given["a3"]}
    if exact(given["offset"], "a") != 0 and None in found.values():
        raise click.UsageError("a ball with --offset isn't homogeneous: give its moments too, --A1 and --A3")
    of_homogeneous_ball = exact(given["mass"], "m") * exact(given["radius"], "R") ** 2 * 2 / 5
    for name, moment in found.items():
        if moment is None:
            found[name] = of_homogeneous_ball
    return found


def _answer(place: Rolling, *, latex: bool) -> list[AnswerRow]:
    """What the theorems and the engine say, and the closed form, which is checked."""
    import kovacic
    from kovacic.ball import BallOnSphere, closed_form
    from kovacic.ball.paper import equations_of
    from kovacic.ball.theorems import theorem
    from kovacic.writing.breaking import breakable

    # In the roots, the case and the group don't change when x1 and x2 are carried to 1 and -1.
    solution = kovacic.solve(place.S.subs({"x1": 1, "x2": -1}), var="x")
    form = closed_form(place)
    equations = equations_of(place)
    said, case = theorem(place)
    generic = "{} for generic values" if place.ratio.free_symbols else "{}"
    N = "{}, not an integer" if case == 2 else "{}"
    short = partial(_abbreviated, polynomials={"E": form.E, "D": place.D})
    rows = [AnswerRow("ratio", place.ratio, "R/R1"), AnswerRow("N", 2 * place.ratio, "N = 2R/R1", N)]
    note = f"x = cos u; x1, x2 are the roots of D(x) = {_D}, two different ones"
    if isinstance(place, BallOnSphere):
        note = "x = cos u; units are those of the input"
        rows += _about_the_ball(place)
    rows.append(AnswerRow("theorem", said, "theorem"))
    if place.ratio.free_symbols:
        lines = _conditions(place)
        rows.append(AnswerRow("conditions", lines, "by the engine", _as_is("\n".join(lines))))
    rows += [
        AnswerRow("equation", equations["12"].text, "equation (12)"),
        AnswerRow("S", place.S, "(13) y'' = S y, S"),
        AnswerRow("status", solution.status.value),
        AnswerRow("case", solution.case, "case", generic),
        AnswerRow("omega", list(map(str, form.omega)), "omega(x) = y'/y", _as_is("\n".join(map(short, form.omega)))),
    ]
    if form.E:
        rows.append(AnswerRow("E", form.E, "E(x)"))
    for name in ("y", "omega_3", "n"):
        found = getattr(form, name)
        rows.append(AnswerRow(name, found, name, _as_is(short(found))))
    rows += [
        AnswerRow("group", solution.group and solution.group.name, "group", generic),
        AnswerRow("verified", solution.verified and form.solves(place), "verified"),
        AnswerRow("note", note, ""),
    ]
    if latex:
        formulas = {name: breakable(math.latex) for name, math in equations.items()}
        shown = "\n".join(f"({name}) {formula}" for name, formula in formulas.items())
        rows.append(AnswerRow("latex", formulas, "LaTeX", _as_is(shown)))
    return rows


def _abbreviated(value: Any, *, polynomials: Mapping[str, Any]) -> str:
    """A formula with the names of polynomials that were shown in their places."""
    text = str(value)
    for name, polynomial in polynomials.items():
        whole = f"({polynomial})"
        text = text.replace(f"{whole}**", f"{name}**").replace(whole, f"({name})")
    return text


def _about_the_ball(place: BallOnSphere) -> list[AnswerRow]:
    """Which ball it is, and its polynomial D with the roots."""
    return [
        AnswerRow("ball", place.kind, "ball"),
        AnswerRow("D", place.D, "D(x)"),
        AnswerRow("roots", ", ".join(map(str, place.roots)), "x1, x2"),
    ]


def _conditions(place: Rolling) -> list[str]:
    """For which ratios there are solutions, line by line."""
    from kovacic.parameters import conditions

    _, *lines = str(conditions(place.S, var="x")).splitlines()
    return [line.strip() for line in lines]


def _as_is(text: str) -> str:
    """A template for this text, braces and all."""
    return text.replace("{", "{{").replace("}", "}}")


def _simulate(
    sphere: Any, *, start: Sequence[str], end: str, plot: Path | None, **force: str | None
) -> list[AnswerRow]:
    """The motion from `start` = (u, u', v', n) up to the time `end`, `force` being `gravity` or `potential`; the picture."""
    from kovacic.errors import InputError, needs

    with needs("numeric", "a motion"):
        import numpy as np

        from kovacic.ball.dynamics import as_float
        from kovacic.ball.motion import State, solve_motion
        from kovacic.ball.picture import draw

    time = as_float(end, "the time")
    if time <= 0:
        raise InputError(f"the time must be positive, not {time:g}")
    motion = solve_motion(sphere, State(*start), **force)
    samples = _SAMPLES + int(_PER_OSCILLATION * time / (motion.period or np.inf))
    times = np.linspace(0.0, time, min(_MOST, samples))
    if plot:
        with needs("plot", "a picture"):
            draw(motion, times, plot, title=f"R/R1 = {sphere.ratio}")
    reaction = motion.reaction(times)
    least = None
    pulled = None
    if reaction is not None:
        least = float(reaction.min())
        if least < 0:
            pulled = float(times[reaction < 0][0])
    difference = {name: float(np.abs(error).max()) for name, error in motion.defects(times).items()}
    low, high = motion.turning_points
    said = _STEADY if low == high else _TURNING
    determined = motion.determined if np.isfinite(motion.determined) else None
    lost = _LOST if motion.approach < _SENSITIVE else ""
    return [
        AnswerRow("potential", motion.force.V, "potential", "V = {}"),
        AnswerRow("turning_points", motion.turning_points, *said),
        AnswerRow("period", motion.period, "period", "{:.15g}"),
        AnswerRow("time", time),
        AnswerRow("contact", (motion.contact(time) + 0.0).tolist(), "contact point", _CONTACT),
        AnswerRow("least_reaction", least, "normal reaction", f"at least {{:.6g}} (t <= {time:g})"),
        AnswerRow("pulled_from", pulled, "", _PULLED),
        AnswerRow("difference", difference, "difference", _DIFFERENCE),
        AnswerRow("energy_drift", float(np.ptp(motion.energy(times))), "energy drift", "{:.2e}"),
        AnswerRow("determined", determined, "asymptotic", _DETERMINED),
        AnswerRow("approach", motion.approach, "", lost),
        AnswerRow("plot", plot and str(plot), "picture"),
    ]
