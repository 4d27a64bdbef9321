"""Equations with letters, as handbooks list them: what is printed is a real solution wherever it is said to be one.

The letters and x are drawn at random from small rational numbers; where the printed relations hold, the printed formula is real
and satisfies the equation, and its two solutions are independent; and there are such places.  The equations are of the kinds in
A. D. Polyanin and V. F. Zaitsev, Handbook of Exact Solutions for Ordinary Differential Equations, section 2.1.
"""

from __future__ import annotations

from random import Random
from typing import Any

import mpmath
import sympy
from build import parametrize

import kovacic

POLYNOMIALS = """
y''+a*y=0 | y''-(a*x+b)*y=0 | y''-(a^2*x^2+a)*y=0 | y''-(a*x^2+b)*y=0 | y''+a^3*x*(2-a*x)*y=0 | y''+a*y'+b*y=0
y''+a*y'+(b*x+c)*y=0 | y''+x*y'+(n+1)*y=0 | y''-2*x*y'+2*n*y=0 | y''+a*x*y'+b*y=0 | y''+a*x*y'+b*x*y=0
y''+2*a*x*y'+(b*x^4+a^2*x^2+c*x+a)*y=0 | y''+(a*x+b)*y'-a*y=0 | y''+(a*x+b)*y'+a*y=0 | y''+(a*x+b)*y'+c*((a-c)*x+b)*y=0
y''+(a*x+2*b)*y'+(a*b*x-a+b^2)*y=0 | y''+a*(x^2-b^2)*y'-a*(x+b)*y=0 | y''+(a*x^2+b)*y'+c*(a*x^2+b-c)*y=0
y''+(a*x^2+2*b)*y'+(a*b*x^2-a*x+b^2)*y=0 | y''+(a*b*x^2+b*x+2*a)*y'+a^2*(b*x^2+1)*y=0
x*y''+a*y'+b*y=0 | x*y''+a*y'+b*x*y=0 | x*y''+a*x*y'+a*y=0 | x*y''+(b-x)*y'-a*y=0 | x*y''+(2*a*x+b)*y'+a*(a*x+b)*y=0
x*y''+((a+b)*x+n+m)*y'+(a*b*x+a*n+b*m)*y=0 | x*y''-(2*a*x+1)*y'+(b*x^3+a^2*x+a)*y=0 | x*y''+(a*x^2+b*x+2)*y'+b*y=0
x*y''+(a*x^2+b)*y'+a*(b-1)*x*y=0 | x*y''-(a*x^2+1)*y'+b*x^3*y=0 | x^2*y''+a*y=0 | x^2*y''+(a*x^2+b)*y=0
x^2*y''-(a^2*x^2+n*(n+1))*y=0 | x^2*y''-(a*x^2+b*x+c)*y=0 | x^2*y''+a*x*y'+b*y=0 | x^2*y''+x*y'+(x^2-n^2)*y=0
(1-x^2)*y''-x*y'+n^2*y=0 | (1-x^2)*y''-2*x*y'+n*(n+1)*y=0 | (x^2-1)*y''+a*y=0 | (x^2+a^2)*y''+b^2*y'=0
(1-x^2)*y''+(b-a-(a+b+2)*x)*y'+n*(n+a+b+1)*y=0 | (a*x^2+b)*y''+a*x*y'+c*y=0 | (x^2+a)*y''+2*b*x*y'+2*(b-1)*y=0
x*(x-1)*y''+((a+b+1)*x-c)*y'+a*b*y=0 | x^4*y''+a*y=0 | x^4*y''-(a+b)*x^2*y'+((a+b)*x+a*b)*y=0 | x^6*y''-x^5*y'+a*y=0
x*y''-(x+n)*y'+n*y=0 | x*y''+(n+1-x)*y'=0 | x*y''-(x+n)*y'=0 | (x^2-a^2)*y''+2*b*x*y'+b*(b-1)*y=0
y''+2*a*y'-b^2*y=0 | y''+a*y'-(a^2+a+1)*y=1 | y''-a*y'+(a-b^2-2)*y=0
"""
POWERS = """
y''-a*x^n*y=0 | y''+a*x^n*y'=0 | y''-a*(a*x^(2*n)+n*x^(n-1))*y=0 | y''-a*x^(n-2)*(a*x^n+n+1)*y=0
y''+a*x^n*y'+b*x^(n-1)*y=0 | y''+2*a*x^n*y'+a*(a*x^(2*n)+n*x^(n-1))*y=0 | x*y''+n*y'+b*x^(1-2*n)*y=0
x*y''+(1-3*n)*y'-a^2*n^2*x^(2*n-1)*y=0 | x^2*y''+(a*x^n+b)*y=0 | x^2*y''+(a^2*x^(2*n)+b^2)*y=0
x^2*y''+a*x*y'+(b*x^n+c)*y=0 | y''=x^n*exp(x) | y''=x^n*exp(a*x) | y''=x^n*exp(x^2) | y''=x^n*cos(x) | y''=x^n*sin(a*x)
y''+y=x^n | y''+a*y=x^n | y''-a^2*y=x^n | y''+2*y'+y=x^n | y''-y=x^(1/3) | y''+a*x^2*y'=0 | y''=exp(-a*x^3) | y''=exp(-a*x^4)
y''=x*exp(a*x^4) | y''=x^n*sin(x^2+1)
"""
ROOTS = """
(x^2-a^2)*y''+x*y'-n^2*y=0 | (x^2-3)*y''+x*y'-n^2*y=0 | (1-a^2*x^2)*y''-a^2*x*y'+n^2*y=0 | (a^2-x^2)*y''-x*y'=0
(a^2+x^2)*y''+x*y'=0 | y''=1/sqrt(a^2-x^2) | y''=sqrt(a^2-x^2) | y''=1/sqrt(a^2+x^2) | y''=sqrt(x^2-a^2)
(1-x^2)*y''-3*x*y'+n*(n+2)*y=0 | (a^2-x^2)*y''-3*x*y'+n*(n+2)*y=0 | x*(1-x)*y''+(1/2-x)*y'+n^2*y=0 | (1-x^2)*y''-x*y'+5*y=0
x*(1-x)*y''+(3/2-3*x)*y'+n*(n+2)*y=0 | (2*x-3*x^2)*y''+(1-3*x)*y'+n^2*y=0
"""
LINES = """
y''+a/(a*x+1)*y'=0 | (a*x+b)*y''+c*y'=0 | (a*x+b)^2*y''+(a*x+b)*y'+k*y=0 | (a*x+b)*y''+2*y'=x | (1-k*x)*y''-k*y'=x
(a*x+b)^2*y''+a*(a*x+b)*y'-a^2*y=x | (1-k*x)^2*y''-2*y=0 | (a*x+b)*y''+a*y'/2=1 | (a*x+b)*y''+a*y'/2+k*y=0
(1+a*x^2)*y''+2*a*x*y'=0 | (b+a*x^2)*y''+2*a*x*y'=0 | (a^2-b^2*x^2)*y''-2*b^2*x*y'=0 | (1+a*x^2)*y''+a*x*y'=0
(1+a*x^2)*y''+a*x*y'+k*y=0 | (1-a*x^2)*y''-a*x*y'+k^2*a*y=0 | (1-a^2*x^2)*y''-a^2*x*y'+n^2*a^2*y=0 | (a^2-x^2)*y''-x*y'=1
(a*x^2+b)*y''+3*a*x*y'+a*y=0 | (1+a^2*x^2)*y''+a^2*x*y'=0 | y''=k*y/(a*x+b) | y''+(a*x+b)^2*y=0 | y''+k*(a*x+b)*y=0
"""
FUNCTIONS = """
y''+sin(x)*y'+cos(x)*y=0 | y''+a*cos(x)*y'-a*sin(x)*y=0 | y''-tan(x)*y'+2*y=sin(x)
y''+(a*exp(x)-b)*y=0 | y''-(exp(2*x)+a*exp(x)+b)*y=0 | y''+a*exp(x)*y'+b*exp(x)*y=0 | y''-a*y'+b*exp(2*a*x)*y=0
y''+2*k*exp(x)*y'+k*exp(x)*(k*exp(x)+1)*y=0 | y''+a*tan(x)*y'+b*y=0 | y''+tan(x)*y'-a*(a-1)*cot(x)^2*y=0
y''-n*(n-1)/cos(x)^2*y=0 | y''-(a^2+n*(n-1)/sin(x)^2)*y=0 | y''+a*tanh(x)*y'+b*y=0 | y''+a*coth(x)*y'+b*y=0
y''-2*tan(x)*y'=0 | y''-2*tan(x)*y'+3*y=0 | y''-(a^2-2/cosh(x)^2)*y=0 | y''+(a^2-2/cos(x)^2)*y=0 | y''+(a^2-2/cosh(x)^2)*y=0
y''+(b-a*(a+1)/cosh(x)^2)*y=0 | y''+(b+a*(a+1)/cosh(x)^2)*y=0 | y''+2*coth(x)*y'-a*y=0
y''+coth(x)*y'-n*(n+1)*y=0 | y''+cot(x)*y'+n*(n+1)*y=0 | y''-(a^2+2/sinh(x)^2)*y=0 | y''+2*n*cot(2*x)*y'+b*y=0
y''+2*coth(x)*y'-a*y=1 | y''+2*coth(x)*y'-a*y=cosh(x) | y''+cot(x)*y'+a*y=cos(x) | y''+tanh(x)*y'+a*y=sinh(x)
y''+a*exp(x)*y=exp(x) | y''-2*y/cos(x)^2=1/cos(x)^2 | y''+a*y/cosh(x)^2=1/cosh(x)^2
"""
LETTERS = [*map(sympy.Rational, ("1/3", "2", "-3/2", "5/7", "3", "-1/4", "7/2", "1", "-2", "9/5", "0", "-1"))]
POINTS = [*map(sympy.Rational, ("1/7", "3/5", "-2/5", "13/10", "-7/4", "12/5", "4", "-5"))]
#: What mpmath has as a derivative.
AIRY = {f"airy{k}prime": lambda z, k=k: getattr(mpmath, f"airy{k}")(z, derivative=1) for k in ("ai", "bi")}
#: Places that are drawn, and places at which the formula is evaluated.
DRAWN, ENOUGH = 400, 4


