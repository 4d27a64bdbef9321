"""Integrals int r dx / sqrt(g) on the curve s^2 = g: reduced to simple poles, and done where the genus is 0.

g is monic and squarefree of degree d, r in K(x).  Hermite's reduction on the curve gives

    r/s = (C s)' + (sum over simple poles a of rho(a)/(x - a) + rest)/s,     rest a polynomial of degree <= d - 2.    (1)

For d <= 2 every term is elementary.  With gamma = g(a) and the tangent L = gamma + g'(a) (x - a)/2,

    L^2 - gamma g = (g'(a)^2/4 - gamma g''/2) (x - a)^2,    int dx/((x - a) s) = -log((L + sqrt(gamma) s)/(x - a))/sqrt(gamma),
    int dx/s = log(g'/2 + s)                                (d = 2).                                                (2)

For d >= 3 the integral is elementary only if a divisor on the Jacobian is a torsion point: see `kovacic.closed_form.torsion`.

Functions A + B t on a curve t^2 = tau^2 g of genus 0 (or with a torsion divisor) gather many conjugate points.
Points over the roots a of a polynomial p are given by T in K[x]/p: t = T(a) there, T^2 = tau^2 g mod p.  A + B t vanishes at
these points, and only there, if

    A + B T = 0 mod p,      deg A <= deg p/2,      A^2 - tau^2 B^2 g = constant * p,                                       (3)

and such A and B come from Euclid's algorithm for p and T, in K[x], whatever the degree of p: no root is needed.  For g of
degree 2 the degree of p must be even, as the poles at the two points at infinity must be of the same order.

- `unit`: with p^2 for p the points count twice, which is the sum of logarithms over the roots in (2) if rho(a)^2/g(a) is the
  same constant 1/tau^2 at all of them; T = -g/rho.
- `gathered_zeros`: at the zeros of y+ y-, kappa r dx/s has the residues +-1/2, so that T = 2 kappa^2 rho, tau = kappa.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from kovacic.algebra.partial_fractions import Residue, residue
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Unit:
    """The contribution factor * log((A + B tau s)/sqrt(norm))/tau to an integral; tau^2 = `tau_squared`, a constant of K.

    p is a square root of the norm up to a constant; None where it isn't known to be a square.
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
        A = self.A
        B = self.B
        top = (B.derivative() * g + B * g.derivative() * Fraction(1, 2)) * A - A.derivative() * B * g
        return RatFunc(top, self.norm(g)) * self.factor


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
        g = self.g
        C = self.exact
        total = C.derivative() * g + C * g.derivative() * Fraction(1, 2) + self.rest
        return sum((residue.logarithmic for residue in self.residues), total)

    @property
    def without_exact(self) -> RatFunc:
        """The integrand without the derivative of the exact part."""
        return replace(self, exact=self.exact * 0).integrand

    @property
    def kernel_derivative(self) -> RatFunc:
        """That of 1/s, over it."""
        return RatFunc(self.g.derivative(), self.g) * Fraction(-1, 2)

    @property
    def is_elementary(self) -> bool:
        """Does (2) give the integral?  False says nothing for genus 1 and higher."""
        return self.g.degree <= 2 or (not self.residues and not self.rest)

    def radicand(self, residue: Residue) -> Poly:
        """gamma = g(a) as an element of K[a]/p."""
        return self.g % residue.factor


def integrate_on_curve(r: RatFunc, g: Poly) -> CurveIntegral:
    """int r dx/sqrt(g) for a monic squarefree g.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> done = integrate_on_curve(1 / x**2, QQ.poly([1, 0, 1]))  # -sqrt(x^2 + 1)/x
    >>> print(done.exact, len(done.residues), done.rest)
    -1/x 0 0
    """
    reduction = _Reduction(r, g.over(r.field))
    factors = r.field.factor(r.den) if r.den.degree > 0 else []
    for p, multiplicity in factors:
        if reduction.g % p:
            reduction.at_a_pole(p, multiplicity)
        else:
            reduction.at_a_branch_point(p, multiplicity)
    reduction.at_infinity()
    return CurveIntegral(reduction.g, reduction.exact, tuple(reduction.residues), reduction.r.num)


