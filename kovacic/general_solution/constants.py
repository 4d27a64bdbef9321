"""The constants C1, C2 that linear conditions determine: u C1 + v C2 = r for each condition, by rank.

The rank of the matrix with the rows (u, v) is 2 if a minor isn't zero, 1 if an entry isn't and all minors are.  If it is the
same with the column r, there is one solution, or a family with free constants; else there is none.  If a minor is zero only
for particular values of the parameters, the answer is for all others, and a notice has the particular case.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), in the user's symbols, so that sin(n pi) is 0
before anything is compared.

At a singular point and at infinity y is bounded, or tends to v.  If y1 and y2 are bounded, their limits are such a row.  Else
let y2 be the larger one, r = lim y1/y2: then C2 + r C1 = 0, and y = C1 (y1 - r y2).  As (y1 - r y2)/y2 tends to 0 and has the
slope -W/y2^2, the limit of y1 - r y2 is by L'Hospital's rule that of W/y2'.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import Enum
from itertools import combinations
from types import MappingProxyType
from typing import Any, NamedTuple

import sympy
from sympy import Mul, S, acos, atan, cos, cosh, exp, expand, gamma, log, oo, sin, sinh, tan, tanh
from sympy.simplify.fu import TR2i

from kovacic.closed_form.atoms import Atoms
from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.behaviour import (
    OSCILLATING,
    Approach,
    UnknownLimit,
    limit_at,
    zeros_of_leading_term,
)
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.question import Question
from kovacic.general_solution.substitution import by_functions, finite_value, in_single_waves, size
from kovacic.general_solution.validity import ZeroSet
from kovacic.general_solution.zero import Zero, is_nowhere_zero, when_zero
from kovacic.limits import check_time, manageable
from kovacic.reading.read import read_input

Expr = Any  # SymPy publishes no types
#: Functions in which constants are simplified as rational expressions.
_ELEMENTARY = {exp, log, sin, cos, tan, sinh, cosh, tanh, atan, acos}


class Row(NamedTuple):
    """u C1 + v C2 = r."""

    u: Expr
    v: Expr
    r: Expr

    def rest(self, c1: Expr, c2: Expr) -> Expr:
        """u c1 + v c2 - r."""
        return self.u * c1 + self.v * c2 - self.r


class CaseOutcome(Enum):
    """One solution or a family; none; or open, since it depends on more than the case says."""

    SOLUTIONS = "solutions"
    NONE = "none"
    OPEN = "open"


@dataclass(frozen=True)
class ParameterCase:
    """The solutions of the conditions where all of `zeros` are zero; without any, for generic values of the parameters.

    `values` are C1 and C2, in terms of those that stay free; there are solutions only if all of `needed` are zero, too.
    """

    zeros: tuple[Expr, ...]
    outcome: CaseOutcome
    values: tuple[Expr, Expr] = (S.Zero, S.Zero)
    needed: tuple[Expr, ...] = ()

    @property
    def is_possible(self) -> bool:
        """True unless one of `zeros` is seen not to be zero for any values."""
        return all(map(ZeroSet, self.zeros))

    def where(self, answer: Expr = S.Zero) -> str:
        """The case in words, in the functions of the answer for all other values."""
        return " and ".join(ZeroSet(zero).said(answer) for zero in self.zeros)


class Determined(NamedTuple):
    """The solutions of the conditions for generic values of the parameters, and for particular ones."""

    generic: ParameterCase
    particular: list[ParameterCase]
    #: The equations for the constants.
    rows: tuple[Row, ...] = ()


def determine(
    rows: Sequence[Row], names: tuple[Expr, Expr], wronskian: Expr | None = None, scale: Expr = S.One
) -> Determined:
    """The generic case and the particular ones.  Raises `NotImplementedError` if it isn't decided whether a constant is zero.

    `wronskian` is that at a point where y and y' are given, in this order; `scale` is the Wronskian at some point: where it is
    zero the solutions are dependent, which isn't a case of the conditions.

    >>> k, C1, C2 = sympy.symbols("k C1 C2")
    >>> generic, others, _ = determine([Row(1, 0, 0), Row(cos(k), sin(k), 0)], (C1, C2))
    >>> generic.values, others[0].zeros, others[0].values
    ((0, 0), (sin(k),), (0, C2))
    """
    minor: tuple[Expr, Zero, Sequence[Row]] | None
    if wronskian is None:
        pairs = combinations(rows, 2)
        minor = _nonzero_entry((first.u * second.v - first.v * second.u, (first, second)) for first, second in pairs)
    else:
        minor = wronskian, Zero.NEVER, rows[:2]
    if minor is None:
        return _split(_of_rank_one(rows, names))
    # Cramer's rule for two of the rows; the others must be satisfied.
    value, when, (first, second) = minor
    c1 = tidy((first.r * second.v - first.v * second.r) / value)
    c2 = tidy((first.u * second.r - first.r * second.u) / value)
    others = [row for row in rows if row is not first and row is not second]
    found = _split(_SolvedConditions((c1, c2), [row.rest(c1, c2) for row in others]))
    if when is Zero.SOMETIMES:  # then the case of rank one, as far as it follows from the minor's being zero
        case = ParameterCase((), CaseOutcome.OPEN)
        with suppress(NotImplementedError):  # undecided there, which says nothing about all other values
            of_rank_one = _of_rank_one(rows, names)
            if len(rows) == 2 and when_zero(of_rank_one.pivot) is not Zero.SOMETIMES:
                generic, particular, _ = _split(of_rank_one)
                case = particular[0] if particular else generic
        found.particular.append(replace(case, zeros=(value / scale,), needed=case.zeros))
    return found


class _SolvedConditions(NamedTuple):
    """Values of C1 and C2, expressions that must be zero for them to be a solution, and `pivot`, by which they are divided."""

    values: tuple[Expr, Expr]
    needed: Sequence[Expr]
    pivot: Expr = S.One


def _nonzero_entry(candidates: Iterable[tuple[Expr, Any]]) -> tuple[Expr, Zero, Any] | None:
    """The first pair whose value is never zero, or else isn't always zero, with the `Zero` between value and origin."""
    sometimes = None
    for value, origin in candidates:
        when = when_zero(value)
        if when is Zero.NEVER:
            return value, when, origin
        if when is Zero.SOMETIMES:
            sometimes = sometimes or (value, when, origin)
    return sometimes


