"""Integrals on s^2 = g, and exponentials of them, as SymPy expressions that are real where g is positive.

kappa int r dx/sqrt(g) is a sum of kappa C sqrt(g) and of kappa c log(Q) or kappa c atan(Q): every logarithm of
`kovacic.closed_form.curve` and `kovacic.closed_form.curve` with tau^2 < 0 is turned into an arc tangent,
-log(A + i eta B s)/(i eta) = atan(A/(eta B s))/eta up to a constant.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import sympy
from sympy import Add, Integer, Mul, asin, asinh, atan, cos, exp, log, sin

from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms, Expr, discriminant, display, rational
from kovacic.closed_form.curve import CurveIntegral, Unit, unit
from kovacic.closed_form.structure import OnCurve
from kovacic.exact import radical as sqrt

#: int r dx/sqrt(g) = sum of coefficient * log(base) for the first + sum of the second; notes on what was left as an integral.
_Terms = tuple[list[tuple[Expr, Expr]], list[Expr], tuple[str, ...]]


def curve_integral(integral: CurveIntegral, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """(c, F, notes): int r dx/sqrt(g) = c F, where F is real around 0 for g = x^2 - a, a > 0.

    There sqrt(g) = i sqrt(-g), as for the powers of g in `kovacic.closed_form.atoms.factors`.
    """
    scale: Expr = Integer(1)
    if atoms.is_real_beyond_zero(integral.g):
        integral = _turned(integral)
        scale = -sympy.I
    logarithms, others, notes = _terms(integral, atoms, alone=False, exponents=False)
    return scale, Add(*others, *(c * log(base) for c, base in logarithms)), notes


def _turned(integral: CurveIntegral) -> CurveIntegral:
    """int r dx/sqrt(-g)."""
    return replace(integral, g=-integral.g, exact=-integral.exact)


def exponentials(form: OnCurve, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """The two solutions, with cos and sin where kappa is imaginary, and notes."""
    form = _oriented(form)
    zeros = form.zeros
    oscillates = atoms.is_negative(form.kappa_squared)
    kappa = atoms.sqrt(-form.kappa_squared if oscillates else form.kappa_squared)
    logarithms, others, notes = _terms(form.integral, atoms, alone=zeros is None, exponents=True)
    common = display(form.common, atoms)
    A = Integer(1)
    B = Integer(0)
    if zeros is not None:  # up to a common factor, without denominators
        (a, A), (b, B) = atoms.primitive(zeros.A), atoms.primitive(zeros.B)
        numbers, roots = (rational(b / a) * kappa * sqrt(atoms.poly(form.integral.g))).as_coeff_Mul()
        A = numbers.q * A
        B = numbers.p * B * roots
    if not others and not logarithms:
        return common * A, common * B, notes
    if oscillates:
        angle = Add(*(_times(kappa, t) for t in others), *(_times(kappa, c) * log(b) for c, b in logarithms))
        c = cos(angle)
        s = sin(angle)
        return common * (A * c - B * s), common * (A * s + B * c), notes
    powers = [(base, _times(kappa, c)) for c, base in logarithms]
    inner = Add(*(_times(kappa, t) for t in others))
    first, second = (
        Mul(common, A + sign * B, *(b ** (sign * e) for b, e in powers), exp(sign * inner)) for sign in (1, -1)
    )
    return first, second, notes


def _times(factor: Expr, term: Expr) -> Expr:
    """factor * term with the square roots of rational numbers multiplied out."""
    a = factor
    b, rest = term.as_independent(*term.free_symbols, as_Add=False) if term.free_symbols else (term, Integer(1))
    square = sympy.expand_mul(a**2 * b**2)
    if square.is_Rational and a.is_real and b.is_real:
        return (-sqrt(square) if bool(a.is_negative) != bool(b.is_negative) else sqrt(square)) * rest
    return sympy.sqrtdenest(sympy.expand_mul(a * b)) * rest


def _oriented(form: OnCurve) -> OnCurve:
    """With -g and -kappa^2 instead of g and kappa^2 if all logarithms are real where g is negative.

    Only for rational tau^2, and d = 2 with two real branch points and without a logarithm at infinity.
    """
    integral = form.integral
    if integral.rest or not integral.residues or not (discriminant(integral.g) or 0) > 0:
        return form
    units = [unit(integral.g, residue) for residue in integral.residues]
    values = [None if u is None else u.tau_squared.field.rational_value(u.tau_squared) for u in units]
    if any(value is None or value > 0 for value in values):
        return form
    zeros = form.zeros and replace(form.zeros, B=-form.zeros.B)
    return OnCurve(form.common, -form.kappa_squared, _turned(integral), zeros)


def _terms(integral: CurveIntegral, atoms: Atoms, *, alone: bool, exponents: bool) -> _Terms:
    """With `exponents` the terms will be exponents, and int dx/sqrt(g) is a logarithm, which becomes a power."""
    g = integral.g
    root = sqrt(atoms.poly(g))
    logarithms: list[tuple[Expr, Expr]] = []
    others: list[Expr] = []
    if integral.exact:
        others.append(atoms.ratio(integral.exact) * root)
    if not integral.is_elementary:
        if integral.unit is None:
            others.append(sympy.Integral(atoms.ratio(integral.without_exact) / root, atoms.x))
            return [], others, (f"integral left because {integral.reason}",)
        _append_unit(integral.unit, root, atoms, logarithms, others)
        return logarithms, others, ()
    inverse = None if exponents or not integral.rest else _inverse_sine(g, atoms)
    if inverse is not None:
        others.append(atoms.constant(integral.rest) * inverse)
    elif integral.rest:
        # x - (x1 + x2)/2 + sqrt(g); alone, for real roots that aren't symmetric to 0, its square root, which has another sign
        # of sqrt(g) in some regions.
        c = atoms.constant(integral.rest)
        base = atoms.poly(g.derivative() * Fraction(1, 2)) + root
        if alone and not integral.exact and not integral.residues and g[1] and (roots := atoms.real_roots(g)):
            c = 2 * c
            base = Add(*(sqrt(atoms.x - a) for a in roots))
        logarithms.append((c, base))
    for residue in integral.residues:
        found = unit(integral.g, residue)
        if found is not None:
            _append_unit(found, root, atoms, logarithms, others)
        else:
            others.append(_root_sum(integral, residue, root, atoms))
    return logarithms, others, ()


def _inverse_sine(g: Poly, atoms: Atoms) -> Expr | None:
    """int dx/sqrt(g) for g = k^2 - (x - h)^2 or g = (x - h)^2 + k^2 with a number k > 0; None for others."""
    h = g[1] * g.lc * Fraction(-1, 2)
    d = g[0] - g[1] * g[1] * g.lc * Fraction(1, 4)
    if not atoms.constant(d).is_positive:
        return None
    z = (atoms.x - atoms.constant(h)) / atoms.sqrt(d)
    return asin(z) if g.lc == -1 else asinh(z)


def _append_unit(u: Unit, root: Expr, atoms: Atoms, logarithms: list[tuple[Expr, Expr]], others: list[Expr]) -> None:
    """factor * log((A + B tau s)/p)/tau, or the arc tangent for tau^2 < 0."""
    factor = rational(u.factor)
    A = u.A
    B = u.B
    p = u.p
    content, _ = atoms.primitive(A)
    if content:
        A = A * (1 / content)
        B = B * (1 / content)
    if atoms.is_negative(u.tau_squared):
        eta = atoms.sqrt(-u.tau_squared)
        (a, top), (b, bottom) = atoms.primitive(A), atoms.primitive(B)
        others.append(atan(Mul(rational(a / b) / eta, top, 1 / bottom, 1 / root)) * -factor / eta)
        return
    tau = atoms.sqrt(u.tau_squared)
    top = atoms.poly(A) + sympy.expand_mul(tau * atoms.poly(B)) * root
    logarithms.append((factor / tau, top / atoms.primitive(p)[1] if p.degree > 0 else top))


def _root_sum(integral: CurveIntegral, residue: Residue, root: Expr, atoms: Atoms) -> Expr:
    """The sum over the roots a of p of -(rho/sqrt(gamma)) log((L_a + sqrt(gamma) s)/(x - a))."""
    p = residue.factor
    a = atoms.root
    gamma = atoms.poly(integral.radicand(residue), a)
    slope = atoms.poly(integral.g.derivative() * Fraction(1, 2) % p, a)
    tangent = gamma + slope * (atoms.x - a)
    body = -atoms.poly(residue.value, a) / sqrt(gamma) * log((tangent + sqrt(gamma) * root) / (atoms.x - a))
    if roots := atoms.real_roots(p):
        return Add(*(body.subs(a, value) for value in roots))
    return atoms.root_sum(atoms.poly(p, a), body)
