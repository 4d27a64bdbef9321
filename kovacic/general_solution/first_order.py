"""Equations of first order, w' = p + q w + r w^n: linear ones where r = 0, Riccati's for n = 2, Bernoulli's for p = 0.

A linear equation has the solutions

    w = h (C1 + int p/h dx),    h = exp(int q dx),                                                                    (1)

with powers of cosh(x), cos(x), ... for tanh(x), tan(x), ... in q; the others are made linear in `riccati`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence, Set
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Self

import sympy
from sympy import Dummy, Integer, Symbol, cancel, cosh, expand, powsimp, sinh
from sympy.core.function import AppliedUndef

from kovacic.closed_form.atoms import Atoms, display, is_seen_negative
from kovacic.closed_form.cuts import common_place, cuts_of, with_positive_factors
from kovacic.closed_form.product import product
from kovacic.closed_form.steps import JUMPING, Apart, in_parts
from kovacic.errors import InputError, UnsatisfiableConditions, VerificationFailed
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.behaviour import Approach, UnknownLimit, have_values, limit_at, value_or_limit
from kovacic.general_solution.check import SolutionClaim, is_finite, jumps
from kovacic.general_solution.conditions import Condition, conditions_at, read_conditions
from kovacic.general_solution.integrands import NUMBERS, radicands, ratfunc
from kovacic.general_solution.particular import is_solution, starting_at, turned_at, with_letters_of_integration
from kovacic.general_solution.question import free_constants
from kovacic.general_solution.substitution import by_functions, changed_beside, exact_decimals, powers_of_roots
from kovacic.general_solution.textbook import in_book_form, in_hyperbolic_functions, sums
from kovacic.general_solution.validity import ZeroSet
from kovacic.general_solution.zero import is_zero
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text
from kovacic.reading.pieces import Paste
from kovacic.reading.source import parts_of, source_of
from kovacic.reading.symbolic import expression_of, function_of
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types
_ZERO = Integer(0)
#: r and n of a linear equation.
LINEAR = (_ZERO, Integer(2))
#: Solves an equation of second order for a function, with conditions.
Solver = Callable[[Expr, Expr, Mapping[Expr, Expr]], Any]


@dataclass(frozen=True)
class OfFirstOrder:
    """One equation of first order, or two, with their coefficients, and conditions with the functions that these are on."""

    functions: tuple[Expr, ...]
    entries: tuple[Expr, ...]
    conditions: tuple[Condition, ...] = ()
    guesses: tuple[str, ...] = ()

    def slopes(self) -> tuple[Expr, ...]:
        """The right-hand sides."""
        raise NotImplementedError

    def in_symbols(self, others: Mapping[Expr, Expr]) -> Self:
        """The equations in other symbols."""
        functions, entries = (tuple(e.xreplace(others) for e in part) for part in (self.functions, self.entries))
        conditions = tuple(condition.in_symbols(others) for condition in self.conditions)
        return replace(self, functions=functions, entries=entries, conditions=conditions)

    def with_values(self, ics: Any) -> Self:
        """With conditions.  Raises `InputError` as `read_conditions` does."""
        return replace(self, conditions=tuple(read_conditions(ics, *self.functions)))

    def at(self, values: Mapping[Expr, Expr]) -> tuple[tuple[Expr, ...], tuple[Expr, ...], dict[Expr, Any]]:
        """Equations, functions and conditions as for `dsolve`, for particular values of letters."""
        equations = [
            f.diff(self.x) - slope.subs(values) for f, slope in zip(self.functions, self.slopes(), strict=True)
        ]
        return tuple(equations), self.functions, conditions_at(values, self.conditions)

    @property
    def x(self) -> Expr:
        return self.functions[0].args[0]

    @property
    def letters(self) -> dict[str, Expr]:
        """The symbols in the coefficients, by name."""
        symbols = sympy.Tuple(*self.entries).free_symbols
        return {symbol.name: symbol for symbol in sorted(symbols, key=str)}


class FirstOrderEquation(OfFirstOrder):
    """w' = p + q w + r w^n, n = `power`: these are the entries."""

    p = property(lambda self: self.entries[0])
    q = property(lambda self: self.entries[1])
    r = property(lambda self: self.entries[2])
    power = property(lambda self: self.entries[3])
    function = property(lambda self: self.functions[0])

    def slopes(self) -> tuple[Expr, ...]:
        return (self.p + self.q * self.function + self.r * self.function**self.power,)

    @property
    def reading(self) -> str:
        """One line: y' = k*y, y(x), parameters k."""
        w = Symbol(self.function.func.__name__)
        names = ", ".join(sorted({*self.letters} - {self.x.name}))
        line = f"{w}' = {as_text(self.p + self.q * w + self.r * w**self.power)}, {self.function}".replace("**", "^")
        return f"{line}, parameters {names}" if names else line

    @cached_property
    def value(self) -> tuple[Any, Any]:
        """a and v for w(a) = v, or None twice without a condition.  Raises `InputError` for others, and for more than one."""
        if not self.conditions:
            return None, None
        condition = self.conditions[0]
        if len(self.conditions) > 1 or not condition.is_value or condition.terms[0].order:
            raise InputError("an equation of first order has one value, at one point", hint='write "w(0)=1"')
        if condition.points[0] in (sympy.oo, -sympy.oo):
            raise InputError(f"{condition.text}: a value determines a solution at a finite point")
        return condition.points[0], condition.value

    @property
    def of_power(self) -> FirstOrderEquation:
        """The equation of u = w^(1 - n) for p = 0, u' = (1 - n) (r + q u), and its value."""
        m = 1 - self.power
        conditions = tuple(replace(condition, value=condition.value**m) for condition in self.conditions)
        return FirstOrderEquation(self.functions, (m * self.r, m * self.q, *LINEAR), conditions)

    def homogeneous(self) -> Expr:
        """h with h'/h = q, real at the `place`."""
        return _exponential_of_integral(self.q, self.x, self.value[0], self.place)

    def constant(self, taken: Set[Expr] = frozenset()) -> Expr:
        """C1, or the next name that is neither in the equation nor taken."""
        return free_constants(1, *self.entries, self.function, *taken)[0]

    @cached_property
    def place(self) -> Expr | None:
        """Where solutions are to be real: the point of the value, else 0, or where the entries are.

        For rational entries it is half way to a pole on the right of 0, if 0 is one.
        """
        start, _ = self.value
        cuts = cuts_of(sympy.Tuple(self.p, self.q), self.x)
        is_real_at_zero = not any(is_seen_negative(cut.subs(self.x, _ZERO)) for cut in cuts)
        if start is not None or (is_real_at_zero and have_values(self.entries, self.x, _ZERO)):
            return start or _ZERO
        if cuts:
            return common_place(self.x, {cut: cut for cut in cuts})
        whole = self.p + self.q
        is_rational = whole.is_rational_function(self.x)
        factors = sympy.factor_list(sympy.denom(sympy.together(whole)))[1] if is_rational else ()
        lines = [f.as_poly(self.x) for f, _ in factors]
        poles = [-f.nth(0) / f.nth(1) for f in lines if f is not None and f.degree() == 1]
        return next((pole / 2 for pole in poles if is_seen_negative(-pole)), None)

    @cached_property
    def is_regular(self) -> bool:
        """True without a value, or if the coefficients have values at its point, so that it determines one solution."""
        start, _ = self.value
        return start is None or have_values(self.entries, self.x, start)


