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
    options = {"extension": sympy.I} if square.has(sympy.I) else {}
    num, den = sympy.fraction(sympy.together(square))
    product = sympy.Integer(1)
    for part, sign in ((num, 1), (den, -1)):
        constant, factors = sympy.factor_list(part, **options)
        root = sympy.sqrt(constant)
        if options:
            root = sympy.sqrtdenest(sympy.sqrt(sympy.expand(constant)))
        product *= root**sign
        for factor, multiplicity in factors:
            if multiplicity % 2:
                return None
            product *= factor ** (sign * multiplicity // 2)
    return sympy.expand(product) if product.has(sympy.I) else product


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
    unknown = {root.value: root.square for root in roots if root.unknown and equation.has(root.value)}
    if not unknown:
        if equation.has(E):
            for energy in _zeros(equation, E):
                yield Solved(shortest(energy), {})
        return
    first, *others = unknown
    if len(others) > 1:
        raise Uncovered("more than two exponents depend on the energy")
    energy = _zeros(unknown[first] - first**2, E)
    if len(energy) != 1:
        raise Uncovered("an exponent isn't the root of a linear function of the energy")
    reduced = equation.subs(E, energy[0])
    values: dict[Any, Any] = {}
    if others:
        other = others[0]
        solutions = _zeros(reduced, other)
        if len(solutions) != 1:
            raise Uncovered("the exponents satisfy no linear equation")
        values[other] = solutions[0]
        reduced = unknown[other].subs(E, energy[0]) - values[other] ** 2
    for value in _zeros(reduced, first):
        found = {first: shortest(value), **{r: shortest(v.subs(first, value)) for r, v in values.items()}}
        yield Solved(shortest(energy[0].subs(first, found[first]), energy[0].subs(first, value)), found)


def _zeros(equation: Any, unknown: Any) -> list[Any]:
    """The zeros of a function whose numerator has at most degree 2."""
    numerator = sympy.Poly(sympy.numer(sympy.together(equation)), unknown)
    if numerator.degree() > 2:
        raise Uncovered(f"the energies are roots of an equation of degree {numerator.degree()}")
    return [] if numerator.degree() < 1 else list(sympy.roots(numerator))


def shortest(*forms: Any) -> Any:
    """The shortest of some ways to write what the forms are: as products, as sums, as partial fractions in n."""
    real = [_real_part(form) for form in forms if form.has(sympy.I)]
    forms = (*(form for form in real if form is not None), *forms)
    candidates = [*forms]
    for form in forms:
        expanded = sympy.expand(form)
        candidates += [sympy.factor(form), expanded, sympy.factor_terms(expanded)]
        number = next((s for s in form.free_symbols if isinstance(s, sympy.Dummy) and s.is_integer), None)
        if number is not None and form.is_rational_function(number):
            fractions = [
                _shifted(part, number) for part in sympy.Add.make_args(sympy.apart(sympy.factor(form), number))
            ]
            candidates.append(sympy.Add(*fractions))
    return min(candidates, key=lambda form: (form.has(sympy.I), sympy.count_ops(form), len(str(form)), str(form)))


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
