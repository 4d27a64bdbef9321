"""The spectral problem: V - E as the user wrote it, the domain, and the assumptions on the parameters, in real symbols.

`Signs` of expressions in the parameters are proven, refuted, or not known.  A parameter with a bound,
l >= 1/2, is written 1/2 + s with s >= 0, so that SymPy sees the sign of a sum of terms of one sign.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from typing import Any

import sympy

from kovacic.bound_states.translations import assumed_of_letters
from kovacic.equation import DEFAULT_VARIABLE, EULER, PI, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.general_solution.conditions import ConditionReader, as_mapping
from kovacic.limits import Limits
from kovacic.numbers.exact import exact_text
from kovacic.numbers.numerals import as_text
from kovacic.parametric.assumptions import Assumptions, Bound, read_assumptions
from kovacic.reading.lexer import scanned
from kovacic.reading.names import NUMBER_NAMES, is_letter
from kovacic.reading.naming import USUAL_VARIABLES, chosen_variable
from kovacic.reading.read import read_input
from kovacic.reading.source import source_of
from kovacic.reading.substitution import value_text, values_among
from kovacic.reading.symbolic import LIMITS as SYMBOLIC
from kovacic.reading.symbolic import expression_of, names_of, read_expression
from kovacic.sturm_liouville.problem import STEPS, Robin, pieces_of
from kovacic.writing.formula import caret


class Signs:
    """The real symbols of the parameters, and what follows from the assumptions about them."""

    def __init__(self, known: Assumptions, names: Iterable[str]) -> None:
        found = known.symbols()
        self._known_of = known.of
        facts = {name: symbol.assumptions0 for name, symbol in found.items()}
        self.symbols = {name: sympy.Symbol(name, **{**facts.get(name, {}), "real": True}) for name in names}
        #: The number of a level.
        self.n = sympy.Dummy("n", integer=True, nonnegative=True)
        bounds = {name: known.of(name).bounds for name in self.symbols}
        self._bounds = {name: those for name, those in bounds.items() if those}

    def real(self, expression: Any) -> Any:
        """The expression in the real symbols, in the place of plain ones of the same names."""
        plain = (symbol for symbol in expression.free_symbols if not isinstance(symbol, sympy.Dummy))
        of_parameters = [symbol for symbol in plain if symbol.name in self.symbols]
        return expression.xreplace({symbol: self.symbols[symbol.name] for symbol in of_parameters})

    def bounds_of(self, name: str, expression: Any) -> list[Any]:
        """The known bounds of the parameter, as relations for an expression that is its value."""
        found = []
        for bound in self._bounds.get(name, ()):
            relation = sympy.Gt if bound.strict else sympy.Ge
            found.append(relation(bound.sign * (expression - _end_of(bound)), 0))
        return found

    def admits(self, name: str, expression: Any) -> bool:
        """False if the expression can't be the value of the parameter, which is an integer, say."""
        coset = self._known_of(name).coset
        if coset is not None and expression.is_Rational:
            return bool(coset.contains(Fraction(int(expression.p), int(expression.q))))
        for fact, value in self.symbols[name].assumptions0.items():
            known = getattr(expression, f"is_{fact}", None)
            if known is not None and known != value:
                return False
        return True

    def holds(self, relation: Any) -> bool | None:
        """True or False for a relation that holds for all values or for none, None if neither is known.

        A relation with the number of the level in it is false where it is false for all of the numbers.
        """
        if relation in (sympy.true, sympy.false):
            return bool(relation)
        difference = relation.gts - relation.lts
        is_strict = relation.func in (sympy.StrictGreaterThan, sympy.StrictLessThan)
        if is_strict:
            return self.is_positive(difference)
        return self.is_nonnegative(difference)

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
        if self.is_positive(-expression):
            return -1
        return None

    def _known(self, expression: Any, question: str) -> bool | None:
        """What SymPy says in the first of the charts in which it says something."""
        symbols = [self.symbols[name] for name in self._bounds]
        for chosen in product(*self._bounds.values()):
            # Each parameter with bounds as one of them and a variable with a sign.
            values = {symbol: _beyond(bound, symbol) for symbol, bound in zip(symbols, chosen, strict=True)}
            factored = sympy.factor(sympy.together(sympy.sympify(expression, strict=True).xreplace(values)))
            # As a product of sums of products, and in factors.
            factors = (sympy.expand(part) if part.is_Add else part for part in sympy.Mul.make_args(factored))
            expanded = sympy.Mul(*factors, evaluate=False)
            for form in (expanded, factored):
                found = getattr(form, question)
                if found is not None:
                    return bool(found)
        return None


