"""Texts and SymPy equations into an equation a y'' + b y' + c y = f.

>>> equation, notices = parse_equation("x^2 y'' + x y' + (x^2 - 1/4) y = 0")
>>> print(equation)
x^2*y'' + x*y' + (x^2 - 1/4)*y = 0
>>> print(parse_equation("diff((1-t^2)*diff(y(t),t),t) + 6*y(t) = exp(t)")[0])
(-t^2 + 1)*y'' - 2*t*y' + 6*y = exp(t)

The grammar is that of expressions; an expression without an equals sign is one that is zero.  The unknown function is the
one that is differentiated, and its derivatives are written y'', y''(x), diff(y, x, 2), diff(y(x), (x, 2)) or Derivative.
Within an equation the unknown function may follow a coefficient without a sign: x y'' + 2x y'.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from kovacic.errors import InputError, NotLinear, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, NotAnInteger, Term
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.expression import Place, RationalReader
from kovacic.reading.from_sympy import function_of, functions_in, names_of, walked
from kovacic.reading.given import (
    DEFAULT_VARIABLE,
    ENERGY,
    EULER,
    FUNCTION_NAMES,
    NUMBER_NAMES,
    PI,
    TRANSCENDENTAL_HINT,
    UNKNOWN,
    Equation,
    over,
)
from kovacic.reading.lexer import DERIVATIVES, PRIMES, Tokens, tokens_of
from kovacic.reading.linear import REST, LinearArithmetic, LinearForm, is_rational
from kovacic.reading.parser import Site, evaluate

_LARGEST_ORDER = 100

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
_USUAL_VARIABLES = frozenset("xtzsruXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}


def parse_equation(
    text: str, *, variable: str | None = None, unknown: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> tuple[Equation, tuple[str, ...]]:
    """The equation that `text` denotes, and what the user should know about how it was read.

    Raises `NotLinear` for an equation that isn't linear of second order in one unknown function, `NotRational` if its
    coefficients aren't rational functions, `ParseError` for what isn't an equation, all with the position where there is
    one; `LimitExceeded`.
    """
    tokens = tokens_of(text, limits, what="the text", hint="for example y'' = (x^2 + 3) y")
    x, y = names_in_equation(tokens, variable, unknown)
    return _read(partial(evaluate, tokens), x, y, limits, text)


def parse_sympy_equation(
    value: Any, *, variable: str | None = None, unknown: Any = None, limits: Limits = DEFAULT_LIMITS
) -> tuple[Equation, tuple[str, ...], Any]:
    """The equation, what the user should know about how it was read, and the function y(x) that occurs in it.

    Read are `Eq(lhs, rhs)` and expressions that are zero, in an applied function such as y(x) and its derivatives; `unknown`
    is that function, where more than one occurs.  Raises `NotLinear`, `NotRational` and `LimitExceeded`.
    """
    from sympy import E, pi

    expression, function = sympy_equation(value, variable, unknown)
    names = names_of(expression)
    for letter, number in ((PI, pi), (EULER, E)):
        if letter in names and expression.has(number):
            raise InputError(f"{letter} is a symbol and a number in one equation", hint="rename the symbol")
    x, y = function.args[0].name, str(function.func)
    return *_read(partial(walked, expression), x, y, limits, None), function


def sympy_equation(value: Any, variable: str | None, unknown: Any) -> tuple[Any, Any]:
    """An expression that is zero, and the function y(x) in it."""
    expression = value.lhs - value.rhs if getattr(value, "is_Equality", False) else value
    function = function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    if variable is not None and function.args[0].name != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    return expression, function


def _read(
    walk: Callable[[RationalReader], Any], x: str, y: str, limits: Limits, text: str | None
) -> tuple[Equation, tuple[str, ...]]:
    def read(constants: Constants) -> tuple[Equation, tuple[str, ...]]:
        reader = EquationReader(x, y, limits, constants)
        equation = reader.equation_of(walk(reader), text)
        return equation, (*reader.notices(), *constants.notices())

    return read_with_constants(read, limits)


class EquationReader(RationalReader):
    """What texts and SymPy expressions mean in which the unknown function and its derivatives occur linearly."""

    arithmetic: LinearArithmetic
    constants: Constants

    def __init__(self, variable: str, unknown: str, limits: Limits, constants: Constants) -> None:
        arithmetic = LinearArithmetic(limits, variable, unknown, self.coefficient)
        super().__init__({variable: VARIABLE}, variable, arithmetic, constants)
        self.unknown = unknown

    def coefficient(self, expression: Any) -> Any:
        """A rational function of x and pi, or of x and e, with that number as a parameter."""
        import sympy

        powers = {e for e in expression.atoms(sympy.exp) if e.args[0].is_Integer}
        names = {sympy.pi: sympy.Symbol(PI), sympy.E: sympy.Symbol(EULER)}
        plain = expression.xreplace({e: names[sympy.E] ** e.args[0] for e in powers} | names)
        value = walked(plain, self)
        if not is_rational(value):
            shown = expression.xreplace({sympy.E: names[sympy.E]})  # E is the energy in texts
            if expression.free_symbols:
                said = f"a coefficient that isn't a rational function of {self.variable}: {shown}"
                raise NotRational(said, hint="coefficients are rational in x, or in exp(k*x), sin(k*x), ...")
            raise NotRational(f"{shown} isn't an algebraic number", hint=TRANSCENDENTAL_HINT)
        if {PI, EULER} <= {*self.constants.parameters}:
            raise NotRational("pi and e in coefficients: it isn't known whether they are algebraically independent")
        return value

    def equation_of(self, value: Any, text: str | None) -> Equation:
        """The equation that says that a linear form is zero; `text` is what it was read from."""
        parts = {**value.parts} if isinstance(value, LinearForm) else {REST: value}
        rest, y = parts.pop(REST, Term(0, 0)), self.unknown
        coefficients = {k: self.arithmetic.rational(c) for k, c in parts.items()}
        order = max((k for k, c in coefficients.items() if c), default=0)
        if order != 2:
            what = f"is of order {order}" if order else f"contains no derivative of {y}"
            said, hint = (
                f"an equation of second order is expected, and this one {what}",
                f"for example {y}'' = (x^2 + 3) {y}",
            )
            place = {} if text is None else {"text": text, "position": 0, "length": len(text)}
            raise NotLinear(said, hint=hint, **place)  # type: ignore[arg-type]
        h = None
        if not is_rational(rest):
            terms = [(term, walked(term, self)) for term in rest.as_ordered_terms()]
            h = -sum(term for term, value in terms if not is_rational(value)) or None
            rest = self.arithmetic.sum([Term(0, 0), *(value for _, value in terms if is_rational(value))])
        coefficients[REST], zero = self.arithmetic.rational(rest), self.arithmetic.rational(Term(0, 0))
        r, c, b, a = (over(coefficients.get(k, zero), self.constants.field) for k in (REST, 0, 1, 2))
        return Equation(a, b, c, -r, h, self.variable, y)

    def other_leaf(self, node: Any) -> Any:
        if node.is_Derivative:
            value = walked(node.expr, self)
            for symbol, count in node.variable_count:
                if symbol.name != self.variable or not getattr(count, "is_Integer", False):
                    raise NotLinear(f"{node} isn't a derivative with respect to {self.variable}")
                for _ in range(int(count)):
                    value = self.arithmetic.derivative(value)
            return value
        from sympy import Symbol

        plain = node.xreplace({symbol: Symbol(symbol.name) for symbol in node.free_symbols})
        functions = {str(function) for function in functions_in(plain)}
        if functions and str(plain) == f"{self.unknown}({self.variable})":
            return self._derivative_of_unknown("")
        if functions:
            raise NotLinear(f"{self.unknown}({self.variable}) within {plain}: the equation isn't linear")
        return plain

    def name(self, name: str) -> Any:
        if name == self.unknown:
            return self._derivative_of_unknown("")
        if name != self.variable and name in ("e", "pi", "π"):
            import sympy

            return sympy.E if name == "e" else sympy.pi
        if name == UNKNOWN and self.unknown:  # the unknown function has another name
            return self.constants.parameter(name)
        return super().name(name)

    def derivative(self, text: str) -> Any:
        name = text.rstrip(PRIMES)
        if name != self.unknown:
            hint = f"there is one unknown function, here {self.unknown}; write products with *: x*y''"
            raise NotLinear(f"{text} is a derivative of something else than {self.unknown}", hint=hint)
        return self._derivative_of_unknown(text[len(name) :])

    def equation(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm):  # f = a y'' + b y' + c y
            left, right = right, left
        return self.arithmetic.sum([left, self.arithmetic.negate(right)])

    def follows_without_sign(self, name: str) -> bool:
        """A coefficient may stand before the unknown function without a sign."""
        return name.rstrip(PRIMES) == self.unknown or name in DERIVATIVES

    def power(self, base: Any, exponent: Any, place: Place) -> Any:
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            pass
        try:
            return self._rational_power(base, exponent, place)
        except NotRational:
            pass
        if ENERGY in self.constants.parameters and self.arithmetic.closed(base) == self.constants.parameter(ENERGY):
            hint = f"write exp(...) or e^x for the exponential function; {ENERGY} is the energy"
            raise NotLinear(f"a power of {ENERGY}, which is a parameter", hint=hint)
        return self.arithmetic.symbolic_power(base, exponent)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        bare = head.rstrip(PRIMES)
        if bare == self.unknown:
            if len(arguments) != 1 or not self._is_variable(arguments[0]):
                raise NotLinear(f"{self.unknown} is a function of {self.variable} alone")
            return self._derivative_of_unknown(head[len(bare) :])
        if head in DERIVATIVES:
            return self._differentiated(arguments)
        if head in self.names:
            hint = f"for a product write {head}*({site.inside()})"
            raise ParseError(f"{head} is followed by a parenthesis like a function", hint=hint)
        try:
            return super().call(head, arguments, site)
        except NotRational:
            if head not in FUNCTION_NAMES or len(arguments) != 1 or isinstance(arguments[0], tuple):
                raise
            return self.arithmetic.applied(head, arguments[0])

    def _derivative_of_unknown(self, primes: str) -> LinearForm:
        order = sum(2 if mark == "″" else 1 for mark in primes)
        return LinearForm({order: Term(1, 0)})

    def _is_variable(self, value: Any) -> bool:
        return is_rational(value) and bool(self.arithmetic.closed(value) == self.arithmetic.closed(VARIABLE))

    def _differentiated(self, arguments: list[Any]) -> Any:
        """diff(y, x), diff(y, x, 2), diff(y, (x, 2)), diff(y, x, x), diff(y): the order is the number of differentiations."""
        function, *rest = arguments
        order, previous = 0, False  # was the argument before this one the variable?
        for argument in rest:
            if isinstance(argument, tuple) and self._is_variable(argument[0]):
                order, previous = order + self._order(argument[1]), False
            elif self._is_variable(argument):
                order, previous = order + 1, True
            elif previous and not isinstance(argument, tuple):
                order, previous = order + self._order(argument) - 1, False
            else:
                raise NotLinear(f"a derivative with respect to something else than {self.variable}")
        if isinstance(function, tuple) or order > _LARGEST_ORDER:
            raise NotLinear("this isn't a derivative that can be read")
        for _ in range(order if rest else 1):
            function = self.arithmetic.derivative(function)
        return function

    def _order(self, value: Any) -> int:
        number = self.arithmetic.number(value) if is_rational(value) else None
        if number is None or number.denominator != 1 or number < 0:
            raise NotLinear("the order of a derivative is a number 0, 1, 2, ...", hint="for example diff(y, x, 2)")
        return number.numerator


def names_in_equation(tokens: Tokens, variable: str | None, unknown: str | None = None) -> tuple[str, str]:
    """The names of the variable and of the unknown function, as far as they aren't given."""
    y = unknown or _unknown_of(tokens)
    return variable or _variable_of(tokens, y), y


