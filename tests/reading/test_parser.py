"""Reading S: text, SymPy expressions, coefficients; what is refused, and in which words; limits."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import pytest
import sympy
from build import QQ, RatFunc, generated, parametrize, read_expression, read_input
from expressions import Expression, expressions
from hypothesis import example, given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import InputError, LimitExceeded, Limits, NotRational, ParseError
from kovacic.reading.arithmetic import VARIABLE, Arithmetic
from kovacic.reading.dialects import tokenize
from kovacic.reading.expression import parse_with
from kovacic.reading.parser import Site, parse

# Far from every root that the small numbers of the strategies produce.
POINTS = (Fraction(10007, 13), Fraction(-9973, 17))


def value(function: RatFunc, point: Fraction) -> Fraction:
    def horner(coefficients: tuple[Fraction, ...]) -> Fraction:
        total = Fraction(0)
        for coefficient in reversed(coefficients):
            total = total * point + coefficient
        return total

    return horner(function.num.coefficients()) / horner(function.den.coefficients())


def expected(expression: Expression) -> list[Fraction] | None:
    """The values at the points; None where the expression isn't defined (it divides by zero identically)."""
    try:
        return [expression.at(point) for point in POINTS]
    except ZeroDivisionError:
        return None


@pytest.mark.long
@given(expressions())
@generated(60)
def test_random_expressions_have_their_exact_value(expression: Expression) -> None:
    values = expected(expression)
    if values is None:
        with pytest.raises(NotRational):
            read_input(expression.text)
    else:
        assert [value(read_input(expression.text).S, point) for point in POINTS] == values


@pytest.mark.long
@given(expressions(max_leaves=8))
@generated(25)
def test_random_expressions_agree_with_sympy_and_so_do_sympys_own(expression: Expression) -> None:
    values = expected(expression)
    if values is None:
        return
    # `python` was written by the strategy, not by a user.
    symbolic = sympy.sympify(expression.python)
    x = sympy.Symbol("x")
    sampled = [symbolic.subs(x, sympy.Rational(p.numerator, p.denominator)) for p in POINTS]
    assert [Fraction(int(s.p), int(s.q)) for s in sampled] == values
    from_text, from_sympy = read_input(expression.text).S, read_input(symbolic, var="x").S
    assert from_text == from_sympy


@pytest.mark.long
@given(expressions())
@generated(25)
def test_what_is_printed_is_read_back(expression: Expression) -> None:
    if expected(expression) is not None:
        S = read_input(expression.text).S
        assert read_input(S.to_str("t"), var="t").S == S


PIECES = [
    *"xxyI01234567890..++--**//^^(((()))),,=''²⁻½₁λπ \n\t!_\\",
    "**",
    "sin(",
    "sqrt(",
    "e5",
    "1/2",
    "diff(",
    "y''",
]


@pytest.mark.long
@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join) | st.text(max_size=30))
@generated(100)
@example("x" * 50 + "\x00")
@example("(" * 1000)
def test_garbage_is_refused_with_a_position_or_read(text: str) -> None:
    outcome = outcome_of(text, Limits(exponent=200, degree=500, bits=20_000, digits=50))
    if isinstance(outcome, InputError):
        assert outcome.text == text
        assert outcome.position is not None
        assert 0 <= outcome.position <= len(outcome.text)
        assert outcome.message in str(outcome)
    elif isinstance(outcome, LimitExceeded):
        assert outcome.limit in ("exponent", "degree", "bits", "digits")


def outcome_of(text: str, limits: Limits) -> RatFunc | InputError | LimitExceeded:
    try:
        return read_input(text, limits=limits).S
    except (InputError, LimitExceeded) as error:
        return error


# ------------------------------------------------------------------------------------------ the grammar


class Shapes:
    """A reader that writes down which operations it is asked for, in parentheses; it is its own arithmetic."""

    def __init__(self, tokens: Any) -> None:
        self.tokens = tokens
        self.arithmetic = self
        self.spans: list[tuple[str, str]] = []

    def number(self, text: str) -> str:
        return text

    name = derivative = operator = number

    def integer(self, text: str) -> int:
        return int(text)

    def constant(self, value: int) -> str:
        return f"(-{-value})" if value < 0 else str(value)

    def negate(self, value: str) -> str:
        return f"(-{value})"

    def sum(self, terms: list[str]) -> str:
        return f"({'+'.join(terms)})"

    def multiply(self, left: str, right: str) -> str:
        return f"({left}*{right})"

    def divide(self, left: str, right: str) -> str:
        return f"({left}/{right})"

    def power(self, base: str, exponent: str, site: Site) -> str:
        self.spans.append((site.text(), f"({base}^{exponent})"))
        return f"({base}^{exponent})"

    def call(self, head: str, arguments: list[Any], site: Site) -> str:
        shown = ("<" + ",".join(argument) + ">" if isinstance(argument, tuple) else argument for argument in arguments)
        self.spans.append((site.text(), site.inside()))
        return f"{head}[{','.join(shown)}]"

    def equation(self, left: str, right: str) -> str:
        return f"{left} = {right}"

    def follows_without_sign(self, name: str) -> bool:
        return name == "y"


