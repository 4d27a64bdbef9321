"""The equation a y'' + b y' + c y = f, its normal form and its gauge.

With y = v exp(-1/2 int b/a dx) the homogeneous equation becomes

    v'' = S v,        S = (b/a)'/2 + (b/a)^2/4 - c/a,                                                              (1)

so the solutions y are those of the normal form times the gauge factor exp(int gamma dx) with gamma = -b/(2a), and
S = gamma^2 - gamma' - c/a.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), section 1.1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.poly import Field, Poly, joined_terms
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly
from kovacic.compatibility import cached_property
from kovacic.numbers.numerals import as_text

DEFAULT_VARIABLE = "x"

# The unknown function of y'' = S y: a variable only if the caller says so.
UNKNOWN = "y"

#: Transcendental numbers are parameters in coefficients: a claim for generic values holds for transcendental ones.
PI = "pi"
EULER = "e"

# The energy: a parameter, unless the caller says that it is the variable.
ENERGY = "E"


@dataclass(frozen=True)
class Change:
    """The variable of an equation as a function of the user's variable.

    Attributes
    ----------
    variable : str
        The user's.
    expression : str
        The function: exp(2*x).
    """

    variable: str
    expression: str

    @property
    def field(self) -> str:
        """The field whose elements count as rational: `C(exp(2*x))`.

        Kovacic's case and the group are those over it.  Over a smaller one, C(sinh(x)) within C(exp(x)), an equation of case 1
        can be one of case 2; whether there are Liouvillian solutions, and the identity component of the group, are the same.
        """
        return f"C({self.expression.replace('**', '^')})"

    def to_dict(self) -> dict[str, str]:
        """For JSON: variable, expression and field."""
        return {"variable": self.variable, "expression": self.expression, "field": self.field}

    @classmethod
    def from_dict(cls, data: Mapping[str, str]) -> Change:
        """The inverse of `to_dict`.

        Parameters
        ----------
        data : mapping
            The result of `to_dict`.
        """
        return cls(data["variable"], data["expression"])


@dataclass(frozen=True)
class Equation:
    """a y'' + b y' + c y = f + h over one field, a not zero.

    Attributes
    ----------
    a, b, c, f : RatFunc
        The coefficients, and the rational part of the right-hand side.
    h : sympy.Expr or None
        The rest of the right-hand side.
    variable, unknown : str
        The names of x and y.
    change : Change or None
        The variable as a function of the user's, for coefficients in exp(k x).  Then h is in the user's variable: the part of
        the right-hand side apart from f, divided by the coefficient of y''.

    Raises
    ------
    ValueError
        If a is zero.

    Examples
    --------
    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> bessel = Equation(x**2, x, x**2 - 1, x * 0)
    >>> print(bessel)
    x^2*y'' + x*y' + (x^2 - 1)*y = 0
    >>> print(bessel.S, "|", bessel.gauge)
    (-4*x**2 + 3)/(4*x**2) | -1/(2*x)
    """

    a: RatFunc
    b: RatFunc
    c: RatFunc
    f: RatFunc
    h: Any = None
    variable: str = "x"
    unknown: str = "y"
    change: Change | None = None

    def __post_init__(self) -> None:
        if not self.a:
            raise ValueError("the coefficient of the second derivative is zero")

    @cached_property
    def S(self) -> RatFunc:
        """The coefficient of the normal form, equation (1)."""
        r, s = self.gauge.num, self.gauge.den
        a, c = self.a, self.c
        riccati = r * r - r.derivative() * s + r * s.derivative()  # s^2 (gamma^2 - gamma')
        return lowered(RatFunc(riccati * (c.den * a.num) - s * s * (c.num * a.den), s * s * (c.den * a.num)))

    @cached_property
    def gauge(self) -> RatFunc:
        """The logarithmic derivative -b/(2a) of the gauge factor."""
        return lowered(RatFunc(-self.b.num * self.a.den, 2 * self.b.den * self.a.num))

    @property
    def is_homogeneous(self) -> bool:
        """True if the right-hand side is zero."""
        return not self.f and self.h is None

    @property
    def is_normal_form(self) -> bool:
        """True for y'' = S y itself, up to a factor."""
        return not self.b and self.is_homogeneous

    def text(self, *, caret: bool = True) -> str:
        """The equation in one line.

        Parameters
        ----------
        caret : bool
            False writes powers as in Python.  True by default.

        Examples
        --------
        >>> import kovacic
        >>> equation = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1)*y = x").equation
        >>> equation.text(), equation.text(caret=False)
        ("x^2*y'' + x*y' + (x^2 - 1)*y = x", "x**2*y'' + x*y' + (x**2 - 1)*y = x")
        """
        y = self.unknown
        products = []
        for coefficient, name in ((self.a, y + "''"), (self.b, y + "'"), (self.c, y)):
            text = _coefficient(coefficient, self.variable)
            if text in ("1", "-1"):
                products.append(text[:-1] + name)
            elif text != "0":
                products.append(f"({text})*{name}" if " " in text or "/" in text else f"{text}*{name}")
        left = " + ".join(products)
        right = [_coefficient(self.f, self.variable)] if self.f or self.h is None else []
        if self.h is not None:
            right.append(f"[a right-hand side in {self.change.variable}]" if self.change else as_text(self.h))
        line = f"{left} = {' + '.join(right)}".replace("+ -", "- ")
        return line.replace("**", "^") if caret else line

    def __str__(self) -> str:
        return self.text()


@dataclass(frozen=True, slots=True)
class Parsed:
    """S as a rational function, the name of its variable, and notices about the reading.

    `equation` is None if S itself was given.  `letters` are the parameters that stand for constants, with their meanings as
    SymPy expressions: sin_theta for sin(theta).  `guesses` are the notices about guesses.
    """

    S: RatFunc
    variable: str
    notices: tuple[str, ...] = ()
    equation: Equation | None = None
    letters: tuple[tuple[str, Any], ...] = ()
    guesses: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The input in our own spelling."""
        return self.S.to_str(self.variable) if self.equation is None else self.equation.text(caret=False)

    @property
    def reading(self) -> str:
        """The reading in one line: m*x'' + c*x' + k*x = 0, x(t), parameters m, c, k; empty after a change of variable."""
        equation = self.equation
        if equation is None:
            line = f"y'' = ({self.S.to_str(self.variable)})*y, y({self.variable})".replace("**", "^")
        elif equation.change is None:
            line = f"{equation}, {equation.unknown}({equation.variable})"
        else:
            return ""
        names = parameters_of(self.S.field)
        what = "parameter" if len(names) == 1 else "parameters"
        return f"{line}, {what} {', '.join(names)}" if names else line


