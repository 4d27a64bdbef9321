# Written by tests/package/test_public_names.py.
from kovacic.api import Verdict as Verdict
from kovacic.api import decide as decide
from kovacic.batch import solve_many as solve_many
from kovacic.bound_states.api import spectrum as spectrum
from kovacic.decision import Status as Status
from kovacic.decision import Structure as Structure
from kovacic.doubles.tabulate import tabulate as tabulate
from kovacic.enclosure.ball import Ball as Ball
from kovacic.enclosure.evaluate import Prepared as Prepared
from kovacic.enclosure.evaluate import evaluate as evaluate
from kovacic.enclosure.evaluate import prepared as prepared
from kovacic.enclosure.monodromy import connection_matrix as connection_matrix
from kovacic.enclosure.monodromy import monodromy as monodromy
from kovacic.enclosure.precision import AccuracyWarning as AccuracyWarning
from kovacic.equation import Equation as Equation
from kovacic.errors import InputError as InputError
from kovacic.errors import KovacicError as KovacicError
from kovacic.errors import LimitExceeded as LimitExceeded
from kovacic.errors import MissingExtra as MissingExtra
from kovacic.errors import NotLinear as NotLinear
from kovacic.errors import NotRational as NotRational
from kovacic.errors import ParseError as ParseError
from kovacic.errors import VerificationFailed as VerificationFailed
from kovacic.general_solution import dsolve as dsolve
from kovacic.general_solution import explain as explain
from kovacic.general_solution import register as register
from kovacic.general_solution import solve_riccati as solve_riccati
from kovacic.general_solution import unregister as unregister
from kovacic.general_solution import validity as validity
from kovacic.general_solution.boundary_problems import eigenvalues as eigenvalues
from kovacic.limits import Limits as Limits
from kovacic.solution import Solution as Solution
from kovacic.solution import solve as solve
from kovacic.solution.conditions import conditions as conditions
from kovacic.writing.code import as_code as as_code

__version__: str
