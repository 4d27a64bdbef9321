"""JSON, schema 1: the schema, the way back, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import sympy
from build import QQ, RatFunc, parametrize, run
from published import Published, load

import kovacic
from kovacic import InputError, Limits, VerificationFailed, checker
from kovacic.special.gauss import Gauss
from kovacic.special.pullback import Pullback

loads = kovacic.Solution.from_json

SCHEMA = json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
PUBLISHED = load()


def test_the_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@parametrize("entry", PUBLISHED, ordinary=12, long=15, ids=lambda entry: entry.id)
def test_published_equations_there_and_back(entry: Published) -> None:
    answer = kovacic.solve(entry.S)
    line = answer.to_json()
    assert "\n" not in line
    data = json.loads(line)
    VALIDATOR.validate(data)
    assert (data["schema"], data["case"], data["verified"]) == (1, entry.case, True)
    assert data["status"] == ("none" if entry.case is None else "liouvillian")
    read = kovacic.Solution.from_json(line)
    assert read == answer
    assert read.to_json() == line


@pytest.mark.parametrize("most", [1, 3])
@pytest.mark.parametrize(
    "S", ["x", "x^6 + 2000000007*x^2", "x^2 + a", "(x^2 + 21)", "675/(324*x^4 + 864*x^3 + 2664*x^2 + 2784*x + 3364)"]
)
def test_answers_within_low_limits_there_and_back(S: str, most: int, capsys: pytest.CaptureFixture[str]) -> None:
    """What was decided, or left open, with a low bound on degrees is read where the bound is the usual one."""
    answer = kovacic.solve(S, limits=Limits(unknown_degree=most))
    assert loads(answer.to_json()) == loads(answer.to_json(full=True)) == answer
    assert run(["solve", "--json", "--limit", f"unknown_degree={most}", S]) in (0, 3)
    assert loads(capsys.readouterr().out) == answer


@pytest.mark.parametrize("variable", ["t", "c", "w", "W", "xx", "λ"])
@pytest.mark.parametrize("S", ["2", "-3/(16*{0}^2) + 1/{0}", "1/(4*{0}^2)", "{0}", "-({0}^2+1)/({0}^3-{0}+1)^2"])
def test_every_variable_name_comes_back(S: str, variable: str) -> None:
    answer = kovacic.solve(S.format(variable), var=variable)
    line = answer.to_json()
    data = json.loads(line)
    VALIDATOR.validate(data)
    assert loads(line) == answer
    assert loads(line).to_json() == line
    if data["constants"] is not None:
        assert data["constants"]["symbol"] != variable
    if data["riccati"] is not None:
        assert data["riccati"]["variable"] != variable


def test_the_form_that_other_programs_rely_on() -> None:
    data = json.loads(kovacic.solve("2").to_json())
    assert list(data)[:5] == ["schema", "input", "variable", "S", "status"]
    assert data["riccati"] == {"variable": "w", "degree": 1, "coefficients": ["-c", "1"]}
    assert data["constants"] == {"symbol": "c", "minimal_polynomial": "c**2 - 2"}
    assert isinstance(data["seconds"], float)
    none = json.loads(kovacic.solve("x").to_json())
    assert (none["status"], none["case"], none["riccati"], none["constants"]) == ("none", None, None, None)
    assert [entry["structure"] for entry in none["proof"]["excluded"]] == [
        "reducible",
        "imprimitive",
        "tetrahedral",
        "octahedral",
        "icosahedral",
    ]


@parametrize("S", ["x^2+3", "2", "-3/(16*x^2)+1/x", "(-5*x**2 - 27)/(36*x**4 - 72*x**2 + 36)"], ordinary=2, long=1)
def test_sympy_reads_the_coefficients_and_they_solve_the_riccati_equation(S: str) -> None:
    """Independent of the package: dM/dx + (S - w^2) dM/dw = 0 modulo M, over Q(c)."""
    data = json.loads(kovacic.solve(S).to_json())
    x, w, c = sympy.symbols("x w c")
    # Text that this package has written.
    coefficients = [sympy.sympify(text) for text in data["riccati"]["coefficients"]]
    M = sum(coefficient * w**k for k, coefficient in enumerate(coefficients))
    identity = sympy.diff(M, x) + (sympy.sympify(data["S"]) - w**2) * sympy.diff(M, w)
    remainder = sympy.numer(sympy.together(sympy.rem(identity, M, w)))
    if data["constants"] is not None:
        remainder = sympy.rem(remainder, sympy.sympify(data["constants"]["minimal_polynomial"]), c)
    assert sympy.expand(remainder) == 0


def test_undecided_answers_say_why() -> None:
    answer = kovacic.solve("x^4 + x^2 + 2002*x + 1/4", limits=Limits(unknown_degree=100))
    data = json.loads(answer.to_json())
    VALIDATOR.validate(data)
    assert (data["status"], data["case"]) == ("undecided", None)
    assert "100" in data["proof"]["undecided"]
    assert loads(answer.to_json()) == answer


def test_a_changed_certificate_fails_its_check() -> None:
    data = json.loads(kovacic.solve("x^2 + 3").to_json())
    assert loads(data).verify()
    data["riccati"]["coefficients"][0] = "(-x**2 - 2)/x"
    with pytest.raises(VerificationFailed, match="doesn't pass its check"):
        loads(data)
    assert not loads(data, unverified=True).verify()


def test_a_changed_proof_fails_its_check() -> None:
    data = json.loads(kovacic.solve("x").to_json())
    data["S"] = "x^2 + 3"
    with pytest.raises(InputError, match="S isn't that of the input"):
        loads(data)
    data["input"] = "x^2 + 3"
    with pytest.raises(VerificationFailed):
        loads(data)
    assert not loads(data, unverified=True).verified
    assert not loads(data, unverified=True).verify()


@pytest.mark.parametrize(
    "path",
    [
        "case",
        "verified",
        "riccati.variable",
        "riccati.degree",
        "constants.symbol",
        "generic_conditions",
        "proof.semi_invariant.degree",
        "proof.semi_invariant.D",
        "proof.excluded.0.case",
        "proof.excluded.0.evidence.0.statement",
        "equation.text",
        "equation.unknown",
        "equation.h",
        "equation.field",
        "group.name",
        "group.order",
        "group.n",
    ],
)
def test_what_is_said_twice_must_agree(path: str) -> None:
    """Every other value is refused, no value too, and a key that isn't known."""
    *way, key = path.split(".")
    equation = "x^2*y'' + x*y' + (4*x^3 - 1/4)*y = 0" if "equation" in path else "-3/(16*x^2) + 1/x"
    data = json.loads(kovacic.solve("2" if "constants" in path else equation).to_json(full=True))
    place = data
    for step in way:
        place = place[int(step) if step.isdigit() else step]
    right = place[key]
    for wrong in (None, True, False, 3, "t", "2*x", ["x"], {}):
        if wrong == right and type(wrong) is type(right):
            continue
        place[key] = wrong
        with pytest.raises((InputError, VerificationFailed)):
            loads(data)
    place[key] = right
    loads(data)
    if way:
        place["another"] = right
        with pytest.raises(InputError):
            loads(data)


