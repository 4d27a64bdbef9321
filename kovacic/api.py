"""`solve` and `decide`: from the input through the engine and the kernel to the answer."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kovacic.algebra.rationals import QQ
from kovacic.decision import Decision, Status
from kovacic.engine.decide import decide as decide_structure
from kovacic.equation import Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, limited
from kovacic.solution import Solution
from kovacic.verify import Verification, verify

if TYPE_CHECKING:
    from collections.abc import Mapping

    from kovacic.parametric.assumptions import Assumptions


@dataclass(frozen=True)
class Verdict:
    """The case alone: `status`, `case` (1, 2, 3 or None), and the `reason` of an undecided equation."""

    status: Status
    case: int | None
    reason: str | None = None


@limited
def solve(
    S: Any = None,
    *,
    a: Any = None,
    b: Any = 0,
    c: Any = 0,
    f: Any = 0,
    var: str | None = None,
    assume: Mapping[Any, Any] | None = None,
    limits: Limits = DEFAULT_LIMITS,
) -> Solution:
    """Decide whether y'' = S(x) y has Liouvillian (closed-form) solutions, with a certificate; verified.

    S is a rational function over Q: a string ("x^2 + 3"), a SymPy expression, or a pair of coefficient sequences
    (numerator, denominator), low to high, of integers or fractions.  Or it is a linear equation of second order, whose
    normal form is decided: a string ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"), a SymPy `Eq` with a function y(x), or the
    coefficients of a y'' + b y' + c y = f as keywords.  `var` names the variable; by default it is the only symbol of S, or
    x.  `limits` bounds the input and the work.  Every other symbol is a parameter, for whose generic values the equation is
    decided; `assume={"n": "integer"}`, {"n": ">=0"}, or assumptions of SymPy symbols, say more (see `conditions`), and a notice
    says for which of these values the answer holds; with {"n": 3} the number is put in for the parameter.

    Returns a `Solution`.  Its `status` is UNDECIDED exactly when a limit of the work was reached, or where the assumptions
    imply a case with an omega that depends on the values of the parameters; `reason` says so.  Raises `InputError` for
    what isn't such a function, `LimitExceeded` for an input above the limits, or that isn't read in time, and
    `VerificationFailed` if the answer doesn't pass its own check, which is a defect of this package.

    >>> import kovacic
    >>> answer = kovacic.solve("x^2 + 3")
    >>> answer.case
    1
    >>> print(answer.omega)
    (x**2 + 1)/x
    >>> kovacic.solve("x").status
    <Status.NONE_EXISTS: 'none'>
    >>> bessel = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0")
    >>> print(bessel.S, bessel.gauge)
    -1 -1/(2*x)

    Reference: J. Kovacic, J. Symb. Comp. 2 (1986) 3-43.
    """
    start = time.perf_counter()
    if (S is None) == (a is None):
        raise InputError("one equation is expected: S, or the coefficients a=, b=, c=, f=")
    S, parsed, assume = _read(S, (a, b, c, f), var, assume, limits)
    budget = Budget(limits)
    decision, notices, assumed, known = _decided(parsed, S, assume, budget, certify=True)
    try:
        verification = verify(parsed.S, decision, budget=budget)
    except LimitExceeded as limit:
        decision = Decision(None, (), undecided=f"while the answer was verified: {limit}")
        verification = Verification(())
    verified = bool(verification)
    if not verified and (verification.checks or decision.status is not Status.UNDECIDED):
        said = f"the answer for S = {parsed.S} failed its own check; please report it"
        raise VerificationFailed(f"{said}\n{verification}")
    text, seconds = S.strip() if isinstance(S, str) else parsed.text, time.perf_counter() - start
    return Solution(
        text, parsed.variable, parsed.S, decision, notices, verified, seconds, parsed.equation, assumed, limits, known
    )


@limited
def decide(
    S: Any, *, var: str | None = None, assume: Mapping[Any, Any] | None = None, limits: Limits = DEFAULT_LIMITS
) -> Verdict:
    """The case of y'' = S(x) y alone, without the polynomial of omega and without the second check.

    Arguments and exceptions as for `solve`.

    >>> import kovacic
    >>> kovacic.decide("-3/(16*x^2) + 1/x").case
    2
    """
    S, parsed, assume = _read(S, (), var, assume, limits)
    decision, *_ = _decided(parsed, S, assume, Budget(limits), certify=False)
    return Verdict(decision.status, decision.case, decision.undecided)


def _read(
    S: Any, coefficients: tuple[Any, ...], var: str | None, assume: Mapping[Any, Any] | None, limits: Limits
) -> tuple[Any, Parsed, Mapping[Any, Any] | None]:
    """The input with the values among the assumptions, as given and as it was read, and the other assumptions."""
    from kovacic.reading.read import read_coefficients, read_input

    if S is None and coefficients:
        parsed = read_coefficients(*coefficients, var=var, limits=limits)
    else:
        parsed = read_input(S, var=var, limits=limits, exponentials=True)
    if not assume:
        return S, parsed, assume
    from kovacic.reading.substitution import with_values

    return with_values(S, parsed, assume, limits)


def _decided(
    parsed: Parsed, S: Any, assume: Mapping[Any, Any] | None, budget: Budget, *, certify: bool
) -> tuple[Decision, tuple[str, ...], bool, Assumptions | None]:
    """The decision, under the assumptions if there are any, the notices, is it proven for all values with them, and they."""
    decision = decide_structure(parsed.S, budget, certify=certify)
    if assume is None and parsed.S.field.ground == QQ:
        return decision, parsed.notices, False, None
    from kovacic.parametric.assumptions import read_assumptions

    known = read_assumptions(assume, S, parameters_of(parsed.S.field))
    if not known or (assume is None and not known.concerns_exponents):
        return decision, parsed.notices, False, known
    from kovacic.parametric.api import under_assumptions

    try:
        decision, sentence, proven = under_assumptions(parsed, decision, known, budget.limits, certify=certify)
    except LimitExceeded as limit:
        return Decision(None, (), undecided=str(limit)), parsed.notices, False, known
    return decision, (*parsed.notices, sentence) if sentence else parsed.notices, proven, known