def is_unit(coefficient: Expr, x: Expr, point: Expr) -> bool:
    """True if the value at the point is finite, and not always zero."""
    return have_values([coefficient], x, point) and not is_zero(value_or_limit(coefficient, x, point))


# ------------------------------------------------------------------------------------------------------------ reading


def read_first_order(
    eq: Any, func: Any, var: str | None, limits: Limits, names: Collection[str] = ()
) -> FirstOrderEquation:
    """The equation; `names` are declared.  Raises `InputError` for what can't be read or is of another kind."""
    guesses: tuple[str, ...] = ()
    if isinstance(eq, str | Paste):
        unknown = None if func is None else str(func).partition("(")[0]
        source = source_of(eq, var, limits, unknown=unknown, equation=True, names=names)
        guesses = source.guesses
        if source.tokens is not None and "OPERATOR" in source.tokens.kinds:  # (D + 2) y = 0
            (b, c, rest), _ = parts_of(source, order=1)
            func = sympy.Function(source.unknown)(Symbol(source.variable))
            eq = b * func.diff() + c * func + rest
        else:
            eq = expression_of(source)
    _require_first_order(isinstance(eq, sympy.Basic))
    whole = exact_decimals(eq.lhs - eq.rhs if isinstance(eq, sympy.Equality) else eq)
    function = func if isinstance(func, AppliedUndef) else function_of(whole)
    t = function.args[0]
    _require_first_order(len(function.args) == 1 and t.is_Symbol and str(var or t) == str(t) and is_finite(whole))
    return FirstOrderEquation((function,), _in_powers(whole, function), (), guesses)


