"""General solutions as SymPy gives them: linear equations of second order, with initial values, and Riccati equations.

a y'' + b y' + c y = f:      y = C1 y1 + C2 y2 - y1 int y2 f/(a W) dx + y2 int y1 f/(a W) dx,   W = y1 y2' - y1' y2
w' = p + q w + r w^2:        w = -u'/(r u),   u'' - (q + r'/r) u' + p r u = 0
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy
from sympy import cos, cot, csc, expand, sec, sin, tan

from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms
from kovacic.decision import Status
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.given import Equation
from kovacic.solution import Solution, solve

#: The largest expression (in operations) that is handed to SymPy's general simplification.
_SIMPLIFIED = 150


def dsolve(
    eq: Any,
    func: Any = None,
    *,
    ics: Mapping[Any, Any] | None = None,
    var: str | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Any:
    """The general solution of a linear equation of second order as a SymPy `Eq(y(x), ...)` with constants C1 and C2.

    `eq` is a SymPy `Eq` or an expression that is zero, or text; `func` is y(x), where more than one function occurs.  `ics`
    gives the values at one ordinary point as for `sympy.dsolve`, {y(0): 1, y(x).diff(x).subs(x, 0): 2}, or as text,
    {"y(0)": 1, "y'(0)": 2}: then the constants are determined exactly.  An integral that isn't done stays an `Integral`.

    Raises `NotImplementedError` where it is proven that there is no Liouvillian solution, with the reason, or where a limit
    was reached; `InputError` for what isn't such an equation, and `ValueError` for initial values at a singular point.

    >>> print(dsolve("y'' + y = x"))
    Eq(y(x), C1*cos(x) + C2*sin(x) + x)
    >>> print(dsolve("y'' - 2*x*y' + 2*y = 0", ics={"y(0)": 0, "y'(0)": 5}))
    Eq(y(x), 5*x)
    """
    equation, function = _read(eq, func, var, limits)
    solution = solve(equation, limits=limits)
    if solution.case is None:
        raise NotImplementedError(no_solution(solution))
    plain = sympy.Symbol(equation.variable)
    y1, y2 = solution.solutions
    C1, C2 = sympy.symbols("C1 C2")
    start = None if not ics else _initial_values(ics, function, equation)
    particular = 0
    if not equation.is_homogeneous:
        particular = _particular(equation, y1, y2, plain, None if start is None else start.point)
    general = C1 * y1 + C2 * y2 + particular
    if start is not None:
        general = general.subs(_constants(start, y1, y2, particular, plain, (C1, C2)))
        general = sympy.expand_mul(general, deep=False)
    return sympy.Eq(function, general.subs(plain, function.args[0]))


def no_solution(solution: Solution) -> str:
    """Why there is no closed form, in one sentence."""
    if solution.status is Status.UNDECIDED:
        return f"undecided: {solution.reason}"
    return (
        f"there is no Liouvillian solution, and that is proven: the differential Galois group of the normal form "
        f"y'' = ({solution.S.to_str(solution.variable)}) y is SL2(C)"
    )


def _read(eq: Any, func: Any, var: str | None, limits: Limits) -> tuple[Equation, Any]:
    if isinstance(eq, str | Equation):
        if isinstance(eq, str):
            from kovacic.reading.equation import parse_equation

            eq, _ = parse_equation(eq, variable=var, limits=limits)
        return eq, sympy.Function(eq.unknown)(sympy.Symbol(eq.variable))
    from kovacic.reading.from_sympy import parse_sympy_equation

    if not hasattr(eq, "free_symbols"):
        raise InputError(f"{type(eq).__name__!r} isn't an equation", hint="give text or a SymPy equation")
    equation, _, function = parse_sympy_equation(eq, variable=var, unknown=func, limits=limits)
    return equation, function


def _particular(equation: Equation, y1: Any, y2: Any, x: Any, start: Any) -> Any:
    """A particular solution, by variation of parameters; integrals that aren't done begin at `start` where it is given."""
    atoms = Atoms(x)
    if equation.h is None and (polynomial := _polynomial_solution(equation)) is not None:
        return atoms.poly(polynomial)
    right = (atoms.sum(equation.f) + (equation.h or 0)) / atoms.ratio(equation.a)
    wronskian = _wronskian(y1, y2, x)
    first, second = (_integral(_simplified(y * right / wronskian), x, start) for y in (y2, y1))
    result = y2 * second - y1 * first
    if result.has(sympy.Integral):
        return result
    return _simplified(sympy.expand(result))


