"""Solutions that are products of powers and exponentials, cosines and sines among them, as text without SymPy.

Such a structure is data (`kovacic.closed_form.structure`); importing SymPy takes longer than all the rest.  The same
expressions as `Solution.solutions` has, ^ for powers.  Over the rational numbers only; other structures need SymPy.
"""

from __future__ import annotations

import re
from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, square_part
from kovacic.closed_form.primitive import OpenPrimitive, RationalPrimitive, normalised_constant
from kovacic.closed_form.product import Factor, Product, grouped, merged
from kovacic.closed_form.structure import ClosedStructure, Conjugate, Diagonal, Triangular
from kovacic.numerals import as_text, digits


def written(structure: ClosedStructure, variable: str) -> tuple[str, str] | None:
    """y1 and y2, up to constant factors; None for a structure that is none of these.

    >>> import kovacic
    >>> from kovacic.closed_form.structure import build
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - 9/4)*y = 0")
    >>> written(build(answer.S, answer.decision, answer.gauge), "x")
    ('(x*cos(x) - sin(x))/x^(3/2)', '(x*sin(x) + cos(x))/x^(3/2)')
    """
    if isinstance(structure, Conjugate):
        return _conjugate(structure, variable)
    if not isinstance(structure, Diagonal | Triangular) or not _is_plain(structure.first):
        return None
    first = _product(structure.first, variable)
    if isinstance(structure, Diagonal):
        return (first, _product(structure.second, variable)) if _is_plain(structure.second) else None
    primitive = structure.primitive
    if isinstance(primitive, OpenPrimitive):
        integral = f"Integral({_product(structure.bare.to_power(-2), variable)}, {variable})"
        return first, integral if first == "1" else f"{first}*{integral}"
    if isinstance(primitive, RationalPrimitive) and not primitive.parts.residues:
        factors = merged(structure.first, normalised_constant(primitive.parts.exact))
        return first, _text(factors, structure.first.exponential, variable)
    return None


def _is_plain(y: Product) -> bool:
    return y.field == QQ and not y.roots


def _product(y: Product, variable: str, *others: str) -> str:
    return _text(merged(y), y.exponential, variable, *others)


def _text(found: list[Factor], exponential: RatFunc, variable: str, *others: str) -> str:
    """The product of powers, an exponential, and other factors, up to a constant."""
    above: list[str] = []
    below: list[str] = []
    for bases, exponent in grouped(found):
        e = _number(exponent)
        if all(base.degree <= 0 for base in bases):
            continue
        shown = [_primitive(base, around_zero=e.denominator > 1) for base in bases]
        (above if e > 0 else below).append(_power([_sum(RatFunc(base), variable) for base in shown], abs(e)))
    above += others
    if exponential.num.degree > 0 or not exponential.is_polynomial:
        above.append(f"exp({_sum(exponential, variable)})")
    if not below:
        return above[0] if len(above) == 1 else "*".join(map(_factor, above)) or "1"
    denominator = _factor(below[0]) if len(below) == 1 else f"({'*'.join(map(_factor, below))})"
    return f"{'*'.join(map(_factor, above)) or '1'}/{denominator}"


def _number(constant: Poly) -> Fraction:
    value = constant.field.rational_value(constant)
    assert value is not None
    return value


def _primitive(base: Poly, *, around_zero: bool) -> Poly:
    """A multiple with coprime integer coefficients; under a root real around 0."""
    top, bottom = base.content()
    imaginary = around_zero and base.degree == 2 and not base[1] and base.rational_coefficients()[0] < 0
    return base * Fraction(-bottom if imaginary else bottom, top)


def _power(bases: list[str], exponent: Fraction) -> str:
    body = bases[0] if len(bases) == 1 else "*".join(map(_factor, bases))
    if exponent == 1:
        return body
    if exponent == Fraction(1, 2):
        return f"sqrt({body})"
    inner = body if body.isidentifier() else f"({body})"
    power = as_text(exponent)
    return f"{inner}^{power}" if exponent.denominator == 1 else f"{inner}^({power})"


