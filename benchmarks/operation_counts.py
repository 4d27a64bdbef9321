"""How much work equations take, published ones and some with many or irreducible poles: operations, the same on every machine.

    python benchmarks/operation_counts.py            compare with the recorded counts; exit status 1 if they differ
    python benchmarks/operation_counts.py --accept   record the counts of this version

The engine knows nothing of being counted: the functions below are wrapped from outside, wherever they have been imported.
One that has been renamed or moved stops this program, so that nothing is silently not counted.

    series_terms    terms of power series modulo primes: expansions at points, roots, and products
    exact_terms     terms of recurrences with exact coefficients
    primes          primes that were taken
    systems         sizes (rows x columns) of the linear systems, in the order in which they were solved
    verifications   forms and polynomials of omega checked, and pieces of evidence recomputed
    roots           degrees of the polynomials whose roots modulo a prime the kernel looked for
    factors         degrees over Q of the polynomials that were factored over number fields
"""

from __future__ import annotations

import argparse
import importlib
import json
import pkgutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields
from functools import wraps
from pathlib import Path
from typing import Any
from unittest import mock

import kovacic
from kovacic.algebra import splitting

CORPUS = Path(__file__).parent.parent / "tests" / "data" / "cases.jsonl"
RECORDED = Path(__file__).parent / "operation_counts.json"


@dataclass
class Counts:
    """The operations of one equation."""

    series_terms: int = 0
    exact_terms: int = 0
    primes: int = 0
    systems: list[str] = field(default_factory=list)
    verifications: int = 0
    roots: int = 0
    factors: int = 0


# Where the function lives, its name, and what a call adds to the counts: (counts, arguments by name or position).
Rule = Callable[[Counts, tuple[Any, ...], dict[str, Any]], None]


