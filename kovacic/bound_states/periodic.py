"""Potentials that are rational in exp(i theta), sin theta, cos theta or tan theta, on a domain that ends at infinity.

With u = tan(theta/2), exp(i theta) = (1 + i u)/(1 - i u), sin theta = 2 u/(1 + u^2), cos theta = (1 - u^2)/(1 + u^2): the
poles of V are real zeros of a polynomial in u, and u = oo.  They come back in each period.

Where V has no poles there is no eigenvalue on the whole line: the multipliers of a period have the product 1, so that what
decays at one end grows at the other [Floquet; Eastham, The Spectral Theory of Periodic Differential Equations, 1973].
"""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.bound_states.ends import domain_as_given, real_zeros
from kovacic.bound_states.frame import Original, RealPotential
from kovacic.bound_states.question import Uncovered
from kovacic.bound_states.signs import Signs
from kovacic.errors import InputError
from kovacic.numbers.numerals import as_text
from kovacic.writing.formula import caret

NO_LEVELS = "a periodic potential: what decays at one end grows at the other (Floquet), the spectrum consists of bands"
#: Longer ends of a domain aren't proposed.
_LONGEST = 30


def on_real_circle(real: RealPotential) -> RealPotential:
    """A function of exp(i theta) as one of tan(theta/2); any other one unchanged."""
    original = real.original
    t = real.t
    if not original.is_circular:
        return real
    rate = sympy.expand(original.rate / sympy.I)
    offset = sympy.expand(original.offset / sympy.I)
    value = (1 + sympy.I * t) / (1 - sympy.I * t)
    V = sympy.cancel(sympy.together(real.V.xreplace({t: value})), extension=sympy.I)
    # V is real, but its numerator and denominator may have a complex factor in common.
    num, den = sympy.fraction(sympy.together(V))
    scale = sympy.Poly(den, t).LC()
    V = sympy.expand(sympy.expand(num / scale)) / sympy.expand(sympy.expand(den / scale))
    return RealPotential(V, Original(original.x, "tan", rate / 2, offset / 2), t, real.kinetic)


def check_poles(real: RealPotential, signs: Signs) -> None:
    """Raises `InputError` where V has a real pole, with a domain between two, and `Uncovered` where that isn't known."""
    original = real.original
    angles = _poles(real, signs)
    if not angles:
        return
    period = sympy.pi if original.kind == "tan" else 2 * sympy.pi
    # The least positive angle, and the one before it: they come back in each period.
    places = sorted((angle + k * period for angle in angles for k in (-1, 0, 1)), key=float)
    k = next(k for k, angle in enumerate(places) if angle > 0)
    first, last = places[k - 1 : k + 1]
    start = sympy.simplify((first - original.offset) / original.rate)
    stop = sympy.simplify((last - original.offset) / original.rate)
    place = caret(as_text(stop))
    message = f"V has poles on the line, one at {original.x} = {place} and others in each period of it"
    hint = "choose the domain between two neighbouring poles"
    if len(place) > _LONGEST:
        raise InputError(message, hint=hint)
    python, shell = domain_as_given(start, stop)
    raise InputError(message, hint=f"{hint}: {python}", shell=f"{hint}: {shell}")


def _poles(real: RealPotential, signs: Signs) -> list[Any]:
    """The real angles theta of poles in a period."""
    u = sympy.Dummy("u")
    kind = real.original.kind
    t_of_u = {"tan": u, "sin": 2 * u / (1 + u**2), "cos": (1 - u**2) / (1 + u**2)}
    angle = 1 if kind == "tan" else 2
    V = sympy.cancel(real.V.xreplace({real.t: t_of_u[kind]}))
    num, den = (sympy.Poly(part, u) for part in sympy.fraction(V))
    found = [angle * sympy.atan(root) for root in real_zeros(den, signs)]
    may_have_more = signs.sign(den.LC()) is None  # where the degree falls there is a pole at u = oo
    if may_have_more or not all(theta.is_number for theta in found):
        raise Uncovered("V is periodic, and where its poles are isn't known")
    if num.degree() > den.degree():
        found.append(angle * sympy.pi / 2)
    return found
