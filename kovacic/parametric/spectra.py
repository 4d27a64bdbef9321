"""Statements about integers as the literature writes them.

"A polynomial in N over Q(t) has an integer root in these classes" becomes a spectrum, E = -Z^2/(2*n^2) where n + l is an
integer, or a sum of square roots, sqrt(-E - b) +- sqrt(-E + b) +- (2*l + 1) is odd (for some of the signs).  The statements
are the same; nothing here decides anything.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import product
from math import floor
from operator import itemgetter

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import to_fraction
from kovacic.parametric.formulas import root_written, symbol, written
from kovacic.parametric.functions import degrees, irreducible_factors, numerator, over_parameters, powers_of
from kovacic.reading.given import ENERGY

#: What integers are called, the first that isn't a parameter.
LETTERS = "nNmMkKjJ"
#: Characters of a spectrum that is given beside two square roots; and by how many it may be longer than one square root.
_BESIDE, _LONGER = 90, 40
#: How much more the length of f(n) counts than that of what is said about n, and what it costs to solve for a later parameter.
_WEIGHT, _LATER = 3, 10


def families(equation: FunctionPoly, fixed: Collection[str] = ()) -> list[tuple[str, RatFunc]]:
    """`(name, f)` where a polynomial in N over Q(t) vanishes exactly if a parameter, not a `fixed` one, is f(N)."""
    names = equation.field.names
    found = []
    for i, k in enumerate(degrees(equation)):
        if k == 1 and names[i] not in fixed:
            parts = powers_of(equation, i)
            found.append((names[i], -RatFunc(parts.get(0, 0 * parts[1]), parts[1])))
    return found


def equation_text(equation: FunctionPoly, letter: str, fixed: Collection[str] = (), *, latex: bool = False) -> str:
    """`equation = 0`, solved for a parameter where one occurs linearly."""
    if not any(degrees(equation)) and equation.degree == 1:
        return f"{letter} = {written(-equation[0] / equation[1], latex=latex)}"
    known = families(equation, fixed)
    if not known:
        return f"{written(numerator(equation), letter, latex=latex)} = 0"
    name, f = known[0]
    return f"{symbol(name) if latex else name} = {written(f, letter, latex=latex)}"


def alternatives(
    equations: Sequence[FunctionPoly], letter: str, fixed: Collection[str] = (), *, latex: bool = False
) -> str:
    """That one of the equations holds: `b = +-2*(d + 1)`, `n = 2*d, 2*d + 1 or -2*d - 3`, `n or -n - 1 = 2*d or 2*d + 1`."""
    functions: dict[str, list[RatFunc]] = {}
    others: list[str] = []
    for equation in equations:
        family = families(equation, fixed) if any(degrees(equation)) else []
        if family:
            functions.setdefault(family[0][0], []).append(family[0][1])
        else:
            others.append(equation_text(equation, letter, fixed, latex=latex))
    word = r" \text{ or } " if latex else " or "
    for name, known in functions.items():
        what = symbol(name) if latex else name
        total = _sum_in_pairs(known)
        if total:
            mirrored = over_parameters(total - total.field.generator(name))
            what += word + written(mirrored, latex=latex)
            pairs = [(f, RatFunc(total) - f) for f in known]
            known = [*dict.fromkeys(min(sorted(p, key=str), key=partial(_starts_with_minus, letter)) for p in pairs)]
        texts = _with_signs(known, letter, latex)
        listed = texts if len(texts) < 3 else [", ".join(texts[:-1]), texts[-1]]
        others.append(f"{what} = {word.join(listed)}")
    return word.join(others)


def _sum_in_pairs(functions: Sequence[RatFunc]) -> FunctionPoly | None:
    """A constant, not 0, of which each function has another one that makes it up; None where there isn't one, or two pairs."""
    for other in functions[1:] if len(functions) > 3 else ():
        total = functions[0] + other
        if (
            total
            and total.is_polynomial
            and total.num.degree == 0
            and total.field.rational_value(total.num) is not None
        ):
            mirrored = [total - f for f in functions]
            if all(f in functions and f != g for f, g in zip(mirrored, functions, strict=True)):
                return over_parameters(total.num)
    return None


def _with_signs(functions: Sequence[RatFunc], letter: str, latex: bool) -> list[str]:
    """How the functions are written, with one text for f and -f."""
    known: list[RatFunc] = []
    texts: list[str] = []
    for f in functions:
        if -f in known:
            k = known.index(-f)
            texts[k] = min((written(g, letter, latex=latex) for g in (f, -f)), key=lambda text: text.startswith("-"))
            texts[k] = (r"\pm " if latex else "+-") + (texts[k] if not _is_sum(texts[k]) else f"({texts[k]})")
        else:
            known.append(f)
            texts.append(written(f, letter, latex=latex))
    return texts


