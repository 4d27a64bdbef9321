"""The ball with an axially symmetric mass distribution that rolls on a sphere, inside a sphere, or on a plane.

Symbols: m mass; R radius; a distance of the centre of mass from the centre along the axis; A1 = A2, A3 central moments of
inertia; R1 radius of the fixed sphere (negative: the ball rolls inside; infinite: a plane); rho = R/R1; x = cos u;
    D(x) = A1 A3 + A1 m R^2 (1 - x^2) + A3 m (R x + a)^2,  l = m R^2 (A3 - A1) its leading coefficient.
In x = cos u equation (11) becomes (12), and (13) is its normal form [Kuleshov & Katasonova 2018]:
    (12)  D omega_3'' + (3/2) D' omega_3' + l (1 - rho^2) omega_3 = 0,
    (13)  y'' = S y,  y = D^(3/4) omega_3,  S = l (1 + 2 rho^2)/(2 D) - 3 D'^2/(16 D^2).
D >= A1 A3 > 0 on [-1, 1] for a possible body: the roots x1, x2 of D, the singular points of (12), are never reached.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TypeAlias

import sympy as sp

from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import Limits
from kovacic.numbers.exact import exact_real, is_rational_number
from kovacic.reading import symbolic
from kovacic.reading.read import read_input

Quantity: TypeAlias = "int | Fraction | str | sp.Expr"
U, X, x1, x2, A1, A3 = sp.symbols("u x x1 x2 A1 A3")
#: For numbers and potentials as text: SymPy's functions are recursive, and its integers unbounded.
BALL_LIMITS = Limits(text_length=500, digits=100, exponent=100, bits=500)
read_short = partial(symbolic.read_expression, limits=BALL_LIMITS)


def exact_quantity(value: Quantity, name: str) -> sp.Expr:
    """An exact real number, or an expression in symbols, without their assumptions; text is a number ("0.25", "sqrt(2)").

    Raises `InputError` for anything else, and `LimitExceeded` for numbers of more than 500 bits.
    """
    if isinstance(value, str):
        result = read_short(value, what=f"the number {name}", names={})
    elif is_rational_number(value):
        result = sp.Rational(exact_real(value, name))
    elif isinstance(value, sp.Expr) and not value.has(sp.Float):
        result = value.xreplace({symbol: sp.Symbol(symbol.name) for symbol in value.free_symbols})
    else:
        raise InputError(
            f"{name} = {value!r} isn't an exact number or a SymPy expression",
            hint='a floating-point number decides nothing here: pass Fraction("0.4") or the text "0.4"',
        )
    if result.is_number and not (result.is_real and result.is_finite):
        raise InputError(f"{name} = {result} isn't a real number")
    if {U, X} & result.free_symbols:
        raise InputError(f"{name} = {result}: x and u are the variables of the equations, no parameter has these names")
    result = in_lowest_form(result)
    if result.is_Rational and max(int(result.p).bit_length(), int(result.q).bit_length()) > BALL_LIMITS.bits:
        raise LimitExceeded(f"{name} has more than {BALL_LIMITS.bits} bits, the limit", limit="bits")
    return result


def in_lowest_form(value: sp.Expr) -> sp.Expr:
    """A rational number if the value is one, decided in the engine's field of algebraic numbers; else the value itself."""
    if not value.is_number or value.is_Rational:
        return value
    try:
        constant = read_input(value).S.num
    except NotRational:
        return value
    rational = constant.field.rational_value(constant)
    return sp.sqrtdenest(value) if rational is None else sp.Rational(rational.numerator, rational.denominator)