def _equations(*lists: str) -> list[str]:
    return [text.strip() for text in " | ".join(lists).replace("\n", " | ").split("|") if text.strip()]


def _holds(found: kovacic.Validity, place: dict[Any, Any]) -> bool:
    values = [e.subs(place) for e in found.exceptions]
    return all(v.is_finite and v != 0 for v in values) and all(r.subs(place) == sympy.true for r in found.real)


def _number(e: Any, place: dict[Any, Any]) -> Any:
    """At the place; an antiderivative may have any value at one point."""
    is_open = lambda part: isinstance(part, sympy.Integral) and len(part.limits[0]) == 1  # noqa: E731
    plain = sympy.sympify(e).replace(is_open, lambda _: sympy.Rational(3, 7)).xreplace(place)
    return mpmath.mpmathify(sympy.lambdify([], plain, [AIRY, "mpmath"])())


@parametrize(
    "text",
    _equations(POLYNOMIALS, POWERS, ROOTS, LINES, FUNCTIONS),
    ordinary=(60, 90, 120),
    long=(33, 34, 46, 53, 62, 66, 70, 78, 84, 117, 148),  # these cover every branch that the others do
)
def test_what_is_printed_is_real_and_a_solution_where_it_says_so(text: str) -> None:
    answer = kovacic.answer_to(text)
    y, x = answer.eq.rhs, answer.eq.lhs.args[0]
    constants = dict(zip(answer.names, (sympy.Integer(2), sympy.Rational(-3, 7)), strict=True))
    coefficients = [e.xreplace({answer.question.x: x}) for e in answer.question.coefficients]
    letters = sorted(sympy.Tuple(y, *coefficients).free_symbols - {x, *constants}, key=str)
    random = Random(text)
    drawn = ({x: random.choice(POINTS), **{s: random.choice(LETTERS) for s in letters}} for _ in range(DRAWN))
    places = [place for place in drawn if _holds(answer.validity, place)][:ENOUGH]
    assert places, answer.validity
    derivatives = [y.xreplace(constants).diff(x, k) for k in (0, 1, 2)]
    pair = [y.diff(constant).diff(x, k) for constant in constants for k in (0, 1)]
    with mpmath.workdps(90):
        for place in places:
            y0, y1, y2 = (_number(e, place) for e in derivatives)
            assert abs(mpmath.im(y0)) <= 1e-12 * abs(y0) + 1e-25, (place, y0, answer.validity)
            a, b, c, f = (_number(e, place) for e in coefficients)
            terms = [a * y2, b * y1, c * y0, -f]
            assert abs(sum(terms)) <= 1e-20 * sum(map(abs, terms)) + 1e-40, (place, answer.validity)
            u, du, v, dv = (_number(e, place) for e in pair)
            assert abs(u * dv - du * v) > 1e-70 * (abs(u * dv) + abs(du * v)), (place, answer.validity)


