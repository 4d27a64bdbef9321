"""The question as the user asks it: the equation, the unknown function, the conditions, and the user's own symbols.

The engine knows parameters by name.  What the user knows of them (integer, positive, ...) is SymPy's: `Question.own` puts
the user's symbols into an expression, and everything that is compared or evaluated has them.

A condition is linear, sum of c_k y^(m_k)(a_k) = v with m_k = 0 or 1: initial and boundary values, periodic conditions
y(0) = y(2 pi), Robin's y'(0) = h y(0).  At a singular point, and at oo and -oo, y(a) = v says that y tends to v there, and
y(a) = "bounded" that it stays bounded.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any

import sympy
from sympy.core.function import AppliedUndef, UndefinedFunction

from kovacic.closed_form.atoms import Atoms
from kovacic.equation import EULER, PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.behaviour import value_at
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
#: Digits of a float that is given back.
_DIGITS = 15
#: The word that stands for a value.
BOUNDED = "bounded"
_NO_VALUES = (sympy.nan, sympy.zoo)


@dataclass(frozen=True)
class Question:
    """`function` is y(x) with the user's symbol for x, `symbols` are the user's own by name, and letters for constants.

    `given` is the equation as it was read; in `equation` a right-hand side with jumps is a sum of steps and impulses.
    `meanings` say what letters stand for, sqrt_k for sqrt(k), in the user's symbols.  `renamed` are other symbols for those
    with the names of numbers.  `has_floats`: floats were given, as coefficients or as values.
    """

    equation: Equation
    given: Equation
    function: Expr
    conditions: tuple[Condition, ...]
    symbols: Mapping[str, Expr]
    meanings: Mapping[Expr, Expr]
    renamed: Mapping[Expr, Expr]
    assumptions: Assumptions
    has_floats: bool
    #: What was guessed when a text was read.
    guesses: tuple[str, ...] = ()

    @property
    def x(self) -> Expr:
        """The variable of the solution: a plain symbol, with the user's name."""
        return sympy.Symbol(self.function.args[0].name)

    @property
    def parameters(self) -> dict[str, Expr]:
        """The user's symbols without that of the variable, and letters."""
        return {name: symbol for name, symbol in self.symbols.items() if name != self.x.name}

    @cached_property
    def coefficients(self) -> tuple[Expr, Expr, Expr, Expr]:
        """a, b, c and the right-hand side of the equation as it was read, in x."""
        equation = self.given
        t = sympy.Symbol(equation.variable)
        atoms = Atoms(t)
        a, b, c = (atoms.ratio(part).xreplace(NUMBERS) for part in (equation.a, equation.b, equation.c))
        f = atoms.sum(equation.f).xreplace(NUMBERS)
        h = sympy.sympify(equation.h or 0).xreplace(NUMBERS)
        if equation.change is None:
            return a, b, c, f + h
        # y_t = y'/t' and y_tt = y''/t'^2 - t'' y'/t'^3.
        value = function_of_x(equation)
        slope = value.diff(self.x)
        of_second, of_first, of_y, right = (part.subs(t, value) for part in (a, b, c, f))
        in_x = of_second / slope**2
        return in_x, of_first / slope - in_x * slope.diff(self.x) / slope, of_y, right + in_x * h

    def own(self, expression: Expr) -> Expr:
        """The expression in the user's symbols for the parameters, with what letters stand for."""
        return expression.xreplace(self._own) if self._own else expression

    def at(self, values: Mapping[Expr, Expr]) -> tuple[Expr, Expr, dict[Expr, Any]]:
        """The equation, an expression that is zero, y(x), and the conditions, as for `dsolve`, for values of letters.

        Raises `InputError` where two of the conditions are on the same value then.
        """
        y, (x,) = self.function, self.function.args
        a, b, c, f = (self.own(e).xreplace({self.x: x}).subs(values) for e in self.coefficients)
        equation = a * y.diff(x, 2) + b * y.diff(x) + c * y - f
        return equation, y, conditions_at(values, ((y, condition) for condition in self.conditions))

    def written(self, value: Expr) -> Expr:
        """Eq(y(x), value) with the user's symbols for the variable and for those with the names of numbers."""
        x = self.function.args[0]
        if x != self.x:  # where nothing is replaced SymPy keeps (x + 1)/2 as it is
            value = value.xreplace({self.x: x})
        found = sympy.Eq(self.function, value, evaluate=False)
        found = found.xreplace({new: symbol for symbol, new in self.renamed.items()})
        return sympy.Eq(found.lhs, with_floats(found.rhs), evaluate=False) if self.has_floats else found

    @cached_property
    def _own(self) -> dict[Expr, Expr]:
        """The user's symbols for plain ones, and what letters stand for."""
        pairs = {sympy.Symbol(name): self.meanings.get(symbol, symbol) for name, symbol in self.parameters.items()}
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
    """The question.  Raises `InputError` for what isn't one.

    What is assumed of a parameter is said of a symbol that stands for the user's own until the answer is written.
    """
    eq, ics = apart(eq, ics)
    values = as_mapping(ics)
    floats = has_floats(eq, values)
    renamed: dict[Expr, Expr] = {}
    if isinstance(eq, sympy.Basic):
        renamed = {s: sympy.Symbol(f"{s.name}_", **s.assumptions0) for s in eq.free_symbols if s.name in (PI, EULER)}
        eq = exact(eq)
    eq, func, *sides = (
        given.xreplace(renamed) if isinstance(given, sympy.Basic) else given
        for given in (eq, func, *values, *values.values())
    )
    names = declared(parameters, about_letters(assume, var))
    parsed, given, function = _read_equation(eq, func, var, limits, names)
    if given.variable in (PI, EULER):
        raise InputError(f"{given.variable} is a number", hint="take another name for the variable")
    reader = ConditionReader(function)
    conditions = tuple(map(reader.read, sides, sides[len(values) :]))  # the left sides, then the right ones
    symbols = {symbol.name: symbol for symbol in getattr(eq, "free_symbols", ())}
    own_names = parameters_of(given.S.field)
    letters = {name: sympy.Symbol(name) for name in own_names} | symbols
    known = known_letters(assume or {}, function.args[0], letters, conditions)
    symbols |= {symbol.name: symbol for symbol in known.values()}
    meanings = _meanings(parsed.letters, symbols)
    symbols |= {letter.name: letter for letter in meanings}
    about = {key: said for key, said in (assume or {}).items() if str(key) in own_names}
    equation = given
    if given.h is not None and given.h.has(*JUMPING):
        equation = replace(given, h=in_steps(given.h, sympy.Symbol(function.args[0].name)))
    return Question(
        equation=equation,
        given=given,
        function=function.xreplace(known),
        conditions=tuple(condition.in_symbols(known) for condition in conditions),
        symbols=symbols,
        meanings=meanings,
        renamed=renamed | known,
        assumptions=read_assumptions(about, sympy.Tuple(*symbols.values()), own_names),
        has_floats=floats,
        guesses=parsed.guesses,
    )


