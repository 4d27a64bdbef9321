"""Two solutions that are real at a point where x - a is negative, from two that are real on the other side.

log(u) = log(-u) + i pi and u^e = exp(i pi e) (-u)^e for u < 0.  Often log(-u) and (-u)^e in their places give a solution as
well; otherwise the real and the imaginary part of each solution are solutions, the equation being real.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy.functions.special.bessel import BesselBase

from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import are_independent, is_numerical_solution
from kovacic.equation import Equation
from kovacic.general_solution.basis import rates
from kovacic.general_solution.substitution import size
from kovacic.general_solution.variation import is_solution
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
#: The largest real part (in subexpressions, by those of the solution) that is written instead of a solution.
_LARGEST = 4
#: The largest solution that is separated, in subexpressions.
_LONGEST = 300
_COMPLEX = (sympy.re, sympy.im, sympy.Abs, sympy.arg, sympy.atan2)


def real_basis(solution: Solution, y1: Expr, y2: Expr, x: Expr, point: Expr) -> tuple[Expr, Expr]:
    """Two solutions that are real at the point, if such are found; else the given ones."""
    if not point.is_real or not any(negative_arguments(y, x, point) for y in (y1, y2)):
        return y1, y2
    candidates: list[Expr] = []
    for y in (y1, y2):
        turned = all_turned(y, x, point)
        if is_numerical_solution(turned, x, solution.S, solution.gauge):
            candidates.append(turned)
        else:
            candidates += _parts(y, point, x)
    for second in candidates[1:]:
        if are_independent(candidates[0], second, x):
            return candidates[0], second
    return y1, y2


def real_particular(y: Expr, equation: Equation, x: Expr, point: Expr) -> Expr:
    """A solution of the inhomogeneous equation that is real at the point, if one is found; else the given one."""
    if not point.is_real or y.has(sympy.Integral, sympy.Heaviside):
        return y
    if not negative_arguments(y, x, point):
        return y
    right = (Atoms(x).sum(equation.f) + (equation.h or 0)) / Atoms(x).ratio(equation.a)
    coefficients = rates(equation, x)
    real_part = _parts(y, point, x)[:1]
    for candidate in [all_turned(y, x, point), *real_part]:
        if is_solution(candidate, coefficients, right, x):
            return candidate
    return y


def _arguments(y: Expr, x: Expr) -> dict[Expr, Expr]:
    """The logarithms, roots and Bessel's functions in an expression, and their arguments."""
    found = {e: e.args[-1] for e in y.atoms(sympy.log, BesselBase)}
    for power in y.atoms(sympy.Pow):
        if power.base.has(x) and not power.exp.is_Integer:
            found[power] = power.base
    return found


def all_turned(y: Expr, x: Expr, point: Expr) -> Expr:
    """With log(-u), (-u)^e for arguments u that are negative at the point."""
    return y.xreplace({e: _turned(e) for e in negative_arguments(y, x, point)})


def _turned(e: Expr) -> Expr:
    if e.is_Pow:
        return (-e.base) ** e.exp
    return e.func(*e.args[:-1], -e.args[-1], evaluate=False)  # SymPy writes J(-z) as J(z) (-z)^nu/z^nu


def negative_arguments(y: Expr, x: Expr, point: Expr) -> dict[Expr, Expr]:
    """Those whose arguments are negative at the point."""
    return {e: u for e, u in _arguments(y, x).items() if u.subs(x, point).is_negative}


def _parts(y: Expr, point: Expr, x: Expr) -> list[Expr]:
    """The real and the imaginary part, those that aren't zero; the expression itself where they would be long.

    They are taken for real parameters; as functions of these they are analytic, and so solutions for others as well.
    """
    if y.has(sympy.RootSum, BesselBase) or size(y) > _LONGEST:
        return [y]
    back: dict[Expr, Expr] = {}
    whole = y.xreplace(_with_positive_arguments(y, point, x, back))
    real = {symbol: sympy.Dummy(real=True) for symbol in whole.free_symbols - back.keys()}
    back |= {letter: symbol for symbol, letter in real.items()}
    whole = _with_polar_powers(whole.subs(real), x, back)
    both = sympy.expand(whole, complex=True).as_real_imag()
    parts = [part.xreplace(back).as_independent(x, as_Add=False)[1] for part in both if part != 0]
    most = _LARGEST * (size(y) + 5)
    if all(size(part) <= most and not part.has(*_COMPLEX) for part in parts):
        return parts
    return [y]


def _with_positive_arguments(y: Expr, point: Expr, x: Expr, back: dict[Expr, Expr]) -> dict[Expr, Expr]:
    """Logarithms and roots of p, or of -p = p exp(i pi), for a positive symbol p; `back` says what it is."""
    real: dict[Expr, Expr] = {}
    for e, u in _arguments(y, x).items():
        value = u.subs(x, point)
        if value.is_negative:
            real[e] = _of_positive(e, _letter_for(-u, back), sympy.I * sympy.pi)
        elif value.is_positive and not u.has(*real):
            real[e] = _of_positive(e, _letter_for(u, back), sympy.Integer(0))
    return real


def _letter_for(p: Expr, back: dict[Expr, Expr]) -> Expr:
    """A positive symbol for p, the one that stands for p or -p already if there is one."""
    known = [letter for letter, meaning in back.items() if meaning in (p, -p)]
    letter = next(iter(known), sympy.Dummy(positive=True))
    back[letter] = p
    return letter


def _of_positive(e: Expr, p: Expr, phase: Expr) -> Expr:
    """The logarithm, or the power with the exponent of e, of p exp(phase)."""
    if e.func is sympy.log:
        return sympy.log(p) + phase
    return p**e.exp * sympy.exp(phase * e.exp)


def _with_polar_powers(whole: Expr, x: Expr, back: dict[Expr, Expr]) -> Expr:
    """With powers of complex numbers of a constant modulus as exponential functions."""
    for power in whole.atoms(sympy.Pow):
        polar = _polar(power, x, back)
        if polar is not None:
            whole = whole.xreplace({power: polar})
    return whole


def _polar(power: Expr, x: Expr, back: dict[Expr, Expr]) -> Expr | None:
    """(a + i b)^e with a constant modulus m as m^e exp(i e phi), where `back` says what phi is; None for another power."""
    a, b = power.base.as_real_imag()
    square = sympy.expand((a**2 + b**2).xreplace(back))
    if b == 0 or power.exp.is_Integer or square.has(x):
        return None
    m = sympy.sqrt(square)
    angle = sympy.acos(a.xreplace(back) / m)
    if b.could_extract_minus_sign():
        angle = -angle
    phi = sympy.Dummy(real=True)
    back[phi] = angle
    return m**power.exp * sympy.exp(sympy.I * power.exp * phi)
