"""Numbers and potentials as text: short ones, since SymPy's functions are recursive and its integers aren't bounded."""

from __future__ import annotations

from functools import partial

from kovacic.limits import Limits
from kovacic.reading import symbolic

LIMITS = Limits(text_length=500, digits=100, exponent=100, bits=500)

read_expression = partial(symbolic.read_expression, limits=LIMITS)
