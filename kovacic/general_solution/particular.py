"""A particular solution of an inhomogeneous equation, by the cheapest method that applies.

Step functions and impulses: with W = y1 y2' - y1' y2 and the kernel K(x, a) = (y1(a) y2(x) - y2(a) y1(x))/W(a), the solution of
y'' + b y' + c y = 0 with K = 0 and K' = 1 at x = a, a solution for

    g(x) delta(x - a)  is  H(x - a) g(a) K(x, a),                                                                    (1)
    g(x) H(x - a)      is  H(x - a) (p(x) - p(a) K1(x) - p'(a) K(x, a)),                                             (2)

where p is any solution for g, and K1 that of the homogeneous equation with K1 = 1, K1' = 0 at x = a.  For impulses of higher
order y = H u + sum of d_j delta^(j), with all of these at a, and

    y'' + b y' + c y = u(a) delta' + (u'(a) + b(a) u(a)) delta + sum of d_j (delta^(j+2) + b delta^(j+1) + c delta^(j)),     (3)

where b delta^(n) is the sum of (-1)^k C(n, k) b^(k)(a) delta^(n-k).

Variation of parameters: y = -y1 int y2 f/(a W) dx + y2 int y1 f/(a W) dx.  Integrals that aren't known stay as they are:
SymPy's rules know hardly any others, and take seconds to find that out.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from math import comb
from operator import mul
from typing import Any

import sympy
from flint import arb
from sympy import Add, DiracDelta, Heaviside, Symbol, cos, cosh, exp, expand, log, powsimp, sin, sinh, sympify
from sympy.core.function import AppliedUndef

from kovacic.algebra.factors import combination
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_digits
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, is_seen_negative
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.cuts import all_turned, cuts_of
from kovacic.closed_form.form import one_exponential
from kovacic.closed_form.jets import jet
from kovacic.closed_form.steps import JUMPING, in_parts
from kovacic.closed_form.way_back import in_x
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.behaviour import have_values, value_or_limit, values_at
from kovacic.general_solution.check import is_finite, jumps
from kovacic.general_solution.constants import tidy
from kovacic.general_solution.integrands import MOST_COMPLEX, NUMBERS, ChangeOfIntegrand, prepared_integrand, ratfunc
from kovacic.general_solution.substitution import by_functions, size
from kovacic.general_solution.textbook import is_constant
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.waves import fractions_of_waves, in_waves
from kovacic.general_solution.zero import quadrant_points, residual_at
from kovacic.reading.change_of_variable import slope_squared
from kovacic.writing.formula import free_name

Expr = Any  # SymPy publishes no types
#: Functions that integrals have with complex arguments.
_OF_COMPLEX_ARGUMENTS = (sympy.Ei, sympy.expint, sympy.erf, sympy.erfi, sympy.uppergamma, sympy.lowergamma)


def particular_solution(basis: Basis, start: Expr | None) -> Expr:
    """A solution, with integrals from `start` on.  Raises `NotImplementedError` for an impulse at a singular point."""
    right = right_hand_side(basis.equation)
    if right == 0:
        return sympy.Integer(0)
    apart = in_parts(right, basis.x)
    total = [_step_response(g, basis, a) for a, g in apart.steps.items()]
    total += [_impulse_response(strengths, basis, a) for a, strengths in apart.impulses.items()]
    if apart.plain != 0:
        total.append(_plain_response(basis, apart.plain, start))
    return Add(*total)


def right_hand_side(equation: Equation) -> Expr:
    """F of y'' + B y' + C y = F, in the user's variable."""
    t = Symbol(equation.variable)
    a = Atoms(t).ratio(equation.a).xreplace(NUMBERS)
    f = Atoms(t).sum(equation.f).xreplace(NUMBERS)
    h = sympy.sympify(equation.h or 0).xreplace(NUMBERS)
    if equation.change is None:
        return (f + h) / a
    if f == 0:  # and the slope needn't be a function of t: x^(5/2)
        return h
    return in_x(equation, sympy.factor(f / a * slope_squared(equation))) + h


def _plain_response(basis: Basis, right: Expr, start: Expr | None) -> Expr:
    """A solution for a right-hand side without jumps; integrals that stay begin at `start`."""
    found = None
    with suppress(LimitExceeded):
        found = _without_integrals(basis, right)
    if found is None:
        found = with_integrals(basis, right, start)
    is_open = found.has(sympy.Integral) and basis.equation.change is None
    terms = Add.make_args(prepared_integrand(right)) if is_open else ()
    # not exp(x)/x and 1/x apart, which aren't defined at 0, where the difference may be
    if len(terms) < 2 or not (start is None or have_values(terms, basis.x, start)):
        return found
    parts = {_plain_response(basis, term, start): term for term in terms}
    left, known = sympy.sift(parts, lambda part: part.has(sympy.Integral), binary=True)
    if left and known:
        known.append(with_integrals(basis, Add(*map(parts.get, left)), start))
    return Add(*known) if known else found


def _without_integrals(basis: Basis, right: Expr) -> Expr | None:
    """A polynomial in the equation's variable, or by undetermined coefficients (also Euler's equations); else None."""
    x = basis.x
    equation = basis.equation
    in_t = None if equation.h else equation.f / equation.a
    polynomial = _polynomial_solution(equation, ratfunc(right, x) if equation.change is None else in_t)
    if polynomial is not None:
        t = Atoms(Symbol(equation.variable))
        found = in_x(equation, t.poly(polynomial).xreplace(NUMBERS))
        return _without_homogeneous(basis, expand(in_waves(found))) if found.has(sympy.I) else found
    if equation.change is not None:
        return None
    b, c = map(sympy.factor, basis.rates)
    if not (b.has(x) or c.has(x)):
        return undetermined(b, c, right, x)
    return _of_euler(basis, b, c, right)


def _of_euler(basis: Basis, b: Expr, c: Expr, right: Expr) -> Expr | None:
    """For u = m x + p, b = m beta/u, c = m^2 gamma/u^2: u = e^t gives y_tt + (beta - 1) y_t + gamma y = e^(2t) right/m^2."""
    x = basis.x
    double = sympy.Poly(sympy.denom(b) ** 2 if c == 0 else sympy.denom(c), x)
    root = -double.coeff_monomial(x) / (2 * double.LC())
    u = sympy.numer(sympy.together(x - root))
    m = u.diff(x)
    beta, gamma = sympy.cancel(b * u / m), sympy.cancel(c * u**2 / m**2)
    if beta.has(x) or gamma.has(x):
        return None
    cuts = cuts_of(sympy.Tuple(right, basis.y1, basis.y2), x)
    if any(is_seen_negative(cut.subs(x, root + 1)) for cut in cuts):  # real on the left of the root
        u, m = -u, -m
    t = sympy.Dummy(real=True)
    inner = right.subs(x, (exp(t) - u) / m + x).replace(lambda e: e.is_Add, expand)
    found = undetermined(beta - 1, gamma, exp(2 * t) * inner / m**2, t)
    return None if found is None else ChangeOfIntegrand(inner, t, log(u)).back(found)


def _polynomial_solution(equation: Equation, right: RatFunc | None) -> Poly | None:
    """A polynomial y with a y'' + b y' + c y = a right, or None if there is none of the expected degree."""
    field = equation.a.field
    if right is None or not (right.field == field or field.extends(right.field)):
        return None
    whole = RatFunc(right.num.over(field), right.den.over(field), reduced=True) * equation.a
    denominators = equation.a.den * equation.b.den * equation.c.den * whole.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, whole))
    x = field.x
    highest = max(f.degree - min(p.degree for p in (a, b, c) if p), 0) + 2
    powers: list[Any] = [x**k for k in range(highest + 1)]
    found = combination(f, [a * p.derivative().derivative() + b * p.derivative() + c * p for p in powers])
    return None if found is None else sum(map(mul, powers, found), f * 0)


