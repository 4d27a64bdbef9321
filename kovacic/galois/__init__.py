"""The differential Galois group of y'' = S y, exactly, from the decision.

S and a `Decision` go in, a `Group` comes out.  Read `decide` first; `imprimitive` has the order of case 2, with the divisors
of curves of positive genus modulo primes and in `chain`, and `gauged` the group of the equation as it was given.

>>> import kovacic
>>> kovacic.solve("-3/(16*x^2)").group.name
'mu_4'
"""

from kovacic.errors import former_names
from kovacic.galois.decide import group_of
from kovacic.galois.gauged import EquationGroup, equation_group
from kovacic.galois.group import Ground, Group, GroupKind

__all__ = ["EquationGroup", "Ground", "Group", "GroupKind", "equation_group", "group_of"]
__getattr__ = former_names(__name__, {"Kind": GroupKind})
