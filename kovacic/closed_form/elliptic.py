"""Integrals on a curve of genus 1 in Legendre's form: F, E and Pi, where the branch points lie in the field.

A Moebius map takes the four branch points (infinity is one for a cubic g) to t = 0, 1, 1/m, infinity.  With W^2 =
t (1 - t) (1 - m t) and t = sin(phi)^2, dt/W = 2 dphi/sqrt(1 - m sin(phi)^2), so that Hermite's reduction in t leaves

    int dt/W = 2 F(phi|m),   int t dt/W = 2 (F - E)/m,   int dt/((t - tau) W) = -2 Pi(1/tau; phi|m)/tau.            (1)

For even g and r, x^2 takes the place of x: the roots of g themselves needn't lie in the field.

Reference: NIST Handbook of Mathematical Functions (2010), 19.2 and 19.29.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import asin, elliptic_e, elliptic_f, elliptic_pi, sqrt

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

    None if the genus isn't 1, or the branch points or the poles don't lie in the field, or in that with one real square root.
    """
    r, g = integral.integrand, integral.g
    if g.degree not in (3, 4):
        return None
    x, t, even = g.field.poly([0, 1]), RatFunc(g.field.poly([0, 1])), False
    if g.degree == 4 and not g[1] and not g[3] and r(-t) == r:
        r, g, even = RatFunc(_halved(r.num), _halved(r.den)), _halved(g) * x, True
    quadratic = [p for p, _ in g.field.factor(g) if p.degree == 2 and atoms.real_roots(p)]
    if len(quadratic) == 1:  # two real roots
        field = AlgebraicField(g.field, quadratic[0])
        r, g = RatFunc(r.num.over(field), r.den.over(field), reduced=True), g.over(field)
        x, t = x.over(field), RatFunc(x.over(field))
    roots = [-p[0] for p, _ in g.field.factor(g) if p.degree == 1]
    if len(roots) < g.degree:
        return None
    legendre = _legendre(r, _ordered(roots, even, atoms))
    m = legendre.m
    done = integrate_on_curve(legendre.integrand, t.num * (t.num - 1) * (t.num - m.inverse()))
    if any(residue.factor.degree > 1 for residue in done.residues):
        return None
    shown = legendre.t(t * t) if even else legendre.t
    root = atoms.x * sqrt(atoms.ratio(shown / (t * t))) if even else sqrt(atoms.ratio(shown))  # sqrt(t)
    phi, modulus = asin(root), atoms.constant(m)
    terms: list[tuple[Poly, Expr]] = []
    if done.exact:
        W = root * sqrt(atoms.ratio(1 - shown)) * sqrt(atoms.ratio(1 - shown * m))
        C = done.exact(shown)
        lead = C.num.lc
        (a, top), (b, bottom) = (atoms.primitive(p) for p in ((C / lead).num, (C / lead).den))
        terms.append((lead * (a / b / 2), top / bottom * W))
    terms.append((m * done.rest[0] + done.rest[1], elliptic_f(phi, modulus)))
    terms.append((-done.rest[1], elliptic_e(phi, modulus)))
    for residue in done.residues:
        inverse = -residue.factor[0].inverse()  # 1/tau
        terms.append((-m * residue.value[0] * inverse, elliptic_pi(atoms.constant(inverse), phi, modulus)))
    terms = [(c, e) for c, e in terms if c]
    last = terms[-1][0].inverse()
    return [(atoms.constant(c * last), e) for c, e in terms]


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
