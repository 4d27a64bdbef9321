"""Statements about integers as the literature writes them.

"A polynomial in N over Q(t) has an integer root in these classes" becomes a spectrum, E = -Z^2/(2*n^2) where n + l is an
integer, or a sum of square roots, sqrt(-E - b) +- sqrt(-E + b) +- (2*l + 1) is odd (for some of the signs).  The statements
are the same; nothing here decides anything.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import floor

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
        return written(function if isinstance(function, RatFunc) else over_parameters(function), self.letter)

    def equals(self, name: str, function: Poly | RatFunc) -> str:
        return f"`{name} = {self.function(function)}`"


def families(equation: FunctionPoly, fixed: Sequence[str] = ()) -> list[tuple[str, RatFunc]]:
    """`(name, f)` where a polynomial in N over Q(t) vanishes exactly if a parameter, not a `fixed` one, is f(N)."""
    found: list[tuple[str, RatFunc]] = []
    for i, name in enumerate(equation.field.names):
        if degrees(equation)[i] != 1 or name in fixed:
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
        family = families(equation, n.fixed) if any(degrees(equation)) else []
        if family:
            name, function = family[0]
            functions.setdefault(name, []).append(function)
        else:
            said.append(equation_text(equation, n))
    for name, known in functions.items():
        notes = dict.fromkeys(note for f in known for note in _notes_at_poles(_Choice(f, "", _is_natural), n))
        said.append(_one_of(name, known, n) + (f" ({', '.join(notes)})" if notes else ""))
    return " or ".join(said)


def _one_of(name: str, functions: Sequence[RatFunc], n: Notation) -> str:
    """That a parameter is one of the functions; or that it or c minus it is, where these come in pairs with the sum c."""
    what = name
    total = _sum_in_pairs(functions)
    if total:
        what += f"` or `{n.function(over_parameters(total - total.field.generator(name)))}"
        pairs = [sorted((f, RatFunc(total) - f), key=str) for f in functions]
        functions = [*dict.fromkeys(min(pair, key=lambda f: _is_negative(n, f)) for pair in pairs)]
    texts = _with_signs(functions, n)
    if len(texts) > 2:
        texts = [", ".join(texts[:-1]), texts[-1]]
    return f"`{what} = {'` or `'.join(texts)}`"


def _sum_in_pairs(functions: Sequence[RatFunc]) -> FunctionPoly | None:
    """A constant, not 0, of which each function has another one that makes it up; None where there isn't one, or two pairs."""
    if len(functions) < 4:
        return None
    for other in functions[1:]:
        total = functions[0] + other
        if not total or total.num.degree or total.den.degree or total.field.rational_value(total.num) is None:
            continue
        if all(total - f in functions and 2 * f != total for f in functions):
            return over_parameters(total.num)
    return None


def _with_signs(functions: Sequence[RatFunc], n: Notation) -> list[str]:
    """How the functions are written, with one text `c +- f` for c + f and c - f, c free of the integer."""
    texts: dict[RatFunc, str] = {}
    for f in functions:
        other = next((g for g in texts if _have_a_center(f, g) and texts[g] == n.function(g)), None)
        if other is None:
            texts[f] = n.function(f)
            continue
        center = (f + other) / 2
        value = n.function(min((other - center, f - center), key=lambda g: _is_negative(n, g)))
        inside = re.sub(r"[({][^()]*[)}]", "", value)
        is_sum = " + " in inside or " - " in inside
        signed = f"+-({value})" if is_sum else f"+-{value}"
        texts[other] = f"{n.function(center)} {signed[:2]} {signed[2:]}" if center else signed
    return [*texts.values()]


def _have_a_center(f: RatFunc, g: RatFunc) -> bool:
    """Is their sum 0, or a function of the parameters without the integer in it?"""
    total = f + g
    if total.num.degree > 0 or total.den.degree > 0:
        return False
    return not total or total.field.rational_value(over_parameters(total.num)) is None


def _is_negative(n: Notation, f: RatFunc) -> bool:
    return n.function(f).lstrip("(").startswith("-")


def classes(residues: Sequence[Fraction | int], modulus: Fraction | int) -> str:
    """Classes modulo a number: `1, 2`, or `+-1/6, 1/2` where r and -r come in pairs."""
    if {-residue % modulus for residue in residues} != {*residues}:
        return ", ".join(map(str, residues))
    half = Fraction(modulus) / 2
    signs = {residue: "" if residue in (0, half) else "+-" for residue in residues if residue <= half}
    return ", ".join(f"{sign}{residue}" for residue, sign in signs.items())


def kind(residues: Sequence[Fraction | int], modulus: Fraction | int, letter: str = "") -> str:
    """What an integer in these classes is, maybe with its name: "an odd integer n", "an integer not divisible by 3"."""
    name = f" `{letter}`" if letter else ""
    if modulus == 1 and not any(residues):
        return f"an integer{name}"
    if modulus == 2 and list(residues) == [0]:
        return f"an even integer{name}"
    if modulus == 2 and list(residues) == [1]:
        return f"an odd integer{name}"
    if len(residues) > 1 and list(residues) == list(range(1, int(modulus))):
        return f"an integer{name} not divisible by {modulus}"
    equation = f"{letter} = {classes(residues, modulus)} mod {modulus}"
    return f"an integer `{equation}`" if letter else f"an integer`{equation}`"


