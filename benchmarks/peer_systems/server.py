"""Serve a Python package to `process.System`: a line of JSON with S in, a line with the answer and the end marker out."""

from __future__ import annotations

import base64
import json
import pickle
import sys
import warnings
from collections.abc import Callable
from typing import Any

Answer = dict[str, Any]


def answer(kind: str, form: str = "y", expressions: list[str] | None = None) -> Answer:
    return {"kind": kind, "form": form, "expressions": expressions or []}


def pickled(expression: Any) -> str:
    """A SymPy expression for `check.read`: printing and parsing it would take longer, and lose functions."""
    return "pickle:" + base64.b64encode(pickle.dumps(expression)).decode("ascii")


def by_kovacic(S: str) -> Answer:
    import kovacic

    found = kovacic.solve(S)
    if found.riccati is None:
        return answer("undecided" if found.reason else "none")
    polynomial = "" if found.constants is None else found.constants.to_str("c")
    return answer("solved", "riccati", [*map(str, found.riccati.coefficients), polynomial])


def by_kovacic_full(S: str) -> Answer:
    import kovacic

    found = kovacic.solve(S)
    if found.case is None:
        return answer("undecided" if found.reason else "none")
    return answer("solved", "y", [pickled(y) for y in found.solutions])


def by_dsolve(S: str) -> Answer:
    import sympy
    from sympy.parsing.sympy_parser import parse_expr

    x, y = sympy.Symbol("x"), sympy.Function("y")
    try:
        found = sympy.dsolve(y(x).diff(x, 2) - parse_expr(S.replace("^", "**"), {"x": x}) * y(x), y(x))
    except NotImplementedError:
        return answer("undecided")
    if found.has(sympy.Order):
        return answer("undecided")
    return answer("solved", "y", [pickled(found.rhs)])


def by_solve_riccati(S: str) -> Answer:
    import sympy
    from sympy.parsing.sympy_parser import parse_expr
    from sympy.solvers.ode.riccati import solve_riccati

    x = sympy.Symbol("x")
    found = solve_riccati(
        sympy.Function("w")(x), x, parse_expr(S.replace("^", "**"), {"x": x}), sympy.S(0), sympy.S(-1)
    )
    return answer("solved", "omega", [pickled(w.rhs) for w in found]) if found else answer("none", "omega")


METHODS: dict[str, Callable[[str], Answer]] = {
    "kovacic": by_kovacic,
    "kovacic-full": by_kovacic_full,
    "dsolve": by_dsolve,
    "riccati": by_solve_riccati,
}


def main() -> None:
    warnings.simplefilter("ignore")
    method = METHODS[sys.argv[1]]
    for line in sys.stdin:
        try:
            found = method(json.loads(line))
        except Exception as error:  # whatever another package raises is an answer of the kind "error"
            found = answer("error", expressions=[f"{type(error).__name__}: {error}"[:300]])
        print(json.dumps(found))
        print("<<<end>>>", flush=True)


if __name__ == "__main__":
    main()
