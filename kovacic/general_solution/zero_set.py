"""`ZeroSet`: the values of letters for which an expression is zero, where an answer has an exception or a condition."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy
from sympy import Mul, cosh, exp, gamma, sinh, together

from kovacic.general_solution.substitution import in_single_waves, size
from kovacic.general_solution.textbook import in_hyperbolic_functions
from kovacic.general_solution.zero import by_parity, is_nowhere_zero
from kovacic.limits import manageable

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class ZeroSet:
    """The values of letters for which `expression` vanishes: it is empty, and false, without `factors`.

    >>> k, n = sympy.symbols("k n")
    >>> print(ZeroSet(k**2 * exp(k)), "|", ZeroSet(1 / gamma(-n)), "|", ZeroSet(sympy.sin(k) / k))
    k = 0 | n is one of 0, 1, 2, ... | sin(k) = 0 and k != 0
    """

    expression: Expr

    @cached_property
    def factors(self) -> tuple[Expr, ...]:
        """The factors with letters that may be zero, each once, without powers and signs."""
        found = []
        for factor in _factors_with_zeros(self.expression):
            # the inverse of a gamma function is zero at its poles
            is_below = factor.is_Pow and factor.exp.is_negative and not factor.has(gamma)
            if factor.free_symbols and not is_below and not _has_no_zero(factor):
                found.append(-factor if factor.could_extract_minus_sign() else factor)
        return tuple(dict.fromkeys(found))

    def __bool__(self) -> bool:
        return bool(self.factors)

    def __str__(self) -> str:
        return self.said()

    def said(self, answer: Expr = sympy.S.Zero) -> str:
        """`equation`, and that it is defined: sin(k)/k is 1 at k = 0, where its factor sin(k) vanishes."""
        below = Mul.make_args(sympy.fraction(together(self.expression))[1])
        product = Mul(*self.factors)
        bases = (factor.as_base_exp()[0] for factor in below)
        guarding = (ZeroSet(b).factors for b in bases if b.free_symbols and _where_zero(product, b) == 0)
        return " and ".join([self.equation(answer), *(f"{Mul(*zeros)} != 0" for zeros in guarding if zeros)])

    def equation(self, answer: Expr = sympy.S.Zero) -> str:
        """`k = 0`; in hyperbolic functions if the answer has these."""
        left = Mul(*self.factors)
        if poles := gamma_zeros(left):
            return f"{poles[0]} is one of 0, {poles[1]}, {2 * poles[1]}, ..."
        if answer.has(sinh, cosh):
            factors = Mul.make_args(in_hyperbolic_functions(left))
            left = Mul(*(factor for factor in factors if not is_nowhere_zero(factor)))
        return f"{-left if left.could_extract_minus_sign() else left} = 0"


def gamma_zeros(e: Expr) -> tuple[Expr, int] | None:
    """(n, 1) for 1/gamma(-n), which is zero at 0, 1, 2, ...; (n, -1) for 1/gamma(n); None for other expressions."""
    if not isinstance(1 / e, gamma):
        return None
    u = min((1 / e).args[0], together((1 / e).args[0]), key=size)
    return (-u, 1) if u.could_extract_minus_sign() else (u, -1)


def inequality(e: Expr) -> str:
    """`k != 0`, or `n is none of 0, 1, 2, ...`."""
    poles = gamma_zeros(e)
    return f"{poles[0]} is none of 0, {poles[1]}, {2 * poles[1]}, ..." if poles else f"{e} != 0"


def independent_exceptions(exceptions: Iterable[Expr]) -> tuple[Expr, ...]:
    """The exceptions without c + m and 1/gamma(c + m), m an integer, beside sin(pi c); 1/gamma(c) for c and 1/gamma(c + 1)."""
    exceptions = tuple(dict.fromkeys(exceptions))
    for inverse in [e for e in exceptions if isinstance(1 / e, gamma)]:
        c = sympy.expand((1 / inverse).args[0] - 1)
        others = [e for e in exceptions if not sympy.cancel(e / c).is_number]
        if len(others) < len(exceptions):
            exceptions = tuple(1 / gamma(c) if e == inverse else e for e in others)
    periodic = [e.args[0] / sympy.pi for e in exceptions if isinstance(e, sympy.sin)]

    def is_implied(e: Expr) -> bool:
        number = (gamma_zeros(e) or (e,))[0]
        return any(sympy.cancel(number - sign * c).is_Integer for c in periodic for sign in (1, -1))

    return tuple(dict.fromkeys(e for e in exceptions if not is_implied(e)))


def _factors_with_zeros(zero: Expr) -> Iterator[Expr]:
    """The factors, and b for b^c, which is zero for b = 0 alone if c is positive.

    With real a and b, a - b in the place of exp(a) - exp(b), and 2*n + 1 in that of 3*3^(2*n) - 1.
    """
    if manageable(zero):
        above, below = sympy.fraction(together(zero))
        above /= Mul(*(f for f in Mul.make_args(below) if isinstance(f, gamma)))  # 0 at its poles
        zero = min(map(sympy.factor, (above, in_single_waves(above))), key=size)
    if zero.has(exp):
        zero = sympy.powsimp(zero, deep=True, combine="exp")  # exp(a) exp(-b)
    for factor in Mul.make_args(zero):
        terms = sympy.Add.make_args(factor.rewrite(exp) if isinstance(factor, sinh) else factor)
        exponent = sympy.expand_log(sympy.log(-terms[0] / terms[1])) if len(terms) == 2 else sympy.I
        if factor.is_Pow and not isinstance(factor, exp) and not factor.exp.is_nonpositive:
            yield from _factors_with_zeros(factor.base)
        elif exponent.is_real and all(f.is_number for f in exponent.atoms(sympy.log)):
            yield from _factors_with_zeros(exponent)
        else:
            yield factor


def _where_zero(e: Expr, base: Expr) -> Expr:
    """The value of e where the base is zero: at the zero of a letter in which the base is linear with a number before it."""
    for letter in base.free_symbols:
        slope = base.diff(letter)
        if slope.is_number:
            return e.subs(letter, sympy.expand(letter - base / slope))
    return e.subs(base, 0)


def _has_no_zero(factor: Expr) -> bool:
    """True if it is seen for even and for odd integers, or in hyperbolic functions; gamma functions have no zeros."""
    cases = Mul(*by_parity(factor))
    forms = (cases, in_hyperbolic_functions(factor)) if factor.has(exp) else (cases,)
    parts = (Mul.make_args(form) for form in forms)
    return any(all(isinstance(part, gamma) or is_nowhere_zero(part) for part in product) for product in parts)
