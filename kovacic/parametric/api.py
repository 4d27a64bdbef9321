"""`kovacic.conditions`: for which values of the parameters is the equation solvable?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from random import Random
from typing import Any

from kovacic import engine
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.fields import QQ, Field
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.io.names import parameters_of
from kovacic.io.parsed import Parsed
from kovacic.io.read import read_input
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.parametric import sampling
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, read_assumptions
from kovacic.parametric.formulas import as_latex, shown
from kovacic.parametric.partition import Partition, Region, Settings, Verdict, partition, verdict_of
from kovacic.parametric.restriction import UndefinedError, at_point
from kovacic.parametric.slices import NO_CONSTANT, reduced, with_free_constant
from kovacic.parametric.statements import Both, Point, Statement
from kovacic.result import Solution
from kovacic.solution import Decision, Status

#: Seconds for the search where the limits don't say.
DEFAULT_SECONDS = 30.0
#: The bound for the degree of P where no theorem covers all degrees.
DEFAULT_DEGREE = 12


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
        decision = engine.decide(at_point(self.S, point), Budget(self.limits), certify=False)
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
        answer = Solution(S.to_str(self.variable), self.variable, S, engine.decide(S, Budget(self.limits)))
        verified = bool(answer.verify())
        if not verified and answer.status is not Status.UNDECIDED:
            raise VerificationFailed(f"the answer for S = {S} failed its own check; please report it")
        return replace(answer, verified=verified)

    def predicted(self, point: Point) -> Verdict | None:
        """What the regions claim; None where S isn't defined."""
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
            decision = engine.decide(S, Budget(self.limits), certify=False)
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
        """The partition as a LaTeX `cases` environment."""
        rows = [rf"\text{{{_case_text(r.verdict)}}} & {r.statement.latex()}" for r in self.regions if r.defined]
        rows.append(rf"\text{{{_case_text(self.generic)}}} & \text{{otherwise}}")
        left = f"y'' = \\left({as_latex(self.S, self.variable)}\\right) y"
        return left + r"\colon\quad \begin{cases} " + r" \\ ".join(rows) + r" \end{cases}"

    def _repr_latex_(self) -> str:
        return f"${self.latex()}$"

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """A map of two parameters: see `kovacic.parametric.plot.plot`."""
        from kovacic.parametric.plot import plot

        return plot(self, axes, **options)

    def __str__(self) -> str:
        known = f" ({self.assumptions})" if self.assumptions else ""
        lines = [f"y'' = ({shown(self.S, self.variable)}) y, parameters {', '.join(self.parameters)}{known}"]
        lines += [f"  {region}" for region in self.regions]
        lines.append(f"  {'otherwise' if self.regions else 'always'}: {_case_text(self.generic)}")
        complete = "proven to be complete" if self.complete is True else f"complete {self.complete}"
        lines.append(f"  ({complete}; {self.theory})")
        return "\n".join(lines)


def conditions(
    S: Any,
    *,
    var: Any = None,
    assume: Mapping[Any, str] | None = None,
    max_degree: int = DEFAULT_DEGREE,
    limits: Limits = DEFAULT_LIMITS,
) -> Conditions:
    """The exact values of the parameters for which y'' = S(x) y has Liouvillian solutions.

    Every symbol besides the variable is a parameter.  `assume={"n": "positive integer"}` leaves out what then can't happen;
    its words are integer, even, odd, half-integer, rational, irrational, noninteger, nonzero, positive, negative.  Assumptions
    of SymPy symbols are used in the same way.  `max_degree` bounds the degree of P where no
    theorem covers all degrees; `complete` then says so.  A budget that is used up (`limits.seconds`, 30 s where there is
    none) gives a partial list, and `complete` says that as well.

    Raises `InputError` for what isn't a rational function with parameters, and `LimitExceeded` for an input above the limits.

    >>> import kovacic
    >>> print(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1"))
    y'' = ((-4*x^2 + 4*n^2 - 1)/(4*x^2)) y, parameters n
      n - 1/2 in Z: case 1
      otherwise: no Liouvillian solution
      (proven to be complete; Whittaker's equation in x: Martinet & Ramis)

    References: T. Kimura, Funkcial. Ekvac. 12 (1969); J. Martinet & J.-P. Ramis (1989); A. Duval & M. Loday-Richaud,
    AAECC 3 (1992).
    """
    parsed = read_input(S, var=var, limits=limits)
    names = parameters_of(parsed.S.field)
    if not names:
        raise InputError("S has no parameters", hint="solve decides equations without parameters")
    return conditions_of(parsed, read_assumptions(assume, S, names), max_degree, limits)


