"""Hypothesis strategies for equations `y'' = S y` whose case is known by construction: answers first.

An `Example` is built from its answer (omega, a semi-invariant, a group) or from an equation about which a theorem is
known, and then disguised by transformations that provably keep the case.  Why each label is right is said where it is
given; no label relies on the engine.  Facts used, for the projective Galois group PG of `y'' = S y`:

- Moebius maps, scalings, translations and gauge transforms u = a y + b y' keep PG, and the case is a property of PG.
- A pull-back by f of degree d replaces PG by the subgroup that fixes the intersection of C(x) with the Picard-Vessiot
  field over C(f).  If PG is SL2's, which is connected, nothing changes.  If PG is one of A4, S4, A5 with the standard
  exponent differences (1/2, 1/3, k), k = 1/3, 1/4, 1/5, it stays the whole group unless f = g(h) for the rational
  function g of a maximal subgroup; g's ramification then shows in f (see `keeps_primitive_group`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import permutations, product

import transform
from build import QQ, AlgebraicField, Poly, RatFunc
from hypothesis import assume
from hypothesis import strategies as st

TETRAHEDRAL, OCTAHEDRAL, ICOSAHEDRAL, QUATERNION = "tetrahedral", "octahedral", "icosahedral", "quaternion"
OMEGA_DEGREE = {TETRAHEDRAL: 4, OCTAHEDRAL: 6, ICOSAHEDRAL: 12}
THIRD_ORDER = {TETRAHEDRAL: 3, OCTAHEDRAL: 4, ICOSAHEDRAL: 5}
X = RatFunc(QQ.poly([0, 1]))


@dataclass(frozen=True)
class Example:
    """An equation with its answer: `case` is Kovacic's (None: no Liouvillian solution), `group` its name where
    known."""

    S: RatFunc
    case: int | None
    family: str
    group: str | None = None

    @property
    def size(self) -> int:
        return max(self.S.num.degree, self.S.den.degree)


# --------------------------------------------------------------------------------------- building blocks


def integers(bound: int) -> st.SearchStrategy[int]:
    return st.integers(-bound, bound)


def nonzero(bound: int) -> st.SearchStrategy[int]:
    return integers(bound).filter(bool)


def fractions(bound: int, denominators: tuple[int, ...] = (1, 1, 2, 3, 4, 5)) -> st.SearchStrategy[Fraction]:
    return st.builds(Fraction, integers(bound), st.sampled_from(denominators))


@st.composite
def polynomials(draw: st.DrawFn, min_degree: int = 0, max_degree: int = 3, bound: int = 6) -> Poly:
    """Integer coefficients, exact degree."""
    degree = draw(st.integers(min_degree, max_degree))
    return QQ.poly([*(draw(integers(bound)) for _ in range(degree)), draw(nonzero(bound))])


@st.composite
def irreducibles(draw: st.DrawFn, max_degree: int = 5, bound: int = 4) -> Poly:
    """A monic irreducible polynomial: the largest factor of a random one."""
    candidate = draw(polynomials(1, max_degree, bound))
    return max(QQ.factor(candidate), key=lambda pair: pair[0].degree)[0]


def distinct_irreducibles(min_size: int, max_size: int, max_degree: int = 5) -> st.SearchStrategy[list[Poly]]:
    return st.lists(irreducibles(max_degree), min_size=min_size, max_size=max_size, unique_by=lambda p: p.key())


@st.composite
def rational_functions(draw: st.DrawFn, max_degree: int = 2, bound: int = 4) -> RatFunc:
    """Not constant."""
    f = RatFunc(draw(polynomials(0, max_degree, bound)), draw(polynomials(0, max_degree, bound)))
    assume(f.num.degree > 0 or f.den.degree > 0)
    return f


@st.composite
def products(draw: st.DrawFn, exponents: tuple[int, ...], max_factors: int = 3, max_degree: int = 4) -> RatFunc:
    """A product of powers of irreducible polynomials."""
    result = RatFunc(QQ.poly([1]))
    for p in draw(distinct_irreducibles(1, max_factors, max_degree)):
        result = result * RatFunc(p) ** draw(st.sampled_from(exponents))
    return result


def multiplicities(f: RatFunc) -> tuple[list[int], list[int]]:
    """Those of the zeros and those of the poles of f on the sphere (one entry for each irreducible factor)."""
    zeros = [k for _, k in QQ.factor(f.num)] if f.num.degree > 0 else []
    poles = [k for _, k in QQ.factor(f.den)] if f.den.degree > 0 else []
    if f.degree > 0:
        poles.append(f.degree)
    if f.degree < 0:
        zeros.append(-f.degree)
    return zeros, poles


def is_power(f: RatFunc, n: int) -> bool:
    """Is f the n-th power of a function in C(x)?"""
    zeros, poles = multiplicities(f)
    return all(k % n == 0 for k in zeros + poles)


# ------------------------------------------------------------------------------------------------ case 1


@st.composite
def omegas(draw: st.DrawFn, max_factors: int = 3, max_degree: int = 5) -> RatFunc:
    """omega of every shape: residues integer, rational or algebraic, poles of order up to 5, a polynomial part."""
    omega = RatFunc(QQ.poly([]))
    for p in draw(distinct_irreducibles(0, max_factors, max_degree)):
        kind = draw(st.sampled_from(["integer", "rational", "half", "algebraic", "high", "high with residue"]))
        logarithmic = RatFunc(p.derivative(), p)
        if kind == "integer":
            omega = omega + draw(nonzero(4)) * logarithmic
        elif kind == "half":
            omega = omega + Fraction(2 * draw(integers(3)) + 1, 2) * logarithmic
        elif kind in ("rational", "high with residue"):
            omega = omega + draw(fractions(7)) * logarithmic
        if kind == "algebraic":
            omega = omega + RatFunc(draw(polynomials(0, p.degree - 1)), p)
        elif kind.startswith("high"):
            order = draw(st.integers(2, 5 if p.degree < 3 else 2))
            omega = omega + RatFunc(draw(polynomials(0, order * p.degree - 1, 3)), p**order)
    if draw(st.booleans()):
        omega = omega + draw(fractions(5)) * RatFunc(draw(polynomials(0, 3)))
    return omega


def case_1_omega() -> st.SearchStrategy[Example]:
    """A rational omega: case 1 by definition."""
    return omegas().map(lambda omega: Example(transform.from_omega(omega), 1, "case 1: omega"))


@st.composite
def case_1_diagonal(draw: st.DrawFn) -> Example:
    """y1 y2 = F rational and w**2 in Q: the two omegas (F' +- w)/(2F) lie in Q(w)(x)."""
    F = draw(products((-2, -1, 1, 1, 2, 3))) * draw(fractions(3).filter(bool))
    w_squared = draw(st.one_of(nonzero(12).map(Fraction), fractions(9).filter(bool)))
    return Example(transform.from_product(F, w_squared), 1, "case 1: diagonal")


@st.composite
def case_1_scalar(draw: st.DrawFn) -> Example:
    """A pull-back of y'' = 0: all solutions are square roots of rational functions, the group is trivial or {+-1}."""
    f = draw(rational_functions(3))
    assume(f.derivative())
    return Example(transform.pull_back(RatFunc(QQ.poly([])), f), 1, "case 1: scalar", "scalar")


@st.composite
def case_1_apparent(draw: st.DrawFn) -> Example:
    """Integer exponent differences everywhere: y1 = R(x) exp(polynomial), often without any logarithm."""
    R = draw(products((-3, -2, -1, 1, 2, 3)))
    omega = R.derivative() / R + RatFunc(draw(polynomials(0, 2, 3))) * draw(st.sampled_from([0, 0, 1]))
    return Example(transform.from_omega(omega), 1, "case 1: apparent")


@st.composite
def case_1_orthogonal(draw: st.DrawFn) -> Example:
    """Laguerre's and Jacobi's polynomials, x^((a+1)/2) exp(-x/2) L_n^a and x^((a+1)/2) (1-x)^((b+1)/2) P_n(a, b), n <= 60.

    The degree of P is n, far above the least ladder of degrees, and the exponents are fractions [Szego 1939, chapters IV, V].
    """
    n, a, b = draw(st.integers(0, 60)), draw(fractions(4, (2, 3, 4, 5))), draw(fractions(4, (2, 3, 5)))
    if draw(st.booleans()):
        S = Fraction(1, 4) - (2 * n + a + 1) / (2 * X) + (a * a - 1) / (4 * X**2)
    else:
        S = transform.hypergeometric(a, b, 2 * n + a + b + 1)
    return Example(S, 1, "case 1: orthogonal polynomials")


# ------------------------------------------------------------------------------------------------ case 2


def is_provably_irreducible(q: RatFunc) -> bool:
    """Does sqrt(q) dx, q not a square in C(x), certainly fail to be dh/h with h in C(x, sqrt q)?

    `from_squared_difference(q)` is of case 2 exactly then.  A logarithmic differential has simple poles with integer
    residues, and at least one of them.  At a place where q dx**2 has a pole of order k: k >= 3 means a pole of
    sqrt(q) dx of order at least 2; k = 2 a residue +-sqrt(coefficient); k <= 1 none.
    """
    holomorphic = True
    for p, k in QQ.factor(q.den) if q.den.degree > 0 else []:
        if k >= 3:
            return True
        if k == 2:
            holomorphic = False
            # The coefficient of (x-c)^-2 is num/(p'^2 rest)(c); an integer's square is the same at all roots of p.
            rest = q.den // (p * p)
            square = (q.num * (p.derivative() ** 2 * rest).inverse_modulo(p)) % p
            if square.degree > 0 or not _is_integer_square(square):
                return True
    order = 4 + q.degree
    if order >= 3:
        return True
    if order == 2:
        holomorphic = False
        if not _is_integer_square(q.num.lc):
            return True
    return holomorphic


def _is_integer_square(constant: Poly) -> bool:
    root = QQ.sqrt(constant)
    value = None if root is None else QQ.rational_value(root)
    return value is not None and value.denominator == 1


@st.composite
def case_2_semi_invariant(draw: st.DrawFn) -> Example:
    """y1 y2 = sqrt(g), g not a square; where a residue could be an integer, w**2 is doubled to prevent it."""
    g = draw(products((-3, -1, 1, 1, 1, 2, 3)))
    assume(not is_power(g, 2))
    q = draw(fractions(6).filter(bool)) / g
    if not is_provably_irreducible(q):
        q = 2 * q
    assume(is_provably_irreducible(q))
    return Example(transform.from_squared_difference(q), 2, "case 2: semi-invariant")


@st.composite
def case_2_quaternion(draw: st.DrawFn) -> Example:
    """A pull-back of exponent differences (1/2, 1/2, 1/2): Q8 unless f, f - 1 or f (f - 1) is a square, then case 1.

    The projective Picard-Vessiot field is C(x, sqrt f, sqrt(f - 1)).
    """
    f = draw(rational_functions(2))
    half = Fraction(1, 2)
    S = transform.pull_back(transform.hypergeometric(half, half, half), f)
    if is_power(f, 2) or is_power(f - 1, 2) or is_power(f * (f - 1), 2):
        return Example(S, 1, "case 1: pull-back of the quaternion group")
    return Example(S, 2, "case 2: quaternion group", QUATERNION)


@st.composite
def case_2_dihedral(draw: st.DrawFn) -> Example:
    """Exponent differences (1/2 + l, 1/2 + m, k/n), k/n not an integer: Kimura's first row; Q8 for n = 2."""
    n = draw(st.integers(2, 9))
    k = draw(integers(9).filter(lambda k: k % n))
    differences = (Fraction(1, 2) + draw(integers(2)), Fraction(1, 2) + draw(integers(2)), Fraction(k, n))
    group = QUATERNION if Fraction(k, n).denominator == 2 else None
    return Example(transform.hypergeometric(*draw(st.permutations(differences))), 2, "case 2: dihedral", group)


# ------------------------------------------------------------------------------------------------ case 3

# The rows of the table of Schwarz and Kimura: differences up to integers, and whether the sum of those must be even.
SCHWARZ = {
    TETRAHEDRAL: (("1/2 1/3 1/3", False), ("2/3 1/3 1/3", True)),
    OCTAHEDRAL: (("1/2 1/3 1/4", False), ("2/3 1/4 1/4", True)),
    ICOSAHEDRAL: (
        ("1/2 1/3 1/5", False),
        ("2/5 1/3 1/3", True),
        ("2/3 1/5 1/5", True),
        ("1/2 2/5 1/5", False),
        ("3/5 1/3 1/5", True),
        ("2/5 2/5 2/5", True),
        ("2/3 1/3 1/5", True),
        ("4/5 1/5 1/5", True),
        ("1/2 2/5 1/3", False),
        ("3/5 2/5 1/3", True),
    ),
}


def _row(text: str) -> tuple[Fraction, ...]:
    return tuple(Fraction(part) for part in text.split())


def kimura(l: Fraction, m: Fraction, n: Fraction) -> tuple[int | None, str | None]:  # noqa: E741 - Kimura's letters
    """Kimura's theorem: the case and the primitive group for three regular singular points with these differences."""
    if any((value := l + s * m + t * n).denominator == 1 and value % 2 for s, t in product((1, -1), repeat=2)):
        return 1, None
    triples = [
        tuple(sign * value for sign, value in zip(signs, triple, strict=True))
        for triple in set(permutations((l, m, n)))
        for signs in product((1, -1), repeat=3)
    ]
    if any(value.denominator == 2 and other.denominator == 2 for value, other, _ in triples):
        return 2, None
    for group, rows in SCHWARZ.items():
        for text, even in rows:
            for triple in triples:
                shifts = [value - base for value, base in zip(triple, _row(text), strict=True)]
                if all(shift.denominator == 1 for shift in shifts) and not (even and sum(shifts) % 2):
                    return 3, group
    return None, None


@st.composite
def case_3_schwarz(draw: st.DrawFn, group: str) -> Example:
    """A row of Schwarz's list, differences shifted by integers with an even sum: a contiguous equation."""
    text, _ = draw(st.sampled_from(SCHWARZ[group]))
    shifts = [draw(integers(2)) for _ in range(2)]
    shifts.append(2 * draw(integers(1)) + sum(shifts) % 2)
    differences = [base + shift for base, shift in zip(_row(text), shifts, strict=True)]
    return Example(transform.hypergeometric(*draw(st.permutations(differences))), 3, "case 3: Schwarz " + group, group)


def keeps_primitive_group(group: str, f: RatFunc) -> bool:
    """Sufficient for the pull-back of (1/2, 1/3, 1/k) by f to have the same group: f factors through no maximal
    subgroup.

    Cosets of the maximal subgroups, and how the generators at 0, 1, infinity permute them:
    A4: V4 (at 1: one 3-cycle), C3 (at 0: 2+2).  S4: A4 (at 0: 2), D4 (at 1: 3), S3 (at infinity: 4).
    A5: A4 (at infinity: 5), D5 (at 1: 3+3), S3 (at infinity: 5+5).
    """
    square, cube = is_power(f, 2), all(k % 3 == 0 for k in multiplicities(f - 1)[0])
    poles = multiplicities(f)[1]
    if group == TETRAHEDRAL:
        return not all(k % 2 == 0 for k in multiplicities(f)[0]) and not cube
    if group == OCTAHEDRAL:
        return not square and not cube and not all(k % 4 == 0 for k in poles)
    return not cube and not all(k % 5 == 0 for k in poles)


@st.composite
def case_3_pull_back(draw: st.DrawFn, group: str, max_degree: int = 3) -> Example:
    """A pull-back of the standard equation of a primitive group."""
    f = draw(rational_functions(max_degree))
    assume(keeps_primitive_group(group, f))
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, THIRD_ORDER[group]))
    return Example(transform.pull_back(S, f), 3, "case 3: pull-back " + group, group)


