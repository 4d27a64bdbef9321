"""`kovacic ball`: the equation of a rolling ball, the theorems about it, its solutions, its motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from kovacic.cli.options import PICTURE, Command, formats, is_given, refuse
from kovacic.writing.escaped import json_line

if TYPE_CHECKING:
    from kovacic.ball.body import Rolling

#: Points in time at which a motion is sampled: at least, for each oscillation, and at most.
_LEAST_TIMES = 1200
_PER_OSCILLATION = 60
_MOST_TIMES = 60_000
#: `Motion.approach` below which errors above 1e-9 are likely.
_SENSITIVE = 1e-3
#: D for a ball whose constants aren't given.
_GENERAL_D = "A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2"
#: Options that say which force acts.
_FORCE = ("gravity", "potential")


class AnswerRow(NamedTuple):
    """A key of the JSON with its value; its label if it is shown, and its text if that isn't the value itself."""

    key: str
    value: Any
    label: str | None = None
    text: str | None = None

    def lines(self) -> Iterator[str]:
        """The lines for a terminal; none without a label, or for an unknown value."""
        if self.label is None or self.value is None:
            return
        title = f"{self.label}:" if self.label else ""
        text = str(self.value) if self.text is None else self.text
        for line in text.splitlines():
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
    derivation: dict[str, Any] = {}
    if explain:
        from kovacic.ball.derivation import explained, holds

        text = explained(format="latex" if latex else "text")
        derivation = {"derivation": text, "derived": all(holds().values())}
    # Without a ball, --explain is about every one; the other options only choose the output.
    names_a_ball = any(map(is_given, given))
    rows: list[AnswerRow] = []
    motion: list[AnswerRow] = []
    if names_a_ball or not explain:
        if not given["simulate"] and given["plot"] is None:
            refuse({"start", "end", *_FORCE}, "without --simulate or --plot")
        place = _ball_from_options(given)
        rows = _answer(place, latex=latex)
        if given["simulate"] or given["plot"] is not None:
            motion = _simulate(place, given)
    if form == "json":
        data = {**derivation, **{row.key: row.value for row in rows}}
        if motion:
            data["motion"] = {row.key: row.value for row in motion}
        click.echo(json_line(data, default=str))
        return
    if derivation:
        click.echo(f"{derivation['derivation']}\nDerived from the definitions: {derivation['derived']}")
        if rows:
            click.echo()
    for row in (*rows, *motion):
        for line in row.lines():
            click.echo(line)


def _ball_from_options(given: Mapping[str, Any]) -> Rolling:
    """The ball of these options; raises `click.UsageError` for options that don't belong together."""
    from kovacic.ball import RollingBall
    from kovacic.ball.body import InRoots, exact_quantity
    from kovacic.ball.theorems import read_ratio

    if given["ratio"] is not None:
        refuse({"offset"}, "with --ratio")
        if given["simulate"] or any(
            given[name] is not None for name in ("mass", "radius", "sphere", "a1", "a3", "plot")
        ):
            raise click.UsageError("--ratio stands alone: a mass, moments or a motion need --mass, --radius, --sphere")
        return InRoots(read_ratio(given["ratio"]))
    if any(given[name] is None for name in ("mass", "radius", "sphere")):
        raise click.UsageError("either --ratio, or --mass, --radius and --sphere")
    if all(given[name] is not None for name in _FORCE):
        raise click.UsageError("either --gravity or --potential")
    moments = [given["a1"], given["a3"]]
    if exact_quantity(given["offset"], "a") != 0 and None in moments:
        raise click.UsageError("a ball with --offset isn't homogeneous: give its moments too, --A1 and --A3")
    homogeneous = exact_quantity(given["mass"], "m") * exact_quantity(given["radius"], "R") ** 2 * 2 / 5
    A1, A3 = (homogeneous if moment is None else moment for moment in moments)
    ball = RollingBall(m=given["mass"], R=given["radius"], a=given["offset"], A1=A1, A3=A3)
    return ball.on_plane() if given["sphere"] == "plane" else ball.on_sphere(given["sphere"])


