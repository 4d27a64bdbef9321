"""Signs of expressions in the parameters: proven, refuted, or not known.

A parameter with a bound, l >= 1/2, is written 1/2 + s with s >= 0, so that SymPy sees the sign of a sum of terms of one sign.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import Any

import sympy

from kovacic.algebra.rationals import to_fraction
from kovacic.closed_form.jets import BallEvaluator
from kovacic.parametric.assumptions import Assumptions, Known


class Uncovered(Exception):
    """A sentence that says why a problem isn't treated."""


class Signs:
    """The real symbols of the parameters, and what follows from the assumptions about them."""

    def __init__(self, known: Assumptions, names: Iterable[str]) -> None:
        found = known.symbols()
        self._known_of = known.of
        facts = {name: symbol.assumptions0 for name, symbol in found.items()}
        self.symbols = {name: sympy.Symbol(name, **{**facts.get(name, {}), "real": True}) for name in names}
        self._by_plain = {sympy.Symbol(name): symbol for name, symbol in self.symbols.items()}
        #: The number of a level.
        self.n = sympy.Dummy("n", integer=True, nonnegative=True)
        bounds = {name: known.of(name).bounds for name in self.symbols}
        self._bounds = {name: those for name, those in bounds.items() if those}

    def real(self, expression: Any) -> Any:
        """The expression in the real symbols, in the place of plain ones of the same names."""
        return expression.xreplace(self._by_plain)

    def bounds_of(self, name: str, value: Any) -> list[Any]:
        """The known bounds of the parameter, as relations for its value; false if it can't have that."""
        known = self._known_of(name)
        if value.is_number:
            return [] if is_admitted(known, value) else [sympy.false]
        facts = self.symbols[name].assumptions0.items()  # an integer, say
        if any(getattr(value, f"is_{fact}", None) is (not is_so) for fact, is_so in facts):
            return [sympy.false]
        return [exceeds(b.sign * (value - sympy.Rational(b.end)), 0, strict=b.strict) for b in known.bounds]

    def holds(self, relation: Any) -> bool | None:
        """True if a relation holds for all values, False if for none, None if neither is proven.

        A relation with the number of the level in it is false where it is false for all of the numbers.
        """
        if relation in (sympy.true, sympy.false):
            return bool(relation)
        is_strict = relation.func in (sympy.StrictGreaterThan, sympy.StrictLessThan)
        return self._known(relation.gts - relation.lts, "is_positive" if is_strict else "is_nonnegative")

    def is_positive(self, expression: Any) -> bool | None:
        return self._known(expression, "is_positive")

    def is_nonnegative(self, expression: Any) -> bool | None:
        return self._known(expression, "is_nonnegative")

    def sign(self, expression: Any) -> int | None:
        """1 or -1 where that is the sign for all values; None otherwise."""
        if expression.is_infinite:
            return 1 if expression == sympy.oo else -1
        return next((sign for sign in (1, -1) if self.is_positive(sign * expression)), None)

    def size(self, expression: Any) -> Any:
        """The absolute value."""
        sign = self.sign(expression)
        return sympy.Abs(expression) if sign is None else sign * expression

    def known_sign(self, expression: Any, otherwise: str) -> int:
        """The sign for all values.  Raises `Uncovered`, as `otherwise` says, where it isn't known."""
        sign = self.sign(expression)
        if sign is None:
            raise Uncovered(otherwise)
        return sign

    def _known(self, expression: Any, question: str) -> bool | None:
        """SymPy's answer to a question such as `is_positive`, from the first chart that gives one."""
        symbols = [self.symbols[name] for name in self._bounds]
        for chosen in product(*self._bounds.values()):
            # Each parameter with bounds is one of them plus or minus a variable of known sign, an integer if it is one.
            values = {}
            for symbol, bound in zip(symbols, chosen, strict=True):
                facts = {"positive": True} if bound.strict else {"nonnegative": True}
                if bound.end.denominator == 1 and symbol.is_integer:
                    facts["integer"] = True
                values[symbol] = sympy.Rational(bound.end) + bound.sign * sympy.Dummy("s", **facts)
            factored = sympy.factor(sympy.together(sympy.sympify(expression, strict=True).xreplace(values)))
            # As a product of sums of products, and in factors.
            factors = (sympy.expand(part) if part.is_Add else part for part in sympy.Mul.make_args(factored))
            answers = (getattr(form, question) for form in (sympy.Mul(*factors, evaluate=False), factored))
            found = next((answer for answer in answers if answer is not None), None)
            letters = [*factored.free_symbols]
            if found is None and len(letters) == 1 and letters[0].is_real and factored.is_polynomial(*letters):
                poly = sympy.Poly(factored, *letters)
                if (poly.domain.is_QQ or poly.domain.is_ZZ) and not poly.count_roots():  # g^2 + g + 1
                    found = poly.nth(0) > 0
            if found is not None:
                return bool(found)
        return None


def is_admitted(known: Known, value: Any) -> bool:
    """True unless a real number contradicts the assumptions."""
    if value.is_Rational:
        return known.admits_number(to_fraction(value))
    return known.rational is not True and known.admits_ball(BallEvaluator({})(value))


def exceeds(delta: Any, least: Any, *, strict: bool) -> Any:
    """delta > least, or >=; false for a delta that isn't real."""
    if delta.is_real is False:
        return sympy.false
    relation = sympy.Gt if strict else sympy.Ge
    return relation(delta, least)