def free_constants(count: int, *parts: Expr) -> list[Expr]:
    """C1, C2, ..., or the next of these names that neither symbols nor functions in the parts have."""
    found = sympy.Tuple(*parts)
    names = (*found.free_symbols, *(f.func for f in found.atoms(AppliedUndef)))
    excluded = [sympy.Symbol(str(name)) for name in names]
    return [*islice(sympy.numbered_symbols("C", start=1, exclude=excluded), count)]


def about_letters(assume: Mapping[Any, Any] | None, var: str | None) -> dict[Any, Any]:
    """What is assumed of other names than x and t, the usual variables, and `var`: these are parameters."""
    return {key: said for key, said in (assume or {}).items() if str(key) not in ("x", "t", var)}


def known_letters(
    assume: Mapping[Any, Any], x: Expr, letters: Mapping[str, Expr], conditions: Sequence[Condition]
) -> dict[Expr, Expr]:
    """Symbols that know what is assumed, for x and for the letters of an equation, by name, and of its conditions.

    Raises `InputError` if something else is assumed of x than that it is positive.
    """
    others = {str(key): what for key, what in assume.items()}
    said = str(others.pop(x.name, "")).replace(" ", "")
    if said not in ("", "positive", ">0"):
        raise InputError(
            f"of the variable {x} it can only be assumed that it is positive", hint='assume={"x": "positive"}'
        )
    own = {symbol.name: symbol for condition in conditions for symbol in condition.free_symbols} | dict(letters)
    own.pop(x.name, None)
    return symbols_that_know(others, own) | ({x: sympy.Symbol(x.name, positive=True)} if said else {})


def symbols_that_know(assume: Mapping[Any, Any], own: Mapping[str, Expr]) -> dict[Expr, Expr]:
    """For the user's own symbols, by name, those that know what is assumed of them; none of which nothing more is."""
    known = read_assumptions(assume, sympy.Tuple(*own.values()), tuple(own)).symbols()
    return {own[name]: symbol for name, symbol in known.items() if symbol != own[name]}


