"""How functions of the parameters are written, in the shortest of their usual forms, and statements about them in LaTeX.

A quotient f/g is one of polynomials, a product of irreducible factors, a sum of terms over a monomial
(-n^2 - b^2/(4*n^2)), or a polynomial in one parameter with coefficients in factors (n + k*n*(n - 1)/2).  Everything is text;
among words, formulas are marked by backquotes, from which `latex_of` makes LaTeX.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import square_part
from kovacic.algebra.sparse import by_power, factorisation
from kovacic.numerals import digits
from kovacic.parametric.functions import over_parameters
from kovacic.writing.formula import Math, caret, latex_text

#: Terms up to which a quotient is written as a sum.
_TERMS = 4
#: How much longer a quotient may become so that its denominator is in factors.
_FOR_FACTORS = 4
#: A power of a polynomial in the parameters, flint's.
Power = tuple[Any, int]
#: Around formulas among words.
_MARK = "`"
#: What stands in formulas beside functions, in LaTeX: that something is a natural number, a congruence, Delta_d, signs.
_SIGNS = {
    r"\\mathrm{in} ([ZN])$": r"\\in \\mathbb{\1}",
    r" = (.*) \\mathrm{mod} (.*)$": r" \\equiv \1 \\pmod{\2}",
    r"\\mathrm{Delta}": r"\\Delta",
    r"Z$": r"\\mathbb{Z}",
    r"\+- ?": r"\\pm ",
}


def text_of(said: str) -> str:
    """What is said, without the marks of its formulas."""
    return said.replace(_MARK, "")


def latex_of(said: str) -> str:
    r"""The same in LaTeX.

    >>> print(latex_of("`E = -n^2 - b^2/(4*n^2)` for an integer `n`"))
    E = -n^{2} - \frac{b^{2}}{4 n^{2}}\text{ for an integer } n
    """
    return "".join(part.latex if isinstance(part, Math) else rf"\text{{{part}}} " for part in sentence_of(said)).strip()


def sentence_of(said: str) -> list[str | Math]:
    """The same as the parts of a sentence, words and formulas."""
    pieces = enumerate(said.split(_MARK))
    return [Math(piece, _formula(piece)) if k % 2 else piece for k, piece in pieces if piece]


def _formula(text: str) -> str:
    latex = latex_text(text)
    for pattern, replacement in _SIGNS.items():
        latex = re.sub(pattern, replacement, latex)
    return latex


def shown(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers, as a quotient of expanded polynomials."""
    return caret(function.to_str(variable))


def shifted(text: str, value: Poly) -> str:
    """`text - value`: x - 2, x + 1/2, x - (a + b)."""
    if not value:
        return text
    amount = shown(over_parameters(value))
    if not re.fullmatch(r"-?[\w/*^]+(\([\w*^]+\))?", amount):
        return f"{text} - ({amount})"
    return f"{text} + {amount[1:]}" if amount.startswith("-") else f"{text} - {amount}"


def shortest_length(function: FunctionPoly | RatFunc, letter: str = "x") -> int:
    """How many characters the shortest of the usual forms has."""
    above, below, names = _cleared(function, letter)
    return min(len(_sum(form, names)) for form in _forms(above, below))


def written(function: FunctionPoly | RatFunc, letter: str = "x") -> str:
    """The shortest of the usual forms, with its denominator in factors; `letter` is the name of the polynomial variable."""
    above, below, names = _cleared(function, letter)
    forms = [*_forms(above, below)]
    in_factors = _sum(forms[-1], names)
    shortest = min((_sum(form, names) for form in forms), key=len)
    is_expanded = re.search(r"/\([^()]* [+-] [^()]*\)", shortest) is not None
    return in_factors if is_expanded and len(in_factors) <= len(shortest) + _FOR_FACTORS else shortest


