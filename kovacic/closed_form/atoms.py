"""Polynomials, rational functions and products as SymPy expressions, built directly and without simplification."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

import sympy
from sympy import Add, Integer, Mul, Pow, Rational, Symbol, exp, log, sqrt

from kovacic.algebra.embedding import real_root_index
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.closed_form import plain
from kovacic.closed_form.partial_fractions import Decomposition, Residue
from kovacic.closed_form.plain import Expr, RootSum
from kovacic.closed_form.product import Product


def rational(value: Fraction | int) -> Expr:
    """A SymPy rational number."""
    return Rational(value.numerator, value.denominator)


class _Factor(NamedTuple):
    """base^exponent; factors with the same fractional `key` share a root."""

    base: Expr
    exponent: Expr
    key: Expr


class Atoms:
    """Conversions for one variable.  Algebraic constants become radicals if they are quadratic, else a `CRootOf`.

    A `CRootOf` is the first root in SymPy's order, which is real if there is a real one.
    """

    def __init__(self, variable: Symbol) -> None:
        self.x = variable
        self._generators: dict[tuple[Any, ...], Expr] = {}
        self.notes: list[str] = []

    @cached_property
    def root(self) -> Expr:
        """The bound variable of sums over roots."""
        return sympy.Dummy("a")

    # ------------------------------------------------------------------------------------------- constants

    def constant(self, value: Poly) -> Expr:
        """A constant of the field."""
        fraction = value.field.rational_value(value)
        if fraction is not None:
            return rational(fraction)
        if isinstance(value, FunctionPoly):
            names = [Symbol(name) for name in value.field.names]
            top, bottom = (self._parametric(part, names) for part in (value.num, value.den))
            return top / bottom
        generator = self.generator(value.field)
        parts = value.parts
        return sympy.expand_mul(Add(*(Mul(self.constant(part), generator**i) for i, part in enumerate(parts) if part)))

    @staticmethod
    def _parametric(polynomial: Any, names: list[Symbol]) -> Expr:
        """A polynomial in the parameters alone; its first variable, x, doesn't occur."""
        return Add(
            *(
                Mul(Integer(int(c)), *(name ** int(k) for name, k in zip(names, exponents[1:], strict=True)))
                for exponents, c in polynomial.to_dict().items()
            )
        )

    def generator(self, field: Field) -> Expr:
        """The generator of an algebraic extension."""
        if not isinstance(field, AlgebraicField):
            raise TypeError("the rational numbers have no generator")
        key = (str(field.base), field.modulus.key())
        if key not in self._generators:
            self._generators[key] = self._new_generator(field)
            if self._generators[key].has(sympy.CRootOf):
                self.notes.append(f"{field.name} stands for {self._generators[key]}")
        return self._generators[key]

    def _new_generator(self, field: AlgebraicField) -> Expr:
        modulus = field.modulus
        if modulus.degree == 2:
            half = self.constant(modulus[1]) / 2
            root = sqrt(half**2 - self.constant(modulus[0]))
            return -half - root if _is_the_smaller_root(field) else -half + root
        pure = modulus.field.rational_value(-modulus[0])
        principal = field.approximation is None or (field.approximation[0] > 0 and not field.approximation[1])
        if principal and pure is not None and pure > 0 and not any(modulus[k] for k in range(1, modulus.degree)):
            return Pow(rational(pure), rational(Fraction(1, modulus.degree)))
        return _chosen_root(sympy.Poly.from_list(self.coefficients(modulus)[::-1], self.x), field)

    def coefficients(self, polynomial: Poly) -> list[Expr]:
        """The coefficients from low to high."""
        if polynomial.field != QQ:
            return [self.constant(c) for c in polynomial]
        return [Rational(int(c.p), int(c.q)) for c in polynomial.rational_coefficients()]

    # ---------------------------------------------------------------------------------- rational functions

    def poly(self, polynomial: Poly, variable: Expr = None) -> Expr:
        """A polynomial, expanded."""
        x = self.x if variable is None else variable
        return plain.polynomial(self.coefficients(polynomial), x)

    def primitive(self, polynomial: Poly) -> tuple[Fraction, Expr]:
        """(content, expression): the polynomial is content * expression, which has coprime integer coefficients over Q."""
        if not isinstance(polynomial, RationalPoly) or not polynomial:
            return Fraction(1), self.poly(polynomial)
        numerator = polynomial.numerator()
        content = int(numerator.content())
        if numerator.leading_coefficient() < 0:
            content = -content
        coefficients = [Integer(int(c)) for c in (numerator // content).coeffs()]
        return Fraction(content, polynomial.common_denominator()), plain.polynomial(coefficients, self.x)

    def ratio(self, r: RatFunc) -> Expr:
        """A rational function as one fraction."""
        (c, num), (d, den) = self.primitive(r.num), self.primitive(r.den)
        return plain.quotient(rational(c / d) * num if c != d else num, den)

    def sum(self, r: RatFunc) -> Expr:
        """A rational function as polynomial part and proper fraction."""
        if r.is_polynomial:
            return self.poly(r.num)
        polynomial, rest = divmod(r.num, r.den)
        return plain.plus(self.poly(polynomial), self.ratio(RatFunc(rest, r.den)))

    def factored(self, r: RatFunc) -> Expr:
        """A rational function as a product of powers of irreducible polynomials."""
        factors: list[Expr] = [self.constant(r.num.lc)] if r.num else [Integer(0)]
        content = Fraction(1)
        for polynomial, sign in ((r.num, 1), (r.den, -1)):
            for p, k in r.field.factor(polynomial) if polynomial.degree > 0 else []:
                c, base = self.primitive(p)
                content *= c ** (sign * k)
                factors.append(plain.power(base, Integer(sign * k)))
        return plain.times(rational(content), *factors)

    # ---------------------------------------------------------------------------------------------- roots

    def quadratic_roots(self, p: Poly) -> tuple[Expr, Expr, Expr]:
        """(centre, disc, root of |disc|) of a monic quadratic polynomial over Q, whose roots are centre +- sqrt(disc)/2."""
        b, c = self.constant(p[1]), self.constant(p[0])
        discriminant = b**2 - 4 * c
        return -b / 2, discriminant, sqrt(abs(discriminant))

    def in_root(self, element: Poly, root: Expr) -> Expr:
        """An element of K[x]/p at a root of p."""
        return Add(*(c * root**k for k, c in enumerate(self.coefficients(element)) if c))

    def log_sum(self, residue: Residue) -> Expr:
        """sum over the roots a of p of residue(a) log(x - a) up to a constant; real for quadratic p over Q."""
        p, value = residue.factor, residue.value
        if residue.is_constant:
            return plain.times(self.constant(value), plain.logarithm(self.primitive(p)[1]))
        if p.degree == 2 and p.field == QQ:
            centre, discriminant, root = self.quadratic_roots(p)
            if discriminant > 0:
                roots = [centre - root / 2, centre + root / 2]
                return Add(*(sympy.expand_mul(self.in_root(value, a)) * log(self.x - a) for a in roots))
            mean, slope = self.constant(value[0]) + self.constant(value[1]) * centre, self.constant(value[1])
            angle = -slope * root * sympy.atan(sympy.expand_mul(2 * (self.x - centre) / root))
            return angle + (mean * log(self.primitive(p)[1]) if mean else 0)
        a = self.root
        return self.root_sum(self.poly(p, a), self.in_root(value, a) * log(self.x - a))

    def root_sum(self, polynomial: Expr, body: Expr) -> Expr:
        """The sum of the body over the roots of a polynomial, both in the symbol `root`."""
        over = sympy.Poly(polynomial, self.root)
        kind = RootSum if over.domain.is_EX else sympy.RootSum
        return kind(over, sympy.Lambda(self.root, body), auto=False)

    def integral(self, parts: Decomposition) -> Expr:
        """The integral of a decomposed rational function: rational part and logarithms."""
        return plain.plus(self.sum(parts.exact), *self.logarithms(parts.residues))

    def logarithms(self, residues: Iterable[Residue]) -> list[Expr]:
        """Logarithms; those of two linear factors with opposite residues as one, real between the roots if 0 lies there."""
        pending, terms = list(residues), []
        while pending:
            first = pending.pop()
            partner = None
            if first.is_constant and first.factor.degree == 1:
                candidates = (r for r in pending if r.is_constant and r.factor.degree == 1 and r.value == -first.value)
                partner = next(candidates, None)
            if partner is None:
                terms.append(self.log_sum(first))
                continue
            pending.remove(partner)
            top, bottom = self.primitive(first.factor)[1], self.primitive(partner.factor)[1]
            at_zero = first.factor.field.rational_value(first.factor[0] * partner.factor[0])
            if at_zero is not None and at_zero < 0:
                bottom = plain.times(Integer(-1), bottom)
            terms.append(plain.times(self.constant(first.value), plain.logarithm(plain.quotient(top, bottom))))
        return terms[::-1]

    # ------------------------------------------------------------------------------------------- products

    def product(self, y: Product, *, around_zero: bool = False) -> Expr:
        """A product, up to a constant factor."""
        return plain.times(*self.factors(y, around_zero=around_zero)[1])

    def factors(
        self, y: Product, extra: RatFunc | None = None, *, like: Product | None = None, around_zero: bool = True
    ) -> tuple[Expr, list[Expr]]:
        """(c, factors): y * extra is c times the product of the factors; common factors of y and extra are merged.

        Bases with the same fractional exponent come under one root.  (p q)^e and p^e q^e differ by a constant that isn't the
        same everywhere; in a sum, all terms must use the same roots: those of the product `like`, from which the exponents
        differ by integers.  With `around_zero` the roots of x^2 - a, a > 0, are written so that they are real around 0.
        """
        scale: Expr = Integer(1)
        alone = like is None and extra is None
        keys = {} if alone else {power.base: power.exponent for power in (like or y).powers}
        exponents: list[_Factor] = []
        rest = extra
        for power in y.powers:
            exponent = power.exponent
            if rest is not None and rest:
                num, up = rest.num.remove(power.base)
                den, down = rest.den.remove(power.base)
                rest = RatFunc(num, den, reduced=True)
                exponent = exponent + (up - down)
            if exponent:
                content, base = self.primitive(power.base)
                index = self.constant(exponent)
                if content != 1:
                    scale = scale * rational(content) ** index
                key = index if alone else self.constant(keys.get(power.base, exponent))
                exponents.append(_Factor(base, index, key))
        for residue in y.roots:
            exponents += [_Factor(base, index, index) for base, index in self._root_powers(residue)]
        if rest is not None:
            (c, num), (d, den) = self.primitive(rest.num), self.primitive(rest.den)
            if c != d:
                scale = scale * rational(c / d)
            exponents += [_Factor(num, Integer(1), Integer(1)), _Factor(den, Integer(-1), Integer(-1))]
        sign, powers = self._grouped(exponents, around_zero)
        return plain.times(scale, sign), [*powers, self.exponential(y)]

    def exponential(self, y: Product) -> Expr:
        """The factor exp(rational function) of a product, with the sums over roots that aren't written as powers."""
        inner = [self.log_sum(residue) for residue in y.roots if not self._explicit(residue)]
        if y.exponential.num.degree > 0 or not y.exponential.is_polynomial:
            rational_part = self.sum(y.exponential)
            if not inner:
                return plain.exponential(rational_part)
            inner.append(rational_part)
        return exp(Add(*inner)) if inner else Integer(1)

    def is_linear_power(self, residue: Residue) -> bool:
        """Is the residue the same at all roots, so that it is an exponent?"""
        return residue.is_constant

    def _explicit(self, residue: Residue) -> bool:
        """Are there real roots that can be written down?"""
        p = residue.factor
        if p.degree != 2 or p.field != QQ:
            return False
        return bool(self.quadratic_roots(p)[1] > 0)

    def _root_powers(self, residue: Residue) -> list[tuple[Expr, Expr]]:
        if not self._explicit(residue):
            return []
        centre, _, root = self.quadratic_roots(residue.factor)
        return [
            (self.x - a, sympy.expand_mul(self.in_root(residue.value, a)))
            for a in (centre - root / 2, centre + root / 2)
        ]

    def _grouped(self, factors: list[_Factor], around_zero: bool) -> tuple[Expr, list[Expr]]:
        """(c, powers) with the product c * powers; (x - a)(x + a) is multiplied out."""
        roots: dict[Expr, list[_Factor]] = {}
        integers: dict[Expr, list[Expr]] = {}
        for factor in factors:
            if factor.exponent.is_integer:
                integers.setdefault(factor.exponent, []).append(factor.base)
            else:
                roots.setdefault(factor.key, []).append(factor)
        scale: Expr = Integer(1)
        powers: list[Expr] = []
        for group in roots.values():
            exponent = group[0].exponent
            for factor in group[1:]:
                if factor.exponent != exponent:
                    integers.setdefault(factor.exponent - exponent, []).append(factor.base)
            bases = self._joined([factor.base for factor in group])
            turned = [
                plain.times(Integer(-1), base) if around_zero and self._is_negative_around_zero(base) else base
                for base in bases
            ]
            flips = sum(base != other for base, other in zip(bases, turned, strict=True))
            if flips:
                scale = plain.times(scale, Integer(-1) ** (exponent * flips))
            powers.append(plain.power(plain.times(*turned), exponent))
        powers += [plain.power(base, k) for k, bases in integers.items() for base in self._joined(bases)]
        return scale, powers

    def _is_negative_around_zero(self, base: Expr) -> bool:
        """Is this c x^2 - a with a > 0?"""
        if not base.is_Add:
            return False
        constants = [term for term in base.args if term.is_number]
        powers = [term for term in base.args if not term.is_number]
        return len(powers) == 1 and self._degree(powers[0]) == 2 and bool(Add(*constants).is_negative)

    def _degree(self, monomial: Expr) -> int | None:
        """The degree of c x^k; None for anything else."""
        power = monomial.as_coeff_Mul()[1]
        if power.is_Mul:  # with an irrational coefficient
            power = power.as_independent(self.x, as_Add=False)[1]
        power = power.as_base_exp()
        return int(power[1]) if power[0] == self.x and power[1].is_Integer else None

    def _joined(self, bases: list[Expr]) -> list[Expr]:
        """With every pair x - a, x + a multiplied out."""
        pending, result = list(bases), []
        while pending:
            base = pending.pop(0)
            partner = next((other for other in pending if self._opposite(base, other)), None)
            if partner is not None:
                pending.remove(partner)
                b, ax = _constant_first(base)
                base = plain.plus(-(b**2), plain.times(ax, ax))
            result.append(base)
        return result

    def _opposite(self, first: Expr, second: Expr) -> bool:
        """Are these a x - b and a x + b?"""
        if not (first.is_Add and second.is_Add and len(first.args) == len(second.args) == 2):
            return False
        (b, ax), (c, other) = _constant_first(first), _constant_first(second)
        return bool(b.is_number and ax == other and b == -c and self._degree(ax) == 1)


def _constant_first(binomial: Expr) -> tuple[Expr, Expr]:
    """Its two terms, a number before the other one."""
    first, second = binomial.args
    return (first, second) if first.is_number else (second, first)


def _is_the_smaller_root(field: AlgebraicField) -> bool:
    """Is the root of a quadratic polynomial that is meant the one below the middle of both (or below the real axis)?"""
    if field.approximation is None:
        return False
    real, imaginary = field.approximation
    middle = field.base.rational_value(field.modulus[1])
    return imaginary < 0 or (imaginary == 0 and middle is not None and real < -middle / 2)


def _chosen_root(polynomial: Any, field: AlgebraicField) -> Expr:
    """The root that the field means, or SymPy's first one."""
    if field.approximation is None or field.ground != field.base:
        return sympy.CRootOf(polynomial, 0)
    values = [field.base.rational_value(c) for c in field.modulus]
    index = real_root_index(QQ.poly([v for v in values if v is not None]), field.approximation)
    if index is not None:
        return sympy.CRootOf(polynomial, index)
    real, imaginary = (float(part) for part in field.approximation)
    roots = [sympy.CRootOf(polynomial, k) for k in range(field.dimension)]
    return min(roots, key=lambda root: abs(complex(root.evalf(15)) - complex(real, imaginary)))
