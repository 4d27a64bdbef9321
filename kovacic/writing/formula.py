"""One way to write a formula: every function, place and equation as text for reading and as LaTeX, without SymPy.

Text has ^ for powers.  LaTeX is made from the exact data, each quotient as one fraction with integer coefficients.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain, count
from typing import Any, NamedTuple

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.equation import parameters_of
from kovacic.limits import MOST_CHARACTERS
from kovacic.numbers.numerals import as_latex, as_text

_GREEK_LETTERS = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon "
    "phi chi psi omega Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega"
)
# Signs between functions, which are replaced first.
_LATEX_RELATIONS = {
    r" in ([ZN])\b": r" \\in \\mathbb{\1}",
    r"\+- *": r"\\pm ",
    "!=": r"\\ne",
    ">=": r"\\ge",
    "<=": r"\\le",
    r"\.\.\.": r"\\ldots",
}
# Replacements for LaTeX, in this order.
_REPLACEMENTS: dict[str, Any] = {
    r"(?:\*\*|\^)(\d+)": r"^{\1}",
    r"(?<![\\\w])[^\W\d]\w*": lambda match: symbol(match[0]),
    r"\*(?=\d)": r" \\cdot ",
    r"\*": " ",
}
#: Those with a command in LaTeX, and the last two without one.
_PRINTED_FUNCTIONS = tuple(
    "sin cos tan cot sec csc sinh cosh tanh coth exp log ln arcsin arccos arctan sech csch".split()  # noqa: SIM905
)
_INNERMOST = re.compile(rf"(\b(?:sqrt|cbrt|root|{'|'.join(_PRINTED_FUNCTIONS)})|\^)?\(([^()]*)\)")
# It begins where a word does: else each digit of a long number would be tried as a beginning.
# Above and below are factors, between signs and relations; the sign in 1e-3 is a part of one.
# Only one factor is below the line: 1/2*t is (1/2) t.
_QUOTIENT = re.compile(r"(?<![^\s/,+=<>-])((?:(?<=\d)e[+-](?=\d)|[^\s/,+=<>-])+)/((?:\*\*|[^\s/,*+=<>-])+)")
# Characters for private use stand for the parts of a formula which are ready.
_PART = 0xF0000
_READY = re.compile(f"[{chr(_PART)}-{chr(0x10FFFD)}]")


_FIRST_LINE, _NEXT_LINE, _LAST_LINE = r"\begin{array}{l} \displaystyle ", r" \\ \displaystyle ", r" \end{array}"
# The names within the engine.
_VARIABLE = "x"
_SYMBOL = "c"


@dataclass(frozen=True)
class Math:
    """A formula as text and as LaTeX."""

    text: str
    latex: str

    @classmethod
    def of(cls, text: str) -> Math:
        """The formula with this text."""
        text = with_single_powers(text)
        return cls(text, latex_text(text))

    @classmethod
    def lines(cls, formulas: Sequence[Math]) -> Math:
        """Several formulas, one a line."""
        latex = _NEXT_LINE.join(formula.latex for formula in formulas)
        return cls("\n".join(formula.text for formula in formulas), _FIRST_LINE + latex + _LAST_LINE)

    @property
    def latex_lines(self) -> list[str]:
        """The LaTeX of each line."""
        return self.latex.removeprefix(_FIRST_LINE).removesuffix(_LAST_LINE).split(_NEXT_LINE)

    @property
    def shortened(self) -> Math:
        """The formula if its text is at most a screen long, else the beginning of the text."""
        text = shortened(self.text)
        return self if text == self.text else Math(text, r"\text{(too long to print)}")

    def equals(self, value: Math) -> Math:
        return Math(f"{self.text} = {value.text}", f"{self.latex} = {value.latex}")


def separated(separator: str, parts: Iterable[str | Math]) -> list[str | Math]:
    """The parts of a sentence with a separator between them."""
    return [piece for part in parts for piece in (separator, part)][1:]


def text_of_words(words: Iterable[str | Math]) -> str:
    """A sentence as text."""
    return "".join(part.text if isinstance(part, Math) else part for part in words)


@dataclass(frozen=True)
class Formulas:
    """The formulas of one answer: its variable is called `variable`, and `field` is that of the coefficients of S."""

    variable: str
    field: Field

    @cached_property
    def symbol(self) -> str:
        """The name of omega's constants: the engine's, unless the user has given it to something else."""
        return free_name({self.variable, *parameters_of(self.field)}, _SYMBOL)

    @cached_property
    def unknown(self) -> str:
        """The name of omega in its polynomial."""
        return free_name({self.variable, *parameters_of(self.field)}, "w", "W")

    def python(self, function: RatFunc | Poly) -> str:
        """A function or a polynomial in Python's syntax."""
        return self._renamed(function).to_str(self.variable)  # type: ignore[no-any-return]

    def place_name(self, place: str) -> str:
        """A factor of the denominator in the user's variable; evidence has it in the engine's."""
        return re.sub(rf"\b{_VARIABLE}\b", self.variable, place)

    def internal_place(self, place: str) -> str:
        """The inverse of `place_name`."""
        return re.sub(rf"\b{re.escape(self.variable)}\b", _VARIABLE, place)

    def _renamed(self, function: Any) -> Any:
        """The function with its constants printed as `symbol`."""
        if isinstance(function, RatFunc):
            return RatFunc(self._renamed(function.num), self._renamed(function.den), reduced=True)
        field = function.field
        # Any other name than the engine's belongs to the field of S.
        if not isinstance(function, ExtensionPoly) or field.name != _SYMBOL or self.symbol == _SYMBOL:
            return function
        return ExtensionPoly(AlgebraicField(field.base, field.modulus, self.symbol), function.parts)

    def math(self, function: RatFunc | Poly) -> Math:
        """A function or a polynomial; the degrees in place of a formula of more than some fifteen screens."""
        function = RatFunc(function) if isinstance(function, Poly) else function
        if max(map(_estimated_length, (function.num, function.den))) > 30 * MOST_CHARACTERS:
            above, below = function.num.degree, function.den.degree
            said = f"(too long to print: degree {above}{f' over degree {below}' * (below > 0)})"
            return Math(said, rf"\text{{{said}}}")
        return Math.of(caret(self.python(function)))

    def factor(self, function: RatFunc | Poly) -> Math:
        """The first factor of a product: sums in parentheses, quotients too in text."""
        value = self.math(function)
        text = f"({value.text})" if set(value.text) & set(" /") else value.text.replace("*", " ")
        is_single = value.latex.removeprefix("-").startswith((r"\frac", r"\text")) or " " not in value.text
        latex = value.latex if is_single else rf"\left({value.latex}\right)"
        return Math(text, latex)

    def times(self, function: RatFunc | Poly, name: str) -> Math:
        """`function * name`: 0, -y, 2 x y, (1/x) y, (x + 1) y."""
        if not function:
            return Math("0", "0")
        value, y = self.factor(function), Math.of(name)
        if value.text in ("1", "-1"):
            return Math(value.text[:-1] + y.text, value.latex[:-1] + y.latex)
        return Math(f"{value.text} {y.text}", f"{value.latex} {y.latex}")

    def named(self, name: str, function: RatFunc | Poly) -> Math:
        """`name = function`."""
        return Math.of(name).equals(self.math(function))

    def place(self, place: str) -> Math:
        """A place: infinity, x = 2 for a factor that is linear in x with a simple constant, else factor = 0."""
        if place == "infinity":
            return Math(place, r"\infty")
        factor = self.place_name(place)
        x = re.escape(self.variable)
        linear = re.fullmatch(rf"{x} ([-+]) ((?!.*{x})\S+)", factor)
        if linear is not None:
            return Math.of(f"{self.variable} = {'-' * (linear[1] == '+')}{linear[2]}")
        if factor == self.variable:
            return Math.of(f"{factor} = 0")
        return Math(f"{caret(factor)} = 0", f"{latex_text(factor)} = 0")


