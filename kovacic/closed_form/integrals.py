"""The integrals of `kovacic.closed_form.primitive` and `kovacic.closed_form.curve` as SymPy expressions.

Those on s^2 = g, and exponentials of them, are real where g is positive.  kappa int r dx/sqrt(g) is a sum of kappa C sqrt(g)
and of kappa c log(Q) or kappa c atan(Q): every logarithm of `kovacic.closed_form.curve` with tau^2 < 0 is turned into an arc
tangent, -log(A + i eta B s)/(i eta) = atan(A/(eta B s))/eta up to a constant.

`elliptic`: integrals on a curve of genus 1 in Legendre's form, F, E and Pi, where enough of the branch points lie in the field.

A Moebius map takes the four branch points (infinity is one for a cubic g) to t = 0, 1, 1/m, infinity.  With W^2 =
t (1 - t) (1 - m t) and t = sin(phi)^2, dt/W = 2 dphi/sqrt(1 - m sin(phi)^2), so that Hermite's reduction in t leaves

    int dt/W = 2 F(phi|m),   int t dt/W = 2 (F - E)/m,   int dt/((t - tau) W) = -2 Pi(1/tau; phi|m)/tau.            (1)

For g and r that are even about c, (x - c)^2 takes the place of x: the roots of g themselves needn't lie in the field.

One finite branch point a besides infinity is enough, where the other two may be conjugate: with A^2 = g'(a), x = a + A s the
curve is w^2 = s (s^2 + b s + 1), and with m = (2 - b)/4, s = tan(phi/2)^2, sin(phi)^2 = 4 s/(1 + s)^2, n = (1 + tau)^2/(4 tau),

    int ds/w = F(phi|m),       int s ds/w = F - 2 E + 2 w/(1 + s),
    int ds/((s - tau) w) = -F/(1 + tau) + (tau - 1)/(2 tau (1 + tau)) Pi(n; phi|m) - atanh(w(tau) s/(tau w))/w(tau)
                         = -F/(2 tau) - (tau - 1)/(2 tau (1 + tau)) Pi(m/n; phi|m) + atanh(2 w(tau) w/Q)/w(tau),     (2)
    Q (tau s - 1) = (1 + tau) (1 - s) tau (s^2 + b s + 1) - (tau - 1) (1 + s) s (tau^2 + b tau + 1),

of which the first is taken for tau < 0 and the second, where n > 1, else.

For an irreducible cubic g over Q with one real root, this is adjoined, and one root of a quartic g goes to infinity.  Left as
integrals: irreducible cubics with three real roots, quartics without a root in the field that aren't even about their centre;
poles that are conjugate over the field, and in (2) those where more than one root has to be adjoined, for that takes more
than a screen.

Reference: NIST Handbook of Mathematical Functions (2010), 19.2 and 19.29; for (2) Byrd & Friedman, Handbook of Elliptic
Integrals (1971), 239, 260 and 361.54, where the angle is that of cos(phi) = (1 - s)/(1 + s).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial

import sympy
from sympy import Add, Ei, Integer, Mul, Rational, asin, atan, exp, log

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.partial_fractions import Residue
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms, Expr, display, factors, hypergeometric
from kovacic.closed_form.curve import CurveIntegral, Unit, integrate_on_curve, unit
from kovacic.closed_form.primitive import (
    ExponentialPrimitive,
    OpenPrimitive,
    RationalPrimitive,
    integrate,
    normalised_constant,
)
from kovacic.closed_form.product import Power, Product, gathered_powers, grouped_factors, joined, merged
from kovacic.closed_form.structure import OnCurve, Triangular
from kovacic.equation import over
from kovacic.numbers.exact import radical as sqrt


@dataclass
class _Terms:
    """int r dx/sqrt(g) = sum of c log(base) over `logarithms` (c, base) + sum of `others`; `notes` on what was left.

    `norms` (p, n) stand for a sum of n log(p)/tau with tau^2 = `tau_squared`.
    """

    logarithms: list[tuple[Expr, Expr]] = field(default_factory=list)
    norms: list[tuple[Poly, Fraction]] = field(default_factory=list)
    tau_squared: Poly | None = None
    others: list[Expr] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    def join_norms(self, atoms: Atoms) -> None:
        """The norms as logarithms."""
        if self.tau_squared is not None:
            tau = atoms.sqrt(self.tau_squared)
            self.logarithms += [(n / tau, atoms.poly(p)) for p, n in self.norms]


def curve_integral(integral: CurveIntegral, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """(c, F, notes): int r dx/sqrt(g) = c F, where F is real around 0 for g = x^2 - a, a > 0.

    There sqrt(g) = i sqrt(-g), as for the powers of g in `kovacic.closed_form.atoms.factors`.
    """
    is_turned = atoms.is_turned(integral.g)
    if is_turned:
        integral = _turned(integral)
    terms = _curve_terms(integral, atoms, alone=False, exponents=False)
    terms.join_norms(atoms)
    scale = -sympy.I if is_turned else Integer(1)
    return scale, Add(*terms.others, *(c * log(base) for c, base in terms.logarithms)), terms.notes


def _turned(integral: CurveIntegral) -> CurveIntegral:
    """int r dx/sqrt(-g)."""
    return replace(integral, g=-integral.g, exact=-integral.exact)


def exponentials(form: OnCurve, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """The two solutions, with cos and sin where kappa is imaginary, and notes."""
    if atoms.at is not None and atoms.is_turned(form.integral.g):
        # -g and -kappa^2 for g and kappa^2: kappa/sqrt(g) = -kappa'/sqrt(g')
        zeros = form.zeros and replace(form.zeros, B=-form.zeros.B)
        form = OnCurve(form.common, -form.kappa_squared, _turned(form.integral), zeros)
    oscillates = atoms.is_negative(form.kappa_squared)
    kappa = atoms.sqrt(-form.kappa_squared if oscillates else form.kappa_squared)
    terms = _curve_terms(form.integral, atoms, alone=form.zeros is None, exponents=True)
    common, other = _common_factors(form, terms, atoms)
    # A and B kappa s of the gathered zeros A +- B kappa s, up to a common factor, without denominators
    A, B = Integer(1), Integer(0)
    if form.zeros is not None:
        a, A = atoms.primitive(form.zeros.A)
        b, B = atoms.primitive(form.zeros.B)
        numbers, roots = (atoms.constant(b / a) * kappa * sqrt(atoms.poly(form.integral.g))).as_coeff_Mul()
        A, B = numbers.q * A, numbers.p * B * roots
    inner = [_times_factor(kappa, term) for term in terms.others]
    powers = [(base, _times_factor(kappa, c)) for c, base in terms.logarithms]
    if oscillates:
        angle = Add(*inner, *(e * log(base) for base, e in powers))
        c = sympy.cos(angle)
        s = sympy.sin(angle)
        return common * (A * c - B * s), common * (A * s + B * c), terms.notes
    first = Mul(common, A + B, *(base**e for base, e in powers), exp(Add(*inner)))
    second = Mul(other, A - B, *(base**-e for base, e in powers), exp(-Add(*inner)))
    return first, second, terms.notes


def _common_factors(form: OnCurve, terms: _Terms, atoms: Atoms) -> tuple[Expr, Expr]:
    """The common factor of both solutions, times prod p^(+-n kappa/tau) over the norms, which join its powers in the field."""
    ratio = terms.tau_squared and form.common.field.sqrt(form.kappa_squared / terms.tau_squared)
    if ratio is None:
        terms.join_norms(atoms)
        common = display(form.common, atoms)
        return common, common
    # Both square roots are written as positive numbers.
    first, second = (-ratio, ratio) if atoms.is_negative(ratio) else (ratio, -ratio)

    def with_powers(of_norms: Poly) -> Expr:
        more = (Power(p, of_norms * n) for p, n in terms.norms)
        return display(replace(form.common, powers=gathered_powers((*form.common.powers, *more))), atoms)

    return with_powers(first), with_powers(second)


def _times_factor(factor: Expr, term: Expr) -> Expr:
    """factor * term with the square roots of rational numbers multiplied out."""
    number, rest = term.as_independent(*term.free_symbols, as_Add=False)
    square = sympy.expand_mul(factor**2 * number**2)
    if square.is_Rational and factor.is_real and number.is_real:
        return sympy.sign(factor) * sympy.sign(number) * sqrt(square) * rest
    return sympy.sqrtdenest(sympy.expand_mul(factor * number)) * rest


def _curve_terms(integral: CurveIntegral, atoms: Atoms, *, alone: bool, exponents: bool) -> _Terms:
    """With `exponents` the terms will be exponents, and int dx/sqrt(g) is a logarithm, which becomes a power."""
    root = Mul(*atoms.root_of(integral.g))
    terms = _Terms()
    if integral.exact:
        terms.others.append(atoms.ratio(integral.exact) * root)
    units = list(integral.units)
    if integral.is_elementary:
        if integral.rest:
            _append_rest(integral, atoms, terms, alone=alone, exponents=exponents)
        for residue in integral.residues:
            found = unit(integral.g, residue)
            if found is not None:
                units.append(found)
            else:
                terms.others.append(_root_sum(integral, residue, root, atoms))
    elif not units:
        terms.others.append(sympy.Integral(atoms.ratio(integral.without_exact) / root, atoms.x))
        terms.notes = (f"integral left because {integral.reason}",)
    for u in units:
        _append_unit(u, root, atoms, terms, integral.g, exponents=exponents)
    return terms


def _append_rest(integral: CurveIntegral, atoms: Atoms, terms: _Terms, *, alone: bool, exponents: bool) -> None:
    """c int dx/sqrt(g) = c log((x - (x1 + x2)/2 + sqrt(g))/s), s the constant before the root of g, or an inverse sine."""
    g = integral.g
    inverse = None if exponents and g.lc == 1 else _inverse_sine(g, atoms, exponents=exponents)
    c = atoms.constant(integral.rest)
    if inverse is not None:
        terms.others.append(c * inverse)
        return
    roots = atoms.real_roots(g)
    is_alone = alone and not integral.exact and not integral.residues
    if is_alone and g[1] and roots:
        # The square root of the base: its square has another sign of sqrt(g) in some regions, which doesn't matter here.
        terms.logarithms.append((2 * c, Add(*(sqrt(atoms.x - a) for a in roots))))
        return
    scale, root = atoms.root_of(g)
    terms.logarithms.append((c, sympy.expand_mul(atoms.poly(g.derivative() * Fraction(1, 2)) / scale) + root))


def _inverse_sine(g: Poly, atoms: Atoms, *, exponents: bool) -> Expr | None:
    """int dx/sqrt(g) for g = k^2 - (x - h)^2 or g = (x - h)^2 + k^2 with k > 0 or a letter k; None for others.

    1/sqrt(k^2 - x^2) is the slope of asin(x/|k|); for exponents, of which both signs are taken, k serves as well.
    """
    h = g[1] * g.lc * Fraction(-1, 2)
    d = g[0] - g[1] * g[1] * g.lc * Fraction(1, 4)
    square = atoms.constant(d)
    k = atoms.sqrt(d)
    if not atoms.own(square).is_positive:
        if k.has(sympy.I) or not k.is_rational_function(*square.free_symbols):
            return None
        scale, _ = atoms.root_of(g)
        k = k if exponents else scale * sympy.sqrt(sympy.cancel(square / scale**2))
    z = (atoms.x - atoms.constant(h)) / k
    if g.lc == -1:
        return asin(z)
    return sympy.asinh(z)


def _append_unit(u: Unit, root: Expr, atoms: Atoms, terms: _Terms, g: Poly, *, exponents: bool) -> None:
    """factor * log((A + B tau s)/sqrt(norm))/tau, or the arc tangent for tau^2 < 0."""
    has_norm = exponents or u.p is None  # which is a power of kappa/tau
    root_of = atoms.sqrt if has_norm else partial(atoms.sqrt_beside, g=g)
    factor = Rational(u.factor)
    content, top = atoms.primitive(u.A)
    if atoms.is_negative(u.tau_squared):
        eta = root_of(-u.tau_squared)
        b, bottom = atoms.primitive(u.B)
        terms.others.append(atan(Mul(atoms.constant(content / b) / eta, top, 1 / bottom, 1 / root)) * -factor / eta)
        return
    tau = root_of(u.tau_squared)
    argument = top + sympy.expand_mul(tau * atoms.poly(u.B / content)) * root
    if u.p is None:
        norm = u.norm(g)
        terms.norms += [(p, -u.factor * k / 2) for p, k in norm.field.factor(norm)]
        terms.tau_squared = u.tau_squared
    elif u.p.degree > 0:
        argument = argument / atoms.primitive(u.p)[1]
    terms.logarithms.append((factor / tau, argument))


def _root_sum(integral: CurveIntegral, residue: Residue, root: Expr, atoms: Atoms) -> Expr:
    """The sum over the roots a of p of -(rho/sqrt(gamma)) log((L_a + sqrt(gamma) s)/(x - a))."""
    p, a = residue.factor, atoms.root
    gamma = atoms.poly(integral.g % p, a)
    tangent = gamma + atoms.poly(integral.g.derivative() * Fraction(1, 2) % p, a) * (atoms.x - a)
    body = -atoms.poly(residue.value, a) / sqrt(gamma) * log((tangent + sqrt(gamma) * root) / (atoms.x - a))
    return atoms.root_sum(atoms.poly(p, a), body)


def elliptic(integral: CurveIntegral, atoms: Atoms) -> list[tuple[Expr, Expr]] | None:
    """Terms (c, e) whose sum of c e is int r dx/sqrt(g) times a constant, on every domain without branch points of the terms.

    None if the genus isn't 1, or for what the module doesn't cover.
    """
    if integral.g.degree not in (3, 4):
        return None
    curve = _Curve.of(integral.integrand, integral.g)
    quadratic = [p for p, _ in curve.g.field.factor(curve.g) if p.degree == 2]
    real = [p for p in quadratic if atoms.constant(p[1] * p[1] - 4 * p[0]).is_positive]
    if len(real) == 1:
        curve = curve.over(AlgebraicField(curve.g.field, real[0]))
    is_split = len(curve.roots) == curve.g.degree
    terms = _by_sine(curve, atoms) if is_split else _by_tangent(curve, atoms)
    if not terms:
        return None
    terms = [(c, e) for c, e in terms if c]
    last = terms[-1][0].inverse()
    return [(atoms.constant(c * last), e) for c, e in terms]


@dataclass(frozen=True)
class _Curve:
    """int r dt/sqrt(g) up to a constant factor, for a monic g, and a Moebius function t of x, or of `inner`^2."""

    r: RatFunc
    g: Poly
    t: RatFunc
    inner: RatFunc | None = None

    @classmethod
    def of(cls, r: RatFunc, g: Poly) -> _Curve:
        """In t = (x - c)^2 if r, and g of degree 4, are even about c; else in x."""
        x = RatFunc(g.field.x)
        centre = g.mean_of_zeros
        moved, curve = r(x + centre), g(x.num + centre)
        if g.degree == 3 or curve[1] or moved(-x) != moved:
            return cls(r, g, x)
        num, den, square = (p.field.poly([*p][::2]) for p in (moved.num, moved.den, curve))
        return cls(RatFunc(num, den), square * x.num, x, x - centre)

    def over(self, field: Field) -> _Curve:
        """The curve over a larger field."""
        inner = self.inner and over(self.inner, field)
        return _Curve(over(self.r, field), self.g.over(field), over(self.t, field), inner)

    def moved(self, *points: Poly | None) -> _Curve:
        """In the Moebius function that is 0, 1 and infinity at these points; None stands for infinity."""
        t = RatFunc(self.g.field.x)
        (a, b), (c, d), (e, f) = ((t.num * 0 + 1, 0) if p is None else (p, 1) for p in points)
        above, below = c * f - e * d, c * b - a * d
        back = (e * below * -t + a * above) / (above * b - below * f * t)
        g = (RatFunc(self.g)(back) / back.derivative() ** 2).num.monic()
        forth = (self.t * b - a) * above / ((self.t * f - e) * below)
        return _Curve(self.r(back), g, forth, self.inner)

    @property
    def roots(self) -> list[Poly]:
        """Those of g in the field."""
        return [-p[0] for p, _ in self.g.field.factor(self.g) if p.degree == 1]

    def shown(self, atoms: Atoms) -> tuple[RatFunc, Expr]:
        """t as a function of x, and its square root."""
        if self.inner is None:
            return self.t, sqrt(atoms.factored(self.t))
        square = self.inner * self.inner
        t = self.t(square)
        return t, atoms.factored(self.inner) * sqrt(atoms.factored(t / square))


def _by_sine(curve: _Curve, atoms: Atoms) -> list[tuple[Poly, Expr]]:
    """By (1), from all branch points."""
    curve = curve.moved(*_ordered_roots(curve.roots, curve.inner is not None, atoms))
    m = -(curve.g[2] + 1).inverse()
    done = integrate_on_curve(curve.r, curve.g)
    if any(residue.factor.degree > 1 for residue in done.residues):
        return []
    shown, root = curve.shown(atoms)
    phi = asin(root)
    modulus = atoms.constant(m)
    terms: list[tuple[Poly, Expr]] = []
    if done.exact:
        W = root * sqrt(atoms.factored(1 - shown)) * sqrt(atoms.factored(1 - shown * m))
        leading = done.exact.num.lc
        terms.append((leading, atoms.factored(done.exact(shown) / (2 * leading)) * W))
    terms.append((m * done.rest[0] + done.rest[1], sympy.elliptic_f(phi, modulus)))
    terms.append((-done.rest[1], sympy.elliptic_e(phi, modulus)))
    for residue in done.residues:
        inverse = -residue.factor[0].inverse()  # 1/tau
        terms.append((-m * residue.value[0] * inverse, sympy.elliptic_pi(atoms.constant(inverse), phi, modulus)))
    return terms


def _by_tangent(curve: _Curve, atoms: Atoms) -> list[tuple[Poly, Expr]]:
    """By (2), from a branch point and infinity, where a root of a quartic g is moved; a root of a cubic may be adjoined."""
    roots = curve.roots
    is_negative = False
    if curve.g.degree == 4:
        if not roots:
            return []
        is_negative = atoms.is_negative(curve.g.derivative()(roots[0]))
        curve = curve.moved(None, roots[0] + 1, roots[0])
        roots = curve.roots
    if not roots:
        if curve.g.field != QQ or len(sympy.real_roots(atoms.poly(curve.g))) > 1:
            return []
        field = AlgebraicField(QQ, curve.g)
        curve = curve.over(field)
        roots = [field.generator]
    square = curve.g.derivative()(roots[0])
    A = curve.g.field.sqrt(square)
    if A is None:
        field = AlgebraicField(curve.g.field, curve.g.field.poly([-square, 0, 1]))
        curve = curve.over(field)
        A = field.generator
    if is_negative != atoms.is_negative(A):
        A = -A
    curve = curve.moved(roots[0], roots[0] + A, None)
    done = integrate_on_curve(curve.r, curve.g)
    if any(residue.factor.degree > 1 or curve.g.field.height > 1 for residue in done.residues):
        return []
    s, root = curve.shown(atoms)
    x = RatFunc(curve.g.field.x)
    quadratic = curve.g // x.num
    # w as sqrt(s) (1 + s) sqrt(1 - m sin(phi)^2), for the branches of F and E where s < -1.
    w = root * sqrt(atoms.factored(RatFunc(quadratic, (x.num + 1) ** 2)(s)))
    angle = _Angle(quadratic, s, w, 2 * atan(root), (2 - curve.g[2]) / 4)
    terms: list[tuple[Poly, Expr]] = []
    C = done.exact + done.rest[1] * 2 / (x + 1)
    if C:
        leading = C.num.lc
        terms.append((leading, atoms.factored((C * (x + 1))(s) / leading) * w))
    of_F = done.rest[0] + done.rest[1]
    for residue in done.residues:
        of_pole, others = angle.terms_of_pole(-residue.factor[0], residue.value[0], atoms)
        of_F += of_pole
        terms += others
    modulus = atoms.constant(angle.m)
    return [
        *terms,
        (of_F, sympy.elliptic_f(angle.phi, modulus)),
        (-done.rest[1] * 2, sympy.elliptic_e(angle.phi, modulus)),
    ]


@dataclass(frozen=True)
class _Angle:
    """The curve w^2 = s quadratic(s); s and w/(1 + s) as functions of x, the angle phi and the parameter m of (2)."""

    quadratic: Poly
    s: RatFunc
    w: Expr
    phi: Expr
    m: Poly

    def terms_of_pole(self, tau: Poly, rho: Poly, atoms: Atoms) -> tuple[Poly, list[tuple[Poly, Expr]]]:
        """F's coefficient, and the terms with Pi and the logarithm: by the first of (2) where tau < 0, else by the second."""
        above = 1 + tau
        n = above * above / (4 * tau)
        if atoms.is_negative(tau):
            # at tau = -1 Pi's coefficient is infinite, and F's that of the second: the limit
            of_F = -rho / (above or 2 * tau)
            z = atoms.factored(self.s / (self.s + 1) / tau) / self.w
        else:
            of_F = -rho / (2 * tau)
            n = self.m / n
            rho = -rho
            # 2 w/Q, where w(tau) isn't a factor yet
            x = RatFunc(self.quadratic.field.x)
            Q = (1 + tau) * tau * (1 - x.num) * self.quadratic
            Q = (Q - (tau - 1) * (x.num + 1) * x.num * self.quadratic(tau)) // (x.num * tau - 1)
            z = atoms.factored(((x + 1) * 2 / Q)(self.s)) * self.w
        square = tau * self.quadratic(tau)  # w(tau)^2
        if atoms.is_negative(square):
            factor, inverse = atoms.sqrt(-square), atan
        else:
            factor, inverse = atoms.sqrt(square), sympy.atanh
        terms: list[tuple[Poly, Expr]] = []
        if above and tau != 1:
            Pi = sympy.elliptic_pi(atoms.constant(n), self.phi, atoms.constant(self.m))
            terms.append((rho * (tau - 1) / (2 * tau * above), Pi))
        return of_F, [*terms, (-rho, inverse(factor * z) / factor)]


