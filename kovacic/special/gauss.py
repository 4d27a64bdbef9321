"""Gauss' hypergeometric equation, with the squares A, B, C of the exponent differences at 0, 1 and infinity.

Pull-backs: f from its fibres over 0, 1 and infinity.

Solutions: with the exponent differences alpha, beta, gamma at 0, 1, infinity, in any order of these points, with any signs,

    u = z^((1-alpha)/2) (1-z)^((1-beta)/2) 2F1((1-alpha-beta-gamma)/2, (1-alpha-beta+gamma)/2; 1-alpha; z).

The second solution has -alpha; where alpha is an integer, it is the one of this kind at 1.  These are independent if no
combination (1 +- alpha +- beta +- gamma)/2 is an integer: a common solution would be elementary.  With the larger exponents
at 0 and at 1 a common solution would be a multiple of a polynomial: they are independent if neither upper parameter is an
integer <= 0.  P_N^(a,b)(1 - 2 z) is a multiple of 2F1(-N, N + a + b + 1; 1 + a; z); the second solution has another
exponent at 0 or at infinity, or, for a = b, the other parity.  For a natural a = b = m it is written as the
associated Legendre function P_(N+m)^m.  K, E and P_nu are written where 2F1 is one of them.

With a = b and letters, the even and the odd solution about the middle of 0 and 1 are entire in the letters, and independent
for all of their values, where P_nu(t) and P_nu(-t) are dependent at each integer nu.

Values, with e0, e1, einf for alpha, beta, gamma:

    2F1(a, b; 1 +- e0; z),      a, b = (1 +- e0 + e1 +- einf)/2,

with 2F1(a, b; 1 + e1; 1 - z) for the lower sign where e0 is an integer.  Where two of the differences are 1/2 (the dihedral
case) the solutions are elementary:

    e1 = einf = 1/2    ((1 + sqrt(1 - z))/2)^(-+e0)
    e0 = e1 = 1/2      sin(einf theta)/(einf sqrt(z)), cos(einf theta),    sin(theta)^2 = z

Reference: DLMF 14.3, 15.4.11-18, 15.10, 18.5, 18.7, 19.5.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, product
from math import nan
from typing import TYPE_CHECKING, Any, ClassVar

from flint import acb, fmpq, fmpq_poly

from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.closed_form.structure import PLACES, Covariants
from kovacic.compatibility import cached_property
from kovacic.decision import Structure
from kovacic.engine.places import Problem, analyse, rational_square_root
from kovacic.equation import over
from kovacic.special import prices
from kovacic.special.maps import HALF, Orbit, Surd, coverings, regular_points
from kovacic.special.pullback import (
    Pullback,
    StandardEquation,
    StandardForm,
    StandardSolution,
    StandardSolutions,
    ValueAndSlope,
    each,
    ends,
    is_integer,
    root_or_ball,
)

if TYPE_CHECKING:
    from kovacic.closed_form.atoms import Expr
    from kovacic.special.writer import Writer, WrittenFactor, WrittenPair, WrittenTerm


#: Of places between 0 and 1, in this order.
_PLACE_DENOMINATORS = (1, 2, 10, 100, 10**4, 10**8)
#: Points at which solutions are tested for realness.
_SAMPLE = (Fraction(2, 7), Fraction(7, 2), Fraction(-2, 7))


@dataclass(frozen=True)
class Gauss(StandardEquation):
    """S0 = (A - 1)/(4 z^2) + (B - 1)/(4 (z-1)^2) + (1 - A - B + C)/(4 z (z-1))."""

    A: Poly
    B: Poly
    C: Poly

    searched: ClassVar[str] = (
        "Gauss' hypergeometric equation in f(x), f rational, all points singular over two of 0, 1 and infinity"
    )
    irregular: ClassVar[bool] = False
    name = "Gauss'"

    @property
    def S(self) -> RatFunc:
        z = self.A.field.x
        w = z - 1
        A, B, C = self.A, self.B, self.C
        return RatFunc(w * w * (A - 1) + z * z * (B - 1) + z * w * (1 - A - B + C), z * z * w * w * 4)

    @classmethod
    def candidates(cls, problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
        different = [place.factor for place in problem.places if place.delta_squared is None]
        if different:
            if extended and different[0].degree == 2:  # conjugate places are separated over a larger field
                S = over(problem.S, AlgebraicField(problem.field, different[0]))
                yield from cls.candidates(analyse(S, problem.budget), extended=extended)
            return
        points, apparent = (regular_points(problem, apparent=flag) for flag in (False, True))
        if shifted:
            yield from _shifted(points, apparent)
            return
        yield from (Pullback(Gauss(*squares), f) for f, *squares in coverings(points, apparent))

    def written(self, writer: Writer, f: RatFunc) -> WrittenPair | None:
        forms = _GaussForm.of(self, writer, f).arranged
        first = forms[0]
        signed_forms = [signed for form in forms for signed in form.signs]
        has_letters = any(map(writer.has_letters, (first.alpha, first.beta, first.gamma)))
        if has_letters:
            polynomial = next((form for form in signed_forms if form.has_polynomial), None)
            if polynomial is not None:
                return _with_polynomial(polynomial)
        reducible = any(writer.is_integer(form.degree) for form in first.signs)
        central = next((form for form in forms if form.is_central and form.is_between), None)
        if central is not None and not reducible:
            is_log = writer.is_integer(central.alpha)
            return _at_two_points(central.regular, central.swapped.regular) if is_log else _at_one_point(central)
        if has_letters:
            even = next((form for form in signed_forms if form.alpha == form.beta and form.is_between), None)
            if even is not None:
                return _by_parity(even)  # independent for all values of the letters
            for form in forms:  # P_nu and Q_nu beyond 1
                has_integers = writer.is_integer(form.alpha) and writer.is_integer(form.gamma)
                if form.is_between and writer.has_letters(form.beta) and has_integers:
                    decaying = form.swapped if writer.is_negative(form.beta) else form.swapped.turned
                    return _at_two_points(form.regular, decaying)
        if reducible:
            return _reducible_pair(writer, forms)
        if not writer.is_integer(first.alpha):
            return _at_one_point(first)
        return _at_two_points(first.regular, first.swapped.regular)

    def integers(self, writer: Writer, f: RatFunc) -> Iterator[Surd]:
        """Degrees of polynomials, and the exponent differences."""
        given = _GaussForm.of(self, writer, f)
        for form in given.arranged:
            yield from (signed.degree for signed in form.signs if writer.is_natural(-signed.alpha))
        yield from (given.alpha, given.beta, given.gamma)

    @property
    def parameters(self) -> list[fmpq]:
        return self.constants

    @property
    def cost(self) -> prices.Cost:
        is_dihedral = self.parameters.count(fmpq(1, 4)) > 1
        return prices.GAUSS_DIHEDRAL if is_dihedral else prices.GAUSS

    def coordinate(self, n: Any, d: Any) -> int:
        """The smallest of z, 1 - z, 1/z, ...: there z is between 0 and 1/2 where f is real."""
        sizes = [(abs(acb(top / bottom)), k) for k, (top, bottom, *_) in enumerate(_maps(n, d, 0, 0, 0)) if bottom != 0]
        return min(sizes, key=lambda item: float(item[0]))[1]

    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        return _values(_maps(n, d, *map(root_or_ball, self.parameters))[coordinate])


def klein_pullback(found: Covariants) -> Pullback:
    """The pull-back of the equation with the exponent differences nu, 1/3, 1/2 at 0, 1, infinity by the absolute invariant."""
    field = found.J.field
    nu = Fraction(1, 5 if found.structure is Structure.ICOSAHEDRAL else 4)
    squares = [field.poly([difference**2]) for difference in (nu, Fraction(1, 3), HALF)]
    return Pullback(Gauss(*squares), found.J)


def _shifted(points: list[Orbit], apparent: list[Orbit]) -> Iterator[Pullback]:
    """For exponent differences that are the same up to signs and integers: those between 0 and 1, and those of S."""
    hidden = sum(point.degree for point in apparent)  # ramification points of f may be among apparent ones
    for chosen in chain(product(*map(_reduced_differences, points)), [points]):
        for f, *squares in coverings(list(chosen), [], hidden):
            yield Pullback(Gauss(*squares), f)
            # Contiguous functions have sums of all three that differ by even integers.
            for k, square in enumerate(squares):
                root = square.field.sqrt(square)
                if root is not None:
                    moved = [*squares[:k], (root - 1) ** 2, *squares[k + 1 :]]
                    yield Pullback(Gauss(*moved), f)


def _reduced_differences(point: Orbit) -> list[Orbit]:
    """With the differences from 0 to 1 that are the same up to sign and integers, the smaller one first."""
    delta = rational_square_root(point.square)
    if delta is None:
        return [point]
    near = abs(delta - round(delta))
    values = [near, 1 - near] if near else [near]
    return [replace(point, square=point.square * 0 + value**2) for value in dict.fromkeys(values)]


# ------------------------------------------------------------------------------------------ written


@dataclass(frozen=True)
class _GaussForm:
    """f with the exponent differences at its zeros, at its ones and at its poles."""

    writer: Writer
    f: RatFunc
    alpha: Surd
    beta: Surd
    gamma: Surd

    @classmethod
    def of(cls, equation: Gauss, writer: Writer, f: RatFunc) -> _GaussForm:
        return cls(writer, f, *(writer.square_root(v) for v in (equation.A, equation.B, equation.C)))

    @property
    def arranged(self) -> list[_GaussForm]:
        """The points 0, 1 and infinity in all orders, the preferred one first."""
        orders = _maps(self.f.num, self.f.den, self.alpha, self.beta, self.gamma)
        forms = [_GaussForm(self.writer, RatFunc(n, d), *differences) for n, d, *differences in orders]
        return sorted(forms, key=lambda form: form.cost)

    @property
    def signs(self) -> Iterator[_GaussForm]:
        """The forms with all signs of the differences."""
        for s, t, u in product((1, -1), repeat=3):
            yield _GaussForm(self.writer, self.f, s * self.alpha, t * self.beta, u * self.gamma)

    @property
    def has_polynomial(self) -> bool:
        """True if a polynomial of symbolic degree has exponents that are known to be the larger ones, or no integers."""
        writer = self.writer
        return writer.is_degree(self.degree) and all(
            writer.is_natural(-value) or not writer.is_integer(value) for value in (self.alpha, self.beta)
        )

    @property
    def turned(self) -> _GaussForm:
        """The form with -alpha."""
        return replace(self, alpha=-self.alpha)

    @cached_property
    def factor(self) -> WrittenFactor:
        """The powers, and what belongs to the pull-back."""
        powers = [((1 - self.alpha) * HALF, self.f), ((1 - self.beta) * HALF, self.f - 1)]
        return self.writer.factor(self.f, powers)

    @property
    def shorter(self) -> _GaussForm:
        """The solution u with fewer factors, by the sign of beta [DLMF 15.8.1]; a polynomial stays unchanged."""
        if self.has_polynomial:
            return self
        forms = [replace(self, beta=sign * self.beta) for sign in (1, -1)]
        return min(forms, key=lambda form: form.factor.size)

    def line_at(self, value: Fraction) -> Expr | None:
        """The x with f = value, where f is a polynomial of degree 1."""
        num = self.f.num
        if not self.f.is_polynomial or num.degree != 1:
            return None
        return self.writer.constant((value - num[0]) / num[1])

    @cached_property
    def between(self) -> Expr | None:
        """An x with 0 < f < 1: f = 1/2 of a line, else one of `PLACES` or near one with f = 1/2; None over other fields."""
        import sympy

        place = self.line_at(HALF)
        middle = 2 * self.f.num - self.f.den
        if place is not None or not isinstance(middle, RationalPoly):
            return place
        halves = [zero.real for zero, _ in complex_zeros(middle.rep.numer()) if zero.imag == 0]
        near = (Fraction(float(zero)).limit_denominator(most) for zero in halves for most in _PLACE_DENOMINATORS)
        inside = (sympy.Rational(x) for x in chain(PLACES, near) if 0 < (self._at(x) or 0) < 1)
        return next(inside, None)

    def _at(self, x: Fraction) -> Fraction | float | None:
        """The value of f at a place, or None if it contains letters; NaN at a pole, which is neither above nor below 1."""
        den = self.f.den(x)
        return self.f.field.rational_value(self.f.num(x) / den) if den else nan

    @property
    def inside(self) -> Expr | None:
        """A place over Q where 2F1(f) is real, with 0 < f < 1 if it can be; f = 1/2 of a line, but f = -1/2 of -c x."""
        import sympy

        is_turned = not self.f.num[0] and self.writer.is_negative(self.f.num.lc)
        below = (sympy.Rational(x) for x in PLACES if (self._at(x) or 0) < 0)
        turned = self.line_at(-HALF) if is_turned else None
        return next((place for place in (turned, self.between, *below) if place is not None), None)

    @property
    def term(self) -> WrittenTerm:
        """u, or a multiple."""
        return self.factor, _named_function(self)[1]

    def bracket(self, other: _GaussForm, W: Expr) -> Expr:
        """The bracket of u and the solution of another form in f, or in 1 - f, whose Wronskian in z = f is W."""
        writer = self.writer
        alpha, beta = (other.alpha, other.beta) if other.f == self.f else (other.beta, other.alpha)
        at_zero, at_one = (
            writer.constant((e + d - 2) * HALF) for e, d in ((self.alpha, alpha), (self.beta, beta))
        )  # minus the sums of the exponents
        z, w = writer.argument(self.f), writer.argument(1 - self.f)
        multiple = _named_function(self)[0] * _named_function(other)[0]
        return W * multiple * z**at_zero * w**at_one * z.diff(writer.atoms.x)

    def bracket_of_parity(self, W: Expr = 1) -> Expr:
        """The bracket of solutions with the Wronskian W in t = 1 - 2 f at t = 0, and the factors of the even and odd ones."""
        writer = self.writer
        t = writer.argument(1 - 2 * self.f)
        square = writer.argument(4 * self.f * (1 - self.f))  # 1 - t^2
        return W * square ** writer.constant(self.alpha - 1) * t.diff(writer.atoms.x)

    @property
    def swapped(self) -> _GaussForm:
        """The form with 0 and 1 exchanged."""
        return _GaussForm(self.writer, 1 - self.f, self.beta, self.alpha, self.gamma)

    @property
    def regular(self) -> _GaussForm:
        """The sign of alpha for which 1 - alpha isn't an integer <= 0, as far as that is known."""
        is_pole = self.writer.is_integer(self.alpha) and not self.writer.is_natural(-self.alpha)
        return self.turned if is_pole else self

    @property
    def upper(self) -> list[Surd]:
        return [(1 - self.alpha - self.beta + sign * self.gamma) * HALF for sign in (-1, 1)]

    @property
    def degree(self) -> Surd:
        """N with a = -N."""
        return (self.alpha + self.beta + self.gamma - 1) * HALF

    @cached_property
    def _values(self) -> list[Fraction | float | None]:
        """f at the places where solutions are to be real."""
        return [self._at(place) for place in self.writer.places or _SAMPLE]

    @property
    def is_between(self) -> bool:
        """True if f is between 0 and 1, or unknown, at one of the places."""
        return any(value is None or 0 < value < 1 for value in self._values)

    @property
    def is_central(self) -> bool:
        """True if f is 0 at the singular point at which limits are given."""
        return self.writer.centre is not None and self._at(self.writer.centre) == 0

    @property
    def cost(self) -> tuple[bool | int | str, ...]:
        """Order of preference: off the cut, polynomials, no integer difference at 0 (unless it is that at 1), short f.

        Solutions at 0 and at 1 are both real where f is between these: at many points, if possible.
        """
        f = self.f
        natural = self.writer.is_integer(self.alpha)
        values = self._values
        real = sum(value is not None and 0 < value < 1 for value in values) if natural else 0
        terms = sum(bool(c) for c in (*f.num, *f.den))
        uneven = natural and self.alpha != self.beta
        is_cut = all(value is not None and value > 1 for value in values)  # of 2F1, at all places
        if natural and not is_cut:
            is_cut = not real if self.writer.places else f.field == QQ and self.between is None
        return is_cut, not f.is_polynomial, uneven, natural, -real, terms, not self.writer.is_negative(f.num.lc), str(f)


