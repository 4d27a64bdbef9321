"""What the text of a statement says at a point, read by rules of its own: formulas by SymPy, the words by patterns."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product
from typing import Any

import sympy

from kovacic.parametric.claims import (
    AllOf,
    AnyOf,
    Claim,
    DegreeExists,
    EquationFor,
    InClasses,
    IntegerFamily,
    IsZero,
    SumOfRoots,
)
from kovacic.parametric.prose import sentence
from kovacic.writing.formula import Math

#: The integers that are tried.
RANGE = range(-90, 91)
Values = dict[str, Any]


class NotReadError(Exception):
    """A text that these rules don't cover."""


def written(claim: Claim) -> str:
    """What is printed, with formulas between backquotes."""
    return "".join(f"`{part.text}`" if isinstance(part, Math) else part for part in sentence(claim))


def says(claim: Claim, values: Values) -> bool:
    """Is it true, as it is written, at rational values of the parameters?"""
    if isinstance(claim, AllOf):
        return all(says(part, values) for part in claim.parts)
    if isinstance(claim, AnyOf):
        return any(says(part, values) for part in claim.parts)
    if isinstance(claim, IsZero):
        (equation,) = written(claim).strip("`").split("`")
        return _is_true(equation, values)
    if isinstance(claim, IntegerFamily | EquationFor | SumOfRoots | InClasses):
        letter = claim.letter if isinstance(claim, IntegerFamily | EquationFor) else ""
        return _integer(written(claim), letter, values)
    raise NotReadError(type(claim).__name__)


def numbers_said(claim: DegreeExists, values: Values) -> set[int]:
    """The natural numbers below a bound that the text allows."""
    if isinstance(claim.degree, AnyOf):
        return _alternative_numbers(claim, claim.degree, values)
    text, letter = written(claim.degree), claim.letter
    if " for integers " in text:
        return _sums_of_exponents(text, values)
    if re.fullmatch(rf"`{letter}\b[^`=]* = \+-[^`]*`", text):
        return _sums_with_signs(text.strip("`"), letter, values)
    raise NotReadError(text)


def _alternative_numbers(claim: DegreeExists, degree: AnyOf, values: Values) -> set[int]:
    letter = claim.letter
    found: set[int] = set()
    everywhere = [part for part in degree.parts if not isinstance(part, AllOf)]
    for part in degree.parts:
        if isinstance(part, AllOf):
            there, where = part.parts
            if says(where, values):
                found |= numbers_said(replace(claim, degree=there), values)
    said = written(replace(claim, degree=AnyOf(tuple(everywhere))))
    text = said.partition(f", `{letter} in N`, and ")[0]
    notes = re.findall(r"`([^`]*) = 0` where `\w+ = ([^`]*)`", text)
    text = re.sub(r" \((?:`[^`]* = 0` where `\w+ = [^`]*`(?:, )?)+\)", "", text)
    for factor, root in notes:
        if read(factor, values) == 0:
            found |= _natural(read(root, values))
    return found | {d for d in range(RANGE.stop) if _alternatives(text, {**values, letter: sympy.Integer(d)})}


def _sums_of_exponents(text: str, values: Values) -> set[int]:
    """`d = 6 + j*a + k*b` for integers `j` from -2 to 2, `k` from -6 to 6, not all 0."""
    formula, _, said = text.partition(" for integers ")
    limits = {name: int(limit) for name, limit in re.findall(r"`(\w+)` from -\d+ to (\d+)", said)}
    found: set[int] = set()
    for numbers in product(*(range(-limit, limit + 1) for limit in limits.values())):
        if "not all 0" in said and not any(numbers):
            continue
        integers = dict(zip(limits, map(sympy.Integer, numbers), strict=True))
        _, _, sum_of_them = formula.strip("`").partition(" = ")
        found |= _natural(read(sum_of_them, values | integers))
    return found


def _sums_with_signs(formula: str, letter: str, values: Values) -> set[int]:
    """`d + 1 = +-a +- b`, for every choice of the signs."""
    left, _, right = formula.partition(" = +-")
    shift = read(left, values) - sympy.Symbol(letter)
    sums = [read(f"{sign}({term})", values) for sign in "+-" for term in [right.partition(" +- ")[0]]]
    for term in right.split(" +- ")[1:]:
        sums = [known + sign * read(term, values) for known in sums for sign in (1, -1)]
    return set[int]().union(*(_natural(known - shift) for known in sums))


def _natural(number: Any) -> set[int]:
    number = sympy.nsimplify(sympy.simplify(number)) if not number.is_Rational else number
    return {int(number)} if number.is_Integer and 0 <= number < RANGE.stop else set()


def read(text: str, values: Values) -> Any:
    """A formula at the values; other names are symbols."""
    names = {name: sympy.Symbol(name) for name in re.findall(r"[A-Za-z_]\w*", text)} | values
    names |= {"sqrt": sympy.sqrt, "I": values.get("I", sympy.I)}
    return sympy.sympify(text.replace("^", "**"), locals=names)