def _ordered_roots(roots: list[Poly], even: bool, atoms: Atoms) -> tuple[Poly, Poly | None, Poly | None]:
    """What becomes 0, 1, and infinity (None is infinity): 0 < t < 1 for real x, and 0 < m < 1 where there is a choice."""
    shown = {a: atoms.constant(a) for a in roots}
    values = {a: float(value) for a, value in shown.items() if value.is_number and value.is_real}
    points = [*sorted(values, key=lambda a: values[a]), *(a for a in roots if a not in values)]
    if even:
        zero = next(a for a in points if not a)
        above = [a for a in points if values.get(a, 1.0) > 0]
        return (zero, above[0], None) if above else (zero, None, points[0])
    if len(points) == 3:
        return points[0], points[1], None
    return points[1], points[2], points[0]


Scaled = tuple[Expr, Expr]  # a constant and an expression, to be multiplied
Factors = tuple[Expr, list[Expr]]  # a constant and factors: y1 as `Atoms.factors` gives it


def triangular(form: Triangular, atoms: Atoms) -> tuple[Expr, Expr, tuple[str, ...]]:
    """y1, and y1 int y1^-2 up to a constant factor and a multiple of y1; and notes about what was left as an integral."""
    primitive = form.primitive
    parts = factors(form.first, atoms)
    first = Mul(*parts[1])
    if isinstance(primitive, OpenPrimitive):
        integral = sympy.Integral(display(form.bare.to_power(-2), atoms, around_zero=True), atoms.x)
        return first, first * integral, (f"integral left because {primitive.reason}",)
    if not isinstance(primitive, CurveIntegral):
        return first, _scaled_sum(_terms(form.first, primitive, parts, atoms)), ()
    named = elliptic(primitive, atoms) if primitive.reason is not None else None
    if named is not None:
        note = f"elliptic integrals because {primitive.reason}"
        return first, _scaled_sum([_scaled(c, [*parts[1], value]) for c, value in named]), (note,)
    if atoms.is_turned(primitive.g):
        primitive = _turned(primitive)
    _, value, notes = curve_integral(primitive, atoms)
    content, shown = value.as_content_primitive()
    if shown.could_extract_minus_sign():
        content = -content
    algebraic: Expr = Integer(0)
    if primitive.exact:
        # y1 times the rational function before the root of g, in lowest terms
        scale, whole = factors(form.first, atoms, primitive.exact)
        algebraic = Mul(scale / (parts[0] * content), *whole, *atoms.root_of(primitive.g))
        _, value, _ = curve_integral(replace(primitive, exact=primitive.exact * 0), atoms)
    return first, Add(algebraic, *(first * (term / content) for term in Add.make_args(value))), notes


