"""Textbook forms of an answer: the shortest of equal ones, in the order that `special.choice` documents.

Each rule is an identity that holds on the whole plane, or on the real line where steps occur, and so for every value of the
parameters; its result is taken if it is shorter.

    c e^p + d e^q = e^m ((c + d) cosh h + (c - d) sinh h),   m = (p + q)/2,  h = (p - q)/2,                             (1)

in numerators and denominators whose exponents lie symmetrically about one m, the same up to constants, as in
sinh(k x)/sinh(k a);

    f + g H(x - a) = F(a + |x - a|),   F = f + g,   if f is F reflected in a;                                          (2)

sin u cos v as a sum of waves, which is sin(x - a) beside a step at a; tan u for sin u/cos u.
A pair of solutions is changed before its constants have values:

    e^(P + Q sqrt(u)), e^(P - Q sqrt(u))  span  e^P cos(Q sqrt(-u)), e^P sin(Q sqrt(-u));                               (3)
    (f + sqrt(f^2 - c^2))^(+-n)           span  cos(n acos(f/c)), sin(n acos(f/c)).                                          (4)
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import combinations, product
from math import lcm
from operator import mul
from typing import Any

import sympy
from sympy import Abs, Add, Dummy, Heaviside, Mul, Pow, S, cancel, cos, cosh, exp, expand, log, powsimp, sin, sinh, sqrt
from sympy.simplify.fu import TR2, TR5, TR6, TR2i, TR10i, hyper_as_trig

from kovacic.closed_form.jets import jet
from kovacic.general_solution.integrands import radicands
from kovacic.general_solution.substitution import by_functions, changed_beside, expanded_size, in_single_waves
from kovacic.general_solution.zero import is_positive_polynomial, is_zero, quadrant_points
from kovacic.limits import MOST_SUBEXPRESSIONS
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types


def in_book_form(value: Expr, x: Expr, free: Sequence[Expr] = ()) -> Expr:
    """The shortest form of an answer; beside the constants `free` of a general solution its functions stay."""
    if value.free_symbols != {x}:
        value = shortest([value, _with_short_coefficients(value, x)])
    for rule in (_tangents,) if free else _SHAPE_RULES:
        if _is_small(value):
            value = shortest([value, *rule(value, x)])
    value = _with_equal_roots(_without_roots_of_squares(value, x, free))
    # |x| for 2 x H(x) - x in functions and powers, as in log|x|, also of a letter of integration
    inside = {e.args[0] for e in value.atoms(Pow, sympy.Function) if e.args[0].is_Add}
    return value.xreplace({u: modulus for u in inside for t in u.free_symbols for modulus in _in_absolute_values(u, t)})


def _without_roots_of_squares(value: Expr, x: Expr, free: Sequence[Expr]) -> Expr:
    """The value with u for sqrt(u^2) if -u gives the same, or the same solutions by the signs of the free constants."""
    for base in {base for base in radicands(value) if base.free_symbols and not base.has(x)}:
        u = sympy.powdenest(sqrt(base), force=True)
        s = Dummy()
        in_s = in_root(value, base, s)
        signs = product((1, -1), repeat=len(free))
        others = (in_s.xreplace(dict(zip(free, map(mul, row, free), strict=True))) for row in signs)
        if u.is_rational_function() and in_s.xreplace({s: -s}) in others:
            value = in_s.xreplace({s: u})
    return value


def in_root(value: Expr, radicand: Expr, s: Expr) -> Expr:
    """The value with s for sqrt(radicand), in every power of the radicand."""
    return value.replace(lambda e: e.is_Pow and e.base == radicand, lambda e: s ** (2 * e.exp))


def _with_equal_roots(value: Expr) -> Expr:
    """The value with equal radicands in the shortest of their forms: sqrt(c*(4*l - c*r^2)) for sqrt(-c*(c*r^2 - 4*l))."""
    forms: dict[Expr, list[Expr]] = defaultdict(list)
    for base in sorted(radicands(value), key=str):
        if not base.is_Symbol and expanded_size(base) <= MOST_SUBEXPRESSIONS:
            forms[expand(base)].append(base)
    short = {b: min(equal, key=lambda e: (sympy.count_ops(e), len(str(e)))) for equal in forms.values() for b in equal}
    return value.replace(lambda e: e.is_Pow and short.get(e.base, e.base) != e.base, lambda e: short[e.base] ** e.exp)


def in_hyperbolic_functions(value: Expr) -> Expr:
    """A multiple of the value by an exponential, in the form (1); the value itself if it has none, or is long."""
    return next(_hyperbolic(value.rewrite((sinh, cosh), exp), Dummy()), value) if _is_small(value) else value


def _is_small(value: Expr) -> bool:
    return expanded_size(value) <= MOST_SUBEXPRESSIONS and not value.has(sympy.Integral, sympy.RootSum)


def with_waves(y1: Expr, y2: Expr) -> tuple[Expr, Expr]:
    """The pair (3) for c e^(P + Q) and c e^(P - Q) if u may be negative, as for a damping below 1; else the pair itself."""
    first, second = (y.as_powers_dict() for y in (y1, y2))
    A1, A2 = (powers.pop(sympy.E, S.Zero) for powers in (first, second))
    c, other = (Mul(*map(Pow, powers.keys(), powers.values())) for powers in (first, second))
    P, Q = expand((A1 + A2) / 2), expand((A1 - A2) / 2)
    roots = [power for power in Q.atoms(Pow) if power.exp == S.Half and power.free_symbols]
    if c != other or P == 0 or len(roots) != 1 or not roots[0].base.is_Add:
        return y1, y2
    (root,) = roots
    q = cancel(Q / root)
    is_real = root.base.is_polynomial() and is_positive_polynomial(expand(root.base), or_zero=True)
    if is_real or q.has(root):
        return y1, y2
    angle = q * sqrt(expand(-root.base))
    return c * exp(P) * cos(angle), c * exp(P) * sin(angle)


def of_chebyshev(y1: Expr, y2: Expr, x: Expr) -> tuple[Expr, Expr, Expr | None]:
    """The pair (4) for g (f + sqrt(f^2 - c^2))^n and its inverse, c a number or a letter; else the pair itself.

    The third part is a point at which |f| < |c|, if c is a number.
    """
    powers, others = sympy.sift(
        Mul.make_args(y1), lambda part: part.is_Pow and part.base.is_Add and not part.exp.is_Rational, binary=True
    )
    g = Mul(*others)
    if len(powers) != 1 or powsimp(powers[0] * y2 / g) != 1:
        return y1, y2, None
    (power,) = powers
    for f, rest in (power.base.as_two_terms(), power.base.as_two_terms()[::-1]):
        square = expand(f**2 - rest**2)
        c = sympy.powdenest(sqrt(square), force=True)
        # sqrt(x^2 + 1) + x is one for f = x i alone
        is_real = square.is_positive or (not radicands(c) and not c.has(sympy.I))
        line, middle = (f**2, square / 4) if any(base.has(x) for base in radicands(f)) else (f, c / 2)
        if not line.diff(x).has(x) and is_real and not square.has(x):
            place = (middle - line.subs(x, 0)) / line.diff(x) if c.is_number and line.diff(x).is_number else None
            turned = {p: (-p.base) ** p.exp for p in g.atoms(Pow) if sympy.rem(p.base, rest**2, x) == 0}
            g = g.xreplace(turned)  # a constant multiple, real where |f| < |c|
            angle = power.exp * sympy.acos(f / c)
            return g * cos(angle), g * sin(angle), place
    return y1, y2, None


def without_homogeneous(particular: Expr, y1: Expr, y2: Expr, x: Expr) -> Expr:
    """The shortest of the particular solutions that differ from this one by a multiple of a term of its own."""
    if not particular.has(Add, sin, cos) or not _is_small(particular):
        return particular
    forms = [particular, *_single_waves(particular, x), *_factored_forms(particular, x), *_in_one_wave(particular)]
    for _, before, after in _before_and_after(particular, x):
        terms = Add.make_args(expand(after - before))
        own = [-term for term in terms if any(is_constant(term / y, x) for y in (y1, y2))]
        for h in (0, *own, Add(*own) / 2):
            forms += _in_absolute_values(particular + h, x)
    return shortest(sorted(forms, key=lambda form: form.could_extract_minus_sign()))


def is_constant(quotient: Expr, x: Expr) -> bool:
    """True if the expression is seen to be constant; a slope other than zero at one point refutes it first."""
    with suppress(NotImplementedError):
        if quotient.has(x) and not jet(quotient, x, next(quadrant_points()))[1].contains(0):
            return False
    return not powsimp(expand(quotient)).has(x)


# ------------------------------------------------------------------------------------------------------------- rules


def _before_and_after(value: Expr, x: Expr) -> Iterator[tuple[Expr, Expr, Expr]]:
    """a, f and f + g for f + g H(x - a); nothing for other or several steps."""
    steps = [step for step in value.atoms(Heaviside) if step.has(x)]
    if len(steps) == 1 and steps[0].args[0].diff(x) == 1 and not value.has(sympy.DiracDelta):
        before, after = (expand(value.xreplace({steps[0]: sympy.Integer(k)})) for k in (0, 1))
        yield expand(x - steps[0].args[0]), before, after


def _in_absolute_values(value: Expr, x: Expr) -> Iterator[Expr]:
    """(2), for steps at one point."""
    u = Dummy()
    for a, *parts in _before_and_after(value, x):
        places = (a - u, a + u)
        before, after = (powsimp(expand(part.subs(x, at))) for part, at in zip(parts, places, strict=True))
        if before != 0 and is_zero(before - after):
            yield sympy.factor_terms(after).subs(u, Abs(x - a))


def _hyperbolic(value: Expr, x: Expr) -> Iterator[Expr]:
    """(1) in the numerator and in the denominator, which are polynomials in letters for the e^rate that occur."""
    if value.has(sinh, cosh):  # t sinh(t) + t cosh(t)
        yield expand(value.rewrite((sinh, cosh), exp))
    is_in_sum = any(part.has(exp) for part in value.atoms(Add))
    if not is_in_sum and all(e.has(x) for e in value.atoms(exp)):  # a product has one exponential, and keeps it
        return
    exponents = {
        e: by_functions(expand(e.as_base_exp()[1]), lambda part: part.is_Rational)
        for e in value.atoms(exp, type(sympy.E))
    }
    unit: dict[Expr, int] = defaultdict(lambda: 1)
    for rate, n in sorted((item for rates in exponents.values() for item in rates.items()), key=str):
        unit[rate] = lcm(unit[rate], int(n.q))
    letters = {rate: Dummy(positive=True) for rate in unit}  # e^(rate/unit)
    plain = {e: Mul(*(letters[r] ** (n * unit[r]) for r, n in rates.items())) for e, rates in exponents.items()}
    rate_of = {letter: rate / unit[rate] for rate, letter in letters.items()}
    fraction = sympy.fraction(cancel(sympy.together(value.xreplace(plain))))
    with suppress(_NotSymmetric):
        (m, top), (n, bottom) = (_symmetric_product(part, rate_of) for part in fraction)
        if (m - n).has(x):  # decaying exponentials stay apart
            return
        scale = exp(expand(m - n)) / bottom
        yield scale * top
        yield Add(*(scale * term for term in Add.make_args(expand(top))))


class _NotSymmetric(Exception):
    """A sum doesn't have the form (1)."""


