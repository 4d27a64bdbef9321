"""Constants that aren't rational in symbols, sin(theta), exp(-b), a^(1/3), log(2), as letters: names of parameters.

A letter stands for a maximal part without x of one of these kinds, and what a letter stands for may contain others: inner ones
come first.  What depends on others algebraically is written by them where that is known:

    roots of one base        by the root with the common index; a symbol beside its root by the root: a = t^2
    powers a^p, a^(2 p)      by the one with the greatest common divisor of the exponents, and so are exponentials; those of
                             numbers by those of primes
    waves of one argument    by sine and cosine, with sin^2 = 1 - cos^2; of multiples of it by the addition theorems
    logarithms of numbers    by those of primes

Any other relation isn't used: what holds for generic values of letters holds for theirs, if nothing is divided by zero.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, NamedTuple

import sympy
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.equation import UNKNOWN
from kovacic.numbers.numerals import as_text
from kovacic.reading.names import FUNCTION_NAMES, NUMBER_NAMES

Expr = Any  # SymPy publishes no types
Meanings = dict[Expr, Expr]  # of letters
#: The most letters of an equation, and characters of their names.
_MOST = 20
_LONGEST = 30
#: The largest number whose factors are asked for.
_LARGEST = 10**12


@dataclass(frozen=True)
class Lettered:
    """`parts` in letters, and what these stand for in the symbols that were given."""

    parts: tuple[Expr, ...]
    meanings: Meanings


def with_letters(parts: Sequence[Expr], coefficients: int, x: Expr) -> Lettered | None:
    """Expressions in which constants have become letters; None where the first ones, the `coefficients`, have none.

    >>> x, a, b = sympy.symbols("x a b")
    >>> found = with_letters((1 + sympy.sqrt(a), a * x, sympy.exp(2 * b)), 3, x)
    >>> found.parts, sorted(found.meanings.items(), key=str)
    ((sqrt_a + 1, sqrt_a**2*x, exp_b**2), [(exp_b, exp(b)), (sqrt_a, sqrt(a))])
    """
    letters = _LetterTable(x, parts)
    found = tuple(parts)
    for _ in range(_MOST):
        inner = _innermost(found[:coefficients], x)
        if not inner:
            break
        found = letters.replaced(found, inner)
    used = set().union(*(part.free_symbols for part in found))
    meanings = {letter: meaning for letter, meaning in letters.meanings.items() if letter in used}
    return Lettered(found, meanings) if found != tuple(parts) else None


def without_shifts(part: Expr, x: Expr) -> Expr:
    """exp(x) exp(b) in the place of exp(x + b), and waves by the addition theorems, for a constant b.

    >>> x, b = sympy.symbols("x b")
    >>> without_shifts(sympy.exp(2 * x - b) + sympy.cos(x + b), x)
    -sin(b)*sin(x) + cos(b)*cos(x) + exp(-b)*exp(2*x)

    Powers a^x are exponentials, whose rate is log(a).
    """
    inner = sympy.Dummy()
    shift = sympy.Dummy()

    def is_power_of_constant(e: Expr) -> bool:
        if not e.is_Pow or e.base is sympy.E:
            return False
        return bool(e.exp.has(x) and not e.base.has(x))

    def as_exponential(power: Expr) -> Expr:
        return sympy.exp(sympy.log(power.base) * power.exp, evaluate=False)

    def is_shifted(e: Expr) -> bool:
        if not isinstance(e, _EXPONENTIALS_AND_WAVES) or not e.has(x):
            return False
        return bool(_shifted(e.args[0], x).constant != 0)

    def apart(e: Expr) -> Expr:
        argument = _shifted(e.args[0], x)
        by_theorem = sympy.expand(e.func(inner + shift), trig=True)
        return by_theorem.xreplace({inner: argument.rest, shift: argument.constant})

    return part.replace(is_power_of_constant, as_exponential).replace(is_shifted, apart)


_EXPONENTIALS_AND_WAVES = (sympy.exp, TrigonometricFunction, HyperbolicFunction)


class _Shifted(NamedTuple):
    """constant + rest, where each term of the rest has x."""

    constant: Expr
    rest: Expr


def _shifted(argument: Expr, x: Expr) -> _Shifted:
    constant, rest = argument.expand().as_independent(x, as_Add=True)
    return _Shifted(constant, rest)


def _innermost(parts: Sequence[Expr], x: Expr) -> list[Expr]:
    """The constants that are no rational functions of symbols and numbers, and have no such constants within them."""
    # Beside pi, e becomes a letter, for the two numbers aren't known to be independent.
    e_is_known = not any(part.has(sympy.pi) for part in parts)
    found: set[Expr] = set()
    for part in parts:
        found.update(_kernels(part, x, e_is_known=e_is_known))
    return sorted(found, key=sympy.default_sort_key)


def _kernels(e: Expr, x: Expr, *, e_is_known: bool) -> list[Expr]:
    """Of one expression; `e_is_known`: powers of Euler's number are none."""
    is_constant = not e.has(x)
    if is_constant and _is_known(e, e_is_known=e_is_known):
        return []
    inner: list[Expr] = []
    for argument in e.args:
        inner += _kernels(argument, x, e_is_known=e_is_known)
    if inner or not is_constant or _is_rational(e):
        return inner
    return [e]


