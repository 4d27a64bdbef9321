"""The work of values and their radii, by every way: a slower way, or a blunter one, is noticed on any machine.

That the balls contain the values is for the other tests.
"""

from __future__ import annotations

from math import cos, pi
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
    ("x^2 + 3/7", "13/8", start(0, 1, "1/3", digits=30, method="taylor"), 35, ["3.33850933463883 ± 4.0e-44"]),
    ("x^3 - 5*x + 3/7", "9/2", start("-3/2", 1, "1/3", digits=30, method="taylor"), 79, ["-320955.34051589 ± 2.8e-39"]),
    ("-x - 3/7", "33/2", start("-3/2", 1, "1/3", digits=18, method="taylor"), 87, ["-0.213432484874053 ± 1.2e-28"]),
    (
        "-3/(16*x^2) + 5/(7*x - 21)",
        ["3/2", "5/2"],
        start(1, "2/5", "1/3", digits=20, method="taylor"),
        99,
        ["0.536632364121226 ± 6.6e-34", "0.540105324797213 ± 3.0e-33"],
    ),
    (
        "x^2 + 2/7",
        "-3/2",
        start(1, "2/5", "1/3", path=[(1 + 2j)], digits=20, method="taylor"),
        60,
        ["0.0761895988563367 ± 1.1e-31"],
    ),
    (
        "(x + 2*I)/(x^2 + 17/13)",
        [-1.5, (0.25 + 2j)],
        start(2, "2/5", 0.25j, digits=20, method="taylor"),
        1776,
        ["0.416318454414591+2.5022725075872j ± 4.0e-36", "-0.773934004667599-0.727757448456833j ± 2.5e-37"],
    ),
    (
        "(x^2 + 13/29)*y'' + 3*x*y' + 5/7*y = 0",
        ["5/2", "-3/2"],
        start("1/3", "2/5", "1/3", derivative=True, digits=20, method="taylor"),
        149,
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
        211,
        ["0.660349043352872 ± 1.2e-35", "-0.265837488053117 ± 6.9e-33"],
    ),
    (
        "(x - 3/29)^2*y'' + (x - 3/29)*y' + (x^2 - 13465/841)*y = 0",
        ["1/2", "7/2"],
        frobenius("3/29", 2, 3, digits=20, method="taylor"),
        227,
        ["82.9919738683056 ± 1.9e-37", "199.688596214004 ± 7.3e-29"],
    ),
    (
        "(x - 5/29)*y'' + y' + (x + 1/5)*y = 0",
        ["1/2", "7/2"],
        frobenius("5/29", 2, 3, digits=20, method="taylor"),
        171,
        ["1.16849319417329 ± 2.5e-37", "-1.05432896906528 ± 4.2e-32"],
    ),
    (
        "(x - 7/29)^2*y'' + (x - 7/29)*y' + (x + 49/16)*y = 0",
        ["1/2", "-7/2"],
        frobenius("7/29", 2, 3, digits=20, method="taylor"),
        222,
        ["-3.59671701908391-0.669131890163578j ± 3.0e-37", "145.197525048969-881.830561839591j ± 1.7e-36"],
    ),
    (
        "-2/(9*x^2) + 3/(x^3*(x - 17/11))",
        ["5/2", "17/2"],
        frobenius("oo", 2, 3, digits=20, method="taylor"),
        248,
        ["9.17835863818238 ± 1.3e-31", "14.6250992431786 ± 2.2e-38"],
    ),
    (
        "(x - 11/29)*y'' + 3*y' + (x + 2/5)*y = 0",
        "11/29",
        frobenius("11/29", 0, 3, derivative=True, digits=20, method="taylor"),
        137,
        ["3 ± 0", "-0.779310344827586 ± 7.4e-40"],
    ),
    ("x + 3/7", "13/8", start(0, 1, "1/3", digits=1000, method="taylor"), 654, ["3.52157474536921 ± 1.9e-1018"]),
    (
        "x + 4/7",
        "1.6180339887498948482045868343656381177203",
        start(0, 1, "1/3", digits=1200, method="taylor"),
        1481,
        ["3.83431191846485 ± 1.6e-1218"],
    ),
    (
        "x + 5/7",
        (0.5 + 0.25j),
        start(0, 1, "1/3", digits=1600, method="taylor"),
        785,
        ["1.23754066748075+0.213772633720235j ± 4.4e-1619"],
    ),
    (
        "1/(x^2 + 31/23)",
        "11/8",
        start(0, 1, "1/3", digits=2600, method="taylor"),
        9338,
        ["2.18619784686705 ± 1.6e-2618"],
    ),
    (
        "-(x^2 + 3)/(x^2 + 15/19)",
        20000,
        start(2, 1, "1/3", digits=20, method="taylor"),
        169,
        ["0.477384550108038 ± 6.6e-33"],
    ),
    ("-x - 2/5", 300000, start(2, 1, "1/3", digits=20, method="taylor"), 96, ["0.0501420965010327 ± 3.7e-29"]),
    (
        "(1 - x)/(x^2 + 21/17)",
        ["-300", 30000],
        start(2, 1, "1/3", digits=15, method="taylor"),
        237,
        ["-212360787481922 ± 3.7e-12", "-10.2920431401043 ± 8.1e-22"],
    ),
    ("3/5*x^3 - x", -100, start(-2, 1, "1/3", digits=15, method="taylor"), 135, ["0.0191474836605289 ± 8.1e-30"]),
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
    ("y'' + x*y' + y = 3*x^2 - 1/(x + 4)", "5/2", start(-1, 1, "1/3", digits=15), 723, ["4.2353822621158 ± 1.2e-33"]),
    (
        "x^2 + a",
        "13/8",
        start(0, 1, "1/3", params={"a": "sqrt(2)"}, digits=30, method="taylor"),
        460,
        ["6.10259656552306 ± 9.4e-49"],
    ),
    ("x^2 + 5", "13/8", start("1/3", 1, "1/3", digits=30, method="closed form"), 62, ["12.8975658771966 ± 6.6e-50"]),
    ("x^2 + 3/8", "13/8", start("1/3", 1, "1/3", digits=30), 70, ["2.66709121610274 ± 3.3e-44"]),
    (
        "(x^2 + 17/29)*y'' + 3*x*y' + 3/4*y = 0",
        "13/8",
        start("1/3", 1, "1/3", digits=30),
        150,
        ["0.8884773669052 ± 1.6e-42"],
    ),
    (
        "x + 11/3",
        ["1", "13/2"],
        {"x0": 2, "which": "decaying", "y0": 3, "digits": 20},
        261,
        ["30.4768523282596 ± 1.7e-37", "8.6193488936494e-06 ± 4.1e-33"],
    ),
    ("x - 5/3", "31/2", start(2, 3, "-1/2", digits=20), 63, ["429126474869219 ± 1.6e-24"]),
    (
        "(x + 1/29)^2*y'' + (x + 1/29)*y' + ((x + 1/29)^2 - 25/49)*y = 0",
        "71/2",
        start(2, 3, "-1/2", digits=20, method="closed form"),
        159,
        ["-0.254926546056377 ± 2.3e-26"],
    ),
    (
        "x*(31/29 - x)*y'' + (3/2 - 2*x)*y' - 5/7*y = 0",
        "6/7",
        start("1/5", 3, "-1/2", digits=20, method="closed form"),
        149,
        ["4.29823288678785 ± 6.1e-39"],
    ),
    (
        "-3/(16*(x - 2/37)^2) + 5/(7*x - 21)",
        ["5/2", "-3/2"],
        start(1, "2/5", "1/3", path="above", digits=20, method="taylor"),
        375,
        ["0.536237830218819 ± 3.3e-33", "-0.577361044305671+0.419190895143837j ± 5.4e-31"],
    ),
    (
        "-3/(16*(x - 3/37)^2) + 5/(7*x - 21)",
        ["5/2", "-3/2", 5],
        start(1, "2/5", "1/3", path="below", digits=20, method="taylor"),
        601,
        [
            "0.534109428215011 ± 3.5e-33",
            "-0.557536368592415-0.428031222475997j ± 4.7e-31",
            "-2.24160845022319+2.05905224104674j ± 5.7e-31",
        ],
    ),
    (
        "x^2 + 5/37",
        ["1/2", "3/2", "5/2", "-1/2"],
        start("1/3", "2/5", "1/3", digits=20, method="taylor"),
        45,
        [
            "0.457236003202342 ± 2.7e-33",
            "1.10843656535138 ± 1.8e-34",
            "6.28868838065415 ± 1.1e-34",
            "0.141333294057507 ± 4.1e-34",
        ],
    ),
    (
        "y'' + 5/37*y' + 3*y = exp(-x)*x^2 + sin(2*x)",
        ["5/2", "-3/2"],
        start("1/3", "2/5", "1/3", digits=20),
        250,
        ["-0.156361772539623 ± 3.5e-39", "0.0300709193890916 ± 9.5e-39"],
    ),
    ("y'' + exp(x/37)*y = 0", ["5/2"], start("1/3", "2/5", "1/3", digits=20), 281, ["0.030099046121185 ± 1.3e-34"]),
    (
        "-(x^2 + 7/37)/(x^2 + 3/37)",
        ["900", "-40"],
        start(5, "2/5", "1/3", digits=12, method="taylor"),
        278,
        ["-0.264983293758459 ± 8.9e-23", "-0.361219397531388 ± 5.0e-22"],
    ),
    (
        "x^2 + 9/37",
        ["1/2", "3/2"],
        {"x0": "1/3", "which": "decaying", "y0": 2, "digits": 20},
        206,
        ["1.68945452325327 ± 1.3e-33", "0.404667978044235 ± 4.4e-34"],
    ),
    (
        "x + 11/37",
        ["1/3 + sqrt(2)"],
        start("sqrt(3)", "2/5", "1/3", digits=20, method="taylor"),
        84,
        ["0.405263496858439 ± 2.5e-35"],
    ),
]


