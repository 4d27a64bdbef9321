"""Systems of two linear equations of first order, by a cyclic vector.

For x' = a x + b y + f, y' = c x + d y + g with b != 0 the second unknown is y = (x' - a x - f)/b, and x satisfies

    x'' - (a + d + b'/b) x' + (a d - b c - a' + a b'/b) x = f' + b g - (d + b'/b) f.                                   (1)

With b = 0 the first equation stands alone, and the second one is linear in y.  Values x(t0), y(t0) are x(t0) and
x'(t0) = a x + b y + f there; where b(t0) = 0 equation (1) is singular though the system isn't.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any

import sympy
from sympy.core.function import AppliedUndef
from sympy.solvers.ode.systems import ODEOrderError, linear_ode_to_matrix
from sympy.solvers.solveset import NonlinearError

from kovacic.equation import eliminated
from kovacic.errors import InputError, NotLinear
from kovacic.general_solution.answer import ProblemAnswer, SystemAnswer, vanishes_with
from kovacic.general_solution.behaviour import value_at
from kovacic.general_solution.constants import Outcome, Row, determine
from kovacic.general_solution.first_order import (
    FirstOrderEquation,
    check_first_order,
    is_unit,
    solved_linear,
    zeros_of,
)
from kovacic.general_solution.question import (
    Condition,
    ConditionReader,
    conditions_at,
    exact,
    free_constants,
    known_letters,
)
from kovacic.general_solution.steps import JUMPING, in_steps, taken_apart
from kovacic.general_solution.substitution import size, slope
from kovacic.general_solution.textbook import in_book_form, sums
from kovacic.general_solution.zero import is_zero
from kovacic.general_solution.zero_set import ZeroSet
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types
#: `answer_to`, for one equation.
Solver = Callable[..., ProblemAnswer]
#: What holds where one of some expressions is zero; takes these, the problem for values of letters, and the formulas.
There = Callable[..., Iterable[str]]


@dataclass(frozen=True)
class LinearSystem:
    """u' = A u + r: `functions` is (x(t), y(t)), `matrix` ((a, b), (c, d)), `right` (f, g)."""

    functions: tuple[Expr, Expr]
    matrix: tuple[tuple[Expr, Expr], tuple[Expr, Expr]]
    right: tuple[Expr, Expr]

    @property
    def t(self) -> Expr:
        return self.functions[0].args[0]

    @property
    def entries(self) -> tuple[Expr, ...]:
        """Those of the matrix, and the right-hand sides."""
        return (*self.matrix[0], *self.matrix[1], *self.right)

    @property
    def letters(self) -> dict[str, Expr]:
        """The symbols in these, by name."""
        return {symbol.name: symbol for symbol in sympy.Tuple(*self.entries).free_symbols}

    def in_symbols(self, others: Mapping[Expr, Expr]) -> LinearSystem:
        """The system in other symbols."""
        x, y, a, b, c, d, f, g = (e.xreplace(others) for e in (*self.functions, *self.entries))
        return LinearSystem((x, y), ((a, b), (c, d)), (f, g))

    def at(self, values: Mapping[Expr, Expr]) -> tuple[Expr, ...]:
        """The equations for particular values of letters, as expressions that are zero."""
        unknowns = zip(self.functions, self.matrix, self.right, strict=True)
        x, y = self.functions
        return tuple(u.diff(self.t) - (a * x + b * y + f).subs(values) for u, (a, b), f in unknowns)

    @property
    def swapped(self) -> LinearSystem:
        """The system with y before x."""
        (a, b), (c, d) = self.matrix
        return LinearSystem(self.functions[::-1], ((d, c), (b, a)), self.right[::-1])

    @property
    def equation(self) -> Expr:
        """Equation (1) for the first unknown, b not zero."""
        (_, b), (_, d) = self.matrix
        f, g = self.right
        x, t = self.functions[0], self.t
        first, zeroth = map(sympy.cancel, eliminated(self.matrix, t))
        right = f.diff(t) + b * g - (d + sympy.cancel(b.diff(t) / b)) * f
        return sympy.Eq(x.diff(t, 2) + first * x.diff(t) + zeroth * x, right)

    def second(self, x: Expr) -> Expr:
        """The second unknown where the first one is x, b not zero."""
        (a, b), _ = self.matrix
        y = sympy.expand_mul((slope(x, self.t) - a * x - self.right[0]) / b, deep=False)
        integrals, plain = sympy.sift(sympy.Add.make_args(y), lambda term: term.has(sympy.Integral), binary=True)
        if integrals:  # the integrands that are left of their slopes cancel: exp(t) exp(t^3 - t) is exp(t^3)
            joined = sympy.powsimp(sympy.Add(*plain)).replace(sympy.exp, lambda power: sympy.exp(sympy.expand(power)))
            y = sympy.Add(*integrals, joined)
        apart = taken_apart(y, self.t) if y.has(sympy.DiracDelta) else None
        if apart is None:
            return y
        # H u has the slope H u' + u(a) delta, where u(a) is zero or what an impulse in f brings.
        if not all(is_zero(strength) for here in apart.impulses.values() for strength in here.values()):
            return y
        return apart.without_impulses(self.t)

    def alone(self, number: int, other: Expr) -> FirstOrderEquation:
        """The equation of one unknown where the other one is known."""
        row = self.matrix[number]
        rest = sympy.expand(row[1 - number] * other + self.right[number])
        return FirstOrderEquation(self.functions[number], rest, row[number], sympy.Integer(0))


