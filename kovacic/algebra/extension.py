"""Simple algebraic extensions K(c) of a field, and polynomials over them.

A polynomial over K(c) is the tuple of its coordinates with respect to 1, c, c**2, ...  Extensions of extensions are towers
of these.  Factoring is by norms [Trager, SYMSAC 1976]: if the norm of f(x - s c) from K(c)[x] to K[x] is squarefree, its
irreducible factors over K correspond to those of f, each of which is the greatest common divisor of f(x - s c) with one.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from typing import Any

from flint import fmpq, nmod_poly

from kovacic.algebra import splitting
from kovacic.algebra.homomorphism import BadPrimeError, Collector, Homomorphism
from kovacic.algebra.lifting import Lifter, inverse_by_primes, lifted
from kovacic.algebra.modular import integers_by_size
from kovacic.algebra.poly import Field, Poly, Scalar
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.algebra.traces import characteristic_polynomial, coefficients_from_traces, power_sums
from kovacic.limits import check_time
from kovacic.numbers.exact import radical

#: Up to this degree of the modulus, Euclid's algorithm is as fast as lifting.
_EUCLID_IN_TOWERS = 2


@dataclass(frozen=True, slots=True)
class AlgebraicField(Field):
    """K(c), c a root of the monic irreducible `modulus` over K; `name` is what c is called in print.

    `approximation` says which complex root c is, by real and imaginary part; None if any root will do.  Exact arithmetic
    doesn't depend on it, nor does equality.
    """

    base: Field
    modulus: Poly
    name: str = "c"
    approximation: tuple[Fraction, Fraction] | None = dataclasses.field(default=None, compare=False)

    @property
    def dimension(self) -> int:
        return self.modulus.degree

    @property
    def height(self) -> int:
        """The number of extensions in the tower."""
        return self.base.height + 1

    @property
    def ground(self) -> Field:
        return self.base.ground

    @property
    def absolute_degree(self) -> int:
        return self.dimension * self.base.absolute_degree

    @property
    def generator(self) -> ExtensionPoly:
        """The constant c."""
        return self.element(self.base.x)

    def element(self, polynomial: Poly) -> ExtensionPoly:
        """The value at c of a polynomial over K of a lower degree than the modulus."""
        return ExtensionPoly(self, tuple(polynomial[i] for i in range(self.dimension)))

    def poly(self, coefficients: Iterable[Scalar | Poly]) -> ExtensionPoly:
        parts: list[list[Scalar | Poly]] = [[] for _ in range(self.dimension)]
        for coefficient in coefficients:
            if isinstance(coefficient, ExtensionPoly) and coefficient.field == self:
                for target, part in zip(parts, coefficient.parts, strict=True):
                    target.append(part)
            else:
                parts[0].append(coefficient)
                for target in parts[1:]:
                    target.append(0)
        return ExtensionPoly(self, tuple(self.base.poly(part) for part in parts))

    def extends(self, other: Field) -> bool:
        return self.base == other or self.base.extends(other)

    def embed(self, polynomial: Poly) -> Poly:
        if polynomial.field != self.base:
            polynomial = self.base.embed(polynomial)
        zero = self.base.poly([])
        return ExtensionPoly(self, (polynomial, *[zero] * (self.dimension - 1)))

    def _factors(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        remaining = polynomial.monic()
        factors: list[tuple[Poly, int]] = []
        for factor in self._factor_squarefree(remaining // remaining.gcd(remaining.derivative())):
            remaining, multiplicity = remaining.remove(factor)
            factors.append((factor, multiplicity))
        return sorted(factors, key=lambda pair: (pair[0].degree, str(pair[0])))

    def _factor_squarefree(self, polynomial: Poly) -> list[Poly]:
        if polynomial.degree <= 1:
            return [polynomial] if polynomial.degree == 1 else []
        x = self.x
        for shift in integers_by_size():
            shifted = polynomial(x - self.generator * shift)
            image = norm(shifted)
            if image.gcd(image.derivative()).degree == 0:
                break
        back = x + self.generator * shift
        return [shifted.gcd(self.embed(factor))(back).monic() for factor, _ in self.base.factor(image)]

    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        return splitting.bundles(self.base, self.modulus, allowed)

    def collector(self, shape: tuple[int, ...]) -> Collector:
        rarely = splitting.splits_rarely(self.base, self.modulus)
        return splitting.Ideals(self.dimension, shape) if rarely else self.base.collector(shape)

    def coordinates(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Any]:
        if splitting.splits_rarely(self.base, self.modulus):
            return list(images[0])
        return self.base.coordinates(*splitting.coordinates(bundle, images, self.dimension))

    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        parts = self.base.assemble(coordinates)
        n = self.dimension
        return [ExtensionPoly(self, tuple(parts[i : i + n])) for i in range(0, len(parts), n)]

    def rational_value(self, constant: Poly) -> Fraction | None:
        if not isinstance(constant, ExtensionPoly) or constant.field != self:
            return self.base.rational_value(constant)
        return None if any(constant.parts[1:]) else self.base.rational_value(constant.parts[0])

    def sqrt(self, constant: Poly) -> Poly | None:
        value = constant if isinstance(constant, ExtensionPoly) and constant.field == self else self.poly([constant])
        if not any(value.parts[1:]):
            # A square root of an element of K has degree 1 or 2 over K; sqrt(v) = a + b sqrt(d) leaves a = 0 or b = 0.
            root = self.base.sqrt(value.parts[0])
            if root is not None or self.dimension % 2:
                return None if root is None else self.embed(root)
            if self.dimension == 2:
                middle = self.generator + self.modulus[1] / 2
                square = self.modulus[1] * self.modulus[1] / 4 - self.modulus[0]
                root = self.base.sqrt(value.parts[0] / square)
                return None if root is None else middle * root
        return self._sqrt_of_irrational(value)

    def _sqrt_of_irrational(self, value: ExtensionPoly) -> ExtensionPoly | None:
        """A square root r of e, whose characteristic polynomial mu over K is irreducible once e generates K(c).

        Then mu(Y^2) = f(Y) f(-Y) up to its sign, f(r) = 0, exactly where e is a square, and with f(Y) = A(Y^2) + Y B(Y^2) the
        root is -A(e)/B(e).  An e of a smaller field is multiplied by squares until it generates K(c).
        """
        unit = self.poly([1])
        for shift in count():
            e = value * unit * unit
            element = self.base.poly([part[0] for part in e.parts])
            mu = characteristic_polynomial(element, self.modulus)
            if self.base.sqrt(mu[0] * (-1) ** self.dimension) is None:  # the norm, which of a square is one
                return None
            if mu.gcd(mu.derivative()).degree == 0:
                break
            unit = self.generator + shift
        even = self.base.poly([c for coefficient in mu for c in (coefficient, 0)][:-1])
        f = self.base.factor(even)[0][0]
        if f.degree != self.dimension:  # else it is 2n, or K(c) no field: e divides zero, and f has no root to lift
            return None
        return self.element(_root_by_primes(element, f, self.modulus)) / unit

    def __str__(self) -> str:
        return f"{self.base}({self.name})"


class ExtensionPoly(Poly):
    """A polynomial over K(c): the tuple of its coordinates with respect to 1, c, c**2, ..., polynomials over K."""

    __slots__ = ("field", "parts")

    field: AlgebraicField
    parts: tuple[Poly, ...]

    def __init__(self, field: AlgebraicField, parts: tuple[Poly, ...]) -> None:
        object.__setattr__(self, "field", field)
        object.__setattr__(self, "parts", parts)

    def __reduce__(self) -> tuple[Any, ...]:
        return ExtensionPoly, (self.field, self.parts)

    def key(self) -> tuple[Any, ...]:
        return tuple(part.key() for part in self.parts)

    def __eq__(self, other: object) -> bool:
        same = isinstance(other, ExtensionPoly) and other.field is self.field
        return self.parts == other.parts if same else super().__eq__(other)  # type: ignore[attr-defined]

    __hash__ = Poly.__hash__

    def leaves(self) -> list[Poly]:
        return [leaf for part in self.parts for leaf in part.leaves()]

    def extent(self) -> tuple[int, tuple[int, ...]]:
        terms, degrees = zip(*(part.extent() for part in self.parts), strict=True)
        return sum(terms), tuple(map(max, zip(*degrees, strict=True)))

    @property
    def degree(self) -> int:
        return max(part.degree for part in self.parts)

    def __getitem__(self, power: int) -> ExtensionPoly:
        return ExtensionPoly(self.field, tuple(part[power] for part in self.parts))

    def __neg__(self) -> ExtensionPoly:
        return ExtensionPoly(self.field, tuple(-part for part in self.parts))

    def _add(self, other: ExtensionPoly) -> ExtensionPoly:
        return ExtensionPoly(self.field, tuple(a + b for a, b in zip(self.parts, other.parts, strict=True)))

    def __mul__(self, other: Poly | Scalar) -> ExtensionPoly:
        if self._has_below(other):
            return ExtensionPoly(self.field, tuple([part * other for part in self.parts]))
        return super().__mul__(other)

    __rmul__ = __mul__

    def __truediv__(self, other: Poly | Scalar) -> ExtensionPoly:
        if self._has_below(other):
            return ExtensionPoly(self.field, tuple([part / other for part in self.parts]))
        return super().__truediv__(other)

    def _has_below(self, other: object) -> bool:
        """True for numbers and for polynomials over a field below: they act on the coordinates."""
        if isinstance(other, Poly):
            return other.field is not self.field and self.field.extends(other.field)
        return isinstance(other, (int, Fraction))

    def _mul(self, other: ExtensionPoly) -> ExtensionPoly:
        check_time()
        modulus = self.field.modulus
        n = modulus.degree
        products: list[Poly] = [self.field.base.poly([])] * (2 * n - 1)
        right = [(j, b) for j, b in enumerate(other.parts) if b]
        for i, a in enumerate(self.parts):
            if a:
                for j, b in right:
                    products[i + j] = products[i + j] + a * b
        for top in range(2 * n - 2, n - 1, -1):
            if products[top]:
                for i in range(n):
                    products[top - n + i] = products[top - n + i] - products[top] * modulus[i]
        return ExtensionPoly(self.field, tuple(products[:n]))

    def _divmod(self, other: ExtensionPoly) -> tuple[ExtensionPoly, ExtensionPoly]:
        if self.degree < other.degree:
            return self.field.poly([]), self
        if not any(other.parts[1:]):
            pairs = [divmod(part, other.parts[0]) for part in self.parts]
            return tuple(ExtensionPoly(self.field, parts) for parts in zip(*pairs, strict=True))  # type: ignore[return-value]
        return super()._divmod(other)

    def _gcd(self, other: ExtensionPoly) -> ExtensionPoly:
        """Through its images modulo primes, checked by division."""
        if not self or not other:
            return (self or other).monic()
        if self.degree == 0 or other.degree == 0:
            return self.field.poly([1])
        lifter = Lifter(self.field)
        for bundle in self.field.bundles():
            try:
                images = [h.keeping_degree(self).gcd(h.keeping_degree(other)) for h in bundle]
            except BadPrimeError:
                continue
            if len({image.degree() for image in images}) > 1:  # at a bad prime, too
                continue
            if images[0].degree() == 0:
                return self.field.poly([1])
            proposal = lifter.add(bundle, [[image] for image in images])
            if proposal and not self % proposal[0] and not other % proposal[0]:
                return proposal[0]  # type: ignore[return-value]
        raise AssertionError("there are infinitely many primes")

    def inverse_modulo(self, modulus: Poly) -> ExtensionPoly:
        small = modulus.degree <= _EUCLID_IN_TOWERS or self.field.ground != QQ
        return super().inverse_modulo(modulus) if small else inverse_by_primes(self, modulus)

    def derivative(self) -> ExtensionPoly:
        return ExtensionPoly(self.field, tuple(part.derivative() for part in self.parts))

    def inverse(self) -> ExtensionPoly:
        if self.degree > 0:
            raise ValueError("only constants have an inverse")
        base = self.field.base
        if not any(self.parts[1:]):
            return ExtensionPoly(self.field, (self.parts[0].inverse(), *self.parts[1:]))
        return self.field.element(base.poly([part[0] for part in self.parts]).inverse_modulo(self.field.modulus))

    def to_sympy(self, variable: Any) -> Any:
        """As for every polynomial; the generator is a radical where it is called so, else a symbol."""
        from sympy import Add, Symbol

        field = self.field
        generator = Symbol(field.name)
        if field.name == "I" or not field.name.isidentifier():  # sqrt(2), root(2, 5): its power is in the field below
            generator = radical(-field.modulus[0].to_sympy(variable), field.modulus.degree)
        return Add(*(part.to_sympy(variable) * generator**i for i, part in enumerate(self.parts) if part))

    def rational_coefficients(self) -> tuple[Any, ...]:
        width = self.field.base.absolute_degree
        result: list[Any] = []
        for power in range(self.degree + 1):
            for part in self.parts:
                coordinates = part[power].rational_coefficients()
                result += [*coordinates, *[fmpq(0)] * (width - len(coordinates))]
        return tuple(result)

    def coefficient_strings(self) -> list[str]:
        base = self.field.base
        name = self.field.name
        return [base.poly([part[power] for part in self.parts]).integer_str(name) for power in range(self.degree + 1)]


def _root_by_primes(element: Poly, f: Poly, modulus: Poly) -> Poly:
    """-A(e)/B(e) in K[x]/modulus for f(Y) = A(Y^2) + Y B(Y^2), which is a square root of e, from its images modulo primes."""

    def root_modulo(h: Homomorphism) -> Any:
        g = h.keeping_degree(f)
        reduced = h.keeping_degree(modulus)
        A, B = (nmod_poly(g.coeffs()[start::2], h.p).compose_mod(h(element), reduced) for start in (0, 1))
        common, inverse, _ = B.xgcd(reduced)
        if common.degree() > 0:
            raise BadPrimeError(f"{h.p} divides the norm of B(e)")
        return -A * inverse % reduced

    # y = -A(e)/B(e), since f(y) = A(e) + y B(e) = 0 for y^2 = e.
    return lifted(element.field, root_modulo, lambda root: not (root * root - element) % modulus)


def norm(polynomial: Poly) -> Poly:
    """The norm from K(c)[x] to K[x], from the traces of the powers."""
    field = polynomial.field
    assert isinstance(field, AlgebraicField)
    n = field.dimension
    sums = power_sums(field.modulus)
    power = polynomial
    traces = list[Poly]()
    for _ in range(n):
        traces.append(sum((part * s for part, s in zip(power.parts, sums, strict=True)), field.base.poly([])))
        power = power * polynomial
    return coefficients_from_traces(traces)[n] * (-1 if n % 2 else 1)


def adjoined_square_root(field: Field, value: Poly, *, as_radical: bool = False) -> Poly:
    """A square root of a non-zero constant: in the field if it has one, else in K(c) with c^2 the simplified radicand.

    c is called `sqrt(...)`, and written so, if it is wanted `as_radical`, without squares of parameters in the radicand.
    """
    root = field.sqrt(value)
    if root is not None:
        return root
    factor, radicand = value.square_part() if as_radical or isinstance(value, RationalPoly) else (1, value)
    modulus = field.poly([-radicand, 0, 1])
    adjoined = AlgebraicField(field, modulus, f"sqrt({radicand})") if as_radical else AlgebraicField(field, modulus)
    return adjoined.generator * factor


def root_of_constant(value: Poly, n: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of a constant of the field within it, None if there is none."""
    field = value.field
    if n == 2:
        return field.sqrt(value)
    factors = field.factor(field.poly([-value, *[0] * (n - 1), 1]))
    return next((-factor[0] for factor, _ in factors if factor.degree == 1), None)


def root_in_residue_field(value: Poly, p: Poly, n: int) -> Poly | None:
    """A square or cubic root in K[x]/p, None if there is none."""
    if p.degree == 1:
        return root_of_constant(value % p, n)
    extension = AlgebraicField(value.field, p, "_a")
    found = root_of_constant(extension.element(value % p), n)
    return None if found is None else value.field.poly([part[0] for part in found.over(extension).parts])


def inverse_root(value: Poly, p: Poly, n: int, precision: int, start: Poly | int = 1) -> Poly:
    """The y = start modulo p with value y^n = 1 modulo p^precision, where that holds modulo p; by Newton's method."""
    y = value.field.zero + start
    known = 1
    while known < precision:
        known = min(2 * known, precision)
        power = p**known
        y = (y + y * (1 - value * y**n % power) / n) % power
    return y


def root_modulo(value: Poly, p: Poly, n: int, precision: int) -> Poly | None:
    """A square or cubic root of a polynomial prime to p modulo p^precision, None if there is none."""
    start = root_in_residue_field(value, p, n)
    if start is None:
        return None
    return value * inverse_root(value, p, n, precision, start.inverse_modulo(p)) ** (n - 1) % p**precision
