"""Whittaker's equation, S0 = q - r/z + M/z^2, q != 0: kappa = r/(2 sqrt q), mu^2 = M + 1/4, in 2 sqrt(q) z.

Kummer's and Weber's equations are transforms of it; for r = 0 it is Bessel's of order mu in sqrt(-q) z.

Pull-backs: all orders of poles of S are even, and f is the integral of the polar parts of sqrt(S/q).

Solutions, z = 2 sqrt(q) f:

    M_mu = exp(-z/2) z^(1/2 + mu) 1F1(1/2 + mu - kappa; 1 + 2 mu; z),      M_-mu, where 2 mu isn't an integer,
    W = exp(-z/2) z^kappa 2F0(1/2 + mu - kappa, 1/2 - mu - kappa; -1/z),   W', with -kappa and -z.

W and W' are independent always, by their behaviour at infinity; M_mu and W where 1/2 + mu - kappa isn't an integer <= 0, since
a common solution would be elementary.  For a symbolic natural number N there are polynomials: 1F1(-N; 1 + a; z) is a multiple
of L_N^(a)(z), and W for mu^2 = 1/16, w^2 = z, of exp(-w^2/2) w^(1/2) H_N(w) with N = 2 kappa - 1/2, Weber's function.

Values, rho^2 = q, with U where the exponents differ by an integer:

    e^(-rho z) 1F1(1/2 +- mu - kappa; 1 +- 2 mu; 2 rho z),      else e^(-rho z) U(1/2 + mu - kappa, 1 + 2 mu, 2 rho z).

Reference: DLMF 12.7, 13.2, 13.6, 13.14 (13.14.25-30: Wronskians), 18.5.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar

from flint import acb, fmpq, fmpq_poly

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.product import product as product_of
from kovacic.engine.places import Problem
from kovacic.limits import count_work
from kovacic.special import prices
from kovacic.special.bessel import Bessel, written_pair
from kovacic.special.maps import HALF, TRIAL, PolarPart, Surd, irregular_places, parts_by_scale, zeros
from kovacic.special.pullback import (
    Pullback,
    StandardForm,
    StandardSolution,
    ValueAndSlope,
    each,
    ends,
    is_integer,
    root_or_ball,
)

if TYPE_CHECKING:
    from kovacic.closed_form.atoms import Expr
    from kovacic.special.writer import Writer, WrittenFactor, WrittenPair, WrittenTerm


@dataclass(frozen=True)
class Whittaker(Bessel):
    """S0 = q - r/z + M/z^2, q != 0."""

    searched: ClassVar[str] = "Whittaker's equation (with Kummer's, Weber's and Bessel's) in f(x), f rational"

    @classmethod
    def candidates(cls, problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
        if any(place.order % 2 for place in irregular_places(problem)):
            return
        for q, parts in parts_by_scale(problem, 2):
            r = parts[0].residue * q * Fraction(2, parts[0].order)
            for signs in _signs(parts):
                count_work(TRIAL)
                polar = sum((part.part * sign for part, sign in zip(parts, signs, strict=True)), RatFunc(q * 0))
                for f, square_of_e in zeros(problem, polar, shifted=shifted):
                    M = (square_of_e - 1) * Fraction(1, 4)
                    near = _near_zero(q, r) if shifted else []
                    yield from (Pullback(Whittaker(q, value, M), f) for value in dict.fromkeys([*near, r]))

    def written(self, writer: Writer, f: RatFunc) -> WrittenPair:
        if not self.r:
            return written_pair(writer, self.M + Fraction(1, 4), f * f * self.q * Fraction(-1, 4))
        form = _WhittakerForm.of(self, writer, f)
        for turned in (form, form.turned):
            polynomial = _hermite(turned) or _laguerre_pair(turned)
            if polynomial is not None:
                return polynomial
        return _kummer_or_tricomi(form)

    def integers(self, writer: Writer, f: RatFunc) -> Iterator[Surd]:
        """Degrees of Laguerre's polynomials."""
        if self.r:
            form = _WhittakerForm.of(self, writer, f)
            yield from (turned.kappa - mu - HALF for turned in (form, form.turned) for mu in (form.mu, -form.mu))

    @property
    def parameters(self) -> list[fmpq]:
        q, r, _ = self.constants
        return [*super().parameters, r * r / q]

    @property
    def cost(self) -> prices.Cost:
        if not self.r:
            return super().cost
        mu, kappa = (root_or_ball(square) / 2 for square in self.parameters)
        if any(ends(fmpq(1, 2) + sign * mu - kappa) for sign in (1, -1)):  # Laguerre's polynomial, and one series
            return prices.BESSEL
        return prices.TRICOMI if is_integer(2 * mu) else prices.WHITTAKER

    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        q, r, M = self.constants
        if r == 0:
            return super().form(n, d, coordinate)
        if coordinate:
            n = -n
            r = -r
        mu = root_or_ball(4 * M + 1) / 2
        rho = root_or_ball(q)
        kappa = r / (2 * rho)
        half = fmpq(1, 2)

        def solution(mu: Any, *, is_tricomi: bool) -> StandardSolution:
            a = acb(half + mu - kappa)
            b = acb(1 + 2 * mu)
            # 1F1' and U' are multiples of 1F1 and U with a + 1 and b + 1
            function, multiple = (acb.hypgeom_u, -a) if is_tricomi else (acb.hypgeom_1f1, a / b)

            def value(z: acb) -> ValueAndSlope:
                decay = (-(rho * z)).exp()
                w = 2 * rho * z
                F = function(w, a, b)
                return decay * F, decay * rho * (2 * multiple * function(w, a + 1, b + 1) - F)

            return value

        upper = (half + mu, 0)
        first = solution(mu, is_tricomi=False)
        if not is_integer(2 * mu):
            return StandardForm(n, d, (upper, (half - mu, 0)), each(first, solution(-mu, is_tricomi=False)))
        second = solution(mu, is_tricomi=True)
        return StandardForm(n, d, (upper, upper), each(first, second), (rho, None), not ends(half + mu - kappa))