@st.composite
def case_3_sparse(draw: st.DrawFn, group: str) -> Example:
    """The same with f = c x^n or 1 + c x^n or c p^n: few places, high ramification."""
    n = draw(st.integers(1, 7))
    inner = X if draw(st.booleans()) else RatFunc(draw(irreducibles(2)))
    f = draw(nonzero(3)) * inner ** (n * draw(st.sampled_from([1, -1]))) + draw(st.sampled_from([0, 1]))
    assume(keeps_primitive_group(group, f))
    S = transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, THIRD_ORDER[group]))
    return Example(transform.pull_back(S, f), 3, "case 3: sparse " + group, group)


# --------------------------------------------------------------------------------------------- negatives


@st.composite
def none_classical(draw: st.DrawFn) -> Example:
    """Airy, odd polynomials, Bessel, Weber, Whittaker outside their reducible parameters: SL2.

    Bessel: n - 1/2 not an integer.  Weber x^2/4 - 1/2 - n: n not an integer.  Whittaker: no +-k +- m - 1/2 a natural
    number [Martinet & Ramis 1989].  A polynomial of odd degree: Kovacic 1986.
    """
    kind = draw(st.sampled_from(["polynomial", "Bessel", "Weber", "Whittaker"]))
    if kind == "polynomial":
        degree = draw(st.sampled_from([1, 1, 3, 5, 7]))
        S = RatFunc(draw(polynomials(degree, degree)))
    elif kind == "Bessel":
        n = draw(fractions(9))
        assume((n - Fraction(1, 2)).denominator != 1)
        S = (n * n - Fraction(1, 4)) / X**2 - 1
    elif kind == "Weber":
        n = draw(fractions(9).filter(lambda n: n.denominator != 1))
        S = X**2 / 4 - Fraction(1, 2) - n
    else:
        k, m = draw(fractions(7)), draw(fractions(7))
        values = [s * k + t * m - Fraction(1, 2) for s, t in product((1, -1), repeat=2)]
        assume(not any(value >= 0 and value.denominator == 1 for value in values))
        S = Fraction(1, 4) - k / X + (4 * m * m - 1) / (4 * X**2)
    return Example(S, None, "none: " + kind)


