"""Where the time goes: the share of every stage of a decision, and of a full answer with closed forms.

    python benchmarks/profile_stages.py            # a few seconds; writes benchmarks/results/profile.json and profile.md
    python benchmarks/profile_stages.py --quick    # a small part of the corpora, nothing written

The functions at which a stage begins are wrapped by a clock of processor time, and what a stage spends in another one is
counted there alone.  The wrappers cost about a microsecond a call, which is why only a few functions have one.  Every
equation is solved once beforehand, and SymPy's cache is cleared before each closed form.
"""

from __future__ import annotations

import argparse
import functools
import importlib
import json
import platform
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import closed_forms
import families
from sympy.core.cache import clear_cache

import kovacic

HERE = Path(__file__).resolve().parent
CASES = HERE.parent / "tests" / "data" / "engine.jsonl"
REST = "the rest (solve itself)"
SIZES = (5, 10, 20, 40, 80)

#: Stage: functions and methods, as "module:name"; the first stages are those of the decision.
STAGES = {
    "reading the text": ("reading.read:read_input",),
    "places and local data": ("engine.places:analyse", "engine.necessary:excluded_by_local_data"),
    "degree bounds, squares of exponents": (
        "engine.degree_bound:degree_bound",
        "engine.degree_bound:irrational_exponents",
    ),
    "series modulo primes": (
        "algebra.modular:fundamental_system",
        "algebra.modular:power_series",
        "algebra.modular:series_solution",
        "engine.invariants:invariants_modulo",
        "engine.local:chart",
        "engine.local:exponential_parts",
    ),
    "linear algebra and Euclid modulo primes": (
        "algebra.modular:null_space",
        "algebra.modular:echelon_by_degree",
        "engine.local:rational_omega",
        "engine.local:omega_parts",
        "engine.invariants:_closes",
        "engine.reducible:_first_factor",
    ),
    "lifting": ("algebra.lifting:Lifter.add",),
    "recurrences": ("algebra.recurrence:polynomial_solution", "engine.expansion:polynomial_invariant"),
    "the cases, their algebra": ("engine.decide:decide",),
    "exact check of forms, polynomial of omega": ("engine.riccati:Form.numerators",),
    "certificate": ("engine.decide:_positive",),
    "verification": ("verify:verify",),
}
CLOSED = {
    "structure: integrals, products": ("closed_form.structure:build",),
    "expressions (SymPy)": ("closed_form.display:expressions",),
    "exact check": ("closed_form.check:is_exact_solution",),
    "numerical check": ("closed_form.check:is_numerical_solution",),
}
CLOSED_REST = "the rest of the closed form"


class Clock:
    """Processor time by stage; the innermost running stage gets it."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._running: list[str] = []
        self._since = 0.0

    def _switch(self) -> None:
        now = time.process_time()
        if self._running:
            self.seconds[self._running[-1]] += now - self._since
        self._since = now

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        self._switch()
        self._running.append(name)
        try:
            yield
        finally:
            self._switch()
            self._running.pop()

    def wrapped(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def run(*arguments: Any, **options: Any) -> Any:
            self._switch()
            self._running.append(name)
            try:
                return function(*arguments, **options)
            finally:
                self._switch()
                self._running.pop()

        return run

    def install(self, stages: dict[str, tuple[str, ...]]) -> None:
        """Wrap the functions in every module that has imported them."""
        for stage, places in stages.items():
            for place in places:
                module, _, name = place.partition(":")
                owner: Any = importlib.import_module(f"kovacic.{module}")
                *classes, attribute = name.split(".")
                for part in classes:
                    owner = getattr(owner, part)
                original = getattr(owner, attribute)
                replacement = self.wrapped(stage, original)
                setattr(owner, attribute, replacement)
                for other in [m for key, m in sys.modules.items() if key.startswith("kovacic")]:
                    for key in [key for key, value in vars(other).items() if value is original]:
                        setattr(other, key, replacement)


def corpora(quick: bool) -> dict[str, list[str]]:
    """The texts of S, or equations, by corpus."""
    published = [row["S"] for row in map(json.loads, CASES.read_text(encoding="utf-8").splitlines())]
    found = {"published": published, "textbook": list(closed_forms.TEXTBOOK)}
    for n in SIZES[:2] if quick else SIZES:
        found[f"generated, {n} poles"] = [families.by_size(family, n).S.to_str("x") for family in families.FAMILIES]
    return {name: texts[::8] for name, texts in found.items()} if quick else found


def measure(clock: Clock, texts: list[str], closed: bool, runs: int) -> dict[str, float]:
    """Milliseconds an equation, by stage."""
    answers = [kovacic.solve(text) for text in texts]
    if closed:
        for answer in answers:
            _ = answer.closed_form
    clock.seconds.clear()
    for _ in range(runs):
        for text in texts:
            if closed:
                answer = kovacic.solve(text)
                clear_cache()
                clock.seconds["-"] += 0.0
                with clock.stage(CLOSED_REST):
                    _ = answer.closed_form
            else:
                with clock.stage(REST):
                    kovacic.solve(text)
    wanted = [*CLOSED, CLOSED_REST] if closed else [*STAGES, REST]
    return {stage: 1e3 * clock.seconds[stage] / runs / len(texts) for stage in wanted}


def table(title: str, results: dict[str, dict[str, float]], stages: list[str]) -> list[str]:
    """Shares in per cent, and the mean total in milliseconds."""
    lines = [f"## {title}", "", "| | " + " | ".join(results) + " |", "|---|" + "---:|" * len(results)]
    for stage in stages:
        shares = (100 * row[stage] / sum(row.values()) for row in results.values())
        lines.append(f"| {stage} | " + " | ".join(f"{share:.0f} %" for share in shares) + " |")
    lines.append(
        "| **mean, ms an equation** | " + " | ".join(f"{sum(r.values()):.2f}" for r in results.values()) + " |"
    )
    return [*lines, ""]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a small part, nothing written")
    options = parser.parse_args()
    texts = corpora(options.quick)
    _ = kovacic.solve("x^2 + 3").closed_form
    clock = Clock()
    clock.install(STAGES)
    decisions = {name: measure(clock, own, False, 3) for name, own in texts.items()}
    forms = Clock()
    forms.install(CLOSED)
    solvable = {
        name: [t for t in own if kovacic.decide(t).case is not None] for name, own in texts.items() if "80" not in name
    }
    answers = {name: measure(forms, own, True, 1) for name, own in solvable.items()}
    about = (
        f"kovacic {kovacic.__version__}, python {platform.python_version()}, {platform.system()} {platform.machine()}."
    )
    lines = [
        "# Where the time goes",
        "",
        "Written by `python benchmarks/profile_stages.py`; see there for what is measured.",
        "",
        about,
        "",
        *table("From the text to the verified answer", decisions, [*STAGES, REST]),
        *table("Closed forms of the solvable ones, after that", answers, [*CLOSED, CLOSED_REST]),
    ]
    print("\n".join(lines))
    if not options.quick:
        results = HERE / "results"
        (results / "profile.md").write_text("\n".join(lines), encoding="utf-8")
        data = {"machine": about, "milliseconds": {"decision": decisions, "closed form": answers}}
        (results / "profile.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