def _near_zero(q: Poly, r: Poly) -> list[Poly]:
    """2 sqrt(q) kappa for the kappa between -1/2 and 1/2 that differs from r's by an integer, where it is rational."""
    root = q.field.sqrt(q)
    if root is not None:
        kappa = q.field.rational_value(r / (2 * root))
        if kappa is not None:
            return [root * (2 * (kappa - round(kappa)))]
    return []


def _signs(parts: list[PolarPart]) -> Iterator[Sequence[int]]:
    """The signs of the parts: their residues are proportional to the orders; all signs where the residues vanish."""
    rates = [part.residue * Fraction(1, part.order) for part in parts]
    if not any(rates):
        yield from product((1,), *[(1, -1)] * (len(parts) - 1))
        return
    signs = {rates[0]: 1, -rates[0]: -1}
    if all(rate in signs for rate in rates):
        yield [signs[rate] for rate in rates]


# ------------------------------------------------------------------------------------------ written


@dataclass(frozen=True)
class _WhittakerForm:
    """Whittaker's equation in 2 q f: the parameters, and q for sqrt(q)."""

    writer: Writer
    f: RatFunc
    q: Surd
    kappa: Surd
    mu: Surd

    @classmethod
    def of(cls, equation: Whittaker, writer: Writer, f: RatFunc) -> _WhittakerForm:
        """The sign of sqrt(q) makes the exponential vanish where it can, or z positive."""
        q = writer.square_root(equation.q)
        given = product_of(writer.gauge).exponential.derivative()  # of the gauge factor's exponential
        slope = f.derivative() * q.part
        vanishes = bool(given) and given in (slope, -slope)
        turned = given == -slope if vanishes else writer.is_negative(writer.scale(f))
        if turned:
            q = -q
        mu = writer.square_root(equation.M + Fraction(1, 4))
        return cls(writer, f, q, q * (equation.r / (2 * equation.q)), mu)

    @property
    def turned(self) -> _WhittakerForm:
        """The form with -z and -kappa."""
        return replace(self, q=-self.q, kappa=-self.kappa)

    @property
    def positive(self) -> _WhittakerForm:
        """The form, or that with -z, whose z is positive at the first place: W is real there."""
        is_turned = self.writer.is_negative(self.q) != self.writer.is_negative(self.writer.scale(self.f))
        return self.turned if is_turned else self

    @property
    def z(self) -> Expr:
        return self.writer.multiple(self.q * 2, self.f)

    def factor(self, power: Surd) -> WrittenFactor:
        """exp(-z/2) z^power, and what belongs to the pull-back."""
        return self.writer.factor(self.f, [(power, self.f)], (-self.q, self.f))

    def kummer(self, mu: Surd) -> WrittenTerm:
        """M_mu."""
        return self.factor(mu + HALF), self.writer.hypergeometric((mu - self.kappa + HALF,), (2 * mu + 1,), self.z)

    def bracket(self, mu: Surd, multiple: Expr = 1) -> Expr:
        """The bracket of a multiple of M_mu and M_-mu, whose Wronskian in z is -2 mu."""
        import sympy

        return -2 * self.writer.constant(mu) * multiple * sympy.exp(self.z) * self.writer.rate(self.f)

    @property
    def slope(self) -> Expr:
        """dz/dx."""
        return self.z.diff(self.writer.atoms.x)

    @property
    def tricomi(self) -> WrittenTerm:
        """W."""
        top = [mu - self.kappa + HALF for mu in (self.mu, -self.mu)]
        return self.factor(self.kappa), self.writer.hypergeometric(top, (), -1 / self.z)


