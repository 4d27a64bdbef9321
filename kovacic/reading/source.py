"""From what was given to what it means: one way for texts and for SymPy's expressions, for S alone and for equations.

given -> `Source`, which can be walked -> a reader, which calculates -> `Parsed`
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

from kovacic.equation import DEFAULT_VARIABLE, ENERGY, EULER, PI, UNKNOWN, Parsed
from kovacic.errors import InputError, NotLinear, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.expression import RationalReader, as_function
from kovacic.reading.lexer import DERIVATIVES, PRIMES, Tokens, check_length, is_equation, tokens_of
from kovacic.reading.names import FUNCTION_NAMES, GREEK, NUMBER_NAMES
from kovacic.reading.notation import plain
from kovacic.reading.parser import evaluate, is_letter
from kovacic.reading.pasted import unwrapped

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
USUAL_VARIABLES = frozenset("xtzsruXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}

#: Beside a frequency zeta is the damping ratio: x'' + 2 zeta omega x' + omega^2 x = 0.
_DAMPING_RATIOS = frozenset({"zeta", "ζ"})
_FREQUENCIES = ("omega", "ω")


class Source(NamedTuple):
    """What was given: `walk(reader)` is its value; `unknown` is the function of an equation, empty for S alone."""

    walk: Callable[[Any], Any]
    variable: str
    unknown: str = ""
    text: str | None = None
    notes: tuple[str, ...] = ()


def source_of(
    given: Any, variable: str | None, limits: Limits = DEFAULT_LIMITS, *, unknown: Any = None, equation: bool = False
) -> Source:
    """A text, or a SymPy expression; `unknown` is the name, or y(x), where more than one function occurs.

    It is taken as an equation, an expression as one that is zero, if `equation` says so, or if it looks like one.
    Raises `InputError`, with the position in a text, where it isn't known which name is the variable, and `LimitExceeded`.
    """
    if not isinstance(given, str):
        return _sympy_source(given, variable, unknown, equation)
    check_length(given, limits, what="the text")
    pasted = unwrapped(given)
    if pasted.values:
        said = "values are for dsolve, which takes a command with them"
        raise ParseError(said, text=given, position=0, length=len(given), hint=f"give the equation: {pasted.equation}")
    written = plain(pasted.equation)
    tokens = tokens_of(written.text, limits, what="the text", hint="give S(x), for example x^2 + 3")
    if equation or is_equation(written.text):
        return _equation_in_text(tokens, variable, unknown, usual_variable=written.variable)
    return _S_in_text(tokens, variable)


def _equation_in_text(
    tokens: Tokens, variable: str | None, unknown: str | None, *, usual_variable: str | None
) -> Source:
    """An equation in a text, in whose notation `usual_variable` is the variable where none is named."""
    notes = _guesses(tokens)
    _refuse_words(tokens)
    y = unknown or _unknown_of(tokens)
    _refuse_two_exponents(tokens, y)
    x = variable
    if x is None:
        chosen = _variable_of(tokens, y, usual_variable)
        x = chosen.name
        notes += chosen.notes
    _refuse_glued_names(tokens, x, y, might_be_time=variable is None)
    notes += _imaginary(tokens, x, y)
    return Source(partial(evaluate, _with_factors(tokens, x, y)), x, y, tokens.text, notes)


def _S_in_text(tokens: Tokens, variable: str | None) -> Source:
    notes = _guesses(tokens)
    x = _variable_of_S(tokens, variable)
    _refuse_glued_names(tokens, x, "")
    if x != "e":
        _refuse_two_exponents(tokens, "")
    if variable is None:
        notes += _only_name(tokens, x)
    return Source(partial(evaluate, _with_factors(tokens, x, "")), x, notes=notes)


def _sympy_source(given: Any, variable: str | None, unknown: Any, equation: bool) -> Source:
    from kovacic.reading.symbolic import is_sympy_equation

    if equation or is_sympy_equation(given):
        return _sympy_equation(given, variable, unknown)
    return _sympy_S(given, variable)


def _sympy_S(given: Any, variable: str | None) -> Source:
    import sympy

    from kovacic.reading.symbolic import names_of, walked

    expression = given.as_expr() if isinstance(given, sympy.Poly) else given
    if not isinstance(expression, sympy.Expr):
        hint = "give S alone, from y'' = S(x) y"
        raise InputError(f"{type(expression).__name__!r} isn't a SymPy expression", hint=hint)
    names = names_of(expression)
    return Source(partial(walked, expression), variable or chosen_variable(names))


def _sympy_equation(given: Any, variable: str | None, unknown: Any) -> Source:
    """An `Eq`, or an expression that is zero; `unknown` is y(x), or None where it is the only function."""
    import sympy

    from kovacic.reading.symbolic import function_of, names_of, walked

    expression = _difference_of_sides(given)
    function = unknown
    if function is None:
        function = function_of(expression)
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


def _difference_of_sides(given: Any) -> Any:
    """What is zero: of an `Eq` the left side minus the right one, and any other expression itself."""
    if not getattr(given, "is_Equality", False):
        return given
    if given.rhs == 0:
        return given.lhs
    return given.lhs - given.rhs


def read_source(source: Source, limits: Limits) -> Parsed:
    """What it means: a rational function, or an equation.

    Raises `NotRational` and `NotLinear` where it is neither, `ParseError` for what is no expression, with the position in a
    text, and `LimitExceeded` before anything would become larger than the limits allow.
    """
    x = source.variable
    y = source.unknown
    text = source.text

    def read(constants: Constants) -> Parsed:
        if not y:
            reader = RationalReader({x: VARIABLE}, x, Arithmetic(limits), constants)
            S = constants.embedded(reader.arithmetic.rational(source.walk(reader)))
            return Parsed(S, x, (*source.notes, *reader.notices(), *constants.notices()))
        from kovacic.reading.differential import EquationReader

        reader = EquationReader(x, y, limits, constants)
        equation = reader.equation_of(source.walk(reader), text)
        return Parsed(equation.S, x, (*source.notes, *reader.notices(), *constants.notices()), equation)

    return read_with_constants(read, limits)


def chosen_variable(names: list[str]) -> str:
    """The only name, or x.  Raises `InputError` where neither is among several names."""
    if len(names) == 1:
        return names[0]
    if not names or DEFAULT_VARIABLE in names:
        return DEFAULT_VARIABLE
    usual = [name for name in names if name in USUAL_VARIABLES and name.islower()]
    likely = (usual or names)[0]
    raise InputError(
        f"which of {', '.join(names[:6])} is the variable?",
        hint=f"name it: var={likely!r}; the others are parameters",
        shell=f"name it: --var {likely}; the others are parameters",
    )


def _variable_of_S(tokens: Tokens, variable: str | None) -> str:
    """The name of the variable of S, as far as it isn't given.  Refuses decimals that can be read as products with it."""
    found = variable or _chosen_variable_of_S(tokens)
    if found in ("e", "E"):
        _refuse_exponents_of_decimals(tokens, found)
    return found


