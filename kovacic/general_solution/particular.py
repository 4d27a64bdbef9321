"""A particular solution of an inhomogeneous equation, by the cheapest way that there is.

Step functions and impulses: with W = y1 y2' - y1' y2 and the kernel K(x, a) = (y1(a) y2(x) - y2(a) y1(x))/W(a), the solution of
y'' + b y' + c y = 0 with K = 0 and K' = 1 at x = a, a solution for

    g(x) delta(x - a)  is  H(x - a) g(a) K(x, a),                                                                    (1)
    g(x) H(x - a)      is  H(x - a) (p(x) - p(a) K1(x) - p'(a) K(x, a)),                                             (2)

where p is any solution for g, and K1 that of the homogeneous equation with K1 = 1, K1' = 0 at x = a.  For impulses of higher
order y = H u + sum of d_j delta^(j), with all of these at a, and

    y'' + b y' + c y = u(a) delta' + (u'(a) + b(a) u(a)) delta + sum of d_j (delta^(j+2) + b delta^(j+1) + c delta^(j)),     (3)

where b delta^(n) is the sum of (-1)^k C(n, k) b^(k)(a) delta^(n-k).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from math import comb
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside

from kovacic.algebra.factors import combination
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.product import product
from kovacic.closed_form.way_back import in_x
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import in_powers
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.check import is_finite
from kovacic.general_solution.constants import tidy
from kovacic.general_solution.integrands import NUMBERS, prepared, ratfunc
from kovacic.general_solution.steps import Apart, HeavisideTerm, taken_apart
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.values import have_values, value_at, values_at
from kovacic.general_solution.variation import at_once, with_integrals
from kovacic.reading.change_of_variable import slope_squared

Expr = Any  # SymPy publishes no types
#: The most terms of a right-hand side that are treated one by one.
_LARGEST_SUM = 30


def particular_solution(basis: Basis, start: Expr | None) -> Expr:
    """A polynomial, by undetermined coefficients, or by variation of parameters, whose integrals begin at `start`."""
    right = right_hand_side(basis.equation)
    if right == 0:
        return sympy.Integer(0)
    solved = partial(with_integrals if basis.equation.change is not None else _solved, basis)
    if not right.has(DiracDelta, Heaviside):
        return solved(right, start)
    apart = taken_apart(right, basis.x)
    if apart is not None:
        return _response(apart, basis, start, solved)
    if right.has(DiracDelta):
        raise NotImplementedError("undecided: an impulse times a jump at the same point, or at one that isn't known")
    return solved(right, start)


def right_hand_side(equation: Equation) -> Expr:
    """F of y'' + B y' + C y = F, in the user's variable."""
    t = sympy.Symbol(equation.variable)
    a = Atoms(t).ratio(equation.a).xreplace(NUMBERS)
    f = Atoms(t).sum(equation.f).xreplace(NUMBERS)
    h = sympy.sympify(equation.h or 0).xreplace(NUMBERS)
    if equation.change is None:
        return (f + h) / a
    if f == 0:
        return h
    return in_x(equation, sympy.factor(f / a * slope_squared(equation))) + h


def _solved(basis: Basis, right: Expr, start: Expr | None) -> Expr:
    """A solution for a right-hand side without jumps, by the cheapest way, and integrals from a point on where they stay."""
    found = None
    with suppress(LimitExceeded):
        found = _at_once(basis, right)
    if found is not None:
        return found
    terms = sympy.Add.make_args(prepared(right))
    known = _known_terms(basis, terms)
    if not known:
        return with_integrals(basis, right, start)
    total = sympy.Add(*known.values())
    rest = sympy.Add(*(term for term in terms if term not in known))
    if rest != 0:
        total += with_integrals(basis, rest, start)
    return total


def _known_terms(basis: Basis, terms: Sequence[Expr]) -> dict[Expr, Expr]:
    """The terms of a sum, unless there are too many, for which a solution is known at once; and these."""
    if not 1 < len(terms) <= _LARGEST_SUM:
        return {}
    found = {term: _at_once(basis, term) for term in terms}
    return {term: part for term, part in found.items() if part is not None}


def _at_once(basis: Basis, right: Expr) -> Expr | None:
    """A polynomial, a solution with undetermined coefficients, or one by integrals that are known; None without."""
    equation = basis.equation
    x = basis.x
    polynomial = _polynomial_for(equation, ratfunc(right, x))
    if polynomial is not None:
        return Atoms(x).poly(polynomial).xreplace(NUMBERS)
    found = _by_coefficients(equation, right, x)
    if found is not None:
        return found
    return at_once(basis, right)


def _polynomial_for(equation: Equation, right: RatFunc | None) -> Poly | None:
    """A polynomial y with y'' + (b/a) y' + (c/a) y = right; None where there is none, or `right` isn't known as a fraction."""
    field = equation.a.field
    if right is None:
        return None
    if right.field == field:
        return _polynomial_solution(equation, right * equation.a)
    if not field.extends(right.field):
        return None
    over_field = RatFunc(right.num.over(field), right.den.over(field), reduced=True)
    return _polynomial_solution(equation, over_field * equation.a)


def _by_coefficients(equation: Equation, right: Expr, x: Expr) -> Expr:
    """A solution of y'' + ... = right by undetermined coefficients; None where the equation or the right-hand side differ.

    Either the coefficients are constants; or y = G u, G the gauge factor, has u'' = S u + right/G with a constant S, or with
    S = s/(x - c)^2.
    """
    atoms = Atoms(x)
    S = equation.S
    b, c = equation.b / equation.a, equation.c / equation.a
    if _is_constant(b) and _is_constant(c):
        return undetermined(atoms.ratio(b).xreplace(NUMBERS), atoms.ratio(c).xreplace(NUMBERS), right, x)
    gauge = display(product(equation.gauge), atoms).xreplace(NUMBERS)
    if _is_constant(S):
        found = undetermined(0, -atoms.ratio(S).xreplace(NUMBERS), right / gauge, x)
        if found is not None:
            return _times(gauge, found)
    den = S.den if S else equation.gauge.den  # any c does for s = 0: that of the gauge factor
    return _with_a_double_pole(equation, den, gauge, right, x)


def _is_constant(r: RatFunc) -> bool:
    return r.is_polynomial and r.num.degree <= 0


def _times(gauge: Expr, u: Expr) -> Expr:
    """G u, term by term."""
    return sympy.Add(*(sympy.powsimp(gauge * term) for term in sympy.Add.make_args(u)))


def _with_a_double_pole(equation: Equation, den: Poly, gauge: Expr, right: Expr, x: Expr) -> Expr | None:
    """G u with u'' = s/(x - c)^2 u + right/G, which x = c + e^t turns into u_tt - u_t - s u = e^(2t) right/G.

    None where S isn't of this kind: c is the only zero of `den` if it has one.
    """
    if den.degree == 0:
        return None
    atoms = Atoms(x)
    S = equation.S
    root = den[den.degree - 1] / (den.degree * den.lc)  # -c
    line = S.field.poly([root, 1])
    s = S * line**2
    if not _is_constant(s):
        return None
    t = sympy.Dummy(real=True)
    u = x + atoms.constant(root).xreplace(NUMBERS)
    if any(f.args[0].subs(x, 1 - u + x).is_negative for f in right.atoms(sympy.log)):  # real on the left of c
        u = -u
    gauge = gauge.xreplace({atoms.primitive(line)[1]: u})
    inner = (right / gauge).subs(x, (sympy.exp(t) - u) / u.diff(x) + x).replace(lambda e: e.is_Add, sympy.expand)
    found = undetermined(-1, -atoms.ratio(s).xreplace(NUMBERS), sympy.exp(2 * t) * inner, t)
    if found is None:
        return None
    return _times(gauge, in_powers(found, t, u))


def _polynomial_solution(equation: Equation, right: RatFunc) -> Poly | None:
    """A polynomial y with a y'' + b y' + c y = right, of a degree at most two above that of `right`, or None."""
    denominators = equation.a.den * equation.b.den * equation.c.den * right.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, right))
    x = f.field.poly([0, 1])
    lowest = min(p.degree for p in (a, b, c) if p)
    height = max(f.degree - lowest, 0) + 2
    powers: list[Any] = [x**k for k in range(height + 1)]
    slopes = [p.derivative() for p in powers]
    images = [a * q.derivative() + b * q + c * p for p, q in zip(powers, slopes, strict=True)]
    found = combination(f, images)
    if found is None:
        return None
    return sum((p * k for p, k in zip(powers, found, strict=True)), f * 0)


