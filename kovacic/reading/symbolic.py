"""SymPy's expressions: walked by the readers that texts have (`walked`), and made out of texts (`read_expression`).

An expression is walked as it stands, by an explicit stack.  SymPy simplifies nothing on the way: its `cancel` and `together`
cost more than the whole decision.  The meaning of a text is built by SymPy's own operators; nothing is ever executed.

>>> read_expression("3/2*cos(u) + sin(u)^2/4", names={"u": sympy.Symbol("u")})
sin(u)**2/4 + 3*cos(u)/2
>>> read_expression("sqrt(8) + n*e^2")
n*exp(2) + 2*sqrt(2)
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import partial, reduce
from types import SimpleNamespace
from typing import Any, NamedTuple

import sympy
from sympy.core.function import AppliedUndef

from kovacic.errors import InputError, LimitExceeded, NotLinear, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits, demand
from kovacic.numbers.numerals import as_text
from kovacic.reading.arithmetic import ONE, VARIABLE
from kovacic.reading.dialects import tokenize
from kovacic.reading.expression import RationalReader
from kovacic.reading.lexer import DERIVATIVES, PRIME
from kovacic.reading.linear import SYMBOLIC_LIMITS, LinearArithmetic, differentiations
from kovacic.reading.names import FUNCTION_NAMES, INFINITIES, KNOWN_NUMBERS, NUMBER_NAMES, POWER_CALLS, is_function
from kovacic.reading.naming import Source, Vocabulary, argument_of, differentiated
from kovacic.reading.parser import Site, excerpt, parse
from kovacic.reading.pieces import Paste, check_points

#: Stands in for `Constants` where parameters and algebraic numbers are SymPy expressions.
SYMBOLS: Any = SimpleNamespace(
    parameters=(),
    parameter=sympy.Symbol,
    algebraic=lambda node: node,
    radical=lambda radicand, n, _: sympy.root(sympy.Rational(radicand.field.rational_value(radicand)), n),
)
#: Letters that are functions where they have an argument, and neither a product nor an unknown function is meant.
_SYMBOLS_OF_FUNCTIONS = {"delta": "DiracDelta", "δ": "DiracDelta"}
_NUMBER_VALUES = {name: getattr(sympy, number).expand(func=True) for name, number in KNOWN_NUMBERS.items()}


def walked(expression: Any, reader: RationalReader) -> Any:
    """The value of a SymPy expression; children are on the stack `values` before their parent is combined."""
    values: list[Any] = []
    #: The nodes still to be visited, the next one last; True if the values of its children are on the stack.
    pending: list[tuple[Any, bool]] = [(expression, False)]
    while pending:
        node, is_ready = pending.pop()
        if is_ready:
            first = len(values) - len(node.args)
            arguments = values[first:]
            del values[first:]
            values.append(_combined(node, arguments, reader))
        elif node.is_Add or node.is_Mul or node.is_Pow:
            pending.append((node, True))
            pending.extend((child, False) for child in reversed(node.args))
        else:
            values.append(_leaf(node, reader))
    return values[0]


def _combined(node: Any, arguments: list[Any], reader: RationalReader) -> Any:
    try:
        if node.is_Pow:
            base, exponent = arguments
            return reader.power(base, exponent, SimpleNamespace(text=partial(excerpt, node, 60)))
        if node.is_Add:
            return reader.arithmetic.sum(arguments)
        return reduce(reader.arithmetic.multiply, arguments)
    except ZeroDivisionError:
        raise NotRational(f"division by zero in {excerpt(node, 60)}") from None
    except LimitExceeded as error:
        raise LimitExceeded(f"{excerpt(node, 60)} would have {error}", limit=error.limit) from None


def _leaf(node: Any, reader: RationalReader) -> Any:
    if node.is_Symbol:
        return VARIABLE if node.name == reader.variable else reader.constants.parameter(node.name)
    if node.is_Rational:
        return reader.arithmetic.constant(node.p, node.q)
    if node.is_Float and node.is_finite:  # a binary fraction
        exact = sympy.Rational(node)
        reader.decimals.append(f"the float {excerpt(node, 60)} was taken exactly, as {excerpt(exact, 60)}")
        return reader.arithmetic.constant(exact.p, exact.q)
    if node.is_number and node.is_algebraic:
        value = reader.constants.algebraic(node)
        if value is not None:
            return value
    return reader.other_leaf(node)


def names_of(expression: Any) -> list[str]:
    """The names of the symbols, in alphabetical order.  Refuses what would be lost in them."""
    names = sorted(symbol.name for symbol in expression.free_symbols)
    if len(set(names)) < len(names):
        said = f"different symbols have the same name: {', '.join(names)}"
        raise InputError(said, hint="use one symbol x throughout")
    if expression.is_commutative is False:
        raise InputError("a product of symbols that don't commute", hint="use commutative symbols")
    return names


def functions_in(value: Any) -> set[Any]:
    """The applied undefined functions, such as y(x)."""
    return value.atoms(AppliedUndef) if hasattr(value, "atoms") else set()


def is_sympy_equation(value: Any) -> bool:
    """True for an `Eq` with an undefined function, and for an expression with a derivative of one."""
    return bool(functions_in(value)) and bool(getattr(value, "is_Equality", False) or value.has(sympy.Derivative))


def equation_text(given: Any) -> str:
    """A SymPy expression or equation as a text that means the same.

    >>> x, y = sympy.Symbol("x"), sympy.Function("y")
    >>> equation_text(sympy.Eq(y(x).diff(x, 2), sympy.exp(x) * y(x)))
    "y'' = y*exp(x)"
    """
    if not is_sympy_equation(given):
        return as_text(given)
    function = function_of(given)
    (x,) = function.args
    sides = (given.lhs, given.rhs) if given.is_Equality else (given, sympy.S.Zero)
    names = {function.diff(x, k): sympy.Symbol(function.func.__name__ + "'" * k) for k in range(3)}
    return " = ".join(as_text(side.doit(integrals=False).xreplace(names)) for side in sides)


def function_of(expression: Any) -> Any:
    """The unknown function, the only one in the expression or the one that is differentiated."""
    functions = functions_in(expression)
    candidates = functions
    if len(functions) > 1:
        candidates = {d.expr for d in expression.atoms(sympy.Derivative)} & functions
    if len(candidates) != 1:
        found = ", ".join(sorted(map(str, functions))) or "none"
        raise NotLinear(f"one unknown function is expected, and there are: {found}", hint="write y(x) for it")
    return candidates.pop()


#: By the name of an unknown function: `at(point, k)`, the symbol of its k-th derivative at a point.
Unknowns = Mapping[str, Callable[[Any, int], Any]]


def read_expression(
    text: str,
    *,
    names: Mapping[str, Any] | None = None,
    what: str = "the expression",
    limits: Limits = SYMBOLIC_LIMITS,
    values: Unknowns | None = None,
) -> Any:
    """The SymPy expression that a text denotes in `names`, pi, e, I and the elementary functions; decimals are exact.

    Without `names`, every other name is a symbol; with `values` calls of the unknown
    function are its values.  Raises `InputError`, with the position, for anything else (`what` says
    in the message what the text stands for), and `LimitExceeded` for a text, a number or a power that is too large.
    """
    reader = SymbolicReader(names, what, limits, values or {})
    if values:
        reader.names = {**reader.names, **dict.fromkeys(INFINITIES, sympy.oo)}
    return reader.read(text)


def written_expression(text: str) -> Any:
    """The expression that `as_text` wrote, in which e is a letter: Euler's number is exp(1) there."""
    reader = SymbolicReader(None, "a function", SYMBOLIC_LIMITS, {})
    reader.names = {name: value for name, value in reader.names.items() if name != "e"}
    return reader.read(text.replace("gamma(", "Gamma("))


