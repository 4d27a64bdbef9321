"""`special_functions`: two solutions in special functions as SymPy expressions, or the classes searched without success.

Where no pull-back is found, gauge transformations are sought: y = a v + b v' takes the solutions of
v'' = T v to those of y'' = S y exactly if, with D = S - T,

    2 a' = b D - b'',        a'' = a D - 2 b' T - b T';        then  a^2 + a b' - a' b - b^2 T  is constant.            (1)

So b determines a, and is a solution of one equation of order four, that of the products y_i v_j:

    2 D a = (b D - b'')' + 4 T b' + 2 T' b,        2 a' = b D - b''.                                                   (2)

Targets T are the pull-backs of standard equations that agree with S in what such a transformation keeps: the polar parts of
sqrt(S) at the irregular places, which give f, and the exponent differences up to integers, which give the parameters; apparent
singularities count for nothing.

b lies in sqrt(m) K(x), m without squares.  At a regular place the products have the exponents 1 +- (Delta_S +- Delta_T)/2, of
which those count that are in Z/2; their parity tells whether m vanishes there.  At an irregular place of order k (S = t^-k ...)
they are k/2 +- n/2, n/2 the difference of the residues of sqrt(S) and sqrt(T) (k = 2 at regular places, and k - 4 for k at
infinity, where t = 1/x).  So what remains of b is a polynomial of bounded degree: one linear system, which is looked at modulo
a prime first.

Reference: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; M. van Hoeij, W. Koepf, S. Yuan, J. Symb. Comp. 2015.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import product, zip_longest
from typing import TYPE_CHECKING, Any

from flint import nmod_mat

from kovacic.algebra.factors import dependence
from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative, over_one_denominator
from kovacic.engine.places import Place, Problem, analyse, rational_square_root
from kovacic.equation import parameters_of
from kovacic.errors import LimitExceeded, VerificationFailed
from kovacic.limits import Budget, bounded_work, count_work
from kovacic.numbers.numerals import as_latex, as_text
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.maps import TRIAL, integral_of_square_root, irregular_places, scales
from kovacic.special.pullback import GaugeTransform, Pullback, StandardEquation
from kovacic.special.whittaker import Whittaker

if TYPE_CHECKING:
    from kovacic.special.writer import Wanted, Writer, WrittenPair

#: In the order in which they are tried.
EQUATIONS: tuple[type[StandardEquation], ...] = (Airy, Whittaker, Bessel, Gauss)
#: Units of work for the search for a pull-back, and for that for a gauge transformation: a second, or a thousand functions f.
SEARCH_WORK = 30_000


def _pullback_candidates(problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
    """Pull-backs to be verified; `LimitExceeded` in the end if the limit on constants cut off one of the equations."""
    stopped: LimitExceeded | None = None
    for equation in _equations(problem):
        try:
            for pullback in equation.candidates(problem, extended=extended, shifted=shifted):
                problem.budget.check()
                yield pullback
        except LimitExceeded as limit:
            if limit.limit != "constants":
                raise
            stopped = limit
    if stopped is not None:
        raise stopped


def _equations(problem: Problem) -> list[type[StandardEquation]]:
    """The standard equations whose pull-backs have irregular singular points exactly if S has some."""
    irregular = bool(irregular_places(problem))
    return [equation for equation in EQUATIONS if equation.irregular == irregular]


# ------------------------------------------------------------------------------------------ orders of b

_Order = tuple[Place, int]
"""A place, and twice the least order of b there."""


def _transformation(problem: Problem, target: Problem) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b, or None."""
    own, other = ({(p.at_infinity, p.factor): p for p in given.places} for given in (problem, target))
    options = []
    for key, place in (own | other).items():
        ordinary = replace(place, order=0)
        possible = _orders(own.get(key, ordinary), other.get(key, ordinary))
        if not possible:
            return None
        options.append(possible)
    for orders in product(*options):
        is_square = not sum(least % 2 * place.degree for place, least in orders) % 2
        found = _solved_system(problem.S, target.S, orders) if is_square else None
        if found is not None:
            return found
    return None


