"""Assumptions about the parameters, and what follows from them for a statement.

A parameter can be known to lie in a class s + m Z ("integer", "odd", "even", "half-integer"), to be rational or irrational, not
an integer, not zero, or a real number with rational bounds ("positive", "negative", ">=1/2").  A conclusion holds at all values
with these properties; None means that nothing follows.

Assumptions are read from words: "positive integer", "noninteger", ">=1/2", "!=1", "<sqrt(2)".
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache, reduce
from itertools import chain, combinations, compress, filterfalse, product
from math import ceil, floor
from random import Random
from typing import Any

from flint import arb, fmpq

from kovacic.algebra.embedding import enclosure
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.errors import InputError
from kovacic.limits import MOST_TRIALS
from kovacic.parametric.claims import (
    EVEN,
    INTEGERS,
    NO_CONSTANT,
    ODD,
    Classes,
    ParameterPoint,
    common_divisor,
    degrees,
    denominator,
    irreducible_factors,
    over_parameters,
    rational_number,
)
from kovacic.reading.read import read_input

_CLASSES = {
    "integer": INTEGERS,
    "even": EVEN,
    "odd": ODD,
    "half-integer": Classes.of([Fraction(1, 2)], 1),
}
#: Words for signs, as the relations that they abbreviate.
INEQUALITIES = {"positive": ">0", "negative": "<0", "nonnegative": ">=0", "nonpositive": "<=0"}
_RELATION_OF_WORD = {"nonzero": "!=0", **INEQUALITIES}
WORDS = (*_CLASSES, "rational", "irrational", "noninteger", "nonzero", *INEQUALITIES)
_RATIONAL = r"[+-]?\d{1,1000}(?:/0*[1-9]\d{0,999})?"
_BOUND = re.compile(rf"(>=|<=|>|<)({_RATIONAL}|[^\s<>=]*[a-z(][^\s<>=]*)")
_UNEQUAL = re.compile(rf"!=({_RATIONAL})")
#: Precision, in bits, at which balls are compared.
COMPARED_BITS = 512
#: SymPy's names for the numbers on one side of 0, without 0 and with it.
_SIGNS = {1: ("positive", "nonnegative"), -1: ("negative", "nonpositive")}
#: What SymPy calls a kind of number; signs follow from the bounds.
_NAMED = {word: (word,) for word in WORDS if word not in INEQUALITIES} | {"half-integer": ("rational", "noninteger")}


@dataclass(frozen=True)
class Bound:
    """`sign * (value - end)` is nonnegative, and positive if the bound is strict.

    An irrational bound such as sqrt(2) is replaced by a weaker rational one nearby.
    """

    sign: int
    end: Fraction
    strict: bool

    def admits(self, number: Fraction) -> bool:
        """True if the number respects the bound."""
        distance = self.sign * (number - self.end)
        return distance > 0 or (distance == 0 and not self.strict)

    def among(self, numbers: Classes) -> Bound:
        """The bound in terms of the nearest number of a single class."""
        (start,) = numbers.residues
        steps = (self.end - start) / numbers.modulus
        nearest = start + (ceil(steps) if self.sign > 0 else floor(steps)) * numbers.modulus
        if self.strict and nearest == self.end:
            nearest += self.sign * numbers.modulus
        return replace(self, end=nearest, strict=False)


@dataclass(frozen=True)
class Known:
    """The assumptions about one parameter: some of `WORDS`, and relations such as ">=1/2"."""

    words: tuple[str, ...] = ()

    @cached_property
    def classes(self) -> tuple[Classes, ...]:
        """The classes that contain it."""
        return tuple(_CLASSES[word] for word in self.words if word in _CLASSES)

    @cached_property
    def coset(self) -> Classes | None:
        """The smallest known class that contains it."""
        return max(self.classes, key=lambda numbers: numbers.modulus, default=None)

    @property
    def rational(self) -> bool | None:
        """True if it is provably rational, False if irrational."""
        if self.classes or "rational" in self.words:
            return True
        return False if "irrational" in self.words else None

    @cached_property
    def excluded(self) -> frozenset[Fraction]:
        """Single numbers that it differs from."""
        return frozenset(Fraction(match[1]) for match in map(_UNEQUAL.fullmatch, self.relations) if match)

    @cached_property
    def relations(self) -> tuple[str, ...]:
        """The words, with those that abbreviate a relation replaced by it."""
        return tuple(_RELATION_OF_WORD.get(word, word) for word in self.words)

    @cached_property
    def inequalities(self) -> tuple[Bound, ...]:
        """All of its bounds."""
        return tuple(map(_stated_bound, filter(_BOUND.fullmatch, self.relations)))

    @cached_property
    def bounds(self) -> tuple[Bound, ...]:
        """The strongest lower and upper bounds; those of a class of numbers are among the numbers."""
        known = [one if self.coset is None else one.among(self.coset) for one in self.inequalities]
        by_strength = sorted(known, key=lambda one: (one.sign * one.end, one.strict))
        return tuple({one.sign: one for one in (*known, *by_strength)}.values())  # the last one of each sign

    def admits_number(self, number: Fraction) -> bool:
        """True unless it provably differs from this rational number."""
        if self.rational is False or number in self.excluded:
            return False
        if number.denominator == 1 and "noninteger" in self.words:
            return False
        is_in_classes = all(numbers.contains(number) for numbers in self.classes)
        return is_in_classes and all(bound.admits(number) for bound in self.inequalities)

    def admits(self, value: Poly) -> bool:
        """True unless it provably has another value.  An algebraic number known up to conjugation has no sign."""
        number = rational_number(value)
        if number is not None:
            return self.admits_number(number)
        if self.rational is True:
            return False
        has_sign = getattr(value.field, "approximation", None) is not None
        return not self.inequalities or not has_sign or self.admits_ball(enclosure(value))

    def admits_ball(self, ball: Any) -> bool:
        """True unless the ball is provably not real, or on the wrong side of a bound."""
        with working_precision(COMPARED_BITS):
            ends = [(one.sign, arb(fmpq(one.end.numerator, one.end.denominator))) for one in self.inequalities]
            is_outside = any(sign * (ball.real - end) < 0 for sign, end in ends)
        return bool(ball.imag.contains(0)) and not is_outside

    def sample(self, random: Random) -> Fraction:
        """A small rational number, in the known class if there is one."""
        if self.coset is not None:
            return self.coset.residues[0] + random.randint(-6, 6) * self.coset.modulus
        denominator = random.choice((1, 1, 2, 2, 3, 4, 5, 6))
        return Fraction(random.randint(-6 * denominator, 6 * denominator), denominator)

    def may_be_among(self, numbers: Classes) -> bool:
        """False if it provably is none of these numbers."""
        if self.rational is False or not all(map(numbers.meet, self.classes)):
            return False
        if "noninteger" in self.words and numbers.are_covered_by(INTEGERS):
            return False
        modulus = numbers.modulus
        periods = {bound.sign: floor(bound.end / modulus) for bound in self.bounds}
        if len(periods) < 2 or periods[-1] - periods[1] > MOST_TRIALS:
            return True
        # The numbers between the bounds.
        tried = product(range(periods[1], periods[-1] + 1), numbers.residues)
        return any(self.admits_number(k * modulus + residue % modulus) for k, residue in tried)

    def is_contradiction(self) -> bool:
        """True if provably no number is left: two kinds of numbers, or bounds, exclude one another."""
        if not all(map(self.may_be_among, self.classes)) or ("irrational" in self.words and self.rational is True):
            return True
        ends = {bound.sign: bound.end for bound in self.bounds}
        if len(ends) == 2 and ends[1] >= ends[-1]:
            return ends[1] > ends[-1] or not self.admits_number(ends[1])
        # x > sqrt(2) and x < sqrt(2), whose rational ends leave room.
        return any(word.replace("<", ">") in self.words for word in self.words if re.match("<[^=]", word))

    def sympy_properties(self) -> list[str]:
        """The properties for which SymPy has names, among them the sign that follows from the bounds."""
        words = [*chain.from_iterable(_NAMED.get(word, ()) for word in self.words)]
        for bound in self.bounds:
            if bound.sign * bound.end >= 0:  # beyond zero
                strict, weak = _SIGNS[bound.sign]
                words.append(strict if bound.strict or bound.end != 0 else weak)
        return words


def words_of(symbol: Any) -> list[str]:
    """SymPy's assumptions on a symbol, without those that others imply: a kind of number, a sign, not 0."""
    kinds = ("odd", "even", "integer", "irrational", "rational")
    words = [kind for kind in kinds if getattr(symbol, f"is_{kind}")][:1]
    if symbol.is_integer is False and "irrational" not in words:
        words.append("noninteger")
    words += [word for word in INEQUALITIES if getattr(symbol, f"is_{word}")][:1]
    if symbol.is_zero is False and Known(tuple(words)).admits_number(Fraction(0)):
        words.append("nonzero")
    return words


