"""From the certificate of a solution of case 1, y = exp(int theta) P, to its product form in double precision.

Residues of theta are exponents, poles of higher order go into the exponential.
"""

from __future__ import annotations

from flint import acb

from kovacic.doubles.chart import Region
from kovacic.doubles.double_double import Complex
from kovacic.doubles.product_form import ProductForm, RationalFunction, RootFactor
from kovacic.enclosure.closed_form import exponentials
from kovacic.enclosure.frame import foreseen_growth, frequency
from kovacic.enclosure.log_derivative import LogDerivative, embed, zeros
from kovacic.enclosure.points import ExactPoint, as_point, to_acb
from kovacic.enclosure.problem import NumericProblem

_SAME = 2.0**-60
"""Powers this close to 0 are none: other exponents were separated from it at a far higher precision."""

_FEW_ZEROS = 60
_MAX_ZEROS = 200
_SHORT = 2000.0
"""Zeros take degree^4 time, and may be lost.  With a polynomial of a degree between these a solution is tabulated on an
interval where it grows and oscillates by less than exp(2000), with one of a higher degree always."""


def product_form(problem: NumericProblem, which: int, region: Region, base: ExactPoint) -> ProductForm | None:
    """The solution number `which` as a product, at a working precision of some 200 bits; None where there is no such form.

    None means cases 2 and 3, and polynomials of degree above 60 where a table is better.
    """
    branches = exponentials(problem)
    if not branches:
        return None
    branch = branches[which]
    c = branch.constant()
    degree = branch.P.degree
    is_short = False
    if degree > _FEW_ZEROS and region.is_real:
        ends = (as_point(end.real, "an end") for end in (region.low, region.high))
        is_short = foreseen_growth(frequency(problem.system), *ends) < _SHORT
    if is_short or degree > _MAX_ZEROS:
        return None
    roots = zeros(branch.P, c)
    if sum(k for _, k in roots) < degree:
        return None  # not all were found
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
    return ProductForm(region, base, _factors(powers, to_acb(base), is_real), exponent, is_real)


def _factors(powers: list[tuple[acb, acb]], base: acb, is_real: bool) -> tuple[RootFactor, ...]:
    """The factors (x - zeta)^power; for a real function, those of the closed upper half-plane, with their conjugates."""
    found = []
    for zeta, power in powers:
        if power.abs_upper() < _SAME or (is_real and zeta.imag < 0):
            continue
        d = base - zeta
        turn = acb(1) if d.contains(0) else d / abs(d)
        paired = is_real and not zeta.imag.contains(0)
        found.append(RootFactor(Complex.of(zeta), Complex.of(power), Complex.of(turn), paired))
    return tuple(found)
