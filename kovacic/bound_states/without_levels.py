"""Potentials that are rational in exp(i theta), sin theta, cos theta or tan theta, on a domain that ends at infinity.

With u = tan(theta/2), exp(i theta) = (1 + i u)/(1 - i u), sin theta = 2 u/(1 + u^2), cos theta = (1 - u^2)/(1 + u^2): the
poles of V are real zeros of a polynomial in u, and u = oo.  They come back in each period.

Where V has no poles there is no eigenvalue on the whole line: the multipliers of a period have the product 1, so that what
decays at one end grows at the other [Floquet; Eastham, The Spectral Theory of Periodic Differential Equations, 1973].

Repulsive potentials have no eigenvalues either, by the virial theorem.  Let c be the finite end of a half-line, or any point
of the line, and (x - c) V'(x) <= 0, V not constant.  For y'' = (V - E) y

    G = (x - c) (y'^2 - (V - E) y^2) + y y'        has        G' = 2 y'^2 - (x - c) V' y^2 >= 0.

V has finite limits at infinity, where y and y' are square integrable, so that G comes as near to 0 as one likes; and G -> 0 at
the end c, where y is the smaller solution: V' <= 0 means that V isn't below -1/(4 (x - c)^2) there.  So G = 0, and y = 0.

Reference: J. Weidmann, Bull. Amer. Math. Soc. 73 (1967) 452.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.bound_states.frame import End, Original, RealPotential, domain_as_given, range_of, real_zeros
from kovacic.bound_states.question import Signs, Uncovered
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


REASON = "a repulsive potential, (x - c) V'(x) <= 0 for some c: no solution is square integrable (the virial theorem)"


def is_repulsive(real: RealPotential, ends: Sequence[End], signs: Signs) -> bool:
    """True if the theorem is proven to apply."""
    original = real.original
    infinite = [end for end in ends if end.at.is_infinite]
    has_limits = all(end.threshold is not None for end in infinite)
    rate = signs.sign(original.rate)
    if (
        not infinite
        or not has_limits
        or original.kind not in ("x", "exp", "sinh")
        or rate is None
        or not real.V.has(real.t)
    ):
        return False
    first, last = (end.at for end in ends)
    centre = next((at for at in (first, last) if at.is_finite), sympy.Integer(0))
    slope = sympy.factor(sympy.diff(real.V, real.t))
    # V increases on the left of the centre, and falls on the right; t grows with x for a positive rate.
    for sign, half in ((rate, (first, centre)), (-rate, (centre, last))):
        is_empty = half[0] == half[1]
        if not is_empty and not _has_sign(slope, real.t, range_of(original, half, signs), sign, signs):
            return False
    return True


def _has_sign(function: Any, t: Any, bounds: tuple[Any, Any], sign: int, signs: Signs) -> bool:
    """True if the function isn't of the other sign between two bounds, of which one may be infinite."""
    low, high = bounds
    s = sympy.Dummy("s", positive=True)
    if low is not None and high is not None:
        inside = low + (high - low) * s / (1 + s)
    elif low is None and high is None:
        inside = sympy.Dummy("t", real=True)
    else:
        inside = low + s if high is None else high - s
    return signs.is_nonnegative(sign * function.xreplace({t: inside})) is True
