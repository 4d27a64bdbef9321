"""Products of powers and exponentials in double precision, arranged so that no digit is lost:

    y(x) = constant * prod_k (x - z_k)^(n_k) * prod_j ((x - zeta_j)/turn_j)^(r_j) * exp(E(x)).

- Polynomial factors stay products over their zeros z_k, which are double-doubles: x - z_k keeps its digits near a zero.
- Powers that are small integers are multiplied out, with the binary exponent apart; all others are one logarithm.
- E is kept as partial fractions.  From the certificate of a solution of case 1, y = exp(int theta) P, the residues of theta are
  the r_j, and its poles of higher order go into E.
- |turn_j| = 1, and (x - zeta_j)/turn_j > 0 at the middle of the interval, so that the principal power is the continuous
  one along the straight line from there: a quotient of points on a line that misses 0 never meets the negative real axis.

With the careful arithmetic of double-doubles, huge exponents and factors that cancel cost neither range nor digits.  Plain
doubles lose half a unit in the last place for each factor, the rounding error of the exponent times its size, and values whose
factors leave the range of doubles, although they don't.  `kovacic.doubles.lambdify` measures the errors; none is proven.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import logarithmic_derivative
from kovacic.doubles.chart import PRECISION, Measured, Region, facts, in_blocks
from kovacic.doubles.double_double import (
    LOG_2,
    ROOM,
    Complex,
    Pair,
    absolute,
    angle,
    complex_array,
    double,
    horner,
    log,
    split,
)
from kovacic.enclosure.closed_form import Exponential, exponential_solutions
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.log_derivative import LogDerivative, embed, enclosed_zeros
from kovacic.enclosure.points import ExactPoint, as_point, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.errors import LimitExceeded


@dataclass(frozen=True)
class RootFactor:
    """((x - zeta)/turn)^power; a natural power up to 8 stands without its turn.

    `paired` stands for the product with the complex conjugate factor, which is positive for real t.
    """

    zeta: Complex
    power: Complex
    turn: Complex
    paired: bool

    @property
    def whole(self) -> int | None:
        """The power, if it is an integer up to 8 in absolute value: it is multiplied out."""
        k = self.power.re.hi
        return round(k) if self.power.im is None and abs(k) <= 8 and k == round(k) else None

    @property
    def is_natural(self) -> bool:
        """True if the power is a small nonnegative integer."""
        return self.whole in range(9)


@dataclass(frozen=True)
class RationalFunction:
    """Polynomial (coefficients high to low) plus the sum of c/(x - a)^k over `polar` = ((a, c, k), ...)."""

    polynomial: tuple[Complex, ...] = ()
    polar: tuple[tuple[Complex, Complex, int], ...] = ()

    def terms(self, x: Complex) -> list[Complex]:
        """The terms of its sum at x; an empty list for the zero function."""
        terms = [horner(self.polynomial, x)] if self.polynomial else []
        for a, c, k in self.polar:
            inverse = (x - a).reciprocal()
            for _ in range(k):
                c *= inverse
            terms.append(c)
        return terms


@dataclass(frozen=True)
class ProductForm:
    """A solution as a product of powers and an exponential: call it with a number or an array.

    It keeps no state, and threads may share it.

    Attributes
    ----------
    region : Region
        Where it is defined: `low` and `high`.
    base : ExactPoint
        The point near the middle where powers are positive.
    factors : tuple of RootFactor
        The powers.
    exponent : RationalFunction
        In the exponential.
    is_real : bool
        True for a real function: pairs of conjugate factors are merged.
    careful : bool
        Double-doubles; else it is plain double arithmetic.
    measured : Measured or None
        The error that `lambdify` found; None if it wasn't measured.
    branch : Exponential
        The certificate that it was made from.
    constant : Complex or None
        A factor; None for 1.

    Examples
    --------
    >>> import kovacic
    >>> f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 100))
    >>> f
    <ProductForm on [0, 100], real>
    >>> sign, size = f.log(100.0)      # exp(5000) is beyond the doubles
    >>> print(f(100.0), sign, f"{size:.6f}")
    inf 1.0 5004.605170
    """

    region: Region
    base: ExactPoint
    factors: tuple[RootFactor, ...]
    exponent: RationalFunction
    is_real: bool
    branch: Exponential
    careful: bool = True
    measured: Measured | None = None
    constant: Complex | None = None

    def __repr__(self) -> str:
        return f"<ProductForm on {self.region}, {'real' if self.is_real else 'complex'}>"

    def _repr_html_(self) -> str:
        return facts("the closed form", self.region, self.measured, values="real" if self.is_real else "complex")

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of the interval, doubles; of a rectangle those of its real parts."""
        return self.region.interval

    @cached_property
    def derivative(self) -> ProductForm:
        """y', for the same arguments; its error isn't measured.

        With theta = A/D, y = exp(int theta) P has the derivative exp(int (theta - D'/D)) N, N = A P + D P'.
        """
        theta = self.branch.theta
        P = self.branch.P
        D = theta.den
        slope = replace(self.branch, theta=theta - logarithmic_derivative(D), P=theta.num * P + D * P.derivative())
        with working_precision(PRECISION):
            found = form_of(slope, self.region, self.base)
            if found is None:
                raise LimitExceeded("the zeros of the derivative weren't found", limit="digits")
            c = self.branch.constant()
            # Products over zeros are monic: the leading coefficients of N, P and D aren't in them.
            lead, first, last = (embed(poly, c).coeffs() or [acb(0)] for poly in (slope.P, P, D))
            # The phases are those of the turns, which are divided out of the factors.
            factor = lead[-1] / (first[-1] * last[-1]) * (_phase(found.factors) - _phase(self.factors)).exp()
            constant = Complex.of(acb(factor.real) if self.is_real else factor)
        whole = constant if self.constant is None else constant * self.constant
        return replace(found, careful=self.careful, constant=whole)

    def __call__(self, x: Any) -> Any:
        """y(x), of the shape of x; inf or 0 where the value is beyond the doubles.

        Parameters
        ----------
        x : number or array
            Within the region.

        Raises
        ------
        InputError
            For an argument outside of the region, or one that isn't numerical.

        Examples
        --------
        >>> import kovacic
        >>> f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 2))      # x exp(x^2/2)
        >>> print(f"{f(1.0):.12f}", f([1.0, 2.0]).shape)
        1.648721270700 (2,)
        """
        return in_blocks(self._values, self.region.points(x))

    def log(self, x: Any) -> tuple[Any, Any]:
        """The sign (or for complex functions y/|y|) and log |y|, of the shape of x, without overflow.  Raises as a call does.

        Parameters
        ----------
        x : number or array
            Within the region.

        Examples
        --------
        >>> import kovacic
        >>> f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 100))
        >>> sign, size = f.log(100.0)
        >>> print(sign, f"{size:.6f}")
        1.0 5004.605170
        """
        points = self.region.points(x)
        if np.ma.isMaskedArray(points):
            unit, total = self.log(points.data)
            return np.ma.array(unit, mask=points.mask), np.ma.array(total, mask=points.mask)
        with np.errstate(all="ignore"):
            value, binary, growth = self._parts(points.reshape(-1), careful=True)
            # log|y| = re(growth) + binary log(2) + log|value|; the sign is that of the value times exp(i im(growth)).
            unit = complex_array(value)
            total = double(growth.re + LOG_2 * Pair(0.0 + binary)) + np.log(np.abs(unit))
            unit = np.sign(unit) * complex_array(_turn(growth))
        return unit.reshape(points.shape)[()], total.reshape(points.shape)[()]

    def _values(self, x: Any) -> Any:
        value, binary, growth = self._parts(x, self.careful)
        value = value.each(double)
        if self.careful:
            # exp(growth) = 2^turns exp(rest), |rest| <= log(2)/2, and exp(hi + lo) = exp(hi) (1 + lo).
            turns = np.rint(growth.re.hi / LOG_2.hi)
            rest = growth.re - Pair(turns, 0.0 * turns) * LOG_2
            value *= Complex(np.exp(rest.hi) * (1.0 + rest.lo))
            binary = np.clip(binary + turns, -6000, 6000).astype(np.int64)
        else:
            value *= Complex(np.exp(growth.re))
        if growth.im is not None:
            value *= _turn(growth)
        if np.ndim(binary):
            value = value.each(lambda part: np.ldexp(part, binary))
        return value.re if self.is_real else complex_array(value)

    def _parts(self, x: Any, careful: bool) -> tuple[Complex, Any, Complex]:
        """value, binary and growth with y = value * 2^binary * exp(growth)."""
        point = Complex(x) if self.region.is_real else Complex(x.real, x.imag)
        if careful:
            point = point.each(_with_low_part)
        growth = self.exponent.terms(point)
        # |x - zeta| <= size + reach.
        size = max(abs(self.region.low), abs(self.region.high))
        zetas = (f.zeta for f in self.factors)
        reach = max((math.hypot(z.re.hi, 0.0 if z.im is None else z.im.hi) for z in zetas), default=0.0)
        product = _Product(point, careful, size + reach)
        for f in self.factors:
            product.multiply(f, growth)
        nothing = 0.0 * x.real  # of the shape of x, where no term is
        total = sum(growth, Complex(_with_low_part(nothing) if careful else nothing))
        value = product.value or Complex(np.ones(x.shape))
        if self.constant is not None:
            value *= self.constant
        return value, product.binary, Complex(total.re) if self.is_real else total


