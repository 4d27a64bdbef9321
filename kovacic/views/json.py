"""Answers as JSON, schema 1: a contract, described by `schema.json` next to this file.

    {"schema": 1, "input": "2", "variable": "x", "S": "2", "status": "liouvillian", "case": 1,
     "riccati": {"variable": "w", "degree": 1, "coefficients": ["-c", "1"]},
     "constants": {"symbol": "c", "minimal_polynomial": "c**2 - 2"},
     "verified": true, "proof": {...}, "notices": [], "seconds": 0.001}

Coefficients run from low to high, in Python/SymPy syntax in the variable and the symbol of the constants; the last one is
"1".  Those of degree 6 and 12 are null unless requested: they follow from the semi-invariant by the recurrence of
`kovacic.verify.identity`, and would be most of the answer.
`proof` has the further data for a check: the semi-invariant of omega as prod D^... exp(int theta) P, or for a P that is too
long, both being null, `series`, theta with the powers in P about a point; the rational invariant; the evidence against
everything excluded; and the reason of an undecided equation.
`group`, on request, has the name, the order, and the family of the group with its parameter n; on a curve of positive genus
also the function, in pieces, that shows whether it is finite, or the orders modulo primes that show an infinite group.
Keys may be added within schema 1; none is removed or changes its meaning.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from flint import fmpz

from kovacic import derived
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.answer import Answer
from kovacic.decision import (
    Decision,
    Evidence,
    Exclusion,
    NecessaryCondition,
    NoInvariant,
    NoRationalOmega,
    NoTerminatingSeries,
    RiccatiPolynomial,
    Rule,
    SemiInvariant,
    Structure,
    TerminatingSeries,
)
from kovacic.equation import EULER, PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text, for_json
from kovacic.reading.arithmetic import VARIABLE, Arithmetic
from kovacic.reading.differential import WrittenReader, generators
from kovacic.reading.names import words_among
from kovacic.reading.read import read_input
from kovacic.verify import verify
from kovacic.verify.factors import is_a_field
from kovacic.verify.identity import form_numerators
from kovacic.writing.escaped import json_line, strict_json
from kovacic.writing.formula import Formulas

SCHEMA = 1
#: The coefficients of an equation a y'' + b y' + c y = f.
_COEFFICIENTS = ("a", "b", "c", "f")

#: The degrees of omega from which on the coefficients follow from the semi-invariant.
_LEAST_BY_RECURRENCE = 6

# An answer may be larger than an input may be by default.
_READING_LIMITS = Limits(digits=10**7, exponent=10**6, degree=200_000, bits=40_000_000)

_ARITHMETIC = Arithmetic(_READING_LIMITS)


def dumps(answer: Answer, *, full: bool = False) -> str:
    """The answer as one line of JSON; `full` adds the group, two solutions in closed form, and any polynomial of omega."""
    return json_line(to_dict(answer, full=full))


def loads(text: str | Mapping[str, Any], *, unverified: bool = False) -> Answer:
    """The answer that `dumps` wrote, as text or as the JSON object; verified again, whatever it claims.

    Redundant keys must agree, the group must be the one that is computed anew, and solutions must solve the equation.
    `seconds`, `notices`, the evidence for the group and the user's own keys aren't checked.

    Raises `InputError` if the text isn't an answer in schema 1, or contradicts itself, and `VerificationFailed` if the
    answer doesn't pass its check, unless `unverified` accepts it all the same.
    """
    try:
        data = strict_json(text) if isinstance(text, str) else text
    except (ValueError, RecursionError) as error:
        raise InputError(f"this isn't JSON: {error}") from None
    if not isinstance(data, Mapping):
        raise InputError("this isn't an answer: a JSON object is expected")
    if data.get("schema") != SCHEMA:
        raise InputError(f"unknown schema {data.get('schema')!r}; this version reads schema {SCHEMA}")
    try:
        answer = from_dict(data)
    except (KeyError, TypeError, AttributeError, IndexError, ValueError, ArithmeticError, RecursionError) as error:
        raise InputError(f"this isn't an answer in schema {SCHEMA}: {type(error).__name__}: {error}") from error
    if not (answer.verified or unverified or answer.decision.undecided):
        raise VerificationFailed("the answer doesn't pass its check: it was altered, or was never right")
    return answer


def to_dict(answer: Answer, *, full: bool = False) -> dict[str, Any]:
    """The answer as a JSON object of plain Python values."""
    names = Formulas(answer.variable, answer.S.field)
    decision = answer.decision
    conditions = riccati = constants = None
    if parameters_of(answer.S.field):
        from kovacic.parametric.restriction import generic_conditions

        conditions = {key: [*map(str, functions)] for key, functions in vars(generic_conditions(answer)).items()}
    if decision.riccati is not None:
        is_written = full or decision.riccati.degree < _LEAST_BY_RECURRENCE
        coefficients = [*map(names.python, decision.riccati.coefficients)] if is_written else None
        riccati = {"variable": names.unknown, "degree": decision.riccati.degree, "coefficients": coefficients}
    if answer.constants is not None:
        constants = {"symbol": names.symbol, "minimal_polynomial": answer.constants.to_str(names.symbol)}
    data: dict[str, Any] = {
        "schema": SCHEMA,
        "input": answer.text,
        "variable": answer.variable,
        "S": names.python(answer.S),
        "status": decision.status.value,
        "case": decision.case,
        "riccati": riccati,
        "constants": constants,
        "field": _field_dict(answer.S.field),
        **({"letters": {name: as_text(meaning) for name, meaning in answer.letters}} if answer.letters else {}),
        "generic_conditions": conditions,
        "verified": answer.verified,
        "proof": _proof(decision, names),
        "notices": list(answer.notices),
        "seconds": answer.seconds,
        "equation": answer.equation and _given_equation(answer.equation),
        "gauge": answer.equation and names.python(answer.equation.gauge),
    }
    if full:
        data["group"] = group_dict(answer)
        data["solutions"] = None
        with suppress(LimitExceeded):
            data["solutions"] = _solutions_as_text(answer)
    return data


def _proof(decision: Decision, names: Formulas) -> dict[str, Any]:
    """The data for a check in addition to the polynomial of omega."""
    semi_invariant = None
    if decision.semi_invariant is not None and decision.riccati is not None:
        semi_invariant = {**_form_dict(decision.semi_invariant, names), "D": names.python(decision.riccati.D)}
    series = {}
    if (found := decision.series) is not None:
        powers = {name: for_json(getattr(found, name)) for name in ("step", "degree", "lowest")}
        series["series"] = {"theta": names.python(found.theta), "centre": names.python(found.centre), **powers}
    return {
        "structure": decision.structure and decision.structure.value,
        "semi_invariant": semi_invariant,
        "invariant": decision.invariant and _form_dict(decision.invariant, names),
        "excluded": [
            {
                "structure": exclusion.structure.value,
                "case": exclusion.structure.case,
                "evidence": [_evidence_dict(item, names) for item in exclusion.evidence],
            }
            for exclusion in decision.exclusions
        ],
        "undecided": decision.undecided,
        **series,
    }


def _solutions_as_text(answer: Answer) -> list[str] | None:
    """The closed form in the letters of S."""
    form = None if answer.case is None else derived.in_letters(answer)
    return None if form is None else [as_text(form.y1), as_text(form.y2)]


def group_dict(answer: Answer) -> dict[str, Any] | None:
    """The name, the order (None if infinite), the finiteness, family and evidence of the group; None if undecided."""
    group = derived.group(answer)
    if group is None:
        return None
    data: dict[str, Any] = {
        "name": group.name,
        "order": group.order and for_json(group.order),
        "finite": group.finite,
        "family": group.kind.value,
        "n": group.n and for_json(group.n),
    }
    f = group.function
    if f is not None:
        names = Formulas(answer.variable, answer.S.field)
        data["function"] = {
            "multiple": for_json(f.multiple),
            "h": names.python(f.h),
            "pieces": [
                {"exponent": for_json(piece.exponent), "a": names.python(piece.a), "b": names.python(piece.b)}
                for piece in f.pieces
            ],
            "rest": names.python(f.rest),
        }
    if group.orders:
        data["orders"] = [{"prime": p, "order": for_json(k)} for p, k in group.orders]
    return data


def from_dict(data: Mapping[str, Any]) -> Answer:
    """The answer that `to_dict` made into an object: S and the equation are read from the input, as `solve` reads them."""
    variable, text = (_typed(data, key, str) for key in ("variable", "input"))
    parsed = _read_again(data, text, variable)
    decision = _decision(data, parsed.S, variable)
    notices = tuple(_typed({"notice": notice}, "notice", str) for notice in data["notices"])
    seconds = _typed(data, "seconds", int, float, type(None))
    verified = bool(verify(parsed.S, decision))
    letters: tuple[tuple[str, Any], ...] = ()
    if data.get("letters"):
        from kovacic.reading.symbolic import written_expression

        for name, meaning in data["letters"].items():
            with suppress(InputError):  # a function that the reader doesn't know: the letter stays
                letters = (*letters, (name, written_expression(meaning)))
    answer = Answer(text, variable, parsed.S, decision, notices, verified, seconds, parsed.equation, letters=letters)
    if verified and not _typed(data, "verified", bool):
        raise ValueError("the answer is marked as failing its check, but passes it")
    _demand_the_same(data, to_dict(answer), "")
    _check_normal_form(answer, verified=verified)
    if verified:
        _check_group(answer, data.get("group"))
        _check_solutions(answer, data.get("solutions"))
    return answer


def _read_again(data: Mapping[str, Any], text: str, variable: str) -> Parsed:
    """The input.  Raises `ValueError` unless S, the equation and the gauge are those of the data."""
    change = (data.get("equation") or {}).get("change") or {}
    given = change.get("variable", variable)
    parameters = (data.get("field") or {}).get("parameters") or ()
    numbers = {PI, EULER} & {PI, *(data.get("letters") or {})}
    names = words_among(name for name in parameters if name not in numbers)
    read = partial(read_input, text, var=given, limits=_READING_LIMITS, exponentials=given != variable, names=names)
    parsed = read()
    found = parameters_of(parsed.S.field)
    if found != tuple(parameters) and sorted(found) == sorted(parameters):  # constants of SymPy come in another order
        parsed = read(order=parameters)
    is_over_the_same = parsed.variable == variable and _is_field(data.get("field"), parsed.S.field)
    if not is_over_the_same or _AnswerReader.over(parsed.S.field, variable).ratfunc(data["S"]) != parsed.S:
        raise ValueError("S isn't that of the input")
    if data.get("equation") is not None or data.get("gauge") is not None:
        _check_given_equation(data, parsed.equation, variable)
    return parsed


def _decision(data: Mapping[str, Any], S: RatFunc, variable: str) -> Decision:
    """The claim about S, with its proof; nothing is verified."""
    proof = data["proof"]
    has_omega = data["riccati"] is not None
    has_form = proof["semi_invariant"] is not None
    is_over_constants = has_omega or "series" in proof
    if has_omega != has_form or (data["constants"] is not None and not is_over_constants):
        raise ValueError("omega needs its polynomial and the semi-invariant")
    over_S = _AnswerReader.over(S.field, variable)
    over_constants = over_S.extended(data["constants"])
    names = Formulas(variable, S.field)
    exclusions = tuple(
        Exclusion(Structure(entry["structure"]), tuple(_read_evidence(item, names) for item in entry["evidence"]))
        for entry in proof["excluded"]
    )
    form = riccati = None
    if has_form:
        form = over_constants.semi_invariant(proof["semi_invariant"])
        D = over_constants.poly(proof["semi_invariant"]["D"])
        riccati = _riccati(S, form, D, data["riccati"], over_constants)
    return Decision(
        structure=None if proof["structure"] is None else Structure(proof["structure"]),
        exclusions=exclusions,
        invariant=None if proof["invariant"] is None else over_S.semi_invariant(proof["invariant"]),
        semi_invariant=form,
        riccati=riccati,
        undecided=_typed(proof, "undecided", str, type(None)),
        series=over_constants.series(proof["series"]) if "series" in proof else None,
    )


#: Keys that are compared by value, keys that are ignored or checked elsewhere, and keys that may be absent.
_BY_VALUE = {"S", "theta", "centre", "P", "D", "coefficients", "minimal_polynomial", *_COEFFICIENTS, "gauge", "near"}
_ELSEWHERE = {"verified", "notices", "seconds", "solutions", "group"}
_MAY_BE_ABSENT = {"field", "letters", "generic_conditions", "equation", "gauge", "change", "near"}
#: The facts about a group, and the evidence for them, which is computed anew.
_GROUP_FACTS = ("name", "order", "finite", "family", "n")
_GROUP_EVIDENCE = {"form", "function", "orders"}


def _demand_the_same(found: Any, written: Any, path: str) -> None:
    """Raise `ValueError` if a value differs from the one that we would write; `path` is its place in the answer."""
    are_lists = isinstance(written, list) and isinstance(found, list)
    if isinstance(written, Mapping) and isinstance(found, Mapping):
        differing = set(written) - set(found) - _MAY_BE_ABSENT
        if path:  # at the top there may be keys of the user's own
            differing |= set(found) - set(written)
        if differing:
            raise ValueError(f"{path or 'the answer'} has other keys: {', '.join(sorted(map(repr, differing)))}")
        for key in (set(found) & set(written)) - _BY_VALUE - _ELSEWHERE:
            _demand_the_same(found[key], written[key], f"{path}.{key}" if path else key)
    elif are_lists and len(found) == len(written):
        for k, (one, other) in enumerate(zip(found, written, strict=True)):
            _demand_the_same(one, other, f"{path}.{k}")
    elif found != written or type(found) is not type(written):
        raise ValueError(f"{path} can't be {found!r}")


def _check_normal_form(answer: Answer, *, verified: bool) -> None:
    """Raise `ValueError` unless P is monic and D the product of the factors to half the orders of the poles.

    In a `verified` answer P of the rational form has to be monic, too, and a form of degree 2 that of omega.
    """
    form, riccati, F = answer.semi_invariant, answer.riccati, answer.decision.invariant
    if form is None or riccati is None:
        return
    D = answer.S.field.one
    for p, k in answer.S.field.factor(answer.S.den):
        D *= p ** ((k + 1) // 2)
    if form.P.lc != 1 or riccati.D != D:
        raise ValueError("P or D isn't in its normal form")
    if F is None or not verified:
        return
    if F.P.lc != 1:
        raise ValueError("P of the invariant isn't in its normal form")
    if riccati.degree > 1:
        return
    # omega = A/(P D) is a root of the polynomial of F = y1 y2, W^2 - B_1/(B_0 D) W + B_2/(B_0 D^2): the second solution is
    # F/y1 then.  Another rational form would be valid, too, but not that of this omega.
    B = form_numerators(answer.S, F, riccati.D)
    P, A = riccati.numerators
    if B is None or len(B) != 3 or B[0] * A * A - B[1] * A * P + B[2] * P * P:
        raise ValueError("omega doesn't belong to the invariant")


def _check_group(answer: Answer, data: Mapping[str, Any] | None) -> None:
    """Raise `ValueError` unless the group, computed and verified anew, is the same; the recorded evidence isn't needed."""
    if data is None:
        return
    found = group_dict(answer)
    if found is None:
        raise ValueError("the answer names a group, but none can be determined")
    claimed = {key: value for key, value in data.items() if key not in _GROUP_EVIDENCE}
    # Older versions write neither the family nor n.
    facts = {key: found[key] for key in _GROUP_FACTS if key in data or key in ("name", "order", "finite")}
    _demand_the_same(claimed, facts, "group")


