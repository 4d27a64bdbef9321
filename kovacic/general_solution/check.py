"""The whole question, put to the answer: the equation at a point, the conditions where they are given; and no infinities.

What is checked is what is returned, in the user's symbols, at values of the parameters that fit their assumptions.  Where the
right-hand side jumps, the equation is checked between the jumps, and y and y' at them; a function that is given by its name
stands for any function, and is tried with an exponential one.  A limit at a singular point or at infinity is refuted by values
near it, where these aren't lost to cancellation.

A formula that satisfies the equation wherever it is analytic is a solution on an interval if y and y' are continuous there.
They are on a ball on which every part of the formula is finite, and no argument of a function with a branch cut meets this
cut, unless it is real all along and not zero: principal values are continuous on the cut itself.  An interval on which that
isn't seen is halved, down to a short one, whose ends are compared, unless the equation is singular between them.
Bessel functions and others of which pairs of solutions are made count as continuous.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain, islice, pairwise
from types import MappingProxyType
from typing import Any

import sympy
from flint import acb, arb, fmpq
from sympy.core.function import AppliedUndef
from sympy.functions.special.bessel import AiryBase, BesselBase
from sympy.functions.special.polynomials import OrthogonalPolynomial

from kovacic.algebra.precision import working_digits, working_precision
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.cuts import cut_of, cuts_of
from kovacic.closed_form.jets import ANTIDERIVATIVES, MATHIEU, jet
from kovacic.errors import VerificationFailed
from kovacic.general_solution.behaviour import Approach, have_values, is_refuted
from kovacic.general_solution.question import Condition, Question
from kovacic.general_solution.steps import JUMPING, between, break_points, in_steps, on_piece, split_at_jumps
from kovacic.general_solution.zero import NOT_EVALUATED, ball, fitting_samples, known_jet, opposite, residual, samples
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
_NOT_FINITE = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}
#: The distance from the point that is meant, at which the equation is tested.
_SAMPLE_STEP = fmpq(3, 7 * 101)
#: How small a residual is, by the size of its terms.
_SMALL = arb(10) ** (-DIGITS // 2)
#: How many values of the integers are tried.
_SAMPLES = 6
#: Functions that aren't steps or impulses, and aren't analytic either.
_CORNERS = tuple(function for function in JUMPING if function not in (sympy.Heaviside, sympy.DiracDelta))
Acb = Any  # flint's acb
#: Beyond the first pole of tan(x/2) on either side, off the usual special points.
_GRID_POINTS = tuple(fmpq(p, 100) for p in (-713, -437, -219, -83, 41, 127, 271, 483, 731))
#: How far beyond a place where an argument may cross a cut the formula is followed.
_BEYOND = fmpq(37, 100)
#: Bits, and how often an interval is halved before its ends are compared, and while they are.
_BITS = 100
_HALVINGS = 12
_COMPARISONS = 12
#: How many short intervals are compared between two points: a formula along the cut itself has hundreds, a jump a few.
_MOST_SUSPECTS = 8

#: What stands for entire functions here: integrals that are left, and the functions of which pairs of solutions are made.
_OPAQUE = (
    *(*ANTIDERIVATIVES, *MATHIEU, BesselBase, AiryBase, OrthogonalPolynomial),
    *(sympy.hyper, sympy.assoc_legendre, sympy.elliptic_k, AppliedUndef),
)


@dataclass(frozen=True)
class SolutionClaim:
    """y satisfies a y'' + b y' + c y = f, with a = 0 for an equation of first order, and conditions: in the user's symbols."""

    x: Expr
    y: Expr
    coefficients: tuple[Expr, Expr, Expr, Expr]
    conditions: Sequence[Condition]
    #: What messages call the equation.
    equation: Any

    @classmethod
    def of(cls, question: Question, value: Expr) -> SolutionClaim:
        """The answer `value` in the variable of the question."""
        a, b, c, f = map(question.own, question.coefficients)
        return cls(question.x, value, (a, b, c, f), question.conditions, question.equation)

    @cached_property
    def rates(self) -> list[Expr]:
        """b/a, c/a and f/a; c/b and f/b for an equation of first order."""
        leading, *others = self.coefficients if self.coefficients[0] != 0 else self.coefficients[1:]
        return [part / leading for part in others]

    def at(self, numbers: Mapping[Expr, Expr]) -> SolutionClaim:
        """The claim with numbers for letters."""
        y, a, b, c, f = (e.xreplace(numbers) for e in (self.y, *self.coefficients))
        conditions = [condition.in_symbols(numbers) for condition in self.conditions]
        return replace(self, y=y, coefficients=(a, b, c, f), conditions=conditions)

    def failed(self, what: str) -> VerificationFailed:
        """The exception for an answer that is wrong."""
        return VerificationFailed(f"an answer for {self.equation} {what}; please report the equation: {self.y}")

    def check(
        self,
        start: Expr | None = None,
        limits: Mapping[Expr, Approach] = MappingProxyType({}),
        *,
        natural: Expr | None = None,
    ) -> list[str]:
        """As `check_answer`, but for jumps at ordinary points."""
        if not is_finite(self.y):
            raise self.failed("has no value")
        # Numbers for symbols that are integers or not positive; other symbols have values by their names.  The answer has a
        # value for them, if such are found: it is for generic ones, and a small integer needn't be generic.
        known = set().union(*(part.free_symbols for part in (self.y, *self.coefficients, *self.conditions)))
        special = {s for s in known if s.is_integer or s.is_nonpositive}
        tried = islice(fitting_samples(special, natural), _SAMPLES)
        numbers = next((numbers for numbers in tried if is_finite(self.y.xreplace(numbers))), {})
        beside = None if start is None else start.xreplace(numbers)
        unchecked = self._test("the equation", lambda: _is_wrong_at(self.at(numbers), beside))
        for condition in self.conditions:
            place = limits.get(condition.points[0])
            if place is None:
                unchecked += self._test(condition.text, partial(_is_violated, self, condition, numbers))
                continue
            part = self.y.diff(self.x, condition.terms[0].order).xreplace(numbers)
            if is_refuted(condition.value, part, self.x, place):
                raise self.failed(f"doesn't satisfy {condition.text}")
        return unchecked

    def _test(self, what: str, is_wrong: Callable[[], bool]) -> list[str]:
        """The notices for a test that can't be carried out.  Raises `VerificationFailed` if the answer fails it."""
        try:
            fails = is_wrong()
        except NOT_EVALUATED as reason:
            # the messages of other errors are no help
            is_said = isinstance(reason, NotImplementedError)
            said = str(reason) if is_said else "a part of it can't be evaluated"
            return [f"the answer wasn't put into {what}, numerically: {said}"]
        if fails:
            raise self.failed(f"doesn't satisfy {what}")
        return []


