"""The kernel's own homomorphisms to prime fields, and roots modulo primes.

A statement modulo one prime proves the one over the field only in one direction (a rank can only drop, a square stays a
square), and for this any prime will do.  So nothing here depends on the choices of the search.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import count
from random import Random
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.poly import Field, Poly
from kovacic.verify.reduction import AtRoot, AtValues, BadPrimeError, Homomorphism, OfRationals

#: The kernel's own primes are taken downwards from here; a record may name any prime below twice this.
_KERNEL_PRIMES_BELOW = 1 << 62
#: Values of the parameters that are tried for one prime.
_PARAMETER_POINTS = 64


@lru_cache(maxsize=1024)
def prime(index: int) -> int:
    """The kernel's prime number `index`, counted downwards from 2^62."""
    candidate = _KERNEL_PRIMES_BELOW - 1 if index == 0 else prime(index - 1) - 2
    while not fmpz(candidate).is_prime():
        candidate -= 2
    return candidate


def is_usable_prime(p: int) -> bool:
    """True for an odd prime number that fits arithmetic in machine words as a modulus."""
    return 2 < p < 2 * _KERNEL_PRIMES_BELOW and bool(fmpz(p).is_prime())


def homomorphisms_modulo(field: Field, p: int, *, points: int = _PARAMETER_POINTS) -> Iterator[Homomorphism]:
    """Homomorphisms of the field's p-integral elements to F_p: of Q the one; of Q(t) values of the parameters at some points.

    Of K(c) those that extend one of K: c goes to a simple root of its minimal polynomial, which keeps its degree.  Such a
    homomorphism belongs to an unramified prime ideal of degree 1 [Dedekind].
    """
    if isinstance(field, AlgebraicField):
        for base in homomorphisms_modulo(field.base, p, points=points):
            for root in roots_modulo(field.modulus, base):
                yield AtRoot(base, root, field.height)
    elif isinstance(field, FunctionField):
        values = Random(p)
        for _ in range(points):
            yield AtValues(p, tuple(values.randrange(p) for _ in field.names))
    else:
        yield OfRationals(p)


def homomorphisms(field: Field) -> Iterator[Homomorphism]:
    """Homomorphisms of the field modulo the kernel's own primes, without end.

    Each prime has one point only: whether a number is a square modulo p is the same at all points.
    """
    for index in count():
        yield from homomorphisms_modulo(field, prime(index), points=1)


def roots_modulo(polynomial: Poly, h: Homomorphism) -> list[int]:
    """The simple roots of the image of a polynomial, in increasing order; none where the image loses its degree."""
    try:
        image = h.keeping_degree(polynomial)
    except BadPrimeError:
        return []
    return sorted(int(root) for root, multiplicity in image.roots() if multiplicity == 1)


def translated(polynomial: Any, point: int) -> Any:
    """polynomial(t + point)."""
    if point == 0:
        return polynomial
    return polynomial.compose(nmod_poly([point, 1], polynomial.modulus()))
