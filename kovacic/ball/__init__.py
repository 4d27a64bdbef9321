"""The ball on the sphere: Woronetz's equations, Theorems 1 and 2 by the engine, and the motion.

In goes a body, `Ball(...).on_sphere(R1)`, or one ratio of the radii for all bodies, `InRoots(rho)`; out come its equations
(`equations`, derived from the definitions), the closed forms of omega_3 and n (`theorems`), and its motion (`motion`, `plot`,
imported by name, for they need NumPy).  Read `ball` first.
"""

from kovacic.ball.ball import Ball, BallOnSphere, InRoots, U, X
from kovacic.ball.theorems import ClosedForm, closed_form

__all__ = ["Ball", "BallOnSphere", "ClosedForm", "InRoots", "U", "X", "closed_form"]
