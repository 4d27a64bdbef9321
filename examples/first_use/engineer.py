"""An engineer: a column under its own weight, and how high it may be.

    pip install . && python examples/first_use/engineer.py

The slope of a thin column that begins to buckle under its own weight satisfies y'' = -x y, x measured from the top in units of
(E I/q)^(1/3), with y' = 0 at the top and y = 0 at the base: the first zero of y is the critical height [Greenhill 1881: 1.986].
"""

from __future__ import annotations

import kovacic

column = kovacic.solve("y'' = -x*y")
print(column)
assert column.status == "none"  # no closed form: Airy's equation

low, high = 1.5, 2.5
while high - low > 1e-9:
    middle = (low + high) / 2
    value = column.at(repr(middle), x0=0, y0=1, dy0=0, digits=15)
    assert abs(value.mid.real) > value.radius  # the sign is certain
    low, high = (middle, high) if value.mid.real > 0 else (low, middle)
print(f"critical height: between {low:.9f} and {high:.9f} times (E I/q)^(1/3), proven by the signs of y")
assert 1.986 < low < high < 1.9864