def free_name(taken: Collection[object], *candidates: str) -> str:
    """The first of the names that isn't taken by the user, as F may be by a force; if all are, the first one with a number."""
    letters = {*map(str, taken)}
    numbered = (f"{candidates[0]}{k}" for k in count(1))
    return next(name for name in chain(candidates, numbered) if name not in letters)


def shortened(text: str) -> str:
    """A formula of at most a screen, or its first half screen."""
    return text if len(text) <= 2 * MOST_CHARACTERS else f"{text[:MOST_CHARACTERS]} ... ({len(text)} characters)"


def _estimated_length(part: Poly) -> int:
    """The estimated characters of a polynomial: 8 a term for signs and powers, and the digits of its coefficients."""
    terms = part.extent()[0]
    if not parameters_of(part.field):
        terms = sum(map(bool, part.rep.numer().coeffs() if isinstance(part, RationalPoly) else part))
    return terms * (8 + part.height_bits() // 3)


def of_sympy(expression: Any, first: Any = None) -> Math:
    """A SymPy expression; polynomials in the symbol `first` begin with its highest power."""
    return Math(caret(as_text(expression, first)), as_latex(expression, first))


def generated_field(generator: str) -> Math:
    """The field C(f) for an expression f in Python syntax."""
    return Math(f"C({caret(generator)})", rf"\mathbb{{C}}({latex_text(generator)})")


#: A power of an exponential, of a root, and of a power in parentheses, with ^.
_POWER_OF_POWER = re.compile(r"(exp|sqrt)\(([^()]*)\)\^(\d+)|\((\w+)\^(?:\(([^()]*)\)|(\w+))\)\^(\d+)")
#: A power in parentheses that it doesn't need: they aren't those of a call, an exponent, a divisor or a base.
_POWER_ALONE = re.compile(r"(?<![\w'^/])\((\w+|\(-\d+\))\^(\w+|\([^()]*\))\)(?!\^|\*\*)")
#: A rational multiple of a monomial: 3*a*b/2.
_MULTIPLE = re.compile(r"(-?)(?:(\d+)\*)?([^-+/\s]+)(?:/(\d+))?")


def with_single_powers(text: str) -> str:
    """Powers of powers as single ones: exp(a/2)^3 is exp(3*a/2), sqrt(a)^4 is a^2; other powers without parentheses.

    >>> print(with_single_powers("exp(a/2)^2*x^2 + b*(a^(1/3))^2 - sqrt(a + b)^2/exp(-a*b/4)^3"))
    exp(a)*x^2 + b*a^(2/3) - (a + b)/exp(-3*a*b/4)
    >>> print(with_single_powers("x^2 + ((-1)^n) - (a^(1/3))*x/(b^n)"))
    x^2 + (-1)^n - a^(1/3)*x/(b^n)
    """

    def single(match: re.Match[str]) -> str:
        function, inside, k, base, exponent, name, n = match.groups()
        if function == "sqrt":
            half = "" if k == "2" else f"^{int(k) // 2}"
            radicand = inside if inside.isalnum() else f"({inside})"
            return match[0] if int(k) % 2 else radicand + half
        multiple = _MULTIPLE.fullmatch(inside or exponent or name)
        if multiple is None:
            return match[0]
        sign, factor, monomial, below = multiple.groups()
        rate = Fraction(int(factor or 1) * int(k or n), int(below or 1))
        if monomial.isdigit():
            rate, monomial = rate * int(monomial), ""
        above = "*".join(filter(None, [str(rate.numerator) * (rate.numerator > 1 or not monomial), monomial]))
        raised = f"{sign}{above}" + f"/{rate.denominator}" * (rate.denominator > 1)
        if function:
            return f"exp({raised})"
        if raised == "1":
            return base
        return f"{base}^{raised if raised.isalnum() else f'({raised})'}"

    return _POWER_ALONE.sub(r"\1^\2", _POWER_OF_POWER.sub(single, text))


def caret(text: str) -> str:
    """The text with ^ for **."""
    return text.replace("**", "^")


def latex_text(text: str) -> str:
    r"""An expression in Python syntax, or with ^: sums of quotients of products, powers, roots, Greek names, relations.

    >>> print(latex_text("-n*(n + 3)/(2*sqrt(mu)) - b**2"))
    -\frac{n (n + 3)}{2 \sqrt{\mu}} - b^{2}
    >>> print(latex_text("1/2*t**2"))
    \frac{1}{2} t^{2}
    >>> print(latex_text("1+2/5*t=1e-3/7"))
    1+\frac{2}{5} t=\frac{1e-3}{7}
    >>> print(latex_text("sin(x/2)^(n + 1)"))
    \sin\left(\frac{x}{2}\right)^{n + 1}
    >>> print(latex_text("2*n in Z"), latex_text("n != +-1/2"))
    2 n \in \mathbb{Z} n \ne \pm \frac{1}{2}
    >>> print(latex_text("n = 1, 2 mod 5"))
    n \equiv 1, 2 \pmod{5}
    """
    form, _, modulus = text.partition(" mod ")
    if modulus:
        congruence = latex_text(form).replace("=", r"\equiv")
        return rf"{congruence} \pmod{{{latex_text(modulus)}}}"
    for pattern, replacement in _LATEX_RELATIONS.items():
        text = re.sub(pattern, replacement, text)
    writer = _LatexWriter()
    found = 1
    while found:
        text, found = _INNERMOST.subn(writer.parenthesised, text)
    return writer.complete(text)


class _Part(NamedTuple):
    """A finished part of a formula, as a factor of a product and on its own: (x + 1) and x + 1."""

    product: str
    alone: str


class _LatexWriter:
    """The parts of a formula that are ready, from the inside; in the text a character of its own stands for each."""

    def __init__(self) -> None:
        self.parts: list[_Part] = []

    def ready(self, product: str, alone: str | None = None) -> str:
        self.parts.append(_Part(product, product if alone is None else alone))
        return chr(_PART + len(self.parts) - 1)

    def alone(self, text: str) -> str:
        """Above or below a line, where a part needs no parentheses."""
        if _READY.fullmatch(text) is None:
            return text
        return self.ready(self.parts[ord(text) - _PART].alone)

    def fraction(self, match: re.Match[str]) -> str:
        return rf"\frac{{{self.alone(match[1])}}}{{{self.alone(match[2])}}}"

    def complete(self, text: str) -> str:
        """The LaTeX of a text without parentheses, in which characters stand for finished parts."""
        found = 1
        while found:  # a/b*c/d is a fraction with one above it
            text, found = _QUOTIENT.subn(self.fraction, text)
        for pattern, replacement in _REPLACEMENTS.items():
            text = re.sub(pattern, replacement, text)
        return _READY.sub(lambda match: self.parts[ord(match[0]) - _PART].product, text)

    def parenthesised(self, match: re.Match[str]) -> str:
        """A root, an exponent, the argument of a function, or a sum in parentheses."""
        if match[1] == "^":
            return self.ready(f"^{{{self.complete(match[2])}}}")
        if match[1] in _PRINTED_FUNCTIONS:
            name = rf"\operatorname{{{match[1]}}}" if match[1] in _PRINTED_FUNCTIONS[-2:] else rf"\{match[1]}"
            return self.ready(rf"{name}\left({self.complete(match[2])}\right)")
        if match[1]:
            radicand, _, n = match[2].partition(", ")
            n = "3" if match[1] == "cbrt" else n
            return self.ready(rf"\sqrt{f'[{n}]' if n else ''}{{{self.complete(radicand)}}}")
        inside = self.complete(match[2])
        product = rf"\left({inside}\right)" if r"\frac" in inside else f"({inside})"
        return self.ready(product, inside)


def symbol(name: str) -> str:
    """A name as LaTeX: Greek letters, final digits and the part after _ as an index; the constant I."""
    if name == "I":
        return r"\mathrm{i}"
    match = re.fullmatch(r"([^\W\d_]+)_*(\w*)", name)
    base, index = (name, "") if match is None else (match[1], match[2].replace("_", r"\_"))
    letter = base if len(base) == 1 else rf"\mathrm{{{base}}}"
    if base in _GREEK_LETTERS.split():
        letter = rf"\{base}"
    return f"{letter}_{{{index}}}" if index else letter