class _Reduction:
    """Hermite's reduction (1) on its way: r is what is left of r, less the derivatives of `exact` and the simple poles.

    ((B/p^j) s)' s has the leading term (1/2 - j) B p' u/p^j for g = p u, and -j B p' g/p^(j+1) for p prime to g.
    """

    def __init__(self, r: RatFunc, g: Poly) -> None:
        self.r = r
        self.g = g
        self.exact = RatFunc(g.field.poly([]))
        self.residues: list[Residue] = []

    def at_a_branch_point(self, p: Poly, multiplicity: int) -> None:
        """Nothing is left of poles at zeros of g."""
        inverse = _inverse_slope(p, self.g // p)
        for j in range(multiplicity, 0, -1):
            B = self._leading(p, order=j) * inverse % p
            self._take(RatFunc(B * (1 / (Fraction(1, 2) - j)), p**j))

    def at_a_pole(self, p: Poly, multiplicity: int) -> None:
        """A simple pole is left of other poles."""
        inverse = _inverse_slope(p, self.g)
        for j in range(multiplicity - 1, 0, -1):
            B = self._leading(p, order=j + 1) * inverse % p
            self._take(RatFunc(B * Fraction(-1, j), p**j))
        if not self.r.den % p:
            self.residues.append(Residue(p, residue(self.r, p)))
            self.r = self.r - self.residues[-1].logarithmic

    def at_infinity(self) -> None:
        """Of the polynomial the degree falls below d - 1; the leading term of ((B x^j) s)' s is (j + d/2) B x^(j+d-1)."""
        x = self.g.field.poly([0, 1])
        d = self.g.degree
        while self.r.num.degree >= d - 1 and self.r:
            j = self.r.num.degree - d + 1
            self._take(RatFunc(x**j * self.r.num.lc * (1 / (j + Fraction(d, 2)))))

    def _leading(self, p: Poly, *, order: int) -> Poly:
        """The coefficient of p^-order, modulo p, where r has no pole of a higher order at the roots of p."""
        cofactor, count = self.r.den.remove(p)
        if count < order:
            return p * 0
        return self.r.num * cofactor.inverse_modulo(p) % p

    def _take(self, C: RatFunc) -> None:
        """r less the derivative of C s, times s."""
        self.exact = self.exact + C
        self.r = self.r - C.derivative() * self.g - C * self.g.derivative() * Fraction(1, 2)


def _inverse_slope(p: Poly, unit: Poly) -> Poly:
    """1/(p' unit) modulo p."""
    return (p.derivative() * (unit % p)).inverse_modulo(p)


def unit(g: Poly, residue: Residue) -> Unit | None:
    """The unit of one residue on a curve of genus 0, None if rho(a)^2/g(a) isn't constant."""
    p = residue.factor
    rho = residue.value
    gamma = g % p
    inverse = rho.inverse_modulo(p)
    tau_squared = gamma * inverse * inverse % p
    if tau_squared.degree > 0:
        return None
    T = -gamma * inverse % p
    square = p * p
    T = (T + (g * tau_squared[0] - T * T) * (T * 2).inverse_modulo(square)) % square  # Newton's step from p to p^2
    return Unit(*_euclid(T, square), p, tau_squared[0])


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
        branch = next((line for line, _ in g.field.factor(g) if line.degree == 1), None)
        if branch is None:
            return None
        T = T * branch.inverse_modulo(P) % P * branch
        p = P * branch
    found = Unit(*_euclid(T, p), p, kappa_squared, Fraction(1))
    if found.norm(g).monic() != p.monic():
        return None
    return found


def _euclid(T: Poly, p: Poly) -> tuple[Poly, Poly]:
    """A and B of (3)."""
    A = T % p
    B = p.field.poly([-1])
    before = (p, p.field.poly([]))  # the pair (A, B) of the step before
    while 2 * A.degree > p.degree:
        scale = A.lc.inverse()  # else the coefficients become long
        A = A * scale
        B = B * scale
        quotient, remainder = divmod(before[0], A)
        next_B = before[1] - quotient * B
        before = (A, B)
        A = remainder
        B = next_B
    return -A, -B
