"""What is known about the parameters, and what follows from it for a statement about them.

A parameter can be known to lie in a class s + m Z ("integer", "odd", "even", "half-integer"), to be rational or irrational, not
an integer, not zero, or a real number with rational bounds ("positive", "negative", ">=1/2").  A conclusion holds at all values
with these properties; None where none follows.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, reduce
from itertools import product
from math import ceil, floor
from random import Random
from typing import Any

from flint import arb, ctx, fmpq

from kovacic.algebra.embedding import enclosure
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError
from kovacic.parametric.functions import Coset, common_divisor, degrees, element, numerator, over_parameters
from kovacic.reading.read import read_input

_DENOMINATORS = (1, 1, 2, 2, 3, 4, 5, 6)
_INTEGERS = Coset(Fraction(0), Fraction(1))
_COSETS = {
    "integer": _INTEGERS,
    "even": Coset(Fraction(0), Fraction(2)),
    "odd": Coset(Fraction(1), Fraction(2)),
    "half-integer": Coset(Fraction(1, 2), Fraction(1)),
}
_INEQUALITIES = {"positive": ">0", "negative": "<0", "nonnegative": ">=0", "nonpositive": "<=0"}
#: What SymPy calls numbers that aren't 0, and others, on a side of it.
_SIGNS = {1: ("positive", "nonnegative"), -1: ("negative", "nonpositive")}
#: Words that are taken, and not used.
_SAY_NOTHING = ("real", "complex")
WORDS = (*_COSETS, "rational", "irrational", "noninteger", "nonzero", *_INEQUALITIES)
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
        distance = self.sign * (number - self.end)
        return distance > 0 or (distance == 0 and not self.strict)

    def is_stronger_than(self, other: Bound) -> bool:
        """For two lower bounds, or two upper ones; the same isn't stronger, unless both are strict."""
        distance = self.sign * (self.end - other.end)
        return distance > 0 or (distance == 0 and self.strict)


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


def _matches(pattern: re.Pattern[str], words: Iterable[str]) -> list[re.Match[str]]:
    """Those of the words that have a form."""
    return [match for match in map(pattern.fullmatch, words) if match is not None]


@dataclass(frozen=True)
class _End:
    """A bound, rational or not: the numbers lie on this side, 1 above and -1 below, of a real number, a ball."""

    sign: int
    ball: Any

    def excludes(self, value: Any) -> bool:
        """Does a ball provably lie on the wrong side?"""
        with ctx.workprec(_PRECISION):
            return bool((value - self.ball) * self.sign < 0)

    def rational_bound(self) -> Bound:
        """A weaker bound that is rational."""
        with ctx.workprec(_PRECISION):
            scaled = self.ball * 2**_BITS
            steps = scaled.floor() if self.sign > 0 else scaled.ceil()
            whole = (steps - self.sign).unique_fmpz()
        if whole is None:
            raise InputError("a bound is too large to be compared with")
        return Bound(self.sign, Fraction(int(whole), 2**_BITS), strict=True)


def _ends(words: Iterable[str]) -> list[_End]:
    """The bounds among the words that aren't rational."""
    return [_End(_direction(match[1]), _real_number(match[2])) for match in _matches(_ALGEBRAIC, words)]


def _direction(relation: str) -> int:
    return 1 if ">" in relation else -1


_NO_BOUND = Bound(1, Fraction(0), False)


