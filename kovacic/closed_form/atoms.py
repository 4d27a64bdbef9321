"""Constants, polynomials, rational functions, their integrals and products as SymPy expressions, without simplification."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from copy import copy
from fractions import Fraction
from itertools import product
from typing import Any, cast

import sympy
from flint import acb_poly
from sympy import Add, Integer, Mul, Rational, Symbol, exp, log, ordered
from sympy.functions.special.hyper import TupleArg

from kovacic.algebra.embedding import adjoined_root, enclosure, vanishing_factor
from kovacic.algebra.extension import AlgebraicField, adjoined_square_root, norm
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.product import Factor, Product, grouped_factors, merged
from kovacic.compatibility import cached_property
from kovacic.limits import check_time
from kovacic.numbers.exact import radical
from kovacic.reading.linear import chosen_root

Expr = Any  # SymPy publishes no types


class RootSum(sympy.RootSum):  # type: ignore[misc]
    """SymPy's, which stays a sum: SymPy computes those of rational functions, as in derivatives, exactly and without end.

    With irrational coefficients SymPy compares polynomials with a TypeError, and so can't add two sums.
    """

    def _hashable_content(self) -> tuple[Expr, ...]:
        return self.poly.as_expr(), self.poly.gen, self.fun

    @classmethod
    def _is_func_rational(cls, poly: Expr, func: Expr) -> bool:
        return False


def is_seen_negative(value: Expr) -> bool:
    """True if a value is negative once letters of unknown sign are taken as positive, as in -a^2."""
    known = value.xreplace({s: sympy.Dummy(positive=True) for s in value.free_symbols if s.is_positive is None})
    return bool(known.is_negative) or (known.is_Add and sign_of_root(known) == -1)


def sign_of_root(value: Expr) -> int | None:
    """The sign of the real part of A + B sqrt(r): that of B if A^2 < B^2 r, else that of A; None if it isn't known.

    >>> p, q = sympy.symbols("p q", positive=True)
    >>> sign_of_root((p - sympy.sqrt(p**2 + q)) / 2), sign_of_root(p + sympy.sqrt(p**2 - q))
    (-1, 1)
    """
    above, below = sympy.fraction(sympy.together(value))
    roots = [part for part in above.atoms(sympy.Pow) if part.exp == sympy.S.Half and not part.base.is_number]
    if len(roots) == 1:
        linear = sympy.Poly(above, roots[0])
        A, B = linear.nth(0), linear.nth(1)
        norm = sympy.expand(A**2 - B**2 * roots[0].base)
        if linear.degree() > 1 or not norm.is_nonzero:
            return None
        above = B if norm.is_negative else A
    signs = [1 if part.is_positive else -1 if part.is_negative else 0 for part in map(sympy.factor, (above, below))]
    return signs[0] * signs[1] or None


def hypergeometric(top: tuple[Expr, ...], bottom: tuple[Expr, ...], z: Expr) -> Expr:
    """SymPy's `hyper`, made without asking whether |z| <= 1, which takes milliseconds; parameters above and below cancel.

    A series that ends at once, a power and an exponential are written as such.

    >>> a, z = sympy.symbols("a z")
    >>> hypergeometric((a, 2), (2,), z), hypergeometric((2,), (2,), z)
    ((1 - z)**(-a), exp(z))
    """
    common = Counter(top) & Counter(bottom)
    above, below = (TupleArg(*ordered((Counter(values) - common).elements())) for values in (top, bottom))
    if 0 in above:
        return Integer(1)
    if not below and len(above) < 2:  # 0F0 and 1F0 [DLMF 15.4.6]
        return sympy.factor(1 - z) ** -above[0] if above else exp(z)
    return sympy.Function.__new__(sympy.hyper, above, below, z, evaluate=False)


def antiderivative_parameters(F: Expr) -> list[tuple[Expr, Expr]]:
    """The e above and e + 1 below, with which z^e pFq(z) is an antiderivative of the function without them.

    >>> F = sympy.hyper((sympy.Symbol("s"),), (sympy.Symbol("s") + 1,), sympy.Symbol("z"))
    >>> antiderivative_parameters(F)
    [(s, s + 1)]
    """
    return [(e, b) for e, b in product(F.ap, F.bq) if sympy.cancel(b - e) == 1]


class Atoms:
    """Conversions for one variable.  Algebraic constants become radicals if they are quadratic, else a `CRootOf`.

    A `CRootOf` is the first root in SymPy's order, which is real if there is a real one.  Roots of functions of x are
    written so that they are real at the point `at`, which may be oo; without one those of x^2 - a, a > 0, are real around 0.
    `own` puts in the user's symbols, whose signs are known.
    """

    def __init__(self, variable: Symbol, *, at: Expr = None, own: Callable[[Expr], Expr] = sympy.sympify) -> None:
        self.x = variable
        self.at = at
        self.own = own
        self._generators: dict[tuple[Any, ...], Expr] = {}
        self.notes: list[str] = []

    def of_variable(self, variable: Symbol) -> Atoms:
        """Conversions for another variable, with the same constants."""
        other = copy(self)
        other.x, other.at = variable, None
        return other

    @cached_property
    def root(self) -> Expr:
        """The bound variable of sums over roots."""
        return sympy.Dummy("a")

    # ------------------------------------------------------------------------------------------- constants

    def constant(self, value: Poly) -> Expr:
        """A constant of the field."""
        fraction = value.field.rational_value(value)
        if fraction is not None:
            return Rational(fraction)
        if isinstance(value, FunctionPoly):
            return value.to_sympy(self.x)
        generator = self.generator(value.field)
        terms = [Mul(self.constant(part), generator**i) for i, part in enumerate(value.parts) if part]
        return sympy.expand_mul(Add(*terms))

    def sqrt(self, value: Poly) -> Expr:
        """A square root of a constant; squares of parameters come out of the root once and for all, sqrt(w^2) = w."""
        if isinstance(value, FunctionPoly):
            outer, inner = value.square_part()
            return outer.to_sympy(self.x) * radical(inner.to_sympy(self.x))
        if isinstance(value.field, AlgebraicField) and not any(value.parts[1:]):
            return self.sqrt(value.parts[0])
        return radical(self.constant(value))

    def root_of(self, g: Poly) -> tuple[Expr, Expr]:
        """(s, r): sqrt(g) = s r, r the root of the primitive polynomial, sqrt(x^2 - 1/a^2) = sqrt(a^2 x^2 - 1)/a."""
        c, shown = self.primitive(g)
        if self.is_negative(c):
            c, shown = -c, -shown
        return 1 / self.sqrt(c.inverse()), radical(shown)

    def sqrt_beside(self, value: Poly, g: Poly) -> Expr:
        """A square root of a constant: a multiple of the s of `root_of`."""
        c = self.cleared(g)[0]
        c = -c if self.is_negative(c) else c
        return self.sqrt(value / c) / self.sqrt(c.inverse())

    def is_negative(self, value: Poly) -> bool:
        """True if a constant is negative; with parameters of unknown signs, if its first coefficient is, as that of -w^2."""
        known = self.own(self.constant(value)).is_negative
        if known is None and isinstance(value, FunctionPoly):
            return value.is_written_with_minus
        return bool(known)

    def generator(self, field: Field) -> Expr:
        """The generator of an algebraic extension."""
        assert isinstance(field, AlgebraicField)
        key = (str(field.base), field.modulus.key())
        if key not in self._generators:
            written = self._generators[key] = self._new_generator(field)
            if written.has(sympy.CRootOf):
                self.notes.append(f"{field.name} stands for {written}")
        return self._generators[key]

    def call(self, field: AlgebraicField, expression: Expr) -> None:
        """Write the generator of an extension as this expression."""
        self._generators[str(field.base), field.modulus.key()] = expression

    def _new_generator(self, field: AlgebraicField) -> Expr:
        modulus = field.modulus
        if modulus.degree == 2:
            middle = modulus[1] * Fraction(1, 2)
            root = self.sqrt(middle * middle - modulus[0])
            return (-root if _is_the_smaller_root(field) else root) - self.constant(middle)
        real, imaginary = field.approximation or (1, 0)  # the positive root where none in particular is meant
        radicand = modulus.field.rational_value(-modulus[0])
        is_pure = not any(modulus[k] for k in range(1, modulus.degree))
        if is_pure and (radicand or 0) > 0 and real > 0 and not imaginary:
            return radical(Rational(radicand), modulus.degree)
        if isinstance(field.base, AlgebraicField) and field.ground == QQ:
            # SymPy takes polynomials over Q: Q(c) for a generator c of K(c), a real root of the modulus if there is one
            with working_precision(200):
                roots = acb_poly([enclosure(c) for c in modulus]).roots()
                target = min(roots, key=lambda root: (not root.imag.contains(0), float(root.real.mid())))
                over_Q = adjoined_root(vanishing_factor(norm(modulus), target), target, field.name)[1].field
            field = cast(AlgebraicField, over_Q)
        return chosen_root(sympy.Poly.from_list(self.coefficients(field.modulus)[::-1], self.x), field)

    def coefficients(self, polynomial: Poly) -> list[Expr]:
        """The coefficients from low to high."""
        return [self.constant(c) for c in polynomial]

    # ---------------------------------------------------------------------------------- rational functions

    def poly(self, polynomial: Poly, variable: Expr = None) -> Expr:
        """A polynomial, expanded; `variable` may be a root, for an element of K[x]/p."""
        x = self.x if variable is None else variable
        terms = []
        for k, c in enumerate(self.coefficients(polynomial)):
            check_time()  # 4,000 terms take two seconds
            if c:
                terms.append(c * x**k)
        return Add(*terms)

    def cleared(self, polynomial: Poly) -> tuple[Poly, Poly]:
        """(c, p): the polynomial is c times p, whose coefficients are coprime integers.

        Over Q(t) they are polynomials in the letters, so that a x + b stands for x + b/a; over a field of numbers c is 1.
        """
        field = polynomial.field
        if not polynomial or (field.height and field.ground == QQ):
            return field.one, polynomial
        shown, _ = field.ground.cleared(polynomial, field.zero)
        if self.is_negative(shown.lc):
            shown = -shown
        return polynomial.lc / shown.lc, shown

    def primitive(self, polynomial: Poly) -> tuple[Poly, Expr]:
        """As `cleared`, with an expression."""
        content, shown = self.cleared(polynomial)
        return content, self.poly(shown)

    def ratio(self, r: RatFunc) -> Expr:
        """A rational function as one fraction."""
        c, num = self.primitive(r.num)
        d, den = self.primitive(r.den)
        return self.constant(c / d) * num / den

    def sum(self, r: RatFunc) -> Expr:
        """A rational function as polynomial part and proper fraction."""
        polynomial, rest = divmod(r.num, r.den)
        return self.poly(polynomial) + self.ratio(RatFunc(rest, r.den))

    def factored(self, r: RatFunc) -> Expr:
        """A rational function as a product of powers of irreducible polynomials."""
        scale = RatFunc(r.num.lc)
        factors: list[Expr] = []
        for p, k in r.multiplicities:
            c, base = self.primitive(p)
            scale = scale * RatFunc(c) ** k
            factors.append(base**k)
        return Mul(self.constant(scale.num), *factors)

    # ---------------------------------------------------------------------------------------------- roots

    def real_roots(self, p: Poly) -> tuple[Expr, ...]:
        """The roots of a monic quadratic polynomial with a positive rational discriminant; none for any other."""
        if p.degree != 2:
            return ()
        square = p.field.rational_value(p[1] * p[1] - 4 * p[0]) or 0
        centre = -self.constant(p[1]) / 2
        half = radical(Rational(square)) / 2
        return (centre - half, centre + half) if square > 0 else ()

    def log_sum(self, residue: Residue) -> Expr:
        """sum over the roots a of p of residue(a) log(x - a) up to a constant; real for quadratic p over Q."""
        p, value = residue.factor, residue.value
        if residue.is_constant:
            return self.constant(value) * log(self.base(p, around_zero=True), evaluate=False)
        if roots := self.real_roots(p):
            return Add(*(sympy.expand_mul(self.poly(value, a)) * log(self.x - a) for a in roots))
        if p.degree == 2:
            return self._log_sum_of_quadratic(p, value)
        if factors := _factors_of_binomial(p) or self._real_quadratics(p):
            return Add(*(self.log_sum(Residue(q, value.over(q.field) % q)) for q in factors))
        a = self.root
        return self.root_sum(self.poly(p, a), self.poly(value, a) * log(self.x - a))

    def _real_quadratics(self, p: Poly) -> list[Poly]:
        """The factors of an irreducible quartic over an extension by real square roots; none if that takes a cubic root.

        (x^2 + a x + b)(x^2 + c x + d): a + c = p3 and a c = p2 - y, b + d = y and b d = p0, a d + b c = p1, where y is a root
        of the resolvent y^3 - p2 y^2 + (p1 p3 - 4 p0) y - (p3^2 p0 - 4 p2 p0 + p1^2).
        """
        if p.degree != 4:
            return []
        p0, p1, p2, p3 = (p[k] for k in range(4))
        resolvent = p.field.poly([4 * p2 * p0 - p3 * p3 * p0 - p1 * p1, p1 * p3 - 4 * p0, -p2, 1])
        factors = [factor for factor, _ in p.field.factor(resolvent) if factor.degree < 3]
        for factor in sorted(factors, key=lambda factor: factor.degree):
            middle = -factor[factor.degree - 1] / factor.degree
            half = middle * middle - factor[0] if factor.degree == 2 else p.field.zero
            root = self._real_root(half) if half else half
            for y in () if root is None else dict.fromkeys((middle + root, middle - root)):
                a = c = p3 / 2
                square = p3 * p3 - 4 * p2 + 4 * y  # (a - c)^2
                difference = self._real_root(square or y * y - 4 * p0)
                if difference is None:
                    continue
                b, d = (y + difference) / 2, (y - difference) / 2
                if square:
                    a, c = a + difference / 2, a - difference / 2
                    b = (p1 - a * y) / (c - a)
                    d = y - b
                x = difference.field.x
                return [x * x + a * x + b, x * x + c * x + d]
        return []

    def _real_root(self, value: Poly) -> Poly | None:
        """The square root of a constant that is positive: a number, or one times a square for all letters; else None."""
        radicand = value.square_part()[1] if isinstance(value, FunctionPoly) else value
        is_positive = self.own(self.constant(radicand)).is_positive
        return adjoined_square_root(value.field, value, as_radical=True) if is_positive else None

    def _log_sum_of_quadratic(self, p: Poly, value: Poly) -> Expr:
        """The sum of logarithms for u = A x^2 + B x + C, p = u/A: m log(u) - k w/(A sqrt(w)) atan((2 A x + B)/sqrt(w)).

        m is the mean of both residues, k their slope, w = 4 A C - B^2; for negative w there is log with sqrt(-w).
        """
        slope = value[1]
        mean = self.constant(value[0] - slope * p[1] * Fraction(1, 2))
        content, shown = self.primitive(p)
        A = content.inverse()
        total = mean * log(shown)
        twice = self.poly(p.derivative() * A)
        w = (4 * p[0] - p[1] * p[1]) * A * A
        if self.is_negative(w):
            root = self.sqrt(-w)
            return total - self.constant(slope * w / (2 * A)) / root * log((twice - root) / (twice + root))
        root = self.sqrt(w)
        return total - self.constant(slope * w / A) / root * sympy.atan(sympy.expand_mul(twice / root))

    def is_turned(self, base: Poly, *, around_zero: bool = True) -> bool:
        """True for a polynomial that is negative where its roots are to be real: those of -base are written.

        Without a point that is 0 for 1 - k x and other letters before x, and for a - x^2 with `around_zero`.
        """
        content, shown = self.cleared(base)
        point = self.at
        if point is None:
            is_pure_square = around_zero and base.degree == 2 and not base[1]
            point = Integer(0) if is_pure_square or content.field.rational_value(content) is None else sympy.oo
        if point == sympy.oo:
            return False
        if self.is_negative(content):
            shown = -shown
        if not point.is_Rational:
            return is_seen_negative(self.own(self.poly(shown).subs(self.x, point)))
        value = shown(Fraction(point.p, point.q))
        number = value.field.rational_value(value)
        return is_seen_negative(self.own(self.constant(value))) if number is None else number < 0

    def base(self, p: Poly, *, around_zero: bool) -> Expr:
        """The multiple of a monic polynomial that is written where its roots are to be real."""
        shown = self.cleared(p)[1]
        return self.poly(-shown if self.is_turned(p, around_zero=around_zero) else shown)

    def root_sum(self, polynomial: Expr, body: Expr) -> Expr:
        """The sum of the body over the roots of a polynomial, both in the symbol `root`."""
        over = sympy.Poly(polynomial, self.root)
        if over.degree() == 2:
            a, b, c = over.all_coeffs()
            half = sympy.sqrt(sympy.factor(sympy.expand(b**2 - 4 * a * c))) / (2 * a)
            roots = [sympy.expand_mul(sign * half - b / (2 * a)) for sign in (1, -1)]
            if all(root.is_rational_function() for root in roots):
                return Add(*(body.subs(self.root, root) for root in roots))
        return RootSum(over, sympy.Lambda(self.root, body))


def _factors_of_binomial(p: Poly) -> list[Poly]:
    """The factors of an irreducible (x - m)^n - b over the field of |b|^(1/n), b rational; [] if there is only one."""
    m = p.mean_of_zeros
    x, n = p.field.x, p.degree
    shifted = p(x + m)
    if p.field != QQ or any(shifted[k] for k in range(1, n)):
        return []
    b = QQ.rational_value(-shifted[0]) or 0
    # x^n - |b| has an irreducible factor x^k - r, r > 0 [Capelli].
    binomials = (q for q, _ in QQ.factor(x**n - max(b, -b)) if not any(q[k] for k in range(1, q.degree)))
    positive = next(q for q in binomials if (QQ.rational_value(q[0]) or 0) < 0)
    root = -positive[0] if positive.degree == 1 else AlgebraicField(QQ, positive).generator
    units = [q for q, _ in QQ.factor(x**n - (1 if b > 0 else -1))]
    scaled = (root.field.poly([c * root ** (q.degree - k) for k, c in enumerate(q)]) for q in units)
    return [q(root.field.x - m) for q in scaled] if len(units) > 1 else []


def _is_the_smaller_root(field: AlgebraicField) -> bool:
    """True if the root meant, of a quadratic polynomial, is the one below the middle of both (or below the real axis)."""
    real, imaginary = field.approximation or (0, 0)
    middle = field.base.rational_value(field.modulus[1])
    if imaginary or middle is None or field.approximation is None:
        return imaginary < 0
    return real < -middle / 2


def display(y: Product, atoms: Atoms, *, around_zero: bool = False) -> Expr:
    """A product up to a constant factor."""
    return Mul(*_shown(y, merged(y), atoms, around_zero=around_zero)[1])


def factors(
    y: Product, atoms: Atoms, extra: RatFunc | None = None, *, like: Product | None = None
) -> tuple[Expr, list[Expr]]:
    """(c, factors): y * extra is c times the product of the factors, merged and grouped (`kovacic.closed_form.product`)."""
    found = merged(y, extra, like=like)
    turned, shown = _shown(y, found, atoms, around_zero=True)
    scale: Expr = Mul(*(Integer(-1) ** index for index in turned))
    for factor in found:
        content = atoms.cleared(factor.base)[0]
        if content != 1:  # by the root with which `root_of` is written
            scale = scale * atoms.sqrt(content.inverse()) ** (-2 * atoms.constant(factor.exponent))
    return scale, shown


def _shown(y: Product, found: list[Factor], atoms: Atoms, *, around_zero: bool) -> tuple[list[Expr], list[Expr]]:
    """The exponents of the bases written with the opposite sign, and the factors of a product without their contents."""
    turned: list[Expr] = []
    shown: list[Expr] = []
    for group, exponent in grouped_factors(found):
        index = atoms.constant(exponent)
        if index.is_Integer:  # without a root
            shown += [atoms.primitive(base)[1] ** index for base in group]
            continue
        turned += [index for base in group if atoms.is_turned(base, around_zero=around_zero)]
        shown.append(Mul(*(atoms.base(base, around_zero=around_zero) for base in group)) ** index)
    inner = []  # of the exponential function
    for residue in y.roots:
        roots = atoms.real_roots(residue.factor)
        shown += [(atoms.x - a) ** sympy.expand_mul(atoms.poly(residue.value, a)) for a in roots]
        if not roots:
            inner.append(atoms.log_sum(residue))
    has_sums = bool(inner)
    if y.exponential.num.degree > 0 or not y.exponential.is_polynomial:
        inner.append(atoms.sum(y.exponential))
    return turned, [*shown, exp(Add(*inner), evaluate=has_sums or not inner)]
