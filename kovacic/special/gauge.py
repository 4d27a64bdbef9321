"""Gauge transformations: y = a v + b v' takes the solutions of v'' = T v to those of y'' = S y exactly if, with D = S - T,

    2 a' = b D - b'',        a'' = a D - 2 b' T - b T';        then  a^2 + a b' - a' b - b^2 T  is constant.            (1)

Targets T are the pull-backs of standard equations that agree with S in what such a transformation keeps: the polar parts of
sqrt(S) at the irregular places, which give f, and the exponent differences up to integers, which give the parameters; apparent
singularities count for nothing.

a and b lie in sqrt(m) K(x), m without squares.  b is a combination of products y_i v_j: at a regular place it has the exponents
1 +- (Delta_S +- Delta_T)/2, of which those count that are in Z/2; their parity tells whether m vanishes there.  At an irregular
place of order k (S = t^-k ...) they are k/2 +- n/2, n/2 the difference of the residues of sqrt(S) and sqrt(T).  a has the
exponent -n/2 where b has k/2 - n/2 (k = 2 at regular places, and k - 4 for k at infinity, where t = 1/x).  So what remains of a
and b are two polynomials of bounded degree: one linear system, which is looked at modulo a prime first.

Reference: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; M. van Hoeij, W. Koepf, S. Yuan, J. Symb. Comp. 2015.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice, product
from math import prod
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_mat, nmod_mat

from kovacic.algebra.factors import dependence
from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.product import product as product_of
from kovacic.engine.places import Kind, Place, Problem, analyse, rational_square_root
from kovacic.limits import count_work
from kovacic.special import fibres
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.polar_parts import (
    integral_of_cubic_root,
    integral_of_square_root,
    irregular_places,
    leading_square,
    scales,
    square,
    unit,
)
from kovacic.special.pullback import TRIAL, Pullback, standard_part
from kovacic.special.whittaker import Whittaker, signs_of

if TYPE_CHECKING:
    from kovacic.closed_form.atoms import Expr
    from kovacic.special.writer import Writer, WrittenFactor, WrittenTerm

#: Unknown coefficients of a and b together, and orders of their poles, up to which the system is set up; with parameters.
_UNKNOWNS = 250
_WITH_PARAMETERS = 40
#: Ramification points of f that may be among the apparent places.
_HIDDEN = 3
#: Sets of exponent differences for which coverings are sought.
_MOST_CHOICES = 32


@dataclass(frozen=True)
class GaugeTransform:
    """y = sqrt(m) (a v + b v'), v a solution of the pulled-back standard equation."""

    pullback: Pullback
    m: Poly
    a: RatFunc
    b: RatFunc

    def gives(self, S: RatFunc) -> bool:
        """Do the identities (1) hold exactly, with a transformation that is invertible?"""
        T = self.pullback.S
        D = S - T
        a, b = self.a, self.b
        L = _half_rate(self.m)
        da, db = a.derivative() + L * a, b.derivative() + L * b
        d2a, d2b = da.derivative() + L * da, db.derivative() + L * db
        first = 2 * da == b * D - d2b
        second = d2a == a * D - 2 * db * T - b * T.derivative()
        return first and second and bool(a * a + a * db - da * b - b * b * T)

    def writer(self, gauge: RatFunc, x: Any, symbols: Mapping[str, Any]) -> Writer:
        """One that writes a v + b v' where the standard equation has it write v."""
        from kovacic.special.writer import Writer

        transform = self

        class GaugedWriter(Writer):
            def pair(self, first: WrittenTerm, second: WrittenTerm, *, around_zero: bool = False) -> tuple[Expr, Expr]:
                y1, y2 = (_combined(transform, self, *term) for term in (first, second))
                return y1, y2

        return GaugedWriter(gauge, x, symbols)


def transforms(problem: Problem) -> Iterator[GaugeTransform]:
    """Those that are found, the likely ones first."""
    tried = set()
    for pullback in _targets(problem):
        T = pullback.S
        if T in tried:
            continue
        tried.add(T)
        problem.budget.check()
        count_work(TRIAL)
        found = _transformation(problem, analyse(T, problem.budget))
        if found is not None:
            yield GaugeTransform(pullback, *found)


# ------------------------------------------------------------------------------------------ targets


def _targets(problem: Problem) -> Iterator[Pullback]:
    """Pull-backs that agree with S in what a gauge transformation keeps."""
    places = irregular_places(problem)
    if not places:
        yield from _gauss(problem)
        return
    if not any((place.order - 2) % 3 for place in places):
        yield from _airy(problem, places)
    if not any(place.order % 2 for place in places):
        yield from _whittaker(problem, places)
    elif all(place.order % 2 for place in places):
        yield from _bessel(problem, places)


def _airy(problem: Problem, places: list[Place]) -> Iterator[Pullback]:
    """The constant of f is the value of S0(f)/q - f at a pole of f."""
    for q in scales(places, lambda place: leading_square(place) * -9, 3):
        parts = [part for place in places if (part := integral_of_cubic_root(place, q)) is not None]
        if len(parts) < len(places):
            continue
        f = sum(parts, RatFunc(q * 0))
        c = _value(standard_part(problem.S, f) / q - f, places[0])
        if c is not None:
            yield Pullback(Airy(q), f + c)


def _whittaker(problem: Problem, places: list[Place]) -> Iterator[Pullback]:
    """kappa as the residues of sqrt(S) say, or the one near 0 that differs from it by an integer."""
    for q in scales(places, lambda place: unit(place, 1), 2):
        parts = [part for place in places if (part := integral_of_square_root(place, q)) is not None]
        if len(parts) < len(places):
            continue
        r = parts[0].residue * q * Fraction(2, parts[0].order)
        for signs in signs_of(parts):
            polar = sum((part.part * sign for part, sign in zip(parts, signs, strict=True)), RatFunc(q * 0))
            for f, square_of_e in _zeros(problem, polar):
                for value in dict.fromkeys([*_near_zero(q, r), r]):
                    yield Pullback(Whittaker(q, value, (square_of_e - 1) * Fraction(1, 4)), f)


def _near_zero(q: Poly, r: Poly) -> Iterator[Poly]:
    """2 sqrt(q) kappa for the kappa between -1/2 and 1/2, where it is rational."""
    root = q.field.sqrt(q)
    kappa = None if root is None else q.field.rational_value(r / (2 * root))
    if root is not None and kappa is not None:
        yield root * (2 * (kappa - round(kappa)))


def _bessel(problem: Problem, places: list[Place]) -> Iterator[Pullback]:
    one = problem.field.poly([1])
    polar = sum((square(place) for place in places), RatFunc(one * 0))
    for f, square_of_e in _zeros(problem, polar):
        yield Pullback(Bessel(one, (square_of_e - 1) * Fraction(1, 4)), f)


def _zeros(problem: Problem, polar: RatFunc) -> Iterator[tuple[RatFunc, Poly]]:
    """f with its constant, and e^2, e the standard equation's exponent difference at 0: k-fold zeros have k e, up to integers.

    The zeros are places with exponents that integers don't explain; without such, critical points of f or apparent places.
    """
    regular = [place for place in problem.places if place.kind is not Kind.ORDINARY and place.order <= 2]
    seen = [place for place in regular if not place.is_apparent]
    for place in seen or regular:
        value = _value(polar, place)
        if value is None or place.delta_squared is None or not polar.derivative():
            continue
        f = polar - value
        multiplicity = -f.degree if place.at_infinity else f.num.remove(place.factor)[1]
        yield from ((f, e_squared) for e_squared in _differences(place.delta_squared, multiplicity))
    if seen:
        return
    slope = polar.derivative().num
    for p, _ in slope.field.factor(slope) if slope.degree > 0 else []:
        if p.degree == 1 and polar.den % p:
            f = polar - polar(RatFunc(-p[0])).num
            yield from ((f, e_squared) for e_squared in _differences(p.field.poly([1]), f.num.remove(p)[1]))


def _value(f: RatFunc, place: Place) -> Poly | None:
    """The value at all points of a place, if it is one and finite."""
    if place.at_infinity:
        if not f or f.degree < 0:
            return f.num * 0
        return f.num.lc / f.den.lc if f.degree == 0 else None
    if not f.den % place.factor:
        return None
    value = f.num * f.den.inverse_modulo(place.factor) % place.factor
    return value if value.degree <= 0 else None


def _differences(square: Poly, k: int) -> Iterator[Poly]:
    """The squares of e with k e = Delta up to sign and integers, of each parity, small ones first."""
    root = square.field.sqrt(square) if square else square
    if root is None:
        yield square * Fraction(1, k * k)
        return
    rational = root.field.rational_value(root)
    centre = 0 if rational is None else round(rational)
    found = [(root - centre + j) * Fraction(1, k) for j in range(-k, k + 1)]
    if rational is not None:
        found.sort(key=lambda e: abs(e.field.rational_value(e) or Fraction(0)))
    yield from (e * e for e in found)


def _gauss(problem: Problem) -> Iterator[Pullback]:
    """Coverings for exponent differences that are the same up to integers: those between 0 and 1, and those of S."""
    places = [place for place in problem.places if place.kind is Kind.REGULAR and not place.is_apparent]
    if sum(place.degree for place in places) < 3 or any(place.delta_squared is None for place in places):
        return
    reduced = [_between_0_and_1(place.delta_squared) for place in places]
    hidden = sum(place.degree for place in problem.places if place.kind is Kind.REGULAR and place.is_apparent)
    choices = islice(product(*reduced), _MOST_CHOICES)
    for squares in dict.fromkeys([*choices, tuple(place.delta_squared for place in places)]):
        model = _with_exponents(problem, places, squares)
        for covering in fibres.coverings(analyse(model, problem.budget), extended=False, hidden=min(hidden, _HIDDEN)):
            parts = (covering.zeros, covering.ones, covering.poles)
            for shifts in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
                shifted = [_shifted(part, n) for part, n in zip(parts, shifts, strict=True)]
                if None not in shifted:
                    yield Pullback(Gauss(*shifted), covering.f)  # type: ignore[arg-type]


def _between_0_and_1(square: Any) -> list[Poly]:
    """The squares of the differences from 0 to 1 that are the same up to sign and integers, the smaller one first."""
    delta = rational_square_root(square)
    if delta is None:
        return [square]
    near = abs(delta - round(delta))
    values = [near, 1 - near] if near else [near]
    return [square * 0 + value**2 for value in dict.fromkeys(values)]


def _shifted(square: Poly, n: int) -> Poly | None:
    """The square of a difference less n."""
    if not n:
        return square
    root = square.field.sqrt(square) if square else square
    return None if root is None else (root - n) ** 2


def _with_exponents(problem: Problem, places: list[Place], squares: Sequence[Any]) -> RatFunc:
    """A function with double poles of these exponent differences at these places, and nowhere else."""
    field = problem.field
    x = field.poly([0, 1])
    radical = field.poly([1])
    S = RatFunc(radical * 0)
    at_infinity = field.poly([1])
    for place, delta_squared in zip(places, squares, strict=True):
        if place.at_infinity:
            at_infinity = delta_squared
        else:
            rate = RatFunc(place.factor.derivative(), place.factor)
            S = S + rate * rate * (delta_squared - 1) * Fraction(1, 4)
            radical = radical * place.factor
    n = radical.degree
    for power, wanted in ((2, (at_infinity - 1) * Fraction(1, 4)), (3, field.poly([]))):
        if power == 3 and (n < 3 or at_infinity != 1):
            break
        known = S.num.lc / S.den.lc if S and S.degree == -power else S.num * 0  # the coefficient of x^-power
        left = wanted - known
        S = S + RatFunc(left * x ** (n - power), radical)
    return S


# ------------------------------------------------------------------------------------------ a and b


@dataclass(frozen=True)
class _Room:
    """A place, and the least orders of b and a there, doubled; both have the parity of m."""

    factor: Poly
    at_infinity: bool
    of_b: int
    of_a: int


def _transformation(problem: Problem, target: Problem) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b; None where there are none."""
    options = _rooms(problem, target)
    if options is None:
        return None
    for rooms in product(*options):
        if sum(room.of_b % 2 * room.factor.degree for room in rooms) % 2:
            continue
        found = _solved(problem.S, target.S, rooms)
        if found is not None:
            return found
    return None


def _rooms(problem: Problem, target: Problem) -> list[list[_Room]] | None:
    """For each place what is possible there; None where something isn't kept."""
    own, other = ({(p.at_infinity, p.factor): p for p in given.places} for given in (problem, target))
    options = []
    for at_infinity, factor in dict.fromkeys([*own, *other]):
        pair = own.get((at_infinity, factor)), other.get((at_infinity, factor))
        order = max(2, *(0 if place is None else place.order for place in pair))
        shifts = _shifts(*pair)
        if not shifts:
            return None
        base = order - 4 if at_infinity else order
        rooms: dict[int, _Room] = {}
        for n in sorted(shifts, reverse=True):
            parities = (base - n, base - n + 1) if order % 2 else (base - n,)
            for of_b in parities:
                of_a = -n + (of_b + n) % 2
                rooms.setdefault(of_b % 2, _Room(factor, at_infinity, of_b, of_a))
        options.append(list(rooms.values()))
    return options


def _shifts(first: Place | None, second: Place | None) -> list[int]:
    """By which integers exponents of y and v differ: at a regular place |Delta_S -+ Delta_T|, else twice the residues'."""
    orders = [0 if place is None else place.order for place in (first, second)]
    if max(orders) > 2:
        if orders[0] != orders[1] or first is None or second is None:
            return []
        return [0] if orders[0] % 2 else _shifts_of_residues(first, second)
    place = first or second
    assert place is not None
    one = place.factor.field.poly([1])
    squares = [one if p is None or p.kind is Kind.ORDINARY else p.delta_squared for p in (first, second)]
    if squares[0] is None or squares[1] is None:
        return [0] if squares[0] is None and squares[1] is None else []
    roots = [value.field.sqrt(value) if value else value for value in squares]
    if roots[0] is None or roots[1] is None:
        return [0] if squares[0] == squares[1] else []
    values = [one.field.rational_value(value) for value in (roots[0] - roots[1], roots[0] + roots[1])]
    return [abs(int(value)) for value in values if value is not None and value.denominator == 1]


def _shifts_of_residues(first: Place, second: Place) -> list[int]:
    for q in scales([second], lambda place: unit(place, 1), 2):
        own = integral_of_square_root(first, q)
        other = integral_of_square_root(second, q)
        if own is None or other is None:
            continue
        if own.part not in (other.part, -other.part):
            return []
        sign = 1 if own.part == other.part else -1
        difference = own.residue - other.residue * sign
        n = rational_square_root(4 * q * difference * difference)
        return [int(n)] if n is not None and n.denominator == 1 else []
    return []


def _solved(S: RatFunc, T: RatFunc, rooms: Sequence[_Room]) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b for these orders: b = sqrt(m) R B and a = sqrt(m) Q A with polynomials A and B."""
    finite = [room for room in rooms if not room.at_infinity]
    # Of Q and of R; the orders of a and b are doubled.
    orders = [
        [(room, (room.of_a - room.of_b % 2) // 2) for room in finite],
        [(room, (room.of_b - room.of_b % 2) // 2) for room in finite],
    ]
    at_infinity = next(room for room in rooms if room.at_infinity)
    odd = sum(room.of_b % 2 * room.factor.degree for room in finite)
    degree_a, degree_b = (
        max(-1, (-least - odd) // 2 - sum(order * room.factor.degree for room, order in found))
        for least, found in zip((at_infinity.of_a, at_infinity.of_b), orders, strict=True)
    )
    size = degree_a + degree_b + 2 + sum(abs(order) * room.factor.degree for found in orders for room, order in found)
    if size > (_UNKNOWNS if S.field == QQ else _WITH_PARAMETERS) or max(degree_a, degree_b) < 0:
        return None
    one = RatFunc(S.field.poly([1]))
    m = prod((room.factor for room in rooms if room.of_b % 2 and not room.at_infinity), start=one.num)
    Q, R = (prod((RatFunc(room.factor) ** order for room, order in found), start=one) for found in orders)
    D = S - T
    L = _half_rate(m)
    of_a = Q.derivative() / Q + L
    of_b = R.derivative() / R + L
    zero = D * 0
    # (1) as coefficients of (A, A', A'') and (B, B', B''), the second of them with 2 b' T + b T' on the left.
    first = [
        [2 * Q * of_a, 2 * Q, zero],
        [R * (of_b.derivative() + of_b * of_b - D), 2 * R * of_b, R],
    ]
    second = [
        [Q * (of_a.derivative() + of_a * of_a - D), 2 * Q * of_a, Q],
        [R * (2 * T * of_b + T.derivative()), 2 * R * T, zero],
    ]
    columns = _columns(first, second, (degree_a, degree_b))
    vector = _null_vector(columns)
    if vector is None:
        return None
    field = S.field
    A = field.poly(vector[: degree_a + 1])
    B = field.poly(vector[degree_a + 1 :])
    return m, Q * A, R * B


def _columns(first: list[list[RatFunc]], second: list[list[RatFunc]], degrees: tuple[int, int]) -> list[Poly]:
    """What each coefficient of A and of B contributes to both equations, without denominators: one behind the other."""
    cleared = [_cleared(equation) for equation in (first, second)]
    width = max(c.degree for row in cleared[0] for c in row) + max(degrees) + 1
    x = first[0][0].field.poly([0, 1])
    columns = []
    for k, degree in enumerate(degrees):
        (c0, c1, c2), (d0, d1, d2) = (equation[k] for equation in cleared)
        for i in range(degree + 1):
            powers = [x ** max(i - j, 0) * factor for j, factor in ((0, 1), (1, i), (2, i * (i - 1)))]
            above = c0 * powers[0] + c1 * powers[1] + c2 * powers[2]
            below = d0 * powers[0] + d1 * powers[1] + d2 * powers[2]
            columns.append(above + below * x**width)
    return columns


def _cleared(equation: list[list[RatFunc]]) -> list[list[Poly]]:
    """The coefficients times the least common multiple of their denominators."""
    den = equation[0][0].field.poly([1])
    for c in (c for row in equation for c in row):
        den = den * (c.den // den.gcd(c.den))
    return [[(c * den).num for c in row] for row in equation]


def _null_vector(columns: list[Poly]) -> list[Poly] | None:
    """Constants, not all 0, for which the sum of the columns vanishes; a prime tells that there are none."""
    height = max(column.degree for column in columns) + 1
    field = columns[0].field
    for h in field.homomorphisms():
        try:
            images = [h(column) for column in columns]
        except BadPrimeError:
            continue
        entries = [int(image[j]) for image in images for j in range(height)]
        if nmod_mat(len(columns), height, entries, h.p).rank() == len(columns):
            return None
        break
    if field != QQ:
        return dependence(columns)
    matrix = fmpq_mat(height, len(columns), [_entry(column, j) for j in range(height) for column in columns])
    basis, nullity = matrix.numer_denom()[0].nullspace()
    return [field.poly([Fraction(int(basis[i, 0]))]) for i in range(len(columns))] if nullity else None


def _entry(column: Poly, j: int) -> fmpq:
    coefficients = column.rational_coefficients()
    return coefficients[j] if j < len(coefficients) else fmpq(0)


def _half_rate(m: Poly) -> RatFunc:
    """The logarithmic derivative of sqrt(m)."""
    return RatFunc(m.derivative(), m) * Fraction(1, 2)


# ------------------------------------------------------------------------------------------ written


def _combined(transform: GaugeTransform, writer: Writer, before: WrittenFactor, function: Expr) -> Expr:
    """a v + b v' for v = P F, P the factor: P sqrt(m) ((a + b P'/P) F + b F'), F' = s F + t F1 with another function F1."""
    import sympy

    from kovacic.closed_form.atoms import display

    x = writer.atoms.x
    ratio = writer.atoms.ratio
    rate = ratio(transform.a + transform.b * (before.product.logarithmic_derivative - writer.gauge))
    rate += ratio(transform.b) * sympy.Add(*(sympy.diff(sympy.log(other), x) for other in before.others))
    s, t, z, other = _derivative(function, x)
    of_F = sympy.cancel(sympy.together(rate + ratio(transform.b) * s))
    of_other = sympy.cancel(sympy.together(ratio(transform.b) * t))
    n, d = sympy.fraction(sympy.cancel(of_F / of_other))
    total = before.product.logarithmic_derivative + _half_rate(transform.m)
    common = sympy.factor(of_other / d).as_independent(x, as_Add=False)[1]
    if total.field == QQ:  # its powers join those of the product
        above, below = (_rational_polynomial(part, x) for part in common.as_numer_denom())
        total = total + RatFunc(above.derivative(), above) - RatFunc(below.derivative(), below)
        common = sympy.S.One
    root = display(product_of(total), writer.atoms)
    return sympy.Mul(root, *before.others, common, n * function + d * z * other)


def _rational_polynomial(expression: Expr, x: Any) -> Poly:
    """A polynomial over Q, from SymPy's."""
    coefficients = expression.as_poly(x).all_coeffs() if expression.has(x) else [expression]
    return QQ.poly([Fraction(int(c.p), int(c.q)) for c in reversed(coefficients)])


