"""Parts of the solutions as SymPy expressions: y = G u(f)/sqrt(f'), G the gauge factor, u a solution of the standard equation.

Powers and exponentials with exponents in the field are gathered in one product; the others, whose exponents are a `Surd`
with square roots, are kept separately (`WrittenFactor`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial, reduce
from operator import mul
from typing import Any, Protocol

import sympy
from sympy import Mul, exp
from sympy.polys.polyerrors import HeuristicGCDFailed
from sympy.polys.polytools import parallel_poly_from_expr

from kovacic.algebra.extension import root_of_constant
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.closed_form.atoms import Atoms, Expr, antiderivative_parameters, display, hypergeometric
from kovacic.closed_form.product import Power, Product, product
from kovacic.numbers.exact import radical
from kovacic.special.maps import HALF, Surd


@dataclass(frozen=True)
class WrittenFactor:
    """The factors before the special function: a product over the field, and factors with irrational exponents."""

    product: Product
    others: tuple[Expr, ...]

    @property
    def size(self) -> int:
        return len(self.product.powers) + len(self.product.roots) + bool(self.product.exponential) + len(self.others)


@dataclass(frozen=True)
class WrittenPair:
    """Two solutions, with facts about them that hold for all values of the letters; iterating gives y1 and y2.

    Attributes
    ----------
    y1, y2 : sympy.Expr
        The solutions.
    wronskian : sympy.Expr or None
        y1 y2' - y1' y2, or None if no closed form is known.
    undefined : tuple of sympy.Expr
        One of the solutions is undefined wherever one of these is zero.
    place : sympy.Expr or None
        A number at which both are real, if one was sought.
    """

    y1: Expr
    y2: Expr
    wronskian: Expr | None = field(default=None, compare=False, repr=False)
    undefined: tuple[Expr, ...] = ()
    place: Expr | None = None

    def __iter__(self) -> Iterator[Expr]:
        return iter((self.y1, self.y2))

    def mapped(self, function: Callable[[Expr], Expr]) -> WrittenPair:
        """All expressions mapped.

        Parameters
        ----------
        function : callable
            From an expression to one, as a substitution of letters.

        Returns
        -------
        WrittenPair
            The pair of the images.
        """
        W = self.wronskian and function(self.wronskian)
        return WrittenPair(function(self.y1), function(self.y2), W, tuple(map(function, self.undefined)), self.place)


#: Powers and exponentials, and the special function that they are multiplied with.
WrittenTerm = tuple[WrittenFactor, Expr]


@dataclass(frozen=True)
class Wanted:
    """The equation whose solutions are written, those of y'' = S y times exp(int gauge dx), and how.

    `symbols` maps names of parameters to SymPy's symbols, in which solutions are written, and whose assumptions are used: with
    a natural n, Hermite's equation has `hermite(n, x)`.  With `joined`, solutions are analytic at ordinary points where the
    argument of Bessel's functions is zero: series 0F1 instead of these.  Solutions are real at one of the `places`, values of
    the variable, if possible, and those of Gauss' equation are series at the `centre`, a singular point.
    """

    S: RatFunc
    gauge: RatFunc
    variable: str
    symbols: Mapping[str, Any] = field(default_factory=dict)
    joined: bool = False
    places: Sequence[Fraction] = ()
    centre: Fraction | None = None


class Combined(Protocol):
    """sqrt(m) (a v + b v'): what a `pullback.GaugeTransform` makes of v; `factor` is that of the Wronskian."""

    @property
    def m(self) -> Poly: ...

    @property
    def a(self) -> RatFunc: ...

    @property
    def b(self) -> RatFunc: ...

    @property
    def factor(self) -> RatFunc: ...


class Writer:
    """Writes the solutions that are `wanted`, or a v + b v' for these with a gauge transformation.

    With `singular`, the denominator of S, solutions are analytic wherever it isn't zero, even at zeros of f.
    """

    def __init__(self, wanted: Wanted, transform: Combined | None = None) -> None:
        self.wanted = wanted
        self.gauge = wanted.gauge
        self.places = wanted.places
        self.centre = wanted.centre
        self.singular = wanted.S.den if wanted.joined else None
        self.transform = transform
        x = sympy.Symbol(wanted.variable)
        self.atoms = Atoms(x)
        self.real = Atoms(x, at=sympy.Rational(self.places[0])) if self.places else self.atoms
        self.symbols = {sympy.Symbol(name): symbol for name, symbol in wanted.symbols.items()}
        self.known = self.symbols
        self._squares: list[Poly] = []
        self._shown: dict[Surd | Poly, Expr] = {}
        self._natural: dict[Surd, bool] = {}

    @property
    def own(self) -> dict[Expr, Expr]:
        """The user's symbols, which carry assumptions, by the plain ones used in computations."""
        return {plain: symbol for plain, symbol in self.symbols.items() if plain != symbol}

    def assuming(self, value: Expr) -> Writer | None:
        """A writer that knows the value to be natural: a symbol of an integer is written by that; None without one.

        >>> n, m = sympy.symbols("n m", integer=True, positive=True)
        >>> zero = RatFunc(QQ.poly([0]))
        >>> Writer(Wanted(zero, zero, "x", {"n": n, "m": m})).assuming(sympy.Symbol("n") - sympy.Symbol("m")).known
        {n: _d + m, m: m}
        """
        value = sympy.expand(value)
        slopes = {plain: value.diff(plain) for plain in sorted(self.symbols, key=str)}
        for slope in (1, -1):
            for plain in (plain for plain in slopes if slopes[plain] == slope and self.symbols[plain].is_integer):
                natural = sympy.Dummy("d", integer=True, nonnegative=True)
                meaning = sympy.expand(plain + (natural - value) / slope).xreplace(self.symbols)
                writer = Writer(self.wanted)
                writer.known = {**self.symbols, plain: meaning}
                return writer
        return None

    def factor(
        self, f: RatFunc, powers: Sequence[tuple[Surd, RatFunc]], exponent: tuple[Surd, RatFunc] | None = None
    ) -> WrittenFactor:
        """G/sqrt(f') times the powers of rational functions, times the exponential of a multiple of one."""
        slope = f.derivative()
        rate = self.gauge - slope.derivative() / slope * HALF
        others: list[Expr] = []
        for number, base in powers:
            rate = rate + base.derivative() / base * number.part
            if number.roots:
                e = self.constant(Surd(number.part * 0, number.roots))
                others += [self.atoms.base(p, around_zero=False) ** (k * e) for p, k in base.multiplicities]
        if exponent is not None:
            number, function = exponent
            rate = rate + function.derivative() * number.part
            if number.roots:
                others.append(exp(self.constant(Surd(number.part * 0, number.roots)) * self.argument(function)))
        return WrittenFactor(product(rate), tuple(others))

    def pair(
        self,
        first: WrittenTerm,
        second: WrittenTerm,
        bracket: Expr | None = None,
        undefined: Iterable[Surd] = (),
        *,
        real_at: Expr | None = None,
    ) -> WrittenPair:
        """The solutions P1 F1 and P2 F2, the one with fewer factors first.

        `bracket` is (P2'/P2 - P1'/P1) F1 F2 + F1 F2' - F1' F2, which doesn't change with constant factors of P1 and P2:
        times P1 P2 it is the Wronskian.  A member has no value where one of the numbers `undefined` is an integer.
        With `real_at` the powers are real at that point, or at the first of the places.
        """
        at = self.real.at if self.places else real_at
        atoms = Atoms(self.atoms.x, at=at)
        members = [self._member(*term, atoms) for term in (first, second)]
        is_turned_round = self.transform is None and second[0].size < first[0].size
        (y, C), (z, D) = members[::-1] if is_turned_round else members
        W = None
        if bracket is not None and C is not None and D is not None:
            scale = -1 if is_turned_round else 1
            if self.transform is not None:
                scale *= self.atoms.factored(self.transform.factor / self.transform.m)
            others, rational = _by_rationality(C * D * scale, self.atoms.x)
            W = others * sympy.factor(rational) * bracket
        # An antiderivative shows its poles itself, and with the elementary member it has a Wronskian without series.
        shows_poles = any(isinstance(F, sympy.hyper) and antiderivative_parameters(F) for _, F in (first, second))
        numbers = () if shows_poles else map(self.constant, filter(self.has_letters, undefined))
        place = at if at is not None and at.is_number else None
        return WrittenPair(y, z, W, tuple(map(_sine_of_letters, numbers)), place)

    def _member(self, before: WrittenFactor, function: Expr, atoms: Atoms) -> tuple[Expr, Expr | None]:
        """A solution, and the factor before its function, or None if that isn't known."""
        if self.transform is not None:
            return self._combined(self.transform, before, function, atoms)
        powers = Mul(display(before.product, atoms), *before.others)
        if atoms.at is not None and before.others:
            powers = _real_at(powers, atoms.x, atoms.at)
        return powers * function, powers

    def _combined(
        self, transform: Combined, before: WrittenFactor, function: Expr, atoms: Atoms
    ) -> tuple[Expr, Expr | None]:
        """P sqrt(m) ((a + b P'/P) F + b F') over a constant c for v = P F, F' = s F + t F1, F1 another function; P sqrt(m)/c.

        Over Q the powers are joined, unless there are roots of numbers among them, and c, a number, isn't known.
        """
        x = self.atoms.x
        b = self.atoms.ratio(transform.b)
        rate = self.atoms.ratio(transform.a + transform.b * (before.product.logarithmic_derivative - self.gauge))
        rate += b * sympy.Add(*(sympy.diff(sympy.log(other), x) for other in before.others))
        s, t, root, other = _derivative(function, x)
        of_F = _in_lowest_terms(rate + b * s)
        of_other = _in_lowest_terms(b * t) or of_F  # F1 = 0
        n, d = sympy.fraction(sympy.together(_in_lowest_terms(of_F / of_other)))
        total = before.product.logarithmic_derivative + logarithmic_derivative(transform.m) / 2
        bracket = n * function + d * root * other
        shared = sympy.factor(of_other / d).as_independent(x, as_Add=False)[1]
        parts = [sympy.Poly(part, x) for part in shared.as_numer_denom()]
        if total.field == QQ and all(c.is_Rational for part in parts for c in part.all_coeffs()):
            for part, sign in zip(parts, (1, -1), strict=True):
                p = QQ.poly([*map(to_fraction, reversed(part.all_coeffs()))])
                total = total + logarithmic_derivative(p) * sign
            return Mul(display(product(total), atoms), *before.others, bracket), None
        powers = Mul(display(product(total), atoms), *before.others)
        others, rational = _by_rationality(powers, x)
        c, common = sympy.factor(of_other / d * rational).as_independent(x, as_Add=False)
        return Mul(others, common, bracket), powers / c

    # ------------------------------------------------------------------------------------- constants

    def square_root(self, square: Poly) -> Surd:
        """A square root, in the field or as a multiple of an earlier one where that is possible; never with a minus sign."""
        zero = square * 0
        inside = square.field.sqrt(square)
        if inside is not None:
            return Surd(self._without_sign(inside))
        for known in self._squares:
            ratio = square.field.sqrt(square / known)
            if ratio is not None:
                return Surd(zero, ((known, self._without_sign(ratio)),))
        self._squares.append(square)
        return Surd(zero, ((square, zero + 1),))

    def _without_sign(self, value: Poly) -> Poly:
        return -value if self.is_negative(value) else value

    def constant(self, value: Surd | Poly) -> Expr:
        if value not in self._shown:
            if isinstance(value, Surd):
                roots = [self.constant(c) * radical(self.constant(square)) for square, c in value.roots]
                shown = sympy.Add(self.constant(value.part), *roots)
            else:
                shown = self.atoms.constant(value)
                if value.field.height and value.field.ground != QQ:
                    shown = sympy.cancel(shown)
            self._shown[value] = shown
        return self._shown[value]

    def is_integer(self, value: Surd) -> bool:
        """True if the value is provably an integer."""
        return bool(self.constant(value).xreplace(self.known).is_integer)

    def has_letters(self, value: Surd) -> bool:
        """True if the value depends on parameters."""
        return bool(self.constant(value).free_symbols)

    def is_natural(self, value: Surd) -> bool:
        """True if the value is provably a nonnegative integer."""
        if value not in self._natural:
            shown = self.constant(value)
            self._natural[value] = any(
                _is_provably_natural(shown.xreplace(known)) for known in (self.symbols, self.known)
            )
        return self._natural[value]

    def is_degree(self, value: Surd) -> bool:
        """True if the value is provably natural and depends on a parameter."""
        return self.has_letters(value) and self.is_natural(value)

    def is_negative(self, value: Surd | Poly) -> bool:
        """True if the value is negative, or has an unknown sign and would be written with a minus sign."""
        shown = self.constant(value)
        known = shown.xreplace(self.symbols).is_negative
        return bool(shown.could_extract_minus_sign() if known is None else known)

    def root(self, value: Poly, n: int) -> Expr:
        """A square (n = 2) or cubic (n = 3) root, in the field where it has one; a cubic one is real for real values."""
        inside = root_of_constant(value, n)
        if inside is not None:
            return self.constant(inside)
        if n == 3 and self.is_negative(value):
            return -self.root(-value, n)
        return self.atoms.sqrt(value) if n == 2 else radical(self.constant(value), n)

    # ------------------------------------------------------------------------------------- functions

    def argument(self, f: RatFunc) -> Expr:
        """A rational function: a polynomial in full unless it is a multiple of a power, else a fraction of products."""
        is_power = len(f.multiplicities) == 1 and f.num.degree > 1
        return self.atoms.poly(f.num) if f.is_polynomial and not is_power else self.atoms.factored(f)

    def rate(self, f: RatFunc) -> Expr:
        return self.atoms.factored(f.derivative() / f)

    def multiple(self, number: Surd, f: RatFunc) -> Expr:
        """A constant times a rational function."""
        return self.constant(number) * self.argument(f) if number.roots else self.argument(f * number.part)

    def scale(self, f: RatFunc) -> Poly:
        """The constant factor of f for monic factors, each times -1 if it is negative at the first place."""
        turned = sum(k % 2 and self.real.is_turned(p) for p, k in f.multiplicities) if self.places else 0
        return -f.num.lc if turned % 2 else f.num.lc

    def root_of(self, f: RatFunc) -> Expr:
        """A square root of a rational function, by factors, up to its sign."""
        powers = f.multiplicities
        root = Product(tuple(Power(p, p.field.poly([Fraction(k, 2)])) for p, k in powers), (), f * 0)
        contents = [RatFunc(self.atoms.primitive(p)[0]) ** k for p, k in powers]
        return self.root(reduce(mul, contents, RatFunc(self.scale(f))).num, 2) * display(root, self.real)

    def hypergeometric(self, top: Sequence[Surd], bottom: Sequence[Surd], z: Expr) -> Expr:
        above, below = (tuple(self.constant(value) for value in values) for values in (top, bottom))
        return hypergeometric(above, below, z)

    @staticmethod
    def even_and_odd(top: tuple[Expr, ...], odd_top: tuple[Expr, ...], root: Expr, z: Expr) -> tuple[Expr, Expr]:
        """The hypergeometric functions with the lower parameters 1/2, even in a square root of z, and 3/2, times this root."""
        return hypergeometric(top, (sympy.S.Half,), z), root * hypergeometric(odd_top, (sympy.Rational(3, 2),), z)

    @staticmethod
    def by_parity(N: Expr, even: Expr, odd: Expr, value: Expr, slope: Expr) -> tuple[Expr, Expr]:
        """For a polynomial of degree N that is even or odd as N is: the solution of the other parity, and their Wronskian.

        The polynomial is cos(pi N/2) value even + sin(pi N/2) slope odd, where even and odd have 1, 0 and 0, 1 in the middle.
        """
        c = sympy.cos(sympy.pi * N / 2)
        s = sympy.sin(sympy.pi * N / 2)
        return c * odd + s * even, value * c**2 - slope * s**2


def _is_provably_natural(value: Expr) -> bool:
    """True if an expression in the user's symbols is provably natural: a positive integer n is n' + 1 with a natural n'."""
    if not value.is_integer:
        return False
    positive = [symbol for symbol in value.free_symbols if symbol.is_integer and symbol.is_positive]
    lower = {symbol: sympy.Dummy(integer=True, nonnegative=True) + 1 for symbol in positive}
    return bool(sympy.expand(value.xreplace(lower)).is_nonnegative)


def _by_rationality(product: Expr, x: Any) -> tuple[Expr, Expr]:
    """The factors that aren't rational in x, and those that are, in which more may cancel than in SymPy's product."""
    parts = Mul.make_args(product)
    rational = [part for part in parts if part.is_rational_function(x)]
    return Mul(*(part for part in parts if part not in rational)), Mul(*rational)


def _in_lowest_terms(quotient: Expr) -> Expr:
    """`sympy.cancel`, by pseudo-remainders if its heuristic finds no greatest common divisor."""
    n, d = sympy.fraction(sympy.together(quotient))
    try:
        return sympy.cancel(n / d)
    except HeuristicGCDFailed:
        (P, Q), _ = parallel_poly_from_expr((n, d))
        c, P, Q = P.cancel(Q)
        return c * P.as_expr() / Q.as_expr()


def _real_at(factor: Expr, x: Any, point: Expr) -> Expr:
    """With (-u)^e for u^e where u is negative at the point, x (1 - x) for -x (x - 1)."""
    changed = {}
    for p in factor.atoms(sympy.Pow):
        if p.base.has(x) and not p.exp.is_Integer:  # not the root of -i in an exponent
            factors = (-u if u.subs(x, point).is_negative else u for u in Mul.make_args(p.base))
            changed[p] = Mul(*factors) ** p.exp
    return factor.xreplace(changed)


def _sine_of_letters(number: Expr) -> Expr:
    """sin(pi l), which is zero where the number is an integer, for l with letters alone: the number up to integers."""
    rest, letters = number.as_independent(*number.free_symbols, as_Add=True)
    if not rest.is_Integer:
        letters = number
    return sympy.sin(sympy.pi * (-letters if letters.could_extract_minus_sign() else letters))


def _derivative(F: Expr, x: Any) -> tuple[Expr, Expr, Expr, Expr]:
    """(s, t, w, F1) with F' = s F + t w F1: s and t rational functions, w a root of one or 1."""
    rule = _SLOPES.get(F.func)
    if rule is None:
        slope = sympy.diff(F, x)
        if isinstance(F, exp | sympy.Pow) or F.is_Number:
            return slope / F, sympy.S.Zero, sympy.S.One, sympy.S.Zero
        return sympy.S.Zero, sympy.S.One, sympy.S.One, slope
    s, t, other = rule(*F.args)
    z = F.args[-1]
    rate = sympy.cancel(sympy.together(sympy.diff(z, x) / z))
    root = sympy.S.One if z.is_rational_function(x) else z
    return sympy.cancel(s * z * rate), sympy.cancel(t * z / root * rate), root, other


#: s, t and F1 with dF/dz = s F + t F1 for a function F of z, s and t rational in z.
_Slope = tuple[Expr, Expr, Expr]


def _slope_of_bessel(kind: Any, below: int, above: int, nu: Expr, z: Expr) -> _Slope:
    """C' = below C_(nu-1) - (nu/z) C, and C_0' = above C_1, with the signs of this kind [DLMF 10.6, 10.29]."""
    if nu == 0:
        return sympy.S.Zero, sympy.Integer(above), kind(1, z)
    return -nu / z, sympy.Integer(below), kind(nu - 1, z, evaluate=False)


def _slope_of_series(above: Expr, below: Expr, z: Expr) -> _Slope:
    top, bottom = (tuple(sympy.cancel(value + 1) for value in values) for values in (above, below))
    return sympy.S.Zero, Mul(*above) / Mul(*below), hypergeometric(top, bottom, z)


def _slope_of_legendre(nu: Expr, z: Expr) -> _Slope:
    """(z^2 - 1) P_nu' = nu (z P_nu - P_(nu-1))."""
    other = -nu if nu.is_negative else nu - 1  # P_(nu - 1) is P_(-nu)
    return nu * z / (z**2 - 1), -nu / (z**2 - 1), sympy.legendre(other, z)


_SLOPES: dict[Any, Callable[..., _Slope]] = {
    sympy.besselj: partial(_slope_of_bessel, sympy.besselj, 1, -1),
    sympy.bessely: partial(_slope_of_bessel, sympy.bessely, 1, -1),
    sympy.besseli: partial(_slope_of_bessel, sympy.besseli, 1, 1),
    sympy.besselk: partial(_slope_of_bessel, sympy.besselk, -1, -1),
    sympy.airyai: lambda z: (sympy.S.Zero, sympy.S.One, sympy.airyaiprime(z)),
    sympy.airybi: lambda z: (sympy.S.Zero, sympy.S.One, sympy.airybiprime(z)),
    sympy.hyper: _slope_of_series,
    sympy.legendre: _slope_of_legendre,
    # 2 z (1 - z) K' = E - (1 - z) K and 2 z E' = E - K [DLMF 19.4.1, 19.4.2]
    sympy.elliptic_k: lambda z: (-1 / (2 * z), 1 / (2 * z * (1 - z)), sympy.elliptic_e(z)),
    sympy.elliptic_e: lambda z: (1 / (2 * z), -1 / (2 * z), sympy.elliptic_k(z)),
}
