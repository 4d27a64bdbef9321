"""The `Solution` that `solve` returns: an answer with everything that can be asked of it as methods.

This is the top: the methods call the rooms in which the views are computed, and no room knows of this class.
"""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, Literal, Unpack, overload

from kovacic import derived
from kovacic.answer import Answer
from kovacic.api import find_answer
from kovacic.errors import check_keywords, needs
from kovacic.limits import DEFAULT_LIMITS, Limits, limited
from kovacic.verify import Verification

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from matplotlib.figure import Figure

    from kovacic.closed_form.form import ClosedForm
    from kovacic.doubles.lambdify import LambdifyOptions
    from kovacic.doubles.product_form import ProductForm
    from kovacic.doubles.tabulate import TabulatedFunction
    from kovacic.enclosure.agreement import Agreement
    from kovacic.enclosure.ball import Ball
    from kovacic.enclosure.evaluate import ManyPoints, OnePoint, Options
    from kovacic.enclosure.problem import NumericProblem
    from kovacic.galois import EquationGroup, Group
    from kovacic.parametric.restriction import GenericConditions
    from kovacic.special.search import SpecialFunctions
    from kovacic.views.plot import PlotOptions


class Solution(Answer):
    """The answer for one equation y'' = S y: frozen, comparable, picklable, verified.

    `text` is the input as it was given, `variable` the name of x, `S` the coefficient, `decision` the claim with its
    certificates, `notices` what was noticed when the input was read (decimals taken as exact fractions, ...), `verified`
    whether the decision has passed its independent check (always, for what `solve` returns), and `seconds` the wall-clock
    time of reading, deciding and verifying together (None for an answer that was read from JSON).  `equation` is the
    equation of which y'' = S y is the normal form, None where S itself was given.  `assumed` says that a theorem proves the
    answer for all values with the assumptions, `known`, but for those that the notices name.  `limits` hold for each view that
    is computed later: where one would take longer, it raises `LimitExceeded`, and the groups are None.
    """

    @classmethod
    def of(cls, answer: Answer) -> Solution:
        """The same answer, with its methods."""
        return cls(**{field.name: getattr(answer, field.name) for field in fields(answer)})

    @property
    def group(self) -> Group | None:
        """The differential Galois group of y'' = S y, a subgroup of SL2(C); None if the equation is undecided.

        Raises `VerificationFailed` if the kernel doesn't confirm it, which for an answer of `solve` is a defect.
        """
        return derived.group(self)

    @property
    def equation_group(self) -> EquationGroup | None:
        """The group of the equation as it was given, in GL2(C); None without `group`, and with a gauge and parameters."""
        return derived.equation_group(self)

    @property
    def is_algebraic(self) -> bool | None:
        """Are all solutions of the equation as given algebraic functions?  None if that wasn't determined."""
        return derived.is_algebraic(self)

    @property
    def closed_form(self) -> ClosedForm | None:
        """Two independent solutions as SymPy expressions, how they were checked, and notes; None without a solution."""
        return derived.closed_form(self)

    @property
    def special(self) -> SpecialFunctions:
        """Two solutions in Airy's, Bessel's, Kummer's or Gauss' functions, or which classes of these were searched in vain.

        What was assumed about parameters is used: hermite(n, x) for natural n.  An exhausted limit is a value, `stopped`.
        """
        return derived.special(self)

    @property
    def numeric(self) -> NumericProblem:
        """What `at` and its relatives evaluate, read once."""
        from kovacic.enclosure.problem import problem_of

        return problem_of(self)

    @property
    def solutions(self) -> tuple[Any, ...]:
        """y1 and y2, SymPy expressions that solve the equation as it was given; empty without a Liouvillian solution."""
        return derived.solutions(self)

    @overload
    def at(self, x: OnePoint, *, x0: object, derivative: Literal[False] = ..., **options: Unpack[Options]) -> Ball: ...
    @overload
    def at(
        self, x: OnePoint, *, x0: object, derivative: Literal[True], **options: Unpack[Options]
    ) -> tuple[Ball, Ball]: ...
    @overload
    def at(
        self, x: ManyPoints, *, x0: object, derivative: Literal[False] = ..., **options: Unpack[Options]
    ) -> tuple[Ball, ...]: ...
    @overload
    def at(
        self, x: ManyPoints, *, x0: object, derivative: Literal[True], **options: Unpack[Options]
    ) -> tuple[tuple[Ball, Ball], ...]: ...
    @overload
    def at(self, x: object, *, x0: object, derivative: bool = ..., **options: Unpack[Options]) -> Any: ...
    @limited
    def at(self, x: object, *, x0: object, derivative: bool = False, **options: Unpack[Options]) -> Any:
        """A ball that contains y(x), for the solution y that starts at x0 as `y0` and `dy0` or others of the keywords say.

        Parameters
        ----------
        x : number, sequence or array
            Where; a tuple or an array of balls comes back for a sequence or a NumPy array.
        x0 : number
            Where the solution starts.
        derivative : bool
            With True, pairs of balls, y and y', come back.  False by default.
        y0, dy0, frobenius, which, path
            The solution and the way, as for `kovacic.evaluate`; y0 and dy0 only where coefficients in exp(k x) were given.
        params : mapping
            Values of the parameters by name: {"a": 2}.
        digits : int
            The accuracy, relative to the value; 15 by default.
        method : str
            "taylor" or "closed form"; by default the one that is faster.
        limits : Limits
            What the work may cost.

        Returns and raises what `kovacic.evaluate` does, where each keyword is described.

        Examples
        --------
        >>> import kovacic
        >>> answer = kovacic.solve("x^2 + 3")      # y = x exp(x^2/2) has y(0) = 0, y'(0) = 1
        >>> print(f"{answer.at(1, x0=0, y0=0, dy0=1):.12f}")
        1.648721270700
        >>> y, slope = answer.at(1, x0=0, y0=0, dy0=1, derivative=True)
        >>> print(f"{slope:.12f}")
        3.297442541400
        >>> bessel = kovacic.solve("x^2*y'' + x*y' + x^2*y = 0")
        >>> print([f"{value:.12f}" for value in bessel.at([1, 2], x0=0, which="regular")])
        ['0.765197686558', '0.223890779141']
        """
        from kovacic.enclosure.evaluate import Options, evaluate

        check_keywords("at", options, ["derivative", *Options.__annotations__])
        return evaluate(self, x, x0=x0, derivative=derivative, **options)

    @limited
    def lambdify(self, **options: Unpack[LambdifyOptions]) -> ProductForm | TabulatedFunction:
        """A solution as a vectorised NumPy function in double precision, its error measured.

        Parameters
        ----------
        interval : pair
            Two real numbers, or two corners of a rectangle of the complex plane (case 1); needed.
        which : int or str
            The number of the solution, 0 by default; with x0 "regular" or "decaying".
        careful : bool or None
            Double-doubles (True), plain doubles (False), or what the measured error asks for (None, the default).
        check : bool
            False leaves the measurement out.  True by default.
        params, x0, y0, dy0, frobenius, path, limits
            As for `at`: the solution with these initial values, which every equation has.

        Returns, raises and warns as `kovacic.doubles.lambdify.lambdify`, where each keyword is described.

        Examples
        --------
        >>> import kovacic
        >>> f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 2))      # x exp(x^2/2)
        >>> print(f"{f(1.0):.12f}", f.measured.worst < 8)
        1.648721270700 True
        >>> airy = kovacic.solve("x").lambdify(interval=(-9, 2), x0=0, y0=1, dy0=0)
        >>> print(f"{airy(1.0):.12f}")
        1.172299970058
        """
        with needs("numeric", "lambdify"):
            from kovacic.doubles.lambdify import lambdify

            return lambdify(self, **options)

    @limited
    def plot(
        self,
        start: object,
        stop: object,
        *,
        title: str | None = None,
        output: str | Path | None = None,
        **options: Unpack[PlotOptions],
    ) -> Figure:
        """A matplotlib figure of proven values over [start, stop].

        Parameters
        ----------
        start, stop : number
            The ends of the interval, real; singular points between them are marked.
        title : str
            Above the picture; the equation by default.
        output : str or Path
            A file to which the picture is saved: png, svg or pdf.
        x0, y0, dy0, frobenius, which
            The solution to be drawn; by default y1 and y2 where they are known, else y(x0) = 1, y'(x0) = 0.
        points, digits, params, method, limits
            As for `kovacic.views.plot.plot`, which says what is returned and raised.

        Examples
        --------
        >>> import kovacic
        >>> figure = kovacic.solve("x^2 + 3").plot(-1, 1)
        >>> [line.get_label()[:2] for line in figure.axes[0].get_lines()][:2]
        ['y1', 'y2']
        >>> figure = kovacic.solve("x").plot(-5, 1, x0=0, y0=1, dy0=0, title="Airy", points=200)
        >>> figure.axes[0].get_title()
        'Airy'
        """
        with needs("plot", "a picture"):
            from kovacic.views.plot import plot

            return plot(self, start, stop, title=title, output=output, **options)

    @limited
    def compare_with_monodromy(
        self, group: Group | None = None, *, digits: int = 15, limits: Limits | None = None
    ) -> Agreement:
        """Does the monodromy, by analytic continuation, agree with `group`?  See `kovacic.enclosure.agreement`."""
        from kovacic.enclosure.agreement import agrees_with_group

        return agrees_with_group(self, group, digits=digits, limits=limits)

    @property
    @limited
    def generic_conditions(self) -> GenericConditions:
        """What must not vanish, and which exponents must not be rational, for the answer to hold; empty without parameters."""
        from kovacic.parametric.restriction import generic_conditions

        return generic_conditions(self)

    def verify(self) -> Verification:
        """Recompute every claim, the group's too, by independent code; true exactly when all of them hold."""
        return derived.verification(self)

    @limited
    def to_json(self, *, full: bool = False) -> str:
        """The answer as one line of JSON, schema 1; `full` adds the group and two solutions in closed form."""
        from kovacic.views.json import dumps

        return dumps(self, full=full)

    @classmethod
    @limited
    def from_json(
        cls, text: str | Mapping[str, Any], *, limits: Limits = DEFAULT_LIMITS, unverified: bool = False
    ) -> Solution:
        """The answer that was written by `to_json`, verified again.

        Raises `InputError` where it isn't one, contradicts itself, or has a key twice; and `VerificationFailed` where it
        doesn't pass its check.  With `unverified=True` it is returned all the same, and its `verified` is False.
        """
        from kovacic.views.json import loads

        return cls.of(replace(loads(text, unverified=unverified), limits=limits))

    @limited
    def explain(self, *, format: str = "text", solutions: bool = True) -> str:
        """The derivation as a reader of Kovacic's paper follows it: "text", "markdown", "latex", or "html" (a page of its own).

        With `solutions=False` the closed forms are left out.  See `kovacic.views.explain`.
        """
        from kovacic.views.explain import explain

        return explain(self, format=format, solutions=solutions)

    def citation(self, *, style: str = "text") -> str:
        """What the answer rests on in the literature, as text or as BibTeX (`style="bibtex"`)."""
        from kovacic.views.bibliography import citation

        return citation(self, style=style)

    def _repr_latex_(self) -> str:
        from kovacic.views.text import latex_view

        return latex_view(self)

    def _repr_html_(self) -> str:
        from kovacic.views.text import html_view

        return html_view(self)

    def __repr__(self) -> str:
        return f"<Solution of {self}>"

    def __str__(self) -> str:
        from kovacic.views.text import one_line

        return one_line(self)