def _with_low_part(v: Any) -> Any:
    """The doubles as double-doubles."""
    return Pair(v, 0.0 * v)


class _Product:
    """The product of the factors with small powers, value * 2^binary; the others go into the exponent of the form."""

    def __init__(self, t: Complex, careful: bool, reach: float) -> None:
        self.t = t
        self.careful = careful
        self.value: Complex | None = None
        self.binary: Any = 0
        self.bits = 0.0  # by which it may have grown since its binary exponent was taken out
        self.degree_bits = math.log2(reach + 2.0)

    def multiply(self, f: RootFactor, growth: list[Complex]) -> None:
        """One factor more."""
        d: Complex = self.t - f.zeta
        e: Any = 0  # the factor is 2^e d
        if self.careful:
            d, e = split(d)
        power = f.power
        # (d conj(d))^re(power) exp(-2 im(power) arg d): both factors in one, with |d|^2 = 2^(2 e) |d 2^-e|^2.
        if f.paired:
            if power.im is not None:
                growth.append(Complex(angle(d * f.turn.conjugate()) * (power.im * Pair(-2.0))))
            d = Complex(d.re * d.re + d.im * d.im)
            e = 2 * e
            power = Complex(power.re)
        whole = f.whole
        is_real = d.im is None
        # A real power other than a natural one is that of |x - zeta|, as (x - zeta)/turn > 0.
        if is_real and not f.is_natural:
            d = Complex(absolute(d.re))
        if whole is not None and (is_real or f.is_natural):
            self.binary = self.binary + e * whole
            degree = 2 if f.paired else 1
            # One factor after the other, or the reciprocal of them all.
            pieces = [d] * abs(whole)
            if whole < 0:
                pieces = [math.prod(pieces[1:], start=d).reciprocal()]
            for piece in pieces:
                self._times(piece, degree)
            return
        if is_real and power.im is None and not self.careful:
            self._times(Complex(np.power(d.re, power.re.hi)), 0)  # exact but for one rounding, unlike a logarithm
            return
        # The logarithm of 2^e d, continuous along a line.
        if is_real:
            logarithm = Complex(log(d.re))
        else:
            logarithm = Complex(log(d.re * d.re + d.im * d.im) * Pair(0.5), angle(d * f.turn.conjugate()))
        if self.careful:
            logarithm += Complex(LOG_2 * Pair(0.0 + e))
        growth.append(power * logarithm)

    def _times(self, piece: Complex, degree: int) -> None:
        # 2^degree_bits bounds a linear factor on the region.
        self.bits += degree * self.degree_bits
        if self.value is None:
            self.value = piece
            return
        if self.careful or self.bits > ROOM:  # the binary exponent, before the product may leave the range of doubles
            self.value, shift = split(self.value)
            self.binary = self.binary + shift
            self.bits = degree * self.degree_bits
        self.value *= piece


