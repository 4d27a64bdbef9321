"""A student: the harmonic oscillator of quantum mechanics, solved.

    pip install . && python examples/first_use/student.py

Schroedinger's equation y'' = (x^2 - E) y: for which energies E can it be solved, and what do the solutions look like?
"""

from __future__ import annotations

import kovacic

print("For which energies?")
print(kovacic.conditions("x^2 - E"))

print("\nThe first bound states:")
for E in (1, 3, 5):
    y1, y2 = kovacic.solve(f"x^2 - {E}").solutions
    print(f"  E = {E}: y = {y1}")
    assert kovacic.solve(f"x^2 - {E}").verify()

print("\nAnd in between?")
between = kovacic.solve("x^2 - 2")
print(f"  E = 2: {between}")
assert between.status == "none"

print("\nIts values can be had all the same, with a proven error bound:")
value = between.at(1, x0=0, y0=1, dy0=0, digits=15)
print(f"  y(1) = {value} for y(0) = 1, y'(0) = 0")