def _of_rank_one(rows: Sequence[Row], names: tuple[Expr, Expr]) -> _SolvedConditions:
    """A row, of which all must be multiples, solved for a constant with a nonzero coefficient that is alone, preferably."""
    entries = [(row[k], (k, row)) for row in rows for k in (1, 0)]
    found = _nonzero_entry(sorted(entries, key=lambda entry: 0 not in entry[1][1][:2]))
    if found is None:
        return _SolvedConditions(names, [row.r for row in rows])
    pivot, when, (k, row) = found
    others = [other for other in rows if other is not row]
    norm = None if when is Zero.NEVER else _norm(row)
    if norm is not None:
        # (C1, C2) = r (u, v)/(u^2 + v^2) + C (v, -u): the multiple of the row, and all that is orthogonal to it
        c1 = tidy(row.r * row.u / norm) + row.v * names[0]
        c2 = tidy(row.r * row.v / norm) - row.u * names[0]
        return _SolvedConditions((c1, c2), [other.rest(c1, c2).subs(names[0], 0) for other in others])
    # C1 = r/u - v/u C2 with a free C2 for k = 0, C2 = r/v - u/v C1 with a free C1 for k = 1
    solved = tidy(row.r / pivot) - tidy(row[1 - k] / pivot) * names[1 - k]
    values = (names[0], solved) if k else (solved, names[1])
    return _SolvedConditions(values, [other[k] * row.r - other.r * pivot for other in others], pivot)


