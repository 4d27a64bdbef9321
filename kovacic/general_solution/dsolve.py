"""`dsolve`: linear equations of second order, a y'' + b y' + c y = f, with values given: y = C1 y1 + C2 y2 + y0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

import sympy

from kovacic.algebra.combination import combination
from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.form import solutions
from kovacic.closed_form.product import product
from kovacic.closed_form.product_display import display
from kovacic.decision import Status
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.general_solution.impulses import response
from kovacic.general_solution.initial_values import Given, constants, read_values
from kovacic.general_solution.real_basis import real_basis
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.variation import particular_solution
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.parametric.api import conditions_of
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, read_assumptions
from kovacic.reading.exponential import in_exponentials, in_terms_of, solution_in_terms_of
from kovacic.reading.from_sympy import function_of, parse_sympy_equation
from kovacic.reading.given import EULER, PI, Equation, Parsed, parameters_of
from kovacic.solution import Solution, solve
from kovacic.special.answer import special_functions


def dsolve(
    eq: Any,
    func: Any = None,
    *,
    ics: Mapping[Any, Any] | None = None,
    var: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Any:
    """The general solution of a linear equation of second order as a SymPy `Eq(y(x), ...)` with constants C1 and C2.

    `eq` is a SymPy `Eq` or an expression that is zero, or text; `func` is y(x) or y, where more than one function occurs.
    `ics` gives values at ordinary points as for `sympy.dsolve`, {y(0): 1, y(x).diff(x).subs(x, 0): 2}, or as text,
    {"y(0)": 1, "y'(0)": 2}, at one point or, as boundary values, at several: the constants that they determine are found
    exactly, and one that stays is free.  Floats are the decimals that they are written as; values at the place of an
    impulse or a step are those just before it.  An integral that isn't done stays an `Integral`.

    With parameters, the answer holds for generic values; assumptions of their symbols are used.  Coefficients may be rational
    in exp(k x), or in sines, ... of multiples of k x, as well.

    Raises `NotImplementedError` where it is proven that there is no Liouvillian solution, with the reason, or where a limit
    was reached; `InputError` for what isn't such an equation and where no solution has the given values, and `ValueError`
    for values at a singular point.

    >>> print(dsolve("y'' + y = x"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + x)
    >>> print(dsolve("y'' - 2*x*y' + 2*y = 0", ics={"y(0)": 0, "y'(0)": 5}))
    Eq(y(x), 5*x)
    >>> print(dsolve("y'' + y = 0", ics={"y(0)": 0, "y(pi/2)": 3}))
    Eq(y(x), 3*sin(x))
    """
    budget = Budget(limits)
    with budget.watched():
        radical = _radical(eq)
        if radical is None:
            return _solved(eq, func, ics, var, budget)
        root, symbol, value, new = radical
        own_ics = {
            key: value_.subs(symbol, value) if hasattr(value_, "subs") else value_
            for key, value_ in (ics or {}).items()
        }
        return _solved(eq.subs(symbol, value), func, own_ics, var, budget).subs(new, root)


def _solved(eq: Any, func: Any, ics: Mapping[Any, Any] | None, var: str | None, budget: Budget) -> Any:
    equation, function = _read(eq, func, var, budget.limits)
    known = read_assumptions(None, eq, parameters_of(equation.S.field))
    solution = solve(equation, limits=budget.share(1).limits)
    if solution.status is Status.NONE_EXISTS and known.concerns_exponents:
        solution = solve(equation, assume=known.to_dict(), limits=budget.share(1).limits)
    try:
        if solution.case is None:
            y1, y2 = _special(solution, eq, known, budget)
        else:
            y1, y2 = solutions(solution.S, solution.decision, solution.gauge, solution.variable)
    except LimitExceeded as limit:
        raise NotImplementedError(f"undecided: {limit}") from None
    change = equation.change
    x = sympy.Symbol(equation.variable if change is None else change.variable)
    if change is not None:
        y1, y2 = (solution_in_terms_of(change, y, equation.variable) for y in (y1, y2))
    given = read_values(ics, function, equation) if ics else ()
    if given and change is None:
        y1, y2 = real_basis(solution, y1, y2, x, given[0].point)
    numbers = {sympy.Symbol(name): value for name, value in ((PI, sympy.pi), (EULER, sympy.E))}
    y1, y2 = (y.xreplace(numbers) for y in (y1, y2))
    right = (Atoms(sympy.Symbol(equation.variable)).sum(equation.f) + (equation.h or 0)).xreplace(numbers)
    particular = _particular(equation, y1, y2, x, right, given, numbers, budget).xreplace(numbers)
    own = {symbol.name: symbol for symbol in getattr(eq, "free_symbols", ())}
    C1, C2 = _new_constants({*own}, (y1, y2, particular, *(part for g in given for part in (g.point, g.value))))
    general = C1 * y1 + C2 * y2 + particular
    if given:
        general = general.xreplace(constants(given, y1, y2, particular, x, (C1, C2)))
        general = sympy.expand_mul(general, deep=False)
    general = general.xreplace({sympy.Symbol(name): symbol for name, symbol in own.items()})
    return sympy.Eq(function, general.subs(x, function.args[0]), evaluate=False)


def _new_constants(taken: set[str], expressions: Sequence[Any]) -> list[Any]:
    """C1 and C2, or the next ones that don't occur."""
    names = taken | {symbol.name for e in expressions for symbol in getattr(e, "free_symbols", ())}
    return list(islice(sympy.numbered_symbols("C", start=1, exclude=map(sympy.Symbol, names)), 2))


def _special(solution: Solution, eq: Any, known: Assumptions, budget: Budget) -> tuple[Any, Any]:
    """Solutions in special functions where there is no Liouvillian one."""
    symbols = {symbol.name: symbol for symbol in getattr(eq, "free_symbols", ()) if symbol.name != solution.variable}
    found = special_functions(solution.S, solution.gauge, solution.variable, budget, symbols=symbols)
    if not found:
        raise NotImplementedError(f"{no_solution(solution, known)}; {found}")
    return found.y1, found.y2


def no_solution(solution: Solution, known: Assumptions = NOTHING_ASSUMED) -> str:
    """Why there is no closed form, in a sentence; with parameters, for which values there is one."""
    if solution.status is Status.UNDECIDED:
        return f"undecided: {solution.reason}"
    names = parameters_of(solution.S.field)
    group = (
        f"the differential Galois group of the normal form y'' = ({solution.S.to_str(solution.variable)}) y is SL2(C)"
    )
    if not names:
        return f"there is no Liouvillian solution, and that is proven: {group}"
    said = f"for generic {', '.join(names)} there is no Liouvillian solution, and that is proven: {group}"
    try:
        found = conditions_of(Parsed(solution.S, solution.variable), known, None, solution.limits)
    except LimitExceeded:
        return said
    regions = [region for region in found.regions if region.case is not None and region.defined]
    if not regions:
        return said + (f"; nor is there for any others ({found.theory})" if found.complete is True else "")
    listed = "; ".join(f"{region.statement} (case {region.case})" for region in regions[:6])
    more = "; ..." if len(regions) > 6 or found.complete is not True else ""
    return f"{said}\nthere is one where {listed}{more}: give such values"


def _read(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    """The equation and the unknown function as the user writes it."""
    try:
        return _rational(eq, func, var, limits)
    except NotRational:
        found = in_exponentials(eq, variable=var, limits=limits)
        if found is None or found.equation is None or found.equation.change is None:
            raise
        x = sympy.Symbol(found.equation.change.variable)
        name = sympy.Function(found.equation.unknown)(x)
        return found.equation, name if isinstance(eq, str) else function_of(eq)


def _rational(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    applied = func if isinstance(func, sympy.core.function.AppliedUndef) else None
    name = func if applied is None else applied.func  # y of y(x)
    if func is not None and not isinstance(name, sympy.core.function.UndefinedFunction):
        raise InputError(f"{func!r} isn't a function", hint="give y(x), or y = Function('y')")
    if isinstance(eq, str):
        from kovacic.reading.equation import parse_equation

        variable = var if applied is None else str(applied.args[0])
        unknown = None if func is None else str(name)
        eq, _ = parse_equation(eq, variable=variable, unknown=unknown, limits=limits)
    if isinstance(eq, Equation):
        return eq, applied or (name or sympy.Function(eq.unknown))(sympy.Symbol(eq.variable))
    if not hasattr(eq, "free_symbols"):
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    if func is not None and applied is None:
        found = sorted((f for f in eq.atoms(sympy.core.function.AppliedUndef) if f.func == func), key=str)
        whole = [f for f in found if f.args[0].is_Symbol]
        if not whole:
            raise InputError(f"{func} isn't a function in the equation")
        applied = whole[0]
    try:
        equation, _, function = parse_sympy_equation(eq, variable=var, unknown=applied, limits=limits)
    except NotRational:
        divided = _divided(eq)
        if divided is None:
            raise
        equation, _, function = parse_sympy_equation(divided, variable=var, unknown=applied, limits=limits)
    return equation, function


def _divided(eq: Any) -> Any:
    """An equation divided by the coefficient of its second derivative, where a common factor isn't rational; None without."""
    expression = eq.lhs - eq.rhs if isinstance(eq, sympy.Equality) else eq
    second = [d for d in expression.atoms(sympy.Derivative) if d.derivative_count == 2]
    leading = sympy.expand(expression).coeff(second[0]) if second else sympy.Integer(0)
    if not leading.has(sympy.Function):
        return None
    return sympy.Add(*(sympy.cancel(term / leading) for term in sympy.Add.make_args(sympy.expand(expression))))


def _radical(eq: Any) -> tuple[Any, Any, Any, Any] | None:
    """A square root r of an expression that is linear in a parameter p, p, p in terms of r, and the symbol r; None without."""
    if not isinstance(eq, sympy.Basic):
        return None
    variables = {symbol for f in eq.atoms(sympy.core.function.AppliedUndef) for symbol in f.free_symbols}
    for power in sorted(eq.atoms(sympy.Pow), key=str):
        base = power.base
        if power.exp.is_Rational and power.exp.q == 2 and not base.free_symbols & variables:
            for symbol in sorted(base.free_symbols, key=str):
                slope = base.diff(symbol)
                if slope.is_Rational:
                    new = sympy.Symbol(f"sqrt_{symbol.name}", positive=True)
                    rest = (base - slope * symbol).expand()
                    return sympy.sqrt(base), symbol, (new**2 - rest) / slope, new
    return None


def _particular(
    equation: Equation,
    y1: Any,
    y2: Any,
    x: Any,
    right: Any,
    given: Sequence[Given],
    numbers: Mapping[Any, Any],
    budget: Budget,
) -> Any:
    """A particular solution: a polynomial, by undetermined coefficients where these are constants, or by integrals."""
    if right == 0:
        return sympy.Integer(0)
    if equation.change is not None:  # in x, where y'' = (dt/dx)^2 Y'' + ...
        t = sympy.Symbol(equation.variable)
        right = in_terms_of(equation.change, right / Atoms(t).ratio(equation.a).xreplace(numbers), t.name)
        right = sympy.simplify(right * in_terms_of(equation.change, t, t.name).diff(x) ** 2)
        return particular_solution(y1, y2, right, x, given[0].point if given else None, budget.seconds_left)
    if equation.h is None and (polynomial := _polynomial_solution(equation)) is not None:
        return Atoms(x).poly(polynomial)
    right = right / Atoms(x).ratio(equation.a).xreplace(numbers)
    start = given[0].point if given else None

    def solved(right: Any) -> Any:
        found = _by_coefficients(equation, right, x, numbers)
        return particular_solution(y1, y2, right, x, start, budget.seconds_left) if found is None else found

    if right.has(sympy.DiracDelta, sympy.Heaviside):
        found = response(right, x, y1, y2, solved)
        if found is not None:
            return found
    return solved(right)


def _by_coefficients(equation: Equation, right: Any, x: Any, numbers: Mapping[Any, Any]) -> Any:
    """A solution of y'' + ... = right by undetermined coefficients; None where the equation or the right-hand side differ.

    Either the coefficients are constants; or y = G u, G the gauge factor, has u'' = S u + right/G with a constant S, or with
    S = s/(x - c)^2, which x = c + e^t turns into u_tt - u_t - s u = e^(2t) right/G.
    """
    atoms, S = Atoms(x), equation.S
    b, c = equation.b / equation.a, equation.c / equation.a
    if all(rate.is_polynomial and rate.num.degree <= 0 for rate in (b, c)):
        return undetermined(atoms.ratio(b).xreplace(numbers), atoms.ratio(c).xreplace(numbers), right, x)
    gauge = display(product(equation.gauge), atoms).xreplace(numbers)
    if S.is_polynomial and S.num.degree <= 0:
        found = undetermined(0, -atoms.ratio(S).xreplace(numbers), right / gauge, x)
        if found is not None or S:
            return None if found is None else sympy.Add(*(gauge * term for term in sympy.Add.make_args(found)))
    den = S.den if S else equation.gauge.den
    if den.degree == 0:
        return None
    root = den[den.degree - 1] / (den.degree * den.lc)  # -c
    s = S * S.field.poly([root, 1]) ** 2
    if not s.is_polynomial or s.num.degree > 0:
        return None
    t, u = sympy.Dummy(real=True), x + atoms.constant(root).xreplace(numbers)
    gauge = gauge.xreplace({atoms.primitive(s.field.poly([root, 1]))[1]: u})
    inner = (right / gauge).subs(x, sympy.exp(t) - u + x)
    found = undetermined(-1, -atoms.ratio(s).xreplace(numbers), sympy.exp(2 * t) * inner, t)
    if found is None:
        return None
    powers = found.replace(sympy.exp, lambda e: u ** e.diff(t) * sympy.exp(e.subs(t, 0)))
    return sympy.Add(*(gauge * term for term in sympy.Add.make_args(powers.subs(t, sympy.log(u)))))


def _polynomial_solution(equation: Equation) -> Poly | None:
    """A polynomial that solves the equation with a rational right-hand side, of a degree at most two above it, or None."""
    denominators = equation.a.den * equation.b.den * equation.c.den * equation.f.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, equation.f))
    x, height = f.field.poly([0, 1]), max(f.degree - min(p.degree for p in (a, b, c) if p), 0) + 2
    powers: list[Any] = [x**k for k in range(height + 1)]
    slopes = [p.derivative() for p in powers]
    images = [a * q.derivative() + b * q + c * p for p, q in zip(powers, slopes, strict=True)]
    found = combination(f, images)
    return None if found is None else sum((p * k for p, k in zip(powers, found, strict=True)), f * 0)
