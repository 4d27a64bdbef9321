"""SymPy expressions as code of Mathematica, Maple and Julia, by SymPy's printers with corrections.

Maple's elliptic integrals take the sine of the amplitude and the modulus k, m = k^2; SymPy's the amplitude and m.
Julia's functions are those of SpecialFunctions.jl, HypergeometricFunctions.jl (pFq) and Elliptic.jl.  Functions that a language
lacks, or has with another meaning (the branches of Maple's LegendreP are others), are refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import count
from typing import Any

import sympy
from sympy.functions.special.bessel import BesselBase
from sympy.printing.julia import JuliaCodePrinter
from sympy.printing.maple import MapleCodePrinter
from sympy.printing.mathematica import MCodePrinter

from kovacic.errors import InputError

Expr = Any  # SymPy publishes no types

#: Functions that all of SymPy's printers write correctly.
_WRITTEN_BY_SYMPY = "exp log Abs sin cos tan cot sec csc asin acos atan sinh cosh tanh coth asinh acosh atanh"
#: SymPy's names with the others' names; E/1 is E with one argument.
_MATHEMATICA = """
    besselj BesselJ, bessely BesselY, besseli BesselI, besselk BesselK, jn SphericalBesselJ, yn SphericalBesselY,
    airyai AiryAi, airybi AiryBi, airyaiprime AiryAiPrime, airybiprime AiryBiPrime, erf Erf, erfc Erfc, erfi Erfi,
    Ei ExpIntegralEi, Si SinIntegral, Ci CosIntegral, gamma Gamma, uppergamma Gamma, fresnels FresnelS, fresnelc FresnelC,
    polylog PolyLog, sign Sign, elliptic_k EllipticK, elliptic_f EllipticF, elliptic_e EllipticE, elliptic_pi EllipticPi,
    assoc_legendre LegendreP, legendre LegendreP, assoc_laguerre LaguerreL, laguerre LaguerreL, hermite HermiteH,
    jacobi JacobiP, gegenbauer GegenbauerC, mathieuc MathieuC, mathieus MathieuS, mathieucprime MathieuCPrime,
    mathieusprime MathieuSPrime, hyper HypergeometricPFQ
"""
_MAPLE = """
    besselj BesselJ, bessely BesselY, besseli BesselI, besselk BesselK, airyai AiryAi, airybi AiryBi, erf erf, erfc erfc,
    erfi erfi, Ei Ei, Si Si, Ci Ci, gamma GAMMA, uppergamma GAMMA, fresnels FresnelS, fresnelc FresnelC, polylog polylog,
    sign signum, assoc_laguerre LaguerreL, laguerre LaguerreL, hermite HermiteH, jacobi JacobiP,
    gegenbauer GegenbauerC, mathieuc MathieuC, mathieus MathieuS, mathieucprime MathieuCPrime, mathieusprime MathieuSPrime,
    hyper hypergeom
"""
_JULIA = """
    besselj besselj, bessely bessely, besseli besseli, besselk besselk, jn sphericalbesselj, yn sphericalbessely,
    airyai airyai, airybi airybi, airyaiprime airyaiprime, airybiprime airybiprime, erf erf, erfc erfc, erfi erfi, Ei expinti,
    Si sinint, Ci cosint, gamma gamma, uppergamma gamma, sign sign, elliptic_k ellipk, elliptic_e/1 ellipe,
    elliptic_f Elliptic.F, elliptic_e/2 Elliptic.E, elliptic_pi/3 Elliptic.Pi, hyper pFq