def _named_function(form: _GaussForm) -> tuple[Expr, Expr]:
    """c and c 2F1, where it has a name: Jacobi's polynomials, K and E, and Legendre's P_nu, if SymPy keeps it."""
    import sympy

    writer = form.writer
    # For b = -a SymPy would write an associated Legendre function of the order -a, which needn't be an integer.
    if form.has_polynomial and form.alpha not in (form.beta, -form.beta):
        N, a, b = (writer.constant(value) for value in (form.degree, -form.alpha, -form.beta))
        whole = sympy.jacobi(N, a, b, writer.argument(1 - 2 * form.f))
        shown = whole.as_independent(writer.atoms.x, as_Add=False)[1]  # P_N(-z) is (-1)^N times another one
        return sympy.gamma(N + a + 1) / (sympy.gamma(N + 1) * sympy.gamma(a + 1)) * shown / whole, shown
    top = form.upper
    a, b, c = (writer.constant(value) for value in (*top, 1 - form.alpha))
    z = writer.argument(form.f)
    half = sympy.S.Half
    for other, integral in ((half, sympy.elliptic_k), (-half, sympy.elliptic_e)):
        if c == 1 and {a, b} == {half, other}:
            return sympy.pi / 2, integral(z)
    if c == 1 and sympy.expand(a + b) == 1:
        middle = sympy.expand(half - a)  # P_nu is P_(-1-nu)
        degree = (-middle if middle.could_extract_minus_sign() else middle) - half
        degree = sympy.expand(degree)
        # SymPy takes (-1)^nu P_nu(x) for P_nu(-x) if nu isn't a rational number
        P = sympy.legendre(degree, sympy.expand(1 - 2 * z)) if degree.is_integer or degree.is_Rational else None
        if isinstance(P, sympy.legendre):
            return sympy.S.One, P
    return sympy.S.One, writer.hypergeometric(top, (1 - form.alpha,), z)


