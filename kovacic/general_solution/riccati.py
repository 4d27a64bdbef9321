"""Riccati equations: w' = p + q w + r w^2 by w = -u'/(r u),  u'' - (q + r'/r) u' + p r u = 0."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import Any

import sympy

from kovacic.closed_form.atoms import Atoms
from kovacic.equation import Equation
from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.first_order import read_first_order
from kovacic.limits import DEFAULT_LIMITS, Limits, limited, watched_seconds
from kovacic.numerals import as_latex, plain_text
from kovacic.process import last_of
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


#: Degrees of all coefficients of omega's polynomial together, from which on its change of variable is made in a process.
_LONG_POLYNOMIAL = 300


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
    all_algebraic = None if group is None else group.finite
    atoms = Atoms(sympy.Symbol(solution.variable))
    gauge = atoms.ratio(linear.gauge)
    factor = atoms.ratio(R)
    if solution.case != 1:
        polynomial = _polynomial(solution, gauge, factor, atoms)
        return RiccatiSolutions((), None, polynomial, all_algebraic, solution)
    family = _family(solution, factor, atoms.x) if all_algebraic else None
    if group is not None and group.order in (1, 2):  # infinitely many are rational
        return RiccatiSolutions((), family, None, all_algebraic, solution)
    rational = tuple(sympy.cancel(-(omega + gauge) / factor) for omega in _rational_omegas(solution, atoms))
    return RiccatiSolutions(rational, family, None, all_algebraic, solution)


def _read_coefficients(p: Any, q: Any, r: Any, var: str | None, limits: Limits) -> Equation:
    """r, q and p as the coefficients a, b and c of an equation; `p` alone may be Riccati's equation."""
    from kovacic.reading.read import read_coefficients

    if q is None and r is None:
        equation = read_first_order(p, None, var, limits)
        if equation is None or equation.is_linear:
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


def _family(solution: Solution, factor: Any, x: Any) -> Any:
    """w for u = y1 + C1 y2."""
    y1, y2 = solution.solutions
    u = y1 + sympy.Symbol("C1") * y2
    return sympy.cancel(sympy.powsimp(sympy.expand(-u.diff(x) / (factor * u))))


def _polynomial(solution: Solution, gauge: Any, factor: Any, atoms: Atoms) -> Any:
    """The polynomial for omega = -r w - gauge; None where that for omega isn't known."""
    if solution.riccati is None:
        return None
    w = sympy.Symbol("w")
    omega = -factor * w - gauge
    coefficients = solution.riccati.coefficients
    value = sum(atoms.ratio(c) * omega**k for k, c in enumerate(coefficients))
    degrees = sum(c.num.degree + c.den.degree for c in coefficients)
    if degrees < _LONG_POLYNOMIAL:
        return _cleared(value, w)
    return _cleared_apart(value, w)


def _cleared(value: Any, w: Any) -> Any:
    """The numerator, by powers of w."""
    return sympy.collect(sympy.expand(sympy.numer(sympy.together(value))), w)


def _cleared_apart(value: Any, w: Any) -> Any:
    """The same where it can be stopped, since SymPy may take minutes."""
    found = last_of(_yield_cleared, value, w, seconds=watched_seconds(inf))
    if found is None:
        raise LimitExceeded(
            "the polynomial of the algebraic solutions takes longer than the time limit", limit="seconds"
        )
    return found


def _yield_cleared(value: Any, w: Any) -> Iterator[Any]:
    yield _cleared(value, w)


def _rational_omegas(solution: Solution, atoms: Any) -> list[Any]:
    """One omega, or both where the group is diagonal: their sum is F'/F for the invariant F = y1 y2."""
    assert solution.omega is not None
    first = atoms.ratio(solution.omega)
    invariant = solution.decision.invariant
    if invariant is None or solution.group is None or solution.group.kind.value not in ("cyclic", "multiplicative"):
        return [first]
    return [first, atoms.ratio(invariant.logarithmic_derivative) - first]