"""


@dataclass(frozen=True)
class _Language:
    """The name, SymPy's printer, brackets around arguments, the names of functions, and those that mean something.

    `patterns` are for the printed arguments; E/1 is E with one argument.
    """

    name: str
    printer: Any
    calls: str
    assignment: str
    comment: str
    taken: str
    functions: str
    patterns: Mapping[str, str]


CODE_LANGUAGES = {
    "mathematica": _Language(
        "Mathematica", MCodePrinter, "[]", "{} = {};", "(* {} *)", "C D E I K N O Pi", _MATHEMATICA,
        {
            "lowergamma": "Gamma[{0}, 0, {1}]",
            "Heaviside": "UnitStep[{0}]",
            "Integral/2": "Integrate[{0}, {1}]",
            "Integral/4": "Integrate[{0}, {{{1}, {2}, {3}}}]",
            "RootSum": "RootSum[Function[{2}, {0}], Function[{2}, {1}]]",
        },
    ),
    "maple": _Language(
        "Maple", MapleCodePrinter, "()", "{} := {};", "# {}", "D I O Pi gamma Zeta Psi", _MAPLE,
        {
            "lowergamma": "(GAMMA({0}) - GAMMA({0}, {1}))",
            "Heaviside": "Heaviside({0})",
            "airyaiprime": "AiryAi(1, {0})",
            "airybiprime": "AiryBi(1, {0})",
            "elliptic_k": "EllipticK(sqrt({0}))",
            "elliptic_f": "EllipticF(sin({0}), sqrt({1}))",
            "elliptic_e/1": "EllipticE(sqrt({0}))",
            "elliptic_e/2": "EllipticE(sin({0}), sqrt({1}))",
            "elliptic_pi/2": "EllipticPi({0}, sqrt({1}))",
            "elliptic_pi/3": "EllipticPi(sin({1}), {0}, sqrt({2}))",
            "Integral/2": "Int({0}, {1})",
            "Integral/4": "Int({0}, {1} = {2} .. {3})",
            "RootSum": "sum({1}, {2} = RootOf({0}, {2}))",
        },
    ),
    "julia": _Language(
        "Julia", JuliaCodePrinter, "()", "{}(x) = {}", "# {}", "im pi e gamma", _JULIA,
        {"lowergamma": "(gamma({0}) - gamma({0}, {1}))"},
    ),
}  # fmt: skip


def as_code(expression: Expr, language: str) -> str:
    """A SymPy expression as code of another system.

    Parameters
    ----------
    expression : sympy.Expr
        A solution of `solutions`, `special`, `dsolve(...).rhs` and others.
    language : str
        "mathematica", "maple" or "julia" (with SpecialFunctions.jl, HypergeometricFunctions.jl and Elliptic.jl).

    Returns
    -------
    str
        One line, in which every function has its meaning in SymPy; elliptic integrals in Maple for amplitudes in [-pi/2, pi/2].

    Raises
    ------
    InputError
        For another language, for a function that the language lacks, and for a name that means something else in it.

    Examples
    --------
    >>> import kovacic
    >>> y1, y2 = kovacic.solve("(-32*x**2 + 27*x - 27)/(144*x**2*(x - 1)**2)").solutions
    >>> print(kovacic.as_code(y1, "mathematica"))
    x^(1/4)*(1 - x)^(1/3)*HypergeometricPFQ[{-1/12, 1/4}, {1/2}, x]
    >>> print(kovacic.as_code(y1, "maple"))
    x^(1/4)*(1 - x)^(1/3)*hypergeom([-1/12, 1/4], [1/2], x)
    """
    chosen = CODE_LANGUAGES.get(language)
    if chosen is None:
        raise InputError(f"unknown language {language!r}", hint=f"available: {', '.join(CODE_LANGUAGES)}")
    expression = sympy.sympify(expression, strict=True)
    for symbol in letters_to_rename(expression, language):
        raise InputError(f"{symbol.name} can't be the name of a letter in {chosen.name}", hint="rename it with subs")
    return str(_printer(chosen).doprint(expression))


def letters_to_rename(expression: Expr, language: str) -> dict[Expr, Expr]:
    """New letters for those whose names mean something else in the language: omega0 for omega_0 and E0 for E in Mathematica."""
    letters = sorted(expression.free_symbols, key=str)
    names, taken = {symbol.name for symbol in letters}, CODE_LANGUAGES[language].taken.split()
    found = {}
    for symbol in letters:
        is_pattern = "_" in symbol.name and language == "mathematica"
        if is_pattern or symbol.name in taken:
            short = symbol.name.replace("_", "") if is_pattern else f"{symbol.name}0"
            name = next(name for k in count() if (name := short + "0" * k) not in {*names, *taken})
            names.add(name)
            found[symbol] = sympy.Symbol(name)
    return found


def _printer(language: _Language) -> Any:
    """SymPy's printer for a language, which consults the table first and refuses functions outside of it."""
    # Patterns and names of functions by SymPy's.
    words = language.functions.replace(",", " ").split()
    known = {**dict(zip(words[::2], words[1::2], strict=True)), **language.patterns}

    class Printer(language.printer):  # type: ignore[misc, name-defined]
        def _print(self, expr: Expr, **options: Any) -> str:
            kind = type(expr).__name__
            arguments = _pattern_arguments(expr)
            own = known.get(kind) or known.get(f"{kind}/{len(arguments)}")
            if language.name == "Julia" and isinstance(expr, BesselBase) and expr.order.is_real is False:
                raise InputError(f"Julia's {kind} has no complex orders")
            if own is not None:
                printed = [*map(self._print, arguments)]
                return own.format(*printed) if "{0}" in own else own + ", ".join(printed).join(language.calls)
            is_foreign = isinstance(expr, sympy.CRootOf | sympy.RootSum | sympy.Integral | sympy.Derivative)
            if isinstance(expr, sympy.Function):
                is_foreign = kind not in _WRITTEN_BY_SYMPY.split()
            if is_foreign:
                raise InputError(f"{language.name} has no {kind}, or one with another meaning")
            corrected = _in_julia(self._print, expr) if language.name == "Julia" else None
            return corrected or str(super()._print(expr, **options))

    return Printer({"contract": False} if language.name == "Julia" else {})


def _pattern_arguments(expr: Expr) -> tuple[Expr, ...]:
    """The arguments for a pattern.

    Of an integral: the integrand, the variable, and the ends if there are any; of a sum over roots: p, f(a), a new letter a.
    """
    if isinstance(expr, sympy.Integral) and len(expr.limits) == 1:
        return (expr.function, *expr.limits[0])
    if isinstance(expr, sympy.RootSum):
        used = {symbol.name for symbol in expr.free_symbols}
        a = next(sympy.Symbol(name) for name in "abcrst" if name not in used)
        return expr.poly.as_expr().xreplace({expr.poly.gen: a}), expr.fun(a), a
    return tuple(getattr(expr, "args", ()))


def _in_julia(shown: Any, expr: Expr) -> str | None:
    """Corrections of SymPy's Julia printer: e, multiples of i such as i*pi, and roots of negative numbers; None elsewhere."""
    if expr is sympy.E:
        return "exp(1)"
    if expr.is_Mul and expr.is_number and expr.is_imaginary:
        return f"({shown(expr / sympy.I)}) * im"
    if expr.is_Pow and expr.base.is_negative and not expr.exp.is_integer:
        return f"complex({shown(expr.base)}) ^ ({shown(expr.exp)})"
    return None