def conditions_of(parsed: Parsed, known: Assumptions, max_degree: int, limits: Limits) -> Conditions:
    """The conditions for an input that was read."""
    lifted, constant = with_free_constant(parsed.S)
    assumptions = replace(known, values=tuple(zip(constant.names, constant.values, strict=True)))
    bounded = limits if limits.seconds is not None else replace(limits, seconds=DEFAULT_SECONDS)
    budget = Budget(bounded)
    result = partition(lifted, Settings(max_degree, budget, parsed.variable))
    different: dict[str, Condition] = {}
    for region in _flattened(result):
        region = replace(region, statement=reduced(region.statement, constant))
        different.setdefault(region.statement.text(), region)
    regions = [region for region in different.values() if region.statement.decided(assumptions) is not False]
    always = next((k for k, r in enumerate(regions) if r.statement.decided(assumptions) is True), None)
    generic, complete = result.generic, result.complete
    if always is not None:
        generic, complete, regions = regions[always].verdict, regions[always].complete, regions[:always]
        complete = next((region.complete for region in regions if region.complete is not True), complete)
        if not generic.known:
            generic = verdict_of(engine.decide(parsed.S, budget, certify=False))
    return Conditions(
        lifted,
        parsed.variable,
        parameters_of(parsed.S.field),
        generic,
        tuple(regions),
        complete,
        result.theory,
        limits,
        tuple(notice for notice in parsed.notices if "parameter" not in notice),
        known,
        constant,
    )


def under_assumptions(
    parsed: Parsed, decision: Decision, known: Assumptions, limits: Limits, *, certify: bool
) -> tuple[Decision, str]:
    """The decision for generic parameters where the assumptions hold, and a sentence that says for which of these values.

    Where the assumptions imply another case, that is the decision if no certificate is asked for.  Else it is undecided, with
    the case in its reason: omega depends on the value of a parameter, so that no single omega is the answer.
    """
    if decision.status is Status.UNDECIDED:
        return decision, ""
    answer = conditions_of(parsed, known, DEFAULT_DEGREE, limits)
    if answer.generic.known and answer.generic.case != decision.case:
        if not certify:
            return Decision(answer.generic.structure, ()), ""
        reason = (
            f"with {known} the equation is in case {answer.generic.case} ({answer.theory}), by an omega that depends on the "
            "values of the parameters: give values, or use kovacic.conditions and its solve_at"
        )
        return Decision(None, (), undecided=reason), ""
    exceptions = " or ".join(str(region.statement) for region in answer.regions)
    sentence = f"with {known} the answer holds" + (f" except where {exceptions}" if exceptions else "")
    return decision, f"{sentence} ({answer.theory}" + (")" if answer.complete is True else f"; {answer.complete})")


def _flattened(result: Partition) -> list[Condition]:
    """The regions with their inner ones, so that the first one that contains a point is right."""
    flat: list[Condition] = []
    for region in result.regions:
        if region.inner is not None:
            outer = _outer(region)
            special = _flattened(region.inner)
            while special and special[-1].defined and _claims(special[-1]) == _claims(outer):
                special.pop()
            for inner in special:
                statement = _both(region.statement, inner.statement)
                flat.append(Condition(statement, inner.verdict, inner.complete, inner.defined, inner.omega))
        flat.append(_outer(region))
    return flat


def _claims(condition: Condition) -> tuple[Verdict, bool | str]:
    return condition.verdict, condition.complete


def _outer(region: Region) -> Condition:
    verdict = region.verdict
    if region.inner is not None and region.inner.complete is not True:
        verdict = Verdict(verdict.structure, known=False)
    return Condition(region.statement, verdict, region.complete, region.defined, region.omega)


def _both(first: Statement, second: Statement) -> Statement:
    parts = second.parts if isinstance(second, Both) else (second,)
    return Both((first, *parts))


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
    if any(type(value).__module__.startswith("sympy") for value in values):
        import sympy

        x = sympy.Symbol("x")
        together: Any = sum((sympy.sympify(v, strict=True) * x**i for i, v in enumerate(values)), sympy.Integer(0))
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


__all__ = ["CheckReport", "Condition", "Conditions", "Disagreement", "conditions"]
