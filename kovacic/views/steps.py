"""The paper's own steps, written out: the poles, the necessary conditions, and steps 1 to 3 case by case.

`kovacic.engine.paper` carries them out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

from sympy import Add, Symbol, sqrt

from kovacic.algebra.function_field import FunctionPoly
from kovacic.answer import Answer
from kovacic.decision import Status
from kovacic.engine.families import SingularPoint, natural
from kovacic.engine.paper import Family, Search, in_sympy, search
from kovacic.engine.places import Kind, Place, Problem, analyse
from kovacic.equation import parameters_of
from kovacic.limits import Budget, check_time
from kovacic.numbers.numerals import as_text
from kovacic.views.sentences import formulas_of
from kovacic.writing.document import SCREEN_LINES, Block, Formula, Heading, Sentence, Table, say
from kovacic.writing.formula import Math, free_name, latex_text, of_sympy, separated

# d from the chosen exponents, and the equations for P, by case [Kovacic 1986, sections 3.1, 4.1 and 5.1].
_DEGREE_OF_P = {
    1: Math("alpha_inf - sum alpha_c", r"\alpha_\infty - \sum_c \alpha_c"),
    2: Math("(e_inf - sum e_c)/2", r"\tfrac{1}{2}\left(e_\infty - \sum_c e_c\right)"),
    3: Math("n/12 (e_inf - sum e_c)", r"\tfrac{n}{12}\left(e_\infty - \sum_c e_c\right)"),
}
_EQUATIONS = {
    1: [Math("P'' + 2 theta P' + (theta' + theta^2 - S) P = 0",
             r"P'' + 2 \theta P' + \left(\theta' + \theta^{2} - S\right) P = 0")],
    2: [Math("P''' + 3 theta P'' + (3 theta^2 + 3 theta' - 4 S) P'"
             "\n + (theta'' + 3 theta theta' + theta^3 - 4 S theta - 2 S') P = 0",
             r"P''' + 3 \theta P'' + \left(3 \theta^{2} + 3 \theta' - 4 S\right) P'"
             r" + \left(\theta'' + 3 \theta \theta' + \theta^{3} - 4 S \theta - 2 S'\right) P = 0")],
    3: [Math("P_n = -P,  P_(-1) = 0,  D = product of the x - c",
             r"P_n = -P, \quad P_{-1} = 0, \quad D = \prod_c (x - c)"),
        Math("P_(i-1) = -D P_i' + ((n-i) D' - D theta) P_i - (n-i)(i+1) D^2 S P_(i+1)",
             r"P_{i-1} = -D P_i' + \left((n-i) D' - D \theta\right) P_i - (n-i)(i+1) D^{2} S P_{i+1}")],
}  # fmt: skip
_CONDITIONS = {
    1: "every pole has order 1 or an even order; at infinity the order is even or > 2",
    2: "some pole has order 2 or an odd order > 2",
    3: "no pole has an order > 2; at infinity the order is >= 2; every Delta is rational",
}
_LOCAL_TYPES = {
    Kind.ORDINARY: "ordinary",
    Kind.REGULAR: "regular",
    Kind.UNRAMIFIED: "irregular",
    Kind.RAMIFIED: "irregular, ramified",
}


class Steps:
    """The paper's steps for one answer, as blocks."""

    def __init__(self, answer: Answer) -> None:
        self.answer = answer
        self.formulas = formulas_of(answer)

    @cached_property
    def problem(self) -> Problem:
        """The equation with its local data."""
        return analyse(self.answer.S, Budget())

    @property
    def places(self) -> tuple[Place, ...]:
        return self.problem.places

    def local_data(self) -> Iterator[Block]:
        yield Heading("Poles and local exponents")
        x = self.answer.variable
        taken = {x, *parameters_of(self.answer.S.field)}
        b, c = (free_name(taken, *names) for names in (("b", "s", "r"), ("c", "p", "q")))
        yield say(
            "At a pole of order 2, ",
            Math(f"S = {b}/({x} - {c})^2 + ...", rf"S = \frac{{{b}}}{{({latex_text(x)} - {c})^2}} + \dots"),
            ", the local solutions have exponents with the difference ",
            Math(f"Delta = sqrt(1 + 4{b})", rf"\Delta = \sqrt{{1 + 4 {b}}}"),
            ". Conjugate poles stay together.",
        )
        rows: list[list[Sentence]] = []
        for place in self.places:
            order = str(place.order)
            if place.at_infinity:  # the order of S itself; k = 4 - order is that of the place
                order = str(-self.answer.S.degree) if self.answer.S else "-"
            kind = _LOCAL_TYPES[place.kind] + (", logarithm" if place.logarithm else "")
            rows.append([self.formulas.place(str(place)), str(place.degree), order, kind, self._delta(place)])
        yield Table(("place", "points", "order", "local type", "Delta"), rows)

    def _delta(self, place: Place) -> str | Math:
        """The exponent difference at a regular point: a rational number, or a square root of a constant."""
        if place.kind is not Kind.REGULAR:
            return "-"
        if place.delta is not None:
            return as_text(place.delta)
        square = place.delta_squared
        if square is None:
            return "not rational"
        outer, inner = square.square_part() if isinstance(square, FunctionPoly) else (1, square)
        return of_sympy(in_sympy(outer, self.x) * sqrt(in_sympy(inner, self.x)))

    def necessary(self) -> Iterator[Block]:
        yield Heading("Kovacic's necessary conditions (section 2.1)")
        rows: list[list[Sentence]] = []
        for case, condition in _CONDITIONS.items():
            # The condition of case 2 has to hold at some pole only; the others fail at certain places.
            failing = [place for place in self.places if case != 2 and not _allowed(case, [place])]
            places = separated(", ", (self.formulas.place(str(place)) for place in failing))
            verdict = "holds" if _allowed(case, self.places) else "fails"
            rows.append([str(case), condition, [verdict + " at " * bool(failing), *places]])
        yield Table(("case", "condition", "verdict"), rows)

    def search(self) -> Iterator[Block]:
        """The paper's steps 1 to 3, case by case, up to the one that succeeds."""
        answer = self.answer
        if answer.status is Status.UNDECIDED:
            return
        degree = 12 if answer.riccati is None else answer.riccati.degree
        for m in (1, 2, 4, 6, 12):
            case = min(m, 3)
            if m <= degree and _allowed(case, self.places):
                which = f"Case 3, n = {m}" if case == 3 else f"Case {case}"
                yield Heading(f"{which}: Kovacic's steps")
                yield from self._steps(search(self.problem, answer.variable, m), case)

    def _steps(self, found: Search | None, case: int) -> Iterator[Block]:
        """Steps 1 to 3 of one case, as far as they can be written out."""
        if found is None:
            yield say(
                "The steps are written out only for exponents that are square roots, constants of low degree, "
                "and poles of low order."
            )
            return
        yield self._exponents(found, case)
        yield self._counted(found, case)
        if found.families is None:
            yield say(
                "There are too many to be listed; the engine finds omega, or proves that there is none, without them."
            )
            return
        yield from self._families(found, found.families)
        yield from self._trials(found, found.families, case)

    def _exponents(self, search: Search, case: int) -> Table:
        """Step 1: at each point the singular part of sqrt(S), alpha+ and alpha- in case 1, or else the set E of exponents."""
        rows: list[list[Sentence]] = []
        for point, choices in zip(search.points, search.choices, strict=True):
            values = [self._shown(choice.value) for choice in choices]
            if case == 1:
                t = self.x if point.at is None else self.x - in_sympy(point.at, self.x)
                singular = Add(*(in_sympy(c, self.x) * t**power for power, c in choices[0].singular))
                # alpha+ comes first; if both are equal there is a single choice.
                rows.append([self._point(point), self._shown(singular), values[0], values[-1]])
            else:
                inside = ", ".join(value.text for value in values)
                rows.append([self._point(point), Math(f"{{{inside}}}", rf"\{{{inside}\}}")])
        names = Math("[sqrt S]", r"[\sqrt{S}]"), Math("alpha+", r"\alpha^+"), Math("alpha-", r"\alpha^-")
        return Table(("place", *(names if case == 1 else [Math.of("E")])), rows)

    def _counted(self, search: Search, case: int) -> Block:
        """Step 2: the number of families of exponents, and of those with a natural number d."""
        count = f"{search.total} {'family' if search.total == 1 else 'families'} of exponents"
        if search.natural is not None:
            count += f", {self.d} is a natural number in {search.natural or 'none'} of them" + " (with an odd e)" * (
                case == 2
            )
        if parameters_of(self.formulas.field):
            count += " for generic parameters"
        return say("Step 2: ", self.degree(case), f"; {count}.")

    def _families(self, search: Search, families: Sequence[Family]) -> Iterator[Block]:
        """The exponents of each, d, and P if there is one."""
        if not search.complete:
            yield say("Of conjugate poles, only families with equal exponents are listed.")
        rows: list[list[Sentence]] = []
        for family in families[:SCREEN_LINES]:
            outcome: str | Math = ""
            if family.P is not None:
                outcome = self._shown(family.P)
            elif family.theta is not None:
                outcome = "none"
            elif natural(family.d) is not None:
                outcome = "not tried"
            values = [self._shown(choice.value) for choice in family.choices]
            rows.append([*values, self._shown(family.d), outcome])
        if rows:
            yield Table([*map(self._point, search.points), Math.of(self.d), Math.of(self.P)], rows)
        if len(families) > SCREEN_LINES:
            yield say(f"and {len(families) - SCREEN_LINES} more.")

    def _trials(self, search: Search, families: Sequence[Family], case: int) -> Iterator[Block]:
        """Step 3."""
        tried = [family for family in families if family.theta is not None]
        if search.natural and not tried:
            yield say("Step 3 isn't written out: it would take too long, or too many square roots at once.")
        if tried:
            yield say(f"Step 3: {self.P} of degree {self.d}, with")
            for equation in _EQUATIONS[case]:
                yield Formula(Math(equation.text.replace("P", self.P), equation.latex.replace("P", self.P)))
        for family in tried[-SCREEN_LINES:]:
            yield from self._trial(family)

    @property
    def x(self) -> Any:
        return Symbol(self.answer.variable)

    @property
    def d(self) -> str:
        """Kovacic's d, under another name where this is a parameter; likewise `P`."""
        return free_name(parameters_of(self.answer.S.field), "d", "N", "M")

    @property
    def P(self) -> str:
        return free_name(parameters_of(self.answer.S.field), "P", "Q", "R")

    def degree(self, case: int) -> Math:
        """d = ..., from the chosen exponents."""
        return Math.of(self.d).equals(_DEGREE_OF_P[case])

    def _shown(self, value: Any) -> Math:
        check_time()
        return of_sympy(in_sympy(value, self.x)).shortened

    def _point(self, point: SingularPoint) -> Math:
        if point.at is None:
            return self.formulas.place(str(point.place))
        return Math.of(self.answer.variable).equals(self._shown(point.at))

    def _trial(self, family: Family) -> Iterator[Block]:
        d = natural(family.d)
        assert d is not None  # only such families were tried
        yield Formula(Math.of("theta").equals(self._shown(family.theta)))
        # A coefficient without unknowns is a number, and not 0: it excludes P at once.
        unknowns = set(family.unknowns)
        impossible = next((value for value in family.conditions if not unknowns & value.free_symbols), None)
        conditions = [self._shown(condition) for condition in family.conditions[:6]]
        found: list[str | Math] = ["no solution, for "]
        if family.P is not None:
            found = [Math.of(self.P).equals(self._shown(family.P)), " is a solution"]
        elif impossible is not None:
            found += ["a coefficient is ", self._shown(impossible), ", which isn't 0"]
        elif conditions:
            noun = "coefficients" if d > 1 else "coefficient"
            text = ", ".join(f"{value.text} = 0" for value in conditions)
            latex = r",\; ".join(f"{value.latex} = 0" for value in conditions)
            found += [
                f"the lower {noun} {', '.join(map(str, family.unknowns))} of {self.P} would satisfy ",
                Math(text, latex),
            ]
        else:
            found.append(f"the linear system for its {d + 1} coefficients has rank {d + 1}")
        yield say(f"{self.d} = {d}: ", *found, ".")


def _allowed(case: int, places: Sequence[Place]) -> bool:
    """The necessary conditions, `_CONDITIONS`; that of case 2 has to hold at some pole only."""
    if case == 1:
        return all(place.kind is not Kind.RAMIFIED for place in places)
    if case == 2:
        return any(p.order == 2 or p.kind is Kind.RAMIFIED for p in places if not p.at_infinity)
    # S has the order 4 - k at infinity, k the order of the place: k <= 2 says that it is at least 2.
    return all(p.order <= 2 and p.delta is not None for p in places if p.order > 0)
