"""The form in which two solutions are written.  Every door shows what `chosen_form` chooses here; nothing else decides.

An equation with Liouvillian solutions has several forms: elementary functions with their kin (Ei, erf, logarithms over roots);
special functions, which are those of a standard equation with its actual parameters and, in case 3, Klein's; y1 times an
integral that is left.  Each `PairForm` knows its kind and about its length from its data, before SymPy computes anything.

The order: among the forms of at most `MOST_CHARACTERS` characters, or `FACTOR` times the length of the shortest, an elementary
one comes before special functions, and these come before an integral; among equals the shorter one.  Where the written pair
loses more than half of 30 digits in the middle of the domain, a form of at most twice its length that doesn't comes first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from enum import IntEnum
from fractions import Fraction
from functools import partial
from itertools import pairwise
from sys import maxsize
from typing import Any

from flint import acb, arb, ctx, fmpq
from sympy import Heaviside, Integral, Rational, Symbol, Tuple, sympify

from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.precision import working_digits
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.check import independent, is_nonzero, is_numerical_solution
from kovacic.closed_form.cuts import arguments_with_cuts, common_place, real_at
from kovacic.closed_form.form import EXACT, ClosedForm, one_exponential, pair_at, written
from kovacic.closed_form.jets import jet
from kovacic.closed_form.primitive import FACTOR, LONG, OpenPrimitive
from kovacic.closed_form.product import written_length
from kovacic.closed_form.structure import ClosedStructure, Covariants, Triangular, build
from kovacic.closed_form.terminating import hypergeometric_pair
from kovacic.compatibility import cached_property
from kovacic.decision import Decision, TerminatingSeries
from kovacic.errors import LimitExceeded, VerificationFailed
from kovacic.limits import MOST_CHARACTERS, Budget, check_time
from kovacic.numbers.numerals import as_text
from kovacic.special.gauss import klein_pullback
from kovacic.special.pullback import GaugeTransform, Pullback
from kovacic.special.search import find, find_transform, pair_for
from kovacic.special.writer import Wanted

#: The working precision of the formula that is to be stable, in digits; half of them are to be left.
_STABLE_DIGITS = 30
#: Characters that a term of a polynomial has at least, as + x**2.
_TERM = 4
#: Characters up to which a pair counts as stable: of the published ones none loses half of the digits, whatever its length.
_ALWAYS_STABLE = 400

UNSTABLE = (
    f"of {_STABLE_DIGITS} digits more than half are lost in these formulas by cancellation; `at` has proven values"
)


class FormKind(IntEnum):
    """Among short forms the one with the lower number is preferred."""

    ELEMENTARY = 0
    SPECIAL = 1
    INTEGRAL = 2


@dataclass(frozen=True)
class PairForm:
    """A form of two solutions: its kind, how many characters both take (about, until it is written), and how it is written."""

    kind: FormKind
    length: int
    write: Callable[[], ClosedForm | None] = field(compare=False)
    pair: ClosedForm | None = None


def best(forms: list[PairForm]) -> PairForm:
    """The preferred one by kind and length."""
    bound = max(MOST_CHARACTERS, FACTOR * min(form.length for form in forms))
    return min((form for form in forms if form.length <= bound), key=lambda form: (form.kind, form.length))


def shortest(forms: Sequence[Any]) -> Any:
    """The preferred one of equal SymPy expressions: without an integral before those with one, then the shorter text.

    With a step at a the shift x - a counts as one letter: sin(2*(x - 1)) H(x - 1) is shorter than sin(2*x - 2) H(x - 1).
    """
    forms = [*dict.fromkeys(forms)]
    if len(forms) == 1:
        return forms[0]
    given = []
    for form in forms:
        kind = FormKind.INTEGRAL if form.has(Integral) else FormKind.ELEMENTARY
        text = as_text(form)
        for step in form.atoms(Heaviside):
            u = as_text(step.args[0])
            text = text.replace(f"({u})", "x").replace("Heavisidex", f"Heaviside({u})")
        given.append(PairForm(kind, len(text), lambda: None))
    return forms[given.index(best(given))]


def chosen_form(
    S: RatFunc,
    decision: Decision,
    gauge: RatFunc,
    variable: str = "x",
    budget: Budget | None = None,
    *,
    places: Sequence[Fraction] = (),
) -> ClosedForm:
    """Two independent solutions of the equation that was given, in the chosen form, checked.

    `gauge` is the logarithmic derivative of the factor between them and those of y'' = S y, -b/(2a) for the equation
    a z'' + b z' + c z = 0, and 0 for the normal form.  Where S is real and has real solutions of a known form, these are
    returned: real at the `common_place`, one of the `places` if the variable is a function that has only some values.

    Raises `ValueError` if the equation has no Liouvillian solution or is undecided, and `VerificationFailed` if a solution
    doesn't pass its check, which is a defect of this package; `LimitExceeded` within `Budget.watched`.

    >>> import kovacic
    >>> answer = kovacic.solve("2/x^2 - 1")
    >>> form = chosen_form(answer.S, answer.decision, answer.gauge)
    >>> form.y1, form.checked
    ((x*cos(x) - sin(x))/x, 'exact')
    """
    if decision.case is None:
        raise ValueError(decision.undecided or "there is no Liouvillian solution")
    chosen = _Equation(S, decision, gauge, variable, budget or Budget()).chosen()
    return chosen if decision.series is not None else _real(chosen, S, places)


def _real(form: ClosedForm, S: RatFunc, places: Sequence[Fraction]) -> ClosedForm:
    """The form, or one that is real at the place at which the fewest of its arguments have to be turned."""
    if form.place is not None:
        return form
    pair, x = (form.y1, form.y2), form.variable
    place = common_place(x, arguments_with_cuts(Tuple(*pair)), among=[*map(Rational, places)])
    y1, y2 = real_at(pair, x, S, form.gauge, place, anew=partial(pair_at, form, place, sympify))
    return form if (y1, y2) == pair else replace(form, y1=y1, y2=y2, place=place)


@dataclass(frozen=True)
class _Equation:
    """S and the gauge of an equation, and what was decided."""

    S: RatFunc
    decision: Decision
    gauge: RatFunc
    variable: str
    budget: Budget

    @cached_property
    def structure(self) -> ClosedStructure:
        return build(self.S, self.decision, self.gauge)

    @cached_property
    def _is_long(self) -> bool:
        """True if the polynomial of the certificate alone takes more characters than any short form is preferred to."""
        semi = self.decision.semi_invariant
        return semi is not None and sum(map(bool, semi.P)) > FACTOR * MOST_CHARACTERS // (2 * _TERM)

    def chosen(self) -> ClosedForm:
        """The preferred pair, checked; or one that keeps its digits and isn't much longer; with a note if there is no such."""
        if self.decision.series is not None:
            return self._with_a_long_polynomial(self.decision.series)
        # In case 3 Klein's form comes after the pull-back's own parameters, and so does a polynomial of many terms.
        is_first = self.decision.case == 3 or self._is_long
        forms = self._special_forms(self._source()) if is_first else self._own_forms()
        found = best(forms) if forms else None
        kinds = FormKind if is_first else (FormKind.ELEMENTARY,)
        if found is None or found.length > MOST_CHARACTERS or found.kind not in kinds:
            forms += self._own_forms() if is_first else self._special_forms(self._source())
        chosen, first = self._written_best(forms)
        most = 2 * chosen.length
        pair = first
        while chosen.length > _ALWAYS_STABLE and not self._is_stable(pair):
            forms = [form for form in forms if form is not chosen and form.length <= most]
            if not forms:
                return replace(first, notes=(*first.notes, UNSTABLE))
            chosen, pair = self._written_best(forms)
        return pair

    def _with_a_long_polynomial(self, series: TerminatingSeries) -> ClosedForm:
        """exp(int theta) P and a second solution; two special functions, if they are found, where theta isn't over K."""
        source = None if series.theta.field == self.S.field else self._source()
        with suppress(LimitExceeded):
            found = source and self._in_special_functions(source)
            if found:
                return found
        atoms = Atoms(Symbol(self.variable))
        pair = hypergeometric_pair(series, self.S, self.gauge, atoms)
        return self._form(pair, notes=(*atoms.notes,))

    def _form(self, pair: tuple[Any, Any], **known: Any) -> ClosedForm:
        """A checked pair, with further facts about it."""
        made = partial(build, self.S, self.decision, self.gauge)
        return ClosedForm(*pair, Symbol(self.variable), self.gauge, EXACT, build=made, **known)

    def _own_forms(self) -> list[PairForm]:
        """The forms of the structure itself, and y1 times an unevaluated integral as an alternative to a long evaluated one."""
        structure = self.structure
        check_time()
        if isinstance(structure, Covariants):
            pullback = klein_pullback(structure)
            if not pullback.gives(self.S):
                raise VerificationFailed(f"Klein's invariant of S = {self.S} isn't right; please report the equation")
            return self._special_forms(pullback)
        is_left = isinstance(structure, Triangular) and isinstance(structure.primitive, OpenPrimitive)
        kind = FormKind.INTEGRAL if is_left else FormKind.ELEMENTARY
        structures = [(kind, structure)]
        if isinstance(structure, Triangular) and not is_left and structure.length > MOST_CHARACTERS:
            left = replace(structure, primitive=OpenPrimitive(LONG.format(structure.length)))
            structures.append((FormKind.INTEGRAL, left))
        return [
            PairForm(kind, form.length, partial(written, form, self.S, self.gauge, self.variable))
            for kind, form in structures
        ]

    def _source(self) -> Pullback | GaugeTransform | None:
        """A pull-back, or a gauge transform of one, of a standard equation with its actual parameters."""
        return find(self.S, self.budget, extended=False).pullback or find_transform(self.S, self.budget)

    def _special_forms(self, source: Pullback | GaugeTransform | None) -> list[PairForm]:
        """The solutions of that standard equation."""
        if source is None:
            return []
        parts = (source.f,) if isinstance(source, Pullback) else (source.pullback.f, source.a, source.b)
        return [PairForm(FormKind.SPECIAL, 4 * written_length(parts), partial(self._in_special_functions, source))]

    def _in_special_functions(self, source: Pullback | GaugeTransform) -> ClosedForm | None:
        """The pair, with y1 kept if it is elementary and short; None if the two aren't known to be independent."""
        found = pair_for(Wanted(self.S, self.gauge, self.variable, joined=True), source)
        if found is None:
            return None
        pair = found.y1, found.y2
        mixed: list[tuple[Any, Any]] = []
        x = Symbol(self.variable)
        is_short = self.decision.series is None and not self._is_long
        if self.decision.case == 1 and is_short and isinstance(self.structure, Triangular):
            y1 = one_exponential(display(self.structure.first, Atoms(x), around_zero=True))
            if _length(y1) <= max(map(_length, pair)) and is_numerical_solution(y1, x, self.S, self.gauge):
                mixed = [(y1, y2) for y2 in pair]
        # In an irreducible equation what differs by its exponents is independent.
        is_sure = self.decision.case != 1 or (found.wronskian is not None and is_nonzero(found.wronskian, x))
        chosen = independent(mixed, x) or pair if is_sure else independent([*mixed, pair], x)
        if chosen is None:
            return None
        place = found.place if chosen == pair else None
        return self._form(chosen, undefined=found.undefined, place=place)

    def _written_best(self, forms: list[PairForm]) -> tuple[PairForm, ClosedForm]:
        """The preferred form by its true length and kind, which are known once it is written.

        With a long one the shortest is written, too, since its true length is the measure.
        """
        while True:
            chosen = form = best(forms)
            if chosen.pair is not None:
                if chosen.length > MOST_CHARACTERS:
                    form = min(forms, key=lambda other: other.length)
                if form.pair is not None:
                    return chosen, chosen.pair
            forms.remove(form)
            pair = form.write()
            if pair is not None:
                kind = FormKind.INTEGRAL if any(y.has(Integral) for y in pair) else form.kind
                forms.append(PairForm(kind, sum(map(_length, pair)), form.write, pair))
            elif not forms:
                forms += self._own_forms()

    def _is_stable(self, pair: ClosedForm) -> bool:
        """True if the balls of both solutions, computed with 30 digits, keep half of these."""
        den = self.S.den
        if not isinstance(den, RationalPoly):
            return True
        with working_digits(_STABLE_DIGITS):
            point = _middle_of_the_domain(den)
            return all(jet(y, pair.variable, point)[0].rel_accuracy_bits() > ctx.prec // 2 for y in pair)


def _length(y: Any) -> int:
    """Length in characters; `maxsize` if an integer is too long for Python to write."""
    try:
        return len(str(y))
    except ValueError:
        return maxsize


def _middle_of_the_domain(den: RationalPoly) -> Any:
    """A point near the middle of the longest interval between real singular points; near 1 to the right of a single one."""
    real = sorted((zero.real for zero, _ in complex_zeros(den.rep.numer()) if zero.imag == 0), key=float) or [arb(0)]
    intervals = [*pairwise(real)] or [(real[0], real[0] + 2)]
    left, right = max(intervals, key=lambda ends: float(ends[1] - ends[0]))
    width = right - left
    # Off the axis, where the cuts of roots and logarithms often lie.
    return acb((left + right) / 2 + width * fmpq(1, 37), width * fmpq(1, 41)).mid()
