"""The equations of Kovacic's paper (J. Symb. Comp. 2, 1986), Airy's and Bessel's, with the answers that it gives.

Run: python examples/kovacic_1986.py
"""

from __future__ import annotations

import kovacic

# (what, S, the case of the paper, the degree of omega)
EXAMPLES = [
    ("Section 3.2, case 1", "(4*x^6 - 8*x^5 + 12*x^4 + 4*x^3 + 7*x^2 - 20*x + 4)/(4*x^4)", 1, 1),
    ("Section 4.2, case 2", "1/x - 3/(16*x^2)", 2, 2),
    ("Section 5.2, case 3, tetrahedral", "-3/(16*x^2) - 2/(9*(x - 1)^2) + 3/(16*x*(x - 1))", 3, 4),
    ("Section 5.2, case 3, tetrahedral", "-(5*x^2 + 27)/(36*(x^2 - 1)^2)", 3, 4),
    ("Section 5.2, case 3, octahedral", "-3/(16*x^2) - 15/(64*(x - 1)^2) + 115/(576*x*(x - 1))", 3, 6),
    ("Section 5.2, case 3, icosahedral", "-3/(16*x^2) - 2/(9*(x - 1)^2) + 611/(3600*x*(x - 1))", 3, 12),
    ("Airy", "x", None, None),
    ("Bessel, order 1/2", "(4*(1/4 - x^2) - 1)/(4*x^2)", 1, 1),
    ("Bessel, order 3/2", "(4*(9/4 - x^2) - 1)/(4*x^2)", 1, 1),
    ("Bessel, order 5/2", "(4*(25/4 - x^2) - 1)/(4*x^2)", 1, 1),
    ("Bessel, order 0", "(4*(0 - x^2) - 1)/(4*x^2)", None, None),
    ("Bessel, order 1/3", "(4*(1/9 - x^2) - 1)/(4*x^2)", None, None),
    ("Weber, n = 3", "x^2/4 - 1/2 - 3", 1, 1),
    ("Weber, n = 1/2", "x^2/4 - 1/2 - 1/2", None, None),
]


def main() -> None:
    for title, S, case, degree in EXAMPLES:
        answer = kovacic.solve(S)
        print(f"{title}\n  {answer}")
        found = None if answer.riccati is None else answer.riccati.degree
        if (answer.case, found) != (case, degree) or not answer.verify():
            raise SystemExit(f"expected case {case} and degree {degree} for S = {S}")


if __name__ == "__main__":
    main()
