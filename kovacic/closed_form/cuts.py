"""Branch cuts: where the parts of a solution have them, and solutions that are real on a given side.

Solutions that are real where x - a > 0 needn't be where it is negative: log(u) = log(-u) + i pi and u^e = exp(i pi e) (-u)^e
for u < 0.  Often log(-u) and (-u)^e in their place give a solution, too; else elementary ones are rewritten with real roots.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import Any

import sympy
from flint import acb, fmpq
from sympy.core.traversal import iterargs
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import is_seen_negative
from kovacic.closed_form.check import are_independent, is_numerical_solution
from kovacic.closed_form.jets import jet
from kovacic.closed_form.structure import PLACES

Expr = Any  # SymPy publishes no types
#: Substitutes symbols that carry the assumptions.
Own = Callable[[Expr], Expr]
#: Where a pair is to be real: after the usual points, beyond all singular ones.
_TRIED_PLACES = (*map(sympy.Rational, PLACES), sympy.Integer(10**9), sympy.Integer(-(10**9)))
#: Functions with branch cuts, with the expression that is negative on the cut, or None if there is none.
_CUTS: dict[Any, Callable[[Expr], Expr | None]] = {
    **dict.fromkeys(
        (sympy.log, sympy.Ei, sympy.Ci, sympy.expint, sympy.uppergamma, sympy.lowergamma), lambda e: e.args[-1]
    ),
    **dict.fromkeys((sympy.atan, sympy.asinh), lambda e: 1 + e.args[-1] ** 2),
    sympy.acot: lambda e: 1 + e.args[-1] ** -2,
    **dict.fromkeys((sympy.asin, sympy.acos, sympy.atanh, sympy.acosh), lambda e: 1 - e.args[-1] ** 2),
    sympy.polylog: lambda e: 1 - e.args[-1],
    # zero where the argument is: what has a sign isn't analytic there
    **dict.fromkeys((sympy.Abs, sympy.sign, sympy.Heaviside), lambda e: e.args[0] ** 2),
}
#: Parts of solutions that are real on one side of a singular point, apart from Bessel and hypergeometric functions.
_TURNED_FUNCTIONS = (sympy.log, sympy.Ci, sympy.lowergamma, sympy.uppergamma, sympy.Pow)
#: For Bessel's functions of i z those of z with the same span.
_OF_IMAGINARY = {
    sympy.besselj: sympy.besseli,
    sympy.bessely: sympy.besselk,
    sympy.besseli: sympy.besselj,
    sympy.besselk: sympy.bessely,
}


def cut_of(e: Expr) -> Expr | None:
    """An expression that meets the axis from -oo to 0 where a function or a power has its branch cut; None without one."""
    if e.is_Pow and not isinstance(e, sympy.exp):
        return None if e.exp.is_integer else e.base
    rule = _CUTS.get(e.func)
    return None if rule is None else rule(e)


def cuts_of(y: Expr, x: Expr) -> list[Expr]:
    """The expressions `cut_of` of the parts with x, each once."""
    cuts = (cut_of(e) for e in y.atoms(sympy.Function, sympy.Pow) if e.has(x))
    return [*dict.fromkeys(cut for cut in cuts if cut is not None)]


def arguments_with_cuts(y: Expr) -> dict[Expr, Expr]:
    """The functions and powers with cuts in an expression: these lie where the argument, or 1 - z in pFq, is negative."""
    found = {}
    for e in iterargs(y):
        if isinstance(e, _TURNED_FUNCTIONS):
            found[e] = cut_of(e)
        elif isinstance(e, BesselBase):
            found[e] = e.args[-1]
        elif isinstance(e, sympy.hyper) and len(e.ap) > len(e.bq):
            found[e] = 1 - e.argument
    return {e: cut for e, cut in found.items() if cut is not None and cut.free_symbols}


def all_turned(y: Expr, x: Expr, point: Expr, own: Own = sympy.sympify) -> Expr:
    """With log(-u), (-u)^e for arguments u that are negative at the point; I_nu(z), K_nu(z) for J_nu(i z), Y_nu(i z)."""
    turned = {e: (-u) ** e.exp for e, u in _negative_arguments(y, x, point, own).items() if e.is_Pow}
    roots = dict(turned)
    for e in y.atoms(sympy.log, sympy.Ci, BesselBase):
        *order, u = e.args
        if e.func in _OF_IMAGINARY and _is_negative(u**2, x, point, own):
            turned[e] = _OF_IMAGINARY[e.func](*order, u.xreplace(roots))
        elif _is_negative(u, x, point, own):  # SymPy writes J(-z) as J(z) (-z)^nu/z^nu
            turned[e] = e.func(*order, _opposite(u, x, point, own), evaluate=False)
    return y.xreplace(turned)


def _opposite(u: Expr, x: Expr, point: Expr, own: Own) -> Expr:
    """-u, as (a - x)/(a + x) for (x - a)/(a + x) where x - a is negative at the point."""
    powers = (f.as_base_exp() for f in sympy.Mul.make_args(u))
    negative = [base for base, e in powers if abs(e) == 1 and base.is_Add and _is_negative(base, x, point, own)]
    return u.xreplace({negative[0]: -negative[0]}) if u.is_Mul and len(negative) == 1 else -u


def with_positive_factors(y: Expr, x: Expr, point: Expr) -> Expr:
    """sqrt(1 - x) sqrt(1 + x) for sqrt(1 - x^2) and other roots of products, with factors that are positive at the point."""

    def in_factors(power: Expr) -> Expr:
        number, factors = sympy.factor_list(power.base)
        roots = []
        for f, k in factors:
            sign = -1 if is_seen_negative(f.subs(x, point)) else 1
            number *= sign**k
            roots.append((sign * f) ** (k * power.exp))
        return number**power.exp * sympy.Mul(*roots) if number.is_positive else power

    return y.replace(
        lambda e: e.is_Pow and e.base.has(x) and e.base.is_polynomial() and not e.exp.is_Integer, in_factors
    )


def _negative_arguments(y: Expr, x: Expr, point: Expr, own: Own) -> dict[Expr, Expr]:
    """Those of the `arguments_with_cuts` that are negative at the point, in the user's symbols that `own` puts in."""
    return {e: u for e, u in arguments_with_cuts(y).items() if _is_negative(u, x, point, own)}


