"""Levels with a closed form, where no formula for all levels is known: from the conditions on E to the levels.

`kovacic.conditions` says for which E and parameters y'' = (V - E) y has a Liouvillian solution, and gives solutions.  One of
them is the function of a level if it is the square integrable one at both ends, which its exponents there tell.  With that:

- no value admits a closed form: no level has one;
- there are no parameters, and E is one of finitely many numbers: where each of them was found to give levels or none, these are
  all levels with a closed form.  E gives none where a solution is the only square integrable one at an end (limit point), and
  isn't square integrable at the other; where it isn't above the infimum of V, or above a threshold of the continuous spectrum;
- each value is of case 1: each level with a closed form has a polynomial of some degree d.

Which level it is says Sturm's theorem: a square integrable solution with k zeros is the k-th level.

References: A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467; A. G. Ushveridze, Quasi-exactly Solvable Models (1994);
M. Razavy, Amer. J. Phys. 48 (1980) 285; M. F. Manning, J. Chem. Phys. 3 (1935) 136.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial, reduce
from itertools import chain
from typing import Any, NamedTuple

import sympy
from sympy.utilities.iterables import sift

from kovacic.bound_states.coordinates import Original, circle_point, near
from kovacic.bound_states.ends import Examined, leading
from kovacic.bound_states.energies import tidied
from kovacic.bound_states.levels import NO_FORMULA_FOR_ALL, Algebraic
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs, Uncovered, exceeds
from kovacic.closed_form.order import point_between
from kovacic.engine.places import analyse
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.limits import Budget, Limits
from kovacic.parametric.api import conditions_of
from kovacic.parametric.natural import Natural
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.regions import ParameterRegion
from kovacic.parametric.solutions import PolynomialSolution, jacobi, translated_solution, weight_by_signs
from kovacic.parametric.statements import Statement, Vanishes

#: Functions in an antiderivative whose limits at the ends are found at once.
_WITH_LIMITS = (sympy.exp, sympy.log, sympy.atan, sympy.erf)


def norm_of(wave: Any, x: Any, domain: tuple[Any, Any]) -> Any:
    """The integral of the squared wave; None if it has no known antiderivative with limits at the ends, or the time is over.

    >>> x = sympy.Symbol("x")
    >>> norm_of(sympy.exp(-1 / x) / x, x, (0, sympy.oo))
    1/2
    """
    found = None
    with suppress(LimitExceeded):
        found = antiderivative(wave**2, x)
    if found is None or found.atoms(sympy.Function) - found.atoms(*_WITH_LIMITS):
        return None
    first, last = domain
    total = sympy.limit(found, x, last, "-") - sympy.limit(found, x, first, "+")
    norm = sympy.simplify(total)
    return norm if norm.is_positive and not norm.has(x) else None


#: The natural number in conditions.
_NUMBER = sympy.Dummy("d")
#: Of truth values.
_ALL, _NONE = frozenset({True}), frozenset({False})
_BARRED = "a solution with a polynomial that decays at one end doesn't at the other, whatever its degree"
_NUMBERED = "a level with k zeros is number k (Sturm)"


def closed_forms(question: Examined, max_degree: int, limits: Limits) -> ClosedForms:
    """The closed forms of a potential; without `ends`, at which solutions are unknown, only a proof that there are none."""
    conditions = _solvable_conditions(question, limits)
    found = ClosedForms(question, conditions, max_degree)
    if conditions is None:
        return found
    found.complete = True
    if not conditions.regions:
        found.reason = f"the equation has no Liouvillian solution for any {question.energy}: {conditions.theory}"
        return found
    try:
        found.reason = found.with_parameters() if question.parameters else found.of_numbers()
    except LimitExceeded as limit:  # levels that were found stay
        found.complete, found.reason = False, f"undecided: {limit}"
    # The norms come last: an integral that takes the rest of the time costs no level.
    x = sympy.Symbol(question.variable)
    for key, level in found.levels.items():
        states = tuple(replace(s, norm=norm_of(s.wave, x, question.domain)) for s in level.states)
        found.levels[key] = replace(level, states=states)
    return found


def _solvable_conditions(question: SpectralProblem, limits: Limits) -> ParametricAnswer | None:
    """The E and parameters with a Liouvillian solution; None if the list isn't proven, or if there always is one.

    The equation is that in t, so that solutions are functions of t.  With several conjugate pairs of poles it may take minutes.
    """
    parsed = question.parsed
    with suppress(LimitExceeded):
        degrees = [factor.degree for factor, _ in parsed.S.field.factor(parsed.S.den)]
        if sum(degrees) > degrees.count(1) + 2:
            return None
        conditions = conditions_of(replace(parsed, equation=None), question.known, 0, limits)
        if conditions.complete is True and conditions.generic.known and conditions.generic.case is None:
            return conditions
    return None


class _Window(NamedTuple):
    """Bounds: each level is above the first number and at most the second."""

    low: Any = -sympy.oo
    high: Any = sympy.oo

    @classmethod
    def of(cls, question: Examined) -> _Window:
        """From the infimum of V, and the thresholds of the continuous spectrum."""
        real = question.real
        thresholds = [end.threshold for end in question.ends if isinstance(end.threshold, sympy.Rational)]
        high = min(thresholds, default=sympy.oo)
        low = -sympy.oo
        if real is not None and not question.boundary.is_mixed:
            low = question.kinetic * _number_below(real.V, real.t, real.original.monotonic_range)
        return cls(low if low.is_Rational else -sympy.oo, high)

    def last_number(self, function: Any, E: Any, d: Any) -> int | None:
        """A degree from which on no E with `function`(E, d) = 0 lies in the window, or None if none is known."""
        polynomial = sympy.Poly(function, E)
        is_solved = polynomial.degree() == 1 and max(map(abs, self)).is_finite
        if not function.free_symbols <= {E, d} or not (is_solved or polynomial.is_ground):
            return None
        # Beyond the zeros of these, E(d) stays inside or outside, and a function of d alone has no zero.
        parts = filter(None, [polynomial.LC(), *(function.subs(E, end) for end in self)])
        roots = sympy.Poly(sympy.Mul(*parts), d).real_roots()
        last = int(max([-1, *map(sympy.floor, roots)])) + 1
        if is_solved and self.low < sympy.solve(function.subs(d, last), E)[0] <= self.high:
            return None
        return last


def _number_below(V: Any, t: Any, bounds: tuple[Any, ...]) -> Any:
    """A lower bound of a rational function over Q on an interval where it has no pole, or -oo if none is found, or for ().

    It is a number below one of the values, that isn't a value itself.
    """
    if not bounds:
        return -sympy.oo
    low, high = bounds
    num, den = (sympy.Poly(part, t) for part in sympy.fraction(sympy.cancel(V)))
    if not {num.domain, den.domain} <= {sympy.QQ, sympy.ZZ}:
        return -sympy.oo
    number = sympy.floor(V.subs(t, point_between(low, high)))
    for k in range(40):  # each number is twice as far away; V may fall to -oo
        number -= 2**k
        if not any(low < root < high for root in (num - number * den).real_roots()):
            return number
    return -sympy.oo


@dataclass
class ClosedForms:
    """The levels with a closed form; `complete`: it is proven that these are all; during the search, that none was missed.

    `reason` is the proven statement about them with its reason, or why it is undecided; `higher` a possible degree of P that
    wasn't tried.  `are_all_listed` says that none was missed for the degrees that were tried: some levels need several
    equations for E and the parameters.
    """

    question: Examined
    conditions: Any  # a `ParametricAnswer`; None if it isn't proven to be complete, and there is no search
    max_degree: int
    reason: str = NO_FORMULA_FOR_ALL
    levels: dict[Any, Algebraic] = field(default_factory=dict)
    complete: bool = False
    higher: int | None = None
    are_all_listed: bool = True

    @cached_property
    def window(self) -> _Window:
        """Where levels may be."""
        return _Window() if self.question.parameters else _Window.of(self.question)

    @property
    def E(self) -> Any:
        return sympy.Symbol(self.question.energy)

    @property
    def constants(self) -> dict[Any, Any]:
        """The value of the algebraic constant that is a parameter of the conditions, sqrt(2) for instance."""
        point = self.conditions.constant
        return {sympy.Symbol(name): c.to_sympy(_NUMBER) for name, c in zip(point.names, point.values, strict=True)}

    def of_numbers(self) -> str:
        """Finds all E at which a potential without parameters has a closed form, and returns the statement that is proven."""
        excluded: list[Any] = []
        for region in self.conditions.regions:
            for number, polynomial in self._listed(region):
                by_fit = self._by_fit(region, number, polynomial)
                if (_ALL, _ALL) in by_fit:
                    self._add([self._level(by_fit[_ALL, _ALL], polynomial, sympy.Integer(0), [])])
                # A solution that is meant at an end is the only one.
                if (_ALL, _NONE) in by_fit or (_NONE, _ALL) in by_fit:
                    excluded.append(polynomial)
                elif (_ALL, _ALL) not in by_fit:  # unless nothing is Liouvillian at the zero of a linear polynomial
                    energy = _only_zero(polynomial, self.E)
                    is_barred = energy is not None and self.conditions.case_at({self.question.energy: energy}) is None
                    self.complete = self.complete and is_barred
        theory = self.conditions.theory
        zeros = " or ".join(f"{self.question.shown(polynomial)} = 0" for polynomial in dict.fromkeys(excluded))
        verb = "is square integrable" if self.question.is_limit_point else "is the smaller one"
        others = zeros and f"at {zeros} the solution that {verb} at one end isn't at the other; "
        energies = f"any other real {self.question.energy}" if excluded else "the energy of a level"
        if not self.complete:
            return self._incomplete()
        if self.levels:
            return f"{_NUMBERED}; {others}{theory}"
        return f"{others}the equation has no Liouvillian solution for {energies}: {theory}"

    def _incomplete(self) -> str:
        """The statement about an incomplete list of levels."""
        if not self.levels:
            return f"{NO_FORMULA_FOR_ALL}; degrees up to {self.max_degree} were tried"
        others = "whether others are Liouvillian isn't known"
        if all(region.case == 1 for region in self.conditions.regions):
            others = f"each level with a closed form has a polynomial of some degree d: {self.conditions.theory}"
        which = "the levels" if self.are_all_listed else "levels, perhaps not all,"
        return f"{which} with a polynomial of degree d <= {self.max_degree}; {others}"

    def _listed(self, region: ParameterRegion) -> Iterator[tuple[int | None, Any]]:
        """The E in the window at which the statement may hold: degrees, or None, with irreducible polynomials in E."""
        for alternative in region.statement.alternatives:
            parts = alternative.conjuncts
            for number in self._numbers(region, parts):
                functions = [_function_for(part, number, self.constants) for part in parts]
                if None in functions:
                    self.complete = False
                    continue
                together = reduce(sympy.gcd, (sympy.Poly(f, self.E, extension=True) for f in functions))
                for factor, _ in together.factor_list()[1]:
                    if factor.domain not in (sympy.QQ, sympy.ZZ):
                        self.complete = False
                    elif any(self.window.low < root <= self.window.high for root in factor.real_roots()):
                        yield number, factor.monic().as_expr()

    def _numbers(self, region: ParameterRegion, parts: Sequence[Statement]) -> Sequence[int | None]:
        """The degrees to be tried: as far as E may be in the window, if that is known, else up to `max_degree`."""
        natural = [part for part in parts if isinstance(part, Natural)]
        if not natural:
            return (None,)
        lasts = [self.window.last_number(factor, self.E, _NUMBER) for factor in _factors_of(natural[0])]
        if None in lasts:
            self.complete = False
            if region.case == 1 and self._are_examined:
                self.higher = self.max_degree + 1
        return range(max([self.max_degree + 1, *filter(None, lasts)]))

    @property
    def _are_examined(self) -> bool:
        """True if exponents decide what is square integrable at the ends; at an ordinary point that is a condition on E."""
        ends = self.question.ends
        return bool(ends) and not any(end.is_regular for end in ends)

    def _by_fit(self, region: ParameterRegion, number: int | None, polynomial: Any) -> dict[Any, PolynomialSolution]:
        """The region's solutions of a degree at all zeros of a polynomial in E, if the ends are examined.

        By whether they are the square integrable ones at the left and at the right end, for each real zero.
        """
        found: dict[Any, PolynomialSolution] = {}
        energies = sympy.Poly(polynomial, self.E).real_roots()
        for one in region.solution(number) if self._are_examined else ():
            if any(sympy.rem(sympy.numer(sympy.together(f)), polynomial, self.E) for f in one.conditions):
                continue
            solution = self._at(one, polynomial)
            demands = demands_of(solution.y, self.question)
            fit = (frozenset(bool(demand.subs(self.question.E, energy)) for energy in energies) for demand in demands)
            found.setdefault(tuple(fit), solution)
        return found

    def _at(self, solution: PolynomialSolution, polynomial: Any) -> PolynomialSolution:
        """The solution at the zeros of a polynomial in E, with its value if there is one zero."""
        energy = _only_zero(polynomial, self.E)
        if energy is None:
            return self._with_remainders(solution, polynomial, self.E)
        return replace(solution, y=solution.y.subs(self.E, energy))

    def _with_remainders(self, solution: PolynomialSolution, function: Any, unknown: Any) -> PolynomialSolution:
        """The solution where a polynomial in an unknown vanishes: coefficients of its polynomials are remainders by it."""
        t = self.question.t
        y = sympy.Integer(1)
        for factor in sympy.Mul.make_args(solution.y):
            if factor.is_polynomial(t):
                parts = (sympy.fraction(sympy.together(c)) for c in sympy.Poly(factor, t).all_coeffs())
                factor = sympy.Poly([sympy.rem(num, function, unknown) / den for num, den in parts], t).as_expr()
            y *= factor
        return replace(solution, y=y)

    def _add(self, levels: Iterable[Algebraic]) -> None:
        """With those that aren't there by a polynomial of another degree: x P for the exponent 0 at x = 0 is P for 1."""
        for level in levels:
            self.levels.setdefault((level.constraint, level.polynomial, level.conditions), level)

    def with_parameters(self) -> str:
        """Finds the levels with a polynomial of degree 0, 1, ..., `max_degree`, and returns the statement that is proven."""
        if not self._are_examined:
            self.complete = False
            return self._incomplete()
        is_barred = True
        exceptions: dict[str, None] = {}
        for region in self.conditions.regions:
            ways = [*self._ways_out(region)] or [None]
            self.complete = self.complete and all(ways)
            if None not in ways:
                continue
            parts = region.statement.conjuncts
            functions = [part.function.to_sympy(_NUMBER) for part in parts if isinstance(part, Vanishes)]
            fixed = [function for function in functions if not function.has(self.E)]
            is_barred = is_barred and (bool(fixed) or region.case != 1)
            exceptions.update((f"{self.question.shown(function)} = 0", None) for function in fixed)
            numbers = self._numbers(region, parts)
            if len(functions) + sum(bool(part.factors) for part in region.naturals) < len(parts):
                continue
            zeros = [function.subs(self.constants) for function in functions]
            for solution in chain.from_iterable(map(region.solution, numbers)):
                if not all(sympy.numer(sympy.together(f)).is_polynomial(self.E) for f in solution.conditions):
                    # With sqrt(-E) in a condition, of which one value is meant, there is no polynomial in E.
                    self.complete, self.levels, self.higher = False, {}, None
                    return NO_FORMULA_FOR_ALL
                self._add(self._under_conditions(solution, zeros))
        if self.levels or not is_barred:
            return self._incomplete()
        barred = f"{_BARRED}, unless {' or '.join(exceptions)}" if exceptions else _BARRED
        return f"{barred}: {self.conditions.theory}" if self.complete else f"{NO_FORMULA_FOR_ALL}; {barred}"

    def _ways_out(self, region: ParameterRegion) -> Iterator[bool | None]:
        """For each choice of exponents: None if a solution may be square integrable at both ends; else whether it decays.

        exp(-(1 + d) x) P(exp(x)) decays at one end and grows at the other; what decays at an end is the only one that does.
        """
        question, signs = self.question, self.question.signs
        are_zeros = all(isinstance(part, Vanishes) for part in region.statement.conjuncts)
        weights = (weight_by_signs(analyse(part.S, Budget()), question.parsed.variable) for part in region.naturals)
        choices = [*chain.from_iterable(by_signs(None) for by_signs in filter(None, weights))]
        # P has no zero at an end, |t| = 1 or t real, and its degree at infinity
        size = sympy.sqrt(question.t**2 + 2)
        functions = [(one.y * size**one.degree, one.degree) for one in choices]
        if are_zeros:
            functions = [(one.y, one.degree) for one in region.solution(0)]
        for y, degree in functions if region.case == 1 else ():
            if y.has(jacobi, sympy.assoc_laguerre):
                yield None
                continue
            demands = [*demands_of(y, question)]
            if sympy.false not in tidied([exceeds(signs.real(degree), 0, strict=False), *demands], signs):
                yield None
                continue
            ends = zip(question.ends, demands, strict=True)
            yield any(end.is_limit_point and signs.holds(demand) for end, demand in ends)

    def _under_conditions(self, solution: PolynomialSolution, functions: list[Any]) -> Iterator[Algebraic]:
        """The levels where the functions and those in the conditions of the solution vanish, of which one may be free of E."""
        numerators = [sympy.numer(sympy.together(function)) for function in (*functions, *solution.conditions)]
        in_E, others = sift(dict.fromkeys(numerators), lambda function: function.has(self.E), binary=True)
        polynomial = reduce(sympy.gcd, in_E, sympy.Integer(0))
        signs = self.question.signs
        if not polynomial.has(self.E) or len(others) > 1:
            is_false = any(signs.sign(signs.real(one)) is not None for one in others)
            self.are_all_listed = self.are_all_listed and is_false
            return
        if sympy.LC(polynomial, self.E).could_extract_minus_sign():
            polynomial = -polynomial
        solution = self._at(solution, polynomial)
        _, constraints = sympy.factor_list(sympy.Mul(*others))
        for constraint, _ in constraints or [(sympy.Integer(0), 1)]:
            letters = sorted(constraint.free_symbols, key=lambda a: (sympy.degree(constraint, a), str(a)))
            there = self._with_remainders(solution, constraint, letters[0]) if letters else solution
            bounds = _bounds(sympy.expand(signs.real(constraint)), solution, signs)
            conditions = [*bounds, *demands_of(there.y, self.question)]
            level = self._level(there if len(letters) == 1 else solution, polynomial, constraint, conditions)
            if sympy.false not in level.conditions:
                yield level

    def _level(
        self, solution: PolynomialSolution, polynomial: Any, constraint: Any, conditions: Sequence[Any]
    ) -> Algebraic:
        """With the energies, and which levels they are, where there are no parameters."""
        question = self.question
        x, t = sympy.Symbol(question.variable), question.t
        equation = question.parsed.equation
        wave = question.plain(solution.y if equation is None else translated_solution(solution.y, equation))
        # The factors of y that are polynomials in t, but for those that vanish at an end: they have the zeros of y.
        P = sympy.Mul(*(f.as_base_exp()[0] for f in sympy.Mul.make_args(solution.y) if f.is_polynomial(t)))
        assert question.real is not None
        original, at, middle = question.real.original, None, None
        with suppress(Uncovered):
            at = original.middle()
        if at is not None:
            smooth = wave.replace(*_root_about(at, original, question))
            middle, wave = int(smooth != wave), smooth.as_independent(x, as_Add=False)[1]
            original = original.on(at, question.domain[1])
        if question.original.is_circular:
            P = sympy.numer(sympy.cancel(P.subs(t, circle_point(t))))
        P = sympy.Poly(question.plain(P), t)
        at_ends = sympy.Mul(*(t - end.point for end in question.ends if end.point != sympy.oo))
        P = P.quo(sympy.gcd(P, sympy.Poly(at_ends, t) ** P.degree()))
        known = map(question.plain, tidied(conditions, question.signs))
        level = Algebraic(
            int(solution.degree),
            question.plain(constraint),
            question.plain(sympy.factor(polynomial)),
            wave,
            tuple(condition for condition in known if condition != sympy.true),
            P=P,
            range=tuple(map(question.plain, original.monotonic_range)),
            middle=middle,
        )
        return level if question.parameters else replace(level, states=tuple(level.states_at({}, self.E)))


