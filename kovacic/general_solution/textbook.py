"""What a textbook prints: the shortest of equal forms of an answer, in the order that `special.choice` documents.

Each rule is an identity that holds on the whole plane, or on the real line where steps occur, and so for every value of the
parameters; what it makes is taken where it is shorter.

    c e^p + d e^q = e^m ((c + d) cosh h + (c - d) sinh h),   m = (p + q)/2,  h = (p - q)/2,                             (1)

in numerators and denominators whose exponents lie symmetrically about one m, the same up to constants: sinh(k x)/sinh(k a)
for what the equations for constants give;

    f + g H(x - a) = F(a + |x - a|),   F = f + g,   if f is F reflected in a;                                          (2)

sin u cos v as a sum of waves, which is sin(x - a) beside a step at a; tan u for sin u/cos u.
A pair of solutions is changed before constants are given values:

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
from sympy import Abs, Heaviside, cos, cosh, exp, sin, sinh
from sympy.simplify.fu import TR2, TR5, TR6, TR2i, TR10i, hyper_as_trig

from kovacic.closed_form.jets import jet
from kovacic.general_solution.integrands import radicands
from kovacic.general_solution.substitution import by_functions, changed_beside, expanded_size, in_single_waves
from kovacic.general_solution.zero import is_positive_polynomial, is_zero, points
from kovacic.special.choice import shortest

Expr = Any  # SymPy publishes no types
#: The most symbols, functions and constants in a complex quotient whose lowest terms are computed: some 50 ms.
_MOST_ATOMS = 6
#: The largest expression, in subexpressions when it is multiplied out, for which other forms are looked for: some 50 ms.
_LARGEST = 400


def in_book_form(value: Expr, x: Expr, free: Sequence[Expr] = ()) -> Expr:
    """The shortest form of an answer; the functions that the constants `free` of a general one belong to stay."""
    if value.free_symbols != {x}:
        value = shortest([value, _with_short_coefficients(value, x)])
    for rule in _RULES_OF_GENERAL_SOLUTIONS if free else _SHAPE_RULES:
        if _is_small(value):
            value = shortest([value, *rule(value, x)])
    return _with_moduli(_with_equal_roots(_without_roots_of_squares(value, x, free)))


def _with_moduli(value: Expr) -> Expr:
    """|x| for 2 x H(x) - x in functions and powers, as in log|x|, also of a letter of integration."""
    inside = {e.args[0] for e in value.atoms(sympy.Pow, sympy.Function) if e.args[0].is_Add}
    return value.xreplace({u: modulus for u in inside for x in u.free_symbols for modulus in _absolute(u, x)})


def _without_roots_of_squares(value: Expr, x: Expr, free: Sequence[Expr]) -> Expr:
    """With u for sqrt(u^2) where -u gives the same, or the same solutions by the signs of the free constants."""
    for base in {base for base in radicands(value) if base.free_symbols and not base.has(x)}:
        u = sympy.powdenest(sympy.sqrt(base), force=True)
        s = sympy.Dummy()
        in_s = value.replace(lambda e: e.is_Pow and e.base == base, lambda e: s ** (2 * e.exp))  # noqa: B023
        others = (
            in_s.subs([*zip(free, map(mul, row, free), strict=True)]) for row in product((1, -1), repeat=len(free))
        )
        if u.is_rational_function() and in_s.xreplace({s: -s}) in others:
            value = in_s.xreplace({s: u})
    return value


def _with_equal_roots(value: Expr) -> Expr:
    """sqrt(c*(4*l - c*r^2)) for sqrt(-c*(c*r^2 - 4*l)) beside it: equal radicands in the shortest of their forms."""
    forms: dict[Expr, list[Expr]] = defaultdict(list)
    for base in radicands(value):
        if not base.is_Symbol and expanded_size(base) <= _LARGEST:
            forms[sympy.expand(base)].append(base)
    short = {base: min(equal, key=sympy.count_ops) for equal in forms.values() for base in equal}
    return value.replace(lambda e: e.is_Pow and short.get(e.base, e.base) != e.base, lambda e: short[e.base] ** e.exp)


def in_hyperbolic_functions(value: Expr) -> Expr:
    """By (1), times an exponential function; the same where it isn't of this kind, or long."""
    return next(_hyperbolic(value.rewrite((sinh, cosh), exp), sympy.Dummy()), value) if _is_small(value) else value


