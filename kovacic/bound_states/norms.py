"""int y^2 dx over the domain, for a single wave function y with a rational y'/y, by an antiderivative."""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.closed_form.atoms import Atoms, factors
from kovacic.closed_form.integrals import integral
from kovacic.closed_form.product import product
from kovacic.errors import InputError, LimitExceeded
from kovacic.reading.read import read_input

#: Functions in an antiderivative whose limits at the ends are found at once.
_WITH_LIMITS = (sympy.exp, sympy.log, sympy.atan, sympy.erf)


def norm_of(wave: Any, x: Any, domain: tuple[Any, Any]) -> Any:
    """The integral, None if the antiderivative isn't found, or its limits at the ends aren't.

    >>> x = sympy.Symbol("x")
    >>> norm_of(sympy.exp(-1 / x) / x, x, (0, sympy.oo))
    1/2
    """
    square = wave**2
    rate = sympy.cancel(sympy.diff(square, x) / square)
    if not rate.is_rational_function(x) or rate.free_symbols - {x}:
        return None
    try:
        h = product(read_input(rate, var=x.name).S)
        found = integral(h, Atoms(x))
    except (InputError, LimitExceeded):
        return None
    if found is None or not all(isinstance(f, _WITH_LIMITS) for f in found.atoms(sympy.Function)):
        return None
    scale, shown = factors(h, Atoms(x))
    constant = sympy.cancel(sympy.powsimp(square / (scale * sympy.Mul(*shown))))
    first, last = domain
    total = sympy.limit(found, x, last, "-") - sympy.limit(found, x, first, "+")
    norm = sympy.simplify(constant * total)
    return norm if norm.is_positive and not norm.has(x) else None
