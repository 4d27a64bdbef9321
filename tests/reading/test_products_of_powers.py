"""Products of powers have one normal form: each factor once, up to a constant."""

from __future__ import annotations

from random import Random

import sympy
from build import parametrize, size

import kovacic
from kovacic.parametric.formulas import with_gathered_powers

x, a, b, L = sympy.symbols("x a b L")
BASES = [
    x,
    x - 1,
    1 - x,
    x + 1,
    x**2 - 1,
    x * (x - 2) * (x - 1),
    L * x + 1,
    x + 1 / L,
    1 / (x - 1),
    (x - 2) ** 2,
    a * x,
]
EXPONENTS = [
    a,
    -a / 2,
    sympy.Rational(1, 4),
    -sympy.Rational(1, 2),
    a / (a - b) - b / (a - b),
    b,
    sympy.Integer(-1),
    1 - b / L,
]


@parametrize("seed", range(12), ordinary=4, long=3)
def test_a_product_is_the_same_up_to_a_constant(seed: int) -> None:
    random = Random(seed)
    factors = [random.choice(BASES) ** random.choice(EXPONENTS) for _ in range(5)]
    y = sympy.Mul(*factors, sympy.exp(a * x), sympy.exp(-a * x + 1 / x))
    found = with_gathered_powers(y, x)
    values = {a: sympy.Rational(1, 3), b: sympy.Rational(5, 2), L: 7}
    slopes = [(f.diff(x) / f).subs(values).subs(x, sympy.Rational(13, 7)) for f in (y, found)]
    assert size(slopes[0] - slopes[1], 30) < 1e-20
    bases = [factor.as_base_exp()[0] for factor in sympy.Mul.make_args(found)]
    monic = [sympy.Poly(base, x).monic() for base in bases if base.is_polynomial(x) and base.has(x)]
    assert len({*monic}) == len(monic)
    assert all(len(sympy.factor_list(base)[1]) == 1 for base in bases if base.is_polynomial(x))


def test_the_factors_of_gauge_and_solution_come_together() -> None:
    region = kovacic.conditions("(1+L*x)*y''+b*y'+c*y=0", var="x").regions[1]
    assert [str(solution.y) for solution in region.solution()] == ["(L*x + 1)**(1 - b/L)", "1"]


def test_a_solution_that_vanishes_identically_is_excluded() -> None:
    (first, *_) = kovacic.conditions("x*(1-x)*y''+(c-(a+b+1)*x)*y'-a*b*y=0", var="x").regions[0].solution()
    assert ", unless " in str(first)
    assert ", unless " not in str(kovacic.conditions("(1-x^2)*y''-2*x*y'+n*(n+1)*y=0").regions[0].solution()[0])