def is_relation(word: str) -> bool:
    """True for a relation, such as >=1/2, !=1 and <sqrt(2)."""
    return any(pattern.fullmatch(word) for pattern in (_BOUND, _UNEQUAL))


@lru_cache(maxsize=256)
def _stated_bound(word: str) -> Bound:
    """The bound that a relation states.  Raises `InputError` for an end that isn't a real number, or too large."""
    match = _BOUND.fullmatch(word)
    assert match is not None
    sign = 1 if ">" in word else -1
    if re.fullmatch(_RATIONAL, match[2]):
        return Bound(sign, Fraction(match[2]), strict="=" not in word)
    number = read_input(match[2], var="x_").S
    is_number = number.is_polynomial and number.num.degree == 0 and number.field.ground == QQ
    ball = enclosure(number.num[0]) if is_number else None
    if ball is None or not ball.imag.contains(0):
        raise InputError(f"{match[2]!r} isn't a real number", hint="bounds are numbers, such as 1/2 and sqrt(2)")
    with working_precision(COMPARED_BITS):
        end = (ball.real.lower() if sign > 0 else ball.real.upper()).fmpq()
    return Bound(sign, to_fraction(end), strict=True)


#: Words that stand for others, or for nothing usable.  A natural number may be 0 here: what holds then also holds from 1 on.
_ABBREVIATIONS: dict[str, tuple[str, ...]] = {"natural": ("nonnegative", "integer"), "real": (), "complex": ()}
_NO_BOUND = Bound(1, Fraction(0), False)


