"""How functions of the parameters are written, for reading and in LaTeX: in the shortest of their usual forms.

A quotient f/g is one of polynomials, a product of irreducible factors, a sum of terms over a monomial
(-n^2 - b^2/(4*n^2)), or a polynomial in one parameter with coefficients in factors (n + k*n*(n - 1)/2).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import square_part
from kovacic.algebra.sparse import by_power, factorisation
from kovacic.parametric.functions import over_parameters
from kovacic.views.formula import Math, caret, latex_text, symbol

#: Terms up to which a quotient is written as a sum.
_TERMS = 4
#: A power of a polynomial in the parameters, flint's.
Power = tuple[Any, int]


def said(*parts: Math | str) -> Math:
    """The parts in a row; plain strings are words."""
    known = [part if isinstance(part, Math) else words(part) for part in parts if part]
    return Math("".join(part.text for part in known), "".join(part.latex for part in known))


def words(text: str) -> Math:
    return Math(text, " " * text.startswith(" ") + rf"\text{{{text}}}" + " " * text.endswith(" "))


def plain(text: str) -> Math:
    """What is written in the same way in LaTeX."""
    return Math(text, text)


def joined(parts: Sequence[Math], between: Math | str = " or ") -> Math:
    """The parts with something between them."""
    return said(*[piece for part in parts for piece in (between, part)][1:])


def unless_long(first: Math, second: Math, most: Callable[[str], int]) -> Math:
    """Text and LaTeX of the first, where it has at most so many characters for the second, else of the second."""
    pairs = (first.text, second.text), (first.latex, second.latex)
    return Math(*(a if len(a) <= most(b) else b for a, b in pairs))


def member(numbers: str) -> Math:
    """That what stands before is an integer (Z), or a natural number (N)."""
    return Math(f" in {numbers}", rf" \in \mathbb{{{numbers}}}")


def name_written(name: str) -> Math:
    return Math(name, symbol(name))


def shown(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers, as a quotient of expanded polynomials."""
    return caret(function.to_str(variable))


def shifted(text: str, value: Poly) -> str:
    """`text - value`: x - 2, x + 1/2, x - (a + b)."""
    amount = shown(over_parameters(value))
    if not re.fullmatch(r"-?[\w/]+", amount):
        return f"{text} - ({amount})"
    return text if not value else f"{text} + {amount[1:]}" if amount.startswith("-") else f"{text} - {amount}"


def written(function: FunctionPoly | RatFunc, letter: str = "x") -> Math:
    """The shortest of the usual forms; `letter` is the name of the polynomial variable."""
    above, below, names = _cleared(function, letter)
    return min((_sum(form, names) for form in _forms(above, below)), key=lambda form: len(form.text))


def equation_written(function: FunctionPoly) -> Math:
    """`function = 0`; a linear form is solved for a parameter, and two terms stand on two sides."""
    above, _, names = _cleared(function, "x")
    terms, context, left, right = above.to_dict(), above.context(), above, plain("0")
    linear = {next(i for i, k in enumerate(e) if k): e for e in terms if sum(map(int, e)) == 1}
    if linear and len(terms) - len(linear) == sum(1 for e in terms if not any(e)):
        i = next((i for i, e in linear.items() if abs(int(terms[e])) == 1), next(iter(linear)))
        left, coefficient = context.gen(i), int(terms[linear[i]])
        values = [_sum(form, names) for form in _forms(left * coefficient - above, context.constant(coefficient))]
        right = Math(min((m.text for m in values), key=len), min((m.latex for m in values), key=len))
    elif len(terms) == 2 and sum(1 for c in terms.values() if int(c) < 0) == 1:
        left, other = (
            context.from_dict({e: abs(int(c))}) for e, c in sorted(terms.items(), key=lambda t: int(t[1]) < 0)
        )
        right = _polynomial(other, names)
    return said(_polynomial(left, names), plain(" = "), right)


def root_written(square: Poly) -> Math:
    """The square root of an element of Q(t), up to its sign; squares are taken out: (4*a*c - b^2)/(4*a*sqrt(a))."""
    if not square:
        return plain("0")
    above, below, names = _cleared(over_parameters(square), "x")
    (number, top, odd), (other, bottom, under) = _without_squares(above), _without_squares(below)
    if int(odd.leading_coefficient()) < 0 and not under.is_constant():
        odd, under = -odd, -under
    return _sum([_Term(Fraction(number, other), top, bottom, odd, under)], names)


