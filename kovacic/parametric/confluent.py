"""One irregular singular point and at most one other: equations that x^n = z brings to Whittaker's or to Bessel's.

In a coordinate in which the irregular point is infinity and the other one (or any chosen point) is 0,

    S = b/x^2 + r x^(n-2) + q x^(2n-2),   n >= 1,                                                                  (1)

are the equations treated here.  With z = x^n the exponent differences become Delta/n at 0, Delta^2 = 1 + 4b, and, for q != 0,
beta/n at infinity, beta^2 = r^2/q: Whittaker's equation with 2 kappa = beta/n and 2 mu = Delta/n.

Theorem [Martinet & Ramis 1989; Duval & Loday-Richaud 1992].  For q != 0 the equation has a Liouvillian solution exactly when
(beta + Delta)/n or (beta - Delta)/n is an odd integer, and then it is reducible (case 1): over C(z) the group is reducible or
SL2, for an imprimitive group needs two branch points, and a finite one no irregular point; SL2 has no subgroup of finite
index, so the group over C(x) is the same.  For q = 0, r != 0: case 1 never (n odd) and case 2 exactly when 2 Delta/n is an odd
integer, since an imprimitive group becomes reducible over C(sqrt x); n even is the first kind with n/2 and beta = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Problem
from kovacic.parametric.formulas import root_written, shifted
from kovacic.parametric.functions import over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.statements import Statement


@dataclass(frozen=True)
class Confluent:
    """Equation (1): the coefficients, n, the coordinate s in words, and is it 1/(x - c) (then v = s y is the unknown)?"""

    n: int
    b: Poly
    r: Poly
    q: Poly
    coordinate: str
    inverted: bool = False

    @property
    def degenerate(self) -> Poly:
        """What must not vanish for the theorem to hold."""
        return self.q or self.r


def omega(form: Confluent) -> str:
    """What the solutions look like in the coordinate of the form (1), called s unless it has a name."""
    n = form.n
    simple = form.coordinate.isidentifier()
    z, where = (form.coordinate, "") if simple else ("s", f", s = {form.coordinate}")
    difference = root_written(1 + 4 * form.b)
    if not form.q:
        return f"omega of degree 2, rational in {z} and sqrt({z}){where}"
    power = "" if n == 1 else f" {z}" if n == 2 else f" {z}^{n - 1}"
    beta = root_written(form.r * form.r / form.q)
    natural = "a natural number" if n == 1 else f"a natural multiple of {n}"
    return (
        f"omega ={_signed(root_written(form.q))}{power} + (1{_signed(difference)})/(2 {z}) + P'/P{where}, with signs for which "
        f"deg P = (-{n}{_signed(beta)}{_signed(difference)})/2 is {natural}"
    )


def _signed(root: str) -> str:
    return "" if root == "0" else f" +- ({root})" if " " in root else f" +- {root}"


def group(form: Confluent) -> str:
    """The family of the groups where a Liouvillian solution exists.

    An irregular point makes the group infinite.  With q = 0 it is imprimitive.  Otherwise a solution with a rational omega has
    one of two exponential factors, and both occur where each sign of beta fits, as for beta = 0; the group is diagonal then.
    """
    if not form.q:
        return "the infinite dihedral group"
    return "Borel group, or G_m where both exponential factors occur" if form.r else "G_m"


def recognise(problem: Problem, variable: str) -> Confluent | None:
    """The equation in the form (1), or None; `variable` is the name of x."""
    singular = [place for place in problem.places if place.kind is not Kind.ORDINARY]
    irregular = [place for place in singular if place.kind is not Kind.REGULAR]
    if len(irregular) != 1 or len(singular) > 2 or any(place.degree > 1 for place in singular):
        return None
    S, field = problem.S, problem.field
    coordinate = variable
    x = RatFunc(field.poly([0, 1]))
    if not irregular[0].at_infinity:
        # Move the irregular point c to infinity: x = c + 1/z, S -> S(c + 1/z)/z^4.
        c = -irregular[0].factor[0]
        S = S(RatFunc(field.poly([1]), field.poly([0, 1])) + c) / x**4
        coordinate = f"1/({shifted(variable, c)})" if c else f"1/{variable}"
    regular = [-factor[0] for factor, _ in field.factor(S.den)] if S.den.degree else []
    if not regular:
        n = S.num.degree
        center = field.poly([]) if n < 1 else -S.num[n - 1] / (S.num[n] * n)
    else:
        center = regular[0]
    if center:
        S = S(x + center)
        coordinate = shifted(coordinate, center)
    shift, zero = S.den.degree, field.poly([])
    if shift > 2 or S.den != field.poly([0] * shift + [1]):
        return None
    terms = {power - shift: c for power, c in enumerate(S.num) if c}
    b = terms.pop(-2, zero)
    if not terms:
        return None
    top = max(terms)
    q = zero if top % 2 else terms.pop(top)
    n = top + 2 if top % 2 else top // 2 + 1
    r = terms.pop(n - 2, zero)
    return None if terms else Confluent(n, b, r, q, coordinate, not irregular[0].at_infinity)


def solvable(form: Confluent) -> tuple[Structure, Literal[True] | list[Statement]]:
    """The structure, and when it occurs: True for always, and [] for never."""
    delta_squared, z = 1 + 4 * form.b, form.b.field.poly([0, 0, 1])
    beta_squared = form.r * form.r / form.q if form.q else 0 * delta_squared
    equation = (
        (z - beta_squared - delta_squared) ** 2 - 4 * beta_squared * delta_squared if form.q else z - 4 * delta_squared
    )
    structure = Structure.REDUCIBLE if form.q else Structure.IMPRIMITIVE
    return structure, integer_roots(over_parameters(equation), [form.n], 2 * form.n)
