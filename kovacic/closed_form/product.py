"""Products of powers, exponentials and their kin: the functions whose logarithmic derivatives are rational.

A `Product` is exp(int omega) for omega in K(x), K any field of constants, kept as data: what a person would write, what
the numeric part can evaluate, and what can be checked exactly, since its logarithmic derivative is computed from the
written form and not from omega.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, is_dataclass
from fractions import Fraction

from kovacic.algebra.partial_fractions import Residue, decompose
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.compatibility import cached_property


@dataclass(frozen=True)
class Power:
    """`base ** exponent`, base a monic polynomial, exponent a constant of the field."""

    base: Poly
    exponent: Poly

    @property
    def rational_exponent(self) -> Fraction | None:
        """The exponent if it is rational, else None."""
        return self.exponent.field.rational_value(self.exponent)


@dataclass(frozen=True)
class Product:
    """`prod base^exponent * prod_(roots a) (x - a)^(residue(a)) * exp(exponential)`, up to a constant factor.

    `roots` holds the irreducible factors at whose roots a the exponents differ from one another.
    """

    powers: tuple[Power, ...]
    roots: tuple[Residue, ...]
    exponential: RatFunc

    @property
    def field(self) -> Field:
        return self.exponential.field

    @cached_property
    def logarithmic_derivative(self) -> RatFunc:
        """y'/y, computed from the factors."""
        powers = (RatFunc(power.base.derivative() * power.exponent, power.base) for power in self.powers)
        roots = (residue.logarithmic for residue in self.roots)
        return sum((*powers, *roots), self.exponential.derivative())

    @property
    def length(self) -> int:
        """The approximate length in characters, without SymPy."""
        return written_length(self.powers, self.roots, self.exponential)

    def to_power(self, n: int) -> Product:
        powers = tuple(Power(power.base, power.exponent * n) for power in self.powers)
        roots = tuple(Residue(residue.factor, residue.value * n) for residue in self.roots)
        return Product(powers, roots, self.exponential * n)


def written_length(*parts: object) -> int:
    """The approximate length in characters of polynomials, rational functions and objects made of them; none for 0 and 1."""
    length = 0
    for part in parts:
        if isinstance(part, RatFunc):
            length += written_length(part.num, part.den)
        elif isinstance(part, Poly):
            text = str(part.rep) if isinstance(part, RationalPoly) else str(part)  # FLINT's own text is the fastest
            length += 0 if text in ("0", "1") else len(text) + 3
        elif isinstance(part, tuple):
            length += written_length(*part)
        elif is_dataclass(part):
            length += written_length(*vars(part).values())
    return length


def gathered_powers(powers: Iterable[Power]) -> tuple[Power, ...]:
    """The powers, every base once."""
    exponents: dict[Poly, Poly] = {}
    for power in powers:
        exponents[power.base] = exponents.get(power.base, power.exponent * 0) + power.exponent
    return tuple(Power(base, exponent) for base, exponent in exponents.items() if exponent)


def product(logarithmic_derivative: RatFunc, zeros: Poly | None = None) -> Product:
    """exp(int omega) for omega = `logarithmic_derivative` + zeros'/zeros.

    `zeros` may have many roots, and is kept as one factor unless it shares one with the rest.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> y = product(x + 1 / (3 * x), QQ.poly([-3, 0, 1]))
    >>> print([(str(f.base), str(f.exponent)) for f in y.powers], y.exponential)
    [('x', '1/3'), ('x**2 - 3', '1')] x**2/2
    """
    parts = decompose(logarithmic_derivative)
    powers = [Power(residue.factor, residue.value) for residue in parts.residues if residue.is_constant]
    roots = tuple(residue for residue in parts.residues if not residue.is_constant)
    if zeros is not None and zeros.degree > 0:
        # What the zeros share with the bases joins these, the rest is one factor.
        rest = zeros.over(parts.exact.field).monic()
        for i, power in enumerate(powers):
            rest, count = rest.remove(power.base)
            powers[i] = Power(power.base, power.exponent + count)
        if rest.degree > 0:
            powers.append(Power(rest, rest.field.one))
    return Product(tuple(power for power in powers if power.exponent), roots, parts.exact)


@dataclass(frozen=True)
class Factor:
    """base^exponent; factors with the same fractional `key` share a root."""

    base: Poly
    exponent: Poly
    key: Poly


def merged(y: Product, extra: RatFunc | None = None, *, like: Product | None = None) -> list[Factor]:
    """The powers of y * extra, common factors of y and extra merged.

    Bases with the same fractional exponent come under one root.  (p q)^e and p^e q^e differ by a constant that isn't the
    same everywhere; in a sum, all terms must use the same roots: those of the product `like`, from which the exponents
    differ by integers.
    """
    is_alone = like is None and extra is None
    keys = {} if is_alone else {power.base: power.exponent for power in (like or y).powers}
    found = []
    rest = extra
    for power in y.powers:
        exponent = power.exponent
        if rest:
            num, up = rest.num.remove(power.base)
            den, down = rest.den.remove(power.base)
            rest = RatFunc(num, den, reduced=True)
            exponent = exponent + (up - down)
        if exponent:
            found.append(Factor(power.base, exponent, keys.get(power.base, exponent)))
    if rest is not None:
        one = y.field.one
        found += [Factor(rest.num, one, one), Factor(rest.den, -one, -one)]
    return found


def grouped_factors(found: Sequence[Factor]) -> list[tuple[list[Poly], Poly]]:
    """(bases, exponent): bases under a common root together, all others alone, and (x - a)(x + a) multiplied out."""
    fractional: dict[Poly, list[Factor]] = {}
    integral: dict[Poly, list[Poly]] = {}
    for factor in found:
        value = factor.exponent.field.rational_value(factor.exponent)
        if value is not None and value.denominator == 1:
            integral.setdefault(factor.exponent, []).append(factor.base)
        else:
            fractional.setdefault(factor.key, []).append(factor)
    powers = []
    for group in fractional.values():
        exponent = group[0].exponent
        for factor in group[1:]:
            if factor.exponent != exponent:
                integral.setdefault(factor.exponent - exponent, []).append(factor.base)
        powers.append((joined([factor.base for factor in group]), exponent))
    return powers + [([base], exponent) for exponent, bases in integral.items() for base in joined(bases)]


def joined(bases: list[Poly]) -> list[Poly]:
    """With every pair x - a, x + a multiplied out."""
    result: list[Poly] = []
    for base in bases:
        # x + a joins x - a, for a other than 0
        lines = [k for k, p in enumerate(result) if p.degree == base.degree == 1 and p[0]]
        partner = next((k for k in lines if result[k][0] * base[1] == -base[0] * result[k][1]), None)
        if partner is None:
            result.append(base)
        else:
            result[partner] = result[partner] * base
    return result