def _orders(first: Place, second: Place) -> list[_Order]:
    """The possible orders for each parity; none if an invariant differs."""
    order = max(2, first.order, second.order)
    base = order - 4 if first.at_infinity else order
    found: dict[int, _Order] = {}
    for n in sorted(_shifts(first, second), reverse=True):
        for least in (base - n, base - n + 1) if order % 2 else (base - n,):
            found.setdefault(least % 2, (first, least))
    return list(found.values())


def _shifts(first: Place, second: Place) -> list[int]:
    """Integer differences of exponents of y and v: |Delta_S -+ Delta_T| at regular places, else twice the residues'."""
    squares: list[Poly] = []
    A, B = first.delta_squared, second.delta_squared
    if max(first.order, second.order) > 2:
        if first.order == second.order:
            squares = [first.factor * 0] if first.order % 2 else _squares_of_residues(first, second)
    elif A is not None and B is not None:
        # n^2 = A + B -+ 2 sqrt(A B), whether the roots of A and B lie in the field or not
        root = A.field.sqrt(A * B)
        squares = [] if root is None else [A + B - 2 * root, A + B + 2 * root]
    elif A is B:
        squares = [first.factor * 0]
    return [int(n) for square in squares if (n := rational_square_root(square)) is not None and n.denominator == 1]


def _squares_of_residues(first: Place, second: Place) -> list[Poly]:
    """The square of twice the difference of the residues of sqrt(S) and sqrt(T), if their polar parts agree."""
    for q in scales([second], 2):
        own = integral_of_square_root(first, q)
        other = integral_of_square_root(second, q)
        for sign in (1, -1):
            if own is not None and other is not None and own.part == other.part * sign:
                return [4 * q * (own.residue - other.residue * sign) ** 2]
    return []


# ------------------------------------------------------------------------------------------ a and b

_Operator = list[RatFunc]
"""c_0 B + c_1 B' + ..., times a function u."""


def _solved_system(S: RatFunc, T: RatFunc, orders: Sequence[_Order]) -> tuple[Poly, RatFunc, RatFunc] | None:
    """m, a and b by (2), for b = u B with u = sqrt(m) R and a polynomial B of bounded degree."""
    one = S.field.one
    m = one
    R = RatFunc(one)
    degree = size = 0
    for place, least in orders:
        if place.at_infinity:
            degree -= least
            continue
        if least % 2:
            m = m * place.factor
        order = least // 2
        R = R * RatFunc(place.factor) ** order
        degree -= 2 * order * place.degree
        size += abs(order) * place.degree
    degree = (degree - m.degree) // 2
    size += degree + 1
    if degree < 0:
        return None
    count_work(size * size if parameters_of(S.field) else size)  # over Q(t) the numbers grow with the size
    zero = RatFunc(one * 0)
    rate = logarithmic_derivative(m) / 2 + R.derivative() / R  # u'/u

    def derived(operator: _Operator) -> _Operator:
        pairs = zip([*operator, zero], [zero, *operator], strict=True)
        return [c.derivative() + c * rate + before for c, before in pairs]

    def combined(*terms: tuple[RatFunc | int, _Operator]) -> _Operator:
        scaled = ([c * factor for c in operator] for factor, operator in terms)
        return [sum(column, zero) for column in zip_longest(*scaled, fillvalue=zero)]

    D = S - T
    b = [RatFunc(one)]
    slope = derived(b)
    double_slope = combined((D, b), (-1, derived(slope)))  # 2 a'
    a = combined((1 / (2 * D), derived(double_slope)), (2 * T / D, slope), (T.derivative() / D, b))
    condition = over_one_denominator(combined((2, derived(a)), (-1, double_slope)))
    vector = _null_vector([_applied(condition, S.field.x**i) for i in range(degree + 1)])
    if vector is None:
        return None
    B = S.field.poly(vector)
    return m, R * _applied(a, B), R * B


def _applied(operator: Sequence[Any], B: Poly) -> Any:
    """c_0 B + c_1 B' + ..."""
    total = operator[0] * 0
    for c in operator:
        total = total + c * B
        B = B.derivative()
    return total


