"""General solutions as SymPy gives them: an equation goes in, `Eq(y(x), ...)` with constants comes out, or all w(x).

`dsolve.dsolve` is the entry, and the module to read first: its head lists the steps.  `conditions` reads all initial and
boundary values.  `basis` is the pair of solutions that knows its Wronskian, `answer` the object that everything shown is read
from.  `particular` finds a solution with the right-hand side by the cheapest way: `undetermined` coefficients, or variation of
parameters with the integrals of `antiderivatives`, those of `waves` among them.  Right-hand sides that jump are sums of
`steps`.  `riccati` has the solutions of Riccati equations, `sympy_hint` the entry among SymPy's own methods.
"""

from kovacic.general_solution.answer import (
    FirstOrderAnswer,
    ProblemAnswer,
    SecondOrderAnswer,
    SystemAnswer,
    given_answer,
    validity,
)
from kovacic.general_solution.dsolve import answer_to, dsolve, in_special_functions
from kovacic.general_solution.explained import explain, is_problem
from kovacic.general_solution.homogeneous import NothingKnown
from kovacic.general_solution.riccati import RiccatiSolutions, solve_riccati
from kovacic.general_solution.sympy_hint import register, unregister
from kovacic.general_solution.validity import Validity

__all__ = [
    "FirstOrderAnswer",
    "NothingKnown",
    "ProblemAnswer",
    "RiccatiSolutions",
    "SecondOrderAnswer",
    "SystemAnswer",
    "Validity",
    "answer_to",
    "dsolve",
    "explain",
    "given_answer",
    "in_special_functions",
    "is_problem",
    "register",
    "solve_riccati",
    "unregister",
    "validity",
]
