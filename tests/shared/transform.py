"""Normal forms `y'' = S y` made to order, and changes of variable that keep their nature.

Everything is a pure function on rational functions.  The test strategies and the benchmarks build equations whose
answer is known by construction from these; users get from them the normal form of a pull-back or of a contiguous
equation.

Symbols: S the normal form `y'' = S(x) y`; omega = y'/y, a solution of the Riccati equation `omega' + omega**2 = S`;
y1, y2 two solutions with the Wronskian `y1 y2' - y1' y2 = w`, a constant; `{f, x}` the Schwarzian derivative.

Every transformation below maps the projective differential Galois group (the group modulo scalars) to a subgroup, so a
Liouvillian equation stays one; `moebius`, `translation`, `scaling` and `gauge` keep the projective group, and with it
Kovacic's case.  A pull-back keeps the group's identity component, so "no Liouvillian solution" is kept as well.

References: J. J. Kovacic, J. Symb. Comp. 2 (1986) 3-43; M. van Hoeij and J.-A. Weil, "Solving second order linear
differential equations with Klein's theorem", ISSAC 2005; T. Kimura, Funkcial. Ekvac. 12 (1969) 269-281.
"""

from __future__ import annotations

from fractions import Fraction

from build import QQ, Poly, RatFunc

from kovacic.algebra.poly import Scalar


def from_omega(omega: RatFunc) -> RatFunc:
    """The S for which `omega = y'/y`: `S = omega' + omega**2` (Kovacic 1986, section 1.2).

    Any rational omega is allowed; the equation is of case 1.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(from_omega(x + 1 / x))
    x**2 + 3
    """
    return omega.derivative() + omega * omega


def from_squared_difference(q: RatFunc) -> RatFunc:
    """The S whose Riccati equation has two solutions with `(omega1 - omega2)**2 = q`.

    Two solutions satisfy `(omega1 - omega2)' = -(omega1 - omega2) (omega1 + omega2)`, hence, with `phi = -q'/(2 q)`,
    they are `(phi +- sqrt(q)) / 2`, and `S = phi'/2 + (phi**2 + q)/4`.  When q is a square in C(x) both are rational
    there (case 1, diagonal); otherwise they are conjugate over C(x), and the equation is of case 2 unless `exp(int
    sqrt(q) dx)` lies in C(x, sqrt(q)), which makes it reducible.

    Raises `ZeroDivisionError` for q = 0.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(from_squared_difference(4 / x))
    (16*x - 3)/(16*x**2)
    """
    phi = -q.derivative() / (2 * q)
    return phi.derivative() / 2 + (phi * phi + q) / 4


def from_conjugate_omegas(omega: RatFunc, conjugate: RatFunc) -> RatFunc:
    """The S that two different rational functions of one Riccati equation share, over the field where both lie.

    Raises `ValueError` when no S has both as solutions, that is unless `delta' = -delta (omega + conjugate)` for their
    difference delta.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(from_conjugate_omegas(2 / x, -1 / x))
    2/x**2
    """
    S = from_omega(omega)
    if from_omega(conjugate) != S or omega == conjugate:
        raise ValueError("the two functions are not different solutions of one Riccati equation")
    return S


def from_product(F: RatFunc, w_squared: Scalar) -> RatFunc:
    """The S with two solutions of product `y1 y2 = F` and Wronskian w, `w**2 = w_squared` in Q.

    `S = (2 F F'' - F'**2 + w**2) / (4 F**2)` and `omega = (F' +- w) / (2 F)`: case 1; w = 0 is allowed (then F =
    y1**2). From the first integral `F'**2 - 2 F F'' + 4 S F**2 = w**2` of the second symmetric power [Hendriks & van
    der Put 1995].

    Raises `ZeroDivisionError` for F = 0.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(from_product(x, 2), "|", from_product(x**2 + 1, 5))
    1/(4*x**2) | 9/(4*x**4 + 8*x**2 + 4)
    """
    first = F.derivative()
    return (2 * F * first.derivative() - first * first + w_squared) / (4 * F * F)


def from_squared_product(g: RatFunc, w_squared: Scalar) -> RatFunc:
    """The S with two solutions of product `y1 y2 = sqrt(g)` and Wronskian w: the semi-invariants of case 2.

    With `phi = g'/(2 g)`: `S = phi'/2 + phi**2/4 + w**2/(4 g)` (mathematically `from_squared_difference(w**2/g)`), and
    `y = g**(1/4) exp(+-(w/2) int dx/sqrt(g))`.

    Raises `ZeroDivisionError` for g = 0.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(from_squared_product(x, 4))
    (16*x - 3)/(16*x**2)
    """
    phi = g.derivative() / (2 * g)
    return phi.derivative() / 2 + phi * phi / 4 + Fraction(w_squared) / (4 * g)


