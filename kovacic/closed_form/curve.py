"""Integrals int r dx / sqrt(g) on the curve s^2 = g: reduced to simple poles, and done where the genus is 0.

g is monic and squarefree of degree d, r in K(x).  Hermite's reduction on the curve gives

    r/s = (C s)' + (sum over simple poles a of rho(a)/(x - a) + rest)/s,     rest a polynomial of degree <= d - 2.    (1)

For d <= 2 every term is elementary.  With gamma = g(a) and the tangent L = gamma + g'(a) (x - a)/2,

    L^2 - gamma g = (g'(a)^2/4 - gamma g''/2) (x - a)^2,    int dx/((x - a) s) = -log((L + sqrt(gamma) s)/(x - a))/sqrt(gamma),
    int dx/s = log(g'/2 + s)                                (d = 2).                                                (2)

For d >= 3 the integral is elementary only if a divisor on the Jacobian is a torsion point: see `completed`.

Functions A + B t on a curve t^2 = tau^2 g of genus 0 (or with a torsion divisor) gather many conjugate points.
Points over the roots a of a polynomial p are given by T in K[x]/p: t = T(a) there, T^2 = tau^2 g mod p.  A + B t vanishes at
these points, and only there, if

    A + B T = 0 mod p,      deg A <= deg p/2,      A^2 - tau^2 B^2 g = constant * p,                                       (3)

and such A and B come from Euclid's algorithm for p and T, in K[x], whatever the degree of p: no root is needed.  For g of
degree 2 the degree of p must be even, as the poles at the two points at infinity must be of the same order.

- `unit`: with p^2 for p the points count twice, which is the sum of logarithms over the roots in (2) if rho(a)^2/g(a) is the
  same constant 1/tau^2 at all of them; T = -g/rho.
- `gathered_zeros`: at the zeros of y+ y-, kappa r dx/s has the residues +-1/2, so that T = 2 kappa^2 rho, tau = kappa.

`completed` decides whether the integral is elementary on a curve of positive genus.  Let r dx/s be reduced by (1), without
exact part.  By Liouville's theorem it is elementary only if r dx/s is a combination, with constants, of logarithmic
differentials dU/U on the curve; these have simple poles only.  So

- without residues (at infinity too) it isn't elementary; nor with a pole of higher order at infinity;
- if the residues are rational multiples of one constant 1/tau, one U must do: with kappa = tau/4,
  kappa r dx/s = (1/(2n)) d log(U/sqrt(N)), N the norm of U.  Then y+- = f^(1/2) exp(+-kappa int r dx/s), f = s/r, solve
  y'' = S y with S = (f'/f)'/2 + (f'/f)^2/4 + kappa^2 r^2/g, whose group is dicyclic of order 4n if there is such a U, and
  N(T) otherwise; `kovacic.galois` decides it, and has u^n as a function on the curve, in O(log n) pieces whose product,
  without the factors in K(x), is U.  It isn't multiplied out: its degree grows like n.

Reference: J. H. Davenport, On the Integration of Algebraic Functions (1981).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction

from kovacic.algebra.partial_fractions import Residue, reduce_poles
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.decision import CurveFunction, SemiInvariant
from kovacic.engine.places import analyse, rational_square_root
from kovacic.galois.chain import logarithmic_slope, remainders
from kovacic.galois.group import GroupKind
from kovacic.galois.imprimitive import imprimitive_group
from kovacic.limits import Budget


@dataclass(frozen=True)
class Unit:
    """The contribution factor * log((A + B tau s)/sqrt(norm))/tau to an integral; tau^2 = `tau_squared`, a constant of K.

    p is a square root of the norm up to a constant; None unless the norm is found to be a square.
    """

    A: Poly
    B: Poly
    p: Poly | None
    tau_squared: Poly
    factor: Fraction = Fraction(-1)

    def norm(self, g: Poly) -> Poly:
        """A^2 - tau^2 B^2 g."""
        return self.A * self.A - self.B * self.B * g * self.tau_squared

    def integrand(self, g: Poly) -> RatFunc:
        """r with r dx/s the derivative of the contribution, which is log((A + B tau s)/(A - B tau s)) factor/(2 tau)."""
        h = g * self.tau_squared
        return logarithmic_slope(self.A, self.B, h) / self.tau_squared * self.factor


@dataclass(frozen=True)
class CurveIntegral:
    """int r dx/sqrt(g) as in (1): `exact` is C, `residues` the simple poles, `rest` the polynomial of degree <= d - 2.

    For d >= 3 everything but the exact part amounts to the logarithms of `units`, or `reason` says why it is left.
    """

    g: Poly
    exact: RatFunc
    residues: tuple[Residue, ...]
    rest: Poly
    units: tuple[Unit, ...] = ()
    reason: str | None = None

    @property
    def integrand(self) -> RatFunc:
        """r, recomputed from the result by equation (1)."""
        return self.without_exact + _twisted_slope(self.exact, self.g)

    @property
    def without_exact(self) -> RatFunc:
        """The integrand without the derivative of the exact part."""
        return sum((residue.logarithmic for residue in self.residues), RatFunc(self.rest))

    def slope_of_units(self, units: Iterable[Unit]) -> RatFunc:
        """r with r dx/s the derivative of the contributions of these units."""
        return sum((u.integrand(self.g) for u in units), RatFunc(self.g * 0))

    @property
    def kernel_derivative(self) -> RatFunc:
        """The logarithmic derivative of 1/s."""
        return logarithmic_derivative(self.g) * Fraction(-1, 2)

    @property
    def is_elementary(self) -> bool:
        """True if (2) gives the integral; False proves nothing for genus 1 and higher."""
        return self.g.degree <= 2 or (not self.residues and not self.rest)


def integrate_on_curve(r: RatFunc, g: Poly) -> CurveIntegral:
    """int r dx/sqrt(g) for a monic squarefree g.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> done = integrate_on_curve(1 / x**2, QQ.poly([1, 0, 1]))  # -sqrt(x^2 + 1)/x
    >>> print(done.exact, len(done.residues), done.rest)
    -1/x 0 0
    """
    field = r.field
    g = g.over(field)
    d = g.degree
    # with the kernel 1/s: int r/s = W/s + ..., and W/s = (W/g) s
    W, r, residues = reduce_poles(r, logarithmic_derivative(g) * Fraction(-1, 2), g)
    exact = W / g
    r = r - sum((found.logarithmic for found in residues), r * 0)
    for p, _ in field.factor(r.den):
        cofactor, j = r.den.remove(p)
        while j:
            # at a branch point, g = p u: ((B/p^j) s)' s = (1/2 - j) B p' u/p^j + ...
            B = r.num * (cofactor * p.derivative() * (g // p)).inverse_modulo(p) % p
            C = RatFunc(B * (1 / (Fraction(1, 2) - j)), p**j)
            exact = exact + C
            r = r - _twisted_slope(C, g)
            cofactor, j = r.den.remove(p)
    while r and r.num.degree >= d - 1:
        # at infinity: ((B x^j) s)' s = (j + d/2) B x^(j + d - 1) + ...
        j = r.num.degree - d + 1
        C = RatFunc(field.poly([*[0] * j, 1]) * r.num.lc * (1 / (j + Fraction(d, 2))))
        exact = exact + C
        r = r - _twisted_slope(C, g)
    return CurveIntegral(g, exact, residues, r.num)


def _twisted_slope(C: RatFunc, g: Poly) -> RatFunc:
    """(C s)' s."""
    return C.derivative() * g + C * g.derivative() * Fraction(1, 2)


