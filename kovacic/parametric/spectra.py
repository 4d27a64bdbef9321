"""Statements about integers as the literature writes them.

"A polynomial in N over Q(t) has an integer root in these classes" becomes a spectrum, E = -Z^2/(2*n^2) where n + l is an
integer, or a sum of square roots, sqrt(-E - b) +- sqrt(-E + b) +- (2*l + 1) is odd (for some of the signs).  The statements
are the same; nothing here decides anything.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import floor
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import ENERGY
from kovacic.parametric.formulas import in_product, root_written, shortest_length, text_of, written
from kovacic.parametric.functions import (
    constant_term,
    degrees,
    irreducible_factors,
    numerator,
    over_parameters,
    powers_of,
)

#: Characters of a spectrum that is given beside two square roots; and by how many it may be longer than one square root.
_BESIDE = 120
_LONGER = 40
#: How much more the length of f(n) counts than that of what is said about n, and what it costs to solve for a later parameter.
_WEIGHT = 3
_LATER = 10
#: What it costs that n is another number than an integer, of which something has to be said.
_NO_INTEGER = 25
#: For which rational numbers n is something possible?
Possible = Callable[[Fraction], bool]


@dataclass(frozen=True)
class Notation:
    """`letter` is what an integer is called; the `fixed` parameters are those that nothing is solved for."""

    letter: str = "n"
    fixed: tuple[str, ...] = ()

    @property
    def some(self) -> str:
        """What is said before the property that a number has, which is no integer."""
        return f" for a number `{self.letter}` with"

    def function(self, function: Poly | RatFunc) -> str:
        """The shortest form of a function of the parameters and the integer."""
        if not isinstance(function, RatFunc):
            function = over_parameters(function)
        return written(function, self.letter)

    def equals(self, name: str, function: Poly | RatFunc) -> str:
        return f"`{name} = {self.function(function)}`"


def families(equation: FunctionPoly, fixed: Sequence[str] = ()) -> list[tuple[str, RatFunc]]:
    """`(name, f)` where a polynomial in N over Q(t) vanishes exactly if a parameter, not a `fixed` one, is f(N)."""
    found: list[tuple[str, RatFunc]] = []
    occurring = degrees(equation)
    for i, name in enumerate(equation.field.names):
        if occurring[i] != 1 or name in fixed:
            continue
        parts = powers_of(equation, i)
        slope = parts[1]
        rest = parts.get(0, 0 * slope)
        found.append((name, -RatFunc(rest, slope)))
    return found


def equation_text(equation: FunctionPoly, n: Notation) -> str:
    """`equation = 0`, solved for a parameter where one occurs linearly."""
    if not any(degrees(equation)) and equation.degree == 1:
        return n.equals(n.letter, -equation[0] / equation[1])
    for name, f in families(equation, n.fixed):
        return n.equals(name, f)
    return f"`{n.function(numerator(equation))} = 0`"


def alternatives(equations: Sequence[FunctionPoly], n: Notation) -> str:
    """That one of the equations holds: `b = +-2*(d + 1)`, `n = 2*d, 2*d + 1 or -2*d - 3`, `n or -n - 1 = 2*d or 2*d + 1`."""
    functions: dict[str, list[RatFunc]] = {}
    said: list[str] = []
    for equation in equations:
        family = families(equation, n.fixed)
        if family:
            name, function = family[0]
            functions.setdefault(name, []).append(function)
        else:
            said.append(equation_text(equation, n))
    said += [_is_one_of(name, known, n) for name, known in functions.items()]
    return " or ".join(said)


def _is_one_of(name: str, functions: Sequence[RatFunc], n: Notation) -> str:
    """That a parameter is one of the functions at a natural number, with notes where one of them isn't defined."""
    notes: dict[str, None] = {}
    for f in functions:
        choice = _Choice(f, "", _is_natural)
        notes.update(dict.fromkeys(_notes_at_poles(choice, n)))
    return _one_of(name, functions, n) + _in_parentheses(notes)