@dataclass(frozen=True)
class Assumptions:
    """The assumptions on the parameters by name, and the value of the algebraic constant among the parameters, if any."""

    known: tuple[tuple[str, Known], ...] = ()
    constant: ParameterPoint = NO_CONSTANT

    def __bool__(self) -> bool:
        """True if anything is known."""
        return bool(self.known)

    @property
    def concerns_exponents(self) -> bool:
        return any(known.classes or {"irrational", "noninteger"} & {*known.words} for _, known in self.known)

    def of(self, name: str) -> Known:
        """The assumptions about the parameter of this name."""
        return dict(self.known).get(name, Known())

    def also(self, name: str, words: tuple[str, ...]) -> Assumptions:
        """The assumptions with more words about one parameter."""
        together = dict.fromkeys((*self.of(name).words, *words))
        return replace(self, known=(*self.without([name]).known, (name, Known(tuple(together)))))

    def without(self, names: Iterable[str]) -> Assumptions:
        left_out = {*names}
        return replace(self, known=tuple((name, known) for name, known in self.known if name not in left_out))

    def admits(self, values: Iterable[tuple[str, Poly]]) -> bool:
        return all(self.of(name).admits(value) for name, value in values)

    def to_dict(self) -> dict[str, str]:
        """Words separated by spaces, by name."""
        return {name: " ".join(known.words) for name, known in self.known}

    def __str__(self) -> str:
        """`m positive integer, n > 1/2`."""
        parts: list[str] = []
        for name, known in self.known:  # the words together, and each relation
            said = (" ".join(filterfalse(is_relation, known.words)), *filter(is_relation, known.words))
            parts += [f"{name} " + re.sub("^([<>]=?|!=)", r"\1 ", text) for text in filter(None, said)]
        return ", ".join(parts)

    def symbols(self) -> dict[str, Any]:
        """SymPy symbols with these properties, by name."""
        from sympy import Symbol

        return {name: Symbol(name, **dict.fromkeys(known.sympy_properties(), True)) for name, known in self.known}

    def meets_classes(self, form: FunctionPoly, numbers: Classes) -> bool | None:
        """Whether the value of a form is one of the numbers: True (always), False (never) or None."""
        value = self.value_of(form)
        if value is not None:
            return numbers.has(value)
        values = self._class_of(form)
        if values is not None and values.are_covered_by(numbers):
            return True
        linear = linear_of(form)
        if linear is not None and linear.parameter is not None:
            is_possible = self.of(linear.parameter).may_be_among(linear.solutions(numbers))
        else:
            is_possible = not self.is_irrational(form) and (values is None or values.meet(numbers))
        return None if is_possible else False

    def vanishes(self, function: FunctionPoly) -> bool | None:
        """Whether the function vanishes: True (always), False (never) or None."""
        value = self.value_of(function)
        if value is not None:
            return not value
        return False if all(map(self._is_nonzero, irreducible_factors(function))) else None

    def _is_nonzero(self, factor: FunctionPoly) -> bool:
        """True if an irreducible polynomial provably vanishes nowhere."""
        linear = linear_of(factor)
        if linear is not None and linear.parameter is not None:
            (root,) = linear.solutions(INTEGERS).residues  # where the value is 0
            return not self.of(linear.parameter).admits_number(root)
        values = self._class_of(factor)
        if self.is_irrational(factor) or (values is not None and not values.contains(Fraction(0))):
            return True
        return self.is_positive(factor) or self.is_positive(-factor)

    def value_of(self, function: FunctionPoly) -> Poly | None:
        """The value of a function of the parameters that have a value; None for any other."""
        fixed = dict(zip(self.constant.names, self.constant.values, strict=True))
        if not {*parameters_in(function), *parameters_in(denominator(function))} <= fixed.keys():
            return None
        return function.value_at([fixed.get(name, 0) for name in function.field.names], self.constant.field)

    def is_positive(self, form: FunctionPoly, *, or_zero: bool = False) -> bool:
        """True if a polynomial is provably positive, or nonnegative, everywhere.

        With t = end + sign s, s >= 0, for one bound of each parameter t, no coefficient is negative.
        """
        if not form.den.is_constant():
            return False
        used = parameters_in(form)
        choices = (self.of(name).bounds if name in used else (_NO_BOUND,) for name in form.field.names)
        return any(_is_positive_beyond(bounds, form, or_zero=or_zero) for bounds in product(*choices))

    def _class_of(self, form: FunctionPoly) -> Classes | None:
        """A class that contains all values of a function that isn't a number; None if no class is known."""
        known = {name: self.of(name).coset for name in parameters_in(form)}
        classes = {name: numbers for name, numbers in known.items() if numbers is not None}
        if len(classes) < len(known):
            return None
        linear = linear_of(form)
        if linear is not None:
            return linear.values(classes)
        are_integers = all(numbers.are_covered_by(INTEGERS) for numbers in classes.values())
        return INTEGERS if are_integers and form.den.is_one() else None

    def is_irrational(self, form: FunctionPoly) -> bool:
        """True for a linear form in which one parameter is irrational and the others are rational."""
        linear = linear_of(form)
        if linear is None:
            return False
        kinds = [self.of(name).rational for name in linear.factors]
        return kinds.count(False) == 1 and None not in kinds