def _check_solutions(answer: Answer, texts: Any) -> None:
    """Raise `ValueError` unless the solutions are those computed anew, or others of the same equation."""
    if texts is None:
        return
    found = _solutions_as_text(answer)
    if found is None:
        raise ValueError("the answer has solutions, but the equation has none")
    if texts == found:
        return
    from sympy import Symbol

    from kovacic.closed_form.check import are_independent, is_numerical_solution
    from kovacic.reading.symbolic import written_expression

    # Another version may write them differently, but not in another variable.
    if not isinstance(texts, list) or len(texts) != 2 or not all(isinstance(text, str) for text in texts):
        raise ValueError("two solutions are expected")
    variable = Symbol(answer.variable)
    y1, y2 = map(written_expression, texts)
    # The residual is relative to y, which the Wronskian shows not to vanish.
    if not are_independent(y1, y2, variable) or not all(
        is_numerical_solution(y, variable, answer.S, answer.gauge) for y in (y1, y2)
    ):
        raise ValueError("the solutions aren't those of the equation")


def _check_given_equation(data: Mapping[str, Any], equation: Equation | None, variable: str) -> None:
    """Raise `ValueError` unless the equation and the gauge are those that were read."""
    if equation is None:
        raise ValueError("the answer has an equation or a gauge, but S alone was given")
    reader = _AnswerReader.over(equation.a.field, variable)
    found = data["equation"]
    if not _is_field(found["field"], equation.a.field):
        raise ValueError("the field of the equation isn't that of the input")
    if any(reader.ratfunc(found[name]) != getattr(equation, name) for name in _COEFFICIENTS):
        raise ValueError("the equation isn't that of the input")
    if reader.ratfunc(data["gauge"]) != equation.gauge:
        raise ValueError("the gauge isn't that of the equation")


