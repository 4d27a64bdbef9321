"""The author of another system: answers as JSON, read without this package, and compared with the other system's.

    pip install . && python examples/first_use/system_author.py

Here the other system is SymPy: every function that it finds is substituted into the equation, and the verdicts are compared.
"""

from __future__ import annotations

import json

import sympy

import kovacic

x = sympy.Symbol("x")
EQUATIONS = ["x^2 + 3", "x", "1/x - 3/(16*x^2)", "2/x^2", "-1", "20*x^3/(x^5 - x - 1)"]

if __name__ == "__main__":  # solve_many starts processes
    for record in kovacic.solve_many(EQUATIONS, timeout=20, jobs=1):
        answer = json.loads(record.json)
        print(f"{answer['input']:<22} {answer['status']:<12} case {answer['case']}, verified: {answer['verified']}")
        S = sympy.sympify(answer["S"])
        for y in kovacic.Solution.from_json(record.json).solutions:
            residual = sympy.simplify(y.diff(x, 2) - S * y)
            assert residual == 0 or abs(residual.subs(x, sympy.Rational(7, 3)).n()) < 1e-9, (answer["input"], residual)
