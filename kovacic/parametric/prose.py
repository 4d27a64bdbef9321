"""Claims in words and formulas: the one place where a statement about parameters becomes a sentence.

A sentence is a tuple of words and formulas, `Math`, which has its LaTeX beside its text; every format is made from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
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
    SidesOfEquation,
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
from kovacic.writing.formula import Math, latex_text

#: Words and formulas, one after the other.
Words = tuple[str | Math, ...]


#: Of the identity component of a group.
ABELIAN: Words = ("abelian",)
NOT_ABELIAN: Words = ("not abelian",)


def phrase(literal: str) -> Words:
    """Words and formulas, written in one line: formulas stand between backquotes."""
    pieces = enumerate(literal.split("`"))
    return tuple(Math.of(piece) if k % 2 else piece for k, piece in pieces if piece)


def marked(words: Words) -> str:
    """The line from which `phrase` makes the same."""
    return "".join(f"`{part.text}`" if isinstance(part, Math) else part for part in words)


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
    """What is said, by the writer of its kind."""
    found: list[str | Math] = []
    writer = next(_WRITERS[one] for one in type(claim).__mro__ if one in _WRITERS)
    for part in writer(claim):
        if found and isinstance(part, str) and isinstance(found[-1], str):
            found[-1] += part
        else:
            found.append(part)
    return tuple(found)


# ------------------------------------------------------------------------------- formulas with signs beside functions


def function(value: Poly | RatFunc, letter: str = "x") -> str:
    """The shortest form of a function of the parameters and a number."""
    return written(value if isinstance(value, RatFunc) else over_parameters(value), letter)


def equals(name: str, value: Poly | RatFunc, letter: str) -> Math:
    return Math.of(f"{alone(name)} = {function(value, letter)}")


def congruent(form: Math, residues: str, modulus: Fraction) -> Math:
    """`n = 1, 2 mod 5`."""
    return Math(
        f"{form.text} = {residues} mod {modulus}",
        rf"{form.latex} \equiv {latex_text(residues)} \pmod{{{latex_text(str(modulus))}}}",
    )


# ------------------------------------------------------------------------------- classes of integers


#: Classes of integers that have a name, by the modulus and the residues.
_PROSE_OF_KIND = {
    INTEGERS: "an integer",
    Classes.of([0], 2): "an even integer",
    Classes.of([1], 2): "an odd integer",
}


def classes(residues: Sequence[Fraction], modulus: Fraction) -> str:
    """Classes modulo a number: `1, 2`, or `+-1/6, 1/2` where r and -r come in pairs."""
    if {-residue % modulus for residue in residues} != {*residues}:
        return ", ".join(map(str, residues))
    half = modulus / 2
    texts = []
    for residue in dict.fromkeys(residues):
        if residue in (0, half):
            texts.append(str(residue))
        elif residue < half:
            texts.append(f"+-{residue}")
    return ", ".join(texts)


def kind(numbers: Classes, letter: str = "") -> Words:
    """What an integer of these is, maybe with its name: "an odd integer n", "an integer not divisible by 3"."""
    noun = _PROSE_OF_KIND.get(numbers)
    name: Words = (" ", Math.of(letter)) if letter else ()
    if noun is not None:
        return (noun, *name)
    residues = numbers.residues
    if len(residues) > 1 and residues == tuple(range(1, int(numbers.modulus))):
        return ("an integer", *name, f" not divisible by {numbers.modulus}")
    listed = classes(residues, numbers.modulus)
    if not letter:
        return ("an integer", congruent(Math("", ""), listed, numbers.modulus))
    return ("an integer ", congruent(Math.of(letter), listed, numbers.modulus))


def is_named(numbers: Classes) -> bool:
    """True where `kind` has a word for the numbers."""
    return numbers in _PROSE_OF_KIND


# ------------------------------------------------------------------------------- claims


def equation(zero: FunctionPoly, relation: str = "=") -> Math:
    """The equation that a function vanishes, solved for a parameter if that is simple; or that it doesn't, with !=."""
    sides = sides_of_equation(zero)
    return Math.of(f"{alone(sides.left)} {relation} {sides.right}")


def _modulo_integers(form: FunctionPoly) -> str:
    """2*n - 1/2: of the constant term only what it is modulo 1."""
    constant = constant_term(form)
    shift = f" - {-constant % 1}" if constant.denominator > 1 else ""
    return function(form - constant) + shift


def _in_classes(claim: InClasses) -> Words:
    numbers = claim.numbers
    if numbers == INTEGERS:
        return (Math.of(f"{_modulo_integers(claim.form)} in Z"),)
    form = Math.of(function(claim.form))
    if is_named(numbers):
        return (form, " is ", *kind(numbers))
    return (congruent(form, classes(numbers.residues, numbers.modulus), numbers.modulus),)


