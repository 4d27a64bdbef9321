"""The Galois group, recomputed from S and from a decision whose forms and polynomial of omega have been checked.

A claim is the name of a family with its parameter n.  What S and the decision say comes out as such a pair as well, one rule
after the other; only an imprimitive group on a curve of positive genus needs more than these, which its claim brings along.

References: Kovacic 1986, sections 1 and 4; Hendriks & van der Put, J. Symb. Comp. 19 (1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, GroupClaim, RiccatiPolynomial, SemiInvariant, Structure
from kovacic.verify.dihedral import has_holomorphic_rest, is_least_power
from kovacic.verify.division import inverse
from kovacic.verify.evidence import Inspector
from kovacic.verify.identity import form_numerators, is_rational, rational_residues
from kovacic.verify.residue import residue
from kovacic.verify.torsion import order_holds

#: The name of a family, as in `kovacic.galois.Kind`, and its parameter.
_Named = tuple[str, int | None]


def group_holds(inspector: Inspector, decision: Decision, claim: GroupClaim) -> bool | None:
    """Is this the group?  None for one of which no more is said than that it is imprimitive, where that doesn't decide it."""
    f = decision.semi_invariant
    riccati = decision.riccati
    if decision.undecided is not None:
        return False
    if f is None or riccati is None:  # there is no solution
        return (claim.family, claim.n) == ("SL2", None)
    if decision.structure is Structure.REDUCIBLE:
        F = decision.invariant or claim.form
        return _reducible(inspector, f, riccati, F) == (claim.family, claim.n)
    if decision.structure is Structure.IMPRIMITIVE:
        return _imprimitive(inspector, f, riccati, claim)
    return decision.structure is not None and (claim.family, claim.n) == (decision.structure.value, None)


# ------------------------------------------------------------------------------------------- reducible groups


def _reducible(
    inspector: Inspector, f: SemiInvariant, riccati: RiccatiPolynomial, F: SemiInvariant | None
) -> _Named | None:
    """The group of y1 = exp(int theta) P, by a rational form F of degree 2; None if there is less proof than that.

    y1^n is rational exactly when n theta has simple poles with integer residues.  Without a rational form of degree 2 omega is
    unique, and the group is {(c, b; 0, 1/c)}, c^n = 1 or any c.  If F = y1 y2 has different factors, the group is diagonal,
    mu_n or G_m; if F = y1^2, y2 = y1 int dx/F.
    """
    n = _common_denominator(f)
    if F is None:
        return _unipotent_by_any(n) if inspector.dimension_is_at_most(0, 2) else None
    if F.degree != 2 or not is_rational(F):
        return None
    A = form_numerators(inspector.S, F, riccati.D)
    if A is None:
        return None
    if A[1] * A[1] == 4 * A[0] * A[2]:  # F'^2 - 2 F F'' + 4 S F^2 = 0: F = y1^2
        family = "cyclic" if _inverse_has_an_integral(inspector, F) else "additive"
        return family, n
    return ("multiplicative", None) if n is None else ("cyclic", n)


def _unipotent_by_any(n: int | None) -> _Named:
    """The group of all (c, b; 0, 1/c) with c^n = 1, or with any c."""
    return ("borel", None) if n is None else ("additive", n)


def _common_denominator(f: SemiInvariant) -> int | None:
    """The least n for which f^n is rational; None if no power is."""
    residues = rational_residues(f.theta)
    if residues is None:
        return None
    return lcm(*(value.denominator for _, value in residues))


def _inverse_has_an_integral(inspector: Inspector, F: SemiInvariant) -> bool:
    """Does y1 int dx/F lie in C(x, y1) for F = y1^2: has 1/F no residue at the poles of S (and so none at infinity)?

    At the ordinary points y2 is analytic, so that 1/F has no residue there.
    """
    num, den = _as_quotient(F)
    for point in inspector.points[:-1]:
        rest, order = num.remove(point.factor)
        if order:
            modulus = point.factor**order
            if residue(den * inverse(rest, modulus) % modulus, point.factor, order):
                return False
    return True


def _as_quotient(F: SemiInvariant) -> tuple[Poly, Poly]:
    """Numerator and denominator of a rational form."""
    num = F.P
    den = F.P.field.poly([1])
    for p, value in rational_residues(F.theta) or []:
        if value > 0:
            num = num * p ** int(value)
        else:
            den = den * p ** int(-value)
    return num, den


# ------------------------------------------------------------------------------------------- imprimitive groups


