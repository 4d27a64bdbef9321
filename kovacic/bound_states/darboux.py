"""Darboux' transformation: a rational potential with apparent singularities as one without, all levels at once.

With a rational W, W' + W^2 = V - E0, the operator d/dx - W takes solutions for V to solutions for V - 2 W' with the same E,
and d/dx + W takes them back, up to the factor E0 - E.  Where W has no residue 1 inside the domain y0 = exp(int W) has no zero,
so that E0 isn't above the lowest level; it is this level exactly where y0 is square integrable.  At a regular end both
operators take the smaller solution to the smaller one where nu >= 1 for V and for V - 2 W'; at an irregular end they keep the
decaying one.  So the levels for V are those for V - 2 W', and E0 where y0 is square integrable; and

    int ((d/dx + W) y)^2 dx = (E - E0) int y^2 dx.

W comes from `kovacic.parametric`, which lowers apparent singularities by it for `conditions`; the one-step exceptional families
(Hermite, Laguerre) are of this kind, with y0 = (a weight)/(a polynomial).

References: D. Gomez-Ullate, N. Kamran & R. Milson, J. Math. Anal. Appl. 359 (2009) 352; C. Quesne, J. Phys. A 41 (2008) 392001;
J. F. Carinena, A. M. Perelomov, M. F. Ranada & M. Santander, J. Phys. A 41 (2008) 085301.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.bound_states.closed_forms import demand_at
from kovacic.bound_states.ends import End
from kovacic.bound_states.question import SpectralProblem
from kovacic.engine.places import analyse
from kovacic.limits import Budget
from kovacic.parametric.partition import transformation


@dataclass(frozen=True)
class DarbouxStep:
    """W, E0, y0, and whether y0 is square integrable; in real symbols, y0 in the user's variable."""

    W: Any
    energy: Any
    wave: Any
    is_level: bool


def step(question: SpectralProblem, ends: Sequence[End], budget: Budget) -> DarbouxStep | None:
    """The transformation that lowers the apparent singularities of a V in x; None if none is known to apply."""
    if question.parsed.equation is not None or not all(end.circle is False for end in ends):
        return None
    found = transformation(analyse(question.parsed.S, budget))
    signs = question.signs
    x = sympy.Symbol(question.variable)
    if found is None or any(signs.sign(signs.real(f.to_sympy(x))) is None for f in found.exceptions):
        return None
    W = signs.real(found.W.num.to_sympy(x) / found.W.den.to_sympy(x))
    energy = sympy.cancel(sympy.together(signs.real(question.V) - W**2 - sympy.diff(W, x)))
    if energy.has(x):
        return None
    wave = sympy.exp(sympy.integrate(sympy.apart(W, x), x))
    known = [signs.holds(demand_at(end, wave, question)) for end in ends]
    if None in known:
        return None
    return DarbouxStep(W.xreplace({x: question.x}), energy, wave, all(known))
