"""The user's question: the equation, the unknown function, the conditions, and the user's own symbols.

The engine knows parameters by name.  Assumptions on them (integer, positive, ...) belong to SymPy's symbols: `Question.own`
puts these into an expression, and everything that is compared or evaluated has them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any

import sympy
from sympy import Basic, Float, Function, Symbol, Tuple
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.steps import JUMPING, in_steps
from kovacic.equation import EULER, PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.conditions import Condition, apart, conditions_at, read_conditions, symbols_of
from kovacic.general_solution.integrands import NUMBERS
from kovacic.general_solution.substitution import exact_decimals
from kovacic.limits import Limits
from kovacic.parametric.assumptions import Assumptions, check_mapping, read_assumptions
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.pieces import Paste
from kovacic.reading.read import declared, read_input
from kovacic.reading.substitution import Template, value_text, values_among
from kovacic.reading.symbolic import function_of, functions_in

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class Question:
    """A linear equation of second order with its conditions, as the user writes it and as the engine reads it."""

    #: The equation as it was read; in `equation` a right-hand side with jumps is a sum of steps and impulses.
    equation: Equation
    given: Equation
    #: y(x) with the user's symbol for x.
    function: Expr
    conditions: tuple[Condition, ...]
    #: The user's own symbols by name, and letters for constants, such as sqrt_k, whose `meanings` are expressions, sqrt(k).
    symbols: Mapping[str, Expr]
    meanings: Mapping[Expr, Expr]
    #: Other symbols for the user's: for those with the names of numbers, and for those of which something is assumed.
    renamed: Mapping[Expr, Expr]
    assumptions: Assumptions
    #: True if coefficients or values were given as floats.
    has_floats: bool
    #: Guesses made when a text was read.
    guesses: tuple[str, ...] = ()

    @property
    def x(self) -> Expr:
        """The variable of the solution: a plain symbol, with the user's name."""
        return Symbol(self.function.args[0].name)

    @property
    def parameters(self) -> dict[str, Expr]:
        """The `symbols` without that of the variable."""
        return {name: symbol for name, symbol in self.symbols.items() if name != self.x.name}

    @cached_property
    def coefficients(self) -> tuple[Expr, Expr, Expr, Expr]:
        """a, b, c and the right-hand side of the equation as it was read, in x."""
        equation = self.given
        t = Symbol(equation.variable)
        atoms = Atoms(t)
        value = function_of_x(equation)
        slope = value.diff(self.x)
        in_t = (*map(atoms.ratio, (equation.a, equation.b, equation.c)), atoms.sum(equation.f))
        a, b, c, f = (part.xreplace(NUMBERS).subs(t, value) for part in in_t)
        # y_t = y'/t' and y_tt = y''/t'^2 - t'' y'/t'^3; h is divided by the coefficient of y'' if the variable was changed
        of_second = a / slope**2
        h = sympy.sympify(equation.h or 0).xreplace(NUMBERS) * (1 if equation.change is None else of_second)
        return of_second, b / slope - of_second * slope.diff(self.x) / slope, c, f + h

    @property
    def points(self) -> list[Expr]:
        """The points of the conditions, each once, in the order in which they are given."""
        return [*dict.fromkeys(point for condition in self.conditions for point in condition.points)]

    def own(self, expression: Expr) -> Expr:
        """The expression with the user's symbols for parameters, and the meanings of letters."""
        return expression.xreplace(self._own)

    def at(self, values: Mapping[Expr, Expr]) -> tuple[Expr, Expr, dict[Expr, Any]]:
        """An expression that is zero, y(x), and the conditions for values of letters.  Raises as `conditions_at` does."""
        y, (x,) = self.function, self.function.args
        a, b, c, f = (self.own(e).xreplace({self.x: x}).subs(values) for e in self.coefficients)
        equation = a * y.diff(x, 2) + b * y.diff(x) + c * y - f
        return equation, y, conditions_at(values, self.conditions)

    def written(self, value: Expr) -> Expr:
        """Eq(y(x), value) with the user's symbols for the variable and for those with the names of numbers."""
        x = self.function.args[0]
        if x != self.x:  # without a replacement SymPy keeps (x + 1)/2 unevaluated
            value = value.xreplace({self.x: x})
        found = sympy.Eq(self.function, value, evaluate=False)
        found = found.xreplace({new: symbol for symbol, new in self.renamed.items()})
        return sympy.Eq(found.lhs, with_floats(found.rhs), evaluate=False) if self.has_floats else found

    @cached_property
    def _own(self) -> dict[Expr, Expr]:
        """The user's symbols for plain ones, and the meanings of letters."""
        pairs = {Symbol(name): self.meanings.get(symbol, symbol) for name, symbol in self.parameters.items()}
        return {plain: symbol for plain, symbol in pairs.items() if plain != symbol} | dict(self.meanings)


