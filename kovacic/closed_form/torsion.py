"""Is int r dx/sqrt(g) elementary on a curve s^2 = g of positive genus, and what is it?

Let r dx/s be reduced as in `kovacic.closed_form.curve`, without exact part.  By Liouville's theorem the integral is elementary
only if r dx/s is a combination, with constants, of logarithmic differentials dU/U on the curve; these have simple poles
only.  So

- without residues (at infinity too) it isn't elementary; nor with a pole of higher order at infinity;
- if the residues are rational multiples of one constant 1/tau, one U must do: with kappa = tau/4,
  kappa r dx/s = (1/(2n)) d log(U/sqrt(N)), N the norm of U.  Then y+- = f^(1/2) exp(+-kappa int r dx/s), f = s/r, solve
  y'' = S y with S = (f'/f)'/2 + (f'/f)^2/4 + kappa^2 r^2/g, whose group is dicyclic of order 4n if there is such a U, and
  N(T) otherwise; `kovacic.galois` decides it, and has u^n as a function on the curve, in O(log n) pieces whose product,
  without the factors in K(x), is U.  It isn't multiplied out: its degree grows like n.

Reference: J. H. Davenport, On the Integration of Algebraic Functions (1981).
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.curve import CurveIntegral, Unit
from kovacic.decision import CurveFunction, SemiInvariant
from kovacic.engine.places import analyse, rational_square_root
from kovacic.galois.group import GroupKind
from kovacic.galois.imprimitive import imprimitive_group
from kovacic.limits import Budget

FIRST_KIND = "it has no logarithmic part on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
SECOND_KIND = (
    "it has a pole of the second kind at infinity on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
)
NOT_TORSION = "its poles on the curve s^2 = {g} of genus {genus} don't form a torsion divisor, so it isn't elementary"
SEVERAL = "its residues on the curve s^2 = {g} of genus {genus} aren't rational multiples of one another; not decided"
UNDECIDED = "no function with its poles on the curve s^2 = {g} of genus {genus} was found within the limits"


def completed(integral: CurveIntegral) -> CurveIntegral:
    """The integral with its units if it is elementary on a curve of positive genus, else with the reason why it is left."""
    if integral.is_elementary:
        return integral
    found = _decide(replace(integral, exact=integral.exact * 0))
    if isinstance(found, str):
        g = integral.g
        return replace(integral, reason=found.format(g=g, genus=(g.degree - 1) // 2))
    return replace(integral, units=found)


def _decide(integral: CurveIntegral) -> tuple[Unit, ...] | str:
    g = integral.g
    field = integral.g.field
    middle = Fraction(g.degree, 2) - 1
    at_infinity = integral.rest[int(middle)] if middle.denominator == 1 else field.poly([])
    if integral.rest.degree > middle:
        return SECOND_KIND
    if not integral.residues and not at_infinity:
        return FIRST_KIND
    tau_squared = _common_tau(integral, at_infinity)
    if tau_squared is None:
        return SEVERAL
    kappa_squared = tau_squared * Fraction(1, 16)
    r = integral.integrand
    phi = RatFunc(g.derivative(), g) / 2 - r.derivative() / r
    S = phi.derivative() / 2 + phi * phi / 4 + r * r / g * kappa_squared
    # The form f: its zeros at ordinary points, where a residue belongs to the exponents 0 and 1, are P's.
    P = phi.den // phi.den.gcd(S.den)
    form = SemiInvariant(2, phi - RatFunc(P.derivative(), P), P)
    group = imprimitive_group(analyse(S, Budget()), form)
    if group.kind is GroupKind.INFINITE_DIHEDRAL:
        return NOT_TORSION
    if group.kind is not GroupKind.DICYCLIC or group.function is None:
        return UNDECIDED
    return _units(integral, group.function, kappa_squared)


def _common_tau(integral: CurveIntegral, at_infinity: Poly) -> Poly | None:
    """tau^2 if every residue is a rational multiple of 1/tau, else None."""
    values = []
    for pole in integral.residues:
        p = pole.factor
        rho = pole.value
        inverse = rho.inverse_modulo(p)
        square = integral.radicand(pole) * inverse * inverse % p
        if square.degree > 0:
            return None
        values.append(square[0])
    if at_infinity:
        values.append((at_infinity * at_infinity).inverse())
    if any(rational_square_root(value / values[0]) is None for value in values):
        return None
    return values[0]


def _units(integral: CurveIntegral, f: CurveFunction, kappa_squared: Poly) -> tuple[Unit, ...] | str:
    """The logarithms of the pieces a + b y of f as those of a + b c kappa s: y = c kappa s, c a constant up to its sign."""
    g = integral.g
    c = f.h.field.sqrt((f.h.lc / kappa_squared[0]) / g.lc)
    if c is None:
        return UNDECIDED
    exponents: dict[tuple[Poly, Poly], int] = {}
    for piece in f.pieces:
        pair = (piece.a, piece.b)
        exponents[pair] = exponents.get(pair, 0) + piece.exponent
    for sign in (c, -c):
        found = tuple(
            Unit(a, b * sign, None, kappa_squared, Fraction(e, 2 * f.multiple)) for (a, b), e in exponents.items()
        )
        if sum((unit.integrand(g) for unit in found), RatFunc(g * 0)) == integral.integrand:
            return found
    return UNDECIDED
