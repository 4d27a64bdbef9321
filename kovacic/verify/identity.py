"""The positive claim: a monic polynomial M(W) over K'(x) whose roots solve W' + W^2 = S.

M is right exactly when dM/dx + (S - W^2) dM/dW = 0 modulo M, in other words, with
M = sum_k (-1)^k e_k W^(m-k), e_0 = 1,

    (k + 1) e_(k+1) = e_k' + e_1 e_k - (m - k + 1) S e_(k-1)   for k = 0, ..., m, e_(m+1) = 0.                   (1)

The certificate gives e_k = A_k / (P D^k) with polynomials, A_0 = P.  Cleared of denominators (1) reads

    P ((k + 1) A_(k+1) - D A_k' + k D' A_k + (m - k + 1) S D^2 A_(k-1)) = A_k (A_1 - D P'),                      (2)

which is trivial for k = 0.
"""

from __future__ import annotations

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import RiccatiPolynomial


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