NOTHING_ASSUMED = Assumptions()


@dataclass(frozen=True)
class LinearCombination:
    """constant + the sum of factor * parameter, by the parameter's name, with rational numbers."""

    constant: Fraction
    factors: Mapping[str, Fraction]

    @property
    def parameter(self) -> str | None:
        """The name of the only parameter; None if there are several, or none."""
        return next(iter(self.factors)) if len(self.factors) == 1 else None

    def values(self, known: Mapping[str, Classes]) -> Classes:
        """A class that contains the values, for at least one parameter, each in a single class."""
        start = self.constant + sum(factor * known[name].residues[0] for name, factor in self.factors.items())
        steps = [abs(factor) * known[name].modulus for name, factor in self.factors.items()]
        return Classes((start,), reduce(common_divisor, steps))

    def solutions(self, values: Classes) -> Classes:
        """The values of the only parameter where the form has one of these."""
        (factor,) = self.factors.values()
        residues = tuple((residue - self.constant) / factor for residue in values.residues)
        return Classes(residues, values.modulus / abs(factor))


def linear_of(form: FunctionPoly) -> LinearCombination | None:
    """An element of Q(t) as a linear form; None for anything else."""
    if not form.den.is_constant() or form.num.total_degree() > 1:
        return None
    den = int(form.den.leading_coefficient())
    terms = form.num.to_dict().items()
    factors = {next(compress(form.field.names, powers[1:]), ""): Fraction(int(c), den) for powers, c in terms}
    return LinearCombination(factors.pop("", Fraction(0)), factors)