def roots_of(claim: SumOfRoots) -> Math:
    """The sum, without what it is."""
    terms = [*map(root_written, claim.squares)]
    if claim.mean:
        terms.insert(0, function(claim.mean))
    return Math.of(" +- ".join(terms))


def head_of(family: IntegerFamily | EquationFor) -> Words:
    """`E = f(n)`, and what is said of poles."""
    if isinstance(family, EquationFor):
        return (_unsolved(family),)
    return (equals(family.parameter, family.value, family.letter), *_in_parentheses(poles_of([family])))


def poles_of(families: Iterable[IntegerFamily]) -> list[Words]:
    """`Z = 0 where n = l` for each pole, each once."""
    found: dict[Words, None] = {}
    for family in families:
        for pole in family.poles:
            factors = irreducible_factors(pole.zero)
            texts = [function(factor) for factor in factors]
            product = texts[0] if len(texts) == 1 else "*".join(map(in_product, texts))
            found[(Math.of(f"{product} = 0"), " where ", equals(family.letter, pole.root, family.letter))] = None
    return [*found]


def _in_parentheses(notes: Sequence[Words]) -> Words:
    if not notes:
        return ()
    return (" (", *_joined(notes, ", "), ")")


def numbers_of(family: IntegerFamily | EquationFor) -> Words:
    """` for an odd integer n`."""
    return (" for ", *kind(family.numbers, family.letter))


def _unsolved(claim: EquationFor) -> Math:
    """`d = 5` without parameters, else that the numerator vanishes."""
    f = claim.equation
    if not any(degrees(f)) and f.degree == 1:
        return equals(claim.letter, -f[0] / f[1], claim.letter)
    return Math.of(f"{function(numerator(f), claim.letter)} = 0")


# ------------------------------------------------------------------------------- several claims


def _all_of(claim: AllOf) -> Words:
    said: list[Words] = []
    for part in claim.parts:
        # Alternatives are in parentheses, unless they are those of one value.
        is_long = isinstance(part, AnyOf) and _sides_of_one_value(part.parts) is None
        said.append(("(", *sentence(part), ")") if is_long else sentence(part))
    return _joined(said, ", and ")


def _any_of(claim: AnyOf) -> Words:
    """Alternatives, what is common to all of them said once."""
    parts = claim.parts
    sides = _sides_of_one_value(parts)
    if sides is not None:
        first, *others, last = (right for _, right in sides)
        listed = _joined([(Math.of(f"{sides[0].left} = {first}"),), *((Math.of(one),) for one in others)], ", ")
        return (*listed, " or ", Math.of(last))
    for together in (_of_common_numbers, _of_one_kind):
        found = together(parts)
        if found is not None:
            return found
    # A comma, or a "for", stands in all others.
    are_short = all(
        isinstance(part, IsZero | SumOfRoots)
        or (isinstance(part, InClasses) and (len(part.numbers.residues) == 1 or is_named(part.numbers)))
        for part in parts
    )
    separator = " or " if are_short else ", or "
    return _joined([*map(sentence, parts)], separator)


def _sides_of_one_value(parts: Sequence[Claim]) -> list[SidesOfEquation] | None:
    """For "n = 0 or -1": the equations, where all have the same left side; else None."""
    zeros = [part for part in parts if isinstance(part, IsZero)]
    sides = [sides_of_equation(zero.function) for zero in zeros]
    is_one = 1 < len(zeros) == len(parts) and len({side.left for side in sides}) == 1
    return sides if is_one else None


def _of_common_numbers(parts: Sequence[Claim]) -> Words | None:
    """`E = f or E = g for an integer n`."""
    families = [part for part in parts if isinstance(part, IntegerFamily | EquationFor)]
    ends = {numbers_of(part) for part in families}
    if len(families) != len(parts) or len(ends) != 1:
        return None
    return (*_joined([*map(head_of, families)], " or "), *ends.pop())


def _of_one_kind(parts: Sequence[Claim]) -> Words | None:
    """`one of a, b or c is an odd integer`."""
    forms: list[Math] = []
    numbers: set[Classes] = set()
    for part in parts:
        if isinstance(part, SumOfRoots):
            forms.append(roots_of(part))
        elif isinstance(part, InClasses) and part.numbers != INTEGERS and is_named(part.numbers):
            forms.append(Math.of(function(part.form)))
        elif isinstance(part, InClasses) and part.numbers == INTEGERS and len(parts) > 2:
            forms.append(Math.of(_modulo_integers(part.form)))
        else:
            return None
        numbers.add(part.numbers)
    if len(numbers) != 1:
        return None
    *first, last = forms
    start: Words = ("one of ",) if len(first) > 1 else ()
    return (*start, *_joined([(form,) for form in first], ", "), " or ", last, " is ", *kind(numbers.pop()))


def _joined(parts: Sequence[Words], separator: str) -> Words:
    found: list[str | Math] = []
    for k, part in enumerate(parts):
        if k and separator:
            found.append(separator)
        found += part
    return tuple(found)


# ------------------------------------------------------------------------------- natural numbers