def _step_response(g: Expr, basis: Basis, a: Expr) -> Expr:
    """By (2), or H(x - a) p for any solution p if the equation is singular at the step, as it is a solution on each side."""
    x = basis.x
    if not have_values(basis.rates, x, a):
        return Heaviside(x - a) * _plain_response(basis, g, None)
    p = _plain_response(basis, g, a)
    return Heaviside(x - a) * _from_rest(p, basis, *values_at(p, x, a), a)


def _from_rest(p: Expr, basis: Basis, value: Expr, rate: Expr, a: Expr) -> Expr:
    """p - u for the solution u of the homogeneous equation with u(a) = value, u'(a) = rate."""
    x = basis.x
    wronskian = tidy(value_or_limit(basis.wronskian, x, a))  # a limit where t(x) alone is singular
    if wronskian == 0 or not is_finite(wronskian):
        raise NotImplementedError(f"the functions of the closed form are singular at {a}, where the solutions aren't")
    (u, du), (v, dv) = (values_at(y, x, a) for y in (basis.y1, basis.y2))
    first = (value * dv - rate * v) / wronskian
    second = (rate * u - value * du) / wronskian
    return powsimp(p - tidy(first) * basis.y1 - tidy(second) * basis.y2)


def _impulse_response(strengths: Mapping[int, Expr], basis: Basis, a: Expr) -> Expr:
    """H(x - a) u + sum of d_j delta^(j)(x - a), a solution for the sum of r_n delta^(n)(x - a), by (3) from the highest n."""
    x = basis.x
    if not have_values(basis.rates, x, a) or not all(map(is_finite, strengths.values())):
        said = f"undecided: an impulse at {x} = {a}, a singular point of the equation"
        raise NotImplementedError(f"{said}: solutions and their slopes have no values there that could jump")
    B, C = basis.rates
    rest = defaultdict(lambda: sympy.Integer(0), strengths)
    singular = sympy.Integer(0)
    for order in range(max(rest), 1, -1):
        d = rest[order]
        singular += d * DiracDelta(x - a, order - 2)
        for rate, n in ((B, order - 1), (C, order - 2)):
            for k in range(n + 1):
                rest[n - k] -= d * (-1) ** k * comb(n, k) * value_or_limit(rate.diff(x, k), x, a)
    value = rest[1]
    slope = rest[0] - value_or_limit(B, x, a) * value
    return Heaviside(x - a) * _from_rest(sympy.Integer(0), basis, -tidy(value), -tidy(slope), a) + singular


