"""The `Solution` that `solve` returns: an answer whose views are computed when they are asked for."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Exclusion, RiccatiPolynomial, SemiInvariant, Status
from kovacic.equation import Change, Equation
from kovacic.errors import LimitExceeded, VerificationFailed, needs
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, limited
from kovacic.verify import Verification, verify

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from kovacic.closed_form.form import ClosedForm
    from kovacic.doubles.product_form import ProductForm
    from kovacic.doubles.tabulate import TabulatedFunction
    from kovacic.enclosure.agreement import Agreement
    from kovacic.enclosure.problem import NumericProblem
    from kovacic.galois import EquationGroup, Group
    from kovacic.parametric.assumptions import Assumptions
    from kovacic.parametric.restriction import GenericConditions
    from kovacic.special.answer import SpecialFunctions


@dataclass(frozen=True, repr=False)
class Solution:
    """The answer for one equation y'' = S y: frozen, comparable, picklable, verified.

    `text` is the input as it was given, `variable` the name of x, `S` the coefficient, `decision` the claim with its
    certificates, `notices` what was noticed when the input was read (decimals taken as exact fractions, ...), `verified`
    whether the decision has passed its independent check (always, for what `solve` returns), and `seconds` the wall-clock
    time of reading, deciding and verifying together (None for an answer that was read from JSON).  `equation` is the
    equation of which y'' = S y is the normal form, None where S itself was given.  `assumed` says that a theorem proves the
    answer for all values with the assumptions, `known`, but for those that the notices name.  `limits` hold for each view that
    is computed later: where one would take longer, it raises `LimitExceeded`, and the groups are None.
    """

    text: str
    variable: str
    S: RatFunc
    decision: Decision
    notices: tuple[str, ...] = ()
    verified: bool = False
    seconds: float | None = field(default=None, compare=False)
    equation: Equation | None = None
    assumed: bool = False
    limits: Limits = field(default=DEFAULT_LIMITS, compare=False)
    known: Assumptions | None = field(default=None, compare=False)

    @property
    def gauge(self) -> RatFunc:
        """-b/(2a) for an equation a y'' + b y' + c y = f: its solutions are those of y'' = S y times exp(int gauge dx)."""
        return RatFunc(self.S.field.poly([])) if self.equation is None else self.equation.gauge

    @property
    def change(self) -> Change | None:
        """Which function of the user's variable, that of `solutions`, `variable` is; None where they are the same."""
        return None if self.equation is None else self.equation.change

    @property
    def status(self) -> Status:
        """LIOUVILLIAN, NONE_EXISTS, or UNDECIDED (then `reason` says why)."""
        return self.decision.status

    @property
    def case(self) -> int | None:
        """Kovacic's case: 1 (omega rational), 2 (omega of degree 2), 3 (of degree 4, 6 or 12); None without a solution."""
        return self.decision.case

    @property
    def reason(self) -> str | None:
        """Why the equation is undecided; None if it is decided."""
        return self.decision.undecided

    @property
    def semi_invariant(self) -> SemiInvariant | None:
        """The product of the solutions whose logarithmic derivatives are the conjugates of omega."""
        return self.decision.semi_invariant

    @property
    def riccati(self) -> RiccatiPolynomial | None:
        """The monic polynomial of omega = y'/y, minimal over C(x); its `coefficients` run from W^0 to W^n."""
        return self.decision.riccati

    @property
    def omega(self) -> RatFunc | None:
        """omega = y'/y where it is rational (case 1), else None.  The solution is exp(int omega dx)."""
        riccati = self.decision.riccati
        return -riccati.coefficients[0] if riccati is not None and riccati.degree == 1 else None

    @property
    def constants(self) -> Poly | None:
        """The minimal polynomial of the constant c in omega's coefficients; None if they lie in the field of S."""
        extension = None if self.decision.riccati is None else self.decision.riccati.P.field
        return extension.modulus if isinstance(extension, AlgebraicField) and extension != self.S.field else None

    @cached_property
    @limited
    def group(self) -> Group | None:
        """The differential Galois group of y'' = S y, a subgroup of SL2(C); None if the equation is undecided.

        Raises `VerificationFailed` if the kernel doesn't confirm it, which for an answer of `solve` is a defect.
        """
        from kovacic.galois import group_of

        try:
            group = group_of(self.S, self.decision, self.limits)
            if group is None or (verification := verify(self.S, self.decision, group.claim)):
                return group
        except LimitExceeded:
            return None
        raise VerificationFailed(f"the group of S = {self.S} failed its own check\n{verification}")

    @cached_property
    @limited
    def equation_group(self) -> EquationGroup | None:
        """The group of the equation as it was given, in GL2(C); None without `group`, and with a gauge and parameters."""
        from kovacic.galois import equation_group

        try:
            return None if self.group is None else equation_group(self.S, self.decision, self.group, self.gauge)
        except LimitExceeded:
            return None

    @property
    def is_algebraic(self) -> bool | None:
        """Are all solutions of the equation as given algebraic functions?  None if that wasn't determined."""
        return None if self.equation_group is None else self.equation_group.finite

    @cached_property
    @limited
    def closed_form(self) -> ClosedForm | None:
        """Two independent solutions as SymPy expressions, how they were checked, and notes; None without a solution."""
        from kovacic.closed_form.form import solutions

        if self.case is None:
            return None
        return self._in_given_variable(solutions(self.S, self.decision, self.gauge, self.variable))  # type: ignore[no-any-return]

    def _in_given_variable(self, found: Any) -> Any:
        """The same with y1 and y2 in the user's variable."""
        if self.change is None or found.y1 is None:
            return found
        from kovacic.reading.exponential import solution_in_terms_of

        y1, y2 = (solution_in_terms_of(self.change, y, self.variable) for y in (found.y1, found.y2))
        return replace(found, y1=y1, y2=y2)

    @cached_property
    def special(self) -> SpecialFunctions:
        """Two solutions in Airy's, Bessel's, Kummer's or Gauss' functions, or which classes of these were searched in vain.

        What was assumed about parameters is used: hermite(n, x) for natural n.  An exhausted limit is a value, `stopped`.
        """
        from kovacic.special.answer import special_functions

        symbols = self.known.symbols() if self.known else {}
        found = special_functions(self.S, self.gauge, self.variable, Budget(self.limits), symbols=symbols)
        if found and symbols:
            plain = {symbol: type(symbol)(name) for name, symbol in symbols.items()}
            found = replace(found, y1=found.y1.xreplace(plain), y2=found.y2.xreplace(plain))
        return self._in_given_variable(found)  # type: ignore[no-any-return]

    def __getstate__(self) -> dict[str, Any]:
        """Without `numeric`, which has what doesn't pickle."""
        return {name: value for name, value in self.__dict__.items() if name != "numeric"}

    @cached_property
    def numeric(self) -> NumericProblem:
        """What `at` and its relatives evaluate, read once."""
        from kovacic.enclosure.problem import read_problem

        return read_problem(self)

    @property
    def solutions(self) -> tuple[Any, ...]:
        """y1 and y2, SymPy expressions that solve the equation as it was given; empty without a Liouvillian solution."""
        return () if self.closed_form is None else (self.closed_form.y1, self.closed_form.y2)

    @limited
    def at(self, x: Any, *, x0: Any, **options: Any) -> Any:
        """A ball that contains y(x): `y0=` and `dy0=` at x0, or `which="regular"`, or `frobenius=(c1, c2)`; see
        `kovacic.evaluate`.  Only the first of these where coefficients in exp(k x) were given."""
        from kovacic.enclosure.evaluate import evaluate

        return evaluate(self, x, x0=x0, **options)

    @limited
    def lambdify(self, **options: Any) -> ProductForm | TabulatedFunction:
        """A solution as a NumPy function, its error measured; see `kovacic.doubles.lambdify.lambdify`."""
        with needs("numeric", "lambdify"):
            from kovacic.doubles.lambdify import lambdify

            return lambdify(self, **options)

    @limited
    def plot(self, start: Any, stop: Any, **options: Any) -> Figure:
        """A matplotlib figure of proven values over [start, stop]; see `kovacic.views.plot.plot`."""
        with needs("plot", "a picture"):
            from kovacic.views.plot import plot

            return plot(self, start, stop, **options)

    @limited
    def compare_with_monodromy(self, **options: Any) -> Agreement:
        """Does the monodromy, by analytic continuation, agree with `group`?  See `kovacic.enclosure.agreement`."""
        from kovacic.enclosure.agreement import agrees_with_group

        return agrees_with_group(self, **options)

    @property
    def proof(self) -> tuple[Exclusion, ...]:
        """What was excluded and by which evidence: everything, for a "no"; all smaller structures, for a "yes"."""
        return self.decision.exclusions

    @property
    @limited
    def generic_conditions(self) -> GenericConditions:
        """What must not vanish, and which exponents must not be rational, for the answer to hold; empty without parameters."""
        from kovacic.parametric.restriction import generic_conditions

        return generic_conditions(self)

    @limited
    def verify(self) -> Verification:
        """Recompute every claim, the group's too, by independent code; true exactly when all of them hold."""
        from kovacic.galois import group_of

        verification = verify(self.S, self.decision)
        group = group_of(self.S, self.decision, self.limits) if verification else None
        return verification if group is None else verify(self.S, self.decision, group.claim)

    @limited
    def to_json(self, **options: Any) -> str:
        """The answer as one line of JSON, schema 1."""
        from kovacic.views.json import dumps

        return dumps(self, **options)

    @classmethod
    @limited
    def from_json(cls, text: str | Mapping[str, Any], *, limits: Limits = DEFAULT_LIMITS) -> Solution:
        """The answer that was written by `to_json`, verified again: `verified` says with what outcome.

        Raises `InputError` where it isn't one.
        """
        from kovacic.views.json import loads

        return replace(loads(text), limits=limits)

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

    def __bool__(self) -> bool:
        raise TypeError("ask for .status or .case: an answer is neither true nor false")

    def __repr__(self) -> str:
        return f"<Solution of {self}>"

    def __str__(self) -> str:
        from kovacic.views.text import one_line

        return one_line(self)