def sign(value: sp.Expr) -> int | None:
    """1, 0 or -1; None for an expression with symbols.

    Raises `InputError` for a number that isn't algebraic and can't be told from zero.
    """
    value = in_lowest_form(value)
    if not value.is_number:
        return None
    if value.is_Rational:
        return int(sp.sign(value))
    # An algebraic number isn't zero, since it isn't rational: more digits tell its sign in the end.
    digits = sp.N(value, 15, maxn=10_000 if value.is_algebraic else 60)
    if not digits.is_Float or digits._prec <= 1:
        raise InputError(f"it can't be decided whether {value} is zero", hint="take algebraic numbers, such as sqrt(2)")
    return 1 if digits > 0 else -1


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingBall:
    """A dynamically symmetric ball, in any consistent units.

    Parameters
    ----------
    m, R, a, A1, A3 : number, str or sympy.Expr
        Mass; radius; distance of the centre of mass from the centre, along the axis; central moments of inertia, A1 = A2
        across the axis and A3 about it.  Exact numbers, text such as "1/5" or "sqrt(2)", or symbols.

    Raises
    ------
    InputError
        For a body that provably can't exist, with the inequality that fails: m > 0, R > 0, A1 > 0, A3 > 0, A3 <= 2 A1 (which
        is int z^2 dm >= 0), and A1 + A3/2 <= m (R^2 - a^2), which holds exactly when some mass distribution within the ball
        has these moments and this centre of mass.

    Examples
    --------
    >>> body = RollingBall(m=1, R=2, a=0, A1=2, A3=1)
    >>> body.on_sphere(R1=3).ratio, body.on_sphere(R1=-5).ratio, body.on_plane().ratio
    (2/3, -2/5, 0)
    >>> RollingBall(m=1, R=1, a=0, A1="1/5", A3="1/2")
    Traceback (most recent call last):
    kovacic.errors.InputError: there is no such body: A3 <= 2 A1 fails, as 1/2 > 2/5
    """

    m: Quantity
    R: Quantity
    a: Quantity
    A1: Quantity
    A3: Quantity

    def __post_init__(self) -> None:
        for name, given in zip(self.__slots__, self.parameters, strict=True):
            value = exact_quantity(given, name)
            object.__setattr__(self, name, value)
            if name != "a" and sign(value) in (0, -1):
                raise InputError(f"there is no such body: {name} > 0 fails, as {name} = {value}")
        m, R, a, A1, A3 = self.parameters
        for text, small, large in (
            ("|a| <= R", sp.Abs(a), R),
            ("A3 <= 2 A1", A3, 2 * A1),
            ("A1 + A3/2 <= m (R^2 - a^2)", A1 + A3 / 2, m * (R**2 - a**2)),
        ):
            if sign(small - large) == 1:
                raise InputError(f"there is no such body: {text} fails, as {small} > {large}")
        if sign(A3 - A1) == 0:  # l is 0 then, however the two are written
            object.__setattr__(self, "A3", A1)

    @property
    def parameters(self) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
        """(m, R, a, A1, A3) as SymPy expressions."""
        return self.m, self.R, self.a, self.A1, self.A3

    def on_sphere(self, R1: Quantity) -> BallOnSphere:
        """The ball on a sphere, or inside one; raises `InputError` for a ball that doesn't fit inside.

        Parameters
        ----------
        R1 : number, str or sympy.Expr
            The radius: R1 > 0, or R1 < -R for a ball inside of it.
        """
        radius = exact_quantity(R1, "R1")
        if radius == 0:
            hint, shell = "the plane is R1 = infinity: on_plane()", "the plane is --sphere plane"
            raise InputError("the fixed sphere needs a radius R1 other than 0", hint=hint, shell=shell)
        if sign(radius) == -1 and sign(self.R + radius) in (0, 1):
            raise InputError(f"the ball doesn't fit inside the sphere: R < |R1| fails, as {self.R} >= {-radius}")
        return self._rolling(radius)

    def on_plane(self) -> BallOnSphere:
        """The ball on a plane: R1 -> infinity, R/R1 = 0."""
        return self._rolling(sp.oo)

    def _rolling(self, R1: sp.Expr) -> BallOnSphere:
        m, R, a, A1, A3 = self.parameters
        ratio = in_lowest_form(sp.cancel(R / R1))
        D = sp.expand(A1 * A3 + A1 * m * R**2 * (1 - X**2) + A3 * m * (R * X + a) ** 2)
        return BallOnSphere(ratio, D, sp.factor(m * R**2 * (A3 - A1)), m * R**2 * A1, self, R1)


