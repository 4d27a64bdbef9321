"""What a solution needs: where it is real, and which values of parameters are exceptions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.constants import vanishing_factors
from kovacic.general_solution.substitution import finite_value, size

Expr = Any  # SymPy publishes no types
#: The largest Wronskian that is looked at, in subexpressions.
_LARGEST = 400
#: Functions in Wronskians whose zeros are said.
_ELEMENTARY = {sympy.exp, sympy.sin, sympy.cos, sympy.log}
_CONSTANT = re.compile(r"C\d+")
#: Functions with a branch point at z = 0, whatever their order is.
_BRANCHED = (sympy.bessely, sympy.besselk)


@dataclass(frozen=True)
class Validity:
    """`real`: relations that make every part of the formula real and finite; `exceptions`: what must not be zero.

    An exception depends on parameters alone: for values where it is zero a part has a zero denominator, or the two solutions
    of a general solution become dependent, so that other formulas hold.
    """

    real: tuple[Expr, ...]
    exceptions: tuple[Expr, ...]

    def __bool__(self) -> bool:
        """Is anything needed?"""
        return bool(self.real or self.exceptions)

    def __str__(self) -> str:
        """`x > 0, c**2 - 4*k*m != 0`."""
        real = [f"{r.lhs} != 0" if isinstance(r, sympy.Ne) else str(r) for r in self.real]
        return ", ".join([*real, *(f"{e} != 0" for e in self.exceptions)])


def validity(solution: Any) -> Validity:
    """What a solution needs to be real and valid: an interval, and exceptional values of parameters.

    The conditions are read off the formula, part by part: arguments of even roots, of logarithms and of Bessel functions are
    positive, denominators aren't zero, and the Wronskian of the two solutions isn't.  They are sufficient; where complex parts
    cancel, they aren't necessary.  What is assumed of symbols is used.

    Parameters
    ----------
    solution : sympy.Eq
        What `dsolve` returns, y(x) = ...

    Returns
    -------
    Validity
        `real`, relations, and `exceptions`, expressions in the parameters that must not be zero.  It is false where nothing
        is needed.

    Raises
    ------
    InputError
        For what isn't such an equation.

    Examples
    --------
    >>> import kovacic
    >>> print(kovacic.validity(kovacic.dsolve("x^2*y'' + x*y' - y = log(x)")))
    x > 0
    >>> print(kovacic.validity(kovacic.dsolve("y'' + w^2*y = cos(v*x)")))
    v + w != 0, v - w != 0, w != 0
    >>> bool(kovacic.validity(kovacic.dsolve("y'' + y = x")))
    False
    """
    function = getattr(solution, "lhs", None)
    value = getattr(solution, "rhs", None)
    arguments: tuple[Any, ...] = getattr(function, "args", ())
    if value is None or len(arguments) != 1 or not arguments[0].is_Symbol:
        raise InputError(f"{solution!r} isn't a solution y(x) = ...", hint="give what dsolve returns")
    x = arguments[0]
    real: dict[Expr, None] = {}
    nonzero: dict[Expr, None] = {}
    for needed in _needs(value, x):
        if isinstance(needed, sympy.Ne) and not needed.has(x):
            nonzero |= dict.fromkeys(_exceptions(needed.lhs))
        elif needed not in (True, sympy.true):
            real[needed] = None
    nonzero |= dict.fromkeys(_exceptions(_wronskian(value, x)))
    positive = {relation.lhs for relation in real if _is_positivity(relation)}
    kept = [relation for relation in real if _is_positivity(relation) or relation.lhs not in positive]
    return Validity(tuple(kept), tuple(nonzero))


def _is_positivity(relation: Expr) -> bool:
    return isinstance(relation, sympy.StrictGreaterThan)


def _needs(e: Expr, x: Expr) -> Iterator[Expr]:
    """Relations that make the parts of an expression real and finite."""
    if isinstance(e, sympy.Integral):
        return
    for argument in e.args:
        yield from _needs(argument, x)
    if e.is_Pow and not isinstance(e, sympy.exp):
        yield from _needs_of_power(e.base, e.exp)
    elif isinstance(e, sympy.log) or _is_branched(e):
        yield e.args[-1] > 0


def _is_branched(e: Expr) -> bool:
    """Is it one of Bessel's functions with a branch point at 0?"""
    if isinstance(e, sympy.besselj | sympy.besseli):
        return not e.args[0].is_integer
    return isinstance(e, _BRANCHED)


def _needs_of_power(base: Expr, exponent: Expr) -> Iterator[Expr]:
    if base.is_number or (exponent.is_integer and not exponent.is_Integer):
        return
    is_odd_root = exponent.is_Rational and exponent.q % 2
    if is_odd_root:
        if exponent < 0:
            yield sympy.Ne(base, 0)
    elif exponent.is_Rational and exponent > 0:
        yield base >= 0
    else:
        yield base > 0


def _wronskian(value: Expr, x: Expr) -> Expr:
    """That of a general solution at a point, up to what isn't known; 1 where there are no two constants."""
    constants = sorted((s for s in value.free_symbols if _CONSTANT.fullmatch(s.name)), key=str)
    if len(constants) != 2 or value.has(sympy.Integral):
        return sympy.S.One
    y1, y2 = (value.diff(constant) for constant in constants)
    W = y1 * y2.diff(x) - y1.diff(x) * y2
    if size(W) > _LARGEST or W.has(*constants):
        return sympy.S.One
    for point in (0, 1):
        found = finite_value(W, x, sympy.Integer(point))
        if found is not None and found.is_zero is not True and _is_elementary(found):
            return found
    return sympy.S.One


def _is_elementary(e: Expr) -> bool:
    return {f.func for f in e.atoms(sympy.Function)} <= _ELEMENTARY


def _exceptions(value: Expr) -> Iterator[Expr]:
    """The factors with parameters that may be zero, each once and without a sign."""
    for factor in sympy.Mul.make_args(sympy.factor(vanishing_factors(value))):
        base = factor.base if factor.is_Pow else factor
        if base.free_symbols:
            yield -base if base.could_extract_minus_sign() else base