def check_answer(
    question: Question,
    value: Expr,
    start: Expr | None = None,
    limits: Mapping[Expr, Approach] = MappingProxyType({}),
    *,
    natural: Expr | None = None,
    letters: Mapping[Expr, Expr] = MappingProxyType({}),
) -> list[str]:
    """What couldn't be checked, in a sentence each.  Raises `VerificationFailed` where the answer isn't one: a defect.

    `value` is the answer in the variable of the question, `start` an ordinary point on the side that is meant, and `limits`
    says where conditions are on limits, and from which side.  The answer holds where the integer `natural` isn't negative, and
    with these expressions for `letters`.
    """
    claim = SolutionClaim.of(question, value).at(letters)
    unchecked = claim.check(start, limits, natural=natural)
    parts = [claim.y, *claim.rates] if cuts_of(claim.y, question.x) else []
    if question.function.args[0].is_positive:  # the whole line, where x = exp(t)
        parts = [part.subs(question.x, sympy.exp(question.x)) for part in parts]
    if parts and jumps(parts[0], question.x, parts[1:]):
        unchecked.append(
            "the formula jumps at an ordinary point of the equation: it is a solution between such points only"
        )
    return unchecked


def is_finite(value: Expr) -> bool:
    """True if neither nan nor an infinity occurs, except as a bound of an integral."""
    if isinstance(value, sympy.Integral):
        return is_finite(value.function)
    return value not in _NOT_FINITE and all(map(is_finite, value.args))


