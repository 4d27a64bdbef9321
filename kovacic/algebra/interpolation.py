"""Rational functions of several parameters from their values modulo primes.

A coefficient N/D of least total degree d is found by linear algebra: N(t) - v(t) D(t) = 0 at random points t has, for
the least d with a solution, one solution up to a factor.  Rational coefficients come from the first prime by rational
reconstruction, or with those modulo further primes, where only the terms that occur are unknown.
Exactness comes from the verification of what is proposed; a wrong proposal is never an answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement
from typing import Any

from flint import nmod_mat

from kovacic.algebra.fields import CoordinateLifter, Homomorphism
from kovacic.algebra.function_field import Evaluation, FunctionField
from kovacic.algebra.lifting import reconstruct_vector
from kovacic.errors import LimitExceeded

#: Samples beyond the number of unknowns.
_MARGIN = 4
#: The largest linear system: beyond it the answer has too many terms in the parameters.
_LARGEST = 2400

_Exponents = tuple[int, ...]


class Interpolator(CoordinateLifter):
    """Collects values of a vector of polynomials at points, and proposes the vector over Q(t)."""

    def __init__(self, field: FunctionField) -> None:
        self._field = field
        self._states: dict[tuple[int, ...], _Samples] = {}

    @property
    def primes_used(self) -> int:
        return sum(len(state.points) for state in self._states.values())

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        assert isinstance(homomorphism, Evaluation)
        shape = tuple(image.length() for image in images)
        state = self._states.setdefault(shape, _Samples(self._field, shape))
        return state.add(homomorphism, images)


class _Samples:
    """The samples of one shape, and for each coefficient what is known about it."""

    def __init__(self, field: FunctionField, shape: tuple[int, ...]) -> None:
        self.field, self.shape = field, shape
        self.points: dict[int, list[_Exponents]] = {}
        self.values: dict[int, list[list[int]]] = {}
        self.unknowns = [_Unknown(len(field.names)) for _ in range(sum(shape))]

    def add(self, homomorphism: Evaluation, images: Sequence[Any]) -> list[Any] | None:
        p = homomorphism.p
        self.points.setdefault(p, []).append(homomorphism.point)
        self.values.setdefault(p, []).append([int(c) for image in images for c in image.coeffs()])
        first = next(iter(self.points))
        if p == first and not all(u.terms for u in self.unknowns):
            for index, unknown in enumerate(self.unknowns):
                while not unknown.terms and unknown.needed <= len(self.points[p]):
                    unknown.search(p, self.points[p], [row[index] for row in self.values[p]])
                if not unknown.terms:
                    return None
        if not all(u.terms for u in self.unknowns):
            return None
        return self._proposal()

    def _proposal(self) -> list[Any] | None:
        for p, points in list(self.points.items()):
            for index, unknown in enumerate(self.unknowns):
                if p not in unknown.primes and len(points) >= unknown.size + _MARGIN:
                    unknown.refine(p, points, [row[index] for row in self.values[p]])
        functions = []
        for unknown in self.unknowns:
            parts = unknown.reconstruct()
            if parts is None:
                return None
            functions.append(self._function(*parts))
        result, start = [], 0
        for length in self.shape:
            result.append(self.field.poly(functions[start : start + length]))
            start += length
        return result

    def _function(self, above: dict[_Exponents, int], below: dict[_Exponents, int]) -> Any:
        num, den = (self.field.context.from_dict({(0, *e): c for e, c in terms.items()}) for terms in (above, below))
        return self.field.make(num, den)


class _Unknown:
    """One rational function: the terms of N and D, normalised so that the first term of D has the coefficient 1."""

    def __init__(self, parameters: int) -> None:
        self.parameters = parameters
        self.degree = 0
        self.terms: tuple[list[_Exponents], list[_Exponents]] | None = None
        self.primes: set[int] = set()
        self.modulus = 1
        self.residues: list[int] = []

    @property
    def needed(self) -> int:
        """Samples for the next degree."""
        return 2 * len(list(_monomials(self.parameters, self.degree))) + _MARGIN

    @property
    def size(self) -> int:
        return sum(map(len, self.terms)) if self.terms else 0

    def search(self, p: int, points: list[_Exponents], values: list[int]) -> None:
        monomials = list(_monomials(self.parameters, self.degree))
        if 2 * len(monomials) > _LARGEST:
            raise LimitExceeded(
                f"the answer has coefficients of degree above {self.degree - 1} in the parameters", limit="parameters"
            )
        solution = _solve(p, points[: self.needed], values, monomials, monomials)
        self.degree += 1
        if solution is None:
            return
        above, below = solution[: len(monomials)], solution[len(monomials) :]
        self.terms = (
            [m for m, c in zip(monomials, above, strict=True) if c],
            [m for m, c in zip(monomials, below, strict=True) if c],
        )
        self._append(p, [c for c in (*above, *below) if c])

    def refine(self, p: int, points: list[_Exponents], values: list[int]) -> None:
        assert self.terms is not None
        solution = _solve(p, points, values, *self.terms)
        if solution is not None:
            self._append(p, solution)

    def _append(self, p: int, solution: list[int]) -> None:
        assert self.terms is not None
        lead = pow(solution[len(self.terms[0])], -1, p)
        residues = [c * lead % p for c in solution]
        if not self.residues:
            self.residues = [0] * len(residues)
        inverse = pow(self.modulus, -1, p)
        self.residues = [
            old + self.modulus * ((new - old) * inverse % p) for old, new in zip(self.residues, residues, strict=True)
        ]
        self.modulus *= p
        self.primes.add(p)

    def reconstruct(self) -> tuple[dict[_Exponents, int], dict[_Exponents, int]] | None:
        """Integer coefficients of N and D, or None as long as the modulus is too small."""
        assert self.terms is not None
        vector = reconstruct_vector(self.residues, self.modulus)
        if vector is None:
            return None
        numerators, _ = vector
        split = len(self.terms[0])
        return (
            dict(zip(self.terms[0], numerators[:split], strict=True)),
            dict(zip(self.terms[1], numerators[split:], strict=True)),
        )


def _monomials(parameters: int, degree: int) -> Iterator[_Exponents]:
    """All exponents of total degree at most `degree`."""
    for choice in combinations_with_replacement(range(parameters + 1), degree):
        yield tuple(choice.count(i) for i in range(parameters))


def _solve(
    p: int,
    points: list[_Exponents],
    values: list[int],
    above: list[_Exponents],
    below: list[_Exponents],
) -> list[int] | None:
    """The only solution up to a factor of N(t) = v D(t) at all points, or None."""
    every = {*above, *below}
    rows: list[list[int]] = []
    for point, value in zip(points, values, strict=False):
        at = {m: _power_product(point, m, p) for m in every}
        rows.append([*(at[m] for m in above), *(-value * at[m] % p for m in below)])
    columns = len(above) + len(below)
    basis, nullity = nmod_mat(len(rows), columns, [c for row in rows for c in row], p).nullspace()
    if nullity != 1:
        return None
    return [int(basis[i, 0]) for i in range(columns)]


def _power_product(point: _Exponents, exponents: _Exponents, p: int) -> int:
    result = 1
    for base, exponent in zip(point, exponents, strict=True):
        if exponent:
            result = result * pow(base, exponent, p) % p
    return result


__all__ = ["Interpolator"]