def integral(h: Product, atoms: Atoms) -> Expr | None:
    """int h dx with its constant factor, None if it would be left.  The branches of roots may not agree."""
    primitive = integrate(h)
    if isinstance(primitive, OpenPrimitive):
        return None
    if isinstance(primitive, CurveIntegral):
        scale, value, notes = curve_integral(primitive, atoms)
        return None if notes else scale * value
    one = Product((), (), h.exponential * 0)
    return Add(*(c * e for c, e in _terms(one, primitive, (Integer(1), []), atoms)))


def _scaled_sum(terms: list[Scaled]) -> Expr:
    """The sum up to a constant factor: coprime integer coefficients if they are commensurable, the last one positive."""
    if len(terms) == 1:
        return terms[0][1]
    ratios = [c / terms[-1][0] for c, _ in terms]
    if all(ratio.is_Rational for ratio in ratios):
        content = sympy.gcd(ratios)
        ratios = [ratio / content for ratio in ratios]
    return Add(*(c * e for c, (_, e) in zip(ratios, terms, strict=True)))


def _scaled(scale: Expr, parts: list[Expr]) -> Scaled:
    """Rational factors of the product join the constant."""
    coefficient, rest = Mul(*parts).as_coeff_Mul()
    return scale * coefficient, rest


def _terms(
    y: Product, primitive: RationalPrimitive | ExponentialPrimitive, first: Factors, atoms: Atoms
) -> list[Scaled]:
    """y times the integral."""
    if isinstance(primitive, ExponentialPrimitive):
        return _exponential_integrals(y, primitive, first, atoms)
    exact, residues = primitive.parts.exact, primitive.parts.residues
    if not residues:
        exact = normalised_constant(exact)
    terms = [_scaled(*factors(y, atoms, exact))] if exact else []
    scale, parts = first
    return terms + [_scaled(scale, [*parts, term]) for term in logarithms(residues, atoms, y)]


