"""Constants that aren't rational in symbols, sin(theta), exp(-b), a^(1/3), log(2), as letters: names of parameters.

A letter stands for a maximal part without x of one of these kinds, and what a letter stands for may contain others: inner ones
come first.  Known algebraic relations between constants are used:

    roots of one base        by the root with the common index; a symbol and its root by the root: a = t^2
    powers a^p, a^(2 p)      by the one with the greatest common divisor of the exponents, and so are exponentials; those of
                             numbers by those of primes
    waves of one argument    by sine and cosine, with sin^2 = 1 - cos^2; of multiples of it by the addition theorems
    logarithms of numbers    by those of primes

Any other relation isn't used: what holds for generic values of letters holds for theirs, if nothing is divided by zero.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import reduce
from typing import Any, NamedTuple

import sympy
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.equation import UNKNOWN
from kovacic.limits import check_time
from kovacic.numbers.numerals import as_text
from kovacic.reading.names import FUNCTION_NAMES, NUMBER_NAMES

Expr = Any  # SymPy publishes no types
Meanings = dict[Expr, Expr]  # of letters


class Lettered(NamedTuple):
    """`parts` in letters, and what these stand for in the symbols that were given."""

    parts: tuple[Expr, ...]
    meanings: Meanings


def letters_for_constants(parts: Sequence[Expr], x: Expr) -> Lettered | None:
    """Expressions in which constants have become letters; None if the first three, the coefficients, have none.

    >>> x, a, b = sympy.symbols("x a b")
    >>> found = letters_for_constants((1 + sympy.sqrt(a), a * x, sympy.exp(2 * b)), x)
    >>> found.parts, sorted(found.meanings.items(), key=str)
    ((sqrt_a + 1, sqrt_a**2*x, exp_b**2), [(exp_b, exp(b)), (sqrt_a, sqrt(a))])
    """
    letters = _LetterTable(x, parts)
    found = tuple(parts)
    while True:
        check_time()
        # Beside pi, e becomes a letter, for the two numbers aren't known to be independent.
        e_is_known = not sympy.Tuple(*found[:3]).has(sympy.pi)
        inner = {kernel for part in found[:3] for kernel in _kernels(part, x, e_is_known=e_is_known)}
        if not inner:
            break
        found = letters.replaced(found, sorted(inner, key=sympy.default_sort_key))
    used = sympy.Tuple(*found).free_symbols
    meanings = {letter: meaning for letter, meaning in letters.meanings.items() if letter in used}
    return Lettered(found, meanings) if found != tuple(parts) else None


def without_shifts(part: Expr, x: Expr) -> Expr:
    """exp(x) exp(b) in the place of exp(x + b), and waves by the addition theorems, for a constant b.

    >>> x, b = sympy.symbols("x b")
    >>> without_shifts(sympy.exp(2 * x - b) + sympy.cos(x + b), x)
    -sin(b)*sin(x) + cos(b)*cos(x) + exp(-b)*exp(2*x)

    Powers a^x are exponentials, whose rate is log(a).
    """
    inner, shift = sympy.symbols("inner shift", cls=sympy.Dummy)

    def apart(e: Expr) -> Expr:
        constant, rest = e.args[0].expand().as_independent(x, as_Add=True)
        return sympy.expand(e.func(inner + shift), trig=True).xreplace({inner: rest, shift: constant})

    bases = {p: sympy.log(p.base) * p.exp for p in part.atoms(sympy.Pow) if p.exp.has(x) and not p.base.has(x)}
    part = part.xreplace({power: sympy.exp(exponent, evaluate=False) for power, exponent in bases.items()})
    kinds = (sympy.exp, TrigonometricFunction, HyperbolicFunction)
    return part.replace(lambda e: isinstance(e, kinds) and e.has(x), apart)


def _kernels(e: Expr, x: Expr, *, e_is_known: bool) -> list[Expr]:
    """The innermost constants that aren't rational in symbols and numbers (and powers of e, if `e_is_known`)."""
    base, exponent = e.as_base_exp()
    arguments = (each for each in e.args if isinstance(each, sympy.Expr))  # a derivative also has a pair among them
    inner = [kernel for argument in arguments for kernel in _kernels(argument, x, e_is_known=e_is_known)]
    if inner or e.has(x) or e.is_Symbol or e is sympy.pi or e.is_Add or e.is_Mul:
        return inner
    is_whole = exponent.is_Integer and (e.is_Pow or base is sympy.E)
    is_rational = e_is_known and is_whole if base is sympy.E else is_whole or (e.is_number and e.is_algebraic)
    return [] if is_rational else [e]


