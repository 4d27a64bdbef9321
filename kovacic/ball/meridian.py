"""The surface of a body of revolution: its meridian, read into the field of `kovacic.ball.field`.

Symbols (lengths in any one unit, angles in radians):
    f(u), g(u)   the surface is x = f cos v, y = f sin v, z = g about the centre of mass
    h = sqrt(E)  E = f'^2 + g'^2, first fundamental form E du^2 + f^2 dv^2
    psi          the tangent's angle: f' = h cos psi, g' = h sin psi; the outward normal is (-sin psi, cos psi) in
                 the plane of the meridian
    turn         psi' = L/h, with L the coefficient of du^2 in the second fundamental form (N = f sin psi)

Every coefficient of Woronetz's equations is a polynomial in f, g, h, cos psi, sin psi, psi', 1/R1 (and in 1/sigma,
1/tau), without a division by h.  So a sharp edge, which is the limit h -> 0 with a normal that still turns, is no
exception: that is the thin disk.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from kovacic.ball.field import Element, Extension, Ring, Surd, base_part, differentiate
from kovacic.errors import InputError

#: The parameter of the meridian, and the variable of the rational equations.
U = sp.Symbol("u")
X = sp.Symbol("x")


def as_expression(value: Any, what: str) -> sp.Expr:
    """A number or a SymPy expression as the latter.  Raises `InputError` for anything else, text included."""
    try:
        expression = sp.sympify(value, strict=True)
    except sp.SympifyError:
        raise InputError(f"{what} is a number or a SymPy expression, it can't be {value!r}") from None
    if not isinstance(expression, sp.Expr):
        raise InputError(f"{what} is a number or a SymPy expression, it can't be {value!r}")
    return expression


def as_exact(value: Any, what: str) -> sp.Expr:
    """`as_expression` without floating-point numbers, infinities and complex numbers."""
    expression = as_expression(value, what)
    if expression.has(sp.Float):
        raise InputError(
            f"{what} contains a floating-point number, which isn't exact: {value}",
            hint='pass Fraction("0.4"), or sympy.Rational("0.4")',
        )
    if expression.has(sp.nan, sp.oo, -sp.oo, sp.zoo, sp.I):
        raise InputError(f"{what} is real and finite, it can't be {value}")
    return expression


@dataclass(frozen=True, slots=True)
class Profile:
    """A meridian as the user writes it: SymPy expressions f, g in `u`, rational in cos u and sin u or in u itself.

    `edge=True` means a sharp circular edge of radius f at height g (both constant), rolled on with the normal at angle
    u from the axis: the rim of a thin disk.

    >>> R, a = sp.symbols("R a")
    >>> Profile(R * sp.sin(U), R * sp.cos(U) + a).trigonometric
    True
    """

    f: sp.Expr
    g: sp.Expr
    edge: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "f", as_exact(self.f, "f(u)"))
        object.__setattr__(self, "g", as_exact(self.g, "g(u)"))

    @property
    def trigonometric(self) -> bool:
        """Whether the profile is given by cos u and sin u, so that x = cos u; otherwise x = u."""
        return self.edge or any(part.has(sp.sin, sp.cos, sp.tan) for part in (self.f, self.g))

    @property
    def parameters(self) -> set[str]:
        return {symbol.name for symbol in (self.f.free_symbols | self.g.free_symbols) if symbol.name != U.name}


@dataclass(frozen=True, slots=True)
class Meridian:
    """The data of a profile as elements of the field, and the field itself."""

    ring: Ring
    rate: Element  # dx/du
    f: Element
    g: Element
    h: Element
    cos_psi: Element
    sin_psi: Element
    turn: Element
    trigonometric: bool

    def derivative(self, element: Element) -> Any:
        return differentiate(element, self.rate)

    def in_u(self, element: Element) -> sp.Expr:
        """The element as a factored SymPy expression in u, with sin(u)^2 for (1 - cos u)(1 + cos u)."""
        if not self.trigonometric:
            return element.factored().subs(X, U)
        if isinstance(element, Surd):
            return self.in_u(element.a) + self.in_u(element.b) * element.extension.symbol
        exponents = dict(element.factors())
        k = min(exponents.get(X - 1, 0), exponents.get(X + 1, 0), key=abs)
        x = self.ring.element(X)
        for _ in range(abs(k)):
            element = element * (1 - x * x) if k < 0 else element / (1 - x * x)
        return element.factored().subs(X, sp.cos(U)) * sp.sin(U) ** (2 * k)


def read_meridian(profile: Profile, names: tuple[str, ...], constants: tuple[sp.Expr, ...] = ()) -> Meridian:
    """The meridian of a profile over Q(constants)(names)(x).

    `names` are all parameters of the problem at hand, `constants` the irrational numbers (`irrational.generators`).

    Raises `InputError` for a profile outside the field, and for a parameter called x or u.
    """
    if {X.name, U.name} & set(names):
        raise InputError("x and u are the variables of the equations, no parameter can have these names")
    ring = Ring((*names, X.name), constants)
    x = ring.element(X)
    if not profile.trigonometric:
        return _from_functions(ring, x * 0 + 1, ring.element(_at_x(profile.f)), ring.element(_at_x(profile.g)), None)
    sine = Extension(1 - x * x, sp.sin(U), 1)
    s = Surd(sine, x * 0, x * 0 + 1)
    if profile.edge:
        if profile.f.has(U) or profile.g.has(U):
            raise InputError("the edge of a disk is a circle: its radius f and height g are constants")
        zero = s * 0
        f, g = zero + ring.element(profile.f), zero + ring.element(profile.g)
        return Meridian(ring, -s, f, g, zero, zero + x, -s, zero - 1, True)
    return _from_functions(ring, -s, _trigonometric(profile.f, ring, s), _trigonometric(profile.g, ring, s), s)


def _from_functions(ring: Ring, rate: Any, f: Any, g: Any, s: Surd | None) -> Meridian:
    df, dg = differentiate(f, rate), differentiate(g, rate)
    E = df * df + dg * dg
    if not E:
        raise InputError("the profile is a point: f' = g' = 0; the rim of a thin disk is Profile(R, 0, edge=True)")
    h = _square_root(E, s)
    cos_psi, sin_psi = df / h, dg / h
    turn = (differentiate(dg, rate) * df - differentiate(df, rate) * dg) / E
    return Meridian(ring, rate, f, g, h, cos_psi, sin_psi, turn, s is not None)


def _square_root(E: Any, s: Surd | None) -> Any:
    """sqrt(E) in the field where it lies there, else the generator of a quadratic extension."""
    plain = base_part(E)
    if plain is not None:
        root = plain.square_root()
        if root is not None:
            return E * 0 + root
        if s is not None:
            root = (plain / (1 - plain.ring.element(X) * plain.ring.element(X))).square_root()
            if root is not None:
                return s * root
    extension = Extension(E, sp.sqrt(sp.factor(E.expression()).subs(X, sp.cos(U) if s is not None else U)), 2)
    return Surd(extension, E * 0, E * 0 + 1)


def _at_x(expression: sp.Expr) -> sp.Expr:
    return expression.subs(U, X)


def _trigonometric(expression: sp.Expr, ring: Ring, s: Surd) -> Any:
    """An expression in cos u and sin u as an element of K1."""
    sine = sp.Dummy("s")
    plain = sp.expand_trig(expression).replace(sp.tan, lambda z: sp.sin(z) / sp.cos(z))
    plain = plain.subs({sp.cos(U): X, sp.sin(U): sine})
    if plain.has(U):
        raise InputError(
            f"{expression} isn't rational in cos u and sin u", hint="or write the whole profile in u alone"
        )
    sides: list[Any] = []
    for side in sp.fraction(sp.together(plain)):
        value: Any = s * 0
        for coefficient in sp.Poly(side, sine).all_coeffs():
            value = value * s + ring.element(coefficient)
        sides.append(value)
    return sides[0] / sides[1]
