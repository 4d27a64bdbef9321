"""One way to write a formula: every function, place and equation as text for reading and as LaTeX, without SymPy.

Text has ^ for powers.  LaTeX is made from the exact data, each quotient as one fraction with integer coefficients.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count
from math import gcd
from typing import Any

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.reading.given import Equation, parameters_of

_GREEK = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi omega"
# What has another form in LaTeX, in the order in which it is replaced.
_REPLACEMENTS = [
    (re.compile(r"sqrt\(([^()]*)\)"), r"\\sqrt{\1}"),
    (re.compile(r"cbrt\(([^()]*)\)"), r"\\sqrt[3]{\1}"),
    (re.compile(r"root\(([^(),]*), (\d+)\)"), r"\\sqrt[\2]{\1}"),
    (re.compile(r"\*\*(\d+)"), r"^{\1}"),
    (re.compile(r"\b([A-Za-z])_?(\d+)\b"), r"\1_{\2}"),
    (re.compile(rf"(?<![A-Za-z\\])({_GREEK.replace(' ', '|')})(?![A-Za-z])"), r"\\\1"),
    (re.compile(r"\*"), " "),
]


#: Solutions with polynomials of a higher degree aren't written out, nor are dense polynomials of a higher degree in `Math`.
LARGEST_DEGREE = 300
#: Bits of all coefficients together, above which a function isn't printed in `Math`: some twenty screens.
_LARGEST_SIZE = 100_000
#: Characters; longer formulas are shortened.
_LONGEST = 2000
# The names within the engine.
_VARIABLE = "x"
_SYMBOL = "c"


@dataclass(frozen=True)
class Math:
    """A formula, for reading and for LaTeX."""

    text: str
    latex: str


def _first_free(name: str, taken: set[str]) -> str:
    return next(candidate for k in count() if (candidate := name + (str(k) if k else "")) not in taken)


class Names:
    """The names of one answer: those of the engine, unless the user's variable is called the same."""

    def __init__(self, variable: str, taken: Sequence[str] = ()) -> None:
        """`taken` are the names of the parameters."""
        self.variable = variable
        self.symbol = _first_free(_SYMBOL, {variable, *taken})
        self.unknown = next(name for name in ("w", "W", "w1", "w2", "w3") if name not in {variable, *taken})

    def poly(self, polynomial: Poly) -> str:
        """Python syntax."""
        return self._renamed(polynomial).to_str(self.variable)

    def ratfunc(self, function: RatFunc) -> str:
        """Python syntax."""
        return self.renamed(function).to_str(self.variable)

    def renamed(self, function: RatFunc) -> RatFunc:
        """The same function, whose constants are printed with `symbol`."""
        return RatFunc(self._renamed(function.num), self._renamed(function.den), reduced=True)

    def place(self, place: str) -> str:
        """A factor of the denominator, which evidence has in the engine's variable, in the user's."""
        return re.sub(rf"\b{_VARIABLE}\b", self.variable, place)

    def internal_place(self, place: str) -> str:
        """The inverse of `place`."""
        return re.sub(rf"\b{re.escape(self.variable)}\b", _VARIABLE, place)

    def _renamed(self, polynomial: Poly) -> Poly:
        if not isinstance(polynomial, ExtensionPoly):
            return polynomial
        field = polynomial.field
        if field.name != _SYMBOL or self.symbol == _SYMBOL:  # any other name belongs to the field of S
            return polynomial
        return ExtensionPoly.make(AlgebraicField(field.base, field.modulus, self.symbol), polynomial.parts)