def _cleared(function: FunctionPoly | RatFunc, letter: str) -> tuple[Any, Any, tuple[str, ...]]:
    """Numerator and denominator over Z, and the names of their variables."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = map(over_parameters, quotient.cleared())
    return above.num, below.num, (letter, *above.field.names)


@dataclass(frozen=True)
class _Term:
    """A number times powers of polynomials over others, times sqrt(root)/sqrt(under)."""

    number: Fraction
    top: tuple[Power, ...] = ()
    bottom: tuple[Power, ...] = ()
    root: Any = 1
    under: Any = 1


def _forms(above: Any, below: Any) -> Iterator[list[_Term]]:
    """Sums of terms that are equal to the quotient of two polynomials over Z."""
    forms = [[_Term(Fraction(1), ((above, 1),), ((below, 1),))]]
    if len(below) == 1 and 1 < len(above) <= (2 if below.is_constant() else _TERMS):
        forms.append([_factored(above.context().from_dict({e: c}), below) for e, c in above.to_dict().items()])
    yield from forms if below.is_constant() else reversed(forms)
    if not above:
        return
    for i, degree in enumerate(map(int, above.degrees())):
        parts = by_power(above, i)
        if i and degree and len(parts) == 2:
            generator = above.context().gen(i)
            yield [_factored(part * generator**power, below) for power, part in sorted(parts.items())]
    yield [_factored(above, below)]


def _factored(above: Any, below: Any) -> _Term:
    """The quotient of two polynomials, the first one not zero, in irreducible factors."""
    common = above.gcd(below)
    (number, top), (other, bottom) = factorisation(above // common), factorisation(below // common)
    return _Term(Fraction(number, other), tuple(top), tuple(bottom))


def _without_squares(polynomial: Any) -> tuple[int, tuple[Power, ...], Any]:
    """`(a, factors, r)` with polynomial = (a prod factors)^2 r, r squarefree."""
    content, factors = factorisation(polynomial)
    number, squarefree = square_part(Fraction(content))
    odd = prod((factor for factor, k in factors if k % 2), start=polynomial.context().constant(squarefree))
    return int(number), tuple((factor, k // 2) for factor, k in factors if k > 1), odd


def _sum(terms: Sequence[_Term], names: Sequence[str]) -> Math:
    known = [_term(term, names) for term in terms]
    text, latex = (
        " + ".join(parts).replace("+ -", "- ") for parts in ([m.text for m in known], [m.latex for m in known])
    )
    return Math(text or "0", latex or "0")


def _polynomial(polynomial: Any, names: Sequence[str]) -> Math:
    """The expanded polynomial, in the order of its terms."""
    text = re.sub(r"x|t(\d+)", lambda match: names[1 + int(match[1] or -1)], str(polynomial))
    return Math(text, latex_text(text.replace("^", "**")))


def _term(term: _Term, names: Sequence[str]) -> Math:
    top = _pieces(abs(term.number.numerator), term.top, term.root, names)
    bottom = _pieces(term.number.denominator, term.bottom, term.under, names)
    sign = "-" if term.number < 0 else ""
    if not bottom:
        return said(plain(sign), _product(top, bare=not sign))
    below = _product(bottom).text
    text = f"{sign}{_product(top).text}/{f'({below})' if '*' in re.sub(r'[(].*[)]', '', below) else below}"
    return Math(text, rf"{sign}\frac{{{_product(top, bare=True).latex}}}{{{_product(bottom, bare=True).latex}}}")


def _pieces(number: int, factors: tuple[Power, ...], root: Any, names: Sequence[str]) -> list[tuple[Math, Math]]:
    """The factors, none for 1, as they are written alone and in a product."""
    pieces = [(plain(str(number)),) * 2] if number != 1 else []
    for factor, k in factors:
        if not (factor.is_constant() and factor.is_one()):
            alone = inside = _polynomial(factor, names)
            text = alone.text
            if " + " in text or " - " in text or text.startswith("-") or ("*" in text and k > 1):
                inside = Math(f"({text})", rf"\left({alone.latex}\right)")
            power = Math(f"{inside.text}^{k}", f"{inside.latex}^{{{k}}}")
            pieces.append((alone, inside) if k == 1 else (power, power))
    if root != 1:
        inside = _polynomial(root, names)
        radical = Math(f"sqrt({inside.text})", rf"\sqrt{{{inside.latex}}}")
        pieces.append((name_written("I") if inside.text == "-1" else radical,) * 2)
    return pieces


def _product(pieces: Sequence[tuple[Math, Math]], *, bare: bool = False) -> Math:
    """A product; a single factor that is a sum is in parentheses unless it is `bare`."""
    if bare and len(pieces) == 1:
        return pieces[0][0]
    return Math("*".join(m.text for _, m in pieces) or "1", " ".join(m.latex for _, m in pieces) or "1")