def _require_first_order(holds: bool) -> None:
    if not holds:
        raise InputError("an equation w' = p + q w + r w^n is expected", hint="for example w' = x^2 + w^2")


def _in_powers(whole: Expr, function: Expr) -> tuple[Expr, Expr, Expr, Expr]:
    """p, q, r, n of an expression that is zero: its numerator has w' times one power of w, and one power beside 1 and w."""
    x = function.args[0]
    slope, w = Dummy(), Dummy()
    plain = whole.subs(function.diff(x), slope).subs(function, w)
    _require_first_order(not any(e.has(slope, w, function.func) for e in plain.atoms(sympy.Derivative, AppliedUndef)))
    plain = sympy.numer(sympy.together(plain))
    roots = {e for e in powers_of_roots(plain) if not e.has(w)}
    plain = changed_beside(roots, plain, expand)
    plain = plain.replace(lambda e: e.is_Pow and e.base.has(w), lambda e: sympy.expand_power_base(e, force=True))
    coefficients = by_functions(plain, lambda f: not f.has(slope, w))
    leading, others = sympy.sift(coefficients, lambda f: f.has(slope), binary=True)
    _require_first_order(len(leading) == 1)
    below = leading[0].diff(slope)
    right = {f / below: _quotient_by_terms(-coefficients[f], coefficients[leading[0]]) for f in others}
    p, q = (right.pop(f, _ZERO) for f in (sympy.S.One, w))
    f, r = next(iter(right.items()), (w**2, _ZERO))
    base, power = f.as_base_exp()
    is_of_this_form = len(right) < 2 and base == w and not power.has(x, w) and (power == 2 or p == 0)
    _require_first_order(is_of_this_form and not below.has(slope))
    return p, q, r, cancel(power)


def _quotient_by_terms(numerator: Expr, denominator: Expr) -> Expr:
    """The quotient in lowest terms, with letters for functions that jump, which SymPy can't cancel."""

    def reduced(quotient: Expr) -> Expr:
        above, below = sympy.fraction(cancel(quotient))
        # (x - 2) sqrt(x^2 + 1) and x (log(x) + 1) are multiplied out
        return above / (sympy.factor(below) if radicands(below) or below.has(sympy.log) else below)

    quotient = numerator / denominator
    return changed_beside(quotient.atoms(*JUMPING) | powers_of_roots(quotient), quotient, reduced)


# ------------------------------------------------------------------------------------------------------------ solving


class CheckedSolution(NamedTuple):
    """w(x), or x(t) and y(t), checked, with notices and zeros of denominators; `of_pair`: see `ProblemAnswer.exceptional`.

    `power_of_w` is w^(1 - n) for a solution of Bernoulli's equation.
    """

    values: tuple[Expr, ...]
    notices: list[str]
    zeros: list[Expr]
    of_pair: tuple[Expr, ...] = ()
    power_of_w: Expr | None = None


def solved_linear(equation: FirstOrderEquation, taken: Set[Expr] = frozenset()) -> CheckedSolution:
    """The solution by (1), with a constant that isn't `taken`.  Raises `UnsatisfiableConditions` for a value that none has."""
    p, q, x, place = equation.p, equation.q, equation.x, equation.place
    start, _ = equation.value
    h = starting_at(turned_at(place, equation.homogeneous(), (-q,), _ZERO, x), x, start)
    if start is not None and p == 0:
        h = _beside_value(h, sympy.Pow, x, start)
    particular = turned_at(place, _of_parts(in_parts(p, x), h, x, start), (-q,), p, x)
    if start is not None:
        beside = _beside_value(particular, sympy.log, x, start)
        particular = beside if beside != particular and is_solution(beside, (-q,), p, x) else particular
    in_factors = particular if place is None else with_positive_factors(particular, x, place)
    if in_factors != particular and in_factors.is_rational_function(x):
        particular = cancel(in_factors)
    constant = _constant_through(equation, h, particular, equation.constant(taken))
    whole = constant * h + particular
    w = shortest([*sums(whole, x), h * (constant + powsimp(particular / h))])
    if start is not None:
        w = with_letters_of_integration(in_book_form(w, x))
    return CheckedSolution((w,), check_first_order(equation, w), zeros_of(w, x, (p, q)))