@dataclass(frozen=True)
class FormCurve:
    """What the rules need of z^2 = g, g = f^2 for the form f = y1 y2, and eta = dx/z up to a constant, y1/y2 = exp(int eta).

    Local data in characteristic 0 only; the arithmetic of classes on such a curve modulo a prime is `torsion.Curve`.

    `branches` is the number of branch points, so that the genus is branches/2 - 1; `differences` has the exponent differences
    at the double zeros of g, which are the residues of eta, up to their signs: its only poles.
    """

    branches: int
    differences: frozenset[Fraction]

    @property
    def denominator(self) -> int:
        """The least l for which l eta has integer residues."""
        return lcm(*(difference.denominator for difference in self.differences))


def _imprimitive(inspector: Inspector, f: SemiInvariant, riccati: RiccatiPolynomial, claim: GroupClaim) -> bool | None:
    """The rules for f = y1 y2, in their order: the first one that concerns the group decides."""
    named = (claim.family, claim.n)
    if _has_monodromy_of_infinite_order(inspector):
        return named == ("infinite dihedral", None)
    if f.P.field != inspector.S.field:
        return named == ("dicyclic", 2) and _has_conjugates(f)
    curve = _curve(inspector, f)
    if curve is None:
        return False
    if curve.branches == 2:  # genus 0: y1/y2 is a product of powers of functions, with the exponents Delta
        return named == ("dicyclic", curve.denominator)
    if not curve.differences:  # a differential of the first kind, whose integral has periods
        return named == ("infinite dihedral", None)
    return _on_curve_of_positive_genus(inspector, riccati, claim, curve)


def _has_monodromy_of_infinite_order(inspector: Inspector) -> bool:
    """Is there an irregular point, or an irrational exponent difference?"""
    return any(point.order > 2 or point.difference is None for point in inspector.points)


def _has_conjugates(f: SemiInvariant) -> bool:
    """Does f'/f lie over no smaller field?  Then its conjugates are further forms: three pairs of lines are permuted."""
    phi = f.logarithmic_derivative
    return any((*phi.num.parts[1:], *phi.den.parts[1:]))


def _curve(inspector: Inspector, f: SemiInvariant) -> FormCurve | None:
    """None if the valuations of g = f^2 aren't whole numbers, or g has zeros or poles that aren't singular points.

    P has simple zeros at ordinary points, where the difference is 1.
    """
    valuations = _valuations_of_square(inspector, f)
    if valuations is None:
        return None
    pairs = [*zip(inspector.points, valuations, strict=True)]
    branches = sum(point.factor.degree for point, valuation in pairs if valuation % 2)
    differences = {point.difference for point, valuation in pairs if valuation == 2}
    if f.P.degree:
        differences.add(Fraction(1))
    return FormCurve(branches, frozenset(d for d in differences if d is not None))


def _valuations_of_square(inspector: Inspector, f: SemiInvariant) -> list[int] | None:
    """Of g = f^2 at all singular points, from the residues of theta; at infinity by their sum, 4 for a form of degree 4."""
    residues = dict(rational_residues(f.theta) or [])
    finite = inspector.points[:-1]
    valuations = [2 * residues.pop(point.factor, Fraction(0)) for point in finite]
    degree = sum(value * point.factor.degree for value, point in zip(valuations, finite, strict=True))
    valuations.append(Fraction(4 - 2 * f.P.degree) - degree)
    if residues or any(value.denominator > 1 for value in valuations):
        return None
    return [int(value) for value in valuations]


def _on_curve_of_positive_genus(
    inspector: Inspector, riccati: RiccatiPolynomial, claim: GroupClaim, curve: FormCurve
) -> bool | None:
    """The group is finite exactly when k l eta is the logarithmic differential of a function, for some k: the claim says which.

    None for a claim that leaves this open.
    """
    A, B, C = riccati.numerators
    H = RatFunc(B * B - 4 * A * C, (A * riccati.D) ** 2)  # (y1'/y1 - y2'/y2)^2
    if claim.family == "dicyclic" and claim.n is not None:
        return claim.function is not None and is_least_power(H, claim.function, claim.n)
    if claim.family == "infinite dihedral" and claim.n is None:
        if claim.function is not None:
            return has_holomorphic_rest(H, claim.function)
        return _is_no_torsion(H, claim.orders, curve)
    return None if claim.family == "imprimitive" else False


def _is_no_torsion(H: RatFunc, orders: tuple[tuple[int, int], ...], curve: FormCurve) -> bool:
    """Has the divisor of l eta different orders modulo two primes of good reduction?  A finite order is the same modulo all."""
    residues = set(curve.differences)
    if len({k for _, k in orders}) < 2:
        return False
    return all(order_holds(H, residues, p, k) for p, k in orders)
