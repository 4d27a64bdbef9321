"""What the readers of input hand on."""

from __future__ import annotations

from dataclasses import dataclass

from kovacic.algebra.ratfunc import RatFunc
from kovacic.reading.given import Equation


@dataclass(frozen=True, slots=True)
class Parsed:
    """S as a rational function, the name of its variable, and what the user should know about how it was read.

    `equation` is the equation that was given, None where S itself was.
    """

    S: RatFunc
    variable: str
    notices: tuple[str, ...] = ()
    equation: Equation | None = None


DEFAULT_VARIABLE = "x"

# Names that stand for numbers unless the caller says that the variable has this name.
NUMBER_NAMES = {
    "I": "the imaginary unit",
    "pi": "the number pi",
    "π": "the number pi",
    "oo": "infinity",
    "zoo": "infinity",
    "inf": "infinity",
    "nan": "not a number",
}

_FUNCTIONS = """
    exp log sin cos tan cot sec csc asin acos atan acot sinh cosh tanh coth asinh acosh atanh erf sqrt cbrt
"""

#: The functions of one argument that expressions and right-hand sides may contain, with SymPy's names.
FUNCTION_NAMES = {name: name for name in _FUNCTIONS.split()}
FUNCTION_NAMES |= {"ln": "log", "arcsin": "asin", "arccos": "acos", "arctan": "atan"}

# Not the variable unless the caller says so: the energy, a parameter.
ENERGY = "E"

#: What to do with a transcendental number.
TRANSCENDENTAL_HINT = "write a letter instead: a parameter with generic values, as every transcendental number is one"

# The unknown function of y'' = S y: a variable only where the caller says so.
UNKNOWN = "y"
