"""The answer of `dsolve` beyond an `Eq`: the pair, a particular solution, where they hold, and the exceptional cases."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import sympy

from kovacic.closed_form.check import letter_samples
from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.constants import Determined
from kovacic.general_solution.first_order import FirstOrderEquation
from kovacic.general_solution.question import Question, with_assumptions
from kovacic.general_solution.substitution import size
from kovacic.general_solution.validity import NOT_NEGATIVE, Need, Validity, ZeroSet, gamma_zeros, needed_for
from kovacic.general_solution.zero import differs_from_zero

Expr = Any  # SymPy publishes no types
#: The last answers, the newest first, for `validity` of their equations.
_GIVEN: deque[ProblemAnswer] = deque(maxlen=100)


@dataclass(frozen=True)
class Exceptional:
    """Particular values of a letter, for which the two solutions of an answer are dependent or undefined."""

    #: The values in words: "c = 1", "c is a positive integer".
    where: str
    #: A letter and its value; or one of its values as an example, and assumptions on it, as for `dsolve`.
    values: Mapping[Expr, Expr] = field(default_factory=dict)
    example: Mapping[Expr, Expr] = field(default_factory=dict, kw_only=True)
    assume: Mapping[str, str] = field(default_factory=dict)
    _ask: Callable[[Exceptional], ProblemAnswer] | None = field(default=None, repr=False, compare=False)

    @cached_property
    def answer(self) -> ProblemAnswer | None:
        """The answer for these values, or None if none is found."""
        if self._ask is None or not (self.values or self.assume):
            return None
        with suppress(InputError, NotImplementedError):
            return self._ask(self)
        return None

    def __str__(self) -> str:
        return self.where


@dataclass(frozen=True, repr=False)
class ProblemAnswer:
    """The answer to an equation with its right-hand side and its values."""

    #: y(x) = ..., what `dsolve` returns.
    eq: Expr
    #: The warnings of `dsolve`.
    notices: list[str]
    #: One sentence per check that could not be carried out.
    unchecked: tuple[str, ...] = field(default=(), kw_only=True)
    #: Symbols that carry the assumptions, by the user's own.
    known: Mapping[Expr, Expr] = field(default_factory=dict, kw_only=True)
    #: Exceptions of the pair from which a system or a Riccati equation has its solutions.
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
        """The user's symbols, by those that carry the assumptions."""
        return {symbol: user for user, symbol in self.known.items()}

    @property
    def pair_exceptions(self) -> tuple[Expr, ...]:
        """Where one of these is zero, the two solutions in the answer are dependent or undefined."""
        return self.exceptional

    @property
    def exceptions(self) -> tuple[Exceptional, ...]:
        """The values of letters for which the general solution isn't made of this pair, with the answers there."""
        return ()

    @property
    def hidden_needs(self) -> tuple[Need, ...]:
        """Signs that the solution needs but the formula doesn't show, in symbols that carry the assumptions."""
        return ()

    @cached_property
    def validity(self) -> Validity:
        """Where the formula is real and valid: relations, and exceptional values of parameters."""
        eqs = [eq.xreplace(self.known) for eq in self.equations]
        formulas = [eq.rhs for eq in eqs]
        found = needed_for(formulas, eqs[0].lhs.args[0], self.pair_exceptions, self.hidden_needs)
        return Validity(
            tuple(relation.xreplace(self.own) for relation in found.real),
            tuple(e.xreplace(self.own) for e in found.exceptions),
            found.has_real_parts,
        )


@dataclass(frozen=True, repr=False)
class SecondOrderAnswer(ProblemAnswer):
    """y = C1 y1 + C2 y2 + y0."""

    #: The equation, its conditions, and the user's symbols.
    question: Question
    #: y1 and y2 with their Wronskian, and `exceptions`: expressions that are zero where they are no basis.
    basis: Basis
    #: y0.
    particular: Expr
    #: C1 and C2.
    names: tuple[Expr, Expr]
    #: C1 and C2 by the conditions, for generic letters and for particular ones; None without conditions.
    determined: Determined | None
    #: Answers another question about the same function: `answer_to`.
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
        left = members & value.atoms(sympy.Function)
        found = [*map(self.question.own, self.basis.undefined)] if left else []
        # Without the other series there is an exception only where one that is left has a pole.
        if found and any(isinstance(f, sympy.hyper) for f in members - left):
            below = (self.question.own(b) for f in left for b in getattr(f, "bq", ()))
            found = [zero for b in below if ZeroSet(zero := 1 / sympy.gamma(b))]
        solution = self.question.own(value)
        free = [solution.diff(name) for name in self.names if solution.has(name)]

        def is_exception(zero: Expr) -> bool:
            is_pole = self.eq.has(sympy.gamma) and isinstance(1 / zero, sympy.gamma)
            return is_pole or any(vanishes_with(zero, y) for y in free)

        return (*found, *filter(is_exception, self.basis.dependent))

    @cached_property
    def exceptions(self) -> tuple[Exceptional, ...]:
        if self.determined is not None:
            return ()
        zeros = dict.fromkeys([*self.basis.dependent, *self.basis.exceptions])
        return tuple(replace(case, _ask=self._answer_in) for zero in zeros for case in exceptional_cases(zero))

    def _answer_in(self, case: Exceptional) -> ProblemAnswer:
        """The answer for particular values of letters, or with further assumptions on them."""
        equation, function, _ = self.question.at(case.values)
        return self.ask(equation.xreplace(self.own), function.xreplace(self.own), assume=case.assume)