def shape(text: str) -> str:
    tokens = tokenize(text)
    return str(parse(tokens, Shapes(tokens)))


@pytest.mark.parametrize(
    ("text", "structure"),
    [
        ("a-b-c+d", "(a+(-b)+(-c)+d)"),
        ("a/b/c*d", "(((a/b)/c)*d)"),
        ("a^b^c", "(a^(b^c))"),
        ("a-b*c^d", "(a+(-(b*(c^d))))"),
        ("a^b*c-d", "(((a^b)*c)+(-d))"),
        ("-a^b", "(-(a^b))"),
        ("(-a)^b", "((-a)^b)"),
        ("-a*b", "((-a)*b)"),
        ("-2a", "(-(2*a))"),
        ("-a+b", "((-a)+b)"),
        ("a*-b", "(a*(-b))"),
        ("a--b", "(a+(-(-b)))"),
        ("+a^+b", "(a^b)"),
        ("a^-b^c", "(a^(-(b^c)))"),
        ("a^-b*c", "((a^(-b))*c)"),
        ("a^--b", "(a^(-(-b)))"),
        ("2a^b", "(2*(a^b))"),
        ("2(a)(b)", "((2*a)*b)"),
        ("a^2(b)", "((a^2)*b)"),
        ("2(a)/b", "((2*a)/b)"),
        ("a*2b", "(a*(2*b))"),
        ("a/(2b)", "(a/(2*b))"),
        ("a²b", "((a^2)*b)"),
        ("(a^b)²", "((a^b)^2)"),
        ("a^b⁻¹", "(a^(b^(-1)))"),
        ("-a²", "(-(a^2))"),
        ("a = -b", "a = (-b)"),
        ("f(a)^b", "(f[a]^b)"),
        ("2f(a)(b)", "((2*f[a])*b)"),
        ("f(a+b, (c, d-e), (g))", "f[(a+b),<c,(d+(-e))>,g]"),
        ("f(x, (y, 2)) = -y''(x)/3 + diff(y', x)", "f[x,<y,2>] = (((-y''[x])/3)+diff[y',x])"),
        ("f(g(a, b), ((c)))", "f[g[a,b],c]"),
        ("a y^b", "(a*(y^b))"),
    ],
)
def test_structure(text: str, structure: str) -> None:
    assert shape(text) == structure


@pytest.mark.long
@given(expressions())
@generated(60)
def test_the_structure_doesnt_depend_on_redundant_parentheses(expression: Expression) -> None:
    """What an operation stands on is its operands' text: parentheses around it change nothing."""
    tokens = tokenize(expression.text)
    reader = Shapes(tokens)
    whole = str(parse(tokens, reader))
    assert shape(f"({expression.text})") == whole
    assert shape(f"f({expression.text})") == f"f[{whole}]"
    assert shape(whole) == whole
    for text, structure in reader.spans:
        assert "..." in text or shape(text) == structure


@pytest.mark.parametrize(
    ("text", "spans"),
    [
        ("1 + 2x^3 * a", [("x^3", "(x^3)")]),
        ("-x ^ (a+b)c", [("x ^ (a+b)", "(x^(a+b))")]),
        ("(x)²+1", [("(x)²", "(x^2)")]),
        ("2 f( a , (b, c) ) + d", [("f( a , (b, c) )", "a , (b, c)")]),
    ],
)
def test_the_places_of_operations(text: str, spans: list[tuple[str, str]]) -> None:
    tokens = tokenize(text)
    reader = Shapes(tokens)
    parse(tokens, reader)
    assert reader.spans == spans


