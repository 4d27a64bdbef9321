"""Solutions that are products of powers and exponentials, cosines and sines among them, as text without SymPy.

Such a structure is data (`kovacic.closed_form.structure`); importing SymPy takes longer than all the rest.  The same
expressions as `Solution.solutions` has, ^ for powers.  Over the rational numbers only; other structures need SymPy.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

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
    if isinstance(structure, Diagonal):
        return _diagonal(structure, variable)
    if isinstance(structure, Triangular):
        return _triangular(structure, variable)
    return None


def _diagonal(form: Diagonal, variable: str) -> tuple[str, str] | None:
    """Two products."""
    if not (_is_plain(form.first) and _is_plain(form.second)):
        return None
    return _product(form.first, variable), _product(form.second, variable)


def _triangular(form: Triangular, variable: str) -> tuple[str, str] | None:
    """A product y1, and y1 times the primitive of 1/y1^2, which is left as an integral or is a rational function."""
    if not _is_plain(form.first):
        return None
    first = _product(form.first, variable)
    primitive = form.primitive
    if isinstance(primitive, OpenPrimitive):
        integral = f"Integral({_product(form.bare.to_power(-2), variable)}, {variable})"
        second = integral if first == "1" else f"{first}*{integral}"
        return first, second
    if isinstance(primitive, RationalPrimitive) and not primitive.parts.residues:
        factors = merged(form.first, normalised_constant(primitive.parts.exact))
        return first, _text(factors, form.first.exponential, variable)
    return None


def _is_plain(y: Product) -> bool:
    """Is it over the rational numbers, without other roots?"""
    return y.field == QQ and not y.roots


def _product(y: Product, variable: str, *others: str) -> str:
    """The product as text, with other factors that are text already."""
    return _text(merged(y), y.exponential, variable, *others)


def _text(found: list[Factor], exponential: RatFunc, variable: str, *others: str) -> str:
    """The product of powers, an exponential, and other factors, up to a constant."""
    above: list[str] = []
    below: list[str] = []
    for bases, exponent in grouped(found):
        if all(base.degree <= 0 for base in bases):
            continue
        e = _number(exponent)
        shown = [_primitive(base, around_zero=e.denominator > 1) for base in bases]
        power = _power([_sum(RatFunc(base), variable) for base in shown], abs(e))
        if e > 0:
            above.append(power)
        else:
            below.append(power)
    above += others
    is_constant = exponential.is_polynomial and exponential.num.degree <= 0
    if not is_constant:
        above.append(f"exp({_sum(exponential, variable)})")
    return _quotient(above, below)


def _quotient(above: list[str], below: list[str]) -> str:
    """Factors above and below a line."""
    if not below and len(above) == 1:
        return above[0]
    numerator = "*".join(map(_factor, above)) or "1"
    if not below:
        return numerator
    denominator = "*".join(map(_factor, below))
    if len(below) > 1:
        denominator = f"({denominator})"
    return f"{numerator}/{denominator}"


def _number(constant: Poly) -> Fraction:
    """A rational constant as Python's number."""
    value = constant.field.rational_value(constant)
    assert value is not None
    return value


def _primitive(base: Poly, *, around_zero: bool) -> Poly:
    """A multiple with coprime integer coefficients; under a root real around 0."""
    top, bottom = base.content()
    if around_zero and _is_negative_at_zero(base):
        bottom = -bottom
    return base * Fraction(bottom, top)


def _is_negative_at_zero(base: Poly) -> bool:
    """Is it a x^2 - b with b > 0?"""
    if base.degree != 2 or base[1]:
        return False
    return bool(base.rational_coefficients()[0] < 0)


def _power(bases: list[str], exponent: Fraction) -> str:
    """A power of a product: sqrt(x), x^3, (x + 1)^(2/3)."""
    body = bases[0] if len(bases) == 1 else "*".join(map(_factor, bases))
    if exponent == 1:
        return body
    if exponent == Fraction(1, 2):
        return f"sqrt({body})"
    if not body.isidentifier():
        body = f"({body})"
    power = as_text(exponent)
    if exponent.denominator > 1:
        power = f"({power})"
    return f"{body}^{power}"


def _factor(text: str) -> str:
    """In parentheses, if it is a sum: has a sign or a space outside of parentheses."""
    outside = text
    count = 1
    while count:
        outside, count = re.subn(r"\([^()]*\)", "", outside)
    is_sum = " " in outside or text.startswith("-")
    return f"({text})" if is_sum else text


def _sum(r: RatFunc, variable: str, radical: str = "") -> str:
    """A rational function times a square root: terms of a polynomial, and a proper fraction."""
    polynomial, rest = divmod(r.num, r.den)
    terms = _terms_of(polynomial, variable, radical)
    if rest:
        terms.append(_proper_fraction(rest, r.den, variable, radical))
    if not terms:
        return "0"
    if terms[0].startswith("-") and not terms[-1].startswith("-"):
        terms.reverse()
    return _added(terms)


