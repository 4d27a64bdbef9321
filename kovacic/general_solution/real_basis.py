"""Two solutions that are real at a point where x - a is negative, from two that are real on the other side.

log(u) = log(-u) + i pi and u^e = exp(i pi e) (-u)^e for u < 0.  Often log(-u) and (-u)^e in their places give a solution as
well; otherwise the real and the imaginary part of each solution are solutions, the equation being real.
"""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.closed_form.check import is_numerical_solution
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
