"""The answer of `kovacic.conditions`: the regions of parameter space, the verdict at a point, and JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from itertools import chain
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.answer import Answer
from kovacic.decision import Status
from kovacic.derived import verification
from kovacic.engine.decide import decide
from kovacic.equation import Equation, parameters_of
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, limited
from kovacic.numbers.exact import whole
from kovacic.parametric import record
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, check_values, read_assumptions
from kovacic.parametric.claims import NO_CONSTANT, ParameterPoint, over_parameters
from kovacic.parametric.natural import Determinant
from kovacic.parametric.partition import derived
from kovacic.parametric.regions import Limited, ParameterRegion, RegionVerdict, Theory, settled_regions
from kovacic.parametric.restriction import Letters, everywhere, setting_of, values_of_letters
from kovacic.parametric.solutions import Later, SolutionsByDegree
from kovacic.parametric.statements import Statement
from kovacic.reading.constants import with_root
from kovacic.reading.read import read_input
from kovacic.reading.substitution import number_text
from kovacic.reading.symbolic import read_expression
from kovacic.writing.escaped import json_line
from kovacic.writing.formula import Formulas, Math

#: A number for each parameter by name or symbol, or a point with these numbers.
Values = Mapping[Any, Any] | ParameterPoint


@dataclass(frozen=True)
class ParametricAnswer:
    """The values of the parameters for which y'' = S y has Liouvillian solutions: frozen and picklable.

    `str` lists the regions in lines, and a notebook shows them as cases.  The regions are tried in their order: the first one
    whose statement holds decides.  All of it holds for values that satisfy the `assumptions`.

    Attributes
    ----------
    S : RatFunc
        The coefficient of the normal form; an algebraic constant in it is a parameter here.
    variable : str
        The name of x.
    parameters : tuple of str
        The names of the parameters.
    generic : RegionVerdict
        The verdict outside of all regions.
    regions : tuple of ParameterRegion
        The other values, in their order.
    complete : bool or str
        True if the list is proven to be complete, else a sentence such as "up to degree 12 (...)".
    theory : Theory
        The theorems that prove it, a str; `sources` are the keys of the publications.
    limits : Limits
        The limits of this call and of later questions.
    notices : tuple of str
        Remarks on the input.
    assumptions : Assumptions
        The assumptions about the parameters.
    constant : ParameterPoint
        The value of the algebraic constant in S.
    equation : Equation or None
        The equation of which y'' = S y is the normal form, possibly in a function of the user's variable, its `change`; None
        if S itself was given.  Solutions of the regions solve that equation, while S belongs to the normal form.
    letters : tuple
        Parameters of S that stand for expressions, sqrt(a) and exp(a): their names, and the SymPy expressions.
    given : str
        The text that was read, with given values inserted; empty if there was none.

    Examples
    --------
    >>> import kovacic
    >>> answer = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
    >>> print(answer.regions[0], "|", answer.generic, "|", answer.complete)
    n - 1/2 in Z: case 1 | no Liouvillian solution | True
    >>> answer.case_at({"n": "1/2"}), answer.case_at({"n": 1})
    (1, None)
    """

    S: RatFunc
    variable: str
    parameters: tuple[str, ...]
    generic: RegionVerdict
    regions: tuple[ParameterRegion, ...]
    complete: bool | str
    theory: Theory
    limits: Limits = field(default=DEFAULT_LIMITS, compare=False)
    notices: tuple[str, ...] = ()
    assumptions: Assumptions = NOTHING_ASSUMED
    constant: ParameterPoint = NO_CONSTANT
    equation: Equation | None = None
    letters: Letters = ()
    given: str = field(default="", compare=False)

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters of S, those that stand for the user's among them."""
        return tuple(name for name in parameters_of(self.S.field) if name not in self.constant.names)

    @property
    def within_limits(self) -> bool:
        """True if everything was examined before any time limit."""
        return not isinstance(self.complete, Limited)

    def region_at(self, values: Values) -> ParameterRegion | None:
        """The region that contains a point; None for the generic one.

        Parameters
        ----------
        values : mapping
            A number for each parameter, as for `point`.

        Returns
        -------
        ParameterRegion or None
            The first region whose statement holds there.

        Raises
        ------
        InputError
            If a parameter has no value, or one that contradicts an assumption.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> print(bessel.region_at({"n": "3/2"}), bessel.region_at({"n": "1/3"}))
        n - 1/2 in Z: case 1 None
        """
        point = self.point(values)
        return next((region for region in self.regions if region.statement.holds(point)), None)

    def determinant(self, number: int) -> tuple[Determinant, ...]:
        """Delta_d of the conditions with a natural number d, for one d and each way in which the exponents give it.

        Parameters
        ----------
        number : int
            d, from 0.

        Returns
        -------
        tuple of Determinant
            Their `str` is a polynomial in the parameters, which must vanish.

        Raises
        ------
        InputError
            If the number isn't natural, or no region has such a condition.
        LimitExceeded
            If it takes longer than the limits allow.

        Examples
        --------
        >>> import kovacic
        >>> quartic = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x")
        >>> [str(delta) for delta in quartic.determinant(1)]
        ['a^4 - 8*a^2*c + 32*a + 16*c^2', 'a^4 - 8*a^2*c + 32*a + 16*c^2']
        """
        natural = [statement for region in self.regions for statement in region.naturals]
        if not natural:
            raise InputError("no condition has a natural number in it")
        d = whole(number, "the natural number d")
        with Budget(self.limits).watched():
            return tuple(chain.from_iterable(statement.determinants(d) for statement in natural))

    @limited
    def case_at(self, values: Values) -> int | None:
        """The case at a point; if the regions claim nothing (see `complete`), the equation is decided there.

        Parameters
        ----------
        values : mapping
            A number for each parameter, as for `point`.

        Returns
        -------
        int or None
            Kovacic's case, 1 to 3; None without a Liouvillian solution.

        Raises
        ------
        InputError
            If S isn't defined there, or a parameter has no value.
        LimitExceeded
            If it isn't decided within the limits.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> bessel.case_at({"n": "3/2"}), bessel.case_at({"n": "sqrt(2)"})
        (1, None)
        """
        point = self.point(values)
        verdict = self.predicted(point)
        if verdict is None:
            raise InputError(f"S isn't defined at {point}")
        if verdict.known:
            return verdict.case
        decision = decide(point.restricted(self.S), Budget(self.limits), certify=False)
        if decision.status is Status.UNDECIDED:
            raise LimitExceeded(str(decision.undecided), limit="seconds")
        return decision.case

    @limited
    def answer_at(self, values: Values) -> Answer:
        """The verified answer at a point, as data: `solve_at` returns it with its methods.

        Parameters
        ----------
        values : mapping
            A number for each parameter, as for `point`.

        Returns
        -------
        Answer
            Its `verified` is True, unless it is undecided.

        Raises
        ------
        InputError
            If S isn't defined there, or a parameter has no value.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> bessel.answer_at({"n": "1/2"}).case
        1
        """
        point = self.point(values)
        try:
            S = point.restricted(self.S)
        except ZeroDivisionError:
            raise InputError(f"S isn't defined at {point}") from None
        answer = Answer(S.to_str(self.variable), self.variable, S, decide(S, Budget(self.limits)), limits=self.limits)
        verified = bool(verification(answer))
        if not verified and answer.status is not Status.UNDECIDED:
            raise VerificationFailed(f"the answer for S = {S} failed its own check; please report it")
        return replace(answer, verified=verified)

    def predicted(self, values: Values) -> RegionVerdict | None:
        """The claim of the regions at a point; None if S isn't defined there.

        Parameters
        ----------
        values : mapping
            A number for each parameter, as for `point`.

        Returns
        -------
        RegionVerdict or None
            Its `known` is False if the regions aren't complete and none contains the point.

        Examples
        --------
        >>> import kovacic
        >>> print(kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").predicted({"n": "3/2"}))
        case 1
        """
        point = self.point(values)
        try:
            point.restricted(self.S)
        except ZeroDivisionError:
            return None
        region = self.region_at(point)
        if region is not None:
            return region.verdict if region.defined else None
        if self.complete is True:
            return self.generic
        return RegionVerdict(self.generic.structure, known=False)

    def point(self, values: Values) -> ParameterPoint:
        """The values of the parameters as constants of one field; a point is returned unchanged.

        Parameters
        ----------
        values : mapping
            A number for each parameter, rational or algebraic: {"n": Fraction(3, 2)}, {n: sqrt(2)}, {"n": "sqrt(2)"}.

        Returns
        -------
        ParameterPoint
            A point, which `region_at`, `case_at`, `answer_at` and `predicted` accept, too.

        Raises
        ------
        InputError
            If a parameter has no value, or one that contradicts an assumption.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> print(bessel.point({"n": "3/2"}))
        n = 3/2
        """
        from sympy import Basic, Expr

        if isinstance(values, ParameterPoint):
            return values
        given = {str(name): value for name, value in values.items()}
        check_values(given, self.parameters)
        for name, value in given.items():
            number = value if isinstance(value, Basic) else read_expression(number_text(value, self.limits))
            if not isinstance(number, Expr) or number.free_symbols:
                raise InputError(f"the values of parameters are numbers, not {value!r}")
            given[name] = number
        given |= values_of_letters(given, self.letters)
        point = _point(self.names, [given[name] for name in self.names], self.constant, self.limits)
        for name, value in zip(point.names, point.values, strict=True):
            if not self.assumptions.of(name).admits(value):
                raise InputError(f"{name} = {value.to_str()} contradicts the assumption: {self.assumptions}")
        return point

    def to_json(self) -> str:
        """One line of JSON: parameters, generic, regions.

        Returns
        -------
        str
            `from_json` reads it.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> bessel.to_json()[:40]
        '{"S": "(-4*x**2 + 4*n**2 - 1)/(4*x**2)",'
        """
        return json_line(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """The JSON object as plain Python values.

        Returns
        -------
        dict
            With the keys S, variable, parameters, assumptions, generic, regions, complete, theory, notices, equation, given.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> data = bessel.to_dict()
        >>> data["parameters"], [region["condition"] for region in data["regions"]]
        (['n'], ['n - 1/2 in Z'])
        """
        return {
            "S": self.S.to_str(self.variable),
            "variable": self.variable,
            "parameters": list(self.parameters),
            "assumptions": self.assumptions.to_dict(),
            "generic": {
                "case": self.generic.case,
                "group": self.generic.group,
                "verdict": record.verdict_data(self.generic),
            },
            "regions": [*map(record.region_data, self.regions)],
            "complete": self.complete,
            "theory": str(self.theory),
            "theorem": {"said": self.theory.literal, "sources": list(self.theory.sources)},
            "notices": list(self.notices),
            "equation": record.equation_data(self.equation),
            **({"given": self.given} if self.given else {}),
            **({} if self.within_limits else {"within_limits": False}),
            **({"names": list(self.names)} if self.letters else {}),
            **record.constant_data(self.constant),
        }

    @classmethod
    def from_json(cls, text: str | Mapping[str, Any]) -> ParametricAnswer:
        """The conditions that `to_json` wrote; solutions of regions are found anew on demand.

        Parameters
        ----------
        text : str or mapping
            The line of JSON, or the object that it stands for.

        Returns
        -------
        ParametricAnswer
            An object of the class that it is called on.

        Raises
        ------
        InputError
            For any other data.

        Examples
        --------
        >>> import kovacic
        >>> answer = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1")
        >>> type(answer).from_json(answer.to_json()) == answer
        True
        """
        import json

        try:
            data = json.loads(text) if isinstance(text, str) else text
            parameters = tuple(data["parameters"])
            names = tuple(data.get("names", parameters))
            variable = data["variable"]
            theorem = data.get("theorem", {"said": data["theory"], "sources": ()})
            constant = record.constant_from(data)
            # Names that are no parameters of the user's are formulas, and numbers.
            letters = tuple((name, read_expression(name)) for name in names if name not in parameters)
            if not all(name.isidentifier() for name in (*parameters, variable)):
                raise ValueError("a parameter or the variable isn't a name")
            field = FunctionField((*names, *constant.names))
            reader = record.StatementReader(field)
            read = [*map(reader.region, data["regions"])]
            assumptions = read_assumptions(data["assumptions"] or None, None, names)
            regions = settled_regions(read, setting_of(variable, field.names, constant, letters, assumptions))
            answer = cls(
                variable=variable,
                parameters=parameters,
                letters=letters,
                regions=tuple(regions),
                generic=record.verdict_from(data["generic"]["verdict"]),
                complete=data["complete"] if data.get("within_limits", True) else Limited(data["complete"]),
                theory=Theory(theorem["said"], *theorem["sources"]),
                assumptions=assumptions,
                S=reader.function(data["S"], variable),
                notices=tuple(data["notices"]),
                constant=constant,
                equation=record.equation_from(data.get("equation"), variable, names, constant),
                given=str(data.get("given", "")),
            )
        except (KeyError, TypeError, ValueError, AttributeError, IndexError, RecursionError) as error:
            raise InputError(f"this isn't the JSON of conditions: {error}") from None
        regions = [replace(region, origin=Later(partial(_origin_of, answer, region.statement))) for region in regions]
        return replace(answer, regions=tuple(regions))

    @property
    def right(self) -> Math:
        """S y."""
        return Formulas(self.variable, self.S.field).times(self.S, "y")


@lru_cache(maxsize=16)
def _origins(answer: ParametricAnswer) -> dict[Statement, SolutionsByDegree | None]:
    """The solutions of the regions by their statements, found from S."""
    # An algebraic constant isn't a parameter of this S.
    S = everywhere(over_parameters(answer.S.num).field, answer.constant).restricted(answer.S)
    found = derived(S, answer.variable, answer.equation, answer.assumptions, Budget(answer.limits), 0, answer.letters)
    return {region.statement: region.formulas for region in found.regions}


def _origin_of(answer: ParametricAnswer, statement: Statement) -> SolutionsByDegree | None:
    return _origins(answer).get(statement)


def _point(names: tuple[str, ...], values: list[Any], constant: ParameterPoint, limits: Limits) -> ParameterPoint:
    """SymPy's numbers as constants of one field, together with the constant of S."""
    import sympy

    # Read together, as coefficients of powers of x_, they lie in one field.
    x = sympy.Symbol("x_")
    terms = [value * x**k for k, value in enumerate(values)]
    read = read_input(sympy.Add(*terms), var="x_", limits=limits).S
    if read.field.ground != QQ:
        raise InputError("the values of parameters are rational or algebraic numbers")
    numbers = [read.num[k] for k in range(len(values))]
    field = read.field
    if field == QQ:
        field = constant.field
        numbers = [number.over(field) for number in (*numbers, *constant.values)]
    elif isinstance(constant.field, AlgebraicField):
        numbers = with_root(numbers, field, constant.field, limits)
        field = numbers[-1].field
    return ParameterPoint((*names, *constant.names), tuple(numbers), field)
