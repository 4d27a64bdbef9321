"""Case 2: omega of degree 2.  The equation is known to be irreducible.

An imprimitive group permutes two lines, so (y1 y2)^2 is a rational invariant F of degree 4.  If the invariants of degree 4
have dimension 1, F is it.  Dimension 2 belongs to the quaternion group of order 8, which permutes three pairs of lines: the
squares F1 + lambda F2 are the members that are proportional to their Hessians, for three values of lambda.
"""

from __future__ import annotations

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.decision import Exclusion, NoInvariant, Structure
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Problem
from kovacic.engine.riccati import Form, Found, Outcome, hessian, root, singular_factor


def decide(problem: Problem) -> Outcome:
    """Find omega of degree 2 for an irreducible equation, or prove that there is none."""
    quartic = invariants(problem, 4)
    if isinstance(quartic, NoInvariant):
        return (Exclusion(Structure.IMPRIMITIVE, (quartic,)),)

    def form() -> Form:
        squares = quartic if len(quartic) == 1 else _squares_in_pencil(problem, quartic)
        roots = [root(square, 2, problem) for square in squares]
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
    moduli = [factor for factor, _ in field.factor(cubic)] if cubic.degree > 0 else []
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
