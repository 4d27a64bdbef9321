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
from kovacic.bound_states.frame import Original, Uncovered
from kovacic.bound_states.signs import Signs
from kovacic.errors import InputError
from kovacic.numerals import as_text
from kovacic.writing.formula import caret

NO_LEVELS = "a periodic potential: what decays at one end grows at the other (Floquet), the spectrum consists of bands"
#: Longer ends of a domain aren't proposed.
_LONGEST = 30


def on_real_circle(V: Any, original: Original, t: Any) -> tuple[Any, Original]:
    """A function of exp(i theta) as one of tan(theta/2); any other one as it is."""
    if not original.is_circular:
        return V, original
    rate = sympy.expand(original.rate / sympy.I)
    offset = sympy.expand(original.offset / sympy.I)
    value = (1 + sympy.I * t) / (1 - sympy.I * t)
    real = sympy.cancel(sympy.together(V.xreplace({t: value})), extension=sympy.I)
    return _with_real_parts(real, t), Original(original.x, "tan", rate / 2, offset / 2)


def _with_real_parts(V: Any, t: Any) -> Any:
    """A real function whose numerator and denominator have a complex factor in common, without it."""
    num, den = sympy.fraction(sympy.together(V))
    scale = sympy.Poly(den, t).LC()
    return sympy.expand(sympy.expand(num / scale)) / sympy.expand(sympy.expand(den / scale))


def check_poles(V: Any, original: Original, t: Any, signs: Signs) -> None:
    """Raises `InputError` where V has a real pole, with a domain between two, and `Uncovered` where that isn't known."""
    angles = _poles(V, original, t, signs)
    if not angles:
        return
    period = sympy.pi if original.kind == "tan" else 2 * sympy.pi
    places = sorted((angle + k * period for angle in angles for k in (-1, 0, 1)), key=float)
    last = min((angle for angle in places if angle > 0), key=float)
    first = places[places.index(last) - 1]
    ends = [sympy.simplify((angle - original.offset) / original.rate) for angle in (first, last)]
    place = caret(as_text(ends[1]))
    message = f"V has poles on the line, one at {original.x} = {place} and others in each period of it"
    hint = "choose the domain between two neighbouring poles"
    if len(place) > _LONGEST:
        raise InputError(message, hint=hint)
    python, shell = domain_as_given(*ends)
    raise InputError(message, hint=f"{hint}: {python}", shell=f"{hint}: {shell}")


def _poles(V: Any, original: Original, t: Any, signs: Signs) -> list[Any]:
    """The real angles theta of poles in a period."""
    u = sympy.Dummy("u")
    values = {"tan": u, "sin": 2 * u / (1 + u**2), "cos": (1 - u**2) / (1 + u**2)}
    angle = 1 if original.kind == "tan" else 2
    num, den = (sympy.Poly(part, u) for part in sympy.fraction(sympy.cancel(V.xreplace({t: values[original.kind]}))))
    found = [angle * sympy.atan(root) for root in real_zeros(den, signs)]
    may_have_more = signs.sign(den.LC()) is None  # where the degree falls there is a pole at u = oo
    if may_have_more or not all(theta.is_number for theta in found):
        raise Uncovered("V is periodic, and where its poles are isn't known")
    if num.degree() > den.degree():
        found.append(angle * sympy.pi / 2)
    return found
