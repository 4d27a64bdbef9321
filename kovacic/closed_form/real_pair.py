"""Two real solutions from two that are complex conjugates of one another.

y+- = (A +- i s B) U exp(+-i s V) with s^2 = -delta > 0 and everything else real.  V' = v is rational; a root a = c + i t of a
quadratic factor p of its denominator contributes the angle phi = arg(x - conj(a)), through

    i s (v(a) log(x - a) + v(conj a) log(x - conj a)) = i s v(c) log p + i q phi,    q = v_1 s 2t,  v(a) = v_0 + v_1 a.   (1)

For an integer q, exp(i q phi) = ((x - c) + i t)^q p^(-q/2); for q in 1/2 + Z a square root is left over,

    exp(i phi/2) = (u + i t/u) / (sqrt(2) p^(1/4)),      u = sqrt(sqrt(p) + x - c),                                    (2)

which makes the answers for the ball on the sphere algebraic; otherwise phi = pi/2 - atan((x - c)/t).  In the variable x of
t = sin(x) or cos(x), where t^2 - 1 is negative, the parts are taken of functions of x.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy
from sympy import Add, Integer, Mul, cos, sin

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms, Expr, display
from kovacic.closed_form.product import Power, gathered_powers
from kovacic.closed_form.structure import Conjugate
from kovacic.closed_form.way_back import solution_in_x
from kovacic.engine.places import rational_square_root
from kovacic.equation import Equation
from kovacic.numbers.exact import radical as sqrt
from kovacic.reading.change_of_variable import function_of_x, user_variable


@dataclass(frozen=True)
class _SurdPair:
    """(A + sqrt(delta) B) * common, times exp(i phi/2) for the quadratic factors in `halves` (sign +1 or -1)."""

    A: Poly
    B: Poly
    powers: tuple[Power, ...]
    halves: tuple[tuple[Poly, int], ...] = ()


def is_real_pair(form: Conjugate, atoms: Atoms) -> bool:
    """True if the two solutions are complex conjugates: real coefficients (for real parameters) and delta < 0."""
    field = form.delta.field
    if isinstance(field, AlgebraicField) and not (field.base == QQ and atoms.generator(field).is_real):
        return False
    return atoms.is_negative(form.delta)


def real_pair(form: Conjugate, atoms: Atoms) -> tuple[Expr, Expr]:
    """The real and the imaginary part of y+, each a solution."""
    s = atoms.sqrt(-form.delta)
    pair = _SurdPair(form.A, form.B, form.common.powers)
    phase = [s * atoms.sum(form.phase.exact)]
    for residue in form.phase.residues:
        turned = _half_turns(pair, form.delta, residue, phase=phase, atoms=atoms, s=s)
        if turned is None:
            phase.append(s * atoms.log_sum(residue))
        else:
            pair = turned
    common = display(replace(form.common, powers=gathered_powers(pair.powers)), atoms)
    content = atoms.primitive(pair.A or pair.B)[0]
    first = atoms.poly(pair.A / content)
    second = s * atoms.poly(pair.B / content)
    for p, sign in pair.halves:
        # exp(+-i phi/2) is a multiple of plus +- i minus, plus * minus = t.
        distance = atoms.poly(p.derivative() * Fraction(1, 2))
        (scale, radical) = atoms.primitive(p)
        root = sqrt(radical) * sqrt(atoms.constant(scale))
        plus = sqrt(root + distance)
        minus = sign * sqrt(-atoms.constant(p[1] * p[1] - 4 * p[0])) / (2 * plus)
        first, second = first * plus - second * minus, first * minus + second * plus
    angle = Add(*phase)
    if angle != 0:
        if angle.could_extract_minus_sign():  # the complex conjugates: y- instead of y+
            angle = -angle
            second = -second
        evaluate = angle.has(sympy.atan)  # all other angles are left unevaluated
        c, t = cos(angle, evaluate=evaluate), sin(angle, evaluate=evaluate)
        first, second = first * c - second * t, first * t + second * c
    return _without_content(first) * common, _without_content(second) * common


def _without_content(expression: Expr) -> Expr:
    """Without a constant factor, if it is visible."""
    if isinstance(expression, Add):
        return -expression if all(term.as_coeff_Mul()[0].is_negative for term in expression.args) else expression
    symbols = expression.free_symbols
    return expression.as_independent(*symbols, as_Add=False)[1] if symbols else expression


def _half_turns(
    pair: _SurdPair, delta: Poly, residue: Residue, *, phase: list[Expr], atoms: Atoms, s: Expr
) -> _SurdPair | None:
    """The pair turned by exp(i q phi) of equation (1) if 2q is an integer; the logarithm, if any, joins the phase."""
    p, value = residue.factor, residue.value
    if p.degree != 2 or residue.is_constant or p.field != QQ:
        return None
    ratio = rational_square_root((p[1] * p[1] - 4 * p[0]) / delta)  # 2t/s, only if the roots are complex
    if ratio is None:
        return None
    slope: Any = value.field.rational_value(value[1])
    q = slope * ratio * -(delta.field.rational_value(delta) or 0)  # v_1 s 2t = v_1 s^2 (2t/s)
    if (2 * q).denominator != 1:
        return None
    mean = value[0] - value[1] * p[1] * Fraction(1, 2)
    if mean:
        phase.append(s * atoms.constant(mean) * sympy.log(atoms.primitive(p)[1]))
    sign = 1 if q > 0 else -1
    turns, half = divmod(abs(2 * q), 2)
    re = p.derivative() * Fraction(1, 2)
    im = p.field.poly([sign * ratio / 2])
    A, B = pair.A, pair.B
    for _ in range(int(turns)):  # times re + sqrt(delta) im
        A, B = A * re + B * im * delta, A * im + B * re
    powers = (*pair.powers, Power(p, p.field.poly([-abs(q) / 2])))
    return _SurdPair(A, B, powers, (*pair.halves, (p, sign)) if half else pair.halves)


def conjugate_roots(form: Conjugate, atoms: Atoms) -> tuple[Expr, Expr]:
    """y+ and y- for a delta that isn't negative: real where S is."""
    root = atoms.sqrt(form.delta)
    rest = display(replace(form.common, powers=()), atoms)
    pair = []
    for s in (root, -root):
        exponents = {power.base: atoms.constant(power.exponent) for power in form.common.powers}
        inner = [s * atoms.sum(form.phase.exact)]
        for residue in form.phase.residues:
            if residue.is_constant:  # an exponent
                known = exponents.get(residue.factor, Integer(0))
                exponents[residue.factor] = known + s * atoms.constant(residue.value)
            else:
                inner.append(s * atoms.log_sum(residue))
        powers = Mul(*(atoms.base(base, around_zero=False) ** sympy.expand_mul(e) for base, e in exponents.items()))
        polynomial = Add(atoms.poly(form.A), sympy.expand_mul(s * atoms.poly(form.B)))
        pair.append(polynomial * powers * rest * sympy.exp(Add(*inner)))
    return pair[0], pair[1]