def integer_condition(equation: FunctionPoly, residues: Sequence[int], modulus: int, n: Notation) -> str:
    """That a polynomial in N over Q(t) has an integer root in these classes."""
    best = _spectrum(equation, residues, modulus, n)
    roots = _roots(equation)
    if roots is None:
        return best or f"{equation_text(equation, n)} for {kind(residues, modulus, n.letter)}"
    mean, squares = roots
    constant = floor(constant_term(mean) / modulus) * modulus
    terms = [n.function(mean - constant)] if mean != constant else []
    sum_of_roots = f"`{' +- '.join([*terms, *map(root_written, squares)])}` is {kind(residues, modulus)}"
    if best is None:
        return sum_of_roots
    length = len(text_of(best))
    if len(squares) > 1:
        return f"{sum_of_roots}, that is {best}" if length <= _BESIDE else sum_of_roots
    return best if length <= len(text_of(sum_of_roots)) + _LONGER else sum_of_roots


def _spectrum(equation: FunctionPoly, residues: Sequence[int], modulus: int, n: Notation) -> str | None:
    """`name = f(n)` and what is said of n, by the shortest of the ways to choose n; None where no parameter is linear."""
    known = families(equation, n.fixed)
    energies = [(name, f) for name, f in known if name == ENERGY]
    best: tuple[str, _Choice] | None = None
    shortest = 0
    for k, (name, f) in enumerate(energies or known):
        for choice in _choices(equation, f, residues, modulus, n):
            length = _LATER * k + _WEIGHT * shortest_length(choice.f, n.letter) + len(text_of(choice.what))
            if choice.what.startswith(n.some):
                length += _NO_INTEGER
            if best is None or length < shortest:
                best = (name, choice)
                shortest = length
    if best is None:
        return None
    name, choice = best
    notes = _notes_at_poles(choice, n)
    note = f" ({', '.join(notes)})" if notes else ""
    return f"{n.equals(name, choice.f)}{note}{choice.what}"


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
        value = over_parameters(f.num(root))
        zeros = [n.function(zero) for zero in irreducible_factors(value)]
        if not zeros:
            continue
        zero = zeros[0]
        if len(zeros) > 1:
            zero = "*".join(map(in_product, zeros))
        notes.append(f"`{zero} = 0` where `{n.letter} = {n.function(root)}`")
    return notes


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


def _choices(
    equation: FunctionPoly, f: RatFunc, residues: Sequence[int], modulus: int, n: Notation
) -> Iterator[_Choice]:
    """f(N) with N = n; with N = s n + r, n an integer; with N = s n + c, n shifted by a function of the parameters."""
    N = equation.field.poly([0, 1])
    mirrored = equation(-N) == (-1) ** equation.degree * equation
    single = len(residues) == 1 or (mirrored and {*residues} == {residues[0], -residues[0] % modulus})
    if equation.degree > 1 or not single:
        what = f" for {kind(residues, modulus, n.letter)}"
        yield _Choice(f, what, lambda n: _is_integer(n) and int(n) % modulus in residues)
    if single and (modulus < 3 or not mirrored):
        signs, shifts = ((1, -1), (0, -1, 1)) if modulus == 1 else ((1,), (0, -1))
        for sign, shift in product(signs, shifts):
            chosen = RatFunc(N * (sign * modulus) + residues[0] + modulus * shift)
            yield _Choice(f(chosen), f" for an integer `{n.letter}`", _is_integer)
    center = _center(equation, f)
    if center is None:
        return
    u = over_parameters((center - residues[0]) / modulus)
    if single:
        yield _centered(f(RatFunc(N * modulus + center)), u, n)
    if not single or constant_term(center).denominator > 1 or int(u.den.content()) > 1:
        form = over_parameters(N + center)
        what = f"{n.some} `{n.function(form)}` {kind(residues, modulus)}"
        yield _Choice(f(RatFunc(form)), what, lambda n: True)


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
    field = equation.field
    if equation.degree < 2:
        return None
    poles = field.factor(f.den) if f.den.degree else []
    if len(poles) == 1 and poles[0][0].degree == 1:
        center = -poles[0][0][0]
    else:
        center = -equation[equation.degree - 1] / (equation.lc * equation.degree)
    return None if field.rational_value(center) is not None else center


def _roots(equation: FunctionPoly) -> tuple[FunctionPoly, list[Poly]] | None:
    """`(r, squares)` where the roots are r +- the roots of one, two or three squares; None where they aren't."""
    field = equation.field
    k = equation.degree
    if k not in (2, 4, 8):
        return None
    mean = over_parameters(-equation[k - 1] / (equation.lc * k))
    shifted = equation(field.poly([0, 1]) + mean) / equation.lc
    if any(shifted[i] for i in range(1, k, 2)):
        return None
    if k == 2:
        return mean, [-shifted[0]]
    squares = _two_squares(shifted) if k == 4 else _three_squares(shifted)
    return None if squares is None else (mean, squares)


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