def _chosen_variable_of_S(tokens: Tokens) -> str:
    """The only name that isn't one of a number, the energy or a function, or x.  Asks where it can't be told."""
    found = tokens.names()
    no_variables = {*NUMBER_NAMES, ENERGY, UNKNOWN}
    names = [name for name in found if name not in no_variables and as_function(name) is None]
    try:
        return chosen_variable(names)
    except InputError as error:
        k = found[names[1]]
        raise tokens.error(InputError, error.message, k, k + 1, hint=error.hint, shell=error.shell) from None


def _refuse_exponents_of_decimals(tokens: Tokens, variable: str) -> None:
    """Raises `ParseError` for 2e-3 with the variable e: it is 0.002, or 2*e - 3."""
    for k, text in enumerate(tokens.pieces):
        if tokens.kinds[k] != "NUMBER" or variable not in text:
            continue
        mantissa, _, rest = text.partition(variable)
        other = f"{mantissa}*{variable}{rest}"
        if rest[0] in "+-":
            other = f"{mantissa}*{variable} {rest[0]} {rest[1:]}"
        message = f"{text} can be read as a decimal or as {other}, the variable being {variable}"
        hint = "write decimals without an exponent, and products with *"
        raise tokens.error(ParseError, message, k, k + 1, hint=hint)


