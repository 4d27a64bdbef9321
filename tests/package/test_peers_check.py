"""The check of other systems' answers accepts right ones in every syntax, and rejects wrong ones."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest
from build import parametrize

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture(scope="module")
def check() -> ModuleType:
    sys.path.insert(0, str(BENCHMARKS))
    try:
        return importlib.import_module("peer_systems.check")
    finally:
        sys.path.remove(str(BENCHMARKS))


@parametrize(
    ("S", "form", "syntax", "expressions", "verdict"),
    [
        ("x^2+3", "y", "python", ["x*exp(x**2/2)"], "right"),
        ("x^2+3", "y", "python", ["x*exp(x**2/3)"], "wrong"),
        ("x^2+3", "y", "python", ["x*exp(x**2/2)", "0"], "wrong"),
        ("x^2+3", "omega", "python", ["x + 1/x"], "right"),
        ("x^2+3", "omega", "python", ["x + 2/x"], "wrong"),
        ("x^2+3", "riccati", "python", ["-x - 1/x", "1", ""], "right"),
        ("x^2+3", "riccati", "python", ["-x - 2/x", "1", ""], "wrong"),
        ("2", "riccati", "python", ["-c/2", "1", "c**2 - 8"], "right"),
        ("2", "riccati", "python", ["-c/2", "1", "c**2 - 9"], "wrong"),
        ("1/x - 3/(16*x^2)", "riccati", "python", ["(1 - 16*x)/(16*x**2)", "-1/(2*x)", "1", ""], "right"),
        ("1/x - 3/(16*x^2)", "riccati", "giac", ["omega_^2-omega_/(3*x)+(1-16*x)/(16*x^2)"], "wrong"),
        ("(11*x-8)^2/(576*x^4)", "riccati", "giac", ["omega_^4-1"], "wrong"),
        ("6/x^2", "riccati", "giac", ["(omega_*x-3)^4"], "right"),
        ("6/x^2", "riccati", "giac", ["(omega_*x-4)^4"], "wrong"),
        ("6/x^2", "riccati", "giac", ["(omega_*x-3)^2*(omega_*x+2)*(omega_*x-4)"], "wrong"),
        ("1/x - 3/(16*x^2)", "y", "fricas", ["exp(2*x^(1/2))*(x^(1/2))^(1/2)"], "right"),
        ("1/x - 3/(16*x^2)", "y", "giac", ["x^(1/4)*exp(2*sqrt(x))", "x^(1/4)*exp(-2*sqrt(x))"], "right"),
        ("x^2+3", "y", "maxima", ["%k2*x*%e^(x^2/2)*'integrate(%e^(-x^2)/x^2,x)+%k1*x*%e^(x^2/2)"], "right"),
        ("x^2+3", "y", "maxima", ["%k2*x*%e^(x^2/2)*'integrate(%e^(-x^2)/x^3,x)+%k1*x*%e^(x^2/2)"], "wrong"),
        ("x^2+3", "y", "maxima", ["%k2*x*%e^(x^2/2)*'integrate(%e^(-x^2)/x^2+1/10^20,x)+%k1*x*%e^(x^2/2)"], "wrong"),
        ("x^2-1", "y", "python", ["exp(-x**2/2)*erfi(x)", "exp(-x**2/2)"], "right"),
        ("x^2-1", "y", "python", ["exp(-x**2/2)*erf(x)"], "wrong"),
        ("x^2-1", "y", "python", ["exp(-x**2/2)*erfi(x) + exp(-x**2/2)*x/10**20"], "wrong"),
        ("2", "y", "python", ["exp(CRootOf(x**2 - 2, 1)*x)"], "right"),
        ("2", "y", "python", ["exp(CRootOf(x**2 - 3, 1)*x)"], "wrong"),
        ("6*x/(x^3-2)", "y", "python", ["exp(RootSum(Poly(c**3 - 2, c), Lambda(c, log(x - c))))"], "right"),
        ("6*x/(x^3-3)", "y", "python", ["exp(RootSum(Poly(c**3 - 2, c), Lambda(c, log(x - c))))"], "wrong"),
        ("6*x/(x^3-2)", "y", "python", ["exp(RootSum(Poly(c**3 - 2, c), Lambda(c, log(x - c))))**2"], "wrong"),
        ("2/x^2", "y", "python", ["x**(log(100)/log(10))", "sin(pi)*x**7 + 1/x"], "right"),
        # On the left half-plane sqrt(x^2) is -x.
        ("x^2+1", "y", "python", ["exp(x*sqrt(x**2)/2)"], "right on a branch"),
    ],
    ordinary=6,
)
def test_answers(check: ModuleType, S: str, form: str, syntax: str, expressions: list[str], verdict: str) -> None:
    assert check.check(S, form, syntax, expressions) == verdict


def test_numbers_in_coefficients_are_exact(check: ModuleType) -> None:
    import mpmath

    with mpmath.workdps(50):
        value = check._function("1/3*x**2 - 2/7 + (x - 12345678901234567890)/c**3")(mpmath.mpf(3), mpmath.mpf(2))
        exact = 3 - mpmath.mpf(2) / 7 + (3 - mpmath.mpf("12345678901234567890")) / 8
        assert abs(value - exact) < mpmath.mpf(10) ** -25


def test_unknown_functions_are_not_guessed(check: ModuleType) -> None:
    with pytest.raises(check.Unreadable):
        check.check("x", "y", "giac", ["mystery(x)"])


@pytest.mark.long
def test_a_large_answer_is_checked_and_a_small_error_found(check: ModuleType) -> None:
    """An integral of forty factors, for which the second derivative as an expression takes minutes."""
    import sympy

    x = sympy.Symbol("x")
    first = sympy.Mul(*((x - k) ** sympy.Rational(k % 5 + 1, 5) for k in range(1, 41)))
    omega = sum(sympy.Rational(k % 5 + 1, 5) / (x - k) for k in range(1, 41))
    S = str(omega.diff(x) + omega**2)
    second = first * sympy.Integral(first**-2, x)
    for expressions, verdict in (([first, second], "right"), ([first, second + x * first / 10**20], "wrong")):
        assert check.check(S, "y", "python", list(map(str, expressions))) == verdict


def test_an_unknown_symbol_is_not_guessed(check: ModuleType) -> None:
    with pytest.raises(check.Unreadable):
        check.check("x^2+3", "y", "python", ["x*exp(x**2/2)*parameter"])


def test_an_error_is_no_answer(check: ModuleType) -> None:
    systems = importlib.import_module("peer_systems.systems")
    answered = '(7) ->\n   (7)  "<<<x^(1/4);(x^(1/4))^3;>>>"\n(8) ->\n'
    fricas = systems.FriCAS()
    assert fricas.understand(answered).expressions == ("x^(1/4)", "(x^(1/4))^3")
    # What was assigned before is printed again.
    for error in ("System error:", "Error detected within library code:"):
        assert fricas.understand(f"(6) ->\n   >> {error}\n\n{answered}").kind == "error"


def test_what_giac_prints_after_the_question(check: ModuleType) -> None:
    systems = importlib.import_module("peer_systems.systems")
    giac, question = systems.Giac(), "kovacicsols(y''=(x^2+3)*y,x,y)\n"
    one, two = (giac.understand(f"{question}[{text}]\n") for text in ("x*exp(x^2/2)", "x^(1/4),x^(3/4)"))
    assert (one.expressions, one.partial) == (("x*exp(x^2/2)",), True)
    assert (two.expressions, two.partial) == (("x^(1/4)", "x^(3/4)"), False)
    assert giac.understand(f"{question}[]\n").kind == "none"
    assert giac.understand(question).kind == "error"


_SERVER = """
import sys, time
marked = sys.argv[1] == "marker"
if not marked:
    print("welcome\\n0>> ", end="", flush=True)
for k, line in enumerate(sys.stdin, 1):
    if line == "sleep\\n": time.sleep(60)
    if line == "die\\n": break
    print("answer to", line, end="")
    print("<<<end>>>" if marked else f"{k}>> ", end="\\n" if marked else "", flush=True)
"""


@parametrize("end", ["marker", "prompt"], ordinary=1)
def test_each_question_gets_its_own_answer(check: ModuleType, end: str) -> None:
    process = importlib.import_module("peer_systems.process")

    class Served(process.System):  # type: ignore[misc, name-defined]
        command = (sys.executable, "-c", _SERVER, end)
        prompt = re.compile(rb"\d+>> ") if end == "prompt" else None

        def request(self, S: str) -> str:
            return f"{S}\n"

    served = Served()
    long = "x" * 300_000
    try:
        for question in ("a", "b", long, "sleep", "c", "die", "d"):
            reply = served.solve(question, 0.5 if question == "sleep" else 30.0)
            expected = {"sleep": "time-out", "die": "died"}.get(question, "text")
            assert (reply.outcome, reply.text) == (expected, f"answer to {question}\n" if expected == "text" else "")
    finally:
        served.close()
