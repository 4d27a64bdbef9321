"""`kovacic.conditions`: the parameter values for which an equation is solvable, with the solution at each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

from kovacic.limits import DEFAULT_LIMITS, Limits, limited, limits_of
from kovacic.numbers.exact import whole
from kovacic.parametric.api import CheckReport, check_at_samples, find_conditions
from kovacic.parametric.natural import DEFAULT_DEGREE
from kovacic.parametric.parametric_answer import ParametricAnswer, Values
from kovacic.reading.read import declared
from kovacic.solution import Solution
from kovacic.views.parameters import conditions_latex, conditions_text, explain_conditions, plot_map
from kovacic.views.theorem import theorem_text


class Conditions(ParametricAnswer):
    __doc__ = ParametricAnswer.__doc__

    def solve_at(self, values: Values) -> Solution:
        """The verified answer at a point, with the omega that the region makes possible.

        Parameters
        ----------
        values : mapping
            A number for each parameter, rational or algebraic: {"n": "1/2"}.

        Raises
        ------
        InputError
            Where S isn't defined, or if a parameter has no value.

        Examples
        --------
        >>> import kovacic
        >>> kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").solve_at({"n": "1/2"}).case
        1
        """
        return Solution._of(self.answer_at(values))

    def check(self, samples: int = 200, *, seed: int = 1) -> CheckReport:
        """Solve the equation at exact points inside and outside of the regions, and compare with the printed conditions.

        The printed conditions themselves are evaluated, and formulas are substituted into the equation.  One point in each
        region is compared whenever conditions are found.

        Parameters
        ----------
        samples : int
            The number of points: 200 by default, fewer if the time is over.
        seed : int
            Determines the points; 1 by default.

        Returns
        -------
        CheckReport
            True if every sample agrees.

        Examples
        --------
        >>> import kovacic
        >>> report = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").check(20)
        >>> bool(report), report.inside + report.outside
        (True, 20)
        """
        return check_at_samples(self, whole(samples, "samples"), whole(seed, "seed", least=None))

    def theorem(self, *, format: str = "text") -> str:
        r"""The conditions as the theorem that a paper prints: hypothesis, cases with groups and solutions, proof, references.

        Parameters
        ----------
        format : str
            "text" (the default), "markdown" with formulas between dollar signs, "latex", the environments theorem and proof
            for a document with amsmath, amssymb, amsthm, graphicx and ``\newtheorem{theorem}{Theorem}``, or "html", a page of
            its own; any other raises `ValueError`.

        Returns
        -------
        str
            "The equation has Liouvillian solutions if and only if one of the following holds", each case under the condition
            that none before it holds, with its group, its solutions, and the first Delta_d; and the part, if any, that isn't
            proven to be complete.

        Examples
        --------
        >>> import kovacic
        >>> print(kovacic.conditions("x^4 + mu*x", var="x").theorem().partition("\n\nCase 1")[0])
        Theorem
        =======
        <BLANKLINE>
        Let mu be a complex number. The equation
        <BLANKLINE>
            y'' = (x^4 + mu*x) y
        <BLANKLINE>
        has Liouvillian solutions if and only if the following holds:
        <BLANKLINE>
        mu = +-2 mod 6.
        """
        return theorem_text(self, format=format)

    def latex(self) -> str:
        r"""The partition as a LaTeX `cases` environment, without delimiters; one that isn't proven to be complete says so.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> print(bessel.latex().partition("cases} ")[2])
        \text{case 1} & n - \frac{1}{2} \in \mathbb{Z} \\ \text{no Liouvillian solution} & \text{otherwise} \end{cases}
        """
        return conditions_latex(self)

    def _repr_latex_(self) -> str:
        return f"${self.latex()}$"

    @limited
    def plot(
        self,
        axes: Any = None,
        *,
        parameters: Sequence[str] | None = None,
        ranges: Sequence[tuple[Any, Any]] | None = None,
        steps: int = 48,
        fixed: Mapping[str, Any] | None = None,
    ) -> Any:
        """A map of two parameters, or a strip for one, coloured by the claims of the regions.

        It needs matplotlib (the extra `plot`); no window is opened.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            Where to draw; by default a new figure.
        parameters : sequence of str
            One or two names; by default the first ones.
        ranges : sequence of pairs
            The ends of the range of each.
        steps : int
            Points in either direction: 48 by default.
        fixed : mapping
            The values of all other parameters.

        Raises
        ------
        InputError
            For more than two parameters, or an empty range.

        Examples
        --------
        >>> import kovacic
        >>> axes = kovacic.conditions("n/x^2 + k").plot(steps=8)                       # a map
        >>> axes.get_xlabel(), axes.get_ylabel()
        ('n', 'k')
        >>> strip = kovacic.conditions("n/x^2 + k").plot(parameters=["n"], ranges=[(0, 2)], steps=8, fixed={"k": 1})
        >>> strip.get_xlabel(), strip.get_ylabel()
        ('n', '')
        """
        return plot_map(self, axes, parameters, ranges, steps, fixed)

    def text(self, *, all: bool = False) -> str:
        """The partition in lines, as `str` gives it: successive regions with the same case are written together.

        Parameters
        ----------
        all : bool
            Write every region; by default at most a screen of them.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> print(bessel.text())
        y'' = ((-4*x^2 + 4*n^2 - 1)/(4*x^2)) y, parameters n
          n - 1/2 in Z: case 1
          otherwise: no Liouvillian solution
          (proven to be complete; Whittaker's equation in x: Martinet & Ramis)
        >>> print(kovacic.conditions("n/x^2 + k").text(all=True).splitlines()[0])
        y'' = ((k*x^2 + n)/x^2) y, parameters n, k
        """
        return conditions_text(self, all=all)

    @limited
    def explain(self) -> str:
        """The partition, and the reasons for each region: exponents, degrees, and solutions if they are known.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> print(bessel.explain().splitlines()[-1])
          y = x^(1/2 - n)*exp(-I*x)*assoc_laguerre(n - 1/2, -2*n, 2*I*x) where n - 1/2 is a natural number
        """
        return explain_conditions(self)

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        names = ", ".join(self.parameters)
        regions = f"{len(self.regions)} region{'s' * (len(self.regions) != 1)}"
        return f"<Conditions on {names} for y'' = {self.right.text}: {regions}>"


def conditions(
    S: Any,
    *,
    var: Any = None,
    assume: Mapping[Any, Any] | None = None,
    max_degree: int = DEFAULT_DEGREE,
    parameters: Sequence[str] = (),
    limits: Limits = DEFAULT_LIMITS,
) -> Conditions:
    """The values of the parameters for which y'' = S(x) y has Liouvillian solutions: all of them where `complete` is True.

    Parameters
    ----------
    S : str, sympy.Expr or pair
        A rational function, or an equation, as for `kovacic.solve`, with parameters.
    var : str or sympy.Symbol
        The variable; by default x, or the only symbol.  Every other symbol is a parameter.
    assume : mapping
        Leaves out regions that it excludes: {"n": "positive integer"}.  The words are natural (0, 1, 2, ...), integer, even,
        odd, half-integer, rational, irrational, noninteger, nonzero, positive, negative, nonnegative, nonpositive, and
        inequalities such as ">=1/2", for a real number.  A number, {"n": 3}, is substituted.  Assumptions of SymPy symbols are
        used in the same way; contradictory ones are refused.
    max_degree : int
        For a condition on a natural number d, determinants are shown up to d = `max_degree`, 2 by default; `determinant` of
        the condition computes others.
    parameters : sequence of str
        Names of parameters that have more than one letter, as "EI" or "mass"; other such names are refused.
    limits : Limits
        Bounds on the input and on the work; by default those of `Limits()`.

    Returns
    -------
    Conditions
        Regions in order: the first one that holds decides.  `complete` is True if they are proven to be all, else a sentence
        about the part that isn't proven, as for an exhausted budget.

    Raises
    ------
    InputError
        For anything but a rational function or an equation with parameters.
    LimitExceeded
        For an input above the limits.

    Examples
    --------
    >>> import kovacic
    >>> print(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1"))
    y'' = ((-4*x^2 + 4*n^2 - 1)/(4*x^2)) y, parameters n
      n - 1/2 in Z: case 1
      otherwise: no Liouvillian solution
      (proven to be complete; Whittaker's equation in x: Martinet & Ramis)
    >>> len(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1", assume={"n": "integer"}).regions)
    0

    References: T. Kimura, Funkcial. Ekvac. 12 (1969); J. Martinet & J.-P. Ramis (1989); A. Duval & M. Loday-Richaud,
    AAECC 3 (1992).
    """
    limits = limits_of(limits)
    names = declared(parameters, assume)
    found = find_conditions(S, var=var, assume=assume, max_degree=max_degree, limits=limits, names=names)
    return Conditions(**{field.name: getattr(found, field.name) for field in fields(found)})