def _end_of(bound: Bound) -> Any:
    return sympy.Rational(bound.end.numerator, bound.end.denominator)


def _beyond(bound: Bound, symbol: Any) -> Any:
    """The bound and a variable with a sign, an integer where that is known."""
    facts = {"positive": True} if bound.strict else {"nonnegative": True}
    if bound.end.denominator == 1 and symbol.is_integer:
        facts["integer"] = True
    return _end_of(bound) + bound.sign * sympy.Dummy("s", **facts)


FRIEDRICHS = "friedrichs"
#: Names for the number of a level: the first one that the user hasn't taken.
_NUMBERS = ("n", "k", "j", "m", "n_")
_INFINITE = {"oo": sympy.oo, "+oo": sympy.oo, "inf": sympy.oo, "-oo": -sympy.oo, "-inf": -sympy.oo}


class Uncovered(Exception):
    """Why a problem isn't treated, in a sentence."""


@dataclass(frozen=True)
class Boundary:
    """Conditions alpha y + beta y' = 0 at the left and the right end (None if not given), and their text."""

    wishes: tuple[Robin | None, Robin | None] = (None, None)
    text: str = ""

    @property
    def is_mixed(self) -> bool:
        """True for a condition neither on y nor on y' alone: a level may be below the infimum of V then."""
        return any(wish is not None and wish.alpha != 0 and wish.beta != 0 for wish in self.wishes)


@dataclass(frozen=True)
class SpectralProblem:
    """The problem: V - E as it was read, and the domain, in real symbols."""

    V: Any
    parsed: Parsed
    domain: tuple[Any, Any]
    variable: str
    energy: str
    known: Assumptions
    signs: Signs
    friedrichs: bool
    notices: tuple[str, ...] = ()
    kinetic: Any = sympy.S.One
    boundary: Boundary = Boundary()

    @property
    def x(self) -> Any:
        return sympy.Symbol(self.variable, real=True)

    @property
    def E(self) -> Any:
        return self.signs.symbols[self.energy]

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the user's."""
        constants = self.constants
        return tuple(name for name in self.signs.symbols if name != self.energy and name not in constants)

    @property
    def constants(self) -> dict[str, Any]:
        """pi and e among the parameters, by the names for which they stand."""
        return _constants(self.V, self.signs.symbols)

    def with_friedrichs_condition(self) -> SpectralProblem:
        """The same with the boundary condition that wasn't given, and a note that says so."""
        note = (
            "a boundary condition is needed: Friedrichs' boundary condition is taken, the smaller solution at the end"
        )
        return replace(self, friedrichs=True, notices=(*self.notices, note))

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
            return above(-delta, 0, strict=False)
        if end.is_infinite and mu < 2:
            raise Uncovered(f"the end {end} is a finite point of the coordinate")
        if end.is_infinite:
            return above(delta, mu - 2, strict=True)
        if mu >= 2:
            raise Uncovered(f"the end {end} is at infinity in the coordinate")
        # y ~ (x - a)^(1/2 + delta/(2 - mu)); at a limit point nu = delta/(2 - mu) is at least 1.
        return above(delta, 0 if self.friedrichs or wish is not None else 2 - mu, strict=False)

    def with_potential(self, V: Any) -> SpectralProblem:
        """The problem for another potential, in real symbols."""
        plain = self.plain(V)
        text = f"({as_text(plain)}) - {self.energy}"
        return replace(self, V=plain, parsed=read_input(text, var=self.variable, exponentials=True))

    def plain(self, expression: Any) -> Any:
        """In plain symbols of the same names, as users write them; n for the number of a level."""
        taken = {*self.signs.symbols, self.variable}
        number = next(name for name in _NUMBERS if name not in taken)
        symbols = [s for s in expression.free_symbols if not isinstance(s, sympy.Dummy)]
        constants = self.constants
        plain = {symbol: constants.get(symbol.name, sympy.Symbol(symbol.name)) for symbol in symbols}
        return expression.xreplace({**plain, self.signs.n: sympy.Symbol(number)})