#: Letters that unknown functions have: mx'' is a product in which the sign is missing, no function mx.
_USUAL_UNKNOWNS = frozenset("xyzuvwq")
#: Names that are no unknown function where a parenthesis follows.
_FUNCTIONS = DERIVATIVES | FUNCTION_NAMES.keys()
#: So many letters before or behind the variable may be factors without a sign; a longer name is a word.
_FACTORS = 2


def _refuse_glued_names(tokens: Tokens, variable: str, unknown: str, *, might_be_time: bool = False) -> None:
    """Raises `ParseError` where a name looks like a product: ky, kx; where the variable `might_be_time`: at."""
    names = tokens.names()
    has_no_variable = variable not in names and "t" not in names
    for name, k in names.items():
        if name in (variable, unknown) or _is_known(name):
            continue
        if unknown:
            _refuse_operator(tokens, name, k, variable, unknown)
        meant = _as_product(name, variable, unknown)
        if meant is None and might_be_time and has_no_variable:
            meant = _as_product_with_time(name, unknown)
        if meant is not None:
            raise _one_name(tokens, k, meant)


def _one_name(tokens: Tokens, k: int, meant: str) -> InputError:
    """That token k is one name where a product may have been meant."""
    if k > 0 and tokens.are(k - 1, "CIRCUMFLEX"):
        meant = f"({meant})"
    return tokens.error(ParseError, f"{tokens.pieces[k]} is one name", k, k + 1, hint=f"did you mean {meant}?")


def _is_known(name: str) -> bool:
    """Is it the name of a number, a function or a Greek letter?"""
    return name in NUMBER_NAMES or name in GREEK or as_function(name) is not None


def _as_product_with_time(name: str, unknown: str) -> str | None:
    """a*t for at."""
    if len(name) == _FACTORS and name[-1] == "t":
        return _as_product(name, "t", unknown)
    return None


def _refuse_operator(tokens: Tokens, name: str, k: int, variable: str, unknown: str) -> None:
    """Raises `ParseError` where a name is an operator and what it is applied to: Dy, or the dx that is left of d/dx."""
    if name == f"D{unknown}":
        hint = f"write {unknown}' for D{unknown}, and {unknown}'' for D^2 {unknown}"
        raise tokens.error(ParseError, f"{name} is one name, and D isn't read as an operator", k, k + 1, hint=hint)
    if name == f"d{variable}":
        hint = f"write {unknown}'' or d^2{unknown}/d{variable}^2, and operators applied: {unknown}'' - x*{unknown}"
        raise tokens.error(ParseError, f"{name} belongs to no derivative of {unknown}", k, k + 1, hint=hint)


#: Words around an equation; all other words are names.
_WORDS = frozenset(
    [
        "and",
        "equation",
        "find",
        "Find",
        "for",
        "given",
        "if",
        "let",
        "Let",
        "solve",
        "Solve",
        "subject",
        "where",
        "with",
    ]
)


def _refuse_words(tokens: Tokens) -> None:
    """Raises `ParseError` for words beside an equation, which would be parameters."""
    for name, k in tokens.names().items():
        if name in _WORDS:
            hint = "leave it out; values follow the equation after commas: y'' + y = 0, y(0) = 1"
            raise tokens.error(ParseError, f"{name} is a word and no part of an equation", k, k + 1, hint=hint)


