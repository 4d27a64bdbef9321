"""Decides whether y1/y2 is algebraic on its curve, by a function in pieces, however it was found.

For an imprimitive equation, H = (y1'/y1 - y2'/y2)^2 is rational, and u = y1/y2 = exp(int sqrt(H) dx).  Let y^2 = h be the
curve of sqrt(H), f = prod (a_i + b_i y)^(e_i), N_i = a_i^2 - h b_i^2 and R_i dx/y the odd part of d log(a_i + b_i y),

    R_i = ((b_i' h + b_i h'/2) a_i - a_i' b_i h)/N_i,        (sum e_i R_i + w)^2 = n^2 H h                         (1)

for a polynomial w says that n log u is, up to its sign, half of log of f over its conjugate, plus the integral of w dx/y.

- w = 0, and the product of the N_i with odd e_i is a constant times the square of a polynomial G: then f, divided by G and
  the powers of the N_i, has a constant norm, and u^n is this function, up to a constant.  If it isn't an l-th power of a
  function for any prime l that divides n, there is no smaller n: the group is dicyclic of order 4n.  The values of an l-th
  power at points over F_p, p = 1 mod l, would all lie in one class of F_p* modulo l-th powers.
- w dx/y is holomorphic and not 0: if some power u^m were a function F, then n log F - m log f would have a holomorphic
  differential that isn't 0; but that of the logarithm of a function has poles.  The group is N(T).

Reference: J. H. Davenport, On the Integration of Algebraic Functions (1981).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, islice
from typing import Any

from flint import fmpz

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import CurveFunction
from kovacic.errors import LimitExceeded
from kovacic.limits import MOST_TRIALS
from kovacic.verify.factors import factors_of
from kovacic.verify.primes import SAMPLES, BadPrimeError, Homomorphism, homomorphisms_modulo

#: Primes k l + 1 are taken upwards from here for a prime factor l of n; an l below it leaves them within a machine word.
_PRIMES_FROM = 1 << 50


def is_least_power(H: RatFunc, f: CurveFunction, n: int) -> bool:
    """True if u^n is a function on the curve, and no smaller power of u is."""
    if n < 1 or f.multiple != n:
        return False
    if f.rest or not _is_its_logarithm(H, f):
        return False
    G = _root_of_odd_norms(f)
    if G is None:
        return False
    primes = [int(q) for q, _ in fmpz(n).factor()]
    if any(q > _PRIMES_FROM for q in primes):
        raise LimitExceeded("the order has a prime factor of more than 15 digits", limit="bits")
    return all(_is_no_power(f, G, q) for q in primes)


def has_holomorphic_rest(H: RatFunc, f: CurveFunction) -> bool:
    """True if a multiple of log u is the logarithm of a function plus a non-constant integral of the first kind."""
    if f.multiple < 1 or not f.rest or f.h.field != H.field:
        return False
    squarefree = f.h.degree >= 3 and f.h.gcd(f.h.derivative()).degree == 0
    genus = (f.h.degree - 1) // 2
    return squarefree and f.rest.degree < genus and _is_its_logarithm(H, f)


def _is_its_logarithm(H: RatFunc, f: CurveFunction) -> bool:
    """True if equation (1) holds, n being `f.multiple`."""
    h = f.h
    polynomials = [h, f.rest, *(q for piece in f.pieces for q in (piece.a, piece.b))]
    if any(q.field != H.field for q in polynomials):
        return False
    total = RatFunc(f.rest)
    for piece in f.pieces:
        a = piece.a
        b = piece.b
        norm = a * a - h * b * b
        if not norm:
            return False
        odd = (b.derivative() * h + b * h.derivative() / 2) * a - a.derivative() * b * h
        total = total + RatFunc(odd, norm) * piece.exponent
    return bool(h) and total * total == H * h * f.multiple**2


def _root_of_odd_norms(f: CurveFunction) -> Poly | None:
    """G with G^2 the product of the norms of the pieces with odd exponents, up to a constant; None if there is none."""
    field = f.h.field
    product = field.one
    for piece in f.pieces:
        if piece.exponent % 2:
            product = product * (piece.a * piece.a - f.h * piece.b * piece.b)
    root = field.one
    for factor, multiplicity in factors_of(product):
        if multiplicity % 2:
            return None
        root = root * factor ** (multiplicity // 2)
    return root


def _is_no_power(f: CurveFunction, G: Poly, l: int) -> bool:  # noqa: E741 - as in the module's text
    """True if two values of f modulo a prime lie in different classes modulo l-th powers."""
    # Primes p = k l + 1: F_p contains the l-th roots of unity.
    primes = (p for p in count(_PRIMES_FROM // l * l + l + 1, l) if fmpz(p).is_prime())
    for h in islice((h for p in primes for h in homomorphisms_modulo(f.h.field, p)), MOST_TRIALS):
        try:
            classes = {pow(value, (h.p - 1) // l, h.p) for value in _curve_values(f, G, h)}
        except BadPrimeError:
            continue
        if len(classes) > 1:
            return True
    return False


def _curve_values(f: CurveFunction, G: Poly, h: Homomorphism) -> Iterator[int]:
    """Values of the function at points over F_p, neither zeros nor poles of a piece, of a curve that stays squarefree."""
    p = h.p
    curve = h.keeping_degree(f.h)
    root = h.keeping_degree(G)
    if curve.gcd(curve.derivative()).degree() > 0:
        raise BadPrimeError("branch points meet")
    pieces = [(h(piece.a), h(piece.b), piece.exponent) for piece in f.pieces]
    for x in range(SAMPLES):
        square = fmpz(int(curve(x)))
        if square.jacobi(p) != 1:
            continue
        value = _value_at(pieces, x, int(square.sqrtmod(p)), p)
        divisor = int(root(x))
        if value and divisor:
            yield value * pow(divisor, -1, p) % p


def _value_at(pieces: list[tuple[Any, Any, int]], x: int, y: int, p: int) -> int:
    """prod a_i^(e_i)/N_i^(e_i // 2), a_i = a + b y, at (x, y) modulo p; 0 where a piece or its conjugate vanishes."""
    result = 1
    for a, b, exponent in pieces:
        above = (int(a(x)) + int(b(x)) * y) % p
        norm = above * (int(a(x)) - int(b(x)) * y) % p
        if not norm:
            return 0
        result = result * pow(above, exponent, p) * pow(norm, -(exponent // 2), p) % p
    return result