@pytest.mark.parametrize(
    ("text", "position", "words"),
    [
        ("a^2²^b", 4, "nothing before '.'"),
        ("a² ²", 3, "nothing before"),
        ("f((a,b)+c)", 7, "nothing before '.'"),
        ("f((a,b,c))", 6, "comma"),
        ("f(((a,b)))", 5, "comma"),
        ("(a,b)", 2, "comma"),
        ("f(2(a,b))", 5, "comma"),
        ("f(a,)", 4, "belong"),
        ("f()", 1, "nothing between"),
        ("f((a,b)", 1, "never closed"),
        ("(a = b)", 3, "one equals sign"),
        ("a = b = c", 6, "one equals sign"),
        ("= a", 0, "one equals sign"),
        ("a =", 2, "ends after"),
        ("a * ", 2, "ends after"),
        ("a^*b", 1, "missing between"),
        ("((a)", 0, "never closed"),
        ("2 a 3", 2, "operator is missing"),
        ("a/2b(c)*d", 0, r"write a/\(2b\(c\)\)|followed"),
    ],
)
def test_what_isnt_an_expression(text: str, position: int, words: str) -> None:
    with pytest.raises(ParseError, match=words) as caught:
        shape(text)
    assert caught.value.position == position


@pytest.mark.long
@given(expressions())
@example(Expression(" 2e-3**x' -\u2003(y″ (x) + .5x⁻²) = é ", "", lambda x: x, 0))
@generated(25)
def test_tokens_are_the_text_without_its_spaces(expression: Expression) -> None:
    text = expression.text
    tokens = tokenize(text)
    plain = str.maketrans({"″": "''", "−": "-", "·": "*", "×": "*"})
    assert "".join(tokens.pieces) == "".join(text.split()).translate(plain)
    written = [text[token.start : token.end].translate(plain) for token in tokens]
    assert written == tokens.pieces
    starts = [token.start for token in tokens]
    assert starts == sorted(starts)
    assert tokens.kinds[-1] == "$END"
    assert starts[-1] == len(text)


# ------------------------------------------------------------------------------------------ spellings


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("x^2+3", "x**2 + 3"),
        ("3x", "3*x"),
        ("2(x+1)(x-1)", "2*x**2 - 2"),
        ("(x+1)x", "x**2 + x"),
        ("2 x", "2*x"),
        ("x^2(x+1)", "x**3 + x**2"),
        ("-x^2", "-x**2"),
        ("2*-x", "-2*x"),
        ("2--x", "x + 2"),
        ("x^-2", "1/x**2"),
        ("x^--2", "x**2"),
        ("2^3^2", "512"),
        ("x**2**3", "x**8"),
        ("(2x)/(3x^2)", "2/(3*x)"),
        ("2x/3", "2*x/3"),
        ("x/2/2", "x/4"),
        ("x-1-1", "x - 2"),
        ("x²+3x⁻²", "(x**4 + 3)/x**2"),
        ("−x·2 ÷ 4", "-x/2"),
        ("x\n  + 1", "x + 1"),
        ("1/(1/x)", "x"),
        ("(x-1)/(x-1)", "1"),
        ("((x-1)/(x-2))^-3", "(x**3 - 6*x**2 + 12*x - 8)/(x**3 - 3*x**2 + 3*x - 1)"),
        ("sqrt(9/4)*x", "3*x/2"),
        ("4^(1/2)", "2"),
        ("0", "0"),
        ("x - x", "0"),
        ("x^0", "1"),
    ],
)
def test_spellings(text: str, printed: str) -> None:
    assert read_input(text).S.to_str("x") == printed


@pytest.mark.parametrize("name", ["x", "t", "z1", "lambda", "λ", "theta_2", "e", "n"])
def test_any_single_name_is_the_variable(name: str) -> None:
    parsed = read_input(f"{name}^2 + 3*{name}")
    assert (parsed.variable, parsed.S) == (name, RatFunc(QQ.poly([0, 3, 1])))


@pytest.mark.parametrize("name", ["I", "E", "pi"])
def test_reserved_names_are_variables_where_the_caller_says_so(name: str) -> None:
    assert read_input(f"{name}^2", var=name).S == RatFunc(QQ.poly([0, 0, 1]))
    if name == "I":
        assert read_input("I^2").S == RatFunc(QQ.poly([-1]))
    elif name == "E":  # the energy
        assert read_input("E^2").S.num.field.names == ("E",)
    elif name == "pi":  # a constant
        assert read_input("pi^2").S.num.field.names == ("pi",)


def test_decimals_are_exact_and_noticed() -> None:
    parsed = read_input("0.1x + 1.5e-2 + .5 + 2.")
    assert parsed.S == RatFunc(QQ.poly([Fraction(2515, 1000), Fraction(1, 10)]))
    assert parsed.notices == (
        "0.1 was taken exactly, as 1/10",
        "1.5e-2 was taken exactly, as 3/200",
        ".5 was taken exactly, as 1/2",
        "1 more decimals were taken exactly",
    )
    assert read_input("1e5").notices == ("1e5 was taken exactly, as 100000",)
    assert read_input("x/2").notices == ()


