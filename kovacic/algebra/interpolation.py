"""Rational functions of several parameters: their values modulo primes, and the way back from these.

A coefficient N/D of least total degree d is found by linear algebra: N(t) - v(t) D(t) = 0 at random points t has, for
the least d with a solution, one solution up to a factor.  Rational coefficients come from the first prime by rational
reconstruction, or with those modulo further primes, where only the terms that occur are unknown.
Exactness comes from the verification of proposals; a wrong one is never an answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from math import prod
from typing import Any

from flint import nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Collector, Homomorphism
from kovacic.algebra.lifting import chinese_remainders, reconstruct_vector
from kovacic.algebra.modular import EXTRA_EQUATIONS, null_space
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import RationalHomomorphism, RationalPoly
from kovacic.errors import LimitExceeded

#: Unknowns of the largest linear system: for more, the answer has too many terms in the parameters.
_LARGEST_SYSTEM = 2400


Exponents = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Evaluation(Homomorphism):
    """The parameters take the values `point` modulo p."""

    p: int
    point: Exponents

    def __call__(self, polynomial: Poly) -> Any:
        if isinstance(polynomial, RationalPoly):
            return RationalHomomorphism(self.p)(polynomial)
        num = polynomial.num  # type: ignore[attr-defined]
        den = polynomial.den  # type: ignore[attr-defined]
        scale = sum(self._columns(den)) % self.p
        if scale == 0:
            raise BadPrimeError("a parameter takes a forbidden value")
        image = nmod_poly(self._columns(num), self.p)
        return image if scale == 1 else image * pow(scale, -1, self.p)

    def _columns(self, polynomial: Any) -> list[int]:
        """The coefficients of the powers of x, which is variable number 0."""
        columns = [0] * (int(polynomial.degrees()[0]) + 1)
        for exponents, coefficient in polynomial.to_dict().items():
            columns[int(exponents[0])] += int(coefficient) * power_product(self.point, exponents[1:], self.p)
        return [c % self.p for c in columns]


def power_product(point: Exponents, exponents: Exponents, p: int) -> int:
    return prod(pow(base, exponent, p) for base, exponent in zip(point, exponents, strict=True) if exponent) % p


class Samples(Collector):
    """The samples of one shape, and the state of the interpolation for each coefficient.

    A polynomial is proposed as the list of its coefficients, pairs (N, D) of integer coefficients by exponents.
    """

    def __init__(self, parameters: int, shape: tuple[int, ...]) -> None:
        super().__init__(shape)
        self._points: dict[int, list[Exponents]] = {}
        self._values: dict[int, list[list[int]]] = {}
        self._unknowns = [_Unknown(parameters) for _ in range(sum(shape))]

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        evaluation = homomorphism.ground
        assert isinstance(evaluation, Evaluation)
        p = evaluation.p
        points = self._points.setdefault(p, [])
        values = self._values.setdefault(p, [])
        self.primes_used = len(self._points)
        points.append(evaluation.point)
        values.append([int(c) for image in images for c in image.coeffs()])
        if p == next(iter(self._points)):
            for index, unknown in enumerate(self._unknowns):
                while not unknown.terms and unknown.needed <= len(points):
                    unknown.solve(p, points[: unknown.needed], [row[index] for row in values])
                if not unknown.terms:
                    return None
        return self._proposal() if all(u.terms for u in self._unknowns) else None

    def _proposal(self) -> list[Any] | None:
        for p, points in self._points.items():
            for index, unknown in enumerate(self._unknowns):
                if p not in unknown.primes and len(points) >= unknown.size + EXTRA_EQUATIONS:
                    unknown.solve(p, points, [row[index] for row in self._values[p]])
        functions = []
        for unknown in self._unknowns:
            parts = unknown.reconstruct()
            if parts is None:
                return None
            functions.append(parts)
        return self._divided(functions)


class _Unknown:
    """One rational function: the terms of N and D, normalised so that the first term of D has the coefficient 1."""

    def __init__(self, parameters: int) -> None:
        self.parameters = parameters
        self.degree = 0
        self.terms: tuple[list[Exponents], list[Exponents]] | None = None
        self.primes: set[int] = set()
        self.modulus = 1
        self.residues: list[int] = []

    @property
    def needed(self) -> int:
        """Samples for the next degree."""
        return 2 * len(list(_exponents_up_to(self.parameters, self.degree))) + EXTRA_EQUATIONS

    @property
    def size(self) -> int:
        return sum(map(len, self.terms)) if self.terms else 0

    def solve(self, p: int, points: list[Exponents], values: list[int]) -> None:
        """Add the samples modulo a prime: with the known terms, or with all up to the next degree.

        Raises `LimitExceeded` for too many terms.
        """
        if self.terms is None:
            monomials = list(_exponents_up_to(self.parameters, self.degree))
            if 2 * len(monomials) > _LARGEST_SYSTEM:
                reason = f"the answer has coefficients of degree above {self.degree - 1} in the parameters"
                raise LimitExceeded(reason, limit="parameters")
            self.degree += 1
        above, below = self.terms or (monomials, monomials)
        solution = _solve(p, points, values, above, below)
        if solution is None:
            return
        numerator = solution[: len(above)]
        denominator = solution[len(above) :]
        if self.terms is None:
            self.terms = _occurring(above, numerator), _occurring(below, denominator)
            numerator = [c for c in numerator if c]
            denominator = [c for c in denominator if c]
        lead = pow(denominator[0], -1, p)
        residues = [c * lead % p for c in (*numerator, *denominator)]
        self.residues = chinese_remainders(self.residues or [0] * len(residues), self.modulus, residues, p)
        self.modulus *= p
        self.primes.add(p)

    def reconstruct(self) -> tuple[dict[Exponents, int], dict[Exponents, int]] | None:
        """Integer coefficients of N and D, or None as long as the modulus is too small."""
        assert self.terms is not None
        vector = reconstruct_vector(self.residues, self.modulus)
        if vector is None:
            return None
        numerators = vector[0]
        split = len(self.terms[0])
        return (
            dict(zip(self.terms[0], numerators[:split], strict=True)),
            dict(zip(self.terms[1], numerators[split:], strict=True)),
        )


def _occurring(monomials: list[Exponents], coefficients: list[int]) -> list[Exponents]:
    """The monomials with a coefficient other than zero."""
    return [monomial for monomial, c in zip(monomials, coefficients, strict=True) if c]


def _exponents_up_to(parameters: int, degree: int) -> Iterator[Exponents]:
    """All exponents of total degree at most `degree`."""
    for choice in combinations_with_replacement(range(parameters + 1), degree):
        yield tuple(choice.count(i) for i in range(parameters))


def _solve(
    p: int, points: list[Exponents], values: list[int], above: list[Exponents], below: list[Exponents]
) -> list[int] | None:
    """The only solution up to a factor of N(t) = v D(t) at all points, or None."""
    every = {*above, *below}
    rows: list[list[int]] = []
    for point, value in zip(points, values, strict=False):
        at = {m: power_product(point, m, p) for m in every}
        rows.append([*(at[m] for m in above), *(-value * at[m] % p for m in below)])
    columns = len(above) + len(below)
    basis = null_space(rows, columns, p)
    return basis[0] if len(basis) == 1 else None