def expression_of(source: Source, *, what: str = "the equation") -> Any:
    """An equation in a text as the SymPy expression that is zero, whether it is linear or not.  Raises `InputError`."""
    reader = EquationsReader(source, [source.unknown], what)
    value = source.walk(reader)
    return value.lhs - value.rhs if isinstance(value, sympy.Equality) else reader.arithmetic.expression(value)


class SystemReading(NamedTuple):
    """Equations in unknown functions of one variable, `conditions`, pairs of a place and its value, and what was guessed."""

    equations: tuple[Any, ...]
    functions: tuple[Any, ...]
    conditions: tuple[tuple[str, str], ...]
    guesses: tuple[str, ...]


def read_equations(
    text: str | Paste, *, var: str | None = None, names: Collection[str] = (), limits: Limits = DEFAULT_LIMITS
) -> SystemReading:
    """Several equations in one text, of any order, as SymPy has them; `names` are declared parameters.

    Raises `InputError`.

    >>> reading = read_equations("x' = y, y' = -x, x(0) = 1")
    >>> reading.equations
    (Eq(Derivative(x(t), t), y(t)), Eq(Derivative(y(t), t), -x(t)))
    >>> reading.functions, reading.conditions
    ((x(t), y(t)), (PlacedValue(place='x(0)', value='1'),))

    The variable is what an unknown function is applied to or differentiated by; else t, and x where that occurs and isn't
    unknown.
    """
    paste = text if isinstance(text, Paste) else Paste(text)
    most = SYMBOLIC_LIMITS
    limits = replace(limits, exponent=min(limits.exponent, most.exponent), bits=min(limits.bits, most.bits))
    unknowns = tuple(dict.fromkeys(name for tokens in paste.equations for name in differentiated(tokens, names)))
    if not unknowns:
        raise InputError("these equations contain no derivative", hint="for example x' = y, y' = -x")
    arguments = (argument_of(tokens, unknown) for tokens in paste.equations for unknown in unknowns)
    occurring = {name for tokens in paste.equations for name in tokens.names} - {*unknowns}
    default = paste.equations[0].variable or "t"
    usual = "x" if "x" in occurring and default not in occurring else default
    chosen = var or paste.variable or next(filter(None, arguments), usual)
    check_points(paste.text, paste.points, chosen)
    guesses = dict.fromkeys(paste.notes)
    equations = []
    for tokens in paste.equations:
        if not differentiated(tokens):
            said = f"{excerpt(' '.join(tokens.pieces).strip())!r} contains no derivative, and isn't a condition"
            raise InputError(said, hint="a value of a parameter is substituted, or assumed: --assume k=2")
        source = Vocabulary(chosen, unknowns[0], frozenset({*names, *unknowns})).of(tokens, is_equation=True)
        guesses |= dict.fromkeys(source.guesses)
        # Functions that aren't differentiated are given ones.
        source = source._replace(limits=limits, has_functions=True)
        equations.append(source.walk(EquationsReader(source, unknowns, "the equation")))
    x = sympy.Symbol(chosen)
    functions = tuple(sympy.Function(name)(x) for name in unknowns)
    return SystemReading(tuple(equations), functions, paste.conditions, tuple(guesses))