def logarithms(residues: Iterable[Residue], atoms: Atoms, y: Product | None = None) -> list[Expr]:
    """Logarithms, to be multiplied by y; one for two linear factors with opposite residues, and for x - a and x + a.

    It is real between the roots if 0 lies there, unless the roots in y aren't.
    """
    apart: dict[Poly, list[Poly]] = {}
    for residue in residues:
        apart.setdefault(residue.value, []).append(residue.factor)
    pending = [
        Residue(p, value)
        for value, bases in sorted(apart.items(), key=lambda group: group[0].degree > 0)  # constant residues first
        for p in (bases if value.degree > 0 else joined(bases))
    ]
    terms = []
    while pending:
        first = pending.pop()
        opposite = [other for other in pending if _is_at_a_point(other) and other.value == -first.value]
        if not opposite or not _is_at_a_point(first):
            terms.append(atoms.log_sum(first))
            continue
        pending.remove(opposite[0])
        # rho log((x - a)/(x - b)), or of (x - a)/(b - x) where 0 lies between a and b
        p, q = first.factor, opposite[0].factor
        bottom = atoms.primitive(q)[1]
        positive = p if atoms.is_negative(p[0]) else q
        is_around_zero = (p.field.rational_value(p[0] * q[0]) or 0) < 0
        if is_around_zero and (y is None or _are_real_before(-positive[0], y, atoms)):
            bottom = -bottom
        terms.append(atoms.constant(first.value) * log(atoms.primitive(p)[1] / bottom, evaluate=False))
    return terms[::-1]