def _answer(place: Rolling, *, latex: bool) -> list[AnswerRow]:
    """The verdicts of the theorems and of the engine, and the closed form with its check."""
    import kovacic
    from kovacic.ball import BallOnSphere, closed_form
    from kovacic.ball.derivation import equations_of
    from kovacic.ball.theorems import ball_theorem
    from kovacic.solution.conditions import conditions
    from kovacic.writing.breaking import breakable

    # In the roots, the case and the group don't change when x1 and x2 are carried to 1 and -1.
    solution = kovacic.solve(place.S.subs({"x1": 1, "x2": -1}), var="x")
    form = closed_form(place)
    equations = equations_of(place)
    said, case = ball_theorem(place)
    group = solution.group and solution.group.name
    is_generic = bool(place.ratio.free_symbols)
    generic = " for generic values" if is_generic else ""

    def short(value: Any) -> str:
        """A formula with E and D in place of the polynomials that were shown under these names."""
        text = str(value)
        for name, polynomial in (("E", form.E), ("D", place.D)):
            text = text.replace(f"({polynomial})**", f"{name}**").replace(f"({polynomial})", f"({name})")
        return text

    N = 2 * place.ratio
    rows = [
        AnswerRow("ratio", place.ratio, "R/R1"),
        AnswerRow("N", N, "N = 2R/R1", f"{N}, not an integer" if case == 2 else None),
    ]
    note = f"x = cos u; x1, x2 are the roots of D(x) = {_GENERAL_D}, two different ones"
    if isinstance(place, BallOnSphere):
        note = "x = cos u; units are those of the input"
        rows += [
            AnswerRow("ball", place.kind, "ball"),
            AnswerRow("D", place.D, "D(x)"),
            AnswerRow("roots", ", ".join(map(str, place.roots)), "x1, x2"),
        ]
    rows.append(AnswerRow("theorem", said, "theorem"))
    if is_generic:
        lines = [line.strip() for line in str(conditions(place.S, var="x")).splitlines()[1:]]
        rows.append(AnswerRow("conditions", lines, "by the engine", "\n".join(lines)))
    rows += [
        AnswerRow("equation", equations["12"].text, "equation (12)"),
        AnswerRow("S", place.S, "(13) y'' = S y, S"),
        AnswerRow("status", solution.status.value),
        AnswerRow("case", solution.case, "case", f"{solution.case}{generic}"),
        AnswerRow("omega", list(map(str, form.omega)), "omega(x) = y'/y", "\n".join(map(short, form.omega))),
    ]
    if form.E:
        rows.append(AnswerRow("E", form.E, "E(x)"))
    rows += [AnswerRow(name, getattr(form, name), name, short(getattr(form, name))) for name in ("y", "omega_3", "n")]
    rows += [
        AnswerRow("group", group, "group", f"{group}{generic}"),
        AnswerRow("verified", solution.verified and form.solves(place), "verified"),
        AnswerRow("note", note, ""),
    ]
    if latex:
        formulas = {name: breakable(math.latex) for name, math in equations.items()}
        shown = "\n".join(f"({name}) {formula}" for name, formula in formulas.items())
        rows.append(AnswerRow("latex", formulas, "LaTeX", shown))
    return rows


def _simulate(sphere: Any, given: Mapping[str, Any]) -> list[AnswerRow]:
    """The motion from the start to the end under the given force, and its picture."""
    from kovacic.errors import InputError, needs

    with needs("numeric", "a motion"):
        import numpy as np

        from kovacic.ball.motion import MotionStart, as_float, solve_motion
        from kovacic.ball.picture import draw

    time = as_float(given["end"], "the time")
    if time <= 0:
        raise InputError(f"the time must be positive, not {time:g}")
    motion = solve_motion(sphere, MotionStart(*given["start"]), **{name: given[name] for name in _FORCE})
    samples = _LEAST_TIMES + int(_PER_OSCILLATION * time / (motion.period or np.inf))
    times = np.linspace(0.0, time, min(_MOST_TIMES, samples))
    if given["plot"]:
        with needs("plot", "a picture"):
            draw(motion, times, given["plot"], title=f"R/R1 = {sphere.ratio}")
    low, high = motion.turning_points
    x, y, z = contact = (motion.contact(time) + 0.0).tolist()
    difference = {name: float(np.abs(error).max()) for name, error in motion.defects(times).items()}
    errors = f"omega_3 {difference['omega_3']:.2e}, n {difference['n']:.2e}"
    drift = float(np.ptp(motion.energy(times)))
    turning = ("turning points", f"u = {low:.12g} and {high:.12g}")
    if low == high:
        turning = ("steady motion", f"u = {low:.12g} stays constant")
    reaction = motion.reaction(times)
    least = None if reaction is None else float(reaction.min())
    pulled = None if reaction is None or reaction.min() >= 0 else float(times[reaction < 0][0])
    held = "on it has to pull at times: a free ball leaves the surface there, this one is held"
    determined = motion.determined if np.isfinite(motion.determined) else None
    lost = f"digits are lost: it comes as near as {motion.approach:.1g} to an unstable steady motion"
    return [
        AnswerRow("potential", motion.force.V, "potential", f"V = {motion.force.V}"),
        AnswerRow("turning_points", (low, high), *turning),
        AnswerRow("period", motion.period, "period", f"{motion.period or 0:.15g}"),
        AnswerRow("time", time),
        AnswerRow("contact", contact, "contact point", f"({x:.12g}, {y:.12g}, {z:.12g}) at the end"),
        AnswerRow("least_reaction", least, "normal reaction", f"at least {least or 0:.6g} (t <= {time:g})"),
        AnswerRow("pulled_from", pulled, "", f"from t = {pulled or 0:.6g} {held}"),
        AnswerRow("difference", difference, "difference", f"{errors}: closed form against the integrated motion"),
        AnswerRow("energy_drift", drift, "energy drift", f"{drift:.2e}"),
        AnswerRow(
            "determined", determined, "asymptotic", f"the digits of this motion last until t = {motion.determined:.6g}"
        ),
        AnswerRow("approach", motion.approach, "", lost if motion.approach < _SENSITIVE else ""),
        AnswerRow("plot", given["plot"] and str(given["plot"]), "picture"),
    ]
