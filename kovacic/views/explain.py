"""The derivation as a reader of Kovacic's paper follows it, as text, Markdown, LaTeX or HTML.

First the paper's own steps, line by line (`families`), then what this package claims and proves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from html import escape
from io import StringIO
from typing import TYPE_CHECKING

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import (
    Evidence,
    Exclusion,
    NecessaryCondition,
    NoInvariant,
    RiccatiPolynomial,
    SemiInvariant,
    Status,
    Structure,
)
from kovacic.engine.places import Kind, Place, analyse
from kovacic.errors import KovacicError, LimitExceeded
from kovacic.limits import Budget
from kovacic.views.bibliography import references
from kovacic.views.document import FORMATS, Block, Formula, Heading, Paragraph, Picture, Sentence, Table
from kovacic.views.formula import LARGEST_DEGREE, Formulas, Math, given, latex_text, of_sympy, shortened

if TYPE_CHECKING:
    from kovacic.solution import Solution
    from kovacic.views.families import Family, Point, Search

_CASES = {
    Structure.REDUCIBLE: "case 1 (the group is reducible, omega rational)",
    Structure.IMPRIMITIVE: "case 2 (the group is imprimitive, omega of degree 2)",
    Structure.TETRAHEDRAL: "case 3, tetrahedral group (omega of degree 4)",
    Structure.OCTAHEDRAL: "case 3, octahedral group (omega of degree 6)",
    Structure.ICOSAHEDRAL: "case 3, icosahedral group (omega of degree 12)",
}
_BY_INVARIANT = {
    Structure.REDUCIBLE: "an invariant of degree 2: it is y1 y2 for two solutions with rational omega, or y1^2",
    Structure.IMPRIMITIVE: "an invariant of degree 4 of an irreducible equation: (y1 y2)^2, so the group permutes two lines",
    Structure.TETRAHEDRAL: "an invariant of degree 6, the least one of the binary tetrahedral group",
    Structure.OCTAHEDRAL: "an invariant of degree 8, the least one of the binary octahedral group",
    Structure.ICOSAHEDRAL: "an invariant of degree 12, the least one of the binary icosahedral group",
}
# d from the chosen exponents, and what P has to satisfy, by case [Kovacic 1986, sections 3.1, 4.1 and 5.1].
_DEGREE = {
    1: Math("d = alpha_inf - sum alpha_c", r"d = \alpha_\infty - \sum_c \alpha_c"),
    2: Math("d = (e_inf - sum e_c)/2", r"d = \tfrac{1}{2}\left(e_\infty - \sum_c e_c\right)"),
    3: Math("d = n/12 (e_inf - sum e_c)", r"d = \tfrac{n}{12}\left(e_\infty - \sum_c e_c\right)"),
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
    3: "no pole has an order > 2, at infinity the order is >= 2; every Delta is rational",
}
#: So many families are shown.
_MOST_SHOWN = 24
_PICTURE_SECONDS = 5.0
_KINDS = {
    Kind.ORDINARY: "ordinary",
    Kind.REGULAR: "regular",
    Kind.UNRAMIFIED: "irregular",
    Kind.RAMIFIED: "irregular, ramified",
}


def explain(solution: Solution, *, format: str = "text", solutions: bool = True) -> str:
    """The derivation as "text", "markdown", "latex" (the body of a document with amsmath, amssymb and graphicx) or "html".

    HTML is one page that needs nothing from elsewhere, in ASCII, with MathML, and with the picture of a real solution where
    there is one (for rational coefficients, if matplotlib is installed).  `solutions=False` leaves closed forms out.  Formulas
    that fill more than some screens aren't printed, and parts that would take longer than the limits allow are left out; both
    are said.  Raises `ValueError` for another format.
    """
    if format not in FORMATS:
        raise ValueError(f"the format is one of {', '.join(FORMATS)}, not {format!r}")
    blocks = document(solution, solutions=solutions)
    if format != "html":
        return FORMATS[format].render(blocks)
    body = FORMATS[format].render([*blocks, *_picture(solution)])
    page = _PAGE.replace("BODY", body, 1).replace("TITLE", escape(shortened(solution.text)), 1)
    return page.encode("ascii", "xmlcharrefreplace").decode()


def document(solution: Solution, *, solutions: bool = True) -> list[Block]:
    """The blocks of the explanation."""
    writer = _Writer(solution)
    parts = [writer.equation, writer.local_data, writer.necessary, writer.steps, writer.cases]
    if solution.status is Status.LIOUVILLIAN:
        parts += [writer.certificate, writer.omega]
    if solutions and solution.status is not Status.UNDECIDED:
        parts.append(writer.closed_form)
    return [block for part in (*parts, writer.group, writer.check, writer.bibliography) for block in _in_time(part)]


def _in_time(part: Callable[[], Iterator[Block]]) -> Iterator[Block]:
    """The blocks of a part; where a limit ends it, that is said."""
    try:
        yield from part()
    except LimitExceeded as limit:
        yield _say(f"The rest of this part isn't written out: {limit}.")


def _picture(solution: Solution) -> list[Block]:
    """A real solution between and beside the singular points on the axis; nothing where its values can't be had."""
    from kovacic.enclosure.problem import as_problem

    try:
        singular = [float(z.re) for z in as_problem(solution).singular_points(64) if z.is_real()]
        low, high = round(min(singular, default=-3)) - 2, round(max(singular, default=3)) + 2
        seconds = min(solution.limits.seconds or _PICTURE_SECONDS, _PICTURE_SECONDS)
        figure = solution.plot(low, high, digits=6, points=240, limits=replace(solution.limits, seconds=seconds))
    except (KovacicError, ImportError):
        return []
    drawing = StringIO()
    figure.savefig(drawing, format="svg", metadata={"Date": None})
    caption = "The solution with y = 1, y' = 0 in the middle of its longest interval without a singular point."
    return [Heading("A picture"), Picture(drawing.getvalue()[drawing.getvalue().index("<svg") :], caption)]


