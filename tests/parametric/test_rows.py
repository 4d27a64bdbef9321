"""Solutions in the integer of a condition: each row solves the equation, and each integer has a row."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

import mpmath
import sympy
from build import parametrize
from parametric_formulas import residual

import kovacic
from kovacic.parametric.solutions import families_of, rows_of

x = sympy.Symbol("x")
#: a, b, c of the equations, and values of the parameters beside the one that is solved for.
EQUATIONS: dict[str, tuple[str, dict[str, Any]]] = {
    "-(1-1/25)/(4*x^2) - 3/(16*(x-1)^2) - (1/25+1/4-(9 + 40*L)/100-1)/(4*x*(x-1))": ("L", {}),
    "x*(1-x)*y''+(4/5-13/10*x)*y'+L/10*y=0": ("L", {}),
    "-(1-1/k^2)/(4*x^2) - 3/(16*(x-1)^2) - (1/k^2+1/4-((k-2)^2+8*k*L)/(4*k^2)-1)/(4*x*(x-1))": (
        "L",
        {"k": Fraction(7, 3)},
    ),
    "l*(l+1)/x^2 - Z/x - E": ("E", {"l": Fraction(1, 3), "Z": Fraction(2)}),
    "x^2 - E + l*(l+1)/x^2": ("E", {"l": Fraction(1, 3)}),
    "A^2/x^4 - 2*A*b/x^3 - (E + 1/4)/x^2": ("E", {"A": Fraction(3, 2), "b": Fraction(2, 7)}),
}


def coefficients(text: str, values: dict[str, Any]) -> tuple[Any, Any, Any]:
    """a, b, c of a y'' + b y' + c y = 0."""
    python = text.partition("=")[0].replace("^", "**").replace("y''", "Y2").replace("y'", "Y1")
    read = sympy.sympify(python, locals={"E": sympy.Symbol("E")})
    there = read.subs({sympy.Symbol(name): value for name, value in values.items()})
    if "y" not in text:
        return sympy.Integer(1), sympy.Integer(0), -there
    there = sympy.expand(there)
    a, b, c = (there.coeff(sympy.Symbol(name)) for name in ("Y2", "Y1", "y"))
    return a, b, c


@parametrize("text", EQUATIONS, ordinary=(0,), long=1)
def test_each_integer_has_a_row_and_each_row_is_a_solution(text: str) -> None:
    solved, values = EQUATIONS[text]
    answer = kovacic.conditions(text, var="x", max_degree=0)
    tried = 0
    for region in answer.regions:
        for family in families_of(region.statement.claim):
            rows = rows_of(region.solution(), family)
            if region.case != 1 or not region.solution():
                assert not rows
                continue
            assert family.parameter == solved
            for number in range(-9, 10):
                at = [row for row in rows if row.numbers.contains(number)]
                assert bool(at) is family.numbers.contains(Fraction(number))
                n = {sympy.Symbol(family.letter): sympy.Integer(number)}
                value = (family.value.num.to_sympy(x) / family.value.den.to_sympy(x)).subs(x, number)
                value = value.subs({sympy.Symbol(name): known for name, known in values.items()})
                if not at:
                    continue
                point = {**values, solved: value}
                assert answer.region_at(point) is region
                for row in at:
                    y = row.solution.y.subs(n).subs({sympy.Symbol(name): known for name, known in point.items()})
                    assert y != 0
                    assert residual(y, coefficients(text, point), x, mpmath.mpf(13) / 37)[0] < 1e-15
                    tried += 1
    assert tried >= 10


@parametrize("k", [3, 4, 5, -3], ordinary=(2,))
def test_the_theorem_has_the_four_rows_of_homogeneous_potentials(k: int) -> None:
    """Morales-Ruiz & Ramis 2001, lambda = n + k n (n - 1)/2: even and odd n on both sides."""
    S = f"-(1-1/({k})^2)/(4*x^2) - 3/(16*(x-1)^2) - (1/({k})^2+1/4-(({k}-2)^2+8*({k})*L)/(4*({k})^2)-1)/(4*x*(x-1))"
    theorem = kovacic.conditions(S, var="x").theorem()
    first = theorem.partition("(2)")[0]
    assert len(re.findall(r"For (?:even|odd) n [<>]= -?\d:", first)) == 4
    assert "epsilon" not in first
