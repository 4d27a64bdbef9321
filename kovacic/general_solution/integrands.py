"""Integrands as the engine reads them, products of powers and exponentials and rational functions, and their integrals."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy
from sympy import cos, cosh, cot, coth, csc, csch, exp, log, sec, sech, sin, sinh, tan, tanh

from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, factors
from kovacic.closed_form.cuts import common_place
from kovacic.closed_form.integrals import integral, logarithms
from kovacic.closed_form.product import product
from kovacic.equation import EULER, PI
from kovacic.errors import InputError
from kovacic.general_solution.substitution import expanded_size, size
from kovacic.limits import check_duration
from kovacic.reading.read import read_input

Expr = Any  # SymPy publishes no types
#: SymPy's time for a subexpression of what it expands.
_PART_SECONDS = 2e-5
#: The longest constant with parameters that is written in one form, in subexpressions.
_LONGEST = 200
#: The numbers that are parameters in coefficients.
NUMBERS = {sympy.Symbol(PI): sympy.pi, sympy.Symbol(EULER): sympy.E}


@dataclass(frozen=True)
class ChangeOfIntegrand:
    """int f(x) dx = int g(t) dt for t = u(x)."""

    #: g(t) = f(x) dx/dt.
    integrand: Expr
    t: Expr
    u: Expr

    def back(self, found: Expr) -> Expr:
        """A function of t in x; with powers of v for exponentials of r t + s where u = log(v), but exp(-t^2) stays one."""
        if isinstance(self.u, exp):
            found = found.subs(log(self.t), self.u.args[0])
        if not isinstance(self.u, log):
            return found.subs(self.t, self.u)

        def power(e: Expr) -> Expr:
            rate = e.diff(self.t)
            return exp(e) if rate.has(self.t) else self.u.args[0] ** rate * exp(e.subs(self.t, 0))

        return found.replace(exp, power).subs(self.t, self.u)


def prepared(integrand: Expr) -> Expr:
    """Expanded, in sines, cosines and exponentials."""
    integrand = integrand.rewrite((sinh, cosh, tanh, coth, sech, csch), exp)
    if integrand.has(tan, cot, sec, csc):
        integrand = integrand.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        integrand = integrand.replace(sec, lambda a: 1 / cos(a)).replace(csc, lambda a: 1 / sin(a))
    # SymPy would multiply (x + 1)^(-3/2) out, in the denominator, and write log(x/(1 - x) + 1/(1 - x)).
    quotients = [f for f in integrand.atoms(log) if f.args[0].is_Mul and sympy.denom(f.args[0]).is_Add]
    sums = [power for power in integrand.atoms(sympy.Pow) if power.base.is_Add and power.exp.is_Rational]
    powers = (power for power in sums if power.exp < -1 and not power.exp.is_Integer)
    kept = {part: sympy.Dummy() for part in (*quotients, *powers)}
    back = {letter: power for power, letter in kept.items()}
    rest = integrand.xreplace(kept)
    check_duration(_PART_SECONDS * expanded_size(rest), "expanding an integrand")
    return sympy.expand(rest, power_exp=False).xreplace(back)


def sum_of(integrals: Iterable[Expr | None]) -> Expr | None:
    """The sum; None if one isn't known, and then the next ones aren't asked for."""
    known = []
    for found in integrals:
        if found is None:
            return None
        known.append(found)
    return sympy.Add(*known)


def radicands(expression: Expr) -> list[Expr]:
    """What stands under roots: the bases of its powers with exponents that are fractions."""
    return [p.base for p in expression.atoms(sympy.Pow) if p.exp.is_Rational and not p.exp.is_Integer]


def integral_of_product(term: Expr, x: Expr) -> Expr | None:
    """int g dx for a product g of powers and exponentials of rational functions; None for anything else, or unknown."""
    functions = [f for f in term.atoms(sympy.Function) if f.has(x)]
    if any(f.func is not exp for f in functions):
        return None
    # roots of a - x and the like are real for x -> -oo
    odd = [polynomial for polynomial in _polynomial_radicands(term, x) if polynomial.degree() % 2]
    if odd and all(polynomial.LC().is_negative for polynomial in odd):
        turned = integral_of_product(term.subs(x, -x), x)
        if turned is None:
            return None
        return -turned.subs(x, -x)
    rate = ratfunc(_rate(term, x), x)
    if rate is None:
        return None
    return _integral_by_rate(rate, term, x)


def _integral_by_rate(rate: RatFunc, term: Expr, x: Expr) -> Expr | None:
    """int g dx for g = K h with h'/h = rate: K int h dx."""
    polynomials = _polynomial_radicands(term, x)
    at = None
    if polynomials and all(p.LC().is_positive for p in polynomials):
        at = sympy.oo  # where sqrt(x^2 - 1) and the like are real
    elif polynomials and not any(p.free_symbols_in_domain for p in polynomials):
        at = common_place(x, {p: p.as_expr() for p in polynomials})
    atoms = Atoms(x, at=at)
    h = product(rate)
    scale, shown = factors(h, atoms)
    if any(factor.has(sympy.CRootOf) for factor in shown):  # SymPy's arithmetic with these takes minutes
        return None
    found = integral(h, atoms)
    if found is None:
        return None
    K = _constant_value(term, scale * sympy.Mul(*shown), x)
    if K is None:
        return None
    return sympy.expand(K * found, deep=False)


