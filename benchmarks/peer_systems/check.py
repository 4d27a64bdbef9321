"""Is an answer right?  Substituted into the equation at complex points with 30 digits, independently of every system.

    y         y'' - S y at the points, y'' by the second difference with so many digits that 30 are left; symbolically
              where y has an unevaluated integral, which may be any antiderivative: it is differentiated by the fundamental
              theorem, and its value is then a free constant, for which a random number is put.  |u| is taken as
              sqrt(u^2), which is analytic.
    omega     omega' + omega^2 - S.
    riccati   at each root W of the polynomial, W' = -M_x/M_W, and W' + W^2 - S.  (Python packages give the coefficients
              from W^0 on, and the minimal polynomial of the constant c or "".)

An identity between analytic functions that holds at a point for one branch of the radicals in the answer holds on that
branch: so one point where it holds is enough ("right"), but the points where it doesn't are counted, because the formula
then isn't right as it stands ("right on a branch").

Runs as a process of its own (`python check.py`, JSON lines in and out), because differentiating a large answer may take long.
"""

from __future__ import annotations

import base64
import json
import pickle
import random
import re
import sys
from collections.abc import Callable
from typing import Any

import flint
import mpmath
import sympy
from sympy.parsing.sympy_parser import parse_expr

DIGITS = 30
_WORKING_DIGITS = 140

# A SymPy expression of `server.py`.
PICKLED = "pickle:"
POINTS = 6
_X = sympy.Symbol("x")
_W = sympy.Symbol("omega_")
_C = sympy.Symbol("c")


class Unreadable(Exception):
    """The expression has functions that aren't known here."""


def read(text: str, syntax: str) -> Any:
    """An expression of a system's as a SymPy expression."""
    if syntax == "python":
        if text.startswith(PICKLED):
            return pickle.loads(base64.b64decode(text.removeprefix(PICKLED)))
        return parse_expr(text, {"x": _X, "omega_": _W, "c": _C})
    names: dict[str, Any] = {
        "x": _X,
        "omega_": _W,
        "E_": sympy.E,
        "I_": sympy.I,
        "PI_": sympy.pi,
        "sqrt": sympy.sqrt,
        "exp": sympy.exp,
        "log": sympy.log,
        "ln": sympy.log,
        "erf": sympy.erf,
        "erfi": sympy.erfi,
        "sin": sympy.sin,
        "cos": sympy.cos,
        "tan": sympy.tan,
        "sinh": sympy.sinh,
        "cosh": sympy.cosh,
        "asin": sympy.asin,
        "acos": sympy.acos,
        "atan": sympy.atan,
        "asinh": sympy.asinh,
        "acosh": sympy.acosh,
        "atanh": sympy.atanh,
        "abs": lambda u: sympy.sqrt(u**2),
        "uppergamma": sympy.uppergamma,
        "expint": sympy.expint,
        "Integral_": _integral,
        "K1": sympy.Symbol("K1"),
        "K2": sympy.Symbol("K2"),
    }
    if syntax == "maxima":
        for old, new in (("%e", "E_"), ("%i", "I_"), ("%pi", "PI_"), ("%k", "K"), ("'integrate", "Integral_")):
            text = text.replace(old, new)
        text = text.replace("gamma_incomplete(", "uppergamma(").replace("expintegral_e(", "expint(")
    elif syntax == "fricas":
        text = re.sub(r"%i\b", "I_", text.replace("pi()", "PI_").replace("%e", "E_"))
        text = text.replace("Gamma(", "uppergamma(").replace("integral(", "Integral_(").replace("%", "V_")
        for variable in set(re.findall(r"V_\w+", text)):
            names[variable] = sympy.Symbol(variable)
    else:
        text = re.sub(r"\bi\b", "I_", re.sub(r"\bpi\b", "PI_", text)).replace("integrate(", "Integral_(")
    for name in set(re.findall(r"[A-Za-z_]\w*", text)):
        if name not in names:
            raise Unreadable(name)
    return parse_expr(text.replace("^", "**").replace("=", ","), names)


def _integral(integrand: Any, *variables: Any) -> Any:
    """An antiderivative; FriCAS writes a bound variable in the integrand."""
    if len(variables) == 2:
        integrand = integrand.subs(variables[0], variables[1])
    return sympy.Integral(integrand, _X)


