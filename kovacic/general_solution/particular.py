"""A particular solution of an inhomogeneous equation, by the cheapest way that there is."""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.algebra.factors import combination
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, display
from kovacic.closed_form.product import product
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import NUMBERS, in_powers, ratfunc
from kovacic.general_solution.impulses import response
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.variation import Basis
from kovacic.limits import Budget
from kovacic.reading.exponential import in_terms_of
from kovacic.reading.given import Equation

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
    change = equation.change
    if change is not None:  # in x, where y'' = (dt/dx)^2 Y'' + ...
        right = in_terms_of(change, right / Atoms(x).ratio(equation.a).xreplace(NUMBERS), x.name)
        slope = in_terms_of(change, x, x.name).diff(basis.x)
        return basis.with_integrals(sympy.powsimp(sympy.expand(right * slope**2)), start, budget.seconds_left)

    def at_once(right: Expr) -> Expr:
        f, field = ratfunc(right, x), equation.a.field
        if f is not None and f.field != field:
            f = RatFunc(f.num.over(field), f.den.over(field), reduced=True) if field.extends(f.field) else None
        polynomial = None if f is None else _polynomial_solution(equation, f * equation.a)
        if polynomial is not None:
            return Atoms(x).poly(polynomial).xreplace(NUMBERS)
        found = _by_coefficients(equation, right, x)
        return basis.at_once(right) if found is None else found

    def solved(right: Expr) -> Expr:
        try:
            found = at_once(right)
        except LimitExceeded:
            found = None
        if found is not None:
            return found
        terms = sympy.Add.make_args(sympy.expand(right))
        parts = [at_once(term) for term in terms] if 1 < len(terms) <= _LARGEST_SUM else [None]
        rest = [term for term, part in zip(terms, parts, strict=True) if part is None] if len(parts) > 1 else [right]
        integrals = basis.with_integrals(sympy.Add(*rest), start, budget.seconds_left) if rest else 0
        return sympy.Add(integrals, *(part for part in parts if part is not None))

    right = right / Atoms(x).ratio(equation.a).xreplace(NUMBERS)
    if right.has(sympy.DiracDelta, sympy.Heaviside):
        found = response(right, basis, solved)
        if found is not None:
            return found
    return solved(right)


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
