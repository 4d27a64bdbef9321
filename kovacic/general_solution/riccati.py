"""Riccati equations: w' = p + q w + r w^2 by w = -u'/(r u),  u'' - (q + r'/r) u' + p r u = 0."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.general_solution.first_order import read_first_order
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, check_time, limited
from kovacic.numbers.numerals import as_latex, plain_text
from kovacic.reading.read import read_coefficients
from kovacic.solution import Solution, solve


@dataclass(frozen=True)
class RiccatiSolutions:
    """All rational and algebraic solutions of w' = p + q w + r w^2, as SymPy expressions in the variable.

    Iterating gives the rational ones, and a notebook shows what there is.

    Attributes
    ----------
    rational : tuple of sympy.Expr
        The rational solutions, where they are finitely many.
    family : sympy.Expr or None
        All solutions, with a constant C1, where all are algebraic and known in closed form; C1 may be infinite.
    polynomial : sympy.Expr or None
        A polynomial in w with the algebraic solutions of least degree as its roots.
    all_algebraic : bool or None
        Are all solutions algebraic?  None if that wasn't determined.
    solution : Solution
        The answer for the linear equation.

    Examples
    --------
    >>> import kovacic
    >>> found = kovacic.solve_riccati("w' = x^2 + 3 - w^2")
    >>> found.rational, found.family, found.polynomial, found.all_algebraic
    (((x**2 + 1)/x,), None, None, False)
    >>> kovacic.solve_riccati("w' = 2*w/x + w^2").family
    -3*C1*x**2/(C1*x**3 + 1)
    """

    rational: tuple[Any, ...]
    family: Any
    polynomial: Any
    all_algebraic: bool | None
    solution: Solution

    def __iter__(self) -> Any:
        return iter(self.rational)

    def _repr_latex_(self) -> str:
        found = [("w", w) for w in (self.family, *self.rational) if w is not None]
        if self.polynomial is not None:
            found.append((as_latex(self.polynomial), 0))
        return r",\quad ".join(f"{left} = {as_latex(right)}" for left, right in found).join("$$")


@limited
def solve_riccati(
    p: Any, q: Any = None, r: Any = None, *, var: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> RiccatiSolutions:
    """All rational and algebraic solutions of the Riccati equation w' = p + q w + r w^2 with rational p, q, r.

    Parameters
    ----------
    p, q, r : str, number or sympy.Expr
        The coefficients; or `p` alone is the equation, as text or from SymPy.
    var : str
        The name of the variable, where it isn't clear.
    limits : Limits
        Bounds on the input and on the work.

    Returns
    -------
    RiccatiSolutions
        If the group of the linear equation is trivial or {1, -1} all solutions are rational, with a constant: then `family` has
        them.

    Raises
    ------
    InputError
        For r = 0, which isn't a Riccati equation, and what `kovacic.solve` raises.

    Examples
    --------
    >>> found = solve_riccati("x^2 + 3", 0, -1)
    >>> found.rational, found.family, found.all_algebraic
    (((x**2 + 1)/x,), None, False)
    >>> solve_riccati("w' = x^2 + 3 - w^2").rational
    ((x**2 + 1)/x,)
    """
    given = _read_coefficients(p, q, r, var, limits)
    R = given.a
    Q = given.b
    P = given.c
    unit = R / R
    linear = Equation(unit, -(Q + R.derivative() / R), P * R, R - R, None, given.variable, "u")
    solution = solve(linear, limits=limits)
    group = solution.group
    if solution.case is None:
        are_all = None if group is None else False
        return RiccatiSolutions((), None, None, are_all, solution)
    if solution.series is not None:
        Budget(limits).check_degree(solution.series.degree, "a rational solution")
    all_algebraic = None if group is None else group.finite
    atoms = Atoms(sympy.Symbol(solution.variable))
    if solution.case != 1:
        polynomial = _polynomial(solution, linear.gauge, R, atoms)
        return RiccatiSolutions((), None, polynomial, all_algebraic, solution)
    gauge = atoms.ratio(linear.gauge)
    factor = atoms.ratio(R)
    family = None
    if all_algebraic:  # w for u = y1 + C1 y2
        y1, y2 = solution.solutions
        u = y1 + sympy.Symbol("C1") * y2
        family = sympy.cancel(sympy.powsimp(sympy.expand(-u.diff(atoms.x) / (factor * u))))
    if group is not None and group.order in (1, 2):  # infinitely many are rational
        return RiccatiSolutions((), family, None, all_algebraic, solution)
    rational = tuple(sympy.cancel(-(omega + gauge) / factor) for omega in _rational_omegas(solution, atoms))
    return RiccatiSolutions(rational, family, None, all_algebraic, solution)


def _read_coefficients(p: Any, q: Any, r: Any, var: str | None, limits: Limits) -> Equation:
    """r, q and p as the coefficients a, b and c of an equation; `p` alone may be Riccati's equation."""
    if q is None and r is None:
        equation = read_first_order(p, None, var, limits)
        if equation is None or equation.is_linear or equation.power != 2:
            raise InputError(f"{p} isn't a Riccati equation", hint="write w' = p + q*w + r*w^2, or give p, q and r")
        p = equation.p
        q = equation.q
        r = equation.r
        var = equation.x.name
    elif q is None or r is None:
        raise InputError("one of p, q, r is missing", hint="give all three, or an equation")
    if plain_text(r).strip() in ("0", "0.0"):
        raise InputError("r is zero: the equation is linear of first order")
    given = read_coefficients(r, q, p, 0, var=var, limits=limits).equation
    assert given is not None
    return given