@pytest.fixture(scope="module", autouse=True)
def _imaginary_unit_is_known() -> None:
    kovacic.evaluate("x + 3*I", 2, x0=0, y0=3, dy0=1, digits=20, method="taylor")


@pytest.mark.parametrize(("equation", "x", "options", "looks", "balls"), VALUES, ids=[str(row[:2]) for row in VALUES])
def test_the_work_of_values(equation: str, x: Any, options: dict[str, Any], looks: int, balls: list[str]) -> None:
    check_work(lambda: kovacic.evaluate(equation, x, **options), looks, balls)


MATRICES = [
    (
        "(1 - x^2)*y'' - 2*x*y' + 41/37*y = 0",
        [-1, "1/3", 1],
        20,
        406,
        [
            "0.269170431203482 ± 5.2e-33",
            "0.27630604619591 ± 1.6e-33",
            "3.35695614242212-0.845623849232455j ± 2.3e-32",
            "-0.269170431203482-0.868041044871514j ± 6.7e-33",
        ],
    ),
    (
        "(43/37 - x^2)*y'' - 2*x*y' + 42/37*y = 0",
        [0, (0.5 + 1j), 2],
        600,
        575,
        [
            "0.838948984364118-1.78209635092895j ± 1.8e-612",
            "1.59528771027439+0.84692437304976j ± 1.5e-612",
            "0.468050693023536-0.557967406445459j ± 1.9e-612",
            "0.401873910244488+0.265168713038267j ± 1.6e-612",
        ],
    ),
    (
        "-2/(9*x^2) + 3/(x^3*(x - 19/37))",
        [2, "oo"],
        20,
        254,
        [
            "0.0692439156752996 ± 1.9e-40",
            "4.50824022312185 ± 1.7e-38",
            "0.572678989030012 ± 2.1e-39",
            "-6.03988874169533 ± 1.4e-38",
        ],
    ),
    (
        "-2/(9*x^2) + 5/(x*(x - 19/37))",
        [0, "19/37"],
        20,
        348,
        [
            "0.192714124185364 ± 4.2e-33",
            "0.0147384010371718 ± 1.5e-33",
            "6.41997747736636-5.89496927394687j ± 1.7e-31",
            "2.22066513211422-0.450835773602487j ± 6.2e-32",
        ],
    ),
]


