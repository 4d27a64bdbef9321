"""The integrals of `kovacic.closed_form.primitive` and `kovacic.closed_form.curve` as SymPy expressions."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, lcm

import sympy
from sympy import Add, Ei, Integer, Mul, erf, erfi, exp, pi

from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms, Expr, display, factors, rational
from kovacic.closed_form.curve import CurveIntegral
from kovacic.closed_form.curve_display import curve_integral, elliptic
from kovacic.closed_form.primitive import (
    ExponentialPrimitive,
    OpenPrimitive,
    RationalPrimitive,
    integrate,
    normalised_constant,
)
from kovacic.closed_form.product import Power, Product, gathered
from kovacic.closed_form.structure import Triangular
from kovacic.numbers.exact import radical as sqrt

Scaled = tuple[Expr, Expr]  # a constant and an expression, to be multiplied
Factors = tuple[Expr, list[Expr]]  # a constant and factors: y1 as `Atoms.factors` gives it


def triangular(form: Triangular, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """y1, and y1 int y1^-2 up to a constant factor and a multiple of y1; and notes about what was left as an integral."""
    primitive = form.primitive
    parts = factors(form.first, atoms)
    first = Mul(*parts[1])
    if isinstance(primitive, OpenPrimitive):
        integral = sympy.Integral(display(form.bare.to_power(-2), atoms, around_zero=True), atoms.x)
        return first, first * integral, (f"integral left because {primitive.reason}",)
    if not isinstance(primitive, CurveIntegral):
        return first, _sum(_terms(form.first, primitive, parts, atoms)), ()
    named = elliptic(primitive, atoms) if primitive.reason is not None else None
    if named is not None:
        note = f"elliptic integrals because {primitive.reason}"
        return first, _sum([_scaled(c, [*parts[1], value]) for c, value in named]), (note,)
    _, value, notes = curve_integral(primitive, atoms)
    shown = value.as_content_primitive()[1]
    if shown.could_extract_minus_sign():
        shown = -shown
    return first, Add(*(first * term for term in Add.make_args(shown))), notes


def integral(h: Product, atoms: Atoms) -> Expr | None:
    """int h dx with its constant factor, None where it would be left.  The branches of roots may not agree."""
    primitive = integrate(h)
    if isinstance(primitive, OpenPrimitive):
        return None
    if isinstance(primitive, CurveIntegral):
        scale, value, notes = curve_integral(primitive, atoms)
        return None if notes else scale * value
    one = Product((), (), h.exponential * 0)
    return Add(*(c * e for c, e in _terms(one, primitive, (Integer(1), []), atoms)))


def _terms(
    y: Product, primitive: RationalPrimitive | ExponentialPrimitive, first: Factors, atoms: Atoms
) -> list[Scaled]:
    """y times the integral."""
    if isinstance(primitive, RationalPrimitive):
        return _rational(y, primitive, first, atoms)
    return _exponential(y, primitive, first, atoms)


def _sum(terms: list[Scaled]) -> Expr:
    """The sum up to a constant factor: coprime integer coefficients if they are commensurable, the last one positive."""
    if len(terms) == 1:
        return terms[0][1]
    ratios = [c / terms[-1][0] for c, _ in terms]
    if all(ratio.is_Rational for ratio in ratios):
        content = sympy.Rational(gcd(*(int(r.p) for r in ratios)), lcm(*(int(r.q) for r in ratios)))
        ratios = [ratio / content for ratio in ratios]
    return Add(*(c * e for c, (_, e) in zip(ratios, terms, strict=True)))


def _scaled(scale: Expr, parts: list[Expr]) -> Scaled:
    """Rational factors of the product join the constant."""
    coefficient, rest = Mul(*parts).as_coeff_Mul()
    return scale * coefficient, rest


def _rational(y: Product, primitive: RationalPrimitive, first: Factors, atoms: Atoms) -> list[Scaled]:
    exact = primitive.parts.exact
    residues = primitive.parts.residues
    if not residues:
        exact = normalised_constant(exact)
    terms = []
    if exact:
        terms.append(_scaled(*factors(y, atoms, exact)))
    scale, parts = first
    terms += [_scaled(scale, [*parts, term]) for term in logarithms(residues, atoms)]
    return terms


def logarithms(residues: Iterable[Residue], atoms: Atoms) -> list[Expr]:
    """Logarithms; those of two linear factors with opposite residues as one, real between the roots if 0 lies there."""
    pending = list(residues)
    terms = []
    while pending:
        first = pending.pop()
        opposite = [other for other in pending if _is_at_a_point(other) and other.value == -first.value]
        if opposite and _is_at_a_point(first):
            pending.remove(opposite[0])
            # rho log((x - a)/(x - b)), or of (x - a)/(b - x) where 0 lies between a and b
            top, bottom = (atoms.primitive(residue.factor)[1] for residue in (first, opposite[0]))
            at_zero = first.factor.field.rational_value(first.factor[0] * opposite[0].factor[0])
            if at_zero is not None and at_zero < 0:
                bottom = -bottom
            terms.append(atoms.constant(first.value) * sympy.log(top / bottom, evaluate=False))
        else:
            terms.append(atoms.log_sum(first))
    return terms[::-1]


def _is_at_a_point(residue: Residue) -> bool:
    return residue.is_constant and residue.factor.degree == 1


def _exponential(y: Product, primitive: ExponentialPrimitive, first: Factors, atoms: Atoms) -> list[Scaled]:
    """first * (W k + the terms with Ei, error and gamma functions, and logarithms of t^(1/n) - z)."""
    scale, parts = first
    terms = []
    if primitive.W:
        # y W t^alpha exp(E)
        t = primitive.t
        quotient = [(t.num, primitive.alpha), (t.den, -primitive.alpha)]
        more = [Power(p, y.field.poly([e])) for p, e in quotient if p.degree > 0]
        whole = Product(gathered((*y.powers, *more)), y.roots, y.exponential + primitive.E(t))
        terms.append(_scaled(*factors(whole, atoms, primitive.W(t), like=y)))
    for term in primitive.terms:
        q = atoms.sum(term.q(primitive.t))
        c, function = _gamma(term.b, term.n, q, primitive.alpha + term.power, atoms)
        shift = exp(atoms.constant(term.e))
        terms.append(_scaled(scale * atoms.constant(term.coefficient) * c, [*parts, shift, function]))
    at_poles = [_sum_at_poles(residue, primitive, atoms) for residue in primitive.poles]
    return terms + [_scaled(scale, [*parts, found]) for found in at_poles]


def _sum_at_poles(residue: Residue, primitive: ExponentialPrimitive, atoms: Atoms) -> Expr:
    """The sum over conjugate poles as at `ExponentialPrimitive`, with a^n for the pole, so that z is a."""
    t = primitive.t
    E = primitive.E(t)
    n = primitive.alpha.denominator
    a = atoms.root
    body = atoms.poly(residue.value, a**n)
    if E:
        body *= exp(atoms.poly(E.num, a)) * Ei(atoms.constant(E.num.lc) * (atoms.x - a))
    else:
        root = atoms.poly(t.num) ** rational(Fraction(1, n)) * atoms.poly(t.den) ** rational(Fraction(-1, n))
        body *= a ** int(primitive.alpha * n) * sympy.log(root - a)
    return atoms.root_sum(atoms.poly(residue.factor, a**n), body)


def _gamma(factor: Poly, n: int, t: Expr, power: Fraction, atoms: Atoms) -> Scaled:
    """int t^power exp(beta t^n) dt: equation (1) of `kovacic.closed_form.primitive`."""
    beta = atoms.constant(factor)
    s = (power + 1) / n
    if s == 0:
        return sympy.Rational(1, n), Ei(beta * t**n)
    if s == Fraction(1, 2):
        is_positive = beta.is_real is not False and not atoms.is_negative(factor)
        root = atoms.sqrt(factor if is_positive else -factor)
        function = erfi if is_positive else erf
        return 1 / (root * n), sqrt(pi) * function(root * t ** sympy.Rational(n, 2))
    order = rational(s)
    z = -beta * t**n
    if n == 1 and beta.is_negative:
        return -((-beta) ** -order), sympy.uppergamma(order, z)
    # z^(-s) gamma(s, z) is entire; with Gamma(s, z) the powers of z and of t would differ in some sectors.
    return sympy.Rational(1, n), t ** rational(power + 1) * z**-order * sympy.lowergamma(order, z)