def with_letters_for_constants(answer: Any, own: Set[Expr]) -> tuple[Expr, tuple[Expr, ...]]:
    """A solution with letters for C1 and C2, since a value or its point may have these symbols too; and the letters."""
    letters = {symbol: Dummy(symbol.name) for symbol in sorted(answer.eq.rhs.free_symbols - own, key=str)}
    return answer.eq.rhs.xreplace(letters), tuple(letters.values())


def zeros_of(w: Expr, x: Expr, coefficients: Sequence[Expr], of_pair: Iterable[Expr] = ()) -> list[Expr]:
    """Where w is exceptional though the equation isn't: irreducible factors of denominators without x, and `of_pair`."""

    def constant_denominators(e: Expr) -> list[Expr]:
        powers = (p for p in e.atoms(sympy.Pow) if p.exp.could_extract_minus_sign() and not p.base.has_free(x))
        bases = {base for p in powers for base in ZeroSet(p.base).factors}
        return sorted((b for b in bases if b.free_symbols <= e.free_symbols), key=str)  # no letter of integration

    given = constant_denominators(sympy.Tuple(*coefficients))
    others = dict.fromkeys([*constant_denominators(w), *of_pair])
    return [factor for factor in others if factor not in given and -factor not in given]


#: For a function f: c and h with h'/h = f/c, c = 1 or -1.
_ANTILOGARITHMS: dict[Any, tuple[int, Callable[[Expr], Expr]]] = {
    sympy.tanh: (1, cosh),
    sympy.coth: (1, sinh),
    sympy.csch: (1, lambda u: sympy.tanh(u / 2)),
    sympy.tan: (-1, sympy.cos),
    sympy.cot: (1, sympy.sin),
    sympy.csc: (1, lambda u: sympy.tan(u / 2)),
    sympy.sec: (-1, lambda u: sympy.cos(u) / (1 + sympy.sin(u))),
}


def _exponential_of_integral(q: Expr, x: Expr, start: Expr | None, place: Expr | None) -> Expr:
    """h with h'/h = q, for a rational q, with c tan(k x), c tanh(k x), ..., a product of powers that are real at `place`."""
    own = {Symbol(symbol.name): symbol for symbol in q.free_symbols}
    rest, powers = [], []
    for term in sympy.Add.make_args(expand(q)):
        c, f = term.as_independent(x, as_Add=False)
        slope = f.args[0].diff(x) if f.func in _ANTILOGARITHMS else x
        if slope.has(x):
            rest.append(term)
            continue
        sign, function = _ANTILOGARITHMS[f.func]
        powers.append(function(f.args[0]) ** (sign * c / slope))
    if powers:
        return sympy.Mul(*powers, _exponential_of_integral(sympy.Add(*rest), x, start, place))
    rate = ratfunc(q, x)
    if rate is not None:
        is_known = place is not None and have_values([q], x, place)
        atoms = Atoms(x, at=place if is_known else None, own=lambda e: e.xreplace(own))
        h = display(product(rate), atoms).xreplace(NUMBERS | own)
        return h.replace(lambda e: e.is_Add, expand)  # as in p
    return sympy.exp(_of_parts(in_parts(q, x), Integer(1), x, start))


def _beside_value(y: Expr, kind: Any, x: Expr, start: Expr) -> Expr:
    """y with (u(x)/u(a))^e for u^e, or log(u(x)/u(a)), real on the side of a, where the sign of u(a) depends on letters."""

    def is_open(e: Expr) -> bool:
        if not isinstance(e, kind) or not e.args[0].has(x) or (e.is_Pow and e.exp.is_Integer):
            return False
        there = e.args[0].subs(x, start)
        is_seen = e.is_Pow and (is_seen_negative(there) or is_seen_negative(-there))
        return bool(there.free_symbols) and not (is_seen or there.is_positive or radicands(there))

    return y.replace(is_open, lambda e: e.func(e.args[0] / e.args[0].subs(x, start), *e.args[1:]))


