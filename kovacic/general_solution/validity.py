"""What a solution needs: where it is real, and which values of parameters are exceptions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.constants import vanishing_factors
from kovacic.general_solution.needs import needs_of
from kovacic.general_solution.substitution import finite_value, size
from kovacic.general_solution.zero import is_nowhere_zero
from kovacic.parametric.assumptions import read_assumptions

Expr = Any  # SymPy publishes no types
#: The largest Wronskian that is looked at, in subexpressions.
_LARGEST = 400
#: Functions in Wronskians whose zeros are said.
_ELEMENTARY = {sympy.exp, sympy.sin, sympy.cos, sympy.log}
_CONSTANT = re.compile(r"C\d+")


@dataclass(frozen=True)
class Validity:
    """`real`: relations that make every part of the formula real and finite; `exceptions`: what must not be zero.

    `real` is `false` alone where what is assumed of symbols makes a part complex, as sqrt(k) for a negative k.  An exception
    depends on parameters alone: for values where it is zero a part has a zero denominator, or the two solutions of a general
    solution become dependent, so that other formulas hold.  Where a number in the formula isn't known to be real
    (`of_real_numbers`), the relations make it valid, and whether it is real isn't said.
    """

    real: tuple[Expr, ...]
    exceptions: tuple[Expr, ...]
    of_real_numbers: bool = True

    @property
    def claim(self) -> str:
        """What the formula is where the relations hold: "real and valid"; "valid" where a number in it isn't real."""
        if self.of_real_numbers or sympy.false in self.real:
            return "real and valid"
        return "valid"

    def __bool__(self) -> bool:
        """Is anything needed?"""
        return bool(self.real or self.exceptions)

    def __str__(self) -> str:
        """`x > 0, c**2 - 4*k*m != 0`."""
        if sympy.false in self.real:
            return "no value"
        texts = [_relation_text(relation) for relation in self.real]
        texts += [f"{e} != 0" for e in self.exceptions]
        return ", ".join(texts)


def _relation_text(relation: Expr) -> str:
    """As SymPy writes it, but for Ne(x, 0)."""
    if isinstance(relation, sympy.Ne):
        return f"{relation.lhs} != 0"
    return str(relation)


def validity(solution: Any, assume: Mapping[Any, Any] | None = None) -> Validity:
    """What a solution needs to be real and valid: an interval, and exceptional values of parameters.

    The conditions are read off the formula, part by part: arguments of roots, of logarithms and of other functions with a cut
    lie beside that, denominators aren't zero, and the Wronskian of the two solutions isn't.  Roots are SymPy's: x^(1/3) is
    complex for x < 0.  They are sufficient for real symbols; where complex parts cancel, they aren't necessary.
    What is assumed of symbols is used; `real` is `false` alone where it makes a part complex.  That gamma(a) and other
    functions of parameters alone may have poles isn't said.

    Parameters
    ----------
    solution : sympy.Eq
        What `dsolve` returns, y(x) = ...
    assume : mapping, optional
        What was assumed of parameters, as given to `dsolve`, whose answer has the user's own symbols: {"k": "positive"}.
        What it excludes isn't said; names that don't occur in the solution are passed over.

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
    >>> bool(kovacic.validity(kovacic.dsolve("y'' + k^2*y = 0"), assume={"k": "positive"}))
    False
    """
    value, x = _value_and_variable(solution)
    if assume:
        own = {symbol.name: symbol for symbol in value.free_symbols}
        said = {name: what for name, what in assume.items() if str(name) in own}
        known = read_assumptions(said, sympy.Tuple(*own.values()), tuple(own)).symbols()
        value = value.xreplace({own[name]: symbol for name, symbol in known.items()})
        x = known.get(x.name, x)
    needed = _sorted(needs_of(value), x)
    exceptions: dict[Expr, None] = {}
    for nonzero in (*needed.nonzero, _wronskian_somewhere(value, x)):
        exceptions |= dict.fromkeys(_exceptions(nonzero))
    exceptions |= dict.fromkeys(e for e in _exceptions_of_series(value, x) if not is_nowhere_zero(e))
    # The bounds of an integral may be infinite.
    numbers = (node for node in sympy.preorder_traversal(value) if node.is_number)
    is_of_real_numbers = all(number.is_extended_real for number in numbers)
    return Validity(_without_weaker(needed.on_x), _without_implied(exceptions), is_of_real_numbers)


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