def _given_equation(equation: Equation) -> dict[str, Any]:
    """The equation as given."""
    coefficients = {name: getattr(equation, name).to_str(equation.variable) for name in _COEFFICIENTS}
    return {
        "text": equation.text(caret=False),
        "unknown": equation.unknown,
        **coefficients,
        "h": None if equation.h is None else as_text(equation.h),
        "field": _field_dict(equation.a.field),
        "change": equation.change and equation.change.to_dict(),
    }


def _field_dict(field: Field) -> dict[str, Any] | None:
    """The coefficient field of S: parameters, and an algebraic number with its minimal polynomial over Q."""
    if field == QQ:
        return None
    data: dict[str, Any] = {"parameters": list(parameters_of(field)), "symbol": None, "minimal_polynomial": None}
    if isinstance(field, AlgebraicField):
        data["symbol"] = field.name
        data["minimal_polynomial"] = field.modulus.to_str("t")
        if field.approximation is not None:
            data["near"] = [f"{float(part):.15g}" for part in field.approximation]
    return data


def _is_field(data: Mapping[str, Any] | None, field: Field) -> bool:
    """True if `_field_dict` writes this; older versions didn't specify the root."""
    written = _field_dict(field)
    if written is None or data is None:
        return written is data
    return {"near": written.get("near"), **data} == {"near": None, **written}


