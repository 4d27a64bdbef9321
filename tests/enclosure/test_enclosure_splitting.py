"""Binary splitting and the bit-burst method against the way term by term, and against FLINT's own special functions."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import flint
import pytest
from build import ExactPoint, System, as_problem, ball_to_flint, evaluate_states, make_frame, parametrize
from clocks import interrupted
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from strategies import Example, examples, fractions, integers, nonzero

from kovacic import InputError, LimitExceeded, Limits, connection_matrix, evaluate
from kovacic.enclosure import transport
from kovacic.enclosure.frame import Frame
from kovacic.enclosure.matrices import Matrix, product
from kovacic.enclosure.splitting import LEAF, GaussianMatrix, Recurrence, bit_burst, is_split, make_block, split_legs
from kovacic.enclosure.taylor import expand, transition

AIRY = System.make((0, 1), (1,))
LEGENDRE = System.make((-13, 0, 4), (9, 0, -18, 0, 9))  # nu = 1/3: S = -(4/9 (1 - x^2) + 1)/(1 - x^2)^2
DIGITS = 5000


def both_ways(system: System, path: list[ExactPoint], prec: int) -> tuple[Matrix, Matrix]:
    """The transition matrix term by term, and by splitting."""
    matrices = []
    with flint.ctx.workprec(prec + 40), pytest.MonkeyPatch.context() as patch:
        for split in (False, True):
            patch.setattr(transport, "is_split", lambda system, prec, split=split: split)
            try:
                matrices.append(
                    product([m for a, b in pairwise(path) for m in transport.piece_matrices(system, a, b, prec)])
                )
            except InputError:
                assume(False)
    return matrices[0], matrices[1]


def overlap(m: Matrix, n: Matrix) -> bool:
    return all(x.overlaps(y) for x, y in zip(m, n, strict=True))


def lost_bits(m: Matrix, prec: int) -> int:
    """How many of `prec` bits, relative to the largest entry, the worst entry lacks."""
    exponent = max(_exponent(x.abs_upper()) for x in m)
    return max(_exponent(r) for x in m for r in (x.real.rad(), x.imag.rad())) - exponent + prec


def _exponent(x: flint.arb) -> int:
    mantissa, exponent = x.man_exp()
    return int(exponent) + int(mantissa).bit_length() if mantissa else -(10**9)


# --- the recurrence ---------------------------------------------------------------------------------------------------


@st.composite
def equations(draw: st.DrawFn) -> Recurrence:
    """Q y'' = P y over Z[i]."""

    def polynomial(size: int, first: int | None) -> tuple[list[int], list[int] | None]:
        re, im = ([draw(integers(9)) for _ in range(size)] for _ in (0, 1))
        if first is not None:
            re[0], im[0] = first, 0
        return re, im if draw(st.booleans()) else None

    p, q = polynomial(draw(st.integers(0, 3)), None), polynomial(draw(st.integers(1, 5)), abs(draw(nonzero(9))))
    return Recurrence(p, q)


def coefficients(equation: Recurrence, start: int, count: int) -> list[ExactPoint]:
    """b_0, ..., b_(count-1) one by one, exactly."""
    P, Q = (
        [ExactPoint(Fraction(x), Fraction(y)) for x, y in zip(re, im or [0] * len(re), strict=True)]
        for re, im in (equation.P, equation.Q)
    )
    b = [ExactPoint(Fraction(1 - start)), ExactPoint(Fraction(start))]
    for m in range(2, count):
        total = ExactPoint(Fraction(0))
        for j, c in enumerate(P):
            total += c * b[m - 2 - j] if m - 2 - j >= 0 else ExactPoint(Fraction(0))
        for j, c in enumerate(Q[1:], 1):
            total -= (c * b[m - j]).scaled(Fraction((m - j) * (m - 1 - j))) if m - j >= 0 else ExactPoint(Fraction(0))
        b.append(total.scaled(1 / (Q[0].re * m * (m - 1))))
    return b


@pytest.mark.long
@given(equations(), st.integers(1, 5), st.booleans())
def test_a_run_gives_the_same_sums_as_step_by_step(equation: Recurrence, leaves: int, mirror: bool) -> None:
    run = make_block(equation.leaf(mirror), 2, leaves)
    r, count = equation.order, 2 + leaves * LEAF
    for start in (0, 1):
        b = coefficients(equation, start, count)
        state = [ExactPoint(Fraction(0))] * (r - 2) + b[:2]
        for matrix, expected in ((run.C, b[-r:]), (run.R, sums_from_2(b, mirror))):
            found = [product_row(matrix, i, state).scaled(Fraction(1, int(run.D))) for i in range(matrix.re.nrows())]
            assert found == expected


def product_row(matrix: GaussianMatrix, i: int, state: list[ExactPoint]) -> ExactPoint:
    row = [ExactPoint(Fraction(int(matrix.re[i, k])), _imaginary(matrix, i, k)) for k in range(len(state))]
    return sum((x * y for x, y in zip(row, state, strict=True)), ExactPoint(Fraction(0)))


def _imaginary(matrix: GaussianMatrix, i: int, k: int) -> Fraction:
    return Fraction(0) if matrix.im is None else Fraction(int(matrix.im[i, k]))


def sums_from_2(b: list[ExactPoint], mirror: bool) -> list[ExactPoint]:
    """sum b_m v^m and sum m b_m v^(m-1) over m >= 2 at v = 1 (and at v = -1)."""
    return [
        sum(
            (b[m].scaled(Fraction(v**m if slope == 0 else m * v ** (m - 1))) for m in range(2, len(b))),
            ExactPoint(Fraction(0)),
        )
        for v in ((1, -1) if mirror else (1,))
        for slope in (0, 1)
    ]


# --- both ways --------------------------------------------------------------------------------------------------------

points = st.builds(ExactPoint, fractions(3, (1, 2, 7, 10**9)), fractions(2, (1, 3, 8)))


@pytest.mark.long
@settings(max_examples=8)
@given(examples().filter(lambda example: example.size <= 5), points, points)
def test_both_ways_agree_for_equations_of_every_case(example: Example, a: ExactPoint, b: ExactPoint) -> None:
    m, n = both_ways(as_problem(example.S).system, [a, b], 300)
    assert overlap(m, n)
    assert lost_bits(n, 300) <= max(8, lost_bits(m, 300))


def random_system(rng: random.Random) -> System:
    den = [rng.choice([-3, -1, 1, 2, 7]) for _ in range(rng.randint(0, 3))] + [rng.choice([1, 2, 5])]
    return System.make(tuple(rng.choice([-9, -1, 0, 1, 4, 99]) for _ in range(rng.randint(0, 3))), tuple(den))


@parametrize("seed", range(10), ordinary=1, long=5)
def test_both_ways_agree_at_a_thousand_digits_with_end_points_of_any_length(seed: int) -> None:
    """Short ends (mirrored legs), decimal ones, and ones of a thousand digits; real and complex."""
    rng = random.Random(seed)
    system, denominator = random_system(rng), (7, 10**16, 10**1000)[seed % 3]

    def end() -> ExactPoint:
        re, im = (Fraction(rng.randint(-denominator, denominator), denominator) for _ in (0, 1))
        return ExactPoint(re, im if seed % 2 else Fraction(0))

    a = end()
    b = a + end().scaled(Fraction(1, 4))
    try:
        m, n = both_ways(system, [a, b], 3400)
    except InputError:
        pytest.skip("the random path meets a singular point")
    assert overlap(m, n)
    assert lost_bits(n, 3400) <= 8


@pytest.fixture(params=["real", "complex"])
def disc(request: pytest.FixtureRequest) -> Iterator[tuple[Frame, ExactPoint]]:
    """A disc for Legendre's equation and a point near its edge."""
    im = Fraction(request.param == "complex", 4)
    with flint.ctx.workprec(3000):
        frame = make_frame(LEGENDRE, ExactPoint(Fraction(1, 8), im), -2)
        assert frame is not None
        yield frame, ExactPoint(Fraction(5, 16), im)


