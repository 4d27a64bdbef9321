"""Case 3: Klein's form of the solutions, and the polynomial of a power of y.

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

    v^(-a/nu) 2F1(a, a - c + 1; 1/2; 1/J),    t v^(-b/nu) 2F1(b, b - c + 1; 3/2; 1/J).                                   (3)

y1 and y2 belong to opposite vertices, so multiples of y1^k and y2^k, for k = 4, 8, 10, are roots of the polynomial whose
roots are the k-th powers of the linear factors of v,

    Z^n + e_1 Z^(n-1) + e_2 Z^(n-2) + ...,     n = 6, 6, 12,                                                              (2)

with coefficients in H and T (octahedral: F and H), given by `POLYNOMIALS`; they were found by comparing coefficients for
y'' = 0.

References: F. Klein, Vorlesungen ueber das Ikosaeder (1884); W. Fakler, Theor. Comp. Sci. 187 (1997) 27-48; M. van Hoeij &
J.-A. Weil, ISSAC 2005.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.product import Power, Product, product
from kovacic.decision import SemiInvariant, Structure
from kovacic.engine.places import Problem, analyse
from kovacic.engine.riccati import Form, hessian, jacobian, normalised, residue, root
from kovacic.limits import Budget, check_time

Monomials = dict[tuple[int, int], Fraction]


def _monomials(text: str) -> Monomials:
    """{(i, j): c} for terms "i j c"."""
    terms = (term.split() for term in text.split(","))
    return {(int(i), int(j)): Fraction(c) for i, j, c in terms}


#: e_k of equation (2) as {(i, j): c} for c H^i T^j; for the octahedral group c F^i (H^2/lambda)^j, b = OCTAHEDRAL_B lambda.
POLYNOMIALS: dict[Structure, dict[int, Monomials]] = {
    Structure.TETRAHEDRAL: {
        2: _monomials("1 0 1/8"),
        3: _monomials("0 1 -1/128"),
        4: _monomials("2 0 -3/1280"),
        5: _monomials("1 1 1/51200"),
        6: _monomials("0 2 -1/44236800, 3 0 -1/3456000"),
    },
    Structure.OCTAHEDRAL: {
        1: _monomials("1 0 -5/4"),
        2: _monomials("2 0 35/128"),
        3: _monomials("3 0 -25/1024, 0 1 193/33030144"),
        4: _monomials("4 0 65/65536, 1 1 265/1849688064"),
        5: _monomials("5 0 -1/65536, 2 1 13/19730006016"),
        6: _monomials("0 2 1/213834120881504256"),
    },
    Structure.ICOSAHEDRAL: {
        2: _monomials("1 0 34/625"),
        3: _monomials("0 1 -91/62500"),
        4: _monomials("2 0 -12943/21484375"),
        5: _monomials("1 1 3557/1074218750"),
        6: _monomials("3 0 75710377/638085937500000, 0 2 -810019/185625000000000"),
        7: _monomials("2 1 -7421/73852539062500"),
        8: _monomials("4 0 -79505917/7311401367187500000, 1 2 -602849/2126953125000000000"),
        9: _monomials("3 1 -844501/548355102539062500000, 0 3 -6953/159521484375000000000"),
        10: _monomials("5 0 3196001/3769941329956054687500000, 2 2 4721/219342041015625000000000"),
        11: _monomials("4 1 -307/414693546295166015625000000, 1 3 1/120638122558593750000000000"),
        12: _monomials(
            "6 0 1/1576498985595703125000000000000, 3 2 1/28663617919921875000000000000000, "
            "0 4 1/2084626757812500000000000000000000"
        ),
    },
}
POWERS = {Structure.TETRAHEDRAL: 4, Structure.OCTAHEDRAL: 8, Structure.ICOSAHEDRAL: 10}
RATIOS = {
    Structure.TETRAHEDRAL: Fraction(64, 5),
    Structure.OCTAHEDRAL: Fraction(144, 7),
    Structure.ICOSAHEDRAL: Fraction(400, 11),
}
#: b = OCTAHEDRAL_B * lambda, for F = lambda (1 + 14 x^4 + x^8) and y'' = 0.
OCTAHEDRAL_B = Fraction(344064)
#: The largest sum of the degrees of the coefficients of (2) that is written out.
PRINTABLE = 1000


@dataclass(frozen=True)
class Hypergeometric:
    """`factor` * 2F1(a, b; c; J)."""

    factor: Product
    a: Fraction
    b: Fraction
    c: Fraction


@dataclass(frozen=True)
class PowerPolynomial:
    """y^`power` satisfies Z^n + sum of coefficients[k] Z^(n-k), k = 1..n, for suitable multiples of the solutions of (1)."""

    power: int
    coefficients: tuple[RatFunc, ...]


@dataclass(frozen=True)
class Covariants:
    """The invariant F, H and T of the head of this module, the forms v and t of the vertices and edges, and J."""

    problem: Problem
    F: Form
    H: Form
    T: Form
    vertices: Form
    edges: Form
    J: RatFunc


@dataclass(frozen=True)
class KleinForm:
    """The two solutions (1) and J, with the forms that they are made of."""

    structure: Structure
    forms: Covariants
    first: Hypergeometric
    second: Hypergeometric
    gauge: RatFunc

    @property
    def J(self) -> RatFunc:
        return self.forms.J

    @cached_property
    def polynomial(self) -> PowerPolynomial | None:
        """(2); None with a gauge factor, or if it is too long to be written."""
        forms = self.forms
        return None if self.gauge else _polynomial(forms.problem, self.structure, forms.F, forms.H, forms.T)

    @cached_property
    def at_edges(self) -> tuple[Hypergeometric, Hypergeometric]:
        """The two solutions (3), functions of 1/J."""
        problem, v, t = self.forms.problem, self.forms.vertices, self.forms.edges
        a, b, c = self.first.a, self.first.b, self.first.c
        first = _product(problem, self.gauge, (v, -a / (1 - c)))
        second = _product(problem, self.gauge, (t, Fraction(1)), (v, -b / (1 - c)))
        half = Fraction(1, 2)
        return Hypergeometric(first, a, a - c + 1, half), Hypergeometric(second, b, b - c + 1, half + 1)


def covariants(S: RatFunc, structure: Structure, invariant: SemiInvariant) -> Covariants:
    """The forms that the solutions (1) are made of, for an equation with a primitive finite group."""
    problem = analyse(S, Budget())
    F = normalised(Form(invariant.degree, (invariant.theta * problem.D).num, invariant.P), problem)
    H = hessian(F, problem)
    check_time()
    T = jacobian(F, H, problem)
    check_time()
    ratio = RATIOS[structure]
    cube, square = H.P**3, T.P**2
    vertices, edges = F, normalised(T, problem)
    if structure is Structure.OCTAHEDRAL:
        J = RatFunc(cube * -ratio, square)
        vertices = root(H, 2, problem)
        edges = _quotient(edges, vertices)
    else:
        J = RatFunc(square + cube * ratio, square)
    return Covariants(problem, F, H, T, vertices, edges, J)


def klein_form(S: RatFunc, structure: Structure, invariant: SemiInvariant, gauge: RatFunc) -> KleinForm:
    """Klein's form of the solutions of an equation with a primitive finite group."""
    forms = covariants(S, structure, invariant)
    problem, vertices, edges = forms.problem, forms.vertices, forms.edges
    nu, n = (Fraction(1, 5), 30) if structure is Structure.ICOSAHEDRAL else (Fraction(1, 4), 12)
    a = (Fraction(1, 6) - nu) / 2
    b = a + Fraction(1, 2)
    first = _product(problem, gauge, (edges, Fraction(1, n)))
    second = _product(problem, gauge, (edges, Fraction(1, n) - nu * 2), (vertices, Fraction(1)))
    return KleinForm(
        structure,
        forms,
        Hypergeometric(first, a, b, 1 - nu),
        Hypergeometric(second, a + nu, b + nu, 1 + nu),
        gauge,
    )


