"""The equation of a ball with displaced centre of mass that rolls on a sphere, for several ratios of the radii.

    S(x) = (1 + 8k^2)/(8 (x1 - x2)(x - x1)) - 3/(16 (x - x1)^2) - (1 + 8k^2)/(8 (x1 - x2)(x - x2)) - 3/(16 (x - x2)^2)

with k = R/R1.  It has case 1 exactly when 2k is an integer, and case 2 otherwise.  With D = (x - x1)(x - x2) it is
S = (1 + 8k^2)/(8D) - (3/16)(D'^2/D^2 - 2/D), so x1 and x2 may be conjugate roots: S still has rational coefficients.

Run: python examples/ball_equation.py
"""

from __future__ import annotations

from fractions import Fraction

import kovacic

# D, as text: the roots 1 and -1, 5/3 and -7, and 2 +- sqrt(3).
DENOMINATORS = {
    "x1, x2 = 1, -1": ("x^2 - 1", "2*x"),
    "x1, x2 = 5/3, -7": ("(x - 5/3)*(x + 7)", "2*x + 16/3"),
    "x1, x2 the roots of x^2 - 4x + 1": ("x^2 - 4*x + 1", "2*x - 4"),
}
RATIOS = {
    1: [Fraction(1, 2), Fraction(1), Fraction(3, 2), Fraction(2), Fraction(5, 2)],
    2: [Fraction(1, 3), Fraction(3, 4), Fraction(5, 7)],
}


def coefficient(k: Fraction, D: str, derivative: str) -> str:
    """S as text."""
    return f"({1 + 8 * k * k})/(8*({D})) - 3/16*(({derivative})^2/({D})^2 - 2/({D}))"


def main() -> None:
    for places, (D, derivative) in DENOMINATORS.items():
        print(places)
        for case, ratios in RATIOS.items():
            for k in ratios:
                answer = kovacic.solve(coefficient(k, D, derivative))
                print(f"  k = {k}: case {answer.case}, {answer.seconds:.3f} s")
                if answer.case != case or not answer.verify():
                    raise SystemExit(f"expected case {case}")
    # The same equation as it is usually written, with explicit poles.
    given = "9/(8*2*(x-1)) - 3/(16*(x-1)^2) - 9/(8*2*(x+1)) - 3/(16*(x+1)^2)"
    same = kovacic.solve(given).S == kovacic.solve(coefficient(Fraction(1), *DENOMINATORS["x1, x2 = 1, -1"])).S
    print(f"the two ways to write S agree: {same}")
    if not same:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
