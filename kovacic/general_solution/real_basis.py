"""Two solutions that are real at a point where x - a is negative, from two that are real on the other side.

log(u) = log(-u) + i pi and u^e = exp(i pi e) (-u)^e for u < 0.  Often log(-u) and (-u)^e in their places give a solution as
well; otherwise the real and the imaginary part of each solution are solutions, the equation being real.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import sympy
from flint import acb, ctx
from sympy.functions.special.bessel import BesselBase

from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import DIGITS, is_numerical_solution
from kovacic.closed_form.jets import jet
from kovacic.equation import Equation
from kovacic.general_solution.substitution import size
from kovacic.general_solution.variation import is_solution, rates
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
#: The largest real part (in subexpressions, by those of the solution) that is written instead of a solution.
_LARGEST = 4
_COMPLEX = (sympy.re, sympy.im, sympy.Abs, sympy.arg, sympy.atan2)


def real_basis(solution: Solution, y1: Expr, y2: Expr, x: Expr, point: Expr) -> tuple[Expr, Expr]:
    """Two solutions that are real at the point, if such are found; else the given ones."""
    if not point.is_real or not any(negative_arguments(y, x, point) for y in (y1, y2)):
        return y1, y2
    found: list[Expr] = []
    for y in (y1, y2):
        negative = negative_arguments(y, x, point)
        turned = y.xreplace({e: _turned(e) for e, u in negative.items()})
        if is_numerical_solution(turned, x, solution.S, solution.gauge):
            found.append(turned)
        else:
            found += _parts(y, point, x)
    second = next((k for k in range(1, len(found)) if are_independent(found[0], found[k], x)), None)
    return (y1, y2) if second is None else (found[0], found[second])


def are_independent(y1: Expr, y2: Expr, x: Expr) -> bool:
    """Is the Wronskian seen not to be zero at a point?"""
    with ctx.workdps(DIGITS), suppress(NotImplementedError):
        (u, du, _), (v, dv, _) = (jet(y, x, acb("0.37", "0.61")) for y in (y1, y2))
        return not (u * dv - du * v).contains(0)
    return False


def real_particular(y: Expr, equation: Equation, x: Expr, point: Expr) -> Expr:
    """A solution of the inhomogeneous equation that is real at the point, if one is found; else the given one."""
    negative = negative_arguments(y, x, point) if point.is_real else {}
    if not negative or y.has(sympy.Integral, sympy.Heaviside):
        return y
    right = (Atoms(x).sum(equation.f) + (equation.h or 0)) / Atoms(x).ratio(equation.a)
    coefficients = rates(equation, x)
    candidates = [y.xreplace({e: _turned(e) for e, u in negative.items()}), *_parts(y, point, x)[:1]]
    return next((found for found in candidates if is_solution(found, coefficients, right, x)), y)


def _arguments(y: Expr, x: Expr) -> dict[Expr, Expr]:
    """The logarithms, roots and Bessel's functions in an expression, and their arguments."""
    candidates = {e: e.args[-1] for e in y.atoms(sympy.log, BesselBase)}
    return candidates | {e: e.base for e in y.atoms(sympy.Pow) if not e.exp.is_Integer and e.base.has(x)}


def _turned(e: Expr) -> Expr:
    if e.is_Pow:
        return (-e.base) ** e.exp
    return e.func(*e.args[:-1], -e.args[-1], evaluate=False)  # SymPy writes J(-z) as J(z) (-z)^nu/z^nu


def negative_arguments(y: Expr, x: Expr, point: Expr) -> dict[Expr, Expr]:
    """Those whose arguments are negative at the point."""
    return {e: u for e, u in _arguments(y, x).items() if u.subs(x, point).is_negative}


def _parts(y: Expr, point: Expr, x: Expr) -> list[Expr]:
    """The real and the imaginary part, those that aren't zero; the expression itself where they would be long.

    A number a + i b with a constant modulus m becomes m exp(i acos(a/m)).
    """
    if y.has(sympy.RootSum, BesselBase):
        return [y]
    t, turn = sympy.Dummy(real=True), sympy.I * sympy.pi
    back: dict[Expr, Expr] = {t: x}
    real: dict[Expr, Expr] = {}
    for e, u in _arguments(y, x).items():
        value = u.subs(x, point)
        if value.is_negative or (value.is_positive and not u.has(*real)):
            p = next((p for p, known in back.items() if known in (u, -u) and p is not t), sympy.Dummy(positive=True))
            back[p], phase = (-u, turn) if value.is_negative else (u, 0)
            real[e] = sympy.log(p) + phase if e.func is sympy.log else p**e.exp * sympy.exp(phase * e.exp)
    exact = y.xreplace(real).subs(x, t)
    for power in exact.atoms(sympy.Pow):
        a, b = power.base.as_real_imag()
        square = sympy.expand((a**2 + b**2).xreplace(back))
        if b != 0 and not power.exp.is_Integer and not square.has(x):
            angle, m = sympy.Dummy(real=True), sympy.sqrt(square)
            back[angle] = sympy.acos(a.xreplace(back) / m) * (-1 if b.could_extract_minus_sign() else 1)
            exact = exact.xreplace({power: m**power.exp * sympy.exp(sympy.I * power.exp * angle)})
    parts = [
        part.xreplace(back).as_independent(x, as_Add=False)[1]
        for part in sympy.expand(exact, complex=True).as_real_imag()
        if part != 0
    ]
    short = all(size(part) <= _LARGEST * (size(y) + 5) and not part.has(*_COMPLEX) for part in parts)
    return parts if short else [y]