def _kummer_or_tricomi(form: _WhittakerForm) -> WrittenPair:
    """M_mu and M_-mu, or with W where 2 mu is an integer."""
    import sympy

    writer = form.writer
    mu = form.mu
    if not writer.is_integer(2 * mu):
        return writer.pair(form.kummer(mu), form.kummer(-mu), form.bracket(mu), (2 * mu,))
    natural = next((m for m in (mu, -mu) if writer.is_natural(2 * m)), None)
    reducible = any(writer.is_integer(form.kappa + m - HALF) for m in (mu, -mu))
    if natural is None or reducible:
        return writer.pair(form.turned.tricomi, form.tricomi, -form.slope)  # exp(z/2), exp(-z/2) at infinity
    own = form.positive
    m, kappa = map(writer.constant, (natural, own.kappa))
    W = -sympy.gamma(1 + 2 * m) / sympy.gamma(m - kappa + sympy.S.Half)
    power = own.z ** sympy.expand(-m - kappa - sympy.S.Half)
    before = sympy.exp((form.z + own.z) / 2)  # 1F1(a; b; z) = exp(z) 1F1(b - a; b; -z)
    return writer.pair(form.kummer(natural), own.tricomi, W * before * power * own.slope)


def _hermite(form: _WhittakerForm) -> WrittenPair | None:
    import sympy

    writer = form.writer
    degree = 2 * form.kappa - HALF
    is_weber = not form.mu.roots and form.mu.part == Fraction(1, 4)
    is_square = not form.q.roots and all(k % 2 == 0 for _, k in form.f.multiplicities)
    if not (writer.is_degree(degree) and is_weber and is_square):
        return None
    N = writer.constant(degree)
    root = writer.root_of(form.f * form.q.part * 2)
    even, odd = writer.even_and_odd((-N / 2,), ((1 - N) / 2,), root, form.z)
    before = form.factor(form.mu)
    # H_N = 2^N cos(pi N/2) gamma((N+1)/2)/sqrt(pi) even + 2^(N+1) sin(pi N/2) gamma(N/2+1)/sqrt(pi) odd [DLMF 18.5.13]
    scale = 2**N / sympy.sqrt(sympy.pi)
    other, W = writer.by_parity(N, even, odd, scale * sympy.gamma((N + 1) / 2), 2 * scale * sympy.gamma(N / 2 + 1))
    bracket = W * sympy.exp(form.z) * root.diff(writer.atoms.x)
    return writer.pair((before, sympy.hermite(N, root)), (before, other), bracket)


def _laguerre_pair(form: _WhittakerForm) -> WrittenPair | None:
    import sympy

    writer = form.writer
    for mu in (form.mu, -form.mu):
        degree = form.kappa - mu - HALF
        integer = writer.is_integer(2 * mu)
        if not writer.is_natural(degree) or (integer and not writer.is_natural(2 * mu)):
            continue
        N, a = map(writer.constant, (degree, 2 * mu))
        is_named = writer.is_degree(degree)
        first = form.kummer(mu)
        if is_named:
            first = first[0], sympy.assoc_laguerre(N, a, form.z)
        if integer:  # (-z)^N/N! exp(-z/2) and exp(z/2) at infinity; L_N(0) = (a + 1)_N/N!
            # (a + 1)_N isn't multiplied out if N is a number: it may be large
            scale = sympy.factorial(N) if is_named else sympy.rf(a + 1, N, evaluate=not N.is_Number)
            return writer.pair(first, form.turned.tricomi, (-form.z) ** N / scale * form.slope)
        if is_named:
            multiple = sympy.gamma(N + a + 1) / sympy.gamma(N + 1) / sympy.gamma(a + 1)
            return writer.pair(first, form.kummer(-mu), form.bracket(mu, multiple), (2 * mu,))
    return None