@st.composite
def none_polynomial(draw: st.DrawFn) -> Example:
    """A polynomial S = Q^2 + R of even degree 2 nu, nu > 0, with deg R < nu and Q of leading coefficient q.

    omega = +-Q + P'/P, and P has degree (+-r/q - nu)/2 for the coefficient r of x^(nu-1) in R [Kovacic 1986, 3.1]: we take
    r so that neither is a natural number.  Case 2 is impossible, infinity being the only singular point.
    """
    nu = draw(st.integers(1, 12))
    Q = draw(polynomials(nu, nu))
    scale = draw(st.sampled_from([1, 1, 1, 7, 1000, 10**6 + 1, Fraction(1, 3), Fraction(1, 2**20), Fraction(10**9, 7)]))
    r = draw(integers(30)) * scale
    ratio = Fraction(r) / Q.coefficients()[-1]  # type: ignore[attr-defined]
    assume(not any((d := (sign * ratio - nu) / 2) >= 0 and d.denominator == 1 for sign in (1, -1)))
    rest = [draw(integers(9)) for _ in range(nu - 1)]
    return Example(RatFunc(Q * Q + QQ.poly([*rest, r])), None, "none: polynomial")


@st.composite
def by_kimura(draw: st.DrawFn) -> Example:
    """Gauss's equation with any rational exponent differences, labelled by Kimura's theorem."""
    values = fractions(8, (1, 2, 2, 3, 3, 4, 5, 5, 6, 7))
    differences = (draw(values), draw(values), draw(values))
    case, group = kimura(*differences)
    label = "none: hypergeometric" if case is None else f"case {case}: hypergeometric"
    return Example(transform.hypergeometric(*differences), case, label, group)