def test_a_key_that_occurs_twice_is_refused() -> None:
    line = kovacic.solve("x").to_json()
    with pytest.raises(InputError, match="a key occurs twice"):
        loads(line.replace('"S": ', '"S": "x", "S": '))


def _without(key: str) -> dict[str, Any]:
    return {k: v for k, v in json.loads(kovacic.solve("x^2+3").to_json()).items() if k != key}


@pytest.mark.parametrize(
    "data",
    [
        "not JSON",
        "[1]",
        "{}",
        '{"schema": 2}',
        _without("proof"),
        _without("S"),
        {**_without(""), "S": 3},
        {**_without(""), "S": "sin(x)"},
        {**_without(""), "case": 2},
        {**_without(""), "status": "none"},
        {**_without(""), "status": "maybe"},
        {**_without(""), "riccati": {"variable": "w", "degree": 1, "coefficients": ["1"]}},
        {**_without(""), "riccati": {"variable": "w", "degree": 1, "coefficients": ["1/(x-5)", "1"]}},
        {**_without(""), "riccati": {"variable": "w", "degree": 1, "coefficients": ["x", "2"]}},
        {**_without(""), "constants": {"symbol": "c", "minimal_polynomial": "1/c"}},
    ],
    ids=range(15),
)
def test_what_is_no_answer_is_refused(data: Any) -> None:
    with pytest.raises(InputError):
        loads(data)