def _polynomial_solution(equation: Equation) -> Poly | None:
    """A polynomial that solves the equation with a rational right-hand side, of a degree at most two above it, or None."""
    denominators = equation.a.den * equation.b.den * equation.c.den * equation.f.den
    a, b, c, f = ((value * denominators).num for value in (equation.a, equation.b, equation.c, equation.f))
    field = f.field
    height = max(f.degree - min(p.degree for p in (a, b, c) if p), 0) + 2
    basis: list[tuple[Poly, Poly]] = []  # pairs (L[p], p), of different degrees of L[p]
    for k in range(height + 1):
        p: Any = field.poly([0] * k + [1])
        slope = p.derivative()
        image = a * slope.derivative() + b * slope + c * p
        for other, q in sorted(basis, key=lambda pair: -pair[0].degree):
            if image.degree == other.degree:
                ratio = image.lc / other.lc
                image, p = image - ratio * other, p - ratio * q
        if image:
            basis.append((image, p))
    result = field.poly([])
    for image, p in sorted(basis, key=lambda pair: -pair[0].degree):
        if f.degree == image.degree:
            ratio = f.lc / image.lc
            f, result = f - ratio * image, result + ratio * p
    return None if f else result


def _wronskian(y1: Any, y2: Any, x: Any) -> Any:
    """y1 y2' - y1' y2, simplified: over the field of the functions that occur, and by trigonometry where that's needed."""
    value = sympy.expand(y1 * y2.diff(x) - y1.diff(x) * y2)
    if value.has(sympy.sin, sympy.cos):
        value = sympy.trigsimp(value)
    if value.has(sympy.log, sympy.erf, sympy.Integral):
        value = sympy.cancel(sympy.together(value))
    return _simplified(value)


def _simplified(expression: Any) -> Any:
    return sympy.simplify(expression) if expression.count_ops() < _SIMPLIFIED else expression


def _integral(integrand: Any, x: Any, start: Any) -> Any:
    """The antiderivative by SymPy's rules for hand calculation, else an `Integral`."""
    parts = []
    for term in sympy.Add.make_args(_prepared(integrand)):
        done = sympy.Integral(term, x).doit(manual=True)
        parts.append(sympy.Integral(_with_secants(term), x).doit(manual=True) if done.has(sympy.Integral) else done)
    result = sympy.Add(*parts)
    if not result.has(sympy.Integral):
        return result
    if start is None:
        return sympy.Integral(integrand, x)
    s = sympy.Symbol("s" if x.name != "s" else "t")
    return sympy.Integral(integrand.subs(x, s), (s, start, x))


def _prepared(integrand: Any) -> Any:
    """Expanded, in sines and cosines, and without sin^2 over a cosine: as tables have it."""
    if integrand.has(tan, cot, sec, csc):
        integrand = integrand.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        integrand = integrand.replace(sec, lambda a: 1 / cos(a)).replace(csc, lambda a: 1 / sin(a))
    if sympy.denom(integrand).has(cos):
        integrand = integrand.replace(
            lambda e: e.is_Pow and e.exp == 2 and e.base.func is sin, lambda e: 1 - cos(e.base.args[0]) ** 2
        )
    return expand(integrand)