def _of_parts(p: Apart, h: Expr, x: Expr, start: Expr | None) -> Expr:
    """h int p/h dx, with steps and impulses in p one by one; an integral that isn't found begins at `start`.

    g H(x - a) gives H(x - a) h int_a^x g/h, and s delta(x - a) gives H(x - a) s h(x)/h(a).
    """
    if any(max(strengths) > 0 for strengths in p.impulses.values()):
        raise NotImplementedError("undecided: a derivative of an impulse in an equation of first order")
    total = _integrated(p.plain, h, x, start)
    for a, g in p.steps.items():
        response = _integrated(g, h, x, a)
        total += sympy.Heaviside(x - a) * (response - h * value_or_limit(response / h, x, a))
    for a, strengths in p.impulses.items():
        total += sympy.Heaviside(x - a) * strengths[0] * h / value_or_limit(h, x, a)
    return total


def _integrated(p: Expr, h: Expr, x: Expr, start: Expr | None) -> Expr:
    """h int p/h dx."""
    if p == 0:
        return _ZERO
    integral = antiderivative(powsimp(p / h), x, start)
    if integral is not None and not jumps(h * integral, x, [h, 1 / h, p]):
        if (p / h).has(sinh, cosh):
            integral = in_hyperbolic_functions(integral)
        return starting_at(shortest([powsimp(expand(h * integral)), h * integral]), x, start)
    return starting_at(h * sympy.Integral(powsimp(expand(p / h)), x), x, start)


def _constant_through(equation: FirstOrderEquation, h: Expr, particular: Expr, free: Expr) -> Expr:
    """C with C h(a) + particular(a) = v; `free` without a value, and if every C satisfies it, at a singular point a."""
    x = equation.x
    a, v = equation.value
    if a is None:
        return free
    if not equation.is_regular and not is_finite(h.subs(x, a)):
        is_known = is_finite(particular.subs(x, a))
        has_value = is_known and is_zero(v - value_or_limit(particular, x, a))
        is_small = is_known and _known_limit(h, x, Approach(a)) == 0  # from the right
        if has_value:
            return free if is_small else _ZERO
        if is_small:
            raise _without_value(a)
        raise InputError(f"at most one solution is finite at {a}, a singular point of the equation")
    ends = (_known_limit(particular, x, Approach(a, side)) for side in (1, -1))
    # Every solution is infinite there if one is, since h has a finite limit.
    if not equation.is_regular and all(end == sympy.oo for end in ends):
        raise _without_value(a)
    rest, there = v - value_or_limit(particular, x, a), value_or_limit(h, x, a)
    if equation.is_regular or not is_zero(there):
        return powsimp(rest / there)
    if is_zero(rest):
        return free
    raise _without_value(a)


def _known_limit(e: Expr, x: Expr, approach: Approach) -> Expr | None:
    """The limit, or None if it isn't found."""
    with suppress(UnknownLimit):
        return limit_at(e, x, approach)
    return None


def _without_value(a: Expr) -> UnsatisfiableConditions:
    return UnsatisfiableConditions(f"there is no solution with this value at {a}, a singular point of the equation")


def check_first_order(equation: FirstOrderEquation, w: Expr, power_of_w: Expr | None = None) -> list[str]:
    """One sentence per check that could not be carried out.  Raises `VerificationFailed` if w is wrong.

    The claim is w' - (q + r w^(n - 1)) w = p.  For Bernoulli's equation u = w^(1 - n) is given, and w^(n - 1) is 1/u, since a
    power of w may be on another branch; then the claim is also that w^(1 - n) = u, or w = u^(1/(1 - n)).

    Raises `InputError` if w doesn't have the given value at a singular point, where there may be no such solution.
    """
    x, m, reading = equation.x, 1 - equation.power, equation.reading
    claims = []
    if power_of_w is None:
        rate = equation.q + equation.r * w**-m
    else:
        rate = equation.q + equation.r / power_of_w
        value, same = (w**m, power_of_w) if m.is_integer else (w, power_of_w ** (1 / m))
        claims.append(SolutionClaim(x, value, (_ZERO, _ZERO, Integer(1), same), (), reading))
    try:
        claims.append(SolutionClaim(x, w, (_ZERO, Integer(1), -rate, equation.p), equation.conditions, reading))
        start, _ = equation.value
        is_limit = not equation.is_regular and not is_finite(w.subs(x, start))
        limits = {start: Approach(start)} if is_limit else {}
        return [*dict.fromkeys(said for claim in claims for said in claim.check(limits=limits))]
    except VerificationFailed:
        if equation.is_regular:
            raise
    raise _without_value(equation.value[0])
