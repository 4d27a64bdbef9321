"""The user's question: the equation, the unknown function, the conditions, and the user's own symbols.

The engine knows parameters by name.  Assumptions on them (integer, positive, ...) belong to SymPy's symbols: `Question.own`
puts these into an expression, and everything that is compared or evaluated has them.

A condition is linear, sum of c_k y^(m_k)(a_k) = v with m_k = 0 or 1: initial and boundary values, periodic conditions
y(0) = y(2 pi), Robin's y'(0) = h y(0).  At a singular point, and at oo and -oo, y(a) = v says that y tends to v there, and
y(a) = "bounded" that it stays bounded.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any, NamedTuple

import sympy
from sympy import Basic, Float, Function, S, Symbol, Tuple, oo
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.closed_form.atoms import Atoms
from kovacic.equation import EULER, PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.behaviour import value_or_limit
from kovacic.general_solution.integrands import NUMBERS
from kovacic.general_solution.steps import JUMPING, in_steps
from kovacic.limits import Limits
from kovacic.numbers.exact import exact_real, exact_text, is_complex
from kovacic.numbers.numerals import plain_text
from kovacic.parametric.assumptions import Assumptions, check_mapping, read_assumptions
from kovacic.reading.change_of_variable import function_of_x
from kovacic.reading.lexer import error_at
from kovacic.reading.pieces import Paste, conditions_in
from kovacic.reading.read import declared, read_input
from kovacic.reading.substitution import Template, value_text, values_among
from kovacic.reading.symbolic import function_of, functions_in, read_expression

Expr = Any  # SymPy publishes no types
#: The word that may stand in the place of a value.
BOUNDED = "bounded"


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

    def own(self, expression: Expr) -> Expr:
        """The expression with the user's symbols for parameters, and the meanings of letters."""
        return expression.xreplace(self._own)

    def at(self, values: Mapping[Expr, Expr]) -> tuple[Expr, Expr, dict[Expr, Any]]:
        """An expression that is zero, y(x), and the conditions for values of letters.  Raises as `conditions_at` does."""
        y, (x,) = self.function, self.function.args
        a, b, c, f = (self.own(e).xreplace({self.x: x}).subs(values) for e in self.coefficients)
        equation = a * y.diff(x, 2) + b * y.diff(x) + c * y - f
        return equation, y, conditions_at(values, ((y, condition) for condition in self.conditions))

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
    values = as_mapping(ics)
    floats = has_floats(eq, values)
    renamed: dict[Expr, Expr] = {}
    if isinstance(eq, Basic):
        renamed = {s: Symbol(f"{s.name}_", **s.assumptions0) for s in eq.free_symbols if s.name in (PI, EULER)}
        eq = exact_decimals(eq)
    eq, func, *sides = (
        given.xreplace(renamed) if isinstance(given, Basic) else given
        for given in (eq, func, *values, *values.values())
    )
    names = declared(parameters, about_letters(assume, var))
    parsed, given, function = _read_equation(eq, func, var, limits, names)
    if given.variable in (PI, EULER):
        raise InputError(f"{given.variable} is a number", hint="take another name for the variable")
    reader = ConditionReader(function)
    conditions = tuple(map(reader.read, sides, sides[len(values) :]))  # the left sides, then the right ones
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
        for symbol in sorted(condition.free_symbols, key=str):
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


def apart(eq: Any, ics: Any) -> tuple[Any, Any]:
    """The equation and its values, if a text has both: y'' + y = 0, y(0) = 1, y'(0) = 0."""
    if not isinstance(eq, str):
        return eq, ics
    paste = Paste(eq)
    values = dict(paste.conditions)
    if len(values) < len(paste.conditions):
        raise error_at(eq, "a value is given twice", paste.scans("condition")[-1], "write every value once")
    if values and ics:
        raise InputError("values stand in the equation's text and apart from it", hint="give them in one of these ways")
    return paste, values or ics


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


def has_floats(eq: Any, values: Mapping[Any, Any]) -> bool:
    """True if an equation, or given values, contain floats."""
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


# --------------------------------------------------------------------------------------------------------- conditions


