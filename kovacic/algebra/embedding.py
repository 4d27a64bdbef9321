"""Number fields inside the complex numbers: which root is meant, and one primitive element for several constants.

A user's sqrt(2) + sqrt(8) isn't 0: radicals have principal values.  A `NumberField` is a field Q(theta) with an approximation
of theta, good enough to tell the roots of every polynomial that turns up from one another; decisions about equality are
always exact, an approximation only chooses between roots that are known to be different.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import count
from math import isqrt
from typing import Any

from flint import acb, arb, ctx, fmpq, fmpq_mat, fmpz, fmpz_poly

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.errors import LimitExceeded

#: Bits of the approximations.
_PRECISION = 512
#: What is smaller than this is zero, where it is known that one of several candidates is.
_TINY_BITS = 200
#: Integers up to this size are factored, to write sqrt(8) as 2*sqrt(2).
_FACTORED_BITS = 160


@dataclass(frozen=True)
class NumberField:
    """Q(theta) inside C.

    `field` is Q or a simple extension of it, `theta` the real and imaginary part of the approximation, `labels` what the
    user called the generators, and `radicals` the roots that are known: (radicand, n, root).
    """

    field: Field = QQ
    theta: tuple[Fraction, Fraction] = (Fraction(0), Fraction(0))
    labels: tuple[str, ...] = ()
    radicals: tuple[tuple[Poly, int, Poly], ...] = ()

    def approximation(self, constant: Poly) -> Any:
        """The complex number that an element is, as an `acb`."""
        with ctx.workprec(_PRECISION):
            if not isinstance(constant, ExtensionPoly):
                return acb(constant[0].rational_coefficients()[0] if constant else 0)
            theta, total = _complex(self.theta), acb(0)
            for part in reversed(constant.parts):
                total = total * theta + (part.rational_coefficients()[0] if part else 0)
            return total

    def located(self) -> str:
        """Where theta lies, to a few digits."""
        real, imaginary = (f"{float(part):.6g}" for part in self.theta)
        if not self.theta[1]:
            return real
        return f"{real} {'-' if imaginary.startswith('-') else '+'} {imaginary.lstrip('-')}*I"

    def radical(self, radicand: Poly, n: int, label: str, limit: int) -> tuple[NumberField, Poly]:
        """The principal n-th root, and the field that has it: this one, or an extension.

        Raises `LimitExceeded` if the degree of the extension over Q would exceed `limit`.
        """
        if not radicand:
            return self, radicand
        for known, exponent, root in self.radicals:
            if exponent == n and known == radicand:
                return self, root
        outer = Fraction(1)
        if n == 2 and (rational := self.field.rational_value(radicand)) is not None:
            outer, rest = _square_part(rational)
            radicand = self.field.poly([rest])
            label = "I" if rest == -1 else f"sqrt({rest})"
            if rest == 1:
                return self, self.field.poly([outer])
            if outer != 1:
                field, root = self.radical(radicand, 2, label, limit)
                return field, root * outer
        with ctx.workprec(_PRECISION):
            value = self.approximation(radicand)
            if abs(value.imag) < arb(2) ** -_TINY_BITS:
                value = acb(value.real)
            target = (value.log() / n).exp()
        equation = self.field.poly([-radicand, *[0] * (n - 1), 1])
        grown, root = self.root(equation, target, label, limit)
        rational = self.field.rational_value(radicand)
        if rational is None:
            return grown, root  # a nested radical is found again by factoring
        return replace(grown, radicals=(*grown.radicals, (grown.field.poly([rational]), n, root))), root

    def root(self, equation: Poly, target: Any, label: str, limit: int) -> tuple[NumberField, Poly]:
        """The root of a polynomial over the field that lies nearest to `target`, an approximation, and its field."""
        factor = self._vanishing_factor(equation, target)
        if factor.degree == 1:
            return self, -factor[0]
        degree = factor.degree * self.field.absolute_degree
        if degree > limit:
            raise LimitExceeded(
                f"constants in a field of degree {degree} over the rational numbers, above the limit of {limit}",
                limit="constants",
            )
        pure = factor.degree == equation.degree
        if self.field == QQ:
            name = label if pure and label else "alpha"
            position = _nearest_root(factor, target)
            field = AlgebraicField(QQ, factor, name, position)
            return NumberField(field, position, (label,)), field.generator
        return self._compositum(factor, target, label)

    def _vanishing_factor(self, equation: Poly, target: Any) -> Poly:
        factors = [factor for factor, _ in self.field.factor(equation)]
        if len(factors) == 1:
            return factors[0]
        with ctx.workprec(_PRECISION):
            sizes = []
            for factor in factors:
                total = acb(0)
                for power in range(factor.degree, -1, -1):
                    total = total * target + self.approximation(factor[power])
                sizes.append(abs(total))
            order = sorted(range(len(sizes)), key=lambda i: float(sizes[i].mid()))
            if float(sizes[order[0]].mid()) * 2.0**20 > float(sizes[order[1]].mid()):
                raise AssertionError("the approximation doesn't tell the roots apart")
        return factors[order[0]]

    def _compositum(self, factor: Poly, target: Any, label: str) -> tuple[NumberField, Poly]:
        """K(c) as a simple extension of Q, by theta' = c + s theta, s a small integer."""
        old = self.field
        assert isinstance(old, AlgebraicField)
        tower = AlgebraicField(old, factor)
        n = tower.absolute_degree
        for k in count():
            shift = (k + 1) // 2 * (-1) ** (k + 1)  # 0, 1, -1, 2, ...
            primitive = tower.generator + old.generator * shift
            powers = [tower.poly([1])]
            for _ in range(n):
                powers.append(powers[-1] * primitive)
            rows = [_coordinates(power, n) for power in powers]
            matrix = fmpq_mat(n, n, [rows[j][i] for i in range(n) for j in range(n)])
            if matrix.det() != 0:
                break
        columns = [rows[n], _coordinates(tower.embed(old.generator), n), _coordinates(tower.generator, n)]
        solved = matrix.solve(fmpq_mat(n, 3, [column[i] for i in range(n) for column in columns]))
        modulus = QQ.poly([*(Fraction(int(-solved[i, 0].p), int(solved[i, 0].q)) for i in range(n)), 1])
        with ctx.workprec(_PRECISION):
            position = _nearest_root(modulus, target + _complex(self.theta) * shift)
        field = AlgebraicField(QQ, modulus, "alpha", position)
        theta, c = (field.poly([_element(field, [solved[i, k] for i in range(n)])]) for k in (1, 2))
        grown = NumberField(field, position, (*self.labels, label))
        radicals = tuple((_substituted(a, theta), k, _substituted(b, theta)) for a, k, b in self.radicals)
        return replace(grown, radicals=radicals), c