def parameters_of(field: Field) -> tuple[str, ...]:
    """The names of the parameters of a coefficient field."""
    ground = field.ground
    return () if ground == QQ else ground.names  # type: ignore[attr-defined]


def _coefficient(function: RatFunc, variable: str) -> str:
    """As `to_str`, but a polynomial over Q keeps its fractions: x**2 - 1/4."""
    num = function.num
    if not function.is_polynomial or not isinstance(num, RationalPoly):
        return function.to_str(variable)
    return joined_terms(list(map(str, num.rational_coefficients())), variable)  # flint's, printed without a limit


def over(function: RatFunc, field: Field) -> RatFunc:
    """The function over a larger field."""
    return RatFunc(function.num.over(field), function.den.over(field), reduced=True)


def lowered(function: RatFunc) -> RatFunc:
    """The function over the lowest field of the tower that contains its coefficients."""
    num = function.num
    den = function.den
    while isinstance(num, ExtensionPoly) and isinstance(den, ExtensionPoly):
        if any(num.parts[1:]) or any(den.parts[1:]):
            break
        num = num.parts[0]
        den = den.parts[0]
    below: tuple[Poly, Poly] = (num, den)
    return RatFunc(*below, reduced=True)


def eliminated(matrix: tuple[tuple[Any, Any], tuple[Any, Any]], t: Any) -> tuple[Any, Any]:
    """Two linear equations of first order as one of second order: the coefficients of x' and x in SymPy, not simplified.

    `matrix` is ((a, b), (c, d)).  For x' = a x + b y, y' = c x + d y with b != 0 it is y = (x' - a x)/b, and x satisfies

        x'' - (a + d + b'/b) x' + (a d - b c - a' + a b'/b) x = 0.

    >>> from sympy.abc import t
    >>> eliminated(((t, t), (-t, 1 / t)), t)
    (-t - 2/t, t**2 + 1)
    """
    (a, b), (c, d) = matrix
    rate = b.diff(t) / b
    return -(a + d + rate), a * d - b * c - a.diff(t) + a * rate