def _with_secants(term: Any) -> Any:
    inverse = {cos: sec, sin: csc}
    return term.replace(
        lambda e: e.is_Pow and e.exp.is_Integer and e.exp < 0 and e.base.func in inverse,
        lambda e: inverse[e.base.func](*e.base.args) ** -e.exp,
    )


@dataclass(frozen=True)
class _Start:
    """y(point) = value and y'(point) = slope; None where it isn't given."""

    point: Any
    value: Any
    slope: Any


def _initial_values(ics: Mapping[Any, Any], function: Any, equation: Equation) -> _Start:
    points, given = set(), {}
    for key, value in ics.items():
        point, order = _text_key(key, equation) if isinstance(key, str) else _sympy_key(key, function)
        points.add(point)
        given[order] = _constant(value)
    if len(points) != 1:
        raise InputError("the initial values belong to one point")
    (point,) = points
    x = sympy.Symbol(equation.variable)
    for coefficient in (equation.a, equation.b, equation.c):
        quotient = coefficient / equation.a
        if sympy.simplify(Atoms(x).poly(quotient.den).subs(x, point)) == 0:
            raise ValueError(f"{point} is a singular point of the equation")
    return _Start(point, given.get(0), given.get(1))


def _constant(value: Any) -> Any:
    if isinstance(value, str):
        from kovacic.reading.symbolic import read_expression

        return read_expression(value, what="the initial value")
    if isinstance(value, float):
        raise InputError(f"the initial value {value!r} is a float", hint="give an exact number, or text such as '0.1'")
    return value if hasattr(value, "free_symbols") else sympy.Rational(value)


def _text_key(key: str, equation: Equation) -> tuple[Any, int]:
    """`y(0)` and `y'(0)`."""
    head, separator, rest = key.partition("(")
    name = head.strip()
    order = len(name) - len(name.rstrip("'"))
    if name.rstrip("'") != equation.unknown or not separator or not rest.rstrip().endswith(")") or order > 1:
        y = equation.unknown
        raise InputError(f"{key!r} isn't an initial value", hint=f"write {{'{y}(0)': 1, \"{y}'(0)\": 2}}")
    return _constant(rest.rstrip()[:-1]), order


def _sympy_key(key: Any, function: Any) -> tuple[Any, int]:
    """y(x0), and y(x).diff(x).subs(x, x0) in either form that SymPy gives it."""
    if getattr(key, "func", None) == function.func and len(key.args) == 1:
        return key.args[0], 0
    is_substitution = type(key).__name__ == "Subs"
    if is_substitution or getattr(key, "is_Derivative", False):
        derivative = key.expr if is_substitution else key
        point = key.point[0] if is_substitution else derivative.expr.args[0]
        orders = [int(count) for _, count in derivative.variable_count]
        if derivative.expr.func == function.func and orders == [1]:
            return point, 1
    raise InputError(f"{key} isn't an initial value", hint="write {y(0): 1, y(x).diff(x).subs(x, 0): 2}")


def _constants(start: _Start, y1: Any, y2: Any, particular: Any, x: Any, names: tuple[Any, Any]) -> dict[Any, Any]:
    """The constants that the initial values determine."""
    equations = []
    for order, value in enumerate((start.value, start.slope)):
        if value is not None:
            u, v, w = (_value_at(sympy.diff(y, x, order) if order else y, x, start.point) for y in (y1, y2, particular))
            equations.append(sympy.Eq(names[0] * u + names[1] * v + w, value))
    found = sympy.solve(equations, names, dict=True)
    if not found:
        raise InputError("there is no solution with these initial values")
    return {name: sympy.simplify(value) for name, value in found[0].items()}


def _value_at(expression: Any, x: Any, point: Any) -> Any:
    """The value at an ordinary point, where the expression may be of the form 0/0."""
    expression = sympy.sympify(expression, strict=True)
    value = expression.subs(x, point)
    if value.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
        value = sympy.limit(expression, x, point)
    return value.doit() if value.has(sympy.Integral) else value