def _is_small(value: Expr) -> bool:
    return expanded_size(value) <= _LARGEST and not value.has(sympy.Integral, sympy.RootSum)


def with_waves(y1: Expr, y2: Expr) -> tuple[Expr, Expr]:
    """The pair (3) where u may be negative, which is taken for that of a damping below 1; else these two."""
    (c1, A1), (c2, A2) = (_exponent(y) for y in (y1, y2))
    P = sympy.expand((A1 + A2) / 2)
    Q = sympy.expand((A1 - A2) / 2)
    roots = [power for power in Q.atoms(sympy.Pow) if power.exp == sympy.S.Half and power.free_symbols]
    if c1 == c2 and P != 0 and len(roots) == 1 and roots[0].base.is_Add:
        (root,) = roots
        q = sympy.cancel(Q / root)
        is_real = root.base.is_polynomial() and is_positive_polynomial(sympy.expand(root.base), or_zero=True)
        if not is_real and not q.has(root):
            angle = q * sympy.sqrt(sympy.expand(-root.base))
            return c1 * exp(P) * cos(angle), c1 * exp(P) * sin(angle)
    return y1, y2


def _exponent(y: Expr) -> tuple[Expr, Expr]:
    """c and A for c e^A."""
    powers = y.as_powers_dict()
    A = powers.pop(sympy.E, sympy.S.Zero)
    return sympy.Mul(*(base**e for base, e in powers.items())), A


def of_chebyshev(y1: Expr, y2: Expr, x: Expr) -> tuple[Expr, Expr, Expr | None]:
    """The pair (4) beside g for g (f + sqrt(f^2 - c^2))^n and its inverse, c a number or a letter; else these two.

    With it, where c is a number, a point at which |f| < |c|.
    """
    powers, others = sympy.sift(
        sympy.Mul.make_args(y1), lambda part: part.is_Pow and part.base.is_Add and not part.exp.is_Rational, binary=True
    )
    g = sympy.Mul(*others)
    if len(powers) != 1 or sympy.powsimp(powers[0] * y2 / g) != 1:
        return y1, y2, None
    (power,) = powers
    for f, rest in (power.base.as_two_terms(), power.base.as_two_terms()[::-1]):
        square = sympy.expand(f**2 - rest**2)
        c = sympy.powdenest(sympy.sqrt(square), force=True)
        # sqrt(x^2 + 1) + x is one for f = x i alone
        is_real = square.is_positive or (not radicands(c) and not c.has(sympy.I))
        line, middle = (f**2, square / 4) if any(base.has(x) for base in radicands(f)) else (f, c / 2)
        if not line.diff(x).has(x) and is_real and not square.has(x):
            place = (middle - line.subs(x, 0)) / line.diff(x) if c.is_number and line.diff(x).is_number else None
            turned = {p: (-p.base) ** p.exp for p in g.atoms(sympy.Pow) if sympy.rem(p.base, rest**2, x) == 0}
            g = g.xreplace(turned)  # a constant multiple, real where |f| < |c|
            angle = power.exp * sympy.acos(f / c)
            return g * cos(angle), g * sin(angle), place
    return y1, y2, None


def without_homogeneous(particular: Expr, y1: Expr, y2: Expr, x: Expr) -> Expr:
    """The shortest of the particular solutions that differ from this one by a multiple of a term of its own."""
    if not particular.has(sympy.Add, sin, cos) or not _is_small(particular):
        return particular
    forms = [particular, *_single_waves(particular, x), *_common_factors(particular, x), *_in_one_wave(particular)]
    for _, before, after in _before_and_after(particular, x):
        terms = sympy.Add.make_args(sympy.expand(after - before))
        own = [-term for term in terms if any(is_constant(term / y, x) for y in (y1, y2))]
        for h in (0, *own, sympy.Add(*own) / 2):
            forms += _absolute(particular + h, x)
    return shortest(sorted(forms, key=lambda form: form.could_extract_minus_sign()))