WITH_VALUES = """
y''-a*y=0, y(1)=1, y'(1)=b | y''+a*y'+b*y=c, y(0)=0, y'(0)=0 | y''+2*g*y'+w^2*y=cos(v*x), y(0)=0, y'(0)=0
y''+w^2*y=cos(w*x), y(0)=0, y'(0)=0 | y''-a*y'=b, y(0)=0, y'(0)=0 | x^2*y''+a*x*y'+b*y=0, y(1)=1, y'(1)=0
x^2*y''+x*y'-n^2*y=x^m, y(1)=0, y'(1)=0 | y''-(a*x^2+b)*y=0, y(0)=1, y'(0)=0 | y''-2*x*y'+2*n*y=0, y(1)=1, y'(1)=0
(1-x^2)*y''-2*x*y'+n*(n+1)*y=0, y(0)=0, y'(0)=1 | (1+x^2)^2*y''+a*y=0, y(0)=1, y'(0)=0 | x*y''+n*y'=x^m, y(1)=0, y'(1)=0
x*y''+(c-x)*y'-a*y=0, y(1)=1, y'(1)=0 | x*(1-x)*y''+(c-(a+b+1)*x)*y'-a*b*y=0, y(1/2)=1, y'(1/2)=0
y''+a*tan(x)*y'+b*y=0, y(0)=1, y'(0)=0 | y''+a*tanh(x)*y'=0, y(0)=1, y'(0)=1 | y''+a*tanh(x)*y'+b*y=0, y(0)=1, y'(0)=0
y''+a*coth(x)*y'+b*y=0, y(1)=1, y'(1)=0 | y''+cot(x)*y'+n*(n+1)*y=0, y(1)=1, y'(1)=0 | y''-a^2*y=0, y(0)=1, y(1)=0
y''+(b+a*(a+1)/cosh(x)^2)*y=0, y(0)=0, y'(0)=1 | y''-(a^2-2/cosh(x)^2)*y=0, y(0)=1, y'(0)=0 | y''=x^a, y(1)=0, y'(1)=0
y''-2/cos(x)^2*y=1, y(0)=0, y'(0)=0 | y''-2*tan(x)*y'=1, y(0)=0, y'(0)=0 | y''=1/(x^3+1), y(0)=0, y'(0)=0
x*y''-(2*x+1)*y'+(x+1)*y=x^2, y(-1)=0, y'(-1)=1 | x*y''+2*y'-x*y=exp(x), y(-1)=0, y'(-1)=0 | y''-2/x^2*y=log(x), y(1)=0, y'(1)=0
y''+y/(4*x^2)=1/x, y(-1)=0, y'(-1)=1 | x^4*y''-y=0, y(-1)=1, y'(-1)=0 | 4*x*y''+2*y'+y=0, y(-1)=1, y'(-1)=0
x*y''+a*y=0, y(-1)=1, y'(-1)=0 | x^3*y''+a*y=0, y(-1)=1, y'(-1)=0 | x^2*y''+(a*x+b)*y=0, y(-1)=1, y'(-1)=0
x*y''+(1-x)*y'+n*y=0, y(-1)=1, y'(-1)=0 | x*y''+(1+x)*y'+n*y=0, y(1)=1, y'(1)=0 | x^2*y''-(x^2+a*x)*y=0, y(-1)=1, y'(-1)=0
(1-x^2)*y''-2*x*y'+n*(n+1)*y=0, y(2)=1, y'(2)=0 | (1-x^2)*y''-2*x*y'+n*(n+1)*y=0, y(-2)=1, y'(-2)=0
(1-x^2)*y''-4*x*y'+n*(n+3)*y=0, y(2)=1, y'(2)=0 | x*(1-x)*y''+(c-(a+b+1)*x)*y'-a*b*y=0, y(2)=1, y'(2)=0
(x^2-a^2)*y''+x*y'-n^2*y=0, y(0)=1, y'(0)=0 | (a^2-x^2)*y''-x*y'=1, y(0)=0, y'(0)=0 | y''=1/sqrt(a^2-x^2), y(0)=0, y'(0)=0
y''+y'/(a*x+1)=0, y(0)=0, y'(0)=1 | (1-k*x)*y''-k*y'=x, y(0)=0, y'(0)=0 | (b^2+a^2*x^2)*y''+a^2*x*y'=1, y(0)=0, y'(0)=1
y''=exp(-a*x^4), y(0)=0, y'(0)=0 | y''+a*x^2*y'=0, y(0)=0, y'(0)=1
y''+a*x^n*y'=0, y(1)=0, y'(1)=1 | y''=x^n*exp(x), y(1)=0, y'(1)=0
"""


