"""Kovacic's algorithm: closed-form (Liouvillian) solutions of y'' = S(x) y, or a proof that there are none.

>>> import kovacic
>>> kovacic.solve("x^2 + 3").case
1
"""

from kovacic.api import Verdict, decide, solve
from kovacic.batch import solve_many
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

__version__ = "0.1.0"

__all__ = [
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
    "decide",
    "solve",
    "solve_many",
]
