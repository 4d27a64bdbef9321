"""Immutable rational functions of one variable over an exact field."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from kovacic.algebra.poly import Field, Immutable, Poly, Scalar, quotient_str
from kovacic.limits import check_time


class RatFunc(Immutable):
    """`num/den` in lowest terms, den monic; arithmetic with `+ - * / **`, polynomials and scalars.

    Immutable and hashable; equal exactly where the functions are.  `sympy.sympify` takes it, and a notebook shows the formula.

    Attributes
    ----------
    num, den : Poly
        Numerator and denominator, coprime.

    Raises
    ------
    ZeroDivisionError
        For a zero denominator.

    Examples
    --------
    >>> import kovacic
    >>> S = kovacic.solve("(x^2 - 1)/(2*x)").S
    >>> print(S, S.degree, S(3), S.derivative())
    (x**2 - 1)/(2*x) 1 4/3 (x**2 + 1)/(2*x**2)
    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> print((x**2 - 1) / (2 * x - 2))
    (x + 1)/2
    """

    __slots__ = ("den", "num")

    num: Poly
    den: Poly

    def __init__(self, num: Poly, den: Poly | None = None, *, reduced: bool = False) -> None:
        """`num/den`; `reduced=True` promises that they are coprime and den is monic."""
        if den is None:
            num, den = num, num.field.one
        elif not reduced:
            if not den:
                raise ZeroDivisionError("the denominator is zero")
            if num.field is not den.field and num.field != den.field:
                num, den = (num, num.field.embed(den)) if num.field.extends(den.field) else (den.field.embed(num), den)
            if den.degree > 0:
                check_time()
                common = num.gcd(den)
                if common.degree > 0:
                    num = num // common
                    den = den // common
            if not den.is_monic:
                leading = den.lc.inverse()
                num = num * leading
                den = den * leading
        object.__setattr__(self, "num", num)
        object.__setattr__(self, "den", den)

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(RatFunc, reduced=True), (self.num, self.den)

    @property
    def field(self) -> Field:
        """The field of the coefficients: Q, Q(t), or one with an algebraic constant."""
        return self.num.field

    @property
    def is_polynomial(self) -> bool:
        """True if the denominator is 1."""
        return self.den.degree == 0

    @property
    def degree(self) -> int:
        """Degree of the numerator less that of the denominator: the order of growth at infinity.  Meaningless for 0."""
        return self.num.degree - self.den.degree

    @property
    def multiplicities(self) -> list[tuple[Poly, int]]:
        """The monic irreducible factors with their multiplicities, negative in the denominator."""
        return [*self.field.factor(self.num), *((p, -k) for p, k in self.field.factor(self.den))]

    def _coerce(self, other: object) -> RatFunc | None:
        if isinstance(other, RatFunc):
            return other
        if isinstance(other, Poly):
            return RatFunc(other)
        if isinstance(other, (int, Fraction)):
            return RatFunc(self.field.poly([other]))
        return None

    def __neg__(self) -> RatFunc:
        return RatFunc(-self.num, self.den, reduced=True)

    def __add__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        value = self._coerce(other)
        if value is None:
            return NotImplemented
        if self.den == value.den:
            return RatFunc(self.num + value.num, self.den)
        return RatFunc(self.num * value.den + value.num * self.den, self.den * value.den)

    __radd__ = __add__

    def __sub__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        return self + -other

    def __rsub__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        return -self + other

    def __mul__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        value = self._coerce(other)
        return NotImplemented if value is None else RatFunc(self.num * value.num, self.den * value.den)

    __rmul__ = __mul__

    def __truediv__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        value = self._coerce(other)
        return NotImplemented if value is None else RatFunc(self.num * value.den, self.den * value.num)

    def __rtruediv__(self, other: RatFunc | Poly | Scalar) -> RatFunc:
        value = self._coerce(other)
        return NotImplemented if value is None else value / self

    def __pow__(self, exponent: int) -> RatFunc:
        if exponent >= 0:
            return RatFunc(self.num**exponent, self.den**exponent, reduced=True)
        return RatFunc(self.den ** (-exponent), self.num ** (-exponent))

    def __eq__(self, other: object) -> bool:
        value = self._coerce(other)
        return value is not None and self.num == value.num and self.den == value.den

    def __hash__(self) -> int:
        return hash((self.num, self.den))

    def __bool__(self) -> bool:
        return bool(self.num)

    def __call__(self, point: RatFunc | Poly | Scalar) -> RatFunc:
        """The value at a point, or the composition with a rational function.  Raises ZeroDivisionError at a pole."""
        if isinstance(point, RatFunc) and point.is_polynomial:
            point = point.num
        if not isinstance(point, RatFunc):
            return RatFunc(self.num(point), self.den(point))
        top = max(self.num.degree, self.den.degree)
        return RatFunc(_homogenise(self.num, point, top), _homogenise(self.den, point, top))

    def derivative(self) -> RatFunc:
        """The derivative by the variable."""
        num = self.num
        den = self.den
        if den.degree == 0:
            return RatFunc(num.derivative(), den, reduced=True)
        common = den.gcd(den.derivative())
        radical = den // common
        return RatFunc(num.derivative() * radical - num * (den.derivative() // common), den * radical)

    def to_str(self, variable: str = "x") -> str:
        """Python/SymPy syntax with integer coefficients.

        Parameters
        ----------
        variable : str
            The name of the variable, "x" by default.
        """
        return quotient_str(self.num, self.den, variable)

    def _sympy_(self) -> Any:
        """For `sympy.sympify`: in the symbols that `str` prints."""
        from sympy import Symbol

        num, den = self.cleared()
        return num.to_sympy(Symbol("x")) / den.to_sympy(Symbol("x"))

    def to_sympy(self, variable: Any) -> Any:
        """The function as a SymPy expression.

        Parameters
        ----------
        variable : sympy.Symbol
            Stands for the variable; parameters are symbols of the names that `to_str` prints.

        Returns
        -------
        sympy.Expr
            Numerator over denominator.

        Examples
        --------
        >>> import kovacic, sympy
        >>> kovacic.solve("x/(x^2 + a)").S.to_sympy(sympy.Symbol("t"))
        t/(a + t**2)
        """
        return self.num.to_sympy(variable) / self.den.to_sympy(variable)

    def cleared(self) -> tuple[Poly, Poly]:
        """Numerator and denominator without denominators and common factors in their coefficients."""
        return self.field.ground.cleared(self.num, self.den)

    def __str__(self) -> str:
        return self.to_str()

    def __repr__(self) -> str:
        return f"<RatFunc {self.to_str()}>"

    def _repr_latex_(self) -> str:
        from sympy import latex

        return f"${latex(self._sympy_())}$"


def _homogenise(polynomial: Poly, point: RatFunc, degree: int) -> Poly:
    """`den(point)**degree * polynomial(point)`."""
    result: Poly = polynomial.field.zero
    power: Poly = polynomial.field.one
    for k in range(degree, -1, -1):
        result = result * point.num + polynomial[k] * power
        power = power * point.den
    return result


def over_one_denominator(functions: Sequence[RatFunc]) -> list[Poly]:
    """The numerators over the least common multiple of the denominators."""
    common = functions[0].den
    for f in functions[1:]:
        common = common * (f.den // common.gcd(f.den))
    return [f.num * (common // f.den) for f in functions]


def logarithmic_derivative(polynomial: Poly) -> RatFunc:
    return RatFunc(polynomial.derivative(), polynomial)
