"""Case 3: omega of degree 4, 6 or 12.  The equation is known to be irreducible and not imprimitive, and Fuchsian.

The binary tetrahedral, octahedral and icosahedral groups are told apart by their invariants of least degree: F6, F8, F12
[Klein; Singer & Ulmer, J. Symb. Comp. 16 (1993)].  The forms of Kovacic's degrees 4, 6, 12 are semi-invariants:
- icosahedral: F12 itself;
- octahedral: the square root of Hess(F8);
- tetrahedral: the cube root of T + sqrt(b) F6^2, where H = Hess(F6), T = Jac(F6, H), T^2 = a H^3 + b F6^4.
"""

from __future__ import annotations

from functools import partial

from kovacic.algebra.extension import adjoined_square_root
from kovacic.decision import Exclusion, NoInvariant, Structure
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Problem
from kovacic.engine.riccati import Form, Found, Outcome, hessian, jacobian, normalised, root, singular_factor

INVARIANT_DEGREE = {Structure.TETRAHEDRAL: 6, Structure.OCTAHEDRAL: 8, Structure.ICOSAHEDRAL: 12}


def decide(problem: Problem, structure: Structure) -> Outcome:
    """Find the omega of a primitive group, or exclude the group; the smaller ones must have been excluded before."""
    found = invariants(problem, INVARIANT_DEGREE[structure])
    if isinstance(found, NoInvariant):
        return (Exclusion(structure, (found,)),)
    if len(found) != 1:
        raise AssertionError("the least invariant of a primitive group is unique")
    return Found(structure, partial(_FORMS[structure], problem, found[0]), found[0])


def _tetrahedral(problem: Problem, F: Form) -> Form:
    """The cube root of T + sqrt(b) F^2 for F = F6.

    With F = Q0 P: H = Q0^2/D^2 P_H and T = Q0^3/D^3 P_T, so P_T^2 = a P_H^3 + b (G P^2)^2 with G = D^3/Q0.
    """
    H = hessian(F, problem)
    T = jacobian(F, H, problem)
    G = singular_factor(problem, F.R, 3) * F.P**2
    left = T.P**2
    first = H.P**3
    second = G**2
    # Two unknown constants: eliminate with the leading coefficients of the products with one another.
    n = max(first.degree, second.degree)
    rest = left * first[n] - first * left[n]
    pattern = second * first[n] - first * second[n]
    b = rest.lc / pattern.lc if rest else problem.field.poly([])
    if not b or rest != pattern * b:
        raise AssertionError("T^2 = a H^3 + b F^4 holds for the tetrahedral group")
    return root(Form(12, T.R, T.P + adjoined_square_root(problem.field, b) * G), 3, problem)


_FORMS = {
    Structure.TETRAHEDRAL: _tetrahedral,
    Structure.OCTAHEDRAL: lambda problem, F: root(hessian(F, problem), 2, problem),
    Structure.ICOSAHEDRAL: lambda problem, F: normalised(F, problem),
}
