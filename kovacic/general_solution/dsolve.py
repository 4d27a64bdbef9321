"""`dsolve`: linear equations of second order, a y'' + b y' + c y = f, with conditions: y = C1 y1 + C2 y2 + y0.

Riccati equations are made linear, and back, in `riccati`.

The steps, each in a module of this package:

1. `question`: the equation, the unknown function, its `conditions`, and the user's own symbols;
2. `homogeneous`: a `basis` y1, y2 of the solutions for f = 0, by Kovacic's algorithm or in special functions;
3. `particular`: one solution y0;
4. `determined`: linear conditions on y are linear equations for C1 and C2, solved by rank in `constants`;
5. `check`: the whole is put into the equation and into the conditions;
6. C1 y1 + C2 y2 + y0 as SymPy's `Eq`, in the user's symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import sympy
from sympy import Eq, Mul

from kovacic.closed_form.cuts import arguments_with_cuts, common_place
from kovacic.decision import Status
from kovacic.equation import EULER
from kovacic.errors import InputError, LimitExceeded, UnsatisfiableConditions, warn_user
from kovacic.general_solution.answer import (
    Exceptional,
    FirstOrderAnswer,
    ProblemAnswer,
    SecondOrderAnswer,
    SystemAnswer,
    exceptional_cases,
    remember,
)
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.boundary_problems import eigenfunctions
from kovacic.general_solution.check import check_answer
from kovacic.general_solution.conditions import apart, symbols_of
from kovacic.general_solution.constants import CaseOutcome, Determined, ParameterCase, constants_of
from kovacic.general_solution.first_order import FirstOrderEquation, read_first_order, solved_linear
from kovacic.general_solution.homogeneous import find_basis, no_solution
from kovacic.general_solution.particular import (
    particular_solution,
    right_hand_side,
    starting_at,
    with_letters_of_integration,
)
from kovacic.general_solution.places import (
    basis_real_at,
    impulses_inside,
    is_singular,
    limit_points,
    one_sided,
    real_particular,
    start_of,
)
from kovacic.general_solution.question import (
    Question,
    about_letters,
    free_constants,
    has_floats,
    known_letters,
    read_question,
    with_floats,
    with_given_values,
)
from kovacic.general_solution.riccati import solved_riccati
from kovacic.general_solution.substitution import inverted
from kovacic.general_solution.systems import LinearSystem, read_system, solved_system
from kovacic.general_solution.textbook import in_book_form, without_homogeneous
from kovacic.general_solution.validity import ZeroSet
from kovacic.general_solution.zero import is_identically_zero
from kovacic.limits import DEFAULT_LIMITS, MOST_CHARACTERS, Budget, Limits, limited
from kovacic.numbers.numerals import as_text
from kovacic.reading.notations import ParserTokens
from kovacic.reading.pieces import Paste
from kovacic.reading.read import declared
from kovacic.reading.symbolic import read_equations

Expr = Any  # SymPy publishes no types
#: The most exceptional cases in which an equation is solved: the solutions in one of three have two exceptions in turn.
_MOST_CASES = 2
#: Names of the only method.
_HINTS = ("default", "best", "kovacic")


@limited
def dsolve(
    eq: Any,
    func: Any = None,
    hint: str = "default",
    simplify: bool = True,
    ics: Mapping[Any, Any] | str | None = None,
    xi: None = None,
    eta: None = None,
    x0: Any = 0,
    n: Any = 6,
    *,
    var: str | None = None,
    parameters: Sequence[str] = (),
    assume: Mapping[Any, Any] | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Any:
    """The general solution of a linear equation of second order as a SymPy `Eq(y(x), ...)` with constants C1 and C2.

    Also that of a linear or Riccati equation w' = p + q w + r w^2, with one constant C1, which may be infinite for Riccati's.

    The result has been put into the equation (numerically, at points) and into the conditions.  With parameters it holds for
    generic values.  The assumptions of the user's symbols (integer, positive, ...) are used throughout.

    Parameters
    ----------
    eq : sympy.Eq, sympy.Expr or str
        The equation, an expression that is zero, or text.  Coefficients may be rational in x, in exp(k x), sines, ... of
        multiples of k x, or in a power x^k.  Every part without x is a constant.  The right-hand side may be any function of
        x, with jumps and impulses at constant points.  y''/y = x is multiplied out.  SymPy's floats are read as the decimals
        that are printed, and the answer has floats then; a decimal in a text is an exact number.  A list of one equation
        gives a list of one answer.
    func : y(x) or y, optional
        The unknown function, if more than one function of x occurs; or a list of it.
    hint : str, optional
        "default", "best" or "kovacic", which mean the same: there is one method.
    simplify, x0, n : optional
        As for `sympy.dsolve`, and without effect.
    ics : mapping or str, optional
        Conditions.  The constants that they determine are found exactly; the others stay free.

        - Values as for `sympy.dsolve`, {y(0): 1, y(x).diff(x).subs(x, 0): 2}, or as text, "y(0)=1, y'(0)=2" or
          {"y(0)": 1, "y'(0)": 2}, at one point or at several.  At an impulse or a step they are those just before it; if a
          parameter may put it on the point, the answer has Heaviside(u, 0), which is 0 there.
        - Linear conditions: periodic, {y(0): y(2*pi)} or "y'(0)=y'(2*pi)"; Robin's, "y'(0)=h*y(0)".
        - At a singular point, and at oo and -oo, y(a) = v says that y tends to v, and y(a) = "bounded" that y is bounded,
          from the side on which the other points are, else from the right: {"y(0)": "bounded", "y(oo)": 0}.
    xi, eta : None
        For compatibility with `sympy.dsolve`: they belong to Lie's method, which isn't used here.
    var : str, optional
        The name of the variable in a text, if it isn't clear.
    parameters : sequence of str, optional
        Names of parameters that have more than one letter, such as "EI" or "mass"; other such names are refused.
    assume : mapping, optional
        Assumptions on parameters, by name, as for `kovacic.solve`: {"n": "natural", "k": "positive", "l": ">=1"}.  They add to
        those of SymPy's symbols.
    limits : Limits, optional
        Bounds on the input and on the work.

    Returns
    -------
    sympy.Eq
        y(x) and the solution; for a system a list.  An integral that isn't found stays an `Integral`.

    Warns
    -----
    UserWarning
        If particular values of parameters give more solutions, or none: with the condition and the solutions then (the
        answer is for the others).  If other solutions are independent for a negative integer: with these.  If special
        functions were taken without a proof that there is no Liouvillian solution, because a limit was reached.  If the
        answer couldn't be checked, because a function can't be evaluated.

    Raises
    ------
    UnsatisfiableConditions
        If no solution has the given values.  It is an `InputError`.
    InputError
        For any other equation, and for points on two sides of a singular point.  It is a `ValueError`.
    NotImplementedError
        If no solutions are found, with the reason, or a limit was reached; and if a question about a constant, or about the
        behaviour at a singular point, isn't decided.

    Examples
    --------
    >>> print(dsolve("y'' + y = x"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + x)
    >>> print(dsolve("y'' - 2*x*y' + 2*y = 0", ics={"y(0)": 0, "y'(0)": 5}))
    Eq(y(x), 5*x)
    >>> print(dsolve("y'' + y = 0", ics="y(0)=0, y(pi/2)=3"))
    Eq(y(x), 3*sin(x))

    Eigenfunctions, with the user's own integer:

    >>> import sympy
    >>> x, n = sympy.Symbol("x"), sympy.Symbol("n", integer=True, positive=True)
    >>> y = sympy.Function("y")
    >>> print(dsolve(y(x).diff(x, 2) + n**2 * y(x), ics={y(0): 0, y(sympy.pi): 0}))
    Eq(y(x), C2*sin(n*x))

    >>> print(dsolve("y'' + n^2*y = 0", ics="y(0)=0, y(pi)=0", assume={"n": "natural"}))
    Eq(y(x), C2*sin(n*x))

    Riccati equations:

    >>> print(dsolve("w' = 1 + w^2"))
    Eq(w(x), tan(C1 + x))
    >>> print(dsolve("w' = 2*w/x + w^2", ics="w(1)=1"))
    Eq(w(x), 3*x**2/(4 - x**3))

    Jumps and constants:

    >>> print(dsolve("y'' + y = sign(x)"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + (2 - 2*cos(x))*Heaviside(x) - 1)
    >>> print(dsolve("y'' - exp(2*b)*y = 0"))
    Eq(y(x), C1*exp(x*exp(b)) + C2*exp(-x*exp(b)))

    At singular points and at infinity:

    >>> print(dsolve("x*y'' + y' + x*y = 0", ics="y(0)=1"))
    Eq(y(x), besselj(0, x))
    >>> print(dsolve("y'' - y = 0", ics="y(0)=1, y(oo)=0"))
    Eq(y(x), exp(-x))
    """
    if hint not in _HINTS:
        others = "sympy.dsolve has other methods, and this one after kovacic.register()"
        raise InputError(f"unknown hint {hint!r}; available: {', '.join(_HINTS)}", hint=others)
    if xi is not None or eta is not None:
        raise InputError("xi and eta belong to Lie's method, which isn't used here", hint="call sympy.dsolve")
    answer = answer_to(eq, func, ics=ics, var=var, parameters=parameters, assume=assume, limits=limits)
    for notice in answer.notices:
        warn_user(notice)
    remember(answer)
    return [answer.eq] if isinstance(eq, list | tuple) and not isinstance(answer, SystemAnswer) else answer.eq


def in_special_functions(found: Any, eq: Any, func: Any = None, **given: Any) -> Any:
    """A long solution `found` by `dsolve` in special functions, if they take less than half of its characters; else None."""
    length = len(as_text(found.rhs))
    if length > MOST_CHARACTERS:
        with suppress(NotImplementedError, InputError):
            other = answer_to(eq, func, special=True, **given).eq
            return other if len(as_text(other.rhs)) < length / 2 else None
    return None


@limited
def answer_to(
    eq: Any,
    func: Any = None,
    *,
    ics: Any = None,
    var: str | None = None,
    parameters: Sequence[str] = (),
    assume: Mapping[Any, Any] | None = None,
    limits: Limits = DEFAULT_LIMITS,
    special: bool = False,
) -> ProblemAnswer:
    """The answer of `dsolve` as an object, with the pair it is made of, its domain of validity, and the checks.

    Parameters
    ----------
    eq, func, ics, var, parameters, assume, limits
        As for `dsolve`.
    special : bool
        True for special functions even if there are Liouvillian solutions.

    Returns
    -------
    ProblemAnswer
        Its `eq` is the result of `dsolve`, its `notices` are the warnings of `dsolve`.  For an equation of second order it is a
        `SecondOrderAnswer`, unless an eigenvalue problem with an integer was recognised; for first order a `FirstOrderAnswer`;
        for a system a `SystemAnswer`, whose `eq` is a list.

    Raises
    ------
    InputError, NotImplementedError
        As `dsolve`.

    Examples
    --------
    >>> answer = answer_to("y'' + w^2*y = cos(v*x)")
    >>> answer.basis.y1, answer.basis.y2, answer.basis.wronskian
    (cos(w*x), sin(w*x), w)
    >>> print(answer.validity)
    v + w != 0, v - w != 0, w != 0

    In an exceptional case:

    >>> answer = answer_to("x*y'' + (c - x)*y' - a*y = 0")
    >>> print(answer.validity)
    x > 0, sin(pi*c) != 0
    >>> for case in answer.exceptions:
    ...     print(case, "|", case.answer.eq.rhs)
    c = 1 | C1*hyper((a,), (1,), x) + C2*hyper((a, a), (), -1/x)/x**a
    c is a positive integer | C1*hyper((a,), (c,), x) + C2*hyper((a, a - c + 1), (), -1/x)/x**a
    c is a nonpositive integer | C1*x**(1 - c)*hyper((a - c + 1,), (2 - c,), x) + C2*hyper((a, a - c + 1), (), -1/x)/x**a
    """
    # first, since the answer may take all of the time
    is_of_euler = isinstance(eq, str) and any(_has_euler(tokens) for tokens in Paste(eq).equations)
    eq, ics, assume = with_given_values(eq, ics, assume, limits)
    answer = _Asked(limits, var, parameters, assume, special).answer(eq, func, ics)
    return replace(answer, notices=[f"{EULER} is Euler's number", *answer.notices]) if is_of_euler else answer


def _has_euler(tokens: ParserTokens) -> bool:
    """True for e alone, or with a number as its exponent, which may be meant as a parameter."""
    return any(
        token[:2] == ("NAME", EULER) and (after.text not in ("^", "**") or exponent.kind == "NUMBER")
        for token, after, exponent in zip(tokens, tokens[1:], [*tokens[2:], tokens[-1]], strict=False)
    )


@dataclass(frozen=True)
class _Asked:
    """The settings of a question; `is_exceptional` if it is an exceptional case of another one: then its own are only named."""

    limits: Limits
    var: str | None = None
    parameters: Sequence[str] = ()
    assume: Mapping[Any, Any] = field(default_factory=dict)
    special: bool = False
    is_exceptional: bool = False

    @cached_property
    def budget(self) -> Budget:
        return Budget(self.limits)

    def answer(self, eq: Any, func: Any = None, ics: Any = None) -> ProblemAnswer:
        """The answer for an equation, or a system of two equations of first order: a list, or a text with several."""
        with self.budget.watched():
            try:
                return self._answer(eq, func, ics)
            except LimitExceeded as limit:
                raise NotImplementedError(f"undecided: {limit}") from None

    def _answer(self, eq: Any, func: Any, ics: Any) -> ProblemAnswer:
        names = declared(self.parameters, about_letters(self.assume, self.var))
        guesses: tuple[str, ...] = ()
        if isinstance(eq, str):
            if EULER in names:
                raise InputError(f"{EULER} is Euler's number, and no name of a parameter", hint="take another letter")
            paste = Paste(eq)
            if len(paste.equation_scans) > 1:
                reading = read_equations(paste, names=names)
                eq, func, ics = reading.equations, func or reading.functions, ics or dict(reading.conditions)
                guesses = reading.guesses
        if isinstance(eq, list | tuple) and len(eq) != 1:
            return self._of_first_order(replace(read_system(eq, func), guesses=guesses), eq, ics)
        if isinstance(func, list | tuple) and len(func) != 1:
            said = f"one function is expected, and there are {len(func)}"
            raise InputError(said, hint="for larger systems call sympy.dsolve")
        eq, func = (given[0] if isinstance(given, list | tuple) else given for given in (eq, func))
        try:
            question = read_question(eq, func, ics, self.var, self.limits, self.parameters, self.assume)
        except InputError as reason:
            eq, ics = apart(eq, ics)
            try:
                found = read_first_order(eq, func, self.var, self.limits, names)
            except InputError:
                raise reason from None
            return self._of_first_order(found, eq, ics)
        return self._of_second_order(question)

    def _of_first_order(self, problem: FirstOrderEquation | LinearSystem, eq: Any, ics: Any) -> ProblemAnswer:
        """The answer for one equation, or for two; `eq` is the input."""
        problem = problem.with_values(ics)
        known = known_letters(self.assume, problem.x, problem.letters, problem.conditions)
        problem = problem.in_symbols(known)
        solver = replace(self, var=None, parameters=(), assume={}, special=False).answer
        if isinstance(problem, LinearSystem):
            solved = solved_system(problem, solver)
        else:
            if (problem.q + problem.r).has(sympy.DiracDelta):
                what = f"in {problem.reading} an impulse is multiplied by {problem.function}, which jumps there"
                raise InputError(what, hint="solve the equation on either side, and give the ratio of the values there")
            solved = solved_linear(problem) if problem.r == 0 else solved_riccati(problem, solver)
        eqs = [Eq(f, w, evaluate=False) for f, w in zip(problem.functions, solved.values, strict=True)]
        exceptions = (f"this holds unless {said}" for said in self.where_zero(solved.zeros, problem.at, eqs))
        notices = [*dict.fromkeys([*problem.guesses, *exceptions, *solved.notices])]
        eqs = [eq.xreplace(inverted(known)) for eq in eqs]
        if isinstance(problem, LinearSystem):
            return SystemAnswer(eqs, notices, known=known, exceptional=solved.of_pair)
        (found,) = eqs
        if has_floats(eq, ics):
            found = Eq(found.lhs, with_floats(found.rhs), evaluate=False)
        return FirstOrderAnswer(found, notices, problem, solved.power_of_w, known=known, exceptional=solved.of_pair)

    def _of_second_order(self, question: Question) -> ProblemAnswer:
        """The steps of the head of this module, after the first."""
        question, sides = one_sided(question)
        notices = [*question.guesses, *sides]
        family = eigenfunctions(question)
        if family is not None:
            return ProblemAnswer(question.written(family[0]), notices + family[1], known=question.renamed)
        basis = find_basis(question, self.budget, special=self.special)
        solution = basis.solution
        assert solution is not None
        if solution.status is Status.UNDECIDED and not solution.known:
            notices.append(f"whether there is a Liouvillian solution is {no_solution(solution)}")
        answer = _determined(question, basis, self) if question.conditions else _general(question, basis)
        return replace(answer, notices=notices + answer.notices, known=question.renamed)

    def where_zero(
        self,
        zeros: Iterable[Expr],
        at: Callable[[Mapping[Expr, Expr]], tuple[Any, Any, dict[Expr, Any]]],
        formulas: Sequence[Expr],
        where: str = "",
    ) -> Iterator[str]:
        """Sentences about the solutions where one of `zeros` is zero, in words `where`, unless the `formulas` hold there too.

        `at` gives equation, function and conditions as for `answer_to`, for values of letters.
        """
        sets = [*map(ZeroSet, zeros)]
        places = [(place, factor) for zero in sets for factor in zero.factors for place in exceptional_cases(factor)]
        if self.is_exceptional or len(places) > _MOST_CASES or not all(place.values for place, _ in places):
            left = [where or " or ".join(map(str, sets))] if sets else []
        else:
            left = []
            for place, factor in places:
                said = self._said_at(place, at, formulas)
                if said is None:
                    left.append(str(ZeroSet(factor)))
                elif said:
                    yield f"{place}, where {said}"
        if left:
            yield f"{' or '.join(left)}: substitute such values for the solutions there"

    def _said_at(self, place: Exceptional, at: Callable[..., Any], formulas: Sequence[Expr]) -> str | None:
        """The solutions in one case, "" if the formulas hold there, None if they aren't found in half of the time left."""
        try:
            equation, function, conditions = at(place.values)
            there = _Asked(self.budget.share(0.5).limits, is_exceptional=True).answer(equation, function, conditions)
        except UnsatisfiableConditions:
            return "there is no solution"
        except (InputError, NotImplementedError):
            return None
        if there.notices:
            return None
        here = [Eq(eq.lhs, eq.rhs.subs(place.values), evaluate=False) for eq in formulas]
        letters = sympy.Tuple(equation, *conditions.items()).free_symbols
        if _are_same(here, there.equations, letters):
            return ""
        return ", ".join(f"{eq.lhs} = {eq.rhs}" for eq in there.equations)


@dataclass(frozen=True)
class _Family:
    """c1 y1 + c2 y2 + y0."""

    question: Question
    basis: Basis
    particular: Expr

    @cached_property
    def names(self) -> tuple[Expr, Expr]:
        """C1 and C2, or the next unused names."""
        given = (self.question.function, *map(sympy.Symbol, self.question.symbols))
        given += (self.basis.y1, self.basis.y2, self.particular, *symbols_of(self.question.conditions))
        c1, c2 = free_constants(2, *given)
        return c1, c2

    def member(self, constants: tuple[Expr, Expr]) -> Expr:
        """The solution with these constants in the user's symbols, common factors of y1 and y2 before the sum."""
        first, second = map(Mul.make_args, (self.basis.y1, self.basis.y2))
        common = [factor for factor in first if factor in second and 0 not in constants]
        summands = (
            Mul(constant, *(factor for factor in factors if factor not in common))
            for constant, factors in zip(constants, (first, second), strict=True)
        )
        general = Mul(*common, sympy.Add(*summands)) + self.particular
        return with_letters_of_integration(self.question.own(general))

    def answer(
        self, value: Expr, notices: Sequence[str], unchecked: Sequence[str], determined: Determined | None = None
    ) -> SecondOrderAnswer:
        """The answer with this value, in the user's symbols."""
        rests_on = (self.question, self.basis, self.particular, self.names, determined)
        eq = self.question.written(value)
        if self.basis.natural is not None:  # the others are said, unless their constants are determined
            said = f"this holds for {as_text(self.basis.natural)} >= 0"
            if self.basis.otherwise is None or self.particular != 0 or determined is not None:
                said += ": substitute such values for the solutions elsewhere"
            else:
                other = self.question.written(replace(self, basis=self.basis.otherwise).member(self.names))
                said += f"; elsewhere, {other.lhs} = {other.rhs}"
            notices = [said, *notices]
        return SecondOrderAnswer(eq, [*notices], *rests_on, unchecked=tuple(unchecked), ask=answer_to)

    def said(self, case: ParameterCase, answer: Expr, asked: _Asked) -> Iterable[str]:
        """Sentences about the solutions for particular parameters; the answer is for all others."""
        where = case.where(answer)
        if case.outcome is CaseOutcome.OPEN:
            formula = self.question.written(answer).xreplace(self.question.renamed)
            return asked.where_zero(case.zeros, self.question.at, [formula], where)
        if case.outcome is CaseOutcome.NONE or not all(map(ZeroSet, case.needed)):
            return [f"{where}, where there is no solution"]
        value = self.member(case.values)
        sets = [ZeroSet(zero).factors for zero in case.zeros]
        there = value.subs({factors[0]: 0 for factors in sets if len(factors) == 1 and factors[0].is_Symbol})
        value = value if there.has(sympy.nan, sympy.zoo) else there
        free = [name for name in self.names if value.has(name)]
        value = in_book_form(value, self.question.x, free if len(free) == 2 else ())
        if len(free) == 1:  # a number beside it goes into it
            number = sympy.factor_terms(value.diff(free[0])).as_coeff_Mul()[0]
            value = value.subs(free[0], free[0] / number)
        found = self.question.written(value)
        needed = " and ".join(ZeroSet(zero).equation(answer) for zero in case.needed)
        only = f" there is a solution only if {needed}:" if needed else ""
        return [f"{where}, where{only} {found.lhs} = {found.rhs}"]


def _are_same(formulas: Sequence[Expr], others: Sequence[Expr], letters: Collection[Expr]) -> bool:
    """True for equal formulas, and for one p + C u and q + C v with constant u/v and (p - q)/v; C isn't one of the letters."""
    pairs = [(one.rhs, other.rhs) for one, other in zip(formulas, others, strict=True)]
    x = formulas[0].lhs.args[0]
    constants = {symbol for pair in pairs for e in pair for symbol in e.free_symbols} - {*letters, x}
    if not constants:
        return all(is_identically_zero(one - other) for one, other in pairs)
    if len(constants) > 1 or len(pairs) > 1:
        return False
    (p, u), (q, v) = ((e.subs(dict.fromkeys(constants, 0)), sympy.Add(*map(e.diff, constants))) for e in pairs[0])
    return u != 0 and not any(sympy.simplify(quotient / v).has(x, sympy.nan, sympy.zoo) for quotient in (u, p - q))


def _general(question: Question, basis: Basis) -> SecondOrderAnswer:
    """C1 y1 + C2 y2 + y0, checked."""
    right = right_hand_side(question.equation)
    cuts = arguments_with_cuts(right)
    # The pair of `solve` stays as it is there, and log(x - 2) on the right is real for x > 2.
    is_fixed = question.equation.change is not None or right == 0 or cuts or is_singular(question, sympy.S.Zero)

    def place(*solutions: Expr) -> Expr:
        """Around 0 if the equation is regular there."""
        arguments = arguments_with_cuts(sympy.Tuple(*solutions))
        return common_place(basis.x, cuts, arguments, own=basis.own) if is_fixed else sympy.S.Zero

    if basis.place is None or right != 0:
        basis = basis_real_at(basis, place(basis.y1, basis.y2))
    particular = particular_solution(basis, None)
    if particular != 0:
        particular = real_particular(question, basis, particular, place(basis.y1, basis.y2, particular))
    family = _Family(question, basis, without_homogeneous(particular, basis.y1, basis.y2, basis.x))
    value = in_book_form(family.member(family.names), question.x, family.names)
    unchecked = check_answer(question, value, natural=basis.natural)
    return family.answer(value, unchecked, unchecked)


def _determined(question: Question, basis: Basis, asked: _Asked) -> SecondOrderAnswer:
    """The answer with the constants that the conditions determine.  Raises `UnsatisfiableConditions` if none do."""
    limits = limit_points(question)
    start = start_of(question, limits)
    basis = basis_real_at(basis, start)
    basis = basis.of(*(starting_at(y, question.x, start) for y in (basis.y1, basis.y2)))
    particular = real_particular(question, basis, particular_solution(basis, start), start)
    family = _Family(question, basis, particular)
    steps, orders, letters = impulses_inside(question)
    determined = constants_of(question, basis, particular, family.names, limits, steps)
    generic = determined.generic
    value = family.member(generic.values)
    value = in_book_form(value, question.x, family.names if value.has(*family.names) else ())
    cases = (case for case in determined.particular if case.is_possible)
    exceptions = [said for case in cases for said in family.said(case, value, asked)]
    if generic.outcome is CaseOutcome.NONE:
        said = "there is no solution with these values: the conditions contradict one another"
        singular = [str(point) for point, place in limits.items() if not place.is_infinite]
        if singular:
            said += f" ({' and '.join(singular)} is a singular point of the equation)"
        raise UnsatisfiableConditions(said + (f", unless {'; or '.join(exceptions)}" if exceptions else ""))
    unchecked = check_answer(question, value, start, limits, natural=basis.natural, letters=letters)
    notices = [*orders, *unchecked, *(f"this holds unless {said}" for said in exceptions)]
    return family.answer(value, notices, unchecked, determined)