def read_system(equations: Sequence[Any], functions: Sequence[Any] | None) -> LinearSystem:
    """The system that two SymPy equations, or expressions that are zero, are.  Raises `InputError` for anything else."""
    if len(equations) != 2:
        raise InputError(
            f"{len(equations)} equations: systems of two equations of first order are solved here",
            hint="for larger systems call sympy.dsolve",
        )
    if not all(isinstance(equation, sympy.Basic) for equation in equations):
        raise InputError("a system is two SymPy equations, or one text with a comma between them")
    whole = [exact(e.lhs - e.rhs if isinstance(e, sympy.Equality) else e) for e in equations]
    x, y = _unknowns(whole, functions)
    t = x.args[0]
    try:
        (mass, A), b = linear_ode_to_matrix(whole, [x, y], t, 1)
    except ODEOrderError:
        raise InputError(
            "a system of equations of first order is expected", hint="for higher order call sympy.dsolve"
        ) from None
    except NonlinearError:
        raise NotLinear(
            "the system isn't linear in its unknowns", hint="the equations are x' = a x + b y + f, y' = c x + d y + g"
        ) from None
    determinant = sympy.cancel(mass.det())
    if determinant == 0:
        raise InputError("the equations don't determine both derivatives", hint="for such systems call sympy.dsolve")
    inverse = mass.adjugate() / determinant
    (first, second), right = (inverse * A).applyfunc(sympy.cancel).tolist(), (inverse * b).applyfunc(sympy.cancel)
    f, g = (in_steps(e, t) for e in right)
    return LinearSystem((x, y), ((first[0], first[1]), (second[0], second[1])), (f, g))


def _unknowns(whole: Sequence[Expr], functions: Sequence[Any] | None) -> tuple[Expr, Expr]:
    """x(t) and y(t): those that are given, or the functions that are differentiated."""
    differentiated = {e.expr for w in whole for e in w.atoms(sympy.Derivative)}
    found = [*(functions or sorted(differentiated, key=str))]
    if len(found) != 2 or not all(isinstance(f, AppliedUndef) and len(f.args) == 1 for f in found):
        raise InputError("two unknown functions are expected", hint="give them as func=[x(t), y(t)]")
    if found[0].args != found[1].args:
        raise InputError(f"{found[0]} and {found[1]} have different variables")
    kinds = {f.func for f in found}
    others = {f for w in whole for f in w.atoms(AppliedUndef) if f.func in kinds} - {*found}
    if others:
        said = f"{min(others, key=str)} and {found[0]} have different arguments, as in a delay equation"
        raise NotLinear(said)
    return found[0], found[1]