@dataclass(frozen=True)
class _AnswerReader(WrittenReader):
    """Reads the functions in the output of `to_dict`."""

    @classmethod
    def over(cls, field: Field, variable: str) -> _AnswerReader:
        """A reader of the variable, the parameters, and the algebraic constant of a field."""
        return cls(field, {**generators(field), variable: VARIABLE}, _ARITHMETIC)

    def extended(self, constants: Mapping[str, Any] | None) -> _AnswerReader:
        """A reader of omega's constant c, too.  Raises `ValueError` if K[c] is no field: a gcd might not terminate."""
        if constants is None:
            return self
        symbol = constants["symbol"]
        modulus = replace(self, names={**self.names, symbol: VARIABLE}).poly(constants["minimal_polynomial"])
        field = AlgebraicField(self.field, modulus)
        if not (modulus.is_monic and is_a_field(field)):
            raise ValueError(f"the polynomial of {symbol} isn't monic and irreducible")
        return replace(self, names={**self.names, symbol: field.generator}, field=field)

    def semi_invariant(self, data: Mapping[str, Any]) -> SemiInvariant:
        return SemiInvariant(_typed(data, "degree", int), self.ratfunc(data["theta"]), self.poly(data["P"]))

    def series(self, data: Mapping[str, Any]) -> TerminatingSeries:
        step, degree, lowest = (int(fmpz(_typed(data, name, int, str))) for name in ("step", "degree", "lowest"))
        return TerminatingSeries(self.ratfunc(data["theta"]), self.poly(data["centre"]), step, degree, lowest)


