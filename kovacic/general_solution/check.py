"""Checks of an answer as it is returned: the equation at a point, the conditions at theirs, and no infinities.

Letters have values that fit their assumptions.  Where the right-hand side jumps, the equation is checked between the jumps,
and y and y' at them; an unknown function on the right stands for any function, and is replaced by an exponential one.  A limit
at a singular point or at infinity is refuted by values near it, where these aren't lost to cancellation.

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
from math import inf
from types import MappingProxyType
from typing import Any

import sympy
from flint import acb, arb, fmpq
from sympy import Integral, Tuple
from sympy.core.function import AppliedUndef
from sympy.functions.special.bessel import AiryBase, BesselBase
from sympy.functions.special.polynomials import OrthogonalPolynomial

from kovacic.algebra.precision import working_digits, working_precision
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.cuts import cut_of, cuts_of
from kovacic.closed_form.jets import ANTIDERIVATIVES, MATHIEU, jet
from kovacic.closed_form.order import between
from kovacic.closed_form.steps import JUMPING, break_points, in_steps, on_piece, split_at_jumps
from kovacic.errors import VerificationFailed
from kovacic.general_solution.behaviour import Approach, have_values, is_refuted
from kovacic.general_solution.conditions import Condition, symbols_of
from kovacic.general_solution.question import Question
from kovacic.general_solution.zero import NOT_EVALUATED, ball_of, generic_samples, known_jet, opposite, residual_at
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
_NOT_FINITE = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}
#: A residual is taken for zero below this multiple of the size of its terms.
_RESIDUAL_TOLERANCE = arb(10) ** (-DIGITS // 2)

#: Functions that aren't steps or impulses, and aren't analytic either.
_CORNERS = tuple(function for function in JUMPING if function not in (sympy.Heaviside, sympy.DiracDelta))
#: Points beyond the first pole of tan(x/2) on either side, off the usual special points.
_GRID_POINTS = tuple(fmpq(p, 100) for p in (-713, -437, -219, -83, 41, 127, 271, 483, 731))
#: The precision in bits where jumps are looked for.
_BITS_FOR_JUMPS = 100
#: Halvings of an interval before its ends are compared, and again during the comparison.
_INTERVAL_HALVINGS = 12
#: Short intervals that are compared between two points: a formula along the cut itself has hundreds, a jump a few.
_MOST_SUSPECTS = 8

#: Parts that are taken for entire functions: integrals that are left, and the functions of which pairs of solutions are made.
_OPAQUE = (
    *(*ANTIDERIVATIVES, *MATHIEU, BesselBase, AiryBase, OrthogonalPolynomial),
    *(sympy.hyper, sympy.assoc_legendre, sympy.elliptic_k, AppliedUndef),
)


@dataclass(frozen=True)
class SolutionClaim:
    """y satisfies a y'' + b y' + c y = f, with a = 0 for an equation of first order, and conditions: in the user's symbols."""

    x: Expr
    y: Expr
    #: a, b, c, f.
    coefficients: Sequence[Expr]
    conditions: Sequence[Condition]
    #: The name of the equation in messages.
    equation: Any

    @cached_property
    def rates(self) -> list[Expr]:
        """b/a, c/a and f/a; c/b and f/b for an equation of first order."""
        leading, *others = self.coefficients if self.coefficients[0] != 0 else self.coefficients[1:]
        return [part / leading for part in others]

    def at(self, numbers: Mapping[Expr, Expr]) -> SolutionClaim:
        """The claim with numbers for letters."""
        y, *coefficients = (e.xreplace(numbers) for e in (self.y, *self.coefficients))
        conditions = [condition.in_symbols(numbers) for condition in self.conditions]
        return replace(self, y=y, coefficients=coefficients, conditions=conditions)

    def failed(self, what: str) -> VerificationFailed:
        """The exception for a wrong answer."""
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
        # Numbers for symbols that are integers or not positive; other symbols have values by their names.  They are to give
        # the answer a value: it is one for generic letters, and a small integer needn't be generic.
        known = set().union(*(part.free_symbols for part in (self.y, *self.coefficients))) | symbols_of(self.conditions)
        special = {s for s in known if s.is_integer or s.is_nonpositive}
        tried = generic_samples(special, natural)
        numbers = next((numbers for numbers in tried if is_finite(self.y.xreplace(numbers))), {})
        unchecked = self._test(
            "the equation", lambda: _is_wrong_at(self.at(numbers), start and start.xreplace(numbers))
        )
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
        """A notice if the test can't be carried out.  Raises `VerificationFailed` if the answer fails it."""
        try:
            fails = is_wrong()
        except NOT_EVALUATED as error:
            is_explained = isinstance(error, NotImplementedError)  # the messages of other errors are no help
            reason = error if is_explained else "a part of it can't be evaluated"
            return [f"the answer wasn't put into {what}, numerically: {reason}"]
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
    """One sentence per check that could not be carried out.  Raises `VerificationFailed` for a wrong answer: a defect.

    `value` is the answer in the variable of the question, `start` an ordinary point on the side that is meant; `limits` has the
    points of conditions on limits, with the side.  The answer holds where the integer `natural` isn't negative, and with these
    expressions for `letters`.
    """
    coefficients = [*map(question.own, question.coefficients)]
    claim = SolutionClaim(question.x, value, coefficients, question.conditions, question.equation).at(letters)
    unchecked = claim.check(start, limits, natural=natural)
    parts = [claim.y, *claim.rates]
    if question.function.args[0].is_positive:  # the whole line, where x = exp(t)
        parts = [part.subs(question.x, sympy.exp(question.x)) for part in parts]
    if jumps(parts[0], question.x, parts[1:]):
        unchecked.append(
            "the formula jumps at an ordinary point of the equation: it is a solution between such points only"
        )
    return unchecked