REFUSED = [
    ("", ParseError, 0, "no expression"),
    ("  \n", ParseError, 0, "no expression"),
    ("1/2x", ParseError, 0, "write 1/(2x) or (1/2)*x"),
    ("1 + x^2/2(x+1)", ParseError, 4, "write x^2/(2(x+1)) or (x^2/2)*(x+1)"),
    ("1/-2x", ParseError, 0, "write 1/(-2x)"),
    ("x + sin(x)", NotRational, 4, "sin(x) isn't a rational function of x"),
    ("exp(2*x)", NotRational, 0, "exp(2*x)"),
    ("y", NotRational, 0, "the unknown function"),
    ("x*y", NotRational, 2, "the unknown function"),
    ("a*b", InputError, 2, "which of a, b is the variable"),
    ("sqrt(n)*x", NotRational, 0, "isn't rational in the parameters"),
    ("1/0", NotRational, 2, "division by zero"),
    ("x/(x-x)", NotRational, 2, "division by zero"),
    ("0/0", NotRational, 2, "division by zero"),
    ("x + 0^0", NotRational, 4, "0^0 isn't defined"),
    ("(x-x)^-1", NotRational, 0, "0 has no powers"),
    ("x^x", NotRational, 0, "the variable in the exponent"),
    ("2^x", NotRational, 0, "the variable in the exponent"),
    ("x^(1/2)", NotRational, 0, "isn't a rational function"),
    ("x^0.5", NotRational, 0, "isn't a rational function"),
    ("2^(1/1000)*x", NotRational, 0, "isn't an algebraic number of degree"),
    ("sqrt(x)", NotRational, 0, "isn't a rational function of x"),
    ("sqrt(x)", NotRational, 0, "isn't a rational function"),
    ("x + pi*y", NotRational, 4, "pi is the number pi"),
    ("pi*x*y", NotRational, 0, "the number pi"),
    ("oo", NotRational, 0, "infinity"),
    ("(x+1", ParseError, 0, "never closed"),
    ("2*(x+1))", ParseError, 7, "closes nothing"),
    ("()", ParseError, 0, "nothing between"),
    ("x+", ParseError, 1, "ends after '+'"),
    ("*x", ParseError, 0, "nothing before '*'"),
    ("x */ 2", ParseError, 2, "missing between '*' and '/'"),
    ("2 3", ParseError, 0, "operator is missing"),
    ("(x+1)2", ParseError, 4, "operator is missing"),
    ("x(x)", NotRational, 0, "write x*(x)"),
    ("S(x)", NotRational, 0, "S(x) isn't a rational function"),
    ("x!", ParseError, 1, "unexpected character '!'"),
    ("3½x", ParseError, 1, "digits 0 to 9"),
    ("1,5*x", ParseError, 0, "point"),
    ("1_000", ParseError, 1, "grouped"),
    ("2e-3*e", ParseError, 0, "2*e-3"),
    ("1.2.3", ParseError, 0, "operator is missing"),
    ("x\x00", ParseError, 1, "U+0000"),
]


@pytest.mark.parametrize(("text", "kind", "position", "words"), REFUSED, ids=[repr(row[0]) for row in REFUSED])
def test_refusals_say_where_what_and_how_else(text: str, kind: type[InputError], position: int, words: str) -> None:
    with pytest.raises(kind) as caught:
        read_input(text)
    assert caught.value.position == position
    assert caught.value.text == text
    assert words in str(caught.value)


@pytest.mark.parametrize("text", ["y'' = x*y", "x = 2"])
def test_an_equation_is_refused_where_a_number_or_function_is_expected(text: str) -> None:
    with pytest.raises(NotRational, match="give S alone") as caught:
        parse_with(text, {"x": VARIABLE}, Arithmetic())
    assert (caught.value.position, caught.value.text) == (0, text)


def test_user_text_is_never_executed() -> None:
    for text in ("__import__('os').system('true')", "x.__class__", "(lambda: 0)()", "exec('1')"):
        with pytest.raises(InputError):
            read_input(text)


# ------------------------------------------------------------------------------------------ limits


