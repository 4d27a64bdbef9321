"""Theorems 1 and 2 by the engine, and omega = y'/y, y, omega_3 and n in closed form.

With `xi = int dx/sqrt(D)`, `eta = omega_3 sqrt(D)` and `zeta = m R^2 A1 n + D'(x) omega_3/2` the linear system of every ball,
on a sphere or on the plane (rho = 0), has constant coefficients:
    d eta/d xi = -rho zeta,   d zeta/d xi = -rho l eta.
For E = D'/2 + sqrt(l D), dE/d xi = sqrt(l) E: so eta = c1 E^rho + c2 E^(-rho), y = D^(1/4) eta and
omega = D'/(4 D) +- rho sqrt(l/D); in the roots, E = (l/2) (sqrt(x - x1) + sqrt(x - x2))^2: Theorem 2 (case 2).  With
d = (D'/2)^2 - l D, the discriminant of D by 4, and d/E the conjugate of E,
    m R^2 A1 sqrt(D) n = -c1 E^(1+rho) - c2 d E^(-1-rho).
With N = 2 rho an integer, the N-th power is the sum of two solutions with rational omega: Theorem 1 (case 1).  If D has a
double root (powers of x - x1), or if l = 0, that is A1 = A3 (powers of D), omega is rational for every ratio.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp
from flint import acb, arb, fmpq

from kovacic.algebra.precision import working_digits
from kovacic.ball.body import A1, A3, InRoots, Rolling, X, exact_quantity, sign, x1, x2
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError

C1, C2 = sp.symbols("c1 c2")
#: The largest |2R/R1| for which the solutions in the roots are written as polynomials: at 12, n has 1,200 characters.
_MOST_EXPANDED = 12


def ball_theorem(place: Rolling) -> tuple[str, int | None]:
    """The claim of the theorems about a ball, in words, and Kovacic's case, or None if that depends on symbols."""
    N = 2 * place.ratio
    for equal, value in (("A1 = A3", place.leading), ("x1 = x2", place.discriminant)):
        if sign(value) == 0:
            return f"{equal}: omega is rational for every ratio (case 1)", 1
    if N == 0:
        return "on a plane omega_3*sqrt(D) is constant (case 1)", 1
    if N.is_integer:
        constant = "; R1 = R: omega_3 = const is a solution" if N == 2 else ""
        return f"Theorem 1: N is an integer, so omega is rational (case 1){constant}", 1
    if not N.is_number:
        first = f"Theorem 1 (omega rational, case 1) if {N} is an integer"
        return f"{first}, else Theorem 2 (omega of degree 2, case 2)", None
    return "Theorem 2: N isn't an integer, so omega has degree 2 (case 2)", 2


@dataclass(frozen=True, slots=True)
class BallSolution:
    """The general solution of the linear equations of a ball, as functions of x = cos u with constants c1, c2.

    Attributes
    ----------
    omega : tuple of sympy.Expr
        y'/y for one or two solutions y.
    y, omega_3, n : sympy.Expr
        The general solutions.
    E : sympy.Expr or None
        The base of the powers in them: D'/2 + sqrt(l D), or its negative where that is positive.
    """

    omega: tuple[sp.Expr, ...]
    y: sp.Expr
    omega_3: sp.Expr
    n: sp.Expr
    E: sp.Expr | None = None

    def solves(self, place: Rolling) -> bool:
        """True if omega, y, n and omega_3, as printed, satisfy (13) and the `linear_system`.

        By substitution at one point and for one value of each symbol, to 30 digits in interval arithmetic.
        """
        roots = {} if isinstance(place, InRoots) else dict(zip((x1, x2), place.roots, strict=False))

        def at(e: sp.Expr) -> tuple[Any, Any, Any]:
            return jet(e.xreplace(roots), X, acb(fmpq(2, 7)))

        with working_digits(70):
            (n, dn, _), (w, dw, _), (y, _, ddy) = map(at, (self.n, self.omega_3, self.y))
            a1, a2, b1, b2, S = (at(coefficient)[0] for coefficient in (*place.linear_system, place.S))
            residuals = [dn + a1 * n + a2 * w, dw + b1 * n + b2 * w, ddy - S * y]
            residuals += [slope + omega**2 - S for omega, slope, _ in map(at, self.omega)]
            bound = arb(10) ** -30 * (1 + abs(n) + abs(w) + abs(y))
            return all(abs(residual) < bound for residual in residuals)