def _at_one_point(form: _GaussForm) -> WrittenPair:
    """u and the solution with -alpha: their leading terms are z^((1 - alpha)/2) and z^((1 + alpha)/2)."""
    first, second = form.shorter, form.turned.shorter
    bracket = first.bracket(second, form.writer.constant(form.alpha))
    return form.writer.pair(first.term, second.term, bracket, (form.alpha,), real_at=form.inside)


def _at_two_points(form: _GaussForm, other: _GaussForm) -> WrittenPair:
    """u at z = 0 and the one at 1, of Wronskian -gamma(1 - alpha) gamma(1 - beta)/(gamma(a) gamma(b)) [DLMF 15.10.17]."""
    import sympy

    writer = form.writer
    own = replace(form, beta=other.alpha)  # u doesn't depend on the sign of beta
    first, second = form.shorter, other.shorter
    a, b, alpha, beta = map(writer.constant, (*own.upper, own.alpha, own.beta))
    W = -sympy.gamma(1 - alpha) * sympy.gamma(1 - beta) / (sympy.gamma(a) * sympy.gamma(b))
    return writer.pair(first.term, second.term, first.bracket(second, W), (form.alpha,), real_at=form.between)


def _reducible_pair(writer: Writer, forms: list[_GaussForm]) -> WrittenPair | None:
    """Where the assumptions make the equation reducible; None if it isn't known which pair is independent."""
    free = next((form for form in forms if not writer.is_integer(form.alpha)), None)
    if free is not None:
        return _at_one_point(free)
    signed_forms = [signed for form in forms for signed in form.signs]
    even = next((form for form in signed_forms if form.alpha == form.beta), None)
    if even is not None:
        return _by_parity(even)
    for form in signed_forms:  # the larger exponents at 0 and at 1, and no polynomial
        are_natural = writer.is_natural(-form.alpha) and writer.is_natural(-form.beta)
        if are_natural and all(writer.is_natural(a - 1) or not writer.is_integer(a) for a in form.upper):
            return _at_two_points(form, form.swapped)
    return None


