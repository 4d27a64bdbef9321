"""Functions of the parameters as formulas: plain and LaTeX."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.sparse import factorisation

_GREEK = frozenset(
    {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi"}
    | {"pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"}
)


def shown(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers."""
    return function.to_str(variable).replace("**", "^")


def as_latex(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """As LaTeX, without dollar signs."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = quotient.cleared()
    if not isinstance(above, FunctionPoly) or not isinstance(below, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    names = (variable, *above.field.names)
    numerator = _polynomial(above.num, names)
    if below.num.is_one():
        return numerator
    return rf"\frac{{{numerator}}}{{{_polynomial(below.num, names)}}}"


def factored(function: RatFunc, variable: str) -> str:
    """The shorter one of the expanded form and the product of irreducible factors over Q."""
    above, below = function.cleared()
    if not isinstance(above, FunctionPoly) or not isinstance(below, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    expanded = shown(function, variable)
    if above.num.is_zero():
        return expanded
    numerator, denominator = (_factors(part, variable) for part in (above, below))
    product = "*".join(numerator).replace("-1*", "-")
    if denominator != ["1"]:
        product += "/" + ("*".join(denominator) if len(denominator) == 1 else f"({'*'.join(denominator)})")
    return min(expanded, product, key=len)


def _factors(polynomial: FunctionPoly, variable: str) -> list[str]:
    """The content, unless it is 1, and the powers of the factors."""
    content, factors = factorisation(polynomial.num)
    one = polynomial.field.context.constant(1)
    parts = []
    for factor, power in factors:
        text = shown(FunctionPoly(polynomial.field, factor, one), variable)
        parts.append(_in_parentheses(text, " -") + (f"^{power}" if power > 1 else ""))
    return parts if content == 1 and parts else [str(content), *parts]


def _in_parentheses(text: str, when: str) -> str:
    return f"({text})" if any(sign in text for sign in when) else text


def symbol(name: str) -> str:
    """A name as LaTeX: Greek letters, digits at the end as an index; the constants I and sqrt(n)."""
    radical = re.fullmatch(r"sqrt\((.*)\)", name)
    if radical or name == "I":
        return rf"\sqrt{{{radical[1]}}}" if radical else r"\mathrm{i}"
    match = re.fullmatch(r"([^\W\d_]+)_?(\d+)", name)
    base, index = (match[1], match[2]) if match else (name, "")
    letter = f"\\{base}" if base in _GREEK else base if len(base) == 1 else rf"\mathrm{{{base}}}"
    return f"{letter}_{{{index}}}" if index else letter


def _polynomial(polynomial: Any, names: Sequence[str]) -> str:
    terms: list[str] = []
    for exponents, coefficient in polynomial.to_dict().items():
        powers = [
            symbol(name) if exponent == 1 else f"{symbol(name)}^{{{exponent}}}"
            for name, exponent in zip(names, exponents, strict=True)
            if exponent
        ]
        value = int(coefficient)
        digits = "" if powers and abs(value) == 1 else str(abs(value))
        terms.append(("- " if value < 0 else "+ ") + " ".join([digits, *powers]).strip())
    text = " ".join(terms).removeprefix("+ ") if terms else "0"
    return "-" + text[2:] if text.startswith("- ") else text
