"""Variation of parameters: y = -y1 int y2 f/(a W) dx + y2 int y1 f/(a W) dx,  W = y1 y2' - y1' y2.

Integrals that aren't known stay as they are: SymPy's rules know hardly any others, and take seconds to find that out.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import sympy
from flint import arb
from sympy import cos, exp, expand, log, powsimp, sin
from sympy.core.function import AppliedUndef

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.form import one_exponential
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.continuity import jumps
from kovacic.general_solution.steps import JUMPING
from kovacic.general_solution.substitution import in_single_waves, size
from kovacic.general_solution.textbook import is_constant
from kovacic.general_solution.waves import fractions_of_waves
from kovacic.general_solution.zero import Residual, points

Expr = Any  # SymPy publishes no types
#: Functions that appear with complex arguments, and how many of these are better than an integral.
_COMPLEX = (sympy.Ei, sympy.expint, sympy.erf, sympy.erfi, sympy.uppergamma, sympy.lowergamma)
_MOST_COMPLEX = 4


class DefiniteIntegral(sympy.Integral):  # type: ignore[misc]
    """SymPy's, for integrals between numbers that aren't done, which say that they aren't numbers.

    SymPy orders the terms of a sum by the values of the numbers among their factors, so that printing, comparing or asking for
    a sign would integrate numerically, for minutes [`Expr.as_terms`].  `evalf` still does.
    """

    is_number = False

    def _eval_evalf(self, prec: int) -> Expr:
        return sympy.Integral(*self.args)._evalf(prec)


def with_integrals(basis: Basis, right: Expr, start: Expr | None) -> Expr:
    """A solution of y'' + ... = right; integrals that aren't known stay, and begin at `start` unless it is None."""
    x = basis.x
    integrands = [powsimp(y * right / basis.wronskian) for y in (basis.y2, basis.y1)]
    known = _known_integrals(basis, integrands, start)
    if None not in known and basis.equation.change is None:
        whole = _checked(basis, known, right)
        if whole is not None:
            return starting_at(whole, x, start)
    for integrals in (known, [None, None]):
        pairs = zip(integrals, integrands, strict=True)
        opened = [_open(integrand, x, start) if found is None else found for found, integrand in pairs]
        solution = starting_at(_from_integrals(basis, opened), x, start)
        if _is_right(basis, solution, right):
            break
    return solution


def _from_integrals(basis: Basis, integrals: Sequence[Expr]) -> Expr:
    """y2 int y1 f/(a W) dx - y1 int y2 f/(a W) dx, from the second and the first."""
    return basis.y2 * integrals[1] - basis.y1 * integrals[0]


def _known_integrals(basis: Basis, integrands: Sequence[Expr], start: Expr | None) -> list[Any]:
    """The integrals that are known within the limits, without exponential integrals that jump on the real axis.

    None of them with more than a few special functions of complex arguments, which are harder to read than an integral.
    """
    known: list[Any] = [None for _ in integrands]
    with suppress(LimitExceeded):
        known = [_without_crossings(basis, antiderivative(integrand, basis.x, start)) for integrand in integrands]
    functions = set().union(*(integral.atoms(*_COMPLEX) for integral in known if integral is not None))
    if sum(bool(f.has(sympy.I)) for f in functions) <= _MOST_COMPLEX:
        return known
    return [None for _ in integrands]


def _without_crossings(basis: Basis, e: Expr | None) -> Expr | None:
    """With -E1(-u) for Ei(u) where u crosses the negative axis, the cut of both functions, at an ordinary point.

    The two differ by pi i on either side of the axis [DLMF 6.2.3], and -u crosses only the positive one.
    """
    if e is None:
        return None
    complex_ones = [f for f in e.atoms(sympy.Ei) if f.has(sympy.I)]
    poles = [basis.own(rate) for rate in basis.rates]
    crossing = [f for f in complex_ones if jumps(basis.own(f), basis.x, [*poles, basis.own(1 / f.args[0])])]
    return e.xreplace({f: -sympy.expint(1, -f.args[0]) for f in crossing})


