"""Solvable potentials of the literature, with the energies that are printed there, as functions of n and the parameters.

A row: name, V, domain, what is assumed, the energy as printed, values of the parameters at which it is compared, source.
"""

from __future__ import annotations

from typing import NamedTuple

CKS = "F. Cooper, A. Khare & U. Sukhatme, Phys. Rep. 251 (1995) 267, table 4.1"
LINE = ("-oo", "oo")
HALF = (0, "oo")


class Solvable(NamedTuple):
    name: str
    V: str
    domain: tuple[object, object]
    assume: dict[str, str]
    energy: str
    values: dict[str, str]
    source: str
    boundary: str | None = None
    numbers: tuple[int, ...] = (0, 1, 2)


TABLE = [
    Solvable(
        "shifted oscillator", "w^2*(x - 2*b/w)^2/4 - w/2", LINE, {"w": "positive"}, "n*w", {"w": "3/2", "b": "1/3"}, CKS
    ),
    Solvable(
        "three-dimensional oscillator",
        "w^2*x^2/4 + l*(l+1)/x^2 - (l + 3/2)*w",
        HALF,
        {"w": "positive", "l": ">=1"},
        "2*n*w",
        {"w": "2", "l": "4/3"},
        CKS,
    ),
    Solvable(
        "Coulomb",
        "-q/x + l*(l+1)/x^2 + q^2/(4*(l+1)^2)",
        HALF,
        {"q": "positive", "l": ">=1/2"},
        "q^2/4*(1/(l+1)^2 - 1/(n+l+1)^2)",
        {"q": "5", "l": "1"},
        CKS,
    ),
    Solvable(
        "Morse",
        "A^2 + B^2*exp(-2*a*x) - 2*B*(A + a/2)*exp(-a*x)",
        LINE,
        {"A": "positive", "a": "positive", "B": "positive"},
        "A^2 - (A - n*a)^2",
        {"A": "7/2", "a": "1", "B": "2"},
        CKS,
    ),
    Solvable(
        "Scarf II",
        "A^2 + (B^2 - A^2 - A*a)*sech(a*x)^2 + B*(2*A + a)*sech(a*x)*tanh(a*x)",
        LINE,
        {"A": "positive", "a": "positive"},
        "A^2 - (A - n*a)^2",
        {"A": "10/3", "a": "1", "B": "1/2"},
        CKS,
    ),
    Solvable(
        "Rosen-Morse II",
        "A^2 + B^2/A^2 - A*(A + a)*sech(a*x)^2 + 2*B*tanh(a*x)",
        LINE,
        {"A": "positive", "a": "positive"},
        "A^2 - (A - n*a)^2 - B^2/(A - n*a)^2 + B^2/A^2",
        {"A": "4", "a": "1", "B": "1"},
        CKS,
    ),
    Solvable(
        "Eckart",
        "A^2 + B^2/A^2 - 2*B*coth(a*x) + A*(A - a)*csch(a*x)^2",
        HALF,
        {"A": "positive", "a": "positive", "B": "positive"},
        "A^2 - (A + n*a)^2 - B^2/(A + n*a)^2 + B^2/A^2",
        {"A": "2", "a": "1", "B": "21"},
        CKS,
    ),
    Solvable(
        "Scarf I",
        "-A^2 + (A^2 + B^2 - A*a)*sec(a*x)^2 - B*(2*A - a)*tan(a*x)*sec(a*x)",
        ("-pi/(2*a)", "pi/(2*a)"),
        {"A": "positive", "a": "positive"},
        "(A + n*a)^2 - A^2",
        {"A": "4", "a": "1", "B": "3/2"},
        CKS,
    ),
    Solvable(
        "generalised Poeschl-Teller",
        "A^2 + (B^2 + A^2 + A*a)*csch(a*x)^2 - B*(2*A + a)*coth(a*x)*csch(a*x)",
        HALF,
        {"A": "positive", "a": "positive"},
        "A^2 - (A - n*a)^2",
        {"A": "10/3", "a": "1", "B": "6"},
        CKS,
    ),
    Solvable(
        "Rosen-Morse I",
        "A*(A - a)*csc(a*x)^2 + 2*B*cot(a*x) - A^2 + B^2/A^2",
        (0, "pi/a"),
        {"A": "positive", "a": "positive"},
        "(A + n*a)^2 - A^2 + B^2/A^2 - B^2/(A + n*a)^2",
        {"A": "5/2", "a": "1", "B": "2"},
        CKS,
    ),
]
MORE = [
    Solvable(
        "hydrogen",
        "-Z/x",
        HALF,
        {"Z": "positive"},
        "-Z^2/(4*(n + 1)^2)",
        {"Z": "2"},
        "E. Schroedinger, Ann. Phys. 79 (1926) 361",
        "friedrichs",
    ),
    Solvable(
        "Coulomb, every l",
        "l*(l+1)/x^2 - Z/x",
        HALF,
        {"Z": "positive", "l": ">=1"},
        "-Z^2/(4*(n + l + 1)^2)",
        {"Z": "3", "l": "2"},
        "E. Schroedinger, Ann. Phys. 79 (1926) 361",
    ),
    Solvable(
        "Kratzer",
        "-2*D*(b/x - b^2/(2*x^2)) + l*(l+1)/x^2",
        HALF,
        {"D": "positive", "b": "positive", "l": ">=1"},
        "-4*D^2*b^2/(2*n + 1 + sqrt((2*l + 1)^2 + 4*D*b^2))^2",
        {"D": "5", "b": "2", "l": "1"},
        "A. Kratzer, Z. Phys. 3 (1920) 289; S. Fluegge, Practical Quantum Mechanics, problem 69",
    ),
    Solvable(
        "Hulthen",
        "-U*exp(-x/b)/(1 - exp(-x/b))",
        HALF,
        {"b": "positive", "U": "positive"},
        "-(U*b^2 - (n + 1)^2)^2/(4*b^2*(n + 1)^2)",
        {"b": "2", "U": "5"},
        "L. Hulthen, Ark. Mat. Astron. Fys. 28A (1942) 5; S. Fluegge, problem 68",
        "friedrichs",
    ),
    Solvable(
        "Manning-Rosen",
        "c*(c - 1)*exp(-2*x)/(1 - exp(-x))^2 - U*exp(-x)/(1 - exp(-x))",
        HALF,
        {"c": ">=3/2", "U": "positive"},
        "-((U + c*(c-1) - (n + c)^2)/(2*(n + c)))^2",
        {"c": "2", "U": "30"},
        "M. F. Manning & N. Rosen, Phys. Rev. 44 (1933) 953",
    ),
    Solvable(
        "isotonic oscillator",
        "U*(x/b - b/x)^2",
        HALF,
        {"U": "positive", "b": "positive"},
        "sqrt(U)/b*(4*n + 2 + sqrt(4*U*b^2 + 1)) - 2*U",
        {"U": "3", "b": "1"},
        "Y. Weissman & J. Jortner, Phys. Lett. A 70 (1979) 177; I. I. Goldman & V. D. Krivchenkov (1961)",
    ),
    Solvable(
        "Poeschl-Teller, trigonometric",
        "K*(K-1)/sin(x)^2 + M*(M-1)/cos(x)^2",
        (0, "pi/2"),
        {"K": ">=3/2", "M": ">=3/2"},
        "(K + M + 2*n)^2",
        {"K": "2", "M": "8/3"},
        "G. Poeschl & E. Teller, Z. Phys. 83 (1933) 143",
    ),
    Solvable(
        "Poeschl-Teller, hyperbolic",
        "K*(K-1)/sinh(x)^2 - M*(M+1)/cosh(x)^2",
        HALF,
        {"K": ">=3/2", "M": "positive"},
        "-(M - K - 2*n)^2",
        {"K": "2", "M": "15/2"},
        "G. Poeschl & E. Teller, Z. Phys. 83 (1933) 143",
    ),
    Solvable(
        "modified Poeschl-Teller well",
        "-b^2*s*(s+1)/cosh(b*x)^2",
        LINE,
        {"b": "positive", "s": "positive"},
        "-b^2*(s - n)^2",
        {"b": "1", "s": "10/3"},
        "L. D. Landau & E. M. Lifshitz, Quantum Mechanics, section 23, problem 5",
    ),
    Solvable(
        "Morse's own",
        "D*(exp(-2*b*x) - 2*exp(-b*x))",
        LINE,
        {"D": "positive", "b": "positive"},
        "-D*(1 - b/sqrt(D)*(n + 1/2))^2",
        {"D": "12", "b": "1"},
        "P. M. Morse, Phys. Rev. 34 (1929) 57",
    ),
    Solvable(
        "cotangent squared",
        "U*cot(x)^2",
        (0, "pi"),
        {"U": ">=1"},
        "(n + (1 + sqrt(1 + 4*U))/2)^2 - U",
        {"U": "3"},
        "S. Fluegge, Practical Quantum Mechanics, problem 39: (n + s)^2 - U, s(s - 1) = U",
    ),
    Solvable(
        "Deng-Fan",
        "D*(1 - c/(exp(x) - 1))^2",
        HALF,
        {"D": "positive", "c": "positive"},
        "D - ((D*c*(c + 2) - (n + (1 + sqrt(1 + 4*D*c^2))/2)^2)/(2*(n + (1 + sqrt(1 + 4*D*c^2))/2)))^2",
        {"D": "20", "c": "1"},
        "Z. H. Deng & Y. P. Fan, Shandong Univ. J. 7 (1957) 162",
    ),
    Solvable(
        "generalised Woods-Saxon on the line",
        "-U/(1 + exp(x)) - W*exp(x)/(1 + exp(x))^2",
        LINE,
        {"U": "positive", "W": "positive"},
        "-((sqrt(1 + 4*W) - 2*n - 1)/4 + U/(sqrt(1 + 4*W) - 2*n - 1))^2",
        {"U": "1", "W": "20"},
        "C. Berkdemir, A. Berkdemir & R. Sever, Phys. Rev. C 72 (2005) 027001",
    ),
    Solvable(
        "Kepler on the sphere",
        "l*(l+1)/sin(x)^2 - 2*Z*cot(x)",
        (0, "pi"),
        {"l": ">=1"},
        "(n + l + 1)^2 - Z^2/(n + l + 1)^2",
        {"l": "1", "Z": "2"},
        "E. Schroedinger, Proc. R. Ir. Acad. 46A (1940) 9",
    ),
    Solvable(
        "Kepler in hyperbolic space",
        "l*(l+1)/sinh(x)^2 - 2*Z*coth(x)",
        HALF,
        {"l": ">=1", "Z": "positive"},
        "-(n + l + 1)^2 - Z^2/(n + l + 1)^2",
        {"l": "1", "Z": "30"},
        "L. Infeld & A. Schild, Phys. Rev. 67 (1945) 121",
    ),
    Solvable(
        "half oscillator",
        "x^2",
        HALF,
        {},
        "4*n + 3",
        {},
        "S. Fluegge, Practical Quantum Mechanics, problem 30",
        "friedrichs",
    ),
    Solvable(
        "symmetric trigonometric well",
        "s*(s-1)*sec(x)^2",
        ("-pi/2", "pi/2"),
        {"s": ">=3/2"},
        "(n + s)^2",
        {"s": "2"},
        "M. M. Nieto & L. M. Simmons, Phys. Rev. D 20 (1979) 1332",
    ),
    Solvable(
        "rational extension of the oscillator",
        "x^2 + 8*(2*x^2 - 1)/(2*x^2 + 1)^2",
        LINE,
        {},
        "2*n + 3",
        {},
        "J. F. Carinena, A. M. Perelomov, M. F. Ranada & M. Santander, J. Phys. A 41 (2008) 085301",
        None,
        (1, 2, 3),
    ),
    Solvable(
        "exceptional Laguerre polynomials X_1",
        "x^2 + l*(l+1)/x^2 + 4/(x^2 + l + 1/2) - 8*(l + 1/2)/(x^2 + l + 1/2)^2",
        HALF,
        {"l": ">=1"},
        "4*n + 2*l + 3",
        {"l": "4/3"},
        "C. Quesne, J. Phys. A 41 (2008) 392001",
    ),
]
#: Of some potentials only some levels are known: V, domain, degree, the polynomial of the energies as printed, source.
QUASI = [
    ("x^6 - 7*x^2", LINE, 2, "E^2 - 8", "A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467"),
    ("x^6 - 11*x^2", LINE, 4, "E^3 - 64*E", "A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467"),
    ("x^6 + 2*x^4 - 6*x^2", LINE, 2, "E^2 - 6*E - 3", "A. G. Ushveridze, Quasi-exactly Solvable Models (1994)"),
    ("(cosh(2*x) - 3)^2", LINE, 2, "(E - 6)*(E^2 - 16*E + 44)", "M. Razavy, Amer. J. Phys. 48 (1980) 285"),
    ("(sqrt(2)*cosh(2*x) - 3)^2", LINE, 2, "(E - 3)*(E - 7)*(E - 15)", "M. Razavy, Amer. J. Phys. 48 (1980) 285"),
    ("(2*cosh(2*x) - 2)^2", LINE, 1, "(E - 3)*(E - 11)", "M. Razavy, Amer. J. Phys. 48 (1980) 285"),
    ("x^6 + 6/x^2 - 13*x^2", HALF, 2, "E^2 - 56", "A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467"),
]
