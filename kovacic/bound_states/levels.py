"""The result of `kovacic.spectrum`: the levels, their wave functions, and the statements proven about them.

Zeros of a polynomial, which are energies or zeros of solutions, are counted in balls that contain one root each: a root whose
ball meets the real axis is real, since its conjugate is a root as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import count, islice
from typing import TYPE_CHECKING, Any, cast

import sympy
from flint import acb_poly, arb

from kovacic.algebra.precision import working_precision
from kovacic.bound_states.signs import is_admitted
from kovacic.closed_form.jets import BallEvaluator
from kovacic.errors import InputError, needs, visible
from kovacic.limits import MOST_TRIALS
from kovacic.numbers.exact import exact_text, whole
from kovacic.numbers.numerals import as_latex, as_text
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, check_values
from kovacic.reading.symbolic import read_expression
from kovacic.sturm_liouville.problem import stretches_of
from kovacic.writing.escaped import json_line, latex
from kovacic.writing.formula import caret

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def zeros_inside(P: Any, E: Any, value: Any, bounds: Any) -> int | None:
    """Number of zeros of the polynomial P between two bounds, which may be infinite, where E is an algebraic number.

    None if a zero and a bound aren't told apart.
    """
    with working_precision(128):
        number = BallEvaluator({E: BallEvaluator({})(value)})
        found = acb_poly([*map(number, reversed(P.all_coeffs()))]).roots()
        low, high = (number(end).real if end.is_finite else arb(float(end)) for end in bounds)
        real = [root.real for root in found if root.imag.contains(0)]
        inside = sum(low < root < high for root in real)
        outside = sum(bool(root < low) or bool(root > high) for root in real)
        return inside if inside + outside == len(real) else None


def real_roots(polynomial: Any, E: Any) -> list[Any]:
    """The real zeros of a polynomial, each once, in order; in square roots where all zeros are."""
    found = sympy.roots(polynomial, E, cubics=False, quartics=False)
    if sum(found.values()) < sympy.degree(polynomial, E):
        return [*dict.fromkeys(sympy.Poly(polynomial, E).real_roots())]
    return sorted(root for root in found if root.is_real)


NO_FORMULA_FOR_ALL = "undecided: no formula for all levels is known"

_SMALLER = {"friedrichs": "the smaller solution at each end (Friedrichs)"}
#: Before none, one or two equations.
_SOLVING: tuple[tuple[str, ...], ...] = ((), ("the levels solve",), ("the even levels solve", "the odd levels solve"))
_ANOTHER = "V is another potential, whose levels aren't those above"
_NO_CONDITION = "a boundary condition is needed, there is no spectrum without one"


@dataclass(frozen=True)
class BoundState:
    """One level at given values of the parameters: its energy and its wave function, not normalised.

    `number` counts the levels from 0, and is the number of zeros inside the domain, by Sturm's theorem.  `norm` is the integral
    of the square of the wave function over the domain, None if it is unknown.
    """

    number: int
    energy: Any
    wave: Any
    norm: Any = None

    @property
    def zeros(self) -> int:
        """The number of zeros of the wave function inside the domain."""
        return self.number

    def __str__(self) -> str:
        return f"E_{self.number} {self.value}, y = {_text(self.wave)}"

    @property
    def said(self) -> str:
        """ "= 3: 1 zero, norm^2 = sqrt(pi)"."""
        zeros = "1 zero" if self.zeros == 1 else f"{self.zeros} zeros"
        norm = "" if self.norm is None else f", norm^2 = {_text(self.norm)}"
        return f"{self.value}: {zeros}{norm}"

    @property
    def value(self) -> str:
        """ "= 2*sqrt(2)", or a decimal after "~" for the root of a polynomial that isn't solved."""
        is_root = self.energy.has(sympy.CRootOf)
        return f"~ {_text(sympy.N(self.energy, 12))}" if is_root else f"= {_text(self.energy)}"


