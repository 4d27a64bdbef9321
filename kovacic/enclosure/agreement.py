"""Comparison of the monodromy with the differential Galois group: a numerical test of the engine, with proofs in balls.

What a verdict means:
- False is a proof that the group G isn't the one that was claimed.
- True: nothing contradicts it, and everything that can be seen in matrices was seen (the reason says what that is).
- None: the matrices can't tell, at this precision or at all.

Mathematics.  The monodromy group H is contained in G, and G is its Zariski closure where the equation is Fuchsian
[Schlesinger].  The proper algebraic subgroups of SL2(C) are reducible, or contained in N(T), or one of the three primitive
finite groups, and with A, B running through generators of H and their products,

    reducible   => tr [A, B] = 2 (a common eigenvector),            diagonal => [A, B] = 1,                     (1)
    within N(T) => [A^2, B^2] = 1 (squares are diagonal),           finite   => tr A = 2 cos(2 pi k/m), not 2 unless A = 1,

so a ball that excludes one of these excludes the groups on its left.  All three together prove that the group is SL2(C).
A finite group is enumerated: under the claim the traces are those of G, two elements are equal when the trace of their
quotient is 2, and that number of balls that exclude the others decides equality; then H must have as many elements of each
trace as G.

References: M. van der Put and M. F. Singer, "Galois Theory of Linear Differential Equations" (2003), ch. 5; Kovacic (1986).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import IntEnum
from fractions import Fraction
from itertools import combinations

from flint import acb, acb_mat, arb, fmpq, fmpz

from kovacic import derived
from kovacic.algebra.precision import working_precision
from kovacic.answer import Answer
from kovacic.enclosure.monodromy import LocalMonodromy, monodromy
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.request import Accuracy
from kovacic.errors import InputError
from kovacic.galois import Group, GroupKind
from kovacic.limits import Limits

_LARGEST = 400  # the largest finite group that is enumerated
_MOST_PRODUCTS = 12  # the number of products that are compared with one another
_BITS = 400
_LARGEST_POWER = 1 << 60  # of a matrix of balls, which says nothing any more
_TWO = acb(2)
_HIGHEST_ORDER = 120  # eigenvalues are compared with roots of unity up to this order
_DIAGONAL = (GroupKind.CYCLIC, GroupKind.MULTIPLICATIVE)
_TRIANGULAR = (*_DIAGONAL, GroupKind.ADDITIVE, GroupKind.BOREL)
#: The eigenvalues are roots of unity of one order, which is the group's n.
_WITH_ROOTS_OF_UNITY = (GroupKind.CYCLIC, GroupKind.ADDITIVE)
_IMPRIMITIVE = (GroupKind.DICYCLIC, GroupKind.INFINITE_DIHEDRAL, GroupKind.IMPRIMITIVE)
#: The number of elements of trace 2 cos(2 pi angle) by the angle, at most 1/2.
_PRIMITIVE = {
    GroupKind.TETRAHEDRAL: {"0": 1, "1/2": 1, "1/4": 6, "1/3": 8, "1/6": 8},
    GroupKind.OCTAHEDRAL: {"0": 1, "1/2": 1, "1/4": 18, "1/3": 8, "1/6": 8, "1/8": 6, "3/8": 6},
    GroupKind.ICOSAHEDRAL: {"0": 1, "1/2": 1, "1/4": 30, "1/3": 20, "1/6": 20}
    | dict.fromkeys(("1/5", "2/5", "1/10", "3/10"), 12),
}


@dataclass(frozen=True)
class Agreement:
    """What `Solution.compare_with_monodromy` returns.

    Attributes
    ----------
    verdict : bool or None
        True, False (a proof that it isn't this group), or None, where the matrices can't tell.
    reason : str
        What was seen, in a sentence.
    """

    verdict: bool | None
    reason: str


def agrees_with_group(
    answer: Answer,
    group: Group | None = None,
    *,
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> Agreement:
    """Compare the monodromy of y'' = S y with a group; see `Solution.compare_with_monodromy`.

    >>> import kovacic
    >>> from kovacic.galois import Ground
    >>> equation = kovacic.solve("-3/(16*x^2)")
    >>> agrees_with_group(equation)
    Agreement(verdict=True, reason='the monodromy group has 4 elements, with the traces of mu_4')
    >>> agrees_with_group(equation, Group(GroupKind.CYCLIC, Ground.RESIDUES, 2)).verdict
    False
    """
    group = derived.group(answer) if group is None else group
    if group is None:
        raise InputError("the equation is undecided, so there is no group to compare with")
    fuchsian = is_fuchsian(as_problem(answer, constants=True))
    if not fuchsian and group.finite:
        return Agreement(False, "an irregular singular point makes the group infinite")
    return compare(monodromy(answer, accuracy=accuracy, digits=digits, limits=limits), group, fuchsian)


def is_fuchsian(problem: NumericProblem) -> bool:
    """True if all singular points, infinity among them, are regular."""
    num, den = problem.polynomials()
    # S = O(1/x^2) at infinity, and poles of order 2 at most [Fuchs].
    is_infinity_regular = num.degree() < 0 or num.degree() - den.degree() <= -2
    return is_infinity_regular and all(multiplicity <= 2 for _, multiplicity in problem.poles(64))


def compare(local: tuple[LocalMonodromy, ...], group: Group, fuchsian: bool) -> Agreement:
    """The verdict from the matrices; `fuchsian` says that their Zariski closure is the group."""
    with working_precision(_BITS):
        generators = [item.acb_mat() for item in local]
        angles = _angles(group)
        if angles is not None:
            return _Enumeration(group, angles).verdict(generators)
        if not generators:
            return Agreement(None, "there is no finite singular point, so the monodromy is trivial")
        # The generators and their products in pairs; with one generator, itself and its square.
        longer = [generators[0] ** 2] if len(generators) == 1 else _products(generators)
        # As many as can be compared with one another, but all generators.
        words = [*generators, *longer][: max(_MOST_PRODUCTS, len(generators))]
        return _by_conditions(words, group, fuchsian)


def _inverse(m: acb_mat) -> acb_mat:
    """The inverse of a matrix of determinant 1."""
    return acb_mat([[m[1, 1], -m[0, 1]], [-m[1, 0], m[0, 0]]])


def _angles(group: Group) -> Counter[Fraction] | None:
    """The numbers of elements with the eigenvalues exp(+-2 pi i angle), or None for an infinite or a large group."""
    if group.kind in _PRIMITIVE:
        return Counter({Fraction(angle): count for angle, count in _PRIMITIVE[group.kind].items()})
    if group.order is None or group.n is None or group.order > _LARGEST:
        return None
    if group.kind is GroupKind.CYCLIC:
        return _angles_of_roots(group.n)
    # Dicyclic: the roots of unity of order 2 n, and as many elements of order 4.
    return _angles_of_roots(2 * group.n) + Counter({Fraction(1, 4): 2 * group.n})


def _angles_of_roots(n: int) -> Counter[Fraction]:
    """The angles of the n-th roots of unity; a root and its inverse have one."""
    # exp(2 pi i turn) and its inverse are the eigenvalues of one element, or of two with the same trace.
    turns = [Fraction(k, n) for k in range(n)]
    return Counter(min(turn, 1 - turn) for turn in turns)


class _Element(IntEnum):
    """Conclusions from the ball of an element: its trace isn't 2, may be 2, or is 2, and the element is the identity or isn't.

    Beside known elements a larger kind comes before a smaller one: an element that is known is no other.
    """

    OTHER = 0
    UNCLEAR = 1
    IDENTITY = 2
    UNIPOTENT = 3


class _Enumeration:
    """The elements of the monodromy group that are known, under the claim that it is the group with these angles."""

    def __init__(self, group: Group, angles: Counter[Fraction]) -> None:
        self.group = group
        self.angles = angles
        self.traces = {angle: _trace_of_turn(angle) for angle in angles}
        self.order = sum(angles.values())
        self.elements = [acb_mat([[1, 0], [0, 1]])]
        self.found = Counter([Fraction(0)])

    def add(self, candidate: acb_mat) -> Agreement | None:
        """Another product of generators; a verdict where it contradicts the claim, or can't be told from other elements."""
        # Those of the claimed traces that this one may be.
        angles = [angle for angle, value in self.traces.items() if candidate.trace().overlaps(value)]
        if not angles:
            return Agreement(False, f"the monodromy group has an element whose trace isn't one of {self.group}")
        beside_known = max(self._kind(candidate * _inverse(element)) for element in self.elements)
        if beside_known is _Element.UNIPOTENT:
            return Agreement(False, f"the monodromy group has a unipotent element, unlike {self.group}")
        if beside_known is _Element.UNCLEAR or len(angles) > 1:
            return Agreement(None, "the matrices aren't known well enough to tell the elements apart")
        if beside_known is _Element.OTHER:
            self.elements.append(candidate)
            self.found[angles[0]] += 1
        if len(self.elements) > self.order:
            return Agreement(False, f"the monodromy group has more elements than {self.group}")
        return None

    def _kind(self, element: acb_mat) -> _Element:
        """Which an element is whose trace is one of these."""
        trace = element.trace()
        # Beside another element, the trace of the quotient is 2 only if both are equal, or if the group is infinite.
        if not trace.overlaps(_TWO):
            return _Element.OTHER
        if any(trace.overlaps(value) for angle, value in self.traces.items() if angle):
            return _Element.UNCLEAR
        if _may_be_identity(element):
            return _Element.IDENTITY
        return _Element.UNIPOTENT

    def verdict(self, generators: list[acb_mat]) -> Agreement:
        """The verdict on all elements, by their traces: in the end no product with a generator is a new one."""
        for element in self.elements:  # which grows meanwhile
            for generator in generators:
                verdict = self.add(generator * element)
                if verdict is not None:
                    return verdict
        count = len(self.elements)
        if self.found != self.angles:
            return Agreement(False, f"the monodromy group has {count} elements, with other traces than {self.group}")
        plural = "element" if count == 1 else "elements"
        return Agreement(True, f"the monodromy group has {count} {plural}, with the traces of {self.group}")


@dataclass(frozen=True)
class _Possible:
    """Which of the conditions (1) the balls leave open, for matrices of the monodromy group: False is a proof."""

    words: list[acb_mat]
    commutators: list[acb_mat]
    commuting: bool
    reducible: bool
    monomial: bool

    @classmethod
    def of(cls, words: list[acb_mat]) -> _Possible:
        commutators = _commutators(words)
        return cls(
            words,
            commutators,
            commuting=_may_be_identities(commutators),
            reducible=all(c.trace().overlaps(_TWO) for c in commutators),
            monomial=_may_be_identities(_commutators([word**2 for word in words])),
        )

    def torsion(self) -> bool:
        """True if all eigenvalues may be roots of unity."""
        orders = range(1, _HIGHEST_ORDER + 1)  # that are tried
        return all(any(_may_have_order(word, k) for k in orders) for word in self.words)

    def unipotent(self, n: int) -> bool:
        """True if all n-th powers may be 1."""
        return n >= _LARGEST_POWER or _may_be_identities(word**n for word in self.words)

    def primitive(self) -> bool:
        """True if one of the three finite groups is possible."""
        longer = [*self.words, *self.commutators, *_products(self.words)]
        return any(all(_may_be_in(m, kind) for m in longer) for kind in _PRIMITIVE)


def _by_conditions(words: list[acb_mat], group: Group, fuchsian: bool) -> Agreement:
    """An infinite group (or a large one): the conditions (1)."""
    possible = _Possible.of(words)
    contradiction = _contradiction(possible, group, fuchsian)
    if contradiction is not None:
        return Agreement(False, f"{contradiction} {group}")
    if group.kind is GroupKind.SL2:  # only a group in no proper algebraic subgroup is dense
        if possible.reducible or possible.monomial or possible.primitive():
            return Agreement(None, "the monodromy matrices alone don't exclude every smaller group")
        return Agreement(True, "the monodromy matrices generate a group that is dense in SL2")
    if not fuchsian:
        return Agreement(True, f"the monodromy lies in {group} (irregular: it needn't be dense)")
    if _may_be_smaller(possible, group):
        return Agreement(None, f"the monodromy lies in {group}, and perhaps in a smaller group")
    return Agreement(True, f"the monodromy lies in {group}, and in none of the smaller groups that were tried")


def _contradiction(possible: _Possible, group: Group, fuchsian: bool) -> str | None:
    """Why the monodromy can't be that of the group, as a sentence that its name ends; None if nothing says so."""
    for kinds, holds, said in (
        (_TRIANGULAR, possible.reducible, "the monodromy matrices have no common eigenvector, unlike"),
        (_DIAGONAL, possible.commuting, "the monodromy matrices don't commute, unlike"),
        (_IMPRIMITIVE, possible.monomial, "the squares of the monodromy matrices don't commute, unlike those of"),
    ):
        if group.kind in kinds and not holds:
            return said
    if group.n is not None and group.kind in _WITH_ROOTS_OF_UNITY:
        if not all(_may_have_order(word, group.n) for word in possible.words):
            return "an eigenvalue of a monodromy matrix isn't a root of unity of"
        if fuchsian and _is_proper_order(possible.words, group.n):
            return "the eigenvalues of the monodromy matrices have a lower order than those of"
    return None


def _may_be_smaller(possible: _Possible, group: Group) -> bool:
    """True if the closure of the monodromy may be a proper subgroup of this infinite group, in which it lies."""
    n = group.n or 1
    tried: dict[GroupKind, Callable[[], bool]] = {
        GroupKind.MULTIPLICATIVE: possible.torsion,
        GroupKind.ADDITIVE: lambda: possible.commuting and possible.unipotent(n),
        GroupKind.BOREL: lambda: possible.commuting or possible.torsion(),
        GroupKind.INFINITE_DIHEDRAL: lambda: possible.reducible or possible.torsion(),
    }
    return tried.get(group.kind, lambda: True)()  # of the others nothing is tried


def _may_have_order(m: acb_mat, k: int) -> bool:
    """True if the eigenvalues may be k-th roots of unity, which balls can't refute for a large k."""
    return k >= _LARGEST_POWER or bool((m**k).trace().overlaps(_TWO))


def _is_proper_order(words: list[acb_mat], n: int) -> bool:
    """True if the orders of the eigenvalues, n-th roots of unity, provably have a common multiple less than n."""
    # The n/p-th powers are p-th roots of unity, whose real parts are at most cos(2 pi/p) unless they are 1.
    primes = [int(p) for p, _ in fmpz(n).factor()] if n <= _LARGEST else []
    bounds = [(n // p, _trace_of_turn(Fraction(1, p)).real) for p in primes]
    return any(all((word**k).trace().real > bound for word in words) for k, bound in bounds)


def _products(words: list[acb_mat]) -> list[acb_mat]:
    return [a * b for a, b in combinations(words, 2)]


def _commutators(words: list[acb_mat]) -> list[acb_mat]:
    return [a * b * _inverse(a) * _inverse(b) for a, b in combinations(words, 2)]


def _may_be_identity(m: acb_mat) -> bool:
    return bool(m.overlaps(acb_mat([[1, 0], [0, 1]])))


def _may_be_identities(matrices: Iterable[acb_mat]) -> bool:
    return all(map(_may_be_identity, matrices))


def _may_be_in(m: acb_mat, kind: GroupKind) -> bool:
    """True if the matrix may be an element of this primitive group.  In a finite group only +-1 have their traces."""
    if m.trace().overlaps(_TWO):
        return _may_be_identity(m)
    # -1, whose square is 1.
    if m.trace().overlaps(-_TWO):
        return _may_be_identity(m**2)
    return any(bool(m.trace().overlaps(_trace_of_turn(Fraction(angle)))) for angle in _PRIMITIVE[kind])


def _trace_of_turn(angle: Fraction) -> acb:
    """2 cos(2 pi angle)."""
    return acb(2 * arb.cos_pi_fmpq(fmpq(2 * angle.numerator, angle.denominator)))
