"""The ball on the sphere: Woronetz's equations, Theorems 1 and 2 by the engine, and the motion.

In goes a body, `RollingBall(...).on_sphere(R1)`, or one ratio of the radii for all bodies, `InRoots(rho)`; out come its
equations (`derivation`, from the definitions), the closed forms of omega_3 and n (`theorems`), and its motion (`motion`,
`picture`, imported by name, for they need NumPy).  Read `body` first.
"""

from kovacic.ball.body import BallOnSphere, InRoots, RollingBall, U, X
from kovacic.ball.theorems import BallSolution, closed_form
from kovacic.errors import former_names

__all__ = ["BallOnSphere", "BallSolution", "InRoots", "RollingBall", "U", "X", "closed_form"]

__getattr__ = former_names(__name__, {"Ball": RollingBall, "ClosedForm": BallSolution})
