"""Hypothesis strategies for expressions of one variable: a text in every legal spelling, with a value computed apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from hypothesis import strategies as st


@dataclass(frozen=True)
class Expression:
    """`text` as a user may type it, `python` as SymPy reads it, `at(x)` its value (ZeroDivisionError: undefined there).

    `strength` is the precedence of the outermost operation of `text`: 0 sum, 1 product, 2 sign, 3 implicit product, 4 power,
    5 atom.
    """

    text: str
    python: str
    at: Callable[[Fraction], Fraction]
    strength: int

    def as_operand(self, strength: int) -> str:
        """The text, in parentheses where it binds weaker than `strength`."""
        return self.text if self.strength >= strength else f"({self.text})"


def numbers() -> st.SearchStrategy[Expression]:
    integer = st.integers(0, 12).map(lambda n: Expression(str(n), f"Integer({n})", lambda x: Fraction(n), 5))
    decimal = st.tuples(st.integers(0, 30), st.integers(0, 999)).map(
        lambda pair: Expression(
            f"{pair[0]}.{pair[1]:03d}",
            f"Rational({pair[0] * 1000 + pair[1]}, 1000)",
            lambda x: Fraction(pair[0] * 1000 + pair[1], 1000),
            5,
        )
    )
    return integer | decimal


VARIABLE = Expression("x", "x", lambda x: x, 5)


def expressions(max_leaves: int = 10) -> st.SearchStrategy[Expression]:
    """Random expressions in x."""
    return st.recursive(st.just(VARIABLE) | numbers(), _combined, max_leaves=max_leaves)


def _combined(inner: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    space = st.sampled_from(["", " ", "\n "])
    binary = st.builds(_binary, inner, inner, st.sampled_from("+-*/"), space)
    sign = st.builds(_signed, inner, st.sampled_from("+-−"), space)
    power = st.builds(_power, inner, st.integers(-3, 3), st.sampled_from(["^", "**", "superscript", "parentheses"]))
    juxtaposed = st.builds(_juxtaposed, inner, inner, st.sampled_from(["", " "]))
    wrapped = st.builds(lambda e: Expression(f"({e.text})", e.python, e.at, 5), inner)
    return binary | sign | power | juxtaposed | wrapped


def _binary(left: Expression, right: Expression, operator: str, space: str) -> Expression:
    def at(x: Fraction) -> Fraction:
        a, b = left.at(x), right.at(x)
        return a + b if operator == "+" else a - b if operator == "-" else a * b if operator == "*" else a / b

    strength = 0 if operator in "+-" else 1
    # A divisor must not be an implicit product without parentheses; the right operand binds one step stronger.
    operand = 4 if operator == "/" and right.strength == 3 else strength + 1
    text = f"{left.as_operand(strength)}{space}{operator}{space}{right.as_operand(operand)}"
    if operator == "/" and right.strength == 2:
        text = f"{left.as_operand(strength)}{space}/{space}({right.text})"
    return Expression(text, f"(({left.python}) {operator} ({right.python}))", at, strength)


def _signed(inner: Expression, sign: str, space: str) -> Expression:
    negative = sign != "+"
    return Expression(
        f"{sign}{space}{inner.as_operand(2)}",
        f"(-({inner.python}))" if negative else inner.python,
        (lambda x: -inner.at(x)) if negative else inner.at,
        2,
    )


def _power(base: Expression, exponent: int, style: str) -> Expression:
    spelled = {
        "^": f"^{exponent}",
        "**": f"**{exponent}",
        "superscript": str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")),
        "parentheses": f" ^ ({exponent - 1} + 1)",
    }[style]
    # A superscript directly after a power would be its exponent's.
    text = base.as_operand(5) + spelled
    return Expression(text, f"(({base.python}) ** ({exponent}))", lambda x: _raise(base.at(x), exponent), 4)


def _raise(value: Fraction, exponent: int) -> Fraction:
    if value == 0 and exponent <= 0:
        raise ZeroDivisionError
    return value**exponent


def _juxtaposed(left: Expression, right: Expression, space: str) -> Expression:
    """An implicit product: the left factor ends in a digit or parenthesis, the right one begins with a letter or one."""
    first = left.as_operand(3)
    if not (first[-1] == ")" or first[-1] in "0123456789") or (space == "" and first[-1] != ")" and "." in first[-4:]):
        first = f"({left.text})"
    second = right.as_operand(4)
    if not (second[0] == "(" or second[0].isalpha()):
        second = f"({right.text})"
    return Expression(
        f"{first}{space}{second}", f"(({left.python}) * ({right.python}))", lambda x: left.at(x) * right.at(x), 3
    )
