"""Numerical values of solutions as enclosures: one point, many points, complex paths, any number of digits.

The guarantee: the exact value of the solution (in its homotopy class of paths) lies in the returned ball.  The radius is at
most 10^-digits relative to the value, unless the problem forbids it (a value that is zero or can't be told from zero, numbers
that are balls themselves, a limit that was reached); then the ball is wide and an `AccuracyWarning` says why.

Two independent routes: "taylor" (the equation itself, every S) and "closed form" (the certificate of a decision, solutions of
case 1; or FLINT's special functions, where S is a pull-back of their equations).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Set
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Unpack, overload

from kovacic.answer import Answer
from kovacic.enclosure.ball import Ball
from kovacic.enclosure.precision import AccuracyWarning
from kovacic.enclosure.request import Keywords, Params, Request, Start, fields_of, number_of_digits
from kovacic.enclosure.states import question_of
from kovacic.errors import InputError, NotRational, warn_user
from kovacic.limits import Limits, limited, limits_of
from kovacic.reading.names import words_among
from kovacic.reading.source import source_of

OnePoint = str | complex | Fraction | Decimal | Ball
ManyPoints = list[Any] | tuple[Any, ...] | range


@overload
def evaluate(
    equation: object, x: OnePoint, *, derivative: Literal[False] = ..., **keywords: Unpack[Keywords]
) -> Ball: ...
@overload
def evaluate(
    equation: object, x: OnePoint, *, derivative: Literal[True], **keywords: Unpack[Keywords]
) -> tuple[Ball, Ball]: ...
@overload
def evaluate(
    equation: object, x: ManyPoints, *, derivative: Literal[False] = ..., **keywords: Unpack[Keywords]
) -> tuple[Ball, ...]: ...
@overload
def evaluate(
    equation: object, x: ManyPoints, *, derivative: Literal[True], **keywords: Unpack[Keywords]
) -> tuple[tuple[Ball, Ball], ...]: ...
@overload
def evaluate(equation: object, x: object, *, derivative: bool = ..., **keywords: Unpack[Keywords]) -> Any: ...
@limited
def evaluate(equation: object, x: object, *, derivative: bool = False, **keywords: Unpack[Keywords]) -> Any:
    """A ball that contains y(x) for one solution y of the equation, given by its start at x0.

    Numbers are exact: int, Fraction, float and complex (their binary values), Decimal and decimal text, mpmath and SymPy
    numbers; or constants such as "sqrt(2)" and "1 + 2*I"; or balls (ours, python-flint's, mpmath's), and then the result
    holds for every number in them.

    Parameters
    ----------
    equation
        S of y'' = S y (text, SymPy expression, rational function, or a pair of coefficient lists from low to high), an equation
        a y'' + b y' + c y = f, or a solution of this package.  All of them may have exp, log, sqrt, sin, tan, erf, ... in
        them: then with y0 and dy0, by Taylor's method, where b/a, c/a and f/a are analytic along the path; at the ends of a
        line they need a value only, as sqrt(x) at 0.  With algebraic constants the start is at a regular point.
    x : number, sequence or array
        The point or points: a number, a sequence of numbers, or a NumPy array.
    derivative : bool
        With True pairs (y, y') of balls come back.  False by default.
    initial : Start
        The solution: `Start` describes its fields, x0, y0, dy0, which and frobenius, which are keywords here as well.
    accuracy : Accuracy
        The accuracy; the fields of `Accuracy`, digits, method and limits, are keywords as well.
    path : str or sequence of numbers
        By default the straight line from x0 to each x (from infinity: along the line through 0); through a singular point it
        is refused.  "above" or "below" says on which side of the real axis to go around; [v1, v2, ...] goes through these
        vertices first; "chain" visits the points of x one after the other.  At x0 the logarithm is the principal one.
    params : mapping
        Values of the parameters by name: {"n": "sqrt(2)"}; then the start is at a regular point.
    var : str
        The name of the variable, where the equation is text or a SymPy expression; by default as for `kovacic.solve`.

    Returns
    -------
    Ball, tuple or array
        A tuple for a sequence, in the same order; an array of balls of the same shape for an array (NaN stays NaN, masked
        points stay masked).

    Raises
    ------
    InputError
        A singular point or branch cut at an end or on the path, with its place; an irregular one as the start; digits out of
        range; a number that isn't finite; an unknown method.
    LimitExceeded
        If the limits don't suffice for any enclosure.

    Warns
    -----
    AccuracyWarning
        Where the ball is wider than requested, with the reason.

    Examples
    --------
    With initial values, from a singular point, and around one:

    >>> airy = ([0, 1], [1])                                     # y'' = x y
    >>> value = evaluate(airy, 2, x0=0, y0=1, dy0=0, digits=20)
    >>> print(value.contains(2.73), value.digits >= 20, f"{float(value):.12f}")
    False True 2.730883017890
    >>> bessel = "x^2*y'' + x*y' + x^2*y = 0"
    >>> print(f"{evaluate(bessel, 1, x0=0, which='regular'):.15f}")      # J0
    0.765197686557967
    >>> y, slope = evaluate("-1", "1/2", x0=0, y0=0, dy0=1, derivative=True)
    >>> print(f"{y:.10f} {slope:.10f}")                                  # sin and cos
    0.4794255386 0.8775825619
    >>> decaying = evaluate("x^2 + a", [1, 2], x0=0, y0=1, which="decaying", params={"a": -1})
    >>> print([f"{value:.10f}" for value in decaying])                   # exp(-x^2/2)
    ['0.6065306597', '0.1353352832']
    >>> legendre = evaluate("y'' + cot(x)*y' + 6*y = 0", 2, x0=1, y0="(3*cos(1)^2 - 1)/2", dy0="-3*sin(1)*cos(1)")
    >>> print(f"{legendre:.10f}")                                        # P2(cos 2)
    -0.2402327156
    >>> evaluate("-1/(4*x^2)", -1, x0=1, y0=1, dy0="1/2", path="above").contains(1j)      # x^(1/2)
    True
    """
    return _prepared(equation, Request.of("evaluate", keywords))._values(x, derivative=derivative)


class Prepared:
    """One solution as a function of points, made by `prepared`."""

    def __init__(self, question: Any, start: Start) -> None:
        self._question = question
        self._start = start
        self.digits: int = question.digits

    @overload
    def __call__(self, x: OnePoint, *, derivative: Literal[False] = ..., digits: int | None = ...) -> Ball: ...
    @overload
    def __call__(self, x: OnePoint, *, derivative: Literal[True], digits: int | None = ...) -> tuple[Ball, Ball]: ...
    @overload
    def __call__(
        self, x: ManyPoints, *, derivative: Literal[False] = ..., digits: int | None = ...
    ) -> tuple[Ball, ...]: ...
    @overload
    def __call__(
        self, x: ManyPoints, *, derivative: Literal[True], digits: int | None = ...
    ) -> tuple[tuple[Ball, Ball], ...]: ...
    @overload
    def __call__(self, x: object, *, derivative: bool = ..., digits: int | None = ...) -> Any: ...
    def __call__(self, x: object, *, derivative: bool = False, digits: int | None = None) -> Any:
        """A ball that contains y(x), or a pair with y'(x); a tuple or an array of these for many points.

        Returns and raises the same as `evaluate`.

        Parameters
        ----------
        x : number, sequence or array
            The point or points, as for `evaluate`.
        derivative : bool
            With True pairs of balls, y and y', come back.  False by default.
        digits : int
            The accuracy of this call, by default that of the solution.

        Examples
        --------
        >>> sine = prepared("-1", x0=0, y0=0, dy0=1)
        >>> print(f"{sine('1/2'):.10f}", [f"{value:.10f}" for value in sine([1, 2])])
        0.4794255386 ['0.8414709848', '0.9092974268']
        >>> print(sine(1, digits=30).digits >= 30)
        True
        >>> y, slope = sine(1, derivative=True)
        >>> print(f"{y:.10f} {slope:.10f}")
        0.8414709848 0.5403023059
        """
        if digits is None:
            return self._values(x, derivative=derivative)
        # The journey stays: discs serve other numbers of digits as well.
        question = replace(self._question, digits=number_of_digits(digits, self._question.limits))
        return Prepared(question, self._start)._values(x, derivative=derivative)

    def __repr__(self) -> str:
        start = ", ".join(f"{name}={value}" for name, value in fields_of(self._start).items())
        return f"<Prepared {start}, {self.digits} digits>"

    def _values(self, x: object, *, derivative: bool) -> Any:
        """Values at the points; a warning names the line that called the caller."""
        # Arrays have a shape; everything else is a point or an iterable of points.
        shape = getattr(x, "shape", None)
        if shape is None:
            if isinstance(x, Iterable) and not isinstance(x, str | bytes | Mapping | Set):
                return tuple(self._at([*x], derivative))
            return self._at([x], derivative)[0]

        import numpy as np

        points: Any = np.asarray(x, dtype=object)
        mask: Any = np.ma.getmaskarray(np.ma.asanyarray(x))
        # A point that isn't equal to itself is NaN, which stays; masked points aren't computed.
        wanted = [k for k, point in enumerate(points.flat) if point == point and not mask.flat[k]]
        values = np.full(points.size, math.nan, dtype=object)
        for k, value in zip(wanted, self._at([points.flat[k] for k in wanted], derivative), strict=True):
            values[k] = value
        values = values.reshape(shape)
        return np.ma.array(values, mask=mask) if np.ma.isMaskedArray(x) else values[()]

    def _at(self, points: list[Any], derivative: bool) -> list[Any]:
        """The values, or pairs with the derivatives; a warning where accuracy was lost."""
        results = self._question.states(points)
        for result in results:
            if result.note is not None:
                warn_user(f"at x = {result.x}: {result.note}", AccuracyWarning)
        return [(result.y, result.dy) if derivative else result.y for result in results]


@limited
def prepared(equation: object, **keywords: Unpack[Keywords]) -> Prepared:
    """A solution as a function whose values are balls: expansions made for one value serve the next ones.

    On intervals passed before, a value is that of a polynomial with its proven error, and takes some tenths of a millisecond.
    The solution may be called from several threads, which wait for one another.  Raises the errors of `evaluate` for the start;
    calls return and raise the same as `evaluate` for their points.

    Parameters
    ----------
    equation
        As for `evaluate`.
    initial, accuracy, path, params, var
        The solution, its accuracy, and the limits of each call, as for `evaluate`.

    Examples
    --------
    >>> airy = prepared("x", x0=0, y0=1, dy0=0, digits=20)
    >>> airy
    <Prepared x0=0, y0=1, dy0=0, 20 digits>
    >>> print(f"{airy(1):.12f}")
    1.172299970058
    >>> y, slope = airy("1/2", derivative=True)
    >>> print(f"{slope:.12f}")
    0.126044382768
    >>> mathieu = prepared("y'' + (2 + cos(x))*y = 0", x0=0, y0=1, dy0=0)
    >>> print([f"{value:.10f}" for value in mathieu([1, 20, 19])])
    ['-0.1436874002', '-0.9028643947', '0.3282230186']
    """
    return _prepared(equation, Request.of("prepared", keywords))


def _prepared(equation: object, request: Request) -> Prepared:
    """The solution that is described."""
    equation = with_variable(equation, request.var, request.accuracy.limits, request.params)
    return Prepared(question_of(equation, request), request.start)


def with_variable(equation: object, var: object, limits: Limits | None = None, params: Params = None) -> object:
    """The equation read with this variable, or unchanged if none is named.  Warns about guesses."""
    declared = words_among(params or ())
    limits = limits_of(limits)
    if isinstance(equation, str):
        # Only text leaves something to guess.
        for guess in source_of(equation, None if var is None else str(var), limits, names=declared).guesses:
            warn_user(guess)
    if var is None and not (declared and isinstance(equation, str)):
        return equation
    if isinstance(equation, Answer):
        if str(var) != equation.variable:
            raise InputError(f"the variable of this answer is {equation.variable}, not {var}")
        return equation
    from kovacic.reading.read import read_input

    try:
        return read_input(equation, var=var, limits=limits, exponentials=True, names=declared)
    except NotRational:
        from kovacic.enclosure.functions import as_written  # imports SymPy

        return as_written(equation, var, limits, declared)
