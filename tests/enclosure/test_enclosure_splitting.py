"""Binary splitting and the bit-burst method against the way term by term, and against FLINT's own special functions."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import flint
import pytest
from build import (
    ExactPoint,
    System,
    as_problem,
    ball_to_flint,
    evaluate_states,
    generated,
    make_frame,
    parametrize,
    system_of,
)
from clocks import interrupted
from hypothesis import assume, given
from hypothesis import strategies as st
from strategies import Example, examples, fractions, integers, nonzero

from kovacic import InputError, LimitExceeded, Limits, connection_matrix, evaluate
from kovacic.enclosure import rational
from kovacic.enclosure.frame import Frame
from kovacic.enclosure.matrices import Matrix, matrix_product
from kovacic.enclosure.splitting import SplitRecurrence, bit_burst, is_split, split_legs
from kovacic.enclosure.taylor import expand
from kovacic.enclosure.way import transition

AIRY = system_of((0, 1), (1,))
LEGENDRE = system_of((-13, 0, 4), (9, 0, -18, 0, 9))  # nu = 1/3: S = -(4/9 (1 - x^2) + 1)/(1 - x^2)^2
DIGITS = 5000


def pair_of(system: System) -> tuple[list[int], list[int]]:
    """S as a pair of coefficient lists."""
    return list(system.num), list(system.den)


def both_ways(system: System, path: list[ExactPoint], prec: int) -> tuple[Matrix, Matrix]:
    """The transition matrix term by term, and by splitting."""
    matrices = []
    with flint.ctx.workprec(prec + 40), pytest.MonkeyPatch.context() as patch:
        for split in (False, True):
            patch.setattr(rational, "is_split", lambda *_, split=split: split)
            way = rational.RationalWay(as_problem(pair_of(system)), prec=prec)
            try:
                for a, b in pairwise(path):
                    way.check(a, b)
                matrices.append(
                    matrix_product([step.affine()[0] for a, b in pairwise(path) for step in way.walk(a, b, alone=True)])
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
def equations(draw: st.DrawFn) -> SplitRecurrence:
    """Q y'' = P y over Z, or over Z[i]."""

    def polynomial(most: int) -> tuple[list[int], list[int]]:
        size = draw(st.integers(0, most))
        return [draw(integers(9)) for _ in range(size)], [draw(integers(9)) for _ in range(size)]

    (p, p_im), (q, q_im) = polynomial(3), polynomial(4)
    is_complex = draw(st.booleans())
    P = (p, p_im if is_complex else None)
    return SplitRecurrence(
        P, ([abs(draw(nonzero(9))), *q], [0, *q_im] if is_complex else None), mirror=draw(st.booleans())
    )


def gaussian(parts: tuple[list[int], list[int] | None]) -> list[ExactPoint]:
    return [ExactPoint(re, im) for re, im in zip(parts[0], parts[1] or [0] * len(parts[0]), strict=True)]


def coefficients(equation: SplitRecurrence, start: int, count: int) -> list[ExactPoint]:
    """b_0, ..., b_(count-1) one by one, exactly."""
    P, Q = gaussian(equation.P), gaussian(equation.Q)
    b = [ExactPoint(1 - start), ExactPoint(start)]
    for m in range(2, count):
        terms = [c * b[m - 2 - j] for j, c in enumerate(P) if m - 2 - j >= 0]
        terms += [(c * b[m - j]).scaled(-(m - j) * (m - 1 - j)) for j, c in enumerate(Q) if 0 < j <= m]
        b.append(sum(terms, ExactPoint(0)).scaled(1 / (Q[0].x * m * (m - 1))))
    return b


@pytest.mark.long
@given(equations(), st.integers(1, 40))
def test_a_run_gives_the_same_sums_as_step_by_step(equation: SplitRecurrence, steps: int) -> None:
    run = equation.block(2, steps)
    r, count = equation.order, 2 + steps
    for start in (0, 1):
        b = [ExactPoint(0)] * r + coefficients(equation, start, count)
        state = in_parts(b[2 : r + 2], equation)
        for matrix, expected in ((run.C, b[-r:]), (run.R, sums_from_2(b[r:], equation.mirror))):
            rows = [[Fraction(int(entry)) for entry in row] for row in matrix.tolist()]
            found = [sum(x * y for x, y in zip(row, state, strict=True)) / int(run.D) for row in rows]
            assert found == in_parts(expected, equation)


def in_parts(vector: list[ExactPoint], equation: SplitRecurrence) -> list[Fraction]:
    """The real parts, and then the imaginary ones of an equation that isn't real."""
    return [v.re for v in vector] + ([] if equation.is_real else [v.im for v in vector])


