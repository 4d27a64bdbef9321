"""The constants of an equation as SymPy expressions, and the fields that they generate: for `families`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import prod
from typing import Any

import sympy
from sympy import I, Integer, Mul, Pow, Symbol, expand, sqrt
from sympy.core.numbers import ImaginaryUnit
from sympy.polys.constructor import construct_domain
from sympy.polys.domains import EX, QQ
from sympy.polys.rootoftools import ComplexRootOf

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.reading.given import parameters_of


def shown(expression: Any, field: Field) -> Any:
    """The expression with the name of the field's generator in place of a root of its polynomial."""
    if not isinstance(field, AlgebraicField) or not expression.has(ComplexRootOf):
        return expression
    return expression.xreplace({_generator(field): Symbol(field.name)})


def number(constant: Poly) -> Any:
    """A constant of K as a SymPy expression, in which a generator that is no radical is a root of its polynomial."""
    expression, field = constant.to_sympy(Symbol("x")), constant.field
    if isinstance(field, AlgebraicField) and field.approximation is not None and field.name.isidentifier():
        return expression.xreplace({Symbol(field.name): _generator(field)})
    return expression


@cache
def _generator(field: AlgebraicField) -> Any:
    near = complex(*map(float, field.approximation or ()))
    zeros = sympy.Poly(field.modulus.to_sympy(Symbol("x")), Symbol("x")).all_roots(radicals=False)
    return min(zeros, key=lambda zero: abs(complex(zero) - near))


def root(constant: Poly) -> Any:
    """A square root: within K, or that of a number, or a function of the parameters times the root of one without squares."""
    inside = constant.field.sqrt(constant)
    if inside is not None or not parameters_of(constant.field):
        return sqrt(number(constant)) if inside is None else number(inside)
    num, den = sympy.fraction(sympy.together(number(constant)))
    content, factors = sympy.factor_list(num * den)
    outer = Mul(*(f ** (k // 2) for f, k in factors)) / den
    return outer * sqrt(content) * sqrt(expand(Mul(*(f for f, k in factors if k % 2))))


def settled(d: Any) -> Any:
    """d, as an integer where its nested square roots cancel."""
    if not d.is_number or all(power.base.is_Rational for power in d.atoms(Pow)):
        return d
    near = Integer(round(complex(d).real))
    close = abs(complex(d) - near) < 1e-9
    return near if close and sympy.minimal_polynomial(d - near, polys=True).degree() == 1 else d


def domain(numbers: Sequence[Any]) -> Any:
    """The field that SymPy computes in; None where it would be too large, or zero couldn't be told for certain in it."""
    names = sorted({symbol for value in numbers for symbol in value.free_symbols}, key=str)
    atoms = {atom for value in numbers for atom in value.atoms(Pow, ImaginaryUnit, ComplexRootOf)}
    radicals = {atom for atom in atoms if not (atom.is_Pow and atom.exp.is_Integer)}
    if any(radical.free_symbols for radical in radicals):
        return EX if len(radicals) == 1 else None
    nested = any(not (radical.is_Pow and radical.base.is_Rational) for radical in radicals - {I})
    if nested and prod(radical.poly.degree() if isinstance(radical, ComplexRootOf) else 2 for radical in radicals) > 8:
        return None
    if not names:
        return construct_domain(numbers, extension=True, field=True)[0]
    return (QQ.algebraic_field(*sorted(radicals, key=str)) if radicals else QQ).frac_field(*names)