@pytest.mark.parametrize(("equation", "path", "digits", "looks", "balls"), MATRICES, ids=[row[0] for row in MATRICES])
def test_the_work_of_connections(equation: str, path: Any, digits: int, looks: int, balls: list[str]) -> None:
    check_work(lambda: kovacic.connection_matrix(equation, path, digits=digits), looks, balls)


LOOPS = [
    (
        "-3/(16*x^2) + 5/(7*x - 23/37)",
        [2, 1],
        1809,
        [
            "-7.0388583691267+1.48205690060431j ± 5.9e-20",
            "5.43210064104943+5.24415988712286j ± 5.0e-20",
            "-2.68769801341819+6.43557578502357j ± 8.7e-20",
            "7.0388583691267-1.48205690060431j ± 7.1e-20",
            "-1.34942457022601-2.06883005183453j ± 1.2e-20",
            "-1.32053340217405+3.13976380168131j ± 1.1e-20",
            "-2.48966492185592+1.44196315497217j ± 1.5e-20",
            "3.34942457022601+2.06883005183453j ± 1.4e-20",
        ],
    ),
    (
        "-2/(9*x^2) + 1/(x^2 + x + 41/37)",
        [1, 1, 2],
        2920,
        [
            "9.72797970848029+14.6105634330796j ± 1.2e-20",
            "16.9888847202494-21.1618911006969j ± 2.1e-20",
            "10.4957579137174-1.93840366213966j ± 6.2e-21",
            "-7.72797970848029-14.6105634330796j ± 1.2e-20",
            "15.2753616561644+38.9105409096838j ± 5.3e-20",
            "48.3071527058508-49.0467317260791j ± 8.7e-20",
            "24.8527782293945+2.23617938480431j ± 2.9e-20",
            "-13.2753616561644-38.9105409096838j ± 4.8e-20",
            "-7.05525276076592-7.45868339699927j ± 3.8e-20",
            "-5.27450776053298+16.7753863368229j ± 6.7e-20",
            "-5.50792958233207+1.02179453415692j ± 2.2e-20",
            "6.05525276076592+7.45868339699927j ± 3.9e-20",
        ],
    ),
]


@pytest.mark.parametrize(("S", "multiplicities", "looks", "balls"), LOOPS, ids=[row[0] for row in LOOPS])
def test_the_work_of_loops(S: str, multiplicities: list[int], looks: int, balls: list[str]) -> None:
    """Also the exponents and the trace -2 cos(pi Delta), where the pole is double, and the determinant 1."""
    found: list[kovacic.LocalMonodromy] = []

    def matrices() -> Any:
        found.extend(kovacic.monodromy(S, digits=12))
        return [point.matrix for point in found]

    check_work(matrices, looks, balls)
    assert [point.multiplicity for point in found] == multiplicities
    for point in found:
        assert point.consistent
        assert point.trace is not None
        assert point.exponents is not None
        first, second = (complex(exponent.mid) for exponent in point.exponents)
        assert abs(first + second - 1) < 1e-15
        assert abs(complex(point.trace.mid) + 2 * cos(pi * (first - second).real)) < 1e-14
        (a, _), (_, d) = point.matrix
        assert abs(complex(a.mid + d.mid) - complex(point.trace.mid)) < 1e-11