def _terms(position: int) -> Rule:
    def rule(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
        counts.series_terms += arguments[position] if len(arguments) > position else options["order"]

    return rule


def _system(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    counts.systems.append(f"{len(arguments[0])}x{arguments[1]}")


def _rank(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    columns, start, end = arguments
    counts.systems.append(f"{end - start}x{len(columns)}")


def _prime(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    counts.primes += 1


def _verification(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    counts.verifications += 1


def _roots(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    counts.roots += arguments[0].degree


def _factors(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    number_field, polynomial = arguments
    counts.factors += polynomial.degree * number_field.absolute_degree


def _exact_term(counts: Counts, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
    counts.exact_terms += 1


FUNCTIONS: dict[tuple[str, str], Rule] = {
    ("kovacic.algebra.modular", "fundamental_system"): _terms(2),
    ("kovacic.algebra.modular", "power_series"): _terms(1),
    ("kovacic.algebra.modular", "series_solution"): _terms(3),
    ("kovacic.algebra.modular", "square_root_series"): _terms(1),
    ("kovacic.algebra.modular", "null_space"): _system,
    ("kovacic.engine.expansion", "_unique_null_vector"): _system,
    ("kovacic.verify", "_invariant_holds"): _verification,
    ("kovacic.verify.primes", "homomorphisms_modulo"): _prime,
    ("kovacic.verify.primes", "roots_modulo"): _roots,
    ("kovacic.verify.series", "solutions_at_ordinary_point"): _terms(2),
    ("kovacic.verify.series", "product_of_powers"): _terms(1),
    ("kovacic.verify.series", "solution_at_singular_point"): _terms(3),
    ("kovacic.verify.series", "square_root_of_series"): _terms(2),
    ("kovacic.verify.series", "nullity"): _rank,
}
METHODS: dict[tuple[str, str, str], Rule] = {
    ("kovacic.algebra.extension", "AlgebraicField", "factor"): _factors,
    ("kovacic.algebra.recurrence", "RationalSeries", "extend"): _exact_term,
    ("kovacic.algebra.recurrence", "FieldSeries", "extend"): _exact_term,
    ("kovacic.engine.riccati", "Form", "numerators"): _verification,
    ("kovacic.verify.evidence", "Inspector", "holds"): _verification,
}
PRIMES = ("kovacic.algebra.lifting", "primes")


@contextmanager
def counting() -> Iterator[Counts]:
    """The counts of what is done within."""
    counts = Counts()

    def wrapped(function: Callable[..., Any], rule: Rule) -> Callable[..., Any]:
        @wraps(function)
        def counted(*arguments: Any, **options: Any) -> Any:
            rule(counts, arguments, options)
            return function(*arguments, **options)

        return counted

    def counted_primes(original: Callable[[], Iterator[int]]) -> Callable[[], Iterator[int]]:
        def primes() -> Iterator[int]:
            for p in original():
                counts.primes += 1
                yield p

        return primes

    patches = [
        mock.patch.object(_class(module, name), method, wrapped(getattr(_class(module, name), method), rule))
        for (module, name, method), rule in METHODS.items()
    ]
    for (module, name), rule in FUNCTIONS.items():
        patches += _everywhere(getattr(_module(module), name), lambda f, rule=rule: wrapped(f, rule))
    patches += _everywhere(getattr(_module(PRIMES[0]), PRIMES[1]), counted_primes)
    for patch in patches:
        patch.start()
    try:
        yield counts
    finally:
        for patch in patches:
            patch.stop()


def _module(name: str) -> Any:
    return importlib.import_module(name)


def _class(module: str, name: str) -> Any:
    return getattr(_module(module), name)


def _everywhere(function: Callable[..., Any], replacement: Callable[[Any], Any]) -> list[Any]:
    """Patches for every module of the engine that has imported the function."""
    new = replacement(function)
    return [
        mock.patch.object(module, name, new)
        for module in [module for key, module in sys.modules.items() if key.startswith("kovacic")]
        for name, value in list(vars(module).items())
        if value is function
    ]


def load_engine() -> None:
    """Import every module that takes part in a decision, so that all of them are patched."""
    for package in ("kovacic.algebra", "kovacic.engine", "kovacic.verify"):
        for found in pkgutil.iter_modules(_module(package).__path__, package + "."):
            _module(found.name)
    kovacic.solve("x^2 + 3")


#: Irreducible poles of high order and degree, and many poles; no published equation has them.
POLES = {
    "pole of order 4 and degree 20": "1/(x^20 - x - 1)^4",
    "pole of order 4 and degree 30": "1/(x^30 - x - 1)^4",
    "pole of order 4 and degree 12, the root of x^2": "x^2/(x^12 + x + 1)^4",
    "pole of order 4 and degree 9, a longer root": "(x^5 - 3*x + 2)^2/(x^9 - 4*x^6 + 2*x + 5)^4",
    "pole of order 6 and degree 8": "(x^2 + 1)/(x^8 + 3*x^5 - x + 7)^6",
    "double pole of degree 60": "2/(x^60 - 7*x^31 + 5*x^2 - 3*x + 11)^2",
    "double poles at 1, ..., 60": " + ".join(f"{k * (k + 1)}/(x - {k})^2" for k in range(1, 61)),
}


def corpus() -> dict[str, str]:
    """The published equations, and those of `POLES`: their names, and S."""
    published = {row["id"]: row["S"] for row in map(json.loads, CORPUS.read_text().splitlines())}
    return published | POLES


def measure() -> dict[str, dict[str, Any]]:
    """The counts of each published equation, each from empty memories, so that they don't depend on what ran before."""
    load_engine()
    found = {}
    for name, S in corpus().items():
        for remembered in (splitting._extended, splitting.splits_rarely):
            remembered.cache_clear()
        with counting() as counts:
            kovacic.solve(S)
        found[name] = asdict(counts)
    return found


def recorded() -> dict[str, dict[str, Any]]:
    """The counts that were accepted."""
    return json.loads(RECORDED.read_text())


def differences(old: dict[str, dict[str, Any]], new: dict[str, dict[str, Any]]) -> list[str]:
    """What has changed, one line for each count, the totals last."""
    lines = []
    for name in sorted(old.keys() | new.keys()):
        for key in (f.name for f in fields(Counts)):
            before, after = old.get(name, {}).get(key), new.get(name, {}).get(key)
            if before != after:
                lines.append(f"{name}: {key} {before} -> {after}")
    if lines:
        lines += [
            f"all: {key} {sum(c.get(key, 0) for c in old.values())} -> {sum(c.get(key, 0) for c in new.values())}"
            for key in (f.name for f in fields(Counts) if f.name != "systems")
        ]
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--accept", action="store_true", help="record the counts of this version")
    accept = parser.parse_args().accept
    new = measure()
    if accept:
        lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(counts)}" for name, counts in new.items())
        RECORDED.write_text("{\n" + lines + "\n}\n")
        print(f"{len(new)} equations recorded in {RECORDED.name}")
        return 0
    changes = differences(recorded(), new)
    print("\n".join(changes) or f"{len(new)} equations, the counts are those that were recorded")
    return 1 if changes else 0


if __name__ == "__main__":
    sys.exit(main())
