"""Riccati equations w' = p + q w + r w^2: all solutions, with one constant, and the rational and algebraic ones.

By w = -u'/(r u) it is linear, u'' - (q + r'/r) u' + p r u = 0, and w(a) = v means u'(a) = -r(a) v u(a).  If r(a) = 0 that
equation is singular at a, though Riccati's isn't.  1/w satisfies z' = -r - q z - p z^2, which gives w = p u/u' with

    u'' + (q - p'/p) u' + p r u = 0,        w(a) = v where u(a) : u'(a) = v : p(a),                                   (1)

regular at a if p(a) isn't 0.  If both vanish, u and -u'/r still have values at a for all solutions u, and the solution is
the C1 u1 + C2 u2 for which the second is v times the first.

If a solution u1 has a rational omega = u1'/u1, then u = u1 (C + V) with V' = E = exp(int q + r'/r - 2 omega dx), Abel's
formula, so that

    w = -omega/r - E/(r (C + int E dx)),                                                                              (2)

a rational solution and a term that the constant moves.  Bernoulli's equations, w' = q w + r w^n, are linear in w^(1 - n).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from typing import Any

import sympy
from sympy import Add, cancel, expand, powsimp

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms, display, is_seen_negative
from kovacic.closed_form.product import product
from kovacic.equation import Equation
from kovacic.errors import InputError, UnsatisfiableConditions
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.behaviour import value_or_limit
from kovacic.general_solution.first_order import (
    CheckedSolution,
    FirstOrderEquation,
    Solver,
    check_first_order,
    is_unit,
    read_first_order,
    solved_linear,
    with_letters_for_constants,
    zeros_of,
)
from kovacic.general_solution.integrands import NUMBERS, ratfunc, relative_slope
from kovacic.general_solution.question import free_constants
from kovacic.general_solution.substitution import by_functions
from kovacic.general_solution.textbook import as_quotient, in_book_form
from kovacic.general_solution.waves import rational_in_waves
from kovacic.general_solution.zero import is_zero
from kovacic.limits import DEFAULT_LIMITS, MOST_CHARACTERS, Budget, Limits, check_time, limited, manageable
from kovacic.numbers.numerals import as_latex, plain_text
from kovacic.reading.read import read_coefficients
from kovacic.solution import Solution, solve
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types
#: The sign e(s) in C_nu' = e(s) C_(nu-s) - s nu C_nu/z for s = 1 and s = -1 [DLMF 10.6.2, 10.29.2].
_SIGN_OF_NEIGHBOUR: dict[Any, Callable[[int], int]] = {
    sympy.besselj: lambda s: s,
    sympy.bessely: lambda s: s,
    sympy.besseli: lambda s: 1,
    sympy.besselk: lambda s: -1,
}


def linear_equation(equation: FirstOrderEquation) -> tuple[Expr, Expr]:
    """The linear equation for u, and u(x), whose name is w_ for w(x)."""
    x = equation.x
    u = sympy.Function(f"{equation.function.func}_")(x)
    slope = cancel(equation.q + equation.r.diff(x) / equation.r)
    return sympy.Eq(u.diff(x, 2) - slope * u.diff(x) + cancel(equation.p * equation.r) * u, 0), u


def solved_riccati(equation: FirstOrderEquation, solver: Solver) -> CheckedSolution:
    """The solution.  Raises `NotImplementedError` for a value at a point where no linear equation is seen to be regular."""
    x = equation.x
    start, _ = equation.value
    constants: tuple[Expr, ...] = ()
    exceptions: tuple[Expr, ...] = ()
    zeros: list[Expr] = []
    notices: list[str] = []
    power_of_w = None
    if equation.power != 2 or (equation.p == 0 and equation.is_regular):
        w, power_of_w = _of_bernoulli(equation)
        forms = [w]
        zeros = zeros_of(forms[0], x, equation.entries)
        if start is None and equation.power.is_odd:
            notices.append(f"-{equation.function} is a solution, too")
    else:
        p, q, r, n = equation.entries
        # (1) is solved if only that is regular at the value, or has the simpler coefficients
        if start is None:
            is_inverted = p != 0 and not p.has(x) and r.has(x)
        else:
            is_inverted = not is_unit(r, x, start) and is_unit(p, x, start)
        solved_for = replace(equation, entries=(-r, -q, -p, n)) if is_inverted else equation  # for 1/w
        u, constants, linear = _solved_linear(equation, solved_for, solver)
        notices = linear.notices
        exceptions = tuple(e.xreplace(linear.own) for e in linear.pair_exceptions)
        forms = [*_forms(u, constants, solved_for)]
        if is_inverted:  # over one denominator, which doesn't divide by 1/w
            forms = [as_quotient(1 / w) for w in forms]
    forms += [as_quotient(forms[0]), sympy.signsimp(forms[0]), *rational_in_waves(forms[0])]
    forms += [-n / -d for n, d in map(sympy.fraction, forms)]
    w = shortest(forms).xreplace(dict.fromkeys(constants, equation.constant()))
    if len(constants) < 2:
        w = in_book_form(w, x)
    notices += check_first_order(equation, w, power_of_w)
    return CheckedSolution((w,), notices, zeros, exceptions, power_of_w)


def _of_bernoulli(equation: FirstOrderEquation) -> tuple[Expr, Expr | None]:
    """w for w' = q w + r w^n, and u = w^(1 - n), by which it is found; w = 0 through 0, for n > 1."""
    m = 1 - equation.power
    start, v = equation.value
    if v == 0:
        if not m.is_negative:
            raise NotImplementedError("undecided: more than one solution may have the value 0")
        return sympy.S.Zero, None
    if start is not None and m.is_integer is False and is_seen_negative(v):
        said = f"there is no real solution with {equation.conditions[0].text}"
        raise UnsatisfiableConditions(f"{said}: ({v})^({equation.power}) isn't real")
    (u,) = solved_linear(equation.of_power).values
    if start is None:
        return u ** (1 / m), u
    u = powsimp(as_quotient(u / v**m))  # which doesn't divide by v
    return v * u ** (1 / m), v**m * u  # the branch with the sign of v