def _alternatives(claim: AnyOf, letter: str) -> Words:
    """`b = +-2*(d + 1)`, `n = 2*d, 2*d + 1 or -2*d - 3`, `n or -n - 1 = 2*d or 2*d + 1`, and what holds on strata."""
    by_name: dict[str, list[IntegerFamily]] = {}
    said: list[Words] = []
    strata: list[Words] = []
    for part in claim.parts:
        if isinstance(part, IntegerFamily):
            by_name.setdefault(part.parameter, []).append(part)
        elif isinstance(part, EquationFor):
            said.append((_unsolved(part),))
        elif isinstance(part, AllOf):
            there, where = part.parts
            strata += [(", or ", *_natural_numbers(there, letter), " where ", *sentence(where))]
    for name, families in by_name.items():
        values = _one_of(name, [family.value for family in families], letter)
        said.append((*values, *_in_parentheses(poles_of(families))))
    return (*_joined(said, " or "), *_joined(strata, ""))


def _natural_numbers(claim: Claim, letter: str) -> Words:
    """The natural numbers that the exponents allow."""
    return _alternatives(claim, letter) if isinstance(claim, AnyOf) else sentence(claim)


def _one_of(name: str, functions: Sequence[RatFunc], letter: str) -> Words:
    """The phrase that a parameter is one of the functions; c + f and c - f, c free of the integer, are one formula `c +- f`.

    Where they come in pairs whose sum is a number c, that it or c minus it is one: n or -n - 1 in Lame's equation.
    """
    said: list[Math] = []
    left = [*functions]
    start: Words = ()
    total = _sum_in_pairs(functions)
    if total is not None:
        start = (Math.of(name), " or ")
        # Of each pair the one that is written without a minus before it.
        pairs = [sorted((f, RatFunc(total) - f), key=str) for f in functions]
        left = [
            *dict.fromkeys(min(pair, key=lambda f: function(f, letter).lstrip("(").startswith("-")) for pair in pairs)
        ]
        name = function(total - total.field.generator(name), letter)
    while left:
        f = left.pop(0)
        other = next((g for g in left if _have_a_center(f, g)), None)
        if other is None:
            said.append(Math.of(function(f, letter)))
            continue
        left.remove(other)
        center = (f + other) / 2
        texts = [function(one - center, letter) for one in (other, f)]
        value = in_sum(min(texts, key=lambda text: text.lstrip("(").startswith("-")))  # without a minus before it
        said.append(Math.of(f"{function(center, letter)} +- {value}" if center else f"+-{value}"))
    first, *others = said
    found: list[str | Math] = [*start, Math.of(name).equals(first)]
    for k, one in enumerate(others, 1):
        found += [" or " if k == len(others) else ", ", one]
    return tuple(found)


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


def _degree_by_sum(claim: DegreeBySum) -> Words:
    constant = claim.sums.constant
    if not claim.names:  # d - constant = +-sqrt(b) +- c
        roots = [in_sum(root_written(square)) for square in claim.sums.squares]
        d = shifted(claim.letter, QQ.poly([constant]))
        return (Math.of(f"{d} = +-{' +- '.join(roots)}"),)
    terms = [str(constant)]
    bounds: list[Words] = []
    for name, square, root in zip(claim.names, claim.sums.squares, claim.sums.roots, strict=True):
        terms.append(in_sum(root_written(square, name)))
        bounds.append((Math.of(name), f" from -{root.largest} to {root.largest}"))
    said = (Math.of(f"{claim.letter} = {' + '.join(terms)}"), " for integers ", *_joined(bounds, ", "))
    if claim.has_zero:
        return said
    return (*said, ", not 0" if len(claim.names) == 1 else ", not all 0")


def _degree_exists(claim: DegreeExists) -> Words:
    d = claim.letter
    said = (*_natural_numbers(claim.degree, d), ", ", Math.of(f"{d} in N"), ", and ", Math.of(f"Delta_{d} = 0"))
    return said if claim.m == 1 else (*said, f" for an invariant of degree {claim.m}")


#: How each kind of claim is written; `riemann` adds its own.
_WRITERS: dict[type, Callable[[Any], Words]] = {
    IsZero: lambda claim: (equation(claim.function),),
    IsNonzero: lambda claim: (equation(claim.function, "!="),),
    AllOf: _all_of,
    AnyOf: _any_of,
    InClasses: _in_classes,
    SumOfRoots: lambda claim: (roots_of(claim), " is ", *kind(claim.numbers)),
    IntegerFamily: lambda claim: (*head_of(claim), *numbers_of(claim)),
    EquationFor: lambda claim: (*head_of(claim), *numbers_of(claim)),
    DegreeBySum: _degree_by_sum,
    DegreeExists: _degree_exists,
}


def writes(kinds: Mapping[type, Callable[[Any], Words]]) -> None:
    """Further kinds of claims."""
    _WRITERS.update(kinds)