#: The field Q.
RATIONAL_NUMBERS = NumberField()


def _substituted(constant: Poly, theta: Poly) -> Poly:
    """The element with its generator replaced by another field's element."""
    field = theta.field
    if not isinstance(constant, ExtensionPoly):
        return field.embed(constant) if field.extends(constant.field) else constant
    total = field.poly([])
    for part in reversed(constant.parts):
        total = total * theta + part
    return total


def _coordinates(constant: Poly, n: int) -> list[Any]:
    coordinates = list(constant.rational_coefficients())
    return coordinates + [fmpq(0)] * (n - len(coordinates))


def _element(field: AlgebraicField, coordinates: list[Any]) -> Poly:
    parts = [RationalPoly.of([Fraction(int(c.p), int(c.q))]) for c in coordinates]
    return ExtensionPoly.make(field, parts)


def _complex(pair: tuple[Fraction, Fraction]) -> Any:
    real, imaginary = (arb(fmpq(c.numerator, c.denominator)) for c in pair)
    return acb(real, imaginary)


def real_root_index(modulus: Poly, position: tuple[Fraction, Fraction]) -> int | None:
    """How many real roots of a polynomial over Q lie below the real root at `position`; None if that one isn't real."""
    integral = fmpz_poly([int(c * modulus.common_denominator()) for c in modulus.rational_coefficients()])
    with ctx.workprec(_PRECISION):
        roots = [root for root, _ in integral.complex_roots()]
        target = _complex(position)
        nearest = min(roots, key=lambda root: float(abs(root - target).mid()))
        if not nearest.imag.contains(0) or any(
            root is not nearest and abs(root - nearest.conjugate()).contains(0) for root in roots
        ):
            return None
        return sum(1 for root in roots if root.imag.contains(0) and root.real < nearest.real)


def refined_root(minimal: Poly, approximation: Any) -> Any:
    """The root of a polynomial over Q that lies nearest to an approximation, to full precision."""
    with ctx.workprec(_PRECISION):
        return _complex(_nearest_root(minimal, approximation))


def _nearest_root(modulus: Poly, target: Any) -> tuple[Fraction, Fraction]:
    """The root of a rational polynomial that lies nearest to the target."""
    integral = fmpz_poly([int(c * modulus.common_denominator()) for c in modulus.rational_coefficients()])
    with ctx.workprec(_PRECISION):
        roots = [root for root, _ in integral.complex_roots()]
        nearest = min(roots, key=lambda root: float(abs(root - target).mid()))
        return _fraction(nearest.real), _fraction(nearest.imag)


def _fraction(value: Any) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _square_part(value: Fraction) -> tuple[Fraction, int]:
    """`(s, d)` with value = s**2 d, d an integer, squarefree where the numbers are small enough to be factored."""
    d, outer = value.numerator * value.denominator, 1
    if d.bit_length() <= _FACTORED_BITS:
        for prime, exponent in fmpz(abs(d)).factor():
            outer *= int(prime) ** (exponent // 2)
    elif d > 0 and isqrt(d) ** 2 == d:
        outer = isqrt(d)
    return Fraction(outer, value.denominator), d // outer**2
