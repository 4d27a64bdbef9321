"""The positive claim: a form in the solutions, and the polynomial of omega that belongs to it.

F = exp(int theta) P, theta = R/D, is a form of degree m in the solutions of y'' = S y exactly when the polynomials

    (k + 1) A_(k+1) = D A_k' + (R - k D') A_k - (m - k + 1) S D^2 A_(k-1),    A_0 = P,    A_(-1) = 0,             (1)

end with A_(m+1) = 0.  Then M(W) = sum_k (-1)^k e_k W^(m-k), e_k = A_k / (P D^k), is the product of W - l'/l over the linear
factors l of F: its roots solve W' + W^2 = S, and their sum e_1 is theta + P'/P = F'/F.  F is a rational function exactly when
theta has simple poles with integer residues only.
"""

from __future__ import annotations

from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.decision import SemiInvariant
from kovacic.verify.factors import factors_of, quotient


def form_numerators(S: RatFunc, F: SemiInvariant, D: Poly) -> list[Poly] | None:
    """A_0, ..., A_m of (1) if F is a form of its degree m in the solutions of y'' = S y, with the denominator D; else None."""
    if not D or not F.P or F.degree < 1:
        return None
    T = (S.num * D * D).exact_quotient(S.den)  # S D^2
    R = (F.theta.num * D).exact_quotient(F.theta.den)
    if T is None or R is None:
        return None
    A = [F.P, D * F.P.derivative() + R * F.P]
    for k in range(1, F.degree + 1):
        R = R - D.derivative()
        following = D * A[k].derivative() + R * A[k] - T * A[k - 1] * (F.degree - k + 1)
        A.append(following / (k + 1))
    return None if A.pop() else A


def rational_residues(theta: RatFunc) -> list[tuple[Poly, Fraction]] | None:
    """The irreducible factors of the denominator with the residues of theta dx at their roots, all of them rational.

    None if there is another pole, also at infinity, or another residue.
    """
    if theta.num and theta.num.degree >= theta.den.degree:
        return None
    residues = []
    for p, _ in factors_of(theta.den):
        # At the roots of p it is num/den', if these are simple poles.
        num = theta.num % p
        slope = theta.den.derivative() % p
        if not slope:
            return None
        residue = quotient(num[slope.degree], slope.lc)
        rational = p.field.rational_value(residue) if num == residue * slope else None
        if rational is None:
            return None
        residues.append((p, rational))
    return residues


def is_rational(F: SemiInvariant) -> bool:
    """True if exp(int theta) P is a rational function."""
    residues = rational_residues(F.theta)
    return residues is not None and all(residue.denominator == 1 for _, residue in residues)


def is_power(F: SemiInvariant, f: SemiInvariant) -> bool:
    """True if F is a power of f, up to a constant, by its theta, P and degree."""
    n, rest = divmod(F.degree, max(f.degree, 1))
    if rest or F.theta.den != f.theta.den:
        return False
    return F.theta.num == n * f.theta.num and f.P**n == F.P


def is_normal_form(S: RatFunc, gauge: RatFunc, a: RatFunc, b: RatFunc, c: RatFunc) -> bool:
    """True if y'' = S y is the normal form of a y'' + b y' + c y = 0, with this gauge rho.

    y = v exp(int rho dx), rho = -b/(2a), turns a y'' + b y' + c y = 0 into v'' = S v with S = (b/a)'/2 + (b/a)^2/4 - c/a
    [Kovacic 1986, section 1.1].  For polynomials a, b, c, which common factors don't change, that is

        4 a^2 num(S) = den(S) (2 (b' a - b a') + b^2 - 4 a c),    2 a num(rho) = -b den(rho).
    """
    A, B, C = over_one_denominator((a, b, c))
    wanted = (B.derivative() * A - B * A.derivative()) * 2 + B * B - A * C * 4
    is_S = A * A * 4 * S.num == S.den * wanted
    return is_S and A * gauge.num * 2 == -B * gauge.den