def _meanings(letters: Sequence[tuple[str, Expr]], symbols: Mapping[str, Expr]) -> dict[Expr, Expr]:
    """The expressions in the user's symbols that letters stand for.  Powers are principal ones, and taken to be positive."""
    plain = {sympy.Symbol(name): symbol for name, symbol in symbols.items()}
    meanings = {}
    for name, meaning in letters:
        whole = meaning.xreplace(plain)
        is_principal_power = isinstance(whole, sympy.Pow | sympy.exp) and not whole.as_base_exp()[0].is_negative
        words = ("positive", "negative", "real")
        known = {word: True for word in words if getattr(whole, f"is_{word}")}
        meanings[sympy.Symbol(name, **({"positive": True} if is_principal_power else known))] = whole
    return meanings


def apart(eq: Any, ics: Any) -> tuple[Any, Any]:
    """The equation and its values, where a text has both: y'' + y = 0, y(0) = 1, y'(0) = 0."""
    if not isinstance(eq, str):
        return eq, ics
    paste = Paste(eq)
    values = dict(paste.conditions)
    if len(values) < len(paste.conditions):
        raise error_at(eq, "a value is given twice", paste.scans("condition")[-1], "write every value once")
    if values and ics:
        raise InputError("values stand in the equation's text and apart from it", hint="give them in one of these ways")
    return paste, values or ics


def with_values(eq: Any, ics: Any, assume: Mapping[Any, Any] | None, limits: Limits) -> tuple[Any, Any, Any]:
    """The texts of an equation and its conditions with the values that are among the assumptions, and the other assumptions.

    Raises `InputError` for values beside an equation that is no text.
    """
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
    return any(bool(e.atoms(sympy.Float)) if isinstance(e, sympy.Basic) else isinstance(e, float) for e in parts)


def with_floats(e: Expr) -> Expr:
    """With floats for constants that aren't integers; orders and parameters of functions, and roots, stay as they are.

    >>> x = sympy.Symbol("x")
    >>> print(with_floats(sympy.sqrt(2) * x**2 * sympy.exp(-x / 5)))
    1.4142135623731*x**2*exp(-0.2*x)
    """
    if e.is_Integer or e.is_Symbol or isinstance(e, sympy.Integral):
        return e
    if e.is_number and not e.has(sympy.Integral):
        value = e.evalf(_DIGITS)  # to as many digits as are given back; complex numbers as SymPy writes them
        return sympy.Float(str(value), _DIGITS) if e.is_real else value
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
        func = sympy.Function(name)(sympy.Symbol(argument)) if argument else sympy.Function(name)
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
        applied = unknown = applied or (_only_function(eq) if name is None else _applied_in(eq, name))
    parsed = read_input(eq, var=var, limits=limits, exponentials=True, unknown=unknown, equation=True, names=names)
    equation = parsed.equation
    if equation is None:
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    variable = equation.variable if equation.change is None else equation.change.variable
    function = applied or (name or sympy.Function(equation.unknown))(sympy.Symbol(variable))
    return parsed, equation, function


def _only_function(eq: Expr) -> Expr:
    """y(x), where no other function occurs.  Raises `NotLinear`."""
    function = function_of(eq)
    x = function.args[0]
    others = sorted({str(f) for f in functions_in(eq) if f.func != function.func and f.has(x)})
    if others:
        hint = f"if {', '.join(others)} is given, say what is sought: func={function}"
        raise NotLinear(f"{', '.join([str(function), *others])}: which is the unknown function?", hint=hint)
    return function


def _applied_in(eq: Any, func: Any) -> Expr:
    """y(x) in the equation, for the function y."""
    found = [f for f in eq.atoms(AppliedUndef) if f.func == func and f.args[0].is_Symbol]
    if not found:
        raise InputError(f"{func} isn't a function in the equation")
    return min(found, key=str)


# --------------------------------------------------------------------------------------------------------- conditions


@dataclass(frozen=True)
class Term:
    """coefficient * y(point), or times y'(point) for order 1."""

    point: Expr
    order: int
    coefficient: Expr


@dataclass(frozen=True)
class Condition:
    """The sum of the terms is `value`; None: it is bounded."""

    terms: tuple[Term, ...]
    value: Expr | None
    text: str

    @property
    def points(self) -> tuple[Expr, ...]:
        return tuple(term.point for term in self.terms)

    @property
    def free_symbols(self) -> set[Expr]:
        """Those of its points, coefficients and value."""
        parts = ((term.point, term.coefficient) for term in self.terms)
        return sympy.Tuple(*parts, self.value or 0).free_symbols  # type: ignore[no-any-return]

    def in_symbols(self, others: Mapping[Expr, Expr]) -> Condition:
        """The condition in other symbols."""
        terms = (Term(t.point.xreplace(others), t.order, t.coefficient.xreplace(others)) for t in self.terms)
        value = None if self.value is None else self.value.xreplace(others)
        return Condition(tuple(terms), value, self.text)

    def of(self, y: Expr, x: Expr) -> Expr:
        """The sum of the terms for a function of x.  Raises `NotImplementedError` as `value_at` does."""
        return sympy.Add(*(term.coefficient * value_at(y, x, term.point, term.order) for term in self.terms))

    @property
    def is_value(self) -> bool:
        """True for y(a) = v and y'(a) = v."""
        return len(self.terms) == 1 and self.terms[0].coefficient == 1 and self.value is not None

    @property
    def by_order(self) -> tuple[Expr, Expr]:
        """alpha and beta, where the terms are alpha y + beta y' at one point."""
        parts = [sympy.S.Zero, sympy.S.Zero]
        for term in self.terms:
            parts[term.order] += term.coefficient
        return parts[0], parts[1]