def _with_polynomial(form: _GaussForm) -> WrittenPair:
    """P_N^(a,b)(1 - 2 f) with a = -alpha, b = -beta, and a second solution."""
    writer = form.writer
    if form.alpha == form.beta:
        return _gegenbauer_pair(form)
    if writer.is_integer(form.alpha):  # at infinity the polynomial has the exponent -N, and this one N + 1 + a + b
        second = _GaussForm(writer, 1 / form.f, -form.gamma, form.beta, form.alpha).shorter
        return writer.pair(form.term, second.term)
    return _at_one_point(form)


def _gegenbauer_pair(form: _GaussForm) -> WrittenPair:
    """C_N^(l)(1 - 2 f), l = 1/2 - alpha, or a multiple of it, and the solution of the other parity."""
    import sympy

    writer = form.writer
    N, a = (writer.constant(value) for value in (form.degree, -form.alpha))
    t = writer.argument(1 - 2 * form.f)
    # C(0) = cos(pi N/2) gamma(l + N/2)/(gamma(l) gamma(N/2 + 1)), C'(0) = 2 l C_(N-1)^(l+1)(0)  [DLMF 18.5.10, 18.9.19]
    index = a + sympy.S.Half
    even_value = sympy.gamma(index + N / 2) / sympy.gamma(N / 2 + 1)
    slope = 2 * sympy.gamma(index + (N + 1) / 2) / sympy.gamma((N + 1) / 2)
    (_, even), (_, odd) = _even_and_odd(form)
    other, W = writer.by_parity(N, even, odd, even_value, slope)
    second = form.factor, other
    if writer.is_natural(form.alpha - HALF):  # Gegenbauer's polynomials of an index 0, -1, ... are 0
        return writer.pair(form.term, second)
    bracket = form.bracket_of_parity(W / sympy.gamma(index))
    before = form.factor
    polynomial = sympy.gegenbauer(N, index, t)
    if a and writer.is_natural(-form.alpha):
        # P_(N+m)^m = (-1)^m (2 m)!/(2^m m!) (1 - t^2)^(m/2) C_N^(m + 1/2)  [DLMF 14.6.1, 18.9.19]
        polynomial = sympy.assoc_legendre(sympy.expand(N + a), a, t)
        before = replace(form, alpha=form.alpha * 0, beta=form.beta * 0).factor
        scale = (-1) ** a * sympy.factorial(2 * a) / (2**a * sympy.factorial(a))
        bracket *= scale * writer.argument(4 * form.f * (1 - form.f)) ** (a / 2)
    shown = polynomial.as_independent(writer.atoms.x, as_Add=False)[1]  # P_N(-z) is (-1)^N P_N(z)
    return writer.pair((before, shown), second, bracket * shown / polynomial)


