"""What a user writes, for the type checker: `mypy --strict` accepts it, and each `assert_type` holds."""

from __future__ import annotations

from typing import assert_type

import kovacic
from kovacic import Ball, InputError, Limits, Solution, Status


def verdict(text: str) -> str:
    """The case, or why there is none."""
    try:
        answer = kovacic.solve(text, limits=Limits(seconds=10))
    except InputError as error:
        return str(error)
    assert_type(answer, Solution)
    assert_type(answer.status, Status)
    assert_type(answer.case, int | None)
    assert_type(answer.reason, str | None)
    assert_type(answer.verified, bool)
    if answer.omega is not None:
        assert_type(answer.omega.num.degree, int)
    group = answer.group
    if group is not None:
        assert_type(group.order, int | None)
    assert_type(answer.explain(format="html"), str)
    assert_type(answer.to_json(), str)
    assert_type(Solution.from_json(answer.to_json()), Solution)
    assert_type(bool(answer.verify()), bool)
    return "none" if answer.status is Status.NONE_EXISTS else f"case {answer.case}"


def many(texts: list[str]) -> dict[int, str]:
    """The outcomes by line."""
    return {record.number: record.label for record in kovacic.solve_many(texts)}


def values(answer: Solution) -> None:
    """Numbers and pictures; what is ignored here is what the type checker has to refuse."""
    assert_type(answer.at(1, x0=0, y0=1, dy0=0, digits=30), Ball)
    assert_type(answer.at("1/3", x0=0, which="regular", derivative=True), tuple[Ball, Ball])
    assert_type(answer.at([1, 2], x0=0, frobenius=(1, 0)), tuple[Ball, ...])
    answer.at(1, x0=0, y0=1, dy0=0, digts=30)  # type: ignore[call-overload]
    answer.lambdify(interval=(0, 1), which=1, careful=True)
    answer.lambdify(interval=(0, 1), x0=0, y0=1, dy0=0, path="above")
    answer.lambdify(interval=(0, 1), chek=False)  # type: ignore[call-arg]
    answer.lambdify(which=1)  # type: ignore[call-arg]
    answer.plot(0, 1, x0=0, y0=1, dy0=0, points=100, title="y")
    answer.plot(0, 1, digts=30)  # type: ignore[call-arg]
    assert_type(kovacic.evaluate("a*b", 1, x0=0, y0=1, dy0=0, var="b", params={"a": 1}), Ball)
    kovacic.tabulate("x", 0, 1, x0=0, y0=1, dy0=0, var="x", careful=False)
    kovacic.tabulate("x", 0, 1, x0=0, digts=30)  # type: ignore[call-arg]
    kovacic.monodromy("1/x^2", digts=30)  # type: ignore[call-arg]
    answer.to_json(ful=True)  # type: ignore[call-arg]