def is_finite(value: Expr) -> bool:
    """True if neither nan nor an infinity occurs, except as a bound of an integral."""
    parts = (value.function,) if isinstance(value, Integral) else value.args
    return value not in _NOT_FINITE and all(map(is_finite, parts))


def _is_wrong_at(claim: SolutionClaim, start: Expr | None) -> bool:
    """True if the residual is provably not zero at a point.  Raises one of `NOT_EVALUATED` if it can't be computed."""
    x = claim.x
    letters = claim.y.free_symbols - {x}  # of integrals that aren't in the integrand of another one
    definite = [integral for integral in claim.y.atoms(Integral) if integral.free_symbols <= letters]
    claim = claim.at(dict.fromkeys(definite, sympy.S.One))  # they are factors of y1 and y2

    def is_wrong(y: Expr, coefficients: Sequence[Expr], point: Any) -> bool:
        miss, scale = residual_at(point, x, y, coefficients)
        return bool(miss > _RESIDUAL_TOLERANCE * scale)

    with working_digits(DIGITS):
        if not Tuple(*claim.coefficients).has(*JUMPING, AppliedUndef):
            base = acb(fmpq(23, 71), fmpq(41, 89)) if start is None else ball_of(start)
            return is_wrong(claim.y, claim.coefficients, base + arb(fmpq(3, 707)))  # the start itself may be special
        claim = _with_sample_values(claim)
        breaks = break_points(Tuple(claim.y, claim.coefficients[-1]), x)
        points = between(breaks)
        whole = (_antiderivatives(claim.y, x), *claim.coefficients)
        for point in points:
            y, *coefficients = (on_piece(part, x, point) for part in whole)
            if is_wrong(y, coefficients, ball_of(point)):
                return True
        return any(_is_wrong_across(claim, *sides) for sides in zip(breaks, points, points[1:], strict=False))


