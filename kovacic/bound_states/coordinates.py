"""t as a function of the user's variable, V as a function of a real t, and the poles of V.

The reader has put t = x, or t = exp(theta), sinh(theta), cos(theta), ... with theta = k x + c.  What is special about each of
these functions stands in three tables: where it has a value, its period, and its values where its slope vanishes.

With u = tan(theta/2), exp(i theta) = (1 + i u)/(1 - i u): a function of exp(i theta) is one of a real u.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import sympy

from kovacic.bound_states.signs import Signs, Uncovered
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.numbers.numerals import as_text
from kovacic.reading.change_of_variable import SQUARES, function_of_x
from kovacic.writing.formula import caret

#: The theta with t = p, all but for the period.
_ANGLES: dict[str, Callable[[Any], tuple[Any, ...]]] = {
    "x": lambda p: (p,),
    "exp": lambda p: (sympy.log(p),),
    "sinh": lambda p: (sympy.asinh(p),),
    "cosh": lambda p: (sympy.acosh(p), -sympy.acosh(p)),
    "cos": lambda p: (sympy.acos(p), -sympy.acos(p)),
    "sin": lambda p: (sympy.asin(p), sympy.pi - sympy.asin(p)),
    "tan": lambda p: (sympy.pi / 2 if p == sympy.oo else sympy.atan(p),),
}
_PERIODS = {"cos": 2 * sympy.pi, "sin": 2 * sympy.pi, "tan": sympy.pi}
_TURNING_VALUES = {"cosh": (sympy.S.One,), **dict.fromkeys(("cos", "sin"), (sympy.S.One, -sympy.S.One))}
#: The value of t that it has inside of some domains without being analytic.
_POLES = {"tan": (sympy.oo,)}
_UNLOCATED = "it couldn't be determined whether V has a pole inside the domain"


@dataclass(frozen=True)
class Original:
    """t as a function of the user's variable on a domain: the function's name, and its argument theta = rate * x + offset."""

    x: Any
    domain: tuple[Any, Any]
    signs: Signs
    kind: str = "x"
    rate: Any = sympy.S.One
    offset: Any = sympy.S.Zero

    @classmethod
    def of(cls, equation: Equation | None, x: Any, domain: tuple[Any, Any], signs: Signs) -> Original:
        """The one that the reader has chosen.  Raises `InputError` for a root of x where x may be negative."""
        if equation is None or equation.change is None:
            return cls(x, domain, signs)
        t = signs.real(function_of_x(equation)).xreplace({sympy.Symbol(x.name): x})
        is_right = domain[0].is_finite and signs.is_nonnegative(domain[0])
        if t.is_Pow and t.base == x and not is_right:
            hint = "choose a domain on the right of it"
            raise InputError(
                f"the potential has a branch point at {x} = 0, which may be inside the domain",
                hint=f'{hint}: domain=(0, "oo")',
                shell=f"{hint}: --from 0",
            )
        if t.func not in SQUARES:
            raise Uncovered(f"no formula is known for potentials in {caret(str(t))}")
        theta = sympy.expand(t.args[0])
        return cls(x, domain, signs, t.func.__name__, theta.coeff(x, 1), theta.coeff(x, 0))._in_first_period()

    def _in_first_period(self) -> Original:
        """The function t with theta in its first period on the domain, and positive there if t is even.

        So sin(theta/2), cos(theta/2) and sinh(theta/2) are positive, of which waves have powers, and atan(cot(theta)) is
        pi/2 - theta.
        """
        if self.kind not in ("cos", "cosh", "tan"):
            return self
        twice = sum(map(self.theta_at, self.domain))
        if not twice.is_comparable:
            return self
        shifted = self
        if self.is_periodic and twice.is_finite:
            period = _PERIODS[self.kind]
            turns = sympy.ceiling(twice / (2 * period) - sympy.Rational(1, 2))
            twice -= 2 * turns * period
            shifted = replace(self, offset=self.offset - turns * period)
        if self.kind != "tan" and twice < 0:
            return replace(shifted, rate=-shifted.rate, offset=-shifted.offset)
        return shifted

    def on(self, first: Any, last: Any) -> Original:
        """The function on another domain."""
        return replace(self, domain=(first, last))

    @property
    def is_circular(self) -> bool:
        """True for t = exp(i theta) with a real theta."""
        return self.kind == "exp" and self.rate.has(sympy.I)

    @property
    def is_periodic(self) -> bool:
        return self.is_circular or self.kind in _PERIODS

    @property
    def theta(self) -> Any:
        return self.rate * self.x + self.offset

    @property
    def t(self) -> Any:
        return self.value(self.theta)

    def value(self, theta: Any) -> Any:
        """t at an argument."""
        return theta if self.kind == "x" else getattr(sympy, self.kind)(theta)

    def slope_squared(self, t: Any) -> Any:
        """(dt/dx)^2 as a function of t."""
        if self.kind == "x":
            return sympy.Integer(1)
        return SQUARES[getattr(sympy, self.kind)](t) * self.rate**2

    def theta_at(self, end: Any) -> Any:
        """The argument at an end of the domain."""
        return self._direction * end if end.is_infinite else sympy.simplify(self.rate * end + self.offset)

    @property
    def _direction(self) -> int:
        """The sign of the rate."""
        rate = self.rate.primitive()[1]
        example = ", ".join(sorted(f"{letter}=positive" for letter in rate.free_symbols))
        otherwise = f"the sign of {caret(as_text(rate))} isn't known: assume it, for example {example}"
        return self.signs.known_sign(self.rate, otherwise)

    def at(self, side: int) -> Any:
        """t at the left or the right end of the domain, 0 or 1, a number or oo (both of its ends are one point)."""
        theta = self.theta_at(self.domain[side])
        if theta.is_infinite and self.kind in _PERIODS:
            raise Uncovered(f"V is periodic: no solution is square integrable at {self.x} = {self.domain[side]}")
        value = sympy.simplify(self.value(theta))
        return sympy.oo if value.is_infinite else value  # -oo, and the pole of a tangent

    def side_of(self, side: int) -> int:
        """The sign inside the domain of t - c, c = t at an end, near this end, or of 1/t for oo.

        It is that of the first derivative at the end that isn't zero.
        """
        end = self.domain[side]
        theta = self.theta_at(end)
        if theta.is_infinite:
            return -1 if theta == -sympy.oo and self.kind in ("x", "sinh") else 1
        angle = sympy.Dummy("theta")
        t = self.value(angle)
        u = 1 / t if self.at(side) == sympy.oo else t
        for order in (1, 2):
            slope = sympy.simplify(sympy.simplify(u.diff(angle, order)).subs(angle, theta))
            if slope != 0:
                break
        otherwise = f"the end {end} isn't a multiple of {sympy.pi / self.rate}"
        return self.signs.known_sign(slope, otherwise) * (self._direction * (1 - 2 * side)) ** order

    def points_inside(self, values: Iterable[Any]) -> list[Any]:
        """The x strictly inside the domain at which t has one of the values, each once; it may be infinite at poles of t.

        Raises `Uncovered` if they can't be located.
        """
        first, last = map(self.theta_at, self.domain)
        angles = [angle for value in values for angle in _ANGLES[self.kind](value) if angle.is_real is not False]
        if angles and self.kind in _PERIODS:
            if not (first.is_number and last.is_number):
                raise Uncovered(f"the ends of the domain aren't multiples of {sympy.pi / self.rate}")
            period = _PERIODS[self.kind]
            lowest = sympy.floor(min(first, last) / period) - 1
            number = int(sympy.ceiling(abs(last - first) / period)) + 3
            angles = [angle + period * (lowest + k) for angle in angles for k in range(number)]
        return [self.x_at(angle) for angle in dict.fromkeys(angles) if self._is_between(angle, first, last)]

    def _is_between(self, value: Any, first: Any, last: Any) -> bool:
        """True for a point strictly between two others.  Raises `Uncovered` if its position can't be determined."""
        differences = [*map(sympy.simplify, (value - first, last - value))]
        if 0 in differences:
            return False
        otherwise = f"whether {value} lies between {first} and {last} isn't known"
        return len({self.signs.known_sign(difference, otherwise) for difference in differences}) == 1

    def middle(self, values: Sequence[Any] = ()) -> Any:
        """The only x inside the domain at which t turns, or has one of the values; None if there is none.

        Raises `Uncovered` where there are several, or the domain isn't symmetric about it.
        """
        found = self.points_inside([*_TURNING_VALUES.get(self.kind, ()), *values])
        if not found:
            return None
        is_symmetric = self.domain == (-sympy.oo, sympy.oo) or sympy.simplify(sum(self.domain) - 2 * found[0]) == 0
        if len(found) > 1 or not is_symmetric:
            raise Uncovered(f"the domain isn't symmetric about {self.x} = {found[0]}, and the equation is")
        return found[0]

    def x_at(self, theta: Any) -> Any:
        """The value of the user's variable for an argument."""
        return (theta - self.offset) / self.rate

    @property
    def monotonic_range(self) -> tuple[Any, ...]:
        """The range of t; () unless t is proven to be monotonic, but for a pole if it is all values."""
        with suppress(Uncovered):
            breaks = [*_TURNING_VALUES.get(self.kind, ()), *_POLES.get(self.kind, ())]
            is_period = self.kind == "tan" and self.at(0) == self.at(1)
            if is_period or not (self.is_circular or self.points_inside(breaks)):
                return self.range
        return ()

    @property
    def range(self) -> tuple[Any, Any]:
        """The range of t where it is monotonic; infinite for a tangent with a pole."""
        first, last = map(self.value, map(self.theta_at, self.domain))
        if sympy.zoo in (first, last) or self.points_inside(_POLES.get(self.kind, ())):
            return -sympy.oo, sympy.oo
        is_increasing = sympy.simplify(last - first).is_positive or last == sympy.oo or first == -sympy.oo
        return (first, last) if is_increasing else (last, first)


