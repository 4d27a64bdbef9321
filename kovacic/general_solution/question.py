"""The question as the user asks it: the equation, the unknown function, the conditions, and the user's own symbols.

The engine knows parameters by name.  What the user knows of them (integer, positive, ...) is SymPy's: `Question.own` puts
the user's symbols into an expression, and everything that is compared or evaluated has them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.equation import EULER, PI, Equation, parameters_of
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.conditions import Condition, ConditionReader, as_mapping, exact
from kovacic.limits import Limits
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.reading.parser import listed
from kovacic.reading.read import read_input
from kovacic.reading.symbolic import function_of, functions_in

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class Question:
    """`function` is y(x) with the user's symbol for x, `symbols` are the user's own by name.

    `back` are replacements that lead from the symbols of the equation to what was given: sqrt_k to sqrt(k).  `has_floats`:
    floats were given, as coefficients or as values.
    """

    equation: Equation
    function: Expr
    conditions: tuple[Condition, ...]
    symbols: Mapping[str, Expr]
    assumptions: Assumptions
    back: tuple[dict[Expr, Expr], ...]
    has_floats: bool

    @property
    def x(self) -> Expr:
        """The variable of the solution: a plain symbol, with the user's name."""
        return sympy.Symbol(self.function.args[0].name)

    @property
    def parameters(self) -> dict[str, Expr]:
        """The user's symbols without that of the variable."""
        return {name: symbol for name, symbol in self.symbols.items() if name != self.x.name}

    def own(self, expression: Expr) -> Expr:
        """The expression in the user's symbols for the parameters."""
        pairs = {sympy.Symbol(name): symbol for name, symbol in self.parameters.items()}
        # A replacement of symbols by themselves would build the whole expression anew.
        changed = {plain: symbol for plain, symbol in pairs.items() if plain != symbol}
        return expression.xreplace(changed) if changed else expression


def read_question(eq: Any, func: Any, ics: Any, var: str | None, limits: Limits) -> Question:
    """The question.  Raises `InputError` for what isn't one."""
    eq, ics = apart(eq, ics)
    values = as_mapping(ics)
    floats = _has_floats(eq) or any(_has_floats(value) for item in values.items() for value in item)
    if isinstance(eq, sympy.Basic):
        eq = exact(eq)
    changes = _changes_of(eq)
    for forward, _ in changes:
        eq = _substituted(eq, forward)
        func = _substituted(func, forward)
        values = {_substituted(key, forward): _substituted(value, forward) for key, value in values.items()}
    equation, function = _read_equation(eq, func, var, limits)
    if equation.variable in (PI, EULER):
        raise InputError(f"{equation.variable} is a number", hint="take another name for the variable")
    reader = ConditionReader(function, equation.unknown)
    conditions = tuple(reader.read(key, value) for key, value in values.items())
    return Question(
        equation=equation,
        function=function,
        conditions=conditions,
        symbols={symbol.name: symbol for symbol in getattr(eq, "free_symbols", ())},
        assumptions=read_assumptions(None, eq, parameters_of(equation.S.field)),
        back=tuple(back for _, back in reversed(changes)),
        has_floats=floats,
    )


#: y(0) = 1, y'(pi) = 0: what stands behind an equation in one text with it.
_VALUE = re.compile(r"\w+['’′″]*\s*\([^=]*\)\s*=")


def apart(eq: Any, ics: Any) -> tuple[Any, Any]:
    """The equation and its values, where a text has both: y'' + y = 0, y(0) = 1, y'(0) = 0."""
    if not isinstance(eq, str):
        return eq, ics
    equation, *values = listed(eq)
    if not values or not all(_VALUE.match(value) for value in values):
        return eq, ics
    if ics:
        raise InputError("values stand in the equation's text and apart from it", hint="give them in one of these ways")
    return equation, ", ".join(values)


def _has_floats(given: Any) -> bool:
    return isinstance(given, float) or bool(isinstance(given, sympy.Basic) and given.atoms(sympy.Float))


def _substituted(e: Any, forward: Mapping[Any, Any]) -> Any:
    return e.subs(forward) if isinstance(e, sympy.Basic) else e


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
            applied = _applied_in(eq, func)
        unknown = applied = _only_function(eq) if applied is None else applied
    equation = read_input(eq, var=var, limits=limits, exponentials=True, unknown=unknown, equation=True).equation
    assert equation is not None
    variable = equation.variable if equation.change is None else equation.change.variable
    return equation, applied or (name or sympy.Function(equation.unknown))(sympy.Symbol(variable))


def _only_function(eq: Expr) -> Expr:
    """y(x), where no other function occurs.  Raises `NotLinear`."""
    function = function_of(eq)
    others = sorted({str(f) for f in functions_in(eq) if f.func != function.func})
    if others:
        hint = f"if {', '.join(others)} is given, say what is sought: func={function}"
        raise NotLinear(f"{', '.join([str(function), *others])}: which is the unknown function?", hint=hint)
    return function


def _applied_in(eq: Any, func: Any) -> Expr:
    """y(x) in the equation, for the function y."""
    found = sorted((f for f in eq.atoms(AppliedUndef) if f.func == func), key=str)
    applied = next((f for f in found if f.args[0].is_Symbol), None)
    if applied is None:
        raise InputError(f"{func} isn't a function in the equation")
    return applied


Renamed = tuple[dict[Expr, Expr], dict[Expr, Expr]]


def _changes_of(eq: Any) -> list[Renamed]:
    """Symbols that are replaced in a SymPy expression, and the way back: roots, and symbols with the names of numbers."""
    if not isinstance(eq, sympy.Basic):
        return []
    root = _root_of_parameter(eq)
    names = {s: sympy.Symbol(f"{s.name}_", **s.assumptions0) for s in eq.free_symbols if s.name in (PI, EULER)}
    found = [] if root is None else [root]
    if names:
        found.append((names, {new: symbol for symbol, new in names.items()}))
    return found


def _root_of_parameter(eq: Expr) -> Renamed | None:
    """For a square root r of an expression that is linear in a parameter p: p in terms of r."""
    roots = [power for power in eq.atoms(sympy.Pow) if power.exp.is_Rational and power.exp.q == 2]
    variables = {symbol for f in eq.atoms(AppliedUndef) for symbol in f.free_symbols} if roots else set()
    for power in sorted(roots, key=str):
        if power.base.free_symbols & variables:
            continue
        candidates = sorted(power.base.free_symbols, key=str)
        linear = next((symbol for symbol in candidates if power.base.diff(symbol).is_Rational), None)
        if linear is not None:
            slope = power.base.diff(linear)
            new = sympy.Symbol(f"sqrt_{linear.name}", positive=True)
            rest = (power.base - slope * linear).expand()
            return {linear: (new**2 - rest) / slope}, {new: sympy.sqrt(power.base)}
    return None