def check(S_text: str, form: str, syntax: str, expressions: list[str]) -> str:
    """ "right", "right on a branch", "wrong" or "unchecked"."""
    S = parse_expr(S_text.replace("^", "**"), {"x": _X})
    rng = random.Random(S_text)
    points = [mpmath.mpc(rng.uniform(0.3, 2.5), rng.uniform(-1.0, 1.0)) for _ in range(POINTS - 2)]
    points += [mpmath.mpc(rng.uniform(-2.5, -0.3), rng.uniform(-1.0, 1.0)) for _ in range(2)]
    with mpmath.workdps(_WORKING_DIGITS):
        if form == "riccati":
            if syntax == "python":
                *texts, constant = expressions
                return _verdict([_riccati_holds(S_text, [_function(text) for text in texts], constant, points)])
            polynomial = sympy.Poly(read(expressions[0], syntax), _W)
            functions = [sympy.lambdify((_X, _C), f, "mpmath") for f in reversed(polynomial.all_coeffs())]
            return _verdict([_riccati_holds(S_text, functions, "", points)])
        verdicts = []
        for text in expressions:
            expression = read(text, syntax)
            candidates = _candidates(expression) if form == "y" else [expression]
            verdicts += [_holds(S, candidate, form, points, rng) for candidate in candidates]
        return _verdict(verdicts)


def _verdict(found: list[list[bool]]) -> str:
    """Every expression must hold somewhere."""
    if not found or any(not holds for holds in found):
        return "unchecked"
    if all(all(holds) for holds in found):
        return "right"
    return "right on a branch" if all(any(holds) for holds in found) else "wrong"


def _candidates(y: Any) -> list[Any]:
    """The solutions within a general solution: each constant 1 and the others 0."""
    constants = sorted((s for s in y.free_symbols if re.fullmatch(r"[CK][12]", s.name)), key=str)
    if not constants:
        return [y]
    return [y.subs({c: int(c == chosen) for c in constants}) for chosen in constants]


def _holds(S: Any, expression: Any, form: str, points: list[Any], rng: random.Random) -> list[bool]:
    if form == "omega":
        free = [s for s in expression.free_symbols if s != _X]
        expression = expression.subs({s: rng.randint(2, 9) for s in free})
        pieces = [expression.diff(_X), expression**2, -S]
    else:
        if expression == 0:
            return [False]
        y, integrands = _integrals_as_symbols(expression)
        if not integrands:
            return _holds_by_differences(S, y, points)
        values = {J: sympy.Rational(rng.randint(1, 10**6), 10**6) + sympy.I * rng.randint(1, 9) for J in integrands}
        slope = _derivative(y, integrands)
        pieces = [piece.subs(values) for piece in (_derivative(slope, integrands), -S * y)]
    functions = [sympy.lambdify(_X, piece, "mpmath") for piece in pieces]
    return [value for value in (_vanishes(functions, point) for point in points) if value is not None]


def _holds_by_differences(S: Any, y: Any, points: list[Any]) -> list[bool]:
    """With the second difference at a distance of 10^-25 for y'': the derivative of a large expression is larger still."""
    f, coefficient, h = sympy.lambdify(_X, y, "mpmath"), sympy.lambdify(_X, S, "mpmath"), mpmath.mpf(10) ** -25
    pieces = [lambda x: (f(x + h) - 2 * f(x) + f(x - h)) / h**2, lambda x: -coefficient(x) * f(x)]
    return [value for value in (_vanishes(pieces, point) for point in points) if value is not None]


def _integrals_as_symbols(expression: Any) -> tuple[Any, dict[Any, Any]]:
    """The expression with a symbol for each integral, the inner ones first; and the integrands, in such symbols.

    SymPy's own derivative rewrites integrals (it pulls constants out), and would make two of one.
    """
    integrands: dict[Any, Any] = {}
    expression = expression.replace(lambda e: isinstance(e, sympy.RootSum), _explicit)
    while integrals := expression.atoms(sympy.Integral):
        inner = next(i for i in integrals if not i.function.atoms(sympy.Integral))
        symbol = sympy.Symbol(f"J{len(integrands)}")
        integrands[symbol] = inner.function
        expression = expression.xreplace({inner: symbol})
    return expression, integrands


