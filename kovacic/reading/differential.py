"""Reader of texts and SymPy expressions that denote an equation a y'' + b y' + c y = f.

>>> from kovacic.reading.read import read_input
>>> print(read_input("x^2 y'' + x y' + (x^2 - 1/4) y = 0").equation)
x^2*y'' + x*y' + (x^2 - 1/4)*y = 0
>>> print(read_input("diff((1-t^2)*diff(y(t),t),t) + 6*y(t) = exp(t)").equation)
(-t^2 + 1)*y'' - 2*t*y' + 6*y = exp(t)

The grammar is that of expressions; an expression without an equals sign is one that is zero.  The unknown function is the
one that is differentiated, and its derivatives are written y'', y''(x), diff(y, x, 2), diff(y(x), (x, 2)) or Derivative.
Within an equation the unknown function may follow a coefficient without a sign: x y'' + 2x y'.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import ENERGY, EULER, PI, UNKNOWN, Equation, over, parameters_of
from kovacic.errors import NotLinear, NotRational, ParseError
from kovacic.numbers.numerals import as_text
from kovacic.reading.arithmetic import ONE, VARIABLE, ZERO, Arithmetic, Value
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.dialects import tokenize
from kovacic.reading.expression import RationalReader, parse_with
from kovacic.reading.lexer import DERIVATIVES, PRIME
from kovacic.reading.linear import REST, DerivativeOperator, LinearArithmetic, LinearForm, differentiations, is_plain
from kovacic.reading.names import KNOWN_NUMBERS, TRANSCENDENTAL_HINT, is_letter
from kovacic.reading.naming import Source
from kovacic.reading.parser import Site, parse


class EquationReader(RationalReader):
    """Reads texts and SymPy expressions that are linear in the unknown function and its derivatives."""

    arithmetic: LinearArithmetic

    def __init__(self, source: Source, constants: Constants) -> None:
        """The `source` says which names are declared, and whether g(x) is a function that is given."""
        arithmetic = LinearArithmetic(source.limits, source.variable, source.unknown, self.coefficient)
        super().__init__({source.variable: VARIABLE}, source.variable, arithmetic, constants)
        self.source = source
        self.unknown = source.unknown
        self.functions = {source.unknown: None}
        # y is a parameter where the unknown function has another name.
        self.declared = {*source.declared, *([UNKNOWN] if source.unknown else [])}
        #: The letters that stand for numbers which aren't algebraic.
        self.letters: dict[str, Any] = {}

    def coefficient(self, expression: Any) -> Any:
        """A rational function of x and pi, or of x and e, with a letter for that number."""
        import sympy

        from kovacic.reading.symbolic import walked

        euler = f"{EULER}_" if EULER in self.declared else EULER
        powers = {e for e in expression.atoms(sympy.exp) if e.args[0].is_Integer}
        numbers = {PI: sympy.pi} if expression.has(sympy.pi) else {}
        if powers or expression.has(sympy.E):
            numbers[euler] = sympy.E
        self.letters |= numbers
        names = {number: sympy.Symbol(name) for name, number in numbers.items()}
        value = walked(expression.xreplace({e: names[sympy.E] ** e.args[0] for e in powers} | names), self)
        if not is_plain(value):
            shown = as_text(expression).replace("**", "^")
            if not expression.free_symbols:
                raise NotRational(f"{shown} isn't an algebraic number", hint=TRANSCENDENTAL_HINT)
            said = f"a coefficient that isn't a rational function of {self.variable}: {shown}"
            raise NotRational(said, hint="coefficients are rational in x, or in exp(k*x), sin(k*x), ...")
        if len(self.letters) > 1:
            raise NotRational("pi and e in coefficients: it isn't known whether they are algebraically independent")
        return value

    def parts(self, value: Any) -> dict[int, Any]:
        """The coefficients of the derivatives, and the rest.  Raises `NotLinear` for an operator without an operand."""
        if isinstance(value, DerivativeOperator):
            hint = f"write its operand: (D^2 + 1) {self.unknown or UNKNOWN} = 0"
            raise NotLinear(f"the operator d/d{self.variable} is applied to nothing", hint=hint)
        return {**value.parts} if isinstance(value, LinearForm) else {REST: value}

    def check_order(self, order: int, text: str | None, expected: int = 2) -> None:
        """Raise `NotLinear` unless the order of an equation is the expected one; it is -1 without y."""
        if order == expected:
            return
        y = self.unknown or UNKNOWN
        kind, hint = {1: ("first", f"for example {y}' = x {y}"), 2: ("second", f"for example {y}'' = (x^2 + 3) {y}")}[
            expected
        ]
        what = f"is of order {order}" if order > 0 else f"contains no derivative of {y}"
        said = f"an equation of {kind} order is expected, and this one {what}"
        if order <= 0 and "=" in (text or ""):
            hint += "; S alone is written without an equals sign"
        position = None if text is None else 0
        raise NotLinear(said, hint=hint, text=text, position=position, length=len(text or ""))

    def equation_of(self, value: Any, text: str | None) -> Equation:
        """The equation `value` = 0, for a linear form that was read from `text`."""
        parts = self.parts(value)
        rest = parts.pop(REST, ZERO)
        coefficients = {k: self.arithmetic.rational(c) for k, c in parts.items()}
        self.check_order(max((k for k, c in coefficients.items() if c), default=0), text)
        h = None
        if not is_plain(rest):  # its rational terms, and h, minus the sum of its other ones
            from kovacic.reading.symbolic import walked

            values = {term: walked(term, self) for term in rest.as_ordered_terms()}
            h = -sum(term for term, value in values.items() if not is_plain(value)) or None
            rest = self.arithmetic.sum([ZERO, *filter(is_plain, values.values())])
        coefficients[REST] = self.arithmetic.rational(rest)
        nothing = self.arithmetic.rational(ZERO)
        r, c, b, a = (over(coefficients.get(k, nothing), self.constants.field) for k in (REST, 0, 1, 2))
        return Equation(a, b, c, -r, h, self.variable, self.unknown)

    def other_leaf(self, node: Any) -> Any:
        """The unknown function, or a derivative; on the right-hand side a function that isn't rational."""
        from sympy import Symbol

        from kovacic.reading.symbolic import functions_in, walked

        if node.is_Derivative:
            for symbol, count in node.variable_count:
                if symbol.name != self.variable or not getattr(count, "is_Integer", False):
                    raise NotLinear(f"{node} isn't a derivative with respect to {self.variable}")
            return self._derived(walked(node.expr, self), int(node.derivative_count))
        if [str(node.func), *map(str, node.args)] == [self.unknown, self.variable]:
            return _derivative_of_unknown(0)
        plain = node.xreplace({symbol: Symbol(symbol.name) for symbol in node.free_symbols})
        if node.func.__name__ == self.unknown:
            said = f"{plain} and {self.unknown}({self.variable}) have different arguments, as in a delay equation"
            raise NotLinear(said)
        if any(f.func.__name__ == self.unknown for f in functions_in(plain)):
            raise NotLinear(f"{self.unknown}({self.variable}) within {plain}: the equation isn't linear")
        return plain

    def name(self, name: str) -> Any:
        if name == self.unknown:
            return _derivative_of_unknown(0)
        is_known = name in self.names or name in self.declared
        if name in KNOWN_NUMBERS and name != "I" and not is_known:
            import sympy

            return getattr(sympy, KNOWN_NUMBERS[name]).expand(func=True)
        return super().name(name)

    def derivative(self, text: str) -> Any:
        name = text.rstrip(PRIME)
        if name != self.unknown:
            hint = f"there is one unknown function, here {self.unknown}; write products with *: x*y''"
            raise NotLinear(f"{text} is a derivative of something else than {self.unknown}", hint=hint)
        return _derivative_of_unknown(len(text) - len(name))

    def operator(self, variable: str) -> Any:
        if variable != self.variable:
            raise NotLinear(f"a derivative with respect to something else than {self.variable}")
        return DerivativeOperator({1: ONE})

    def equation(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm):  # f = a y'' + b y' + c y
            left, right = right, left
        return self.arithmetic.sum([left, self.arithmetic.negate(right)])

    def other_power(self, base: Any, exponent: Any, place: Any) -> Any:
        with suppress(NotRational):
            return super().other_power(base, exponent, place)
        if ENERGY in self.constants.parameters and self.arithmetic.closed(base) == self.constants.parameter(ENERGY):
            hint = f"write exp(...) or e^x for the exponential function; {ENERGY} is the energy"
            raise NotLinear(f"a power of {ENERGY}, which is a parameter", hint=hint)
        return self.arithmetic.symbolic_power(base, exponent)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        if head.rstrip(PRIME) == self.unknown:
            return self._call_of_unknown(head, arguments, site)
        if head in DERIVATIVES:
            letter = self._letter(arguments[0])
            if letter:
                said = f"{site.text()} is a derivative of something else than {self.unknown}"
                hint = f"if {letter} is a number, declare it:"
                raise NotLinear(said, hint=f"{hint} parameters=[{letter!r}]", shell=f"{hint} --names {letter}")
            return self._derived(arguments[0], differentiations(arguments, self))
        if head in self.names:
            hint = f"for a product write {head}*({site.inside()})"
            raise ParseError(f"{head} is followed by a parenthesis like a function", hint=hint)
        try:
            return super().call(head, arguments, site)
        except NotRational:
            is_given = head.isidentifier() and len(arguments) == 1 and self.is_variable(arguments[0])
            if is_given and self.source.has_functions:
                import sympy

                return sympy.Function(head)(sympy.Symbol(self.variable))
            value = self.arithmetic.called(head, arguments)
            if value is None and is_given and is_letter(head):
                unknown, either = f"{self.unknown or UNKNOWN}({self.variable})", f"for a product write {head}*(...)"
                raise NotRational(
                    f"{site.text()} isn't a rational function of {self.variable}",
                    hint=f'{either}; dsolve takes a given function {head} with func="{unknown}"',
                    shell=f'{either}; dsolve takes a given function {head} with --func "{unknown}"',
                ) from None
            if value is None:
                raise
            return value

    def _call_of_unknown(self, head: str, arguments: list[Any], site: Site) -> LinearForm:
        y = self.unknown
        if len(arguments) != 1:
            raise NotLinear(f"{y} is a function of {self.variable} alone")
        (argument,) = arguments
        if self.is_variable(argument):
            return _derivative_of_unknown(len(head) - len(y))
        is_value = self.arithmetic.number(argument) is not None
        values = f"values follow the equation after commas: {y}'' + {y} = 0, {y}(0) = 1"
        hint = values if is_value else f"for a product write {y}*(...)"
        said = f"{site.text()} and {y}({self.variable}) have different arguments, as in a delay equation"
        raise NotLinear(said, hint=hint)

    def is_variable(self, value: Any) -> bool:
        return is_plain(value) and bool(self.arithmetic.closed(value) == self.arithmetic.closed(VARIABLE))

    def _letter(self, value: Any) -> str | None:
        """The undeclared letter that the value is."""
        letters = [name for name in self.constants.parameters if name not in self.source.declared]
        same = (name for name in letters if self.arithmetic.closed(value) == self.constants.parameter(name))
        return next(same, None) if is_plain(value) else None

    def _derived(self, value: Any, order: int) -> Any:
        for _ in range(order):
            value = self.arithmetic.derivative(value)
        return value


