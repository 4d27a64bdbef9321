"""The residues of sqrt(S) at unramified irregular points: what tells the exponents there apart.

For S = N/(p^(2 nu) q), p irreducible over K, the solutions at a root theta of p have the exponents nu/2 +- r with r the residue
of sqrt(S) dx (Kovacic's b/(2a)), and

    sqrt(S) = sqrt((N q)(theta)) R/(q p^nu),    R^2 = N q/(N q)(theta),  R = 1 + O(x - theta).                   (1)

Everything is computed in K[x]/p^nu, where x + O(p) = theta + O(p) for the root theta of p that Newton's iteration finds
there, so that no root leaves K; the residue of R/(q p^nu), an element of K[x]/p, remains after Hermite's reduction.
"""

from __future__ import annotations

from functools import reduce

from kovacic.algebra.poly import Poly


def exponent_difference_squared(N: Poly, q: Poly, p: Poly, nu: int) -> Poly:
    """(2 r)^2 as an element of K[x]/p, for the residue r of sqrt(S) at the class of x: 36 for sqrt(S) = 1/x^2 + 3/x + ..."""
    modulus = p**nu
    q = q % modulus
    radicand = N % modulus * q % modulus
    leading = radicand % p
    unit = radicand * _constant(leading.inverse_modulo(p), p, nu) % modulus
    root, inverse, k = p.field.poly([1]), q.inverse_modulo(p), 1  # unit^(-1/2) and 1/q modulo p^k
    while k < nu:
        k = min(2 * k, nu)
        ahead = p**k
        root = (root + root * (1 - unit * root * root % ahead) / 2) % ahead
        inverse = inverse * (2 - q * inverse % ahead) % ahead
    r = residue(unit * root % modulus * inverse % modulus, p, nu)
    return 4 * leading * r * r % p


def _constant(value: Poly, p: Poly, nu: int) -> Poly:
    """The element of K[x]/p^nu that is a root of the same polynomial over K as an element of K[x]/p."""
    if value.degree <= 0:
        return value
    slope = p.derivative()
    theta, inverse, k = p.field.poly([0, 1]), slope.inverse_modulo(p), 1  # a root of p, and 1/p'(theta), modulo p^k
    while k < nu:
        k = min(2 * k, nu)
        ahead = p**k
        inverse = inverse * (2 - _at(slope, theta, ahead) * inverse) % ahead
        theta = (theta - _at(p, theta, ahead) * inverse) % ahead
    return _at(value, theta, p**nu)


def _at(polynomial: Poly, theta: Poly, modulus: Poly) -> Poly:
    return reduce(lambda value, c: (value * theta + c) % modulus, reversed([*polynomial]), theta * 0)


def residue(H: Poly, p: Poly, nu: int) -> Poly:
    """The residue of H/p^nu at the class of x in K[x]/p: B p'/p^e = (-B/((e-1) p^(e-1)))' + B'/((e-1) p^(e-1)) for e > 1."""
    if p.degree == 1:  # all digits are constants, and the last one is the residue
        return (H(p.field.poly([-p[0], 1])) if p[0] else H)[nu - 1]
    slope = p.derivative()
    inverse, carried = slope.inverse_modulo(p), H * 0
    *digits, last = _digits(H, p, nu)
    for e, digit in zip(range(nu, 1, -1), digits, strict=True):
        B = (digit + carried) * inverse % p
        carried = (digit + carried - B * slope) // p + B.derivative() / (e - 1)
    return (last + carried) * inverse % p


def _digits(H: Poly, p: Poly, count: int) -> list[Poly]:
    """H = sum_j digits[j] p^j with `count` digits of degree below that of p."""
    if count == 1:
        return [H]
    half = count // 2
    high, low = divmod(H, p**half)
    return _digits(low, p, half) + _digits(high, p, count - half)
