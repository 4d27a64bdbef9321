"""The irreducible factors of a polynomial, quotients and inverses: found by the field and multiplied out; the irreducibility of
factors is proven.

Over Q and over Q(t) the factors are FLINT's, whose irreducibility is taken from there.  Let p be a polynomial over K(c), n the
degree of c over K, and N an irreducible polynomial over K of the degree n deg p, a multiple of p(x - s c) for some integer s.
A root of p(x - s c) has the degree n deg p over K, and so at least the degree deg p over K(c): p is irreducible, however N was
found.  The norm is such an N, if p is irreducible, where it has no multiple roots: for all but finitely many s
[Trager, SYMSAC 1976].
"""

from __future__ import annotations

from functools import lru_cache

from kovacic.algebra.extension import AlgebraicField, norm
from kovacic.algebra.poly import Field, Poly
from kovacic.errors import VerificationFailed
from kovacic.limits import check_time


def factors_of(polynomial: Poly) -> list[tuple[Poly, int]]:
    """The monic irreducible factors with their multiplicities; raises `VerificationFailed` if the field found other ones."""
    if polynomial.degree <= 0:
        return []
    factors = polynomial.field.factor(polynomial)
    right = product([p**multiplicity for p, multiplicity in factors]) == polynomial.monic()
    if not right or not all(is_irreducible(p) for p, _ in factors):
        raise VerificationFailed(f"the factors of {polynomial} were found as {', '.join(str(p) for p, _ in factors)}")
    return factors


def product(factors: list[Poly]) -> Poly:
    """The product of at least one polynomial, in halves: multiplication is fastest for factors of the same size."""
    if len(factors) == 1:
        return factors[0]
    half = len(factors) // 2
    return product(factors[:half]) * product(factors[half:])


@lru_cache(maxsize=64)
def is_a_field(field: Field) -> bool:
    """True if the polynomial of each constant is irreducible over the field below."""
    if not isinstance(field, AlgebraicField):
        return True
    if field.modulus.degree < 2 or not is_a_field(field.base):
        return False
    return factors_of(field.modulus) == [(field.modulus, 1)]


def is_irreducible(p: Poly) -> bool:
    """True if p is irreducible: over K(c) by its norm.  Over Q and Q(t), p must be a factor that FLINT has found."""
    field = p.field
    if p.degree <= 1 or not isinstance(field, AlgebraicField):
        return p.degree > 0
    x = field.x
    roots = p.degree * field.dimension
    for s in range(roots**2 + 1):  # roots^2 shifts at most let two roots of the norm meet: one of these is left
        check_time()
        shifted = p(x - field.generator * s)
        N = norm(shifted).monic()
        if N.gcd(N.derivative()).degree == 0:
            is_multiple = N.degree == roots and not field.embed(N) % shifted
            return is_multiple and factors_of(N) == [(N, 1)]
    return False


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
