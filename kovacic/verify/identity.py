"""The positive claim: a monic polynomial M(W) over K'(x) whose roots solve W' + W^2 = S.

M is right exactly when dM/dx + (S - W^2) dM/dW = 0 modulo M, in other words, with
M = sum_k (-1)^k e_k W^(m-k), e_0 = 1,

    (k + 1) e_(k+1) = e_k' + e_1 e_k - (m - k + 1) S e_(k-1)   for k = 0, ..., m, e_(m+1) = 0.                   (1)

The certificate gives e_k = A_k / (P D^k) with polynomials, A_0 = P.  Cleared of denominators (1) reads

    P ((k + 1) A_(k+1) - D A_k' + k D' A_k + (m - k + 1) S D^2 A_(k-1)) = A_k (A_1 - D P'),                      (2)

which is trivial for k = 0.

A form F = exp(int R/D) P of degree m in the solutions has e_k F = exp(int R/D) A_k/D^k with

    (k + 1) A_(k+1) = D A_k' + (R - k D') A_k - (m - k + 1) S D^2 A_(k-1),    A_0 = P,    A_(m+1) = 0,             (3)

and conversely.  It is a rational function exactly when R/D has simple poles with integer residues only.
"""

from __future__ import annotations

from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import RiccatiPolynomial, SemiInvariant


def solves_riccati(S: RatFunc, M: RiccatiPolynomial) -> bool:
    """Does identity (2) hold for k = 1, ..., m?  Exact."""
    P, D, A, m = M.P, M.D, M.numerators, M.degree
    if m < 1 or not P or not D or A[0] != P:
        return False
    T = (S.num * D * D).exact_quotient(S.den)
    if T is None:
        return False
    slope = D.derivative()
    mixed = A[1] - D * P.derivative()
    # Where P divides `mixed`, as in every answer of the engine, (2) is an identity between small polynomials.
    quotient = mixed.exact_quotient(P)
    for k in range(1, m + 1):
        left = slope * A[k] * k - D * A[k].derivative() + T * A[k - 1] * (m - k + 1)
        if k < m:
            left = left + A[k + 1] * (k + 1)
        if quotient is not None:
            if left != A[k] * quotient:
                return False
        elif P * left != A[k] * mixed:
            return False
    return True


def form_numerators(S: RatFunc, F: SemiInvariant, D: Poly) -> list[Poly] | None:
    """A_0, ..., A_(m+1) of (3); None where D isn't a denominator for them, or F has no P or no degree."""
    T = (S.num * D * D).exact_quotient(S.den) if D else None
    R = (F.theta.num * D).exact_quotient(F.theta.den)
    if T is None or R is None or not F.P or F.degree < 1:
        return None
    slope = D.derivative()
    A = [F.P, D * F.P.derivative() + R * F.P]
    for k in range(1, F.degree + 1):
        following = D * A[k].derivative() + (R - k * slope) * A[k] - (F.degree - k + 1) * T * A[k - 1]
        A.append(following / (k + 1))
    return A


def rational_residues(theta: RatFunc) -> list[tuple[Poly, Fraction]] | None:
    """The irreducible factors of the denominator with the residues at their roots, for simple poles and rational residues.

    None if there is another pole, also at infinity (theta dx), or another residue.
    """
    num, den = theta.num, theta.den
    if num and num.degree >= den.degree:
        return None
    slope = den.derivative()
    if not num or den.gcd(slope).degree > 0:
        return [] if not num else None
    field, residues = den.field, []
    for p, _ in field.factor(den):
        above, below = num % p, slope % p
        residue = above[below.degree] / below.lc
        rational = field.rational_value(residue) if above == residue * below else None
        if rational is None:
            return None
        residues.append((p, rational))
    return residues


def is_rational_form(S: RatFunc, F: SemiInvariant, D: Poly) -> bool:
    """Is F a form of its degree in the solutions of y'' = S y, and a rational function?"""
    A, residues = form_numerators(S, F, D), rational_residues(F.theta)
    if A is None or A[-1] or residues is None:
        return False
    return all(residue.denominator == 1 for _, residue in residues)
