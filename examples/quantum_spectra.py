"""The bound states of four potentials of quantum mechanics, as the energies at which Schroedinger's equation is solvable.

    python examples/quantum_spectra.py

y'' = (V - E) y in units with hbar^2 = 2m = 1.  `kovacic.conditions` finds all energies with Liouvillian solutions; the bound
states are among them, with omega = y'/y rational: the potentials are exactly solvable.  Morse's potential and that of Poeschl
and Teller become rational in the variables exp(-x) and (1 + tanh x)/2.
"""

from __future__ import annotations

from fractions import Fraction

import kovacic

POTENTIALS = {
    "harmonic oscillator: E = 2d + 1": (
        "x^2 - E",
        [{"E": 2 * d + 1} for d in range(3)],
    ),
    "Coulomb: E = -Z^2/(4 (l + 1 + d)^2)": (
        "l*(l+1)/x^2 - Z/x - E",
        [{"l": 1, "Z": 3, "E": Fraction(-9, 4 * (2 + d) ** 2)} for d in range(3)],
    ),
    "Morse: E = -(b - d - 1/2)^2": (
        "A^2 - 2*A*b/x - (E + 1/4)/x^2",
        [{"A": 1, "b": 3, "E": -((Fraction(5, 2) - d) ** 2)} for d in range(3)],
    ),
    "Poeschl-Teller: E = -(l - d)^2": (
        "-(1+E)/(4*x^2) - (1+E)/(4*(x-1)^2) + (2*E+(2*l+1)^2+1)/(4*x*(x-1))",
        [{"l": Fraction(7, 3), "E": -((Fraction(7, 3) - d) ** 2)} for d in range(3)],
    ),
}


def main() -> None:
    for title, (S, states) in POTENTIALS.items():
        answer = kovacic.conditions(S, var="x")
        print(f"{title}\n{answer}")
        for values in states:
            solution = answer.solve_at(values)
            print(f"  {', '.join(f'{name} = {value}' for name, value in values.items())}: omega = {solution.omega}")
        print()


if __name__ == "__main__":
    main()
