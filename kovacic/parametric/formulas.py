"""Functions of the parameters, written in the shortest of their usual forms.

A quotient f/g is one of polynomials, a product of irreducible factors, a sum of terms over a monomial
(-n^2 - b^2/(4*n^2)), or a polynomial in one parameter with coefficients in factors (n + k*n*(n - 1)/2).

In a product of powers each irreducible factor stands once, up to constant factors.  Solutions are determined up to a constant,
so that (1 - x)^e and (x - 1)^e count as the same, and the first sign is kept:

    x^(1/2)*(x^2 - 1)^(1/4)*(1 - x)^(3/4)  ->  sqrt(x)*(1 - x)*(x + 1)^(1/4)

The user's own text becomes a formula with its sums, products and parentheses unchanged, in one spelling, and as LaTeX: it is
made of the tokens that the parser reads.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

import sympy

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.partial_fractions import partial_fractions
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.sparse import by_power, factorisation
from kovacic.limits import MOST_CHARACTERS
from kovacic.numbers.numerals import as_text, digits
from kovacic.parametric.claims import element, over_parameters
from kovacic.reading.lexer import PRIME, SUPERSCRIPT_DIGITS
from kovacic.reading.names import is_function
from kovacic.reading.naming import Source
from kovacic.writing.formula import Math, caret, latex_text, with_single_powers

#: Characters by which a formula may become longer so that its denominator is in factors.
_FOR_FACTORS = 4
#: A power of the variable before powers of parameters, as flint writes a term.
_VARIABLE_FIRST = r"\b(x(?:\^\d+)?)\*(t\d+(?:\^\d+)?(?:\*t\d+(?:\^\d+)?)*)"
#: A polynomial in the parameters, flint's, with an exponent.
FlintPower = tuple[Any, int]


def expanded_form(function: FunctionPoly | RatFunc, variable: str = "x") -> str:
    """In ordinary notation, with ^ for powers, as a quotient of expanded polynomials."""
    return with_single_powers(caret(function.to_str(variable)))


def shifted(text: str, value: Poly) -> str:
    """`text - value`: x - 2, x + 1/2, x - (a + b)."""
    if not value:
        return text
    amount = caret(as_text(value.to_sympy(sympy.Symbol("x"))))
    if isinstance(value, FunctionPoly):
        amount = expanded_form(value)
    return f"{text} - {in_sum(amount)}".replace("- -", "+ ")


def shortest_form(function: Poly | RatFunc, letter: str = "x") -> str:
    """The shortest of the usual forms, with its denominator in factors; `letter` is the name of the polynomial variable."""
    above, below, names = _as_quotient(function, letter)
    forms = [*_written_forms(above, below)]
    best = min((_sum_text(form, names) for form in forms), key=len)
    has_sum_below = re.search(r"/\([^()]* [+-] [^()]*\)", best) is not None
    in_factors = _sum_text(forms[-1], names)
    return in_factors if has_sum_below and len(in_factors) <= len(best) + _FOR_FACTORS else best


def in_partial_fractions(S: RatFunc, variable: str) -> str:
    """S != 0 as a polynomial in the variable plus fractions with powers of the irreducible factors of its denominator."""
    whole, fractions = partial_fractions(S)
    degrees = (k for k in range(whole.degree, -1, -1) if whole[k])
    terms = [shortest_form(S.field.poly([0] * k + [whole[k]]), variable) for k in degrees]
    for above, factor, k in fractions:
        top, bottom, names = _as_quotient(RatFunc(above, factor**k), variable)
        terms.append(_sum_text([_term_in_factors(top, bottom)], names))
    return _joined_terms(terms)


class SidesOfEquation(NamedTuple):
    left: str
    right: str


def sides_of_equation(function: FunctionPoly) -> SidesOfEquation:
    """The equation that a function vanishes, solved for a power of a parameter if possible.

    That is t = f for a linear equation, preferably with the coefficient 1 or -1 of t, or t^k = f, a product of linear factors.
    Two terms of higher degree stand on two sides.
    """
    above, _, names = _as_quotient(function, "x")
    is_linear = above.total_degree() == 1
    solved: list[tuple[bool, SidesOfEquation]] = []
    for i, degree in enumerate(map(int, above.degrees()) if is_linear or len(above) > 2 else ()):
        parts = by_power(above, i)
        if not parts.keys() <= {0, degree} or not parts[degree].is_constant():
            continue
        quotient = (-parts.get(0, 0 * above), parts[degree])
        values = [*_written_forms(*quotient)] if is_linear else [[_term_in_factors(*quotient)]]
        if is_linear or all(factor.total_degree() == 1 for factor, _ in values[0][0].top):
            has_fractions = is_linear and abs(int(parts[degree].leading_coefficient())) != 1
            left = _polynomial_text(above.context().gen(i) ** degree, names)
            right = min((_sum_text(form, names) for form in values), key=len)
            solved.append((has_fractions, SidesOfEquation(left, right)))
    if solved:
        return min(solved, key=lambda one: one[0])[1]
    negative = {exponents: -int(c) for exponents, c in above.to_dict().items() if int(c) < 0}
    moved = above.context().from_dict(negative if len(above) == 2 and len(negative) == 1 else {})
    return SidesOfEquation(_polynomial_text(above + moved, names), _polynomial_text(moved, names))


def root_written(square: Poly, factor: str = "") -> str:
    """The square root of an element of Q(t), up to its sign, times a name: (4*a*c - b^2)/(4*a*sqrt(a)), 2*j*sqrt(a).

    Squares are taken out.
    """
    if not square:
        return "0"
    field = over_parameters(square).field
    above, below, names = _as_quotient(square, "x")
    squares = (element(field, whole).square_part() for whole in (above, below))
    (top, odd), (bottom, under) = ([part.num for part in parts] for parts in squares)
    if int(odd.leading_coefficient()) < 0 and not under.is_constant():
        odd, under = -odd, -under
    return _sum_text([replace(_term_in_factors(top, bottom), root=odd, under=under, name=factor)], names)


def _as_quotient(function: Poly | RatFunc, letter: str) -> tuple[Any, Any, Sequence[str]]:
    """Numerator and denominator over Z, flint's, and the names of their variables, the polynomial variable first."""
    quotient = function if isinstance(function, RatFunc) else RatFunc(function)
    above, below = map(over_parameters, quotient.cleared())
    return above.num, below.num, (letter, *above.field.names)