def _is_wrong_across(claim: SolutionClaim, point: Expr, *sides: Expr) -> bool:
    """True if y, or y' for an equation of second order, jumps otherwise than the impulses demand at an ordinary point."""
    x = claim.x
    *rates, f = claim.rates
    apart = split_at_jumps(in_steps(f, x), x) if have_values(rates, x, point) else None
    # nothing is known for impulses of higher order
    if apart is None or max((0, *chain.from_iterable(apart.impulses.values()))) >= len(rates):
        return False
    at = ball_of(point)
    here = apart.impulses.get(point, {})
    # y jumps by the strength q of delta', and y' by that of delta less (b/a) q
    wanted = [jet(here.get(order, sympy.S.Zero), x, at)[0] for order in reversed(range(len(rates)))]
    if here and len(rates) == 2:
        wanted[1] -= jet(rates[0], x, at)[0] * wanted[0]
    y = _antiderivatives(claim.y, x, point)
    if Tuple(*y.atoms(Integral)).has(*JUMPING):  # of which no value is known on either side
        return False
    before, after = (jet(on_piece(y, x, side), x, at)[: len(rates)] for side in sides)
    bound = _RESIDUAL_TOLERANCE * sum(map(abs, (*before, *after)), arb(1))
    sides_and_jump = zip(before, after, wanted, strict=True)
    return any(bool(abs(right - left - jump) > bound) for left, right, jump in sides_and_jump)


def _with_sample_values(claim: SolutionClaim) -> SolutionClaim:
    """The claim with values of the parameters, and with exponential functions for unknown ones on the right."""
    whole = Tuple(claim.y, *claim.coefficients)
    whole = whole.xreplace(next(generic_samples(whole.free_symbols - {claim.x})))
    for k, function in enumerate(sorted({f.func for f in whole.atoms(AppliedUndef)}, key=str)):
        whole = whole.replace(function, lambda u, k=k: sympy.exp(sympy.Rational(k + 1, 3) * u))
    y, *coefficients = whole.replace(sympy.Derivative, lambda *args: sympy.Derivative(*args).doit())
    return replace(claim, y=y, coefficients=coefficients)


def _antiderivatives(value: Expr, x: Expr, start: Expr | None = None) -> Expr:
    """The value with antiderivatives for integrals from a point to x; near `start` with first terms for those from there."""

    def other(e: Expr) -> Expr:
        s, *ends = e.limits[0]
        if len(ends) != 2 or ends[1] != x:
            return e
        return e.function.subs(s, start) * (x - start) if ends[0] == start else Integral(e.function.subs(s, x), x)

    return value.replace(Integral, lambda *args: other(Integral(*args)))


def _is_violated(claim: SolutionClaim, condition: Condition, numbers: dict[Expr, Expr]) -> bool:
    """True if the two sides of a condition provably differ.  Raises as `_is_wrong_at` does."""
    assert condition.value is not None
    x = claim.x
    y = in_steps(claim.y, x) if claim.y.has(*_CORNERS) else claim.y  # |x| is -x just before 0
    total = (condition.of(y, x) - condition.value).xreplace(numbers)
    # Unknown numbers, except for factors that may stand before one integral and in another.
    unknown = {}
    for e in total.atoms(Integral):
        if e.limits[0][1:]:
            factor, rest = e.function.as_independent(e.variables[0], as_Add=False)
            unknown[e] = factor * sympy.Symbol(f"{rest}{e.limits}")
    total = total.xreplace(unknown)
    # parameters on which a step depends, with values on either side of it as a rule
    symbols = Tuple(*total.atoms(sympy.Heaviside)).free_symbols
    with working_digits(2 * DIGITS):
        for steps in generic_samples(symbols):
            found = jet(total.xreplace(steps), sympy.Dummy(), acb(0))[0]
            if not found.is_finite():
                raise NotImplementedError("a value isn't finite")
            if abs(found) > _RESIDUAL_TOLERANCE:
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
    with working_precision(_BITS_FOR_JUMPS):
        # The sign of a letter outside of functions and powers moves no jump.
        inside = Tuple(*y.atoms(sympy.Function, sympy.Pow), *coefficients).free_symbols
        first = next(generic_samples(y.free_symbols - {x}))
        second = first | opposite({s: value for s, value in first.items() if s in inside})
        for numbers in [first, second][: 1 + (second != first)]:
            here = y.xreplace(numbers)
            # The terms of each `RootSum`: with roots to 30 digits they lie on the same sides of cuts.
            sums = {e: sympy.Add(*map(e.fun, e.poly.nroots(30))) for e in here.atoms(sympy.RootSum)}
            if _Course(x, here.xreplace(sums), [e.xreplace(numbers) for e in coefficients]).jumps_somewhere():
                return True
    return False


