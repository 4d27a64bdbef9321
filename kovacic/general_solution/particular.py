"""A particular solution of an inhomogeneous equation, by the cheapest way that there is.

Step functions and impulses: with W = y1 y2' - y1' y2 and the kernel K(x, a) = (y1(a) y2(x) - y2(a) y1(x))/W(a), the solution of
y'' + b y' + c y = 0 with K = 0 and K' = 1 at x = a, a solution for

    g(x) delta(x - a)  is  H(x - a) g(a) K(x, a),                                                                    (1)
    g(x) H(x - a)      is  H(x - a) (p(x) - p(a) K1(x) - p'(a) K(x, a)),                                             (2)

where p is any solution for g, and K1 that of the homogeneous equation with K1 = 1, K1' = 0 at x = a.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy
from sympy import DiracDelta, Heaviside

from kovacic.algebra.factors import combination
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.product import product
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import NUMBERS, in_powers, prepared, ratfunc
from kovacic.general_solution.constants import tidy
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.values import values_at
from kovacic.general_solution.variation import Basis
from kovacic.limits import Budget
from kovacic.reading.change_of_variable import in_x, slope_squared

Expr = Any  # SymPy publishes no types
#: The most terms of a right-hand side that are treated one by one.
_LARGEST_SUM = 30


def particular_solution(basis: Basis, start: Expr | None, budget: Budget) -> Expr:
    """A polynomial, by undetermined coefficients, or by variation of parameters, whose integrals begin at `start`."""
    equation = basis.equation
    x = sympy.Symbol(equation.variable)
    right = (Atoms(x).sum(equation.f) + (equation.h or 0)).xreplace(NUMBERS)
    if right == 0:
        return sympy.Integer(0)
    if equation.change is not None:  # in x, where y'' = (dt/dx)^2 Y'' + ...
        right = sympy.factor(right / Atoms(x).ratio(equation.a).xreplace(NUMBERS) * slope_squared(equation))
        return basis.with_integrals(in_x(equation, right), start)

    def at_once(right: Expr) -> Expr:
        f, field = ratfunc(right, x), equation.a.field
        if f is not None and f.field != field:
            f = RatFunc(f.num.over(field), f.den.over(field), reduced=True) if field.extends(f.field) else None
        polynomial = None if f is None else _polynomial_solution(equation, f * equation.a)
        if polynomial is not None:
            return Atoms(x).poly(polynomial).xreplace(NUMBERS)
        found = _by_coefficients(equation, right, x)
        return basis.at_once(right) if found is None else found

    def solved(right: Expr, start: Expr | None) -> Expr:
        try:
            found = at_once(right)
        except LimitExceeded:
            found = None
        if found is not None:
            return found
        terms = sympy.Add.make_args(prepared(right))
        parts = {term: at_once(term) for term in terms} if 1 < len(terms) <= _LARGEST_SUM else {}
        known = {term: part for term, part in parts.items() if part is not None}
        rest = sympy.Add(*(term for term in terms if term not in known)) if known else right
        integrals = basis.with_integrals(rest, start) if rest != 0 else 0
        return sympy.Add(integrals, *known.values())

    right = right / Atoms(x).ratio(equation.a).xreplace(NUMBERS)
    if right.has(sympy.DiracDelta, sympy.Heaviside):
        found = _response(right, basis, start, solved)
        if found is not None:
            return found
    return solved(right, start)


def _by_coefficients(equation: Equation, right: Expr, x: Expr) -> Expr:
    """A solution of y'' + ... = right by undetermined coefficients; None where the equation or the right-hand side differ.

    Either the coefficients are constants; or y = G u, G the gauge factor, has u'' = S u + right/G with a constant S, or with
    S = s/(x - c)^2, which x = c + e^t turns into u_tt - u_t - s u = e^(2t) right/G.
    """
    atoms, S = Atoms(x), equation.S
    b, c = equation.b / equation.a, equation.c / equation.a
    if all(rate.is_polynomial and rate.num.degree <= 0 for rate in (b, c)):
        return undetermined(atoms.ratio(b).xreplace(NUMBERS), atoms.ratio(c).xreplace(NUMBERS), right, x)
    gauge = display(product(equation.gauge), atoms).xreplace(NUMBERS)
    if S.is_polynomial and S.num.degree <= 0:
        found = undetermined(0, -atoms.ratio(S).xreplace(NUMBERS), right / gauge, x)
        if found is not None or S:
            return None if found is None else sympy.Add(*(gauge * term for term in sympy.Add.make_args(found)))
    den = S.den if S else equation.gauge.den
    if den.degree == 0:
        return None
    root = den[den.degree - 1] / (den.degree * den.lc)  # -c
    s = S * S.field.poly([root, 1]) ** 2
    if not s.is_polynomial or s.num.degree > 0:
        return None
    t, u = sympy.Dummy(real=True), x + atoms.constant(root).xreplace(NUMBERS)
    gauge = gauge.xreplace({atoms.primitive(s.field.poly([root, 1]))[1]: u})
    inner = (right / gauge).subs(x, sympy.exp(t) - u + x)
    found = undetermined(-1, -atoms.ratio(s).xreplace(NUMBERS), sympy.exp(2 * t) * inner, t)
    if found is None:
        return None
    return sympy.Add(*(gauge * term for term in sympy.Add.make_args(in_powers(found, t, u))))


def _polynomial_solution(equation: Equation, right: RatFunc) -> Poly | None:
    """A polynomial y with a y'' + b y' + c y = right, of a degree at most two above that of `right`, or None."""
    denominators = equation.a.den * equation.b.den * equation.c.den * right.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, right))
    x, height = f.field.poly([0, 1]), max(f.degree - min(p.degree for p in (a, b, c) if p), 0) + 2
    powers: list[Any] = [x**k for k in range(height + 1)]
    slopes = [p.derivative() for p in powers]
    images = [a * q.derivative() + b * q + c * p for p, q in zip(powers, slopes, strict=True)]
    found = combination(f, images)
    return None if found is None else sum((p * k for p, k in zip(powers, found, strict=True)), f * 0)