def schwarzian(f: RatFunc) -> RatFunc:
    """The Schwarzian derivative `{f, x} = (f''/f')' - (f''/f')**2 / 2`; 0 exactly for Moebius transformations.

    Raises `ZeroDivisionError` for a constant f.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(schwarzian(x**3), "|", schwarzian((2 * x + 1) / (x - 5)))
    -4/x**2 | 0
    """
    first = f.derivative()
    ratio = first.derivative() / first
    return ratio.derivative() - ratio * ratio / 2


def pull_back(S: RatFunc, f: RatFunc) -> RatFunc:
    """The normal form of the pull-back by f: solutions `y(f(x)) f'(x)**(-1/2)`.

    `S(f) f'**2 - {f, x}/2`.  The exponent difference at a point c is multiplied by the ramification index of f at c.

    Raises `ZeroDivisionError` for a constant f.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(pull_back(x, x**2))
    (16*x**6 + 3)/(4*x**2)
    """
    first = f.derivative()
    return S(f) * first * first - schwarzian(f) / 2


def moebius(S: RatFunc, a: Scalar, b: Scalar, c: Scalar, d: Scalar) -> RatFunc:
    """The change of variable `x -> (a x + b)/(c x + d)`: `S(f) f'**2`, since the Schwarzian vanishes.

    Raises `ValueError` unless `a d - b c != 0`.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(moebius(x, 0, 1, 1, 0))
    1/x**5
    """
    determinant = a * d - b * c
    if determinant == 0:
        raise ValueError("a Moebius transformation needs a d - b c != 0")
    field = S.field
    below = field.poly([d, c])
    f = RatFunc(field.poly([b, a]), below)
    return S(f) * determinant**2 / RatFunc(below) ** 4


def translation(S: RatFunc, shift: Scalar) -> RatFunc:
    """The change of variable `x -> x + shift`.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(translation(x, 7))
    x + 7
    """
    return moebius(S, 1, shift, 0, 1)


def scaling(S: RatFunc, factor: Scalar) -> RatFunc:
    """The change of variable `x -> factor * x`: `factor**2 S(factor x)`.

    Raises `ValueError` for factor = 0.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(scaling(x, 2))
    8*x
    """
    return moebius(S, factor, 0, 0, 1)


def gauge(S: RatFunc, a: RatFunc | Poly | Scalar, b: RatFunc | Poly | Scalar) -> RatFunc:
    """The normal form of the equation of `u = a y + b y'`: a contiguous shift, with apparent singularities as a rule.

    With `c = a' + b S` and `d = a + b'` one has `u' = c y + d y'`, and the Wronskian of two u is `det = a d - b c`
    times that of the y.  So `u'' = (det'/det) u' - q u` for some q, and `v = u / sqrt(det)` satisfies `v'' = S_new
    v`.  The map is invertible over K(x), so both equations have the same projective Galois group, hence the same case.

    Raises `ValueError` when det = 0: then `-a/b` solves the Riccati equation and the u span a line only.

    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> print(gauge(x, 0, 1))
    (4*x**3 + 3)/(4*x**2)
    >>> print(gauge(x, 1, 0))
    x
    """
    a, b = S * 0 + a, S * 0 + b
    c, d = a.derivative() + b * S, a + b.derivative()
    determinant = a * d - b * c
    if not determinant:
        raise ValueError("u = a y + b y' loses a solution: -a/b solves the Riccati equation")
    p = -determinant.derivative() / determinant
    q = -(c + d.derivative() + p * d) / b if b else -(c.derivative() + d * S + p * c) / a
    return p.derivative() / 2 + p * p / 4 - q


def hypergeometric(at_zero: Scalar, at_one: Scalar, at_infinity: Scalar) -> RatFunc:
    """The normal form of Gauss's equation with exponent differences l, m, n at 0, 1 and infinity.

    `S = -(1-l**2)/(4 x**2) - (1-m**2)/(4 (x-1)**2) - (l**2+m**2-n**2-1)/(4 x (x-1))` (Kimura 1969).

    >>> print(hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 3)))
    (-32*x**2 + 27*x - 27)/(144*x**4 - 288*x**3 + 144*x**2)
    """
    l2, m2, n2 = (Fraction(value) ** 2 for value in (at_zero, at_one, at_infinity))
    x, y = RatFunc(QQ.poly([0, 1])), RatFunc(QQ.poly([-1, 1]))
    return (l2 - 1) / (4 * x**2) + (m2 - 1) / (4 * y**2) - (l2 + m2 - n2 - 1) / (4 * x * y)


def through(h: RatFunc, at: int, value: int, residue: Fraction = Fraction(1)) -> RatFunc:
    """H for which sqrt(H) dx on y^2 = h has the residues +-residue over x = at, where y = +-value, and no other ones."""
    return residue * residue * value * value / (h * (RatFunc(QQ.poly([-at, 1]))) ** 2)