def _response(right: Apart, basis: Basis, start: Expr | None, solved: Callable[[Expr, Expr | None], Expr]) -> Expr:
    """A solution for a right-hand side with jumps and impulses.

    `solved` gives one without them, with integrals from a point on.
    Raises `NotImplementedError` for an impulse at a singular point.
    """
    total = [_step_response(step, basis, solved) for step in right.steps]
    total += [_impulse_response(_strengths(right, a), basis, a) for a in dict.fromkeys(i.a for i in right.impulses)]
    if right.plain != 0:
        total.append(solved(right.plain, start))
    return sympy.Add(*total)


def _step_response(step: HeavisideTerm, basis: Basis, solved: Callable[[Expr, Expr | None], Expr]) -> Expr:
    """By (2); where the equation is singular at the step with any solution p: H(x - a) p is one on each side."""
    x = basis.x
    a = step.a
    if not have_values(basis.rates, x, a):
        return Heaviside(x - a) * solved(step.g, None)
    p = solved(step.g, a)
    return Heaviside(x - a) * _from_rest(p, basis, values_at(p, x, a), a)


def _strengths(right: Apart, a: Expr) -> dict[int, Expr]:
    """Those of the impulses at a point, by their orders."""
    strengths = {impulse.order: sympy.Integer(0) for impulse in right.impulses}
    for impulse in right.impulses:
        if impulse.a == a:
            strengths[impulse.order] += impulse.strength
    return strengths


