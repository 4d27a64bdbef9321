"""The equation den y'' = num y with integer coefficients, and rigorous enclosures of its singular points.

Symbols: S = num/den; zeta_i the zeros of den (the singular points), eta_j the zeros of num.  The zeros are enclosed by
FLINT's certified isolation (`fmpz_poly.complex_roots`: pairwise disjoint rectangles, one zero in each) and refined
when a
distance cannot be told from zero.  Whether a path meets a singular point is decided exactly, by Sturm-free real root
isolation of the common factor of two polynomials over Q.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from kovacic.enclosure.points import Point, to_acb
from kovacic.errors import InputError

if TYPE_CHECKING:
    from flint import acb, fmpz_poly

_NUMERATOR_ROOTS = 128
"""Above this degree the zeros of the numerator aren't isolated (its size is then bounded by its coefficients)."""


@dataclass(frozen=True)
class System:
    """den y'' = num y: integer coefficients, low to high, without a common factor, den not zero.

    >>> System.make((2, 0), (0, 0, 4))   # S = 2/(4 x^2)
    System(num=(1,), den=(0, 0, 2))
    """

    num: tuple[int, ...]
    den: tuple[int, ...]
    _cache: dict[tuple[str, int], tuple[tuple[acb, int], ...]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @classmethod
    def make(cls, num: tuple[int, ...], den: tuple[int, ...]) -> System:
        """The system in lowest terms; raises InputError if den is zero."""
        from flint import fmpz_poly

        p, q = fmpz_poly(list(num)), fmpz_poly(list(den))
        if q == 0:
            raise InputError("the denominator of S is zero")
        g = p.gcd(q)
        p, q = p // g, q // g
        if q.leading_coefficient() < 0:
            p, q = -p, -q
        return cls(tuple(int(c) for c in p.coeffs()), tuple(int(c) for c in q.coeffs()))

    def __getstate__(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        return self.num, self.den

    def __setstate__(self, state: tuple[tuple[int, ...], tuple[int, ...]]) -> None:
        object.__setattr__(self, "num", state[0])
        object.__setattr__(self, "den", state[1])
        object.__setattr__(self, "_cache", {})

    def roots(self, which: str, prec: int) -> tuple[tuple[acb, int], ...]:
        """Enclosures of the zeros of "num" or "den" at about `prec` bits, with multiplicities (kept for the next
        call)."""
        from flint import ctx, fmpz_poly

        level = 64
        while level < prec:
            level *= 2
        key = (which, level)
        if key not in self._cache:
            poly = fmpz_poly(list(getattr(self, which)))
            with ctx.workprec(level):
                found = tuple((root, int(mult)) for root, mult in poly.complex_roots()) if poly.degree() > 0 else ()
            self._cache[key] = found
        return self._cache[key]

    def numerator_roots(self, prec: int) -> tuple[tuple[acb, int], ...] | None:
        """Zeros of the numerator, or None where there are too many of them to be worth isolating."""
        return self.roots("num", prec) if len(self.num) - 1 <= _NUMERATOR_ROOTS else None

    def is_singular(self, point: Point) -> bool:
        """True if the point is a zero of the denominator, decided exactly."""
        value = Point(Fraction(0))
        for c in reversed(self.den):
            value = value * point + Point(Fraction(c))
        return value.re == 0 and value.im == 0


def offsets(
    system: System, which: str, centre: Point, *, bits: int = 40
) -> tuple[tuple[complex, float, int, int], ...] | None:
    """The zeros seen from `centre`, each as (d, error, e, multiplicity): |zero - centre - d 2^e| <= error 2^e.

    Each d has size about 1, so tiny and huge distances keep their relative accuracy (at least `bits` bits).  None for a
    numerator whose zeros aren't isolated.  Raises InputError if the centre is a zero itself.
    """
    from flint import ctx

    prec = 64 + _bits(centre)
    result: list[tuple[complex, float, int, int]] = []
    while True:
        found = system.numerator_roots(prec) if which == "num" else system.roots(which, prec)
        if found is None:
            return None
        with ctx.workprec(max(128, prec)):
            here = to_acb(centre)
            result.clear()
            sharp = True
            for root, multiplicity in found:
                delta = root - here
                item = _scaled(delta)
                if which == "den" and item[1] > 2.0**-bits * abs(item[0]):
                    sharp = False
                    break
                result.append((*item, multiplicity))
        if sharp:
            return tuple(result)
        if prec > 400 and system.is_singular(centre):
            raise InputError(f"the point {centre} is a singular point of the equation")
        prec *= 2


def _bits(point: Point) -> int:
    parts = (point.re.numerator, point.re.denominator, point.im.numerator, point.im.denominator)
    return min(max(abs(part).bit_length() for part in parts), 1 << 14)


def _scaled(delta: acb) -> tuple[complex, float, int]:
    """Midpoint and radius of a complex ball as (d, error, e), with d of size about 1 (rounded outwards)."""
    upper = delta.abs_upper()
    if upper.is_zero():
        return 0j, 0.0, 0
    mantissa, exponent = upper.mid().man_exp()
    e = int(exponent) + int(mantissa).bit_length()
    unit = -e
    d = complex(_float(delta.real.mid(), unit), _float(delta.imag.mid(), unit))
    error = _float(delta.real.rad(), unit) + _float(delta.imag.rad(), unit)
    return d, error * (1 + 2.0**-40) + 2.0**-50, e


def _float(value: object, shift: int) -> float:
    mantissa, exponent = value.man_exp()  # type: ignore[attr-defined]
    m, e = int(mantissa), int(exponent) + shift
    excess = m.bit_length() - 64
    if excess > 0:
        m, e = m >> excess, e + excess
    return math.ldexp(float(m), e) if e > -2000 else 0.0


def distance_lower(system: System, centre: Point) -> tuple[float, int] | None:
    """A proven lower bound (d, e), d 2^e with d > 0, of the distance to the nearest singular point; None if there is
    none."""
    best: tuple[float, int] | None = None
    for d, error, e, _ in offsets(system, "den", centre) or ():
        lower = (abs(d) - error) * (1 - 2.0**-45)
        if best is None or math.ldexp(lower, max(min(e - best[1], 1000), -1060)) < best[0]:
            best = (lower, e)
    return best


def check_segment(system: System, a: Point, b: Point) -> None:
    """Raise InputError if the closed segment from a to b contains a singular point, with that point and the distances.

    Exact: den(a + t (b - a)) = A(t) + i B(t) with A, B in Q[t]; the segment is singular where gcd(A, B) has a real zero
    t in [0, 1].
    """
    for name, point in (("start", a), ("end", b)):
        if system.is_singular(point):
            raise InputError(
                f"the {name} {point} of the path is a singular point of the equation (distance 0)",
                hint="choose a point beside it; the solutions aren't analytic there",
            )
    hit = _first_hit(system, a, b)
    if hit is not None:
        where, along = hit
        raise InputError(
            f"the path from {a} to {b} runs through the singular point near {where} "
            f"(distance 0; {along:.6g} from the start)",
            hint="go around it through the complex plane, e.g. path=[...] with a vertex off the axis; "
            "the result depends on the side",
        )


def _first_hit(system: System, a: Point, b: Point) -> tuple[str, float] | None:
    from flint import ctx

    step = b - a
    if step.norm_squared() == 0:
        return None
    real_part, imag_part = _restricted(system, a, step)
    common = real_part.gcd(imag_part) if imag_part != 0 else real_part
    if common.degree() < 1:
        return None
    poly = common.numer()
    prec = 64
    while True:
        with ctx.workprec(prec):
            roots = [root for root, _ in poly.complex_roots() if root.imag.is_zero()]
            unclear = False
            for root in sorted(roots, key=lambda r: float(r.real.mid())):
                t = root.real
                if t < 0 or t > 1:
                    continue
                if t.contains(0) or t.contains(1):  # the ends were excluded exactly: refine
                    unclear = True
                    break
                where = to_acb(a) + to_acb(step) * t
                length = math.sqrt(step.norm_squared())
                text = where.real.mid().str(12, radius=False)
                if not (a.is_real() and b.is_real()):
                    text += f" + {where.imag.mid().str(12, radius=False)}i"
                return text, float(t.mid()) * length
        if not unclear:
            return None
        prec *= 2


def _restricted(system: System, a: Point, step: Point) -> tuple[fmpz_poly, fmpz_poly]:
    """Real and imaginary part of den(a + t step) as polynomials in t over Q."""
    from flint import fmpq, fmpq_poly

    def q(x: Fraction) -> fmpq:
        return fmpq(x.numerator, x.denominator)

    lr, li = fmpq_poly([q(a.re), q(step.re)]), fmpq_poly([q(a.im), q(step.im)])
    if a.is_real() and step.is_real():
        return fmpq_poly(list(system.den))(lr), fmpq_poly([])
    real, imag = fmpq_poly([]), fmpq_poly([])
    for c in reversed(system.den):
        real, imag = real * lr - imag * li + c, real * li + imag * lr
    return real, imag