@pytest.mark.parametrize(
    ("text", "limit"),
    [
        ("9**9**9", "exponent"),
        ("x^100001", "exponent"),
        ("x^-100001", "exponent"),
        ("x" + "^2" * 40, "exponent"),
        ("(x+1)^20001", "degree"),
        ("x^20000*x", "degree"),
        ("1/x^15000/(x+1)^15000", "degree"),
        ("(((((x^9)^9)^9)^9)^9)^9", "degree"),
        ("(2^1000)^10000", "bits"),
        ("(x+2^199)^20000", "bits"),
        ("(x+2^300)^15000", "bits"),
        ("1" * 100_001, "digits"),
        ("1e100001", "digits"),
        ("1e-9999999999999", "digits"),
        ("x^" + "9" * 500, "exponent"),
        ("x^-" * 101 + "x", "text_length"),
        (" " * 1_000_001, "text_length"),
    ],
    ids=lambda value: value[:20],
)
def test_limits_hold_before_the_work_is_done(text: str, limit: str) -> None:
    with pytest.raises(LimitExceeded) as caught:  # the work itself takes minutes, or has no end
        read_input(text)
    assert caught.value.limit == limit


def test_messages_show_part_of_a_long_text() -> None:
    with pytest.raises(kovacic.InputError, match="of order 3000") as refused:
        read_input("y" + "'" * 3_000 + " = y")
    assert len(str(refused.value)) < 500


def test_limits_are_adjustable() -> None:
    assert read_input("x^7").S.num.degree == 7
    with pytest.raises(LimitExceeded, match="above the limit of 5"):
        read_input("x^7", limits=Limits(exponent=5))
    with pytest.raises(LimitExceeded, match="above the limit of 5"):
        read_input("x^3*x^4", limits=Limits(degree=5))
    with pytest.raises(LimitExceeded, match="above the limit of 3"):
        read_input("1234", limits=Limits(digits=3))


def test_the_wall_clock_is_checked_between_operations() -> None:
    slow = "+".join(f"1/(x-{k})" for k in range(1500))
    with pytest.raises(LimitExceeded, match="time limit"):
        kovacic.decide(slow, limits=Limits(seconds=0))


@parametrize(
    ("opening", "closing", "depth"),
    [("(", ")", 100_000), ("-(", ")", 10_000), ("(1+", ")", 10_000), ("-", "", 100_000), ("1/(", ")", 9_999)],
    ordinary=0,
    long=1,
)
def test_nesting_needs_no_recursion(opening: str, closing: str, depth: int) -> None:
    S = read_input(opening * depth + "x" + closing * depth).S
    assert max(S.num.degree, S.den.degree) == 1


def test_thousand_digit_coefficients_and_large_sums() -> None:
    rng = random.Random(1)
    big = [rng.randrange(10**999, 10**1000) for _ in range(50)]
    S = read_input(" + ".join(f"{c}*x^{k}" for k, c in enumerate(big))).S
    assert S.num.coefficients() == tuple(map(Fraction, big))
    partial = read_input("+".join(f"{k}/(x-{k})^2" for k in range(1, 41))).S
    assert (partial.num.degree, partial.den.degree) == (78, 80)
    assert value(partial, POINTS[0]) == sum(Fraction(k) / (POINTS[0] - k) ** 2 for k in range(1, 41))


# ------------------------------------------------------------------------------------------ SymPy and numbers

x, n = sympy.symbols("x n")


def test_sympy_expressions_are_walked() -> None:
    S = (x**2 - 1) / (2 * x - 2) + sympy.Rational(1, 3) * (x + 1) ** -2
    assert read_input(S).S == read_input("(x^2-1)/(2*x-2) + 1/(3*(x+1)^2)").S
    t = sympy.Symbol("t", positive=True)
    assert read_input(t**2 + 1).variable == "t"
    assert read_input(sympy.Integer(2)).variable == "x"
    assert read_input(t + 1, var=t).variable == "t"
    assert read_input(sympy.Poly(x**2 + 1, x)).S == RatFunc(QQ.poly([1, 0, 1]))
    unevaluated = sympy.Mul(2, sympy.Add(x, 1, evaluate=False), evaluate=False)
    assert read_input(unevaluated).S == RatFunc(QQ.poly([2, 2]))


def test_sympy_floats_are_exact_and_noticed() -> None:
    parsed = read_input(0.1 * x)
    assert parsed.S == RatFunc(QQ.poly([0, Fraction(0.1)]))
    assert "taken exactly, as 3602879701896397/36028797018963968" in parsed.notices[0]