def _solved_linear(
    equation: FirstOrderEquation, solved_for: FirstOrderEquation, solver: Solver
) -> tuple[Expr, tuple[Expr, ...], Any]:
    """u, its free constants, and the answer of the solver: one solution u for a value at an ordinary point, or all of them."""
    x = equation.x
    a, v = equation.value
    linear, u = linear_equation(solved_for)
    start: dict[Expr, Expr] = {}
    if a is not None and is_unit(solved_for.r, x, a):
        there = (v, equation.p) if solved_for is not equation else (sympy.S.One, -equation.r * v)
        start = {e.subs(x, a): value.subs(x, a) for e, value in zip((u, u.diff()), there, strict=True)}
    answer = solver(linear, u, start)
    solution, constants = with_letters_for_constants(answer, sympy.Tuple(linear, *start.items()).free_symbols)
    if a is not None and not start:  # those of C1 u1 + C2 u2 for which -u'/r is v u at a: one, or all
        basis = [solution.diff(constant) for constant in constants]
        first, second = (value_or_limit(-y.diff(x) / equation.r, x, a) - v * value_or_limit(y, x, a) for y in basis)
        if not (is_zero(first) and is_zero(second)):
            solution = second * basis[0] - first * basis[1]
    return solution, constants, answer


# -------------------------------------------------------------------------------------------------------------- forms


def _forms(u: Expr, constants: Sequence[Expr], equation: FirstOrderEquation) -> Iterator[Expr]:
    """w = -u'/(r u) as a sum over the factors of u, and by (2) for each solution with a rational omega."""
    x = equation.x
    yield _with_short_fractions([-term / equation.r for term in Add.make_args(_rate_of(u, constants, x))], x)
    if len(constants) < 2:
        return
    slope = ratfunc(equation.q + equation.r.diff(x) / equation.r, x)
    for u1 in map(u.diff, constants):
        omega = ratfunc(relative_slope(u1, x), x)
        if slope is None or omega is None or slope.field != omega.field:
            continue
        powers = product(slope - omega - omega)
        E = display(powers, Atoms(x)).xreplace(NUMBERS)
        V = None
        fractions = sum(abs(power.rational_exponent or Fraction()) * power.base.degree for power in powers.powers)
        if 20 * fractions <= MOST_CHARACTERS:  # of some twenty characters each; of order 80 they take 10 s
            V = antiderivative(E, x)
        # E is written before the quotient, too: an integral that stays has it in the same form
        V = sympy.Integral(E, x) if V is None else sympy.factor_terms(_with_short_fractions(Add.make_args(V), x))
        rational = -Atoms(x).ratio(omega).xreplace(NUMBERS) / equation.r
        yield _with_short_fractions([rational, -E / (equation.r * (constants[0] + V))], x)


def _with_short_fractions(terms: Sequence[Expr], x: Expr) -> Expr:
    """The rational terms as one fraction or in partial fractions; the others with theirs in lowest terms."""
    parts = by_functions(Add(*terms), lambda factor: factor.is_rational_function(x))
    total = cancel(parts.pop(sympy.S.One, sympy.S.Zero))
    rest = (sympy.factor(rational) * function for function, rational in parts.items())
    return Add(shortest([total, sympy.apart(total, x)]), *rest)