def _norm(row: Row) -> Expr | None:
    """u^2 + v^2, or 1 for r = 0, if u and v may be zero, but not both; else None."""
    if 0 in (row.u, row.v):
        return None
    # 1/gamma(a) and 1/gamma(b) are never zero together if a - b isn't an integer
    factors = (Mul.make_args(entry) for entry in (row.u, row.v))
    u, v = (1 / Mul(*(factor for factor in entry if not is_nowhere_zero(factor))) for entry in factors)
    if row.r == 0 and isinstance(u, gamma) and isinstance(v, gamma):
        difference = expand(u.args[0] - v.args[0])
        if difference.is_number and difference.is_integer is False:
            return S.One
    norm = sympy.factor_terms(in_single_waves(row.u**2 + row.v**2))
    return norm if is_nowhere_zero(norm) else None


def _split(found: _SolvedConditions) -> Determined:
    """The generic case, and particular parameters for which there are more solutions or fewer."""
    particular = [ParameterCase((found.pivot,), CaseOutcome.OPEN)] if when_zero(found.pivot) is Zero.SOMETIMES else []
    whens = {value: when_zero(value) for value in found.needed}
    sometimes = tuple(value for value, when in whens.items() if when is Zero.SOMETIMES)
    generic = ParameterCase(sometimes, CaseOutcome.SOLUTIONS, found.values)
    none = ParameterCase((), CaseOutcome.NONE)
    if Zero.NEVER in whens.values():
        return Determined(none, particular)
    # generic parameters don't satisfy what only particular ones do
    return Determined(none, [generic, *particular]) if sometimes else Determined(generic, particular)


def tidy(value: Any) -> Any:
    """A shorter form of a constant, if it takes little time."""
    check_time()
    value = sympy.sympify(value, strict=True)
    powers = value.atoms(sympy.Pow)
    functions = {f.func for f in value.atoms(sympy.Function)}
    is_opaque = value.has(sympy.RootSum, sympy.Integral) or not manageable(value)
    has_irrational_power = any(not power.exp.is_Rational and not power.base.is_Symbol for power in powers)
    is_product_of_powers = not value.free_symbols and functions <= {exp, log} and not value.has(sympy.Add)
    if is_opaque or has_irrational_power or is_product_of_powers:
        return value
    if not functions:
        shorten = sympy.cancel if value.free_symbols or value.has(sympy.E) else expand
        forms = (sympy.radsimp(shorten(value), symbolic=False), _over_one_root(value))
        return min(filter(None, forms), key=size)
    if not functions <= _ELEMENTARY:
        return min((value, expand(value), in_single_waves(value)), key=size)
    return min(map(TR2i, (value, sympy.cancel(value))), key=size)


def _over_one_root(value: Expr) -> Expr | None:
    """A number in Q(a^(1/n)), a > 0, as a polynomial in that root, without a denominator; None for other values."""
    roots = [power for power in value.atoms(sympy.Pow) if not power.exp.is_Integer]
    if not roots or not all(root.base.is_Integer and root.base > 0 and root.exp.is_Rational for root in roots):
        return None
    x = sympy.Symbol("x_")
    number = read_input(value, var=x.name).S
    written = Atoms(x).constant(number.num[0] / number.den[0])
    return None if written.has(sympy.CRootOf) else written


