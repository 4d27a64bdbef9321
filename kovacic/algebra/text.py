"""Sums and quotients in Python's syntax, from the texts of their parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence


def joined_terms(coefficients: Sequence[str], variable: str) -> str:
    """The polynomial with these coefficients, low to high."""
    powers = ["", variable, *(f"{variable}**{k}" for k in range(2, len(coefficients)))]
    return _sum(_term(c, power) for c, power in reversed(list(zip(coefficients, powers, strict=False))) if c != "0")


def joined_monomials(terms: Mapping[tuple[int, ...], int], names: Sequence[str]) -> str:
    """The polynomial in several variables with these integer coefficients, by exponents, in their order."""
    return _sum(
        _term(
            str(c), "*".join(name if e == 1 else f"{name}**{e}" for name, e in zip(names, exponents, strict=True) if e)
        )
        for exponents, c in terms.items()
    )


def _term(coefficient: str, monomial: str) -> str:
    if not monomial:
        return coefficient
    if coefficient in ("1", "-1"):
        return coefficient[:-1] + monomial
    return f"({coefficient})*{monomial}" if " " in coefficient else f"{coefficient}*{monomial}"


def _sum(terms: Iterable[str]) -> str:
    return " + ".join(terms).replace("+ -", "- ") or "0"


def quotient_text(above: str, below: str) -> str:
    """above/below, in parentheses where they are needed."""
    return above if below == "1" else f"{_parenthesised(above, ' ')}/{_parenthesised(below, ' *')}"


def _parenthesised(text: str, separators: str) -> str:
    return f"({text})" if any(separator in text.lstrip("-").replace("**", "^") for separator in separators) else text
