"""General solutions as SymPy gives them: an equation goes in, `Eq(y(x), ...)` with constants comes out, or all w(x).

`dsolve.dsolve` is the entry, and the module to read first: its head lists the steps.  `particular` finds a solution with the
right-hand side by the cheapest way: `undetermined` coefficients, or `variation` of parameters with the integrals of
`antiderivatives`.  `riccati` has the solutions of Riccati equations.
"""

from kovacic.general_solution.dsolve import dsolve, in_special_functions
from kovacic.general_solution.riccati import RiccatiSolutions, solve_riccati

__all__ = ["RiccatiSolutions", "dsolve", "in_special_functions", "solve_riccati"]
