"""Systems of two linear equations of first order, by a cyclic vector.

For x' = a x + b y + f, y' = c x + d y + g with b != 0 the second unknown is y = (x' - a x - f)/b, and x satisfies

    x'' - (a + d + b'/b) x' + (a d - b c - a' + a b'/b) x = f' + b g - (d + b'/b) f.                                   (1)

With b = 0 the first equation stands alone, and the second one is linear in y.  Values x(t0), y(t0) are x(t0) and
x'(t0) = a x + b y + f there; where b(t0) = 0 equation (1) is singular though the system isn't.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from typing import Any

import sympy
from flint import acb, arb, fmpq
from sympy.core.function import AppliedUndef

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError, NotLinear, VerificationFailed
from kovacic.general_solution.check import is_finite
from kovacic.general_solution.conditions import Condition, ConditionReader, exact
from kovacic.general_solution.first_order import FirstOrderEquation, exceptions_of, in_short, solved_linear
from kovacic.general_solution.substitution import size
from kovacic.general_solution.values import value_at
from kovacic.general_solution.zero import Zero, samples, when_zero

Expr = Any  # SymPy publishes no types
#: `dsolve` for one equation: its answer, and the notices.
Solver = Callable[..., tuple[Expr, list[str]]]
_POINTS = (acb(fmpq(23, 71), fmpq(41, 89)), acb(fmpq(83, 97), fmpq(-11, 59)))
_SMALL = arb(10) ** (-DIGITS // 2)


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
    def swapped(self) -> LinearSystem:
        """The same system with y before x."""
        (a, b), (c, d) = self.matrix
        return LinearSystem(self.functions[::-1], ((d, c), (b, a)), self.right[::-1])

    @property
    def equation(self) -> Expr:
        """Equation (1) for the first unknown, b not zero."""
        (a, b), (c, d) = self.matrix
        f, g = self.right
        x, t = self.functions[0], self.t
        rate = sympy.cancel(b.diff(t) / b)
        first = sympy.cancel(-(a + d + rate))
        zeroth = sympy.cancel(a * d - b * c - a.diff(t) + a * rate)
        return sympy.Eq(x.diff(t, 2) + first * x.diff(t) + zeroth * x, f.diff(t) + b * g - (d + rate) * f)

    def second(self, x: Expr) -> Expr:
        """The second unknown where the first one is x, b not zero."""
        (a, b), _ = self.matrix
        return (x.diff(self.t) - a * x - self.right[0]) / b

    def second_alone(self, x: Expr) -> FirstOrderEquation:
        """The equation of the second unknown where the first one is x."""
        _, (c, d) = self.matrix
        return FirstOrderEquation(self.functions[1], sympy.expand(c * x + self.right[1]), d, sympy.Integer(0))

    @property
    def first_alone(self) -> FirstOrderEquation:
        """The equation of the first unknown, b zero."""
        return FirstOrderEquation(self.functions[0], self.right[0], self.matrix[0][0], sympy.Integer(0))


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
    if any(e.expr in (x, y) and e.derivative_count != 1 for w in whole for e in w.atoms(sympy.Derivative)):
        raise InputError("a system of equations of first order is expected", hint="for higher order call sympy.dsolve")
    slopes = [x.diff(t), y.diff(t)]
    letters = {e: sympy.Dummy() for e in (*slopes, x, y)}
    plain = [sympy.expand(w.xreplace(letters)) for w in whole]
    dx, dy, u, v = letters.values()
    if any(w.diff(first, second) != 0 for w in plain for first in letters.values() for second in letters.values()):
        raise NotLinear(
            "the system isn't linear in its unknowns", hint="the equations are x' = a x + b y + f, y' = c x + d y + g"
        )
    mass = sympy.Matrix(2, 2, lambda i, j: plain[i].diff((dx, dy)[j]))
    determinant = sympy.cancel(mass.det())
    if determinant == 0:
        raise InputError("the equations don't determine both derivatives", hint="for such systems call sympy.dsolve")
    solved = [
        sympy.cancel(e)
        for e in mass.adjugate() * sympy.Matrix([dx * w.diff(dx) + dy * w.diff(dy) - w for w in plain]) / determinant
    ]
    rows = [tuple(sympy.cancel(sympy.expand(e).diff(letter)) for letter in (u, v)) for e in solved]
    right = [sympy.cancel(e.xreplace({u: 0, v: 0})) for e in solved]
    return LinearSystem((x, y), (rows[0], rows[1]), (right[0], right[1]))


def _unknowns(whole: Sequence[Expr], functions: Sequence[Any] | None) -> tuple[Expr, Expr]:
    """x(t) and y(t): those that are given, or the functions that are differentiated."""
    differentiated = {e.expr for w in whole for e in w.atoms(sympy.Derivative)}
    found = [*(functions or sorted(differentiated, key=str))]
    if len(found) != 2 or not all(isinstance(f, AppliedUndef) and len(f.args) == 1 for f in found):
        raise InputError("two unknown functions are expected", hint="give them as func=[x(t), y(t)]")
    if found[0].args != found[1].args:
        raise InputError(f"{found[0]} and {found[1]} have different variables")
    return found[0], found[1]


def solved_system(system: LinearSystem, ics: Mapping[Any, Any], solver: Solver) -> tuple[list[Expr], list[str]]:
    """[Eq(x(t), ...), Eq(y(t), ...)], put into both equations and into the values, and what is to be said beside.

    Raises `InputError` for values that no solution has, and `NotImplementedError` where nothing is found.
    """
    conditions = _conditions(system, ics)
    start = _initial_values(conditions)
    is_swapped = _is_swapped(system, start)
    ordered = system.swapped if is_swapped else system
    if start is not None and is_swapped:
        start = start[0], start[2], start[1]
    (_, b), _ = ordered.matrix
    if b == 0:
        pair, notices = _triangular(ordered)
    elif start is not None and _is_unit(b, ordered.t, start[0]):
        pair, notices = _through(ordered, start, solver)
        conditions = []
    else:
        found, notices = solver(ordered.equation, ordered.functions[0], ics={})
        pair = found.rhs, ordered.second(found.rhs)
    if is_swapped:
        pair = pair[1], pair[0]
    if conditions:
        pair = _with_constants(system, pair, conditions)
    pair = in_short(pair[0], system.t), in_short(pair[1], system.t)
    entries = (*system.matrix[0], *system.matrix[1], *system.right)
    notices = [*dict.fromkeys(notices + exceptions_of(sympy.Tuple(*pair), system.t, entries)), *_check(system, pair)]
    return [sympy.Eq(f, e, evaluate=False) for f, e in zip(system.functions, pair, strict=True)], notices


def _is_swapped(system: LinearSystem, start: tuple[Expr, Expr, Expr] | None) -> bool:
    """True if y is eliminated from the second equation instead: if b is zero there, or c is the simpler coefficient."""
    (_, b), (c, _) = system.matrix
    if b == 0 or c == 0:
        return bool(b != 0)  # the unknown whose equation stands alone comes first
    if start is not None and _is_unit(b, system.t, start[0]) != _is_unit(c, system.t, start[0]):
        return _is_unit(c, system.t, start[0])
    return size(c) < size(b)


def _is_unit(coefficient: Expr, t: Expr, point: Expr) -> bool:
    """True if the value at the point is finite and not zero."""
    value = coefficient.subs(t, point)
    return is_finite(value) and when_zero(value) is Zero.NEVER


def _triangular(system: LinearSystem) -> tuple[tuple[Expr, Expr], list[str]]:
    """First x from its own equation, then y, whose equation has the constant of x in it."""
    first, notices = solved_linear(system.first_alone, ())
    second, others = solved_linear(system.second_alone(first.rhs), (), first.rhs.free_symbols)
    return (first.rhs, second.rhs), notices + others


def _through(
    system: LinearSystem, start: tuple[Expr, Expr, Expr], solver: Solver
) -> tuple[tuple[Expr, Expr], list[str]]:
    """The solution with x(t0) and y(t0), where b(t0) isn't zero."""
    point, first, second = start
    x, t = system.functions[0], system.t
    (a, b), _ = system.matrix
    slope = (a * first + b * second + system.right[0]).subs(t, point)
    found, notices = solver(system.equation, x, ics={x.subs(t, point): first, x.diff(t).subs(t, point): slope})
    return (found.rhs, system.second(found.rhs)), notices


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
    system: LinearSystem, pair: tuple[Expr, Expr], conditions: Sequence[tuple[int, Condition]]
) -> tuple[Expr, Expr]:
    """The constants from the values: as many as these determine."""
    own = set().union(*(e.free_symbols for row in system.matrix for e in row), *(e.free_symbols for e in system.right))
    constants = sorted((pair[0].free_symbols | pair[1].free_symbols) - own - {system.t}, key=str)
    rows = [value_at(pair[number], system.t, c.points[0]) - c.value for number, c in conditions]
    matrix, right = sympy.linear_eq_to_matrix(rows, constants)
    if len(rows) == len(constants) == 2:
        determinant = sympy.expand(matrix.det())
        certainty = when_zero(determinant)
        if certainty is Zero.SOMETIMES:
            raise NotImplementedError(
                f"undecided: whether {determinant} is zero, on which the number of solutions depends"
            )
        if certainty is Zero.NEVER:
            values = matrix.adjugate() * right / determinant
            return _replaced(pair, dict(zip(constants, values, strict=True)))
    solutions = [*sympy.linsolve((matrix, right), *constants)]
    if not solutions:
        raise InputError("there is no solution with these values: the conditions contradict one another")
    return _replaced(pair, dict(zip(constants, solutions[0], strict=True)))