def _symmetric_product(polynomial: Expr, rate_of: Mapping[Expr, Expr]) -> tuple[Expr, Expr]:
    """m, and the rest without e^m, by factors without common letters: X^2 - 1, which is sinh, stays whole."""
    constant, polynomial = polynomial.as_independent(*rate_of, as_Add=False)
    # SymPy can't sort factors with a^n, a^i; J(exp(x)) is no polynomial
    is_sorted = all(power.exp.is_Rational for power in polynomial.atoms(Pow))
    if not (is_sorted and polynomial.is_polynomial(*rate_of)):
        raise _NotSymmetric
    number, factors = sympy.factor_list(polynomial, *rate_of)
    groups: list[Expr] = []
    for base, k in factors:
        letters = base.free_symbols & {*rate_of}
        common, groups = sympy.sift(groups, lambda group: group.has(*letters), binary=True)  # noqa: B023
        groups.append(Mul(base**k, *common))
    m, total = S.Zero, constant * number
    for group in groups:
        middle, rest = _symmetric(group, rate_of)
        m, total = m + middle, total * rest
    return m, total


def _symmetric(part: Expr, rate_of: Mapping[Expr, Expr]) -> tuple[Expr, Expr]:
    """m, and the sum (1) without e^m, for a polynomial in the letters for e^rate."""
    terms = sympy.Poly(part, *rate_of).terms()
    by_exponent = {expand(Add(*map(mul, degrees, rate_of.values()))): c for degrees, c in terms}
    m = expand(Add(*by_exponent) / len(terms))
    total = S.Zero
    for exponent, c in by_exponent.items():
        d = by_exponent.get(expand(2 * m - exponent))
        if d is None or (0 not in (c + d, c - d) and c.is_number and d.is_number):
            raise _NotSymmetric
        h = expand(exponent - m)
        if not h.could_extract_minus_sign():  # each pair once; in the middle c is d
            h = sympy.factor_terms(h)
            total += c if h == 0 else (c + d) * cosh(h) + (c - d) * sinh(h)
    return m, sympy.factor_terms(total)


