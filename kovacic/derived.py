"""Consequences of an answer: the groups, two solutions, the check.  Each is computed on demand, once.

Each room is imported when its function is called: a verdict alone needs neither SymPy nor the group.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from kovacic.answer import Answer, computed_once
from kovacic.decision import GroupClaim
from kovacic.errors import LimitExceeded, VerificationFailed
from kovacic.limits import Budget, limited
from kovacic.verify import Verification, verify

if TYPE_CHECKING:
    from kovacic.closed_form.form import ClosedForm
    from kovacic.galois import EquationGroup, Group
    from kovacic.special.search import SpecialFunctions


@computed_once
@limited
def group(answer: Answer) -> Group | None:
    """The differential Galois group of y'' = S y, a subgroup of SL2(C); None if the equation is undecided.

    Raises `VerificationFailed` if the kernel doesn't confirm it, which for an answer of `solve` is a defect.
    """
    from kovacic.galois import group_of

    try:
        found = group_of(answer.S, answer.decision, answer.limits)
        if found is None:
            return None
        verification = verify(answer.S, answer.decision, found.claim, budget=Budget(answer.limits))
    except LimitExceeded:
        return None
    if not verification:
        raise VerificationFailed(f"the group of S = {answer.S} failed its own check\n{verification}")
    return found


@computed_once
@limited
def equation_group(answer: Answer) -> EquationGroup | None:
    """The group of the equation as it was given, in GL2(C); None without `group`, and with a gauge and parameters."""
    from kovacic.galois import equation_group

    of_normal_form = group(answer)
    if of_normal_form is None:
        return None
    try:
        return equation_group(answer.S, answer.decision, of_normal_form, answer.gauge)
    except LimitExceeded:
        return None


def is_algebraic(answer: Answer) -> bool | None:
    """True if all solutions of the equation as given are algebraic functions; None if that wasn't determined."""
    found = equation_group(answer)
    return None if found is None else found.finite


@computed_once
@limited
def closed_form(answer: Answer) -> ClosedForm | None:
    """Two independent solutions as SymPy expressions, how they were checked, and notes; None without a solution."""
    if answer.case is None:
        return None
    return _in_given_symbols(answer, in_letters(answer))  # type: ignore[no-any-return]


@computed_once
@limited
def in_letters(answer: Answer) -> ClosedForm:
    """The closed form in the user's variable, and in the letters of S for constants."""
    from kovacic.reading.change_of_variable import real_values
    from kovacic.special.choice import chosen_form

    places = () if answer.equation is None else real_values(answer.equation)
    budget = Budget(answer.limits)
    found = chosen_form(answer.S, answer.decision, answer.gauge, answer.variable, budget, places=places)
    return _in_given_variable(answer, found)  # type: ignore[no-any-return]


def solutions(answer: Answer) -> tuple[Any, ...]:
    """y1 and y2 of the closed form; empty without a Liouvillian solution."""
    form = closed_form(answer)
    return () if form is None else (form.y1, form.y2)


@computed_once
def special(answer: Answer) -> SpecialFunctions:
    """Two solutions in Airy's, Bessel's, Kummer's or Gauss' functions, or which classes of these were searched in vain.

    Assumptions about parameters are used: hermite(n, x) for natural n.  An exhausted limit is a value, `stopped`.
    """
    from kovacic.special.search import special_functions
    from kovacic.special.writer import Wanted

    symbols = answer.known.symbols() if answer.known else {}
    found = special_functions(Wanted(answer.S, answer.gauge, answer.variable, symbols), Budget(answer.limits))
    pair = found.pair
    if pair is None:
        return found
    if symbols:
        plain = {symbol: type(symbol)(name) for name, symbol in symbols.items()}
        pair = pair.mapped(lambda e: e.xreplace(plain))
    if answer.change is not None or answer.letters:
        pair = replace(pair, wronskian=None)
    return replace(found, pair=_in_given_symbols(answer, _in_given_variable(answer, pair)))


def _in_given_symbols(answer: Answer, found: Any) -> Any:
    """`found` with the constants in place of their letters in y1 and y2."""
    if not answer.letters:
        return found
    from sympy import Symbol

    meanings = {Symbol(name): meaning for name, meaning in answer.letters}
    return replace(found, y1=found.y1.xreplace(meanings), y2=found.y2.xreplace(meanings))


def _in_given_variable(answer: Answer, found: Any) -> Any:
    """`found` with y1 and y2 in the user's variable."""
    if answer.equation is None or answer.change is None:
        return found
    from kovacic.closed_form.real_pair import pair_in_x

    y1, y2 = pair_in_x(answer.equation, found.y1, found.y2)
    return replace(found, y1=y1, y2=y2)


@limited
def verification(answer: Answer) -> Verification:
    """Every claim recomputed, the group's too, by independent code; true exactly when all of them hold."""
    from kovacic.galois import group_of

    def claim() -> GroupClaim | None:
        found = group_of(answer.S, answer.decision, answer.limits)
        return None if found is None else found.claim

    return verify(answer.S, answer.decision, claim, budget=Budget(answer.limits))