@st.composite
def none_near_schwarz(draw: st.DrawFn) -> Example:
    """Differences of Schwarz's list with the wrong parity: local data like case 3, yet SL2 or reducible."""
    group = draw(st.sampled_from(list(SCHWARZ)))
    text, _ = draw(st.sampled_from([row for row in SCHWARZ[group] if row[1]]))
    shifts = [draw(integers(2)) for _ in range(2)]
    shifts.append(2 * draw(integers(1)) + 1 + sum(shifts) % 2)
    differences = [base + shift for base, shift in zip(_row(text), shifts, strict=True)]
    case, name = kimura(*differences)
    return Example(transform.hypergeometric(*differences), case, "none: wrong parity", name)


@st.composite
def none_pull_back(draw: st.DrawFn) -> Example:
    """A pull-back of an equation with the group SL2, which is connected: nothing changes."""
    example = draw(st.one_of(none_classical(), by_kimura(), none_near_schwarz()))
    assume(example.case is None)
    f = draw(rational_functions(2))
    return replace(example, S=transform.pull_back(example.S, f), family=example.family + ", pulled back")


# -------------------------------------------------------------------------------------------- disguises


def moebius_maps() -> st.SearchStrategy[tuple[int, int, int, int]]:
    return st.tuples(*[integers(3)] * 4).filter(lambda m: m[0] * m[3] != m[1] * m[2])


