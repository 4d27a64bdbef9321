"""Rolling bodies of revolution: Woronetz's equations, the ball on the sphere, Theorems 1 and 2, and the motion.

`Ball(...).on_sphere(R1)` is the entry for the ball; `Body` takes any meridian.  The numerical modules (`motion`,
`plot`) are imported by name where they're wanted, for they need NumPy and SciPy.
"""

from kovacic.ball.ball import Ball, BallOnSphere, Equation
from kovacic.ball.closed import ClosedForm, closed_form
from kovacic.ball.meridian import Profile, U, X
from kovacic.ball.woronetz import Body, LinearSystem, RationalEquation, SecondOrder

__all__ = [
    "Ball",
    "BallOnSphere",
    "Body",
    "ClosedForm",
    "Equation",
    "LinearSystem",
    "Profile",
    "RationalEquation",
    "SecondOrder",
    "U",
    "X",
    "closed_form",
]