@parametrize("text", _equations(WITH_VALUES), ordinary=(17,), long=(5, 15, 25, 47))
def test_with_values_the_answer_is_real_a_solution_and_has_them(text: str) -> None:
    equation, _, values = text.partition(", ")
    answer = kovacic.answer_to(equation, ics=values)
    y, x = answer.eq.rhs, answer.eq.lhs.args[0]
    coefficients = [e.xreplace({answer.question.x: x}) for e in answer.question.coefficients]
    letters = sorted(sympy.Tuple(y, *coefficients).free_symbols - {x}, key=str)
    derivatives = [y.diff(x, k) for k in (0, 1, 2)]
    random = Random(text)
    drawn = ({x: random.choice(POINTS), **{s: random.choice(LETTERS) for s in letters}} for _ in range(DRAWN))
    places = [place for place in drawn if _holds(answer.validity, place)][:ENOUGH]
    assert places, answer.validity
    with mpmath.workdps(40):
        for place in places:
            y0, y1, y2 = (_number(e, place) for e in derivatives)
            assert abs(mpmath.im(y0)) <= 1e-12 * abs(y0) + 1e-25, (place, y0, answer.validity)
            a, b, c, f = (_number(e, place) for e in coefficients)
            terms = [a * y2, b * y1, c * y0, -f]
            assert abs(sum(terms)) <= 1e-18 * sum(map(abs, terms)) + 1e-25, (place, answer.validity)
            for condition in answer.question.conditions:
                (term,) = condition.terms
                there = {**place, x: term.point + sympy.Rational(1, 10**20)}  # where a form may be 0/0
                assert abs(_number(derivatives[term.order] - condition.value, there)) < 1e-15, (place, condition.text)