def _exchanged(value: Expr, x: Expr) -> Iterator[Expr]:
    """F(min(x, a), max(x, a)) for a step at a letter a, after which F(x, a) is F(a, x): Green's function."""
    for a, before, after in _before_and_after(value, x):
        if a.is_Symbol and before != 0 and is_zero(after - before.xreplace({x: a, a: x})):
            forms = (*_hyperbolic(before, x), TR10i(sympy.factor(sympy.together(sympy.expand_trig(before)))))
            yield from sympy.Tuple(*forms).xreplace({x: sympy.Min(x, a), a: sympy.Max(x, a)})


def _single_waves(value: Expr, x: Expr) -> Iterator[Expr]:
    """Products of waves as sums, if a term has two, or the power of one."""
    expanded = expand(value) if value.has(sin, cos) else value
    terms = ([part.as_base_exp() for part in Mul.make_args(term)] for term in Add.make_args(expanded))
    if any(sum(int(n) for u, n in term if isinstance(u, sin | cos) and n.is_Integer and n > 0) > 1 for term in terms):
        found = powsimp(in_single_waves(value))
        steps = sorted(value.atoms(Heaviside), key=str)
        yield found
        yield sympy.collect(found, steps, _with_common_factors)
        yield sympy.collect(expanded, steps, _as_one_wave)