def _by_parity(form: _GaussForm) -> WrittenPair:
    """Both, with powers that are real between the two points, or at 0."""
    import sympy

    return form.writer.pair(*_even_and_odd(form), form.bracket_of_parity(), real_at=form.line_at(HALF) or sympy.S.Zero)


def _even_and_odd(form: _GaussForm) -> tuple[WrittenTerm, WrittenTerm]:
    """The even and the odd solution in 1 - 2 f, for alpha = beta."""
    writer = form.writer
    t = writer.argument(1 - 2 * form.f)
    N = writer.constant(form.degree)
    index = writer.constant(HALF - form.alpha)
    even, odd = writer.even_and_odd((-N / 2, N / 2 + index), ((1 - N) / 2, (1 + N) / 2 + index), t, t**2)
    return (form.factor, even), (form.factor, odd)


# ------------------------------------------------------------------------------------------ values


def _maps(n: Any, d: Any, e0: Any, e1: Any, e2: Any) -> list[tuple[Any, Any, Any, Any, Any]]:
    """z = n/d, 1 - z, 1/z, z/(z - 1), 1/(1 - z) and (z - 1)/z, with what belongs to their points 0, 1 and infinity."""
    return [
        (n, d, e0, e1, e2),
        (d - n, d, e1, e0, e2),
        (d, n, e2, e1, e0),
        (n, n - d, e0, e2, e1),
        (d, d - n, e2, e0, e1),
        (n - d, n, e1, e2, e0),
    ]


