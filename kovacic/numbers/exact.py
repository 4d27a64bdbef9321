"""The numbers that users give, of whatever library: which exact number each of them is.

Floats are taken at their exact binary value and decimal text at its exact decimal value ("0.1" is 1/10, 0.1 is
3602879701896397/36028797018963968): nothing is rounded on the way in.  Truth values and bytes are no numbers.
"""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from operator import index
from typing import Any

from flint import acb, arb, fmpq, fmpz

from kovacic.errors import InputError, LimitExceeded
from kovacic.numbers.numerals import as_text, in_a_message, plain_text

_DECIMAL_OR_FRACTION = re.compile(r"\s*([+-]?\d+)\s*/\s*(\d+)\s*|\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*")
# Largest exponent of a decimal: exact numbers of that size take seconds.
_MAX_EXPONENT = 100_000

Parts = tuple[Any, Any]
"""Real and imaginary part, FLINT's rationals."""


def exact(value: Any, name: str) -> Parts:
    """The exact complex number that `value` stands for.

    Accepted: int, Fraction and other rationals, float, complex, Decimal, decimal or p/q text, NumPy's scalars of these kinds,
    mpmath mpf and mpc, SymPy numbers a + b I with rational or floating parts, python-flint's numbers and our own balls of
    radius zero.  Raises `InputError` for what isn't a finite number of these kinds (`name` says which argument it was).

    >>> exact("0.1", "x"), exact(1 + 2j, "x")
    ((1/10, 0), (1, 2))
    """
    if type(value) is int:
        return fmpq(value), fmpq(0)
    if isinstance(value, bool):
        raise InputError(f"{name} is a truth value ({value}), not a number")
    if isinstance(value, str):
        return _rational_of_text(value, name), fmpq(0)
    reader = _NUMBER_READERS.get(_library(value), _of_python)
    parts = reader(value, name)
    if parts is None:
        what = f"{plain_text(value)[:60]!r} ({type(value).__name__})"
        raise InputError(f"{name} isn't a number that is known exactly: {what}")
    return parts


def exact_real(value: Any, name: str) -> Fraction:
    """The exact number as a fraction; raises `InputError` if it isn't real."""
    re, im = exact(value, name)
    if im != 0:
        raise InputError(f"{name} isn't a real number: {plain_text(value)[:60]!r}")
    return Fraction(int(re.p), int(re.q))


def whole(value: Any, name: str, *, least: int | None = 0) -> int:
    """An integer of any library, at least `least`; raises `InputError` for anything else, 3.0 and "3" included."""
    try:
        found = None if isinstance(value, bool) or _is_duration(value) else index(value)
    except TypeError:
        found = None
    if found is None:
        raise InputError(f"{name} must be an integer, not {plain_text(value)[:60]!r} ({type(value).__name__})")
    if least is not None and found < least:
        raise InputError(f"{name} = {in_a_message(found)}: at least {least} is needed")
    return found


def is_rational_number(value: Any) -> bool:
    """True for an integer or a quotient, by its type; floats and truth values aren't."""
    return isinstance(value, Rational | fmpz | fmpq) and not isinstance(value, bool) and not _is_duration(value)


def exact_text(value: Any, name: str) -> str:
    """The text of a value within a formula: text unchanged, a float as its shortest decimal, other numbers exactly.

    >>> exact_text(0.1, "n"), exact_text("sqrt(2)", "n"), exact_text(Fraction(1, 3), "n")
    ('0.1', 'sqrt(2)', '1/3')
    """
    if isinstance(value, str):
        return value.strip()
    if _library(value) == "sympy":
        return as_text(value)
    number = exact_real(value, name)
    return str(value) if isinstance(value, float | Decimal) or _numpy_kind(value) == "f" else as_text(number)


def is_complex(value: Any) -> bool:
    """True for a complex number, by its type."""
    if _library(value) == "mpmath":
        return hasattr(value, "_mpc_")
    return isinstance(value, complex | acb) or _numpy_kind(value) == "c"


def _library(value: Any) -> str:
    """The library of a number, recognised without importing it; empty for Python's own."""
    names = (str(cls.__module__).partition(".")[0] for cls in type(value).__mro__)
    return next((name for name in names if name in _NUMBER_READERS), "")


def _numpy_kind(value: Any) -> str:
    """NumPy's letter for the type of a scalar, or of an array without dimensions; empty for anything else."""
    is_scalar = _library(value) == "numpy" and getattr(value, "ndim", None) == 0
    return str(value.dtype.kind) if is_scalar else ""


def _is_duration(value: Any) -> bool:
    """NumPy counts its durations among the integers."""
    return _numpy_kind(value) in ("m", "M")


def _of_python(value: Any, name: str) -> Parts | None:
    if not isinstance(value, complex | float | Decimal | Rational):
        return None
    return _rational_of(value.real, name), _rational_of(value.imag, name)


def _of_numpy(value: Any, name: str) -> Parts | None:
    kind = _numpy_kind(value)
    if kind and kind in "iufc":
        return _rational_of(value.real[()], name), _rational_of(value.imag[()], name)
    return exact(value.item(), name) if kind and kind in "OU" else None


