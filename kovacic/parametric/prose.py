"""Claims in words and formulas: the one place where a statement about parameters becomes a sentence.

Each kind of claim has a writer, which makes one line with formulas between backquotes.  A line becomes a tuple of words and
formulas, `Math`, which has its LaTeX beside its text; every format is made from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from typing import Any

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.parametric.claims import (
    AllOf,
    AnyOf,
    Claim,
    DegreeBySum,
    DegreeExists,
    EquationFor,
    InClasses,
    IntegerFamily,
    IsNonzero,
    IsZero,
    SumOfRoots,
)
from kovacic.parametric.formulas import (
    alone,
    in_product,
    in_sum,
    root_written,
    shifted,
    sides_of_equation,
    written,
)
from kovacic.parametric.functions import (
    INTEGERS,
    Classes,
    constant_term,
    degrees,
    irreducible_factors,
    numerator,
    over_parameters,
)
from kovacic.writing.formula import Math

#: Words and formulas, one after the other.
Words = tuple[str | Math, ...]


def phrase(literal: str) -> Words:
    """Words and formulas, written in one line: formulas stand between backquotes."""
    pieces = enumerate(literal.split("`"))
    return tuple(Math.of(piece) if k % 2 else piece for k, piece in pieces if piece)


def text(claim: Claim) -> str:
    """In one line."""
    return text_of(sentence(claim))


def latex(claim: Claim) -> str:
    """In LaTeX, without dollar signs."""
    parts = (part.latex if isinstance(part, Math) else rf"\text{{{part}}} " for part in sentence(claim))
    return "".join(parts).strip()


def text_of(words: Words) -> str:
    return "".join(part.text if isinstance(part, Math) else part for part in words)


@lru_cache(maxsize=1024)
def sentence(claim: Claim) -> Words:
    """The claim in words and formulas."""
    return phrase(_line(claim))


def _line(claim: Claim) -> str:
    """By the writer of its kind."""
    return next(WRITERS[kind](claim) for kind in type(claim).__mro__ if kind in WRITERS)


# ------------------------------------------------------------------------------- integers


def equals(name: str, value: Poly | RatFunc, letter: str) -> str:
    """`E = f(n)`, in the shortest form of the function."""
    return f"{alone(name)} = {written(value, letter)}"


def _listed(formulas: Sequence[str]) -> str:
    """`a`, `b` or `c`."""
    *several, last = (f"`{formula}`" for formula in formulas)
    return " or ".join([*filter(None, [", ".join(several)]), last])


#: Classes of integers that have a name, by the modulus and the residues.
_PROSE_OF_KIND = {
    INTEGERS: "an integer",
    Classes.of([0], 2): "an even integer",
    Classes.of([1], 2): "an odd integer",
}


def _congruent(form: str, numbers: Classes) -> str:
    """`n = 1, 2 mod 5`, or `n = +-1/6, 1/2 mod 1` where r and -r come in pairs."""
    residues, modulus = numbers.residues, numbers.modulus
    texts = [*map(str, residues)]
    if {-residue % modulus for residue in residues} == {*residues}:
        half = modulus / 2
        single = [residue for residue in dict.fromkeys(residues) if residue <= half]
        texts = [str(residue) if residue in (0, half) else f"+-{residue}" for residue in single]
    return f"{form} = {', '.join(texts)} mod {modulus}".lstrip()


def _kind(numbers: Classes, letter: str = "") -> str:
    """What an integer of these is, maybe with its name: "an odd integer n", "an integer not divisible by 3"."""
    noun = _PROSE_OF_KIND.get(numbers, "an integer")
    name = f" `{letter}`" if letter else ""
    if numbers in _PROSE_OF_KIND:
        return noun + name
    if numbers.residues == tuple(range(1, int(numbers.modulus))):
        return f"{noun}{name} not divisible by {numbers.modulus}"
    return f"{noun} `{_congruent(letter, numbers)}`"


# ------------------------------------------------------------------------------- claims


def equation(zero: FunctionPoly, relation: str = "=") -> Math:
    """The equation that a function vanishes, solved for a parameter if that is simple; or that it doesn't, with !=."""
    sides = sides_of_equation(zero)
    return Math.of(f"{alone(sides.left)} {relation} {sides.right}")


def _equation(claim: IsZero | IsNonzero) -> str:
    return f"`{equation(claim.function, '=' if isinstance(claim, IsZero) else '!=').text}`"


def _modulo_integers(form: FunctionPoly) -> str:
    """2*n - 1/2: of the constant term only what it is modulo 1."""
    constant = constant_term(form)
    shift = f" - {-constant % 1}" if constant.denominator > 1 else ""
    return written(form - constant) + shift


