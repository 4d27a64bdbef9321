"""The literature, and what of it an answer has used."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kovacic.decision import NoInvariant, NoRationalOmega, Structure

if TYPE_CHECKING:
    from kovacic.solution import Solution


@dataclass(frozen=True)
class Reference:
    """One publication; `use` says for what this package uses it."""

    key: str
    authors: str
    title: str
    where: str
    year: int
    use: str

    def text(self) -> str:
        return f"[{self.key}] {self.authors}, {self.title}, {self.where} ({self.year}): {self.use}."

    def bibtex(self) -> str:
        authors = self.authors.replace(", ", " and ")
        return (
            f"@article{{{self.key},\n  author = {{{authors}}},\n  title = {{{self.title}}},\n"
            f"  journal = {{{self.where}}},\n  year = {{{self.year}}}\n}}"
        )


_JSC = "Journal of Symbolic Computation"
KOVACIC = Reference(
    "Kov86",
    "J. J. Kovacic",
    "An algorithm for solving second order linear homogeneous differential equations",
    f"{_JSC} 2, 3-43",
    1986,
    "the algorithm, its cases and the necessary conditions",
)
SINGER_ULMER = Reference(
    "SU93",
    "M. F. Singer, F. Ulmer",
    "Liouvillian and algebraic solutions of second and third order linear differential equations",
    f"{_JSC} 16, 37-73",
    1993,
    "the invariants of the finite primitive groups",
)
ULMER_WEIL = Reference(
    "UW96",
    "F. Ulmer, J.-A. Weil",
    "Note on Kovacic's algorithm",
    f"{_JSC} 22, 179-200",
    1996,
    "the cases by invariants",
)
HOEIJ_WEIL = Reference(
    "HW97",
    "M. van Hoeij, J.-A. Weil",
    "An algorithm for computing invariants of differential Galois groups",
    "Journal of Pure and Applied Algebra 117-118, 353-379",
    1997,
    "rational invariants without a search over exponents",
)
HENDRIKS_PUT = Reference(
    "HvdP95",
    "P. A. Hendriks, M. van der Put",
    "Galois action on solutions of a differential equation",
    f"{_JSC} 19, 559-576",
    1995,
    "omega from an invariant of degree 2",
)
HOEIJ = Reference(
    "vH97",
    "M. van Hoeij",
    "Factorization of differential operators with rational functions coefficients",
    f"{_JSC} 24, 537-561",
    1997,
    "a unique omega from its expansion at one place",
)
CLUZEAU_HOEIJ = Reference(
    "CvH04",
    "T. Cluzeau, M. van Hoeij",
    "A modular algorithm for computing the exponential solutions of a linear differential operator",
    f"{_JSC} 38, 1043-1076",
    2004,
    "the computation modulo primes",
)
KLEIN_FORM = Reference(
    "HW05",
    "M. van Hoeij, J.-A. Weil",
    "Solving second order linear differential equations with Klein's theorem",
    "Proceedings of ISSAC 2005, 340-347",
    2005,
    "the solutions by hypergeometric functions",
)
DAVENPORT = Reference(
    "Dav81",
    "J. H. Davenport",
    "On the Integration of Algebraic Functions",
    "Lecture Notes in Computer Science 102",
    1981,
    "the order of a dicyclic group by torsion modulo primes",
)
CANTOR = Reference(
    "Can87",
    "D. G. Cantor",
    "Computing in the Jacobian of a hyperelliptic curve",
    "Mathematics of Computation 48, 95-101",
    1987,
    "the order of a divisor modulo a prime",
)


def references(solution: Solution) -> tuple[Reference, ...]:
    """What the answer rests on; for the group as well, if it was asked for."""
    decision = solution.decision
    evidence = [item for exclusion in decision.exclusions for item in exclusion.evidence]
    used = [KOVACIC]
    if decision.invariant is not None or any(isinstance(item, NoInvariant) for item in evidence):
        used += [ULMER_WEIL, HOEIJ_WEIL]
    unique = decision.structure is Structure.REDUCIBLE and decision.invariant is None
    if unique or any(isinstance(item, NoRationalOmega) for item in evidence):
        used += [HOEIJ, CLUZEAU_HOEIJ]
    elif decision.structure is Structure.REDUCIBLE:
        used.append(HENDRIKS_PUT)
    if solution.case == 3:
        used.append(SINGER_ULMER)
    if solution.case == 3 and "closed_form" in solution.__dict__:
        used.append(KLEIN_FORM)
    group = solution.__dict__.get("group")
    if group is not None and group.ground.name in ("NOT_TORSION", "INVARIANT", "NO_INVARIANT"):
        used += [DAVENPORT, CANTOR]
    return tuple(used)


def citation(solution: Solution, *, style: str = "text") -> str:
    """The references of an answer, one a line, or as BibTeX (`style="bibtex"`)."""
    if style == "text":
        return "\n".join(reference.text() for reference in references(solution))
    if style == "bibtex":
        return "\n\n".join(reference.bibtex() for reference in references(solution))
    raise ValueError(f"the style is 'text' or 'bibtex', not {style!r}")
