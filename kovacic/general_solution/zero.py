"""The zero test for constants: zero always, never, or for particular values of parameters.

A constant is an expression in the user's own symbols, with what is assumed of them.  "Never" without parameters, and "not
always" with them, is proven by a ball that doesn't contain zero, at values of the parameters that fit the assumptions.
"Always" is proven by rewriting as a sum of monomials; and, for numbers made of roots, by their minimal polynomial.

A formula is put into an equation in the same way: at points, in balls.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from enum import Enum
from itertools import islice
from math import lcm
from typing import Any

import sympy
from flint import acb, arb, fmpq
from sympy import Dummy, Poly, expand
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.check import DIGITS, letter_samples
from kovacic.closed_form.jets import ARBITRARY, jet
from kovacic.general_solution.integrands import prepared_integrand
from kovacic.general_solution.substitution import in_single_waves
from kovacic.limits import manageable
from kovacic.reading.parser import excerpt

Expr = Any  # SymPy publishes no types
#: Exceptions raised for functions that can't be evaluated.
NOT_EVALUATED = (NotImplementedError, ZeroDivisionError, AttributeError, ValueError, TypeError)
#: The largest product of the degrees of roots in an algebraic number whose minimal polynomial is computed: some 0.2 s.
_LARGEST_PRODUCT_OF_DEGREES = 64
#: Digits to which a number is compared with zero before it is rewritten at length.
_PRECISE = 400
#: The number of values of the letters that are tried.
_LETTER_SAMPLES = 6
#: Points x/101 + i y/89 in each quadrant and on the axis, where a formula is substituted: wrong branches of roots don't pass.
_QUADRANT_POINTS = ((137, 71), (-151, 83), (-97, -119), (163, -79), *((p, 0) for p in (23, 67, 173, 431, -41, -257)))


class Zero(Enum):
    """When a constant is zero: for all admissible values of its parameters, for none, or for some (not for all)."""

    ALWAYS = "always"
    NEVER = "never"
    SOMETIMES = "sometimes"


def when_zero(value: Expr) -> Zero:
    """Decide whether a constant is zero always, never or sometimes.  Raises `NotImplementedError` if that isn't possible.

    >>> n, k = sympy.Symbol("n", integer=True), sympy.Symbol("k")
    >>> when_zero(sympy.sin(n * sympy.pi)), when_zero(sympy.exp(k)), when_zero(1 - sympy.cos(n * sympy.pi))
    (<Zero.ALWAYS: 'always'>, <Zero.NEVER: 'never'>, <Zero.SOMETIMES: 'sometimes'>)
    """
    value = sympy.sympify(value, strict=True)
    if is_nowhere_zero(value):
        return Zero.NEVER
    if any(differs_from_zero(value, sample) for sample in islice(letter_samples(value.free_symbols), _LETTER_SAMPLES)):
        # A number that differs from zero is never zero; an expression in letters may be for other values of these.
        may_be_zero = value.free_symbols and not all(map(is_nowhere_zero, by_parity(value)))
        return Zero.SOMETIMES if may_be_zero else Zero.NEVER
    if is_identically_zero(value):
        return Zero.ALWAYS
    raise NotImplementedError(f"undecided: whether {excerpt(value, 60)} is zero")


def is_zero(value: Expr) -> bool:
    """True if a constant is zero for all values of its parameters.  Raises `NotImplementedError` if that can't be decided."""
    return when_zero(value) is Zero.ALWAYS


def is_nowhere_zero(value: Expr) -> bool:
    """True if no factor can be zero: by assumptions, or because the function has no zeros."""
    for base in (factor.as_base_exp()[0] for factor in sympy.Mul.make_args(value)):
        known = _NONZERO_IF.get(base.func)
        # of a long sum SymPy would compute parts to ever more digits
        if not (known(base) if known else manageable(base) and base.is_zero is False):
            return False
    return True