def _rate_of(u: Expr, constants: Sequence[Expr], x: Expr) -> Expr:
    """u'/u, where of the constants of u only their quotient matters."""
    u = sympy.Mul(*(_single_wave(factor, x) for factor in sympy.Mul.make_args(u)))
    if len(constants) == 2:
        c1, c2 = constants
        u = u.subs(sympy.atan(c2 / c1), -c1).subs(c2, 1)
    if u.has(*_SIGN_OF_NEIGHBOUR) and manageable(u):
        return powsimp(sympy.factor_terms(_slope_by_neighbours(u, x)) / u)
    return relative_slope(u, x)


def _single_wave(factor: Expr, x: Expr) -> Expr:
    """cos(z - atan(b/a)) for a multiple a cos(z) + b sin(z) of it; any other factor itself."""
    for wave in factor.atoms(sympy.cos) if factor.is_Add else ():
        sine = sympy.sin(*wave.args)
        a, b = factor.coeff(wave), factor.coeff(sine)
        is_wave = a != 0 and not (a.has(x) or b.has(x)) and expand(factor - a * wave - b * sine) == 0
        if is_wave and expand(a**2 + b**2) != 0:
            return sympy.cos(wave.args[0] - sympy.atan(cancel(b / a)))
    return factor


def _slope_by_neighbours(y: Expr, x: Expr) -> Expr:
    """y', where z^nu J_nu has the slope z^nu J_(nu-1) z', and z^nu J_(-nu) has -z^nu J_(1-nu) z'; with Y, I, K likewise."""
    letters = {f: sympy.Dummy() for f in sorted(y.atoms(*_SIGN_OF_NEIGHBOUR), key=str) if f.has(x)}
    linear = y.xreplace(letters)
    terms = [linear.xreplace(dict.fromkeys(letters.values(), 0)).diff(x)]
    for f, letter in letters.items():
        nu, z = f.args
        is_negative = nu.could_extract_minus_sign() if nu.is_positive is None else not nu.is_positive
        s = -1 if is_negative else 1
        factor = linear.diff(letter)
        own = factor.diff(x) - s * nu * z.diff(x) / z * factor
        other = _SIGN_OF_NEIGHBOUR[f.func](s) * z.diff(x) * factor
        terms += [powsimp(cancel(c)) * g for c, g in ((own, f), (other, f.func(nu - s, z)))]
    return Add(*terms)


# ----------------------------------------------------------------------------------- rational and algebraic solutions


@dataclass(frozen=True)
class RiccatiSolutions:
    """All rational and algebraic solutions of w' = p + q w + r w^2, as SymPy expressions in the variable.

    Iteration gives the rational ones.  A notebook shows all that are known.

    Attributes
    ----------
    rational : tuple of sympy.Expr
        The rational solutions, if they are finitely many.
    family : sympy.Expr or None
        All solutions, with a constant C1, if all are algebraic and known in closed form; C1 may be infinite.
    polynomial : sympy.Expr or None
        A polynomial in w with the algebraic solutions of least degree as its roots.
    all_algebraic : bool or None
        True if all solutions are algebraic; None if that wasn't determined.
    solution : Solution
        The answer for the linear equation.

    Examples
    --------
    >>> import kovacic
    >>> found = kovacic.solve_riccati("w' = x^2 + 3 - w^2")
    >>> found.rational, found.family, found.polynomial, found.all_algebraic
    (((x**2 + 1)/x,), None, None, False)
    >>> kovacic.solve_riccati("w' = 2*w/x + w^2").family
    -3*C1*x**2/(C1*x**3 + 1)
    """

    rational: tuple[Any, ...]
    family: Any
    polynomial: Any
    all_algebraic: bool | None
    solution: Solution

    def __iter__(self) -> Any:
        return iter(self.rational)

    def _repr_latex_(self) -> str:
        found = [("w", w) for w in (self.family, *self.rational) if w is not None]
        if self.polynomial is not None:
            found.append((as_latex(self.polynomial), 0))
        return r",\quad ".join(f"{left} = {as_latex(right)}" for left, right in found).join("$$")


