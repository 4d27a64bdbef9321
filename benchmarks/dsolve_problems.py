"""150 textbook problems: linear equations of second order with rational coefficients, as books and handbooks set them.

Sources, by section: BDP: Boyce, DiPrima & Meade, Elementary Differential Equations and Boundary Value Problems (11th ed.);
Zill: A First Course in Differential Equations; Kamke: Differentialgleichungen, Loesungsmethoden und Loesungen I, ch. C.2;
DLMF: https://dlmf.nist.gov; SymPy: its tests of dsolve; Kovacic: J. Symb. Comp. 2 (1986).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Problem:
    """An equation in y(x); `given` as "y(0)=1, y'(0)=2"; `expected` "none": no solution exists.

    Parameters are positive; with `assume` "n natural" n is a natural number; with "plain" nothing is assumed.
    """

    group: str
    source: str
    equation: str
    given: str = ""
    assume: str = ""
    expected: str = ""


_HOMOGENEOUS = {
    "BDP 3.1": """y''+2*y'-3*y=0; y''+3*y'+2*y=0; 6*y''-y'-y=0; 4*y''-9*y=0; y''-2*y'-2*y=0""",
    "BDP 3.3": """y''-2*y'+2*y=0; y''+6*y'+13*y=0; y''+4*y'+25/4*y=0; y''+y'+5/4*y=0""",
    "BDP 3.4": """y''-2*y'+y=0; 9*y''+6*y'+y=0; y''-6*y'+9*y=0""",
    "BDP 5.4": """x^2*y''+4*x*y'+2*y=0; (x+1)^2*y''+3*(x+1)*y'+3/4*y=0; x^2*y''-3*x*y'+4*y=0; x^2*y''+6*x*y'-y=0;
        (x-2)^2*y''+5*(x-2)*y'+8*y=0; x^2*y''+2*x*y'+4*y=0""",
    "BDP 3.7, with letters": """y''+w^2*y=0; y''-k^2*y=0; y''+2*b*y'+w^2*y=0; x^2*y''+x*y'-n^2*y=0; x^2*y''+x*y'+w^2*y=0""",
    "BDP 3.4, reduction of order": """x^2*y''-4*x*y'+6*y=0; x*y''-y'+4*x^3*y=0;
        (x-1)*y''-x*y'+y=0; x^2*y''-(x-3/16)*y=0; x^2*y''-x*(x+2)*y'+(x+2)*y=0""",
    "Kovacic, examples": """y''=(x^2+3)*y; y''=(4*x^6-8*x^5+12*x^4+4*x^3+7*x^2-20*x+4)/(4*x^4)*y; y''=(1/x-3/(16*x^2))*y;
        y''=(-3/(16*x^2)-2/(9*(x-1)^2)+3/(16*x*(x-1)))*y""",
    "Kamke C.2": """y''-2*x*y'+2*y=0; y''+4*x*y'+(4*x^2+2)*y=0; x*y''+2*y'-x*y=0; 4*x*y''+2*y'+y=0; (x^2+1)*y''-2*x*y'+2*y=0;
        (1-x^2)*y''-x*y'+4*y=0; (1-x^2)*y''-2*x*y'+2*y=0; x^4*y''+y=0; x*y''-(x+2)*y'+2*y=0; (x^2+1)^2*y''+3*y=0;
        y''-x*y'+y=0; x^2*y''+x*y'+(x^2-9/4)*y=0; (1-x^2)*y''-3*x*y'+8*y=0""",
}