@dataclass(frozen=True, repr=False)
class FirstOrderAnswer(ProblemAnswer):
    """The answer to an equation of first order, linear or Riccati's, which is stored with its conditions."""

    equation: FirstOrderEquation
    #: w^(1 - n) for a solution of Bernoulli's equation, in symbols that carry the assumptions.
    power_of_w: Expr | None = None

    @property
    def hidden_needs(self) -> tuple[Need, ...]:
        """u >= 0 for w = u^k, k = 1/(1 - n) an integer, which solves Bernoulli's equation only where w^(1/k) is u."""
        n = self.equation.power
        if self.power_of_w is None or n.is_integer or not (1 / (1 - n)).is_integer:
            return ()
        return (Need(sympy.factor(self.power_of_w), NOT_NEGATIVE),)


@dataclass(frozen=True, repr=False)
class SystemAnswer(ProblemAnswer):
    """The answer to a system of two equations, whose `eq` is a list: x(t) = ..., y(t) = ..."""

    eq: list[Expr]

    @property
    def equations(self) -> Sequence[Expr]:
        return self.eq


def exceptional_cases(zero: Expr) -> Iterator[Exceptional]:
    """The values of letters where an expression is zero: one of a letter, or integers, for sin(pi l) and 1/gamma(+-l)."""
    number, signs = zero, []
    if isinstance(zero, sympy.sin):
        number, signs = zero.args[0] / sympy.pi, ["positive", "nonpositive"]
    elif poles := gamma_zeros(zero):
        number, signs = poles[0], ["nonnegative" if poles[1] > 0 else "nonpositive"]
    if signs and number.is_Symbol:
        for sign in (sign for sign in signs if getattr(number, f"is_{sign}") is not False):
            example = {number: sympy.Integer(sign == "positive")}
            yield Exceptional(f"{number} is a {sign} integer", assume={number.name: f"{sign} integer"}, example=example)
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
    """False if in each case in which `zero` is 0 one of the functions is seen to differ from 0."""
    for case in exceptional_cases(zero):
        values = case.values or case.example
        there = [y.subs(values) for y in functions if values]
        if not any(differs_from_zero(y, next(letter_samples(y.free_symbols))) for y in there):
            return True
    return False


def remember(answer: ProblemAnswer) -> None:
    """Keep an answer for `validity` when only its equation is returned."""
    _GIVEN.appendleft(answer)


def given_answer(eq: Expr) -> ProblemAnswer | None:
    """The answer from which `dsolve` returned this equation, or the first one of a system, if it is one of the last."""
    return next((answer for answer in _GIVEN if answer.equations[0] == eq), None)


def validity(solution: Any, assume: Mapping[Any, Any] | None = None) -> Validity:
    """The domain of validity of a solution: where it is real and valid, and exceptional values of parameters.

    The relations are read off the formula, part by part: arguments of roots, logarithms and other functions stay off branch
    cuts, and denominators aren't zero.  Roots are SymPy's: x^(1/3) is complex for x < 0.  They are sufficient for real symbols,
    but not necessary if complex parts cancel.  Where the two solutions are dependent, or one of them is undefined, is known
    only for answers of `dsolve`.
    Assumptions on symbols are used; `real` is `false` alone if they make a part complex.  Poles of gamma(a) and other functions
    of parameters alone aren't mentioned.

    Parameters
    ----------
    solution : ProblemAnswer, sympy.Eq or list of sympy.Eq
        An answer of `answer_to` or `dsolve`.  For another `Eq`, or one of long ago, the formula alone is examined.
    assume : mapping, optional
        Assumptions on parameters, as given to `dsolve`, whose answer has the user's own symbols: {"k": "positive"}.
        Cases that they exclude aren't mentioned; names that don't occur in the solution are ignored.

    Returns
    -------
    Validity
        `real`, relations, and `exceptions`, expressions in the parameters that must not be zero.  It is false if there are
        none.

    Raises
    ------
    InputError
        If `solution` isn't such an equation.

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
    symbols = with_assumptions({name: words for name, words in (assume or {}).items() if str(name) in own}, own)
    given = given_answer(eqs[0])
    exceptions, relations = (
        [] if given is None else [e.xreplace(given.own).xreplace(symbols) for e in getattr(given, beside)]
        for beside in ("pair_exceptions", "hidden_needs")
    )
    return needed_for(value.xreplace(symbols), x.xreplace(symbols), exceptions, relations)
