"""The algebraic groups that occur as differential Galois groups of y'' = S y: subgroups of SL2(C), up to conjugation.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), section 1.2 and 4; M. F. Singer and F. Ulmer, J. Symb. Comp. 16 (1993).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any, NamedTuple

from kovacic.decision import CurveFunction, GroupClaim, SemiInvariant
from kovacic.numbers.numerals import digits


class GroupKind(Enum):
    """The families of algebraic subgroups of SL2(C)."""

    CYCLIC = "cyclic"
    MULTIPLICATIVE = "multiplicative"
    ADDITIVE = "additive"
    BOREL = "borel"
    DICYCLIC = "dicyclic"
    INFINITE_DIHEDRAL = "infinite dihedral"
    IMPRIMITIVE = "imprimitive"
    TETRAHEDRAL = "tetrahedral"
    OCTAHEDRAL = "octahedral"
    ICOSAHEDRAL = "icosahedral"
    SL2 = "SL2"


class Ground(Enum):
    """Why the group is this one and no other; the sentence speaks of omega = y'/y and of u = y1/y2."""

    RESIDUES = "omega has simple poles with rational residues only, and n is their common denominator"
    IRRATIONAL = "omega has a residue that isn't rational, so no power of y1 is a rational function"
    EXPONENTIAL = (
        "omega has a pole of order two or more (perhaps at infinity), so no power of y1 is a rational function"
    )
    ALL_INVARIANT = "all quadratic forms in the solutions are rational functions"
    GENUS_ZERO = (
        "the differential of log u on a curve of genus 0 has rational residues, and n is their common denominator"
    )
    IRREGULAR = "an irregular singular point, so the group is infinite"
    IRRATIONAL_EXPONENT = "an exponent difference that isn't rational, so a local monodromy has infinite order"
    FIRST_KIND = "the differential of log u has no poles, so u isn't algebraic"
    NOT_TORSION = "the divisor of the differential of log u has different orders modulo two primes, so it isn't torsion"
    HOLOMORPHIC_REST = (
        "a multiple of the differential of log u is that of the logarithm of a function and a differential without poles, so u"
        " isn't algebraic"
    )
    THREE_PAIRS = "the conjugates of y1 y2 are further products of two solutions, so three pairs are permuted"
    FUNCTION = "u^n is a function on the curve that isn't a power of another one"
    UNDETERMINED = "no function was found that is a power of u, and none was excluded"
    PRIMITIVE = "the rational invariant of least degree"
    NO_LIOUVILLIAN = "there is no Liouvillian solution"


_UPPER = "the upper triangular matrices with c and 1/c on the diagonal, "


class _Facts(NamedTuple):
    """The texts about a kind, with places for n and the order, its dimension, and its order if that is fixed."""

    name: str
    latex: str
    description: str
    dimension: int | None = 0
    order: int | None = None


_FACTS = {
    GroupKind.CYCLIC: _Facts("mu_{n}", r"\mu_{{{n}}}", "the cyclic group of order {n}"),
    GroupKind.MULTIPLICATIVE: _Facts("G_m", r"\mathbb{{G}}_m", "the diagonal matrices of determinant 1", 1),
    GroupKind.ADDITIVE: _Facts("G_a extended by mu_{n}", r"\mathbb{{G}}_a \rtimes \mu_{{{n}}}", _UPPER + "c^{n} = 1", 1),
    GroupKind.BOREL: _Facts("Borel", r"\mathbb{{G}}_a \rtimes \mathbb{{G}}_m",
                            "all upper triangular matrices of determinant 1", 2),
    GroupKind.DICYCLIC: _Facts("dicyclic of order {order}", r"\mathrm{{Dic}}_{{{n}}}", "the dicyclic group of order {order}"),
    GroupKind.INFINITE_DIHEDRAL: _Facts("N(T)", "N(T)",
                                        "the normaliser of the diagonal matrices, the infinite dihedral group", 1),
    GroupKind.IMPRIMITIVE: _Facts("dicyclic or N(T), order not determined", r"\subseteq N(T)",
                                  "a subgroup of N(T), dicyclic if it is finite; its order wasn't determined", None),
    GroupKind.TETRAHEDRAL: _Facts("SL(2,3)", r"\mathrm{{SL}}(2,3)", "the binary tetrahedral group", 0, 24),
    GroupKind.OCTAHEDRAL: _Facts("binary octahedral", "2O", "the binary octahedral group", 0, 48),
    GroupKind.ICOSAHEDRAL: _Facts("SL(2,5)", r"\mathrm{{SL}}(2,5)", "the binary icosahedral group", 0, 120),
    GroupKind.SL2: _Facts("SL2", r"\mathrm{{SL}}_2(\mathbb{{C}})", "all matrices of determinant 1", 3),
}  # fmt: skip
#: Where a small n has a name of its own.
_FACTS_FOR_SMALL_N = {
    (GroupKind.CYCLIC, 1): _Facts("trivial", r"\{{1\}}", "the trivial group"),
    (GroupKind.ADDITIVE, 1): _Facts("G_a", r"\mathbb{{G}}_a", _UPPER + "c = 1", 1),
    (GroupKind.ADDITIVE, 2): _FACTS[GroupKind.ADDITIVE]._replace(description=_UPPER + "c = 1 or -1"),
    (GroupKind.DICYCLIC, 2): _FACTS[GroupKind.DICYCLIC]._replace(description="the quaternion group of order {order}"),
}