def _starts_with_minus(letter: str, f: RatFunc) -> bool:
    return written(f, letter).lstrip("(").startswith("-")


def _is_sum(text: str) -> bool:
    outside = re.sub(r"[({][^()]*[)}]", "", text)
    return " + " in outside or " - " in outside


def classes_text(residues: Sequence[Fraction | int], modulus: Fraction | int) -> str:
    """What an integer in these classes is, with its article: "an odd integer"."""
    if modulus == 1 and not any(residues):
        return "an integer"
    if modulus == 2 and list(residues) in ([0], [1]):
        return f"an {'odd' if residues[0] else 'even'} integer"
    if len(residues) > 1 and list(residues) == list(range(1, int(modulus))):
        return f"an integer not divisible by {modulus}"
    return f"an integer = {', '.join(map(str, residues))} mod {modulus}"


def integer_condition(
    equation: FunctionPoly,
    residues: Sequence[int],
    modulus: int,
    letter: str,
    fixed: Collection[str] = (),
    *,
    latex: bool = False,
) -> str:
    """That a polynomial in N over Q(t) has an integer root in these classes; `letter` is what N is called."""
    spectrum, roots = _spectrum(equation, residues, modulus, letter, fixed, latex), _roots(equation)
    sum_of_roots = None if roots is None else _sum_of_roots(*roots, residues, modulus, latex)
    if sum_of_roots is None:
        return spectrum or _for_integers(
            equation_text(equation, letter, fixed, latex=latex), letter, residues, modulus, latex
        )
    if spectrum is None:
        return sum_of_roots
    if roots is not None and len(roots[1]) > 1:
        that_is = r"\text{, that is }" if latex else ", that is "
        short = len(_spectrum(equation, residues, modulus, letter, fixed, False) or "") <= _BESIDE
        return f"{sum_of_roots}{that_is}{spectrum}" if short else sum_of_roots
    return spectrum if len(spectrum) <= len(sum_of_roots) + _LONGER else sum_of_roots


def _for_integers(what: str, letter: str, residues: Sequence[int], modulus: int, latex: bool) -> str:
    kind = classes_text(residues, modulus)
    head, equal, tail = kind.partition(" =")
    head, divisible, more = head.partition(" not")
    text = f"{head} {letter}{divisible}{more}{equal}{tail}"
    return rf"{what} \text{{ for {text}}}" if latex else f"{what} for {text}"


def _spectrum(
    equation: FunctionPoly, residues: Sequence[int], modulus: int, letter: str, fixed: Collection[str], latex: bool
) -> str | None:
    """`E = f(n)` with what is known about n: the shortest of the ways to choose n; None where no parameter is linear."""
    known = families(equation, fixed)
    choices = [
        (_LATER * k + _WEIGHT * len(written(choice.f, letter)) + len(choice.words(False)), name, choice)
        for k, (name, f) in enumerate([pair for pair in known if pair[0] == ENERGY] or known)
        for choice in _choices(equation, f, residues, modulus, letter)
    ]
    if not choices:
        return None
    _, name, best = min(choices, key=itemgetter(0))
    what = f"{symbol(name) if latex else name} = {written(best.f, letter, latex=latex)}"
    return what + _where_undefined(best, letter, latex) + best.words(latex)


@dataclass(frozen=True)
class _Choice:
    """f(n), what is said of n in words (as LaTeX or not), and for which rational numbers that is possible."""

    f: RatFunc
    words: Callable[[bool], str]
    possible: Callable[[Fraction], bool]


def _choices(
    equation: FunctionPoly, f: RatFunc, residues: Sequence[int], modulus: int, letter: str
) -> Iterator[_Choice]:
    """f(N) with N = n; with N = s n + r, n an integer; with N = s n + c, n shifted by a function of the parameters."""
    N = equation.field.poly([0, 1])
    mirrored = equation(-N) == (-1) ** equation.degree * equation
    single = len(residues) == 1 or (mirrored and {*residues} == {residues[0], -residues[0] % modulus})
    if equation.degree > 1 or not single:
        in_classes = partial(_for_integers, "", letter, residues, modulus)
        yield _Choice(f, in_classes, lambda n: n.denominator == 1 and int(n) % modulus in residues)
    if single and (modulus < 3 or not mirrored):
        signs, shifts = ((1, -1), (0, -1, 1)) if modulus == 1 else ((1,), (0, -1))
        for sign, shift in product(signs, shifts):
            chosen = N * (sign * modulus) + residues[0] + modulus * shift
            integer = partial(_for_integers, "", letter, [0], 1)
            yield _Choice(f(RatFunc(chosen)), integer, lambda n: n.denominator == 1)
    center = _center(equation, f)
    if center is None:
        return
    scale = modulus if single else 1
    centered = f(RatFunc(N * scale + center))
    if single:
        even, u = centered(RatFunc(-N)) == centered, over_parameters((center - residues[0]) / modulus)
        in_integers = partial(_in_integers, over_parameters(N), u, even, letter)
        yield _Choice(centered, in_integers, lambda n: True)
    if not single or _constant_term(center) != int(_constant_term(center)) or u.common_denominator() > 1:
        is_in = partial(_is, over_parameters(N + center), residues, modulus, letter)
        yield _Choice(f(RatFunc(N + center)), is_in, lambda n: True)