def _is_known(e: Expr, *, e_is_known: bool) -> bool:
    """Is a constant a symbol, an algebraic number, pi, or a power of Euler's number where that is known?"""
    if e.is_Symbol or e is sympy.pi:
        return True
    if e is sympy.E or (isinstance(e, sympy.exp) and e.args[0].is_Integer):
        return e_is_known
    return bool(e.is_number and e.is_algebraic)


def _is_rational(e: Expr) -> bool:
    """Is it a rational function of its arguments?"""
    if e is sympy.E or isinstance(e, sympy.exp):
        return False
    if e.is_Pow:
        return bool(e.exp.is_Integer)
    return bool(e.is_Add or e.is_Mul)


class _LetterTable:
    """Letters with what they stand for; new ones have names that nothing else has."""

    def __init__(self, x: Expr, parts: Sequence[Expr]) -> None:
        self.x = x
        symbols = set().union(*(part.free_symbols for part in parts))
        self.taken = {symbol.name for symbol in symbols} | {x.name, UNKNOWN, *NUMBER_NAMES, *FUNCTION_NAMES}
        self.meanings: Meanings = {}

    def letter(self, meaning: Expr) -> Expr:
        """A new letter for what may contain others."""
        whole = meaning.xreplace(self.meanings)
        name = re.sub(r"\W+", "_", as_text(whole)).strip("_")[:_LONGEST].rstrip("_")
        if not name.isidentifier():
            name = f"c_{name}"
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        new = sympy.Symbol(name)
        self.meanings[new] = whole
        return new

    def replaced(self, parts: Sequence[Expr], kernels: Sequence[Expr]) -> tuple[Expr, ...]:
        """The expressions with letters in the place of these constants."""
        depending = _depending(kernels)
        if depending:
            return tuple(part.xreplace(depending) for part in parts)
        values: Meanings = {kernel: self.letter(kernel) for kernel in kernels if not _is_power(kernel)}
        symbols: Meanings = {}
        for base, powers in _by_bases(kernels).items():
            found = self._powers_of(base, powers, replaced=symbols)
            values |= found.powers
            symbols |= found.symbols
        without_squares = [_without_squares(part, kernels) for part in parts]
        return tuple(part.xreplace(values).xreplace(symbols) for part in without_squares)

    def _powers_of(self, base: Expr, powers: Sequence[Expr], *, replaced: Meanings) -> _PowersInLetters:
        """base^(sum of r m), r rational and m monomials, by letters for base^(u m) with rational u.

        A base that is linear in a symbol which isn't `replaced` yet becomes a power of the letter, and so does the symbol.
        """
        one = sympy.S.One  # the monomial of base^r, and its rate in the base itself
        exponents = {power: _monomials(power) for power in powers}
        rates = _rates(exponents.values())
        line = None
        if one in rates:
            line = _solved_for(base, replaced)
        if line is not None:
            rates[one].append(one)
        roots = {monomial: self._root_of(base, monomial, of_monomial) for monomial, of_monomial in rates.items()}
        found = {
            power: sympy.Mul(*(roots[monomial].power(rate) for monomial, rate in terms.items()))
            for power, terms in exponents.items()
        }
        if line is None:
            return _PowersInLetters(found, {})
        return _PowersInLetters(found, {line.symbol: line.symbol_for(roots[one].power(one))})

    def _root_of(self, base: Expr, monomial: Expr, rates: Sequence[Expr]) -> _RootLetter:
        """A letter by which base^(r m) is rational for each of the rates r of a monomial m."""
        unit = _unit(rates)
        if monomial != 1 and not base.is_negative:
            unit /= 2  # so that the root, which solutions often have, is rational
        return _RootLetter(self.letter(base ** (unit * monomial)), unit)