def _derivative(F: Expr, x: Any) -> tuple[Expr, Expr, Expr, Expr]:
    """(s, t, w, F1) with F' = s F + t w F1: s and t rational functions, w a root of one or 1."""
    import sympy

    from kovacic.closed_form.atoms import hypergeometric

    z = F.args[-1]
    rate = sympy.cancel(sympy.together(sympy.diff(z, x) / z))
    root, slope = (sympy.S.One, sympy.cancel(rate * z)) if z.is_rational_function(x) else (z, rate)
    if isinstance(F, sympy.besselj | sympy.bessely | sympy.besseli | sympy.besselk):
        # C' = C_(nu-1) - (nu/z) C for J, Y and I, with -K_(nu-1) for K; C_0' = -C_1, and C_1 for I.
        nu = F.args[0]
        if nu == 0:
            return sympy.S.Zero, slope if isinstance(F, sympy.besseli) else -slope, root, F.func(1, z)
        sign = -1 if isinstance(F, sympy.besselk) else 1
        return -nu * rate, sign * slope, root, F.func(nu - 1, z, evaluate=False)
    if isinstance(F, sympy.airyai | sympy.airybi):
        prime = sympy.airyaiprime if isinstance(F, sympy.airyai) else sympy.airybiprime
        return sympy.S.Zero, slope, root, prime(z)
    if isinstance(F, sympy.hyper):
        factor = sympy.Mul(*F.ap) / sympy.Mul(*F.bq)
        if factor != 0:
            above, below = ([value + 1 for value in values] for values in (F.ap, F.bq))
            return sympy.S.Zero, factor * slope, root, hypergeometric(tuple(above), tuple(below), z)
    return sympy.S.Zero, sympy.S.One, sympy.S.One, sympy.diff(F, x)
