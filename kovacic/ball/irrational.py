"""Irrational numbers among a body's parameters: sqrt(2), pi, roots of polynomials; all zero tests are decisions.

The equations are computed over Q(parameters)(x); each irrational number that occurs, such as sqrt(2), is one more generator
of that field (see `kovacic.ball.field.Ring`).  Generators may be algebraically dependent, as sqrt(2), sqrt(3) and
sqrt(6) are: what has to be known of such numbers is whether a polynomial in them vanishes, and `sign` decides that.

Algebraic numbers are compared by their minimal polynomials.  Others, such as pi, by their digits, which tell them apart but
never show that they are equal: where equality is all that is left, `InputError` says so.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from math import prod

import sympy as sp

from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS

_DIGITS = 60


def generators(expressions: Iterable[sp.Expr]) -> tuple[sp.Expr, ...]:
    """The irrational numbers in which the expressions are rational, in SymPy's order.

    >>> generators([sp.sqrt(2) * sp.Symbol("m") + sp.pi, (1 + sp.sqrt(2)) ** -1])
    (sqrt(2), pi)
    """
    found: set[sp.Expr] = set()
    waiting = list(expressions)
    while waiting:
        node = waiting.pop()
        if not node.is_number:
            waiting += node.args
        elif not node.is_Rational:
            rational = node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer)
            if rational:
                waiting += node.args
            elif node.is_real and node.is_finite:
                found.add(node)
    return tuple(sorted(found, key=sp.default_sort_key))


@lru_cache(maxsize=1024)
def settled(value: sp.Expr) -> sp.Expr:
    """The same real number, as a rational number if it is one, else with fewer nested roots if SymPy sees how.

    What isn't a number stays as it is.

    Raises `LimitExceeded` for an algebraic number whose degree may be above the limit of `Limits.constants`.

    >>> settled(sp.sqrt(3 + 2 * sp.sqrt(2)) / (1 + sp.sqrt(2)))
    1
    """
    if not value.is_number or value.is_Rational or not value.is_algebraic:
        return value
    bound = prod(_degree(part) for part in value.atoms(sp.Pow, sp.CRootOf, sp.Function))
    if bound > DEFAULT_LIMITS.constants:
        raise LimitExceeded(
            f"the number {value} may have degree {bound} over Q, above the limit of {DEFAULT_LIMITS.constants}",
            limit="constants",
        )
    minimal = sp.minimal_polynomial(value, polys=True)
    return sp.sqrtdenest(value) if minimal.degree() > 1 else -minimal.nth(0) / minimal.nth(1)


def _degree(part: sp.Expr) -> int:
    """A bound of the degree by which a root, or cos(p pi/q) and the like, enlarges a field."""
    if isinstance(part, sp.CRootOf):
        return int(part.poly.degree())
    ratio = part.exp if part.is_Pow else part.args[0] / sp.pi
    return int(ratio.q) if ratio.is_Rational else 1


def sign(value: sp.Expr) -> int:
    """1, 0 or -1 for a real number.  Raises `InputError` where a number that isn't algebraic seems to be zero.

    >>> sign(sp.sqrt(5 + 2 * sp.sqrt(6)) - sp.sqrt(2) - sp.sqrt(3))
    0
    """
    if value.is_Rational:
        return int(sp.sign(value))
    # SymPy raises the working precision until these digits are right, and returns fewer where it can't.
    digits = sp.N(value, 15, maxn=_DIGITS)
    if digits.is_Float and digits._prec > 1 and digits:
        return 1 if digits > 0 else -1
    if value.is_algebraic:
        exact = settled(value)
        return int(sp.sign(exact)) if exact.is_Rational else (1 if sp.N(exact, 15, maxn=10_000) > 0 else -1)
    if value.equals(0):
        return 0
    raise InputError(
        f"it can't be decided whether {value} is zero", hint="take algebraic numbers, such as sqrt(2), or rational ones"
    )
