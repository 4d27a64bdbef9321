"""Kovacic's algorithm: closed-form (Liouvillian) solutions of y'' = S(x) y, or a proof that there are none.

>>> import kovacic
>>> kovacic.solve("x^2 + 3").case
1
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from kovacic.api import Verdict, decide, solve
from kovacic.dsolve import dsolve, solve_riccati
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
from kovacic.limits import Limits
from kovacic.result import Solution
from kovacic.solution import Status, Structure

if TYPE_CHECKING:
    from kovacic.batch import solve_many
    from kovacic.numeric.evaluate import evaluate
    from kovacic.parametric.api import conditions

__version__ = "0.1.0"

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


#: Names that are imported when they are first used, so that `import kovacic` stays light.
_LAZY = {
    "conditions": "kovacic.parametric.api",
    "evaluate": "kovacic.numeric.evaluate",
    "solve_many": "kovacic.batch",
}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module 'kovacic' has no attribute {name!r}")
    return getattr(import_module(_LAZY[name]), name)
