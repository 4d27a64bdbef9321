"""What `dsolve` knows and an `Eq` can't carry: the pair, a particular solution, where they hold, and what holds elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.constants import Determined
from kovacic.general_solution.first_order import FirstOrderEquation
from kovacic.general_solution.question import Question, symbols_that_know
from kovacic.general_solution.substitution import size
from kovacic.general_solution.validity import Validity, needed_for
from kovacic.general_solution.zero import differs_from_zero, samples
from kovacic.general_solution.zero_set import ZeroSet

Expr = Any  # SymPy publishes no types
#: Answers by their equations, of systems by the first, and how many of them.
_GIVEN: dict[Expr, ProblemAnswer] = {}
_MOST_GIVEN = 100


@dataclass(frozen=True)
class Exceptional:
    """Particular values of a letter, for which the two solutions of an answer are no pair.

    Attributes
    ----------
    where : str
        Which values: "c = 1", "c is a positive integer".
    values : mapping
        A letter and its value.
    example : mapping
        One of several values of a letter.
    assume : mapping
        What to assume of a letter, as for `dsolve`, where it is no single value.
    """

    where: str
    values: Mapping[Expr, Expr] = field(default_factory=dict)
    example: Mapping[Expr, Expr] = field(default_factory=dict, kw_only=True)
    assume: Mapping[str, str] = field(default_factory=dict)
    _ask: Callable[[Exceptional], ProblemAnswer] | None = field(default=None, repr=False, compare=False)

    @cached_property
    def answer(self) -> ProblemAnswer | None:
        """The answer for these values; None if none is found."""
        if self._ask is None or not (self.values or self.assume):
            return None
        with suppress(InputError, NotImplementedError):
            return self._ask(self)
        return None

    def __str__(self) -> str:
        return self.where


@dataclass(frozen=True, repr=False)
class ProblemAnswer:
    """The answer to an equation with its right-hand side and its values.

    Attributes
    ----------
    eq : sympy.Eq
        y(x) = ..., what `dsolve` returns.
    notices : list of str
        What is to be said beside: the warnings of `dsolve`.
    unchecked : tuple of str
        Why the answer couldn't be put into the equation, or into a condition; empty where it was.
    known : mapping
        Symbols that know what was assumed, for the user's own.
    exceptional : tuple of sympy.Expr
        Exceptions of the pair from which a system or a Riccati equation has its solutions.
    """

    eq: Expr
    notices: list[str]
    unchecked: tuple[str, ...] = field(default=(), kw_only=True)
    known: Mapping[Expr, Expr] = field(default_factory=dict, kw_only=True)
    exceptional: tuple[Expr, ...] = field(default=(), kw_only=True)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self}>"

    def __str__(self) -> str:
        return "\n".join(f"{eq.lhs} = {eq.rhs}" for eq in self.equations)

    @property
    def equations(self) -> Sequence[Expr]:
        """y(x) = ..., or one equation for each unknown of a system."""
        return (self.eq,)

    @property
    def own(self) -> dict[Expr, Expr]:
        """The user's symbols for those that know what was assumed."""
        return {symbol: user for user, symbol in self.known.items()}

    @property
    def pair_exceptions(self) -> tuple[Expr, ...]:
        """Where one of these is zero, the two solutions in the answer are dependent or undefined."""
        return self.exceptional

    @property
    def exceptions(self) -> tuple[Exceptional, ...]:
        """The values of letters for which the general solution isn't made of this pair, and what holds there."""
        return ()

    def relations_beside(self, eq: Expr) -> tuple[Expr, ...]:
        """Relations that the solution needs and the formula doesn't show, in symbols that carry the assumptions."""
        return ()

    @cached_property
    def validity(self) -> Validity:
        """Where the formula is real and valid: relations, and exceptional values of parameters."""
        eqs = [eq.xreplace(self.known) for eq in self.equations]
        found = needed_for([eq.rhs for eq in eqs], eqs[0].lhs.args[0], self.pair_exceptions)
        return Validity(
            tuple(relation.xreplace(self.own) for relation in (*found.real, *self.relations_beside(eqs[0]))),
            tuple(e.xreplace(self.own) for e in found.exceptions),
            found.has_real_parts,
        )


