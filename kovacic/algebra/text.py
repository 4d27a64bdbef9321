"""Polynomials and quotients in Python's syntax."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def joined_terms(coefficients: Sequence[str], variable: str) -> str:
    """The polynomial with these coefficients, low to high."""
    powers = ["", variable, *(f"{variable}**{k}" for k in range(2, len(coefficients)))]
    terms = [_monomial_text(c, power) for c, power in zip(coefficients, powers, strict=False) if c != "0"]
    return " + ".join(reversed(terms)).replace("+ -", "- ") or "0"


def _monomial_text(coefficient: str, monomial: str) -> str:
    if not monomial:
        return coefficient
    if coefficient in ("1", "-1"):
        return coefficient[:-1] + monomial
    return f"({coefficient})*{monomial}" if " " in coefficient else f"{coefficient}*{monomial}"


def quotient_str(num: Any, den: Any, variable: str) -> str:
    """`num/den`, two polynomials, in lowest terms, with integer coefficients."""
    num, den = num.field.ground.cleared(num, den)
    above: str = num.integer_str(variable)
    below: str = den.integer_str(variable)
    if below == "1":
        return above
    is_product = "*" in below.replace("**", "^")
    return f"{_parenthesised(above, _is_sum(above))}/{_parenthesised(below, _is_sum(below) or is_product)}"


def _parenthesised(text: str, is_needed: bool) -> str:
    return f"({text})" if is_needed else text


def _is_sum(text: str) -> bool:
    return " " in text
