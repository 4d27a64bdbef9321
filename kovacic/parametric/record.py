"""Conditions as data, and back: `{"kind": "lattice", "form": "n - 1/2", "modulus": 1}`.

Functions of the parameters are written in Python's syntax.  The kinds are "zero" (a function vanishes), "lattice" (a form is
congruent to one of the residues, 0 if there are none), "integer root" (an equation in an unknown has one of these integers as a
root), "natural number" (one of several equations, null for too many, has a natural root, and an invariant of the degree
exists), "schwarz", "and", "or".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Structure
from kovacic.equation import Change, Equation, parameters_of
from kovacic.errors import InputError
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text, for_json, fraction
from kovacic.parametric.claims import NO_CONSTANT, Classes, ParameterPoint, over_parameters
from kovacic.parametric.integers import Congruence
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import ParameterRegion, RegionVerdict
from kovacic.parametric.riemann import Schwarz
from kovacic.parametric.statements import Both, Either, Statement, Vanishes
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, Value
from kovacic.reading.constants import Constants
from kovacic.reading.differential import WrittenReader, written_equation
from kovacic.reading.expression import parse_with
from kovacic.writing.formula import free_name

#: Limits that everything written by the package respects.
_LIMITS = Limits(degree=10**6, bits=10**8, digits=10**7, text_length=10**8, exponent=10**6)


def statement_data(statement: Statement) -> dict[str, Any]:
    if isinstance(statement, Both | Either):
        kind = "and" if isinstance(statement, Both) else "or"
        return {"kind": kind, "parts": [*map(statement_data, statement.parts)]}
    if isinstance(statement, Vanishes):
        return {"kind": "zero", "function": statement.function.to_str("x")}
    if isinstance(statement, Schwarz):
        structures = [structure.value for structure in statement.structures]
        return {"kind": "schwarz", "unknown": "Z", "squares": statement.cubic.to_str("Z"), "structures": structures}
    if isinstance(statement, Congruence):
        residues = [*map(_json_number, statement.numbers.residues)]
        modulus = _json_number(statement.numbers.modulus)
        numbers: dict[str, Any] = {"modulus": modulus, "residues": residues}
        if statement.form is None:
            letter = statement.letter
            return {"kind": "integer root", "unknown": letter, "equation": statement.equation.to_str(letter), **numbers}
        if len(residues) > 1:
            return {"kind": "lattice", "form": statement.form.to_str("x"), **numbers}
        return {
            "kind": "lattice",
            "form": (statement.form - statement.numbers.residues[0]).to_str("x"),
            "modulus": modulus,
        }
    assert isinstance(statement, Natural)
    letter = statement.letter
    x = free_name(parameters_of(statement.S.field), *"xzt")
    return {
        "kind": "natural number",
        "unknown": letter,
        "equations": statement.factors and [factor.to_str(letter) for factor in statement.factors],
        "degree": statement.m,
        "structure": statement.structure.value,
        "variable": x,
        "S": statement.S.to_str(x),
    }


def _json_number(value: Fraction) -> int | str:
    return for_json(int(value)) if value.denominator == 1 else as_text(value)


def verdict_data(verdict: RegionVerdict) -> dict[str, Any]:
    structure = verdict.structure and verdict.structure.value
    data = {"structure": structure, "known": verdict.known, "family": verdict.family}
    return data if verdict.abelian is None else data | {"abelian": verdict.abelian}


def verdict_from(data: Mapping[str, Any]) -> RegionVerdict:
    structure = None if data["structure"] is None else Structure(data["structure"])
    return RegionVerdict(structure, data["known"], data["family"], data.get("abelian"))


def region_data(region: ParameterRegion) -> dict[str, Any]:
    data: dict[str, Any] = {
        "condition": region.statement.text(),
        "case": region.case,
        "group": region.group,
        "complete": region.complete,
        "defined": region.defined,
        "statement": statement_data(region.statement),
        "verdict": verdict_data(region.verdict),
    }
    if region.shown_degree is not None:
        data["determinants"] = list(region.determinants)
    return data


def equation_data(equation: Equation | None) -> dict[str, Any] | None:
    """The given equation as text, and its variable as a function of the user's variable."""
    if equation is None:
        return None
    change = equation.change and equation.change.to_dict()
    return {"text": equation.text(caret=False), "unknown": equation.unknown, "change": change}


