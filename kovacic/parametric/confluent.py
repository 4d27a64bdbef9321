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

In case 1, with signs e, f (both +-1) for which d is a natural number (DLMF 18.8),

    y = weight x^((1 + f Delta)/2) exp(e sqrt(q) x^n/n) L_d^(f Delta/n)(-2 e sqrt(q) x^n/n),             (2)

d = (e beta - f Delta - n)/(2 n).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from itertools import product

from kovacic.algebra.poly import Poly
from kovacic.decision import Structure
from kovacic.engine.places import Problem
from kovacic.parametric import generic, riemann
from kovacic.parametric.formulas import root_written
from kovacic.parametric.functions import irreducible_factors, over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.quotient import Coordinate, symmetries
from kovacic.parametric.regions import Theorem, Verdict
from kovacic.parametric.solutions import PolynomialSolution, possible, root


@dataclass(frozen=True)
class Confluent:
    """Equation (1): the coordinate in which it has this form, and the coefficients."""

    coordinate: Coordinate
    b: Poly
    r: Poly
    q: Poly

    @property
    def omega(self) -> str:
        """What the solutions look like in the coordinate s of the form (1)."""
        n, base = self.coordinate.n, self.coordinate.base
        z, where = (base, "") if base.isidentifier() else ("s", f", s = {base}")
        if not self.q:
            return f"omega of degree 2, rational in {z} and sqrt({z}){where}"
        power = "" if n == 1 else f" {z}" if n == 2 else f" {z}^{n - 1}"
        beta, difference = (_signed(square) for square in (self.r * self.r / self.q, 1 + 4 * self.b))
        natural = "a natural number" if n == 1 else f"a natural multiple of {n}"
        return (
            f"omega ={_signed(self.q)}{power} + (1{difference})/(2 {z}) + P'/P{where}, with signs for which "
            f"deg P = (-{n}{beta}{difference})/2 is {natural}"
        )

    @property
    def verdict(self) -> Verdict:
        """The structure and the family of the groups where a Liouvillian solution exists.

        An irregular point makes the group infinite.  With q = 0 it is imprimitive.  Otherwise a solution with a rational omega
        has one of two exponential factors, and both occur where each sign of beta fits, as for beta = 0; the group is diagonal
        then.
        """
        if not self.q:
            return Verdict(Structure.IMPRIMITIVE, family="the infinite dihedral group")
        family = "Borel group, or G_m where both exponential factors occur" if self.r else "G_m"
        return Verdict(Structure.REDUCIBLE, family=family)


def _signed(square: Poly) -> str:
    root = root_written(square)
    return "" if root == "0" else f" +- ({root})" if " " in root else f" +- {root}"


def recognise(problem: Problem, variable: str) -> Confluent | None:
    """The equation in the form (1), or None; `variable` is the name of x.

    x^2 S is b + r z + q z^2 with z = x^n.  Where that is b + q x^(2n), 2n is the order of the symmetry.
    """
    for symmetric in () if riemann.is_fuchsian(problem) else symmetries(problem, variable):
        if symmetric.den.degree == 0 < symmetric.num.degree <= 2:
            b, r, q = (symmetric.num[k] / symmetric.den[0] for k in range(3))
            coordinate = symmetric.coordinate
            if not q and coordinate.n % 2 == 0:
                coordinate, r, q = replace(coordinate, n=coordinate.n // 2), q, r
            return Confluent(coordinate, b, r, q)
    return None


def laguerre_solutions(form: Confluent, variable: str, _: int | None = None) -> tuple[PolynomialSolution, ...]:
    """Equation (2), for all signs for which d can be a natural number."""
    import sympy

    from kovacic.reading.symbolic import read_expression

    if not form.q:
        return ()
    x, s, weight = sympy.Symbol(variable), *map(read_expression, (form.coordinate.base, form.coordinate.weight))
    rate, delta = root(form.q), root(1 + 4 * form.b)
    beta, n = form.r.to_sympy(x) / rate, form.coordinate.n
    found = []
    for e, f in product((1, -1), repeat=2):
        degree = sympy.expand((e * beta - f * delta - n) / (2 * n))
        u = sympy.expand(-2 * e * rate / n) * s**n
        y = s ** sympy.expand((1 + f * delta) / 2) * sympy.exp(-u / 2) * sympy.assoc_laguerre(degree, f * delta / n, u)
        found.append(PolynomialSolution(weight * y, degree))
    return possible(found)


def martinet_ramis(problem: Problem, variable: str) -> Theorem | None:
    """The theorem, where it applies."""
    form = recognise(problem, variable)
    if form is None:
        return None
    n, b, r, q, z = form.coordinate.n, form.b, form.r, form.q, form.b.field.poly([0, 0, 1])
    delta_squared, beta_squared = 1 + 4 * b, r * r / q if q else 0 * b
    equation = (
        (z - beta_squared - delta_squared) ** 2 - 4 * beta_squared * delta_squared if q else z - 4 * delta_squared
    )
    statements = integer_roots(over_parameters(equation), [n], 2 * n)
    region = (statements, form.verdict, form.omega, partial(laguerre_solutions, form, variable))
    name = f"{'Whittaker' if q else 'Bessel'}'s equation in {form.coordinate}: Martinet & Ramis"
    return Theorem(name, [*generic.undefined(problem), *irreducible_factors(q or r)], [region] * bool(statements))