def solved_system(
    system: LinearSystem, ics: Mapping[Any, Any], assume: Mapping[Any, Any], solver: Solver, there: There
) -> SystemAnswer:
    """[Eq(x(t), ...), Eq(y(t), ...)], put into both equations and into the values, and what is to be said beside.

    Raises `InputError` for values that no solution has, and `NotImplementedError` where nothing is found.
    """
    functions = system.functions
    conditions = _conditions(system, ics)
    known = known_letters(assume, system.t, system.letters, [condition for _, condition in conditions])
    system = system.in_symbols(known)
    conditions = [(number, condition.in_symbols(known)) for number, condition in conditions]
    if _is_swapped(system, _initial_values(conditions)):
        system = system.swapped
        conditions = [(1 - number, condition) for number, condition in conditions]
    own = sympy.Tuple(*system.entries, system.t).free_symbols
    given = own.union(*(condition.free_symbols for _, condition in conditions))
    asked = [(system.functions[number], condition) for number, condition in conditions]
    start = _initial_values(conditions)
    (_, b), _ = system.matrix
    exceptions: list[Expr] = []
    of_values: list[Expr] = []
    if b == 0 and sum(number for number, _ in conditions) > 1:  # two values of y determine x
        pair, notices = _one_after_the_other(system, [], own)
    elif b == 0:
        pair, notices = _one_after_the_other(system, conditions, given)
        own = given
        conditions = []
    elif start is not None and is_unit(b, system.t, start[0]):
        pair, notices = _through_values(system, start, solver)
        own = given
        conditions = []
    else:
        answer = solver(system.equation, system.functions[0], ics={})
        notices = answer.notices
        pair = sympy.Tuple(answer.eq.rhs, system.second(answer.eq.rhs))
        exceptions = [e.xreplace(answer.own) for e in answer.pair_exceptions]
    constants = sorted(pair.free_symbols - own, key=str)
    if conditions:
        pair, of_values = _with_constants(system, pair, constants, conditions)
    left = [constant for constant in constants if pair.has(constant)]
    if conditions:  # a constant that is left stands before solutions that may vanish with the Wronskian
        functions_left = [[solution.diff(constant) for solution in pair] for constant in left]
        exceptions = [e for e in exceptions if any(vanishes_with(e, *solutions) for solutions in functions_left)]
    renamed = dict(zip(left, free_constants(len(left), *given, *functions), strict=True))
    pair = sympy.Tuple(*(_with_constants_apart(e, renamed.values(), system.t) for e in pair.xreplace(renamed)))
    eqs = [sympy.Eq(f, solution, evaluate=False) for f, solution in zip(system.functions, pair, strict=True)]

    def at(values: Mapping[Expr, Expr]) -> tuple[tuple[Expr, ...], tuple[Expr, Expr], dict[Expr, Any]]:
        return system.at(values), system.functions, conditions_at(values, asked)

    zeros = zeros_of(pair, system.t, system.entries, exceptions)
    zeros += [zero for zero in of_values if not {*ZeroSet(zero).factors} <= {*zeros}]
    notices += [f"this holds unless {said}" for said in there(zeros, at, eqs)]
    for number, solution in enumerate(pair):
        notices += check_first_order(system.alone(number, pair[1 - number]), solution, ())
    found = dict(zip(system.functions, pair, strict=True))
    users = {symbol: user for user, symbol in known.items()}
    eqs = [sympy.Eq(f, found[f.xreplace(known)].xreplace(users), evaluate=False) for f in functions]
    return SystemAnswer(eqs, [*dict.fromkeys(notices)], known=known, exceptional=tuple(exceptions))


def _one_after_the_other(
    system: LinearSystem, conditions: Sequence[tuple[int, Condition]], taken: Set[Expr]
) -> tuple[Expr, list[str]]:
    """For b = 0: x from its own equation and value, then y, whose equation has what is left of x in it."""
    of_x, of_y = ([condition for k, condition in conditions if k == number] for number in (0, 1))
    first = solved_linear(system.alone(0, sympy.Integer(0)), of_x, taken)
    x = first.eq.rhs
    second = solved_linear(system.alone(1, x), of_y, taken | x.free_symbols)
    return sympy.Tuple(x, second.eq.rhs), [*first.notices, *second.notices]


