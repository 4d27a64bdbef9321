"""The names that mean something in what a user writes: numbers, functions and letters."""

from __future__ import annotations

#: Names that stand for numbers unless the caller says that the variable has this name.
NUMBER_NAMES = {
    "I": "the imaginary unit",
    "pi": "the number pi",
    "π": "the number pi",
    "oo": "infinity",
    "zoo": "infinity",
    "inf": "infinity",
    "infinity": "infinity",
    "Infinity": "infinity",
    "nan": "not a number",
}

_FUNCTIONS = """
    exp log sin cos tan cot sec csc asin acos atan acot sinh cosh tanh coth sech csch asinh acosh atanh erf sqrt cbrt
    Heaviside DiracDelta
"""

#: The functions of one argument that expressions and right-hand sides may contain, with SymPy's names.
FUNCTION_NAMES = {name: name for name in _FUNCTIONS.split()}
RECIPROCALS = {"sech": "cosh", "csch": "sinh"}
FUNCTION_NAMES |= {"ln": "log", "arcsin": "asin", "arccos": "acos", "arctan": "atan"}
FUNCTION_NAMES |= {
    "heaviside": "Heaviside",
    "dirac": "DiracDelta",
    "abs": "Abs",
    "Abs": "Abs",
    "sgn": "sign",
    "sign": "sign",
    "Gamma": "gamma",
}  # gamma(...) may be a product

_GREEK = """
    alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron rho sigma tau upsilon phi chi psi omega
    Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega
"""

#: Names of Greek letters, each of which is a letter of its own; pi is a number.
GREEK = frozenset(_GREEK.split())

#: A pattern for a name of one letter, or of a Greek one.
LETTER = rf"(?:{'|'.join(sorted(GREEK, key=len, reverse=True))}|[^\W\d_])"

#: What to do with a transcendental number.
TRANSCENDENTAL_HINT = "write a letter instead: a parameter with generic values, as every transcendental number is one"