@dataclass(frozen=True)
class Known:
    """What is known about one parameter: some of `WORDS`, and inequalities such as ">=1/2"."""

    words: tuple[str, ...] = ()

    @property
    def coset(self) -> Coset | None:
        """The smallest known class that contains it."""
        return max(self._cosets, key=lambda coset: coset.step, default=None)

    @property
    def _cosets(self) -> list[Coset]:
        return [_COSETS[word] for word in self.words if word in _COSETS]

    @property
    def rational(self) -> bool | None:
        """Is it known to be rational, True, or irrational, False?"""
        if self.coset or "rational" in self.words:
            return True
        return False if "irrational" in self.words else None

    @property
    def concerns_exponents(self) -> bool:
        """Is anything known beside signs?"""
        if self.coset is not None or self.rational is False:
            return True
        return "noninteger" in self.words

    @property
    def bounds(self) -> list[Bound]:
        """The strongest lower and upper bounds; those of a class of numbers are among the numbers."""
        found: dict[int, Bound] = {}
        for bound in self._each_bound():
            if self.coset is not None:
                bound = _among(bound, self.coset)
            known = found.get(bound.sign)
            if known is None or bound.is_stronger_than(known):
                found[bound.sign] = bound
        return [*found.values()]

    def _each_bound(self) -> Iterator[Bound]:
        """What each word says; for one that isn't rational, a weaker one."""
        inequalities = [_INEQUALITIES.get(word, word) for word in self.words]
        for match in _matches(_BOUND, inequalities):
            yield Bound(_direction(match[1]), Fraction(match[2]), strict="=" not in match[1])
        for end in _ends(self.words):
            yield end.rational_bound()

    @property
    def nonzero(self) -> bool:
        return "nonzero" in self.words or not self._admits(Fraction(0))

    def admits(self, value: Poly) -> bool:
        """May the parameter have this value?  An algebraic number of which any conjugate may be meant has no sign."""
        number = value.field.rational_value(value)
        if number is not None:
            return self._admits(number) and (number != 0 or "nonzero" not in self.words)
        if self.rational is True:
            return False
        has_sign = getattr(value.field, "approximation", None) is not None
        if not self.bounds or not has_sign:
            return True
        return self._admits_irrational(enclosure(value))

    def _admits_irrational(self, ball: Any) -> bool:
        """May it be a number in the ball, by the bounds?"""
        if not ball.imag.contains(0):
            return False
        ends = [_End(bound.sign, _ball(bound.end)) for bound in self.bounds]
        ends += _ends(self.words)
        return not any(end.excludes(ball.real) for end in ends)

    def _admits(self, number: Fraction) -> bool:
        """May it be this number, 0 apart?"""
        if self.rational is False:
            return False
        if not all(coset.contains(number) for coset in self._cosets):
            return False
        if "noninteger" in self.words and number.denominator == 1:
            return False
        excluded = [Fraction(match[1]) for match in _matches(_UNEQUAL, self.words)]
        if number in excluded:
            return False
        ball = _ball(number)
        if any(end.excludes(ball) for end in _ends(self.words)):
            return False
        return all(bound.admits(number) for bound in self.bounds)

    def sample(self, random: Random) -> Fraction:
        """A small rational number, in the known class if there is one."""
        if self.coset is not None:
            return self.coset.start + random.randint(-6, 6) * self.coset.step
        denominator = random.choice(_DENOMINATORS)
        return Fraction(random.randint(-6 * denominator, 6 * denominator), denominator)


def _among(bound: Bound, coset: Coset) -> Bound:
    """The same bound for numbers of a class, by the nearest of them."""
    steps = (bound.end - coset.start) / coset.step
    whole = ceil(steps) if bound.sign > 0 else floor(steps)
    nearest = coset.start + whole * coset.step
    if bound.strict and nearest == bound.end:
        nearest += bound.sign * coset.step
    return Bound(bound.sign, nearest, strict=False)


def _ball(number: Fraction) -> Any:
    with ctx.workprec(_PRECISION):
        return arb(fmpq(number.numerator, number.denominator))


def _is_relation(word: str) -> bool:
    return any(pattern.fullmatch(word) for pattern in (_BOUND, _UNEQUAL, _ALGEBRAIC))


