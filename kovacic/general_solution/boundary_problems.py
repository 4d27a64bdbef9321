"""Boundary problems: the values of a parameter for which there are solutions other than 0.

`eigenvalues` has them in proven balls; `eigenfunctions` are formulas for two homogeneous conditions at two points and an
equation with lambda (or mu) in it, such as y'' + lambda y = 0, y(0) = y(L) = 0.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from typing import Any

import sympy
from sympy import Symbol, Tuple, oo, simplify

from kovacic.closed_form.atoms import is_seen_negative
from kovacic.closed_form.order import ball
from kovacic.enclosure.request import Accuracy, digits_and_limits
from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.conditions import Condition, apart, periodicity, read_conditions, symbols_of
from kovacic.general_solution.question import Question, free_constants
from kovacic.limits import DEFAULT_LIMITS, Limits, limited
from kovacic.numbers.exact import exact_text, whole
from kovacic.reading.names import words_among
from kovacic.reading.source import parts_of, source_of
from kovacic.reading.symbolic import read_expression
from kovacic.sturm_liouville.families import EigenvalueFamily, family
from kovacic.sturm_liouville.levels import Eigenvalues
from kovacic.sturm_liouville.problem import Bounded, Robin, SturmProblem, Wish, normal_form
from kovacic.sturm_liouville.solve import Eigenproblem
from kovacic.writing.formula import free_name

Expr = Any  # SymPy publishes no types
PARAMETER = "lambda"
_INFINITE_ENDS = {"oo": oo, "+oo": oo, "inf": oo, "-oo": -oo, "-inf": -oo}


@limited
def eigenvalues(
    equation: Any,
    conditions: Mapping[Any, Any] | str | None = None,
    *,
    parameter: str = PARAMETER,
    domain: Sequence[Any] | None = None,
    count: int = 5,
    var: str | None = None,
    params: Mapping[Any, Any] | None = None,
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> Eigenvalues:
    """The lowest eigenvalues of a Sturm-Liouville problem, each in a proven ball, none left out.

    The equation is a y'' + b y' + (c0 + lambda c1) y = 0 with real coefficients, c1/a positive or negative, and without
    singular points inside the interval.  Eigenvalue number k is proven by counts of zeros (Sturm) in ball arithmetic: k
    eigenvalues are below the lower end of its ball, and k + 1 below the upper one.

    Parameters
    ----------
    equation : str or sympy.Expr
        The equation, linear in the parameter: "y'' + lambda*y = 0", "-y'' + x^4*y = E*y".  Coefficients are elementary
        functions of x; absolute values, steps and cases are split into pieces.
    conditions : str or mapping, optional
        Homogeneous ones at the two ends, as for `dsolve`: "y(0)=0, y(1)+y'(1)=0"; periodic ones, "y(0)=y(1),
        y'(0)=y'(1)", or antiperiodic ones.  At a singular or infinite end none is needed: the solution is the one that is
        smaller than all others, and y(0) = 0, y(0) = "bounded" or y(oo) = 0 may say so.
    parameter : str
        The name of the eigenvalue.
    domain : pair, optional
        The ends, if the conditions don't name both; by default the whole line.
    count : int
        The number of eigenvalues; fewer are returned if there are no more.
    var : str, optional
        The name of the variable.
    params : mapping, optional
        Values of the other parameters.
    accuracy, digits, limits
        The fields of `Accuracy` except a method: digits of each eigenvalue, relative to its size, or to a thousandth of the
        mean distance of eigenvalues if that is larger.

    Returns
    -------
    Eigenvalues
        A sequence of `Level`, each with its `value`, a `Ball`, and the number of `zeros` of its eigenfunction.
        `complete` is True if there are no others; `notes` list what was assumed, and what isn't proven.

    Raises
    ------
    InputError
        For any other problem: with a singular point inside, an end with two square integrable solutions and no condition
        (limit circle), or a potential that isn't bounded below.
    LimitExceeded
        If levels aren't found or separated within the limits.

    Examples
    --------
    >>> import kovacic
    >>> print(kovacic.eigenvalues("-y'' + x^4*y = E*y", parameter="E", count=2, digits=10))
    E = 1.06036209048 ± 3.1e-11  (0 zeros)
    E = 3.79967302980 ± 9.7e-11  (1 zero)
    >>> kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=y(1), y'(0)=y'(1)", count=3)[2].alone
    False

    References: A. Zettl, Sturm-Liouville Theory, AMS 2005; J. D. Pryce, Numerical Solution of Sturm-Liouville
    Problems, 1993.
    """
    digits, limits = digits_and_limits("eigenvalues", accuracy=accuracy, digits=digits, limits=limits)
    problem = read_eigenproblem(
        equation, conditions, parameter=parameter, domain=domain, var=var, params=params, limits=limits
    )
    for _ in problem.levels(whole(count, "count", least=1), digits):
        pass
    return problem.answer()


_PARAMETERS = ("lambda", "lamda", "λ", "mu", "μ")


def read_eigenproblem(
    equation: Any,
    conditions: Mapping[Any, Any] | str | None = None,
    *,
    parameter: str = PARAMETER,
    domain: Sequence[Any] | None = None,
    var: str | None = None,
    params: Mapping[Any, Any] | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Eigenproblem:
    """The problem of `eigenvalues`, with levels that are computed one by one.  Raises `InputError`."""
    values = {Symbol(str(k)): read_expression(exact_text(value, str(k))) for k, value in (params or {}).items()}
    equation, conditions = apart(equation, conditions)
    function, coefficients = _linear_in_parameter(equation, var, parameter, values, limits)
    x = function.args[0]
    if not isinstance(conditions, Mapping | str | None):
        raise InputError("conditions are a text or a mapping", hint='"y(0)=0, y(1)=0"')
    given = [condition.in_symbols(values) for condition in read_conditions(conditions, function)]
    ends = _interval_ends(given, domain)
    wrap, wishes = wishes_of(given, ends)
    pieces, B, sign = normal_form(x, coefficients, ends)
    problem = SturmProblem(x, pieces, wishes, wrap, B, sign)
    if wrap and any(end.is_infinite for end in problem.ends):
        raise InputError("periodic conditions need a finite interval")
    if wrap and simplify(sympy.integrate(problem.B, (problem.x, *problem.ends))) != 0:
        raise InputError("with p(a) different from p(b) periodic conditions don't belong to a symmetric problem")
    return Eigenproblem(problem, parameter)


def _linear_in_parameter(
    equation: Any, var: str | None, parameter: str, values: Mapping[Expr, Expr], limits: Limits
) -> tuple[Expr, tuple[Expr, Expr, Expr, Expr]]:
    """y(x) and a, b, c0, c1 of an equation that is linear in the parameter.  Raises `InputError`."""
    source = source_of(equation, var, limits, equation=True, names=words_among((parameter, *map(str, values))))
    parts, _ = parts_of(source)
    a, b, c, rest = (sympy.sympify(part).xreplace(values) for part in parts)
    x = Symbol(source.variable)
    symbol = _parameter_among(Tuple(a, b, c).free_symbols - {x}, parameter)
    c1 = simplify(c.diff(symbol))
    if rest != 0 or Tuple(a, b, c1).has(symbol):
        raise InputError(
            f"a y'' + b y' + (c0 + {parameter} c1) y = 0 is expected, linear in y and in {parameter}",
            hint=f"where {parameter}^2 stands, call that {parameter}",
        )
    if c1 == 0:
        raise InputError(f"the parameter {parameter} cancels out of the equation")
    return sympy.Function(source.unknown)(x), (a, b, sympy.expand(c - symbol * c1), c1)


def _parameter_among(symbols: Collection[Expr], parameter: str) -> Expr:
    """The symbol with this name.  Raises `InputError` if there is none, or another one."""
    names = sorted(s.name for s in symbols)
    if parameter == PARAMETER and "λ" in names:
        parameter = "λ"
    if parameter not in names:
        said = f"names in it: {', '.join(names) or 'none'}"
        raise InputError(
            f"the parameter {parameter} doesn't occur in the equation",
            hint=f'{said}; parameter="E" names another',
            shell=f"{said}; --parameter E names another",
        )
    names.remove(parameter)
    if names:
        raise InputError(
            f"eigenvalues are numbers: values are needed for {', '.join(names)}",
            hint=f"params={dict.fromkeys(names, 3)}, for instance",
            shell=" ".join(f"--param {name}=3" for name in names) + ", for instance",
        )
    return next(iter(symbols))


def _interval_ends(conditions: Sequence[Condition], domain: Sequence[Any] | None) -> tuple[Expr, Expr]:
    """The ends of the interval, from the points of the conditions and the given domain."""
    terms = [term for condition in conditions for term in condition.terms]
    points = {term.point for term in terms}
    for what, number in [("end", p) for p in points] + [("coefficient", term.coefficient) for term in terms]:
        if number.free_symbols:
            raise InputError(
                f"eigenvalues are numbers: the {what} {number} isn't one",
                hint="params={...} gives values",
                shell="--param NAME=NUMBER gives a value",
            )
    ends = ([*points] or [-oo, oo]) if domain is None else read_domain(domain)
    if not points <= {*ends}:
        raise InputError("the conditions are at points that aren't the ends of the domain")
    if len(ends) != 2:
        raise InputError(
            f"the conditions name {len(ends)} points, and an interval has two ends", hint='domain=(0, "oo") gives both'
        )
    low, high = sorted(ends, key=_position_of)
    if not _position_of(low) < _position_of(high):
        raise InputError("the interval is empty")
    return low, high


def read_domain(domain: Sequence[Any]) -> list[Expr]:
    """Two ends: numbers, expressions or infinite.  Raises `InputError` for anything else."""
    if isinstance(domain, str) or len(domain) != 2:
        raise InputError("a domain is a pair of ends", hint='domain=(0, "oo")')
    texts = [exact_text(value, "an end of the domain") for value in domain]
    return [_INFINITE_ENDS.get(text) or read_expression(text, what="an end of the domain") for text in texts]


def _position_of(end: Expr) -> float:
    if end.is_infinite:
        return float("inf") if end is oo else -float("inf")
    return float(ball(end).mid())


def wishes_of(conditions: Sequence[Condition], ends: tuple[Expr, Expr]) -> tuple[int, tuple[Wish, Wish]]:
    """1 for periodic conditions, -1 for antiperiodic and 0 for separated ones, and these.  Raises `InputError` for others."""
    for condition in conditions:
        if condition.value not in (None, 0):
            raise InputError(
                f"{condition.text}: the conditions of eigenvalue problems are homogeneous, with 0 on one side"
            )
    if any(len(set(condition.points)) > 1 for condition in conditions):
        wrap = periodicity(conditions, ends)
        if not wrap:
            a, b = ends
            raise InputError(
                "conditions on both ends together are periodic or antiperiodic ones",
                hint=f"y({a}) = y({b}), y'({a}) = y'({b}), or both with a minus sign",
            )
        return wrap, (None, None)
    wishes: list[Wish] = [None, None]
    for condition in conditions:
        side = ends.index(condition.points[0])
        if wishes[side] is not None:
            raise InputError(f"two conditions at {condition.points[0]}", hint="one at each end is needed")
        wishes[side] = Bounded() if condition.value is None else Robin(*condition.by_order)
    return 0, (wishes[0], wishes[1])


# ----------------------------------------------------------------------------------------------------- eigenfunctions


def eigenfunctions(question: Question) -> tuple[Expr, list[str]] | None:
    """y with a number n or lambda in it, and notices about the values of lambda; None if that isn't the question."""
    conditions = _homogeneous_conditions(question)
    if conditions is None:
        return None
    ends, wrap, wishes = conditions
    x = question.x
    a, b, c, right = question.coefficients
    parameter = next((s for s in c.free_symbols if s.name in _PARAMETERS), None)
    if parameter is None or right != 0:
        return None
    B, c = simplify(b / a), simplify(c / a)
    c1 = simplify(c.diff(parameter))
    letters = Tuple(B, c1).free_symbols | symbols_of(question.conditions)
    if c1 == 0 or parameter in letters:
        return None
    c0 = simplify(c - parameter * c1)
    taken = {s.name for s in letters | c0.free_symbols}
    n = Symbol(free_name(taken, *"nkmj"), integer=True)
    sign = -1 if is_seen_negative(c1) else 1
    found = family(x, B, c0, sign * c1, sign * parameter, ends, wrap or wishes, n=n)
    if found is None:
        return None
    residues = (y.diff(x, 2) + B * y.diff(x) + (c0 + sign * found.value * c1) * y for y in found.functions)
    if any(simplify(residue) != 0 for residue in residues):
        return None
    constants = free_constants(2, *letters, c0, question.function)
    y = sympy.Add(*(constant * function for constant, function in zip(constants, found.functions, strict=False)))
    said = _said_of_eigenvalue(found, parameter, sign)
    if found.equation is not None and not taken - {x.name}:
        pieces, B, sturm_sign = normal_form(x, (sympy.S.One, B, c0, c1), ends)
        problem = Eigenproblem(SturmProblem(x, pieces, wishes, 0, B, sturm_sign), "lambda")
        with suppress(InputError, LimitExceeded):
            roots = ", ".join(str(level.value) for level in problem.levels(3, digits=15))
            said = f"{said}: {parameter} = {roots}, ..."
    return y, [f"{said}; for all other {parameter} {question.function} is 0"]


