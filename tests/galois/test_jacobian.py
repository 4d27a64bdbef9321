"""Orders of divisor classes: small curves whose points are counted, and Cantor's arithmetic beside the kernel's."""

from __future__ import annotations

from fractions import Fraction

import pytest
import transform
from build import QQ, RatFunc
from flint import nmod_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from kovacic.galois.imprimitive import Jacobian
from kovacic.verify.torsion import order_holds


def test_the_orders_of_points_on_an_elliptic_curve() -> None:
    """y^2 = x^3 + 1 over F_7 has 12 points; (2, 3) has order 6, (0, 1) order 3, (-1, 0) order 2."""
    curve = Jacobian(nmod_poly([1, 0, 0, 1], 7))

    def order(x: int, y: int) -> int:
        return curve.order(curve.point(nmod_poly([-x % 7, 1], 7), nmod_poly([y], 7)))

    assert (order(2, 3), order(0, 1), order(6, 0)) == (6, 3, 2)
    with pytest.raises(ValueError, match="on the curve"):
        order(2, 1)


@pytest.mark.parametrize("p", [23, pytest.param(41, marks=pytest.mark.long)])
def test_orders_that_are_found_from_a_multiple(p: int) -> None:
    """On y^2 = x^3 + 1 for a p that is larger than the orders: the number of all points is near p."""
    curve = Jacobian(nmod_poly([1, 0, 0, 1], p))
    for x, y in ((x, y) for x in range(p) for y in range(1, p) if (x**3 + 1 - y * y) % p == 0):
        point = curve.point(nmod_poly([-x % p, 1], p), nmod_poly([y], p))
        zeros = [n for n in range(1, 2 * p) if curve.multiple(n, point) == curve.zero]
        assert curve.order(point) == zeros[0]


def test_multiplication_in_a_jacobian_of_genus_two() -> None:
    curve = Jacobian(nmod_poly([1, 3, 0, 2, 0, 1], 11))
    points = [(x, y) for x in range(11) for y in range(1, 11) if (x**5 + 2 * x**3 + 3 * x + 1 - y * y) % 11 == 0]
    classes = [curve.point(nmod_poly([-x % 11, 1], 11), nmod_poly([y], 11)) for x, y in points]
    for c in classes:
        n = curve.order(c)
        assert not any(curve.multiple(k, c) == curve.zero for k in range(1, n))
        assert curve.multiple(n, c) == curve.zero
        assert curve.add(curve.multiple(5, c), curve.multiple(-3, c)) == curve.multiple(2, c)
    a, b, c = classes[:3]
    assert curve.add(curve.add(a, b), c) == curve.add(a, curve.add(b, c))


@settings(max_examples=12)
@given(
    st.lists(st.integers(-5, 5), min_size=4, max_size=6),
    st.integers(1, 9),
    st.sampled_from([5, 7, 11, 13, 17, 19, 23]),
    st.fractions(Fraction(1, 4), 3, max_denominator=4),
)
def test_the_orders_of_the_kernel_are_those_of_cantors_arithmetic(
    inner: list[int], value: int, p: int, residue: Fraction
) -> None:
    """Genus 1 to 3: P = (0, value) on y^2 = x^n + ... + value^2, for n odd; over P there is residue * denominator times D."""
    h = QQ.poly([value * value, *inner, *([1] if len(inner) % 2 == 0 else [0, 1])])
    image = nmod_poly([int(c) for c in h.coefficients()], p)  # type: ignore[attr-defined]
    good = image.gcd(image.derivative()).degree() == 0 and value % p != 0
    assume(residue.numerator * residue.denominator % p)
    H = transform.through(RatFunc(h), 0, value, residue)
    if not good:
        assert not any(order_holds(H, {residue}, p, k) for k in range(1, 30))
        return
    assume(any(pow(int(image(x)), p // 2, p) == p - 1 for x in range(1, p)))  # where the kernel puts infinity
    curve = Jacobian(image)
    point = curve.point(nmod_poly([0, 1], p), nmod_poly([value], p))
    order = curve.order(curve.multiple(2 * residue.numerator, point))
    others = {*range(1, 30), *(order // q for q in range(2, order + 1) if order % q == 0), 2 * order, 3 * order} - {
        order
    }
    assert order_holds(H, {residue}, p, order)
    assert not any(order_holds(H, {residue}, p, k) for k in others)
