"""The method "kovacic" for `sympy.dsolve`, in addition to SymPy's own.

`solver_map` has SymPy's methods, classes by their hints; the first that matches is the default.  The tuple `allhints`, which
has two names, repeats the order of the hints.
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

    From then on `classify_ode` names it first, and `hint="all"` and `hint="best"` try it.  Initial and boundary values are
    put in by SymPy, as for its own methods (`kovacic.dsolve` does more: it leaves constants free, and says why there is no
    solution).  An equation that it can't solve is left to SymPy's methods.  A second call has no effect.

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
    solver_map.clear()  # it is changed, not replaced: several modules refer to it
    solver_map.update({HINT: KovacicSolver, **others})
    _set_hints((HINT, *names.allhints))


def unregister() -> None:
    """Undo `register`, if it was called.

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
    """The method: it matches if it finds the solution, which SymPy asks for afterwards."""

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
    """An integral that stays: SymPy calls `doit` on solutions, for minutes perhaps; `Integral(*e.args).doit()` still works."""

    def doit(self, **hints: Any) -> Expr:
        return self
