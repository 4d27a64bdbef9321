"""What `kovacic.conditions` returns: the regions of parameter space, their views, and the check against the engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from random import Random
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Status
from kovacic.engine.decide import decide
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import Budget, Limits
from kovacic.parametric import sampling
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions
from kovacic.parametric.formulas import as_latex, shown
from kovacic.parametric.regions import Verdict
from kovacic.parametric.restriction import UndefinedError, at_point
from kovacic.parametric.slices import NO_CONSTANT
from kovacic.parametric.statements import Point, Statement
from kovacic.reading.read import read_input
from kovacic.solution import Solution


@dataclass(frozen=True)
class Condition:
    """One region: where `statement` holds and no earlier region's.

    `case` is Kovacic's case (None: no Liouvillian solution), `group` the family of the Galois group, `complete` True or what
    isn't proven, `defined` False where S isn't defined, `omega` what becomes possible.
    """

    statement: Statement
    verdict: Verdict
    complete: bool | str
    defined: bool
    omega: str | None

    @property
    def case(self) -> int | None:
        return self.verdict.case

    @property
    def group(self) -> str:
        return self.verdict.group if self.defined else "S isn't defined"

    def __str__(self) -> str:
        if not self.defined:
            return f"{self.statement.text()}: S isn't defined"
        known = "" if self.complete is True else f" [{self.complete}]"
        return f"{self.statement.text()}: {_case_text(self.verdict)}{known}"


@dataclass(frozen=True)
class Disagreement:
    """A point at which a region and the engine differ."""

    point: str
    predicted: int | None
    found: int | None


@dataclass(frozen=True)
class CheckReport:
    """The outcome of `Conditions.check`: true when every sample agrees.

    `inside` and `outside` count the points that were solved in a special region and in the generic one; `open` those for
    which the regions claim nothing.
    """

    inside: int
    outside: int
    open: int
    disagreements: tuple[Disagreement, ...]

    def __bool__(self) -> bool:
        return not self.disagreements


@dataclass(frozen=True)
class Conditions:
    """The partition of parameter space for y'' = S y: frozen and picklable.

    `generic` holds where no region's statement does; the regions are tried in their order.  `complete` is True where the
    list is proven to be complete, else a sentence such as "up to degree 12 (...)".  All of it holds for values with the
    `assumptions`.  `constant` is the value of the algebraic constant in S, which is a parameter of `S` here.
    """

    S: RatFunc
    variable: str
    parameters: tuple[str, ...]
    generic: Verdict
    regions: tuple[Condition, ...]
    complete: bool | str
    theory: str
    limits: Limits
    notices: tuple[str, ...] = ()
    assumptions: Assumptions = NOTHING_ASSUMED
    constant: Point = NO_CONSTANT

    @property
    def within_limits(self) -> bool:
        """Was everything examined up to `max_degree`, without reaching a limit of time?"""
        return self.complete is True or not str(self.complete).startswith("only as far")

    def region_at(self, values: Mapping[Any, Any]) -> Condition | None:
        """The region that contains a point; None for the generic one."""
        point = self.point(values)
        return next((region for region in self.regions if region.statement.holds(point)), None)

    def case_at(self, values: Mapping[Any, Any]) -> int | None:
        """The case at a point with rational or algebraic coordinates: {"n": Fraction(3, 2)}, {n: sqrt(2)}.

        Where the regions claim nothing (see `complete`) the equation is decided there.  Raises `InputError` where S isn't
        defined, or a parameter has no value.
        """
        return self._case(self.point(values))

    def _case(self, point: Point) -> int | None:
        verdict = self.predicted(point)
        if verdict is None:
            raise InputError(f"S isn't defined at {point}")
        if verdict.known:
            return verdict.case
        decision = decide(at_point(self.S, point), Budget(self.limits), certify=False)
        if decision.status is Status.UNDECIDED:
            raise LimitExceeded(str(decision.undecided), limit="seconds")
        return decision.case

    def solve_at(self, values: Mapping[Any, Any]) -> Solution:
        """The verified answer at a point: the omega that the region makes possible."""
        point = self.point(values)
        try:
            S = at_point(self.S, point)
        except UndefinedError:
            raise InputError(f"S isn't defined at {point}") from None
        answer = Solution(S.to_str(self.variable), self.variable, S, decide(S, Budget(self.limits)))
        verified = bool(answer.verify())
        if not verified and answer.status is not Status.UNDECIDED:
            raise VerificationFailed(f"the answer for S = {S} failed its own check; please report it")
        return replace(answer, verified=verified)

    def predicted(self, point: Point) -> Verdict | None:
        """What the regions claim; None where S isn't defined."""
        try:
            at_point(self.S, point)
        except UndefinedError:
            return None
        for region in self.regions:
            if region.statement.holds(point):
                if not region.defined:
                    return None
                return region.verdict
        if self.complete is True:
            return self.generic
        return Verdict(self.generic.structure, known=False)

    def point(self, values: Mapping[Any, Any]) -> Point:
        """The values of the parameters as constants of one field."""
        given = {str(name): value for name, value in values.items()}
        missing = [name for name in self.parameters if name not in given]
        unknown = [name for name in given if name not in self.parameters]
        if missing or unknown:
            raise InputError(
                f"values are needed for {', '.join(self.parameters)}",
                hint=f"missing: {', '.join(missing) or 'none'}; unknown: {', '.join(unknown) or 'none'}",
            )
        point = _point(self.parameters, [given[name] for name in self.parameters], self.constant, self.limits)
        for name, value in zip(point.names, point.values, strict=True):
            if not self.assumptions.of(name).admits(value):
                raise InputError(f"{name} = {value.to_str()} contradicts the assumption: {self.assumptions}")
        return point

    def check(self, samples: int = 200, *, seed: int = 1) -> CheckReport:
        """Solve the equation without parameters at exact points inside and outside of the regions, and compare."""
        random = Random(seed)
        usable = [region.statement for region in self.regions]
        counts = [0, 0, 0]
        disagreements: list[Disagreement] = []
        attempts = 0
        while sum(counts) < samples and attempts < 20 * samples:
            attempts += 1
            if usable and attempts % 2:
                statement = usable[attempts // 2 % len(usable)]
                point = sampling.inside(statement, self.constant, self.parameters, self.assumptions, random)
            else:
                point = sampling.outside(self.constant, self.parameters, self.assumptions, random)
            if point is None or not all(
                self.assumptions.of(n).admits(v) for n, v in zip(point.names, point.values, strict=True)
            ):
                continue
            try:
                predicted = self.predicted(point)
                S = at_point(self.S, point)
            except (ZeroDivisionError, UndefinedError):
                continue
            if predicted is None:
                continue
            special = any(statement.holds(point) for statement in usable)
            counts[2 if not predicted.known else 0 if special else 1] += 1
            if not predicted.known:
                continue
            decision = decide(S, Budget(self.limits), certify=False)
            if decision.status is not Status.UNDECIDED and decision.case != predicted.case:
                disagreements.append(Disagreement(str(point), predicted.case, decision.case))
        return CheckReport(counts[0], counts[1], counts[2], tuple(disagreements))

    def to_json(self) -> str:
        """One line of JSON: parameters, generic, regions."""
        import json

        return json.dumps(self.to_dict(), ensure_ascii=False)

    def to_dict(self) -> dict[str, Any]:
        """The JSON object as plain Python values."""
        return {
            "S": self.S.to_str(self.variable),
            "variable": self.variable,
            "parameters": list(self.parameters),
            "assumptions": self.assumptions.to_dict(),
            "generic": {"case": self.generic.case, "group": self.generic.group},
            "regions": [
                {
                    "condition": region.statement.text(),
                    "case": region.case,
                    "group": region.group,
                    "complete": region.complete,
                    "defined": region.defined,
                    "omega": region.omega,
                }
                for region in self.regions
            ],
            "complete": self.complete,
            "theory": self.theory,
            "notices": list(self.notices),
        }

    def latex(self) -> str:
        """The partition as a LaTeX `cases` environment; what isn't proven to be complete is said to hold for generic values."""
        rows = [rf"\text{{{_case_text(r.verdict)}}} & {r.statement.latex()}" for r in self.regions if r.defined]
        rows.append(rf"\text{{{_case_text(self.generic)}}} & \text{{{self._where_generic}}}")
        left = f"y'' = \\left({as_latex(self.S, self.variable)}\\right) y"
        return left + r"\colon\quad \begin{cases} " + r" \\ ".join(rows) + r" \end{cases}"

    @property
    def _where_generic(self) -> str:
        if self.complete is True:
            return "otherwise" if self.regions else "always"
        return "otherwise, for generic values" if self.regions else "for generic values"

    def _repr_latex_(self) -> str:
        return f"${self.latex()}$"

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """A map of two parameters: see `kovacic.parametric.plot.plot`."""
        from kovacic.parametric.plot import plot

        return plot(self, axes, **options)

    def __str__(self) -> str:
        known = f" ({self.assumptions})" if self.assumptions else ""
        lines = [f"y'' = ({shown(self.S, self.variable)}) y, parameters {', '.join(self.parameters)}{known}"]
        lines += [f"  note: {notice}" for notice in self.notices]
        lines += [f"  {region}" for region in self.regions]
        lines.append(f"  {self._where_generic}: {_case_text(self.generic)}")
        complete = "proven to be complete" if self.complete is True else f"complete {self.complete}"
        lines.append(f"  ({complete}; {self.theory})")
        return "\n".join(lines)


def _point(names: tuple[str, ...], values: list[Any], constant: Point, limits: Limits) -> Point:
    """Constants of one field, from numbers, SymPy numbers or text, together with the constant of S."""
    numbers, field = _constants(values, limits)
    if field == QQ:
        field = constant.field
        numbers = [number.over(field) for number in numbers]
    elif isinstance(constant.field, AlgebraicField):
        if constant.field.name == "alpha":
            raise InputError("rational values are needed where S has an algebraic constant that isn't one radical")
        numbers, field = _constants([*(str(value) for value in values), constant.field.name], limits)
        return Point((*names, *constant.names), tuple(numbers), field)
    return Point((*names, *constant.names), (*numbers, *constant.values), field)


def _constants(values: list[Any], limits: Limits) -> tuple[list[Poly], Field]:
    """The values in one field: the coefficients of one polynomial."""
    is_symbolic = any(type(value).__module__.startswith("sympy") for value in values)
    if is_symbolic and not any(isinstance(value, str) for value in values):
        import sympy

        x = sympy.Symbol("x")
        try:
            together: Any = sum((sympy.sympify(v, strict=True) * x**i for i, v in enumerate(values)), sympy.Integer(0))
        except sympy.SympifyError as error:
            raise InputError(f"the values of parameters are numbers, not {error.expr!r}") from None
    else:
        together = " + ".join(f"({value})*x^{i}" for i, value in enumerate(values))
    polynomial = read_input(together, var="x", limits=limits).S
    if not polynomial.is_polynomial or polynomial.field.ground != QQ:
        raise InputError("the values of parameters are numbers")
    return [polynomial.num[i] for i in range(len(values))], polynomial.field


def _case_text(verdict: Verdict) -> str:
    if not verdict.known:
        return "not determined"
    return "no Liouvillian solution" if verdict.case is None else f"case {verdict.case}"


__all__ = ["CheckReport", "Condition", "Conditions", "Disagreement"]
