"""From a form in the solutions to the polynomial that omega = y'/y satisfies.

A form f of degree m in the solutions y1, y2 of y'' = S y with a rational logarithmic derivative is a semi-invariant of the
Galois group.  With E_0 = f and

    E_(k+1) = (E_k' - (m - k + 1) S E_(k-1)) / (k + 1),                                                          (1)

the product of (W - l'/l) over the linear factors l of f is sum_k (-1)^k (E_k/f) W^(m-k), and f is such a form exactly when
E_(m+1) = 0 [Kovacic 1986, sec. 4-5; Ulmer & Weil, J. Symb. Comp. 22 (1996)].  Here f = exp(int R/D) P with polynomials R and
P and with D of `places.Problem`; then E_k = exp(int R/D) A_k / D^k with polynomials A_k, A_0 = P and

    (k + 1) A_(k+1) = D A_k' + (R - k D') A_k - (m - k + 1) T A_(k-1),      T = S D^2.                            (2)

Symbols: Q = exp(int R/D); theta = R/D; phi = f'/f = theta + P'/P.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.factors import product
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Exclusion, SemiInvariant, Structure, TerminatingSeries
from kovacic.engine.places import Place, Problem


def numerators(D: Any, T: Any, R: Any, P: Any, m: int, last: int) -> list[Any]:
    """A_0, ..., A_last of equation (2), over the field or modulo a prime."""
    sequence = [P, D * P.derivative() + R * P]
    slope = D.derivative()
    for k in range(1, last):
        R = R - slope
        following = D * sequence[k].derivative() + R * sequence[k] - (m - k + 1) * (T * sequence[k - 1])
        sequence.append(following / (k + 1))
    return sequence


@dataclass(frozen=True)
class Form:
    """f = exp(int R/D) P of degree `degree` in the solutions; R and P lie over K or over K(c)."""

    degree: int
    R: Poly
    P: Poly

    def numerators(self, problem: Problem, last: int | None = None) -> list[Poly]:
        """A_0, ..., A_last of equation (2), by default A_(m+1), which is zero exactly when f is a form in the solutions."""
        count = self.degree + 1 if last is None else last
        return numerators(problem.D, problem.T, self.R, self.P, self.degree, count)

    def semi_invariant(self, problem: Problem) -> SemiInvariant:
        """The form as the data of a claim, with theta = R/D."""
        return SemiInvariant(self.degree, RatFunc(self.R, problem.D), self.P)

    def is_form(self, problem: Problem) -> bool:
        """True if this is a form in the solutions of the equation: A_(m+1) = 0."""
        return not self.numerators(problem)[-1]


@dataclass(frozen=True)
class Found:
    """The group has this structure.

    `form()` is the semi-invariant whose linear factors are the solutions with the omega that Kovacic's algorithm looks for;
    it is computed on demand.  `invariant` is the rational invariant that showed the structure, None if there was none.  Where
    the form would be too long it is a `series`.
    """

    structure: Structure
    form: Callable[[], Form] | None = None
    invariant: Form | None = None
    series: TerminatingSeries | None = None


Outcome = Found | tuple[Exclusion, ...]


def normalised(form: Form, problem: Problem) -> Form:
    """The form up to a constant, with P monic and prime to D: powers of the singular factors move from P into R."""
    R = form.R
    P = form.P.monic()
    D = problem.D.over(P.field)
    for place in problem.finite_places:
        # Over K(c) the factor of a place may split, and P may contain a part of it.
        problem.budget.check()
        factor = place.factor.over(P.field).gcd(P)
        while factor.degree > 0:
            problem.budget.check()
            P, k = P.remove(factor)
            R = R + k * (D // factor) * factor.derivative()
            factor = factor.gcd(P)
    return Form(form.degree, R, P)


def root_of_form(form: Form, n: int, problem: Problem) -> Form:
    """The form of degree m/n whose n-th power is the given one up to a constant.

    The caller knows that it exists; an AssertionError says that it doesn't.
    """
    form = normalised(form, problem)
    problem.budget.check()
    P = form.P.root(n)
    if P is None or form.degree % n:
        raise AssertionError("the form isn't a perfect power")
    return Form(form.degree // n, form.R / n, P)


def hessian(form: Form, problem: Problem) -> Form:
    """Hess(f) = (m-1) [m f (f'' - m S f) - (m-1) f'^2], of degree 2m - 4, up to the factor m - 1."""
    A0, A1, A2 = form.numerators(problem, 2)
    m = form.degree
    return Form(2 * m - 4, 2 * (form.R - problem.D.derivative()), 2 * m * A0 * A2 - (m - 1) * A1 * A1)


def jacobian(f: Form, g: Form, problem: Problem) -> Form:
    """Jac(f, g) = m f g' - n f' g, of degree m + n - 2."""
    # f' = A1/D and g' = B1/D, times exp(int R/D) of f and of g.
    A0, A1 = f.numerators(problem, 1)
    B0, B1 = g.numerators(problem, 1)
    R = f.R + g.R - problem.D.derivative()
    return Form(f.degree + g.degree - 2, R, f.degree * A0 * B1 - g.degree * A1 * B0)


def singular_part(problem: Problem, valuations: Sequence[int]) -> Poly:
    """R0 with Q0'/Q0 = R0/D for Q0 = prod p^(v_p)."""
    pairs = zip(problem.finite_places, valuations, strict=True)
    return sum((v * (problem.D // p.factor) * p.factor.derivative() for p, v in pairs), problem.field.zero)


def singular_factor(problem: Problem, R: Poly, power: int) -> Poly:
    """D^power / Q0 for Q0 = prod p^(v_p) with Q0'/Q0 = R/D, where no v_p exceeds power times the weight of p."""
    parts = (
        place.factor ** (power * place.weight - logarithmic_residue(problem, R, place))
        for place in problem.finite_places
    )
    return product([problem.field.one, *parts])


def logarithmic_residue(problem: Problem, R: Poly, place: Place) -> int:
    """The integer residue v of R/D at the roots of a factor p: R/D = v p'/p + something regular at p."""
    p = place.factor
    rest = R if place.weight == 1 else R.exact_quotient(p ** (place.weight - 1))
    if rest is None:
        raise AssertionError("the logarithmic derivative of a rational function has simple poles")
    rest = rest % p
    cofactor = problem.D // p**place.weight * p.derivative() % p
    value = rest[cofactor.degree] / cofactor.lc
    rational = problem.field.rational_value(value)
    if rest != cofactor * value or rational is None or rational.denominator != 1:
        raise AssertionError("the residues of the logarithmic derivative of a rational function are integers")
    return int(rational)
