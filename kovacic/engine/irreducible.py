"""Case 2: omega of degree 2, for an irreducible equation.

An imprimitive group permutes two lines, so (y1 y2)^2 is a rational invariant F of degree 4.  If the invariants of degree 4
have dimension 1, F is it.  Dimension 2 belongs to the quaternion group of order 8, which permutes three pairs of lines: the
squares F1 + lambda F2 are the members that are proportional to their Hessians, for three values of lambda.

Case 3: omega of degree 4, 6 or 12, for a Fuchsian equation that is neither reducible nor imprimitive.

The binary tetrahedral, octahedral and icosahedral groups are told apart by their invariants of least degree: F6, F8, F12
[Klein; Singer & Ulmer, J. Symb. Comp. 16 (1993)].  The forms of Kovacic's degrees 4, 6, 12 are semi-invariants:
- icosahedral: F12 itself;
- octahedral: the square root of Hess(F8);
- tetrahedral: the cube root of T + sqrt(b) F6^2, where H = Hess(F6), T = Jac(F6, H), T^2 = a H^3 + b F6^4.
"""

from __future__ import annotations

from functools import partial

from kovacic.algebra.extension import AlgebraicField, adjoined_square_root
from kovacic.algebra.poly import Poly
from kovacic.decision import Exclusion, NoInvariant, Structure
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Problem
from kovacic.engine.riccati import Form, Found, Outcome, hessian, jacobian, normalised, root_of_form, singular_factor


def decide_imprimitive(problem: Problem) -> Outcome:
    """Find omega of degree 2 for an irreducible equation, or prove that there is none."""
    quartic = invariants(problem, 4)
    if isinstance(quartic, NoInvariant):
        return (Exclusion(Structure.IMPRIMITIVE, (quartic,)),)

    def form() -> Form:
        squares = quartic if len(quartic) == 1 else _squares_in_pencil(problem, quartic)
        roots = [root_of_form(square, 2, problem) for square in squares]
        return min(roots, key=lambda f: f.P.degree)

    return Found(Structure.IMPRIMITIVE, form, quartic[0])


def _squares_in_pencil(problem: Problem, basis: list[Form]) -> list[Form]:
    """The members F1 + lambda F2 (and F2) over K that are squares of quadratic forms; if there are none, one with a lambda of
    the degree 2 or 3 over K.

    The Hessian of a member lies in the pencil again: Hess(F1 + lambda F2) = a(lambda) F1 + b(lambda) F2 with quadratic
    polynomials a and b, and lambda is a root of b - lambda a.
    """
    if len(basis) != 2:
        raise AssertionError("an irreducible equation has at most two invariants of degree 4")
    F1, F2 = basis
    pure1, pure2 = (_coordinates_in_pencil(problem, hessian(F, problem), basis) for F in basis)
    both = _coordinates_in_pencil(problem, hessian(Form(4, F1.R, F1.P + F2.P), problem), basis)
    mixed = tuple(s - u - v for s, u, v in zip(both, pure1, pure2, strict=True))
    (a0, b0), (a1, b1), (a2, b2) = pure1, mixed, pure2
    field = problem.field
    cubic = field.poly([b0, b1 - a0, b2 - a1, -a2])
    moduli = [factor for factor, _ in field.factor(cubic)]
    values = [-modulus[0] for modulus in moduli if modulus.degree == 1]
    squares = [Form(4, F1.R, F1.P + value * F2.P) for value in values]
    if not a2:
        squares.append(F2)
    if squares:
        return squares
    value = AlgebraicField(field, moduli[0]).generator
    return [Form(4, F1.R, F1.P + value * F2.P)]


def _coordinates_in_pencil(problem: Problem, H: Form, basis: list[Form]) -> tuple[Poly, Poly]:
    """H = a F1 + b F2, for H = Q0^2/D^2 P_H and F_i = Q0 P_i: P_H = (a P1 + b P2) D^2/Q0."""
    F1, F2 = basis
    # The basis is reduced: the leading power of one P doesn't occur in the other one.
    P = H.P.exact_quotient(singular_factor(problem, F1.R, 2))
    if P is None:
        raise AssertionError("the Hessian of an invariant is an invariant")
    a = P[F1.P.degree]
    b = P[F2.P.degree]
    if a * F1.P + b * F2.P != P:
        raise AssertionError("the Hessian of an invariant of degree 4 lies in the pencil")
    return a, b


_LEAST_DEGREE = {Structure.TETRAHEDRAL: 6, Structure.OCTAHEDRAL: 8, Structure.ICOSAHEDRAL: 12}


def decide_primitive(problem: Problem, structure: Structure) -> Outcome:
    """Find the omega of a primitive group, or exclude the group; the smaller ones must have been excluded before."""
    found = invariants(problem, _LEAST_DEGREE[structure])
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
    b = rest.lc / pattern.lc if rest else problem.field.zero
    if not b or rest != pattern * b:
        raise AssertionError("T^2 = a H^3 + b F^4 holds for the tetrahedral group")
    return root_of_form(Form(12, T.R, T.P + adjoined_square_root(problem.field, b) * G), 3, problem)


_FORMS = {
    Structure.TETRAHEDRAL: _tetrahedral,
    Structure.OCTAHEDRAL: lambda problem, F: root_of_form(hessian(F, problem), 2, problem),
    Structure.ICOSAHEDRAL: lambda problem, F: normalised(F, problem),
}
