"""`kovacic.spectrum` beside diagonalisation: the energies, and that none is left out, for potentials of every kind."""

from __future__ import annotations

from math import inf
from typing import Any, NamedTuple

import numpy as np
import pytest
import sympy
from build import parametrize, read_expression
from diagonal import eigenvalues
from potentials import MORE, TABLE

import kovacic

HALF, LINE = (0, "oo"), ("-oo", "oo")
CONFLUENT, EXACT, NUMERIC = "a closed form for some levels", "a formula for all", "numbers alone"


class Well(NamedTuple):
    V: str
    domain: tuple[Any, Any] = LINE
    boundary: str | None = None
    neumann: tuple[bool, bool] = (False, False)
    kind: str = EXACT


def _with_values(row: Any) -> Well:
    """A row of the literature, with its values in V and in the domain."""
    at = {sympy.Symbol(name): read_expression(value) for name, value in row.values.items()}
    V = str(read_expression(row.V).subs(at)).replace("**", "^")
    domain = tuple(
        str(sympy.sympify(str(end)).subs(at)) if str(end) not in ("oo", "-oo") else end for end in row.domain
    )
    return Well(V, domain, row.boundary)


WELLS = [
    Well("x^2 - 3*x + 1"),
    Well("-6/cosh(x)^2"),
    Well("-37/4/cosh(x - 1)^2"),
    Well("6/x^2 - 5/x", HALF),
    Well("-3/x", HALF),
    Well("x^2", HALF, "y'(0) = 0", (True, False)),
    Well("-20/cosh(x)^2", HALF, "y'(0) = 0", (True, False)),
    Well("0", (0, 2), "y'(0) = 0", (True, False)),
    Well("5", (1, "pi")),
    Well("x^2 + 3/4/x^2", HALF),
    Well("9*(1 - exp(-x))^2"),
    Well("25/4*(exp(-2*x) - 2*exp(-x))"),
    Well("3/sin(x)^2", (0, "pi")),
    Well("2/sin(x)^2 + 5*cot(x)", (0, "pi")),
    Well("x^2/4 - x + 2/x^2", HALF, kind=NUMERIC),
    Well("x^2/4 - 3/x + 2/x^2", HALF, kind=NUMERIC),
    Well("-12*exp(-x)/(1 - exp(-x))", HALF),
    Well("-7*sech(x)^2 + tanh(x)"),
    Well("2*cosh(x)^2/sinh(x)^2 - 11*coth(x)", HALF),
    Well("x^2 + 8*(2*x^2 - 1)/(2*x^2 + 1)^2"),
    Well("tan(x)^2", ("-pi/2", "pi/2")),
    Well("x^6 - 7*x^2", kind=CONFLUENT),
    Well("x^6 - 15*x^2", kind=CONFLUENT),
    Well("x^6 + 2*x^4 - 10*x^2", kind=CONFLUENT),
    Well("(cosh(2*x) - 3)^2", kind=CONFLUENT),
    Well("(2*cosh(x) - 5/2)^2", kind=CONFLUENT),
    Well("(sqrt(2)*cosh(2*x) - 3)^2", kind=CONFLUENT),
    Well("(sqrt(2)*cosh(2*x) - 4)^2", kind=CONFLUENT),
    Well("x^6 + 6/x^2 - 13*x^2", HALF, kind=CONFLUENT),
    Well("2/x^2 - 4/x^3 + 1/x^4", HALF, kind=NUMERIC),
    Well("1/cos(x)", ("-pi/2", "pi/2"), kind=CONFLUENT),  # simple poles at the ends
    Well("-2/(x*(1 - x))", (0, 1), kind=CONFLUENT),
    Well("x^2 + 2/x", HALF, kind=CONFLUENT),
    Well("x^4", kind=NUMERIC),
    Well("abs(x)", kind=NUMERIC),
    Well("-10/cosh(x)^2 + 4/cosh(x)^4", kind=NUMERIC),
    Well("x", HALF, kind=NUMERIC),
    Well("x", HALF, "y'(0) = 0", (True, False), NUMERIC),
    Well("cosh(x)", kind=NUMERIC),
    *TABLE,
    *MORE,
]


@parametrize("well", WELLS, ordinary=0, long=1, ids=lambda well: f"{well.V} on {well.domain}")
def test_levels_are_those_of_the_matrix(well: Any) -> None:
    """A state with k zeros is the eigenvalue number k of the matrix; a formula for all gives each below its highest one."""
    well = well if isinstance(well, Well) else _with_values(well)
    given = {"domain": well.domain, "boundary": well.boundary}
    found = kovacic.spectrum(well.V, **given, **({"levels": 3, "digits": 9} if well.kind == NUMERIC else {}))
    levels = [(level.zeros, float(level.value)) for level in found.numeric]
    levels += [(state.zeros, float(state.energy)) for state in found.states(count=3)]
    if well.kind != NUMERIC:
        assert found.complete == (well.kind == EXACT)
    assert levels
    energies = [energy for _, energy in levels]
    below, highest = min(energies) - 2, max(energies)
    V = sympy.lambdify(sympy.Symbol("x"), read_expression(well.V), ["scipy", "numpy"])
    ends = tuple({"oo": inf, "-oo": -inf}.get(str(end)) or float(read_expression(str(end))) for end in well.domain)
    matrix = eigenvalues(
        lambda x: np.broadcast_to(np.asarray(V(x), dtype=float), x.shape), ends, below, highest, well.neumann
    )
    for zeros, energy in levels:
        assert abs(matrix[zeros] - energy) < 1e-7 * (1 + abs(energy)), (zeros, energy, matrix[:4])
    if well.kind == EXACT:
        assert [zeros for zeros, _ in sorted(levels)] == [*range(len(levels))]


def test_there_are_sixty_potentials() -> None:
    assert len({well.V for well in WELLS}) >= 55
    assert len(WELLS) >= 60


@pytest.mark.long
@pytest.mark.parametrize("V", ["x^2 - 3*x + 1"])
def test_a_shifted_energy_is_noticed(V: str) -> None:
    matrix = eigenvalues(lambda x: x**2 - 3 * x + 1, (-inf, inf), -1.0, 10.0)
    assert np.allclose(matrix[:4], [2 * k + 1 - 1.25 for k in range(4)], atol=1e-8)