_RIGHT = {
    "BDP 3.5": """y''-2*y'-3*y=3*exp(2*x); y''+2*y'+5*y=3*sin(2*x); y''-2*y'-3*y=-3*x*exp(-x); y''+2*y'=3+4*sin(2*x);
        y''+9*y=x^2*exp(3*x)+6; y''+2*y'+y=2*exp(-x); 2*y''+3*y'+y=x^2+3*sin(x); y''+y=3*sin(2*x)+x*cos(2*x);
        y''+y'+4*y=2*sinh(x); y''-y'-2*y=cosh(2*x); y''+w^2*y=cos(v*x); y''+w^2*y=cos(w*x)""",
    "BDP 3.6": """y''-5*y'+6*y=2*exp(x); y''+y=tan(x); y''+9*y=9*sec(3*x)^2; y''+4*y'+4*y=exp(-2*x)/x^2; y''+4*y=3*csc(2*x);
        4*y''+y=2*sec(x/2); y''-2*y'+y=exp(x)/(1+x^2); x^2*y''-2*y=3*x^2-1; x^2*y''-x*(x+2)*y'+(x+2)*y=2*x^3;
        x*y''-(1+x)*y'+y=x^2*exp(2*x); (1-x)*y''+x*y'-y=2*(x-1)^2*exp(-x); x^2*y''-3*x*y'+4*y=x^2*log(x);
        x^2*y''+x*y'+(x^2-1/4)*y=3*x^(3/2)*sin(x)""",
    "Zill 4.6": """y''-y=1/x; y''+3*y'+2*y=1/(1+exp(x)); y''+3*y'+2*y=sin(exp(x)); y''+2*y'+y=exp(-x)*log(x);
        y''-y=exp(x^2); 3*y''-6*y'+6*y=exp(x)*sec(x); x^2*y''+x*y'+y=log(x); x^2*y''-2*y=x^3*exp(x)""",
}

_INITIAL = {
    "BDP 3.1": """y''+y'-2*y=0 | y(0)=1, y'(0)=1; y''+5*y'+3*y=0 | y(0)=1, y'(0)=0; y''+8*y'-9*y=0 | y(1)=1, y'(1)=0;
        4*y''-y=0 | y(-2)=1, y'(-2)=-1""",
    "BDP 3.3": """y''+4*y=0 | y(0)=0, y'(0)=1; y''-2*y'+5*y=0 | y(pi/2)=0, y'(pi/2)=2; y''+y=0 | y(pi/3)=2, y'(pi/3)=-4;
        y''+2*b*y'+(b^2+1)*y=0 | y(0)=1, y'(0)=0""",
    "BDP 3.4": """9*y''-12*y'+4*y=0 | y(0)=2, y'(0)=-1; y''+4*y'+4*y=0 | y(-1)=2, y'(-1)=1""",
    "BDP 3.5": """y''+y'-2*y=2*x | y(0)=0, y'(0)=1; y''+4*y=x^2+3*exp(x) | y(0)=0, y'(0)=2;
        y''-2*y'+y=x*exp(x)+4 | y(0)=1, y'(0)=1; y''+4*y=3*sin(2*x) | y(0)=2, y'(0)=-1;
        y''+2*y'+5*y=4*exp(-x)*cos(2*x) | y(0)=1, y'(0)=0""",
    "BDP 5.4": """2*x^2*y''+x*y'-3*y=0 | y(1)=1, y'(1)=4; 4*x^2*y''+8*x*y'+17*y=0 | y(1)=2, y'(1)=-3;
        x^2*y''-3*x*y'+4*y=0 | y(-1)=2, y'(-1)=3; x^2*y''+3*x*y'+5*y=0 | y(1)=1, y'(1)=-1""",
    "BDP 6.4": """y''+y=Heaviside(x-3*pi) | y(0)=1, y'(0)=0; y''+3*y'+2*y=Heaviside(x-2) | y(0)=0, y'(0)=1;
        y''+4*y=sin(x)-Heaviside(x-2*pi)*sin(x-2*pi) | y(0)=0, y'(0)=0""",
    "BDP 6.5": """y''+2*y'+2*y=DiracDelta(x-pi) | y(0)=1, y'(0)=0; y''-y=-20*DiracDelta(x-3) | y(0)=1, y'(0)=0;
        y''+4*y=DiracDelta(x-pi)-DiracDelta(x-2*pi) | y(0)=0, y'(0)=0;
        y''+3*y'+2*y=DiracDelta(x-5)+Heaviside(x-10) | y(0)=0, y'(0)=1/2""",
    "Zill 4.6": """y''-y=1/x | y(1)=0, y'(1)=0; (1-x^2)*y''-2*x*y'+2*y=0 | y(0)=0, y'(0)=1""",
}