def above(delta: Any, least: Any, *, strict: bool) -> Any:
    """delta > least, or >=; false for a delta that isn't real."""
    if delta.is_number and delta.is_real is False:
        return sympy.false
    relation = sympy.Gt if strict else sympy.Ge
    return relation(delta, least)


def read_question(
    V: Any,
    domain: Sequence[Any],
    *,
    energy: str,
    var: Any,
    assume: Mapping[Any, Any] | None,
    boundary: str | None,
    limits: Limits,
    kinetic: Any = sympy.S.One,
    names: Sequence[str] = (),
) -> SpectralProblem:
    """The spectral problem of a call of `kovacic.spectrum`, where the parameters are described.

    Raises `InputError` for what isn't a potential, a domain or a boundary condition, and `LimitExceeded`.
    """
    if not isinstance(energy, str) or not energy.isidentifier():
        raise InputError(f"{energy!r} can't be the name of the energy")
    if len(domain) != 2 or isinstance(domain, str):
        raise InputError("a domain is a pair of ends", hint='domain=(0, "oo")')
    ends = [read_end(value) for value in domain]
    V_read, guesses = _read_potential(V, energy, None if var is None else str(var), names)
    x, notices = _variable_of(names_of(V_read)) if var is None else (str(var), ())
    values, rest = values_among(assume or {})
    at = {sympy.Symbol(name): read_expression(value_text(v, name, x, limits=limits)) for name, v in values.items()}
    known_names = sorted({symbol.name for part in (V_read, *ends) for symbol in part.free_symbols} - {x})
    for name in values:
        if name not in known_names:
            raise InputError(
                f"{name} isn't a parameter of V", hint=f"the parameters are {', '.join(known_names) or 'none'}"
            )
    ends = [end.xreplace(at) for end in ends]
    potential = _in_one_piece(V_read.xreplace(at), x, ends)
    S = potential - sympy.Symbol(energy)
    parsed = read_input(S, var=x, limits=limits, exponentials=True, names=names)
    in_the_domain = {symbol.name for end in ends for symbol in end.free_symbols}
    if in_the_domain & {x, energy}:
        raise InputError(f"an end of the domain contains {x} or {energy}")
    in_S = parameters_of(parsed.S.field)
    # A shift, as b in 1/cosh(x - b)^2, doesn't occur in the equation in t.
    meanings = {symbol.name for _, meaning in parsed.letters for symbol in meaning.free_symbols}
    shifts = {symbol.name for symbol in potential.free_symbols} - meanings - {x}
    names = (*in_S, *sorted((in_the_domain | shifts) - {*in_S}))
    known = read_assumptions(assumed_of_letters(rest or None, parsed.letters), V, names)
    for constant in _constants(potential, names):
        known = known.also(constant, ("irrational", "positive"))
    signs = Signs(known, names)
    first, last = (signs.real(end) for end in ends)
    if signs.is_nonnegative(first - last) or first == sympy.oo or last == -sympy.oo:
        raise InputError(f"the domain is empty: {first} isn't below {last}")
    return SpectralProblem(
        potential,
        parsed,
        domain=(first, last),
        variable=x,
        energy=energy,
        known=known,
        signs=signs,
        friedrichs=boundary == FRIEDRICHS,
        boundary=read_boundary(boundary, ends, x),
        notices=(*guesses, *notices),
        kinetic=signs.real(sympy.sympify(kinetic, strict=True)),
    )


def _in_one_piece(V: Any, variable: str, ends: list[Any]) -> Any:
    """Without absolute values and steps that are one function on the domain.  Raises `NotRational` for several pieces."""
    if not V.has(*STEPS):
        return V
    pieces = pieces_of(V, sympy.S.One, sympy.Symbol(variable), (ends[0], ends[1])) if len(names_of(V)) == 1 else ()
    if len(pieces) != 1:
        raise NotRational(f"{caret(as_text(V))} is a function in pieces, and its levels have no formula here")
    return pieces[0].Q