def _refuse_two_exponents(tokens: Tokens, unknown: str) -> None:
    """Raises `ParseError` for e^2x, which is e^(2x) or e^2 x."""
    for k, kind in enumerate(tokens.kinds):
        if kind != "CIRCUMFLEX" or tokens.pieces[k - 1] != "e":
            continue
        number = k + 1
        if tokens.are(number, "MINUS"):
            number += 1
        if not _is_glued_product(tokens, number):
            continue
        factor = tokens.pieces[number + 1]
        if factor != unknown:
            power = tokens.piece(k + 1, number + 1)
            whole = tokens.piece(k - 1, number + 2)
            hint = f"write e^({power}*{factor}) or e^({power})*{factor}"
            raise tokens.error(ParseError, f"{whole} can be read in two ways", k - 1, number + 2, hint=hint)


def _is_glued_product(tokens: Tokens, k: int) -> bool:
    """Is token k a number that a name follows without a space: 2x?"""
    return tokens.are(k, "NUMBER", "NAME") and tokens.ends[k] == tokens.starts[k + 1]


def _with_factors(tokens: Tokens, variable: str, unknown: str) -> Tokens:
    """With names in the place of heads that are no functions: n(n+1) is a product where n occurs without parentheses, too."""
    alone = {*tokens.names(), variable} - {unknown}
    kinds = list(tokens.kinds)
    for k, kind in enumerate(tokens.kinds[:-3]):
        if kind != "HEAD":
            continue
        name = tokens.pieces[k]
        might_be_factor = name in alone and is_letter(name) and name not in _FUNCTIONS
        if might_be_factor and not _is_applied(tokens, k):
            kinds[k] = "NAME"
    if kinds == tokens.kinds:
        return tokens
    return replace(tokens, kinds=kinds)


def _is_applied(tokens: Tokens, k: int) -> bool:
    """Has the head at token k one name or number in its parentheses, as a function has?"""
    return tokens.are(k + 2, "NAME", "RPAR") or tokens.are(k + 2, "NUMBER", "RPAR")


def _imaginary(tokens: Tokens, variable: str, unknown: str) -> tuple[str, ...]:
    """That i is a letter as others, where it occurs."""
    if "i" in (variable, unknown) or "i" not in tokens.names():
        return ()
    return ("i is a parameter; the imaginary unit is I",)


def _as_product(name: str, variable: str, unknown: str) -> str | None:
    """k*y for ky, and x*y for xy: single letters, the unknown function or the variable at one end."""
    is_short_word = name.isascii() and name.isalpha() and 2 <= len(name) <= _FACTORS + 1
    if not is_short_word:
        return None
    ends = (name[0], name[-1])
    if variable in ends or unknown in ends:
        return "*".join(name)
    return None


def _unknown_of(tokens: Tokens) -> str:
    """The name that has primes, or that is differentiated; else y."""
    return _primed(tokens) or _differentiated(tokens) or UNKNOWN


def _primed(tokens: Tokens) -> str | None:
    """The first name that has primes.  Raises `ParseError` for mx'', which isn't m*x''."""
    for k, piece in enumerate(tokens.pieces):
        bare = piece.rstrip(PRIMES)
        if tokens.kinds[k] not in ("PRIMED", "HEAD") or bare == piece:
            continue
        if len(bare) == _FACTORS and bare[-1] in _USUAL_UNKNOWNS and bare.isalpha():
            hint = f"write {bare[:-1]}*{piece[len(bare) - 1 :]}"
            raise tokens.error(ParseError, f"{bare} is one name", k, k + 1, hint=hint)
        return bare
    return None


def _differentiated(tokens: Tokens) -> str | None:
    """y in the first one of diff(y, x), diff(y(x), x) and diff(y)."""
    for k, kind in enumerate(tokens.kinds[:-3]):
        if kind != "HEAD" or tokens.pieces[k] not in DERIVATIVES:
            continue
        inner = tokens.pieces[k + 2]
        is_called = tokens.are(k + 2, "HEAD") and inner not in _FUNCTIONS
        is_name = tokens.are(k + 2, "NAME", "COMMA") or tokens.are(k + 2, "NAME", "RPAR")
        if is_called or is_name:
            return inner
    return None