@limited
def solve(
    S: Any = None,
    *,
    a: Any = None,
    b: Any = None,
    c: Any = None,
    f: Any = None,
    var: str | None = None,
    assume: Mapping[Any, Any] | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Solution:
    """Decide whether y'' = S(x) y has Liouvillian (closed-form) solutions, with a certificate; verified.

    S is a rational function over Q: a string ("x^2 + 3"), a SymPy expression, or a pair of coefficient sequences
    (numerator, denominator), low to high, of integers or fractions.  Or it is a linear equation of second order, whose
    normal form is decided: a string ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"), a SymPy `Eq` with a function y(x), or the
    coefficients of a y'' + b y' + c y = f as keywords.  `var` names the variable; by default it is the only symbol of S, or
    x.  `limits` bounds the input and the work.  Every other symbol is a parameter, for whose generic values the equation is
    decided; `assume={"n": "integer"}`, {"n": ">=0"}, or assumptions of SymPy symbols, say more (see `conditions`), and a notice
    says for which of these values the answer holds; with {"n": 3} the number is put in for the parameter.

    Returns a `Solution`.  Its `status` is UNDECIDED exactly when a limit of the work was reached, or where the assumptions
    imply a case with an omega that depends on the values of the parameters; `reason` says so.  Raises `InputError` for
    what isn't such a function, `LimitExceeded` for an input above the limits, or that isn't read in time, and
    `VerificationFailed` if the answer doesn't pass its own check, which is a defect of this package.

    >>> import kovacic
    >>> answer = kovacic.solve("x^2 + 3")
    >>> answer.case
    1
    >>> print(answer.omega)
    (x**2 + 1)/x
    >>> kovacic.solve("x").status
    <Status.NONE_EXISTS: 'none'>
    >>> bessel = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0")
    >>> print(bessel.S, bessel.gauge)
    -1 -1/(2*x)

    Reference: J. Kovacic, J. Symb. Comp. 2 (1986) 3-43.
    """
    return Solution.of(find_answer(S, a=a, b=b, c=c, f=f, var=var, assume=assume, limits=limits))
