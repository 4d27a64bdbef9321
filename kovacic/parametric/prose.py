"""Claims in words and formulas: the one place where a statement about parameters becomes a sentence.

Each kind of claim has a writer, which makes one line with formulas between backquotes.  A line becomes a tuple of words and
formulas, each a `Math` with text and LaTeX, from which every format is made.
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
    EVEN,
    INTEGERS,
    ODD,
    AllOf,
    AnyOf,
    Claim,
    Classes,
    DegreeBySum,
    DegreeExists,
    EquationFor,
    InClasses,
    IntegerFamily,
    IsNonzero,
    IsZero,
    SumOfRoots,
    degrees,
    irreducible_factors,
    laurent_constant_term,
    numerator,
    over_parameters,
    rational_number,
)
from kovacic.parametric.formulas import (
    alone,
    in_product,
    in_sum,
    root_written,
    shifted,
    shortest_form,
    sides_of_equation,
)
from kovacic.writing.formula import Math

#: Words and formulas, one after the other.
Words = tuple[str | Math, ...]


def phrase(literal: str) -> Words:
    """The words and formulas in a line with formulas between backquotes."""
    pieces = enumerate(literal.split("`"))
    return tuple(Math.of(piece) if k % 2 else piece for k, piece in pieces if piece)


def latex_of_claim(claim: Claim) -> str:
    """The claim in LaTeX, without dollar signs."""
    parts = (part.latex if isinstance(part, Math) else rf"\text{{{part}}} " for part in sentence(claim))
    return "".join(parts).strip()


@lru_cache(maxsize=1024)
def sentence(claim: Claim) -> Words:
    """The claim in words and formulas."""
    return phrase(_claim_line(claim))


def _claim_line(claim: Claim) -> str:
    """The line by the writer for this kind of claim."""
    return next(WRITERS[kind](claim) for kind in type(claim).__mro__ if kind in WRITERS)


# ------------------------------------------------------------------------------- integers


def equals(name: str, value: Poly | RatFunc, letter: str) -> str:
    """E = f(n), with the function in its shortest form."""
    return f"{alone(name)} = {shortest_form(value, letter)}"


def _alternatives(formulas: Sequence[str]) -> str:
    """`a`, `b` or `c`."""
    *several, last = (f"`{formula}`" for formula in formulas)
    return " or ".join([*filter(None, [", ".join(several)]), last])


#: Classes of integers that have a name.
_PROSE_OF_KIND = {
    INTEGERS: "an integer",
    EVEN: "an even integer",
    ODD: "an odd integer",
}


def _congruent(form: str, numbers: Classes) -> str:
    """`n = 1, 2 mod 5`, or `n = +-1/6, 1/2 mod 1` if r and -r come in pairs."""
    residues, modulus = numbers.residues, numbers.modulus
    texts = [*map(str, residues)]
    if {-residue % modulus for residue in residues} == {*residues}:
        half = modulus / 2
        single = [residue for residue in dict.fromkeys(residues) if residue <= half]
        texts = [str(residue) if residue in (0, half) else f"+-{residue}" for residue in single]
    return f"{form} = {', '.join(texts)} mod {modulus}".lstrip()


def _kind(numbers: Classes, letter: str = "") -> str:
    """The kind of such an integer, with its name if it has one: "an odd integer n", "an integer not divisible by 3"."""
    name = f" `{letter}`" if letter else ""
    if numbers in _PROSE_OF_KIND:
        return _PROSE_OF_KIND[numbers] + name
    if numbers.residues == tuple(range(1, int(numbers.modulus))):
        return f"an integer{name} not divisible by {numbers.modulus}"
    return f"an integer `{_congruent(letter, numbers)}`"


# ------------------------------------------------------------------------------- claims


def equation_of_zeros(zero: FunctionPoly, relation: str = "=") -> Math:
    """The equation that a function vanishes, or the inequation with !=, solved for a parameter if that is simple."""
    sides = sides_of_equation(zero)
    return Math.of(f"{alone(sides.left)} {relation} {sides.right}")


def _zero_or_not(claim: IsZero | IsNonzero) -> str:
    return f"`{equation_of_zeros(claim.function, '=' if isinstance(claim, IsZero) else '!=').text}`"


def _modulo_integers(form: FunctionPoly) -> str:
    """2*n - 1/2: the form with its constant term reduced modulo 1."""
    constant = laurent_constant_term(form)
    shift = f" - {-constant % 1}" if constant.denominator > 1 else ""
    return shortest_form(form - constant) + shift


def _in_classes(claim: InClasses) -> str:
    numbers = claim.numbers
    if numbers == INTEGERS:
        return f"`{_modulo_integers(claim.form)} in Z`"
    form = shortest_form(claim.form)
    if numbers in _PROSE_OF_KIND:
        return f"`{form}` is {_kind(numbers)}"
    return f"`{_congruent(form, numbers)}`"


def _sum_of_roots(claim: SumOfRoots) -> str:
    """The formula of the sum."""
    mean = [shortest_form(claim.mean)] if claim.mean else []
    return " +- ".join([*mean, *map(root_written, claim.squares)])


def _head(family: IntegerFamily | EquationFor) -> str:
    """`E = f(n)`, with its poles."""
    if isinstance(family, EquationFor):
        return _unsolved(family)
    return f"`{equals(family.parameter, family.value, family.letter)}`{_about_poles([family])}"


def poles_in_words(families: Iterable[IntegerFamily]) -> list[str]:
    """`Z = 0` where `n = l`, for each pole, each once."""
    found: dict[str, None] = {}
    for family in families:
        for pole in family.poles:
            texts = [*map(shortest_form, irreducible_factors(pole.zero))]
            product = texts[0] if len(texts) == 1 else "*".join(map(in_product, texts))
            found[f"`{product} = 0` where `{equals(family.letter, pole.root, family.letter)}`"] = None
    return [*found]


def _about_poles(families: Iterable[IntegerFamily]) -> str:
    poles = poles_in_words(families)
    return f" ({', '.join(poles)})" if poles else ""


def numbers_of(family: IntegerFamily | EquationFor) -> str:
    """` for an odd integer n`."""
    return f" for {_kind(family.numbers, family.letter)}"


def _unsolved(claim: EquationFor) -> str:
    """`d = 5` without parameters, otherwise the equation that the numerator vanishes."""
    f = claim.equation
    if not any(degrees(f)) and f.degree == 1:
        return f"`{equals(claim.letter, -f[0] / f[1], claim.letter)}`"
    return f"`{shortest_form(numerator(f), claim.letter)} = 0`"


# ------------------------------------------------------------------------------- several claims


def _all_of(claim: AllOf) -> str:
    # Alternatives are in parentheses, unless they are values of one parameter.
    are_long = (isinstance(part, AnyOf) and _of_one_value(part.parts) is None for part in claim.parts)
    parts = zip(are_long, map(_claim_line, claim.parts), strict=True)
    return ", and ".join(f"({line})" if is_long else line for is_long, line in parts)


def _any_of(claim: AnyOf) -> str:
    """Alternatives, with their common parts stated once."""
    parts = claim.parts
    for together in (_of_one_value, _of_common_numbers, _of_one_kind):
        found = together(parts)
        if found is not None:
            return found
    # All others contain a comma or a "for".
    are_short = all(
        isinstance(part, IsZero | SumOfRoots)
        or (isinstance(part, InClasses) and (len(part.numbers.residues) == 1 or part.numbers in _PROSE_OF_KIND))
        for part in parts
    )
    return (" or " if are_short else ", or ").join(map(_claim_line, parts))


def _of_one_value(parts: Sequence[Claim]) -> str | None:
    """`n = 0` or `-1`, if all are equations with the same left side."""
    sides = [sides_of_equation(part.function) for part in parts if isinstance(part, IsZero)]
    left = {side.left for side in sides}
    if len(sides) != len(parts) or len(left) != 1:
        return None
    first, *others = (side.right for side in sides)
    return _alternatives([f"{left.pop()} = {first}", *others])


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
            forms.append(_sum_of_roots(part))
        elif isinstance(part, InClasses) and part.numbers != INTEGERS and part.numbers in _PROSE_OF_KIND:
            forms.append(shortest_form(part.form))
        elif isinstance(part, InClasses) and part.numbers == INTEGERS and len(parts) > 2:
            forms.append(_modulo_integers(part.form))
        else:
            return None
        numbers.add(part.numbers)
    if len(numbers) != 1:
        return None
    return f"{'one of ' if len(forms) > 2 else ''}{_alternatives(forms)} is {_kind(numbers.pop())}"


# ------------------------------------------------------------------------------- natural numbers


def _natural_alternatives(claim: AnyOf, letter: str) -> str:
    """`b = +-2*(d + 1)`, `n = 2*d, 2*d + 1 or -2*d - 3`, `n or -n - 1 = 2*d or 2*d + 1`, and the claims on strata."""
    by_name: dict[str, list[IntegerFamily]] = {}
    said = list[str]()
    strata = ""
    for part in claim.parts:
        if isinstance(part, IntegerFamily):
            by_name.setdefault(part.parameter, []).append(part)
        elif isinstance(part, EquationFor):
            said.append(_unsolved(part))
        elif isinstance(part, AllOf):
            there, where = part.parts
            strata += f", or {_natural_numbers(there, letter)} where {_claim_line(where)}"
    for name, families in by_name.items():
        said.append(_one_of(name, [family.value for family in families], letter) + _about_poles(families))
    return " or ".join(said) + strata


def _natural_numbers(claim: Claim, letter: str) -> str:
    """The natural numbers that the exponents allow."""
    return _natural_alternatives(claim, letter) if isinstance(claim, AnyOf) else _claim_line(claim)


def _one_of(name: str, functions: Sequence[RatFunc], letter: str) -> str:
    """The phrase that a parameter is one of the functions; c + f and c - f, c free of the integer, are one formula `c +- f`.

    For functions in pairs with the same sum, a number c, it or c minus it is one of them: n or -n - 1 in Lame's equation.
    """

    def begins_with_minus(f: RatFunc) -> bool:
        return shortest_form(f, letter).lstrip("(").startswith("-")

    said: list[str] = []
    left = [*functions]
    start = ""
    total = _sum_in_pairs(functions)
    if total is not None:
        start = f"`{name}` or "
        pairs = [sorted((f, RatFunc(total) - f), key=str) for f in functions]
        left = [*dict.fromkeys(min(pair, key=begins_with_minus) for pair in pairs)]
        name = shortest_form(total - total.field.generator(name), letter)
    while left:
        f = left.pop(0)
        other = next((g for g in left if _have_a_center(f, g)), None)
        if other is None:
            said.append(shortest_form(f, letter))
            continue
        left.remove(other)
        center = (f + other) / 2
        value = in_sum(shortest_form(min(other - center, f - center, key=begins_with_minus), letter))
        said.append(f"{shortest_form(center, letter)} +- {value}" if center else f"+-{value}")
    return start + _alternatives([f"{name} = {said[0]}", *said[1:]])


def _sum_in_pairs(functions: Sequence[RatFunc]) -> FunctionPoly | None:
    """The number, not 0, that is the sum of each function and another one; None if there is none, or a single pair."""
    if len(functions) < 4:
        return None
    for other in functions[1:]:
        total = functions[0] + other
        is_number = total.is_polynomial and rational_number(total.num) is not None
        if total and is_number and all(total - f in functions and 2 * f != total for f in functions):
            return over_parameters(total.num)
    return None


def _have_a_center(f: RatFunc, g: RatFunc) -> bool:
    """True if their sum is 0, or a function of the parameters, without the integer, that isn't a number."""
    total = f + g
    return not total or (total.num.degree == total.den.degree == 0 and rational_number(total.num) is None)


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
    IsZero: _zero_or_not,
    IsNonzero: _zero_or_not,
    AllOf: _all_of,
    AnyOf: _any_of,
    InClasses: _in_classes,
    SumOfRoots: lambda claim: f"`{_sum_of_roots(claim)}` is {_kind(claim.numbers)}",
    IntegerFamily: lambda claim: _head(claim) + numbers_of(claim),
    EquationFor: lambda claim: _head(claim) + numbers_of(claim),
    DegreeBySum: _degree_by_sum,
    DegreeExists: _degree_exists,
}
