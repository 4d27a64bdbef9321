"""Functions on flint's sparse polynomials in x and the parameters, x being variable number 0."""

from __future__ import annotations

from math import inf, lcm
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly_ctx, fmpz_mpoly_ctx
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.rationals import LARGE_DEGREE
from kovacic.limits import check_time, watched_seconds

_SparseTerms = tuple[tuple[tuple[int, ...], int], ...]


def laurent_constant(num: Any, den: Any, variable: int) -> Any:
    """The constant term of num/den as a Laurent series in the variables from number `variable` on."""
    if num.is_zero():
        return fmpq(0)
    if den.is_constant():
        return fmpq(constant_term(num), constant_term(den))
    size = len(num.degrees())
    below = by_power(den, variable)
    start = min(below)
    above = by_power(num, variable)
    first = below[start]
    zero = first * 0
    # series of num / (den / t^start): q_n = (num_n - sum_(i>0) den_(start+i) q_(n-i)) / first, as numerators over first^(n+1)
    numerators: list[Any] = []
    for n in range(start + 1):
        total = above.get(n, zero) * first**n
        for i in range(1, n + 1):
            total = total - below.get(start + i, zero) * numerators[n - i] * first ** (i - 1)
        numerators.append(total)
    return laurent_constant(numerators[start], first ** (start + 1), variable + 1) if variable < size else fmpq(0)


def by_power(polynomial: Any, variable: int) -> dict[int, Any]:
    """The coefficients of the powers of a variable that occur."""
    columns: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        rest = (*exponents[:variable], 0, *exponents[variable + 1 :])
        columns.setdefault(int(exponents[variable]), {})[rest] = coefficient
    context = polynomial.context()
    return {power: context.from_dict(terms) for power, terms in columns.items()}


def constant_term(polynomial: Any) -> int:
    """The coefficient of the term without variables."""
    return next((int(c) for e, c in polynomial.to_dict().items() if not any(e)), 0)


def terms_of(polynomial: Any) -> _SparseTerms:
    """Exponents and coefficients as Python's integers."""
    return tuple((tuple(int(i) for i in e), int(c)) for e, c in polynomial.to_dict().items())


def factorisation(polynomial: Any) -> tuple[int, list[tuple[Any, int]]]:
    """The content with its sign, and the primitive irreducible factors with their multiplicities."""
    check_time()
    if polynomial.is_constant() or max(polynomial.degrees()) <= LARGE_DEGREE or watched_seconds(inf) == inf:
        return _factored_at_once(polynomial)
    from kovacic.process import computed_apart

    context = polynomial.context()
    what = "factors of a polynomial in the variable and the parameters"
    content, factors = computed_apart(what, _sparse_factors, tuple(context.names()), terms_of(polynomial))
    return content, [(context.from_dict(dict(terms)), k) for terms, k in factors]


def _sparse_factors(names: tuple[str, ...], terms: _SparseTerms) -> tuple[int, list[tuple[_SparseTerms, int]]]:
    """`factorisation` with arguments and result that pickle."""
    context = fmpz_mpoly_ctx.get(names, Ordering.lex)
    content, factors = _factored_at_once(context.from_dict(dict(terms)))
    return content, [(terms_of(factor), k) for factor, k in factors]


def _factored_at_once(polynomial: Any) -> tuple[int, list[tuple[Any, int]]]:
    # Over Q: python-flint 0.9.0 sorts integer factors of one shape by coefficients that must be machine integers.
    context = polynomial.context()
    rational = fmpq_mpoly_ctx.get(context.names(), Ordering.lex)
    _, parts = rational.from_dict({e: fmpq(c) for e, c in polynomial.to_dict().items()}).factor()
    factors: list[tuple[Any, int]] = []
    rest = polynomial
    for part, k in parts:
        terms = part.to_dict()
        denominator = lcm(*(int(c.q) for c in terms.values()))
        _, factor = context.from_dict({e: int(c * denominator) for e, c in terms.items()}).primitive()
        factor = -factor if int(factor.leading_coefficient()) < 0 else factor
        factors.append((factor, int(k)))
        rest = rest / factor ** int(k)
    return constant_term(rest), factors


def sparse_square_root(polynomial: Any) -> Any | None:
    """The square root with a positive leading coefficient, or None."""
    try:
        root = polynomial.sqrt()
    except DomainError:
        return None
    return -root if int(root.leading_coefficient()) < 0 else root
