"""Conditions as the theorem that a paper prints: hypothesis, cases, groups, solutions, Delta_d, what proves it, references.

"Let ... The equation ... has Liouvillian solutions if and only if one of the following holds": each case where none of those
before holds.  Text, Markdown and HTML have headings, as for `explain`; LaTeX has the environments theorem and proof.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

import sympy

from kovacic.algebra.function_field import FunctionField
from kovacic.decision import Structure
from kovacic.equation import PI, Equation
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, MOST_CHARACTERS, Budget
from kovacic.parametric import prose
from kovacic.parametric.assumptions import WORDS
from kovacic.parametric.claims import IntegerFamily
from kovacic.parametric.formulas import in_partial_fractions, shortest_form, unexpanded
from kovacic.parametric.integers import INTEGER_LETTERS
from kovacic.parametric.natural import WITHOUT_FORMULA, Natural
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.regions import (
    Case,
    ParameterRegion,
    RegionVerdict,
    charts_of,
    solvable_cases,
    vanishing,
    within,
)
from kovacic.parametric.restriction import spelled
from kovacic.parametric.riemann import Schwarz
from kovacic.parametric.solutions import (
    Carried,
    PolynomialSolution,
    SolutionRow,
    families_of,
    general_formula,
    rows_of,
    weight_by_signs,
)
from kovacic.parametric.statements import Both, Either, Statement, Vanishes
from kovacic.reading.names import words_among
from kovacic.reading.read import read_input
from kovacic.reading.source import source_of
from kovacic.views.bibliography import literature
from kovacic.writing.document import Block, Formula, Heading, Sentence, Table, format_of, say
from kovacic.writing.formula import Formulas, Math, caret, free_name, generated_field, latex_text, of_sympy, separated

#: Letters for the signs in a solution; those of parameters are skipped.
_SIGN_LETTERS = ("epsilon", "zeta", "eta", "kappa", "iota", "tau", "upsilon", "chi")
_PROOF_HEADING = Heading("Proof")
_REFERENCES = Heading("References")
_NOUNS = ("integer", "half-integer")


def theorem_text(answer: ParametricAnswer, *, format: str = "text") -> str:
    """The theorem as "text", "markdown", "latex" (the body of a document that defines theorem and proof) or "html".

    Raises `ValueError` for another format.
    """
    chosen = format_of(format)
    written = blocks(answer)
    if chosen.environment is None:
        return chosen.document(f"y'' = {answer.right.text}", written)
    start, end = written.index(_PROOF_HEADING), written.index(_REFERENCES)
    # The references keep their heading.
    environments = ("theorem", written[1:start]), ("proof", written[start + 1 : end])
    parts = [chosen.environment(name, chosen.render(inside)) for name, inside in environments]
    return "\n".join([*parts, f"{{{chosen.render(written[end:])}\\par}}\n"])


def blocks(answer: ParametricAnswer) -> list[Block]:
    """The theorem, and what it rests on."""
    return [*_TheoremWriter(answer).blocks()]


class _TheoremWriter:
    def __init__(self, answer: ParametricAnswer) -> None:
        self.answer = answer
        self.change = answer.equation and answer.equation.change
        self.is_solvable = answer.generic.known and answer.generic.case is not None
        self.cases = solvable_cases(answer.regions)
        self.left_out = [region for region in answer.regions if not region.verdict.known]
        self.signs = [sign for sign in map(sympy.Symbol, _SIGN_LETTERS) if sign.name not in answer.parameters]

    def blocks(self) -> Iterator[Block]:
        cases = self.cases
        yield Heading("Theorem", 1)
        yield from self._hypothesis(self._claim(cases))
        for k, case in enumerate(cases, 1):
            yield from self._case(case, f"({k}) " if len(cases) > 1 else "")
        if self.is_solvable:
            otherwise = "Otherwise" if cases else "For all values"
            if self.answer.complete is not True:
                otherwise += ", for generic values,"
            yield say(f"{otherwise} it is case {self.answer.generic.case}. ", *_group(self.answer.generic))
        yield from self._exceptions()
        equation = self.answer.equation
        if equation is not None and (self.change or not equation.is_normal_form):
            of = " of the normal form" * (not equation.is_normal_form)
            over: list[str | Math] = []
            if self.change:  # the field isn't C(x)
                over = [" over ", generated_field(self.change.expression)]
            yield say(f"Cases and groups are those{of}", *over, ".")
        yield from self._delta(cases)
        yield from self._proof()

    # The hypothesis

    def _hypothesis(self, claim: str) -> Iterator[Block]:
        """The equation and, in the same sentence, the claim."""
        equation = self.answer.equation
        given = self._given()
        yield say(*self._about_parameters(), "The equation")
        v = self._unknown
        normal_form = self._normal_form(v)
        is_seen = given is None or given.text.replace("*", " ") == normal_form.text.replace("*", " ")
        if equation is None or (equation.is_normal_form and not equation.change and is_seen):
            yield Formula(given or normal_form)
            yield say(claim)
            return
        expanded = Math.of(str(equation))
        yield Formula(given or expanded)
        start: list[str | Math] = []
        if given and equation.change:
            yield say("is, in ", self._changed_variable(), ", the equation")
            yield Formula(expanded)
            start = ["which "]
        elif equation.change:
            given_variable = Math.of(equation.change.variable)
            start = ["in ", self._changed_variable(), " (", given_variable, " is the variable that was given) "]
        if v == equation.unknown:
            without = "" if equation.is_homogeneous else ", without its right-hand side,"
            yield say(*start, f"has{without} the normal form")
        else:
            without = "" if equation.is_homogeneous else " and without its right-hand side"
            yield say(*start, "becomes, with ", self._substitution(v), f"{without}, its normal form")
        yield Formula(normal_form)
        yield say(f"{'Each of these equations' if equation.is_homogeneous else 'The normal form'} {claim}")

    def _given(self) -> Math | None:
        """The equation as the user wrote it, if its text can be read again; None also for a letter in place of a constant."""
        answer = self.answer
        if any(map(str.isidentifier, answer.constant.names)):
            return None
        names = words_among(answer.parameters)
        with Budget(answer.limits).watched(), suppress(InputError, LimitExceeded):
            source = source_of(answer.given, self._variable, answer.limits, names=names)
            read, _ = spelled(
                read_input(answer.given, var=self._variable, limits=answer.limits, exponentials=True, names=names)
            )
            is_same = read.S.to_str(read.variable) == answer.S.to_str(answer.variable)
            if is_same and _equation_key(read.equation) == _equation_key(answer.equation):
                return unexpanded(source)
        return None

    @property
    def _unknown(self) -> str:
        """The unknown of the normal form: y if that is the equation itself."""
        equation = self.answer.equation
        if equation is None or not equation.gauge:
            return "y"
        return free_name({equation.unknown, *self.answer.parameters}, "v", "u", "z")

    def _about_parameters(self) -> list[str | Math]:
        """`Let a and b be complex numbers, b > 0, a != 1. `; nothing without parameters."""
        names = [name for name in self.answer.parameters if name != PI]
        if not names:
            return []
        kind = " be a complex number" if len(names) == 1 else " be complex numbers"
        sentence: list[str | Math] = ["Let ", *_enumerated([Math.of(name) for name in names]), kind]
        for name in names:
            sentence += self._assumed(name)
        for region in filter(_is_unequal, self.left_out):
            assert isinstance(region.statement, Vanishes)
            sentence += [", ", prose.equation_of_zeros(region.statement.function, "!=")]
        return [*sentence, ". "]

    def _exceptions(self) -> Iterator[Block]:
        """The values that are left out, except those that the hypothesis excludes."""
        for region in self.left_out:
            if _is_unequal(region):
                continue
            why = f"not decided, {region.complete}" if region.defined else "the equation isn't defined there"
            yield say("Values with ", *_sentence_of(region.statement), f" are left out: {why}.")

    def _assumed(self, name: str) -> list[str | Math]:
        """`, n a nonnegative integer, E > 0`."""
        found: list[str | Math] = []
        assumed = self.answer.assumptions.of(name).words
        words = [word for word in assumed if word in WORDS]
        if words:
            # The adjectives, and then the noun: nonnegative integer.
            nouns = [word for word in words if word in _NOUNS]
            usual = "number" if {"even", "odd"}.isdisjoint(words) else "integer"
            kind = " ".join([*(word for word in words if word not in _NOUNS), *(nouns or [usual])])
            article = "an" if kind[0] in "aeio" else "a"
            found += [", ", Math.of(name), f" {article} {kind}"]
        for bound in (word for word in assumed if word not in WORDS):
            sign = bound.rstrip("0123456789/+-")
            found += [", ", Math.of(f"{name} {sign} {bound.removeprefix(sign)}")]
        return found

    def _changed_variable(self) -> Math:
        assert self.change
        expression = self.change.expression
        return Math.of(self.answer.variable).equals(Math(caret(expression), latex_text(expression)))

    def _substitution(self, v: str) -> Math:
        equation = self.answer.equation
        x = self.answer.variable
        assert equation is not None
        if not equation.gauge:
            return Math.of(equation.unknown).equals(Math.of(v))
        gamma = Formulas(x, equation.gauge.field).math(equation.gauge)
        text = f"{equation.unknown} = {v} exp(int ({gamma.text}) d{x})"
        latex = rf"{equation.unknown} = {v} \exp \int {gamma.latex} \, d{latex_text(x)}"
        return Math(text, latex)

    def _normal_form(self, y: str) -> Math:
        S = self.answer.S
        if not (isinstance(S.field, FunctionField) and S):
            return Math.of(f"{y}''").equals(Formulas(self.answer.variable, S.field).times(S, y))
        fractions = Math.of(in_partial_fractions(S, self.answer.variable))
        right = Math(f"({fractions.text}) {y}", rf"\left({fractions.latex}\right) {latex_text(y)}")
        return Math.of(f"{y}''").equals(right)

    # The claim

    def _claim(self, cases: list[Case]) -> str:
        is_complete = self.answer.complete is True
        if self.is_solvable:
            return "has Liouvillian solutions for all these values. More precisely:"
        if not cases:
            generic = "" if is_complete else " for generic values"
            return f"has no Liouvillian solution{generic}."
        which = "the following holds" if len(cases) == 1 else "one of the following holds"
        if not is_complete:
            return f"has Liouvillian solutions if {which}, and none for other generic values:"
        order = "" if len(cases) == 1 else " (each case where none of those before it holds)"
        return f"has Liouvillian solutions if and only if {which}{order}:"

    def _case(self, case: Case, number: str) -> Iterator[Block]:
        rows = _table_rows(case)
        without = _without(case.without)
        if rows:
            yield say(f"{number}one row of the table holds", *without, ":")
            yield Table(("where", "condition"), rows)
        else:
            yield say(number, *_sentence_of(case.statement), *without, ".")
        # The relevant rows of Schwarz's table, for exponent differences that depend on the parameters.
        for part in _schwarz_in(case.statement):
            names, differences = part.resolved()
            heads: list[Sentence] = [Math.of(name) for name in names]
            if not names:
                heads = ["differences up to order, signs and integers", "sum of the integers"]
            yield Table(["group", *heads], [[structure.value, *values] for structure, values in differences])
        region = case.regions[0]
        yield say(f"Case {region.case}. ", *_group(region.verdict))
        yield from self._solutions(case)

    # Solutions

    def _solutions(self, case: Case) -> Iterator[Block]:
        blocks = [[*self._solutions_in(region, case)] for region in case.regions]
        if all(block == blocks[0] for block in blocks):
            yield from blocks[0]
            return
        before: list[Vanishes] = []
        for region, block in zip(case.regions, blocks, strict=True):
            if block:
                meeting = [one for one in before if within(one, charts_of(region.statement))]
                yield say("For ", *_sentence_of(region.statement), *_without(meeting), ":")
            yield from block
            before += vanishing([region.statement])

    def _solutions_in(self, region: ParameterRegion, case: Case) -> Iterator[Block]:
        """The formulas for one region."""
        naturals = region.naturals
        if naturals and naturals[0].m == 1:
            yield from self._with_determinant(region, naturals[0])
            yield from _determinant_table(naturals[0], len(region.determinants))
            return
        solutions = [*region.solution()]
        families = families_of(region.statement.claim) if case.statement == region.statement else []
        letters = region.formulas.letters if isinstance(region.formulas, Carried) else ()
        rows = [rows_of(solutions, family, letters) for family in families]
        if rows and all(rows):
            for family, found in zip(families, rows, strict=True):
                yield from self._in_rows(family, found, are_several=len(rows) > 1)
            poles = prose.poles_in_words(families)
            if not poles:
                return
            yield say(*prose.phrase(f"For {' or '.join(poles)}:"))
        if len(solutions) > 2:  # one formula with symbols for the signs
            together = general_formula(region.formulas, self.signs)
            if together is not None:
                solutions = [together]
        for solution in solutions:
            yield from self._with_degree(solution, case)

    def _in_rows(self, family: IntegerFamily, rows: list[SolutionRow], *, are_several: bool) -> Iterator[Block]:
        """A formula for each progression of integers."""
        n = family.letter
        start = f"`{prose.equals(family.parameter, family.value, n)}`, " if are_several else ""
        for row in rows:
            progression, roots = row.numbers.without(pole.root for pole in family.poles)
            without = "".join(f", `{n} != {shortest_form(root, n)}`" for root in roots)
            yield say(*prose.phrase(f"For {start}{progression.said(n)}{without}:"))
            yield Formula(self._named_solution(row.solution))

    def _with_degree(self, solution: PolynomialSolution, case: Case) -> Iterator[Block]:
        """A formula, maybe with symbols for signs, and the condition that its degree, a letter, is a natural number."""
        if not solution.degree.free_symbols:
            yield Formula(self._named_solution(solution))
            return
        names = re.findall(r"[^\W\d]\w*", case.statement.text())
        taken = [*map(str, solution.y.free_symbols), *self.answer.parameters, *names]
        letter = sympy.Symbol(free_name(taken, *INTEGER_LETTERS))
        y = solution.y.xreplace({solution.degree: letter})
        degree = of_sympy(self._collected(solution.degree))
        if y.has(letter):
            degree = Math.of(letter.name).equals(degree)
        yield Formula(self._named_solution(replace(solution, y=y)))
        exclusion = solution.exclusion(letter.name) if y.has(letter) else ()
        signs = _choice_of_signs(self._signs_in(solution))
        yield say("where ", degree, " is a natural number", *exclusion, *signs, ".")

    def _with_determinant(self, region: ParameterRegion, natural: Natural) -> Iterator[Block]:
        """exp(int theta) P for the exponents of the region; P has the degree d."""
        from kovacic.engine.places import analyse

        P = sympy.Symbol(f"P_{natural.letter}")
        weight = weight_by_signs(analyse(natural.S, Budget(DEFAULT_LIMITS)), self.answer.variable)
        solution = None if weight is None or weight.signs > len(self.signs) else weight.general(self.signs)
        if solution is None:
            return
        if isinstance(region.formulas, Carried):
            solution = next(region.formulas.of([solution]))
        yield Formula(self._named_solution(replace(solution, y=P * solution.y)))
        degree = Math.of(natural.letter).equals(of_sympy(self._collected(solution.degree)))
        is_changed = self._variable != self.answer.variable
        in_t: list[str | Math] = [" in ", Math.of(self.answer.variable)] if is_changed else []
        signs = _choice_of_signs(self._signs_in(solution))
        yield say("with a polynomial ", Math.of(P.name), *in_t, " of degree ", degree, *signs, ".")

    def _signs_in(self, solution: PolynomialSolution) -> list[sympy.Symbol]:
        """The symbols for signs that occur in a formula or its degree."""
        symbols = solution.y.free_symbols | solution.degree.free_symbols
        return [sign for sign in self.signs if sign in symbols]

    def _named_solution(self, solution: PolynomialSolution) -> Math:
        """`y = ...`, with exponents as one fraction, and the variable first in sums."""
        y = solution.y.replace(
            lambda e: e.is_Pow and e.exp.free_symbols & {*self.signs},
            lambda e: sympy.Pow(e.base, self._collected(e.exp), evaluate=False),
        )
        return Math.of("y").equals(of_sympy(y, first=sympy.Symbol(self._variable)))

    @property
    def _variable(self) -> str:
        """The user's variable."""
        return self.change.variable if self.change else self.answer.variable

    def _collected(self, expression: sympy.Expr) -> sympy.Expr:
        """A sum as one fraction whose numerator is sorted by the signs: -(epsilon*(c - 1) + zeta*(a + b - c) + 1)/2."""
        by_sign = sympy.collect(sympy.expand(expression), self.signs, evaluate=False)
        terms: list[tuple[sympy.Rational, sympy.Expr]] = []
        for sign, coefficient in by_sign.items():  # a minus goes to the number, not to the rest
            number, other = sympy.factor(coefficient).as_coeff_Mul()
            is_turned = other.could_extract_minus_sign()
            terms.append((-number, -other * sign) if is_turned else (number, other * sign))
        if len(terms) < 2:
            return expression
        below = sympy.ilcm(1, *(number.q for number, _ in terms))
        outside = -1 if all(number < 0 for number, _ in terms) else 1
        above = sympy.Add(*(outside * below * number * rest for number, rest in terms))
        factor = sympy.Rational(outside, below)
        return above if factor == 1 else sympy.Mul(factor, above, evaluate=False)

    # Delta_d

    def _delta(self, cases: list[Case]) -> Iterator[Block]:
        """The definition of Delta_d."""
        # The letter of the degree, by the degree m of the invariant.
        naturals = [natural for case in cases for region in case.regions for natural in region.naturals]
        letters = {natural.m: natural.letter for natural in reversed(naturals)}
        for m, letter in sorted(letters.items()):
            if m == 1:
                yield from self._delta_of_omega(letter)
                continue
            what = f" for an invariant of degree {m} says that there is a rational function of x that is "
            what += f"a form of degree {m} in two solutions and has "
            yield say(Math.of(f"Delta_{letter}").equals(Math("0", "0")), what, Math.of(letter), " zeros.")

    def _delta_of_omega(self, d: str) -> Iterator[Block]:
        """The equation of the polynomial of degree d for a rational omega."""
        P = f"P_{d}"
        determinants = (
            determinant
            for region in self.answer.regions
            for natural in region.naturals
            for k in range(len(region.determinants))
            for determinant in natural.determinants(k)
        )
        solvable = ", has a solution"
        if any(
            determinant.system for determinant in determinants
        ):  # one that is printed stands for several polynomials
            solvable += " (all of the polynomials in parentheses vanish, where there are several)"
        what = " vanishes exactly where the linear system for the coefficients of "
        yield say(Math.of(f"Delta_{d}"), what, Math.of(P), ", of degree ", Math.of(d), f"{solvable}:")
        yield Formula(Math.of(f"{P}'' + 2 theta {P}' + (theta' + theta^2 - S) {P} = 0"))
        yield say("with ", Math.of("theta"), " the logarithmic derivative of ", Math.of(f"{self._unknown}/{P}"), ".")

    # The proof

    def _proof(self) -> Iterator[Block]:
        answer = self.answer
        yield _PROOF_HEADING
        where = "" if answer.complete is True else f"{answer.complete} "
        yield say(f"The list is complete {where}(", *prose.phrase(answer.theory.literal), ").")
        for notice in answer.notices:
            if not notice.startswith(f"in {answer.variable} = "):
                yield say(f"Note: {notice}.")
        yield _REFERENCES
        keys = [*answer.theory.sources]
        if any(_schwarz_in(case.statement) for case in self.cases):
            keys.append("Kim69")
        known = [key for key in dict.fromkeys(keys) if key in literature()] or ["Kov86"]
        yield from (say(literature()[key].text()) for key in known)


