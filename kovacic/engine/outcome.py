"""What deciding one case gives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kovacic.decision import Exclusion, Structure
from kovacic.engine.riccati import Form


@dataclass(frozen=True)
class Found:
    """The group has this structure.

    `form()` is the semi-invariant whose linear factors are the solutions with the omega that Kovacic's algorithm looks for;
    it is computed on demand.  `invariant` is the rational invariant that showed the structure, None if there was none.
    """

    structure: Structure
    form: Callable[[], Form]
    invariant: Form | None = None


Outcome = Found | tuple[Exclusion, ...]