class ConditionTerm(NamedTuple):
    """coefficient * y(point), or coefficient * y'(point) for order 1."""

    point: Expr
    order: int
    coefficient: Expr


@dataclass(frozen=True)
class Condition:
    """The sum of the terms is `value`, or bounded if that is None."""

    terms: tuple[ConditionTerm, ...]
    value: Expr | None
    text: str

    @property
    def points(self) -> tuple[Expr, ...]:
        return tuple(term.point for term in self.terms)

    @property
    def free_symbols(self) -> set[Expr]:
        """The symbols in its points, coefficients and value."""
        return Tuple(*self.terms, self.value or 0).free_symbols  # type: ignore[no-any-return]

    def in_symbols(self, others: Mapping[Expr, Expr]) -> Condition:
        """The condition in other symbols."""
        terms = (ConditionTerm(a.xreplace(others), order, c.xreplace(others)) for a, order, c in self.terms)
        return replace(self, terms=tuple(terms), value=self.value and self.value.xreplace(others))

    def of(self, y: Expr, x: Expr) -> Expr:
        """The sum of the terms for a function of x.  Raises `NotImplementedError` as `value_or_limit` does."""
        return sympy.Add(*(term.coefficient * value_or_limit(y, x, term.point, term.order) for term in self.terms))

    @property
    def is_value(self) -> bool:
        """True for y(a) = v and y'(a) = v."""
        return len(self.terms) == 1 and self.terms[0].coefficient == 1 and self.value is not None

    @property
    def by_order(self) -> tuple[Expr, Expr]:
        """alpha and beta, where the terms are alpha y + beta y' at one point."""
        parts = [S.Zero, S.Zero]
        for term in self.terms:
            parts[term.order] += term.coefficient
        return parts[0], parts[1]


def conditions_at(values: Mapping[Expr, Expr], conditions: Iterable[tuple[Expr, Condition]]) -> dict[Expr, Any]:
    """Conditions on functions, as for `dsolve`, for particular values of letters.  Raises `InputError` for two on one value."""
    found: dict[Expr, Any] = {}
    for y, condition in conditions:
        x = y.args[0]
        left = sympy.Add(*(c * y.diff(x, order).subs(x, a) for a, order, c in condition.terms)).subs(values)
        if left in found:
            raise InputError(f"two values are given for {left}")
        found[left] = BOUNDED if condition.value is None else condition.value.subs(values)
    return found


def periodicity(conditions: Sequence[Condition], ends: tuple[Expr, Expr]) -> int:
    """1 for y(a) = y(b), y'(a) = y'(b), -1 for y(a) = -y(b), y'(a) = -y'(b), and 0 for other conditions."""
    factors = {}
    for condition in conditions:
        orders = {term.order for term in condition.terms}
        at = {term.point: term.coefficient for term in condition.terms}
        if len(orders) == 1 and {*at} == {*ends}:
            factors[orders.pop()] = sympy.simplify(-at[ends[1]] / at[ends[0]])
    is_periodic = len(conditions) == 2 and factors in ({0: 1, 1: 1}, {0: -1, 1: -1})
    return int(factors[0]) if is_periodic else 0


def as_mapping(ics: Mapping[Any, Any] | str | None) -> dict[Any, Any]:
    """Conditions as a mapping, from a mapping or from one text: "y(0)=1, y'(0)=0".  Raises `InputError`."""
    pairs = conditions_in(ics) if isinstance(ics, str) else (ics or {}).items()
    found = dict(pairs)
    if len(found) < len(pairs):
        raise InputError(f"a value is given twice in {ics!r}", hint='write "y(0)=1, y\'(0)=0", every value once')
    return found


