"""The Galois group, recomputed from S and from a decision whose forms and polynomial of omega have been checked.

Reducible, omega = theta + P'/P: y1^n is rational exactly when n theta has simple poles with integer residues.
- There is no rational form of degree 2: omega is unique, and the group {(c, b; 0, 1/c)}, c^n = 1 or any c.
- There is one, F = y1 y2 with different factors: the group is diagonal, mu_n or G_m.
- F = y1^2: y2 = y1 int dx/F, which lies in C(x, y1) exactly when 1/F has no residue at a pole of S (at ordinary points y2 is
  analytic).
Imprimitive, f = y1 y2, g = f^2 = prod p^(e_p) P^2: an irregular point, or an irrational exponent difference, makes the group
infinite; forms with different f over one field belong to the quaternion group.  Otherwise u = y1/y2 = exp(int eta), where
eta = dx/sqrt(g) up to a constant has simple poles with residues +-Delta at the points with e = 2 on the curve z^2 = g.  On
a curve of genus 0 the group is dicyclic of order 4n, n the common denominator l of these Delta; on others it is infinite if
there are none.  If there are, the order 4n rests on a rational form of degree 2n that isn't f^n, and on the absence of
such forms of the degrees 2n/q, q prime.  An infinite group rests on two orders of the divisor of l eta modulo primes; or on
one, k, and the absence of forms of degree 2 l k, which a finite group would have: see `torsion`.

References: Kovacic 1986, sections 1 and 4; Hendriks & van der Put, J. Symb. Comp. 19 (1995).
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from flint import fmpz

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, GroupClaim, SemiInvariant, Structure
from kovacic.verify.evidence import Inspector
from kovacic.verify.identity import form_numerators, is_rational, rational_residues
from kovacic.verify.residue import residue
from kovacic.verify.torsion import order_holds


def group_holds(inspector: Inspector, decision: Decision, claim: GroupClaim) -> bool | None:
    """Is this the group?  None for one of which no more is said than that it is imprimitive, where that doesn't decide it."""
    structure = decision.structure
    if structure is Structure.REDUCIBLE:
        return _reducible(inspector, decision, decision.invariant or claim.form) == (claim.family, claim.n)
    if structure is Structure.IMPRIMITIVE:
        return _imprimitive(inspector, decision, claim)
    name = "SL2" if structure is None else structure.value
    return decision.undecided is None and (claim.family, claim.n) == (name, None)


def _reducible(inspector: Inspector, decision: Decision, F: SemiInvariant | None) -> tuple[str, int | None] | None:
    """The family and n, by a rational form F of degree 2; None if the decision doesn't prove enough."""
    form, riccati = decision.semi_invariant, decision.riccati
    if form is None or riccati is None:
        return None
    residues = rational_residues(form.theta)
    n = None if residues is None else lcm(1, *(value.denominator for _, value in residues))
    if F is None:
        if not inspector.dimension_is_at_most(0, 2):
            return None
        return ("borel", None) if n is None else ("additive", n)
    A = form_numerators(inspector.S, F, riccati.D) if F.degree == 2 and is_rational(F) else None
    if A is None:
        return None
    if A[1] * A[1] == 4 * A[0] * A[2]:  # F'^2 - 2 F F'' + 4 S F^2 = 0: F = y1^2
        return ("cyclic" if _inverse_has_an_integral(inspector, F) else "additive", n)
    return ("multiplicative", None) if n is None else ("cyclic", n)


def _inverse_has_an_integral(inspector: Inspector, F: SemiInvariant) -> bool:
    """Has 1/F no residue at the poles of S (and so none at infinity), for a rational F?"""
    num, den = F.P, F.P * 0 + 1
    for p, value in rational_residues(F.theta) or []:
        num, den = num * p ** max(int(value), 0), den * p ** max(-int(value), 0)
    for point in inspector.points[:-1]:
        rest, order = num.remove(point.factor)
        if order:
            modulus = point.factor**order
            if residue(den * rest.inverse_modulo(modulus) % modulus, point.factor, order):
                return False
    return True


def _imprimitive(inspector: Inspector, decision: Decision, claim: GroupClaim) -> bool | None:
    points, f, riccati = inspector.points, decision.semi_invariant, decision.riccati
    if f is None or riccati is None:
        return False
    if any(point.order > 2 or point.difference is None for point in points):
        return (claim.family, claim.n) == ("infinite dihedral", None)
    if f.P.field != inspector.S.field:  # its conjugates are further forms: three pairs of lines are permuted
        phi = f.logarithmic_derivative
        return (claim.family, claim.n) == ("dicyclic", 2) and any((*phi.num.parts[1:], *phi.den.parts[1:]))
    residues = dict(rational_residues(f.theta) or [])
    e = [2 * residues.pop(point.factor, Fraction(0)) for point in points[:-1]]
    e.append(4 - sum((k * point.factor.degree for k, point in zip(e, points, strict=False)), Fraction(2 * f.P.degree)))
    if residues or any(k.denominator > 1 for k in e):
        return False
    branches = sum(point.factor.degree for k, point in zip(e, points, strict=True) if k % 2)
    differences = {point.difference or Fraction(0) for k, point in zip(e, points, strict=True) if k == 2}
    differences |= {Fraction(1)} if f.P.degree else set()
    n = lcm(1, *(difference.denominator for difference in differences))
    if branches == 2:  # genus 0
        return (claim.family, claim.n) == ("dicyclic", n)
    if not differences:
        return (claim.family, claim.n) == ("infinite dihedral", None)
    if claim.family == "dicyclic" and claim.n is not None:
        return claim.n % n == 0 and _dicyclic(inspector, f, riccati.D, claim.form, claim.n)
    if claim.family == "infinite dihedral" and claim.n is None:
        A, B, C = riccati.numerators
        H, budget = RatFunc(B * B - 4 * A * C, (A * riccati.D) ** 2), inspector.budget
        if not claim.orders or not all(order_holds(H, differences, p, k, budget) for p, k in claim.orders):
            return False
        ks = {k for _, k in claim.orders}
        return len(ks) > 1 or all(inspector.dimension_is_at_most((n * k + 1) % 2, 2 * n * k) for k in ks)
    return None if claim.family == "imprimitive" else False


def _dicyclic(inspector: Inspector, f: SemiInvariant, D: Poly, form: SemiInvariant | None, n: int) -> bool:
    """Is there a rational form of degree 2n that isn't a multiple of f^n, and none for a proper divisor of n?"""
    if form is None or form.degree != 2 * n or not is_rational(form) or form_numerators(inspector.S, form, D) is None:
        return False
    if form.logarithmic_derivative == n * f.logarithmic_derivative:
        return False
    powers = (n // int(q) for q, _ in fmpz(n).factor())
    return all(inspector.dimension_is_at_most((k + 1) % 2, 2 * k) for k in powers)