def _is_wrong_at(claim: SolutionClaim, start: Expr | None) -> bool:
    """True if the residual is provably not zero at a point.  Raises one of `NOT_EVALUATED` if it can't be computed."""
    x = claim.x
    letters = claim.y.free_symbols - {x}  # of integrals that aren't in the integrand of another one
    definite = [integral for integral in claim.y.atoms(sympy.Integral) if integral.free_symbols <= letters]
    claim = claim.at(dict.fromkeys(definite, sympy.Integer(1)))  # they are factors of y1 and y2
    with working_digits(DIGITS):
        if not sympy.Tuple(*claim.coefficients).has(*JUMPING, AppliedUndef):
            base = acb(fmpq(23, 71), fmpq(41, 89)) if start is None else ball(start)
            return _is_large(claim, claim.y, base + arb(_SAMPLE_STEP))
        claim = _sampled(claim)
        breaks = break_points(sympy.Tuple(claim.y, claim.coefficients[-1]), x)
        points = between(breaks)
        y = _antiderivatives(claim.y, x)
        for point in points:
            here = replace(claim, coefficients=tuple(on_piece(part, x, point) for part in claim.coefficients))
            if _is_large(here, on_piece(y, x, point), acb(fmpq(int(point.p), int(point.q)))):
                return True
        return any(_is_wrong_across(claim, *sides) for sides in zip(breaks, points, points[1:], strict=False))


def _is_wrong_across(claim: SolutionClaim, point: Expr, *sides: Expr) -> bool:
    """True if y, or y' for an equation of second order, jumps between two sides otherwise than the impulses demand.

    False at a singular point of the equation, where any jump is right, and where impulses are of higher order.
    """
    x = claim.x
    *rates, f = claim.rates
    apart = split_at_jumps(in_steps(f, x), x) if have_values(rates, x, point) else None
    if apart is None or any(n >= len(rates) for here in apart.impulses.values() for n in here):
        return False
    at = ball(point)
    here = apart.impulses.get(point, {})
    # that of y first: by the impulses of the highest order
    wanted = [jet(here.get(order, sympy.S.Zero), x, at)[0] for order in reversed(range(len(rates)))]
    if here and len(rates) == 2:
        wanted[1] -= jet(rates[0], x, at)[0] * wanted[0]
    y = _antiderivatives(claim.y, x, point)
    if sympy.Tuple(*y.atoms(sympy.Integral)).has(*JUMPING):  # of which no value is known on either side
        return False
    before, after = (jet(on_piece(y, x, side), x, at)[: len(rates)] for side in sides)
    scale = sum(map(abs, (*before, *after)), arb(1))
    sides_and_jump = zip(before, after, wanted, strict=True)
    return any(bool(abs(right - left - jump) > _SMALL * scale) for left, right, jump in sides_and_jump)


def _sampled(claim: SolutionClaim) -> SolutionClaim:
    """With values of the parameters, and with exponential functions for those that are given by their names."""
    whole = sympy.Tuple(claim.y, *claim.coefficients)
    whole = whole.xreplace(next(islice(samples(whole.free_symbols - {claim.x}), 1, None)))
    for k, function in enumerate(sorted({f.func for f in whole.atoms(AppliedUndef)}, key=str)):
        whole = whole.replace(function, lambda u, k=k: sympy.exp(sympy.Rational(k + 1, 3) * u))
    y, a, b, c, f = whole.replace(sympy.Derivative, lambda *args: sympy.Derivative(*args).doit())
    return replace(claim, y=y, coefficients=(a, b, c, f))