def read_question(
    eq: Any,
    func: Any,
    ics: Any,
    var: str | None,
    limits: Limits,
    parameters: Sequence[str] = (),
    assume: Mapping[Any, Any] | None = None,
) -> Question:
    """The question, with symbols that carry the assumptions for the user's own.  Raises `InputError` for anything else."""
    eq, ics = apart(eq, ics)
    floats = has_floats(eq, ics)
    renamed: dict[Expr, Expr] = {}
    if isinstance(eq, Basic):
        renamed = {s: Symbol(f"{s.name}_", **s.assumptions0) for s in eq.free_symbols if s.name in (PI, EULER)}
        eq = exact_decimals(eq)
    eq, func = (given.xreplace(renamed) if isinstance(given, Basic) else given for given in (eq, func))
    names = declared(parameters, about_letters(assume, var))
    parsed, given, function = _read_equation(eq, func, var, limits, names)
    if given.variable in (PI, EULER):
        raise InputError(f"{given.variable} is a number", hint="take another name for the variable")
    conditions = [condition.in_symbols(renamed) for condition in read_conditions(ics, function)]
    symbols = {symbol.name: symbol for symbol in sorted(getattr(eq, "free_symbols", ()), key=str)}
    own_names = parameters_of(given.S.field)
    letters = {name: Symbol(name) for name in own_names} | symbols
    known = known_letters(assume or {}, function.args[0], letters, conditions)
    symbols |= {symbol.name: symbol for symbol in known.values()}
    meanings = _meanings(parsed.letters, symbols)
    symbols |= {letter.name: letter for letter in meanings}
    about = {key: words for key, words in (assume or {}).items() if str(key) in own_names}
    equation = given
    if given.h is not None and given.h.has(*JUMPING):
        equation = replace(given, h=in_steps(given.h, Symbol(function.args[0].name)))
    return Question(
        equation=equation,
        given=given,
        function=function.xreplace(known),
        conditions=tuple(condition.in_symbols(known) for condition in conditions),
        symbols=symbols,
        meanings=meanings,
        renamed=renamed | known,
        assumptions=read_assumptions(about, Tuple(*symbols.values()), own_names),
        has_floats=floats,
        guesses=parsed.guesses,
    )


def free_constants(count: int, *parts: Expr) -> list[Expr]:
    """C1, C2, ..., without names that symbols or functions in the parts have."""
    found = Tuple(*parts)
    names = (*found.free_symbols, *(f.func for f in found.atoms(AppliedUndef)))
    excluded = [Symbol(str(name)) for name in names]
    return [*islice(sympy.numbered_symbols("C", start=1, exclude=excluded), count)]


def about_letters(assume: Mapping[Any, Any] | None, var: str | None) -> dict[Any, Any]:
    """The assumptions on names other than x and t, the usual variables, and `var`: on parameters."""
    return {key: words for key, words in (assume or {}).items() if str(key) not in ("x", "t", var)}


def known_letters(
    assume: Mapping[Any, Any], x: Expr, letters: Mapping[str, Expr], conditions: Sequence[Condition]
) -> dict[Expr, Expr]:
    """Symbols with assumptions for x, for letters by name, and for those of conditions.  Raises `InputError`."""
    others = {str(key): words for key, words in assume.items()}
    of_x = str(others.pop(x.name, "")).replace(" ", "")
    if of_x not in ("", "positive", ">0"):
        what = f"of the variable {x} it can only be assumed that it is positive"
        raise InputError(what, hint='assume={"x": "positive"}')
    own = dict(letters)
    for condition in conditions:
        for symbol in sorted(symbols_of([condition]), key=str):
            own.setdefault(symbol.name, symbol)
    own.pop(x.name, None)
    return with_assumptions(others, own) | ({x: Symbol(x.name, positive=True)} if of_x else {})


def with_assumptions(assume: Mapping[Any, Any], own: Mapping[str, Expr]) -> dict[Expr, Expr]:
    """Symbols that carry assumptions, by the user's own ones, which are given by name; only those that gain any."""
    known = read_assumptions(assume, Tuple(*own.values()), tuple(own)).symbols()
    return {own[name]: symbol for name, symbol in known.items() if symbol != own[name]}


def _meanings(letters: Sequence[tuple[str, Expr]], symbols: Mapping[str, Expr]) -> dict[Expr, Expr]:
    """The meanings of letters in the user's symbols.  Powers are principal ones, and assumed to be positive."""
    plain = {Symbol(name): symbol for name, symbol in symbols.items()}
    meanings = {}
    for name, meaning in letters:
        whole = meaning.xreplace(plain)
        is_principal_power = isinstance(whole, sympy.Pow | sympy.exp) and not whole.as_base_exp()[0].is_negative
        known = [word for word in ("positive", "negative", "real") if getattr(whole, f"is_{word}")]
        meanings[Symbol(name, **dict.fromkeys(["positive"] if is_principal_power else known, True))] = whole
    return meanings


