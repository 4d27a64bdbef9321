"""The ball on the sphere: Woronetz's equations, Theorems 1 and 2 by the engine, and the motion.

A body is `RollingBall(...).on_sphere(R1)`, or `InRoots(rho)` for all bodies with one ratio of the radii.  Of it there are the
equations (`derivation`), closed forms (`theorems`) and the motion (`motion`, `picture`, which need NumPy).  Read `body` first.
"""

from kovacic.ball.body import BallOnSphere, InRoots, RollingBall, U, X
from kovacic.ball.theorems import BallSolution, closed_form
from kovacic.errors import former_names

__all__ = ["BallOnSphere", "BallSolution", "InRoots", "RollingBall", "U", "X", "closed_form"]

__getattr__ = former_names(__name__, {"Ball": RollingBall, "ClosedForm": BallSolution})
