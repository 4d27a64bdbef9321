"""Jumps of formulas at points where the solutions don't jump.

A formula that satisfies the equation wherever it is analytic is a solution on an interval if y and y' are continuous there.
They are on a ball on which every part of the formula is finite, and no argument of a function with a branch cut meets this
cut, unless it is real all along and not zero: principal values are continuous on the cut itself.  An interval on which that
isn't seen is halved, down to a short one, whose ends are compared, unless the equation is singular between them.
Bessel functions and others of which pairs of solutions are made count as continuous.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, pairwise
from typing import Any

import sympy
from flint import acb, arb, fmpq, fmpz_poly
from sympy.core.function import AppliedUndef

from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.precision import working_precision
from kovacic.closed_form.cuts import cut_of, cuts_of
from kovacic.general_solution.zero import known_jet, opposite, samples
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
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
    *(sympy.Integral, sympy.hyper, sympy.besselj, sympy.bessely, sympy.besseli, sympy.besselk, sympy.jn, sympy.yn),
    *(sympy.airyai, sympy.airybi, sympy.airyaiprime, sympy.airybiprime, sympy.legendre, sympy.assoc_legendre),
    *(sympy.gegenbauer, sympy.jacobi, sympy.hermite, sympy.laguerre, sympy.assoc_laguerre, sympy.elliptic_k),
    *(sympy.elliptic_e, sympy.elliptic_f, sympy.elliptic_pi, sympy.mathieuc, sympy.mathieus, sympy.mathieucprime),
    *(sympy.mathieusprime, AppliedUndef),
)


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
        inside = set().union(*(e.free_symbols for e in (*y.atoms(sympy.Function, sympy.Pow), *coefficients)))
        first = next(samples(y.free_symbols - {x}))
        second = first | opposite({s: value for s, value in first.items() if s in inside})
        for numbers in [first, *([second] if second != first else [])]:
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
        if all(map(self._is_singular_on, self._cuts)):
            return False
        for a, b in pairwise(self._points()):
            suspects = islice(self._suspects(a, b, _HALVINGS), _MOST_SUSPECTS)
            for left, right in suspects:
                is_ordinary = self._is_ordinary(arb(left).union(arb(right)))
                if is_ordinary and any(self._differ(left, right, order) for order in (0, 1)):
                    return True
        return False

    def _is_singular_on(self, cut: Expr) -> bool:
        """True if the equation is singular wherever a rational argument changes sign; elsewhere it stays off or along the cut.

        An analytic function that satisfies the equation on a part of an interval without singular points does so on the whole.
        """
        if not cut.is_rational_function(self.x):
            return False
        polynomial = sympy.Poly(sympy.Mul(*cut.as_numer_denom()), self.x)  # zeros and poles
        if not (polynomial.domain.is_ZZ or polynomial.domain.is_QQ):
            return False
        integers = polynomial.clear_denoms(convert=True)[1].all_coeffs()[::-1]
        zeros = complex_zeros(fmpz_poly([int(c) for c in integers]))
        return not any(self._is_ordinary(zero.real) for zero, _ in zeros if zero.imag == 0)

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

    def _is_ordinary(self, here: Any) -> bool:
        """True if the coefficients are analytic on a real ball."""
        return self._is_analytic(acb(here), self.coefficients, cuts_of(sympy.Tuple(*self.coefficients), self.x))

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