def _in_parentheses(notes: Collection[str]) -> str:
    if not notes:
        return ""
    return f" ({', '.join(notes)})"


def _one_of(name: str, functions: Sequence[RatFunc], n: Notation) -> str:
    """That a parameter is one of the functions; or that it or c minus it is, where these come in pairs with the sum c."""
    what = name
    total = _sum_in_pairs(functions)
    if total:
        other = over_parameters(total - total.field.generator(name))
        what = f"{name}` or `{n.function(other)}"
        functions = _one_of_each_pair(functions, RatFunc(total), n)
    texts = _with_signs(functions, n)
    if len(texts) > 2:
        texts = [", ".join(texts[:-1]), texts[-1]]
    return f"`{what} = {'` or `'.join(texts)}`"


def _one_of_each_pair(functions: Sequence[RatFunc], total: RatFunc, n: Notation) -> list[RatFunc]:
    """f or total - f, each once: one that isn't negative, if there is one, or the first in the order of their texts."""
    found: dict[RatFunc, None] = {}
    for f in functions:
        pair = sorted((f, total - f), key=str)
        found[_not_negative(pair, n)] = None
    return [*found]


def _not_negative(functions: Sequence[RatFunc], n: Notation) -> RatFunc:
    """The first that isn't written with a minus before it, or the first."""
    return min(functions, key=lambda f: _is_negative(n, f))


def _sum_in_pairs(functions: Sequence[RatFunc]) -> FunctionPoly | None:
    """A constant, not 0, of which each function has another one that makes it up; None where there isn't one, or two pairs."""
    if len(functions) < 4:
        return None
    for other in functions[1:]:
        total = functions[0] + other
        if not total or not _is_number(total):
            continue
        if all(total - f in functions and 2 * f != total for f in functions):
            return over_parameters(total.num)
    return None


def _is_free_of_n(f: RatFunc) -> bool:
    return f.num.degree <= 0 and f.den.degree <= 0


def _is_number(f: RatFunc) -> bool:
    """Is it one of those that don't depend on the parameters either?"""
    return _is_free_of_n(f) and f.field.rational_value(f.num) is not None


def _with_signs(functions: Sequence[RatFunc], n: Notation) -> list[str]:
    """How the functions are written, with one text `c +- f` for c + f and c - f, c free of the integer."""
    texts: dict[RatFunc, str] = {}
    for f in functions:
        other = _partner(f, texts, n)
        if other is None:
            texts[f] = n.function(f)
        else:
            texts[other] = _with_both_signs(f, other, n)
    return [*texts.values()]


def _partner(f: RatFunc, texts: Mapping[RatFunc, str], n: Notation) -> RatFunc | None:
    """The first of the functions that has a center with f, and no partner yet: its text is its own."""
    for other, text in texts.items():
        if _have_a_center(f, other) and text == n.function(other):
            return other
    return None


def _with_both_signs(f: RatFunc, other: RatFunc, n: Notation) -> str:
    """`c +- g`, c the mean of the two functions."""
    center = (f + other) / 2
    value = n.function(_not_negative((other - center, f - center), n))
    inside = re.sub(r"[({][^()]*[)}]", "", value)
    is_sum = " + " in inside or " - " in inside
    if is_sum:
        value = f"({value})"
    if not center:
        return f"+-{value}"
    return f"{n.function(center)} +- {value}"


def _have_a_center(f: RatFunc, g: RatFunc) -> bool:
    """Is their sum 0, or a function of the parameters without the integer in it?"""
    total = f + g
    if not total:
        return True
    return _is_free_of_n(total) and not _is_number(total)


def _is_negative(n: Notation, f: RatFunc) -> bool:
    return n.function(f).lstrip("(").startswith("-")


