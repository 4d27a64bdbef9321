"""How functions of the parameters are written: plain and in LaTeX, each in the shortest of its usual forms.

A quotient f/g is one of polynomials, a product of irreducible factors, a sum of terms over a monomial
(-n^2 - b^2/(4*n^2)), or a polynomial in one parameter with coefficients in factors (n + k*n*(n - 1)/2).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
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
from kovacic.views.formula import symbol

#: Terms up to which a quotient is written as a sum.
_TERMS = 4
#: A power of a polynomial in the parameters, flint's.
Power = tuple[Any, int]


def shown(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers, as a quotient of expanded polynomials."""
    return function.to_str(variable).replace("**", "^")


def shifted(text: str, value: Poly) -> str:
    """`text - value`: x - 2, x + 1/2, x - (a + b)."""
    amount = shown(over_parameters(value))
    if not re.fullmatch(r"-?[\w/]+", amount):
        return f"{text} - ({amount})"
    return text if not value else f"{text} + {amount[1:]}" if amount.startswith("-") else f"{text} - {amount}"


def written(function: FunctionPoly | RatFunc, letter: str = "x", *, latex: bool = False) -> str:
    """The shortest of the usual forms; `letter` is the name of the polynomial variable."""
    above, below, names = _cleared(function, letter)
    plain = _Writer(names, False)
    best = min(_forms(above, below), key=lambda form: len(plain.sum(form)))
    return _Writer(names, True).sum(best) if latex else plain.sum(best)


def equation_written(function: FunctionPoly, *, latex: bool = False) -> str:
    """`function = 0`; a linear form is solved for a parameter, and two terms stand on two sides."""
    above, _, names = _cleared(function, "x")
    writer, terms = _Writer(names, latex), above.to_dict()
    linear = {next(i for i, k in enumerate(e) if k): e for e in terms if sum(map(int, e)) == 1}
    if linear and len(terms) - len(linear) == sum(1 for e in terms if not any(e)):
        i = next((i for i, e in linear.items() if abs(int(terms[e])) == 1), next(iter(linear)))
        rest = above - above.context().gen(i) * int(terms[linear[i]])
        value = _forms(-rest, above.context().constant(int(terms[linear[i]])))
        return f"{symbol(names[i]) if latex else names[i]} = {writer.sum(min(value, key=lambda form: len(writer.sum(form))))}"
    if len(terms) == 2 and sum(1 for c in terms.values() if int(c) < 0) == 1:
        first, second = sorted(terms.items(), key=lambda term: int(term[1]) < 0)
        sides = [above.context().from_dict({e: abs(int(c))}) for e, c in (first, second)]
        return f"{writer.polynomial(sides[0])} = {writer.polynomial(sides[1])}"
    return f"{writer.polynomial(above)} = 0"


def root_written(square: Poly, *, latex: bool = False) -> str:
    """The square root of an element of Q(t), up to its sign; squares are taken out: (4*a*c - b^2)/(4*a*sqrt(a))."""
    if not square:
        return "0"
    above, below, names = _cleared(over_parameters(square), "x")
    (number, top, odd), (other, bottom, under) = _without_squares(above), _without_squares(below)
    if int(odd.leading_coefficient()) < 0 and not under.is_constant():
        odd, under = -odd, -under
    term = _Term(Fraction(number, other), top, bottom, odd, under)
    return _Writer(names, latex).sum([term])


