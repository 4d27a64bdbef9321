"""Functions A + B t on a curve t^2 = tau^2 g of genus 0 (or with a torsion divisor) that gather many conjugate points.

Points over the roots a of a polynomial p are given by T in K[x]/p: t = T(a) there, T^2 = tau^2 g mod p.  A + B t vanishes at
these points, and only there, if

    A + B T = 0 mod p,      deg A <= deg p/2,      A^2 - tau^2 B^2 g = constant * p,                                       (1)

and such A and B come from Euclid's algorithm for p and T, in K[x], whatever the degree of p: no root is needed.  For g of
degree 2 the degree of p must be even, as the poles at the two points at infinity must be of the same order.

- `unit`: with p^2 for p the points count twice, which is the sum of logarithms over the roots in equation (2) of
  `kovacic.closed_form.curve` if rho(a)^2/g(a) is the same constant 1/tau^2 at all of them; T = -g/rho.
- `gathered_zeros`: at the zeros of y+ y-, kappa r dx/s has the residues +-1/2, so that T = 2 kappa^2 rho, tau = kappa.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Unit:
    """The contribution factor * log((A + B tau s)/p)/tau to an integral; tau^2 = `tau_squared`, a constant of K."""

    A: Poly
    B: Poly
    p: Poly
    tau_squared: Poly
    factor: Fraction = Fraction(-1)

    def norm(self, g: Poly) -> Poly:
        """A^2 - tau^2 B^2 g."""
        return self.A * self.A - self.B * self.B * g * self.tau_squared

    def integrand(self, g: Poly) -> RatFunc:
        """r with r dx/s the derivative of the contribution, for a norm that is a constant times p^2."""
        A, B = self.A, self.B
        top = (B.derivative() * g + B * g.derivative() * Fraction(1, 2)) * A - A.derivative() * B * g
        return RatFunc(top, self.norm(g)) * self.factor

    def is_unit(self, g: Poly) -> bool:
        """Is the norm a constant times p^2?"""
        return self.norm(g).monic() == (self.p * self.p).monic()


def unit(g: Poly, residue: Residue) -> Unit | None:
    """The unit of one residue on a curve of genus 0, None if rho(a)^2/g(a) isn't constant."""
    p, rho = residue.factor, residue.value
    gamma = g % p
    inverse = rho.inverse_modulo(p)
    tau_squared = gamma * inverse * inverse % p
    if tau_squared.degree > 0:
        return None
    T, square = -gamma * inverse % p, p * p
    T = (T + (g * tau_squared[0] - T * T) * (T * 2).inverse_modulo(square)) % square  # Newton's step from p to p^2
    return Unit(*_euclid(T, square), p, tau_squared[0])


def gathered_zeros(g: Poly, r: RatFunc, kappa_squared: Poly, P: Poly) -> Unit | None:
    """A + B kappa s with the zeros of y+ at P, for y+-'/y+- = ... +- kappa r/s on a curve of genus 0.

    `p` of the result is P, or P (x - c) with a branch point c where the degree must be made even.  None if there is no such
    point in K, or the zeros of P aren't of this kind.
    """
    if P.degree <= 0 or g.degree > 2 or r.den % P:
        return None
    branch = [p for p, _ in g.field.factor(g) if p.degree == 1] if P.degree % 2 and g.degree == 2 else []
    if P.degree % 2 and g.degree == 2 and not branch:
        return None
    T = r.num * kappa_squared * 2 * (r.den // P * P.derivative()).inverse_modulo(P) % P
    p = P
    if branch:
        T, p = T * branch[0].inverse_modulo(P) % P * branch[0], P * branch[0]
    found = Unit(*_euclid(T, p), p, kappa_squared, Fraction(1))
    return found if found.norm(g).monic() == p.monic() else None


def _euclid(T: Poly, p: Poly) -> tuple[Poly, Poly]:
    """A and B of (1)."""
    field = p.field
    A, rest, B, other = T % p, p, field.poly([-1]), field.poly([])
    while 2 * A.degree > p.degree:
        scale = A.lc.inverse()  # else the coefficients become long
        A, B = A * scale, B * scale
        quotient, remainder = divmod(rest, A)
        A, rest, B, other = remainder, A, other - quotient * B, B
    return -A, -B
