"""`special_functions`: two solutions in special functions as SymPy expressions, or which classes were searched in vain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Problem, analyse
from kovacic.errors import LimitExceeded, VerificationFailed
from kovacic.limits import Budget, bounded_work
from kovacic.numbers.numerals import as_latex, as_text
from kovacic.special.gauge import EQUATIONS, GaugeTransform, transforms
from kovacic.special.maps import irregular_places
from kovacic.special.pullback import Pullback, StandardEquation

if TYPE_CHECKING:
    from kovacic.algebra.poly import Poly
    from kovacic.closed_form.atoms import Expr
    from kovacic.special.writer import Writer, WrittenPair

#: What is sought where none of them is found.
GAUGED = "a v + b v' over these"
#: Units of work for that.
_TRANSFORM_WORK = 30_000


@dataclass(frozen=True)
class SpecialFunctions:
    """Two solutions in special functions; true where they were found, and iterating gives both.

    That nothing was found proves nothing: functions f outside of the classes aren't looked for.

    Attributes
    ----------
    pullback : Pullback or None
        The verified pull-back of a standard equation that the solutions come from; None where nothing was found.
    searched : tuple of str
        The classes that were gone through.
    stopped : str or None
        Why a search ended early.
    y1, y2 : sympy.Expr or None
        The solutions.
    pair : WrittenPair or None
        Both, with their Wronskian and what makes one of them undefined.
    transform : GaugeTransform or None
        Where the solutions are a v + b v' for solutions v of the pull-back: a and b, verified exactly.

    Examples
    --------
    >>> import kovacic
    >>> found = kovacic.solve("x").special
    >>> bool(found), *found
    (True, airyai(x), airybi(x))
    >>> print(kovacic.solve("x^5 + 1/x^3").special)
    no special function was found; searched: Airy's equation in f(x), f rational; Whittaker's equation (with Kummer's, Weber's and Bessel's) in f(x), f rational; Bessel's equation in the square root of f(x), f rational; a v + b v' over these
    """  # noqa: E501 - the last line is printed

    pullback: Pullback | None
    searched: tuple[str, ...]
    stopped: str | None = None
    pair: WrittenPair | None = field(default=None, repr=False)
    transform: GaugeTransform | None = None

    @property
    def y1(self) -> Any:
        return None if self.pair is None else self.pair.y1

    @property
    def y2(self) -> Any:
        return None if self.pair is None else self.pair.y2

    @property
    def solutions(self) -> tuple[Any, ...]:
        """(y1, y2), or () where nothing was found."""
        return () if self.pair is None else tuple(self.pair)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.solutions)

    def __bool__(self) -> bool:
        return self.pullback is not None

    def __repr__(self) -> str:
        found = f"{as_text(self.y1)}, {as_text(self.y2)}" if self else "none was found"
        return f"<SpecialFunctions: {found}>"

    def _repr_latex_(self) -> str | None:
        if self.pullback is None:
            return None
        return rf"$y_1 = {as_latex(self.y1)},\quad y_2 = {as_latex(self.y2)}$"

    def __str__(self) -> str:
        if self.pullback is not None:
            return f"y1 = {as_text(self.y1)}\ny2 = {as_text(self.y2)}"
        if self.stopped:
            return f"no special function was found: {self.stopped}"
        return f"no special function was found; searched: {'; '.join(self.searched)}"


def find(S: RatFunc, budget: Budget, *, extended: bool = True) -> SpecialFunctions:
    """The first pull-back of one of the `EQUATIONS` that gives S, checked exactly; not yet written.

    Without `extended`, functions f over a larger field than that of S aren't sought.  An exhausted budget is a value: `stopped`
    is its sentence.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> found = find(x**4 + 2 * x, Budget()).pullback
    >>> print(found.equation.q, found.equation.r, found.equation.M, found.f)
    1 2/3 -2/9 -x**3/3
    """
    searched: tuple[str, ...] = ()
    try:
        with budget.watched():
            problem = analyse(S, budget)
            irregular = bool(irregular_places(problem))
            equations = [equation for equation in EQUATIONS if equation.irregular == irregular]
            searched = tuple(equation.searched for equation in equations)
            return SpecialFunctions(_first(problem, equations, extended=extended), searched)
    except LimitExceeded as limit:
        return SpecialFunctions(None, searched, str(limit))


def _first(problem: Problem, equations: list[type[StandardEquation]], *, extended: bool) -> Pullback | None:
    """Raises `LimitExceeded` in the end where a limit on constants kept one of the equations from being sought."""
    stopped: LimitExceeded | None = None
    for equation in equations:
        try:
            for pullback in equation.candidates(problem, extended=extended):
                problem.budget.check()
                if pullback.gives(problem.S):
                    return pullback
        except LimitExceeded as limit:
            if limit.limit != "constants":
                raise
            stopped = limit
    if stopped is not None:
        raise stopped
    return None


def special_functions(
    S: RatFunc,
    gauge: RatFunc,
    variable: str,
    budget: Budget,
    *,
    symbols: Mapping[str, Any] | None = None,
    joined: bool = False,
) -> SpecialFunctions:
    """Solutions of the equation that was given, those of y'' = S y times the gauge factor exp(int gauge dx).

    `symbols` are SymPy's symbols for the parameters by name; the expressions are in these, and what is assumed about them is
    used: with n a natural number, Hermite's equation has `hermite(n, x)`.  With `joined`, solutions are analytic at ordinary
    points where the argument of Bessel's functions is zero: series 0F1 instead of these.  The pull-back is verified exactly, in
    rational functions; what is shown is checked at a point, to 50 digits.  Liouvillian solutions aren't looked for, but where
    the group is reducible the two solutions may be dependent for some values of the parameters.

    >>> import kovacic
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - n^2)*y = 0")
    >>> print(special_functions(answer.S, answer.gauge, "x", Budget()))
    y1 = besselj(n, x)
    y2 = bessely(n, x)
    """
    search = find(S, budget)
    source: Pullback | GaugeTransform | None = search.pullback
    searched = search.searched
    if source is None and search.stopped is None:
        source = find_transform(S, budget)
        searched = (*searched, GAUGED)
    if source is None:
        return replace(search, searched=searched)
    try:
        with budget.watched():
            found = written_pair(source, S, gauge, variable, symbols or {}, joined=joined)
    except LimitExceeded as limit:
        return SpecialFunctions(None, searched, str(limit))
    if found is None:
        said = "the assumptions don't tell which solutions are independent"
        return SpecialFunctions(None, searched, said)
    if isinstance(source, GaugeTransform):
        return SpecialFunctions(source.pullback, searched, None, found, source)
    return SpecialFunctions(source, searched, None, found)


def find_transform(S: RatFunc, budget: Budget) -> GaugeTransform | None:
    """y = a v + b v' for a pull-back of one of the `EQUATIONS`, checked exactly; None where a limit is reached, too.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> found = find_transform(x + 3 / (4 * x**2), Budget())  # Ai'(x)/sqrt(x)
    >>> print(found.pullback.equation.name, found.pullback.f, found.m, found.a)
    Airy's x x 0
    """
    try:
        with budget.watched(), bounded_work(_TRANSFORM_WORK):
            return next((found for found in transforms(analyse(S, budget)) if found.gives(S)), None)
    except LimitExceeded:
        return None


def written_pair(
    source: Pullback | GaugeTransform,
    S: RatFunc,
    gauge: RatFunc,
    variable: str,
    symbols: Mapping[str, Any],
    *,
    joined: bool,
) -> WrittenPair | None:
    """y1 and y2, checked at a point; None where the assumptions on the symbols leave open which solutions are independent.

    Raises `VerificationFailed` if the check fails, which is a defect of this package; `LimitExceeded` within `Budget.watched`.
    """
    import sympy

    from kovacic.special.writer import Writer

    transform = source if isinstance(source, GaugeTransform) else None
    pullback = source.pullback if isinstance(source, GaugeTransform) else source
    writer = Writer(gauge, sympy.Symbol(variable), symbols, transform)
    found = pullback.equation.written(writer, pullback.f, S.den if joined else None)
    for y in found or ():
        _check(y, writer.atoms.x, S, gauge)
    return None if found is None else _in_own_symbols(found, writer)


def _check(y: Expr, x: Any, S: RatFunc, gauge: RatFunc) -> None:
    """Raises `VerificationFailed` where it isn't a solution, to 50 digits at a point."""
    from kovacic.closed_form.check import is_numerical_solution

    if not is_numerical_solution(y, x, S, gauge):
        said = f"a special function for S = {S} failed its check; please report the equation: {y}"
        raise VerificationFailed(said)


