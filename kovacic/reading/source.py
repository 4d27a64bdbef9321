"""From the input to its meaning: one way for texts and for SymPy's expressions, for S alone and for equations.

given -> `Source`, which can be walked -> a reader, which calculates -> `Parsed`
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from functools import partial
from typing import Any

from kovacic.equation import PI, UNKNOWN, Parsed, lowered, over
from kovacic.errors import InputError, NotLinear, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits, demand
from kovacic.reading.arithmetic import ONE, VARIABLE, Arithmetic
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.expression import RationalReader
from kovacic.reading.lexer import error_at
from kovacic.reading.naming import Source, Vocabulary, chosen_variable
from kovacic.reading.pieces import Paste, check_points, is_equation


def source_of(
    given: Any,
    variable: str | None,
    limits: Limits = DEFAULT_LIMITS,
    *,
    unknown: Any = None,
    equation: bool = False,
    names: Collection[str] = (),
) -> Source:
    """A text, or a SymPy expression; `unknown` is the name, or y(x), where more than one function occurs.

    It is taken as an equation, an expression as one that is zero, if `equation` says so, or if it looks like one.  `names`
    are declared: whatever they look like, they are parameters.
    Raises `InputError`, with the position in a text, where it isn't known which name is the variable, and `LimitExceeded`.
    """
    if not isinstance(given, str | Paste):
        return _sympy_source(given, variable, unknown, equation)._replace(limits=limits)
    if isinstance(given, str):
        demand(limits, "text_length", len(given), "the text has {} characters")
        given = Paste(given)
        if given.value_scans:
            scan = given.equation_scans[0]
            hint = f"give the equation: {given.text[scan[0].start : scan[-1].end]}"
            raise error_at(given.text, "initial values are accepted by `dsolve` only", given.value_scans[0], hint)
    scans = given.equation_scans
    if not scans:
        hint = "give S(x), for example x^2 + 3"
        raise ParseError("there is no expression: the text is empty", text=given.text, position=0, hint=hint)
    if len(scans) > 1:
        kind, other, hint = "expression", scans[1], "decimals are written with a point; one expression is one S"
        if given.is_equation:
            kind, other = "equation", next((scan for scan in scans if not is_equation(scan)), scans[1])
            hint = "leave it out, or substitute the values of letters in the equation; initial values follow it as y(0) = 1"
        raise error_at(given.text, f"the text has more than the {kind}", other, hint)
    vocabulary = Vocabulary(variable or given.variable, unknown, frozenset(names))
    source = vocabulary.of(given.equations[0], is_equation=equation or given.is_equation, notes=given.notes)
    check_points(given.text, given.points, source.variable)
    return source._replace(limits=limits)


def _sympy_source(given: Any, variable: str | None, unknown: Any, equation: bool) -> Source:
    """S, an `Eq`, or an expression that is zero; `unknown` is y(x), or None if it is the only function."""
    import sympy

    from kovacic.reading.symbolic import function_of, is_sympy_equation, names_of, walked

    is_equation = equation or is_sympy_equation(given)
    expression = given.as_expr() if isinstance(given, sympy.Poly) else given
    if is_equation and getattr(given, "is_Equality", False):
        expression = given.lhs - given.rhs
    if not isinstance(expression, sympy.Expr):
        hint = "give S alone, from y'' = S(x) y"
        raise InputError(f"{type(expression).__name__!r} isn't a SymPy expression", hint=hint)
    algebraic = {number: number.expand(func=True) for number in (sympy.GoldenRatio, sympy.TribonacciConstant)}
    expression = expression.xreplace(algebraic)
    names = names_of(expression)
    if PI in names:
        raise InputError(f"a symbol with the name {PI}, which is a number", hint="rename the symbol")
    walk, symbols = partial(walked, expression), frozenset(names)
    if not is_equation:
        return Source(walk, variable or chosen_variable(names), declared=symbols)
    function = function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    x = function.args[0].name
    if variable is not None and x != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    return Source(walk, x, str(function.func), declared=symbols)


def read_with_numbers(source: Source) -> Parsed:
    """As `read_source`; S alone as y'' = S y, where pi or e occur in it."""
    try:
        return read_source(source)
    except NotRational:
        from kovacic.reading.linear import LinearForm

        def walk(reader: Any) -> Any:
            product = reader.arithmetic.multiply(LinearForm({0: reader.arithmetic.negate(ONE)}), source.walk(reader))
            return reader.arithmetic.sum([LinearForm({2: ONE}), product])

        if not source.unknown:
            with suppress(InputError):
                return read_source(source._replace(walk=walk, unknown=UNKNOWN))
        raise


def read_source(source: Source) -> Parsed:
    """The meaning of a source: a rational function, or an equation; without the notes of the source.

    Raises `NotRational`, `NotLinear` and `ParseError`, with the position in a text, and `LimitExceeded`.
    """
    x = source.variable

    def read(constants: Constants) -> Parsed:
        if not source.unknown:
            reader = RationalReader({x: VARIABLE}, x, Arithmetic(source.limits), constants)
            reader.declared = source.declared
            S = lowered(over(reader.arithmetic.rational(source.walk(reader)), constants.field))
            return Parsed(S, x, (*reader.notices(), *constants.notices()))
        from kovacic.reading.differential import EquationReader

        reader = EquationReader(source, constants)
        equation = reader.equation_of(source.walk(reader), source.text)
        notes = (*reader.notices(), *constants.notices(reader.letters))
        return Parsed(equation.S, x, notes, equation, tuple(reader.letters.items()))

    return read_with_constants(read, Constants(source.limits, parameters=source.order))


def parts_of(source: Source, order: int = 2) -> tuple[Sequence[Any], list[str]]:
    """a, b, c, r of a y'' + b y' + c y + r = 0 (or b, c, r for the order 1), expressions of any functions; and the notices."""
    import sympy

    from kovacic.reading.differential import EquationReader
    from kovacic.reading.linear import REST
    from kovacic.reading.symbolic import SYMBOLS

    reader = EquationReader(source, SYMBOLS)
    reader.arithmetic.coefficient = lambda expression: expression  # any one
    value = source.walk(reader)
    parts = reader.parts(value)
    if not source.unknown:  # S alone
        parts = {2: ONE, 0: reader.arithmetic.negate(value)}
    found = {k: reader.arithmetic.expression(c) for k, c in parts.items()}
    reader.check_order(max(found, default=0), source.text, order)
    return [found.get(k, sympy.Integer(0)) for k in (*range(order, -1, -1), REST)], reader.notices()


def source_of_parts(parts: Sequence[Any], source: Source) -> Source:
    """The equation with these coefficients and the unknown function of `source`; S alone if that has S alone."""
    import sympy

    a, b, c, rest = parts
    if not source.unknown:
        return source_of(-c, source.variable, source.limits)
    x = sympy.Symbol(source.variable)
    y = sympy.Function(source.unknown)(x)
    equation = a * y.diff(x, 2) + b * y.diff(x) + c * y + rest
    return source_of(equation, source.variable, source.limits, unknown=y, equation=True)