def _explicit(roots: Any) -> Any:
    """A sum over the roots of a polynomial, with the roots as numbers."""
    coefficients = roots.poly.clear_denoms()[1].all_coeffs()
    with flint.ctx.workdps(_WORKING_DIGITS):
        found = [root for root, _ in flint.fmpz_poly([int(c) for c in coefficients[::-1]]).complex_roots()]
        parts = [[part.str(_WORKING_DIGITS, radius=False) for part in (root.real, root.imag)] for root in found]
    values = (sympy.Float(re, _WORKING_DIGITS) + sympy.I * sympy.Float(im, _WORKING_DIGITS) for re, im in parts)
    return sum(roots.fun(value) for value in values)


def _derivative(expression: Any, integrands: dict[Any, Any]) -> Any:
    """d/dx, the symbols of integrals being functions of x."""
    return expression.diff(_X) + sum(expression.diff(J) * f for J, f in integrands.items())


def _vanishes(functions: list[Callable[[Any], Any]], point: Any) -> bool | None:
    """Is the sum zero to 30 digits, relative to its terms?  None where it can't be evaluated."""
    try:
        values = [mpmath.mpmathify(function(point)) for function in functions]
    except (ZeroDivisionError, ValueError, TypeError, NameError, OverflowError, KeyError, mpmath.libmp.NoConvergence):
        return None
    size = max(abs(value) for value in values)
    if not mpmath.isfinite(size):
        return None
    return bool(abs(sum(values)) <= size * mpmath.mpf(10) ** -DIGITS)


def _riccati_holds(S_text: str, coefficients: list[Any], constant: str, points: list[Any]) -> list[bool]:
    """For the coefficients of W^0, ..., W^n, functions of (x, c), and the minimal polynomial of c."""
    constants = sympy.Poly(read(constant, "python"), _C).nroots(n=_WORKING_DIGITS, maxsteps=500) if constant else [0]
    scalar = _function(S_text.replace("^", "**"))
    result = []
    for value in map(mpmath.mpmathify, constants):
        for point in points[: 3 if len(coefficients) <= 3 else 1]:  # each with all roots
            c = [f(point, value) for f in reversed(coefficients)]
            d = [mpmath.diff(lambda x, f=f, value=value: f(x, value), point) for f in reversed(coefficients)]
            n = len(c) - 1
            derivative = [c[k] * (n - k) for k in range(n)]
            for root in mpmath.polyroots(c, maxsteps=200, extraprec=200) if n > 1 else [-c[1] / c[0]]:
                change = -mpmath.polyval(d, root) / mpmath.polyval(derivative, root)
                terms = [change, root**2, -scalar(point, 0)]
                size = max(abs(t) for t in terms)
                result.append(bool(abs(sum(terms)) <= size * mpmath.mpf(10) ** -DIGITS))
    return result if all(result) else [False]


def _function(text: str) -> Callable[[Any, Any], Any]:
    """A function of (x, c) from a text of numbers, x, c, + - * / ** and parentheses, without SymPy, which is slow here."""
    if not re.fullmatch(r"[0-9xc+\-*/() ]*", text):
        raise Unreadable(text[:40])
    constants: list[Any] = []

    def constant(match: re.Match[str]) -> str:
        constants.append(mpmath.mpf(match.group(2)))
        return f"{match.group(1)}N[{len(constants) - 1}]"

    # Numbers that aren't exponents, so that no quotient is one of Python's integers.
    code = compile(re.sub(r"((?<!\*)\*|(?<![\d*]))(\d+)", constant, text), "coefficient", "eval")
    return lambda x, c: mpmath.mpmathify(eval(code, {"__builtins__": {}, "N": constants, "x": x, "c": c}))


def main() -> None:
    sys.setrecursionlimit(10_000)
    for line in sys.stdin:
        S, form, syntax, expressions = json.loads(line)
        try:
            verdict = check(S, form, syntax, expressions)
        except (
            Unreadable,
            RecursionError,
            SyntaxError,
            TypeError,
            AttributeError,
            NotImplementedError,
            ValueError,
        ) as error:
            verdict = f"unchecked: {type(error).__name__} {error}"[:200]
        print(json.dumps(verdict))
        print("<<<end>>>", flush=True)


if __name__ == "__main__":
    main()
