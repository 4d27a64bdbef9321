"""Is an answer right?  Substituted into the equation at complex points with 30 digits, independently of every system.

    y         y'' - S y at the points, y'' from the Taylor coefficients of `taylor.py`, with so many digits that 30 are
              left.  An unevaluated integral may be any antiderivative: a random number is put for its value.  |u| is
              taken as sqrt(u^2), which is analytic.
    omega     omega' + omega^2 - S.
    riccati   at each root W of the polynomial, W' = -M_x/M_W, and W' + W^2 - S.  (Python packages give the coefficients
              from W^0 on, and the minimal polynomial of the constant c or "".)

An identity between analytic functions that holds at a point for one branch of the radicals in the answer holds on that
branch: so one point where it holds is enough ("right"), but the points where it doesn't are counted, because the formula
then isn't right as it stands ("right on a branch").

Runs as a process of its own (`python check.py`, JSON lines in and out), because a large answer may take long.
"""

from __future__ import annotations

import base64
import json
import pickle
import random
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import sympy
from sympy.parsing.sympy_parser import parse_expr

sys.path.insert(0, str(Path(__file__).parent.parent))

from peer_systems.taylor import Expansion, Known, Unreadable

DIGITS = 30
_WORKING_DIGITS = 140

# A SymPy expression of `server.py`.
PICKLED = "pickle:"
POINTS = 6
_X = sympy.Symbol("x")
_W = sympy.Symbol("omega_")
_C = sympy.Symbol("c")


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
            # Multiple roots, as giac has them where omega is rational, would be found to half the digits or fewer.
            polynomial = sympy.Poly(read(expressions[0], syntax), _W).sqf_part()
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
    """At each point where the expression can be evaluated: does it satisfy the equation?"""
    if form == "omega":
        free = sorted((s for s in expression.free_symbols if s != _X), key=str)
        expression = expression.subs({s: rng.randint(2, 9) for s in free})
    elif expression == 0:
        return [False]
    known = Known(rng)

    def residues(point: Any) -> list[Any]:
        near = Expansion({_X: [point, mpmath.mpf(1)]}, known)
        value, first, second = [*near(expression), 0, 0][:3]
        coefficient = near(S)[0]
        return [first, value**2, -coefficient] if form == "omega" else [2 * second, -coefficient * value]

    return [holds for holds in (_vanishes(residues, point) for point in points) if holds is not None]


def _vanishes(terms: Callable[[Any], list[Any]], point: Any) -> bool | None:
    """Is the sum of the terms zero to 30 digits, relative to them?  None where they can't be evaluated."""
    try:
        values = [mpmath.mpmathify(value) for value in terms(point)]
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
            mpmath.libmp.NoConvergence,
        ) as error:
            verdict = f"unchecked: {type(error).__name__} {error}"[:200]
        print(json.dumps(verdict))
        print("<<<end>>>", flush=True)


if __name__ == "__main__":
    main()