@pytest.mark.parametrize("equation", ["x^2*y'' + x*y' + (x^2-1/4)*y = 0", "y'' + sqrt(2)/x*y' - y = 0", "y''+a*y' = y"])
def test_another_gauge_is_refused(equation: str) -> None:
    answer = kovacic.solve(equation, var="x")
    data = json.loads(answer.to_json())
    assert loads(data).gauge == answer.gauge
    for wrong in ("0", "1/x", "-1/x"):
        with pytest.raises(InputError, match="gauge"):
            loads({**data, "gauge": wrong})
    with pytest.raises(InputError, match="gauge"):
        loads({**json.loads(kovacic.solve("x").to_json()), "gauge": "1/x"})


@pytest.mark.parametrize("name", ["a", "b", "c", "f"])
def test_another_equation_is_refused(name: str) -> None:
    """Twice a coefficient, or 1 in place of 0: not the equation that the input says."""
    data = json.loads(kovacic.solve("x^2*y'' + x*y' + (x^2-1/4)*y = 0").to_json())
    other = f"2*({data['equation'][name]})" if name != "f" else "1"
    with pytest.raises(InputError, match="the equation isn't that of the input"):
        loads({**data, "equation": {**data["equation"], name: other}})


def test_another_field_is_refused() -> None:
    data = json.loads(kovacic.solve("sqrt(2)*x^2 + a").to_json())
    assert loads(data).verify()
    for change in (
        {"parameters": ["b"]},
        {"parameters": []},
        {"minimal_polynomial": "t**2 - 3"},
        {"symbol": "sqrt(3)"},
    ):
        with pytest.raises(InputError, match="S isn't that of the input"):
            loads({**data, "field": {**data["field"], **change}})


def test_omega_beside_a_proof_that_there_is_none_is_refused() -> None:
    none, data = (json.loads(kovacic.solve(text).to_json()) for text in ("x", "2"))
    for change in ({"riccati": data["riccati"]}, {"constants": data["constants"]}):
        with pytest.raises(InputError, match="omega"):
            loads({**none, **change})
    with pytest.raises(InputError, match="omega"):
        loads({**none, "proof": {**none["proof"], "semi_invariant": data["proof"]["semi_invariant"]}})
    with pytest.raises(InputError, match="omega"):
        loads({**data, "riccati": None})


@pytest.mark.parametrize("near", [["1.4", float("inf")], [float("nan"), "0"], ["1/0", "0"], [None, "0"], ["1.4"], 3])
def test_a_root_that_is_nowhere_is_refused(near: Any) -> None:
    data = json.loads(kovacic.solve("sqrt(2)/x^2").to_json())
    data["field"]["near"] = near
    with pytest.raises(InputError, match="isn't an answer in schema 1"):
        loads(data)


@pytest.mark.parametrize("polynomial", ["0", "7", "c", "c**2", "(c**2 + 1)**2", "c**3 - c", "c**2 - 4", "2*c**2 + 2"])
@pytest.mark.parametrize("S", ["2", "(6*x^2-8)/(x^2-1)^2"])
def test_constants_of_no_field_are_refused(S: str, polynomial: str) -> None:
    """Before anything is computed with them: without inverses, and without primes that split, no gcd would end."""
    data = json.loads(kovacic.solve(S).to_json())
    with pytest.raises(InputError, match="isn't monic and irreducible"):
        loads({**data, "constants": {**data["constants"], "minimal_polynomial": polynomial}})
    data["constants"]["minimal_polynomial"] = polynomial
    assert checker.verdict(json.dumps(data)).startswith("refuted: ")


