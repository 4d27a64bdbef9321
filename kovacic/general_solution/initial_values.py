"""Initial and boundary values as a user writes them, and the constants that they determine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import sympy
from flint import acb, arb, ctx
from sympy import acos, atan, cos, cosh, exp, log, sin, sinh, tan, tanh
from sympy.simplify.fu import TR8, TR2i

from kovacic.algebra.apart import last_of
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.jets import ANTIDERIVATIVES, jet
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.general_solution.antiderivatives import prepared
from kovacic.general_solution.values import SECONDS, size, value_at
from kovacic.general_solution.variation import Basis
from kovacic.limits import watched_seconds
from kovacic.reading.exponential import in_terms_of
from kovacic.reading.parser import listed, shown

#: Functions whose values are simplified, in constants of so many subexpressions.
_ELEMENTARY = {exp, log, sin, cos, tan, sinh, cosh, tanh, atan, acos}
_LONGEST = 200


@dataclass(frozen=True)
class Given:
    """y(point) = value for order 0, y'(point) = value for order 1."""

    point: Any
    order: int
    value: Any


def as_mapping(ics: Mapping[Any, Any] | str | None) -> dict[Any, Any]:
    """Values that are given as a mapping, or as one text: "y(0)=1, y'(0)=0".  Raises `InputError`."""
    if not isinstance(ics, str):
        return dict(ics or {})
    found: dict[Any, Any] = {}
    for part in listed(ics) if ics.strip() else ():
        place, separator, value = (piece.strip() for piece in part.partition("="))
        if not (separator and place and value) or place in found:
            raise InputError(f"{ics!r} aren't initial values", hint='write "y(0)=1, y\'(0)=0", every value once')
        found[place] = value
    return found


def read_values(ics: Mapping[Any, Any], function: Any, equation: Equation) -> tuple[Given, ...]:
    """The values that are given.  Raises `InputError`, for a singular point too."""
    found = []
    for key, value in ics.items():
        point, order = _text_key(key, equation) if isinstance(key, str) else _sympy_key(key, function)
        found.append(Given(point, order, _exact(value)))
    atoms = Atoms(sympy.Symbol(equation.variable))
    dens = [den for part in (equation.b, equation.c) if (den := (part / equation.a).den).degree > 0]
    for point in {given.point for given in found} if dens else ():
        if equation.change is not None:
            point = in_terms_of(equation.change, atoms.x, equation.variable).subs(equation.change.variable, point)
        for den in dens:
            value = atoms.poly(den).subs(atoms.x, point)
            if value.is_finite is not False and _is_zero(value):
                raise InputError(f"{point} is a singular point of the equation")
    return tuple(found)


def _exact(value: Any) -> Any:
    """A SymPy expression; a float is the decimal that it is written as."""
    if isinstance(value, str):
        from kovacic.reading.symbolic import read_expression

        return read_expression(value, what="the initial value")
    try:
        given = sympy.Rational(repr(float(value))) if isinstance(value, float) else sympy.sympify(value, strict=True)
        exact = given.xreplace({number: sympy.Rational(str(number)) for number in given.atoms(sympy.Float)})
    except (sympy.SympifyError, TypeError, ValueError, AttributeError):
        raise InputError(
            f"the value {value!r} can't be read", hint="give a number, or text such as 'sqrt(2)'"
        ) from None
    if not isinstance(exact, sympy.Expr) or exact.has(sympy.oo, sympy.nan, sympy.zoo):
        raise InputError(f"the value {value!r} isn't a finite number")
    return exact


def _text_key(key: str, equation: Equation) -> tuple[Any, int]:
    """`y(0)` and `y'(0)`."""
    head, separator, rest = key.partition("(")
    name = head.strip()
    order = len(name) - len(name.rstrip("'"))
    if name.rstrip("'") != equation.unknown or not separator or not rest.rstrip().endswith(")") or order > 1:
        y = equation.unknown
        raise InputError(f"{key!r} isn't an initial value", hint=f"write {{'{y}(0)': 1, \"{y}'(0)\": 2}}")
    return _exact(rest.rstrip()[:-1]), order


def _sympy_key(key: Any, function: Any) -> tuple[Any, int]:
    """y(x0), and y(x).diff(x).subs(x, x0) in either form that SymPy gives it."""
    if getattr(key, "func", None) == function.func and len(key.args) == 1:
        return _exact(key.args[0]), 0
    is_substitution = type(key).__name__ == "Subs"
    if is_substitution or getattr(key, "is_Derivative", False):
        derivative = key.expr if is_substitution else key
        point = key.point[0] if is_substitution else derivative.expr.args[0]
        orders = [int(count) for _, count in derivative.variable_count]
        if derivative.expr.func == function.func and orders == [1]:
            return _exact(point), 1
    raise InputError(f"{key} isn't an initial value", hint="write {y(0): 1, y(x).diff(x).subs(x, 0): 2}")


