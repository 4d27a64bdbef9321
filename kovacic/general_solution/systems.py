"""Systems of two linear equations of first order, by elimination.

For x' = a x + b y + f, y' = c x + d y + g with b != 0 the second unknown is y = (x' - a x - f)/b, and x satisfies

    x'' - (a + d + b'/b) x' + (a d - b c - a' + a b'/b) x = f' + b g - (d + b'/b) f.                                   (1)

With b = 0 the first equation stands alone, and the second one is linear in y.  Values x(t0), y(t0) are x(t0) and
x'(t0) = a x + b y + f there; where b(t0) = 0 equation (1) is singular though the system isn't.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any

import sympy
from sympy import Add, Tuple, cancel
from sympy.core.function import AppliedUndef
from sympy.solvers.ode.systems import ODEOrderError, linear_ode_to_matrix
from sympy.solvers.solveset import NonlinearError

from kovacic.closed_form.steps import JUMPING, in_steps, split_at_jumps
from kovacic.equation import eliminated
from kovacic.errors import InputError, NotLinear, UnsatisfiableConditions
from kovacic.general_solution.answer import vanishes_with
from kovacic.general_solution.conditions import symbols_of
from kovacic.general_solution.constants import CaseOutcome, Row, determine
from kovacic.general_solution.first_order import (
    LINEAR,
    CheckedSolution,
    FirstOrderEquation,
    OfFirstOrder,
    Solver,
    check_first_order,
    is_unit,
    solved_linear,
    with_letters_for_constants,
    zeros_of,
)
from kovacic.general_solution.question import free_constants
from kovacic.general_solution.substitution import exact_decimals, inverted, size, slope
from kovacic.general_solution.textbook import in_book_form, sums
from kovacic.general_solution.validity import ZeroSet
from kovacic.general_solution.zero import is_zero
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types


class LinearSystem(OfFirstOrder):
    """x' = a x + b y + f, y' = c x + d y + g: `functions` is (x(t), y(t)), `entries` are a, b, c, d, f, g."""

    def slopes(self) -> tuple[Expr, ...]:
        a, b, c, d, f, g = self.entries
        x, y = self.functions
        return a * x + b * y + f, c * x + d * y + g

    @property
    def swapped(self) -> LinearSystem:
        """The system with y before x."""
        a, b, c, d, f, g = self.entries
        return replace(self, functions=self.functions[::-1], entries=(d, c, b, a, g, f))

    @property
    def equation(self) -> Expr:
        """Equation (1) for the first unknown, b not zero."""
        a, b, c, d, f, g = self.entries
        x, t = self.functions[0], self.x
        first, zeroth = map(cancel, eliminated(((a, b), (c, d)), t))
        right = f.diff(t) + b * g - (d + cancel(b.diff(t) / b)) * f
        return sympy.Eq(x.diff(t, 2) + first * x.diff(t) + zeroth * x, right)

    def second(self, x: Expr) -> Expr:
        """The second unknown, from the first one, b not zero."""
        a, b, _, _, f, _ = self.entries
        y = sympy.expand_mul((slope(x, self.x) - a * x - f) / b, deep=False)
        integrals, plain = sympy.sift(Add.make_args(y), lambda term: term.has(sympy.Integral), binary=True)
        if integrals:  # their integrands in x' cancel: exp(t) exp(t^3 - t) is exp(t^3)
            joined = sympy.powsimp(Add(*plain)).replace(sympy.exp, lambda power: sympy.exp(sympy.expand(power)))
            y = Add(*integrals, joined)
        apart = split_at_jumps(y, self.x) if y.has(sympy.DiracDelta) else None
        # H u has the slope H u' + u(a) delta, where u(a) is zero or what an impulse in f brings.
        if apart and all(is_zero(strength) for here in apart.impulses.values() for strength in here.values()):
            return apart.without_impulses(self.x)
        return y

    def alone(self, other: Expr) -> FirstOrderEquation:
        """The equation of the first unknown, with its conditions, for a known second one."""
        a, b, _, _, f, _ = self.entries
        x = self.functions[0]
        of_x = tuple(condition for condition in self.conditions if condition.function == x)
        return FirstOrderEquation((x,), (sympy.expand(b * other + f), a, *LINEAR), of_x)

    @property
    def values(self) -> tuple[Expr, Expr, Expr] | None:
        """t0, x(t0) and y(t0), if these are given."""
        values = {condition.function: (condition.points[0], condition.value) for condition in self.conditions}
        if len(self.conditions) != 2 or len(values) != 2:
            return None
        (point, first), (other, second) = (values[f] for f in self.functions)
        return (point, first, second) if point == other else None


def read_system(equations: Sequence[Any], functions: Sequence[Any] | None) -> LinearSystem:
    """The system of two SymPy equations, or expressions that are zero.  Raises `InputError` for anything else."""
    if len(equations) != 2:
        raise InputError(
            f"{len(equations)} equations: systems of two equations of first order are solved here",
            hint="for larger systems call sympy.dsolve",
        )
    if not all(isinstance(equation, sympy.Basic) for equation in equations):
        raise InputError("a system is two SymPy equations, or one text with a comma between them")
    whole = [exact_decimals(e.lhs - e.rhs if isinstance(e, sympy.Equality) else e) for e in equations]
    x, y = _unknowns(whole, functions)
    t = x.args[0]
    try:
        (mass, A), b = linear_ode_to_matrix(whole, [x, y], t, 1)
    except ODEOrderError:
        hint = "for higher order call sympy.dsolve"
        raise InputError("a system of equations of first order is expected", hint=hint) from None
    except NonlinearError:
        hint = "the equations are x' = a x + b y + f, y' = c x + d y + g"
        raise NotLinear("the system isn't linear in its unknowns", hint=hint) from None
    determinant = cancel(mass.det())
    if determinant == 0:
        raise InputError("the equations don't determine both derivatives", hint="for such systems call sympy.dsolve")
    inverse = mass.adjugate() / determinant
    matrix, right = ((inverse * part).applyfunc(cancel) for part in (A, b))
    return LinearSystem((x, y), (*matrix, *(in_steps(e, t) for e in right)))


def _unknowns(whole: Sequence[Expr], functions: Sequence[Any] | None) -> tuple[Expr, Expr]:
    """x(t) and y(t): those that are given, or the functions that are differentiated."""
    system = Tuple(*whole)
    found = [*(functions or sorted({e.expr for e in system.atoms(sympy.Derivative)}, key=str))]
    if len(found) != 2 or not all(isinstance(f, AppliedUndef) and len(f.args) == 1 for f in found):
        raise InputError("two unknown functions are expected", hint="give them as func=[x(t), y(t)]")
    x, y = found
    if x.args != y.args:
        raise InputError(f"{x} and {y} have different variables")
    others = {f for f in system.atoms(AppliedUndef) if f.func in (x.func, y.func)} - {x, y}
    if others:
        raise NotLinear(f"{min(others, key=str)} and {x} have different arguments, as in a delay equation")
    return x, y


def solved_system(given: LinearSystem, solver: Solver) -> CheckedSolution:
    """x(t) and y(t), put into both equations.  Raises `UnsatisfiableConditions` for values that no solution has."""
    for condition in given.conditions:
        if not condition.is_value or condition.terms[0].order:
            raise InputError(f"{condition.text}: a system has values of its unknowns")
    is_swapped = _is_swapped(given)
    system = given.swapped if is_swapped else given
    without_values = replace(system, conditions=())
    t, b, values = system.x, system.entries[1], system.values
    taken = Tuple(t, *system.entries).free_symbols | symbols_of(system.conditions)
    zeros: list[Expr] = []
    exceptions: list[Expr] = []
    scale = sympy.S.One
    is_open = bool(system.conditions)  # the values are put in afterwards
    if b == 0:
        is_open = len(system.swapped.alone(sympy.S.Zero).conditions) > 1  # two values of y determine x
        triangular = without_values if is_open else system
        first = solved_linear(triangular.alone(sympy.S.Zero), taken)
        second = solved_linear(triangular.swapped.alone(*first.values), taken | first.values[0].free_symbols)
        pair, notices = Tuple(*first.values, *second.values), first.notices + second.notices
    elif values is not None and is_unit(b, t, values[0]):
        is_open = False
        pair, notices = _through_values(system, values, solver)
    else:
        answer = solver(system.equation, system.functions[0], {})
        x, _ = with_letters_for_constants(answer, taken)
        pair, notices = Tuple(x, system.second(x)), answer.notices
        exceptions = [e.xreplace(answer.own) for e in answer.pair_exceptions]
        scale = answer.basis.scale
    constants = sorted(pair.free_symbols - taken, key=str)
    if is_open:
        pair, zeros = _with_constants(system, pair, constants, scale)
    left = [constant for constant in constants if pair.has(constant)]
    if is_open:  # a constant that is left stands before solutions that may vanish with the Wronskian
        functions_left = [sympy.Matrix(pair).diff(constant) for constant in left]
        exceptions = [e for e in exceptions if any(vanishes_with(e, *solutions) for solutions in functions_left)]
    renamed = dict(zip(left, free_constants(len(left), *taken, *system.functions), strict=True))
    x, y = (_with_constants_apart(e, renamed.values(), t) for e in pair.xreplace(renamed))
    found = zeros_of(Tuple(x, y), t, system.entries, exceptions)
    found += [zero for zero in zeros if not {*ZeroSet(zero).factors} <= {*found}]
    plain_x, plain_y = map(_with_plain_integrals, (x, y))
    notices += check_first_order(without_values.alone(plain_y), plain_x)
    notices += check_first_order(without_values.swapped.alone(plain_x), plain_y)
    return CheckedSolution((y, x) if is_swapped else (x, y), notices, found, tuple(exceptions))


def _with_plain_integrals(e: Expr) -> Expr:
    """Integrals of sums term by term, without constant factors: those in x and in y have the same constants then."""

    def by_terms(integral: Expr) -> Expr:
        terms = Add.make_args(sympy.expand(integral.function))
        return Add(*(sympy.factor_terms(sympy.Integral(term, *integral.limits)) for term in terms))

    return e.replace(lambda u: isinstance(u, sympy.Integral), by_terms)


def _with_constants_apart(value: Expr, constants: Collection[Expr], t: Expr) -> Expr:
    """A short form of a solution, in which terms with free constants stand apart from the others."""
    if not value.has(*constants):
        return in_book_form(value, t)
    homogeneous = Add(*(constant * value.diff(constant) for constant in constants))
    rest = value.subs(dict.fromkeys(constants, 0))
    return Add(*(shortest([*sums(part, t)]) for part in (homogeneous, rest)))


def _is_swapped(system: LinearSystem) -> bool:
    """True if y is solved for first: if b is zero at the values, if f isn't smooth and g is, or if c is simpler than b."""
    _, b, c, _, *right = system.entries
    if b == 0 or c == 0:
        return bool(b != 0)  # the unknown whose equation stands alone comes first
    if system.values is not None:
        of_y, of_x = (is_unit(e, system.x, system.values[0]) for e in (b, c))
        if of_y != of_x:
            return of_x
    is_rough, other_is_rough = (bool(r.has(AppliedUndef, *JUMPING)) for r in right)
    return is_rough > other_is_rough or (is_rough == other_is_rough and size(c) < size(b))