def _say(*sentence: str | Math) -> Paragraph:
    return Paragraph(sentence)


class _Writer:
    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self.places = analyse(solution.S, Budget()).places
        self.formulas = Formulas(self.solution.variable, self.solution.S.field)

    def equation(self) -> Iterator[Block]:
        solution, equation = self.solution, self.solution.equation
        S = self.formulas.math(solution.S)
        if any(char in S.text for char in " /-"):
            S = Math(f"({S.text})", rf"\left({S.latex}\right)")
        yield Heading("The equation", 1)
        if solution.change is not None:
            yield _say(f"{solution.text}, which becomes an equation with rational coefficients:")
        if equation is None or equation.is_normal_form:
            yield Formula(Math(f"y'' = {S.text} y", f"y'' = {S.latex} y"))
        else:
            y, v = equation.unknown, "v" if equation.unknown != "v" else "u"
            yield Formula(given(equation))
            substitution = f"{y} = {v} exp(int gamma d{solution.variable}), gamma = -b/(2a)"
            yield _say(f"With {substitution}, it becomes its normal form for {v}:")
            yield Formula(self.formulas.named("gamma", r"\gamma", solution.gauge))
            yield Formula(Math(f"{v}'' = {S.text} {v}", f"{v}'' = {S.latex} {v}"))
            yield _say(f"In the following y stands for {v}.")
        yield from (_say(f"Note: {notice}.") for notice in solution.notices)

    def local_data(self) -> Iterator[Block]:
        yield Heading("Poles and local exponents")
        x = latex_text(self.solution.variable)
        yield _say(
            "At a pole of order 2, ",
            Math(f"S = b/({self.solution.variable} - c)^2 + ...", rf"S = \frac{{b}}{{({x} - c)^2}} + \dots"),
            ", the local solutions have exponents with the difference ",
            Math("Delta = sqrt(1 + 4b)", r"\Delta = \sqrt{1 + 4 b}"),
            ". Conjugate poles stay together.",
        )
        head = ("place", "points", "order", "local type", "Delta")
        yield Table(head, [self._row(place) for place in self.places])

    def _row(self, place: Place) -> list[Sentence]:
        delta: str | Math = "-"
        if place.kind is Kind.REGULAR:
            if place.delta is not None:
                delta = str(place.delta)
            elif place.delta_squared is not None:
                square = self.formulas.math(place.delta_squared)
                delta = Math(f"sqrt({square.text})", rf"\sqrt{{{square.latex}}}")
            else:
                delta = "not rational"
        cells: list[str | Math] = [
            self.formulas.place(str(place)),
            "1" if place.at_infinity else str(place.degree),
            str(place.order) if not place.at_infinity else str(-self.solution.S.degree) if self.solution.S else "-",
            _KINDS[place.kind] + (", logarithm" if place.logarithm else ""),
            delta,
        ]
        return [[cell] for cell in cells]

    def necessary(self) -> Iterator[Block]:
        yield Heading("Kovacic's necessary conditions (section 2.1)")
        rows: list[list[Sentence]] = []
        for case, condition in _CONDITIONS.items():
            failing = [] if case == 2 else [place for place in self.places if not _allowed(case, [place])]
            verdict: list[str | Math] = ["holds" if _allowed(case, self.places) else "fails"]
            for k, place in enumerate(failing):
                verdict += [", " if k else " at ", self.formulas.place(str(place))]
            rows.append([[str(case)], [condition], verdict])
        yield Table(("case", "condition", "verdict"), rows)

    def steps(self) -> Iterator[Block]:
        """The paper's steps 1 to 3, case by case, up to the one that succeeds."""
        from kovacic.views.families import search

        solution = self.solution
        degree = 12 if solution.riccati is None else solution.riccati.degree
        for m in () if solution.status is Status.UNDECIDED else (1, 2, 4, 6, 12):
            case = min(m, 3)
            if m > degree or not _allowed(case, self.places):
                continue
            yield Heading(f"Case {case}{f', n = {m}' if case == 3 else ''}: Kovacic's steps")
            found = search(solution.S, self.places, solution.variable, m)
            if found is None:
                domain = (
                    "rational coefficients, exponents that are square roots of rational numbers, and poles of low order"
                )
                yield _say(f"The steps are written out for {domain} only.")
            else:
                yield from self._search(found, case)

    def _search(self, search: Search, case: int) -> Iterator[Block]:
        yield self._sets(search, case)
        many = f"{search.total} famil{'y' if search.total == 1 else 'ies'} of exponents"
        natural = "" if search.natural is None else f", d is a natural number for {search.natural}"
        parity = " (with an odd e)" if case == 2 and natural else ""
        yield _say("Step 2: ", _DEGREE[case], f"; {many}{natural}{parity}.")
        if search.families is None:
            yield _say(
                "They are too many to be listed; the engine finds omega, or proves that there is none, without them."
            )
            return
        if not search.complete:
            yield _say("Of conjugate poles, only families with equal exponents are listed.")
        shown = search.families[:_MOST_SHOWN]
        if shown:
            head = [*map(self._point, search.points), Math("d", "d"), Math("P", "P")]
            rows: list[list[Sentence]] = []
            for family in shown:
                values = [of_sympy(choice.value) for choice in family.choices]
                rows.append([*([value] for value in values), [of_sympy(family.d)], [self._outcome(family)]])
            yield Table(head, rows)
        if len(search.families) > _MOST_SHOWN:
            yield _say(f"and {len(search.families) - _MOST_SHOWN} more.")
        tried = [family for family in search.families if family.theta is not None]
        if tried:
            yield _say("Step 3: P of degree d, with")
            yield from map(Formula, _EQUATIONS[case])
        for family in tried[-_MOST_SHOWN:]:
            yield from self._trial(family)

    def _sets(self, search: Search, case: int) -> Table:
        """Step 1."""
        from sympy import Add, Symbol

        rows: list[list[Sentence]] = []
        for point, choices in zip(search.points, search.choices, strict=True):
            values = [of_sympy(choice.value) for choice in choices]
            if case == 1:
                t = Symbol(self.solution.variable) - (0 if point.place.at_infinity or point.at is None else point.at)
                singular = of_sympy(Add(*(c * t**power for power, c in choices[0].singular)))
                rows.append([[self._point(point)], [singular], [values[0]], [values[-1]]])
            else:
                inside = ", ".join(value.text for value in values)
                rows.append([[self._point(point)], [Math(f"{{{inside}}}", rf"\{{{inside}\}}")]])
        alphas = (Math(f"alpha{sign}", rf"\alpha^{sign}") for sign in "+-")
        return Table(
            ("place", Math("[sqrt S]", r"[\sqrt{S}]"), *alphas) if case == 1 else ("place", Math("E", "E")), rows
        )

    def _point(self, point: Point) -> Math:
        if point.at is None or point.place.at_infinity:
            return self.formulas.place(str(point.place))
        at = of_sympy(point.at)
        return Math(f"{self.solution.variable} = {at.text}", f"{latex_text(self.solution.variable)} = {at.latex}")

    @staticmethod
    def _outcome(family: Family) -> str | Math:
        if family.P is not None:
            return of_sympy(family.P)
        if family.theta is not None:
            return "none"
        return "not tried" if family.d.is_Integer and family.d >= 0 else ""

    @staticmethod
    def _trial(family: Family) -> Iterator[Block]:
        theta, d = of_sympy(family.theta), family.d
        yield Formula(Math(f"theta = {theta.text}", rf"\theta = {theta.latex}"))
        impossible = next((condition for condition in family.conditions if condition.is_number), None)
        conditions = [of_sympy(condition) for condition in family.conditions[:6]]
        if family.P is not None:
            P = of_sympy(family.P)
            yield _say(f"d = {d}: ", Math(f"P = {P.text}", f"P = {P.latex}"), " is a solution.")
        elif impossible is not None:
            yield _say(f"d = {d}: no solution, for a coefficient is ", of_sympy(impossible), ", which isn't 0.")
        elif conditions:
            system = ", ".join(f"{c.text} = 0" for c in conditions), r",\; ".join(f"{c.latex} = 0" for c in conditions)
            yield _say(
                f"d = {d}: no solution, for the lower coefficients a0, ... of P would satisfy ", Math(*system), "."
            )
        else:
            yield _say(f"d = {d}: no solution, for the linear system for its {d + 1} coefficients has rank {d + 1}.")

    def cases(self) -> Iterator[Block]:
        decision = self.solution.decision
        yield Heading("The proof of this program")
        yield from map(self._exclusion, decision.exclusions)
        if decision.undecided is not None:
            yield _say(f"Undecided: {decision.undecided}.")
        elif decision.structure is None:
            yield _say("Nothing is left but SL2(C): the equation has no Liouvillian solution, and this is a proof.")
        elif decision.invariant is not None:
            yield _say(f"There is {_BY_INVARIANT[decision.structure]}. So it is {_CASES[decision.structure]}:")
            yield Formula(self._invariant(decision.invariant))
        else:
            yield _say(
                "There is no invariant of degree 2, so at most one omega is rational; its expansion at one place "
                f"determines it, and it exists. So it is {_CASES[decision.structure]}."
            )

    def _invariant(self, invariant: SemiInvariant) -> Math:
        F = rational_form(invariant, self.places)
        if F is None:
            return self.formulas.named("F'/F", "F'/F", invariant.logarithmic_derivative)
        return self.formulas.named("F", "F", F)

    def _exclusion(self, exclusion: Exclusion) -> Paragraph:
        sentence: list[str | Math] = [f"Not {_CASES[exclusion.structure]}: "]
        for k, evidence in enumerate(exclusion.evidence):
            sentence += ["; " if k else "", *self._evidence(evidence)]
        return _say(*sentence, ".")

    def _evidence(self, evidence: Evidence) -> Iterator[str | Math]:
        if isinstance(evidence, NecessaryCondition):
            yield evidence.rule.value
            for k, place in enumerate(evidence.places):
                yield ", " if k else " (at "
                yield self.formulas.place(place)
            yield ")" if evidence.places else ""
        elif isinstance(evidence, NoInvariant):
            m = evidence.invariant_degree
            if evidence.prime is None:
                yield f"the least exponents leave no room for an invariant of degree {m}"
                return
            yield (
                f"no rational invariant of degree {m}: the linear system for its coefficients, with a polynomial of degree "
                f"at most {evidence.degree}, has nullity 0 modulo the prime {evidence.prime}, so it has none over the field"
            )
        elif evidence.prime is None:
            yield f"the degree of P would be at most {evidence.degree} by the exponents, so no rational omega exists"
        else:
            yield f"no rational omega with P of degree at most {evidence.degree}: its expansion at "
            yield self.formulas.place(evidence.place)
            yield f" isn't that of such a function modulo the prime {evidence.prime}"

    def certificate(self) -> Iterator[Block]:
        form, case = self.solution.semi_invariant, self.solution.case
        if form is None or case is None:
            return
        yield Heading("theta and P of the answer")
        yield _say(_DEGREE[case], f" = {form.P.degree}, and with theta and P:")
        yield Formula(self.formulas.named("theta", r"\theta", form.theta))
        yield Formula(self.formulas.named("P", "P", form.P))

    def omega(self) -> Iterator[Block]:
        solution = self.solution
        assert solution.riccati is not None
        yield Heading("omega = y'/y")
        if solution.omega is not None:
            yield Formula(
                self.formulas.named("omega = theta + P'/P", r"\omega = \theta + \frac{P'}{P}", solution.omega)
            )
        else:
            yield _say(f"omega is a root of the irreducible polynomial of degree {solution.riccati.degree}")
            yield Formula(self._polynomial(solution.riccati))
        if solution.constants is not None:
            c = self.formulas.names.symbol
            modulus = solution.constants.to_str(c)
            yield _say(f"where {c} is a root of ", Math(modulus.replace("**", "^"), latex_text(modulus)), ".")

    def _polynomial(self, riccati: RiccatiPolynomial) -> Math:
        w, m = self.formulas.names.unknown, riccati.degree
        texts, formulas = [f"{w}^{m}"], [f"{w}^{{{m}}}"]
        for k in range(m - 1, -1, -1):
            if riccati.coefficients[k]:
                value = self.formulas.math(riccati.coefficients[k])
                power = {0: "", 1: f" {w}"}
                texts.append(f"({value.text})" + power.get(k, f" {w}^{k}"))
                formulas.append(rf"\left({value.latex}\right)" + power.get(k, f" {w}^{{{k}}}"))
        return Math("\n + ".join(texts) + " = 0", " + ".join(formulas) + " = 0")

    def closed_form(self) -> Iterator[Block]:
        semi = self.solution.semi_invariant
        if semi is not None and semi.P.degree > LARGEST_DEGREE:
            yield _say(f"The solutions aren't written out: P has the degree {semi.P.degree}.")
            return
        form, special = self.solution.closed_form, None if self.solution.case else self.solution.special
        found = special or () if form is None else (form.y1, form.y2)
        if found:
            yield Heading("Solutions in special functions" if special else "Solutions")
        unknown = "y" if self.solution.equation is None else self.solution.equation.unknown
        for k, y in enumerate(found, start=1):
            text = str(y)
            if len(text) < 2000:
                shown = of_sympy(y)
            else:
                shown = Math(f"{text[:1000]} ... ({len(text)} characters)", r"\text{(too long to print)}")
            yield Formula(Math(f"{unknown}{k} = {shown.text}", f"{unknown}_{{{k}}} = {shown.latex}"))
        yield from (_say(f"Note: {note}.") for note in (form.notes if form else ()))

    def group(self) -> Iterator[Block]:
        group = self.solution.group
        if group is None:
            return
        order = ""
        if group.order is not None:
            order = f", of order {group.order}"
        elif group.order_at_least is not None:
            order = f", of order at least {group.order_at_least} if it is finite"
        yield Heading("The Galois group")
        name = Math(group.name, group.latex)
        about = f", {group.description}{order}: {group.ground.value}."
        yield _say("The differential Galois group of the normal form is ", name, about)
        given = self.solution.equation_group if self.solution.gauge else None
        if given is not None:
            yield _say(f"The group of the equation as given, in GL2: {given.name}.")
        if self.solution.is_algebraic:
            yield _say("All solutions are algebraic functions.")

    def check(self) -> Iterator[Block]:
        checks = self.solution.verify().checks
        if checks:
            yield Heading("Checks by independent code")
            rows = [[[check.statement], ["passed" if check.passed else "FAILED"]] for check in checks]
            yield Table(("statement", "result"), rows)

    def bibliography(self) -> Iterator[Block]:
        yield Heading("References")
        yield from (_say(reference.text()) for reference in references(self.solution))