def _factor(text: str) -> str:
    """In parentheses, if it is a sum: has a sign or a space outside of parentheses."""
    inner = text
    count = 1
    while count:
        inner, count = re.subn(r"\([^()]*\)", "", inner)
    return f"({text})" if " " in inner or text.startswith("-") else text


def _sum(r: RatFunc, variable: str, radical: str = "") -> str:
    """A rational function times a square root: terms of a polynomial, and a proper fraction."""
    polynomial, rest = divmod(r.num, r.den)
    terms = [
        _term(Fraction(int(c.p), int(c.q)), radical, {0: "", 1: variable}.get(k, f"{variable}^{k}"))
        for k, c in reversed(list(enumerate(polynomial.rational_coefficients())))
        if c
    ]
    if rest:
        num, den = (_primitive(p, around_zero=False) for p in (rest, r.den))
        scale = _number(rest.lc) / _number(num.lc) * _number(den.lc) / _number(r.den.lc)
        sign = -1 if _number(num.lc) < 0 else 1
        numerator = _sum(RatFunc(num * sign), variable)
        divisor = _sum(RatFunc(den), variable)
        terms.append(_term(scale * sign, radical, "" if numerator == "1" else _factor(numerator), divisor))
    if terms and terms[0].startswith("-") and not terms[-1].startswith("-"):
        terms.reverse()
    return " + ".join(terms).replace("+ -", "- ") or "0"


def _term(c: Fraction, radical: str, monomial: str, divisor: str = "") -> str:
    """c * radical * monomial / divisor."""
    size = "" if abs(c.numerator) == 1 else digits(abs(c.numerator))
    above = "*".join(part for part in (size, radical, monomial) if part) or "1"
    factors = [digits(c.denominator)] if c.denominator > 1 else []
    if divisor:
        factors.append(_factor(divisor))
    below = factors[0] if len(factors) == 1 else f"({'*'.join(factors)})"
    if divisor and len(factors) == 1 and "*" in below and not below.startswith("("):
        below = f"({below})"
    return ("-" if c < 0 else "") + (f"{above}/{below}" if factors else above)


def _conjugate(form: Conjugate, variable: str) -> tuple[str, str] | None:
    """common * (A +- s B) exp(+-s V), s^2 = delta, or real and imaginary part where delta < 0."""
    delta = form.delta.field.rational_value(form.delta)
    if delta is None or form.delta.field != QQ or form.phase.residues or not _is_plain(form.common):
        return None
    scale, inner = square_part(abs(delta))
    radical = "" if inner == 1 else f"sqrt({inner})"  # |s| = scale * radical
    V = form.phase.exact * scale
    top, bottom = (form.A or form.B).content()
    A, B = (RatFunc(p * Fraction(bottom, top)) for p in (form.A, form.B * scale))
    if delta > 0:
        pair = [_with(_sum(A, variable), _sum(B * sign, variable, radical)) for sign in (1, -1)]
        exponentials = [f"exp({_sum(V * sign, variable, radical)})" for sign in (1, -1)]
        first, second = (
            _product(form.common, variable, *(text for text in both if text != "1"))
            for both in zip(pair, exponentials, strict=True)
        )
        return first, second
    if next(c for c in V.num.rational_coefficients()[::-1] if c) < 0:
        V = -V
        B = -B
    angle = _sum(V, variable, radical)
    first, second = (
        _with(_times(A, f, variable), _times(B * sign, g, variable, radical))
        for f, g, sign in ((f"cos({angle})", f"sin({angle})", -1), (f"sin({angle})", f"cos({angle})", 1))
    )
    return _product(form.common, variable, first), _product(form.common, variable, second)


def _times(r: RatFunc, function: str, variable: str, radical: str = "") -> str:
    """A polynomial times the root times a function."""
    text = _sum(r, variable, radical)
    factor = f"({text})" if " " in text else text
    return {"0": "0", "1": function, "-1": f"-{function}"}.get(text, f"{factor}*{function}")


def _with(first: str, second: str) -> str:
    """The sum of two terms."""
    terms = [term for term in (first, second) if term != "0"]
    return " + ".join(terms).replace("+ -", "- ")
