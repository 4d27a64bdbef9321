"""The results of `kovacic.eigenvalues`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, overload

from kovacic.enclosure.ball import Ball


@dataclass(frozen=True)
class Level:
    """An eigenvalue.

    Attributes
    ----------
    value : Ball
        A ball that contains the eigenvalue and, if `alone`, no other one.
    zeros : int
        The zeros of the eigenfunction inside the interval (for periodic conditions: in a period), proven.
    alone : bool
        False where the ball contains two eigenvalues that weren't separated: they may coincide, as periodic conditions allow,
        and each of the two is listed with the same ball.
    """

    value: Ball
    zeros: int
    alone: bool = True

    def __str__(self) -> str:
        zeros = "1 zero" if self.zeros == 1 else f"{self.zeros} zeros"
        pair = "" if self.alone else ", one of a pair that wasn't separated"
        return f"{self.value}  ({zeros}{pair})"


@dataclass(frozen=True)
class Eigenvalues(Sequence[Level]):
    """Consecutive eigenvalues as proven numbers, a sequence of `Level`: frozen and picklable.

    Attributes
    ----------
    levels : tuple of Level
        In order; none is left out between the first and the last.
    complete : bool
        True if it is proven that there are no others (below the essential spectrum).
    parameter : str
        The name of the eigenvalue.
    notes : tuple of str
        Assumptions, and claims that aren't proven.

    Examples
    --------
    >>> import kovacic
    >>> well = kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(pi)=0", count=3)
    >>> [round(float(level.value), 9) for level in well]
    [1.0, 4.0, 9.0]
    >>> well[2].zeros, well[2].value.contains(9), well.complete
    (2, True, False)
    """

    levels: tuple[Level, ...]
    complete: bool = False
    parameter: str = "lambda"
    notes: tuple[str, ...] = ()
    problem: Any = field(default=None, compare=False, repr=False)

    @overload
    def __getitem__(self, index: int) -> Level: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Level, ...]: ...

    def __getitem__(self, index: int | slice) -> Level | tuple[Level, ...]:
        return self.levels[index]

    def __len__(self) -> int:
        return len(self.levels)

    def __iter__(self) -> Iterator[Level]:
        return iter(self.levels)

    def __str__(self) -> str:
        lines = [f"{self.parameter} = {level}" for level in self.levels]
        if not lines:
            lines = ["no eigenvalues"] if self.complete else ["no eigenvalues were found"]
        elif self.complete:
            lines.append("these are all eigenvalues")
        return "\n".join([*lines, *self.notes])

    def wave(self, k: int) -> Callable[[Any], Any]:
        """The eigenfunction of level k for pictures: not proven, scaled to a maximum of 1.

        Parameters
        ----------
        k : int
            Its place in this sequence.

        Returns
        -------
        callable
            A function for arrays of NumPy; 0 where the function has decayed.  Raises `InputError` for periodic problems.

        Examples
        --------
        >>> import kovacic
        >>> y = kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(1)=0", count=2).wave(0)
        >>> round(float(y(0.5)), 3)
        1.0
        """
        import numpy as np

        from kovacic.sturm_liouville.waves import samples

        x, y = samples(self.problem, self.levels[k].value)
        return partial(np.interp, xp=np.array(x), fp=np.array(y), left=0.0, right=0.0)

    def to_dict(self) -> dict[str, Any]:
        """For JSON: text, and numbers that are exact."""
        levels = [{"value": lv.value.to_dict(), "zeros": lv.zeros, "alone": lv.alone} for lv in self.levels]
        return {"parameter": self.parameter, "levels": levels, "complete": self.complete, "notes": list(self.notes)}
