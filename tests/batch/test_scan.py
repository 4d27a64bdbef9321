"""Scans: grids are exact, the text of a point means what the text with the parameter meant, tables and maps are right."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import pytest
from build import RatFunc, function, parametrize, read_input, run
from hypothesis import given, settings
from hypothesis import strategies as st

from kovacic import InputError, LimitExceeded, NotRational, ParseError, solve_many
from kovacic.batch.records import LABELS, Record, label_of
from kovacic.batch.scan import Grid, Template, draw_map, grid_points, parse_grid, scan_items

fractions = st.fractions(min_value=-50, max_value=50, max_denominator=30)


class Ran(NamedTuple):
    status: int
    out: str
    err: str


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Callable[..., Ran]:
    return lambda *arguments: Ran(run(["scan", *arguments]), *capsys.readouterr())


def scan(expression: object, grids: list[Grid], **options: int) -> Iterator[Record]:
    return solve_many(scan_items(expression, grids), group=True, **options)


def values(text: str) -> list[Fraction]:
    return list(parse_grid(text))


def substitute(text: str, values: dict[str, Fraction]) -> str:
    return Template(text, list(values)).filled(values)


def test_grids() -> None:
    assert values("n=0:1:1/4") == [Fraction(k, 4) for k in range(5)]
    assert values("n=3") == [3]
    assert values("n=1:3") == [1, 2, 3]
    assert values("n=1:-1:-.5") == [1, Fraction(1, 2), 0, Fraction(-1, 2), -1]
    assert values("n=0:1:0.3") == [0, Fraction(3, 10), Fraction(6, 10), Fraction(9, 10)]
    assert values("n= 1 , -5/2") == [1, Fraction(-5, 2)]
    assert values("n=1e3,sqrt(4)") == [1000, 2]
    assert len(parse_grid("n=0:1:1/100000000")) == 10**8 + 1


@pytest.mark.long
def test_algebraic_values() -> None:
    assert values("n=sqrt(2),1/2, -I") == ["sqrt(2)", Fraction(1, 2), "-I"]
    grids = [parse_grid("n=sqrt(2),2^(1/3),3"), parse_grid("k=I-1,1/2")]
    records = list(scan("x^2 + n^2 + k - n^2", grids))
    assert [record.data["parameters"]["n"] for record in records[::2]] == ["sqrt(2)", "2^(1/3)", "3"]
    assert {record.data.get("case") for record in records} == {None}
    (odd,) = scan("x^2 + n^2 + 1", [parse_grid("n=sqrt(2)")])
    assert odd.data["case"] == 1
    for text in ("n=sqrt(2):3", "n=sqrt(k)", "n=x_", "n=sqrt(2),", "n=k"):
        with pytest.raises(InputError):
            parse_grid(text)


@pytest.mark.parametrize(
    "text",
    ["", "n", "n=", "=1", "2=1", "n=1:0", "n=0:1:0", "n=0:1:2:3", "n=1/0", "n=1e", "n=__import__('os')", "n=a:b"],
)
def test_what_is_no_grid_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        parse_grid(text)


def test_huge_grids_are_refused() -> None:
    with pytest.raises(LimitExceeded):
        parse_grid("n=0:1:1/100000000000000000000")
    with pytest.raises(LimitExceeded):
        parse_grid("n=1e999999999")


def test_the_last_parameter_changes_fastest() -> None:
    found = [(p["a"], p["b"]) for p in grid_points([parse_grid("a=0:1"), parse_grid("b=5,7")])]
    assert found == [(0, 5), (0, 7), (1, 5), (1, 7)]


X = function("x")
MEANT: dict[str, Callable[[Fraction], RatFunc]] = {
    "n*x^2+n^2": lambda n: X**2 * n + n**2,
    "(4*n^2-1)/(4*x^2)-1": lambda n: (4 * n**2 - 1) / (4 * X**2) - 1,
    "-n/x": lambda n: -n / X,
    "2n + 3": lambda n: X * 0 + (2 * n + 3),
    "x - n - n": lambda n: X - 2 * n,
    "(x+1)(n-x)^2": lambda n: (X + 1) * (X - n) ** 2,
    "n²*x": lambda n: X * n**2,
    "5-n^2*x": lambda n: 5 - X * n**2,
}


@settings(max_examples=20)
@given(fractions, st.sampled_from(sorted(MEANT)))
def test_the_text_of_a_point_means_what_the_parameter_meant(value: Fraction, text: str) -> None:
    assert function(substitute(text, {"n": value})) == MEANT[text](value)


def test_only_whole_names_are_parameters() -> None:
    assert substitute("n1*x + n + s_n", {"n": Fraction(2)}) == "n1*x + (2) + s_n"
    with pytest.raises(InputError, match="like a function"):
        substitute("n(x+1)", {"n": Fraction(2)})
    with pytest.raises(InputError, match="no parameter m"):
        substitute("n*x", {"m": Fraction(2)})
    with pytest.raises(ParseError):
        read_input(substitute("1/2n", {"n": Fraction(2)}))
    with pytest.raises(NotRational):
        read_input(substitute("x^n", {"n": Fraction(1, 3)}))


@pytest.mark.parametrize("ranges", [[], ["n=1", "n=2"], ["x=1", "n=1"]])
def test_parameters_must_differ(ranges: list[str]) -> None:
    with pytest.raises(InputError, match=r"needs a parameter|must be distinct|no parameter"):
        list(scan_items("n + t", [parse_grid(text) for text in ranges], var="x"))


@pytest.mark.long
def test_bessel_is_solvable_at_half_odd_integers() -> None:
    records = list(scan("(4*n^2-1)/(4*x^2)-1", [parse_grid("n=0:4:1/4")], jobs=1))
    for record in records:
        n = Fraction(record.data["parameters"]["n"])
        assert record.case == (1 if (n - Fraction(1, 2)).denominator == 1 else None)
        assert record.data["group"]["name"] == ("G_m" if record.case else "SL2")
        assert label_of(record.data) == record.label


@pytest.mark.long
def test_sympy_expressions_and_points_where_s_is_not_defined() -> None:
    import sympy

    x, n = sympy.symbols("x n")
    records = list(scan(x**2 + 1 / n, [parse_grid("n=-1:1")], jobs=1))
    assert [record.label for record in records] == ["case 1", "bad input", "case 1"]
    assert label_of(records[1].data) == "bad input"


@pytest.mark.long
def test_the_command_writes_csv(command: Callable[..., Ran]) -> None:
    ran = command("x^2 + n/m", "n=1:3", "m=0,1", "--format", "csv", "-j", "1", "-q")
    assert ran.status == 2
    rows = list(csv.DictReader(io.StringIO(ran.out)))
    assert [(row["n"], row["m"], row["status"], row["case"]) for row in rows] == [
        ("1", "0", "error", ""),
        ("1", "1", "liouvillian", "1"),
        ("2", "0", "error", ""),
        ("2", "1", "none", ""),
        ("3", "0", "error", ""),
        ("3", "1", "liouvillian", "1"),
    ]
    assert rows[1]["group"] == "Borel"
    assert "zero" in rows[0]["remark"]


@pytest.mark.long
def test_the_command_writes_jsonl_and_a_map_and_resumes(tmp_path: Path, command: Callable[..., Ran]) -> None:
    output, picture = tmp_path / "scan.jsonl", tmp_path / "map.png"
    arguments = ["-n^2 + m*x", "n=0:2", "m=0:3", "-o", str(output), "--map", str(picture), "-j", "1"]
    ran = command(*arguments)
    assert ran.status == 0, ran.err
    lines = output.read_bytes().splitlines(keepends=True)
    assert [json.loads(line)["parameters"] for line in lines][5] == {"n": "1", "m": "1"}
    whole_map = picture.read_bytes()
    assert whole_map.startswith(b"\x89PNG")
    output.write_bytes(b"".join(lines[:4]) + lines[4][:30])
    picture.unlink()
    assert command(*arguments).status == 2
    ran = command(*arguments, "--resume")
    assert ran.status == 0, ran.err
    assert [json.loads(line)["line"] for line in output.read_bytes().splitlines()] == list(range(1, 13))
    assert picture.read_bytes() == whole_map


@parametrize(
    "arguments",
    [
        ["x^2+n", "n=1", "--map", "map.png"],
        ["x^2+n", "n=1", "--resume"],
        ["x^2+n", "n"],
        ["x^2+n", "n=1", "--nonsense"],
        ["x^2+n"],
    ],
    ordinary=1,
)
def test_wrong_usage(arguments: list[str], command: Callable[..., Ran]) -> None:
    ran = command(*arguments)
    assert ran.status == 2
    assert "Traceback" not in ran.err


@pytest.mark.long
def test_every_label_has_a_colour(tmp_path: Path) -> None:
    labels = dict(enumerate(LABELS, start=1))
    draw_map("S", (parse_grid("a=0"), parse_grid(f"b=1:{len(labels)}")), labels, tmp_path / "map.png")


@pytest.mark.long
def test_maps_show_each_label_in_its_place(tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib.image")
    grids = (parse_grid("a=0:1"), parse_grid("b=0:2"))
    labels = {1: "case 1", 2: "case 2", 3: "none", 4: "none", 5: "bad input", 6: "case 1"}
    path = tmp_path / "map.png"
    draw_map("a*x + b", grids, labels, path)
    image = (matplotlib.imread(path)[..., :3] * 255).round().astype(int)
    found = {}
    for label, colour in (("case 1", (0, 114, 178)), ("case 2", (230, 159, 0)), ("bad input", (119, 119, 119))):
        rows, columns = ((image == colour).all(axis=2)).nonzero()
        inside = columns < 0.7 * image.shape[1]
        found[label] = (rows[inside], columns[inside])
    # The first parameter upwards, the second to the right: case 1 lies below on the left and above on the right.
    rows, columns = found["case 1"]
    middle_row, middle_column = (rows.min() + rows.max()) / 2, (columns.min() + columns.max()) / 2
    assert ((rows > middle_row) == (columns < middle_column)).all()
    assert (found["case 2"][0] > middle_row).all()
    assert (found["bad input"][0] < middle_row).mean() > 0.99  # a few pixels of the texts have this grey


def test_a_map_needs_values_in_order(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="in increasing or decreasing order"):
        draw_map("S", (parse_grid("a=1,3,2"), parse_grid("b=1")), {}, tmp_path / "map.png")


def test_labels_are_read_back() -> None:
    record = Record(1, "failed", 0.0, '{"schema": 1, "error": {"type": "ProcessLost"}, "status": "error"}')
    assert label_of(record.data) == record.label