def unit(g: Poly, residue: Residue) -> Unit | None:
    """The unit of one residue on a curve of genus 0, None if rho(a)^2/g(a) isn't constant."""
    tau_squared = _tau_squared(g, residue)
    if tau_squared is None:
        return None
    p = residue.factor
    T = -g * residue.value.inverse_modulo(p) % p
    square = p * p
    T = (T + (g * tau_squared - T * T) * (T * 2).inverse_modulo(square)) % square  # Newton's step from p to p^2
    return Unit(*_euclid(T, square), p, tau_squared)


def _tau_squared(g: Poly, residue: Residue) -> Poly | None:
    """gamma/rho^2, if it is the same constant at all roots."""
    inverse = residue.value.inverse_modulo(residue.factor)
    square = g * inverse * inverse % residue.factor
    return None if square.degree > 0 else square[0]


def gathered_zeros(g: Poly, r: RatFunc, kappa_squared: Poly, P: Poly) -> Unit | None:
    """A + B kappa s with the zeros of y+ at P, for y+-'/y+- = ... +- kappa r/s on a curve of genus 0.

    `p` of the result is P, or P (x - c) with a branch point c where the degree must be made even.  None if there is no such
    point in K, or the zeros of P aren't of this kind.
    """
    if P.degree <= 0 or g.degree > 2 or r.den % P:
        return None
    T = r.num * kappa_squared * 2 * (r.den // P * P.derivative()).inverse_modulo(P) % P
    p = P
    if P.degree % 2 and g.degree == 2:
        branch = g.field.factor(g)[0][0]
        if branch.degree > 1:
            return None
        T = T * branch.inverse_modulo(P) % P * branch
        p = P * branch
    found = Unit(*_euclid(T, p), p, kappa_squared, Fraction(1))
    return found if found.norm(g).monic() == p.monic() else None


def _euclid(T: Poly, p: Poly) -> tuple[Poly, Poly]:
    """A and B of (3)."""
    return next((-A, B) for A, B in remainders(T, p) if 2 * A.degree <= p.degree)


FIRST_KIND = "it has no logarithmic part on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
SECOND_KIND = (
    "it has a pole of the second kind at infinity on the curve s^2 = {g} of genus {genus}, so it isn't elementary"
)
NOT_TORSION = "its poles on the curve s^2 = {g} of genus {genus} don't form a torsion divisor, so it isn't elementary"
SEVERAL = "its residues on the curve s^2 = {g} of genus {genus} aren't rational multiples of one another; not decided"
UNDECIDED_CURVE = "no function with its poles on the curve s^2 = {g} of genus {genus} was found within the limits"


def completed(integral: CurveIntegral) -> CurveIntegral:
    """The integral with its units if it is elementary on a curve of positive genus, else with the reason why it is left."""
    if integral.is_elementary:
        return integral
    found = _decide(integral)
    if isinstance(found, str):
        g = integral.g
        return replace(integral, reason=found.format(g=g, genus=(g.degree - 1) // 2))
    return replace(integral, units=found)


def _decide(integral: CurveIntegral) -> tuple[Unit, ...] | str:
    g = integral.g
    middle = Fraction(g.degree, 2) - 1
    at_infinity = integral.rest[int(middle)] if middle.denominator == 1 else g[0] * 0
    if integral.rest.degree > middle:
        return SECOND_KIND
    if not integral.residues and not at_infinity:
        return FIRST_KIND
    tau_squared = _common_tau(integral, at_infinity)
    if tau_squared is None:
        return SEVERAL
    kappa_squared = tau_squared * Fraction(1, 16)
    r = integral.without_exact
    phi = logarithmic_derivative(g) / 2 - r.derivative() / r
    S = phi.derivative() / 2 + phi * phi / 4 + r * r / g * kappa_squared
    # The form f: its zeros at ordinary points, where a residue belongs to the exponents 0 and 1, are P's.
    P = phi.den // phi.den.gcd(S.den)
    form = SemiInvariant(2, phi - logarithmic_derivative(P), P)
    group = imprimitive_group(analyse(S, Budget()), form)
    if group.kind is GroupKind.INFINITE_DIHEDRAL:
        return NOT_TORSION
    if group.kind is not GroupKind.DICYCLIC or group.function is None:
        return UNDECIDED_CURVE
    return _logarithms_of_pieces(integral, group.function, kappa_squared)


def _common_tau(integral: CurveIntegral, at_infinity: Poly) -> Poly | None:
    """tau^2 if every residue is a rational multiple of 1/tau, else None."""
    values = [_tau_squared(integral.g, residue) for residue in integral.residues]
    if at_infinity:
        values.append((at_infinity * at_infinity).inverse())
    first = values[0]
    if first is None or any(value is None or rational_square_root(value / first) is None for value in values):
        return None
    return first


def _logarithms_of_pieces(integral: CurveIntegral, f: CurveFunction, kappa_squared: Poly) -> tuple[Unit, ...] | str:
    """The logarithms of the pieces a + b y of f as those of a + b c kappa s: y = c kappa s, c a constant up to its sign."""
    c = f.h.field.sqrt((f.h.lc / kappa_squared[0]) / integral.g.lc)
    if c is None:
        return UNDECIDED_CURVE
    exponents: Counter[tuple[Poly, Poly]] = Counter()
    for piece in f.pieces:
        exponents[piece.a, piece.b] += piece.exponent
    for sign in (c, -c):
        found = tuple(
            Unit(a, b * sign, None, kappa_squared, Fraction(e, 2 * f.multiple)) for (a, b), e in exponents.items()
        )
        if integral.slope_of_units(found) == integral.without_exact:
            return found
    return UNDECIDED_CURVE