@dataclass(frozen=True)
class RealPotential:
    """V as a function of a real t, and the meaning of t."""

    V: Any
    original: Original
    t: Any


def near(point: Any, u: Any) -> Any:
    """t by a local coordinate u at a point, which may be oo."""
    return 1 / u if point == sympy.oo else point + u


def circle_point(u: Any) -> Any:
    """exp(i theta) for u = tan(theta/2)."""
    return (1 + sympy.I * u) / (1 - sympy.I * u)


def on_real_circle(real: RealPotential) -> RealPotential:
    """A function of exp(i theta) as one of tan(theta/2); any other one unchanged."""
    original = real.original
    t = real.t
    if not original.is_circular:
        return real
    rate = sympy.expand(original.rate / sympy.I)
    offset = sympy.expand(original.offset / sympy.I)
    V = sympy.cancel(sympy.together(real.V.xreplace({t: circle_point(t)})), extension=sympy.I)
    # V is real, but its numerator and denominator may have a complex factor in common.
    num, den = sympy.fraction(sympy.together(V))
    scale = sympy.Poly(den, t).LC()
    V = sympy.expand(sympy.expand(num / scale)) / sympy.expand(sympy.expand(den / scale))
    return RealPotential(V, replace(original, kind="tan", rate=rate / 2, offset=offset / 2), t)


