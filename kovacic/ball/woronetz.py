"""Woronetz's equations for a body of revolution that rolls without slipping on a sphere, derived from its meridian.

With theta the angle between the meridians at the contact, n the spin about the common normal, kappa = 1/R1, and
    sigma = psi' - kappa h,  tau = -(sin psi - kappa f),  q = f cos psi + g sin psi,  eps = -f sin psi + g cos psi
(q and eps are the tangential and the normal coordinate of the contact point seen from the centre of mass), the angular
velocity in the frame (e_u, e_v, e_n) is (tau v', sigma u', n), the velocity of the centre of mass is -omega x rho, and
    2 Theta = K33 n^2 + 2 K23 v' n + K11 u'^2 + K22 v'^2.
The equations of motion are those of P. Woronetz (Math. Ann. 70, 1911, 410-453; first in Warsaw 1909), here with every
`L/E`, `N/G` multiplied out, so that h may vanish (see `kovacic.ball.meridian`).
Divided by u', two of them are linear in n and v' as functions of u; with omega_3 = tau sin(psi) v' + cos(psi) n in
place of v' they read
    dn/du = a1 n + a2 omega_3,   d omega_3/du = b1 n + b2 omega_3.
They contain neither the potential nor the energy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from kovacic.ball.field import Element, Quotient, Surd, base_part
from kovacic.ball.irrational import generators, settled, sign
from kovacic.ball.meridian import Meridian, Profile, U, X, as_exact, read_meridian
from kovacic.errors import InputError


@dataclass(frozen=True, slots=True)
class Body:
    """A rolling body of revolution: mass m, moments A1 = A2 and A3 about the centre of mass, and its meridian.

    `R1` is the radius of the fixed sphere: positive for rolling outside, negative for rolling inside, SymPy's `oo` for
    the plane.  All of them are SymPy expressions, rational in any symbols, or exact numbers, such as sqrt(2); units are
    any consistent ones (moments in mass * length^2).

    Raises `InputError` for anything else (floating-point numbers aren't exact), and for a number that is impossible:
    m > 0, A1 > 0, A3 > 0, A3 <= 2 A1, R1 other than 0.

    >>> m, A1, A3, R = sp.symbols("m A1 A3 R")
    >>> disk = Body(Profile(R, sp.Integer(0), edge=True), m, A1, A3, sp.oo)
    >>> disk.linear_system().b1
    R**2*m/((A3 + R**2*m)*sin(u))
    """

    profile: Profile
    m: sp.Expr
    A1: sp.Expr
    A3: sp.Expr
    R1: sp.Expr

    def __post_init__(self) -> None:
        for name in ("m", "A1", "A3"):
            object.__setattr__(self, name, settled(as_exact(getattr(self, name), name)))
        object.__setattr__(self, "R1", self.R1 if self.R1 is sp.oo else settled(as_exact(self.R1, "R1")))
        for name, value in (("m", self.m), ("A1", self.A1), ("A3", self.A3)):
            if value.is_number and sign(value) <= 0:
                raise InputError(f"there is no such body: {name} > 0 fails, as {name} = {value}")
        excess = self.A3 - 2 * self.A1
        if excess.is_number and sign(excess) > 0:
            raise InputError(f"there is no such body: A3 <= 2 A1 fails, as {self.A3} > {2 * self.A1}")
        if self.R1 == 0:
            raise InputError("the fixed surface needs a radius R1 other than 0", hint="sympy.oo is the plane")

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all parameters, sorted."""
        symbols = set().union(*(value.free_symbols for value in (self.m, self.A1, self.A3, self.R1)))
        return tuple(sorted(self.profile.parameters | {symbol.name for symbol in symbols}))

    def quantities(self) -> Quantities:
        """Everything that the equations are made of, as elements of the field."""
        given = (self.profile.f, self.profile.g, self.m, self.A1, self.A3, *(() if self.R1.is_infinite else (self.R1,)))
        meridian = read_meridian(self.profile, self.names, generators(given))
        element = meridian.ring.element
        zero = element(sp.Integer(0))
        kappa = zero if self.R1.is_infinite else 1 / element(self.R1)
        return Quantities.of(meridian, element(self.m), element(self.A1), element(self.A3), kappa)

    def linear_system(self) -> LinearSystem:
        return self.quantities().linear_system()


@dataclass(frozen=True, slots=True)
class Quantities:
    """Elements of the field: the meridian's, the body's, and the coefficients of the kinetic energy."""

    meridian: Meridian
    m: Quotient
    kappa: Quotient
    sigma: Any
    tau: Any
    q: Any
    eps: Any
    K11: Any
    K22: Any
    K23: Any
    K33: Any

    @classmethod
    def of(cls, c: Meridian, m: Quotient, A1: Quotient, A3: Quotient, kappa: Quotient) -> Quantities:
        f, g, h, cos, sin = _any(c.f, c.g, c.h, c.cos_psi, c.sin_psi)
        sigma, tau = c.turn - kappa * h, kappa * f - sin
        q, eps = f * cos + g * sin, g * cos - f * sin
        if not sigma or not tau:
            raise InputError("the body and the sphere touch along a curve (sigma or tau vanishes identically)")
        return cls(
            meridian=c,
            m=m,
            kappa=kappa,
            sigma=sigma,
            tau=tau,
            q=q,
            eps=eps,
            K11=sigma * sigma * (A1 + m * (eps * eps + q * q)),
            K22=tau * tau * (m * eps * eps + A1 * cos * cos + A3 * sin * sin),
            K23=tau * ((A3 - A1) * sin * cos - m * eps * q),
            K33=m * q * q + A1 * sin * sin + A3 * cos * cos,
        )

    def gyroscopic(self) -> tuple[Any, Any, Any, Any, Any, Any]:
        """The six coefficients of the right-hand sides, in this order:

        P = sqrt(EG)(LN/(EG) - kappa^2), Q = kappa h/tau, W = kappa f/sigma,
        Y = m eps f sigma = m eps sqrt(EG)(L/E - kappa), Z = -m eps h tau = m eps sqrt(EG)(N/G - kappa),
        X = m eps (LG - NE)/sqrt(EG).
        """
        c, k = self.meridian, self.kappa
        f, h, sin, turn = _any(c.f, c.h, c.sin_psi, c.turn)
        lever = self.m * self.eps
        P = turn * sin - h * f * k * k
        return (
            P,
            k * h / self.tau,
            k * f / self.sigma,
            lever * f * self.sigma,
            -lever * h * self.tau,
            lever * (turn * f - sin * h),
        )

    def linear_system(self) -> LinearSystem:
        """The two linear equations for (n, omega_3), from K (n, v')^T = (dTheta/dn, dTheta/dv')."""
        c = self.meridian
        D = c.derivative
        P, Q, W, Y, _, LGNE = self.gyroscopic()
        K22, K23, K33 = self.K22, self.K23, self.K33
        spin = self.m * c.h * self.q
        # d/du (K y) = M y, y = (n, v'), rows: the equations for dTheta/dn and dTheta/dv'.
        rows = (
            (spin - Q * K23, -W * self.K11 - Q * K22 - LGNE),
            (W * self.K11 + Y - P * K33, -(P * K23)),
        )
        r11, r12 = rows[0][0] - D(K33), rows[0][1] - D(K23)
        r21, r22 = rows[1][0] - D(K23), rows[1][1] - D(K22)
        det = K33 * K22 - K23 * K23
        n_n, n_v = (K22 * r11 - K23 * r21) / det, (K22 * r12 - K23 * r22) / det
        v_n, v_v = (K33 * r21 - K23 * r11) / det, (K33 * r22 - K23 * r12) / det
        # omega_3 = alpha v' + beta n
        alpha, beta = self.tau * c.sin_psi, c.cos_psi
        w_n = alpha * v_n + D(beta) + beta * n_n
        w_v = D(alpha) + alpha * v_v + beta * n_v
        return LinearSystem(c, n_n - n_v * beta / alpha, n_v / alpha, w_n - w_v * beta / alpha, w_v / alpha)


@dataclass(frozen=True, slots=True)
class LinearSystem:
    """dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3, as elements (`.elements`) or SymPy expressions."""

    meridian: Meridian
    _a1: Any
    _a2: Any
    _b1: Any
    _b2: Any

    @property
    def elements(self) -> tuple[Element, Element, Element, Element]:
        return self._a1, self._a2, self._b1, self._b2

    @property
    def a1(self) -> sp.Expr:
        return self.meridian.in_u(self._a1)

    @property
    def a2(self) -> sp.Expr:
        return self.meridian.in_u(self._a2)

    @property
    def b1(self) -> sp.Expr:
        return self.meridian.in_u(self._b1)

    @property
    def b2(self) -> sp.Expr:
        return self.meridian.in_u(self._b2)

    def second_order(self, unknown: str = "omega_3") -> SecondOrder:
        """The equation z'' + d1 z' + d2 z = 0 (' = d/du) that omega_3, or n, satisfies alone.

        Raises `InputError` where the unknown already satisfies an equation of first order by itself (b1 = 0, resp.
        a2 = 0), as omega_3 of the ball on the plane does: the other unknown has the equation of second order.
        """
        D = self.meridian.derivative
        if unknown == "omega_3":
            a1, a2, b1, b2 = self.elements
        elif unknown == "n":
            b2, b1, a2, a1 = self.elements
        else:
            raise InputError(f"the unknowns are omega_3 and n, not {unknown!r}")
        if not b1:
            raise InputError(f"{unknown} satisfies an equation of first order by itself here")
        p1, p2, p3, p4 = _any(a1, a2, b1, b2)
        rate = D(b1) / p3
        return SecondOrder(self.meridian, unknown, -(rate + p1 + p4), rate * p4 - D(b2) + p1 * p4 - p2 * p3)


@dataclass(frozen=True, slots=True)
class SecondOrder:
    """z'' + d1 z' + d2 z = 0 in u, for z = omega_3 or n."""

    meridian: Meridian
    unknown: str
    _d1: Any
    _d2: Any

    @property
    def d1(self) -> sp.Expr:
        return self.meridian.in_u(self._d1)

    @property
    def d2(self) -> sp.Expr:
        return self.meridian.in_u(self._d2)

    def rational_form(self, *, half_angle: bool = False) -> RationalEquation:
        """The same equation in x = cos u (in x = u for a profile rational in u), or in x = tan(u/2) with `half_angle`.

        The half angle serves profiles whose equation keeps sin u, such as the torus or a disk on a sphere.
        Raises `InputError` where the coefficients keep a square root: the profile doesn't allow this rational form.
        """
        d1, d2 = _any(self._d1, self._d2)
        if self.meridian.trigonometric:
            rate: Any = self.meridian.rate
            x = self.meridian.ring.element(X)
            if half_angle:
                d1, d2 = _in_half_angle(d1), _in_half_angle(d2)
                if d1 is not None and d2 is not None:
                    rate = (1 + x * x) / 2
                    return RationalEquation(self.unknown, (d1 + x) / rate, d2 / (rate * rate))
            else:
                d1, d2 = (d1 * rate - x) / (rate * rate), d2 / (rate * rate)
                d1, d2 = base_part(d1), base_part(d2)
        else:
            d1, d2 = base_part(d1), base_part(d2)
        if d1 is None or d2 is None:
            variable = "tan(u/2)" if half_angle else "cos u" if self.meridian.trigonometric else "u"
            raise InputError(
                f"the coefficients aren't rational in {variable}: the profile leaves a square root in them",
                hint=None if half_angle or not self.meridian.trigonometric else "try half_angle=True",
            )
        return RationalEquation(self.unknown, d1, d2)


def _in_half_angle(element: Any) -> Quotient | None:
    """An element a + b sin u of K1 at x = tan(u/2), or None if the square root of E is in it."""
    while isinstance(element, Surd) and element.extension.level > 1:
        if element.b:
            return None
        element = element.a
    if isinstance(element, Quotient):
        return element.at_half_angle()
    t = element.a.ring.element(X)
    return element.a.at_half_angle() + element.b.at_half_angle() * (t * 2 / (1 + t * t))  # type: ignore[no-any-return]


@dataclass(frozen=True, slots=True)
class RationalEquation:
    """z'' + d1 z' + d2 z = 0 with d1, d2 in Q(parameters)(x)."""

    unknown: str
    first: Quotient
    second: Quotient

    @property
    def d1(self) -> sp.Expr:
        return self.first.factored()

    @property
    def d2(self) -> sp.Expr:
        return self.second.factored()

    def normal_form(self) -> Quotient:
        """S of y'' = S y with z = y exp(-1/2 int d1 dx): S = d1'/2 + d1^2/4 - d2."""
        return self.first.partial() / 2 + self.first * self.first / 4 - self.second


def _any(*elements: Any) -> tuple[Any, ...]:
    """The same elements for the type checker, which can't follow mixed towers."""
    return elements


__all__ = ["Body", "LinearSystem", "Quantities", "RationalEquation", "SecondOrder", "U", "X"]