def _is_true(equation: str, values: Values) -> bool:
    left, right = (read(side, values) for side in equation.split(" = "))
    return bool(left.is_finite and right.is_finite) and _is_zero(left - right)


def _is_zero(value: Any) -> bool:
    return bool(value == 0 if value.is_Rational else sympy.simplify(value) == 0)


def _alternatives(text: str, values: Values) -> bool:
    """`n` or `-n - 1 = 2*d, 3` or `+-(d + 1)`: is one of the left sides one of the right ones?"""
    left: list[str] = []
    right: list[str] = []
    for formula in text.split("`")[1::2]:
        if " = " in formula and right:
            if _one_of(left, right, values):
                return True
            left, right = [], []
        head, _, tail = formula.rpartition(" = ")
        if head:
            left.append(head)
        (right if head or right else left).extend(_listed(tail))
    return _one_of(left, right, values)


def _listed(text: str) -> Iterator[str]:
    for value in text.split(", "):
        center, found, rest = value.rpartition("+-")
        yield from (f"{center}+({rest})", f"{center}-({rest})") if found else (value,)


def _one_of(left: list[str], right: list[str], values: Values) -> bool:
    pairs = product(left, right)
    return any(_is_true(f"{a} = {b}", values) for a, b in pairs)


def _kind(words: str) -> Callable[[Any], bool]:
    """Which numbers "an odd integer n" or "an integer = 1, 2 mod 5" means."""
    match = re.fullmatch(
        r"an (odd |even )?integer(?: \w+)?(?: not divisible by (\d+)| = ([\d, +-]+) mod (\d+))?", words.strip()
    )
    if match is None:
        raise NotReadError(words)
    parity, divisor, residues, modulus = match.groups()

    def belongs(number: Any) -> bool:
        if not number.is_Integer:
            return False
        if parity is not None:
            return bool(number % 2 == (parity == "odd "))
        if divisor is not None:
            return bool(number % int(divisor) != 0)
        return residues is None or number % int(modulus) in {int(r) % int(modulus) for r in _listed(residues)}

    return belongs


def _integer(text: str, letter: str, values: Values) -> bool:
    if match := re.fullmatch(r"`([^`]*) in Z`", text):
        return bool(read(match[1], values).is_Integer)
    if match := re.fullmatch(r"`([^`]*) = ([^`=]*) mod ([^`]*)`", text):
        form, modulus = read(match[1], values), sympy.Rational(match[3])
        return any(((form - read(residue, {})) / modulus).is_Integer for residue in _listed(match[2]))
    if match := re.fullmatch(r"`([^`]*)` is (.*)", text):
        belongs = _kind(match[2])
        return any(belongs(sympy.simplify(read(form, values))) for form in _signs(match[1]))
    match = re.fullmatch(r"`([^`]*)`( \(.*\))?( for .*)", text)
    if match is None:
        raise NotReadError(text)
    equation, note, rest = match.groups()
    for n in _possible(rest, letter, values):
        there = {**values, letter: n}
        zero = re.findall(rf"`([^`]*) = 0` where `{letter} = ([^`]*)`", note or "")
        special = [factor for factor, root in zero if read(root, values) == n]
        holds = any(read(f, values) == 0 for f in special) if special else _has_value(equation, there)
        if holds:
            return True
    return False


def _has_value(equation: str, values: Values) -> bool:
    left, right = (read(side, values) for side in equation.split(" = "))
    return bool(right.is_finite) and _is_zero(left - right)


def _signs(text: str) -> Iterator[str]:
    """Each choice of the signs in a +- b +- c."""
    pieces = text.split(" +- ")
    for signs in product((" + ", " - "), repeat=len(pieces) - 1):
        tail = "".join(f"{sign}({piece})" for sign, piece in zip(signs, pieces[1:], strict=True))
        yield f"({pieces[0]}){tail}"


def _possible(rest: str, letter: str, values: Values) -> Iterator[Any]:
    """The numbers n that the end of a sentence allows."""
    n = sympy.Symbol(letter)
    if match := re.fullmatch(r" for (an .*)", rest):
        belongs = _kind(match[1])
        yield from (sympy.Integer(k) for k in RANGE if belongs(sympy.Integer(k)))
    elif match := re.fullmatch(rf" for a number `{letter}` with `([^`]*) in Z`", rest):
        yield from (_solved(match[1], k, n, values) for k in RANGE)
    elif match := re.fullmatch(rf" for a number `{letter}` with `([^`]*)` or `([^`]*) in N`", rest):
        yield from (_solved(form, k, n, values) for form in match.groups() for k in RANGE if k >= 0)
    elif match := re.fullmatch(rf" for a number `{letter}` with `([^`]*)` (an .*)", rest):
        belongs = _kind(match[2])
        yield from (_solved(match[1], k, n, values) for k in RANGE if belongs(sympy.Integer(k)))
    else:
        raise NotReadError(rest)


def _solved(form: str, k: int, n: Any, values: Values) -> Any:
    """The n for which a linear form is k."""
    expression = sympy.expand(read(form, values))
    return (k - expression.coeff(n, 0)) / expression.coeff(n, 1)