def is_positive_polynomial(p: Expr, *, or_zero: bool = False) -> bool:
    """True for a polynomial in real letters, roots and functions that is seen to be positive everywhere, or never negative.

    a v^2 + b v + c is if a and 4 a c - b^2 are, and b v + c for a wave v if c + b and c - b are; over Q, one in a single letter
    is if it has no real root and is positive at 0.

    >>> a, b = sympy.symbols("a b")
    >>> is_positive_polynomial(a**2 - a / sympy.sqrt(2) + b**2 + 1), is_positive_polynomial(a**2 - 2 * a + b**2 + 1)
    (True, False)
    """
    plain = _in_roots(p)
    is_seen = plain.is_nonnegative if or_zero else plain.is_positive
    if is_seen or not p.free_symbols:
        return bool(is_seen)
    whole = Poly(plain)
    letters = {v: Dummy(str(v), real=True, positive=v.is_positive) for v in whole.gens if v.free_symbols}
    if any(v.is_real is False or (v.is_Pow and not v.exp.is_Integer) for v in letters):
        return False
    plain = whole.as_expr(*(letters.get(v, v) for v in whole.gens))
    for function, v in sorted(letters.items(), key=str):
        parts: list[Expr] = []
        match Poly(plain, v).all_coeffs():
            case a, b, c:
                parts = [a, expand(4 * a * c - b**2)]
            case b, c if isinstance(function, (sympy.sin, sympy.cos)):
                parts = [c + b, c - b]
        if parts and all(is_positive_polynomial(part, or_zero=or_zero) for part in parts):
            return True
    is_rational = len(whole.gens) == 1 and whole.domain in (sympy.ZZ, sympy.QQ)
    return is_rational and bool(whole.nth(0) > 0) and whole.count_roots() == 0


def _in_roots(p: Expr) -> Expr:
    """With letters for real roots, u^(1/6) being one of which u^(1/3) is the square: u >= 0, and u > 0 if it stands below."""
    powers = [power for power in p.atoms(sympy.Pow) if power.exp.is_Rational and not power.exp.is_Integer]
    exponents: dict[Expr, list[Any]] = {}
    for power in powers:
        exponents.setdefault(power.base, []).append(power.exp)
    roots: dict[Expr, Expr] = {}
    for u, found in exponents.items():
        if u.free_symbols:
            n = lcm(*(e.q for e in found))
            sign = {"positive": True} if min(found) < 0 else {"nonnegative": True}
            root = Dummy(str(u), **sign)
            roots |= {u**e: root ** (e * n) for e in found}
    return p.xreplace(roots)


#: Functions, with a condition for one of them to be finite and not zero.
_NONZERO_IF: dict[Any, Callable[[Expr], Any]] = {
    # K has no positive zero for a real order, I for one that isn't negative.
    sympy.besselk: lambda f: f.args[0].is_real and f.args[1].is_positive,
    sympy.besseli: lambda f: f.args[0].is_nonnegative and f.args[1].is_positive,
    sympy.gamma: lambda f: expand(f.args[0]).is_positive or expand(f.args[0]).is_integer is False,  # no pole
    sympy.cosh: lambda f: f.args[0].is_real,
    # Mathieu's even solution, and the slope of his odd one, at 0: where one vanished, the solution would be 0.
    **dict.fromkeys((sympy.mathieuc, sympy.mathieusprime), lambda f: f.args[-1] == 0),
}


def by_parity(value: Expr) -> list[Expr]:
    """The value for even and for odd n, if n alone stands in a wave or a gamma function; else the value itself."""
    alone = {f.free_symbols.pop() for f in value.atoms(sympy.sin, sympy.cos, sympy.gamma) if len(f.free_symbols) == 1}
    halved = {n for n in alone if n.is_integer and n.is_odd is None}
    if len(halved) != 1:
        return [value]
    (n,) = halved
    even = Dummy(integer=True, positive=n.is_positive, nonnegative=n.is_nonnegative)
    odd = Dummy(integer=True, nonnegative=n.is_nonnegative)
    parts = [expand(value.subs(n, other)) for other in (2 * even, 2 * odd + 1)]
    return [sympy.factor_terms(sympy.powsimp(part)) for part in parts]