def _unknown_of(tokens: Tokens) -> str:
    """The name that has primes, or that is differentiated; else y."""
    for kind, piece in zip(tokens.kinds, tokens.pieces, strict=True):
        bare = piece.rstrip(PRIMES)
        if kind in ("PRIMED", "HEAD") and bare != piece:
            if bare[-1] == UNKNOWN and bare[:-1] in _USUAL_VARIABLES:  # xy'' isn't x*y''
                k = tokens.pieces.index(piece)
                raise tokens.error(
                    ParseError, f"{bare} is one name", k, k + 1, hint=f"write {bare[:-1]}*{piece[len(bare) - 1 :]}"
                )
            return bare
    for k, kind in enumerate(tokens.kinds[:-3]):
        if kind == "HEAD" and tokens.pieces[k] in DERIVATIVES:
            following, after, inner = tokens.kinds[k + 2], tokens.kinds[k + 3], tokens.pieces[k + 2]
            if following == "HEAD" and inner not in DERIVATIVES | FUNCTION_NAMES.keys():
                return inner
            if following == "NAME" and after in ("COMMA", "RPAR"):
                return inner
    return UNKNOWN


def _variable_of(tokens: Tokens, unknown: str) -> str:
    """The argument of the unknown function, or what is differentiated by; else the only name, or x."""
    kinds = tokens.kinds
    for k in range(len(kinds) - 3):
        is_unknown = tokens.pieces[k].rstrip(PRIMES) == unknown
        if is_unknown and kinds[k : k + 4] == ["HEAD", "LPAR", "NAME", "RPAR"]:
            return tokens.pieces[k + 2]
        if is_unknown and kinds[k : k + 3] == ["NAME", "COMMA", "NAME"]:
            return tokens.pieces[k + 2]
    excluded = {*NUMBER_NAMES, ENERGY, unknown, "e"}
    names = [name for name in tokens.names() if name not in excluded]
    if DEFAULT_VARIABLE in names or not names:
        return DEFAULT_VARIABLE if unknown != DEFAULT_VARIABLE else "t"
    usual = [name for name in names if name in _USUAL_VARIABLES]
    if len(usual) != 1 or len(names) > 1:
        question = "is it the variable, or a parameter" if len(names) == 1 else "which is the variable"
        hint = f"write {unknown}''(x) for the derivative, or name the variable: var='x' (--var x)"
        k = tokens.names()[names[-1]]
        raise tokens.error(InputError, f"{', '.join(names[:6])}: {question}?", k, k + 1, hint=hint)
    return usual[0]
