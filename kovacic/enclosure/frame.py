"""The equation seen from the centre of a disc, and bounds of its coefficients along rays.

With x = c + H u (H = h 2^e, c dyadic) the equation is q(u) y'' = p(u) y over Z[i]: `shift_system` gives it exactly, and
`ray_bound` the majorant z'' = sigma z + rho of `kovacic.enclosure.taylor`, with sigma >= |p/q| and the least |q| from the
enclosed zeros of the numerator and the denominator of S.

Rounding of the bounds: they are computed in double precision on positive quantities, and every one is multiplied by
1 + 2^-20, which exceeds the rounding errors of the at most some thousand operations by orders of magnitude.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from kovacic.enclosure.points import Point
from kovacic.enclosure.singular import System, offsets

Zeros = tuple[tuple[complex, float, int], ...]
"""Zeros in the variable u: (value, error, multiplicity)."""

Parts = tuple[list[int], list[int] | None]
"""Real and imaginary parts of the coefficients; None where all of the latter are zero."""

SLACK = 1 + 2.0**-20
_PIECES = 8
_SHORT = 2.0**-300
_FAR = 900
"""Zeros beyond 2^900 scales are treated as being there: |zero - u| is then bounded from the safe side separately."""


@dataclass(frozen=True)
class Frame:
    """The equation seen from a centre: x = c + H u, H = h 2^e with a small integer h.

    `poles` and `zeros` are those of S in the variable u (None: not isolated); `log2_lead` is log2 |H^2
    lc(num)/lc(den) H^(dn-dd)|, so
    that |H^2 S(c + H u)| = 2^log2_lead prod |u - zero| / (2^far_poles prod |u - pole|).
    """

    centre: Point
    h: int
    e: int
    poles: Zeros
    zeros: Zeros | None
    log2_lead: float
    far_poles: int = 0

    @property
    def scale(self) -> Fraction:
        """H, exactly."""
        return Fraction(self.h) * Fraction(2) ** self.e


def make_frame(system: System, centre: Point, h: int, e: int) -> Frame:
    """The frame of the equation at `centre` with scale H = h 2^e."""
    poles, far_poles = _in_scale(offsets(system, "den", centre) or (), h, e)
    seen = offsets(system, "num", centre)
    zeros, far_zeros = (None, 0) if seen is None else _in_scale(seen, h, e)
    if not system.num:
        return Frame(centre, h, e, poles, (), -math.inf, far_poles)
    lead = _log2(system.num[-1]) - _log2(system.den[-1])
    power = 2 + len(system.num) - len(system.den)
    return Frame(centre, h, e, poles, zeros, lead + power * (math.log2(h) + e) + far_zeros, far_poles)


def _in_scale(items: tuple[tuple[complex, float, int, int], ...], h: int, e: int) -> tuple[Zeros, int]:
    result, far = [], 0
    for d, error, k, multiplicity in items:
        shift = k - e
        if (
            shift > _FAR
        ):  # brought nearer by a power of two, which is kept apart: seen from |u| <= 1 only the size matters
            far += multiplicity * (shift - _FAR)
            shift = _FAR
        if shift < -_FAR:
            d, error, shift = 0j, 2.0**-_FAR, 0
        factor = math.ldexp(1.0 / h, shift)
        result.append((d * factor, error * factor * SLACK, multiplicity))
    return tuple(result), far


def _log2(value: int) -> float:
    size = abs(value).bit_length()
    return math.log2(abs(value) >> max(0, size - 60)) + max(0, size - 60)


@dataclass(frozen=True)
class RayBound:
    """Bounds along the ray from 0 to u: `growth` bounds |e|, |e'| at u for a defect |r/q| <= 1; `log2_min_q` is
    relative to lc(q)."""

    gain: float
    gain_derivative: float
    log2_min_q: float
    log2_growth: float


def ray_bound(frame: Frame, u: complex, log2_norm_p: float | None = None) -> RayBound | None:
    """Bounds of S and 1/q along the ray 0..u; None if a pole can't be excluded from it or the growth exceeds 2^900.

    `log2_norm_p` (log2 of sum |p_j|, relative to |lc(q)|) replaces the zeros of the numerator where they are not
    isolated.
    """
    step = 1.0 / _PIECES
    length = abs(u) * SLACK
    half = length * step / 2
    error, slope = 0.0, 0.0
    growth, slope_growth = 1.0, 1.0
    log2_min_q = math.inf
    for k in range(_PIECES):
        middle = u * ((k + 0.5) * step)
        logs = [float(frame.far_poles)]
        for zeta, radius, multiplicity in frame.poles:
            gap = abs(zeta - middle) * (1 - 2.0**-40) - half - radius
            if gap <= 0.0:
                return None
            logs.append(multiplicity * math.log2(gap))
        log2_q = math.fsum(logs) - _log_error(logs)
        if frame.zeros is None:
            if log2_norm_p is None:
                return None
            log2_s = log2_norm_p - log2_q
        elif frame.log2_lead == -math.inf:
            log2_s = -math.inf
        else:
            logs = [frame.log2_lead, -log2_q]
            for eta, radius, multiplicity in frame.zeros:
                logs.append(multiplicity * math.log2(abs(eta - middle) * (1 + 2.0**-40) + half + radius))
            log2_s = math.fsum(logs) + _log_error(logs)
        log2_min_q = min(log2_min_q, log2_q)
        if log2_s > 20:
            return None
        sigma = 2.0**log2_s if log2_s > -900 else 2.0**-900
        delta = length * step
        t = math.sqrt(sigma) * delta
        if t > 300:
            return None
        c = math.cosh(t)
        s = math.sinh(t) / t if t > 1e-4 else c  # sinh(t)/t <= cosh(t)
        half_c = 2 * (math.sinh(t / 2) / t) ** 2 if t > 1e-4 else c / 2  # (cosh(t) - 1)/t^2
        error, slope = (
            (error * c + slope * delta * s + delta * delta * half_c) * SLACK,
            (error * sigma * delta * s + slope * c + delta * s) * SLACK,
        )
        growth, slope_growth = (
            (growth * c + slope_growth * delta * s) * SLACK,
            (growth * sigma * delta * s + slope_growth * c) * SLACK,
        )
        if not growth + slope_growth < 2.0**900:
            return None
    return RayBound(error, slope, log2_min_q, math.log2(max(growth, slope_growth)))


def ray_to(system: System, frame: Frame, target: Point, log2_norm_p: float | None = None) -> RayBound:
    """Bounds along the ray from the centre to `target`; raises ArithmeticError where they can't be given.

    `log2_norm_p` as for `ray_bound`; computed where it's needed and not given.
    """
    offset = (target - frame.centre).scaled(1 / frame.scale)
    u = complex(float(offset.re), float(offset.im))
    if abs(u) < _SHORT:  # its powers would underflow; the bounds grow with the length of the ray
        u = complex(_SHORT)
    if frame.zeros is None and log2_norm_p is None:
        shifted = shift_system(system, frame)
        log2_norm_p = log2_norm(shifted.p) - log2_lead(shifted.q)
    bound = ray_bound(frame, u, log2_norm_p)
    if bound is None:
        raise ArithmeticError("the target lies outside of its disc")
    return bound


def _log_error(logs: list[float]) -> float:
    """A bound of the rounding error of a sum of logarithms (each accurate to some units in the last place)."""
    return 1e-12 * (1 + math.fsum(abs(v) for v in logs))


@dataclass(frozen=True)
class Shifted:
    """q y'' = p y over Z[i] in the variable u: real and imaginary coefficients (imaginary parts None for real
    centres)."""

    p: tuple[list[int], list[int] | None]
    q: tuple[list[int], list[int] | None]


def shift_system(system: System, frame: Frame) -> Shifted:
    """The exact equation in u, reduced by its content and with q_0 > 0."""
    c = frame.centre
    s = max(0, -frame.e, (c.re.denominator * c.im.denominator).bit_length())
    scale = frame.scale * 2**s
    cr, ci = c.re * 2**s, c.im * 2**s
    q = _substitute(system.den, s, int(cr), int(ci), int(scale))
    p = _substitute(system.num, s, int(cr), int(ci), int(scale))
    exponent = s * (len(system.den) - 1) - s * max(len(system.num) - 1, 0) - 2 * s
    p = tuple(None if part is None else [int(scale) ** 2 * v for v in part] for part in p)  # type: ignore[assignment]
    if exponent >= 0:
        p = tuple(None if part is None else [v << exponent for v in part] for part in p)  # type: ignore[assignment]
    else:
        q = tuple(None if part is None else [v << -exponent for v in part] for part in q)  # type: ignore[assignment]
    q0r, q0i = q[0][0], q[1][0] if q[1] is not None else 0
    if q0i != 0:
        p, q = _times(p, q0r, -q0i), _times(q, q0r, -q0i)
    elif q0r < 0:
        p, q = _times(p, -1, 0), _times(q, -1, 0)
    content = math.gcd(*(v for part in (*p, *q) if part is not None for v in part))
    if content > 1:
        p = tuple(None if part is None else [v // content for v in part] for part in p)  # type: ignore[assignment]
        q = tuple(None if part is None else [v // content for v in part] for part in q)  # type: ignore[assignment]
    return Shifted(p, q)


def _times(parts: Parts, a: int, b: int) -> Parts:
    re, im = parts
    if im is None:
        return [a * v for v in re], None if b == 0 else [b * v for v in re]
    return [a * x - b * y for x, y in zip(re, im, strict=True)], [a * y + b * x for x, y in zip(re, im, strict=True)]


def _substitute(coefficients: tuple[int, ...], s: int, cr: int, ci: int, scale: int) -> Parts:
    """2^(s d) P((cr + i ci + scale u) / 2^s) by one or two real Taylor shifts."""
    from flint import fmpz_poly

    d = len(coefficients) - 1
    lifted = fmpz_poly([v << (s * (d - j)) for j, v in enumerate(coefficients)])
    real = _padded(lifted(fmpz_poly([cr, 1])) if d > 0 else lifted, d)
    powers = [scale**j for j in range(d + 1)]
    if ci == 0:
        return [v * f for v, f in zip(real, powers, strict=True)], None
    # P(cr + v), v = i t: real part has the even, imaginary part the odd powers; then t = ci + tau, scale u = i tau
    even = [(v if j % 4 == 0 else -v) if j % 2 == 0 else 0 for j, v in enumerate(real)]
    odd = [(v if j % 4 == 1 else -v) if j % 2 == 1 else 0 for j, v in enumerate(real)]
    line = fmpz_poly([ci, 1])
    a, b = _padded(fmpz_poly(even)(line), d), _padded(fmpz_poly(odd)(line), d)
    re, im = [], []
    for j in range(d + 1):  # times (-i)^j
        x, y = ((a[j], b[j]), (b[j], -a[j]), (-a[j], -b[j]), (-b[j], a[j]))[j % 4]
        re.append(x * powers[j])
        im.append(y * powers[j])
    return re, im


def _padded(poly: Any, degree: int) -> list[int]:
    values = [int(v) for v in poly.coeffs()]
    return values + [0] * (degree + 1 - len(values))


def log2_norm(parts: Parts) -> float:
    """An upper bound of log2 of the sum of |coefficients|."""
    total = sum(abs(v) for part in parts if part is not None for v in part)
    return _log2(total) + 1e-9 if total else -math.inf


def log2_lead(parts: Parts) -> float:
    """log2 |leading coefficient|."""
    re, im = parts
    return 0.5 * _log2(re[-1] ** 2 + (im[-1] ** 2 if im is not None else 0))
