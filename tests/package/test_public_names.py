"""`kovacic/__init__.py` names what is public, once; the stub beside it tells type checkers the same."""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path
from typing import Any

import pytest

import kovacic
import kovacic.ball
from kovacic import galois

STUB = Path(kovacic.__file__).with_suffix(".pyi")


def stub() -> str:
    """What the stub has to say.  To write it: python tests/package/test_public_names.py."""
    names = sorted(kovacic._MODULES.items(), key=lambda item: (item[1], item[0]))
    imports = [f"from {module} import {name} as {name}" for name, module in names]
    return "\n".join(["# Written by tests/package/test_public_names.py.", *imports, "", "__version__: str", ""])


def test_type_checkers_see_the_public_names() -> None:
    assert STUB.read_text(encoding="utf-8") == stub(), "run python tests/package/test_public_names.py"


def test_dir_shows_the_public_names_only() -> None:
    assert dir(kovacic) == sorted([*kovacic.__all__, "__version__"])
    assert len(set(kovacic.__all__)) == sum(map(len, kovacic._PUBLIC_NAMES.values()))


@pytest.mark.parametrize(
    ("module", "former", "now"),
    [
        (kovacic.ball, "Ball", "RollingBall"),
        (kovacic.ball, "ClosedForm", "BallSolution"),
        (galois, "Kind", "GroupKind"),
    ],
)
def test_former_names_are_there_with_a_warning(module: Any, former: str, now: str) -> None:
    with pytest.warns(DeprecationWarning, match=f"{former} is called {now} now"):
        assert getattr(module, former) is getattr(module, now)
    with pytest.raises(AttributeError):
        module.SomethingElse  # noqa: B018


def test_a_class_is_known_by_its_name_alone() -> None:
    """No two classes of one name.  The kernel and the checker say again what they check, in words of their own."""
    package = Path(kovacic.__file__).parent
    homes = defaultdict(list)
    for path in package.rglob("*.py"):
        home = path.relative_to(package).parts[0]
        if home in ("verify", "checker.py"):
            continue
        for name in re.findall(r"^ *class (\w+)[(:]", path.read_text(encoding="utf-8"), re.MULTILINE):
            homes[name].append(path.name)
    assert not {name: found for name, found in homes.items() if len(found) > 1}


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