def closed_form(place: Rolling) -> BallSolution:
    """The general solution of the linear equations of a ball, degenerate balls and the plane included; real on [-1, 1].

    It has sines and cosines if the assumptions make l negative; undecided symbolic parameters count as generic.  For an integer
    N = 2 rho, omega is written in the roots x1, x2.  y = D^(3/4) omega_3, except for a constant D (A1 = A3 and a = 0), whose
    power is left out: y = omega_3 = c1 + c2 x.

    Parameters
    ----------
    place : Rolling
        A `BallOnSphere`, or `InRoots`.

    Examples
    --------
    >>> from kovacic.ball.body import RollingBall
    >>> closed_form(RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/4").on_sphere(2)).n
    -5*c2/2
    >>> print(closed_form(InRoots(sp.Rational(3, 2))).omega_3)
    c1*(4*x - x1 - 3*x2)/sqrt(x - x2) + c2*(4*x - 3*x1 - x2)/sqrt(x - x1)
    """
    if isinstance(place, InRoots):
        return _solution_in_roots(place)
    rho = place.ratio
    root = sp.sqrt(place.D)
    if rho != 0 and place.leading == 0 == place.half:  # D is constant, and its powers go into c1 and c2
        y = C1 + C2 * X
        return BallSolution((sp.Integer(0), 1 / X), y, y, -C2 * place.D / rho / place.weight)
    eta, spin, omega, E = _simplest_solution(place)
    quarter = place.D ** sp.Rational(1, 4)
    if sign(place.discriminant) == 0 and place.leading != 0 and rho != 0:  # D is a square
        quarter = sp.sqrt(sp.sqrt(place.leading) * (X + place.half.subs(X, 0) / place.leading))
    if rho.is_number and (2 * rho).is_Integer and rho != 0 and len(place.roots) == 2:
        omega = _solution_in_roots(InRoots(rho)).omega
    # For rho = 1, c1 is a term of its own.
    omega_3 = sum(term / root for term in eta.args) if rho == 1 else eta / quarter**2
    return BallSolution(omega, quarter * eta, omega_3, spin / place.weight, E)


def _simplest_solution(place: Rolling) -> tuple[sp.Expr, sp.Expr, tuple[sp.Expr, ...], sp.Expr | None]:
    """eta, m R^2 A1 n, omega and E in the form that is the simplest for this ball, where D isn't constant or rho = 0."""
    D, half, leading, rho = place.D, place.half, place.leading, place.ratio
    d = place.discriminant / 4
    root, scale = sp.sqrt(D), sp.sqrt(leading)
    share = sp.factor(half / (2 * D))
    omega = share + rho * scale / root, share - rho * scale / root
    if rho == 0:
        return C1, C2 - half * C1 / root, (share,), None
    if leading == 0:  # D' is constant; zeta = -(half/rho) c2 by the first of the two equations
        eta = C1 + C2 * root
        return eta, -half * (C2 / rho + eta / root), (share, 3 * share), None
    if sign(d) == 0:  # D = l (x - x1)^2, so d xi = dx/(sqrt(l) (x - x1)); l > 0, since a double root needs A3 > A1
        linear = X + half.subs(X, 0) / leading
        omega = tuple((sp.Rational(1, 2) + power) / linear for power in (rho, -rho))
        return C1 * linear**rho + C2 * linear ** (-rho), -2 * scale * C1 * linear**rho, omega, None
    if rho == 1:
        spin = -2 * C1 * half - C2 * sp.expand(leading * D + half**2) / root
        return C1 * root + C2 * half, spin, omega, None
    if sign(leading) == -1:  # E = sqrt(d) exp(i phi)
        phi = sp.acos(half / sp.sqrt(d))
        turned = C1 * sp.cos((1 + rho) * phi) + C2 * sp.sin((1 + rho) * phi)
        return C1 * sp.cos(rho * phi) + C2 * sp.sin(rho * phi), -sp.sqrt(d) * turned / root, omega, None
    # For real roots beyond x = 1, D' is negative and so is E: its negative is as good, and positive.
    is_beyond = sign(d) == 1 and sign(half.subs(X, 0)) == -1
    direction = 1 if is_beyond else -1
    E = -half - scale * root if is_beyond else half + scale * root
    spin = direction * (C1 * E ** (1 + rho) + d * C2 * E ** (-1 - rho)) / root
    return C1 * E**rho + C2 * E ** (-rho), spin, omega, E