def _riccati(
    S: RatFunc, form: SemiInvariant, D: Poly, data: Mapping[str, Any], reader: _AnswerReader
) -> RiccatiPolynomial:
    """The numerators A_k with (-1)^k A_k/(P D^k) the coefficient of W^(m-k)."""
    P = form.P
    if data["coefficients"] is None:
        by_recurrence = form_numerators(S, form, D)
        if by_recurrence is None or not _LEAST_BY_RECURRENCE <= form.degree == data["degree"]:
            raise ValueError("the polynomial of omega is missing, and isn't that of the semi-invariant")
        return RiccatiPolynomial(P, D, tuple(by_recurrence))
    *coefficients, leading = (reader.ratfunc(text) for text in data["coefficients"])
    if leading != 1 or len(coefficients) != data["degree"] or data["degree"] not in (1, 2, 4, 6, 12):
        raise ValueError("the polynomial of omega isn't monic of its degree")
    numerators = [P]
    for k, coefficient in enumerate(reversed(coefficients), start=1):
        product = coefficient * (P * D**k) * (-1) ** k
        if not product.is_polynomial:
            raise ValueError("D isn't a denominator of the polynomial of omega")
        numerators.append(product.num)
    return RiccatiPolynomial(P, D, tuple(numerators))


def _form_dict(form: SemiInvariant, names: Formulas) -> dict[str, Any]:
    return {"degree": form.degree, "theta": names.python(form.theta), "P": names.python(form.P)}


