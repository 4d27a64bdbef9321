"""What words about one parameter say, read once: "positive integer", "noninteger", ">=1/2", "!=1", "<sqrt(2)".

A class of numbers is a `Coset` s + m Z.  A bound is a `Bound`, with a rational end, or a `RealBound`, whose end is a ball.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations
from math import ceil, floor
from typing import Any

from flint import arb, fmpq

from kovacic.algebra.embedding import enclosure
from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError
from kovacic.parametric.functions import Coset
from kovacic.reading.read import read_input

INTEGERS = Coset(Fraction(0), Fraction(1))
_CLASSES = {
    "integer": INTEGERS,
    "even": Coset(Fraction(0), Fraction(2)),
    "odd": Coset(Fraction(1), Fraction(2)),
    "half-integer": Coset(Fraction(1, 2), Fraction(1)),
}
#: Words for signs, as the relations that they abbreviate.
INEQUALITIES = {"positive": ">0", "negative": "<0", "nonnegative": ">=0", "nonpositive": "<=0"}
WORDS = (*_CLASSES, "rational", "irrational", "noninteger", "nonzero", *INEQUALITIES)
_RATIONAL = r"[+-]?\d{1,1000}(?:/0*[1-9]\d{0,999})?"
_BOUND = re.compile(rf"(>=|<=|>|<)({_RATIONAL})")
_UNEQUAL = re.compile(rf"!=({_RATIONAL})")
#: A bound that is no rational number: sqrt(2).
_ALGEBRAIC = re.compile(r"(>=|<=|>|<)([^\s<>=]*[a-z(][^\s<>=]*)")
#: Bits of a rational bound beside one that isn't.
_BITS = 64
#: Bits of the balls that are compared.
_PRECISION = 512


@dataclass(frozen=True)
class Bound:
    """`sign * (value - end)` isn't negative, nor zero where the bound is strict."""

    sign: int
    end: Fraction
    strict: bool

    def admits(self, number: Fraction) -> bool:
        """Does a number have this bound?"""
        distance = self.sign * (number - self.end)
        if distance == 0:
            return not self.strict
        return distance > 0

    def is_stronger_than(self, other: Bound) -> bool:
        """For two lower bounds, or two upper ones; the same isn't stronger, unless both are strict."""
        distance = self.sign * (self.end - other.end)
        if distance == 0:
            return self.strict
        return distance > 0

    def among(self, numbers: Coset) -> Bound:
        """The same bound for numbers of a class, by the nearest of them."""
        steps = (self.end - numbers.start) / numbers.step
        whole = ceil(steps) if self.sign > 0 else floor(steps)
        nearest = numbers.start + whole * numbers.step
        if self.strict and nearest == self.end:
            nearest += self.sign * numbers.step
        return Bound(self.sign, nearest, strict=False)


@dataclass(frozen=True)
class RealBound:
    """A bound, rational or not: the numbers lie on this side, 1 above and -1 below, of a real number, a ball."""

    sign: int
    ball: Any

    def excludes(self, value: Any) -> bool:
        """Does a ball provably lie on the wrong side?"""
        with working_precision(_PRECISION):
            return bool((value - self.ball) * self.sign < 0)

    def rational_bound(self) -> Bound:
        """A weaker bound that is rational.  Raises `InputError` for an end that is too large."""
        with working_precision(_PRECISION):
            scaled = self.ball * 2**_BITS
            steps = scaled.floor() if self.sign > 0 else scaled.ceil()
            whole = (steps - self.sign).unique_fmpz()
        if whole is None:
            raise InputError("a bound is too large to be compared with")
        return Bound(self.sign, Fraction(int(whole), 2**_BITS), strict=True)


@dataclass(frozen=True)
class Facts:
    """What the words say; all of it holds."""

    #: The classes that contain the parameter.
    classes: tuple[Coset, ...]
    #: Is it known to be rational, True, or irrational, False?
    rational: bool | None
    #: Is it said not to be an integer?
    noninteger: bool
    #: Single numbers that it isn't, 0 for `nonzero`.
    excluded: frozenset[Fraction]
    rational_bounds: tuple[Bound, ...]
    #: The bounds that aren't rational.
    ends: tuple[RealBound, ...]

    @property
    def coset(self) -> Coset | None:
        """The smallest class that contains the parameter."""
        return max(self.classes, key=lambda coset: coset.step, default=None)

    @cached_property
    def bounds(self) -> tuple[Bound, ...]:
        """The strongest lower and upper bounds; those of a class of numbers are among the numbers."""
        strongest: dict[int, Bound] = {}
        coset = self.coset
        for one in (*self.rational_bounds, *(end.rational_bound() for end in self.ends)):
            bound = one if coset is None else one.among(coset)
            known = strongest.get(bound.sign)
            if known is None or bound.is_stronger_than(known):
                strongest[bound.sign] = bound
        return tuple(strongest.values())

    def admit(self, number: Fraction) -> bool:
        """May the parameter be this number?"""
        if self.rational is False or number in self.excluded:
            return False
        if self.noninteger and number.denominator == 1:
            return False
        if not all(coset.contains(number) for coset in self.classes):
            return False
        ball = ball_of(number)
        if any(end.excludes(ball) for end in self.ends):
            return False
        return all(bound.admits(number) for bound in self.bounds)

    def admit_real(self, ball: Any) -> bool:
        """May the parameter be a number in a complex ball, by the bounds?"""
        if not ball.imag.contains(0):
            return False
        ends = [RealBound(bound.sign, ball_of(bound.end)) for bound in self.bounds]
        return not any(end.excludes(ball.real) for end in (*ends, *self.ends))


