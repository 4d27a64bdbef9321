"""Is int r dx/sqrt(g) elementary on a curve s^2 = g of positive genus, and what is it?

Let r dx/s be reduced as in `kovacic.closed_form.curve`, without exact part.  By Liouville's theorem the integral is elementary
only if r dx/s is a combination, with constants, of logarithmic differentials dU/U on the curve; these have simple poles
only.  So

- without residues (at infinity too) it isn't elementary; nor with a pole of higher order at infinity;
- if the residues are rational multiples of one constant 1/tau, one U must do: with kappa = tau/4,
  kappa r dx/s = (1/(2n)) d log(U/sqrt(N)), N the norm of U.  Then y+- = f^(1/2) exp(+-kappa int r dx/s), f = s/r, solve
  y'' = S y with S = (f'/f)'/2 + (f'/f)^2/4 + kappa^2 r^2/g, whose group is dicyclic of order 4n if there is such a U, and
  N(T) otherwise; `kovacic.galois` decides it, by the order of a divisor in the Jacobian modulo primes and by the
  invariants of degree 2n.  It isn't reducible, since the residues of u = y+/y- are half-integers; for the same reason n is
  even, so that f^n is rational and U = u^n f^n can be reduced to u^n, of norm 1, up to a rational factor.

U = y+^(2n) comes from an invariant G = y+^(2n) + y-^(2n) + const (y+ y-)^n: with D = d/dx - n f'/f, which annihilates f^n,

    D G = 2 n kappa (r/s) (y+^2n - y-^2n),      (s/r) D ((s/r) D G) = (2 n kappa)^2 (y+^2n + y-^2n).                   (1)

Reference: J. H. Davenport, On the Integration of Algebraic Functions (1981).
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.curve import CurveIntegral, Unit
from kovacic.decision import NoInvariant, SemiInvariant
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Problem, analyse, rational_square_root
from kovacic.engine.riccati import residue
from kovacic.errors import LimitExceeded
from kovacic.galois.group import GroupKind
from kovacic.galois.imprimitive import imprimitive_group
from kovacic.limits import Budget, Limits, watched_seconds

#: Seconds that the decision may take; beyond, the integral is left with that reason.
SECONDS = 5.0

FIRST_KIND = "it has no logarithmic part on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
SECOND_KIND = (
    "it has a pole of the second kind at infinity on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
)
NOT_TORSION = "its poles on the curve s^2 = {g} of genus {genus} don't form a torsion divisor, so it isn't elementary"
SEVERAL = "its residues on the curve s^2 = {g} of genus {genus} aren't rational multiples of one another; not decided"
UNDECIDED = (
    "whether its poles on the curve s^2 = {g} of genus {genus} form a torsion divisor wasn't decided within the limits"
)


def completed(integral: CurveIntegral) -> CurveIntegral:
    """The integral with its unit U if it is elementary on a curve of positive genus, else with the reason why it is left."""
    if integral.is_elementary:
        return integral
    found = _decide(replace(integral, exact=integral.exact * 0))
    if isinstance(found, str):
        g = integral.g
        return replace(integral, reason=found.format(g=g, genus=(g.degree - 1) // 2))
    return replace(integral, unit=found)


def _decide(integral: CurveIntegral) -> Unit | str:
    g, field = integral.g, integral.g.field
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
    try:
        problem = analyse(S, Budget(Limits(seconds=watched_seconds(SECONDS))))
        group = imprimitive_group(problem, SemiInvariant(2, phi, field.poly([1])))
        if group.kind is GroupKind.INFINITE_DIHEDRAL:
            return NOT_TORSION
        if group.kind is not GroupKind.DICYCLIC or group.n is None:
            return UNDECIDED
        return _unit(problem, integral, phi, group.n, kappa_squared)
    except LimitExceeded:
        return UNDECIDED


def _common_tau(integral: CurveIntegral, at_infinity: Poly) -> Poly | None:
    """tau^2 if every residue is a rational multiple of 1/tau, else None."""
    values = []
    for pole in integral.residues:
        p, rho = pole.factor, pole.value
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


def _unit(problem: Problem, integral: CurveIntegral, phi: RatFunc, n: int, kappa_squared: Poly) -> Unit | str:
    """Equation (1) for an invariant of degree 2n, with the common factors of its two parts removed."""
    space = invariants(problem, 2 * n)
    if isinstance(space, NoInvariant):
        return UNDECIDED
    g, r = integral.g, integral.integrand
    for form in space:
        G = _singular_part(problem, form.R) * form.P
        difference = G.derivative() - G * phi * n
        if difference:
            break
    else:
        return UNDECIDED
    square = RatFunc(g) / (r * r)
    even = (square * (difference.derivative() - difference * phi * n) + square.derivative() * difference / 2) / (2 * n)
    odd = difference / r
    common = even.den * (odd.den // even.den.gcd(odd.den))
    A, B = even.num * (common // even.den), odd.num * (common // odd.den)
    divisor = A.gcd(B)
    A, B = A // divisor, B // divisor
    root = (A * A - B * B * g * kappa_squared).monic().root(2)
    if root is None:
        return UNDECIDED
    found = Unit(A, B, root, kappa_squared, Fraction(1, 2 * n))
    return found if found.integrand(g) == r else UNDECIDED


def _singular_part(problem: Problem, R: Poly) -> RatFunc:
    """Q = prod p^(v_p) with Q'/Q = R/D."""
    result = RatFunc(problem.field.poly([1]))
    for place in problem.finite_places:
        result = result * RatFunc(place.factor) ** residue(problem, R, place)
    return result