def _are_real_before(end: Poly, y: Product, atoms: Atoms) -> bool:
    """True if the roots in y, as written, are real to the left of a number and near it."""
    roots = (base for group, e in grouped_factors(merged(y)) if not atoms.constant(e).is_Integer for base in group)
    # Where it is zero the base is negative to the left, unless it is written with the other sign.
    return all(atoms.constant(base(end)).is_positive in (None, not atoms.is_turned(base)) for base in roots)


def _is_at_a_point(residue: Residue) -> bool:
    return residue.is_constant and residue.factor.degree == 1


def _exponential_integrals(y: Product, primitive: ExponentialPrimitive, first: Factors, atoms: Atoms) -> list[Scaled]:
    """first * (W k + the terms with Ei, error and gamma functions, and logarithms of t^(1/n) - z)."""
    scale, parts = first
    terms = []
    if primitive.W:
        # y W t^alpha exp(E)
        t = primitive.t
        quotient = [(t.num, primitive.alpha), (t.den, -primitive.alpha)]
        more = [Power(p, y.field.poly([e])) for p, e in quotient if p.degree > 0]
        whole = Product(gathered_powers((*y.powers, *more)), y.roots, y.exponential + primitive.E(t))
        terms.append(_scaled(*factors(whole, atoms, primitive.W(t), like=y)))
    for term in primitive.terms:
        q = atoms.sum(term.q(primitive.t))
        power = primitive.alpha + term.power
        b = term.b
        if atoms.at is not None and atoms.own(q.subs(atoms.x, atoms.at)).is_negative:  # by t = -q
            scale = -scale * Integer(-1) ** Rational(power)
            b, q = b * (-1) ** term.n, -q
        c, function = _gamma(b, term.n, q, power, atoms)
        shift = exp(atoms.constant(term.e))
        terms.append(_scaled(scale * atoms.constant(term.coefficient) * c, [*parts, shift, function]))
    at_poles = (_sum_at_poles(residue, primitive, atoms) for residue in primitive.poles)
    return terms + [_scaled(scale * c, [*parts, found]) for c, found in at_poles]


