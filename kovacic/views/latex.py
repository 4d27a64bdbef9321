"""Polynomials and rational functions in LaTeX, from the exact data and without SymPy."""

from __future__ import annotations

import re
from math import gcd

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc

_GREEK = frozenset(
    {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu"}
    | {"nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"}
)
_SQRT = re.compile(r"sqrt\(([^()]*)\)")
_CBRT = re.compile(r"cbrt\(([^()]*)\)")
_ROOT = re.compile(r"root\(([^(),]*), (\d+)\)")
_POWER = re.compile(r"\*\*(\d+)")
_INDEX = re.compile(r"\b([A-Za-z])_?(\d+)\b")


def latex_text(text: str) -> str:
    """An expression in Python syntax without quotients: powers, products, square roots, Greek names."""
    text = _SQRT.sub(r"\\sqrt{\1}", text)
    text = _CBRT.sub(r"\\sqrt[3]{\1}", text)
    text = _ROOT.sub(r"\\sqrt[\2]{\1}", text)
    text = _POWER.sub(r"^{\1}", text)
    text = _INDEX.sub(r"\1_{\2}", text)
    for name in _GREEK:
        text = re.sub(rf"(?<![A-Za-z\\]){name}(?![A-Za-z])", rf"\\{name}", text)
    return text.replace("*", " ")


def latex_poly(polynomial: Poly, variable: str = "x") -> str:
    """A polynomial.

    >>> from kovacic.algebra.rationals import QQ
    >>> latex_poly(QQ.poly([1, 0, -3]))
    '-3 x^{2} + 1'
    """
    return latex_ratfunc(RatFunc(polynomial), variable)


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