@dataclass(frozen=True)
class Levels:
    """Infinitely many or finitely many levels in one formula: SymPy expressions in `number`, the parameters and the variable.

    `number` is a natural number n; `energy` is E_n and `wave` a real solution y_n, square integrable where the `conditions`
    hold: inequalities between n and the parameters.  `zeros` is the number of zeros of y_n inside the domain, and `norm` the
    integral of y_n^2 over the domain, None if it is unknown.
    """

    number: Any
    energy: Any
    wave: Any
    conditions: tuple[Any, ...]
    zeros: Any
    norm: Any = None

    def mapped(self, change: Callable[[Any], Any]) -> Levels:
        """With all expressions changed, without conditions that hold then."""
        number, energy, wave, zeros = map(change, (self.number, self.energy, self.wave, self.zeros))
        conditions = tuple(condition for condition in map(change, self.conditions) if condition != sympy.true)
        return Levels(number, energy, wave, conditions, zeros, None if self.norm is None else change(self.norm))

    @property
    def where(self) -> tuple[Any, ...]:
        """The conditions on the parameters alone."""
        return tuple(c for c in self.conditions if not c.has(self.number))

    @property
    def is_empty(self) -> bool:
        """True if no n fulfils the conditions."""
        return sympy.false in self.conditions or self.members == ()

    @cached_property
    def members(self) -> tuple[int, ...] | None:
        """The n of finitely many levels without parameters; None for infinitely many, and where parameters decide."""
        if any(c.free_symbols != {self.number} for c in self.conditions):
            return None
        # More levels than that are shown by their condition.
        allowed = sympy.Intersection(sympy.Range(MOST_TRIALS), *(c.as_set() for c in self.conditions))
        found = tuple(map(int, allowed))
        return None if MOST_TRIALS - 1 in found else found

    @property
    def numbers(self) -> str:
        """The numbers as a list, "0, 1", that ends with "..." where it goes on, as far as the conditions hold."""
        known = self.members
        if known is None or known != tuple(range(len(known))):
            return "0, 1, 2, ..."
        return ", ".join(map(str, known)) if len(known) <= 6 else f"0, 1, ..., {known[-1]}"

    @property
    def demands(self) -> tuple[Any, ...]:
        """The conditions that are shown: not those with n in them where all n are listed."""
        return self.conditions if self.numbers.endswith("...") else self.where

    def states_at(self, values: Mapping[Any, Any], _energy: Any = None) -> Iterator[BoundState]:
        """The levels of the numbers 0, 1, ... at values of the parameters, as far as the conditions hold."""
        for n in count():
            here = {**values, self.number: sympy.Integer(n)}
            if not _are_true(self.conditions, here):
                return
            energy = sympy.simplify(self.energy.subs(here))
            yield BoundState(int(self.zeros.subs(here)), energy, self.wave.subs(here).doit())

    def lines(self, energy: str) -> list[str]:
        """The energy with its conditions, the wave function, the zeros and the norm, as text."""
        n = self.number
        first = f"{energy}_{n} = {_text(self.energy)}, {n} = {self.numbers}"
        conditions = [condition for condition in self.demands if condition.has(n)]
        if conditions:
            first += f" with {_relations_text(conditions)}"
        if self.where:
            first += f", where {_relations_text(self.where)}"
        last = f"    {_text(self.zeros)} zeros"
        if self.norm is not None:
            last += f", norm^2 = {_text(self.norm)}"
        return [first, f"    y_{n} = {_text(self.wave)}", last]

    def rows(self, energy: str) -> list[str]:
        """The energy, the wave function and the conditions, in LaTeX."""
        n = as_latex(self.number)
        numbers = self.numbers.replace("...", r"\ldots")
        first = rf"{energy}_{{{n}}} &= {as_latex(self.energy)},\quad {n} = {numbers}"
        return [first, rf"y_{{{n}}} &= {as_latex(self.wave)}", *_rows_of(self.demands)]


