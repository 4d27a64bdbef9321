"""One door for every form of input."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import DEFAULT_VARIABLE, PI, UNKNOWN, Equation, Parsed, parameters_of
from kovacic.errors import InputError, NotLinear, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits, demand
from kovacic.numbers.exact import exact_real, exact_text, is_rational_number
from kovacic.reading.naming import Source
from kovacic.reading.parser import excerpt
from kovacic.reading.pieces import Paste
from kovacic.reading.source import read_source, read_with_numbers, source_of


def read_input(
    S: Any,
    *,
    var: Any = None,
    limits: Limits = DEFAULT_LIMITS,
    exponentials: bool = False,
    unknown: Any = None,
    equation: bool = False,
    names: Collection[str] = (),
    order: Sequence[str] = (),
) -> Parsed:
    """S as a rational function with the name of its variable, from whatever the user has.

    S is a string, a SymPy expression, a pair (numerator, denominator) of coefficient sequences from low to high powers (of
    integers, fractions, SymPy rationals and numpy integers; a float is rarely the number that was meant, and is refused),
    an integer, a fraction, or a `RatFunc`; or it is an equation, as a string with derivatives of an unknown function, as a
    SymPy `Eq` or expression with a function y(x), or as an `Equation`, and then the result has it.  `var` is a name or a
    SymPy symbol; by default it is the only symbol, else x.  SymPy isn't imported unless S comes from it.  With `exponentials`,
    coefficients may be rational in exp(k x), or sines, ... of multiples of k x: the equation then has a `change` of variable.
    `equation` says that it is one, and `unknown` is the name of its function, or y(x), where more than one occurs.
    `names` are declared parameters: names of more than one letter have to be.  `order` has all parameters in the order of
    the field; by default it is that of their appearance.
    Raises `InputError` and `LimitExceeded`.

    >>> str(read_input("x^2 + 3").S), str(read_input(([3, 0, 1], [1])).S)
    ('x**2 + 3', 'x**2 + 3')
    """
    variable = _variable_name(var)
    if isinstance(S, str | Paste) or _is_sympy(S):
        source = source_of(S, variable, limits, unknown=unknown, equation=equation, names=names)
        source = source._replace(order=tuple(order))
        parsed = _with_note(_meaning(S, source, exponentials=exponentials))
        if parsed.equation is None:
            _check_unknown(parsed.variable, *parameters_of(parsed.S.field))
        return replace(parsed, notices=(*source.notes, *parsed.notices), guesses=source.guesses)
    if isinstance(S, Equation):
        if variable not in (None, S.variable):
            raise InputError(f"the variable of this equation is {S.variable}, not {variable}")
        return Parsed(S.S, S.variable, equation=S)
    _check_unknown(variable)
    if is_rational_number(S):
        S = RatFunc(QQ.poly([exact_real(S, "S")]))
    elif isinstance(S, tuple | list) and len(S) == 2:
        parts = zip(S, ("numerator", "denominator"), strict=True)
        above, below = (_coefficient_polynomial(*part, limits) for part in parts)
        if not below:
            hint = "give the pair (numerator, denominator), low powers first"
            raise NotRational("the denominator is zero", hint=hint)
        S = RatFunc(above, below)
    elif not isinstance(S, RatFunc):
        hint = 'give a string "x^2 + 3", a SymPy expression, or the pair of coefficient sequences ([3, 0, 1], [1])'
        raise InputError(f"{type(S).__name__!r} isn't a form of S that can be read", hint=hint)
    return Parsed(S, variable or DEFAULT_VARIABLE)


def _check_unknown(*names: str | None) -> None:
    """Raises `InputError` where S of y'' = S y has y as a variable or a parameter."""
    if UNKNOWN in names:
        hint = "give it another name, or write the equation: u'' = S(y) u"
        raise InputError("y is the unknown function of y'' = S y, and no name in S", hint=hint)


def declared(parameters: Collection[str], assume: Any = None) -> tuple[str, ...]:
    """The names that a user has declared: parameters, and what assumptions or values are about.  Raises `InputError`."""
    if isinstance(parameters, str):
        raise InputError(f"parameters={parameters!r} isn't a list of names", hint=f"parameters=[{parameters!r}]")
    for name in parameters:
        if not isinstance(name, str) or not name.isidentifier():
            raise InputError(f"{name!r} can't be the name of a parameter", hint="take letters and digits: EI, k_0")
        if name == PI:
            raise InputError(f"{PI} is a number, and no name of a parameter", hint="take another letter")
    return (*parameters, *map(str, assume if isinstance(assume, Mapping) else ()))


def _meaning(given: Any, source: Source, *, exponentials: bool) -> Parsed:
    """The meaning of a source; with `exponentials`, other coefficients are tried as functions of exp(k x) or with letters."""
    try:
        return read_with_numbers(source)
    except NotLinear:
        from kovacic.reading.functions import multiplied_out

        found = multiplied_out(given, source)
        if found is None:
            raise
        plain = source_of(found, source.variable, source.limits, equation=True)
        return _meaning(found, plain, exponentials=exponentials)
    except NotRational as error:
        if not exponentials:
            raise
        from kovacic.reading.functions import in_other_functions

        return in_other_functions(source, error)


def _with_note(parsed: Parsed) -> Parsed:
    """With a note if the right-hand side has a function given by its name only."""
    if parsed.equation is None or parsed.equation.h is None:
        return parsed
    from kovacic.reading.symbolic import functions_in

    names = ", ".join(sorted(map(str, functions_in(parsed.equation.h))))
    said = f"{names} on the right-hand side is any function: what is said of {parsed.equation.unknown} holds for the"
    notice = f"{said} equation with 0 there; dsolve has solutions with it"
    return replace(parsed, notices=(*parsed.notices, notice)) if names else parsed


def read_coefficients(
    a: Any, b: Any, c: Any, f: Any, *, var: Any = None, limits: Limits = DEFAULT_LIMITS, names: Collection[str] = ()
) -> Parsed:
    """The equation a y'' + b y' + c y = f; each coefficient is a string, a number, a `RatFunc` or a SymPy expression.

    Raises `InputError` and `LimitExceeded`; positions refer to the equation as it was put together.
    """
    given = (a, b, c, f)
    expressions = [*filter(_is_sympy, given)]
    for value in expressions:
        if not hasattr(value, "as_numer_denom"):
            raise InputError(f"a coefficient is a function of the variable, not {value}")
    if expressions and not any(isinstance(value, str | RatFunc) for value in given):
        import sympy

        symbols = {s.name: s for value in expressions for s in sorted(value.free_symbols, key=str)}
        only = next(iter(symbols)) if len(symbols) == 1 else DEFAULT_VARIABLE
        name = _variable_name(var) or only
        y = sympy.Function("y_" if "y" in symbols else "y")(symbols.get(name, sympy.Symbol(name)))
        equation = a * y.diff(y.args[0], 2) + b * y.diff() + c * y - f
        return read_source(source_of(equation, None, limits, unknown=y, equation=True))
    texts = [value.to_str() if isinstance(value, RatFunc) else exact_text(value, "a coefficient") for value in given]
    line = "({})*y'' + ({})*y' + ({})*y = {}".format(*texts)
    return read_input(line, var=var, limits=limits, names=names)


def _is_sympy(value: Any) -> bool:
    return any(str(cls.__module__).partition(".")[0] == "sympy" for cls in type(value).__mro__)


def _variable_name(var: Any) -> str | None:
    if var is None:
        return None
    name = var.name if _is_sympy(var) and getattr(var, "is_Symbol", False) else var
    if not isinstance(name, str):
        raise InputError(f"{var!r} can't be a variable", hint="give its name, or a SymPy symbol")
    if not name.isidentifier():
        raise InputError(f"{name!r} can't be the name of a variable", hint="take a letter or a word: x, t, x1")
    return name


def _coefficient_polynomial(coefficients: Sequence[Any], what: str, limits: Limits) -> Poly:
    if isinstance(coefficients, str | bytes) or not hasattr(coefficients, "__iter__"):
        hint = "give two sequences of numbers, low powers first: ([3, 0, 1], [1]) is x^2 + 3"
        raise InputError(f"the {what} is {type(coefficients).__name__!r}, not a sequence of coefficients", hint=hint)
    demand(limits, "degree", len(coefficients) - 1, f"the {what} has coefficients up to the degree {{}}")
    exact = []
    for power, value in enumerate(coefficients):
        if not is_rational_number(value):
            hint = "give integers, Fraction(1, 2) or sympy.Rational(1, 2)"
            if isinstance(value, float):
                hint = f"give Fraction({value!r}) if exactly this float is meant, or Fraction({str(value)!r}) for the decimal"
            said = f"the coefficient of power {power} in the {what} is {excerpt(value)!r}, not a rational number"
            raise NotRational(said, hint=hint)
        exact.append(exact_real(value, f"the coefficient of power {power}"))
    polynomial = QQ.poly(exact)
    demand(limits, "bits", polynomial.height_bits(), f"the {what} has coefficients of {{}} bits")
    return polynomial