def check_poles(real: RealPotential) -> None:
    """Raises `InputError` where V has a pole inside the domain, with a domain without, and `Uncovered` where it isn't known."""
    original, poles = real.original, _poles(real)
    if original.is_periodic and any(end.is_infinite for end in original.domain):
        _check_period(original, poles)
        return
    inside = original.points_inside(poles)
    if inside:
        is_nonnegative = original.signs.is_nonnegative
        largest = (point for point in inside if all(is_nonnegative(point - other) for other in inside))
        message = f"V isn't regular at {original.x} = {caret(as_text(inside[0]))}, inside the domain"
        raise _refused(message, "choose a domain without a pole inside", next(largest, None), original.domain[1])


def _check_period(original: Original, poles: Sequence[Any]) -> None:
    """Raise `InputError` if a periodic V has poles, which recur in each period, on a domain that ends at infinity."""
    period = _PERIODS[original.kind]
    angles = Original(original.x, (-2 * period, 2 * period), original.signs, original.kind).points_inside(poles)
    if angles:
        # The least positive angle, and the one before it: they come back in each period.
        ends = next(pair for pair in pairwise(sorted(angles, key=float)) if pair[1] > 0)
        start, stop = map(sympy.simplify, map(original.x_at, ends))
        place = caret(as_text(stop))
        message = f"V has poles on the line, one at {original.x} = {place} and others in each period of it"
        hint = "choose the domain between two neighbouring poles"
        raise _refused(message, hint, start if len(place) <= 30 else None, stop)  # longer ones are no help


def _poles(real: RealPotential) -> list[Any]:
    """The real poles t of V, each once, and oo for a tangent.  Raises `Uncovered` if they can't be determined."""
    signs = real.original.signs
    num, den = (sympy.Poly(part, real.t) for part in sympy.fraction(sympy.cancel(real.V)))
    if den.domain in (sympy.QQ, sympy.ZZ):
        zeros = [*dict.fromkeys(den.real_roots())]
    elif signs.sign(den.as_expr().xreplace({real.t: sympy.Dummy("t", real=True)})) is not None:
        zeros = []
    else:
        roots = sympy.roots(den)
        if sum(roots.values()) < den.degree() or any(root.is_real is None for root in roots):
            raise Uncovered(_UNLOCATED)
        zeros = [root for root in roots if root.is_real]
    if real.original.kind != "tan":
        return zeros
    if signs.sign(den.LC()) is None:  # where it vanishes there is a pole of V at the tangent's
        raise Uncovered(_UNLOCATED)
    return [*zeros, sympy.oo] if num.degree() > den.degree() else zeros


def _refused(message: str, hint: str, start: Any, stop: Any) -> InputError:
    """The error, with a domain that is proposed if its start isn't None."""
    if start is None:
        return InputError(message, hint=hint)
    ends = [sympy.simplify(end) for end in (start, stop)]
    first, last = (str(end) if end.is_Integer else f'"{caret(as_text(end))}"' for end in ends)
    options = f"--from {first}" if stop == sympy.oo else f"--from {first} --to {last}"
    return InputError(message, hint=f"{hint}: domain=({first}, {last})", shell=f"{hint}: {options}")
