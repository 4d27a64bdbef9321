"""Darboux' transformation: a rational potential with apparent singularities as one without, all levels at once.

With a rational W, W' + W^2 = V - E0, the operator d/dx - W takes solutions for V to solutions for V - 2 W' with the same E, and
d/dx + W takes them back, up to the factor E0 - E.  Where W has no residue 1 inside the domain y0 = exp(int W) has no zero, so
that E0 isn't above the lowest level; it is this level exactly where y0 is square integrable.  (With such a residue V - 2 W' has
a pole there, which is refused.)  At a regular end W has the residue 1/2 + nu or 1/2 - nu, and V - 2 W' has nu + 1 or |nu - 1|
for nu.  Both operators take the smaller solution to the smaller one if nu >= 1, and for the residue 1/2 + nu, where y0 is the
smaller one; at an irregular end they keep the decaying one.  So the levels for V are those for V - 2 W', both with Friedrichs'
condition, and E0 where y0 is square integrable and obeys it; and

    int ((d/dx + W) y)^2 dx = (E - E0) int y^2 dx.

W comes from `kovacic.parametric`, which lowers apparent singularities by it for `conditions`; the one-step exceptional families
(Hermite, Laguerre) are of this kind, with y0 = (a weight)/(a polynomial).

References: D. Gomez-Ullate, N. Kamran & R. Milson, J. Math. Anal. Appl. 359 (2009) 352; C. Quesne, J. Phys. A 41 (2008) 392001;
J. F. Carinena, A. M. Perelomov, M. F. Ranada & M. Santander, J. Phys. A 41 (2008) 085301.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import sympy

from kovacic.bound_states.closed_forms import demands_of
from kovacic.bound_states.ends import Examined, examined
from kovacic.bound_states.levels import Algebraic, Spectrum
from kovacic.bound_states.signs import Uncovered
from kovacic.engine.places import analyse
from kovacic.errors import InputError
from kovacic.limits import Budget
from kovacic.parametric.partition import Transformation, transformations
from kovacic.parametric.solutions import derivative
from kovacic.reading.read import read_input


def transformed(
    question: Examined, budget: Budget, all_levels: Callable[[Examined, Budget], Spectrum]
) -> Spectrum | None:
    """The levels of a V in x with apparent singularities, from `all_levels` of a potential with fewer of them, or None."""
    if question.parsed.equation is not None or not all(
        wish is None or wish.is_zero for wish in question.boundary.wishes
    ):
        return None
    found = transformations(analyse(question.parsed.S, budget))
    spectra = (_by_transformation(question, one, budget, all_levels) for one in found)
    return next(filter(None, spectra), None)


def _by_transformation(
    question: Examined, found: Transformation, budget: Budget, all_levels: Callable[[Examined, Budget], Spectrum]
) -> Spectrum | None:
    """The levels from those of the simpler potential, or None where it isn't known that all of them are."""
    signs = question.signs
    x, E = sympy.symbols([question.variable, question.energy])
    if None in [signs.sign(signs.real(f.to_sympy(x))) for f in found.exceptions]:
        return None
    W, S, simpler = (f.to_sympy(x) for f in (found.W, question.parsed.S, found.simpler))
    E0 = question.plain(sympy.cancel(sympy.together((S.subs(E, 0) - W**2 - sympy.diff(W, x)) * question.kinetic)))
    wave = sympy.exp(sympy.integrate(sympy.apart(W, x), x))
    holds = [*map(signs.holds, demands_of(signs.real(wave), question))]
    is_meant = [end.is_limit_point or here for end, here in zip(question.ends, holds, strict=True)]
    if None in holds or not all(is_meant):
        return None
    parsed = read_input(simpler, var=question.variable, exponentials=True)
    try:
        other = examined(replace(question, S=simpler, parsed=parsed))
        spectrum = all_levels(other, budget)
    except (Uncovered, InputError):
        return None
    # E0 may be a level of the simpler potential, and isn't one of V then.
    gaps = (signs.real(one.energy - E0).xreplace({one.number: signs.n}) for one in spectrum.levels)
    if None in map(signs.sign, gaps) or not spectrum.complete or other.excluded:
        return None
    # The levels of the simpler potential with y' + W y for y, whose norm^2 is (E - E0)/k times that of y; and E0 with y0.
    W, lowest = question.plain(sympy.factor(W)), question.plain(wave)
    levels = []
    for one in spectrum.levels:
        # As a weight times a sum of orthogonal polynomials with rational coefficients.
        y = W * one.wave + derivative(one.wave, x)
        polynomials = y.atoms(sympy.hermite, sympy.assoc_laguerre)
        weight = one.wave.xreplace(dict.fromkeys(polynomials, sympy.S.One))
        y = weight * sympy.collect(sympy.expand(y / weight), polynomials, sympy.factor)
        norm = (one.energy - E0) / question.kinetic * one.norm
        levels.append(replace(one, wave=y, zeros=one.zeros + int(all(holds)), norm=norm))
    level = Algebraic(0, sympy.Integer(0), E - E0, lowest, P=sympy.Poly(1, x), range=question.interval)
    if not question.parameters:
        level = replace(level, states=tuple(level.states_at({}, E)))
    shown = question.shown(sympy.factor(question.kinetic * simpler.subs(E, 0)))
    return question.spectrum(
        levels=tuple(levels),
        algebraic=(level,) if all(holds) else (),
        complete=True,
        reason=f"Darboux' transformation of V = {shown}; {spectrum.reason}",
    )