def _in_integers(n: FunctionPoly, u: FunctionPoly, even: bool, letter: str, latex: bool) -> str:
    """That n + u is an integer; where only n^2 matters: that n + u or n - u - 1 is a natural number."""
    constant = _constant_term(u)
    u = over_parameters(u - constant)
    texts = [written(over_parameters(n + u), letter, latex=latex)]
    if constant.denominator > 1:
        texts[0] += f" - {-constant % 1}"
    elif even:
        texts.append(written(over_parameters(n - u - 1), letter, latex=latex))
        return rf",\ {texts[0]} \text{{ or }} {texts[1]} \in \mathbb{{N}}" if latex else f", {' or '.join(texts)} in N"
    return rf",\ {texts[0]} \in \mathbb{{Z}}" if latex else f", {texts[0]} in Z"


def _is(form: Poly, residues: Sequence[int], modulus: int, letter: str, latex: bool) -> str:
    text, kind = written(over_parameters(form), letter, latex=latex), classes_text(residues, modulus)
    return rf",\ {text} \text{{ is {kind}}}" if latex else f", {text} is {kind}"


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


def _where_undefined(choice: _Choice, letter: str, latex: bool) -> str:
    """What the statement says for a possible n at which f isn't defined: that its numerator vanishes there."""
    f, field = choice.f, choice.f.field
    notes = []
    for factor, _ in field.factor(f.den) if f.den.degree else ():
        root = field.rational_value(-factor[0]) if factor.degree == 1 else None
        if root is None or not choice.possible(root):
            continue
        value = over_parameters(f.num(root))
        if field.rational_value(value) is None:
            texts = [written(factor, latex=latex) for factor in irreducible_factors(value)]
            zero = texts[0] if len(texts) == 1 else "*".join(f"({text})" for text in texts)
            notes.append(
                rf"{zero} = 0 \text{{ where }} {letter} = {root}" if latex else f"{zero} = 0 where {letter} = {root}"
            )
    return f" ({', '.join(notes)})" if notes else ""


def _roots(equation: FunctionPoly) -> tuple[FunctionPoly, list[Poly]] | None:
    """`(r, squares)` where the roots are r +- the roots of one, two or three squares; None where they aren't."""
    field, k = equation.field, equation.degree
    if k not in (2, 4, 8):
        return None
    mean = over_parameters(-equation[k - 1] / (equation.lc * k))
    shifted = equation(field.poly([0, 1]) + mean) / equation.lc
    if k == 2:
        return mean, [-shifted[0]]
    if k == 8:  # ((z - s1)^2 - 4 s2)^2 - 64 s3 z with z = N^2, s_i the symmetric functions of the three squares
        e6, e4, e2 = (shifted[i] for i in (6, 4, 2))
        s1 = -e6 / 4
        s2 = (6 * s1 * s1 - e4) / 8
        s3 = (16 * s1 * s2 - 4 * s1**3 - e2) / 64
        if any(shifted[i] for i in (1, 3, 5, 7)) or shifted[0] != (s1 * s1 - 4 * s2) ** 2:
            return None
        factors = field.factor(field.poly([-s3, s2, -s1, 1]))
        squares = [-factor[0] for factor, multiplicity in factors for _ in range(multiplicity) if factor.degree == 1]
        return (mean, squares) if len(squares) == 3 else None
    difference = None if shifted[1] else field.sqrt(shifted[0])
    if difference is None:
        return None
    total = -shifted[2] / 2
    return mean, [(total + difference) / 2, (total - difference) / 2]


def _sum_of_roots(mean: FunctionPoly, squares: list[Poly], residues: Sequence[int], modulus: int, latex: bool) -> str:
    constant = _constant_term(mean)
    mean = over_parameters(mean - floor(constant / modulus) * modulus)
    texts = [written(mean, latex=latex)] if mean else []
    texts += [root_written(square, latex=latex) for square in squares]
    text, kind = (r" \pm " if latex else " +- ").join(texts), classes_text(residues, modulus)
    return rf"{text} \text{{ is {kind}}}" if latex else f"{text} is {kind}"


def _constant_term(form: Poly) -> Fraction:
    """The constant term of a Laurent series at 0."""
    return to_fraction(form.rational_coefficients()[0]) if form else Fraction(0)
