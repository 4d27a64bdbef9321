"""Functions of the parameters, elements of Q(t): their parts, their factors, and how they are written, plain and in LaTeX."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.sparse import by_power, factorisation

_GREEK = frozenset(
    {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi"}
    | {"pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"}
)


def over_parameters(value: Poly) -> FunctionPoly:
    """The same polynomial; raises `TypeError` where its field isn't a Q(t)."""
    if not isinstance(value, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    return value


def element(field: FunctionField, num: Any) -> FunctionPoly:
    """A polynomial in x and the parameters over Z, as one over Q(t)."""
    return FunctionPoly(field, num, field.context.constant(1))


def numerator(function: Poly) -> FunctionPoly:
    """The numerator of a polynomial over Q(t)."""
    known = over_parameters(function)
    return element(known.field, known.num)


def irreducible_factors(function: Poly) -> list[FunctionPoly]:
    """The irreducible factors over Q of the numerator of an element of Q(t)."""
    known = over_parameters(function)
    return [element(known.field, factor) for factor, _ in factorisation(known.num)[1]]


def denominators(polynomial: Poly) -> list[FunctionPoly]:
    """The denominators of the coordinates of a polynomial over an extension of Q(t), as elements of Q(t)."""
    leaves = [leaf for leaf in polynomial.leaves() if isinstance(leaf, FunctionPoly) and not leaf.den.is_one()]
    return [element(leaf.field, leaf.den) for leaf in leaves]


def union(lists: Iterable[Iterable[FunctionPoly]]) -> list[FunctionPoly]:
    """The different polynomials of several lists, in order."""
    return list(dict.fromkeys(function for functions in lists for function in functions))


def degrees(function: FunctionPoly) -> tuple[int, ...]:
    """The degrees of the numerator in the parameters."""
    return tuple(map(int, function.num.degrees()[1:]))


def powers_of(function: FunctionPoly, i: int) -> dict[int, FunctionPoly]:
    """The coefficients of the powers of parameter number i in the numerator."""
    return {power: element(function.field, part) for power, part in by_power(function.num, 1 + i).items()}


def shown(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers."""
    return function.to_str(variable).replace("**", "^")


def shown_root(square: Poly) -> str:
    """The square root of an element of Q(t), in ordinary notation."""
    root = square.field.sqrt(square)
    return f"sqrt({shown(RatFunc(square))})" if root is None else shown(RatFunc(root))


def as_latex(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """As LaTeX, without dollar signs."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = map(over_parameters, quotient.cleared())
    names = (variable, *above.field.names)
    if below.num.is_one():
        return _polynomial(above.num, names)
    return rf"\frac{{{_polynomial(above.num, names)}}}{{{_polynomial(below.num, names)}}}"


def factored(function: RatFunc, variable: str) -> str:
    """The shorter one of the expanded form and the product of irreducible factors over Q."""
    expanded = shown(function, variable)
    above, below = map(over_parameters, function.cleared())
    if not above:
        return expanded
    top, bottom = _factors(above, variable), _factors(below, variable)
    product = "*".join(top).replace("-1*", "-")
    if bottom != ["1"]:
        product += "/" + (bottom[0] if len(bottom) == 1 else f"({'*'.join(bottom)})")
    return min(expanded, product, key=len)


def _factors(polynomial: FunctionPoly, variable: str) -> list[str]:
    """The content, unless it is 1, and the powers of the factors."""
    content, factors = factorisation(polynomial.num)
    parts = []
    for factor, power in factors:
        text = shown(element(polynomial.field, factor), variable)
        base = f"({text})" if " " in text or "-" in text else text
        parts.append(base + (f"^{power}" if power > 1 else ""))
    return parts if content == 1 and parts else [str(content), *parts]


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
