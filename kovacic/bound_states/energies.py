"""The energies for which the exponents give a polynomial of degree n: one equation among square roots.

The exponent differences, and sqrt(q) at an irregular point, are square roots of functions of E.  Those that depend on E are
unknowns with a sign, rho^2 = D(E), and E is eliminated: D is linear in E, and so is the equation in each rho.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.bound_states.question import Uncovered


@dataclass(frozen=True)
class Root:
    """sqrt(square), up to its sign: an unknown where it depends on E, else a `value`.

    What is no function without radicals is a symbol there, or p + i q with two of them, and `radicals` says what they are.
    """

    square: Any
    value: Any
    unknown: bool = False
    radicals: tuple[tuple[Any, Any], ...] = ()

    @property
    def signed(self) -> list[Any]:
        """The root with both of its signs; an unknown has its own one."""
        return [self.value] if self.unknown or self.value == 0 else [self.value, -self.value]

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
        expanded = sympy.expand(square)
        re, im = sympy.factor(sympy.re(expanded)), sympy.factor(sympy.im(expanded))
        size = sympy.sqrt(sympy.factor(re**2 + im**2))
        real = sympy.sqrt(2) * sympy.sqrt(size + re) / 2
        p = sympy.Dummy("p", positive=True)
        q = sympy.Dummy("q", real=True)
        return cls(square, p + sympy.I * q, radicals=((p, real), (q, im / (2 * real))))


def exact_root(square: Any) -> Any:
    """A root without radicals of what isn't a number, over Q(i) where I occurs, or None.

    That of a number is p + i q with p > 0, for what isn't real: its conjugate is p - i q, and SymPy sees that p is real.
    """
    if square.is_number:
        value = sympy.expand(square)
        re, im = value.as_real_imag()
        if im == 0:
            return sympy.sqrt(value)
        p = sympy.sqrtdenest(sympy.sqrt((sympy.sqrt(re**2 + im**2) + re) / 2))
        return p + sympy.I * sympy.radsimp(im / (2 * p))
    is_complex = square.has(sympy.I)
    root = sympy.Integer(1)
    for part, sign in zip(sympy.fraction(sympy.together(square)), (1, -1), strict=True):
        constant, factors = sympy.factor_list(part, extension=sympy.I) if is_complex else sympy.factor_list(part)
        if any(multiplicity % 2 for _, multiplicity in factors):
            return None
        root *= (sympy.sqrtdenest(sympy.sqrt(sympy.expand(constant))) if is_complex else sympy.sqrt(constant)) ** sign
        for factor, multiplicity in factors:
            root *= factor ** (sign * multiplicity // 2)
    return sympy.expand(root) if root.has(sympy.I) else root


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
    if len(unknown) > 2:
        raise Uncovered("more than two exponents depend on the energy")
    if not unknown:
        if equation.has(E):
            yield from (Solved(shortest(energy), {}) for energy in _zeros(equation, E))
        return
    root, *others = unknown
    rho = root.value
    E_of_rho = _only_zero(root.square - rho**2, E, "an exponent isn't the root of a linear function of the energy")
    equation = equation.subs(E, E_of_rho)
    sigma_of_rho: Any = None
    for other in others:  # sigma = sigma(rho) for the other root, whose square is D(E(rho))
        sigma_of_rho = _only_zero(equation, other.value, "the exponents satisfy no linear equation")
        equation = other.square.subs(E, E_of_rho) - sigma_of_rho**2
    for value in _zeros(equation, rho):
        short = shortest(value)
        values = {rho: short, **{other.value: shortest(sigma_of_rho.subs(rho, value)) for other in others}}
        yield Solved(shortest(E_of_rho.subs(rho, short), E_of_rho.subs(rho, value)), values)


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
    texts = {form: str(form) for form in candidates}
    return min(candidates, key=lambda form: (form.has(sympy.I), sympy.count_ops(form), len(texts[form]), texts[form]))


def _written(form: Any) -> Iterator[Any]:
    """As a product, as a sum, with common factors before a sum, and as partial fractions in n where it is rational."""
    factored = sympy.factor(form)
    expanded = sympy.expand(form)
    yield from (factored, expanded, sympy.factor_terms(expanded))
    numbers = [symbol for symbol in form.free_symbols if isinstance(symbol, sympy.Dummy) and symbol.is_integer]
    if numbers and form.is_rational_function(numbers[0]):
        n = numbers[0]
        fractions = sympy.Add.make_args(sympy.apart(factored, n))
        # A fraction c/(b n - a)^k as +-c/(a - b n)^k where that has fewer signs, its numerator as a product.
        yield sympy.Add(*(sympy.factor(part) if part.has(n) else part for part in fractions))


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
