"""`dsolve`: linear equations of second order, a y'' + b y' + c y = f, with initial values: y = C1 y1 + C2 y2 + y0."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.form import solutions
from kovacic.decision import Status
from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.initial_values import Start, constants, read_initial_values
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.variation import particular_solution
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.reading.given import Equation
from kovacic.solution import Solution, solve


def dsolve(
    eq: Any,
    func: Any = None,
    *,
    ics: Mapping[Any, Any] | None = None,
    var: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Any:
    """The general solution of a linear equation of second order as a SymPy `Eq(y(x), ...)` with constants C1 and C2.

    `eq` is a SymPy `Eq` or an expression that is zero, or text; `func` is y(x), where more than one function occurs.  `ics`
    gives the values at one ordinary point as for `sympy.dsolve`, {y(0): 1, y(x).diff(x).subs(x, 0): 2}, or as text,
    {"y(0)": 1, "y'(0)": 2}: then the constants are determined exactly.  An integral that isn't done stays an `Integral`.

    Raises `NotImplementedError` where it is proven that there is no Liouvillian solution, with the reason, or where a limit
    was reached; `InputError` for what isn't such an equation, and `ValueError` for initial values at a singular point.

    >>> print(dsolve("y'' + y = x"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + x)
    >>> print(dsolve("y'' - 2*x*y' + 2*y = 0", ics={"y(0)": 0, "y'(0)": 5}))
    Eq(y(x), 5*x)
    """
    budget = Budget(limits)
    with budget.watched():
        return _solved(eq, func, ics, var, budget)


def _solved(eq: Any, func: Any, ics: Mapping[Any, Any] | None, var: str | None, budget: Budget) -> Any:
    equation, function = _read(eq, func, var, budget.limits)
    solution = solve(equation, limits=budget.share(1).limits)
    if solution.case is None:
        raise NotImplementedError(no_solution(solution))
    try:
        y1, y2 = solutions(solution.S, solution.decision, solution.gauge, solution.variable)
    except LimitExceeded as limit:
        raise NotImplementedError(f"undecided: {limit}") from None
    x = sympy.Symbol(equation.variable)
    start = read_initial_values(ics, function, equation) if ics else None
    particular = 0 if equation.is_homogeneous else _particular(equation, y1, y2, x, start, budget)
    given = {symbol.name: symbol for symbol in getattr(eq, "free_symbols", ())}
    taken = {*given, *(symbol.name for symbol in (y1 + y2 + particular).free_symbols)} | (
        start.names if start else set()
    )
    C1, C2 = islice(sympy.numbered_symbols("C", start=1, exclude=map(sympy.Symbol, taken)), 2)
    general = C1 * y1 + C2 * y2 + particular
    if start is not None:
        general = general.subs(constants(start, y1, y2, particular, x, (C1, C2)))
        general = sympy.expand_mul(general, deep=False)
    own = {sympy.Symbol(name): symbol for name, symbol in given.items()}
    return sympy.Eq(function, general.xreplace(own).subs(x, function.args[0]))


def no_solution(solution: Solution) -> str:
    """Why there is no closed form, in one sentence."""
    if solution.status is Status.UNDECIDED:
        return f"undecided: {solution.reason}"
    return (
        f"there is no Liouvillian solution, and that is proven: the differential Galois group of the normal form "
        f"y'' = ({solution.S.to_str(solution.variable)}) y is SL2(C)"
    )


def _read(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    if isinstance(eq, str | Equation):
        if isinstance(eq, str):
            from kovacic.reading.equation import parse_equation

            eq, _ = parse_equation(eq, variable=var, limits=limits)
        return eq, sympy.Function(eq.unknown)(sympy.Symbol(eq.variable))
    from kovacic.reading.from_sympy import parse_sympy_equation

    if not hasattr(eq, "free_symbols"):
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    equation, _, function = parse_sympy_equation(eq, variable=var, unknown=func, limits=limits)
    return equation, function


def _particular(equation: Equation, y1: Any, y2: Any, x: Any, start: Start | None, budget: Budget) -> Any:
    """A particular solution: a polynomial, by undetermined coefficients where these are constants, or by integrals."""
    atoms = Atoms(x)
    if equation.h is None and (polynomial := _polynomial_solution(equation)) is not None:
        return atoms.poly(polynomial)
    right = (atoms.sum(equation.f) + (equation.h or 0)) / atoms.ratio(equation.a)
    b, c = equation.b / equation.a, equation.c / equation.a
    if all(value.is_polynomial and value.num.degree <= 0 for value in (b, c)):
        found = undetermined(atoms.ratio(b), atoms.ratio(c), right, x)
        if found is not None:
            return found
    return particular_solution(y1, y2, right, x, start.point if start else None, budget.seconds_left)


def _polynomial_solution(equation: Equation) -> Poly | None:
    """A polynomial that solves the equation with a rational right-hand side, of a degree at most two above it, or None."""
    denominators = equation.a.den * equation.b.den * equation.c.den * equation.f.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, equation.f))
    field = f.field
    height = max(f.degree - min(p.degree for p in (a, b, c) if p), 0) + 2
    basis: list[tuple[Poly, Poly]] = []  # pairs (L[p], p), of different degrees of L[p]
    for k in range(height + 1):
        p: Any = field.poly([0] * k + [1])
        slope = p.derivative()
        image = a * slope.derivative() + b * slope + c * p
        for other, q in sorted(basis, key=lambda pair: -pair[0].degree):
            if image.degree == other.degree:
                ratio = image.lc / other.lc
                image, p = image - ratio * other, p - ratio * q
        if image:
            basis.append((image, p))
    result = field.poly([])
    for image, p in sorted(basis, key=lambda pair: -pair[0].degree):
        if f.degree == image.degree:
            ratio = f.lc / image.lc
            f, result = f - ratio * image, result + ratio * p
    return None if f else result