def _terms_of(polynomial: Poly, variable: str, radical: str) -> list[str]:
    """From the highest power down, each times a square root."""
    terms: list[str] = []
    for k, c in enumerate(polynomial.rational_coefficients()):
        if c:
            number = Fraction(int(c.p), int(c.q))
            terms.append(_term(number, radical=radical, monomial=_monomial(variable, k)))
    return terms[::-1]


def _added(terms: list[str]) -> str:
    """a + b - c."""
    return " + ".join(terms).replace("+ -", "- ")


def _monomial(variable: str, k: int) -> str:
    """x^k, nothing for k = 0."""
    return {0: "", 1: variable}.get(k, f"{variable}^{k}")


def _proper_fraction(above: Poly, below: Poly, variable: str, radical: str) -> str:
    """A number times a quotient of polynomials with coprime integer coefficients, the first one positive."""
    num = _primitive(above, around_zero=False)
    den = _primitive(below, around_zero=False)
    scale = _number(above.lc) / _number(num.lc) * _number(den.lc) / _number(below.lc)
    if _number(num.lc) < 0:
        num = -num
        scale = -scale
    numerator = _sum(RatFunc(num), variable)
    monomial = "" if numerator == "1" else _factor(numerator)
    return _term(scale, radical=radical, monomial=monomial, divisor=_sum(RatFunc(den), variable))


def _term(c: Fraction, *, radical: str, monomial: str, divisor: str = "") -> str:
    """c * radical * monomial / divisor; "" for a factor 1."""
    above = _above(c.numerator, [part for part in (radical, monomial) if part])
    if divisor:
        return f"{above}/{_below(c.denominator, divisor)}"
    if c.denominator == 1:
        return above
    return f"{above}/{digits(c.denominator)}"


def _above(number: int, others: list[str]) -> str:
    """An integer times other factors."""
    sign = "-" if number < 0 else ""
    size = abs(number)
    factors = others if size == 1 else [digits(size), *others]
    return sign + ("*".join(factors) or "1")


def _below(number: int, divisor: str) -> str:
    """A positive integer times a divisor, behind a slash."""
    factor = _factor(divisor)
    if number > 1:
        return f"({digits(number)}*{factor})"
    is_closed = "*" not in factor or factor.startswith("(")
    return factor if is_closed else f"({factor})"


def _conjugate(form: Conjugate, variable: str) -> tuple[str, str] | None:
    """common * (A +- s B) exp(+-s V), s^2 = delta, or real and imaginary part where delta < 0."""
    delta = form.delta.field.rational_value(form.delta)
    if delta is None or form.delta.field != QQ:
        return None
    if form.phase.residues or not _is_plain(form.common):
        return None
    parts = _conjugate_parts(form, abs(delta), variable)
    found = parts.exponentials() if delta > 0 else parts.waves()
    first, second = (_product(form.common, variable, *factors) for factors in found)
    return first, second


def _conjugate_parts(form: Conjugate, size: Fraction, variable: str) -> _ConjugateParts:
    """With |s| = sqrt(size) = scale * radical, and A or B without a common factor."""
    scale, inner = square_part(size)
    radical = "" if inner == 1 else f"sqrt({inner})"
    top, bottom = (form.A or form.B).content()
    number = Fraction(bottom, top)
    return _ConjugateParts(
        A=RatFunc(form.A * number),
        B=RatFunc(form.B * scale * number),
        V=form.phase.exact * scale,
        radical=radical,
        variable=variable,
    )


class _ConjugateParts(NamedTuple):
    """A +- s B and exp(+-s V), with s = radical, or s = i radical for the waves."""

    A: RatFunc
    B: RatFunc
    V: RatFunc
    radical: str
    variable: str

    def exponentials(self) -> Iterator[list[str]]:
        """The factors of (A + s B) exp(s V), and of (A - s B) exp(-s V)."""
        for sign in (1, -1):
            factor = _with(_sum(self.A, self.variable), _sum(self.B * sign, self.variable, self.radical))
            exponential = f"exp({_sum(self.V * sign, self.variable, self.radical)})"
            yield [text for text in (factor, exponential) if text != "1"]

    def waves(self) -> Iterator[list[str]]:
        """The real part A cos(r V) - r B sin(r V), r the radical, and the imaginary part A sin(r V) + r B cos(r V)."""
        B = self.B
        V = self.V
        if _number(V.num.lc) < 0:
            V = -V
            B = -B
        angle = _sum(V, self.variable, self.radical)
        cosine = f"cos({angle})"
        sine = f"sin({angle})"
        yield [_with(_times(self.A, cosine, self.variable), _times(-B, sine, self.variable, self.radical))]
        yield [_with(_times(self.A, sine, self.variable), _times(B, cosine, self.variable, self.radical))]


def _times(r: RatFunc, function: str, variable: str, radical: str = "") -> str:
    """A polynomial times the root times a function."""
    text = _sum(r, variable, radical)
    if text == "0":
        return "0"
    if text == "1":
        return function
    if text == "-1":
        return f"-{function}"
    factor = f"({text})" if " " in text else text
    return f"{factor}*{function}"


def _with(first: str, second: str) -> str:
    """The sum of two terms."""
    return _added([term for term in (first, second) if term != "0"])
