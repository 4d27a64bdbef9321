"""Powers of the singular factors in forms with integer valuations."""

from __future__ import annotations

from kovacic.algebra.poly import Poly
from kovacic.engine.places import Place, Problem


def singular_factor(problem: Problem, R: Poly, power: int) -> Poly:
    """D^power / Q0 for Q0 = prod p^(v_p) with Q0'/Q0 = R/D, where no v_p exceeds power times the weight of p."""
    result = problem.field.poly([1])
    for place in problem.finite_places:
        result = result * place.factor ** (power * place.weight - residue(problem, R, place))
    return result


def residue(problem: Problem, R: Poly, place: Place) -> int:
    """The integer residue v of R/D at the roots of a factor p: R/D = v p'/p + something regular at p."""
    p = place.factor
    rest = R if place.weight == 1 else R.exact_quotient(p ** (place.weight - 1))
    if rest is None:
        raise AssertionError("the logarithmic derivative of a rational function has simple poles")
    rest, cofactor = rest % p, problem.D // p**place.weight * p.derivative() % p
    value = rest[cofactor.degree] / cofactor.lc
    rational = problem.field.rational_value(value)
    if rest != cofactor * value or rational is None or rational.denominator != 1:
        raise AssertionError("the residues of the logarithmic derivative of a rational function are integers")
    return int(rational)