# -------------------------------------------------------------------------------------------- variation of parameters


class DefiniteIntegral(sympy.Integral):  # type: ignore[misc]
    """An integral between numbers that doesn't call itself a number.

    SymPy orders the terms of a sum by the values of the numbers among their factors, so that printing, comparing or asking for
    a sign would integrate numerically, for minutes [`Expr.as_terms`].  `evalf` still does.
    """

    is_number = False

    def _eval_evalf(self, prec: int) -> Expr:
        return sympy.Integral(*self.args)._evalf(prec)


def with_integrals(basis: Basis, right: Expr, start: Expr | None) -> Expr:
    """A solution by variation of parameters; integrals that aren't found stay, and begin at `start` unless it is None."""
    x = basis.x
    integrands = [powsimp(y * right / basis.wronskian) for y in (basis.y2, basis.y1)]
    known = _known_integrals(basis, integrands, start)
    if None not in known:
        whole = _shortest_solution(basis, known, right)
        if whole is not None:
            return starting_at(whole, x, start)
    for integrals in (known, [None, None]):
        pairs = zip(integrals, integrands, strict=True)
        opened = [_open(integrand, x, start) if found is None else found for found, integrand in pairs]
        solution = starting_at(basis.y2 * opened[1] - basis.y1 * opened[0], x, start)
        if _is_right(basis, solution, right):
            break
    return solution


def _known_integrals(basis: Basis, integrands: Sequence[Expr], start: Expr | None) -> list[Any]:
    """The integrals, each None if it isn't found within the limits; both None if they have too many complex arguments."""
    known: list[Any] = [None, None]
    poles = [basis.own(rate) for rate in basis.rates]

    def is_crossing(f: Expr) -> bool:
        """True for Ei(u) where u crosses the negative axis, the cut of that and of E1(-u), at an ordinary point."""
        is_complex = isinstance(f, sympy.Ei) and f.has(sympy.I)
        return is_complex and jumps(basis.own(f), basis.x, [*poles, basis.own(1 / f.args[0])])

    with suppress(LimitExceeded):
        known = [antiderivative(integrand, basis.x, start) for integrand in integrands]
        # the two differ by pi i on either side of the axis [DLMF 6.2.3], and -u crosses only the positive one
        known = [e and e.replace(is_crossing, lambda f: -sympy.expint(1, -f.args[0])) for e in known]
    functions = set().union(*(integral.atoms(*_OF_COMPLEX_ARGUMENTS) for integral in known if integral is not None))
    return known if sum(bool(f.has(sympy.I)) for f in functions) <= MOST_COMPLEX else [None, None]


def _shortest_solution(basis: Basis, parts: Sequence[Any], right: Expr) -> Expr | None:
    """y2 times the second integral minus y1 times the first in its shortest form; None if that isn't a solution."""
    whole = expand(basis.y2 * parts[1] - basis.y1 * parts[0])
    if any(power.exp.free_symbols - {basis.x} for power in whole.atoms(sympy.Pow)):  # x x^a
        whole = powsimp(whole)
    others = map(expand, (in_waves(whole), whole.rewrite((sinh, cosh), exp)))  # beside integrals, in exponentials
    in_fractions = fractions_of_waves(whole, basis.x) if whole.has(sin, cos) else []
    forms = dict.fromkeys([whole, *others, *in_fractions])
    candidates = [_without_homogeneous(basis, part) for form in forms for part in (form, _gathered(form, basis.x))]
    found = one_exponential(min(candidates, key=size))
    return found if _is_right(basis, found, right) else None