@dataclass(frozen=True)
class Algebraic:
    """Levels of a potential that is solvable for finitely many of them: those with a polynomial of degree d in their solutions.

    They exist where `constraint` vanishes (a function of the parameters; 0 where it does anyway), and their energies are the
    zeros of `polynomial`, in E; `wave` is a solution for each of them, with E for the energy, square integrable where the
    `conditions` hold.  `states` are the energies without parameters and the zeros of their functions inside the domain.  `P` is
    the polynomial in the solutions, in its own variable t, and `range` the least and the largest t on the domain, or () if
    the monotonicity of t is undecided.  If t turns in the middle it is the range on one half, and `middle` is 1 or 0: the
    zeros there.
    """

    degree: int
    constraint: Any
    polynomial: Any
    wave: Any
    conditions: tuple[Any, ...] = ()
    states: tuple[BoundState, ...] = ()
    P: Any = None
    range: tuple[Any, ...] = ()
    middle: int | None = None

    @property
    def demands(self) -> tuple[Any, ...]:
        """The constraint, if there is one, and the conditions."""
        constraint = sympy.Eq(self.constraint, 0, evaluate=False)
        return (constraint, *self.conditions) if self.constraint != 0 else self.conditions

    def lines(self, energy: str) -> list[str]:
        """The equation for the energies with its conditions, the wave function, and the levels that are known, as text."""
        where = f" where {_relations_text(self.demands)}" if self.demands else ""
        first = f"d = {self.degree}{where}: {_text(self.polynomial)} = 0"
        return [first, f"    y = {_text(self.wave)}", *(f"    {energy} {state.said}" for state in self.states)]

    def rows(self, _energy: str) -> list[str]:
        """The equation for the energies, the wave function and the conditions, in LaTeX."""
        first = rf"d = {self.degree}\colon\quad & {as_latex(self.polynomial)} = 0"
        return [first, rf"& y = {as_latex(self.wave)}", *_rows_of(self.demands)]

    def states_at(self, values: Mapping[Any, Any], E: Any) -> Iterator[BoundState]:
        """The levels at rational values of the parameters: of each it is known how many zeros its function has."""
        if self.states:
            yield from self.states
            return
        if not self.range or self.constraint.xreplace(values) != 0:
            return
        P = sympy.Poly(self.P.as_expr().xreplace(values), self.P.gen)
        bounds = [end.xreplace(values) for end in self.range]
        polynomial = sympy.numer(sympy.together(self.polynomial.xreplace(values)))
        for value in real_roots(polynomial, E):
            number = zeros_inside(P, E, value, bounds)
            if number is not None and _are_true(self.conditions, {**values, E: value}):
                number = number if self.middle is None else 2 * number + self.middle
                yield BoundState(number, value, self.wave.xreplace(values).subs(E, value))