def test_a_rational_form_that_isnt_that_of_omega_is_refused() -> None:
    """All forms are rational for S = 0: those with the solution 1 among their factors belong to omega = 0."""
    data = json.loads(kovacic.solve("0").to_json())
    invariant = data["proof"]["invariant"]
    for P, fits in (("1", True), ("x", True), ("x - 5", True), ("x**2 + 1", False), ("x**2 - x", False), ("7", False)):
        changed = {**data, "proof": {**data["proof"], "invariant": {**invariant, "P": P}}}
        if fits:
            assert loads(changed).verified
            continue
        with pytest.raises(InputError, match=r"normal form|doesn't belong"):
            loads(changed)


@pytest.mark.parametrize("form", ["semi_invariant", "invariant"])
def test_a_degree_is_an_integer(form: str) -> None:
    data = json.loads(kovacic.solve("2").to_json())
    for wrong in (True, 1.0, 2.0, "1", "2", None):
        with pytest.raises(InputError, match="degree"):
            loads({**data, "proof": {**data["proof"], form: {**data["proof"][form], "degree": wrong}}})


EVIDENCE = [
    "x",
    "x*y'' = (x^2+1)*y' - 7*y",
    "1/(x^4-2)",
    "y'' + sqrt(2)*y' + x*y = 0",
    "1/x + 3/(16*(x-1)^2)",
    "a/x^2 + 1",
]