def _values(mapped: tuple[Any, Any, Any, Any, Any]) -> StandardForm:
    """About the point 0 of the coordinate n/d with these exponent differences."""
    half = fmpq(1, 2)
    n, d, e0, e1, e2 = mapped
    if e0 == half == e2:  # in z/(z - 1)
        n, d, e0, e1, e2 = _maps(n, d, e0, e1, e2)[3]
    upper = (1 + e0) / 2
    lower = (1 - e0) / 2
    right = (1 + e1) / 2
    is_dihedral = e1 == half and half in (e0, e2)
    if is_dihedral and e0 != 0:
        solutions = each(_root(e0), _root(-e0)) if e2 == half else _sine_and_cosine(e2)
        return StandardForm(n, d, ((upper, half / 2), (lower, half / 2)), solutions, (None, 1))
    first = _hypergeometric_solution(e0, e1, e2, mirrored=False)
    if not is_integer(e0):
        second = _hypergeometric_solution(-e0, e1, e2, mirrored=False)
        return StandardForm(n, d, ((upper, right), (lower, right)), each(first, second), (None, 1))
    second = _hypergeometric_solution(e1, e0, e2, mirrored=True)
    independent = not any(ends((1 + e0 + e1 + e) / 2) for e in (e2, -e2))
    return StandardForm(n, d, ((upper, right), (upper, right)), each(first, second), (1, 1), independent)


