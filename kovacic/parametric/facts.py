"""What is known about one parameter, read from words: "positive integer", "noninteger", ">=1/2", "!=1", "<sqrt(2)"."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations
from math import ceil, floor
from random import Random
from typing import Any

from flint import arb, fmpq

from kovacic.algebra.embedding import enclosure
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError
from kovacic.parametric.functions import INTEGERS, Classes
from kovacic.reading.read import read_input

_CLASSES = {
    "integer": INTEGERS,
    "even": Classes.of([0], 2),
    "odd": Classes.of([1], 2),
    "half-integer": Classes.of([Fraction(1, 2)], 1),
}
#: Words for signs, as the relations that they abbreviate.
INEQUALITIES = {"positive": ">0", "negative": "<0", "nonnegative": ">=0", "nonpositive": "<=0"}
WORDS = (*_CLASSES, "rational", "irrational", "noninteger", "nonzero", *INEQUALITIES)
_RATIONAL = r"[+-]?\d{1,1000}(?:/0*[1-9]\d{0,999})?"
_BOUND = re.compile(rf"(>=|<=|>|<)({_RATIONAL}|[^\s<>=]*[a-z(][^\s<>=]*)")
_UNEQUAL = re.compile(rf"!=({_RATIONAL})")
#: Bits of a rational number in the place of an end that isn't one.
_BITS = 64
#: Bits of the balls that are compared.
_PRECISION = 512
#: Numbers of a class between two bounds that are tried one by one.
_TRIED = 1000
_DENOMINATORS = (1, 1, 2, 2, 3, 4, 5, 6)
#: What SymPy calls numbers that aren't 0, and others, on a side of it.
_SIGNS = {1: ("positive", "nonnegative"), -1: ("negative", "nonpositive")}
#: The words that are names of SymPy's, too, without those for a sign, which bounds say.
_NAMED = {*WORDS} - {*INEQUALITIES, "half-integer"}


@dataclass(frozen=True)
class Bound:
    """`sign * (value - end)` isn't negative, nor zero where the bound is strict.

    For an end that isn't rational, sqrt(2), the bound is that at the real number in the `ball`, and `end` a rational number
    on its other side, nearby.
    """

    sign: int
    end: Fraction
    strict: bool
    ball: Any = field(default=None, compare=False)

    def admits(self, number: Fraction) -> bool:
        """True unless a number is provably beyond the bound."""
        if self.ball is not None and self.excludes(_ball_of(number)):
            return False
        distance = self.sign * (number - self.end)
        return distance > 0 or (distance == 0 and not self.strict)

    def excludes(self, value: Any) -> bool:
        """Does a real ball provably lie on the wrong side?"""
        with working_precision(_PRECISION):
            end = _ball_of(self.end) if self.ball is None else self.ball
            return bool((value - end) * self.sign < 0)

    def is_stronger_than(self, other: Bound) -> bool:
        """For two lower bounds, or two upper ones; the same isn't stronger, unless both are strict."""
        distance = self.sign * (self.end - other.end)
        return distance > 0 or (distance == 0 and self.strict)

    def among(self, numbers: Classes) -> Bound:
        """The same bound for numbers of a single class, by the nearest of them."""
        (start,) = numbers.residues
        steps = (self.end - start) / numbers.modulus
        nearest = start + (ceil(steps) if self.sign > 0 else floor(steps)) * numbers.modulus
        if self.strict and nearest == self.end:
            nearest += self.sign * numbers.modulus
        return replace(self, end=nearest, strict=False)


