"""What is asked: V - E as the user has written it, the domain, and what is known of the parameters, in real symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import sympy

from kovacic.bound_states.letters import assumed_of_letters
from kovacic.bound_states.signs import Signs
from kovacic.equation import DEFAULT_VARIABLE, EULER, PI, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.general_solution.conditions import ConditionReader, as_mapping
from kovacic.limits import Limits
from kovacic.numbers.exact import exact_text
from kovacic.numbers.numerals import as_text
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.reading.naming import USUAL_VARIABLES, chosen_variable
from kovacic.reading.read import read_input
from kovacic.reading.source import source_of
from kovacic.reading.substitution import with_values
from kovacic.reading.symbolic import LIMITS as SYMBOLIC
from kovacic.reading.symbolic import expression_of, names_of, read_expression
from kovacic.sturm_liouville.problem import STEPS, Robin, pieces_of
from kovacic.writing.formula import caret

FRIEDRICHS = "friedrichs"
#: Names for the number of a level: the first one that the user hasn't taken.
_NUMBERS = ("n", "k", "j", "m", "n_")
_INFINITE = {"oo": sympy.oo, "+oo": sympy.oo, "inf": sympy.oo, "-oo": -sympy.oo, "-inf": -sympy.oo}


@dataclass(frozen=True)
class Boundary:
    """Conditions alpha y + beta y' = 0 at the left and the right end (None if not given), and their text."""

    wishes: tuple[Robin | None, Robin | None] = (None, None)
    text: str = ""

    @property
    def is_mixed(self) -> bool:
        """Is a condition neither on y nor on y' alone?  Then a level may be below the infimum of V."""
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

    def with_potential(self, V: Any) -> SpectralProblem:
        """The same for another potential, in real symbols."""
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


class _Potential(NamedTuple):
    """V as an expression, V - E as it is read: text where V is; and what was guessed when a text was read."""

    expression: Any
    S: Any
    guesses: tuple[str, ...] = ()


class _Variable(NamedTuple):
    """The name of the variable, and a note where the user may not expect it."""

    name: str
    notices: tuple[str, ...] = ()


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
    """The question that `kovacic.spectrum` was asked; its parameters are described there.

    Raises `InputError` for what isn't a potential, a domain or a boundary condition, and `LimitExceeded`.
    """
    if not isinstance(energy, str) or not energy.isidentifier():
        raise InputError(f"{energy!r} can't be the name of the energy")
    if len(domain) != 2 or isinstance(domain, str):
        raise InputError("a domain is a pair of ends", hint='domain=(0, "oo")')
    ends = [read_end(value) for value in domain]
    given = _read_potential(V, energy, None if var is None else str(var), names)
    variable = _Variable(str(var))
    if var is None:
        variable = _variable_of(given.expression)
    given = _in_one_piece(given, variable.name, energy, ends)
    read = partial(read_input, var=variable.name, limits=limits, exponentials=True, names=names)
    shifts = _with_shifts(given, assume or {}, read, variable=variable.name, energy=energy)
    given = shifts.potential
    S, parsed, of_parameters = with_values(given.S, shifts.parsed, shifts.others or None, limits)
    assumed = assumed_of_letters({**(of_parameters or {}), **shifts.assumed} or None, parsed.letters)
    names = _names(parsed, ends, variable=variable.name, energy=energy)
    names = (*names, *(name for name in shifts.names if name not in names))
    known = read_assumptions(assumed, V, names)
    for constant in _constants(given.expression, names):
        known = known.also(constant, ("irrational", "positive"))
    signs = Signs(known, names)
    potential = given.expression
    if S is not given.S:
        left = {*names, energy, variable.name}
        gone = {str(name): value for name, value in (assume or {}).items() if str(name) not in left}
        values = {sympy.Symbol(name): read_expression(exact_text(value, "a value")) for name, value in gone.items()}
        potential = potential.xreplace(values)
    return SpectralProblem(
        potential,
        parsed,
        domain=_checked_domain(ends, signs),
        variable=variable.name,
        energy=energy,
        known=known,
        signs=signs,
        friedrichs=boundary == FRIEDRICHS,
        boundary=read_boundary(boundary, ends, variable.name),
        notices=(*given.guesses, *variable.notices),
        kinetic=signs.real(sympy.sympify(kinetic)),
    )


class _Shifts(NamedTuple):
    """The parameters that only shift the variable, once those with a value have it: what is assumed of them, and of others."""

    potential: _Potential
    parsed: Parsed
    names: list[str]
    assumed: dict[Any, Any]
    others: dict[Any, Any]