def _homogeneous_conditions(question: Question) -> tuple[tuple[Expr, Expr], int, Any] | None:
    """The two ends, and the conditions as `wishes_of` returns them; None for others."""
    given = question.conditions
    points = sorted({point for condition in given for point in condition.points}, key=sympy.default_sort_key)
    is_homogeneous = len(given) == 2 and all(condition.value == 0 for condition in given)
    if not is_homogeneous or len(points) != 2 or any(point.is_infinite for point in points):
        return None
    low, high = points
    if is_seen_negative(high - low):
        low, high = high, low
    with suppress(InputError):  # other conditions
        return (low, high), *wishes_of(given, (low, high))
    return None


def _said_of_eigenvalue(found: EigenvalueFamily, parameter: Expr, sign: int) -> str:
    """The values of the parameter, which is the eigenvalue times a sign, in words."""
    if found.equation is None:
        numbers = ", ".join(str(found.first + k) for k in range(3))
        return f"this holds for {parameter} = {sign * found.value} with {found.n} = {numbers}, ..."
    shift = sign * found.shift
    said = f"this holds for the solutions of {found.equation.lhs} = {found.equation.rhs}"
    if found.zero == 0:
        return f"{said} and for {shift}"
    said = f"{said} other than {shift}"
    if found.zero.free_symbols:
        return f"{said} (that is one only if {found.zero} = 0)"
    return said
