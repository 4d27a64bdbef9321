"""Case 3: Klein's form of the solutions.

For the invariant F of least degree let H = Hess(F)/(m - 1) and T = Jac(F, H), with the normalisations of
`kovacic.engine.riccati`.  For y1 = 1, y2 = x of y'' = 0, and F = x - x^5, or 1 + 14 x^4 + x^8, or x + 11 x^6 - x^11, one finds

    tetrahedral   T^2 = -(64/5) H^3 + b F^4,      octahedral   T^2 = -(144/7) H^3 + b F^3 H,
    icosahedral   T^2 = -(400/11) H^3 + b F^5,

and the constants before H^3 are general, since H and T are homogeneous in F.  Let v be the form of degree 6, 6, 12 whose
linear factors are the vertices (F, the square root of H, F) and t the one of degree 12, 12, 30 for the edges (T, T/v, T).
With the hypergeometric function 2F1(a, b; c; J) of Gauss and J the absolute invariant, 0 at v, 1 at the faces and infinity
at t,

    J = 1 + (64/5) H^3/T^2,    -(144/7) H^3/T^2,    1 + (400/11) H^3/T^2,

    y1 = t^(1/12) 2F1(-1/24, 11/24; 3/4; J),    y2 = v t^(-5/12) 2F1(5/24, 17/24; 5/4; J)         (first two groups)     (1)
    y1 = t^(1/30) 2F1(-1/60, 29/60; 4/5; J),    y2 = v t^(-11/30) 2F1(11/60, 41/60; 6/5; J)       (icosahedral)

which is Klein's J'^(-1/2) u(J), u the local solutions at J = 0 of the equation with exponent differences (nu, 1/3, 1/2) at
0, 1, infinity, nu = 1/4 or 1/5: J' is a product of powers of v, t and H, which combine with those in u.  Since J is a
multiple of v^(1/nu)/t^2, the local solutions at J = infinity, for the first ones 2F1(a, b; c; J), are

    v^(-a/nu) 2F1(a, a - c + 1; 1/2; 1/J),    t v^(-b/nu) 2F1(b, b - c + 1; 3/2; 1/J).                                   (2)

References: F. Klein, Vorlesungen ueber das Ikosaeder (1884); W. Fakler, Theor. Comp. Sci. 187 (1997) 27-48; M. van Hoeij &
J.-A. Weil, ISSAC 2005.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.product import Power, Product, product, written_length
from kovacic.decision import SemiInvariant, Structure
from kovacic.engine.places import Problem, analyse
from kovacic.engine.riccati import Form, hessian, jacobian, normalised, root
from kovacic.limits import Budget, check_time

RATIOS = {
    Structure.TETRAHEDRAL: Fraction(64, 5),
    Structure.OCTAHEDRAL: Fraction(144, 7),
    Structure.ICOSAHEDRAL: Fraction(400, 11),
}


@dataclass(frozen=True)
class Hypergeometric:
    """`factor` * 2F1(a, b; c; J)."""

    factor: Product
    a: Fraction
    b: Fraction
    c: Fraction


@dataclass(frozen=True)
class Covariants:
    """The invariant F and H of the head of this module, the forms v and t of the vertices and edges, and J."""

    problem: Problem
    F: Form
    H: Form
    vertices: Form
    edges: Form
    J: RatFunc


@dataclass(frozen=True)
class KleinForm:
    """The two solutions (1), functions of J, and (2), functions of 1/J."""

    J: RatFunc
    at_vertices: tuple[Hypergeometric, Hypergeometric]
    at_edges: tuple[Hypergeometric, Hypergeometric]

    @property
    def length(self) -> int:
        """About how many characters the solutions (1) take."""
        return sum(y.factor.length + written_length([self.J]) for y in self.at_vertices)


def covariants(S: RatFunc, structure: Structure, invariant: SemiInvariant) -> Covariants:
    """The forms that the solutions (1) are made of, for an equation with a primitive finite group."""
    problem = analyse(S, Budget())
    F = normalised(Form(invariant.degree, (invariant.theta * problem.D).num, invariant.P), problem)
    H = hessian(F, problem)
    check_time()
    T = jacobian(F, H, problem)
    check_time()
    ratio = RATIOS[structure]
    cube = H.P**3
    square = T.P**2
    vertices = F
    edges = normalised(T, problem)
    if structure is Structure.OCTAHEDRAL:
        J = RatFunc(cube * -ratio, square)
        vertices = root(H, 2, problem)
        P = edges.P.exact_quotient(vertices.P)
        if P is None:
            raise AssertionError("the Jacobian of F8 and its Hessian contains the form of degree 6")
        edges = Form(edges.degree - vertices.degree, edges.R - vertices.R, P)
    else:
        J = RatFunc(square + cube * ratio, square)
    return Covariants(problem, F, H, vertices, edges, J)


def klein_form(S: RatFunc, structure: Structure, invariant: SemiInvariant, gauge: RatFunc) -> KleinForm:
    """Klein's form of the solutions of an equation with a primitive finite group."""
    forms = covariants(S, structure, invariant)
    nu, n = (Fraction(1, 5), 30) if structure is Structure.ICOSAHEDRAL else (Fraction(1, 4), 12)
    a = (Fraction(1, 6) - nu) / 2
    half = Fraction(1, 2)
    v = forms.vertices
    t = forms.edges
    b = a + half

    def solution(a: Fraction, b: Fraction, c: Fraction, *powers: tuple[Form, Fraction]) -> Hypergeometric:
        return Hypergeometric(_product(forms.problem, gauge, *powers), a, b, c)

    return KleinForm(
        forms.J,
        (
            solution(a, b, 1 - nu, (t, Fraction(1, n))),
            solution(a + nu, b + nu, 1 + nu, (t, Fraction(1, n) - nu * 2), (v, Fraction(1))),
        ),
        (
            solution(a, a + nu, half, (v, -a / nu)),
            solution(b, b + nu, half + 1, (t, Fraction(1)), (v, -b / nu)),
        ),
    )


def _product(problem: Problem, gauge: RatFunc, *powers: tuple[Form, Fraction]) -> Product:
    theta = gauge
    for form, exponent in powers:
        theta = theta + RatFunc(form.R * exponent, problem.D)
    result = product(theta)
    field = result.field
    zeros = tuple(Power(form.P, field.poly([exponent])) for form, exponent in powers if form.P.degree > 0)
    return Product((*result.powers, *zeros), result.roots, result.exponential)
