"""Airy's equation, S0 = q z: Ai(q^(1/3) z) and Bi(q^(1/3) z).

q f'^2 f = S + ... shows f up to its constant term: it is a cubic root of -9 t/q, where t'^2/t = -S + ... at all poles.

Reference: DLMF 9.2, 9.2.7 (the Wronskian).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from flint import acb, arb, fmpq, fmpq_poly

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Problem
from kovacic.special import prices
from kovacic.special.maps import irregular_places, parts_by_scale, value_at_point
from kovacic.special.pullback import Pullback, StandardEquation, StandardForm, ValueAndSlope, standard_part

if TYPE_CHECKING:
    from kovacic.special.writer import Writer, WrittenPair


@dataclass(frozen=True)
class Airy(StandardEquation):
    """S0 = q z."""

    q: Poly

    searched: ClassVar[str] = "Airy's equation in f(x), f rational"
    irregular: ClassVar[bool] = True
    name = "Airy's"
    cost = prices.AIRY

    @property
    def S(self) -> RatFunc:
        return RatFunc(self.q.field.x * self.q)

    @classmethod
    def candidates(cls, problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
        places = irregular_places(problem)
        if any((place.order - 2) % 3 for place in places):
            return
        for q, parts in parts_by_scale(problem, 3):
            f = sum((part.part for part in parts), RatFunc(q * 0))
            c = value_at_point(standard_part(problem.S, f) / q - f, places[0])
            if c is not None:
                yield Pullback(Airy(q), f + c)

    def written(self, writer: Writer, f: RatFunc) -> WrittenPair:
        import sympy

        z = writer.root(self.q, 3) * writer.argument(f)
        before = writer.factor(f, ())
        bracket = z.diff(writer.atoms.x) / sympy.pi
        return writer.pair((before, sympy.airyai(z)), (before, sympy.airybi(z)), bracket)

    @property
    def parameters(self) -> list[fmpq]:
        return []

    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        (q,) = self.constants
        size = acb(arb(abs(q)).root(3))
        c = size if q > 0 else -size

        def values(z: acb, needed: Sequence[bool]) -> list[ValueAndSlope]:
            Ai, dAi, Bi, dBi = (c * z).airy()
            return [(Ai, c * dAi), (Bi, c * dBi)]

        return StandardForm(n, d, ((0, 0), (0, 0)), values)
