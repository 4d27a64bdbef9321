"""Equations of the standard lists, in normal form y'' = S(x) y, with parameters for which something is known.

Most normal forms are those of the NIST Digital Library of Mathematical Functions (https://dlmf.nist.gov), by section.
`case` is Kovacic's, None where no Liouvillian solution exists; the reason is beside each group.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Textbook:
    """One equation with its source."""

    name: str
    S: str
    case: int | None
    source: str


def equations() -> list[Textbook]:
    """The list."""
    found: list[Textbook] = []

    def add(name: str, S: str, case: int | None, source: str) -> None:
        found.append(Textbook(name, S, case, source))

    # Bessel: solvable exactly for half-odd nu.
    for nu in ("0", "1", "1/2", "3/2", "5/2", "7/2", "15/2", "1/3"):
        solvable = Fraction(nu).denominator == 2
        order = Fraction(nu) ** 2 - Fraction(1, 4)
        add(f"Bessel, nu = {nu}", f"-1 + ({order})/x^2", 1 if solvable else None, "DLMF 10.13.1, lambda = 1")
        add(f"modified Bessel, nu = {nu}", f"1 + ({order})/x^2", 1 if solvable else None, "DLMF 10.13.1, lambda = i")
    # w'' + z^(p-2) w = 0 has the order 1/p, here with p = 3, 4: none; with p = -2: half-odd never, p = 2/(2n+1) isn't rational.
    add("Airy", "x", None, "DLMF 9.2.1")
    add("x^2 without constant", "-x^2", None, "DLMF 10.13.3, p = 4")
    add("inverse fourth power", "-1/x^4", 1, "DLMF 10.13.3, p = -2")
    # Parabolic cylinder functions: solvable exactly for half-odd a.
    for a in ("1/2", "-1/2", "-3/2", "-5/2", "-21/2", "0", "1/4"):
        add(f"Weber, a = {a}", f"x^2/4 + ({a})", 1 if Fraction(a).denominator == 2 else None, "DLMF 12.2.2")
    # Whittaker: solvable exactly if one of +-kappa +- mu - 1/2 is a natural number.
    for kappa, mu, case in (
        ("1", "1/2", 1),
        ("5/2", "1", 1),
        ("7/3", "5/6", 1),
        ("1/2", "1/2", None),
        ("1/4", "0", None),
    ):
        add(
            f"Whittaker, kappa = {kappa}, mu = {mu}",
            f"1/4 - ({kappa})/x + (({mu})^2 - 1/4)/x^2",
            case,
            "DLMF 13.14.1",
        )
    # Legendre: solvable for integer degree nu (order 0), and for half-odd order (case 2 where nu isn't half-odd).
    for nu, mu, case in (
        ("0", "0", 1),
        ("1", "0", 1),
        ("2", "0", 1),
        ("10", "0", 1),
        ("1/2", "0", None),
        ("3", "2", 1),
        ("1/3", "1/2", 2),
    ):
        S = f"-(({nu})*(({nu})+1))/(1-x^2) - (1-({mu})^2)/(1-x^2)^2"
        add(f"Legendre, nu = {nu}, mu = {mu}", S, case, "DLMF 14.2.2, w*sqrt(1-x^2)")
    # Coulomb wave functions: rho as variable; solvable for no real eta.
    add("Coulomb, eta = 1, l = 0", "-1 + 2/x", None, "DLMF 33.2.1")
    add("Coulomb, eta = 1/2, l = 2", "-1 + 1/x + 6/x^2", None, "DLMF 33.2.1")
    # Hydrogen: Whittaker with kappa = n.
    for n, ell in ((1, 0), (2, 0), (3, 1), (10, 4)):
        add(
            f"hydrogen, n = {n}, l = {ell}",
            f"1 - {2 * n}/x + {ell * (ell + 1)}/x^2",
            1,
            "DLMF 18.39(ii), r scaled by n",
        )
    # Harmonic oscillator.
    for n in (0, 1, 2, 5, 20):
        add(f"oscillator, n = {n}", f"x^2 - {2 * n + 1}", 1, "DLMF 18.39(i), Table 18.8.1")
    # Euler's equation.
    for b, case in (("2", 1), ("-1/4", 1), ("1", 1), ("-1", 1), ("-3/16", 1)):
        add(
            f"Euler, S = {b}/x^2",
            f"({b})/x^2",
            case,
            "Boyce & DiPrima, Elementary Differential Equations, sec. 5.4, Euler equations",
        )
    # Hypergeometric with exponent differences (l, m, n) [Kimura 1969; Schwarz's list in DLMF 15.17(iv)].
    for (p, q, r), case in (
        (("1/2", "1/2", "1/3"), 2),
        (("1/2", "1/2", "1/7"), 2),
        (("1/2", "1/3", "1/3"), 3),
        (("1/2", "1/3", "1/4"), 3),
        (("1/2", "1/3", "1/5"), 3),
        (("2/5", "1/3", "1/3"), 3),
        (("1/2", "1/3", "1/7"), None),
        (("1/3", "1/3", "1/3"), 1),
        (("1/4", "1/4", "1/2"), 1),
    ):
        add(
            f"hypergeometric ({p}, {q}, {r})",
            _riemann(p, q, r),
            case,
            "DLMF 15.11, exponent differences at 0, 1, infinity",
        )
    return found


def _riemann(p: str, q: str, r: str) -> str:
    """Riemann's normal form with exponent differences p, q, r at 0, 1, infinity."""
    a, b, c = (1 - Fraction(v) ** 2 for v in (p, q, r))
    return f"-({a / 4})/x^2 - ({b / 4})/(x-1)^2 + ({(a + b - c) / 4})/(x*(x-1))"
