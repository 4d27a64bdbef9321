"""The names that mean something in what a user writes: numbers, functions and letters."""

from __future__ import annotations

import re
from collections.abc import Iterable

#: The numbers that texts have, with SymPy's names; they are declared where they are parameters.
KNOWN_NUMBERS = {"e": "E", "pi": "pi", "π": "pi", **{n: n for n in ("I", "EulerGamma", "Catalan", "GoldenRatio")}}
INFINITIES = ("oo", "inf", "infty", "infinity", "Infinity")
#: Names that stand for numbers unless the caller says that the variable has this name.
NUMBER_NAMES = {
    **{name: f"the number {name}" for name in KNOWN_NUMBERS},
    **dict.fromkeys((*INFINITIES, "zoo"), "infinity"),
    "I": "the imaginary unit",
    "e": "Euler's number",
    "π": "the number pi",
    "nan": "not a number",
}

_FUNCTION_LIST = """
    exp log sin cos tan cot sec csc asin acos atan acot sinh cosh tanh coth sech csch asinh acosh atanh erf sqrt cbrt
    Heaviside DiracDelta floor Abs sign
"""
#: Other names, each with SymPy's; gamma(...) may be a product.
_OTHER_NAMES = """
    ln log  arcsin asin  arccos acos  arctan atan  arccot acot  arsinh asinh  arcosh acosh  artanh atanh  arcsinh asinh
    arccosh acosh  arctanh atanh  heaviside Heaviside  dirac DiracDelta  abs Abs  sgn sign  Gamma gamma
"""


def pairs(words: str) -> dict[str, str]:
    """Maps the first word to the second, the third to the fourth, ..."""
    separate = words.split()
    return dict(zip(separate[::2], separate[1::2], strict=True))


#: The functions of one argument that expressions and right-hand sides may contain, with SymPy's names.
FUNCTION_NAMES = {name: name for name in _FUNCTION_LIST.split()} | pairs(_OTHER_NAMES)
RECIPROCALS = {"sech": "cosh", "csch": "sinh"}

#: The functions of several arguments, by the names of SymPy's.
SEVERAL_ARGUMENTS = pairs("Max Max Min Min max Max min Min Piecewise Piecewise SingularityFunction SingularityFunction")
#: Spellings to suggest for names of other systems, some of which may be products: tg is tan, or t g.
INSTEAD = pairs(
    "tg tan(...)  ctg cot(...)  cotg cot(...)  arctg atan(...)  arcctg acot(...)  sen sin(...)  cosec csc(...)"
    "  sh sinh(...)  ch cosh(...)  th tanh(...)"
)
INSTEAD |= dict.fromkeys(("EI", "IE"), "one letter for a stiffness, such as B")
INSTEAD |= dict.fromkeys(("log2", "log10", "lg", "log_2", "log_10"), "log(x)/log(b) for the logarithm to the base b")
#: Powers as calls: of C, SymPy and Mathematica, of spreadsheets.
POWER_CALLS = frozenset({"pow", "Pow", "Power", "POWER"})
#: The functions whose parentheses may be left out.
BARE = frozenset(
    "sinh cosh tanh coth sech csch sin cos tan cot sec csc arcsin arccos arctan exp log ln".split()  # noqa: SIM905
)

_GREEK = """
    alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron rho sigma tau upsilon phi chi psi omega
    Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega
"""

#: Names of Greek letters, each of which is a letter of its own; pi is a number.
GREEK = frozenset(_GREEK.split())
#: Letters of physicists that have names, and common names of numbers without dimension.
SPECIAL_LETTERS = frozenset({"hbar", "ell", "pi", "eps", "lam"})

#: Letters that often are a step or an impulse before a parenthesis, and no factors.
STEP_LETTERS = frozenset({"H", "u", "theta", "Theta", "delta", "θ", "Θ", "δ"})

#: A pattern for a name of one letter, or of a Greek one.
LETTER = rf"(?:{'|'.join(sorted(GREEK | SPECIAL_LETTERS, key=len, reverse=True))}|[^\W\d_])"
_LETTER_WITH_INDEX = re.compile(rf"{LETTER}(?:_\w+|\d+|\d*_)?")

TRANSCENDENTAL_HINT = "write a letter instead: a parameter with generic values, as every transcendental number is one"


def is_letter(name: str) -> bool:
    """True for x, x1, omega, omega_0, k_x; a word isn't a letter."""
    return _LETTER_WITH_INDEX.fullmatch(name) is not None


def words_among(names: Iterable[object]) -> tuple[str, ...]:
    """The names that have to be declared where a text with them is read again."""
    return tuple(name for name in names if isinstance(name, str) and (name in KNOWN_NUMBERS or not is_letter(name)))


FUNCTIONS = frozenset({*FUNCTION_NAMES, "sqrt", "cbrt", "root", *SEVERAL_ARGUMENTS})


def is_function(name: str) -> bool:
    return name in FUNCTIONS


#: The parts of a word that was glued together: functions, Greek letters, letters with an index, digits; no ell, as in hello.
_PARTS = re.compile(
    rf"(?P<function>{'|'.join(sorted(BARE | {'sqrt'}, key=len, reverse=True))})"
    rf"|(?P<letter>{'|'.join(sorted(GREEK | {'hbar', 'pi'}, key=len, reverse=True))}|[^\W\d_])(?:_\d+)?|(?P<number>\d+)"
)


def unglued(word: str) -> str:
    """The product that a word probably is: x*sin(x) for xsinx, a*b*c for abc.

    >>> unglued("xsinx"), unglued("Fcoswt"), unglued("sin2x"), unglued("EI")
    ('x*sin(x)', 'F*cos(w*t)', 'sin(2*x)', 'E*I')
    """
    factors: list[str] = []
    calls: list[tuple[str, list[str]]] = [("", factors)]
    for found in _PARTS.finditer(word):
        if found["function"]:
            calls.append((found[0], []))
        else:
            calls[-1][1].append(found[0])
    return "*".join([*factors, *(f"{name}({'*'.join(inside) or '...'})" for name, inside in calls[1:])])