def _antiderivatives(value: Expr, x: Expr, start: Expr | None = None) -> Expr:
    """With antiderivatives for integrals up to x, up to constants; for those from `start` on, their first terms there."""

    def other(e: Expr) -> Expr:
        s, first, _ = e.limits[0]
        if first == start:
            return e.function.subs(s, start) * (x - start)
        return sympy.Integral(e.function.subs(s, x), x)

    # those from a point to x
    return value.replace(
        lambda e: isinstance(e, sympy.Integral) and len(e.limits[0]) == 3 and e.limits[0][-1] == x, other
    )


def _is_large(claim: SolutionClaim, y: Expr, point: Any) -> bool:
    """True if the residual of y is seen not to be zero at a point."""
    miss, scale = residual(point, claim.x, y, claim.coefficients)
    return bool(miss > _SMALL * scale)


def _is_violated(claim: SolutionClaim, condition: Condition, numbers: dict[Expr, Expr]) -> bool:
    """True if the two sides of a condition provably differ.  Raises as `_is_wrong_at` does."""
    assert condition.value is not None
    x = claim.x
    y = in_steps(claim.y, x) if claim.y.has(*_CORNERS) else claim.y  # |x| is -x just before 0
    total = (condition.of(y, x) - condition.value).xreplace(numbers)
    # Numbers that aren't known, but for factors that may stand before one and in another.
    unknown = {
        e: e.function.as_independent(e.variables[0], as_Add=False)
        for e in total.atoms(sympy.Integral)
        if e.limits[0][1:]
    }
    total = total.xreplace({e: factor * sympy.Symbol(f"{rest}{e.limits}") for e, (factor, rest) in unknown.items()})
    # parameters on which a step depends, with values on either side of it as a rule
    symbols = sympy.Tuple(*total.atoms(sympy.Heaviside)).free_symbols
    tried = islice(samples(symbols), _SAMPLES if symbols else 1)
    with working_digits(2 * DIGITS):
        for steps in tried:
            found = jet(total.xreplace(steps), sympy.Dummy(), acb(0))[0]
            if not found.is_finite():
                raise NotImplementedError("a value isn't finite")
            if abs(found) > _SMALL:
                return True
    return False


# -------------------------------------------------------------------------------------------------------------- jumps


def jumps(y: Expr, x: Expr, coefficients: Sequence[Expr]) -> bool:
    """True if y or y' provably jumps, for real x, where none of the coefficients b/a, c/a, f/a is singular.

    Letters have values that fit their assumptions, and in functions those of either sign where it isn't known.

    >>> x = sympy.Symbol("x")
    >>> jumps(sympy.atan(2 * sympy.tan(x / 2)), x, [x]), jumps(sympy.log(x), x, [1 / x])
    (True, False)
    """
    # An entire function for each opaque part: the rest jumps, or doesn't, beside any continuous functions.
    parts = sorted((e for e in y.atoms(*_OPAQUE) if e.has(x)), key=str)
    y = y.xreplace({e: sympy.cos(x * (k + 1) / 3) for k, e in enumerate(parts)})
    if not cuts_of(y, x):
        return False
    with working_precision(_BITS):
        # The sign of a letter outside, as a constant's, moves no jump.
        inside = sympy.Tuple(*y.atoms(sympy.Function, sympy.Pow), *coefficients).free_symbols
        first = next(samples(y.free_symbols - {x}))
        second = first | opposite({s: value for s, value in first.items() if s in inside})
        for numbers in [first, second][: 1 + (second != first)]:
            here = y.xreplace(numbers)
            # The terms of each `RootSum`: with roots to 30 digits they lie on the same sides of cuts.
            sums = {e: sympy.Add(*map(e.fun, e.poly.nroots(30))) for e in here.atoms(sympy.RootSum)}
            if _Course(x, here.xreplace(sums), [e.xreplace(numbers) for e in coefficients]).jumps_somewhere():
                return True
    return False


def _is_beside_cut(cut: Acb) -> bool:
    """True if a ball stays off the axis from -oo to 0, or is real and excludes 0."""
    if not cut.is_finite() or cut.contains(0):
        return False
    return bool(cut.imag == 0 or not cut.imag.contains(0) or cut.real > 0)