def _with_constants_apart(value: Expr, constants: Collection[Expr], t: Expr) -> Expr:
    """In a short form, the terms with free constants, in which it is linear, apart from the others."""
    if not value.has(*constants):
        return in_book_form(value, t)
    homogeneous = sympy.Add(*(constant * value.diff(constant) for constant in constants))
    rest = value.subs(dict.fromkeys(constants, 0))
    return sympy.Add(*(shortest([*sums(part, t)]) for part in (homogeneous, rest)))


def _is_swapped(system: LinearSystem, start: tuple[Expr, Expr, Expr] | None) -> bool:
    """True if x is eliminated instead: if b is zero there, if f jumps or isn't known and g is, or if c is simpler than b."""
    (_, b), (c, _) = system.matrix
    if b == 0 or c == 0:
        return bool(b != 0)  # the unknown whose equation stands alone comes first
    if start is not None and is_unit(b, system.t, start[0]) != is_unit(c, system.t, start[0]):
        return is_unit(c, system.t, start[0])
    is_rough, other_is_rough = (bool(r.has(AppliedUndef, *JUMPING)) for r in system.right)
    return is_rough > other_is_rough or (is_rough == other_is_rough and size(c) < size(b))


def _through_values(system: LinearSystem, start: tuple[Expr, Expr, Expr], solver: Solver) -> tuple[Expr, list[str]]:
    """The solution with x(t0) and y(t0), where b(t0) isn't zero."""
    point, first, second = start
    x, t = system.functions[0], system.t
    (a, b), _ = system.matrix
    start_slope = (a * first + b * second + system.right[0]).subs(t, point)
    letters = {f: sympy.Dummy() for f in start_slope.atoms(AppliedUndef)}  # g(t0), for a given function g
    ics = {x.subs(t, point): first, x.diff(t).subs(t, point): start_slope.xreplace(letters)}
    answer = solver(system.equation, x, ics=ics)
    solution = answer.eq.rhs.xreplace({letter: f for f, letter in letters.items()})
    return sympy.Tuple(solution, system.second(solution)), answer.notices


# ------------------------------------------------------------------------------------------------------------- values


def _conditions(system: LinearSystem, ics: Mapping[Any, Any]) -> list[tuple[int, Condition]]:
    """Each with the number of the unknown that it is about.  Raises `InputError` for conditions that aren't values."""
    found = []
    for key, value in ics.items():
        name = str(key.func) if isinstance(key, AppliedUndef) else str(key).partition("(")[0].strip()
        names = [str(f.func) for f in system.functions]
        if name not in names:
            raise InputError(f"{key} isn't a value of an unknown", hint=f"write {names[0]}(0) = 1, {names[1]}(0) = 0")
        number = names.index(name)
        condition = ConditionReader(system.functions[number], name).read(key, value)
        if not condition.is_value or condition.terms[0].order:
            raise InputError(f"{condition.text}: a system has values of its unknowns")
        found.append((number, condition))
    return found


def _initial_values(conditions: Sequence[tuple[int, Condition]]) -> tuple[Expr, Expr, Expr] | None:
    """t0, x(t0) and y(t0), if these are given."""
    values = {number: (condition.points[0], condition.value) for number, condition in conditions}
    if len(conditions) != 2 or len(values) != 2 or values[0][0] != values[1][0]:
        return None
    return values[0][0], values[0][1], values[1][1]


def _with_constants(
    system: LinearSystem,
    pair: Expr,
    constants: Sequence[Expr],
    conditions: Sequence[tuple[int, Condition]],
) -> tuple[Expr, list[Expr]]:
    """With the constants that the values determine, and expressions in parameters that are zero where that is otherwise."""
    c1, c2 = constants
    rows = []
    for number, condition in conditions:
        there = value_at(pair[number], system.t, condition.points[0])
        rows.append(Row(there.diff(c1), there.diff(c2), condition.value - there.subs({c1: 0, c2: 0})))
    generic, others, _ = determine(rows, (c1, c2))
    if generic.outcome is Outcome.NONE:
        raise InputError("there is no solution with these values: the conditions contradict one another")
    values = dict(zip(constants, generic.values, strict=True))
    zeros = [zero for case in others if case.is_possible for zero in case.zeros]
    return pair.subs(values, simultaneous=True), zeros