def _solution_in_roots(place: InRoots) -> BallSolution:
    """For an integer N, up to `_MOST_EXPANDED`, polynomials times powers of sqrt(x - x1) and sqrt(x - x2)."""
    alpha, beta = X - x1, X - x2
    rho = place.ratio
    N = sp.Abs(2 * rho)
    fourth = sp.Rational(1, 4)
    quarter = alpha**fourth * beta**fourth
    root = quarter**2
    if N.is_Integer and N <= _MOST_EXPANDED:
        # The parts of (sqrt(alpha) + sqrt(beta))^N with an even and with an odd power of sqrt(beta), over sqrt(alpha beta).
        omega = []
        omega_3 = spin = sp.Integer(0)
        constants = (C2, C1) if N == 1 else (C1, C2)  # the paper's names
        for i, c in enumerate(constants):
            k = (N - i) // 2
            P = sp.expand(sum(sp.binomial(N, 2 * j + i) * alpha ** (k - j) * beta**j for j in range(k + 1)))
            e1, e2 = -sp.Rational(i == N % 2, 2), -sp.Rational(i == 0, 2)
            power = alpha**e1 * beta**e2
            rate = e1 * beta + e2 * alpha + (1 + rho) * (alpha + beta) / 2
            omega.append((e1 + 3 * fourth) / alpha + (e2 + 3 * fourth) / beta + sp.diff(P, X) / P)
            omega_3 += c * P * power
            spin += c * power * sp.expand((alpha * beta * sp.diff(P, X) + rate * P) / rho)
        y = sum(part * quarter**3 for part in omega_3.args)
        if N == 1:
            omega.reverse()
        return BallSolution(tuple(omega), y, omega_3, spin / -place.weight)
    r, s = sp.sqrt(alpha) + sp.sqrt(beta), sp.sqrt(alpha) - sp.sqrt(beta)
    steps = rho / root, -rho / root
    if N.is_Integer:  # r' = r/(2 root), s' = -s/(2 root): omega is rational for r^N + s^N and for r^N - s^N
        quotient = (r ** (2 * rho) - s ** (2 * rho)) / (r ** (2 * rho) + s ** (2 * rho))
        steps = rho / root * quotient, rho / root / quotient
    eta = C1 * r ** (2 * rho) + C2 * r ** (-2 * rho)
    n = (C1 * r ** (2 + 2 * rho) + C2 * (x1 - x2) ** 2 * r ** (-2 - 2 * rho)) / (-2 * root * place.weight)
    omega = [(1 / alpha + 1 / beta) / 4 + step for step in steps]
    return BallSolution(tuple(omega), quarter * eta, eta / root, n)


def read_ratio(text: str) -> sp.Expr:
    """R/R1 from text: a number, or a name for all of its values.

    Raises `InputError` for 0 (a plane has no R1), for a ball that doesn't fit inside, and for a name with another meaning.
    """
    taken = {"u", "pi", "e", "nan", "inf", "oo", *(symbol.name for symbol in (X, x1, x2, A1, A3, C1, C2))}
    rho = sp.Symbol(text) if text.isidentifier() and text not in taken else exact_quantity(text, "R/R1")
    if rho == 0:
        shell = "a plane is --sphere plane, with --mass and --radius"
        raise InputError("R/R1 = 0 has no R1", hint="a plane is RollingBall(...).on_plane()", shell=shell)
    if sign(rho + 1) in (0, -1):
        raise InputError(f"the ball doesn't fit inside the sphere: R < |R1| fails, as R/R1 = {rho}")
    return rho