class SymbolicReader(RationalReader):
    """Reads a text as a SymPy expression, in which `unknowns` are functions at points."""

    arithmetic: LinearArithmetic

    def __init__(self, names: Mapping[str, Any] | None, what: str, limits: Limits, unknowns: Unknowns) -> None:
        super().__init__({**_NUMBER_VALUES, **(names or {})}, "", LinearArithmetic(limits), SYMBOLS)
        self.any_name = names is None
        self.functions = self.unknowns = unknowns
        self.what = what

    def read(self, text: str) -> Any:
        demand(self.arithmetic.limits, "text_length", len(text), f"{self.what} has {{}} characters")
        tokens = tokenize(text)
        if len(tokens.kinds) == 1:
            raise ParseError(f"there is no expression: {self.what} is empty", text=text, position=0)
        return self.arithmetic.expression(parse(tokens, self))

    def name(self, name: str) -> Any:
        if name in self.names:
            return self.names[name]
        if not self.any_name or (name in NUMBER_NAMES and name not in KNOWN_NUMBERS):
            raise self.refusal(f"can't contain {name}")
        return sympy.Symbol(name)

    def refusal(self, why: str) -> InputError:
        return InputError(f"{self.what} {why}")

    def other_power(self, base: Any, exponent: Any, _: Any) -> Any:
        return self.arithmetic.symbolic_power(base, exponent)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        name = head.rstrip(PRIME)
        if name in self.unknowns and len(arguments) == 1:
            return self.unknowns[name](self.arithmetic.expression(arguments[0]), len(head) - len(name))
        if head in (*POWER_CALLS, "root") and len(arguments) == 2:
            base, n = arguments
            exponent = self.arithmetic.divide(ONE, n) if head == "root" else n
            return self.power(base, exponent, site)
        value = self.arithmetic.called(_SYMBOLS_OF_FUNCTIONS.get(head, head), arguments)
        if value is None:
            hint = f"the functions are {', '.join(sorted(FUNCTION_NAMES))}, of one argument"
            raise InputError(f"{self.what} can't contain {site.text()}", hint=hint)
        return value


class EquationsReader(SymbolicReader):
    """Reads equations in the `unknowns`, functions of one variable; others, g(x), are given ones if the source has such."""

    def __init__(self, source: Source, unknowns: Collection[str], what: str) -> None:
        super().__init__(None, what, source.limits, {})
        self.variable = source.variable
        self.x = sympy.Symbol(source.variable)
        self.functions = {name: sympy.Function(name)(self.x) for name in unknowns}
        self.has_functions = source.has_functions

    def name(self, name: str) -> Any:
        return self.functions[name] if name in self.functions else super().name(name)

    def derivative(self, text: str) -> Any:
        name = text.rstrip(PRIME)
        if name not in self.functions:
            return super().derivative(text)
        return self.functions[name].diff(self.x, len(text) - len(name))

    def equation(self, left: Any, right: Any) -> Any:
        return sympy.Eq(self.arithmetic.expression(left), self.arithmetic.expression(right), evaluate=False)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        if head in DERIVATIVES:
            order = differentiations(arguments, self)
            return self.arithmetic.expression(arguments[0]).diff(self.x, order)
        if len(arguments) == 1 and self.is_variable(arguments[0]):
            if head.rstrip(PRIME) in self.functions:
                return self.derivative(head)
            if self.has_functions and not is_function(head):
                return sympy.Function(head)(self.x)
        return super().call(head, arguments, site)

    def is_variable(self, value: Any) -> bool:
        return bool(value == self.x)