class _ChosenVariable(NamedTuple):
    """The name of the variable, and a note where that is a guess."""

    name: str
    notes: tuple[str, ...] = ()


def _variable_of(tokens: Tokens, unknown: str, preferred: str | None) -> _ChosenVariable:
    """The variable of an equation.

    It is the argument of the unknown function, or what is differentiated by; else x, where x occurs; else the only name
    that usually is one (x, t, z, s, r, u, theta, ...); else x, or what the notation stands for (t beside dots, in D2y), and all
    other names are parameters.
    """
    named = _argument_of(tokens, unknown)
    if named is not None:
        return _ChosenVariable(named)
    excluded = {*NUMBER_NAMES, ENERGY, unknown, "e"}
    names = [name for name in tokens.names() if name not in excluded]
    default = preferred or DEFAULT_VARIABLE
    if default == unknown:
        default = "t"
    for likely in (DEFAULT_VARIABLE, default):
        if likely in names:
            return _ChosenVariable(likely)
    if not names:
        return _ChosenVariable(default)
    usual = _usual_variables(names)
    if len(usual) > 1:
        raise _several_variables(tokens, unknown, usual)
    if usual:
        return _ChosenVariable(usual[0])
    which = "a parameter" if len(names) == 1 else "parameters"
    return _ChosenVariable(default, (f"{default} is the variable, {', '.join(names[:6])} {which}",))


def _argument_of(tokens: Tokens, unknown: str) -> str | None:
    """The name in y''(x), or in D(y, x); None where the unknown function stands alone."""
    for k, piece in enumerate(tokens.pieces):
        if piece.rstrip(PRIMES) != unknown:
            continue
        is_applied = tokens.are(k, "HEAD", "LPAR", "NAME", "RPAR")
        is_differentiated = tokens.are(k, "NAME", "COMMA", "NAME")
        if is_applied or is_differentiated:
            return tokens.pieces[k + 2]
    return None


def _usual_variables(names: list[str]) -> list[str]:
    """Those that usually are a variable; beside t, T is a parameter, and beside a frequency the letters of damping ratios."""
    usual = [name for name in names if name in USUAL_VARIABLES]
    usual = [name for name in usual if name.lower() == name or name.lower() not in usual]
    is_damped = any(name.startswith(_FREQUENCIES) for name in names)
    if is_damped:
        return [name for name in usual if name not in _DAMPING_RATIOS]
    return usual


def _several_variables(tokens: Tokens, unknown: str, usual: list[str]) -> Exception:
    """The question back, where several names could be the variable."""
    hint = f"write {unknown}''(x) for the derivative, or name the variable:"
    k = tokens.names()[usual[-1]]
    return tokens.error(
        InputError,
        f"{', '.join(usual[:6])}: which is the variable?",
        k,
        k + 1,
        hint=f"{hint} var={usual[0]!r}",
        shell=f"{hint} --var {usual[0]}",
    )


def _only_name(tokens: Tokens, variable: str) -> tuple[str, ...]:
    """Where S has one name that an equation would take for a parameter, it is the variable: that is said."""
    if variable in USUAL_VARIABLES or variable not in tokens.names():
        return ()
    return (f"{variable} is taken for the variable; name another one where it is a parameter: var='x' (--var x)",)


def _guesses(tokens: Tokens) -> tuple[str, ...]:
    """What may have been meant in another way: x^1/2 is x/2."""
    for k, kind in enumerate(tokens.kinds):
        if kind != "CIRCUMFLEX":
            continue
        if tokens.are(k + 1, "NUMBER", "SLASH", "NUMBER") and tokens.pieces[k + 1] == "1":
            below = tokens.pieces[k + 3]
            return (f"^1/{below} was read as (...)^1 divided by {below}; a root is written ^(1/{below})",)
    return ()