#: Numbers of a class between two bounds that are tried one by one.
_TRIED = 1000


def contradict(words: tuple[str, ...]) -> bool:
    """True if no number is provably left: two kinds of numbers, or bounds, that exclude one another."""
    facts = read_facts(words)
    if "irrational" in words and facts.rational is True:
        return True
    if facts.noninteger and any(coset.is_covered_by([INTEGERS]) for coset in facts.classes):
        return True
    if not all(first.meets(second) for first, second in combinations(facts.classes, 2)):
        return True
    by_sign = {bound.sign: bound.end for bound in facts.bounds}
    if len(by_sign) < 2:
        return False
    return _is_nothing_between(facts, by_sign[1], by_sign[-1], words)


def _is_nothing_between(facts: Facts, low: Fraction, high: Fraction, words: tuple[str, ...]) -> bool:
    """True if no number between two bounds is admitted: none at all, the only one isn't, or none of a class."""
    if low >= high:
        return low > high or not facts.admit(low)
    lower, upper = ({word[1:] for word in words if word.startswith(sign)} for sign in "><")
    if lower & upper - {word for word in lower if word.startswith("=")}:
        return True
    coset = facts.coset
    steps = 0 if coset is None else (high - low) / coset.step
    if coset is None or steps > _TRIED:
        return False
    return not any(facts.admit(low + k * coset.step) for k in range(int(steps) + 1))


@lru_cache(maxsize=256)
def read_facts(words: tuple[str, ...]) -> Facts:
    """What words say that `check_words` let pass."""
    classes = tuple(_CLASSES[word] for word in words if word in _CLASSES)
    inequalities = [INEQUALITIES.get(word, word) for word in words]
    rational = True if classes or "rational" in words else None
    if rational is None and "irrational" in words:
        rational = False
    excluded = {Fraction(match[1]) for match in _matches(_UNEQUAL, words)}
    if "nonzero" in words:
        excluded.add(Fraction(0))
    return Facts(
        classes=classes,
        rational=rational,
        noninteger="noninteger" in words,
        excluded=frozenset(excluded),
        rational_bounds=tuple(
            Bound(_direction(match[1]), Fraction(match[2]), strict="=" not in match[1])
            for match in _matches(_BOUND, inequalities)
        ),
        ends=tuple(_ends(words)),
    )


def check_words(words: Iterable[str]) -> None:
    """Raises `InputError` for bounds that aren't real numbers."""
    _ends(words)


def is_relation(word: str) -> bool:
    """Is it a relation, as >=1/2, !=1 and <sqrt(2)?"""
    return any(pattern.fullmatch(word) for pattern in (_BOUND, _UNEQUAL, _ALGEBRAIC))


def _matches(pattern: re.Pattern[str], words: Iterable[str]) -> list[re.Match[str]]:
    """Those of the words that have a form."""
    return [match for match in map(pattern.fullmatch, words) if match is not None]


def _ends(words: Iterable[str]) -> list[RealBound]:
    """The bounds among the words that aren't rational."""
    return [RealBound(_direction(match[1]), _real_number(match[2])) for match in _matches(_ALGEBRAIC, words)]


def _direction(relation: str) -> int:
    return 1 if ">" in relation else -1


@lru_cache(maxsize=256)
def _real_number(text: str) -> Any:
    """A ball with the real number that a text denotes.  Raises `InputError` for any other text."""
    number = read_input(text, var="x_").S
    is_constant = number.num.degree <= 0 and number.den.degree <= 0
    if is_constant and number and number.field.ground == QQ:
        ball = enclosure(number.num[0] / number.den[0])
        if ball.imag.contains(0):
            return ball.real
    raise InputError(f"{text!r} isn't a real number", hint="bounds are numbers, such as 1/2 and sqrt(2)")


def ball_of(number: Fraction) -> Any:
    """A ball with a rational number, to compare with others."""
    with working_precision(_PRECISION):
        return arb(fmpq(number.numerator, number.denominator))