@dataclass(frozen=True, repr=False)
class SecondOrderAnswer(ProblemAnswer):
    """y = C1 y1 + C2 y2 + y0.

    Attributes
    ----------
    question : Question
        The equation, its conditions, and the user's symbols.
    basis : Basis
        y1 and y2 with their Wronskian, and `exceptions`: for which letters they are no basis.
    particular : sympy.Expr
        y0.
    names : tuple of sympy.Symbol
        C1 and C2.
    determined : Determined or None
        What the conditions make of C1 and C2, for generic letters and for particular ones; None without conditions.
    ask : callable
        Answers another question about the same function: `answer_to`.
    """

    question: Question
    basis: Basis
    particular: Expr
    names: tuple[Expr, Expr]
    determined: Determined | None
    ask: Callable[..., ProblemAnswer] = field(kw_only=True, repr=False, compare=False)

    @property
    def pair(self) -> tuple[Expr, Expr]:
        """y1 and y2 in the user's symbols."""
        y1, y2 = (self.question.own(y).xreplace(self.own) for y in (self.basis.y1, self.basis.y2))
        return y1, y2

    @property
    def pair_exceptions(self) -> tuple[Expr, ...]:
        if self.determined is None:
            return self.basis.exceptions
        # With given values a constant that vanishes is a denominator of the answer, or a gamma function has a pole.
        # Where one constant stays free, the solution that it multiplies vanishes with the Wronskian, as sin(k x) at k = 0.
        value = self.eq.xreplace(self.known).rhs
        members = sympy.Tuple(self.basis.y1, self.basis.y2).atoms(sympy.Function)
        found = map(self.question.own, self.basis.undefined) if members & value.atoms(sympy.Function) else ()
        solution = self.question.own(value)
        free = [solution.diff(name) for name in self.names if solution.has(name)]
        has_poles = self.eq.has(sympy.gamma)
        zeros = (
            e
            for e in self.basis.dependent
            if (has_poles and isinstance(1 / e, sympy.gamma)) or any(vanishes_with(e, y) for y in free)
        )
        return (*found, *zeros)

    @cached_property
    def exceptions(self) -> tuple[Exceptional, ...]:
        if self.determined is not None:
            return ()
        zeros = dict.fromkeys([*self.basis.dependent, *self.basis.exceptions])
        cases = (case for zero in zeros for case in exceptional_cases(zero))
        return tuple(replace(case, _ask=self._there) for case in cases)

    def _there(self, case: Exceptional) -> ProblemAnswer:
        """For particular values of letters, or with something more assumed of them."""
        equation, function, _ = self.question.at(case.values)
        return self.ask(equation.xreplace(self.own), function.xreplace(self.own), assume=case.assume)


@dataclass(frozen=True, repr=False)
class FirstOrderAnswer(ProblemAnswer):
    """The answer to an equation of first order, linear or Riccati's, which is stored with its conditions."""

    equation: FirstOrderEquation

    def relations_beside(self, eq: Expr) -> tuple[Expr, ...]:
        """u >= 0 for the w = u^k, k = 1/(1 - n) an integer, that solves Bernoulli's equation where w^(1/k) is u."""
        w, n, x = eq.rhs, self.equation.power, eq.lhs.args[0]
        if n.is_integer or not (1 / (1 - n)).is_integer or w == 0:
            return ()
        u = sympy.cancel(w * self.equation.r / (w.diff(x) - self.equation.q * w))  # w^n = (w' - q w)/r, and u = w/w^n
        number, rest = sympy.factor(u).as_coeff_Mul()
        rest = sympy.Mul(*(factor for factor in sympy.Mul.make_args(rest) if not isinstance(factor, sympy.exp)))
        return ((rest if number > 0 else -rest) >= 0,)


@dataclass(frozen=True, repr=False)
class SystemAnswer(ProblemAnswer):
    """The answer to a system of two equations, whose `eq` is a list: x(t) = ..., y(t) = ..."""

    eq: list[Expr]

    @property
    def equations(self) -> Sequence[Expr]:
        return self.eq


def exceptional_cases(zero: Expr) -> Iterator[Exceptional]:
    """Where an expression in letters is zero: a value of one of them, or integers, for sin(pi l) and 1/gamma(l)."""
    integers: list[tuple[Expr, str]] = []
    if isinstance(zero, sympy.sin):
        integers = [(zero.args[0] / sympy.pi, sign) for sign in ("positive", "nonpositive")]
    elif isinstance(1 / zero, sympy.gamma):
        integers = [((1 / zero).args[0], "nonpositive"), (-(1 / zero).args[0], "nonnegative")]
    integers = [(number, sign) for number, sign in integers if number.is_Symbol]
    for number, sign in integers:
        if getattr(number, f"is_{sign}") is not False:
            example = {number: sympy.Integer(sign == "positive")}
            yield Exceptional(f"{number} is a {sign} integer", assume={number.name: f"{sign} integer"}, example=example)
    if integers:
        return
    slopes = {letter: sympy.factor(zero.diff(letter)) for letter in sorted(zero.free_symbols, key=str)}
    linear = [k for k, slope in slopes.items() if not slope.has(k) and not (slope.is_Add and slope.free_symbols)]
    if not linear:
        yield Exceptional(str(ZeroSet(zero)))
        return
    letter = min(linear, key=lambda k: not slopes[k].is_number)
    value = letter - zero / slopes[letter]
    value = min((sympy.expand(value), sympy.factor(value)), key=size)
    yield Exceptional(f"{letter} = {value}", values={letter: value})


