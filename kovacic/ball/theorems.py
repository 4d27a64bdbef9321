"""Theorems 1 and 2 by the engine, and omega = y'/y, y, omega_3 and n in closed form.

With `xi = int dx/sqrt(D)`, `eta = omega_3 sqrt(D)` and `zeta = m R^2 A1 n + D'(x) omega_3/2` the linear system of every ball,
on a sphere or on the plane (rho = 0), has constant coefficients:
    d eta/d xi = -rho zeta,   d zeta/d xi = -rho l eta.
For E = D'/2 + sqrt(l D), dE/d xi = sqrt(l) E: so eta = c1 E^rho + c2 E^(-rho), y = D^(1/4) eta and
omega = D'/(4 D) +- rho sqrt(l/D); in the roots, E = (l/2) (sqrt(x - x1) + sqrt(x - x2))^2: Theorem 2 (case 2).  With N = 2 rho
an integer, the N-th power is the sum of two solutions with rational omega: Theorem 1 (case 1).  If D has a double root (powers
of x - x1), or if l = 0, that is A1 = A3 (powers of D), omega is rational for every ratio.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import mpmath
import sympy as sp

from kovacic.ball.ball import BallOnSphere, X, exact, sign, system
from kovacic.ball.equations import A1, A3, R1, R, in_roots, x1, x2
from kovacic.errors import InputError

if TYPE_CHECKING:
    from kovacic.parametric.answer import Conditions

C1, C2 = sp.symbols("c1 c2")
#: The largest |2R/R1| for which the solutions in the roots are written as polynomials.
_EXPANDED = 12


def conditions() -> Conditions:
    """When has (13), with R, R1, x1, x2 symbolic, a rational omega, and when one of degree 2?  Both theorems, proven.

    >>> print(str(conditions()).partition("\\n")[2])
      R1 = 0: S isn't defined
      x1 = x2: case 1
      2*R/R1 in Z: case 1
      otherwise: case 2
      (proven to be complete; at most three regular singular points: Kimura's theorem)
    """
    from kovacic.parametric.api import conditions as conditions_of

    return conditions_of(in_roots(R / R1)[2], var=X)


def theorem(sphere: BallOnSphere) -> tuple[str, int | None]:
    """What the theorems say about a ball, in words, and Kovacic's case (None where it depends on symbols)."""
    N = 2 * sphere.ratio
    for equal, value in (("A1 = A3", sphere.leading), ("x1 = x2", sphere.discriminant)):
        if sign(value) == 0:
            return f"{equal}: omega is rational for every ratio (case 1)", 1
    if N == 0:
        return "on a plane omega_3*sqrt(D) is constant (case 1)", 1
    return theorem_for(N)


def theorem_for(N: sp.Expr) -> tuple[str, int | None]:
    """The same for x1 != x2, where N = 2R/R1 decides."""
    if N.is_integer:
        special = "; R1 = R: omega_3 = const is a solution" if N == 2 else ""
        return f"Theorem 1: N is an integer, so omega is rational (case 1){special}", 1
    if not N.is_number:
        first = f"Theorem 1 (omega rational, case 1) if {N} is an integer"
        return f"{first}, else Theorem 2 (omega of degree 2, case 2)", None
    return "Theorem 2: N isn't an integer, so omega has degree 2 (case 2)", 2


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """omega = y'/y for a solution y or two; the general y, omega_3 and n with constants c1, c2, as functions of x = cos u."""

    omega: tuple[sp.Expr, ...]
    y: sp.Expr
    omega_3: sp.Expr
    n: sp.Expr
    E: sp.Expr | None = None  # of which powers occur: D'/2 + sqrt(l D), or its negative where that is positive

    def solves(self, system: tuple[sp.Expr, ...], S: sp.Expr, roots: tuple[sp.Expr, ...] = ()) -> bool:
        """Do omega, y, n and omega_3 as they're printed satisfy (13) and the linear system (see `linear_system`)?

        By substitution, to 30 digits, at one point and for one value of each symbol; `roots` are the values of x1, x2.
        """
        a1, a2, b1, b2 = system
        n, w, y = self.n, self.omega_3, self.y
        residuals = [sp.diff(n, X) + a1 * n + a2 * w, sp.diff(w, X) + b1 * n + b2 * w, sp.diff(y, X, 2) - S * y]
        residuals += [sp.diff(omega, X) + omega**2 - S for omega in self.omega]
        values = dict(zip((x1, x2), roots, strict=False))
        names = sorted(set().union(*(part.free_symbols for part in (n, w, y, *residuals))) - {X, *values}, key=str)
        values |= {name: sp.Rational(7 * k + 9, 5 * k + 4) for k, name in enumerate(names)}
        parts = [part.xreplace({z: sp.N(z, 70) for z in part.atoms(sp.CRootOf)}) for part in (n, w, y, *residuals)]
        with mpmath.workdps(60):
            at = [mpmath.mpmathify(sp.N(value, 70)) for value in (sp.Rational(2, 7), *values.values())]
            found = sp.lambdify([X, *values], parts, "mpmath", cse=True)(*at)
            return bool(max(map(abs, found[3:])) < 1e-30 * max(1, *map(abs, found[:3])))


def closed_form(sphere: BallOnSphere) -> ClosedForm:
    """The general solution of the linear equations of a ball, degenerate balls and the plane included; real on [-1, 1].

    Sines and cosines where l is known to be negative; undecided symbolic parameters are taken as generic.  Where omega is
    rational by Theorem 1, it's written in the roots x1, x2.  On the plane y is what belongs to omega_3.

    >>> from kovacic.ball.ball import Ball
    >>> closed_form(Ball(m=1, R=1, a=0, A1="1/4", A3="1/4").on_sphere(2)).n
    4*c2
    """
    D, lead, rho, half = sphere.D, sphere.leading, sphere.ratio, sphere.half
    root = sp.sqrt(D)
    share = sp.factor(half / (2 * D))
    E = None
    omega: tuple[sp.Expr, ...] = (share + rho * sp.sqrt(lead) / root, share - rho * sp.sqrt(lead) / root)
    if rho == 0:
        eta, zeta, omega = C1, C2, (share,)
    elif lead == 0:
        xi = X / root if half == 0 else root / half
        eta, zeta, omega = C1 - rho * C2 * xi, C2, (share, 1 / X if half == 0 else 3 * share)
    elif sign(sphere.discriminant) == 0:
        # D = l (x - x1)^2, so d xi = dx/(sqrt(l) (x - x1)); here l > 0, since a double root needs A3 > A1.
        scale, linear = sp.sqrt(lead), X + half.subs(X, 0) / lead
        eta, zeta = _exponentials(linear, rho, scale)
        root, omega = scale * linear, tuple((sp.Rational(1, 2) + power) / linear for power in (rho, -rho))
    elif rho == 1:
        eta, zeta = C1 * root + C2 * half, -C1 * half - C2 * lead * root
    elif sign(lead) == -1:
        # d phi/d xi = sqrt(-l), since |E|^2 = -l D + D'^2/4 is constant
        scale, phi = sp.sqrt(-lead), sp.acos(half / sp.sqrt(sp.expand(half**2 - lead * D)))
        eta = C1 * sp.cos(rho * phi) + C2 * sp.sin(rho * phi)
        zeta = scale * (C1 * sp.sin(rho * phi) - C2 * sp.cos(rho * phi))
    else:
        # For real roots beyond x = 1, D' is negative and so is D'/2 + sqrt(l D): its negative is as good, and positive.
        beyond = sign(sphere.discriminant) == 1 and sign(half.subs(X, 0)) == -1
        scale = sp.sqrt(lead)
        E = -half - scale * root if beyond else half + scale * root
        eta, zeta = _exponentials(E, rho, scale)
    if len(sphere.roots) == 2 and _is_written_out(rho):
        omega = closed_form_in_roots(rho).omega
    omega_3 = sp.expand(eta / root) if rho == 1 else eta / root
    return ClosedForm(omega, sp.sqrt(root) * eta, omega_3, (zeta - half * omega_3) / sphere.weight, E)


def _exponentials(E: sp.Expr, rho: sp.Expr, scale: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """eta and zeta from dE/d xi = scale E."""
    return C1 * E**rho + C2 * E ** (-rho), -scale * (C1 * E**rho - C2 * E ** (-rho))


def _is_written_out(rho: sp.Expr) -> bool:
    return bool((2 * rho).is_Integer and 0 < abs(2 * rho) <= _EXPANDED)


def read_ratio(text: str) -> sp.Expr:
    """R/R1 from text: a number, or a name for all of its values.

    Raises `InputError` for 0 (a plane has no R1), for a ball that doesn't fit inside, and for the names of other things.
    """
    known = {symbol.name for symbol in (X, x1, x2, A1, A3, C1, C2)}
    rho = sp.Symbol(text) if text.isidentifier() and text not in {*known, "u", "pi", "e"} else exact(text, "R/R1")
    if rho == 0:
        raise InputError("R/R1 = 0 has no R1", hint="a plane is --sphere plane, with --mass and --radius")
    if sign(rho + 1) in (0, -1):
        raise InputError(f"the ball doesn't fit inside the sphere: R < |R1| fails, as R/R1 = {rho}")
    return rho


def closed_form_in_roots(rho: sp.Expr) -> ClosedForm:
    """The general solution for R/R1 = rho other than 0, a number or with symbols, in the roots x1, x2 of D.

    Of the body, only A3/A1 occurs besides the roots.  For an integer N = 2 rho both solutions are polynomials times powers of
    sqrt(x - x1) and sqrt(x - x2), and written so up to |N| = 12; beyond, the polynomials are longer than a page.

    >>> print(closed_form_in_roots(sp.Rational(3, 2)).omega_3)
    c1*(4*x - x1 - 3*x2)/sqrt(x - x2) + c2*(4*x - 3*x1 - x2)/sqrt(x - x1)
    """
    alpha, beta, quarter = X - x1, X - x2, sp.Rational(1, 4)
    root = alpha**quarter * beta**quarter
    if _is_written_out(rho):
        # The parts of (sqrt(alpha) + sqrt(beta))^N with an even and with an odd power of sqrt(beta), over sqrt(alpha beta).
        N, omega, parts = abs(int(2 * rho)), [], []
        for i in (0, 1):
            k = (N - i) // 2
            P = sp.expand(sum(sp.binomial(N, 2 * j + i) * alpha ** (k - j) * beta**j for j in range(k + 1)))
            e1, e2 = (-sp.Rational(i == N % 2, 2), -sp.Rational(i == 0, 2))
            rate = e1 * beta + e2 * alpha + (1 + rho) * (alpha + beta) / 2
            omega.append((e1 + 3 * quarter) / alpha + (e2 + 3 * quarter) / beta + sp.diff(P, X) / P)
            parts.append((P, sp.expand((alpha * beta * sp.diff(P, X) + rate * P) / rho), alpha**e1 * beta**e2))
        (P, Q, first), (P2, Q2, second) = parts
        omega_3, spin = C1 * P * first + C2 * P2 * second, C1 * Q * first + C2 * Q2 * second
        y = C1 * P * first * root**3 + C2 * P2 * second * root**3
    else:
        r, s, z = sp.sqrt(alpha) + sp.sqrt(beta), sp.sqrt(alpha) - sp.sqrt(beta), root**2
        power, steps = r ** (2 * rho), (rho / z, -rho / z)
        if (2 * rho).is_Integer:  # r' = r/(2 z), s' = -s/(2 z): these two are rational
            quotient = (r ** (2 * rho) - s ** (2 * rho)) / (r ** (2 * rho) + s ** (2 * rho))
            steps = (rho / z * quotient, rho / z / quotient)
        omega = [(1 / alpha + 1 / beta) / 4 + step for step in steps]
        omega_3, y = C1 * power / z + C2 / (power * z), root * (C1 * power + C2 / power)
        slope = (alpha + beta) / (2 * z)
        spin = C1 * (slope + 1) * power + C2 * (slope - 1) / power
    return ClosedForm(tuple(omega), y, omega_3, -(A3 - A1) / A1 * spin)


def system_in_roots(rho: sp.Expr) -> tuple[sp.Expr, ...]:
    """The linear system of `BallOnSphere.linear_system` in the roots of D."""
    return system((X - x1) * (X - x2), X - (x1 + x2) / 2, 1, A1 / (A3 - A1), rho)
