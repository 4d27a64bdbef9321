"""The pages of `docs/` show what really happens, their figures are those of their files, and their links lead somewhere."""

from __future__ import annotations

import json
import re
import runpy
from collections import Counter
from collections.abc import Iterator
from math import ceil
from pathlib import Path

import pytest
from build import parametrize
from documents import PAGES, ROOT, check_command, check_links, check_python, sessions

import kovacic

#: Modules that the scripts import.
BENCHMARK_PARTS = {"frame", "families", "stability_families", "textbook_equations", "dsolve_problems"}
SESSIONS = sessions(*PAGES)
each_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))


@parametrize(
    ("page", "command", "output"), SESSIONS, ordinary=2, long=9, ids=[f"{p}: {command}" for p, command, _ in SESSIONS]
)
def test_shell_sessions(page: str, command: str, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    check_command(command, output, capsys)


@parametrize(
    "page", sorted(PAGES, key=lambda page: page.name != "input.md"), ordinary=1, long=13, ids=lambda page: page.name
)
def test_python_sessions(page: Path) -> None:
    check_python(page)


@each_page
def test_links_lead_somewhere(page: Path) -> None:
    check_links(page)


@each_page
def test_a_guide_starts_with_something_that_runs(page: Path) -> None:
    first = re.search(r"^```(\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    if page.parent.name == "decisions":
        return
    if page.name not in ("gallery.md", "first-uses.md", "json.md", "batches.md"):
        assert first is not None
        assert first[1] in ("console", "python")


def test_the_reference_has_every_public_name() -> None:
    pages = (ROOT / "docs" / "reference" / name for name in ("api.md", "types.md"))
    reference = "".join(page.read_text(encoding="utf-8") for page in pages)
    assert set(re.findall(r"^\.\. auto\w+:: kovacic\.(\w+)(?:\(\))?$", reference, re.MULTILINE)) == set(kovacic.__all__)


def test_every_benchmark_is_listed_with_its_question() -> None:
    listed = (ROOT / "benchmarks" / "README.md").read_text(encoding="utf-8")
    scripts = [path for path in (ROOT / "benchmarks").glob("*.py") if path.stem not in BENCHMARK_PARTS]
    assert [path.name for path in scripts if f"`{path.name}`" not in listed] == []


def test_the_comparison_has_the_figures_of_its_file() -> None:
    """Each row of the table, counted anew from the benchmark's results."""
    rows = json.loads((ROOT / "benchmarks" / "results" / "peers.json").read_text(encoding="utf-8"))["rows"]
    solvable = {(r["corpus"], r["name"]) for r in rows if r["system"] == "kovacic" and r["outcome"] == "solved"}
    names = ["kovacic", "Maxima kovacicODE", "FriCAS solve", "giac kovacicsols", "SymPy dsolve", "SymPy solve_riccati"]
    expected = []
    for name in names:
        mine = [r for r in rows if r["system"] == name and (r["corpus"], r["name"]) in solvable]
        solved = [r["check"] for r in mine if r["outcome"] == "solved"]
        wrong_none = sum(r["outcome"] == "none" and r["check"] == "wrong" for r in mine)
        right, wrong = solved.count("right"), solved.count("wrong")
        unclear = len(solved) - right - wrong
        expected.append([right, unclear, wrong, wrong_none, len(mine) - len(solved) - wrong_none])
    table = re.findall(r"^\|.*?((?: \d+ \|){5})$", (ROOT / "docs" / "comparison.md").read_text("utf-8"), re.MULTILINE)
    assert [list(map(int, re.findall(r"\d+", row))) for row in table] == expected


def test_the_times_of_the_engine_are_those_of_its_results() -> None:
    """Times for 100 and 400 poles, the exponents, and the longest verification against its decision."""
    results = (ROOT / "benchmarks" / "results" / "engine.md").read_text("utf-8")
    page = " ".join((ROOT / "docs" / "comparison.md").read_text("utf-8").split())

    def table(title: str) -> list[list[str]]:
        lines = results.partition(f"\n## {title} (")[2].partition("\n## ")[0].splitlines()[4:]
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]

    poles = table("By poles")
    seconds = {place: max(float(row[place].split()[0]) for row in poles) for place in (6, 8)}
    assert f"poles take at most {seconds[6]:.1f} s, 400 at most {seconds[8]:.1f} s" in page
    assert f"exponent is at most {max(float(row[-1]) for row in poles)} in these families" in page
    (near,) = table("By poles, all rational and close together")
    assert f"exponent is {near[-1]} from 100 to 1,600 poles, {float(near[-2].split()[0]):.0f} s for these" in page
    largest = re.search(r"\| (\d+) \| exponent", results.partition("\n## By degree of P (")[2])
    assert largest is not None
    assert largest[1] == "20000"
    digits = [row[3] for row in table("By digits of the parameters, up to coefficients of 10^5 digits")]
    assert max(int(re.findall(r"\((\d+)\)", cell)[0]) for cell in digits) >= 100_000
    assert "degrees of P to 20,000 and coefficients of 100,000 digits" in page
    times = [re.findall(r"[\d.]+", cell) for row in poles for cell in row[5:9]]
    ratio = max(float(verification) / float(decision) for _, decision, verification, _ in times)
    assert 7.5 < ratio < 8.5, "up to eight times, says docs/decisions/two-kernels.md"


def cells(results: str, row: str) -> list[str]:
    """The cells of the row with this title in a file of results; the title is its first cell, or several."""
    text = (ROOT / "benchmarks" / "results" / results).read_text("utf-8")
    (line,) = [line for line in text.splitlines() if line.startswith(f"| {row} |")]
    return [cell.strip() for cell in line.strip("|").split("|")]


def sentences_with_figures() -> Iterator[tuple[str, str]]:
    """A page, and the words that it must have for the results beside it."""
    block = cells("precision.md", "a block with another precision")[1]
    product = cells("precision.md", "z z, 100 bits")[1]
    yield "decisions/precision.md", f"takes {block} µs, a multiplication of balls of 100 bits {product}"
    values = (ROOT / "benchmarks" / "results" / "precision.md").read_text("utf-8").partition("part of the blocks |")[2]
    found = re.findall(r"\| (\d+) \| [\d.]+ \| ([\d.]+) % \|", values)
    blocks, parts = [int(b) for b, _ in found], [float(part) for _, part in found]
    yield "decisions/precision.md", f"{min(blocks)} to {max(blocks)} blocks, together {max(parts)} % of its time"
    hermite = cells("doubles_speed.md", "Hermite 50")
    ours, sympys = hermite[2].split(" / ")[0], hermite[9].split(" / ")[0]
    yield "decisions/tables-and-products.md", f"by {sympys} units in the last place (median), the product by {ours}"
    table = cells("doubles_stability.md", "large degree | N = 2 R/R1 = 200 | TabulatedFunction")
    yield "decisions/tables-and-products.md", f"a table is wrong by {table[3].split(' / ')[0]} units"
    arb = (ROOT / "benchmarks" / "results" / "enclosure_work_precision.md").read_text("utf-8")
    ratios = re.findall(r"\| (\d+) \| [^|]+ \| [^|]+ \| [^|]+ \| ([\d.]+) \|$", arb.partition("## The ball's")[0], re.M)
    few, thousand, most = (
        ceil(max(float(ratio) for digits, ratio in ratios if digits in chosen))
        for chosen in (("15", "50"), ("1000",), ("10000",))
    )
    assert (thousand, most) == (3, 2)
    yield (
        "comparison.md",
        f"takes at most {few} times the processor time of Arb's own functions at 15 and 50 digits, 3 times",
    )
    peers = cells("peers.md", "giac kovacicsols: one solution in closed form")
    verdicts = cells("peers.md", "giac kovacicsols: the verdict")
    yield "comparison.md", f"on {peers[5]} of the {peers[1]} equations for which it returns one solution"
    yield "comparison.md", f"than the verdict on {verdicts[5]} of {verdicts[1]}"
    yield "comparison.md", f"The median over 176 published equations is {cells('engine.md', 'solve, verified')[1]} ms"
    for name, row in {
        "Maxima": "Maxima kovacicODE: the verdict",
        "FriCAS": "FriCAS solve: the verdict",
        "giac": "giac kovacicsols: the verdict",
        "SymPy `dsolve`": "SymPy dsolve: the verdict",
        "SymPy `solve_riccati`": "SymPy solve_riccati: the verdict",
    }.items():
        yield "comparison.md", "| " + " | ".join([name, *cells("peers.md", row)[1:4]]) + " |"
    rows = json.loads((ROOT / "benchmarks" / "results" / "peers.json").read_text(encoding="utf-8"))["rows"]
    names = [(r["corpus"], r["name"]) for r in rows if r["system"] == "kovacic" and r["outcome"] == "solved"]
    rest = [r for r in rows if (r["corpus"], r["name"]) not in names]
    nones = Counter(r["system"] for r in rest if r["outcome"] == "none")
    maxima, fricas, giac = (nones[name] for name in ("Maxima kovacicODE", "FriCAS solve", "giac kovacicsols"))
    said = f"Maxima says it for {maxima}, FriCAS for {fricas}, giac for {giac}"
    yield "comparison.md", f'kovacic proves "none" for all, {said}'
    special = sum(r["system"] == "SymPy dsolve" and r["check"] == "right" for r in rest)
    yield "comparison.md", f"SymPy's `dsolve` solves {special} of them by special functions"
    yield "coming-from-dsolve.md", f"SymPy also solves {special} of {nones['kovacic']} equations without"
    right = sum(r["system"] == "SymPy dsolve" and r["check"] == "right" for r in rows) - special
    yield "coming-from-dsolve.md", f"`sympy.dsolve` 1.14 solves {right} and gives no wrong answer"
    poles = (ROOT / "benchmarks" / "results" / "engine.md").read_text("utf-8").partition("## By poles (")[2]
    rows = [line.split(" | ") for line in poles.partition("\n## ")[0].splitlines()[4:] if line.startswith("|")]
    hundred, two_hundred = ([float(row[place].split()[0]) for row in rows] for place in (6, 7))
    page = "decisions/invariants-not-families.md"
    yield page, f"100 poles take {min(hundred):.2f} to {max(hundred):.1f} s, 200 poles {min(two_hundred):.2f} to"
    batch = (ROOT / "benchmarks" / "results" / "batch.md").read_text("utf-8")
    (minutes,) = re.findall(r"at this rate 100,000 take ([\d.]+) min by the clock", batch)
    assert 6 < float(minutes) < 7
    yield "comparison.md", "100,000 mixed equations take less than seven minutes on two cores"
    yield "howto/batches.md", "100,000 mixed equations take less than seven minutes on two cores"
    faults = (ROOT / "benchmarks" / "results" / "wrong_answers.md").read_text("utf-8")
    apart = re.findall(r"^\| (?:algebra/, not imported by the kernel|engine/|galois/) \|.*\| (\d+) \|$", faults, re.M)
    yield "decisions/two-kernels.md", f"of 120 in the rooms that the kernel doesn't import {sum(map(int, apart))} gave"


def test_figures_are_those_of_the_results() -> None:
    for page, words in sentences_with_figures():
        assert words in " ".join((ROOT / "docs" / page).read_text("utf-8").split())


TABLES = runpy.run_path(str(ROOT / "docs" / "tables.py"))


def verdicts(results: str, system: str) -> Counter[str]:
    return Counter(problem["answers"][system]["verdict"] for problem in TABLES["problems"](results))


def rows(page: str, section: str) -> dict[str, list[int]]:
    """The rows of figures of a section of a page, by their titles."""
    text = (ROOT / "docs" / page).read_text("utf-8").partition(f"\n## {section}\n")[2].partition("\n## ")[0]
    found = re.findall(r"^\| ([^|]+) \|((?: \d+ \|)+)$", text, re.MULTILINE)
    return {title: list(map(int, re.findall(r"\d+", figures))) for title, figures in found}


def test_the_textbook_problems_have_the_figures_of_their_file() -> None:
    systems = ("kovacic.dsolve", "sympy.dsolve", "Maxima ode2, contrib_ode")
    counts = [verdicts("dsolve", system) for system in systems]
    shown = rows("coming-from-dsolve.md", "SymPy's own test equations")
    for title, key in (
        ("right", "right"),
        ("right, with an integral left", "right with integrals"),
        ("wrong", "wrong"),
    ):
        assert shown[title] == [count[key] for count in counts]
    rest = ("right", "right with integrals", "wrong")
    assert shown["can't be checked, not solved, no answer in time"] == [
        count.total() - sum(count[key] for key in rest) for count in counts
    ]
    page = " ".join((ROOT / "docs" / "comparison.md").read_text("utf-8").split())
    right, sympys = counts[0]["right"], counts[1]["right"]
    assert f"{right} come out right and one with an integral left, SymPy's `dsolve` has {sympys}" in page
    assert counts[0]["right with integrals"] == 1


def test_every_test_equation_of_sympy_is_shown_with_both_answers() -> None:
    page = TABLES["filled"]((ROOT / "docs" / "coming-from-dsolve.md").read_text("utf-8"))
    problems = TABLES["problems"]("dsolve_sympy")
    for problem in problems:
        assert page.count(f"| `{problem['equation']}` | ") == 1
        for system in ("kovacic.dsolve", "sympy.dsolve"):
            assert problem["answers"][system].get("answer", "") in page
    counts = [verdicts("dsolve_sympy", system) for system in ("kovacic.dsolve", "sympy.dsolve")]
    shown = rows("coming-from-dsolve.md", "All of SymPy's test equations")
    titles = {"not a general solution": "wrong"}
    assert shown == {title: [count[titles.get(title, title)] for count in counts] for title in shown}
    assert [sum(column) for column in zip(*shown.values(), strict=True)] == [len(problems)] * 2
    assert f"have {len(problems)} equations" in page
    assert page.count("not a general solution, 4 constants: ") == 1
