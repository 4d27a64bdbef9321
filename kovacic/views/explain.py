"""The derivation as a reader of Kovacic's paper follows it, as text, Markdown, LaTeX or HTML.

First the paper's own steps, line by line (`steps`), then what this package claims and proves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from fractions import Fraction
from functools import partial
from io import StringIO
from typing import Any

from kovacic import derived
from kovacic.algebra.ratfunc import RatFunc
from kovacic.answer import Answer
from kovacic.decision import NoInvariant, NoRationalOmega, SemiInvariant, Status, Structure
from kovacic.engine.places import Problem
from kovacic.engine.riccati import logarithmic_residue
from kovacic.equation import parameters_of
from kovacic.errors import KovacicError, LimitExceeded
from kovacic.limits import MOST_CHARACTERS, bounded_work
from kovacic.numbers.numerals import digits
from kovacic.views.bibliography import references
from kovacic.views.sentences import (
    equation_of,
    normal_form_of,
    omega_math,
    powers_in,
    reason,
    solutions_of,
    verdict_in_words,
)
from kovacic.views.steps import Steps
from kovacic.writing.breaking import LINE
from kovacic.writing.document import (
    Block,
    Format,
    Formula,
    Heading,
    Table,
    anchor,
    format_of,
    say,
)
from kovacic.writing.formula import Math, caret, free_name, generated_field, latex_text, separated, shortened

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
#: e_k = E_k/f, by equation (1) of `engine.riccati` divided by f.
_OMEGA_BY_RECURRENCE = (
    Math(
        "phi = theta + P'/P,  e_0 = 1,  e_1 = phi",
        r"\varphi = \theta + \frac{P'}{P}, \quad e_0 = 1, \quad e_1 = \varphi",
    ),
    Math(
        "e_(k+1) = (e_k' + phi e_k - (m-k+1) S e_(k-1))/(k+1)",
        r"e_{k+1} = \frac{e_k' + \varphi e_k - (m-k+1) S e_{k-1}}{k+1}",
    ),
)
_PICTURE = "A picture"
#: Steps of Taylor's method times their bits, or values of closed forms: some seconds.
_PICTURE_WORK = 400_000


def explain_answer(answer: Answer, *, format: str = "text", solutions: bool = True) -> str:
    """The derivation, as `Solution.explain` describes it."""
    chosen = format_of(format)
    blocks = document(answer, solutions=solutions)
    if not chosen.has_pictures:
        return chosen.render(blocks)
    # The equation and the answer (the first two headings), a table of contents, and the rest.
    picture = (
        "" if answer.series else _picture(answer, chosen)
    )  # values of these solutions differ by thousands of digits
    starts = [k for k, block in enumerate(blocks) if isinstance(block, Heading)]
    titles = [block.text for block in blocks[starts[2] :] if isinstance(block, Heading)]
    if picture:
        titles.append(_PICTURE)
    contents = "".join(f'<li><a href="#{anchor(title)}">{chosen.plain(title)}</a></li>' for title in titles)
    first = chosen.render(blocks[: starts[2]])
    rest = chosen.render(blocks[starts[2] :])
    return chosen.page(shortened(answer.text), f"{first}\n<nav><ul>{contents}</ul></nav>\n\n{rest}{picture}")


def document(answer: Answer, *, solutions: bool = True) -> list[Block]:
    """The blocks of the explanation."""
    writer = ExplanationWriter(answer)
    parts: list[Callable[[], Iterator[Block]]] = [
        writer.equation,
        partial(writer.verdict, solutions=solutions),
        writer.local_data,
        writer.necessary,
        writer.search,
        writer.cases,
    ]
    if answer.status is Status.LIOUVILLIAN:
        parts.append(writer.certificate)
    if answer.riccati is not None:
        parts.append(writer.omega)
    if solutions and answer.status is not Status.UNDECIDED:
        parts.append(writer.closed_form)
    blocks: list[Block] = []
    for part in (*parts, writer.group, writer.check, writer.bibliography):
        try:
            blocks.extend(part())  # a limit ends the part, but keeps the blocks before it
        except LimitExceeded as limit:
            blocks.append(say(f"The rest of this part isn't written out: {limit}."))
    return blocks


def _picture(answer: Answer, chosen: Format) -> str:
    """A picture of solutions, or the limit that prevented it; empty without values, NumPy or matplotlib."""
    heading = chosen.heading(_PICTURE, 2)
    try:
        figure, caption = _figure(answer)
    except LimitExceeded as limit:
        why = chosen.render([say(f"There is no picture: {limit}.")])
        return f"\n{heading}\n\n{why}\n"
    except (KovacicError, ImportError, OverflowError):
        return ""
    figure.savefig(drawing := StringIO(), format="svg", metadata={"Date": None})
    svg = drawing.getvalue()[drawing.getvalue().index("<svg") :]
    return f"\n{heading}\n\n<figure>{svg}<figcaption>{caption}</figcaption></figure>\n"


def _figure(answer: Answer) -> tuple[Any, str]:
    """Solutions near the singular points on the real axis, or on a shorter interval about their middle, and the caption."""
    from kovacic.enclosure.problem import as_problem
    from kovacic.views.plot import modest_window, plot

    singular = [float(z.re) for z in as_problem(answer).singular_points(64) if z.is_real()]
    low = Fraction(round(min(singular, default=-3)) - 2)
    high = Fraction(round(max(singular, default=3)) + 2)
    window = modest_window(answer, low, high)
    if window is None:
        raise LimitExceeded("solutions oscillate or grow too fast on every interval that was tried", limit="work")
    with bounded_work(_PICTURE_WORK):
        figure = plot(answer, *window, digits=6, points=240, limits=answer.limits)
    if window == (low, high):
        return figure, "Solutions near the singular points on the real axis."
    return figure, "Solutions on an interval that is short, since they oscillate or grow fast beyond it."


class ExplanationWriter(Steps):
    """The parts of the explanation of an answer, as blocks; the paper's steps are those of the base class."""

    def equation(self) -> Iterator[Block]:
        answer = self.answer
        equation = self.answer.equation
        about = equation_of(answer).text if answer.change is None else answer.text
        title = "Kovacic's algorithm"
        yield Heading(f"{title} for {about}" if len(about) <= LINE else title, 1)
        if answer.change is not None:
            t = Math.of(answer.variable).equals(Math.of(answer.change.expression))
            yield say(f"{answer.text}, which becomes an equation with rational coefficients in ", t, ":")
        yield Formula(equation_of(answer))
        if equation is not None and not equation.is_normal_form:
            y = equation.unknown
            v, blocks = self.normal_form(y)
            given = "equation as given" if equation.is_homogeneous else "homogeneous equation"
            yield from blocks
            yield say(
                f"Cases, omega and the group below are those of the normal form, with y for {v}; the "
                f"solutions {y}1 and {y}2 are those of the {given}."
            )
        yield from (say(f"Note: {notice}.") for notice in answer.notices)
        if answer.change is not None:
            yield say("The case and the group are those over ", generated_field(answer.change.expression), ".")

    def normal_form(self, y: str) -> tuple[str, list[Block]]:
        """The name of the unknown in the normal form, the substitution that leads to it, and the form itself."""
        answer = self.answer
        x = answer.variable
        taken = {x, y, *parameters_of(answer.S.field)}
        v = free_name(taken, "v", "u", "z")
        a, b = ("a", "b") if not {"a", "b"} & taken else ("A", "B")
        meaning = "" if a == "a" else f", {a} and {b} the coefficients of {y}'' and {y}'"
        substitution = Math(f"{y} = {v} exp(int gamma d{x})", rf"{y} = {v} \exp \int \gamma \, d{latex_text(x)}")
        gamma = Math(f"gamma = -{b}/(2{a})", rf"\gamma = -\frac{{{b}}}{{2{a}}}")
        is_homogeneous = answer.equation is None or answer.equation.is_homogeneous
        given = "it" if is_homogeneous else "the homogeneous equation"
        blocks: list[Block] = [
            say("With ", substitution, ", ", gamma, f"{meaning}, {given} becomes its normal form for {v}:"),
            Formula(self.formulas.named("gamma", answer.gauge)),
            Formula(normal_form_of(answer, v)),
        ]
        return v, blocks

    def verdict(self, *, solutions: bool) -> Iterator[Block]:
        """The answer in brief."""
        found, more = verdict_in_words(self.answer)
        yield Heading("The answer")
        before, name, after = more.partition("omega = y'/y")
        omega = [Math(name, r"\omega = y'/y")] if name else []
        yield say(f"{found[0].upper()}{found[1:]}: {before}", *omega, f"{after}.")
        if not solutions or self.answer.status is Status.UNDECIDED:
            return
        with suppress(LimitExceeded):  # the part with the solutions reports it
            pair, _ = solutions_of(self.answer)
            if all(len(y.text) <= MOST_CHARACTERS for _, y in pair):  # longer ones have only their own part
                yield from (Formula(name.equals(y)) for name, y in pair)

    def cases(self) -> Iterator[Block]:
        decision = self.answer.decision
        yield Heading("The proof of this program")
        for exclusion in decision.exclusions:
            sentence: list[str | Math] = []
            for evidence in exclusion.evidence:
                sentence += ["; ", *reason(evidence, self.formulas)]
                if isinstance(evidence, NoInvariant | NoRationalOmega) and evidence.prime is not None:
                    sentence.append(f", for polynomials of degree at most {evidence.degree}")
            yield say(f"Not {_CASES[exclusion.structure]}: ", *sentence[1:], ".")
        if decision.undecided is not None:
            known = "Liouvillian solutions exist" if self.answer.assumed else "Undecided"
            yield say(f"{known}: {decision.undecided}.")
        elif decision.structure is None:
            yield say("Nothing is left but SL2(C): the equation has no Liouvillian solution, and this is a proof.")
        elif decision.series is not None:
            yield say(
                "A theta of the paper's families has a P: the two-term recurrence for its coefficients terminates."
            )
        elif decision.invariant is not None:
            yield say(f"There is {_BY_INVARIANT[decision.structure]}. So it is {_CASES[decision.structure]}:")
            yield Formula(self.formulas.named("F", rational_form(decision.invariant, self.problem)))
        else:
            yield say(
                "There is no invariant of degree 2, so at most one omega is rational; its expansion at one place "
                f"determines it, and it exists. So it is {_CASES[decision.structure]}."
            )

    def certificate(self) -> Iterator[Block]:
        """theta and P, or for a P that is too long its powers."""
        form, series, case = self.answer.semi_invariant, self.answer.series, self.answer.case
        assert case is not None
        P = self.P
        yield Heading(f"theta and {P} of the answer")
        if series is not None:
            powers = powers_in(series, self.formulas)
            yield say(self.degree(case), " is the degree of ", Math.of(P), ", which is of ", *powers, ".")
            yield Formula(self.formulas.named("theta", series.theta))
            yield from self._constants()
        if form is not None:
            names = separated(" and ", map(Math.of, ("theta", P)))
            yield say(self.degree(case), f" = {form.P.degree}, and with ", *names, ":")
            yield Formula(self.formulas.named("theta", form.theta))
            yield Formula(self.formulas.named(P, form.P))

    def omega(self) -> Iterator[Block]:
        """omega, or its polynomial; one that would fill screens by its recurrence."""
        riccati, form = self.answer.riccati, self.answer.semi_invariant
        assert riccati is not None
        assert form is not None
        omega = omega_math(riccati, self.formulas)
        w, m, P = self.formulas.unknown, riccati.degree, self.P
        yield Heading("omega = y'/y")
        if m == 1:
            sum_of_two = Math(f"omega = theta + {P}'/{P}", rf"\omega = \theta + \frac{{{P}'}}{{{P}}}")
            yield Formula(sum_of_two.equals(omega))
        else:
            yield say(f"omega is a root {w} of the irreducible polynomial of degree {m}")
            if len(omega.text) <= 5 * MOST_CHARACTERS or form.degree != m:
                yield Formula(omega)
            else:
                text = f"sum_(k=0)^{m} (-1)^k e_k {w}^({m}-k) = 0"
                yield Formula(Math(text, rf"\sum_{{k=0}}^{{{m}}} (-1)^k e_k {w}^{{{m}-k}} = 0"))
                yield say("with ", Math.of(f"m = {m}"), " and")
                yield from map(Formula, _OMEGA_BY_RECURRENCE)
        yield from self._constants()

    def _constants(self) -> Iterator[Block]:
        if self.answer.constants is not None:
            text = self.answer.constants.to_str(self.formulas.symbol)
            yield say(f"where {self.formulas.symbol} is a root of ", Math(caret(text), latex_text(text)), ".")

    def closed_form(self) -> Iterator[Block]:
        found, notes = solutions_of(self.answer)
        if found:
            yield Heading("Solutions" if self.answer.case else "Solutions in special functions")
        for name, y in found:
            yield Formula(name.equals(y.shortened))
        yield from (say(f"Note: {note}.") for note in notes)

    def group(self) -> Iterator[Block]:
        group = derived.group(self.answer)
        if group is None:
            return
        yield Heading("The Galois group")
        order = ""  # for an infinite order, and for one without a lower bound
        if group.order is not None:
            order = f", of order {digits(group.order)}"
        elif group.order_at_least is not None:
            order = f", of order at least {group.order_at_least} if it is finite"
        name = Math(group.name, group.latex)
        about = f", {group.description}{order}: {group.ground.value}."
        yield say("The differential Galois group of the normal form is ", name, about)
        given = derived.equation_group(self.answer) if self.answer.gauge else None
        if given is not None:
            yield say(f"The group of the equation as given, in GL2: {given.name}.")
        if derived.is_algebraic(self.answer):
            yield say("All solutions are algebraic functions.")

    def check(self) -> Iterator[Block]:
        checks = derived.verification(self.answer).checks
        rows = [[check.statement, "passed" if check.passed else "FAILED"] for check in checks]
        if rows:
            yield Heading("Checks by independent code")
            yield Table(("statement", "result"), rows)

    def bibliography(self) -> Iterator[Block]:
        yield Heading("References")
        yield from (say(reference.text()) for reference in references(self.answer))


def rational_form(form: SemiInvariant, problem: Problem) -> RatFunc:
    """P times powers of the factors of the poles, the residues of theta: the rational function F."""
    R = (form.theta * problem.D).num
    F = RatFunc(form.P)
    for place in problem.finite_places:
        F = F * RatFunc(place.factor) ** logarithmic_residue(problem, R, place)
    return F