@st.composite
def disguised(draw: st.DrawFn, examples: st.SearchStrategy[Example], largest: int = 14) -> Example:
    """A Moebius map, scaling, translation or gauge transform of an example, or the example as it is."""
    example = draw(examples)
    kind = draw(st.sampled_from(["as it is", "translation", "scaling", "Moebius", "gauge", "gauge, Moebius"]))
    S = example.S
    if kind == "translation":
        S = transform.translation(S, draw(fractions(9)))
    elif kind == "scaling":
        S = transform.scaling(S, draw(fractions(9).filter(bool)))
    if kind.startswith("gauge") and example.size <= largest:
        a, b = RatFunc(draw(polynomials(0, 1, 3))), RatFunc(QQ.poly([draw(nonzero(3))]))
        if draw(st.booleans()):
            a = a / RatFunc(QQ.poly([draw(integers(3)), 1]))
        try:
            S = transform.gauge(S, a, b)
        except ValueError:  # -a/b happens to solve the Riccati equation
            assume(False)
    if kind.endswith("Moebius"):
        S = transform.moebius(S, *draw(moebius_maps()))
    return replace(example, S=S)


def odd_shapes() -> st.SearchStrategy[Example]:
    """0, constants, polynomials with a square root at infinity, one pole."""
    x = X
    return st.one_of(
        integers(9).map(lambda c: Example(x * 0 + c, 1, "odd: constant")),
        fractions(30).map(lambda b: Example(b / x**2, 1, "odd: Euler")),
        st.integers(0, 40).map(lambda n: Example(x**2 + 2 * n + 1, 1, "odd: Hermite")),
        st.integers(0, 25).map(lambda n: Example(x**2 - 2 * n - 1, 1, "odd: Hermite")),
        nonzero(9).map(lambda c: Example(c / x, None, "odd: one simple pole")),
        st.integers(2, 9).map(lambda k: Example(1 / x ** (2 * k), 1 if k == 2 else None, "odd: one pole")),
        polynomials(0, 4).map(lambda P: Example(transform.from_omega(RatFunc(P)), 1, "odd: polynomial omega")),
    )