@dataclass(frozen=True)
class _Course:
    """A formula with numbers for its letters, and the coefficients of its equation, along the real axis."""

    x: Expr
    y: Expr
    coefficients: Sequence[Expr]

    def jumps_somewhere(self) -> bool:
        """True for a jump at an ordinary point of the equation between two of the points that functions suggest."""
        pairs = pairwise(self._points())
        found = (islice(self._suspects(a, b, _INTERVAL_HALVINGS), _MOST_SUSPECTS) for a, b in pairs)
        return any(
            self._is_analytic(left, right, self.coefficients)
            and not self._is_on_a_cut(left, right)
            and any(self._differ(left, right, order) for order in (0, 1))
            for left, right in chain.from_iterable(found)
        )

    def _points(self) -> list[Any]:
        """The grid, and points on both sides of each real x at which a linear argument is real, or a tangent has a pole."""
        points = {*_GRID_POINTS}
        for e in self.y.atoms(sympy.Function, sympy.Pow):
            is_tangent = e.func in (sympy.tan, sympy.cot)
            line = sympy.expand((e.args[0] if is_tangent else cut_of(e)) or 0)
            if not line.is_polynomial(self.x) or sympy.degree(line, self.x) != 1:
                continue
            m, c = (complex(line.coeff(self.x, k)) for k in (1, 0))
            # m x + c is real there, or about pi/2
            place = (1.58 - c.real) / m.real if is_tangent else -c.imag / (m.imag or inf)
            rounded = fmpq(round(100 * place), 100)
            points |= {rounded - fmpq(37, 100), rounded + fmpq(37, 100)}
        return sorted(points)

    def _suspects(self, a: Any, b: Any, halvings: int) -> Iterator[tuple[Any, Any]]:
        """The short intervals on which the formula isn't seen to be continuous."""
        check_time()
        if self._is_analytic(a, b, [self.y]):
            return
        if halvings == 0:
            yield a, b
            return
        middle = (3 * a + 4 * b) / 7
        yield from self._suspects(a, middle, halvings - 1)
        yield from self._suspects(middle, b, halvings - 1)

    def _is_analytic(self, a: Any, b: Any, functions: Sequence[Expr]) -> bool:
        """True if all functions are finite from a to b, with no argument on a cut, or continuous along one."""
        here = acb(arb(a).union(arb(b)))
        for cut in cuts_of(Tuple(*functions), self.x):
            found = known_jet(cut, self.x, here)
            if not found or not found[0].is_finite() or found[0].contains(0):
                return False
            # off the axis from -oo to 0, or real: of balls, == and != may both be false
            if not (found[0].imag == 0 or not found[0].imag.contains(0) or found[0].real > 0):
                return False
        values = (known_jet(e, self.x, here) for e in functions)
        return all(found and found[0].is_finite() and found[1].is_finite() for found in values)

    def _is_on_a_cut(self, a: Any, b: Any) -> bool:
        """True where the equation isn't real, as beside log(x) for x < 0: there solutions may have a cut of their own."""
        here = acb(arb(a).union(arb(b)))
        found = (known_jet(cut, self.x, here) for cut in cuts_of(Tuple(*self.coefficients), self.x))
        return any(u and bool(u[0].imag == 0 and u[0].real < 0) for u in found)

    def _differ(self, a: Any, b: Any, order: int) -> bool:
        """True if the values of y, or of y', at the ends of ever shorter intervals stay apart."""

        def value(point: Any) -> Any:
            found = known_jet(self.y, self.x, acb(arb(point)))
            return found[order] if found else acb("nan")

        left, right = value(a), value(b)
        first = abs(right - left)
        for _ in range(_INTERVAL_HALVINGS):
            c = (3 * a + 4 * b) / 7
            middle = value(c)
            if bool(abs(middle - left) > abs(right - middle)):
                b, right = c, middle
            else:
                a, left = c, middle
        rest = abs(right - left)
        return bool(rest > first / 4) and bool(rest > arb(2) ** (-_BITS_FOR_JUMPS // 2) * (1 + abs(left)))
