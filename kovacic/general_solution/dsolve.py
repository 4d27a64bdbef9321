"""`dsolve`: linear equations of second order, a y'' + b y' + c y = f, with values given: y = C1 y1 + C2 y2 + y0."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from itertools import islice
from typing import Any
from warnings import warn

import sympy
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.form import at_edges, solutions
from kovacic.closed_form.klein import KleinForm
from kovacic.decision import Status
from kovacic.equation import EULER, PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.antiderivatives import NUMBERS
from kovacic.general_solution.initial_values import as_mapping, constants, read_values
from kovacic.general_solution.particular import particular_solution, place_of
from kovacic.general_solution.real_basis import (
    are_independent,
    check_integrals,
    check_one_side,
    real_basis,
    real_particular,
)
from kovacic.general_solution.values import size
from kovacic.general_solution.variation import Basis, starting_at
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.parametric.api import conditions_of
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, read_assumptions
from kovacic.reading.exponential import solution_in_terms_of
from kovacic.reading.read import read_input
from kovacic.reading.symbolic import function_of
from kovacic.solution import Solution, solve
from kovacic.special.answer import special_functions
from kovacic.special.mathieu import mathieu
from kovacic.views.sentences import SCREEN


def dsolve(
    eq: Any,
    func: Any = None,
    *,
    ics: Mapping[Any, Any] | str | None = None,
    var: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Any:
    """The general solution of a linear equation of second order as a SymPy `Eq(y(x), ...)` with constants C1 and C2.

    `eq` is a SymPy `Eq` or an expression that is zero, or text; `func` is y(x) or y, where more than one function occurs.
    `ics` gives values at ordinary points as for `sympy.dsolve`, {y(0): 1, y(x).diff(x).subs(x, 0): 2}, or as text,
    "y(0)=1, y'(0)=2" or {"y(0)": 1, "y'(0)": 2}, at one point or, as boundary values, at several: the constants that they
    determine are found exactly, and one that stays is free.  Floats are the decimals that they are written as; values at
    the place of an impulse or a step are those just before it.  An integral that isn't done stays an `Integral`.

    With parameters, the answer holds for generic values; assumptions of their symbols are used.  Coefficients may be rational
    in exp(k x), or in sines, ... of multiples of k x, as well.

    Special functions are looked for where there is no Liouvillian solution; where that isn't proven because a limit was
    reached, a `UserWarning` says so.

    Raises `NotImplementedError` where none are found, with the reason, or where a limit was reached; `InputError` for what
    isn't such an equation and where no solution has the given values, and `ValueError` for values at a singular point.

    >>> print(dsolve("y'' + y = x"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + x)
    >>> print(dsolve("y'' - 2*x*y' + 2*y = 0", ics={"y(0)": 0, "y'(0)": 5}))
    Eq(y(x), 5*x)
    >>> print(dsolve("y'' + y = 0", ics="y(0)=0, y(pi/2)=3"))
    Eq(y(x), 3*sin(x))
    """
    return _general(eq, func, ics=ics, var=var, limits=limits)


def in_special_functions(found: Any, eq: Any, func: Any = None, **given: Any) -> Any:
    """What `dsolve` has `found`, in special functions: where that is more than a screen, and they take less than half of it.

    None where they take more, or none are known.  Arguments as for `dsolve`.
    """
    length = len(str(found.rhs))
    if length <= SCREEN:
        return None
    with suppress(NotImplementedError, InputError):
        other = _general(eq, func, special=True, **given)
        return other if len(str(other.rhs)) < length / 2 else None
    return None


def _general(
    eq: Any,
    func: Any,
    *,
    ics: Any = None,
    var: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
    special: bool = False,
) -> Any:
    budget = Budget(limits)
    with budget.watched():
        values, changes = as_mapping(ics), _changes_of(eq)
        for forward, _ in changes:
            eq, func, *pairs = (
                _substituted(e, forward) for e in (eq, func, *(e for item in values.items() for e in item))
            )
            values = dict(zip(pairs[::2], pairs[1::2], strict=True))
        equation, function = _read_equation(eq, func, var, budget.limits)
        if equation.variable in (PI, EULER):
            raise InputError(f"{equation.variable} is a number", hint="take another name for the variable")
        try:
            found = _solved(eq, equation, function, values, budget, special=special)
        except LimitExceeded as limit:
            raise NotImplementedError(f"undecided: {limit}") from None
        for _, back in reversed(changes):
            found = found.subs(back)
        return found


def _substituted(e: Any, forward: Mapping[Any, Any]) -> Any:
    return e.subs(forward) if isinstance(e, sympy.Basic) else e


def _solved(
    eq: Any, equation: Equation, function: Any, ics: Mapping[Any, Any], budget: Budget, *, special: bool
) -> Any:
    known = read_assumptions(None, eq, parameters_of(equation.S.field))
    solution = solve(equation, limits=budget.share(1).limits)
    if solution.status is Status.NONE_EXISTS and known.concerns_exponents:
        solution = solve(equation, assume=known.to_dict(), limits=budget.share(1).limits)
    symbols = {symbol.name: symbol for symbol in getattr(eq, "free_symbols", ())}
    given = read_values(ics, function, equation) if ics else ()
    if solution.case is None or special:
        own = {name: symbol for name, symbol in symbols.items() if name != solution.variable}
        pair: Any = special_functions(
            solution.S, solution.gauge, solution.variable, budget, symbols=own, joined=bool(given)
        )
        if not pair and equation.change is not None:
            pair = mathieu(solution.S, solution.gauge, equation.change, equation.variable) or pair
        either: Any = pair or (None, None)
        y1, y2 = either
        if y1 is None or (special and not are_independent(y1, y2, sympy.Symbol(solution.variable))):
            raise NotImplementedError(f"{no_solution(solution, known)}; {pair}")
        if solution.status is Status.UNDECIDED and not solution.known:
            warn(f"whether there is a Liouvillian solution is {no_solution(solution)}", stacklevel=4)
    else:
        y1, y2 = form = solutions(solution.S, solution.decision, solution.gauge, solution.variable)
        if given and isinstance(form.structure, KleinForm):
            y1, y2 = _joined(solution, form.structure, budget) or (y1, y2)
    change = equation.change
    x = sympy.Symbol(equation.variable if change is None else change.variable)
    if change is not None:
        y1, y2 = (solution_in_terms_of(change, y, equation.variable) for y in (y1, y2))
    elif given:
        jumps = equation.h.atoms(sympy.Heaviside, sympy.DiracDelta) if equation.h is not None else ()
        places = [place[0] for place in (place_of(jump, x) for jump in jumps) if place is not None]
        check_one_side((y1, y2), x, [*dict.fromkeys([*(g.point for g in given), *places])])
        y1, y2 = (starting_at(y, x, given[0].point) for y in real_basis(solution, y1, y2, x, given[0].point))
    points = [*dict.fromkeys(g.point for g in given)]
    basis = Basis(y1.xreplace(NUMBERS), y2.xreplace(NUMBERS), x, equation)
    particular = particular_solution(basis, given[0].point if given else None, budget)
    if given and change is None:
        check_one_side((particular,), x, points)
        check_integrals((y1, y2, particular), equation, x, [*points, *places])
        particular = real_particular(particular, equation, x, points[0])
    parts = (basis.y1, basis.y2, particular, *(part for g in given for part in (g.point, g.value)))
    taken = symbols.keys() | {symbol.name for e in parts for symbol in getattr(e, "free_symbols", ())}
    names = [*islice(sympy.numbered_symbols("C", start=1, exclude=map(sympy.Symbol, taken)), 2)]
    found = constants(given, basis, particular, names) if given else {}
    c1, c2 = (found.get(name, name) for name in names)
    factors = [sympy.Mul.make_args(y) for y in (basis.y1, basis.y2)]  # common ones come before the sum
    common = [factor for factor in factors[0] if factor in factors[1]] if c1 != 0 != c2 else []
    summands = ((c, [f for f in own if f not in common]) for c, own in zip((c1, c2), factors, strict=True) if c != 0)
    general = sympy.Mul(*common, sympy.Add(*(sympy.Mul(c, *own) for c, own in summands))) + particular
    if given:
        general = min(general, sympy.expand_mul(general, deep=False), key=size)
    own = {sympy.Symbol(name): symbol for name, symbol in symbols.items()} | {x: function.args[0]}
    changed = {
        plain: symbol for plain, symbol in own.items() if plain != symbol
    }  # a replacement by itself rebuilds all
    return sympy.Eq(function, general.xreplace(changed) if changed else general, evaluate=False)


def _joined(solution: Solution, form: KleinForm, budget: Budget) -> tuple[Any, Any] | None:
    """Other solutions in case 3, where J is 1 or infinite at real points that aren't singular: functions of J jump there."""
    S, places = solution.S, form.J.den * (form.J.num - form.J.den)
    while (common := places.gcd(S.den)).degree > 0:
        places //= common
    if places.degree == 0 or (S.field == QQ and not Atoms(sympy.Symbol("x")).poly(places).as_poly().count_roots()):
        return None
    pair = special_functions(S, solution.gauge, solution.variable, budget)
    if pair and are_independent(pair.y1, pair.y2, sympy.Symbol(solution.variable)):
        return pair.y1, pair.y2
    return at_edges(form, S, solution.gauge, solution.variable)


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


def _read_equation(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    """The equation and the unknown function as the user writes it."""
    applied = func if isinstance(func, AppliedUndef) else None
    name = func if applied is None else applied.func  # y of y(x)
    if func is not None and not isinstance(name, UndefinedFunction):
        raise InputError(f"{func!r} isn't a function", hint="give y(x), or y = Function('y')")
    if isinstance(eq, Equation):
        return eq, applied or (name or sympy.Function(eq.unknown))(sympy.Symbol(eq.variable))
    unknown: Any = None if func is None else str(name)
    if isinstance(eq, str):
        var = var if applied is None else str(applied.args[0])
    elif not hasattr(eq, "free_symbols"):
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    else:
        if func is not None and applied is None:
            found = sorted((f for f in eq.atoms(AppliedUndef) if f.func == func), key=str)
            applied = next((f for f in found if f.args[0].is_Symbol), None)
            if applied is None:
                raise InputError(f"{func} isn't a function in the equation")
        unknown = applied = function_of(eq) if applied is None else applied
    equation = read_input(eq, var=var, limits=limits, exponentials=True, unknown=unknown, equation=True).equation
    assert equation is not None
    x = sympy.Symbol(equation.variable if equation.change is None else equation.change.variable)
    return equation, applied or (name or sympy.Function(equation.unknown))(x)


def _changes_of(eq: Any) -> list[tuple[dict[Any, Any], dict[Any, Any]]]:
    """Symbols that are replaced in a SymPy expression, and the way back.

    A square root r of an expression that is linear in a parameter p: p in terms of r; and symbols with the names of numbers.
    """
    if not isinstance(eq, sympy.Basic):
        return []
    roots = [power for power in eq.atoms(sympy.Pow) if power.exp.is_Rational and power.exp.q == 2]
    variables = {symbol for f in eq.atoms(AppliedUndef) for symbol in f.free_symbols} if roots else set()
    found = []
    for power in sorted(roots, key=str):
        candidates = () if power.base.free_symbols & variables else sorted(power.base.free_symbols, key=str)
        linear = next((symbol for symbol in candidates if power.base.diff(symbol).is_Rational), None)
        if linear is not None:
            slope, new = power.base.diff(linear), sympy.Symbol(f"sqrt_{linear.name}", positive=True)
            rest = (power.base - slope * linear).expand()
            found = [({linear: (new**2 - rest) / slope}, {new: sympy.sqrt(power.base)})]
            break
    names = {s: sympy.Symbol(f"{s.name}_", **s.assumptions0) for s in eq.free_symbols if s.name in (PI, EULER)}
    return [*found, (names, {new: symbol for symbol, new in names.items()})] if names else found