def _checked(basis: Basis, parts: Sequence[Any], right: Expr) -> Expr | None:
    """y2 times the second integral minus y1 times the first, in the shortest form, if that is a solution."""
    whole = expand(_from_integrals(basis, parts))
    if any(power.exp.free_symbols - {basis.x} for power in whole.atoms(sympy.Pow)):  # x x^a
        whole = powsimp(whole)
    forms = [whole]
    if whole.has(sin, cos):
        forms += [in_single_waves(whole), *fractions_of_waves(whole, basis.x)]
    candidates = [_without_homogeneous(basis, part) for form in forms for part in (form, _gathered(form, basis.x))]
    found = one_exponential(min(candidates, key=size))
    return found if _is_right(basis, found, right) else None


def _is_right(basis: Basis, y: Expr, right: Expr) -> bool:
    """True for a solution without jumps at ordinary points."""
    if basis.equation.change is None and not is_solution(y, basis.rates, right, basis.x):
        return False
    parts = [basis.own(e) for e in (y, *basis.rates, right)]
    if any(member.has(log(basis.x)) for member in (basis.y1, basis.y2)):  # which are meant for x > 0
        parts = [part.subs(basis.x, exp(basis.x)) for part in parts]
    return not jumps(parts[0], basis.x, parts[1:])


def _without_homogeneous(basis: Basis, total: Expr) -> Expr:
    """A sum without the terms that are multiples of y1 or y2."""
    terms = sympy.Add.make_args(total)
    for y in (basis.y1, basis.y2):
        terms = [term for term in terms if not is_constant(term / y, basis.x)]
    return sympy.factor_terms(sympy.Add(*terms))


def _gathered(form: Expr, x: Expr) -> Expr:
    """The sum, with the rational functions that stand before the same function as one fraction."""
    groups: dict[Expr, list[Expr]] = {}
    for term in sympy.Add.make_args(form):
        rest = sympy.Mul(*(factor for factor in sympy.Mul.make_args(term) if not factor.is_rational_function(x)))
        groups.setdefault(rest, []).append(term / rest)
    found = []
    for rest, parts in groups.items():
        fraction = sympy.Add(*parts)
        if not fraction.is_polynomial(x) or (fraction.free_symbols and not fraction.has(x)):
            fraction = sympy.factor(fraction)
        found.append(rest * fraction)
    return sympy.Add(*found)


def starting_at(y: Expr, x: Expr, start: Expr | None) -> Expr:
    """With integrals from a point on in the place of antiderivatives, unless it is None."""
    return y.replace(
        lambda e: isinstance(e, sympy.Integral) and e.limits == (sympy.Tuple(x),), lambda e: _open(e.function, x, start)
    )


def _open(integrand: Expr, x: Expr, start: Expr | None) -> Expr:
    """The unevaluated integral, from `start` on with a variable that doesn't occur."""
    if start is None:
        return sympy.Integral(integrand, x)
    taken = {symbol.name for symbol in integrand.atoms(sympy.Symbol) | start.free_symbols}
    names = ("s", "t", "u", *(f"s{k}" for k in range(99)))
    s = next(sympy.Symbol(name) for name in names if name not in taken)
    return DefiniteIntegral(integrand.subs(x, s), (s, start, x))


def is_solution(y: Expr, coefficients: tuple[Expr, ...], right: Expr, x: Expr) -> bool:
    """True if y satisfies an equation at points in each quadrant and on the axis, to 50 digits.

    y'' + (b/a) y' + (c/a) y = right for two coefficients, y' + c y = right for one.
    """
    given = y.atoms(AppliedUndef, *JUMPING) | right.atoms(AppliedUndef, *JUMPING)
    # An exponential function for each that is given by its name, or jumps: the formula holds for any function.
    functions = enumerate(sorted(given, key=str))
    sample = {f: sympy.exp(sympy.Rational(k + 1, 3) * x) for k, f in functions if f.has(x)}
    if sample:
        y = y.xreplace(sample)
        right = right.xreplace(sample)
    a, b, c = (sympy.S.Zero,) * (2 - len(coefficients)) + (sympy.S.One, *coefficients)
    residual = Residual(x, (a, b, c, right))
    with working_digits(DIGITS + 15), suppress(NotImplementedError):
        found = (residual.at(y, point) for point in points())
        return all(bool(miss < arb(10) ** -DIGITS * (1 + scale)) for miss, scale in found)
    return False
