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

    `real` is `false` alone where what is assumed of symbols makes a part complex, as sqrt(k) for a negative k.  An exception
    depends on parameters alone: for values where it is zero a part has a zero denominator, or the two solutions of a general
    solution become dependent, so that other formulas hold.
    """

    real: tuple[Expr, ...]
    exceptions: tuple[Expr, ...]

    def __bool__(self) -> bool:
        """Is anything needed?"""
        return bool(self.real or self.exceptions)

    def __str__(self) -> str:
        """`x > 0, c**2 - 4*k*m != 0`."""
        if sympy.false in self.real:
            return "no value"
        return ", ".join([*map(_relation_text, self.real), *(f"{e} != 0" for e in self.exceptions)])


def _relation_text(relation: Expr) -> str:
    """As SymPy writes it, but for Ne(x, 0)."""
    if isinstance(relation, sympy.Ne):
        return f"{relation.lhs} != 0"
    return str(relation)


def validity(solution: Any) -> Validity:
    """What a solution needs to be real and valid: an interval, and exceptional values of parameters.

    The conditions are read off the formula, part by part: arguments of even roots, of logarithms and of Bessel functions are
    positive, denominators aren't zero, and the Wronskian of the two solutions isn't.  They are sufficient; where complex parts
    cancel, they aren't necessary.  What is assumed of symbols is used; `real` is `false` alone where it makes a part complex.

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
    value, x = _value_and_variable(solution)
    needed = dict.fromkeys(_needs(value))
    real: list[Expr] = []
    nonzero: list[Expr] = []
    for relation in needed:
        if _is_on_parameters(relation, x):
            nonzero += _exceptions(relation.lhs)
        elif relation != sympy.true:
            real.append(relation)
    nonzero += _exceptions(_wronskian(value, x))
    return Validity(_without_weaker(real), tuple(dict.fromkeys(nonzero)))


def _value_and_variable(solution: Any) -> tuple[Expr, Expr]:
    """f(x) and x for Eq(y(x), f(x)).  Raises `InputError`."""
    function = getattr(solution, "lhs", None)
    value = getattr(solution, "rhs", None)
    arguments: tuple[Any, ...] = getattr(function, "args", ())
    if value is None or len(arguments) != 1 or not arguments[0].is_Symbol:
        raise InputError(f"{solution!r} isn't a solution y(x) = ...", hint="give what dsolve returns")
    return value, arguments[0]


def _is_on_parameters(relation: Expr, x: Expr) -> bool:
    """Does it say that an expression in parameters alone isn't zero?"""
    return isinstance(relation, sympy.Ne) and not relation.has(x)


def _without_weaker(relations: list[Expr]) -> tuple[Expr, ...]:
    """Without e >= 0 and e != 0 beside e > 0; `false` alone where it is one of them."""
    if sympy.false in relations:
        return (sympy.false,)
    strict = [relation for relation in relations if isinstance(relation, sympy.StrictGreaterThan)]
    positive = {relation.lhs for relation in strict}
    return tuple(relation for relation in relations if relation in strict or relation.lhs not in positive)


def _needs(e: Expr) -> Iterator[Expr]:
    """Relations that make the parts of an expression real and finite."""
    if isinstance(e, sympy.Integral):
        return
    for argument in e.args:
        yield from _needs(argument)
    if e.is_Pow and not isinstance(e, sympy.exp):
        yield from _needs_of_power(e.base, e.exp)
    elif isinstance(e, sympy.log) or _is_branched(e):
        yield _positive(e.args[-1])


def _positive(e: Expr) -> Expr:
    """e > 0, which SymPy refuses to write for what is known not to be real."""
    if e.is_extended_real is False:
        return sympy.false
    return e > 0


def _is_branched(e: Expr) -> bool:
    """Is it one of Bessel's functions with a branch point at 0?"""
    if isinstance(e, sympy.besselj | sympy.besseli):
        return not e.args[0].is_integer
    return isinstance(e, _BRANCHED)


def _needs_of_power(base: Expr, exponent: Expr) -> Iterator[Expr]:
    """No zero under a line, no negative number under an even root; no numbers, and no powers with an integer n."""
    is_symbolic_integer = exponent.is_integer and not exponent.is_Integer
    if base.is_number or is_symbolic_integer:
        return
    if not exponent.is_Rational:
        yield _positive(base)
        return
    is_below_the_line = exponent < 0
    is_even_root = exponent.q % 2 == 0
    if is_even_root and is_below_the_line:
        yield _positive(base)
    elif is_even_root:
        yield _not_negative(base)
    elif is_below_the_line:
        yield sympy.Ne(base, 0)


def _not_negative(e: Expr) -> Expr:
    """e >= 0, which SymPy refuses to write for what is known not to be real."""
    if e.is_extended_real is False:
        return sympy.false
    return e >= 0


def _wronskian(value: Expr, x: Expr) -> Expr:
    """That of a general solution at a point, up to what isn't known; 1 where there are no two constants."""
    constants = [symbol for symbol in value.free_symbols if _CONSTANT.fullmatch(symbol.name)]
    if len(constants) != 2 or value.has(sympy.Integral):
        return sympy.S.One
    y1, y2 = (value.diff(constant) for constant in sorted(constants, key=str))
    W = y1 * y2.diff(x) - y1.diff(x) * y2
    if size(W) > _LARGEST or W.has(*constants):
        return sympy.S.One
    for point in (0, 1):
        found = finite_value(W, x, sympy.Integer(point))
        if found is None or found.is_zero:
            continue
        if _is_elementary(found):
            return found
    return sympy.S.One


def _is_elementary(e: Expr) -> bool:
    return {f.func for f in e.atoms(sympy.Function)} <= _ELEMENTARY


def _exceptions(value: Expr) -> Iterator[Expr]:
    """The factors with parameters that may be zero, each once and without a sign."""
    for factor in sympy.Mul.make_args(sympy.factor(vanishing_factors(value))):
        base = factor
        if factor.is_Pow:
            base = factor.base
        if base.could_extract_minus_sign():
            base = -base
        if base.free_symbols:
            yield base