@dataclass(frozen=True)
class RiccatiSolutions:
    """All rational and algebraic solutions of w' = p + q w + r w^2, as SymPy expressions in the variable.

    `rational`: the rational ones where they are finitely many.  `family`: all solutions, with a constant C1, where all are
    algebraic and known in closed form (C1 may be infinite: then it is `rational[0]`'s place).  `polynomial`: a polynomial in
    w with the algebraic solutions of least degree as its roots, None without one.  `all_algebraic`: are all solutions
    algebraic?  None if that wasn't determined.  `solution` is the answer for the linear equation.
    """

    rational: tuple[Any, ...]
    family: Any
    polynomial: Any
    all_algebraic: bool | None
    solution: Solution

    def __iter__(self) -> Any:
        return iter(self.rational)


def solve_riccati(
    p: Any, q: Any, r: Any, *, var: str | None = None, limits: Limits = DEFAULT_LIMITS
) -> RiccatiSolutions:
    """All rational and algebraic solutions of the Riccati equation w' = p + q w + r w^2 with rational p, q, r.

    The coefficients are texts, numbers or SymPy expressions.  If the group of the linear equation is trivial or {1, -1} all
    solutions are rational, with a constant: then `family` has them.  Raises `InputError` for r = 0, which isn't a Riccati
    equation, and what `solve` raises.

    >>> found = solve_riccati("x^2 + 3", 0, -1)
    >>> found.rational, found.family, found.all_algebraic
    (((x**2 + 1)/x,), None, False)
    """
    from kovacic.reading.read import read_coefficients

    if str(r).strip() in ("0", "0.0"):
        raise InputError("r is zero: the equation is linear of first order")
    given = read_coefficients(r, q, p, 0, var=var, limits=limits).equation
    assert given is not None
    R, Q, P = given.a, given.b, given.c
    unit = R / R
    linear = Equation(unit, -(Q + R.derivative() / R), P * R, R - R, None, given.variable, "u")
    solution = solve(linear, limits=limits)
    group = solution.group
    x = sympy.Symbol(solution.variable)
    atoms = Atoms(x)
    gauge, factor = atoms.ratio(linear.gauge), atoms.ratio(R)
    if solution.case is None:
        return RiccatiSolutions((), None, None, None if group is None else False, solution)
    finite = None if group is None else group.finite
    w = sympy.Symbol("w")
    family = None
    if finite and solution.case == 1:
        y1, y2 = solution.solutions
        u = y1 + sympy.Symbol("C1") * y2
        family = sympy.simplify(-u.diff(x) / (factor * u))
    rational: tuple[Any, ...] = ()
    polynomial = None
    if solution.case == 1 and (group is None or group.order is None or group.order > 2):
        omegas = _rational_omegas(solution, atoms)
        rational = tuple(sympy.cancel(-(omega + gauge) / factor) for omega in omegas)
    if solution.case != 1 and solution.riccati is not None:
        omega = -factor * w - gauge
        coefficients = [atoms.ratio(c) for c in solution.riccati.coefficients]
        polynomial = sympy.numer(sympy.together(sum(c * omega**k for k, c in enumerate(coefficients))))
        polynomial = sympy.collect(sympy.expand(polynomial), w)
    return RiccatiSolutions(rational, family, polynomial, finite, solution)


def _rational_omegas(solution: Solution, atoms: Any) -> list[Any]:
    """One omega, or both where the group is diagonal: their sum is F'/F for the invariant F = y1 y2."""
    assert solution.omega is not None
    first = atoms.ratio(solution.omega)
    invariant = solution.decision.invariant
    if invariant is None or solution.group is None or solution.group.kind.value not in ("cyclic", "multiplicative"):
        return [first]
    return [first, atoms.ratio(invariant.logarithmic_derivative) - first]