def constants(given: Sequence[Given], basis: Basis, particular: Any, names: Sequence[Any]) -> dict[Any, Any]:
    """The constants that the values determine: both, one in terms of the other, or none.

    Raises `InputError` where there is no solution with these values.
    """
    rows = []
    for item in given:
        u, v, w = (value_at(y, basis.x, item.point, item.order) for y in (basis.y1, basis.y2, particular))
        rows.append((u, v, item.value - w))
    initial = len(rows) == 2 and given[0].point == given[1].point and given[0].order != given[1].order
    for (a, b, r), (c, d, s) in combinations(rows, 2):
        determinant = a * d - b * c
        if initial and not sympy.sympify(determinant).is_Rational:  # the Wronskian at an ordinary point, often shorter
            W = value_at(basis.wronskian, basis.x, given[0].point) * (1 if given[0].order == 0 else -1)
            determinant = W if agree(W, determinant) else determinant
        if initial or not _is_zero(determinant):
            values, used = [tidy((r * d - b * s) / determinant), tidy((a * s - r * c) / determinant)], 2
            break
    else:
        values, used = list(names), 0
        pivot = next(((u, v, r) for u, v, r in rows if not (_is_zero(u) and _is_zero(v))), None)
        if pivot is not None:
            (u, v, r), used = pivot, 1
            k = 0 if _is_zero(v) else 1
            values[k] = tidy(r / (u, v)[k]) - (0 if k == 0 else tidy(u / v) * names[0])
    if len(rows) > used and any(not _is_zero(u * values[0] + v * values[1] - r) for u, v, r in rows):
        raise InputError("there is no solution with these values: the conditions contradict one another")
    return dict(zip(names, values, strict=True))


def tidy(value: Any) -> Any:
    """A shorter form of a constant, where that is known at once."""
    value = sympy.sympify(value, strict=True)
    irrational = any(not p.exp.is_Rational and not p.base.is_Symbol for p in value.atoms(sympy.Pow))
    functions = {f.func for f in value.atoms(sympy.Function)}
    if value.is_Rational or irrational or size(value) > _LONGEST or value.has(sympy.RootSum, sympy.Integral):
        return value
    if not value.free_symbols and functions <= {exp, log} and not value.has(sympy.Add):  # a product of powers
        return value
    if not functions:
        return sympy.radsimp(sympy.cancel(value) if value.free_symbols or value.has(sympy.E) else sympy.expand(value))
    if not functions <= _ELEMENTARY:
        expanded = sympy.expand(value)
        return min((value, expanded, sympy.expand(TR8(expanded))), key=size)
    shorter = sympy.cancel(value)
    return shorter if functions == {exp} else min(map(TR2i, (value, shorter)), key=size)


def _ball(value: Any) -> Any:
    """The value of a constant, with generic values for symbols, in a ball; None where that can't be computed."""
    if value.has(*ANTIDERIVATIVES):
        return None
    try:
        return jet(value, sympy.Dummy(), acb(0))[0]
    except NotImplementedError:
        return None


def agree(value: Any, other: Any) -> bool:
    """Are two expressions for a constant, of which one was found at another point, the same to 50 digits?"""
    with ctx.workdps(3 * DIGITS):
        difference = _ball(value - other)
        return difference is not None and bool(abs(difference) < arb(10) ** -DIGITS)


def _is_zero(value: Any) -> bool:
    """Is a constant zero?  By a ball where it isn't, else by SymPy, for some seconds; symbols have generic values.

    Raises `NotImplementedError` where that can't be told.
    """
    value = sympy.sympify(value, strict=True)
    if value.is_Rational:
        return bool(value == 0)
    with ctx.workdps(DIGITS):
        ball = _ball(value)
        if ball is not None and not ball.contains(0):
            return False
    answer = last_of(_zero, value, seconds=watched_seconds(SECONDS))
    if answer is None or (ball is not None and value.free_symbols and not answer):  # SymPy's numbers break assumptions
        raise NotImplementedError(f"undecided: whether {shown(value, 60)} is zero")
    return bool(answer)


def _zero(value: Any) -> Iterator[bool]:
    if not value.free_symbols and abs(value.evalf(30, maxn=100)) > sympy.Float("1e-20"):
        yield False
        return
    above = sympy.numer(sympy.together(prepared(value)))  # a sum of waves, as sin(a) cos(b) isn't
    if sympy.expand(TR8(sympy.expand(above))) == 0:
        yield True
        return
    answer = value.equals(0)  # None where neither simplification nor numbers tell
    if answer is not None:
        yield bool(answer)
