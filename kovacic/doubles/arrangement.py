"""From the certificate of a solution to its product form in double precision.

- Case 1: y = exp(int theta) P; residues are exponents, poles of higher order go into the exponential.
- Case 2 on a rational curve s^2 = g: y'/y = phi/2 +- kappa r/s with f = y1 y2, phi = f'/f, and
  r/s = (C s)' + (sum of rho(a)/(x - a) + rest)/s.  In the parameter t of the curve (`kovacic.doubles.product_form`) y'/y dx
  has simple poles with constant residues, apart from an exact part: a point (a, s_a) has the parameter t_a, its conjugate
  (a, -s_a) has t_a', and x - a is a constant times (t - t_a)(t - t_a')/D(t) with D = 1, t, 1 + t^2 for line, hyperbola and
  ellipse (where a = -M has t_a = infinity: x - a = 2 M/D).  A simple pole a of phi/2 with residue mu contributes
  (t - t_a)^mu (t - t_a')^mu D^(-mu), and rho(a)/((x - a) s) has the residues +-rho(a)/s_a at t_a and t_a'.  So

      y = prod (t - t_a)^(mu + epsilon) (t - t_a')^(mu - epsilon) * D^(-sum mu) * (infinity) * exp(+-kappa C s),       (1)

  epsilon = +-kappa rho(a)/s_a; where sigma = -1, kappa stands for kappa/i and C for -C.  At a zero of f, where powers of
  x - a would cancel, the exponents come out as 0 and 1.  `rest` (deg g = 2) gives t^(+-kappa rest) on the hyperbola and
  exp(-+2 kappa rest arctan t) on the ellipse.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from flint import acb, acb_poly, arb, arb_poly

from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.curve import integrate_on_curve
from kovacic.closed_form.structure import curve_of
from kovacic.doubles.chart import Region
from kovacic.doubles.double_double import Complex, Pair
from kovacic.doubles.product_form import Conic, ProductForm, RationalFunction, RootFactor, Shape
from kovacic.doubles.tabulate import GROWTH, Cell, Variant, polynomial_table
from kovacic.enclosure.closed_form import Exponential, certified, exponentials, omega, value
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.log_derivative import LogDerivative, conjugates, embed, zeros
from kovacic.enclosure.points import ExactPoint, are_real, as_point, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.limits import check_time

_SAME = 2.0**-60
"""Balls this close together are the same point or exponent: distinct ones were separated at a far higher precision."""

_FEW_ZEROS = 60
_MAX_ZEROS = 200
_SHORT = 2000.0
"""Zeros take degree^4 time, and may be lost.  Of a polynomial of a degree between these the solution is tabulated on an
interval where it grows and oscillates by less than exp(2000), and the polynomial where the interval ends in a singular point;
of a higher degree always."""

_HIGHEST = 1 << 15
"""Working precision for the series of a polynomial."""

Powers = list[tuple[acb, acb]]  # (zeta, exponent)


def product_form(
    problem: NumericProblem, which: int, region: Region, base: ExactPoint, careful: bool
) -> ProductForm | None:
    """The solution number `which` as a product, at a working precision of some 200 bits; None where there is no such form.

    Double-doubles are its arithmetic if it is to be `careful`.

    None means case 3, case 2 on a curve of positive genus or for complex arguments, and polynomials of degree above 60 where
    a table is better.
    """
    branches = exponentials(problem)
    if branches:
        return _exponential(problem, branches[which], region, base, careful)
    return _on_curve(problem, which, region, base) if region.is_real else None


def _exponential(
    problem: NumericProblem, branch: Exponential, region: Region, base: ExactPoint, careful: bool
) -> ProductForm | None:
    """Case 1: y = exp(int theta) P."""
    c = branch.constant()
    degree = branch.P.degree
    table = None
    if degree > _FEW_ZEROS and region.is_real:
        ends = (as_point(end.real, "an end") for end in (region.low, region.high))
        if any(region.singular):
            table = polynomial_table(_Expansion.of(problem, branch, base), region, careful)
        elif degree > _MAX_ZEROS or foreseen_growth(frequency(problem.system), *ends) < _SHORT:
            return None  # the solution itself is tabulated with less effort
    roots: list[tuple[acb, int]] = []
    if table is None:
        if degree > _MAX_ZEROS:
            return None
        roots = zeros(branch.P, c)
        if sum(k for _, k in roots) < degree:
            return None  # not all were found
    theta = LogDerivative.make(branch.theta, c)
    powers = [(pole.zeta, pole.coefficients[0]) for pole in theta.poles] + [(z, acb(k)) for z, k in roots]
    is_real = region.is_real and _all_real([*theta.num.coeffs(), *theta.den.coeffs(), *embed(branch.P, c).coeffs()])
    factors = _factors(powers, to_acb(base), is_real)
    return ProductForm(region, base, factors, _exponent(theta), is_real, polynomial=table, careful=careful)


@dataclass(frozen=True)
class _Expansion:
    """The Taylor series of P/P(base) on a piece, by the recurrence of its equation a P'' + b P' + c P = 0 in balls, which loses
    digits beside singular points."""

    branch: Exponential
    base: ExactPoint
    equation: tuple[Any, Any, Any]
    known: dict[int, list[Any]] = field(default_factory=dict)

    @classmethod
    def of(cls, problem: NumericProblem, branch: Exponential, base: ExactPoint) -> _Expansion:
        assert problem.S is not None
        phi = branch.theta if problem.gauge is None else branch.theta - problem.gauge
        rest = phi.derivative() + phi * phi - problem.S  # P'' + 2 phi P' + rest P = 0
        a = phi.den * (rest.den // phi.den.gcd(rest.den))
        return cls(branch, base, (a, (2 * phi * a).num, (rest * a).num))

    def __call__(self, cell: Cell, variant: Variant) -> list[Any] | None:
        """The coefficients; None if the piece won't do."""
        prec = 300 + 3 * self.branch.P.degree
        while prec <= _HIGHEST:
            check_time()
            series = self._series(cell, variant, prec)
            if series is None:
                return None
            row, most = series
            with working_precision(200 + prec // 4):
                sizes = [abs(v) for v in row]
                small = max(v.mid() for v in sizes) * arb((1, -variant.bits))
                if all(v.rad() <= small for v in sizes):
                    converges = sum(sizes, arb(0)) <= most and max(v.mid() for v in sizes[-2:]) <= small
                    return row if converges else None
            prec *= 2
        return None

    def _series(self, cell: Cell, variant: Variant, prec: int) -> tuple[list[Any], Any] | None:
        """The coefficients in balls at this precision, and the most that one may be; None where one is larger."""
        x = arb(cell[0])
        h = arb((1, cell[1]))
        with working_precision(prec):
            P, slope, *equation = self._balls(prec)
            row = [P(x), slope(x) * h]
        with working_precision(200 + prec // 4):
            most = GROWTH * max(abs(v).upper() for v in row)
            line = type(P)([x, h])
            local = [[v * h**k for v in part(line).coeffs()] for k, part in enumerate(equation)]
            return (row, most) if _continued(row, local, variant.tested, most) else None

    def _balls(self, prec: int) -> list[Any]:
        """P, P' and the equation's coefficients, real polynomials where they are real; P(base) = 1."""
        if prec not in self.known:
            constant = self.branch.constant()
            P, *equation = (embed(part, constant) for part in (self.branch.P, *self.equation))
            P *= 1 / P(to_acb(self.base))
            found = [P, P.derivative(), *equation]
            if all(are_real(poly.coeffs()) for poly in found):
                found = [arb_poly([v.real for v in poly.coeffs()]) for poly in found]
            self.known[prec] = found
        return self.known[prec]


def _continued(row: list[Any], equation: Sequence[list[Any]], count: int, most: Any) -> bool:
    """Up to so many coefficients, from the first two, by the recurrence; False where one is larger than `most`."""
    a, b, c = equation
    _, *columns = itertools.zip_longest(a, [0, *b], [0, 0, *c], fillvalue=0)
    for n in range(2, count):
        used = zip(columns, range(n - 1, -1, -1), strict=False)
        total = sum((p * (m * (m - 1)) + q * m + r) * row[m] for (p, q, r), m in used)
        row.append(total / (-a[0] * (n * (n - 1))))
        if abs(row[-1]) > most:
            return False
    return True


def _all_real(values: list[acb]) -> bool:
    return all(v.imag.contains(0) for v in values)


def _rational(polynomial: acb_poly, polar: list[tuple[acb, acb, int]]) -> RationalFunction:
    terms = tuple((Complex.of(a), Complex.of(c), k) for a, c, k in polar if not c.is_zero())
    return RationalFunction(tuple(Complex.of(v) for v in reversed(polynomial.coeffs())), terms)


def _exponent(theta: LogDerivative) -> RationalFunction:
    """The part of int theta without logarithms."""
    poles = [
        (pole.zeta, -r / (k - 1), k - 1) for pole in theta.poles for k, r in enumerate(pole.coefficients[1:], start=2)
    ]
    return _rational(theta.primitive, poles)


def _factors(powers: Powers, base: acb, is_real: bool) -> tuple[RootFactor, ...]:
    """The factors (t - zeta)^power; for a real function, those of the closed upper half-plane, with their conjugates."""
    found = []
    for zeta, power in powers:
        if power.abs_upper() < _SAME or (is_real and zeta.imag < 0):
            continue
        d = base - zeta
        turn = acb(1) if d.contains(0) else d / abs(d)
        paired = is_real and not zeta.imag.contains(0)
        found.append(RootFactor(Complex.of(zeta), Complex.of(power), Complex.of(turn), paired))
    return tuple(found)


def _parameters(conic: Conic, a: acb) -> tuple[acb, tuple[acb, acb] | None]:
    """s_a, one of the two square roots of sigma g(a); t_a and t_a', None for a at infinity of the ellipse."""
    X = a - conic.vertex
    square = X if conic.shape is Shape.LINE else X * X + conic.m
    s = square * 0 if square.contains(0) else (square * conic.sigma).sqrt()
    if conic.shape is Shape.LINE:
        return s, (s, -s)
    if conic.shape is Shape.HYPERBOLA:
        return s, (X + s, X - s)
    right = a - conic.ends[0]
    if right.contains(0):
        return s, None
    return s, (s / right, -s / right)


def conic_of(g: acb_poly, middle: arb) -> Conic | None:
    """The curve whose s is real near `middle`; None for another degree, or coefficients that aren't real."""
    coefficients: list[Any] = g.coeffs()
    if len(coefficients) not in (2, 3) or not _all_real(coefficients):
        return None
    low, *rest = (c.real for c in coefficients)
    value = g(middle).real
    if value.contains(0):
        return None
    sigma = 1 if value > 0 else -1
    if len(rest) == 1:
        return Conic(Shape.LINE, sigma, -low, low)
    vertex = -rest[0] / 2
    m = low - vertex * vertex
    ends = (vertex - (-m).sqrt(), vertex + (-m).sqrt()) if m < 0 else ()
    shape = Shape.HYPERBOLA if sigma > 0 else Shape.ELLIPSE
    return Conic(shape, sigma, vertex, m, ends)


def _on_curve(problem: NumericProblem, which: int, region: Region, base: ExactPoint) -> ProductForm | None:
    """Equation (1), or None."""
    decision = certified(problem)
    S = problem.S
    assert decision.semi_invariant is not None
    assert S is not None
    theta = decision.semi_invariant.theta
    P = decision.semi_invariant.P
    if decision.case != 2 or P.degree > _MAX_ZEROS:
        return None
    g, r, kappa_squared = curve_of(S, decision.semi_invariant)
    c = conjugates(P.field)[0]
    z = to_acb(base)
    conic = conic_of(embed(g, c), z.real)
    if conic is None:
        return None
    integral = integrate_on_curve(r, g)
    even = theta / 2 if problem.gauge is None else theta / 2 + problem.gauge
    root, parameters = _parameters(conic, z)
    assert parameters is not None
    # Which sign is the solution number `which`?  y'/y = (even part) + kappa r/s for the sign of kappa found here.
    kappa = (embed(kappa_squared, c)(0) * conic.sigma).sqrt()
    average = value(even, c, z) + value(RatFunc(P.derivative(), P), c, z) / 2
    odd = kappa * value(integral.integrand, c, z) / root
    target = omega(problem, which, base, 200)
    if not (average + odd).overlaps(target):
        kappa = -kappa
        odd = -odd
    if not (average + odd).overlaps(target) or (average - odd).overlaps(target):
        raise ArithmeticError("the closed form doesn't belong to the polynomial of omega")
    smooth = LogDerivative.make(even, c)
    places = _places(smooth, P, integral.residues, c)
    rest = embed(integral.rest, c)(0) if integral.rest else z * 0
    is_real = _all_real([kappa]) and _all_real([*embed(P, c).coeffs(), *smooth.num.coeffs()])
    factors = _factors(_powers(places, conic, kappa, rest), parameters[0], is_real)
    sheet = _sheet(integral.exact, kappa * conic.sigma, c)
    vertex, m, *ends = (Pair.of(v) for v in (conic.vertex, conic.m, *conic.ends))
    conic = replace(conic, vertex=vertex, m=m, ends=tuple(ends))
    return ProductForm(region, base, factors, _exponent(smooth), is_real, sheet, conic)


class _Residues(NamedTuple):
    """A point a of the x-line with its residues: mu of phi/2, and rho of r."""

    a: acb
    mu: acb
    rho: acb


def _places(smooth: LogDerivative, P: Any, residues: tuple[Any, ...], c: acb | None) -> list[_Residues]:
    """The points with residues, each once."""
    zero = acb(0)
    found = [_Residues(pole.zeta, pole.coefficients[0], zero) for pole in smooth.poles]
    found += [_Residues(a, acb(k) / 2, zero) for a, k in zeros(P, c)]
    for part in residues:
        found += [_Residues(a, zero, embed(part.value, c)(a)) for a, _ in zeros(part.factor, c)]
    merged: list[_Residues] = []
    for one in found:
        near = _SAME * (1 + abs(one.a))
        known = next((k for k, other in enumerate(merged) if (other.a - one.a).abs_upper() < near), None)
        if known is None:
            merged.append(one)
        else:
            other = merged[known]
            merged[known] = _Residues(other.a, other.mu + one.mu, other.rho + one.rho)
    return merged


def _powers(places: list[_Residues], conic: Conic, kappa: acb, rest: acb) -> Powers:
    """The exponents in t of (1)."""
    total = sum((place.mu for place in places), acb(0))
    i = acb(0, 1)
    found: Powers = []
    for a, mu, rho in places:
        s, parameters = _parameters(conic, a)
        if parameters is not None:
            epsilon = acb(0) if rho.is_zero() else kappa * rho / s
            found += [(parameters[0], mu + epsilon), (parameters[1], mu - epsilon)]
    if conic.shape is Shape.HYPERBOLA:
        found.append((acb(0), kappa * rest - total))
    elif conic.shape is Shape.ELLIPSE:
        found += [(i, i * kappa * rest - total), (-i, -i * kappa * rest - total)]
    return found


def _sheet(exact: RatFunc, kappa: acb, c: acb | None) -> RationalFunction:
    """kappa C."""
    if not exact:
        return RationalFunction()
    quotient, _ = divmod(exact.num, exact.den)
    parts = LogDerivative.make(exact, c)
    polar = [(pole.zeta, kappa * v, k) for pole in parts.poles for k, v in enumerate(pole.coefficients, start=1)]
    return _rational(embed(quotient, c) * kappa, polar)
