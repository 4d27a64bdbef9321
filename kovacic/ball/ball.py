"""The ball with an axially symmetric mass distribution that rolls on a sphere, inside a sphere, or on a plane.

Symbols: m mass; R radius; a distance of the centre of mass from the centre along the axis; A1 = A2, A3 central moments of
inertia; R1 radius of the fixed sphere (negative: the ball rolls inside; infinite: a plane); rho = R/R1; x = cos u;
    D(x) = A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2,  l = m R^2 (A3 - A1) its leading coefficient.
Equation (11) has the second-order form in u, (12) in x, (13) is the normal form y'' = S y [Kuleshov & Katasonova 2018].

The linear equations have an integrating variable: with `xi = int dx/sqrt(D)`, `omega_3 = eta/sqrt(D)` and
`zeta = m R^2 A1 n + D'(x) omega_3/2` they are, for every ball, every sphere and the plane (rho = 0),
    d eta/d xi = -rho zeta,   d zeta/d xi = -rho l eta,
so that (the theorem of the paper, its degenerate cases included)
    eta'' = rho^2 l eta,   tanh(sqrt(l) (xi - xi0)/2) = sqrt(l) (x - x0)/(sqrt(D) + sqrt(D0)).
`kovacic.ball.theorems` proves this from the derived equations.

D > 0 on [-1, 1] for a possible body, since it is at least A1 A3: the singular points x1, x2 of (12) are never reached.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import sympy as sp

from kovacic.ball.irrational import settled, sign
from kovacic.ball.meridian import Profile, U, X
from kovacic.ball.reading import LIMITS, read_expression
from kovacic.ball.woronetz import Body, LinearSystem, RationalEquation, SecondOrder
from kovacic.errors import InputError, LimitExceeded

Scalar: TypeAlias = "int | Fraction | str | sp.Expr"
_KAPPA = sp.Symbol("kappa")


def exact(value: Scalar, name: str) -> sp.Expr:
    """An exact real number, or an expression in symbols; text is read as a number ("3/2", "0.25", "sqrt(2)").

    Symbols lose their assumptions, for the equations identify them by name.
    Raises `InputError` for anything else, and `LimitExceeded` for numbers of more than 500 bits.

    >>> exact("0.25", "m")
    1/4
    """
    if isinstance(value, str):
        result = read_expression(value, what=f"the number {name}", names={})
    elif isinstance(value, Fraction | int) and not isinstance(value, bool):
        result = sp.Rational(value)
    elif isinstance(value, sp.Expr) and not value.has(sp.Float):
        result = value.xreplace({symbol: sp.Symbol(symbol.name) for symbol in value.free_symbols})
    else:
        raise InputError(
            f"{name} = {value!r} isn't an exact number or a SymPy expression",
            hint='a floating-point number decides nothing here: pass Fraction("0.4") or the text "0.4"',
        )
    if result.is_number and not (result.is_real and result.is_finite):
        raise InputError(f"{name} = {result} isn't a real number")
    result = settled(result)
    if result.is_Rational and max(int(result.p).bit_length(), int(result.q).bit_length()) > LIMITS.bits:
        raise LimitExceeded(f"{name} has more than {LIMITS.bits} bits, the limit", limit="bits")
    return result


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball:
    """A ball of mass m and radius R with central moments A1 = A2, A3 and its centre of mass off centre by a.

    Units: any consistent ones, moments in mass * length^2.  Parameters are exact numbers or symbols; whatever can be
    decided about them is: a body that can't exist raises `InputError` with the inequality that fails, namely m > 0,
    R > 0, A1 > 0, A3 > 0, A3 <= 2 A1 (which is int z^2 dm >= 0), and A1 + A3/2 <= m (R^2 - a^2), which holds exactly
    when some mass distribution within the ball has these moments and this centre of mass.

    >>> Ball(m=1, R=2, a=0, A1=2, A3=1).on_sphere(R1=3).ratio
    2/3
    >>> Ball(m=1, R=1, a=0, A1="1/5", A3="1/2")
    Traceback (most recent call last):
    kovacic.errors.InputError: there is no such body: A3 <= 2 A1 fails, as 1/2 > 2/5
    """

    m: Scalar
    R: Scalar
    a: Scalar
    A1: Scalar
    A3: Scalar

    def __post_init__(self) -> None:
        for name in ("m", "R", "a", "A1", "A3"):
            object.__setattr__(self, name, exact(getattr(self, name), name))
        m, R, a, A1, A3 = self.parameters
        for name, value in (("m", m), ("R", R), ("A1", A1), ("A3", A3)):
            if value.is_number and sign(value) <= 0:
                raise InputError(f"there is no such body: {name} > 0 fails, as {name} = {value}")
        for text, small, large in (
            ("|a| <= R", sp.Abs(a), R),
            ("A3 <= 2 A1", A3, 2 * A1),
            ("A1 + A3/2 <= m (R^2 - a^2)", A1 + A3 / 2, m * (R**2 - a**2)),
        ):
            if (small - large).is_number and sign(small - large) > 0:
                raise InputError(f"there is no such body: {text} fails, as {small} > {large}")
        if (A3 - A1).is_number and sign(A3 - A1) == 0:
            object.__setattr__(self, "A3", A1)  # however they are written

    @property
    def parameters(self) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
        """(m, R, a, A1, A3) as SymPy expressions."""
        return self.m, self.R, self.a, self.A1, self.A3

    def on_sphere(self, R1: Scalar) -> BallOnSphere:
        """The ball on a sphere of radius R1 > 0, or inside one for R1 < -R.

        Raises `InputError` for R1 = 0 and for a ball too large to roll inside.
        """
        radius = exact(R1, "R1")
        if radius == 0:
            raise InputError("the fixed sphere needs a radius R1 other than 0", hint="on_plane() is R1 = infinity")
        if radius.is_number and radius < 0 and (self.R + radius).is_number and sign(self.R + radius) >= 0:
            raise InputError(f"the ball doesn't fit inside the sphere: R < |R1| fails, as {self.R} >= {-radius}")
        return BallOnSphere(self, radius)

    def on_plane(self) -> BallOnSphere:
        """The ball on a plane, R1 -> infinity."""
        return BallOnSphere(self, sp.oo)


@dataclass(frozen=True, slots=True)
class BallOnSphere:
    """The ball on the sphere of radius R1: its equations, each of them derived, and what they depend on."""

    ball: Ball
    R1: sp.Expr

    @property
    def ratio(self) -> sp.Expr:
        """rho = R/R1, 0 on the plane."""
        return sp.Integer(0) if self.R1.is_infinite else settled(sp.cancel(self.ball.R / self.R1))

    @property
    def body(self) -> Body:
        """The ball as a body of revolution, f = R sin u, g = R cos u + a."""
        m, R, a, A1, A3 = self.ball.parameters
        return Body(Profile(R * sp.sin(U), R * sp.cos(U) + a), m, A1, A3, self.R1)

    @property
    def D(self) -> sp.Expr:
        """D(x), expanded in x."""
        m, R, a, A1, A3 = self.ball.parameters
        return sp.expand(A1 * A3 + A1 * m * R**2 * (1 - X**2) + A3 * m * (R * X + a) ** 2)

    @property
    def leading(self) -> sp.Expr:
        """l = m R^2 (A3 - A1), the coefficient of x^2 in D; 0 exactly if A1 = A3."""
        m, R, _, A1, A3 = self.ball.parameters
        return sp.factor(m * R**2 * (A3 - A1))

    @property
    def discriminant(self) -> sp.Expr:
        """The discriminant of D, -4 m R^2 A1 B with B = (A3 + m R^2)(A3 - A1) - A3 m a^2; 0: a double root."""
        m, R, a, A1, A3 = self.ball.parameters
        result = sp.factor(-4 * m * R**2 * A1 * ((A3 + m * R**2) * (A3 - A1) - A3 * m * a**2))
        return sp.Integer(0) if result.is_number and sign(result) == 0 else result

    @property
    def roots(self) -> tuple[sp.Expr, ...]:
        """x1, x2; one root if D is linear or a square, none if D is constant."""
        return tuple(sp.roots(sp.Poly(self.D, X)))

    @property
    def kind(self) -> str:
        """Which ball this is, in words; undecided symbolic parameters count as generic."""
        if self.leading == 0:
            return "A1 = A3 and a = 0 (homogeneous): D is constant" if self.ball.a == 0 else "A1 = A3: D is linear in x"
        if self.discriminant == 0:
            return "D has a double root"
        if not self.discriminant.is_number:
            return "generic: D has two simple roots"
        place = "real, outside of [-1, 1]" if sign(self.discriminant) > 0 else "a complex conjugate pair"
        return f"D has two simple roots, {place}" + (", with a = 0" if self.ball.a == 0 else "")

    def linear_system(self) -> LinearSystem:
        """dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3."""
        return self.body.linear_system()

    def second_order(self) -> SecondOrder:
        """Equation (11); on the plane, where omega_3 sqrt(D) is constant, the limit that (11) has for R1 -> infinity.

        (Every omega_3 satisfies the limit, but not every solution of the limit is an omega_3: see `linear_system`.)
        """
        return self._at_curvature().linear_system().second_order()

    def _at_curvature(self) -> Body:
        body = self.body
        return Body(body.profile, body.m, body.A1, body.A3, 1 / _KAPPA) if self.R1.is_infinite else body

    def rational_form(self) -> RationalEquation:
        """Equation (12), omega_3'' + d1 omega_3' + d2 omega_3 = 0 with ' = d/dx."""
        equation = self.second_order().rational_form()
        if not self.R1.is_infinite:
            return equation
        element = equation.first.ring.element
        flat = (part.factored().subs(_KAPPA, 0) for part in (equation.first, equation.second))
        return RationalEquation(equation.unknown, *(element(part) for part in flat))

    @property
    def S(self) -> sp.Expr:
        """The right-hand side of (13), y'' = S(x) y."""
        return self.rational_form().normal_form().factored()

    def equation(self, number: int) -> Equation:
        """The paper's equation (7), (11), (12) or (13), derived for this ball; `.latex()` prints it.

        (7) stands for the two linear equations for n(u) and omega_3(u).

        >>> print(Ball(m=1, R=1, a=0, A1="1/4", A3="1/3").on_sphere(2).equation(12).text())
        omega_3''(x) + 3*x/(x**2 + 4)*omega_3'(x) + 3/(4*(x**2 + 4))*omega_3(x) = 0
        """
        if number == 7:
            system = self.linear_system()
            return Equation(7, U, (system.a1, system.a2, system.b1, system.b2))
        if number == 11:
            flat = self.second_order()
            d1, d2 = (part.subs(_KAPPA, 0) for part in (flat.d1, flat.d2))
            return Equation(11, U, (d1, d2))
        if number == 12:
            equation = self.rational_form()
            return Equation(12, X, (equation.d1, equation.d2))
        if number == 13:
            return Equation(13, X, (self.S,))
        raise InputError(f"there is no equation ({number}) here", hint="the equations are 7, 11, 12 and 13")


@dataclass(frozen=True, slots=True)
class Equation:
    """One of the paper's equations with its coefficients: (a1, a2, b1, b2), (d1, d2), (d1, d2) or (S,)."""

    number: int
    variable: sp.Symbol
    coefficients: tuple[sp.Expr, ...]

    def latex(self) -> str:
        """The equation in LaTeX, without delimiters."""
        z = r"\omega_{3}"
        t = [r"\left(" + sp.latex(c) + r"\right)" for c in self.coefficients]
        if self.number == 7:
            lines = (f"n' &= {t[0]} n + {t[1]} {z}", rf"{z}' &= {t[2]} n + {t[3]} {z}")
            return r"\begin{aligned}" + r" \\ ".join(lines) + r"\end{aligned}"
        if self.number == 13:
            return f"y'' = {t[0]} y"
        return f"{z}'' + {t[0]} {z}' + {t[1]} {z} = 0"

    def text(self) -> str:
        """The equation in plain text."""
        c, v = [_bracketed(part) for part in self.coefficients], self.variable
        if self.number == 7:
            return f"n'({v}) = {c[0]}*n + {c[1]}*omega_3\nomega_3'({v}) = {c[2]}*n + {c[3]}*omega_3"
        if self.number == 13:
            return f"y''({v}) = {c[0]}*y({v})"
        return f"omega_3''({v}) + {c[0]}*omega_3'({v}) + {c[1]}*omega_3({v}) = 0"


def _bracketed(expression: sp.Expr) -> str:
    text = str(expression)
    return f"({text})" if expression.is_Add or text.startswith("-") else text


def ball_with_roots() -> BallOnSphere:
    """The general ball in terms of the roots x1, x2 of D instead of m and a, to print (12) and (13) as the paper does.

    D = l (x - x1)(x - x2) fixes a and m rationally: a = -R (A3 - A1)(x1 + x2)/(2 A3), and the product of the roots is
    linear in 1/m.
    """
    R, R1, A1, A3, x1, x2 = sp.symbols("R R1 A1 A3 x1 x2")
    a = -R * (A3 - A1) * (x1 + x2) / (2 * A3)
    m = A1 * A3 / (R**2 * (A3 - A1) * x1 * x2 - A1 * R**2 - A3 * a**2)
    return Ball(m=m, R=R, a=a, A1=A1, A3=A3).on_sphere(R1)