def sums_from_2(b: list[ExactPoint], mirror: bool) -> list[ExactPoint]:
    """sum b_m v^m and sum m b_m v^(m-1) over m >= 2 at v = 1 (and at v = -1)."""
    return [
        sum((b[m].scaled(v**m if slope == 0 else m * v ** (m - 1)) for m in range(2, len(b))), ExactPoint(0))
        for v in ((1, -1) if mirror else (1,))
        for slope in (0, 1)
    ]


# --- both ways --------------------------------------------------------------------------------------------------------

parts = fractions(3, (1, 2, 7, 10**9))
points = st.builds(ExactPoint, parts) | st.builds(ExactPoint, parts, parts)


@pytest.mark.long
@generated(3)
@given(examples().filter(lambda example: example.size <= 5), points, points)
def test_both_ways_agree_for_equations_of_every_case(example: Example, a: ExactPoint, b: ExactPoint) -> None:
    m, n = both_ways(as_problem(example.S).system, [a, b], 300)
    assert overlap(m, n)
    assert lost_bits(n, 300) <= max(8, lost_bits(m, 300))


def random_system(rng: random.Random) -> System:
    den = [rng.choice([-3, -1, 1, 2, 7]) for _ in range(rng.randint(0, 3))] + [rng.choice([1, 2, 5])]
    return system_of(tuple(rng.choice([-9, -1, 0, 1, 4, 99]) for _ in range(rng.randint(0, 3))), tuple(den))


@parametrize("seed", range(10), ordinary=1, long=(1, 2))
def test_both_ways_agree_at_a_thousand_digits_with_end_points_of_any_length(seed: int) -> None:
    """Short ends (mirrored legs), decimal ones, and ones of a thousand digits; on the real axis, or beside it."""
    rng = random.Random(seed)
    system, denominator = random_system(rng), (7, 10**16, 10**1000)[seed % 3]

    def end() -> ExactPoint:
        x, y = (Fraction(rng.randint(-denominator, denominator), denominator) for _ in range(2))
        return ExactPoint(x, 0 if seed % 2 else y)

    a = end()
    b = a + end().scaled(Fraction(1, 4))
    try:
        m, n = both_ways(system, [a, b], 3400)
    except InputError:
        pytest.skip("the random path meets a singular point")
    assert overlap(m, n)
    assert lost_bits(n, 3400) <= 8


@pytest.fixture
def disc() -> Iterator[tuple[Frame, ExactPoint]]:
    """A disc for Legendre's equation and a point near its edge."""
    with flint.ctx.workprec(3000):
        frame = make_frame(LEGENDRE, ExactPoint(Fraction(1, 8)), -2)
        assert frame is not None
        yield frame, ExactPoint(Fraction(5, 16))


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
    target = target + ExactPoint(tiny)
    (alone,) = split_legs(LEGENDRE, frame, target, 2500)
    chain = bit_burst(LEGENDRE, frame, target, 2500)
    matrix = matrix_product(chain)
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
        assert overlap(matrix_product(chain), alone)
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
    matrix = connection_matrix(pair_of(AIRY), [0, 1], digits=DIGITS)
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


@parametrize("x", ["1/3", "0.3141592653589793"], ordinary=0, long=1)
def test_five_thousand_digits_of_a_legendre_function_of_order_one_third(x: str) -> None:
    assert is_split(LEGENDRE, 3 * DIGITS)
    matrix = connection_matrix(pair_of(LEGENDRE), [0, x], digits=DIGITS)
    with flint.ctx.workdps(DIGITS + 20):
        nu, end = flint.arb(1) / 3, flint.arb(flint.fmpq(*Fraction(x).as_integer_ratio()))
        start = (flint.arb(0).legendre_p(nu), nu * flint.arb(0).legendre_p(nu - 1))
        assert carried(matrix, *start).overlaps((1 - end * end).sqrt() * end.legendre_p(nu))


def test_the_goal_is_met_in_one_run_above_the_crossover() -> None:
    (state,) = evaluate_states(pair_of(LEGENDRE), ["2/5"], x0="-1/7", y0=1, dy0=2, digits=3000)
    assert state.missing == 0
    assert state.route.runs == 1


# --- limits -----------------------------------------------------------------------------------------------------------


def test_an_exhausted_limit_and_an_interruption_leave_the_precision_alone() -> None:
    before = flint.ctx.prec
    with pytest.raises(LimitExceeded):
        evaluate(pair_of(LEGENDRE), "1/3", x0=0, y0=1, dy0=0, digits=50_000, limits=Limits(seconds=0.1))
    assert flint.ctx.prec == before

    with pytest.raises(KeyboardInterrupt), interrupted(20):
        evaluate(pair_of(LEGENDRE), "1/3", x0=0, y0=1, dy0=0, digits=5000)
    assert flint.ctx.prec == before
