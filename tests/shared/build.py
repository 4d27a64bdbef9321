"""What tests build with, from one place: fields, polynomials, rational functions, equations, and texts that are read.

The parts of the inside that many tests ask are named here, too, so that a part that moves is renamed in one place; a test that
needs more of the inside says so by its imports.

>>> str(function("(x^2 + 3)/x"))
'(x**2 + 3)/x'
>>> str(equation("x^2*y'' + x*y' + (x^2 - 1)*y = 0"))
"x^2*y'' + x*y' + (x^2 - 1)*y = 0"
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import Any

import pytest
import sympy
from flint import acb
from hypothesis import settings

from kovacic import Equation
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.cli.main import COMMANDS, run
from kovacic.cli.main import main as run_and_exit
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import is_exact_solution, residual
from kovacic.closed_form.jets import jet
from kovacic.closed_form.structure import Triangular
from kovacic.enclosure.frame import System, make_frame
from kovacic.enclosure.points import ExactPoint
from kovacic.enclosure.problem import as_problem
from kovacic.enclosure.request import Request
from kovacic.enclosure.states import evaluate_states
from kovacic.engine.places import analyse
from kovacic.galois import Ground
from kovacic.limits import Budget, bounded_work, limited
from kovacic.reading.read import read_input
from kovacic.reading.symbolic import read_expression
from kovacic.solution.conditions import Conditions
from kovacic.verify import verify
from kovacic.views.plot import SampledCurve, sampled_curve

__all__ = [
    "COMMANDS",
    "QQ",
    "AlgebraicField",
    "Atoms",
    "Budget",
    "Conditions",
    "Equation",
    "ExactPoint",
    "Field",
    "FunctionField",
    "Ground",
    "Poly",
    "RatFunc",
    "System",
    "Triangular",
    "analyse",
    "as_problem",
    "ball_to_flint",
    "bounded_work",
    "decompose",
    "equation",
    "evaluate_states",
    "function",
    "generated",
    "is_exact_solution",
    "jet",
    "make_frame",
    "parametrize",
    "read_expression",
    "read_input",
    "residual",
    "run",
    "run_and_exit",
    "sample",
    "system_of",
    "verify",
]


def function(text: Any, var: str | None = "x") -> RatFunc:
    """The rational function of a text or a SymPy expression."""
    return read_input(text, var=var).S


def system_of(num: Iterable[int], den: Iterable[int]) -> System:
    """The normal form den y'' = num y with these coefficients, from low to high."""
    return System.of(RatFunc(QQ.poly([*num]), QQ.poly([*den])))


def ball_to_flint(ball: Any) -> acb:
    """A ball as python-flint's, complex even where it is real."""
    return acb(ball.to_flint())


@limited
def sample(equation: object, start: object, stop: object, *, points: int = 400, **keywords: Any) -> SampledCurve:
    """The curve of a picture, with the arguments of `kovacic.plot`."""
    return sampled_curve(equation, start, stop, points, Request.of("sample", keywords, unused=("path",)))


def equation(text: Any, var: str | None = None) -> Equation:
    """The equation of a text with y''."""
    found = read_input(text, var=var).equation
    assert found is not None
    return found


def parametrize(
    names: str | tuple[str, ...],
    values: Iterable[Any],
    *,
    ordinary: int | Collection[int],
    long: int | Collection[int] | None = None,
    always: Sequence[Any] = (),
    **options: Any,
) -> pytest.MarkDecorator:
    """`pytest.mark.parametrize` of which `ordinary` values are in the ordinary suite; the others are `long`.

    `ordinary` is how many, spread evenly, or the places of those that cover every branch that the others cover.
    For properties of which every member takes a while: a few say at once that something broke, all of them run in .ci/run.
    Where that takes minutes, `long` is how many of the others, or which, run there; the rest is `slow`.  A value that
    alone covers a branch is ordinary `always`.
    """
    members = list(values)
    one_name = isinstance(names, str) and "," not in names
    at_once = _spread(range(len(members)), ordinary) | {members.index(member) for member in always}
    others = [index for index in range(len(members)) if index not in at_once]
    in_ci = _spread(others, len(others) if long is None else long)
    marked = []
    for index, member in enumerate(members):
        if index in at_once:
            marked.append(member)
        else:
            marked.append(_marked(member, pytest.mark.long if index in in_ci else pytest.mark.slow, one_name))
    return pytest.mark.parametrize(names, marked, **options)


def generated(count: int) -> settings:
    """`count` generated examples in .ci/run; ten times as many before a release, with HYPOTHESIS_PROFILE=fuzz."""
    return settings(max_examples=count * (10 if settings.get_current_profile_name() == "fuzz" else 1))


def size(number: Any, digits: int = 20) -> Any:
    """The absolute value of a number of SymPy's; of zero what rounding leaves, where SymPy would go on to 100 digits."""
    return abs(sympy.N(number, digits, maxn=2 * digits))


def _spread(indices: Sequence[int], chosen: int | Collection[int]) -> set[int]:
    return {indices[k * len(indices) // chosen] for k in range(chosen)} if isinstance(chosen, int) else set(chosen)


def _marked(member: Any, mark: pytest.MarkDecorator, one_name: bool) -> Any:
    if hasattr(member, "marks"):  # what pytest.param gives
        return pytest.param(*member.values, marks=[*member.marks, mark], id=member.id)
    parts = (member,) if one_name else member
    return pytest.param(*parts, marks=mark)
