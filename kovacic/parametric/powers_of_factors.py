"""One normal form for products of powers: each irreducible factor once, up to constant factors.

    x^(1/2)*(x^2 - 1)^(1/4)*(1 - x)^(3/4)  ->  sqrt(x)*(1 - x)*(x + 1)^(1/4)

A solution is one up to a constant, so that (1 - x)^e and (x - 1)^e count as the same: the sign that comes first stays.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import sympy


class _ShownPower(NamedTuple):
    """A base as it is shown, and its exponent."""

    base: Any
    exponent: Any


def gathered(y: Any, x: Any) -> Any:
    """A product with each irreducible factor of the bases of its powers once, and one exponential; else y itself.

    Factors without x are constants, and left out.
    """
    if not isinstance(y, sympy.Mul | sympy.Pow):
        return y
    powers: dict[Any, _ShownPower] = {}
    others: list[Any] = []
    exponent = sympy.Integer(0)
    for factor in sympy.Mul.make_args(y):
        base, e = factor.as_base_exp()
        if base == sympy.E:
            exponent += e
        elif isinstance(factor, sympy.Add) or not base.has(x) or not base.is_rational_function(x):
            others.append(factor)
        else:
            _add_factors(powers, base, e, x)
    for k, other in enumerate(others):
        key = _key(other, x) if isinstance(other, sympy.Add) and other.is_polynomial(x) else None
        if key in powers:  # a polynomial P with a factor of the weight
            powers[key] = _ShownPower(powers[key].base, powers[key].exponent + 1)
            others[k] = sympy.Integer(1)
    shown = [power.base ** shorter_sum(power.exponent) for power in powers.values()]
    others = [other for other in others if other.has(x)]
    return sympy.Mul(*shown, sympy.exp(shorter_sum(exponent)), *others)


def _add_factors(powers: dict[Any, _ShownPower], base: Any, e: Any, x: Any) -> None:
    """The irreducible factors of a rational function, raised to a power."""
    for part, sign in zip(sympy.fraction(sympy.together(base)), (1, -1), strict=True):
        if not part.has(x):
            continue
        number, factors = sympy.factor_list(part)
        factors = [(factor, k) for factor, k in factors if factor.has(x)]
        for factor, k in factors:
            key = _key(factor, x)
            is_turned = len(factors) == 1 and number.is_negative and k % 2 == 1
            known = powers.get(key, _ShownPower(-factor if is_turned else factor, sympy.Integer(0)))
            powers[key] = _ShownPower(known.base, known.exponent + sign * k * e)


def _key(factor: Any, x: Any) -> Any:
    """The monic multiple."""
    return sympy.Poly(factor, x, domain="EX").monic().as_expr()


def shorter_sum(exponent: Any) -> Any:
    """A sum without terms that cancel; its rational part is one fraction where that is shorter."""
    terms = sympy.expand(exponent)
    roots, rational = sympy.sift(
        sympy.Add.make_args(terms), lambda term: any(not e.exp.is_Integer for e in term.atoms(sympy.Pow)), binary=True
    )
    if all(sympy.denom(term).is_number for term in rational):  # a polynomial already
        return terms
    fraction = sympy.cancel(sympy.Add(*rational))
    if sympy.count_ops(fraction) >= sympy.count_ops(sympy.Add(*rational)):
        return terms
    return sympy.Add(fraction, *roots)
