"""Kovacic's own steps 1 to 3, to be read along with the paper: the sets of exponents, the families, theta, and P.

The engine doesn't search in this way, for there are up to (m+1)^(n+1) families for n poles; `explain` does, within limits,
so that every line of the paper can be compared.  With r = S, and m = 1, 2, 4, 6 or 12 for the degree of omega:

- step 1: at a pole c the singular part [sqrt r]_c and alpha_c^+-, or the set E_c; the same at infinity;
- step 2: the families for which d = alpha_inf - sum alpha_c, or m/12 (e_inf - sum e_c), m/4 (...) for m = 2, is a natural
  number; for m = 2 one of the e is odd;
- step 3: theta, and a polynomial P of degree d such that P exp(int theta) is a product of m solutions: L_(m+1) = 0 for

      L_0 = P,  L_1 = P' + theta P,  L_(k+1) = L_k' + theta L_k - k (m-k+1) r L_(k-1).

  That is the paper's equation of second order for P (m = 1), its equation of third order (m = 2), and the recursion of
  section 5.1 with P_(m-k) = (-1)^(k+1) D^k L_k, D the product of the x - c.

Numbers lie in the field K of the coefficients of r (algebraic numbers, parameters with generic values), or in one that square
roots are adjoined to.  Poles of degree 1 or 2 over K are taken one by one; where more are conjugate, only families in which
these have equal exponents are tried.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), sections 3.1, 4.1 and 5.1.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, product
from math import factorial, prod
from string import ascii_letters
from typing import Any

from sympy import Add, Integer, Symbol, expand, symbols, sympify

from kovacic.algebra.factors import combination
from kovacic.algebra.poly import Field, Poly
from kovacic.engine.families import (
    SCALE,
    Choice,
    ExactNumber,
    Roots,
    SingularPoint,
    families,
    first_case_choices,
    natural,
    points_of_place,
    theta_numerator,
    weight,
)
from kovacic.engine.places import Kind, Problem
from kovacic.engine.riccati import numerators
from kovacic.equation import parameters_of
from kovacic.limits import check_time

#: Families that are enumerated, or sums that are counted apart; of a few families all are shown and tried.
_MOST_FAMILIES = 4096
_FEW_FAMILIES = 8
#: The highest order of a pole: longer singular parts fill a screen each, and (1 + x + x^2)/x^200 takes more than a minute.
_HIGHEST_POLE_ORDER = 40
#: Multiplications of coefficients for all trials together: a few seconds.
_MOST_TRIAL_WORK = 1_000_000
#: Coefficients of P whose conditions are written out.
_MOST_UNKNOWNS = 3


@dataclass(frozen=True)
class Family:
    """One choice at every point, infinity first; if d is natural and the family was tried, theta and P, None without one.

    `theta` is a SymPy expression, and so are the `conditions` in the `unknowns` a_0, ..., a_(d-1) that would have to vanish
    for P = x^d + ... (d <= 3).
    """

    choices: tuple[Choice, ...]
    d: ExactNumber
    theta: Any = None
    P: Poly | None = None
    conditions: tuple[Any, ...] = ()
    unknowns: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Search:
    """The results of steps 1 to 3 for one degree m of omega.

    `total` is the number of families, `natural` that of those with a natural d (None for too many sums).
    `families` are the ones with a natural d, in the order of the paper, or all of them if they are few; None for too many.
    """

    m: int
    points: tuple[SingularPoint, ...]
    choices: tuple[tuple[Choice, ...], ...]
    total: int
    natural: int | None
    families: tuple[Family, ...] | None

    @property
    def complete(self) -> bool:
        """True if all families of the paper were enumerated, every pole on its own."""
        return self.families is not None and all(point.count == 1 for point in self.points)


def search(problem: Problem, variable: str, m: int) -> Search | None:
    """Steps 1 to 3 for omega of degree m; of many families they try those up to the first that succeeds.

    None outside the domain: exponents that are no square roots of constants, poles of a high order.
    """
    if max(place.order for place in problem.places) > _HIGHEST_POLE_ORDER:
        return None
    roots = Roots(problem.field)
    *poles, infinity = problem.places
    points = (SingularPoint(infinity), *chain.from_iterable(points_of_place(place, roots) for place in poles))
    chosen_at = []
    for point in points:
        check_time()
        chosen = _exponent_choices(point, m, roots)
        if chosen is None:
            return None
        chosen_at.append(chosen)
    choices = tuple(chosen_at)
    total = prod(len(chosen) ** point.count for chosen, point in zip(choices, points, strict=True))
    if prod(map(len, choices)) > _MOST_FAMILIES:
        return Search(m, points, choices, total, natural=_naturals(choices, points, m), families=None)

    every = [Family(*family) for family in families(choices, points, m, roots.field)]
    hopeful = [family for family in every if _may_succeed(family, m)]
    count = len(hopeful) if all(point.count == 1 for point in points) else _naturals(choices, points, m)
    shown = every if m == 1 and total <= _FEW_FAMILIES else hopeful
    tried = _tried(problem, points, m, roots.field, shown, Symbol(variable))
    return Search(m, points, choices, total, count, tried)


def _may_succeed(family: Family, m: int) -> bool:
    """True if d is natural and, for m = 2, one of the e is odd."""
    return natural(family.d) is not None and (m != 2 or any(choice.value % 2 for choice in family.choices))


def in_sympy(value: Any, x: Any) -> Any:
    """A number, or a polynomial in x, as a SymPy expression."""
    return value.to_sympy(x) if isinstance(value, Poly) else sympify(value, strict=True)


def _naturals(choices: Sequence[Sequence[Choice]], points: Sequence[SingularPoint], m: int) -> int | None:
    """The number of families with a natural d, conjugate poles counted one by one; None for too many sums."""
    # By d, and whether all e are even so far, which for m = 2 excludes the family.
    sums: Counter[tuple[ExactNumber, bool]] = Counter({(0, m == 2): 1})
    for point, chosen in zip(points, choices, strict=True):
        factor = weight(point, m)
        parts = [(factor * choice.value, m == 2 and choice.value % 2 == 0) for choice in chosen]
        for _ in range(point.count):
            check_time()
            longer: Counter[tuple[ExactNumber, bool]] = Counter()
            for ((d, all_even), count), (part, even) in product(sums.items(), parts):
                longer[d + part, all_even and even] += count
            sums = longer
            if len(sums) > _MOST_FAMILIES:
                return None
    return sum(count for (d, all_even), count in sums.items() if natural(d) is not None and not all_even)


def _exponent_choices(point: SingularPoint, m: int, roots: Roots) -> tuple[Choice, ...] | None:
    """The choices of step 1 at a point; None if the exponents aren't square roots of constants."""
    place = point.place
    if m == 1:
        return first_case_choices(place, roots)
    if place.kind is Kind.ORDINARY or (place.at_infinity and place.order == 1):
        return tuple(map(Choice, (0, 2, 4) if m == 2 else range(13)))
    if place.order > 2:  # E_c has one element for m = 2; higher degrees don't occur
        value = 4 - place.order if place.at_infinity else place.order
        return (Choice(value),) if m == 2 else None
    centre = 2 if m == 2 else 6  # the middle of the set E_c at a pole of order 2
    if place.order == 1:  # e_c = 12, or 4 for m = 2
        return (Choice(2 * centre),)
    # The integers among 2 + k Delta (m = 2) and 6 + 12 k Delta / m (m = 4, 6, 12), k = 0, +-1, ..., up to +-m/2 steps.
    step = Fraction(2 * centre, m) * (place.delta or 0)
    values = {centre + k * step for k in range(-m // 2, m // 2 + 1)}
    return tuple(Choice(int(value)) for value in sorted(values) if value.denominator == 1)


def _tried(
    problem: Problem, points: Sequence[SingularPoint], m: int, field: Field, families: Sequence[Family], x: Any
) -> tuple[Family, ...]:
    """Step 3: with what came out for those that were tried; of few families these are all that may succeed, of more those up
    to the first success."""
    D = problem.D.over(field)
    T = problem.T.over(field)
    n = D.degree
    found = list(families)
    work = 0
    for i, family in enumerate(families):
        d = natural(family.d)
        if d is None or not _may_succeed(family, m):
            continue
        work += (d + 1) * m * (m * n + d) * (n + 1) * field.absolute_degree**2
        if work > _MOST_TRIAL_WORK:
            break
        found[i] = _outcome(D, T, points, m, family, d, x)
        if found[i].P is not None and len(families) > _FEW_FAMILIES:
            break
    return tuple(found)


def _outcome(D: Poly, T: Poly, points: Sequence[SingularPoint], m: int, family: Family, d: int, x: Any) -> Family:
    """The family with theta, and with P or the conditions for its existence."""
    X = D.field.x
    R = theta_numerator(D, points, family.choices, SCALE[m])
    # D^(m+1) L_(m+1) for P = 1, x, x^2, ...
    images = [numerators(D, T, R, X**k, m, m + 1)[-1] * factorial(m + 1) for k in range(d + 1)]
    at_infinity, *at_poles = family.choices
    terms = [in_sympy(c, x) * x**power for power, c in at_infinity.singular]
    for choice, point in zip(at_poles, points[1:], strict=True):  # theta as a sum over the poles, as in the paper
        f = point.factor(D.field)
        base = in_sympy(f, x)
        terms.append(in_sympy(SCALE[m] * choice.value, x) * (in_sympy(f.derivative(), x) / base))
        terms += [in_sympy(c, x) * base**power for power, c in choice.singular]
    theta = Add(*terms)
    # P of the highest degree: x^k - c_(k-1) x^(k-1) - ... - c_0, if the image of x^k is the sum of c_j times that of x^j.
    for k in reversed(range(d + 1)):
        found = combination(images[k], images[:k])
        if found is not None:
            return replace(family, theta=theta, P=D.field.poly([*(-c for c in found), 1]))
    if d > _MOST_UNKNOWNS:
        return replace(family, theta=theta)
    unknowns, conditions = _vanishing_conditions(images, parameters_of(D.field))
    return replace(family, theta=theta, conditions=conditions, unknowns=unknowns)


def _vanishing_conditions(images: Sequence[Poly], parameters: Sequence[str]) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """The lower coefficients of P, of a low degree, and what would have to vanish."""
    letter = next(c for c in ascii_letters if not any(name[0] == c for name in parameters))
    unknowns = symbols(f"{letter}:{len(images) - 1}")
    x = Symbol("x")
    coefficients = (*unknowns, Integer(1))
    found = []
    for i in range(1 + max(image.degree for image in images)):
        terms = [in_sympy(image[i], x) * a for image, a in zip(images, coefficients, strict=True)]
        total = expand(Add(*terms))
        found.append(total.primitive()[1] if total.is_Add else total)
    return unknowns, tuple(dict.fromkeys(e for e in found if e))