def partial_fractions(S: RatFunc, variable: str) -> str:
    """S, not zero, as a polynomial in the variable and fractions with powers of the irreducible factors of its denominator."""
    whole, rest = divmod(S.num, S.den)
    terms = [_monomial(whole[k], variable, k) for k in range(whole.degree, -1, -1) if whole[k]]
    for factor, k in S.field.factor(S.den):
        power = factor**k
        above = rest * (S.den // power).inverse_modulo(power) % power
        digits_from_below = []
        for _ in range(k):
            above, digit = divmod(above, factor)
            digits_from_below.append(digit)
        for j, digit in enumerate(reversed(digits_from_below), 1):
            if digit:
                terms.append(_in_factors(RatFunc(digit, factor**j), variable))
    return _joined(terms)


def _monomial(coefficient: Poly, variable: str, k: int) -> str:
    text = written(over_parameters(coefficient))
    if k == 0:
        return text
    power = variable if k == 1 else f"{variable}^{k}"
    if text in ("1", "-1"):
        return text[:-1] + power
    number = re.fullmatch(r"(-?)(\d+)/(\d+)", text)
    if number is not None:
        sign, above, below = number.groups()
        return f"{sign}{above}*{power}/{below}" if above != "1" else f"{sign}{power}/{below}"
    return f"({text})*{power}" if " " in text else f"{text}*{power}"


def _in_factors(function: RatFunc, variable: str) -> str:
    above, below, names = _cleared(function, variable)
    return _sum([_factored(above, below)], names)


def equation_written(function: FunctionPoly) -> str:
    """`function = 0`; it is solved where it is linear, or a power is a product of linear factors; two terms have two sides."""
    above, _, names = _cleared(function, "x")
    terms = above.to_dict()
    linear = [exponents for exponents in terms if sum(map(int, exponents)) == 1]
    constants = [exponents for exponents in terms if not any(exponents)]
    if linear and len(terms) == len(linear) + len(constants):
        return _solved_for_a_parameter(above, linear, names)
    if len(terms) > 2:
        power = _power_in_linear_factors(above)
        if power is not None:
            left, value = power
            return f"{_polynomial(left, names)} = {_sum([value], names)}"
    negative = {exponents: -int(c) for exponents, c in terms.items() if int(c) < 0}
    if len(terms) == 2 and len(negative) == 1:
        right = above.context().from_dict(negative)
        return f"{_polynomial(above + right, names)} = {_polynomial(right, names)}"
    return f"{_polynomial(above, names)} = 0"


def _solved_for_a_parameter(above: Any, linear: Sequence[tuple[int, ...]], names: Sequence[str]) -> str:
    """A linear equation, solved for the first parameter with the coefficient 1 or -1, or for the first."""
    terms = above.to_dict()
    chosen = next((exponents for exponents in linear if abs(int(terms[exponents])) == 1), linear[0])
    coefficient = int(terms[chosen])
    left = above.context().from_dict({chosen: 1})
    values = _forms(left * coefficient - above, above.context().constant(coefficient))
    right = min((_sum(form, names) for form in values), key=len)
    return f"{_polynomial(left, names)} = {right}"


def _power_in_linear_factors(polynomial: Any) -> tuple[Any, _FormulaTerm] | None:
    """`(t^k, f)` where the polynomial vanishes exactly where t^k = f, and f is a product of linear forms; None if none is."""
    for i, degree in enumerate(map(int, polynomial.degrees())):
        if not degree:
            continue
        parts = by_power(polynomial, i)
        if parts.keys() != {0, degree} or not parts[degree].is_constant():
            continue
        value = _factored(-parts[0], parts[degree])
        if all(factor.total_degree() == 1 for factor, _ in value.top):
            return polynomial.context().gen(i) ** degree, value
    return None


def root_written(square: Poly) -> str:
    """The square root of an element of Q(t), up to its sign; squares are taken out: (4*a*c - b^2)/(4*a*sqrt(a))."""
    if not square:
        return "0"
    above, below, names = _cleared(over_parameters(square), "x")
    (number, top, odd), (other, bottom, under) = _without_squares(above), _without_squares(below)
    if int(odd.leading_coefficient()) < 0 and not under.is_constant():
        odd = -odd
        under = -under
    return _sum([_FormulaTerm(Fraction(number, other), top, bottom, odd, under)], names)


def _cleared(function: FunctionPoly | RatFunc, letter: str) -> tuple[Any, Any, tuple[str, ...]]:
    """Numerator and denominator over Z, and the names of their variables."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = map(over_parameters, quotient.cleared())
    return above.num, below.num, (letter, *above.field.names)


@dataclass(frozen=True)
class _FormulaTerm:
    """A number times powers of polynomials over others, times sqrt(root)/sqrt(under)."""

    number: Fraction
    top: tuple[Power, ...] = ()
    bottom: tuple[Power, ...] = ()
    root: Any = 1
    under: Any = 1


def _forms(above: Any, below: Any) -> Iterator[list[_FormulaTerm]]:
    """Sums of terms that are equal to the quotient of two polynomials over Z."""
    whole = [_FormulaTerm(Fraction(1), ((above, 1),), ((below, 1),))]
    is_number = below.is_constant()
    most = 2 if is_number else _TERMS
    apart: list[list[_FormulaTerm]] = []
    if len(below) == 1 and 1 < len(above) <= most:
        terms = above.to_dict().items()
        apart = [[_factored(above.context().from_dict({e: c}), below) for e, c in terms]]
    yield from [whole, *apart] if is_number else [*apart, whole]
    if not above:
        return
    for i, degree in enumerate(map(int, above.degrees())):
        parts = by_power(above, i)
        if i and degree and len(parts) == 2:
            generator = above.context().gen(i)
            yield [_factored(part * generator**power, below) for power, part in sorted(parts.items())]
    yield [_factored(above, below)]


def _factored(above: Any, below: Any) -> _FormulaTerm:
    """The quotient of two polynomials, the first one not zero, in irreducible factors."""
    common = above.gcd(below)
    (number, top), (other, bottom) = factorisation(above // common), factorisation(below // common)
    return _FormulaTerm(Fraction(number, other), tuple(top), tuple(bottom))


def _without_squares(polynomial: Any) -> tuple[int, tuple[Power, ...], Any]:
    """`(a, factors, r)` with polynomial = (a prod factors)^2 r, r squarefree."""
    content, factors = factorisation(polynomial)
    number, squarefree = square_part(Fraction(content))
    odd = prod((factor for factor, k in factors if k % 2), start=polynomial.context().constant(squarefree))
    return int(number), tuple((factor, k // 2) for factor, k in factors if k > 1), odd


def _sum(terms: Sequence[_FormulaTerm], names: Sequence[str]) -> str:
    return _joined(_term(term, names) for term in terms) or "0"


def _joined(terms: Iterable[str]) -> str:
    return " + ".join(terms).replace("+ -", "- ")


def _polynomial(polynomial: Any, names: Sequence[str]) -> str:
    """The expanded polynomial, in the order of its terms; the variable stands behind the parameters."""
    text = re.sub(
        r"\b(x(?:\^\d+)?)((?:\*t\d+(?:\^\d+)?)+)", lambda match: f"{match[2][1:]}*{match[1]}", str(polynomial)
    )
    return re.sub(r"x|t(\d+)", lambda match: names[1 + int(match[1] or -1)], text)


def _term(term: _FormulaTerm, names: Sequence[str]) -> str:
    top = _pieces(abs(term.number.numerator), term.top, term.root, names)
    bottom = _pieces(term.number.denominator, term.bottom, term.under, names)
    sign = "-" if term.number < 0 else ""
    above = "*".join(top) or "1"
    if bottom:
        return f"{sign}{above}/{_divisor(bottom)}"
    if sign or len(top) != 1:
        return sign + above
    is_sum = above.startswith("(") and above.endswith(")")
    return above[1:-1] if is_sum else above


def _divisor(factors: list[str]) -> str:
    """A product behind a slash: in parentheses, unless it is a single name, number, power or sum in parentheses."""
    alone = len(factors) == 1 and ("*" not in factors[0] or factors[0].startswith(("(", "sqrt(")))
    return factors[0] if alone else f"({'*'.join(factors)})"


def _pieces(number: int, factors: tuple[Power, ...], root: Any, names: Sequence[str]) -> list[str]:
    """The factors of a product, none for 1; sums are in parentheses."""
    pieces = [digits(number)] if number != 1 else []
    for factor, k in factors:
        if not (factor.is_constant() and factor.is_one()):
            pieces.append(_power(_polynomial(factor, names), k))
    if root != 1:
        inside = _polynomial(root, names)
        pieces.append("I" if inside == "-1" else f"sqrt({inside})")
    return pieces


def in_product(text: str) -> str:
    """A factor of a product: sums and what begins with a minus in parentheses."""
    is_sum = " + " in text or " - " in text or text.startswith("-")
    return f"({text})" if is_sum else text


def _power(text: str, k: int) -> str:
    """The k-th power, with parentheses where they are needed in a product."""
    text = f"({text})" if k > 1 and "*" in text else in_product(text)
    return text if k == 1 else f"{text}^{k}"
