"""Darboux' transformation: a rational potential with apparent singularities as one without, all levels at once.

With a rational W, W' + W^2 = V - E0, the operator d/dx - W takes solutions for V to solutions for V - 2 W' with the same E,
and d/dx + W takes them back, up to the factor E0 - E.  Where W has no residue 1 inside the domain y0 = exp(int W) has no zero,
so that E0 isn't above the lowest level; it is this level exactly where y0 is square integrable.  At a regular end both
operators take the smaller solution to the smaller one where nu >= 1 for V and for V - 2 W'; at an irregular end they keep the
decaying one.  So the levels for V are those for V - 2 W', and E0 where y0 is square integrable; and

    int ((d/dx + W) y)^2 dx = (E - E0) int y^2 dx.

At a pole with V ~ 2/(x - c)^2 and no logarithm W has the residue -1.  The one-step exceptional families (Hermite, Laguerre) are
of this kind, with y0 = (a weight)/(a polynomial).

References: D. Gomez-Ullate, N. Kamran & R. Milson, J. Math. Anal. Appl. 359 (2009) 352; C. Quesne, J. Phys. A 41 (2008) 392001;
J. F. Carinena, A. M. Perelomov, M. F. Ranada & M. Santander, J. Phys. A 41 (2008) 085301.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

import sympy

from kovacic.bound_states.energies import exact_root
from kovacic.bound_states.signs import Signs


@dataclass(frozen=True)
class DarbouxStep:
    """W, E0, y0, and is y0 square integrable?"""

    W: Any
    energy: Any
    wave: Any
    is_level: bool


def steps(V: Any, x: Any, domain: tuple[Any, Any], signs: Signs) -> Iterator[DarbouxStep]:
    """The transformations that remove all of the apparent poles, for V = alpha x^2 + ... in real symbols."""
    V = sympy.cancel(sympy.together(V))
    parts = _poles(V, x)
    if parts is None or not parts[0]:
        return
    apparent, regular = parts
    quotient = sympy.div(*(sympy.Poly(part, x) for part in sympy.fraction(V)))[0]
    if quotient.degree() != 2 or not (first_is_sign := signs.sign(quotient.LC())) or first_is_sign < 0:
        return
    kappa = exact_root(quotient.LC()) or sympy.sqrt(quotient.LC())
    line = kappa * x + quotient.coeff_monomial(x) / (2 * kappa)
    q = sympy.Mul(*apparent)
    options = [[(1 + delta) / 2, (1 - delta) / 2] for _, delta in regular]
    for sign in (-1, 1):
        for exponents in product(*options):
            terms = [e / (x - c) for e, (c, _) in zip(exponents, regular, strict=True)]
            W = sympy.together(-sympy.diff(q, x) / q + sympy.Add(*terms) + sign * line)
            energy = sympy.cancel(sympy.together(V - W**2 - sympy.diff(W, x)))
            if energy.has(x):
                continue
            powers = [(x - c) ** e for e, (c, _) in zip(exponents, regular, strict=True)]
            wave = sympy.Mul(*powers) * sympy.exp(sympy.integrate(sign * line, x)) / q
            known = _is_level(sign, exponents, regular, domain, signs)
            if known is not None:
                yield DarbouxStep(W, energy, wave, known)


def _poles(V: Any, x: Any) -> tuple[list[Any], list[tuple[Any, Any]]] | None:
    """The factors at whose roots V ~ 2/(x - c)^2, and the other poles with delta^2 = 1 + 4 b; None for others."""
    apparent: list[Any] = []
    regular: list[tuple[Any, Any]] = []
    for factor, multiplicity in sympy.factor_list(sympy.denom(V), x)[1]:
        if multiplicity != 2:
            return None
        numerator = sympy.cancel(V * factor**2)
        above, below = sympy.fraction(sympy.together(numerator))
        residue = sympy.rem(above - 2 * sympy.diff(factor, x) ** 2 * below, factor, x)
        if sympy.expand(residue) == 0:
            apparent.append(factor)
            continue
        if sympy.degree(factor, x) > 1:
            return None
        (c,) = sympy.solve(factor, x)
        b = sympy.factor(sympy.cancel(V * (x - c) ** 2).subs(x, c))
        delta = exact_root(sympy.factor(1 + 4 * b))
        if delta is None:
            return None
        regular.append((c, delta))
    return apparent, regular


def _is_level(
    sign: int, exponents: tuple[Any, ...], regular: list[tuple[Any, Any]], domain: tuple[Any, Any], signs: Signs
) -> bool | None:
    """Is y0 the smaller solution at both ends?  None where that isn't known."""
    if sign > 0 and any(end.is_infinite for end in domain):
        return False
    for end in domain:
        if end.is_infinite:
            continue
        at = [(e, delta) for e, (c, delta) in zip(exponents, regular, strict=True) if sympy.simplify(c - end) == 0]
        if not at:
            return None
        e, _ = at[0]
        excess = signs.sign(2 * e - 1)
        if excess is None:
            return None
        if excess < 0:
            return False
    return True
