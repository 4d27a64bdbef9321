"""The positive claim: a form in the solutions, and the polynomial of omega that belongs to it.

F = exp(int theta) P, theta = R/D, is a form of degree m in the solutions of y'' = S y exactly when the polynomials

    (k + 1) A_(k+1) = D A_k' + (R - k D') A_k - (m - k + 1) S D^2 A_(k-1),    A_0 = P,    A_(-1) = 0,             (1)

end with A_(m+1) = 0.  Then M(W) = sum_k (-1)^k e_k W^(m-k), e_k = A_k / (P D^k), is the product of W - l'/l over the linear
factors l of F: its roots solve W' + W^2 = S, and their sum e_1 is theta + P'/P = F'/F.  F is a rational function exactly when
theta has simple poles with integer residues only.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import SemiInvariant
from kovacic.limits import check_time


def form_numerators(S: RatFunc, F: SemiInvariant, D: Poly) -> list[Poly] | None:
    """A_0, ..., A_m of (1) if F is a form of its degree m in the solutions of y'' = S y, with the denominator D; else None."""
    T = (S.num * D * D).exact_quotient(S.den) if D else None
    R = (F.theta.num * D).exact_quotient(F.theta.den)
    if T is None or R is None or not F.P or F.degree < 1:
        return None
    A, slope = [F.P, D * F.P.derivative() + R * F.P], D.derivative()
    for k in range(1, F.degree + 1):
        check_time()
        R = R - slope
        A.append((D * A[k].derivative() + R * A[k] - T * A[k - 1] * (F.degree - k + 1)) / (k + 1))
    return None if A.pop() else A


def rational_residues(theta: RatFunc, factors: Iterable[Poly] = ()) -> list[tuple[Poly, Fraction]] | None:
    """The irreducible factors of the denominator with the residues at their roots, for simple poles and rational residues.

    None if there is another pole, also at infinity (theta dx), or another residue.  Some `factors` may be known.
    """
    num, den, residues = theta.num, theta.den, []
    if num and num.degree >= den.degree:
        return None
    field, slope, rest, found = den.field, den.derivative(), den, []
    for p in factors:
        if (quotient := rest.exact_quotient(p)) is not None:
            rest = quotient
            found.append(p)
    for p in [*found, *(p for p, _ in (field.factor(rest) if rest.degree else []))]:
        above, below = num % p, slope % p
        residue = above[below.degree] / below.lc if below else None
        rational = None if residue is None or above != residue * below else field.rational_value(residue)
        if rational is None:
            return None
        residues.append((p, rational))
    return residues


def is_rational(F: SemiInvariant, factors: Iterable[Poly] = ()) -> bool:
    """Is exp(int theta) P a rational function?  Some `factors` of the denominator of theta may be known."""
    residues = rational_residues(F.theta, factors)
    return residues is not None and all(residue.denominator == 1 for _, residue in residues)


def is_power(F: SemiInvariant, f: SemiInvariant) -> bool:
    """Is F a power of f, up to a constant, as its theta, P and degree show?"""
    n, rest = divmod(F.degree, max(f.degree, 1))
    same = not rest and F.theta.den == f.theta.den and F.theta.num == f.theta.num * n
    return same and f.P**n == F.P