def _equation_key(equation: Equation | None) -> tuple[str, str]:
    """An equation, over any field, and its change of variable."""
    if equation is None:
        return "", ""
    return str(equation), equation.change.expression if equation.change else ""


def _enumerated(parts: list[Math]) -> list[str | Math]:
    """`a, b and c`."""
    if len(parts) < 2:
        return [*parts]
    return [*separated(", ", parts[:-1]), " and ", parts[-1]]


def _choice_of_signs(signs: list[sympy.Symbol]) -> list[str | Math]:
    """`, with a choice of epsilon and zeta from +-1`."""
    if not signs:
        return []
    return [", with a choice of ", *_enumerated([Math.of(sign.name) for sign in signs]), " from ", Math.of("+-1")]


def _group(verdict: RegionVerdict) -> list[str | Math]:
    """Its name, and its identity component, for the theorem of Morales and Ramis."""
    component = verdict.identity_component
    return ["The group is ", *verdict.group_in_words, ". Its identity component is ", *component, "."]


def _sentence_of(statement: Statement) -> list[str | Math]:
    return [*prose.sentence(statement.claim)]


def _is_unequal(region: ParameterRegion) -> bool:
    return not region.defined and isinstance(region.statement, Vanishes)


def _without(others: Sequence[Statement]) -> list[str | Math]:
    """Statements that must not hold: `, and a != 1` if all of them are equations, else `, and not: ...` for each."""
    are_equations = len(vanishing(others)) == len(others)
    found: list[str | Math] = []
    for other in others:
        if are_equations and isinstance(other, Vanishes):
            found += [", and ", prose.equation_of_zeros(other.function, "!=")]
        else:
            found += [", and not: ", *_sentence_of(other)]
    return found