@dataclass(frozen=True)
class Group:
    """A subgroup of SL2(C) up to conjugation.

    Attributes
    ----------
    kind : GroupKind
        The family.  GroupKind.IMPRIMITIVE says that the order wasn't determined: then n is the least value that wasn't
        excluded, and the group may be infinite.
    ground : Ground
        Why it is this one and no other; its value is a sentence.
    n : int or None
        The parameter of the family where it has one: the order of the cyclic group or of the component group of
        {(c, b; 0, 1/c): c^n = 1}, and a quarter of the order of a dicyclic group.
    form : SemiInvariant or None
        The rational form of degree 2 of a reducible group, if there is one.
    orders : tuple of pairs
        On a curve of positive genus, primes p with the orders of the divisor of u = y1/y2 modulo p.
    function : CurveFunction or None
        On such a curve, u^n, or what shows that no power of u is a function.

    Examples
    --------
    >>> import kovacic
    >>> group = kovacic.solve("-3/(16*x^2)").group
    >>> group.name, group.order, group.finite, group.dimension, group.description
    ('mu_4', 4, True, 0, 'the cyclic group of order 4')
    >>> group
    <Group mu_4>
    >>> group.generators()
    (Matrix([
    [I,  0],
    [0, -I]]),)
    """

    kind: GroupKind
    ground: Ground
    n: int | None = None
    form: SemiInvariant | None = field(default=None, compare=False, repr=False)
    orders: tuple[tuple[int, int], ...] = field(default=(), compare=False, repr=False)
    function: CurveFunction | None = field(default=None, compare=False, repr=False)

    @property
    def claim(self) -> GroupClaim:
        """The claim that the kernel checks."""
        evidence = (self.form, self.orders, self.function)
        return GroupClaim(self.kind.value, self.n, *evidence, order=self.order, dimension=self.dimension)

    @property
    def _facts(self) -> _Facts:
        return _FACTS_FOR_SMALL_N.get((self.kind, self.n or 0), _FACTS[self.kind])

    @property
    def name(self) -> str:
        """A short name in plain characters: `mu_4`, `G_m`, `G_a extended by mu_3`, `dicyclic of order 12`, `SL(2,3)`."""
        return self._filled(self._facts.name)

    @property
    def latex(self) -> str:
        """The name for formulas."""
        return self._filled(self._facts.latex)

    @property
    def description(self) -> str:
        """One phrase for a reader who doesn't know the name."""
        return self._filled(self._facts.description)

    def _filled(self, text: str) -> str:
        """The text with the order and the number of the family in it."""
        n, order = (None if number is None else digits(number) for number in (self.n, self.order))
        return text.format(n=n, order=order)

    @property
    def order(self) -> int | None:
        """The number of elements; None if that is infinite or not determined (see `finite`)."""
        if self.kind is GroupKind.DICYCLIC and self.n is not None:
            return 4 * self.n
        return self.n if self.kind is GroupKind.CYCLIC else self._facts.order

    @property
    def finite(self) -> bool | None:
        """True if the group is finite, so that all solutions are algebraic functions; None if that wasn't determined."""
        return None if self.kind is GroupKind.IMPRIMITIVE else self.order is not None

    @property
    def order_at_least(self) -> int | None:
        """A lower bound for the order where it wasn't determined."""
        return 4 * self.n if self.kind is GroupKind.IMPRIMITIVE and self.n is not None else None

    @property
    def dimension(self) -> int | None:
        """The dimension as an algebraic group; 0 for a finite one, None if it wasn't determined."""
        return self._facts.dimension

    def generators(self) -> tuple[Any, ...] | None:
        """SymPy matrices that generate the group, acting on (y1, y2) suitably chosen and scaled.

        For a finite group they generate it; for G_m there is one, with a free parameter t; None for the other groups.  The
        diagonal ones are diagonal in the basis of the solutions with y'/y rational (cyclic, G_m) or of degree 2 (dicyclic);
        the bases of the primitive groups are those of Klein's forms [Ikosaeder (1884), part I, chapter II].
        """
        import sympy

        I = sympy.I  # noqa: E741 - SymPy's name
        half = sympy.Rational(1, 2)
        swap = sympy.Matrix([[0, 1], [-1, 0]])
        if self.kind is GroupKind.CYCLIC:
            return () if self.n == 1 else (_rotation(self.n),)
        if self.kind is GroupKind.MULTIPLICATIVE:
            t = sympy.Symbol("t", nonzero=True)
            return (sympy.diag(t, 1 / t),)
        if self.kind is GroupKind.DICYCLIC and self.n is not None:
            return (_rotation(2 * self.n), swap)
        third = half * sympy.Matrix([[-1 - I, -1 - I], [1 - I, -1 + I]])
        if self.kind is GroupKind.TETRAHEDRAL:
            return (sympy.diag(I, -I), swap, third)
        if self.kind is GroupKind.OCTAHEDRAL:
            return (_rotation(8), swap, third)
        if self.kind is GroupKind.ICOSAHEDRAL:
            z = sympy.exp(2 * sympy.pi * I / 5)
            T = sympy.Matrix([[z**4 - z, z**2 - z**3], [z**2 - z**3, z - z**4]]) / sympy.sqrt(5)
            return (-sympy.diag(z**3, z**2), T)
        return None

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<Group {self.name}>"

    def _repr_latex_(self) -> str:
        return f"${self.latex}$"


def _rotation(n: int | None) -> Any:
    import sympy

    z = sympy.exp(2 * sympy.pi * sympy.I / n)
    return sympy.diag(z, 1 / z)
