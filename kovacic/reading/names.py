"""Which name of a text is the variable, and which one the unknown function?"""

from __future__ import annotations

from kovacic.errors import InputError, ParseError
from kovacic.reading.given import DEFAULT_VARIABLE, ENERGY, FUNCTION_NAMES, NUMBER_NAMES, UNKNOWN
from kovacic.reading.lexer import DERIVATIVES, PRIMES, Tokens

_FUNCTIONS = frozenset({*FUNCTION_NAMES, "root"})

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
_USUAL_VARIABLES = frozenset("xtzsruXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}


def as_function(name: str) -> str | None:
    """sin(x) for sinx and sin: what a name probably means that looks like a function without parentheses; None for others."""
    if name in _FUNCTIONS:
        return f"{name}(x)"
    return f"{name[:-1]}({name[-1]})" if name[:-1] in _FUNCTIONS and name[-1] in "xtz" else None


def chosen_variable(names: list[str]) -> str:
    """The only name, or x.  Raises `InputError` where neither is among several names."""
    if len(names) > 1 and DEFAULT_VARIABLE not in names:
        raise InputError(
            f"which of {', '.join(names[:6])} is the variable?",
            hint=f"name it: var={names[0]!r} (--var {names[0]}); the others are parameters",
        )
    return names[0] if len(names) == 1 else DEFAULT_VARIABLE


def variable_of_rational(tokens: Tokens, variable: str | None) -> str:
    """The name of the variable of S, as far as it isn't given.  Refuses decimals that can be read as products with it."""
    if variable is None:
        found = tokens.names()
        names = [name for name in found if name not in {*NUMBER_NAMES, ENERGY, UNKNOWN} and as_function(name) is None]
        try:
            variable = chosen_variable(names)
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
