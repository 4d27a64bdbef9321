"""Two independent solutions as data, without SymPy: what the views print and what the numeric part evaluates.

y'' = S y; `gauge` is the logarithmic derivative of a factor that every solution is multiplied with (0 for the normal form
itself), which is merged into the products at once.

Case 3: `covariants` has the absolute invariant J, by which Klein writes the solutions.  For the invariant F of least degree
let H = Hess(F)/(m - 1) and T = Jac(F, H), with the normalisations of `kovacic.engine.riccati`.  For y1 = 1, y2 = x of y'' = 0,
and F = x - x^5, or 1 + 14 x^4 + x^8, or x + 11 x^6 - x^11, one finds

    tetrahedral   T^2 = -(64/5) H^3 + b F^4,      octahedral   T^2 = -(144/7) H^3 + b F^3 H,
    icosahedral   T^2 = -(400/11) H^3 + b F^5,

and the constants before H^3 are general, since H and T are homogeneous in F.  Let v be the form of degree 6, 6, 12 whose
linear factors are the vertices (F, the square root of H, F) and t the one of degree 12, 12, 30 for the edges (T, T/v, T).
With J the absolute invariant, 0 at v, 1 at the faces and infinity at t,

    J = 1 + (64/5) H^3/T^2,    -(144/7) H^3/T^2,    1 + (400/11) H^3/T^2,

the equation is the pull-back by J of Gauss' equation with the exponent differences nu, 1/3, 1/2 at 0, 1, infinity, nu = 1/4 for
the first two groups and 1/5 for the third: so all solutions of case 3 are written by `kovacic.special.gauss`.

References: F. Klein, Vorlesungen ueber das Ikosaeder (1884); W. Fakler, Theor. Comp. Sci. 187 (1997) 27-48; M. van Hoeij &
J.-A. Weil, ISSAC 2005.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.partial_fractions import Decomposition, decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.closed_form.curve import CurveIntegral, Unit, completed, gathered_zeros, integrate_on_curve
from kovacic.closed_form.primitive import (
    ExponentialPrimitive,
    OpenPrimitive,
    Primitive,
    RationalPrimitive,
    integrate_inverse_square,
)
from kovacic.closed_form.product import Product, product, written_length
from kovacic.decision import Decision, SemiInvariant, Structure
from kovacic.engine.places import Problem, analyse
from kovacic.engine.riccati import Form, hessian, jacobian, normalised
from kovacic.limits import Budget, check_time

RATIOS = {
    Structure.TETRAHEDRAL: Fraction(64, 5),
    Structure.OCTAHEDRAL: Fraction(144, 7),
    Structure.ICOSAHEDRAL: Fraction(400, 11),
}
#: Where a pair is to be real, in this order: between and beyond the usual singular points.
PLACES = tuple(Fraction(p, 2) for p in (1, -1, 3, -3, 5, -5, 9, -9))


@dataclass(frozen=True)
class Covariants:
    """The forms F, H and T of the head of this module, and J, for an equation whose group is this primitive finite one."""

    structure: Structure
    problem: Problem
    F: Form
    H: Form
    T: Form
    J: RatFunc


def covariants(S: RatFunc, structure: Structure, invariant: SemiInvariant) -> Covariants:
    """Those of the invariant of least degree."""
    problem = analyse(S, Budget())
    F = normalised(Form(invariant.degree, (invariant.theta * problem.D).num, invariant.P), problem)
    H = hessian(F, problem)
    check_time()
    T = jacobian(F, H, problem)
    check_time()
    cube = H.P**3 * RATIOS[structure]
    square = T.P**2
    J = RatFunc(-cube if structure is Structure.OCTAHEDRAL else square + cube, square)
    return Covariants(structure, problem, F, H, T, J)


@dataclass(frozen=True)
class Diagonal:
    """Case 1, diagonal group, both logarithmic derivatives over K: y1 and y2 are products."""

    first: Product
    second: Product

    @property
    def length(self) -> int:
        """About how many characters both solutions take, as for all structures."""
        return self.first.length + self.second.length


@dataclass(frozen=True)
class Conjugate:
    """Case 1, diagonal group, omega conjugate over K(sqrt delta): y = (A +- sqrt(delta) B) common exp(+-sqrt(delta) V).

    V is given by its decomposition, V' = `phase.derivative`.
    """

    common: Product
    delta: Poly
    phase: Decomposition
    A: Poly
    B: Poly

    @property
    def length(self) -> int:
        # Each solution is (A cos V + B sin V) times the common factor.
        return 2 * (self.common.length + written_length(self.A, self.B) + 2 * written_length(self.phase))


@dataclass(frozen=True)
class Triangular:
    """Case 1, omega unique or y1^2 rational: y1 = first, y2 = first * int bare^-2 dx; `bare` is y1 without the gauge."""

    first: Product
    bare: Product
    primitive: Primitive

    @property
    def length(self) -> int:
        first = self.first.length
        primitive = self.primitive
        if isinstance(primitive, OpenPrimitive):
            return 2 * first + self.bare.length
        # y1 stands before each logarithm, error function, ...; the denominator of the rational part cancels with it.
        exact: RatFunc | None = None
        if isinstance(primitive, RationalPrimitive):
            exact = primitive.parts.exact
            # c log u - c log v is one
            functions = len({str(residue.value * residue.value) for residue in primitive.parts.residues})
        elif isinstance(primitive, ExponentialPrimitive):
            exact = primitive.W
            functions = len(primitive.terms) + len(primitive.poles)
        else:
            functions = 3 + 2 * len(primitive.residues)
        return first * (1 + functions) + written_length(primitive) - written_length(exact and exact.den)


@dataclass(frozen=True)
class OnCurve:
    """Case 2: y = common * (A +- B kappa s) * exp(+-kappa int r dx/s), s = sqrt(g), kappa^2 = `kappa_squared`, a constant.

    A and B are those of `zeros`, where the zeros of y are gathered; 1 and 0 without.
    """

    common: Product
    kappa_squared: Poly
    integral: CurveIntegral
    zeros: Unit | None = None

    @property
    def length(self) -> int:
        g = self.integral.g
        return 2 * (self.common.length + written_length(self.integral, self.zeros, (g,) * len(self.integral.units)))


ClosedStructure = Diagonal | Conjugate | Triangular | OnCurve | Covariants


def build(S: RatFunc, decision: Decision, gauge: RatFunc) -> ClosedStructure:
    """The closed forms that belong to a decision with Liouvillian solutions."""
    semi = decision.semi_invariant
    structure = decision.structure
    assert semi is not None
    if structure is Structure.REDUCIBLE:
        return _reducible(semi, decision.invariant, gauge)
    if structure is Structure.IMPRIMITIVE:
        g, r, kappa_squared = curve_of_pair(S, semi)
        common = (semi.theta + gauge * 2) * Fraction(1, 2)
        zeros = gathered_zeros(g, r, kappa_squared, semi.P)
        if zeros is None or zeros.p is None:
            common = common + logarithmic_derivative(semi.P) * Fraction(1, 2)
        else:
            common = common - logarithmic_derivative(zeros.p // semi.P) * Fraction(1, 2)
            r = r - zeros.integrand(g)
        return OnCurve(product(common), kappa_squared, completed(integrate_on_curve(r, g)), zeros)
    assert structure is not None
    assert decision.invariant is not None
    return covariants(S, structure, decision.invariant)


def _reducible(semi: SemiInvariant, invariant: SemiInvariant | None, gauge: RatFunc) -> ClosedStructure:
    if invariant is not None and semi.theta.field != invariant.theta.field:
        return _conjugate(semi, gauge)
    first = product(semi.theta + gauge, semi.P)
    if invariant is not None:
        second = invariant.logarithmic_derivative - semi.logarithmic_derivative
        if second != semi.logarithmic_derivative:
            zeros = invariant.P.exact_quotient(semi.P)
            theta = second if zeros is None else invariant.theta - semi.theta
            return Diagonal(first, product(theta + gauge, zeros))
    bare = product(semi.theta, semi.P) if gauge else first
    return Triangular(first, bare, integrate_inverse_square(bare))


def _conjugate(semi: SemiInvariant, gauge: RatFunc) -> Conjugate:
    """omega = u + sqrt(delta) v, from omega over K(c), c^2 + b c + e = 0, sqrt(delta) = c + b/2."""
    field = semi.theta.field
    assert isinstance(field, AlgebraicField)
    half = field.modulus[1] * Fraction(1, 2)
    delta = half * half - field.modulus[0]

    def split(polynomial: Poly) -> tuple[Poly, Poly]:
        low, high = polynomial.parts
        return low - high * half, high

    a, b = split(semi.theta.num)
    c, d = split(semi.theta.den)
    norm = c * c - d * d * delta
    u = RatFunc(a * c - b * d * delta, norm)
    v = RatFunc(b * c - a * d, norm)
    return Conjugate(product(u + gauge), delta, decompose(v), *split(semi.P))


def curve_of_pair(S: RatFunc, semi: SemiInvariant) -> tuple[Poly, RatFunc, Poly]:
    """g, r, and kappa^2 with kappa^2 r^2/g = (4 S - 2 phi' - phi^2)/4 for phi = (y1 y2)'/(y1 y2)."""
    phi = semi.logarithmic_derivative
    field = phi.field
    square = (4 * S - 2 * phi.derivative() - phi * phi) * Fraction(1, 4)
    # (y1 y2)^2 is rational: a constant times h^2 g with known factors.
    g = field.one
    h = RatFunc(semi.P)
    for residue in decompose(semi.theta * 2).residues:
        exponent = int(residue.rational or 0)
        h = h * RatFunc(residue.factor) ** (exponent // 2)
        if exponent % 2:
            g = g * residue.factor
    # r = 1/h has h' numerator and denominator monic, so that kappa alone carries the constant.
    return g, 1 / h, (square * RatFunc(g) * h * h).num