def vanishes_with(zero: Expr, *functions: Expr) -> bool:
    """False if in each case in which `zero` is 0 one of the functions is seen not to be."""

    def is_seen_nonzero(case: Exceptional) -> bool:
        values = case.values or case.example
        there = [y.subs(values) for y in functions if values]
        return any(differs_from_zero(y, next(samples(y.free_symbols))) for y in there)

    return not all(map(is_seen_nonzero, exceptional_cases(zero)))


def remember(answer: ProblemAnswer) -> None:
    """Keep an answer of which only the equation is returned, for `validity`."""
    _GIVEN[answer.equations[0]] = answer
    while len(_GIVEN) > _MOST_GIVEN:
        del _GIVEN[next(iter(_GIVEN))]


def given_answer(eq: Expr) -> ProblemAnswer | None:
    """The answer from which `dsolve` returned this equation, if it is one of the last."""
    return _GIVEN.get(eq)


def validity(solution: Any, assume: Mapping[Any, Any] | None = None) -> Validity:
    """What a solution needs to be real and valid: an interval, and exceptional values of parameters.

    The relations are read off the formula, part by part: arguments of roots, of logarithms and of other functions with a cut
    lie beside that, and denominators aren't zero.  Roots are SymPy's: x^(1/3) is complex for x < 0.  They are sufficient for
    real symbols; where complex parts cancel, they aren't necessary.  Where the two solutions are dependent, or one of them is
    undefined, is known to the answer that the formula is from.
    What is assumed of symbols is used; `real` is `false` alone where it makes a part complex.  That gamma(a) and other
    functions of parameters alone may have poles isn't said.

    Parameters
    ----------
    solution : ProblemAnswer, sympy.Eq or list of sympy.Eq
        What `answer_to` or `dsolve` returns.  Of an `Eq` that `dsolve` didn't return lately the formula alone is known.
    assume : mapping, optional
        What was assumed of parameters, as given to `dsolve`, whose answer has the user's own symbols: {"k": "positive"}.
        What it excludes isn't said; names that don't occur in the solution are passed over.

    Returns
    -------
    Validity
        `real`, relations, and `exceptions`, expressions in the parameters that must not be zero.  It is false where nothing
        is needed.

    Raises
    ------
    InputError
        For what isn't such an equation.

    Examples
    --------
    >>> import kovacic
    >>> print(kovacic.validity(kovacic.dsolve("x^2*y'' + x*y' - y = log(x)")))
    x > 0
    >>> print(kovacic.validity(kovacic.dsolve("y'' + w^2*y = cos(v*x)")))
    v + w != 0, v - w != 0, w != 0
    >>> bool(kovacic.validity(kovacic.dsolve("y'' + y = x")))
    False
    >>> bool(kovacic.validity(kovacic.dsolve("y'' + k^2*y = 0"), assume={"k": "positive"}))
    False
    """
    if isinstance(solution, ProblemAnswer):
        return solution.validity
    eqs = solution if isinstance(solution, list) else [solution]
    if not all(isinstance(eq, sympy.Equality) and [arg.is_Symbol for arg in eq.lhs.args] == [True] for eq in eqs):
        raise InputError(f"{solution!r} isn't a solution y(x) = ...", hint="give what dsolve returns")
    (x,) = eqs[0].lhs.args
    value = sympy.Tuple(*(eq.rhs for eq in eqs))
    own = {symbol.name: symbol for symbol in value.free_symbols}
    said = {name: what for name, what in (assume or {}).items() if str(name) in own}
    symbols = symbols_that_know(said, own)
    given = given_answer(eqs[0])
    exceptions = [] if given is None else [e.xreplace(given.own).xreplace(symbols) for e in given.pair_exceptions]
    return needed_for(value.xreplace(symbols), x.xreplace(symbols), exceptions)