def _is_negative(u: Expr, x: Expr, point: Expr, own: Own) -> bool:
    """As `_is_below_zero`, or with positive numbers for letters of unknown signs."""
    has_letters = u.has(x) and u.free_symbols != {x}
    return _is_below_zero(u, x, point, own) or (has_letters and is_seen_negative(own(u.subs(x, point))))


def _is_below_zero(u: Expr, x: Expr, point: Expr, own: Own) -> bool:
    """True if u is negative at the point: by its ball, or by SymPy where that has no sign."""
    if u.free_symbols == {x} and point.is_Rational:
        with suppress(NotImplementedError):
            value = jet(u, x, acb(fmpq(int(point.p), int(point.q))))[0]
            if value.is_finite() and not value.contains(0) and (value.imag == 0 or not value.imag.contains(0)):
                return bool(value.imag == 0 and value.real < 0)
    return bool(own(u.subs(x, point)).is_negative)


def common_place(x: Expr, *parts: Mapping[Expr, Expr], own: Own = sympy.sympify, among: Sequence[Expr] = ()) -> Expr:
    """The first of several points at which the fewest `arguments_with_cuts` lie on cuts; those of the first part count first.

    The points are those `among` which it has to be, or the usual ones and then those between zeros of arguments, as for
    sqrt(x - 3) and sqrt(4 - x).
    """
    shared = [Counter(arguments.values()) for arguments in parts]

    def points() -> Iterator[Expr]:
        yield from among or _TRIED_PLACES
        if among:
            return
        linear = (u for counts in shared for u in counts if sympy.diff(u, x).is_Rational)
        zeros = sorted({-u.subs(x, 0) / sympy.diff(u, x) for u in linear if u.subs(x, 0).is_Rational})
        yield from ((a + b) / 2 for a, b in pairwise(zeros))

    found: dict[Expr, list[int]] = {}
    for point in points():
        found[point] = [sum(n for u, n in counts.items() if _is_below_zero(u, x, point, own)) for counts in shared]
        if not any(found[point]):
            return point
    return min(found, key=lambda point: found[point])


def real_at(
    pair: tuple[Expr, Expr],
    x: Expr,
    S: RatFunc,
    gauge: RatFunc,
    place: Expr,
    *,
    anew: Callable[[], tuple[Expr, Expr]] | None = None,
    own: Own = sympy.sympify,
) -> tuple[Expr, Expr]:
    """Solutions with fewer arguments on cuts at the place, turned or from `anew`; the given pair if there are none."""

    def left(found: Sequence[Expr]) -> int:
        return len(_negative_arguments(sympy.Tuple(*found), x, place, own))

    if not place.is_real or not left(pair):
        return pair
    chosen, least = pair, sys.maxsize
    for written in filter(None, (lambda: pair, anew)):
        y1, y2 = turned = tuple(all_turned(sympy.Tuple(*written()), x, place, own))
        count = left(turned)
        are_solutions = count < least and all(y in pair or is_numerical_solution(y, x, S, gauge) for y in turned)
        if are_solutions and are_independent(y1, y2, x):
            chosen, least = (y1, y2), count
        if not least:
            break
    return chosen
