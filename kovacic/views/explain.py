"""The derivation that a reader of Kovacic's paper follows, from the typed trace, as text, Markdown or LaTeX."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from kovacic.algebra.poly import Poly
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
from kovacic.engine.places import Kind
from kovacic.reading.names import Names, parameters_of
from kovacic.views.bibliography import references
from kovacic.views.document import (
    Block,
    Formula,
    Heading,
    Math,
    Paragraph,
    Sentence,
    Table,
    to_latex,
    to_markdown,
    to_text,
)
from kovacic.views.latex import latex_ratfunc, latex_text
from kovacic.views.trace import Choice, PlaceData, Trace, rational_form, trace_of

if TYPE_CHECKING:
    from kovacic.solution import Solution

_RENDERERS = {"text": to_text, "markdown": to_markdown, "latex": to_latex}
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


def explain(solution: Solution, *, format: str = "text", solutions: bool = True) -> str:
    """The derivation as "text", "markdown" or "latex"; `solutions=False` leaves the closed forms out, which need SymPy.

    Raises `ValueError` for another format.
    """
    if format not in _RENDERERS:
        raise ValueError(f"the format is one of {', '.join(_RENDERERS)}, not {format!r}")
    return _RENDERERS[format](document(trace_of(solution), solutions=solutions))


def document(trace: Trace, *, solutions: bool = True) -> list[Block]:
    """The blocks of the explanation."""
    writer = _Writer(trace)
    blocks = [*writer.equation(), *writer.local_data(), *writer.cases()]
    if trace.solution.status is Status.LIOUVILLIAN:
        blocks += [*writer.certificate(), *writer.omega()]
        if solutions:
            blocks += writer.closed_form()
    blocks += [*writer.group(), *writer.check(), *writer.bibliography()]
    return blocks


class _Writer:
    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self.solution = trace.solution
        self.names = Names(self.solution.variable, parameters_of(self.solution.S.field))

    # ---------------------------------------------------------------------------------------------- formulas

    def math(self, function: RatFunc | Poly) -> Math:
        value = RatFunc(function) if isinstance(function, Poly) else function
        renamed = self.names.renamed(value)
        x = self.solution.variable
        return Math(renamed.to_str(x).replace("**", "^"), latex_ratfunc(renamed, latex_text(x)))

    def named(self, name: str, latex: str, function: RatFunc | Poly) -> Math:
        value = self.math(function)
        return Math(f"{name} = {value.text}", f"{latex} = {value.latex}")

    def place(self, place: str) -> Math:
        if place == "infinity":
            return Math("infinity", r"\infty")
        text = self.names.place(place)
        x = self.solution.variable
        root = text.removeprefix(f"{x} - ") if text.startswith(f"{x} - ") else ""
        if text == x:
            root = "0"
        if text.startswith(f"{x} + "):
            root = "-" + text.removeprefix(f"{x} + ")
        if root and x not in root and " " not in root:
            return Math(f"{x} = {root}", f"{latex_text(x)} = {latex_text(root)}")
        return Math(f"{text} = 0".replace("**", "^"), f"{latex_text(text)} = 0")

    # ---------------------------------------------------------------------------------------------- sections

    def equation(self) -> list[Block]:
        solution = self.solution
        S = self.math(solution.S)
        simple = not any(char in S.text for char in " /-")
        factor = S if simple else Math(f"({S.text})", rf"\left({S.latex}\right)")
        normal = Math(f"y'' = {factor.text} y", f"y'' = {factor.latex} y")
        blocks: list[Block] = [Heading("The equation", 1)]
        equation = solution.equation
        if equation is not None and not equation.is_normal_form:
            gauge = self.math(solution.gauge)
            x = solution.variable
            y, v = equation.unknown, "v" if equation.unknown != "v" else "u"
            given = equation.text()
            blocks += [
                Formula(Math(given, latex_text(given.replace("^", "**")).replace("**", "^"))),
                Paragraph(
                    (f"With {y} = {v} exp(int gamma d{x}), gamma = -b/(2a), it becomes its normal form for {v}:",)
                ),
                Formula(Math(f"gamma = {gauge.text}", rf"\gamma = {gauge.latex}")),
                Formula(Math(f"{v}'' = {factor.text} {v}", f"{v}'' = {factor.latex} {v}")),
                Paragraph((f"In the following y stands for {v}.",)),
            ]
        else:
            blocks.append(Formula(normal))
        blocks += [Paragraph((f"Note: {notice}.",)) for notice in solution.notices]
        return blocks

    def local_data(self) -> list[Block]:
        rows = tuple(self._row(data) for data in self.trace.places)
        head = ("place", "points", "order", "local type", "Delta", "alpha (case 1)", "E (case 2)", "E (case 3, n = 12)")
        return [
            Heading("Poles and local exponents"),
            Paragraph(
                (
                    "Delta = sqrt(1 + 4b) is the difference of the exponents (1 + Delta)/2 and (1 - Delta)/2 of the local "
                    "solutions; the sets are those of Kovacic's steps 1. Conjugate poles stay together.",
                )
            ),
            Table(head, rows),
        ]

    def _row(self, data: PlaceData) -> tuple[Sentence, ...]:
        place = data.place
        kind = {
            Kind.ORDINARY: "ordinary",
            Kind.REGULAR: "regular",
            Kind.UNRAMIFIED: "irregular",
            Kind.RAMIFIED: "irregular, ramified",
        }[place.kind]
        kind += ", logarithm" if place.logarithm else ""
        delta: Sentence = ("-",)
        if place.kind is Kind.REGULAR:
            if place.delta is not None:
                delta = (_number(place.delta),)
            elif place.delta_squared is not None:
                square = self.math(place.delta_squared)
                delta = (Math(f"sqrt({square.text})", rf"\sqrt{{{square.latex}}}"),)
            else:
                delta = ("not rational",)
        order = "-" if data.at_infinity and not self.solution.S else str(data.order)
        points = "1" if data.at_infinity else str(place.degree)
        return (
            (self.place(str(place)),),
            (points,),
            (order,),
            (kind,),
            delta,
            (", ".join(map(str, data.exponents)) if data.exponents is not None else "-",),
            (_set(data.case_2),),
            (_set(data.case_3) if data.case_3 is not None else "-",),
        )

    def cases(self) -> list[Block]:
        solution = self.solution
        blocks: list[Block] = [Heading("Which case")]
        blocks += [self._exclusion(exclusion) for exclusion in solution.proof]
        structure = solution.decision.structure
        if solution.status is Status.UNDECIDED:
            blocks.append(Paragraph((f"Undecided: {solution.reason}.",)))
        elif structure is None:
            blocks.append(
                Paragraph(
                    ("Nothing is left but SL2(C): the equation has no Liouvillian solution, and this is a proof.",)
                )
            )
        elif solution.decision.invariant is not None:
            invariant = solution.decision.invariant
            blocks += [
                Paragraph((f"There is {_BY_INVARIANT[structure]}. So it is {_CASES[structure]}:",)),
                Formula(self._invariant(invariant)),
            ]
        else:
            blocks.append(
                Paragraph(
                    (
                        "There is no invariant of degree 2, so at most one omega is rational; its expansion at one place "
                        f"determines it, and it exists. So it is {_CASES[structure]}.",
                    )
                )
            )
        return blocks

    def _invariant(self, invariant: SemiInvariant) -> Math:
        F = rational_form(self.trace, invariant)
        if F is None:
            return self.named("F'/F", "F'/F", invariant.logarithmic_derivative)
        return self.named("F", "F", F)

    def _exclusion(self, exclusion: Exclusion) -> Paragraph:
        sentence: list[str | Math] = [f"Not {_CASES[exclusion.structure]}: "]
        for k, evidence in enumerate(exclusion.evidence):
            sentence += ["; " if k else "", *self._evidence(evidence)]
        return Paragraph((*sentence, "."))

    def _evidence(self, evidence: Evidence) -> list[str | Math]:
        if isinstance(evidence, NecessaryCondition):
            where: list[str | Math] = []
            for k, place in enumerate(evidence.places):
                where += [", " if k else " (at ", self.place(place)]
            return [evidence.rule.value, *where, *([")"] if where else [])]
        if isinstance(evidence, NoInvariant):
            m = evidence.invariant_degree
            if evidence.prime is None:
                return [f"the least exponents leave no room for an invariant of degree {m}"]
            return [
                f"no rational invariant of degree {m}: the linear system for its coefficients, with a polynomial of degree "
                f"at most {evidence.degree}, has nullity 0 modulo the prime {evidence.prime}, so it has none over the field"
            ]
        if evidence.prime is None:
            return [f"the degree of P would be at most {evidence.degree} by the exponents, so no rational omega exists"]
        return [
            f"no rational omega with P of degree at most {evidence.degree}: its expansion at ",
            self.place(evidence.place),
            f" isn't that of such a function modulo the prime {evidence.prime}",
        ]

    def certificate(self) -> list[Block]:
        trace, case = self.trace, self.solution.case
        if trace.theta is None or trace.P is None:
            return []
        symbol = "alpha" if case == 1 else "e"
        formula = {
            1: Math("d = alpha_inf - sum alpha_c", r"d = \alpha_\infty - \sum_c \alpha_c"),
            2: Math("d = (e_inf - sum e_c)/2", r"d = \tfrac{1}{2}\left(e_\infty - \sum_c e_c\right)"),
            3: Math("d = n/12 (e_inf - sum e_c)", r"d = \tfrac{n}{12}\left(e_\infty - \sum_c e_c\right)"),
        }[case or 1]
        rows = tuple(self._choice(choice) for choice in trace.choices)
        return [
            Heading("The exponents that succeed"),
            Table(("place", f"{symbol} chosen"), rows),
            Paragraph((formula, f" = {trace.d}, and with theta and P:")),
            Formula(self.named("theta", r"\theta", trace.theta)),
            Formula(self.named("P", "P", trace.P)),
        ]

    def _choice(self, choice: Choice) -> tuple[Sentence, ...]:
        value = "see theta" if choice.value is None else _number(choice.value)
        return (self.place(str(choice.place)),), (value,)

    def omega(self) -> list[Block]:
        solution = self.solution
        riccati = solution.riccati
        assert riccati is not None
        blocks: list[Block] = [Heading("omega = y'/y")]
        if solution.omega is not None:
            blocks.append(
                Formula(self.named("omega = theta + P'/P", r"\omega = \theta + \frac{P'}{P}", solution.omega))
            )
        else:
            blocks += [
                Paragraph((f"omega is a root of the irreducible polynomial of degree {riccati.degree}",)),
                Formula(self._polynomial(riccati)),
            ]
        if solution.constants is not None:
            c = self.names.symbol
            modulus = solution.constants.to_str(c)
            blocks.append(
                Paragraph((f"where {c} is a root of ", Math(modulus.replace("**", "^"), latex_text(modulus)), "."))
            )
        return blocks

    def _polynomial(self, riccati: RiccatiPolynomial) -> Math:
        unknown = self.names.unknown
        texts, formulas = [], []
        for k in range(riccati.degree, -1, -1):
            coefficient = riccati.coefficients[k]
            if coefficient:
                value = self.math(coefficient)
                power = "" if k == 0 else unknown if k == 1 else f"{unknown}^{k}"
                power_latex = "" if k == 0 else unknown if k == 1 else f"{unknown}^{{{k}}}"
                one = k == riccati.degree
                texts.append(power if one else f"({value.text}) {power}".rstrip())
                formulas.append(power_latex if one else rf"\left({value.latex}\right) {power_latex}".rstrip())
        return Math("\n + ".join(texts) + " = 0", " + ".join(formulas) + " = 0")

    def closed_form(self) -> list[Block]:
        from sympy import latex

        form = self.solution.closed_form
        if form is None:
            return []
        unknown = "y" if self.solution.equation is None else self.solution.equation.unknown
        blocks: list[Block] = [Heading("Solutions")]
        for k, y in enumerate((form.y1, form.y2), start=1):
            text = str(y)
            shown = text if len(text) < 2000 else f"{text[:1000]} ... ({len(text)} characters)"
            formula = latex(y) if len(text) < 5000 else r"\text{(too long to print)}"
            blocks.append(Formula(Math(f"{unknown}{k} = {shown.replace('**', '^')}", f"{unknown}_{{{k}}} = {formula}")))
        blocks += [Paragraph((f"Note: {note}.",)) for note in form.notes]
        return blocks

    def group(self) -> list[Block]:
        group = self.solution.group
        if group is None:
            return []
        sentence: list[str | Math] = [
            "The differential Galois group of the normal form is ",
            Math(group.name, group.latex),
            f", {group.description}",
        ]
        if group.order is not None:
            sentence.append(f", of order {group.order}")
        elif group.order_at_least is not None:
            sentence.append(f", of order at least {group.order_at_least} if it is finite")
        sentence.append(f": {group.ground.value}.")
        blocks: list[Block] = [Heading("The Galois group"), Paragraph(tuple(sentence))]
        given = self.solution.equation_group if self.solution.gauge else None
        if given is not None:
            blocks.append(Paragraph((f"The group of the equation as given, in GL2: {given.name}.",)))
        if self.solution.is_algebraic:
            blocks.append(Paragraph(("All solutions are algebraic functions.",)))
        return blocks

    def check(self) -> list[Block]:
        verification = self.solution.verify()
        if not verification.checks:
            return []
        rows = tuple(((check.statement,), ("passed" if check.passed else "FAILED",)) for check in verification.checks)
        return [Heading("Checks by independent code"), Table(("statement", "result"), rows)]

    def bibliography(self) -> list[Block]:
        return [Heading("References"), *(Paragraph((reference.text(),)) for reference in references(self.solution))]


def _number(value: Fraction) -> str:
    return str(value)


def _set(values: tuple[int, ...]) -> str:
    return "{" + ", ".join(map(str, values)) + "}"
