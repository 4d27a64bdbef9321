"""The spectral problem: V - E as it was read, the domain, and the assumptions on the parameters, in real symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy

from kovacic.bound_states.coordinates import Original
from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.signs import Signs, Uncovered, exceeds
from kovacic.equation import Parsed
from kovacic.errors import InputError
from kovacic.general_solution.conditions import read_conditions
from kovacic.numbers.numerals import as_text
from kovacic.parametric.assumptions import Assumptions
from kovacic.reading.symbolic import names_of
from kovacic.sturm_liouville.problem import Robin
from kovacic.writing.formula import caret, free_name

FRIEDRICHS = "friedrichs"


@dataclass(frozen=True)
class Boundary:
    """Conditions alpha y + beta y' = 0 at the left and the right end (None if not given), and their text."""

    wishes: tuple[Robin | None, Robin | None] = (None, None)
    text: str = ""

    @property
    def is_mixed(self) -> bool:
        """True for a condition neither on y nor on y' alone: a level may be below the infimum of V then."""
        return any(wish is not None and wish.alpha != 0 and wish.beta != 0 for wish in self.wishes)


@dataclass(frozen=True, kw_only=True)
class Asked:
    """-kinetic y'' + V y = E y between two ends, in plain symbols, with the assumptions; values are already substituted.

    V is any elementary function; S is (V - E)/kinetic, in which `roots` are the meanings of letters, and `given` what the user
    gave, whose symbols may have assumptions.
    """

    given: Any
    V: Any
    S: Any
    variable: str
    interval: tuple[Any, Any]
    energy: str
    boundary: Boundary
    friedrichs: bool
    assumed: Mapping[Any, Any]
    kinetic: Any
    names: Sequence[str]
    notices: tuple[str, ...]
    roots: Mapping[str, Any] = field(default_factory=dict)

    @property
    def letters(self) -> set[str]:
        """The names in S and in the ends, but for the variable and the energy."""
        return {*names_of(sympy.Tuple(self.S, *self.interval))} - {self.variable, self.energy}

    def spectrum(self, **found: Any) -> Spectrum:
        """The answer, with what was `found`."""
        boundary = self.boundary.text or (FRIEDRICHS if self.friedrichs else None)
        given = {"notices": self.notices, "kinetic": self.kinetic, "conditions": self.boundary.wishes}
        return Spectrum(self.V, self.variable, self.interval, self.energy, boundary=boundary, **given, **found)


@dataclass(frozen=True, kw_only=True)
class SpectralProblem(Asked):
    """The question for exact methods: the S that was `parsed`, and the domain, in real symbols.

    `meanings` are those of letters for roots, powers and exponentials of the user's parameters, and for pi and e.
    """

    parsed: Parsed
    domain: tuple[Any, Any]
    known: Assumptions
    signs: Signs
    meanings: Mapping[str, Any]

    @property
    def x(self) -> Any:
        return sympy.Symbol(self.variable, real=True)

    @property
    def t(self) -> Any:
        """The variable of the equation that was read, a function of x."""
        return sympy.Symbol(self.parsed.variable)

    @property
    def original(self) -> Original:
        """The function t of x in which V was read as a rational one.  Raises `Uncovered` for others than those known here."""
        return Original.of(self.parsed.equation, self.x, self.domain, self.signs)

    @property
    def E(self) -> Any:
        return self.signs.symbols[self.energy]

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of what the levels depend on: parameters, and letters for anything but pi and e."""
        names = (name for name in self.signs.symbols if self.meanings.get(name) not in (sympy.pi, sympy.E))
        return tuple(name for name in names if name != self.energy)

    def demand(self, side: int, mu: Any, delta: Any) -> Any:
        """The condition for the solution with the exponent (1 + delta)/2 to be the one meant at an end, 0 left or 1 right.

        The local coordinate has (du/dx)^2 ~ u^mu.  The solution is the only square integrable one, or obeys the condition.
        """
        end = self.domain[side]
        wish = self.boundary.wishes[side]
        if wish is not None and not wish.is_zero:
            # y' = 0 for the smaller exponent, where u ~ (x - a)^2 and y is a function of it.
            if wish.alpha != 0 or mu != 1:
                raise Uncovered("the boundary condition isn't one on exponents")
            return exceeds(-delta, 0, strict=False)
        if end.is_infinite:  # mu >= 2 there, and at no finite end
            return exceeds(delta, mu - 2, strict=True)
        # y ~ (x - a)^(1/2 + delta/(2 - mu)); at a limit point nu = delta/(2 - mu) is at least 1.
        return exceeds(delta, 0 if self.friedrichs or wish is not None else 2 - mu, strict=False)

    def plain(self, expression: Any) -> Any:
        """In the user's terms: plain symbols of the same names, what letters stand for, n for the number of a level."""
        symbols = expression.atoms(sympy.Symbol) - expression.atoms(sympy.Dummy)
        plain = {symbol: self.meanings.get(symbol.name, sympy.Symbol(symbol.name)) for symbol in symbols}
        inside = names_of(sympy.Tuple(*self.meanings.values()))
        return expression.xreplace({**plain, self.signs.n: number_beside(*self.signs.symbols, self.variable, *inside)})

    def shown(self, expression: Any) -> str:
        """As text, in the user's terms."""
        return caret(as_text(self.plain(expression)))


def read_boundary(boundary: str | None, ends: Sequence[Any], variable: str) -> Boundary:
    """Conditions at the ends, "y'(0) = 0, y(1) = 0".  Raises `InputError` for others."""
    if boundary in (None, FRIEDRICHS):
        return Boundary()
    if not isinstance(boundary, str) or "=" not in boundary:
        hint = f'boundary="{FRIEDRICHS}", or a condition at an end: boundary="y\'(0) = 0"'
        raise InputError(f"{boundary!r} isn't a boundary condition", hint=hint)
    y = sympy.Function("y")(sympy.Symbol(variable))
    wishes: dict[Any, Robin] = {}
    for condition in read_conditions(boundary, y):
        at, *others = {*condition.points}
        wish = Robin(*condition.by_order)
        is_one_at_an_end = not others and at.is_finite and at in ends and at not in wishes and condition.value == 0
        if not is_one_at_an_end or (wish.alpha.free_symbols | wish.beta.free_symbols):
            raise InputError(
                f"{condition.text}: one condition alpha*y + beta*y' = 0, with numbers, at a finite end is expected"
            )
        wishes[at] = wish
    return Boundary((wishes.get(ends[0]), wishes.get(ends[1])), boundary)


def number_beside(*taken: str) -> Any:
    """The symbol for the number of a level where these names are taken."""
    return sympy.Symbol(free_name(taken, *"nkjm"))
