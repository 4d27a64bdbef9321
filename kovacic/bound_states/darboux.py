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
from typing import Any, NamedTuple

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


class _Regular(NamedTuple):
    """A pole c of V with the exponents (1 +- delta)/2."""

    c: Any
    delta: Any


class _Poles(NamedTuple):
    """The factors at whose roots V ~ 2/(x - c)^2, and the other poles."""

    apparent: list[Any]
    regular: list[_Regular]


def steps(V: Any, x: Any, domain: tuple[Any, Any], signs: Signs) -> Iterator[DarbouxStep]:
    """The transformations that remove all of the apparent poles, for V = alpha x^2 + ... in real symbols."""
    V = sympy.cancel(sympy.together(V))
    poles = _poles(V, x)
    if poles is None or not poles.apparent:
        return
    line = _line(V, x, signs)
    if line is None:
        return
    q = sympy.Mul(*poles.apparent)
    for sign in (-1, 1):
        for choice in product((1, -1), repeat=len(poles.regular)):
            exponents = {pole: (1 + s * pole.delta) / 2 for s, pole in zip(choice, poles.regular, strict=True)}
            terms = [e / (x - pole.c) for pole, e in exponents.items()]
            W = sympy.together(-sympy.diff(q, x) / q + sympy.Add(*terms) + sign * line)
            energy = sympy.cancel(sympy.together(V - W**2 - sympy.diff(W, x)))
            if energy.has(x):
                continue
            powers = [(x - pole.c) ** e for pole, e in exponents.items()]
            wave = sympy.Mul(*powers) * sympy.exp(sympy.integrate(sign * line, x)) / q
            is_level = _is_level(sign, exponents, domain, signs)
            if is_level is not None:
                yield DarbouxStep(W, energy, wave, is_level)


def _line(V: Any, x: Any, signs: Signs) -> Any:
    """kappa x + beta/(2 kappa) for V = kappa^2 x^2 + beta x + ... with kappa^2 > 0; None for other V."""
    num, den = sympy.fraction(V)
    quotient, _ = sympy.div(sympy.Poly(num, x), sympy.Poly(den, x))
    if quotient.degree() != 2 or signs.sign(quotient.LC()) != 1:
        return None
    kappa = exact_root(quotient.LC()) or sympy.sqrt(quotient.LC())
    return kappa * x + quotient.coeff_monomial(x) / (2 * kappa)


def _poles(V: Any, x: Any) -> _Poles | None:
    """Those of V; None where there are others."""
    poles = _Poles([], [])
    for factor, multiplicity in sympy.factor_list(sympy.denom(V), x)[1]:
        if multiplicity != 2:
            return None
        if _is_apparent(factor, V, x):
            poles.apparent.append(factor)
            continue
        regular = _regular(factor, V, x)
        if regular is None:
            return None
        poles.regular.append(regular)
    return poles


def _regular(factor: Any, V: Any, x: Any) -> _Regular | None:
    """The root c of a linear factor, where V ~ b/(x - c)^2; None for another factor, or where delta is no function."""
    if sympy.degree(factor, x) > 1:
        return None
    (c,) = sympy.solve(factor, x)
    b = sympy.factor(sympy.cancel(V * (x - c) ** 2).subs(x, c))
    delta = exact_root(sympy.factor(1 + 4 * b))
    if delta is None:
        return None
    return _Regular(c, delta)


def _is_apparent(factor: Any, V: Any, x: Any) -> bool:
    """Is V ~ 2/(x - c)^2 at the roots of the factor f, where V f^2 = 2 f'^2 mod f?"""
    above, below = sympy.fraction(sympy.together(sympy.cancel(V * factor**2)))
    remainder = sympy.rem(above - 2 * sympy.diff(factor, x) ** 2 * below, factor, x)
    return bool(sympy.expand(remainder) == 0)


def _is_level(sign: int, exponents: dict[_Regular, Any], domain: tuple[Any, Any], signs: Signs) -> bool | None:
    """Is y0 = exp(sign kappa x^2/2) ... the smaller solution at both ends?  None where that isn't known."""
    finite = [end for end in domain if not end.is_infinite]
    if sign > 0 and len(finite) < len(domain):
        return False
    for end in finite:
        exponent = _exponent_at(end, exponents)
        if exponent is None:
            return None
        excess = signs.sign(2 * exponent - 1)
        if excess is None:
            return None
        if excess < 0:
            return False
    return True


def _exponent_at(end: Any, exponents: dict[_Regular, Any]) -> Any:
    """The one at the pole that is this end; None where none is."""
    for pole, exponent in exponents.items():
        if sympy.simplify(pole.c - end) == 0:
            return exponent
    return None