def _derivative_of_unknown(order: int) -> LinearForm:
    return LinearForm({order: ONE})


def generators(field: Field) -> dict[str, Value]:
    """The parameters and the algebraic constant of a field, by their names."""
    found: dict[str, Value] = {
        name: field.ground.generator(name).over(field)  # type: ignore[attr-defined]
        for name in parameters_of(field)
    }
    return {**found, field.name: field.generator} if isinstance(field, AlgebraicField) else found


@dataclass(frozen=True)
class WrittenReader:
    """`names` are what the names stand for that occur, formulas such as sqrt(2) among them, in the field or below it."""

    field: Field
    names: Mapping[str, Value]
    arithmetic: Arithmetic

    def plain(self, text: str) -> tuple[str, dict[str, Value]]:
        """The text with a name for each formula among the names, and the values of all of them."""
        names: dict[str, Value] = {}
        for number, (name, value) in enumerate(self.names.items()):
            plain = name if name.isidentifier() else f"constant_{number}_"
            names[plain] = value
            if plain != name:
                text = text.replace(name, f"({plain})")
        return text, names

    def ratfunc(self, text: str) -> RatFunc:
        """Raises `InputError` for what isn't a rational function in these names."""
        text, names = self.plain(text)
        return over(self.arithmetic.rational(parse_with(text, names, self.arithmetic)), self.field)

    def poly(self, text: str) -> Poly:
        value = self.ratfunc(text)
        if not value.is_polynomial:
            raise ValueError(f"{text!r} isn't a polynomial")
        return value.num


def written_equation(text: str, variable: str, unknown: str, known: Constants) -> Equation:
    """The equation that a text denotes over the field of these constants, whose parameters may be called like formulas."""

    def read(constants: Constants) -> Equation:
        field = constants.field
        plain, names = WrittenReader(field, generators(field), Arithmetic(constants.limits)).plain(text)
        source = Source(print, variable, unknown, limits=constants.limits)  # which isn't walked
        reader = EquationReader(source, constants)
        reader.names = {**reader.names, **names}
        return reader.equation_of(parse(tokenize(plain), reader), plain)

    return read_with_constants(read, known)
