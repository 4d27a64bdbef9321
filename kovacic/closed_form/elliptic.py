"""Integrals on a curve of genus 1 in Legendre's form: F, E and Pi, where enough of the branch points lie in the field.

A Moebius map takes the four branch points (infinity is one for a cubic g) to t = 0, 1, 1/m, infinity.  With W^2 =
t (1 - t) (1 - m t) and t = sin(phi)^2, dt/W = 2 dphi/sqrt(1 - m sin(phi)^2), so that Hermite's reduction in t leaves

    int dt/W = 2 F(phi|m),   int t dt/W = 2 (F - E)/m,   int dt/((t - tau) W) = -2 Pi(1/tau; phi|m)/tau.            (1)

For even g and r, x^2 takes the place of x: the roots of g themselves needn't lie in the field.

One finite branch point a is enough beside infinity, where the other two may be conjugate: with A^2 = g'(a), x = a + A s the
curve is w^2 = s (s^2 + b s + 1), and with m = (2 - b)/4 and s = tan(phi/2)^2, sin(phi)^2 = 4 s/(1 + s)^2,

    int ds/w = F(phi|m),       int s ds/w = F - 2 E + 2 w/(1 + s).                                                       (2)

For an irreducible cubic g its real root is adjoined, and one root of a quartic g goes to infinity.  Not covered, and left as
integrals: quartics without a root in the field that aren't even, irreducible cubics with three real roots, and poles with
residues beside conjugate branch points.

Reference: NIST Handbook of Mathematical Functions (2010), 19.2 and 19.29; for (2) Byrd & Friedman, Handbook of Elliptic
Integrals (1971), 239 and 260, where the angle is that of cos(phi) = (1 - s)/(1 + s).
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import asin, atan, elliptic_e, elliptic_f, elliptic_pi, sqrt

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr
from kovacic.closed_form.curve import CurveIntegral, integrate_on_curve


@dataclass(frozen=True)
class _Legendre:
    """t as a function of u = x or x^2, and R with r du/sqrt(g) = R dt/sqrt(t (t - 1) (t - 1/m)) up to a constant."""

    t: RatFunc
    m: Poly
    integrand: RatFunc


def elliptic(integral: CurveIntegral, atoms: Atoms) -> list[tuple[Expr, Expr]] | None:
    """Terms (c, e) whose sum of c e is int r dx/sqrt(g) times a constant, on every domain without branch points of the terms.

    None if the genus isn't 1, or for what the module doesn't cover.
    """
    r, g = integral.integrand, integral.g
    if g.degree not in (3, 4):
        return None
    x, t, even = g.field.poly([0, 1]), RatFunc(g.field.poly([0, 1])), False
    if g.degree == 4 and not g[1] and not g[3] and r(-t) == r:
        r, g, even = RatFunc(_halved(r.num), _halved(r.den)), _halved(g) * x, True
    quadratic = [p for p, _ in g.field.factor(g) if p.degree == 2 and atoms.real_roots(p)]
    if len(quadratic) == 1:  # two real roots
        r, branch = _over(AlgebraicField(g.field, quadratic[0]), r, RatFunc(g))
        g = branch.num
    roots = _roots(g)
    terms = _by_sine(r, roots, even, atoms) if len(roots) == g.degree else _by_tangent(r, g, even, atoms)
    if not terms:
        return None
    terms = [(c, e) for c, e in terms if c]
    last = terms[-1][0].inverse()
    return [(atoms.constant(c * last), e) for c, e in terms]


def _by_sine(r: RatFunc, roots: list[Poly], even: bool, atoms: Atoms) -> list[tuple[Poly, Expr]]:
    """By (1), from all branch points."""
    legendre = _legendre(r, _ordered(roots, even, atoms))
    t, m = RatFunc(r.field.poly([0, 1])), legendre.m
    done = integrate_on_curve(legendre.integrand, t.num * (t.num - 1) * (t.num - m.inverse()))
    if any(residue.factor.degree > 1 for residue in done.residues):
        return []
    shown, root = _square_root(legendre.t, even, atoms)
    phi, modulus = asin(root), atoms.constant(m)
    terms: list[tuple[Poly, Expr]] = []
    if done.exact:
        W = root * sqrt(atoms.ratio(1 - shown)) * sqrt(atoms.ratio(1 - shown * m))
        terms.append(_multiple(done.exact(shown) / 2, W, atoms))
    terms.append((m * done.rest[0] + done.rest[1], elliptic_f(phi, modulus)))
    terms.append((-done.rest[1], elliptic_e(phi, modulus)))
    for residue in done.residues:
        inverse = -residue.factor[0].inverse()  # 1/tau
        terms.append((-m * residue.value[0] * inverse, elliptic_pi(atoms.constant(inverse), phi, modulus)))
    return terms


def _by_tangent(r: RatFunc, g: Poly, even: bool, atoms: Atoms) -> list[tuple[Poly, Expr]]:
    """By (2), from one branch point beside infinity."""
    t, negative = RatFunc(g.field.poly([0, 1])), False
    curve = RatFunc(g)
    if g.degree == 4:
        if not (roots := _roots(g)):
            return []
        negative = atoms.is_negative(g.derivative()(roots[0]))
        t, back = 1 / (t - roots[0]), 1 / t + roots[0]
        r, curve = r(back), RatFunc((curve(back) / back.derivative() ** 2).num.monic())
    if integrate_on_curve(r, curve.num).residues:
        return []
    if not _roots(curve.num):
        if not _has_one_real_root(curve.num):
            return []
        r, curve, t = _over(AlgebraicField(r.field, curve.num), r, curve, t)
    square = curve.derivative()(_roots(curve.num)[0]).num
    if (A := r.field.sqrt(square)) is None:
        field = AlgebraicField(r.field, r.field.poly([-square, 0, 1]))
        r, curve, t = _over(field, r, curve, t)
        A = field.generator
    x, a = RatFunc(r.field.poly([0, 1])), _roots(curve.num)[0]
    if negative != atoms.is_negative(A):
        A = -A
    legendre = curve(x * A + a).num.monic()
    done = integrate_on_curve(r(x * A + a), legendre)
    m = (2 - legendre[2]) / 4
    shown, root = _square_root((t - a) / A, even, atoms)
    C = done.exact + done.rest[1] * 2 / (x + 1)
    # w as sqrt(s) (1 + s) sqrt(1 - m sin(phi)^2), for the branches of F and E where s < -1.
    W = root * sqrt(atoms.ratio(RatFunc(legendre // x.num, (x.num + 1) ** 2)(shown)))
    phi, modulus = 2 * atan(root), atoms.constant(m)
    terms: list[tuple[Poly, Expr]] = [_multiple((C * (x + 1))(shown), W, atoms)] if C else []
    return [
        *terms,
        (done.rest[0] + done.rest[1], elliptic_f(phi, modulus)),
        (-done.rest[1] * 2, elliptic_e(phi, modulus)),
    ]


def _square_root(t: RatFunc, even: bool, atoms: Atoms) -> tuple[RatFunc, Expr]:
    """t as a function of x, and its square root."""
    x = RatFunc(t.field.poly([0, 1]))
    shown = t(x * x) if even else t
    return shown, atoms.x * sqrt(atoms.ratio(shown / (x * x))) if even else sqrt(atoms.ratio(shown))


def _multiple(C: RatFunc, W: Expr, atoms: Atoms) -> tuple[Poly, Expr]:
    """C W, its constant by itself."""
    lead = C.num.lc
    (a, top), (b, bottom) = (atoms.primitive(p) for p in ((C / lead).num, (C / lead).den))
    return lead * (a / b), top / bottom * W


def _over(field: AlgebraicField, *functions: RatFunc) -> tuple[RatFunc, ...]:
    return tuple(RatFunc(f.num.over(field), f.den.over(field), reduced=True) for f in functions)


def _has_one_real_root(g: Poly) -> bool:
    """Has a monic cubic polynomial over Q one real root?  True for one with other coefficients."""
    d, c, b = (g.field.rational_value(g[k]) for k in range(3))
    if b is None or c is None or d is None:
        return True
    return b * b * c * c - 4 * c**3 - 4 * b**3 * d - 27 * d * d + 18 * b * c * d < 0


def _roots(g: Poly) -> list[Poly]:
    return [-p[0] for p, _ in g.field.factor(g) if p.degree == 1]


def _halved(p: Poly) -> Poly:
    """q with q(x^2) = p."""
    return p.field.poly([p[k] for k in range(0, p.degree + 1, 2)])


def _ordered(roots: list[Poly], even: bool, atoms: Atoms) -> list[Poly | None]:
    """What becomes 0, 1, 1/m and infinity (None is infinity): 0 < t < 1 for real x, and 0 < m < 1 where there is a choice."""
    shown = {a: atoms.constant(a) for a in roots}
    values = {a: float(shown[a]) if shown[a].is_number and shown[a].is_real else None for a in roots}
    known = sorted((a for a in roots if values[a] is not None), key=lambda a: values[a] or 0)
    points = [*known, *(a for a in roots if values[a] is None)]
    if even:
        zero = next(a for a in points if not a)
        above = [a for a in points if values[a] is None or (values[a] or 0) > 0]
        below = [a for a in points[::-1] if a and a not in above]
        return [zero, *above, *below, None] if above else [zero, None, below[1], below[0]]
    return [*points, None] if len(points) == 3 else [*points[1:], points[0]]


def _legendre(r: RatFunc, points: list[Poly | None]) -> _Legendre:
    start, one, other, last = points
    assert start is not None
    x = RatFunc(r.field.poly([0, 1]))
    if last is None:
        assert one is not None
        assert other is not None
        scale = (one - start).inverse()
        back = x / scale + start
        return _Legendre((x - start) * scale, ((other - start) * scale).inverse(), r(back))
    scale = r.field.poly([1]) if one is None else (one - last) * (one - start).inverse()
    t, back = (x - start) / (x - last) * scale, (x * last - scale * start) / (x - scale)
    image = scale if other is None else t.num(other) * t.den(other).inverse()
    return _Legendre(t, image.inverse(), r(back) * back.derivative() * (x - scale) ** 2)