def _evidence_dict(evidence: Evidence, names: Formulas) -> dict[str, Any]:
    if isinstance(evidence, NecessaryCondition):
        places = [names.place_name(place) for place in evidence.places]
        rule = evidence.rule
        return {"kind": "necessary_condition", "rule": rule.name.lower(), "places": places, "statement": rule.value}
    if isinstance(evidence, NoInvariant):
        return {"kind": "no_invariant", **vars(evidence)}
    if isinstance(evidence, NoTerminatingSeries):
        return {"kind": "no_terminating_series", **vars(evidence)}
    return {"kind": "no_rational_omega", **vars(evidence), "place": names.place_name(evidence.place)}


def _read_evidence(data: Mapping[str, Any], names: Formulas) -> Evidence:
    if data["kind"] == "necessary_condition":
        places = tuple(names.internal_place(name) for name in data["places"])
        return NecessaryCondition(Rule[data["rule"].upper()], places)
    if data["kind"] == "no_terminating_series":
        return NoTerminatingSeries(_typed(data, "count", int))
    prime = _typed(data, "prime", int, type(None))
    degree = _typed(data, "degree", int)
    if data["kind"] == "no_invariant":
        return NoInvariant(_typed(data, "invariant_degree", int), prime, _typed(data, "point", int), degree)
    if data["kind"] == "no_rational_omega":
        return NoRationalOmega(degree, prime, names.internal_place(_typed(data, "place", str)))
    raise ValueError(f"unknown evidence {data['kind']!r}")


def _typed(data: Mapping[str, Any], key: str, *types: type) -> Any:
    """The value of this key.  Raises `ValueError` for another type; a truth value isn't a number."""
    if type(data[key]) not in types:
        raise ValueError(f"{key} can't be {data[key]!r}")
    return data[key]