@dataclass(frozen=True)
class Assumptions:
    """What is known about the parameters, by name, and those that have a value (constants of one field)."""

    known: tuple[tuple[str, Known], ...] = ()
    values: tuple[tuple[str, Poly], ...] = ()

    def __bool__(self) -> bool:
        return bool(self.known)

    @property
    def concerns_exponents(self) -> bool:
        """Is anything known beside signs?"""
        return any(known.concerns_exponents for _, known in self.known)

    def of(self, name: str) -> Known:
        return dict(self.known).get(name, Known())

    def is_integer(self, name: str) -> bool:
        """Is it known to be one?"""
        coset = self.of(name).coset
        return coset is not None and coset.is_covered_by([_INTEGERS])

    def also(self, name: str, words: tuple[str, ...]) -> Assumptions:
        """The same with more words about one parameter."""
        together = dict.fromkeys((*self.of(name).words, *words))
        others = tuple((other, known) for other, known in self.known if other != name)
        return replace(self, known=(*others, (name, Known(tuple(together)))))

    def admits(self, values: Iterable[tuple[str, Poly]]) -> bool:
        return all(self.of(name).admits(value) for name, value in values)

    def to_dict(self) -> dict[str, str]:
        """Words separated by spaces, by name."""
        return {name: " ".join(known.words) for name, known in self.known}

    def __str__(self) -> str:
        parts = []
        for name, known in self.known:
            words = [word for word in known.words if not _is_relation(word)]
            relations = [word for word in known.words if _is_relation(word)]
            if words:
                parts.append(f"{name} {' '.join(words)}")
            parts += [re.sub("^([<>]=?|!=)", rf"{name} \1 ", word) for word in relations]
        return ", ".join(parts)

    def symbols(self) -> dict[str, Any]:
        """SymPy's symbols with these properties, by name.  Raises `InputError` for properties that exclude each other."""
        from sympy import Symbol
        from sympy.core.facts import InconsistentAssumptions

        found = {}
        for name, known in self.known:
            try:
                found[name] = Symbol(name, **dict.fromkeys(_sympy_properties(known), True))
            except InconsistentAssumptions:
                raise InputError(f"the assumptions on {name} contradict one another: {' '.join(known.words)}") from None
        return found

    def meets_classes(self, form: FunctionPoly, classes: list[Coset]) -> bool | None:
        """Is the value of a form rational and in one of the classes: True (always), False (never) or None?"""
        value = self._value_of(form)
        if value is not None:
            return _is_in_one(value, classes)
        values = self._coset_of(form)
        if values is not None:
            if values.is_covered_by(classes):
                return True
            return None if any(values.meets(coset) for coset in classes) else False
        if self._is_apart(form, classes) or self._is_irrational(form):
            return False
        return None

    def _is_apart(self, form: FunctionPoly, classes: list[Coset]) -> bool:
        """Is the form linear in one parameter, and no value of it known to bring the form into the classes?"""
        line = _line(form)
        if line is None:
            return False
        known = self.of(line.name)
        solutions = [Coset((c.start - line.constant) / line.factor, c.step / abs(line.factor)) for c in classes]
        if "noninteger" in known.words and all(s.is_covered_by([_INTEGERS]) for s in solutions):
            return True
        return not any(_has_number_between(s, known.bounds) for s in solutions)

    def vanishes(self, function: FunctionPoly) -> bool | None:
        """Does the function vanish: True (always), False (never) or None?"""
        value = self._value_of(function)
        if value is not None:
            return not value
        return False if self._is_nowhere_zero(function) else None

    def _is_nowhere_zero(self, function: FunctionPoly) -> bool:
        """Is one of these seen: by classes, by a root that isn't admitted, by factors, by irrationality, by a sign?"""
        values = self._coset_of(function)
        if values is not None and not values.contains(Fraction(0)):
            return True
        above = numerator(function)
        line = _line(above)
        if line is not None and not self.of(line.name).admits(QQ.poly([line.root])):
            return True
        if len(function.num) == 1:
            return all(self.of(name).nonzero for name in _names(function))
        if self._is_irrational(function):
            return True
        return self.is_positive(above) or self.is_positive(-1 * above)

    def _value_of(self, function: FunctionPoly) -> Poly | None:
        """The value of a polynomial in the parameters that have a value; None for any other."""
        field = self.values[0][1].field if self.values else QQ
        fixed = dict(self.values)
        below = element(function.field, function.den)
        used = {*_names(function), *_names(below)}
        if not used <= fixed.keys():
            return None
        return function.value_at([fixed.get(name, 0) for name in function.field.names], field)

    def is_positive(self, form: FunctionPoly, *, or_zero: bool = False) -> bool:
        """Can a polynomial be proven to be positive, or not negative, everywhere?

        With t = end + sign s, s >= 0, for one bound of each parameter t, no coefficient is negative.
        """
        if not form.den.is_constant():
            return False
        choices = []
        for name, degree in zip(form.field.names, degrees(form), strict=True):
            if degree:
                choices.append(self.of(name).bounds)
            else:
                choices.append([_NO_BOUND])
        return any(_is_positive_beyond(bounds, form, or_zero=or_zero) for bounds in product(*choices))

    def _coset_of(self, form: FunctionPoly) -> Coset | None:
        """A class that contains all values of a polynomial."""
        known: dict[str, Coset] = {}
        for name in _names(form):
            coset = self.of(name).coset
            if coset is None:
                return None
            known[name] = coset
        if not known:
            return None
        linear = _linear(form)
        if linear is None:
            are_integers = all(coset.is_covered_by([_INTEGERS]) for coset in known.values())
            return _INTEGERS if are_integers and form.den.is_one() else None
        start = linear.constant + sum(factor * known[name].start for name, factor in linear.factors.items())
        steps = [abs(factor) * known[name].step for name, factor in linear.factors.items()]
        return Coset(start, reduce(common_divisor, steps))

    def _is_irrational(self, form: FunctionPoly) -> bool:
        """A linear form in which one parameter is irrational and the others are rational."""
        linear = _linear(form)
        if linear is None:
            return False
        kinds = [self.of(name).rational for name in linear.factors]
        return kinds.count(False) == 1 and None not in kinds