def _factors_of(natural: Natural) -> list[Any]:
    """Polynomials in the number and the parameters of which one vanishes."""
    return [sympy.numer(sympy.together(factor.to_sympy(_NUMBER))) for factor in natural.factors or ()]


def _only_zero(polynomial: Any, E: Any) -> Any:
    """The zero of a linear polynomial; None for another one."""
    return sympy.solve(polynomial, E)[0] if sympy.degree(polynomial, E) == 1 else None


def _function_for(statement: Statement, number: int | None, constants: dict[Any, Any]) -> Any:
    """A function of E that vanishes where the statement holds for a number: Delta_d where the exponents give d for all E.

    None if Delta_d is unknown, and for other kinds of statements.
    """
    if isinstance(statement, Vanishes):
        return statement.function.to_sympy(_NUMBER).subs(constants)
    if not isinstance(statement, Natural) or number is None or not statement.factors:
        return None
    values = [factor.subs(_NUMBER, number) for factor in _factors_of(statement)]
    found = sympy.Mul(*filter(None, values))
    for determinant in statement.determinants(number) if 0 in values else ():
        if determinant.exponents:  # it vanishes for single E, and is among the values
            continue
        if determinant.factors is None:
            return None
        found *= sympy.Mul(*(factor.to_sympy(_NUMBER) for factor in determinant.factors))
        if determinant.system:
            system = (function.to_sympy(_NUMBER).subs(constants) for function in determinant.system)
            found *= reduce(partial(sympy.gcd, extension=True), system)
    return found.subs(constants)