def generic_samples(symbols: set[Expr], natural: Expr | None = None) -> Iterator[dict[Expr, Expr]]:
    """Some `letter_samples` for which `natural` isn't negative, without the first one: the smallest integers are special."""
    later = islice(letter_samples(symbols), int(bool(symbols)), 1 + 4 * _LETTER_SAMPLES)
    return islice((one for one in later if natural is None or not natural.xreplace(one).is_negative), _LETTER_SAMPLES)


def opposite(sample: dict[Expr, Expr]) -> dict[Expr, Expr]:
    """The values with the other sign for symbols of unknown sign."""
    return {s: -value if {s.is_nonnegative, s.is_nonpositive} == {None} else value for s, value in sample.items()}


def ball_of(value: Expr, sample: dict[Expr, Expr] | None = None) -> Any:
    """The value of a constant as a ball, with the sample's values for letters; None if it can't be computed."""
    value = value.xreplace(sample or {})
    found = None if value.has(*ARBITRARY) else known_jet(value, Dummy(), acb(0))
    return found and found[0]


def known_jet(e: Expr, x: Expr, point: Any) -> Any:
    """The value and two slopes of an expression at a ball; None if a part can't be evaluated there."""
    with suppress(*NOT_EVALUATED):
        return jet(e, x, point)
    return None


def differs_from_zero(value: Expr, sample: dict[Expr, Expr]) -> bool:
    """True if some ball around the value excludes zero."""
    for digits in (DIGITS, _PRECISE):
        with working_digits(digits):
            found = ball_of(value, sample)
            if found is None or not found.is_finite():
                return False
            if not found.contains(0):
                return True
    return False


def agree(value: Expr, other: Expr) -> bool:
    """True if two expressions for a constant, found at different points, agree to as many as `DIGITS` digits."""
    difference = value - other
    with working_digits(3 * DIGITS):
        found = ball_of(difference, next(letter_samples(difference.free_symbols)))
        return found is not None and bool(abs(found) < arb(10) ** -DIGITS)


def is_identically_zero(value: Expr) -> bool:
    """True if it is provably zero: a sum of monomials in exponentials, waves and logarithms, or a number made of roots."""
    elementary = {f: sympy.expand_func(f) for f in value.atoms(BesselBase)}  # if the order is half an odd integer
    value = value.xreplace(elementary)
    numerator = sympy.numer(sympy.together(prepared_integrand(value)))  # a sum of waves, as sin(a) cos(b) isn't
    if in_single_waves(numerator) == 0:
        return True
    spread = sympy.expand_log(expand(numerator, power_base=True), force=False, factor=True)
    if expand(spread) == 0:
        return True
    if value.free_symbols:
        return bool(expand(sympy.powsimp(expand(numerator.rewrite(sympy.exp)))) == 0)
    return is_algebraic_zero(value)


def is_algebraic_zero(value: Expr) -> bool:
    """True if the minimal polynomial of a number made of rational numbers, i and roots is x.

    >>> is_algebraic_zero(sympy.sqrt(2) + sympy.sqrt(3) - sympy.sqrt(5 + 2 * sympy.sqrt(6)))
    True
    """
    degree = math.prod(int(root.exp.q) for root in value.atoms(sympy.Pow) if root.exp.is_Rational)
    x = Dummy()
    is_short = value.is_algebraic and degree <= _LARGEST_PRODUCT_OF_DEGREES
    return bool(is_short and sympy.minimal_polynomial(value, x) == x)


def residual_at(point: Any, x: Expr, y: Expr, coefficients: Sequence[Expr]) -> tuple[Any, Any]:
    """|a y'' + b y' + c y - f| at a point, and the sum of the terms' absolute values.  Raises `NotImplementedError`."""
    a, b, c, f = (jet(e, x, point)[0] for e in coefficients)
    value, first, second = jet(y, x, point)
    terms = [a * second, b * first, c * value, -f]
    if not all(term.is_finite() for term in terms):
        raise NotImplementedError("a value isn't finite")
    return abs(sum(terms)), sum(map(abs, terms), arb(0))


def quadrant_points() -> Iterator[Any]:
    """The points of `_QUADRANT_POINTS`, in each quadrant and on the axis."""
    return (acb(arb(fmpq(real, 101)), arb(fmpq(imaginary, 89))) for real, imaginary in _QUADRANT_POINTS)
