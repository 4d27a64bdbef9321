"""y1 and y2 in closed form, built from the engine's certificate.

`solutions` is the entry; `kovacic.closed_form.structure` holds the same as data for numerical evaluation.
"""

from kovacic.closed_form.form import ClosedForm, solutions

__all__ = ["ClosedForm", "solutions"]