def _cleared(function: FunctionPoly | RatFunc, letter: str) -> tuple[Any, Any, tuple[str, ...]]:
    """Numerator and denominator over Z, and the names of their variables."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = map(over_parameters, quotient.cleared())
    return above.num, below.num, (letter, *above.field.names)


@dataclass(frozen=True)
class Notation:
    """Text or LaTeX; `letter` is what an integer is called, the `fixed` parameters are those that nothing is solved for."""

    latex: bool = False
    letter: str = "x"
    fixed: tuple[str, ...] = ()

    @property
    def comma(self) -> str:
        return r",\ " if self.latex else ", "

    def function(self, function: Poly | RatFunc) -> str:
        """The shortest form of a function of the parameters and the integer."""
        known = function if isinstance(function, RatFunc) else over_parameters(function)
        return written(known, self.letter, latex=self.latex)

    def name(self, name: str) -> str:
        return symbol(name) if self.latex else name

    def words(self, text: str) -> str:
        return " " * text.startswith(" ") + rf"\text{{{text}}}" + " " * text.endswith(" ") if self.latex else text

    def member(self, numbers: str) -> str:
        """That what stands before is an integer (Z), or a natural number (N)."""
        return rf" \in \mathbb{{{numbers}}}" if self.latex else f" in {numbers}"

    def alternatives(self, texts: Sequence[str]) -> str:
        return self.words(" or ").join(texts)


@dataclass(frozen=True)
class _Term:
    """A number times powers of polynomials over others, times sqrt(root)/sqrt(under)."""

    number: Fraction
    top: tuple[Power, ...] = ()
    bottom: tuple[Power, ...] = ()
    root: Any = 1
    under: Any = 1


def _forms(above: Any, below: Any) -> Iterator[list[_Term]]:
    """Sums of terms that are equal to the quotient of two polynomials over Z; the first of equally short ones is taken."""
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


@dataclass(frozen=True)
class _Writer:
    """Terms as text or LaTeX."""

    names: Sequence[str]
    latex: bool

    def sum(self, terms: Sequence[_Term]) -> str:
        text = " + ".join(map(self._term, terms))
        return text.replace("+ -", "- ") or "0"

    def polynomial(self, polynomial: Any) -> str:
        """The expanded polynomial, in the order of its terms."""
        times, names = (" ", [symbol(n) for n in self.names]) if self.latex else ("*", self.names)
        terms: list[str] = []
        for exponents, coefficient in polynomial.to_dict().items():
            powers = [self._power(name, int(e)) for name, e in zip(names, exponents, strict=True) if e]
            value = int(coefficient)
            digits = [] if powers and abs(value) == 1 else [str(abs(value))]
            terms.append(("-" if value < 0 else "") + times.join([*digits, *powers]))
        return " + ".join(terms).replace("+ -", "- ") or "0"

    def _power(self, base: str, exponent: int) -> str:
        if exponent == 1:
            return base
        return f"{base}^{{{exponent}}}" if self.latex else f"{base}^{exponent}"

    def _term(self, term: _Term) -> str:
        top = self._pieces(abs(term.number.numerator), term.top, term.root)
        bottom = self._pieces(term.number.denominator, term.bottom, term.under)
        sign = "-" if term.number < 0 else ""
        alone = len(top) == 1 and not sign and (self.latex or not bottom)
        above = self._product(top, bare=alone or (self.latex and bool(bottom)))
        if not bottom:
            return sign + above
        if self.latex:
            return rf"{sign}\frac{{{above}}}{{{self._product(bottom, bare=True)}}}"
        below = self._product(bottom, bare=False)
        return f"{sign}{above}/{f'({below})' if '*' in re.sub(r'[(].*[)]', '', below) else below}"

    def _pieces(self, number: int, factors: tuple[Power, ...], root: Any) -> list[tuple[str, int]]:
        """The factors with their exponents; none for 1."""
        pieces = [(str(number), 1)] if number != 1 else []
        pieces += [(self.polynomial(f), k) for f, k in factors if not (f.is_constant() and f.is_one())]
        if root != 1:
            radicand = self.polynomial(root)
            if radicand == "-1":
                return [*pieces, (symbol("I") if self.latex else "I", 1)]
            pieces.append((rf"\sqrt{{{radicand}}}" if self.latex else f"sqrt({radicand})", 1))
        return pieces

    def _product(self, pieces: Sequence[tuple[str, int]], *, bare: bool) -> str:
        """A product; a single factor that is a sum is in parentheses unless it is `bare`."""
        if not pieces:
            return "1"
        if bare and len(pieces) == 1 and pieces[0][1] == 1:
            return pieces[0][0]
        texts = []
        for text, k in pieces:
            single = "sqrt" in text[:5] or not (
                " + " in text or " - " in text or text.startswith("-") or ("*" in text and k > 1)
            )
            base = text if single else rf"\left({text}\right)" if self.latex else f"({text})"
            texts.append(self._power(base, k))
        return (" " if self.latex else "*").join(texts)