@dataclass(frozen=True)
class _FormulaTerm:
    """number * name * prod(top)/prod(bottom) * sqrt(root)/sqrt(under)."""

    number: Fraction
    top: tuple[FlintPower, ...] = ()
    bottom: tuple[FlintPower, ...] = ()
    root: Any = 1
    under: Any = 1
    name: str = ""


def _written_forms(above: Any, below: Any) -> Iterator[list[_FormulaTerm]]:
    """Sums of terms that equal the quotient of two polynomials over Z; the last one is in factors, unless it is 0."""
    forms = [[_FormulaTerm(Fraction(1), ((above, 1),), ((below, 1),))]]
    # Each term over a monomial; only two of them over a number.
    if len(below) == 1 and len(above) > 1 and (len(above) == 2 or not below.is_constant()):
        single = [above.context().from_dict({exponents: c}) for exponents, c in above.to_dict().items()]
        forms.append([_term_in_factors(term, below) for term in single])
    yield from forms if below.is_constant() else reversed(forms)
    if not above:
        return
    for i in range(1, len(above.degrees())):
        parts = by_power(above, i)
        if len(parts) == 2:
            generator = above.context().gen(i)
            yield [_term_in_factors(part * generator**power, below) for power, part in sorted(parts.items())]
    yield [_term_in_factors(above, below)]