def _table_rows(case: Case) -> list[list[Sentence]]:
    """Rows for three or more alternatives "k = 3, and ..."; none for a statement of another form."""
    statement = case.statement
    parts = statement.parts if isinstance(statement, Either) else ()
    if len(parts) < 3:
        return []
    rows: list[list[Sentence]] = []
    for part in parts:
        if not isinstance(part, Both) or not isinstance(part.parts[0], Vanishes):
            return []
        equation, *others = part.conjuncts
        rows.append([_sentence_of(equation), _sentence_of(Both(tuple(others)))])
    return rows


def _schwarz_in(statement: Statement) -> list[Schwarz]:
    """The parts of a statement that need Schwarz's table: all but that of two half-integers."""
    parts: Iterable[Statement] = statement.parts if isinstance(statement, Both | Either) else (statement,)
    found = [part for part in parts if isinstance(part, Schwarz)]
    return [part for part in found if part.structures != (Structure.IMPRIMITIVE,)]


def _determinant_table(natural: Natural, number: int) -> Iterator[Block]:
    """The first determinants, as far as they can be printed: d, the places where it is the degree, and Delta_d in factors."""
    rows: list[list[Sentence]] = []
    delta = Math.of(f"Delta_{natural.letter}")
    for d in range(number):
        found = natural.values(d)
        if any(len(value) > MOST_CHARACTERS // 4 for value in found):  # too wide for a table
            break
        if {*found} == {WITHOUT_FORMULA}:
            yield say(delta, f" is {WITHOUT_FORMULA}.")
            return
        for value, places in found.items():
            shown: Sentence = value if value == WITHOUT_FORMULA else Math.of(value)
            rows.append([str(d), [*places], shown])
    if rows:
        yield Table([Math.of(natural.letter), "where", delta], rows)