@dataclass(frozen=True)
class _Course:
    """A formula with numbers for its letters, and the coefficients of its equation, along the real axis."""

    x: Expr
    y: Expr
    coefficients: Sequence[Expr]

    @cached_property
    def _cuts(self) -> list[Expr]:
        return cuts_of(self.y, self.x)

    def jumps_somewhere(self) -> bool:
        """Between two of the points that the arguments of its functions suggest."""
        found = (islice(self._suspects(a, b, _HALVINGS), _MOST_SUSPECTS) for a, b in pairwise(self._points()))
        own_cuts = cuts_of(sympy.Tuple(*self.coefficients), self.x)
        return any(
            self._is_analytic(acb(arb(left).union(arb(right))), self.coefficients, own_cuts)  # an ordinary point
            and any(self._differ(left, right, order) for order in (0, 1))
            for left, right in chain.from_iterable(found)
        )

    def _points(self) -> list[Any]:
        """The grid, and points on both sides of each real x at which a linear argument is real, or a tangent has a pole."""
        points = {*_GRID_POINTS}
        for e in self.y.atoms(sympy.Function, sympy.Pow):
            place = _crossing(e, self.x)
            if place is not None and not _GRID_POINTS[0] < place < _GRID_POINTS[-1]:
                points |= {place - _BEYOND, place + _BEYOND}
        return sorted(points)

    def _suspects(self, a: Any, b: Any, halvings: int) -> Iterator[tuple[Any, Any]]:
        """The short intervals on which the formula isn't seen to be continuous."""
        check_time()
        if self._is_analytic(acb(arb(a).union(arb(b))), [self.y], self._cuts):
            return
        if halvings == 0:
            yield a, b
            return
        middle = (3 * a + 4 * b) / 7
        yield from self._suspects(a, middle, halvings - 1)
        yield from self._suspects(middle, b, halvings - 1)

    def _is_analytic(self, here: Acb, functions: Sequence[Expr], cuts: Sequence[Expr]) -> bool:
        """True if all functions are finite on a real ball, with no argument on a cut, or continuous along one."""
        arguments = (known_jet(cut, self.x, here) for cut in cuts)
        if not all(found and _is_beside_cut(found[0]) for found in arguments):
            return False
        values = (known_jet(e, self.x, here) for e in functions)
        return all(found and found[0].is_finite() and found[1].is_finite() for found in values)

    def _differ(self, a: Any, b: Any, order: int) -> bool:
        """True if the values of y, or of y', at the ends of ever shorter intervals stay apart."""
        left, right = (self._value(p, order) for p in (a, b))
        first = abs(right - left)
        for _ in range(_COMPARISONS):
            c = (3 * a + 4 * b) / 7
            middle = self._value(c, order)
            if bool(abs(middle - left) > abs(right - middle)):
                b, right = c, middle
            else:
                a, left = c, middle
        rest = abs(right - left)
        return bool(rest > first / 4) and bool(rest > arb(2) ** (-_BITS // 2) * (1 + abs(left)))

    def _value(self, point: Any, order: int) -> Acb:
        """Not finite where it isn't known."""
        found = known_jet(self.y, self.x, acb(arb(point)))
        return found[order] if found else acb("nan")


def _crossing(e: Expr, x: Expr) -> Any:
    """The x, rounded, at which an argument m x + c is real, or a tangent of it has its first pole; None for others."""
    is_tangent = e.func in (sympy.tan, sympy.cot)
    argument = e.args[0] if is_tangent else cut_of(e)
    if argument is None:
        return None
    line = sympy.expand(argument)
    if not line.is_polynomial(x) or sympy.degree(line, x) != 1:
        return None
    m, c = (complex(line.coeff(x, k)) for k in (1, 0))
    if is_tangent:
        return fmpq(round((1.58 - c.real) / m.real * 100), 100)
    return fmpq(round(-c.imag / m.imag * 100), 100) if m.imag else None