GENERATORS: dict[str, Callable[[], st.SearchStrategy[Example]]] = {
    "case 1: omega": case_1_omega,
    "case 1: diagonal": case_1_diagonal,
    "case 1: scalar": case_1_scalar,
    "case 1: apparent": case_1_apparent,
    "case 1: orthogonal polynomials": case_1_orthogonal,
    "case 2: semi-invariant": case_2_semi_invariant,
    "case 2: quaternion": case_2_quaternion,
    "case 2: dihedral": case_2_dihedral,
    **{f"case 3: Schwarz {g}": (lambda g=g: case_3_schwarz(g)) for g in SCHWARZ},
    **{f"case 3: pull-back {g}": (lambda g=g: case_3_pull_back(g)) for g in SCHWARZ},
    **{f"case 3: sparse {g}": (lambda g=g: case_3_sparse(g)) for g in SCHWARZ},
    "none: classical": none_classical,
    "none: polynomial": none_polynomial,
    "hypergeometric, by Kimura": by_kimura,
    "none: wrong parity": none_near_schwarz,
    "none: pull-back": none_pull_back,
    "odd shapes": odd_shapes,
}


def examples(*families: str) -> st.SearchStrategy[Example]:
    """Disguised examples of the families whose names start with one of these (all, without any)."""
    chosen = [make() for name, make in GENERATORS.items() if not families or name.startswith(families)]
    return disguised(st.one_of(*chosen))


