"""The energies for which the exponents give a polynomial of degree n: one equation among square roots.

The exponent differences, and sqrt(q) at an irregular point, are square roots of functions of E.  Those that depend on E are
unknowns with a sign, rho^2 = D(E), and E is eliminated: D is linear in E, and so is the equation in each rho.

`tidied` writes conditions as they are read: n < A/a, l >= 1/2, in the place of -(2 n a - 2 A)/a > 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, combinations
from types import MappingProxyType
from typing import Any

import sympy

from kovacic.bound_states.signs import Signs, exceeds

#: For the sign of a slope, and a strict relation.
_RELATION_SIGNS = {(1, True): ">", (1, False): ">=", (-1, True): "<", (-1, False): "<="}


@dataclass(frozen=True)
class Root:
    """sqrt(square), up to its sign: an unknown where it depends on E, else a `value`.

    What is no function without radicals is a symbol there, or p + i q with two of them; `radicals` says what they are, and
    `reality` where that is real.
    """

    square: Any
    value: Any
    unknown: bool = False
    radicals: tuple[tuple[Any, Any], ...] = ()
    reality: Any = sympy.true

    @property
    def signed(self) -> list[Any]:
        """The root with both of its signs; an unknown has its own one."""
        return [self.value] if self.unknown or self.value == 0 else [self.value, -self.value]

    @classmethod
    def of(cls, square: Any, E: Any, *, positive: bool = False) -> Root:
        """With the sign of the square in `reality`, and not 0 if it has to be `positive`."""
        if square.has(E):
            return cls(square, sympy.Dummy("rho", real=True), unknown=True)
        root = exact_root(square)
        if root is not None:
            return cls(square, root)
        if not square.has(sympy.I):
            symbol = sympy.Dummy("r", positive=True)
            radical = symbol, sympy.sqrt(sympy.factor(square))
            return cls(square, symbol, radicals=(radical,), reality=exceeds(square, 0, strict=positive))
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

    A root of a number that isn't real is p + i q with p > 0: its conjugate is p - i q, and SymPy sees that p is real.
    """
    if square.is_number:
        value = sympy.expand(square)
        re, im = value.as_real_imag()
        if im == 0:
            return sympy.sqrt(value)
        p = sympy.sqrtdenest(sympy.sqrt((sympy.sqrt(re**2 + im**2) + re) / 2))
        return p + sympy.I * sympy.radsimp(im / (2 * p))
    root = sympy.Integer(1)
    for part, sign in zip(sympy.fraction(sympy.together(square)), (1, -1), strict=True):
        constant, factors = sympy.factor_list(part, gaussian=square.has(sympy.I))
        if any(multiplicity % 2 for _, multiplicity in factors):
            return None
        root *= sympy.sqrtdenest(sympy.sqrt(sympy.expand(constant))) ** sign
        for factor, multiplicity in factors:
            root *= factor ** (sign * multiplicity // 2)
    return sympy.expand(root) if root.has(sympy.I) else root


def conjugate(value: Any) -> Any:
    """The complex conjugate of an expression in real symbols with real radicands."""
    return value.xreplace({sympy.I: -sympy.I})


def energies_with(equation: Any, roots: list[Root], E: Any) -> Iterator[tuple[Any, dict[Any, Any]]]:
    """All E with equation = 0 for some values of the unknown roots, and these values, as functions of n.

    An exponent depends on E where mu >= 2.  The sum of all mu is 4, so that there are two unknown roots at most.
    """
    unknown = [root for root in roots if root.unknown and equation.has(root.value)]
    if not unknown:
        yield from ((shortest_form(energy), {}) for energy in _zeros_in(equation, E))
        return
    root, *others = unknown
    rho = root.value
    (E_of_rho,) = _zeros_in(root.square - rho**2, E)
    equation = equation.subs(E, E_of_rho)
    sigma_of_rho: Any = None
    for other in others:  # sigma = sigma(rho) for the other root, whose square is D(E(rho))
        (sigma_of_rho,) = _zeros_in(equation, other.value)
        equation = other.square.subs(E, E_of_rho) - sigma_of_rho**2
    for value in _zeros_in(equation, rho):
        short = shortest_form(value)
        values = {rho: short, **{other.value: shortest_form(sigma_of_rho.subs(rho, value)) for other in others}}
        yield shortest_form(E_of_rho.subs(rho, short), E_of_rho.subs(rho, value)), values


def _zeros_in(equation: Any, unknown: Any) -> list[Any]:
    """The zeros of a function whose numerator has at most degree 2, none for a constant."""
    numerator = sympy.Poly(sympy.numer(sympy.together(equation)), unknown)
    return [] if numerator.is_ground else [*sympy.roots(numerator)]


def shortest_form(*forms: Any) -> Any:
    """The shortest of some ways to write what the forms are: as products, as sums, as partial fractions in n."""
    known = [*forms]
    for form in forms:  # an energy with two conjugate roots is real
        real, imaginary = form.as_real_imag() if form.has(sympy.I) else (form, sympy.S.One)
        if sympy.cancel(sympy.together(imaginary)) == 0 and not real.has(sympy.re, sympy.im):
            known.append(real)
    candidates = [*known, *chain.from_iterable(map(_written, known))]
    texts = {form: str(form) for form in candidates}
    best = min(candidates, key=lambda form: (form.has(sympy.I), sympy.count_ops(form), len(texts[form]), texts[form]))
    # (-a - b)^2 is (a + b)^2
    return best.replace(
        lambda e: e.is_Pow and e.exp == 2 and all(t.could_extract_minus_sign() for t in sympy.Add.make_args(e.base)),
        lambda e: (-e.base) ** 2,
    )


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


def tidied(
    conditions: Iterable[Any], signs: Signs, radicals: Mapping[Any, Any] = MappingProxyType({})
) -> tuple[Any, ...]:
    """The conditions that don't hold anyway, each solved for n, or for a parameter, where it is linear in it.

    (False,) where one of them, or the sum of two of them, is false for all values.  `radicals` are the square roots for which
    symbols stand: sqrt(a) >= 2 is written a >= 4, and then a >= 0 isn't.
    """
    different = [*dict.fromkeys(conditions)]
    if _are_contradictory(different, signs):
        return (sympy.false,)
    # Not those with a root of what depends on parameters.
    rational = [symbol for symbol, root in radicals.items() if (root**2).is_rational_function(*root.free_symbols)]
    squares = {symbol: sympy.expand(radicals[symbol] ** 2) for symbol in rational}
    open_ones = _paired([c for c in different if signs.holds(c) is not True], signs)
    found = [_solved_for_one(condition, signs, squares) for condition in open_ones]
    # There is the level with n = 0, if there is one with n < c.
    least = [_solved_for_one(sympy.Gt(c.rhs, 0), signs, squares) for c in found if getattr(c, "lts", None) == signs.n]
    if _are_contradictory([*found, *least], signs):
        return (sympy.false,)
    found = [c.xreplace(radicals) for c in dict.fromkeys(found) if signs.holds(c) is not True]
    return tuple(c for c in found if not any(signs.is_positive(_gap(c) - _gap(other)) for other in found))


def _gap(condition: Any) -> Any:
    """The expression that a condition demands to be positive, or not negative."""
    return condition.gts - condition.lts


def _are_contradictory(conditions: Sequence[Any], signs: Signs) -> bool:
    """True if one of the conditions, or the sum of two of them, is false for all values."""
    gaps = [_gap(c) for c in conditions if c not in (sympy.true, sympy.false)]
    sums = (sympy.Ge(sympy.expand(first + second), 0) for first, second in combinations(gaps, 2))
    return any(signs.holds(condition) is False for condition in chain(conditions, sums))


def _paired(conditions: list[Any], signs: Signs) -> list[Any]:
    """The conditions, with each two that `_pair` says in one."""
    for first, second in combinations(conditions, 2):
        together = _pair(first, second, signs)
        if together is not None:
            others = [c for c in conditions if c not in (first, second)]
            return _paired([together, *others], signs)
    return conditions


def _pair(first: Any, second: Any, signs: Signs) -> Any:
    """s + t > 0 and s - t > 0 as s > sqrt(|s t|), where s t doesn't depend on n: s > 0, and s^2 > |s t| means s > |t|.

    None for other conditions.
    """
    n = signs.n
    total, difference = _gap(first), _gap(second)
    if not (isinstance(first, sympy.StrictGreaterThan) and total.has(n) and difference.has(n)):
        return None
    s = sympy.simplify((total + difference) / 2)
    st = sympy.simplify(s * (total - difference) / 2)
    if st.has(n) or sympy.degree(sympy.numer(sympy.together(s)), n) != 1:
        return None
    return sympy.StrictGreaterThan(s, sympy.sqrt(sympy.factor(signs.size(st))))


def _solved_for_one(condition: Any, signs: Signs, squares: Mapping[Any, Any] = MappingProxyType({})) -> Any:
    """The condition for n, or else for a parameter, where it is linear in it; for (n + h)^2 where it is quadratic in n.

    r > c for a number c >= 0 as r^2 > c^2, where r stands for a root of one of the `squares`.
    """
    n = signs.n
    if condition in (sympy.true, sympy.false) or (condition.has(sympy.Abs) and not condition.has(n)):
        return condition
    is_strict = isinstance(condition, sympy.StrictGreaterThan | sympy.StrictLessThan)
    factors = sympy.Mul.make_args(sympy.factor(sympy.together(_gap(condition))))
    # With the signs in the place of factors whose signs are known.
    rest = sympy.expand(sympy.Mul(*(signs.sign(factor) or factor for factor in factors)))
    number, factor = rest.as_coeff_Mul()
    base, exponent = factor.as_base_exp()
    if is_strict and exponent == -1:  # c p in the place of c/p, which is positive where that is
        rest = sympy.expand(number * base)
    for unknown, slope, constant in _linear_forms(rest, n):
        sign = signs.sign(slope)
        if sign is not None:
            bound = shortest_form(sympy.factor(-constant / slope))
            if sign == 1 and unknown in squares and bound.is_number and not bound.is_negative:
                return _solved_for_one(exceeds(squares[unknown], bound**2, strict=is_strict), signs)
            return sympy.Rel(unknown, bound, _RELATION_SIGNS[sign, is_strict])
    return exceeds(shortest_form(rest), 0, strict=is_strict)


def _linear_forms(rest: Any, n: Any) -> Iterator[tuple[Any, Any, Any]]:
    """The quantity in which it is linear (n, a parameter or a square (n + h)^2), with the slope and the constant."""
    unknowns = [n, *sorted(rest.free_symbols - {n}, key=str)]
    forms = {one: sympy.Poly(rest, one).all_coeffs() for one in unknowns if rest.is_polynomial(one)}
    for unknown, coefficients in forms.items():
        if len(coefficients) == 2:
            yield unknown, *coefficients
    if len(forms.get(n, ())) == 3:
        c, b, k = forms[n]
        yield (n + shortest_form(sympy.factor(b / (2 * c)))) ** 2, c, k - b**2 / (4 * c)