class _LetterTable:
    """Letters with their meanings; a new letter has a name of its own."""

    def __init__(self, x: Expr, parts: Sequence[Expr]) -> None:
        used = {symbol.name for symbol in sympy.Tuple(x, *parts).free_symbols}
        self.taken = {UNKNOWN, *used, *NUMBER_NAMES, *FUNCTION_NAMES}
        self.meanings: Meanings = {}

    def letter(self, meaning: Expr) -> Expr:
        """A new letter for a constant, which may contain other letters."""
        whole = meaning.xreplace(self.meanings)
        name = re.sub(r"\W+", "_", as_text(whole)).strip("_")[:30].rstrip("_")
        if not name.isidentifier():
            name = f"c_{name}"
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        new = sympy.Symbol(name)
        self.meanings[new] = whole
        return new

    def replaced(self, parts: Sequence[Expr], kernels: Sequence[Expr]) -> tuple[Expr, ...]:
        """The expressions with letters in the place of these constants; first those that depend on others by these."""
        by_others = {kernel: _by_others(kernel, kernels) for kernel in kernels}
        if [*by_others.values()] != [*kernels]:
            return tuple(part.xreplace(by_others) for part in parts)
        values: Meanings = {}
        symbols: Meanings = {}
        by_bases: dict[Expr, list[Expr]] = {}
        for kernel in kernels:
            base = kernel.as_base_exp()[0]
            if kernel.is_Pow or base is sympy.E:
                by_bases.setdefault(base, []).append(kernel)
            else:
                values[kernel] = self.letter(kernel)
        for base, powers in by_bases.items():
            values |= self._powers_of(base, powers, symbols)
        return tuple(_without_squared_waves(part, kernels).xreplace(values).xreplace(symbols) for part in parts)

    def _powers_of(self, base: Expr, powers: Sequence[Expr], symbols: Meanings) -> Meanings:
        """base^(sum of r m), r rational and m monomials, by letters for base^(u m), u the common divisor of the rates r.

        A base that is linear in a symbol which isn't among the `symbols` yet becomes a power of the letter, and so does this.
        """
        one = sympy.S.One  # the monomial of base^r, and the rate of the base itself
        exponents: dict[Expr, dict[Expr, Expr]] = {each: {} for each in powers}  # r by m
        rates: dict[Expr, list[Expr]] = {}
        for each, terms in exponents.items():
            for term in sympy.Add.make_args(sympy.expand(each.as_base_exp()[1])):
                rate, monomial = term.as_coeff_Mul(rational=True)
                terms[monomial] = rate
                rates.setdefault(monomial, []).append(rate)
        line = _line_in_symbol(base, symbols) if one in rates else None
        if line is not None:
            rates[one].append(one)
        units: dict[Expr, Expr] = {}
        for monomial, of_monomial in rates.items():
            units[monomial] = abs(reduce(sympy.gcd, of_monomial)) * (-1 if all(rate < 0 for rate in of_monomial) else 1)
            if monomial != 1 and not base.is_negative:
                units[monomial] /= 2  # so that the root, which solutions often have, is rational
        roots = {monomial: self.letter(base ** (unit * monomial)) for monomial, unit in units.items()}

        def power(monomial: Expr, rate: Expr) -> Expr:
            return roots[monomial] ** (rate / units[monomial])

        if line is not None:  # slope symbol + rest = base
            symbol, slope, rest = line
            symbols[symbol] = sympy.expand((power(one, one) - rest) / slope)
        return {each: sympy.Mul(*(power(m, rate) for m, rate in terms.items())) for each, terms in exponents.items()}


def _line_in_symbol(base: Expr, known: Meanings) -> tuple[Expr, Expr, Expr] | None:
    """A symbol, not among the `known` ones, and m and r with base = m symbol + r; pi is one, too."""
    if base is sympy.pi:
        return base, sympy.S.One, sympy.S.Zero
    for symbol in sorted(base.free_symbols - known.keys(), key=str):
        slope = base.diff(symbol)
        rest = sympy.expand(base - slope * symbol)
        if slope.is_Rational and not rest.free_symbols & known.keys():
            return symbol, slope, rest
    return None


#: The sine s and the cosine c of each kind of waves, with s^2 = sign (1 - c^2); the others are quotients of them.
_WAVE_KINDS = {TrigonometricFunction: (sympy.sin, sympy.cos, 1), HyperbolicFunction: (sympy.sinh, sympy.cosh, -1)}
_WAVE_QUOTIENTS = {"tan": (1, -1), "cot": (-1, 1), "sec": (0, -1), "csc": (-1, 0)}  # the exponents of s and c


def _by_others(kernel: Expr, kernels: Sequence[Expr]) -> Expr:
    """A constant in terms of the others, where it depends on them in a known way; else itself."""
    for kind, (sine, cosine, _) in _WAVE_KINDS.items():
        if isinstance(kernel, kind):
            if kind is HyperbolicFunction and any(isinstance(other, sympy.exp) for other in kernels):
                return kernel.rewrite(sympy.exp)
            (argument,) = kernel.args
            ratios = [argument / other.args[0] for other in kernels if isinstance(other, kind) and other != kernel]
            if any(ratio.is_Integer and ratio != 1 for ratio in ratios):
                return sympy.expand_trig(kernel)
            if 1 not in ratios or isinstance(kernel, (sine, cosine)):
                return kernel
            of_sine, of_cosine = _WAVE_QUOTIENTS[kernel.func.__name__.removesuffix("h")]
            return sine(argument) ** of_sine * cosine(argument) ** of_cosine
    is_logarithm = isinstance(kernel, sympy.log)
    base, exponent = (kernel.args[0], 1) if is_logarithm else kernel.as_base_exp()
    if not base.is_Rational:
        return kernel
    factors = sympy.factorrat(base, limit=10**6).items()  # a factor without primes below the limit stays
    if is_logarithm:  # log(12) = 2 log(2) + log(3)
        return sympy.Add(*(k * sympy.log(prime) for prime, k in factors))
    # 12^a = 2^(2 a) 3^a
    return sympy.Mul(*(prime ** (k * exponent) for prime, k in factors))


def _without_squared_waves(part: Expr, kernels: Sequence[Expr]) -> Expr:
    """With 1 - cos^2 in the place of sin^2, where sine and cosine of one argument are among the constants; and with sinh^2."""
    squares = {
        wave: sign * (1 - cosine(*wave.args) ** 2)
        for sine, cosine, sign in _WAVE_KINDS.values()
        for wave in kernels
        if wave.func is sine and cosine(*wave.args) in kernels
    }
    powers = [power for power in part.atoms(sympy.Pow) if power.base in squares and power.exp.is_Integer]
    return part.xreplace({p: p.base ** (p.exp % 2) * squares[p.base] ** (p.exp // 2) for p in powers})
