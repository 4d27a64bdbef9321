"""Several polynomials at once: products, squarefree factors, expansions at the factors of a denominator, combinations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import islice
from operator import mul
from typing import Any, NamedTuple

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.lifting import Lifter
from kovacic.algebra.poly import Field, Poly
from kovacic.limits import check_time

#: For this many factors of a denominator or more, leading terms are tried that are short enough for a few primes.
_MANY_FACTORS = 50
_PRIMES_FOR_LEADING_TERMS = 6
#: Trees of products don't pay for fewer factors.
_LEAST_FOR_A_TREE = 12


def product(factors: Sequence[Poly]) -> Poly:
    """The product of at least one polynomial."""
    return products(factors)[-1][0] if len(factors) >= _LEAST_FOR_A_TREE else reduce(mul, factors)


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
    moduli = [p ** max(1, k // 2) for p, k in factors]
    if len(factors) < _LEAST_FOR_A_TREE:
        return [(num % modulus, den // p**k % modulus) for (p, k), modulus in zip(factors, moduli, strict=True)]
    one = num.field.poly([1])
    tree = products([p**k for p, k in factors])
    if len(factors) >= _MANY_FACTORS:
        simple = _leading_terms(num, factors, moduli, tree)
        if simple is not None:
            return [(N, one) for N in simple]
    cofactors = _over_common_denominator([one] * len(factors), tree)
    of_moduli = products(moduli)
    return list(zip(_remainders_in_tree(num, of_moduli), _remainders_in_tree(cofactors, of_moduli), strict=True))


def _leading_terms(
    num: Poly, factors: Sequence[tuple[Poly, int]], moduli: Sequence[Poly], tree: list[list[Poly]]
) -> list[Poly] | None:
    """The leading terms N, with q = 1, of the partial fractions, if they have small coefficients; else None.

    They are found modulo a few primes: the remainders of num itself would be very long numbers.  They are right because num
    and the sum of N den/p^k have the same remainder modulo all p^nu.
    """
    terms = [_LiftedTerm(num.field) for _ in factors]
    for bundle in islice(num.field.bundles(), _PRIMES_FOR_LEADING_TERMS):
        check_time()
        try:
            by_prime = [_leading_terms_modulo(h, num, factors, moduli) for h in bundle]
            images = [[each[i] for each in by_prime] for i in range(len(terms))]
            open_terms = [i for i, term in enumerate(terms) if not term.has(bundle, images[i])]
        except BadPrimeError:
            continue
        for i in open_terms:
            terms[i].add(bundle, images[i])
        if open_terms:
            continue
        leading = [term.proposed for term in terms if term.proposed is not None]
        if not (num - _over_common_denominator(leading, tree)) % product(moduli):
            return leading
    return None


class _LiftedTerm:
    """A polynomial that is lifted from its images modulo primes; `proposed` is the last proposal, None before there is any."""

    def __init__(self, field: Field) -> None:
        self.proposed: Poly | None = None
        self._lifter = Lifter(field)

    def has(self, bundle: Sequence[Homomorphism], images: Sequence[Any]) -> bool:
        """True if the last proposal has these images, too."""
        proposed = self.proposed
        if proposed is None:
            return False
        return all(h(proposed) == image for h, image in zip(bundle, images, strict=True))

    def add(self, bundle: Sequence[Homomorphism], images: Sequence[Any]) -> None:
        """Propose another one, from these images and the former ones."""
        proposal = self._lifter.add(bundle, [[image] for image in images])
        self.proposed = proposal[0] if proposal else None


def _leading_terms_modulo(
    h: Homomorphism, num: Poly, factors: Sequence[tuple[Poly, int]], moduli: Sequence[Poly]
) -> list[Any]:
    """num/(den/p^k) modulo p^nu for all factors p^k, whose product den is, modulo the prime of h."""
    image = h(num)
    powers = [h(p) ** k for p, k in factors]
    tree = products(powers)
    terms = list[Any]()
    cofactors = _over_common_denominator([powers[0] ** 0] * len(powers), tree)
    remainders = _remainders_in_tree(image, tree)
    for N, q, modulus in zip(remainders, _remainders_in_tree(cofactors, tree), map(h, moduli), strict=True):
        common, inverse, _ = (q % modulus).xgcd(modulus)
        if common.degree() > 0:
            raise BadPrimeError("factors meet modulo this prime")
        terms.append(N * inverse % modulus)
    return terms


def _over_common_denominator(values: Sequence[Any], tree: list[list[Any]]) -> Any:
    """The sum of value * (product of all factors)/factor."""
    for level in tree[:-1]:
        check_time()
        pairs = [values[i] * level[i + 1] + values[i + 1] * level[i] for i in range(0, len(level) - 1, 2)]
        values = [*pairs, *values[2 * len(pairs) :]]
    return values[0]


def _remainders_in_tree(polynomial: Any, tree: list[list[Any]]) -> list[Any]:
    """The polynomial modulo each of the factors."""
    rests = [polynomial]
    for level in reversed(tree):
        check_time()
        rests = [rests[i // 2] % factor for i, factor in enumerate(level)]
    return rests


def combination(target: Poly, polynomials: Sequence[Poly]) -> list[Poly] | None:
    """Constants c with target = sum of c_k polynomials_k, 0 for those that aren't needed; None if there are no such constants.

    >>> from kovacic.algebra.rationals import QQ
    >>> p, q = QQ.poly([1, 0, 1]), QQ.poly([0, 2, 1])
    >>> [str(c) for c in combination(QQ.poly([1, -4, -1]), [p, q, p + q])]
    ['1', '-2', '0']
    """
    *_, last = _reduced_by_former([*polynomials, target])
    return None if last.value else [-c for c in last.coefficients[:-1]]


def dependence(polynomials: Sequence[Poly]) -> list[Poly] | None:
    """Constants, not all zero, for which the sum of c_k polynomials_k vanishes; None for independent polynomials.

    >>> from kovacic.algebra.rationals import QQ
    >>> p, q = QQ.poly([1, 0, 1]), QQ.poly([0, 2, 1])
    >>> [str(c) for c in dependence([p, q, p - 2 * q])], dependence([p, q])
    (['-1', '2', '1'], None)
    """
    return next((found.coefficients for found in _reduced_by_former(polynomials) if not found.value), None)


def _reduced_by_former(polynomials: Sequence[Poly]) -> Iterator[_Combination]:
    """Each of the polynomials less a combination of those before it that has the degree of none of these, reduced as well."""
    zero = polynomials[0].field.poly([])
    echelon: dict[int, _Combination] = {}
    for k, polynomial in enumerate(polynomials):
        unit = [zero] * len(polynomials)
        unit[k] = zero + 1
        found = _Combination(polynomial, unit).reduced(echelon)
        yield found
        if found.value:
            echelon[found.value.degree] = found


class _Combination(NamedTuple):
    """A polynomial `value` that is a given one and a combination of others, with these coefficients."""

    value: Poly
    coefficients: list[Poly]

    def reduced(self, echelon: Mapping[int, _Combination]) -> _Combination:
        """The remainder by the members of an echelon, by their degrees, until none of them has its degree."""
        value = self.value
        coefficients = self.coefficients
        while value and value.degree in echelon:
            check_time()
            other = echelon[value.degree]
            ratio = value.lc / other.value.lc
            value = value - ratio * other.value
            pairs = zip(coefficients, other.coefficients, strict=True)
            coefficients = [c - ratio * d if d else c for c, d in pairs]  # most d are zero
        return _Combination(value, coefficients)
