"""Gauge transformations: y = a v + b v' takes the solutions of v'' = T v to those of y'' = S y exactly if, with D = S - T,

    2 a' = b D - b'',        a'' = a D - 2 b' T - b T';        then  a^2 + a b' - a' b - b^2 T  is constant.            (1)

So b determines a, and is a solution of one equation of order four, that of the products y_i v_j:

    2 D a = (b D - b'')' + 4 T b' + 2 T' b,        2 a' = b D - b''.                                                   (2)

Targets T are the pull-backs of standard equations that agree with S in what such a transformation keeps: the polar parts of
sqrt(S) at the irregular places, which give f, and the exponent differences up to integers, which give the parameters; apparent
singularities count for nothing.

b lies in sqrt(m) K(x), m without squares.  At a regular place the products have the exponents 1 +- (Delta_S +- Delta_T)/2, of
which those count that are in Z/2; their parity tells whether m vanishes there.  At an irregular place of order k (S = t^-k ...)
they are k/2 +- n/2, n/2 the difference of the residues of sqrt(S) and sqrt(T) (k = 2 at regular places, and k - 4 for k at
infinity, where t = 1/x).  So what remains of b is a polynomial of bounded degree: one linear system, which is looked at modulo
a prime first.

Reference: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; M. van Hoeij, W. Koepf, S. Yuan, J. Symb. Comp. 2015.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product, zip_longest

from flint import fmpq_mat, nmod_mat

from kovacic.algebra.factors import dependence
from kovacic.algebra.factors import product as product_of
from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, Place, Problem, analyse, rational_square_root
from kovacic.limits import count_work
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.maps import half_rate, integral_of_square_root, irregular_places, scales, unit
from kovacic.special.pullback import TRIAL, Pullback, StandardEquation
from kovacic.special.whittaker import Whittaker

#: In the order in which they are tried.
EQUATIONS: tuple[type[StandardEquation], ...] = (Airy, Whittaker, Bessel, Gauss)
#: Unknown coefficients of b, and orders of its poles, up to which the system is set up; with parameters.
_UNKNOWNS = 125
_WITH_PARAMETERS = 20


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
        L = half_rate(self.m)
        da, db = a.derivative() + L * a, b.derivative() + L * b
        d2a, d2b = da.derivative() + L * da, db.derivative() + L * db
        first = 2 * da == b * D - d2b
        second = d2a == a * D - 2 * db * T - b * T.derivative()
        return first and second and bool(a * a + a * db - da * b - b * b * T)


def transforms(problem: Problem) -> Iterator[GaugeTransform]:
    """Those that are found, the likely ones first."""
    irregular = bool(irregular_places(problem))
    tried = {problem.S}
    for equation in EQUATIONS:
        if equation.irregular != irregular:
            continue
        for pullback in equation.candidates(problem, extended=False, shifted=True):
            T = pullback.S
            if T in tried:
                continue
            tried.add(T)
            problem.budget.check()
            count_work(TRIAL)
            found = _transformation(problem, analyse(T, problem.budget))
            if found is not None:
                yield GaugeTransform(pullback, *found)


# ------------------------------------------------------------------------------------------ orders of b

_Order = tuple[Place, int]
"""A place, and twice the least order of b there."""


def _transformation(problem: Problem, target: Problem) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b; None where there are none."""
    own, other = ({(p.at_infinity, p.factor): p for p in given.places} for given in (problem, target))
    options = []
    for key in dict.fromkeys([*own, *other]):
        possible = _orders(own.get(key), other.get(key))
        if not possible:
            return None
        options.append(possible)
    for orders in product(*options):
        is_square = not sum(least % 2 * place.degree for place, least in orders) % 2
        found = _solved(problem.S, target.S, orders) if is_square else None
        if found is not None:
            return found
    return None


def _orders(first: Place | None, second: Place | None) -> list[_Order]:
    """What is possible, for each parity; nothing where something isn't kept."""
    place = first or second
    assert place is not None
    order = max([2, *(p.order for p in (first, second) if p is not None)])
    base = order - 4 if place.at_infinity else order
    found: dict[int, _Order] = {}
    for n in sorted(_shifts(first, second), reverse=True):
        for least in (base - n, base - n + 1) if order % 2 else (base - n,):
            found.setdefault(least % 2, (place, least))
    return list(found.values())


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


# ------------------------------------------------------------------------------------------ a and b

_Operator = list[RatFunc]
"""c_0, c_1, ... for c_0 B + c_1 B' + ..., each times one function u."""


def _derived(operator: _Operator, rate: RatFunc) -> _Operator:
    """The derivative, u'/u the rate."""
    return _sum([c.derivative() + c * rate for c in operator], [rate * 0, *operator])


def _sum(*operators: _Operator) -> _Operator:
    zero = operators[0][0] * 0
    return [sum(parts, zero) for parts in zip_longest(*operators, fillvalue=zero)]


def _solved(S: RatFunc, T: RatFunc, orders: Sequence[_Order]) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b by (2), for b = u B with u = sqrt(m) R and a polynomial B."""
    finite = [(place.factor, least) for place, least in orders if not place.at_infinity]
    (at_infinity,) = (least for place, least in orders if place.at_infinity)
    poles = [(p, (least - least % 2) // 2) for p, least in finite]
    one = S.field.poly([1])
    m = product_of([one, *(p for p, least in finite if least % 2)])
    degree = (-at_infinity - m.degree) // 2 - sum(order * p.degree for p, order in poles)
    size = degree + 1 + sum(abs(order) * p.degree for p, order in poles)
    if degree < 0 or size > (_UNKNOWNS if S.field == QQ else _WITH_PARAMETERS):
        return None
    R = RatFunc(one)
    for p, order in poles:
        R = R * RatFunc(p) ** order
    D = S - T
    rate = half_rate(m) + R.derivative() / R
    db = _derived([RatFunc(one)], rate)
    double_slope = _sum([D], [-c for c in _derived(db, rate)])  # 2 a'
    parts = _derived(double_slope, rate), [4 * T * c for c in db], [2 * T.derivative()]
    a = [c / (2 * D) for c in _sum(*parts)]
    B = _polynomial_solution(_sum([2 * c for c in _derived(a, rate)], [-c for c in double_slope]), degree)
    if B is None:
        return None
    derivatives = [RatFunc(B)]
    while len(derivatives) < len(a):
        derivatives.append(derivatives[-1].derivative())
    return m, R * sum((c * d for c, d in zip(a, derivatives, strict=True)), D * 0), R * B


def _polynomial_solution(operator: _Operator, degree: int) -> Poly | None:
    """A polynomial of this degree at most, not 0, that the operator takes to 0."""
    x = operator[0].field.poly([0, 1])
    cleared = over_one_denominator(operator)
    columns = []
    for i in range(degree + 1):
        column = x * 0
        falling = 1  # i (i - 1) ... (i - k + 1)
        for k, coefficient in enumerate(cleared[: i + 1]):
            column = column + coefficient * falling * x ** (i - k)
            falling *= i - k
        columns.append(column)
    vector = _null_vector(columns)
    return None if vector is None else x.field.poly(vector)


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
    rows = [[*c.rational_coefficients(), *[0] * (height - 1 - c.degree)] for c in columns]
    matrix = fmpq_mat(height, len(columns), [row[j] for j in range(height) for row in rows])
    basis, nullity = matrix.numer_denom()[0].nullspace()
    return [field.poly([Fraction(int(basis[i, 0]))]) for i in range(len(columns))] if nullity else None