def parameters_in(form: FunctionPoly) -> list[str]:
    """The parameters in the numerator."""
    return [name for name, k in zip(form.field.names, degrees(form), strict=True) if k]


def read_assumptions(assume: Mapping[Any, str] | None, S: Any, names: tuple[str, ...]) -> Assumptions:
    """From `{"n": "positive integer"}`, and from the assumptions on the SymPy symbols in S.

    Raises `InputError` for a name that isn't a parameter, a word that isn't one of `WORDS` ("real" and "complex" are accepted
    and not used), and for assumptions that contradict one another.
    """
    check_mapping(assume)
    words: dict[str, list[str]] = {name: [] for name in names}
    words |= {symbol.name: words_of(symbol) for symbol in getattr(S, "free_symbols", ()) if symbol.name in words}
    for key, what in (assume or {}).items():
        name = str(key)
        if name not in names:
            hint = f"the parameters are {', '.join(names) or 'none'}"
            raise InputError(f"{name} isn't a parameter of the equation", hint=hint)
        words[name] += _read_words(what)
    known = [(name, Known(tuple(dict.fromkeys(said)))) for name, said in words.items()]
    for name, facts in known:
        if facts.is_contradiction():
            pairs = (pair for pair in combinations(facts.words, 2) if Known(pair).is_contradiction())
            both = " and ".join(next(pairs, facts.words))
            raise InputError(f"the assumptions on {name} contradict one another: {both}", hint="leave one of them out")
    return Assumptions(tuple((name, facts) for name, facts in known if facts.words))


def check_mapping(assume: object) -> None:
    """Raises `InputError` unless assumptions are a mapping."""
    if assume is not None and not isinstance(assume, Mapping):
        raise InputError(f"assumptions are a mapping, not {assume!r}", hint='assume={"n": "integer"}')


def check_values(given: Mapping[str, Any], names: tuple[str, ...]) -> None:
    """Raises `InputError` unless values are given for exactly these parameters."""
    wanted = {*names}
    if given.keys() != wanted:
        differences = (wanted - given.keys(), given.keys() - wanted)
        missing, unknown = (", ".join(sorted(several)) or "none" for several in differences)
        hint = f"missing: {missing}; unknown: {unknown}"
        raise InputError(f"values are needed for {', '.join(names) or 'no parameter'}", hint=hint)


def _read_words(what: object) -> list[str]:
    """The words of an assumption.  Raises `InputError` for unknown ones, and for bounds that aren't real numbers."""
    text = re.sub(r"([<>]=?|!=)\s+", r"\1", str(what))
    text = re.sub(r"!=0(?![\d/])", "nonzero", text)
    given = text.replace(",", " ").split()
    words = [*chain.from_iterable(_ABBREVIATIONS.get(word, (word,)) for word in given)]
    unknown = [word for word in words if word not in WORDS and not is_relation(word)]
    if unknown or not given:
        hint = f"known are {', '.join((*_ABBREVIATIONS, *WORDS))}, >=1/2, !=1, a value"
        raise InputError(f"{' '.join(unknown) or what!r} isn't a known assumption", hint=hint)
    for word in filter(_BOUND.fullmatch, words):
        _stated_bound(word)
    return words


def _is_positive_beyond(bounds: Sequence[Bound], form: FunctionPoly, *, or_zero: bool) -> bool:
    """True if no coefficient is negative in the s with t = end + sign s, and one monomial is positive."""
    field = form.field
    values = [field.generator(name) * one.sign + one.end for name, one in zip(field.names, bounds, strict=True)]
    terms = over_parameters(form.value_at(values, field)).num.to_dict()
    if any(coefficient < 0 for coefficient in terms.values()):
        return False
    # A monomial is positive where each of its parameters is strictly beyond the bound.
    are_positive = (all(bound.strict for bound, k in zip(bounds, powers[1:], strict=True) if k) for powers in terms)
    return or_zero or any(are_positive)
