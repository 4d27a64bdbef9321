"""The work of values and their radii, by every way: a slower way, or a blunter one, is noticed on any machine.

That the balls contain the values is for the other tests.
"""

from __future__ import annotations

from typing import Any

import pytest
from work import check_work

import kovacic


def start(x0: object, y0: object, dy0: object, **options: Any) -> dict[str, Any]:
    return {"x0": x0, "y0": y0, "dy0": dy0, **options}


def frobenius(x0: object, first: object, second: object, **options: Any) -> dict[str, Any]:
    return {"x0": x0, "frobenius": (first, second), **options}


# Their constants are in no other test, since what was found about polynomials is kept.
VALUES = [
    ("x^2 + 3/7", "13/8", start(0, 1, "1/3", digits=30, method="taylor"), 21, ["3.33850933463883 ± 4.0e-44"]),
    ("x^3 - 5*x + 3/7", "9/2", start("-3/2", 1, "1/3", digits=30, method="taylor"), 57, ["-320955.34051589 ± 2.8e-39"]),
    ("-x - 3/7", "33/2", start("-3/2", 1, "1/3", digits=18, method="taylor"), 75, ["-0.213432484874053 ± 1.2e-28"]),
    (
        "-3/(16*x^2) + 5/(7*x - 21)",
        ["3/2", "5/2"],
        start(1, "2/5", "1/3", digits=20, method="taylor"),
        59,
        ["0.536632364121226 ± 6.6e-34", "0.540105324797213 ± 3.0e-33"],
    ),
    (
        "x^2 + 2/7",
        "-3/2",
        start(1, "2/5", "1/3", path=[(1 + 2j)], digits=20, method="taylor"),
        46,
        ["0.0761895988563367+1.26204127651099e-39j ± 1.1e-31"],
    ),
    (
        "(x + 2*I)/(x^2 + 17/13)",
        [-1.5, (0.25 + 2j)],
        start(2, "2/5", 0.25j, digits=20, method="taylor"),
        1742,
        ["0.416318454414591+2.5022725075872j ± 4.0e-36", "-0.773934004667599-0.727757448456833j ± 2.5e-37"],
    ),
    (
        "(x^2 + 13/29)*y'' + 3*x*y' + 5/7*y = 0",
        ["5/2", "-3/2"],
        start("1/3", "2/5", "1/3", derivative=True, digits=20, method="taylor"),
        99,
        [
            "0.371514018243672 ± 3.1e-33",
            "-0.0515007878634212 ± 4.1e-33",
            "-0.176307240354981 ± 5.0e-33",
            "0.0195720191826764 ± 8.5e-33",
        ],
    ),
    (
        "(x - 2/29)^2*y'' + (x - 2/29)*y' + (x^2 - 4/81)*y = 0",
        ["1/2", "7/2"],
        frobenius("2/29", "2/5", "1/3", digits=20, method="taylor"),
        141,
        ["0.660349043352872 ± 1.2e-35", "-0.265837488053117 ± 6.9e-33"],
    ),
    (
        "(x - 3/29)^2*y'' + (x - 3/29)*y' + (x^2 - 13465/841)*y = 0",
        ["1/2", "7/2"],
        frobenius("3/29", 2, 3, digits=20, method="taylor"),
        157,
        ["82.9919738683056 ± 1.9e-37", "199.688596214004 ± 7.3e-29"],
    ),
    (
        "(x - 5/29)*y'' + y' + (x + 1/5)*y = 0",
        ["1/2", "7/2"],
        frobenius("5/29", 2, 3, digits=20, method="taylor"),
        125,
        ["1.16849319417329 ± 2.5e-37", "-1.05432896906528 ± 4.2e-32"],
    ),
    (
        "(x - 7/29)^2*y'' + (x - 7/29)*y' + (x + 49/16)*y = 0",
        ["1/2", "-7/2"],
        frobenius("7/29", 2, 3, digits=20, method="taylor"),
        156,
        ["-3.59671701908391-0.669131890163578j ± 3.0e-37", "145.197525048969-881.830561839591j ± 1.7e-36"],
    ),
    (
        "-2/(9*x^2) + 3/(x^3*(x - 17/11))",
        ["5/2", "17/2"],
        frobenius("oo", 2, 3, digits=20, method="taylor"),
        196,
        ["9.17835863818238 ± 1.3e-31", "14.6250992431786 ± 2.2e-38"],
    ),
    (
        "(x - 11/29)*y'' + 3*y' + (x + 2/5)*y = 0",
        "11/29",
        frobenius("11/29", 0, 3, derivative=True, digits=20, method="taylor"),
        87,
        ["3 ± 0", "-0.779310344827586 ± 7.4e-40"],
    ),
    ("x + 3/7", "13/8", start(0, 1, "1/3", digits=1000, method="taylor"), 644, ["3.52157474536921 ± 1.9e-1018"]),
    (
        "x + 4/7",
        "1.6180339887498948482045868343656381177203",
        start(0, 1, "1/3", digits=1200, method="taylor"),
        1471,
        ["3.83431191846485 ± 1.6e-1218"],
    ),
    (
        "x + 5/7",
        (0.5 + 0.25j),
        start(0, 1, "1/3", digits=1600, method="taylor"),
        775,
        ["1.23754066748075+0.213772633720235j ± 4.4e-1619"],
    ),
    (
        "1/(x^2 + 31/23)",
        "11/8",
        start(0, 1, "1/3", digits=2600, method="taylor"),
        9316,
        ["2.18619784686705 ± 1.6e-2618"],
    ),
    (
        "-(x^2 + 3)/(x^2 + 15/19)",
        20000,
        start(2, 1, "1/3", digits=20, method="taylor"),
        133,
        ["0.477384550108038 ± 6.6e-33"],
    ),
    ("-x - 2/5", 300000, start(2, 1, "1/3", digits=20, method="taylor"), 84, ["0.0501420965010327 ± 3.7e-29"]),
    (
        "(1 - x)/(x^2 + 21/17)",
        ["-300", 30000],
        start(2, 1, "1/3", digits=15, method="taylor"),
        207,
        ["-212360787481922 ± 3.7e-12", "-10.2920431401043 ± 8.1e-22"],
    ),
    ("3/5*x^3 - x", -100, start(-2, 1, "1/3", digits=15, method="taylor"), 117, ["0.0191474836605289 ± 8.1e-30"]),
    (
        "y'' + sin(3*x)*y' + (2 - exp(x/5))*y = cos(x)",
        "1/2",
        start("1/3", 1, "1/3", digits=15),
        1166,
        ["1.0513922975554 ± 8.3e-34"],
    ),
    (
        "y'' + sqrt(x)*y' + (2 - exp(x/5))*y = log(x)",
        "3/2",
        start("2/3", 1, "1/3", digits=15),
        895,
        ["0.960625753708546 ± 1.3e-34"],
    ),
    (
        "(2 + cos(x))*y'' + y' + x^2*y = 0",
        ["1/2", "5/2"],
        start("2/3", 1, "1/3", digits=15),
        1471,
        ["0.940912915255122 ± 4.5e-34", "0.235040459886276 ± 5.1e-34"],
    ),
    (
        "y'' + sin(x)/x*y = (exp(2*x) - 1)/x",
        "1/2",
        start(-1, 1, "1/3", digits=15),
        1743,
        ["1.76736045206336 ± 3.0e-34"],
    ),
    ("y'' + (3 + cos(2*x))*y = 0", 50, start(-1, 1, "1/3", digits=15), 1743, ["0.606291911920485 ± 1.3e-34"]),
    ("y'' + x*y' + y = 3*x^2 - 1/(x + 4)", "5/2", start(-1, 1, "1/3", digits=15), 681, ["4.2353822621158 ± 1.2e-33"]),
    (
        "x^2 + a",
        "13/8",
        start(0, 1, "1/3", params={"a": "sqrt(2)"}, digits=30, method="taylor"),
        450,
        ["6.10259656552306 ± 9.4e-49"],
    ),
    ("x^2 + 5", "13/8", start("1/3", 1, "1/3", digits=30, method="closed form"), 52, ["12.8975658771966 ± 6.6e-50"]),
    ("x^2 + 3/8", "13/8", start("1/3", 1, "1/3", digits=30), 56, ["2.66709121610274 ± 3.3e-44"]),
    (
        "(x^2 + 17/29)*y'' + 3*x*y' + 3/4*y = 0",
        "13/8",
        start("1/3", 1, "1/3", digits=30),
        100,
        ["0.8884773669052 ± 1.6e-42"],
    ),
    (
        "x + 11/3",
        ["1", "13/2"],
        {"x0": 2, "which": "decaying", "y0": 3, "digits": 20},
        251,
        ["30.4768523282596 ± 1.7e-37", "8.6193488936494e-06 ± 4.1e-33"],
    ),
    ("x - 5/3", "31/2", start(2, 3, "-1/2", digits=20), 53, ["429126474869219 ± 1.6e-24"]),
    (
        "(x + 1/29)^2*y'' + (x + 1/29)*y' + ((x + 1/29)^2 - 25/49)*y = 0",
        "71/2",
        start(2, 3, "-1/2", digits=20, method="closed form"),
        77,
        ["-0.254926546056377 ± 2.3e-26"],
    ),
    (
        "x*(31/29 - x)*y'' + (3/2 - 2*x)*y' - 5/7*y = 0",
        "6/7",
        start("1/5", 3, "-1/2", digits=20, method="closed form"),
        87,
        ["4.29823288678785 ± 6.1e-39"],
    ),
]


@pytest.fixture(scope="module", autouse=True)
def _imaginary_unit_is_known() -> None:
    kovacic.evaluate("x + 3*I", 2, x0=0, y0=3, dy0=1, digits=20, method="taylor")


@pytest.mark.parametrize(("equation", "x", "options", "looks", "balls"), VALUES, ids=[str(row[:2]) for row in VALUES])
def test_the_work_of_values(equation: str, x: Any, options: dict[str, Any], looks: int, balls: list[str]) -> None:
    check_work(lambda: kovacic.evaluate(equation, x, **options), looks, balls)