@pytest.mark.parametrize(
    ("expression", "words"),
    [
        (sympy.sin(x), "isn't a rational function"),
        (sympy.sqrt(x), "isn't a rational function"),
        (x**x, "the variable in the exponent"),
        (x**n, r"x\*\*n isn't a rational function"),
        (sympy.sqrt(n) * x, "isn't rational in the parameters"),
        (sympy.zoo, "isn't a rational number"),
        (sympy.Function("f")(x), "isn't a rational function"),
        (sympy.Pow(x - x, -1, evaluate=False), "division by zero"),
        (sympy.Symbol("x", real=True) + x, "same name"),
        (sympy.Eq(x, 1), "isn't a SymPy expression"),
    ],
    ids=str,
)
def test_sympy_expressions_that_are_not_rational(expression: Any, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_input(expression)


@pytest.mark.long
def test_deep_sympy_expressions() -> None:
    expression = x
    for k in range(60):
        expression = 1 / (expression + k)
    with pytest.raises(LimitExceeded):
        read_input(expression, limits=Limits(bits=100))
    S = read_input(expression).S
    point = POINTS[0]
    direct = point
    for k in range(60):
        direct = 1 / (direct + k)
    assert value(S, point) == direct


def test_numbers_and_coefficients() -> None:
    assert read_input(-1).S == RatFunc(QQ.poly([-1]))
    assert read_input(Fraction(1, 2)).S == RatFunc(QQ.poly([Fraction(1, 2)]))
    pair = ([3, 0, 1], [Fraction(1, 2), sympy.Rational(1, 3)])
    assert read_input(pair).S == read_input("(x^2+3)/(1/2 + x/3)").S
    assert read_input(([0, 1], [1]), var="t").variable == "t"
    S = RatFunc(QQ.poly([1]), QQ.poly([0, 1]))
    assert read_input(S).S is S


@pytest.mark.parametrize(
    ("S", "words"),
    [
        (([1], [0]), "denominator is zero"),
        (([1], []), "denominator is zero"),
        (([0.5], [1]), "float|Fraction"),
        (([1], ["2"]), "not a rational number"),
        (([1], 2), "not a sequence"),
        (("12", "3"), "not a sequence"),
        ([1, 2, 3], "isn't a form of S"),
        (None, "isn't a form of S"),
        (2.5, "isn't a form of S"),
        (b"x", "isn't a form of S"),
    ],
    ids=repr,
)
def test_other_objects_are_refused(S: Any, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_input(S)


@pytest.mark.parametrize("var", ["", "2x", "a b", 3, sympy.Integer(1)])
def test_names_that_are_none(var: Any) -> None:
    with pytest.raises(InputError):
        read_input("1", var=var)


def test_symbols_that_a_rational_function_would_confuse_are_refused() -> None:
    with pytest.raises(InputError, match="same name"):
        read_input(sympy.Dummy("x") + x)
    a, b = sympy.symbols("a b", commutative=False)
    for expression in (a * b - b * a + x, a * sympy.Function("y")(x).diff(x, 2) - x):
        with pytest.raises(InputError, match="don't commute"):
            read_input(expression)


@pytest.mark.parametrize("text", ["sqrt({})*x", "sqrt(2/{})", "{}^(1/2)", "y'' + y = {}*exp(x)", "y'' = exp({}*x)"])
def test_numbers_that_python_does_not_print_are_over_a_limit_or_read(text: str) -> None:
    with pytest.raises(LimitExceeded, match="bits"):
        read_input(text.format("7" * 5001))
    assert str(read_input(f"y'' + {'7' * 5001}*y").equation).count("7") == 5001


# ------------------------------------------------------------------------------------------ SymPy's expressions


@given(expressions(max_leaves=6))
@settings(max_examples=60)
def test_expressions_have_their_exact_value_in_sympy_too(expression: Expression) -> None:
    values = expected(expression)
    if values is not None:
        symbolic = read_expression(expression.text)
        for point, exact in zip(POINTS, values, strict=True):
            assert symbolic.subs(x, sympy.Rational(point)) == sympy.Rational(exact)


@pytest.mark.parametrize(
    ("text", "expression"),
    [
        ("2sin(x)^2 + cbrt(x)", 2 * sympy.sin(x) ** 2 + sympy.cbrt(x)),
        ("root(x, 4) - pi*I", x ** sympy.Rational(1, 4) - sympy.pi * sympy.I),
        ("e^x/arctan(0.5)", sympy.exp(x) / sympy.atan(sympy.Rational(1, 2))),
        ("x^n", x**n),
        ("-2^2", sympy.Integer(-4)),
    ],
)
def test_sympys_expressions(text: str, expression: Any) -> None:
    assert read_expression(text) == expression


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("", InputError, "is empty"),
        ("z + x", InputError, "can't contain z"),
        ("x'", InputError, "derivative"),
        ("x = 1", InputError, "not an equation"),
        ("gamma(x)", InputError, r"can't contain gamma\(x\)"),
        ("log(0)", InputError, "isn't finite"),
        ("1/(x - x)", NotRational, "division by zero"),
        ("9^9^9", LimitExceeded, "exponent"),
        ("exp(9^5*log(9))", LimitExceeded, "exponent"),
        ("sin(" * 200 + "x" + ")" * 200, LimitExceeded, "nested"),
    ],
)
def test_expressions_that_are_refused(text: str, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        read_expression(text, names={"x": x})


#: What people type: other systems' spellings, slips, equations of another kind.
WRONG = [
    "(x+1",
    "x+1)",
    "((x)",
    "x+*2",
    "x//2",
    "x/",
    "+",
    "()",
    "x^",
    "^2",
    "x+",
    "x^^2",
    "x**",
    "x***2",
    "x = 2",
    "x == 2",
    "y'' = x y = 0",
    "y''=x*y; y'=0",
    "y''=x*y, y(0)=1",
    "y' = x*y",
    "y''' = x*y",
    "y'''' + y = 0",
    "y''' + y'' + y = 0",
    "y = x",
    "y'' = y^2",
    "y'' = x*y^2",
    "y''*y = x",
    "y'^2 + y'' = 0",
    "sqrt(y'') = y",
    "sin(y) + y'' = 0",
    "y'' + y*z'' = 0",
    "y'' = foo(x)*y",
    "gama(x)",
    "sin x y",
    "sinx",
    "EXP(x)",
    "ln x",
    "e^(x^2)",
    "E^x*y'' = y",
    "y'' = E^x*y",
    "2,5",
    "x^2,5",
    "x1^2 + x2",
    "x − 1 ≥ 0",
    "x < 2",
    "90°",
    "x°",
    "$x^2",
    "[x",
    "x^-",
    "x^x",
    "0^0",
    "1/0",
    "1/(x-x)",
    "0/0",
    "x(x)",
    "a(x+1)",
    "x y'' y",
    "2 3",
    "x 2",
    "Derivative(y(x), x, z)",
    'y"" = x*y',
    "x^2#comment",
    "x^2 % 3",
    "x!",
    "|x|",
    "∞",
    "pi*x*y",
    "I*x+oo",
    "nan",
    "x^2+3 \\n",
    "lambda x: x",
    "__import__('os')",
    "x & 1",
    "x if 1 else 2",
    "sin",
    "sin*x",
    "exp",
    "y",
    "y'",
    "''",
    "=",
    "y''=",
    "=y''",
    "y'' + = 0",
    "y'' = x*y + z(x)",
    "f(x)",
    "3 y''+ y 2 = 0",
    "y''+1.2.3*y",
    "1_000",
    "x·y",
    "3½",
    "1/2x",
    "1/2(x+1)",
    "x/2x",
    "sqrt(2",
    "sqrt()",
    "sqrt(2,3)",
    "root(2)",
    "sin(x,2)",
    "exp()",
    "log(0)*y''+y=0",
    "y''=1/0*y",
    "abs(x)",
]


@parametrize("text", WRONG, ordinary=67)
def test_every_wrong_text_is_told_where_and_what_to_write(text: str) -> None:
    with pytest.raises(InputError) as caught:
        read_input(text, exponentials=True)
    assert caught.value.position is not None
    assert caught.value.hint


@pytest.mark.parametrize(
    "text",
    [
        "(x+a+b+c)^100",
        "(x+a+b)^400",
        "(a+b+c+d)^100*x",
        "((x+a+b)^20+c)^20",
        "(x^3+a*x^2+b*x+c)^200",
        "(x+a+b)^90*(x-a-c)^90",
        "1/(x+a+b+c)^100",
        "y'' = (sqrt(2)*x+a+b+c)^80*y",
    ],
)
def test_the_number_of_terms_in_the_parameters_is_foreseen(text: str) -> None:
    with pytest.raises(LimitExceeded) as caught:  # multiplying out takes up to minutes
        read_input(text)
    assert caught.value.limit == "terms"


def test_what_is_foreseen_isnt_less_than_what_there_is_nor_much_more() -> None:
    for text, terms in (
        ("(x+a+b)^30", 496),
        ("(x+a)^12*(x-b)^12", 169),
        ("(x^2+a)^40/(x+b)", 41),
        ("(x^2+x+a+1)^10", 231),
    ):
        assert read_input(text, limits=Limits(terms=terms)).S.num.extent()[0] <= terms
        with pytest.raises(LimitExceeded, match="terms"):
            read_input(text, limits=Limits(terms=terms - 1))


def test_the_bits_of_all_coefficients_together_are_limited() -> None:
    """(x + 2)^n is foreseen to have n + 1 coefficients of up to 2 n bits; a hundred times the limit of one is allowed."""
    assert read_input("(x+2)^99", limits=Limits(bits=198)).S.num.degree == 99
    said = "up to 101 coefficients of up to 200 bits, above the limit of 20000 bits for all together"
    with pytest.raises(LimitExceeded, match=said):
        read_input("(x+2)^100", limits=Limits(bits=200))


@pytest.mark.parametrize("text", ["y'' + y = e^ax", "y'' + y = e^-ax", "y'' - 2^ax*y = 0", "x^ax"])
def test_two_letters_in_an_exponent_are_refused_with_the_product_as_the_hint(text: str) -> None:
    """e^ax is e^(a x) to one reader and e^a x to another; what the hint says is read, where it is a function at all."""
    with pytest.raises(ParseError, match="ax in an exponent can be read in two ways") as caught:
        read_input(text)
    assert caught.value.excerpt == "ax"
    assert caught.value.hint == "write (a*x) for the product"


def test_the_hint_for_two_letters_in_an_exponent_is_read() -> None:
    assert kovacic.dsolve("y'' = e^(a*x)", ics={"y(0)": 0, "y'(0)": 0}).rhs.has(sympy.exp)


@pytest.mark.parametrize("text", ["√x²", "√x³ + 1", "∛x²", "√x^2", "√x(x+1)", "√2x", "√xt", "y'' = x√2y"])
def test_what_follows_a_bare_root_is_refused(text: str) -> None:
    """It may belong to the root or to what is under it; √(x)², √2 x and √(2x) are clear."""
    with pytest.raises(kovacic.InputError, match="two ways") as error:
        kovacic.solve(text)
    assert "parentheses" in str(error.value.hint)


def test_parentheses_tell_what_a_root_is_of() -> None:
    assert kovacic.solve("√(x)²").S == kovacic.solve("x").S


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("y'' + (a - 2qcos(2x))y = 0", "q*cos(...)"),
        ("y'' + y = tg x", "tan(...)"),
        ("y'' + y = arctg(x)", "atan(...)"),
        ("y'' + y = log_10 x", "log(x)/log(b)"),
        ("S = x^2 + 3", "S alone"),
        ("y'' + y = e³ˣ, y(0) = 1", "y'' + y = e³ˣ"),
        ("y'' + k^2 y = 0, k = 2", "substitute the values"),
    ],
)
def test_the_hint_has_what_was_meant(text: str, meant: str) -> None:
    with pytest.raises(kovacic.InputError) as error:
        kovacic.solve(text)
    assert meant in str(error.value.hint)