def _term_in_factors(above: Any, below: Any) -> _FormulaTerm:
    """The quotient of two polynomials, the first one not zero, in irreducible factors."""
    common = above.gcd(below)
    number, top = factorisation(above // common)
    divisor, bottom = factorisation(below // common)
    return _FormulaTerm(Fraction(number, divisor), tuple(top), tuple(bottom))


def _sum_text(terms: Sequence[_FormulaTerm], names: Sequence[str]) -> str:
    return _joined_terms(_term(term, names) for term in terms) or "0"


def _joined_terms(terms: Iterable[str]) -> str:
    return " + ".join(terms).replace("+ -", "- ")


def _polynomial_text(polynomial: Any, names: Sequence[str]) -> str:
    """The expanded polynomial, in the order of its terms; the variable stands behind the parameters."""
    reordered = re.sub(_VARIABLE_FIRST, r"\2*\1", str(polynomial))

    def written_power(match: re.Match[str]) -> str:
        name, k = names[1 + int(match[1] or -1)], int(match[2] or 1)
        root = re.fullmatch(r"sqrt\((.*)\)", name)
        if root and k > 1:  # sqrt(a)^3 is a*sqrt(a)
            inside = in_product(root[1])
            whole = inside if k < 4 else f"{inside}^{k // 2}"
            return f"{whole}*{name}" if k % 2 else whole
        return name if k == 1 else f"{name}^{k}"

    return re.sub(r"(?:x|t(\d+))(?:\^(\d+))?", written_power, reordered)


def _term(term: _FormulaTerm, names: Sequence[str]) -> str:
    """A quotient of products; a sum alone needs no parentheses."""
    top = _factor_texts(abs(term.number.numerator), term.top, term.root, names)
    if term.name:
        top.insert(abs(term.number.numerator) != 1, term.name)
    bottom = _factor_texts(term.number.denominator, term.bottom, term.under, names)
    sign = "-" if term.number < 0 else ""
    above = "*".join(top) or "1"
    if bottom:
        # Behind a slash only a single name, number, power, root or sum in parentheses stands without further ones.
        below = "*".join(bottom)
        is_closed = "*" not in outside_parentheses(below)
        return f"{sign}{above}/{below if is_closed else f'({below})'}"
    return sign + above if sign else alone(above)


def _factor_texts(number: int, factors: tuple[FlintPower, ...], root: Any, names: Sequence[str]) -> list[str]:
    """The factors of a product, none for 1; sums are in parentheses."""
    pieces = [digits(number)] if number != 1 else []
    for factor, k in factors:
        if factor != 1:
            text = in_product(_polynomial_text(factor, names))
            pieces.append(text if k == 1 else f"{text}^{k}")
    if root != 1:
        text = alone(_polynomial_text(root, names))
        pieces.append("I" if text == "-1" else f"sqrt({text})")
    return pieces


def outside_parentheses(text: str) -> str:
    """The text outside of all parentheses."""
    count = 1
    while count:
        text, count = re.subn(r"[({][^(){}]*[)}]", "", text)
    return text


def alone(text: str) -> str:
    """A side of an equation: (a^(1/3)), a parameter, without its parentheses."""
    return text[1:-1] if text.startswith("(") and not outside_parentheses(text) else text


def in_sum(text: str) -> str:
    """A term after a sign: a sum in parentheses, unless it has some."""
    return f"({text})" if re.search(" [+-] ", outside_parentheses(text)) else text


def in_product(text: str) -> str:
    """A factor of a product: in parentheses if it is a sum or begins with a minus."""
    return f"({text})" if text.startswith("-") else in_sum(text)


class _Powers:
    """Powers of polynomials in x: the bases as they are shown, and the exponents, by the monic multiples of the bases."""

    def __init__(self, x: Any) -> None:
        self.x = x
        self.bases: dict[Any, Any] = {}
        self.exponents: dict[Any, Any] = {}

    def key(self, polynomial: Any) -> Any:
        return sympy.Poly(polynomial, self.x, domain="EX").monic().as_expr()

    def multiply(self, polynomial: Any, exponent: Any) -> None:
        key = self.key(polynomial)
        self.bases.setdefault(key, polynomial)
        self.exponents[key] = self.exponents.get(key, sympy.Integer(0)) + exponent

    def multiply_factors(self, base: Any, e: Any) -> None:
        """Multiply by the irreducible factors of a rational function, raised to a power."""
        for part, sign in zip(sympy.fraction(sympy.together(base)), (1, -1), strict=True):
            number, factors = sympy.factor_list(part)
            factors = [(factor, k) for factor, k in factors if factor.has(self.x)]
            for factor, k in factors:
                is_turned = len(factors) == 1 and number.is_negative and k % 2 == 1
                self.multiply(-factor if is_turned else factor, sign * k * e)

    def join_conjugates(self) -> None:
        """Write (x - i)^e (x + i)^f (x^2 + 1)^g with the exponents e + g and f + g; as one power if these are equal."""
        with_roots = [key for key in self.exponents if has_roots(key) and sympy.degree(key, self.x) == 1]
        for first, second in combinations(with_roots, 2):
            whole = sympy.expand(first * second)
            if has_roots(whole):
                continue
            known = self.exponents.pop(self.key(whole), sympy.Integer(0))
            parts = [self.exponents[key] + known for key in (first, second)]
            if sympy.expand(parts[0] - parts[1]) == 0:
                del self.exponents[first], self.exponents[second]
                self.multiply(whole, parts[0])
            else:
                self.exponents |= dict(zip((first, second), parts, strict=True))


def with_gathered_powers(y: Any, x: Any) -> Any:
    """A product with each irreducible factor of the bases of its powers once, and one exponential; else y itself.

    Constant factors are left out.
    """
    if not isinstance(y, sympy.Mul | sympy.Pow):
        return y
    powers = _Powers(x)
    others: list[Any] = []
    exponent = sympy.Integer(0)
    for factor in sympy.Mul.make_args(y):
        base, e = factor.as_base_exp()
        if base == sympy.E:
            exponent += e
            continue
        is_polynomial = factor.is_Add and not (has_roots(factor) and sympy.degree(factor, x) == 1)
        if is_polynomial or not base.has(x) or not base.is_rational_function(x):
            others.append(factor)
        else:
            powers.multiply_factors(base, e)
    powers.join_conjugates()
    shown = []
    for other in others:
        if other.is_Add and other.is_polynomial(x) and powers.key(other) in powers.exponents:
            powers.multiply(other, 1)  # a polynomial P with a factor of the weight
        elif other.has(x):
            shown.append(other)
    shown += [powers.bases[key] ** shorter_sum(e) for key, e in powers.exponents.items()]
    return sympy.Mul(*shown, sympy.exp(shorter_sum(exponent)))


def has_roots(expression: Any) -> bool:
    """True if i, or another root, occurs."""
    return expression.has(sympy.I) or _has_radicals(expression)


def _has_radicals(expression: Any) -> bool:
    return any(not power.exp.is_Integer for power in expression.atoms(sympy.Pow))


def shorter_sum(exponent: Any) -> Any:
    """A sum without terms that cancel, its rational part as one fraction if that is shorter."""
    terms = sympy.expand(exponent)
    roots, rational = sympy.sift(sympy.Add.make_args(terms), _has_radicals, binary=True)
    if all(sympy.denom(term).is_number for term in rational):  # a polynomial already
        return terms
    fraction = sympy.cancel(sympy.Add(*rational))
    if sympy.count_ops(fraction) >= sympy.count_ops(sympy.Add(*rational)):
        return terms
    return sympy.Add(fraction, *roots)


#: A gap between operands, which is a product; one around a sign between them, or any other.
_PRODUCT = re.compile(r"(?<=[\w').]) (?=[\w(.])")
_SPACE = re.compile(r"(?<=[\w').]) ([-+=]) | ")
#: A number, a name or a power of one in parentheses that aren't those of a call or of a base.
_IN_PARENTHESES = re.compile(r"(?<![\w'])\((\w+'*|\w+\^\w+(?=\)(?!\^)))\)")
#: A sign behind an operator, and the power of a power, which would need parentheses.
_UNCLEAR = re.compile(r"[*/^+-] ?[+-]|\^(?:\w+|\([^()]*\))\^")


def unexpanded(source: Source) -> Math | None:
    """The user's equation, or y'' = S y for S alone; None without a text, and for a long one.

    Texts with derivatives as calls, several arguments, 1e-3, 2*-x or x^2^3 give None, too.
    """
    if source.tokens is None or len(source.text or "") > MOST_CHARACTERS:
        return None
    pieces: list[str] = []
    for kind, piece in zip(source.tokens.kinds, source.tokens.pieces, strict=True):
        is_call = piece.rstrip(PRIME) == source.unknown or (is_function(piece) and piece.isalpha())
        is_exponential = kind == "NUMBER" and "e" in piece.lower()
        if kind in ("COMMA", "OPERATOR") or is_exponential or (kind == "HEAD" and not is_call):
            return None
        raised = "^" if kind == "SUPERSCRIPT" else ""
        pieces.append(raised + caret(piece).translate(SUPERSCRIPT_DIGITS) + ("" if kind == "HEAD" else " "))
    text = _PRODUCT.sub("*", "".join(pieces))
    text = _SPACE.sub(lambda gap: f" {gap[1]} " if gap[1] else "", text)
    is_sum = re.search("[-+]", outside_parentheses(text)) is not None
    text = re.sub(r"\^(-\w+)", r"^(\1)", text)
    count = 1
    while count:
        text, count = _IN_PARENTHESES.subn(r"\1", text)
    if _UNCLEAR.search(text):
        return None
    if not source.unknown:
        text = f"y'' = ({text}) y" if is_sum else f"y'' = {text} y"
    return Math(text, latex_text(text))