@dataclass(frozen=True)
class Known:
    """What is known about one parameter: some of `WORDS`, and inequalities such as ">=1/2"; all of it holds."""

    words: tuple[str, ...] = ()

    @cached_property
    def classes(self) -> tuple[Classes, ...]:
        """Those that contain it."""
        return tuple(_CLASSES[word] for word in self.words if word in _CLASSES)

    @property
    def coset(self) -> Classes | None:
        """The smallest known class that contains it."""
        return max(self.classes, key=lambda numbers: numbers.modulus, default=None)

    @property
    def rational(self) -> bool | None:
        """Is it known to be rational, True, or irrational, False?"""
        if self.classes or "rational" in self.words:
            return True
        return False if "irrational" in self.words else None

    @property
    def noninteger(self) -> bool:
        return "noninteger" in self.words

    @cached_property
    def excluded(self) -> frozenset[Fraction]:
        """Single numbers that it isn't."""
        found = {Fraction(match[1]) for match in map(_UNEQUAL.fullmatch, self.words) if match}
        return frozenset(found | {Fraction(0)} if "nonzero" in self.words else found)

    @property
    def inequalities(self) -> tuple[Bound, ...]:
        """All of its bounds, which aren't kept here: balls can't be pickled."""
        relations = [INEQUALITIES.get(word, word) for word in self.words]
        return tuple(_bound(word) for word in relations if _BOUND.fullmatch(word))

    @property
    def bounds(self) -> tuple[Bound, ...]:
        """The strongest lower and upper bounds; those of a class of numbers are among the numbers."""
        strongest: dict[int, Bound] = {}
        for one in self.inequalities:
            bound = one if self.coset is None else one.among(self.coset)
            known = strongest.get(bound.sign)
            if known is None or bound.is_stronger_than(known):
                strongest[bound.sign] = bound
        return tuple(strongest.values())

    @property
    def concerns_exponents(self) -> bool:
        return bool(self.classes) or self.rational is False or self.noninteger

    @property
    def nonzero(self) -> bool:
        return not self.admits_number(Fraction(0))

    def admits_number(self, number: Fraction) -> bool:
        """May it be this rational number?"""
        if self.rational is False or number in self.excluded or (self.noninteger and number.denominator == 1):
            return False
        is_in_classes = all(numbers.contains(number) for numbers in self.classes)
        return is_in_classes and all(bound.admits(number) for bound in (*self.inequalities, *self.bounds))

    def admits(self, value: Poly) -> bool:
        """May it have this value?  An algebraic number of which any conjugate may be meant has no sign."""
        number = value.field.rational_value(value)
        if number is not None:
            return self.admits_number(number)
        if self.rational is True:
            return False
        has_sign = getattr(value.field, "approximation", None) is not None
        return not self.inequalities or not has_sign or self.admits_ball(enclosure(value))

    def admits_ball(self, ball: Any) -> bool:
        return bool(ball.imag.contains(0)) and not any(bound.excludes(ball.real) for bound in self.inequalities)

    def sample(self, random: Random) -> Fraction:
        """A small rational number, in the known class if there is one."""
        if self.coset is not None:
            return self.coset.residues[0] + random.randint(-6, 6) * self.coset.modulus
        denominator = random.choice(_DENOMINATORS)
        return Fraction(random.randint(-6 * denominator, 6 * denominator), denominator)

    def is_contradiction(self) -> bool:
        """True if no number is provably left: two kinds of numbers, or bounds, that exclude one another."""
        if "irrational" in self.words and self.rational is True:
            return True
        if self.noninteger and any(numbers.are_covered_by(INTEGERS) for numbers in self.classes):
            return True
        if not all(first.meet(second) for first, second in combinations(self.classes, 2)):
            return True
        ends = {bound.sign: bound.end for bound in self.bounds}
        if len(ends) < 2:
            return False
        low, high = ends[1], ends[-1]
        if low >= high:
            return low > high or not self.admits_number(low)
        # x > sqrt(2) and x < sqrt(2), whose rational ends leave room
        lower, upper = ({word[1:] for word in self.words if word.startswith(sign)} for sign in "><")
        if lower & upper - {word for word in lower if word.startswith("=")}:
            return True
        steps = 0 if self.coset is None else (high - low) / self.coset.modulus
        if self.coset is None or steps > _TRIED:
            return False
        return not any(self.admits_number(low + k * self.coset.modulus) for k in range(int(steps) + 1))

    def sympy_properties(self) -> list[str]:
        """What SymPy has names for; of bounds, what they say of the sign."""
        words = [word for word in self.words if word in _NAMED]
        if "half-integer" in self.words:
            words += ["rational", "noninteger"]
        for bound in self.bounds:
            is_beyond_zero = bound.sign * bound.end >= 0
            if is_beyond_zero:
                strict, weak = _SIGNS[bound.sign]
                words.append(strict if bound.strict or bound.end != 0 else weak)
        return words


def words_of(symbol: Any) -> list[str]:
    """What SymPy knows of a symbol, without what follows from the rest: a kind of number, a sign, and that it isn't 0."""
    kinds = (kind for kind in ("odd", "even", "integer", "irrational") if getattr(symbol, f"is_{kind}"))
    words = [*kinds][:1]
    if not words and symbol.is_rational:
        words.append("rational")
    if symbol.is_integer is False and "irrational" not in words:
        words.append("noninteger")
    words += [word for word in INEQUALITIES if getattr(symbol, f"is_{word}")][:1]
    if symbol.is_zero is False and not Known(tuple(words)).nonzero:
        words.append("nonzero")
    return words


def check_words(words: Iterable[str]) -> None:
    """Raises `InputError` for bounds that aren't real numbers."""
    for word in filter(_BOUND.fullmatch, words):
        _bound(word)


def is_relation(word: str) -> bool:
    """Is it a relation, as >=1/2, !=1 and <sqrt(2)?"""
    return any(pattern.fullmatch(word) for pattern in (_BOUND, _UNEQUAL))


@lru_cache(maxsize=256)
def _bound(word: str) -> Bound:
    """What a relation says.  Raises `InputError` for an end that isn't a real number, or too large."""
    match = _BOUND.fullmatch(word)
    assert match is not None
    sign = 1 if ">" in word else -1
    if re.fullmatch(_RATIONAL, match[2]):
        return Bound(sign, Fraction(match[2]), strict="=" not in word)
    number = read_input(match[2], var="x_").S
    is_constant = number.num.degree <= 0 and number.den.degree <= 0
    ball = enclosure(number.num[0] / number.den[0]) if is_constant and number and number.field.ground == QQ else None
    if ball is None or not ball.imag.contains(0):
        raise InputError(f"{match[2]!r} isn't a real number", hint="bounds are numbers, such as 1/2 and sqrt(2)")
    with working_precision(_PRECISION):
        scaled = ball.real * 2**_BITS
        steps = scaled.floor() if sign > 0 else scaled.ceil()
        whole = (steps - sign).unique_fmpz()
    if whole is None:
        raise InputError("a bound is too large to be compared with")
    return Bound(sign, Fraction(int(whole), 2**_BITS), strict=True, ball=ball.real)


def _ball_of(number: Fraction) -> Any:
    """A ball with a rational number, to compare with others."""
    with working_precision(_PRECISION):
        return arb(fmpq(number.numerator, number.denominator))
