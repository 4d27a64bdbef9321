"""From what was given to what it means: one way for texts and for SymPy's expressions, for S alone and for equations.

given -> `Source`, which can be walked -> a reader, which calculates -> `Parsed`
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from kovacic.equation import DEFAULT_VARIABLE, ENERGY, EULER, PI, UNKNOWN, Parsed
from kovacic.errors import InputError, NotLinear, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.expression import RationalReader, as_function
from kovacic.reading.lexer import DERIVATIVES, PRIMES, Tokens, is_equation, tokens_of
from kovacic.reading.names import FUNCTION_NAMES, NUMBER_NAMES
from kovacic.reading.parser import evaluate

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
_USUAL_VARIABLES = frozenset("xtzsruXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}


class Source(NamedTuple):
    """What was given: `walk(reader)` is its value; `unknown` is the function of an equation, empty for S alone."""

    walk: Callable[[Any], Any]
    variable: str
    unknown: str = ""
    text: str | None = None


def source_of(
    given: Any, variable: str | None, limits: Limits = DEFAULT_LIMITS, *, unknown: Any = None, equation: bool = False
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
        y = unknown or _unknown_of(tokens)
        return Source(walk, variable or _variable_of(tokens, y), y, given)
    return Source(walk, _variable_of_S(tokens, variable))


def _sympy_source(given: Any, variable: str | None, unknown: Any, equation: bool) -> Source:
    import sympy

    from kovacic.reading.symbolic import function_of, is_sympy_equation, names_of, walked

    if not equation and not is_sympy_equation(given):
        expression = given.as_expr() if isinstance(given, sympy.Poly) else given
        if not isinstance(expression, sympy.Expr):
            hint = "give S alone, from y'' = S(x) y"
            raise InputError(f"{type(expression).__name__!r} isn't a SymPy expression", hint=hint)
        names = names_of(expression)
        return Source(partial(walked, expression), variable or _chosen_variable(names))
    expression = given
    if getattr(given, "is_Equality", False):
        expression = given.lhs - given.rhs if given.rhs != 0 else given.lhs
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
        from kovacic.reading.differential import EquationReader

        reader = EquationReader(x, y, limits, constants)
        equation = reader.equation_of(source.walk(reader), text)
        return Parsed(equation.S, x, (*reader.notices(), *constants.notices()), equation)

    return read_with_constants(read, limits)


def _chosen_variable(names: list[str]) -> str:
    """The only name, or x.  Raises `InputError` where neither is among several names."""
    if len(names) > 1 and DEFAULT_VARIABLE not in names:
        raise InputError(
            f"which of {', '.join(names[:6])} is the variable?",
            hint=f"name it: var={names[0]!r} (--var {names[0]}); the others are parameters",
        )
    return names[0] if len(names) == 1 else DEFAULT_VARIABLE


def _variable_of_S(tokens: Tokens, variable: str | None) -> str:
    """The name of the variable of S, as far as it isn't given.  Refuses decimals that can be read as products with it."""
    if variable is None:
        found = tokens.names()
        names = [name for name in found if name not in {*NUMBER_NAMES, ENERGY, UNKNOWN} and as_function(name) is None]
        try:
            variable = _chosen_variable(names)
        except InputError as error:
            k = found[names[1]]
            raise tokens.error(InputError, error.message, k, k + 1, hint=error.hint) from None
    for k, (kind, text) in enumerate(zip(tokens.kinds, tokens.pieces, strict=True) if variable in ("e", "E") else ()):
        if kind == "NUMBER" and variable in text:  # 2e-3 is 0.002, or 2*e - 3
            mantissa, _, rest = text.partition(variable)
            other = f"{mantissa}*{variable} {rest[0]} {rest[1:]}" if rest[0] in "+-" else f"{mantissa}*{variable}{rest}"
            message = f"{text} can be read as a decimal or as {other}, the variable being {variable}"
            hint = "write decimals without an exponent, and products with *"
            raise tokens.error(ParseError, message, k, k + 1, hint=hint)
    return variable


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
            called = following == "HEAD" and inner not in DERIVATIVES | FUNCTION_NAMES.keys()
            if called or (following == "NAME" and after in ("COMMA", "RPAR")):
                return inner
    return UNKNOWN


def _variable_of(tokens: Tokens, unknown: str) -> str:
    """The argument of the unknown function, or what is differentiated by; else the only name, or x."""
    kinds = tokens.kinds
    applied, differentiated = ["HEAD", "LPAR", "NAME", "RPAR"], ["NAME", "COMMA", "NAME"]
    for k in range(len(kinds) - 3):
        if tokens.pieces[k].rstrip(PRIMES) == unknown and (
            kinds[k : k + 4] == applied or kinds[k : k + 3] == differentiated
        ):
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
