"""Several polynomials at once: products, squarefree factors, expansions at the factors of a denominator, combinations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import mul
from typing import Any, NamedTuple

from kovacic.algebra.poly import Poly
from kovacic.limits import check_time

#: Trees of remainders don't pay for fewer factors.
_LEAST_FOR_A_TREE = 12


def product(factors: Sequence[Poly]) -> Poly:
    """The product of at least one polynomial."""
    whole: Poly = products(factors)[-1][0]
    return whole


def products(factors: Sequence[Any]) -> list[list[Any]]:
    """The factors, the products of two each, of four each, ..., the product of all."""
    levels = [[*factors]]
    while len(levels[-1]) > 1:
        left = levels[-1][::2]
        right = levels[-1][1::2]
        levels.append([*map(mul, left, right), *left[len(right) :]])
    return levels


def squarefree_factors(polynomial: Poly) -> list[tuple[Poly, int]]:
    """Pairs (p, k): p the product of the irreducible factors of multiplicity k, in increasing order of k [Yun 1976]."""
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
    >>> x = QQ.x
    >>> [(str(N), str(q)) for N, q in expansions(x + 2, x * (x - 1) ** 2, [(x, 1), (x - 1, 2)])]
    [('2', '1'), ('3', '1')]
    """
    moduli = [p ** max(1, k // 2) for p, k in factors]
    if len(factors) < _LEAST_FOR_A_TREE:
        return [(num % modulus, den // p**k % modulus) for (p, k), modulus in zip(factors, moduli, strict=True)]
    # The sum of den/p^k over all factors is the cofactor of each factor modulo its power.
    tree = products([p**k for p, k in factors])
    cofactors = _over_common_denominator([num.field.one] * len(factors), tree)
    of_moduli = products(moduli)
    return list(zip(_remainders_in_tree(num, of_moduli), _remainders_in_tree(cofactors, of_moduli), strict=True))


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
    """Each polynomial minus a combination of its predecessors, of a degree that none of their own remainders has."""
    zero = polynomials[0].field.zero
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