def constants_of(
    question: Question,
    basis: Basis,
    particular: Expr,
    names: tuple[Expr, Expr],
    limits: dict[Expr, Approach],
    steps: Mapping[Expr, Expr] = MappingProxyType({}),
) -> Determined:
    """The constants by the conditions, with values of `steps`.  Raises `NotImplementedError` if too little is known."""
    y1, y2, own_particular = solutions = [question.own(y) for y in (basis.y1, basis.y2, particular)]
    rows: list[Row] = []
    exceptional: set[Expr] = set()
    W = _wronskian(question, basis, limits)
    for k, condition in enumerate(question.conditions):
        place = _limit_place(condition, limits)
        if place is None:
            u, of_particular = (condition.of(y, question.x) for y in (y1, own_particular))
            v = condition.of(y2, question.x) if W is None or k > 1 else _of_second(condition, y1, y2, question.x, W)
            rows.append(Row(u, v, condition.value - of_particular.xreplace(steps)))
        else:
            limit = _Limit(condition, place, question.own(basis.wronskian), question.x)
            of_limit, zeros = _rows_of_limit(limit, solutions)
            rows += of_limit
            exceptional |= zeros
    if W is not None:
        determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
        # of y and y' it is W, of y' and y it is -W
        W = determinant if determinant.is_Rational else (1 if question.conditions[1].terms[0].order else -1) * W
    found = determine(rows, names, W, basis.scale)
    found.particular.extend(ParameterCase((zero,), CaseOutcome.OPEN) for zero in sorted(exceptional, key=str))
    return found._replace(rows=tuple(rows))


def _wronskian(question: Question, basis: Basis, limits: dict[Expr, Approach]) -> Expr | None:
    """The Wronskian, which isn't zero, at the point where y and y' are given first; None without one."""
    terms = [condition.terms[0] for condition in question.conditions[:2] if condition.is_value]
    places = {term.point for term in terms}
    if {term.order for term in terms} != {0, 1} or len(places) != 1 or not places.isdisjoint(limits):
        return None
    W = finite_value(question.own(basis.wronskian), question.x, terms[0].point)
    return W if W is None or W.free_symbols else tidy(W)


def _of_second(condition: Condition, y1: Expr, y2: Expr, x: Expr, W: Expr) -> Expr:
    """The value of y2 or its slope, with y2' = W/y1 where y1 is constant: shorter than what differentiation gives."""
    (term,) = condition.terms
    return W / y1 if term.order and not y1.has(x) else condition.of(y2, x)


def _limit_place(condition: Condition, limits: dict[Expr, Approach]) -> Approach | None:
    """The place of a condition on a limit; None for values at ordinary points.  Raises `InputError` if it is both."""
    place = next((point for point in condition.points if point in limits), None)
    if place is None:
        if condition.value is None:
            point = condition.points[0]
            raise InputError(f"{condition.text}: {point} is an ordinary point, where every solution is bounded")
        return None
    if len(condition.terms) > 1 or condition.terms[0].coefficient != 1:
        reason = f"{place} is a singular point, or infinite"
        raise InputError(f"{condition.text}: {reason}; there, y and y' are given apart", hint="write y(0) = bounded")
    return limits[place]


