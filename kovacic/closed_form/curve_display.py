"""Integrals on s^2 = g, and exponentials of them, as SymPy expressions that are real where g is positive.

kappa int r dx/sqrt(g) is a sum of kappa C sqrt(g) and of kappa c log(Q) or kappa c atan(Q): every logarithm of
`kovacic.closed_form.curve` and `kovacic.closed_form.curve` with tau^2 < 0 is turned into an arc tangent,
-log(A + i eta B s)/(i eta) = atan(A/(eta B s))/eta up to a constant.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction

import sympy
from sympy import Add, Integer, Mul, asin, asinh, atan, cos, exp, log, sin

from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms, Expr, discriminant, display, rational
from kovacic.closed_form.curve import CurveIntegral, Unit, unit
from kovacic.closed_form.product import Power, gathered
from kovacic.closed_form.structure import OnCurve
from kovacic.numbers.exact import radical as sqrt


@dataclass
class _Terms:
    """int r dx/sqrt(g) = sum of c log(base) over `logarithms` (c, base) + sum of `others`; `notes` on what was left.

    `norms` (p, n) stand for a sum of n log(p)/tau with tau^2 = `tau_squared`.
    """

    logarithms: list[tuple[Expr, Expr]] = field(default_factory=list)
    norms: list[tuple[Poly, Fraction]] = field(default_factory=list)
    tau_squared: Poly | None = None
    others: list[Expr] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    def join_norms(self, atoms: Atoms) -> None:
        """The norms as logarithms."""
        if self.tau_squared is not None:
            tau = atoms.sqrt(self.tau_squared)
            self.logarithms += [(n / tau, atoms.poly(p)) for p, n in self.norms]


def curve_integral(integral: CurveIntegral, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """(c, F, notes): int r dx/sqrt(g) = c F, where F is real around 0 for g = x^2 - a, a > 0.

    There sqrt(g) = i sqrt(-g), as for the powers of g in `kovacic.closed_form.atoms.factors`.
    """
    scale: Expr = Integer(1)
    if atoms.is_real_beyond_zero(integral.g):
        integral = _turned(integral)
        scale = -sympy.I
    terms = _terms(integral, atoms, alone=False, exponents=False)
    terms.join_norms(atoms)
    return scale, Add(*terms.others, *(c * log(base) for c, base in terms.logarithms)), terms.notes


def _turned(integral: CurveIntegral) -> CurveIntegral:
    """int r dx/sqrt(-g)."""
    return replace(integral, g=-integral.g, exact=-integral.exact)


def exponentials(form: OnCurve, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """The two solutions, with cos and sin where kappa is imaginary, and notes."""
    form = _oriented(form)
    oscillates = atoms.is_negative(form.kappa_squared)
    kappa = atoms.sqrt(-form.kappa_squared if oscillates else form.kappa_squared)
    terms = _terms(form.integral, atoms, alone=form.zeros is None, exponents=True)
    common, other = _with_norms(form, terms, kappa, atoms)
    A, B = _zero_factors(form, kappa, atoms)
    if not terms.others and not terms.logarithms:
        return common * A, common * B, terms.notes
    inner = [_times(kappa, term) for term in terms.others]
    powers = [(base, _times(kappa, c)) for c, base in terms.logarithms]
    if oscillates:
        angle = Add(*inner, *(e * log(base) for base, e in powers))
        c = cos(angle)
        s = sin(angle)
        return common * (A * c - B * s), common * (A * s + B * c), terms.notes
    first = Mul(common, A + B, *(base**e for base, e in powers), exp(Add(*inner)))
    second = Mul(other, A - B, *(base**-e for base, e in powers), exp(-Add(*inner)))
    return first, second, terms.notes


def _with_norms(form: OnCurve, terms: _Terms, kappa: Expr, atoms: Atoms) -> tuple[Expr, Expr]:
    """The common factor of both solutions, times prod p^(+-n kappa/tau) over the norms, which join its powers in the field."""
    ratio = terms.tau_squared and form.common.field.sqrt(form.kappa_squared / terms.tau_squared)
    if ratio is None:
        terms.join_norms(atoms)
        common = display(form.common, atoms)
        return common, common
    # Both square roots are written as positive numbers.
    if atoms.is_negative(ratio):
        ratio = -ratio
    first, second = (
        display(replace(form.common, powers=gathered((*form.common.powers, *more))), atoms)
        for more in ([Power(p, ratio * (sign * n)) for p, n in terms.norms] for sign in (1, -1))
    )
    return first, second


def _zero_factors(form: OnCurve, kappa: Expr, atoms: Atoms) -> tuple[Expr, Expr]:
    """A and B kappa s of the gathered zeros A +- B kappa s, up to a common factor, without denominators; 1 and 0 without."""
    if form.zeros is None:
        return Integer(1), Integer(0)
    a, A = atoms.primitive(form.zeros.A)
    b, B = atoms.primitive(form.zeros.B)
    numbers, roots = (rational(b / a) * kappa * sqrt(atoms.poly(form.integral.g))).as_coeff_Mul()
    return numbers.q * A, numbers.p * B * roots


def _times(factor: Expr, term: Expr) -> Expr:
    """factor * term with the square roots of rational numbers multiplied out."""
    number = term
    rest: Expr = Integer(1)
    if term.free_symbols:
        number, rest = term.as_independent(*term.free_symbols, as_Add=False)
    square = sympy.expand_mul(factor**2 * number**2)
    if not (square.is_Rational and factor.is_real and number.is_real):
        return sympy.sqrtdenest(sympy.expand_mul(factor * number)) * rest
    if bool(factor.is_negative) != bool(number.is_negative):
        return -sqrt(square) * rest
    return sqrt(square) * rest


def _oriented(form: OnCurve) -> OnCurve:
    """With -g and -kappa^2 instead of g and kappa^2 if all logarithms are real where g is negative.

    Only for rational tau^2, and d = 2 with two real branch points and without a logarithm at infinity.
    """
    integral = form.integral
    if integral.rest or not integral.residues:
        return form
    square = discriminant(integral.g)
    if square is None or square <= 0:
        return form
    for residue in integral.residues:
        found = unit(integral.g, residue)
        value = None if found is None else found.tau_squared.field.rational_value(found.tau_squared)
        if value is None or value > 0:
            return form
    zeros = form.zeros and replace(form.zeros, B=-form.zeros.B)
    return OnCurve(form.common, -form.kappa_squared, _turned(integral), zeros)


def _terms(integral: CurveIntegral, atoms: Atoms, *, alone: bool, exponents: bool) -> _Terms:
    """With `exponents` the terms will be exponents, and int dx/sqrt(g) is a logarithm, which becomes a power."""
    root = sqrt(atoms.poly(integral.g))
    terms = _Terms()
    if integral.exact:
        terms.others.append(atoms.ratio(integral.exact) * root)
    if not integral.is_elementary:
        if not integral.units:
            terms.others.append(sympy.Integral(atoms.ratio(integral.without_exact) / root, atoms.x))
            terms.notes = (f"integral left because {integral.reason}",)
        else:
            for u in integral.units:
                _append_unit(u, root, atoms, terms, integral.g)
        return terms
    if integral.rest:
        _append_rest(integral, root, atoms, terms, alone=alone, exponents=exponents)
    for residue in integral.residues:
        found = unit(integral.g, residue)
        if found is not None:
            _append_unit(found, root, atoms, terms, integral.g)
        else:
            terms.others.append(_root_sum(integral, residue, root, atoms))
    return terms


def _append_rest(
    integral: CurveIntegral, root: Expr, atoms: Atoms, terms: _Terms, *, alone: bool, exponents: bool
) -> None:
    """c int dx/sqrt(g) = c log(x - (x1 + x2)/2 + sqrt(g)), or an inverse sine."""
    g = integral.g
    inverse = None if exponents else _inverse_sine(g, atoms)
    c = atoms.constant(integral.rest)
    if inverse is not None:
        terms.others.append(c * inverse)
        return
    roots = atoms.real_roots(g)
    is_alone = alone and not integral.exact and not integral.residues
    if is_alone and g[1] and roots:
        # The square root of the base: its square has another sign of sqrt(g) in some regions, which is of no account alone.
        terms.logarithms.append((2 * c, Add(*(sqrt(atoms.x - a) for a in roots))))
        return
    terms.logarithms.append((c, atoms.poly(g.derivative() * Fraction(1, 2)) + root))


def _inverse_sine(g: Poly, atoms: Atoms) -> Expr | None:
    """int dx/sqrt(g) for g = k^2 - (x - h)^2 or g = (x - h)^2 + k^2 with a number k > 0; None for others."""
    h = g[1] * g.lc * Fraction(-1, 2)
    d = g[0] - g[1] * g[1] * g.lc * Fraction(1, 4)
    if not atoms.constant(d).is_positive:
        return None
    z = (atoms.x - atoms.constant(h)) / atoms.sqrt(d)
    if g.lc == -1:
        return asin(z)
    return asinh(z)


def _append_unit(u: Unit, root: Expr, atoms: Atoms, terms: _Terms, g: Poly) -> None:
    """factor * log((A + B tau s)/sqrt(norm))/tau, or the arc tangent for tau^2 < 0."""
    factor = rational(u.factor)
    A = u.A
    B = u.B
    content, _ = atoms.primitive(A)
    if content:
        A = A * (1 / content)
        B = B * (1 / content)
    if atoms.is_negative(u.tau_squared):
        eta = atoms.sqrt(-u.tau_squared)
        a, top = atoms.primitive(A)
        b, bottom = atoms.primitive(B)
        terms.others.append(atan(Mul(rational(a / b) / eta, top, 1 / bottom, 1 / root)) * -factor / eta)
        return
    tau = atoms.sqrt(u.tau_squared)
    argument = atoms.poly(A) + sympy.expand_mul(tau * atoms.poly(B)) * root
    if u.p is None:
        norm = u.norm(g)
        terms.norms += [(p, -u.factor * k / 2) for p, k in norm.field.factor(norm)]
        terms.tau_squared = u.tau_squared
    elif u.p.degree > 0:
        argument = argument / atoms.primitive(u.p)[1]
    terms.logarithms.append((factor / tau, argument))


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