def _turn(growth: Complex) -> Complex:
    """exp(i im)."""
    if growth.im is None:
        return Complex(1.0)
    t, rest = (growth.im.hi, growth.im.lo) if isinstance(growth.im, Pair) else (growth.im, 0.0)
    # exp(i (t + rest)) = exp(i t)(1 + i rest).
    c, s = np.cos(t), np.sin(t)
    return Complex(c - rest * s, s + rest * c)


#: Zeros of a polynomial of this degree take half a second, which grows like the fourth power of the degree.
_MOST_ZEROS = 200


@working_precision(PRECISION)
def product_form(problem: NumericProblem, which: int, region: Region, base: ExactPoint) -> ProductForm | None:
    """The solution number `which` as a product; None in cases 2 and 3, and if a table serves better."""
    branches = exponential_solutions(problem)
    if not branches or branches[which].P.degree > _MOST_ZEROS:
        return None
    if branches[which].P.degree > 60 and region.is_real:
        # Beside many factors a table is evaluated faster, unless it has many pieces: where y grows by more than exp(2000).
        ends = (as_point(end, "an end") for end in region.interval)
        if foreseen_growth(frequency(problem.system), *ends) < 2000:
            return None
    return form_of(branches[which], region, base)


def form_of(branch: Exponential, region: Region, base: ExactPoint) -> ProductForm | None:
    """The product of a solution, at the working precision in force; None if not all zeros of its polynomial are found."""
    c = branch.constant()
    roots = enclosed_zeros(branch.P, c)
    if sum(k for _, k in roots) < branch.P.degree:
        return None
    theta = LogDerivative.make(branch.theta, c)
    powers = [(pole.zeta, pole.coefficients[0]) for pole in theta.poles] + [(z, acb(k)) for z, k in roots]
    coefficients = [*theta.num.coeffs(), *theta.den.coeffs(), *embed(branch.P, c).coeffs()]
    is_real = region.is_real and all(value.imag.contains(0) for value in coefficients)
    # The part of int theta without logarithms.
    polar = tuple(
        (Complex.of(pole.zeta), Complex.of(-r / k), k)
        for pole in theta.poles
        for k, r in enumerate(pole.coefficients[1:], start=1)
        if not r.is_zero()
    )
    exponent = RationalFunction(tuple(Complex.of(v) for v in reversed(theta.primitive.coeffs())), polar)
    return ProductForm(region, base, _root_factors(powers, to_acb(base), is_real), exponent, is_real, branch)


def _phase(factors: Sequence[RootFactor]) -> acb:
    """The logarithm of the product of the turns to their powers."""
    turned = (f for f in factors if not (f.paired or f.is_natural))
    return sum((f.power.ball() * f.turn.ball().log() for f in turned), acb(0))


def _root_factors(powers: list[tuple[acb, acb]], base: acb, is_real: bool) -> tuple[RootFactor, ...]:
    """The factors (x - zeta)^power; for a real function, those of the closed upper half-plane, with their conjugates."""
    found = []
    for zeta, power in powers:
        # Other exponents were separated from 0 at a far higher precision.
        if power.abs_upper() < 2.0**-60 or (is_real and zeta.imag < 0):
            continue
        d = base - zeta
        # (base - zeta)/turn = |base - zeta| > 0.
        turn = acb(1) if d.contains(0) else d / abs(d)
        paired = is_real and not zeta.imag.contains(0)
        found.append(RootFactor(Complex.of(zeta), Complex.of(power), Complex.of(turn), paired))
    return tuple(found)