NOTHING_ASSUMED = Assumptions()


def read_assumptions(assume: Mapping[Any, str] | None, S: Any, names: tuple[str, ...]) -> Assumptions:
    """From `{"n": "positive integer"}`, and from the assumptions on the SymPy symbols in S.

    Raises `InputError` for a name that isn't a parameter, and for a word that isn't one of `WORDS` ("real" and "complex" say
    nothing that could be used).
    """
    check_mapping(assume)
    words: dict[str, list[str]] = {name: [] for name in names}
    for symbol in getattr(S, "free_symbols", ()):
        if symbol.name in words:
            words[symbol.name] = _words_of(symbol)
    for key, what in (assume or {}).items():
        name = _parameter(key, names)
        words[name] += _read_words(what)
    known = {name: Known(_useful(said)) for name, said in words.items()}
    return Assumptions(tuple((name, facts) for name, facts in known.items() if facts.words))


def check_mapping(assume: object) -> None:
    """Raises `InputError` for what can't be assumptions."""
    if assume is not None and not isinstance(assume, Mapping):
        raise InputError(f"assumptions are a mapping, not {assume!r}", hint='assume={"n": "integer"}')


def _parameter(key: object, names: Sequence[str]) -> str:
    """The name of a parameter, of which something is said.  Raises `InputError` for another name."""
    name = str(key)
    if name not in names:
        raise InputError(f"{name} isn't a parameter of S", hint=f"the parameters are {', '.join(names) or 'none'}")
    return name


def _useful(words: Iterable[str]) -> tuple[str, ...]:
    """Each once, without those that say nothing."""
    return tuple(word for word in dict.fromkeys(words) if word not in _SAY_NOTHING)


def _read_words(what: object) -> list[str]:
    """The words of an assumption.  Raises `InputError` for others, and for bounds that aren't real numbers."""
    text = re.sub(r"([<>]=?|!=)\s+", r"\1", str(what))
    text = re.sub(r"!=0(?![\d/])", "nonzero", text)
    words = text.replace(",", " ").split()
    known = {*WORDS, *_SAY_NOTHING}
    unknown = [word for word in words if word not in known and not _is_relation(word)]
    if unknown or not words:
        raise InputError(
            f"{' '.join(unknown) or what!r} isn't an assumption that is known",
            hint=f"known are {', '.join(WORDS)}, >=1/2, !=1, a value",
        )
    _ends(words)  # of which each has to be a real number
    return words


def _words_of(symbol: Any) -> list[str]:
    """What SymPy knows of a symbol, without what follows from the rest."""
    words = _arithmetic_of(symbol)
    signs = [word for word in _INEQUALITIES if getattr(symbol, f"is_{word}")]
    words += signs[:1]
    if symbol.is_zero is False and not Known(tuple(words)).nonzero:
        words.append("nonzero")
    return words