ONE_VALUE = """
y''-k^2*y=0, y(0)=1 | y''+a*y=0, y(0)=0 | y''+a*y'=exp(x), y(0)=1 | y''-(a+b)*y'+a*b*y=1, y(0)=1 | y''+k^2*y=0, y'(0)=0
x^2*y''+x*y'-n^2*y=0, y(1)=1 | x^2*y''+a*x*y'=0, y(1)=1 | x*y''+2*y'+a^2*x*y=0, y(1)=0
"""


@parametrize("text", _equations(ONE_VALUE), ordinary=(1, 3, 5))
def test_the_solution_that_one_value_leaves_is_nonzero_where_it_is_valid(text: str) -> None:
    """At k = 0 both exp(k x) - exp(-k x) and sin(k x) are 0, and C1 x is missing."""
    answer = kovacic.answer_to(text)
    y, x = answer.eq.rhs, answer.eq.lhs.args[0]
    (constant,) = set(answer.names) & y.free_symbols
    letters = sorted(y.free_symbols - {x, constant}, key=str)
    random = Random(text)
    drawn = ({x: random.choice(POINTS[:2]), **{s: random.choice(LETTERS) for s in letters}} for _ in range(80))
    places = [place for place in drawn if _holds(answer.validity, {**place, constant: 1})]
    assert places
    with mpmath.workdps(40):
        for place in places:
            assert abs(_number(y.diff(constant), place)) > 1e-20, (place, answer.validity)
