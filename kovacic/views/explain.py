"""The derivation that a reader of Kovacic's paper follows, from the typed trace, as text, Markdown, LaTeX or HTML."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

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
from kovacic.engine.places import Kind
from kovacic.errors import LimitExceeded
from kovacic.views.bibliography import references
from kovacic.views.document import FORMATS, Block, Formula, Heading, Paragraph, Sentence, Table
from kovacic.views.formula import Formulas, Math, given, latex_text
from kovacic.views.trace import PlaceData, Trace, rational_form, trace_of

if TYPE_CHECKING:
    from kovacic.solution import Solution

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
# d from the chosen exponents, by case.
_DEGREE = {
    1: Math("d = alpha_inf - sum alpha_c", r"d = \alpha_\infty - \sum_c \alpha_c"),
    2: Math("d = (e_inf - sum e_c)/2", r"d = \tfrac{1}{2}\left(e_\infty - \sum_c e_c\right)"),
    3: Math("d = n/12 (e_inf - sum e_c)", r"d = \tfrac{n}{12}\left(e_\infty - \sum_c e_c\right)"),
}
_KINDS = {
    Kind.ORDINARY: "ordinary",
    Kind.REGULAR: "regular",
    Kind.UNRAMIFIED: "irregular",
    Kind.RAMIFIED: "irregular, ramified",
}


def explain(solution: Solution, *, format: str = "text", solutions: bool = True) -> str:
    """The derivation as "text", "markdown", "latex" or "html"; `solutions=False` leaves the closed forms out (no SymPy).

    Raises `ValueError` for another format.
    """
    if format not in FORMATS:
        raise ValueError(f"the format is one of {', '.join(FORMATS)}, not {format!r}")
    return FORMATS[format].render(document(trace_of(solution), solutions=solutions))


def document(trace: Trace, *, solutions: bool = True) -> list[Block]:
    """The blocks of the explanation."""
    writer = _Writer(trace)
    blocks = [*writer.equation(), *writer.local_data(), *writer.cases()]
    if trace.solution.status is Status.LIOUVILLIAN:
        blocks += [*writer.certificate(), *writer.omega()]
        if solutions:
            blocks += writer.closed_form()
    return [*blocks, *writer.group(), *writer.check(), *writer.bibliography()]


def _say(*sentence: str | Math) -> Paragraph:
    return Paragraph(sentence)


class _Writer:
    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self.solution = trace.solution
        self.formulas = Formulas(self.solution.variable, self.solution.S.field)

    def equation(self) -> Iterator[Block]:
        solution, equation = self.solution, self.solution.equation
        S = self.formulas.math(solution.S)
        if any(char in S.text for char in " /-"):
            S = Math(f"({S.text})", rf"\left({S.latex}\right)")
        yield Heading("The equation", 1)
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
        yield _say(
            "Delta = sqrt(1 + 4b) is the difference of the exponents (1 + Delta)/2 and (1 - Delta)/2 of the local "
            "solutions; the sets are those of Kovacic's steps 1. Conjugate poles stay together."
        )
        head = ("place", "points", "order", "local type", "Delta", "alpha (case 1)", "E (case 2)", "E (case 3, n = 12)")
        yield Table(head, [self._row(data) for data in self.trace.places])

    def _row(self, data: PlaceData) -> list[Sentence]:
        place = data.place
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
            "-" if place.at_infinity and not self.solution.S else str(data.order),
            _KINDS[place.kind] + (", logarithm" if place.logarithm else ""),
            delta,
            ", ".join(map(str, data.exponents)) if data.exponents is not None else "-",
            f"{{{', '.join(map(str, data.case_2))}}}",
            f"{{{', '.join(map(str, data.case_3))}}}" if data.case_3 is not None else "-",
        ]
        return [[cell] for cell in cells]

    def cases(self) -> Iterator[Block]:
        decision = self.solution.decision
        yield Heading("Which case")
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
        F = rational_form(self.trace, invariant)
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
        yield Heading("The exponents that succeed")
        rows: list[list[Sentence]] = []
        for choice in self.trace.choices:
            value = "see theta" if choice.value is None else str(choice.value)
            rows.append([[self.formulas.place(str(choice.place))], [value]])
        yield Table(("place", f"{'alpha' if case == 1 else 'e'} chosen"), rows)
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
        from sympy import latex

        try:
            form = self.solution.closed_form
        except LimitExceeded as limit:
            yield _say(f"The solutions were not written out: {limit}.")
            return
        if form is None:
            return
        unknown = "y" if self.solution.equation is None else self.solution.equation.unknown
        yield Heading("Solutions")
        for k, y in enumerate((form.y1, form.y2), start=1):
            text = str(y)
            shown = text if len(text) < 2000 else f"{text[:1000]} ... ({len(text)} characters)"
            formula = latex(y) if len(text) < 5000 else r"\text{(too long to print)}"
            yield Formula(Math(f"{unknown}{k} = {shown.replace('**', '^')}", f"{unknown}_{{{k}}} = {formula}"))
        yield from (_say(f"Note: {note}.") for note in form.notes)

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
