"""What a solution needs: where it is real, and which values of parameters are exceptions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
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
    needed = _apart(_needs(value), x)
    exceptions: list[Expr] = []
    for e in (*needed.nonzero, _wronskian(value, x)):
        exceptions += _exceptions(e)
    return Validity(_without_weaker(needed.on_x), tuple(dict.fromkeys(exceptions)))


@dataclass(frozen=True)
class _Relations:
    """Those on x, and expressions in parameters alone that aren't zero."""

    on_x: list[Expr]
    nonzero: list[Expr]


def _value_and_variable(solution: Any) -> tuple[Expr, Expr]:
    """f(x) and x for Eq(y(x), f(x)).  Raises `InputError`."""
    function = getattr(solution, "lhs", None)
    value = getattr(solution, "rhs", None)
    arguments: tuple[Any, ...] = getattr(function, "args", ())
    if value is None or len(arguments) != 1 or not arguments[0].is_Symbol:
        raise InputError(f"{solution!r} isn't a solution y(x) = ...", hint="give what dsolve returns")
    return value, arguments[0]


def _apart(relations: Iterable[Expr], x: Expr) -> _Relations:
    """Relations, each once; `true` says nothing."""
    on_x = []
    nonzero = []
    for relation in dict.fromkeys(relations):
        if _is_on_parameters(relation, x):
            nonzero.append(relation.lhs)
        elif relation != sympy.true:
            on_x.append(relation)
    return _Relations(on_x, nonzero)


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
    """Relations that make the parts of an expression real and finite, by the first need of each part."""
    if isinstance(e, sympy.Integral):
        return
    for argument in e.args:
        yield from _needs(argument)
    for need in _NEEDS:
        if need.concerns(e):
            yield need.relation(e)
            return


# ------------------------------------------------------------------------------------------------------ needs of parts


@dataclass(frozen=True)
class _Need:
    """What parts of one kind need."""

    claim: str
    #: Is it such a part?
    concerns: Callable[[Expr], bool]
    #: What makes it real and finite.
    relation: Callable[[Expr], Expr]


def _positive(e: Expr) -> Expr:
    """e > 0, which SymPy refuses to write for what is known not to be real."""
    if e.is_extended_real is False:
        return sympy.false
    return e > 0


def _not_negative(e: Expr) -> Expr:
    """e >= 0, which SymPy refuses to write for what is known not to be real."""
    if e.is_extended_real is False:
        return sympy.false
    return e >= 0


def _is_logarithm(e: Expr) -> bool:
    return isinstance(e, sympy.log)


def _is_branched(e: Expr) -> bool:
    """Is it one of Bessel's functions with a branch point at 0?"""
    if isinstance(e, sympy.besselj | sympy.besseli):
        return not e.args[0].is_integer
    return isinstance(e, _BRANCHED)


def _is_power(e: Expr) -> bool:
    """A power that may not be real or finite: not of a number, nor with a symbol that is an integer, nor exp."""
    if not e.is_Pow or isinstance(e, sympy.exp):
        return False
    is_symbolic_integer = e.exp.is_integer and not e.exp.is_Integer
    return not (e.base.is_number or is_symbolic_integer)


def _is_general_power(e: Expr) -> bool:
    return _is_power(e) and not e.exp.is_Rational


def _is_even_root(e: Expr) -> bool:
    return _is_power(e) and e.exp.is_Rational and e.exp.q % 2 == 0


def _is_below_the_line(e: Expr) -> bool:
    return _is_power(e) and e.exp.is_Rational and e.exp < 0


_NEEDS = (
    _Need("log(u): u > 0", _is_logarithm, lambda e: _positive(e.args[-1])),
    _Need("J_n(u) and the like with a branch point at 0: u > 0", _is_branched, lambda e: _positive(e.args[-1])),
    _Need("u^e, where e isn't rational: u > 0", _is_general_power, lambda e: _positive(e.base)),
    _Need("1/sqrt(u): u > 0", lambda e: _is_even_root(e) and _is_below_the_line(e), lambda e: _positive(e.base)),
    _Need("sqrt(u): u >= 0", _is_even_root, lambda e: _not_negative(e.base)),
    _Need("1/u: u != 0", _is_below_the_line, lambda e: sympy.Ne(e.base, 0)),
)


# ---------------------------------------------------------------------------------------------------------- exceptions


def _wronskian(value: Expr, x: Expr) -> Expr:
    """That of a general solution at a point, up to what isn't known; 1 where there are no two constants."""
    constants = [symbol for symbol in value.free_symbols if _CONSTANT.fullmatch(symbol.name)]
    if len(constants) != 2 or value.has(sympy.Integral):
        return sympy.S.One
    y1, y2 = (value.diff(constant) for constant in sorted(constants, key=str))
    W = y1 * y2.diff(x) - y1.diff(x) * y2
    if size(W) > _LARGEST or W.has(*constants):
        return sympy.S.One
    return _elementary_value(W, x)


def _elementary_value(W: Expr, x: Expr) -> Expr:
    """That at the first point where it is finite and elementary, and isn't zero; 1 without such a point."""
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
        base = _without_sign(_base(factor))
        if base.free_symbols:
            yield base


def _base(factor: Expr) -> Expr:
    """What is zero where a factor, a power perhaps, is."""
    if factor.is_Pow:
        return factor.base
    return factor


def _without_sign(e: Expr) -> Expr:
    if e.could_extract_minus_sign():
        return -e
    return e