@pytest.mark.parametrize("given", ["y^2 + 3", sympy.Symbol("y") ** 2 + 3, ([3, 0, 1], [1])], ids=str)
def test_the_unknown_function_is_no_variable_of_S(given: Any) -> None:
    with pytest.raises(kovacic.InputError, match="y is the unknown function"):
        kovacic.solve(given, var="y")


@pytest.mark.parametrize("given", ["x*y", sympy.Symbol("x") * sympy.Symbol("y")], ids=str)
def test_the_unknown_function_is_no_parameter_of_S(given: Any) -> None:
    with pytest.raises(kovacic.InputError, match="y is the unknown function"):
        kovacic.solve(given, parameters=["y"])


@pytest.mark.parametrize("argument", ["x,2", "2", "x^2"])
def test_a_function_that_is_given_by_its_name_is_one_of_the_variable(argument: str) -> None:
    with pytest.raises(kovacic.InputError):
        kovacic.dsolve(f"y'' + y = g({argument})", "y(x)")


def test_a_refusal_marks_the_part_and_what_stands_beside_it() -> None:
    """30 characters on either side, a mark of one to 40 characters, and the remedy of each door."""
    text = "0123456789" * 12
    one = kovacic.InputError("it is wrong", text=text, position=47, hint="in Python", shell="in a shell")
    beside = f"    {text[17:78]}\n    {' ' * 30}^"
    assert str(one) == f"it is wrong\n  at position 47:\n{beside}\n  hint: in Python"
    assert one.for_shell() == f"it is wrong\n  at position 47:\n{beside}\n  hint: in a shell"
    assert one.excerpt == "7"
    long = kovacic.InputError("it is long", text=text, position=5, length=45)
    assert str(long) == f"it is long\n  at position 5:\n    {text[:80]}\n         {'^' * 40}"
    none = kovacic.InputError("at the end", text="a\nb", position=3, length=0)
    assert str(none) == "at the end\n  at position 3:\n    a b\n       ^"
    assert (none.excerpt, kovacic.InputError("nowhere", text=text).excerpt) == ("", None)