@dataclass(frozen=True)
class BySign:
    """Solutions where an integer that depends on parameters isn't negative, and where it is; None where none are known."""

    integer: Any
    natural: WrittenPair
    negative: WrittenPair | None


def by_sign(
    S: RatFunc, gauge: RatFunc, variable: str, budget: Budget, *, symbols: Mapping[str, Any], joined: bool
) -> BySign | None:
    """Solutions by the sign of an integer: where polynomials have names, or where it tells which solutions are independent.

    Arguments as for `special_functions`; None where the sign of no integer helps.

    >>> import kovacic, sympy
    >>> n, l = sympy.symbols("n l", integer=True, positive=True)
    >>> answer = kovacic.solve("x^2*y'' + 2*x*y' + (2*x - x^2/n^2 - l*(l + 1))*y = 0", var="x")
    >>> found = by_sign(answer.S, answer.gauge, "x", Budget(), symbols={"n": n, "l": l}, joined=False)
    >>> print(found.integer, "|", found.natural.y1)
    -l + n - 1 | x**l*exp(-x/n)*assoc_laguerre(-l + n - 1, 2*l + 1, 2*x/n)
    """
    if not any(symbol.is_integer for symbol in symbols.values()):
        return None
    pullback = find(S, budget).pullback
    if pullback is None:
        return None
    import sympy

    from kovacic.special.writer import Writer

    writer = Writer(gauge, sympy.Symbol(variable), symbols)
    best = None
    try:
        with budget.watched():
            for found in _helpful(pullback, writer, S.den if joined else None):
                best = best or found
                if found.negative is not None:
                    best = found
                    break
            if best is None:
                return None
            for y in (*best.natural, *(best.negative or ())):
                _check(y, writer.atoms.x, S, gauge)
    except LimitExceeded:
        return None
    negative = None if best.negative is None else _in_own_symbols(best.negative, writer)
    return BySign(best.integer.xreplace(_own_symbols(writer)), _in_own_symbols(best.natural, writer), negative)


