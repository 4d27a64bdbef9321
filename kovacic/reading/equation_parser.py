"""Text into an equation a y'' + b y' + c y = f.

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

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from kovacic.equation import Equation
from kovacic.errors import InputError, LimitExceeded, NotLinear, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, NotAnInteger, Term
from kovacic.reading.automaton import Site, run
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.lexer import Tokens, tokenize
from kovacic.reading.linear import LinearArithmetic, LinearForm
from kovacic.reading.parsed import DEFAULT_VARIABLE, ENERGY, NUMBER_NAMES, UNKNOWN
from kovacic.reading.parser import ExpressionBuilder

_PRIMES = {"'": 1, "’": 1, "′": 1, "″": 2}
_DERIVATIVES = frozenset({"diff", "Diff", "Derivative", "D"})
_LARGEST_ORDER = 100

#: What an equation contains, and S alone doesn't.
_MARKS = ("=", *_PRIMES, *(f"{name}(" for name in _DERIVATIVES))

#: The functions that a right-hand side may contain, with SymPy's names.
_FUNCTIONS = {
    **{name: name for name in ("exp", "log", "sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "acot")},
    **{name: name for name in ("sinh", "cosh", "tanh", "coth", "asinh", "acosh", "atanh", "erf")},
    "ln": "log",
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
}

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
_USUAL_VARIABLES = frozenset("xtzsruvwXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}

Where = Callable[[], Site]


def is_equation(text: str) -> bool:
    """Does a text mean an equation rather than S alone: has it an equals sign, a prime or a derivative?"""
    return any(map(text.__contains__, _MARKS))


def parse_equation(
    text: str, *, variable: str | None = None, unknown: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> tuple[Equation, tuple[str, ...]]:
    """The equation that `text` denotes, and what the user should know about how it was read.

    Raises `NotLinear` for an equation that isn't linear of second order in one unknown function, `NotRational` if its
    coefficients aren't rational functions, `ParseError` for what isn't an equation, all with the position where there is
    one; `LimitExceeded`.
    """
    if len(text) > limits.text_length:
        raise LimitExceeded(
            f"the text has {len(text)} characters, above the limit of {limits.text_length}", limit="text_length"
        )
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise ParseError("there is no equation", text=text, position=0, hint="for example y'' = (x^2 + 3) y")
    y = unknown or _unknown_of(tokens)
    x = variable or _variable_of(tokens, y)

    def read(constants: Constants) -> tuple[Equation, tuple[str, ...]]:
        arithmetic = LinearArithmetic(limits, x, y)
        builder = EquationBuilder(x, y, arithmetic, constants)
        equation = as_equation(arithmetic, run(tokens, builder), constants, text)
        return equation, (*builder.notices(), *constants.notices())

    return read_with_constants(read, limits)


def parse_expression(text: str, variable: str, *, limits: Limits = DEFAULT_LIMITS) -> Any:
    """The SymPy expression of an elementary function of the variable, read without executing anything.

    Raises `InputError` and `LimitExceeded`.
    """
    arithmetic = LinearArithmetic(limits, variable, "")

    def read(constants: Constants) -> Any:
        return arithmetic.expression(run(tokenize(text), EquationBuilder(variable, "", arithmetic, constants)))

    return read_with_constants(read, limits)


def as_equation(arithmetic: LinearArithmetic, value: Any, constants: Constants, text: str | None) -> Equation:
    """The equation that says that a linear form is zero."""
    form = arithmetic.form(value)
    y = arithmetic.unknown
    zero = constants.field.poly([])
    coefficients = {k: arithmetic.rational(c) for k, c in form.parts.items()}
    orders = [k for k, c in coefficients.items() if c]
    if not orders or max(orders) != 2:
        what = "contains no derivative" if not orders or not max(orders) else f"is of order {max(orders)}"
        raise NotLinear(
            f"an equation of second order is expected, and this one {what} of {y}"
            if what.startswith("contains")
            else f"an equation of second order is expected, and this one {what}",
            text=text,
            position=None if text is None else 0,
            length=len(text or ""),
            hint=f"for example {y}'' = (x^2 + 3) {y}",
        )
    field = constants.field

    def coefficient(value: Any) -> Any:
        from kovacic.algebra.ratfunc import RatFunc

        if value is None:
            return RatFunc(zero)
        rational = arithmetic.rational(value)
        return RatFunc(rational.num.over(field), rational.den.over(field), reduced=True)

    c, b, a = (coefficient(form.parts.get(k)) for k in range(3))
    other = None if form.other is None or form.other == 0 else -form.other
    return Equation(a, b, c, -coefficient(form.rest), other, arithmetic.variable, y)


class EquationBuilder(ExpressionBuilder):
    """The methods for equations: expressions in which the unknown function and its derivatives occur linearly."""

    arithmetic: LinearArithmetic

    def __init__(self, variable: str, unknown: str, arithmetic: LinearArithmetic, constants: Constants) -> None:
        super().__init__({variable: VARIABLE}, variable, arithmetic, constants)
        self.unknown = unknown

    def name(self, values: list[Any], where: Where) -> Any:
        (name,) = values
        if name == self.unknown:
            return self._derivative_of_unknown(0)
        if name != self.variable and name in ("e", "pi", "π"):
            import sympy

            return self.arithmetic.opaque(sympy.E if name == "e" else sympy.pi)
        if name == UNKNOWN and self.constants is not None:  # the unknown function has another name
            return self.constants.parameter(name)
        return super().name(values, where)

    def primed(self, values: list[Any], where: Where) -> Any:
        (text,) = values
        name = text.rstrip("".join(_PRIMES))
        if name != self.unknown:
            raise _error(NotLinear, f"{text} is a derivative of something else than {self.unknown}", where())
        return self._derivative_of_unknown(sum(_PRIMES[mark] for mark in text[len(name) :]))

    def equation(self, values: list[Any], where: Where) -> Any:
        left, right = values
        if not self.arithmetic.form(left).parts:  # f = a y'' + b y' + c y
            left, right = right, left
        return self.arithmetic.add(left, right, subtract=True)

    def multiply(self, values: list[Any], where: Where) -> Any:
        with _located(where):
            return super().multiply(values, where)

    def divide(self, values: list[Any], where: Where) -> Any:
        with _located(where):
            return super().divide(values, where)

    def superscript(self, values: list[Any], where: Where) -> Any:
        with _located(where):
            return super().superscript(values, where)

    def power(self, values: list[Any], where: Where) -> Any:
        base, exponent = values
        with _located(where):
            try:
                return self.arithmetic.power(base, exponent)
            except NotAnInteger:
                pass
            if not isinstance(base, LinearForm) and not isinstance(exponent, LinearForm):
                try:
                    return super()._root(base, exponent, where)
                except NotRational:
                    pass
            site = where()
            if site.piece(0) == ENERGY:
                hint = f"write exp(...) or e^x for the exponential function; {ENERGY} is the energy"
                raise _error(NotLinear, f"a power of {ENERGY}, which is a parameter", site, hint=hint)
            return self.arithmetic.opaque(self.arithmetic.expression(base) ** self.arithmetic.expression(exponent))

    def juxtapose(self, values: list[Any], where: Where) -> tuple[Any, int]:
        with _located(where):
            return super().juxtapose(values, where)

    def juxtapose_more(self, values: list[Any], where: Where) -> tuple[Any, int]:
        with _located(where):
            return super().juxtapose_more(values, where)

    def call(self, values: list[Any], where: Where) -> Any:
        site = where()
        head, arguments = values
        bare = head.rstrip("".join(_PRIMES))
        with _located(where):
            if bare == self.unknown:
                order = sum(_PRIMES[mark] for mark in head[len(bare) :])
                if len(arguments) != 1 or not self._is_variable(arguments[0]):
                    raise NotLinear(f"{self.unknown} is a function of {self.variable} alone")
                return self._derivative_of_unknown(order)
            if head in _DERIVATIVES:
                return self._differentiated(arguments)
            if head in _FUNCTIONS and len(arguments) == 1:
                import sympy

                return self.arithmetic.opaque(
                    getattr(sympy, _FUNCTIONS[head])(self.arithmetic.expression(arguments[0]))
                )
            if head == "sqrt" and len(arguments) == 1:
                try:
                    return super().call(values, where)
                except NotRational:
                    import sympy

                    return self.arithmetic.opaque(sympy.sqrt(self.arithmetic.expression(arguments[0])))
        if head in self.names:
            inside = site.tokens.piece(site.begins[2], site.end - 1)
            raise _error(
                ParseError,
                f"{head} is followed by a parenthesis like a function",
                site,
                hint=f"for a product write {head}*({inside})",
            )
        return super().call(values, where)

    def _adjacent(self, where: Where) -> int:
        """A coefficient may stand before the unknown function without a sign."""
        site = where()
        tokens, right = site.tokens, site.begins[1]
        after = tokens.pieces[right]
        if tokens.kinds[right] in ("NAME", "PRIMED", "HEAD") and (
            after.rstrip("".join(_PRIMES)) == self.unknown or after in _DERIVATIVES
        ):
            return right
        return super()._adjacent(where)

    def _derivative_of_unknown(self, order: int) -> LinearForm:
        return LinearForm({order: Term(1, 0)})

    def _is_variable(self, value: Any) -> bool:
        if isinstance(value, LinearForm | list):
            return False
        closed = self.arithmetic.closed(value)
        return bool(closed == self.arithmetic.closed(VARIABLE))

    def _differentiated(self, arguments: list[Any]) -> Any:
        """diff(y, x), diff(y, x, 2), diff(y, (x, 2)), diff(y, x, x), diff(y): the order is the number of differentiations."""
        function, *rest = arguments
        order, previous = 0, None
        for argument in rest:
            if isinstance(argument, list):
                if not self._is_variable(argument[0]):
                    raise NotLinear(f"a derivative with respect to something else than {self.variable}")
                order, previous = order + self._order(argument[1]), None
            elif self._is_variable(argument):
                order, previous = order + 1, argument
            elif previous is not None:
                order, previous = order + self._order(argument) - 1, None
            else:
                raise NotLinear(f"a derivative with respect to something else than {self.variable}")
        if isinstance(function, list) or order > _LARGEST_ORDER:
            raise NotLinear("this isn't a derivative that can be read")
        for _ in range(order if rest else 1):
            function = self.arithmetic.derivative(function)
        return self.arithmetic.constant(0) if function is None else function

    def _order(self, value: Any) -> int:
        number = self._rational_number(value) if not isinstance(value, LinearForm | list) else None
        if number is None or number.denominator != 1 or number < 0:
            raise NotLinear("the order of a derivative is a number 0, 1, 2, ...")
        return number.numerator


@contextmanager
def _located(where: Where) -> Iterator[None]:
    """Gives an error of the arithmetic of linear forms its place in the text."""
    try:
        yield
    except InputError as error:
        if error.text is not None:
            raise
        raise _error(type(error), error.message, where(), hint=error.hint) from None


def _error(kind: type[InputError], message: str, site: Site, *, hint: str | None = None) -> InputError:
    position, length = site.span()
    return kind(message, text=site.tokens.text, position=position, length=length, hint=hint)


def _unknown_of(tokens: Tokens) -> str:
    """The name that has primes, or that is differentiated; else y."""
    for kind, piece in zip(tokens.kinds, tokens.pieces, strict=True):
        bare = piece.rstrip("".join(_PRIMES))
        if kind in ("PRIMED", "HEAD") and bare != piece:
            return bare
    for k, kind in enumerate(tokens.kinds[:-3]):
        if kind == "HEAD" and tokens.pieces[k] in _DERIVATIVES:
            following, after, inner = tokens.kinds[k + 2], tokens.kinds[k + 3], tokens.pieces[k + 2]
            if following == "HEAD" and inner not in _DERIVATIVES | _FUNCTIONS.keys():
                return inner
            if following == "NAME" and after in ("COMMA", "RPAR"):
                return inner
    return UNKNOWN


def _variable_of(tokens: Tokens, unknown: str) -> str:
    """The argument of the unknown function, or what is differentiated by; else the only name, or x."""
    kinds = tokens.kinds
    for k in range(len(kinds) - 3):
        is_unknown = tokens.pieces[k].rstrip("".join(_PRIMES)) == unknown
        if is_unknown and kinds[k : k + 4] == ["HEAD", "LPAR", "NAME", "RPAR"]:
            return tokens.pieces[k + 2]
        if is_unknown and kinds[k : k + 3] == ["NAME", "COMMA", "NAME"]:
            return tokens.pieces[k + 2]
    excluded = {*NUMBER_NAMES, ENERGY, unknown, "e"}
    names = [name for name in tokens.names() if name not in excluded]
    if DEFAULT_VARIABLE in names or not names:
        return DEFAULT_VARIABLE
    usual = [name for name in names if name in _USUAL_VARIABLES]
    if len(usual) != 1 or len(names) > 1:
        question = "is it the variable, or a parameter" if len(names) == 1 else "which is the variable"
        raise InputError(
            f"{', '.join(names[:6])}: {question}?",
            text=tokens.text,
            position=tokens.starts[tokens.names()[names[-1]]],
            length=len(names[-1]),
            hint=f"write {unknown}''(x) for the derivative, or name the variable: var='x' (--var x)",
        )
    return usual[0]