def _through_values(system: LinearSystem, values: tuple[Expr, Expr, Expr], solver: Solver) -> tuple[Expr, list[str]]:
    """The solution with x(t0) and y(t0), where b(t0) isn't zero."""
    point, first, second = values
    x, y = system.functions
    slope_there = system.slopes()[0].xreplace({x: first, y: second}).subs(system.x, point)
    letters = {f: sympy.Dummy() for f in slope_there.atoms(AppliedUndef)}  # g(t0), for a given function g
    ics = {x.subs(system.x, point): first, x.diff().subs(system.x, point): slope_there.xreplace(letters)}
    answer = solver(system.equation, x, ics)
    solution = answer.eq.rhs.xreplace(inverted(letters))
    return Tuple(solution, system.second(solution)), answer.notices


def _with_constants(
    system: LinearSystem, pair: Expr, constants: Sequence[Expr], scale: Expr
) -> tuple[Expr, list[Expr]]:
    """The pair with the constants that the values determine, and expressions that are zero for exceptional parameters.

    Where `scale` is zero the solutions are dependent, which isn't a case of the values.
    """
    c1, c2 = constants
    rows = []
    for condition in system.conditions:
        there = condition.of(pair[system.functions.index(condition.function)], system.x)
        rows.append(Row(there.diff(c1), there.diff(c2), condition.value - there.subs({c1: 0, c2: 0})))
    generic, others, _ = determine(rows, (c1, c2), scale=scale)
    if generic.outcome is CaseOutcome.NONE:
        raise UnsatisfiableConditions("there is no solution with these values: the conditions contradict one another")
    values = dict(zip(constants, generic.values, strict=True))
    zeros = [zero for case in others if case.is_possible for zero in case.zeros]
    return pair.subs(values, simultaneous=True), zeros