def is_turned(equation: Equation, y: Expr) -> bool:
    """True if a solution is written by exp(i w): with t = exp(i w), or with sqrt(t^2 - 1) for a sine t."""
    t, f = sympy.Symbol(equation.variable), function_of_x(equation)
    is_sine = f.func in (sympy.sin, sympy.cos)
    return bool(f.has(sympy.I)) or (is_sine and any(power.base == t**2 - 1 for power in y.atoms(sympy.Pow)))


def pair_in_x(equation: Equation, y1: Expr, y2: Expr) -> tuple[Expr, Expr]:
    """Both of a pair; for complex conjugates, and multiples of i, that are `is_turned` real functions with the same span."""
    first, second = solution_in_x(equation, y1), solution_in_x(equation, y2)
    if not is_turned(equation, sympy.Tuple(y1, y2)):
        return first, second
    # Letters and roots of them stand for real numbers: the parts are analytic in these, and so solutions for all values.
    x = user_variable(equation)
    both = sympy.Tuple(first, second)
    roots = {
        power for power in both.atoms(sympy.Pow) if power.free_symbols and not power.has(x) and not power.exp.is_Integer
    }
    real = {e: sympy.Dummy(real=True) for e in (*roots, *both.free_symbols)}
    back = {letter: e for e, letter in real.items()}
    pair: list[Expr] = []
    for y in both:
        for part in sympy.expand(y.xreplace(real), complex=True).as_real_imag():
            if all(sympy.expand(part**2 - other**2) != 0 for other in (0, *pair)):
                pair.append(part)
    # Two of which both solutions are combinations are solutions themselves.
    if len(pair) != 2 or sympy.Tuple(*pair).has(sympy.re, sympy.im, sympy.arg):
        return first, second
    shown = (sympy.factor_terms(part.xreplace(back)) for part in pair)
    first, second = (-y if y.could_extract_minus_sign() else y for y in shown)
    return first, second