@dataclass(frozen=True)
class _Limit:
    """A condition on the limit of y, or of y', at a place; W is the Wronskian."""

    condition: Condition
    place: Approach
    W: Expr
    x: Expr

    @property
    def order(self) -> int:
        return self.condition.terms[0].order

    def of(self, e: Expr) -> Expr:
        return limit_at(e, self.x, self.place)

    def is_allowed(self, limit: Expr) -> bool:
        """True if y may behave like this.  A value excludes oscillations as well."""
        return limit != oo and (limit != OSCILLATING or self.condition.value is None)

    def rows(self, y1: Expr, y2: Expr, y0: Expr) -> list[Row]:
        """Equations for C1 and C2.  Raises `UnknownLimit`."""
        rest = self.of(y0)
        if not self.is_allowed(rest):
            return self._with_a_large_particular(y1, y2, y0)
        first, second = self.of(y1), self.of(y2)
        found = []
        if not self.is_allowed(first):
            first = S.Zero
            found.append(Row(S.One, S.Zero, S.Zero))
        if not self.is_allowed(second):
            second = S.Zero
            found.append(Row(S.Zero, S.One, S.Zero))
        ratio = self.of(y1 / y2) if len(found) == 2 else oo
        # with different sizes, or waves of different phases, no combination is smaller
        if ratio not in (0, oo, OSCILLATING):
            if self.order:
                raise UnknownLimit("the slope of a combination of solutions of the same size isn't known")
            smaller = self.of(self.W / y2.diff(self.x))  # the limit of y1 - r y2
            if self.is_allowed(smaller):
                # r C1 + C2 = 0, for r = p/q as p C1 + q C2 = 0 with 1/gamma, which has values everywhere, for gamma
                p, q = sympy.fraction(sympy.powsimp(ratio))
                gammas = Mul(*(f for f in ratio.atoms(gamma) if f.free_symbols))
                first, found = smaller, [Row(p / gammas, q / gammas, S.Zero)]
        value = self.condition.value
        return found if value is None else [*found, Row(first, second, value - rest)]

    def zeros(self, rows: Sequence[Row], y1: Expr, y2: Expr) -> set[Expr]:
        """Expressions that are zero where a solution may be bounded that the rows exclude.

        None beside a solution with a limit that isn't 0, if the integral of W diverges: the others are unbounded.
        """
        found: set[Expr] = set()
        for row, y, other in ((Row(S.One, S.Zero, S.Zero), y1, y2), (Row(S.Zero, S.One, S.Zero), y2, y1)):
            zeros = zeros_of_leading_term(y, self.x, self.place) if row in rows else set()
            if not zeros:
                continue
            with suppress(UnknownLimit):
                is_log = not self.place.is_infinite and self.of(self.W * (self.x - self.place.point)) != 0
                if is_log and self.of(other) not in (0, oo, OSCILLATING):
                    continue
            found |= zeros
        return found

    def _with_a_large_particular(self, y1: Expr, y2: Expr, y0: Expr) -> list[Row]:
        """The rows if y0 isn't allowed: with y0 - r y for y0, where r = lim y0/y for the larger one of y1 and y2."""
        for k, y in enumerate((y1, y2)):
            ratio = self.of(y0 / y)
            if ratio not in (0, oo, OSCILLATING):
                shifted = self.rows(y1, y2, expand(y0 - ratio * y))  # for C + r, where C is the constant of y
                return [row._replace(r=row.r - row[k] * ratio) for row in shifted]
        if any(self.of(y) == self.of(y0) and self.of(y0 / y) == OSCILLATING for y in (y1, y2)):
            raise UnknownLimit("the particular solution oscillates as others do")
        parts = by_functions(expand(y0), lambda factor: not factor.has(self.x))
        large = [f for f in parts if not self.is_allowed(self.of(f))]
        if len(large) == 1:  # there is a solution only if its coefficient is zero
            (f,) = large
            return [*self.rows(y1, y2, expand(y0 - parts[f] * f)), Row(S.Zero, S.Zero, parts[f])]
        return [Row(S.Zero, S.Zero, S.One)]  # no solution


def _rows_of_limit(limit: _Limit, solutions: Sequence[Expr]) -> tuple[list[Row], set[Expr]]:
    """The rows, and what may be zero: nonnegative symbols that were taken for positive ones, and leading coefficients."""
    parts = sympy.Tuple(*(y.diff(limit.x, limit.order) for y in solutions), limit.W)
    symbols = sorted(parts.free_symbols - {limit.x}, key=str)
    nonnegative = (s for s in symbols if s.is_nonnegative and not s.is_positive)
    natural = {s: sympy.Dummy(s.name, integer=s.is_integer, positive=True) for s in nonnegative}
    for positive in ({}, natural):
        *forms, W = parts.xreplace(positive)
        back = {dummy: symbol for symbol, dummy in positive.items()}
        try:
            rows = replace(limit, W=W).rows(*forms)
        except UnknownLimit as unknown:
            reason = unknown
        else:
            exceptional = {zero.xreplace(back) for zero in replace(limit, W=W).zeros(rows, *forms[:2])}
            return [Row(*sympy.Tuple(*row).xreplace(back)) for row in rows], {*positive, *exceptional}
    message = f"undecided: the solutions' behaviour at {limit.place.point}: {reason}"
    open_signs = [f"{s}=positive" for s in symbols if s.is_positive is None and s.is_negative is None]
    if open_signs:
        message += f"; assumptions may decide it, as {', '.join(open_signs)}"
    raise NotImplementedError(message)
