"""Run time against error for the ball's motion: quadratures of the closed form against direct integration.

    python benchmarks/motion.py [--oscillations 10000] [--samples 100] [--plot motion.png]

The reference is the closed form in 30-digit arithmetic (turning points, period and phase by mpmath).  The error is that of
u and omega_3 at the samples, spread over the last oscillation; the time includes everything, from the initial state on.
The direct integration is SciPy's DOP853 on Woronetz's eight equations, with rtol = tolerance, atol = tolerance/100.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import mpmath
import numpy as np
import sympy as sp

from kovacic.mechanics import Ball, U
from kovacic.mechanics.ball import BallOnSphere
from kovacic.mechanics.closed import NumericBall
from kovacic.mechanics.direct import State, equations
from kovacic.mechanics.motion import solve_motion

SPHERE = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
POTENTIAL = sp.Rational(3, 2) * sp.cos(U)
START = State(1.0, 0.1, 0.3, 1.2, 0.2, 0.5, 0.25, 2.0)


class Precise:
    """x and omega_3 at any time, by the quadrature for t(phi), in mpmath's arithmetic."""

    def __init__(self, sphere: BallOnSphere, start: State) -> None:
        self.ball = NumericBall.of(sphere, mpmath)
        mpf = mpmath.mpf
        self.x0, self.n0 = mpmath.cos(mpf(start.u)), mpf(start.n)
        sine2 = 1 - self.x0**2
        self.w0 = self.x0 * self.n0 - (1 + self.ball.rho) * sine2 * mpf(start.dv)
        kinetic = self.ball.K11(self.x0) * mpf(start.du) ** 2
        kinetic += self.ball.transverse_energy(self.x0, sine2, self.w0, self.n0) / sine2
        self.energy = kinetic / 2 + mpf(3) / 2 * self.x0
        rough = solve_motion(sphere, POTENTIAL, start).turning_points
        self.top, self.bottom = (mpmath.findroot(self.W, mpmath.cos(mpf(u))) for u in rough)
        self.middle, self.amp = (self.top + self.bottom) / 2, (self.top - self.bottom) / 2
        self.coefficients, self.mean = self._series()
        self.period = 2 * mpmath.pi * self.mean
        phi_0 = mpmath.acos((self.x0 - self.middle) / self.amp)
        self.begin = self.time(phi_0 if start.du >= 0 else -phi_0)

    def W(self, x: mpmath.mpf) -> mpmath.mpf:
        omega_3, n = self.ball.transport(x, self.x0, self.w0, self.n0)
        sine2 = 1 - x * x
        V = mpmath.mpf(3) / 2 * x
        transverse = self.ball.transverse_energy(x, sine2, omega_3, n)
        return (2 * (self.energy - V) * sine2 - transverse) / self.ball.K11(x)

    def _series(self) -> tuple[list[mpmath.mpf], mpmath.mpf]:
        count = 64
        nodes = [(mpmath.mpf(j) + mpmath.mpf(1) / 2) * mpmath.pi / count for j in range(count)]
        values = []
        for phi in nodes:
            x = self.middle + self.amp * mpmath.cos(phi)
            values.append(self.amp * mpmath.sin(phi) / mpmath.sqrt(self.W(x)))
        sums = [
            2 * mpmath.fsum(v * mpmath.cos(k * p) for v, p in zip(values, nodes, strict=True)) / count
            for k in range(48)
        ]
        return [sums[k] / k for k in range(1, 48)], sums[0] / 2

    def time(self, phi: mpmath.mpf) -> mpmath.mpf:
        return self.mean * phi + mpmath.fsum(c * mpmath.sin((k + 1) * phi) for k, c in enumerate(self.coefficients))

    def at(self, t: float) -> tuple[float, float]:
        """(u, omega_3) at time t."""
        rest = mpmath.fmod(mpmath.mpf(t) + self.begin, self.period)
        phi = mpmath.findroot(lambda p: self.time(p) - rest, (0, 2 * mpmath.pi), solver="anderson", tol=1e-50)
        x = self.middle + self.amp * mpmath.cos(phi)
        return float(mpmath.acos(x)), float(self.ball.transport(x, self.x0, self.w0, self.n0)[0])


def closed(tolerance: float, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    motion = solve_motion(SPHERE, POTENTIAL, START, tolerance=tolerance)
    phi = motion.phase(times)
    return motion.band.colatitude(phi), motion.rotation(phi)[0]


def direct(tolerance: float, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    from dataclasses import astuple

    from scipy.integrate import solve_ivp

    result = solve_ivp(
        SYSTEM.rates,
        (0.0, times[-1]),
        astuple(START),
        method="DOP853",
        t_eval=times,
        rtol=max(tolerance, 2.3e-14),
        atol=tolerance / 100,
    )
    return result.y[0], np.array([SYSTEM.omega_3(list(column)) for column in result.y.T])


SYSTEM = equations(SPHERE.body, POTENTIAL)  # compiled beforehand: not part of the direct integration's time


def measure(
    method: Callable[..., tuple[np.ndarray, np.ndarray]], tolerance: float, times: np.ndarray, reference: np.ndarray
):
    begin = time.perf_counter()
    values = np.array(method(tolerance, times))
    return time.perf_counter() - begin, float(np.abs(values - reference).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--oscillations", type=int, default=10_000)
    parser.add_argument("--samples", type=int, default=100)
    parser.add_argument("--tolerances", default="3,4,5,6,7,8,9,10,11,12", help="decimal exponents")
    parser.add_argument("--plot")
    options = parser.parse_args()
    with mpmath.workdps(30):
        precise = Precise(SPHERE, START)
        period = float(precise.period)
        times = period * (options.oscillations - 1 + np.arange(1, options.samples + 1) / options.samples)
        reference = np.array([precise.at(t) for t in times]).T
    closed(1e-13, times)
    print(f"{options.oscillations} oscillations, period {period:.12f}, {options.samples} samples in the last one")
    print(f"{'tolerance':>10} {'closed form':>13} {'error':>9} {'direct':>11} {'error':>9} {'ratio':>8}")
    rows = []
    for exponent in map(int, options.tolerances.split(",")):
        tolerance = 10.0**-exponent
        quick = min((measure(closed, tolerance, times, reference) for _ in range(3)), key=lambda pair: pair[0])
        slow = measure(direct, tolerance, times, reference)
        rows.append((tolerance, *quick, *slow))
        print(
            f"{tolerance:>10.0e} {quick[0] * 1e3:>10.2f} ms {quick[1]:>9.1e} {slow[0] * 1e3:>8.0f} ms {slow[1]:>9.1e}"
            f" {slow[0] / quick[0]:>8.0f}",
            flush=True,
        )
    if options.plot:
        draw(rows, options.plot, options.oscillations)


def draw(rows: list[tuple[float, ...]], path: str, oscillations: int) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.5), layout="constrained", dpi=120)
    axes = figure.add_subplot()
    data = np.array(rows)
    axes.loglog(data[:, 2], data[:, 1], "o-", color="#1f5f99", label="closed form and quadratures")
    axes.loglog(data[:, 4], data[:, 3], "s-", color="#d9731a", label="direct integration, DOP853")
    axes.invert_xaxis()
    axes.set(xlabel=r"largest error of $u$ and $\omega_3$", ylabel="run time (s)")
    axes.set_title(f"ball on a sphere, {oscillations} oscillations; tolerances 1e-3 ... 1e-12", fontsize=10)
    axes.grid(True, which="major", color="#dddddd")
    axes.legend()
    figure.savefig(path)


if __name__ == "__main__":
    main()