def _constant_value(term: Expr, other: Expr, x: Expr) -> Expr | None:
    """The value of a ratio that doesn't depend on x, where it has one, and the term a real one if it can be; else None."""
    points = (2, 3, 5, sympy.S.Half, -sympy.S.Half)
    for point in sorted(points, key=lambda point: term.subs(x, point).is_real is False):
        value = sympy.powsimp((term / other).subs(x, point))
        if value.free_symbols and size(value) <= _LONGEST:  # without terms that cancel
            value = sympy.cancel(value)
        if value != 0 and not value.has(sympy.nan, sympy.zoo):
            return value
    return None


def _polynomial_radicands(term: Expr, x: Expr) -> list[Expr]:
    """Polynomials in x whose roots are factors."""
    bases = [base for base in radicands(term) if base.has(x)]
    return [sympy.Poly(base, x) for base in bases if base.is_polynomial(x)]


def _rate(g: Expr, x: Expr) -> Expr:
    """The logarithmic derivative, by factors; that of t (1 + u/t + ...) for a sum t + u + ..."""
    products = [term.as_powers_dict() for term in sympy.Add.make_args(g)]
    exponents = [powers.pop(sympy.E, sympy.Integer(0)) for powers in products]
    first = products[0]
    others = sympy.Integer(1)
    for powers, exponent in zip(products[1:], exponents[1:], strict=True):
        quotient = sympy.Mul(*(base**e for base, e in powers.items()), *(base**-e for base, e in first.items()))
        others += quotient * exp(sympy.cancel(exponent - exponents[0]))
    own = exponents[0].diff(x)
    for base, e in first.items():
        if not base.has(x):
            own += e.diff(x) * log(base)
        elif base.is_Add and base.has(exp) and e.is_Rational:  # as in exp(-x)/(x + 1), which SymPy expands
            own += e * _rate(base, x)
        else:
            own += e * base.diff(x) / base
    return own + others.diff(x) / others


def integral_of_fraction(g: Expr, x: Expr) -> Expr | None:
    """By partial fractions; None if g isn't a rational function of x."""
    K, rest = g.as_independent(x, as_Add=False)  # roots of numbers in a factor stay as they are
    r = ratfunc(rest, x)
    if r is None:
        return None
    atoms = Atoms(x)
    parts = decompose(r)
    return K * (atoms.sum(parts.exact) + sympy.Add(*logarithms(parts.residues, atoms))).xreplace(NUMBERS)


def ratfunc(expression: Expr, x: Expr) -> RatFunc | None:
    """A rational function, over a field with pi as a parameter; None for anything else."""
    if not expression.is_rational_function(x):
        return None
    try:
        return read_input(expression, var=x.name).S
    except InputError:
        return None