def _sum_at_poles(residue: Residue, primitive: ExponentialPrimitive, atoms: Atoms) -> Scaled:
    """The sum over conjugate poles as at `ExponentialPrimitive`, the integral of rho t^alpha/(t - a) for E = 0."""
    t, E = primitive.t, primitive.E(primitive.t)
    if E:
        a = atoms.root
        body = atoms.poly(residue.value, a) * exp(atoms.poly(E.num, a)) * Ei(atoms.constant(E.num.lc) * (atoms.x - a))
        return Integer(1), atoms.root_sum(atoms.poly(residue.factor, a), body)
    # For t = k s it is k^alpha times the integral of rho s^alpha/(s - a/k); k^alpha as where W k is written.
    n, exponent = primitive.alpha.denominator, primitive.alpha.numerator
    field = residue.factor.field
    k, scale, root = field.one, Integer(1), Integer(1)
    for p, side in ((t.num, 1), (t.den, -1)):
        content, shown = atoms.primitive(p)
        if content != 1:
            scale *= atoms.sqrt(content.inverse()) ** (-2 * side * Rational(primitive.alpha))
        if p.degree > 0 and atoms.is_turned(p):
            content, shown, scale = -content, -shown, scale * Integer(-1) ** (side * Rational(primitive.alpha))
        k *= content if side == 1 else content.inverse()
        root *= shown ** Rational(side, n)
    power = k * field.x**n
    in_root = atoms.of_variable(sympy.Dummy("u", real=True))
    found = Integer(0)
    for p, _ in field.factor(residue.factor(power).monic()):
        unit = field.x if exponent > 0 else field.x.inverse_modulo(p)  # no pole is 0
        found += in_root.log_sum(Residue(p, residue.value(power) * unit ** abs(exponent) % p))
    return scale, found.xreplace({in_root.x: root})


def _gamma(factor: Poly, n: int, t: Expr, power: Fraction, atoms: Atoms) -> Scaled:
    """int t^power exp(beta t^n) dt: equation (1) of `kovacic.closed_form.primitive`.

    In general it is t^(power + 1)/(n s) 1F1(s; s + 1; beta t^n), s = (power + 1)/n, which has no cuts but those of the power.
    """
    beta = atoms.constant(factor)
    order = Rational(power + 1) / n
    if order == 0:
        return Rational(1, n), Ei(beta * t**n)
    if order == sympy.S.Half:
        is_positive = beta.is_real is not False and not atoms.is_negative(factor)
        root = atoms.sqrt(factor if is_positive else -factor)
        function = sympy.erfi if is_positive else sympy.erf
        return 1 / (root * n), sqrt(sympy.pi) * function(root * t ** Rational(n, 2))
    if n == 1 and beta.is_negative:
        return -((-beta) ** -order), sympy.uppergamma(order, -beta * t)
    return 1 / (n * order), t ** Rational(power + 1) * hypergeometric((order,), (order + 1,), beta * t**n)