@st.composite
def over_number_fields(draw: st.DrawFn, *families: str, largest: int = 8) -> Example:
    """Examples moved by a Moebius map with coefficients in a number field: its coefficients aren't rational any more."""
    example = draw(examples(*families).filter(lambda e: e.size <= largest))
    K = AlgebraicField(QQ, QQ.poly(draw(st.sampled_from([[-2, 0, 1], [1, 0, 1], [-5, -1, 1], [-2, 0, 0, 1]]))), "a")
    numbers = st.tuples(integers(3), integers(3)).map(lambda pair: K.poly([pair[0]]) + K.generator * pair[1])
    a, b, c, d = (draw(numbers) for _ in range(4))
    c = c if draw(st.booleans()) else K.poly([])
    assume(a * d - b * c)
    S = RatFunc(K.embed(example.S.num), K.embed(example.S.den))
    return replace(example, S=transform.moebius(S, a, b, c, d))


# ---------------------------------------------------------------------------- without a known answer


@st.composite
def rational_pole_equations(draw: st.DrawFn) -> RatFunc:
    """Small random S with rational poles, with local data that often meet the necessary conditions (for the oracle)."""
    S = RatFunc(QQ.poly([]))
    for c in draw(st.lists(integers(3), max_size=3, unique=True)):
        linear = RatFunc(QQ.poly([-c, 1]))
        kind = draw(st.sampled_from(["regular", "regular", "regular", "simple", "irregular"]))
        if kind == "irregular":
            S = S + draw(st.sampled_from([1, 4, 2, Fraction(1, 4)])) / linear ** draw(st.sampled_from([3, 4, 4, 6]))
        if kind != "simple":
            delta = draw(fractions(4, (1, 2, 2, 3, 4, 5)))
            S = S + (delta * delta - 1) / (4 * linear**2)
        S = S + draw(fractions(3, (1, 2, 4, 9))) * draw(st.sampled_from([1, 1, 1, 1001, Fraction(5, 1024)])) / linear
    kind = draw(st.sampled_from(["none", "none", "constant", "quadratic"]))
    if kind == "constant":
        S = S + draw(nonzero(4))
    elif kind == "quadratic":
        S = S + draw(st.sampled_from([1, 4])) * X**2 + draw(integers(5)) * X + draw(integers(9))
    return S


@st.composite
def parametric_equations(draw: st.DrawFn) -> str:
    """Small S with the parameters t and u, of every shape that `kovacic.conditions` treats in its own way."""
    rational = fractions(9, (1, 2, 4, 16)).map(str)
    with_parameter = ("t", "u", "t + 1", "t^2", "t*u", "t + u", "(t^2-1)/4", "t*(t+1)", "(4*u^2-1)/4")
    coefficient = st.one_of(st.sampled_from((*with_parameter, "-3/16", "-2/9", "3/4", "2")), rational)
    shapes = (
        ("x^2", "x", "1"),
        ("x^4", "x^2", "x"),
        ("1/x^2", "1/x", "1"),
        ("1/x^2", "1", "x^2"),
        ("1/x^2", "1/(x-1)^2", "1/(x*(x-1))"),
        ("1/x^2", "1/(x-1)^2", "1/(x+1)^2", "1/(x*(x-1))", "1/(x*(x+1))"),
        ("1/(x^2+t)^2", "1/(x^2+t)"),
        ("1/(x^2-2)^2", "1/(x^2+u)"),
        ("1/x^4", "1/x^3", "1/x^2", "1/x"),
    )
    return " + ".join(f"({draw(coefficient)})*{term}" for term in draw(st.sampled_from(shapes)))


def pole_orders(S: RatFunc) -> Iterator[int]:
    """Orders of the finite poles, factor by factor."""
    return (k for _, k in QQ.factor(S.den)) if S.den.degree > 0 else iter(())