def with_given_values(eq: Any, ics: Any, assume: Mapping[Any, Any] | None, limits: Limits) -> tuple[Any, Any, Any]:
    """Texts of an equation and its conditions with values from the assumptions, and the others.  Raises `InputError`."""
    check_mapping(assume)
    values, others = values_among(assume or {})
    if not values:
        return eq, ics, others
    if not isinstance(eq, str) or not isinstance(ics or "", str):
        name, value = next(iter(values.items()))
        raise InputError(f"{name} = {value} is a value, not an assumption", hint="substitute it in the equation")
    texts = {name: value_text(value, name, limits=limits) for name, value in values.items()}
    return Template(f"{eq}, {ics}" if ics else eq, [*texts]).filled(texts), None, others


def has_floats(eq: Any, ics: Any) -> bool:
    """True if an equation, or given values, contain floats."""
    values = ics if isinstance(ics, Mapping) else {}
    parts = (eq, *values, *values.values())
    return any(isinstance(e, float) or (isinstance(e, Basic) and e.has(Float)) for e in parts)


def with_floats(e: Expr) -> Expr:
    """The expression with floats for constants other than integers, roots, and orders and parameters of functions.

    >>> x = Symbol("x")
    >>> print(with_floats(sympy.sqrt(2) * x**2 * sympy.exp(-x / 5)))
    1.4142135623731*x**2*exp(-0.2*x)
    """
    if e.is_Integer or e.is_Symbol or isinstance(e, sympy.Integral):
        return e
    if e.is_number and not e.has(sympy.Integral):
        value = e.evalf(15)  # SymPy's default precision; complex numbers as SymPy writes them
        return Float(str(value), 15) if e.is_real else value
    if e.is_Pow and e.exp.is_Rational and e.exp.q <= 2:
        return with_floats(e.base) ** e.exp
    if e.is_Function and len(e.args) > 1:
        *parameters, argument = e.args
        return e.func(*parameters, with_floats(argument), evaluate=False)
    return e.func(*map(with_floats, e.args))


def _sought(func: Any) -> tuple[Any, Any]:
    """y(x) and y, each None if it isn't given.  Raises `InputError` for anything else."""
    if isinstance(func, str) and (found := re.fullmatch(r"([^\W\d]\w*)(?:\(([^\W\d]\w*)\))?", func.replace(" ", ""))):
        name, argument = found.groups()
        func = Function(name)(Symbol(argument)) if argument else Function(name)
    applied = func if isinstance(func, AppliedUndef) else None
    name = getattr(applied, "func", func)
    if not isinstance(name, UndefinedFunction | None):
        raise InputError(f"{func!r} isn't a function", hint="""give "y(x)", y(x), or y = Function('y')""")
    return applied, name


def _read_equation(
    eq: Any, func: Any, var: str | None, limits: Limits, names: Sequence[str]
) -> tuple[Parsed, Equation, Expr]:
    """The input as read, its equation, and the unknown function in the user's notation.  Raises `InputError`."""
    applied, name = _sought(func)
    unknown: Any = None
    if isinstance(eq, str | Paste):
        var = var if applied is None else str(applied.args[0])
        unknown = None if name is None else str(name)
    elif hasattr(eq, "free_symbols"):
        names = ()
        applied = unknown = applied or _applied_in(eq, name)
    parsed = read_input(eq, var=var, limits=limits, exponentials=True, unknown=unknown, equation=True, names=names)
    equation = parsed.equation
    if equation is None:
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    variable = equation.variable if equation.change is None else equation.change.variable
    function = applied or (name or Function(equation.unknown))(Symbol(variable))
    return parsed, equation, function


def _applied_in(eq: Expr, name: Any) -> Expr:
    """y(x) in the equation, for the function y, or for None if there is no other.  Raises `InputError`."""
    if name is not None:
        found = [f for f in eq.atoms(AppliedUndef) if f.func == name and f.args[0].is_Symbol]
        if not found:
            raise InputError(f"{name} isn't a function in the equation")
        return min(found, key=str)
    function = function_of(eq)
    others = sorted({str(f) for f in functions_in(eq) if f.func != function.func and f.has(function.args[0])})
    if others:
        hint = f"if {', '.join(others)} is given, say what is sought: func={function}"
        raise NotLinear(f"{', '.join([str(function), *others])}: which is the unknown function?", hint=hint)
    return function