def _arithmetic_of(symbol: Any) -> list[str]:
    """Of which kind the number is."""
    if symbol.is_odd:
        return ["odd"]
    if symbol.is_even:
        return ["even"]
    if symbol.is_integer:
        return ["integer"]
    if symbol.is_irrational:
        return ["irrational"]
    words = ["rational"] if symbol.is_rational else []
    if symbol.is_integer is False:
        words.append("noninteger")
    return words


def _sympy_properties(known: Known) -> list[str]:
    """What SymPy has names for; of bounds, what they say of the sign."""
    unnamed = {*_INEQUALITIES, "half-integer"}
    words = [word for word in known.words if word in WORDS and word not in unnamed]
    if "half-integer" in known.words:
        words += ["rational", "noninteger"]
    for bound in known.bounds:
        if bound.sign * bound.end < 0:
            continue
        strict, weak = _SIGNS[bound.sign]
        excludes_zero = bound.strict or bound.end != 0
        if excludes_zero:
            words.append(strict)
        else:
            words.append(weak)
    return words


def _is_positive_beyond(bounds: Sequence[Bound], form: FunctionPoly, *, or_zero: bool) -> bool:
    """Is no coefficient negative in the s with t = end + sign s, and a monomial positive?"""
    field = form.field
    values = [field.generator(name) * b.sign + b.end for name, b in zip(field.names, bounds, strict=True)]
    terms = over_parameters(form.value_at(values, field)).num.to_dict()
    if not all(coefficient > 0 for coefficient in terms.values()):
        return False
    return or_zero or any(_is_positive_monomial(exponents[1:], bounds) for exponents in terms)


def _is_positive_monomial(exponents: Sequence[int], bounds: Sequence[Bound]) -> bool:
    """Is each of its parameters strictly beyond the bound?"""
    return all(bound.strict for bound, k in zip(bounds, exponents, strict=True) if k)


def _has_number_between(coset: Coset, bounds: list[Bound]) -> bool:
    """Is there a number of the class within the bounds?"""
    if len(bounds) < 2:
        return True
    low = max(bounds, key=lambda bound: bound.sign)
    first = coset.start + ceil((low.end - coset.start) / coset.step) * coset.step
    return _is_within(bounds, first) or _is_within(bounds, first + coset.step)


def _is_within(bounds: list[Bound], number: Fraction) -> bool:
    return all(bound.admits(number) for bound in bounds)


@dataclass(frozen=True)
class _Linear:
    """constant + the sum of factor * parameter."""

    constant: Fraction
    factors: Mapping[str, Fraction]


@dataclass(frozen=True)
class _LinearInOne:
    """constant + factor * the parameter of this name."""

    name: str
    constant: Fraction
    factor: Fraction

    @property
    def root(self) -> Fraction:
        return -self.constant / self.factor


def _line(form: FunctionPoly) -> _LinearInOne | None:
    """A linear form of one parameter; None for anything else."""
    linear = _linear(form)
    if linear is None or len(linear.factors) != 1:
        return None
    ((name, factor),) = linear.factors.items()
    return _LinearInOne(name, linear.constant, factor)


def _is_in_one(value: Poly, classes: Iterable[Coset]) -> bool:
    """Is it rational, and in one of the classes?"""
    number = value.field.rational_value(value)
    return number is not None and any(coset.contains(number) for coset in classes)


def _linear(form: FunctionPoly) -> _Linear | None:
    """A linear form; None for anything else."""
    if not form.den.is_constant() or form.num.total_degree() > 1:
        return None
    den = int(form.den.leading_coefficient())
    constant = Fraction(0)
    factors = {}
    for exponents, coefficient in form.num.to_dict().items():
        value = Fraction(int(coefficient), den)
        if any(exponents[1:]):
            factors[form.field.names[exponents.index(1) - 1]] = value
        else:
            constant = value
    return _Linear(constant, factors)


def _names(form: FunctionPoly) -> list[str]:
    """The parameters in the numerator."""
    return [name for name, k in zip(form.field.names, degrees(form), strict=True) if k]
