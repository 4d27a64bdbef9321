"""The residues of sqrt(S) at unramified irregular points, by which the exponents there differ.

For S = N/(p^(2 nu) q), p irreducible over K, the solutions at a root theta of p have the exponents nu/2 +- r with r the residue
of sqrt(S) dx (Kovacic's b/(2a)), and

    sqrt(S) = sqrt((N q)(theta)) R/(q p^nu),    R^2 = N q/(N q)(theta),  R = 1 + O(x - theta).                   (1)

Everything is computed in K[x]/p^nu, where x + O(p) = theta + O(p) for the root theta of p that Newton's iteration finds
there, so that no root leaves K; the residue of R/(q p^nu), an element of K[x]/p, remains after Hermite's reduction.
"""

from __future__ import annotations

from collections.abc import Iterator

from kovacic.algebra.poly import Poly
from kovacic.verify.factors import inverse


def residue_over_leading_root(N: Poly, q: Poly, p: Poly, nu: int) -> Poly:
    """The residue of R/(q p^nu) at the class of x in K[x]/p: times the square root of N q it is that of sqrt(S)."""
    modulus = p**nu
    radicand = (N % modulus) * (q % modulus) % modulus
    # 1/(N q)(theta) as an element of K[x]/p^nu: its value at theta is the root of the same polynomial over K.
    scale = inverse(radicand % p, p)
    if scale.degree > 0:
        scale = _value_modulo(scale, _lifted_root(p, nu), modulus)
    unit = radicand * scale % modulus  # R^2, which is 1 modulo p
    root = p.field.poly([1])  # R^-1, by Newton's iteration
    over_q = inverse(q, p)
    for step in _newton_moduli(p, nu):
        root = (root + root * (1 - unit * root * root % step) / 2) % step
        over_q = over_q * (2 - q * over_q % step) % step
    R = unit * root % modulus
    return residue(R * over_q % modulus, p, nu)


def _newton_moduli(p: Poly, nu: int) -> Iterator[Poly]:
    """The moduli p^2, p^4, ..., p^nu of Newton's iterations from a root modulo p to one modulo p^nu."""
    k = 1
    while k < nu:
        k = min(2 * k, nu)
        yield p**k


def _lifted_root(p: Poly, nu: int) -> Poly:
    """theta, the root of p in K[x]/p^nu that is x modulo p: theta - p(theta)/p'(theta), the inverse improved along with it."""
    slope = p.derivative()
    theta = p.field.poly([0, 1])
    over_slope = inverse(slope, p)
    for modulus in _newton_moduli(p, nu):
        over_slope = over_slope * (2 - _value_modulo(slope, theta, modulus) * over_slope) % modulus
        theta = (theta - _value_modulo(p, theta, modulus) * over_slope) % modulus
    return theta


def _value_modulo(polynomial: Poly, theta: Poly, modulus: Poly) -> Poly:
    """The value at theta in K[x]/modulus, by Horner's rule."""
    value = theta * 0
    for k in range(polynomial.degree, -1, -1):
        value = (value * theta + polynomial[k]) % modulus
    return value


def residue(H: Poly, p: Poly, nu: int) -> Poly:
    """The residue of H/p^nu at the class of x in K[x]/p, by Hermite's reduction of the highest powers of p.

    B p'/p^e = (-B/((e-1) p^(e-1)))' + B'/((e-1) p^(e-1)) for e > 1: the remainder of a digit of H is carried to the next.
    """
    if p.degree == 1:  # all digits are constants, and the last one is the residue
        digits = H(p.field.poly([-p[0], 1])) if p[0] else H
        return digits[nu - 1]
    slope = p.derivative()
    over_slope = inverse(slope, p)
    *higher, last = _digits(H, p, nu)
    carried = H * 0
    for e, digit in zip(range(nu, 1, -1), higher, strict=True):
        total = digit + carried
        B = total * over_slope % p
        carried = (total - B * slope) // p + B.derivative() / (e - 1)
    return (last + carried) * over_slope % p


def _digits(H: Poly, p: Poly, count: int) -> list[Poly]:
    """H = sum_j digits[j] p^j with `count` digits of degree below that of p."""
    if count == 1:
        return [H]
    half = count // 2
    high, low = divmod(H, p**half)
    return _digits(low, p, half) + _digits(high, p, count - half)