@dataclass(frozen=True)
class Formulas:
    """The formulas of one answer: its variable is called `variable`, and `field` is that of the coefficients of S."""

    variable: str
    field: Field

    @property
    def names(self) -> Names:
        """The names of the variable, of omega and of its constants."""
        return Names(self.variable, parameters_of(self.field))

    def math(self, function: RatFunc | Poly) -> Math:
        """A function or a polynomial; of one that fills more than some screens, the degrees in place of the formula."""
        function = RatFunc(function) if isinstance(function, Poly) else function
        if _is_long(function):
            return Math(_degrees(function), rf"\text{{{_degrees(function)}}}")
        renamed = self.names.renamed(function)
        return Math(caret(renamed.to_str(self.variable)), latex_ratfunc(renamed, latex_text(self.variable)))

    def text(self, function: RatFunc) -> str:
        """A function for reading."""
        return caret(self.names.ratfunc(function))

    def cut(self, function: RatFunc) -> str:
        """A function for reading; of one that fills more than some screens, the degrees."""
        return _degrees(function) if _is_long(function) else self.text(function)

    def factor(self, function: RatFunc, operators: str = " /*-") -> str:
        """A function for reading, as the factor of a product: in parentheses where it has one of the operators."""
        text = self.text(function)
        return f"({text})" if any(sign in text for sign in operators) else text

    def named(self, text: str, latex: str, function: RatFunc | Poly) -> Math:
        """`name = function`."""
        value = self.math(function)
        return Math(f"{text} = {value.text}", f"{latex} = {value.latex}")

    def factor_of_place(self, place: str) -> Math:
        """The factor that vanishes at a place, = 0; "infinity" for infinity."""
        if place == "infinity":
            return Math(place, r"\infty")
        factor = self.names.place(place)
        return Math(f"{caret(factor)} = 0", f"{latex_text(factor)} = 0")

    def place(self, place: str) -> Math:
        """A place: x = 2 where its factor is linear in x with a simple constant, else factor = 0."""
        factor, x = self.names.place(place), self.variable
        root = {f"{x} - ": "", f"{x} + ": "-"}.get(factor[: len(x) + 3])
        root = "0" if factor == x else None if root is None else root + factor[len(x) + 3 :]
        if root is None or x in root or " " in root:
            return self.factor_of_place(place)
        return Math(f"{x} = {root}", f"{latex_text(x)} = {latex_text(root)}")


def shortened(text: str) -> str:
    """A formula of at most two screens."""
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST // 2]} ... ({len(text)} characters)"


def _is_long(function: RatFunc) -> bool:
    """Has it more terms, or longer coefficients, than anybody reads?"""
    return any(
        terms > LARGEST_DEGREE or terms * part.height_bits() > _LARGEST_SIZE
        for part in (function.num, function.den)
        for terms in [part.degree + 1 if part.degree < LARGEST_DEGREE else sum(map(bool, part))]
    )


def _degrees(function: RatFunc) -> str:
    above, below = function.num.degree, function.den.degree
    return f"(too long to print: degree {above}" + (f" over degree {below})" if below > 0 else ")")


def of_sympy(expression: Any) -> Math:
    """A SymPy expression."""
    from sympy import latex

    return Math(caret(str(expression)), latex(expression))


def caret(text: str) -> str:
    """Python's powers as they are read."""
    return text.replace("**", "^")


def given(equation: Equation) -> Math:
    """The equation as it was given."""
    return Math(equation.text(), latex_text(equation.text(caret=False)))


def latex_text(text: str) -> str:
    """An expression in Python syntax without quotients: powers, products, square roots, Greek names."""
    for pattern, replacement in _REPLACEMENTS:
        text = pattern.sub(replacement, text)
    return text


def latex_ratfunc(function: RatFunc, variable: str = "x") -> str:
    """A rational function as one fraction with integer coefficients.

    >>> from kovacic.algebra.rationals import QQ
    >>> latex_ratfunc(RatFunc(QQ.poly([1, 0, 1]), QQ.poly([0, 2])))
    '\\\\frac{x^{2} + 1}{2 x}'
    """
    top, bottom = function.num.common_denominator(), function.den.common_denominator()
    common = gcd(top, bottom)
    num, den = function.num * (top * (bottom // common)), function.den * (bottom * (top // common))
    contents = [int(c.p) for part in (num, den) for c in part.rational_coefficients() if hasattr(c, "p")]
    content = gcd(*contents) or 1
    num, den = num / content, den / content
    above = latex_text(num.integer_str(variable))
    if den == 1:
        return above
    sign = ""
    if above.startswith("-") and " + " not in above and " - " not in above:
        sign, above = "-", above[1:]
    return rf"{sign}\frac{{{above}}}{{{latex_text(den.integer_str(variable))}}}"