def classes(residues: Sequence[Fraction | int], modulus: Fraction | int) -> str:
    """Classes modulo a number: `1, 2`, or `+-1/6, 1/2` where r and -r come in pairs."""
    if {-residue % modulus for residue in residues} != {*residues}:
        return ", ".join(map(str, residues))
    half = Fraction(modulus) / 2
    texts = []
    for residue in dict.fromkeys(residues):
        if residue in (0, half):
            texts.append(str(residue))
        elif residue < half:
            texts.append(f"+-{residue}")
    return ", ".join(texts)


#: Classes of integers that have a name, by the modulus and the residues.
_KINDS: dict[tuple[Fraction | int, tuple[Fraction | int, ...]], str] = {
    (1, (0,)): "an integer",
    (2, (0,)): "an even integer",
    (2, (1,)): "an odd integer",
}


def kind(residues: Sequence[Fraction | int], modulus: Fraction | int, letter: str = "") -> str:
    """What an integer in these classes is, maybe with its name: "an odd integer n", "an integer not divisible by 3"."""
    known = tuple(residues)
    noun = _KINDS.get((modulus, known))
    if noun is not None:
        return f"{noun} `{letter}`" if letter else noun
    if len(known) > 1 and known == tuple(range(1, int(modulus))):
        name = f" `{letter}`" if letter else ""
        return f"an integer{name} not divisible by {modulus}"
    equation = f"{letter} = {classes(residues, modulus)} mod {modulus}"
    return f"an integer `{equation}`" if letter else f"an integer`{equation}`"


@dataclass(frozen=True)
class _Classes:
    """The integers that are one of the `residues` modulo a number."""

    residues: Sequence[int]
    modulus: int

    def contain(self, n: Fraction) -> bool:
        return n.denominator == 1 and int(n) % self.modulus in self.residues

    def are_one(self, *, up_to_sign: bool) -> bool:
        """Is it a single class, or r and -r where these say the same?"""
        first = self.residues[0]
        if len(self.residues) == 1:
            return True
        return up_to_sign and {*self.residues} == {first, -first % self.modulus}

    def named(self, letter: str = "") -> str:
        return kind(self.residues, self.modulus, letter)


def integer_condition(equation: FunctionPoly, residues: Sequence[int], modulus: int, n: Notation) -> str:
    """That a polynomial in N over Q(t) has an integer root in these classes, as a spectrum or by square roots, or both."""
    numbers = _Classes(residues, modulus)
    spectrum = _spectrum(equation, numbers, n)
    roots = _roots(equation)
    if roots is None:
        return spectrum or f"{equation_text(equation, n)} for {numbers.named(n.letter)}"
    sum_of_roots = f"{_sum_of_roots(roots, modulus, n)} is {numbers.named()}"
    if spectrum is None:
        return sum_of_roots
    return _shorter(spectrum, sum_of_roots, has_several=len(roots.squares) > 1)


def _shorter(spectrum: str, sum_of_roots: str, *, has_several: bool) -> str:
    """What is said where both are known: beside several roots a short spectrum, too; else one of them."""
    length = len(text_of(spectrum))
    if has_several:
        return f"{sum_of_roots}, that is {spectrum}" if length <= _BESIDE else sum_of_roots
    most = len(text_of(sum_of_roots)) + _LONGER
    return spectrum if length <= most else sum_of_roots


def _sum_of_roots(roots: _RootsBySquares, modulus: int, n: Notation) -> str:
    """The mean, without multiples of the modulus, and the square roots."""
    constant = floor(constant_term(roots.mean) / modulus) * modulus
    terms = [*map(root_written, roots.squares)]
    if roots.mean != constant:
        terms.insert(0, n.function(roots.mean - constant))
    return f"`{' +- '.join(terms)}`"


class _WayToSay(NamedTuple):
    """A way to say it: which parameter is solved for, the choice of n, and what it costs to read that, in characters."""

    name: str
    choice: _Choice
    cost: int