def _null_vector(columns: list[Poly]) -> list[Poly] | None:
    """Constants, not all 0, for which the sum of the columns vanishes; a prime tells that there are none."""
    height = max(column.degree for column in columns) + 1
    field = columns[0].field
    for h in field.homomorphisms():
        try:
            images = [h(column) for column in columns]
        except BadPrimeError:
            continue
        entries = [int(image[j]) for image in images for j in range(height)]
        if nmod_mat(len(columns), height, entries, h.p).rank() == len(columns):
            return None
        break
    return dependence(columns)


@dataclass(frozen=True)
class SpecialFunctions:
    """Two solutions in special functions; true if they were found, and iterating gives both.

    A failed search proves nothing: functions f outside the classes aren't considered.

    Attributes
    ----------
    pullback : Pullback or None
        The verified pull-back of a standard equation that the solutions come from; None if nothing was found.
    searched : tuple of str
        The classes that were searched.
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
        """(y1, y2), or () if nothing was found."""
        return () if self.pair is None else tuple(self.pair)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.solutions)

    def __bool__(self) -> bool:
        return self.pullback is not None

    def __repr__(self) -> str:
        return f"<SpecialFunctions: {', '.join(map(as_text, self.solutions)) or 'none was found'}>"

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


def find(S: RatFunc, budget: Budget, *, extended: bool = True, work: int = SEARCH_WORK) -> SpecialFunctions:
    """The first pull-back of one of the `EQUATIONS` that gives S, checked exactly; not yet written.

    Without `extended`, functions f over a larger field than that of S aren't sought.  An exhausted budget, of time or of
    units of `work`, is a value: `stopped` is its sentence.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> found = find(x**4 + 2 * x, Budget()).pullback
    >>> print(found.equation.q, found.equation.r, found.equation.M, found.f)
    1 2/3 -2/9 -x**3/3
    """
    searched: tuple[str, ...] = ()
    try:
        with budget.watched(), bounded_work(work):
            problem = analyse(S, budget)
            searched = tuple(equation.searched for equation in _equations(problem))
            candidates = _pullback_candidates(problem, extended=extended)
            return SpecialFunctions(next((pullback for pullback in candidates if pullback.gives(S)), None), searched)
    except LimitExceeded as limit:
        return SpecialFunctions(None, searched, str(limit))


def pair_for(wanted: Wanted, source: Pullback | GaugeTransform) -> WrittenPair | None:
    """Checked solutions y1 and y2; None if the assumptions on the symbols leave open which are independent.

    Raises `VerificationFailed` if the check fails, which is a defect of this package; `LimitExceeded` within
    `Budget.watched`.
    """
    from kovacic.special.writer import Writer

    writer = Writer(wanted, source.transform)
    found = source.pullback.equation.written(writer, source.pullback.f)
    return None if found is None else _checked_pair(found, writer)


def _checked_pair(pair: WrittenPair, writer: Writer) -> WrittenPair:
    """The pair in the user's symbols; raises `VerificationFailed` where one isn't a solution, to 50 digits at a point."""
    from kovacic.closed_form.check import is_numerical_solution

    wanted = writer.wanted
    for y in pair:
        if not is_numerical_solution(y, writer.atoms.x, wanted.S, wanted.gauge):
            reason = f"a special function for S = {wanted.S} failed its check; please report the equation: {y}"
            raise VerificationFailed(reason)
    return pair.mapped(lambda e: e.xreplace(writer.own))


def special_functions(request: Wanted, budget: Budget) -> SpecialFunctions:
    """Solutions of the equation of a request.

    The pull-back is verified exactly, in rational functions; formulas are checked at a point, to 50 digits.  Liouvillian
    solutions aren't looked for, but where the group is reducible the two solutions may be dependent for some values of the
    parameters.

    >>> import kovacic
    >>> from kovacic.special.writer import Wanted
    >>> answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - n^2)*y = 0")
    >>> print(special_functions(Wanted(answer.S, answer.gauge, "x"), Budget()))
    y1 = besselj(n, x)
    y2 = bessely(n, x)
    """
    search = find(request.S, budget)
    source: Pullback | GaugeTransform | None = search.pullback
    if source is None and search.stopped is None:
        source = find_transform(request.S, budget)
        search = replace(search, searched=(*search.searched, "a v + b v' over these"))
    if source is None:
        return search
    try:
        with budget.watched():
            pair = pair_for(request, source)
    except LimitExceeded as limit:
        return replace(search, pullback=None, stopped=str(limit))
    if pair is None:
        stopped = "the assumptions don't tell which solutions are independent"
        return replace(search, pullback=None, stopped=stopped)
    return replace(search, pullback=source.pullback, pair=pair, transform=source.transform)


def find_transform(S: RatFunc, budget: Budget) -> GaugeTransform | None:
    """y = a v + b v' for a pull-back of one of the `EQUATIONS`, checked exactly; None if nothing is found within the limits.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> found = find_transform(x + 3 / (4 * x**2), Budget())  # Ai'(x)/sqrt(x)
    >>> print(found.pullback.equation.name, found.pullback.f, found.m, found.a)
    Airy's x x 0
    """
    tried = {S}
    with suppress(LimitExceeded), budget.watched(), bounded_work(2 * SEARCH_WORK):  # each f has an equation to be tried
        problem = analyse(S, budget)
        for pullback in _pullback_candidates(problem, extended=False, shifted=True):
            count_work(TRIAL)
            T = pullback.S
            if T in tried:
                continue
            tried.add(T)
            found = _transformation(problem, analyse(T, budget))
            transform = None if found is None else GaugeTransform(pullback, *found)
            if transform is not None and transform.gives(S):
                return transform
    return None


@dataclass(frozen=True)
class BySign:
    """Solutions for natural values of an integer that depends on parameters, and those known for negative ones."""

    integer: Any
    natural: WrittenPair
    negative: WrittenPair | None


def by_sign(request: Wanted, budget: Budget) -> BySign | None:
    """Solutions by the sign of an integer: where polynomials have names, or where it tells which solutions are independent.

    None if the sign of no integer helps.

    >>> import kovacic, sympy
    >>> from kovacic.special.writer import Wanted
    >>> n, l = sympy.symbols("n l", integer=True, positive=True)
    >>> answer = kovacic.solve("x^2*y'' + 2*x*y' + (2*x - x^2/n^2 - l*(l + 1))*y = 0", var="x")
    >>> found = by_sign(Wanted(answer.S, answer.gauge, "x", {"n": n, "l": l}), Budget())
    >>> print(found.integer, "|", found.natural.y1)
    -l + n - 1 | x**l*exp(-x/n)*assoc_laguerre(-l + n - 1, 2*l + 1, 2*x/n)
    """
    if not any(symbol.is_integer for symbol in request.symbols.values()):
        return None
    pullback = find(request.S, budget).pullback
    if pullback is None:
        return None
    from kovacic.special.writer import Writer

    writer = Writer(request)
    try:
        with budget.watched():
            best = max(_helpful(pullback, writer), key=lambda found: found.negative is not None, default=None)
            if best is None:
                return None
            natural = _checked_pair(best.natural, writer)
            negative = None if best.negative is None else _checked_pair(best.negative, writer)
    except LimitExceeded:
        return None
    return BySign(best.integer.xreplace(writer.own), natural, negative)


def _helpful(pullback: Pullback, writer: Writer) -> Iterator[BySign]:
    """Solutions by the sign of each integer, if it is open: they are known only by it, or polynomials that have names."""
    import sympy

    def assuming(value: Any) -> WrittenPair | None:
        """The solutions where the value is natural."""
        informed = writer.assuming(value)
        return None if informed is None else pullback.equation.written(informed, pullback.f)

    whole = pullback.equation.written(writer, pullback.f)
    for number in dict.fromkeys(pullback.equation.integers(writer, pullback.f)):
        is_sign_known = writer.is_natural(number) or writer.is_natural(-number - 1)
        if is_sign_known or not writer.is_integer(number):
            continue
        value = writer.constant(number)
        natural = assuming(value)
        if natural is None or natural == whole:
            continue
        if whole is None:
            yield BySign(value, natural, assuming(-value - 1))
        elif any(y.has(sympy.assoc_legendre, sympy.assoc_laguerre) for y in natural):
            yield BySign(value, natural, whole)
