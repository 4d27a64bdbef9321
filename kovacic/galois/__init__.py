"""The differential Galois group of y'' = S y, exactly, from the decision.

>>> import kovacic
>>> kovacic.solve("-3/(16*x^2)").group.name
'mu_4'
"""

from kovacic.galois.decide import group_of
from kovacic.galois.gauged import EquationGroup, equation_group
from kovacic.galois.group import Ground, Group, Kind

__all__ = ["EquationGroup", "Ground", "Group", "Kind", "equation_group", "group_of"]
