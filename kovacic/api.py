"""From the input through the engine and the kernel to the answer, or to the case alone (`decide`)."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kovacic.algebra.rationals import QQ
from kovacic.answer import Answer
from kovacic.decision import Decision, Status
from kovacic.engine.decide import decide as decide_structure
from kovacic.equation import Equation, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, limited
from kovacic.reading.read import declared, read_coefficients, read_input
from kovacic.verify import Verification, verify
from kovacic.verify.identity import is_normal_form

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from kovacic.parametric.assumptions import Assumptions


@dataclass(frozen=True)
class Verdict:
    """The result of `kovacic.decide`: the case alone.

    Attributes
    ----------
    status : Status
        LIOUVILLIAN, NONE_EXISTS or UNDECIDED.
    case : int or None
        Kovacic's case, 1 to 3.
    reason : str or None
        The limit that left an equation undecided.

    >>> import kovacic
    >>> kovacic.decide("x^2 + 3")
    Verdict(status=<Status.LIOUVILLIAN: 'liouvillian'>, case=1, reason=None)
    """

    status: Status
    case: int | None
    reason: str | None = None


def find_answer(
    S: Any = None,
    *,
    a: Any = None,
    b: Any = None,
    c: Any = None,
    f: Any = None,
    var: str | None = None,
    assume: Mapping[Any, Any] | None = None,
    parameters: Sequence[str] = (),
    limits: Limits = DEFAULT_LIMITS,
) -> Answer:
    """The answer of `kovacic.solve`, which watches the time, as data; arguments and exceptions are the same."""
    start = time.perf_counter()
    S, parsed, assume = _read_question(S, {"a": a, "b": b, "c": c, "f": f}, var, assume, parameters, limits)
    budget = Budget(limits)
    decision, notices, assumed, known = _decided(parsed, S, assume, budget, certify=True)
    try:
        verification = verify(parsed.S, decision, budget=budget)
    except LimitExceeded as limit:
        decision = Decision(None, (), undecided=f"while the answer was verified: {limit}")
        assumed = False
        verification = Verification(())
    equation = parsed.equation
    if equation is not None and not is_normal_form(parsed.S, equation.gauge, equation.a, equation.b, equation.c):
        raise VerificationFailed(f"S = {parsed.S} isn't the normal form of {equation}; please report it")
    verified = bool(verification)
    if not verified and (verification.checks or decision.status is not Status.UNDECIDED):
        said = f"the answer for S = {parsed.S} failed its own check; please report it"
        raise VerificationFailed(f"{said}\n{verification}")
    return Answer(
        _text_of(S, parsed),
        parsed.variable,
        parsed.S,
        decision,
        notices,
        verified,
        time.perf_counter() - start,
        equation,
        assumed,
        limits,
        known,
        parsed.letters,
    )


def _text_of(S: Any, parsed: Parsed) -> str:
    """The input as given; in our own spelling if it is no text, or if constants became parameters.

    After a change of variable the equation is another one: then the text is SymPy's of the input.
    """
    is_changed = parsed.equation is not None and parsed.equation.change is not None
    if isinstance(S, str) and (is_changed or not parsed.letters):
        return S.strip()
    if not is_changed or isinstance(S, Equation):
        return parsed.text
    from kovacic.reading.symbolic import equation_text

    return equation_text(S)


@limited
def decide(
    S: Any,
    *,
    var: str | None = None,
    assume: Mapping[Any, Any] | None = None,
    parameters: Sequence[str] = (),
    limits: Limits = DEFAULT_LIMITS,
) -> Verdict:
    """The case of y'' = S(x) y alone, without the polynomial of omega and without the second check.

    Parameters
    ----------
    S : str, sympy.Expr or pair of sequences
        A rational function, or an equation, as for `kovacic.solve`.
    var : str
        The name of the variable; by default the only symbol, or x.
    assume : mapping
        Assumptions about parameters, or their values, as for `kovacic.solve`.
    parameters : sequence of str
        Names of parameters that have more than one letter, as "EI" or "mass"; other such names are refused.
    limits : Limits
        Bounds on the input and on the work; by default those of `Limits()`.

    Raises
    ------
    InputError, LimitExceeded
        As `kovacic.solve`.

    Examples
    --------
    >>> import kovacic
    >>> kovacic.decide("-3/(16*x^2) + 1/x").case
    2
    >>> kovacic.decide("x").status
    <Status.NONE_EXISTS: 'none'>
    >>> kovacic.decide("a/x^2", assume={"a": 2}).case
    1
    """
    S, parsed, assume = _read_question(S, {}, var, assume, parameters, limits)
    decision, *_ = _decided(parsed, S, assume, Budget(limits), certify=False)
    return Verdict(decision.status, decision.case, decision.undecided)


def _read_question(
    S: Any,
    coefficients: Mapping[str, Any],
    var: str | None,
    assume: Mapping[Any, Any] | None,
    parameters: Sequence[str],
    limits: Limits,
) -> tuple[Any, Parsed, Mapping[Any, Any] | None]:
    """The input with the values among the assumptions, as given and as read, and the other assumptions."""
    names = declared(parameters, assume)
    given = {name: value for name, value in coefficients.items() if value is not None}
    if S is None and coefficients:
        if "a" not in given:
            raise InputError("one equation is expected: S, or the coefficients a=, b=, c=, f= with at least a=")
        a, b, c, f = (given.get(name, 0) for name in "abcf")
        parsed = read_coefficients(a, b, c, f, var=var, limits=limits, names=names)
    elif given:
        hint = "write all of it as text, \"y'' = x*y + sin(x)\", or give a=, b=, c= and f= alone"
        raise InputError(f"one equation is expected, not both S and {', '.join(given)}", hint=hint)
    else:
        parsed = read_input(S, var=var, limits=limits, exponentials=True, names=names)
    if not assume:
        return S, parsed, assume
    from kovacic.reading.substitution import with_assumed_values

    return with_assumed_values(S, parsed, assume, limits)


def _decided(
    parsed: Parsed, S: Any, assume: Mapping[Any, Any] | None, budget: Budget, *, certify: bool
) -> tuple[Decision, tuple[str, ...], bool, Assumptions | None]:
    """The decision, the notices, True if it is proven for all values with the assumptions, and the assumptions as read."""
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
    notices = (*parsed.notices, sentence) if sentence else parsed.notices
    return decision, notices, proven, known
