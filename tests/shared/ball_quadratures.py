"""The period of u and the gain of v by quadratures, as the theory has them: nothing is integrated step by step."""

from __future__ import annotations

import mpmath


def quadratures(sphere, start, turning):
    """The period and the gain of v under V = cos u, from Woronetz's energy and the closed form, by mpmath alone."""
    mpf = mpmath.mpf
    m, R, a, A1, A3 = (mpf(p.p) / p.q for p in sphere.ball.parameters)
    rho, lead = R / int(sphere.R1), m * R**2 * (A3 - A1)

    def half(x):
        return m * R * ((A3 - A1) * R * x + A3 * a)

    def spins(x):
        D = [A1 * (A3 + m * R**2 * (1 - z * z)) + A3 * m * (R * z + a) ** 2 for z in (x0, x)]
        root0, root = map(mpmath.sqrt, D)
        eta0, zeta0 = omega_0 * root0, m * R**2 * A1 * mpf(start.n) + half(x0) * omega_0
        scale = mpmath.sqrt(lead) if lead else mpf(10) ** -28
        angle = 2 * rho * mpmath.atanh(scale * (x - x0) / (root + root0))
        eta = mpmath.re(eta0 * mpmath.cosh(angle) - zeta0 * mpmath.sinh(angle) / scale)
        zeta = mpmath.re(zeta0 * mpmath.cosh(angle) - scale * eta0 * mpmath.sinh(angle))
        return eta / root, (zeta - half(x) * eta / root) / (m * R**2 * A1)

    def transverse(x):
        (omega_3, n), sine2, eps = spins(x), 1 - x * x, R + a * x
        y = x * n - omega_3
        mixed = 2 * (m * eps * a - (A3 - A1) * x) * sine2 * y * n
        first = (m * eps**2 + A1 * x**2 + A3 * sine2) * y**2
        return first + mixed + ((m * a**2 + A1) * sine2 + A3 * x**2) * sine2 * n**2

    def K11(x):
        return (1 + rho) ** 2 * (A1 + m * (R**2 + a**2 + 2 * R * a * x))

    x0 = mpmath.cos(mpf(start.u))
    omega_0 = x0 * mpf(start.n) - (1 + rho) * (1 - x0**2) * mpf(start.dv)
    energy = (K11(x0) * mpf(start.du) ** 2 + transverse(x0) / (1 - x0**2)) / 2 + x0

    def W(x):
        return (2 * (energy - x) * (1 - x * x) - transverse(x)) / K11(x)

    top, bottom = (mpmath.findroot(W, mpmath.cos(mpf(u))) for u in turning)
    middle, amp, count = (top + bottom) / 2, (top - bottom) / 2, 96
    nodes = [middle + amp * mpmath.cos((mpf(2 * j + 1) / 2) * mpmath.pi / count) for j in range(count)]
    weights = [2 * mpmath.pi / count * mpmath.sqrt((top - x) * (x - bottom) / W(x)) for x in nodes]
    rates = [(x * n - omega_3) / ((1 + rho) * (1 - x * x)) for x in nodes for omega_3, n in [spins(x)]]
    return mpmath.fsum(weights), mpmath.fsum(p * q for p, q in zip(weights, rates, strict=True))