def _of_mpmath(value: Any, name: str) -> Parts | None:
    if not hasattr(value, "_mpf_") and not hasattr(value, "_mpc_"):
        return None
    return _mpf(value.real._mpf_, name), _mpf(value.imag._mpf_, name)


def _of_sympy(value: Any, name: str) -> Parts | None:
    parts = value.as_real_imag() if getattr(value, "is_number", False) else ()
    if not parts or not all(part.is_Rational or part.is_Float for part in parts):
        return None
    real, imaginary = (fmpq(int(n.p), int(n.q)) if n.is_Rational else _mpf(n._mpf_, name) for n in parts)
    return real, imaginary


def _of_flint(value: Any, name: str) -> Parts | None:
    if isinstance(value, fmpz | fmpq):
        return fmpq(value), fmpq(0)
    if not isinstance(value, arb | acb):
        return None
    ball = acb(value)
    _demand_exact(ball.is_finite() and ball.real.is_exact() and ball.imag.is_exact(), name)
    above, e = ball.real.man_exp()
    aside, k = ball.imag.man_exp()
    return _power(above, e, name), _power(aside, k, name)


def _of_kovacic(value: Any, name: str) -> Parts | None:
    if not hasattr(value, "is_exact") or not hasattr(value, "midpoint"):
        return None
    _demand_exact(value.is_exact(), name)
    real, imaginary = value.midpoint
    return _rational_of(real, name), _rational_of(imaginary, name)


_NUMBER_READERS = {
    "numpy": _of_numpy,
    "mpmath": _of_mpmath,
    "sympy": _of_sympy,
    "flint": _of_flint,
    "kovacic": _of_kovacic,
}


def _demand_exact(is_exact: bool, name: str) -> None:
    if not is_exact:
        raise InputError(f"{name} is a ball of positive radius; an exact point is needed", hint="use its midpoint")


def _rational_of(value: Any, name: str) -> Any:
    """The rational number of an object with `numerator` and `denominator`, or with `as_integer_ratio`."""
    if isinstance(value, Decimal) and value.is_finite() and abs(value.adjusted()) > _MAX_EXPONENT:
        raise InputError(f"{name} = {value} has an exponent beyond {_MAX_EXPONENT}")
    try:
        if isinstance(value, Rational):
            above = value.numerator
            below = value.denominator
        else:
            above, below = value.as_integer_ratio()
    except (OverflowError, ValueError):
        raise InputError(f"{name} = {value} isn't a finite number") from None
    return fmpq(int(above), int(below))


def _rational_of_text(text: str, name: str) -> Any:
    match = _DECIMAL_OR_FRACTION.fullmatch(text)
    if match is None:
        raise InputError(f"{name} isn't a decimal number or a fraction p/q: {text[:60]!r}", hint="e.g. '0.1' or '1/3'")
    if match[3] is not None:
        mantissa, _, scale = match[3].lstrip("+").lower().partition("e")
        whole_part, _, decimals = mantissa.partition(".")
        exponent = fmpz(scale.lstrip("+") or 0)
        if abs(exponent) > _MAX_EXPONENT:
            raise InputError(f"{name} = {text[:60]} has an exponent beyond {_MAX_EXPONENT}")
        return fmpq(fmpz(whole_part + decimals)) * fmpq(10) ** int(exponent - len(decimals))
    above, below = (fmpz(part.lstrip("+")) for part in (match[1], match[2]))  # Python reads 4300 digits only
    if below == 0:
        raise InputError(f"{name} = {text[:60]} divides by zero")
    return fmpq(above, below)


def _mpf(parts: tuple[int, int, int, int], name: str) -> Any:
    sign, mantissa, exponent, _ = parts
    if not mantissa and exponent:
        raise InputError(f"{name} isn't a finite number")
    signed = -int(mantissa) if sign else int(mantissa)
    return _power(signed, exponent, name)


def _power(mantissa: Any, exponent: Any, name: str) -> Any:
    """mantissa 2^exponent."""
    if abs(exponent) > 4 * _MAX_EXPONENT:
        raise InputError(f"{name} has a binary exponent beyond {4 * _MAX_EXPONENT}")
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


#: The longest radicand of a root that is written, in bits: SymPy factors it as far as it can, which takes seconds beyond.
_LONGEST_RADICAND = 1600


def radical(value: Any, n: int = 2) -> Any:
    """SymPy's root of an expression, square or of order n.

    Raises `LimitExceeded` for a number that is too long for SymPy.

    >>> radical(18)
    3*sqrt(2)
    """
    from sympy import root, sympify

    number, _ = sympify(value, strict=True).as_coeff_Mul(rational=True)
    bits = _size_in_bits(number)
    if bits > _LONGEST_RADICAND:
        said = f"a root of a number of {bits} bits, above the limit of {_LONGEST_RADICAND}, isn't written as a formula"
        raise LimitExceeded(said, limit="digits")
    return root(value, n)


def has_long_numbers(expression: Any) -> bool:
    """True if the expression has numbers so long that SymPy would take seconds for a root of them, as a value may bring up."""
    from sympy import Rational as Number

    return any(_size_in_bits(number) > _LONGEST_RADICAND for number in expression.atoms(Number))


def _size_in_bits(number: Any) -> int:
    return max(int(number.p).bit_length(), int(number.q).bit_length())