def read_boundary(boundary: str | None, ends: Sequence[Any], variable: str) -> Boundary:
    """Conditions at the ends, "y'(0) = 0, y(1) = 0".  Raises `InputError` for others."""
    if boundary in (None, FRIEDRICHS):
        return Boundary()
    if not isinstance(boundary, str) or "=" not in boundary:
        hint = f'boundary="{FRIEDRICHS}", or a condition at an end: boundary="y\'(0) = 0"'
        raise InputError(f"{boundary!r} isn't a boundary condition", hint=hint)
    reader = ConditionReader(sympy.Function("y")(sympy.Symbol(variable)), "y")
    wishes: list[Robin | None] = [None, None]
    for key, value in as_mapping(boundary).items():
        condition = reader.read(key, value)
        places = [side for side, end in enumerate(ends) if {end} == {*condition.points}]
        if len(places) != 1 or condition.value != 0 or ends[places[0]].is_infinite:
            raise InputError(
                f"{condition.text}: a condition alpha*y + beta*y' = 0 at a finite end of the domain is expected"
            )
        wishes[places[0]] = Robin.of(((term.order, term.coefficient) for term in condition.terms), condition.text)
    return Boundary((wishes[0], wishes[1]), boundary)


def _variable_of(names: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """x, or the only name if it usually is a variable, and a note if it isn't x.  Raises `InputError` for several names."""
    if DEFAULT_VARIABLE in names or not names:
        return DEFAULT_VARIABLE, ()
    # The only name that usually is a variable, as r in l (l+1)/r^2 - Z/r.
    usual = [name for name in names if name in USUAL_VARIABLES and name.islower()]
    only = usual[0] if len(usual) == 1 else chosen_variable(names)
    if only in USUAL_VARIABLES:
        return only, (f"{only} is taken for the variable, of which V is a function",)
    return DEFAULT_VARIABLE, (f"{DEFAULT_VARIABLE} is the variable, {only} a parameter",)


def _read_potential(V: Any, energy: str, var: str | None, names: Sequence[str]) -> tuple[Any, tuple[str, ...]]:
    """V as an expression, and what was guessed when a text was read.  Raises `InputError` for what isn't a real potential."""
    guesses: tuple[str, ...] = ()
    if isinstance(V, str):
        if var is None:
            with suppress(
                InputError
            ):  # with the position, below; names only, since l(l + 1) is a product or a function
                letters = (token.text for token in scanned(V) if is_letter(token.text))
                var, _ = _variable_of([name for name in dict.fromkeys(letters) if name not in NUMBER_NAMES])
        source = source_of(V, var, SYMBOLIC, names=(*names, energy))
        if source.unknown:
            raise InputError(
                "a potential is expected, and this is an equation", hint="give V of -y'' + V y = E y alone"
            )
        expression, guesses = expression_of(source, SYMBOLIC, what="the potential"), source.guesses
    else:
        given = V if hasattr(V, "free_symbols") else read_expression(exact_text(V, "the potential"))
        expression = given.xreplace({symbol: sympy.Symbol(symbol.name) for symbol in given.free_symbols})
    if energy in {s.name for s in expression.free_symbols}:
        raise InputError(
            f"the potential contains {energy}, the energy",
            hint="energy= gives it another name",
            shell="--energy gives it another name",
        )
    numbers = expression.atoms(sympy.Rational)
    longest = max((max(abs(int(c.p)), int(c.q)) for c in numbers), default=0)
    if longest.bit_length() > SYMBOLIC.bits:
        raise LimitExceeded(f"the potential has numbers of more than {SYMBOLIC.bits} bits", limit="bits")
    if expression.has(sympy.I):
        raise InputError("the potential isn't real")
    return expression, guesses


def _constants(expression: Any, names: Iterable[str]) -> dict[str, Any]:
    """pi and e, which are parameters for the program, and aren't for users."""
    symbols = {symbol.name for symbol in expression.free_symbols}
    meanings = {PI: sympy.pi, EULER: sympy.E}
    return {name: value for name, value in meanings.items() if name in names and name not in symbols}


def read_end(value: Any) -> Any:
    """An end of the domain, a number, an expression or infinite.  Raises `InputError` for anything else."""
    text = exact_text(value, "an end of the domain")
    if text in _INFINITE:
        return _INFINITE[text]
    return read_expression(text, what="an end of the domain")
