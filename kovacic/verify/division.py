"""Quotients of constants and inverses modulo polynomials: found by the field, and multiplied again."""

from __future__ import annotations

from kovacic.algebra.poly import Poly
from kovacic.errors import VerificationFailed


def quotient(a: Poly, b: Poly) -> Poly:
    """a/b for constants, b not 0."""
    found = a / b
    if found * b != a:
        raise VerificationFailed(f"({a})/({b}) was found as {found}")
    return found


def inverse(value: Poly, modulus: Poly) -> Poly:
    """1/value modulo a polynomial, to which it is prime."""
    found = value.inverse_modulo(modulus)
    if (found * value - 1) % modulus:
        raise VerificationFailed(f"the inverse of {value} modulo {modulus} was found as {found}")
    return found