def test_mirrored_legs_are_two_legs(disc: tuple[Frame, ExactPoint]) -> None:
    frame, target = disc
    other = frame.centre + frame.centre - target
    there, back = split_legs(LEGENDRE, frame, target, 2500, mirror=True)
    for point, matrix in zip((target, other), (there, back), strict=True):
        (alone,) = split_legs(LEGENDRE, frame, point, 2500)
        assert overlap(alone, matrix)
        assert lost_bits(matrix, 2500) <= 8


@parametrize("tiny", [Fraction(1, 3**40), Fraction(1, 10**400), Fraction(3**250, 7**350)], ordinary=0, long=2)
def test_a_chain_of_doubling_steps_is_one_step(disc: tuple[Frame, ExactPoint], tiny: Fraction) -> None:
    frame, target = disc
    target = target + ExactPoint(tiny, tiny if frame.centre.im else Fraction(0))
    (alone,) = split_legs(LEGENDRE, frame, target, 2500)
    chain = bit_burst(LEGENDRE, frame, target, 2500)
    matrix = product(chain)
    assert len(chain) > 1
    assert overlap(alone, matrix)
    assert lost_bits(matrix, 2500) <= 8
    assert bit_burst(LEGENDRE, frame, frame.centre, 2500) == []


@pytest.mark.long
def test_the_slopes_of_the_short_last_steps_of_a_chain_lose_nothing() -> None:
    frame, target, prec = (
        make_frame(AIRY, ExactPoint(Fraction(0)), 0),
        ExactPoint(Fraction(7**8000, 7**8001 + 1)),
        30_000,
    )
    assert frame is not None
    with flint.ctx.workprec(prec + 40):
        chain = bit_burst(AIRY, frame, target, prec)
        alone = transition(expand(frame, prec), target)
        assert overlap(product(chain), alone)
    assert all(lost_bits(matrix, prec) <= 0 for matrix in chain)