def _is_right(basis: Basis, y: Expr, right: Expr) -> bool:
    """True for a solution without jumps at ordinary points."""
    if basis.equation.change is None and not is_solution(y, basis.rates, right, basis.x):
        return False
    parts = [basis.own(e) for e in (y, *basis.rates, right)]
    if any(member.has(log(basis.x)) for member in (basis.y1, basis.y2)):  # which are meant for x > 0
        parts = [part.subs(basis.x, exp(basis.x)) for part in parts]
    return not jumps(parts[0], basis.x, parts[1:])


def _without_homogeneous(basis: Basis, total: Expr) -> Expr:
    """A sum without the terms that are multiples of y1 or y2."""
    members = (basis.y1, basis.y2)
    terms = Add.make_args(total)
    own = (term for term in terms if not any(is_constant(term / y, basis.x) for y in members))
    return sympy.factor_terms(Add(*own))


def _gathered(form: Expr, x: Expr) -> Expr:
    """The sum, with one fraction for the rational functions before each function."""

    def shortened(fraction: Expr) -> Expr:
        is_whole = fraction.is_polynomial(x) and (fraction.has(x) or not fraction.free_symbols)
        return fraction if is_whole else sympy.factor(fraction)

    groups = by_functions(form, lambda factor: factor.is_rational_function(x))
    return Add(*(rest * shortened(fraction) for rest, fraction in groups.items()))


def starting_at(y: Expr, x: Expr, start: Expr | None) -> Expr:
    """With integrals from `start` on for antiderivatives, unless it is None."""
    return y.replace(
        lambda e: isinstance(e, sympy.Integral) and e.limits == (sympy.Tuple(x),), lambda e: _open(e.function, x, start)
    )


def _open(integrand: Expr, x: Expr, start: Expr | None) -> Expr:
    """The unevaluated integral, from `start` on unless that is None."""
    if start is None:
        return sympy.Integral(integrand, x)
    s = _letter(integrand, start)
    return DefiniteIntegral(integrand.subs(x, s), (s, start, x))


def _letter(*parts: Expr) -> Expr:
    """A variable of integration that doesn't occur in the parts."""
    return Symbol(free_name(sympy.Tuple(*parts).atoms(Symbol), "s", "t"))


def with_letters_of_integration(y: Expr) -> Expr:
    """With variables of integration whose names no parameter has: s exp(x) + Integral(.., (s, 0, x)) has one s too many."""
    parameters = {symbol.name for symbol in y.free_symbols}

    def renamed(integral: Expr) -> Expr:
        s, *ends = integral.limits[0]
        other = _letter(y)
        return integral.func(integral.function.xreplace({s: other}), (other, *ends))

    def is_confused(e: Expr) -> bool:
        return isinstance(e, sympy.Integral) and len(e.limits[0]) > 1 and e.limits[0][0].name in parameters

    return y.replace(is_confused, renamed)


def turned_at(
    place: Expr | None,
    y: Expr,
    coefficients: tuple[Expr, ...],
    right: Expr,
    x: Expr,
    own: Callable[[Expr], Expr] = sympify,
) -> Expr:
    """The solution with log(-u), (-u)^e for arguments u < 0 at the place, if that is one; else the given one."""
    turned = y if place is None else all_turned(y, x, place, own)
    return turned if turned != y and is_solution(turned, coefficients, right, x) else y


def is_solution(y: Expr, coefficients: tuple[Expr, ...], right: Expr, x: Expr) -> bool:
    """True if y'' + b y' + c y = right, or y' + c y = right for one coefficient, at points in each quadrant, to 50 digits.

    Real ones on a cut of the right-hand side, where it isn't real, say nothing of its branch beside them.
    """
    given = y.atoms(AppliedUndef, *JUMPING) | right.atoms(AppliedUndef, *JUMPING)
    # An exponential for each function that is given by its name, or jumps: the formula holds for any function.
    functions = enumerate(sorted(given, key=str))
    sample = {f: exp(sympy.Rational(k + 1, 3) * x) for k, f in functions if f.has(x)}
    y, right = y.xreplace(sample), right.xreplace(sample)
    a, b, c = (sympy.S.Zero,) * (2 - len(coefficients)) + (sympy.S.One, *coefficients)
    with working_digits(DIGITS + 15), suppress(NotImplementedError):
        cuts = cuts_of(right, x)
        points = (p for p in quadrant_points() if p.imag != 0 or not any(jet(u, x, p)[0].real < 0 for u in cuts))
        found = (residual_at(point, x, y, (a, b, c, right)) for point in points)
        return all(bool(miss < arb(10) ** -DIGITS * (1 + scale)) for miss, scale in found)
    return False