def is_constant(quotient: Expr, x: Expr) -> bool:
    """True if the expression is seen to be constant; a slope other than zero at one point refutes it first."""
    with suppress(NotImplementedError):
        if quotient.has(x) and not jet(quotient, x, next(points()))[1].contains(0):
            return False
    return not sympy.powsimp(sympy.expand(quotient)).has(x)


# ------------------------------------------------------------------------------------------------------------- rules


def _before_and_after(value: Expr, x: Expr) -> Iterator[tuple[Expr, Expr, Expr]]:
    """a, f and f + g for f + g H(x - a); nothing for other steps, or several."""
    steps = [step for step in value.atoms(Heaviside) if step.has(x)]
    if len(steps) == 1 and steps[0].args[0].diff(x) == 1 and not value.has(sympy.DiracDelta):
        before, after = (sympy.expand(value.xreplace({steps[0]: sympy.Integer(k)})) for k in (0, 1))
        yield sympy.expand(x - steps[0].args[0]), before, after


def _absolute(value: Expr, x: Expr) -> Iterator[Expr]:
    """(2), for steps at one point."""
    u = sympy.Dummy()
    for a, *parts in _before_and_after(value, x):
        places = (a - u, a + u)
        before, after = (sympy.powsimp(sympy.expand(part.subs(x, at))) for part, at in zip(parts, places, strict=True))
        if before != 0 and is_zero(before - after):
            yield sympy.factor_terms(after).subs(u, Abs(x - a))


def _hyperbolic(value: Expr, x: Expr) -> Iterator[Expr]:
    """(1) in the numerator and in the denominator, which are polynomials in letters for the e^rate that occur."""
    if value.has(sinh, cosh):  # t sinh(t) + t cosh(t)
        yield sympy.expand(value.rewrite((sinh, cosh), exp))
    is_in_sum = any(part.has(exp) for part in value.atoms(sympy.Add))
    if not is_in_sum and all(e.has(x) for e in value.atoms(exp)):  # a product has one exponential, and keeps it
        return
    exponents = {
        e: by_functions(sympy.expand(e.as_base_exp()[1]), lambda factor: factor.is_Rational)
        for e in value.atoms(exp, type(sympy.E))
    }
    unit: dict[Expr, int] = defaultdict(lambda: 1)
    for rate, n in sorted((item for rates in exponents.values() for item in rates.items()), key=str):
        unit[rate] = lcm(unit[rate], int(n.q))
    letters = {rate: sympy.Dummy(positive=True) for rate in unit}  # e^(rate/unit)
    plain = {e: sympy.Mul(*(letters[r] ** (n * unit[r]) for r, n in rates.items())) for e, rates in exponents.items()}
    rate_of = {letter: rate / unit[rate] for rate, letter in letters.items()}
    fraction = sympy.fraction(sympy.cancel(sympy.together(value.xreplace(plain))))
    with suppress(_NotSymmetric):
        (m, top), (n, bottom) = (_symmetric_product(part, rate_of) for part in fraction)
        if (m - n).has(x):  # decaying exponentials stay apart
            return
        scale = exp(sympy.expand(m - n)) / bottom
        yield scale * top
        yield sympy.Add(*(scale * term for term in sympy.Add.make_args(sympy.expand(top))))


class _NotSymmetric(Exception):
    """A sum isn't of the kind (1)."""


def _symmetric_product(polynomial: Expr, rate_of: Mapping[Expr, Expr]) -> tuple[Expr, Expr]:
    """m, and the rest without e^m, by factors without common letters: X^2 - 1, which is sinh, stays whole."""
    constant, polynomial = polynomial.as_independent(*rate_of, as_Add=False)
    # SymPy can't sort factors with a^n, a^i; J(exp(x)) is no polynomial
    is_sorted = all(power.exp.is_Rational for power in polynomial.atoms(sympy.Pow))
    if not (is_sorted and polynomial.is_polynomial(*rate_of)):
        raise _NotSymmetric
    number, factors = sympy.factor_list(polynomial, *rate_of)
    groups: list[Expr] = []
    for base, k in factors:
        letters = base.free_symbols & {*rate_of}
        common, groups = sympy.sift(groups, lambda group: group.has(*letters), binary=True)  # noqa: B023
        groups.append(sympy.Mul(base**k, *common))
    parts = [_symmetric(group, rate_of) for group in groups]
    return sympy.Add(*(m for m, _ in parts)), sympy.Mul(constant, number, *(total for _, total in parts))