def _quotient(f: Form, g: Form) -> Form:
    P = f.P.exact_quotient(g.P)
    if P is None:
        raise AssertionError("the Jacobian of F8 and its Hessian contains the form of degree 6")
    return Form(f.degree - g.degree, f.R - g.R, P)


def _product(problem: Problem, gauge: RatFunc, *powers: tuple[Form, Fraction]) -> Product:
    theta = gauge
    for form, exponent in powers:
        theta = theta + RatFunc(form.R * exponent, problem.D)
    result = product(theta)
    field = result.field
    zeros = tuple(Power(form.P, field.poly([exponent])) for form, exponent in powers if form.P.degree > 0)
    return Product((*result.powers, *zeros), result.roots, result.exponential)


def _polynomial(problem: Problem, structure: Structure, F: Form, H: Form, T: Form) -> PowerPolynomial | None:
    """Equation (2)."""
    scale = singular_part(problem, F.R)
    D = RatFunc(problem.D)
    if structure is Structure.OCTAHEDRAL:
        # b F^3 H = T^2 + (144/7) H^3, all of them divided by (Q/D)^6, Q^5/D^2 by it is D^4/Q.
        left = T.P**2 + H.P**3 * RATIOS[structure]
        b = RatFunc(left) / (RatFunc(F.P**3 * H.P) * D**4 / scale)
        value = problem.field.rational_value(b.num) if b.is_polynomial and b.num.degree <= 0 else None
        if value is None:
            return None
        u, v = scale * F.P, (scale**2 * H.P / D**2) ** 2 * (OCTAHEDRAL_B / value)
    else:
        u, v = scale**2 * H.P / D**2, scale**3 * T.P / D**3
    table = POLYNOMIALS[structure]
    n = max(table)
    if n * max(u.num.degree, u.den.degree, v.num.degree, v.den.degree) > PRINTABLE:
        return None
    zero = RatFunc(problem.field.poly([]))
    coefficients = tuple(
        sum((u**i * v**j * c for (i, j), c in table.get(k, {}).items()), zero) for k in range(1, n + 1)
    )
    return PowerPolynomial(POWERS[structure], coefficients)


def singular_part(problem: Problem, R: Poly) -> RatFunc:
    """Q = prod p^(v_p) with Q'/Q = R/D."""
    result = RatFunc(problem.field.poly([1]))
    for place in problem.finite_places:
        result = result * RatFunc(place.factor) ** residue(problem, R, place)
    return result
