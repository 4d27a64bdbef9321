"""The `Solution` that `solve` returns: an answer with all views of it as methods.

This is the top: the methods call the rooms in which the views are computed, and no room knows this class.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Unpack

from kovacic import derived
from kovacic.answer import Answer
from kovacic.api import find_answer
from kovacic.errors import needs
from kovacic.limits import DEFAULT_LIMITS, Limits, limited
from kovacic.verify import Verification

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.figure import Figure

    from kovacic.closed_form.form import ClosedForm
    from kovacic.doubles.product_form import ProductForm
    from kovacic.doubles.tabulate import TabulatedFunction
    from kovacic.enclosure.agreement import Agreement
    from kovacic.enclosure.evaluate import Prepared, evaluate
    from kovacic.enclosure.problem import NumericProblem
    from kovacic.enclosure.request import Accuracy, Keywords
    from kovacic.galois import EquationGroup, Group
    from kovacic.parametric.restriction import GenericConditions
    from kovacic.special.search import SpecialFunctions


class Solution(Answer):
    """The answer for one equation y'' = S y: frozen, comparable, picklable, verified.

    Attributes
    ----------
    text : str
        The input as given.
    variable : str
        The name of x.
    S : RatFunc
        The coefficient.
    decision : Decision
        The claim with its certificates: the data of `status`, `case`, `riccati`, `proof` and so on.
    notices : tuple of str
        Notes on how the input was read: decimals taken as exact fractions, names taken as parameters, ...
    verified : bool
        True if the decision has passed its independent check, as each decided answer of `solve` has; False for an undecided
        one, and for an answer that fails the check, which only `from_json` with `unverified` returns.
    seconds : float or None
        Wall-clock time of reading, deciding and verifying together; None for an answer that was read from JSON.
    equation : Equation or None
        The equation of which y'' = S y is the normal form; None if S itself was given.
    assumed : bool
        True if a theorem proves the answer for all values with the assumptions, `known`, except those that the notices name.
    limits : Limits
        The limits of each view: one that would take longer raises `LimitExceeded`, and the groups are None.
    known : Assumptions or None
        The assumptions about the parameters.

    Examples
    --------
    >>> import kovacic
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0")
    >>> answer.status, answer.case, answer.omega, answer.constants, answer.gauge
    (<Status.LIOUVILLIAN: 'liouvillian'>, 1, <RatFunc c>, <RationalPoly x**2 + 1>, <RatFunc -1/(2*x)>)
    >>> answer.solutions
    (cos(x)/sqrt(x), sin(x)/sqrt(x))
    >>> answer
    <Solution of x^2*y'' + x*y' + (x^2 - 1/4)*y = 0: case 1, omega = i or -i>
    """

    @classmethod
    def _of(cls, answer: Answer) -> Solution:
        solution = cls.__new__(cls)
        solution.__dict__.update(answer.__dict__)
        return solution

    @property
    def group(self) -> Group | None:
        """The differential Galois group of y'' = S y, a subgroup of SL2(C); None if the equation is undecided.

        Raises `VerificationFailed` if the kernel doesn't confirm it, which for an answer of `solve` is a defect.
        """
        return derived.group(self)

    @property
    def equation_group(self) -> EquationGroup | None:
        """The group of the equation as given, in GL2(C); None without `group`, and with a gauge and parameters."""
        return derived.equation_group(self)

    @property
    def is_algebraic(self) -> bool | None:
        """True if all solutions of the equation as given are algebraic functions; None if that wasn't determined."""
        return derived.is_algebraic(self)

    @property
    def closed_form(self) -> ClosedForm | None:
        """Two independent solutions as SymPy expressions, how they were checked, and notes; None without a solution.

        >>> import kovacic
        >>> kovacic.solve("x^2 + 3").closed_form.y1
        x*exp(x**2/2)
        """
        return derived.closed_form(self)

    @property
    def special(self) -> SpecialFunctions:
        """Two solutions in Airy's, Bessel's, Kummer's or Gauss' functions, or the classes that were searched in vain.

        Assumptions about parameters are used: hermite(n, x) for natural n.  An exhausted limit is a value, `stopped`.
        """
        return derived.special(self)

    @property
    def numeric(self) -> NumericProblem:
        """The initial value problem behind `at`, `prepared` and `plot`, read once."""
        from kovacic.enclosure.problem import problem_of

        return problem_of(self)

    @property
    def solutions(self) -> tuple[Any, ...]:
        """y1 and y2, SymPy expressions that solve the equation as given; empty without a Liouvillian solution."""
        return derived.solutions(self)

    if TYPE_CHECKING:
        at = evaluate
    else:

        @limited
        def at(self, x, **keywords):
            """Balls that contain values of a solution: `kovacic.evaluate` of this equation, with the same keywords.

            Parameters
            ----------
            x : number, or a sequence of numbers
                Where the solution is evaluated.

            Examples
            --------
            >>> import kovacic
            >>> answer = kovacic.solve("x^2 + 3")      # y = x exp(x^2/2) has y(0) = 0, y'(0) = 1
            >>> print(f"{answer.at(1, x0=0, y0=0, dy0=1):.12f}")
            1.648721270700
            """
            from kovacic.enclosure.evaluate import evaluate
            from kovacic.enclosure.request import Request

            # Unknown keywords are refused in the name of this method; `derivative` is one of `evaluate` alone.
            Request.of("at", {name: value for name, value in keywords.items() if name != "derivative"})
            return evaluate(self, x, **keywords)

    def prepared(self, **keywords: Unpack[Keywords]) -> Prepared:
        """A solution as a function whose values are balls: `kovacic.prepared` of this equation, with the same keywords.

        >>> import kovacic
        >>> airy = kovacic.solve("x").prepared(x0=0, y0=1, dy0=0)
        >>> print(f"{airy(1):.12f}", airy(1, digits=40).digits >= 40)
        1.172299970058 True
        """
        from kovacic.enclosure.evaluate import prepared

        return prepared(self, **keywords)

    def lambdify(
        self,
        *,
        interval: tuple[object, object],
        careful: bool | None = None,
        check: bool = True,
        **keywords: Unpack[Keywords],
    ) -> ProductForm | TabulatedFunction:
        """A solution as a vectorised NumPy function in double precision, its error measured.

        `kovacic.doubles.lambdify.lambdify` describes the result, exceptions, warnings and the other keywords.

        Parameters
        ----------
        interval : pair of numbers
            The ends of an interval without singular points, or opposite corners of a rectangle.
        careful : bool, optional
            True compensates for rounding in products, False doesn't; chosen by default.
        check : bool
            False skips the measurement of the error.

        Examples
        --------
        >>> import kovacic
        >>> f = kovacic.solve("x^2 + 3").lambdify(interval=(0, 2))      # x exp(x^2/2)
        >>> print(f"{f(1.0):.12f}", f.measured.worst < 8)
        1.648721270700 True
        """
        with needs("numeric", "lambdify"):
            from kovacic.doubles.lambdify import lambdify

            return lambdify(self, interval=interval, careful=careful, check=check, **keywords)

    def plot(
        self,
        start: object,
        stop: object,
        *,
        title: str | None = None,
        output: str | Path | None = None,
        points: int = 400,
        **keywords: Unpack[Keywords],
    ) -> Figure:
        """A matplotlib figure of proven values over [start, stop]; `kovacic.views.plot.plot` describes the other keywords.

        Parameters
        ----------
        start, stop : number
            The ends of the interval.
        title : str, optional
            The title, the equation by default.
        output : path, optional
            A file for the picture; its suffix is the format.
        points : int
            The number of values.

        Examples
        --------
        >>> import kovacic
        >>> figure = kovacic.solve("x").plot(-5, 1, x0=0, y0=1, dy0=0, title="Airy", points=20)
        >>> figure.axes[0].get_title()
        'Airy'
        """
        with needs("plot", "a picture"):
            from kovacic.views.plot import plot

            return plot(self, start, stop, title=title, output=output, points=points, **keywords)

    @limited
    def compare_with_monodromy(
        self,
        group: Group | None = None,
        *,
        accuracy: Accuracy | None = None,
        digits: int | None = None,
        limits: Limits | None = None,
    ) -> Agreement:
        """Compare the monodromy, by analytic continuation, with the differential Galois group.

        Parameters
        ----------
        group : Group
            The claim; by default the group that the engine found.
        accuracy, digits, limits
            The accuracy of the matrices, as for `kovacic.monodromy`.

        Returns
        -------
        Agreement
            `verdict` is False (a proof that it isn't this group), True, or None if matrices can't tell, with the `reason`.

        Raises
        ------
        InputError
            For an undecided equation, and where `kovacic.monodromy` raises it.

        Examples
        --------
        >>> import kovacic
        >>> kovacic.solve("-3/(16*x^2)").compare_with_monodromy().reason
        'the monodromy group has 4 elements, with the traces of mu_4'
        >>> print(kovacic.solve("x").compare_with_monodromy().verdict)
        None
        """
        from kovacic.enclosure.agreement import agrees_with_group

        return agrees_with_group(self, group, accuracy=accuracy, digits=digits, limits=limits)

    @property
    @limited
    def generic_conditions(self) -> GenericConditions:
        """The functions that must not vanish and the exponents that must not be rational for the answer to hold, if any.

        >>> import kovacic
        >>> print(kovacic.solve("n*x").generic_conditions)
        n != 0
        """
        from kovacic.parametric.restriction import generic_conditions

        return generic_conditions(self)

    def verify(self) -> Verification:
        """Recompute every claim, the group's too, by independent code; the result is true exactly when all claims hold.

        Examples
        --------
        >>> import kovacic
        >>> print(kovacic.solve("1").verify())
        passed: omega satisfies a polynomial of degree 1
        passed: the roots of the polynomial solve omega' + omega^2 = S
        passed: the sum of the roots is the logarithmic derivative of the semi-invariant
        passed: P has its zeros at ordinary points
        passed: the invariant is a rational form
        passed: the Galois group is the one that is named
        """
        return derived.verification(self)

    @limited
    def to_json(self, *, full: bool = False) -> str:
        """The answer as one line of JSON, schema 1 (`kovacic/views/schema.json`), which `from_json` reads and verifies again.

        Parameters
        ----------
        full : bool
            True adds the group, two solutions in closed form, and the coefficients of the polynomial of omega if its degree
            is 6 or 12.  False by default.

        Raises
        ------
        LimitExceeded
            If the solutions take longer than the limits of the answer allow.

        Examples
        --------
        >>> import json, kovacic
        >>> answer = kovacic.solve("x^2 + 3")
        >>> data = json.loads(answer.to_json())
        >>> data["case"], data["riccati"]["degree"], "group" in data
        (1, 1, False)
        >>> json.loads(answer.to_json(full=True))["group"]["name"]
        'Borel'
        >>> kovacic.Solution.from_json(answer.to_json()) == answer
        True
        """
        from kovacic.views.json import dumps

        return dumps(self, full=full)

    @classmethod
    @limited
    def from_json(
        cls, text: str | Mapping[str, Any], *, limits: Limits = DEFAULT_LIMITS, unverified: bool = False
    ) -> Solution:
        """The answer that was written by `to_json`, verified again.

        Parameters
        ----------
        text : str or mapping
            The line of JSON, or its object.
        limits : Limits
            Bounds on the work; by default those of `Limits()`.
        unverified : bool
            True returns even an answer that fails its check; its `verified` is False.  False by default.

        Returns
        -------
        Solution
            Equal to the one that was written; `seconds` and `notices` aren't checked.

        Raises
        ------
        InputError
            For anything but an answer, and for one that contradicts itself or has a key twice.
        VerificationFailed
            If the answer doesn't pass its check.

        Examples
        --------
        >>> import kovacic
        >>> line = kovacic.solve("x").to_json()
        >>> kovacic.Solution.from_json(line).status
        <Status.NONE_EXISTS: 'none'>
        """
        from kovacic.views.json import loads

        return cls._of(replace(loads(text, unverified=unverified), limits=limits))

    @limited
    def explain(self, *, format: str = "text", solutions: bool = True) -> str:
        """The derivation for a reader of Kovacic's paper: the paper's steps, then the claims of this package.

        It names the formulas that are too long to be printed, and the parts that would have taken longer than the limits allow;
        in HTML, formulas that there is no time to typeset are text.

        Parameters
        ----------
        format : str
            "text" (the default), "markdown", "latex" (the body of a document with amsmath, amssymb and graphicx), or "html": a
            self-contained page in ASCII, with MathML and, for rational coefficients if matplotlib is installed, a picture of
            real solutions.  Any other raises `ValueError`.
        solutions : bool
            False omits the closed forms, which take the most time.  True by default.

        Examples
        --------
        >>> import kovacic
        >>> answer = kovacic.solve("x^2 + 3")
        >>> print(answer.explain().splitlines()[0])
        Kovacic's algorithm for y'' = (x^2 + 3) y
        >>> print(answer.explain(format="markdown", solutions=False).splitlines()[2])
        $$
        >>> answer.explain(format="html", solutions=False)[:15]
        '<!doctype html>'
        """
        from kovacic.views.explain import explain_answer

        return explain_answer(self, format=format, solutions=solutions)

    def citation(self, *, style: str = "text") -> str:
        """The publications that the answer rests on.

        Parameters
        ----------
        style : str
            "text", the default, or "bibtex"; any other raises `ValueError`.

        Examples
        --------
        >>> import kovacic
        >>> kovacic.solve("x").citation(style="bibtex").splitlines()[0]
        '@article{Kov86,'
        """
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
    parameters: Sequence[str] = (),
    limits: Limits = DEFAULT_LIMITS,
) -> Solution:
    """Decide whether y'' = S(x) y has Liouvillian (closed-form) solutions, with a certificate; verified.

    Parameters
    ----------
    S : str, sympy.Expr or pair of sequences
        A rational function over Q: "x^2 + 3", a SymPy expression, or the coefficients of numerator and denominator, low to
        high, integers or fractions.  Or a linear equation of second order, whose normal form is decided:
        "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", or a SymPy `Eq` with a function y(x).
    a, b, c, f
        Instead of S: the coefficients of a y'' + b y' + c y = f.  `a` is needed, the others are 0 by default.
    var : str
        The name of the variable; by default the only symbol, or x.  Every other symbol is a parameter, for whose generic
        values the equation is decided.
    assume : mapping
        Assumptions about parameters, {"n": "integer"} or {"n": ">=0"} in the words of `conditions`; a notice says for which of
        these values the answer holds.  {"n": 3} substitutes a number.  Assumptions of SymPy symbols are used, too.
    parameters : sequence of str
        Names of parameters that have more than one letter, as "EI" or "mass"; other such names are refused.
    limits : Limits
        Bounds on the input and on the work; by default those of `Limits()`.

    Returns
    -------
    Solution
        Its `status` is UNDECIDED exactly when a limit of the work was reached, or where the assumptions imply a case with an
        omega that depends on the values of the parameters; `reason` says so.

    Raises
    ------
    InputError
        For anything but such a function or equation.
    LimitExceeded
        For an input above the limits, or that isn't read in time.
    VerificationFailed
        If the answer doesn't pass its own check, which is a defect of this package.

    Examples
    --------
    A solution, none, and an exhausted limit:

    >>> import kovacic
    >>> answer = kovacic.solve("x^2 + 3")
    >>> answer.case
    1
    >>> print(answer.omega)
    (x**2 + 1)/x
    >>> kovacic.solve("x").status
    <Status.NONE_EXISTS: 'none'>
    >>> print(kovacic.solve("x^4 + x^2 + 202*x + 1/4", limits=kovacic.Limits(unknown_degree=5)).reason)
    the polynomial part of a solution may have degree 100, above the limit of 5

    Equations, as text and by coefficients:

    >>> bessel = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0")
    >>> print(bessel.S, bessel.gauge)
    -1 -1/(2*x)
    >>> kovacic.solve(a="x", b=2, c="x").case
    1

    Parameters, generic, with an assumption and with a value:

    >>> kovacic.solve("n*(n + 1)/x^2 - 1").status
    <Status.NONE_EXISTS: 'none'>
    >>> kovacic.solve("n*(n + 1)/x^2 - 1", assume={"n": "integer"}).reason[:38]
    'case 1 for all values with n integer ('
    >>> kovacic.solve("n*(n + 1)/x^2 - 1", assume={"n": 1}).case
    1

    Reference: J. Kovacic, J. Symb. Comp. 2 (1986) 3-43.
    """
    found = find_answer(S, a=a, b=b, c=c, f=f, var=var, assume=assume, parameters=parameters, limits=limits)
    return Solution._of(found)