def _symmetric(part: Expr, rate_of: Mapping[Expr, Expr]) -> tuple[Expr, Expr]:
    """m, and the sum (1) without e^m, for a polynomial in the letters that stand for e^rate."""
    terms = sympy.Poly(part, *rate_of).terms()
    by_exponent = {sympy.expand(sympy.Add(*map(mul, degrees, rate_of.values()))): c for degrees, c in terms}
    m = sympy.expand(sympy.Add(*by_exponent) / len(terms))
    total = sympy.Integer(0)
    for exponent, c in by_exponent.items():
        d = by_exponent.get(sympy.expand(2 * m - exponent))
        if d is None or (0 not in (c + d, c - d) and c.is_number and d.is_number):
            raise _NotSymmetric
        h = sympy.expand(exponent - m)
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
    """Products of waves as sums, where a term has two."""
    expanded = sympy.expand(value) if value.has(sin, cos) else value
    terms = map(sympy.Mul.make_args, sympy.Add.make_args(expanded))
    if any(sum(isinstance(factor, sin | cos) for factor in term) > 1 for term in terms):
        found = sympy.powsimp(in_single_waves(value))
        steps = sorted(value.atoms(Heaviside), key=str)
        yield found
        yield sympy.collect(found, steps, _with_common_factors)
        yield sympy.collect(expanded, steps, _as_one_wave)


def _in_one_wave(value: Expr) -> Iterator[Expr]:
    """Powers of sines, or of cosines, for sin(3 x) beside logarithms of these."""
    if value.has(sympy.log) and value.has(sin, cos):
        value = value.replace(sympy.log, lambda u: sympy.log(sympy.factor(u)))
        for form in (TR5, TR6):
            yield changed_beside(
                value.atoms(sympy.log),
                value,
                lambda e: sympy.expand(form(sympy.expand(sympy.expand_trig(e)))),  # noqa: B023
            )


def _as_one_wave(total: Expr) -> Expr:
    """sin(x - a) for sin(x) cos(a) - cos(x) sin(a), but no sqrt(2) sin(x + pi/4) for sin(x) + cos(x)."""
    found = TR10i(total)
    return _with_common_factors(total if found.has(sympy.pi) else found)


def _with_short_coefficients(e: Expr, x: Expr) -> Expr:
    """With quotients of letters in factors, squares completed, as in (k - m w^2)^2 + c^2 w^2."""
    if not e.has(x):
        return shortest([e, *_quotients_in_factors(e)])
    if e.is_Add:
        parts = [_with_short_coefficients(part, x).as_independent(x, as_Add=False) for part in e.args]
        functions = {sympy.Dummy(): function for _, function in parts}  # what contains x stays apart
        total = sympy.Add(*(c * name for (c, _), name in zip(parts, functions, strict=True)))
        return shortest([form.xreplace(functions) for form in (total, _with_common_factors(total))])
    if not (e.is_Mul or e.is_Pow or (e.is_Function and len(e.args) == 1)):
        return e
    number, rest = e.as_independent(x, as_Add=False)
    inner = (number, *sympy.Mul.make_args(rest)) if e.is_Mul else e.args
    return e.func(*(_with_short_coefficients(part, x) for part in inner))


def _quotients_in_factors(e: Expr) -> Iterator[Expr]:
    """A quotient of polynomials, or a multiple of one square root sqrt(u) = u/sqrt(u), in factors."""
    if not e.has(sympy.Add) or not e.free_symbols or e.has(sympy.Function):
        return
    bases = {power.base for power in e.atoms(sympy.Pow) if not power.exp.is_Integer}
    u = bases.pop() if bases else sympy.S.One
    root = sympy.sqrt(u)
    rational = sympy.cancel(e / root)
    if not bases and rational.is_rational_function():
        for quotient, factor in ((rational, root), (sympy.cancel(rational * u), 1 / root)):
            yield sympy.factor(quotient).replace(lambda part: part.is_Add, _with_square) * factor


