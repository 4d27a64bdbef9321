"""Two solutions that are real at a point where x - a is negative, from two that are real on the other side.

log(u) = log(-u) + i pi and u^e = exp(i pi e) (-u)^e for u < 0.  Often log(-u) and (-u)^e in their places give a solution as
well; otherwise the real and the imaginary part of each solution are solutions, the equation being real.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import is_numerical_solution
from kovacic.errors import InputError
from kovacic.general_solution.products import is_solution
from kovacic.reading.given import Equation
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types
#: The largest real part (in operations, by those of the solution) that is written instead of a solution.
_LARGEST = 4


def real_basis(solution: Solution, y1: Expr, y2: Expr, x: Expr, point: Expr) -> tuple[Expr, Expr]:
    """Two solutions that are real at the point, if such are found; else the given ones."""
    if not point.is_real or not any(_negative(y, x, point) for y in (y1, y2)):
        return y1, y2
    found: list[Expr] = []
    for y in (y1, y2):
        negative = _negative(y, x, point)
        turned = y.xreplace({e: e.func(-u, *e.args[1:]) for e, u in negative.items()})
        if is_numerical_solution(turned, x, solution.S, solution.gauge):
            found.append(turned)
        else:
            found += _parts(y, negative, x)
    for k, second in enumerate(found[1:], 1):
        wronskian = (found[0] * second.diff(x) - found[0].diff(x) * second).subs(x, point)
        if abs(wronskian.evalf(30)) > 1e-20:
            return found[0], found[k]
    return y1, y2


def check_one_side(pair: tuple[Expr, Expr], x: Expr, points: Sequence[Expr]) -> None:
    """Raises `ValueError` where a singular point lies between two of the points, so that no real solution joins them."""
    sides = {frozenset(e for y in pair for e in _negative(y, x, p)) for p in points if p.is_real}
    if len(sides) > 1:
        said = ", ".join(map(str, points))
        raise InputError(f"a singular point of the equation lies between {said}: on each side the solutions are others")


def real_particular(y: Expr, equation: Equation, x: Expr, point: Expr) -> Expr:
    """A solution of the inhomogeneous equation that is real at the point, if one is found; else the given one."""
    negative = _negative(y, x, point) if point.is_real else {}
    if not negative or y.has(sympy.Integral, sympy.Heaviside):
        return y
    right = (Atoms(x).sum(equation.f) + (equation.h or 0)) / Atoms(x).ratio(equation.a)
    candidates = [y.xreplace({e: e.func(-u, *e.args[1:]) for e, u in negative.items()}), *_parts(y, negative, x)[:1]]
    return next((found for found in candidates if is_solution(found, equation, right, x)), y)


def _negative(y: Expr, x: Expr, point: Expr) -> dict[Expr, Expr]:
    """The logarithms and roots in an expression whose arguments are negative at the point, and these arguments."""
    candidates = {e: e.args[0] for e in y.atoms(sympy.log)}
    candidates |= {e: e.base for e in y.atoms(sympy.Pow) if not e.exp.is_Integer and e.base.has(x)}
    return {e: u for e, u in candidates.items() if u.subs(x, point).is_negative}


def _parts(y: Expr, negative: dict[Expr, Expr], x: Expr) -> list[Expr]:
    """The real and the imaginary part, those that aren't zero; the expression itself where they would be long."""
    t = sympy.Dummy(real=True)
    bases = {u: sympy.Dummy(positive=True) for u in negative.values()}

    def real(e: Expr, u: Expr) -> Expr:
        p = bases[u]
        return (
            sympy.log(p) + sympy.I * sympy.pi
            if e.func is sympy.log
            else p**e.exp * sympy.exp(sympy.I * sympy.pi * e.exp)
        )

    exact = y.xreplace({e: real(e, u) for e, u in negative.items()}).subs(x, t)
    back = {p: -u for u, p in bases.items()} | {t: x}
    parts = [part.xreplace(back) for part in sympy.expand(exact, complex=True).as_real_imag() if part != 0]
    short = all(
        part.count_ops() <= _LARGEST * (y.count_ops() + 5) and not part.has(sympy.re, sympy.im) for part in parts
    )
    return parts if short else [y]
