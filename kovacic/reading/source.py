"""From what was given to what it means: one way for texts and for SymPy's expressions, for S alone and for equations.

given -> `Source`, which can be walked -> a reader, which calculates -> `Parsed`
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from kovacic.errors import InputError, NotLinear
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.expression import RationalReader
from kovacic.reading.given import EULER, PI, Parsed
from kovacic.reading.lexer import is_equation, tokens_of
from kovacic.reading.names import chosen_variable, names_in_equation, variable_of_rational
from kovacic.reading.parser import evaluate


class Source(NamedTuple):
    """What was given: `walk(reader)` is its value; `unknown` is the function of an equation, empty for S alone."""

    walk: Callable[[Any], Any]
    variable: str
    unknown: str = ""
    text: str | None = None


def source_of(
    given: Any,
    variable: str | None,
    limits: Limits = DEFAULT_LIMITS,
    *,
    unknown: Any = None,
    equation: bool = False,
) -> Source:
    """A text, or a SymPy expression; `unknown` is the name, or y(x), where more than one function occurs.

    It is taken as an equation, an expression as one that is zero, if `equation` says so, or if it looks like one.
    Raises `InputError`, with the position in a text, where it isn't known which name is the variable, and `LimitExceeded`.
    """
    if not isinstance(given, str):
        return _sympy_source(given, variable, unknown, equation)
    tokens = tokens_of(given, limits, what="the text", hint="give S(x), for example x^2 + 3")
    walk = partial(evaluate, tokens)
    if equation or is_equation(given):
        return Source(walk, *names_in_equation(tokens, variable, unknown), given)
    return Source(walk, variable_of_rational(tokens, variable))


def _sympy_source(given: Any, variable: str | None, unknown: Any, equation: bool) -> Source:
    import sympy

    from kovacic.reading.from_sympy import function_of, is_sympy_equation, names_of, walked

    if not equation and not is_sympy_equation(given):
        expression = given.as_expr() if isinstance(given, sympy.Poly) else given
        if not isinstance(expression, sympy.Expr):
            hint = "give S alone, from y'' = S(x) y"
            raise InputError(f"{type(expression).__name__!r} isn't a SymPy expression", hint=hint)
        names = names_of(expression)
        return Source(partial(walked, expression), variable or chosen_variable(names))
    expression = given.lhs - given.rhs if getattr(given, "is_Equality", False) else given
    function = function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    x = function.args[0].name
    if variable is not None and x != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    names = names_of(expression)
    for letter, number in ((PI, sympy.pi), (EULER, sympy.E)):
        if letter in names and expression.has(number):
            raise InputError(f"{letter} is a symbol and a number in one equation", hint="rename the symbol")
    return Source(partial(walked, expression), x, str(function.func))


def read_source(source: Source, limits: Limits) -> Parsed:
    """What it means: a rational function, or an equation.

    Raises `NotRational` and `NotLinear` where it is neither, `ParseError` for what is no expression, with the position in a
    text, and `LimitExceeded` before anything would become larger than the limits allow.
    """
    _, x, y, text = source

    def read(constants: Constants) -> Parsed:
        if not y:
            reader = RationalReader({x: VARIABLE}, x, Arithmetic(limits), constants)
            S = constants.embedded(reader.arithmetic.rational(source.walk(reader)))
            return Parsed(S, x, (*reader.notices(), *constants.notices()))
        from kovacic.reading.equation import EquationReader

        reader = EquationReader(x, y, limits, constants)
        equation = reader.equation_of(source.walk(reader), text)
        return Parsed(equation.S, x, (*reader.notices(), *constants.notices()), equation)

    return read_with_constants(read, limits)