def _in_classes(claim: InClasses) -> str:
    numbers = claim.numbers
    if numbers == INTEGERS:
        return f"`{_modulo_integers(claim.form)} in Z`"
    form = written(claim.form)
    if numbers in _PROSE_OF_KIND:
        return f"`{form}` is {_kind(numbers)}"
    return f"`{_congruent(form, numbers)}`"


def _roots(claim: SumOfRoots) -> str:
    """The sum, without what it is."""
    mean = [written(claim.mean)] if claim.mean else []
    return " +- ".join([*mean, *map(root_written, claim.squares)])


def _head(family: IntegerFamily | EquationFor) -> str:
    """`E = f(n)`, and what is said of poles."""
    if isinstance(family, EquationFor):
        return _unsolved(family)
    return f"`{equals(family.parameter, family.value, family.letter)}`{_about_poles([family])}"


def poles_of(families: Iterable[IntegerFamily]) -> list[str]:
    """`Z = 0` where `n = l`, for each pole, each once."""
    found: dict[str, None] = {}
    for family in families:
        for pole in family.poles:
            texts = [*map(written, irreducible_factors(pole.zero))]
            product = texts[0] if len(texts) == 1 else "*".join(map(in_product, texts))
            found[f"`{product} = 0` where `{equals(family.letter, pole.root, family.letter)}`"] = None
    return [*found]


def _about_poles(families: Iterable[IntegerFamily]) -> str:
    poles = poles_of(families)
    return f" ({', '.join(poles)})" if poles else ""


def numbers_of(family: IntegerFamily | EquationFor) -> str:
    """` for an odd integer n`."""
    return f" for {_kind(family.numbers, family.letter)}"


def _unsolved(claim: EquationFor) -> str:
    """`d = 5` without parameters, else that the numerator vanishes."""
    f = claim.equation
    if not any(degrees(f)) and f.degree == 1:
        return f"`{equals(claim.letter, -f[0] / f[1], claim.letter)}`"
    return f"`{written(numerator(f), claim.letter)} = 0`"


# ------------------------------------------------------------------------------- several claims


def _all_of(claim: AllOf) -> str:
    said: list[str] = []
    for part in claim.parts:
        # Alternatives are in parentheses, unless they are those of one value.
        is_long = isinstance(part, AnyOf) and _of_one_value(part.parts) is None
        said.append(f"({_line(part)})" if is_long else _line(part))
    return ", and ".join(said)


def _any_of(claim: AnyOf) -> str:
    """Alternatives, what is common to all of them said once."""
    parts = claim.parts
    for together in (_of_one_value, _of_common_numbers, _of_one_kind):
        found = together(parts)
        if found is not None:
            return found
    # A comma, or a "for", stands in all others.
    are_short = all(
        isinstance(part, IsZero | SumOfRoots)
        or (isinstance(part, InClasses) and (len(part.numbers.residues) == 1 or part.numbers in _PROSE_OF_KIND))
        for part in parts
    )
    return (" or " if are_short else ", or ").join(map(_line, parts))


def _of_one_value(parts: Sequence[Claim]) -> str | None:
    """`n = 0` or `-1`, where all are equations with the same left side."""
    sides = [sides_of_equation(part.function) for part in parts if isinstance(part, IsZero)]
    if not 1 < len(sides) == len(parts) or len({side.left for side in sides}) > 1:
        return None
    first, *others = (side.right for side in sides)
    return _listed([f"{sides[0].left} = {first}", *others])


def _of_common_numbers(parts: Sequence[Claim]) -> str | None:
    """`E = f` or `E = g` for an integer `n`."""
    families = [part for part in parts if isinstance(part, IntegerFamily | EquationFor)]
    ends = {*map(numbers_of, families)}
    if len(families) != len(parts) or len(ends) != 1:
        return None
    return " or ".join(map(_head, families)) + ends.pop()


def _of_one_kind(parts: Sequence[Claim]) -> str | None:
    """One of `a`, `b` or `c` is an odd integer."""
    forms: list[str] = []
    numbers: set[Classes] = set()
    for part in parts:
        if isinstance(part, SumOfRoots):
            forms.append(_roots(part))
        elif isinstance(part, InClasses) and part.numbers != INTEGERS and part.numbers in _PROSE_OF_KIND:
            forms.append(written(part.form))
        elif isinstance(part, InClasses) and part.numbers == INTEGERS and len(parts) > 2:
            forms.append(_modulo_integers(part.form))
        else:
            return None
        numbers.add(part.numbers)
    if len(numbers) != 1:
        return None
    return f"{'one of ' if len(forms) > 2 else ''}{_listed(forms)} is {_kind(numbers.pop())}"


# ------------------------------------------------------------------------------- natural numbers