@dataclass(frozen=True, slots=True)
class Rolling:
    """The data of the linear equations; `BallOnSphere` describes each."""

    ratio: sp.Expr
    D: sp.Expr
    leading: sp.Expr
    weight: sp.Expr

    @property
    def half(self) -> sp.Expr:
        """D'(x)/2."""
        return sp.expand(sp.diff(self.D, X) / 2)

    @property
    def discriminant(self) -> sp.Expr:
        """The discriminant of D; 0 for a double root, x1 = x2."""
        return in_lowest_form(sp.factor(4 * (self.half**2 - self.leading * self.D)))

    @property
    def roots(self) -> tuple[sp.Expr, ...]:
        """x1, x2; one root if D is linear or a square, none if D is constant."""
        return tuple(sp.roots(sp.Poly(self.D, X)))

    @property
    def linear_system(self) -> tuple[sp.Expr, ...]:
        """a1, a2, b1, b2 divided by sin u, in x: dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3."""
        half, rho, weight = self.half, self.ratio, self.weight
        across = sp.expand(self.leading * self.D - half**2) / weight
        parts = -rho * half, (1 + rho) * across, rho * weight, (1 + rho) * half
        return tuple(sp.factor(part / self.D) for part in parts)

    @property
    def second_order(self) -> tuple[sp.Expr, sp.Expr]:
        """d1, d2 of (12), omega_3'' + d1 omega_3' + d2 omega_3 = 0 with ' = d/dx.

        On the plane, the limit R1 -> infinity: a solution is an omega_3 only if omega_3 sqrt(D) is constant.
        """
        return sp.factor(3 * self.half / self.D), (1 - self.ratio**2) * sp.factor(self.leading / self.D)

    @property
    def S(self) -> sp.Expr:
        """S of (13), y'' = S(x) y."""
        return sp.factor((2 * self.leading * (1 + 2 * self.ratio**2) * self.D - 3 * self.half**2) / (4 * self.D**2))


class InRoots(Rolling):
    """All balls with R/R1 = rho, a SymPy expression, and different roots x1, x2 of D: D/l = (x - x1)(x - x2).

    The only other parameter of the body in the equations is A3/A1.
    """

    def __init__(self, rho: sp.Expr) -> None:
        super().__init__(rho, (X - x1) * (X - x2), sp.Integer(1), -A1 / (A1 - A3))

    @property
    def S(self) -> sp.Expr:
        """S of (13), y'' = S(x) y, as the paper prints it."""
        pole = sp.Rational(1, 8) * (1 + 8 * self.ratio**2) / (x1 - x2)
        return pole / (X - x1) - pole / (X - x2) - sp.Rational(3, 16) * ((X - x1) ** -2 + (X - x2) ** -2)


@dataclass(frozen=True, slots=True)
class BallOnSphere(Rolling):
    """A ball on the sphere of radius R1; `RollingBall.on_sphere` makes it.

    Attributes
    ----------
    ratio, D, leading, weight : sympy.Expr
        rho = R/R1, 0 on the plane; D(x), x = cos u; its leading coefficient l, 0 exactly if A1 = A3; m R^2 A1.
    ball : RollingBall
        The body.
    R1 : sympy.Expr
        The radius of the sphere; infinite for the plane.

    Examples
    --------
    >>> place = RollingBall(m=1, R=2, a="1/5", A1=1, A3="4/3").on_sphere(3)
    >>> place.kind, place.ratio
    ('D has two simple roots, a complex conjugate pair', 2/3)
    """

    ball: RollingBall
    R1: sp.Expr

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle y'' = {sp.latex(self.S)}\, y$"

    @property
    def kind(self) -> str:
        """The kind of the ball, in words; undecided symbolic parameters count as generic."""
        is_centred = self.ball.a == 0
        if self.leading == 0:
            return "A1 = A3 and a = 0 (homogeneous): D is constant" if is_centred else "A1 = A3: D is linear in x"
        kinds = {
            None: "generic: D has two simple roots",
            0: "D has a double root, x1 = x2",
            1: "D has two simple roots, real, outside of [-1, 1]",
            -1: "D has two simple roots, a complex conjugate pair",
        }
        return kinds[sign(self.discriminant)] + ", with a = 0" * is_centred
