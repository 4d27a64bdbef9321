"""Several polynomials at once: products, squarefree factors, expansions at the factors of a denominator, combinations."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import islice
from operator import mul
from typing import Any

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.lifting import Lifter
from kovacic.algebra.poly import Poly
from kovacic.limits import check_time

#: From so many factors of a denominator on, leading terms are tried that are short enough for so many primes.
_MANY_FACTORS = 50
_PRIMES = 6
#: To fewer factors trees are of no use.
_FEW_FACTORS = 12


def product(factors: Sequence[Poly]) -> Poly:
    """The product of at least one polynomial."""
    return products(factors)[-1][0] if len(factors) >= _FEW_FACTORS else reduce(mul, factors)


def products(factors: Sequence[Any]) -> list[list[Any]]:
    """The factors, the products of two each, of four each, ..., the product of all."""
    levels = [[*factors]]
    while len(levels[-1]) > 1:
        left = levels[-1][::2]
        right = levels[-1][1::2]
        levels.append([*map(mul, left, right), *left[len(right) :]])
    return levels


def squarefree_factors(polynomial: Poly) -> list[tuple[Poly, int]]:
    """(p, k): the squarefree product p of the factors of multiplicity k, for k in rising order [Yun 1976]."""
    found = []
    k = 0
    rest = polynomial.gcd(polynomial.derivative())
    radical = polynomial // rest
    while radical.degree > 0:
        k = k + 1
        following = radical.gcd(rest)
        if radical.degree > following.degree:
            found.append((radical // following, k))
        radical = following
        rest = rest // following
    return found


def expansions(num: Poly, den: Poly, factors: Sequence[tuple[Poly, int]]) -> list[tuple[Poly, Poly]]:
    """(N, q) for each factor p^k of den, the product of them all: num/den = N/(p^k q) + O(p^(nu - k)), nu = k/2 or 1.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = QQ.poly([0, 1])
    >>> [(str(N), str(q)) for N, q in expansions(x + 2, x * (x - 1) ** 2, [(x, 1), (x - 1, 2)])]
    [('2', '1'), ('3', '1')]
    """
    moduli = [p if k < 4 else p ** (k // 2) for p, k in factors]
    if len(factors) < _FEW_FACTORS:
        pairs = zip(factors, moduli, strict=True)
        return [(num % modulus, (den // p**k if k else den) % modulus) for (p, k), modulus in pairs]
    one = num.field.poly([1])
    tree = products([p**k for p, k in factors])
    simple = _leading_terms(num, factors, moduli, tree) if len(factors) >= _MANY_FACTORS else None
    if simple is not None:
        return [(N, one) for N in simple]
    cofactors = _combined([one] * len(factors), tree)
    of_moduli = products(moduli)
    return list(zip(_remainders(num, of_moduli), _remainders(cofactors, of_moduli), strict=True))


def _leading_terms(
    num: Poly, factors: Sequence[tuple[Poly, int]], moduli: Sequence[Poly], tree: list[list[Poly]]
) -> list[Poly] | None:
    """The leading terms N, with q = 1, of the partial fractions, if they have small coefficients; else None.

    They are found modulo a few primes: the remainders of num itself would be very long numbers.  They are right because num
    and the sum of N den/p^k have the same remainder modulo all p^nu.
    """
    lifters = [Lifter(num.field) for _ in factors]
    found = list[Poly | None]([None] * len(factors))
    for bundle in islice(num.field.bundles(), _PRIMES):
        check_time()
        try:
            images = [
                _leading_terms_modulo(h(num), [h(p) ** k for p, k in factors], [h(m) for m in moduli]) for h in bundle
            ]
            missing = [i for i, N in enumerate(found) if not _has_images(N, bundle, [image[i] for image in images])]
        except BadPrimeError:
            continue
        for i in missing:
            proposal = lifters[i].add(bundle, [[image[i]] for image in images])
            found[i] = proposal[0] if proposal else None
        if missing:
            continue
        leading = [N for N in found if N is not None]
        if not (num - _combined(leading, tree)) % product(moduli):
            return leading
    return None


def _has_images(proposed: Poly | None, bundle: Sequence[Homomorphism], images: Sequence[Any]) -> bool:
    """Is this what was proposed so far, also modulo the prime of these homomorphisms?"""
    if proposed is None:
        return False
    return all(h(proposed) == image for h, image in zip(bundle, images, strict=True))


def _leading_terms_modulo(num: Any, powers: Sequence[Any], moduli: Sequence[Any]) -> list[Any]:
    """num/(den/p^k) modulo p^nu for all powers p^k, whose product den is, modulo a prime."""
    tree = products(powers)
    terms = list[Any]()
    cofactors = _combined([powers[0] ** 0] * len(powers), tree)
    for N, q, modulus in zip(_remainders(num, tree), _remainders(cofactors, tree), moduli, strict=True):
        common, inverse, _ = (q % modulus).xgcd(modulus)
        if common.degree() > 0:
            raise BadPrimeError("factors meet modulo this prime")
        terms.append(N * inverse % modulus)
    return terms


def _combined(values: Sequence[Any], tree: list[list[Any]]) -> Any:
    """The sum of value * (product of all factors)/factor."""
    for level in tree[:-1]:
        check_time()
        pairs = [values[i] * level[i + 1] + values[i + 1] * level[i] for i in range(0, len(level) - 1, 2)]
        values = [*pairs, *values[2 * len(pairs) :]]
    return values[0]


def _remainders(polynomial: Any, tree: list[list[Any]]) -> list[Any]:
    """The polynomial modulo each of the factors."""
    rests = [polynomial]
    for level in reversed(tree):
        check_time()
        rests = [rests[i // 2] % factor for i, factor in enumerate(level)]
    return rests


def combination(target: Poly, polynomials: Sequence[Poly]) -> list[Poly] | None:
    """Constants c with target = sum of c_k polynomials_k, 0 for those that aren't needed; None where there are none.

    >>> from kovacic.algebra.rationals import QQ
    >>> p, q = QQ.poly([1, 0, 1]), QQ.poly([0, 2, 1])
    >>> [str(c) for c in combination(QQ.poly([1, -4, -1]), [p, q, p + q])]
    ['1', '-2', '0']
    """
    zero = target.field.poly([])
    echelon: dict[int, tuple[Poly, list[Poly]]] = {}  # by the degree: a combination, and its coefficients

    def reduced(p: Poly, coefficients: list[Poly]) -> tuple[Poly, list[Poly]]:
        while p and p.degree in echelon:
            check_time()
            other, its = echelon[p.degree]
            ratio = p.lc / other.lc
            p = p - ratio * other
            coefficients = [c - ratio * d if d else c for c, d in zip(coefficients, its, strict=True)]
        return p, coefficients

    for k, polynomial in enumerate(polynomials):
        own = [zero] * len(polynomials)
        own[k] = target.field.poly([1])
        rest, coefficients = reduced(polynomial, own)
        if rest:
            echelon[rest.degree] = rest, coefficients
    rest, coefficients = reduced(target, [zero] * len(polynomials))
    return None if rest else [-c for c in coefficients]