def demands_of(v: Any, question: Examined) -> Iterator[Any]:
    """When a function v of t, whose v'/v is rational, is the square integrable one at each end, in real symbols."""
    t, u = question.t, sympy.Dummy("u")
    rate = sympy.cancel(sympy.together(sympy.diff(v, t) / v))
    if question.original.is_circular:  # v sqrt(du/dt) as a function of the real u
        on_circle = circle_point(t)
        slope = sympy.diff(on_circle, t)
        rate = rate.subs(t, on_circle) * slope - sympy.diff(slope, t) / slope / 2
    for end in question.ends:
        there = near(end.point, u)
        local = rate.subs(t, there) * sympy.diff(there, u)
        if end.point == sympy.oo:  # of u v(1/u)
            local += 1 / u
        order, strength = leading(question.signs.real(local), u)
        if order < -1:  # v ~ exp(-strength/(k u^k)) with k = -order - 1
            yield exceeds(strength * end.direction ** (-order - 1), 0, strict=True)
        else:
            exponent = strength if order == -1 else sympy.Integer(0)
            yield question.demand(end.side, sympy.Integer(end.mu), sympy.simplify(2 * exponent - 1))


def _root_about(at: Any, original: Original, question: SpectralProblem) -> tuple[Any, Any]:
    """For `replace`: odd powers of sqrt(t - c), t = c where t turns, as those of a multiple that changes its sign there.

    cos(theta) - cos(c) is a multiple of sin((theta - c)/2)^2 for c = 0 or pi, that of cosh is one of sinh(theta/2)^2.
    """
    x = sympy.Symbol(question.variable)
    distance = question.plain(original.t - original.value(original.theta_at(at)))
    half = question.plain(original.rate * (question.x - at) / 2)
    root = sympy.sinh(half) if original.kind == "cosh" else sympy.sin(half)

    def is_odd(e: Any) -> bool:
        return bool(e.is_Pow and e.exp.is_Rational and e.exp.q == 2 and not sympy.cancel(e.base / distance).has(x))

    return is_odd, lambda e: root ** (2 * e.exp)


def _bounds(constraint: Any, solution: PolynomialSolution, signs: Signs) -> list[Any]:
    """The bounds of the parameter that the constraint determines, for its value; false among them if they exclude that value.

    Nothing but that it has a real zero is asked of a constraint that is linear in no parameter.
    """
    used = signs.real(solution.y).free_symbols
    for symbol in sorted(constraint.free_symbols, key=lambda s: (s in used, str(s))):
        if sympy.degree(constraint, symbol) == 1:
            value = sympy.factor(-constraint.coeff(symbol, 0) / constraint.coeff(symbol, 1))
            return signs.bounds_of(symbol.name, value)
    return [] if signs.sign(constraint) is None else [sympy.false]