def _spectrum(equation: FunctionPoly, numbers: _Classes, n: Notation) -> str | None:
    """`name = f(n)` and what is said of n, by the shortest of the ways to choose n; None where no parameter is linear."""
    known = families(equation, n.fixed)
    energies = [(name, f) for name, f in known if name == ENERGY]
    ways: list[_WayToSay] = []
    for k, (name, f) in enumerate(energies or known):
        choices = _choices(equation, f, numbers, n)
        ways += [_WayToSay(name, choice, _LATER * k + _cost(choice, n)) for choice in choices]
    if not ways:
        return None
    best = min(ways, key=lambda way: way.cost)
    notes = _notes_at_poles(best.choice, n)
    return f"{n.equals(best.name, best.choice.f)}{_in_parentheses(notes)}{best.choice.what}"


def _cost(choice: _Choice, n: Notation) -> int:
    """Of reading it, in characters."""
    length = _WEIGHT * shortest_length(choice.f, n.letter) + len(text_of(choice.what))
    if choice.what.startswith(n.some):
        length += _NO_INTEGER
    return length


def _notes_at_poles(choice: _Choice, n: Notation) -> list[str]:
    """What the statement says for a possible n at which f isn't defined: that its numerator vanishes there."""
    f = choice.f
    if not f.den.degree:
        return []
    notes: list[str] = []
    for factor, _ in f.field.factor(f.den):
        if factor.degree > 1:
            continue
        root = over_parameters(-factor[0])
        number = f.field.rational_value(root)
        if number is not None and not choice.is_possible(number):
            continue
        zeros = irreducible_factors(f.num(root))
        if zeros:
            notes.append(f"`{_product(zeros, n)} = 0` where `{n.letter} = {n.function(root)}`")
    return notes


def _product(factors: Sequence[FunctionPoly], n: Notation) -> str:
    texts = [n.function(factor) for factor in factors]
    if len(texts) == 1:
        return texts[0]
    return "*".join(map(in_product, texts))


@dataclass(frozen=True)
class _Choice:
    """A parameter is f(n); what is said of n; and for which rational numbers n that is possible."""

    f: RatFunc
    what: str
    is_possible: Possible


def _is_integer(n: Fraction) -> bool:
    return n.denominator == 1


def _is_natural(n: Fraction) -> bool:
    return n.denominator == 1 and n >= 0


def _choices(equation: FunctionPoly, f: RatFunc, numbers: _Classes, n: Notation) -> Iterator[_Choice]:
    """f(N) with N = n; with N = s n + r, n an integer; with N = s n + c, n shifted by a function of the parameters."""
    N = equation.field.poly([0, 1])
    is_mirrored = equation(-N) == (-1) ** equation.degree * equation
    is_single = numbers.are_one(up_to_sign=is_mirrored)
    if equation.degree > 1 or not is_single:
        yield _Choice(f, f" for {numbers.named(n.letter)}", numbers.contain)
    if is_single and (numbers.modulus < 3 or not is_mirrored):
        yield from _by_any_integer(f, numbers, n)
    center = _center(equation, f)
    if center is not None:
        yield from _about_center(f, center, numbers, n, is_single=is_single)


def _about_center(f: RatFunc, c: Poly, numbers: _Classes, n: Notation, *, is_single: bool) -> Iterator[_Choice]:
    """f(s n + c), where n + (c - r)/s is an integer; and f(n + c), where n + c is one of the numbers."""
    N = f.field.poly([0, 1])
    u = over_parameters((c - numbers.residues[0]) / numbers.modulus)
    if is_single:
        yield _centered(f(RatFunc(N * numbers.modulus + c)), u, n)
    has_fraction = constant_term(c).denominator > 1 or int(u.den.content()) > 1
    if has_fraction or not is_single:
        form = over_parameters(N + c)
        what = f"{n.some} `{n.function(form)}` {numbers.named()}"
        yield _Choice(f(RatFunc(form)), what, lambda n: True)


