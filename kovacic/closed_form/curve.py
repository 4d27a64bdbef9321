"""Integrals int r dx / sqrt(g) on the curve s^2 = g: reduced to simple poles, and done where the genus is 0.

g is monic and squarefree of degree d, r in K(x).  Hermite's reduction on the curve gives

    r/s = (C s)' + (sum over simple poles a of rho(a)/(x - a) + rest)/s,     rest a polynomial of degree <= d - 2.    (1)

For d <= 2 every term is elementary.  With gamma = g(a) and the tangent L = gamma + g'(a) (x - a)/2,

    L^2 - gamma g = (g'(a)^2/4 - gamma g''/2) (x - a)^2,    int dx/((x - a) s) = -log((L + sqrt(gamma) s)/(x - a))/sqrt(gamma),
    int dx/s = log(g'/2 + s)                                (d = 2).                                                (2)

For d >= 3 the integral is elementary only if a divisor on the Jacobian is a torsion point: see `kovacic.closed_form.torsion`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.partial_fractions import Residue, residue
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.units import Unit


@dataclass(frozen=True)
class CurveIntegral:
    """int r dx/sqrt(g) as in (1): `exact` is C, `residues` the simple poles, `rest` the polynomial of degree <= d - 2.

    For d >= 3 `unit` is the logarithm that everything but the exact part amounts to, or `reason` says why it is left.
    """

    g: Poly
    exact: RatFunc
    residues: tuple[Residue, ...]
    rest: Poly
    unit: Unit | None = None
    reason: str | None = None

    @property
    def integrand(self) -> RatFunc:
        """r, recomputed from the result by equation (1)."""
        g, C = self.g, self.exact
        total = C.derivative() * g + C * g.derivative() * Fraction(1, 2) + self.rest
        return sum((residue.logarithmic for residue in self.residues), total)

    @property
    def kernel_derivative(self) -> RatFunc:
        """That of 1/s, over it."""
        return RatFunc(self.g.derivative(), self.g) * Fraction(-1, 2)

    @property
    def rational_part(self) -> RatFunc | None:
        """C g, if the integral is C s = C g/s; else None."""
        return None if self.residues or self.rest else self.exact * self.g

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
    field = r.field
    g = g.over(field)
    slope = g.derivative()
    exact = RatFunc(field.poly([]))
    residues = []

    def reduce(r: RatFunc, C: RatFunc) -> RatFunc:
        return r - C.derivative() * g - C * slope * Fraction(1, 2)

    for p, multiplicity in field.factor(r.den) if r.den.degree > 0 else []:
        branch = not g % p
        # ((B/p^j) s)' s has the leading term (1/2 - j) B p' u/p^j for g = p u, and -j B p' g/p^(j+1) for p prime to g.
        unit = (g // p if branch else g) % p
        inverse = (p.derivative() * unit).inverse_modulo(p)
        for k in range(multiplicity, 0 if branch else 1, -1):
            j = k if branch else k - 1
            cofactor, count = r.den.remove(p)
            if count < k:
                continue
            leading = r.num * cofactor.inverse_modulo(p) % p
            scale = Fraction(1, 2) - j if branch else Fraction(-j)
            C = RatFunc(leading * inverse % p * (1 / scale), p**j)
            exact, r = exact + C, reduce(r, C)
        if not branch and not r.den % p:
            residues.append(Residue(p, residue(r, p)))
            r = r - residues[-1].logarithmic
    rest = r.num
    x, d = field.poly([0, 1]), g.degree
    while rest.degree >= d - 1 and rest:
        j = rest.degree - d + 1
        C = RatFunc(x**j * rest.lc * (1 / (j + Fraction(d, 2))))
        exact, rest = exact + C, reduce(RatFunc(rest), C).num
    return CurveIntegral(g, exact, tuple(residues), rest)
