"""Kovacic's algorithm: closed-form (Liouvillian) solutions of y'' = S(x) y, or a proof that there are none.

>>> import kovacic
>>> kovacic.solve("x^2 + 3").case
1
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kovacic.api import Verdict, decide, solve
    from kovacic.batch import solve_many
    from kovacic.decision import Status, Structure
    from kovacic.enclosure.evaluate import evaluate
    from kovacic.equation import Equation
    from kovacic.errors import (
        InputError,
        KovacicError,
        LimitExceeded,
        NotLinear,
        NotRational,
        ParseError,
        VerificationFailed,
    )
    from kovacic.general_solution import dsolve, solve_riccati
    from kovacic.limits import Limits
    from kovacic.parametric.api import conditions
    from kovacic.solution import Solution

__version__ = "0.1.0"

#: Every name is imported when it is first used, so that `import kovacic` doesn't cost what isn't needed.
_MODULES = {
    "Equation": "kovacic.equation",
    "InputError": "kovacic.errors",
    "KovacicError": "kovacic.errors",
    "LimitExceeded": "kovacic.errors",
    "Limits": "kovacic.limits",
    "NotLinear": "kovacic.errors",
    "NotRational": "kovacic.errors",
    "ParseError": "kovacic.errors",
    "Solution": "kovacic.solution",
    "Status": "kovacic.decision",
    "Structure": "kovacic.decision",
    "Verdict": "kovacic.api",
    "VerificationFailed": "kovacic.errors",
    "conditions": "kovacic.parametric.api",
    "decide": "kovacic.api",
    "dsolve": "kovacic.general_solution",
    "evaluate": "kovacic.enclosure.evaluate",
    "solve": "kovacic.api",
    "solve_many": "kovacic.batch",
    "solve_riccati": "kovacic.general_solution",
}

__all__ = [
    "Equation",
    "InputError",
    "KovacicError",
    "LimitExceeded",
    "Limits",
    "NotLinear",
    "NotRational",
    "ParseError",
    "Solution",
    "Status",
    "Structure",
    "Verdict",
    "VerificationFailed",
    "conditions",
    "decide",
    "dsolve",
    "evaluate",
    "solve",
    "solve_many",
    "solve_riccati",
]


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module 'kovacic' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(_MODULES[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