def _allowed(case: int, places: Sequence[Place]) -> bool:
    """The necessary conditions; that of case 2 has to hold at some pole only."""
    if case == 1:
        return all(place.kind is not Kind.RAMIFIED for place in places)
    if case == 2:
        return any(place.order == 2 or place.kind is Kind.RAMIFIED for place in places if not place.at_infinity)
    return all(place.order == 0 or (place.order <= 2 and place.delta is not None) for place in places)


def rational_form(form: SemiInvariant, places: Sequence[Place]) -> RatFunc | None:
    """P times powers of the factors of the poles, where these powers, the residues of theta, are integers; else None."""
    result, field = RatFunc(form.P), form.theta.num.field
    for place in places[:-1]:
        factor = place.factor.over(field)
        cofactor, order = form.theta.den.remove(factor)
        if order > 1 or (order == 0 and factor.gcd(form.theta.den).degree > 0):
            return None
        if order:
            residue = form.theta.num * (cofactor * factor.derivative()).inverse_modulo(factor) % factor
            value = field.rational_value(residue) if residue.degree <= 0 else None
            if value is None or value.denominator != 1:
                return None
            result = result * RatFunc(place.factor) ** value.numerator
    return result


_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>TITLE</title>
<style>
body { max-width: 52rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 Georgia, serif; color: #222; background: #fff }
table { border-collapse: collapse; margin: 1rem 0 } td, th { padding: .25rem .8rem; border-bottom: 1px solid #ddd }
h2 { margin-top: 2rem; border-bottom: 1px solid #ccc } svg { max-width: 100%; height: auto } math { font-size: 1.08em }
figure { margin: 1rem 0 } figcaption { color: #666; font-size: .9em }
</style></head><body>
BODY</body></html>
"""