def with_other_evidence(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """What no search writes: a bound or a point where none is needed, places where the condition holds, or of no factor."""
    places = ["infinity", "x", "x - 1", "x**4 - 2", "nowhere", ""]
    for i, excluded in enumerate(data["proof"]["excluded"]):
        for k, item in enumerate(excluded["evidence"]):
            if item["kind"] == "necessary_condition":
                others = [{"places": [*item["places"], name]} for name in places]
                others += [{"places": [name]} for name in places if name not in item["places"]]
            elif item["prime"] is None:
                changes: list[tuple[str, Any]] = [
                    ("degree", 0),
                    ("degree", -2),
                    ("degree", 3),
                    ("point", 1),
                    ("point", -1),
                ]
                changes += [("place", name) for name in places[:-1]]
                others = [{key: value} for key, value in changes if key in item]
            else:
                others = []
            for other in others:
                changed = deepcopy(data)
                changed["proof"]["excluded"][i]["evidence"][k] |= other
                yield changed


@pytest.mark.parametrize("text", EVIDENCE)
def test_evidence_says_no_more_than_is_recomputed(text: str) -> None:
    data = json.loads(kovacic.solve(text).to_json())
    assert loads(data).verified
    changed = list(with_other_evidence(data))
    assert len(changed) > 5
    for other in changed:
        with pytest.raises((VerificationFailed, InputError)):
            loads(other)


@pytest.mark.parametrize("key", ["minimal_polynomial", "near", "symbol", "parameters"])
def test_another_field_of_the_equation_is_refused(key: str) -> None:
    data = json.loads(kovacic.solve("y'' + sqrt(2)*y' + x*y = 0").to_json())
    right = data["equation"]["field"]
    for wrong in ("t**2 - 3", ["1.5", "0"], ["a"], None, 3):
        with pytest.raises(InputError, match="field"):
            loads({**data, "equation": {**data["equation"], "field": {**right, key: wrong}}})
    older = {key: value for key, value in right.items() if key != "near"}
    assert loads({**data, "equation": {**data["equation"], "field": older}}).verified


def test_notices_and_exact_text_are_kept() -> None:
    answer = kovacic.solve(" 0.25*x^2 - 7/2 ")
    assert answer.notices
    assert loads(answer.to_json()).notices == answer.notices
    assert replace(loads(answer.to_json()), seconds=None) == answer


@pytest.mark.parametrize(("square", "said"), [(2, "checked"), (1, "refuted"), (4, "refuted")])
def test_a_constant_with_a_reducible_polynomial_is_refuted_by_the_checker(square: int, said: str) -> None:
    """omega = c with c^2 - 1 = 0 for S = 1: every identity holds, but Q(c) is no field, and omega = 1 lies over Q."""
    text = kovacic.solve("2").to_json().replace('"input": "2"', f'"input": "{square}"')
    forged = text.replace('"S": "2"', f'"S": "{square}"').replace("c**2 - 2", f"c**2 - {square}")
    assert checker.verdict(forged).partition(":")[0] == said


@pytest.mark.parametrize(
    "text", ["x^2 + 3", "-3/(16*x^2) + 1/x", "y'' + 2*y' + 3*y = 0", "a^2/x^2", "2", "y'' + y = x", "x"]
)
def test_derived_fields_that_contradict_the_answer_are_refused(text: str) -> None:
    """The group and the solutions, where they are present; other solutions of the same equation are no contradiction."""
    data = json.loads(kovacic.solve(text).to_json(full=True))
    assert loads(data).verified
    forged: list[dict[str, Any]] = [
        {"group": {}},
        {"group": {**data["group"], "finite": not data["group"]["finite"]}},
        {"group": {**data["group"], "order": 7}},
        {"solutions": ["0", "0"]},
        {"solutions": ["x^2", "1"]},
        {"solutions": []},
        {"solutions": "x"},
    ]
    if data["solutions"] is not None:
        y1, y2 = data["solutions"]
        assert loads({**data, "solutions": [f"2*({y1})", f"({y1}) + 3*({y2})"]}).verified
        forged += [
            {"solutions": pair} for pair in ([y1], [y1, f"2*({y1})"], [y1, "0"], [y1, f"x*({y2})"], [y1, y2, y2])
        ]
    for change in forged:
        with pytest.raises(InputError):
            loads({**data, **change})


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_what_json_has_no_number_for_is_refused(number: str) -> None:
    line = kovacic.solve("x").to_json()
    with pytest.raises(InputError, match="isn't a number in JSON"):
        loads(line.replace('"seconds"', f'"mine": {number}, "seconds"'))


def _primitive_answers() -> list[kovacic.Solution]:
    """Pull-backs with each of the three primitive finite groups, and shifted exponent differences."""
    x = RatFunc(QQ.poly([0, 1]))
    functions = [x**2 / (x + 1), x**3 / (x**2 + 1), (x**2 + 3 * x + 5) / (x + 1)]
    differences = ["1/2 1/3 1/3", "1/2 1/3 1/4", "1/2 1/3 1/5", "1/2 1/3 6/5"]
    squares = [[QQ.poly([Fraction(d) ** 2]) for d in row.split()] for row in differences]
    return [kovacic.solve(str(Pullback(Gauss(*row), f).S)) for row in squares for f in functions]


def test_long_polynomials_of_omega_follow_from_the_semi_invariant() -> None:
    """Of degree 6 and 12 they aren't written out; an answer is a few times as long as S, and checked without them."""
    for answer in _primitive_answers()[::5]:
        text = answer.to_json()
        data = json.loads(text)
        VALIDATOR.validate(data)
        degree = data["riccati"]["degree"]
        assert (data["riccati"]["coefficients"] is None) == (degree >= 6)
        assert len(text) < 2000 + 5 * len(data["S"]) or degree == 4
        assert loads(text) == answer
        assert checker.verdict(text).startswith("checked: S from input; case; omega")
        full = json.loads(answer.to_json(full=True))
        assert len(full["riccati"]["coefficients"]) == degree + 1
        assert loads(full) == answer


@pytest.mark.long
def test_answers_without_the_polynomial_are_checked() -> None:
    """All of them; a P, a theta or a degree that isn't the right one is found, by both checks."""
    for answer in _primitive_answers():
        data = json.loads(answer.to_json())
        assert loads(data) == answer
        assert checker.verdict(json.dumps(data)).startswith("checked")
        form = data["proof"]["semi_invariant"]
        changes: list[tuple[dict[str, Any], str, object]] = [
            (form, "P", f"({form['P']}) + 1"),
            (form, "theta", f"({form['theta']}) + 1/x"),
            (data["riccati"], "degree", 16 - data["riccati"]["degree"]),
            (data["riccati"], "coefficients", [] if data["riccati"]["degree"] > 4 else None),
        ]
        for part, key, value in changes:
            kept = part[key]
            part[key] = value
            with pytest.raises((InputError, VerificationFailed)):
                loads(data)
            assert checker.verdict(json.dumps(data)).startswith("refuted")
            part[key] = kept
