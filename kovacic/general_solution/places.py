"""Where the conditions are given, and solutions that are real there.

Singular points are the poles of b/a and c/a, and those of f/a: a solution isn't determined on one side by its values on
the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy

from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.errors import InputError
from kovacic.general_solution.particular import place_of
from kovacic.general_solution.question import Question
from kovacic.general_solution.real_basis import negative_arguments, real_basis, real_particular
from kovacic.general_solution.variation import Basis, starting_at
from kovacic.general_solution.zero import is_zero
from kovacic.reading.exponential import in_terms_of
from kovacic.solution import Solution

Expr = Any  # SymPy publishes no types


def given_points(question: Question) -> list[Expr]:
    """The points of the conditions, each once, in the order in which they are given."""
    return [*dict.fromkeys(point for condition in question.conditions for point in condition.points)]


def jump_points(question: Question) -> list[Expr]:
    """The places of steps and impulses on the right-hand side."""
    h = question.equation.h
    if h is None or question.equation.change is not None:
        return []
    places = [place_of(jump, question.x) for jump in sorted(h.atoms(sympy.Heaviside, sympy.DiracDelta), key=str)]
    return [*dict.fromkeys(place[0] for place in places if place is not None)]


def check_ordinary(question: Question) -> None:
    """Raises `InputError` where a condition is given at a singular point."""
    equation = question.equation
    atoms = Atoms(sympy.Symbol(equation.variable))
    dens = [den for part in (equation.b, equation.c) if (den := (part / equation.a).den).degree > 0]
    for point in given_points(question) if dens else ():
        at = point
        if equation.change is not None:
            at = in_terms_of(equation.change, atoms.x, equation.variable).subs(equation.change.variable, point)
        for den in dens:
            value = question.own(atoms.poly(den)).subs(atoms.x, at)
            if value.is_finite is not False and is_zero(value):
                raise InputError(f"{point} is a singular point of the equation")


def real_basis_at(question: Question, basis: Basis, solution: Solution, start: Expr) -> Basis:
    """Solutions that are real at `start`, with integrals that begin there.

    Raises `InputError` where the points of the conditions lie on two sides of a singular point.
    """
    if question.equation.change is not None:
        return basis
    x = question.x
    _check_one_side((basis.y1, basis.y2), x, [*given_points(question), *jump_points(question)])
    y1, y2 = real_basis(solution, basis.y1, basis.y2, x, start)
    return replace(basis, y1=starting_at(y1, x, start), y2=starting_at(y2, x, start))


def real_particular_at(question: Question, basis: Basis, particular: Expr, start: Expr) -> Expr:
    """The particular solution, real at `start`.  Raises `InputError` as `real_basis_at` does."""
    if question.equation.change is not None:
        return particular
    points = given_points(question)
    _check_one_side((particular,), question.x, points)
    _check_integrals((basis.y1, basis.y2, particular), question, [*points, *jump_points(question)])
    return real_particular(particular, question.equation, question.x, start)


def _check_one_side(solutions: Sequence[Expr], x: Expr, points: Sequence[Expr]) -> None:
    """Raises `InputError` where a singular point lies between two of the points, so that no real solution joins them."""
    sides = {frozenset(e for y in solutions for e in negative_arguments(y, x, p)) for p in points if p.is_real}
    if len(sides) > 1:
        said = ", ".join(map(str, points))
        raise InputError(f"a singular point of the equation lies between {said}: on each side the solutions are others")


def _check_integrals(solutions: Sequence[Expr], question: Question, points: Sequence[Expr]) -> None:
    """Raises `InputError` where an integral that is left would lead over a real singular point of an equation over Q."""
    if len(points) < 2 or not any(y.has(sympy.Integral) for y in solutions) or not all(p.is_real for p in points):
        return
    equation = question.equation
    first, last = sympy.Min(*points), sympy.Max(*points)
    quotients = (part / equation.a for part in (equation.f, equation.b, equation.c))
    for den in (q.den for q in quotients if q.den.degree > 0 and q.field == QQ):
        for pole in sympy.real_roots(Atoms(question.x).poly(den)):
            if first < pole < last:
                said = f"a singular point, {pole}, lies between {', '.join(map(str, points))}"
                raise InputError(f"{said}: on each side the solutions are others")