def test_points_outside_of_the_bounds_of_a_disc_are_refused(disc: tuple[Frame, ExactPoint]) -> None:
    """Rounded to 16 bits, a point of the disc may lie outside by 2^-17 in both parts; there the bounds hold."""
    frame, _ = disc
    corner = ExactPoint(Fraction(3, 5) + Fraction(1, 1 << 17), Fraction(4, 5) + Fraction(1, 1 << 17))
    assert corner.norm_squared() > 1
    frame.seen(frame.centre + corner.scaled(frame.scale))
    outside = frame.centre + ExactPoint(0, 1 + Fraction(1, 1 << 15)).scaled(frame.scale)
    for beyond in (outside, outside + ExactPoint(Fraction(1, 3**60))):
        with pytest.raises(ArithmeticError, match="outside of its disc"):
            bit_burst(LEGENDRE, frame, beyond, 2500)
        with pytest.raises(ArithmeticError, match="outside of its disc"):
            transition(expand(frame, 100), beyond)


def test_a_disc_smaller_than_any_double_keeps_its_error_bound() -> None:
    frame = make_frame(LEGENDRE, ExactPoint(Fraction(0)), -1400)
    assert frame is not None
    assert frame.bound.gain > 0
    assert frame.bound.slope_gain > 0


def test_a_polynomial_solution_comes_out_exactly() -> None:
    ball = evaluate(([0], [1]), "1/3", x0=0, y0=1, dy0=-1, digits=2000)
    assert ball.contains(Fraction(2, 3))
    assert ball.radius < 1e-300


# --- against FLINT ----------------------------------------------------------------------------------------------------


def carried(matrix: object, y: flint.arb, dy: flint.arb) -> flint.arb:
    (a, b), _ = matrix  # type: ignore[misc]
    return ball_to_flint(a).real * y + ball_to_flint(b).real * dy


def test_five_thousand_digits_of_airy_functions() -> None:
    assert is_split(AIRY, 3 * DIGITS)
    matrix = connection_matrix(AIRY, [0, 1], digits=DIGITS)
    with flint.ctx.workdps(DIGITS + 20):
        zero, one = flint.arb(0), flint.arb(1)
        for name in ("airy_ai", "airy_bi"):
            value, start = getattr(one, name)(), (getattr(zero, name)(), getattr(zero, name)(derivative=1))
            assert carried(matrix, *start).overlaps(value)
            assert carried(matrix, *start).rel_accuracy_bits() > 3.32 * DIGITS - 8


@pytest.mark.long
def test_five_thousand_digits_of_a_bessel_function_of_order_one_third() -> None:
    S = ([-5, 0, -36], [0, 0, 36])  # y = sqrt(x) J_(1/3)(x)
    matrix = connection_matrix(S, [1, Fraction(3, 2)], digits=DIGITS)
    with flint.ctx.workdps(DIGITS + 20):
        nu, x, end = flint.arb(1) / 3, flint.arb(1), flint.arb(3) / 2
        J = x.bessel_j(nu)
        slope = (x.bessel_j(nu - 1) - x.bessel_j(nu + 1)) / 2
        assert carried(matrix, J, J / 2 + slope).overlaps(end.sqrt() * end.bessel_j(nu))


@pytest.mark.long
@pytest.mark.parametrize("x", ["1/3", "0.3141592653589793"])
def test_five_thousand_digits_of_a_legendre_function_of_order_one_third(x: str) -> None:
    assert is_split(LEGENDRE, 3 * DIGITS)
    matrix = connection_matrix(LEGENDRE, [0, x], digits=DIGITS)
    with flint.ctx.workdps(DIGITS + 20):
        nu, end = flint.arb(1) / 3, flint.arb(flint.fmpq(*Fraction(x).as_integer_ratio()))
        start = (flint.arb(0).legendre_p(nu), nu * flint.arb(0).legendre_p(nu - 1))
        assert carried(matrix, *start).overlaps((1 - end * end).sqrt() * end.legendre_p(nu))


def test_the_goal_is_met_in_one_run_above_the_crossover() -> None:
    (state,) = evaluate_states(LEGENDRE, ["2/5"], x0="-1/7", y0=1, dy0=2, digits=3000)
    assert state.reached
    assert state.route.runs == 1


# --- limits -----------------------------------------------------------------------------------------------------------


def test_an_exhausted_limit_and_an_interruption_leave_the_precision_alone() -> None:
    before = flint.ctx.prec
    with pytest.raises(LimitExceeded):
        evaluate(LEGENDRE, "1/3", x0=0, y0=1, dy0=0, digits=50_000, limits=Limits(seconds=0.1))
    assert flint.ctx.prec == before

    with pytest.raises(KeyboardInterrupt), interrupted(20):
        evaluate(LEGENDRE, "1/3", x0=0, y0=1, dy0=0, digits=5000)
    assert flint.ctx.prec == before
