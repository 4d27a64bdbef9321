"""Number fields inside the complex numbers: which root is meant, and one primitive element for several constants.

A user's sqrt(2) + sqrt(8) isn't 0: radicals have principal values.  The fields in here are Q, and Q(theta) with an
approximation of theta, good enough to tell the roots of every polynomial that turns up from one another; decisions about
equality are always exact, an approximation only chooses between roots that are known to be different.

FLINT isolates the complex zeros of an integer polynomial in a single uninterruptible call.  The call is short if the
coefficients have a few words; for longer ones, whose zeros may be as close as 1 and 1 + 10^-5000, its time is unpredictable.
Quadratic polynomials are then solved by their formula, and others in a separate process.  That process is also used for short
coefficients if clustered zeros might take longer than the remaining time.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_mat, fmpz, fmpz_poly

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.modular import integers_by_size
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.limits import check_duration, may_be_late

#: Seconds that FLINT takes at least, over the square of the degree; and at most, for each bit of the coefficients besides,
#: unless zeros lie extremely close together: x(x-1)...(x-79) takes twenty times as long as a polynomial without clusters.
_SECONDS = 4e-6
_SECONDS_PER_BIT = 3e-7
#: Bits of coefficients for which it takes no longer: `_SHORT_COEFFICIENTS`, and `_SHORT_PER_DEGREE` for each degree.  Zeros of
#: x^3 - 2 (a x - 1)^2 take 0.4 s for an a of 200 bits, and 23 s for one of 400.
_SHORT_COEFFICIENTS = 400
_SHORT_PER_DEGREE = 4

Zeros = tuple[tuple[Any, int], ...]


def complex_zeros(polynomial: fmpz_poly) -> Zeros:
    """The zeros, at the working precision in force; raises `LimitExceeded` if there isn't enough time.

    >>> [(complex(root), multiplicity) for root, multiplicity in complex_zeros(fmpz_poly([1, 2, 1]))]
    [((-1+0j), 2)]
    """
    degree = polynomial.degree()
    if degree < 1:
        return ()
    check_duration(_SECONDS * degree**2, f"the isolation of the zeros of a polynomial of degree {degree}")
    bits = polynomial.height_bits()
    is_short = bits <= _SHORT_COEFFICIENTS + _SHORT_PER_DEGREE * degree
    # At once where the time suffices for zeros of any kind, clusters included.
    if degree == 1 or (is_short and not may_be_late(degree**2 * (_SECONDS + _SECONDS_PER_BIT * bits))):
        return tuple((root, int(k)) for root, k in polynomial.complex_roots())
    if degree == 2:
        return _of_quadratic(polynomial)
    from kovacic.process import computed_apart

    coefficients = tuple([int(c) for c in polynomial.coeffs()])
    found = computed_apart(f"zeros of a polynomial of degree {degree}", _dyadic_zeros, coefficients, ctx.prec)
    return tuple((acb(_ball_of_dyadic(real), _ball_of_dyadic(imaginary)), k) for real, imaginary, k in found)


def _of_quadratic(polynomial: fmpz_poly) -> Zeros:
    """The zeros of a x^2 + b x + c, to the working precision: different ones are at least as far apart as 1/a^2."""
    c, b, a = polynomial.coeffs()
    square = b * b - 4 * a * c
    with working_precision(ctx.prec + 4 * int(polynomial.height_bits()) + 20):
        middle = arb(-b) / (2 * a)
        if square == 0:
            return ((acb(middle), 2),)
        distance = arb(abs(square)).sqrt() / (2 * abs(a))
        if square > 0:
            return (acb(middle - distance), 1), (acb(middle + distance), 1)
        return (acb(middle, distance), 1), (acb(middle, -distance), 1)


def _dyadic_zeros(coefficients: tuple[int, ...], prec: int) -> list[tuple[Any, Any, int]]:
    """Real part, imaginary part and multiplicity of each zero, in a form that pickles."""
    with working_precision(prec):
        zeros = fmpz_poly(list(coefficients)).complex_roots()
        return [(_dyadic(root.real), _dyadic(root.imag), int(k)) for root, k in zeros]


def _dyadic(ball: arb) -> tuple[list[int], list[int]]:
    """Mantissa and exponent of the midpoint and of the radius."""
    return [int(part) for part in ball.mid().man_exp()], [int(part) for part in ball.rad().man_exp()]


def _ball_of_dyadic(dyadic: tuple[list[int], list[int]]) -> arb:
    middle, radius = dyadic
    return arb((fmpz(middle[0]), fmpz(middle[1])), (fmpz(radius[0]), fmpz(radius[1])))


#: Bits of the approximations; below half of them an imaginary part is zero, as far from it as from rounding errors.
_EMBEDDING_BITS = 512


def approximation(constant: Poly) -> Any:
    """The complex number that an element of Q or of Q(theta) is, as an `acb`."""
    with working_precision(_EMBEDDING_BITS):
        theta = _complex(constant.field.approximation) if isinstance(constant, ExtensionPoly) else acb(0)
        return _value_for_generator(constant, theta)


def enclosure(constant: Poly) -> Any:
    """A ball with the complex number that an element of Q or of Q(theta) is."""
    with working_precision(_EMBEDDING_BITS):
        theta = acb(0)
        if isinstance(constant, ExtensionPoly):
            theta = _roots_by_distance(constant.field.modulus, _complex(constant.field.approximation))[0]
        return _value_for_generator(constant, theta)


def _value_for_generator(constant: Poly, theta: Any) -> Any:
    """The constant for this value of the generator."""
    return acb_poly([part.rep[0] for part in constant.parts])(theta)  # type: ignore[attr-defined]


def principal_root(radicand: Poly, n: int) -> Any:
    """The principal n-th root of an element that isn't zero, as an `acb`."""
    with working_precision(_EMBEDDING_BITS):
        value = approximation(radicand)
        if abs(value.imag) < arb(2) ** (-_EMBEDDING_BITS // 2):
            value = acb(value.real)
        return (value.log() / n).exp()


def vanishing_factor(equation: Poly, target: Any) -> Poly:
    """The irreducible factor of a polynomial over Q or Q(theta) that is zero at `target`, an approximation of a root."""
    factors = [factor for factor, _ in equation.field.factor(equation)]
    if len(factors) == 1:
        return factors[0]
    with working_precision(_EMBEDDING_BITS):
        values = [acb_poly([approximation(c) for c in factor])(target) for factor in factors]
        sizes = [float(abs(value).mid()) for value in values]
    smallest, second = sorted(sizes)[:2]
    if smallest * 2.0**20 > second:
        raise AssertionError("the approximation doesn't tell the roots apart")
    return factors[sizes.index(smallest)]


def adjoined_root(factor: Poly, target: Any, name: str) -> tuple[Poly, Poly]:
    """`(theta, c)`: the root c of an irreducible polynomial over K = Q or Q(theta) that lies nearest to `target`.

    Both are elements of one simple extension of Q.  Over Q, its generator is c and is called `name`; over Q(theta) it is
    theta' = c + s theta with a small integer s, and is called alpha.
    """
    old = factor.field
    if not isinstance(old, AlgebraicField):
        field = AlgebraicField(QQ, factor, name, _nearest_root(factor, target))
        return field.zero, field.generator
    tower = AlgebraicField(old, factor)
    n = tower.absolute_degree
    shift, powers = _primitive_element(tower, old)
    columns = [powers[n], padded_coordinates(tower.embed(old.generator), n), padded_coordinates(tower.generator, n)]
    # The coordinates of theta'^n, theta and c with respect to the powers 1, theta', ..., theta'^(n-1).
    solved = _matrix(powers[:n]).solve(_matrix(columns))
    power, theta, c = (list(map(to_fraction, column)) for column in zip(*solved.tolist(), strict=True))
    modulus = QQ.poly([*(-q for q in power), 1])
    with working_precision(_EMBEDDING_BITS):
        position = _nearest_root(modulus, target + _complex(old.approximation) * shift)
    field = AlgebraicField(QQ, modulus, "alpha", position)
    return field.element(QQ.poly(theta)), field.element(QQ.poly(c))


def _primitive_element(tower: AlgebraicField, old: AlgebraicField) -> tuple[int, list[list[Any]]]:
    """The first s with Q(theta, c) = Q(c + s theta), and the coordinates of the powers of c + s theta up to the n-th.

    There is one, since only for finitely many s two of the n conjugates of c + s theta are equal.
    """
    n = tower.absolute_degree
    for shift in integers_by_size():
        primitive = tower.generator + old.generator * shift
        powers = [tower.poly([1])]
        for _ in range(n):
            powers.append(powers[-1] * primitive)
        rows = [padded_coordinates(power, n) for power in powers]
        if _matrix(rows[:n]).det() != 0:
            return shift, rows
    raise AssertionError("there are infinitely many integers")


def _matrix(columns: list[list[Any]]) -> fmpq_mat:
    """The matrix with these columns."""
    return fmpq_mat(len(columns[0]), len(columns), [entry for row in zip(*columns, strict=True) for entry in row])


def substituted(constant: Poly, theta: Poly) -> Poly:
    """The element with its generator replaced by another field's element."""
    total = theta.field.zero
    for part in reversed(constant.parts):
        total = total * theta + part
    return total


def padded_coordinates(polynomial: Poly, n: int) -> list[Any]:
    """The rational coordinates of all coefficients, with zeros up to n of them."""
    coordinates = list(polynomial.rational_coefficients())
    return coordinates + [fmpq(0)] * (n - len(coordinates))


def _complex(pair: tuple[Fraction, Fraction] | None) -> Any:
    assert pair is not None
    real, imaginary = (arb(fmpq(c.numerator, c.denominator)) for c in pair)
    return acb(real, imaginary)


def real_root_index(modulus: Poly, position: tuple[Fraction, Fraction]) -> int | None:
    """The number of real roots of a polynomial over Q below the real root at `position`; None if that one isn't real."""
    with working_precision(_EMBEDDING_BITS):
        nearest, *others = _roots_by_distance(modulus, _complex(position))
        if not nearest.imag.contains(0) or any(abs(root - nearest.conjugate()).contains(0) for root in others):
            return None
        return sum(1 for root in others if root.imag.contains(0) and root.real < nearest.real)


def refined_root(minimal: Poly, approximation: Any) -> Any:
    """The root of a polynomial over Q that lies nearest to an approximation, to full precision."""
    with working_precision(_EMBEDDING_BITS):
        return _complex(_nearest_root(minimal, approximation))


def _nearest_root(modulus: Poly, target: Any) -> tuple[Fraction, Fraction]:
    """The root of a rational polynomial that lies nearest to the target."""
    with working_precision(_EMBEDDING_BITS):
        nearest = _roots_by_distance(modulus, target)[0]
        return to_fraction(nearest.real.mid().fmpq()), to_fraction(nearest.imag.mid().fmpq())


def root_near(polynomial: fmpz_poly, target: Any) -> Any:
    """A ball around the root nearest to an approximation, at the working precision in force, but of 128 bits at least."""
    with working_precision(max(ctx.prec, 128)):
        return _by_distance(polynomial, target)[0]


def _roots_by_distance(modulus: Poly, target: Any) -> list[Any]:
    """Balls around the roots of a polynomial over Q, the nearest one to the target first."""
    return _by_distance(fmpz_poly([int(c * modulus.content()[1]) for c in modulus.rational_coefficients()]), target)


def _by_distance(polynomial: fmpz_poly, target: Any) -> list[Any]:
    return sorted((root for root, _ in complex_zeros(polynomial)), key=lambda root: float(abs(root - target).mid()))