def _root(e: Any) -> StandardSolution:
    """((1 + w)/2)^(-e), w = sqrt(1 - z)."""

    def value(z: acb) -> ValueAndSlope:
        w = (1 - z).sqrt()
        power = (-(e * ((1 + w) / 2).log())).exp()
        return power, power * e / (2 * w * (1 + w))

    return value


def _sine_and_cosine(e: Any) -> StandardSolutions:
    """sin(e theta)/(e sqrt(z)), or theta/sqrt(z) for e = 0, and cos(e theta), with theta' = 1/(2 sqrt(z) sqrt(1 - z))."""

    def values(z: acb, needed: Sequence[bool]) -> list[ValueAndSlope]:
        root = z.sqrt()
        w = (1 - z).sqrt()
        theta = root.asin()
        cosine = (e * theta).cos()
        sine = (theta if e == 0 else (e * theta).sin() / e) / root
        return [(sine, (cosine / w - sine) / (2 * z)), (cosine, -e * e * sine / (2 * w))]

    return values


def _hypergeometric_solution(e0: Any, e1: Any, e2: Any, *, mirrored: bool) -> StandardSolution:
    """2F1 with the exponent differences e0 at 0, e1 at 1, e2 at infinity, in z, or in 1 - z if it is mirrored."""
    a = (1 + e0 + e1 + e2) / 2
    b = (1 + e0 + e1 - e2) / 2
    c = 1 + e0
    # whether a - b and c - a - b are integers, which balls don't show; of a - c and b - c FLINT makes no use
    whole = is_integer(e2), False, False, is_integer(e1)
    first = acb(a)
    second = acb(b)
    third = acb(c)

    def value(z: acb) -> ValueAndSlope:
        w = 1 - z if mirrored else z
        F = w.hypgeom_2f1(first, second, third, False, *whole)
        slope = w.hypgeom_2f1(first + 1, second + 1, third + 1, False, *whole) * first * second / third
        if mirrored:
            slope = -slope
        return F, slope

    return value