class _PowersInLetters(NamedTuple):
    """What `powers` of one base are in letters, and the symbol that follows from a letter, if there is one."""

    powers: Meanings
    symbols: Meanings


class _RootLetter(NamedTuple):
    """A letter for base^(unit m)."""

    letter: Expr
    unit: Expr

    def power(self, rate: Expr) -> Expr:
        """base^(rate m)."""
        return self.letter ** (rate / self.unit)


class _LinearForm(NamedTuple):
    """slope symbol + rest."""

    symbol: Expr
    slope: Expr
    rest: Expr

    def symbol_for(self, value: Expr) -> Expr:
        """The symbol, if the form has this value."""
        return sympy.expand((value - self.rest) / self.slope)


def _depending(kernels: Sequence[Expr]) -> Meanings:
    """The constants that depend on others in a known way, in terms of these."""
    found: Meanings = {}
    for kernel in kernels:
        by_others = _by_others(kernel, kernels)
        if by_others != kernel:
            found[kernel] = by_others
    return found


def _is_power(kernel: Expr) -> bool:
    """Is it a power of a constant, or of Euler's number?"""
    return bool(kernel.is_Pow or kernel.as_base_exp()[0] is sympy.E)


def _by_bases(kernels: Sequence[Expr]) -> dict[Expr, list[Expr]]:
    """The powers among the constants, by their bases."""
    found: dict[Expr, list[Expr]] = {}
    for kernel in kernels:
        if _is_power(kernel):
            found.setdefault(kernel.as_base_exp()[0], []).append(kernel)
    return found


def _rates(exponents: Iterable[dict[Expr, Expr]]) -> dict[Expr, list[Expr]]:
    """The rational factors of each monomial in the exponents."""
    found: dict[Expr, list[Expr]] = {}
    for terms in exponents:
        for monomial, rate in terms.items():
            found.setdefault(monomial, []).append(rate)
    return found


def _monomials(power: Expr) -> dict[Expr, Expr]:
    """The exponent as a sum of rational numbers times monomials."""
    exponent = power.as_base_exp()[1]
    found: dict[Expr, Expr] = {}
    for term in sympy.Add.make_args(sympy.expand(exponent)):
        rate, monomial = term.as_coeff_Mul(rational=True)
        found[monomial] = found.get(monomial, sympy.S.Zero) + rate
    return found


def _unit(rates: Sequence[Expr]) -> Expr:
    """The greatest common divisor of rational numbers, negative where they all are negative."""
    divisor = reduce(sympy.gcd, rates)
    are_negative = all(rate < 0 for rate in rates)
    if are_negative and divisor > 0:
        return -divisor
    return divisor


def _solved_for(base: Expr, known: Meanings) -> _LinearForm | None:
    """The base as a function of degree 1 of a symbol that isn't replaced yet; pi is one, too."""
    if base is sympy.pi:
        return _LinearForm(base, slope=sympy.S.One, rest=sympy.S.Zero)
    for symbol in sorted(base.free_symbols - known.keys(), key=str):
        slope = base.diff(symbol)
        rest = sympy.expand(base - slope * symbol)
        if slope.is_Rational and not rest.free_symbols & known.keys():
            return _LinearForm(symbol, slope, rest)
    return None


