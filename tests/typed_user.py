"""What a user writes, for the type checker: `mypy --strict` accepts it, and each `assert_type` holds."""

from __future__ import annotations

from typing import assert_type

import kovacic
from kovacic import InputError, Limits, Solution, Status


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