@limited
def solve_riccati(
    p: Any, q: Any = None, r: Any = None, *, var: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> RiccatiSolutions:
    """All rational and algebraic solutions of the Riccati equation w' = p + q w + r w^2 with rational p, q, r.

    Parameters
    ----------
    p, q, r : str, number or sympy.Expr
        The coefficients; or `p` alone is the equation, as text or from SymPy.
    var : str
        The name of the variable, if it isn't clear.
    limits : Limits
        Bounds on the input and on the work.

    Returns
    -------
    RiccatiSolutions
        If the group of the linear equation is trivial or {1, -1}, all solutions are rational: then `family` has them.

    Raises
    ------
    InputError
        For r = 0, which isn't a Riccati equation, and for what `kovacic.solve` refuses.

    Examples
    --------
    >>> found = solve_riccati("x^2 + 3", 0, -1)
    >>> found.rational, found.family, found.all_algebraic
    (((x**2 + 1)/x,), None, False)
    >>> solve_riccati("w' = x^2 + 3 - w^2").rational
    ((x**2 + 1)/x,)
    """
    given = _read_coefficients(p, q, r, var, limits)
    R, Q, P = given.a, given.b, given.c
    unit = R / R
    linear = Equation(unit, -(Q + R.derivative() / R), P * R, R - R, None, given.variable, "u")
    solution = solve(linear, limits=limits)
    group = solution.group
    all_algebraic = None if group is None else group.finite
    if solution.series is not None:
        Budget(limits).check_degree(solution.series.degree, "a rational solution")
    atoms = Atoms(sympy.Symbol(solution.variable))
    rational: tuple[Expr, ...] = ()
    family = polynomial = None
    if solution.case == 1:
        gauge, factor = map(atoms.ratio, (linear.gauge, R))
        if all_algebraic:  # w for u = y1 + C1 y2
            y1, y2 = solution.solutions
            u = y1 + free_constants(1, y1, y2, factor)[0] * y2
            family = cancel(powsimp(expand(-u.diff(atoms.x) / (factor * u))))
        if group is None or group.order not in (1, 2):  # else infinitely many are rational
            rational = tuple(cancel(-(omega + gauge) / factor) for omega in _rational_omegas(solution, atoms))
    elif solution.case is not None:
        polynomial = _polynomial_in_w(solution, linear.gauge, R, atoms)
    return RiccatiSolutions(rational, family, polynomial, all_algebraic, solution)


def _read_coefficients(p: Any, q: Any, r: Any, var: str | None, limits: Limits) -> Equation:
    """r, q and p as the coefficients a, b and c of an equation; `p` alone may be Riccati's equation."""
    if q is None and r is None:
        equation = read_first_order(p, None, var, limits)
        if equation.r == 0 or equation.power != 2:
            raise InputError(f"{p} isn't a Riccati equation", hint="write w' = p + q*w + r*w^2, or give p, q and r")
        p, q, r, _ = equation.entries
        var = equation.x.name
    elif q is None or r is None:
        raise InputError("one of p, q, r is missing", hint="give all three, or an equation")
    if plain_text(r).strip() in ("0", "0.0"):
        raise InputError("r is zero: the equation is linear of first order")
    given = read_coefficients(r, q, p, 0, var=var, limits=limits).equation
    assert given is not None
    return given


def _polynomial_in_w(solution: Solution, gauge: RatFunc, factor: RatFunc, atoms: Atoms) -> Any:
    """The polynomial of omega = -r w - gauge in w, without a common factor; None if that in omega isn't known."""
    if solution.riccati is None:
        return None
    field = solution.riccati.coefficients[0].field
    slope, rest = (RatFunc(-part.num.over(field), part.den.over(field), reduced=True) for part in (factor, gauge))
    by_powers: list[RatFunc] = []
    for c in reversed(solution.riccati.coefficients):  # Horner: q(w) (slope w + rest) + c
        check_time()
        shifted = [c, *(a * slope for a in by_powers)]
        low = [*(a * rest for a in by_powers), rest * 0]
        by_powers = [a + b for a, b in zip(shifted, low, strict=True)]
    numerators = over_one_denominator(by_powers)
    common = reduce(Poly.gcd, numerators)
    w = sympy.Symbol("w")
    found = Add(*(atoms.poly(a // common) * w**k for k, a in enumerate(numerators)))
    return sympy.Poly(found, w, atoms.x).primitive()[1].eject(atoms.x).as_expr() if field == QQ else found


def _rational_omegas(solution: Solution, atoms: Any) -> list[Any]:
    """One omega, or both where the group is diagonal: their sum is F'/F for the invariant F = y1 y2."""
    assert solution.omega is not None
    first = atoms.ratio(solution.omega)
    invariant = solution.decision.invariant
    if invariant is None or solution.group is None or solution.group.kind.value not in ("cyclic", "multiplicative"):
        return [first]
    return [first, atoms.ratio(invariant.logarithmic_derivative) - first]