def _by_others(kernel: Expr, kernels: Sequence[Expr]) -> Expr:
    """A constant in terms of the others, where it depends on them in a known way; else itself."""
    if isinstance(kernel, sympy.log):
        return _log_by_primes(kernel)
    if isinstance(kernel, TrigonometricFunction):
        return _by_waves(kernel, _of_kind(kernels, TrigonometricFunction), _TRIGONOMETRIC)
    if isinstance(kernel, HyperbolicFunction):
        if _of_kind(kernels, sympy.exp):
            return kernel.rewrite(sympy.exp)
        return _by_waves(kernel, _of_kind(kernels, HyperbolicFunction), _HYPERBOLIC)
    return _power_by_primes(kernel)


def _of_kind(kernels: Sequence[Expr], kind: Any) -> list[Expr]:
    return [kernel for kernel in kernels if isinstance(kernel, kind)]


@dataclass(frozen=True)
class _SineAndCosine:
    """The functions s and c of which the other waves of their kind are quotients, with s^2 = sign (1 - c^2)."""

    sine: Any
    cosine: Any
    sign: int

    def quotient(self, wave: Expr) -> Expr:
        """A wave that is neither, as a quotient of s and c of its argument."""
        s = self.sine(*wave.args)
        c = self.cosine(*wave.args)
        forms = {"tan": s / c, "cot": c / s, "sec": 1 / c, "csc": 1 / s}
        return forms[wave.func.__name__.removesuffix("h")]

    def square_of_sine(self, argument: Expr) -> Expr:
        return self.sign * (1 - self.cosine(argument) ** 2)


_TRIGONOMETRIC = _SineAndCosine(sympy.sin, sympy.cos, 1)
_HYPERBOLIC = _SineAndCosine(sympy.sinh, sympy.cosh, -1)


def _log_by_primes(logarithm: Expr) -> Expr:
    """log(12) = 2 log(2) + log(3); of what isn't a number that can be factored itself."""
    argument = logarithm.args[0]
    if argument.is_Rational and abs(argument) < _LARGEST:
        return sympy.expand_log(logarithm, factor=True)
    return logarithm


def _power_by_primes(power: Expr) -> Expr:
    """12^a = 2^(2 a) 3^a; of what isn't a number that can be factored itself."""
    base, exponent = power.as_base_exp()
    if base.is_Rational and 0 < base < _LARGEST and 1 / base < _LARGEST:
        return sympy.Mul(*(prime ** (k * exponent) for prime, k in sympy.factorrat(base).items()))
    return power


def _by_waves(kernel: Expr, waves: Sequence[Expr], pair: _SineAndCosine) -> Expr:
    """A wave by those of a part of its argument, or by sine and cosine beside other waves of its argument."""
    (argument,) = kernel.args
    arguments = {wave.args[0] for wave in waves}
    if any(argument != other and (argument / other).is_Integer for other in arguments):
        return sympy.expand_trig(kernel)
    has_others_beside = any(wave.args == kernel.args and wave != kernel for wave in waves)
    if not has_others_beside or isinstance(kernel, (pair.sine, pair.cosine)):
        return kernel
    return pair.quotient(kernel)


def _without_squares(part: Expr, kernels: Sequence[Expr]) -> Expr:
    """With 1 - cos^2 in the place of sin^2, where sine and cosine of one argument are among the constants; and with sinh^2."""
    squares = _squares_of_sines(kernels)
    lower: Meanings = {}
    for power in part.atoms(sympy.Pow):
        if power.base in squares and power.exp.is_Integer:
            lower[power] = power.base ** (power.exp % 2) * squares[power.base] ** (power.exp // 2)
    return part.xreplace(lower)


def _squares_of_sines(kernels: Sequence[Expr]) -> Meanings:
    """By the sines beside whose cosine they stand, their squares."""
    squares: Meanings = {}
    for pair in (_TRIGONOMETRIC, _HYPERBOLIC):
        for wave in _of_kind(kernels, pair.sine):
            if pair.cosine(*wave.args) in kernels:
                squares[wave] = pair.square_of_sine(*wave.args)
    return squares