def conditions_at(values: Mapping[Expr, Expr], conditions: Iterable[tuple[Expr, Condition]]) -> dict[Expr, Any]:
    """Conditions on functions, as for `dsolve`, for particular values of letters.  Raises `InputError` for two on one value."""
    found: dict[Expr, Any] = {}
    for y, condition in conditions:
        x = y.args[0]
        left = sympy.Add(*(t.coefficient * y.diff(x, t.order).subs(x, t.point) for t in condition.terms)).subs(values)
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
    """Conditions that are given as a mapping, or as one text: "y(0)=1, y'(0)=0".  Raises `InputError`."""
    pairs = conditions_in(ics) if isinstance(ics, str) else (ics or {}).items()
    found = dict(pairs)
    if len(found) < len(pairs):
        raise InputError(f"a value is given twice in {ics!r}", hint='write "y(0)=1, y\'(0)=0", every value once')
    return found


class ConditionReader:
    """Reads conditions on the unknown function y(x): `function` as the user writes it, or its name in a text."""

    def __init__(self, function: Expr) -> None:
        self.function = function
        self.unknown = str(function.func)
        self._symbols: dict[tuple[Expr, int], Expr] = {}  # what stands for y(a), y'(a) in an expression

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
        if any(slope.free_symbols & symbols for slope in slopes.values()):
            raise InputError(f"the condition {key} isn't linear in {self.unknown}")
        terms = tuple(Term(point, order, slope) for (point, order), slope in slopes.items() if slope != 0)
        if not terms:
            raise self._no_condition(key)
        rest = whole.xreplace(dict.fromkeys(symbols, sympy.Integer(0)))
        return Condition(terms, None if is_bounded else -rest, text)

    def _side(self, side: Any) -> Expr:
        """One side with symbols for y(a), and for y(x).diff(x).subs(x, a) in either form that SymPy gives it."""
        if isinstance(side, str):  # `y(0)`, `y'(0) - h*y(0)`, or a constant
            value = read_expression(side, what="the initial value", values={self.unknown: self._symbol})
            return self._checked(value, side)
        value = _exact(side)
        for e in value.atoms(sympy.Subs):
            value = value.xreplace({e: self._derivative(e.expr, e.point[0])})
        for e in value.atoms(sympy.Derivative):
            value = value.xreplace({e: self._derivative(e, e.expr.args[0])})
        for e in sorted(value.atoms(AppliedUndef), key=str):
            if e.func == self.function.func and len(e.args) == 1:
                value = value.xreplace({e: self._symbol(e.args[0], 0)})
        return self._checked(value, side)

    def _derivative(self, derivative: Expr, point: Expr) -> Expr:
        orders = [int(count) for _, count in getattr(derivative, "variable_count", ())]
        if orders != [1] or derivative.expr.func != self.function.func:
            raise self._no_condition(derivative)
        return self._symbol(point, 1)

    def _symbol(self, point: Expr, order: int) -> Expr:
        """The symbol that stands for y(a) or y'(a) in an expression."""
        if order > 1:
            raise self._no_condition(self.unknown + "'" * order + f"({point})")
        if point not in (sympy.oo, -sympy.oo):
            self._checked(point, point)
        return self._symbols.setdefault((point, order), sympy.Symbol(f"value_{len(self._symbols)}_"))

    def _checked(self, value: Expr, given: Any) -> Expr:
        """Refuses what is no constant."""
        if not isinstance(value, sympy.Expr) or value.has(sympy.oo, -sympy.oo, *_NO_VALUES):
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
    """A SymPy expression; a float is the decimal that it is written as."""
    if isinstance(given, sympy.Expr):
        return exact(given)
    if is_complex(given):
        return _exact(given.real) + sympy.I * _exact(given.imag)
    return sympy.Rational(exact_real(exact_text(given, "the value"), "the value"))


def exact(expression: Expr) -> Expr:
    """With the decimals that floats are written as in their places."""
    floats: Iterator[Expr] = (number for number in expression.atoms(sympy.Float) if number.is_finite)
    return expression.xreplace({number: sympy.Rational(str(number)) for number in floats})
