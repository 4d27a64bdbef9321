"""omega_3(u) and n(u) of the ball in closed form: as expressions, and as numbers in any precision.

Both come from the constant-coefficient system of `kovacic.ball.ball`; symbols as there, with E = D'/2 + sqrt(l D),
for which dE/d xi = sqrt(l) E.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType
from typing import Any

import sympy as sp

from kovacic.ball.ball import BallOnSphere, Scalar, exact
from kovacic.ball.meridian import X
from kovacic.ball.theorems import rational_solutions
from kovacic.errors import InputError

C1, C2 = sp.symbols("c1 c2")
#: The range of numbers in a motion: products of several of them are still floats.
LEAST, LARGEST = 1e-50, 1e50
#: The largest |2R/R1| for which the solutions in the roots are written as polynomials.
_EXPANDED = 50


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """The general solution with constants c1, c2, as functions of x = cos u."""

    omega_3: sp.Expr
    n: sp.Expr


def closed_form(sphere: BallOnSphere) -> ClosedForm:
    """The general solution of the linear equations of the ball, degenerate balls and the plane included.

    eta = c1 E^rho + c2 E^(-rho) where l != 0 and D has no double root; sines and cosines where l is known to be negative;
    a polynomial in xi where rho^2 l = 0; powers of x - x1 at a double root.
    Undecided symbolic parameters are taken as generic.

    >>> from kovacic.ball.ball import Ball
    >>> closed_form(Ball(m=1, R=1, a=0, A1="1/4", A3="1/4").on_sphere(2)).n
    4*c2
    """
    m, R, _, A1, _ = sphere.ball.parameters
    D, lead, rho = sphere.D, sphere.leading, sphere.ratio
    half = sp.expand(sp.diff(D, X) / 2)
    root = sp.sqrt(D)
    if rho == 0:
        eta, zeta = C1, C2
    elif lead == 0:
        xi = X / root if half == 0 else root / half
        eta, zeta = C1 - rho * C2 * xi, C2
    elif sphere.discriminant == 0:
        # D = l (x - x1)^2, so d xi = dx/(sqrt(l) (x - x1)); here l > 0, since a double root needs A3 > A1.
        scale = sp.sqrt(lead)
        linear = X + half.subs(X, 0) / lead
        root = scale * linear
        eta = C1 * linear**rho + C2 * linear ** (-rho)
        zeta = -scale * (C1 * linear**rho - C2 * linear ** (-rho))
    elif lead.is_number and lead < 0:
        scale = sp.sqrt(-lead)
        # d phi/d xi = scale, since |E|^2 = -l D + D'^2/4 is constant
        angle = sp.acos(half / sp.sqrt(sp.expand(half**2 - lead * D)))
        eta = C1 * sp.cos(rho * angle) + C2 * sp.sin(rho * angle)
        zeta = scale * (C1 * sp.sin(rho * angle) - C2 * sp.cos(rho * angle))
    else:
        scale = sp.sqrt(lead)
        # For real roots beyond x = 1, D' is negative and so is D'/2 + sqrt(l D): its negative is as good, and positive.
        beyond = sphere.discriminant.is_number and sphere.discriminant > 0 and half.subs(X, 0) < 0
        E = -half - scale * root if beyond else half + scale * root
        eta = C1 * E**rho + C2 * E ** (-rho)
        zeta = -scale * (C1 * E**rho - C2 * E ** (-rho))
    omega_3 = eta / root
    return ClosedForm(omega_3, (zeta - half * omega_3) / (m * R**2 * A1))


def closed_form_in_roots(rho: Scalar) -> ClosedForm:
    """The general solution for a ratio R/R1 = rho other than 0, in the roots x1, x2 of D, the body otherwise arbitrary.

    Of the body, only A3/A1 occurs besides the roots.  For an integer 2 rho both solutions are polynomials times powers of
    sqrt(x - x1) and sqrt(x - x2), and written so up to |2 rho| = 50; beyond, the polynomials are longer than a page.

    >>> closed_form_in_roots(sp.Rational(-1, 2)).n
    (A1 - A3)*(c1*(-x1/2 + x2/2)/sqrt(x - x2) + c2*(x1/2 - x2/2)/sqrt(x - x1))/A1
    """
    rho = exact(rho, "R/R1")
    A1, A3, x1, x2 = sp.symbols("A1 A3 x1 x2")
    twice = sp.Abs(2 * rho)
    if twice.is_Integer and twice <= _EXPANDED:
        solutions = rational_solutions(int(twice))
        first, second = solutions.expressions()
        spin_1, spin_2 = solutions.expressions(solutions.spins(1 if rho > 0 else -1))
    else:
        alpha, beta = X - x1, X - x2
        z, power = sp.sqrt(alpha) * sp.sqrt(beta), (sp.sqrt(alpha) + sp.sqrt(beta)) ** (2 * rho)
        first, second = power / z, 1 / (power * z)
        slope = (alpha + beta) / (2 * z)
        spin_1, spin_2 = (slope + 1) * power, (slope - 1) / power
    return ClosedForm(C1 * first + C2 * second, -(A3 - A1) / A1 * (C1 * spin_1 + C2 * spin_2))


@dataclass(frozen=True, slots=True)
class NumericBall:
    """The ball's numbers in one arithmetic: `functions` is numpy (arrays of floats) or mpmath (its current precision).

    `kappa` is 1/R1.  All methods take x = cos u.
    """

    m: Any
    R: Any
    a: Any
    A1: Any
    A3: Any
    kappa: Any
    functions: ModuleType

    @classmethod
    def of(cls, sphere: BallOnSphere, functions: ModuleType) -> NumericBall:
        """Raises `InputError` where a parameter is a symbol."""
        values: list[Any] = []
        kappa = sp.Integer(0) if sphere.R1.is_infinite else 1 / sphere.R1
        for value in (*sphere.ball.parameters, kappa):
            if not value.is_number:
                raise InputError(f"numbers are needed for a motion, and {value} isn't one")
            precise = hasattr(functions, "mpf")
            number = functions.mpmathify(sp.N(value, functions.mp.dps + 5)) if precise else float(value)
            if value and not LEAST <= abs(number) <= LARGEST:
                raise InputError(
                    f"{sp.N(value, 3)} isn't between {LEAST:g} and {LARGEST:g}", hint="choose units that bring it there"
                )
            values.append(number)
        m, R, a, A1, A3, curvature = values
        return cls(m, R, a, A1, A3, curvature, functions)

    @property
    def rho(self) -> Any:
        return self.R * self.kappa

    @property
    def lead(self) -> Any:
        return self.m * self.R**2 * (self.A3 - self.A1)

    def D(self, x: Any) -> Any:
        return self.A1 * (self.A3 + self.m * self.R**2 * (1 - x * x)) + self.A3 * self.m * (self.R * x + self.a) ** 2

    def half_derivative(self, x: Any) -> Any:
        """D'(x)/2."""
        return self.m * self.R * ((self.A3 - self.A1) * self.R * x + self.A3 * self.a)

    def transport(self, x: Any, x0: Any, omega_3: Any, n: Any) -> tuple[Any, Any]:
        """(omega_3, n) at x from their values at x0, by the closed form; one formula each for l > 0, l < 0 and l = 0."""
        F, rho, lead = self.functions, self.rho, self.lead
        weight = self.m * self.R**2 * self.A1
        root0, root = F.sqrt(self.D(x0)), F.sqrt(self.D(x))
        eta0 = omega_3 * root0
        zeta0 = weight * n + self.half_derivative(x0) * omega_3
        chord = (x - x0) / (root + root0)
        if lead > 0:
            scale = F.sqrt(lead)
            angle = 2 * rho * _call(F, "arctanh", "atanh")(scale * chord)
            even, odd = F.cosh(angle), F.sinh(angle)
            eta, zeta = eta0 * even - zeta0 * odd / scale, zeta0 * even - scale * eta0 * odd
        elif lead < 0:
            scale = F.sqrt(-lead)
            angle = 2 * rho * _call(F, "arctan", "atan")(scale * chord)
            even, odd = F.cos(angle), F.sin(angle)
            eta, zeta = eta0 * even - zeta0 * odd / scale, zeta0 * even + scale * eta0 * odd
        else:
            eta, zeta = eta0 - 2 * rho * zeta0 * chord, zeta0
        omega = eta / root
        return omega, (zeta - self.half_derivative(x) * omega) / weight

    def K11(self, x: Any) -> Any:
        """The coefficient of u'^2 in twice the kinetic energy."""
        return (1 + self.rho) ** 2 * (self.A1 + self.m * (self.R**2 + self.a**2 + 2 * self.R * self.a * x))

    def transverse_energy(self, x: Any, sine2: Any, omega_3: Any, n: Any) -> Any:
        """sin^2 u times twice the part of the kinetic energy without u'; `sine2` = sin^2 u."""
        y = x * n - omega_3
        eps, a, m = self.R + self.a * x, self.a, self.m
        first = (m * eps**2 + self.A1 * x**2 + self.A3 * sine2) * y**2
        mixed = 2 * (m * eps * a - (self.A3 - self.A1) * x) * sine2 * y * n
        return first + mixed + ((m * a**2 + self.A1) * sine2 + self.A3 * x**2) * sine2 * n**2


def _call(functions: ModuleType, *names: str) -> Any:
    return next(getattr(functions, name) for name in names if hasattr(functions, name))
