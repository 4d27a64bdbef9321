"""Which solution, and how accurately: the two objects that every numerical function accepts, and their shorthand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any, Literal, NamedTuple, TypedDict

from kovacic.errors import InputError
from kovacic.limits import Limits, limits_of
from kovacic.numbers.exact import whole
from kovacic.numbers.numerals import in_a_message

Method = Literal["taylor", "closed form"]
METHODS: tuple[Method, ...] = ("taylor", "closed form")


@dataclass(frozen=True, slots=True)
class Start:
    """One solution of an equation, by its values or by its behaviour at a point; given as `initial`, or field by field.

    Numbers are exact, as for `kovacic.evaluate`.  `y0` and `dy0` describe a solution of every equation, `frobenius` and `which`
    one of a homogeneous equation with rational coefficients.

    Attributes
    ----------
    x0 : number
        Where the solution starts; infinity is "oo".  A ball, or a constant that isn't rational, stands as x0 of a Frobenius
        basis for the only singular point that it contains.
    y0, dy0 : number
        y(x0) and y'(x0).
    which : str or int
        Instead: "regular" is frobenius=(0, 1), the solution that is smaller than all others at x0; "decaying", with y0, is the
        one with y(x0) = y0 that becomes smaller than all others as x goes to +infinity.  `lambdify` has other values.
    frobenius : pair of numbers
        Instead: (c1, c2) stands for y = c1 y1 + c2 y2 with the Frobenius basis at x0, a regular singular point or an ordinary
        one, or infinity.  y1 is the dominant one: the leading terms are t^lambda log(t)^k, t = x - x0 (1/x at infinity), by the
        real part of lambda upwards, and the logarithm first.  Either has the coefficient 1 at its own leading term and 0 at
        the other's.

    Examples
    --------
    >>> import kovacic
    >>> airy = kovacic.Start(x0=0, y0=1, dy0=0)
    >>> print(f"{kovacic.evaluate('x', 2, initial=airy):.12f}")
    2.730883017890
    >>> print(f"{kovacic.evaluate('x', 2, initial=airy, dy0=1):.12f}")      # a field beside the object replaces its own
    6.341956759339
    """

    x0: object = None
    y0: object = None
    dy0: object = None
    which: int | str | None = None
    frobenius: Sequence[object] | None = None


@dataclass(frozen=True, slots=True)
class Accuracy:
    """How accurately values are found, and what that may cost; given as `accuracy`, or field by field.

    Attributes
    ----------
    digits : int
        The accuracy relative to the value: 15 digits by default, 8 in a picture.
    method : str
        "taylor" (the equation itself, for all) or "closed form" (the certificate, or FLINT's special functions); by default
        the faster one.
    limits : Limits
        What the work may cost; by default `kovacic.Limits()`, or the limits of the answer.

    Examples
    --------
    >>> import kovacic
    >>> fine = kovacic.Accuracy(digits=30, method="taylor")
    >>> print(kovacic.evaluate("x", 2, x0=0, y0=1, dy0=0, accuracy=fine).digits >= 30)
    True
    """

    digits: int | None = None
    method: Method | None = None
    limits: Limits | None = None


Path = Sequence[object] | Literal["chain", "above", "below"] | None
Params = Mapping[str, object] | None  # values of parameters by their names


class Keywords(TypedDict, total=False):
    """Keywords of the numerical functions: the two objects or their fields, and how the equation is to be taken."""

    initial: Start | None
    x0: object
    y0: object
    dy0: object
    which: int | str | None
    frobenius: Sequence[object] | None
    accuracy: Accuracy | None
    digits: int | None
    method: Method | None
    limits: Limits | None
    path: Path
    params: Params
    var: str | None


class Request(NamedTuple):
    """A request read from keywords: solution, accuracy, path, values of parameters, variable."""

    start: Start
    accuracy: Accuracy
    path: Path = None
    params: Params = None
    var: str | None = None

    @classmethod
    def of(cls, call: str, keywords: Mapping[str, Any], *, unused: Sequence[str] = ()) -> Request:
        """The request of the keywords of `call`, in which a field that isn't None replaces that of its object.

        Raises `TypeError` for other keywords, as Python does, with the nearest name, and for the fields that are `unused`.
        """
        known = [name for name in Keywords.__annotations__ if name not in unused]
        start = _object(Start, keywords.get("initial"))
        accuracy = _object(Accuracy, keywords.get("accuracy"))
        # The fields of an `Accuracy` count as keywords: some calls have no method.
        for name in [*keywords, *fields_of(accuracy)]:
            if name not in known:
                near = get_close_matches(name, known, n=1)
                hint = f". Did you mean {near[0]!r}?" if near else ""
                raise TypeError(f"{call}() got an unexpected keyword argument {name!r}{hint}")

        def given(names: Iterable[str]) -> dict[str, Any]:
            return {name: keywords[name] for name in names if keywords.get(name) is not None}

        start = replace(start, **given(Start.__slots__))
        accuracy = replace(accuracy, **given(Accuracy.__slots__))
        return cls(start, accuracy, **given(("path", "params", "var")))


def _object(kind: type[Any], given: object) -> Any:
    """The given object, or one of this kind without any fields."""
    if given is not None and not isinstance(given, kind):
        raise InputError(f"a kovacic.{kind.__name__} is expected, not {type(given).__name__!r}")
    return kind() if given is None else given


def fields_of(given: Start | Accuracy) -> dict[str, Any]:
    """The fields that aren't None, as keywords."""
    return {name: value for name in given.__slots__ if (value := getattr(given, name)) is not None}


def digits_and_limits(call: str, **keywords: Any) -> tuple[int, Limits]:
    """The digits, 15 by default, and the limits among the keywords `accuracy`, `digits` and `limits` of a call without a
    choice of methods."""
    accuracy = Request.of(call, keywords, unused=("method",)).accuracy
    limits = limits_of(accuracy.limits)
    return number_of_digits(15 if accuracy.digits is None else accuracy.digits, limits), limits


def number_of_digits(given: object, limits: Limits) -> int:
    """The digits as an integer; raises InputError unless they are positive and within the limits."""
    digits = whole(given, "digits", least=1)
    shown = in_a_message(digits)
    if digits > limits.digits:
        raise InputError(
            f"digits = {shown} is beyond the limit of {limits.digits}",
            hint=f"limits=kovacic.Limits(digits={shown})",
            shell=f"--limit digits={shown}",
        )
    return digits