def _polynomial(solution: Solution, gauge: RatFunc, factor: RatFunc, atoms: Atoms) -> Any:
    """The polynomial of omega = -r w - gauge in w, without a common factor; None if that for omega isn't known."""
    if solution.riccati is None:
        return None
    field = solution.riccati.coefficients[0].field
    slope, rest = (RatFunc(-part.num.over(field), part.den.over(field), reduced=True) for part in (factor, gauge))
    by_powers: list[RatFunc] = []
    for c in reversed(solution.riccati.coefficients):  # Horner: q(w) (slope w + rest) + c
        check_time()
        shifted = [rest * 0, *(a * slope for a in by_powers)]
        low = [*(a * rest for a in by_powers), rest * 0]
        by_powers = [a + b for a, b in zip(shifted, low, strict=True)]
        by_powers[0] = by_powers[0] + c
    w = sympy.Symbol("w")
    return sympy.Add(*(atoms.poly(a) * w**k for k, a in enumerate(_coprime(by_powers))))


def _coprime(fractions: list[RatFunc]) -> list[Poly]:
    """The multiples of rational functions that are polynomials without a common factor; over Q with coprime integers."""
    found = over_one_denominator(fractions)
    common = found[-1]
    for polynomial in found[:-1]:
        common = common.gcd(polynomial)
    found = [polynomial // common for polynomial in found]
    if found[0].field != QQ:
        return found
    contents = [polynomial.content() for polynomial in found if polynomial]
    content = Fraction(gcd(*(top for top, _ in contents)), lcm(*(bottom for _, bottom in contents)))
    if found[-1].rational_coefficients()[-1] < 0:
        content = -content
    return [polynomial * (1 / content) for polynomial in found]


def _rational_omegas(solution: Solution, atoms: Any) -> list[Any]:
    """One omega, or both where the group is diagonal: their sum is F'/F for the invariant F = y1 y2."""
    assert solution.omega is not None
    first = atoms.ratio(solution.omega)
    invariant = solution.decision.invariant
    if invariant is None or solution.group is None or solution.group.kind.value not in ("cyclic", "multiplicative"):
        return [first]
    return [first, atoms.ratio(invariant.logarithmic_derivative) - first]
