"""The energies for which the exponents give a polynomial of degree n: one equation among square roots.

The exponent differences, and sqrt(q) at an irregular point, are square roots of functions of E.  Those that depend on E are
unknowns with a sign, rho^2 = D(E), and E is eliminated: D is linear in E, and so is the equation in each rho.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

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
        if not square.has(sympy.I):
            symbol = sympy.Dummy("r", positive=True)
            return cls(square, symbol, radicals=((symbol, sympy.sqrt(sympy.factor(square))),))
        # sqrt(re + i im) = p + i q with p = sqrt((size + re)/2) and q = im/(2 p)
        re, im = (sympy.factor(part(sympy.expand(square))) for part in (sympy.re, sympy.im))
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
        constant, factors = _factored(part, is_complex=is_complex)
        if any(multiplicity % 2 for _, multiplicity in factors):
            return None
        root *= constant**sign
        for factor, multiplicity in factors:
            root *= factor ** (sign * multiplicity // 2)
    return sympy.expand(root) if root.has(sympy.I) else root


def _factored(polynomial: Any, *, is_complex: bool) -> tuple[Any, list[tuple[Any, int]]]:
    """The root of the constant factor, and the other factors with their multiplicities, over Q or Q(i)."""
    if is_complex:
        constant, factors = sympy.factor_list(polynomial, extension=sympy.I)
        return sympy.sqrtdenest(sympy.sqrt(sympy.expand(constant))), factors
    constant, factors = sympy.factor_list(polynomial)
    return sympy.sqrt(constant), factors


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
        energies = _zeros(equation, E) if equation.has(E) else []
        for energy in energies:
            yield Solved(shortest(energy), {})
        return
    if len(unknown) > 2:
        raise Uncovered("more than two exponents depend on the energy")
    rho = unknown[0].value
    E_of_rho = _only_zero(
        unknown[0].square - rho**2, E, "an exponent isn't the root of a linear function of the energy"
    )
    reduced = equation.subs(E, E_of_rho)
    others_of_rho: dict[Any, Any] = {}
    if len(unknown) == 2:
        other = unknown[1]
        other_of_rho = _only_zero(reduced, other.value, "the exponents satisfy no linear equation")
        others_of_rho[other.value] = other_of_rho
        reduced = other.square.subs(E, E_of_rho) - other_of_rho**2
    for value in _zeros(reduced, rho):
        at = shortest(value)
        others = {sigma: shortest(function.subs(rho, value)) for sigma, function in others_of_rho.items()}
        energy = shortest(E_of_rho.subs(rho, at), E_of_rho.subs(rho, value))
        yield Solved(energy, {rho: at, **others})


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
    forms = (*(form for form in real if form is not None), *forms)
    candidates = [*forms]
    for form in forms:
        candidates += _written(form)
    return min(candidates, key=lambda form: (form.has(sympy.I), sympy.count_ops(form), len(str(form)), str(form)))


def _written(form: Any) -> Iterator[Any]:
    """As a product, as a sum, with common factors before a sum, and as partial fractions in n where it is rational."""
    factored = sympy.factor(form)
    expanded = sympy.expand(form)
    yield from (factored, expanded, sympy.factor_terms(expanded))
    number = next((s for s in form.free_symbols if isinstance(s, sympy.Dummy) and s.is_integer), None)
    if number is not None and form.is_rational_function(number):
        fractions = sympy.Add.make_args(sympy.apart(factored, number))
        yield sympy.Add(*(_shifted(part, number) for part in fractions))


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


def _shifted(part: Any, number: Any) -> Any:
    """A partial fraction c/(b n - a)^k as +-c/(a - b n)^k where that has fewer signs, its numerator as a product."""
    return sympy.factor(part) if part.has(number) else part