def _sorted(relations: Iterable[Expr], x: Expr) -> _Relations:
    """Each once, by what it is about."""
    on_x = []
    nonzero = []
    for relation in dict.fromkeys(relations):
        if isinstance(relation, sympy.Ne) and not relation.has(x):
            nonzero.append(relation.lhs)
        elif not _holds_for_real_symbols(relation):
            on_x.append(relation)
    return _Relations(on_x, nonzero)


def _holds_for_real_symbols(relation: Expr) -> bool:
    """As exp(x) + 1 != 0 and x^2 + 1 > 0 do; nothing has to be said then."""
    real = {symbol: sympy.Dummy(real=True) for symbol in relation.free_symbols if symbol.is_real is None}
    try:
        return bool(relation.xreplace(real) == sympy.true)
    except TypeError:  # what is complex has no sign
        return False


def _without_weaker(relations: list[Expr]) -> tuple[Expr, ...]:
    """Without e >= 0 and e != 0 beside e > 0; `false` alone where it is one of them."""
    if sympy.false in relations:
        return (sympy.false,)
    positive = {relation.lhs for relation in relations if _is_strict(relation)}
    nonzero = positive | {-u for u in positive}
    return tuple(relation for relation in relations if _is_strict(relation) or relation.lhs not in nonzero)


def _is_strict(relation: Expr) -> bool:
    """Is it e > 0?"""
    return isinstance(relation, sympy.StrictGreaterThan)


# ---------------------------------------------------------------------------------------------------------- exceptions


def _exceptions_of_series(value: Expr, x: Expr) -> Iterator[Expr]:
    """What must not vanish for a pair of hypergeometric series to be defined and independent.

    The pair with the lower parameters c and 2 - c, exponents 0 and 1 - c, has the Wronskian (1 - c) w(x): the members are
    one at c = 1, and one of them has a pole at each other integer c: sin(pi c) = 0.  A single series with the lower
    parameter c has poles at c = 0, -1, ..., where 1/gamma(c) = 0.  Kummer's M(a, c, x) and
    U(a, c, x) = x^(-a) 2F0(a, a - c + 1; -1/x) have -w(x) gamma(c)/gamma(a).
    """
    series = [f for f in sorted(value.atoms(sympy.hyper), key=str) if f.argument.has(x)]
    lower = [c for f in series for c in f.bq if c.free_symbols]
    for c in dict.fromkeys(lower):
        is_pair = any(sympy.expand(c + other).is_Integer for other in lower)
        if c.is_integer is False or (not is_pair and c.is_positive):
            continue
        if is_pair:
            letters = c.as_independent(*c.free_symbols, as_Add=True)[1]
            yield sympy.S.Zero if c.is_integer else sympy.sin(sympy.pi * _without_sign(letters))
        else:
            yield 1 / sympy.gamma(c)
    for f in series:
        if len(f.ap) == 2 and not f.bq and f.ap[0].free_symbols:
            yield 1 / sympy.gamma(f.ap[0])


def _wronskian_somewhere(value: Expr, x: Expr) -> Expr:
    """W = y1 y2' - y1' y2 of a general solution C1 y1 + C2 y2 + y0 at a point where that is short and elementary, else 1.

    It is zero at no ordinary point, unless y1 and y2 are dependent.
    """
    constants = [symbol for symbol in value.free_symbols if _CONSTANT.fullmatch(symbol.name)]
    if len(constants) != 2 or value.has(sympy.Integral):
        return sympy.S.One
    first, second = sorted(constants, key=str)
    y1 = value.diff(first)
    y2 = value.diff(second)
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
        if {f.func for f in found.atoms(sympy.Function)} <= _ELEMENTARY:
            return found
    return sympy.S.One


def _exceptions(nonzero: Expr) -> Iterator[Expr]:
    """The factors with parameters that may be zero, each once and without a sign."""
    for factor in sympy.Mul.make_args(sympy.factor(vanishing_factors(nonzero))):
        base = _without_sign(factor.base if factor.is_Pow else factor)
        if base.free_symbols:
            yield base


def _without_implied(exceptions: Iterable[Expr]) -> tuple[Expr, ...]:
    """Without c + m != 0 for integers m beside sin(pi c) != 0."""
    periodic = [e.args[0] / sympy.pi for e in exceptions if isinstance(e, sympy.sin)]
    numbers = {e: [sympy.expand(c - sign * e) for c in periodic for sign in (1, -1)] for e in exceptions}
    return tuple(e for e in exceptions if not any(number.is_Integer for number in numbers[e]))


def _without_sign(e: Expr) -> Expr:
    if e.could_extract_minus_sign():
        return -e
    return e
