"""The energies for which the exponents give a polynomial of degree n: one equation among square roots.

The exponent differences, and sqrt(q) at an irregular point, are square roots of functions of E.  Those that depend on E are
unknowns with a sign, rho^2 = D(E), and E is eliminated: D is linear in E, and so is the equation in each rho.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import sympy

from kovacic.bound_states.frame import Uncovered


@dataclass(frozen=True)
class Root:
    """sqrt(square), up to its sign: an unknown where it depends on E, else a `value`.

    What is no function without radicals is a symbol there, or p + i q with two of them, and `radicals` says what they are.
    """

    square: Any
    value: Any
    unknown: bool = False
    radicals: tuple[tuple[Any, Any], ...] = ()

    @classmethod
    def of(cls, square: Any, E: Any) -> Root:
        if square.has(E):
            return cls(square, sympy.Dummy("rho", real=True), unknown=True)
        root = exact_root(square)
        if root is not None:
            return cls(square, root)
        if square.has(sympy.I):
            return cls._complex(square)
        symbol = sympy.Dummy("r", positive=True)
        return cls(square, symbol, radicals=((symbol, sympy.sqrt(sympy.factor(square))),))

    @classmethod
    def _complex(cls, square: Any) -> Root:
        """sqrt(re + i im) = p + i q with p = sqrt((size + re)/2) and q = im/(2 p)."""
        expanded = sympy.expand(square)
        re = sympy.factor(sympy.re(expanded))
        im = sympy.factor(sympy.im(expanded))
        size = sympy.sqrt(sympy.factor(re**2 + im**2))
        real = sympy.sqrt(2) * sympy.sqrt(size + re) / 2
        p = sympy.Dummy("p", positive=True)
        q = sympy.Dummy("q", real=True)
        return cls(square, p + sympy.I * q, radicals=((p, real), (q, im / (2 * real))))


def exact_root(square: Any) -> Any:
    """A root without radicals of what isn't a number, over Q(i) where i occurs; None where there is none."""
    if square.is_number:
        return _root_of_number(sympy.expand(square))
    is_complex = square.has(sympy.I)
    num, den = sympy.fraction(sympy.together(square))
    root = sympy.Integer(1)
    for part, sign in ((num, 1), (den, -1)):
        factored = _factored(part, is_complex=is_complex)
        if any(multiplicity % 2 for _, multiplicity in factored.factors):
            return None
        root *= factored.root_of_constant**sign
        for factor, multiplicity in factored.factors:
            root *= factor ** (sign * multiplicity // 2)
    return sympy.expand(root) if root.has(sympy.I) else root


class _Factored(NamedTuple):
    """The root of the constant factor of a polynomial, and its other factors with their multiplicities."""

    root_of_constant: Any
    factors: list[tuple[Any, int]]


def _factored(polynomial: Any, *, is_complex: bool) -> _Factored:
    """Over Q or Q(i)."""
    if is_complex:
        constant, factors = sympy.factor_list(polynomial, extension=sympy.I)
        return _Factored(sympy.sqrtdenest(sympy.sqrt(sympy.expand(constant))), factors)
    constant, factors = sympy.factor_list(polynomial)
    return _Factored(sympy.sqrt(constant), factors)


def _root_of_number(square: Any) -> Any:
    """p + i q with p > 0, for what isn't real: its conjugate is p - i q, and SymPy sees that p is real."""
    re, im = square.as_real_imag()
    if im == 0:
        return sympy.sqrt(square)
    p = sympy.sqrtdenest(sympy.sqrt((sympy.sqrt(re**2 + im**2) + re) / 2))
    return p + sympy.I * sympy.radsimp(im / (2 * p))


def conjugate(value: Any) -> Any:
    """That of an expression in real symbols: what stands under the roots is real."""
    return value.xreplace({sympy.I: -sympy.I})


@dataclass(frozen=True)
class Solved:
    """The energy, and the roots that depend on it, as functions of n."""

    energy: Any
    values: dict[Any, Any]


def solved(equation: Any, roots: list[Root], E: Any) -> Iterator[Solved]:
    """All E with equation = 0 for some values of the unknown roots.

    Raises `Uncovered` where that needs a polynomial equation of a degree above 2.
    """
    unknown = [root for root in roots if root.unknown and equation.has(root.value)]
    if not unknown:
        if equation.has(E):
            yield from (Solved(shortest(energy), {}) for energy in _zeros(equation, E))
    elif len(unknown) == 1:
        yield from _solved_with_root(equation, unknown[0], E)
    elif len(unknown) == 2:
        yield from _solved_with_two_roots(equation, unknown[0], unknown[1], E)
    else:
        raise Uncovered("more than two exponents depend on the energy")


def _solved_with_root(equation: Any, root: Root, E: Any) -> Iterator[Solved]:
    """By E = E(rho)."""
    rho = root.value
    E_of_rho = _energy_of(root, E)
    for value in _zeros(equation.subs(E, E_of_rho), rho):
        yield _at(value, rho, E_of_rho)


def _solved_with_two_roots(equation: Any, root: Root, other: Root, E: Any) -> Iterator[Solved]:
    """By E = E(rho), and sigma = sigma(rho) for the other root, whose square is D(E(rho))."""
    rho = root.value
    sigma = other.value
    E_of_rho = _energy_of(root, E)
    sigma_of_rho = _only_zero(equation.subs(E, E_of_rho), sigma, "the exponents satisfy no linear equation")
    for value in _zeros(other.square.subs(E, E_of_rho) - sigma_of_rho**2, rho):
        found = _at(value, rho, E_of_rho)
        yield replace(found, values={**found.values, sigma: shortest(sigma_of_rho.subs(rho, value))})


def _energy_of(root: Root, E: Any) -> Any:
    """E as a function of the root."""
    equation = root.square - root.value**2
    return _only_zero(equation, E, "an exponent isn't the root of a linear function of the energy")


def _at(value: Any, rho: Any, E_of_rho: Any) -> Solved:
    """The energy where the root rho has a value."""
    short = shortest(value)
    energy = shortest(E_of_rho.subs(rho, short), E_of_rho.subs(rho, value))
    return Solved(energy, {rho: short})


def _only_zero(equation: Any, unknown: Any, otherwise: str) -> Any:
    """The zero of a function with one.  Raises `Uncovered`, as `otherwise` says, for others."""
    zeros = _zeros(equation, unknown)
    if len(zeros) != 1:
        raise Uncovered(otherwise)
    return zeros[0]


def _zeros(equation: Any, unknown: Any) -> list[Any]:
    """The zeros of a function whose numerator has at most degree 2."""
    numerator = sympy.Poly(sympy.numer(sympy.together(equation)), unknown)
    degree = numerator.degree()
    if degree > 2:
        raise Uncovered(f"the energies are roots of an equation of degree {degree}")
    return [] if degree < 1 else list(sympy.roots(numerator))


def shortest(*forms: Any) -> Any:
    """The shortest of some ways to write what the forms are: as products, as sums, as partial fractions in n."""
    real = [_real_part(form) for form in forms if form.has(sympy.I)]
    known = [*(form for form in real if form is not None), *forms]
    candidates = [*known]
    for form in known:
        candidates += _written(form)
    return min(candidates, key=_length)


def _length(form: Any) -> tuple[bool, int, int, str]:
    """What is longer is larger; what has I in it, larger than all without."""
    text = str(form)
    return form.has(sympy.I), sympy.count_ops(form), len(text), text


def _written(form: Any) -> Iterator[Any]:
    """As a product, as a sum, with common factors before a sum, and as partial fractions in n where it is rational."""
    factored = sympy.factor(form)
    expanded = sympy.expand(form)
    yield from (factored, expanded, sympy.factor_terms(expanded))
    n = _number_in(form)
    if n is not None and form.is_rational_function(n):
        fractions = sympy.Add.make_args(sympy.apart(factored, n))
        yield sympy.Add(*(_factored_in(n, part) for part in fractions))


def _number_in(form: Any) -> Any:
    """The number n of a level; None where the form doesn't depend on it."""
    for symbol in form.free_symbols:
        if isinstance(symbol, sympy.Dummy) and symbol.is_integer:
            return symbol
    return None


def _real_part(form: Any) -> Any:
    """The same without I where the imaginary part vanishes: that of an energy whose two roots are conjugate; else None."""
    if not all(symbol.is_real for symbol in form.free_symbols):
        return None
    real, imaginary = form.as_real_imag()
    if real.has(sympy.re, sympy.im) or sympy.cancel(sympy.together(imaginary)) != 0:
        return None
    return real.replace(
        lambda e: e.is_Pow and e.exp == 2 and e.base.could_extract_minus_sign(), lambda e: (-e.base) ** 2
    )


def _factored_in(n: Any, part: Any) -> Any:
    """A partial fraction c/(b n - a)^k as +-c/(a - b n)^k where that has fewer signs, its numerator as a product."""
    return sympy.factor(part) if part.has(n) else part