def _replaced(pair: tuple[Expr, Expr], values: Mapping[Expr, Expr]) -> tuple[Expr, Expr]:
    return pair[0].subs(values, simultaneous=True), pair[1].subs(values, simultaneous=True)


# ---------------------------------------------------------------------------------------------------- form and check


def _check(system: LinearSystem, pair: tuple[Expr, Expr]) -> list[str]:
    """One sentence if nothing could be checked.  Raises `VerificationFailed` where the pair is seen to be wrong."""
    parts = [*pair, *system.right, *system.matrix[0], *system.matrix[1]]
    symbols = set().union(*(e.free_symbols for e in parts)) - {system.t}
    sample = next(islice(samples(symbols), 1, None))
    with working_digits(2 * DIGITS):
        found = [_is_wrong_at(system, pair, sample, point) for point in _POINTS]
    if True in found:
        raise VerificationFailed(f"{pair} doesn't solve the system; please report {system}")
    return [] if False in found else ["the answer could not be verified numerically: a part of it can't be evaluated"]


def _is_wrong_at(system: LinearSystem, pair: tuple[Expr, Expr], sample: dict[Expr, Expr], point: Any) -> bool | None:
    """True if a residual is seen not to vanish; None if it can't be evaluated."""
    with suppress(NotImplementedError, ZeroDivisionError, AttributeError, ValueError):

        def number(e: Expr) -> Any:
            return jet(e.xreplace(sample), system.t, point)

        values = [number(e) for e in pair]
        for (a, b), f, (_, slope, _) in zip(system.matrix, system.right, values, strict=True):
            terms = [slope, -number(a)[0] * values[0][0], -number(b)[0] * values[1][0], -number(f)[0]]
            if abs(sum(terms)) > _SMALL * sum(map(abs, terms), arb(0)):
                return True
        return False
    return None