def _in_one_wave(value: Expr) -> Iterator[Expr]:
    """Powers of sines, or of cosines, for sin(3 x) beside logarithms of these."""
    if value.has(log) and value.has(sin, cos):
        value = value.replace(log, lambda u: log(sympy.factor(u)))
        for form in (TR5, TR6):
            yield changed_beside(
                value.atoms(log),
                value,
                lambda e: expand(form(expand(sympy.expand_trig(e)))),  # noqa: B023
            )


def _as_one_wave(total: Expr) -> Expr:
    """sin(x - a) for sin(x) cos(a) - cos(x) sin(a), but no sqrt(2) sin(x + pi/4) for sin(x) + cos(x)."""
    found = TR10i(total)
    return _with_common_factors(total if found.has(sympy.pi) else found)


def _with_short_coefficients(e: Expr, x: Expr) -> Expr:
    """Write quotients of letters in factors, and complete squares, as in (k - m w^2)^2 + c^2 w^2."""
    if x not in e.free_symbols:  # which a `CRootOf` may have in its polynomial
        return shortest([e, *_quotients_in_factors(e)])
    if e.is_Add:
        parts = [_with_short_coefficients(part, x).as_independent(x, as_Add=False) for part in e.args]
        functions = {Dummy(): function for _, function in parts}  # what contains x stays apart
        total = Add(*(c * name for (c, _), name in zip(parts, functions, strict=True)))
        return shortest([form.xreplace(functions) for form in (total, _with_common_factors(total))])
    if not (e.is_Mul or e.is_Pow or (e.is_Function and len(e.args) == 1)):
        return e
    number, rest = e.as_independent(x, as_Add=False)
    inner = (number, *Mul.make_args(rest)) if e.is_Mul else e.args
    return e.func(*(_with_short_coefficients(part, x) for part in inner))


