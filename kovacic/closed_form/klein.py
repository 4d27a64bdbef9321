"""Case 3: the absolute invariant J, by which Klein writes the solutions.

For the invariant F of least degree let H = Hess(F)/(m - 1) and T = Jac(F, H), with the normalisations of
`kovacic.engine.riccati`.  For y1 = 1, y2 = x of y'' = 0, and F = x - x^5, or 1 + 14 x^4 + x^8, or x + 11 x^6 - x^11, one finds

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

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.product import written_length
from kovacic.decision import SemiInvariant, Structure
from kovacic.engine.places import Problem, analyse
from kovacic.engine.riccati import Form, hessian, jacobian, normalised
from kovacic.limits import Budget, check_time

RATIOS = {
    Structure.TETRAHEDRAL: Fraction(64, 5),
    Structure.OCTAHEDRAL: Fraction(144, 7),
    Structure.ICOSAHEDRAL: Fraction(400, 11),
}


@dataclass(frozen=True)
class Covariants:
    """The forms F, H and T of the head of this module, and J, for an equation whose group is this primitive finite one."""

    structure: Structure
    problem: Problem
    F: Form
    H: Form
    T: Form
    J: RatFunc

    @property
    def length(self) -> int:
        """About how many characters two solutions take, as for all structures."""
        return 4 * written_length([self.J])


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