_BOUNDARY = {
    "BDP 10.1": """y''+2*y=0 | y(0)=1, y(pi)=0; y''+y=0 | y(0)=1, y(pi)=-1; y''+y=0 | y(0)=0, y'(pi)=1;
        y''+2*y=0 | y'(0)=1, y'(pi)=0; y''+2*y=x | y(0)=0, y(pi)=0; y''+4*y=sin(x) | y(0)=0, y(pi)=0;
        x^2*y''-2*x*y'+2*y=0 | y(1)=-1, y(2)=1; x^2*y''+3*x*y'+y=x^2 | y(1)=0, y(2)=0;
        y''+y=0 | y(0)=1, y(pi)=3 | none; y''+y=x | y(0)=0, y(pi)=0 | none; y''+4*y=cos(x) | y(0)=0, y(pi)=0 | none""",
}

_SPECIAL = {
    "DLMF 9.2": """y''=x*y; y''+x*y=0; y''=(2*x+3)*y""",
    "DLMF 10.2": """x^2*y''+x*y'+x^2*y=0; x^2*y''+x*y'+(x^2-4)*y=0; x^2*y''+x*y'+(x^2-1/9)*y=0; x^2*y''+x*y'+(x^2-n^2)*y=0""",
    "DLMF 10.25": """x^2*y''+x*y'-(x^2+1)*y=0; x^2*y''+x*y'-(x^2+n^2)*y=0""",
    "DLMF 10.13": """y''+x^2*y=0; y''+x^4*y=0; x*y''+y=0; x^2*y''+x*y'+(x^4-4)*y=0""",
    "DLMF 10.47, natural n": """x^2*y''+2*x*y'+(x^2-n*(n+1))*y=0""",
    "DLMF 12.2": """y''=(x^2/4+1)*y; y''=(x^2/4+a)*y""",
    "DLMF 13.2": """x*y''+(b-x)*y'-a*y=0; x*y''+(2-x)*y'-1/3*y=0""",
    "DLMF 13.14": """y''=(1/4-1/x+2/x^2)*y""",
    "DLMF 14.2": """(1-x^2)*y''-2*x*y'+3/4*y=0; (1-x^2)*y''-2*x*y'+v*(v+1)*y=0""",
    "DLMF 15.10": """x*(1-x)*y''+(c-(a+b+1)*x)*y'-a*b*y=0; x*(1-x)*y''+(1/2-2*x)*y'-1/3*y=0""",
    "DLMF 18.8, natural n": """y''-2*x*y'+2*n*y=0; (1-x^2)*y''-2*x*y'+n*(n+1)*y=0; x*y''+(1-x)*y'+n*y=0;
        (1-x^2)*y''-x*y'+n^2*y=0""",
    "SymPy, test_single": """x^2*y''+x*y'+(81*x^2-1/9)*y=0; x^2*y''-3*x*y'+(4*x+4)*y=0; (x-2)^2*y''-(x-2)*y'+4*(x-2)^2*y=0;
        x*(x-1)*y''+(3/2-2*x)*y'+2*y=0; x*(x-1)*y''+7/2*x*y'+y=0; x^2*y''+2*x*y'+(x^4-4)*y=0""",
}


def problems() -> list[Problem]:
    """The list."""
    found = []
    groups = {
        "homogeneous": _HOMOGENEOUS,
        "right-hand side": _RIGHT,
        "initial values": _INITIAL,
        "boundary values": _BOUNDARY,
        "special functions": _SPECIAL,
    }
    for group, by_source in groups.items():
        for source, texts in by_source.items():
            for text in texts.split(";"):
                equation, given, expected = (part.strip() for part in (*text.split("|"), "", "")[:3])
                natural = "n natural" if "natural" in source else ""
                found.append(Problem(group, source, equation, given, natural, expected))
    return found


def sympy_equations() -> list[Problem]:
    """Those linear equations of second order with rational coefficients that occur in SymPy 1.14's tests of its ODE module."""
    found, source = [], ""
    for line in (Path(__file__).parent / "sympy_equations.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            source = line[2:]
        else:
            found.append(Problem("SymPy's tests", source, line, assume="plain"))
    return found


if __name__ == "__main__":
    print(len(problems()), "problems,", len(sympy_equations()), "equations of SymPy's tests")
