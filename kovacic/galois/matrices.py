"""Generating matrices of the finite subgroups of SL2(C), and of the diagonal group, as SymPy matrices.

Reference: F. Klein, Vorlesungen ueber das Ikosaeder (1884), part I, chapter II.
"""

from __future__ import annotations

from typing import Any

from kovacic.galois.group import Group, Kind


def generators(group: Group) -> tuple[Any, ...] | None:
    """Matrices that generate the group, or None where it is neither finite nor diagonal."""
    import sympy

    I, half = sympy.I, sympy.Rational(1, 2)  # noqa: E741 - SymPy's name
    swap = sympy.Matrix([[0, 1], [-1, 0]])
    if group.kind is Kind.CYCLIC:
        return () if group.n == 1 else (_rotation(group.n),)
    if group.kind is Kind.MULTIPLICATIVE:
        t = sympy.Symbol("t", nonzero=True)
        return (sympy.diag(t, 1 / t),)
    if group.kind is Kind.DICYCLIC and group.n is not None:
        return (_rotation(2 * group.n), swap)
    third = half * sympy.Matrix([[-1 - I, -1 - I], [1 - I, -1 + I]])
    if group.kind is Kind.TETRAHEDRAL:
        return (sympy.diag(I, -I), swap, third)
    if group.kind is Kind.OCTAHEDRAL:
        return (_rotation(8), swap, third)
    if group.kind is Kind.ICOSAHEDRAL:
        z = sympy.exp(2 * sympy.pi * I / 5)
        T = sympy.Matrix([[z**4 - z, z**2 - z**3], [z**2 - z**3, z - z**4]]) / sympy.sqrt(5)
        return (-sympy.diag(z**3, z**2), T)
    return None


def _rotation(n: int | None) -> Any:
    import sympy

    z = {2: sympy.Integer(-1), 4: sympy.I}.get(n or 0, sympy.exp(2 * sympy.pi * sympy.I / n))
    return sympy.diag(z, 1 / z)
