"""The behaviour of solutions, SymPy expressions, near a point: the expansion of each function where it isn't analytic.

A rule [`asymptotics`] gives, for a function of z where z tends to 0, to 1 or to infinity, an expression in elementary
functions of z and the errors beside it.  Functions without a rule, and integrals that aren't done, aren't known.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy
from sympy import exp, log

from kovacic.closed_form.jets import rewritten
from kovacic.general_solution.asymptotics import (
    AT_INFINITY,
    AT_MINUS_INFINITY,
    AT_ONE,
    AT_ZERO,
    BELOW_ZERO,
    Rule,
)
from kovacic.general_solution.expansion import CONSTANT, Expansion, ExpansionTerm, UnknownBehaviour

Expr = Any  # SymPy publishes no types
_ONE = sympy.Integer(1)
_ZERO = sympy.Integer(0)
_HYPERBOLIC = (sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch)
_QUOTIENTS: dict[Any, Callable[[Expr], Expr]] = {
    sympy.tan: lambda u: sympy.sin(u) / sympy.cos(u),
    sympy.cot: lambda u: sympy.cos(u) / sympy.sin(u),
    sympy.sec: lambda u: 1 / sympy.cos(u),
    sympy.csc: lambda u: 1 / sympy.sin(u),
}
#: Functions that are expanded as they are.
_NOT_REWRITTEN = (sympy.acos, sympy.atanh)
#: Numbers of terms that are tried, one after the other.
_DEPTHS = (4, 8, 16)


@dataclass(frozen=True)
class Approach:
    """x = point + direction * t, or direction/t for infinite points; t > 0 tends to 0."""

    point: Expr
    direction: int = 1

    @property
    def is_infinite(self) -> bool:
        return self.point in (sympy.oo, -sympy.oo)

    def in_terms_of(self, t: Expr) -> Expr:
        if self.point == sympy.oo:
            return 1 / t
        if self.point == -sympy.oo:
            return -1 / t
        return self.point + self.direction * t


def behaviour(expression: Expr, x: Expr, place: Approach) -> Expansion:
    """The expansion, up to errors that tend to 0 where as many terms show that.

    Raises `UnknownBehaviour`.

    >>> x = sympy.Symbol("x")
    >>> found = behaviour((1 - sympy.cos(x)) / x**2 + log(x), x, Approach(_ZERO))
    >>> found.terms[CONSTANT], found.terms[ExpansionTerm(k=1)]
    (1/2, 1)
    """
    t = sympy.Dummy("t", positive=True)
    inner = sympy.sympify(expression, strict=True).xreplace({x: place.in_terms_of(t)})
    found = None
    for depth in _DEPTHS:
        try:
            found = _Expander(t, depth)(inner)
        except UnknownBehaviour as unknown:
            if not unknown.deeper or depth == _DEPTHS[-1]:
                raise
            continue
        if _is_enough(found):
            break
    assert found is not None
    return found


def _is_enough(found: Expansion) -> bool:
    try:
        return all(error.size < 0 for error in found.errors)
    except UnknownBehaviour:
        return True  # more terms don't tell


class _Expander:
    """Expands expressions in t; what was expanded is kept."""

    def __init__(self, t: Expr, depth: int) -> None:
        self.depth = depth
        self.known: dict[Expr, Expansion] = {t: Expansion({ExpansionTerm(e=_ONE): _ONE})}
        self.variables = {t}  # t, and what stands for functions of t

    def __call__(self, e: Expr) -> Expansion:
        found = self.known.get(e)
        if found is None:
            found = self.known[e] = self._expanded(e)
        return found

    def _expanded(self, e: Expr) -> Expansion:
        if not e.free_symbols & self.variables:
            return Expansion.constant(e)
        if e.is_Add:
            return self._sum(e.args)
        if e.is_Mul:
            return self._product(e.args)
        if isinstance(e, exp):
            return self(e.args[0]).exp(self.depth)
        if e.is_Pow and not e.exp.free_symbols & self.variables:
            return self(e.base).power(e.exp, self.depth)
        if e.is_Pow:
            return self(e.exp * log(e.base)).exp(self.depth)
        if isinstance(e, log):
            return self(e.args[0]).log(self.depth)
        return self._function(e)

    def _sum(self, terms: Sequence[Expr]) -> Expansion:
        total = Expansion({})
        for term in terms:
            total = total + self(term)
        return total

    def _product(self, factors: Sequence[Expr]) -> Expansion:
        total = Expansion.constant(_ONE)
        for factor in factors:
            total = total * self(factor)
        return total

    def _function(self, e: Expr) -> Expansion:
        if isinstance(e, sympy.Heaviside):
            return Expansion.constant(_step_at(self(e.args[0])))
        if isinstance(e, sympy.DiracDelta):
            return Expansion({})
        if isinstance(e, _HYPERBOLIC):
            return self(e.rewrite(exp))
        if e.func in _QUOTIENTS:
            return self(_QUOTIENTS[e.func](e.args[0]))
        if not isinstance(e, _NOT_REWRITTEN):
            plain = rewritten(e)
            if plain is not None:
                return self(plain)
        inner = self._argument(e)
        if not self._is_singular(e, inner):
            found = inner.taylor(lambda z: e.func(*e.args[:-1], z), self.depth)
            if found is not None:
                return found
        if isinstance(e, sympy.sin | sympy.cos):
            return self(e.rewrite(exp))
        return self._by_rule(e, inner)

    def _is_singular(self, e: Expr, inner: Expansion) -> bool:
        """Is the argument at a singular point of the function, where SymPy has a name for the value?"""
        constant = inner.terms.get(CONSTANT, _ZERO)
        if constant == 0:
            return e.func in AT_ZERO
        return constant == 1 and e.func in AT_ONE

    def _argument(self, e: Expr) -> Expansion:
        """That of the last argument, the only one in which t occurs."""
        *parameters, last = e.args
        if isinstance(e, sympy.Integral | sympy.RootSum):
            raise _unknown(e)
        if any(p.free_symbols & self.variables for p in parameters):
            raise _unknown(e)
        return self(last)

    def _by_rule(self, e: Expr, inner: Expansion) -> Expansion:
        rules = _rules_near(e, inner)
        rule = rules.get(e.func)
        if rule is None:
            raise _unknown(e)
        z = sympy.Dummy("z", positive=True)
        *parameters, _ = e.args
        found = rule(parameters, z, self.depth)
        self.known[z] = _in_variable_of(rules, inner)
        self.variables.add(z)
        total = self(found.main)
        rest: list[ExpansionTerm] = []
        for error in found.errors:
            beside = self(error)
            rest += [*beside.terms, *beside.errors]
        return total + Expansion({}, rest)


def _in_variable_of(rules: Mapping[Any, Rule], inner: Expansion) -> Expansion:
    """z for an argument of which rules are about z, -z at minus infinity, and 1 - z at 1."""
    if rules is AT_MINUS_INFINITY:
        return inner.times(-_ONE)
    if rules is AT_ONE:
        return Expansion.constant(_ONE) + inner.times(-_ONE)
    return inner


def _step_at(inner: Expansion) -> Expr:
    """H(u) close to the point, for the expansion of u: 1 or 0 by its sign there."""
    parts = inner.parts
    if parts.large or parts.constant == 0:
        first = inner.leading()
        m = first.monomial
        if m.growth or m.k:
            raise UnknownBehaviour("how a step behaves there isn't known")
        return sympy.Heaviside(first.coefficient)
    return sympy.Heaviside(parts.constant)


def _rules_near(e: Expr, inner: Expansion) -> Mapping[Any, Rule]:
    """The table for the point to which the argument of a function tends, and for the side."""
    parts = inner.parts
    if parts.large:
        return _rules_at_infinity(e, inner)
    if parts.constant == 1 and isinstance(e, sympy.hyper):
        return AT_ONE
    if parts.constant != 0:
        raise _unknown(e)
    if e.func in BELOW_ZERO and inner.leading().coefficient.is_negative:
        return BELOW_ZERO
    return AT_ZERO


def _rules_at_infinity(e: Expr, inner: Expansion) -> Mapping[Any, Rule]:
    """For an argument whose largest term is a real multiple of a power."""
    first = inner.leading()
    m = first.monomial
    is_real_power = not m.growth and not m.k and first.coefficient.is_real
    if not is_real_power:
        raise _unknown(e)
    if first.coefficient.is_positive:
        return AT_INFINITY
    return AT_MINUS_INFINITY


def _unknown(e: Expr) -> UnknownBehaviour:
    return UnknownBehaviour(f"how {e.func.__name__} behaves there isn't known")
