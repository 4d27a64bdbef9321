"""The method "kovacic" for `sympy.dsolve`, beside SymPy's own.

SymPy keeps its methods in `solver_map`, classes by their names, which are called hints; the first that matches is the default.
The order of the hints stands a second time in the tuple `allhints`, under two names.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy.solvers import ode
from sympy.solvers.ode import ode as names
from sympy.solvers.ode.single import SingleODESolver, solver_map

from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.dsolve import dsolve

Expr = Any  # SymPy publishes no types
HINT = "kovacic"


def register() -> None:
    """Make `sympy.dsolve` know this package's method: `hint="kovacic"`, and the default wherever it finds the solution.

    From then on `classify_ode` names it first, `hint="all"` and `hint="best"` try it, and initial and boundary values are
    put in by SymPy itself, as for its own methods (`kovacic.dsolve` has its own way, which knows more: free constants, and
    why there is no solution).  An equation that it can't solve is left to SymPy's methods.  Twice is the same as once.

    Returns
    -------
    None
        SymPy has the hint from then on.

    Examples
    --------
    >>> import kovacic, sympy
    >>> x, y = sympy.Symbol("x"), sympy.Function("y")
    >>> equation = sympy.Eq(y(x).diff(x, 2), (x**2 + 1) * y(x))
    >>> kovacic.register()
    >>> sympy.dsolve(equation)
    Eq(y(x), (C1 + C2*erf(x))*exp(x**2/2))
    >>> kovacic.unregister()
    """
    if HINT in solver_map:
        return
    others = dict(solver_map)
    solver_map.clear()  # the dictionary is known under several names: it is changed, not replaced
    solver_map.update({HINT: KovacicSolver, **others})
    _set_hints((HINT, *names.allhints))


def unregister() -> None:
    """Undo `register`; nothing happens where it wasn't called.

    Returns
    -------
    None
        SymPy is as it was.

    Examples
    --------
    >>> import kovacic
    >>> kovacic.unregister()
    """
    solver_map.pop(HINT, None)
    _set_hints(tuple(hint for hint in names.allhints if hint != HINT))


def _set_hints(hints: tuple[str, ...]) -> None:
    names.allhints = hints
    ode.allhints = hints


class KovacicSolver(SingleODESolver):  # type: ignore[misc]
    """SymPy asks first whether a method matches, and then for the solution; here that is the same question."""

    hint = HINT
    has_integral = False
    order = [2]  # noqa: RUF012 - as in SymPy's own classes

    def _matches(self) -> bool:
        problem = self.ode_problem
        try:
            self._found = dsolve(sympy.Eq(problem.eq, 0), problem.func)
        except (InputError, LimitExceeded, NotImplementedError):
            return False
        return True

    def _get_general_solution(self, *, simplify_flag: bool = True) -> list[Expr]:
        left, right = self._found.args
        integrals = {e: OpenIntegral(*e.args) for e in right.atoms(sympy.Integral)}
        return [sympy.Eq(left, right.subs(integrals), evaluate=False)]


class OpenIntegral(sympy.Integral):  # type: ignore[misc]
    """An integral that was tried, and stays: SymPy calls `doit` on solutions, which may take minutes.

    `Integral(*e.args).doit()` tries SymPy's rules.
    """

    def doit(self, **hints: Any) -> Expr:
        return self