def _by_any_integer(f: RatFunc, numbers: _Classes, n: Notation) -> Iterator[_Choice]:
    """f(s n + r) for an integer n, with the residue and its neighbours for r, and with both signs for the modulus 1."""
    N = f.field.poly([0, 1])
    modulus = numbers.modulus
    lines = [(1, 0), (1, -1)]
    if modulus == 1:
        lines = list(product((1, -1), (0, -1, 1)))
    for sign, shift in lines:
        chosen = RatFunc(N * (sign * modulus) + numbers.residues[0] + modulus * shift)
        yield _Choice(f(chosen), f" for an integer `{n.letter}`", _is_integer)


def _centered(f: RatFunc, u: FunctionPoly, n: Notation) -> _Choice:
    """n + u is an integer; where only n^2 matters: n + u or n - u - 1 is a natural number."""
    N = f.field.poly([0, 1])
    constant = constant_term(u)
    plus = n.function(N + u - constant)
    if constant.denominator == 1 and f(RatFunc(-N)) == f:
        minus = n.function(N - u + constant - 1)
        return _Choice(f, f"{n.some} `{plus}` or `{minus} in N`", lambda n: True)
    shift = f" - {-constant % 1}" if constant.denominator > 1 else ""
    return _Choice(f, f"{n.some} `{plus}{shift} in Z`", lambda n: True)


def _center(equation: FunctionPoly, f: RatFunc) -> Poly | None:
    """Where f has its only pole, or the mean of the equation's roots; None where that is a number."""
    if equation.degree < 2:
        return None
    center = _only_pole(f)
    if center is None:
        center = _mean_of_roots(equation)
    return center if equation.field.rational_value(center) is None else None


def _only_pole(f: RatFunc) -> Poly | None:
    """The root of the denominator where there is one, in the field of f."""
    if not f.den.degree:
        return None
    factors = [factor for factor, _ in f.field.factor(f.den)]
    if len(factors) > 1 or factors[0].degree > 1:
        return None
    return -factors[0][0]


def _mean_of_roots(equation: Poly) -> Poly:
    k = equation.degree
    return -equation[k - 1] / (equation.lc * k)


@dataclass(frozen=True)
class _RootsBySquares:
    """The roots of an equation: the mean +- the square roots of one, two or three squares."""

    mean: FunctionPoly
    squares: list[Poly]


def _roots(equation: FunctionPoly) -> _RootsBySquares | None:
    """The roots, where they are such sums for an equation of degree 2, 4 or 8."""
    if equation.degree not in (2, 4, 8):
        return None
    mean = over_parameters(_mean_of_roots(equation))
    shifted = equation(equation.field.poly([0, 1]) + mean) / equation.lc
    squares = _squares(shifted)
    return None if squares is None else _RootsBySquares(mean, squares)


def _squares(shifted: Poly) -> list[Poly] | None:
    """Those of which the roots of a monic even polynomial are sums, with all signs, of square roots."""
    k = shifted.degree
    if any(shifted[i] for i in range(1, k, 2)):
        return None
    if k == 2:
        return [-shifted[0]]
    return _two_squares(shifted) if k == 4 else _three_squares(shifted)


def _two_squares(shifted: Poly) -> list[Poly] | None:
    """Of roots whose sums, with all signs, are the roots of a polynomial N^4 + ..."""
    difference = shifted.field.sqrt(shifted[0])
    if difference is None:
        return None
    total = -shifted[2] / 2
    return [(total + difference) / 2, (total - difference) / 2]


def _three_squares(shifted: Poly) -> list[Poly] | None:
    """By ((z - s1)^2 - 4 s2)^2 - 64 s3 z with z = N^2, s_i the symmetric functions of the three squares."""
    s1 = -shifted[6] / 4
    s2 = (6 * s1 * s1 - shifted[4]) / 8
    s3 = (16 * s1 * s2 - 4 * s1**3 - shifted[2]) / 64
    if shifted[0] != (s1 * s1 - 4 * s2) ** 2:
        return None
    squares: list[Poly] = []
    for factor, multiplicity in shifted.field.factor(shifted.field.poly([-s3, s2, -s1, 1])):
        if factor.degree == 1:
            squares += [-factor[0]] * multiplicity
    return squares if len(squares) == 3 else None
