"""`ZeroSet`: the values of letters for which an expression is zero, where an answer has an exception or a condition."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy
from sympy import cosh, exp, gamma, sinh

from kovacic.general_solution.substitution import in_single_waves, size
from kovacic.general_solution.textbook import in_hyperbolic_functions
from kovacic.general_solution.zero import by_parity, is_nowhere_zero

Expr = Any  # SymPy publishes no types
#: The longest expression that is factored, in subexpressions, and the most symbols, functions and roots in it.
_LONGEST = 300
_MOST_ATOMS = 10


@dataclass(frozen=True)
class ZeroSet:
    """The values of letters for which `expression` vanishes: it is empty, and false, without `factors`.

    >>> k, n = sympy.symbols("k n")
    >>> print(ZeroSet(k**2 * sympy.exp(k)), "|", ZeroSet(1 / sympy.gamma(-n)), "|", ZeroSet(sympy.sin(k) / k))
    k = 0 | n is one of 0, 1, 2, ... | sin(k) = 0 and k != 0
    """

    expression: Expr

    @cached_property
    def factors(self) -> tuple[Expr, ...]:
        """The factors with letters that may be zero, each once, without powers and signs."""
        found = []
        for factor in _bases(self.expression):
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
        """`equation` with what keeps the expression defined: sin(k)/k is 1 at k = 0, where its factor sin(k) vanishes."""
        below = sympy.Mul.make_args(sympy.fraction(sympy.together(self.expression))[1])
        product = sympy.Mul(*self.factors)
        bases = (factor.as_base_exp()[0] for factor in below)
        guarding = (ZeroSet(b).factors for b in bases if b.free_symbols and _where_zero(product, b) == 0)
        return " and ".join([self.equation(answer), *(f"{sympy.Mul(*zeros)} != 0" for zeros in guarding if zeros)])

    def equation(self, answer: Expr = sympy.S.Zero) -> str:
        """`k = 0`, with hyperbolic functions beside an answer in these."""
        left = sympy.Mul(*self.factors)
        poles = poles_of(left)
        if poles is not None:
            return f"{poles[0]} is one of {poles[1]}"
        if answer.has(sinh, cosh):
            factors = sympy.Mul.make_args(in_hyperbolic_functions(left))
            left = sympy.Mul(*(factor for factor in factors if not is_nowhere_zero(factor)))
        return f"{-left if left.could_extract_minus_sign() else left} = 0"


def poles_of(e: Expr) -> tuple[Expr, str] | None:
    """n and "0, 1, 2, ...", n and "0, -1, -2, ...", where 1/gamma(-n), 1/gamma(n) is zero; None for other expressions."""
    if not isinstance(1 / e, gamma):
        return None
    u = min((1 / e).args[0], sympy.together((1 / e).args[0]), key=size)
    return (-u, "0, 1, 2, ...") if u.could_extract_minus_sign() else (u, "0, -1, -2, ...")


def inequality(e: Expr) -> str:
    """`k != 0`, or which integers a number is none of."""
    poles = poles_of(e)
    return f"{e} != 0" if poles is None else f"{poles[0]} is none of {poles[1]}"


def without_implied(exceptions: Iterable[Expr]) -> tuple[Expr, ...]:
    """Without c + m != 0, and 1/gamma(c + m) != 0, for integers m beside sin(pi c) != 0; 1/gamma(c) for c/gamma(c + 1)."""
    exceptions = tuple(dict.fromkeys(exceptions))
    for inverse in [e for e in exceptions if isinstance(1 / e, gamma)]:
        c = sympy.expand((1 / inverse).args[0] - 1)
        single = next((e for e in exceptions if sympy.cancel(e / c).is_number), None)
        if single is not None:
            exceptions = tuple(1 / gamma(c) if e == inverse else e for e in exceptions if e != single)
    periodic = [e.args[0] / sympy.pi for e in exceptions if isinstance(e, sympy.sin)]

    def is_implied(e: Expr) -> bool:
        number = (poles_of(e) or (e,))[0]
        return any(sympy.cancel(number - sign * c).is_Integer for c in periodic for sign in (1, -1))

    return tuple(dict.fromkeys(e for e in exceptions if not is_implied(e)))


def _bases(zero: Expr) -> Iterator[Expr]:
    """The factors, without powers that are positive or may be: b^c is zero for b = 0 alone.

    With real a and b, a - b in the place of exp(a) - exp(b), and 2*n + 1 in that of 3*3^(2*n) - 1.
    """
    for factor in sympy.Mul.make_args(_factored(zero)):
        terms = sympy.Add.make_args(factor.rewrite(exp) if isinstance(factor, sinh) else factor)
        exponent = sympy.expand_log(sympy.log(-terms[0] / terms[1])) if len(terms) == 2 else sympy.I
        if factor.is_Pow and not isinstance(factor, exp) and not factor.exp.is_nonpositive:
            yield from _bases(factor.base)
        elif exponent.is_real and all(f.is_number for f in exponent.atoms(sympy.log)):
            yield from _bases(exponent)
        else:
            yield factor


def _factored(zero: Expr) -> Expr:
    """The shorter of two products, one with waves of sums for products of waves; a long expression as it is."""
    powers = {power for power in zero.atoms(sympy.Pow) if not power.exp.is_Integer}
    atoms = {*zero.free_symbols, *zero.atoms(sympy.Function), *powers}  # what SymPy takes for variables
    if size(zero) > _LONGEST or len(atoms) > _MOST_ATOMS:
        return zero
    above, below = sympy.fraction(sympy.together(zero))
    above /= sympy.Mul(*(f for f in sympy.Mul.make_args(below) if isinstance(f, gamma)))  # 0 at its poles
    factored = min(map(sympy.factor, (above, in_single_waves(above))), key=size)
    return sympy.powsimp(factored, deep=True, combine="exp") if factored.has(exp) else factored  # exp(a) exp(-b)


def _where_zero(e: Expr, base: Expr) -> Expr:
    """e where the base is zero: there a letter in which it is linear has another value."""
    for letter in base.free_symbols:
        slope = base.diff(letter)
        if slope.is_number:
            return e.subs(letter, sympy.expand(letter - base / slope))
    return e.subs(base, 0)


def _has_no_zero(factor: Expr) -> bool:
    """True if that is seen of it: for even and for odd integers, without gamma functions, or in hyperbolic functions."""
    cases = sympy.Mul(*by_parity(factor))
    forms = (cases, in_hyperbolic_functions(factor)) if factor.has(exp) else (cases,)
    return any(
        all(isinstance(part, gamma) or is_nowhere_zero(part) for part in sympy.Mul.make_args(form)) for form in forms
    )
