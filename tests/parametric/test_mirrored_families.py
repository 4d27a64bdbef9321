"""Families n = f(d) that a symmetry n -> c - n permutes are written once, and the text says the same as the equations."""

from __future__ import annotations

from fractions import Fraction

import pytest
from build import parametrize

import kovacic


@pytest.mark.long
def test_lame_in_n_and_its_accessory_parameter() -> None:
    r"""n (n + 1) p(x) + B is the same for n and -n - 1, and so is what is said of them."""
    numerator = "(4*n*(n+1)*x + 4*B)*(x-2)*(x-1)*(x+3) - 3*(x^4 + 14*x^2 - 48*x + 49)"
    answer = kovacic.conditions(f"({numerator})/(16*(x-2)^2*(x-1)^2*(x+3)^2)", max_degree=1, var="x")
    lines = [str(r.statement) for r in answer.regions if "Delta_d" in str(r.statement)]
    assert lines
    assert all(line.startswith("n or -n - 1 = ") for line in lines)
    for number, B in ((1, -3), (1, 1), (1, 2), (1, 5), (2, -6), (2, 9), (2, 10)):
        assert answer.case_at({"n": number, "B": B}) == answer.case_at({"n": -number - 1, "B": B})


@parametrize(
    ("S", "line"),
    [
        ("a*x^2 + c + l*(l+1)/x^2 + x^6", "l = 0 or -1, and a = +-(2*d + 3), d in N, and Delta_d = 0: case 1"),
        ("l*(l+1)/x^2 + E/x - 1/4 + m/(x-1)", "l = 0 or -1, and m = 0, and 2*E*I is an even integer: case 1"),
    ],
    ordinary=1,
)
def test_regions_that_a_symmetry_exchanges_are_one_line(S: str, line: str) -> None:
    """l (l + 1) is the same for l = 0 and l = -1, and so is what is said of both; nothing else is merged."""
    answer = kovacic.conditions(S, var="x")
    lines = [text.strip() for text in str(answer).splitlines()]
    assert line in lines
    separate = [str(region.statement) for region in answer.regions]
    assert "l = 0" in separate or any(text.startswith("l = 0, and") for text in separate)
    assert not any(text.startswith(("l = -1", "(l")) for text in lines)


@pytest.mark.long
def test_blocks_that_differ_stay_apart() -> None:
    """n (n - 2) is the same for n = 0 and n = 2, but not n b."""
    text = str(kovacic.conditions("n*(n-2)/x^2 + n*b/(x-1)^2 + x^2", var="x"))
    assert "  n = 2, and b = " in text
    assert "n = 0 or 2, and" not in text
    assert "n = 2 or 0, and" not in text


@pytest.mark.slow
def test_a_region_within_an_earlier_one_is_left_out() -> None:
    """Lame's equation with g2, g3: what holds on the cuspidal curve is said once, not again for n = 1/2."""
    S = "(n*(n+1)*x+B)/(4*x^3-g2*x-g3) - 3*(16*x^4+8*g2*x^2+32*g3*x+g2^2)/(16*(4*x^3-g2*x-g3)^2)"
    answer = kovacic.conditions(S, var="x", max_degree=0)
    statements = [{*str(region.statement).split(", and ")} for region in answer.regions]
    assert not any(one <= other for k, other in enumerate(statements) for one in statements[:k])
    assert answer.case_at({"n": Fraction(1, 2), "B": 0, "g2": 0, "g3": 0}) == 1
    assert answer.case_at({"n": Fraction(1, 2), "B": 0, "g2": 4, "g3": 0}) == 2