class ConditionReader:
    """Reads conditions on the unknown function y(x), which is written with the user's symbols, or by its name in a text."""

    def __init__(self, function: Expr) -> None:
        self.function = function
        self.unknown = str(function.func)
        self._symbols: dict[
            tuple[Expr, int], Expr
        ] = {}  # symbols for y(a), (a, 0), and y'(a), (a, 1), in an expression

    def read(self, key: Any, value: Any) -> Condition:
        """One condition.  Raises `InputError`."""
        self._symbols = {}
        whole = self._side(key)
        text = f"{plain_text(key)} = {plain_text(value)}"
        if not self._symbols:
            raise self._no_condition(key)
        is_bounded = plain_text(value).strip() == BOUNDED
        if not is_bounded:
            whole = sympy.expand(whole - self._side(value))
        slopes = {term: sympy.expand(whole.diff(symbol)) for term, symbol in self._symbols.items()}
        symbols = {*self._symbols.values()}
        if Tuple(*slopes.values()).free_symbols & symbols:
            raise InputError(f"the condition {key} isn't linear in {self.unknown}")
        terms = tuple(ConditionTerm(*term, slope) for term, slope in slopes.items() if slope != 0)
        if not terms:
            raise self._no_condition(key)
        rest = whole.xreplace(dict.fromkeys(symbols, S.Zero))
        return Condition(terms, None if is_bounded else -rest, text)

    def _side(self, side: Any) -> Expr:
        """One side with symbols for y(a), and for y(x).diff(x).subs(x, a) in either form that SymPy gives it."""
        if isinstance(side, str):  # `y(0)`, `y'(0) - h*y(0)`, or a constant
            value = read_expression(side, what="the initial value", values={self.unknown: self._symbol})
            return self._checked(value, side)
        value = _exact(side)
        value = value.xreplace({e: self._derivative(e.expr, e.point[0]) for e in value.atoms(sympy.Subs)})
        value = value.xreplace({e: self._derivative(e, e.expr.args[0]) for e in value.atoms(sympy.Derivative)})
        applied = sorted((e for e in value.atoms(AppliedUndef) if e.func == self.function.func), key=str)
        return self._checked(value.xreplace({e: self._symbol(e.args[0], 0) for e in applied if len(e.args) == 1}), side)

    def _derivative(self, derivative: Expr, point: Expr) -> Expr:
        orders = [int(count) for _, count in getattr(derivative, "variable_count", ())]
        if orders != [1] or derivative.expr.func != self.function.func:
            raise self._no_condition(derivative)
        return self._symbol(point, 1)

    def _symbol(self, point: Expr, order: int) -> Expr:
        """The symbol for y(a) or y'(a) in an expression."""
        if order > 1:
            raise self._no_condition(self.unknown + "'" * order + f"({point})")
        if point not in (oo, -oo):
            self._checked(point, point)
        return self._symbols.setdefault((point, order), Symbol(f"value_{len(self._symbols)}_"))

    def _checked(self, value: Expr, given: Any) -> Expr:
        """The value, which must be a constant.  Raises `InputError`."""
        if not isinstance(value, sympy.Expr) or value.has(oo, -oo, sympy.nan, sympy.zoo):
            raise InputError(f"the value {given!r} isn't a finite number")
        if str(self.function.args[0]) in map(str, value.free_symbols):
            raise InputError(f"{given} contains the variable: a condition holds at one point", hint="write y(0): 1")
        if value.atoms(AppliedUndef):
            raise InputError(f"the value {given!r} can't be read", hint="give a number, or text such as 'sqrt(2)'")
        return value

    def _no_condition(self, key: Any) -> InputError:
        y = self.unknown
        if isinstance(key, str):
            python, shell = f"write {{'{y}(0)': 1, \"{y}'(0)\": 2}}", f"write {y}(0) = 1, {y}'(0) = 2"
            return InputError(f"{key!r} isn't an initial value", hint=python, shell=shell)
        return InputError(f"{key} isn't an initial value", hint="write {y(0): 1, y(x).diff(x).subs(x, 0): 2}")


def _exact(given: Any) -> Expr:
    """A SymPy expression; a float becomes the decimal that is written for it."""
    if isinstance(given, sympy.Expr):
        return exact_decimals(given)
    if is_complex(given):
        return _exact(given.real) + sympy.I * _exact(given.imag)
    return sympy.Rational(exact_real(exact_text(given, "the value"), "the value"))


def exact_decimals(expression: Expr) -> Expr:
    """The expression with exact decimals for floats."""
    floats = (number for number in expression.atoms(Float) if number.is_finite)
    return expression.xreplace({number: sympy.Rational(str(number)) for number in floats})