def _helpful(pullback: Pullback, writer: Writer, singular: Poly | None) -> Iterator[BySign]:
    """What each integer gives whose sign is open: solutions that are known only by it, or polynomials that have names."""
    import sympy

    equation = pullback.equation
    whole = equation.written(writer, pullback.f, singular)
    for number in dict.fromkeys(equation.integers(writer, pullback.f)):
        if not writer.is_integer(number):
            continue
        is_sign_known = writer.is_natural(number) or writer.is_natural(-number - 1)
        if is_sign_known:
            continue
        value = writer.constant(number)
        natural = _assuming(writer, value, pullback, singular)
        if natural is None or natural == whole:
            continue
        if whole is None:
            yield BySign(value, natural, _assuming(writer, -value - 1, pullback, singular))
        elif any(y.has(sympy.assoc_legendre, sympy.assoc_laguerre) for y in natural):
            yield BySign(value, natural, whole)


def _own_symbols(writer: Writer) -> dict[Any, Any]:
    """The user's symbols, which carry assumptions, for those that were computed with."""
    return {plain: symbol for plain, symbol in writer.symbols.items() if plain != symbol}


def _in_own_symbols(pair: WrittenPair, writer: Writer) -> WrittenPair:
    """Both solutions in the user's symbols."""
    own = _own_symbols(writer)
    return pair.mapped(lambda e: e.xreplace(own))


def _assuming(writer: Writer, value: Any, pullback: Pullback, singular: Poly | None) -> WrittenPair | None:
    """The solutions where the value is natural."""
    informed = writer.assuming(value)
    return None if informed is None else pullback.equation.written(informed, pullback.f, singular)