def _from_rest(p: Expr, basis: Basis, values: tuple[Expr, Expr], a: Expr) -> Expr:
    """p - u for the solution u of the homogeneous equation with u(a), u'(a) = `values`: p(a) and p'(a), for a step."""
    x = basis.x
    value, rate = values
    wronskian = tidy(value_at(basis.wronskian, x, a))  # a limit where t(x) alone is singular
    if wronskian == 0 or not is_finite(wronskian):
        raise NotImplementedError(f"the functions of the closed form are singular at {a}, where the solutions aren't")
    (u, du), (v, dv) = (values_at(y, x, a) for y in (basis.y1, basis.y2))
    first = (value * dv - rate * v) / wronskian
    second = (rate * u - value * du) / wronskian
    return sympy.powsimp(p - tidy(first) * basis.y1 - tidy(second) * basis.y2)


def _impulse_response(strengths: Mapping[int, Expr], basis: Basis, a: Expr) -> Expr:
    """A solution for sum of r_n delta^(n)(x - a): H(x - a) u + sum of d_j delta^(j)(x - a), by (3) from the highest n down.

    Raises `NotImplementedError` where the equation, or the right-hand side, is singular.
    """
    x = basis.x
    if not have_values(basis.rates, x, a) or not all(map(is_finite, strengths.values())):
        said = f"undecided: an impulse at {x} = {a}, a singular point of the equation"
        raise NotImplementedError(f"{said}: there, solutions and their slopes have no values that could jump")
    B, C = basis.rates
    rest = defaultdict(lambda: sympy.Integer(0), strengths)
    singular = sympy.Integer(0)
    for order in range(max(rest), 1, -1):
        d = rest.pop(order, sympy.Integer(0))
        j = order - 2
        singular += d * DiracDelta(x - a, j)
        for shares in (_at_impulse(B, d, j + 1, x, a), _at_impulse(C, d, j, x, a)):
            for n, strength in shares.items():
                rest[n] -= strength
    value = rest[1]
    slope = rest[0] - value_at(B, x, a) * value
    return Heaviside(x - a) * _from_rest(sympy.Integer(0), basis, (-tidy(value), -tidy(slope)), a) + singular


def _at_impulse(rate: Expr, d: Expr, n: int, x: Expr, a: Expr) -> dict[int, Expr]:
    """b d delta^(n), as at the head of this module: the strengths of delta^(n-k) by their orders."""
    shares = {}
    for k in range(n + 1):
        shares[n - k] = d * (-1) ** k * comb(n, k) * value_at(rate.diff(x, k), x, a)
    return shares