def equation_from(
    data: Mapping[str, Any] | None, variable: str, names: tuple[str, ...], constant: ParameterPoint
) -> Equation | None:
    """The equation that `equation_data` wrote, over the field of these parameters and the constant."""
    if data is None:
        return None
    read = written_equation(data["text"], variable, data["unknown"], Constants(_LIMITS, constant.field, (), names))
    return replace(read, change=data["change"] and Change.from_dict(data["change"]))


def constant_data(constant: ParameterPoint) -> dict[str, Any]:
    """The algebraic constant that is a parameter of the statements: its name, equation and place."""
    field = constant.field
    if not isinstance(field, AlgebraicField) or field.approximation is None:
        return {"constant": None}
    root = {"minimal_polynomial": field.modulus.to_str("t"), "near": [str(part) for part in field.approximation]}
    return {"constant": constant.names[0], "constant_root": root | {"symbol": field.name}}


def constant_from(data: Mapping[str, Any]) -> ParameterPoint:
    """The constant that `constant_data` wrote.  Raises `InputError` unless its polynomial is irreducible."""
    if data["constant"] is None:
        return NO_CONSTANT
    root = data["constant_root"]
    arithmetic = Arithmetic(_LIMITS)
    modulus = arithmetic.rational(parse_with(root["minimal_polynomial"], {"t": VARIABLE}, arithmetic)).num.monic()
    if modulus.degree < 2 or QQ.factor(modulus) != [(modulus, 1)]:
        raise InputError(f"{root['minimal_polynomial']} isn't an irreducible polynomial")
    real, imaginary = map(Fraction, root["near"])
    field = AlgebraicField(QQ, modulus, root["symbol"], (real, imaginary))
    return ParameterPoint((data["constant"],), (field.generator,), field)


@dataclass(frozen=True)
class StatementReader:
    """A reader for functions of the parameters, and statements about them; parameters named sqrt(2) are constants."""

    field: FunctionField

    def function(self, text: str, letter: str = "x") -> RatFunc:
        """A rational function in `letter` over Q(t)."""
        names: dict[str, Value] = {name: self.field.generator(name) for name in self.field.names}
        return WrittenReader(self.field, {**names, letter: VARIABLE}, Arithmetic(_LIMITS)).ratfunc(text)

    def polynomial(self, text: str, letter: str = "x") -> FunctionPoly:
        value = self.function(text, letter)
        return over_parameters(value.num // value.den)

    def statement(self, data: Mapping[str, Any]) -> Statement:
        """The statement that `statement_data` wrote.  Raises `InputError` for any other data."""
        kind = data.get("kind")
        match kind:
            case "zero":
                return Vanishes(self.polynomial(data["function"]))
            case "and" | "or":
                parts = tuple(map(self.statement, data["parts"]))
                return Both(parts) if kind == "and" else Either(parts)
            case "lattice":
                equation = self.field.poly([0, 1]) - self.polynomial(data["form"])
                return Congruence.make(equation, _numbers(data))
            case "integer root":
                equation = self.polynomial(data["equation"], data.get("unknown", "x"))
                return Congruence(equation, _numbers(data))
            case "natural number":
                letter = data.get("unknown", "x")
                texts = data["equations"]
                equations = texts and tuple(self.polynomial(text, letter) for text in texts)
                S = self.function(data["S"], data["variable"])
                return Natural(S, data["degree"], equations)
            case "schwarz":
                squares = self.polynomial(data["squares"], data.get("unknown", "x"))
                return Schwarz(squares, tuple(map(Structure, data["structures"])))
        raise InputError(f"{kind!r} isn't a kind of condition")

    def region(self, data: Mapping[str, Any]) -> ParameterRegion:
        return ParameterRegion(
            self.statement(data["statement"]),
            verdict_from(data["verdict"]),
            complete=data["complete"],
            defined=data["defined"],
            shown_degree=len(data["determinants"]) - 1 if "determinants" in data else None,
        )


def _numbers(data: Mapping[str, Any]) -> Classes:
    """The classes; without residues that of 0."""
    return Classes.of(data.get("residues", [0]), fraction(data["modulus"]))
