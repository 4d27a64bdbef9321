"""General solutions as SymPy gives them: an equation goes in, `Eq(y(x), ...)` with constants comes out, or all w(x).

`dsolve.dsolve` is the entry, and the module to read first.  A particular solution comes from `undetermined` (coefficients) or
`variation` (of parameters), whose integrals SymPy does in a process of its own; `initial_values` determine the constants.
`riccati` has the solutions of Riccati equations.
"""

from kovacic.general_solution.dsolve import dsolve
from kovacic.general_solution.riccati import RiccatiSolutions, solve_riccati

__all__ = ["RiccatiSolutions", "dsolve", "solve_riccati"]