def _response(
    right: Expr, basis: Basis, start: Expr | None, solved: Callable[[Expr, Expr | None], Expr]
) -> Expr | None:
    """A solution for a right-hand side with steps and impulses at constant points, None for one of another form.

    `solved` gives a solution for a right-hand side without them, with integrals from a point on.
    """
    right, x = sympy.expand(right), basis.x
    plain, total = [], sympy.Integer(0)
    for term in sympy.Add.make_args(_separated(right, x)):
        jumps = [f for f in sympy.Mul.make_args(term) if f.func in (DiracDelta, Heaviside) and f.has(x)]
        if not jumps:
            plain.append(term)
            continue
        g = term / jumps[0]
        place = place_of(jumps[0], x)
        if len(jumps) != 1 or place is None or g.has(DiracDelta, Heaviside):
            return None
        a, slope = place
        wronskian = tidy(basis.wronskian.subs(x, a))
        if wronskian.has(sympy.nan, sympy.zoo, sympy.oo) or wronskian == 0:
            return None
        impulse = jumps[0].func is DiracDelta
        p = sympy.Integer(0) if impulse else solved(g, a)
        value, rate = (0, -g.subs(x, a) / abs(slope)) if impulse else values_at(p, x, a)
        (u, du), (v, dv) = (values_at(y, x, a) for y in (basis.y1, basis.y2))
        first, second = (value * dv - rate * v) / wronskian, (rate * u - value * du) / wronskian
        total += Heaviside(x - a) * sympy.powsimp(p - tidy(first) * basis.y1 - tidy(second) * basis.y2)
    rest = sympy.Add(*plain)
    return total + (solved(rest, start) if rest != 0 else 0)


def place_of(jump: Expr, x: Expr) -> tuple[Expr, Expr] | None:
    """(a, s) for a step or an impulse of s (x - a) with numbers s and a; s > 0 for a step."""
    inner = jump.args[0]
    slope = inner.diff(x)
    if slope.has(x) or not slope.is_real or (jump.func is DiracDelta and len(jump.args) > 1 and jump.args[1] != 0):
        return None
    return sympy.expand(x - inner / slope), slope


def _separated(right: Expr, x: Expr) -> Expr:
    """With H(a - x) as 1 - H(x - a), and products of steps at different numbers as single ones."""

    def upward(step: Expr) -> Expr:
        slope = step.args[0].diff(x)
        if slope.has(x) or slope == 0 or not slope.is_real:
            return step
        at = Heaviside(x - sympy.expand(x - step.args[0] / slope))
        return at if slope.is_positive else 1 - at

    right = sympy.expand(right.xreplace({step: upward(step) for step in right.atoms(Heaviside)}))

    def last(product: Expr) -> Expr:
        steps = [f.base if f.is_Pow else f for f in product.args if (f.base if f.is_Pow else f).func is Heaviside]
        if not steps or (len(steps) == 1 and steps[0] in product.args) or any(s.free_symbols != {x} for s in steps):
            return product
        late = max(steps, key=lambda step: (x - step.args[0]).evalf())
        return sympy.Mul(*(f for f in product.args if (f.base if f.is_Pow else f).func is not Heaviside), late)

    return sympy.Add(*(last(term) if term.is_Mul else term for term in sympy.Add.make_args(right)))