@dataclass(frozen=True)
class Spectrum:
    """The discrete spectrum of -y'' + V y = E y, as far as it was found: frozen and picklable.

    Attributes
    ----------
    potential, variable, domain, energy
        V and its domain, as SymPy expressions, the variable and the energy, by their names.
    levels : tuple of Levels
        The levels that are solved for all n at once.  Where they have conditions on the parameters that exclude each other,
        those hold whose conditions do.
    algebraic : tuple of Algebraic
        The levels of a quasi-exactly solvable potential, by the degree d.
    complete : bool
        True if these are proven to be all eigenvalues, wherever the conditions, the assumptions and `excluded` admit values.
    closed_forms_complete : bool
        True, where `complete` is False, if it is proven that no other level has a Liouvillian wave function; without any levels
        in the answer, that none has.
    reason : str
        The theorem that proves it, or why it is undecided.
    ends : tuple of str
        How the solutions behave at the ends.
    excluded : tuple
        Where a boundary condition would be needed: relations between the parameters, or True; an equation where V is another
        potential, since the coefficient vanishes by which it is known at an end.
    boundary : str or None
        The boundary condition that was given.
    notices : tuple of str
        Remarks on the reading of the input: which name is the variable.
    numeric : Eigenvalues
        The lowest levels as proven numbers, if `levels` was given: a sequence, each with its `value` and its `zeros`.
    hint, shell : str
        The argument that may lead to a better answer, in Python and on the command line; empty if there is none.
    matching : tuple of sympy.Eq
        Where V is constant or linear on each of its pieces, and no formula is known: the equation for the energies, by matching
        the solutions on both sides, or those for even and for odd functions.  Below the continuous spectrum the levels are its
        roots; a root where a wave number sqrt(E - V) vanishes may be none, and both sides may be infinite at a level.
    kinetic : sympy.Expr
        k where the equation is -k y'' + V y = E y, hbar^2/(2 m) for instance; 1 by default.
    conditions : tuple
        The conditions that were given at the two ends, alpha y + beta y' = 0, as objects with `alpha` and `beta`, or None.
    """

    potential: Any
    variable: str
    domain: tuple[Any, Any]
    energy: str
    parameters: tuple[str, ...] = ()
    assumptions: Assumptions = NOTHING_ASSUMED
    boundary: str | None = None
    ends: tuple[str, ...] = ()
    excluded: tuple[Any, ...] = ()
    levels: tuple[Levels, ...] = ()
    algebraic: tuple[Algebraic, ...] = ()
    complete: bool = False
    closed_forms_complete: bool = False
    reason: str = ""
    notices: tuple[str, ...] = ()
    hint: str = ""
    shell: str = ""
    kinetic: Any = sympy.S.One
    numeric: Any = ()
    conditions: tuple[Any, Any] = (None, None)
    matching: tuple[Any, ...] = ()

    @property
    def formulas(self) -> tuple[Levels | Algebraic, ...]:
        """The levels of both kinds."""
        return (*self.levels, *self.algebraic)

    @property
    def needs_boundary_condition(self) -> bool:
        """True if both solutions are square integrable at an end, for all parameters, and no condition was given."""
        return sympy.true in self.excluded

    @property
    def is_decided(self) -> bool:
        """True if levels are known, or a complete list of some kind, or that a boundary condition is missing."""
        known = (self.levels, self.algebraic, self.matching)
        return any((*known, self.complete, self.closed_forms_complete, self.needs_boundary_condition))

    def states(self, values: Mapping[Any, Any] | None = None, count: int = 10) -> tuple[BoundState, ...]:
        """The lowest levels at exact values of the parameters, at most `count` of each formula, by their energies.

        Raises `InputError` where no level is known, where a parameter has no value, and for values that the spectrum excludes.

        Parameters
        ----------
        values : mapping
            A real number for each parameter, by name: {"w": 3}; needed where there are parameters.
        count : int
            The most of each formula: 10 by default.

        Returns
        -------
        tuple of State
            In the order of their energies.

        Examples
        --------
        >>> import kovacic
        >>> oscillator = kovacic.spectrum("w^2*x^2", assume={"w": "positive"})
        >>> [state.energy for state in oscillator.states({"w": 3}, count=3)]
        [3, 9, 15]
        """
        count = whole(count, "count")
        at = self._symbols_at(values or {})
        for relation in self.excluded:
            if not _are_true([relation], at):
                continue
            if isinstance(relation, sympy.Eq):
                raise InputError(f"where {_text(relation)} V is another potential", hint="give V with this value")
            # Friedrichs' condition is taken where there is one: solutions oscillate.
            hint = "no boundary condition is distinguished"
            raise InputError("both solutions are square integrable at an end", hint=hint)
        if not any((self.complete, self.closed_forms_complete, self.formulas)):
            hint = "give V with these values" if self.parameters else "levels=5 encloses the lowest ones"
            raise InputError("no level is known", hint=hint)
        found: dict[Any, BoundState] = {}
        for one in self.formulas:
            for state in islice(one.states_at(at, sympy.Symbol(self.energy)), count):
                found.setdefault(state.energy, state)
        return tuple(sorted(found.values(), key=lambda state: state.energy))

    def plot(self, values: Mapping[Any, Any] | None = None, count: int = 5) -> Figure:
        """The potential, the lowest levels at their heights, and the wave functions on them.

        Parameters
        ----------
        values : mapping
            A real number for each parameter, by name; needed where there are parameters.
        count : int
            The most levels: 5 by default.

        Returns
        -------
        matplotlib.figure.Figure
            Functions are scaled to one height.  Numeric levels are drawn where there are some, with their balls in the
            legend.  Raises `InputError` where no level is known, and `MissingExtra` without
            Matplotlib and NumPy.

        Examples
        --------
        >>> import kovacic
        >>> figure = kovacic.spectrum("x^2").plot(count=3)
        >>> [line.get_label() for line in figure.axes[0].lines[1::2]]
        ['E_0 = 1', 'E_1 = 3', 'E_2 = 5']
        """
        with needs("plot", "a picture"):
            import matplotlib  # noqa: F401
        with needs("numeric", "a picture"):
            import scipy  # noqa: F401

            from kovacic.bound_states.picture import DrawnLevel, draw_levels
        states = () if self.numeric else self.states(values, count)[:count]
        if not states and not self.numeric:
            raise InputError("no level is known that could be drawn", hint="levels=5 encloses the lowest ones")
        at = self._symbols_at(values or {})
        x = sympy.Symbol(self.variable)

        def function(expression: Any) -> Callable[[Any], Any]:
            return cast(Callable[[Any], Any], sympy.lambdify(x, sympy.N(expression.xreplace(at), 17), "scipy"))

        levels = []
        for state in states:
            exact = _text(state.energy)
            shown = exact if len(exact) <= 12 else f"{float(state.energy):.6g}"  # the legend has room for as much
            levels.append((state.number, state.energy, function(state.wave), shown))
        levels += [(k, one.value, self.numeric.wave(k), str(one.value)) for k, one in enumerate(self.numeric[:count])]
        drawn = [DrawnLevel(float(value), wave, f"{self.energy}_{k} = {shown}") for k, value, wave, shown in levels]
        title = self._equation(at)
        V, first, last = (part.xreplace(at) for part in (self.potential, *self.domain))
        pieces = stretches_of(V, sympy.S.One, x, (first, last))
        impulses = [(float(piece.low), float(piece.delta)) for piece in pieces if piece.delta != 0]
        plain = function(V.replace(sympy.DiracDelta, lambda *_: sympy.S.Zero))
        ends = float(first), float(last)
        return draw_levels(plain, drawn, ends, variable=self.variable, title=title, impulses=impulses)

    def _equation(self, at: Mapping[Any, Any]) -> str:
        """Schroedinger's, and what V is."""
        kinetic = "" if self.kinetic == 1 else f"{_text(self.kinetic.xreplace(at))} "
        return f"-{kinetic}y'' + V y = {self.energy} y, V = {_text(self.potential.xreplace(at))}"

    def _symbols_at(self, values: Mapping[Any, Any]) -> dict[Any, Any]:
        """The values by symbols.  Raises `InputError` where one is missing, unknown, not real or not admitted."""
        given = {str(name): read_expression(exact_text(v, "the value of a parameter")) for name, v in values.items()}
        check_values(given, self.parameters)
        for name, value in given.items():
            if value.is_real is False:
                raise InputError(f"{name} = {_text(value)} isn't a real number")
            if not is_admitted(self.assumptions.of(name), value):
                raise InputError(f"{name} = {_text(value)} contradicts the assumption: {self.assumptions}")
        return {sympy.Symbol(name): value for name, value in given.items()}

    def text(self, *, shell: bool = False) -> str:
        """In lines, as the command prints it.

        Parameters
        ----------
        shell : bool
            With the hint for the command line, and not that for Python; False by default.

        Returns
        -------
        str
            `str` gives the same.

        Examples
        --------
        >>> import kovacic
        >>> oscillator = kovacic.spectrum("x^2")
        >>> print(oscillator.text().splitlines()[0])
        -y'' + V y = E y, V = x^2, -oo < x < oo
        """
        first, last = map(_text, self.domain)
        known = f" ({self.assumptions})" if self.assumptions else ""
        lines = [f"{self._equation({})}, {first} < {self.variable} < {last}{known}"]
        lines += [*map("note: {}".format, self.notices), *self.ends]
        if self.boundary:
            lines.append(f"boundary condition: {_SMALLER.get(self.boundary, self.boundary)}")
        for one in self.formulas:
            lines += one.lines(self.energy)
        lines += map("{} {}".format, _SOLVING[len(self.matching)], map(_text, self.matching))
        lines += self._conclusion
        if self.numeric != () and not self.needs_boundary_condition:  # which is said above
            lines += str(self.numeric).splitlines()
        hint = self.shell if shell else self.hint
        if hint:
            lines.append(f"hint: {hint}")
        return visible("\n  ".join(lines))

    @property
    def _conclusion(self) -> list[str]:
        """The statements about the list as a whole."""
        lines = []
        for relation in self.excluded:
            where = "" if relation == sympy.true else f"where {_text(relation)}: "
            lines.append(f"{where}{_ANOTHER if isinstance(relation, sympy.Eq) else _NO_CONDITION}")
        is_proven = self.complete or self.closed_forms_complete
        all_of_them, none = "eigenfunctions with a closed form", "no eigenfunction has a closed form"
        if self.complete:
            all_of_them, none = "eigenvalues", "no eigenvalues"
        if self.formulas:
            proven = f"proven to be all {all_of_them}; "
        else:
            proven = "proven; "
            lines += [none] * is_proven
        return [*lines, f"({proven * is_proven}{self.reason})"]

    def __str__(self) -> str:
        return self.text()

    def latex(self) -> str:
        r"""The levels as a LaTeX formula: E_n = ..., n = 0, 1, ..., and the wave functions, in `aligned`.

        Returns
        -------
        str
            A formula without delimiters.

        Examples
        --------
        >>> import kovacic
        >>> oscillator = kovacic.spectrum("x^2")
        >>> print(oscillator.latex().partition(r" \\ ")[0])
        \begin{aligned} E_{n} &= 2 n + 1,\quad n = 0, 1, 2, \ldots
        """
        rows = [row for one in self.formulas for row in one.rows(self.energy)]
        rows += map("& {}".format, map(as_latex, self.matching))
        rows = rows or [rf"&\text{{{latex(' '.join(self._conclusion))}}}"]
        return r"\begin{aligned} " + r" \\ ".join(rows) + r" \end{aligned}"

    def _repr_latex_(self) -> str:
        return f"${self.latex()}$"

    def to_dict(self) -> dict[str, Any]:
        """The JSON object as plain Python values: formulas as text.

        Returns
        -------
        dict
            With lists of levels, algebraic levels and ends.

        Examples
        --------
        >>> import kovacic
        >>> oscillator = kovacic.spectrum("x^2")
        >>> oscillator.to_dict()["levels"][0]["energy"]
        '2*n + 1'
        """
        found = _data(self)
        for name in ("numeric", "matching"):
            if getattr(self, name) != ():
                found[name] = _data(getattr(self, name))
        return cast(dict[str, Any], found)

    def to_json(self) -> str:
        """One line of JSON.

        Returns
        -------
        str
            It has no line breaks.

        Examples
        --------
        >>> import kovacic
        >>> oscillator = kovacic.spectrum("x^2")
        >>> import json
        >>> json.loads(oscillator.to_json()) == oscillator.to_dict()
        True
        """
        return json_line(self.to_dict())