def _with_square(total: Expr) -> Expr:
    """(a + b)^2 + rest for a^2 + 2 a b + b^2 + rest, with products a and b; else the same."""
    roots = [sympy.powdenest(sympy.sqrt(term), force=True) for term in total.args]
    pairs = combinations([root for root in roots if root.is_polynomial()], 2)
    for (a, b), sign in product(pairs, (1, -1)):
        if 2 * sign * a * b in total.args:
            return (a + sign * b) ** 2 + (total - sympy.expand((a + sign * b) ** 2))
    return total


def _tangents(value: Expr, x: Expr) -> Iterator[Expr]:
    """tan u for sin u/cos u, tanh u for sinh u/cosh u."""
    if {cos, cosh} & {power.base.func for power in value.atoms(sympy.Pow)}:
        yield _also_hyperbolic(TR2i, value)


def _also_hyperbolic(change: Callable[[Expr], Expr], value: Expr) -> Expr:
    """By an identity of circular functions, and by that of the hyperbolic ones."""
    waves, back = hyper_as_trig(change(value))
    return back(change(waves))


def sums(value: Expr, x: Expr) -> Iterator[Expr]:
    """With powers joined, multiplied out, with one coefficient for each function of x, and rational ones in lowest terms.

    Also with quotients of waves for tangents: sin(x) for cos(x) tan(x).
    """
    if value.has(sympy.tan, sympy.cot, sympy.tanh, sympy.coth):
        yield from sums(_also_hyperbolic(TR2, value), x)
    value = sympy.powsimp(value)
    expanded = sympy.powsimp(sympy.expand(value))
    totals = by_functions(expanded, lambda factor: not factor.has(x))
    by_function = sympy.Add(*(c * f if c.is_Rational else sympy.factor(sympy.cancel(c)) * f for f, c in totals.items()))
    yield from (value, expanded, by_function, _with_common_factors(by_function))
    if value.is_rational_function(x):
        yield sympy.cancel(value)


def over_one_denominator(value: Expr, x: Expr) -> Iterator[Expr]:
    """A quotient in lowest terms, unless it is a sum of products, or too large to be multiplied out."""
    products = value.atoms(sympy.Mul, sympy.Pow)
    has_factors = any(part.is_Add for e in products for part in e.args)
    if not has_factors and not value.has(exp) and all(e.is_Mul or e.exp.is_positive for e in products):
        return
    atoms = {*value.free_symbols, *value.atoms(sympy.Function, sympy.NumberSymbol)}
    is_slow = len(atoms) > _MOST_ATOMS and value.has(sympy.I)  # in ten variables over Z[i]
    if value.has(sympy.Add) and not is_slow and _is_small(value):
        yield sympy.cancel(sympy.together(value))


def _common_factors(value: Expr, x: Expr) -> Iterator[Expr]:
    """Over one denominator, and with common factors before the sum; different exponentials stay different."""
    exponentials = [e for e in value.atoms(exp) if e.has(x)]
    yield changed_beside(exponentials, value, _with_common_factors)
    yield changed_beside(
        exponentials, value, lambda plain: _with_common_factors(next(over_one_denominator(plain, x), plain))
    )


def _with_common_factors(value: Expr) -> Expr:
    """With common factors before the sum, but no fraction before unlike multiples: x/2 + exp(x)/3 stays."""
    found = sympy.factor_terms(value)
    number, rest = found.as_coeff_Mul()
    is_unlike = rest.is_Add and any(abs(term.as_coeff_Mul()[0]) != 1 for term in rest.args)
    return value if is_unlike and number not in (1, -1) else found


_ShapeRule = Callable[[Expr, Expr], Iterator[Expr]]
_SHAPE_RULES: tuple[_ShapeRule, ...] = (
    _absolute,
    _exchanged,
    _hyperbolic,
    _single_waves,
    _common_factors,
    sums,
    _tangents,
)
_RULES_OF_GENERAL_SOLUTIONS = (_tangents,)