def _with_shifts(
    given: _Potential, assume: Mapping[Any, Any], read: Callable[..., Parsed], *, variable: str, energy: str
) -> _Shifts:
    """Puts values into the potential before it is read: afterwards a shift no longer occurs in the equation in t."""
    parsed = read(given.S)
    names = _shifts(given, parsed, variable=variable, energy=energy)
    of_shifts = {name: said for name, said in assume.items() if str(name) in names}
    values = {
        sympy.Symbol(str(name)): value for name, said in of_shifts.items() if (value := _number(said)) is not None
    }
    if values:
        given = _Potential(given.expression.xreplace(values), given.S.xreplace(values), given.guesses)
        parsed = read(given.S)
        names = [name for name in names if sympy.Symbol(name) not in values]
    assumed = {name: said for name, said in of_shifts.items() if str(name) in names}
    others = {name: said for name, said in assume.items() if name not in of_shifts}
    return _Shifts(given, parsed, names, assumed, others)


def _shifts(given: _Potential, parsed: Parsed, *, variable: str, energy: str) -> list[str]:
    """The parameters that shift the variable alone, as b in 1/cosh(x - b)^2, and so don't occur in the equation in t."""
    meanings = {symbol.name for _, meaning in parsed.letters for symbol in meaning.free_symbols}
    names = {symbol.name for symbol in given.expression.free_symbols} - meanings
    return sorted(names - {variable, energy, *parameters_of(parsed.S.field)})


def _number(said: Any) -> Any:
    """The value that an assumption gives, or None if it states something else."""
    text = exact_text(said, "a value") if not isinstance(said, str) else said
    try:
        value = read_expression(text)
    except InputError:  # an inequality
        return None
    return value if value.is_number else None


def _in_one_piece(given: _Potential, variable: str, energy: str, ends: list[Any]) -> _Potential:
    """Without absolute values and steps that are one function on the domain.  Raises `NotRational` for several pieces."""
    V = given.expression
    if not V.has(*STEPS):
        return given
    pieces = pieces_of(V, sympy.S.One, sympy.Symbol(variable), (ends[0], ends[1])) if len(names_of(V)) == 1 else ()
    if len(pieces) != 1:
        raise NotRational(f"{caret(as_text(V))} is a function in pieces, and its levels have no formula here")
    return _Potential(pieces[0].Q, pieces[0].Q - sympy.Symbol(energy), given.guesses)


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


def _names(parsed: Parsed, ends: list[Any], *, variable: str, energy: str) -> tuple[str, ...]:
    """The energy and the parameters, those of the ends last.  Raises `InputError` for ends that aren't constant."""
    in_the_domain = {symbol.name for end in ends for symbol in end.free_symbols}
    if in_the_domain & {variable, energy}:
        raise InputError(f"an end of the domain contains {variable} or {energy}")
    names = parameters_of(parsed.S.field)
    return (*names, *sorted(in_the_domain - {*names}))


def _variable_of(expression: Any) -> _Variable:
    """x, or the only name if it usually is a variable; and a note where it isn't x.  Raises `InputError` for several names."""
    names = names_of(expression)
    if DEFAULT_VARIABLE in names or not names:
        return _Variable(DEFAULT_VARIABLE)
    only = _usual_one(names) or chosen_variable(names)
    if only in USUAL_VARIABLES:
        return _Variable(only, (f"{only} is taken for the variable, of which V is a function",))
    return _Variable(DEFAULT_VARIABLE, (f"{DEFAULT_VARIABLE} is the variable, {only} a parameter",))


def _usual_one(names: Sequence[str]) -> str | None:
    """The only name that usually is a variable, as r in l (l+1)/r^2 - Z/r; None without one, or if x is among the names."""
    usual = [name for name in names if name in USUAL_VARIABLES and name.islower()]
    return usual[0] if len(usual) == 1 and DEFAULT_VARIABLE not in names else None


def _read_potential(V: Any, energy: str, var: str | None, names: Sequence[str]) -> _Potential:
    """Raises `InputError` for what isn't a real potential."""
    potential = _as_written(V, energy, var, names)
    expression = potential.expression
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
    return potential


def _as_written(V: Any, energy: str, var: str | None, names: Sequence[str]) -> _Potential:
    """The potential as text, as an expression, or as a number."""
    if isinstance(V, str):
        if var is None:
            with suppress(InputError):  # with the position, below
                var = _usual_one(names_of(read_expression(V)))
        source = source_of(V, var, SYMBOLIC, names=(*names, energy))
        if source.unknown:
            raise InputError(
                "a potential is expected, and this is an equation", hint="give V of -y'' + V y = E y alone"
            )
        expression = expression_of(source, SYMBOLIC, what="the potential")
        return _Potential(expression, expression - sympy.Symbol(energy), source.guesses)
    expression = V
    if not hasattr(V, "free_symbols"):
        expression = read_expression(exact_text(V, "the potential"))
    plain = expression.xreplace({symbol: sympy.Symbol(symbol.name) for symbol in expression.free_symbols})
    return _Potential(plain, expression - sympy.Symbol(energy))


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


def _checked_domain(ends: list[Any], signs: Signs) -> tuple[Any, Any]:
    """The ends in real symbols.  Raises `InputError` where nothing lies between them."""
    first, last = (signs.real(end) for end in ends)
    is_empty = signs.is_nonnegative(first - last) or first == sympy.oo or last == -sympy.oo
    if is_empty:
        raise InputError(f"the domain is empty: {first} isn't below {last}")
    return first, last