def _quotients_in_factors(e: Expr) -> Iterator[Expr]:
    """A quotient of polynomials, or a multiple of one square root sqrt(u) = u/sqrt(u), in factors."""
    if not e.has(Add) or not e.free_symbols or e.has(sympy.Function):
        return
    bases = {power.base for power in e.atoms(Pow) if not power.exp.is_Integer} or {S.One}
    u = bases.pop()
    root = sqrt(u)
    rational = cancel(e / root)
    if not bases and rational.is_rational_function():
        for quotient, scale in ((rational, root), (cancel(rational * u), 1 / root)):
            yield sympy.factor(quotient).replace(lambda part: part.is_Add, _with_square) * scale


def _with_square(total: Expr) -> Expr:
    """(a + b)^2 + rest for a^2 + 2 a b + b^2 + rest, with products a and b; else the sum itself."""
    roots = [sympy.powdenest(sqrt(term), force=True) for term in total.args]
    pairs = combinations([root for root in roots if root.is_polynomial()], 2)
    for (a, b), sign in product(pairs, (1, -1)):
        if 2 * sign * a * b in total.args:
            return (a + sign * b) ** 2 + (total - expand((a + sign * b) ** 2))
    return total


def _tangents(value: Expr, x: Expr) -> Iterator[Expr]:
    """tan u for sin u/cos u, tanh u for sinh u/cosh u."""
    if {cos, cosh} & {power.base.func for power in value.atoms(Pow)}:
        yield _also_hyperbolic(TR2i, value)


def _also_hyperbolic(change: Callable[[Expr], Expr], value: Expr) -> Expr:
    """The value changed by an identity of circular functions, and by that of the hyperbolic ones."""
    waves, back = hyper_as_trig(change(value))
    return back(change(waves))


def sums(value: Expr, x: Expr) -> Iterator[Expr]:
    """The value with powers joined, multiplied out, with a rational coefficient in lowest terms for each function of x."""
    if value.has(sympy.tan, sympy.cot, sympy.tanh, sympy.coth):  # sin(x) for cos(x) tan(x)
        yield from sums(_also_hyperbolic(TR2, value), x)
    value = powsimp(value)
    expanded = powsimp(expand(value))
    totals = by_functions(expanded, lambda part: not part.has(x))
    by_function = Add(*(c * f if c.is_Rational else sympy.factor(cancel(c)) * f for f, c in totals.items()))
    yield from (value, expanded, by_function, _with_common_factors(by_function))
    if value.is_rational_function(x):
        yield cancel(value)


def as_quotient(value: Expr) -> Expr:
    """The value over one denominator in lowest terms, unless it is a sum of products, or too large to be multiplied out."""
    products = value.atoms(Mul, Pow)
    has_factors = any(part.is_Add for e in products for part in e.args)
    is_expanded = not has_factors and not value.has(exp) and all(e.is_Mul or e.exp.is_positive for e in products)
    # over Z[i], with many functions for variables, SymPy is slow
    if is_expanded or not value.has(Add) or value.has(sympy.I) or not _is_small(value):
        return value
    return cancel(sympy.together(value))


def _factored_forms(value: Expr, x: Expr) -> Iterator[Expr]:
    """The value with common factors before the sum, and over one denominator; different exponentials stay different."""
    exponentials = [e for e in value.atoms(exp) if e.has(x)]
    yield changed_beside(exponentials, value, _with_common_factors)
    yield changed_beside(exponentials, value, lambda plain: _with_common_factors(as_quotient(plain)))


def _with_common_factors(value: Expr) -> Expr:
    """The value with common factors before the sum; no fraction before unlike multiples, so that x/2 + exp(x)/3 stays."""
    found = sympy.factor_terms(value)
    number, rest = found.as_coeff_Mul()
    is_unlike = rest.is_Add and any(abs(term.as_coeff_Mul()[0]) != 1 for term in rest.args)
    return value if is_unlike and number not in (1, -1) else found


_SHAPE_RULES = (_in_absolute_values, _exchanged, _hyperbolic, _single_waves, _factored_forms, sums, _tangents)
