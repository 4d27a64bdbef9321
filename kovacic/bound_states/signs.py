"""Signs of expressions in real parameters about which something is known: proven, refuted, or not known.

A parameter with a bound, l >= 1/2, is written 1/2 + s with s >= 0, so that SymPy sees the sign of a sum of terms of one sign.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import product
from typing import Any

import sympy

from kovacic.parametric.assumptions import Assumptions, Bound


class Signs:
    """The real symbols of the parameters, and what follows from the assumptions about them."""

    def __init__(self, known: Assumptions, names: Iterable[str]) -> None:
        found = known.symbols()
        self._known_of = known.of
        self.symbols = {name: _real(name, found.get(name)) for name in names}
        #: The number of a level.
        self.n = sympy.Dummy("n", integer=True, nonnegative=True)
        self._bounds = [(self.symbols[name], known.of(name).bounds) for name in self.symbols if known.of(name).bounds]

    def real(self, expression: Any) -> Any:
        """The expression in the real symbols, in the place of plain ones of the same names."""
        plain = (s for s in expression.free_symbols if not isinstance(s, sympy.Dummy))
        return expression.xreplace({s: self.symbols[s.name] for s in plain if s.name in self.symbols})

    def bounds_of(self, name: str, expression: Any) -> list[Any]:
        """What is known about the parameter, said about an expression that is its value."""
        bounds = dict(self._bounds).get(self.symbols[name], [])
        found = []
        for bound in bounds:
            difference = bound.sign * (expression - sympy.Rational(bound.end.numerator, bound.end.denominator))
            found.append(sympy.Gt(difference, 0) if bound.strict else sympy.Ge(difference, 0))
        return found

    def admits(self, name: str, expression: Any) -> bool:
        """May the expression be the value of the parameter, which is an integer, say?  False where it can't be."""
        coset = self._known_of(name).coset
        if coset is not None and expression.is_Rational:
            return bool(coset.contains(Fraction(int(expression.p), int(expression.q))))
        facts = self.symbols[name].assumptions0
        return all(getattr(expression, f"is_{fact}", None) in (None, value) for fact, value in facts.items())

    def holds(self, relation: Any) -> bool | None:
        """Is the relation true for all values, false for all values, or neither of these as far as is known?

        A relation with the number of the level in it is false where it is false for all of the numbers.
        """
        if relation in (sympy.true, sympy.false):
            return bool(relation)
        difference = relation.gts - relation.lts
        strict = relation.func in (sympy.StrictGreaterThan, sympy.StrictLessThan)
        return self.is_positive(difference) if strict else self.is_nonnegative(difference)

    def is_positive(self, expression: Any) -> bool | None:
        return self._known(expression, "is_positive")

    def is_nonnegative(self, expression: Any) -> bool | None:
        return self._known(expression, "is_nonnegative")

    def sign(self, expression: Any) -> int | None:
        """1 or -1 where that is the sign for all values; None otherwise."""
        if expression.is_infinite:
            return 1 if expression == sympy.oo else -1
        if self.is_positive(expression):
            return 1
        return -1 if self.is_positive(-expression) else None

    def _known(self, expression: Any, question: str) -> bool | None:
        for values in self._charts():
            factored = sympy.factor(sympy.together(sympy.sympify(expression).xreplace(values)))
            parts = [sympy.expand(part) if part.is_Add else part for part in sympy.Mul.make_args(factored)]
            found = getattr(sympy.Mul(*parts, evaluate=False), question)
            if found is None:
                found = getattr(factored, question)
            if found is not None:
                return bool(found)
        return None

    def _charts(self) -> Iterator[dict[Any, Any]]:
        """Each parameter with bounds as one of them and a variable with a sign."""
        for chosen in product(*(bounds for _, bounds in self._bounds)):
            symbols = (symbol for symbol, _ in self._bounds)
            yield {symbol: _beyond(bound, symbol) for symbol, bound in zip(symbols, chosen, strict=True)}


def _real(name: str, known: Any) -> Any:
    facts = {} if known is None else known.assumptions0
    return sympy.Symbol(name, **{**facts, "real": True})


def _beyond(bound: Bound, symbol: Any) -> Any:
    facts = {"positive": True} if bound.strict else {"nonnegative": True}
    if bound.end.denominator == 1 and symbol.is_integer:
        facts["integer"] = True
    end = sympy.Rational(bound.end.numerator, bound.end.denominator)
    return end + bound.sign * sympy.Dummy("s", **facts)