def _are_true(relations: Iterable[Any], values: Mapping[Any, Any]) -> bool:
    """True if all of the relations hold at values; raises `InputError` if that can't be decided."""
    for relation in relations:
        found = sympy.false
        with suppress(TypeError):  # a side is infinite, or a root of a negative number
            found = sympy.simplify(relation.subs(values))
        if found not in (sympy.true, sympy.false):
            raise InputError(f"whether {_text(found)} isn't known at these values", hint="give numbers")
        if not found:
            return False
    return True


#: What JSON has of an object.
_JSON_KEYS: dict[type, tuple[str, ...]] = {
    BoundState: ("energy", "zeros", "norm"),
    Levels: ("number", "energy", "wave", "conditions", "zeros", "norm"),
    Algebraic: ("degree", "constraint", "polynomial", "wave", "conditions", "states"),
    Spectrum: (
        *("potential", "kinetic", "variable", "domain", "energy", "parameters", "assumptions", "boundary", "ends"),
        *("excluded", "levels", "algebraic", "complete", "closed_forms_complete", "reason", "notices", "hint"),
    ),
}


def _data(value: Any) -> Any:
    """For JSON: formulas and relations as text, levels by their fields, that of a state without a norm that is unknown."""
    if isinstance(value, tuple):
        return [*map(_data, value)]
    if type(value) in _JSON_KEYS:
        found = {name: _data(getattr(value, name)) for name in _JSON_KEYS[type(value)]}
        if isinstance(value, BoundState) and value.norm is None:
            del found["norm"]
        return found
    if hasattr(value, "to_dict"):
        return value.to_dict()
    return value if isinstance(value, int | str | None) else _text(value)


def _relations_text(relations: Iterable[Any]) -> str:
    return ", ".join(map(_text, relations))


def _rows_of(relations: Sequence[Any]) -> list[str]:
    """The relations in a row of LaTeX, none for none."""
    return ["&" + r",\; ".join(map(as_latex, relations))] if relations else []


def _text(expression: Any) -> str:
    """A formula or a relation."""
    if isinstance(expression, sympy.Eq):
        return f"{_text(expression.lhs)} = {_text(expression.rhs)}"
    return caret(as_text(expression))