def _alternatives(claim: AnyOf, letter: str) -> str:
    """`b = +-2*(d + 1)`, `n = 2*d, 2*d + 1 or -2*d - 3`, `n or -n - 1 = 2*d or 2*d + 1`, and what holds on strata."""
    by_name: dict[str, list[IntegerFamily]] = {}
    said: list[str] = []
    strata = ""
    for part in claim.parts:
        if isinstance(part, IntegerFamily):
            by_name.setdefault(part.parameter, []).append(part)
        elif isinstance(part, EquationFor):
            said.append(_unsolved(part))
        elif isinstance(part, AllOf):
            there, where = part.parts
            strata += f", or {_natural_numbers(there, letter)} where {_line(where)}"
    for name, families in by_name.items():
        said.append(_one_of(name, [family.value for family in families], letter) + _about_poles(families))
    return " or ".join(said) + strata


def _natural_numbers(claim: Claim, letter: str) -> str:
    """The natural numbers that the exponents allow."""
    return _alternatives(claim, letter) if isinstance(claim, AnyOf) else _line(claim)


def _one_of(name: str, functions: Sequence[RatFunc], letter: str) -> str:
    """The phrase that a parameter is one of the functions; c + f and c - f, c free of the integer, are one formula `c +- f`.

    Where they come in pairs whose sum is a number c, that it or c minus it is one: n or -n - 1 in Lame's equation.
    """

    def begins_with_minus(f: RatFunc) -> bool:
        return written(f, letter).lstrip("(").startswith("-")

    said: list[str] = []
    left = [*functions]
    start = ""
    total = _sum_in_pairs(functions)
    if total is not None:
        start = f"`{name}` or "
        pairs = [sorted((f, RatFunc(total) - f), key=str) for f in functions]
        left = [*dict.fromkeys(min(pair, key=begins_with_minus) for pair in pairs)]
        name = written(total - total.field.generator(name), letter)
    while left:
        f = left.pop(0)
        other = next((g for g in left if _have_a_center(f, g)), None)
        if other is None:
            said.append(written(f, letter))
            continue
        left.remove(other)
        center = (f + other) / 2
        value = in_sum(written(min(other - center, f - center, key=begins_with_minus), letter))
        said.append(f"{written(center, letter)} +- {value}" if center else f"+-{value}")
    return start + _listed([f"{name} = {said[0]}", *said[1:]])


def _sum_in_pairs(functions: Sequence[RatFunc]) -> FunctionPoly | None:
    """A number, not 0, of which each function has another one that makes it up; None without one, or with two pairs."""
    if len(functions) < 4:
        return None
    for other in functions[1:]:
        total = functions[0] + other
        is_number = total.is_polynomial and total.field.rational_value(total.num) is not None
        if total and is_number and all(total - f in functions and 2 * f != total for f in functions):
            return over_parameters(total.num)
    return None


def _have_a_center(f: RatFunc, g: RatFunc) -> bool:
    """True where their sum is 0, or a function of the parameters without the integer in it."""
    total = f + g
    is_free = total.num.degree <= 0 and total.den.degree <= 0
    return not total or (is_free and total.field.rational_value(total.num) is None)


def _degree_by_sum(claim: DegreeBySum) -> str:
    sums = claim.sums
    if not claim.names:  # d - constant = +-sqrt(b) +- c
        roots = [in_sum(root_written(square)) for square in sums.squares]
        return f"`{shifted(claim.letter, QQ.poly([sums.constant]))} = +-{' +- '.join(roots)}`"
    terms = [in_sum(root_written(square, name)) for square, name in zip(sums.squares, claim.names, strict=True)]
    bounds = (f"`{k}` from -{root.largest} to {root.largest}" for k, root in zip(claim.names, sums.roots, strict=True))
    said = f"`{claim.letter} = {' + '.join([str(sums.constant), *terms])}` for integers {', '.join(bounds)}"
    not_zero = ", not 0" if len(claim.names) == 1 else ", not all 0"
    return said if claim.has_zero else said + not_zero


def _degree_exists(claim: DegreeExists) -> str:
    d = claim.letter
    said = f"{_natural_numbers(claim.degree, d)}, `{d} in N`, and `Delta_{d} = 0`"
    return said if claim.m == 1 else f"{said} for an invariant of degree {claim.m}"


#: How each kind of claim is written; `riemann` adds its own.
WRITERS: dict[type, Callable[[Any], str]] = {
    IsZero: _equation,
    IsNonzero: _equation,
    AllOf: _all_of,
    AnyOf: _any_of,
    InClasses: _in_classes,
    SumOfRoots: lambda claim: f"`{_roots(claim)}` is {_kind(claim.numbers)}",
    IntegerFamily: lambda claim: _head(claim) + numbers_of(claim),
    EquationFor: lambda claim: _head(claim) + numbers_of(claim),
    DegreeBySum: _degree_by_sum,
    DegreeExists: _degree_exists,
}
